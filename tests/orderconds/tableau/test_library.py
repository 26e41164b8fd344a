"""The library: every file is complete, named after its tableau, sourced, and found in tree and wheel."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from orderconds.errors import UnknownName
from orderconds.ring import Balls
from orderconds.tableau import Composition, RungeKutta, Tableau, available, dumps, find
from orderconds.tableau.library import bibliography, root
from orderconds.tableau.properties import properties

REPOSITORY = Path(__file__).resolve().parents[3]


@pytest.mark.parametrize("name", available())
def test_a_file_is_named_after_its_tableau_sourced_and_claimed(name: str) -> None:
    tableau = Tableau.load(find(name))
    assert tableau.name == name
    assert tableau.source
    assert f"{{{tableau.bibtex}," in bibliography().read_text(encoding="utf-8")
    assert tableau.claims.orders


@pytest.mark.parametrize("name", available())
def test_claimed_properties_hold_and_those_that_hold_are_claimed(name: str) -> None:
    tableau = Tableau.load(find(name))
    assert tableau.claims.properties == {p: True for p, holds in properties(tableau).items() if holds}


@pytest.mark.parametrize("name", available())
def test_a_library_tableau_survives_writing(name: str) -> None:
    tableau = Tableau.load(find(name))
    again = Tableau.loads(dumps(tableau))
    if not isinstance(tableau.ring, Balls):
        assert again.method == tableau.method
    assert again.claims == tableau.claims


def test_no_two_files_share_a_name() -> None:
    stems = [path.stem for path in root().rglob("*.toml")]
    assert sorted(stems) == list(available())


def test_every_entry_of_the_bibliography_is_cited_or_is_the_thesis() -> None:
    keys = re.findall(r"^@\w+\{(\w+),", bibliography().read_text(encoding="utf-8"), re.MULTILINE)
    assert keys == sorted(set(keys))
    cited = {Tableau.load(find(name)).bibtex for name in available()}
    assert set(keys) == cited


def test_an_unknown_name_is_refused_with_the_nearest_names() -> None:
    with pytest.raises(UnknownName, match="kutta3"):
        find("kutta4")


def test_the_wheels_copy_is_used_where_there_is_no_source_tree(tmp_path: Path) -> None:
    shutil.copytree(REPOSITORY / "orderconds", tmp_path / "orderconds")
    shutil.copytree(REPOSITORY / "tableaux", tmp_path / "orderconds" / "_tableaux")
    (tmp_path / "pyproject.toml").write_text('[project]\nname = "another"\n', encoding="utf-8")
    program = "from orderconds.tableau import find; print(find('cg3'))"
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env={"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    assert done.stdout.strip() == str(tmp_path / "orderconds" / "_tableaux" / "cg" / "cg3.toml"), done.stderr


def test_cg4_weights_and_abscissae_are_those_of_the_triple_jump_with_a_stage_of_weight_zero() -> None:
    tableau = Tableau.load(find("cg4"))
    method, ring = tableau.method, tableau.ring
    assert isinstance(method, RungeKutta)
    assert [ring.approximate(x, 16) for x in method.b] == [
        "0.6756035959798288",
        "0",
        "-0.1756035959798288",
        "-0.1756035959798288",
        "0.6756035959798288",
    ]
    assert method.c[0] == 0
    assert method.c[4] == 1
    assert method.c[2] + method.c[3] == 1


def test_yoshidas_steps_begin_with_the_digits_he_printed() -> None:
    tableau = Tableau.load(find("yoshida6"))
    assert isinstance(tableau.method, Composition)
    printed = (
        "0.78451361047755726381949763",
        "0.23557321335935813368479318",
        "-1.17767998417887100694641568",
        "1.31518632068391121888424973",
    )
    for step, digits in zip(tableau.method.gamma, printed, strict=False):
        assert abs(float(step) - float(digits)) < 1e-15
        spelled = tableau.ring.approximate(step, 27 if digits.lstrip("-")[0] == "1" else 26)
        assert spelled == digits


def test_loading_a_tableau_imports_no_heavy_package() -> None:
    heavy = ("numpy", "sympy", "networkx", "scipy", "matplotlib", "mpmath")
    program = (
        "import sys; from orderconds.tableau import Tableau, find; Tableau.load(find('cg4'));"
        f"print([m for m in {heavy} if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={"PYTHONPATH": str(REPOSITORY)},
        capture_output=True,
        text=True,
    )
    assert done.stdout.strip() == "[]", done.stderr
