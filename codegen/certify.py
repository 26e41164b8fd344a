"""The order that a header states: computed by ``orderconds.check``, never copied from a claim."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from flint import fmpq

from codegen.errors import MethodError
from codegen.lower import lowering, names
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.ring import Balls
from orderconds.ring.balls import Ball
from orderconds.ring.decimals import endpoints, rational_decimal

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder
    from orderconds.checking.residuals import Failure
    from orderconds.families import Family

DOUBLE_BITS = 53
"""A double has this many bits: rounding moves a number by at most its 2^-53th part."""


@dataclass(frozen=True)
class CertifiedOrder:
    """An order with how it is known, and the conditions of the next order that fail.

    ``bound`` says that the search ended before a condition failed; ``classical`` names the family that the
    method is on an abelian group, where the order was found for that one. ``radius`` says how far the
    coefficients are known, where that is less than a double holds: then there is no certificate.
    """

    order: int
    certificate: str
    bound: bool = False
    failing: tuple[Failure, ...] = ()
    classical: str = ""
    radius: str = ""

    def text(self) -> str:
        """Say it in words."""
        how = {
            "exact": "every order condition up to it is zero in exact arithmetic",
            "ball": "interval arithmetic proves a method of this order within the last digit of the decimals",
            "decimal": "what the printed digits of the coefficients support",
            "none": f"the coefficients are known to {self.radius} only, less than double precision",
        }
        least = "at least " if self.bound else ""
        explained = f" ({how[self.certificate]})" if self.certificate in how else ""
        where = f", as {self.classical} on an abelian group" if self.classical else ""
        return f"{least}{self.order}, certificate: {self.certificate}{explained}{where}"


def family_of(method: Method) -> Family:
    """Return the family whose order conditions hold for what is compiled."""
    from orderconds import families

    if method.family in names():
        return lowering(method.family).conditions(method)
    return families.get(method.family_label)


def certified_order(method: Method, scene: Problem | None = None) -> CertifiedOrder:
    """Return the order of a method in its family; a MethodError where it cannot be decided.

    On a ``scene`` whose group is abelian it is the order of the classical family that the method is there.
    """
    from orderconds.checking import check

    classical = method.kind.abelian if scene is not None and scene.group.abelian else None
    if classical is not None:
        (found,) = check(method.tableau, family=classical).orders
        if found.decided:
            return _certified(method, found, classical)
    found = lowering(method.family).order(method, scene)
    if not found.decided:
        raise MethodError(
            f"the order of {method.label} is undecided beyond {found.order}",
            expected="coefficients with more digits",
        )
    return _certified(method, found)


def _certified(method: Method, found: FamilyOrder, classical: str = "") -> CertifiedOrder:
    radius = _uncertainty(method)
    certificate = "none" if radius else found.certificate
    return CertifiedOrder(found.order, certificate, found.limit is not None, found.failing, classical, radius)


def _uncertainty(method: Method) -> str:
    """Return the largest radius of a coefficient wider than the rounding of a double, or an empty text."""
    ring = method.ring
    if not isinstance(ring, Balls):
        return ""
    widest = fmpq(0)

    def visit(x: Ball) -> Ball:
        nonlocal widest
        low, high = endpoints(x.value)
        if high - low > abs(low + high) / 2**DOUBLE_BITS:
            widest = max(widest, (high - low) / 2)
        return x

    method.tableau.method.map(visit)
    return rational_decimal(widest, 2) if widest else ""
