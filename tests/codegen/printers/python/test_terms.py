"""Terms in Python: names, constants of both formats, conditional expressions."""

from __future__ import annotations

import pytest

from codegen.ir.precision import DOUBLE, SINGLE
from codegen.printers.python.terms import Constants, Terms
from codegen.run.identifiers import Identifiers
from codegen.run.terms import (
    INFINITY,
    OK,
    Kind,
    Term,
    absent,
    all_finite,
    call,
    code,
    given,
    greatest,
    holding,
    largest,
    negated,
    number,
    own,
    real,
    record,
    select,
    truth,
    whole,
)

A, B = real("a"), real("b")
OPTIONAL = real("x", 2, optional=True)
PYTHON = Terms(Identifiers({"lambda": "lambda_"}), Constants(DOUBLE, frozenset()))


@pytest.mark.parametrize(
    ("term", "text"),
    [
        (own("lambda"), "lambda_"),
        (code(OK), "OK"),
        (INFINITY, "inf"),
        (truth(True), "True"),
        (whole(3), "3"),
        (number(3.0), "3.0"),
        (greatest([A, B]), "max(a, b)"),
        (largest(real("x", 7)), "max(map(abs, x))"),
        (call("power", A, number(0.5)), "_power(a, 0.5)"),
        (select(A < B, A, B), "a if a < b else b"),
        (given(OPTIONAL), "x is not None"),
        (negated(given(OPTIONAL)), "x is None"),
        (absent(OPTIONAL), "None"),
        (holding(real("u", 1)), "lambda t: u"),
        (real("x", 9).part(3, 3), "x[3:6]"),
        (record("memory", "memory").field("known", Kind.COUNT), "memory.known"),
        (all_finite(A), "all(map(isfinite, (a,)))"),
    ],
)
def test_text(term: Term, text: str) -> None:
    assert PYTHON.line(term) == text


def test_single_precision_names_each_constant_once() -> None:
    constants = Constants(SINGLE, frozenset({"C1"}))
    terms = Terms(Identifiers({}), constants)
    assert terms.line(A * 0.1 + B * 0.1 - number(0.5)) == "a * C2 + b * C2 - C3"
    assert terms.line(A * -0.1) == "a * -C2"
    assert constants.digits == {"C2": "0.1", "C3": "0.5"}
