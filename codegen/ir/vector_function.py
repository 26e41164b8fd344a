"""Vector functions: functions of arrays whose result is an array, for example the matrix exponential.

In an expression, ``NAME.k`` denotes entry k of the result of the vector function ``NAME``
(:mod:`codegen.ir.vector_calls`). The arguments of ``NAME.k`` are the entries of all argument arrays of
``NAME``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar
    from codegen.ir.expr import Expr


class VectorFunction(ABC):
    """A function whose arguments are arrays of scalars, and whose result is an array of ``size`` scalars.

    An array may contain the entries of a matrix, row by row. The attribute ``n`` is the number of rows of
    this matrix.
    """

    n: int

    @property
    @abstractmethod
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""

    @property
    @abstractmethod
    def size(self) -> int:
        """The number of results of the function."""

    @property
    def arrays(self) -> tuple[int, ...]:
        """The lengths of the argument arrays."""
        # By default there is one argument array, with as many entries as the function has results.
        return (self.size,)

    @property
    @abstractmethod
    def operations(self) -> dict[str, int]:
        """The typical numbers of additions (``add``) and multiplications (``mul``) in one call."""

    @abstractmethod
    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivatives of the results in the direction ``rates``.

        ``rates`` contains one component of the direction for each argument.
        """

    def derivative(self, args: Sequence[Expr], argument: int) -> tuple[Expr, ...]:
        """Return the derivatives of the results with respect to the argument with the index ``argument``."""
        space = args[0].space
        # A partial derivative is the derivative in the direction of a unit vector.
        return self.tangent(args, [space.one if k == argument else space.zero for k in range(len(args))])

    @abstractmethod
    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return simpler expressions for the results of the function with the arguments ``args``.

        If no simpler expressions are known, return None. Then emitted code calls the function.
        """

    @abstractmethod
    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the results in doubles, computed by the same operations as in emitted code.

        All results are NaN if the function fails, for example if a matrix is singular or too large.
        """

    @abstractmethod
    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for mpmath numbers. ``context`` is the mpmath context, and ``digits`` is the
        number of decimal digits.
        """

    @abstractmethod
    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results as truncated power series in ``ring``.

        The arguments are truncated power series in ``ring``, too.
        """
