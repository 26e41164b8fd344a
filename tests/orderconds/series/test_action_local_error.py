"""The action series against concrete methods on T*GL(2) over Q[[h]]: (3.16), (3.18) and VCF.

The Hamiltonian is cubic and has no symmetry. Covectors are matrices through <P, x> = tr(P x), so that Ad*_g
P = g^-1 P g and ad*_x P = [P, x]. The step and the flow are found by iteration, until their series stand;
nothing here knows of trees.
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq

from orderconds.families import get
from orderconds.ring import QQ, PowerSeries
from orderconds.series import action_exact
from orderconds.series.action_fields import ActionFields
from orderconds.series.action_trees import force, velocity
from orderconds.tableau import Tableau
from orderconds.tableau.library import find
from orderconds.tableau.methods import CommutatorFree, RungeKutta, Stage

ORDER = 4
R = PowerSeries(QQ, ORDER)
ID = ((1, 0), (0, 1))
A2, B2, C2, D2, F2, G2 = (
    ((1, 2), (0, -1)),
    ((1, 0), (1, 2)),
    ((0, 1), (1, -1)),
    ((1, -1), (2, 0)),
    ((0, 1), (-1, 1)),
    ((1, 1), (0, 1)),
)
Q0 = ((fmpq(1), fmpq(1, 2)), (fmpq(-1, 3), fmpq(1)))
MU0 = ((fmpq(1, 2), fmpq(1)), (fmpq(2, 3), fmpq(-1)))


def add(*matrices):
    return tuple(
        tuple(sum(e[1:], e[0]) for e in zip(*rows, strict=True)) for rows in zip(*matrices, strict=True)
    )


def scale(factor, m):
    return tuple(tuple(x * factor for x in row) for row in m)


def mul(*matrices):
    result = matrices[0]
    for m in matrices[1:]:
        result = tuple(tuple(row[0] * m[0][j] + row[1] * m[1][j] for j in range(2)) for row in result)
    return result


def commutator(a, b):
    return add(mul(a, b), scale(-1, mul(b, a)))


def inverse(m):
    (a, b), (c, d) = m
    reciprocal = R.one / (a * d - b * c)
    return scale(reciprocal, ((d, -b), (-c, a)))


def lift(m):
    return tuple(tuple(R.constant(x) if isinstance(x, fmpq) else R.rational(x) for x in row) for row in m)


def trace(m):
    return m[0][0] + m[1][1]


def hamiltonian_matrix(g, M):
    return add(mul(M, A2, M, B2), mul(M, C2, g), mul(g, D2, g, F2), mul(M, G2, M, g))


def xi_and_n(g, M):
    xi = add(mul(A2_, M, B2_), mul(B2_, M, A2_), mul(C2_, g), mul(G2_, M, g), mul(g, M, G2_))
    d_q = add(mul(g, M, C2_), mul(g, D2_, g, F2_), mul(g, F2_, g, D2_), mul(g, M, G2_, M))
    return xi, scale(-1, d_q)


A2_, B2_, C2_, D2_, F2_, G2_ = map(lift, (A2, B2, C2, D2, F2, G2))


def exp(x):
    result = term = lift(ID)
    for k in range(1, ORDER + 1):
        term = scale(fmpq(1, k), mul(term, x))
        result = add(result, term)
    return result


def dexp_dual(x, P):
    result = term = P
    for k in range(1, ORDER + 1):
        term = scale(fmpq(1, k + 1), commutator(term, x))
        result = add(result, term)
    return result


def coadjoint(g, P):
    return mul(inverse(g), P, g)


def vcg_step(A, b):
    """Solve (3.18); returns q1 and mu1, matrices over Q[[h]]."""
    s, h = range(len(b)), R.h
    q0, mu0 = lift(Q0), lift(MU0)
    xi, M = [lift(((0, 0), (0, 0)))] * len(b), [mu0] * len(b)
    for _ in range(2 * ORDER + 2):  # one power of h costs two sweeps: M lags behind xi
        q = [q0]
        for j in s:
            q.append(mul(exp(scale(h * b[j], xi[j])), q[-1]))
        Q = []
        for i in s:
            partial = [q0]
            for j in s:
                partial.append(mul(exp(scale(h * A[i][j], xi[j])), partial[-1]))
            Q.append(partial)
        both = [xi_and_n(Q[i][-1], M[i]) for i in s]
        xi, n = [x for x, _ in both], [y for _, y in both]
        nbar = [coadjoint(Q[i][-1], n[i]) for i in s]
        mubar1 = add(coadjoint(q0, mu0), *(scale(h * b[j], nbar[j]) for j in s))
        M = []
        for i in s:
            total = dexp_dual(scale(h * b[i], xi[i]), coadjoint(inverse(q[i + 1]), mubar1))
            for j in s:
                moved = dexp_dual(scale(h * A[j][i], xi[i]), coadjoint(inverse(Q[j][i + 1]), nbar[j]))
                total = add(total, scale(h * (-b[j] * A[j][i] / b[i]), moved))
            M.append(total)
    return q[-1], coadjoint(inverse(q[-1]), mubar1)


def vrkmk_step(A, b, cutoff):
    """Solve (3.16); returns q1 and mu1."""
    s, h = range(len(b)), R.h
    q0, mu0 = lift(Q0), lift(MU0)
    zero = lift(((0, 0), (0, 0)))
    X, xi, M, lam = ([x] * len(b) for x in (zero, zero, mu0, zero))
    for _ in range(2 * ORDER + 2):
        both = [xi_and_n(mul(exp(X[i]), q0), M[i]) for i in s]
        xi, n = [x for x, _ in both], [y for _, y in both]
        f = [dexpinv(X[i], xi[i], cutoff) for i in s]
        X = [add(zero, *(scale(h * A[i][j], f[j]) for j in s)) for i in s]
        Y = add(zero, *(scale(h * b[i], f[i]) for i in s))
        mu = add(mu0, *(scale(h * b[i], coadjoint(exp(X[i]), n[i])) for i in s))
        Lambda = dexp_dual(scale(-1, Y), mu)
        inner = [add(scale(b[i], Lambda), *(scale(A[j][i], lam[j]) for j in s)) for i in s]
        lam = [
            add(scale(h * -b[i], dexp_dual(X[i], n[i])), scale(h, P_dual(X[i], xi[i], inner[i], cutoff)))
            for i in s
        ]
        M = [scale(1 / b[i], dexpinv_dual(X[i], inner[i], cutoff)) for i in s]
    return mul(exp(Y), q0), coadjoint(exp(scale(-1, Y)), mu)


BERNOULLI = (fmpq(1), fmpq(-1, 2), fmpq(1, 6), fmpq(0), fmpq(-1, 30))


def dexpinv(x, y, cutoff):
    result = term = y
    for k in range(1, cutoff + 1):
        term = scale(fmpq(1, k), commutator(x, term))
        result = add(result, scale(BERNOULLI[k], term))
    return result


def dexpinv_dual(x, P, cutoff):
    result = term = P
    for k in range(1, cutoff + 1):
        term = scale(fmpq(1, k), commutator(term, x))
        result = add(result, scale(BERNOULLI[k], term))
    return result


def P_dual(x, xi, P, cutoff):
    if cutoff == 0:
        return scale(0, P)
    result, factorial = scale(fmpq(1, 2), commutator(P, xi)), 1
    for k in range(2, cutoff + 1):
        factorial *= k
        for i in range(k):
            inner, moved = xi, P
            for _ in range(k - 1 - i):
                inner = commutator(x, inner)
            for _ in range(i):
                moved = commutator(moved, x)
            result = add(result, scale(-BERNOULLI[k] / factorial, commutator(moved, inner)))
    return result


def vcf_step(alpha, beta):
    """Solve the discrete Hamilton equations of VCF; alpha[i], beta are rows over the stages."""
    s, h = range(len(alpha)), R.h
    b = [sum(row[i] for row in beta) for i in s]
    q0, mu0 = lift(Q0), lift(MU0)
    zero = lift(((0, 0), (0, 0)))
    xi, M = [zero] * len(b), [mu0] * len(b)

    def partial_products(rows):
        exponents = [add(zero, *(scale(h * row[j], xi[j]) for j in s)) for row in rows]
        places = [q0]
        for x in exponents:
            places.append(mul(exp(x), places[-1]))
        return exponents, places

    for _ in range(2 * ORDER + 2):
        Y, q = partial_products(beta)
        XQ = [partial_products(rows) for rows in alpha]
        both = [xi_and_n(XQ[i][1][-1], M[i]) for i in s]
        xi, n = [x for x, _ in both], [y for _, y in both]
        nbar = [coadjoint(XQ[i][1][-1], n[i]) for i in s]
        mubar1 = add(coadjoint(q0, mu0), *(scale(h * b[j], nbar[j]) for j in s))
        M = []
        for i in s:
            total = zero
            for J, row in enumerate(beta):
                total = add(total, scale(row[i], dexp_dual(Y[J], coadjoint(inverse(q[J + 1]), mubar1))))
            for j in s:
                for J, row in enumerate(alpha[j]):
                    moved = dexp_dual(XQ[j][0][J], coadjoint(inverse(XQ[j][1][J + 1]), nbar[j]))
                    total = add(total, scale(h * (-b[j] * row[i]), moved))
            M.append(scale(1 / b[i], total))
    return q[-1], coadjoint(inverse(q[-1]), mubar1)


def integral(x):
    return R.from_coefficients((fmpq(0), *(c / (k + 1) for k, c in enumerate(x.coefficients))))


def exact_flow():
    """Picard iteration of q' = xi q, mu' = n - ad*_xi mu (2.27)."""
    q, mu = lift(Q0), lift(MU0)
    for _ in range(ORDER + 1):
        xi, n = xi_and_n(q, mu)
        dq, dmu = mul(xi, q), add(n, scale(-1, commutator(mu, xi)))
        q = add(lift(Q0), tuple(tuple(map(integral, row)) for row in dq))
        mu = add(lift(MU0), tuple(tuple(map(integral, row)) for row in dmu))
    return q, mu


def difference(step):
    return [
        [x - y for rx, ry in zip(a, b, strict=True) for x, y in zip(rx, ry, strict=True)]
        for a, b in zip(step, exact_flow(), strict=True)
    ]


def rationals(rows):
    return tuple(tuple(fmpq(Fraction(x).numerator, Fraction(x).denominator) for x in row) for row in rows)


def butcher(A, b):
    return RungeKutta(rationals(A), rationals([b])[0])


def midpoints(*gamma):
    s = range(len(gamma))
    return butcher(
        [[gamma[j] if j < i else Fraction(gamma[i]) / 2 if j == i else 0 for j in s] for i in s], gamma
    )


KUTTA3 = butcher([[0, 0, 0], ["1/2", 0, 0], [-1, 2, 0]], ["1/6", "2/3", "1/6"])
FIRST = butcher([["1/3", "1/5"], ["-1/2", "2/3"]], ["3/4", "1/4"])
CUBES = midpoints("1/2", "2/3", "5/6", -1)  # sum 1, sum of cubes 0
GENERAL = CommutatorFree(
    (
        Stage(None, rationals([["1/3", "1/5"], ["-1/2", "1/7"]])),
        Stage(None, rationals([["1/4", "2/3"], ["1/6", "-1"], [1, "1/2"]])),
    ),
    Stage(None, rationals([["1/2", "-1/3"], ["-1/4", "5/6"], ["1/2", "-1/4"]])),
)

CASES = {
    "vcg, general tableau": ("vcg", FIRST, 1),
    "vcg, midpoint": ("vcg", midpoints(1), 2),
    "vcg, kutta3": ("vcg", KUTTA3, 2),
    "vcg, midpoints with sum of cubes zero": ("vcg", CUBES, 3),
    "vrkmk(0), kutta3": ("vrkmk(0)", KUTTA3, 2),
    "vrkmk(1), general tableau": ("vrkmk(1)", FIRST, 1),
    "vrkmk(1), kutta3": ("vrkmk(1)", KUTTA3, 3),
    "vrkmk(2), kutta3": ("vrkmk(2)", KUTTA3, 3),
    "vrkmk(2), midpoints with sum of cubes zero": ("vrkmk(2)", CUBES, 3),
    "vcf, general": ("vcf", GENERAL, 1),
    "vcf, Crouch-Grossman": ("vcf", KUTTA3, 2),
}


def step(label, method):
    if label == "vcg":
        return vcg_step(method.A, method.b)
    if label == "vcf":
        method = method if isinstance(method, CommutatorFree) else method.as_crouch_grossman(QQ)
        return vcf_step([stage.exponentials for stage in method.stages], method.update.exponentials)
    return vrkmk_step(method.A, method.b, int(label[6:-1]))


def defects(label, method, order):
    series = get(label).series(method, QQ)
    exact = action_exact.update_words(order)
    return {
        w: x - fmpq(exact[w].numerator, exact[w].denominator) for w, x in series.update_words(order).items()
    }


def gl2_fields():
    cells = [(i, j) for i in range(2) for j in range(2)]
    basis = tuple(
        tuple(tuple(fmpq(int((i, j) == cell)) for j in range(2)) for i in range(2)) for cell in cells
    )

    def hamiltonian(q, mu):
        # <P, E_ij> = P_ji
        return trace(hamiltonian_matrix(q, ((mu[0], mu[2]), (mu[1], mu[3]))))

    mu = (MU0[0][0], MU0[1][0], MU0[0][1], MU0[1][1])
    return ActionFields(QQ, hamiltonian, Q0, mu, basis, lambda m: tuple(m[i][j] for i, j in cells))


@pytest.mark.parametrize("name", CASES)
def test_local_error_starts_where_the_conditions_first_fail_and_is_what_they_predict(name):
    label, method, order = CASES[name]
    dq, dmu = difference(step(label, method))
    assert min(R.valuation(x) for x in dq + dmu) == order + 1

    found = defects(label, method, order + 1)
    assert all(x == 0 for w, x in found.items() if sum(t.vertices for t in w) <= order)
    leading = {w: x for w, x in found.items() if sum(t.vertices for t in w) == order + 1}
    point, momentum = gl2_fields().local_error(leading)
    assert [x.coefficients[order + 1] for x in dq] == [x for row in point for x in row]
    # Coordinates in the dual basis of E_ij are the transposed matrix.
    assert [dmu[k].coefficients[order + 1] for k in (0, 2, 1, 3)] == list(momentum)


def test_cf4_read_variationally_has_no_error_up_to_h4():
    # Its conditions hold to order 4; the series kept here end with h^4.
    method = Tableau.load(find("cf4")).method
    alpha = [method.from_start(stage) for stage in method.stages]
    dq, dmu = difference(vcf_step(alpha, method.update.exponentials))
    assert all(R.is_zero(x) for x in dq + dmu)


def test_the_elementary_velocity_of_the_leaf_is_the_hamiltonian_vector_field():
    fields = gl2_fields()
    xi, n = xi_and_n(lift(Q0), lift(MU0))
    constant = [[x.coefficients[0] for x in row] for row in xi]
    assert fields.velocity(velocity()) == tuple(x for row in constant for x in row)
    assert fields.covector(force()) == tuple(-n[j][i].coefficients[0] for i in range(2) for j in range(2))
