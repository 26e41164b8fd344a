"""Batches: one emitted module integrates many independent systems.

The caller passes the N states of a batch as an array with one state in each row. Emitted C needs an array of
shape (size, N), where row k contains component k of each state. In memory, an array of shape (N, size) in
Fortran order already has this layout.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from codegen.argument import described
from codegen.state_form import Fields

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True)
class BatchRun:
    """The final state, the status and the number of completed steps for each system of a batch.

    ``states`` has one row for each system. If a step of a system fails, the row contains the state before the
    failed step.
    """

    states: Floats
    statuses: NDArray[np.int32]
    completed: NDArray[np.uintp]

    @property
    def ok(self) -> bool:
        """True if no system failed."""
        return not self.statuses.any()


def columns(states: object, size: int, real: str, fields: Fields = ()) -> Any:
    """Return the states of a batch as a new array of shape (size, N) with contiguous rows.

    ``real`` is the number format (``double`` or ``float``). ``states`` is an array of N states with ``size``
    numbers each, or a tuple with one array for each part (for example q or mu) of the states. ValueError is
    raised for other values of ``states``, and for N = 0.

    >>> columns([[1, 2, 3], [4, 5, 6]], 3, "double").tolist()
    [[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]]
    >>> columns([1, 2, 3], 3, "double")
    Traceback (most recent call last):
    ValueError: expected an array of N states with 3 numbers each, found an array of shape (3,)
    """
    import numpy as np

    parts = [_array(x) for x in (states if isinstance(states, tuple) else (states,))]
    shapes = " and ".join(str(part.shape) for part in parts)
    if any(part.ndim < 2 or not len(part) or len(part) != len(parts[0]) for part in parts):
        raise ValueError(
            f"expected an array of N states with {size} numbers each, found an array of shape {shapes}"
        )
    flat = [part.reshape(len(part), -1) for part in parts]
    widths = [part.shape[1] for part in flat]
    known = [width for _, width in fields]
    if sum(widths) != size or (len(flat) > 1 and known and widths != known):
        parts_text = (
            f", or a tuple with one array for each part of the states (sizes of the parts: {known})"
            if len(flat) > 1 and known
            else ""
        )
        raise ValueError(
            f"expected an array of N states with {size} numbers each{parts_text}, "
            f"found arrays of shape {shapes}"
        )
    # The array must not share memory with ``states``, because emitted code overwrites the array.
    return np.array(np.concatenate([part.T for part in flat]), dtype=_format(real), order="C")


def in_place(out: object, size: int, real: str) -> Any:
    """Return the view ``out.T`` of the array ``out``. Emitted C requires the layout of this view.

    ValueError is raised unless ``out`` is a writeable, aligned array of shape (N, size) in Fortran order,
    with the number format ``real`` and N > 0.
    """
    import numpy as np

    kind = _format(real)
    given = out if isinstance(out, np.ndarray) else None
    if given is None or given.ndim != 2 or given.shape[1] != size or given.dtype != kind or not len(given):
        shown = described(out) if given is None else f"an array of shape {given.shape} and type {given.dtype}"
        raise ValueError(f"expected an array of shape (N, {size}) and type {kind} for out, found {shown}")
    # A C program may read a number only at an address that is a multiple of the number's size.
    if not given.T.flags.c_contiguous or not given.flags.behaved:
        raise ValueError(
            "expected a writeable, aligned array in Fortran order as the argument out; "
            'numpy.array(states, order="F") returns such an array'
        )
    return given.T


def rows_of(values: Sequence[tuple[str, object]], count: int, real: str) -> Any:
    """Return an array of shape (len(values), count) with one row for each named value.

    A value is one number for all systems, or a sequence with one number for each system.

    >>> rows_of([("b", 2.0), ("nu", [1, 3])], 2, "double").tolist()
    [[2.0, 2.0], [1.0, 3.0]]
    """
    import numpy as np

    result = np.empty((len(values), count), dtype=_format(real))
    for row, (name, value) in zip(result, values, strict=True):
        given = _array(value)
        if given.shape not in ((), (count,)):
            raise ValueError(f"expected one number or {count} numbers for {name}, found shape {given.shape}")
        row[:] = given
    return result


def chosen(
    known: Sequence[str], defaults: Mapping[str, float], given: Mapping[str, object]
) -> list[tuple[str, object]]:
    """Return the name and the value of each parameter in ``known``, from ``given`` or else from ``defaults``.

    TypeError is raised for an unknown name in ``given``, and for a parameter without a value.
    """
    for name in given:
        if name not in known:
            raise TypeError(f"unknown parameter {name}; the parameters are: {', '.join(known) or 'none'}")
    values = {**defaults, **given}
    for name in known:
        if name not in values:
            raise TypeError(f"the parameter {name} has no value")
    return [(name, values[name]) for name in known]


def _array(x: object) -> Any:
    import numpy as np

    try:
        array = np.asarray(x)
    except ValueError:
        raise ValueError("expected rows of equal lengths, found rows of different lengths") from None
    if array.dtype.kind not in "fiub":
        raise ValueError(f"expected real numbers, found {described(x)}")
    return array


def _format(real: str) -> Any:
    import numpy as np

    return np.dtype({"double": np.float64, "float": np.float32}[real])
