"""Steps of Lie group methods and exact flows as truncated power series in h, by the printed formulas alone.

The second route to an order: no trees, no series engine. Numbers are residues modulo a prime at which the
tableau's field has a root (exact), or integers scaled by 2^400 where coefficients are proved decimals. On
every group the algebra's dual is written in matrices through <P, x> = tr(P x); formulas as in the
conventions of ``orderconds``: CG (1.4), RKMK (3.14), VRKMK (3.16), VCG (3.18), VCF alike with stages
summed in one exponential.
"""

from __future__ import annotations

import random
from fractions import Fraction
from functools import lru_cache
from math import factorial

import numpy as np
from flint import nmod_poly

from orderconds.proof.certificate import certify
from orderconds.ring import QQ, Balls, NumberField
from orderconds.ring.decimals import endpoints
from orderconds.tableau import Tableau, find

LARGEST_PRIME = 2**28
BERNOULLI = {0: Fraction(1), 1: Fraction(-1, 2), 2: Fraction(1, 6), 4: Fraction(-1, 30), 6: Fraction(1, 42)}
BERNOULLI |= {8: Fraction(-1, 30), 10: Fraction(5, 66)}


class Modular:
    """Residues modulo a prime below 2^28, so that sums of products fit in 64 bits."""

    dtype = np.int64

    def __init__(self, ring):
        self.prime, self.root = _prime_with_root(ring)

    def rational(self, q):
        q = Fraction(q)
        return q.numerator * pow(q.denominator, -1, self.prime) % self.prime

    def number(self, x, ring):
        if ring is QQ:
            return self.rational(Fraction(int(x.p), int(x.q)))
        value = 0
        for c in reversed(ring.lift(x).polynomial.coeffs()):
            value = (value * self.root + self.rational(Fraction(int(c.p), int(c.q)))) % self.prime
        return value

    def product(self, x):
        return x % self.prime

    def sum(self, x):
        return x % self.prime

    def vanishes(self, x):
        return not x.any()


class FixedPoint:
    """Integers times 2^-400, for the midpoints of balls that are narrower than 1e-40."""

    dtype = object
    bits = 400

    def rational(self, q):
        q = Fraction(q)
        return (q.numerator << self.bits) // q.denominator

    def number(self, x, ring):
        low, high = endpoints(x.value)
        middle = (low + high) / 2
        return self.rational(Fraction(int(middle.p), int(middle.q)))

    def product(self, x):
        return x >> self.bits

    def sum(self, x):
        return x

    def vanishes(self, x):
        return all(abs(v) < 1 << (self.bits - 100) for v in x.ravel())


def arithmetic(ring):
    """Return the numbers in which a tableau over ``ring`` is run."""
    return FixedPoint() if isinstance(ring, Balls) else Modular(ring)


@lru_cache(maxsize=64)
def _prime_with_root(ring):
    """Return a prime modulo which the field's defining polynomial has a root, and that root."""
    candidate = LARGEST_PRIME - 1
    while True:
        if all(candidate % k for k in range(3, 16400, 2)):
            if ring is QQ:
                return candidate, 0
            assert isinstance(ring, NumberField)
            reduced = [int(c.p) * pow(int(c.q), -1, candidate) % candidate for c in ring.modulus.coeffs()]
            for factor, _ in nmod_poly(reduced, candidate).factor()[1]:
                if factor.degree() == 1:
                    return candidate, int(-factor[0] / factor[1])
        candidate -= 2


class Group:
    """A matrix group by a basis of its algebra and the dual basis with tr(P_k E_l) = delta_kl."""

    def __init__(self, basis, dual):
        self.basis, self.dual = basis, dual
        self.n = len(basis[0])


def _unit(n, i, j):
    return [[int((r, c) == (i, j)) for c in range(n)] for r in range(n)]


def _skew(i, j):
    E = [[0] * 3 for _ in range(3)]
    E[i][j], E[j][i] = -1, 1
    return E


def _general_linear(n):
    pairs = [(i, j) for i in range(n) for j in range(n)]
    return Group([_unit(n, i, j) for i, j in pairs], [_unit(n, j, i) for i, j in pairs])


_SO3 = [_skew(1, 2), _skew(2, 0), _skew(0, 1)]
SO3 = Group(_SO3, [[[Fraction(-x, 2) for x in row] for row in E] for E in _SO3])
_UPPER = [(i, j) for i in range(4) for j in range(i + 1, 4)]
NILPOTENT = Group([_unit(4, i, j) for i, j in _UPPER], [_unit(4, j, i) for i, j in _UPPER])
GROUPS = {"SO(3)": SO3, "GL(2)": _general_linear(2), "nilpotent": NILPOTENT}
GL3 = _general_linear(3)


class Steps:
    """Series of matrices, shape (order + 1, n, n), on one group, with a random polynomial field or energy."""

    def __init__(self, group, numbers, order, seed=1):
        self.group, self.numbers, self.order, self.n = group, numbers, order, group.n
        self.random = random.Random(seed)
        self.basis = [self._matrix(E) for E in group.basis]
        self.dual = [self._matrix(P) for P in group.dual]
        self.one = self.constant(
            np.array(self._matrix([[int(i == j) for j in range(self.n)] for i in range(self.n)]))
        )
        self.zero = self.one * 0
        self.inverse = [None, *(numbers.rational(Fraction(1, k)) for k in range(1, order + 2))]

    # --- arithmetic

    def _matrix(self, entries):
        return np.array(
            [[self.numbers.rational(x) for x in row] for row in entries], dtype=self.numbers.dtype
        )

    def constant(self, matrix):
        series = np.zeros((self.order + 1, *matrix.shape), dtype=self.numbers.dtype)
        series[0] = matrix
        return series

    def times(self, x, y):
        total = np.zeros_like(y)
        for i in range(self.order + 1):
            if x[i].any():
                total[i:] = self.numbers.sum(
                    total[i:] + self.numbers.product(np.matmul(x[i], y[: self.order + 1 - i]))
                )
        return total

    def scaled(self, a, x):
        return self.numbers.product(x * a)

    def h(self, x):
        """Return h x."""
        moved = np.zeros_like(x)
        moved[1:] = x[:-1]
        return moved

    def add(self, *terms):
        total = terms[0]
        for x in terms[1:]:
            total = self.numbers.sum(total + x)
        return total

    def combine(self, coefficients, terms):
        """Return h times a linear combination."""
        total = self.zero
        for a, x in zip(coefficients, terms, strict=True):
            if a:
                total = self.add(total, self.scaled(a, x))
        return self.h(total)

    def bracket(self, x, y):
        return self.add(self.times(x, y), -self.times(y, x))

    def exp(self, x):
        total = term = self.one
        for k in range(1, self.order + 1):
            term = self.scaled(self.inverse[k], self.times(x, term))
            if not term.any():
                break
            total = self.add(total, term)
        return total

    def trace(self, x, matrix):
        """Return the series tr(x A) for a constant A."""
        return self.numbers.sum(self.numbers.product(x * matrix.T).sum(axis=(1, 2)))

    def right(self, x, matrix):
        """Return the series x A for a constant A."""
        return self.numbers.sum(self.numbers.product(np.matmul(x, matrix)))

    def scalar_product(self, a, b):
        total = np.zeros_like(a)
        for i in range(self.order + 1):
            if a[i]:
                total[i:] = self.numbers.sum(total[i:] + self.numbers.product(b[: self.order + 1 - i] * a[i]))
        return total

    def spread(self, scalar, matrix):
        """Return a scalar series times a constant matrix."""
        return self.numbers.product(scalar[:, None, None] * matrix[None])

    # --- Lie algebra and its dual

    def project(self, P):
        """Return the element of the dual that pairs with the algebra as P does."""
        total = self.zero
        for E, D in zip(self.basis, self.dual, strict=True):
            total = self.add(total, self.spread(self.trace(P, E), D))
        return total

    def coadjoint(self, g, inverse, P):
        """Return Ad*_g P."""
        return self.project(self.times(inverse, self.times(P, g)))

    def ad_dual(self, x, P):
        return self.project(self.bracket(P, x))

    def dexp_dual(self, x, P):
        total = term = P
        for k in range(1, self.order + 1):
            term = self.scaled(self.inverse[k + 1], self.ad_dual(x, term))
            if not term.any():
                break
            total = self.add(total, term)
        return total

    def dexpinv(self, x, y, cutoff):
        total, term = y, y
        for k in range(1, min(cutoff, self.order) + 1):
            term = self.bracket(x, term)
            if k in BERNOULLI:
                total = self.add(total, self.scaled(self._bernoulli(k), term))
        return total

    def dexpinv_dual(self, x, P, cutoff):
        total, term = P, P
        for k in range(1, min(cutoff, self.order) + 1):
            term = self.ad_dual(x, term)
            if k in BERNOULLI:
                total = self.add(total, self.scaled(self._bernoulli(k), term))
        return total

    def _bernoulli(self, k):
        return self.numbers.rational(BERNOULLI[k] / factorial(k))

    def _small(self):
        return self.random.randint(-9, 9)

    def _random(self):
        return self._matrix([[self._small() for _ in range(self.n)] for _ in range(self.n)])

    def _in_algebra(self):
        total = self.basis[0] * 0
        for E in self.basis:
            total = self.numbers.sum(total + E * self._small())
        return total

    # --- a random field on the group and its methods

    def field(self):
        """Return f: G -> g, each component a random quadratic polynomial of the entries."""
        forms = [(E, self._random(), self._random(), self._random()) for E in self.basis]

        def f(q):
            total = self.zero
            for E, u, v, w in forms:
                quadratic = self.scalar_product(self.trace(q, u), self.trace(q, v))
                value = self.numbers.sum(quadratic + self.trace(q, w))
                total = self.add(total, self.spread(value, E))
            return total

        return f

    def integral(self, x):
        moved = np.zeros_like(x)
        for k in range(self.order):
            moved[k + 1] = self.numbers.product(x[k] * self.inverse[k + 1])
        return moved

    def flow(self, f):
        q = self.one
        for _ in range(self.order + 1):
            q = self.add(self.one, self.integral(self.times(f(q), q)))
        return q

    def settle(self, sweep, unknowns, explicit):
        """Return the fixed point of a sweep over so many series that gains a power of h each time.

        The sweeps keep powers up to h^0, h^1, ..., unless stages are explicit, when the first finds all of
        them. The last is to leave every power as it was.
        """
        full, state = self.order, [self.zero] * unknowns
        for kept in (full,) if explicit else range(full + 1):
            self.resize(kept)
            state = sweep([self.resized(x) for x in state])
        again = sweep(state)
        assert all((x == y).all() for x, y in zip(state, again, strict=True)), "the stages have not settled"
        return again

    def resize(self, order):
        """Keep powers of h up to this order from now on."""
        self.order = order
        self.one, self.zero = self.resized(self.one), self.resized(self.zero)

    def resized(self, x):
        """Return x with as many powers of h as are kept, unknown ones zero."""
        if len(x) > self.order:
            return x[: self.order + 1]
        return np.concatenate([x, np.zeros((self.order + 1 - len(x), *x.shape[1:]), dtype=x.dtype)])

    def exponentials(self, rows, k):
        """Return the product of exponentials, the first row acts first."""
        g = self.one
        for row in rows:
            g = self.times(self.exp(self.combine(row, k)), g)
        return g

    def commutator_free(self, f, stages, update):
        """One step; ``stages`` and ``update`` are lists of rows from y0."""

        def sweep(k):
            k = list(k)
            for i, rows in enumerate(stages):
                k[i] = f(self.exponentials(rows, k))
            return k

        k = self.settle(sweep, len(stages), _explicit(stages))
        return self.exponentials(update, k)

    def munthe_kaas(self, f, A, b, cutoff):
        def sweep(F):
            F = list(F)
            for i, row in enumerate(A):
                X = self.combine(row, F)
                F[i] = self.dexpinv(X, f(self.exp(X)), cutoff)
            return F

        F = self.settle(sweep, len(b), _explicit([[row] for row in A]))
        return self.exp(self.combine(b, F))

    # --- a random energy on the cotangent bundle and its methods

    def energy(self, products=3):
        """Return (q, P) -> (xi, n) of H, a sum of products of three random linear forms of q and P."""
        forms = [[(self._random(), self._in_algebra()) for _ in range(3)] for _ in range(products)]

        def hamilton(q, P):
            xi = n = self.zero
            for product in forms:
                values = [self.numbers.sum(self.trace(q, u) + self.trace(P, v)) for u, v in product]
                for place, (u, v) in enumerate(product):
                    others = [x for m, x in enumerate(values) if m != place]
                    slope = self.scalar_product(*others)
                    xi = self.add(xi, self.spread(slope, v))
                    force = self.right(q, u)
                    weighted = np.zeros_like(force)
                    for i in range(self.order + 1):
                        if slope[i]:
                            weighted[i:] = self.numbers.sum(
                                weighted[i:] + self.numbers.product(force[: self.order + 1 - i] * slope[i])
                            )
                    n = self.add(n, -weighted)
            return xi, self.project(n)

        return hamilton

    def momentum(self):
        total = self.dual[0] * 0
        for D in self.dual:
            total = self.numbers.sum(total + D * self._small())
        return self.constant(total)

    def hamiltonian_flow(self, hamilton, P0):
        q, P = self.one, P0
        for _ in range(self.order + 1):
            xi, n = hamilton(q, P)
            q, P = (
                self.add(self.one, self.integral(self.times(xi, q))),
                self.add(P0, self.integral(self.add(n, -self.ad_dual(xi, P)))),
            )
        return q, P

    def variational(self, hamilton, P0, stages, update):
        """VCG and VCF: rows of alpha for each stage, and of beta, from q0 = 1.

        b_i M_i = sum_J beta_Ji dexp*_{Y_J} Ad*_{(q^J)^-1} mubar1 - h sum_j sum_J b_j alpha_jJi dexp*_{X_jJ}
        Ad*_{(Q_j^J)^-1} nbar_j, the superscript J naming the product up to and including factor J.
        """
        s = range(len(stages))
        b = [self.numbers.sum(sum(row[i] for row in update)) for i in s]
        reciprocal = [self._reciprocal(x) for x in b]

        def partial(rows, xi):
            points, g, inverse = [], self.one, self.one
            for row in rows:
                x = self.combine(row, xi)
                g, inverse = self.times(self.exp(x), g), self.times(inverse, self.exp(-x))
                points.append((x, g, inverse))
            return points or [(self.zero, self.one, self.one)]

        def products(xi):
            return partial(update, xi), [partial(rows, xi) for rows in stages]

        def bar(Q, n):
            nbar = [self.coadjoint(Q[j][-1][1], Q[j][-1][2], n[j]) for j in s]
            return nbar, self.add(self.resized(P0), self.combine(b, nbar))

        def momenta(q, Q, n):
            nbar, mubar = bar(Q, n)
            carried = [self.dexp_dual(x, self.coadjoint(inv, g, mubar)) for x, g, inv in q]
            pulled = [[self.dexp_dual(x, self.coadjoint(inv, g, nbar[j])) for x, g, inv in Q[j]] for j in s]
            for i in s:
                total = self.zero
                for row, m in zip(update, carried, strict=True):
                    total = self.add(total, self.scaled(row[i], m))
                for j in s:
                    for row, m in zip(stages[j], pulled[j], strict=False):
                        if row[i]:
                            weight = self.numbers.product(b[j] * row[i])
                            total = self.add(total, -self.h(self.scaled(weight, m)))
                yield self.scaled(reciprocal[i], total)

        def sweep(state):
            xi, n = state[: len(s)], state[len(s) :]
            q, Q = products(xi)
            fields = [hamilton(Q[i][-1][1], M) for i, M in enumerate(momenta(q, Q, n))]
            return [x for field in zip(*fields, strict=True) for x in field]

        state = self.settle(sweep, 2 * len(b), explicit=False)
        q, Q = products(state[: len(s)])
        _, mubar = bar(Q, state[len(s) :])
        return q[-1][1], self.coadjoint(q[-1][2], q[-1][1], mubar)

    def variational_munthe_kaas(self, hamilton, P0, A, b, cutoff):
        """VRKMK(r), equation (3.16), from q0 = 1."""
        s = range(len(b))
        reciprocal = [self._reciprocal(x) for x in b]

        def operator(x, xi, P):
            """P*_(r)(x, xi) = ad*_xi/2 - sum_{k=2}^r B_k/k! sum_i ad*_{ad_x^(k-1-i) xi} (ad*_x)^i."""
            if cutoff == 0:
                return self.zero
            total = self.scaled(self.numbers.rational(Fraction(1, 2)), self.ad_dual(xi, P))
            for k in range(2, min(cutoff, self.order + 1) + 1):
                if k not in BERNOULLI:
                    continue
                inner = P
                for i in range(k):
                    moved = xi
                    for _ in range(k - 1 - i):
                        moved = self.bracket(x, moved)
                    total = self.add(total, -self.scaled(self._bernoulli(k), self.ad_dual(moved, inner)))
                    inner = self.ad_dual(x, inner)
            return total

        def ends(X, xi, n):
            f = [self.dexpinv(X[i], xi[i], cutoff) for i in s]
            moved = [self.coadjoint(self.exp(X[i]), self.exp(-X[i]), n[i]) for i in s]
            return self.combine(b, f), self.add(self.resized(P0), self.combine(b, moved))

        def sweep(state):
            X, xi, n, multipliers = (state[len(s) * k : len(s) * (k + 1)] for k in range(4))
            f = [self.dexpinv(X[i], xi[i], cutoff) for i in s]
            X = [self.combine(row, f) for row in A]
            Y, mu = ends(X, xi, n)
            Lambda = self.dexp_dual(-Y, mu)

            def inner(i, multipliers):
                total = self.scaled(b[i], Lambda)
                for j in s:
                    if A[j][i]:
                        total = self.add(total, self.scaled(A[j][i], multipliers[j]))
                return total

            turned = [self.scaled(b[i], self.dexp_dual(X[i], n[i])) for i in s]
            multipliers = [
                self.h(self.add(operator(X[i], xi[i], inner(i, multipliers)), -turned[i])) for i in s
            ]
            fields = []
            for i in s:
                M = self.dexpinv_dual(X[i], inner(i, multipliers), cutoff)
                fields.append(hamilton(self.exp(X[i]), self.scaled(reciprocal[i], M)))
            return [*X, *(x for field in zip(*fields, strict=True) for x in field), *multipliers]

        state = self.settle(sweep, 4 * len(b), explicit=False)
        X, xi, n = (state[len(s) * k : len(s) * (k + 1)] for k in range(3))
        Y, mu = ends(X, xi, n)
        return self.exp(Y), self.coadjoint(self.exp(-Y), self.exp(Y), mu)

    def _reciprocal(self, x):
        if isinstance(self.numbers, Modular):
            return pow(int(x), -1, self.numbers.prime)
        return (1 << 2 * self.numbers.bits) // x

    # --- local errors

    def first_error(self, found, exact):
        """Return the lowest power of h in which two tuples of series differ; None where they agree."""
        for k in range(self.order + 1):
            for x, y in zip(found, exact, strict=True):
                if not self.numbers.vanishes(self.numbers.sum(x[k] - y[k])):
                    return k
        return None


def _explicit(stages):
    """Say whether each stage is built from those before it alone."""
    return not any(any(row[i:]) for i, rows in enumerate(stages) for row in rows)


def rows_from_start(method, stage):
    before = () if stage.start is None else rows_from_start(method, method.stages[stage.start])
    return (*before, *stage.exponentials)


@lru_cache(maxsize=4)
def certified(name):
    """Return a tableau of the library; proved decimals have all digits of the proof."""
    found = Tableau.load(find(name))
    return certify(found).tableau if found.proof else found


def local_error_power(tableau, family, cutoff, group, order, seed=1):
    """Return the first power of h up to ``order`` in which one step differs from the flow, or None."""
    numbers = arithmetic(tableau.ring)
    steps = Steps(group, numbers, order, seed)

    def exact(row):
        return [numbers.number(x, tableau.ring) for x in row]

    method = tableau.read_as(("cf", "rk") if family in ("cf", "vcf") else ("rk",))
    if family in ("cg", "vcg") or (family in ("cf", "vcf") and hasattr(method, "A")):
        method = method.as_crouch_grossman(tableau.ring)
    if hasattr(method, "update"):
        stages = [[exact(row) for row in rows_from_start(method, stage)] for stage in method.stages]
        update = [exact(row) for row in rows_from_start(method, method.update)]
    else:
        A, b = [exact(row) for row in method.A], exact(method.b)
    # dexpinv without a cut-off is cut where the series end
    kept = order if cutoff is None else cutoff
    if family in ("cg", "cf", "rkmk"):
        f = steps.field()
        step = (
            steps.munthe_kaas(f, A, b, kept) if family == "rkmk" else steps.commutator_free(f, stages, update)
        )
        return steps.first_error((step,), (steps.flow(f),))
    hamilton, P0 = steps.energy(), steps.momentum()
    if family == "vrkmk":
        step = steps.variational_munthe_kaas(hamilton, P0, A, b, kept)
    else:
        step = steps.variational(hamilton, P0, stages, update)
    return steps.first_error(step, steps.hamiltonian_flow(hamilton, P0))
