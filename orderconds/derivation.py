"""The order conditions of a family up to a given order, as one record."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain

from orderconds import families
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError


@dataclass(frozen=True)
class Derivation:
    """The conditions of ``family`` (a label, as ``rkmk(1)``) up to ``order``, grouped by order.

    ``by_order[n - 1]`` holds the conditions of exactly order n.
    """

    family: str
    order: int
    by_order: tuple[tuple[OrderCondition, ...], ...]
    remark: str = ""
    """A remark on these conditions for the reader, or an empty text."""

    @property
    def counts(self) -> tuple[int, ...]:
        """The number of conditions of each order 1, ..., ``order``."""
        return tuple(map(len, self.by_order))

    @property
    def conditions(self) -> tuple[OrderCondition, ...]:
        """All conditions, by increasing order."""
        return tuple(chain.from_iterable(self.by_order))

    def as_json(self) -> dict[str, object]:
        """Return the JSON object of ``orderconds derive --format json``."""
        return {
            "family": self.family,
            "order": self.order,
            "counts": list(self.counts),
            "conditions": [condition.as_json() for condition in self.conditions],
        }


def derive(family: str, order: int, *, every: bool = False, **options: int | None) -> Derivation:
    """Derive the independent order conditions of ``family`` up to ``order``; with ``every`` the conditions of
    all trees.

    ``options`` are options of the family, such as ``cutoff`` for RKMK. They may also be part of the name, as
    in ``"rkmk(1)"``.

    Raises :class:`~orderconds.errors.UnknownName` for an unknown family and
    :class:`~orderconds.errors.InputError` for an order below 1, or above the highest order for which the
    family has conditions.

    >>> derivation = derive("rk", order=3)
    >>> derivation.counts
    (1, 1, 2)
    >>> print(derivation.conditions[0])
    sum_i b_i = 1
    """
    chosen = families.get(family, **options)
    if order < 1:
        raise InputError(f"order {order}", where="derive", expected="an order of at least 1")
    conditions = chosen.all_conditions if every else chosen.essential_conditions
    by_order = tuple(conditions(n) for n in range(1, order + 1))
    return Derivation(chosen.label(), order, by_order, "" if every else chosen.remark(order))
