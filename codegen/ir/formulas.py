"""A domain that converts a user's formulas to scalar formulas, also products of matrices."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.matrix_product import BilinearFunction
from codegen.ir.vector_calls import named


class Formulas(ExprDomain):
    """A domain of expressions in which products and commutators of matrices become scalar formulas.

    The compiler differentiates the user's formulas, expands them in series, and passes them to other
    libraries. This is only possible for scalar formulas.
    """

    def __init__(self, domain: ExprDomain) -> None:
        super().__init__(domain.space)
        # ``samples`` contains the symbols for the values of functions of time. The new domain and ``domain``
        # share this table, so the value of a function at a time t has only one symbol.
        self.samples = domain.samples

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the results of a vector function. If it is a product or commutator of matrices, the results
        are scalar formulas. All other functions are treated as in :class:`ExprDomain`.
        """
        called = named(function)
        if isinstance(called, BilinearFunction):
            return called.arithmetic(args)
        return super().vector(function, args)
