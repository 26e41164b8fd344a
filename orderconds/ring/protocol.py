"""What every scalar ring offers, so that one engine serves exact, certified, symbolic and numeric scalars.

Elements carry their own arithmetic: ``+ - *`` among themselves and with Python ``int`` on either side, unary
``-``, and ``/`` where the ring is a field. Everything else goes through the ring object.
"""

from __future__ import annotations

from typing import Any, Protocol

Element = Any
"""An element of some ring; rings are duck-typed so that flint, mpmath and numpy objects serve unwrapped."""


class Ring(Protocol):
    """A commutative ring over the rationals."""

    name: str
    zero: Element
    one: Element

    def rational(self, p: int, q: int = 1) -> Element:
        """Return p/q in this ring."""

    def is_zero(self, x: Element) -> bool | None:
        """Decide x = 0; None where the ring cannot tell (a ball that contains zero never proves zero)."""

    def text(self, x: Element) -> str:
        """Spell x exactly, in the grammar that tableau files use where one exists."""

    def key(self, x: Element) -> tuple[Any, ...]:
        """Return a hashable, totally ordered key; equal elements of this ring have equal keys."""

    def approximate(self, x: Element, digits: int = 20) -> str:
        """Return x as a decimal with that many significant digits, correctly rounded."""
