"""Shared angles: arguments that are equal as polynomials become one expression.

Variational methods need the exponentials of h xi, h xi/2 and -h xi/2 in one stage. Each exponential contains
Stumpff functions of the squared norm of its argument. The squared norm of h xi/2, the squared norm of -h
xi/2, and a quarter of the squared norm of h xi are equal numbers, but different expressions. Without this
module a step would compute the Stumpff functions of each expression separately. This module detects that the
expressions are equal as polynomials in symbols and in the results of earlier calls.
"""

from __future__ import annotations

from itertools import islice

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.normal_form import NormalForms, Polynomial, TooLong

LONGEST = 64
"""Arguments with more nodes than this are not compared.

Equal angles occur in implicit stages, as functions of the unknowns. In the methods of the gallery these
angles have 12 to 42 nodes. Arguments of explicit stages have hundreds or thousands of nodes. Limits of 64,
128 and 256 give the same kernels for nine methods of the gallery. With the limit 32 the kernel of one of
these methods changes: a step of vcf:cf4 on dipole has 286 operations instead of 301."""


class SharedArguments(ExprDomain):
    """Expressions in which arguments of Stumpff functions are shared if they are equal as polynomials."""

    def __init__(self, space: Space | None = None) -> None:
        super().__init__(space)
        self.normal = NormalForms(self.space)
        self.arguments: list[tuple[Polynomial, Expr]] = []
        self.shared: dict[int, Expr] = {}

    def call(self, function: str, *args: Expr) -> Expr:
        """Return the node of a function call. If the arguments of two calls of one Stumpff function are equal
        as polynomials, both calls have the same node."""
        # Only Stumpff functions are compared, because a step spends most of its time in them.
        if function.startswith("stumpff"):
            args = (self._first(args[0]),)
        return super().call(function, *args)

    def _first(self, argument: Expr) -> Expr:
        """Return the earliest argument that equals this argument as a polynomial. If no earlier argument is
        equal, this argument is returned.
        """
        # Results are stored by node number, because expanding a polynomial is slow and one argument may occur
        # many times.
        if argument.id not in self.shared:
            self.shared[argument.id] = self._compared(argument)
        return self.shared[argument.id]

    def _compared(self, argument: Expr) -> Expr:
        # ``islice`` stops the walk early, because explicit stages have arguments with thousands of nodes.
        if len(list(islice(walk([argument]), LONGEST + 1))) > LONGEST:
            return argument
        try:
            polynomial = self.normal.polynomial(argument)
        except TooLong:
            return argument
        # Angles are compared one by one, because polynomials are dicts and have no hash. This is fast,
        # because a step has few angles.
        for known, first in self.arguments:
            if known == polynomial:
                return first
        self.arguments.append((polynomial, argument))
        return argument
