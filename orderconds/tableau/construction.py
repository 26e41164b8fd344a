"""Conversion of Python arrays to the content of a tableau file, for the constructors of :class:`Tableau`."""

from __future__ import annotations

import numbers
import re
from collections.abc import Mapping

from orderconds.argument import CONDITION_ORDER, described, integer, text
from orderconds.errors import TableauError
from orderconds.tableau.file_format import Coefficient, Data
from orderconds.tableau.python_numbers import matrix, row

Claimed = Mapping[str, int | bool] | int | None
"""The claims about a method. A mapping contains claimed orders and properties, as in ``{"rk": 4, "explicit":
True}``. For a tableau of the family ``rk``, the integer 4 means the same as ``{"rk": 4}``."""


def runge_kutta(A: object, b: object, c: object = None, bhat: object = None) -> Data:
    """Return the keys and values of the tableau file of a Runge-Kutta method. The method has the matrix A,
    the weights b, the abscissae c and the embedded weights ``bhat``.

    The matrix A with s rows is given in one of three forms:

    - Each row has s entries.
    - Row i has i entries, for i = 1, ..., s. The omitted entries above the diagonal are zero.
    - Row i has i - 1 entries, for i = 1, ..., s. The omitted entries on and above the diagonal are zero.

    Raises :class:`~orderconds.errors.TableauError` for a wrong entry, or if the lengths do not match.

    >>> runge_kutta([[], [0.5]], [0, 1])
    {'family': 'rk', 'A': [[], ['0.5']], 'b': [0, 1]}
    """
    weights, rows = row(b, "b"), matrix(A, "A")
    _require_triangular_or_full(rows, len(weights))
    data: Data = {"family": "rk", "A": rows, "b": weights}
    if c is not None:
        data["c"] = row(c, "c")
    if bhat is not None:
        data["embedded"] = {"b": row(bhat, "bhat"), "order": 1}
        if len(data["embedded"]["b"]) != len(weights):
            raise TableauError(
                f"bhat has {len(data['embedded']['b'])} entries, b has {len(weights)} entries",
                where="bhat",
                expected="bhat with as many entries as b",
            )
    return data


def _require_triangular_or_full(rows: list[list[Coefficient]], stages: int) -> None:
    """Raise TableauError unless the rows of A form a square or a triangle with ``stages`` rows."""
    lengths = [len(x) for x in rows]
    shapes = ([stages] * stages, list(range(stages)), list(range(1, stages + 1)))
    if len(rows) != stages:
        raise TableauError(
            f"A has {len(rows)} rows, b has {stages} entries",
            where="A",
            expected="a square A: one row for each entry of b",
        )
    if lengths not in shapes:
        raise TableauError(
            f"row lengths {', '.join(map(str, lengths))}",
            where="A",
            expected=f"{stages} rows of {stages} entries, or rows of "
            f"{', '.join(map(str, shapes[1]))} entries for an explicit method",
        )


def commutator_free(
    stages: object,
    update: object,
    starts: Mapping[int, int] | None = None,
    embedded: object = None,
) -> Data:
    """Return the keys and values of the tableau file of a commutator-free method.

    ``stages`` contains one list of exponentials for each stage, and ``update`` is a list of exponentials. The
    first exponential of a list acts first. An exponential is a row of coefficients, one for each stage. Zeros
    at the end of a row may be omitted. By default, the exponentials of a stage act on y0. If the exponentials
    of stage i act on an earlier stage j, ``starts`` maps i to j. Stages are counted from 1. ``embedded`` is
    the update of the embedded method.

    >>> commutator_free([[], [[0.5]]], [[[0, 1]]])
    Traceback (most recent call last):
    orderconds.errors.TableauError: update[1][1]: [0, 1] of type list; expected a number: each exponential \
is a list of numbers, and a stage or an update is a list of exponentials
    >>> commutator_free([[], [[0.5]]], [[0, 1]])["stage"]
    [{}, {'exp': [['0.5']]}]
    """
    products = [_product(x, f"stages[{i}]") for i, x in enumerate(_listed(stages), start=1)]
    for stage, start in _starts(starts, len(products)):
        products[stage - 1]["from"] = start
    data: Data = {"family": "cf", "stage": products, "update": _product(update, "update")}
    if embedded is not None:
        data["embedded"] = {**_product(embedded, "embedded"), "order": 1}
    return data


def _starts(starts: object, stages: int) -> list[tuple[int, int]]:
    """Return a pair (i, j) for each key i and value j of the dictionary ``starts``. The exponentials of stage
    i act on the value of stage j. Raises TableauError if i or j is not the number of a stage."""
    if starts is None:
        return []
    if not isinstance(starts, Mapping):
        raise TableauError(
            described(starts),
            where="starts",
            expected="a mapping from stages to earlier stages, such as {4: 2}",
        )
    return [
        (integer(stage, "starts", (1, stages)), integer(start, f"starts[{stage}]", (1, stages)))
        for stage, start in starts.items()
    ]


def _listed(stages: object) -> list[object]:
    if not isinstance(stages, list | tuple):
        raise TableauError(
            f"stages of type {type(stages).__name__}",
            where="stages",
            expected="a list with one list of exponentials for each stage",
        )
    return list(stages)


def _product(rows: object, where: str) -> Data:
    try:
        exponentials = matrix(rows, where)
    except TableauError as problem:
        if "of type list" in problem.found:
            problem.expected = (
                "a number: each exponential is a list of numbers, and a stage or an update is a list of "
                "exponentials"
            )
        raise
    return {"exp": exponentials} if exponentials else {}


def named(data: Data, name: str, source: str, claims: Claimed) -> Data:
    """Return ``data`` with the keys ``name``, ``source`` and ``claims`` added. An empty ``source`` is not
    added. If ``claims`` is None, the key ``claims`` is not added.

    >>> named({"family": "rk"}, "m", "", {"rkmk(1)": 3, "explicit": True})["claims"]
    {'rkmk': [{'cutoff': 1, 'order': 3}], 'explicit': True}
    >>> named({"family": "rk"}, "m", "a paper", 4)
    {'name': 'm', 'family': 'rk', 'source': 'a paper', 'claims': {'rk': 4}}
    """
    result: Data = {"name": name, **data}
    if source:
        result["source"] = source
    if claims is None:
        return result
    table: Data = {}
    for label, value in _claimed(claims, data["family"]).items():
        with_cutoff = re.fullmatch(r"(\w+)\((\d+)\)", label)
        if with_cutoff is None:
            table[label] = value
        else:
            entry = {"cutoff": int(with_cutoff[2]), "order": value}
            table.setdefault(with_cutoff[1], []).append(entry)
    return result | {"claims": table}


def _claimed(claims: object, family: str) -> dict[str, int | bool]:
    """Check the claims and return the claims as a dictionary."""
    if isinstance(claims, numbers.Integral) and not isinstance(claims, bool):
        claims = {family: claims}
    if not isinstance(claims, Mapping):
        raise TableauError(
            described(claims),
            where="claims",
            expected='the order, or a mapping such as {"rk": 4, "explicit": True}',
        )
    return {
        text(label, "claims", 'a family or property, given as a string such as "rk"'): x
        if isinstance(x, bool)
        else integer(x, f"claims[{label!r}]", CONDITION_ORDER)
        for label, x in claims.items()
    }
