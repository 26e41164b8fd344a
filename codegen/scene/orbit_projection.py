"""Two tests of the orbit of the initial state: Is the orbit open? Do projected points lie on the orbit?

The projection is :meth:`Action.to_orbit`. An open orbit needs no projection, because all points near a point
of the orbit are on the orbit.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from codegen.ir.domain import FloatDomain
from codegen.scene.problem import Problem

DISPLACEMENT = 1e-4
""":func:`reaches_orbit` moves the initial state by this distance, and then projects the moved point.

The unit of all distances is the norm of the coordinates of the initial state that these displacements change.
Therefore the result does not depend on the unit of these coordinates.
"""

REDUCED = 1e-2
"""A factor in the test of :func:`reaches_orbit`.

Let T be the tangent space of the orbit at the initial state. The test moves the initial state by the distance
DISPLACEMENT, perpendicular to T. The test projects the moved point. The projected point passes the test if
the distance between this projected point and T is at most REDUCED * DISPLACEMENT.

The orbit may be curved. At the projected point, a curved orbit can deviate from T by about DISPLACEMENT^2.
The tolerance REDUCED * DISPLACEMENT is larger than this deviation.
"""

INDEPENDENT, ROUNDING = 1e-8, 1e-13
"""The tolerances of the test whether a vector v is linearly independent of given vectors.

The vector v is independent if its component perpendicular to the given vectors is longer than
INDEPENDENT * |v|, and longer than ROUNDING times the largest vector.
"""


def reaches_orbit(problem: Problem) -> bool:
    """Return True if :meth:`Action.to_orbit` maps points near the initial state onto the orbit."""
    field, d = problem.as_field(), FloatDomain(0.0)
    start = tuple(map(float, field.initial(d)))
    tangent = _tangent(field, start)
    axes = [tuple(float(i == j) for j in range(len(start))) for i in range(len(start))]
    normals = _orthonormal(axes, tangent)
    # A coordinate that no displacement changes, such as a momentum, may have another unit.
    changed = [y for i, y in enumerate(start) if any(abs(n[i]) > INDEPENDENT for n in normals)]
    distance = DISPLACEMENT * (math.hypot(*changed) or 1.0)
    for normal in normals:
        moved = tuple(y + distance * x for y, x in zip(start, normal, strict=True))
        end = field.action.to_orbit(d, field.group, moved, start)
        rest = _remainder([float(a - b) for a, b in zip(end, start, strict=True)], tangent)
        if math.hypot(*rest) > REDUCED * distance:
            return False
    return True


def orbit_is_open(problem: Problem) -> bool:
    """Return True if the orbit of the initial state is an open set of the space of coordinates."""
    field = problem.as_field()
    start = tuple(map(float, field.initial(FloatDomain(0.0))))
    return field.group.dim >= len(start) and len(_tangent(field, start)) == len(start)


def _tangent(field: Problem, start: tuple[float, ...]) -> list[list[float]]:
    """Return an orthonormal basis of the tangent space of the orbit at ``start``."""
    n, d = field.group.dim, FloatDomain(0.0)
    units = [tuple(float(i == j) for j in range(n)) for i in range(n)]
    return _orthonormal([field.action.velocity(d, field.group, x, start) for x in units])


def _orthonormal(
    vectors: Sequence[Sequence[float]], known: Sequence[Sequence[float]] = ()
) -> list[list[float]]:
    """Return vectors that extend ``known`` to an orthonormal basis of the span of ``known`` and ``vectors``.

    The vectors ``known`` must be orthonormal.
    """
    basis: list[list[float]] = []
    largest = max((math.hypot(*vector) for vector in vectors), default=0.0)
    for vector in vectors:
        # Project twice: the second projection removes the rounding errors of the first projection.
        rest = _remainder(_remainder(vector, [*known, *basis]), [*known, *basis])
        length = math.hypot(*rest)
        if length > max(INDEPENDENT * math.hypot(*vector), ROUNDING * largest):
            basis.append([x / length for x in rest])
    return basis


def _remainder(vector: Sequence[float], basis: Sequence[Sequence[float]]) -> list[float]:
    """Return the part of a vector that is perpendicular to an orthonormal basis."""
    rest = list(vector)
    for unit in basis:
        part = math.fsum(a * b for a, b in zip(rest, unit, strict=True))
        rest = [a - part * b for a, b in zip(rest, unit, strict=True)]
    return rest
