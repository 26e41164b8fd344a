"""The stopping rule for all loops that solve implicit equations.

``change`` is the largest change of an unknown in a sweep, and ``scale`` is the largest absolute value of an
unknown. ``previous`` is the change in the previous sweep. The rate of convergence is change/previous. The
unknowns are accepted in three cases:

- *close*: the change is about as small as the rounding errors, and so is the predicted next change (the
  change times the rate). A small change alone does not prove convergence, because a slow iteration makes
  small changes far from the solution.
- *still*: the change no longer decreases and is nearly as small as the rounding errors. Then only rounding
  errors are left.
- *lost*: the change no longer decreases, and its effect on the state, h times the change, is below the
  rounding errors of the state. This case is needed for unknowns that are small differences of large numbers.
  The rounding errors of the large numbers keep the changes of such an unknown larger than the rounding error
  of the unknown itself.

All tests are relative, so the number of sweeps does not depend on the units of the unknowns. A diverging
iteration is never accepted, even if its values are small. If a change is not finite, the loop ends with the
status NOT_FINITE.

The test of rate times change is taken from Hairer and Wanner, Solving Ordinary Differential Equations II,
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
"""The stopping test of a loop over residuals (equations r(u) = 0) adds this number to the rate of
convergence.

The test multiplies the last change by the sum of the rate and LEAST_RATE. The product estimates the error
that remains in the unknowns, because the relative error of the last change is about LEAST_RATE.
"""

FOUR_ROUNDINGS = 2.0**-50
"""A factor in the stopping test of a loop over residuals (equations r(u) = 0).

The bound in the test is this factor times the sum of the absolute values of the unknowns (see
:meth:`Stopping.converged_by_residuals`). The factor is four times 2^-52, and 2^-52 is the distance between 1
and the next double.
"""

CHANGE, SCALE = real("change"), real("scale")


@dataclass(frozen=True)
class Stopping:
    """The stopping rule for one loop.

    ``number`` is the index of this loop among the loops of the kernel, counted from 1.
    """

    plan: Plan
    loop: Loop
    number: int
    places: tuple[Place, ...]

    @property
    def previous(self) -> Term:
        """The change of the unknowns in the previous sweep; 0 in the first sweep."""
        return real(f"previous_{self.number}")

    @property
    def rate(self) -> Term:
        """The rate of convergence.

        In the first sweep it is the rate that the previous step has stored, or 1 if no rate was stored.
        """
        return real(f"rate_{self.number}")

    @property
    def kept_rate(self) -> Term:
        """The rate of convergence that a step stores for the next step."""
        # Each loop stores its own rate, because the loops of one step converge at different rates.
        return self.plan.memory.field(f"rate_{self.number}")

    @cached_property
    def warm(self) -> bool:
        """True if the loop has a warm start."""
        # Loops without starting values of their own share the warm start of the kernel.
        return not self.loop.starts

    def before(self) -> list[Statement]:
        """Return the statements before the first sweep."""
        sequence: list[Statement] = [Assign(self.previous, number(0.0))]
        if self.warm:
            known = self.plan.memory.field("known", Kind.COUNT) > 0
            # Between steps of equal size the rate hardly changes, so a loop starts with the rate of the
            # previous step, as in the book of Hairer and Wanner. The loop can then end after one sweep. If no
            # rate is stored, the rate is 1. The loop then ends after one sweep only if the change is below
            # the rounding errors.
            sequence.append(Assign(self.rate, select(known, self.kept_rate, 1.0)))
        return sequence

    def measured(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that compute the largest change and the largest absolute value of an unknown.

        ``changes`` contains the absolute values of the changes in a sweep.
        """
        return [
            Assign(CHANGE, greatest(changes)),
            Assign(SCALE, greatest(map(size, unknowns))),
        ]

    def rates(self) -> list[Statement]:
        """Return the statements that store the error of the initial guess and the rate of convergence.

        If the loop has no warm start, the list of statements is empty.
        """
        if not self.warm:
            return []
        first = self.plan.memory.field("first")
        return [
            # The change in the first sweep is a measure of the error of the initial guess. If a step has
            # several loops, the largest of these changes is stored for the warm start.
            If(SWEEPS.equals(1), (Assign(first, greatest([first, CHANGE])),)),
            If(
                # If the changes are as small as rounding errors, their quotient may be tiny by accident, so
                # the rate has a lower bound.
                self.previous > 0.0,
                (Assign(self.rate, greatest([CHANGE / self.previous, number(SLOWEST)])),),
            ),
        ]

    def converged(self) -> list[Statement]:
        """Return the statements that set the flag ``converged``."""
        # The tolerances are multiples of the unit roundoff, so they are larger in single precision.
        form, previous = self.plan.format, self.previous
        close, tolerance = (form.scaled(x) for x in (self.loop.close, self.loop.tolerance))
        # A small change alone does not prove convergence, so the predicted next change must also be small. If
        # no rate is stored, the rate is ``CHANGE / previous``. Both sides of the test are then multiplied by
        # ``previous``, which avoids a division. In the first sweep ``previous`` is 0, so only a change of
        # zero satisfies this test.
        next_change = (
            CHANGE * self.rate <= form.unit * SCALE
            if self.warm
            else CHANGE * CHANGE <= form.unit * SCALE * previous
        )
        # Rounding errors may keep the change above the bounds of the test ``close``. The change then no
        # longer decreases, and more sweeps are useless. In a diverging iteration the change does not decrease
        # either, but it is larger than ``tolerance`` times ``SCALE``.
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
        """Return the term that tests whether h times the change is below the rounding errors of the state.

        If the loop solves equations for a variation (a tangent vector at the state), the product is compared
        with the rounding errors of the variation and not of the state.
        """
        # The solution of equations for a variation does not change the state. It changes only the array
        # ``vector``, which contains the variation.
        varied, bound = self.loop.label.startswith(VARIED), self.plan.format.scaled(LOST)
        moved = CHANGE * size(STEP)
        tests = [
            moved <= bound * largest(place.term)
            for place in self.places
            if varied == (place.array == "vector")
        ]
        return both(*tests)

    def sums(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that sum the absolute values of the changes and of the unknowns.

        A loop over residuals (equations r(u) = 0) uses them in place of the statements of :meth:`measured`.
        """
        return [
            # A sum that contains a NaN is NaN, but a maximum may lose a NaN. With a sum, no other test for
            # finite numbers is needed.
            Assign(CHANGE, paired(map(size, changes))),
            Assign(SCALE, paired(map(size, unknowns))),
        ]

    def converged_by_residuals(self) -> list[Statement]:
        """Return the statements that set the flag ``converged`` for a loop over residuals.

        The bound in the following rules is :data:`FOUR_ROUNDINGS` times the sum of the absolute values of the
        unknowns. The rate is change/previous. In the first sweep, it is the rate that the previous step has
        stored. The loop ends

        - if the rate is below 1/2 and the predicted next change is below the bound,
        - if the rate is between 1/2 and 1 and the geometric series of all later changes is below the bound,
        - if the rate is at least 1 and the change is below the tolerance,
        - if the rate is at least 1 and h times the change is below the rounding errors of the state.

        If the rate is at least 1/2, the loop makes two sweeps or more.
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
            # The predicted next change is reliable only if the rate is clearly below 1.
            Assign(flag("contracts"), rate < 0.5),
            Assign(
                flag("converged"),
                select(
                    flag("contracts"),
                    CHANGE * (rate + LEAST_RATE) <= close * SCALE,
                    # At a rate of 1/2 or more, the change in a single sweep does not show the distance to the
                    # solution.
                    both(
                        SWEEPS > 1,
                        # If changes decrease slowly, even a small change matters: at the rate 0.9, the sum of
                        # all later changes is nine times this change.
                        either(
                            CHANGE * rate <= close * SCALE * (1.0 - rate),
                            both(rate >= 1.0, either(CHANGE <= tolerance * SCALE, self.lost())),
                        ),
                    ),
                ),
            ),
        ]

    def decided(self, finite: Term, possible: Term | None = None) -> Statement:
        """Return the statement that sets the status after a sweep.

        The status is given by the first rule in this list that applies:

        - It is NOT_FINITE if the value of the term ``finite`` is an infinity or a NaN.
        - It is OK if the flag ``converged`` and the test ``possible`` are true.
        - It is NOT_CONVERGED in all other cases.

        The test ``possible`` is false if the matrix is singular. If ``possible`` is None, only the flag
        ``converged`` is read.
        """
        # The test ``is_finite`` comes first. Comparisons with a NaN are false, so for a NaN the flag
        # ``converged`` is false. Without the test ``is_finite``, the status would be NOT_CONVERGED, and the
        # loop would continue.
        converged = flag("converged") if possible is None else both(possible, flag("converged"))
        outcome = select(converged, code(OK), code(NOT_CONVERGED))
        return Assign(STATUS, select(is_finite(finite), outcome, code(NOT_FINITE)))

    def going_on(self, astray: Term | None = None) -> Term:
        """Return the condition under which the loop continues. If ``astray`` is true, the loop ends."""
        # An iteration that converges too slowly ends at the limit on the number of sweeps. If the kernel has
        # a warm start, the step is then repeated by continuation in h.
        tests = [STATUS.equals(code(NOT_CONVERGED)), SWEEPS < self.loop.limit]
        return both(*tests, *([] if astray is None else [negated(astray)]))

    def after(self) -> list[Statement]:
        """Return the statements that store the rate for the next step, after a loop that has succeeded.

        If a loop for equations u = g(u) made a single sweep, it measured no rate, and the stored rate is
        doubled. After several such steps, the stored rate is so large that the first sweep fails the stopping
        test. The loop then makes a second sweep and measures the rate again. A loop over residuals (equations
        r(u) = 0) stores its rate unchanged.
        """
        if not self.warm:
            return []
        compared = self.loop.newton is not None and self.loop.newton.residuals
        kept = self.rate if compared else select(SWEEPS > 1, self.rate, 2.0 * self.rate)
        return [Assign(self.kept_rate, kept)]
