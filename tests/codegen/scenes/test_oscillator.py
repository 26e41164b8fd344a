"""Table 4.1 of Marthinsen's thesis from emitted C."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from tests.codegen.oscillator import ROWS, H, energies, error, order, properties
from tests.orderconds.tableau.test_linear_oscillator import energies as energies_of_matrices
from tests.orderconds.tableau.test_linear_oscillator import exponential, field, step_matrices

PAGE = Path(__file__).parents[3] / "docs/reference/oscillator.md"
SHORT = 2000
NAMES = [row.name for row in ROWS]
PRINTED = ["CSE", "CSE", "CSE", "CE", "CS", "CS", "CS", "SE", "S", "C", "S", "E", "C", ""]
"""The properties in the table, in the order of its rows."""

ORDERS = [4, 4, 2, 1, 4, 4, 2, 2, 4, 1, 2, 1, 1, 3]
"""The orders of the methods; the printed order of ExpSymNonCan is 1, but its formula has order 2."""


@pytest.mark.slow
@pytest.mark.parametrize("row", ROWS, ids=NAMES)
def test_the_energy_error_of_emitted_c_has_three_correct_digits(row):
    assert error(row) == pytest.approx(row.error, rel=0.001)


@pytest.mark.parametrize(
    "row",
    [pytest.param(r, marks=() if r.method == "rk:kahan" else pytest.mark.slow) for r in ROWS if r.tableau],
    ids=[row.name for row in ROWS if row.tableau],
)
def test_emitted_c_computes_the_energies_of_the_matrices_of_the_tableau(row):
    expected = energies_of_matrices(step_matrices(row.tableau, H * np.arange(SHORT), H))
    assert energies(row, H, SHORT) == pytest.approx(expected, rel=1e-10)


def stated(name, t):
    """The matrices of a stated step at the times t, by NumPy."""
    first, middle, last = (field(t + c * H) for c in (0, 0.5, 1))
    bracket = first @ last - last @ first
    match name:
        case "step:exp_non_can":
            return exponential(H * first @ (np.eye(2) + H * first @ bracket))
        case "step:exp_sym_non_can":
            return exponential(H * middle @ (np.eye(2) + H * middle @ bracket))
        case _:
            # The eigenvalues of 1 + h A are 1 +- i h sqrt(k); the part of its logarithm without trace is
            # angle/(h sqrt(k)) h A.
            root = H * np.sqrt(-first[:, 1, 0])
            return exponential((np.arctan(root) / root)[:, None, None] * H * first)


@pytest.mark.parametrize("row", [row for row in ROWS if not row.tableau], ids=lambda row: row.name)
def test_emitted_c_computes_the_energies_of_a_stated_step(row):
    expected = energies_of_matrices(stated(row.method, H * np.arange(SHORT)))
    assert energies(row, H, SHORT) == pytest.approx(expected, rel=1e-10)


def test_the_properties_and_orders_of_the_table_follow_from_the_coefficients():
    assert [properties(row) for row in ROWS] == PRINTED
    assert [order(row) for row in ROWS] == ORDERS


@pytest.mark.slow
def test_the_page_shows_the_errors_of_the_table():
    shown = re.findall(
        r"^\| ([^|]+) \| `([^`]+)` \| (\d) \| (\w*) \| (\S+) \|", PAGE.read_text(), re.MULTILINE
    )
    assert [name for name, *_ in shown] == NAMES
    assert all(float(x[4]) == pytest.approx(row.error, rel=0.001) for x, row in zip(shown, ROWS, strict=True))
    assert [x[3] for x in shown] == PRINTED
