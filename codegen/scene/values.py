"""Types of the values of formulas."""

from __future__ import annotations

from codegen.ir.domain import Scalar

Bindings = dict[str, Scalar]
"""Maps the name of each symbol in a formula to its value. All values are scalars of the same number
domain."""
