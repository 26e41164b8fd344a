"""Matrices of users in the basis of a matrix group."""

from __future__ import annotations

import numpy
import pytest
import sympy

from codegen.errors import SceneError
from codegen.groups import MatrixGroup
from codegen.ir.domain import PreciseDomain

ROWS = [[0, 1, 0], [0, 0, 0.5], [0, 0, 0]]


@pytest.mark.parametrize(
    "matrix", [ROWS, sympy.Matrix(ROWS), numpy.array(ROWS)], ids=["rows", "sympy", "numpy"]
)
def test_a_basis_may_contain_matrices_of_each_kind(matrix: object) -> None:
    group, plain = MatrixGroup("line", [matrix]), MatrixGroup("line", [ROWS])
    domain = PreciseDomain(0, 30)
    x = (domain.rational(2, 3),)
    assert group.exp(domain, x) == plain.exp(domain, x)


@pytest.mark.parametrize("matrix", [3, "x", [1, 2], [["a"]], sympy.Matrix([[sympy.Symbol("a")]])], ids=str)
def test_other_objects_are_refused(matrix: object) -> None:
    with pytest.raises(SceneError, match=r"^line: ") as caught:
        MatrixGroup("line", [matrix])
    assert caught.value.expected
