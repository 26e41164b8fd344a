"""Compute and certify the order of a tableau in each family in which its file claims an order.

A claim holds only if the claimed order equals the computed order.

The residual of a condition is its left-hand side minus its right-hand side. If the coefficients are rounded,
the residual is a ball: an approximate value with an error bound. The certificate states how the order was
established:

- ``exact``: every residual up to the order is zero in an exact ring.
- ``ball``: interval arithmetic proves that exact coefficients with the computed order exist
  (:mod:`orderconds.proof`). Each decimal differs from the exact coefficient by at most one unit of the last
  digit.
- ``decimal``: every residual up to the order is zero or a narrow ball that contains zero. The order is not
  proved.
- ``double``: as ``decimal``, but the coefficients are doubles.
- ``none``: a residual is a ball that contains zero, but the ball is too wide for the certificate ``decimal``.
  The order is ``undecided``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy

if TYPE_CHECKING:
    from orderconds.checking.claimable import claimable_families, unclaimed
    from orderconds.checking.order import FamilyOrder, family_order
    from orderconds.checking.report import EmbeddedOrder, Report
    from orderconds.checking.residuals import Failure, judge
    from orderconds.checking.verdict import check, read

__all__ = [
    "EmbeddedOrder",
    "Failure",
    "FamilyOrder",
    "Report",
    "check",
    "claimable_families",
    "family_order",
    "judge",
    "read",
    "unclaimed",
]

lazy(
    __name__,
    claimable=("claimable_families", "unclaimed"),
    order=("FamilyOrder", "family_order"),
    report=("EmbeddedOrder", "Report"),
    residuals=("Failure", "judge"),
    verdict=("check", "read"),
)
