"""Types of the values of formulas."""

from __future__ import annotations

from codegen.ir.domain import Scalar

Bindings = dict[str, Scalar]
"""The value of each symbol in a formula, by the name of the symbol. All values belong to one domain."""
