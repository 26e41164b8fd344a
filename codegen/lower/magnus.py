"""Magnus methods for y' = A(t).y: a step applies one exponential, or a product of several exponentials.

The exponents are linear combinations of the values A_i = h A(t + c_i h) and of brackets of these values. In a
tableau, [2,1] denotes the bracket [A_2, A_1]. The group acts from the left. The first exponential of the
tableau is applied first.
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
        # ``exp`` gives a group element g, and ``act`` computes g.y.
        return stages.builder.act("Y", stages.builder.exp("g", x), y)
