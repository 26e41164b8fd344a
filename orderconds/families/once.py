"""The series of one method, made once.

A check evaluates orders 1, 2, ... of the same method, and larger trees are made of smaller ones.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar

from orderconds.ring.protocol import Ring

Made = TypeVar("Made")


class Once(Generic[Made]):
    """What ``make(method, ring)`` returned for the last two methods, known by identity, exact and in balls.

    >>> once = Once(lambda method, ring: [method])
    >>> one, other = (1,), (2,)
    >>> once(one, None) is once(one, None), once(other, None)
    (True, [(2,)])
    """

    def __init__(self, make: Callable[[Any, Ring], Made]) -> None:
        self._make = make
        self._latest: list[tuple[object, Ring, Made]] = []

    def __call__(self, method: object, ring: Ring) -> Made:
        """Return it for this method."""
        for known, of_ring, made in self._latest:
            if known is method and of_ring is ring:
                return made
        made = self._make(method, ring)
        self._latest = [(method, ring, made), *self._latest[:1]]
        return made
