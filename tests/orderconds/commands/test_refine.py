"""``orderconds refine`` on doubles: exact coefficients, in the format of the output file."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds import refine
from orderconds.checking import check
from orderconds.cli import program
from orderconds.exchange import FORMATS
from orderconds.proof.krawczyk import NotProved
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


def test_digits_have_no_effect_without_a_proof_table_and_exact_coefficients_have_no_proof(
    tmp_path: Path,
) -> None:
    source = of_floats("rk4", tmp_path / "m.json")
    plain = CliRunner().invoke(program, ["refine", str(source), "--json"])
    noted = CliRunner().invoke(program, ["refine", str(source), "--json", "--digits", "60"])
    assert (plain.stderr, noted.exit_code, noted.stdout) == ("", 0, plain.stdout)
    assert re.match("note: .*no .proof. table", noted.stderr)
    assert json.loads(plain.stdout)["proof"] is None


@pytest.mark.parametrize("suffix", [suffix for _, suffix in FORMATS.values()])
def test_a_refined_proof_is_written_in_the_format_of_the_suffix(suffix: str, tmp_path: Path) -> None:
    source, target = tmp_path / "m.json", tmp_path / f"refined{suffix}"
    assert CliRunner().invoke(program, ["convert", "cg4a", "-o", str(source)]).exit_code == 0
    result = CliRunner().invoke(program, ["refine", str(source), "--digits", "30", "-o", str(target)])
    assert result.exit_code == 0
    refined = Tableau.load(target)
    assert refined.file is not None
    assert min(u.constant.unit for u in refined.file.symbolic.decimals()) == Fraction(1, 10**30)
    kept = suffix in (".toml", ".json")
    assert (refined.proof is not None) is kept
    assert ("does not contain the key proof" in result.stderr) is not kept
    if kept:
        assert check(target, certified=True).verdict == "holds"


def test_a_json_file_with_a_proof_is_refined_in_place(tmp_path: Path) -> None:
    path = tmp_path / "m.json"
    CliRunner().invoke(program, ["convert", "cg4a", "-o", str(path)])
    result = CliRunner().invoke(program, ["refine", str(path), "--digits", "30", "-o", str(path)])
    assert (result.exit_code, result.output) == (0, "")
    assert json.loads(path.read_text())["name"] == "cg4a"
    assert check(path, certified=True).verdict == "holds"


DOUBLES = {"A": [[0, 0], [0.6666666666666666, 0]], "b": [0.25, 0.75]}
WRONG: dict[str, tuple[dict[str, object], str]] = {
    "order": ({"order": 3}, "rk: claimed order 3, computed order 2"),
    "claims": ({"claims": {"rk": 2, "cg": 3}}, "cg: claimed order 3, computed order 2"),
    "property": (
        {"claims": {"rk": 2, "symmetric": True}},
        "property symmetric: claimed true, computed false",
    ),
    "embedded": ({"embedded": {"b": [1, 0], "order": 2}}, "embedded: claimed order 2, computed order 1"),
    "dense": ({"dense": {"b": [[0.25], [0.75]], "order": 2}}, "dense: claimed order 2, computed order 1"),
    "end": (
        {"dense": {"b": [[1], [0]], "order": 1}},
        "the continuous extension does not end at the new state",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_no_wrong_claim_is_written_with_exact_coefficients(case: str, tmp_path: Path) -> None:
    keys, reason = WRONG[case]
    source, target = tmp_path / "m.json", tmp_path / "exact.toml"
    source.write_text(json.dumps({**DOUBLES, **keys}))
    result = CliRunner().invoke(program, ["refine", str(source), "-o", str(target), "--json"])
    assert (result.exit_code, target.exists()) == (1, False)
    assert reason in result.stderr
    assert reason in json.loads(result.stdout)["reason"]
    with pytest.raises(NotProved, match=re.escape(reason)):
        refine(source)


def test_no_wrong_claim_is_written_with_more_digits(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    text = find("cg4a").read_text().replace("vcg = 2", "vcg = 4")
    path.write_text(text)
    result = CliRunner().invoke(program, ["refine", str(path), "-o", str(path)])
    assert result.exit_code == 1
    assert "vcg: claimed order 4, computed order 2" in result.stderr
    assert path.read_text() == text


def test_right_claims_are_written_with_exact_coefficients(tmp_path: Path) -> None:
    source, target = tmp_path / "m.json", tmp_path / "exact.json"
    right = {"order": 2, "dense": {"b": [[0.25], [0.75]], "order": 1}, "embedded": {"b": [1, 0], "order": 1}}
    source.write_text(json.dumps({**DOUBLES, **right}))
    result = CliRunner().invoke(program, ["refine", str(source), "-o", str(target)])
    assert (result.exit_code, result.output) == (0, "")
    assert (json.loads(target.read_text())["A"][1][0], check(target).verdict) == ("2/3", "holds")
