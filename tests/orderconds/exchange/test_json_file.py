"""JSON: a file's keys and values, one to one."""

from __future__ import annotations

import tomllib

from orderconds.exchange import export, read_data
from orderconds.tableau import find


def data_of(name: str) -> dict:
    return tomllib.loads(find(name).read_text(encoding="utf-8"))


def test_json_keeps_names_claims_and_proofs() -> None:
    data = data_of("cg4a")
    assert read_data(export(data, "json"), "json", "back") == data
