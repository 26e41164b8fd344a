"""The action series of the exact flow.

The formulas for numerical methods are given in :mod:`orderconds.series.action`. The formulas for the exact
flow have a time s in place of the index i of a stage, and integrals over times in place of sums over stages.
The functions :func:`tau` and :func:`psi` return ``tau_t(s)`` and ``psi_p(s)`` as polynomials in s, with
rational coefficients. There are two kinds of trees p (:mod:`orderconds.series.action_trees`). The tree
H(u*v|M) consists of two words u and v of trees and a multiset M of trees. The tree L(w) consists of one word
w of trees. Let w be a word with the letters t_1, ..., t_k:

- ``Phi_w(s)`` is the integral of the product ``tau_{t_1}(s_1) ... tau_{t_k}(s_k)`` over all times with 0 <=
  s_1 <= ... <= s_k <= s. The integral ``Phi_w(s, s')`` has the same integrand, and the times satisfy
  s <= s_1 <= ... <= s_k <= s'.
- ``psi_{L(w)}(s)`` is the integral of the same product over all times with 1 >= s_1 >= ... >= s_k >= s.
- Let ``g(s')`` be the product of ``psi_m(s')`` over all trees m in M. Then ``psi_{H(u*v|M)}(s)`` is the
  integral of the product ``Phi_u(s) Phi_v(s, s') g(s')`` over the times s' from s to 1.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache

from orderconds.ring.univariate import (
    ONE,
    ZERO,
    UnivariatePolynomial,
    integral_from_zero,
    integral_to_one,
    value_at_one,
)
from orderconds.series.action_enumeration import words
from orderconds.series.action_trees import Force, Momenta, Momentum, Velocity, Word


@cache
def tau(tree: Velocity) -> UnivariatePolynomial:
    """Return the polynomial tau_t(s) for t = ``tree``. It is the coefficient of t in the expansion of the
    exact velocity at time s. The example shows s as x. The module :mod:`orderconds.series.action_trees`
    defines the notation of trees.

    >>> from orderconds.series.action_enumeration import velocities
    >>> [str(tau(t)) for t in velocities(2)]  # o(o), o(|f(*)), o(|L(o))
    ['x', '(-1)*x + 1', '(-1)*x + 1']
    """
    return phi(tree.word) * psi_product(tree.momenta)


@cache
def phi(word: Word) -> UnivariatePolynomial:
    """Return the polynomial Phi_w(s) for w = ``word``. The module docstring defines it. The output of the
    example shows s as x.

    >>> from orderconds.series.action_trees import velocity
    >>> phi((velocity(), velocity()))
    1/2*x^2
    """
    return integral_from_zero(phi(word[:-1]) * tau(word[-1])) if word else ONE


@cache
def psi(tree: Momentum) -> UnivariatePolynomial:
    """Return the polynomial psi_p(s) for p = ``tree``. It is the coefficient of p in the expansion of the
    exact momentum at time s. The example shows s as x.

    >>> from orderconds.series.action_trees import force, velocity
    >>> psi(force()), psi(force((velocity(),)))
    ((-1)*x + 1, (-1)*x^2 + x)
    """
    if not isinstance(tree, Force):
        return _transport(tree.word)
    # Chen's identity expresses Phi_v(s, s') in terms of integrals that start at 0.
    total, after = ZERO, tree.after
    for k in range(len(after) + 1):
        term = phi(after[:k][::-1]) * _later(after[k:], tree.momenta)
        total = total - term if k % 2 else total + term
    return phi(tree.before) * total


@cache
def _transport(word: Word) -> UnivariatePolynomial:
    return integral_to_one(_transport(word[:-1]) * tau(word[-1])) if word else ONE


@cache
def _later(word: Word, momenta: Momenta) -> UnivariatePolynomial:
    return integral_to_one(psi_product(momenta) * phi(word))


@cache
def psi_product(momenta: Momenta) -> UnivariatePolynomial:
    """Return the product of the polynomials psi_p(s) (:func:`psi`) over all trees p in the multiset
    ``momenta``.

    >>> from orderconds.series.action_trees import force
    >>> psi_product((force(), force()))
    x^2 + (-2)*x + 1
    """
    return psi_product(momenta[:-1]) * psi(momenta[-1]) if momenta else ONE


def condition(tree: Velocity) -> Fraction:
    """Return the right-hand side of the order condition of a tree t: the integral of the polynomial tau_t(s)
    (:func:`tau`) over 0 <= s <= 1.

    >>> from orderconds.series.action_enumeration import velocities
    >>> [str(condition(t)) for t in velocities(2)]
    ['1/2', '1/2', '1/2']
    """
    return update((tree,))


def update(word: Word) -> Fraction:
    """Return Phi_w(1) for w = ``word``. It is the coefficient of the word in the exact flow.

    >>> from orderconds.series.action_trees import velocity
    >>> print(update((velocity(), velocity(), velocity())))
    1/6
    """
    return value_at_one(phi(word))


def update_words(vertices: int) -> dict[Word, Fraction]:
    """Return a map from words of trees to the results of :func:`update`. The map contains all words with at
    most ``vertices`` vertices.

    >>> [(" ".join(map(str, word)), str(q)) for word, q in update_words(1).items()]
    [('', '1'), ('o', '1')]
    """
    return {word: update(word) for n in range(vertices + 1) for word in words(n)}
