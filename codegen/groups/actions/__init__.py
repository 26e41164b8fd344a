"""Left actions of groups on manifolds. Each action has its own file."""

from __future__ import annotations

from codegen.groups.actions.adjoint import AdjointAction
from codegen.groups.actions.affine import AffineAction
from codegen.groups.actions.base import Action
from codegen.groups.actions.coadjoint import CoadjointAction
from codegen.groups.actions.columns import Columns
from codegen.groups.actions.conjugation import Conjugation
from codegen.groups.actions.diagonal import DiagonalAction
from codegen.groups.actions.factorwise import FactorwiseAction
from codegen.groups.actions.left_multiplication import LeftMultiplication
from codegen.groups.actions.linear import Linear
from codegen.groups.actions.motion import Motion
from codegen.groups.actions.right_multiplication import RightMultiplication
from codegen.groups.actions.rotation import Rotation
from codegen.groups.actions.stiefel import Stiefel
from codegen.groups.registry import Registry

__all__ = [
    "Action",
    "AdjointAction",
    "AffineAction",
    "CoadjointAction",
    "Columns",
    "Conjugation",
    "DiagonalAction",
    "FactorwiseAction",
    "LeftMultiplication",
    "Linear",
    "Motion",
    "RightMultiplication",
    "Rotation",
    "Stiefel",
]

ACTIONS: Registry[Action] = Registry("action", __name__, [n for n in __all__ if n != "Action"])


def listing() -> list[dict[str, str]]:
    """Return the name and the first docstring paragraph of every action, for ``orderconds list actions``."""
    return ACTIONS.listing()
