"""Vector functions: functions of arrays whose result is an array, for example the matrix exponential.

In expressions, result k is a call of the function ``NAME.k`` with all scalars of the arrays as arguments
(:mod:`codegen.ir.vector_calls`). In emitted code one call computes all results.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar
    from codegen.ir.expr import Expr


class VectorFunction(ABC):
    """A function of arrays of scalars with ``size`` results. ``n`` is the number of rows of its matrices."""

    n: int

    @property
    @abstractmethod
    def name(self) -> str:
        """The name in expressions and in emitted code."""

    @property
    @abstractmethod
    def size(self) -> int:
        """The number of results."""

    @property
    def arrays(self) -> tuple[int, ...]:
        """The lengths of the arrays of arguments. By default there is one array with ``size`` entries."""
        # This suits a function that maps a matrix to a matrix of the same size.
        return (self.size,)

    @property
    @abstractmethod
    def operations(self) -> dict[str, int]:
        """A typical number of additions and multiplications in a call."""

    @abstractmethod
    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative of the results, where ``rates`` are the derivatives of the arguments."""

    def derivative(self, args: Sequence[Expr], argument: int) -> tuple[Expr, ...]:
        """Return the derivatives of the results with respect to the argument with the index ``argument``."""
        space = args[0].space
        # A partial derivative is the derivative in one direction. The rate of this one argument is 1, and all
        # other rates are 0.
        return self.tangent(args, [space.one if k == argument else space.zero for k in range(len(args))])

    @abstractmethod
    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return expressions that replace the results of a call, or None if the call is not replaced."""

    @abstractmethod
    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the results in doubles, computed by the same operations as in emitted code.

        A result without correct digits is NaN.
        """

    @abstractmethod
    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for numbers of an mpmath context with ``digits`` decimal digits."""

    @abstractmethod
    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for power series of a ring, exactly."""
