"""A tableau as arrays with names. The entries are coefficients as text.

The names of the arrays depend on the family:

- ``rk``: A and b. An embedded method also has embedded_b, and the number embedded_order.
- ``prk``: A, b, A_hat and b_hat.
- ``composition``: gamma, or alpha and beta.
- ``cf``: exponentials, count and start. The arrays describe a list of products of exponentials. The list
  contains one product for each stage, then the product of the update, then the product of the embedded
  update. Each row of ``exponentials`` contains the coefficients of one exponential. For each product,
  ``count`` contains the number of exponentials. ``start`` contains 0 for a product that acts on y0, and i for
  a product that acts on the value of stage i.

The tables ``proof`` and ``dense`` of a tableau file are omitted.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from fractions import Fraction

from orderconds.errors import TableauError
from orderconds.exchange.claim_text import claims_from, json_table
from orderconds.exchange.unevaluated import CoefficientTooLong, with_names_inlined
from orderconds.ring import Balls
from orderconds.tableau import Tableau, doubles
from orderconds.tableau.file_format import Data, Format
from orderconds.tableau.formats import FORMATS, array_format
from orderconds.tableau.record import from_data
from orderconds.tableau.write import without_names

Row = list[str]
Arrays = Data
"""A map from names to texts, vectors of coefficients or matrices of coefficients."""

TABLES = ("numbers", "claims")
"""Tables of a tableau file that :func:`to_arrays` converts to JSON text."""
TEXTS = ("name", "family", "source", "bibtex", "base", "order", "embedded_order", *TABLES)
ROWS = ("b", "b_hat", "gamma", "alpha", "beta", "embedded_b", "count", "start", "c")
MATRICES = ("A", "A_hat", "exponentials")
KEYS = frozenset((*TEXTS, *ROWS, *MATRICES, "embedded", "stage", "update", "low_storage"))
"""Keys of a tableau file that :func:`to_arrays` converts to arrays or texts. All other keys are omitted."""
ROUNDED = 12
"""A decimal in an imported file is considered exact if it has fewer than ROUNDED significant digits."""


def to_arrays(data: Data, target: str) -> Arrays:
    """Return the arrays of a tableau.

    Raises :class:`TableauError` if arrays cannot represent the methods of the family. The error message
    contains ``target``, the name of the output format.

    >>> to_arrays({"name": "heun", "family": "rk", "A": [[], [1]], "b": ["1/2", "1/2"]}, "a table")["A"]
    [['0', '0'], ['1', '0']]
    """
    family = data.get("family")
    kind = FORMATS.get(str(family))
    if kind is None or not kind.in_arrays:
        raise TableauError(
            f"a tableau of format {family} cannot be written as {target}",
            where=str(data.get("name")),
            expected="a TOML or JSON file, which can represent every tableau",
        )
    if data.get("numbers") or "low_storage" in data:
        try:
            data = data_without_names(from_data(data))
        except CoefficientTooLong:
            if "low_storage" in data:
                raise
    entries: Arrays = {key: str(data[key]) for key in TEXTS if data.get(key)}
    entries |= {key: json.dumps(data[key]) for key in TABLES if data.get(key)}
    if kind.as_products:
        return {**entries, **_products(data)}
    width = len(data["b"]) if "b" in data else 0
    for key in MATRICES + ROWS:
        if key in data:
            entries[key] = _filled(data[key], width) if key in MATRICES else [_exact(x) for x in data[key]]
    if embedded := data.get("embedded"):
        entries["embedded_b"] = _filled([embedded["b"]], width)[0]
        entries["embedded_order"] = str(embedded["order"])
    return entries


def data_without_names(tableau: Tableau) -> Data:
    """Return a tableau as keys and values. Each name from the table ``numbers`` is replaced by its formula.

    A number that the tableau defines as a root of a polynomial (``minpoly``) keeps its name. Rounded
    coefficients keep the digits of the tableau file.

    >>> data = {"name": "t", "family": "rk", "A": [[]], "b": ["g"], "numbers": {"g": "2/4"}}
    >>> data_without_names(from_data(data))
    {'name': 't', 'family': 'rk', 'A': [[]], 'b': ['1/2']}
    """
    if isinstance(tableau.ring, Balls) and tableau.file is not None:
        tableau = with_names_inlined(tableau, tableau.file)
    return without_names(tableau, name_radicals=False)


def _filled(rows: Sequence[Sequence[str | int]], width: int) -> list[Row]:
    return [[*map(_exact, row), *["0"] * (width - len(row))] for row in rows]


def _exact(entry: str | int) -> str:
    """Return a coefficient as the text for an exported file.

    An exact decimal with at least 12 significant digits becomes a fraction, because the import does not read
    such decimals as exact (see :data:`ROUNDED`).

    >>> _exact("0.123456789012"), _exact("0.5"), _exact("0.123456789012~")
    ('30864197253/250000000000', '0.5', '0.123456789012~')
    """
    text = str(entry)
    if re.fullmatch(r"-?\d*\.\d+", text) and len(text.lstrip("-0.").replace(".", "")) >= ROUNDED:
        return str(Fraction(text))
    return text


def _products(data: Data) -> Arrays:
    embedded = data.get("embedded")
    products = [*data["stage"], data["update"], *([embedded] if embedded else [])]
    width = len(data["stage"])
    order = {"embedded_order": str(embedded["order"])} if embedded else {}
    return order | {
        "start": [str(product.get("from", 0)) for product in products],
        "count": [str(len(product.get("exp", []))) for product in products],
        "exponentials": [row for product in products for row in _filled(product.get("exp", []), width)],
    }


def from_arrays(entries: Arrays, where: str) -> Data:
    """Return the keys and values of the tableau file that the arrays represent.

    Raises TableauError if arrays are missing, or if an array has an unknown name or a wrong type.

    >>> from_arrays({"gamma": ["1"]}, "a table")
    {'family': 'composition', 'gamma': ['1'], 'base': 'symmetric-2'}
    """
    known = {*TEXTS, *ROWS, *MATRICES}
    _verify_types(entries, where)
    if not entries.keys() - set(TEXTS):
        raise TableauError(
            "no array of coefficients", where=where, expected=f"one of {', '.join((*MATRICES, *ROWS))}"
        )
    for name in entries:
        if name not in known:
            raise TableauError(
                f"an array with the unknown name {name!r}",
                where=where,
                expected=f"one of {', '.join(sorted(known))}",
            )
    tables: Data = {}
    if "numbers" in entries:
        tables["numbers"] = json_table(entries["numbers"], f"{where}: numbers")
    if "claims" in entries:
        tables["claims"] = claims_from(entries["claims"], f"{where}: claims")
    if "order" in entries:
        tables["order"] = _integer(entries["order"], f"{where}: order")
    family = entries.get("family") or array_format(entries)
    kind = FORMATS.get(family, Format)
    data = {key: entries[key] for key in ("name", "source", "bibtex", "base") if key in entries} | {
        "family": family,
        **tables,
    }
    if kind.as_products:
        return data | _stages(entries, where)
    data |= {
        key: entries[key]
        for key in ("A", "b", "A_hat", "b_hat", "gamma", "alpha", "beta", "c")
        if key in entries
    }
    data = data | {key: value for key, value in kind.defaults(entries).items() if key not in data}
    if "embedded_b" in entries:
        stated = entries.get("embedded_order")
        order = {} if stated is None else {"order": _integer(stated, where)}
        data["embedded"] = {"b": entries["embedded_b"], **order}
    return data


def _verify_types(entries: Arrays, where: str) -> None:
    """Raise an error if a value is not the text, vector or matrix that its name requires."""
    for name, value in entries.items():
        depth = 0 if name in TEXTS else 2 if name in MATRICES else 1
        if not _has_depth(value, depth):
            expected = ("a text", "a row of coefficients", "rows of coefficients")[depth]
            raise TableauError(f"{name}: {repr(value)[:60]}", where=where, expected=expected)


def _has_depth(value: object, depth: int) -> bool:
    if depth == 0:
        return isinstance(value, str)
    return isinstance(value, list) and all(_has_depth(x, depth - 1) for x in value)


def _stages(entries: Arrays, where: str) -> Data:
    missing = [key for key in ("count", "start", "exponentials") if key not in entries]
    if missing:
        raise TableauError(
            f"no array {missing[0]}", where=where, expected="the arrays 'count', 'start' and 'exponentials'"
        )
    rows, products = list(entries["exponentials"]), []
    counts, starts = ([_integer(x, where) for x in entries[key]] for key in ("count", "start"))
    pair = "embedded_order" in entries
    sound = len(counts) == len(starts) > pair and min(counts) >= 0 and sum(counts) == len(rows)
    if not sound:
        raise TableauError(
            "the arrays 'count', 'start' and 'exponentials' contradict each other",
            where=where,
            expected="equal numbers of entries in 'count' and 'start', and sum(count) rows in 'exponentials'",
        )
    for count, start in zip(counts, starts, strict=True):
        product: Data = {"exp": rows[:count]} if count else {}
        rows = rows[count:]
        products.append(product | ({"from": start} if start else {}))
    if pair:
        lower = products.pop() | {"order": _integer(entries["embedded_order"], where)}
        return {"stage": products[:-1], "update": products[-1], "embedded": lower}
    return {"stage": products[:-1], "update": products[-1]}


def with_family(data: Data) -> Data:
    """Return ``data`` with the key ``family``.

    If the key is missing, the names of the arrays determine the family. If ``data`` contains no arrays,
    ``data`` is returned unchanged.

    >>> with_family({"A": [[]], "b": ["1"]})["family"]
    'rk'
    """
    distinctive = {kind.distinctive_key for kind in FORMATS.values() if kind.in_arrays}
    if "family" in data or not any(key in data for key in distinctive | {"b", "alpha"}):
        return data
    family = array_format(data)
    return {"family": family, **FORMATS[family].defaults(data), **data}


def butcher(stages: Sequence[Row], weights: Sequence[Row]) -> Arrays:
    """Return the arrays of a Butcher tableau. Row i of ``stages`` contains c_i and row i of A.

    The first row of ``weights`` is b. A second row contains embedded weights. A blank cell is zero.
    Blank cells to the right of the tableau are removed.

    >>> butcher([["0", "", ""], ["1", "1", ""]], [["", "1"]])["A"]
    [['0', '0'], ['1', '0']]
    """
    width = len(stages)
    names = ("b", "embedded_b")
    entries: Arrays = {name: _unblanked(row, width) for name, row in zip(names, weights, strict=False)}
    return {"c": [row[0] for row in stages], "A": [_unblanked(row[1:], width) for row in stages], **entries}


def _unblanked(row: Row, width: int) -> Row:
    end = len(row)
    while end > width and not row[end - 1]:
        end -= 1
    return [x or "0" for x in row[:end]]


def _integer(text: str, where: str) -> int:
    if not re.fullmatch(r"-?\d{1,6}", text.strip(), re.ASCII):
        raise TableauError(f"{text!r}", where=where, expected="an integer")
    return int(text)


def coefficient(text: str) -> str:
    """Convert a number from another program's file to a coefficient of a tableau file.

    If ``text`` was probably printed from a double, the result is this double (see
    :func:`~orderconds.tableau.doubles.is_printed`). Other decimals with at least 12 significant digits
    keep their digits, but are marked as rounded (suffix ``~``).

    >>> [coefficient(x) for x in ("5.0e-1", "0.3333333333333333", "1.0/6.0", "-2.5f", "1/3 - sqrt(3)/6")]
    ['0.50', '0.3333333333333333d', '1.0/6.0', '-2.5', '1/3 - sqrt(3)/6']
    >>> coefficient("0.333333333333"), coefficient("3.333333333333333148e-01")
    ('0.333333333333~', '0.3333333333333333d')
    """
    number = text.strip()
    parts = re.fullmatch(r"([+-]?)(\d*)\.?(\d*)(?:[eE]([+-]?\d{1,3}))?[fFlL]?", number, re.ASCII)
    if parts is None or not (parts[2] or parts[3]):
        return number
    sign, whole, part, exponent = parts[1], parts[2] or "0", parts[3], int(parts[4] or 0)
    if exponent < 0:
        whole = whole.rjust(1 - exponent, "0")
        whole, part = whole[:exponent], whole[exponent:] + part
    elif exponent:
        part = part.ljust(exponent, "0")
        whole, part = whole + part[:exponent], part[exponent:]
    digits = (whole + part).lstrip("0")
    decimal = f"{'-' if sign == '-' else ''}{whole}" + (f".{part}" if part else "")
    if part and doubles.is_printed(decimal):
        return doubles.double_text(float(decimal))
    return decimal + "~" if part and len(digits) >= ROUNDED else decimal
