"""The stopping rule of every loop over implicit equations, in its one place.

A sweep changes the unknowns by at most ``change``; ``scale`` is their largest. With the sweep before it, of
change ``previous``, the rate of convergence is change/previous. The rule has three ways to end a loop:

- *close*: the change is at rounding, and the next one, change times rate, is below half a unit of the last
  place. One small change alone proves nothing: a slow iteration makes small changes far from the solution.
- *still*: the change has stopped to fall, and is near rounding. Rounding then is all that moves the unknowns.
- *lost*: it has stopped to fall, and what it moves the state by, h times itself, is lost in rounding there.
  Unknowns that are small differences of large numbers never come to rest by their own measure.

No number is small or large as such: a motion that is scaled makes the same sweeps, and what diverges is not
taken for still because it is small yet. A change that is no number ends a loop with NOT_FINITE.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.kernel import LOST, SLOWEST, VARIED, Loop
from codegen.run.language import Assign, If, Statement
from codegen.run.places import Place
from codegen.run.plan import STEP, Plan
from codegen.run.statistics import SWEEPS
from codegen.run.terms import (
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    both,
    code,
    either,
    flag,
    greatest,
    is_finite,
    largest,
    negated,
    number,
    paired,
    real,
    select,
    size,
)

LEAST_RATE = 2.0**-13
"""No rate is trusted to be smaller where the last change is made too: its own errors are of that size."""

FOUR_ROUNDINGS = 2.0**-50
"""Of the sum of the unknowns: where residuals are compared, a change is a sum of sizes, too."""

CHANGE, SCALE = real("change"), real("scale")


@dataclass(frozen=True)
class Stopping:
    """The rule for one loop, the ``number``-th of its kernel."""

    plan: Plan
    loop: Loop
    number: int
    places: tuple[Place, ...]

    @property
    def previous(self) -> Term:
        """The change of the sweep before, 0 in the first one."""
        return real(f"previous_{self.number}")

    @property
    def rate(self) -> Term:
        """The rate of convergence as far as it is known: at first that of the step before."""
        return real(f"rate_{self.number}")

    @property
    def kept_rate(self) -> Term:
        """Where a step leaves the rate for the next."""
        return self.plan.memory.field(f"rate_{self.number}")

    @cached_property
    def warm(self) -> bool:
        """Whether the loop begins where solutions of earlier steps lead."""
        return not self.loop.starts

    def before(self) -> list[Statement]:
        """Return what stands before the first sweep."""
        sequence: list[Statement] = [Assign(self.previous, number(0.0))]
        if self.warm:
            known = self.plan.memory.field("known", Kind.COUNT) > 0
            sequence.append(Assign(self.rate, select(known, self.kept_rate, 1.0)))
        return sequence

    def measured(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that measure a sweep: the changes are absolute values."""
        return [
            Assign(CHANGE, greatest(changes)),
            Assign(SCALE, greatest(map(size, unknowns))),
        ]

    def rates(self) -> list[Statement]:
        """Return the statements that note how far off the guess was, and the rate."""
        if not self.warm:
            return []
        first = self.plan.memory.field("first")
        return [
            If(SWEEPS.equals(1), (Assign(first, greatest([first, CHANGE])),)),
            If(
                self.previous > 0.0, (Assign(self.rate, greatest([CHANGE / self.previous, number(SLOWEST)])),)
            ),
        ]

    def settled(self) -> list[Statement]:
        """Return the statements that set the flag ``settled``."""
        form, previous = self.plan.format, self.previous
        close, tolerance = (form.scaled(x) for x in (self.loop.close, self.loop.tolerance))
        next_change = (
            CHANGE * self.rate <= form.unit * SCALE
            if self.warm
            else CHANGE * CHANGE <= form.unit * SCALE * previous
        )
        still = both(previous > 0.0, CHANGE >= previous)
        return [
            Assign(flag("still"), still),
            Assign(flag("close"), both(CHANGE <= close * SCALE, next_change)),
            Assign(
                flag("settled"),
                either(flag("close"), both(flag("still"), either(CHANGE <= tolerance * SCALE, self.lost()))),
            ),
        ]

    def lost(self) -> Term:
        """Return whether a change is lost in every block of the state, or of its variation."""
        varied, bound = self.loop.label.startswith(VARIED), self.plan.format.scaled(LOST)
        moved = CHANGE * size(STEP)
        tests = [
            moved <= bound * largest(place.term)
            for place in self.places
            if varied == (place.array == "vector")
        ]
        return both(*tests)

    def sums(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that measure a sweep over residuals, by sums of absolute values."""
        return [
            Assign(CHANGE, paired(map(size, changes))),
            Assign(SCALE, paired(map(size, unknowns))),
        ]

    def settled_by_residuals(self) -> list[Statement]:
        """Return the statements that set the flag ``settled`` where residuals are made to vanish.

        The matrix is good to first order in h, so that the rate of the step before holds in the first sweep.
        A loop that contracts ends where the next change would be below four roundings of the sum of the
        unknowns; one that does not, where it stands still or nothing is felt, and never in its first sweep.
        """
        form, rate = self.plan.format, self.rate
        close, tolerance = (form.scaled(x) for x in (FOUR_ROUNDINGS, self.loop.tolerance))
        first = self.plan.memory.field("first")
        return [
            If(
                self.previous > 0.0,
                (Assign(rate, CHANGE / self.previous),),
                (Assign(first, first + CHANGE),),
            ),
            Assign(flag("contracts"), rate < 0.5),
            Assign(
                flag("settled"),
                select(
                    flag("contracts"),
                    CHANGE * (rate + LEAST_RATE) <= close * SCALE,
                    both(SWEEPS > 1, either(CHANGE <= tolerance * SCALE, self.lost())),
                ),
            ),
        ]

    def decided(self, finite: Term, possible: Term | None = None) -> Statement:
        """Return the statement that makes a status of the flag; ``finite`` must be a number for any.

        ``possible`` is false where a matrix has no inverse: what looks settled then is not.
        """
        # The number comes first: comparisons with a NaN are false, and would look like another sweep.
        settled = flag("settled") if possible is None else both(possible, flag("settled"))
        settling = select(settled, code(OK), code(NOT_CONVERGED))
        return Assign(STATUS, select(is_finite(finite), settling, code(NOT_FINITE)))

    def going_on(self, astray: Term | None = None) -> Term:
        """Return whether another sweep is to be made."""
        tests = [STATUS.equals(code(NOT_CONVERGED)), SWEEPS < self.loop.limit]
        return both(*tests, *([] if astray is None else [negated(astray)]))

    def after(self) -> list[Statement]:
        """Return what stands after the last sweep, which has succeeded.

        A rate that was not measured, as the first sweep was the last, counts double from step to step.
        """
        if not self.warm:
            return []
        compared = self.loop.newton is not None and self.loop.newton.residuals
        kept = self.rate if compared else select(SWEEPS > 1, self.rate, 2.0 * self.rate)
        return [Assign(self.kept_rate, kept)]
