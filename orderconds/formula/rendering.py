"""Formulas as text: in ASCII for the terminal, in LaTeX for a paper, by one walk with two notations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from msgspec import Struct

from orderconds.formula.nodes import Coefficient, Formula, IndexSum, Power, Product, Relation, Total

HATS = {"ahat": r"\hat{a}", "bhat": r"\hat{b}", "chat": r"\hat{c}", "alpha": r"\alpha", "beta": r"\beta"}
HATS |= {name: f"\\{name}" for name in ("gamma", "omega", "phi")}


class Notation(Struct, frozen=True):
    """The signs and brackets of one notation."""

    names: Mapping[str, str]
    total: str
    opening: str
    closing: str
    signs: Mapping[str, str]
    reversed_signs: Mapping[str, str]
    always_braces: bool
    latex_fractions: bool


TEXT = Notation({}, "sum", "(", ")", {"<": "<", "<=": "<="}, {"<": ">", "<=": ">="}, False, False)
LATEX = Notation(
    HATS, r"\sum", r"\Bigl(", r"\Bigr)", {"<": "<", "<=": r"\le "}, {"<": ">", "<=": r"\ge "}, True, True
)


def render(formula: Formula, notation: Notation) -> str:
    r"""Return a formula in a notation.

    >>> print(render(Power(Coefficient("ahat", ("i", "j")), 2), LATEX))
    \hat{a}_{ij}^{2}
    """
    match formula:
        case Coefficient(name, indices):
            return notation.names.get(name, name) + _subscript(_indices(indices), notation)
        case Product(factors):
            return " ".join(_grouped(factor, notation) for factor in factors) or "1"
        case Power(base, exponent):
            raised = f"{{{exponent}}}" if notation.always_braces else str(exponent)
            compound = isinstance(base, Product | Power) or (isinstance(base, Total) and len(base.terms) == 1)
            inner = f"{notation.opening}{render(base, notation)}{notation.closing}"
            return f"{inner if compound else _grouped(base, notation)}^{raised}"
        case Total(terms):
            return _terms(terms, notation)
        case IndexSum(indices, relations, body):
            below = _subscript(_chains(indices, relations, notation), notation)
            summand = _bracketed(body, notation) if isinstance(body, Total) else render(body, notation)
            return f"{notation.total}{below} {summand}"
    raise TypeError(f"not a formula: {formula!r}")


def latex_fraction(q: Fraction) -> str:
    r"""Return a rational number in LaTeX.

    >>> print(latex_fraction(Fraction(-1, 6)))
    -\tfrac{1}{6}
    """
    if q.denominator == 1:
        return str(q.numerator)
    return rf"{'-' if q < 0 else ''}\tfrac{{{abs(q.numerator)}}}{{{q.denominator}}}"


def _bracketed(formula: Formula, notation: Notation) -> str:
    return f"{notation.opening}{render(formula, notation)}{notation.closing}"


def _grouped(formula: Formula, notation: Notation) -> str:
    is_sum = isinstance(formula, IndexSum | Total)
    return _bracketed(formula, notation) if is_sum else render(formula, notation)


def _indices(indices: Sequence[str]) -> str:
    return ("" if all(len(index) == 1 for index in indices) else ",").join(indices)


def _subscript(written: str, notation: Notation) -> str:
    plain = not notation.always_braces and written.isalnum()
    return f"_{written}" if plain else f"_{{{written}}}"


def _terms(terms: Sequence[tuple[Fraction, Formula]], notation: Notation) -> str:
    written = ""
    for scale, term in terms:
        sign = (" - " if scale < 0 else " + ") if written else ("-" if scale < 0 else "")
        magnitude = abs(scale)
        size = latex_fraction(magnitude) if notation.latex_fractions else str(magnitude)
        if isinstance(term, Product) and not term.factors:
            factor = size
        else:
            body = _bracketed(term, notation) if isinstance(term, Total) else render(term, notation)
            factor = body if size == "1" else f"{size} {body}"
        written += sign + factor
    return written or "0"


def _chains(indices: Sequence[str], relations: Sequence[Relation], notation: Notation) -> str:
    """Write indices below a summation sign, relations joined in chains where they can be: ``i<j<k,l``.

    A chain above an index that this sum does not bind is written downwards, ``k>j>i``, so that a summed index
    always comes first.
    """
    remaining = list(relations)
    drawn: list[str] = []
    chains = []
    for start in sorted(
        indices, key=lambda x: any(x == upper and low in indices for low, _, upper in relations)
    ):
        if start in drawn:
            continue
        links: list[Relation] = []
        last = start
        drawn.append(start)
        while link := next((r for r in remaining if r[0] == last), None):
            remaining.remove(link)
            links.append(link)
            last = link[2]
            drawn.append(last)
        below = next((r for r in remaining if r[2] == start and r[0] not in indices), None)
        if below and last in indices:
            remaining.remove(below)
            downwards = [below, *links][::-1]
            chain = last + "".join(notation.reversed_signs[sign] + low for low, sign, _ in downwards)
        else:
            chain = start + "".join(notation.signs[sign] + high for _, sign, high in links)
        chains.append(chain)
    for low, sign, high in remaining:
        upwards = low in indices
        chains.append(
            low + notation.signs[sign] + high if upwards else high + notation.reversed_signs[sign] + low
        )
    return ",".join(chains)
