"""The hand-written steps are the methods they are timed against; the interval is one of the median."""

from __future__ import annotations

import math
import random
import statistics
from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks import emitted
from codegen.emitter import emit


@pytest.mark.parametrize("key", emitted.CASES)
# At five times the step the equations of VCF4 have no solution by simplified Newton, and the step says so.
@pytest.mark.parametrize("longer", [3.0, pytest.param(0.625, marks=pytest.mark.slow)])
def test_a_hand_written_step_is_the_method_it_is_timed_against(
    key: str, longer: float, tmp_path: Path
) -> None:
    case = emitted.CASES[key]
    case = replace(case, h=longer * case.h)
    emission = emit(case.scene, case.method)
    sides = [
        emitted.build_emitted(case, emission, tmp_path / "emitted"),
        emitted.build_hand(case, emission, tmp_path / "hand"),
    ]
    x, y = (emitted.run(side, 40).state for side in sides)
    emitted.check_same(x, y, 1e-12)
    with pytest.raises(SystemExit, match="differ"):
        emitted.check_same(x, emitted.run(sides[1], 39).state)


def test_the_interval_holds_the_median_at_least_as_often_as_it_says() -> None:
    generator = random.Random(5)
    held = 0
    for _ in range(400):
        low, high = emitted.interval([generator.expovariate(1.0) for _ in range(31)])
        held += low <= 0.6931471805599453 <= high
    assert held >= 0.95 * 400
    values = [generator.random() for _ in range(41)]
    low, high = emitted.interval(values)
    assert low < statistics.median(values) < high
    assert emitted.interval([float(k) for k in range(1, 32)]) == (10.0, 22.0)


@pytest.mark.parametrize(("steps", "error"), [(20, 7.029e-8), (40, 4.493e-9), (80, 2.847e-10)])
def test_rkmk4_by_hand_has_the_errors_of_two_brackets(steps: int, error: float, tmp_path: Path) -> None:
    found = []
    for name, n in (("free_rigid_body_rkmk4", steps), ("free_rigid_body_cf4", 4000)):
        case = emitted.Case("free_rigid_body", "cf4", name, 2 / n, n)
        program = emitted.build_hand(case, emit("free_rigid_body", "cf4"), tmp_path / name)
        found.append(emitted.run(program, n).state)
    assert math.dist(*found) == pytest.approx(error, rel=1e-3)
