"""Every family in every target: emitted clean, equal to the interpreter, of the stated order and no other.

One table over both registries. A family is tried with an explicit and an implicit tableau where it has both,
on a polynomial scene without symmetry, where the order of the very program that is printed follows from its
exact local error over Q[[h]], and on a scene of the gallery with transcendental functions, where the local
error is measured against an extrapolation code with 40 digits. A family or a target that is not in the tables
below fails here.
"""

from __future__ import annotations

import random
import shutil
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache
from typing import Any

import mpmath
import pytest

from codegen.artifact import Artifact
from codegen.build import Compiler, compile_files
from codegen.certify import certified_order
from codegen.emitter import Compiled, compile_method, emit_compiled
from codegen.ir.domain import FloatDomain
from codegen.ir.interpret import interpret
from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE, SINGLE
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lab.reference import reference
from codegen.lab.runner import Interpreted
from codegen.loader import load
from codegen.lower import lowering, names, problem_for
from codegen.lower.flow_words import FlowLowering
from codegen.printers import names as target_names
from codegen.printers.c.module import FLAGS
from codegen.scene.problem import Problem
from codegen.scenes import load as gallery
from tests.codegen.family_cases import CASES
from tests.promises import clean_c, clean_python, ulps

EXPLICIT_ULPS = 8
"""How far emitted code may be from the interpreter: only Stumpff functions are rounded otherwise there."""

FLOWS_ULPS = 32
"""The same for about thirty flows in a row, with sums in a new order (codegen.kernel.critical_path)."""

IMPLICIT_ULPS = 32
"""The same where equations are solved: their solutions are as sharp as the stopping rule, 2^-44."""

ROUNDING_ULPS = 256
"""How far the ends of a hundred steps may be apart: -O1 and -O2 call other library functions."""


CLEAN = {"c": ("gcc", "clang"), "python": ("",)}
"""The compilers that check the texts of a target; other targets have such checks of their own."""

ALL = [
    pytest.param(case, id=case.method, marks=() if case is cases[0] else pytest.mark.slow)
    for cases in CASES.values()
    for case in cases
]
"""The first case of a family is tried in every run of the tests."""


def test_every_family_is_tried():
    assert sorted(CASES) == sorted(names())
    assert all(case.method.startswith(family) for family, cases in CASES.items() for case in cases)


@cache
def compiled(method: str, scene: str | Callable[[], Problem]) -> Compiled:
    return compile_method(scene if isinstance(scene, str) else scene(), method)


@cache
def emitted(method: str, scene: Any, target: str) -> Artifact:
    return emit_compiled(compiled(method, scene), target, prefix="tried_")


def stepper(made: Compiled) -> Callable[[list[float], float, float], list[float]]:
    """One step by the interpreter, of the program as lowered: no pass has touched it."""
    view = problem_for(made.scene, made.method)

    def step(state: list[float], h: float, t: float) -> list[float]:
        values: dict[str, Any] = {"t": t}
        first = 0
        for block in view.state:
            values[block.name] = tuple(state[first : first + len(block.symbols)])
            first += len(block.symbols)
        after = interpret(made.lowered, view, FloatDomain(h), values)
        return [x for block in view.state for x in after[block.name]]

    return step


@pytest.mark.parametrize(
    ("target", "compiler"),
    # The first compiler of each target is quick enough for every run.
    [pytest.param(t, c, marks=pytest.mark.slow if c != CLEAN[t][0] else ()) for t in CLEAN for c in CLEAN[t]],
)
@pytest.mark.parametrize("case", ALL)
def test_emitted_code_is_clean_and_its_example_runs(case, target, compiler, tmp_path):
    """The example's answer is that of the loaded module."""
    made, emission = compiled(case.method, case.polynomial), emitted(case.method, case.polynomial, target)
    if compiler and shutil.which(compiler) is None:
        pytest.skip(f"{compiler} is not installed")
    if target == "c":
        printed = clean_c(emission, Compiler((compiler,), compiler), tmp_path)
    else:
        printed = clean_python(emission, tmp_path)
    first, last = made.scene.span
    found = load(emission).run(emission.manifest["initial"], float((last - first) / 100), 100, float(first))
    assert ulps(printed, found) <= ROUNDING_ULPS


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize("where", ["polynomial", "gallery"])
@pytest.mark.parametrize("case", ALL)
def test_emitted_steps_are_those_of_the_interpreter(case, where, target):
    scene = getattr(case, where)
    made, emission = compiled(case.method, scene), emitted(case.method, scene, target)
    integrator, step = load(emission), stepper(made)
    flows = isinstance(lowering(made.method.family), FlowLowering)
    explicit = FLOWS_ULPS if flows else EXPLICIT_ULPS
    allowed = IMPLICIT_ULPS if emission.manifest["interface"]["blocks"] else explicit
    state, rng = list(emission.manifest["initial"]), random.Random(case.method)
    for _ in range(4):
        h, t = rng.uniform(-1, 1) / 32, rng.uniform(0, 3)
        new = step(state, h, t)
        assert ulps(integrator.step(state, h, t), new) <= allowed
        state = new


@pytest.mark.parametrize("case", ALL)
def test_the_order_is_exact_where_the_scene_is_polynomial(case):
    made = compiled(case.method, case.polynomial)
    assert certified_order(made.method, made.scene).order == case.order
    view = problem_for(made.scene, made.method)
    for program in (made.lowered, made.program):
        error = local_error(program, view, made.method.ring, case.order + 1)
        assert valuation(error) == case.order + 1


def spanned(scene: Problem, h: Fraction) -> Problem:
    """The scene from its beginning to the time h later."""
    return replace(scene, span=(scene.span[0], scene.span[0] + h))


@cache
def underway(name: str) -> Problem:
    """A scene of the gallery that starts where it is after an eighth: what is special at first is over."""
    scene = gallery(name)
    constants = iter(reference(spanned(scene, Fraction(1, 8))).digits(34))
    space = scene.roots[0].space
    state = tuple(
        replace(block, initial=tuple(space.const(decimal(next(constants))) for _ in block.symbols))
        for block in scene.state
    )
    begin, end = scene.span
    return replace(scene, state=state, span=(begin + Fraction(1, 8), end))


def decimal(text: str) -> Number:
    return Number.rational(*Fraction(text).as_integer_ratio())


@cache
def exact(name: str, h: Fraction) -> tuple[Any, ...]:
    """The solution after the time h, to 28 digits."""
    return reference(spanned(underway(name), h)).state


@pytest.mark.parametrize("case", ALL)
def test_the_order_is_seen_from_below_and_above_with_forty_digits(case):
    """The local error is O(h^(p+1)), and not smaller: halving h divides it by 2^(p+1), up to O(h)."""
    made = compiled(case.method, case.gallery)
    errors = []
    for h in (Fraction(1, 256), Fraction(1, 512)):
        scene = spanned(underway(case.gallery), h)
        state = Interpreted(replace(made, scene=scene), digits=40).final(1)
        errors.append(max(abs(x - y) for x, y in zip(state, exact(case.gallery, h), strict=True)))
    assert errors[1] > 1e-24
    slope = float(mpmath.log(errors[0] / errors[1], 2))
    assert slope == pytest.approx(case.order + 1, abs=0.1)


SINGLE_ULPS = 24
"""How far a step in floats may be from the interpreter in doubles, in units of the last place of floats."""


@pytest.mark.parametrize("target", sorted(target_names()))
@pytest.mark.parametrize("case", ALL)
def test_single_precision_is_the_same_step_rounded_more(case, target, tmp_path):
    made = compiled(case.method, case.polynomial)
    emission = emit_compiled(made, target, "tried_", precision="single")
    if target == "c":  # no double may slip in: neither by a constant nor by a function
        flags = (*FLAGS, "-Wdouble-promotion", "-Wfloat-conversion", "-Wunsuffixed-float-constants", "-c")
        compile_files(emission.files, tmp_path, tmp_path / "o", flags, Compiler(("gcc",), "gcc"))
    integrator, step = load(emission), stepper(made)
    state, rng = list(emission.manifest["initial"]), random.Random(case.method)
    for _ in range(4):
        state = [SINGLE.round(x) for x in state]
        h, t = (SINGLE.round(rng.uniform(*ends)) for ends in ((-1 / 32, 1 / 32), (0, 3)))
        found, new = integrator.step(state, h, t), step(state, h, t)
        assert ulps(found, new) * (DOUBLE.unit / SINGLE.unit) <= SINGLE_ULPS
        assert found == [SINGLE.round(x) for x in found]
        state = new
