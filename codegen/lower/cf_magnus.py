"""Commutator-free Magnus methods for y' = A(t).y: products of exponentials, whose exponents are linear
combinations of the values h A(t + c_i h)."""

from __future__ import annotations

from codegen.lower.magnus import MagnusLowering


class CommutatorFreeMagnusLowering(MagnusLowering):
    """Commutator-free Magnus methods: Magnus methods without brackets."""

    family = "cf_magnus"
