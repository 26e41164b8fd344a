"""``orderconds table``: the library as a table, current in a file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.cli import program
from orderconds.commands import table
from orderconds.tableau import available

ROOT = Path(__file__).parents[3]


def run(*arguments: str):  # type: ignore[no-untyped-def]
    return CliRunner().invoke(program, ["table", *arguments])


def test_the_page_of_the_library_names_every_tableau() -> None:
    text = (ROOT / "docs/reference/library.md").read_text(encoding="utf-8")
    shown = text[text.index(table.BEGIN) : text.index(table.END)].splitlines()[3:]
    assert tuple(line.split(" | ")[0].removeprefix("| ") for line in shown) == available()


@pytest.fixture
def three(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("orderconds.tableau.available", lambda: ("cf4", "rk4"))


@pytest.mark.usefixtures("three")
def test_a_table_is_put_between_the_marks_and_then_found_there(tmp_path: Path) -> None:
    file = tmp_path / "README.md"
    file.write_text(f"before\n{table.BEGIN}\n{table.END}\nafter\n", encoding="utf-8")
    assert run("--check", str(file)).exit_code == 1
    assert run("--write", str(file)).exit_code == 0
    assert run("--check", str(file)).exit_code == 0
    text = file.read_text(encoding="utf-8")
    assert text.startswith("before\n")
    assert text.endswith("after\n")
    assert "| rk4 | rk | rk 4, rkmk 4, sprk 4, vrkmk 4, cg 2, vcg 2 | 4 | 4 | 1.03e-01 | exact |" in text


@pytest.mark.usefixtures("three")
def test_without_a_file_the_table_is_printed() -> None:
    assert run().output.splitlines()[0].startswith("| tableau | format |")


@pytest.mark.usefixtures("three")
def test_a_file_without_marks_is_bad_usage(tmp_path: Path) -> None:
    (tmp_path / "x.md").write_text("nothing", encoding="utf-8")
    result = run("--write", str(tmp_path / "x.md"))
    assert result.exit_code == 2
    assert "cannot find the comments that enclose the table" in result.output


def test_a_file_that_cannot_be_read_is_told_before_anything_is_computed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(table, "computed", None)
    (tmp_path / "latin.md").write_bytes(b"caf\xe9")
    for name, said in (
        ("latin.md", "bytes that are not UTF-8"),
        ("absent.md", "no such file"),
        (".", "is a dir"),
    ):
        result = run("--check", str(tmp_path / name))
        assert (result.exit_code, said in result.output) == (2, True)


@pytest.mark.usefixtures("three")
def test_json_has_a_record_a_tableau_also_beside_a_file(tmp_path: Path) -> None:
    rows = json.loads(run("--json").stdout)
    assert [row["tableau"] for row in rows] == ["cf4", "rk4"]
    assert rows[0] == {
        "tableau": "cf4",
        "format": "cf",
        "orders_claimed": "cf 4, rk 4, vcf 4",
        "stages": "4",
        "exponentials": "5",
        "error_norm": "5.68e-02",
        "certificate": "exact",
    }
    file = tmp_path / "README.md"
    file.write_text(f"{table.BEGIN}\n{table.END}\n", encoding="utf-8")
    result = run("--check", str(file), "--json")
    assert (result.exit_code, json.loads(result.stdout)) == (1, rows)


def test_the_butcher_tableaux_of_methods_are_printed() -> None:
    lines = run("vrkmk(1):kutta3", "vcg:midpoint").output.splitlines()
    assert lines == [
        "vrkmk(1):kutta3, order 3 (exact)",
        "  0   | 0    0    0",
        "  1/2 | 1/2  0    0",
        "  1   | -1   2    0",
        "  ----+--------------",
        "      | 1/6  2/3  1/6",
        "",
        "vcg:midpoint, order 2 (exact)",
        "  1/2 | 1/2",
        "  ----+----",
        "      | 1",
    ]


def test_a_composition_of_midpoint_rules_is_a_runge_kutta_method() -> None:
    (record,) = json.loads(run("vcg:triple_jump", "--json").output)
    assert (record["order"], record["certificate"]) == (4, "exact")
    g, middle = 1 / (2 - 2 ** (1 / 3)), 1 - 2 / (2 - 2 ** (1 / 3))
    rows = [line.split("|")[1].split("  ") for line in record["tableau"] if "+-" not in line]
    values = [[_value(cell) for cell in row if cell.strip()] for row in rows]
    expected = [[g / 2, 0, 0], [g, middle / 2, 0], [g, middle, g / 2], [g, middle, g]]
    assert values == [pytest.approx(row, rel=1e-14) for row in expected]


def _value(text: str) -> float:
    number: float = eval(text.replace("^", "**"))
    return number


def test_the_numbers_of_table_three_two_c() -> None:
    (record,) = json.loads(run("vcg:yoshida6", "--json").output)
    assert record["order"] == 6
    printed = [0.78451361047755726381949763, 0.23557321335935813368479318, -1.17767998417887100694641568]
    printed += [1.31518632068391121888424973]
    weights = [float(x.rstrip("~")) for x in record["tableau"][-1].split("|")[1].split()]
    assert weights == pytest.approx([*printed, *printed[2::-1]], rel=1e-15)


def test_a_method_can_be_a_file(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    path.write_text(
        '{"name": "mine", "family": "rk", "A": [["1/2"]], "b": ["1"], "order": 2}', encoding="utf-8"
    )
    for label in ("rk", "vcg"):
        (record,) = json.loads(run(f"{label}:{path}", "--json").output)
        assert (record["method"], record["order"]) == (f"{label}:{path}", 2)
    (record,) = json.loads(run(str(path), "--json").output)
    assert record["method"] == f"rk:{path}"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("strang",), "a tableau of format splitting cannot be converted to a Runge-Kutta method"),
        (("foo:rk4",), "unknown family 'foo'"),
        (("rk5000",), "no tableau 'rk5000'"),
        (("rk4", "--write", "x.md"), "--write and --check concern the whole library"),
    ],
)
def test_methods_without_a_butcher_tableau_are_refused(arguments: tuple[str, ...], message: str) -> None:
    answer = run(*arguments)
    assert answer.exit_code == 2
    assert message in answer.output
