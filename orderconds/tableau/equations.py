"""Equations in LaTeX that define a method.

If the tableau contains doubles, all coefficients are rounded to six digits. In every other tableau, a short
coefficient is printed exactly. A long coefficient, or a coefficient that contains a name (for example c1), is
printed as a truncated decimal.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from decimal import ROUND_DOWN, Context, Decimal
from typing import TYPE_CHECKING, cast

from orderconds.tableau.brackets import Bracket, Combination, Product, Term
from orderconds.tableau.coefficient_latex import to_latex
from orderconds.tableau.line_width import COLUMN, at_top, lines, separated, width, with_small_fractions
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    EmbeddedUpdate,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
    Stage,
)
from orderconds.tableau.products import AdjointComposition, Magnus, Splitting

if TYPE_CHECKING:
    from orderconds.ring.protocol import Element, RealRing
    from orderconds.tableau.record import Tableau

SHORT = 10
"""Decimals of inexact coefficients are truncated after this number of digits."""

WIDE = 75.0
"""The largest width, in points, of the LaTeX formula of a coefficient. A coefficient with a wider formula is
printed as a decimal."""

MOST = 34
"""Equations with more than MOST lines do not fit on a page."""

BLANK = r"\,"
"""A narrow space between a factor and a vector field."""

Equation = tuple[str, Sequence[str]]
"""The left-hand side of an equation, and the parts of the right-hand side. A line break is allowed after each
part."""


def equations(tableau: Tableau) -> str:
    r"""Return the equations that define the method, aligned at the equality signs.

    If the equations do not fit on a page, the result contains only the size of the method, as in
    ``8 stages``.

    >>> from orderconds.tableau import Tableau
    >>> print(equations(Tableau.cf([[], [["1/2"]]], [[0, 1]])))
    \begin{aligned} Y_{1} &= y_0 \\ Y_{2} &= \exp\bigl(\tfrac{1}{2} h k_{1}\bigr)\, y_0 \\ y_1 &= \exp\bigl(h k_{2}\bigr)\, y_0 \end{aligned}
    """  # noqa: E501
    both = list(_equations(tableau))
    free = COLUMN - width("=") - max(width(left) for left, _ in both)
    written = [line for left, parts in both for line in lines(left, parts, free)]
    if len(written) > MOST:
        written = [rf"&\text{{{_size(tableau)}}}"]
    return r"\begin{aligned} " + r" \\ ".join(written) + r" \end{aligned}"


def has_name(text: str) -> bool:
    """Return True if the text of a coefficient contains a name other than ``sqrt``. Such a name denotes a
    number that is defined elsewhere, for example as a root of a polynomial.

    >>> has_name("1/2 + sqrt(3)/6"), has_name("1 - 2*g")
    (False, True)
    """
    return bool(set(re.findall(r"[A-Za-z_]\w*", text)) - {"sqrt"})


def short_text(x: Element, tableau: Tableau) -> str:
    """Return the text of a coefficient. If the tableau contains doubles, the coefficient is rounded to six
    digits. In every other tableau, a long inexact coefficient is cut off after :data:`SHORT` significant
    digits.

    >>> from orderconds.tableau import Tableau
    >>> tableau = Tableau.rk([[0, 0], ["1/2", 0]], [0, 1])
    >>> short_text(tableau.method.A[1][0], tableau)
    '1/2'
    """
    if tableau.doubles:
        return f"{cast('RealRing', tableau.ring).nearest_float(x):.6g}"
    text = tableau.ring.text(x)
    return _decimal(x, tableau) if "~" in text and len(text) > SHORT else text


def _decimal(x: Element, tableau: Tableau) -> str:
    """Return a coefficient as a decimal, cut off after :data:`SHORT` significant digits. The result ends in a
    tilde, which becomes ``\\ldots`` in LaTeX."""
    nearest = Decimal(cast("RealRing", tableau.ring).nearest_float(x))
    return f"{Context(prec=SHORT, rounding=ROUND_DOWN).plus(nearest):f}~"


def _latex(x: Element, tableau: Tableau) -> str:
    """Return a coefficient in LaTeX."""
    text = short_text(x, tableau)
    if tableau.doubles:
        return text
    if not has_name(text):
        latex = with_small_fractions(to_latex(text))
        if width(latex) <= WIDE:
            return latex
    return to_latex(_decimal(x, tableau))


def _size(tableau: Tableau) -> str:
    method = tableau.method
    if isinstance(method, Composition | AdjointComposition | Splitting | Magnus):
        return f"{method.s} coefficients" if not isinstance(method, Magnus) else f"{method.s} nodes"
    return f"{method.s} stages"


def _equations(tableau: Tableau) -> Iterator[Equation]:
    method = tableau.method
    if isinstance(method, RungeKutta):
        yield from _matrix("a", "b", method.A, method.b, tableau)
    elif isinstance(method, PartitionedRungeKutta):
        yield from _matrix("a", "b", method.A, method.b, tableau)
        yield from _matrix(r"\hat a", r"\hat b", method.A_hat, method.b_hat, tableau)
    elif isinstance(method, CommutatorFree):
        for i, stage in enumerate(method.stages, start=1):
            yield f"Y_{{{i}}}", _stage(stage, tableau)
        yield "y_1", _stage(method.update, tableau)
    elif isinstance(method, Composition):
        yield r"\gamma", _list(method.gamma, tableau)
    elif isinstance(method, AdjointComposition):
        yield r"\alpha", _list(method.alpha, tableau)
        yield r"\beta", _list(method.beta, tableau)
    elif isinstance(method, Splitting):
        yield from _splitting(method, tableau)
    else:
        yield from _magnus(method, tableau)
    if isinstance(tableau.embedded, Embedded):
        yield r"\hat b", _list(tableau.embedded.b, tableau)
    elif isinstance(tableau.embedded, EmbeddedUpdate):
        yield r"\hat y_1", _stage(tableau.embedded.update, tableau)


def _matrix(a: str, b: str, A: Sequence[Row], weights: Row, tableau: Tableau) -> Iterator[Equation]:
    """Yield one equation for each nonzero row of the matrix A, then one equation for the weights. The symbols
    of A and of the weights are ``a`` and ``b``."""
    for i, row in enumerate(A, start=1):
        last = max((j for j, x in enumerate(row) if tableau.ring.is_zero(x) is not True), default=-1)
        if last >= 0:
            yield rf"{a}_{{{i}\cdot}}", _list(row[: last + 1], tableau)
    yield b, _list(weights, tableau)


def _list(row: Sequence[Element], tableau: Tableau) -> list[str]:
    return separated([_latex(x, tableau) for x in row])


def _splitting(method: Splitting, tableau: Tableau) -> Iterator[Equation]:
    """Yield the equation that defines one step as a product of flows. The rightmost flow acts first."""
    flows = []
    for part, x in reversed(method.steps):
        time = _latex(x, tableau).replace(r"\tfrac", r"\frac")
        time = "" if time == "1" else f"({time}) " if at_top(time, " ") else f"{time} "
        flows.append(rf"\varphi^{{{method.parts[part]}}}_{{{time}h}} ")
    yield r"\Phi_h", flows


def _magnus(method: Magnus, tableau: Tableau) -> Iterator[Equation]:
    """Yield the equations that define the nodes, then the named Lie elements, then the exponents Omega_1,
    Omega_2, ...."""
    yield "c", _list(method.c, tableau)
    for name, combination in method.elements:
        yield _name(name), _brackets(combination, tableau)
    for k, combination in enumerate(method.exponents, start=1):
        yield rf"\Omega_{{{k}}}", _brackets(combination, tableau)


def _brackets(combination: Combination, tableau: Tableau) -> list[str]:
    return _sum([(x, _term(term)) for term, x in combination], tableau)


def _term(term: Term) -> str:
    if isinstance(term, Bracket):
        return f"[{_term(term.left)}, {_term(term.right)}]"
    if isinstance(term, Product):
        return BLANK.join(map(_term, term.factors))
    return _name(term) if isinstance(term, str) else f"A_{{{term + 1}}}"


def _name(name: str) -> str:
    return re.sub(r"^([A-Za-z])(\d+)$", r"\1_{\2}", name)


def _stage(stage: Stage, tableau: Tableau) -> list[str]:
    """Return the parts of a formula. The formula is the product of exponentials that gives the value of a
    stage. The rightmost exponential acts first."""
    start = "y_0" if stage.start is None else f"Y_{{{stage.start + 1}}}"
    parts = [part for row in reversed(stage.exponentials) for part in _exponential(row, tableau)]
    return [*parts[:-1], parts[-1] + start] if parts else [start]


def _exponential(row: Row, tableau: Tableau) -> list[str]:
    """Return the parts of the formula of exp(h sum_j x_j k_j), where the x_j are the entries of ``row``."""
    terms = _sum([(x, f"k_{{{j}}}") for j, x in enumerate(row, start=1)], tableau)
    if len(terms) == 1:
        factor, _, index = terms[0].rpartition("k_")
        inner = f"{factor.removesuffix(BLANK)} h k_{index}".strip() if index else terms[0]
        return [rf"\exp\bigl({inner}\bigr)\, "]
    return [rf"\exp\bigl(h({terms[0]}", *terms[1:-1], rf"{terms[-1]})\bigr)\, "]


def _sum(combination: Sequence[tuple[Element, str]], tableau: Tableau) -> list[str]:
    """Return the terms of a linear combination, each with its sign."""
    written: list[str] = []
    for x, vector in combination:
        if tableau.ring.is_zero(x) is True:
            continue
        size = _latex(x, tableau)
        minus = size.startswith("-") and not at_top(size, " ")
        size = size.removeprefix("-") if minus else size
        factor = "" if size == "1" else f"({size}){BLANK}" if at_top(size, " ") else f"{size}{BLANK}"
        sign = (" - " if minus else " + ") if written else "-" if minus else ""
        written.append(f"{sign}{factor}{vector}")
    return written or ["0"]
