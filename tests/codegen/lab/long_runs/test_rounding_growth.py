"""Compensated steps are the same steps with smaller rounding errors; random walks differ from drifts."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from sympy import Matrix, Symbol, symbols

from codegen.emitter import compensated, compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.groups import LeftMultiplication, Rn
from codegen.ir.domain import PreciseDomain
from codegen.ir.expr import evaluate
from codegen.ir.kernel import Kernel
from codegen.kernel.compensation import CARRY, Increments, with_carries
from codegen.lab.invariants import MANIFOLD, functions
from codegen.lab.long_runs.rounding_growth import STARTS, TIMES, _growth, rounding_growth
from codegen.lab.runner import Emitted
from codegen.loader import load
from codegen.scene import FieldScene

METHODS = [("free_rigid_body", "cf:cf4"), ("dipole", "cf:cf4"), ("linear_oscillator", "splitting:strang")]


def outputs(kernel: Kernel, domain: PreciseDomain, values: dict[str, object]) -> list[object]:
    """Return the outputs of an explicit kernel in 60 digits."""
    known = dict(values)
    for let in kernel.lets():
        (known[let.name],) = evaluate([let.value], domain, known)
    return evaluate(kernel.outputs, domain, known)


@pytest.mark.parametrize(("scene", "method"), METHODS)
def test_old_values_with_their_increments_and_carries_are_the_new_ones(scene, method):
    from codegen.kernel.translate import to_kernel

    compiled = compile_method(scene, method)
    plain, carried = to_kernel(compiled.program, compiled.problem), compensated(compiled).kernel
    domain, draw = PreciseDomain(0, 60), random.Random(3)
    number = domain.context.mpf
    symbols = [s for field in plain.state for s in field.symbols]
    values = {s: number(draw.uniform(-1, 1)) for s in (*symbols, *plain.scalars, "lead.h")}
    carries = {CARRY + s: number(draw.uniform(-1, 1)) / 2**60 for s in symbols}
    new = outputs(plain, domain, values)
    found = outputs(carried, domain, values | carries)
    for k, symbol in enumerate(symbols):
        assert abs(found[k] - new[k] - carries[CARRY + symbol]) < 1e-55
        assert abs(found[len(symbols) + k]) < 1e-55


def test_what_is_no_sum_with_the_old_value_has_no_increment():
    kernel = compile_method("free_rigid_body", "cf:cf4").kernel
    space = kernel.outputs[0].space
    increments, x, y = Increments(kernel), space.sym("m0"), space.sym("m1")
    assert increments.of(x + y, "m0") is y
    assert increments.of((1 + y) * x - y, "m0") is y * x - y
    for wrong in (y - x, 2 * x, x * x + y, x / y):
        assert increments.of(wrong, "m0") is None
    square = (1 + x) * (1 - y)
    assert increments.less_one(square) is x - y + x * -y
    assert increments.less_one(x * y) is None


def test_a_coordinate_that_is_made_anew_is_refused():
    kernel = compile_method("free_rigid_body", "cf:cf4").kernel
    first, *others = kernel.outputs
    with pytest.raises(MethodError, match="the new value of m0"):
        with_carries(replace(kernel, outputs=(2 * first, *others)))


def test_substeps_are_compensated_one_by_one():
    compiled = compile_method("dipole", "vcg:triple_jump")
    assert compiled.kernel.substeps
    plain, carried = Emitted(compiled, "c"), load(emit_compiled(compensated(compiled), "c"))
    ends = [
        integrator.run([*plain.initial, *zeros], 0.005, 100)
        for integrator, zeros in ((plain.integrator, ()), (carried, [0.0] * 12))
    ]
    assert max(abs(a - b) for a, b in zip(*ends, strict=False)) < 1e-13
    (laws,) = (evaluate for name, evaluate in functions(compiled.scene).items() if name == MANIFOLD)
    defects = [max(map(abs, laws(end, 0.0))) for end in ends]
    assert defects[1] < 2.0**-50 < 2 * defects[0]


@pytest.mark.parametrize(("scene", "method"), METHODS[:2])
def test_compensation_loses_a_tenth_at_most(scene, method):
    compiled = compile_method(scene, method)
    h = float((compiled.scene.span[1] - compiled.scene.span[0]) / 100)
    plain, carried = rounding_growth(compiled, h, 4096)
    assert (plain.compensated, carried.compensated) == (False, True)
    assert plain.quantity == carried.quantity
    assert plain.sizes[-1] > 10 * carried.sizes[-1]
    assert carried.sizes[-1] < 4e-15
    assert plain.steps[-1] == 4096
    assert len(plain.steps) == TIMES


def test_a_compensated_run_stays_beside_the_plain_one():
    compiled = compile_method("free_rigid_body", "rkmk(2):rk4")
    plain, carried = Emitted(compiled, "c"), load(emit_compiled(compensated(compiled), "c"))
    start = plain.initial
    ends = plain.integrator.run(start, 0.02, 100), carried.run([*start, *[0.0] * 3], 0.02, 100)
    assert max(abs(a - b) for a, b in zip(*ends, strict=False)) < 1e-14
    assert 0 < max(map(abs, ends[1][3:])) < 2.0**-53


@pytest.mark.parametrize(("exponent", "law"), [(0.5, "random walk"), (1.0, "systematic"), (0.0, "bounded")])
def test_each_exponent_has_its_law(exponent, law):
    counts = [2**k for k in range(4, 4 + TIMES)]
    draw = random.Random(5)
    members = []
    for _ in range(STARTS):
        if exponent == 0.5:
            walk, row = 0.0, []
            for n in range(1, counts[-1] + 1):
                walk += draw.gauss(0, 1e-16)
                if n in counts:
                    row.append(abs(walk))
        else:
            row = [1e-16 * n**exponent * draw.uniform(0.9, 1.1) for n in counts]
        members.append(row)
    found = _growth("radius", False, counts, members)
    assert found.law == law
    assert abs(found.exponent - exponent) <= max(found.half_width, 0.1)


def test_the_growth_in_a_quantity_near_zero_is_relative_to_its_terms():
    y = Matrix(symbols("y0:2", real=True))
    scene = FieldScene(
        group=Rn(2),
        action=LeftMultiplication(),
        y=y,
        f=Matrix([y[1], -y[0]]),
        y0=Matrix([1, 1]),
        span=(0, 1),
        name="s",
        invariants={"difference": y[0] ** 2 + y[1] ** 2 - 2},
    )
    growths = rounding_growth(compile_method(scene, "ambient:midpoint"), 0.05, 512)
    assert {g.quantity for g in growths} == {"difference"}
    assert all(g.sizes[-1] < 1e-12 for g in growths)


def test_a_quantity_that_depends_on_time_is_evaluated_at_the_time_of_its_state():
    y, t = Symbol("y", real=True), Symbol("t")
    scene = FieldScene(
        group=Rn(1),
        action=LeftMultiplication(),
        y=Matrix([y]),
        f=Matrix([1]),
        y0=Matrix([0]),
        span=(0, 1),
        name="s",
        invariants={"difference": y - t + 1},
    )
    growths = rounding_growth(compile_method(scene, "rk:euler"), 0.05, 512)
    assert {g.quantity for g in growths} == {"difference"}
    assert all(g.sizes[-1] < 1e-11 for g in growths)
