"""Hostile files: no text leaves its comment, no comment is read as an array, no small file takes long."""

from __future__ import annotations

import ast
import io
import json
import re
from contextlib import suppress
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from orderconds.errors import InputError
from orderconds.exchange import FORMATS, export, load_foreign, read_data
from orderconds.exchange.arrays import from_arrays
from orderconds.proof.krawczyk import NotProved
from orderconds.proof.refine import refine
from orderconds.tableau import find
from orderconds.tableau.file import text_of
from orderconds.tableau.record import from_data, loads

HEUN = {
    "name": "heun",
    "family": "rk",
    "A": [["0", "0"], ["1", "0"]],
    "b": ["1/2", "1/2"],
    "embedded": {"b": ["1", "0"], "order": 1},
}
TEXTS = [
    "x\nimport os; os.system('touch x')\n#",
    "x */ int main(void) { } /* y",
    "\\begin{array}{c|c} 0 & 1 \\\\ \\hline & 1 \\end{array}",
    "double t_embedded_b[2] = {1, 0};",
    "A = Matrix([[1, 0], [0, 1]])",
    "back\\slash and \\u000a and \\n",
    "tail \\",
    "quotes \" and ' and %, #, //",
]


@pytest.mark.parametrize("to", sorted(FORMATS))
@pytest.mark.parametrize("text", TEXTS)
def test_texts_stay_in_their_comments_and_read_back(to: str, text: str) -> None:
    data = HEUN | {"source": text}
    content = export(data, to)
    back = read_data(content, to, "back")
    assert back["source"] == text
    assert from_data(back).method == from_data(data).method
    if to == "sympy":
        statements = ast.parse(content.decode()).body
        assert all(isinstance(s, ast.ImportFrom | ast.Assign) for s in statements)


def test_a_comment_in_c_is_no_array() -> None:
    code = b"/* double t_embedded_b[2] = {1, 0}; */\n// double t_c[2] = {1, 1};\n"
    code += b"double t_A[2][2] = {{0, 0}, {1, 0}}; double t_b[2] = {0.5 /* 1/2 */, 0.5};\n"
    data = read_data(code, "c", "t.c")
    assert sorted(data) == ["A", "b", "family", "name"]
    assert data["b"] == ["1/2", "0.5"]


def test_a_comment_in_latex_and_python_is_no_array() -> None:
    latex = b"% A = \\begin{pmatrix} 1 \\end{pmatrix}\nA = \\begin{pmatrix} 1/2 \\end{pmatrix}\n"
    latex += b"b = \\begin{pmatrix} 1 \\end{pmatrix}"
    assert read_data(latex, "latex", "t.tex")["A"] == [["1/2"]]
    python = b"# b = [2]\nA = [[0.5]]\nb = [1]  # c = [3]\n"
    assert sorted(read_data(python, "sympy", "t.py")) == ["A", "b", "family", "name"]


@pytest.mark.parametrize(
    ("of", "content"),
    [
        ("latex", b"A" * 80_000),
        ("latex", b"A = \\begin{pmatrix}" * 5000),
        ("latex", b"\\begin{array}{c|c}" * 5000),
        ("sympy", b"A = [" * 40_000),
        ("sympy", b"A = [\n" * 40_000),
        ("c", b"/* " * 100_000),
        ("c", b"a" * 300_000),
        ("c", b"a[" * 100_000),
        ("c", b"a[1] = " * 50_000),
        ("toml", b"a." * 30_000 + b"a = 1"),
        ("toml", b'"a".' * 30_000 + b"a = 1"),
        ("json", b"[" * 100_000),
        ("csv", b'"' * 100_000),
    ],
)
def test_small_hostile_files_are_refused(of: str, content: bytes) -> None:
    with pytest.raises(InputError):
        read_data(content, of, "hostile")


@pytest.mark.parametrize("value", [(1, 2), 0.5, date(2000, 1, 1), ["1"], {"a": "1"}, None, True, 7])
@pytest.mark.parametrize(
    "key", ["name", "source", "bibtex", "family", "b", "A", "embedded", "numbers", "claims"]
)
def test_a_value_of_another_type_is_a_message(key: str, value: Any) -> None:
    with suppress(InputError):
        from_data(HEUN | {key: value})
    with suppress(InputError):
        from_arrays(dict(HEUN) | {key: value}, "arrays")


def archive(**members: Any) -> bytes:
    content = io.BytesIO()
    np.savez(content, **members)
    return content.getvalue()


@pytest.mark.parametrize(
    "members",
    [
        {"A": np.zeros((1, 1)), "b": np.ones(1), "b_exact": np.ones(1)},
        {"A": np.zeros((1, 1)), "b": np.ones(1), "b_exact": np.array([["1"]])},
        {"exponentials": np.ones((1, 1)), "count": np.ones((1, 1)), "start": np.ones(1)},
        {"A": np.zeros(1), "b": np.ones((1, 1))},
        {"A": np.zeros((1, 1)), "b": np.array(["1"])},
        {"family": np.array(["rk", "rk"]), "A": np.zeros((1, 1)), "b": np.ones(1)},
    ],
)
def test_archives_of_other_shapes_are_refused(members: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        from_data(read_data(archive(**members), "numpy", "t.npz"))


def test_an_archive_with_a_member_that_is_no_array_is_refused() -> None:
    import zipfile

    content = io.BytesIO(archive(A=np.zeros((1, 1)), b=np.ones(1)))
    with zipfile.ZipFile(content, "a") as members:
        members.writestr("c", "text")
    with pytest.raises(InputError):
        read_data(content.getvalue(), "numpy", "t.npz")


@pytest.mark.parametrize("character", ["\u202e", "\u2066", "\u200f", "\x00", "\r", "\u2028", "\x1b"])
def test_control_characters_in_sources_are_refused(character: str) -> None:
    with pytest.raises(InputError, match="control character"):
        from_data(HEUN | {"source": f"a{character}b"})


@pytest.mark.parametrize("name", ["lambda", "Matrix", "A", "match"])
def test_names_that_python_uses_are_renamed(name: str) -> None:
    root = {"minpoly": ["-2", "0", "0", "1"], "near": "1.26"}
    data = {"name": "t", "family": "rk", "A": [[f"{name}/2"]], "b": ["1"], "numbers": {name: root}}
    content = export(data, "sympy")
    ast.parse(content.decode())
    assert not re.search(rf"(?m)^{name} = CRootOf", content.decode())


@pytest.mark.parametrize("header", ["[proof]  # as printed", "[ proof ]", "  [proof]"])
def test_refine_reads_headers_as_toml_does(header: str) -> None:
    text = text_of(find("cg4a")).replace("[proof]", header, 1)
    assert loads(refine(text, digits=30).text).proof is not None


def test_refine_refuses_an_inline_proof_with_a_message() -> None:
    text = (
        'name = "m"\nfamily = "rk"\nproof = { conditions = "rk", order = 2 }\nA = [["a"]]\nb = ["1"]\n'
        'numbers = { a = "0.50~" }\n'
    )
    with pytest.raises(NotProved, match="inline table"):
        refine(text)


def test_json_embedded_of_another_type_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "m.json"
    path.write_text(json.dumps(HEUN | {"embedded": [1]}), encoding="utf-8")
    with pytest.raises(InputError):
        load_foreign(path)
