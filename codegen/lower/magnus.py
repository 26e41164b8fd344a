"""Magnus methods for y' = A(t).y: a step applies one exponential, or a product of several exponentials.

The exponents are combinations of the values h A_i = h A(t + c_i h) and their brackets. The conventions are
those of :mod:`orderconds.families.magnus`: with a left action, [2,1] is the bracket [A_2, A_1], and the first
exponential acts first.
"""

from __future__ import annotations

from codegen.ir.values import Var
from codegen.lower.linear import LinearLowering
from codegen.lower.stages import Stages


class MagnusLowering(LinearLowering):
    """Magnus methods, with one exponential or with several."""

    family = "magnus"

    def move(self, stages: Stages, x: Var, y: Var) -> Var:
        """Append the operations for exp(x).y to the program, and return the result."""
        # The exponential is a group element, which then acts on the point.
        return stages.builder.act("Y", stages.builder.exp("g", x), y)
