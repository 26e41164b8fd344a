"""Polynomials in graded letters, and linear systems over a ring."""

from math import factorial

from orderconds.ring import QQ
from orderconds.series.graded import GradedAlgebra, solve


def test_a_system_without_solution_has_none_and_earlier_columns_serve_first():
    one = QQ.one
    assert solve(QQ, [{"x": one}], {"y": one}) is None
    assert solve(QQ, [{"x": one}, {"x": one, "y": one}, {"y": one}], {"y": one}) == [-one, one, QQ.zero]


def letters(algebra, count):
    return [{(n,): QQ.one} for n in range(count)]


def test_brackets_satisfy_jacobis_identity_and_vanish_above_the_largest_grade():
    algebra = GradedAlgebra(QQ, (1, 1, 2), 4)
    x, y, z = letters(algebra, 3)
    bracket, one = algebra.bracket, QQ.one
    cyclic = algebra.combine(
        (one, bracket(x, bracket(y, z))), (one, bracket(y, bracket(z, x))), (one, bracket(z, bracket(x, y)))
    )
    assert cyclic == {}
    assert bracket(x, bracket(y, z)) != {}
    assert GradedAlgebra(QQ, (1, 1, 2), 3).bracket(x, bracket(y, z)) == {}


def test_products_are_associative_and_cut():
    algebra = GradedAlgebra(QQ, (1, 2), 4)
    x, y = letters(algebra, 2)
    both = algebra.combine((QQ.one, x), (QQ.rational(2), y))
    one_way = algebra.multiply(algebra.multiply(both, both), both)
    assert one_way == algebra.multiply(both, algebra.multiply(both, both))
    assert max(map(algebra.grade, one_way)) == 4
    assert algebra.cut(one_way, 3) == {(0, 0, 0): QQ.one}


def test_dexpinv_inverts_dexp():
    algebra = GradedAlgebra(QQ, (1, 1), 6)
    u, x = letters(algebra, 2)
    dexp, term = dict(x), dict(x)
    for k in range(1, 6):
        term = algebra.bracket(u, term)
        dexp = algebra.combine((QQ.one, dexp), (QQ.rational(1, factorial(k + 1)), term))
    assert algebra.dexpinv(u, dexp) == x
