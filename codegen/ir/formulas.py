"""An arithmetic of expressions for a user's formulas. It expands products of matrices to scalar formulas."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.matrix_product import BilinearFunction
from codegen.ir.vector_calls import named


class Formulas(ExprDomain):
    """A domain of expressions in which products and commutators of matrices become scalar formulas.

    The user's formulas are differentiated, expanded in series, and evaluated by other libraries. These
    operations accept scalar formulas only.
    """

    def __init__(self, domain: ExprDomain) -> None:
        super().__init__(domain.space)
        # ``samples`` contains the symbols for functions of time. Both domains use the same table, so that the
        # values of a function at the same time have the same symbol.
        self.samples = domain.samples

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the results of a vector function. A product or commutator of matrices gives scalar formulas.
        All other functions are treated as in :class:`ExprDomain`.
        """
        called = named(function)
        if isinstance(called, BilinearFunction):
            return called.arithmetic(args)
        return super().vector(function, args)
