"""Shared angles: arguments that are equal as polynomials become one expression.

Variational methods exponentiate h xi, h xi/2 and -h xi/2 in one stage. Written as sums of squares, z of the
second, z of the third and a quarter of z of the first differ, and their Stumpff functions would be computed
three times. As polynomials in symbols and earlier calls they are equal.
"""

from __future__ import annotations

from itertools import islice

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, walk
from codegen.ir.normal_form import NormalForms, Polynomial, TooLong

LONGEST = 64
"""Arguments with more nodes than this are not compared.

Equal angles occur between unknowns of implicit stages; on the gallery their arguments have 12 to 42 nodes.
Arguments of explicit stages have hundreds or thousands. Limits of 64, 128 and 256 give the same kernels for
nine methods of the gallery; 32 changes one of them, vcf:cf4 on dipole, from 301 to 286 operations a step."""


class SharedArguments(ExprDomain):
    """Expressions whose Stumpff functions are called with the first of equal arguments."""

    def __init__(self, space: Space | None = None) -> None:
        super().__init__(space)
        self.normal = NormalForms(self.space)
        self.arguments: list[tuple[Polynomial, Expr]] = []
        self.shared: dict[int, Expr] = {}

    def call(self, function: str, *args: Expr) -> Expr:
        """Return a call node."""
        # Only functions of angles: a step spends most of its time in them.
        if function.startswith("stumpff"):
            args = (self._first(args[0]),)
        return super().call(function, *args)

    def _first(self, argument: Expr) -> Expr:
        """Return the argument of an earlier call that equals this one, or this one."""
        # By node number: equal nodes are one node, and expanding a polynomial is slow.
        if argument.id not in self.shared:
            self.shared[argument.id] = self._compared(argument)
        return self.shared[argument.id]

    def _compared(self, argument: Expr) -> Expr:
        # islice stops early: explicit stages have arguments with thousands of nodes.
        if len(list(islice(walk([argument]), LONGEST + 1))) > LONGEST:
            return argument
        try:
            polynomial = self.normal.polynomial(argument)
        except TooLong:
            return argument
        # Compared one by one: polynomials are dicts and have no hash. A step has few angles.
        for known, first in self.arguments:
            if known == polynomial:
                return first
        self.arguments.append((polynomial, argument))
        return argument
