"""Shared angles: arguments that are equal as polynomials become one expression.

Variational methods need the exponentials of h xi/2 and -h xi/2 in one stage. Each exponential contains
Stumpff functions of the squared norm of its argument. The squared norms of h xi/2 and -h xi/2 are equal, but
their expressions differ. This module detects that both expressions are equal as polynomials in symbols and in
the results of earlier calls. Equal arguments then need one call.
"""

from __future__ import annotations

from itertools import islice

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.normal_form import NormalForms, Polynomial, TooLong

LONGEST = 64
"""Two arguments of Stumpff functions are compared only if each has at most this number of nodes.

Equal angles occur in implicit stages. In the methods of the gallery these angles have 12 to 42 nodes, so the
limit includes all of them. Arguments of explicit stages have hundreds or thousands of nodes.

Limits of 64, 128 and 256 give the same kernels for nine methods of the gallery. The limit 32 changes only one
of these kernels: a step of vcf:cf4 on dipole then has 286 operations in place of 301.
"""


class SharedArguments(ExprDomain):
    """An arithmetic of expressions. Arguments of Stumpff functions that are equal as polynomials become one
    node.
    """

    def __init__(self, space: Space | None = None) -> None:
        super().__init__(space)
        self.normal = NormalForms(self.space)
        self.arguments: list[tuple[Polynomial, Expr]] = []
        self.shared: dict[int, Expr] = {}

    def call(self, function: str, *args: Expr) -> Expr:
        """Return the node of a function call. Calls of a Stumpff function have the same node if their
        arguments are equal as polynomials.
        """
        # Only Stumpff functions are compared, because a step spends most of its time in them.
        if function.startswith("stumpff"):
            args = (self._first(args[0]),)
        return super().call(function, *args)

    def _first(self, argument: Expr) -> Expr:
        """Return the earliest argument of a Stumpff function that equals ``argument`` as a polynomial."""
        # Expanding a polynomial is slow, so results are stored by node number.
        if argument.id not in self.shared:
            self.shared[argument.id] = self._compared(argument)
        return self.shared[argument.id]

    def _compared(self, argument: Expr) -> Expr:
        # In explicit stages, arguments of Stumpff functions may have thousands of nodes. The walk stops as
        # soon as it exceeds the limit.
        if len(list(islice(walk([argument]), LONGEST + 1))) > LONGEST:
            return argument
        try:
            polynomial = self.normal.polynomial(argument)
        except TooLong:
            return argument
        # Polynomials are dicts and have no hash, so angles are compared one by one.
        for known, first in self.arguments:
            if known == polynomial:
                return first
        # The polynomial is new. Later arguments with an equal polynomial are replaced by this argument.
        self.arguments.append((polynomial, argument))
        return argument
