"""The call graph of the snippets, the run-time helpers of emitted code.

A node is a helper, or a function in the mathematical library of the target language. The folder
``snippets/TARGET`` contains the templates of the helpers.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import networkx as nx

from codegen.ir.elementary import ANGLE, MATHEMATICAL
from codegen.ir.ieee import OVERFLOWING, UNDEFINED
from codegen.ir.precision import DOUBLE, Precision
from codegen.ir.table import PiecewisePolynomial
from codegen.snippets import lane_angles, stumpff
from codegen.templates import environment

LIBRARY = (ANGLE, "copysign", "fabs", "isfinite", *sorted(MATHEMATICAL))
"""Functions that are in the mathematical libraries of both C and Python."""


@dataclass(frozen=True)
class Snippet:
    """A helper function of emitted code: its template, the values for the template, and the functions that
    the helper calls.
    """

    name: str
    template: str
    calls: tuple[str, ...] = ()
    variables: dict[str, Any] = field(default_factory=dict, compare=False)


def snippets(precision: Precision = DOUBLE, batch: bool = False) -> tuple[Snippet, ...]:
    """Return all helpers of emitted code.

    If ``batch`` is True, sine, cosine and the Stumpff functions also have variants without branches. If
    ``batch`` is False, Stumpff functions in double precision use short polynomials for small arguments
    (stumpff.SMALL).
    """
    listed = [Snippet("greater", "greater"), Snippet("quotient", "quotient")]
    listed.append(Snippet("choose", "choose"))
    listed.append(Snippet("largest", "largest", ("fabs",)))
    listed.append(Snippet("power", "power"))
    # In single precision, Python modules call functions of NumPy, which raise no exceptions.
    if precision is DOUBLE:
        listed += [_without_exceptions(name) for name in (*OVERFLOWING, *UNDEFINED)]
        listed.append(Snippet("divided", "divided", ("copysign",)))
    listed.append(Snippet("all_finite", "all_finite", ("isfinite",)))
    listed.append(Snippet("invert", "invert", ("fabs", "isfinite")))
    for k in (2, 3):
        variables = {"k": k, "terms": stumpff.slopes(k, precision)}
        listed.append(Snippet(f"slope{k}", "slope", (f"stumpff_{k - 1}{k}",), variables))
        variables = {"k": k, "terms": stumpff.curvatures(k, precision)}
        listed.append(Snippet(f"curvature{k}", "curvature", (f"stumpff_{k - 2}{k - 1}{k}",), variables))
    switch = [float(z) for z in stumpff.SWITCH]
    for k, hyperbolic in enumerate(("cosh", "sinh", "sinh", "sinh")):
        needs = (f"stumpff_{k}", "sqrt", hyperbolic, *(("stumpff_series_3",) if k == 3 else ()))
        listed.append(Snippet(f"signed_stumpff{k}", "signed_stumpff", needs, {"k": k, "last": -switch[k]}))
    for k in (1, 2, 3):
        variables = {"k": k, "terms": stumpff.slopes(k, precision)}
        needs = (f"signed_stumpff{k - 1}", f"signed_stumpff{k}")
        listed.append(Snippet(f"signed_slope{k}", "signed_slope", needs, variables))
    for k in range(4):
        first, *rest = stumpff.constants(k, None, precision)
        values: dict[str, Any] = {"k": k, "first": first, "even": rest[::2], "odd": rest[1::2]}
        listed.append(Snippet(f"stumpff_series_{k}", "stumpff_series", (), values))
        if precision is DOUBLE:
            for size, last in (("small", stumpff.SMALL), ("tiny", stumpff.TINY)):
                short = [precision.round(c) for c in stumpff.economised(k, last)]
                values = {"k": k, "size": size, "last": str(last), "short": short}
                listed.append(Snippet(f"stumpff_{size}_{k}", "stumpff_small", (), values))
    for orders in stumpff.SETS:
        listed += _shared_angle(orders, switch, precision, batch)
    return (*listed, *(trigonometric(precision) if batch else ()))


def _without_exceptions(name: str) -> Snippet:
    """Return the helper ``ieee_NAME``, where NAME is ``name``.

    The helper is a function in emitted Python code. Like ``math.NAME``, the helper computes the function
    ``name``. Where ``math.NAME`` raises an exception, the helper returns an infinity or a NaN, as C does.
    """
    overflows = name in OVERFLOWING and name != "log"
    return Snippet(f"ieee_{name}", "ieee", (name,), {"name": name, "overflows": overflows})


def _shared_angle(
    orders: tuple[int, ...], switch: Sequence[float], precision: Precision, batch: bool
) -> list[Snippet]:
    """Return the helpers that compute the Stumpff functions c_k(z) for one z and all k in ``orders``."""
    listed: list[Snippet] = []
    name = "stumpff_" + "".join(map(str, orders))
    library = ["sqrt"]
    if orders != (0,):
        library.append("sin")
    if orders not in ((1,), (2,), (3,), (1, 3)):
        library.append("cos")
    series = (*library, *(f"stumpff_series_{k}" for k in orders))
    values = {"name": name, "orders": orders, "switch": switch}
    if batch:
        polynomials = tuple(f"stumpff_series_{k}" for k in orders)
        listed.append(Snippet(f"{name}_near", "stumpff_lane", polynomials, values))
    if precision is not DOUBLE or batch:
        listed.append(Snippet(name, "stumpff", series, values | {"small": ""}))
        return listed
    # Large arguments are rare, so a separate function evaluates the Stumpff functions for them.
    far, small = f"{name}_far", float(stumpff.SMALL)
    listed.append(Snippet(far, "stumpff", series, values | {"name": far, "small": small}))
    # Three or more "tiny" polynomials would make the C function too long for inlining.
    sizes = ("tiny", "small") if len(orders) < 3 else ("small",)
    calls = (*(f"stumpff_{size}_{k}" for size in sizes for k in orders), far)
    tiny = float(stumpff.TINY) if "tiny" in sizes else ""
    listed.append(Snippet(name, "stumpff_near", calls, values | {"tiny": tiny, "small": small, "far": far}))
    return listed


def trigonometric(precision: Precision) -> list[Snippet]:
    """Return the helpers for sine and cosine in loops over many systems.

    The helpers ``sin_near`` and ``cos_near`` have no branches and are valid for angles up to
    :data:`~codegen.snippets.lane_angles.LARGEST`. The helpers ``sin_complete`` and ``cos_complete`` are valid
    for all angles.
    """
    shared = {
        **lane_angles.reduction(precision),
        "sine": lane_angles.polynomial(1, precision),
        "cosine": lane_angles.polynomial(0, precision),
    }
    listed = []
    for name in ("sin", "cos"):
        listed.append(Snippet(f"{name}_near", "angle_near", ("fabs",), {"name": name, **shared}))
        listed.append(
            Snippet(
                f"{name}_complete", "angle_complete", (f"{name}_near", name, "fabs"), {"name": name, **shared}
            )
        )
    return listed


def snippet_of_table(table: PiecewisePolynomial, precision: Precision = DOUBLE) -> Snippet:
    """Return the helper that evaluates a piecewise polynomial: a binary search, then Horner's rule."""
    knots = tuple(map(precision.round, table.knots))
    pairs = zip(table.bases, table.rows, strict=True)
    rows = [tuple(map(precision.round, (base, *row))) for base, row in pairs]
    values = {"name": str(table), "knots": knots, "rows": rows}
    return Snippet(str(table), "table", (), values)


@cache
def graph(precision: Precision = DOUBLE, batch: bool = False) -> nx.DiGraph:
    """Return the call graph of all helpers: an edge leads from a helper to each function that it calls."""
    result = nx.DiGraph()
    result.add_nodes_from(LIBRARY, snippet=None)
    for snippet in snippets(precision, batch):
        result.add_node(snippet.name, snippet=snippet)
        result.add_edges_from((snippet.name, called) for called in snippet.calls)
    return result


@dataclass(frozen=True)
class Needed:
    """The names of library functions and the source texts of helpers that an emitted module needs.

    In ``texts``, each helper comes after the helpers that it calls.
    """

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
    prefix: str = "",
    batch: bool = False,
) -> Needed:
    """Return the helpers and library functions that an emitted module needs.

    - ``functions``: the functions that the module calls.
    - ``sweeps``: True if the module solves equations by iteration.
    - ``wide``: the common number of rows of all inverted matrices, or 0 if their sizes differ or are large.
    - ``widest``: the number of rows of the largest inverted matrix.
    - ``chain``: the number of rotations in the longest chain of a step. In a chain, each angle except the
      first is computed from the result of the preceding rotation (:func:`codegen.snippets.stumpff.limit`).
    - ``prefix``: in C, the beginning of the names of all helpers.
    - ``batch``: True if the module can integrate many systems at once.

    >>> needed("c", ["sin"])
    Needed(library=('sin',), texts=())
    >>> needed("c", ["stumpff_1"]).library
    ('sin', 'sqrt')
    """
    wanted = sorted(set(functions))
    whole = graph(precision, batch)
    tables = [snippet_of_table(f, precision) for f in wanted if isinstance(f, PiecewisePolynomial)]
    if tables:
        whole = whole.copy()
        for table in tables:
            whole.add_node(table.name, snippet=table)
    nodes = {m for name in wanted for m in (name, *nx.descendants(whole, name))}
    order = reversed(list(nx.lexicographical_topological_sort(whole.subgraph(nodes))))
    ordered = [whole.nodes[name]["snippet"] for name in order]
    given = {
        "sweeps": sweeps,
        "wide": wide,
        "widest": widest or wide,
        "limit": stumpff.limit(precision, chain),
        "prefix": prefix,
    }
    texts = tuple(_text(target, snippet, precision, given) for snippet in ordered if snippet is not None)
    return Needed(tuple(name for name in LIBRARY if name in nodes), texts)


def _text(target: str, snippet: Snippet, precision: Precision, given: dict[str, Any]) -> str:
    templates = environment(target)
    literal = templates.get_template("snippets/number.j2")

    def number(x: float) -> str:
        text = precision.text(precision.round(x))
        return literal.render(text=text, f=precision.suffix, single=precision is not DOUBLE).strip()

    # In single precision the names of the functions in C's library end in "f", as in sinf.
    values: dict[str, Any] = {"real": precision.c_type, "f": precision.suffix, "number": number}
    # NAN has the type float in C, so the cast avoids the warning of -Wdouble-promotion.
    values["nan"] = "(double)NAN" if precision is DOUBLE else "NAN"
    for name, value in (given | snippet.variables).items():
        if isinstance(value, float):
            values[name] = number(value)
        elif isinstance(value, list | tuple) and value and isinstance(value[0], float):
            values[name] = [number(x) for x in value]
        elif isinstance(value, list | tuple) and value and isinstance(value[0], tuple):
            values[name] = [[number(x) for x in row] for row in value]
        else:
            values[name] = value
    return templates.get_template(f"snippets/{snippet.template}.j2").render(values).strip()
