"""JSON files with the keys and values of a tableau file in TOML.

A short decimal, for example ``0.5``, is exact. A decimal with the digits of a printed double, for example
``0.3333333333333333``, is a double. The value of the key ``claims`` may be a text such as ``"rk=4"``.
"""

from __future__ import annotations

import json

from orderconds.errors import TableauError
from orderconds.exchange.arrays import coefficient, with_family
from orderconds.exchange.claim_text import claims_from
from orderconds.tableau.file_format import Data


def write(data: Data) -> bytes:
    """Return the keys and values of a tableau file as JSON text.

    >>> write({"name": "m"})
    b'{\\n  "name": "m"\\n}\\n'
    """
    return (json.dumps(data, indent=2) + "\n").encode()


def read(content: bytes, where: str) -> Data:
    """Return the keys and values of a JSON object.

    If the key ``family`` is missing, the names of the arrays determine the family. A number with a decimal
    point or an exponent becomes a string (see :func:`~orderconds.exchange.arrays.coefficient`).

    >>> read(b'{"A": [[0.5]], "b": [0.3333333333333333], "order": 1}', "m.json")
    {'family': 'rk', 'A': [['0.5']], 'b': ['0.3333333333333333d'], 'order': 1}
    """
    try:
        data = json.loads(
            content, object_pairs_hook=_unique, parse_float=coefficient, parse_constant=_refused
        )
    except (ValueError, RecursionError) as problem:
        raise TableauError(str(problem) or "nested too deep", where=where, expected="JSON") from None
    if not isinstance(data, dict):
        raise TableauError(
            f"a JSON {type(data).__name__}", where=where, expected="the keys 'name', 'family', ..."
        )
    if isinstance(data.get("claims"), str):
        data["claims"] = claims_from(data["claims"], f"{where}: claims")
    return with_family(data)


def _refused(name: str) -> object:
    raise ValueError(f"the number {name}")


def _unique(pairs: list[tuple[str, object]]) -> Data:
    """Return the pairs (name, value) as a dictionary. Raise an error if a name occurs twice."""
    members: Data = {}
    for name, value in pairs:
        if name in members:
            raise ValueError(f"the key {name!r} occurs twice in one object")
        members[name] = value
    return members
