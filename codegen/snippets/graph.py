"""The dependency graph of snippets: a node a helper or a function of the target's library, an edge a call."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import networkx as nx

from codegen.run.precision import DOUBLE, Precision
from codegen.snippets import stumpff
from codegen.templates import environment

LIBRARY = ("cos", "cosh", "exp", "fabs", "isfinite", "log", "sin", "sinh", "sqrt")
"""Functions that both targets have in their mathematical library."""


@dataclass(frozen=True)
class Snippet:
    """A helper: the template that spells it, what it calls, and the template's variables."""

    name: str
    template: str
    calls: tuple[str, ...] = ()
    variables: dict[str, Any] = field(default_factory=dict, compare=False)


def snippets(precision: Precision = DOUBLE) -> tuple[Snippet, ...]:
    """Return every snippet; the same names serve each target.

    The shorter polynomials near zero are for doubles: in single precision the longer one is as short.
    """
    found = [Snippet("greater", "greater"), Snippet("quotient", "quotient")]
    found.append(Snippet("largest", "largest", ("fabs",)))
    found.append(Snippet("power", "power"))
    found.append(Snippet("all_finite", "all_finite", ("isfinite",)))
    found.append(Snippet("invert", "invert", ("fabs",)))
    for k in (2, 3):
        variables = {"k": k, "terms": stumpff.slopes(k, precision)}
        found.append(Snippet(f"slope{k}", "slope", (f"stumpff_{k - 1}{k}",), variables))
    for k, hyperbolic in enumerate(("cosh", "sinh")):
        needs = (f"stumpff_{k}", "sqrt", hyperbolic)
        found.append(Snippet(f"signed_stumpff{k}", "signed_stumpff", needs, {"k": k}))
    switch = [float(z) for z in stumpff.SWITCH]
    for k in range(4):
        first, *rest = stumpff.constants(k, None, precision)
        values: dict[str, Any] = {"k": k, "first": first, "even": rest[::2], "odd": rest[1::2]}
        found.append(Snippet(f"stumpff_series_{k}", "stumpff_series", (), values))
        if precision is DOUBLE:
            for size, last in (("small", stumpff.SMALL), ("tiny", stumpff.TINY)):
                short = [precision.round(c) for c in stumpff.economised(k, last)]
                values = {"k": k, "size": size, "last": str(last), "short": short}
                found.append(Snippet(f"stumpff_{size}_{k}", "stumpff_small", (), values))
    for orders in stumpff.SETS:
        name = "stumpff_" + "".join(map(str, orders))
        library = ["sqrt"]
        if orders != (0,):
            library.append("sin")
        if orders not in ((1,), (2,), (3,), (1, 3)):
            library.append("cos")
        series = (*library, *(f"stumpff_series_{k}" for k in orders))
        values = {"name": name, "orders": orders, "switch": switch}
        if precision is not DOUBLE:
            found.append(Snippet(name, "stumpff", series, values | {"small": ""}))
            continue
        # What is small enough to be inlined everywhere stands alone; the rest is called seldom.
        far, small = f"{name}_far", float(stumpff.SMALL)
        found.append(Snippet(far, "stumpff", series, values | {"name": far, "small": small}))
        # Three functions in two forms would be too long for a C compiler to inline.
        sizes = ("tiny", "small") if len(orders) < 3 else ("small",)
        calls = (*(f"stumpff_{size}_{k}" for size in sizes for k in orders), far)
        tiny = float(stumpff.TINY) if "tiny" in sizes else ""
        found.append(
            Snippet(name, "stumpff_near", calls, values | {"tiny": tiny, "small": small, "far": far})
        )
    return tuple(found)


@cache
def graph(precision: Precision = DOUBLE) -> nx.DiGraph:
    """Return the graph: an edge from each helper to what it calls."""
    made = nx.DiGraph()
    made.add_nodes_from(LIBRARY, snippet=None)
    for snippet in snippets(precision):
        made.add_node(snippet.name, snippet=snippet)
        made.add_edges_from((snippet.name, called) for called in snippet.calls)
    return made


@dataclass(frozen=True)
class Needed:
    """What a set of functions needs: library functions, sorted, and helper texts, callees first."""

    library: tuple[str, ...]
    texts: tuple[str, ...]


def needed(
    target: str,
    functions: Iterable[str],
    precision: Precision = DOUBLE,
    *,
    sweeps: bool = False,
    wide: int = 0,
    widest: int = 0,
    chain: int = 1,
) -> Needed:
    """Return what the functions called by a module need in a target, and nothing else.

    ``sweeps`` says that they are called in sweeps over equations, where many values are at hand that a call
    would put aside: C then may inline all branches of Stumpff functions. ``wide`` is how many rows
    all matrices have that are inverted, 0 where they differ or are many: C spells a row number by number.
    ``widest`` is how many rows the largest one has: C reserves room for that.
    ``chain`` is how many angles depend one on the other, as for :func:`codegen.snippets.stumpff.limit`.

    >>> needed("c", ["sin"])
    Needed(library=('sin',), texts=())
    >>> needed("c", ["stumpff_1"]).library
    ('sin', 'sqrt')
    """
    wanted = sorted(set(functions))
    whole = graph(precision)
    nodes = {m for name in wanted for m in (name, *nx.descendants(whole, name))}
    order = reversed(list(nx.lexicographical_topological_sort(whole.subgraph(nodes))))
    found = [whole.nodes[name]["snippet"] for name in order]
    given = {
        "sweeps": sweeps,
        "wide": wide,
        "widest": widest or wide,
        "limit": stumpff.limit(precision, chain),
    }
    texts = tuple(_text(target, snippet, precision, given) for snippet in found if snippet is not None)
    return Needed(tuple(name for name in LIBRARY if name in nodes), texts)


def _text(target: str, snippet: Snippet, precision: Precision, given: dict[str, Any]) -> str:
    template = environment(target).get_template(f"snippets/{snippet.template}.j2")

    def number(x: float) -> str:
        text = precision.text(precision.round(x))
        if target == "c":
            return text + precision.suffix
        return text if precision is DOUBLE else f"float32({text})"

    # "f" follows the names of C's library functions.
    spelled: dict[str, Any] = {"real": precision.c_type, "f": precision.suffix, "number": number}
    for name, value in (given | snippet.variables).items():
        if isinstance(value, float):
            spelled[name] = number(value)
        elif isinstance(value, list | tuple) and value and isinstance(value[0], float):
            spelled[name] = [number(x) for x in value]
        else:
            spelled[name] = value
    return template.render(spelled).strip()
