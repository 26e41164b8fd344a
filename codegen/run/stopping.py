"""The stopping rule for all loops over implicit equations.

``change`` is the largest change of an unknown in a sweep, ``scale`` the largest absolute value of an unknown.
``previous`` is the change of the sweep before, so the rate of convergence is change/previous. A loop ends if
it is

- *close*: the change is at rounding level, and the predicted next change, change times rate, is below half a
  unit in the last place. A small change alone proves nothing: a slow iteration makes small changes far from
  the solution.
- *still*: the change no longer decreases and is near rounding level, so that it consists of rounding errors.
- *lost*: the change no longer decreases, and its effect on the state, h times the change, is below the
  rounding errors of the state. Unknowns that are small differences of large numbers never reach rounding
  level themselves.

All tests are relative: a scaled motion takes the same sweeps, and a diverging iteration is not accepted
because its values are still small. A change that is not finite ends a loop with NOT_FINITE.

A stopping test by rate times change is that of Hairer and Wanner, Solving Ordinary Differential Equations II,
section IV.8.
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
"""Added to the rate: the last change is applied too, and its own relative errors have this size."""

FOUR_ROUNDINGS = 2.0**-50
"""Four roundings, relative to the sum of the unknowns; for residuals, a change is such a sum too."""

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
        """The change of the sweep before; 0 in the first sweep."""
        return real(f"previous_{self.number}")

    @property
    def rate(self) -> Term:
        """The rate of convergence; in the first sweep that of the step before."""
        return real(f"rate_{self.number}")

    @property
    def kept_rate(self) -> Term:
        """The rate that a step stores for the next."""
        return self.plan.memory.field(f"rate_{self.number}")

    @cached_property
    def warm(self) -> bool:
        """Whether the loop has a warm start."""
        return not self.loop.starts

    def before(self) -> list[Statement]:
        """Return the statements before the first sweep."""
        sequence: list[Statement] = [Assign(self.previous, number(0.0))]
        if self.warm:
            known = self.plan.memory.field("known", Kind.COUNT) > 0
            # Between steps of equal size the rate hardly changes, so the old one lets the first
            # sweep be the last (Hairer and Wanner start with the old rate for the same reason).
            # Rate 1 is pessimistic: only a change at rounding level ends the first sweep.
            sequence.append(Assign(self.rate, select(known, self.kept_rate, 1.0)))
        return sequence

    def measured(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that measure a sweep: the changes are absolute values."""
        return [
            Assign(CHANGE, greatest(changes)),
            Assign(SCALE, greatest(map(size, unknowns))),
        ]

    def rates(self) -> list[Statement]:
        """Return the statements that store the error of the initial guess, and the rate."""
        if not self.warm:
            return []
        first = self.plan.memory.field("first")
        return [
            # The first change measures the error of the initial guess. A step may have several
            # loops, and the warm start judges all by the worst.
            If(SWEEPS.equals(1), (Assign(first, greatest([first, CHANGE])),)),
            If(
                # Near rounding level a quotient of changes may be tiny by accident.
                self.previous > 0.0,
                (Assign(self.rate, greatest([CHANGE / self.previous, number(SLOWEST)])),),
            ),
        ]

    def converged(self) -> list[Statement]:
        """Return the statements that set the flag ``converged``."""
        # Tolerances are multiples of the unit roundoff: single precision needs fewer sweeps.
        form, previous = self.plan.format, self.previous
        close, tolerance = (form.scaled(x) for x in (self.loop.close, self.loop.tolerance))
        # A small change proves nothing by itself; the predicted next change, rate times change,
        # must be below rounding. Without a stored rate the test is change^2 <= bound * previous,
        # which needs no division; previous = 0 in the first sweep then accepts a zero change only.
        next_change = (
            CHANGE * self.rate <= form.unit * SCALE
            if self.warm
            else CHANGE * CHANGE <= form.unit * SCALE * previous
        )
        # Rounding errors can keep the change above every bound. Then it stops decreasing, and more
        # sweeps are useless; ``tolerance`` distinguishes this from divergence.
        still = both(previous > 0.0, CHANGE >= previous)
        return [
            Assign(flag("still"), still),
            Assign(flag("close"), both(CHANGE <= close * SCALE, next_change)),
            Assign(
                flag("converged"),
                either(flag("close"), both(flag("still"), either(CHANGE <= tolerance * SCALE, self.lost()))),
            ),
        ]

    def lost(self) -> Term:
        """Return the test that a change is below the rounding of every block of the state or variation."""
        # A variation does not act on the state, so its equations are compared with the variation
        # itself.
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

    def converged_by_residuals(self) -> list[Statement]:
        """Return the statements that set the flag ``converged`` for a loop over residuals.

        The matrix is exact to first order in h, so the rate of the step before is valid in the first sweep. A
        contracting loop ends if the predicted next change is below four roundings of the sum of the unknowns.
        Another loop ends if its change is small or below the rounding of the state, never in the first sweep.
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
            # The estimate by rate and change is reliable only if the iteration contracts clearly.
            Assign(flag("contracts"), rate < 0.5),
            Assign(
                flag("converged"),
                select(
                    flag("contracts"),
                    CHANGE * (rate + LEAST_RATE) <= close * SCALE,
                    # One sweep that does not contract says nothing about the distance to the
                    # solution.
                    both(SWEEPS > 1, either(CHANGE <= tolerance * SCALE, self.lost())),
                ),
            ),
        ]

    def decided(self, finite: Term, possible: Term | None = None) -> Statement:
        """Return the statement that converts the flag to a status, NOT_FINITE unless ``finite`` is finite.

        ``possible`` is false if the matrix is singular; the flag is then meaningless.
        """
        # Test for finiteness first: all comparisons with a NaN are false, so the flag would ask for more
        # sweeps.
        converged = flag("converged") if possible is None else both(possible, flag("converged"))
        outcome = select(converged, code(OK), code(NOT_CONVERGED))
        return Assign(STATUS, select(is_finite(finite), outcome, code(NOT_FINITE)))

    def going_on(self, astray: Term | None = None) -> Term:
        """Return the test for another sweep."""
        # The limit is a safeguard for iterations that contract too slowly; the continuation then
        # takes over.
        tests = [STATUS.equals(code(NOT_CONVERGED)), SWEEPS < self.loop.limit]
        return both(*tests, *([] if astray is None else [negated(astray)]))

    def after(self) -> list[Statement]:
        """Return the statements after a loop that has succeeded.

        One sweep measures no rate. The old rate is then doubled, so that after some steps a second sweep
        follows.
        """
        if not self.warm:
            return []
        compared = self.loop.newton is not None and self.loop.newton.residuals
        kept = self.rate if compared else select(SWEEPS > 1, self.rate, 2.0 * self.rate)
        return [Assign(self.kept_rate, kept)]
