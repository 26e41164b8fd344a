"""``orderconds check``: verdicts, exit statuses, messages, and what it does not import."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program
from orderconds.exchange import export
from orderconds.tableau import Tableau, available, find
from orderconds.tableau.write import as_data

ROOT = Path(__file__).parents[3]

RK4 = """\
name = "{name}"
family = "rk"
A = [[], ["1/2"], ["0", "1/2"], ["0", "0", "1"]]
b = ["{b1}", "1/3", "1/3", "1/6"]
source = "Kutta 1901"
[claims]
rk = {claim}
"""


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["check", *args])


@pytest.fixture
def rk4(tmp_path: Path) -> Path:
    path = tmp_path / "rk4.toml"
    path.write_text(RK4.format(name="rk4", b1="1/6", claim=4))
    return path


def test_an_exact_file_holds_with_status_0_and_says_certificate_exact(rk4: Path) -> None:
    result = run(str(rk4))
    assert (result.exit_code, result.stderr) == (0, "")
    assert "certificate: exact" in result.stdout
    assert "rk4: holds" in result.stdout


def test_an_entry_off_by_5e_minus_11_exits_1_and_names_the_condition_with_its_residual(rk4: Path) -> None:
    rk4.write_text(RK4.format(name="rk4", b1="0.16666666671666666666", claim=4))
    result = run(str(rk4))
    assert result.exit_code == 1
    assert "sum_i b_i = 1" in result.stdout
    assert "residual" in result.stdout
    assert "e-11" in result.stdout


def test_json_is_a_list_with_one_record_a_tableau_and_nothing_else(rk4: Path) -> None:
    result = run(str(rk4), "--json")
    (record,) = json.loads(result.stdout)
    told = [record[key] for key in ("name", "file", "format", "verdict")]
    assert told == ["rk4", str(rk4), "rk", "holds"]
    assert record["orders"]["rk"]["certificate"] == "exact"
    assert record["properties"]["explicit"] is True


def test_a_library_name_is_checked_as_its_file_is() -> None:
    result = run("rk4", "--family", "rk", "--json")
    (record,) = json.loads(result.stdout)
    assert record["orders"]["rk"]["order"] == 4


def test_a_directory_is_searched_to_the_bottom_in_sorted_order(tmp_path: Path) -> None:
    for name in ("b", "a/z", "a/y"):
        path = tmp_path / f"{name}.toml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(RK4.format(name=path.stem, b1="1/6", claim=4))
    names = [record["name"] for record in json.loads(run(str(tmp_path), "--json").stdout)]
    assert names == ["y", "z", "b"]


def test_a_file_that_cannot_be_read_does_not_stop_the_others_but_exits_2(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text("A = [[")
    (tmp_path / "b.toml").write_text(RK4.format(name="b", b1="1/6", claim=4))
    result = run(str(tmp_path), "--json")
    assert result.exit_code == 2
    assert [record["name"] for record in json.loads(result.stdout)] == ["b"]
    assert result.stderr.count("\n") == 1
    assert "a.toml" in result.stderr


def test_failing_claims_exit_1_and_unreadable_files_take_precedence(tmp_path: Path, rk4: Path) -> None:
    rk4.write_text(RK4.format(name="rk4", b1="1/6", claim=5))
    assert run(str(rk4)).exit_code == 1
    assert run(str(rk4), str(tmp_path / "missing.toml")).exit_code == 2


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("A = [[", "bad.toml"),
        ("", "bad.toml"),
        (RK4.format(name="x", b1="1/6", claim=4).replace("source", "sauce"), "sauce"),
        (RK4.format(name="x", b1="1/6", claim=4).replace('["0", "1/2"]', '["0", "1/2", "0", "0", "7"]'), "A"),
        (RK4.format(name="x", b1="nan", claim=4), "nan"),
        (RK4.format(name="x", b1="__import__('os')", claim=4), "b"),
        (RK4.format(name="x", b1="1/0", claim=4), "b"),
        (RK4.format(name="x", b1="9^9^9^9", claim=4), "b"),
        (RK4.format(name="x", b1="1/6", claim=4) + "rkk = 4\n", "rkk"),
        (RK4.format(name="x", b1="1/6", claim=4) + "rk = 4\n", "bad.toml"),
        (RK4.format(name="x", b1="1/6", claim=4).replace('"1/3", "1/3"', '"0", "2/3"') + "sprk = 4\n", "b_2"),
        ("\x00\xff", "bad.toml"),
    ],
)
def test_bad_input_exits_2_with_one_message_that_names_the_place(
    tmp_path: Path, text: str, said: str
) -> None:
    path = tmp_path / "bad.toml"
    path.write_text(text, encoding="latin-1")
    result = run(str(path))
    assert result.exit_code == 2
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    assert said in result.stderr
    assert "bad.toml" in result.stderr
    assert result.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["no_such_file.toml"], "no_such_file.toml"),
        ([""], "the argument '' is empty"),
        (["rk44"], "rk4"),
        (["rk4", "--family", "vgc"], "vcg"),
        (["rk4", "--family", "rk(2)"], "rk"),
        (["rk4", "--order", "zero"], "--order"),
        (["rk4", "--ordr", "3"], "--order"),
        ([], "check"),
        (["EMPTY"], "EMPTY"),
    ],
)
def test_bad_usage_exits_2_with_one_message(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, args: list[str], said: str
) -> None:
    (tmp_path / "EMPTY").mkdir()
    monkeypatch.chdir(tmp_path)
    result = run(*args)
    assert result.exit_code == 2
    assert isinstance(result.exception, SystemExit)
    assert result.stdout == ""
    assert said in result.stderr
    assert result.stderr.count("\n") == 1


def test_check_imports_no_heavy_package(rk4: Path) -> None:
    code = (
        "import sys\nfrom orderconds.cli import program\n"
        f"try: program.main(['check', {str(rk4)!r}, 'cg3', 'cf4', 'cg4a', 'triple_jump'])\n"
        "except SystemExit as end: assert end.code == 0, end.code\n"
        "heavy = {'sympy', 'networkx', 'numpy', 'scipy', 'matplotlib', 'rich', 'jinja2', 'cffi', 'codegen'}\n"
        "print(sorted(heavy & set(sys.modules)), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stderr.strip() == "[]"


def test_output_does_not_depend_on_the_hash_seed(rk4: Path) -> None:
    def output(seed: str) -> str:
        command = [sys.executable, "-m", "orderconds", "check", str(rk4), "gauss2", "--json"]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        return subprocess.check_output(command, text=True, cwd=ROOT, env=environment)

    assert output("1") == output("4242")


@pytest.mark.slow  # `make gate` checks the library in every run of continuous integration
def test_every_tableau_of_the_library_meets_its_claims() -> None:
    result = run(str(ROOT / "tableaux"))
    assert result.exit_code == 0, result.stdout + result.stderr
    names = [line.partition(":")[0] for line in result.stdout.splitlines() if ": holds" in line]
    assert sorted(names) == list(available())
    assert result.stdout.endswith(f"\n{len(names)} tableaux: {len(names)} holds\n")


def test_coefficients_of_thousands_of_digits_are_checked_and_json_stays_json(tmp_path: Path) -> None:
    """Python spells no integer above 4300 digits, and JSON has no infinity."""
    path = tmp_path / "huge.toml"
    huge = "*".join(["(2^64)^64"] * 6)
    path.write_text(f'name = "huge"\nfamily = "rk"\nA = [[], ["{huge}"]]\nb = ["0", "1"]\n')
    text = run(str(path))
    assert text.exit_code == 0, text.output
    assert "e+7398" in text.stdout
    assert max(map(len, text.stdout.splitlines())) < 300

    def refuse(constant: str) -> None:
        raise AssertionError(f"{constant} is no JSON")

    (record,) = json.loads(run("--json", str(path)).stdout, parse_constant=refuse)
    assert record["orders"]["rk"]["error_norm"] is None
    assert len(record["orders"]["rk"]["failing"][0]["residual"]) > 7000


def test_other_toml_files_of_a_folder_are_left_alone_unless_named(tmp_path: Path) -> None:
    (tmp_path / "euler.toml").write_text(
        'name = "euler"\nfamily = "rk"\nA = [[]]\nb = [1]\n', encoding="utf-8"
    )
    other = tmp_path / "pyproject.toml"
    other.write_text('[project]\nname = "x"\n', encoding="utf-8")
    assert run(str(tmp_path)).exit_code == 0
    assert run(str(other)).exit_code == 2
    (tmp_path / "euler.toml").unlink()
    assert "no tableau below this directory" in run(str(tmp_path)).output


def test_files_of_other_formats_are_checked_as_they_are(tmp_path: Path) -> None:
    plain = tmp_path / "my method.csv"
    plain.write_text("0,0,0\n2/3,2/3,0\n,1/4,3/4\n", encoding="utf-8")
    result = run(str(plain), "--family", "cg")
    assert (result.exit_code, result.stderr) == (0, "")
    assert "my_method: order 2; nothing claimed" in result.stdout
    for of, suffix in (("latex", "tex"), ("numpy", "npz"), ("c", "h"), ("json", "json"), ("sympy", "py")):
        path = tmp_path / f"x.{suffix}"
        path.write_bytes(export(as_data(Tableau.load(find("cf43"))), of))
        assert run(str(path)).exit_code == 0
    assert "no such file" in run("missing.csv").stderr


def test_one_exponential_and_one_bracket_are_told_in_the_singular() -> None:
    told = run("magnus4").stdout
    assert "cost of a step: 2 evaluations; magnus: 1 exponential and 1 bracket\n" in told


def test_a_file_without_end_is_refused() -> None:
    for arguments in (["check", "/dev/zero"], ["convert", "/dev/zero", "--from", "csv"]):
        result = CliRunner().invoke(program, arguments)
        assert result.exit_code == 2
        assert "/dev/zero: not a regular file" in result.output
