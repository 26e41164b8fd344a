"""Evaluation of action trees for a given Hamiltonian H(q, mu), and the local error of a method. Each action
tree denotes a vector in the Lie algebra g or a covector in its dual g*
(:mod:`orderconds.series.action_trees`).

A derivative of H along k directions is computed exactly, by automatic differentiation. Let eps_1, ..., eps_k
be formal variables with eps_i^2 = 0, as in dual numbers. The point (q, mu) is moved by eps_i along each
direction i. The derivative is the coefficient of eps_1 ... eps_k in the value of H at the new point. H must
be a polynomial in the entries of the matrix q and the coordinates of mu.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from orderconds.ring.protocol import Element, Ring
from orderconds.series.action_trees import Force, Momentum, Velocity, Word

Coordinates = tuple[Element, ...]
"""Coordinates of a vector in the chosen basis of g, or of a covector in the dual basis."""

Matrix = tuple[tuple[Element, ...], ...]


class Nilpotent:
    """A polynomial in eps_1, eps_2, ..., where eps_k^2 = 0. ``parts`` maps bit masks to coefficients. A bit
    mask represents a product of variables: the mask 1 represents eps_1, 2 represents eps_2, 3 represents
    eps_1 eps_2, and 0 represents the constant term.

    >>> eps = Nilpotent({1: 1})
    >>> ((3 + eps) * (3 + eps)).parts
    {1: 6, 0: 9}
    """

    __slots__ = ("parts",)

    def __init__(self, parts: Mapping[int, Element]) -> None:
        self.parts = dict(parts)

    def __add__(self, other: Element) -> Nilpotent:
        parts = dict(self.parts)
        for mask, value in _parts(other).items():
            parts[mask] = parts[mask] + value if mask in parts else value
        return Nilpotent(parts)

    __radd__ = __add__

    def __neg__(self) -> Nilpotent:
        return Nilpotent({mask: -value for mask, value in self.parts.items()})

    def __sub__(self, other: Element) -> Nilpotent:
        return self + Nilpotent({mask: -value for mask, value in _parts(other).items()})

    def __rsub__(self, other: Element) -> Nilpotent:
        return (-self).__add__(other)

    def __mul__(self, other: Element) -> Nilpotent:
        parts: dict[int, Element] = {}
        for left, a in self.parts.items():
            for right, b in _parts(other).items():
                if not left & right:
                    term = a * b
                    parts[left | right] = parts[left | right] + term if left | right in parts else term
        return Nilpotent(parts)

    __rmul__ = __mul__


def _parts(x: Element) -> dict[int, Element]:
    return x.parts if isinstance(x, Nilpotent) else {0: x}


class ActionFields:
    """The values of action trees for one Hamiltonian at one point (q, mu). The value of a g-valued tree t is
    a vector xi_t in g, the elementary velocity. The value of a g*-valued tree p is a covector m_p.

    - ``hamiltonian(q, mu)``: a function of a matrix (a tuple of rows) and of the coordinates of mu. The
      function must use only the operations ``+``, ``-`` and ``*``.
    - ``basis``: the matrices of a basis of the Lie algebra. The coordinates of mu refer to the dual basis.
    - ``coordinates``: a function that converts a matrix in the Lie algebra to coordinates.

    The vectors xi_t and the covectors m_p contain neither powers of the step size h nor symmetry factors.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_trees import force, velocity
    >>> one, zero = QQ.one, QQ.zero
    >>> fields = ActionFields(  # R^1 as matrices (1, q; 0, 1), H = mu^3 + q^2 at q = 2, mu = 5
    ...     QQ, lambda q, mu: mu[0] * mu[0] * mu[0] + q[0][1] * q[0][1], ((one, 2 * one), (zero, one)),
    ...     (5 * one,), [((zero, one), (zero, zero))], lambda m: (m[0][1],),
    ... )
    >>> fields.velocity(velocity()), fields.covector(force()), fields.velocity(velocity((), (force(),)))
    ((75,), (4,), (120,))
    """

    def __init__(
        self,
        ring: Ring,
        hamiltonian: Callable[[Matrix, Coordinates], Element],
        q: Matrix,
        mu: Coordinates,
        basis: Sequence[Matrix],
        coordinates: Callable[[Matrix], Coordinates],
    ) -> None:
        self.ring, self.hamiltonian, self.q, self.mu = ring, hamiltonian, q, mu
        self.basis, self.coordinates = tuple(basis), coordinates
        self.units: tuple[Coordinates, ...] = tuple(
            tuple(ring.one if a == b else ring.zero for b in range(len(basis))) for a in range(len(basis))
        )
        self._velocity: dict[Velocity, Coordinates] = {}
        self._covector: dict[Momentum, Coordinates] = {}

    def derivative(self, fields: Sequence[Coordinates], covectors: Sequence[Coordinates]) -> Element:
        """Return the mixed derivative of the Hamiltonian H(q, mu). The derivatives in q are taken along the
        right-invariant ``fields``, and the derivatives in mu along ``covectors``."""
        q: Matrix = self.q
        mask = 1
        for field in fields:
            q = _add(q, _times(_scaled(self.matrix(field), mask), q))
            mask <<= 1
        mu: list[Element] = list(self.mu)
        for covector in covectors:
            mu = [m + Nilpotent({mask: x}) for m, x in zip(mu, covector, strict=True)]
            mask <<= 1
        value: Element = _parts(self.hamiltonian(q, tuple(mu))).get(mask - 1, self.ring.zero)
        return value

    def matrix(self, field: Coordinates) -> Matrix:
        """Return the matrix of the Lie algebra element that has the coordinates ``field``."""
        size = range(len(self.q))
        return tuple(
            tuple(
                sum((x * e[i][j] for x, e in zip(field, self.basis, strict=True)), self.ring.zero)
                for j in size
            )
            for i in size
        )

    def bracket(self, x: Coordinates, y: Coordinates) -> Coordinates:
        """Return the coordinates of [x, y] = xy - yx."""
        X, Y = self.matrix(x), self.matrix(y)
        return self.coordinates(_subtract(_times(X, Y), _times(Y, X)))

    def velocity(self, tree: Velocity) -> Coordinates:
        """Return the coordinates of the Lie algebra element that ``tree`` denotes
        (:mod:`orderconds.series.action_trees`)."""
        components = self._velocity.get(tree)
        if components is None:
            fields = [self.velocity(t) for t in tree.word]
            covectors = [self.covector(p) for p in tree.momenta]
            components = tuple(self.derivative(fields, [*covectors, unit]) for unit in self.units)
            self._velocity[tree] = components
        return components

    def covector(self, tree: Momentum) -> Coordinates:
        """Return the coordinates of the covector that ``tree`` denotes
        (:mod:`orderconds.series.action_trees`)."""
        components = self._covector.get(tree)
        if components is None:
            if isinstance(tree, Force):
                before, after = ([self.velocity(t) for t in word] for word in (tree.before, tree.after))
                covectors = [self.covector(p) for p in tree.momenta]
                components = tuple(self.derivative([*before, unit, *after], covectors) for unit in self.units)
            else:
                components = self.transported(tree.word)
            self._covector[tree] = components
        return components

    def transported(self, word: Word) -> Coordinates:
        """Return the coordinates of the covector that maps x to ``<self.mu, ad xi_1 ... ad xi_k x>``. The
        vector xi_i is the elementary velocity of letter i of the word."""
        values = []
        for unit in self.units:
            x = unit
            for letter in reversed(word):
                x = self.bracket(self.velocity(letter), x)
            values.append(sum((m * v for m, v in zip(self.mu, x, strict=True)), self.ring.zero))
        return tuple(values)

    def local_error(self, defects: Mapping[Word, Element]) -> tuple[Matrix, Coordinates]:
        """Return the coefficients of h^(p+1) in the local errors of position and momentum, for a method of
        order p with the step size h.

        The results are a matrix and the coordinates of a covector. ``defects`` maps each word to a
        difference: the coefficient of the word in the update minus the coefficient of the word in the exact
        flow. ``defects`` contains every word whose trees together have p + 1 vertices. Words whose trees
        together have at most p vertices must be missing or have the value zero.
        """
        zero = self.ring.zero
        point: Matrix = tuple(tuple(zero for _ in self.q) for _ in self.q)
        momentum = [zero] * len(self.basis)
        for word, defect in defects.items():
            if self.ring.is_zero(defect) is True:
                continue
            weight = defect
            moved = self.q
            for letter in word:
                weight = weight * self.ring.rational(1, letter.symmetry)
                moved = _times(self.matrix(self.velocity(letter)), moved)
            point = _add(point, tuple(tuple(weight * x for x in row) for row in moved))
            change = self.transported(word[::-1])
            if len(word) == 1:
                change = tuple(x + y for x, y in zip(change, self._impulse(word[0]), strict=True))
            # The local error of the momentum is the final momentum of the method minus the exact final
            # momentum. The leading coefficient of this local error is the sum of ``-weight * change`` over
            # all words.
            momentum = [m - weight * x for m, x in zip(momentum, change, strict=True)]
        return point, tuple(momentum)

    def _impulse(self, tree: Velocity) -> Coordinates:
        fields = [self.velocity(t) for t in tree.word]
        covectors = [self.covector(p) for p in tree.momenta]
        return tuple(self.derivative([unit, *fields], covectors) for unit in self.units)


def _scaled(matrix: Matrix, mask: int) -> Matrix:
    return tuple(tuple(Nilpotent({mask: x}) for x in row) for row in matrix)


def _add(a: Matrix, b: Matrix) -> Matrix:
    return tuple(tuple(x + y for x, y in zip(r, s, strict=True)) for r, s in zip(a, b, strict=True))


def _subtract(a: Matrix, b: Matrix) -> Matrix:
    return tuple(tuple(x - y for x, y in zip(r, s, strict=True)) for r, s in zip(a, b, strict=True))


def _times(a: Matrix, b: Matrix) -> Matrix:
    columns = list(zip(*b, strict=True))
    return tuple(tuple(_dot(row, column) for column in columns) for row in a)


def _dot(row: Sequence[Element], column: Sequence[Element]) -> Element:
    terms = [x * y for x, y in zip(row, column, strict=True)]
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total
