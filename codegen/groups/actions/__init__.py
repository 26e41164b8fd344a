"""Left actions of groups on manifolds, one file for each action."""

from __future__ import annotations

from codegen.groups.actions.base import Action
from codegen.groups.actions.left_multiplication import LeftMultiplication
from codegen.groups.actions.linear import Linear
from codegen.groups.actions.motion import Motion
from codegen.groups.actions.rotation import Rotation
from codegen.groups.registry import Registry

__all__ = ["Action", "LeftMultiplication", "Linear", "Motion", "Rotation", "listing"]

LISTED = ("LeftMultiplication", "Linear", "Motion", "Rotation")

ACTIONS: Registry[Action] = Registry("action", __name__, LISTED)


def listing() -> list[dict[str, str]]:
    """Return name and first docstring line of every action, for ``orderconds list actions``."""
    return ACTIONS.listing()
