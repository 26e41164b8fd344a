"""Syntax trees of formulas with sums over indices, and functions that build and simplify them.

Bound indices have unique names from :func:`fresh`, until :func:`named` replaces these names. Upper-case
indices run over exponentials, and lower-case indices run over stages.
"""

from __future__ import annotations

import itertools
from collections.abc import Container, Hashable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction

from msgspec import Struct

from orderconds.formula.notation import (
    LATEX,
    TEXT,
    Notation,
    Relation,
    chains,
    joined,
    latex_fraction,
    subscript,
)

STAGE_NAMES = ("i", "j", "k", "l", "m", "n", "p", "q", "r", "u", "v", "w")
EXPONENTIAL_NAMES = ("I", "J", "K", "L", "M", "N", "P", "Q", "R", "U", "V", "W")

_numbers = itertools.count(1)


class Formula(Struct, frozen=True):
    """A node of the syntax tree: Coefficient, Product, Power, Total or IndexSum."""

    def text(self) -> str:
        """Return the formula in ASCII, for example ``sum_{i,j} b_i a_ij c_j``."""
        return _rendered(self, TEXT)

    def latex(self) -> str:
        """Return the formula for LaTeX's mathematics mode."""
        return _rendered(self, LATEX)


class Coefficient(Formula, frozen=True):
    """A coefficient of the method. The coefficient ``a_ij`` has the name ``a`` and the indices ``("i",
    "j")``."""

    name: str
    indices: tuple[str, ...]


class Product(Formula, frozen=True):
    """A product of factors. The empty product is the number one."""

    factors: tuple[Formula, ...]


class Power(Formula, frozen=True):
    """A power ``base^exponent``. The exponent may be negative."""

    base: Formula
    exponent: int


class Total(Formula, frozen=True):
    """A sum of rational multiples of formulas. The empty sum is zero."""

    terms: tuple[tuple[Fraction, Formula], ...]


class IndexSum(Formula, frozen=True):
    """The sum of the formula ``body`` over ``indices``. Only index values that satisfy ``relations``
    contribute."""

    indices: tuple[str, ...]
    relations: tuple[Relation, ...]
    body: Formula


def zero() -> Formula:
    """Return the empty sum.

    >>> zero().text()
    '0'
    """
    return Total(())


def one() -> Formula:
    """Return the empty product.

    >>> one().text()
    '1'
    """
    return Product(())


def coefficient(name: str, *indices: str) -> Formula:
    """Return the coefficient ``name`` with the given indices.

    >>> coefficient("a", "i", "j").text()
    'a_ij'
    """
    return Coefficient(name, indices)


def product(*factors: Formula) -> Formula:
    """Return the product of formulas. Nested products are flattened, numbers are moved to the front, and
    equal factors are combined into powers.

    The comparison of factors ignores the names of bound indices.

    >>> c = coefficient("c", "i")
    >>> product(coefficient("b", "i"), c, c).text()
    'b_i c_i^2'
    """
    scale: Fraction | int = 1
    parts: list[tuple[Formula, int]] = []
    for base, exponent in _powers(factors):
        if isinstance(base, Total) and len(base.terms) <= 1 and exponent > 0:
            if not base.terms:
                return zero()
            number, base = base.terms[0]
            scale *= number**exponent
        if isinstance(base, Coefficient | IndexSum):
            parts.append((base, exponent))
        else:
            parts += [(inner, exponent * power) for inner, power in _powers((base,))]
    # Factors with equal keys are collected into one power. A coefficient is its own key. If exactly
    # one factor is not a coefficient, this factor has the key None, because no other factor can be equal to
    # it. If several factors are not coefficients, the slow function ``_shape`` computes their keys.
    alone = len([None for inner, _ in parts if not isinstance(inner, Coefficient)]) <= 1
    collected: dict[Hashable, tuple[Formula, int]] = {}
    for inner, exponent in parts:
        key = inner if isinstance(inner, Coefficient) else None if alone else _shape(inner, {})
        first, seen = collected.get(key, (inner, 0))
        collected[key] = (first, seen + exponent)
    powers = tuple(b if e == 1 else Power(b, e) for b, e in collected.values() if e)
    plain = powers[0] if len(powers) == 1 else Product(powers)
    return plain if scale == 1 else Total(((Fraction(scale), plain),))


def total(*terms: tuple[Fraction | int, Formula]) -> Formula:
    """Return the sum of rational multiples of formulas. Nested sums are flattened, and equal terms are
    collected.

    The comparison of terms ignores the names of bound indices.

    >>> c = coefficient("c", "i")
    >>> total((1, c), (Fraction(-3, 2), c), (1, one())).text()
    '-1/2 c_i + 1'
    """
    flat: list[tuple[Formula, Fraction]] = []
    for scale, term in terms:
        if isinstance(term, Total):
            flat += [(part, inner if scale == 1 else scale * inner) for inner, part in term.terms]
        else:
            flat.append((term, Fraction(scale)))
    collected: dict[Hashable, tuple[Formula, Fraction]] = {}
    for part, scale in flat:
        key = None if len(flat) == 1 else _shape(part, {})
        if (seen := collected.get(key)) is not None:
            part, scale = seen[0], seen[1] + scale
        collected[key] = (part, scale)
    kept = tuple((scale, term) for term, scale in collected.values() if scale)
    return kept[0][1] if len(kept) == 1 and kept[0][0] == 1 else Total(kept)


def index_sum(indices: Sequence[str], relations: Iterable[Relation], body: Formula) -> Formula:
    """Return the sum of the formula ``body`` over ``indices``. Only index values that satisfy ``relations``
    contribute.

    If ``body`` contains sums as factors, the result is a single sum over all indices.

    >>> a, c = coefficient("a", "i", "j"), coefficient("c", "j")
    >>> index_sum(("j",), (("i", "<", "j"),), product(a, c)).text()
    'sum_{j>i} a_ij c_j'
    """
    if not indices:
        return body
    if isinstance(body, Total) and len(body.terms) <= 1:
        return total(*((scale, index_sum(indices, relations, inner)) for scale, inner in body.terms))
    parts = body.factors if isinstance(body, Product) else (body,)
    if not any(isinstance(factor, IndexSum) for factor in parts):
        return IndexSum(tuple(indices), tuple(relations), body)
    all_indices, all_relations, factors = list(indices), list(relations), []
    for factor in parts:
        if isinstance(factor, IndexSum):
            all_indices += factor.indices
            all_relations += factor.relations
            factors.append(factor.body)
        else:
            factors.append(factor)
    return IndexSum(tuple(all_indices), tuple(all_relations), product(*factors))


def fresh(kind: str = "i") -> str:
    """Return an index name that no existing formula contains. The name begins with the letter ``kind``.

    >>> fresh() != fresh()
    True
    """
    return f"{kind}#{next(_numbers)}"


def refreshed(formula: Formula, names: Mapping[str, str]) -> Formula:
    """Return the formula with new names for its indices. ``names`` maps free indices to their new names. Each
    bound index is renamed by :func:`fresh`.

    >>> half = index_sum(("j",), (), coefficient("a", "i", "j"))
    >>> named(product(*(refreshed(half, {"i": row}) for row in ("k", "l")))).text()
    '(sum_i a_ki) (sum_i a_li)'
    """
    match formula:
        case Coefficient(name, indices):
            return Coefficient(name, tuple(names.get(index, index) for index in indices))
        case Product(factors):
            return Product(tuple(refreshed(factor, names) for factor in factors))
        case Power(base, exponent):
            return Power(refreshed(base, names), exponent)
        case Total(terms):
            return Total(tuple((scale, refreshed(term, names)) for scale, term in terms))
        case IndexSum(indices, relations, body):
            inner = {**names, **{index: fresh(index[0]) for index in indices}}
            new = tuple((inner.get(i, i), sign, inner.get(j, j)) for i, sign, j in relations)
            return IndexSum(tuple(inner[index] for index in indices), new, refreshed(body, inner))
    raise TypeError(f"not a formula: {formula!r}")


def named(formula: Formula, names: Mapping[str, str] | None = None) -> Formula:
    """Return the formula with readable names of bound indices: i, j, k, ... for stages, and I, J, K, ... for
    exponentials.

    ``names`` maps free indices to their new names. If two sums differ only in the names of bound indices, the
    results for both sums are identical.

    >>> i = fresh()
    >>> named(index_sum((i,), (), coefficient("b", i))).text()
    'sum_i b_i'
    """
    names = names or {}
    # The new name of a bound index must differ from the names of all free indices.
    return _named(formula, names, tuple(x for x in free_indices(formula) if x not in names))


def _named(formula: Formula, names: Mapping[str, str], free: tuple[str, ...]) -> Formula:
    match formula:
        case Coefficient(name, indices):
            return Coefficient(name, tuple(names.get(index, index) for index in indices))
        case Product(factors):
            return Product(tuple(_named(factor, names, free) for factor in factors))
        case Power(base, exponent):
            return Power(_named(base, names, free), exponent)
        case Total(terms):
            return Total(tuple((scale, _named(term, names, free)) for scale, term in terms))
        case IndexSum(indices, relations, body):
            inner = dict(names)
            used = {*free, *inner.values()}
            for index in indices:
                inner[index] = _next_name(index, used)
                used.add(inner[index])
            new = tuple((inner.get(i, i), sign, inner.get(j, j)) for i, sign, j in relations)
            return IndexSum(tuple(inner[index] for index in indices), new, _named(body, inner, free))
    raise TypeError(f"not a formula: {formula!r}")


def coefficients(formula: Formula) -> Iterator[Coefficient]:
    """Yield every coefficient that occurs in a formula, from left to right.

    >>> [c.name for c in coefficients(product(coefficient("b", "i"), coefficient("c", "i")))]
    ['b', 'c']
    """
    match formula:
        case Coefficient():
            yield formula
        case Product(factors):
            for factor in factors:
                yield from coefficients(factor)
        case Power(base, _) | IndexSum(_, _, base):
            yield from coefficients(base)
        case Total(terms):
            for _, term in terms:
                yield from coefficients(term)


def free_indices(formula: Formula) -> tuple[str, ...]:
    """Return the indices that are not bound by a sum, from left to right.

    >>> free_indices(index_sum(("j",), (), coefficient("a", "i", "j")))
    ('i',)
    """
    match formula:
        case Coefficient(_, indices):
            names: Iterable[str] = indices
        case Product(factors):
            names = itertools.chain.from_iterable(free_indices(factor) for factor in factors)
        case Power(base, _):
            names = free_indices(base)
        case Total(terms):
            names = itertools.chain.from_iterable(free_indices(term) for _, term in terms)
        case IndexSum(indices, relations, body):
            inner = itertools.chain(free_indices(body), *((i, j) for i, _, j in relations))
            names = [index for index in inner if index not in indices]
        case _:
            raise TypeError(f"not a formula: {formula!r}")
    return tuple(dict.fromkeys(names))


def _powers(factors: Iterable[Formula]) -> list[tuple[Formula, int]]:
    powers: list[tuple[Formula, int]] = []
    for factor in factors:
        for part in factor.factors if isinstance(factor, Product) else (factor,):
            powers.append((part.base, part.exponent) if isinstance(part, Power) else (part, 1))
    return powers


def _shape(formula: Formula, depths: Mapping[str, int]) -> Hashable:
    """Return a key that identifies a formula up to the names of bound indices. In the key, numbers replace
    the names of these indices.

    If ``formula`` is inside other sums, ``depths`` maps the indices of these sums to their numbers.
    """
    match formula:
        case Coefficient(name, indices):
            return (name, *[depths.get(index, index) for index in indices])
        case Product(factors):
            return ("*", *[_shape(factor, depths) for factor in factors])
        case Power(base, exponent):
            return ("^", exponent, _shape(base, depths))
        case Total(terms):
            return ("+", *[(q.numerator, q.denominator, _shape(term, depths)) for q, term in terms])
        case IndexSum(indices, relations, body):
            inner = dict(depths)
            for index in indices:
                inner[index] = len(inner)
            kinds = tuple(index[0].isupper() for index in indices)
            bounds = tuple((inner.get(i, i), sign, inner.get(j, j)) for i, sign, j in relations)
            return ("sum", kinds, bounds, _shape(body, inner))
    raise TypeError(f"not a formula: {formula!r}")


def _next_name(index: str, used: Container[str]) -> str:
    pool = EXPONENTIAL_NAMES if index[0].isupper() else STAGE_NAMES
    for name in pool:
        if name not in used:
            return name
    return next(name for name in (f"{pool[0]}{n}" for n in itertools.count(1)) if name not in used)


def _rendered(formula: Formula, notation: Notation) -> str:
    match formula:
        case Coefficient(name, indices):
            return notation.names.get(name, name) + subscript(joined(indices), notation)
        case Product(factors):
            return " ".join(_grouped(factor, notation) for factor in factors) or "1"
        case Power(base, exponent):
            raised = f"{{{exponent}}}" if notation.always_braces else str(exponent)
            compound = isinstance(base, Product | Power) or (isinstance(base, Total) and len(base.terms) == 1)
            inner = f"{notation.opening}{_rendered(base, notation)}{notation.closing}"
            return f"{inner if compound else _grouped(base, notation)}^{raised}"
        case Total(terms):
            return _terms(terms, notation)
        case IndexSum(indices, relations, body):
            below = subscript(chains(indices, relations, notation), notation)
            summand = _bracketed(body, notation) if isinstance(body, Total) else _rendered(body, notation)
            return f"{notation.total}{below} {summand}"
    raise TypeError(f"not a formula: {formula!r}")


def _bracketed(formula: Formula, notation: Notation) -> str:
    return f"{notation.opening}{_rendered(formula, notation)}{notation.closing}"


def _grouped(formula: Formula, notation: Notation) -> str:
    is_sum = isinstance(formula, IndexSum | Total)
    return _bracketed(formula, notation) if is_sum else _rendered(formula, notation)


def _terms(terms: Sequence[tuple[Fraction, Formula]], notation: Notation) -> str:
    written = ""
    for scale, term in terms:
        sign = (" - " if scale < 0 else " + ") if written else ("-" if scale < 0 else "")
        magnitude = abs(scale)
        size = latex_fraction(magnitude) if notation.latex_fractions else str(magnitude)
        if isinstance(term, Product) and not term.factors:
            factor = size
        else:
            body = _bracketed(term, notation) if isinstance(term, Total) else _rendered(term, notation)
            factor = body if size == "1" else f"{size} {body}"
        written += sign + factor
    return written or "0"
