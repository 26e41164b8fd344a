"""Large linear problems: exponentials applied to vectors, their orders, their work, and refusals.

Oracles: programs interpreted with 50 digits and the exponentials of n x n matrices, the exact solution of
commuting problems, and ``scipy.sparse.linalg.expm_multiply``.
"""

from __future__ import annotations

import math
import re
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
import sympy
from scipy.sparse import diags
from scipy.sparse.linalg import expm_multiply

from codegen.emitter import compile_method, emit
from codegen.errors import MethodError, SceneError
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.lab.reference import reference
from codegen.loader import load
from codegen.lower import lower, method_for
from codegen.scene import LargeLinearScene, banded, full, param

t = sympy.Symbol("t")
METHODS = ("magnus4", "fer4", "cf_magnus4", "magnus6", "fer6", "cf_magnus6", "magnus8", "rkmk:rk4", "cf:cf4")


def slow(*values):
    return pytest.param(*values, marks=pytest.mark.slow)


@cache
def chain(n=5):
    """A banded problem with formulas in t and in the index, a list of numbers and a transpose."""
    steady = banded(n, {-1: 1, 0: -2, 1: [sympy.Rational(k + 1, n) for k in range(n - 1)]})
    moved = banded(n, {0: lambda i: sympy.sin(t * (i + 1)), -2: lambda i: sympy.cos(t) * i / n})
    return LargeLinearScene(
        A=2 * steady + sympy.cos(t) * moved.T, span=(0, 1), y0=range(1, n + 1), name="chain"
    )


@cache
def dense():
    """A full problem with two columns, a parameter, a banded term and a transpose."""
    c = param("c", 2)
    kernel = full(4, 4, lambda i, j: c * sympy.cos(i - 2 * j) * t / (i + j + 1) + sympy.sin(t * i - j))
    shifted = banded(4, {0: 1, -1: [1, 2, 3], 2: lambda i: i + 1})
    return LargeLinearScene(A=kernel.T / 2 + t * shifted, span=(0, 1), columns=2, name="dense")


@cache
def hopping(n):
    """A skew matrix with a driven coupling: the length of y is constant."""
    drive = sympy.cos(3 * t) / 2
    steady, driven = banded(n, {1: 1, -1: -1}), banded(n, {2: lambda i: i + 1, -2: lambda i: 1 - i}) / n
    return LargeLinearScene(A=steady + drive * driven, span=(0, 1), y0=lambda i: (i + 1) % 7, name="hopping")


@cache
def heat(n):
    """A multiple of one matrix, so the exact solution is an exponential."""
    laplacian = banded(n, {-1: 1, 0: -2, 1: 1})
    return LargeLinearScene(A=laplacian * (1 + 2 * t), span=(0, 1), y0=lambda i: i * (n - i), name="heat")


@cache
def module(scene, label, target="python"):
    return load(emit(scene(), label, target))


def precise(scene, label, state, h):
    """Return a step with 50 digits, by the exponentials of n x n matrices."""
    domain = PreciseDomain(Fraction(h), 50)
    inputs = {"y": tuple(domain.rational(*x.as_integer_ratio()) for x in state), "t": domain.rational(1, 8)}
    method = method_for(scene, label)
    return interpret(lower(scene, method), scene, domain, inputs)["y"]


class TestValues:
    @pytest.mark.parametrize(
        ("scene", "label"),
        [
            (chain, "magnus4"),
            (chain, "cf_magnus6"),
            *(slow(scene, label) for scene in (chain, dense) for label in METHODS),
        ],
    )
    def test_a_step_has_the_value_of_fifty_digits(self, scene, label):
        own = module(scene, label)
        state = [0.25 + 0.125 * i for i in range(len(scene().symbols))]
        exact = precise(scene(), label, state, 0.25)
        after = own.step(state, 0.25, t=0.125)
        assert max(abs(float(x - y)) for x, y in zip(after, exact, strict=True)) < 5e-16
        assert max(abs(x - y) for x, y in zip(after, state, strict=True)) > 0.1

    @pytest.mark.parametrize(("scene", "label"), [(dense, "magnus4"), *(slow(chain, x) for x in METHODS)])
    def test_python_and_c_compute_the_same_numbers(self, scene, label):
        first, second = module(scene, label, "c"), module(scene, label)
        for h in (0.1, -0.5):
            a, b = (own.step(own.initial, h, t=0.5) for own in (first, second))
            assert list(np.ravel(a)) == list(np.ravel(b))

    @pytest.mark.slow
    def test_a_parameter_stays_an_argument(self):
        kept, fixed = (load(emit(dense(), "magnus4", "python", parameters=[c])) for c in ("c", "c=3"))
        assert list(kept.step(kept.initial, 0.1, t=0.2, c=3.0)) == list(fixed.step(fixed.initial, 0.1, t=0.2))
        assert list(kept.step(kept.initial, 0.1, t=0.2)) != list(fixed.step(fixed.initial, 0.1, t=0.2))

    @pytest.mark.slow
    def test_single_precision_keeps_its_digits(self):
        single = load(emit(chain(), "magnus6", "c", precision="single"))
        double = module(chain, "magnus6")
        gap = np.subtract(
            single.run(single.initial, 0.125, 8, t=0.0), double.run(double.initial, 0.125, 8, t=0.0)
        )
        assert 0 < np.abs(gap).max() < 2e-5


class TestOrders:
    @pytest.mark.parametrize(
        ("label", "order"),
        [
            ("cf_magnus4", 4),
            *(slow(label, 4) for label in ("magnus4", "fer4", "rkmk:rk4", "cf:cf4")),
            *(slow(label, 6) for label in ("magnus6", "fer6", "cf_magnus6")),
        ],
    )
    def test_errors_decrease_with_the_stated_power_of_the_step(self, label, order):
        exact, errors = _exact(), []
        for steps in (8, 16):
            own = module(chain, label)
            end = own.run(own.initial, 1 / steps, steps, t=0.0)
            errors.append(max(abs(x - y) for x, y in zip(end, exact, strict=True)))
        slope = math.log2(errors[0] / errors[1])
        assert order - 0.15 < slope < order + 0.35

    def test_the_other_sign_of_the_bracket_is_caught(self):
        # [2, 1] = A_2 A_1 - A_1 A_2 for a left action; with the other sign the order is 2.
        wrong = precise_with_sign(-1)
        assert wrong > 50 * precise_with_sign(1)


def precise_with_sign(sign):
    """Return the error of one step of magnus4 on the chain, with a sign in front of the bracket."""
    scene, h, r = chain(), 0.125, math.sqrt(3)
    fields = [_matrix(scene, h * (0.5 + c * r / 6)) for c in (-1, 1)]
    x = h / 2 * (fields[0] + fields[1]) + sign * r / 12 * h**2 * (
        fields[1] @ fields[0] - fields[0] @ fields[1]
    )
    fine = np.array([float(y) for y in scene.initial(PreciseDomain(1, 20))])
    own = module(chain, "magnus8")
    return np.abs(expm_multiply(x, fine) - own.run(own.initial, h / 8, 8, t=0.0)).max()


def _matrix(scene, time):
    d = PreciseDomain(1, 20)
    entries = scene.matrices.generator(d, (), scene.scalars(d, d.context.mpf(time)))
    n = scene.matrices.rows
    return np.array([float(x) for x in entries]).reshape(n, n)


@cache
def _exact():
    return [float(x) for x in reference(chain()).state]


class TestThousandRows:
    def test_the_length_is_kept_by_a_skew_matrix(self):
        own = load(emit(hopping(1000), "cf_magnus4", "c"))
        start = np.array(own.initial, dtype=float)
        end = np.array(own.run(start, 0.25, 200, t=0.0))
        assert abs(np.linalg.norm(end) / np.linalg.norm(start) - 1) < 5e-14
        assert np.linalg.norm(end - start) > 1

    @pytest.mark.slow
    @pytest.mark.parametrize(
        ("label", "h"),
        # The bound of a commutator is a product of norms, so methods with commutators make shorter steps. So
        # does cf_magnus6, because its third exponent is negative: a diffusion backwards amplifies errors.
        [("cf_magnus4", 20.0), ("cf_magnus6", 1.0), ("magnus4", 1.0), ("magnus6", 1.0), ("fer4", 1.0)],
    )
    def test_a_long_step_is_the_exponential_of_the_integral(self, label, h):
        n = 1000
        own = load(emit(heat(n), label, "c"))
        start = np.array(own.initial, dtype=float)
        # Values at different times commute: the exponent is the integral of 1 + 2 t times the matrix.
        laplacian = diags([np.ones(n - 1), -2 * np.ones(n), np.ones(n - 1)], [-1, 0, 1]).tocsr()
        exact = expm_multiply(laplacian * (h + h * h), start)
        assert np.abs(own.step(start, h, t=0.0) - exact).max() < 1e-11 * np.abs(exact).max()

    @pytest.mark.parametrize("target", ["c", slow("python")])
    @pytest.mark.parametrize("label", ["cf_magnus4", slow("magnus6")])
    def test_the_text_does_not_depend_on_the_number_of_rows(self, label, target):
        texts = []
        for n in (100, 1000):
            files = emit(hopping(n), label, target, prefix="hopping").files
            texts.append(
                [re.sub(r"[\d.]+", "#", line) for text in files.values() for line in text.splitlines()]
            )
        assert texts[0] == texts[1]

    @pytest.mark.slow
    @pytest.mark.parametrize("label", ["magnus4", "cf_magnus6"])
    def test_python_makes_a_step_with_a_thousand_rows(self, label):
        first, second = (load(emit(hopping(1000), label, target)) for target in ("c", "python"))
        assert list(first.step(first.initial, 0.1, t=0.0)) == list(second.step(second.initial, 0.1, t=0.0))


class TestWork:
    def test_the_difference_of_values_replaces_a_value_in_a_commutator(self):
        # [A_2, A_1] = [A_2 - A_1, A_1]: the bound of the difference is small for a short step.
        step = compile_method(chain(), "magnus4").kernel.arrays
        ((left, _),) = step.commutators
        assert sum(float(c) for _, c in step.letters[left.letter]) == 0

    def test_the_work_grows_linearly_with_the_rows(self):
        counts = [
            compile_method(hopping(n), "magnus6").kernel.arrays.operations()["mul"] for n in (50, 100, 150)
        ]
        assert counts[2] - counts[1] == counts[1] - counts[0] > 0

    def test_equal_nodes_are_evaluated_once(self):
        assert len(compile_method(chain(), "rkmk:rk4").kernel.arrays.times) == 3


class TestFailures:
    def test_too_long_a_step_has_a_status_and_keeps_the_state(self):
        own = module(chain, "cf_magnus4")
        with pytest.raises(StepFailed) as failed:
            own.step(own.initial, 1e6, t=0.0)
        assert failed.value.status == Status.TOO_FAR
        assert list(failed.value.state) == list(own.initial)

    def test_an_entry_that_is_not_finite_has_a_status(self):
        scene = LargeLinearScene(A=banded(9, {0: lambda i: 1 / (t - 1), 1: 1}), span=(0, 2), name="pole")
        own = load(emit(scene, "magnus2", "python"))
        with pytest.raises(StepFailed) as failed:
            own.step(own.initial, 2.0, t=0.0)
        assert failed.value.status in (Status.NOT_FINITE, Status.TOO_FAR)

    @pytest.mark.parametrize(
        ("label", "options", "words"),
        [
            ("cayley4", {}, "operation act"),
            ("rkmk:gauss2", {}, "implicit stages"),
            ("cf:cf3", {"adaptive": True}, "step control"),
            ("magnus4", {"integrate": True}, "--integrate"),
            ("magnus4", {"events": 2}, "--events"),
            ("magnus4", {"compensate": True}, "--compensate"),
            ("magnus4", {"jacobian": True}, "--jacobian"),
        ],
    )
    def test_what_has_no_loops_is_refused(self, label, options, words):
        with pytest.raises(MethodError, match=words):
            compile_method(chain(), label, **options)

    def test_methods_in_coordinates_need_few_rows(self):
        with pytest.raises(MethodError, match="formulas with large matrices as operands") as refused:
            compile_method(hopping(40), "taylor(4)")
        assert "magnus, cf_magnus or fer" in refused.value.hint
        with pytest.raises(SceneError, match="no formulas"):
            hopping(40).require_formulas()

    @pytest.mark.parametrize(
        ("arguments", "words"),
        [
            ({"A": [[1, 2], [3, 4]]}, "A is of type list"),
            ({"A": banded(4, {0: 1}, columns=5)}, "4 x 5"),
            ({"A": banded(1, {0: 1})}, "1 x 1"),
            ({"A": banded(4, {0: 1}) @ banded(4, {0: 1})}, "product of matrices"),
            ({"A": banded(4, {0: sympy.Symbol("x")})}, "x"),
            ({"A": banded(4, {1: [1, 2]})}, "2 entries"),
            ({"A": banded(4, {0: 1}), "y0": [1, 2]}, "y0 has 2"),
            ({"A": banded(4, {0: 1}), "columns": 5}, "columns = 5"),
            ({"A": banded(4, {0: 1}), "y0": lambda i: t}, "t"),
            ({"A": banded(4, {0: 1}), "span": (1, 0)}, "span"),
        ],
    )
    def test_arguments_that_make_no_sense_are_refused(self, arguments, words):
        with pytest.raises(SceneError, match=re.escape(words)):
            LargeLinearScene(**{"span": (0, 1), **arguments})


def test_a_transpose_has_the_entries_of_the_transpose():
    given = banded(5, {2: lambda i: i + 1, -1: [1, 2, 3, 4]}) + full(5, 5, lambda i, j: i - 3 * j * t)
    listed = full(5, 5, [[i * j + i for j in range(5)] for i in range(5)])
    one, two = (LargeLinearScene(A=A, span=(0, 1)) for A in (given + listed, given.T + listed.T))
    assert np.array_equal(_matrix(one, 0.5).T, _matrix(two, 0.5))


@pytest.mark.slow
def test_converge_confirms_the_order_on_the_example():
    from codegen.certify import certified_order
    from codegen.lab.orders.convergence import converge
    from codegen.lab.runner import Emitted

    compiled = compile_method(chain(12), "cf_magnus6")
    stated = certified_order(compiled.method, compiled.scene)
    result = converge(Emitted(compiled, "c", stated), stated, reference(compiled.scene))
    assert result.verdict == "holds", result.sentence()
