"""The dependency graph of snippets: a node a helper or a function of the target's library, an edge a call."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import networkx as nx

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


def snippets() -> tuple[Snippet, ...]:
    """Return every snippet; the same names serve each target."""
    found = [Snippet("greater", "greater"), Snippet("quotient", "quotient")]
    for k, hyperbolic in enumerate(("cosh", "sinh")):
        needs = (f"stumpff_{k}", "sqrt", hyperbolic)
        found.append(Snippet(f"signed_stumpff{k}", "signed_stumpff", needs, {"k": k}))
    switch = [repr(float(z)) for z in stumpff.SWITCH]
    for k in range(4):
        first, *rest = stumpff.constants(k)
        values = {"k": k, "first": first, "even": rest[::2], "odd": rest[1::2]}
        values |= {"small": repr(float(stumpff.SMALL)), "short": stumpff.constants(k, stumpff.SMALL)}
        found.append(Snippet(f"stumpff_series_{k}", "stumpff_series", (), values))
    for orders in stumpff.SETS:
        name = "stumpff_" + "".join(map(str, orders))
        library = ["sqrt"]
        if orders != (0,):
            library.append("sin")
        if orders not in ((1,), (2,), (3,), (1, 3)):
            library.append("cos")
        calls = (*library, *(f"stumpff_series_{k}" for k in orders))
        found.append(Snippet(name, "stumpff", calls, {"name": name, "orders": orders, "switch": switch}))
    return tuple(found)


@cache
def graph() -> nx.DiGraph:
    """Return the graph: an edge from each helper to what it calls."""
    made = nx.DiGraph()
    made.add_nodes_from(LIBRARY, snippet=None)
    for snippet in snippets():
        made.add_node(snippet.name, snippet=snippet)
        made.add_edges_from((snippet.name, called) for called in snippet.calls)
    return made


@dataclass(frozen=True)
class Needed:
    """What a set of functions needs: library functions, sorted, and helper texts, callees first."""

    library: tuple[str, ...]
    texts: tuple[str, ...]


def needed(target: str, functions: Iterable[str]) -> Needed:
    """Return what the functions called by a module need in a target, and nothing else.

    >>> needed("c", ["sin"])
    Needed(library=('sin',), texts=())
    >>> needed("c", ["stumpff_1"]).library
    ('sin', 'sqrt')
    """
    wanted = sorted(set(functions))
    nodes = {m for name in wanted for m in (name, *nx.descendants(graph(), name))}
    order = reversed(list(nx.lexicographical_topological_sort(graph().subgraph(nodes))))
    found = [graph().nodes[name]["snippet"] for name in order]
    texts = tuple(_text(target, snippet) for snippet in found if snippet is not None)
    return Needed(tuple(name for name in LIBRARY if name in nodes), texts)


def _text(target: str, snippet: Snippet) -> str:
    template = environment(target).get_template(f"snippets/{snippet.template}.j2")
    return template.render(snippet.variables).strip()
