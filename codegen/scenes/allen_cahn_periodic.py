"""The Allen-Cahn equation u_t = eps u_xx + u - u^3 on a periodic interval of length 2 pi.

The equation is that of S. M. Allen and J. W. Cahn (Acta Metallurgica 27 (1979) 1085-1095) in one dimension.
The linear operator L = eps d^2/dx^2 has the Fourier symbol -eps k^2. The nonlinear term is N(u) = u - u^3.
The group consists of the affine maps u -> exp(t L) u + c, where u and c are functions of x (H. Marthinsen's
thesis, section 2.2.2).
"""

from sympy import Rational, cos, pi, sin, symbols

from codegen.scene import SemilinearScene, param

u, k, x = symbols("u k x", real=True)
eps = param("eps", Rational(1, 100))

scene = SemilinearScene(
    title="Allen-Cahn equation on a periodic interval, with any number of points",
    u=u,
    k=k,
    x=x,
    L=-eps * k**2,
    N=u - u**3,
    length=2 * pi,
    u0=Rational(53, 100) * cos(x) + Rational(47, 100) * sin(2 * x),
    span=(0, 10),
)
