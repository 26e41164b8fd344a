"""Checks of the arguments of field scenes and Hamiltonian scenes: group, action and time interval."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, NoReturn

from codegen.errors import SceneError
from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.groups.laws import check_laws
from codegen.groups.linear_algebra import Vector
from codegen.ir.decimals import exact
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.scene.formulas import Reader

if TYPE_CHECKING:
    import sympy


def check_group(name: str, group: object) -> None:
    """Raise :class:`SceneError` if ``group`` is not an object of a group class, or violates a law of groups.

    A typical mistake is to pass the name of a group, or a class such as ``SO3`` in place of ``SO3()``.
    """
    if not isinstance(group, LieGroup):
        _refuse(name, "group", group, "SO3()")
    check_laws(group, name)


def check_points(reader: Reader, group: LieGroup, action: object) -> None:
    """Raise :class:`SceneError` if ``action`` is not an action of ``group``, or if ``reader`` has the wrong
    number of coordinates for this action.
    """
    if not isinstance(action, Action):
        _refuse(reader.name, "action", action, "Rotation()")
    domain = ExprDomain(reader.space)
    y = tuple(domain.space.sym(s) for s in reader.coordinates)
    zero: Vector[Expr] = (domain.rational(0),) * group.dim
    action.check(group, reader.name)
    size = action.point_size(group)
    if size is not None and size != len(y):
        raise SceneError(
            f"a point with {len(y)} coordinates",
            where=reader.name,
            expected=f"a point with {size} coordinates, because {group.name} acts by {action.name}",
        )
    try:
        width = len(action.velocity(domain, group, zero, y))
    # The formula of the action may fail for a wrong number of coordinates.
    except (ValueError, IndexError):
        width = -1
    if width != len(y):
        raise SceneError(
            f"a point with {len(y)} coordinates",
            where=reader.name,
            expected=f"a point on which {group.name} acts by {action.name}",
        )


def _refuse(name: str, what: str, value: object, example: str) -> NoReturn:
    shown = value.__name__ if isinstance(value, type) else repr(value)
    raise SceneError(
        f"the {what} {shown}", where=name, expected=f"an object of codegen.groups, such as {example}"
    )


def read_span(name: str, span: tuple[sympy.Expr, sympy.Expr]) -> tuple[Fraction, Fraction]:
    """Return the two ends of the time interval ``span`` as fractions.

    :class:`SceneError` is raised if ``span`` does not consist of two rational times in increasing order.
    """
    try:
        times = [exact(x) for x in span]
    except TypeError:
        times = []
    if len(times) != 2 or times[0] is None or times[1] is None:
        raise SceneError(f"the span {span}", where=name, expected="two rational times")
    first, last = times[0], times[1]
    if not last > first:
        raise SceneError(
            f"the span ({first}, {last})", where=name, expected="a start time less than the end time"
        )
    return first, last
