"""Terms in C: literals of the format, pointers, tests for finite values."""

from __future__ import annotations

import pytest

from codegen.ir.precision import DOUBLE, SINGLE
from codegen.printers.c.terms import Terms, literal
from codegen.run.identifiers import Identifiers
from codegen.run.terms import (
    INFINITY,
    OK,
    Kind,
    Term,
    all_finite,
    both,
    code,
    count,
    either,
    given,
    greatest,
    largest,
    narrow,
    negated,
    number,
    own,
    real,
    record,
    select,
    size,
    wide,
)

A, B, C = map(real, "abc")
MEMORY = record("memory", "memory")
C_TERMS = Terms(Identifiers({"double": "double_"}), DOUBLE, "m_", {"memory"})
SINGLES = Terms(Identifiers({}), SINGLE, "m_", ())


@pytest.mark.parametrize(
    ("term", "text"),
    [
        (own("double"), "double_"),
        (code(OK), "M_OK"),
        (INFINITY, "(double)INFINITY"),
        (size(A), "fabs(a)"),
        (greatest([A, B]), "m_greater(a, b)"),
        (largest(real("x", 7)), "m_largest(x, 7)"),
        (select(A < B, A, B), "a < b ? a : b"),
        (negated(A < B), "!(a < b)"),
        (either(both(A < B, B < C), C < A), "(a < b && b < c) || c < a"),
        (both(given(real("x", 2, optional=True)), A < B), "x != NULL && a < b"),
        (real("x", 9).part(3, 3), "x + 3"),
        (real("x", 9)[2], "x[2]"),
        (real("t", 1, cell=True)[0], "*t"),
        (MEMORY.field("known", Kind.COUNT), "memory->known"),
        (record("other", "memory").field("known", Kind.COUNT), "other.known"),
        (all_finite(real("x", 3)), "m_all_finite(x, 3)"),
        (wide(count("n")), "(double)n"),
        (narrow(A), "a"),
    ],
)
def test_text(term: Term, text: str) -> None:
    assert C_TERMS.line(term) == text


def test_single_precision_has_its_own_functions_and_literals() -> None:
    assert SINGLES.line(size(A) * number(0.5)) == "fabsf(a) * 0.5f"
    assert SINGLES.line(narrow(wide(A))) == "(float)(double)a"
    assert literal(SINGLE, 0.1) == "0.1f"


def test_several_values_need_one_test_unless_their_sum_overflows() -> None:
    text = C_TERMS.line(all_finite(A, B, C))
    assert text == "isfinite(a + b + c) || a - a + (b - b) + (c - c) == 0.0"


def test_rows_of_a_caller_lie_one_after_the_other() -> None:
    rows = real("rows", 0, 4, optional=True)
    assert C_TERMS.line(rows[count("k")]) == "rows + 4 * k"
    assert C_TERMS.line(rows[count("k")][2]) == "rows[4 * k + 2]"
