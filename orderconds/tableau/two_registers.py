"""Schemes with two registers (2N), and their recognition in tableaux.

Stage i computes K <- A_i K + F(Y), then Y <- exp(h B_i K) Y. Here F is the vector field and h is the step
size. A step stores only the state Y and one element K of the Lie algebra (Williamson, J. Comput. Phys. 35
(1980) 48; on groups: Luescher 2010, Bazavov 2020, arXiv:2007.04225). A 2N scheme is a commutator-free method
with one exponential for each stage. On a vector space, a 2N scheme is a Runge-Kutta method.

Let F_i be the vector field at stage i. Increment i leads from stage i to stage i + 1. The last increment
leads from the last stage to the result of the step. In a 2N scheme, increment i is B_i K_i with K_i = F_i +
sum_{j < i} A_{j+1} ... A_i F_j. The recognition computes B_i and A_i from the increments of a tableau:

- B_i is the coefficient of F_i in increment i.
- Let x be the coefficient of F_{i-1} and y the coefficient of F_i in an increment m >= i. In a 2N scheme,
  increment m is B_m K_m. Therefore x = B_m A_i ... A_m and y = B_m A_{i+1} ... A_m, so x = A_i y. Hence
  A_i = x/y for the first increment m >= i in which y is not zero. If y is zero in all these increments, x
  must be zero, too, and A_i = 0 is chosen.

The tableau is a 2N scheme if all its increments are equal to the increments B_i K_i.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from operator import sub

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.method_properties import Verdict
from orderconds.tableau.methods import CommutatorFree, Row, RungeKutta, Stage


@dataclass(frozen=True)
class TwoRegisters:
    """A low-storage (2N) scheme. Stage i computes K <- A_i K + F(Y), then Y <- exp(h B_i K) Y, where F is
    the vector field and h is the step size. A_1 is zero."""

    A: Row
    B: Row

    @property
    def s(self) -> int:
        """The number of stages."""
        return len(self.B)

    def increments(self, ring: Ring) -> tuple[Row, ...]:
        """Return the increments B_i K_i for i = 1, ..., s, where K_i is the register K after stage i. Row i
        contains the coefficients of F_1, ..., F_s in B_i K_i. Here F_j is the vector field at stage j.

        >>> from orderconds.ring import QQ
        >>> half, two = QQ.rational(1, 2), QQ.rational(2)
        >>> TwoRegisters((QQ.zero, -half), (half, two)).increments(QQ)
        ((1/2, 0), (-1, 2))
        """
        rows: list[Row] = []
        # The list ``register`` contains the coefficients x_j of K_i = F_i + sum_{j < i} x_j F_j.
        register: list[Element] = []
        for i, (a, b) in enumerate(zip(self.A, self.B, strict=True)):
            register = [*(a * x for x in register), a] if i else []
            rows.append((*(b * x for x in register), b, *([ring.zero] * (self.s - i - 1))))
        return tuple(rows)

    def as_commutator_free(self, ring: Ring) -> CommutatorFree:
        """Return the scheme as a commutator-free method. Exponential i leads from the value of stage i to the
        value of stage i + 1. Its exponent is increment i (:meth:`increments`)."""
        steps = [Stage(i, (row,)) for i, row in enumerate(self.increments(ring))]
        return CommutatorFree((Stage(None, ()), *steps[:-1]), steps[-1])


@dataclass(frozen=True)
class Rewriting:
    """The result of rewriting a method as a low-storage (2N) scheme.

    - ``holds``: True if the method is a 2N scheme, and False if it is not. None means that balls (intervals)
      are too wide to decide.
    - ``scheme``: the 2N scheme, or None
    - ``reason``: the reason why ``scheme`` is None
    """

    holds: Verdict
    scheme: TwoRegisters | None = None
    reason: str = ""


def two_registers(method: RungeKutta | CommutatorFree, ring: Ring) -> Rewriting:
    """Rewrite a method as a low-storage (2N) scheme. If no such scheme exists, return the reason.

    If ``method`` is commutator-free, the scheme and ``method`` compute the same step. If ``method`` is a
    Runge-Kutta method, the scheme and ``method`` compute the same step on vector spaces.

    >>> from orderconds.tableau import Tableau, find
    >>> kutta3, heun = (Tableau.load(find(name)) for name in ("kutta3", "heun"))
    >>> print(two_registers(kutta3.method, kutta3.ring).reason)
    in the increment of stage 3, k_1 has the coefficient 7/6, but a 2N scheme requires the coefficient 1
    >>> [str(x) for x in two_registers(heun.method, heun.ring).scheme.A]
    ['0', '-1']
    """
    rows = _row_increments(method, ring) if isinstance(method, RungeKutta) else _path_increments(method, ring)
    if isinstance(rows, str):
        return Rewriting(False, reason=rows)
    for i, row in enumerate(rows):
        for j in range(i + 1, method.s):
            if ring.is_zero(row[j]) is False:
                return Rewriting(
                    False,
                    reason=f"the increment of stage {i + 1} depends on k_{j + 1}: the method is implicit",
                )
    B = tuple(row[i] for i, row in enumerate(rows))
    A: list[Element] = [ring.zero]
    for i in range(1, method.s):
        quotient = _quotient(rows, i, ring)
        if isinstance(quotient, Rewriting):
            return quotient
        A.append(quotient)
    scheme = TwoRegisters(tuple(A), B)
    return _compared(scheme, rows, ring)


def second_exponent(method: CommutatorFree, second: Stage, ring: Ring) -> Row | None:
    """Compare the embedded update ``second`` with the update of ``method``. If ``second`` is the update of
    ``method``, followed by one exponential exp(x), return x. Otherwise, return None.

    >>> from orderconds.tableau import Tableau, find
    >>> pair = Tableau.load(find("cf43"))
    >>> second_exponent(pair.method, pair.embedded.update, pair.ring) is None
    True
    """
    *path, last = method.from_start(second)
    update = list(method.from_start(method.update))
    return last if len(path) == len(update) and _same(path, update, ring) else None


def _quotient(rows: list[Row], i: int, ring: Ring) -> Element | Rewriting:
    """Return the coefficient A_i of a 2N scheme. ``rows[m]`` contains the coefficients of increment m. Here i
    and m are counted from 0. If A_i cannot be computed, return a :class:`Rewriting` with the reason."""
    above = ""
    for m in range(i, len(rows)):
        denominator = rows[m][i]
        zero = ring.is_zero(denominator)
        if zero is None:
            return Rewriting(
                None, reason=f"the coefficient of k_{i + 1} in the increment of stage {m + 1} may be zero"
            )
        if not zero:
            return rows[m][i - 1] / denominator
        if ring.is_zero(rows[m][i - 1]) is False and not above:
            above = (
                f"the increment of stage {m + 1} contains k_{i} (coefficient {ring.text(rows[m][i - 1])}) "
                f"but not k_{i + 1}; in a 2N scheme, this increment can contain k_{i} only together with "
                f"k_{i + 1}"
            )
    return Rewriting(False, reason=above) if above else ring.zero


def _compared(scheme: TwoRegisters, rows: list[Row], ring: Ring) -> Rewriting:
    """Compare the increments of the scheme with ``rows``. Return the scheme if all are equal. Otherwise,
    return the first difference."""
    holds: Verdict = True
    for i, (row, expected) in enumerate(zip(rows, scheme.increments(ring), strict=True)):
        for j, (x, y) in enumerate(zip(row, expected, strict=True)):
            equal = True if x is y else ring.is_zero(x - y)
            if equal is False:
                reason = (
                    f"in the increment of stage {i + 1}, k_{j + 1} has the coefficient {ring.text(x)}, "
                    f"but a 2N scheme requires the coefficient {ring.text(y)}"
                )
                return Rewriting(False, reason=reason)
            holds = None if equal is None else holds
    return Rewriting(holds, scheme)


def _row_increments(method: RungeKutta, ring: Ring) -> list[Row] | str:
    """Return the differences of successive rows of A, where b is appended as the last row. If the first row
    of A is not zero, return an error text."""
    if any(ring.is_zero(x) is False for x in method.A[0]):
        return "the first stage is not the start value"
    rows = (*method.A, method.b)
    return [tuple(map(sub, later, row)) for row, later in pairwise(rows)]


def _path_increments(method: CommutatorFree, ring: Ring) -> list[Row] | str:
    """In a commutator-free method, each stage and the update are products of exponentials, applied to the
    start value y0. Increment i is the exponent of the exponential that leads from stage i to stage i + 1,
    or from the last stage to the update. Return all increments. Return an error text if the first stage is
    not y0, or if an increment would need more than one exponential."""
    *paths, update = (
        [row for row in method.from_start(stage) if any(ring.is_zero(x) is not True for x in row)]
        for stage in (*method.stages, method.update)
    )
    if paths[0]:
        return "the first stage is not the start value"
    increments: list[Row] = []
    for i, (path, later) in enumerate(zip(paths, [*paths[1:], update], strict=True)):
        end = f"stage {i + 2}" if i + 1 < method.s else "the update"
        if len(later) not in (len(path), len(path) + 1) or not _same(path, later[: len(path)], ring):
            return f"no single exponential leads from stage {i + 1} to {end}"
        increments.append(later[-1] if len(later) > len(path) else (ring.zero,) * method.s)
    return increments


def _same(path: list[Row], other: list[Row], ring: Ring) -> bool:
    return all(
        x is y or ring.is_zero(x - y) is not False
        for row, same in zip(path, other, strict=True)
        for x, y in zip(row, same, strict=True)
    )
