"""Products and commutators of n x n matrices as vector functions."""

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
    """A bilinear function of two n x n matrices.

    The results need only additions and multiplications, so one formula suffices for doubles, mpmath numbers
    and power series.
    """

    @property
    def size(self) -> int:
        """The number of results."""
        return self.n**2

    @property
    def arrays(self) -> tuple[int, ...]:
        """The numbers of entries of the two matrices."""
        return (self.n**2, self.n**2)

    @abstractmethod
    def arithmetic(self, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for doubles, mpmath numbers or power series, by the same formula."""

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivative f(a', b) + f(a, b') of f(a, b), where a' and b' are the derivatives of the
        matrices.
        """
        space, size = args[0].space, self.size
        total = (space.zero,) * size
        # The two passes compute f(a', b) and f(a, b').
        for pair in ((*rates[:size], *args[size:]), (*args[:size], *rates[size:])):
            changing = rates[:size] if pair[:size] == tuple(rates[:size]) else rates[size:]
            # If a matrix is constant, its term is zero and needs no call.
            if not all(x.is_zero for x in changing):
                term = space.vector(self.name, pair)
                total = tuple(x + y for x, y in zip(total, term, strict=True))
        return total

    def derivative(self, args: Sequence[Expr], argument: int) -> tuple[Expr, ...]:
        """Return the derivatives of the results with respect to the scalar with the index ``argument``.

        This scalar is an entry of one matrix, so the derivatives are linear in the other matrix.
        """
        space = args[0].space
        # f is linear in each matrix. Hence the derivative is the value of f after one replacement: the matrix
        # that contains the argument becomes a matrix with a single 1 and zeros elsewhere.
        unit = [space.one if k == argument else space.zero for k in range(len(args))]
        # ``half`` selects the entries of the replaced matrix.
        half = slice(0, self.size) if argument < self.size else slice(self.size, None)
        changed = list(args)
        changed[half] = unit[half]
        # Most entries are zero, so the sums are short and a call would cost more.
        return self.arithmetic(changed)

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return zeros if one of the two matrices is zero, otherwise None."""
        if all(x.is_zero for x in args[: self.size]) or all(x.is_zero for x in args[self.size :]):
            return (args[0].space.zero,) * self.size
        return None

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the results in doubles."""
        return self.arithmetic(args)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for mpmath numbers."""
        return self.arithmetic(args)

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the results for power series."""
        return self.arithmetic(args)


@dataclass(frozen=True)
class MatrixProduct(BilinearFunction):
    """The product a b of two matrices."""

    n: int

    @property
    def name(self) -> str:
        """The name in expressions and in emitted code."""
        return f"product{self.n}"

    @property
    def operations(self) -> dict[str, int]:
        """The number of operations of a product."""
        return {"add": self.n**3 - self.n**2, "mul": self.n**3}

    def arithmetic(self, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the product a b."""
        return tuple(product(self.n, 0, args[: self.size], args[self.size :]))


@dataclass(frozen=True)
class MatrixCommutator(BilinearFunction):
    """The commutator a b - b a of two matrices."""

    n: int

    @property
    def name(self) -> str:
        """The name in expressions and in emitted code."""
        return f"commutator{self.n}"

    @property
    def operations(self) -> dict[str, int]:
        """The number of operations of two products and a difference."""
        return {"add": 2 * self.n**3 - self.n**2, "mul": 2 * self.n**3}

    def arithmetic(self, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the commutator a b - b a."""
        a, b = args[: self.size], args[self.size :]
        pairs = zip(product(self.n, 0, a, b), product(self.n, 0, b, a), strict=True)
        return tuple(x - y for x, y in pairs)
