"""Matrix groups from a basis: structure constants, coordinates, and bases that are none."""

from __future__ import annotations

import math
import random

import pytest

from codegen.errors import SceneError
from codegen.groups import GL, SO3, MatrixGroup
from codegen.groups.linear_algebra import invert, matmul
from codegen.ir.domain import ExprDomain, FloatDomain, PreciseDomain, SeriesDomain
from orderconds.ring import QQ
from tests.strategies import heisenberg

D = SeriesDomain(QQ, 3)
HATS = [
    [[0, 0, 0], [0, 0, -1], [0, 1, 0]],
    [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
    [[0, -1, 0], [1, 0, 0], [0, 0, 0]],
]


def vector(n, seed=0):
    rng = random.Random(seed)
    return tuple(D.h * D.rational(rng.randint(-5, 5), rng.randint(1, 4)) for _ in range(n))


def test_rotations_by_their_basis_are_those_in_closed_form():
    """Rodrigues' formulas against exponential series: every operation, exactly."""
    closed, general = SO3(), MatrixGroup("so(3) by its basis", HATS)
    x, y, mu = vector(3, 1), vector(3, 2), tuple(a + 1 for a in vector(3, 3))
    g = closed.exp(D, y)
    assert general.exp(D, y) == g
    assert general.ad(D, x, y) == closed.ad(D, x, y)
    assert general.adt(D, x, mu) == closed.adt(D, x, mu)
    assert general.dexpt(D, x, mu) == closed.dexpt(D, x, mu)
    assert general.Ad(D, g, x) == closed.Ad(D, g, x)
    assert general.Adt(D, g, mu) == closed.Adt(D, g, mu)
    assert general.Adtinv(D, g, mu) == closed.Adtinv(D, g, mu)
    assert general.velocity(D, x, g) == closed.velocity(D, x, g)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_bracket_of_gl_is_the_commutator(n):
    group = GL(n)
    x, y = vector(n * n, 1), vector(n * n, 2)
    commutator = tuple(a - b for a, b in zip(matmul(x, y, n), matmul(y, x, n), strict=True))
    assert group.ad(D, x, y) == commutator
    assert group.abelian == (n == 1)


def test_hat_and_vee_are_inverse():
    group = heisenberg()
    x = vector(3)
    assert group.vee(D, group.hat(D, x)) == x


def test_coordinates_need_no_orthogonal_basis():
    slanted = MatrixGroup("slanted", [[[0, 1, 1], [0, 0, 0], [0, 0, 0]], [[0, 0, 2], [0, 0, 0], [0, 0, 0]]])
    x = vector(2)
    assert slanted.vee(D, slanted.hat(D, x)) == x
    assert slanted.abelian


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_the_inverse_matrix_is_exact(n):
    rng = random.Random(n)
    while True:
        g = tuple(D.rational(rng.randint(-5, 5)) + D.h for _ in range(n * n))
        try:
            assert matmul(g, invert(D, g, n), n) == GL(n).identity(D)
        except ZeroDivisionError:
            continue
        return


@pytest.mark.parametrize(
    ("basis", "message"),
    [
        ([], "is empty, or a matrix is not square"),
        ([[[1, 0]]], "is empty, or a matrix is not square"),
        ([[[1, 0], [0, 1]], [[1]]], "is empty, or a matrix is not square"),
        ([[[1, 0], [0, 1]], [[2, 0], [0, 2]]], "linearly dependent"),
        ([[[0, 1], [0, 0]], [[0, 0], [1, 0]]], "is not a linear combination of the basis matrices"),
    ],
)
def test_a_basis_that_is_none_is_refused(basis, message):
    with pytest.raises(SceneError, match=message):
        MatrixGroup("broken", basis)


@pytest.mark.parametrize("x", [1e3, 1e300, math.nan, math.inf])
def test_an_exponential_that_leaves_the_numbers_is_not_finite(x):
    assert not all(map(math.isfinite, GL(2).exp(FloatDomain(0.1), (x, 1.0, 0.0, x))))


def test_an_exact_exponential_needs_a_nilpotent_constant_term():
    one = D.rational(1)
    with pytest.raises(ArithmeticError, match="has more than"):
        GL(2).exp(D, (one, one, one, one))


def test_a_large_exponential_has_all_digits():
    d = PreciseDomain(0, 40)
    found = GL(1).exp(d, (d.rational(60),))[0]
    assert abs(found / d.context.exp(60) - 1) < 1e-38


def test_over_expressions_the_exponential_of_a_nilpotent_algebra_is_a_polynomial():
    d = ExprDomain()
    x = tuple(d.space.sym(f"x{k}") for k in range(3))
    assert str(heisenberg().exp(d, x)[2]) in ("(x2 + (1/2 * (x0 * x1)))", "((1/2 * (x0 * x1)) + x2)")
    whole = GL(2).exp(d, (*x, x[0]))
    assert [node.payload for node in whole] == [f"expm2.{k}" for k in range(4)]
