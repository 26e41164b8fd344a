"""What is written in another format reads back as the same method, exactly; what is malformed is refused."""

from __future__ import annotations

import json
import random
import tomllib
from contextlib import suppress
from dataclasses import replace
from datetime import timedelta
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
import sympy
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orderconds import Tableau
from orderconds.cli import program
from orderconds.errors import InputError, TableauError
from orderconds.exchange import FORMATS, export, read_data
from orderconds.exchange.notation import from_latex, from_python, to_latex, to_python
from orderconds.exchange.sympy_source import from_sympy, to_sympy
from orderconds.proof.certificate import certify
from orderconds.tableau import Claims, available, dumps, find
from orderconds.tableau.file import from_data
from orderconds.tableau.write import as_data

ARRAYS = [name for name in FORMATS if name not in ("toml", "json")]


def data_of(name: str) -> dict:
    return tomllib.loads(find(name).read_text(encoding="utf-8"))


def carries(name: str, of: str) -> bool:
    """Arrays hold no brackets and no named parts."""
    return of in ("toml", "json") or data_of(name)["family"] in ("rk", "prk", "composition", "cf")


def numbers(tableau: Tableau) -> list:
    found: list = []
    tableau.method.map(lambda x: found.append(x) or x)
    return found


@pytest.mark.parametrize("of", FORMATS)
def test_every_tableau_of_the_library_reads_back_the_same(of: str) -> None:
    for name in available():
        tableau = Tableau.load(find(name))
        data = as_data(tableau)
        if not carries(name, of):
            with pytest.raises(InputError, match="format json"):
                export(data, of)
            continue
        try:
            text = export(data, of)
        except TableauError:
            # Relations between coefficients, written out, may be longer than a coefficient may be.
            spelled_by_others = tableau.proof is not None and tableau.proof.reduction == "spelling"
            if not spelled_by_others:
                raise
            continue
        back = from_data(read_data(text, of, "back"))
        assert back.method == tableau.method, name
        assert back.embedded == tableau.embedded, name
        assert (back.name, back.family, back.source) == (tableau.name, tableau.family, tableau.source)
        assert back.claims == tableau.claims
        assert isinstance(back.ring, type(tableau.ring))


@pytest.mark.parametrize("of", ["toml", "json"])
def test_nothing_of_a_file_is_lost(of: str) -> None:
    for name in available():
        data = data_of(name)
        assert read_data(export(data, of), of, "back") == data
        assert read_data(export(as_data(Tableau.load(find(name))), of), of, "back") == data


def test_a_proof_survives_and_certifies_again() -> None:
    for name in ("carpenter_kennedy4", "cg4a", "yoshida6"):
        tableau = Tableau.load(find(name))
        proved, again = certify(tableau), certify(Tableau.loads(dumps(tableau)))
        assert (again.facts, again.equations, again.radius) == (proved.facts, proved.equations, proved.radius)


def test_a_method_changed_since_it_was_read_is_written_as_it_is() -> None:
    read = Tableau.load(find("cg4a"))
    changed = replace(read, method=read.method.map(lambda x: x + x), name="twice", source="none")
    again = Tableau.loads(dumps(changed))
    assert again.method != read.method
    assert (again.name, again.source, again.proof) == ("twice", "none", None)
    renamed = Tableau.loads(dumps(replace(read, name="renamed", claims=Claims())))
    assert (renamed.name, renamed.method, renamed.claims) == ("renamed", read.method, Claims())


def test_json_keeps_names_claims_and_proofs() -> None:
    data = data_of("cg4a")
    assert read_data(export(data, "json"), "json", "back") == data


@pytest.mark.parametrize("of", FORMATS)
def test_writing_twice_gives_the_same_bytes(of: str) -> None:
    data = as_data(Tableau.load(find("gauss2")))
    assert export(data, of) == export(data, of)


SPELLED = st.one_of(
    st.fractions(min_value=-9, max_value=9, max_denominator=40).map(str),
    st.sampled_from(
        [
            "sqrt(2)",
            "1/4 - sqrt(3)/6",
            "1/(2 - 2^(1/3))",
            "-sqrt(3)/6",
            "(1 + sqrt(5))^(1/3)",
            "2^(-1/3)",
            "3^(-2)",
            "-(1 - sqrt(2))*(3/4)/5",
            "0.125",
            "-0.333333~",
            "0.3333333333333333~",
            "1 - 2 - 3",
            "1/2/3",
            "2*(1/3)*sqrt(6)/4 - (-1)",
        ]
    ),
)


@settings(suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(SPELLED, min_size=2, max_size=2), st.sampled_from(ARRAYS))
def test_any_coefficient_reads_back_the_same(spelled: list[str], of: str) -> None:
    tableau = from_data({"name": "t", "family": "rk", "A": [[], [spelled[0]]], "b": spelled})
    data = {"name": "t", "family": "rk", "A": [["0", "0"], [spelled[0], "0"]], "b": spelled}
    back = from_data(read_data(export(data, of), of, "back"))
    assert back.method == tableau.method
    assert ["~" in x for x in as_data(back)["b"]] == ["~" in x for x in spelled]


@given(SPELLED)
def test_notations_translate_back_to_the_same_number(spelled: str) -> None:
    def weight(text: str) -> object:
        return from_data({"name": "t", "family": "rk", "A": [[]], "b": [text]}).method.b  # type: ignore[union-attr]

    assert weight(from_python(to_python(spelled))) == weight(spelled)
    assert weight(from_latex(to_latex(spelled))) == weight(spelled)
    if "~" not in spelled:
        names = {"Rational": sympy.Rational, "Integer": sympy.Integer, "sqrt": sympy.sqrt}
        value = eval(to_python(spelled), names)
        assert sympy.simplify(value - sympy.sympify(spelled.replace("^", "**"), rational=True)) == 0


def test_sympy_matrices_read_back_the_same() -> None:
    for name in ("gauss2", "rk4", "triple_jump"):
        tableau = Tableau.load(find(name))
        assert from_sympy(name, to_sympy(tableau)).method == tableau.method


def test_named_roots_are_sympys() -> None:
    matrices = to_sympy(Tableau.load(find("radau2a4")))
    assert matrices["A"].has(sympy.CRootOf)
    assert abs(float(sum(matrices["b"].evalf(30))) - 1) < 1e-15


def test_numbers_are_defined_before_they_are_used() -> None:
    numbers = {"x": "y + z", "y": "0.5~", "z": {"minpoly": [-2, 0, 1], "near": "1.4"}, "w": "x*y"}
    long = " + ".join(["w"] * 400)
    data = {"name": "t", "family": "rk", "A": [[]], "b": [long], "numbers": numbers}
    text = export(data, "sympy").decode()
    places = [text.index(f"\n{name} = ") for name in ("y", "z", "x", "w", "b")]
    assert places == sorted(places)
    assert from_data(read_data(text.encode(), "sympy", "x")).method == from_data(data).method


class TestForeignFiles:
    """As people have them."""

    def test_a_plain_butcher_table(self) -> None:
        text = "0,0,0\n1/2,1/2,0\n,0,1\n,1,0\n"
        data = read_data(text.encode(), "csv", "heun.csv")
        tableau = from_data(data)
        assert (
            tableau.method
            == Tableau.loads('name = "t"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\n').method
        )
        assert tableau.embedded is not None
        assert tableau.embedded.order == 1

    def test_the_order_of_embedded_weights_is_computed_where_a_table_states_none(self) -> None:
        source = Tableau.load(find("bogacki_shampine3"))
        lines = export(as_data(source), "csv").decode().splitlines()
        rows = [line.partition(",")[2] for line in lines if line.startswith("A,")]
        weights = [
            line.partition(",")[2] for key in ("b,", "embedded_b,") for line in lines if line.startswith(key)
        ]
        nodes = [source.ring.text(c) for c in source.abelian().c]
        plain = [f"{c},{row}" for c, row in zip(nodes, rows, strict=True)] + [f",{row}" for row in weights]
        data = read_data("\n".join(plain).encode(), "csv", "x.csv")
        assert data["embedded"]["order"] == 2
        assert from_data(data).embedded == source.embedded

    def test_a_plain_table_whose_nodes_are_not_row_sums_is_refused(self) -> None:
        with pytest.raises(InputError, match="c_2 = 1/3 beside a row of A that sums to 1/2"):
            from_data(read_data(b"0,0,0\n1/3,1/2,0\n,0,1\n", "csv", "x.csv"))

    def test_c_source_with_quotients_and_suffixes(self) -> None:
        text = (
            "/* somebody's */ const double rk_A[2][2] = {{0.0, 0.0}, {2.0/3.0, 0.0f}};\n"
            "double rk_b[] = { 0.25, 7.5e-1 }; // weights\n"
        )
        tableau = from_data(read_data(text.encode(), "c", "x.c", name="ralston"))
        assert (
            tableau.method
            == Tableau.loads('name = "t"\nfamily = "rk"\nA = [[], ["2/3"]]\nb = ["1/4", "3/4"]\n').method
        )

    def test_long_decimals_are_rounded_numbers(self) -> None:
        text = b"static double A[1][1] = {{0.5}}; static double b[1] = {0.3333333333333333};"
        tableau = from_data(read_data(text, "c", "x.c"))
        assert tableau.ring.text(tableau.method.b[0]) == "0.333333333333333~"  # type: ignore[union-attr]

    def test_floats_of_numpy(self, tmp_path: Path) -> None:
        np.savez(tmp_path / "x.npz", A=np.zeros((1, 1)), b=np.ones(1))
        data = read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz", name="euler")
        assert from_data(data).method == Tableau.load(find("euler")).method

    def test_an_archive_that_swells_is_refused_unread(self, tmp_path: Path) -> None:
        np.savez_compressed(tmp_path / "x.npz", A=np.zeros((2000, 2000)), b=np.ones(1))
        with pytest.raises(InputError, match="arrays of 32000"):
            read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz")

    def test_floats_that_are_not_what_is_spelled_beside_them_are_refused(self, tmp_path: Path) -> None:
        np.savez(tmp_path / "x.npz", A=np.zeros((1, 1)), b=np.ones(1), b_exact=np.array(["1/2"]))
        with pytest.raises(InputError, match="b that is not b_exact"):
            read_data((tmp_path / "x.npz").read_bytes(), "numpy", "x.npz")

    def test_latex_from_a_paper(self) -> None:
        text = r"""
        \begin{array}{c|cc}
          \frac12 - \frac{\sqrt{3}}{6} & \tfrac{1}{4} & \tfrac{1}{4} - \tfrac{\sqrt{3}}{6} \\[4pt]
          \frac12 + \frac{\sqrt{3}}{6} & \tfrac{1}{4} + \tfrac{\sqrt{3}}{6} & \tfrac{1}{4} \\ \hline
          & \frac{1}{2} & \frac{1}{2}
        \end{array}"""
        tableau = from_data(read_data(text.encode(), "latex", "x.tex"))
        assert tableau.method.b == Tableau.load(find("gauss2")).method.b  # type: ignore[union-attr]
        assert tableau.method == Tableau.load(find("gauss2")).method

    def test_blank_cells_of_a_printed_tableau_are_zeros(self) -> None:
        printed = r"""
        \begin{array}{l | l l l l}
          0 & & & & \\ 1/2 & 1/2 & & & \\ 1/2 & & 1/2 & & \\ 1 & & & 1 & \\
          \hline & 1/6 & 1/3 & 1/3 & 1/6 \\
        \end{array}"""
        table = "0,,,,,\n1/2,1/2,,,,\n1/2, ,1/2\n1,,,1\n,1/6,1/3,1/3,1/6,\n,1,,,\n"
        rk4 = Tableau.load(find("rk4")).method
        assert from_data(read_data(printed.encode(), "latex", "x.tex")).method == rk4
        found = from_data(read_data(table.encode(), "csv", "x.csv"))
        assert found.method == rk4
        assert found.embedded is not None
        assert found.embedded.b == (1, 0, 0, 0)

    def test_a_number_beyond_the_last_stage_is_no_blank(self) -> None:
        with pytest.raises(TableauError, match="3 entries"):
            from_data(read_data(b"0,0\n1/2,1/2,,1\n,0,1\n", "csv", "x.csv"))

    @pytest.mark.parametrize("of", ["csv", "numpy"])
    def test_a_file_without_coefficients_says_so(self, of: str, tmp_path: Path) -> None:
        np.savez(tmp_path / "x.npz", name=np.array("m"))
        content = (tmp_path / "x.npz").read_bytes() if of == "numpy" else b"name,m\n"
        with pytest.raises(TableauError, match="no array of coefficients; expected one of A, "):
            read_data(content, of, "file")


@pytest.mark.parametrize(
    ("of", "content"),
    [
        ("json", b"[1, 2]"),
        ("json", b"{"),
        ("json", b'{"name": "m", "family": "rk", "A": [[]], "b": [1], "b": ["1"]}'),
        ("json", b"[" * 100_000),
        ("csv", b'"'),
        ("csv", b"\xff"),
        ("csv", b"a,b\n"),
        ("csv", b"b,1\nb,2\n"),
        ("numpy", b"PK"),
        ("numpy", b""),
        ("sympy", b"import os"),
        ("sympy", b"A = [[1]\nb = [[1]]]"),
        ("latex", rb"\begin{array}{c|c} 1 \end{array}"),
        ("latex", rb"A = \begin{pmatrix} \write18 \end{pmatrix}"),
        ("c", b"int main(void) { return 0; }"),
        ("c", b"double A[1] = {{{{{1}}}}};"),
    ],
)
def test_malformed_content_is_refused(of: str, content: bytes) -> None:
    with pytest.raises(InputError):
        from_data(read_data(content, of, "file"))


@given(st.sampled_from(list(FORMATS)), st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(of: str, content: bytes) -> None:
    with suppress(InputError):
        from_data(read_data(content, of, "file"))


SOURCES = ("cf43", "gauss2", "radau2a2", "carpenter_kennedy4", "suzuki4", "stormer_verlet")


@lru_cache(maxsize=64)
def exported(name: str, of: str) -> bytes:
    return export(as_data(Tableau.load(find(name))), of)


BAD = [
    b"9^9^9^9",
    b"1/0",
    b"((((",
    b"nan",
    b"~",
    rb"\frac{1}{0}",
    b"{",
    b"}",
    b'"',
    b"*/",
    b"1e400",
    b"\x00",
    b"9" * 3000,
]


@settings(suppress_health_check=[HealthCheck.too_slow], max_examples=200, deadline=timedelta(seconds=20))
@given(
    st.sampled_from(SOURCES),
    st.sampled_from(list(FORMATS)),
    st.randoms(use_true_random=False),
    st.sampled_from(BAD),
)
def test_a_good_file_with_a_piece_changed_is_read_or_refused(
    name: str, of: str, numbers: random.Random, bad: bytes
) -> None:
    content = exported(name, of)
    i, j = sorted(numbers.randrange(len(content) + 1) for _ in range(2))
    near = content[min(i + numbers.randrange(8), len(content)) :]
    changed = numbers.choice(
        (content[:i] + content[j:], content[:i] + content[i:j] * 2 + content[j:], content[:i] + bad + near)
    )
    with suppress(InputError):
        data = as_data(from_data(read_data(changed, of, "file", "name")))
        for to in FORMATS:
            with suppress(InputError):
                export(data, to)


@pytest.mark.parametrize("content", [b"A,0\nb,1" + b"0" * 400, b"A,0\nb,1/1" + b"0" * 400])
def test_a_number_beyond_doubles_has_no_place_among_them(content: bytes) -> None:
    data = as_data(from_data(read_data(content, "csv", "x.csv")))
    for to in FORMATS:
        if b"/" in content or to not in ("numpy", "c"):
            assert from_data(read_data(export(data, to), to, "back")).method == from_data(data).method
        else:
            with pytest.raises(InputError, match="beyond the range of doubles"):
                export(data, to)


class TestCommand:
    """``orderconds convert``."""

    def run(self, *arguments: str):  # type: ignore[no-untyped-def]
        return CliRunner().invoke(program, ["convert", *arguments])

    def test_a_name_of_the_library_to_every_format_and_back(self, tmp_path: Path) -> None:
        for _, suffix in FORMATS.values():
            there, back = tmp_path / f"x{suffix}", tmp_path / "back.toml"
            assert self.run("gauss2", "-o", str(there)).exit_code == 0
            assert self.run(str(there), "-o", str(back)).exit_code == 0
            assert Tableau.load(back).method == Tableau.load(find("gauss2")).method

    def test_json_on_stdout(self) -> None:
        result = self.run("rk4", "--to", "json")
        assert result.exit_code == 0
        assert json.loads(result.output)["b"] == ["1/6", "1/3", "1/3", "1/6"]

    def test_a_proof_that_a_format_has_no_place_for_is_left_out_with_a_word(self) -> None:
        for to in FORMATS:
            result = self.run("cg4a", "--to", to)
            assert result.exit_code == 0
            assert ("its proof is left out" in result.stderr) is (to not in ("toml", "json"))
            assert "left out" not in self.run("cg3", "--to", to).stderr

    @pytest.mark.parametrize(
        "arguments",
        [
            ["nothing"],
            ["rk4", "--to", "yaml"],
            ["rk4", "-o", "x.yaml"],
            ["/nowhere/x.csv"],
            ["strang", "--to", "c"],
        ],
    )
    def test_bad_usage_ends_with_2(self, arguments: list[str]) -> None:
        result = self.run(*arguments)
        assert result.exit_code == 2
        assert "Traceback" not in result.output
