"""Types of the values of formulas."""

from __future__ import annotations

from codegen.ir.domain import Scalar

Bindings = dict[str, Scalar]
"""Scalars of one domain by symbol."""
