"""Coordinate maps for Runge-Kutta-Munthe-Kaas methods, one file for each map.

By default every scene (problem) uses the exponential map: ``coordinates="exp"``. The inverse differential of
the exponential map is an infinite series of brackets. The inverse differentials of the maps in this package
have exact formulas.
"""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.base import LieGroup
from codegen.groups.coordinate_maps.base import CoordinateMap
from codegen.groups.coordinate_maps.cayley import Cayley
from codegen.groups.coordinate_maps.second_kind import SecondKind

__all__ = ["Cayley", "CoordinateMap", "SecondKind", "coordinate_map"]

EXPONENTIAL = "exp"
"""The name of the exponential map."""

MAPS: dict[str, CoordinateMap] = {each.name: each for each in (Cayley(), SecondKind())}
"""The coordinate maps by name, without the exponential map."""


def coordinate_map(given: str | CoordinateMap, group: LieGroup, where: str) -> CoordinateMap | None:
    """Return the coordinate map of a scene, or None for the exponential map.

    ``given`` is the name of the map or a :class:`CoordinateMap`. :class:`SceneError` is raised if the name is
    unknown or if the group does not have the map.
    """
    if given == EXPONENTIAL:
        return None
    known = MAPS.get(given) if isinstance(given, str) else None
    chosen = given if isinstance(given, CoordinateMap) else known
    if chosen is None:
        names = ", ".join(repr(name) for name in (EXPONENTIAL, *MAPS))
        raise SceneError(
            f"coordinates={given!r}", where=where, expected=f"one of {names}, or a CoordinateMap of your own"
        )
    chosen.check(group, where)
    return chosen
