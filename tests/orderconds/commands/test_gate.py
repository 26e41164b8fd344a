"""The gate: the command line, pytest and the GitHub Action judge twenty correct tableaux in six formats, and
four wrong ones, rightly."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import yaml
from click.testing import CliRunner

from orderconds import Tableau
from orderconds.cli import program
from orderconds.exchange import export
from orderconds.tableau import find
from orderconds.tableau.write import as_data

ROOT = Path(__file__).parents[3]
ACTION = ROOT / ".github/actions/check/action.yml"

ORDERS = {
    "rk4": 4,
    "kutta3": 3,
    "gauss2": 4,
    "gauss3": 6,
    "dormand_prince5": 5,
    "alexander2": 2,
    "butcher5": 5,
}

Arrays = tuple[list[list[float]], list[float]]


def arrays(name: str) -> Arrays:
    """Return A and b in double precision."""
    tableau = Tableau.load(find(name))
    near = tableau.ring.nearest_float  # type: ignore[attr-defined]
    method = tableau.abelian()
    return [[near(x) for x in row] for row in method.A], [near(x) for x in method.b]


def as_json(name: str, arrays: Arrays, order: int | None) -> bytes:
    claim = {} if order is None else {"order": order}
    return json.dumps({"A": arrays[0], "b": arrays[1], **claim}).encode()


def as_csv(name: str, arrays: Arrays, order: int | None) -> bytes:
    A, b = arrays
    c = [repr(float(sum(map(Fraction, row)))) for row in A]
    rows = [",".join([node, *map(repr, row)]) for node, row in zip(c, A, strict=True)]
    claim = [] if order is None else [f"claims,rk={order}"]
    return "\n".join([*rows, ",".join(["", *map(repr, b)]), *claim, ""]).encode()


def as_python(name: str, arrays: Arrays, order: int | None) -> bytes:
    A, b = arrays
    claim = "" if order is None else f"order = {order}\n"
    return f"import numpy as np\n\nA = np.array({A!r})\nb = np.array({b!r})\n{claim}".encode()


def as_archive(name: str, arrays: Arrays, order: int | None) -> bytes:
    from io import BytesIO

    content = BytesIO()
    claim = {} if order is None else {"claims": np.array(f"rk={order}")}
    np.savez(content, A=np.array(arrays[0]), b=np.array(arrays[1]), **claim)
    return content.getvalue()


Writer = Callable[[str, Arrays, "int | None"], bytes]
WRITERS: dict[str, Writer] = {".json": as_json, ".csv": as_csv, ".py": as_python, ".npz": as_archive}


def with_typo(arrays: Arrays) -> Arrays:
    A, b = arrays
    return A, [b[0], b[1] + 1e-10, *b[2:]]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write twenty correct tableaux, four wrong ones, and files that are none."""
    place = tmp_path_factory.mktemp("gate")
    correct = [(name, ".toml") for name in ("kutta3", "cg3", "gauss2")]
    correct += [(name, ".c") for name in ("rk4", "cf4")]
    for name, suffix in correct:
        of = {".toml": "toml", ".c": "c"}[suffix]
        (place / f"{name}{suffix}").write_bytes(export(as_data(Tableau.load(find(name))), of))
    drawn = {
        ".json": ("rk4", "gauss2", "dormand_prince5", "kutta3"),
        ".csv": ("rk4", "gauss3", "alexander2", "kutta3"),
        ".py": ("rk4", "gauss2", "butcher5"),
        ".npz": ("rk4", "gauss3", "dormand_prince5", "alexander2"),
    }
    for suffix, names in drawn.items():
        for name in names:
            (place / f"{name}{suffix}").write_bytes(WRITERS[suffix](name, arrays(name), ORDERS[name]))
    assert len(list(place.iterdir())) == 20
    rk4 = arrays("rk4")
    (place / "wrong_typo.csv").write_bytes(as_csv("", with_typo(rk4), None))
    (place / "wrong_typo.npz").write_bytes(as_archive("", with_typo(rk4), 4))
    (place / "wrong_claim.json").write_bytes(as_json("", arrays("gauss2"), 5))
    (place / "wrong_rows.py").write_bytes(as_python("", (rk4[0][::-1], rk4[1]), 4))
    (place / "results.csv").write_text("time,error\n1,0.5\n")
    (place / "pyproject.toml").write_text("[project]\n")
    (place / "notes.md").write_text("notes\n")
    return place


def test_the_command_line_judges_every_file_rightly(folder: Path) -> None:
    result = CliRunner().invoke(program, ["check", "--require-claims", "--json", str(folder)])
    assert result.exit_code == 1
    verdicts = {Path(record["file"]).name: record["verdict"] for record in json.loads(result.stdout)}
    wrong = {name: verdict for name, verdict in verdicts.items() if name.startswith("wrong")}
    assert wrong == {
        "wrong_typo.csv": "unclaimed",
        "wrong_typo.npz": "fails",
        "wrong_claim.json": "fails",
        "wrong_rows.py": "fails",
    }
    correct = [verdict for name, verdict in verdicts.items() if name not in wrong]
    assert correct == ["holds"] * 20
    for name in (
        "results.csv: no row begins with",
        "pyproject.toml: contains no key of a tableau",
        "notes.md",
    ):
        assert name in result.stderr


def test_the_right_files_alone_pass(folder: Path) -> None:
    right = sorted(str(path) for path in folder.iterdir() if not path.name.startswith("wrong"))
    result = CliRunner().invoke(program, ["check", "--require-claims", "--skip-others", *right])
    assert result.exit_code == 0, result.output
    assert result.stdout.endswith("20 tableaux: 20 holds\n")


def run(command: list[str], folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a command, with ``orderconds`` and ``python`` of this environment first on the path."""
    place = folder.parent / "bin"
    place.mkdir(exist_ok=True)
    for name, arguments in {"orderconds": "-m orderconds ", "python": ""}.items():
        (place / name).write_text(f'#!/bin/sh\nexec {sys.executable} {arguments}"$@"\n')
        (place / name).chmod(0o755)
    hidden = ("PYTEST_ADDOPTS", "PYTEST_XDIST_WORKER", "PYTEST_XDIST_WORKER_COUNT")
    kept = {name: text for name, text in os.environ.items() if name not in hidden}
    environment = {**kept, "PATH": f"{place}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT), **variables}
    return subprocess.run(
        command, env=environment, cwd=folder, capture_output=True, text=True, check=False, timeout=100
    )


def test_pytest_judges_every_file_rightly(folder: Path) -> None:
    plugins = ["-p", "orderconds.pytest_plugin", "-p", "no:cacheprovider", "-p", "no:xdist"]
    command = ["python", "-m", "pytest", *plugins, "-q", "-rs", "--rootdir", ".", "-c", os.devnull, "."]
    result = run([*command, "--orderconds"], folder)
    assert result.returncode == 1
    assert "3 failed, 20 passed, 1 skipped" in result.stdout
    assert "order 0; nothing claimed" in result.stdout
    assert "results.csv: no row begins with the name of an array" in result.stdout


def test_pytest_fails_for_a_file_that_may_be_a_tableau(tmp_path: Path) -> None:
    place = tmp_path / "tableaux"
    place.mkdir()
    (place / "semicolons.csv").write_text(HEUN + "order;2\n")
    (place / "small_a.json").write_text('{"a": [[0]], "B": [1]}')
    plugins = ["-p", "orderconds.pytest_plugin", "-p", "no:cacheprovider", "-p", "no:xdist"]
    command = ["python", "-m", "pytest", *plugins, "-q", "--rootdir", ".", "-c", os.devnull, "."]
    assert run([*command, "--orderconds"], place).returncode == 0
    result = run([*command, "--orderconds-require-claims"], place)
    assert result.returncode == 1
    assert "1 failed, 1 passed" in result.stdout


def test_the_action_judges_every_file_rightly(folder: Path) -> None:
    action = yaml.safe_load(ACTION.read_text(encoding="utf-8"))
    *_, step = action["runs"]["steps"]
    values = {name: entry["default"] for name, entry in action["inputs"].items()}
    variables = {
        name: values[text.removeprefix("${{ inputs.").removesuffix(" }}")]
        for name, text in step["env"].items()
    }
    assert variables == {"ARGUMENTS": "--require-claims", "PATHS": "."}
    result = run(["bash", "-e", "-c", step["run"]], folder, **variables)
    assert result.returncode == 1
    assert "24 tableaux: 20 holds, 3 fails, 1 unclaimed\n" in result.stdout


HEUN = "c;a1;a2\n0;0;0\n1;1;0\n;1/2;1/2\n"
DOUBTFUL = {
    "semicolons.csv": HEUN,
    "tabs.csv": HEUN.replace(";", "\t") + "order\t3\n",
    "numbers.csv": "0,0,0\n1,1,0\n1/2,1/2,0\n",
    "blanks.csv": "0 0\n 1\n",
    "other_names.json": '{"butcher": [[0, 0], [1, 0]], "weights": [0.5, 0.5]}',
    "rows.json": "[[0, 0], [1, 0]]",
    "small_a.py": "a = [[0, 0], [1, 0]]\nweights = [1/2, 1/2]\n",
    "without_b.py": "A = [[0, 0], [1, 0]]\n",
    "damaged.py": "A = [[0, 0], [1, 0]\nb = [1/2, 1/2]\n",
    "computed.py": "from mine import F\nA = [[0, 0], [F(1, 2), 0]]\nb = [0, 1]\norder = 2\n",
}
OTHER = {
    "results.csv": "time,error\n1,0.5\n",
    "indexed.csv": "run;error\n;0.5\n",
    "empty.csv": "",
    "package.json": '{"name": "x", "version": "1"}',
    "names.json": '["x"]',
    "script.py": "import sys\n\nprint(sys.argv)\n",
    "setup.toml": "[tool]\n",
}


def judged(place: Path, *flags: str) -> int:
    (place / "euler.toml").write_text('name = "euler"\nfamily = "rk"\nA = [[]]\nb = ["1"]\norder = 1\n')
    return CliRunner().invoke(program, ["check", *flags, str(place)]).exit_code


@pytest.mark.parametrize("name", DOUBTFUL)
def test_a_file_that_may_be_a_tableau_never_passes_the_gate(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(DOUBTFUL[name])
    assert judged(tmp_path, "--require-claims") != 0
    (tmp_path / name).unlink()
    assert judged(tmp_path, "--require-claims") == 0


@pytest.mark.parametrize("name", OTHER)
def test_other_data_beside_tableaux_pass_the_gate(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(OTHER[name])
    assert judged(tmp_path, "--require-claims") == 0


def test_an_archive_without_names_never_passes_the_gate(tmp_path: Path) -> None:
    np.savez(tmp_path / "unnamed.npz", np.zeros((2, 2)), np.array([0.5, 0.5]))
    assert judged(tmp_path) == 0
    assert judged(tmp_path, "--require-claims") == 2


def test_without_claims_nothing_holds(tmp_path: Path) -> None:
    for suffix, write in WRITERS.items():
        (tmp_path / f"rk4{suffix}").write_bytes(write("rk4", arrays("rk4"), None))
    (tmp_path / "euler.toml").write_text('name = "euler"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n')
    (tmp_path / "heun.tex").write_text(
        r"\begin{array}{c|cc} 0 & & \\ 1 & 1 & \\ \hline & 1/2 & 1/2 \end{array}"
    )
    result = CliRunner().invoke(program, ["check", str(tmp_path)])
    assert result.exit_code == 0
    assert "holds" not in result.stdout
    assert result.stdout.count("; nothing claimed") == 6
    assert (
        "order 4 to double precision (largest residual 5.6e-17), not proved; nothing claimed" in result.stdout
    )
    assert CliRunner().invoke(program, ["check", "--require-claims", str(tmp_path)]).exit_code == 1


EXAMPLE = ROOT / "examples/ci"


def test_the_example_repository_passes_its_own_checks() -> None:
    workflow = yaml.safe_load((EXAMPLE / ".github/workflows/tableaux.yml").read_text(encoding="utf-8"))
    paths = workflow["jobs"]["orders"]["steps"][-1]["with"]["paths"]
    result = CliRunner().invoke(program, ["check", "--require-claims", str(EXAMPLE / paths)])
    assert result.exit_code == 0, result.output
    assert result.stdout.endswith("5 tableaux: 5 holds\n")


def test_the_hook_checks_changed_tableaux_and_skips_other_files(tmp_path: Path) -> None:
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    configured = yaml.safe_load((EXAMPLE / ".pre-commit-config.yaml").read_text(encoding="utf-8"))
    assert configured["repos"][0]["hooks"][0]["id"] == hook["id"]
    program_name, *words = hook["entry"].split()
    assert program_name == "orderconds"
    files = [str(path) for path in sorted((EXAMPLE / "tableaux").iterdir())]
    others = [str(ROOT / "pyproject.toml"), str(ROOT / "tests/conftest.py")]
    runner = CliRunner()
    assert runner.invoke(program, [*words, *files, *others]).exit_code == 0
    assert runner.invoke(program, [*words, *others]).exit_code == 0
    (tmp_path / "silent.csv").write_text("A,0\nb,1\n")
    assert runner.invoke(program, [*words, *files, str(tmp_path / "silent.csv")]).exit_code == 1
