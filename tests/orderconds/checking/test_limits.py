"""Checks of large tableaux end: compositions are recognised in plain arrays, and limits bound the rest."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds import Tableau, check
from orderconds.checking.limits import Limits
from orderconds.cli import program
from orderconds.tableau import find


def plain(name: str, folder: Path) -> Path:
    """Write A and b of a library tableau as Python lists of floats."""
    tableau = Tableau.load(find(name))
    method = tableau.read_as(("rk",))
    assert method is not None
    near = tableau.ring.nearest_float  # type: ignore[attr-defined]
    path = folder / f"{name}.py"
    rows = [[near(x) for x in row] for row in method.A]  # type: ignore[union-attr]
    weights = [near(x) for x in method.b]  # type: ignore[union-attr]
    path.write_text(f"A = {rows!r}\nb = {weights!r}\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("name", ["kahan_li8", "suzuki_umeno8"])
@pytest.mark.parametrize("family", ["vcg", "cg", "vrkmk(6)"])
def test_compositions_in_plain_arrays_are_decided_by_theorem(name: str, family: str, tmp_path: Path) -> None:
    for order in (None, 8):
        (found,) = check(plain(name, tmp_path), family, order).orders
        assert (found.order, found.certificate, found.limit) == (8, "double", None)


def test_the_csv_of_a_composition_is_checked_against_all_its_claims(tmp_path: Path) -> None:
    path = tmp_path / "kahan_li8.csv"
    runner = CliRunner()
    assert runner.invoke(program, ["convert", "kahan_li8", "--to", "csv", "-o", str(path)]).exit_code == 0
    report = check(path)
    assert report.verdict == "holds"
    assert {f.family: f.order for f in report.orders}["vcg"] == 8


def test_one_coefficient_of_few_digits_leaves_few_conditions_to_evaluate() -> None:
    text = find("kahan_li8").read_text(encoding="utf-8")
    for kept in (4, 12, 18):
        digits = "0.130202483088890080878817632809354147330815171467180665642633"
        report = check(Tableau.loads(text.replace(digits, digits[: kept + 2])))
        assert report.verdict == "fails"  # the proof is lost
        assert all(f.certificate in ("decimal", "none") for f in report.orders)


def test_a_composition_with_one_changed_entry_is_not_recognised(tmp_path: Path) -> None:
    path = plain("suzuki_umeno8", tmp_path)
    text = path.read_text(encoding="utf-8")
    first = text[text.index("[[") + 2 : text.index(",")]
    path.write_text(text.replace(first, str(float(first) * 1.01), 1), encoding="utf-8")
    (found,) = check(path, "vcg", 8).orders
    assert found.order < 8
    assert found.verdict == "fails"


def test_a_limit_on_conditions_leaves_a_lower_bound() -> None:
    (found,) = check("dop853", "rk", 8, limits=Limits(conditions=60)).orders
    assert (found.order, found.limit, found.verdict) == (7, 7, "undecided")
    assert found.stopped == 1 + 1 + 2 + 4 + 9 + 20 + 48


def test_a_limit_on_time_or_memory_leaves_a_lower_bound() -> None:
    for limits in (Limits(seconds=1e-9), Limits(megabytes=1)):
        (found,) = check("dop853", "rk", 8, limits=limits).orders
        assert (found.order, found.stopped, found.verdict) == (0, 0, "undecided")


def test_the_command_takes_limits_and_says_where_it_stopped() -> None:
    arguments = ["check", "dop853", "-f", "rk", "--order", "8", "--max-conditions", "60"]
    found = CliRunner().invoke(program, arguments)
    assert found.exit_code == 1
    assert (
        "no condition fails up to order 7; a limit on conditions, time or memory ended the check after "
        "85 conditions"
    ) in found.output
    record = json.loads(CliRunner().invoke(program, [*arguments, "--json"]).stdout)[0]["orders"]["rk"]
    assert (record["order"], record["limit"], record["stopped"], record["verdict"]) == (7, 7, 85, "undecided")
