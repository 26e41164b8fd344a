"""Relations of dependent conditions. The left-hand side of a dependent condition is a polynomial in the
left-hand sides of independent conditions.

Two laws make conditions dependent.

- For trees u and v, let u o v be the tree u with v as an additional branch of the root. The elementary
  weights phi of a symplectic method satisfy phi(u o v) + phi(v o u) = phi(u) phi(v) (HLW VI.7.1).
- Let a(w) be the coefficient of the word w in a group-like series. Then a(u) a(v) is the sum of a(w) over all
  shuffles w of u and v. The series of a Lie group method is group-like. Therefore the coefficients of Lyndon
  words determine all other coefficients (Reutenauer, Free Lie Algebras, Thm 6.1).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache, reduce
from math import factorial, prod
from typing import Any

from orderconds.conditions import OrderCondition
from orderconds.trees.levels import Forest, Tree, trees_of
from orderconds.words.lyndon import lyndon_factors
from orderconds.words.shuffle import shuffle

Polynomial = dict[tuple[Any, ...], Fraction]
"""A polynomial in the left-hand sides of conditions: a map from monomials to coefficients. A monomial is a
sorted tuple of keys of conditions."""

Moves = Callable[[bytes], Iterable[tuple[bytes, bytes, bytes]]]
"""A function that maps a tree to triples (u, v, v o u). Each branch v of the root gives one triple, and u is
the tree without v. The module docstring defines v o u."""


def spell(polynomial: Polynomial, text: Callable[[Any], str]) -> str:
    r"""Return a polynomial as text. ``<tree>`` denotes the left-hand side of the condition of a tree.
    Terms with fewer factors come first.

    >>> spell({(b"\0", b"\0"): Fraction(1, 2), (b"\0\1",): Fraction(-1)}, str)
    "-<b'\\x00\\x01'> + 1/2 <b'\\x00'> <b'\\x00'>"
    """
    terms = []
    for factors, scale in sorted(polynomial.items(), key=lambda term: (len(term[0]), term[0])):
        size = "" if abs(scale) == 1 else f"{abs(scale)} "
        terms.append(("-" if scale < 0 else "+", size + " ".join(f"<{text(factor)}>" for factor in factors)))
    if not terms:
        return "0"
    (sign, first), *rest = terms
    return ("-" if sign == "-" else "") + first + "".join(f" {s} {term}" for s, term in rest)


def add(x: Polynomial, y: Polynomial, scale: Fraction | int = 1) -> Polynomial:
    """Return the polynomial x + ``scale`` y.

    >>> add({(b"t",): Fraction(1)}, {(b"t",): Fraction(1)}, -1)
    {}
    """
    result = dict(x)
    for factors, value in y.items():
        result[factors] = result.get(factors, Fraction(0)) + scale * value
    return {factors: value for factors, value in result.items() if value}


def multiply(x: Polynomial, y: Polynomial) -> Polynomial:
    """Return the product x y of two polynomials.

    >>> multiply({(b"u",): Fraction(2)}, {(b"t",): Fraction(3)})
    {(b't', b'u'): Fraction(6, 1)}
    """
    result: Polynomial = {}
    for left, a in x.items():
        for right, b in y.items():
            factors = tuple(sorted(left + right))
            result[factors] = result.get(factors, Fraction(0)) + a * b
    return result


class RootSwitching:
    """A function that expresses the elementary weight of a tree as a polynomial in the elementary weights of
    independent trees. The polynomial is valid for symplectic methods.

    The call ``independent(n)`` returns the independent trees with n vertices.

    >>> from orderconds.families.symplectic_rk import SWITCHING
    >>> from orderconds.trees.levels import parse, text
    >>> spell(SWITCHING(parse("[[.]]")), text)
    '-<[..]> + 1/2 <.> <.> <.>'
    """

    def __init__(self, moves: Moves, independent: Callable[[int], Collection[bytes]]) -> None:
        self._moves, self._independent = moves, independent
        self._known: dict[bytes, Polynomial] = {}

    def __call__(self, tree: bytes) -> Polynomial:
        """Return the elementary weight of ``tree`` as a polynomial in the weights of independent trees."""
        if tree not in self._known:
            self._known[tree] = self._reduced(tree)
        return self._known[tree]

    def _reduced(self, tree: bytes) -> Polynomial:
        goals = frozenset(self._independent(len(tree)))
        waiting: list[tuple[bytes, int, Polynomial]] = [(tree, 1, {})]
        seen = {tree}
        for root, sign, so_far in waiting:  # The loop appends trees to ``waiting``.
            if root in goals:
                return add(so_far, {(root,): Fraction(1)}, sign)
            for u, v, moved in self._moves(root):
                both = multiply(self(u), self(v))
                if moved == root and u == v:
                    return add(so_far, both, Fraction(sign, 2))
                if moved not in seen:
                    seen.add(moved)
                    waiting.append((moved, -sign, add(so_far, both, sign)))
        raise ValueError("the weights of the independent trees do not determine the weight of a tree")


def with_relations(
    conditions: Iterable[OrderCondition],
    polynomial: Callable[[Any], Polynomial],
    text: Callable[[Any], str],
) -> tuple[OrderCondition, ...]:
    """Return the conditions. If a condition depends on other conditions, its attribute ``relation`` is set.

    The relation is the text of a polynomial in left-hand sides of independent conditions. The function
    ``polynomial`` maps the key of a condition to the polynomial, and ``text`` converts a key to text.

    >>> from orderconds.families.symplectic_rk import SWITCHING, SymplecticFamily
    >>> from orderconds.trees.levels import text
    >>> [c.relation for c in with_relations(SymplecticFamily().all_conditions(2), SWITCHING, text)]
    ['1/2 <.> <.>']
    """
    result = []
    for condition in conditions:
        equal = polynomial(condition.key)
        alone = equal == {(condition.key,): 1}
        result.append(condition if alone else replace(condition, relation=spell(equal, text)))
    return tuple(result)


def letter_key(tree: Tree) -> tuple[int, bytes]:
    """Return the sort key of a tree. Larger trees come first. Among trees of equal size, the
    tree with the larger level sequence comes first.

    >>> from orderconds.trees.levels import parse, text
    >>> [text(tree) for tree in sorted(map(parse, (".", "[..]", "[[.]]")), key=letter_key)]
    ['[[.]]', '[..]', '.']
    """
    return -len(tree), bytes(255 - level for level in tree)


@lru_cache(maxsize=1 << 14)
def _in_lyndon_words(word: tuple[Tree, ...]) -> tuple[tuple[tuple[Forest, ...], Fraction], ...]:
    factors = lyndon_factors(word, letter_key)
    if len(factors) <= 1:
        return ((tuple(b"".join(factor) for factor in factors), Fraction(1)),)
    # Let ``factors`` be the words f_1, ..., f_k. Their concatenation is ``word``. Let a(w) be the coefficient
    # of the word w in a group-like series. The product a(f_1) ... a(f_k) is the sum of n_w a(w) over all
    # words w, where n_w is the coefficient of w in the shuffle product of f_1, ..., f_k. The
    # variable ``repeated`` is the number n_w for w = ``word``. All other words in the shuffle product are
    # lexicographically smaller.
    repeated = prod(factorial(factors.count(factor)) for factor in dict.fromkeys(factors))
    words = reduce(_shuffled, factors[1:], {factors[0]: 1})
    result: Polynomial = {tuple(sorted(b"".join(factor) for factor in factors)): Fraction(1)}
    for other, times in words.items():
        if other != word:
            result = add(result, dict(_in_lyndon_words(other)), -times)
    return tuple((monomial, value / repeated) for monomial, value in result.items())


def _shuffled(words: dict[tuple[Tree, ...], int], factor: tuple[Tree, ...]) -> dict[tuple[Tree, ...], int]:
    counts: dict[tuple[Tree, ...], int] = {}
    for word, times in words.items():
        for shuffled, more in shuffle(word, factor).items():
            counts[shuffled] = counts.get(shuffled, 0) + times * more
    return counts


def in_lyndon_words(forest: Forest, scale: Callable[[Forest], int]) -> Polynomial:
    r"""Express a coefficient of a group-like series as a polynomial in the coefficients of Lyndon words.

    The argument ``forest`` is the word of the coefficient, and its letters are trees. For each word w, let
    x(w) be ``scale(w)`` times the coefficient of w. The polynomial expresses x(``forest``) by the numbers
    x(w) of Lyndon words w.

    >>> in_lyndon_words(b"\0\0", lambda forest: 1)
    {(b'\x00', b'\x00'): Fraction(1, 2)}
    """
    return {
        monomial: value * scale(forest) / prod(map(scale, monomial))
        for monomial, value in _in_lyndon_words(trees_of(forest))
    }
