"""A lower bound for the number of brackets (commutators) in a program. Linear algebra gives the bound.

The program (:class:`orderconds.series.brackets.BracketProgram`) computes the arguments u_1, ..., u_s of the
exponentials of the stages and the argument u of the exponential of the step.

The arguments are expressed in the elements q_j = k_j + c_j1 k_1 + ... + c_j(j-1) k_(j-1), where k_j is the
value of stage j. The module :mod:`orderconds.series.brackets` chooses the numbers c_jn such that the order of
q_j in the step size is as high as possible. The symbols q_1, q_2, ... are called letters. The argument u_i
contains only the letters q_1, ..., q_(i-1), because it is computed before k_i. Choose a number m < i. The
letters q_m, ..., q_(i-1) are called new, and the letters q_1, ..., q_(m-1) are called old. Let N be the
number of brackets with new letters in a program for u_1, ..., u_i.

If all brackets are expanded by [x, y] = x y - y x, each argument becomes a sum of terms. A term is a product
of letters, multiplied by a number.

First bound: for each argument, form the sum of the terms that have at least two letters and contain a new
letter. This sum is called the new part of the argument. The new part of a bracket is defined in the same way.
Before the expansion, each argument is a linear combination of letters and of brackets of the program. The new
part of a single letter is zero, and the new part of a bracket of old letters is zero. Therefore the new part
of each argument is a linear combination of the new parts of the N brackets with new letters. Hence N is at
least the dimension of the space that the new parts of u_1, ..., u_i span.

Second bound: for each argument, form the sum of the terms that have at least two letters and exactly one new
letter. This sum is called the linear part of the argument. Let ad_q be the operator with ad_q y = [q, y]. To
obtain the operator ad_(P) for a polynomial P, replace each letter q in P by the operator ad_q. For example,
let q_1 and q_2 be old letters, and let q_n be a new letter. With the polynomial P = q_2 q_1, ad_(P) q_n is
the bracket [q_2, [q_1, q_n]]. Each argument is a linear combination of letters and of (nested) brackets. By
antisymmetry and the Jacobi identity, each nested bracket of old letters and exactly one new letter q_n has
the form ad_(P) q_n with a polynomial P in the old letters. For example, [q_n, q_1] = -[q_1, q_n] has
P = -q_1, and [[q_1, q_2], q_n] = [q_1, [q_2, q_n]] - [q_2, [q_1, q_n]] has P = q_1 q_2 - q_2 q_1. Therefore
the linear part of each argument has the form sum_n ad_(P_n) q_n. Here n runs over the indices of the new
letters, and P_n is a polynomial in the old letters. Let S be the space that the linear parts of u_1, ..., u_i
span, and let d be the dimension of S.

The linear part of a bracket is defined in the same way. The linear part of each argument is a linear
combination of the linear parts of the N brackets. Hence N is at least d.

Improvement of the second bound: a Lie element in the old letters is a linear combination of old letters and
of (nested) brackets of old letters. Let L be the space of all sums sum_n ad_(P_n) q_n with Lie elements P_n
in the old letters. If d > 0, and if zero is the only common element of S and L, then N is at least d + 1.

Proof: all brackets that are computed before the first of the N brackets contain only old letters. Therefore
the first of the N brackets has the form [a + A, b + B], where a and b are linear combinations of new letters,
and A and B are Lie elements in the old letters. The linear part of this bracket is [A, b] - [B, a], which is
an element of L. Assume N = d. The linear parts of the N brackets span a space of dimension at most d that
contains S. Hence this space is S, and the linear parts are a basis of S. Then the linear part of the first
bracket is a nonzero element of S and of L, a contradiction.

The new letters are computed after u_1, ..., u_m, because the stage value k_m depends on u_m. Therefore the
brackets in u_1, ..., u_m contain only old letters, and are not among the N brackets. Add a lower bound for
the number of brackets in a program for u_1, ..., u_m to the lower bound for N. The sum is a lower bound for
the number of brackets in a program for u_1, ..., u_i.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from orderconds.ring.protocol import Element, Ring
from orderconds.series.graded import GradedAlgebra, Polynomial, Word, solve


def newest_factors(x: Mapping[Word, Element], first: int) -> dict[int, Polynomial]:
    """A letter is a number. Letters below ``first`` are called old, and all other letters are called new.
    Return a map from each new letter n to a polynomial P_n in the old letters.

    The polynomial x is a linear combination of letters and (nested) brackets, expanded into words. A word is
    a tuple of letters. To obtain P_n, take all terms of x whose words consist of one or more old letters,
    followed by n, and remove the letter n at the end of each word. If P_n is zero, n is not a key of the map.
    The module docstring explains the use of P_n.

    >>> {n: {w: str(x) for w, x in p.items()} for n, p in newest_factors({(0, 1): 2, (1, 0): -2}, 1).items()}
    {1: {(0,): '2'}}
    """
    factors = dict[int, Polynomial]()
    for word, value in x.items():
        if len(word) > 1 and word[-1] >= first and all(letter < first for letter in word[:-1]):
            factors.setdefault(word[-1], {})[word[:-1]] = value
    return factors


def beyond_lie(algebra: GradedAlgebra, x: Mapping[Word, Element]) -> Polynomial:
    """Return x - D(x). The linear map D replaces a word of n letters by its right-normed bracket divided by
    n. The result is zero if and only if the polynomial x is a Lie element (theorem of Dynkin, Specht and
    Wever). The polynomial x must have no constant term.

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
    """Return a lower bound for the number of brackets in every program that computes ``arguments``. The list
    contains u_1, ..., u_s and u. Here exp(u_i) is the exponential of stage i, and exp(u) is the exponential
    of the step.

    In u_1, ..., u_s, the terms of grade ``algebra.largest`` are ignored, because they do not affect the order
    of the method.

    >>> from orderconds.ring import QQ
    >>> algebra, q = GradedAlgebra(QQ, (1, 2, 3), 6), [{(n,): QQ.one} for n in range(3)]
    >>> least_brackets(algebra, [{}, q[0], q[1], algebra.bracket(q[0], algebra.bracket(q[0], q[2]))])
    2
    """
    bounds, last = [0], len(arguments) - 1
    for i in range(1, len(arguments)):
        known = [algebra.cut(u, algebra.largest - 1) for u in arguments[: i + 1]]
        spans = [known[j:] for j in range(1, i + 1)] + ([[dict(arguments[i])]] if i == last else [])
        needed = (bounds[m] + max(_needed(algebra, span, m) for span in spans) for m in range(i))
        bounds.append(max(bounds[-1], *needed))
    return bounds[-1]


def _needed(algebra: GradedAlgebra, span: Sequence[Mapping[Word, Element]], first: int) -> int:
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
