"""Commutator-free Magnus methods for y' = A(t).y: a step applies a product of exponentials.

The exponents are linear combinations of the values h A(t + c_i h), where c_i are the nodes of the tableau.
"""

from __future__ import annotations

from codegen.lower.magnus import MagnusLowering


class CommutatorFreeMagnusLowering(MagnusLowering):
    """Commutator-free Magnus methods: Magnus methods without brackets."""

    family = "cf_magnus"
