"""Recognising algebraic numbers: what is found is the number, and what is no such number is not found."""

from __future__ import annotations

import pytest
from flint import arb

from orderconds.ring import precision as precision_module
from orderconds.ring.precision import precision
from orderconds.solve.closed_form import closed_forms, minimal_polynomial
from orderconds.tableau import Tableau

BITS = 800


def test_numbers_of_one_field_are_spelled_by_one_root() -> None:
    with precision(BITS):
        r = arb(2).root(3)
        numbers = {"x": r / 3, "y": 1 + r * r / 5, "z": arb(7) / 3}
        found = closed_forms(numbers, BITS)
    assert found is not None
    text = 'name = "m"\nfamily = "rk"\nA = [["{x}"]]\nb = ["{y} - ({z})"]\n'.format(
        **{name: x.text for name, x in found.items()}
    )
    tableau = Tableau.loads(text + "\n".join(found["x"].root) + "\n")
    method, ring = tableau.method, tableau.ring
    a, b = method.A[0][0], method.b[0]
    assert ring.is_zero(a * a * a * 27 - 2)
    assert ring.is_zero(b - 1 - a * a * ring.rational(9, 5) + ring.rational(7, 3))


def test_expected_square_roots_shorten_what_is_spelled() -> None:
    with precision(BITS):
        q, r = arb(2).root(3), arb(15).sqrt()
        found = closed_forms({"x": 1 + q, "y": r * q * q / 7 - q, "z": r / 2}, BITS, {"sqrt(15)": r})
    assert found is not None
    assert found["z"].text == "1/2*sqrt(15)"
    assert found["x"].text == "r"
    assert "1/7*sqrt(15)*r^2" in found["y"].text


def test_a_number_of_another_field_is_not_forced_into_one() -> None:
    with precision(BITS):
        assert closed_forms({"x": arb(2).sqrt(), "y": arb(3).sqrt()}, BITS) is None


@pytest.mark.parametrize("make", [arb.pi, lambda: arb(3).exp(), lambda: arb(2).root(3) + arb(3).root(5)])
def test_what_is_no_number_of_small_degree_is_not_recognised(make) -> None:
    with precision(BITS):
        assert minimal_polynomial(make(), BITS) is None


def test_precision_is_what_it_was() -> None:
    before = precision_module.working_bits()
    closed_forms({"x": arb(1) / 4}, 300)
    assert precision_module.working_bits() == before
