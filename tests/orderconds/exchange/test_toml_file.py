"""TOML: the project's own format."""

from __future__ import annotations

import tomllib

import pytest

from orderconds.errors import TableauError
from orderconds.exchange.toml_file import read, write
from orderconds.tableau import available, find


def test_library_files_are_written_with_all_their_keys() -> None:
    for name in available():
        data = tomllib.loads(find(name).read_text(encoding="utf-8"))
        assert read(write(data), "back") == data


@pytest.mark.parametrize(
    "content", [b"\xff", b"name = ", b"name = 1\nname = 2", b"a = " + b"[" * 5000, b"a = " + b"9" * 5000]
)
def test_malformed_text_is_refused_with_the_place(content: bytes) -> None:
    with pytest.raises(TableauError, match=r"m\.toml"):
        read(content, "m.toml")
