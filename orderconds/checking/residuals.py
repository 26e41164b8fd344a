"""The residuals of the conditions of one order, and a verdict on each residual.

A ball is an approximate value with an error bound. In a number field, balls are much cheaper than exact
arithmetic. The exact residual is computed if the ball of the residual contains zero, or if the residual is
printed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from decimal import Context, Decimal
from functools import cache, cached_property, partial
from math import factorial
from typing import TYPE_CHECKING

from flint import fmpq

from orderconds.conditions import OrderCondition
from orderconds.families import Family
from orderconds.families.memo import Memo
from orderconds.ring import Balls, Element, NumberField, Ring
from orderconds.ring.decimals import endpoints, rational_decimal
from orderconds.ring.field import Algebraic
from orderconds.ring.nodal import nodal_algebra
from orderconds.tableau.methods import PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import Method

if TYPE_CHECKING:
    from flint import arb

RESOLUTION = Decimal("1e-3")
"""If a residual is a ball that contains zero and other numbers, the radius of the ball decides the verdict.

For a condition of order n, the verdict is ``supported`` if the radius is at most RESOLUTION/n!, and
``undecided`` if the radius is larger.
"""

BITS = 256
"""The precision, in bits, of the balls that contain elements of a number field."""

ENCLOSING = Balls(BITS)
DIGITS = 20
ROUNDED = Context(prec=DIGITS)


@dataclass(frozen=True, eq=False)
class Failure:
    """A condition that does not hold. The function ``exact`` returns the residual, an element of ``ring``."""

    condition: OrderCondition
    ring: Ring = field(repr=False)
    exact: Callable[[], Element] = field(repr=False)
    enclosure: arb | None = field(default=None, repr=False)
    """A ball of the library flint that contains the residual, or None if no ball was computed."""

    @cached_property
    def value(self) -> Element:
        """The residual as an element of the ring."""
        return self.exact()

    @cached_property
    def residual(self) -> str:
        """The residual as text. The text is exact if the ring is exact."""
        return self.ring.text(self.value)

    @cached_property
    def decimal(self) -> str:
        """The residual as text with 20 digits."""
        return self.ring.approximate(self.value, DIGITS)

    @cached_property
    def size(self) -> Decimal:
        """The residual as a decimal number of 20 digits. In spite of the name ``size``, the number has the
        sign of the residual."""
        if self.enclosure is not None:
            low, high = (rational_decimal(x, DIGITS) for x in endpoints(self.enclosure))
            if low == high:
                return Decimal(low)
        if (q := _rational(self.value)) is not None:
            return ROUNDED.divide(Decimal(int(q.p)), Decimal(int(q.q)))
        return Decimal(self.decimal)

    def as_json(self) -> dict[str, object]:
        """Return the entry of the failing condition in the JSON output of ``orderconds check``."""
        return {
            "order": self.condition.order,
            "tree": self.condition.tree,
            "expression": self.condition.expression,
            "residual": self.residual,
        }

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Failure) and (self.condition, self.residual) == (
            other.condition,
            other.residual,
        )

    def __hash__(self) -> int:
        return hash(self.condition)

    def __str__(self) -> str:
        return f"{self.condition.tree}: {self.condition}, residual {self.residual} ({self.decimal})"


def judge(
    family: Family,
    method: Method,
    ring: Ring,
    conditions: Sequence[OrderCondition],
    balls_first: bool = False,
    sizes: list[float] | None = None,
) -> tuple[set[str], tuple[Failure, ...]]:
    """Return the set of verdicts that occur for the given conditions, and the conditions that fail.

    The verdict on a condition is ``zero``, ``fails``, ``supported`` (the residual is a narrow ball that
    contains zero) or ``undecided`` (the residual is a wide ball that contains zero).

    If ``balls_first`` is true and ``ring`` is a number field, each residual may first be computed as a ball.
    If this ball does not contain zero, the verdict needs no exact residual. If the residuals in ``ring`` are
    balls and no condition fails, the largest absolute residual is appended to the list ``sizes``.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss2 = Tableau.load(find("gauss2"))
    >>> from orderconds.families import get
    >>> cg = get("cg")
    >>> for first in (False, True):
    ...     verdicts, failing = judge(cg, gauss2.method, gauss2.ring, cg.conditions(3), first)
    ...     print(sorted(verdicts), [(f.condition.tree, f.residual) for f in failing])
    ['fails', 'zero'] [('[.] .', '1/6 - sqrt(3)/12')]
    ['fails', 'zero'] [('[.] .', '1/6 - sqrt(3)/12')]
    """
    if balls_first and isinstance(ring, NumberField) and conditions and not _over_q(family, method, ring):
        return _by_balls(family, method, ring, conditions)
    residuals = family.residuals(method, ring, conditions)
    judged = [_verdict(ring, x, c.order) for c, x in zip(conditions, residuals, strict=True)]
    failing = tuple(
        Failure(condition, ring, partial(_itself, residual))
        for condition, residual, verdict in zip(conditions, residuals, judged, strict=True)
        if verdict == "fails"
    )
    if sizes is not None and residuals and not failing and isinstance(ring, Balls):
        sizes.append(max(abs(ring.nearest_float(x)) for x in residuals))
    return set(judged), failing


def _by_balls(
    family: Family, method: Method, ring: NumberField, conditions: Sequence[OrderCondition]
) -> tuple[set[str], tuple[Failure, ...]]:
    balls = ENCLOSING
    enclosed = _ENCLOSED(method, ring)
    around = family.residuals(enclosed, balls, conditions)
    doubtful = [c for c, x in zip(conditions, around, strict=True) if balls.is_zero(x) is not False]
    exact = iter(family.residuals(method, ring, doubtful))
    on_demand = _OnDemand(family, method, ring, conditions)
    verdicts, failing = set[str](), []
    for place, (condition, ball) in enumerate(zip(conditions, around, strict=True)):
        if balls.is_zero(ball) is False:
            failing.append(Failure(condition, ring, partial(on_demand, place), ball.value))
        elif not ring.is_zero(residual := next(exact)):
            failing.append(Failure(condition, ring, partial(_itself, residual)))
        else:
            verdicts.add("zero")
    return verdicts | ({"fails"} if failing else set()), tuple(failing)


def _enclosed(method: Method, ring: Ring) -> Method:
    assert isinstance(ring, NumberField)
    return method.map(cache(lambda x: ENCLOSING.enclose(ring.ball(x, BITS))))


_ENCLOSED = Memo(_enclosed)


def _over_q(family: Family, method: Method, ring: NumberField) -> bool:
    """Return True if the exact residuals can be computed with rational polynomials in the nodes c_i.

    The nodes may be irrational numbers. The docstring of :mod:`orderconds.ring.nodal` states which methods
    allow this computation.
    """
    if not (family.over_rationals and isinstance(method, RungeKutta | PartitionedRungeKutta)):
        return False
    return nodal_algebra(ring, (method.A,), method.b) is not None


class _OnDemand:
    """Computes the exact residuals of ``conditions`` on request.

    A request is a call with the index of a condition.
    """

    def __init__(
        self, family: Family, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> None:
        self._evaluate = partial(family.residuals, method, ring)
        self._conditions = conditions
        self._known: dict[int, Element] = {}

    def __call__(self, place: int) -> Element:
        if place not in self._known:
            wanted = list(self._missing()) if self._known else [place]
            residuals = self._evaluate([self._conditions[k] for k in wanted])
            self._known.update(zip(wanted, residuals, strict=True))
        return self._known[place]

    def _missing(self) -> Iterator[int]:
        return (k for k in range(len(self._conditions)) if k not in self._known)


def _rational(x: Element) -> fmpq | None:
    """Return ``x`` as a rational number, or None if ``x`` is a ball or an irrational number."""
    if isinstance(x, Algebraic):
        return x.rational_value if x.is_rational else None
    return x if isinstance(x, fmpq) else None


def _itself(x: Element) -> Element:
    return x


def _verdict(ring: Ring, residual: Element, n: int) -> str:
    zero = ring.is_zero(residual)
    if zero is not None:
        return "zero" if zero else "fails"
    assert isinstance(ring, Balls)  # ``is_zero`` returns None only for balls.
    radius = Decimal(ring.radius(residual))
    return "supported" if radius <= RESOLUTION / factorial(n) else "undecided"
