"""The order of a continuous extension (dense output).

In a step of size h from the time t, the extension approximates the solution at the times t + theta h with
0 <= theta <= 1. The weights b_i(theta) of the extension are polynomials in theta.

The order condition of a rooted tree with n vertices has the right-hand side theta^n/gamma, where gamma is the
density of the tree. Both sides are polynomials in theta. For each power of theta, the check compares the
coefficients on both sides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from orderconds import families
from orderconds.checking.report import ExtensionOrder
from orderconds.checking.residuals import Failure, judge
from orderconds.conditions import OrderCondition
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau import RungeKutta, Tableau
from orderconds.tableau.extension import Extension


def extension_order(tableau: Tableau) -> ExtensionOrder | None:
    """Return the order of the continuous extension of a tableau, or None if there is no extension.

    The search ends one order above the claimed order of the extension.

    >>> order = extension_order(Tableau.load("rk4"))
    >>> order.order, order.certificate, order.continuous
    (3, 'exact', True)
    """
    extension, method, ring = tableau.extension, tableau.method, tableau.ring
    if extension is None or not isinstance(method, RungeKutta):
        return None
    certificate, failing = "exact", tuple[Failure, ...]()
    order, limit = 0, extension.order + 1
    while order < limit:
        verdicts, failing = _judged(method, extension, ring, order + 1)
        if failing or "undecided" in verdicts:
            certificate = certificate if failing else "none"
            break
        certificate = "decimal" if "supported" in verdicts else certificate
        order += 1
    continuous = _equal(ring, extension.at_end(), method.b)
    smooth = _is_smooth(method, extension, ring) if continuous else continuous
    return ExtensionOrder(extension.order, order, certificate, continuous, smooth, failing)


def _judged(
    method: RungeKutta, extension: Extension, ring: Ring, n: int
) -> tuple[set[str], tuple[Failure, ...]]:
    """Return the verdicts on the conditions of order n for dense output, and the conditions that fail.

    Both sides of each condition are polynomials in theta. The coefficients of theta^p on both sides are
    compared for p = 1, 2, ... The comparison ends at the first p for which a condition fails, and the result
    contains only the verdicts and the failing conditions for this p. If no condition fails, the result
    contains the verdicts for all p, and an empty tuple.
    """
    family = families.get("rk")
    verdicts: set[str] = set()
    for p in range(1, max(extension.degree, n) + 1):
        b = extension.power(p) if p <= extension.degree else (ring.zero,) * len(method.b)
        conditions = tuple(_coefficient(c, p, n) for c in family.conditions(n))
        judged, failing = judge(family, RungeKutta(method.A, b), ring, conditions)
        if failing:
            return judged, failing
        verdicts |= judged
    return verdicts, ()


def _coefficient(condition: OrderCondition, p: int, n: int) -> OrderCondition:
    """Return the equation for the coefficients of theta^p in an order condition of dense output.

    ``condition`` is a condition of order n for the weights b_i of a step. Dense output has the weights
    b_i(theta), which are polynomials in theta, and the condition for b_i(theta) has the right-hand side
    ``condition.rhs`` * theta^n. In the result, b_i denotes the coefficient of theta^p in b_i(theta).
    Therefore the right-hand side of the result is ``condition.rhs`` if p = n, and zero otherwise.
    """
    rhs = condition.rhs if p == n else 0 * condition.rhs
    return replace(condition, rhs=rhs, tree=f"theta^{p}, {condition.tree}")


def _is_smooth(method: RungeKutta, extension: Extension, ring: Ring) -> bool | None:
    """Return True if the derivative of the extension equals the vector field at both ends of a step.

    Return None if rounded coefficients do not decide the question.
    """
    s = len(method.b)
    first, last = (tuple(ring.one if i == k else ring.zero for i in range(s)) for k in (0, s - 1))
    ends = extension.combined(tuple(ring.rational(p) for p in range(1, extension.degree + 1)))
    zero = (ring.zero,) * s
    tests = (
        _equal(ring, method.A[0], zero),
        _equal(ring, method.A[-1], method.b),
        _equal(ring, extension.power(1), first),
        _equal(ring, ends, last),
    )
    return False if False in tests else None if None in tests else True


def _equal(ring: Ring, x: Sequence[Element], y: Sequence[Element]) -> bool | None:
    """Return whether two vectors are equal. Return None if rounding errors prevent a decision."""
    tests = [ring.is_zero(a - b) for a, b in zip(x, y, strict=True)]
    return False if False in tests else None if None in tests else True
