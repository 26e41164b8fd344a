"""NumPy archives: exact texts beside floats, and archives that are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import sympy

from orderconds import Tableau
from orderconds.errors import InputError
from orderconds.exchange import read_data
from orderconds.exchange.numpy_archive import nearest
from orderconds.tableau import find
from orderconds.tableau.record import from_data


def test_floats_of_numpy(tmp_path: Path) -> None:
    np.savez(tmp_path / "x.npz", A=np.zeros((1, 1)), b=np.ones(1))
    data = read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz", name="euler")
    assert from_data(data).method == Tableau.load(find("euler")).method


def test_an_archive_that_swells_is_refused_unread(tmp_path: Path) -> None:
    np.savez_compressed(tmp_path / "x.npz", A=np.zeros((2000, 2000)), b=np.ones(1))
    with pytest.raises(InputError, match="arrays of 32000"):
        read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz")


@pytest.mark.parametrize("content", [b"", b"no archive", b"\x80\x04N."])
def test_a_file_that_is_no_archive_is_named(content: bytes) -> None:
    with pytest.raises(InputError) as refused:
        read_data(content, "numpy", "x.npz")
    assert str(refused.value) == "x.npz: no zip archive; expected an .npz archive"


def test_floats_that_are_not_what_is_spelled_beside_them_are_refused(tmp_path: Path) -> None:
    np.savez(tmp_path / "x.npz", A=np.zeros((1, 1)), b=np.ones(1), b_exact=np.array(["1/2"]))
    with pytest.raises(
        InputError, match="the numbers in the array b differ from the exact texts in the array b_exact"
    ):
        read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz")


@pytest.mark.parametrize("text", ["1/3", "sqrt(2)", "-7/10", "1/4 - sqrt(3)/6", "0.1", "2^(1/3)"])
def test_floats_are_the_doubles_nearest_to_the_coefficients(text: str) -> None:
    exact = sympy.sympify(text.replace("^", "**"), rational=True)
    assert nearest(text) == float(exact.evalf(40))


def test_arrays_with_three_axes_or_text_are_refused(tmp_path: Path) -> None:
    for array in (np.zeros((1, 1, 1)), np.array([["x"]])):
        np.savez(tmp_path / "x.npz", A=array, b=np.ones(1))
        with pytest.raises(InputError, match="expected an array of numbers"):
            read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz")
