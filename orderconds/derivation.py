"""Derive the order conditions of a family up to a given order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import overload

from orderconds import families
from orderconds.argument import CONDITION_ORDER, EXPANDED_STAGES, integer
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError


@dataclass(frozen=True, repr=False)
class Derivation:
    """The conditions of ``family`` (a label such as ``rkmk(1)``) up to ``order``.

    ``by_order[n - 1]`` contains the conditions of order n. The tuple :attr:`conditions` contains all
    conditions. If d is a derivation, ``len(d)``, ``d[k]`` and ``iter(d)`` use the tuple ``d.conditions``.

    >>> derivation = derive("rk", order=3)
    >>> derivation, len(derivation)
    (Derivation(rk, order 3: 1, 1, 2 conditions), 4)
    >>> [condition.tree for condition in derivation]
    ['.', '[.]', '[[.]]', '[..]']
    """

    family: str
    order: int
    by_order: tuple[tuple[OrderCondition, ...], ...]
    remark: str = ""
    """A remark for the user on the conditions, or an empty string."""

    @property
    def counts(self) -> tuple[int, ...]:
        """The numbers of conditions of the orders 1, ..., ``order``."""
        return tuple(map(len, self.by_order))

    @property
    def conditions(self) -> tuple[OrderCondition, ...]:
        """All conditions, by increasing order."""
        return tuple(chain.from_iterable(self.by_order))

    def __iter__(self) -> Iterator[OrderCondition]:
        return iter(self.conditions)

    def __len__(self) -> int:
        return sum(self.counts)

    @overload
    def __getitem__(self, index: int) -> OrderCondition: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[OrderCondition, ...]: ...

    def __getitem__(self, index: int | slice) -> OrderCondition | tuple[OrderCondition, ...]:
        return self.conditions[index]

    def __repr__(self) -> str:
        counts = ", ".join(map(str, self.counts))
        return f"Derivation({self.family}, order {self.order}: {counts} conditions)"

    def latex(self) -> str:
        """Return LaTeX for a paper: numbered equations, their trees, and definitions of all symbols."""
        from orderconds.typeset.article import article

        return article(self.family, self.by_order)

    def _repr_latex_(self) -> str:
        from orderconds.typeset.notebook import formula

        return formula(self.conditions)

    def _repr_html_(self) -> str:
        from orderconds.typeset.notebook import table

        return table(self.family, self.by_order)

    def as_json(self) -> dict[str, object]:
        """Return the JSON object of ``orderconds derive --format json``."""
        return {
            "family": self.family,
            "order": self.order,
            "counts": list(self.counts),
            "conditions": [condition.as_json() for condition in self.conditions],
        }


def derive(
    family: str,
    order: int,
    stages: int | None = None,
    *,
    explicit: bool = False,
    every: bool = False,
    **options: int | None,
) -> Derivation:
    """Derive the independent order conditions of ``family`` up to ``order``.

    If ``every`` is true, derive the conditions of all trees, including the dependent conditions. If
    ``stages`` is given, the sums over stages are expanded for ``stages`` stages. If ``explicit`` is also
    true, the result is for explicit methods. ``options`` are options of the family, for example
    ``cutoff`` of RKMK. Options may also be part of the family's name, as in ``"rkmk(1)"``.

    Raises :class:`~orderconds.errors.UnknownName` for an unknown family. Raises
    :class:`~orderconds.errors.InputError` in these cases:

    - The order is not an integer from 1 to 20.
    - For some n <= ``order``, the family has more than 7000 trees of order n.
    - The family has no conditions of the given order.
    - ``stages`` is not an integer from 1 to 12.
    - ``explicit`` is true, but ``stages`` is not given.
    - The conditions cannot be expanded for ``stages`` stages, or the expansion has too many terms.

    >>> derivation = derive("rk", order=3)
    >>> derivation.counts
    (1, 1, 2)
    >>> print(derivation.conditions[0])
    sum_i b_i = 1
    >>> print(derive("rk", order=2, stages=2, explicit=True)[1])
    b_2 a_21 = 1/2
    """
    from orderconds.explain.kinds import refuse_too_many_trees

    if explicit and stages is None:
        raise InputError(
            "'explicit' has no effect without 'stages'", where="derive", expected="a number of stages"
        )
    order = integer(order, "order", CONDITION_ORDER)
    stages = None if stages is None else integer(stages, "stages", EXPANDED_STAGES)
    chosen = families.get(family, **options)
    refuse_too_many_trees(chosen, order)
    conditions = chosen.all_conditions if every else chosen.essential_conditions
    by_order = tuple(conditions(n) for n in range(1, order + 1))
    derivation = Derivation(chosen.label(), order, by_order, "" if every else chosen.remark(order))
    if stages is None:
        return derivation
    from orderconds.stage_expansion import expand_stages

    return expand_stages(derivation, stages, explicit=explicit)
