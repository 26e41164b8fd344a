"""Exact derivatives by nilpotent numbers, and elementary velocities on the additive group."""

from __future__ import annotations

from itertools import combinations

import pytest

from orderconds.ring import QQ, Polynomials
from orderconds.series.action_fields import ActionFields, Nilpotent
from orderconds.series.action_trees import force, transport, velocity

LEAF = velocity()


@pytest.mark.parametrize("degree", range(6))
def test_mixed_coefficients_of_a_monomial_are_its_derivatives(degree):
    # The coefficient of eps_1 ... eps_k in (x + eps_1 + ... + eps_k)^n is the k-th derivative of x^n.
    x, k = QQ.rational(3), 3
    moved = x + Nilpotent({1: QQ.one}) + Nilpotent({2: QQ.one}) + Nilpotent({4: QQ.one})
    power = Nilpotent({0: QQ.one})
    for _ in range(degree):
        power = power * moved
    derivative = QQ.one
    for n in range(degree, degree - k, -1):
        derivative = derivative * n
    expected = derivative * x ** (degree - k) if degree >= k else QQ.zero
    assert power.parts.get(7, QQ.zero) == expected


def test_squares_of_all_nilpotents_vanish():
    for first, second in combinations([1, 2, 4, 8], 2):
        a, b = Nilpotent({first: 1}), Nilpotent({second: 1})
        assert (a * a).parts == {}
        assert (a * b).parts == (b * a).parts == {first | second: 1}
        assert ((a + b) * (a - b)).parts.get(first | second, 0) == 0


def one_dimensional(hamiltonian):
    """R as matrices (1, q; 0, 1), and the polynomials in q and p as the ring."""
    ring = Polynomials(("q", "p"))
    q, p = ring.generators
    one, zero = ring.one, ring.zero
    return ring, ActionFields(
        ring,
        lambda point, mu: hamiltonian(point[0][1], mu[0]),
        ((one, q), (zero, one)),
        (p,),
        [((zero, one), (zero, zero))],
        lambda m: (m[0][1],),
    )


def H(q, p):
    return p * p * q + q * q * q * p + p * p * p


def test_on_the_line_trees_name_partial_derivatives_applied_to_each_other():
    ring, fields = one_dimensional(H)
    q, p = ring.generators
    h = H(q, p)
    h_q, h_p = h.derivative(0), h.derivative(1)
    assert fields.velocity(LEAF) == (h_p,)
    assert fields.covector(force()) == (h_q,)
    assert fields.velocity(velocity((LEAF,))) == (h_p.derivative(0) * h_p,)
    assert fields.velocity(velocity((LEAF, LEAF), (force(),))) == (
        h_p.derivative(0).derivative(0).derivative(1) * h_p * h_p * h_q,
    )
    assert fields.covector(force((LEAF,), (), (force(),))) == (h_q.derivative(0).derivative(1) * h_p * h_q,)


def test_on_an_abelian_group_nothing_is_transported():
    _, fields = one_dimensional(H)
    assert fields.covector(transport((LEAF,)))[0] == 0
