"""What is written in another format reads back as the same method, exactly; what is malformed is refused."""

from __future__ import annotations

import random
import tomllib
from contextlib import suppress
from dataclasses import replace
from datetime import timedelta
from functools import cache, lru_cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orderconds import Tableau, convert
from orderconds.errors import InputError, TableauError
from orderconds.exchange import FORMATS, export, json_file, left_out, read_data
from orderconds.proof.certificate import certify
from orderconds.tableau import Claims, available, dumps, find
from orderconds.tableau.record import from_data
from orderconds.tableau.write import as_data
from tests.orderconds.exchange.coefficients import COEFFICIENTS

ARRAYS = [name for name in FORMATS if name not in ("toml", "json")]


@cache
def data_of(name: str) -> dict:
    """Return the data of a library file; the tests do not change it."""
    return tomllib.loads(find(name).read_text(encoding="utf-8"))


@cache
def loaded(name: str) -> Tableau:
    return Tableau.load(find(name))


@cache
def content(name: str) -> dict:
    """Return what a file of the tableau contains; the tests do not change it."""
    return as_data(loaded(name))


def carries(name: str, of: str) -> bool:
    """Arrays hold no brackets and no named parts."""
    return of in ("toml", "json") or data_of(name)["family"] in ("rk", "prk", "composition", "cf")


def numbers(tableau: Tableau) -> list:
    found: list = []
    tableau.method.map(lambda x: found.append(x) or x)
    return found


def check_reads_back(name: str, of: str) -> None:
    tableau, data = loaded(name), content(name)
    if not carries(name, of):
        with pytest.raises(InputError, match="expected a TOML or JSON file"):
            export(data, of)
        return
    try:
        text = export(data, of)
    except TableauError:
        # Relations between coefficients, written out, may be longer than a coefficient may be.
        spelled_by_others = tableau.proof is not None and tableau.proof.reduction == "spelling"
        if not spelled_by_others:
            raise
        return
    back = from_data(read_data(text, of, "back"))
    assert back.method == tableau.method, name
    assert back.embedded == tableau.embedded, name
    assert (back.name, back.family, back.source) == (tableau.name, tableau.family, tableau.source)
    assert back.claims == tableau.claims
    assert isinstance(back.ring, type(tableau.ring))


def kind(tableau: Tableau) -> tuple:
    """Return what decides how a tableau is written: format, numbers, proof, embedded method."""
    proof = tableau.proof and tableau.proof.reduction
    return tableau.family, type(tableau.ring), proof, tableau.embedded is None


@pytest.mark.parametrize("of", FORMATS)
def test_a_tableau_of_each_kind_reads_back_the_same(of: str) -> None:
    for name in {kind(loaded(name)): name for name in available()}.values():
        check_reads_back(name, of)


@pytest.mark.slow
@pytest.mark.parametrize("of", FORMATS)
def test_every_tableau_of_the_library_reads_back_the_same(of: str) -> None:
    for name in available():
        check_reads_back(name, of)


REWRITTEN = {"numbers", "low_storage"}
"""Keys that arrays represent by the coefficients that follow from them."""


def check_announced(name: str, of: str) -> None:
    """The keys that a format drops are those of ``left_out``; all others keep their values."""
    data = content(name)
    try:
        back = read_data(export(data, of), of, "back")
    except InputError:
        assert not carries(name, of) or "proof" in data
        return
    assert {*data} - {*back} - REWRITTEN == {*left_out(data, of)}, name
    texts = ("name", "family", "source", "bibtex", "base", "order", "claims")
    assert {key: back.get(key) for key in texts} == {key: data.get(key) for key in texts}, name


@pytest.mark.parametrize("of", FORMATS)
def test_every_key_of_a_file_is_kept_or_announced(of: str) -> None:
    one_for_each_set_of_keys = {frozenset(content(name)): name for name in available()}
    for name in one_for_each_set_of_keys.values():
        check_announced(name, of)


@pytest.mark.slow
@pytest.mark.parametrize("of", FORMATS)
def test_every_key_of_the_library_is_kept_or_announced(of: str) -> None:
    for name in available():
        check_announced(name, of)


def test_a_writer_that_loses_a_claim_or_an_extension_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    data = content("rk4")
    for key in ("claims", "dense"):
        less = json_file.write({k: x for k, x in data.items() if k != key})
        monkeypatch.setattr(json_file, "write", lambda _, less=less: less)
        with pytest.raises(InputError, match="reading the output gives a different tableau"):
            export(data, "json")
        monkeypatch.undo()


@pytest.mark.parametrize("of", FORMATS)
def test_the_api_warns_of_keys_that_a_format_cannot_contain(of: str) -> None:
    if of in ("toml", "json"):
        assert "dense" in convert("bogacki_shampine3", of)
        return
    with pytest.warns(UserWarning, match="bogacki_shampine3: the format .* cannot contain the keys dense"):
        convert("bogacki_shampine3", of)


@pytest.mark.parametrize("of", ["toml", "json"])
def test_nothing_of_a_file_is_lost(of: str) -> None:
    for name in available():
        data = data_of(name)
        assert read_data(export(data, of), of, "back") == data
        assert read_data(export(content(name), of), of, "back") == data


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


@pytest.mark.parametrize("of", FORMATS)
def test_writing_twice_gives_the_same_bytes(of: str) -> None:
    data = as_data(Tableau.load(find("gauss2")))
    assert export(data, of) == export(data, of)


@settings(suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(COEFFICIENTS, min_size=2, max_size=2), st.sampled_from(ARRAYS))
def test_any_coefficient_reads_back_the_same(spelled: list[str], of: str) -> None:
    tableau = from_data({"name": "t", "family": "rk", "A": [[], [spelled[0]]], "b": spelled})
    data = {"name": "t", "family": "rk", "A": [["0", "0"], [spelled[0], "0"]], "b": spelled}
    back = from_data(read_data(export(data, of), of, "back"))
    assert back.method == tableau.method
    assert ["~" in x for x in as_data(back)["b"]] == ["~" in x for x in spelled]


@pytest.mark.parametrize("of", ["csv", "numpy"])
def test_a_file_without_coefficients_says_so(of: str, tmp_path: Path) -> None:
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
