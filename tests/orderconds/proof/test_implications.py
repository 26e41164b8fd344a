"""Orders that theorems give are those that the series give, wherever both can be had."""

from __future__ import annotations

import pytest

from orderconds.checking import check, family_order
from orderconds.families import get
from orderconds.proof.implications import least_order, settled
from orderconds.tableau import RungeKutta, Tableau, find
from orderconds.tableau.collocation import construct


@pytest.mark.parametrize(
    ("kind", "s"),
    [
        ("gauss", 2),
        ("gauss", 3),
        ("radau1a", 2),
        ("radau1a", 3),
        ("radau2a", 3),
        ("lobatto3c", 3),
        ("lobatto3d", 3),
    ],
)
def test_simplifying_assumptions_bound_the_order_of_the_symplectic_pair(kind: str, s: int) -> None:
    tableau = construct(kind, s)
    assert isinstance(tableau.method, RungeKutta)
    order = family_order(tableau, get("rk")).order
    assert (
        get("sprk").order_of_tableau(tableau.method, tableau.ring, {"rk": order})
        <= family_order(tableau, get("sprk")).order
    )


@pytest.mark.parametrize("kind", ["gauss", "radau1a", "radau2a", "lobatto3c", "lobatto3d"])
def test_for_these_kinds_the_bound_is_sharp_at_three_stages(kind: str) -> None:
    tableau = construct(kind, 3)
    assert isinstance(tableau.method, RungeKutta)
    order = family_order(tableau, get("rk")).order
    found = family_order(tableau, get("sprk")).order
    assert found == order
    if kind != "lobatto3c":
        assert get("sprk").order_of_tableau(tableau.method, tableau.ring, {"rk": order}) == found


@pytest.mark.parametrize("name", ["rk4", "kutta3", "cg3", "gauss2", "suzuki4", "crouzeix3", "hairer_wanner4"])
def test_theorems_never_say_more_than_the_series(name: str) -> None:
    report = check(name)
    orders = {f.family: f.order for f in report.orders}
    for label, order in orders.items():
        others = {k: n for k, n in orders.items() if k != label}
        assert least_order(others.items(), get(label)) <= order
        assert settled(others.items(), others, get(label)) in (None, order)


def test_an_order_beyond_the_search_follows_from_orders_within_it() -> None:
    found = check("gauss5", family="sprk").orders[0]
    assert (found.order, found.certificate, found.verdict) == (10, "exact", "holds")
    assert {failure.condition.order for failure in found.failing} == {11}


def test_a_wrong_claim_beyond_the_search_fails() -> None:
    text = find("gauss4").read_text(encoding="utf-8").replace("sprk = 8", "sprk = 9")
    found = check(Tableau.loads(text), family="sprk").orders[0]
    assert (found.order, found.verdict) == (8, "fails")
