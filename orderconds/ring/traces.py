"""A ring that records arithmetic operations as a straight-line program, a program without branches and loops.

The program can be evaluated later for any values of the inputs. Equal operations are recorded once. Sums,
products and quotients of two constants are not recorded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from orderconds.ring.power import power
from orderconds.ring.protocol import Element, RingWithRoots

ADD, MULTIPLY, DIVIDE, ROOT, CONSTANT, INPUT = range(6)
"""The kinds of operations."""


@dataclass(frozen=True)
class Operation:
    """One operation of a recorded program.

    ``left`` and ``right`` are the indices of the operations that compute the operands. The two indices are
    equal for a root. A constant or an input does not use ``left`` and ``right``. The meaning of ``value``
    depends on ``kind``:

    - CONSTANT: the rational number.
    - INPUT: the position of the input among all inputs.
    - ROOT: n for the n-th root.
    """

    kind: int
    left: int = 0
    right: int = 0
    value: Fraction = Fraction(0)


class Traces:
    """A ring whose arithmetic is recorded as a program with ``width`` inputs. An element is a constant or the
    result of an operation.

    In the example, the program has two inputs (kind INPUT = 5), a sum (ADD = 0) and a product (MULTIPLY = 1).
    The product 0 * x is the constant 0 and is not recorded.

    >>> R = Traces(2)
    >>> x, y = R.inputs
    >>> z = (x + y) * (x + y) - 0 * x
    >>> [operation.kind for operation in R.operations]
    [5, 5, 0, 1]
    >>> R.is_zero(z), R.is_zero(R.zero)
    (False, True)
    """

    def __init__(self, width: int) -> None:
        self.name = f"traces({width})"
        self.operations: list[Operation] = []
        self._places: dict[Operation, int] = {}
        self.inputs = tuple(self._record(Operation(INPUT, value=Fraction(i))) for i in range(width))
        self.zero = Trace(self, -1, Fraction(0))
        self.one = Trace(self, -1, Fraction(1))

    def _record(self, operation: Operation) -> Trace:
        place = self._places.get(operation)
        if place is None:
            place = self._places[operation] = len(self.operations)
            self.operations.append(operation)
        return Trace(self, place)

    def rational(self, p: int, q: int = 1) -> Trace:
        """Return the constant p/q. The constant is recorded together with the first operation that uses
        it."""
        return Trace(self, -1, Fraction(p, q))

    def is_zero(self, x: Trace) -> bool:
        """Return True if x is the constant zero. If x is the result of a recorded operation, return False."""
        return x.constant == 0

    def text(self, x: Trace) -> str:
        """Return the rational number as text if x is a constant. Return ``%n`` if x is the result of the
        operation with index n."""
        return str(x.constant) if x.constant is not None else f"%{x.place}"

    def key(self, x: Trace) -> tuple[str]:
        """Return the text of x in a tuple, as a sort key. Different elements have different texts."""
        return (self.text(x),)

    def approximate(self, x: Trace, digits: int = 20) -> str:
        """Return ``text(x)``. The argument ``digits`` has no effect on the result."""
        return self.text(x)

    def apply(self, kind: int, x: Trace, y: Trace) -> Trace:
        """Record the sum, product or quotient of two elements, and return the result as an element. ``kind``
        is ADD, MULTIPLY or DIVIDE."""
        left, right = x.placed(), y.placed()
        if kind != DIVIDE and left > right:
            left, right = right, left
        return self._record(Operation(kind, left, right))

    def root(self, x: Trace, index: int) -> Trace:
        """Return the element x^(1/``index``)."""
        place = x.placed()
        return self._record(Operation(ROOT, place, place, Fraction(index)))

    def constant(self, value: Fraction) -> int:
        """Record a constant as an operation, and return the index of the operation."""
        return self._record(Operation(CONSTANT, value=value)).place


class Trace:
    """An element of the ring :class:`Traces`: a rational number, or the result of a recorded operation. If
    the element is a result, ``place`` is the index of the operation, and ``constant`` is None."""

    __slots__ = ("constant", "place", "ring")

    def __init__(self, ring: Traces, place: int, constant: Fraction | None = None) -> None:
        self.ring, self.place, self.constant = ring, place, constant

    def __repr__(self) -> str:
        return self.ring.text(self)

    def placed(self) -> int:
        """Return the index of the operation whose result is this element. If the element is a constant,
        record an operation CONSTANT, and return the index of this operation."""
        return self.place if self.constant is None else self.ring.constant(self.constant)

    def _lift(self, x: Element) -> Trace:
        return x if isinstance(x, Trace) else Trace(self.ring, -1, Fraction(x))  # x is a Trace or an int

    def __add__(self, other: Element) -> Trace:
        y = self._lift(other)
        if self.constant is not None and y.constant is not None:
            return Trace(self.ring, -1, self.constant + y.constant)
        if self.constant == 0:
            return y
        return self if y.constant == 0 else self.ring.apply(ADD, self, y)

    __radd__ = __add__

    def __neg__(self) -> Trace:
        return self * -1

    def __sub__(self, other: Element) -> Trace:
        return self + -self._lift(other)

    def __rsub__(self, other: Element) -> Trace:
        return (-self).__add__(other)

    def __mul__(self, other: Element) -> Trace:
        y = self._lift(other)
        if self.constant is not None and y.constant is not None:
            return Trace(self.ring, -1, self.constant * y.constant)
        if self.constant == 0 or y.constant == 0:
            return self.ring.zero
        if self.constant == 1:
            return y
        return self if y.constant == 1 else self.ring.apply(MULTIPLY, self, y)

    __rmul__ = __mul__

    def __truediv__(self, other: Element) -> Trace:
        y = self._lift(other)
        if y.constant is not None:
            return self * (1 / y.constant)
        return self.ring.zero if self.constant == 0 else self.ring.apply(DIVIDE, self, y)

    def __rtruediv__(self, other: Element) -> Trace:
        return self._lift(other) / self

    def __pow__(self, n: int) -> Trace:
        return power(self, n, self.ring.one)


def evaluate(
    operations: Sequence[Operation], inputs: Sequence[Element], ring: RingWithRoots
) -> list[Element]:
    """Return the results of all ``operations``, computed in ``ring`` for the given ``inputs``. If the
    operations contain quotients or roots, ``ring`` must support them.

    >>> from orderconds.ring import QQ
    >>> R = Traces(1)
    >>> y = R.inputs[0] * R.inputs[0] / 3
    >>> evaluate(R.operations, [QQ.rational(3)], QQ)[y.place]
    3
    """
    values: list[Element] = []
    for operation in operations:
        if operation.kind == INPUT:
            values.append(inputs[int(operation.value)])
        elif operation.kind == CONSTANT:
            values.append(ring.rational(operation.value.numerator, operation.value.denominator))
        elif operation.kind == ADD:
            values.append(values[operation.left] + values[operation.right])
        elif operation.kind == MULTIPLY:
            values.append(values[operation.left] * values[operation.right])
        elif operation.kind == ROOT:
            values.append(ring.root(values[operation.left], int(operation.value)))
        else:
            values.append(values[operation.left] / values[operation.right])
    return values
