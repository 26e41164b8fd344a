"""Products and commutators of n x n matrices as vector functions (functions whose result is an array)."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from codegen.ir.matrix_exponential import product
from codegen.ir.vector_function import VectorFunction

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar
    from codegen.ir.expr import Expr


class BilinearFunction(VectorFunction):
    """A bilinear function f(a, b) of two n x n matrices, whose result is an n x n matrix.

    The result is computed by additions, subtractions and multiplications of doubles, mpmath numbers or power
    series.
    """

    @property
    def size(self) -> int:
        """The number of entries of the result."""
        return self.n**2

    @property
    def arrays(self) -> tuple[int, ...]:
        """The numbers of entries of the matrices a and b."""
        return (self.n**2, self.n**2)

    @abstractmethod
    def arithmetic(self, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the entries of f(a, b), where f is this function.

        ``args`` are the entries of a and b. The entries may be doubles, mpmath numbers, power series or
        expressions.
        """

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative f(a', b) + f(a, b') of f(a, b).

        ``args`` are the entries of a and b, and ``rates`` are the entries of their derivatives a' and b'.
        """
        space, size = args[0].space, self.size
        total = (space.zero,) * size
        # By the product rule, the derivative of f(a, b) is the sum of f(a', b) and f(a, b'). Here f is this
        # function, and a' and b' are the derivatives of the matrices a and b.
        for pair in ((*rates[:size], *args[size:]), (*args[:size], *rates[size:])):
            changing = rates[:size] if pair[:size] == tuple(rates[:size]) else rates[size:]
            # ``changing`` is the derivative of one of the two matrices. If this derivative is zero, its term
            # in the sum is zero and is omitted.
            if not all(x.is_zero for x in changing):
                term = space.vector(self.name, pair)
                total = tuple(x + y for x, y in zip(total, term, strict=True))
        return total

    def derivative(self, args: Sequence[Expr], argument: int) -> tuple[Expr, ...]:
        """Return the derivatives of the entries of f(a, b) with respect to one entry of a or b.

        ``args`` are the entries of a and b, and ``argument`` is the index of this one entry in ``args``.
        """
        space = args[0].space
        # The derivative of f(a, b) with respect to an entry of a is f(E, b), and with respect to an entry of
        # b, it is f(a, E). The entry of E at the same position is 1, and all other entries of E are 0.
        unit = [space.one if k == argument else space.zero for k in range(len(args))]
        # ``half`` selects the half of ``args`` that contains ``args[argument]``. The first half contains the
        # first matrix, and the second half contains the second matrix.
        half = slice(0, self.size) if argument < self.size else slice(self.size, None)
        changed = list(args)
        changed[half] = unit[half]
        # The derivatives are returned as scalar formulas, without a call of the function f. The formulas are
        # short, because one of the two matrices in ``changed`` has only one entry that is not zero.
        return self.arithmetic(changed)

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Simplify f(a, b), where f is this function and ``args`` are the entries of the matrices a and b.

        If a or b is zero, the result is a tuple of n^2 zeros, because f(a, b) is the zero matrix. Otherwise
        the result is None, and emitted code must call f.
        """
        # A bilinear function is zero if one of its arguments is zero.
        if all(x.is_zero for x in args[: self.size]) or all(x.is_zero for x in args[self.size :]):
            return (args[0].space.zero,) * self.size
        return None

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the entries of f(a, b) as doubles. ``args`` are the entries of a, then the entries of b."""
        return self.arithmetic(args)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the entries of f(a, b) as mpmath numbers. ``args`` are the entries of a and b."""
        return self.arithmetic(args)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the entries of the result for two matrices of power series.

        ``args`` are the entries of the first matrix, followed by the entries of the second matrix.
        """
        return self.arithmetic(args)


@dataclass(frozen=True)
class MatrixProduct(BilinearFunction):
    """The product a b of two n x n matrices."""

    n: int

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"product{self.n}"

    @property
    def operations(self) -> dict[str, int]:
        """The numbers of additions and multiplications in the product of two matrices."""
        # Each of the n^2 entries is a sum of n products with n - 1 additions.
        return {"add": self.n**3 - self.n**2, "mul": self.n**3}

    def arithmetic(self, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the entries of the product a b, row by row."""
        return tuple(product(self.n, 0, args[: self.size], args[self.size :]))


@dataclass(frozen=True)
class MatrixCommutator(BilinearFunction):
    """The commutator a b - b a of two n x n matrices."""

    n: int

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"commutator{self.n}"

    @property
    def operations(self) -> dict[str, int]:
        """The numbers of additions and multiplications in the commutator a b - b a."""
        return {"add": 2 * self.n**3 - self.n**2, "mul": 2 * self.n**3}

    def arithmetic(self, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the entries of the commutator a b - b a, row by row."""
        a, b = args[: self.size], args[self.size :]
        pairs = zip(product(self.n, 0, a, b), product(self.n, 0, b, a), strict=True)
        return tuple(x - y for x, y in pairs)
