"""What a run puts off: n steps in two parts are n steps, and each part holds no more than it needs."""

from __future__ import annotations

import math

import pytest
from sympy import diag

from codegen import scenes
from codegen.emitter import compile_method, emit_compiled
from codegen.integrator import StepFailed
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.kernel import ELAPSED, LEAD, LONGEST
from codegen.ir.scene_operations import FLOWS, FlowFor
from codegen.kernel.deferred_flows import part
from codegen.loader import load
from tests.strategies import top_scene

TURNS = ["T.mean", "T.turn"]
CASES = {
    "gravity does not see the spin": ("fast_heavy_top", "splitting:blanes_moan_rkn4", ["V"], ["T.turn"]),
    "turns at the ends": ("fast_heavy_top", "splitting:position_verlet", ["T.mean"], ["T.turn"]),
    "turns that the potential sees": ("symmetric", "splitting:position_verlet", TURNS, []),
    "kicks at times": ("linear_oscillator", "splitting:strang", ["V"], []),
    "drifts that carry the time": ("linear_oscillator", "splitting:position_verlet", ["T"], []),
    "a step that ends otherwise": ("fast_heavy_top", "splitting:lie_trotter", [], ["T.turn"]),
    "many turns": ("dipole", "composition:triple_jump", ["V"], []),
}


def compiled(scene, method):
    return compile_method(top_scene(diag(2, 3, 2)) if scene == "symmetric" else scenes.load(scene), method)


@pytest.mark.parametrize("name", sorted(CASES))
def test_steps_in_parts_are_the_steps_themselves(name):
    """With forty digits, over three steps; what is joined and what is put off is as the table says."""
    scene, method, joined, late = CASES[name]
    made = compiled(scene, method)
    view, parted = made.problem, part(made.program, made.problem)
    assert [a.operation.part for a in parted.core.assigns() if isinstance(a.operation, FlowFor)] == joined
    for program, parts in ((parted.begin, joined), (parted.finish, late)):
        found = (
            []
            if program is None
            else [a.operation.part for a in program.assigns() if isinstance(a.operation, FLOWS)]
        )
        assert found == parts
    d = PreciseDomain("0.03125", 40)
    n, start = view.group.size, view.initial(d)
    times = [d.rational(*view.span[0].as_integer_ratio()) + k * d.h for k in range(3)]

    def run(program, state, t, **more):
        values = {"q": state[:n], "mu": state[n:], "t": t, **more}
        found = interpret(program, view, d, {v.name: values[v.name] for v in program.inputs})
        return (*found["q"], *found["mu"])

    whole = parts = start
    for k, t in enumerate(times):
        whole = run(made.program, whole, t)
        if parted.begin is not None and k == 0:
            parts = run(parted.begin, parts, t)
        lead = parted.last if k == 2 else parted.later
        parts = run(parted.core, parts, t, **{LEAD: d.number(lead) * d.h})
    if parted.finish is not None:
        assert max(abs(a - b) for a, b in zip(whole, parts, strict=True)) > 1e-6
        parts = run(parted.finish, parts, times[-1], **{ELAPSED: 3 * d.h})
    assert max(abs(a - b) for a, b in zip(whole, parts, strict=True)) < 1e-35


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("name", sorted(CASES))
def test_runs_are_steps_one_after_the_other(name, target):
    scene, method, *_ = CASES[name]
    made = compiled(scene, method)
    integrator = load(emit_compiled(made, target))
    state = first = [float(x) for x in made.scene.initial(PreciseDomain(0, 20))]
    rows = [state]
    for k in range(6):
        state = integrator.step(state, 0.015625, 0.5 + k * 0.015625)
        rows.append(state)
    size = max(map(abs, state))

    def close(x, y):
        return max(abs(a - b) for a, b in zip(x, y, strict=True)) < 1e-14 * size

    assert close(integrator.run(first, 0.015625, 6, 0.5), state)
    for found, expected in zip(integrator.trajectory(first, 0.015625, 6, 2, 0.5), rows[::2], strict=True):
        assert close(found, expected)
    assert integrator.run(first, 0.015625, 0, 0.5) == first


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("name", ["gravity does not see the spin", "a step that ends otherwise"])
def test_what_commutes_is_made_from_time_to_time(name, target):
    """More steps than an end is put off for, with rows before, at and after it."""
    scene, method, *_ = CASES[name]
    made = compiled(scene, method)
    integrator = load(emit_compiled(made, target))
    state = first = [float(x) for x in made.scene.initial(PreciseDomain(0, 20))]
    rows, n = [state], 3 * LONGEST // 2
    for _ in range(n):
        state = integrator.step(state, 1 / 1024)
        rows.append(state)
    for stride in (n // 3, LONGEST, n):
        found = integrator.trajectory(first, 1 / 1024, n, stride)
        for a, b in zip(found, rows[::stride], strict=True):
            assert max(abs(x - y) for x, y in zip(a, b, strict=True)) < 1e-11
    assert integrator.run(first, 1 / 1024, n) == pytest.approx(state, abs=1e-11)
    assert integrator.run(first, 1 / 1024, LONGEST) == pytest.approx(rows[LONGEST], abs=1e-11)


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_run_that_fails_leaves_the_last_good_state_with_its_end_made(target):
    """R^1 with H = p^2/2 - q^4: the solution runs away to infinity."""
    from codegen.groups import Rn
    from codegen.scene import HamiltonianScene

    group = Rn(1)
    q, p = group.point("q"), group.dual("p")
    T, V = p[0] ** 2 / 2, -(q[0] ** 4)
    scene = HamiltonianScene(
        group=group, q=q, mu=p, H=T + V, parts={"T": T, "V": V}, q0=[1], mu0=[2], span=(0, 1), name="away"
    )
    integrator = load(emit_compiled(compile_method(scene, "splitting:strang"), target))
    good, made = [1.0, 2.0], 0
    while True:
        try:
            good = integrator.step(good, 0.25)
        except StepFailed:
            break
        made += 1
    with pytest.raises(StepFailed) as failure:
        integrator.run([1.0, 2.0], 0.25, 100)
    assert 2 < made == failure.value.step
    assert list(failure.value.state) == pytest.approx(good, rel=1e-12)
    for h in (math.nan, math.inf):
        with pytest.raises(StepFailed) as failure:
            integrator.run([1.0, 2.0], h, 3)
        assert list(failure.value.state) == [1.0, 2.0]


def test_a_step_makes_one_kick_less_and_no_spin():
    made = compiled("fast_heavy_top", "splitting:blanes_moan_rkn4")
    parted = part(made.program, made.problem)
    assert made.lowered.counts() == {"flow": 19}
    assert made.program.counts() == {"flow": 14}
    assert parted.core.counts() == {"flow": 11, "flow_for": 1}


def test_methods_that_solve_or_exponentiate_put_nothing_off():
    for method in ("vcg:midpoint", "cg:cg3"):
        made = compiled("dipole", method)
        assert part(made.program, made.problem) is None
        assert made.kernel.deferred is None
