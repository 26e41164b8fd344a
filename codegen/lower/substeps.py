"""Compositions: methods whose step consists of substeps of one method.

Suppose that the stages of a tableau form consecutive groups with two properties:

- a_ij = b_j if stage j is in an earlier group than stage i,
- a_ij = 0 if stage j is in a later group than stage i.

Let gamma_k be the sum of the b_j of group k. Then the method is a composition, and group k is a substep of
length gamma_k h (Lemma 3.5.4 of Bogfjellmo and Marthinsen). The coefficients of group k, divided by gamma_k,
are the tableau of the substep. If all substeps have the same tableau, one program computes all substeps.

Explicit methods are not split into substeps. Without the split, expressions that occur in several substeps
are computed only once.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from codegen.ir.number import Number
from codegen.ir.program import Substep
from codegen.method import Method
from orderconds.ring.protocol import Element
from orderconds.tableau import Composition, RungeKutta


def substeps(method: Method) -> tuple[Method, tuple[Substep, ...]] | None:
    """Return the base method of a composition, and the substeps of one step.

    The result is None if the tableau is not a composition of implicit substeps, or if the step also computes
    an embedded solution.

    >>> from codegen.method import parse
    >>> base, steps = substeps(parse("vcg:suzuki4", ("vcg",)))
    >>> base.tableau.method.s, [step.fraction == steps[0].fraction for step in steps]
    (1, [True, True, False, True, True])
    >>> substeps(parse("vcg:gauss2", ("vcg",))) is None
    True
    """
    # The embedded solution needs the stages of all substeps. A substep computes only its own stages.
    if method.adaptive:
        return None
    tableau = method.tableau
    repetition: tuple[RungeKutta, tuple[Number, ...]] | None
    if isinstance(tableau.method, Composition):
        # Each substep of a tableau of the class Composition is a step of the midpoint rule.
        half = tableau.ring.rational(1, 2)
        repetition = (
            RungeKutta(((half,),), (tableau.ring.one,)),
            tuple(map(method.number, tableau.method.gamma)),
        )
    elif isinstance(tableau.method, RungeKutta):
        repetition = _repeated(method, tableau.method)
    else:
        return None
    # A single substep is the step itself, so nothing is repeated.
    if repetition is None or len(repetition[1]) < 2:
        return None
    # The proof, the file and the embedded method belong to the whole tableau, not to the tableau of a
    # substep.
    tableau_of_one = replace(
        tableau, family="rk", method=repetition[0], embedded=None, proof=None, file=None, path=None
    )
    return replace(method, coefficients=tableau_of_one), tuple(_timed(repetition[1]))


def _timed(fractions: Sequence[Number]) -> Iterator[Substep]:
    """Yield one substep of length x h for each x in ``fractions``, with its start time."""
    before = Number.rational(0)
    for fraction in fractions:
        yield Substep(fraction, before)
        # A sum of objects of the class Number is rounded only when the code is printed.
        before = before + fraction


def _repeated(method: Method, rk: RungeKutta) -> tuple[RungeKutta, tuple[Number, ...]] | None:
    """Return a common tableau and numbers gamma_k: substep k has this tableau and the length gamma_k h.

    The result is None if the step cannot be divided, or if the common tableau is explicit.
    """
    # Objects of the class Number can be compared by ==, even if their values are intervals.
    A = [[method.number(x) for x in row] for row in rk.A]
    b = [method.number(x) for x in rk.b]
    # ``cuts`` begins with 0 and ends with the number of stages. Between these two numbers, ``cuts`` contains
    # each k for which the step can be divided into two substeps after stage k.
    cuts = [0, *(k for k in range(1, rk.s) if _separate(A, b, k)), rk.s]
    # The loop begins with the smallest groups of stages. Smaller groups give more substeps.
    for wide in (w for w in range(1, len(cuts) - 1) if (len(cuts) - 1) % w == 0):
        # ``ends`` contains every ``wide``-th index in ``cuts``. Each group of stages extends from one index
        # in ``ends`` to the next index.
        ends = cuts[::wide]
        groups = [range(i, j) for i, j in pairwise(ends)]
        # A step with weights b_j advances the time by h sum_j b_j.
        sums = [_sum([b[j] for j in group]) for group in groups]
        # The next assignment divides by these sums, so no sum may be zero.
        if any(x.is_zero for x in sums):
            continue
        # The tableau of a substep contains the coefficients of one group of stages, divided by the sum of the
        # weights b_j in this group.
        scaled = [
            [[x / total for x in row] for row in (*([A[i][j] for j in g] for i in g), [b[j] for j in g])]
            for g, total in zip(groups, sums, strict=True)
        ]
        first = scaled[0]
        # Explicit methods are not divided into substeps, because an expression that occurs in several
        # substeps would then be computed several times.
        if all(rows == first for rows in scaled) and _implicit(first):
            elements = [tuple(_element(method, x) for x in row) for row in first]
            return RungeKutta(tuple(elements[:-1]), elements[-1]), tuple(sums)
    return None


def _separate(A: Sequence[Sequence[Number]], b: Sequence[Number], k: int) -> bool:
    """Return True if a step can be divided into two substeps, the first with k stages."""
    s = len(b)
    # Lemma 3.5.4 of Bogfjellmo and Marthinsen, for a first substep with k stages: a_ij = b_j for j < k <= i,
    # and a_ij = 0 for i < k <= j.
    return all(A[i][j] == b[j] for i in range(k, s) for j in range(k)) and all(
        A[i][j].is_zero for i in range(k) for j in range(k, s)
    )


def _implicit(rows: Sequence[Sequence[Number]]) -> bool:
    # ``rows`` contains the rows of A, followed by b.
    return any(not x.is_zero for i, row in enumerate(rows[:-1]) for x in row[i:])


def _sum(numbers: Sequence[Number]) -> Number:
    # The built-in ``sum`` starts at the integer 0, and int plus Number is undefined.
    total = Number.rational(0)
    for x in numbers:
        total = total + x
    return total


def _element(method: Method, x: Number) -> Element:
    """Return a number as an element of the tableau's ring."""
    # A tableau needs elements of its own ring, but a Number stores rational values as elements of QQ.
    if x.is_rational:
        fraction = x.fraction()
        return method.ring.rational(fraction.numerator, fraction.denominator)
    return x.element
