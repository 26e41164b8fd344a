"""Long runs tell bounded errors from drifts, symplectic maps from others, and who finds the way back."""

from __future__ import annotations

import json
import random

import pytest
from click.testing import CliRunner

from codegen.commands.longrun import command
from codegen.emitter import compile_method
from codegen.lab.drift import fit
from codegen.lab.longrun import LongRun, longrun
from codegen.lab.symplecticity import symplectic_defect
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
    run = longrun(compile_method("dipole", method), 0.01, 100_000, back=False)
    energy = kept(run, "energy")
    assert printed / 2 < energy.drift.largest * 0.046239253715917 < 2 * printed
    assert energy.drift.law == "bounded"
    assert kept(run, "manifold").drift.largest < 1e-12


def test_a_method_that_is_not_symplectic_drifts():
    energy = kept(longrun(compile_method("dipole", "cf:cf4"), 0.01, 40_000, back=False), "energy")
    assert energy.drift.is_drift
    assert energy.drift.law == "drift"


def test_symmetric_methods_find_the_way_back():
    there = longrun(compile_method("free_rigid_body", "cf:gauss1"), 0.05, 2000)
    assert [n for n, _ in there.reversals] == [20, 2000]
    assert all(distance < 1e-11 for _, distance in there.reversals)
    lost = longrun(compile_method("free_rigid_body", "cf:cf4"), 0.2, 2000)
    assert lost.reversals[-1][1] > 1e-6


def test_a_run_that_stops_says_where_and_keeps_what_was_run():
    run = longrun(compile_method("heavy_top", "vcg:kutta3"), 5.0, 1000)
    assert run.failure.startswith("step ")
    assert "did not converge" in run.failure or "not finite" in run.failure


def test_the_command_prints_every_kept_quantity():
    done = CliRunner().invoke(
        command, ["fast_heavy_top", "-m", "splitting:strang", "--steps", "1000"], standalone_mode=False
    )
    assert done.exception is None
    assert done.return_value == 0
    for word in ("energy", "momentum_about_vertical", "manifold", "there and back", "symplectic defect"):
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
