"""The order of a method, for the comment at the head of emitted code.

The order in the tableau file is ignored for all methods. Most orders are computed from the order conditions.
The order of a Taylor method is its degree. If a scene defines a step, the scene also states the order of the
step.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from codegen.errors import MethodError
from codegen.ir.precision import Precision
from codegen.lower import lowering, names
from codegen.method import Method
from codegen.rounded_conditions import rounded_residual
from codegen.scene.problem import Problem
from orderconds.tableau.uncertainty import uncertainty

if TYPE_CHECKING:
    from orderconds.checking import FamilyOrder
    from orderconds.checking.residuals import Failure
    from orderconds.families import Family

DOUBLE_BITS = 53
"""The number of significant bits of a double."""


@dataclass(frozen=True)
class CertifiedOrder:
    """The order of a method, and the kind of its proof.

    - ``certificate`` is the kind of proof. :meth:`text` explains each kind.
    - ``failing`` contains order conditions of order ``order`` + 1 that the method violates.
    - ``bound`` is true if ``order`` is only a lower bound, because some conditions of the next order were not
      checked.
    - ``classical`` is the name of the classical family whose conditions were checked, or ''. These
      conditions are used only on abelian groups.
    - ``radius`` is '' if the coefficients are accurate to the rounding error of a double. Otherwise,
      ``radius`` is the uncertainty of the coefficients.
    """

    order: int
    certificate: str
    bound: bool = False
    failing: tuple[Failure, ...] = ()
    classical: str = ""
    radius: str = ""

    def text(self) -> str:
        """Return the order and an explanation of its proof, for the comment at the head of emitted code."""
        how = {
            "construction": "the order is the degree of the Taylor polynomial that each step evaluates",
            "stated": "the scene states this order",
            "exact": "the residuals of all order conditions up to this order are zero in exact arithmetic",
            "ball": "interval arithmetic proves that a method of this order exists, and that its "
            "coefficients differ from the decimals of the tableau by at most one unit in the last digit",
            "double": "the order conditions hold up to the rounding of the coefficients, which are doubles",
            "decimal": "the order conditions hold up to the rounding of the coefficients, which are decimals",
        }
        least = "at least " if self.bound else ""
        spread = (
            f"; the uncertainty of the coefficients is {self.radius}, "
            "which is larger than the rounding error of a double"
            if self.radius
            else ""
        )
        explained = f" ({how[self.certificate]}{spread})" if self.certificate in how else ""
        where = (
            f"; the order conditions are those of the family {self.classical}, because the group is abelian"
            if self.classical
            else ""
        )
        return f"{least}{self.order}, certificate: {self.certificate}{explained}{where}"


def family_of(method: Method) -> Family:
    """Return the family whose order conditions apply to a method."""
    from orderconds import families

    if method.family in names():
        return lowering(method.family).conditions(method)
    return families.get(method.family_label)


def certified_order(method: Method, scene: Problem | None = None) -> CertifiedOrder:
    """Return the order of a method for a scene.

    On an abelian group, the methods of some families reduce to methods of a classical family. For these
    families and an abelian group, the order in the classical family is returned if the coefficients have
    enough digits to decide this order.

    In all other cases, the order in the family of the method is returned. If the coefficients have too few
    digits to decide this order, MethodError is raised.
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
            f"the order of {method.label} is at least {order.order}; the coefficients have too few digits "
            "to decide whether it is higher",
            expected="coefficients with more digits",
        )
    return _certified(method, order)


def rounding_of_digits(method: Method, order: CertifiedOrder, target: Precision, scene: Problem) -> str:
    """Return a sentence about the effect of rounding, for the comment at the head of emitted code.

    The coefficients are rounded to the precision ``target``. The sentence states the largest residual of the
    order conditions for the rounded coefficients.
    """
    from orderconds import families

    lowered = lowering(method.family)
    family = families.get(order.classical) if order.classical else lowered.conditions(method, scene)
    residual = rounded_residual(method, family, order.order, target)
    rounded = f"with the coefficients rounded to {target.name} precision"
    if residual is None:
        return f"the order conditions were not evaluated {rounded}"
    size = f"at most {upwards(residual)}" if residual else "zero"
    return f"{rounded}, the residuals of the order conditions are {size}"


def upwards(x: float) -> str:
    """Return a positive number as text, with two significant digits. The number is rounded upwards.

    >>> upwards(1.01e-16), upwards(2e-5)
    ('1.1e-16', '2.0e-05')
    """
    nearest = f"{x:.1e}"
    if float(nearest) >= x:
        return nearest
    digits, _, exponent = nearest.partition("e")
    return f"{float(f'{float(digits) + 0.1:.1f}e{exponent}'):.1e}"


def _certified(method: Method, order: FamilyOrder, classical: str = "") -> CertifiedOrder:
    # Coefficients that are doubles are emitted exactly.
    known = method.coefficients is None or method.coefficients.doubles
    radius = "" if known else uncertainty(method.tableau, DOUBLE_BITS)
    bound = order.limit is not None
    return CertifiedOrder(order.order, order.certificate, bound, order.failing, classical, radius)
