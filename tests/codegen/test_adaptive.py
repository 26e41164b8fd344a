"""Runs that choose their steps: embedded estimates, the controller, and what stops it."""

from __future__ import annotations

import math
from functools import cache

import pytest

from codegen.build import Compiler
from codegen.certify import certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.errors import MethodError
from codegen.integrator import Statistics, Status, StepFailed
from codegen.ir.domain import SeriesDomain
from codegen.ir.interpret import interpret
from codegen.lab.distance import distance
from codegen.lab.orders.local_error import exact_flow, valuation
from codegen.lab.reference import cached_reference
from codegen.loader import load
from codegen.lower import lower, problem_for
from codegen.method import Method, with_estimate
from codegen.passes import optimise
from codegen.scenes import load as load_scene
from tests.promises import COMPILERS, clean_c, clean_python
from tests.strategies import field_scene, shipped

METHODS = {
    "rk": ("linear_oscillator", "rk:dormand_prince5"),
    "rkmk": ("free_rigid_body", "rkmk(3):dormand_prince5"),
    "cg": ("driven_spin", "cg:cg3"),
    "cf": ("free_rigid_body", "cf:cf43"),
    "ambient": ("dipole", "ambient:bogacki_shampine3"),
}
CASES = list(METHODS.values())


@cache
def emitted(scene, method, target, **options):
    inputs = options.pop("inputs", ())
    made = compile_method(scene, method, (), inputs, adaptive=options.pop("adaptive", True))
    return emit_compiled(made, target, prefix="chosen_", **options)


def run(scene, method, target, tolerance, **options):
    emission = emitted(scene, method, target)
    first, last = emission.manifest["span"]
    return load(emission).adaptive(
        emission.manifest["initial"], first, last, rtol=tolerance, atol=tolerance, **options
    )


@cache
def reference(scene, method):
    emission = emitted(scene, method, "c")
    first, last = emission.manifest["span"]
    return load(emission).run(emission.manifest["initial"], (last - first) / 40_000, 40_000, first)


def test_every_family_with_an_estimate_is_tried():
    assert sorted(METHODS) == sorted(with_estimate())


@pytest.mark.parametrize(("scene", "method"), CASES)
def test_errors_follow_the_tolerance(scene, method):
    exact, errors = reference(scene, method), []
    for tolerance in (1e-4, 1e-6, 1e-8):
        found = run(scene, method, "c", tolerance)
        errors.append(max(abs(x - y) for x, y in zip(found.state, exact, strict=True)))
        assert errors[-1] < 200 * tolerance
        assert found.accepted > 3 * found.rejected
    assert errors[0] > 5 * errors[1] > 25 * errors[2]


@pytest.mark.parametrize(("scene", "method"), CASES)
def test_c_and_python_choose_the_same_steps(scene, method):
    c, python = (run(scene, method, target, 1e-6) for target in ("c", "python"))
    assert (c.accepted, c.rejected, c.t) == (python.accepted, python.rejected, python.t)
    assert c.h == pytest.approx(python.h, rel=1e-6)
    assert c.state == pytest.approx(python.state, abs=1e-11)


PAIRS = [
    (Method("rk", shipped("bogacki_shampine3"), None, True), "R^3"),
    (Method("rkmk", shipped("bogacki_shampine3"), 1, True), "S^2"),
    (Method("cg", shipped("cg3"), None, True), "SO(3)"),
    (Method("cf", shipped("cf43"), None, True), "S^2"),
]


@pytest.mark.parametrize(("method", "place"), PAIRS, ids=[m.label for m, _ in PAIRS])
def test_both_states_of_a_pair_have_their_stated_orders_exactly(method, place):
    scene, embedded = field_scene(place), method.embedded()
    program, _ = optimise(lower(scene, method), problem_for(scene, method))
    order, low = (certified_order(m, scene).order for m in (method, embedded))
    assert low < order
    domain = SeriesDomain(method.ring, order + 1)
    inputs = {"y": scene.initial(domain), "t": domain.rational(0)}
    found = interpret(program, scene, domain, inputs)
    exact = exact_flow(scene, method.ring, order + 1)
    for name, stated in (("y", order), ("embedded", low)):
        error = tuple(x - y for x, y in zip(found[name], exact, strict=True))
        assert valuation(error) == stated + 1
    made = compile_method(scene, method)
    assert made.kernel.estimate.order == low + 1


def test_an_accepted_step_has_an_estimate_within_the_tolerance():
    """With one step allowed, the size it is given is taken or refused as the estimate says."""
    emission = emitted("free_rigid_body", "cf:cf43", "c")
    start, integrator = emission.manifest["initial"], load(emission)
    made = compile_method("free_rigid_body", "cf:cf43", adaptive=True)
    lower_made = compile_method("free_rigid_body", Method("cf", made.method.embedded().tableau))
    other = load(emit_compiled(lower_made, "c", prefix="lower_"))
    taken = []
    for h in (0.05, 0.2, 0.8, 1.6):
        pair = integrator.step(start, h), other.step(start, h)
        scales = [1e-3 * (1 + max(abs(a), abs(b))) for a, b in zip(start, pair[0], strict=True)]
        ratios = [(a - b) / s for a, b, s in zip(*pair, scales, strict=True)]
        norm = math.sqrt(sum(r * r for r in ratios) / len(ratios))
        if norm <= 1:
            found = integrator.adaptive(start, 0, h, h, rtol=1e-3, atol=1e-3, limit=1)
            assert (found.accepted, found.rejected) == (1, 0)
        else:
            with pytest.raises(StepFailed, match="step 1: the end"):
                integrator.adaptive(start, 0, h, h, rtol=1e-3, atol=1e-3, limit=1)
        taken.append(norm <= 1)
    assert taken == [True, True, False, False]


def test_a_run_without_a_given_size_needs_no_more_than_a_few_trials_of_a_smooth_motion():
    """Two steps for a loose tolerance: a sixteenth of the interval, and the rest."""
    assert run("free_rigid_body", "cf:cf43", "c", 1e2).accepted == 2
    first, last = emitted("free_rigid_body", "cf:cf43", "c").manifest["span"]
    given = run("free_rigid_body", "cf:cf43", "c", 1e2, h=(last - first) / 16)
    assert given.accepted == 3  # the size that a caller gives grows by a factor of at most 5


def test_step_sizes_follow_the_solution():
    """On the heavy top, chosen steps are more accurate than the same number of equal steps."""
    scene, method = "heavy_top", "ambient:dop853"
    problem = load_scene(scene)
    exact, found = cached_reference(problem).state, run(scene, method, "c", 1e-9)
    emission = emitted(scene, method, "c")
    (first, last), start = emission.manifest["span"], emission.manifest["initial"]
    equal = load(emission).run(start, (last - first) / found.accepted, found.accepted, first)
    assert distance(problem, found.state, exact) < 0.6 * distance(problem, equal, exact)


@pytest.mark.parametrize("target", ["c", "python"])
def test_runs_go_back_and_on(target):
    emission = emitted("driven_spin", "cg:cg3", target)
    start, integrator = emission.manifest["initial"], load(emission)
    there = integrator.adaptive(start, 0, 1, rtol=1e-8, atol=1e-8)
    back = integrator.adaptive(there.state, there.t, 0, there.h, rtol=1e-8, atol=1e-8)
    assert (there.t, back.t) == (1.0, 0.0)
    assert back.state == pytest.approx(start, abs=1e-6)
    half = integrator.adaptive(start, 0, 0.5, rtol=1e-8, atol=1e-8)
    on = integrator.adaptive(half.state, half.t, 1, half.h, rtol=1e-8, atol=1e-8)
    assert on.state == pytest.approx(there.state, abs=1e-6)
    nothing = integrator.adaptive(start, 2, 2)
    assert (nothing.state, nothing.accepted, nothing.rejected) == (start, 0, 0)


@pytest.mark.parametrize("target", ["c", "python"])
def test_the_limit_counts_the_rejected_steps_before_each_output_time(target):
    emission = emitted("free_rigid_body", "cf:cf43", target)
    start, integrator = emission.manifest["initial"], load(emission)
    options = {"h": 2.0, "rtol": 1e-6, "atol": 1e-6, "t_eval": [0.5, 1.0, 1.5]}
    whole = integrator.adaptive(start, 0, 2, **options)
    steps = whole.accepted + whole.rejected
    assert whole.rejected
    assert integrator.adaptive(start, 0, 2, **options, limit=steps) == whole
    with pytest.raises(StepFailed) as failure:
        integrator.adaptive(start, 0, 2, **options, limit=steps - 1)
    assert failure.value.status == Status.LIMIT
    ended = failure.value.arrival
    assert (ended.accepted, ended.rejected) == (whole.accepted - 1, whole.rejected)
    assert (failure.value.step, ended.states) == (whole.accepted - 1, whole.states)


@pytest.mark.parametrize("target", ["c", "python"])
def test_what_the_tolerance_forbids_ends_at_the_last_good_state(target):
    emission = emitted("free_rigid_body", "cf:cf43", target)
    start, integrator = emission.manifest["initial"], load(emission)
    with pytest.raises(StepFailed, match="the end time is not reached") as failure:
        integrator.adaptive(start, 0, 2, 0.02, rtol=1e-6, atol=1e-6, limit=3)
    assert (failure.value.status, failure.value.step) == (Status.LIMIT, 3)
    assert list(failure.value.state) != start
    with pytest.raises(StepFailed) as failure:
        integrator.adaptive(start, 1e17, 1e17 + 64)
    assert failure.value.status == Status.TOO_SHORT
    assert list(failure.value.state) == start
    known, inf = {"t": 0, "end": 1}, math.inf
    tolerances = ({"rtol": -1}, {"atol": math.nan}, {"rtol": 0, "atol": 0}, {"rtol": inf}, {"atol": inf})
    for bad in ({"t": math.nan}, {"end": inf}, {"h": math.nan}, *tolerances):
        with pytest.raises(StepFailed, match=r"found t=.*, end=.*, h=.*, rtol=.*, atol=") as failure:
            integrator.adaptive(start, **{**known, **bad})
        assert failure.value.status == Status.BAD_STEP
        assert (failure.value.step, list(failure.value.state)) == (0, start)
    with pytest.raises(StepFailed) as failure:
        integrator.adaptive([math.nan, 0, 1], 0, 2)
    assert failure.value.status == Status.NOT_FINITE


@pytest.mark.parametrize("target", ["c", "python"])
@pytest.mark.parametrize("method", ["cf:cf43", "taylor(12)"])
def test_a_zero_that_remains_zero_needs_no_absolute_tolerance(method, target):
    integrator = load(emitted("free_rigid_body", method, target))
    for rest in ([0.0, 0.0, 2.0], [0.0, 0.0, 0.0]):
        arrival = integrator.adaptive(rest, 0, 1, rtol=1e-6, atol=0)
        assert (arrival.state, arrival.t, arrival.rejected) == (rest, 1.0, 0)


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_time_interval_of_one_rounding_error_is_one_step(target):
    emission = emitted("free_rigid_body", "cf:cf43", target)
    start, integrator = emission.manifest["initial"], load(emission)
    for t, end in ((1.0, math.nextafter(1.0, 2)), (1.0, math.nextafter(1.0, 0)), (0.0, 5e-324)):
        arrival = integrator.adaptive(start, t, end)
        assert (arrival.t, arrival.accepted, arrival.rejected) == (end, 1, 0)
        assert arrival.state == pytest.approx(integrator.run(start, end - t, 1), abs=1e-16)


def test_a_failed_run_states_the_number_of_rejected_steps_in_both_targets():
    counts = []
    for target in ("c", "python"):
        emission = emitted("free_rigid_body", "cf:cf43", target)
        start, integrator = emission.manifest["initial"], load(emission)
        with pytest.raises(StepFailed) as failure:
            integrator.adaptive(start, 0, 2, 1.0, rtol=1e-10, atol=1e-10, limit=20)
        arrival = failure.value.arrival
        assert arrival.accepted + arrival.rejected == 20
        assert (arrival.accepted, arrival.status) == (failure.value.step, Status.LIMIT)
        counts.append(arrival.rejected)
    assert counts[0] == counts[1] > 0


@pytest.mark.parametrize("target", ["c", "python"])
def test_a_taylor_run_refuses_tolerances_that_no_step_can_use(target):
    emission = emitted("free_rigid_body", "taylor(12)", target)
    start, integrator = emission.manifest["initial"], load(emission)
    for bad in ({"rtol": 0, "atol": 0}, {"rtol": math.inf}, {"atol": math.inf}):
        with pytest.raises(StepFailed) as failure:
            integrator.adaptive(start, 0, 1, **bad)
        assert (failure.value.status, list(failure.value.state)) == (Status.BAD_STEP, start)


@pytest.mark.parametrize("target", ["c", "python"])
def test_run_time_inputs_and_implicit_stages_are_taken_along(target):
    driven = emitted("actuated_rigid_body", "rkmk(3):dormand_prince5", target, inputs=("u0", "u1", "u2"))
    folded = emitted("actuated_rigid_body", "rkmk(3):dormand_prince5", target)
    start = driven.manifest["initial"]
    one = load(folded).adaptive(start, 0, 2, rtol=1e-7, atol=1e-7)
    two = load(driven).adaptive(
        start, 0, 2, rtol=1e-7, atol=1e-7, inputs=lambda t: [math.sin(t) / 2, 0.1, math.cos(2 * t) / 5]
    )
    assert (one.accepted, one.rejected) == (two.accepted, two.rejected)
    assert one.state == pytest.approx(two.state, abs=1e-12)
    implicit, counts = emitted("linear_oscillator", "rk:kvaerno3", target), Statistics()
    start = implicit.manifest["initial"]
    found = load(implicit).adaptive(start, 0, 3, rtol=1e-6, atol=1e-6, statistics=counts)
    assert found.state == pytest.approx(reference("linear_oscillator", "rk:dormand_prince5"), abs=1e-4)
    assert min(counts.sweeps) >= found.accepted


@pytest.mark.parametrize(
    ("compiler", "scene", "method", "precision"),
    [
        # Every run compiles doubles with gcc and floats with clang.
        pytest.param(c, *case, p, marks=() if (c == "gcc") == (p == "double") else pytest.mark.slow)
        for c in COMPILERS
        for case in (CASES[2], CASES[3], ("linear_oscillator", "rk:kvaerno3"))
        for p in ("double", "single")
    ],
    indirect=["compiler"],
)
def test_modules_that_choose_their_steps_are_clean(scene, method, precision, compiler: Compiler, tmp_path):
    (tmp_path / "c").mkdir()
    emission = emitted(scene, method, "c", precision=precision)
    assert "chosen_run_adaptive" in emission.files["chosen.h"]
    clean_c(emission, compiler, tmp_path / "c")
    if compiler.command[0] == "gcc" and precision == "double":
        clean_python(emitted(scene, method, "python"), tmp_path)


@pytest.mark.parametrize("target", ["c", "python"])
def test_floats_choose_their_steps_too(target):
    emission = emitted("free_rigid_body", "cf:cf43", target, precision="single")
    found = load(emission).adaptive(emission.manifest["initial"], 0, 2, rtol=1e-4, atol=1e-4)
    assert found.state == pytest.approx(reference("free_rigid_body", "cf:cf43"), abs=1e-3)


def test_without_a_request_there_is_no_estimate():
    for target in ("c", "python"):
        text = "".join(emitted("free_rigid_body", "cf:cf43", target, adaptive=False).files.values())
        for word in ("adaptive", "rtol", "LIMIT", "error != NULL"):
            assert word not in text
    with pytest.raises(TypeError, match="emit it with adaptive=True"):
        load(emitted("free_rigid_body", "cf:cf43", "c", adaptive=False)).adaptive([1, 0, 0], 0, 1)
    assert "--adaptive" in emitted("free_rigid_body", "cf:cf43", "c").manifest["command"]


@pytest.mark.parametrize(
    ("scene", "method", "message"),
    [
        ("free_rigid_body", "cf:cf4", "expected a tableau with an embedded method"),
        ("free_rigid_body", "rkmk:dormand_prince5", r"write rkmk\(3\):dormand_prince5"),
        ("dipole", "vcg:heun_euler", "expected a method of rk, ambient, cf, cg, rkmk"),
    ],
)
def test_methods_without_an_estimate_are_refused(scene, method, message):
    with pytest.raises(MethodError, match=message):
        compile_method(scene, method, adaptive=True)
