"""Read the claims of a tableau from a text such as ``rk=4, symmetric=true``. The text may also be a JSON
object: ``{"rk": 4}``.
"""

from __future__ import annotations

import json
import re

from orderconds.errors import TableauError
from orderconds.tableau.file_format import Data

EXPECTED = "claims such as rk=4, or an object in JSON"
_CLAIM = re.compile(r"([\w()]{1,64})\s*=\s*(\d{1,3}|true|false)", re.ASCII)


def claims_from(text: str, where: str) -> Data:
    """Return the claims in a text as a dictionary. Raise TableauError if the text contains anything else.

    >>> claims_from("rk=4, rkmk(1) = 3; explicit=true", "x.csv")
    {'rk': 4, 'rkmk(1)': 3, 'explicit': True}
    >>> claims_from('{"rk": 4}', "x.csv")
    {'rk': 4}
    """
    if text.lstrip().startswith("{"):
        return json_table(text, where)
    table: Data = {}
    for part in filter(None, (part.strip() for part in re.split("[,;\n]", text))):
        claim = _CLAIM.fullmatch(part)
        if claim is None:
            raise TableauError(f"{part[:60]!r}", where=where, expected=EXPECTED)
        if claim[1] in table:
            raise TableauError(f"two claims for {claim[1]}", where=where, expected="at most one")
        table[claim[1]] = int(claim[2]) if claim[2].isdigit() else claim[2] == "true"
    if not table:
        raise TableauError("no claim", where=where, expected=EXPECTED)
    return table


def json_table(text: str, where: str) -> Data:
    """Return a JSON object as a dictionary. Raise TableauError if the text is not a JSON object.

    >>> json_table('{"rk": 4}', "claims")
    {'rk': 4}
    """
    try:
        parsed = json.loads(text)
    except (ValueError, RecursionError):
        parsed = None
    if not isinstance(parsed, dict):
        raise TableauError(f"{text[:60]!r}", where=where, expected="an object in JSON")
    return parsed
