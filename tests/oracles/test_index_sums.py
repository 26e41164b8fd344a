"""The oracle of printed conditions, on sums that can be done by hand."""

from orderconds.formula import (
    Power,
    coefficient,
    index_sum,
    product,
)
from orderconds.ring import QQ
from tests.oracles.index_sums import runge_kutta_value


def b(i):
    return coefficient("b", i)


def a(i, j):
    return coefficient("a", i, j)


def test_brute_force_sums_straight_from_the_definition():
    A = [[QQ.rational(1), QQ.rational(2)], [QQ.rational(3), QQ.rational(4)]]
    weights = [QQ.rational(1, 2), QQ.rational(-1, 3)]
    strict = index_sum(("x", "y"), (("x", "<", "y"),), product(b("x"), a("x", "y")))
    assert runge_kutta_value(strict, QQ, A, weights) == QQ.rational(1)
    weak = index_sum(("x", "y"), (("x", "<=", "y"),), product(b("x"), a("x", "y")))
    assert runge_kutta_value(weak, QQ, A, weights) == QQ.rational(1) + QQ.rational(1, 2) - QQ.rational(4, 3)
    inverse = index_sum(("x",), (), Power(b("x"), -1))
    assert runge_kutta_value(inverse, QQ, A, weights) == QQ.rational(-1)


def test_derived_coefficients_are_those_of_the_symplectic_partner():
    A = [[QQ.rational(1), QQ.rational(2)], [QQ.rational(3), QQ.rational(4)]]
    weights = [QQ.rational(1, 2), QQ.rational(1, 4)]
    # b_i ahat_ij + b_j a_ji = b_i b_j, summed over i and j.
    left = index_sum(("x", "y"), (), product(b("x"), coefficient("ahat", "x", "y")))
    right = index_sum(("x", "y"), (), product(b("y"), a("y", "x")))
    both = runge_kutta_value(left, QQ, A, weights) + runge_kutta_value(right, QQ, A, weights)
    assert both == QQ.rational(9, 16)
    by_nodes = index_sum(("x",), (), product(b("x"), coefficient("chat", "x")))
    assert runge_kutta_value(by_nodes, QQ, A, weights) == runge_kutta_value(left, QQ, A, weights)
