"""The conditions are what steps on T*G see, neither more nor less, to order 4: ranks modulo a prime.

Random members of a family take one step for random Hamiltonians, cubic in the entries of q and mu, on
T*SO(3), T*GL(2) and T*U(5), the unitriangular matrices, nilpotent of class 4: exactly, as power series in h
modulo a prime, by iterating the equations of the method. Three ranks, over the methods, are equal in each
order n:

- of the residuals: monomials of degree n in the conditions' left-hand sides, minus their values for the flow;
- of the errors: coefficients of h^n in (q1, mu1) minus the flow's, for all Hamiltonians;
- of both together.

So no error escapes the conditions, and no condition is one too many. Nothing in the steps knows of trees.

An array holds matrices of power series, shape (n, n, ORDER + 1, samples); a sample is a method with a
problem. Covectors are matrices through <P, x> = tr(P x), reduced by ``Space.dual`` to one of each class.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import factorial

import numpy as np
import pytest
from flint import nmod_mat

from orderconds.families import get, in_ring
from orderconds.ring import Residues
from orderconds.series.monomials import products
from orderconds.tableau.methods import CommutatorFree, RungeKutta, Stage

PRIME = 268435399  # below 2^28: sums of 2^7 products fit in 63 bits
ORDER = 4
METHODS = 46  # more than the 37 monomials of degree 4
STAGES = 3
FORMS = 5  # H is a sum of so many cubes of affine functions
BERNOULLI = ((1, 1), (-1, 2), (1, 6), (0, 1), (-1, 30))


def rational(p, q=1):
    return p * pow(q, -1, PRIME) % PRIME


def scale(factor, X):
    return factor * X % PRIME


def add(*terms):
    return sum(terms) % PRIME


def subtract(X, Y):
    return (X - Y) % PRIME


def times_h(X):
    return np.concatenate([np.zeros_like(X[:, :, :1]), X[:, :, :-1]], axis=2)


def mul(X, Y):
    result = np.zeros(np.broadcast_shapes(X.shape, Y.shape), dtype=np.int64)
    for k in range(ORDER + 1):
        for i in range(k + 1):
            result[:, :, k] += np.einsum("ils,ljs->ijs", X[:, :, i], Y[:, :, k - i])
    return result % PRIME


def times_series(f, X):
    """The product of a scalar power series, shape (ORDER + 1, samples), and a matrix."""
    result = np.zeros(np.broadcast_shapes(f.shape, X.shape), dtype=np.int64)
    for k in range(ORDER + 1):
        for i in range(k + 1):
            result[:, :, k] += f[i] * X[:, :, k - i] % PRIME
    return result % PRIME


def commutator(X, Y):
    return subtract(mul(X, Y), mul(Y, X))


def constant(matrices):
    """Lift matrices, shape (n, n, samples), to constant power series."""
    result = np.zeros((*matrices.shape[:2], ORDER + 1, matrices.shape[2]), dtype=np.int64)
    result[:, :, 0] = matrices % PRIME
    return result


def identity(like):
    one = np.zeros_like(like)
    one[range(len(one)), range(len(one)), 0] = 1
    return one


def exp(X):
    result = term = identity(X)
    for k in range(1, ORDER + 1):
        term = scale(rational(1, k), mul(term, X))
        result = add(result, term)
    return result


def inverse(g):
    """1/g for g = 1 + O(h)."""
    one, result = identity(g), identity(g)
    for _ in range(ORDER):
        result = add(one, mul(subtract(one, g), result))
    return result


@dataclass(frozen=True)
class Space:
    """A matrix group; ``basis`` spans its Lie algebra, ``problems`` Hamiltonians tell all methods apart."""

    basis: np.ndarray  # (dimension, n, n)
    problems: int
    skew: bool = False

    def dual(self, P):
        """Reduce a matrix to the covector that it is on the Lie algebra."""
        if self.skew:
            return scale(rational(1, 2), subtract(P, P.swapaxes(0, 1)))
        return P * self.basis.any(axis=0).T[:, :, None, None]

    def Ad_dual(self, g, P):
        return self.dual(mul(mul(inverse(g), P), g))

    def ad_dual(self, x, P):
        return self.dual(commutator(P, x))

    def dexp_dual(self, x, P):
        result = term = P
        for k in range(1, ORDER + 1):
            term = scale(rational(1, k + 1), self.ad_dual(x, term))
            result = add(result, term)
        return result


def unit(n, i, j):
    E = np.zeros((n, n), dtype=np.int64)
    E[i, j] = 1
    return E


SPACES = {
    "SO(3)": Space(
        np.array([unit(3, i, j) - unit(3, j, i) for i, j in ((0, 1), (0, 2), (1, 2))]), 8, skew=True
    ),
    "GL(2)": Space(np.array([unit(2, i, j) for i in range(2) for j in range(2)]), 6),
    "U(5)": Space(np.array([unit(5, i, j) for i in range(5) for j in range(i + 1, 5)]), 4),
}


class Problems:
    """Random cubic Hamiltonians and initial momenta on T*G at q0 = 1, each repeated for every method.

    H = sum_k l_k^3 / 3 with l_k = offset_k + tr(L_k q) + tr(mu X_k).
    """

    def __init__(self, space, methods, generator):
        self.space, d, n = space, len(space.basis), space.basis.shape[1]
        self.samples = methods * space.problems

        def random(*shape):
            return np.tile(generator.integers(0, PRIME, (*shape, space.problems), dtype=np.int64), methods)

        def in_algebra(coordinates):
            return np.einsum("aij,as->ijs", space.basis, coordinates) % PRIME

        self.forms = [
            (random(), constant(random(n, n)), constant(in_algebra(random(d)))) for _ in range(FORMS)
        ]
        self.mu0 = space.dual(constant(random(n, n)))
        self.q0 = identity(self.mu0)
        self.zero = np.zeros_like(self.mu0)

    def field(self, q, mu):
        """xi = D_mu H and n = -(D_q H).q^-1, as a covector."""
        xi, gradient = self.zero, self.zero
        for offset, L, X in self.forms:
            form = (np.trace(mul(L, q)) + np.trace(mul(mu, X))) % PRIME
            form[0] = (form[0] + offset) % PRIME
            square = np.array(
                [sum(form[i] * form[k - i] % PRIME for i in range(k + 1)) % PRIME for k in range(ORDER + 1)]
            )
            xi, gradient = add(xi, times_series(square, X)), add(gradient, times_series(square, L))
        return xi, scale(-1, self.space.dual(mul(q, gradient)))

    def flow(self):
        """Picard iteration of q' = xi q, mu' = n - ad*_xi mu (2.27)."""
        divisors = np.array([rational(1, max(k, 1)) for k in range(ORDER + 1)])[:, None]
        q, mu = self.q0, self.mu0
        for _ in range(ORDER):
            xi, n = self.field(q, mu)
            dq, dmu = mul(xi, q), subtract(n, self.space.ad_dual(xi, mu))
            q = add(self.q0, scale(divisors, times_h(dq)))
            mu = add(self.mu0, scale(divisors, times_h(dmu)))
        return q, mu


def fixed_point(start, improve):
    """Apply ``improve`` until nothing changes; each sweep fixes a power of h or two sweeps do."""
    for _ in range(2 * ORDER + 3):
        state = improve(start)
        if all(
            np.array_equal(x, y)
            for old, new in zip(start, state, strict=True)
            for x, y in zip(old, new, strict=True)
        ):
            return start
        start = state
    raise AssertionError("the stages do not settle")


def partial_products(rows, xi, q0):
    """The exponents of the rows, each a list over the stages, and the places between their exponentials."""
    exponents = [times_h(add(*(scale(c, x) for c, x in zip(row, xi, strict=True)))) for row in rows]
    places = [q0]
    for X in exponents:
        places.append(mul(exp(X), places[-1]))
    return exponents, places


def vcf_step(problem, alpha, beta):
    """The discrete Hamilton equations of VCF: alpha[i] and beta are rows over the stages."""
    space, s = problem.space, range(len(alpha))
    b = [sum(row[i] for row in beta) % PRIME for i in s]
    one_by_b = [modular_inverse(x) for x in b]

    def momentum(xi, M):
        stages = [partial_products(rows, xi, problem.q0) for rows in alpha]
        both = [problem.field(places[-1], m) for (_, places), m in zip(stages, M, strict=True)]
        xi, n = [x for x, _ in both], [y for _, y in both]
        nbar = [space.Ad_dual(places[-1], y) for (_, places), y in zip(stages, n, strict=True)]
        total = add(*(times_h(scale(b[j], nbar[j])) for j in s))
        return stages, xi, nbar, add(problem.mu0, total)  # Ad*_{q0} = 1

    def improve(state):
        xi, M = state
        stages, new_xi, nbar, mubar1 = momentum(xi, M)
        Y, q = partial_products(beta, xi, problem.q0)
        new_M = []
        for i in s:
            total = problem.zero
            for J, row in enumerate(beta):
                moved = space.dexp_dual(Y[J], space.Ad_dual(inverse(q[J + 1]), mubar1))
                total = add(total, scale(row[i], moved))
            for j in s:
                X, Q = stages[j]
                for J, row in enumerate(alpha[j]):
                    moved = space.dexp_dual(X[J], space.Ad_dual(inverse(Q[J + 1]), nbar[j]))
                    total = subtract(total, times_h(scale(b[j] * row[i] % PRIME, moved)))
            new_M.append(scale(one_by_b[i], total))
        return new_xi, new_M

    xi, M = fixed_point(([problem.zero] * len(b), [problem.mu0] * len(b)), improve)
    mubar1 = momentum(xi, M)[-1]
    q1 = partial_products(beta, xi, problem.q0)[1][-1]
    return q1, space.Ad_dual(inverse(q1), mubar1)


def vcg_step(problem, A, b):
    """(3.18): exp(h a_ij xi_j), j = 1, ..., s, one after the other."""
    s, space = range(len(b)), problem.space

    def one_each(row):
        return [[row[j] if k == j else 0 * row[j] for k in s] for j in s]

    def improve(state):
        xi, M, _ = state
        Q = [partial_products(one_each(A[i]), xi, problem.q0)[1] for i in s]
        q = partial_products(one_each(b), xi, problem.q0)[1]
        both = [problem.field(Q[i][-1], M[i]) for i in s]
        new_xi, nbar = [x for x, _ in both], [space.Ad_dual(Q[i][-1], y) for i, (_, y) in enumerate(both)]
        mubar1 = add(problem.mu0, *(times_h(scale(b[j], nbar[j])) for j in s))
        new_M = []
        for i in s:
            total = space.dexp_dual(times_h(scale(b[i], xi[i])), space.Ad_dual(inverse(q[i + 1]), mubar1))
            for j in s:
                moved = space.dexp_dual(
                    times_h(scale(A[j][i], xi[i])), space.Ad_dual(inverse(Q[j][i + 1]), nbar[j])
                )
                factor = b[j] * A[j][i] % PRIME * modular_inverse(b[i]) % PRIME
                total = subtract(total, times_h(scale(factor, moved)))
            new_M.append(total)
        return new_xi, new_M, [q[-1], mubar1]

    start = [problem.zero] * len(b), [problem.mu0] * len(b), [problem.q0, problem.mu0]
    q1, mubar1 = fixed_point(start, improve)[2]
    return q1, space.Ad_dual(inverse(q1), mubar1)


def vrkmk_step(problem, A, b, cutoff):
    """(3.16), with the multipliers lambda."""
    s, space = range(len(b)), problem.space

    def weighted(row, terms):
        return times_h(add(*(scale(c, t) for c, t in zip(row, terms, strict=True))))

    def improve(state):
        X, M, lam, _ = state
        both = [problem.field(exp(X[i]), M[i]) for i in s]
        xi, n = [x for x, _ in both], [y for _, y in both]
        f = [dexpinv(X[i], xi[i], commutator, cutoff) for i in s]
        Y = weighted(b, f)
        mu = add(problem.mu0, weighted(b, [space.Ad_dual(exp(X[i]), n[i]) for i in s]))
        Lambda = space.dexp_dual(scale(-1, Y), mu)
        inner = [add(scale(b[i], Lambda), *(scale(A[j][i], lam[j]) for j in s)) for i in s]
        new_lam = [
            times_h(
                subtract(
                    P_dual(space, X[i], xi[i], inner[i], cutoff), scale(b[i], space.dexp_dual(X[i], n[i]))
                )
            )
            for i in s
        ]
        new_M = [scale(modular_inverse(b[i]), dexpinv(X[i], inner[i], space.ad_dual, cutoff)) for i in s]
        mu1 = space.Ad_dual(exp(scale(-1, Y)), mu)
        return [weighted(row, f) for row in A], new_M, new_lam, [exp(Y), mu1]

    zeros = [problem.zero] * len(b)
    start = zeros, [problem.mu0] * len(b), zeros, [problem.q0, problem.mu0]
    return fixed_point(start, improve)[3]


def dexpinv(x, y, ad, cutoff):
    """sum_{k <= r} B_k/k! ad_x^k y, with the ad of vectors or of covectors."""
    result = term = y
    for k in range(1, cutoff + 1):
        term = ad(x, term)
        result = add(result, scale(rational(BERNOULLI[k][0], BERNOULLI[k][1] * factorial(k)), term))
    return result


def P_dual(space, x, xi, P, cutoff):
    """P*_(r)(x, xi) of Section 3.4: ad*_xi/2 - sum B_k/k! sum_i ad*_{ad_x^{k-1-i} xi} (ad*_x)^i."""
    if cutoff == 0:
        return np.zeros_like(P)
    result = scale(rational(1, 2), space.ad_dual(xi, P))
    for k in range(2, cutoff + 1):
        for i in range(k):
            inner, moved = xi, P
            for _ in range(k - 1 - i):
                inner = commutator(x, inner)
            for _ in range(i):
                moved = space.ad_dual(x, moved)
            factor = rational(-BERNOULLI[k][0], BERNOULLI[k][1] * factorial(k))
            result = add(result, scale(factor, space.ad_dual(inner, moved)))
    return result


def modular_inverse(x):
    return np.array([pow(int(v), -1, PRIME) for v in x], dtype=np.int64)


def random_method(label, ring, generator):
    def row(length):
        return tuple(ring.random(generator) for _ in range(length))

    if label == "vcf":  # as many exponentials as can make a difference
        stages = tuple(Stage(None, (row(STAGES), row(STAGES))) for _ in range(STAGES))
        return CommutatorFree(stages, Stage(None, (row(STAGES), row(STAGES), row(STAGES))))
    return RungeKutta(tuple(row(STAGES) for _ in range(STAGES)), row(STAGES))


def take_step(label, method, problem):
    repeats = problem.samples // METHODS

    def numbers(rows):
        return [[np.repeat(x.values, repeats) for x in row] for row in rows]

    if label == "vcf":
        alpha = [numbers(stage.exponentials) for stage in method.stages]
        return vcf_step(problem, alpha, numbers(method.update.exponentials))
    A, (b,) = numbers(method.A), numbers([method.b])
    if label == "vcg":
        return vcg_step(problem, A, b)
    return vrkmk_step(problem, A, b, int(label[6:-1]) if "(" in label else ORDER)


def residual_columns(family, method, ring):
    """For each order, the monomials in the conditions' values minus the same monomials of the flow."""
    generators, exact, columns = [], [], []
    for n in range(1, ORDER + 1):
        conditions = family.conditions(n)
        values = family.evaluate(method, ring, conditions)
        generators += [(n, x) for x in values]
        exact += [(n, in_ring(ring, c.rhs)) for c in conditions]
        pairs = zip(products(generators, n), products(exact, n), strict=True)
        columns.append(np.array([(x - y).values for x, y in pairs]))
    return columns


def error_columns(label, method, space, generator):
    problem = Problems(space, METHODS, generator)
    pairs = zip(take_step(label, method, problem), problem.flow(), strict=True)
    errors = [subtract(x, y) for x, y in pairs]
    return [
        np.concatenate(
            [
                e[:, :, n].reshape(-1, METHODS, space.problems).swapaxes(1, 2).reshape(-1, METHODS)
                for e in errors
            ]
        )
        for n in range(1, ORDER + 1)
    ]


def rank(columns):
    return nmod_mat(*columns.shape, columns.ravel().tolist(), PRIME).rank()


MONOMIALS = {
    "vcg": [1, 2, 8, 34],
    "vcf": [1, 2, 8, 37],
    "vrkmk": [1, 2, 5, 14],
    "vrkmk(0)": [1, 2, 6, 15],
    "vrkmk(1)": [1, 2, 5, 15],
    "vrkmk(2)": [1, 2, 5, 14],
}


QUICK = {("vcg", "U(5)"), *((label, "SO(3)") for label in MONOMIALS if label != "vcg")}
"""One group for each family in the quick run; the slow run takes all groups."""


@pytest.mark.parametrize(
    ("label", "group"),
    [
        pytest.param(label, group, marks=() if (label, group) in QUICK else pytest.mark.slow)
        for label in MONOMIALS
        for group in SPACES
    ],
)
def test_residuals_errors_and_both_have_equal_ranks_in_every_order_to_four(label, group):
    generator = np.random.default_rng(4)
    ring = Residues(PRIME, METHODS)
    method = random_method(label, ring, generator)
    residuals = residual_columns(get(label), method, ring)
    errors = error_columns(label, method, SPACES[group], generator)
    found = [(rank(r), rank(e), rank(np.concatenate([r, e]))) for r, e in zip(residuals, errors, strict=True)]
    assert found == [(n, n, n) for n in MONOMIALS[label]]
