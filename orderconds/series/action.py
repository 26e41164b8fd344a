"""The action series of a variational Lie group method: one coefficient for every action tree, in any ring.

Let q0 be the initial position and mu1 the final momentum of a step. The velocity and the momentum of each
stage are expanded about (q0, mu1). The expansions are sums over trees
(:mod:`orderconds.series.action_trees`). Let u, v and w be words of trees, and let M be a multiset of trees.
The trees of the velocities have the form t = (w, M). The trees of the momenta have the forms H(u*v|M) and
L(w). The symbol * separates the words u and v. Let b_i be the weight of stage i, and let xi_i be the
velocity of stage i. Let Phi_w(i) be the coefficient of the word w in the group element of stage i. Let
tau_t(i) be the coefficient of the tree t in the velocity of stage i. Let psi_p(i) be the coefficient of the
tree p in the momentum of stage i.

The coefficient of a tree t = (w, M) is ``tau_t(i) = Phi_w(i) prod_{p in M} psi_p(i)``.

The update is the group element that takes q0 to the final position. The formulas for psi_p(i) contain
coefficients of words with a new letter x. The velocity xi_i is a linear combination of trees. The letter x is
added to xi_i, and the velocities of all other stages remain unchanged. The expansions of the group elements
of the stages and of the update then contain words with the letter x.

- For a tree p = H(u*v|M), let z_ij be the coefficient of the word (u, x, v) in the group element of stage
  j. Then ``psi_p(i) = (1/b_i) sum_j b_j z_ij prod_{q in M} psi_q(j)``.
- For a tree p = L(w), let d_i be the coefficient of the word (x, reverse(w)) in the update. Then
  ``psi_p(i) = d_i/b_i``.

Let e_t be the coefficient of the tree t in the exact flow. The order condition of t is the equation
``sum_i b_i tau_t(i) = e_t``.
A method has order n if and only if the conditions of all trees t = (w, M) with at most n vertices hold.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from math import factorial

from orderconds.ring.protocol import Element, Ring
from orderconds.series.action_enumeration import words
from orderconds.series.action_trees import Force, Momenta, Momentum, Velocity, Word

Stages = list[Element]
"""A vector with one ring element for each stage of the method."""

Exponential = tuple[tuple[int, Element], ...]
"""The exponent of one exponential: a linear combination of the stage velocities, stored as pairs
(stage, coefficient). Pairs with the coefficient zero are omitted."""

Row = tuple[Exponential, ...]
"""A group element that is a product of exponentials. The first exponential in the tuple acts first."""


class ActionSeries(ABC):
    """The action series of one method, with coefficients in ``ring``.

    The weights b_i must be invertible in ``ring``. An index ``row`` denotes a group element: 0, ..., s - 1
    for the s stages, and s for the update.

    The example computes coefficients of the implicit midpoint rule.

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_trees import force, velocity
    >>> series = CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, [[QQ.rational(1, 2)]], [QQ.one]))
    >>> series.tau(velocity((velocity(),))), series.psi(force())
    ([1/2], [1/2])
    """

    def __init__(self, ring: Ring, weights: Sequence[Element]) -> None:
        self.ring, self.weights, self.stages = ring, tuple(weights), len(weights)
        self.reciprocals = tuple(ring.one / b for b in weights)
        self._tau: dict[Velocity, Stages] = {}
        self._psi: dict[Momentum, Stages] = {}
        self._products: dict[Momenta, Stages] = {(): [ring.one] * self.stages}
        self._insertions: dict[tuple[Word, Word], list[Stages]] = {}

    @abstractmethod
    def coefficient(self, row: int, word: Word) -> Element:
        """Return the coefficient of a word in the group element with index ``row``. The class docstring
        defines this index."""

    @abstractmethod
    def insertion(self, row: int, stage: int, before: Word, after: Word) -> Element:
        """The letters of words are trees. The velocity xi of stage ``stage`` is a linear combination of
        letters. Replace xi by xi + x, where x is an additional letter. Then expand the group element with
        index ``row`` (0, ..., s - 1 for the s stages, and s for the update). Return the coefficient of the
        word that consists of the letters ``before``, the letter x, and the letters ``after``."""

    def stage_coefficients(self, word: Word) -> Stages:
        """Return the coefficient of ``word`` in the group element of each stage."""
        return [self.coefficient(i, word) for i in range(self.stages)]

    def tau(self, tree: Velocity) -> Stages:
        """Return the vector with the entry tau_t(i) for each stage i, where t is ``tree``. The number
        tau_t(i) is the coefficient of the tree t in the expansion of the velocity of stage i."""
        values = self._tau.get(tree)
        if values is None:
            values = self._tau[tree] = self._velocity(tree)
        return values

    def _velocity(self, tree: Velocity) -> Stages:
        factors = self.psi_product(tree.momenta)
        if not tree.word:
            return factors
        phi = self.stage_coefficients(tree.word)
        return [a * b for a, b in zip(phi, factors, strict=True)] if tree.momenta else phi

    def psi(self, tree: Momentum) -> Stages:
        """Return the vector with the entry psi_p(i) for each stage i, where p is ``tree``. The number
        psi_p(i) is the coefficient of the tree p in the expansion of the momentum of stage i."""
        values = self._psi.get(tree)
        if values is None:
            values = self._psi[tree] = (
                self._force(tree) if isinstance(tree, Force) else self._transport(tree.word)
            )
        return values

    def psi_product(self, momenta: Momenta) -> Stages:
        """Return one number for each stage i: the product of psi_p(i) (see :meth:`psi`) over all trees p in
        ``momenta``."""
        values = self._products.get(momenta)
        if values is None:
            rest, last = self.psi_product(momenta[:-1]), self.psi(momenta[-1])
            values = [a * b for a, b in zip(rest, last, strict=True)] if momenta[:-1] else last
            self._products[momenta] = values
        return values

    def _force(self, tree: Force) -> Stages:
        inserted = self.stage_insertions(tree.before, tree.after)
        scaled = [b * m for b, m in zip(self.weights, self.psi_product(tree.momenta), strict=True)]
        return [
            self.reciprocals[i] * self._sum(a * row[i] for a, row in zip(scaled, inserted, strict=True))
            for i in range(self.stages)
        ]

    def stage_insertions(self, before: Word, after: Word) -> list[Stages]:
        """Return a matrix with one row and one column for each stage. Entry [j][i] is
        ``insertion(j, i, before, after)``, see :meth:`insertion`."""
        values = self._insertions.get((before, after))
        if values is None:
            values = self._insertions[before, after] = self._stage_insertions(before, after)
        return values

    def _stage_insertions(self, before: Word, after: Word) -> list[Stages]:
        every = range(self.stages)
        return [[self.insertion(j, i, before, after) for i in every] for j in every]

    def _transport(self, word: Word) -> Stages:
        backwards = word[::-1]
        return [
            self.reciprocals[i] * self.insertion(self.stages, i, (), backwards) for i in range(self.stages)
        ]

    def _sum(self, terms: Iterable[Element]) -> Element:
        total = self.ring.zero
        for term in terms:
            total = total + term
        return total

    def condition(self, tree: Velocity) -> Element:
        """Return the left-hand side sum_i b_i tau_t(i) of the order condition of a tree t (module docstring).

        The left-hand side is the coefficient of t in the update. To save memory, this method does not cache
        the coefficients tau_t(i).
        """
        known = self._tau.get(tree)
        values = self._velocity(tree) if known is None else known
        return self._sum(b * v for b, v in zip(self.weights, values, strict=True))

    def update_words(self, vertices: int) -> dict[Word, Element]:
        """Let q0 be the position before the step, q1 the position after the step, and mu1 the momentum after
        the step. Each tree t denotes a function of position and momentum with values in g
        (:mod:`orderconds.series.action_trees`). Insert the position q0 and the momentum mu1 into this
        function, and divide the value by the order of the symmetry group of t. The result is a vector in g.
        This vector defines a right-invariant vector field ``F(t)`` on the group.

        For each smooth function f on the group, f(q1) is the sum of
        ``coefficient(w) (F(t_1) ... F(t_k) f)(q0)`` over all words ``w = t_1 ... t_k`` of trees. Return a map
        from w to ``coefficient(w)``. The map contains all words with at most ``vertices`` vertices in total.
        """
        return {word: self.coefficient(self.stages, word) for n in range(vertices + 1) for word in words(n)}


class CommutatorFreeSeries(ActionSeries):
    """The action series of a method whose stages and update are products of exponentials.

    ``rows`` contains the exponentials of each stage, followed by the exponentials of the update. An exponent
    is a linear combination of the stage velocities xi_1, xi_2, .... The weight b_i is the sum of the
    coefficients of xi_i in the exponents of the update (Bogfjellmo and Marthinsen, equation (3.18)).

    >>> from orderconds.ring import QQ
    >>> from orderconds.series.action_enumeration import velocities
    >>> midpoint = CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, [[QQ.rational(1, 2)]], [QQ.one]))
    >>> [str(midpoint.condition(tree)) for tree in velocities(2)]  # o(o), o(|f(*)), o(|L(o))
    ['1/2', '1/2', '1/2']
    """

    def __init__(self, ring: Ring, rows: Sequence[Row]) -> None:
        update = rows[-1]
        weights = [ring.zero] * (len(rows) - 1)
        for exponential in update:
            for stage, value in exponential:
                weights[stage] = weights[stage] + value
        super().__init__(ring, weights)
        self.rows = tuple(rows)
        self._prefix: list[dict[Word, Stages]] = [{} for _ in rows]
        self._suffix: list[dict[Word, Stages]] = [{} for _ in rows]
        self._inverse_factorial = [ring.one]

    def coefficient(self, row: int, word: Word) -> Element:
        """Return the coefficient of the word t_1 ... t_k in the group element with index ``row``.

        Let phi_J(t) be the coefficient of the letter t in the exponent of exponential J. The coefficient of
        the word is a sum over all sequences J_1 <= ... <= J_k of indices of exponentials. Each sequence gives
        the term ``prod_l phi_{J_l}(t_l) / prod_J n_J!``, where n_J counts how often J occurs in the sequence.
        """
        return self._before(row, word)[-1]

    def insertion(self, row: int, stage: int, before: Word, after: Word) -> Element:
        """Replace the velocity xi of stage ``stage`` by xi + x, where x is an additional letter. Then the
        series of the group element with index ``row`` contains words with the letter x. Return the
        coefficient of the word that consists of the letters ``before``, the letter x, and the letters
        ``after``. See also :meth:`ActionSeries.insertion`."""
        total = self.ring.zero
        for place, exponential in enumerate(self.rows[row]):
            for varied, value in exponential:
                if varied == stage:
                    total = total + value * self._through(row, place, before, after)
        return total

    def _through(self, row: int, place: int, before: Word, after: Word) -> Element:
        """Let Z be the exponent ``self.rows[row][place]``. Replace Z by Z + x, where x is an additional
        letter. Return the coefficient of the word (``before``, x, ``after``) in the product of the
        exponentials of ``self.rows[row]``.

        The coefficient is a sum over all j and k. For each summand, split ``before`` into a word u and its
        last j letters, and split ``after`` into its first k letters and a word v. The word u comes from the
        exponentials with indices less than ``place``. The j letters, x and the k letters come from the term
        Z^j x Z^k / (j + k + 1)! of exp(Z + x). The word v comes from the exponentials with indices greater
        than ``place``.
        """
        exponential, length = self.rows[row][place], len(before)
        left, run = [], self.ring.one
        for r in range(length + 1):
            left.append(run * self._before(row, before[: length - r])[place])
            if r < length:
                run = run * self._exponent(exponential, before[length - 1 - r])
        right, run = [], self.ring.one
        for r in range(len(after) + 1):
            right.append(run * self._after(row, after[r:])[place + 1])
            if r < len(after):
                run = run * self._exponent(exponential, after[r])
        return self._sum(
            a * b * self._reciprocal(j + 1 + k) if j + k else a * b
            for j, a in enumerate(left)
            for k, b in enumerate(right)
        )

    def _exponent(self, exponential: Exponential, tree: Velocity) -> Element:
        values = self.tau(tree)
        return self._sum(value * values[stage] for stage, value in exponential)

    def _reciprocal(self, n: int) -> Element:
        while len(self._inverse_factorial) <= n:
            self._inverse_factorial.append(self.ring.rational(1, factorial(len(self._inverse_factorial))))
        return self._inverse_factorial[n]

    def _before(self, row: int, word: Word) -> Stages:
        """Return a list. Entry k of the list is the coefficient of ``word`` in the product of the first k
        exponentials in ``self.rows[row]``."""
        known = self._prefix[row].get(word)
        if known is not None:
            return known
        exponentials = self.rows[row]
        if not word:
            values = [self.ring.one] * (len(exponentials) + 1)
        else:
            shorter = [self._before(row, word[:k]) for k in range(len(word))]
            values = [self.ring.zero]
            for place, exponential in enumerate(exponentials):
                total, run = values[place], self.ring.one
                for r in range(1, len(word) + 1):
                    run = run * self._exponent(exponential, word[-r])
                    term = run * shorter[-r][place]
                    total = total + (term * self._reciprocal(r) if r > 1 else term)
                values.append(total)
        self._prefix[row][word] = values
        return values

    def _after(self, row: int, word: Word) -> Stages:
        """Return a list. Let E_1, ..., E_n be the exponentials in ``self.rows[row]``. Entry k of the list is
        the coefficient of ``word`` in the product of the exponentials E_(k+1), ..., E_n. The index k runs
        from 0 to n. If k is n, the product has no factors, and is 1."""
        known = self._suffix[row].get(word)
        if known is not None:
            return known
        exponentials = self.rows[row]
        if not word:
            values = [self.ring.one] * (len(exponentials) + 1)
        else:
            shorter = [self._after(row, word[k:]) for k in range(1, len(word) + 1)]
            values = [self.ring.zero]
            for place in reversed(range(len(exponentials))):
                total, run = values[-1], self.ring.one
                for r in range(1, len(word) + 1):
                    run = run * self._exponent(exponentials[place], word[r - 1])
                    term = run * shorter[r - 1][place + 1]
                    total = total + (term * self._reciprocal(r) if r > 1 else term)
                values.append(total)
            values.reverse()
        self._suffix[row][word] = values
        return values


def crouch_grossman_rows(ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element]) -> tuple[Row, ...]:
    """Return the exponentials of a variational Crouch-Grossman method (the family ``vcg``) with the Butcher
    tableau (A, b): one tuple for each stage, followed by a tuple for the update. Each non-zero entry of A and
    b gives one exponential.

    >>> from orderconds.ring import QQ
    >>> crouch_grossman_rows(QQ, [[QQ.zero, QQ.zero], [QQ.one, QQ.zero]], [QQ.one, QQ.one])
    ((), (((0, 1),),), (((0, 1),), ((1, 1),)))
    """
    return tuple(
        tuple(((j, a),) for j, a in enumerate(row) if ring.is_zero(a) is not True) for row in (*A, b)
    )
