"""Inertial navigation on SE_2(3): attitude, velocity and position from a gyroscope and an accelerometer.

The state consists of the attitude R, the velocity v and the position p. The equations are R' = R hat(w),
v' = R a + g and p' = v, where hat(w) is the skew matrix of w, and g is gravity (A. Barrau and S. Bonnabel,
IEEE Transactions on Automatic Control 62 (2017), 1797-1812). The angular velocity w and the acceleration a
are measured in the frame of the vehicle. The six components of w and a are input signals.

By default the signals belong to a coning motion (P. G. Savage, Strapdown inertial navigation integration
algorithm design, Journal of Guidance, Control, and Dynamics 21 (1998), 19-28). R is a rotation by the angle
alpha about a horizontal axis, and this axis turns in the horizontal plane with the rate nu. The drift of a
method is the distance of its solution from the exact motion.
"""

from sympy import Matrix, Rational, Symbol, cos, diff, eye, sin

from codegen.groups import SE23, RightMultiplication
from codegen.scene import FieldScene, signal

t = Symbol("t")
sin_alpha, cos_alpha, nu, c = Rational(5, 13), Rational(12, 13), 4, Rational(1, 2)
gravity = Matrix([0, 0, -1])

# The exact motion: R is a rotation about the unit vector u with hat(u) = ``axis``.
axis = Matrix([[0, 0, sin(nu * t)], [0, 0, -cos(nu * t)], [-sin(nu * t), cos(nu * t), 0]])
attitude = eye(3) + sin_alpha * axis + (1 - cos_alpha) * axis**2
path = Matrix([cos(c * t), sin(c * t), sin(c * t) / 4])
rates = [-nu * sin_alpha * sin(nu * t), nu * sin_alpha * cos(nu * t), nu * (cos_alpha - 1)]
force = attitude.T * (diff(path, t, 2) - gravity)

w = Matrix([signal(f"w{k}", rate) for k, rate in enumerate(rates)])
a = Matrix([signal(f"a{k}", part) for k, part in enumerate(force)])
y = Matrix(
    [
        *(Symbol(f"r{i}{j}") for i in range(3) for j in range(3)),
        *(Symbol(f"{s}{k}") for s in "vp" for k in range(3)),
    ]
)
R, v = Matrix(3, 3, y[:9]), Matrix(y[9:12])

scene = FieldScene(
    title="Inertial navigation with coning motion, SE_2(3)",
    group=SE23(),
    action=RightMultiplication(),
    y=y,
    f=[*(-w), *(-(a + R.T * gravity)), *(-R.T * v)],
    y0=[*attitude.subs(t, 0), *diff(path, t).subs(t, 0), *path.subs(t, 0)],
    span=(0, 2),
)
