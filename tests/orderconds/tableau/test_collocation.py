"""Gauss, Radau and Lobatto methods: what defines them holds, and so the files of the library are made."""

from __future__ import annotations

from typing import Any

import pytest

from orderconds.checking import family_order
from orderconds.errors import InputError, UnknownName
from orderconds.families import get
from orderconds.tableau import RungeKutta, Tableau, available, dumps, find
from orderconds.tableau.collocation import KINDS, construct
from orderconds.tableau.methods import Embedded
from orderconds.tableau.properties import properties
from orderconds.tableau.simplifying import simplifying

SMALL = [(kind, s) for kind in KINDS for s in range(KINDS[kind].least, 5)]
SHIPPED = [(kind, s) for kind in KINDS for s in range(1, 6) if f"{kind}{s}" in available()]

# B(p), C(q), D(r) by stages: Hairer and Wanner II, Table IV.5.13.
ASSUMPTIONS = {
    "gauss": (0, 0, 0),
    "radau1a": (-1, -1, 0),
    "radau2a": (-1, 0, -1),
    "lobatto3a": (-2, 0, -2),
    "lobatto3b": (-2, -2, 0),
    "lobatto3c": (-2, -1, -1),
}


def holds(tableau: Tableau, **assumptions: int) -> bool:
    method: Any = tableau.method
    return all(tableau.ring.is_zero(x) for x in simplifying(method, tableau.ring, assumptions))


# With C(0) row sums are no nodes, and D(r), stated with nodes, says nothing of them.
WITH_NODES = [(kind, s) for kind, s in SMALL if kind in ASSUMPTIONS and s + ASSUMPTIONS[kind][1] > 0]


@pytest.mark.parametrize(("kind", "s"), WITH_NODES)
def test_the_simplifying_assumptions_hold_and_no_more(kind: str, s: int) -> None:
    tableau = construct(kind, s)
    b, c, d = ASSUMPTIONS[kind]
    found = {"B": 2 * s + b, "C": s + c, "D": s + d}
    assert holds(tableau, **found)
    for letter, n in found.items():
        assert not holds(tableau, **{letter: n + 1})


@pytest.mark.parametrize(("kind", "s"), SMALL)
def test_the_order_is_that_of_the_quadrature(kind: str, s: int) -> None:
    found = family_order(construct(kind, s), get("rk"))
    assert (found.order, found.certificate) == (KINDS[kind].order(s), "exact")


@pytest.mark.parametrize("kind", ["gauss", "lobatto3d", "lobatto3e"])
def test_symplectic_kinds(kind: str) -> None:
    assert properties(construct(kind, 3))["symplectic"]


@pytest.mark.parametrize(("kind", "s"), SHIPPED)
def test_the_files_of_the_library_are_what_is_constructed(kind: str, s: int) -> None:
    filed, made = Tableau.load(find(f"{kind}{s}")), construct(kind, s)
    assert isinstance(filed.method, RungeKutta)
    assert filed.method == made.method
    assert filed.embedded in (None, made.embedded)


@pytest.mark.parametrize(("kind", "s"), [("radau2a", 3), ("radau2a", 4), ("lobatto3a", 3), ("lobatto3a", 4)])
def test_the_embedded_row_integrates_polynomials_below_its_order_and_no_more(kind: str, s: int) -> None:
    tableau = construct(kind, s)
    ring, method, row = tableau.ring, tableau.method, tableau.embedded
    assert isinstance(method, RungeKutta)
    assert isinstance(row, Embedded)
    assert row.order == s - 1
    powers, defects = [ring.one] * s, []
    for k in range(s):
        moment = sum((w * x for w, x in zip(row.b, powers, strict=True)), ring.zero)
        defects.append(ring.is_zero(moment - ring.rational(1, k + 1)))
        powers = [x * c for x, c in zip(powers, method.c, strict=True)]
    assert defects == [True] * (s - 1) + [False]
    assert [ring.is_zero(w) for w in row.b].count(True) == 1


def test_the_library_has_five_stages_of_each_kind_that_is_in_use() -> None:
    assert {f"{kind}5" for kind in [*ASSUMPTIONS, "lobatto3d"]} <= set(available())


@pytest.mark.parametrize("kind", ["gauss", "radau2a"])
def test_nested_and_named_roots_survive_writing(kind: str) -> None:
    tableau = construct(kind, 4)
    assert Tableau.loads(dumps(tableau)).method == tableau.method


def test_another_kind_is_refused_with_the_kinds_there_are() -> None:
    with pytest.raises(UnknownName, match="radau2a"):
        construct("radau", 3)


def test_a_lobatto_method_has_two_stages_or_more() -> None:
    with pytest.raises(InputError, match="with 1 stage; expected at least 2 stages"):
        construct("lobatto3a", 1)


def test_nodes_of_too_large_a_field_are_refused() -> None:
    with pytest.raises(InputError, match="gauss with 8 stages"):
        construct("gauss", 8)
