"""A domain that converts products and commutators of matrices to scalar formulas."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.matrix_product import BilinearFunction
from codegen.ir.vector_calls import named


class Formulas(ExprDomain):
    """A domain of expressions in which products and commutators of matrices become scalar formulas.

    The compiler computes the time derivatives of states in this domain, because other libraries need scalar
    formulas.
    """

    def __init__(self, domain: ExprDomain) -> None:
        super().__init__(domain.space)
        # This domain and ``domain`` use the same symbols for the values of functions of time.
        self.samples = domain.samples

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the results of a vector function. The results of products and commutators of matrices are
        scalar formulas.
        """
        called = named(function)
        if isinstance(called, BilinearFunction):
            return called.arithmetic(args)
        return super().vector(function, args)
