"""The equation y' = f(y).y of a scene as straight-line code, for reference solutions and peers.

Every distinct expression of the right-hand side becomes one assignment, so that common subexpressions are
computed once. The code can be the body of a C function, or a Python function for several types of numbers,
such as floats and balls.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.vector_calls import component
from codegen.lab.number_functions import Functions, chosen
from codegen.lab.number_types import Evaluate, Scalar
from codegen.printers.expression import number
from codegen.scene.problem import TIME, Problem

INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}


@dataclass(frozen=True)
class StraightLine:
    """Code without branches and loops. ``lines`` contains the assignments ``name = text`` as pairs.

    The texts contain the state y[0], y[1], ..., the time t, the constants c0, c1, ..., earlier names, and
    calls of ``functions``. ``results`` are the names of the results, in order.
    """

    scene: str
    constants: tuple[Number, ...]
    lines: tuple[tuple[str, str], ...]
    results: tuple[str, ...]
    functions: tuple[str, ...]

    def python(self, constant: Callable[[Number], Scalar], functions: Functions) -> Evaluate:
        """Return the code as a Python function (y, t) -> tuple for one type of numbers.

        ``constant`` converts an exact number to this type. ``functions`` maps names such as ``sqrt`` to
        functions of this type (:mod:`codegen.lab.number_functions`).
        """
        body = [f"    {name} = {_multiplied(text)}" for name, text in self.lines]
        source = "\n".join(
            ["def field(y, t):", *body, f"    return ({''.join(f'{r}, ' for r in self.results)})"]
        )
        names: dict[str, Scalar] = {f"c{k}": constant(x) for k, x in enumerate(self.constants)}
        names |= {str(name): chosen(functions, name, constant) for name in self.functions}
        exec(compile(source, f"<{self.scene}>", "exec"), names)
        field: Evaluate = names["field"]
        return field

    def c(self, target: str = "dy") -> list[str]:
        """Return C statements that compute the results and store them in the array ``target``."""
        lines = [f"const double c{k} = {number(x)};" for k, x in enumerate(self.constants)]
        lines += [f"const double {name} = {_multiplied(text)};" for name, text in self.lines]
        return lines + [f"{target}[{i}] = {result};" for i, result in enumerate(self.results)]


def velocity(scene: Problem) -> StraightLine:
    """Return the right-hand side f(y).y of the equation of a scene, with default parameters."""
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    roots = scene.velocity(domain, state, domain.space.sym(TIME))
    return straight_line(scene.name, scene.symbols, roots)


def straight_line(name: str, symbols: Sequence[str], roots: tuple[Expr, ...]) -> StraightLine:
    """Return expressions in the symbols of a state and the time as straight-line code.

    ``name`` is the name of the scene. ``symbols`` are the symbols of the state, named y[0], y[1], ... in the
    code.
    """
    constants: list[Number] = []
    names: dict[int, str] = {}
    lines: list[tuple[str, str]] = []
    functions: set[str] = set()
    places = {s: f"y[{i}]" for i, s in enumerate(symbols)}
    calls: dict[str, str] = {}
    for node in walk(roots):
        vector = component(node.payload) if node.op == "call" else None
        if vector is not None:
            # One call returns all results of a vector function.
            text = f"{vector[0].name}({', '.join(names[a.id] for a in node.args)})"
            if text not in calls:
                calls[text] = f"w{node.id}"
                lines.append((calls[text], text))
                functions.add(vector[0].name)
            names[node.id] = f"{calls[text]}[{vector[1]}]"
        elif node.op == "sym":
            names[node.id] = places.get(node.payload, str(node.payload))
        elif node.op == "const":
            names[node.id] = f"c{len(constants)}"
            constants.append(node.payload)
        else:
            names[node.id] = f"v{node.id}"
            lines.append((f"v{node.id}", _text(node, [names[a.id] for a in node.args])))
            if node.op == "call":
                functions.add(node.payload)
    results = tuple(names[r.id] for r in roots)
    return StraightLine(name, tuple(constants), tuple(lines), results, tuple(sorted(functions)))


def _multiplied(text: str) -> str:
    """Return the text of a power as a product, and all other texts unchanged.

    C has no power operator, and the power of a ball that contains zero is NaN in python-flint.
    """
    base, power, exponent = text.partition(" ** ")
    return " * ".join([base] * int(exponent)) if power else text


def _text(node: Expr, args: list[str]) -> str:
    if node.op in INFIX:
        return f"{args[0]} {INFIX[node.op]} {args[1]}"
    if node.op == "neg":
        return f"-{args[0]}"
    if node.op == "pow":
        return f"{args[0]} ** {node.payload}"
    return f"{node.payload}({', '.join(args)})"
