"""The signs, brackets and subscripts of formulas, in ASCII (for a terminal) and in LaTeX (for a paper)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from msgspec import Struct

Relation = tuple[str, str, str]
"""A relation ``("i", "<", "j")`` or ``("i", "<=", "j")`` between two indices of a sum. One of i and j
may be a free index."""

HATS = {"ahat": r"\hat{a}", "bhat": r"\hat{b}", "chat": r"\hat{c}", "alpha": r"\alpha", "beta": r"\beta"}
HATS |= {name: f"\\{name}" for name in ("gamma", "omega", "phi")}


class Notation(Struct, frozen=True):
    """The symbols and brackets of one notation, ASCII or LaTeX.

    ``names`` maps names of coefficients to symbols, for example ``ahat`` to ``\\hat{a}``. ``total`` is the
    summation sign. ``signs`` maps ``<`` and ``<=`` to their symbols.

    ``reversed_signs`` maps ``<`` and ``<=`` to the symbols for ``>`` and ``>=``. These symbols are used if
    ``i < j`` is printed as ``j > i``.
    """

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


def latex_fraction(q: Fraction) -> str:
    r"""Return a rational number in LaTeX.

    >>> print(latex_fraction(Fraction(-1, 6)))
    -\tfrac{1}{6}
    """
    if q.denominator == 1:
        return str(q.numerator)
    return rf"{'-' if q < 0 else ''}\tfrac{{{abs(q.numerator)}}}{{{q.denominator}}}"


def joined(indices: Sequence[str]) -> str:
    """Return the text of several indices, with commas if an index has more than one letter.

    >>> joined(["i", "j"]), joined(["i", "j1"])
    ('ij', 'i,j1')
    """
    return ("" if all(len(index) == 1 for index in indices) else ",").join(indices)


def subscript(written: str, notation: Notation) -> str:
    """Return the text ``written`` as a subscript. In ASCII, braces are omitted if the text contains only
    letters and digits.

    >>> subscript("ij", TEXT), subscript("i,j1", TEXT), subscript("ij", LATEX)
    ('_ij', '_{i,j1}', '_{ij}')
    """
    plain = not notation.always_braces and written.isalnum()
    return f"_{written}" if plain else f"_{{{written}}}"


def chains(indices: Sequence[str], relations: Sequence[Relation], notation: Notation) -> str:
    """Return the text below a summation sign with the summation indices ``indices``.

    The relations ``i<j`` and ``j<k`` are written as the chain ``i<j<k``. If i is not a summation index, the
    chain is reversed to ``k>j>i``, so that the chain starts with a summation index.

    >>> chains(["i", "j"], [("i", "<", "j")], TEXT)
    'i<j'
    """
    remaining = list(relations)
    drawn: list[str] = []
    result = []
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
        result.append(chain)
    for low, sign, high in remaining:
        upwards = low in indices
        result.append(
            low + notation.signs[sign] + high if upwards else high + notation.reversed_signs[sign] + low
        )
    return ",".join(result)
