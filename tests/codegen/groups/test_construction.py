"""Arguments of which no group can be constructed are refused with one clear message."""

from __future__ import annotations

import pytest

from codegen.errors import SceneError
from codegen.groups import (
    GL,
    SL,
    SO,
    SO3,
    SU,
    Affine,
    Cotangent,
    Heisenberg,
    LeftMultiplication,
    Product,
    Rn,
    Semidirect,
    Sp,
    Unitary,
    Unitriangular,
)
from codegen.scene import FieldScene

LEAST = {Affine: 1, GL: 1, Heisenberg: 1, Rn: 1, SL: 2, SO: 2, SU: 2, Sp: 2, Unitary: 1, Unitriangular: 2}


@pytest.mark.parametrize("group", LEAST, ids=lambda g: g.__name__)
def test_a_size_is_an_integer_that_is_large_enough(group):
    least = LEAST[group]
    for wrong in (least - 1, -1, "3", 2.5, True, None):
        with pytest.raises(
            SceneError, match=rf"\(.*\): this size is not allowed; expected an integer of at least {least}$"
        ):
            group(wrong)
    assert group(least).dim > 0


def test_symplectic_matrices_have_an_even_number_of_rows():
    with pytest.raises(SceneError, match=r"Sp\(3\) has an odd number of rows; expected an even number"):
        Sp(3)


@pytest.mark.parametrize("construct", [Product, Cotangent, lambda g: Semidirect(g, None)])
def test_a_construction_needs_groups_and_not_classes(construct):
    with pytest.raises(
        SceneError, match=r"SO3 in .* is not a group; expected an object of .*such as SO3\(\)"
    ):
        construct(SO3)


def test_a_semidirect_product_needs_a_representation():
    with pytest.raises(SceneError, match=r"3 is not a representation of SO\(3\); expected an object of"):
        Semidirect(SO3(), 3)


@pytest.mark.parametrize("start", [[0, 0, 0, 0], [1, 2, 2, 4]])
def test_a_singular_matrix_is_no_initial_state(start):
    y = GL(2).point("y")
    with pytest.raises(
        SceneError, match=r"s: the initial state has no inverse; expected an element of GL\(2\)"
    ):
        FieldScene(group=GL(2), action=LeftMultiplication(), y=y, f=[0] * 4, y0=start, span=(0, 1), name="s")
