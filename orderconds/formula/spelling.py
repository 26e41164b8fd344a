"""How a formula is spelled: in ASCII for the terminal, in LaTeX for a paper; one walk, two alphabets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from msgspec import Struct

from orderconds.formula.nodes import Coefficient, Formula, IndexSum, Power, Product, Relation, Total

HATS = {"ahat": r"\hat{a}", "bhat": r"\hat{b}", "chat": r"\hat{c}", "alpha": r"\alpha", "beta": r"\beta"}
HATS |= {name: f"\\{name}" for name in ("gamma", "omega", "phi")}


class Alphabet(Struct, frozen=True):
    """The signs of one way of writing."""

    names: Mapping[str, str]
    total: str
    opening: str
    closing: str
    signs: Mapping[str, str]
    reversed_signs: Mapping[str, str]
    always_braces: bool
    latex_fractions: bool


TEXT = Alphabet({}, "sum", "(", ")", {"<": "<", "<=": "<="}, {"<": ">", "<=": ">="}, False, False)
LATEX = Alphabet(
    HATS, r"\sum", r"\Bigl(", r"\Bigr)", {"<": "<", "<=": r"\le "}, {"<": ">", "<=": r"\ge "}, True, True
)


def spell(formula: Formula, alphabet: Alphabet) -> str:
    r"""Write a formula in an alphabet.

    >>> print(spell(Power(Coefficient("ahat", ("i", "j")), 2), LATEX))
    \hat{a}_{ij}^{2}
    """
    match formula:
        case Coefficient(name, indices):
            return alphabet.names.get(name, name) + _subscript(_indices(indices), alphabet)
        case Product(factors):
            return " ".join(_grouped(factor, alphabet) for factor in factors) or "1"
        case Power(base, exponent):
            raised = f"{{{exponent}}}" if alphabet.always_braces else str(exponent)
            compound = isinstance(base, Product | Power) or (isinstance(base, Total) and len(base.terms) == 1)
            inner = f"{alphabet.opening}{spell(base, alphabet)}{alphabet.closing}"
            return f"{inner if compound else _grouped(base, alphabet)}^{raised}"
        case Total(terms):
            return _terms(terms, alphabet)
        case IndexSum(indices, relations, body):
            below = _subscript(_chains(indices, relations, alphabet), alphabet)
            summand = _bracketed(body, alphabet) if isinstance(body, Total) else spell(body, alphabet)
            return f"{alphabet.total}{below} {summand}"
    raise TypeError(f"not a formula: {formula!r}")


def fraction_latex(q: Fraction) -> str:
    r"""Spell a rational number in LaTeX.

    >>> print(fraction_latex(Fraction(-1, 6)))
    -\tfrac{1}{6}
    """
    if q.denominator == 1:
        return str(q.numerator)
    return rf"{'-' if q < 0 else ''}\tfrac{{{abs(q.numerator)}}}{{{q.denominator}}}"


def _bracketed(formula: Formula, alphabet: Alphabet) -> str:
    return f"{alphabet.opening}{spell(formula, alphabet)}{alphabet.closing}"


def _grouped(formula: Formula, alphabet: Alphabet) -> str:
    is_sum = isinstance(formula, IndexSum | Total)
    return _bracketed(formula, alphabet) if is_sum else spell(formula, alphabet)


def _indices(indices: Sequence[str]) -> str:
    return ("" if all(len(index) == 1 for index in indices) else ",").join(indices)


def _subscript(written: str, alphabet: Alphabet) -> str:
    plain = not alphabet.always_braces and written.isalnum()
    return f"_{written}" if plain else f"_{{{written}}}"


def _terms(terms: Sequence[tuple[Fraction, Formula]], alphabet: Alphabet) -> str:
    written = ""
    for scale, term in terms:
        sign = (" - " if scale < 0 else " + ") if written else ("-" if scale < 0 else "")
        magnitude = abs(scale)
        size = fraction_latex(magnitude) if alphabet.latex_fractions else str(magnitude)
        if isinstance(term, Product) and not term.factors:
            spelled = size
        else:
            body = _bracketed(term, alphabet) if isinstance(term, Total) else spell(term, alphabet)
            spelled = body if size == "1" else f"{size} {body}"
        written += sign + spelled
    return written or "0"


def _chains(indices: Sequence[str], relations: Sequence[Relation], alphabet: Alphabet) -> str:
    """Write indices below a summation sign, relations joined in chains where they can be: ``i<j<k,l``.

    A chain above an index that this sum does not bind is written downwards, ``k>j>i``, so that a summed index
    always stands first.
    """
    waiting = list(relations)
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
        while link := next((r for r in waiting if r[0] == last), None):
            waiting.remove(link)
            links.append(link)
            last = link[2]
            drawn.append(last)
        below = next((r for r in waiting if r[2] == start and r[0] not in indices), None)
        if below and last in indices:
            waiting.remove(below)
            downwards = [below, *links][::-1]
            chain = last + "".join(alphabet.reversed_signs[sign] + low for low, sign, _ in downwards)
        else:
            chain = start + "".join(alphabet.signs[sign] + high for _, sign, high in links)
        chains.append(chain)
    for low, sign, high in waiting:
        upwards = low in indices
        chains.append(
            low + alphabet.signs[sign] + high if upwards else high + alphabet.reversed_signs[sign] + low
        )
    return ",".join(chains)
