"""The text of a Lie algebra element in a tableau file, such as ``"[2,1]"``, ``"[a, [1, b]]"`` or ``"S*S*S"``.

The number i denotes the vector field at node i of a quadrature formula. A name denotes an element whose
definition precedes it in the file. The commutator ``[x,y]`` is the product ``x*y`` minus the product ``y*x``.
The last factor of a product acts first. Products such as ``S*S`` are allowed only if the method uses the
Cayley map. Arguments of the Cayley map may contain products, but must be elements of the Lie algebra.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache

from msgspec import Struct

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring

Nodes = tuple[int, ...]
NodeSeries = dict[Nodes, Element]
"""A map from words (tuples of nodes) to coefficients. The word (i, j) denotes the product A_j A_i, where A_i
is the vector field at node i."""

MAX_DEPTH = 12
_TOKEN = re.compile(r"\s*(?:([0-9]{1,3})|([A-Za-z_]\w*)|([\[\],*]))", re.ASCII)


class Bracket(Struct, frozen=True):
    """The commutator of two terms. In ``left`` and ``right``, nodes are counted from 0. In the text of a
    term, nodes are counted from 1.

    >>> spell(Bracket(1, "a"))
    '[2,a]'
    """

    left: Term
    right: Term


class Product(Struct, frozen=True):
    """The product of two or more terms. The last term acts first.

    >>> spell(Product((0, "a", 0)))
    '1*a*1'
    """

    factors: tuple[Term, ...]


Term = int | str | Bracket | Product
"""An integer is a node, and nodes are counted from 0. A string is the name of an element."""
Combination = tuple[tuple[Term, Element], ...]
"""A linear combination of terms, as pairs (term, coefficient)."""


def parse(text: str, where: str) -> Term:
    """Parse a term. The text counts nodes from 1, and the result counts nodes from 0.

    Raises :class:`TableauError` if the text is malformed. The error message contains ``where``.

    >>> parse("[2,1]", "exponents")
    Bracket(left=1, right=0)
    """
    tokens = list(_tokens(text, where))
    term, rest = _product(tokens, 0, text, where, 0)
    if rest != len(tokens):
        raise _error(f"{tokens[rest]!r} after a complete term in {text!r}", where)
    return term


def spell(term: Term) -> str:
    """Return the text of a term. The function :func:`parse` converts the text to the term again.

    >>> spell(parse("[ 2, [1,a] ]", ""))
    '[2,[1,a]]'
    """
    if isinstance(term, Bracket):
        return f"[{spell(term.left)},{spell(term.right)}]"
    if isinstance(term, Product):
        return "*".join(map(spell, term.factors))
    return term if isinstance(term, str) else str(term + 1)


def leaves(term: Term) -> Iterator[int | str]:
    """Yield the leaves of a term from left to right: names, and indices of nodes (counted from 0).

    >>> list(leaves(parse("[2,[1,a]]", "")))
    [1, 0, 'a']
    """
    if isinstance(term, Bracket):
        yield from leaves(term.left)
        yield from leaves(term.right)
    elif isinstance(term, Product):
        for factor in term.factors:
            yield from leaves(factor)
    else:
        yield term


def has_product(term: Term) -> bool:
    """Return True if a term is a product, or is a bracket that contains a product.

    >>> has_product(parse("[1,2]", "")), has_product(parse("[1,2*3]", ""))
    (False, True)
    """
    if isinstance(term, Bracket):
        return has_product(term.left) or has_product(term.right)
    return isinstance(term, Product)


def extents(elements: Mapping[str, Combination]) -> Callable[[Term], tuple[int, int]]:
    """Return a function that maps a term to a lower and an upper bound of the degrees in its expansion.

    The expansion of a term is a sum of products of vector fields. The degree of a product is the number of
    its factors. ``elements`` contains the definition of each name in the terms.

    >>> extents({"f": ((0, 1), (Bracket(0, 1), 1))})(Bracket("f", "f"))
    (2, 4)
    """

    @cache
    def extent(term: Term) -> tuple[int, int]:
        if isinstance(term, int):
            return 1, 1
        if isinstance(term, str):
            return extent_of_sum(elements[term], extent)
        parts = term.factors if isinstance(term, Product) else (term.left, term.right)
        return sum(extent(t)[0] for t in parts), sum(extent(t)[1] for t in parts)

    return extent


def extent_of_sum(combination: Combination, extent: Callable[[Term], tuple[int, int]]) -> tuple[int, int]:
    """Return a lower and an upper bound of the degrees in the expansion of a linear combination of terms.

    For a single term, ``extent(term)`` returns the two bounds.

    >>> extent_of_sum(((0, 1), (Bracket(0, 1), 1)), extents({}))
    (1, 2)
    """
    # For an empty combination, the bounds (1, 1) are a convention.
    extents = [extent(term) for term, _ in combination] or [(1, 1)]
    return min(least for least, _ in extents), max(most for _, most in extents)


def expand(combination: Combination, named: Mapping[str, NodeSeries], ring: Ring) -> NodeSeries:
    """Return the expansion of a linear combination of terms, as a map from words to coefficients. ``named``
    maps each name in the terms to its expansion. Words with coefficient zero are omitted.

    >>> from orderconds.ring import QQ
    >>> expand(((parse("[2,1]", ""), QQ.one),), {}, QQ)
    {(0, 1): 1, (1, 0): -1}
    """
    result: NodeSeries = {}
    for term, scale in combination:
        for word, value in _expanded(term, named, ring).items():
            result[word] = result.get(word, ring.zero) + scale * value
    return {word: value for word, value in result.items() if ring.is_zero(value) is not True}


def _expanded(term: Term, named: Mapping[str, NodeSeries], ring: Ring) -> NodeSeries:
    if isinstance(term, int):
        return {(term,): ring.one}
    if isinstance(term, str):
        return dict(named[term])
    if isinstance(term, Product):
        result = _expanded(term.factors[0], named, ring)
        for factor in term.factors[1:]:
            result = _times(result, _expanded(factor, named, ring), ring)
        return result
    x, y = _expanded(term.left, named, ring), _expanded(term.right, named, ring)
    result = _times(x, y, ring)
    for word, value in _times(y, x, ring).items():
        result[word] = result.get(word, ring.zero) - value
    return result


def _times(x: NodeSeries, y: NodeSeries, ring: Ring) -> NodeSeries:
    """Return the product ``x*y``."""
    result: NodeSeries = {}
    for u, a in x.items():
        for v, b in y.items():
            result[v + u] = result.get(v + u, ring.zero) + a * b
    return result


def _tokens(text: str, where: str) -> Iterator[str]:
    place = 0
    while text[place:].strip():
        match = _TOKEN.match(text, place)
        if match is None:
            raise _error(f"the character {text[place:].strip()[:1]!r} in {text[:80]!r}", where)
        yield match[0].strip()
        place = match.end()


def _product(tokens: list[str], place: int, text: str, where: str, depth: int) -> tuple[Term, int]:
    factors = []
    while True:
        factor, place = _factor(tokens, place, text, where, depth)
        factors.append(factor)
        if place == len(tokens) or tokens[place] != "*":
            return (factors[0] if len(factors) == 1 else Product(tuple(factors))), place
        place += 1


def _factor(tokens: list[str], place: int, text: str, where: str, depth: int) -> tuple[Term, int]:
    if place == len(tokens):
        raise _error(f"an incomplete term {text[:80]!r}", where)
    token = tokens[place]
    if token == "[":
        if depth == MAX_DEPTH:
            raise _error(f"brackets nested deeper than {MAX_DEPTH}", where)
        left, place = _product(tokens, place + 1, text, where, depth + 1)
        place = _expect(",", tokens, place, text, where)
        right, place = _product(tokens, place, text, where, depth + 1)
        return Bracket(left, right), _expect("]", tokens, place, text, where)
    if token.isdigit():
        return int(token) - 1, place + 1
    if token in ",]*":
        raise _error(f"{token!r} in place of a term in {text[:80]!r}", where)
    return token, place + 1


def _expect(token: str, tokens: list[str], place: int, text: str, where: str) -> int:
    if place == len(tokens) or tokens[place] != token:
        raise _error(f"a missing {token!r} in {text[:80]!r}", where)
    return place + 1


def _error(problem: str, where: str) -> TableauError:
    return TableauError(problem, where=where, expected='a node ("1"), a name, or a bracket ("[2,1]")')
