"""Conditions of CG, CF and RKMK are what steps on groups see, neither more nor less, to order 4.

Random members of a family take one step of y' = f(y) y from the unit of SO(3), GL(2) and U(5), the
unitriangular matrices (nilpotent of class 4), for random cubic f: exactly, as power series in h modulo a
prime, by iterating the equations of the method. Over the methods three ranks are equal in each order n: of
monomials of degree n in the conditions' left-hand sides, less their values for the flow; of the coefficients
of h^n in step minus flow, for all problems; of both together. Nothing in the steps knows of trees.

An array holds matrices of power series, shape (size, size, ORDER + 1, methods).
"""

from math import factorial

import numpy as np
import pytest
from flint import nmod_mat

from orderconds import families
from orderconds.families import in_ring
from orderconds.ring import Residues
from orderconds.series.monomials import products
from orderconds.tableau import CommutatorFree, RungeKutta, Stage
from orderconds.trees.counts import ordered_forest_count, rooted_tree_count

PRIME = 268435399  # below 2^28: sums of 2^7 products fit in 63 bits
ORDER = 4
METHODS = 24  # more than the 14 monomials of degree 4
STAGES = 4
BERNOULLI = ((1, 1), (-1, 2), (1, 6), (0, 1), (-1, 30))


def rational(p, q=1):
    return p * pow(q, -1, PRIME) % PRIME


def mul(x, y):
    result = np.zeros((x.shape[0], y.shape[1], ORDER + 1, METHODS), dtype=np.int64)
    for k in range(ORDER + 1):
        for i in range(k + 1):
            result[:, :, k] += np.einsum("ils,ljs->ijs", x[:, :, i], y[:, :, k - i])
    return result % PRIME


def entrywise(x, y):
    """The product of two scalar series, shape (ORDER + 1, methods)."""
    return mul(x[None, None], y[None, None])[0, 0]


def shifted(x):
    """h x."""
    return np.concatenate([np.zeros_like(x[:, :, :1]), x[:, :, :-1]], axis=2)


def unit(size):
    result = np.zeros((size, size, ORDER + 1, METHODS), dtype=np.int64)
    result[range(size), range(size), 0] = 1
    return result


def exponential(x):
    result = term = unit(len(x))
    for n in range(1, ORDER + 1):
        term = mul(term, x) * rational(1, n) % PRIME
        result = (result + term) % PRIME
    return result


def dexpinv(u, x):
    result = term = x
    for n in range(1, ORDER + 1):
        term = (mul(u, term) - mul(term, u)) % PRIME
        p, q = BERNOULLI[n]
        result = (result + rational(p, q * factorial(n)) * term) % PRIME
    return result


def basis(group):
    """Matrices that span the Lie algebra."""
    if group == "SO(3)":
        pairs, sign = [(0, 1), (0, 2), (1, 2)], -1
        size = 3
    elif group == "GL(2)":
        pairs, sign, size = [(0, 0), (0, 1), (1, 0), (1, 1)], 0, 2
    else:
        pairs, sign, size = [(i, j) for i in range(5) for j in range(i + 1, 5)], 0, 5
    found = []
    for i, j in pairs:
        matrix = np.zeros((size, size), dtype=np.int64)
        matrix[i, j] = 1
        if sign:
            matrix[j, i] = sign
        found.append(matrix)
    return found


class Problem:
    """f(y) = sum_k E_k p_k(y), p_k a product of three affine functions of the entries of y."""

    def __init__(self, group, generator):
        self.basis = basis(group)
        self.size = len(self.basis[0])
        self.affine = generator.integers(0, PRIME, (len(self.basis), 3, self.size**2 + 1))

    def field(self, y):
        result = np.zeros_like(y)
        entries = [y[i, j] for i in range(self.size) for j in range(self.size)]
        for matrix, forms in zip(self.basis, self.affine, strict=True):
            value = np.zeros((ORDER + 1, METHODS), dtype=np.int64)
            value[0] = 1
            for *scales, constant in forms:
                form = sum(scale * entry % PRIME for scale, entry in zip(scales, entries, strict=True))
                form[0] += constant
                value = entrywise(value, form % PRIME)
            result = (result + matrix[:, :, None, None] * value) % PRIME
        return result

    def flow(self):
        y = unit(self.size)
        for _ in range(ORDER):
            slope = shifted(mul(self.field(y), y))
            for n in range(1, ORDER + 1):
                slope[:, :, n] = slope[:, :, n] * rational(1, n) % PRIME
            y = (unit(self.size) + slope) % PRIME
        return y


def combined(row, values):
    return sum(x.values * value % PRIME for x, value in zip(row, values, strict=True)) % PRIME


def exponentials_step(method, problem):
    """A commutator-free method as defined; a sweep makes one more power of h right in every stage."""
    k = [np.zeros_like(unit(problem.size))] * method.s
    y = unit(problem.size)
    for _ in range(ORDER + 1):
        points = []
        for stage in (*method.stages, method.update):
            y = unit(problem.size) if stage.start is None else points[stage.start]
            for row in stage.exponentials:
                y = mul(exponential(shifted(combined(row, k))), y)
            points.append(y)
        k = [problem.field(y) for y in points[:-1]]
    return y


def munthe_kaas_step(method, problem):
    pulled, y = [np.zeros_like(unit(problem.size))] * method.s, unit(problem.size)
    for _ in range(ORDER + 1):
        arguments = [shifted(combined(row, pulled)) for row in (*method.A, method.b)]
        y = exponential(arguments[-1])
        pulled = [dexpinv(u, problem.field(exponential(u))) for u in arguments[:-1]]
    return y


def random_method(name, ring, generator):
    def row():
        return tuple(ring.random(generator) for _ in range(STAGES))

    if name == "cf":
        stages = [Stage(None, (row(),)), Stage(0, (row(),)), Stage(None, (row(), row())), Stage(1, (row(),))]
        return CommutatorFree(tuple(stages), Stage(None, (row(), row(), row())))
    return RungeKutta(tuple(row() for _ in range(STAGES)), row())


def rank(columns):
    matrix = np.stack(columns, axis=1) % PRIME
    return nmod_mat(*matrix.shape, matrix.ravel().tolist(), PRIME).rank()


@pytest.fixture(scope="module")
def problems():
    generator = np.random.default_rng(1999)
    return [Problem(group, generator) for group in ("SO(3)", "GL(2)", "U(5)") for _ in range(3)]


@pytest.mark.parametrize("name", ["cg", "cf", "rkmk"])
def test_residuals_and_errors_span_the_same_space_of_functions_of_the_method(name, problems):
    generator, ring = np.random.default_rng(42), Residues(PRIME, METHODS)
    method, family = random_method(name, ring, generator), families.get(name)
    step = munthe_kaas_step if name == "rkmk" else exponentials_step
    read = method.as_crouch_grossman(ring) if name == "cg" else method
    errors = [(step(read, problem) - problem.flow()) % PRIME for problem in problems]
    values, exact = [], []
    for n in range(1, ORDER + 1):
        conditions = family.conditions(n)
        left = family.evaluate(method, ring, conditions)
        values += [(n, x) for x in left]
        exact += [(n, in_ring(ring, c.rhs)) for c in conditions]
        residuals = [(x - y).values for x, y in zip(products(values, n), products(exact, n), strict=True)]
        coefficients = [x for error in errors for x in error[:, :, n].reshape(-1, METHODS)]
        ranks = rank(residuals), rank(coefficients), rank([*residuals, *coefficients])
        assert ranks[0] == ranks[1] == ranks[2]
        # Munthe-Kaas methods see rooted forests only, as many as there are trees with one vertex more.
        assert ranks[0] == (rooted_tree_count(n + 1) if name == "rkmk" else ordered_forest_count(n))


def test_one_condition_left_out_is_missed_by_the_errors_that_it_governs(problems):
    generator, ring = np.random.default_rng(42), Residues(PRIME, METHODS)
    method, family = random_method("cg", ring, generator), families.get("cg")
    errors = [exponentials_step(method.as_crouch_grossman(ring), p) - p.flow() for p in problems]
    conditions = [c for n in (1, 2, 3) for c in family.conditions(n)][:-1]
    values = [
        (c.order, x) for c, x in zip(conditions, family.evaluate(method, ring, conditions), strict=True)
    ]
    exact = [(c.order, in_ring(ring, c.rhs)) for c in conditions]
    residuals = [(x - y).values for x, y in zip(products(values, 3), products(exact, 3), strict=True)]
    coefficients = [x for error in errors for x in error[:, :, 3].reshape(-1, METHODS)]
    assert rank(residuals) < rank(coefficients) == rank([*residuals, *coefficients])
