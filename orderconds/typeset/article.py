r"""Order conditions in LaTeX for a paper: numbered equations with labels, a column of trees, and a legend."""

from __future__ import annotations

import re
from collections.abc import Sequence

from orderconds.conditions import OrderCondition
from orderconds.explain import kinds
from orderconds.explain.diagram import Diagram
from orderconds.explain.tikz import STYLE, picture
from orderconds.formula.equations import Equation, numbered
from orderconds.formula.notation import latex_fraction
from orderconds.typeset.legend import legend


def article(family: str, by_order: Sequence[Sequence[OrderCondition]], *, explain: bool = False) -> str:
    r"""Return the conditions of a family in LaTeX. If ``explain`` is true, LaTeX comments contain the
    elementary differential of each condition.

    The label of condition k of order n is ``FAMILY:n:k``.

    >>> from orderconds.derivation import derive
    >>> print(article("rk", derive("rk", order=2).by_order).splitlines()[0])
    % Order conditions of the family rk up to order 2. Packages: amsmath, tikz.
    """
    kind = kinds.of_family(family)
    equations, signs = [], set[str]()
    for order, conditions in enumerate(by_order, start=1):
        for number, condition in enumerate(conditions, start=1):
            diagram = kind.diagram(condition.key) if kind is not None else ()
            signs |= set(_signs(diagram))
            label = f"{re.sub(r'[^a-z0-9]+', '-', condition.family).strip('-')}:{order}:{number}"
            equations.append(
                Equation(
                    condition.latex,
                    latex_fraction(condition.rhs),
                    picture(diagram) if diagram else "",
                    label,
                    _comment(condition, explain=explain),
                )
            )
    packages = ["amsmath", *(["tikz"] if kind is not None else [])]
    library = " (library shapes.geometric)" if "transport" in signs else ""
    head = f"% Order conditions of the family {family} up to order {len(by_order)}. "
    head += f"Packages: {', '.join(packages)}{library}."
    flat = [condition for conditions in by_order for condition in conditions]
    if not flat:
        return head
    style = [] if kind is None else [STYLE]
    return "\n".join([head, *style, numbered(equations), legend(family, flat) + _trees(kind, signs)])


def _comment(condition: OrderCondition, *, explain: bool) -> str:
    lines = [f"order {condition.order}, {condition.tree}"]
    if explain:
        lines.append(f"names {kinds.named_by(condition)}")
    if condition.relation is not None:
        lines.append(f"equals {condition.relation}")
    return "\n".join(lines)


def _signs(diagram: Diagram) -> list[str]:
    """Return the names of the shapes in the diagram: one name for each vertex, for example ``white``, and one
    name for each edge, for example ``outward``."""
    signs = list[str]()
    for vertex in diagram:
        signs.append(vertex.sign)
        for branch in vertex.branches:
            signs += [branch.edge, *_signs((branch.vertex,))]
    return signs


MEANINGS = {
    "white": "a black vertex denotes a derivative of the first function of the system (f or T), and a white "
    "vertex denotes a derivative of the second function (g or V)",
    "outward": "the function at a vertex is differentiated once with respect to the position for each arrow "
    "that starts at the vertex, and once with respect to the momentum for each arrow that ends at the vertex",
    "transport": "a diamond denotes a coadjoint action on the momentum",
    "bracket": "a point with two branches denotes the commutator of the branches",
}
"""The meanings of vertices and edges in the drawings of trees."""


def _trees(kind: kinds.Kind | None, signs: set[str]) -> str:
    """Return a sentence that explains the column of trees. ``signs`` contains the results of :func:`_signs`
    for all trees in this column."""
    if kind is None:
        return ""
    words = signs & {"letter", "bracket"}
    what = "word" if words else "tree"
    text = f" The first column shows the {what} of each condition"
    text += "" if words else ", with the root at the bottom"
    return text + "".join(f"; {meaning}" for sign, meaning in MEANINGS.items() if sign in signs) + "."
