"""Family vrkmk: order min(p, R + 2) by computation, printed sums against the engine, RKMK inside it."""

from __future__ import annotations

import pytest
from flint import fmpq

from orderconds.errors import InputError
from orderconds.families import get
from orderconds.ring import QQ
from orderconds.series.action_enumeration import velocities
from orderconds.tableau import Tableau
from orderconds.tableau.library import find
from orderconds.tableau.methods import RungeKutta
from tests.oracles.index_sums import runge_kutta_value

A = ((fmpq(1, 3), fmpq(-2), fmpq(3, 5)), (fmpq(4), fmpq(1, 7), fmpq(-1)), (fmpq(2, 9), fmpq(5), fmpq(1)))
METHOD = RungeKutta(A, (fmpq(1, 2), fmpq(-3), fmpq(2, 7)))


def order_of(name, family, highest):
    tableau, family = Tableau.load(find(name)), get(family)
    for order in range(1, highest + 1):
        found = family.residuals(tableau.method, tableau.ring, family.decisive_conditions(order))
        if not all(tableau.ring.is_zero(r) for r in found):
            return order - 1
    return highest


@pytest.mark.parametrize(
    ("name", "cutoff", "order"),
    [
        ("kutta3", 0, 2),
        ("kutta3", 1, 3),
        ("rk4", 1, 3),
        ("rk4", 2, 4),
        ("gauss2", 0, 2),
        ("gauss2", 1, 3),
        ("gauss2", 2, 4),
        ("gauss3", 1, 3),
    ],
)
def test_order_is_that_of_the_tableau_or_two_more_than_the_cutoff(name, cutoff, order):
    assert order_of(name, f"vrkmk({cutoff})", order + 1) == order


@pytest.mark.slow
@pytest.mark.parametrize(("cutoff", "order"), [(2, 5), (3, 5), (4, 6)])
def test_an_even_cutoff_gains_one_order_since_odd_bernoulli_numbers_vanish(cutoff, order):
    assert order_of("gauss3", f"vrkmk({cutoff})", order) == order
    assert order_of("gauss3", f"vrkmk({cutoff})", 6) == order


def test_a_cutoff_too_low_adds_the_condition_that_cannot_be_met():
    counts = {r: [len(get("vrkmk", cutoff=r).conditions(n)) for n in range(1, 5)] for r in (0, 1, 2, None)}
    assert counts == {0: [1, 1, 4, 8], 1: [1, 1, 3, 9], 2: [1, 1, 3, 8], None: [1, 1, 3, 8]}


@pytest.mark.parametrize(
    "family", ["vrkmk(0)", "vrkmk(1)", "vrkmk(2)", "vrkmk", "vrkmk_pade(0)", "vrkmk_pade(1)", "vrkmk_pade(2)"]
)
@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_printed_sums_are_what_the_engine_computes(family, order):
    family = get(family)
    conditions = family.all_conditions(order)[:: 1 if order < 4 else 6]
    values = family.evaluate(METHOD, QQ, conditions)
    for condition, value in zip(conditions, values, strict=True):
        assert runge_kutta_value(condition.formula, QQ, METHOD.A, METHOD.b) == value, condition


@pytest.mark.parametrize("cutoff", [0, 1, 2, None])
def test_trees_without_momenta_have_the_values_of_rkmk(cutoff):
    lie_butcher = get("rkmk", cutoff=cutoff).series(METHOD, QQ)
    series = get("vrkmk", cutoff=cutoff).series(METHOD, QQ)

    def levels(tree, level=0):
        return bytes([level]) + b"".join(levels(t, level + 1) for t in tree.word)

    def without_momenta(tree):
        return not tree.momenta and all(map(without_momenta, tree.word))

    # A single letter in the update is linear; stages carry the brackets.
    for tree in (t for n in range(1, 5) for t in velocities(n) if without_momenta(t)):
        assert series.condition(tree) == lie_butcher(levels(tree))


def test_a_negative_cutoff_is_refused():
    with pytest.raises(InputError, match="cutoff -1"):
        get("vrkmk", cutoff=-1)
