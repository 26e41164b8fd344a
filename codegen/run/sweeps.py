"""Loops over implicit equations: fixed-point iteration for u = g(u), and Newton's method in three forms.

A sweep computes the components of g(u), which are called the images of the unknowns u. Fixed-point iteration
replaces the unknowns by the images, except in the last sweep. Values computed in the last sweep therefore
belong to the accepted unknowns. Newton's method adds the inverse of a matrix times the residuals to the
unknowns, also in the last sweep. The three forms of Newton's method use different matrices:

- *Newton*: the exact matrix is stored from sweep to sweep and from step to step, until a change exceeds
  ``Newton.CONTRACTION`` times the previous change. If no matrix is stored yet, the first sweep computes it.
  The loop fails if the change does not decrease right after the matrix was computed, or if the matrix is
  singular.
- *simplified Newton*: the matrix, correct to first order in h, is computed before the sweeps of each step.
- *residuals*: the matrix of residual equations r(u) = 0, correct to first order in h, is stored for
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
    OK,
    SINGULAR,
    STATUS,
    Kind,
    Term,
    both,
    code,
    count,
    either,
    flag,
    greatest,
    is_finite,
    negated,
    number,
    own,
    paired,
    real,
    size,
    total,
    truth,
    value,
    whole,
)
from codegen.run.values import simple

WIDE = 12
"""The largest number of unknowns for which each entry of a matrix is computed by a separate statement."""

WIDEST = 20
"""The largest number of unknowns for which fixed-point iteration computes each change by a separate
statement."""


def sweeps(plan: Plan, iteration: Iteration, counting: bool) -> list[Statement]:
    """Return the statements of one loop.

    If the loop fails, the emitted function returns the status of the loop. If ``counting`` is True, sweeps
    are counted in the statistics.
    """
    newton = iteration.loop.newton
    if newton is None:
        return _FixedPoint(plan, iteration, counting).statements()
    return _Newton(plan, iteration, counting).statements()


@dataclass(frozen=True)
class _Loop:
    """The common part of fixed-point iteration and Newton's method. With ``counting``, sweeps are counted."""

    plan: Plan
    iteration: Iteration
    counting: bool

    @cached_property
    def rule(self) -> Stopping:
        """The stopping rule."""
        return Stopping(self.plan, self.iteration.loop, self.number, places(self.plan.kernel))

    @property
    def number(self) -> int:
        """The number of the loop in the kernel. The first loop has the number 1."""
        return self.iteration.number

    @property
    def unknowns(self) -> list[Term]:
        """The unknowns of the loop, as terms."""
        return [own(u) for u in self.iteration.loop.unknowns]

    @cached_property
    def images(self) -> list[Term]:
        """The names of the images.

        An image that is already a variable keeps its name. The name of any other image is ``next`` followed
        by the name of the unknown.
        """
        loop = self.iteration.loop
        return [
            own(x.payload) if x.op == "sym" and x.payload not in loop.unknowns else own(f"next {u}")
            for u, x in zip(loop.unknowns, self.iteration.images, strict=True)
        ]

    def named(self, word: str) -> list[Term]:
        """Return a new name for each unknown: ``word`` followed by the name of the unknown."""
        return [own(f"{word} {u}") for u in self.iteration.loop.unknowns]

    def begin(self) -> list[Statement]:
        """Return the statements before the first sweep."""
        loop = self.iteration.loop
        sequence: list[Statement] = [
            Note(f"{loop.label}: {METHODS[loop.solver]}, {len(loop.unknowns)} unknowns")
        ]
        # With a warm start, ``starts`` is empty, because the initial guess is computed before the loop.
        starts = zip(self.unknowns, self.iteration.starts, strict=False)
        sequence += [Assign(u, value(x)) for u, x in starts]
        return [*sequence, *self.rule.before()]

    def computed(self) -> list[Statement]:
        """Return the statements of a sweep that compute the images."""
        sequence: list[Statement] = [Assign(SWEEPS, SWEEPS + 1)]
        for statement in self.iteration.body:
            sequence += simple(statement)
        # All images are computed before any unknown changes (a Jacobi sweep), so the order of the equations
        # has no effect.
        for image, x in zip(self.images, self.iteration.images, strict=True):
            if image.text.startswith("next "):
                sequence.append(Assign(image, value(x)))
        return sequence

    def until_converged(
        self, body: Sequence[Statement], astray: Term | None = None, singular: Term | None = None
    ) -> list[Statement]:
        """Return the loop and the statements after it.

        The loop ends with a failure if the test ``astray`` is true. If the loop has failed and the test
        ``singular`` is true, the status is SINGULAR.
        """
        # The loop continues as long as the status is NOT_CONVERGED. Array languages cannot leave a loop from
        # its middle, so a change of the status ends the loop. If the loop reaches its limit of sweeps, the
        # status is still NOT_CONVERGED.
        sequence: list[Statement] = [Assign(SWEEPS, whole(0)), Assign(STATUS, code(NOT_CONVERGED))]
        sequence.append(While(self.rule.going_on(astray), tuple(body), at_least_once=True))
        if singular is not None:
            unsolved = both(STATUS.differs(code(OK)), singular)
            sequence.append(If(unsolved, (Assign(STATUS, code(SINGULAR)),)))
        if self.counting:
            # The sweeps are counted before the function returns a failure, so that the statistics name the
            # block that failed.
            sequence.append(count_sweeps(self.plan, self.number - 1))
        sequence.append(If(STATUS.differs(code(OK)), (Return(STATUS),)))
        return [*sequence, *self.rule.after()]


class _FixedPoint(_Loop):
    """Fixed-point iteration for u = g(u)."""

    def statements(self) -> list[Statement]:
        """Return the statements of the loop."""
        # The number of separate statements grows with the number of unknowns. For more than WIDEST unknowns,
        # loops over arrays replace these statements.
        many = len(self.unknowns) > WIDEST
        measured, finite = self.wide() if many else self.narrow()
        rule, body = self.rule, self.computed()
        body += [*measured, *rule.rates(), *rule.converged(), rule.decided(finite)]
        taken = [Assign(u, x) for u, x in zip(self.unknowns, self.images, strict=True)]
        # Statements after the loop read values that the last sweep computed. The last sweep does not change
        # the unknowns, so these values belong to the accepted unknowns. A branch is used and not a select,
        # because the branch copies nothing after convergence.
        again = (Assign(rule.previous, CHANGE), *taken)
        body.append(If(STATUS.equals(code(NOT_CONVERGED)), again))
        return [*self.begin(), *self.until_converged(body)]

    def narrow(self) -> tuple[list[Statement], Term]:
        """Return the statements that compute the changes, and the sum of the changes."""
        changes = self.named("change")
        sequence: list[Statement] = [
            Assign(change, size(x - u))
            for change, x, u in zip(changes, self.images, self.unknowns, strict=True)
        ]
        # CHANGE is a maximum, and `a > b ? a : b` may lose a NaN. A sum of absolute values keeps NaNs, and
        # its infinities cannot cancel.
        return [*sequence, *self.rule.measured(changes, self.unknowns)], total(changes)

    def wide(self) -> tuple[list[Statement], Term]:
        """Return the same results as :meth:`narrow`. Loops over arrays replace the separate statements."""
        n, k, i = len(self.unknowns), self.number, count("i")
        before, after = real(f"unknowns_{k}", n), real(f"images_{k}", n)
        # The maximum may lose a NaN, so the sum of all changes is also computed.
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
    """Newton's method: u becomes u + M^-1 (g(u) - u), or u + M^-1 r(u) if the images are residuals r(u)."""

    @property
    def newton(self) -> Newton:
        """The matrix of Newton's method, as the kernel describes it."""
        assert self.iteration.loop.newton is not None
        return self.iteration.loop.newton

    @property
    def kept(self) -> bool:
        """True if the matrix is stored from step to step."""
        return self.iteration.loop.solver == NEWTON

    @property
    def making(self) -> Term:
        """The flag that is true if this sweep computes a matrix."""
        return flag(f"make_{self.number}")

    @property
    def age(self) -> Term:
        """The age of the matrix in the memory, in steps; 0 without a matrix."""
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
        """Return the loop over u = g(u), with residuals g(u) - u."""
        rule, residuals, changes = self.rule, self.named("residual"), self.named("change")
        sequence, body = self.begin(), self.computed()
        for residual, x, u in zip(residuals, self.images, self.unknowns, strict=True):
            body.append(Assign(residual, x - u))
        finite = total(residuals)
        if self.kept:
            # The age 0 means that the memory contains no matrix.
            sequence.append(Assign(self.making, negated(self.age > 0)))
            sequence.append(Assign(flag("astray"), truth(False)))
            # No matrix is computed from unknowns that are not finite, because such a matrix would replace a
            # good matrix in the memory.
            body.append(If(both(self.making, is_finite(finite)), tuple(self.renewed())))
        else:
            sequence += self.prepared()
        body += self.product(changes, residuals)
        body += rule.measured([size(x) for x in changes], self.unknowns)
        body += rule.rates()
        # ``SCALE`` is measured before the correction, so it is zero if the initial guess is zero. Then every
        # change is large in comparison with ``SCALE``.
        body += self.corrected(changes)
        body += rule.converged()
        # ``invert`` sets the age to 1 on success and to 0 for a singular matrix. If the matrix is singular,
        # small changes are no sign of convergence.
        body.append(rule.decided(finite, self.age > 0 if self.kept and not self.newton.inverted else None))
        if self.kept:
            # If the change does not decrease although the matrix is exact at the current unknowns, more
            # sweeps cannot help. The step then needs a better initial guess, which the continuation provides.
            stalled = both(flag("still"), self.making)
            if not self.newton.inverted:
                stalled = either(stalled, negated(self.age > 0))
            body.append(Assign(flag("astray"), stalled))
            # If the contraction is slow, a new matrix costs less than many more sweeps. In the first sweep
            # the contraction is not known yet, so ``previous`` is 0 and no new matrix is requested.
            slow = number(Newton.CONTRACTION) * rule.previous
            body.append(Assign(self.making, both(slow > 0.0, CHANGE > slow)))
        body.append(Assign(rule.previous, CHANGE))
        astray = flag("astray") if self.kept else None
        eliminated = self.kept and not self.newton.inverted
        return [*sequence, *self.until_converged(body, astray, self.singular() if eliminated else None)]

    def singular(self) -> Term:
        """Return the test whether the matrix in the memory is singular. The test is made after a failure.

        Only loops that invert their matrix by elimination use this test. If a small matrix is singular, the
        formula for its inverse divides by zero, and the status is NOT_FINITE.
        """
        return both(STATUS.equals(code(NOT_CONVERGED)), negated(self.age > 0))

    def by_residuals(self) -> list[Statement]:
        """Return the loop over equations r(u) = 0. The images are the residuals r(u)."""
        rule, changes = self.rule, [own(c) for c in self.newton.changes]
        sequence, body = self.begin(), self.computed()
        inverted = not self.newton.inverted
        # The age is 0 if there is no matrix yet, or if the last matrix was used for its whole period.
        sequence.append(Assign(self.making, negated(self.age > 0)))
        body.append(If(self.making, tuple(self.renewed())))
        body += self.product(changes, self.images)
        body += rule.sums(changes, self.unknowns)
        body += self.corrected(changes)
        body += rule.converged_by_residuals()
        body.append(rule.decided(CHANGE, self.age > 0 if inverted else None))
        # At most one matrix is computed in a step. A second matrix would cost more than the sweeps that it
        # saves.
        body.append(Assign(self.making, truth(False)))
        body.append(Assign(rule.previous, CHANGE))
        astray = negated(self.age > 0) if inverted else None
        return [*sequence, *self.until_converged(body, astray, self.singular() if inverted else None)]

    def corrected(self, changes: Sequence[Term]) -> list[Statement]:
        """Return the statements that add the changes to the unknowns."""
        return [Assign(u, u + c) for u, c in zip(self.unknowns, changes, strict=True)]

    def renewed(self) -> list[Statement]:
        """Return the statements that compute and invert a new matrix for the memory."""
        sequence = self.entries()
        if self.newton.inverted:
            return [*sequence, Assign(self.age, whole(1)), *self.matrix_counted()]
        # Computing the inverse costs more than a factorisation. However, the inverse is used in many sweeps,
        # and a product with the inverse is faster than forward and back substitution.
        sequence.append(Call("invert", (whole(len(self.unknowns)), self.inverse), (self.age,)))
        counted = self.matrix_counted()
        return [*sequence, *([If(self.age > 0, tuple(counted))] if counted else [])]

    def matrix_counted(self) -> list[Statement]:
        """Return the statement that counts a matrix in the statistics; [] if nothing is counted."""
        return [count_matrix(self.plan)] if self.counting else []

    def prepared(self) -> list[Statement]:
        """Return the statements that compute and invert the matrix of one step, before its sweeps.

        If the matrix is singular, the emitted function returns the status SINGULAR.
        """
        sequence = self.entries()
        if self.newton.inverted:
            return sequence
        n, inverted = len(self.unknowns), count(f"inverted_{self.number}")
        sequence = [Array(self.inverse), *sequence, Call("invert", (whole(n), self.inverse), (inverted,))]
        # The function that counts sweeps records a failure if the status is not OK, so the status is set
        # first.
        sequence.append(Assign(STATUS, code(SINGULAR)))
        singular = inverted.equals(0)
        if self.counting:
            sequence.append(If(singular, (count_sweeps(self.plan, self.number - 1, whole(0)),)))
        return [*sequence, If(singular, (Return(STATUS),))]

    def entries(self) -> list[Statement]:
        """Return the statements that compute the entries of the matrix."""
        sequence: list[Statement] = []
        for statement in self.iteration.newton:
            sequence += simple(statement)
        n, matrix = len(self.unknowns), [value(x) for x in self.iteration.matrix]
        if n > WIDE:
            whole_matrix = real(f"matrix_{self.number}", n * n)
            # An array initialiser and one copy store the entries, because n^2 separate assignments would make
            # the function very long.
            return [*sequence, Array(whole_matrix, tuple(matrix)), Assign(self.inverse, whole_matrix)]
        return [*sequence, *(Assign(self.cell(k), x) for k, x in enumerate(matrix))]

    def cell(self, place: int) -> Term:
        """Return an entry of the inverse matrix. The entry is a scalar if a formula computes the inverse in
        each step. In all other cases it is an entry of an array.
        """
        if self.iteration.loop.solver == SIMPLIFIED_NEWTON and self.newton.inverted:
            # This inverse is used in one step only, so its entries can be scalars, which a compiler keeps in
            # registers.
            return real(f"inverse_{self.number}_{place}")
        return self.inverse[place]

    def product(self, changes: Sequence[Term], residuals: Sequence[Term]) -> list[Statement]:
        """Return the statements that multiply the inverse matrix by the residuals."""
        n = len(changes)
        if n <= WIDE:
            rows = [[self.cell(i * n + j) * r for j, r in enumerate(residuals)] for i in range(n)]
            # The next sweep waits for this sum. Pairs are added first, which halves the latency of the sum.
            return [Assign(c, paired(row)) for c, row in zip(changes, rows, strict=True)]
        i, j, partial = count("i"), count("j"), real("sum")
        # A loop needs an index, so the separate variables are first copied to an array.
        right, left = real(f"residuals_{self.number}", n), real(f"changes_{self.number}", n)
        row = (
            Assign(partial, number(0.0)),
            For(j, whole(n), (Assign(partial, partial + self.inverse[n * i + j] * right[j]),)),
            Assign(left[i], partial),
        )
        sequence: list[Statement] = [Array(right, tuple(residuals)), Array(left), For(i, whole(n), row)]
        return [*sequence, *(Assign(c, left[k]) for k, c in enumerate(changes))]
