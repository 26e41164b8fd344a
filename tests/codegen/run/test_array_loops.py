"""Loops over arrays compute what array programs state: the executor and the evaluation agree exactly."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from codegen.ir.array_program import (
    COLUMN,
    ROW,
    Apply,
    Combination,
    ConstantMatrix,
    Diagonal,
    Matrix,
    Multiplication,
    Term,
    evaluated,
)
from codegen.ir.array_step import AddUnit
from codegen.ir.expr import Space
from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE
from codegen.run.array_loops import ArrayLoops, tables
from codegen.run.execute import Machine
from codegen.run.language import Function, Unit
from codegen.run.terms import real


class Fractions:
    """Exact rational numbers as a domain."""

    h = Fraction(1, 3)

    def rational(self, p, q=1):
        return Fraction(p, q)

    def number(self, value):
        return value.fraction()


SPACE = Space()
ROW_NUMBER, COLUMN_NUMBER = SPACE.sym(ROW), SPACE.sym(COLUMN)
HALF = SPACE.const(Number.rational(1, 2))
ENTRIES = (HALF, SPACE.add(SPACE.mul(HALF, ROW_NUMBER), COLUMN_NUMBER))
sizes = st.integers(1, 6)


def executed(statement, arrays, constants=()):
    """Return the array of the target after execution of the loops."""
    terms = {name: real(name, len(values)) for name, values in arrays.items()}
    body = tuple(ArrayLoops(dict(terms)).statements(statement))
    function = Function("loops", "", tuple(terms.values()), body)
    machine = Machine(Unit((), (), tuple(tables(constants, DOUBLE)), (function,)), Fractions())
    copies = {name: list(values) for name, values in arrays.items()}
    machine.call("loops", *copies.values())
    return copies[statement.target.name]


def agree(statement, arrays, constants=()):
    expected = {name: list(values) for name, values in arrays.items()}
    evaluated(statement, Fractions(), expected, {})
    assert executed(statement, arrays, constants) == expected[statement.target.name]


def numbers(draw, matrix):
    """Return an array that contains a matrix, with different entries also outside the matrix."""
    size = matrix.place(matrix.rows - 1, matrix.columns - 1) + 2
    seed = draw(st.integers(1, 50))
    return [Fraction((seed * (k + 1) * (k + 3)) % 17 - 8, 4) for k in range(size)]


@st.composite
def matrices(draw, name, rows, columns):
    gap, start = draw(st.integers(0, 2)), draw(st.integers(0, 3))
    matrix = Matrix(name, rows, columns, start, columns + gap)
    return matrix, numbers(draw, matrix)


@given(st.data(), sizes, sizes, sizes, st.booleans(), st.booleans(), st.booleans())
def test_loops_multiply_matrices(data, rows, inner, columns, turned, other_turned, added):
    target, c = data.draw(matrices("c", rows, columns))
    left, a = data.draw(matrices("a", *((inner, rows) if turned else (rows, inner))))
    right, b = data.draw(matrices("b", *((columns, inner) if other_turned else (inner, columns))))
    statement = Multiplication(target, left, right, turned, other_turned, added)
    agree(statement, {"c": c, "a": a, "b": b})


@given(st.data(), sizes, sizes, sizes, st.booleans(), st.booleans(), st.sampled_from((0, 1, "numbers")))
def test_loops_multiply_by_banded_and_full_matrices(data, rows, columns, width, turned, from_right, kind):
    offsets = data.draw(st.lists(st.integers(1 - rows, columns - 1), max_size=3, unique=True))
    plain = ConstantMatrix("m", rows, columns)

    def entry(count):
        values = tuple(Number.rational(k * k - 3, 2) for k in range(count))
        return values if kind == "numbers" else ENTRIES[kind]

    diagonals = tuple(Diagonal(o, entry(plain.length(Diagonal(o, ())))) for o in offsets)
    constant = ConstantMatrix("m", rows, columns, diagonals, entry(rows * columns))
    high, low = (columns, rows) if turned else (rows, columns)
    sizes_of = ((width, low), (width, high)) if from_right else ((high, width), (low, width))
    target, c = data.draw(matrices("c", *sizes_of[0]))
    matrix, a = data.draw(matrices("a", *sizes_of[1]))
    agree(Apply(target, constant, matrix, turned, from_right), {"c": c, "a": a}, (constant,))


@given(st.data(), sizes, sizes, st.lists(st.sampled_from((1, -1, 3)), max_size=3))
def test_loops_add_matrices_of_different_sizes(data, rows, columns, coefficients):
    target, c = data.draw(matrices("c", rows, columns))
    arrays, terms = {"c": c}, []
    for n, coefficient in enumerate(coefficients):
        high, low = data.draw(st.integers(1, rows)), data.draw(st.integers(1, columns))
        turned = data.draw(st.booleans())
        matrix, arrays[f"a{n}"] = data.draw(matrices(f"a{n}", *((low, high) if turned else (high, low))))
        terms.append(Term(SPACE.const(Number.rational(coefficient)), matrix, turned))
    agree(Combination(target, tuple(terms)), arrays)


@pytest.mark.parametrize("value", [1, -1])
def test_a_loop_adds_the_unit_matrix(value):
    array = executed(AddUnit(Matrix("c", 2, 2, 1, 3), value), {"c": [Fraction(0)] * 6})
    assert array == [0, value, 0, 0, 0, value]
