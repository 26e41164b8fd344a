"""Types of values: what the operations of a step program take and return.

The domain decides the type of a scalar, and the kind of an operation decides whether a value is a scalar or a
flat tuple of scalars (:data:`codegen.ir.program.SIGNATURES`). Both are known only when a program runs.
"""

from __future__ import annotations

from typing import Any

Value = Any
"""A scalar of one domain for the kind Real, a flat tuple of scalars for every other kind."""

Values = tuple[Value, ...]
"""The arguments or the results of an operation."""

Bindings = dict[str, Any]
"""Scalars of one domain by symbol."""
