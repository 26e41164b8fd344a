"""A TOML reader that rejects long dotted keys. Python's TOML reader would need gigabytes of memory for a key
with thousands of parts."""

from __future__ import annotations

import re
import tomllib

from orderconds.tableau.file_format import Data

MAX_PARTS = 24
"""The maximal number of parts of a dotted key."""

_PART = r"(?:[A-Za-z0-9_-]{1,99}+|\"[^\"\n]{0,99}+\"|'[^'\n]{0,99}+')"
_LONG_KEY = re.compile(rf"(?<![\w.'\"-])(?>{_PART}[ \t]{{0,9}}+\.[ \t]{{0,9}}+){{{MAX_PARTS}}}")


def parse_toml(text: str) -> Data:
    """Parse TOML text. Raises ValueError for invalid TOML, and for a dotted key with more than
    :data:`MAX_PARTS` parts.

    >>> parse_toml('a.b = "1"')
    {'a': {'b': '1'}}
    >>> parse_toml("a." * 30000 + "a = 1")
    Traceback (most recent call last):
    tomllib.TOMLDecodeError: a key of more than 24 parts
    """
    if _LONG_KEY.search(text):
        raise tomllib.TOMLDecodeError(f"a key of more than {MAX_PARTS} parts")
    return tomllib.loads(text)
