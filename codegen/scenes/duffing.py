"""Duffing's equation on the plane, with the group of translations.

The equations are x' = y and y' = -a x - b x^3 with a = b = 1 (H. Marthinsen's thesis, section 2.2). The
scenes ``duffing``, ``duffing_sl2`` and ``duffing_se2`` contain these equations with different groups. During
a step, the method Lie-Euler keeps a different quantity constant in each scene:

- ``duffing``: the field (y, -a x - b x^3).
- ``duffing_sl2``: the stiffness a + b x^2 of the spring.
- ``duffing_se2``: the cubic part -b x^3 of the force.

Translations commute, so RKMK, CG and CF methods for ``duffing`` are Runge-Kutta methods.
"""

from collections.abc import Sequence

from sympy import Expr, Matrix, Rational

from codegen.groups import Action, LeftMultiplication, LieGroup, Rn
from codegen.scene import FieldScene
from codegen.scene.figure import PlaneCurves, Run, Sweep
from codegen.scene.problem import Problem

z = Rn(2).point("z")
x, y = z
field = Matrix([y, -x - x**3])


def duffing(frame: str, group: LieGroup, action: Action, f: Sequence[Expr]) -> Problem:
    """Return the scene of Duffing's equation for a group that acts on the plane.

    ``f`` contains the coordinates of the field in the Lie algebra.
    """
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

step_sizes = Sweep("h", 0.0, 20.0, 800)
figures = [
    PlaneCurves(
        name="frozen",
        title="Flows of the frozen fields of Duffing's equation",
        caption="There is one panel for each group. A curve contains the results of one Lie-Euler step from "
        "the initial state, for step sizes from 0 to 20. The reference is the exact solution.",
        source="Fig. 2.1 of Marthinsen's thesis",
        point=(x, y),
        panels=True,
        bounds=(-1.9, 1.9, -1.9, 1.9),
        runs=(
            Run("rkmk(0):euler", 0.0, 1, "translations", sweep=step_sizes),
            Run("rkmk(0):euler", 0.0, 1, "SL(2)", scene="duffing_sl2", sweep=step_sizes),
            Run("rkmk(0):euler", 0.0, 1, "SE(2)", scene="duffing_se2", sweep=step_sizes),
        ),
        reference=Run("rkmk:butcher6", 0.02, 300),
    ),
]
