"""A scene's ambient equation y' = f(y).y as one Python function of balls: straight-line code.

Arb's numbers are several times faster than mpmath's and a compiled function than an interpreted expression;
a reference evaluates the field a million times. Radii are not used as bounds here: whoever integrates takes
midpoints, and measures the uncertainty by a second run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from flint import arb

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.scene import Setting
from orderconds.ring.precision import precision, working_bits

Vector = Sequence[Any]
Field = Callable[[Vector, Any], tuple[Any, ...]]
"""From the coordinates of a state and the time, as balls, to the derivative of the coordinates."""

INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}


def ambient_field(scene: Setting) -> Field:
    """Return the function of a scene, its parameters at their defaults, for the working precision at hand."""
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    roots = scene.velocity(domain, state, domain.space.sym("t"))
    constants: list[Any] = []
    names: dict[int, str] = {}
    lines = []
    for node in walk(roots):
        if node.op == "sym":
            names[node.id] = "t" if node.payload == "t" else f"y[{scene.symbols.index(node.payload)}]"
        elif node.op == "const":
            names[node.id] = f"c{len(constants)}"
            constants.append(ball(node.payload))
        else:
            names[node.id] = f"v{node.id}"
            lines.append(f"    v{node.id} = {_spelled(node, [names[a.id] for a in node.args])}")
    results = "".join(f"{names[r.id]}, " for r in roots)
    source = "\n".join(["def field(y, t):", *lines, f"    return ({results})"])
    found: dict[str, Any] = {f"c{k}": x for k, x in enumerate(constants)}
    exec(compile(source, f"<{scene.name}>", "exec"), found)
    field: Field = found["field"]
    return field


def _spelled(node: Expr, args: list[str]) -> str:
    if node.op in INFIX:
        return f"{args[0]} {INFIX[node.op]} {args[1]}"
    if node.op == "neg":
        return f"-{args[0]}"
    if node.op == "pow":
        return f"{args[0]} ** {node.payload}"
    return f"{args[0]}.{node.payload}()"


def ball(number: Number) -> Any:
    """Return a ball of the working precision around an exact number.

    >>> from orderconds.ring.precision import precision
    >>> with precision(53):
    ...     print(ball(Number.rational(1, 4)))
    0.250000000000000
    """
    if number.is_rational:
        fraction = number.fraction()
        return arb(fraction.numerator) / fraction.denominator
    bits = working_bits()
    with precision(bits + 16):
        return arb(number.ring.approximate(number.element, bits // 3 + 5))
