"""Runs in the interpreter: doubles and numbers of many digits."""

from __future__ import annotations

import mpmath
import pytest
import sympy

from codegen.emitter import compile_method
from codegen.groups import Rn
from codegen.groups.actions import LeftMultiplication
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.lab.runner import Interpreted, RunFailed, split_state
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from codegen.scenes import load


def pole() -> Problem:
    """y' = 1/(2 - t) has a pole at t = 2."""
    y = Rn(1).point("y")
    f = [1 / (2 - sympy.Symbol("t"))]
    return FieldScene(group=Rn(1), action=LeftMultiplication(), y=y, f=f, y0=[0], span=(0, 3))


@pytest.mark.parametrize("digits", [16, 40])
def test_a_division_by_zero_is_a_failed_run(digits: int) -> None:
    run = Interpreted(compile_method(pole(), "ambient:rk4"), digits)
    with pytest.raises(RunFailed):
        run.final(3)
    # No stage of seven steps is at the pole.
    assert mpmath.isfinite(run.final(7)[0])


@pytest.mark.parametrize("method", ["rkmk(2):kutta3", "vcg:midpoint"])
def test_a_run_in_many_digits_is_that_of_mpmath_numbers(method: str) -> None:
    compiled = compile_method(load("dipole"), method)
    run, steps = Interpreted(compiled, 40), 3
    start, end = run.problem.span
    domain = PreciseDomain((end - start) / steps, 40)
    state = run.problem.initial(domain)
    for k in range(steps):
        given = {"t": k * domain.h, **split_state(run.problem, state)}
        inputs = {v.name: given[v.name] for v in compiled.program.inputs}
        outputs = interpret(compiled.program, run.problem, domain, inputs)
        state = tuple(x for block in run.problem.state for x in outputs[block.name])
    gaps = [abs(a - b) for a, b in zip(run.final(steps), state, strict=True)]
    assert max(gaps) < 1e-37
    # Doubles are much less accurate, so the bound would show a run in doubles.
    doubles = Interpreted(compiled).final(steps)
    assert max(abs(a - b) for a, b in zip(doubles, state, strict=True)) > 1e-20
