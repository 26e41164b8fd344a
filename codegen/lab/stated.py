"""The stated order of a method: what its tableau's order conditions in its family say, computed exactly."""

from __future__ import annotations

from codegen.method import Method
from orderconds.check import FamilyOrder, check


def stated(method: Method) -> FamilyOrder:
    """Return order, certificate and first failing conditions of a method in its family.

    Nothing is taken from what the tableau's file claims. Raises what :func:`orderconds.check.check` raises.
    """
    (found,) = check(method.tableau, method.family_label).orders
    return found
