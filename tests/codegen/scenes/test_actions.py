"""Scenes with actions on matrices, columns, duals and affine spaces: orders, and what steps keep."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import mpmath
import numpy as np
import pytest
from sympy import Matrix, Symbol

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.groups import SO, Conjugation
from codegen.groups.coordinate_maps import coordinate_map
from codegen.groups.linear_algebra import units
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import interpret
from codegen.lab.orders.convergence import converge
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.loader import load as load_module
from codegen.lower import families_for, lower, problem_for
from codegen.method import parse
from codegen.scene import FieldScene
from codegen.scenes import GALLERY, load
from orderconds.ring import QQ

FOLDER = Path(__file__).parents[2] / "valid" / "scenes"
"""Scenes of tests; all other names are names of the gallery."""

NAMES = (
    "toda_lattice",
    "pca_flow",
    "planar_body_in_fluid",
    "lie_poisson_so3",
    "semilinear",
    "frame_and_trajectory",
)

RITZ = (1.44869057, 12.34353752)


@cache
def scene(name, coordinates="exp"):
    found = load(name if name in GALLERY else str(FOLDER / f"{name}.py"))
    return replace(found, coordinates=coordinate_map(coordinates, found.group, name))


def lowered(name, label):
    """Return the problem and the program of a method."""
    found = scene(name)
    method = parse(label, families_for(found))
    problem = problem_for(found, method)
    return method, problem, lower(found, method)


@cache
def emitted(name, label, target):
    return load_module(emit(scene(name), label, target))


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
        module = load_module(emit(scene("toda_lattice"), label, "c"))
        start = np.array(module.initial).reshape(3, 3)
        after = np.array(module.run(module.initial, 0.01, 100_000)).reshape(3, 3)
        gap = np.linalg.eigvalsh((after + after.T) / 2) - np.linalg.eigvalsh(start)
        assert np.abs(gap).max() < 1e-12
        assert np.abs(after - after.T).max() < 1e-12

    def test_the_limit_is_diagonal_with_sorted_eigenvalues(self):
        module = load_module(emit(scene("toda_lattice"), "rkmk:rk4", "c"))
        start = np.array(module.initial).reshape(3, 3)
        after = np.array(module.run(module.initial, 0.01, 5000)).reshape(3, 3)
        assert np.abs(after - np.diag(np.linalg.eigvalsh(start)[::-1])).max() < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("label", ["rkmk:rk4", "cf:cf4"])
def test_emitted_steps_keep_the_eigenvalues_of_eight_particles(label):
    n, group = 8, SO(8)
    L = Matrix(n, n, lambda i, j: Symbol(f"l{i}_{j}", real=True))
    places = [(i, j) for i in range(n) for j in range(n)]
    start = [int(abs(i - j) == 1) + int(i == j) * (i * i % 5 - 2) for i, j in places]
    # The generator is L above the diagonal and -L below it.
    upper = Matrix(n, n, [L[i, j] * (int(i < j) - int(i > j)) for i, j in places])
    lattice = FieldScene(
        group=group,
        action=Conjugation(),
        y=list(L),
        f=[sum(g * x for g, x in zip(row, upper, strict=True)) / 2 for row in coordinates_of(group)],
        y0=start,
        span=(0, 5),
        velocity=list(upper * L - L * upper),
        name="toda8",
    )
    module = load_module(emit(lattice, label, "c"))
    after = np.array(module.run(module.initial, 0.01, 100_000)).reshape(n, n)
    before = np.array(module.initial).reshape(n, n)
    gap = np.linalg.eigvalsh((after + after.T) / 2) - np.linalg.eigvalsh(before)
    assert np.abs(gap).max() < 1e-12


def coordinates_of(group):
    """Return the matrices of the basis, as integers."""
    d = FloatDomain(0.0)
    return [[int(a) for a in group.hat(d, x)] for x in units(d, group.dim)]


class TestPrincipalComponents:
    @pytest.mark.parametrize(
        "coordinates", ["exp", *(pytest.param(c, marks=pytest.mark.slow) for c in ("cayley", "second_kind"))]
    )
    def test_emitted_lie_euler_finds_the_ritz_values(self, coordinates):
        module = load_module(emit(scene("pca_flow", coordinates), "rkmk(0):euler", "c"))
        self.check(module.run(module.initial, 0.05, 2000))

    @pytest.mark.slow
    @pytest.mark.parametrize("coordinates", ["exp", "cayley"])
    def test_emitted_rkmk4_converges_with_order_four(self, coordinates):
        made = compile_method(scene("pca_flow", coordinates), "rkmk:rk4")
        stated = certified_order(made.method, made.scene)
        result = converge(Emitted(made, "c", stated), stated, reference(made.scene))
        assert stated.order == 4
        assert result.verdict == "holds", result.sentence()

    def check(self, y):
        X = np.array(y).reshape(5, 2)
        A = np.minimum.outer(np.arange(1, 6), np.arange(1, 6))
        assert np.abs(np.linalg.eigvalsh(X.T @ A @ X) - RITZ).max() < 1e-8
        assert np.abs(X.T @ X - np.eye(2)).max() < 1e-12


@pytest.mark.parametrize("name", ["planar_body_in_fluid", "lie_poisson_so3"])
@pytest.mark.parametrize("label", ["rkmk:rk4", pytest.param("cf:cf4", marks=pytest.mark.slow)])
def test_emitted_steps_keep_the_casimir_function(name, label):
    module = load_module(emit(scene(name), label, "c"))

    def casimir(y):
        return sum(x * x for x in (y[1:] if name == "planar_body_in_fluid" else y))

    after = module.run(module.initial, 0.05, 2000)
    assert abs(casimir(after) - casimir(module.initial)) < 1e-13
    assert max(abs(a - b) for a, b in zip(after, module.initial, strict=True)) > 0.1


@pytest.mark.slow
@pytest.mark.parametrize("label", ["rkmk:rk4", "cf:cf4"])
def test_a_hundred_thousand_steps_keep_the_casimir_function_on_the_dual_of_se2(label):
    module = load_module(emit(scene("planar_body_in_fluid"), label, "c"))
    _, *start = module.initial
    _, *end = module.run(module.initial, 0.01, 100_000)
    assert abs(np.dot(end, end) - np.dot(start, start)) < 1e-12
    assert np.abs(np.subtract(end, start)).max() > 0.1


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

    @pytest.mark.parametrize("target", ["c", pytest.param("python", marks=pytest.mark.slow)])
    @pytest.mark.parametrize("h", [1.0, 0.25, 2.0**-10])
    def test_is_emitted_lie_euler(self, h, target):
        module = emitted("semilinear", "rkmk(0):euler", target)
        y = module.initial
        for _ in range(10):
            after = module.step(y, h)
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

    @pytest.mark.slow
    @pytest.mark.parametrize("label", ["rkmk:rk4", "cf:cf4"])
    def test_methods_of_order_four_converge_while_the_norm_of_h_times_l_is_below_one(self, label):
        made = compile_method(scene("semilinear"), label)
        stated = certified_order(made.method, made.scene)
        steps = tuple(2**k for k in range(3, 8))
        result = converge(Emitted(made, "c", stated), stated, reference(made.scene), steps=steps)
        runs = result.refinement.clean
        # The eigenvalue of L with the largest absolute value is -4 - 2 sqrt(2).
        assert [run.h for run in runs] == [1 / n for n in steps]
        assert runs[0].h * (4 + 8**0.5) < 1
        assert stated.order == 4
        assert result.verdict == "holds", result.sentence()
        assert all(abs(slope - 4) < 0.1 for slope in result.refinement.slopes)
