"""The interface of scalar rings.

Elements define the operators ``+ - *`` and unary ``-``. Elements of a field also define ``/``. In an
operation with two operands, one operand may be a Python ``int``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import numpy as np

Element = Any
"""An element of a ring, or a Python ``int``. Some rings use flint, mpmath or NumPy objects as elements."""

Key = tuple[Any, ...]
"""A hashable sort key of an element, comparable with the keys of elements of the same ring."""


class Ring(Protocol):
    """A commutative ring into which rational numbers can be converted."""

    name: str
    zero: Element
    one: Element

    def rational(self, p: int, q: int = 1) -> Element:
        """Return p/q in this ring."""

    def is_zero(self, x: Element) -> bool | None:
        """Return True if x = 0, False if x differs from 0, and None if the ring cannot decide. For example,
        the result is None for a ball that contains zero and other numbers."""

    def text(self, x: Element) -> str:
        """Return x as text. If the grammar of tableau files can express x, the text follows this grammar."""

    def key(self, x: Element) -> Key:
        """Return a hashable sort key. Equal elements have equal keys."""

    def approximate(self, x: Element, digits: int = 20) -> str:
        """Return x as a decimal, correctly rounded to ``digits`` significant digits."""


class RingWithRoots(Ring, Protocol):
    """A ring in which real roots of elements can be computed."""

    def root(self, x: Element, index: int) -> Element:
        """Return the real ``index``-th root of x."""


class RealRing(Ring, Protocol):
    """A ring of real numbers. Each element has a nearest double."""

    def nearest_float(self, x: Element) -> float:
        """Return the double nearest to x."""


class RandomRing(Ring, Protocol):
    """A ring that can generate random elements."""

    def random(self, generator: np.random.Generator) -> Element:
        """Return a random element."""
