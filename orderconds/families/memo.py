"""A cache for the series of a method.

A series keeps the computed coefficients, so the conditions of higher orders use the coefficients from lower
orders.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

from orderconds.ring.protocol import Ring
from orderconds.tableau.products import Method

Result = TypeVar("Result")


class Memo(Generic[Result]):
    """A cache of the last two computed results of ``compute(method, ring)``.

    Methods and rings are compared by identity.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Composition
    >>> memo = Memo(lambda method, ring: [method.s])
    >>> one, other = Composition("symmetric-2", (QQ.one,)), Composition("symmetric-2", (QQ.one, QQ.one))
    >>> memo(one, QQ) is memo(one, QQ), memo(other, QQ)
    (True, [2])
    """

    def __init__(self, compute: Callable[[Method, Ring], Result]) -> None:
        self._compute = compute
        self._latest: list[tuple[Method, Ring, Result]] = []

    def __call__(self, method: Method, ring: Ring) -> Result:
        """Return ``compute(method, ring)``, from the cache if possible."""
        for known, of_ring, result in self._latest:
            if known is method and of_ring is ring:
                return result
        result = self._compute(method, ring)
        self._latest = [(method, ring, result), *self._latest[:1]]
        return result
