"""Types of the values of formulas."""

from __future__ import annotations

from codegen.ir.domain import Scalar

Bindings = dict[str, Scalar]
"""The value of each symbol. All values are scalars of the same number domain."""
