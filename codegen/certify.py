"""The order that a header states: computed by ``orderconds.check``, never copied from a claim."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.lower import OF_PARTS, splitting
from codegen.lower.minimal_brackets import bracket_program
from codegen.method import Method
from codegen.scene.problem import Problem

if TYPE_CHECKING:
    from orderconds.families import Family
    from orderconds.residuals import Failure


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


CLASSICAL = {
    **dict.fromkeys(("rkmk", "cg", "cf"), "rk"),
    **dict.fromkeys(("vcg", "vrkmk", "vrkmk_pade", "slgi"), "sprk"),
}
"""What a family is where brackets vanish and exponentials are sums."""

SAME_CONDITIONS = {"slgi": "vrkmk(0)", "ambient": "rk", "discrete_gradient": "rk"}
"""Families whose order conditions are those of others.

SLGI and ambient methods are the others differently written; a discrete gradient has the orders one and two
where its quadrature rule has them (sum b_i = 1, sum b_i c_i = 1/2), and no higher one.
"""


def family_of(method: Method) -> Family:
    """Return the family whose conditions speak of what is compiled.

    For ``rkmk`` without a cut-off they are evaluated by the series of the very program that is compiled.
    """
    from orderconds import families

    if method.family == "rkmk" and method.cutoff is None:
        from orderconds.families.rkmk_fewest import FewestBrackets

        return FewestBrackets(bracket_program(method))
    if method.family == "vrkmk_pade":
        from orderconds.families.vrkmk_pade import VariationalMuntheKaasPade

        return VariationalMuntheKaasPade(method.cutoff or 0)
    return families.get(SAME_CONDITIONS.get(method.family, method.family_label))


def certified_order(method: Method, scene: Problem | None = None) -> CertifiedOrder:
    """Return the order of a method in its family; a MethodError where it cannot be decided.

    On a ``scene`` whose group is abelian it is the order of the classical family that the method is there.

    For ``rkmk`` without a cut-off and ``vrkmk_pade`` the failing conditions are not named: no index sum
    spells what fails.
    """
    from orderconds.check import check, family_order

    classical = CLASSICAL.get(method.family, "") if scene is not None and scene.group.abelian else ""
    if classical:
        (found,) = check(method.tableau, family=classical).orders
        if found.decided:
            return CertifiedOrder(
                found.order, found.certificate, found.limit is not None, found.failing, classical
            )
    if method.family in OF_PARTS and scene is not None:
        return _of_parts(method, splitting.read(scene, method).family)
    family = family_of(method)
    if method.family == "vrkmk_pade" or (method.family == "rkmk" and method.cutoff is None):
        found = replace(family_order(method.tableau, family), failing=())
    else:
        name = SAME_CONDITIONS.get(method.family, method.family_label)
        (found,) = check(method.tableau, family=name).orders
        if method.family == "discrete_gradient":
            found = replace(found, order=min(found.order, 2), failing=(), limit=None)
    if not found.decided:
        raise MethodError(
            f"the order of {method.label} is undecided beyond {found.order}",
            expected="coefficients with more digits",
        )
    return CertifiedOrder(found.order, found.certificate, found.limit is not None, found.failing)


def _of_parts(method: Method, family: str) -> CertifiedOrder:
    """Return the order of a splitting under the conditions that hold on its scene."""
    from orderconds.check import check

    (found,) = check(method.tableau, family=family).orders
    if not found.decided:
        raise MethodError(
            f"the order of {method.label} is undecided beyond {found.order}",
            expected="coefficients with more digits",
        )
    return CertifiedOrder(found.order, found.certificate, found.limit is not None, found.failing)
