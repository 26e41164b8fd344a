"""Every family on a chain of four coupled bodies: its order, and the emitted step against the product.

The table contains every family of the compiler, and the tests fail if a family is missing. The order is that
of the unrolled program on the product of the groups of four sites. It is computed over Q[[h]]: the local
error begins with h^(p+1). So the order is at least p, and not p + 1. The emitted C module for any number of
sites then makes the steps of this program up to rounding errors, so it has the same order.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np
import pytest

from codegen import emit, load_lattice
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.ir.number import Number
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lower import lower, method_for, problem_for
from codegen.scene.problem import Problem
from codegen.scene.unrolled import unrolled
from tests.codegen.four_bodies import (
    frames,
    plane_states,
    pushed_spins,
    quartic_springs,
    turning_bodies,
    unit_spins,
)

NUMBER, TIME, STEP = 4, Fraction(1, 3), Fraction(1, 16)


@dataclass(frozen=True)
class Case:
    """A method, its order, a chain, and rational states of four sites."""

    method: str
    order: int
    chain: Callable[[], Problem]
    states: Callable[[], list[list[Fraction]]]


CASES = {
    "rk": (
        Case("rk:kutta3", 3, quartic_springs, plane_states),
        Case("rk:gauss2", 4, quartic_springs, plane_states),
    ),
    "rkmk": (Case("rkmk:rk4", 4, pushed_spins, unit_spins), Case("rkmk:gauss1", 2, turning_bodies, frames)),
    "cg": (Case("cg:cg3", 3, pushed_spins, unit_spins),),
    "cf": (Case("cf:cf4", 4, pushed_spins, unit_spins), Case("cf:cf3", 3, turning_bodies, frames)),
    "ambient": (Case("ambient:kutta3", 3, pushed_spins, unit_spins),),
    "taylor": (
        Case("taylor(3)", 3, pushed_spins, unit_spins),
        Case("taylor(2)", 2, turning_bodies, frames),
        Case("taylor(5)", 5, quartic_springs, plane_states),
    ),
}

ALL = [
    pytest.param(case, id=case.method, marks=() if case is cases[0] else pytest.mark.slow)
    for cases in CASES.values()
    for case in cases
]


@cache
def product(case: Case) -> Problem:
    """Return the system of four sites, with the states of the case as initial state at the time TIME."""
    whole = unrolled(case.chain(), (NUMBER,))
    space = whole.roots[0].space
    (block,) = whole.state
    numbers = [Number.rational(*x.as_integer_ratio()) for state in case.states() for x in state]
    start = replace(block, initial=tuple(map(space.const, numbers)))
    return replace(whole, state=(start,), span=(TIME, TIME + 1))


def step_of_the_product(case: Case, h: float) -> np.ndarray[Any, Any]:
    """Return the states after one step of the unrolled program."""
    whole = product(case)
    method = method_for(whole, case.method)
    inputs: dict[str, Any] = {"t": float(TIME), "y": tuple(whole.initial(FloatDomain(h)))}
    end = interpret(lower(whole, method), problem_for(whole, method), FloatDomain(h), inputs)["y"]
    return np.reshape(end, (NUMBER, -1))


@pytest.mark.parametrize("case", ALL)
def test_the_order_on_four_sites_is_exact(case):
    whole = product(case)
    method = method_for(whole, case.method)
    error = local_error(lower(whole, method), problem_for(whole, method), method.ring, case.order + 1)
    assert valuation(error) == case.order + 1


@pytest.mark.parametrize("case", ALL)
def test_the_emitted_step_of_four_sites_is_that_of_the_product(case):
    lattice = load_lattice(emit(case.chain(), case.method, target="c"))
    start = np.array([[float(x) for x in state] for state in case.states()])
    result = lattice.run(start, float(STEP), 1, t=float(TIME))
    expected = step_of_the_product(case, float(STEP))
    assert result.ok
    assert np.abs(result.states - expected).max() < 2e-14 * np.abs(expected).max()
    # The step depends on the neighbours: sites that are exchanged have other states.
    assert (
        np.abs(
            lattice.run(start[[1, 0, 2, 3]], float(STEP), 1, t=float(TIME)).states[2:] - expected[2:]
        ).max()
        > 1e-9
    )
