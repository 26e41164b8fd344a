"""Checks of the arguments that users pass to integrators: numbers, counts and times."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise
from numbers import Complex, Integral, Number, Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST = 2**63 - 1
"""The largest number of steps, lattice sites or grid points that emitted C accepts."""


def real(x: object, name: str) -> float:
    """Return ``x`` as a float.

    TypeError is raised for text, for a complex number, and for an object that ``float`` does not accept.
    ValueError is raised if ``x`` is too large for a finite float.

    >>> real("0.1", "h")
    Traceback (most recent call last):
    TypeError: expected a real number for h, found '0.1' of type str
    """
    if type(x) is float:
        return x
    text = isinstance(x, str | bytes)
    if not text and (isinstance(x, Real) or not isinstance(x, Complex)):
        try:
            return float(x)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            pass
        except OverflowError:
            raise ValueError(f"expected a number between -1.8e308 and 1.8e308 for {name}") from None
    raise TypeError(f"expected a real number for {name}, found {described(x)}")


def count(x: object, name: str, least: int = 0) -> int:
    """Return ``x`` as an int.

    TypeError is raised if ``x`` is not an integer. ValueError is raised if ``x`` is below ``least`` or above
    :data:`MOST`.

    >>> count(2.0, "steps")
    Traceback (most recent call last):
    TypeError: expected an integer for steps, found 2.0 of type float
    """
    if not isinstance(x, Integral) or isinstance(x, bool):
        raise TypeError(f"expected an integer for {name}, found {described(x)}")
    number = int(x)
    if not least <= number <= MOST:
        bound = f"at least {least}" if number < least else f"at most {MOST}"
        given = number if abs(number) < 10**30 else "a number with more than 30 digits"
        raise ValueError(f"expected {name} to be {bound}, found {given}")
    return number


def input_values(inputs: object, amount: int) -> tuple[float, ...]:
    """Return ``inputs``, the values of the run-time inputs, as floats.

    TypeError is raised if ``inputs`` is not a sequence of ``amount`` real numbers.

    >>> input_values([1, 2], 3)
    Traceback (most recent call last):
    TypeError: expected 3 inputs, found 2
    """
    scalar = getattr(inputs, "ndim", 1) == 0
    if isinstance(inputs, str | bytes) or not isinstance(inputs, Iterable) or scalar:
        raise TypeError(f"expected a sequence of numbers for inputs, found {described(inputs)}")
    values = tuple(real(x, "inputs") for x in inputs)
    if len(values) != amount:
        raise TypeError(f"expected {amount} inputs, found {len(values)}")
    return values


def monotone(t: float, times: object) -> list[float]:
    """Return the output times of a run that starts at the time ``t``, as floats.

    ValueError is raised if a time is not finite, or if the sequence t, times[0], times[1], ... is not
    monotone. TypeError is raised if ``times`` is not a sequence of numbers.

    >>> monotone(0.0, [0, 1])
    [0.0, 1.0]
    """
    scalar = getattr(times, "ndim", 1) == 0
    if isinstance(times, str | bytes) or not isinstance(times, Iterable) or scalar:
        raise TypeError(f"expected a sequence of times for t_eval, found {described(times)}")
    given = [real(x, "t_eval") for x in times]
    steps = [b - a for a, b in pairwise([t, *given])]
    one_way = all(x >= 0 for x in steps) or all(x <= 0 for x in steps)
    if not one_way or not all(map(math.isfinite, given)):
        raise ValueError(
            f"expected finite times in t_eval, in increasing or decreasing order from t = {t}; sort the times"
        )
    return given


def end_of_run(t: float, end: object, times: Sequence[float]) -> float:
    """Return the end time of a run that starts at the time ``t``.

    If ``end`` is None, the run ends at the last of the output times ``times``. TypeError is raised if ``end``
    is None and there are no output times. ValueError is raised if the run would end before the last output
    time.

    >>> end_of_run(0.0, None, [0.5, 1.0])
    1.0
    """
    if end is None and not times:
        raise TypeError("the argument 'end' is missing; expected the time at which the run ends")
    last = real(times[-1] if end is None else end, "end")
    if times and (last - times[-1]) * (times[-1] - t) < 0:
        raise ValueError(
            f"expected a run that reaches {times[-1]}, the last time in t_eval, found end = {last}"
        )
    return last


def described(x: object) -> str:
    """Return the type of an argument. For a number or a text, the result also contains the value.

    >>> described(1j), described(iter(()))
    ('1j of type complex', 'an object of type tuple_iterator')
    """
    if not isinstance(x, Number | str | bytes):
        return f"an object of type {type(x).__name__}"
    try:
        shown = str(x) if isinstance(x, Number) else repr(x)
    except ValueError:  # raised by ``str`` for an integer with thousands of digits
        shown = "a number"
    return f"{shown if len(shown) <= 60 else shown[:60] + ' ...'} of type {type(x).__name__}"


def real_array(given: object, content: str) -> NDArray[Any]:
    """Return ``given`` as an array of real numbers.

    ValueError is raised for rows of different lengths, and TypeError for entries that are not real numbers.
    ``content`` is a word for the entries in error messages, such as "values".
    """
    import numpy as np

    try:
        array: NDArray[np.generic] = np.asarray(given)
    except ValueError:
        raise ValueError(f"expected an array of {content}, found rows of different lengths") from None
    if array.dtype.kind not in "fiub":
        raise TypeError(f"expected real numbers, found {described(given)}")
    return array
