"""References against numbers computed elsewhere, closed forms, and fields that have no reference."""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable
from pathlib import Path

import mpmath
import pytest
from sympy import Abs, Matrix, Rational, exp, sqrt, symbols

from codegen.errors import SceneError
from codegen.groups import LeftMultiplication, Rn
from codegen.lab import piecewise_field
from codegen.lab import reference as references
from codegen.lab.reference import Reference, reference
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from codegen.scenes import load

Exact = Callable[[str], Reference]

# scenes of the thesis recomputed by a Taylor method: first row of g and mu at t = 0.5
DIPOLE_G = ("0.9237505661876837714", "0.3829945723223079841", "-0.0002214488339615999")
DIPOLE_MU = ("-0.5361870181330790305", "0.003780620329717814678")


def scene(f: object, start: list[object], span: tuple[object, object]) -> Problem:
    y = Matrix(symbols(f"y0:{len(start)}", real=True))
    field = f(y)  # type: ignore[operator]
    return FieldScene(
        group=Rn(len(start)), action=LeftMultiplication(), y=y, f=field, y0=Matrix(start), span=span, name="s"
    )


def test_the_dipole_agrees_with_published_digits(exact: Exact) -> None:
    found = exact("dipole")
    assert found.uncertainty < 1e-30
    context = mpmath.mp.clone()
    context.dps = 40
    for value, text in zip((*found.state[:3], *found.state[9:11]), DIPOLE_G + DIPOLE_MU, strict=True):
        assert abs(value - context.mpf(text)) < 1e-19
    assert abs(found.state[11]) < 1e-30


@pytest.mark.parametrize("name", ["dipole", "free_rigid_body"])
def test_the_reference_keeps_every_invariant_of_its_scene(name: str, exact: Exact) -> None:
    from codegen.ir.domain import PreciseDomain

    problem, domain = load(name), PreciseDomain(0, 45)
    for invariant in problem.invariants:
        before, after = (
            problem.invariant(domain, invariant, state)
            for state in (problem.initial(domain), exact(name).state)
        )
        assert abs(after - before) < 1e-30


def test_a_rotation_with_time_dependent_speed_has_its_closed_form() -> None:
    t = symbols("t", real=True)
    found = reference(scene(lambda y: Matrix([-2 * t * y[1], 2 * t * y[0]]), [1, 0], (0, 2)))
    context = mpmath.mp.clone()
    context.dps = 45
    for value, closed in zip(found.state, (context.cos(4), context.sin(4)), strict=True):
        assert abs(value - closed) < 1e-30


def test_a_solution_that_blows_up_within_the_span_is_an_error_of_the_scene() -> None:
    with pytest.raises(SceneError, match=r"beyond t = (1|0\.99)"):
        reference(scene(lambda y: Matrix([y[0] ** 2]), [1], (0, 2)))


def test_the_refusal_of_a_hidden_kink_names_a_possible_reason() -> None:
    """The formula is smooth for SymPy, but its value is |y - 1|."""
    hidden = scene(lambda y: Matrix([1 + sqrt(y[0] ** 2 - 2 * y[0] + 1)]), [0], (0, 2))
    with pytest.raises(SceneError, match=r"beyond t = 0\.69.*; perhaps the field is not smooth"):
        reference(hidden)


def test_two_solutions_that_disagree_name_a_possible_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(references, "AGREEMENT", 0.0)
    with pytest.raises(SceneError, match=r"differ by .* perhaps the field is not smooth"):
        reference(scene(lambda y: Matrix([-y[0]]), [1], (0, 1)))


def test_a_field_with_a_pole_on_the_way_is_an_error_of_the_scene() -> None:
    with pytest.raises(SceneError, match=r"beyond t = 0\.12[45]"):
        reference(scene(lambda y: Matrix([-1 / y[0]]), [Rational(1, 2)], (0, 1)))


def test_a_solution_that_ends_within_the_span_is_an_error_that_says_when() -> None:
    with pytest.raises(SceneError, match=r"beyond t = 0\.6[01]"):
        reference(scene(lambda y: Matrix([-1 - sqrt(y[0])]), [1], (0, 3)))


def test_a_power_of_a_coordinate_near_zero_is_a_number() -> None:
    """A ball that contains zero has no power in python-flint, but its product with itself."""
    start = [Rational(1, 3), Rational(1, 3), 0]
    found = reference(scene(lambda y: Matrix([y[0] / 3, y[0] / 3, y[0] - y[1] + y[2] ** 2]), start, (0, 1)))
    assert found.state[2] == 0


def test_a_periodic_toda_lattice_at_rest_in_its_centre_of_mass_has_a_reference() -> None:
    def field(y: Matrix) -> Matrix:
        force = [exp(y[k] - y[(k + 1) % 3]) for k in range(3)]
        return Matrix([*y[3:], *(force[k - 1] - force[k] for k in range(3))])

    start = [Rational(1, 5), Rational(-1, 5), 0, Rational(1, 3), Rational(-1, 3), 0]
    found = reference(scene(field, start, (0, 1)))
    assert abs(sum(found.state[:3])) < 1e-30
    assert abs(sum(found.state[3:])) < 1e-30


def test_toda_lattice_in_flaschka_variables_has_a_reference() -> None:
    def field(y: Matrix) -> Matrix:
        a, b = y[:2], y[2:]
        return Matrix(
            [
                a[0] * (b[1] - b[0]),
                a[1] * (b[2] - b[1]),
                2 * a[0] ** 2,
                2 * (a[1] ** 2 - a[0] ** 2),
                -2 * a[1] ** 2,
            ]
        )

    start = [Rational(1, 2), 0, Rational(1, 3), Rational(-1, 3), 0]
    found = reference(scene(field, start, (0, 1)))
    assert found.state[1] == 0
    assert abs(sum(found.state[2:])) < 1e-30


def test_a_step_that_differs_from_its_taylor_polynomial_is_the_stated_reason(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """No step agrees with its polynomial, so each attempt halves the step."""
    monkeypatch.setattr(piecewise_field, "VANISHING", 0.0)
    with pytest.raises(SceneError, match="the Taylor polynomial of the solution is not accurate"):
        reference(scene(lambda y: Matrix([1 + Abs(y[0])]), [1], (0, 1)))


@pytest.mark.parametrize("name", references.MODULES)
def test_a_change_of_a_module_of_the_reference_makes_stored_solutions_invalid(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = Path(str(sys.modules[name].__file__))
    changed = tmp_path / own.name
    changed.write_text(own.read_text() + "CONSTANT = 1\n")
    decay = scene(lambda y: Matrix([-y[0]]), [1], (0, 1))
    references._digest.cache_clear()
    before = references._key(decay)
    monkeypatch.setattr(sys.modules[name], "__file__", str(changed))
    references._digest.cache_clear()
    after = references._key(decay)
    references._digest.cache_clear()
    assert before != after


def test_the_modules_of_the_reference_are_all_modules_of_the_lab_that_it_imports() -> None:
    """The cache and the names of types do not change a solution."""
    others = {"codegen.lab.measurement_cache", "codegen.lab.number_types"}
    imported = {
        node.module
        for name in references.MODULES
        for node in ast.walk(ast.parse(Path(str(sys.modules[name].__file__)).read_text()))
        if isinstance(node, ast.ImportFrom) and node.module
    }
    assert {m for m in imported if m.startswith("codegen.lab.")} - others <= set(references.MODULES)
