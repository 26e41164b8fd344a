"""Runs to a given end time: output times, events, bounds on steps, resuming, and bad input."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import pytest
from sympy import Matrix, Symbol

from codegen.artifact import Artifact
from codegen.build import Compiler
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.event import Event
from codegen.groups import SO3, LeftMultiplication, Rn, Rotation
from codegen.integrator import Integrator, Status, StepFailed
from codegen.loader import load
from codegen.scene import FieldScene
from codegen.scene.problem import Problem
from orderconds.errors import InputError
from tests.promises import clean_c, clean_python

TARGETS = ["c", "python"]


@cache
def emitted(scene: str, method: str, target: str, **options: Any) -> Artifact:
    adaptive, precision = options.pop("adaptive", False), options.pop("precision", "double")
    own = {"rotation": rotation, "fall": fall}
    made = compile_method(
        own[scene]() if scene in own else scene,
        method,
        (),
        options.pop("inputs", ()),
        adaptive=adaptive,
        **options,
    )
    return emit_compiled(made, target, prefix="run_", precision=precision)


def loaded(scene: str, method: str, target: str = "c", **options: Any) -> Integrator:
    return load(emitted(scene, method, target, **options))


def reached(integrator: Integrator, *arguments: Any, **options: Any) -> tuple[Any, Status]:
    """Return the arrival of a run that may end early, and its status."""
    try:
        return integrator.integrate(*arguments, **options), Status.OK
    except StepFailed as failure:
        return failure.arrival, failure.status


@cache
def rotation() -> Problem:
    """Return the rotation about a fixed axis with angular velocity 1: all methods are exact."""
    m = SO3().dual("m")
    return FieldScene(
        name="rotation", group=SO3(), action=Rotation(), y=m, f=Matrix([0, 0, 1]), y0=[1, 0, 0], span=(0, 10)
    )


@cache
def fall() -> Problem:
    """Return a free fall from rest at the height 5 with the acceleration 10: it lasts one unit of time."""
    y = [Symbol("z", real=True), Symbol("v", real=True)]
    return FieldScene(
        name="fall",
        group=Rn(2),
        action=LeftMultiplication(),
        y=Matrix(y),
        f=Matrix([y[1], -10]),
        y0=[5, 0],
        span=(0, 3),
    )


CONSTANT = [("free_rigid_body", "cf:cf4"), ("dipole", "vcg:triple_jump"), ("heavy_top", "slgi:midpoint")]
CONTROLLED = [("free_rigid_body", "cf:cf43"), ("linear_oscillator", "rk:dormand_prince5")]


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(("scene", "method"), CONSTANT)
def test_a_state_at_an_output_time_is_one_shorter_step_from_the_grid(
    scene: str, method: str, target: str
) -> None:
    integrator = loaded(scene, method, target, integrate=True)
    start, h = integrator.initial, 1 / 64
    times = [0.0, h / 3, h, 2.4 * h, 2.7 * h, 4 * h]
    found = integrator.integrate(start, 0, 4 * h, h, t_eval=times)
    grid = integrator.trajectory(start, h, 4)
    assert found.states[0] == start
    for k, time in enumerate(times[1:], 1):
        before = min(int(time / h), 3) if time != h else 0
        expected = integrator.step(grid[before], time - before * h, before * h)
        assert found.states[k] == pytest.approx(expected, rel=1e-13, abs=1e-13)
    # Output does not change the steps.
    assert found.state == integrator.integrate(start, 0, 4 * h, h).state
    assert found.state == pytest.approx(grid[-1], rel=1e-13, abs=1e-13)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(("scene", "method"), CONTROLLED)
def test_without_outputs_a_controlled_run_makes_the_steps_of_run_adaptive(
    scene: str, method: str, target: str
) -> None:
    integrator = loaded(scene, method, target, integrate=True, adaptive=True)
    first, last = integrator.span
    options = {"rtol": 1e-7, "atol": 1e-7}
    known = integrator.adaptive(integrator.initial, first, last, **options)
    times = [first + (last - first) * x for x in (0.1, 0.23, 0.5, 1.0)]
    found = integrator.integrate(integrator.initial, first, last, t_eval=times, **options)
    assert (found.state, found.t, found.h) == (known.state, known.t, known.h)
    assert (found.accepted, found.rejected) == (known.accepted, known.rejected)
    assert found.states[-1] == found.state
    exact = [integrator.adaptive(integrator.initial, first, t, rtol=1e-11, atol=1e-11).state for t in times]
    for state, expected in zip(found.states, exact, strict=True):
        assert state == pytest.approx(expected, abs=2e-5)


def test_c_and_python_find_the_same_outputs_and_events() -> None:
    for scene, method, adaptive in [(*CONTROLLED[0], True), ("driven_spin", "rkmk:rk4", False)]:
        results = []
        for target in TARGETS:
            integrator = loaded(scene, method, target, adaptive=adaptive, events=2)
            first, last = integrator.span
            found = integrator.integrate(
                integrator.initial,
                first,
                last,
                0.0 if adaptive else (last - first) / 50,
                t_eval=[first + 0.3 * (last - first), last],
                events=[lambda t, y: y[0] - 0.4, lambda t, y: y[2] - 0.7],
            )
            results.append(found)
        c, python = results
        assert len(c.crossings) > 0
        assert [(x.event, x.direction) for x in c.crossings] == [
            (x.event, x.direction) for x in python.crossings
        ]
        assert [x.t for x in c.crossings] == pytest.approx([x.t for x in python.crossings], abs=1e-10)
        for a, b in zip(c.states, python.states, strict=True):
            assert a == pytest.approx(b, abs=1e-11)


@pytest.mark.parametrize("target", TARGETS)
def test_an_event_is_found_to_1e_13_of_its_time(target: str) -> None:
    integrator = loaded("rotation", "rkmk:rk4", target, events=1)
    found = integrator.integrate(integrator.initial, 0, 10, 0.7, events=[lambda t, y: y[1] - 0.5])
    exact = [math.pi / 6, 5 * math.pi / 6, 13 * math.pi / 6, 17 * math.pi / 6]
    assert [x.direction for x in found.crossings] == [1, -1, 1, -1]
    assert [x.t for x in found.crossings] == pytest.approx(exact, rel=1e-13, abs=0)
    for crossing in found.crossings:
        assert math.hypot(*crossing.state) == pytest.approx(1, abs=1e-13)
        assert crossing.state[1] == pytest.approx(0.5, abs=1e-14 * 10)
    assert found.t == 10


@pytest.mark.parametrize("target", TARGETS)
def test_a_terminal_event_of_a_controlled_run_is_found_to_1e_13(target: str) -> None:
    integrator = loaded("fall", "rk:dormand_prince5", target, events=1, adaptive=True)
    landing = Event(lambda t, y: y[0], terminal=True, direction=-1)
    found = integrator.integrate([5, 0], 0, 3, events=[landing], t_eval=[0.5, 1.0 - 1e-9, 2.0], rtol=1e-12)
    assert found.status == Status.EVENT
    assert found.t == pytest.approx(1, abs=1e-13)
    assert found.state == pytest.approx([0, -10], abs=2e-12)
    assert len(found.states) == 2  # the time 2 comes after the landing
    assert found.states[0] == pytest.approx([3.75, -5], abs=1e-12)


@pytest.mark.parametrize("target", TARGETS)
def test_a_run_continues_from_an_event_without_finding_it_again(target: str) -> None:
    """A ball that loses half of its speed at each bounce comes to bounces at known times."""
    integrator = loaded("fall", "rk:dormand_prince5", target, events=1, adaptive=True)
    landing = Event(lambda t, y: y[0], terminal=True, direction=-1)
    state, t, bounces = [5.0, 0.0], 0.0, []
    while len(bounces) < 5:
        found = integrator.integrate(state, t, 4, events=[landing], rtol=1e-12)
        bounces.append(found.t)
        t, state = found.t, [found.state[0], -found.state[1] / 2]
    expected = [1 + 2 * sum(0.5**k for k in range(1, n + 1)) for n in range(5)]
    assert bounces == pytest.approx(expected, abs=1e-11)


@pytest.mark.parametrize("target", TARGETS)
def test_two_events_in_one_step_are_found_in_order(target: str) -> None:
    integrator = loaded("rotation", "rkmk:rk4", target, events=2)
    functions = [lambda t, y: y[1] - 0.99, lambda t, y: y[0]]
    found = integrator.integrate(integrator.initial, 0, 2, 2.0, events=functions)
    assert found.accepted == 1
    first = math.asin(0.99)
    exact = [(0, first, 1), (1, math.pi / 2, -1), (0, math.pi - first, -1)]
    assert [(x.event, x.direction) for x in found.crossings] == [(k, d) for k, _, d in exact]
    assert [x.t for x in found.crossings] == pytest.approx([t for _, t, _ in exact], abs=1e-13)


def test_events_at_the_same_time_are_all_found() -> None:
    integrator = loaded("rotation", "rkmk:rk4", events=2)
    terminal = [Event(lambda t, y: y[0], True), Event(lambda t, y: 2 * y[0], True)]
    found = integrator.integrate(integrator.initial, 0, 10, 0.7, events=terminal)
    assert [x.event for x in found.crossings] == [0, 1]
    assert found.crossings[0].t == found.crossings[1].t == found.t


def test_a_zero_at_the_start_is_no_event_and_an_event_may_never_be_met() -> None:
    integrator = loaded("rotation", "rkmk:rk4", events=1)
    found = integrator.integrate(integrator.initial, 0, 3, 0.7, events=[lambda t, y: y[1]])
    assert found.crossings == ()
    found = integrator.integrate(integrator.initial, 0, 4, 0.7, events=[lambda t, y: y[1]])
    assert [x.t for x in found.crossings] == pytest.approx([math.pi], abs=1e-13)
    never = integrator.integrate(integrator.initial, 0, 10, 0.7, events=[lambda t, y: y[2] - 2])
    assert (never.crossings, never.t, never.status) == ((), 10.0, Status.OK)


def test_the_direction_selects_events() -> None:
    integrator = loaded("rotation", "rkmk:rk4", events=1)
    for direction, exact in ((1, [3 * math.pi / 2]), (-1, [math.pi / 2])):
        event = Event(lambda t, y: y[0], direction=direction)
        found = integrator.integrate(integrator.initial, 0, 5, 0.7, events=[event])
        assert [x.t for x in found.crossings] == pytest.approx(exact, abs=1e-13)
        ended = integrator.integrate(
            integrator.initial, 0, 5, 0.7, events=[Event(lambda t, y: y[0], True, direction)]
        )
        assert ended.t == pytest.approx(exact[0], abs=1e-13)


@pytest.mark.parametrize("target", TARGETS)
def test_events_and_outputs_work_backwards_in_time(target: str) -> None:
    integrator = loaded("rotation", "rkmk:rk4", target, events=1)
    found = integrator.integrate([1, 0, 0], 0, -3, 0.7, t_eval=[-1, -2], events=[lambda t, y: y[0]])
    assert [x.t for x in found.crossings] == pytest.approx([-math.pi / 2], abs=1e-13)
    expected = [[math.cos(t), math.sin(t), 0] for t in (-1, -2)]
    for state, exact in zip(found.states, expected, strict=True):
        assert state == pytest.approx(exact, abs=1e-13)


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize(("method", "adaptive"), [("rkmk:gauss2", False), ("cf:cf43", True)])
def test_any_number_of_events_leaves_the_steps_unchanged(method: str, adaptive: bool, target: str) -> None:
    integrator = loaded("free_rigid_body", method, target, events=64, adaptive=adaptive)
    start, end = integrator.initial, 20.0
    options: dict[str, Any] = {"rtol": 1e-5, "atol": 1e-5} if adaptive else {"h": 0.3}
    plain = integrator.integrate(start, 0.0, end, t_eval=[3.3], **options)
    zeros = [(k + 0.9) * math.pi / 3 for k in range(19)]
    waves = [lambda t, y: math.sin(3 * t + 0.1 * math.pi)] * 64
    found = integrator.integrate(start, 0.0, end, t_eval=[3.3], events=waves, **options)
    assert (found.state, found.states) == (plain.state, plain.states)
    assert (found.h, found.accepted, found.rejected) == (plain.h, plain.accepted, plain.rejected)
    # Each function has each zero once. An array with 1024 entries is too short for these 1216 events.
    assert [x.event for x in found.crossings] == [*range(64)] * 19
    assert [x.t for x in found.crossings[::64]] == pytest.approx(zeros, abs=1e-13)
    last = Event(lambda t, y: t - 19.0, terminal=True)
    ended = integrator.integrate(start, 0.0, end, events=[*waves[1:], last], **options)
    assert (ended.t, ended.status) == (pytest.approx(19.0, abs=1e-13), Status.EVENT)


@pytest.mark.parametrize("target", TARGETS)
def test_values_that_underflow_in_the_search_for_an_event_are_bisected(target: str) -> None:
    integrator = loaded("rotation", "rkmk:rk4", target, events=1)
    tiny = 5e-324
    for k in range(1, 60):
        time = k / 61
        for after in (0.0, -tiny):
            found = integrator.integrate(
                [1, 0, 0], 0.0, 1.0, 0.1, events=[lambda t, y, time=time, a=after: tiny if t < time else a]
            )
            assert [x.t for x in found.crossings] == pytest.approx([time], abs=1e-14)


def test_events_do_not_change_the_steps() -> None:
    for scene, method in CONSTANT:
        integrator = loaded(scene, method, events=1)
        options = {"t": 0.0, "end": 0.5, "h": 0.03}
        plain = integrator.integrate(integrator.initial, **options)
        found = integrator.integrate(integrator.initial, events=[lambda t, y: t - 0.2], **options)
        assert found.state == plain.state
        assert [x.t for x in found.crossings] == pytest.approx([0.2], abs=1e-15)


@pytest.mark.parametrize("target", TARGETS)
def test_step_sizes_are_between_their_bounds(target: str) -> None:
    integrator = loaded(*CONTROLLED[0], target, integrate=True, adaptive=True)
    free = integrator.integrate(integrator.initial, 0, 2, rtol=1e-4, atol=1e-4)
    many = integrator.integrate(integrator.initial, 0, 2, rtol=1e-4, atol=1e-4, greatest=1 / 64)
    assert free.accepted < 60
    assert many.accepted == 128
    short = integrator.integrate(integrator.initial, 0, 2, 1e-5, rtol=1e-4, atol=1e-4, least=0.01)
    assert short.accepted <= 200
    with pytest.raises(StepFailed, match="a step of the least size was rejected") as failure:
        integrator.integrate(integrator.initial, 0, 2, rtol=1e-12, atol=1e-12, least=0.05)
    assert failure.value.status == Status.LEAST_STEP
    assert failure.value.state == integrator.initial


@pytest.mark.parametrize("target", TARGETS)
def test_a_run_that_reaches_its_limit_can_be_continued(target: str) -> None:
    integrator = loaded(*CONTROLLED[0], target, integrate=True, adaptive=True)
    options = {"rtol": 1e-8, "atol": 1e-8, "limit": 20}
    whole = integrator.integrate(integrator.initial, 0, 2, rtol=1e-8, atol=1e-8)
    state, t, h, parts = integrator.initial, 0.0, 0.0, 0
    while t < 2:
        parts += 1
        arrival, status = reached(integrator, state, t, 2, h, **options)
        assert status in (Status.OK, Status.LIMIT)
        state, t, h = arrival.state, arrival.t, arrival.h
    assert parts > 2
    assert state == pytest.approx(whole.state, abs=1e-7)
    constant = loaded("free_rigid_body", "cf:cf4", target, integrate=True)
    with pytest.raises(StepFailed) as failed:
        constant.integrate(constant.initial, 0, 2, 0.1, limit=5)
    ended = failed.value.arrival
    assert (ended.t, ended.accepted) == (0.5, 5)
    assert (ended.status, failed.value.status) == (Status.LIMIT, Status.LIMIT)
    rest = constant.integrate(ended.state, ended.t, 2, 0.1)
    assert rest.state == pytest.approx(constant.run(constant.initial, 0.1, 20), abs=1e-14)


@pytest.mark.parametrize("target", TARGETS)
def test_the_last_step_is_shorter_if_h_does_not_divide_the_span(target: str) -> None:
    integrator = loaded("free_rigid_body", "cf:cf4", target, integrate=True)
    start = integrator.initial
    found = integrator.integrate(start, 0, 1, 0.3)
    expected = integrator.step(integrator.run(start, 0.3, 3), 1 - 3 * 0.3)
    assert (found.t, found.accepted) == (1.0, 4)
    assert found.state == pytest.approx(expected, abs=1e-14)
    # The quotients are integers except for rounding; there is no additional, tiny step.
    for n in range(2, 40):
        assert integrator.integrate(start, 0, n / 10, 0.1).accepted == n
    assert integrator.integrate(start, 0, 0, 0.1).accepted == 0


@pytest.mark.parametrize("target", TARGETS)
def test_bad_arguments_have_a_status_and_keep_the_state(target: str) -> None:
    integrator = loaded(*CONTROLLED[0], target, integrate=True, adaptive=True)
    start, nan = integrator.initial, math.nan
    good = {"t": 0.0, "end": 1.0}
    bad: list[dict[str, Any]] = [
        *({"rtol": x, "atol": x} for x in (0.0, -1.0, nan)),
        *({"rtol": -1e-6}, {"atol": -1e-6}, {"rtol": nan}, {"atol": nan}),
        *({"rtol": math.inf}, {"atol": math.inf}, {"least": math.inf}),
        *({"least": -1.0}, {"least": nan}, {"greatest": nan}, {"greatest": 0.0}),
        {"least": 0.2, "greatest": 0.1},
        *({"h": nan}, {"h": math.inf}, {"t": nan}, {"end": math.inf}),
    ]
    for arguments in bad:
        with pytest.raises(StepFailed, match="rtol >= 0, atol >= 0") as failure:
            integrator.integrate(start, **{**good, **arguments})
        assert failure.value.status == Status.BAD_STEP
        assert failure.value.state == start
        assert failure.value.arrival.accepted == 0
    for times in ([0.5, 0.2], [0.5, 1.5], [-0.5, 0.5], [nan], [0.5, math.inf]):
        with pytest.raises(ValueError, match=r"t_eval|the last time"):
            integrator.integrate(start, t_eval=times, **good)
    constant = loaded("free_rigid_body", "cf:cf4", target, integrate=True)
    for h in (0.0, nan, math.inf):
        with pytest.raises(StepFailed, match="expected finite numbers") as failure:
            constant.integrate(start, 0, 1, h)
        assert (failure.value.status, failure.value.state) == (Status.BAD_STEP, start)


def test_emitted_code_refuses_bad_output_times_itself() -> None:
    emission = emitted(*CONTROLLED[0], "python", integrate=True, adaptive=True)
    namespace: dict[str, Any] = {}
    exec(emission.files["run.py"], namespace)
    for times in ([0.5, 0.2], [0.5, 1.5], [-0.5, 0.5], [math.nan]):
        with pytest.raises(namespace["StepFailed"], match="output times") as failure:
            namespace["integrate"](emission.manifest["initial"], 0, 1, times=times)
        assert failure.value.status == Status.BAD_TIMES
        assert list(failure.value.state) == emission.manifest["initial"]


@pytest.mark.parametrize("target", TARGETS)
def test_an_event_function_that_fails_ends_the_run_at_the_last_good_state(target: str) -> None:
    integrator = loaded("rotation", "rkmk:rk4", target, events=1)
    with pytest.raises(StepFailed, match="event function is not finite") as failure:
        integrator.integrate([1, 0, 0], 0, 2, 0.5, events=[lambda t, y: math.nan if t > 1.1 else 1.0])
    assert failure.value.status == Status.BAD_EVENT
    assert failure.value.arrival.t == 1.0
    with pytest.raises(ZeroDivisionError):
        integrator.integrate([1, 0, 0], 0, 2, 0.5, events=[lambda t, y: 1 / 0])
    with pytest.raises(ValueError, match="emit the module with events=2"):
        integrator.integrate([1, 0, 0], 0, 2, 0.5, events=[len, len])
    with pytest.raises(TypeError, match="expected a function of time and state"):
        integrator.integrate([1, 0, 0], 0, 2, 0.5, events=[3])


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("sign", [1, -1])
def test_the_events_of_a_failed_step_are_found_when_the_run_continues(target: str, sign: int) -> None:
    integrator = loaded("rotation", "rkmk:rk4", target, events=1)

    def fails(t: float, y: list[float]) -> float:
        return math.nan if sign * t > 1.4 else (sign * t - 0.3) * (sign * t - 1.1)

    with pytest.raises(StepFailed) as failure:
        integrator.integrate([1, 0, 0], 0, sign * 2, sign * 0.5, events=[fails])
    done = failure.value.arrival
    assert failure.value.status == Status.BAD_EVENT
    assert done.t == sign
    assert [x.t for x in done.crossings] == pytest.approx([sign * 0.3])
    rest = integrator.integrate(done.state, done.t, sign * 2, done.h, events=[lambda t, y: sign * t - 1.1])
    assert [x.t for x in rest.crossings] == pytest.approx([sign * 1.1])


@pytest.mark.parametrize("steps", [10**17, 2**62])
def test_a_trajectory_that_does_not_fit_in_memory_is_refused(steps: int) -> None:
    with pytest.raises(InputError, match=f"not enough memory for {steps + 1} states"):
        loaded("rotation", "rkmk:rk4", "c").trajectory([1, 0, 0], 0.5, steps)


def test_inputs_and_single_precision_are_supported() -> None:
    driven = loaded("actuated_rigid_body", "rkmk:rk4", inputs=("u0", "u1", "u2"), events=1)
    found = driven.integrate(
        driven.initial,
        0,
        1,
        0.05,
        t_eval=[0.33],
        inputs=lambda t: [t, 0.1, 0.2],
        events=[lambda t, y: t - 0.5],
    )
    assert [x.t for x in found.crossings] == pytest.approx([0.5], abs=1e-13)
    for target in TARGETS:
        single = loaded("rotation", "rkmk:rk4", target, events=1, precision="single")
        found = single.integrate([1, 0, 0], 0, 2, 0.5, events=[lambda t, y: y[0]])
        assert [x.t for x in found.crossings] == pytest.approx([math.pi / 2], abs=2e-6)


@pytest.mark.slow
@pytest.mark.parametrize("precision", ["double", "single"])
@pytest.mark.parametrize(
    ("scene", "method", "adaptive"),
    [
        ("driven_spin", "cg:cg3", True),
        ("linear_oscillator", "rk:kvaerno3", True),
        ("dipole", "vcg:triple_jump", False),
        ("heavy_top", "slgi:midpoint", False),
        ("fast_heavy_top", "splitting:blanes_moan_rkn4", False),
        ("free_rigid_body", "taylor(12)", False),
    ],
)
def test_modules_with_a_run_to_an_end_time_are_clean(
    scene: str, method: str, adaptive: bool, precision: str, compiler: Compiler, tmp_path: Any
) -> None:
    for events in (0, 2):
        options = {"adaptive": adaptive, "integrate": True, "events": events}
        emission = emitted(scene, method, "c", precision=precision, **options)
        (tmp_path / f"c{events}").mkdir()
        clean_c(emission, compiler, tmp_path / f"c{events}")
        if compiler.command[0] == "gcc" and precision == "double":
            clean_python(emitted(scene, method, "python", **options), tmp_path)


def test_what_is_not_requested_is_not_emitted() -> None:
    for target in TARGETS:
        plain = emitted("free_rigid_body", "cf:cf4", target)
        assert not any("integrate(" in text or "EVENT" in text for text in plain.files.values())
        assert "integrated" not in plain.manifest["interface"]
        assert "--integrate" not in plain.manifest["command"]
        without = emitted("free_rigid_body", "cf:cf4", target, integrate=True)
        assert not any("EVENT" in text or "event(" in text for text in without.files.values())
        assert "--integrate" in without.manifest["command"]
        assert "--events 2" in emitted("free_rigid_body", "cf:cf4", target, events=2).manifest["command"]
    with pytest.raises(TypeError, match="emit it with integrate=True"):
        loaded("free_rigid_body", "cf:cf4").integrate([1, 0, 0], 0, 1, 0.1)
    with pytest.raises(InputError, match="at most 64"):
        compile_method("free_rigid_body", "cf:cf4", events=65)
    with pytest.raises(MethodError, match="constant step size"):
        compile_method("free_rigid_body", "taylor(12)", adaptive=True, integrate=True)
