"""Static coordinates: coordinates of the state that are constant in time.

Let y0 be the initial state, and assume that the field f reads only the time and static coordinates. The
solution then satisfies a linear equation y' = A(t).y. Here A(t) = f(y0, t) is an element of the Lie algebra,
and the dot denotes the action on y.
"""

from __future__ import annotations

from codegen.ir.expr import Expr, walk
from codegen.scene.ambient import ambient
from codegen.scene.problem import Problem
from codegen.scene.site_scene import with_frozen_neighbours


def reads_only_static(scene: Problem) -> bool:
    """Return True if the field of a scene reads only static coordinates.

    On a lattice, the coordinates of neighbours must be static, too. At an open boundary, the formulas
    ``scene.sites.outside`` must also contain only static coordinates.
    """
    # The test is expensive, and rarely succeeds if no component of f is zero.
    if not any(map(_vanishes, scene.roots)):
        return False
    one = scene if scene.sites is None else with_frozen_neighbours(scene)
    rates = zip(scene.symbols, ambient(one).roots, strict=True)
    moving = {s for s, rate in rates if not _vanishes(rate)}
    if scene.sites is None:
        return not _read(scene.roots) & moving
    sites, read = scene.sites, _read(scene.roots)
    for number, column in enumerate(sites.symbols):
        for k, s in enumerate(column):
            if s not in read:
                continue
            outside = [sites.outside[number][k]] if sites.outside else []
            if scene.symbols[k] in moving or _read(outside) & moving:
                return False
    return not read & moving


def _vanishes(x: Expr) -> bool:
    return x.op == "const" and bool(x.payload.is_zero)


def _read(roots: list[Expr] | tuple[Expr, ...]) -> set[str]:
    return {str(n.payload) for n in walk(roots) if n.op == "sym"}
