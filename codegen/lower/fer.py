"""Fer methods for y' = A(t).y: a step from y0 to y1 is y1 = exp(F_1) exp(F_2).y0.

F_1 is a quadrature formula for the integral of A over the step. F_2 is a sum of brackets of h A(t + c_i h),
where c_i are the nodes of the tableau.
"""

from __future__ import annotations

from codegen.lower.magnus import MagnusLowering


class FerLowering(MagnusLowering):
    """Fer methods.

    The exponent of the factor that acts last has no brackets. Every other exponent is a sum of brackets.
    """

    # A Fer tableau lists exponents, as a Magnus tableau does, so both families have the same lowering.
    family = "fer"
