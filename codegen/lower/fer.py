"""Fer methods for y' = A(t).y: a step from y0 to y1 is y1 = exp(F_1) exp(F_2).y0.

F_1 approximates the integral of A over the step by a quadrature rule with the nodes c_i. F_2 is a sum of
brackets of the values h A(t + c_i h).
"""

from __future__ import annotations

from codegen.lower.magnus import MagnusLowering


class FerLowering(MagnusLowering):
    """Fer methods.

    The exponential that acts last has an exponent without brackets. All other exponents are sums of brackets.
    """

    # Fer tableaux have the same format as Magnus tableaux.
    family = "fer"
