"""C, Python and the executor carry out the same statements: they count the same sweeps and matrices."""

from __future__ import annotations

import mpmath
import pytest

from codegen import scenes
from codegen.emitter import emit_compiled
from codegen.integrator import Statistics
from codegen.ir.angle_depth import chain
from codegen.ir.domain import PreciseDomain
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON
from codegen.ir.precision import DOUBLE, Precision
from codegen.loader import load
from codegen.run import stopping
from codegen.run.execute import Machine
from codegen.run.floats import EmittedFloats
from codegen.run.plan import Plan
from codegen.run.solver_choice import amount
from codegen.run.terms import OK, STATUSES
from codegen.run.unit import unit_of
from codegen.scene.momentum_frame import start_of
from tests.compilations import compiled
from tests.promises import ulps

STEPS = 20

SOLVED = {
    "residuals": ("dipole", "vcg:midpoint", "auto", "space"),
    "residuals of two stages": ("dipole", "vcg:gauss2", "auto", "space"),
    "body frame": ("dipole", "vcg:midpoint", "auto", "body"),
    "substeps": ("dipole", "vcg:triple_jump", "auto", "space"),
    "substeps by fixed points": ("dipole", "vcg:triple_jump", FIXED_POINT, "space"),
    "substeps by simplified Newton": ("dipole", "vcg:triple_jump", SIMPLIFIED_NEWTON, "space"),
    "several blocks": ("heavy_top", "vcg:alexander2", NEWTON, "space"),
    "several blocks by simplified Newton": ("heavy_top", "vcg:alexander2", SIMPLIFIED_NEWTON, "space"),
    "fixed point": ("heavy_top", "vcg:midpoint", FIXED_POINT, "space"),
    "exact matrix": ("heavy_top", "vcg:midpoint", NEWTON, "space"),
    "simplified Newton": ("heavy_top", "vcg:midpoint", SIMPLIFIED_NEWTON, "space"),
    "matrix in arrays": ("linear_oscillator", "rk:gauss2", NEWTON, "space"),
    "simplified Newton in arrays": ("linear_oscillator", "rk:gauss2", SIMPLIFIED_NEWTON, "space"),
    "unknowns in arrays": ("linear_oscillator", "rk:gauss3", FIXED_POINT, "space"),
    "continuation": ("stiff_driven_spin", "ambient:gauss3", NEWTON, "space"),
}
"""One case for each way in which equations are solved: scene, method, solver, frame of the momentum."""

LONG = ("residuals of two stages", "several blocks by simplified Newton", "substeps by fixed points")
"""Cases that combine two others; the slow run tries them."""

ALIKE = (
    "free_rigid_body_attitude",
    "free_rigid_body_quaternion",
    "free_rigid_body_product",
    "coupled_rigid_bodies",
    "satellite",
    "independent_components",
    "wilson_flow",
    "lyapunov_exponents",
    "allen_cahn",
    "toda_lattice",
    "body_in_fluid",
    "torus_gradient_flow",
)
"""Scenes whose equations are solved as those of another scene, or have long formulas; for the slow run."""

FRACTIONS = (1, 1 / 32, 1 / 1024)
"""Sizes of steps, in hundredths of the span. The first size at which the method converges is used."""


def implicit(scene):
    """An implicit method that a scene of the gallery takes."""
    return "vcg:midpoint" if scenes.load(scene).is_hamiltonian else "rkmk(0):gauss1"


def length(made):
    first, last = made.scene.span
    return float(last - first) / 100


def outcome(made, steps=STEPS, longer=1, machine=None):
    """The status of steps of the executor, the state and the statistics after them."""
    plan = Plan(made.kernel, DOUBLE)
    machine = machine or Machine(unit_of(plan), EmittedFloats(chain=chain(made.kernel)))
    state, counts = list(start_of(made.scene)), machine.record("statistics")
    time = [float(made.scene.span[0])] if plan.time else []
    values = [float(made.scene.parameters[p.text]) for p in plan.parameters]
    given = [state, *time, longer * length(made), steps, *values, None, 0, counts, None]
    status = machine.call("run", *given)
    return (
        status,
        state,
        Statistics(counts.sweeps, counts.most, counts.failed, getattr(counts, "matrices", 0)),
    )


def executed(made, steps=STEPS, longer=1, machine=None):
    """The state and the statistics after steps of the executor."""
    status, state, counts = outcome(made, steps, longer, machine)
    assert status == STATUSES.index(OK)
    return state, counts


def emitted(made, target, steps=STEPS, longer=1):
    """The state and the statistics after the same steps of emitted code."""
    statistics = Statistics()
    start = float(made.scene.span[0])
    state = load(emit_compiled(made, target)).run(
        list(start_of(made.scene)), longer * length(made), steps, start, statistics
    )
    return state, statistics


def agree(made, longer=1):
    state, counts = executed(made, longer=longer)
    assert min(counts.sweeps) >= STEPS
    for target in ("c", "python"):
        found, counted = emitted(made, target, longer=longer)
        assert counted == counts
        assert ulps(found, state) <= 4


@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=pytest.mark.slow if case in LONG else ()) for case in SOLVED]
)
def test_every_way_to_solve_takes_the_same_sweeps_everywhere(case):
    agree(compiled(*SOLVED[case]), longer=0.5 if case == "continuation" else 1)


@pytest.mark.parametrize(
    "scene",
    [
        pytest.param(name, marks=pytest.mark.slow if name in ALIKE else ())
        for name in sorted(scenes.names())
        if scenes.load(name).matrices is None  # whole matrices have no implicit methods
    ],
)
def test_every_scene_takes_the_same_sweeps_everywhere(scene):
    made = compiled(scene, implicit(scene))
    fitting = (size for size in FRACTIONS if outcome(made, longer=size)[0] == STATUSES.index(OK))
    agree(made, longer=next(fitting))


@pytest.mark.parametrize("case", ["residuals", "exact matrix", "fixed point", "substeps"])
def test_the_header_states_the_sweeps_of_emitted_code(case):
    """The choice of a solver counts the sweeps and matrices that C makes in the example's first steps."""
    scene, method, _, frame = SOLVED[case]
    made = compiled(scene, method, "auto", frame)
    _, counts = emitted(made, "c")
    for choice, sweeps in zip(made.solvers, counts.sweeps, strict=True):
        stated = amount(sweeps / STEPS, "sweep", "sweeps")
        if choice.solver == NEWTON:
            stated += f" and {amount(counts.matrices / STEPS / len(made.solvers), 'matrix', 'matrices')}"
        assert choice.reason.startswith(
            f"{stated} a step, measured over the first {STEPS} steps of size h = "
        )


def test_fifty_digits_are_solved_to_fifty_digits():
    """The stopping rule scales with the format: steps in 50 digits agree with doubles, far sharper."""
    made = compiled("heavy_top", "vcg:midpoint", NEWTON)
    domain = PreciseDomain(0, 50)
    digits = Precision("digits", 166, "mpf", "", 1e300)
    machine = Machine(unit_of(Plan(made.kernel, digits)), domain)
    state = [domain.rational(*float(x).as_integer_ratio()) for x in start_of(made.scene)]
    h = domain.rational(*length(made).as_integer_ratio())
    assert machine.call("run", state, h, 3, None, 0, machine.record("statistics"), None) == STATUSES.index(OK)
    q = [state[3 * i : 3 * i + 3] for i in range(3)]
    for i in range(3):
        for j in range(3):
            product = sum(q[i][k] * q[j][k] for k in range(3))
            assert abs(product - (i == j)) < mpmath.mpf(10) ** -45
    floats, _ = executed(made, 3)
    scale = max(map(abs, floats))
    differences = [abs(a - b) for a, b in zip(state, floats, strict=True)]
    assert 0 < max(differences) < 1e-13 * scale


def test_a_stopping_rule_that_is_broken_in_its_one_place_is_broken_everywhere(monkeypatch):
    made = compiled("heavy_top", "vcg:midpoint", NEWTON)
    before = executed(made)[1]

    def at_once(self):
        small = stopping.CHANGE <= 1.0 * stopping.SCALE
        return [stopping.Assign(stopping.flag(name), small) for name in ("still", "converged")]

    monkeypatch.setattr(stopping.Stopping, "converged", at_once)
    after = [executed(made)[1], *(emitted(made, target)[1] for target in ("c", "python"))]
    assert before.sweeps[0] > STEPS
    assert [counts.sweeps for counts in after] == [[STEPS]] * 3
