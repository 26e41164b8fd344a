"""The functions that draw figures, one for each kind of figure, and the list of the figures of all scenes."""

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

# Each function accepts only one kind of figure, so the type of the first argument is Any.
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
"""The function that draws each kind of figure, as ``module:function``."""

_registered: dict[type[Figure], Draw] = {}


def register(kind: type[Figure], draw: Draw) -> None:
    """Use ``draw`` for figures of a kind. The kind may be new or built in."""
    _registered[kind] = draw


def unregister(kind: type[Figure]) -> None:
    """Remove a kind that :func:`register` added."""
    _registered.pop(kind, None)


def draw(figure: Figure, source: Source) -> Drawn:
    """Return the picture of a figure.

    Raises SceneError if the kind of the figure is unknown, or if a run is not suitable for this kind.
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
    """Return the figure of a scene with the given name. Raise UnknownName if there is no such figure."""
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
    """Yield (name of a scene, figure) for each figure of the scenes that `orderconds list scenes` shows."""
    for name in scenes.every_name():
        for figure in scenes.load(name).figures:
            yield name, figure


def listing() -> list[dict[str, str]]:
    """Return scene, name and title of every figure, for ``orderconds list figures``."""
    return [
        {
            "name": f"{scene} {figure.name}",
            "about": figure.title + (f" ({figure.source})" if figure.source else ""),
        }
        for scene, figure in every_figure()
    ]
