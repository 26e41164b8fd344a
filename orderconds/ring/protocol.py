"""The interface of scalar rings, so that one algorithm works over exact, certified, symbolic and numeric
scalars.

Elements carry their own arithmetic: ``+ - *`` among themselves and with Python ``int`` on either side, unary
``-``, and ``/`` where the ring is a field. Everything else goes through the ring object.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import numpy as np

Element = Any
"""An element of some ring, or a second operand. Rings are duck-typed, so objects of flint, mpmath and NumPy
need no wrapper. Only this alias and :data:`Key` leave the types of a ring open."""

Key = tuple[Any, ...]
"""A key by which elements of one ring are compared: hashable, and totally ordered within the ring."""


class Ring(Protocol):
    """A commutative ring over the rationals."""

    name: str
    zero: Element
    one: Element

    def rational(self, p: int, q: int = 1) -> Element:
        """Return p/q in this ring."""

    def is_zero(self, x: Element) -> bool | None:
        """Decide x = 0; None if the ring cannot decide (a ball that contains zero never proves zero)."""

    def text(self, x: Element) -> str:
        """Return x as exact text, in the grammar of tableau files where the grammar can express x."""

    def key(self, x: Element) -> Key:
        """Return a hashable, totally ordered key; equal elements of this ring have equal keys."""

    def approximate(self, x: Element, digits: int = 20) -> str:
        """Return x as a decimal with that many significant digits, correctly rounded."""


class RingWithRoots(Ring, Protocol):
    """A ring in which real roots of elements can be taken."""

    def root(self, x: Element, index: int) -> Element:
        """Return the real ``index``-th root of x."""


class RealRing(Ring, Protocol):
    """A ring of real numbers, each of which has a nearest double."""

    def nearest_float(self, x: Element) -> float:
        """Return the double nearest to x."""


class RandomRing(Ring, Protocol):
    """A ring with random elements."""

    def random(self, generator: np.random.Generator) -> Element:
        """Return a random element."""
