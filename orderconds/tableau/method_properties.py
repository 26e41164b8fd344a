"""Functions that decide whether a method has a property, such as symplecticity.

The result is None if the coefficients are balls (intervals) that are too wide for a decision. HLW denotes
Hairer, Lubich and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.equal_stages import equivalent, irreducible
from orderconds.tableau.methods import PartitionedRungeKutta, RungeKutta
from orderconds.tableau.products import AdjointComposition, Magnus, Splitting
from orderconds.tableau.reversal import symmetric_exponents

Verdict = bool | None


def _all(verdicts: Iterable[Verdict]) -> Verdict:
    """Return True if all verdicts are True, False if a verdict is False, and None in all other cases."""
    unknown = False
    for verdict in verdicts:
        if verdict is False:
            return False
        unknown |= verdict is None
    return None if unknown else True


def _equal(x: Element, y: Element, ring: Ring) -> Verdict:
    """Return True if x = y, False if x differs from y, and None if the balls are too wide for a decision.

    If x and y are the same object, the result is True, also for balls."""
    return True if x is y else ring.is_zero(x - y)


def explicit(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the method is explicit. The condition is a_ij = 0 for j >= i, where a_ij are the entries
    of the matrix ``A`` of the method.

    >>> from orderconds.tableau import Tableau, find
    >>> rk4 = Tableau.load(find("rk4"))
    >>> explicit(rk4.method, rk4.ring)
    True
    """
    return _all(ring.is_zero(method.A[i][j]) for i in range(method.s) for j in range(i, method.s))


def diagonally_implicit(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the method is diagonally implicit. The conditions on the matrix ``A`` are: a_ij = 0 for
    j > i, and at least one a_ii is not zero.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss1 = Tableau.load(find("gauss1"))
    >>> diagonally_implicit(gauss1.method, gauss1.ring)
    True
    """
    above = _all(ring.is_zero(method.A[i][j]) for i in range(method.s) for j in range(i + 1, method.s))
    is_explicit = explicit(method, ring)
    return _all([above, None if is_explicit is None else not is_explicit])


def symplectic(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the tableau satisfies the condition of symplecticity (HLW Theorem VI.4.3).

    The condition on ``A`` and ``b`` is: b_i a_ij + b_j a_ji = b_i b_j for all i and j. See
    :func:`symplectic_step` for tableaux with equal or unused stages.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss2 = Tableau.load(find("gauss2"))
    >>> symplectic(gauss2.method, gauss2.ring)
    True
    """
    A, b, s = method.A, method.b, method.s
    return _all(
        ring.is_zero(b[i] * A[i][j] + b[j] * A[j][i] - b[i] * b[j]) for i in range(s) for j in range(i, s)
    )


def symplectic_step(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the method is symplectic. A method is symplectic if and only if its irreducible tableau
    satisfies the condition of :func:`symplectic` (HLW Theorem VI.7.10).

    >>> from orderconds.ring import QQ
    >>> half, zero = QQ.rational(1, 2), QQ.zero
    >>> midpoint_twice = RungeKutta(((half, zero), (half, zero)), (half, half))
    >>> symplectic(midpoint_twice, QQ), symplectic_step(midpoint_twice, QQ)
    (False, True)
    """
    verdict = symplectic(method, ring)
    return verdict if verdict is True else symplectic(irreducible(method, ring), ring)


def symplectic_pair(method: PartitionedRungeKutta, ring: Ring) -> Verdict:
    """Return True if a partitioned method is symplectic for separable Hamiltonians H = T(p) + V(q).

    The condition on the tableaux (A, b) and (A_hat, b_hat) is: b_i ahat_ij + bhat_j a_ji = b_i bhat_j for all
    i and j (HLW Theorem VI.4.6).

    >>> from orderconds.ring import QQ
    >>> half, one = QQ.rational(1, 2), QQ.one
    >>> symplectic_pair(PartitionedRungeKutta(((half,),), (one,), ((half,),), (one,)), QQ)
    True
    """
    A, b, A_hat, b_hat, stages = method.A, method.b, method.A_hat, method.b_hat, range(method.s)
    return _all(
        ring.is_zero(b[i] * A_hat[i][j] + b_hat[j] * A[j][i] - b[i] * b_hat[j])
        for i in stages
        for j in stages
    )


def symmetric(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the tableau satisfies the condition of symmetry (HLW Theorem V.2.3).

    For s stages, the condition on ``A`` and ``b`` is: a_{s+1-i,s+1-j} + a_ij = b_j for all i and j. The
    function tests only the given numbering of the stages; see :func:`symmetric_step`.

    >>> from orderconds.tableau import Tableau, find
    >>> gauss3 = Tableau.load(find("gauss3"))
    >>> symmetric(gauss3.method, gauss3.ring)
    True
    """
    A, b, s = method.A, method.b, method.s
    mirrored = (ring.is_zero(A[s - 1 - i][s - 1 - j] + A[i][j] - b[j]) for i in range(s) for j in range(s))
    return _all([*mirrored, *(_equal(b[i], b[s - 1 - i], ring) for i in range(s // 2))])


def symmetric_step(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the method is symmetric: a step of size -h undoes a step of size h. The numbering of the
    stages has no effect. The method is symmetric if and only if it equals its adjoint method, which has the
    entries b_j - a_ij and the weights b_j.

    >>> from orderconds.ring import QQ
    >>> half, zero = QQ.rational(1, 2), QQ.zero
    >>> midpoint_and_unused = RungeKutta(((half, zero), (QQ.one, QQ.one)), (QQ.one, zero))
    >>> symmetric(midpoint_and_unused, QQ), symmetric_step(midpoint_and_unused, QQ)
    (False, True)
    """
    verdict = symmetric(method, ring)
    if verdict is True:
        return True
    A = tuple(tuple(y - x for x, y in zip(row, method.b, strict=True)) for row in method.A)
    return True if equivalent(method, RungeKutta(A, method.b), ring) else verdict


def stiffly_accurate(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the method is stiffly accurate: the last row of ``A`` is equal to ``b``.

    >>> from orderconds.tableau import Tableau, find
    >>> rk4 = Tableau.load(find("rk4"))
    >>> stiffly_accurate(rk4.method, rk4.ring)
    False
    """
    return _all(_equal(x, y, ring) for x, y in zip(method.A[-1], method.b, strict=True))


def fsal(method: RungeKutta, ring: Ring) -> Verdict:
    """Return True if the method is first-same-as-last. There are three conditions: the method has more than
    one stage, the first stage equals the start value, and the last row of ``A`` equals ``b``.

    >>> from orderconds.tableau import Tableau, find
    >>> rk4 = Tableau.load(find("rk4"))
    >>> fsal(rk4.method, rk4.ring)
    False
    """
    first = _all(ring.is_zero(x) for x in method.A[0])
    return _all([method.s > 1, stiffly_accurate(method, ring), first])


DEFINITIONS: dict[str, Callable[[RungeKutta, Ring], Verdict]] = {
    "explicit": explicit,
    "diagonally_implicit": diagonally_implicit,
    "symplectic": symplectic_step,
    "symmetric": symmetric_step,
    "fsal": fsal,
    "stiffly_accurate": stiffly_accurate,
}

PROPERTIES = (*DEFINITIONS, "low_storage", "a_stable", "l_stable")
"""The names of all properties that the table ``claims`` of a tableau file may contain."""


def reads_backwards(row: Sequence[Element], ring: Ring) -> Verdict:
    """Return True if a row of numbers is a palindrome.

    >>> from orderconds.ring import QQ
    >>> [reads_backwards([QQ.rational(n) for n in row], QQ) for row in ((1, 2, 1), (1, 2, 2))]
    [True, False]
    """
    s = len(row)
    return _all(_equal(row[i], row[s - 1 - i], ring) for i in range(s // 2))


def symmetric_product(method: AdjointComposition | Splitting | Magnus, ring: Ring) -> Verdict:
    """Return True if the method is symmetric: a step of size -h undoes a step of size h (HLW V.3).

    - A composition with s pairs (alpha_i, beta_i) is symmetric if alpha_{s+1-i} = beta_i for all i.
    - A splitting is symmetric if its list of flows with step sizes is a palindrome.
    - For Magnus methods, see :mod:`orderconds.tableau.reversal`.

    >>> from orderconds.ring import QQ
    >>> half = QQ.rational(1, 2)
    >>> symmetric_product(Splitting(("T", "V"), ((1, half), (0, QQ.one), (1, half))), QQ)
    True
    """
    if isinstance(method, AdjointComposition):
        pairs = zip(method.alpha, method.beta[::-1], strict=True)
        return _all(_equal(x, y, ring) for x, y in pairs)
    if isinstance(method, Splitting):
        mirrored = zip(method.steps, method.steps[::-1], strict=True)
        return _all(p == q and _equal(x, y, ring) for (p, x), (q, y) in mirrored)
    return symmetric_exponents(method, ring)
