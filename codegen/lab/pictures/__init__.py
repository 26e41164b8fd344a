"""Draws the figures that scene files declare. All curves are computed with emitted C code.

For each class of figures in :mod:`codegen.scene.figure`, one module of this package draws the figures.
"""

from codegen.lab.pictures.registry import draw, listing, register

__all__ = ["draw", "listing", "register"]
