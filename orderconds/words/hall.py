"""Hall bases of free Lie algebras, and the rewriting of brackets in these bases.

The weight of a letter is a positive integer. The weight of a bracket is the sum of the weights of its
letters. Basis elements are ordered by weight. Among basis elements of equal weight, the letters come first.
The brackets [x, y] follow, ordered by x and then by y.

All letters are basis elements. Let x and y be basis elements with x < y. If y is a letter, then [x, y] is a
basis element. If y is a bracket [u, v] with u <= x, then [x, y] is a basis element (M. Hall, Proc. AMS 1
(1950) 575; Bourbaki, Lie Groups and Lie Algebras, II.2.11).
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from fractions import Fraction

from orderconds.words.lie import Bracket, lyndon_coordinates, standard_bracketing
from orderconds.words.shuffle import Letter, Word

Coordinates = dict[Bracket, Fraction]


class HallBasis:
    """The Hall basis of the free Lie algebra on ``letters``, up to the weight ``weight``.

    ``letters`` are in ascending order. ``weigh`` returns the weight of a letter, a positive integer.

    >>> HallBasis("AB", 4).of_weight(4)
    (('A', ('A', ('A', 'B'))), ('B', ('A', ('A', 'B'))), ('B', ('B', ('A', 'B'))))
    >>> [len(HallBasis((1, 2, 3), 5, weigh=int).of_weight(n)) for n in (1, 2, 3, 4, 5)]
    [1, 1, 2, 2, 4]
    """

    def __init__(
        self, letters: Sequence[Hashable], weight: int, weigh: Callable[[Letter], int] = lambda letter: 1
    ) -> None:
        if any(weigh(letter) < 1 for letter in letters):
            raise ValueError("every letter must have a positive weight")
        self.letters, self.weight, self._weigh = tuple(letters), weight, weigh
        self._place: dict[Bracket, int] = {}
        self._of_weight: list[tuple[Bracket, ...]] = [()]
        for n in range(1, weight + 1):
            candidates = [letter for letter in letters if weigh(letter) == n]
            for m in range(1, n // 2 + 1):
                pairs = ((x, y) for x in self._of_weight[m] for y in self._of_weight[n - m])
                candidates += [pair for pair in pairs if self._place[pair[0]] < self._place[pair[1]]]
            kept = tuple(x for x in candidates if self._belongs(x))
            self._place |= {x: len(self._place) + k for k, x in enumerate(kept)}
            self._of_weight.append(kept)
        self._known: dict[tuple[Bracket, Bracket], Coordinates] = {}

    def of_weight(self, n: int) -> tuple[Bracket, ...]:
        """Return the basis elements of weight n, in ascending order. The pair (x, y) denotes the bracket
        [x, y]."""
        return self._of_weight[n]

    def rewrite(self, bracket: Bracket) -> Coordinates:
        """Return the coordinates of ``bracket`` with respect to the Hall basis.

        Raises :class:`ValueError` if the weight of the bracket exceeds the largest weight of the basis.

        >>> HallBasis("AB", 3).rewrite((("A", "B"), "A"))
        {('A', ('A', 'B')): Fraction(-1, 1)}
        """
        if self._weight(bracket) > self.weight:
            raise ValueError(f"the weight of the bracket is above {self.weight}")
        if bracket in self._place:
            return {bracket: Fraction(1)}
        return self._bracket(self.rewrite(bracket[0]), self.rewrite(bracket[1]))

    def coordinates(self, element: Mapping[Word, Fraction]) -> Coordinates:
        """Return the coordinates of a Lie element. The Lie element is given as a map from words to
        coefficients. A word denotes the product of its letters in the written order.

        Raises :class:`ValueError` if ``element`` is not a Lie element.

        >>> HallBasis("AB", 2).coordinates({("A", "B"): Fraction(1, 2), ("B", "A"): Fraction(-1, 2)})
        {('A', 'B'): Fraction(1, 2)}
        """
        order = {letter: place for place, letter in enumerate(self.letters)}
        return self.from_lyndon(lyndon_coordinates(element, order.__getitem__))

    def from_lyndon(self, coordinates: Mapping[Word, Fraction]) -> Coordinates:
        """Convert coordinates of a Lie element from the Lyndon basis to the Hall basis.

        >>> from orderconds.words.bch import bch
        >>> {str(x): str(value) for x, value in HallBasis("AB", 2).from_lyndon(bch(2)).items()}
        {'A': '1', 'B': '1', "('A', 'B')": '1/2'}
        """
        order = {letter: place for place, letter in enumerate(self.letters)}
        result: Coordinates = {}
        for word, value in coordinates.items():
            _add(result, value, self.rewrite(standard_bracketing(word, order.__getitem__)))
        return {x: result[x] for x in sorted(result, key=self._place.__getitem__) if result[x]}

    def _weight(self, x: Bracket) -> int:
        return sum(map(self._weight, x)) if isinstance(x, tuple) else self._weigh(x)

    def _belongs(self, x: Bracket) -> bool:
        if not isinstance(x, tuple):
            return True
        low, high = x
        return not isinstance(high, tuple) or self._place[high[0]] <= self._place[low]

    def _bracket(self, x: Coordinates, y: Coordinates) -> Coordinates:
        result: Coordinates = {}
        for u, a in x.items():
            for v, b in y.items():
                _add(result, a * b, self._pair(u, v))
        return {z: value for z, value in result.items() if value}

    def _pair(self, x: Bracket, y: Bracket) -> Coordinates:
        """Return the coordinates of [x, y] for two basis elements x and y."""
        if x == y:
            return {}
        if self._place[x] > self._place[y]:
            return {z: -value for z, value in self._pair(y, x).items()}
        if (x, y) in self._place:
            return {(x, y): Fraction(1)}
        if (x, y) not in self._known:
            # Here x < u < v. Jacobi's identity gives [x, [u, v]] = [[x, u], v] + [u, [x, v]].
            u, v = y
            result = self._bracket(self._pair(x, u), {v: Fraction(1)})
            _add(result, Fraction(1), self._bracket({u: Fraction(1)}, self._pair(x, v)))
            self._known[x, y] = {z: value for z, value in result.items() if value}
        return self._known[x, y]


def _add(result: Coordinates, scale: Fraction, x: Coordinates) -> None:
    for z, value in x.items():
        result[z] = result.get(z, Fraction(0)) + scale * value
