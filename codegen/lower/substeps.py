"""Compositions: if a step consists of substeps of one method, only one substep is compiled.

Suppose that the stages of a tableau form consecutive groups with two properties:

- a_ij = b_j if stage j is in an earlier group than stage i,
- a_ij = 0 if stage j is in a later group than stage i.

Then the method is a composition: group k is a method with step size gamma_k h, where gamma_k is the sum of
the b_j of this group (Lemma 3.5.4 of Bogfjellmo and Marthinsen). If all groups have the same coefficients
after division by gamma_k, one program is enough for all substeps.

Only implicit methods are split into substeps. The substeps of an explicit method have common subexpressions.
A separate program for one substep would compute these subexpressions again in every substep.
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
    """Return the base method of a composition, and the substeps of its step.

    The substeps are steps of the base method with different lengths. The result is None if the step is not
    divided into substeps.

    The function does not check that the family of the method permits substeps. The caller checks this with
    the attribute ``repeats_substeps`` of :class:`codegen.lower.Lowering`.

    >>> from codegen.method import parse
    >>> base, steps = substeps(parse("vcg:suzuki4", ("vcg",)))
    >>> base.tableau.method.s, [step.fraction == steps[0].fraction for step in steps]
    (1, [True, True, False, True, True])
    >>> substeps(parse("vcg:gauss2", ("vcg",))) is None
    True
    """
    # The embedded solution is a combination of the stages of all substeps. A program for one substep does not
    # store them. Therefore tableaux with an embedded method are not split.
    if method.adaptive:
        return None
    tableau = method.tableau
    repetition: tuple[RungeKutta, tuple[Number, ...]] | None
    if isinstance(tableau.method, Composition):
        # A tableau of the class Composition lists only the lengths of the substeps. Each substep is a step of
        # the midpoint rule.
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
    # The proof, the file and the embedded method of the whole tableau do not apply to the tableau of one
    # substep.
    tableau_of_one = replace(
        tableau, family="rk", method=repetition[0], embedded=None, proof=None, file=None, path=None
    )
    return replace(method, coefficients=tableau_of_one), tuple(_timed(repetition[1]))


def _timed(fractions: Sequence[Number]) -> Iterator[Substep]:
    """Yield a substep of length x h for each x in ``fractions``. A substep also contains its start time."""
    before = Number.rational(0)
    for fraction in fractions:
        yield Substep(fraction, before)
        # The sum of the earlier step lengths is exact, so the start time of each substep is rounded once.
        before = before + fraction


def _repeated(method: Method, rk: RungeKutta) -> tuple[RungeKutta, tuple[Number, ...]] | None:
    """Divide the stages into as many groups as possible, such that all groups have the same tableau.

    Return the common tableau of the groups, and for each group k the number gamma_k: the group is a substep
    of length gamma_k h. The result is None if no division into two or more groups exists, or if the common
    tableau is explicit.
    """
    # A coefficient may be given only by a ball, that is, by an interval that contains it. The coefficients
    # are converted to the class Number, which can compare coefficients of this kind, too.
    A = [[method.number(x) for x in row] for row in rk.A]
    b = [method.number(x) for x in rk.b]
    # A cut is a number k such that the stages k, k + 1, ... form a step that starts from the result of the
    # earlier stages. The stages between two neighbouring cuts form a section. Each group of stages consists
    # of ``wide`` neighbouring sections.
    cuts = [0, *(k for k in range(1, rk.s) if _separate(A, b, k)), rk.s]
    # Small values of ``wide`` are tried first, because small groups of stages give the most substeps.
    for wide in (w for w in range(1, len(cuts) - 1) if (len(cuts) - 1) % w == 0):
        # ``wide`` divides the number of sections, so the last group of stages ends at the last cut.
        ends = cuts[::wide]
        groups = [range(i, j) for i, j in pairwise(ends)]
        # A step with weights b_j advances the time by h sum_j b_j. Therefore the length gamma_k h of substep
        # k is h times the sum of the weights of its stages.
        sums = [_sum([b[j] for j in group]) for group in groups]
        # If the weights of a group of stages add up to zero, the group does not advance the time. Such a
        # group is no substep.
        if any(x.is_zero for x in sums):
            continue
        scaled = [
            [[x / total for x in row] for row in (*([A[i][j] for j in g] for i in g), [b[j] for j in g])]
            for g, total in zip(groups, sums, strict=True)
        ]
        # ``scaled`` contains a tableau for each group k of stages: the coefficients of the group, divided by
        # gamma_k. The stages of the group are a step of this tableau with step size gamma_k h.
        first = scaled[0]
        if all(rows == first for rows in scaled) and _implicit(first):
            elements = [tuple(_element(method, x) for x in row) for row in first]
            return RungeKutta(tuple(elements[:-1]), elements[-1]), tuple(sums)
    return None


def _separate(A: Sequence[Sequence[Number]], b: Sequence[Number], k: int) -> bool:
    """Return True if the stages k, k + 1, ... form a step from the result of the earlier stages."""
    s = len(b)
    # These are the two conditions of Lemma 3.5.4 of Bogfjellmo and Marthinsen. First, a_ij = b_j for i >= k
    # and j < k: stage i starts from the result of the stages before k. Second, a_ij = 0 for i < k and j >= k:
    # stage i does not depend on stage j.
    return all(A[i][j] == b[j] for i in range(k, s) for j in range(k)) and all(
        A[i][j].is_zero for i in range(k) for j in range(k, s)
    )


def _implicit(rows: Sequence[Sequence[Number]]) -> bool:
    # ``rows`` contains the rows of A, followed by b. A non-zero entry of A on or above the diagonal means
    # that a stage depends on itself or on a later stage.
    return any(not x.is_zero for i, row in enumerate(rows[:-1]) for x in row[i:])


def _sum(numbers: Sequence[Number]) -> Number:
    total = Number.rational(0)
    for x in numbers:
        total = total + x
    return total


def _element(method: Method, x: Number) -> Element:
    """Return a number as an element of the tableau's ring."""
    # A Number stores every rational value as an element of QQ, the ring of rational numbers. A tableau needs
    # elements of its own ring, so rational values are converted.
    if x.is_rational:
        fraction = x.fraction()
        return method.ring.rational(fraction.numerator, fraction.denominator)
    return x.element
