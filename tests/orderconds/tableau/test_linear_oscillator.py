"""Table 4.1 of Marthinsen's thesis, from the tableaux of the library: energy errors of a linear oscillator.

H = ((1 + 0.1 sin(0.123 t)) q.q + p.p)/2 in four dimensions is one 2 x 2 system four times over, so a step is
a 2 x 2 matrix for any linear method. The matrices of all 166666 steps of h = 0.3 are found at once, from the
coefficients alone; the reference is Lie-Gauss with h = 0.02, as printed. Printed numbers have three figures,
and are found to them.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest

from orderconds.tableau import Magnus, PartitionedRungeKutta, RungeKutta, Tableau, find
from orderconds.tableau.brackets import Bracket
from orderconds.tableau.file import text_of

STEPS, H, FINE = 166_666, 0.3, 15
START = np.array([[1.0, 2.0, 3.0, 4.0], [4.0, 1.0, 2.0, 3.0]])

PRINTED = {
    "magnus4": 3.20e-5,  # Lie-Gauss
    "lie_midpoint_triple_jump": 1.50e-4,
    "magnus2": 4.56e-3,  # Lie-midpoint
    "lie_euler": 2.50e-2,
    "gauss2": 7.98e-2,
    "triple_jump": 1.49e-1,
    "midpoint": 1.49e-1,
    "kahan_triple_jump": 1.50e-1,
    "kahan": 1.68e-1,
    "symplectic_euler": 6.44,
    "radau2a2": 3.15e1,
}
"""The greatest |H_k - H_ex| of each method; the rest is no tableau (docs/reference/library.md)."""


def stiffness(t):
    return 1 + 0.1 * np.sin(0.123 * t)


def field(t):
    """A(t) of (q, p)' = A(t) (q, p)."""
    A = np.zeros((*t.shape, 2, 2))
    A[..., 0, 1], A[..., 1, 0] = 1, -stiffness(t)
    return A


def exponential(X):
    """exp of matrices without trace: X^2 = -det(X) I."""
    square = -np.linalg.det(X)
    root = np.sqrt(square.astype(complex))
    cosh, sinhc = np.cosh(root).real, (np.sinh(root) / root).real
    return cosh[:, None, None] * np.eye(2) + sinhc[:, None, None] * X


def runge_kutta(method, t, h, number):
    """Solve K_i = A(t + c_i h) (y + h sum_j a_ij K_j) for all y at once."""
    A, b = [[number(x) for x in row] for row in method.A], [number(x) for x in method.b]
    s = len(b)
    system, right = np.zeros((len(t), 2 * s, 2 * s)), np.zeros((len(t), 2 * s, 2))
    for i, row in enumerate(A):
        field_i = field(t + sum(row) * h)
        right[:, 2 * i : 2 * i + 2] = field_i
        for j, a in enumerate(row):
            system[:, 2 * i : 2 * i + 2, 2 * j : 2 * j + 2] = (i == j) * np.eye(2) - h * a * field_i
    K = np.linalg.solve(system, right)
    return np.eye(2) + h * sum(x * K[:, 2 * i : 2 * i + 2] for i, x in enumerate(b))


def partitioned(method, t, h, number):
    """Q_i = q + h sum_j a_ij P_j, P_i = p - h sum_j ahat_ij k(t + c_j h) Q_j: time goes with the position."""
    A, A_hat = ([[number(x) for x in row] for row in rows] for rows in (method.A, method.A_hat))
    b, b_hat = ([number(x) for x in row] for row in (method.b, method.b_hat))
    s = len(b)
    k = [stiffness(t + sum(row) * h) for row in A]
    system, right = np.zeros((len(t), 2 * s, 2 * s)), np.zeros((len(t), 2 * s, 2))
    for i in range(s):
        system[:, i, i] = system[:, s + i, s + i] = 1
        right[:, i, 0] = right[:, s + i, 1] = 1
        for j in range(s):
            system[:, i, s + j] -= h * A[i][j]
            system[:, s + i, j] += h * A_hat[i][j] * k[j]
    stages = np.linalg.solve(system, right)
    step = np.broadcast_to(np.eye(2), (len(t), 2, 2)).copy()
    for i in range(s):
        step[:, 0] += h * b[i] * stages[:, s + i]
        step[:, 1] -= h * b_hat[i] * k[i][:, None] * stages[:, i]
    return step


def magnus(method, t, h, number):
    nodes = [h * field(t + number(c) * h) for c in method.c]

    def value(term):
        if isinstance(term, Bracket):
            x, y = value(term.left), value(term.right)
            return x @ y - y @ x
        return nodes[term]

    step = np.eye(2)
    for exponent in method.exponents:
        step = exponential(sum(number(x) * value(term) for term, x in exponent)) @ step
    return step


def step_matrices(name, t, h):
    return matrices_of(Tableau.load(find(name)), t, h)


def matrices_of(tableau, t, h):
    def number(x):
        return float(tableau.ring.approximate(x))

    method = tableau.read_as(("rk",)) or tableau.method
    for kind, build in (
        (RungeKutta, runge_kutta),
        (PartitionedRungeKutta, partitioned),
        (Magnus, magnus),
    ):
        if isinstance(method, kind):
            return build(method, t, h, number)
    raise TypeError(method)


def energies(steps):
    """H after each step, from the step matrices in order."""
    k = stiffness(H * np.arange(1, len(steps) + 1))
    states, y = np.empty((len(steps), 2, 4)), START
    for i, step in enumerate(steps):
        y = step @ y
        states[i] = y
    return (k * (states[:, 0] ** 2).sum(axis=1) + (states[:, 1] ** 2).sum(axis=1)) / 2


@lru_cache(maxsize=1)
def reference():
    t = H / FINE * np.arange(FINE * STEPS)
    fine = step_matrices("magnus4", t, H / FINE).reshape(STEPS, FINE, 2, 2)
    coarse = fine[:, 0]
    for i in range(1, FINE):
        coarse = fine[:, i] @ coarse
    return energies(coarse)


@pytest.mark.slow
@pytest.mark.parametrize("name", PRINTED)
def test_the_library_reproduces_the_energy_errors_of_table_4_1(name):
    found = abs(energies(step_matrices(name, H * np.arange(STEPS), H)) - reference()).max()
    assert found == pytest.approx(PRINTED[name], rel=0.005)


@pytest.mark.slow
def test_a_wrong_sign_or_a_frozen_time_is_seen():
    t = H * np.arange(STEPS)
    text = text_of(find("magnus4"))
    wrong = Tableau.loads(text.replace("[2,1]", "[1,2]"))
    exact = reference()
    assert abs(energies(matrices_of(wrong, t, H)) - exact).max() > 2 * PRINTED["magnus4"]
    late = energies(step_matrices("magnus2", t - H / 2, H))
    assert abs(late - exact).max() > 2 * PRINTED["magnus2"]


def test_the_step_matrices_have_the_order_of_their_method():
    """Before 166666 steps are believed: one step against many small ones, at two step lengths."""
    orders = {"magnus4": 4, "lie_midpoint_triple_jump": 4, "kahan": 2, "radau2a2": 3, "symplectic_euler": 1}
    for name, order in orders.items():
        errors = []
        for h in (0.2, 0.1):
            t = h / 64 * np.arange(64)
            exact = np.eye(2)
            for step in step_matrices("magnus4", t + 3, h / 64):
                exact = step @ exact
            errors.append(abs(step_matrices(name, np.array([3.0]), h)[0] - exact).max())
        assert np.log2(errors[0] / errors[1]) == pytest.approx(order + 1, abs=0.2), name
