"""Draws the figures that scene files declare. All curves are computed with emitted C code.

Each class of figures in :mod:`codegen.scene.figure` is drawn by one module of this package.
"""

from codegen.lab.pictures.registry import draw, listing, register

__all__ = ["draw", "listing", "register"]
