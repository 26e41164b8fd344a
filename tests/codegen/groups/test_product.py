"""Products of many factors: the names of their coordinates, and emitted code."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from sympy import Matrix

from codegen.emitter import emit
from codegen.groups import SE2, SO2, LeftMultiplication, Product, Rn
from codegen.groups.product import labels
from codegen.loader import load
from codegen.scene import FieldScene


def test_factors_up_to_26_have_one_letter():
    product = Product(*[Rn(1)] * 26)
    assert [s.name for s in product.symbols("q")] == [f"q{chr(97 + k)}0" for k in range(26)]


@pytest.mark.parametrize("count", [1, 26, 27, 300, 677])
def test_labels_are_identifiers_of_one_length_and_all_different(count):
    found = list(labels(count))
    assert len(set(found)) == count
    assert len(set(map(len, found))) == 1
    assert all(label.isidentifier() for label in found)


def test_coordinates_of_products_of_products_have_different_names():
    inner = Product(*[SE2(), Rn(1), SO2()] * 10)
    outer = Product(*[inner, Rn(1), SE2()] * 10)
    names = [s.name for s in outer.symbols("q")]
    assert len(set(names)) == len(names) == outer.size


def test_a_product_of_300_factors_is_emitted():
    group = Product(*(SO2() if k % 2 else Rn(1) for k in range(300)))
    y = group.point("q")
    # each translation moves with the cosine of the next rotation, each rotation with the translation before
    first = [0]
    for factor in group.factors:
        first.append(first[-1] + factor.size)
    f = [y[first[k + 1]] if k % 2 == 0 else y[first[k - 1]] for k in range(300)]
    start = [value for k in range(150) for value in (Fraction(k, 8), 1, 0)]
    scene = FieldScene(
        group=group,
        action=LeftMultiplication(),
        y=y,
        f=Matrix(f),
        y0=start,
        span=(0, 1),
        name="many factors",
    )
    after = load(emit(scene, "rkmk(0):euler", "python")).step([float(x) for x in start], 0.5)
    for k in range(150):
        assert after[3 * k : 3 * k + 3] == pytest.approx([k / 8 + 0.5, math.cos(k / 16), math.sin(k / 16)])
