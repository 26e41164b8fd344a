"""Splittings, compositions and Magnus methods, stored as sequences of maps.

The first factor of a sequence acts first. HLW denotes Hairer, Lubich and Wanner, *Geometric Numerical
Integration*.
"""

from __future__ import annotations

from dataclasses import dataclass

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.brackets import Combination, NodeSeries, expand, extent_of_sum, extents
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Convert,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
)


@dataclass(frozen=True)
class Splitting:
    """A splitting method: a product of flows of the parts of a vector field. An entry (k, x) of ``steps`` is
    the flow of part k over the time x h, where h is the step size.

    A Runge-Kutta-Nystroem splitting has two parts T and V whose Lie brackets satisfy [V,[V,[V,T]]] = 0. For
    such a splitting, ``rkn`` is the index of V in ``parts``. For all other splittings, ``rkn`` is None.

    >>> Splitting(("T", "V"), ((0, 1), (1, 1)), rkn=1).s
    2
    """

    parts: tuple[str, ...]
    steps: tuple[tuple[int, Element], ...]
    rkn: int | None = None

    @property
    def s(self) -> int:
        """The number of flows in a step."""
        return len(self.steps)

    def map(self, convert: Convert) -> Splitting:
        """Return a copy of the splitting in which ``convert`` is applied to every coefficient."""
        return Splitting(self.parts, tuple((part, convert(x)) for part, x in self.steps), self.rkn)


@dataclass(frozen=True)
class AdjointComposition:
    """A composition of a basic method Phi and its adjoint Phi*.

    One step of size h is Phi_{alpha_s h} Phi*_{beta_s h} ... Phi_{alpha_1 h} Phi*_{beta_1 h}. The rightmost
    factor acts first (HLW, Section II.4).

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> AdjointComposition((half,), (half,)).as_splitting().steps
    ((1, 1/2), (0, 1), (1, 1/2))
    """

    alpha: Row
    beta: Row

    base = "adjoint-pair"

    @property
    def s(self) -> int:
        """The number of pairs (alpha_i, beta_i)."""
        return len(self.alpha)

    def map(self, convert: Convert) -> AdjointComposition:
        """Return a copy of the composition in which ``convert`` is applied to every coefficient."""
        alpha, beta = (tuple(convert(x) for x in row) for row in (self.alpha, self.beta))
        return AdjointComposition(alpha, beta)

    def as_runge_kutta(self, ring: Ring) -> RungeKutta:
        """Return the composition as a Runge-Kutta tableau. The basic method Phi becomes the explicit Euler
        method, and the adjoint Phi* becomes the implicit Euler method.

        Let beta_i h be the step sizes of Phi*, and let alpha_i h be the step sizes of Phi. Then the
        coefficients are b_i = beta_i + alpha_i, a_ii = beta_i, and a_ij = b_j for j < i (HLW, Section II.4).
        """
        b = tuple(y + x for x, y in zip(self.alpha, self.beta, strict=True))
        A = tuple((*b[:i], y, *((ring.zero,) * (self.s - i - 1))) for i, y in enumerate(self.beta))
        return RungeKutta(A, b)

    def as_splitting(self) -> Splitting:
        """Convert the composition to a splitting into two parts A and B, with the indices 0 and 1. The basic
        method Phi is the flow of A, followed by the flow of B.

        The order of the composition for a general basic method is the order of this splitting (McLachlan,
        SIAM J. Sci. Comput. 16 (1995) 151).
        """
        steps: list[tuple[int, Element]] = []
        for x, y in zip(self.alpha, self.beta, strict=True):
            for part, step in ((1, y), (0, y), (0, x), (1, x)):
                if steps and steps[-1][0] == part:
                    step = steps.pop()[1] + step
                steps.append((part, step))
        return Splitting(("A", "B"), tuple(steps))


MOST_WORDS = 10_000
"""The exponents of a Magnus method are expanded into sums of products only if the estimated number of
products is at most this number."""


@dataclass(frozen=True)
class Magnus:
    """A Magnus method for Y' = A(t) Y: a product of exponentials. Let A_i = h A(c_i h), where h is the step
    size and c_i are the nodes. Each exponent is a linear combination of the A_i and their brackets. With the
    Cayley transform, products of the A_i are also allowed.

    The exponential of the first entry of ``exponents`` acts first. ``elements`` contains named Lie elements.
    ``transform`` is ``"exp"``, or ``"cay"`` for the Cayley transform cay(x) = (1 - x/2)^-1 (1 + x/2).

    >>> from orderconds.ring import QQ
    >>> Magnus((QQ.rational(1, 2),), (((0, QQ.one),),)).is_commutator_free(QQ)
    True
    """

    c: Row
    exponents: tuple[Combination, ...]
    elements: tuple[tuple[str, Combination], ...] = ()
    transform: str = "exp"

    @property
    def s(self) -> int:
        """The number of nodes."""
        return len(self.c)

    def map(self, convert: Convert) -> Magnus:
        """Return a copy of the method in which ``convert`` is applied to every coefficient."""

        def converted(combination: Combination) -> Combination:
            return tuple((term, convert(x)) for term, x in combination)

        return Magnus(
            tuple(convert(x) for x in self.c),
            tuple(map(converted, self.exponents)),
            tuple((name, converted(combination)) for name, combination in self.elements),
            self.transform,
        )

    def words(self, ring: Ring) -> tuple[NodeSeries, ...]:
        """Expand the exponents into sums of products of the A_i, where A_i = h A(c_i h).

        A product is represented by the tuple of its node indices, counted from 0. The last index belongs to
        the left factor: (i, j) denotes A_j A_i.
        """
        named: dict[str, NodeSeries] = {}
        for name, combination in self.elements:
            named[name] = expand(combination, named, ring)
        return tuple(expand(combination, named, ring) for combination in self.exponents)

    def extents(self) -> tuple[tuple[int, int], ...]:
        """Return a pair (m, n) for each exponent. The expanded exponent is a sum of products of the matrices
        A_i = h A(c_i h). Each product has at least m and at most n factors."""
        extent = extents(dict(self.elements))
        return tuple(extent_of_sum(combination, extent) for combination in self.exponents)

    def is_expandable(self) -> bool:
        """Return True if the estimated number of products in the expansion of all exponents is at most
        :data:`MOST_WORDS`. If the products in an expanded exponent have at most m factors A_i, the estimate
        for this exponent is s^m, where s is the number of nodes."""
        words = [self.s**most for _, most in self.extents()]
        return int(sum(words)) <= MOST_WORDS

    def is_commutator_free(self, ring: Ring) -> bool:
        """Return True if the expansion of every exponent is a linear combination of the matrices A_i = h
        A(c_i h). Return False if an expansion contains a product of these matrices, or if the expansions are
        too long (:meth:`is_expandable`)."""
        if not self.is_expandable():
            return False
        return all(len(word) == 1 for series in self.words(ring) for word in series)


Method = (
    RungeKutta
    | PartitionedRungeKutta
    | CommutatorFree
    | Composition
    | AdjointComposition
    | Splitting
    | Magnus
)
"""The types of methods that a tableau may contain."""
