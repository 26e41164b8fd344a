"""Polynomials in graded letters, and linear systems over a ring."""

from orderconds.ring import QQ
from orderconds.series.graded import solve


def test_a_system_without_solution_has_none_and_earlier_columns_serve_first():
    one = QQ.one
    assert solve(QQ, [{"x": one}], {"y": one}) is None
    assert solve(QQ, [{"x": one}, {"x": one, "y": one}, {"y": one}], {"y": one}) == [-one, one, QQ.zero]
