"""Measures methods in runs of many steps.

The modules measure the drift of conserved quantities, the growth of rounding errors, symplecticity and
reversibility.
"""
