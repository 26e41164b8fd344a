"""Claims in every format, and bad input: each gives one message that names the place."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from orderconds.checking import check
from orderconds.cli import program
from orderconds.errors import InputError
from orderconds.exchange.claim_text import claims_from


def archive(**arrays: object) -> bytes:
    content = BytesIO()
    np.savez(content, **arrays)  # type: ignore[arg-type]
    return content.getvalue()


A, B = [[0, 0], [1, 0]], [0.5, 0.5]
TOML = 'name = "h"\nfamily = "rk"\nA = [[], ["1"]]\nb = ["1/2", "1/2"]\n'

CLAIMS = {
    "key.toml": f"{TOML}order = 2\n".encode(),
    "table.toml": f"{TOML}[claims]\nrk = 2\n".encode(),
    "key.json": json.dumps({"A": A, "b": B, "order": 2}).encode(),
    "table.json": json.dumps({"A": A, "b": B, "claims": {"rk": 2, "explicit": True}}).encode(),
    "text.json": json.dumps({"A": A, "b": B, "claims": "rk=2"}).encode(),
    "key.csv": b"A,0,0\nA,1,0\nb,1/2,1/2\norder,2\n",
    "text.csv": b"claims,rk=2,explicit=true\nA,0,0\nA,1,0\nb,1/2,1/2\n",
    "plain.csv": b"0,,\n1,1,\n,1/2,1/2\nclaims,rk=2\n",
    "key.npz": archive(A=A, b=B, order=2),
    "text.npz": archive(A=A, b=B, claims="rk=2, explicit=true"),
    "key.py": b"A = [[0, 0], [1, 0]]\nb = [1/2, 1/2]\norder = 2\n",
    "table.py": b"A = [[0, 0], [1, 0]]\nb = [1/2, 1/2]\nclaims = {'rk': 2}\n",
    "text.tex": rb"% claims: rk=2"
    + b"\n"
    + rb"\begin{array}{c|cc} 0 & & \\ 1 & 1 & \\ \hline & 1/2 & 1/2 \end{array}",
    "text.c": b"/* claims: rk=2 */\ndouble h_A[2][2] = {{0, 0}, {1, 0}}; double h_b[2] = {0.5, 0.5};\n",
}


@pytest.mark.parametrize("name", CLAIMS)
def test_a_claim_holds_if_the_order_is_right_and_fails_if_not(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(CLAIMS[name])
    report = check(path)
    assert report.verdict == "holds"
    assert [(f.family, f.claimed, f.certificate) for f in report.orders] == [("rk", 2, "exact")]
    wrong = CLAIMS[name]
    if name == "key.npz":
        wrong = archive(A=A, b=B, order=3)
    elif name == "text.npz":
        wrong = archive(A=A, b=B, claims="rk=3")
    else:
        for claim in (b"order = 2", b"rk = 2", b'"order": 2', b'"rk": 2', b"rk=2", b"order,2", b"'rk': 2"):
            wrong = wrong.replace(claim, claim[:-1] + b"3")
    path.write_bytes(wrong)
    assert check(path).verdict == "fails"


@pytest.mark.parametrize("text", ["", "rk", "rk=", "rk=x", "rk=4 cg=3", "rk=4,rk=4", "{", "[4]", "4"])
def test_a_text_that_states_no_claim_is_refused(text: str) -> None:
    with pytest.raises(InputError, match=r"where: .*; expected"):
        claims_from(text, "where")


BAD = {
    "ragged.npz": (None, "the array A contains pickled Python objects"),
    "complex.npz": (archive(A=np.zeros((1, 1), complex), b=[1.0]), "A contains complex numbers"),
    "single.npz": (archive(A=np.zeros((1, 1), np.float32), b=[1.0]), "floats with 32 bits"),
    "text.npz": (archive(A=np.array([["x"]]), b=[1.0]), "the array A has the NumPy kind 'U'"),
    "nan.npz": (archive(A=[[np.nan]], b=[1.0]), "nan.npz: A: the number nan; expected a finite number"),
    "cube.npz": (archive(A=np.zeros((1, 1, 1)), b=[1.0]), "3 axes"),
    "ragged.json": (b'{"A": [[0.5], [1, 2, 3]], "b": [1, 0]}', "A[2]: 3 entries; expected at most 2"),
    "short.json": (b'{"A": [[0.5]], "b": [1, 0]}', "A has 1 rows, b has 2 entries"),
    "nan.json": (b'{"A": [[NaN]], "b": [1]}', "the number NaN"),
    "word.json": (b'{"A": [["x y"]], "b": [1]}', "A[1][1]"),
    "word.csv": (b"A,one\nb,1\n", "the name 'one'"),
    "family.csv": (
        b"A,0\nb,1\nclaims,magnus=2\n",
        "claims.magnus: the tableau claims an order in family magnus, but this family does not accept",
    ),
    "unknown.csv": (b"A,0\nb,1\nclaims,rkk=2\n", "claims.rkk"),
    "twice.csv": (b"A,0\nb,1\norder,1\nclaims,rk=1\n", "two claims for rk"),
    "zero.json": (b'{"A": [[0]], "b": [1], "order": 0}', "order"),
    "real.json": (b'{"A": [[0]], "b": [1], "order": 1.5}', "order"),
    "huge.json": (b'{"A": [[1e9999]], "b": [1]}', "A[1][1]"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_gives_one_message_and_exit_status_2(name: str, tmp_path: Path) -> None:
    content, message = BAD[name]
    if content is None:
        rows = np.empty(2, dtype=object)
        rows[:] = [[], [1.0]]
        content = archive(A=rows, b=[0.5, 0.5])
    (tmp_path / name).write_bytes(content)
    result = CliRunner().invoke(program, ["check", str(tmp_path)])
    assert result.exit_code == 2, result.output
    assert message in result.stderr
    assert name in result.stderr
    assert result.stderr.count("\n") == 1
    assert result.stdout == ""


def test_a_folder_without_tableaux_names_the_formats(tmp_path: Path) -> None:
    (tmp_path / "notes.md").write_text("notes")
    (tmp_path / "package.json").write_text('{"version": 1}')
    result = CliRunner().invoke(program, ["check", str(tmp_path)])
    assert result.exit_code == 2
    assert (
        "no tableau below this directory; expected files *.toml, *.json, *.csv, *.npz, *.py" in result.stderr
    )
    assert "package.json: contains no key of a tableau" in result.stderr
    assert "notes.md" in result.stderr


@pytest.mark.parametrize("name", ["key.json", "plain.csv", "key.py", "key.toml"])
def test_a_check_of_a_file_of_text_imports_neither_numpy_nor_sympy(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(CLAIMS[name].replace(b"0.5", b"0.3333333333333333"))
    code = (
        "import sys; from orderconds.cli import main\n"
        "try: main()\nfinally: print(sorted({'numpy', 'sympy'} & set(sys.modules)))"
    )
    result = subprocess.run(
        [sys.executable, "-c", code, "check", str(tmp_path / name)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])},
    )
    assert result.stdout.endswith("[]\n"), result.stdout + result.stderr
