"""Recognise the exact coefficients of a tableau that is given by doubles or rounded decimals.

Each coefficient is compared with fractions of small denominator. If no fraction agrees, the coefficient is
compared with numbers x + y sqrt(d), where x and y are rational. All coefficients have the same d.

The exact coefficients are accepted if the exact method is proved to have at least the order of the given
tableau.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from orderconds import families
from orderconds.checking.limits import Limits, Meter
from orderconds.checking.order import family_order
from orderconds.errors import InputError
from orderconds.ring.integer_relations import quadratic_field, relation, root_of, simplest
from orderconds.tableau.file_format import Data
from orderconds.tableau.grammar import ZERO, Chain, Constant, Expression, parse
from orderconds.tableau.record import Tableau, from_data

CHANCE = Fraction(1, 2**9)
"""A fraction with the denominator q can replace a number with the uncertainty u only if q^2 u <= CHANCE.

If q^2 u is larger, the fraction may agree with the number by coincidence.
"""

TEXTS = ("name", "family", "source", "bibtex", "claims", "base", "parts", "order")
"""Keys of a tableau file. The values of these keys contain no coefficients."""

MAX_NUMBERS = 400
MAX_SECONDS = 2.0


@dataclass(frozen=True)
class ExactForms:
    """A copy of a tableau. In the copy, exact numbers replace the rounded numbers of the original tableau.

    - ``tableau`` is the copy with exact coefficients.
    - ``data`` contains the keys and values of a tableau file with exact coefficients.
    - ``texts`` maps the name of each rounded number in the original tableau to the exact number, as text.
    """

    tableau: Tableau
    data: Data
    texts: dict[str, str]


def exact_forms(tableau: Tableau) -> ExactForms | None:
    """Return a tableau with exact numbers instead of the rounded numbers, or None if none is found.

    The exact tableau is proved to have at least the order of the given tableau. A tableau with more than
    :data:`MAX_NUMBERS` rounded numbers is not examined.

    >>> rows = {"A": [[], ["0.6666666666666666d"]], "b": ["0.25", "0.75"]}
    >>> exact_forms(from_data({"name": "m", "family": "rk", **rows})).data["A"]
    [[], ['2/3']]
    """
    if tableau.file is None:
        return None
    rounded = tableau.file.symbolic.decimals()
    if not rounded or len(rounded) > MAX_NUMBERS:
        return None
    texts = _recognised([unknown.constant for unknown in rounded])
    if texts is None:
        return None
    replaced = {key: x if key in TEXTS else _replaced(x, texts) for key, x in tableau.file.data.items()}
    replaced.pop("proof", None)
    try:
        exact = from_data(replaced, tableau.path or tableau.name, tableau.path)
        family = families.get(tableau.family).for_method(tableau.method)
        supported = family_order(tableau, family)
        proved = family_order(exact, family, supported.order, meter=Meter(Limits(seconds=MAX_SECONDS)))
    except InputError:
        return None
    if (
        exact.doubles
        or not supported.order
        or proved.order < supported.order
        or proved.certificate != "exact"
    ):
        return None
    return ExactForms(exact, replaced, {u.name: texts[u.constant] for u in rounded})


def _recognised(constants: Sequence[Constant]) -> dict[Constant, str] | None:
    """Map each number to its exact value in a single field Q or Q(sqrt(d)), or return None."""
    fractions = {constant: _fraction(constant) for constant in constants}
    texts = {constant: str(x) for constant, x in fractions.items() if x is not None}
    others = [constant for constant, x in fractions.items() if x is None]
    if not others:
        return texts
    fields = (quadratic_field(x.value, _bits(x)) for x in others)
    d = next((d for d in fields if d is not None), None)
    if d is None:
        return None
    for constant in others:
        text = _surd(constant, d)
        if text is None:
            return None
        texts[constant] = text
    return texts


def _fraction(x: Constant) -> Fraction | None:
    """Among the fractions that agree with ``x``, return one with the smallest denominator.

    Return None if the agreement may be a coincidence.
    """
    q = simplest(x.value - x.unit, x.value + x.unit)
    return q if q.denominator**2 * x.unit <= CHANCE else None


def _bits(x: Constant) -> int:
    """Return the number of correct binary digits of ``x`` after the binary point."""
    return max(0, (x.unit.denominator // x.unit.numerator).bit_length() - 1)


def _surd(x: Constant, d: int) -> str | None:
    """Return a number p + q sqrt(d) that agrees with ``x``, as text. Here p and q are rational."""
    bits = _bits(x)
    root = root_of(d, 2 * bits)
    coefficients = relation([x.value, Fraction(1), root], bits)
    if coefficients is None or not coefficients[0]:
        return None
    p, q = (Fraction(-c, coefficients[0]) for c in coefficients[1:])
    if abs(p + q * root - x.value) > x.unit:
        return None
    size = abs(q)
    surd = f"{size.numerator}*" if size.numerator > 1 else ""
    surd += f"sqrt({d})" + (f"/{size.denominator}" if size.denominator > 1 else "")
    if not q:
        return str(p)
    if not p:
        return f"-{surd}" if q < 0 else surd
    return f"{p} {'-' if q < 0 else '+'} {surd}"


def _replaced(x: object, texts: dict[Constant, str]) -> object:
    """Return ``x`` with each rounded number replaced by the text of its exact value."""
    if isinstance(x, list):
        return [_replaced(y, texts) for y in x]
    if isinstance(x, dict):
        return {key: _replaced(y, texts) for key, y in x.items()}
    if not isinstance(x, str):
        return x
    try:
        expression = parse(x)
    except InputError:
        return x
    negative = isinstance(expression, Chain) and expression.operators == ("-",)
    inner: Expression = expression
    if isinstance(expression, Chain) and negative and expression.operands[0] == ZERO:
        inner = expression.operands[1]
    if not isinstance(inner, Constant) or inner not in texts:
        return x
    text = texts[inner]
    if inner is expression:
        return text
    return text[1:] if text.startswith("-") and " " not in text else _negative(text)


def _negative(text: str) -> str:
    """Return the text of the number -x, where ``text`` is the text of x.

    >>> _negative("1/4 - sqrt(3)/6"), _negative("sqrt(3)/6"), _negative("-1/4 + sqrt(3)/6")
    ('-1/4 + sqrt(3)/6', '-sqrt(3)/6', '1/4 - sqrt(3)/6')
    """
    first, *rest = text.split(" ")
    first = first[1:] if first.startswith("-") else f"-{first}"
    if not rest:
        return first
    return f"{first} {'+' if rest[0] == '-' else '-'} {rest[1]}"
