"""Conversion of formulas to SymPy expressions. A coefficient becomes an entry of an ``IndexedBase``. An index
sum becomes a ``Sum``.

Other modules import this module only when they need SymPy, because the import of SymPy is slow.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy

from orderconds.formula.nodes import Coefficient, Formula, IndexSum, Power, Product, Total
from orderconds.formula.notation import Relation

Limit = tuple[sympy.Symbol, sympy.Expr, sympy.Expr]
"""A summation index with its lower and its upper limit."""

STAGES = sympy.Symbol("s", integer=True, positive=True)
EXPONENTIALS = sympy.Symbol("m", integer=True, positive=True)


def export(formula: Formula) -> sympy.Expr:
    """Return the SymPy expression of a formula. Lower-case indices run from 1 to the number ``s`` of stages.
    Upper-case indices run from 1 to the number ``m`` of exponentials.

    >>> from orderconds.formula import coefficient, index_sum
    >>> export(index_sum(("i",), (), coefficient("b", "i")))
    Sum(b[i], (i, 1, s))
    """
    match formula:
        case Coefficient(name, indices):
            return sympy.IndexedBase(name)[tuple(_index(index) for index in indices)]
        case Product(factors):
            return sympy.Mul(*(export(factor) for factor in factors))
        case Power(base, exponent):
            return export(base) ** exponent
        case Total(terms):
            return sympy.Add(
                *(sympy.Rational(q.numerator, q.denominator) * export(term) for q, term in terms)
            )
        case IndexSum(indices, relations, body):
            return sympy.Sum(export(body), *_limits(indices, relations))
    raise TypeError(f"not a formula: {formula!r}")


def _index(name: str) -> sympy.Expr:
    return sympy.Symbol(name, integer=True, positive=True)


def _limits(indices: Sequence[str], relations: Sequence[Relation]) -> list[Limit]:
    limits, remaining = [], list(indices)
    while remaining:
        # The arguments of sympy.Sum are triples (index, lower bound, upper bound). The bounds in a triple
        # may depend only on the indices of later triples.
        index = next(
            x for x in remaining if not any(high == x and low in remaining for low, _, high in relations)
        )
        remaining.remove(index)
        bounds = [_index(high) - int(sign == "<") for low, sign, high in relations if low == index]
        last = EXPONENTIALS if index[0].isupper() else STAGES
        lowest = [
            _index(low) + int(sign == "<")
            for low, sign, high in relations
            if high == index and low not in indices
        ]
        start = sympy.Max(*lowest) if lowest else 1
        limits.append((_index(index), start, sympy.Min(*bounds) if bounds else last))
    return limits


def expand_sums(expression: sympy.Expr, stages: int, exponentials: int = 1) -> sympy.Expr:
    """Expand all sums in ``expression``, a result of :func:`export`.

    The upper limits ``s`` and ``m`` of the sums are replaced by ``stages`` and ``exponentials``. SymPy's
    method ``doit`` is not used, because it does not expand sums with ``i < j``.

    >>> from orderconds.formula import coefficient, index_sum, product
    >>> body = product(coefficient("b", "i"), coefficient("c", "j"))
    >>> strict = index_sum(("i", "j"), (("i", "<", "j"),), body)
    >>> expand_sums(export(strict), 3)
    b[1]*c[2] + b[1]*c[3] + b[2]*c[3]
    """

    def summed(body: sympy.Expr, *limits: sympy.Expr) -> sympy.Expr:
        if not limits:
            return body
        *inner, (index, first, last) = limits
        terms = []
        for value in range(int(first), int(last) + 1):
            rest = [(i, low.subs(index, value), high.subs(index, value)) for i, low, high in inner]
            terms.append(summed(body.subs(index, value), *rest))
        return sympy.Add(*terms)

    bounded = expression.subs({STAGES: stages, EXPONENTIALS: exponentials})
    return bounded.replace(sympy.Sum, summed)
