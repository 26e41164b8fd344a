"""The stopping rule for loops that solve implicit equations.

The following rule is for equations u = g(u). The method :meth:`Stopping.converged_by_residuals` contains the
rule for equations r(u) = 0.

``change`` is the largest change of an unknown in a sweep, and ``scale`` is the largest absolute value of an
unknown. ``previous`` is the change in the previous sweep. The rate of convergence is change/previous. The
loop has converged in three cases:

- *close*: the change and the predicted next change are about as small as the rounding errors. The predicted
  next change is the rate times the change. A small change alone does not prove convergence, because a slow
  iteration makes small changes far from the solution.
- *still*: the change no longer decreases and is nearly as small as the rounding errors.
- *lost*: the change no longer decreases, and h times the change is below the rounding errors of the state.
  This case is needed for an unknown that is a small difference of large numbers. The rounding errors of the
  large numbers keep the change of this unknown large.

All tests are relative, so the number of sweeps does not depend on the units of the unknowns. If a change is
not finite, the loop ends with the status NOT_FINITE.

The test of the predicted next change is taken from Hairer and Wanner, Solving Ordinary Differential Equations
II, section IV.8.
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

The test estimates the error that remains in the unknowns after a sweep. The estimate is the change in this
sweep, multiplied by the sum of the rate and LEAST_RATE. Even if the measured rate is zero, the estimate is at
least LEAST_RATE times the change.
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

        In the first sweep, the rate is the value that the previous step has stored. If no value is stored,
        the rate is 1.
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
        # If the loop has no formulas for the first values of its unknowns, the warm start of the kernel
        # computes these values.
        return not self.loop.starts

    def before(self) -> list[Statement]:
        """Return the statements before the first sweep."""
        sequence: list[Statement] = [Assign(self.previous, number(0.0))]
        if self.warm:
            known = self.plan.memory.field("known", Kind.COUNT) > 0
            # In steps of equal size, the rate hardly changes. Therefore a loop begins with the rate of the
            # previous step (Hairer and Wanner), and may end after one sweep. If no rate is stored, the rate
            # is 1. With this rate, the predicted next change equals the change in the first sweep.
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
            # The change in the first sweep is a measure of the error of the initial guess. The warm start
            # reads the largest such change of all loops in a step.
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
        # The predicted next change must be at most the rounding error of the largest unknown. In a loop
        # without a warm start, the rate is ``CHANGE / previous``. For this loop, both sides of the test are
        # multiplied by ``previous``, so no division is needed. In the first sweep ``previous`` is 0, and the
        # test is true only if the change is zero.
        next_change = (
            CHANGE * self.rate <= form.unit * SCALE
            if self.warm
            else CHANGE * CHANGE <= form.unit * SCALE * previous
        )
        # Rounding errors may keep the change above the bounds of the test ``close``. In this case the change
        # no longer decreases, and more sweeps are useless. The change of a diverging iteration does not
        # decrease either. Therefore a second test is needed: the change is at most ``tolerance`` times
        # ``SCALE``, or the test :meth:`lost` is true.
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

        A loop may solve equations for a variation (a tangent vector at the state). For such a loop, the test
        uses the rounding errors of the variation in place of those of the state.
        """
        # The array ``vector`` contains the variation. All other arrays belong to the state.
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

        For equations r(u) = 0, the stopping rule uses these sums in place of the maxima of :meth:`measured`.
        """
        return [
            # If a change is a NaN, the sum is a NaN, but a maximum may ignore the NaN. Therefore the test
            # whether the sum is finite is enough.
            Assign(CHANGE, paired(map(size, changes))),
            Assign(SCALE, paired(map(size, unknowns))),
        ]

    def converged_by_residuals(self) -> list[Statement]:
        """Return the statements that set the flag ``converged`` for equations r(u) = 0.

        The change in a sweep is the sum of the absolute values of all changes. The bound is
        :data:`FOUR_ROUNDINGS` times the sum of the absolute values of the unknowns. The rate is
        change/previous. In the first sweep, the rate is the value that the previous step has stored. The
        loop has converged in these cases:

        - The rate is below 1/2, and the predicted next change is below the bound.
        - The rate is between 1/2 and 1, and the predicted sum of all later changes is below the bound.
        - The rate is at least 1, and the change is below the tolerance.
        - The rate is at least 1, and h times the change is below the rounding errors of the state.

        If the rate is at least 1/2, the loop makes at least two sweeps.
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
            # If the rate is near 1 or larger, the predicted next change is not reliable.
            Assign(flag("contracts"), rate < 0.5),
            Assign(
                flag("converged"),
                select(
                    flag("contracts"),
                    CHANGE * (rate + LEAST_RATE) <= close * SCALE,
                    # In the first sweep, the rate is only the stored value. At a stored rate of 1/2 or more,
                    # the loop makes a second sweep and measures the rate.
                    both(
                        SWEEPS > 1,
                        # If the changes decrease slowly, the remaining error is larger than the change. At
                        # the rate 0.9, the sum of all later changes is nine times the change.
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

        If the matrix is singular, the test ``possible`` is false. If there is no such test, ``possible`` is
        None.
        """
        # For a NaN, the flag ``converged`` is false, because comparisons with a NaN are false. The loop must
        # end nevertheless, so a value that is not finite gets a status of its own.
        converged = flag("converged") if possible is None else both(possible, flag("converged"))
        outcome = select(converged, code(OK), code(NOT_CONVERGED))
        return Assign(STATUS, select(is_finite(finite), outcome, code(NOT_FINITE)))

    def going_on(self, astray: Term | None = None) -> Term:
        """Return the condition under which the loop continues.

        ``astray`` is a test for a loop that cannot converge. If this test is true, the loop ends.
        """
        # If an iteration converges too slowly, the loop ends at the largest number of sweeps.
        tests = [STATUS.equals(code(NOT_CONVERGED)), SWEEPS < self.loop.limit]
        return both(*tests, *([] if astray is None else [negated(astray)]))

    def after(self) -> list[Statement]:
        """Return the statements that store the rate of a converged loop for the next step.

        If a loop for equations u = g(u) makes only one sweep, it measures no rate, and the stored rate is
        doubled. After several doublings, the rate is so large that the loop makes a second sweep and measures
        the rate. A loop for equations r(u) = 0 stores its rate unchanged.
        """
        if not self.warm:
            return []
        compared = self.loop.newton is not None and self.loop.newton.residuals
        kept = self.rate if compared else select(SWEEPS > 1, self.rate, 2.0 * self.rate)
        return [Assign(self.kept_rate, kept)]
