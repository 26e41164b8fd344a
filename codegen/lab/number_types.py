"""Type aliases for numbers, vectors and functions that evaluate formulas.

The aliases allow every type, because floats, Arb balls, power series and expressions have no common base
class.
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
