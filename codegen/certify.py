"""The order that a header states: computed by ``orderconds.check``, never copied from a claim."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.lower import lowering, names
from codegen.method import Method
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder
    from orderconds.checking.residuals import Failure
    from orderconds.families import Family


@dataclass(frozen=True)
class CertifiedOrder:
    """An order with how it is known, and the conditions of the next order that fail.

    ``bound`` says that the search ended before a condition failed; ``classical`` names the family that the
    method is on an abelian group, where the order was found for that one.
    """

    order: int
    certificate: str
    bound: bool = False
    failing: tuple[Failure, ...] = ()
    classical: str = ""

    def text(self) -> str:
        """Say it in words."""
        how = {
            "exact": "every order condition up to it is zero in exact arithmetic",
            "ball": "interval arithmetic proves a method of this order within the last digit of the decimals",
            "decimal": "what the printed digits of the coefficients support",
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
            return _certified(found, classical)
    found = lowering(method.family).order(method, scene)
    if not found.decided:
        raise MethodError(
            f"the order of {method.label} is undecided beyond {found.order}",
            expected="coefficients with more digits",
        )
    return _certified(found)


def _certified(found: FamilyOrder, classical: str = "") -> CertifiedOrder:
    return CertifiedOrder(found.order, found.certificate, found.limit is not None, found.failing, classical)
