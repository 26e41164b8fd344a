"""Extreme input: each answer is accurate or a status, and an answer that is neither is found out."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from sympy import Rational, cos

from codegen.emitter import compile_method
from codegen.groups import Rn
from codegen.integrator import Integrator
from codegen.lab.runner import Emitted
from codegen.lab.stability.extreme_steps import ACCURATE, SILENT, WRONG, Case, answer, cases
from codegen.scene import HamiltonianScene


class Spoilt:
    """An integrator with one fault."""

    def __init__(self, sound: Integrator, fault) -> None:
        self.sound, self.fault = sound, fault

    def run(self, state, h, steps, t=0.0, statistics=None):
        return self.fault(self.sound, state, h, steps, t)


@pytest.mark.parametrize(
    ("scene", "method"),
    [
        ("free_rigid_body", "rkmk:rk4"),
        ("free_rigid_body", "ambient:rk4"),
        ("dipole", "cf:cf4"),
        ("dipole", "vcg:midpoint"),
        ("heavy_top", "vcg:midpoint"),
        ("driven_spin", "cf:cf4"),
        ("linear_oscillator", "rk:rk4"),
        ("linear_oscillator", "splitting:strang"),
        pytest.param("fast_heavy_top", "splitting:strang", marks=pytest.mark.slow),
    ],
)
def test_each_answer_is_accurate_or_a_status(scene, method):
    made = compile_method(scene, method)
    runner = Emitted(made, "c")
    found = [answer(made, runner, case) for case in cases(made)]
    assert [a for a in found if a.verdict != ACCURATE and not a.verdict.startswith("status: ")] == []
    names = [a.case.name for a in found]
    for wanted in ("usual step", "h = 0", "h = 1e-12", "angle pi", "angle 1e+08", "h = nan"):
        assert wanted in names
    assert found[names.index("h = 0")].verdict == ACCURATE
    usual = found[0]
    assert usual.determined is not None
    assert usual.determined > 14
    assert usual.error is not None
    assert usual.error < 1e-14


@pytest.mark.parametrize(
    "name", ["usual step", *(pytest.param(n, marks=pytest.mark.slow) for n in ("backward", "angle pi"))]
)
def test_an_iteration_that_contracts_slowly_is_continued_to_the_solution(name):
    """Each sweep of this step reduces the change by a third only, so a small change is no small error."""
    made = compile_method("fast_heavy_top", "vcf:vcf_gauss2")
    runner = Emitted(made, "c")
    (case,) = (case for case in cases(made) if case.name == name)
    found = answer(made, runner, case)
    assert found.verdict == ACCURATE
    assert found.error is not None
    assert found.error < 1e-13


FAULTS = {
    "a wrong last half": lambda sound, y, h, n, t: [x * (1 + 1e-8) for x in sound.run(y, h, n, t)],
    "the old state": lambda sound, y, h, n, t: list(y),
    "no number": lambda sound, y, h, n, t: [math.nan] * len(y),
    "a constant": lambda sound, y, h, n, t: [1.0] * len(y),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_an_answer_that_is_neither_is_wrong(fault, monkeypatch):
    made = compile_method("free_rigid_body", "rkmk:rk4")
    runner = Emitted(made, "c")
    usual = next(iter(cases(made)))
    assert answer(made, runner, usual).verdict == ACCURATE
    monkeypatch.setitem(runner.__dict__, "integrator", Spoilt(runner.integrator, FAULTS[fault]))
    assert answer(made, runner, usual).verdict.startswith(WRONG)


def test_what_solves_the_equations_almost_is_wrong(monkeypatch):
    """The midpoint rule in a step that a fixed point does not solve, its answer off in the tenth digit."""
    made = compile_method("heavy_top", "vcg:midpoint")
    runner = Emitted(made, "c")
    (case,) = (case for case in cases(made) if case.name == "angle 100")
    assert answer(made, runner, case).verdict == ACCURATE
    spoilt = Spoilt(
        runner.integrator, lambda sound, y, h, n, t: [x * (1 + 1e-10) for x in sound.run(y, h, n, t)]
    )
    monkeypatch.setitem(runner.__dict__, "integrator", spoilt)
    assert answer(made, runner, case).verdict.startswith(WRONG)


def test_an_answer_to_nan_is_wrong(monkeypatch):
    made = compile_method("free_rigid_body", "rkmk:rk4")
    runner = Emitted(made, "c")
    spoilt = Spoilt(runner.integrator, FAULTS["a constant"])
    monkeypatch.setitem(runner.__dict__, "integrator", spoilt)
    case = Case("h = nan", (1.0, 0.0, 0.0), 0.0, math.nan)
    assert answer(made, runner, case).verdict.startswith(WRONG)


def test_digits_go_as_the_angle_grows():
    made = compile_method("free_rigid_body", "cf:cf4")
    runner = Emitted(made, "c")
    usual = next(iter(cases(made)))
    digits = [answer(made, runner, replace(usual, h=h)).determined for h in (0.1, 10.0, 300.0)]
    assert digits == sorted(digits, reverse=True)
    assert digits[0] > digits[-1] + 4


FAR = 2.0**8
"""Radians that four stages may turn through."""


@pytest.mark.parametrize("scene", ["driven_spin", "free_rigid_body", "fast_heavy_top"])
def test_the_last_step_before_the_limit_has_its_digits_and_the_first_beyond_is_a_status(scene):
    """The exponentials of CF4's update turn by a third to two thirds of the step."""
    made = compile_method(scene, "cf:cf4")
    runner = Emitted(made, "c")
    angle = next(case for case in cases(made) if case.name == "angle 100")
    near = answer(made, runner, replace(angle, h=angle.h * FAR / 100))
    assert near.verdict == ACCURATE
    assert near.error is not None
    assert near.error < 1e-3
    far = answer(made, runner, replace(angle, h=angle.h * 4 * FAR / 100))
    assert far.verdict.startswith("status: the step is too long")


def test_an_answer_without_digits_is_undetermined_however_well_rounding_explains_it(monkeypatch):
    """The control: with the limit of a single angle for a chain of them."""
    monkeypatch.setattr("codegen.printers.c.module.chain", lambda kernel: 1)
    made = compile_method("free_rigid_body", "cf:cf4")
    runner = Emitted(made, "c")
    named = {case.name: case for case in cases(made)}
    found = answer(made, runner, named["angle 1e+06"])
    assert found.verdict == SILENT
    assert found.determined is not None
    assert found.determined < 3
    assert answer(made, runner, named["angle 100"]).verdict == ACCURATE


def test_rounding_within_a_step_is_not_taken_for_a_fault():
    """CF4 computes a constant momentum as a difference, which loses digits as the angle grows."""
    made = compile_method("free_rigid_body_attitude", "cf:cf4")
    runner = Emitted(made, "c")
    angle = next(case for case in cases(made) if case.name == "angle 100")
    assert answer(made, runner, angle).verdict == ACCURATE
    spoilt = [x * (1 + 1e-9) for x in runner.integrator.run(list(angle.state), angle.h, 1, angle.t)]
    assert answer(made, Answering(runner, spoilt), angle).verdict.startswith(WRONG)


class Answering:
    """A runner whose integrator gives one answer."""

    def __init__(self, runner: Emitted, found) -> None:
        self.compiled, self.observed = runner.compiled, runner.observed
        self.integrator = Spoilt(runner.integrator, lambda *_: found)


@pytest.mark.parametrize(
    ("method", "scale", "verdict"),
    [
        ("vcg:midpoint", 1e75, SILENT),
        ("vcg:midpoint", 1e150, SILENT),
        ("vrkmk(2):gauss2", 1e-160, ACCURATE),
    ],
)
def test_very_large_and_very_small_states_get_enough_digits(method, scale, verdict):
    """In a double, q = 1e75 has no digit that the sine needs. With 60 digits, q + h q' has none either."""
    G = Rn(1)
    q, p = G.point("q"), G.dual("p")
    pendulum = HamiltonianScene(
        group=G, q=q, mu=p, H=p[0] ** 2 / 2 - cos(q[0]), q0=[Rational(157, 50)], mu0=[0], span=(0, 20)
    )
    made = compile_method(pendulum, method)
    found = answer(made, Emitted(made, "c"), Case("", (3.14 * scale, 0.0), 0.0, 0.2))
    assert found.verdict == verdict
