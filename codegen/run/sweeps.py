"""Loops that solve implicit equations: fixed-point iteration, and Newton's method in three forms.

The equations are u = g(u) or r(u) = 0. One iteration of a loop is called a sweep. The components of g(u) or
r(u) are called images.

Fixed-point iteration assigns the images to the unknowns.

The residuals are g(u) - u or r(u). Newton's method multiplies the residuals by the inverse of a matrix and
adds the product to the unknowns. The three forms of Newton's method use different matrices:

- *Newton*: the matrix 1 - g'(u). The inverse matrix is stored for later sweeps and steps. If the change of
  the unknowns in a sweep exceeds ``Newton.CONTRACTION`` times the change in the previous sweep, the next
  sweep computes a new matrix. The loop fails if a new matrix is singular, or if the change does not decrease
  in a sweep with a new matrix.
- *simplified Newton*: the matrix 1 - g'(u), expanded to first order in h. Each step computes the matrix
  before its sweeps.
- *residuals*: the matrix -r'(u), expanded to first order in h. Each inverse matrix is used for
  ``Newton.period`` steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.kernel import NEWTON, SIMPLIFIED_NEWTON, Newton
from codegen.kernel.schedule import METHODS, Iteration
from codegen.run.language import Array, Assign, Call, For, If, Note, Return, Statement, While
from codegen.run.places import places
from codegen.run.plan import Plan
from codegen.run.statistics import SWEEPS, count_matrix, count_sweeps
from codegen.run.stopping import CHANGE, Stopping
from codegen.run.terms import (
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    SINGULAR,
    STATUS,
    Kind,
    Term,
    all_finite,
    both,
    code,
    count,
    either,
    flag,
    greatest,
    is_finite,
    largest,
    negated,
    number,
    own,
    paired,
    real,
    select,
    size,
    total,
    truth,
    value,
    whole,
)
from codegen.run.values import simple

WIDE = 12
"""The largest number of unknowns for which each entry of a matrix has its own emitted statement."""

WIDEST = 20
"""For more than WIDEST unknowns, fixed-point iteration computes the changes of the unknowns by a loop."""


def sweeps(plan: Plan, iteration: Iteration, counting: bool) -> list[Statement]:
    """Return the statements of one loop that solves equations.

    If the loop fails, the emitted function returns a status that describes the failure. If ``counting`` is
    True, the statistics count the sweeps of the loop.
    """
    newton = iteration.loop.newton
    if newton is None:
        return _FixedPoint(plan, iteration, counting).statements()
    return _Newton(plan, iteration, counting).statements()


@dataclass(frozen=True)
class _Loop:
    """The common code of fixed-point iteration and Newton's method.

    If ``counting`` is True, the statistics count the sweeps of the loop.
    """

    plan: Plan
    iteration: Iteration
    counting: bool

    @cached_property
    def rule(self) -> Stopping:
        """The stopping rule."""
        return Stopping(self.plan, self.iteration.loop, self.number, places(self.plan.kernel))

    @property
    def number(self) -> int:
        """The number of the loop among the loops of the kernel, counted from 1."""
        return self.iteration.number

    @property
    def unknowns(self) -> list[Term]:
        """The variables that contain the unknowns of the loop."""
        return [own(u) for u in self.iteration.loop.unknowns]

    @cached_property
    def images(self) -> list[Term]:
        """The variables that contain g(u) for equations u = g(u), or r(u) for equations r(u) = 0."""
        loop = self.iteration.loop
        return [
            own(x.payload) if x.op == "sym" and x.payload not in loop.unknowns else own(f"next {u}")
            for u, x in zip(loop.unknowns, self.iteration.images, strict=True)
        ]

    def named(self, word: str) -> list[Term]:
        """Return one variable for each unknown u.

        The name of each variable consists of ``word`` and the name of u.
        """
        return [own(f"{word} {u}") for u in self.iteration.loop.unknowns]

    def begin(self) -> list[Statement]:
        """Return the statements before the first sweep."""
        loop = self.iteration.loop
        sequence: list[Statement] = [
            Note(f"{loop.label}: {METHODS[loop.solver]}, {len(loop.unknowns)} unknowns")
        ]
        # With a warm start, ``starts`` is empty, because other statements have assigned the initial guess.
        starts = zip(self.unknowns, self.iteration.starts, strict=False)
        sequence += [Assign(u, value(x)) for u, x in starts]
        return [*sequence, *self.rule.before()]

    def computed(self) -> list[Statement]:
        """Return the statements of a sweep that count the sweep and compute the images.

        For equations u = g(u), the images are g(u). For equations r(u) = 0, the images are r(u).
        """
        sequence: list[Statement] = [Assign(SWEEPS, SWEEPS + 1)]
        for statement in self.iteration.body:
            sequence += simple(statement)
        # As in Jacobi's method, the unknowns are updated only after the evaluation of all equations.
        for image, x in zip(self.images, self.iteration.images, strict=True):
            if image.text.startswith("next "):
                sequence.append(Assign(image, value(x)))
        return sequence

    def until_converged(
        self, body: Sequence[Statement], astray: Term | None = None, singular: Term | None = None
    ) -> list[Statement]:
        """Return the loop with the given body, and the statements that follow the loop.

        The loop ends if a sweep sets a status other than NOT_CONVERGED, or after the largest number of
        sweeps. If the test ``astray`` is given, the loop also ends as soon as this test is true. If the final
        status is not OK and the test ``singular`` is true, the status becomes SINGULAR.
        """
        # Array languages have no ``break`` statement. Therefore the loop condition tests the status and the
        # number of sweeps.
        sequence: list[Statement] = [Assign(SWEEPS, whole(0)), Assign(STATUS, code(NOT_CONVERGED))]
        sequence.append(While(self.rule.going_on(astray), tuple(body), at_least_once=True))
        if singular is not None:
            unsolved = both(STATUS.differs(code(OK)), singular)
            sequence.append(If(unsolved, (Assign(STATUS, code(SINGULAR)),)))
        if self.counting:
            # A failed loop must be counted before the status is returned.
            sequence.append(count_sweeps(self.plan, self.number - 1))
        sequence.append(If(STATUS.differs(code(OK)), (Return(STATUS),)))
        return [*sequence, *self.rule.after()]


class _FixedPoint(_Loop):
    """Fixed-point iteration for u = g(u)."""

    def statements(self) -> list[Statement]:
        """Return the statements of the loop."""
        # For more than WIDEST unknowns, the changes are computed by loops over arrays, because separate
        # statements would make the function long.
        many = len(self.unknowns) > WIDEST
        measured, finite = self.wide() if many else self.narrow()
        rule, body = self.rule, self.computed()
        body += [*measured, *rule.rates(), *rule.converged(), rule.decided(is_finite(finite))]
        taken = [Assign(u, x) for u, x in zip(self.unknowns, self.images, strict=True)]
        # Later statements use the unknowns together with results that the last sweep has computed from the
        # unknowns. Therefore the unknowns are not updated after convergence.
        again = (Assign(rule.previous, CHANGE), *taken)
        body.append(If(STATUS.equals(code(NOT_CONVERGED)), again))
        return [*self.begin(), *self.until_converged(body)]

    def narrow(self) -> tuple[list[Statement], Term]:
        """Return a pair: the statements that compute |g(u) - u| for each unknown u, and a term for the sum of
        these numbers."""
        changes = self.named("change")
        sequence: list[Statement] = [
            Assign(change, size(x - u))
            for change, x, u in zip(changes, self.images, self.unknowns, strict=True)
        ]
        # A maximum may ignore a NaN, so the sum is used to find infinities and NaNs.
        return [*sequence, *self.rule.measured(changes, self.unknowns)], total(changes)

    def wide(self) -> tuple[list[Statement], Term]:
        n, k, i = len(self.unknowns), self.number, count("i")
        before, after = real(f"unknowns_{k}", n), real(f"images_{k}", n)
        # The maximum of the changes may ignore a NaN. Therefore the loop also sums the absolute values of the
        # changes. The sum is a NaN if a change is a NaN.
        most, all_changes, moved = real(f"largest_{k}"), real(f"total_{k}"), real("moved")
        body = (
            Assign(moved, size(after[i] - before[i])),
            Assign(most, greatest([most, moved])),
            Assign(all_changes, all_changes + moved),
        )
        sequence: list[Statement] = [
            Array(before, tuple(self.unknowns)),
            Array(after, tuple(self.images)),
            Assign(most, number(0.0)),
            Assign(all_changes, number(0.0)),
            For(i, whole(n), body),
        ]
        return [*sequence, *self.rule.measured([most], self.unknowns)], all_changes


class _Newton(_Loop):
    """Newton's method for equations u = g(u) or r(u) = 0.

    The matrix M approximates 1 - g'(u) or -r'(u). A sweep adds M^-1 (g(u) - u) or M^-1 r(u) to u.
    """

    @property
    def newton(self) -> Newton:
        """The description of Newton's method for this loop."""
        assert self.iteration.loop.newton is not None
        return self.iteration.loop.newton

    @property
    def kept(self) -> bool:
        """True if the inverse matrix is stored for later steps."""
        return self.iteration.loop.solver == NEWTON

    @property
    def making(self) -> Term:
        """The flag that is true if this sweep computes a new matrix."""
        return flag(f"make_{self.number}")

    @property
    def age(self) -> Term:
        """The age of the stored matrix: 1 for a new matrix, and 0 if no usable matrix is stored."""
        return self.plan.memory.field(f"age_{self.number}", Kind.COUNT)

    @cached_property
    def inverse(self) -> Term:
        """The array that contains the inverse matrix row by row."""
        n = len(self.unknowns)
        name = f"inverse_{self.number}"
        return self.plan.memory.field(name, Kind.REAL, (n * n,)) if self.kept else real(name, n * n)

    def statements(self) -> list[Statement]:
        """Return the statements of the loop."""
        return self.by_residuals() if self.newton.residuals else self.by_images()

    def by_images(self) -> list[Statement]:
        """Return the loop for equations u = g(u). The residuals are g(u) - u."""
        rule, residuals, changes = self.rule, self.named("residual"), self.named("change")
        sequence, body = self.begin(), self.computed()
        for residual, x, u in zip(residuals, self.images, self.unknowns, strict=True):
            body.append(Assign(residual, x - u))
        finite = total(residuals)
        if self.kept:
            # The age 0 means that no usable matrix is stored.
            sequence.append(Assign(self.making, negated(self.age > 0)))
            sequence.append(Assign(flag("astray"), truth(False)))
            # If the residuals are not finite, a new matrix could contain NaNs. In this case no matrix is
            # computed, and the stored matrix does not change.
            body.append(If(both(self.making, is_finite(finite)), tuple(self.renewed())))
        else:
            sequence += self.prepared()
        body += self.product(changes, residuals)
        body += rule.measured([size(x) for x in changes], self.unknowns)
        body += rule.rates()
        # ``SCALE`` is the largest absolute value of an unknown before this correction.
        body += self.corrected(changes)
        body += rule.converged()
        # The changes are finite only if the residuals and the array of the matrix are finite.
        body.append(self.decided(total(changes)))
        if self.kept:
            # The loop fails if this sweep computed a new matrix and the changes still do not decrease.
            stalled = both(flag("still"), self.making)
            if not self.newton.inverted:
                stalled = either(stalled, negated(self.age > 0))
            body.append(Assign(flag("astray"), stalled))
            # If the changes decrease slowly, the next sweep computes a new matrix. In the first sweep there
            # is no previous change (``previous`` is 0), so the rate of decrease is not known.
            slow = number(Newton.CONTRACTION) * rule.previous
            body.append(Assign(self.making, both(slow > 0.0, CHANGE > slow)))
        body.append(Assign(rule.previous, CHANGE))
        astray = flag("astray") if self.kept else None
        eliminated = self.kept and not self.newton.inverted
        return [*sequence, *self.until_converged(body, astray, self.singular() if eliminated else None)]

    def decided(self, finite: Term) -> Statement:
        """Return the statement that sets the status after a sweep.

        The value of the term ``finite`` is an infinity or a NaN if a change of an unknown is one.
        """
        test = is_finite(finite)
        if not self.kept and not self.newton.residuals:
            return self.rule.decided(test)
        # :meth:`renewed` sets ``self.age`` to 1, or to 0 if the matrix has no usable inverse. Without an
        # inverse the changes are meaningless, so even small changes do not mean convergence.
        if self.newton.inverted:
            return self.rule.decided(both(test, self.age > 0))
        return self.rule.decided(test, self.age > 0)

    def regular(self) -> Term:
        """Return the test that is true if formulas have computed a usable inverse matrix.

        If the matrix contains an infinity or a NaN, its determinant is infinite or NaN. The formulas multiply
        by the reciprocal of the determinant, so all entries of the inverse are 0 or NaN. With an inverse of
        zeros, Newton's corrections are 0. Without this test, the loop would then stop as if it had converged.
        """
        if self.kept:
            return largest(self.inverse) > 0.0
        # If the inverse is stored in scalar variables, a test of its first row is enough, because no row of a
        # usable inverse is zero.
        return total(size(self.cell(k)) for k in range(len(self.unknowns))) > 0.0

    def singular(self) -> Term:
        """Return the test that is true if the loop has not converged and the matrix is singular.

        The result is valid only if the matrix is inverted by elimination.
        """
        return both(STATUS.equals(code(NOT_CONVERGED)), negated(self.age > 0))

    def by_residuals(self) -> list[Statement]:
        """Return the loop for equations r(u) = 0. A sweep computes the residuals r(u) in ``self.images``."""
        rule, changes = self.rule, [own(c) for c in self.newton.changes]
        sequence, body = self.begin(), self.computed()
        inverted = not self.newton.inverted
        # If the age is 0, a new matrix is needed. Other statements set the age to 0 after ``period`` steps.
        sequence.append(Assign(self.making, negated(self.age > 0)))
        body.append(If(self.making, tuple(self.renewed())))
        body += self.product(changes, self.images)
        body += rule.sums(changes, self.unknowns)
        body += self.corrected(changes)
        body += rule.converged_by_residuals()
        body.append(self.decided(CHANGE))
        # At most one matrix is computed in a step. A second matrix would cost more than further sweeps.
        body.append(Assign(self.making, truth(False)))
        body.append(Assign(rule.previous, CHANGE))
        astray = negated(self.age > 0) if inverted else None
        return [*sequence, *self.until_converged(body, astray, self.singular() if inverted else None)]

    def corrected(self, changes: Sequence[Term]) -> list[Statement]:
        """Return the statements that add the changes to the unknowns."""
        return [Assign(u, u + c) for u, c in zip(self.unknowns, changes, strict=True)]

    def renewed(self) -> list[Statement]:
        """Return the statements that compute a new matrix for Newton's method and store its inverse."""
        sequence = self.entries()
        if self.newton.inverted:
            age = select(self.regular(), whole(1), whole(0))
            return [*sequence, Assign(self.age, age), *self.matrix_counted()]
        # The inverse costs more than a factorisation. However, it is used in many sweeps, and a product with
        # the inverse is faster than forward and back substitution.
        sequence.append(Call("invert", (whole(len(self.unknowns)), self.inverse), (self.age,)))
        counted = self.matrix_counted()
        return [*sequence, *([If(self.age > 0, tuple(counted))] if counted else [])]

    def matrix_counted(self) -> list[Statement]:
        """Return a list with the statement that increases the number of matrices in the statistics by 1.

        If ``counting`` is False, the list is empty.
        """
        return [count_matrix(self.plan)] if self.counting else []

    def prepared(self) -> list[Statement]:
        """Return the statements that compute and invert the matrix before the sweeps of a step.

        The matrix is inverted either by elimination or by formulas. If the elimination fails, the emitted
        function returns SINGULAR if all numbers in the array of the matrix are finite, and NOT_FINITE if the
        array contains an infinity or a NaN. If the formulas compute no usable inverse, the emitted
        function returns NOT_FINITE.
        """
        sequence = self.entries()
        if self.newton.inverted:
            return [*sequence, If(negated(self.regular()), self.failed(code(NOT_FINITE)))]
        n, inverted = len(self.unknowns), count(f"inverted_{self.number}")
        sequence = [Array(self.inverse), *sequence, Call("invert", (whole(n), self.inverse), (inverted,))]
        # If the elimination fails for a matrix with an infinity or a NaN, the array ``self.inverse`` contains
        # an infinity or a NaN afterwards.
        cause = select(all_finite(self.inverse), code(SINGULAR), code(NOT_FINITE))
        return [*sequence, If(inverted.equals(0), self.failed(cause))]

    def failed(self, cause: Term) -> tuple[Statement, ...]:
        """Return the statements that end the step with the status ``cause`` before the first sweep."""
        # The function ``count_sweeps`` reads the status to record a failure, so the status is set first.
        counted = (count_sweeps(self.plan, self.number - 1, whole(0)),) if self.counting else ()
        return (Assign(STATUS, cause), *counted, Return(STATUS))

    def entries(self) -> list[Statement]:
        """Return the statements that compute the entries of the matrix."""
        sequence: list[Statement] = []
        for statement in self.iteration.newton:
            sequence += simple(statement)
        n, matrix = len(self.unknowns), [value(x) for x in self.iteration.matrix]
        if n > WIDE:
            whole_matrix = real(f"matrix_{self.number}", n * n)
            # The entries are stored by an array initialiser and one copy, because n^2 separate assignments
            # would make the function very long.
            return [*sequence, Array(whole_matrix, tuple(matrix)), Assign(self.inverse, whole_matrix)]
        return [*sequence, *(Assign(self.cell(k), x) for k, x in enumerate(matrix))]

    def cell(self, place: int) -> Term:
        """Return entry number ``place`` of the inverse matrix, counted row by row from 0."""
        if self.iteration.loop.solver == SIMPLIFIED_NEWTON and self.newton.inverted:
            # The inverse is used in one step only and is not stored, so its entries can be scalar variables.
            # A compiler can keep scalar variables in registers.
            return real(f"inverse_{self.number}_{place}")
        return self.inverse[place]

    def product(self, changes: Sequence[Term], residuals: Sequence[Term]) -> list[Statement]:
        """Return the statements that multiply the inverse matrix by the residuals."""
        n = len(changes)
        if n <= WIDE:
            rows = [[self.cell(i * n + j) * r for j, r in enumerate(residuals)] for i in range(n)]
            # The products in a row are added in pairs. A processor can compute several pairs at the same
            # time.
            return [Assign(c, paired(row)) for c, row in zip(changes, rows, strict=True)]
        i, j, partial = count("i"), count("j"), real("sum")
        # The loop below reads the residuals from an array, so the variables of the residuals are first copied
        # to the array ``right``.
        right, left = real(f"residuals_{self.number}", n), real(f"changes_{self.number}", n)
        row = (
            Assign(partial, number(0.0)),
            For(j, whole(n), (Assign(partial, partial + self.inverse[n * i + j] * right[j]),)),
            Assign(left[i], partial),
        )
        sequence: list[Statement] = [Array(right, tuple(residuals)), Array(left), For(i, whole(n), row)]
        return [*sequence, *(Assign(c, left[k]) for k, c in enumerate(changes))]
