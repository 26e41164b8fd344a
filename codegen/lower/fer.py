"""Fer methods for y' = A(t).y: exp(F_1) exp(F_2), where F_1 is a quadrature and F_2 contains only brackets."""

from __future__ import annotations

from codegen.lower.magnus import MagnusLowering


class FerLowering(MagnusLowering):
    """Fer methods: Magnus methods whose last exponential contains no brackets, and the others only brackets."""

    family = "fer"
