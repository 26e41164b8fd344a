"""The order of VRKMK(r) is min(p, R + 2): R = r for r = 0 and odd r, r + 1 for even r >= 2, to order 7."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq, nmod_mat, nmod_poly

from orderconds.families import get
from orderconds.ring import Residues
from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES
from orderconds.series import action_exact
from orderconds.series.action_lie import MuntheKaasActionSeries
from orderconds.series.action_switching import representatives
from orderconds.series.monomials import products
from orderconds.tableau import Tableau, find
from orderconds.tableau.methods import RungeKutta
from tests.oracles.dexpinv_cutoff import highest_order, witness


def rule(cutoff):
    return 2 + (cutoff + 1 if cutoff >= 2 and cutoff % 2 == 0 else cutoff)


@pytest.mark.parametrize("cutoff", [0, 1, 2, 3])
def test_cutting_dexpinv_leaves_this_order(cutoff):
    assert highest_order(cutoff, limit=6) == rule(cutoff)


@pytest.mark.slow
@pytest.mark.parametrize("cutoff", [4, 5])
def test_cutting_dexpinv_after_the_fourth_or_fifth_power_leaves_order_seven(cutoff):
    assert highest_order(cutoff, limit=8) == rule(cutoff) == 7


@pytest.mark.parametrize(
    ("cutoff", "names", "expected"),
    [
        (0, ("gauss2", "gauss3", "triple_jump", "triple_jump6"), fmpq(1, 12)),
        (1, ("gauss2", "gauss3", "triple_jump", "triple_jump6"), fmpq(-1, 96)),
        (2, ("gauss3", "triple_jump6"), fmpq(1, 8640)),
        (3, ("gauss3", "triple_jump6"), fmpq(1, 8640)),
    ],
)
def test_the_defect_one_order_higher_is_one_constant_for_all_tableaux_of_that_order(cutoff, names, expected):
    tree = witness(rule(cutoff) + 1)
    exact = action_exact.condition(tree)
    for name in names:
        tableau = Tableau.load(find(name))
        value = get("vrkmk", cutoff=cutoff).series(tableau.read_as(("rk",)), tableau.ring).condition(tree)
        defect = value - tableau.ring.rational(exact.numerator, exact.denominator)
        assert defect == tableau.ring.rational(int(expected.p), int(expected.q)), name


def values_and_sprk_monomials(cutoff, order, samples):
    """Of one order, over random tableaux and last the flow: the values of VRKMK, the monomials of SPRK."""
    ring, generator = Residues(PRIMES[0], samples), np.random.default_rng(cutoff)
    rows = [tuple(ring.random(generator) for _ in range(order)) for _ in range(order + 1)]
    method, sprk = RungeKutta(tuple(rows[:-1]), rows[-1]), get("sprk")
    series = MuntheKaasActionSeries(ring, method.A, method.b, cutoff)

    def with_flow(values, exact):
        for value, q in zip(values, exact, strict=True):
            flow = ring.rational(q.numerator, q.denominator).values[-1:]
            yield ring.element(np.concatenate([value.values[:-1], flow]))

    graded = []
    for n in range(1, order + 1):
        conditions = sprk.conditions(n)
        values = sprk.evaluate(method, ring, conditions)
        graded += [(n, x) for x in with_flow(values, [c.rhs for c in conditions])]
    trees = representatives(order)
    values = with_flow(map(series.condition, trees), map(action_exact.condition, trees))
    return list(values), list(products(graded, order))


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5, pytest.param(6, marks=pytest.mark.slow)])
def test_uncut_each_value_is_a_polynomial_in_those_of_sprk_for_methods_and_the_flow(order):
    values, monomials = values_and_sprk_monomials(None, order, samples=240)
    assert len(pivot_columns(monomials)) == len(monomials) == len(pivot_columns([*monomials, *values]))


@pytest.mark.parametrize(
    ("cutoff", "order"), [(0, 4), (1, 4), (2, 5), pytest.param(2, 6, marks=pytest.mark.slow)]
)
def test_cut_each_value_is_a_polynomial_in_those_of_sprk_for_methods(cutoff, order):
    values, monomials = values_and_sprk_monomials(cutoff, order, samples=240)
    first, *rest = (x.values[:-1] for x in (*monomials, *values))
    ring = Residues(PRIMES[0], len(first))
    columns = [ring.element(x) for x in (first, *rest)]
    count = len(monomials)
    assert len(pivot_columns(columns[:count])) == count == len(pivot_columns(columns))


def gauss_modulo_a_prime(stages):
    """The Gauss tableau where the nodes, roots of a Legendre polynomial, are residues; HLW (II.1.13)."""
    prime = 2**30
    while True:
        prime += 1
        if any(prime % k == 0 for k in range(2, 2**15 + 1)):
            continue
        n = stages  # shifted Legendre: sum_k (-1)^k binom(n, k) binom(n + k, k) x^k
        coefficients, term = [], 1
        for k in range(n + 1):
            coefficients.append(term % prime)
            term = -term * (n - k) * (n + k + 1) // (k + 1) ** 2
        _, factors = nmod_poly(coefficients, prime).factor()
        if len(factors) == n:
            nodes = [-int(f[0]) * pow(int(f[1]), -1, prime) % prime for f, _ in factors]
            return prime, collocation(nodes, prime)


def collocation(nodes, prime):
    s = len(nodes)
    powers = nmod_mat(s, s, [pow(c, k, prime) for k in range(s) for c in nodes], prime)

    def weights(x):
        moments = [pow(x, k + 1, prime) * pow(k + 1, -1, prime) % prime for k in range(s)]
        solved = powers.solve(nmod_mat(s, 1, moments, prime))
        return [int(solved[i, 0]) for i in range(s)]

    return [weights(c) for c in nodes], weights(1)


@pytest.mark.parametrize("cutoff", [0, 1, 2, 3, *(pytest.param(r, marks=pytest.mark.slow) for r in (4, 5))])
def test_order_of_the_gauss_method_of_order_eight(cutoff):
    """Evaluated on all trees, in a finite field in which the tableau lives; the witness ends the order."""
    prime, (A, b) = gauss_modulo_a_prime(4)
    ring = Residues(prime, 1)
    method = RungeKutta(tuple(tuple(map(ring.rational, row)) for row in A), tuple(map(ring.rational, b)))
    family = get("vrkmk", cutoff=cutoff)
    for order in range(1, rule(cutoff) + 1):
        assert all(map(ring.is_zero, family.residuals(method, ring, family.decisive_conditions(order))))
    tree = witness(rule(cutoff) + 1)
    exact = action_exact.condition(tree)
    found = family.series(method, ring).condition(tree)
    assert not ring.is_zero(found - ring.rational(exact.numerator, exact.denominator))
