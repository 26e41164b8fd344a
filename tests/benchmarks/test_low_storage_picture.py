"""The picture of 2N schemes: its numbers, its parts, and the file in the documentation."""

import pytest

from benchmarks import low_storage_picture as picture
from benchmarks.low_storage_picture import Run

RUNS = [
    Run(10, 1e-6, 0.5),
    Run(20, 2e-6, 1e-2),
    Run(40, 4e-6, 1e-4),
    Run(80, 8e-6, 9e-5),
    Run(160, 2e-5, 1e-7),
]


def test_runs_at_rounding_and_with_large_errors_are_not_drawn():
    assert picture.above_rounding(RUNS) == RUNS[1:3]


@pytest.mark.parametrize(("quantity", "value"), [("evaluations", 800**0.5), ("seconds", 8e-12**0.5)])
def test_quantities_are_interpolated_on_logarithmic_scales(quantity, value):
    assert picture.least({"x": RUNS, "y": RUNS[:2]}, 1e-3, quantity) == {"x": pytest.approx(value)}


def test_each_problem_has_two_panels_with_every_method():
    labels = [f"cf:{name}" for name in (*picture.FOUND, *picture.PUBLISHED)]
    problems = {title: dict.fromkeys(labels, RUNS) for title in ("first", "second")}
    text = picture.drawn(problems)
    assert text.count("<title>cf5_s7: 20 evaluations, 2 µs, error 0.01<") == 4
    assert text.count(">first<") == text.count(">second<") == 1
    kept = picture.PICTURE.read_text(encoding="utf-8")
    assert all(f">{label.partition(':')[2]}<" in kept for label in labels)
    assert "benchmarks/low_storage_picture.py" in (picture.ROOT / "docs/reference/discoveries.md").read_text()
