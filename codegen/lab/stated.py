"""The stated order of a method: what its tableau's order conditions in its family say, computed exactly."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.errors import MethodError
from codegen.method import Method


@dataclass(frozen=True)
class Stated:
    """An order and how it is certified: ``exact``, ``ball``, ``decimal``, or ``claimed``."""

    order: int
    certificate: str


def stated(method: Method) -> Stated:
    """Return the order of a method; :class:`MethodError` where nothing is known of it."""
    claim = method.tableau.claims.order(method.family, method.cutoff)
    if claim is None:
        raise MethodError(f"no order is claimed of {method.label}", expected="a claim in the tableau's file")
    return Stated(claim, "claimed")
