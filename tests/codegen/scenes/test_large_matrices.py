"""Steps on matrices with orthonormal columns by loops over arrays: values, orders, work, text and refusals.

The oracle is the same scene with formulas in coordinates of SO(n): its programs are interpreted with the
exponentials of n x n matrices.
"""

from __future__ import annotations

import re
from collections import Counter
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest
import sympy
from click.testing import CliRunner
from scipy.linalg import expm

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.errors import MethodError, SceneError
from codegen.integrator import StepFailed
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.precision import DOUBLE
from codegen.kernel.operations import STEP, step_operations
from codegen.lab.orders.convergence import converge
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.loader import load as load_module
from codegen.lower import lower, method_for
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.unit import unit_of
from codegen.scene import StiefelScene, banded, full, param, unknown
from codegen.scenes import load
from orderconds.cli import program
from orderconds.ring import QQ

EXAMPLE = Path(__file__).parents[3] / "examples" / "eigenspace" / "eigenspace.py"
DENSE = Path(__file__).parents[2] / "valid" / "scenes" / "pca_flow.py"
RITZ = (1.44869057, 12.34353752)
METHODS = ("rkmk(0):euler", "rkmk:rk4", "rkmk(2):rk4", "cf:cf4", "cg:cg3")
QUICK = METHODS[0]


def slow(*values):
    return pytest.param(*values, marks=pytest.mark.slow)


@cache
def principal_components():
    return load("principal_components")


@cache
def tridiagonal(n, k=4):
    X = unknown(n, k)
    A = banded(n, {-1: -1, 0: 2, 1: -1})
    return StiefelScene(x=X, velocity=A @ X - X @ (X.T @ A @ X), span=(0, 1), name="tridiagonal")


@cache
def driven():
    """A field with time, a parameter, entries given as numbers, and X^T V that is not zero."""
    n, k = 6, 3
    X, t, c = unknown(n, k), sympy.Symbol("t"), param("c", 0.5)
    A = banded(n, {-2: [1, 2, 3, 4], 0: lambda i: c / (i + 1), 1: sympy.Rational(1, 3)})
    B = full(n, 2, [[i - 2 * j for j in range(2)] for i in range(n)])
    F = (A + A.T) @ X @ banded(k, {0: lambda i: i + 1, 1: t}) - B @ (B.T @ X) + sympy.cos(t) * X
    V = F - X @ (X.T @ F + F.T @ X) / 2
    return StiefelScene(x=X, velocity=V, span=(0, 1), name="driven")


@cache
def module(scene, label, target="c"):
    return load_module(emit(scene(), label, target))


def matrix(y, k):
    return np.reshape(y, (-1, k))


def defect(y, k):
    return np.abs(matrix(y, k).T @ matrix(y, k) - np.eye(k)).max()


def interpreted(scene, label, domain, y, t):
    """Return a step with formulas in coordinates of SO(n)."""
    method = method_for(scene, label)
    inputs = {"y": tuple(domain.rational(*x.as_integer_ratio()) for x in y), "t": domain.rational(*t)}
    program = lower(scene, method)
    return interpret(program, scene, domain, inputs)["y"]


class TestValues:
    @pytest.mark.parametrize(
        ("scene", "label"),
        [
            *((principal_components, label) for label in METHODS[:2]),
            (driven, QUICK),
            *(slow(principal_components, label) for label in METHODS[2:]),
            *(slow(driven, label) for label in METHODS[1:]),
        ],
    )
    def test_a_step_has_the_value_with_formulas_in_coordinates(self, scene, label):
        own, k = module(scene, label, "python"), scene().matrices.columns
        start, h = list(map(float, own.initial)), 2.0**-5
        timed = {"t": 0.25} if own.interface.time else {}
        # A first step leaves the special initial state.
        start = own.step(start, h, **timed)
        after = own.step(start, h, **timed)
        domain = FloatDomain(h)
        exact = interpreted(scene(), label, domain, tuple(map(float, start)), (1, 4))
        assert np.abs(np.array(after) - exact).max() < 8e-15
        assert np.abs(np.array(after) - start).max() > 1e-3
        assert defect(after, k) < 4e-15

    def test_a_step_has_the_value_of_forty_digits(self):
        own = module(principal_components, "rkmk:rk4", "python")
        start = own.step(own.initial, 2.0**-5)
        exact = interpreted(
            principal_components(),
            "rkmk:rk4",
            PreciseDomain(Fraction(1, 32), 40),
            tuple(map(float, start)),
            (0, 1),
        )
        assert max(abs(x - float(y)) for x, y in zip(own.step(start, 2.0**-5), exact, strict=True)) < 2e-15

    @pytest.mark.parametrize("label", [QUICK, *map(slow, METHODS[1:])])
    def test_python_and_c_compute_the_same_numbers(self, label):
        for scene in (principal_components, driven):
            first, second = module(scene, label), module(scene, label, "python")
            timed = {"t": 0.25} if first.interface.time else {}
            steps = [list(own.step(own.initial, 0.1, **timed)) for own in (first, second)]
            assert steps[0] == steps[1]

    def test_lie_euler_with_fifty_rows_is_the_exponential_of_the_generator(self):
        own, h = load_module(emit(tridiagonal(50), "rkmk(0):euler", "c")), 0.3
        X = np.linalg.qr(np.random.default_rng(1).normal(size=(50, 4)))[0]
        A = 2 * np.eye(50) - np.eye(50, k=1) - np.eye(50, k=-1)
        V = A @ X - X @ X.T @ A @ X
        values, vectors = np.linalg.eigh(1j * h * (V @ X.T - X @ V.T))
        moved = ((vectors * np.exp(-1j * values)) @ vectors.conj().T).real @ X
        assert np.abs(matrix(own.step(X.ravel(), h), 4) - moved).max() < 1e-14

    @pytest.mark.parametrize("h", [1.0, 30.0, 1000.0])
    def test_long_steps_keep_the_columns_orthonormal(self, h):
        own = module(principal_components, "rkmk(0):euler")
        assert defect(own.run(own.initial, h, 3), 2) < 1e-15 * (10 + 10 * h)

    def test_a_parameter_stays_an_argument(self):
        kept, changed = (
            load_module(emit(driven(), QUICK, "python", parameters=[text])) for text in ("c", "c=2")
        )
        start, fixed = kept.initial, module(driven, QUICK, "python")
        assert list(kept.step(start, 0.1)) == list(fixed.step(start, 0.1))
        assert list(kept.step(start, 0.1, c=2.0)) == list(changed.step(start, 0.1))

    def test_single_precision_keeps_its_digits(self):
        own = load_module(emit(principal_components(), QUICK, "c", precision="single"))
        double = module(principal_components, QUICK)
        after, exact = own.run(own.initial, 0.0625, 10), double.run(double.initial, 0.0625, 10)
        assert np.abs(np.array(after) - exact).max() < 2e-5


class TestStepControl:
    @pytest.mark.slow
    @pytest.mark.parametrize("target", ["python", "c"])
    @pytest.mark.parametrize(
        "label", ["cf43", pytest.param("rkmk(4):dormand_prince5", marks=pytest.mark.slow)]
    )
    def test_a_run_with_step_control_makes_the_steps_of_a_run_in_coordinates(self, label, target):
        own, dense = (
            load_module(emit(s, label, target, adaptive=True))
            for s in (principal_components(), load(str(DENSE)))
        )
        runs = [m.adaptive(m.initial, t=0.0, end=1.0, rtol=1e-6, atol=1e-8) for m in (own, dense)]
        assert (runs[0].accepted, runs[0].rejected) == (runs[1].accepted, runs[1].rejected)
        assert runs[0].accepted > 5
        assert np.abs(np.array(runs[0].state) - runs[1].state).max() < 1e-12


class TestPrincipalComponents:
    def test_emitted_lie_euler_finds_the_ritz_values(self):
        own = module(principal_components, "rkmk(0):euler")
        X = matrix(own.run(own.initial, 0.05, 2000), 2)
        A = np.minimum.outer(np.arange(1, 6), np.arange(1, 6))
        assert np.abs(np.linalg.eigvalsh(X.T @ A @ X) - RITZ).max() < 1e-8
        assert defect(X, 2) < 1e-13

    @pytest.mark.parametrize("label", [QUICK, slow("cf:cf3")])
    def test_runs_agree_with_steps_in_coordinates(self, label):
        own, dense = module(principal_components, label), load_module(emit(load(str(DENSE)), label, "c"))
        gap = np.array(own.run(own.initial, 0.05, 40)) - dense.run(dense.initial, 0.05, 40)
        assert np.abs(gap).max() < 2e-14

    def test_the_local_error_of_the_program_has_the_order_exactly(self):
        # The entries Min(i, j) are numbers, so the field is smooth.
        scene = principal_components()
        program = lower(scene, method_for(scene, "cf:cf3"))
        assert valuation(local_error(program, scene, QQ, 4)) == 4

    @pytest.mark.slow
    @pytest.mark.parametrize("label", ["rkmk:rk4", "cf:cf4", "cg:cg3"])
    @pytest.mark.parametrize("scene", [principal_components, driven])
    def test_emitted_steps_have_their_order(self, scene, label):
        made = compile_method(scene(), label)
        stated = certified_order(made.method, made.scene)
        result = converge(Emitted(made, "c", stated), stated, reference(made.scene))
        assert result.verdict == "holds", result.sentence()


class TestLargeMatrices:
    @pytest.mark.slow
    @pytest.mark.parametrize("label", [QUICK, "rkmk:rk4", "cf:cf4"])
    @pytest.mark.parametrize("scene", [principal_components, lambda: tridiagonal(50)])
    def test_columns_stay_orthonormal_in_a_hundred_thousand_steps(self, scene, label):
        own, k = load_module(emit(scene(), label, "c")), scene().matrices.columns
        assert defect(own.run(own.initial, 0.05, 100_000), k) < 1e-12

    def test_columns_stay_orthonormal_with_eight_hundred_rows(self):
        own = load_module(emit(load(str(EXAMPLE)), QUICK, "c"))
        X = np.linalg.qr(np.random.default_rng(1).normal(size=(800, 4)))[0]
        assert defect(own.run(X.ravel(), 0.1, 200), 4) < 1e-14

    @pytest.mark.parametrize("target", ["c", "python"])
    @pytest.mark.parametrize("label", [QUICK, slow("rkmk:rk4")])
    def test_the_text_does_not_depend_on_the_number_of_rows(self, label, target):
        texts = []
        for n in (300, 900):
            files = emit(tridiagonal(n), label, target, prefix="columns").files
            texts.append([re.sub(r"\d+", "#", line) for text in files.values() for line in text.splitlines()])
        assert texts[0] == texts[1]

    @pytest.mark.slow
    def test_rotations_are_square_matrices_and_their_text_does_not_depend_on_the_size(self):
        texts = []
        for n in (8, 12):
            X, A = unknown(n, n), banded(n, {-1: -1, 1: 1})
            # V = Omega X with the skew matrix Omega = A + X A X^T
            scene = StiefelScene(x=X, velocity=A @ X + X @ A, span=(0, 1), name="turns")
            artifact = emit(scene, QUICK, "c", prefix="turns")
            source = artifact.files["turns.c"].partition("*/")[2]
            texts.append([re.sub(r"\d+", "#", line) for line in source.splitlines()])
            start = np.linalg.qr(np.random.default_rng(n).normal(size=(n, n)))[0]
            a = np.diag([1] * (n - 1), 1) - np.diag([1] * (n - 1), -1)
            after = np.array(load_module(artifact).step(start.ravel().tolist(), 0.125)).reshape(n, n)
            assert np.abs(after - expm(0.125 * (a + start @ a @ start.T)) @ start).max() < 1e-14
        assert texts[0] == texts[1]

    @pytest.mark.parametrize("label", ["rkmk(0):euler", "rkmk:rk4", "cf:cf4"])
    def test_the_counted_work_grows_linearly_with_the_rows(self, label):
        counts = []
        for n in (100, 200, 300):
            counts.append(sum(step_operations(compile_method(tridiagonal(n), label).kernel)[STEP].values()))
        assert counts[2] - counts[1] == counts[1] - counts[0] > 0

    @pytest.mark.parametrize("label", [QUICK, slow("cf:cf3")])
    def test_the_executed_work_grows_linearly_with_the_rows(self, label):
        counts = [executed_operations(n, label) for n in (12, 24, 36)]
        assert counts[2] - counts[1] == counts[1] - counts[0] > 0

    def test_the_counted_work_is_the_executed_work(self):
        slope = executed_operations(24, QUICK) - executed_operations(12, QUICK)
        counts = [step_operations(compile_method(tridiagonal(n), QUICK).kernel)[STEP] for n in (12, 24)]
        stated = sum(counts[1].values()) - sum(counts[0].values())
        # Sums begin with an addition to zero, which the statement does not count.
        assert stated <= slope < 1.2 * stated


class Counted(float):
    """A float that counts additions and multiplications."""

    total: ClassVar[Counter[str]] = Counter()

    def _counted(self, name, other):
        Counted.total[name] += 1
        return Counted(getattr(float, name)(self, other))

    def __add__(self, other):
        return self._counted("__add__", other)

    def __sub__(self, other):
        return self._counted("__sub__", other)

    def __mul__(self, other):
        return self._counted("__mul__", other)

    __radd__, __rmul__ = __add__, __mul__


class CountedFloats(FloatDomain):
    def rational(self, p, q=1):
        return Counted(p / q)

    def number(self, value):
        return Counted(super().number(value))


def executed_operations(n, label):
    """Return the number of additions and multiplications that a step of this length executes."""
    unit = unit_of(Plan(compile_method(tridiagonal(n), label).kernel, DOUBLE))
    X = np.linalg.qr(np.random.default_rng(1).normal(size=(n, 4)))[0]
    state = [Counted(x) for x in X.ravel()]
    # In so short a step each exponential has two terms, whatever the norm of the field.
    Counted.total.clear()
    Machine(unit, CountedFloats(0.0)).call("step", state, Counted(1e-7))
    return Counted.total.total()


class TestText:
    def test_a_table_is_emitted_once_although_the_matrix_depends_on_time(self):
        X, t = unknown(6, 2), sympy.Symbol("t")
        A = banded(6, {0: [1, 2, 3, 4, 5, 6], 1: t, -1: t})
        scene = StiefelScene(x=X, velocity=A @ X - X @ (X.T @ A @ X), span=(0, 1), name="twice")
        for target, line in (
            ("c", "double twice_rkmk_rk4_matrix_1_diagonal_1[6] ="),
            ("python", "1.0, 2.0, 3.0"),
        ):
            text = "".join(emit(scene, "rkmk:rk4", target).files.values())
            assert text.count(line) == 1

    def test_the_header_contains_no_comment_in_a_comment_if_the_state_is_long(self):
        X = unknown(40, 2)
        scene = StiefelScene(
            x=X,
            velocity=0 * X,
            span=(0, 1),
            y0=[x for i in range(40) for x in (sympy.sqrt(10) / 20, sympy.sqrt(10) / 20 * (-1) ** i)],
            name="long",
        )
        for text in emit(scene, QUICK, "c").files.values():
            for comment in re.findall(r"/\*(.*?)\*/", text, re.DOTALL):
                assert "/*" not in comment
        assert "copy the initial state from the manifest" in text


class TestRefusals:
    @pytest.mark.parametrize(
        ("label", "words"),
        [
            ("rkmk:gauss2", "implicit stages"),
            ("ambient:rk4", "formulas with large matrices as operands"),
            ("taylor(4)", "formulas with large matrices as operands"),
            ("vcg:midpoint", "a Hamiltonian scene"),
        ],
    )
    def test_a_method_without_loops_is_refused(self, label, words):
        with pytest.raises(MethodError, match=words):
            compile_method(tridiagonal(40), label)

    def test_arrays_that_may_overflow_the_stack_are_refused(self, monkeypatch):
        monkeypatch.setattr("codegen.printers.c.module.LARGEST_STACK", 2**20)
        emit(tridiagonal(900), QUICK, "c")
        monkeypatch.setattr("codegen.printers.c.module.LARGEST_STACK", 2**17)
        with pytest.raises(SceneError, match="MiB of the stack"):
            emit(tridiagonal(900), QUICK, "c")

    def test_the_derivative_of_a_step_is_refused(self):
        with pytest.raises(MethodError, match=r"--jacobian .* large matrices"):
            compile_method(tridiagonal(40), "rkmk:rk4", jacobian=True)

    @pytest.mark.parametrize("option", ["integrate", "dense", "compensate"])
    def test_a_run_to_an_end_time_and_compensated_summation_are_refused(self, option):
        with pytest.raises(MethodError, match=rf"--{option} .* large matrices"):
            compile_method(tridiagonal(40), "rkmk:rk4", **{option: True})

    @pytest.mark.parametrize("command", ["stability", "localerror", "bench"])
    def test_measurements_in_coordinates_are_refused(self, command):
        done = CliRunner().invoke(program, [command, str(EXAMPLE), "--method", "rkmk:rk4"])
        assert done.exit_code == 2
        assert "no formulas in coordinates" in done.stderr

    def test_operations_of_the_group_are_refused(self):
        scene = tridiagonal(40)
        with pytest.raises(SceneError, match="a method of the family rkmk, cf or cg"):
            scene.group.exp(FloatDomain(0.0), (0.0,) * scene.group.dim)
        with pytest.raises(SceneError, match="no formulas"):
            scene.require_formulas()

    def test_a_step_that_cannot_be_computed_has_a_cause(self):
        own = module(principal_components, "rkmk(0):euler")
        with pytest.raises(StepFailed, match="too long"):
            own.step(own.initial, 1e9)
        with pytest.raises(StepFailed, match="not finite"):
            own.step([float("inf"), *own.initial[1:]], 0.1)
