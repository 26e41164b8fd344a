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
        data = json.loads(content)
    except (ValueError, RecursionError) as problem:
        raise TableauError(str(problem) or "nested too deep", where=where, expected="JSON") from None
    if not isinstance(data, dict):
        raise TableauError(
            f"a JSON {type(data).__name__}", where=where, expected="an object with name, family, ..."
        )
    return data
