"""``orderconds refine`` on doubles: exact coefficients, in the format of the output file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.checking import check
from orderconds.cli import program
from orderconds.tableau import Tableau, find

NAMES = {"rk4": 4, "gauss2": 4, "gauss3": 6, "alexander2": 2, "dormand_prince5": 5}


def of_floats(name: str, path: Path) -> Path:
    tableau = Tableau.load(find(name))
    near = tableau.ring.nearest_float  # type: ignore[attr-defined]
    method = tableau.abelian()
    rows = [[near(x) for x in row] for row in method.A]
    path.write_text(json.dumps({"A": rows, "b": [near(x) for x in method.b], "order": NAMES[name]}))
    return path


@pytest.mark.parametrize("name", NAMES)
def test_the_exact_tableau_of_floats_is_written_and_proved(name: str, tmp_path: Path) -> None:
    source, target = of_floats(name, tmp_path / "m.json"), tmp_path / "exact.toml"
    assert check(source).orders[0].certificate == "double"
    assert "to print the exact numbers, type: orderconds refine FILE" in check(source).hint
    result = CliRunner().invoke(program, ["refine", str(source), "-o", str(target)])
    assert (result.exit_code, result.output) == (0, "")
    report = check(target, certified=True)
    assert (report.verdict, report.orders[0].certificate) == ("holds", "exact")
    original = Tableau.load(find(name)).abelian()
    exact = Tableau.load(target)
    assert [[exact.ring.text(x) for x in row] for row in exact.abelian().A] == [
        [Tableau.load(find(name)).ring.text(x) for x in row] for row in original.A
    ]


def test_floats_without_a_closed_form_and_exact_tableaux_exit_1(tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.json"
    wrong.write_text('{"A": [[0.0]], "b": [0.7182818284590452]}')
    exact = tmp_path / "exact.csv"
    exact.write_text("A,0\nb,1\n")
    for path, message in ((wrong, "fractions and numbers p + q sqrt(d)"), (exact, "exact already")):
        result = CliRunner().invoke(program, ["refine", str(path), "--json"])
        assert result.exit_code == 1
        assert message in result.stderr
        assert json.loads(result.stdout)["exact"] == {}
