"""Symmetry of Magnus methods: a step of length -h undoes a step of length h.

The method for Y' = A(t) Y has s nodes c_i that are symmetric about 1/2. Let A_i = h A(c_i h). The reverse
step starts at time h and contains -h A(h - c_i h) = -A_{s+1-i} in place of A_i. In this module, the
*substitution* is the replacement of every A_i by -A_{s+1-i}. Let Omega_1, ..., Omega_m be the exponents of
the method. The method is symmetric if the substitution turns every Omega_k into -Omega_{m+1-k}.

A combination of the A_i is called *odd* if the substitution changes its sign. A combination is called *even*
if the substitution does not change it. A method with only one exponent is symmetric if this exponent is odd.
"""

from __future__ import annotations

from functools import cache

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.brackets import Combination, Product, Term
from orderconds.tableau.products import Magnus


def symmetric_exponents(method: Magnus, ring: Ring) -> bool | None:
    """Return True if a method is symmetric, and False if it is not. Return None if balls (intervals) are too
    wide to decide, or if the expansion of the exponents is too long (:meth:`Magnus.is_expandable`).

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> symmetric_exponents(Magnus((half,), (((0, QQ.one),),)), QQ)
    True
    """
    nodes = [ring.is_zero(x + y - 1) for x, y in zip(method.c, method.c[::-1], strict=True)]
    if False in nodes:
        return False
    if len(method.exponents) == 1 and sign(method, ring) == -1:
        return None if None in nodes else True
    if not method.is_expandable():
        return None
    series, last, verdicts = method.words(ring), method.s - 1, nodes
    for one, other in zip(series, series[::-1], strict=True):
        mirror = {tuple(last - i for i in word): value for word, value in other.items()}
        for word in sorted({*one, *mirror}):
            u: Element = one.get(word, ring.zero)
            v: Element = mirror.get(word, ring.zero)
            verdicts.append(ring.is_zero(u - v if len(word) % 2 else u + v))
    return False if False in verdicts else None if None in verdicts else True


def sign(method: Magnus, ring: Ring) -> int | None:
    """Return -1 if the test below finds that the first exponent of a Magnus method is odd, and 1 if the test
    finds that the exponent is even. Otherwise, return None.

    Let A_i = h A(c_i h) for the nodes c_1, ..., c_s. The reversal of time replaces every A_i by -A_{s+1-i}.
    An expression is called odd if this replacement changes the sign of the expression. An expression is
    called even if this replacement does not change the expression.

    The test writes the exponent as the sum of a linear combination of A_1, ..., A_s and other terms, such as
    brackets. The exponent is odd if the linear combination and all other terms are odd. The exponent is even
    if the linear combination and all other terms are even. If a bracket or a product in the exponent has a
    factor that is neither odd nor even, the result is None.

    >>> from orderconds.ring import QQ
    >>> sign(Magnus((QQ.zero, QQ.one), (((0, QQ.one), (1, QQ.one)),)), QQ)
    -1
    """
    elements = dict(method.elements)

    @cache
    def of_term(term: Term) -> int | None:
        if isinstance(term, int):
            return of_nodes({term: ring.one})
        if isinstance(term, str):
            return of_combination(elements[term])
        signs = [of_term(t) for t in (term.factors if isinstance(term, Product) else (term.left, term.right))]
        result = 1
        for x in signs:
            if x is None:
                return None
            result *= x
        return result

    def of_nodes(row: dict[int, Element]) -> int | None:
        pairs: list[tuple[Element, Element]] = [
            (row.get(i, ring.zero), row.get(method.s - 1 - i, ring.zero)) for i in range(method.s)
        ]
        if all(ring.is_zero(x - y) is True for x, y in pairs):
            return -1
        return 1 if all(ring.is_zero(x + y) is True for x, y in pairs) else None

    def of_combination(combination: Combination) -> int | None:
        row = {term: x for term, x in combination if isinstance(term, int)}
        signs = {of_term(term) for term, _ in combination if not isinstance(term, int)}
        signs |= {of_nodes(row)} if row else set()
        return signs.pop() if len(signs) == 1 else None

    return of_combination(method.exponents[0])
