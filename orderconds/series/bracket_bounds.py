"""A lower bound for the number of brackets, computed by linear algebra. The bound holds for every program
that computes given arguments u_1, ..., u_s and u of exponentials
(:class:`orderconds.series.brackets.BracketProgram`).

The letter q_j denotes a linear combination of the stage values k_1, ..., k_j. The argument u_i is computed
before the stage value k_i. Hence brackets in u_i contain only the letters q_1, ..., q_(i-1). For a fixed m <
i, call q_m, ..., q_(i-1) the new letters. Let N be the number of brackets with new letters in a program for
u_1, ..., u_i. In each argument, consider the sum of the terms whose words have two or more letters and
contain a new letter. Brackets without new letters, and single letters, contribute nothing to this sum.
Therefore N is at least the dimension of the space that these sums span.

The first bracket with new letters is [x + sum c_n q_n, y + sum d_n q_n], where x and y contain no new
letters. The sum of those terms of this bracket in which new letters occur once is sum_n ad_(P_n) q_n, where
all P_n = d_n x - c_n y are Lie elements. Form the same sum for each argument, and suppose that these sums
span a space of dimension d. Suppose also that zero is the only element of this space for which all P_n are
Lie elements. Then the sum for the first bracket is not in this space, and N is at least d + 1.

A bracket either contains new letters or contains no new letters. Hence the sum of a lower bound for the
brackets with new letters and a lower bound for the brackets without new letters is a lower bound for all
brackets.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from orderconds.ring.protocol import Element, Ring
from orderconds.series.graded import GradedAlgebra, Polynomial, Word, solve


def newest_factors(x: Mapping[Word, Element], first: int) -> dict[int, Polynomial]:
    """Return the factors P_n of a combination x of brackets, for all n >= ``first``.

    Consider the part of x whose words contain exactly one letter with an index of at least ``first``. This
    part is the sum over n of ad_(P_n) q_n. The words of this part that end in q_n determine P_n.

    >>> {n: {w: str(x) for w, x in p.items()} for n, p in newest_factors({(0, 1): 2, (1, 0): -2}, 1).items()}
    {1: {(0,): '2'}}
    """
    factors = dict[int, Polynomial]()
    for word, value in x.items():
        if len(word) > 1 and word[-1] >= first and all(letter < first for letter in word[:-1]):
            factors.setdefault(word[-1], {})[word[:-1]] = value
    return factors


def beyond_lie(algebra: GradedAlgebra, x: Mapping[Word, Element]) -> Polynomial:
    """Return the difference between x and a Lie element y that is computed from x. The result is zero if and
    only if x is a Lie element. The polynomial x must have no constant term.

    To compute y, each word of x is replaced by the right-normed bracket of its letters, divided by the number
    of letters. By Dynkin's theorem, y = x if x is a Lie element.

    >>> from orderconds.ring import QQ
    >>> algebra = GradedAlgebra(QQ, (1, 2), 3)
    >>> beyond_lie(algebra, algebra.bracket({(0,): QQ.one}, {(1,): QQ.one}))
    {}
    """
    ring, total = algebra.ring, dict[Word, Element]()
    for word, value in x.items():
        nested: Polynomial = {word[-1:]: ring.one}
        for letter in reversed(word[:-1]):
            nested = algebra.bracket({(letter,): ring.one}, nested)
        total = algebra.combine((ring.one, total), (value * ring.rational(1, len(word)), nested))
    return algebra.combine((ring.one, x), (ring.rational(-1), total))


def least_brackets(algebra: GradedAlgebra, arguments: Sequence[Mapping[Word, Element]]) -> int:
    """Return a lower bound for the number of brackets in every program that computes ``arguments``: u_1, ...,
    u_s for the stages and u for the step.

    Terms of the largest grade of the algebra are omitted in u_1, ..., u_s, but not in u.

    >>> from orderconds.ring import QQ
    >>> algebra, q = GradedAlgebra(QQ, (1, 2, 3), 6), [{(n,): QQ.one} for n in range(3)]
    >>> least_brackets(algebra, [{}, q[0], q[1], algebra.bracket(q[0], algebra.bracket(q[0], q[2]))])
    2
    """
    bounds, last = [0], len(arguments) - 1
    for i in range(1, len(arguments)):
        known = [algebra.cut(u, algebra.largest - 1) for u in arguments[: i + 1]]
        # In the arguments of stages, terms of the largest grade are omitted. Only the argument of the step is
        # also used with these terms.
        spans = [known[j:] for j in range(1, i + 1)] + ([[dict(arguments[i])]] if i == last else [])
        needed = (bounds[m] + max(_needed(algebra, span, m) for span in spans) for m in range(i))
        bounds.append(max(bounds[-1], *needed))
    return bounds[-1]


def _needed(algebra: GradedAlgebra, span: Sequence[Mapping[Word, Element]], first: int) -> int:
    """Return a lower bound for the number of brackets in every program that computes the elements of
    ``span``. Only brackets that contain a letter with index ``first`` or higher are counted."""
    ring, parts, beyond = algebra.ring, list[Polynomial](), list[Polynomial]()
    for x in span:
        factors = newest_factors(x, first)
        parts.append({(*word, n): value for n, p in factors.items() for word, value in p.items()})
        beyond.append(
            {(*w, n): value for n, p in factors.items() for w, value in beyond_lie(algebra, p).items()}
        )
    nested = [{word: v for word, v in x.items() if len(word) > 1 and max(word) >= first} for x in span]
    single = _rank(ring, parts)
    return max(_rank(ring, nested), single + (0 < single == _rank(ring, beyond)))


def _rank(ring: Ring, columns: Sequence[Polynomial]) -> int:
    kept = list[Polynomial]()
    for column in columns:
        if solve(ring, kept, column) is None:
            kept.append(column)
    return len(kept)
