"""Loops over implicit equations: fixed points u = g(u), and Newton's method in its three forms.

A sweep computes the images of the unknowns. A fixed point takes the images for the unknowns; the values of
the last sweep so belong to unknowns that are known to agree with their images. Newton's method adds the
residuals times the inverse of a matrix, in the last sweep too:

- *Newton*: the exact matrix is made in the first sweep of all and kept, from sweep to sweep and from step to
  step, until a change is not smaller than ``Newton.CONTRACTION`` times the one before it. A matrix just made
  that gives no smaller change, or that has no inverse, means that the loop has gone astray.
- *chord*: the matrix to first order in h is cheap enough to be made before the sweeps of each step.
- *residuals*: the matrix to first order in h of what is to vanish, kept for ``Newton.period`` steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.kernel import CHORD, NEWTON, Newton
from codegen.kernel.schedule import METHODS, Iteration
from codegen.run.language import Array, Assign, Call, For, If, Note, Return, Statement, While
from codegen.run.places import places
from codegen.run.plan import Plan
from codegen.run.statistics import SWEEPS, count_matrix, count_sweeps
from codegen.run.stopping import CHANGE, Stopping
from codegen.run.terms import (
    NOT_CONVERGED,
    OK,
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
"""The most unknowns for which each entry of a matrix stands in a statement of its own."""

WIDEST = 20
"""The most unknowns of a fixed point for which each stands in a statement of its own."""


def sweeps(plan: Plan, iteration: Iteration, counting: bool) -> list[Statement]:
    """Return the statements of one loop, up to what ends the function where it fails."""
    newton = iteration.loop.newton
    if newton is None:
        return _FixedPoint(plan, iteration, counting).statements()
    return _Newton(plan, iteration, counting).statements()


@dataclass(frozen=True)
class _Loop:
    """What fixed points and Newton's method have in common; ``counting`` is off where nobody asks."""

    plan: Plan
    iteration: Iteration
    counting: bool

    @cached_property
    def rule(self) -> Stopping:
        """The stopping rule."""
        return Stopping(self.plan, self.iteration.loop, self.number, places(self.plan.kernel))

    @property
    def number(self) -> int:
        """Which loop of the kernel this is."""
        return self.iteration.number

    @property
    def unknowns(self) -> list[Term]:
        """The unknowns."""
        return [own(u) for u in self.iteration.loop.unknowns]

    @cached_property
    def images(self) -> list[Term]:
        """What the images are called: those that have names keep them."""
        loop = self.iteration.loop
        return [
            own(x.payload) if x.op == "sym" and x.payload not in loop.unknowns else own(f"next {u}")
            for u, x in zip(loop.unknowns, self.iteration.images, strict=True)
        ]

    def named(self, word: str) -> list[Term]:
        """Return a name for each unknown."""
        return [own(f"{word} {u}") for u in self.iteration.loop.unknowns]

    def begin(self) -> list[Statement]:
        """Return what stands before the first sweep."""
        loop = self.iteration.loop
        sequence: list[Statement] = [
            Note(f"{loop.label}: {METHODS[loop.solver]}, {len(loop.unknowns)} unknowns")
        ]
        starts = zip(self.unknowns, self.iteration.starts, strict=False)  # none where they begin together
        sequence += [Assign(u, value(x)) for u, x in starts]
        return [*sequence, *self.rule.before()]

    def computed(self) -> list[Statement]:
        """Return the body of a sweep and its images."""
        sequence: list[Statement] = [Assign(SWEEPS, SWEEPS + 1)]
        for statement in self.iteration.body:
            sequence += simple(statement)
        for image, x in zip(self.images, self.iteration.images, strict=True):
            if image.text.startswith("next "):
                sequence.append(Assign(image, value(x)))
        return sequence

    def until_settled(self, body: Sequence[Statement], astray: Term | None = None) -> list[Statement]:
        """Return the loop and what follows it."""
        sequence: list[Statement] = [Assign(SWEEPS, whole(0)), Assign(STATUS, code(NOT_CONVERGED))]
        sequence.append(While(self.rule.going_on(astray), tuple(body), at_least_once=True))
        if self.counting:
            sequence.append(count_sweeps(self.plan, self.number - 1))
        sequence.append(If(STATUS.differs(code(OK)), (Return(STATUS),)))
        return [*sequence, *self.rule.after()]


class _FixedPoint(_Loop):
    """u = g(u), taken as it stands."""

    def statements(self) -> list[Statement]:
        """Return the statements of the loop."""
        many = len(self.unknowns) > WIDEST
        measured, finite = self.wide() if many else self.narrow()
        rule, body = self.rule, self.computed()
        body += [*measured, *rule.rates(), *rule.settled(), rule.decided(finite)]
        taken = [Assign(u, x) for u, x in zip(self.unknowns, self.images, strict=True)]
        # The last sweep leaves the unknowns as they were: body values that are read later belong to them.
        again = (Assign(rule.previous, CHANGE), *taken)
        body.append(If(STATUS.equals(code(NOT_CONVERGED)), again))
        return [*self.begin(), *self.until_settled(body)]

    def narrow(self) -> tuple[list[Statement], Term]:
        """Return the statements that measure each change, and what is finite if all are."""
        changes = self.named("change")
        sequence: list[Statement] = [
            Assign(change, size(x - u))
            for change, x, u in zip(changes, self.images, self.unknowns, strict=True)
        ]
        return [*sequence, *self.rule.measured(changes, self.unknowns)], total(changes)

    def wide(self) -> tuple[list[Statement], Term]:
        """Return the same of many unknowns, by a loop over arrays."""
        n, k, i = len(self.unknowns), self.number, count("i")
        before, after = real(f"unknowns_{k}", n), real(f"images_{k}", n)
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
    """u + M^-1 (g(u) - u), or u + M^-1 r(u) where the images are residuals."""

    @property
    def newton(self) -> Newton:
        """The matrix."""
        assert self.iteration.loop.newton is not None
        return self.iteration.loop.newton

    @property
    def kept(self) -> bool:
        """Whether the matrix is kept from step to step."""
        return self.iteration.loop.solver == NEWTON

    @property
    def making(self) -> Term:
        """Whether a matrix is to be computed in this sweep."""
        return flag(f"make_{self.number}")

    @property
    def served(self) -> Term:
        """For how many steps the matrix of the memory has served, 0 where there is none."""
        return self.plan.memory.field(f"made_{self.number}", Kind.COUNT)

    @cached_property
    def inverse(self) -> Term:
        """The inverse by rows."""
        n = len(self.unknowns)
        name = f"inverse_{self.number}"
        return self.plan.memory.field(name, Kind.REAL, (n * n,)) if self.kept else real(name, n * n)

    def statements(self) -> list[Statement]:
        """Return the statements of the loop."""
        return self.by_residuals() if self.newton.residuals else self.by_images()

    def by_images(self) -> list[Statement]:
        """Return the loop where images are compared with unknowns."""
        rule, residuals, changes = self.rule, self.named("residual"), self.named("change")
        sequence, body = self.begin(), self.computed()
        for residual, x, u in zip(residuals, self.images, self.unknowns, strict=True):
            body.append(Assign(residual, x - u))
        finite = total(residuals)
        if self.kept:
            sequence.append(Assign(self.making, negated(self.served > 0)))
            sequence.append(Assign(flag("astray"), truth(False)))
            body.append(If(both(self.making, is_finite(finite)), tuple(self.renewed())))
        else:
            sequence += self.prepared()
        body += self.product(changes, residuals)
        body += rule.measured([size(x) for x in changes], self.unknowns)
        body += rule.rates()
        # Scale is measured before the correction: a first guess of zero then is not close to anything.
        body += self.corrected(changes)
        body += rule.settled()
        body.append(rule.decided(finite, self.served > 0 if self.kept and not self.newton.inverted else None))
        if self.kept:
            astray = both(flag("still"), self.making)
            if not self.newton.inverted:
                astray = either(astray, negated(self.served > 0))
            body.append(Assign(flag("astray"), astray))
            slow = number(Newton.CONTRACTION) * rule.previous
            body.append(Assign(self.making, both(slow > 0.0, CHANGE > slow)))
        body.append(Assign(rule.previous, CHANGE))
        return [*sequence, *self.until_settled(body, flag("astray") if self.kept else None)]

    def by_residuals(self) -> list[Statement]:
        """Return the loop where the images are what is to vanish."""
        rule, changes = self.rule, [own(c) for c in self.newton.changes]
        sequence, body = self.begin(), self.computed()
        inverted = not self.newton.inverted
        sequence.append(Assign(self.making, negated(self.served > 0)))
        body.append(If(self.making, tuple(self.renewed())))
        body += self.product(changes, self.images)
        body += rule.sums(changes, self.unknowns)
        body += self.corrected(changes)
        body += rule.settled_by_residuals()
        body.append(rule.decided(CHANGE, self.served > 0 if inverted else None))
        # A second matrix in one step would cost more than the sweeps that it saves.
        body.append(Assign(self.making, truth(False)))
        body.append(Assign(rule.previous, CHANGE))
        return [*sequence, *self.until_settled(body, negated(self.served > 0) if inverted else None)]

    def corrected(self, changes: Sequence[Term]) -> list[Statement]:
        """Return the statements that add the changes."""
        return [Assign(u, u + c) for u, c in zip(self.unknowns, changes, strict=True)]

    def renewed(self) -> list[Statement]:
        """Return the statements that make the matrix of the memory and invert it."""
        sequence = self.entries()
        if self.newton.inverted:
            return [*sequence, Assign(self.served, whole(1)), *self.matrix_counted()]
        sequence.append(Call("invert", (whole(len(self.unknowns)), self.inverse), (self.served,)))
        counted = self.matrix_counted()
        return [*sequence, *([If(self.served > 0, tuple(counted))] if counted else [])]

    def matrix_counted(self) -> list[Statement]:
        """Return the statement that counts a matrix."""
        return [count_matrix(self.plan)] if self.counting else []

    def prepared(self) -> list[Statement]:
        """Return the statements that make the matrix of one step and invert it, before its sweeps."""
        sequence = self.entries()
        if self.newton.inverted:
            return sequence
        n, inverted = len(self.unknowns), count(f"inverted_{self.number}")
        sequence = [Array(self.inverse), *sequence, Call("invert", (whole(n), self.inverse), (inverted,))]
        sequence.append(Assign(STATUS, code(NOT_CONVERGED)))
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
            return [*sequence, Array(whole_matrix, tuple(matrix)), Assign(self.inverse, whole_matrix)]
        return [*sequence, *(Assign(self.cell(k), x) for k, x in enumerate(matrix))]

    def cell(self, place: int) -> Term:
        """Return an entry of the inverse: a variable where it is written out in each step."""
        if self.iteration.loop.solver == CHORD and self.newton.inverted:
            return real(f"inverse_{self.number}_{place}")
        return self.inverse[place]

    def product(self, changes: Sequence[Term], residuals: Sequence[Term]) -> list[Statement]:
        """Return the statements of changes = inverse residuals: a sum for each row, or loops over many."""
        n = len(changes)
        if n <= WIDE:
            rows = [[self.cell(i * n + j) * r for j, r in enumerate(residuals)] for i in range(n)]
            return [Assign(c, paired(row)) for c, row in zip(changes, rows, strict=True)]
        i, j, partial = count("i"), count("j"), real("sum")
        right, left = real(f"residuals_{self.number}", n), real(f"changes_{self.number}", n)
        row = (
            Assign(partial, number(0.0)),
            For(j, whole(n), (Assign(partial, partial + self.inverse[n * i + j] * right[j]),)),
            Assign(left[i], partial),
        )
        sequence: list[Statement] = [Array(right, tuple(residuals)), Array(left), For(i, whole(n), row)]
        return [*sequence, *(Assign(c, left[k]) for k, c in enumerate(changes))]
