"""Stability intervals of methods: proofs for rounded decimals, and the same statement in all outputs."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from codegen import scenes
from codegen.lab.default_methods import methods_for
from codegen.lab.measurements.stability import _row
from codegen.lab.stability.largest_step import Limit
from codegen.lab.stability.linear_stability import Region, interval, region
from codegen.lab.stability.stability_study import Findings, Stability

ROUNDED = """
name = "rounded"
family = "rk"
order = 4
A = [[], ["0.5"], ["0", "0.5"], ["0", "0", "1"]]
b = ["0.16666667~", "0.33333333~", "0.33333333~", "0.16666667~"]
"""


def found(spelling: str) -> Region:
    (method,) = methods_for(scenes.load("free_rigid_body"), [spelling])
    result = region(method)
    assert result is not None
    return result


@pytest.mark.parametrize(
    ("spelling", "real", "imaginary"),
    [
        ("ambient:vcg4_s4", 196.1165121669881, 0.0),
        ("ambient:vcg4_s5_dirk", 7.179945636866425, 0.0),
        ("cf:cf4_2n_s7", 3.587925448534925, 0.0),
        ("ambient:cg5", 3.227881716002213, 0.0),
        ("ambient:ssp54", 5.33147264041648, 3.278355597642479),
        ("ambient:yoshida6", 1.6116932032284532, math.inf),
    ],
)
def test_a_proof_of_the_order_decides_the_imaginary_axis_for_rounded_decimals(
    spelling: str, real: float, imaginary: float
) -> None:
    known = found(spelling)
    assert known.real == pytest.approx(real, rel=1e-9)
    assert known.imaginary == pytest.approx(imaginary, rel=1e-9)


def test_text_json_and_report_make_the_same_statement(tmp_path: Path) -> None:
    file = tmp_path / "rounded.toml"
    file.write_text(ROUNDED, encoding="utf-8")
    rounded = found(f"ambient:{file}")
    assert rounded.real == pytest.approx(2.7853, abs=1e-4)
    assert rounded.imaginary is None
    for known, text, data in (
        (rounded, "undecided", None),
        (found("ambient:gauss1"), "unbounded", None),
        (found("ambient:butcher6"), "none", 0.0),
        (found("ambient:kutta3"), "1.732", math.sqrt(3)),
    ):
        assert interval(known.imaginary) == text
        record = known.as_json()
        assert record["undecided"] == (["imaginary"] if text == "undecided" else [])
        assert record["imaginary"] == pytest.approx(data)
        limit = Limit(None, None, "")
        row = _row(Stability("scene", "method", known, Findings(limit, (), (), ())))
        assert row["imaginary"] == interval(known.imaginary, 3)
