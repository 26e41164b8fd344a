"""Infinities and NaNs in a step: emitted Python returns what emitted C returns, or fails as C does."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Unpack

import pytest

import codegen
from codegen.emitter import compile_method
from codegen.integrator import Integrator, Status, StepFailed
from codegen.lab.runner import Interpreted
from codegen.run_options import RunOptions

VECTORS = """
from sympy import Matrix, Piecewise, atan, cosh, exp, sin, symbols
from codegen.groups import Rn, LeftMultiplication
from codegen.scene import FieldScene
y = Matrix(symbols("x y", real=True))
f = Matrix([{}])
scene = FieldScene(group=Rn(2), action=LeftMultiplication(), y=y, f=f, y0=Matrix([1, 0]), span=(0, 1))
"""

PENDULUM = """
from sympy import Matrix, cos
from codegen.groups import Rn
from codegen.scene import HamiltonianScene
G = Rn(1)
q, mu = G.point("q"), G.dual("p")
T, V = mu[0] ** 2 / 2, -cos(q[0])
scene = HamiltonianScene(
    group=G, q=q, mu=mu, H=T + V, parts={"T": T, "V": V}, q0=[1], mu0=[0], span=(0, 2)
)
"""


def both(scene: str, method: str, solver: str = "auto", **options: Unpack[RunOptions]) -> list[Integrator]:
    return [
        codegen.load(codegen.emit(scene, method, target=t, solver=solver, **options)) for t in ("c", "python")
    ]


def result(
    integrator: Integrator, state: Sequence[float], h: float, steps: int
) -> tuple[Status, int, tuple[float, ...]]:
    """Return the status, the number of completed steps and the last state of a run."""
    try:
        return Status.OK, steps, tuple(integrator.run(state, h, steps))
    except StepFailed as failure:
        return failure.status, failure.step, tuple(failure.state)


@pytest.mark.parametrize("options", [{}, {"events": 1}, {"compensate": True}, {"jacobian": True}], ids=str)
@pytest.mark.parametrize("h", [1e160, 1e200])
def test_the_sine_of_an_infinity_is_a_failed_step(tmp_path: Path, options: RunOptions, h: float) -> None:
    path = tmp_path / "pendulum.py"
    path.write_text(PENDULUM)
    in_c, in_python = (result(x, x.initial, h, 3) for x in both(str(path), "ambient:rk4", **options))
    assert in_c == in_python
    assert in_c[0] is Status.TOO_FAR


def test_the_last_good_state_is_kept_when_a_function_raises(tmp_path: Path) -> None:
    path = tmp_path / "growing.py"
    path.write_text(VECTORS.format("y[0] * y[0] * y[0], sin(y[0])"))
    in_c, in_python = (result(x, [1.0, 0.0], 1.0, 30) for x in both(str(path), "ambient:rk4"))
    assert in_c == in_python
    assert in_c[0] is not Status.OK
    assert in_c[1] > 0


def test_a_long_step_on_sl2_fails_as_in_c() -> None:
    in_c, in_python = (result(x, [3.0, 1.0], 100.0, 5) for x in both("duffing_sl2", "cf:cf4"))
    assert in_c == in_python
    assert in_c[0] is Status.TOO_FAR


@pytest.mark.parametrize(
    "field",
    [
        "-y[1], y[0] + 1 / (1 + exp(800 * y[0]))",
        "-y[1], y[0] + 1 / cosh(1000 * y[0])",
        "-y[1], atan(exp(800 * y[0]))",
        "-y[1], Piecewise((sin(exp(800 * y[0])), y[1] > 9), (y[0], True))",
    ],
)
def test_an_overflow_that_a_formula_hides_is_no_failure(tmp_path: Path, field: str) -> None:
    path = tmp_path / "hidden.py"
    path.write_text(VECTORS.format(field))
    in_c, in_python = (result(x, [1.0, 0.0], 0.125, 8) for x in both(str(path), "rkmk:rk4"))
    assert in_c[0] is in_python[0] is Status.OK
    assert in_c[2] == pytest.approx(in_python[2], rel=1e-14)
    interpreted = Interpreted(compile_method(str(path), "rkmk:rk4"), 16).final(8)
    assert in_c[2] == pytest.approx(tuple(map(float, interpreted)), rel=1e-13)


@pytest.mark.parametrize("solver", ["newton", "simplified-newton"])
def test_a_solver_reports_the_sine_of_an_infinity_as_in_c(tmp_path: Path, solver: str) -> None:
    path = tmp_path / "pendulum.py"
    path.write_text(PENDULUM)
    start = [float("inf"), 0.0]
    in_c, in_python = (result(x, start, 0.1, 3) for x in both(str(path), "rkmk:gauss2", solver=solver))
    assert in_c == in_python
