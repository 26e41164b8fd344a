"""Lie groups and their actions.

All coordinates are floats, power series or expressions (see :mod:`codegen.ir.domain`). To define your own
group, write a subclass of :class:`LieGroup` (see :mod:`codegen.groups.base`). To define your own action,
write a subclass of :class:`Action`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from codegen.errors import SceneError
from codegen.groups import actions
from codegen.groups.actions import *  # noqa: F403
from codegen.groups.registry import Registry
from orderconds.lazy import lazy

if TYPE_CHECKING:
    from codegen.groups.actions import Action
    from codegen.groups.affine import Affine
    from codegen.groups.base import LieGroup
    from codegen.groups.cotangent import Cotangent
    from codegen.groups.galilean import Galilean
    from codegen.groups.gl import GL
    from codegen.groups.matrix import MatrixGroup
    from codegen.groups.product import Product
    from codegen.groups.rn import Rn
    from codegen.groups.s3 import S3
    from codegen.groups.se2 import SE2
    from codegen.groups.se3 import SE3
    from codegen.groups.se23 import SE23
    from codegen.groups.semidirect import Semidirect
    from codegen.groups.sl import SL
    from codegen.groups.sl2 import SL2
    from codegen.groups.so import SO
    from codegen.groups.so2 import SO2
    from codegen.groups.so3 import SO3
    from codegen.groups.sp import Sp
    from codegen.groups.su2 import SU2
    from codegen.groups.unitary import SU, Unitary
    from codegen.groups.unitriangular import Heisenberg, Unitriangular

__all__ = [
    "GL",
    "S3",
    "SE2",
    "SE3",
    "SE23",
    "SL",
    "SL2",
    "SO",
    "SO2",
    "SO3",
    "SU",
    "SU2",
    "Affine",
    "Cotangent",
    "Galilean",
    "Heisenberg",
    "LieGroup",
    "MatrixGroup",
    "Product",
    "Rn",
    "Semidirect",
    "Sp",
    "Unitary",
    "Unitriangular",
    "get",
    "listing",
    "register",
    "unregister",
]

__all__ += actions.__all__

LISTED: dict[str, tuple[str, ...]] = {
    "affine": ("Affine",),
    "cotangent": ("Cotangent",),
    "galilean": ("Galilean",),
    "gl": ("GL",),
    "matrix": ("MatrixGroup",),
    "product": ("Product",),
    "rn": ("Rn",),
    "s3": ("S3",),
    "se2": ("SE2",),
    "se23": ("SE23",),
    "se3": ("SE3",),
    "semidirect": ("Semidirect",),
    "sl": ("SL",),
    "sl2": ("SL2",),
    "so": ("SO",),
    "so2": ("SO2",),
    "so3": ("SO3",),
    "sp": ("Sp",),
    "su2": ("SU2",),
    "unitary": ("SU", "Unitary"),
    "unitriangular": ("Heisenberg", "Unitriangular"),
}
"""The names of the group classes in each module of this package."""

lazy(__name__, base=("LieGroup",), **LISTED)

GROUPS: Registry[LieGroup] = Registry(
    "group", __name__, sorted((name for names in LISTED.values() for name in names), key=str.lower)
)

Registered = TypeVar("Registered", bound="type[LieGroup] | type[Action]")


def register(cls: Registered) -> Registered:
    """Register the class of a group or the class of an action, and return the class.

    A group class is added to the list of groups, and an action class is added to the list of actions. If you
    register two classes with the same name, the second class replaces the first class.

    :class:`SceneError` is raised in three cases:

    - The class is neither a group nor an action.
    - An abstract method is not implemented.
    - A class of this package has the same name.
    """
    from codegen.groups.actions import ACTIONS, Action
    from codegen.groups.base import LieGroup

    if isinstance(cls, type) and issubclass(cls, LieGroup):
        GROUPS.add(cls)
    elif isinstance(cls, type) and issubclass(cls, Action):
        ACTIONS.add(cls)
    else:
        raise SceneError(f"cannot register {cls!r}", expected="a subclass of LieGroup or Action")
    return cls


def unregister(cls: type[LieGroup] | type[Action]) -> None:
    """Undo :func:`register` for the class ``cls``."""
    from codegen.groups.actions import ACTIONS
    from codegen.groups.base import LieGroup

    if issubclass(cls, LieGroup):
        GROUPS.remove(cls)
    else:
        ACTIONS.remove(cls)


def listing() -> list[dict[str, str]]:
    """Return the name and the first docstring paragraph of every group, for ``orderconds list groups``."""
    return GROUPS.listing()


def get(name: str) -> type[LieGroup]:
    """Return the group class with this name. :class:`orderconds.errors.UnknownName` is raised if no group has
    this name.
    """
    return GROUPS.get(name)
