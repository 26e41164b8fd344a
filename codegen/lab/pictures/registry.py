"""Maps each kind of figure to its drawing function, and lists the figures of all scenes.

A kind of figure is a subclass of ``Figure`` (for example ``PlaneCurves``) in :mod:`codegen.scene.figure`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from difflib import get_close_matches
from pkgutil import resolve_name
from typing import Any, TypeAlias

from codegen import scenes
from codegen.command_names import bare, quoted
from codegen.errors import SceneError
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.scene import figure as kinds
from codegen.scene.figure import Figure
from codegen.scene.problem import Problem
from orderconds.errors import UnknownName

# Each function draws figures of one subclass of Figure. The first argument is such a figure.
Draw: TypeAlias = Callable[[Any, Source], Drawn]

BUILT_IN: dict[type[Figure], str] = {
    kinds.PlaneCurves: "codegen.lab.pictures.plane:draw",
    kinds.SphereCurves: "codegen.lab.pictures.sphere:draw",
    kinds.SpaceCurves: "codegen.lab.pictures.space:draw",
    kinds.Motion: "codegen.lab.pictures.motion:draw",
    kinds.TorusCurves: "codegen.lab.pictures.torus:draw",
    kinds.TimeSeries: "codegen.lab.pictures.time_series:draw",
    kinds.LatticeMeans: "codegen.lab.pictures.lattice_means:draw",
    kinds.Deviation: "codegen.lab.pictures.deviation:draw",
    kinds.Scan: "codegen.lab.pictures.scan:draw",
    kinds.Orders: "codegen.lab.pictures.orders:draw",
}
"""Maps each kind of figure to the name ``module:function`` of its drawing function."""

_registered: dict[type[Figure], Draw] = {}


def register(kind: type[Figure], draw: Draw) -> None:
    """Use the function ``draw`` for all figures of the class ``kind``.

    If ``kind`` is a class of :data:`BUILT_IN`, ``draw`` replaces the built-in function.
    """
    _registered[kind] = draw


def unregister(kind: type[Figure]) -> None:
    """Undo :func:`register` for the class ``kind``."""
    _registered.pop(kind, None)


def draw(figure: Figure, source: Source) -> Drawn:
    """Return the picture of a figure.

    Raises SceneError if this class of figures has no drawing function, or if the figure cannot be drawn.
    """
    for kind in type(figure).__mro__:
        if kind in _registered:
            return _registered[kind](figure, source)
        if kind in BUILT_IN:
            function: Draw = resolve_name(BUILT_IN[kind])
            return function(figure, source)
    known = ", ".join(k.__name__ for k in (*BUILT_IN, *_registered))
    raise SceneError(
        f"unknown figure kind {type(figure).__name__}", where=source.problem.name, expected=f"one of {known}"
    )


def find(problem: Problem, name: str) -> Figure:
    """Return the figure ``name`` of a scene. Raise UnknownName if the scene has no such figure."""
    for figure in problem.figures:
        if figure.name == name:
            return figure
    known = [figure.name for figure in problem.figures]
    raise UnknownName(
        f"{problem.name} has no figure {name!r}",
        expected=f"one of {', '.join(known)}" if known else "a scene whose file defines `figures`",
        hint=f"did you mean {close[0]}?" if (close := get_close_matches(name, known, n=1)) else "",
    )


def command(scene: str, figure: Figure) -> str:
    """Return the command line that draws a figure."""
    return f"orderconds figure {quoted(bare(scene))} {figure.name} -o {figure.name}.svg"


def every_figure() -> Iterator[tuple[str, Figure]]:
    """Yield a pair (name of the scene, figure) for each figure of all built-in and registered scenes."""
    for name in scenes.every_name():
        for figure in scenes.load(name).figures:
            yield name, figure


def listing() -> list[dict[str, str]]:
    """Return the list that ``orderconds list figures`` prints: one entry for each figure of each scene.

    In each entry, ``name`` contains the name of the scene and the name of the figure. ``about`` contains the
    title and, for reproduced figures, the publication.
    """
    return [
        {
            "name": f"{scene} {figure.name}",
            "about": figure.title + (f" ({figure.source})" if figure.source else ""),
        }
        for scene, figure in every_figure()
    ]
