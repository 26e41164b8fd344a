"""The forms of a state: a flat sequence, a NumPy array of any shape, or a tuple such as (q, mu).

A compiled step reads and writes one flat list of numbers. A :class:`StateForm` stores the form in which the
caller passed the state, and returns results in this form. Matrices are flattened by rows. A batch is an array
with a state in each row, or a tuple of such arrays.

A tuple must contain the parts in the order of the manifest of the emitted module. An exchange of two parts of
equal size is not detected.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

from codegen.argument import described, real

State = Any
"""A sequence of floats, a NumPy array, or a tuple of sequences and arrays."""

Fields = tuple[tuple[str, int], ...]
"""The name and the size of each part of a state, in the order of the parts in the state.

If the parts are unknown, the tuple is empty.
"""


@dataclass(frozen=True)
class StateForm:
    """The form in which a caller passed a state.

    - ``shapes``: the shape of each part.
    - ``is_tuple``: True if the state was a tuple of its parts.
    - ``arrays``: for each part, True if it was a NumPy array, and False if it was a list.
    """

    shapes: tuple[tuple[int, ...], ...]
    is_tuple: bool
    arrays: tuple[bool, ...]

    def restore(self, values: Sequence[Any]) -> Any:
        """Return ``values`` with the shapes and types of the caller's state.

        ``values`` is one flat state or a list of flat states.
        """
        if not self.is_tuple and self.shapes == ((len(values),),) and not self.arrays[0]:
            return list(values)
        import numpy as np

        table = np.array(values, dtype=float)
        if not table.size:  # an empty list of states
            table = np.empty((0, sum(map(math.prod, self.shapes))))
        rows, parts, start = table.shape[:-1], [], 0
        for shape, array in zip(self.shapes, self.arrays, strict=True):
            end = start + math.prod(shape)
            part = table[..., start:end].reshape(*rows, *shape)
            parts.append(part if array else part.tolist())
            start = end
        return tuple(parts) if self.is_tuple else parts[0]

    def matrix(self, rows: Sequence[Sequence[float]]) -> Any:
        """Return ``rows`` as a NumPy array if a part of the state is a NumPy array, else as a list."""
        if not any(self.arrays):
            return list(rows)
        import numpy as np

        return np.array(rows, dtype=float)


def read(state: State, size: int, fields: Fields = ()) -> tuple[StateForm, list[float]]:
    """Return the form of a state, and the flat list of the numbers in the state.

    ValueError is raised if the state does not consist of ``size`` real numbers. ValueError is also raised if
    the state is a tuple and the sizes of its entries do not match ``fields``. An entry matches one field, or
    several consecutive fields together: if the fields have 4, 2 and 3 numbers, the tuple may have entries of
    6 and 3 numbers. If there are fewer than two fields, the sizes of the entries are not checked.

    >>> form, numbers = read(([[1, 0], [0, 1]], [2, 3]), 6)
    >>> numbers, form.restore(numbers)
    ([1.0, 0.0, 0.0, 1.0, 2.0, 3.0], ([[1.0, 0.0], [0.0, 1.0]], [2.0, 3.0]))
    >>> read(([2, 3], [[1, 0], [0, 1]]), 6, (("q", 4), ("mu", 2)))
    Traceback (most recent call last):
    ValueError: expected a state with parts of 4 and 2 numbers (in the order q, mu), found parts of \
2 and 4 numbers
    """
    is_tuple = isinstance(state, tuple) and any(map(_has_entries, state))
    parts = tuple(state) if is_tuple else (state,)
    shapes, numbers, sizes = [], [], []
    for part in parts:
        shape, entries = _flat(part)
        shapes.append(shape)
        sizes.append(len(entries))
        numbers += entries
    if is_tuple:
        _require_fields(sizes, fields)
    if len(numbers) != size:
        raise ValueError(f"expected {size} numbers in state, found {len(numbers)}{_fields_text(fields)}")
    return StateForm(tuple(shapes), is_tuple, tuple(map(_is_array, parts))), numbers


def _require_fields(sizes: Sequence[int], fields: Fields) -> None:
    """Raise ValueError if the entries of a state tuple do not match the fields of a state.

    For each entry of the tuple, ``sizes`` contains the number of components of this entry. An entry matches
    one field, or several consecutive fields together. If ``fields`` has fewer than two elements, no error is
    raised.
    """
    if len(fields) < 2 or sum(sizes) != sum(size for _, size in fields):
        return
    ends = set(accumulate(size for _, size in fields))
    if not ends.issuperset(accumulate(sizes)):
        names, known = ", ".join(name for name, _ in fields), _listed([size for _, size in fields])
        raise ValueError(
            f"expected a state with parts of {known} numbers (in the order {names}), found parts of "
            f"{_listed(sizes)} numbers"
        )


def _listed(sizes: Sequence[int]) -> str:
    *first, last = map(str, sizes)
    return f"{', '.join(first)} and {last}" if first else last


def _fields_text(fields: Fields) -> str:
    """Return the end of an error message: the names and sizes of the fields, or nothing."""
    return f"; a state is {', '.join(f'{name} ({size} numbers)' for name, size in fields)}" if fields else ""


@dataclass(frozen=True)
class Batch:
    """The states of a batch. The method :meth:`joined` combines the results of all states into one result."""

    states: tuple[State, ...]

    def joined(self, results: Sequence[Any]) -> Any:
        """Return the results of all states in one array. If each result is a tuple, return a tuple of arrays.

        Entry i of each array belongs to state i of the batch.
        """
        import numpy as np

        if isinstance(results[0], tuple):
            return tuple(np.array(part) for part in zip(*results, strict=True))
        return np.array(results)


def batch_of(state: State, size: int, fields: Fields = ()) -> Batch | None:
    """Return the states in ``state`` as a :class:`Batch`, or None if ``state`` is not a batch.

    A batch is an array that contains one state of ``size`` numbers in each row. If a state has several parts,
    for example q and mu, a batch can also be a tuple with one array for each part. Then row k of each array
    belongs to state k. If the arrays of a tuple do not match ``fields``, ValueError is raised.

    >>> batch_of([[1, 0, 0], [0, 1, 0]], 3).states
    ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    >>> batch_of([[1, 0], [0, 1]], 4) is None
    True
    """
    is_tuple = isinstance(state, tuple) and any(map(_has_entries, state))
    parts = tuple(state) if is_tuple else (state,)
    if not all(_nested(part) for part in parts):
        return None
    import numpy as np

    try:
        tables = [np.array(part, dtype=float) for part in parts]
    # NumPy raises these errors for rows of different lengths and for complex entries.
    except (TypeError, ValueError):
        return None
    count = len(tables[0])
    if sum(table.size for table in tables) == size or any(len(table) != count for table in tables):
        return None
    if sum(table.size for table in tables) != count * size or not count:
        return None
    if is_tuple:
        _require_fields([table.size // count for table in tables], fields)
        return Batch(tuple(zip(*tables, strict=True)))
    array = _is_array(state)
    return Batch(tuple(row if array else row.tolist() for row in tables[0]))


def _nested(part: object) -> bool:
    """Return True if a part of a state is an array with at least two axes, or a sequence of sequences."""
    if _is_array(part):
        return bool(getattr(part, "ndim", 0) > 1)
    return isinstance(part, list | tuple) and bool(part) and _has_entries(part[0])


def _has_entries(part: object) -> bool:
    """Return True if ``part`` is a list, a tuple, or an array with at least one axis."""
    return getattr(part, "ndim", 0) > 0 if _is_array(part) else isinstance(part, list | tuple)


def _flat(part: Any) -> tuple[tuple[int, ...], list[float]]:
    """Return the shape and the numbers of a part of a state.

    ValueError is raised for rows of different lengths, and for entries that are not real numbers.
    """
    if not _has_entries(part):
        return (), [_real(part)]
    if not _is_array(part) and not _nested(part):
        numbers = [_real(x) for x in part]
        return (len(numbers),), numbers
    import numpy as np

    try:
        table = np.asarray(part)
    except ValueError:
        raise ValueError(
            "expected rows of equal lengths in state, found rows of different lengths; if the parts of the "
            "state have different shapes, write one tuple of all parts, such as (q, mu)"
        ) from None
    if table.dtype.kind not in "fiub":
        raise ValueError(f"expected real numbers in state, found an array of type {table.dtype}")
    return table.shape, [float(x) for x in table.ravel()]


def _real(x: object) -> float:
    try:
        return real(x, "state")
    except (TypeError, OverflowError):
        raise ValueError(
            f"expected real numbers in state, found {described(x)}; write a list, a NumPy array, or a tuple "
            "of lists or arrays"
        ) from None


def _is_array(part: object) -> bool:
    return type(part).__module__ == "numpy"
