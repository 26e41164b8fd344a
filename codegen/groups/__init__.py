"""Lie groups and their actions, each written once over any domain, by name.

Elements of a group, of its Lie algebra and of the dual are flat tuples of scalars; which coordinates they
are, and the identity every operation satisfies, stands in each group's docstring. Conventions: left action,
right trivialisation, [A, B] = AB - BA (see :mod:`orderconds`).
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from orderconds.errors import UnknownName
from orderconds.lazy import lazy

if TYPE_CHECKING:
    from codegen.groups.actions import LeftMultiplication, Linear, Motion, Rotation
    from codegen.groups.cotangent import Cotangent
    from codegen.groups.euclidean import Rn
    from codegen.groups.matrix import GL, MatrixGroup
    from codegen.groups.plane import SE2
    from codegen.groups.product import Product
    from codegen.groups.quaternions import S3
    from codegen.groups.sl2 import SL2
    from codegen.groups.so3 import SO3

__all__ = [
    "GL",
    "S3",
    "SE2",
    "SL2",
    "SO3",
    "Cotangent",
    "LeftMultiplication",
    "Linear",
    "MatrixGroup",
    "Motion",
    "Product",
    "Rn",
    "Rotation",
]

LISTED = ("Cotangent", "GL", "MatrixGroup", "Product", "Rn", "S3", "SE2", "SL2", "SO3")

lazy(
    __name__,
    actions=("Linear", "Rotation", "Motion", "LeftMultiplication"),
    cotangent=("Cotangent",),
    euclidean=("Rn",),
    matrix=("GL", "MatrixGroup"),
    plane=("SE2",),
    product=("Product",),
    quaternions=("S3",),
    sl2=("SL2",),
    so3=("SO3",),
)


def listing() -> list[dict[str, str]]:
    """Return name and first docstring line of every group, for ``orderconds list groups``."""
    return [{"name": n, "about": (get(n).__doc__ or "").splitlines()[0]} for n in LISTED]


def get(name: str) -> Any:
    """Return the group class of that name; :class:`orderconds.errors.UnknownName` for another."""
    if name not in LISTED:
        raise UnknownName(f"unknown group {name!r}", expected=f"one of {', '.join(LISTED)}")
    return getattr(sys.modules[__name__], name)
