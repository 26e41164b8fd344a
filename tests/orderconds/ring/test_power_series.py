"""Truncated power series over several rings."""

from __future__ import annotations

import pytest
from flint import fmpq

from orderconds.ring import QQ, Polynomials, PowerSeries

POLYNOMIALS = Polynomials(["x", "y"])


def test_a_geometric_series_sums_to_its_reciprocal() -> None:
    ring = PowerSeries(QQ, 6)
    assert (1 / (1 - 2 * ring.h)).coefficients == tuple(fmpq(2) ** k for k in range(7))
    assert ring.valuation(ring.h**3 * 5) == 3
    with pytest.raises(ZeroDivisionError):
        ring.one / ring.h


def test_series_of_series_and_series_of_polynomials_work_alike() -> None:
    ring = PowerSeries(POLYNOMIALS, 2)
    x, _ = POLYNOMIALS.generators
    assert ring.text((ring.constant(x) + ring.h) ** 2) == "x^2 + 2*x*h + h^2"
