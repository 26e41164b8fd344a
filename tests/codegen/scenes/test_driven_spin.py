"""A field on the sphere that depends on time and is dissipative: orders hold with time, fail without."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import pytest

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.operations import Advance
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.loader import load as load_module
from codegen.passes.rewrite import rewrite
from codegen.scenes import load

SCENE = load("driven_spin")
METHODS = [("cg:cg3", 3), ("rkmk(1):kutta3", 3), ("rkmk(2):rk4", 4), ("cf4", 4), ("cf:cf3", 3)]


@cache
def exact():
    return reference(SCENE)


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize(("spelling", "order"), METHODS)
def test_the_stated_order_is_observed(spelling, order, target):
    made = compile_method(SCENE, spelling)
    stated = certified_order(made.method)
    assert stated.order == order
    found = converge(Emitted(made, target, stated), stated, exact())
    assert found.verdict == "holds", found.sentence()


@pytest.mark.parametrize("spelling", ["rkmk(2):euler", "rkmk(0):rk4"])
def test_a_method_with_too_few_brackets_or_stages_has_a_lower_order(spelling):
    made = compile_method(SCENE, spelling)
    stated = certified_order(compile_method(SCENE, "rkmk(2):rk4").method)
    assert converge(Emitted(made, "c", stated), stated, exact()).verdict == "fails"


def still(program):
    """The program with every stage time at t: the classic fault."""

    def rule(rewriter, assign):
        return assign.args if isinstance(assign.operation, Advance) else rewriter.emit(assign)

    return rewrite(program, rule)


def slope(made, program):
    """The order of the local error of one step from t = 0, less one, in 40 digits."""
    errors = []
    for n in (4096, 8192):
        h = Fraction(1, n)
        states = []
        for p, steps in ((program, 1), (made.program, 16)):
            d = PreciseDomain(h / steps, 40)
            y, t = SCENE.initial(d), d.rational(0)
            for _ in range(steps):
                inputs = {"y": y, "t": t}
                y = interpret(p, SCENE, d, {v.name: inputs[v.name] for v in p.inputs})["y"]
                t = t + d.h
            states.append(y)
        errors.append(max(abs(a - b) for a, b in zip(*states, strict=True)))
    return float(d.context.log(errors[0] / errors[1], 2)) - 1


@pytest.mark.parametrize(("spelling", "order"), METHODS)
def test_the_local_error_has_the_order_and_a_time_that_stands_still_order_one(spelling, order):
    made = compile_method(SCENE, spelling)
    assert slope(made, made.program) == pytest.approx(order, abs=0.05)
    assert slope(made, still(made.program)) == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize(
    ("spelling", "h"), [("cf4", 1e-3), ("cf4", 1e-2), ("cf4", 0.1), ("rkmk(0):euler", 1.0)]
)
def test_lie_group_methods_stay_on_the_sphere_however_stiff(spelling, h):
    emission = emit_compiled(compile_method("stiff_driven_spin", spelling), "c")
    m = load_module(emission).run(emission.manifest["initial"], h, 200)
    assert sum(x * x for x in m) == pytest.approx(1, abs=1e-12)


def test_a_step_whose_angles_leave_no_digit_is_a_status():
    """At h = 1 a stage of CF4 turns by 1000 times what rounding did to the one before it, thrice."""
    emission = emit_compiled(compile_method("stiff_driven_spin", "cf4"), "c")
    with pytest.raises(StepFailed) as failure:
        load_module(emission).run(emission.manifest["initial"], 1.0, 200)
    assert failure.value.status == Status.TOO_FAR
    assert failure.value.state == emission.manifest["initial"]
