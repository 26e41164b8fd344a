"""Rank and kernel over Q, by the laws of linear algebra."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from orderconds.ring.rational_matrix import kernel, rank

Matrix = list[list[Fraction]]


def product_of_random_matrices(seed: int, height: int, inner: int, width: int) -> Matrix:
    """A matrix of rank at most ``inner``, and almost surely of that rank."""
    numbers = random.Random(seed)

    def matrix(rows: int, columns: int) -> Matrix:
        return [
            [Fraction(numbers.randint(-9, 9), numbers.randint(1, 5)) for _ in range(columns)]
            for _ in range(rows)
        ]

    left, right = matrix(height, inner), matrix(inner, width)
    return [
        [sum((x * right[k][j] for k, x in enumerate(row)), Fraction(0)) for j in range(width)] for row in left
    ]


@pytest.mark.parametrize(("height", "inner", "width"), [(4, 2, 6), (5, 5, 5), (6, 3, 4), (1, 1, 7)])
def test_rank_and_kernel_fill_the_width(height: int, inner: int, width: int) -> None:
    for seed in range(5):
        rows = product_of_random_matrices(seed, height, inner, width)
        vectors = list(kernel(rows, width))
        assert rank(rows) == min(height, inner, width)
        assert len(vectors) == width - rank(rows)


def test_kernel_vectors_are_annihilated_and_independent() -> None:
    rows, width = product_of_random_matrices(7, 4, 2, 6), 6
    vectors = []
    for entries in kernel(rows, width):
        vector = [Fraction(0)] * width
        for place, value in entries:
            vector[place] = value
        assert all(sum(a * x for a, x in zip(row, vector, strict=True)) == 0 for row in rows)
        assert entries[0][1] == 1
        vectors.append(vector)
    assert rank(vectors) == len(vectors)


def test_each_kernel_vector_has_a_place_of_its_own() -> None:
    vectors = list(kernel(product_of_random_matrices(3, 3, 2, 6), 6))
    own = [entries[0][0] for entries in vectors]
    assert len(set(own)) == len(own)
    assert all(place not in dict(other) for place in own for other in vectors if other[0][0] != place)


def test_a_matrix_without_rows_annihilates_everything() -> None:
    assert rank([]) == 0
    assert list(kernel([], 2)) == [[(0, 1)], [(1, 1)]]
