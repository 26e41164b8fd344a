"""Pictures of scenes: the figures that a scene file declares, drawn from emitted C.

Each kind of figure (:mod:`codegen.scene.figure`) is drawn by one module of this package.
"""

from codegen.lab.pictures.registry import draw, listing, register

__all__ = ["draw", "listing", "register"]
