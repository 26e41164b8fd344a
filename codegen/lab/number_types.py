"""Type aliases for numbers, vectors and functions that evaluate formulas.

The variables of a formula can be floats, mpmath numbers, Arb balls, power series and expressions. These
types have no common base class. Therefore the aliases allow every type.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

Scalar: TypeAlias = Any
"""A float, mpmath number, Arb ball, power series or expression."""

Vector: TypeAlias = tuple[Scalar, ...]
"""The coordinates of a state, or of an element of a Lie algebra."""

Evaluate: TypeAlias = Callable[..., Vector]
"""A function ``(state, t) -> values``, for example a vector field, compiled for one type of numbers."""
