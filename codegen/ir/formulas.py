"""Scalar formulas for the entries of matrix products and commutators."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.matrix_product import BilinearFunction
from codegen.ir.vector_calls import named


class Formulas(ExprDomain):
    """A domain of expressions. Each entry of a matrix product or commutator is a scalar formula.

    The compiler computes the time derivatives of states in this domain.
    """

    def __init__(self, domain: ExprDomain) -> None:
        super().__init__(domain.space)
        # The dictionary ``samples`` contains the symbols for values of functions of time. This domain and the
        # given ``domain`` share the dictionary, because they must use the same symbols.
        self.samples = domain.samples

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the results of a vector function.

        Matrix products and commutators are replaced by scalar formulas for their entries.
        """
        called = named(function)
        if isinstance(called, BilinearFunction):
            return called.arithmetic(args)
        return super().vector(function, args)
