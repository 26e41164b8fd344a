"""Composition, inverse and adjoint of steps, given as B-series or Lie-Butcher series.

The function that maps a tree or forest to its coefficient in the series of a step is called a character. The
coefficient of the empty forest is 1. In the composition of two steps, a coefficient is a sum over cuts
(:mod:`orderconds.series.cuts`).

A B-series has a coefficient a(t) for each canonical rooted tree t. The series is y1 = y0 + sum_t h^|t|
a(t)/sigma(t) F(t), where y0 and y1 are the values before and after a step of size h. Here |t| is the number
of vertices of t, sigma(t) is the order of the symmetry group of t, and F(t) is the elementary differential of
t. A Lie-Butcher series has a coefficient for each ordered forest (:mod:`orderconds.series.lie_butcher`). HLW
denotes Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from orderconds.ring.protocol import Element, Ring
from orderconds.series.cuts import Cuts, left_cuts, tree_cuts
from orderconds.series.lie_butcher import exact_value
from orderconds.trees.levels import density

Value = Callable[[bytes], Element]


@dataclass(frozen=True)
class TreeAlgebra:
    """An algebra of trees or forests. ``cuts`` returns the admissible cuts of a tree or forest. ``exact``
    returns the coefficient of a tree or forest in the exact flow.

    >>> str(ROOTED.exact(bytes((0, 1, 1)))), len(ORDERED.cuts(bytes((0, 1, 1))))
    ('1/3', 4)
    """

    cuts: Cuts
    exact: Callable[[bytes], Fraction]


ROOTED = TreeAlgebra(tree_cuts, lambda tree: Fraction(1, density(tree)))
"""The algebra of canonical rooted trees, for B-series. In the exact flow, a tree of density gamma has the
coefficient 1/gamma (HLW III.1, Theorem 1.5)."""

ORDERED = TreeAlgebra(left_cuts, exact_value)
"""The algebra of ordered forests, for Lie-Butcher series. The leftmost tree of a forest acts first."""


class Character:
    """A step of size h, represented by the character of its series. The character maps a tree or forest to
    its coefficient in the series. The coefficients are elements of ``ring``.

    >>> from orderconds.ring import QQ
    >>> euler = Character(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
    >>> twice = euler.then(euler)
    >>> [str(twice(tree)) for tree in (b"\\0", b"\\0\\1", b"\\0\\1\\1", b"\\0\\1\\2")]
    ['2', '1', '1', '0']
    """

    def __init__(self, ring: Ring, algebra: TreeAlgebra, value: Value) -> None:
        self.ring, self.algebra, self._value = ring, algebra, value
        self._known: dict[bytes, Element] = {b"": ring.one}

    def __call__(self, forest: bytes) -> Element:
        """Return the coefficient of a tree or forest in the series of the step."""
        if forest not in self._known:
            self._known[forest] = self._value(forest)
        return self._known[forest]

    def then(self, other: Character) -> Character:
        """Return the composition of two steps of size h: this step acts first, and the step ``other`` acts
        second.

        Each coefficient of the composition is a sum over cuts. For a rooted tree, the sum runs over all
        admissible cuts (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, III.1.4, Theorem 1.10).
        For an ordered forest, the sum runs over the left admissible cuts (Munthe-Kaas and Wright 2008,
        Theorem 5).
        """

        def value(forest: bytes) -> Element:
            return self._sum(forest, other, whole=True)

        return Character(self.ring, self.algebra, value)

    def inverse(self) -> Character:
        """Return the inverse step: ``a.then(a.inverse())`` is the identity.

        >>> from orderconds.ring import QQ
        >>> flow = exact_flow(QQ, ROOTED)
        >>> str(flow.inverse()(b"\\0\\1\\2"))
        '-1/6'
        """
        undone = Character(self.ring, self.algebra, lambda forest: self.ring.zero)
        undone._value = lambda forest: self.ring.zero - self._sum(forest, undone, whole=False)
        return undone

    def adjoint(self) -> Character:
        """Return the adjoint of the step: its inverse, with -h in place of h (HLW II.3, Def. 3.1).

        >>> from orderconds.ring import QQ
        >>> euler = Character(QQ, ROOTED, lambda tree: QQ.rational(len(tree) == 1))
        >>> [str(euler.adjoint()(tree)) for tree in (b"\\0", b"\\0\\1", b"\\0\\1\\1")]
        ['1', '1', '1']
        """
        return self.inverse().scaled(self.ring.rational(-1))

    def scaled(self, factor: Element) -> Character:
        """Return the same step with the step size c h instead of h, where c is ``factor``."""

        def value(forest: bytes) -> Element:
            power = self.ring.one
            for _ in forest:
                power = power * factor
            return self(forest) * power

        return Character(self.ring, self.algebra, value)

    def _sum(self, forest: bytes, other: Character, whole: bool) -> Element:
        """Return a sum over the admissible cuts of a tree or forest (:mod:`orderconds.series.cuts`). Each cut
        removes components and leaves a rest. The summand of a cut is ``other(rest)``, multiplied by
        ``self(component)`` for each component of the cut. If ``whole`` is false, the sum omits the cut whose
        rest is the whole tree or forest."""
        result = self.ring.zero
        for components, rest in self.algebra.cuts(forest):
            if components or whole:
                term = other(rest)
                for component in components:
                    term = term * self(component)
                result = result + term
        return result


def exact_flow(ring: Ring, algebra: TreeAlgebra) -> Character:
    """Return the exact flow over time h as a character.

    >>> from orderconds.ring import QQ
    >>> str(exact_flow(QQ, ORDERED)(bytes((0, 1, 2, 1))))
    '1/24'
    """

    def value(forest: bytes) -> Element:
        exact = algebra.exact(forest)
        return ring.rational(exact.numerator, exact.denominator)

    return Character(ring, algebra, value)
