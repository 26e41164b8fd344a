"""The Kuramoto-Sivashinsky equation u_t = -u_xx - u_xxxx - u u_x on a periodic interval of length 32 pi.

The initial state and the length are those of A.-K. Kassam and L. N. Trefethen, Fourth-order time-stepping for
stiff PDEs, SIAM J. Sci. Comput. 26 (2005), section 3.
"""

from sympy import Rational, cos, pi, sin, symbols

from codegen.scene import Dx, SemilinearScene

u, k, x = symbols("u k x", real=True)
wave = Rational(1, 16)

scene = SemilinearScene(
    title="Kuramoto-Sivashinsky equation on a periodic interval, with any number of points",
    u=u,
    k=k,
    x=x,
    L=k**2 - k**4,
    N=-Dx(u**2) / 2,
    length=32 * pi,
    u0=cos(wave * x) * (1 + sin(wave * x)),
    span=(0, 150),
)
