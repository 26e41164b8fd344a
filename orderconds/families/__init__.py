"""Families of methods: each says how a tableau becomes a series, and which values of it are order conditions.

One module a family, loaded when asked for by name. A module offers ``create(**options)`` that returns a
:class:`Family`; the options are the family's own (``cutoff`` of RKMK).
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from fractions import Fraction
from importlib import import_module
from typing import Any, Protocol

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError, UnknownName, ZeroWeight
from orderconds.families.once import Once
from orderconds.ring.balls import Balls, Enclosures
from orderconds.ring.precision import precision
from orderconds.ring.protocol import Element, Ring

MODULES = {
    "rk": "orderconds.families.rk",
    "prk": "orderconds.families.prk",
    "prk_same_weights": "orderconds.families.prk_same_weights",
    "symplectic_rk": "orderconds.families.symplectic_rk",
    "sprk": "orderconds.families.sprk",
    "sprk_separable": "orderconds.families.sprk_separable",
    "rkmk": "orderconds.families.rkmk",
    "cg": "orderconds.families.cg",
    "cf": "orderconds.families.cf",
    "vrkmk": "orderconds.families.vrkmk",
    "vcg": "orderconds.families.vcg",
    "vcf": "orderconds.families.vcf",
    "composition": "orderconds.families.composition",
    "symmetric_composition": "orderconds.families.symmetric_composition",
    "splitting": "orderconds.families.splitting",
    "rkn": "orderconds.families.rkn",
    "magnus": "orderconds.families.magnus",
    "cf_magnus": "orderconds.families.cf_magnus",
    "fer": "orderconds.families.fer",
    "cayley": "orderconds.families.cayley",
}
"""Family name to module, in the order in which ``orderconds list families`` shows them."""


class Family(Protocol):
    """What every family offers.

    Optional: ``search_limit``, the order up to which ``check`` searches where nothing is claimed;
    ``decisive_conditions(order)``, what it evaluates when an independent set costs more than all trees, and
    ``decisive_in_turn(order)``, the trees of the same one after the other, where there are very many,
    ``decisive_count(order)``, their number, and ``condition(tree)``;
    ``require(method, ring)``, which raises InputError for a method that is no member of the family;
    ``trees``, the kind of trees its conditions belong to, by which they are drawn and named
    (``orderconds.explain.kinds``).
    """

    name: str
    formats: tuple[str, ...]
    """The tableau formats it reads, the preferred one first."""
    needs_nonzero_weights: bool
    """Whether the family divides by the weights b_i."""

    def label(self) -> str:
        """Return the name with its options, as ``rkmk(1)``."""

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of exactly this order."""

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of every tree or word of exactly this order."""

    def evaluate(self, method: Any, ring: Ring, conditions: Sequence[OrderCondition]) -> tuple[Element, ...]:
        """Return the left-hand sides of ``conditions`` for a method with coefficients in ``ring``.

        Raises :class:`~orderconds.errors.ZeroWeight` where the family divides by a weight that is zero.
        """


def names() -> tuple[str, ...]:
    """Return the names of all families.

    >>> names()[:3]
    ('rk', 'prk', 'prk_same_weights')
    """
    return tuple(MODULES)


def get(name: str, **options: Any) -> Family:
    """Return a family by name, ``get("rkmk", cutoff=1)`` or ``get("rkmk(1)")``; ``-`` reads as ``_``.

    Raises :class:`~orderconds.errors.UnknownName` for a name that is not registered and
    :class:`~orderconds.errors.InputError` for an option the family does not have.

    >>> get("rkmk(1)").label(), get("vcg").needs_nonzero_weights
    ('rkmk(1)', True)
    """
    called = re.fullmatch(r"\s*([a-z_-]+)\s*(?:\(\s*(\d{1,3})\s*\))?\s*", name)
    base, argument = called.groups() if called else (name, None)
    base = base.replace("-", "_")
    if base not in MODULES:
        import difflib

        close = difflib.get_close_matches(base, MODULES, n=1)
        raise UnknownName(
            f"unknown family {name!r}",
            expected=f"one of {', '.join(MODULES)}",
            hint=f"did you mean {close[0]!r}?" if close else "",
        )
    create = import_module(MODULES[base]).create
    accepted = tuple(inspect.signature(create).parameters)
    if argument is not None and not accepted:
        raise InputError(f"family {base} takes no argument, found {name!r}", expected=base)
    if argument is not None:
        options = {accepted[0]: int(argument), **options}
    for option in options:
        if option not in accepted:
            raise InputError(
                f"family {base} has no option {option!r}",
                expected=f"one of {', '.join(accepted)}" if accepted else "no options",
            )
    family: Family = create(**options)
    return family


def residuals(
    family: Family, method: Any, ring: Ring, conditions: Sequence[OrderCondition]
) -> tuple[Element, ...]:
    """Return left-hand side minus right-hand side of each condition, elements of ``ring``.

    >>> from orderconds.tableau import Tableau, find
    >>> euler = Tableau.load(find("euler"))
    >>> rk = get("rk")
    >>> residuals(rk, euler.method, euler.ring, rk.conditions(2))
    (-1/2,)
    """
    if not conditions:
        return ()
    if isinstance(ring, Balls):
        with precision(ring.bits):  # once, and not in each operation
            found = _residuals(family, *_UNWRAPPED(method, ring), conditions)
        if not all(x.is_finite() for x in found):
            raise ZeroDivisionError("division by a ball that contains zero")
        return tuple(map(ring.enclose, found))
    return _residuals(family, method, ring, conditions)


def _unwrapped(method: Any, ring: Any) -> tuple[Any, Enclosures]:
    return method.map(lambda x: x.value), Enclosures(ring.bits)


_UNWRAPPED = Once(_unwrapped)


def _residuals(
    family: Family, method: Any, ring: Ring, conditions: Sequence[OrderCondition]
) -> tuple[Element, ...]:
    values = family.evaluate(method, ring, conditions)
    return tuple(value - in_ring(ring, c.rhs) for value, c in zip(values, conditions, strict=True))


def in_ring(ring: Ring, q: Fraction) -> Element:
    """Return a rational number as an element of ``ring``.

    >>> from orderconds.ring import QQ
    >>> in_ring(QQ, Fraction(1, 3))
    1/3
    """
    return ring.rational(q.numerator, q.denominator)


def require_nonzero_weights(label: str, ring: Ring, b: Sequence[Element]) -> None:
    """Raise :class:`~orderconds.errors.ZeroWeight` unless every weight is known to be non-zero.

    >>> from orderconds.ring import QQ
    >>> require_nonzero_weights("vcg", QQ, [QQ.one])
    """
    for i, weight in enumerate(b, start=1):
        vanishes = ring.is_zero(weight)
        if vanishes is None or vanishes:
            raise ZeroWeight(
                f"b_{i} = {ring.text(weight)}" + (", which may be zero" if vanishes is None else ""),
                where=f"family {label}",
                expected="every weight b_i to be non-zero, since the family divides by it",
                hint="choose another family, or a tableau without zero weights",
            )
