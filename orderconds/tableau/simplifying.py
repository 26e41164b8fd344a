"""Butcher's simplifying assumptions B(p), C(q), D(r) and the orders that they imply."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from flint import fmpq_poly

from orderconds.ring.nodal import NodalAlgebra, nodal_algebra
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import RungeKutta


def simplifying_order(B: int, C: int, D: int) -> int:
    """Return the order that the simplifying assumptions B(p), C(q) and D(r) imply. The arguments B, C and D
    are the numbers p, q and r.

    >>> simplifying_order(6, 3, 2), simplifying_order(10, 5, 5)
    (6, 10)
    """
    return min(B, C + D + 1, 2 * C + 2)


def simplifying(method: RungeKutta, ring: Ring, assumptions: Mapping[str, int]) -> Iterator[Element]:
    """Yield the residuals of the equations in the simplifying assumptions B(p), C(q) and D(r). The mapping
    ``assumptions`` maps the keys B, C and D to p, q and r.

    - B: sum_i b_i c_i^(k-1) = 1/k for k = 1, ..., p.
    - C: sum_j a_ij c_j^(k-1) = c_i^k/k for k = 2, ..., q. The equation for k = 1 defines c.
    - D: sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k)/k for k = 1, ..., r.

    >>> from orderconds.ring import QQ
    >>> from orderconds.tableau import Tableau, find
    >>> gauss1 = Tableau.load(find("gauss1"))
    >>> [int(QQ.is_zero(x)) for x in simplifying(gauss1.method, QQ, {"B": 2, "C": 1, "D": 1})]
    [1, 1, 1]
    """
    A, b, stages = method.A, method.b, range(method.s)
    c = [sum(row, ring.zero) for row in A]
    powers = [[ring.one] * method.s]
    for _ in range(max(assumptions.values())):
        powers.append([x * y for x, y in zip(powers[-1], c, strict=True)])
    for k in range(1, assumptions.get("B", 0) + 1):
        yield _dot(b, powers[k - 1], ring) - ring.rational(1, k)
    for k in range(2, assumptions.get("C", 0) + 1):
        for i in stages:
            yield _dot(A[i], powers[k - 1], ring) - powers[k][i] * ring.rational(1, k)
    for k in range(1, assumptions.get("D", 0) + 1):
        for j in stages:
            column = _dot([b[i] * A[i][j] for i in stages], powers[k - 1], ring)
            yield column - b[j] * (ring.one - powers[k][j]) * ring.rational(1, k)


def _dot(x: Sequence[Element], y: Sequence[Element], ring: Ring) -> Element:
    return sum((p * q for p, q in zip(x, y, strict=True)), ring.zero)


def highest_assumptions(method: RungeKutta, ring: Ring, order: int) -> int:
    """Return the largest m with 2m <= ``order`` for which the simplifying assumptions C(m) and D(m) hold.

    >>> from orderconds.tableau.collocation import construct
    >>> radau = construct("radau2a", 3)
    >>> highest_assumptions(radau.method, radau.ring, 5)
    2
    """
    algebra = nodal_algebra(ring, (method.A,), method.b)

    def holds(m: int) -> bool:
        if algebra is not None:
            return _simplifies(algebra, m)
        return all(ring.is_zero(x) is True for x in simplifying(method, ring, {"C": m, "D": m}))

    m = 0
    while 2 * (m + 1) <= order and holds(m + 1):
        m += 1
    return m


def _simplifies(algebra: NodalAlgebra, m: int) -> bool:
    """Return True if the simplifying assumptions C(m) and D(m) hold (:func:`simplifying`). In the code, a
    polynomial p denotes the vector with the entries p(c_i), where c_i are the nodes."""
    stages = range(int(algebra.modulus.degree()))
    powers = [fmpq_poly([0] * k + [1]) % algebra.modulus for k in range(max(m + 1, len(stages)))]
    for k in range(1, m + 1):
        if algebra.apply(0, powers[k - 1]) != powers[k] / k:
            return False
        rest = (1 - powers[k]) / k
        for p in powers[: len(stages)]:
            left = algebra.weigh(algebra.multiply(powers[k - 1], algebra.apply(0, p)))
            if left != algebra.weigh(algebra.multiply(rest, p)):
                return False
    return True
