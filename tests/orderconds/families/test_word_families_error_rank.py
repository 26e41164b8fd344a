"""The conditions of an order span the coefficients of the exact local error of random methods, and no more.

Modulo a prime: the rank of the residuals of all conditions of order n over random methods is that of the
error's coefficients of h^n on GL(3), and so is the rank of both together. Matrices of SO(3) and unipotent
ones satisfy more identities: there the residuals still determine the errors.
"""

import random

import numpy as np
import pytest

from orderconds import families
from orderconds.families.rkn import functionals
from orderconds.ring import PowerSeries, Residues
from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES
from orderconds.tableau import AdjointComposition, Splitting

SAMPLES, ORDER = 48, 4
RING = Residues(PRIMES[0], SAMPLES)


class Group:
    """Matrices over Residues[[h]] drawn from a Lie algebra: a list of matrices by powers of h."""

    def __init__(self, name, seed):
        self.name, self.numbers = name, random.Random(f"{name} {seed}")
        self.size = 4 if name == "unipotent" else 3

    def random(self):
        draw = lambda: self.numbers.randint(-9, 9)  # noqa: E731
        x = [[draw() for _ in range(self.size)] for _ in range(self.size)]
        if self.name == "SO(3)":
            x = [[x[i][j] - x[j][i] for j in range(3)] for i in range(3)]
        if self.name == "unipotent":
            x = [[v if i < j else 0 for j, v in enumerate(row)] for i, row in enumerate(x)]
        return [[RING.rational(v) for v in row] for row in x]

    def zero(self):
        return [[RING.zero] * self.size for _ in range(self.size)]

    def one(self):
        unit = [[RING.rational(int(i == j)) for j in range(self.size)] for i in range(self.size)]
        return [unit, *(self.zero() for _ in range(ORDER))]

    def add(self, x, y):
        return [[a + b for a, b in zip(r, s, strict=True)] for r, s in zip(x, y, strict=True)]

    def scale(self, x, a):
        return [[v * a for v in row] for row in x]

    def product(self, x, y):
        """The product of two series."""
        result = [self.zero() for _ in range(ORDER + 1)]
        for i, a in enumerate(x):
            for j, b in enumerate(y[: ORDER + 1 - i]):
                rows = range(self.size)
                ab = [[sum((a[p][k] * b[k][q] for k in rows), RING.zero) for q in rows] for p in rows]
                result[i + j] = self.add(result[i + j], ab)
        return result

    def exp(self, x):
        """The exponential of a series without constant term."""
        result, term = self.one(), self.one()
        for m in range(1, ORDER + 1):
            term = [self.scale(c, RING.rational(1, m)) for c in self.product(term, x)]
            result = [self.add(a, b) for a, b in zip(result, term, strict=True)]
        return result

    def series(self, terms):
        """The series of (power of h, matrix) terms."""
        result = [self.zero() for _ in range(ORDER + 1)]
        for n, x in terms:
            result[n] = self.add(result[n], x)
        return result

    def composed(self, factors):
        """The product of factors, the first acting first."""
        result = self.one()
        for factor in factors:
            result = self.product(factor, result)
        return result


def power(x, n):
    result = RING.one
    for _ in range(n):
        result = result * x
    return result


def errors(method, group):
    """The coefficients of h, ..., h^ORDER in step minus flow."""
    if isinstance(method, Splitting):
        parts = [group.random() for _ in method.parts]
        step = group.composed(
            group.exp(group.series([(1, group.scale(parts[p], x))])) for p, x in method.steps
        )
        flow = group.exp(group.series([(1, x) for x in parts]))
    elif isinstance(method, AdjointComposition):
        fields = [group.random() for _ in range(ORDER)]

        def basic(x, sign):
            return group.exp(
                group.series(
                    [(k, group.scale(f, power(x, k) * (sign ** (k + 1)))) for k, f in enumerate(fields, 1)]
                )
            )

        pairs = zip(method.alpha, method.beta, strict=True)
        step = group.composed(f for x, y in pairs for f in (basic(y, -1), basic(x, 1)))
        flow = group.exp(group.series([(1, fields[0])]))
    else:
        fields = [group.random() for _ in range(ORDER)]
        exponents = [
            group.series(
                (k, group.scale(f, x * power(method.c[i], k - 1)))
                for i, x in exponent
                for k, f in enumerate(fields, 1)
            )
            for exponent in method.exponents
        ]
        step, flow = group.composed(map(group.exp, exponents)), [group.one()[0]]
        for n in range(1, ORDER + 1):
            terms = (group.product([f], [flow[n - k]])[0] for k, f in enumerate(fields[:n], 1))
            total = group.zero()
            for term in terms:
                total = group.add(total, term)
            flow.append(group.scale(total, RING.rational(1, n)))
    return [group.add(a, group.scale(b, -RING.one)) for a, b in zip(step, flow, strict=True)][1:]


def ranks(residuals, coefficients):
    return tuple(
        len(pivot_columns(columns)) for columns in (residuals, coefficients, [*residuals, *coefficients])
    )


SPLIT = {
    "splitting": [2, 4, 8, 16],
    "splitting(3)": [3, 9, 27],
    "composition": [1, 2, 4, 8],
    "cf_magnus": [1, 2, 4, 8],
}


@pytest.mark.parametrize("name", SPLIT)
@pytest.mark.parametrize("group", [pytest.param("GL(3)", marks=pytest.mark.slow), "SO(3)", "unipotent"])
def test_residuals_and_errors_have_one_rank_and_joint_rank(name, group):
    family = families.get(name)
    method = family.random_method(RING, np.random.default_rng(11), ORDER)
    found = [errors(method, Group(group, seed)) for seed in range(4)]
    for n, dimension in enumerate(SPLIT[name], 1):
        residuals = list(family.residuals(method, RING, family.all_conditions(n)))
        coefficients = [x for error in found for row in error[n - 1] for x in row]
        own, of_errors, joint = ranks(residuals, coefficients)
        assert own == joint == dimension
        if group == "GL(3)":
            assert of_errors == dimension
        else:
            assert 0 < of_errors <= dimension or group == "unipotent"


def test_a_missing_condition_is_noticed():
    family = families.get("splitting")
    method = family.random_method(RING, np.random.default_rng(11), ORDER)
    found = [errors(method, Group("GL(3)", seed)) for seed in range(4)]
    residuals = list(family.residuals(method, RING, family.all_conditions(3)))[1:]
    coefficients = [x for error in found for row in error[2] for x in row]
    assert ranks(residuals, coefficients) == (7, 8, 8)


def test_nystroem_conditions_span_the_errors_of_x_equals_minus_grad_v():
    # The ideal of vanishing brackets, found from degrees, is all that polynomial potentials know.
    family = families.get("rkn")
    method = family.random_method(RING, np.random.default_rng(3), 5)
    found = [nystroem_errors(method, seed) for seed in range(4)]
    for n in range(1, 6):
        residuals = list(family.residuals(method, RING, family.all_conditions(n)))
        coefficients = [x for error in found for x in error[n]]
        dimension = len(functionals(n))
        own, of_errors, joint = ranks(residuals, coefficients)
        assert own == joint == dimension
        assert of_errors == dimension


def nystroem_errors(method, seed):
    """The error's coefficients of h^n in functions of (q, p), for random potentials in two dimensions."""
    h, numbers = PowerSeries(RING, 5), random.Random(seed)
    weights = [numbers.randint(1, 9) for _ in range(10)]
    powers = [(2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3), (3, 1), (2, 2), (1, 3)]

    def force(x, y):
        xs, ys = [h.one, x, x * x, x * x * x], [h.one, y, y * y, y * y * y]
        fx = sum(
            (xs[i - 1] * ys[j] * (-w * i) for w, (i, j) in zip(weights, powers, strict=True) if i), h.zero
        )
        fy = sum(
            (xs[i] * ys[j - 1] * (-w * j) for w, (i, j) in zip(weights, powers, strict=True) if j), h.zero
        )
        return fx, fy

    q, p = ([h.rational(numbers.randint(1, 99)) for _ in range(2)] for _ in range(2))
    start = (q, p)
    for part, x in method.steps:
        if part == method.rkn:
            p = [a + f * (h.h * x) for a, f in zip(p, force(*q), strict=True)]
        else:
            q = [a + b * (h.h * x) for a, b in zip(q, p, strict=True)]
    exact_q, exact_p = start
    for _ in range(6):
        velocity, slope = exact_p, force(*exact_q)
        exact_q = [a + integral(h, v) for a, v in zip(start[0], velocity, strict=True)]
        exact_p = [a + integral(h, f) for a, f in zip(start[1], slope, strict=True)]
    pairs = zip(observables(*q, *p), observables(*exact_q, *exact_p), strict=True)
    differences = [a - b for a, b in pairs]
    return [[x.coefficients[n] for x in differences] for n in range(6)]


def observables(x, y, u, v):
    """Monomials of degree up to five, on which words of five T or of five V do not vanish."""
    powers = []
    for z in (x, u):
        powers.append([z.ring.one])
        for _ in range(5):
            powers[-1].append(powers[-1][-1] * z)
    return [y, v, *(powers[0][i] * powers[1][j] for i in range(6) for j in range(6 - i) if i + j)]


def integral(h, x):
    shifted = (c * h.base.rational(1, n) for n, c in enumerate(x.coefficients[:-1], 1))
    return h.from_coefficients((h.base.zero, *shifted))
