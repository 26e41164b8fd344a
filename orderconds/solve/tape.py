"""Evaluation of recorded operations (:mod:`orderconds.ring.traces`) with numpy. Values and Jacobians are
computed at many points at once.

The operations are sorted into levels that depend only on earlier levels. The Jacobian is computed by forward
differentiation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from orderconds.ring.traces import ADD, CONSTANT, DIVIDE, INPUT, MULTIPLY, ROOT, Operation, Trace

MOST_SLOPES = 1 << 24
"""The largest number of derivatives in memory at one time (128 MiB)."""

Floats = NDArray[np.float64]
Places = NDArray[np.int64]


@dataclass(frozen=True)
class _Level:
    """A group of operations of one kind that do not depend on each other.

    The results fill the rows ``start`` to ``stop`` - 1 of an array with one row for each operation. ``left``
    and ``right`` contain the row numbers of the first and the second operands.
    """

    kind: int
    start: int
    stop: int
    left: Places
    right: Places
    index: Places
    """The degrees of the roots (2 for a square root). Only operations of the kind ROOT use them."""


class Tape:
    """A recorded program that computes outputs from ``width`` inputs, in double precision.

    All ``outputs`` are elements of one ring :class:`~orderconds.ring.traces.Traces`.

    >>> from orderconds.ring.traces import Traces
    >>> R = Traces(2)
    >>> x, y = R.inputs
    >>> tape = Tape([x * y - 1, x / y], 2)
    >>> tape.values(np.array([[4.0, 2.0], [1.0, 1.0]])).tolist()
    [[7.0, 2.0], [0.0, 1.0]]
    >>> tape.jacobians(np.array([[4.0, 2.0]]))[1].tolist()
    [[[2.0, 4.0], [0.5, -1.0]]]
    """

    def __init__(self, outputs: Sequence[Trace], width: int) -> None:
        self.width, self.size = width, len(outputs)
        operations = outputs[0].ring.operations if outputs else []
        # The method ``placed`` may append a constant to the list ``operations``. Therefore ``placed`` is
        # called before the list ``operations`` is passed to a function.
        wanted = [x.placed() for x in outputs]
        rows = _order(operations, wanted, width) if outputs else []
        self._levels = _levels(operations, rows)
        place = {operation: row for row, operation in enumerate(rows)}
        self._inputs = [
            (row, int(operations[p].value)) for row, p in enumerate(rows) if operations[p].kind == INPUT
        ]
        self._constants = [
            (row, float(operations[p].value)) for row, p in enumerate(rows) if operations[p].kind == CONSTANT
        ]
        self._outputs = np.array([place[p] for p in wanted], dtype=np.int64)
        self.length = len(rows)

    def _start(self, points: Floats) -> Floats:
        values = np.empty((self.length, points.shape[0]))
        for row, number in self._inputs:
            values[row] = points[:, number]
        for row, value in self._constants:
            values[row] = value
        return values

    def _forward(self, points: Floats) -> Floats:
        values = self._start(points)
        # Residuals can overflow if a search diverges.
        with np.errstate(all="ignore"):
            for level in self._levels:
                out = values[level.start : level.stop]
                if level.kind == ROOT:
                    x = values[level.left]
                    np.copyto(out, np.copysign(np.abs(x) ** (1 / level.index[:, None]), x))
                else:
                    _UFUNC[level.kind](values[level.left], values[level.right], out=out)
        return values

    def values(self, points: Floats) -> Floats:
        """Return the outputs at ``points``, with one row for each point."""
        return np.ascontiguousarray(self._forward(points)[self._outputs].T)

    def jacobians(self, points: Floats) -> tuple[Floats, Floats]:
        """Return the outputs at ``points``, and their derivatives. Entry [k, i, j] of the second array is the
        derivative of output i with respect to input j at point k."""
        part = max(1, MOST_SLOPES // max(1, self.length * self.width))
        if len(points) <= part:
            return self._jacobians(points)
        values = np.empty((len(points), self.size))
        slopes = np.empty((len(points), self.size, self.width))
        for k in range(0, len(points), part):
            values[k : k + part], slopes[k : k + part] = self._jacobians(points[k : k + part])
        return values, slopes

    def _jacobians(self, points: Floats) -> tuple[Floats, Floats]:
        values = self._forward(points)
        slopes = np.zeros((self.length, points.shape[0], self.width))
        for row, number in self._inputs:
            slopes[row, :, number] = 1.0
        with np.errstate(all="ignore"):
            for level in self._levels:
                x, y = level.left, level.right
                out = slopes[level.start : level.stop]
                if level.kind == ADD:
                    np.add(slopes[x], slopes[y], out=out)
                elif level.kind == MULTIPLY:
                    np.multiply(slopes[x], values[y][..., None], out=out)
                    out += slopes[y] * values[x][..., None]
                elif level.kind == ROOT:
                    ratio = values[level.start : level.stop] / (level.index[:, None] * values[x])
                    np.multiply(slopes[x], ratio[..., None], out=out)
                else:
                    np.multiply(slopes[y], -values[level.start : level.stop][..., None], out=out)
                    out += slopes[x]
                    out /= values[y][..., None]
        return (
            np.ascontiguousarray(values[self._outputs].T),
            np.ascontiguousarray(slopes[self._outputs].transpose(1, 0, 2)),
        )


_UFUNC = {ADD: np.add, MULTIPLY: np.multiply, DIVIDE: np.divide}


def _order(operations: Sequence[Operation], wanted: Sequence[int], width: int) -> list[int]:
    """Return the indices of all inputs, and the indices of all operations on which the outputs ``wanted``
    depend. The level of an input or constant is 0. The level of any other operation is larger by 1 than the
    highest level of its operands. The indices are sorted by level, and within each level by kind."""
    needed: set[int] = set(range(width))
    waiting = list(wanted)
    while waiting:
        place = waiting.pop()
        if place not in needed:
            needed.add(place)
            operation = operations[place]
            if operation.kind <= ROOT:
                waiting += (operation.left, operation.right)
    level: dict[int, int] = {}
    for place in sorted(needed):
        operation = operations[place]
        deeper = operation.kind <= ROOT
        level[place] = 1 + max(level[operation.left], level[operation.right]) if deeper else 0
    return sorted(needed, key=lambda place: (level[place], operations[place].kind, place))


def _levels(operations: Sequence[Operation], rows: Sequence[int]) -> list[_Level]:
    place = {operation: row for row, operation in enumerate(rows)}
    depth: list[int] = []
    for p in rows:
        o = operations[p]
        depth.append(1 + max(depth[place[o.left]], depth[place[o.right]]) if o.kind <= ROOT else 0)
    levels, start = list[_Level](), 0
    while start < len(rows):
        kind, stop = operations[rows[start]].kind, start + 1
        while stop < len(rows) and operations[rows[stop]].kind == kind and depth[stop] == depth[start]:
            stop += 1
        if kind <= ROOT:
            left = np.array([place[operations[p].left] for p in rows[start:stop]], dtype=np.int64)
            right = np.array([place[operations[p].right] for p in rows[start:stop]], dtype=np.int64)
            index = np.array([int(operations[p].value) for p in rows[start:stop]], dtype=np.int64)
            levels.append(_Level(kind, start, stop, left, right, index))
        start = stop
    return levels
