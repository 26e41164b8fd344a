"""JSON: the keys and values of a tableau file, one to one."""

from __future__ import annotations

import json

from orderconds.errors import TableauError
from orderconds.tableau.file_format import Data


def write(data: Data) -> bytes:
    """Return JSON text.

    >>> write({"name": "m"})
    b'{\\n  "name": "m"\\n}\\n'
    """
    return (json.dumps(data, indent=2) + "\n").encode()


def read(content: bytes, where: str) -> Data:
    """Return the object; its numbers must be strings or integers, as in a tableau file.

    >>> read(b'{"name": "m"}', "m.json")
    {'name': 'm'}
    """
    try:
        data = json.loads(content, object_pairs_hook=_unique)
    except (ValueError, RecursionError) as problem:
        raise TableauError(str(problem) or "nested too deep", where=where, expected="JSON") from None
    if not isinstance(data, dict):
        raise TableauError(
            f"a JSON {type(data).__name__}", where=where, expected="an object with name, family, ..."
        )
    return data


def _unique(pairs: list[tuple[str, object]]) -> Data:
    """Return an object; raise an error for a repeated name, since Python would keep only the last value."""
    members: Data = {}
    for name, value in pairs:
        if name in members:
            raise ValueError(f"{name!r} twice in one object")
        members[name] = value
    return members
