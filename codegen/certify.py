"""The order that a header states: computed by ``orderconds.check``, never copied from a claim."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.lower import lowering, names
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.tableau.uncertainty import uncertainty

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder
    from orderconds.checking.residuals import Failure
    from orderconds.families import Family

DOUBLE_BITS = 53
"""Bits of a double: rounding changes a number by a relative error of at most 2^-53."""


@dataclass(frozen=True)
class CertifiedOrder:
    """An order, its certificate, and the conditions of the next order that fail.

    ``bound``: the search ended before a condition failed, so the order may be higher. ``classical`` is the
    family of the method on an abelian group, if the order is that of the classical method. ``radius`` is the
    uncertainty of the coefficients if it exceeds double precision; then there is no certificate.
    """

    order: int
    certificate: str
    bound: bool = False
    failing: tuple[Failure, ...] = ()
    classical: str = ""
    radius: str = ""

    def text(self) -> str:
        """Return the order and its certificate for a header."""
        how = {
            "construction": "a step is the Taylor polynomial of this degree",
            "exact": "every order condition up to it is zero in exact arithmetic",
            "ball": "interval arithmetic proves a method of this order within the last digit of the decimals",
            "decimal": "the conditions hold up to the printed digits of the coefficients",
            "none": f"the coefficients are known to {self.radius} only, which is less than double precision",
        }
        least = "at least " if self.bound else ""
        explained = f" ({how[self.certificate]})" if self.certificate in how else ""
        where = f", as {self.classical} on an abelian group" if self.classical else ""
        return f"{least}{self.order}, certificate: {self.certificate}{explained}{where}"


def family_of(method: Method) -> Family:
    """Return the family whose order conditions apply to the compiled method."""
    from orderconds import families

    if method.family in names():
        return lowering(method.family).conditions(method)
    return families.get(method.family_label)


def certified_order(method: Method, scene: Problem | None = None) -> CertifiedOrder:
    """Return the order of a method in its family; a MethodError if it cannot be decided.

    On a ``scene`` with an abelian group the method is one of a classical family, and the order is that of
    this family.
    """
    from orderconds.checking import check

    classical = method.kind.abelian if scene is not None and scene.group.abelian else None
    if classical is not None:
        (order,) = check(method.tableau, family=classical).orders
        if order.decided:
            return _certified(method, order, classical)
    order = lowering(method.family).order(method, scene)
    if not order.decided:
        raise MethodError(
            f"the order of {method.label} is undecided beyond {order.order}",
            expected="coefficients with more digits",
        )
    return _certified(method, order)


def _certified(method: Method, order: FamilyOrder, classical: str = "") -> CertifiedOrder:
    radius = "" if method.coefficients is None else uncertainty(method.coefficients, DOUBLE_BITS)
    certificate = "none" if radius else order.certificate
    return CertifiedOrder(order.order, certificate, order.limit is not None, order.failing, classical, radius)
