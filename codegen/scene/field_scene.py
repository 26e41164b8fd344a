"""Field scenes: y' = f(y).y for a group acting on a manifold."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.groups.coordinate_maps import EXPONENTIAL, CoordinateMap, coordinate_map
from codegen.ir.values import Kind
from codegen.scene.arguments import check_group, check_points, read_span
from codegen.scene.consistency import Stated, check_action, check_problem
from codegen.scene.formulas import Reader
from codegen.scene.orbit import orbit_of
from codegen.scene.problem import Problem, StateField

if TYPE_CHECKING:
    import sympy


def FieldScene(
    *,
    group: LieGroup,
    action: Action,
    y: Sequence[sympy.Symbol],
    f: Sequence[sympy.Expr],
    y0: Sequence[sympy.Expr],
    span: tuple[sympy.Expr, sympy.Expr],
    velocity: Sequence[sympy.Expr] | None = None,
    invariants: Mapping[str, sympy.Expr] | None = None,
    coordinates: str | CoordinateMap = EXPONENTIAL,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene y' = f(y).y for a group acting on a manifold.

    The dot denotes the infinitesimal action of the Lie algebra on the manifold.

    - ``y``: the sympy symbols of the coordinates, as a column.
    - ``f``: a column of ``group.dim`` formulas in the coordinates, in the symbol ``t`` and in parameters.
    - ``y0``: the exact initial point.
    - ``span``: the start time and the end time, as rational numbers. The end time is larger.
    - ``velocity``: formulas for y', to check ``f`` and ``action``.
    - ``invariants``: a map from names to scalar formulas.
    - ``coordinates``: the coordinate map of Runge-Kutta-Munthe-Kaas methods: "exp", "cayley", "second_kind",
      or a :class:`codegen.groups.coordinate_maps.CoordinateMap`.

    :class:`SceneError` is raised in these cases:

    - A formula has a wrong shape or contains an unknown symbol.
    - The initial point is not on the manifold.
    - The coordinate map is not defined for the group.
    - A formula of a group that is not built in violates a law of Lie groups.
    - A formula of the action violates a law of left actions (:func:`check_action`).
    - ``velocity`` differs from f(y).y.
    - An invariant is not constant along solutions.
    """
    check_group(name, group)
    reader = Reader(name, list(y))
    check_points(reader, group, action)
    open_roots = reader.column(f, group.dim, "f")
    roots = reader.closed(open_roots)
    start = reader.column(y0, len(y), "y0", constant=True)
    state = (StateField("y", Kind.POINT, tuple(reader.coordinates), start),)
    known = {key: reader.scalar(value, f"invariant {key}") for key, value in (invariants or {}).items()}
    stated: Stated = {}
    if velocity is not None:
        stated = {"velocity": (reader.closed(reader.column(velocity, len(y), "velocity")), None)}
    problem = Problem(
        *(name, title or name, group, action, state, roots, None, known, read_span(name, span)),
        reader.parameters(),
        signals=reader.signals,
        open_roots=open_roots,
        coordinates=coordinate_map(coordinates, group, name),
    )
    check_action(orbit_of(problem))
    check_problem(problem, stated)
    return problem
