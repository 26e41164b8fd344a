"""The right-hand side of the differential equation of a scene as straight-line code (a list of assignments).

The differential equation is y' = f(y).y, where f(y) is in the Lie algebra and the dot is its action on the
state y.
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
    """Code without branches and loops: a list of assignments ``name = text``.

    - ``scene``: the name of the scene.
    - ``constants``: the values of the constants ``c0``, ``c1``, ... in the code.
    - ``lines``: the pairs (name, text) of the assignments. A text may contain the coordinates ``y[0]``,
      ``y[1]``, ... of the state, the time ``t``, the constants, and the names of earlier assignments.
    - ``results``: the names of the results (names of assignments, constants or coordinates).
    - ``functions``: the names of the functions that the texts call.
    """

    scene: str
    constants: tuple[Number, ...]
    lines: tuple[tuple[str, str], ...]
    results: tuple[str, ...]
    functions: tuple[str, ...]

    def python(self, constant: Callable[[Number], Scalar], functions: Functions) -> Evaluate:
        """Return the code as a Python function ``(y, t) -> tuple`` for one type of numbers.

        ``constant`` converts an exact number to this type. ``functions`` maps names of functions (for example
        ``sqrt``) to functions for numbers of this type (:mod:`codegen.lab.number_functions`).
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
    """Return straight-line code for the right-hand side of the differential equation of a scene.

    The parameters of the scene have their default values.
    """
    domain = ExprDomain()
    state = tuple(domain.space.sym(s) for s in scene.symbols)
    roots = scene.velocity(domain, state, domain.space.sym(TIME))
    return straight_line(scene.name, scene.symbols, roots)


def straight_line(name: str, symbols: Sequence[str], roots: tuple[Expr, ...]) -> StraightLine:
    """Return straight-line code that computes the expressions ``roots``.

    ``symbols`` are the names of the coordinates of the state in the expressions. ``name`` is the name of the
    scene.
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
            # A vector function is called only once, even if several of its results are used.
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
    """If ``text`` is a power (for example ``v1 ** 2``), return the power as a product.

    In contrast to the power, the product is valid in C and for balls (enclosing intervals) that contain zero.
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
