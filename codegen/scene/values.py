"""Types of the values of formulas."""

from __future__ import annotations

from codegen.ir.domain import Scalar

Bindings = dict[str, Scalar]
"""A mapping from the names of symbols to their values. All values belong to one domain."""
