"""Formulas of whole matrices have the values that NumPy computes, and form no matrix with n^2 entries."""

from __future__ import annotations

import numpy as np
import pytest
import sympy

from codegen.errors import SceneError
from codegen.ir.array_program import Multiplication
from codegen.ir.domain import FloatDomain
from codegen.scene import StiefelScene, banded, full, unknown
from codegen.scene.formulas import Reader
from codegen.scene.matrix_reader import array_program

N, K = 7, 3
X = unknown(N, K)
BAND = banded(N, {-2: [1, 2, 3, 4, 5], 0: lambda i: 1 / (i + 1), 6: 7})
WIDE = banded(N, {0: 1, 1: 2}, columns=N + 1)
TALL = full(N, 2, [[i - j for j in range(2)] for i in range(N)])
SMALL = banded(K, {0: lambda i: i + 1, 1: -1})

BAND_ARRAY = np.diag([1.0, 2, 3, 4, 5], -2) + np.diag([1 / (i + 1) for i in range(N)]) + np.diag([7.0], 6)
WIDE_ARRAY = np.eye(N, N + 1) + 2 * np.eye(N, N + 1, 1)
TALL_ARRAY = np.array([[float(i - j) for j in range(2)] for i in range(N)])
SMALL_ARRAY = np.diag([1.0, 2, 3]) - np.diag([1.0, 1], 1)

FORMULAS = {
    "band": (lambda x, a, w, b, s: a @ x),
    "transposed band": (lambda x, a, w, b, s: a.T @ x),
    "from the right": (lambda x, a, w, b, s: x @ s - 2 * x @ s.T),
    "rectangular": (lambda x, a, w, b, s: w @ (w.T @ x)),
    "full": (lambda x, a, w, b, s: b @ (b.T @ x)),
    "transposed product": (lambda x, a, w, b, s: ((x.T @ a) @ x @ x.T).T),
    "long product": (lambda x, a, w, b, s: x @ x.T @ a @ x - a.T @ x @ x.T @ x / 3),
    "sum of constants": (lambda x, a, w, b, s: (a + 2 * a.T) @ x @ (s - s.T)),
    "sum as a factor": (lambda x, a, w, b, s: (x + a @ x) @ (x.T @ x - x.T @ b @ b.T @ x)),
    "transposed sum": (lambda x, a, w, b, s: (x.T + s @ x.T @ a).T),
    "sum with n^2 entries": (lambda x, a, w, b, s: (x @ x.T - x @ s @ x.T) @ (a + x @ x.T) @ x),
    "only the unknown": (lambda x, a, w, b, s: 3 * x - 2 * x),
}


def program(formula, x=X):
    return array_program(Reader("test", []), x, formula)


@pytest.mark.parametrize("name", FORMULAS)
def test_a_formula_has_the_value_that_numpy_computes(name):
    point = np.random.default_rng(1).normal(size=(N, K))
    compiled = program(FORMULAS[name](X, BAND, WIDE, TALL, SMALL))
    value = compiled.evaluate(FloatDomain(0.0), point.ravel().tolist(), {})
    expected = FORMULAS[name](point, BAND_ARRAY, WIDE_ARRAY, TALL_ARRAY, SMALL_ARRAY)
    assert np.abs(np.reshape(value, (N, K)) - expected).max() < 1e-12 * (1 + np.abs(expected).max())


def test_every_stored_matrix_has_few_columns_and_equal_products_are_computed_once():
    compiled = program(BAND @ X - X @ X.T @ BAND @ X)
    assert all(statement.target.columns <= K for statement in compiled.body)
    assert sum(isinstance(statement, Multiplication) for statement in compiled.body) == 2
    assert len(compiled.body) == 4


def test_a_sum_with_many_entries_is_multiplied_out():
    compiled = program((X @ X.T - X @ SMALL @ X.T) @ (BAND + X @ X.T) @ X)
    assert all(statement.target.columns <= K for statement in compiled.body)


@pytest.mark.parametrize(
    "formula",
    [
        lambda: X.T @ BAND,
        lambda: X @ X.T,
        lambda: unknown(N, K) + X,
        lambda: BAND @ TALL @ TALL.T @ X + full(N, K, 1),
        lambda: banded(N, {0: [1, 2]}) @ X,
        lambda: banded(N, {0: ["a"] * N}) @ X,
        lambda: sympy.Symbol("x") * X,
        lambda: X @ X,
        lambda: BAND @ BAND @ full(N, K, 1) + X,
        lambda: X * X,
        lambda: X + np.zeros((N, K)),
        lambda: banded(N, {N: 1}),
        lambda: banded(N, {}),
        lambda: full(0, 3, 1),
    ],
)
def test_a_wrong_formula_is_refused(formula):
    with pytest.raises(SceneError):
        program(formula())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"velocity": BAND @ X}, "not tangent"),
        ({"y0": [1] * (N * K)}, "not orthonormal"),
        ({"y0": [1]}, "components"),
        ({"x": 3}, "x = 3"),
        ({"x": unknown(2, 3), "velocity": unknown(2, 3)}, "orthonormal columns of 2 rows"),
    ],
)
def test_a_wrong_scene_is_refused(arguments, words):
    given = {"x": X, "velocity": BAND @ X - X @ X.T @ BAND @ X, "span": (0, 1), **arguments}
    with pytest.raises(SceneError, match=words):
        StiefelScene(**given)
