"""The domain of the formulas of scenes: expressions without products of matrices."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.matrix_product import BilinearFunction
from codegen.ir.vector_calls import named


class Formulas(ExprDomain):
    """A domain of expressions in which products and commutators of matrices are expanded into sums of scalar
    terms.

    The formulas of a scene are differentiated, expanded in series, and evaluated by other libraries. These
    operations accept scalar formulas only, so no vector function may remain in a formula.
    """

    def __init__(self, domain: ExprDomain) -> None:
        super().__init__(domain.space)
        # Both domains use one table of samples, so that inputs at the same time are the same symbols.
        self.samples = domain.samples

    def vector(self, function: str, args: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the terms of a product or commutator. For other functions return one call node for each
        result.
        """
        called = named(function)
        if isinstance(called, BilinearFunction):
            return called.arithmetic(args)
        return super().vector(function, args)
