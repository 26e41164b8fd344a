"""Long runs distinguish bounded errors from drifts, symplectic maps from others, reversible methods."""

from __future__ import annotations

import json
import math
import random

import pytest
from click.testing import CliRunner

from codegen import emitter
from codegen.commands.longrun import command
from codegen.emitter import compile_method
from codegen.errors import MethodError
from codegen.lab.invariants import functions
from codegen.lab.long_runs.drift import fit
from codegen.lab.long_runs.long_run import LongRun, long_run
from codegen.lab.long_runs.symplecticity import symplectic_defect
from codegen.lab.runner import Emitted
from orderconds.errors import InputError


def kept(run: LongRun, name: str):
    return next(k for k in run.kept if k.name == name)


def test_a_line_is_a_drift_and_noise_is_none():
    draw = random.Random(1)
    times = [0.1 * k for k in range(1, 2001)]
    line = fit(times, [3e-8 * t + draw.gauss(0, 1e-7) for t in times])
    noise = fit(times, [draw.gauss(0, 1e-7) for t in times])
    assert line.is_drift
    assert abs(line.slope - 3e-8) < line.half_width < 3e-9
    assert not noise.is_drift
    assert noise.law == "bounded"


def test_the_interval_holds_the_slope_nineteen_times_in_twenty():
    """Of correlated noise: a least-squares interval over the samples would miss most of the time."""
    held = 0
    for seed in range(200):
        draw, value, series = random.Random(seed), 0.0, []
        for _ in range(1000):
            value = 0.9 * value + draw.gauss(0, 1)
            series.append(value)
        found = fit([float(k) for k in range(1, 1001)], series)
        held += abs(found.slope) <= found.half_width
    assert 180 <= held <= 198


def test_a_random_walk_grows_like_the_square_root():
    exponents = []
    for seed in range(40):
        draw, value, series = random.Random(seed), 0.0, []
        for _ in range(2000):
            value += draw.gauss(0, 1)
            series.append(value)
        exponents.append(fit([float(k) for k in range(1, 2001)], series).exponent)
    assert 0.35 < sum(exponents) / len(exponents) < 0.65


def law_of(deviations, **options):
    return fit([float(k) for k in range(1, len(deviations) + 1)], deviations, **options).law


def test_a_quantity_whose_deviation_reaches_its_size_is_lost():
    assert law_of([0.99 * (-1) ** k for k in range(400)]) == "bounded"
    assert law_of([1.01 * (-1) ** k for k in range(400)]) == "lost"
    assert law_of([1e-3 * (k + 1) for k in range(400)]) == "drift"
    assert law_of([1e-2 * (k + 1) for k in range(400)]) == "lost"


def test_growth_whose_interval_contains_zero_is_too_short_to_tell():
    """A deviation that grows while it changes sign has no slope."""
    found = [1e-9 * (k + 1) * (-1) ** k for k in range(400)]
    assert fit([float(k) for k in range(1, 401)], found).exponent > 0.75
    assert law_of(found) == "too short to tell"


def test_a_deviation_within_rounding_is_no_drift():
    line = [1e-16 * k for k in range(400)]
    assert law_of(line) == "drift"
    assert law_of(line, rounding=1e-13) == "rounding"
    assert law_of([x + 1e-12 for x in line], rounding=1e-13) != "rounding"
    assert law_of([0.0] * 400, rounding=1e-13) == "exact"


def test_the_largest_deviation_is_that_of_the_peaks():
    found = fit([float(k) for k in range(1, 401)], [1e-9] * 400, [1e-9] * 399 + [2e-9])
    assert found.largest == 2e-9


@pytest.mark.parametrize("last", [math.inf, -math.inf, math.nan])
def test_values_that_are_not_finite_are_lost_and_have_no_slope_beyond(last):
    found = fit([float(k) for k in range(1, 401)], [1e-3 * k for k in range(300)] + [last] * 100)
    assert found.law == "lost"
    assert found.largest == math.inf
    assert found.slope == pytest.approx(1e-3)
    assert found.as_json()["largest"] is None
    early = fit([float(k) for k in range(1, 401)], [last] * 400)
    assert (early.law, early.as_json()["slope"]) == ("lost", None)


@pytest.mark.parametrize("unit", [-1.0, 1e-200, -1e200])
def test_the_way_back_and_other_units_of_time_give_the_same_law(unit):
    deviations = [1e-9 * k + 1e-10 * (-1) ** k for k in range(1, 401)]
    usual = fit([float(k) for k in range(1, 401)], deviations)
    other = fit([k * unit for k in range(1, 401)], deviations)
    assert other.slope * unit == pytest.approx(usual.slope, rel=1e-12)
    assert other.half_width * abs(unit) == pytest.approx(usual.half_width, rel=1e-9)
    assert (other.largest, other.exponent) == pytest.approx((usual.largest, usual.exponent), rel=1e-12)


def test_too_few_samples_are_refused():
    with pytest.raises(ValueError, match="at least 40 samples"):
        fit([1.0, 2.0], [0.0, 0.0])


@pytest.mark.parametrize("method", ["vcg:midpoint", "vrkmk(2):gauss2", "splitting:strang"])
def test_symplectic_steps_have_no_defect(method):
    made = compile_method("dipole", method)
    state = [1.0, 0.0, 0.0, 0.0, 0.6, -0.8, 0.0, 0.8, 0.6, 0.3, 0.01, 0.002]
    assert symplectic_defect(made, state, 0.05) < 1e-13


def test_a_step_that_is_not_symplectic_has_one():
    made = compile_method("dipole", "rkmk(2):rk4")
    state = [1.0, 0.0, 0.0, 0.0, 0.6, -0.8, 0.0, 0.8, 0.6, 0.3, 0.01, 0.002]
    assert 1e-9 < symplectic_defect(made, state, 0.05) < 1e-3


@pytest.mark.parametrize(
    ("method", "printed"),
    [
        ("vcg:midpoint", 1e-3),
        pytest.param("vcg:triple_jump", 1e-5, marks=pytest.mark.slow),
        pytest.param("vrkmk(2):gauss2", 1e-7, marks=pytest.mark.slow),
    ],
)
def test_the_energy_of_the_dipole_stays_as_printed(method, printed):
    """Thesis section 3.6: over (0, 1000) with h = 0.01; chaotic, so within a factor of two."""
    run = long_run(compile_method("dipole", method), 0.01, 100_000, back=False)
    energy = kept(run, "energy")
    assert printed / 2 < energy.drift.largest * 0.046239253715917 < 2 * printed
    assert energy.drift.law == "bounded"
    assert kept(run, "manifold").drift.largest < 1e-12


def test_a_method_that_is_not_symplectic_drifts():
    energy = kept(long_run(compile_method("dipole", "cf:cf4"), 0.01, 40_000, back=False), "energy")
    assert energy.drift.is_drift
    assert energy.drift.law == "drift"


def test_symmetric_methods_find_the_way_back():
    there = long_run(compile_method("free_rigid_body", "cf:gauss1"), 0.05, 2000)
    assert [n for n, _ in there.reversals] == [20, 2000]
    assert all(distance < 1e-11 for _, distance in there.reversals)
    lost = long_run(compile_method("free_rigid_body", "cf:cf4"), 0.2, 2000)
    assert lost.reversals[-1][1] > 1e-6


def test_a_run_that_stops_says_where_and_keeps_what_was_run():
    run = long_run(compile_method("heavy_top", "vcg:kutta3"), 5.0, 1000)
    assert run.failure.startswith("step ")
    assert "did not converge" in run.failure or "not finite" in run.failure


def test_the_command_prints_every_kept_quantity():
    done = CliRunner().invoke(
        command, ["fast_heavy_top", "-m", "splitting:strang", "--steps", "1000"], standalone_mode=False
    )
    assert done.exception is None
    assert done.return_value == 0
    for word in ("energy", "momentum_about_vertical", "manifold", "forward and back", "symplectic defect"):
        assert word in done.output


def test_a_run_backwards_is_measured():
    words = ["free_rigid_body", "-m", "cf:cf4", "--steps", "200", "--h", "-0.1", "--json"]
    done = CliRunner().invoke(command, words, standalone_mode=False)
    assert done.exception is None
    (record,) = json.loads(done.output)
    assert (record["h"], record["failure"]) == (-0.1, "")
    assert {kept["name"] for kept in record["kept"]} >= {"radius", "energy"}


@pytest.mark.parametrize("size", ["0", "nan", "inf", "1e-320", "-1e305"])
def test_a_step_that_is_none_is_refused(size):
    done = CliRunner().invoke(command, ["dipole", "-m", "vcg:midpoint", "--h", size], standalone_mode=False)
    assert isinstance(done.exception, InputError)


def test_an_energy_that_overflows_is_lost():
    """Lie-Euler on the Duffing equation gains energy until x^4 is no double."""
    run = long_run(compile_method("duffing", "rkmk(0):euler"), 0.02, 10_000, back=False)
    energy = kept(run, "energy")
    assert energy.drift.law == "lost"
    json.dumps(run.as_json(), allow_nan=False)


@pytest.mark.parametrize("steps", [2333, 1999, 200])
def test_every_step_that_was_asked_for_is_made(steps):
    run = long_run(compile_method("free_rigid_body", "cf:cf4"), 0.05, steps)
    assert run.steps == steps
    assert run.reversals[-1][0] == steps
    assert kept(run, "energy").times[-1] == pytest.approx(0.05 * steps)


def test_the_largest_deviation_is_over_all_steps():
    """Sampling every tenth step misses the largest energy error of a fast oscillation."""
    made, h, steps = compile_method("dipole", "vcg:midpoint"), 0.03, 10_000
    run = long_run(made, h, steps, back=False)
    rows = Emitted(made, "c")
    energy = functions(made.scene)["energy"]
    states = rows.integrator.trajectory(rows.initial, h, steps, 1, 0.0)
    values = [energy(state, 0.0)[0] for state in states]
    largest = max(abs(x - values[0]) for x in values) / abs(values[0])
    found = kept(run, "energy")
    assert found.drift.largest == pytest.approx(largest, rel=1e-12)
    assert max(map(abs, found.deviations)) < largest


def test_chunks_of_a_trajectory_join(monkeypatch):
    made = compile_method("free_rigid_body", "cf:cf4")
    whole = long_run(made, 0.05, 2345, back=False)
    monkeypatch.setattr("codegen.lab.long_runs.trajectory.CHUNK", 100)
    assert long_run(made, 0.05, 2345, back=False) == whole


def test_a_lost_energy_is_not_bounded():
    run = long_run(compile_method("heavy_top", "rkmk(0):euler"), 0.05, 10_000, back=False)
    energy = kept(run, "energy")
    assert energy.drift.largest > 1
    assert energy.drift.law == "lost"


def test_the_deviation_of_an_exactly_conserved_quantity_is_rounding():
    run = long_run(compile_method("free_rigid_body_s3", "discrete_gradient:midpoint"), 0.02, 5000, back=False)
    energy = kept(run, "energy")
    assert 0 < energy.drift.largest < 1e-11
    assert energy.drift.law == "rounding"


def test_a_method_that_fails_is_reported_and_the_others_run(monkeypatch):
    compile_method = emitter.compile_method

    def refuse(scene, method):
        if method.label == "cf:cf4":
            raise MethodError("no lowering")
        return compile_method(scene, method)

    monkeypatch.setattr(emitter, "compile_method", refuse)
    words = ["free_rigid_body", "-m", "cf:cf4", "-m", "cg:cg3", "--steps", "200", "--json"]
    done = CliRunner().invoke(command, words, standalone_mode=False)
    assert done.exception is None
    assert done.return_value == 1
    failed, made = json.loads(done.output)
    assert (failed["method"], failed["failure"], failed["steps"]) == ("cf:cf4", "no lowering", 0)
    assert (made["method"], made["failure"], made["steps"]) == ("cg:cg3", "", 200)


def test_rounding_that_grows_beyond_its_usual_bound_is_still_rounding():
    """The splitting conserves the manifold exactly; rounding grows faster than one epsilon a step."""
    steps = 20_000
    run = long_run(compile_method("fast_heavy_top", "splitting:blanes_moan4"), 0.02, steps, back=False)
    manifold = kept(run, "manifold")
    assert manifold.drift.largest > steps * 2.0**-52
    assert manifold.drift.law == "rounding"
    assert kept(run, "energy").drift.law != "rounding"
