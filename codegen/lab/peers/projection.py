"""Projection of a state onto its manifold.

A rotation matrix g is replaced by g (3 I - g^T g)/2, where I is the identity matrix and g^T is the transpose.
The new matrix is the result of one Newton step towards the orthogonal polar factor of g. A point near a
sphere around the origin is scaled to the radius of the sphere. Momenta are not changed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from codegen.errors import SceneError
from codegen.groups import Rotation
from codegen.groups.capabilities import Projection, Rotations
from codegen.groups.linear_algebra import dot
from codegen.ir.domain import Domain, ExprDomain, FloatDomain
from codegen.ir.values import Kind
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.straight_line_field import StraightLine, straight_line
from codegen.scene.problem import Problem


def project(scene: Problem, domain: Domain, state: Sequence[Scalar]) -> Vector:
    """Return the projection of a state onto the manifold of the scene.

    Raises :class:`SceneError` if no projection onto the manifold is known.
    """
    result: list[Scalar] = []
    start = 0
    for block in scene.state:
        values = tuple(state[start : start + len(block.symbols)])
        start += len(values)
        projection = scene.group.offers(Projection) if block.kind is Kind.GROUP else None
        if projection is not None:
            result += projection.project(domain, values)
        elif (
            block.kind is Kind.POINT and isinstance(scene.action, Rotation) and scene.group.offers(Rotations)
        ):
            radius = math.hypot(*scene.initial(FloatDomain(0.0))[start - len(values) : start])
            length = domain.call("sqrt", dot(values, values))
            scale = domain.rational(*radius.as_integer_ratio()) / length
            result += [scale * x for x in values]
        elif block.kind is Kind.DUAL or scene.group.abelian:
            result += values
        else:
            raise SceneError(
                f"there is no projection onto the manifold of {scene.group.name}",
                where=scene.name,
                expected="SO(3) or a sphere",
            )
    return tuple(result)


def projection_lines(scene: Problem) -> StraightLine:
    """Return straight-line code (a list of assignments) that projects a state onto the manifold of a
    scene.
    """
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    return straight_line(scene.name, scene.symbols, project(scene, domain, state))


def projection(scene: Problem) -> Callable[[Sequence[float]], tuple[float, ...]]:
    """Return a function that projects the coordinates of a state onto the manifold of a scene."""
    field = projection_lines(scene).python(float, {"sqrt": math.sqrt})
    return lambda y: field(y, 0.0)
