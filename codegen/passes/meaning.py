"""Whether two programs mean the same: interpretation at a point of the scene, in double precision."""

from __future__ import annotations

import math
from typing import Any

from codegen.ir.domain import FloatDomain, NotConverged
from codegen.ir.interpret import flatten, interpret
from codegen.ir.program import Kind, Program
from codegen.scene import Setting

STEP = 2.0**-9
AGREE = 2.0**-36


def differs(old: Program, new: Program, scene: Setting) -> str:
    """Return an account of the difference of two programs over one step from the initial state, or ''.

    Both are interpreted with a small step, where every implicit block settles; results must agree to 2^-36
    relative to the size of the state, far below any order error a wrong rewriting would leave.
    """
    domain = FloatDomain(STEP)
    values: dict[str, Any] = {}
    k = 0
    coordinates = scene.initial(domain)
    for block in scene.state:
        values[block.name] = coordinates[k : k + len(block.symbols)]
        k += len(block.symbols)
    values["t"] = float(scene.span[0])
    inputs = {v.name: values[v.name] for v in old.inputs}
    try:
        a = interpret(old, scene, domain, inputs)
        b = interpret(new, scene, domain, inputs)
    except (NotConverged, ArithmeticError) as error:
        return f"interpretation failed: {error}"
    kinds = {v.name: v.kind for v in old.inputs}
    for name in a:
        x, y = (flatten(kinds.get(name, Kind.POINT), side[name]) for side in (a, b))
        scale = max(1.0, *(abs(s) for s in x))
        gap = max(abs(s - t) for s, t in zip(x, y, strict=True))
        if not gap <= AGREE * scale or not math.isfinite(scale):
            return f"{name} moved by {gap:.3g}"
    return ""
