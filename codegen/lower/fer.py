"""Fer methods for y' = A(t).y: exp(F_1) exp(F_2), where F_1 is a quadrature, and F_2 a sum of brackets."""

from __future__ import annotations

from codegen.lower.magnus import MagnusLowering


class FerLowering(MagnusLowering):
    """Fer methods: the exponent that acts last has no brackets, and all other exponents are sums of
    brackets."""

    family = "fer"
