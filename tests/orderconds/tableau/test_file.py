"""Tableau files: what is written reads back, and what is malformed is refused by place and expectation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from orderconds.errors import TableauError
from orderconds.ring import QQ
from orderconds.tableau import CommutatorFree, RungeKutta, Tableau, dumps
from orderconds.tableau.record import from_data
from orderconds.tableau.toml_text import toml_text
from orderconds.tableau.write import without_names

HEAD = 'name = "t"\nfamily = "rk"\n'
EULER = HEAD + 'A = [[]]\nb = ["1"]\n'
CF = 'name = "t"\nfamily = "cf"\n'

COEFFICIENTS = st.one_of(
    st.fractions(min_value=-20, max_value=20, max_denominator=50).map(str),
    st.sampled_from(["sqrt(2)", "1/4 - sqrt(3)/6", "1/(2 - 2^(1/3))", "x^2 - 1", "0", "-0.125"]),
)
NUMBERS = '[numbers.x]\nminpoly = ["-2", "0", "0", "1"]\nnear = "1.2599"\n'


def row(coefficients: list[str]) -> str:
    return "[" + ", ".join(f'"{c}"' for c in coefficients) + "]"


@st.composite
def rk_files(draw: st.DrawFn) -> str:
    s = draw(st.integers(1, 3))
    rows = [draw(st.lists(COEFFICIENTS, max_size=s)) for _ in range(s)]
    b = draw(st.lists(COEFFICIENTS, min_size=s, max_size=s))
    return f"{HEAD}A = [{', '.join(map(row, rows))}]\nb = {row(b)}\n{NUMBERS}"


@st.composite
def cf_files(draw: st.DrawFn) -> str:
    s = draw(st.integers(1, 3))
    lines = [CF]
    for i in range(s + 1):
        lines.append("[[stage]]" if i < s else "[update]")
        if i and draw(st.booleans()):
            lines.append(f"from = {draw(st.integers(1, i))}")
        exponentials = draw(st.lists(st.lists(COEFFICIENTS, max_size=s), max_size=2))
        lines.append(f"exp = [{', '.join(map(row, exponentials))}]")
    if draw(st.booleans()):
        exponentials = draw(st.lists(st.lists(COEFFICIENTS, max_size=s), max_size=2))
        lines += ["[embedded]", "order = 1", f"exp = [{', '.join(map(row, exponentials))}]"]
        if draw(st.booleans()):
            lines.append(f"from = {draw(st.integers(1, s))}")
    return "\n".join([*lines, NUMBERS])


def read(text: str) -> Tableau | None:
    """Return the tableau, None where its embedded method happens to be the main one."""
    try:
        return Tableau.loads(text)
    except TableauError as problem:
        if "the error estimate would always be zero" not in str(problem):
            raise
        return None


@given(text=st.one_of(rk_files(), cf_files()))
def test_a_written_tableau_reads_back_the_same(text: str) -> None:
    tableau = read(text)
    if tableau is None:
        return
    assert Tableau.loads(dumps(tableau)) == tableau
    assert dumps(Tableau.loads(dumps(tableau))) == dumps(tableau)
    full = Tableau.loads(toml_text(without_names(tableau)))
    assert (full.method, full.embedded) == (tableau.method, tableau.embedded)


def test_claims_embedded_rows_and_sources_read_back_the_same() -> None:
    text = HEAD + (
        'A = [[], ["1/2"]]\nb = ["0", "1"]\nembedded = { b = ["1"], order = 1 }\n'
        'source = "a \\"quoted\\" \\\\ source"\nbibtex = "key"\n[claims]\nrk = 2\n'
        "rkmk = [{ cutoff = 0, order = 2 }, { cutoff = 1, order = 2 }]\nexplicit = true\nfsal = false\n"
    )
    tableau = Tableau.loads(text)
    assert Tableau.loads(dumps(tableau)) == tableau
    assert [claim.label for claim in tableau.claims.orders] == ["rk", "rkmk(0)", "rkmk(1)"]
    assert tableau.claims.order("rkmk", 1) == 2
    assert tableau.claims.order("vcg") is None
    assert tableau.claims.properties == {"explicit": True, "fsal": False}
    assert tableau.embedded is not None
    assert tableau.embedded.b == (1, 0)


def test_short_rows_are_filled_with_zeros() -> None:
    method = Tableau.loads(HEAD + 'A = [[], ["1/2"], ["-1", 2]]\nb = ["1/6", "2/3", "1/6"]').method
    assert isinstance(method, RungeKutta)
    assert ((0, 0, 0), (QQ.rational(1, 2), 0, 0), (-1, 2, 0)) == method.A
    assert method.c == (0, QQ.rational(1, 2), 1)


def test_a_low_storage_scheme_expands_to_its_registers() -> None:
    tableau = Tableau.loads(CF + '[low_storage]\nA = ["0", "-1/2", "3"]\nB = ["1/3", "2", "5"]\n')
    method = tableau.method
    assert isinstance(method, CommutatorFree)
    assert [stage.start for stage in (*method.stages, method.update)] == [None, 0, 1, 2]
    q = QQ.rational
    assert method.stages[1].exponentials == ((q(1, 3), 0, 0),)
    assert method.stages[2].exponentials == ((-1, 2, 0),)
    assert method.update.exponentials == ((q(-15, 2), 15, 5),)
    assert method.as_runge_kutta(QQ).b == (q(1, 3) - 1 - q(15, 2), 17, 5)


def test_a_stage_may_start_from_an_earlier_one() -> None:
    text = CF + '[[stage]]\n[[stage]]\nexp = [["1/2"]]\n[update]\nfrom = 2\nexp = [["-1/2", "1"]]\n'
    method = Tableau.loads(text).method
    assert isinstance(method, CommutatorFree)
    half = QQ.rational(1, 2)
    assert method.from_start(method.update) == ((half, 0), (-half, 1))
    assert method.as_runge_kutta(QQ) == RungeKutta(((0, 0), (half, 0)), (0, 1))


MALFORMED = {
    "unknown key": (EULER + "d = [0]\n", "unknown key 'd'", "one of A, b, bibtex"),
    "row sums other than c": (
        EULER + 'c = ["1/2"]\n',
        "c_1 = 1/2, but the sum of row 1 of A is 0",
        "c_i = sum",
    ),
    "c of another length": (
        EULER + "c = [0, 1]\n",
        "c: c has 2 entries, b has 1 entries",
        "as many entries as b",
    ),
    "embedded method equal to b": (
        EULER + 'embedded = { b = ["1"], order = 1 }',
        "embedded.b: an embedded method that is equal to the method itself",
        "weights that differ",
    ),
    "unknown key in embedded": (
        EULER + 'embedded = { b = ["1"], order = 1, x = 2 }',
        "embedded: unknown",
        "b, order",
    ),
    "unknown key in a stage": (
        CF + '[[stage]]\nfrm = 1\n[update]\nexp = [["1"]]',
        "stage[1]: unknown",
        "exp, from",
    ),
    "unknown key in numbers": (
        EULER + 'numbers.x = { minpoly = [], n = "1" }',
        "numbers.x: ",
        "minpoly, near",
    ),
    "key twice": (EULER + 'b = ["1"]\n', "Cannot overwrite", "once"),
    "name twice": (EULER + '[numbers]\ng = "1"\ng = "2"\n', "Cannot overwrite", "once"),
    "no TOML": ("name = ", "Invalid value", "TOML"),
    "no name": ('family = "rk"\nA = [[]]\nb = ["1"]\n', "no name", "the key name"),
    "a name without end": (EULER.replace('"t"', f'"{"a" * 65}"'), "a name of 65 characters", "at most 64"),
    "a number's name without end": (
        HEAD + f'A = [[]]\nb = [1]\nnumbers = {{ {"a" * 99} = "1" }}\n',
        "a name of 99 characters",
        "at most 64",
    ),
    "a part's name without end": (
        f'name = "t"\nfamily = "splitting"\nparts = ["{"a" * 70}", "b"]\nstep = [["b", "1"]]\n',
        "a name of 70 characters",
        "at most 64",
    ),
    "bad name": ('name = "a b"\nfamily = "rk"\nA = [[]]\nb = ["1"]\n', "name = 'a b'", "letters"),
    "no family": (
        'name = "t"\nA = [[]]\nb = ["1"]\n',
        "no family",
        "one of cf, composition, magnus, prk, rk, splitting",
    ),
    "unknown family": (
        'name = "t"\nfamily = "rkk"\n',
        "family = 'rkk'",
        "one of cf, composition, magnus, prk, rk, splitting",
    ),
    "no weights": (HEAD + "A = [[]]\n", "no b", "the key b"),
    "no stages": (HEAD + "A = []\nb = []\n", "0 stages", "1 to 200"),
    "too few rows": (HEAD + 'A = [[]]\nb = ["1", "0"]\n', "A: A has 1 rows, b has 2 entries", "a square A"),
    "too many rows": (HEAD + 'A = [[], []]\nb = ["1"]\n', "A: A has 2 rows, b has 1 entries", "a square A"),
    "row too long": (HEAD + 'A = [["0", "1"]]\nb = ["1"]\n', "A[1]: 2 entries", "at most 1"),
    "embedded method too long": (
        EULER + 'embedded = { b = ["1", "0"], order = 1 }',
        "embedded.b: 2",
        "at most 1",
    ),
    "rows not nested": (HEAD + 'A = ["1"]\nb = ["1"]\n', "A[1]: a value of type str", "array"),
    "float": (HEAD + 'A = [[0.5]]\nb = ["1"]\n', "A[1][1]: a value of type float", "str"),
    "float NaN": (HEAD + "A = [[]]\nb = [nan]\n", "b[1]: a value of type float", "str"),
    "spelled NaN": (HEAD + 'A = [[]]\nb = ["nan"]\n', "b[1]: the name 'nan'", "a number"),
    "code": (HEAD + 'A = [[]]\nb = ["open(1)"]\n', "b[1]: '('", "coefficient"),
    "division by zero": (HEAD + 'A = [[]]\nb = ["1/(1 - 1)"]\n', "b[1]: division by zero", "not zero"),
    "tower of powers": (HEAD + 'A = [[]]\nb = ["9^9^9^9"]\n', "b[1]: a power of a power", "parentheses"),
    "unknown number": (
        HEAD + 'A = [[]]\nb = ["g"]\nnumbers = { h = "1" }\n',
        "the name 'g'",
        "the table [numbers] (defined names: h)",
    ),
    "numbers in a circle": (EULER + 'numbers = { g = "h", h = "1/g" }\n', "g -> h -> g", "no cycle"),
    "numbers in a long chain": (
        EULER + "[numbers]\n" + "".join(f'g{i} = "g{i + 1}"\n' for i in range(60)) + 'g60 = "1"\n',
        "a chain of more than 40 definitions: g0 -> g1 -> ... -> g40",
        "a shorter chain",
    ),
    "number called sqrt": (EULER + 'numbers = { sqrt = "1" }\n', "the name 'sqrt'", "reserved"),
    "number with a dash": (EULER + 'numbers = { a-b = "1" }\n', "the name 'a-b'", "letter"),
    "unused number that is bad": (
        EULER + 'numbers = { g = "1/0" }\n',
        "numbers.g: division by zero",
        "not zero",
    ),
    "root far from near": (
        EULER + '[numbers.x]\nminpoly = [-2, 0, 1]\nnear = "3.1"\n',
        "no real roots",
        "one real",
    ),
    "roots not isolated": (
        EULER + '[numbers.x]\nminpoly = [-2, 0, 1]\nnear = "0"\n',
        "numbers.x: no",
        "one real",
    ),
    "near no decimal": (EULER + '[numbers.x]\nminpoly = [-2, 0, 1]\nnear = "x"\n', "near = 'x'", "decimal"),
    "minpoly with radicals": (
        EULER + '[numbers.x]\nminpoly = ["sqrt(2)", 1]\nnear = "1"\n',
        "minpoly",
        "rational",
    ),
    "minpoly constant": (EULER + '[numbers.x]\nminpoly = [1]\nnear = "1"\n', "1 coefficients", "degree"),
    "unknown property": (EULER + "claims = { explcit = true }\n", "property 'explcit'", "explicit"),
    "order zero": (EULER + "claims = { rk = 0 }\n", "claims.rk", ">= 1"),
    "order no integer": (EULER + 'claims = { rk = "3" }\n', "claims.rk: a value of type str", "int"),
    "cutoff without order": (
        EULER + "claims = { rkmk = [{ cutoff = 1 }] }\n",
        "claims.rkmk[1]: no order",
        "order",
    ),
    "claim twice": (
        EULER + "claims = { rkmk = [{ cutoff = 1, order = 1 }, { cutoff = 1, order = 2 }] }\n",
        "two claims for rkmk(1)",
        "at most one",
    ),
    "stage from itself": (
        CF + '[[stage]]\nfrom = 1\n[update]\nexp = [["1"]]\n',
        "stage[1]: from = 1",
        "no key 'from'",
    ),
    "stage from a later one": (
        CF + '[[stage]]\n[[stage]]\nfrom = 2\n[update]\nexp = [["1"]]\n',
        "stage[2]: from = 2",
        "1 to 1",
    ),
    "no update": (CF + "[[stage]]\n", "no update", "[update]"),
    "cf row too long": (
        CF + '[[stage]]\n[update]\nexp = [["1", "2"]]\n',
        "update.exp[1]: 2 entries",
        "at most 1",
    ),
    "two forms of cf": (
        CF + '[[stage]]\n[update]\nexp = [["1"]]\n[low_storage]\nA = ["0"]\nB = ["1"]\n',
        "contains low_storage, and also stage or update",
        "either low_storage, or stage and update",
    ),
    "low storage of two lengths": (
        CF + '[low_storage]\nA = ["0"]\nB = ["1", "2"]\n',
        "A has 1 entries, B has 2",
        "the same length",
    ),
    "unknown base": ('name = "t"\nfamily = "composition"\nbase = "x"\ngamma = ["1"]\n', "base", ""),
    "an integer longer than Python reads": (
        HEAD + "A = [[]]\nb = [" + "9" * 5000 + "]\n",
        "Exceeds the limit (4300 digits)",
        "quotation marks",
    ),
    "lists in lists in lists": (
        HEAD + "A = " + "[" * 3000 + "]" * 3000 + "\n",
        "nested too deep",
        "with few levels",
    ),
    "rk keys in cf": (CF + 'A = [[]]\nb = ["1"]\n', "unknown key", "low_storage"),
}


@pytest.mark.parametrize(("text", "found", "expected"), MALFORMED.values(), ids=MALFORMED.keys())
def test_a_malformed_file_is_refused_by_place_and_expectation(text: str, found: str, expected: str) -> None:
    with pytest.raises(TableauError) as caught:
        Tableau.loads(text, "f.toml")
    message = str(caught.value)
    assert message.startswith("f.toml")
    assert found in message
    assert expected in message.partition("expected")[2]
    assert "\n" not in message


def test_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    latin = tmp_path / "latin.toml"
    latin.write_bytes(b'name = "\xe9"')
    for path in (tmp_path / "absent.toml", tmp_path, latin):
        with pytest.raises(TableauError) as caught:
            Tableau.load(path)
        assert str(path) in str(caught.value)


def test_a_byte_order_mark_before_the_text_is_no_part_of_it(tmp_path: Path) -> None:
    marked = tmp_path / "marked.toml"
    marked.write_bytes(b"\xef\xbb\xbf" + EULER.encode())
    assert Tableau.load(marked).method == Tableau.loads(EULER).method


def test_a_file_that_tells_no_size_is_not_read_to_its_end() -> None:
    if not Path("/dev/zero").exists():
        pytest.skip("no /dev/zero")
    with pytest.raises(TableauError, match=r"/dev/zero: not a regular file"):
        Tableau.load("/dev/zero")


def test_a_file_of_more_than_a_million_bytes_is_not_parsed(tmp_path: Path) -> None:
    large = tmp_path / "large.toml"
    large.write_text(EULER + "#" * 1_000_000)
    with pytest.raises(TableauError, match="a file of more than 1000000 bytes"):
        Tableau.load(large)


def test_the_message_on_numpy_arrays_says_what_to_pass() -> None:
    data = {"name": "t", "family": "rk", "A": np.zeros((1, 1)), "b": ["1"]}
    with pytest.raises(TableauError, match=r"NumPy arrays are not accepted here.*Tableau.rk\(A, b\)"):
        from_data(data)


@given(text=st.text(max_size=60))
def test_any_text_is_a_tableau_or_refused_and_nothing_else(text: str) -> None:
    with pytest.raises(TableauError):
        Tableau.loads(text)


@given(coefficient=st.text(alphabet=st.characters(exclude_categories=["Cs"]), max_size=30))
def test_any_quoted_text_is_a_coefficient_or_refused(coefficient: str) -> None:
    import json

    quoted = json.dumps(coefficient).replace("\x7f", "\\u007f")
    try:
        tableau = Tableau.loads(f"{HEAD}A = [[]]\nb = [{quoted}]\n")
    except TableauError:
        return
    assert Tableau.loads(dumps(tableau)).method.s == 1
