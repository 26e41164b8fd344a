"""Infix text has the structure of its term: what a parser reads back is the same tree."""

from __future__ import annotations

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from codegen.ir.precision import DOUBLE
from codegen.printers.infix import PRODUCT, SUM, Text, closed, joined
from codegen.printers.python.terms import Constants, Terms
from codegen.run.identifiers import Identifiers
from codegen.run.terms import Kind, Term, both, either, negated, real, select

PYTHON = Terms(Identifiers({}), Constants(DOUBLE, frozenset()))
A, B, C = map(real, "abc")
OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}


def reals(names: str = "abc") -> st.SearchStrategy[Term]:
    def larger(inner: st.SearchStrategy[Term]) -> st.SearchStrategy[Term]:
        binary = st.builds(lambda op, x, y: Term(op, (x, y)), st.sampled_from("+-*/"), inner, inner)
        return binary | inner.map(lambda x: -x)

    return st.recursive(st.sampled_from([real(n) for n in names]), larger, max_leaves=12)


def structure(term: Term) -> object:
    """The tree of a term; tests are reduced to their operators."""
    if term.op == "name":
        return term.text
    return (term.op, *map(structure, term.args))


def parsed(node: ast.expr) -> object:
    """The tree of a Python expression in the same form."""
    match node:
        case ast.Name(name):
            return name
        case ast.UnaryOp(ast.USub(), x):
            return ("neg", parsed(x))
        case ast.UnaryOp(ast.Not(), x):
            return ("not", parsed(x))
        case ast.BinOp(x, op, y):
            return (OPERATORS[type(op)], parsed(x), parsed(y))
        case ast.Compare(x, [ast.Lt()], [y]):
            return ("<", parsed(x), parsed(y))
        case ast.BoolOp(op, values):
            word = "and" if isinstance(op, ast.And) else "or"
            first, *rest = map(parsed, values)
            for value in rest:
                first = (word, first, value)
            return first
        case ast.IfExp(test, yes, no):
            return ("select", parsed(test), parsed(yes), parsed(no))
    raise AssertionError(ast.dump(node))


@given(reals())
def test_arithmetic_is_never_regrouped(term: Term) -> None:
    assert parsed(ast.parse(PYTHON.line(term), mode="eval").body) == structure(term)


@given(reals(), reals(), reals())
def test_tests_and_choices_keep_their_structure(x: Term, y: Term, z: Term) -> None:
    term = select(either(both(x < y, negated(y < z)), z < x), select(x < z, x, y), z)
    assert parsed(ast.parse(PYTHON.line(term), mode="eval").body) == structure(term)


@pytest.mark.parametrize(
    ("term", "text"),
    [
        (A * B + C, "a * b + c"),
        (A - (B - C), "a - (b - c)"),
        (A - B - C, "a - b - c"),
        (A * (B + C), "a * (b + c)"),
        (-(A + B), "-(a + b)"),
        (-A * B, "-a * b"),
    ],
)
def test_parentheses_are_as_few_as_precedence_allows(term: Term, text: str) -> None:
    assert PYTHON.line(term) == text


def test_a_weaker_operation_has_parentheses_within_a_stronger() -> None:
    assert Text(("a", "+ b"), SUM).within(PRODUCT) == ("(a", "+ b)")
    assert Text(("a", "+ b"), SUM).within(SUM) == ("a", "+ b")


def test_segments_lose_no_text() -> None:
    assert closed("f(", ("a,", "b"), ")") == ("f(a,", "b)")
    assert closed("f(", ("a",), ")") == ("f(a)",)
    assert joined(("a", "+ b"), 5) == ("a + b",)
    assert joined(("a", "+ b"), 4) == ("a", "+ b")


def test_a_comparison_is_a_flag() -> None:
    assert (A < B).kind is Kind.FLAG
