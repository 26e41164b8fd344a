"""Duffing's equation on the plane, in the first of three frames: translations.

H. Marthinsen's thesis, section 2.2: x' = y, y' = -a x - b x^3 with a = b = 1. The frame determines which part
of the equation a Lie group method keeps constant in a step: the whole field in this scene, so that every
family reduces to its classical method, the stiffness of the spring in ``duffing_sl2``, and the cubic part of
the force in ``duffing_se2``. The errors of Lie-Euler with 50 steps to t = 2 are 9.2e-2 here, 1.1e-2 for
``duffing_sl2`` and 1.6e-2 for ``duffing_se2``.
"""

from collections.abc import Sequence

from sympy import Expr, Matrix, Rational

from codegen.groups import Action, LeftMultiplication, LieGroup, Rn
from codegen.scene import FieldScene
from codegen.scene.problem import Problem

z = Rn(2).point("z")
x, y = z
field = Matrix([y, -x - x**3])


def duffing(frame: str, group: LieGroup, action: Action, f: Sequence[Expr]) -> Problem:
    """Return the scene with f(z) in the algebra of a group that acts on the plane."""
    return FieldScene(
        title=f"Duffing's equation, {frame}",
        group=group,
        action=action,
        y=z,
        f=f,
        y0=[Rational(3, 4), Rational(3, 4)],
        span=(0, 2),
        velocity=field,
        invariants={"energy": y**2 / 2 + x**2 / 2 + x**4 / 4},
    )


scene = duffing("translations of the plane", Rn(2), LeftMultiplication(), field)
