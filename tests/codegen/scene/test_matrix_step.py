"""Steps that a scene states as functions of matrices: types, values, orders and refusals."""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest
from sympy import Matrix, Symbol, cos, sin

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit
from codegen.errors import MethodError, SceneError
from codegen.groups import GL, SL2, SO3, LeftMultiplication, Linear, Sp
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.lab.orders.convergence import converge
from codegen.lab.reference import cached_reference
from codegen.lab.runner import Emitted
from codegen.loader import load as loaded
from codegen.lower import method_for
from codegen.scene import LinearScene
from codegen.scene.matrix_step import IDENTITY, A, Evaluation, Place, bracket, expm, h, logm, projected
from codegen.scenes import load
from orderconds.errors import InputError

t = Symbol("t")
PROJECTION = expm(projected(logm(IDENTITY + h * A(0))))
OSCILLATOR = "linear_oscillator_sl2"


def value(formula, group, generator, domain):
    """Return the value of a formula for a constant generator."""
    return formula.value(Evaluation(group, domain, lambda c: generator))


def test_types_follow_from_the_parts():
    inside, outside = bracket(A(0), 2 * A(1)) - h / 2 * A(0), A(0) * A(1)
    assert (inside.place, outside.place) == (Place.ALGEBRA, Place.MATRIX)
    assert (expm(inside).place, expm(outside).place) == (Place.GROUP, Place.MATRIX)
    assert (expm(inside) * expm(h * A(1))).place is Place.GROUP
    assert (IDENTITY + h * A(0)).place is Place.MATRIX
    assert logm(expm(inside)).place is Place.MATRIX
    assert projected(outside).place is Place.ALGEBRA


@pytest.mark.parametrize(
    "entries",
    [(0.3, -1, 2, 0.7), (1.3, 1, 0.5, 0.7), (1, 0, 0, 1), (0.5, 2, 0, 0.5), (-0.2, -1, 1, -0.3)],
    ids=["turn", "hyperbolic", "unit", "shear", "turn by more than a quarter"],
)
@pytest.mark.parametrize("digits", [16, 40])
def test_exp_and_log_of_matrices_with_two_rows_are_the_functions_of_mpmath(entries, digits):
    d = FloatDomain(0.5) if digits == 16 else PreciseDomain(Fraction(1, 2), digits)
    given = tuple(d.rational(*Fraction(str(x)).as_integer_ratio()) for x in entries)
    group = GL(2)
    with mpmath.workdps(digits + 5):
        matrix = mpmath.matrix(2, 2)
        for k, x in enumerate(given):
            matrix[k // 2, k % 2] = x
        for formula, function in ((expm(IDENTITY * A(0)), mpmath.expm), (logm(A(0)), mpmath.logm)):
            expected = function(matrix)
            found = value(formula, group, given, d)
            for k, x in enumerate(found):
                assert abs(x - mpmath.re(expected[k // 2, k % 2])) < 10 ** (2 - digits)


def test_the_projection_onto_sp_is_that_of_equation_4_18():
    d, group = FloatDomain(0.0), Sp(4)
    matrix = Matrix(4, 4, lambda i, j: (3 * i + 5 * j + i * j) % 7 - 3)
    J = Matrix([[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, 0, 0], [0, -1, 0, 0]])
    expected = (matrix + J * matrix.T * J) / 2

    class Given(type(IDENTITY)):
        def value(self, at):
            return tuple(map(float, matrix))

    found = projected(Given()).value(Evaluation(group, d, lambda c: ()))
    assert found == pytest.approx([float(x) for x in expected], abs=1e-14)


@pytest.mark.parametrize("name", ["projection", "exp_non_can", "exp_sym_non_can"])
def test_a_stated_step_has_its_order_from_below_and_above(name):
    made = compile_method(OSCILLATOR, f"step:{name}")
    stated = certified_order(made.method, made.scene)
    found = converge(Emitted(made, "c"), stated, cached_reference(made.scene))
    assert found.verdict == "holds", found.sentence()


def test_emitted_c_and_python_agree_on_a_stated_step():
    start = list(load(OSCILLATOR).initial(FloatDomain(0.0)))
    ends = [loaded(emit(OSCILLATOR, "step:projection", x)).run(start, 0.3, 10, 1.0) for x in ("c", "python")]
    assert ends[0] == pytest.approx(ends[1], rel=1e-14)


def test_the_header_names_the_stated_step_and_its_command():
    files = emit(OSCILLATOR, "step:projection", "c").files
    text = next(text for name, text in files.items() if name.endswith(".c"))
    assert "the step projection, which the scene defines" in text
    assert "--method step:projection" in " ".join(text.replace("*", " ").split())


def test_a_step_that_the_scene_does_not_state_is_refused():
    with pytest.raises(
        MethodError, match="the scene defines no step 'x'; expected one of projection, exp_non_can"
    ):
        method_for(load(OSCILLATOR), "step:x")
    with pytest.raises(MethodError, match="a scene that defines steps"):
        method_for(load("dipole"), "step:projection")


def test_only_a_step_in_the_group_advances_the_momentum_of_the_time():
    compile_method(f"{OSCILLATOR}+u", "step:projection")
    with pytest.raises(MethodError, match="is not known to be symplectic"):
        compile_method(f"{OSCILLATOR}+u", "step:exp_non_can")


def test_a_stated_step_has_no_error_estimate():
    with pytest.raises(InputError, match="has no tableau"):
        compile_method(OSCILLATOR, "step:projection", adaptive=True)


SKEW = Matrix([[0, -t, 1], [t, 0, -sin(t)], [-1, sin(t), 0]])


def scene(steps, group=None, action=None, matrix=SKEW, y0=(1, 0, 0)):
    return LinearScene(
        group=group or SO3(),
        action=action or Linear(),
        A=matrix,
        y0=list(y0),
        span=(0, 1),
        steps=steps,
        name="given",
    )


def test_larger_matrices_have_exp_of_the_algebra_only():
    midpoint = expm(h * A(Fraction(1, 2)))
    made = compile_method(scene({"middle": (midpoint, 2)}), "step:middle")
    other = compile_method(scene({}), "magnus:magnus2")
    start = [1.0, 0.0, 0.0]
    ends = [Emitted(x, "python").integrator.run(start, 0.1, 5, 0.0) for x in (made, other)]
    assert ends[0] == pytest.approx(ends[1], rel=1e-14)
    with pytest.raises(SceneError, match=r"log\(\(1 \+ h A\(t\)\)\) for 3 x 3 matrices has no closed form"):
        scene({"projection": (PROJECTION, 1)})


@pytest.mark.parametrize(
    ("given", "match"),
    [
        ({"steps": {"x": (PROJECTION, 0)}}, "the order 0"),
        (
            {"steps": {"x": (PROJECTION, 1)}, "matrix": Matrix([[0, 1], [-1, 0]])},
            "does not depend on the time",
        ),
        ({"action": LeftMultiplication(), "y0": (1, 0, 0, 1)}, "the action left multiplication"),
    ],
    ids=["order", "constant matrix", "action"],
)
def test_a_step_that_cannot_be_used_is_refused_with_the_reason(given, match):
    usual = {"steps": {"x": (PROJECTION, 1)}, "group": SL2(), "y0": (1, 0)}
    usual |= {"matrix": Matrix([[0, 1], [-cos(t), 0]])}
    with pytest.raises(SceneError, match=match):
        scene(**(usual | given))
