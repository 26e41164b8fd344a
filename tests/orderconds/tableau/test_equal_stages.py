"""Tableaux that define the same method have the same properties, and no other tableau gets them."""

from __future__ import annotations

from itertools import permutations

import pytest

from orderconds.ring import QQ
from orderconds.tableau import Tableau, find
from orderconds.tableau.equal_stages import equivalent, irreducible, stage_classes
from orderconds.tableau.method_properties import symmetric_step, symplectic_step
from orderconds.tableau.methods import RungeKutta

METHODS = ("gauss2", "gauss3", "lobatto3a3", "radau2a2", "rk4")


def method(*rows: str) -> RungeKutta:
    """Return the method with the rows of A and the weights b, which are the last row."""
    *A, b = [[f'"{x}"' for x in row.split()] for row in rows]
    text = ", ".join(f"[{', '.join(row)}]" for row in A)
    found = Tableau.loads(f'name = "t"\nfamily = "rk"\nA = [{text}]\nb = [{", ".join(b)}]\n').method
    assert isinstance(found, RungeKutta)
    return found


MIDPOINT = method("1/2", "1")
EQUIVALENT = {
    "a stage twice": method("1/2 0", "1/2 0", "1/3 2/3"),
    "an unused stage": method("1/2 0", "7 3", "1 0"),
    "an unused stage in front": method("3 7", "0 1/2", "0 1"),
    "equal stages whose weights cancel": method("1/2 0 0", "0 1 0", "0 0 1", "1 2 -2"),
    "a stage that only a cancelled stage uses": method(
        "1/2 0 0 0", "0 0 0 2", "0 0 0 2", "9 0 0 1", "1 5 -5 0"
    ),
}
DIFFERENT = {
    "a stage that differs by 1/10^30": method("1/2 0", "1/2+1/10^30 0", "1/3 2/3"),
    "a stage with a small weight": method("1/2 0", "7 3", "1-1/10^30 1/10^30"),
    "two half steps": method("1/4 0", "1/2 1/4", "1/2 1/2"),
}


@pytest.mark.parametrize("name", EQUIVALENT)
def test_equal_and_unused_stages_do_not_change_a_property(name: str) -> None:
    assert irreducible(EQUIVALENT[name], QQ) == MIDPOINT
    assert equivalent(EQUIVALENT[name], MIDPOINT, QQ)
    assert symplectic_step(EQUIVALENT[name], QQ)
    assert symmetric_step(EQUIVALENT[name], QQ)


@pytest.mark.parametrize("name", DIFFERENT)
def test_other_methods_are_not_equivalent(name: str) -> None:
    assert not equivalent(DIFFERENT[name], MIDPOINT, QQ)
    assert irreducible(DIFFERENT[name], QQ) == DIFFERENT[name]


@pytest.mark.parametrize("name", ["a stage that differs by 1/10^30", "a stage with a small weight"])
def test_a_property_that_fails_by_a_small_number_fails(name: str) -> None:
    assert symplectic_step(DIFFERENT[name], QQ) is False
    assert symmetric_step(DIFFERENT[name], QQ) is False


@pytest.mark.parametrize("name", METHODS)
def test_the_numbering_of_the_stages_does_not_change_a_property(name: str) -> None:
    tableau = Tableau.load(find(name))
    given, ring = tableau.method, tableau.ring
    assert isinstance(given, RungeKutta)
    for order in permutations(range(given.s)):
        A = tuple(tuple(given.A[i][j] for j in order) for i in order)
        renumbered = RungeKutta(A, tuple(given.b[i] for i in order))
        assert equivalent(given, renumbered, ring)
        assert symmetric_step(renumbered, ring) is (name in {"gauss2", "gauss3", "lobatto3a3"})
        assert symplectic_step(renumbered, ring) is (name in {"gauss2", "gauss3"})


def test_stages_of_different_methods_are_equal_if_their_values_are() -> None:
    euler, heun = method("0", "1"), method("0 0", "1 0", "1/2 1/2")
    assert stage_classes([euler, heun], QQ) == [[0], [0, 1]]
