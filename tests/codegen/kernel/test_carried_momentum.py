"""Runs that carry the momentum of the body: the steps they are made of, exactly and to rounding."""

from __future__ import annotations

from functools import cache

import pytest
from sympy import diag

from codegen.emitter import emit_compiled
from codegen.integrator import Status, StepFailed
from codegen.ir.domain import SeriesDomain
from codegen.ir.expr import evaluate
from codegen.ir.interpret import interpret
from codegen.ir.program import BODY, SPACE
from codegen.kernel.translate import to_kernel
from codegen.loader import load
from codegen.passes import optimise
from codegen.printers import names as target_names
from codegen.printers import target as known_target
from orderconds.ring import QQ
from tests.codegen.kernel.test_translate import carried_out
from tests.compilations import compiled
from tests.promises import ulps
from tests.strategies import full, full_exponentials, hamiltonian_scene, lowered, starting, top_scene

METHODS = [("vcg", full(2), None), ("vcg", "kutta3", None), ("vrkmk", full(2), 2)]
METHODS += [("vcf", full_exponentials(2), None), ("vrkmk_pade", full(1), 2)]
SCENES = {"top": top_scene(diag(1, 2, 3)), "time": hamiltonian_scene("SO(3)", time=True)}
STEPS = 3


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize(("family", "tableau", "cutoff"), METHODS, ids=lambda x: str(getattr(x, "name", x)))
def test_a_run_is_the_steps_it_is_made_of_exactly(family, tableau, cutoff, scene):
    """Inward, the kernel as often as there are steps, outward: as many steps of the program as lowered."""
    view, before = lowered(family, tableau, SCENES[scene], cutoff)
    program, _ = optimise(before, view, framed=True)
    kernel, domain = to_kernel(program, view), SeriesDomain(QQ, 3)
    assert program.frame == BODY

    def turned(which, state):
        return evaluate(
            which.outputs, domain, dict(zip(view.symbols, (*state["q"], *state["mu"]), strict=True))
        )

    start = starting(view, domain)
    steps, moving = start, start | {"mu": turned(kernel.carried.inward, start)}
    first = turned(kernel.carried.outward, moving)
    for _ in range(STEPS):
        steps = start | interpret(before, view, domain, steps)
        new = carried_out(kernel, view, domain, moving)
        moving = start | {"q": tuple(new[:9]), "mu": tuple(new[9:])}
    last = turned(kernel.carried.outward, moving)
    mu = [m + (b - a) for m, a, b in zip(start["mu"], first, last, strict=True)]
    pairs = zip((*moving["q"], *mu), (*steps["q"], *steps["mu"]), strict=True)
    assert all(domain.ring.is_zero(a - b) is True for a, b in pairs)


@pytest.mark.parametrize("whole", [False, True])
def test_a_whole_kernel_is_the_step_of_the_program_exactly(whole):
    view, before = lowered("vcg", "midpoint", SCENES["top"])
    program, _ = optimise(before, view, framed=True)
    kernel, domain = to_kernel(program, view, whole=whole), SeriesDomain(QQ, 3)
    assert (kernel.carried is None) == whole
    inputs = starting(view, domain)
    state = interpret(before, view, domain, inputs)
    pairs = list(zip(carried_out(kernel, view, domain, inputs), (*state["q"], *state["mu"]), strict=True))
    assert all(domain.ring.is_zero(a - b) is True for a, b in pairs) == whole


@cache
def module(scene, method, target, precision="double", **options):
    emission = emit_compiled(compiled(scene, method, **options), target, precision=precision)
    return load(emission), list(emission.manifest["initial"])


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize("method", ["vcg:midpoint", "vcg:triple_jump", "vcg:kutta3", "vrkmk(2):gauss2"])
def test_a_run_ends_where_its_steps_do_and_its_rows_are_their_states(method, target):
    integrator, state = module("dipole", method, target)
    rows, current = integrator.trajectory(state, 0.01, 6, stride=2), state
    for k in range(1, 7):
        current = integrator.step(current, 0.01)
        if k % 2 == 0:
            assert ulps(rows[k // 2], current) <= 32
    assert list(rows[3]) == list(integrator.run(state, 0.01, 6))
    assert list(integrator.run(state, 0.01, 1)) == list(integrator.step(state, 0.01))


@pytest.mark.parametrize("target", sorted(target_names()))
def test_a_step_of_no_length_and_a_run_of_no_steps_leave_the_state_bit_by_bit(target):
    integrator, state = module("dipole", "vcg:midpoint", target)
    state = [*state[:9], 1e-17, 0.3, -0.1]
    assert list(integrator.step(state, 0.0)) == list(integrator.run(state, 0.1, 0)) == state


@pytest.mark.parametrize("target", sorted(target_names()))
def test_a_momentum_that_stands_still_does_so_where_q_is_not_quite_orthogonal(target):
    """Turned back as a whole, it would grow by twice the error of q in each step."""
    integrator, state = module("free_rigid_body_attitude", "vcg:midpoint", target)
    current = [*(x * (1 + 1e-7) for x in state[:9]), *state[9:]]
    for _ in range(200):
        current = integrator.step(current, 0.05)
    assert current[9:] == pytest.approx(state[9:], abs=1e-13)


@pytest.mark.parametrize("target", sorted(target_names()))
def test_a_run_that_fails_holds_the_state_before_the_step_that_failed(target):
    integrator, state = module("dipole", "vcg:midpoint", target)
    with pytest.raises(StepFailed) as failure:
        integrator.run([*state[:9], 1e200, 1e200, 0.0], 0.01, 5)
    assert failure.value.status == Status.NOT_FINITE
    assert (failure.value.step, list(failure.value.state)[9:]) == (0, [1e200, 1e200, 0.0])


def test_targets_agree_in_single_precision_too():
    ends = []
    for target in sorted(target_names()):
        integrator, state = module("dipole", "vcg:midpoint", target, precision="single")
        ends.append(integrator.run(state, 0.02, 20))
    assert ends[0] == pytest.approx(ends[1], abs=2.0**-21)


@pytest.mark.parametrize("target", sorted(target_names()))
def test_a_jacobian_is_that_of_the_step_in_space(target):
    """Of a composition it goes through the states between; q is varied by xi.q."""
    method = "vcg:triple_jump"
    integrator, state = module("dipole", method, target, jacobian=True)
    J, eps = integrator.jacobian(state, 0.05), 1e-6
    for j in range(9, 12):
        moved = ([x + s * (i == j) for i, x in enumerate(state)] for s in (eps, -eps))
        ends = [integrator.step(x, 0.05) for x in moved]
        slopes = [(a - b) / (2 * eps) for a, b in zip(*ends, strict=True)]
        assert [row[j - 6] for row in J[3:]] == pytest.approx(slopes[9:], abs=1e-7)


@pytest.mark.parametrize("target", sorted(target_names()))
def test_momenta_of_the_body_need_no_turning(target):
    frames = ({"frame": "body"}, {})
    body, space = (emit_compiled(compiled("dipole", "vcg:midpoint", **frame), target) for frame in frames)
    text = body.files[known_target(target).step_file(body.manifest["module"])]
    assert "inward" not in text
    assert "turned" not in text
    counts = body.manifest["operations"]["step"]
    assert counts == space.manifest["operations"]["step"]


def test_what_a_run_does_once_is_not_done_in_its_steps():
    emission = emit_compiled(compiled("dipole", "vcg:midpoint"), "c")
    counts = emission.manifest["operations"]["step"]
    assert counts["add"] + counts["mul"] < 100  # turned in each step: 148
    text = emission.files["dipole_vcg_midpoint.c"]
    assert "12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run" in text


def test_explicit_methods_and_fields_stay_in_space():
    for method in ("rkmk:rk4", "splitting:strang"):
        made = compiled("fast_heavy_top", method)
        assert (made.program.frame, made.kernel.carried) == (SPACE, None)
