"""JSON: a file's keys and values, one to one."""

from __future__ import annotations

import tomllib

import pytest

from orderconds.errors import TableauError
from orderconds.exchange import export, read_data
from orderconds.exchange.json_file import read, write
from orderconds.tableau import find


def data_of(name: str) -> dict:
    return tomllib.loads(find(name).read_text(encoding="utf-8"))


def test_json_keeps_names_claims_and_proofs() -> None:
    data = data_of("cg4a")
    assert read_data(export(data, "json"), "json", "back") == data


def test_a_name_given_twice_is_refused() -> None:
    with pytest.raises(TableauError, match="the key 'b' occurs twice"):
        read(b'{"b": 1, "b": 2}', "m.json")
    with pytest.raises(TableauError, match="the key 'rk' occurs twice"):
        read(b'{"claims": {"rk": 1, "rk": 2}}', "m.json")


@pytest.mark.parametrize("content", [b"[]", b"null", b'"text"', b"1"])
def test_only_an_object_is_a_tableau(content: bytes) -> None:
    with pytest.raises(TableauError, match="the keys 'name', 'family'"):
        read(content, "m.json")


def test_what_is_written_is_read_as_it_was() -> None:
    data = {"name": "m", "family": "rk", "A": [[], ["1/2"]], "claims": {"rk": 2, "explicit": True}}
    assert read(write(data), "back") == data
