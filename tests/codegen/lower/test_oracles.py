"""Lowered programs against the methods' equations as printed, solved here by plain iteration.

The equations are written once more, verbatim: not relative to q0, momenta from mubar1, brackets by their
definition. Over Q[[h]] the comparison is exact, with 40 digits it holds to rounding; before the passes and
after them.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import pytest

from codegen.ir.domain import PreciseDomain, SeriesDomain
from codegen.ir.expr import evaluate
from codegen.ir.interpret import interpret
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import optimise
from orderconds.ring import QQ
from tests.strategies import field_scene, full, full_exponentials, hamiltonian_scene, shipped

ORDER = 4
DEXPINV = ((1, 1), (-1, 2), (1, 12), (0, 1), (-1, 720))


def plus(*vectors):
    return tuple(sum(entries[1:], entries[0]) for entries in zip(*vectors, strict=True))


def times(factor, x):
    return tuple(factor * a for a in x)


class Oracle:
    """A scene over one domain, and iteration until nothing moves."""

    def __init__(self, scene, tableau, domain):
        self.scene, self.d, self.group = scene, domain, scene.group
        start = scene.initial(domain)
        self.blocks = []
        for block in scene.state:
            self.blocks.append(start[: len(block.symbols)])
            start = start[len(block.symbols) :]
        self.t = domain.rational(1, 3)
        self.tableau = tableau

    def number(self, x):
        return self.d.number(Method("rk", self.tableau).number(x))

    def butcher(self):
        method = self.tableau.read_as(("rk",))
        A = [[self.number(x) for x in row] for row in method.A]
        return A, [self.number(x) for x in method.b], [sum(row[1:], row[0]) for row in A]

    def f(self, c, *blocks):
        state = tuple(x for block in blocks for x in block)
        values = self.scene.values(self.d, state, self.t + c * self.d.h)
        return tuple(evaluate(self.scene.roots, self.d, values))

    def iterate(self, step, start):
        """Fixed-point iteration: long enough for every power of h, and for 40 digits at a small step."""
        x = start
        for _ in range(2 * ORDER + 3 if isinstance(self.d, SeriesDomain) else 30):
            x = step(x)
        return x

    def vcg(self):
        """(3.18)."""
        d, G = self.d, self.group
        A, b, c = self.butcher()
        stages = range(len(b))
        q0, mu0 = self.blocks

        def exp(factor, x):
            return G.exp(d, times(d.h * factor, x))

        def everything(xi, M):
            q, Q = [q0], [[q0] for _ in stages]
            for j in stages:
                q.append(G.mul(d, exp(b[j], xi[j]), q[-1]))
                for i in stages:
                    Q[i].append(G.mul(d, exp(A[i][j], xi[j]), Q[i][-1]))
            both = [self.f(c[i], Q[i][-1], M[i]) for i in stages]
            xi, n = [x[: G.dim] for x in both], [x[G.dim :] for x in both]
            nbar = [G.Adt(d, Q[i][-1], n[i]) for i in stages]
            mubar1 = plus(G.Adt(d, q0, mu0), *(times(d.h * b[j], nbar[j]) for j in stages))
            return q, Q, xi, nbar, mubar1

        def sweep(pair):
            q, Q, xi, nbar, mubar1 = everything(*pair)
            M = []
            for i in stages:
                total = G.dexpt(d, times(d.h * b[i], xi[i]), G.Adtinv(d, q[i + 1], mubar1))
                for j in stages:
                    moved = G.Adtinv(d, Q[j][i + 1], nbar[j])
                    moved = G.dexpt(d, times(d.h * A[j][i], xi[i]), moved)
                    total = plus(total, times(-(d.h * (b[j] * A[j][i] / b[i])), moved))
                M.append(total)
            return xi, M

        zero = (d.rational(0),) * G.dim
        xi, M = self.iterate(sweep, ([zero] * len(b), [mu0] * len(b)))
        q, _, _, _, mubar1 = everything(xi, M)
        return {"q": q[-1], "mu": G.Adtinv(d, q[-1], mubar1)}

    def vcf(self):
        """The Hamilton equations of the discrete Lagrangian, not relative to q0, momenta from mubar1."""
        d, G = self.d, self.group
        method = self.tableau.read_as(("cf",))
        if method is None:
            method = self.tableau.method.as_crouch_grossman(self.tableau.ring)
        full = [[[self.number(x) for x in row] for row in method.from_start(p)] for p in method.stages]
        alpha, beta = full, [[self.number(x) for x in row] for row in method.update.exponentials]
        stages, zero = range(len(alpha)), d.rational(0)
        b = [sum((row[i] for row in beta), zero) for i in stages]
        c = [sum((x for row in rows for x in row), zero) for rows in alpha]
        q0, mu0 = self.blocks

        def exponents(rows, xi):
            return [plus(*(times(d.h * x, v) for x, v in zip(row, xi, strict=True))) for row in rows]

        def points(X):
            found = [q0]
            for x in X:
                found.append(G.mul(d, G.exp(d, x), found[-1]))
            return found

        def everything(xi, M):
            Y, X = exponents(beta, xi), [exponents(rows, xi) for rows in alpha]
            q, Q = points(Y), [points(x) for x in X]
            both = [self.f(c[i], Q[i][-1], M[i]) for i in stages]
            new, n = [x[: G.dim] for x in both], [x[G.dim :] for x in both]
            nbar = [G.Adt(d, Q[i][-1], n[i]) for i in stages]
            mubar1 = plus(G.Adt(d, q0, mu0), *(times(d.h * b[j], nbar[j]) for j in stages))
            return Y, X, q, Q, new, nbar, mubar1

        def sweep(pair):
            Y, X, q, Q, xi, nbar, mubar1 = everything(*pair)
            M = []
            for i in stages:
                total = (zero,) * G.dim
                for J, row in enumerate(beta):
                    moved = G.dexpt(d, Y[J], G.Adtinv(d, q[J + 1], mubar1))
                    total = plus(total, times(row[i], moved))
                for j in stages:
                    for J, row in enumerate(alpha[j]):
                        moved = G.dexpt(d, X[j][J], G.Adtinv(d, Q[j][J + 1], nbar[j]))
                        total = plus(total, times(-(d.h * (b[j] * row[i])), moved))
                M.append(times(d.rational(1) / b[i], total))
            return xi, M

        start = ([(zero,) * G.dim for _ in stages], [mu0 for _ in stages])
        xi, M = self.iterate(sweep, start)
        _, _, q, _, _, _, mubar1 = everything(xi, M)
        return {"q": q[-1], "mu": G.Adtinv(d, q[-1], mubar1)}

    def cut(self, bracket, x, y):
        """dexp^{-1}_(r),x y, where ``bracket`` is ad_x, or its dual where it is ad*_x."""
        total = power = y
        for p, q in DEXPINV[1 : self.cutoff + 1]:
            power = bracket(self.d, x, power)
            total = plus(total, times(self.d.rational(p, q), power))
        return total

    def P(self, x, xi, mu):
        """P*_(r) as printed under (3.16), term by term."""
        d, G = self.d, self.group
        total = times(d.rational(int(self.cutoff > 0), 2), G.adt(d, xi, mu))
        for k in range(2, self.cutoff + 1):
            for i in range(k):
                left, right = xi, mu
                for _ in range(k - 1 - i):
                    left = G.ad(d, x, left)
                for _ in range(i):
                    right = G.adt(d, x, right)
                p, q = DEXPINV[k]
                total = plus(total, times(d.rational(-p, q), G.adt(d, left, right)))
        return total

    def vrkmk(self, cutoff):
        """(3.16), all of it unknown: stage velocities and forces, multipliers, momenta, Lambda."""
        d, G = self.d, self.group
        A, b, c = self.butcher()
        stages = range(len(b))
        q0, mu0 = self.blocks
        self.cutoff = cutoff

        def combination(row, v):
            return plus(*(times(d.h * a, x) for a, x in zip(row, v, strict=True)))

        def sweep(unknown):
            xi, n, X, lam, M, Lam = unknown
            v = [self.cut(G.ad, X[i], xi[i]) for i in stages]
            X = [combination(row, v) for row in A]
            Y = combination(b, v)
            moved = [G.Adt(d, G.exp(d, X[i]), n[i]) for i in stages]
            mubar = plus(mu0, *(times(d.h * b[i], moved[i]) for i in stages))
            Lam = G.dexpt(d, times(d.rational(-1), Y), mubar)
            mixed = [plus(times(b[i], Lam), *(times(A[j][i], lam[j]) for j in stages)) for i in stages]
            lam = [
                plus(
                    times(-(d.h * b[i]), G.dexpt(d, X[i], n[i])),
                    times(d.h, self.P(X[i], xi[i], mixed[i])),
                )
                for i in stages
            ]
            mixed = [plus(times(b[i], Lam), *(times(A[j][i], lam[j]) for j in stages)) for i in stages]
            M = [times(d.rational(1) / b[i], self.cut(G.adt, X[i], mixed[i])) for i in stages]
            both = [self.f(c[i], G.mul(d, G.exp(d, X[i]), q0), M[i]) for i in stages]
            return [x[: G.dim] for x in both], [x[G.dim :] for x in both], X, lam, M, Lam, Y, mubar

        zero = [(d.rational(0),) * G.dim] * len(b)
        start = (zero, zero, zero, zero, [mu0] * len(b), mu0, zero[0], mu0)
        *_, Y, mubar = self.iterate(lambda unknown: sweep(unknown[:6]), start)
        g = G.exp(d, Y)
        return {"q": G.mul(d, g, q0), "mu": G.Adtinv(d, g, mubar)}

    def act(self, x, y):
        return self.scene.action.act(self.d, self.group, self.group.exp(self.d, x), y)

    def rkmk(self, cutoff):
        """(3.14)."""
        d = self.d
        A, b, c = self.butcher()
        (y,) = self.blocks

        def combination(row, v):
            return plus(*(times(d.h * a, x) for a, x in zip(row, v, strict=True)))

        def sweep(v):
            new = []
            for i, row in enumerate(A):
                u = combination(row, v)
                power = self.f(c[i], self.act(u, y))
                total = power
                for p, q in DEXPINV[1 : cutoff + 1]:
                    power = self.group.ad(d, u, power)
                    total = plus(total, times(d.rational(p, q), power))
                new.append(total)
            return new

        v = self.iterate(sweep, [(d.rational(0),) * self.group.dim] * len(b))
        return {"y": self.act(combination(b, v), y)}

    def vrkmk_pade(self, r):
        """dexp_(r),X_i v_i = xi_i, and the variation of every v_i by its definition: a sum over pairs."""
        d, G = self.d, self.group
        A, b, c = self.butcher()
        stages = range(len(b))
        q0, mu0 = self.blocks

        def power(bracket, x, k, y):
            for _ in range(k):
                y = bracket(d, x, y)
            return y

        def tail(bracket, x, y):
            """(1 - dexp_(r),x) y, or its dual."""
            terms = [
                times(d.rational(-1, factorial(k + 1)), power(bracket, x, k, y)) for k in range(1, r + 1)
            ]
            return plus(times(d.rational(0), y), *terms)

        def slope(x, v, mu):
            """R*_(r)(x, v) mu: -1/(k+1)! ad*_{ad_x^{k-1-i} v} (ad*_x)^i mu, summed over k and i < k."""
            total = times(d.rational(0), mu)
            for k in range(1, r + 1):
                for i in range(k):
                    left = power(G.ad, x, k - 1 - i, v)
                    term = G.adt(d, left, power(G.adt, x, i, mu))
                    total = plus(total, times(d.rational(-1, factorial(k + 1)), term))
            return total

        def combination(row, v):
            return plus(*(times(d.h * a, x) for a, x in zip(row, v, strict=True)))

        def everything(v, M):
            X = [combination(row, v) for row in A]
            both = [self.f(c[i], G.mul(d, G.exp(d, X[i]), q0), M[i]) for i in stages]
            xi, n = [x[: G.dim] for x in both], [x[G.dim :] for x in both]
            moved = [G.Adt(d, G.exp(d, X[i]), n[i]) for i in stages]
            return X, xi, n, plus(mu0, *(times(d.h * b[i], moved[i]) for i in stages))

        def sweep(pair):
            v, M = pair
            X, xi, n, mubar = everything(v, M)
            new = [plus(xi[i], tail(G.ad, X[i], v[i])) for i in stages]
            Lam = G.dexpt(d, times(d.rational(-1), combination(b, v)), mubar)
            pulled = []
            for i in stages:
                total = times(b[i], Lam)
                for j in stages:
                    both = plus(slope(X[j], v[j], M[j]), G.dexpt(d, X[j], n[j]))
                    total = plus(total, times(-(d.h * (b[j] * A[j][i])), both))
                pulled.append(plus(times(d.rational(1) / b[i], total), tail(G.adt, X[i], M[i])))
            return new, pulled

        zero = (d.rational(0),) * G.dim
        v, M = self.iterate(sweep, ([zero] * len(b), [mu0] * len(b)))
        g = G.exp(d, combination(b, v))
        return {"q": G.mul(d, g, q0), "mu": G.Adtinv(d, g, everything(v, M)[3])}

    def rkmk4(self):
        """RK4 with the two brackets of Munthe-Kaas and Owren (1999)."""
        d, (y,) = self.d, self.blocks

        def lin(*terms):
            return plus(*(times(d.rational(p, q), x) for p, q, x in terms))

        def k(c, *u):
            point = self.act(lin(*u), y) if u else y
            return times(d.h, self.f(d.rational(*c), point))

        k1 = k((0, 1))
        k2 = k((1, 2), (1, 2, k1))
        k3 = k((1, 2), (1, 2, k2), (-1, 8, self.group.ad(d, k1, k2)))
        k4 = k((1, 1), (1, 1, k3))
        last = self.group.ad(d, k1, k4)
        return {"y": self.act(lin((1, 6, k1), (1, 3, k2), (1, 3, k3), (1, 6, k4), (-1, 12, last)), y)}

    def cg(self):
        """(1.4)."""
        d = self.d
        A, b, c = self.butcher()

        def product(row, k):
            (y,) = self.blocks
            for a, x in zip(row, k, strict=True):
                y = self.act(times(d.h * a, x), y)
            return y

        def sweep(k):
            return [self.f(c[i], product(row, k)) for i, row in enumerate(A)]

        k = self.iterate(sweep, [(d.rational(0),) * self.group.dim] * len(b))
        return {"y": product(b, k)}

    def cf4(self):
        """Section 2.2.1: four stages, the last of which starts from the second."""
        d, (y,) = self.d, self.blocks

        def moved(point, p, q, *terms):
            return self.act(times(d.h * d.rational(p, q), plus(*terms)), point)

        half = d.rational(1, 2)
        k1 = self.f(d.rational(0), y)
        Y2 = moved(y, 1, 2, k1)
        k2 = self.f(half, Y2)
        k3 = self.f(half, moved(y, 1, 2, k2))
        k4 = self.f(d.rational(1), moved(Y2, 1, 1, k3, times(-half, k1)))
        both = times(d.rational(2), plus(k2, k3))
        first = moved(y, 1, 12, times(d.rational(3), k1), both, times(d.rational(-1), k4))
        return {"y": moved(first, 1, 12, times(d.rational(-1), k1), both, times(d.rational(3), k4))}


def precise():
    return PreciseDomain(Fraction(1, 1000), 40)


def check(scene, method, domain, expected):
    view = problem_for(scene, method)
    program = lower(scene, method)
    optimised, _ = optimise(program, view)
    oracle = Oracle(view, method.tableau, domain)
    inputs = dict(zip([v.name for v in program.inputs], [*oracle.blocks, oracle.t], strict=False))
    right = expected(oracle)
    for p in (program, optimised):
        found = interpret(p, view, domain, inputs)
        assert sorted(found) == sorted(right)
        for name, value in right.items():
            for x, y in zip(found[name], value, strict=True):
                if isinstance(domain, SeriesDomain):
                    assert domain.ring.is_zero(x - y) is True
                else:
                    assert abs(x - y) < 1e-34 * max(1, abs(y))


HAMILTONIANS = ("SO(3)", "R^3", pytest.param("GL(2)", marks=pytest.mark.slow), "Heisenberg")
RATIONAL = {name: shipped(name) for name in ("midpoint", "heun", "kutta3", "rk4")} | {
    f"full{s}": full(s) for s in (1, 2, 3)
}


class TestVariationalCrouchGrossmanIsItsEquation:
    @pytest.mark.parametrize("tableau", ["midpoint", "full1", "full2", "kutta3"])
    @pytest.mark.parametrize("group", HAMILTONIANS)
    def test_exactly(self, group, tableau):
        method = Method("vcg", RATIONAL[tableau])
        check(hamiltonian_scene(group), method, SeriesDomain(QQ, ORDER), Oracle.vcg)

    @pytest.mark.parametrize("tableau", ["triple_jump", "gauss2", "yoshida6"])
    def test_to_forty_digits(self, tableau):
        check(hamiltonian_scene("SO(3)"), Method("vcg", shipped(tableau)), precise(), Oracle.vcg)

    @pytest.mark.parametrize("tableau", ["midpoint", "full2"])
    def test_with_time(self, tableau):
        method = Method("vcg", RATIONAL[tableau])
        check(hamiltonian_scene("SO(3)", time=True), method, SeriesDomain(QQ, ORDER), Oracle.vcg)


class TestVariationalCommutatorFreeIsItsEquation:
    @pytest.mark.parametrize("group", HAMILTONIANS)
    @pytest.mark.parametrize("tableau", ["cf4", "random"])
    def test_exactly(self, group, tableau):
        method = Method("vcf", shipped("cf4") if tableau == "cf4" else full_exponentials(2))
        check(hamiltonian_scene(group), method, SeriesDomain(QQ, ORDER), Oracle.vcf)

    @pytest.mark.parametrize("tableau", ["midpoint", "full2", "kutta3"])
    def test_of_a_butcher_tableau_it_is_crouch_grossman(self, tableau):
        method = Method("vcf", RATIONAL[tableau])
        check(hamiltonian_scene("SO(3)"), method, SeriesDomain(QQ, ORDER), Oracle.vcg)

    def test_to_forty_digits(self):
        check(hamiltonian_scene("SO(3)"), Method("vcf", shipped("cf4")), precise(), Oracle.vcf)

    def test_with_time(self):
        scene, method = hamiltonian_scene("SO(3)", time=True), Method("vcf", shipped("cf4"))
        check(scene, method, SeriesDomain(QQ, ORDER), Oracle.vcf)


class TestVariationalMuntheKaasIsItsEquation:
    @pytest.mark.parametrize("cutoff", [0, 1, 2, 4])
    @pytest.mark.parametrize("tableau", ["midpoint", "kutta3", "full2"])
    @pytest.mark.parametrize("group", ["SO(3)", pytest.param("GL(2)", marks=pytest.mark.slow)])
    def test_exactly(self, group, tableau, cutoff):
        method = Method("vrkmk", RATIONAL[tableau], cutoff)
        check(hamiltonian_scene(group), method, SeriesDomain(QQ, ORDER), lambda o: o.vrkmk(cutoff))

    @pytest.mark.parametrize("group", ["R^3", "Heisenberg"])
    def test_where_few_brackets_or_none_are_left(self, group):
        method = Method("vrkmk", RATIONAL["full2"], 2)
        check(hamiltonian_scene(group), method, SeriesDomain(QQ, ORDER), lambda o: o.vrkmk(2))

    @pytest.mark.parametrize(("tableau", "cutoff"), [("gauss2", 2), ("gauss3", 4), ("triple_jump", 2)])
    def test_to_forty_digits(self, tableau, cutoff):
        method = Method("vrkmk", shipped(tableau), cutoff)
        check(hamiltonian_scene("SO(3)"), method, precise(), lambda o: o.vrkmk(cutoff))

    @pytest.mark.parametrize("tableau", ["kutta3", "full2"])
    def test_with_time(self, tableau):
        method = Method("vrkmk", RATIONAL[tableau], 2)
        scene = hamiltonian_scene("SO(3)", time=True)
        check(scene, method, SeriesDomain(QQ, ORDER), lambda o: o.vrkmk(2))


class TestVariationalMuntheKaasWithDexpCutOffIsItsEquation:
    @pytest.mark.parametrize("cutoff", [0, 1, 2, 3])
    @pytest.mark.parametrize("tableau", ["kutta3", "full2"])
    def test_exactly(self, tableau, cutoff):
        method = Method("vrkmk_pade", RATIONAL[tableau], cutoff)
        domain = SeriesDomain(QQ, ORDER)
        check(hamiltonian_scene("SO(3)"), method, domain, lambda o: o.vrkmk_pade(cutoff))

    @pytest.mark.parametrize("group", ["R^3", "GL(2)"])
    def test_on_other_groups(self, group):
        method = Method("vrkmk_pade", RATIONAL["full2"], 2)
        check(hamiltonian_scene(group), method, SeriesDomain(QQ, ORDER), lambda o: o.vrkmk_pade(2))

    @pytest.mark.parametrize("tableau", ["midpoint", "full2"])
    def test_without_brackets_it_is_vrkmk(self, tableau):
        method = Method("vrkmk_pade", RATIONAL[tableau], 0)
        check(hamiltonian_scene("SO(3)"), method, SeriesDomain(QQ, ORDER), lambda o: o.vrkmk(0))


FIELDS = ("R^3", "S^2", "SO(3)", "GL(2)", "Heisenberg")


class TestMuntheKaasIsItsEquation:
    @pytest.mark.parametrize("cutoff", [0, 1, 2, 4])
    @pytest.mark.parametrize("tableau", ["rk4", "full2"])
    @pytest.mark.parametrize("place", ["S^2", "GL(2)", "Heisenberg"])
    def test_exactly(self, place, tableau, cutoff):
        method = Method("rkmk", RATIONAL[tableau], cutoff)
        check(field_scene(place), method, SeriesDomain(QQ, ORDER), lambda o: o.rkmk(cutoff))

    @pytest.mark.parametrize("tableau", ["rk4", "gauss2"])
    def test_to_forty_digits_with_time(self, tableau):
        method = Method("rkmk", shipped(tableau), 2)
        check(field_scene("S^2", time=True), method, precise(), lambda o: o.rkmk(2))

    @pytest.mark.parametrize("tableau", ["midpoint", "rk4"])
    def test_on_the_cotangent_group(self, tableau):
        method = Method("rkmk", RATIONAL[tableau], 2)
        check(hamiltonian_scene("SO(3)"), method, SeriesDomain(QQ, ORDER), lambda o: o.rkmk(2))

    def test_without_brackets_on_a_vector_space_it_is_runge_kutta(self):
        check(field_scene("R^3"), Method("rk", RATIONAL["rk4"]), SeriesDomain(QQ, ORDER), lambda o: o.rkmk(0))


class TestMuntheKaasWithTheFewestBracketsIsAsPrinted:
    @pytest.mark.parametrize("place", FIELDS)
    def test_exactly(self, place):
        check(field_scene(place), Method("rkmk", RATIONAL["rk4"]), SeriesDomain(QQ, ORDER), Oracle.rkmk4)

    def test_with_time_and_on_the_cotangent_group(self):
        method, domain = Method("rkmk", RATIONAL["rk4"]), SeriesDomain(QQ, ORDER)
        check(field_scene("S^2", time=True), method, domain, Oracle.rkmk4)
        check(hamiltonian_scene("SO(3)"), method, domain, Oracle.rkmk4)


class TestCrouchGrossmanIsItsEquation:
    @pytest.mark.parametrize("tableau", ["heun", "kutta3", "rk4", "full2"])
    @pytest.mark.parametrize("place", FIELDS)
    def test_exactly(self, place, tableau):
        check(field_scene(place), Method("cg", RATIONAL[tableau]), SeriesDomain(QQ, ORDER), Oracle.cg)

    @pytest.mark.parametrize("tableau", ["cg3", "cg4", "triple_jump"])
    def test_to_forty_digits_with_time(self, tableau):
        check(field_scene("S^2", time=True), Method("cg", shipped(tableau)), precise(), Oracle.cg)

    def test_on_the_cotangent_group(self):
        method = Method("cg", shipped("cg3"))
        check(hamiltonian_scene("GL(2)"), method, SeriesDomain(QQ, ORDER), Oracle.cg)


class TestCommutatorFree4IsItsEquation:
    @pytest.mark.parametrize("place", FIELDS)
    def test_exactly(self, place):
        check(field_scene(place), Method("cf", shipped("cf4")), SeriesDomain(QQ, ORDER), Oracle.cf4)

    def test_with_time(self):
        domain = SeriesDomain(QQ, ORDER)
        check(field_scene("GL(2)", time=True), Method("cf", shipped("cf4")), domain, Oracle.cf4)


def test_a_tableau_that_differs_in_one_entry_is_told_apart():
    """The check itself: a program of another tableau is not the oracle's."""
    scene, method = hamiltonian_scene("SO(3)"), Method("vcg", full(2, seed=1))
    with pytest.raises(AssertionError):
        check(scene, method, SeriesDomain(QQ, ORDER), lambda o: Oracle(scene, full(2), o.d).vcg())
