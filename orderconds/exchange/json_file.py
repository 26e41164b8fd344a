"""JSON: the keys and values of a tableau file, one to one."""

from __future__ import annotations

import json
from typing import Any

from orderconds.errors import TableauError


def write(data: Any) -> bytes:
    """Return JSON text.

    >>> write({"name": "m"})
    b'{\\n  "name": "m"\\n}\\n'
    """
    return (json.dumps(data, indent=2) + "\n").encode()


def read(content: bytes, where: str) -> dict[str, Any]:
    """Return the object; its numbers must be strings or integers, as in a tableau file.

    >>> read(b'{"name": "m"}', "m.json")
    {'name': 'm'}
    """
    try:
        data = json.loads(content, object_pairs_hook=_once)
    except (ValueError, RecursionError) as problem:
        raise TableauError(str(problem) or "nested too deep", where=where, expected="JSON") from None
    if not isinstance(data, dict):
        raise TableauError(
            f"a JSON {type(data).__name__}", where=where, expected="an object with name, family, ..."
        )
    return data


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object in which no name stands twice; Python's reader would take the last."""
    found: dict[str, Any] = {}
    for name, value in pairs:
        if name in found:
            raise ValueError(f"{name!r} twice in one object")
        found[name] = value
    return found
