"""Derived properties agree with the literature and with each property broken once."""

from __future__ import annotations

import pytest

from orderconds.tableau import Tableau, find
from orderconds.tableau.method_properties import PROPERTIES
from orderconds.tableau.properties import properties

HOLDING = {
    "euler": {"explicit", "low_storage"},
    "rk4": {"explicit"},
    "gauss1": {"diagonally_implicit", "symplectic", "symmetric", "a_stable"},
    "gauss2": {"symplectic", "symmetric", "a_stable"},
    "gauss3": {"symplectic", "symmetric", "a_stable"},
    "cg4": {"explicit"},
    "triple_jump": {"diagonally_implicit", "symplectic", "symmetric"},
    "triple_jump6": {"diagonally_implicit", "symplectic", "symmetric"},
    "yoshida6": {"diagonally_implicit", "symplectic", "symmetric"},
}
INLINE = {
    "lobatto3a": (
        '[[], ["1/2", "1/2"]]',
        '["1/2", "1/2"]',
        {"diagonally_implicit", "symmetric", "fsal", "stiffly_accurate", "a_stable"},
    ),
    "radau2a": (
        '[["5/12", "-1/12"], ["3/4", "1/4"]]',
        '["3/4", "1/4"]',
        {"stiffly_accurate", "a_stable", "l_stable"},
    ),
    "backward euler": (
        '[["1"]]',
        '["1"]',
        {"diagonally_implicit", "stiffly_accurate", "a_stable", "l_stable"},
    ),
    "bogacki-shampine": (
        '[[], ["1/2"], ["0", "3/4"], ["2/9", "1/3", "4/9"]]',
        '["2/9", "1/3", "4/9", "0"]',
        {"explicit", "fsal", "stiffly_accurate"},
    ),
    "symplectic only": (
        '[["1/8"], ["1/4", "3/8"]]',
        '["1/4", "3/4"]',
        {"diagonally_implicit", "symplectic", "a_stable"},
    ),
    "halved steps": ('[["1/4"], ["1/4", "1/4"]]', '["1/2", "1/2"]', {"diagonally_implicit"}),
    "midpoint off by 5e-11": ('[["0.50000000005"]]', '["1"]', {"diagonally_implicit", "a_stable"}),
}


def inline(A: str, b: str) -> Tableau:
    return Tableau.loads(f'name = "t"\nfamily = "rk"\nA = {A}\nb = {b}\n')


@pytest.mark.parametrize("name", HOLDING)
def test_properties_of_the_library(name: str) -> None:
    found = properties(Tableau.load(find(name)))
    assert {p for p, holds in found.items() if holds} == HOLDING[name]
    assert tuple(found) == tuple(PROPERTIES)


@pytest.mark.parametrize("name", INLINE)
def test_properties_of_textbook_tableaux(name: str) -> None:
    A, b, expected = INLINE[name]
    assert {p for p, holds in properties(inline(A, b)).items() if holds} == expected


def test_balls_leave_open_what_they_cannot_tell_and_refute_what_they_can() -> None:
    found = properties(inline('[["0.5~"]]', '["1"]'))
    assert found["symplectic"] is None
    assert found["symmetric"] is None
    assert found["explicit"] is False
    assert found["diagonally_implicit"] is True
    assert found["stiffly_accurate"] is False


def test_a_composition_is_symplectic_by_construction_and_symmetric_only_if_palindromic() -> None:
    text = 'name = "t"\nfamily = "composition"\nbase = "symmetric-2"\ngamma = ["g", "1 - g"]\n'
    text += 'numbers = {{ g = "{}" }}\n'
    for g, symmetric in (("1/2", True), ("1/3", False), ("0.3~", False)):
        found = properties(Tableau.loads(text.format(g)))
        assert found["symplectic"] is True
        assert found["symmetric"] is symmetric


def test_commutator_free_methods_tell_whether_they_are_explicit_and_end_at_their_update() -> None:
    text = 'name = "t"\nfamily = "cf"\n[[stage]]\nexp = [["{}"]]\n[update]\nexp = [["1"]]\n'
    midpoint = {"explicit": False, "symmetric": True, "fsal": False, "low_storage": False}
    assert properties(Tableau.loads(text.format("1/2"))) == midpoint
    euler = {"explicit": True, "symmetric": False, "fsal": False, "low_storage": True}
    assert properties(Tableau.loads(text.format("0"))) == euler
