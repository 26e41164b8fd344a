"""Methods of order 4 on matrix groups and SE(3): the strict protocol, in many digits and in emitted C.

As in the other scenes of the protocol, each field is polynomial and depends on state and time, its values do
not commute, and the slopes must settle within a quarter of the stated order, from below and above.
"""

from __future__ import annotations

import random
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
from sympy import Rational, Symbol, eye

from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.groups import GL, SE3, SO, SU, Affine, LeftMultiplication, RightMultiplication
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.lab.orders.convergence import converge
from codegen.lab.orders.strict_protocol import DIGITS, stated_order, strict
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted, split_state
from codegen.loader import load
from codegen.lower import names
from codegen.method import parse
from codegen.scene import FieldScene
from tests.strategies import quadratic, quarter_turn

GROUPS = {group.name: group for group in (SE3(), SO(5), SU(3), GL(3), Affine(2))}
ACTIONS = {"left": LeftMultiplication(), "right": RightMultiplication()}
SPANS = {"GL(3)": (0, Rational(1, 2)), "Aff(2)": (0, Rational(1, 2))}
"""Shorter spans for solutions that soon reach infinity."""

INVALID = Path(__file__).parents[2] / "invalid"
METHODS = ("rkmk:rk4", "cg:cg4", "cf:cf4")
ULPS = 16
"""The largest permitted rounding error of a step, in units of the last place of the largest coordinate."""


@cache
def scene(name, side):
    """A polynomial field without symmetry that depends on state and time."""
    group, rng, t = GROUPS[name], random.Random(name), Symbol("t", real=True)
    y = [Symbol(f"y{k}", real=True) for k in range(group.size)]
    f = [
        quadratic(rng, y, 3) / 4 + Rational(rng.randint(1, 4), 4) * t * rng.choice(y)
        for _ in range(group.dim)
    ]
    start = [*quarter_turn(), Rational(1, 2), 0, -1] if isinstance(group, SE3) else list(eye(group.n))
    return FieldScene(
        group=group,
        action=ACTIONS[side],
        y=y,
        f=f,
        y0=start,
        span=SPANS.get(name, (0, 1)),
        name=f"{name}, {side}",
    )


@cache
def exact(name, side):
    return reference(scene(name, side))


def observed(name, side, method, claimed=None):
    """The convergence of the emitted C of a method, compared with its order or with a claimed order."""
    made = compile_method(scene(name, side), method)
    stated = CertifiedOrder(claimed, "claimed") if claimed else certified_order(made.method, made.scene)
    return converge(Emitted(made, "c", stated), stated, exact(name, side))


QUICK = (("SE(3)", "right", "cf:cf4"),)

each_case = pytest.mark.parametrize(
    ("name", "side", "method"),
    [
        pytest.param(*case, id="-".join(case), marks=() if case in QUICK else pytest.mark.slow)
        for case in ((name, side, method) for name in GROUPS for side in ACTIONS for method in METHODS)
    ],
)


@each_case
def test_methods_of_order_four_hold_the_strict_protocol_with_fifty_digits(name, side, method):
    chosen = parse(method, names())
    (found,) = strict(chosen, stated_order(chosen), scenes=[scene(name, side)])
    assert found.stated.order == 4
    assert found.verdict == "holds", found.sentence()


@each_case
def test_emitted_c_takes_the_steps_of_the_protocol_up_to_rounding(name, side, method):
    made = compile_method(scene(name, side), method)
    integrator, (start, end) = load(emit_compiled(made, "c")), made.problem.span
    h = float(end - start) / 8
    domain = PreciseDomain(Fraction(h), DIGITS)
    state = list(made.problem.initial(FloatDomain(0.0)))
    for k in range(4):
        numbers = [domain.context.mpf(x) for x in state]
        values = {"t": domain.context.mpf(k * h), **split_state(made.problem, numbers)}
        inputs = {v.name: values[v.name] for v in made.program.inputs}
        outputs = interpret(made.program, made.problem, domain, inputs)
        expected = [x for b in made.problem.state for x in flatten(b.kind, outputs[b.name])]
        state = integrator.step(state, h, k * h)
        error = max(abs(float(x - y)) for x, y in zip(state, expected, strict=True))
        assert error <= ULPS * 2.0**-53 * max(map(abs, state))


@each_case
def test_methods_of_order_four_hold_their_order_in_emitted_c(name, side, method):
    found = observed(name, side, method)
    assert found.stated.order == 4
    assert found.verdict == "holds", found.sentence()


FAULTS = {
    "no brackets": (f"rkmk(0):{INVALID / 'rkmk4_no_brackets.toml'}", 2),
    "one bracket": (f"rkmk(1):{INVALID / 'rkmk4_one_bracket.toml'}", 3),
    "factors swapped": (f"cf:{INVALID / 'cf4_factors_swapped.toml'}", 2),
}
"""Faulty methods of claimed order 4, and their orders."""


@pytest.mark.parametrize(
    ("name", "side", "fault"),
    [
        pytest.param(*case, id="-".join(case), marks=() if k == 1 else pytest.mark.slow)
        for k, case in enumerate(
            (name, side, fault) for name in GROUPS for side in ACTIONS for fault in FAULTS
        )
    ],
)
def test_a_faulty_method_fails_with_the_order_it_has(name, side, fault):
    method, order = FAULTS[fault]
    found = observed(name, side, method, claimed=4)
    assert found.verdict == "fails", found.sentence()
    assert found.observed == pytest.approx(order, abs=0.25)
