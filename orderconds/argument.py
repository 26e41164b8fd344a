"""Checks of the types and bounds of function arguments. The error messages name the argument."""

from __future__ import annotations

import math
import numbers
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager

from orderconds.errors import InputError

Bounds = tuple[int, int]

CONDITION_ORDER = (1, 20)
"""The least and the largest order whose conditions can be derived or checked."""
EXPANDED_STAGES = (1, 12)
"""The least and the largest number of stages for which the sums in the conditions can be expanded."""
TREE_ORDER = (1, 40)
CONSTRUCTED_STAGES = (1, 50)
DIGITS = (10, 1000)
"""The least and the largest number of decimal places of refined coefficients."""
TOLERANCE = (0, 2**40)
"""The least and the largest value of the argument ``tolerance``.

The tolerance is the uncertainty of each double x, in units of 2^-53 max(1, |x|).
"""
SOLVED_STAGES = (1, 40)
SOLVED_ORDER = (1, 12)
EXPONENTIALS = (1, 12)
STARTS = (1, 10**7)
SEED = (0, 2**31)
PROCESSES = (1, 256)


def integer(x: object, name: str, bounds: Bounds) -> int:
    """Return ``x`` if it is an integer between the bounds. Raises InputError for any other object.

    >>> integer(2.0, "stages", (1, 50))
    Traceback (most recent call last):
    orderconds.errors.InputError: stages: 2.0 of type float; expected an integer from 1 to 50
    """
    least, most = bounds
    if isinstance(x, numbers.Integral) and not isinstance(x, bool) and least <= int(x) <= most:
        return int(x)
    raise InputError(described(x), where=name, expected=f"an integer from {least} to {most}")


def real(x: object, name: str, bounds: tuple[float, float]) -> float:
    """Return ``x`` as a float if it is a real number between the bounds.

    Raise InputError for all other values.

    >>> real(-1, "tolerance", (0, 8))
    Traceback (most recent call last):
    orderconds.errors.InputError: tolerance: -1; expected a number from 0 to 8
    """
    least, most = bounds
    if isinstance(x, numbers.Real) and not isinstance(x, bool):
        try:
            if least <= float(x) <= most:
                return float(x)
        except OverflowError:
            pass
    largest = "" if math.isinf(most) else f" to {most}"
    raise InputError(described(x), where=name, expected=f"a number from {least}{largest}")


def text(x: object, name: str, expected: str) -> str:
    """Return ``x`` if it is a string. Raises InputError for any other object.

    >>> text(3, "family", "the name of a family")
    Traceback (most recent call last):
    orderconds.errors.InputError: family: 3; expected the name of a family
    """
    if isinstance(x, str):
        return x
    raise InputError(described(x), where=name, expected=expected)


def texts(x: object, name: str, example: str) -> tuple[str, ...]:
    """Return the strings in the iterable ``x`` as a tuple.

    Raise InputError if ``x`` is a single string, a mapping, or not an iterable of strings.

    >>> texts("a21=1", "fix", "a21=1/2")
    Traceback (most recent call last):
    orderconds.errors.InputError: fix: 'a21=1' of type str; expected a list of strings such as ["a21=1/2"]
    """
    expected = f'a list of strings such as ["{example}"]'
    if isinstance(x, str | bytes | Mapping) or not isinstance(x, Iterable):
        raise InputError(described(x), where=name, expected=expected)
    return tuple(text(entry, name, expected) for entry in x)


@contextmanager
def named_as_arguments() -> Iterator[None]:
    """In the InputErrors of a ``with`` block, replace option names such as ``--fix`` by argument names.

    >>> with named_as_arguments():
    ...     raise InputError("the prefix '1a'", where="--prefix", expected="a letter")
    Traceback (most recent call last):
    orderconds.errors.InputError: prefix: the prefix '1a'; expected a letter
    """
    try:
        yield
    except InputError as error:
        for part in ("found", "where", "expected", "hint"):
            setattr(error, part, _OPTION.sub(lambda match: match[1].replace("-", "_"), getattr(error, part)))
        raise


_OPTION = re.compile(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)")


def described(x: object) -> str:
    """Return the text that describes an object in a message.

    >>> described(None), described("4"), described(0)
    ('an object of type NoneType', "'4' of type str", '0')
    """
    if type(x) is int:
        return str(x) if abs(x) < 10**30 else "an integer of more than 30 digits"
    if isinstance(x, str | bytes | bool | float | complex):
        shown = repr(x)
        return f"{shown if len(shown) <= 60 else shown[:60] + ' ...'} of type {type(x).__name__}"
    return f"an object of type {type(x).__name__}"
