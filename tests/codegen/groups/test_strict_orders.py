"""Methods of order 4 on matrix groups and SE(3): strict scenes, slopes from below and above, in emitted C.

As in the strict protocol, each field is polynomial and depends on state and time, its values do not commute,
and the slopes must settle within a quarter of the stated order.
"""

from __future__ import annotations

import random
from functools import cache
from pathlib import Path

import pytest
from sympy import Rational, Symbol, eye

from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import compile_method
from codegen.groups import GL, SE3, SO, SU, Affine, LeftMultiplication, RightMultiplication
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.scene import FieldScene
from tests.strategies import quadratic, quarter_turn

GROUPS = {group.name: group for group in (SE3(), SO(5), SU(3), GL(3), Affine(2))}
ACTIONS = {"left": LeftMultiplication(), "right": RightMultiplication()}
SPANS = {"GL(3)": (0, Rational(1, 2)), "Aff(2)": (0, Rational(1, 2))}
"""Shorter spans for solutions that soon reach infinity."""

INVALID = Path(__file__).parents[2] / "invalid"
METHODS = ("rkmk:rk4", "cg:cg4", "cf:cf4")


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


@pytest.mark.parametrize(
    ("name", "side", "method"),
    [
        pytest.param(*case, id="-".join(case), marks=() if case in QUICK else pytest.mark.slow)
        for case in ((name, side, method) for name in GROUPS for side in ACTIONS for method in METHODS)
    ],
)
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
