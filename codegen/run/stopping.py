"""The stopping rule for loops that solve implicit equations.

The following rule is for equations u = g(u). The method :meth:`Stopping.converged_by_residuals` contains the
rule for equations r(u) = 0.

``change`` is the largest change of an unknown in a sweep, and ``scale`` is the largest absolute value of an
unknown. ``previous`` is the change in the previous sweep. The rate of convergence is change/previous. The
loop has converged in three cases:

- *close*: the change and the predicted next change (the rate times the change) are about as small as the
  rounding errors. A small change alone does not prove convergence, because a slow iteration makes small
  changes far from the solution.
- *still*: the change no longer decreases and is at most the tolerance of the loop times ``scale``.
- *lost*: the change no longer decreases, and its effect on the state is below the rounding errors of the
  state. The effect is estimated by the step size times the change. This case is needed if an unknown is a
  small difference of large numbers.

If a change is not finite, the loop ends with the status NOT_FINITE.

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
    largest,
    negated,
    number,
    paired,
    real,
    select,
    size,
)

LEAST_RATE = 2.0**-13
"""The stopping test for equations r(u) = 0 adds LEAST_RATE to the measured rate of convergence."""

FOUR_ROUNDINGS = 2.0**-50
"""A factor in the stopping test for equations r(u) = 0 (:meth:`Stopping.converged_by_residuals`).

The factor is 4 * 2^-52. The number 2^-52 is the distance between 1 and the next double.
"""

CHANGE, SCALE = real("change"), real("scale")


@dataclass(frozen=True)
class Stopping:
    """The stopping rule for one loop.

    ``number`` is the index of ``loop`` among the loops of the kernel, counted from 1.
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

        In the first sweep, the rate is the value that the previous step has stored, or 1 if no value is
        stored.
        """
        return real(f"rate_{self.number}")

    @property
    def kept_rate(self) -> Term:
        """The rate of convergence that a step stores for the next step."""
        # Each loop stores its own rate, because the loops of one step converge at different rates.
        return self.plan.memory.field(f"rate_{self.number}")

    @cached_property
    def warm(self) -> bool:
        """True if the initial guess is extrapolated from previous steps (a warm start)."""
        # ``starts`` contains the formulas for the initial guess. With a warm start there are no formulas, so
        # ``starts`` is empty.
        return not self.loop.starts

    def before(self) -> list[Statement]:
        """Return the statements that set :attr:`previous` and :attr:`rate` before the first sweep."""
        sequence: list[Statement] = [Assign(self.previous, number(0.0))]
        if self.warm:
            known = self.plan.memory.field("known", Kind.COUNT) > 0
            # With a stored rate of convergence, one sweep can be enough (Hairer and Wanner).
            sequence.append(Assign(self.rate, select(known, self.kept_rate, 1.0)))
        return sequence

    def measured(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that compute two maxima over all unknowns.

        CHANGE is the maximum of ``changes``, the absolute values of the changes in a sweep. SCALE is the
        maximum of the absolute values of ``unknowns``.
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
            # A large change in the first sweep means that the initial guess was bad.
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
        # A division by ``previous`` is avoided, because ``previous`` is 0 in the first sweep.
        next_change = (
            CHANGE * self.rate <= form.unit * SCALE
            if self.warm
            else CHANGE * CHANGE <= form.unit * SCALE * previous
        )
        # Changes that no longer decrease may consist of rounding errors only.
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
        """Return the test whether a change of the unknowns affects the state less than rounding errors do.

        The effect of the change on the state is estimated by the change times the step size. If the unknowns
        belong to a variation (a tangent vector at the state), the test uses the rounding errors of the
        variation in place of the rounding errors of the state.
        """
        varied, bound = self.loop.label.startswith(VARIED), self.plan.format.scaled(LOST)
        moved = CHANGE * size(STEP)
        # The array ``vector`` contains the tangent vector, and the other arrays contain the state.
        tests = [
            moved <= bound * largest(place.term)
            for place in self.places
            if varied == (place.array == "vector")
        ]
        return both(*tests)

    def sums(self, changes: Sequence[Term], unknowns: Sequence[Term]) -> list[Statement]:
        """Return the statements that sum the absolute values of the changes and of the unknowns.

        The stopping rule for equations r(u) = 0 uses these sums. The stopping rule for equations u = g(u)
        uses maxima (:meth:`measured`).
        """
        return [
            # A maximum of the absolute values could ignore a NaN. The sum of the absolute values is a NaN if
            # a summand is a NaN.
            Assign(CHANGE, paired(map(size, changes))),
            Assign(SCALE, paired(map(size, unknowns))),
        ]

    def converged_by_residuals(self) -> list[Statement]:
        """Return the statements that set the flag ``converged`` for equations r(u) = 0.

        Let ``change`` be the sum of the absolute values of all changes in a sweep, and ``scale`` the sum of
        the absolute values of the unknowns. The rate is ``change`` divided by its value in the previous
        sweep. The bound is :data:`FOUR_ROUNDINGS` times ``scale``. The loop has converged in these cases:

        - The rate is below 1/2, and (rate + :data:`LEAST_RATE`) times ``change`` is at most the bound.
        - The rate is between 1/2 and 1, and the predicted sum of all later changes is at most the bound.
        - The rate is at least 1, and ``change`` is at most ``loop.tolerance * scale``.
        - The rate is at least 1, and the test :meth:`lost` is true.
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
            # Let q be the rate, and let d be ``change``. If q is constant, the sum of all later changes is
            # q d/(1 - q). If ``contracts`` is true (q < 1/2), the sum is less than 2 q d. A factor of 2 does
            # not matter for the stopping test, so the test omits the divisor 1 - q.
            Assign(flag("contracts"), rate < 0.5),
            Assign(
                flag("converged"),
                select(
                    flag("contracts"),
                    CHANGE * (rate + LEAST_RATE) <= close * SCALE,
                    # The rate is measured only from the second sweep on.
                    both(
                        SWEEPS > 1,
                        # If the changes decrease slowly, the remaining error is larger than the change.
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

        ``possible`` is the test that the matrix of Newton's method is not singular, or None if this test is
        not needed. The first rule that applies gives the status:

        - NOT_FINITE if the test ``finite`` is false.
        - OK if the flag ``converged`` is true, and ``possible`` is true or None.
        - NOT_CONVERGED in all other cases.
        """
        # Comparisons with a NaN are false, so a NaN never sets the flag ``converged``.
        converged = flag("converged") if possible is None else both(possible, flag("converged"))
        outcome = select(converged, code(OK), code(NOT_CONVERGED))
        return Assign(STATUS, select(finite, outcome, code(NOT_FINITE)))

    def going_on(self, astray: Term | None = None) -> Term:
        """Return the condition under which the loop continues.

        The loop continues if the status is NOT_CONVERGED, the number of sweeps is below ``loop.limit``, and
        the test ``astray`` is false. If the test ``astray`` is true, further sweeps cannot lead to
        convergence. If there is no such test, ``astray`` is None.
        """
        # If an iteration converges too slowly, the loop ends at the largest number of sweeps.
        tests = [STATUS.equals(code(NOT_CONVERGED)), SWEEPS < self.loop.limit]
        return both(*tests, *([] if astray is None else [negated(astray)]))

    def after(self) -> list[Statement]:
        """Return the statements that store the rate of a converged loop for the next step.

        If the loop has no warm start, no rate is stored. After two or more sweeps, the measured rate is
        stored. A single sweep measures no rate. After a single sweep, a loop for equations r(u) = 0 stores
        the old rate again, and a loop for equations u = g(u) stores twice the old rate.

        The factor 2 has the following reason. After the first sweep, the stopping test uses the old rate. If
        the old rate is too small, the loop ends too early. A larger rate makes the stopping test stricter.
        Each step with a single sweep doubles the stored rate, until the test demands a second sweep. The
        second sweep measures the rate again.
        """
        if not self.warm:
            return []
        compared = self.loop.newton is not None and self.loop.newton.residuals
        kept = self.rate if compared else select(SWEEPS > 1, self.rate, 2.0 * self.rate)
        return [Assign(self.kept_rate, kept)]
