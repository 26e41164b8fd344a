"""The status of a failed step names its cause, in every target."""

from __future__ import annotations

import math

import pytest
from sympy import Matrix, sqrt, symbols

from codegen.emitter import compile_method, emit_compiled
from codegen.groups.actions.left_multiplication import LeftMultiplication
from codegen.groups.rn import Rn
from codegen.integrator import Status, StepFailed
from codegen.ir.kernel import NEWTON, SIMPLIFIED_NEWTON
from codegen.loader import load
from codegen.printers import names as target_names
from codegen.run.terms import STATUSES
from codegen.scene.field_scene import FieldScene
from tests.codegen.test_taylor import plane
from tests.compilations import compiled, emitted

TARGETS = sorted(target_names())

KINDS = {
    "the kernel inlined in a run": ("free_rigid_body", "cf:cf4", 1e13),
    "a function for each step": ("heavy_top", "rkmk(2):rk4", 1e13),
    "deferred flows": ("fast_heavy_top", "splitting:blanes_moan_rkn4", 1e13),
    "continuation": ("dipole", "vcf:cf4", 1.0),
}


def test_the_loader_knows_the_status_codes_of_emitted_code():
    assert tuple(status.name for status in Status) == STATUSES


def failure(integrator, state, h, steps=1):
    """Return the error of a run."""
    with pytest.raises(StepFailed) as caught:
        integrator.run(state, h, steps)
    assert list(caught.value.state) == list(state) or all(map(math.isnan, caught.value.state[:1]))
    return caught.value


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_step_that_turns_too_far_is_told_from_a_state_that_is_not_finite(kind, target):
    scene, method, h = KINDS[kind]
    emission = emitted(scene, method, target)
    integrator, state = load(emission), emission.manifest["initial"]
    far = failure(integrator, state, h)
    assert far.status is Status.TOO_FAR
    assert "the step is too long" in far.reason
    assert failure(integrator, [math.nan, *state[1:]], 0.01).status is Status.NOT_FINITE
    assert failure(integrator, state, math.inf).status is Status.BAD_STEP


@pytest.mark.parametrize("target", TARGETS)
def test_a_field_that_is_not_finite_at_the_state_is_not_blamed_on_the_step(target):
    x, y = symbols("x y")
    integrator = load(emit_compiled(compile_method(plane(1 / x, x * y), "rk:rk4"), target))
    assert failure(integrator, [0.0, 1.0], 0.1).status is Status.NOT_FINITE
    assert failure(integrator, [1.0, 1e300], 1e30).status is Status.TOO_FAR


@pytest.mark.parametrize("target", TARGETS)
def test_a_run_that_fails_late_reports_the_steps_before(target):
    x, y = symbols("x y")
    integrator = load(emit_compiled(compile_method(plane(x**3, y), "rk:rk4"), target))
    with pytest.raises(StepFailed) as caught:
        integrator.run([1.0, 1.0], 4.0, 50)
    assert caught.value.status is Status.TOO_FAR
    assert 0 < caught.value.step < 50
    assert all(map(math.isfinite, caught.value.state))


def chain(n):
    """A field on R^n whose derivative minus 1 has no inverse, at any point."""
    x = symbols(f"x:{n}")
    return FieldScene(
        title="A coupled field",
        group=Rn(n),
        action=LeftMultiplication(),
        y=Matrix(x),
        f=Matrix([x[k] + (1 + sum(a - x[0] for a in x)) ** 2 for k in range(n)]),
        y0=[0] * n,
        span=(0, 1),
    )


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(("solver", "n"), [(NEWTON, 4), (SIMPLIFIED_NEWTON, 4)])
def test_a_singular_matrix_has_its_own_status(solver, n, target, monkeypatch):
    monkeypatch.setattr("codegen.run.continuation.Start.TRIES", 1)
    # The midpoint rule solves k = f(y + h k/2). At h = 2 its matrix is 1 - f'.
    made = compile_method(chain(n), "rk:gauss1", solver=solver)
    integrator = load(emit_compiled(made, target))
    assert failure(integrator, [0.0] * n, 2.0).status is Status.SINGULAR


def rooted(n, shift):
    """A field on R^n whose derivative is infinite where the first coordinate is -shift."""
    x = symbols(f"x:{n}")
    return FieldScene(
        title="A field with a root",
        group=Rn(n),
        action=LeftMultiplication(),
        y=Matrix(x),
        f=Matrix([1 - shift / 2 + sqrt(x[0] + shift), *(x[0] + a for a in x[1:])]),
        y0=[0.5] * n,
        span=(0, 1),
    )


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(
    ("solver", "shift", "start", "h"), [(NEWTON, 2, -1.0, -2.0), (SIMPLIFIED_NEWTON, 0, 0.0, 0.1)]
)
@pytest.mark.parametrize("n", [1, 2, 4])
def test_an_infinite_matrix_is_no_solution(n, solver, shift, start, h, target, monkeypatch):
    """The reciprocal of an infinite pivot is 0. The changes would be 0, as if the solver had converged."""
    monkeypatch.setattr("codegen.run.continuation.Start.TRIES", 1)
    integrator = load(emit_compiled(compile_method(rooted(n, shift), "rk:gauss1", solver=solver), target))
    assert failure(integrator, [start, *[0.0] * (n - 1)], h).status is Status.NOT_FINITE


@pytest.mark.parametrize("target", TARGETS)
def test_a_header_lists_the_codes_that_the_module_can_return_and_no_others(target):
    explicit = emit_compiled(compiled("free_rigid_body", "cf:cf4"), target)
    text = "".join(explicit.files.values())
    assert "TOO_FAR" in text
    for absent in ("SINGULAR", "NOT_CONVERGED", "LIMIT", "TOO_SHORT"):
        assert absent not in text
