"""Scenes with actions on matrices, columns, duals and affine spaces: orders, and what steps keep."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import mpmath
import numpy as np
import pytest

from codegen.certify import certified_order
from codegen.emitter import emit
from codegen.groups.coordinate_maps import coordinate_map
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import interpret
from codegen.lab.orders.local_error import local_error, valuation
from codegen.loader import load as load_module
from codegen.lower import families_for, lower, problem_for
from codegen.method import parse
from codegen.scenes import load
from orderconds.ring import QQ

FOLDER = Path(__file__).parents[2] / "valid" / "scenes"

NAMES = (
    "toda_isospectral",
    "pca_flow",
    "lie_poisson_se2",
    "lie_poisson_so3",
    "semilinear",
    "frame_and_trajectory",
)

RITZ = (1.44869057, 12.34353752)


@cache
def scene(name, coordinates="exp"):
    found = load(str(FOLDER / f"{name}.py"))
    return replace(found, coordinates=coordinate_map(coordinates, found.group, name))


def lowered(name, label):
    """Return the problem and the program of a method."""
    found = scene(name)
    method = parse(label, families_for(found))
    problem = problem_for(found, method)
    return method, problem, lower(found, method)


def stepped(name, label, domain, y):
    """Return y after one interpreted step."""
    _, problem, program = lowered(name, label)
    return interpret(program, problem, domain, {"y": y})["y"]


LABELS = ("rkmk:rk4", "rkmk(1):kutta3", "cf:cf4", "cg:cg3", "rkmk(0):euler")


@pytest.mark.parametrize(
    ("name", "label"),
    [
        pytest.param(name, label, marks=() if label == "cf:cf4" else pytest.mark.slow)
        for name in NAMES
        for label in LABELS
    ],
)
def test_the_order_on_the_orbit_is_the_order_of_the_method(name, label):
    method, problem, program = lowered(name, label)
    order = certified_order(method, scene(name)).order
    assert order == {"rkmk:rk4": 4, "cf:cf4": 4, "rkmk(0):euler": 1}.get(label, 3)
    assert valuation(local_error(program, problem, QQ, order + 1)) == order + 1


class TestToda:
    @pytest.mark.parametrize("label", ["rkmk:rk4", pytest.param("cf:cf4", marks=pytest.mark.slow)])
    def test_emitted_steps_keep_the_eigenvalues(self, label):
        module = load_module(emit(scene("toda_isospectral"), label, "c"))
        start = np.array(module.initial).reshape(3, 3)
        after = np.array(module.run(module.initial, 0.01, 100_000)).reshape(3, 3)
        gap = np.linalg.eigvalsh((after + after.T) / 2) - np.linalg.eigvalsh(start)
        assert np.abs(gap).max() < 1e-12
        assert np.abs(after - after.T).max() < 1e-12

    def test_the_limit_is_diagonal_with_sorted_eigenvalues(self):
        module = load_module(emit(scene("toda_isospectral"), "rkmk:rk4", "c"))
        start = np.array(module.initial).reshape(3, 3)
        after = np.array(module.run(module.initial, 0.01, 5000)).reshape(3, 3)
        assert np.abs(after - np.diag(np.linalg.eigvalsh(start)[::-1])).max() < 1e-12


class TestPrincipalComponents:
    def test_lie_euler_finds_the_ritz_values(self):
        _, problem, program = lowered("pca_flow", "rkmk(0):euler")
        d = FloatDomain(0.05)
        y = tuple(float(x) for x in scene("pca_flow").initial(d))
        for _ in range(600):
            y = interpret(program, problem, d, {"y": y})["y"]
        self.check(y)

    @pytest.mark.parametrize("coordinates", ["cayley", pytest.param("second_kind", marks=pytest.mark.slow)])
    def test_emitted_lie_euler_finds_the_ritz_values(self, coordinates):
        module = load_module(emit(scene("pca_flow", coordinates), "rkmk(0):euler", "c"))
        self.check(module.run(module.initial, 0.05, 2000))

    def check(self, y):
        X = np.array(y).reshape(5, 2)
        A = np.minimum.outer(np.arange(1, 6), np.arange(1, 6))
        assert np.abs(np.linalg.eigvalsh(X.T @ A @ X) - RITZ).max() < 1e-8
        assert np.abs(X.T @ X - np.eye(2)).max() < 1e-12


@pytest.mark.parametrize("name", ["lie_poisson_se2", "lie_poisson_so3"])
@pytest.mark.parametrize("label", ["rkmk:rk4", pytest.param("cf:cf4", marks=pytest.mark.slow)])
def test_emitted_steps_keep_the_casimir_function(name, label):
    module = load_module(emit(scene(name), label, "c"))

    def casimir(y):
        return sum(x * x for x in (y[1:] if name == "lie_poisson_se2" else y))

    after = module.run(module.initial, 0.05, 2000)
    assert abs(casimir(after) - casimir(module.initial)) < 1e-13
    assert max(abs(a - b) for a, b in zip(after, module.initial, strict=True)) > 0.1


def test_emitted_steps_keep_the_coordinates_in_the_frame():
    module = load_module(emit(scene("frame_and_trajectory"), "cf:cf4", "c"))

    def inside(y):
        c, s, a, b, p, q = y
        return np.array([c * (p - a) + s * (q - b), -s * (p - a) + c * (q - b)])

    after = module.run(module.initial, 0.05, 200)
    assert np.abs(inside(after) - inside(module.initial)).max() < 1e-12


class TestExponentialEuler:
    """exp(h L) u + h phi(h L) N(u) with phi(w) = (exp(w) - 1)/w, by a series with 50 digits."""

    def formula(self, y, h):
        with mpmath.workdps(50):
            L = mpmath.matrix([[-4, 2, 0], [2, -4, 2], [0, 2, -4]])
            u, step = mpmath.matrix([mpmath.mpf(x) for x in y]), mpmath.mpf(h)
            N = mpmath.matrix([x - x**3 + mpmath.mpf(k + 1) / 10 for k, x in enumerate(u)])
            phi, term = mpmath.eye(3), mpmath.eye(3)
            for k in range(2, 80):
                term = term * L * step / k
                phi += term
            return mpmath.expm(step * L) * u + step * phi * N

    @pytest.mark.parametrize("h", [0.125, 0.03125, 2.0**-10])
    def test_is_lie_euler_on_an_affine_scene(self, h):
        d = FloatDomain(h)
        y = tuple(float(x) for x in scene("semilinear").initial(d))
        for _ in range(5):
            after = stepped("semilinear", "rkmk(0):euler", d, y)
            for a, b in zip(after, self.formula(y, h), strict=True):
                assert abs(mpmath.mpf(a) - b) <= 8 * np.spacing(max(abs(a) for a in after))
            y = after

    def test_is_lie_euler_with_forty_digits(self):
        d = PreciseDomain(Fraction(1, 8), 40)
        y = scene("semilinear").initial(d)
        after = stepped("semilinear", "rkmk(0):euler", d, y)
        with mpmath.workdps(50):
            gaps = [abs(mpmath.mpf(a) - b) for a, b in zip(after, self.formula(y, 0.125), strict=True)]
        assert max(gaps) < 1e-37
