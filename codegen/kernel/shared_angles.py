"""Shared angles: equal arguments of Stumpff functions become one expression.

Variational methods need the exponentials of h xi/2 and -h xi/2 in one stage. Here h is the step size, and xi
is an element of the Lie algebra. Both exponentials contain Stumpff functions of the same squared norm, but
the expressions for this norm differ.
"""

from __future__ import annotations

from itertools import islice

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.normal_form import NormalForms, Polynomial, TooLong

LONGEST = 64
"""A limit for the search for equal arguments of Stumpff functions.

An argument is an expression. Each operation, symbol or constant in the expression is a node. An argument with
more than LONGEST nodes is not compared with arguments of earlier calls.

The limit 64 is sufficient for the methods of the gallery, because the arguments that equal an earlier
argument have only 12 to 42 nodes. For nine of these methods, the limits 64, 128 and 256 give the same
kernels.
"""


class SharedArguments(ExprDomain):
    """Symbolic arithmetic. Equal arguments of Stumpff functions become one expression.

    Two arguments are equal if their expansions as polynomials are equal.
    """

    def __init__(self, space: Space | None = None) -> None:
        super().__init__(space)
        self.normal = NormalForms(self.space)
        self.arguments: list[tuple[Polynomial, Expr]] = []
        self.shared: dict[int, Expr] = {}

    def call(self, function: str, *args: Expr) -> Expr:
        """Return the expression of a function call.

        Two calls of a Stumpff function with equal arguments give one expression.
        """
        if function.startswith("stumpff"):
            args = (self._first(args[0]),)
        return super().call(function, *args)

    def _first(self, argument: Expr) -> Expr:
        """Return the expression that a call of a Stumpff function uses in place of ``argument``.

        If :meth:`_compared` finds an earlier argument with the same expansion as a polynomial, the earlier
        argument is returned, so that equal calls become one expression. Otherwise ``argument`` is returned.
        """
        # The expansion as a polynomial is slow, so the result for each node is stored.
        if argument.id not in self.shared:
            self.shared[argument.id] = self._compared(argument)
        return self.shared[argument.id]

    def _compared(self, argument: Expr) -> Expr:
        # At most LONGEST + 1 nodes are visited. In methods with explicit stages, an argument can have
        # thousands of nodes. A visit of all these nodes would be slow.
        if len(list(islice(walk([argument]), LONGEST + 1))) > LONGEST:
            return argument
        try:
            polynomial = self.normal.polynomial(argument)
        # If the polynomial is too long, ``argument`` is returned without a comparison.
        except TooLong:
            return argument
        # A polynomial is a dict and cannot be a key, so polynomials are compared one by one.
        for known, first in self.arguments:
            if known == polynomial:
                return first
        # If a later argument has the same polynomial, it will be replaced by ``argument``.
        self.arguments.append((polynomial, argument))
        return argument
