"""Convergence: the observed order of a method on a scene, compared with the stated order.

The error of a run is the distance of its final state from a reference solution (:mod:`codegen.lab.distance`).
The slope between two consecutive runs is the change of log(error) divided by the change of log(h), where h is
the step size.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from codegen.certify import CertifiedOrder, certified_order
from codegen.emitter import Optimised
from codegen.errors import MethodError
from codegen.ir.domain import PreciseDomain
from codegen.lab.distance import distance
from codegen.lab.number_types import Vector
from codegen.lab.orders.end_kinks import end_limits, undefined_beyond
from codegen.lab.orders.run_noise import LATE, Noise
from codegen.lab.orders.short_steps import order_of_short_steps
from codegen.lab.orders.step_sizes import CLEAR, TOLERANCE, Places, Refinement, Run, refine
from codegen.lab.reference import DIGITS, Reference
from codegen.lab.runner import RunFailed, Runner
from codegen.method import Method
from codegen.scene.classical_forms import ClassicalForm
from codegen.scene.problem import Problem
from orderconds.tableau.uncertainty import largest_radius

ROUNDING = "rounding"
EARLIER = "shift the time so that the span begins near 0, or use --target interpreter --digits 40"
"""The advice if rounding of the time hides the errors."""

UNPROVED = ("stated", "claimed", "decimal", "double", "none")
"""The values of ``certificate`` for an order that is not proved by order conditions.

If the observed order agrees with an unproved order, the order is tested again with very short steps.
"""

UNDERIVED = ("stated", "claimed", "none")
"""The values of ``certificate`` for an order that does not follow from order conditions."""

FEWEST = 4
"""The required number of usable runs: four runs give the three slopes that ``Refinement.settled`` needs."""


SPREAD = CLEAR * 2.0**-52
"""Errors of the coefficients of a method up to SPREAD are negligible.

A run with doubles has a rounding error r of about 2^-52 or more. A run is used to measure the order only if
its error is larger than CLEAR r, and therefore larger than CLEAR 2^-52 = SPREAD. If the coefficients have
errors of at most SPREAD, the final state changes by about SPREAD or less, so by less than the error of the
run.
"""


@dataclass(frozen=True, repr=False)
class Convergence:
    """The runs of one method on one scene, and the stated order.

    - ``target``: the name of the target (for example ``c``), or ``interpreter``.
    - ``stated``: the order to test.
    - ``refinement``: the runs, from long to short steps.
    - ``kinks``: for each kink (point where the field is not smooth), how many derivatives of the field are
      continuous at the kink.
    - ``spread``: the uncertainty of the coefficients if it exceeds :data:`SPREAD`, and otherwise 0.
    - ``ends``: upper bounds of the observed order from the first and the last step
      (:mod:`codegen.lab.orders.end_kinks`).
    - ``derived``: the order from the order conditions, or None if it is not known.
    - ``undefined``: the reason why every run fails, or an empty text if no such reason is known.
    """

    scene: str
    method: str
    target: str
    stated: CertifiedOrder
    refinement: Refinement
    kinks: tuple[int, ...] = ()
    spread: float = 0.0
    ends: tuple[float, float] = (math.inf, math.inf)
    derived: int | None = None
    undefined: str = ""

    def __repr__(self) -> str:
        return f"<{self.method} on {self.scene}: {self.sentence()}>"

    @property
    def observed(self) -> float | None:
        """The observed order, or None if fewer than two runs are usable.

        The observed order is usually the slope between the last two usable runs. If kinks (points where the
        field is not smooth) limit the order to less than the stated order, the observed order is the slope
        between the first and the last usable run.
        """
        clean = self.refinement.clean
        if self.limit >= self.stated.order or len(clean) < 2:
            return self.refinement.observed
        first, last = clean[0], clean[-1]
        return math.log(first.error / last.error) / math.log(first.h / last.h)

    @property
    def verdict(self) -> str:
        """The comparison of the observed order with the stated order: ``holds``, ``fails`` or ``undecided``.

        If kinks (points where the field is not smooth) limit the observed order to less than the stated
        order, the result is ``undecided``.

        Rounding of the coefficients can reduce the order of a method. If the coefficients are rounded
        (:attr:`spread` is not 0), and very short steps show an order below the stated order, the result is
        ``fails``.

        A method can converge faster on one scene than on others. If the order conditions give the stated
        order, a higher observed order is no failure (:attr:`faster`), and the result is ``holds``.

        In all other cases, :meth:`Refinement.verdict` gives the result.
        """
        if self.limit < self.stated.order:
            return "undecided"
        short = self.refinement.short
        if self.spread and short is not None and short < self.stated.order - TOLERANCE:
            return "fails"
        return "holds" if self.faster else self.refinement.verdict(self.stated.order)

    @property
    def faster(self) -> bool:
        """True if the order is higher on this scene than the stated order, which the order conditions give.

        For example, the leading term of the error can vanish because of a symmetry of the scene.
        """
        observed, short, order = self.observed, self.refinement.short, self.stated.order
        return (
            self.derived == order
            and self.refinement.settled
            and observed is not None
            and observed > order + TOLERANCE
            and (short is None or short >= order - TOLERANCE)
        )

    @property
    def limit(self) -> float:
        """An upper bound of the observed order on this scene, for runs with equal steps.

        If no step evaluates the field on both sides of a kink (point where the field is not smooth), the
        bound is infinity.
        """
        return min(self._crossing, *self.ends)

    @property
    def _crossing(self) -> float:
        """An upper bound of the observed order: the bound from :attr:`kinks`, or infinity without kinks."""
        # If k derivatives of the field are continuous at a kink, the local error of the step across the kink
        # is proportional to h^(k+2).
        return min(self.kinks) + 2 if self.kinks else math.inf

    def as_json(self) -> dict[str, object]:
        """Return the JSON object that ``orderconds converge`` prints.

        In the entry ``error``, None replaces infinite errors.
        """
        runs = self.refinement.runs
        observed = self.observed
        return {
            "scene": self.scene,
            "method": self.method,
            "target": self.target,
            "stated_order": self.stated.order,
            "certificate": self.stated.certificate,
            "steps": [r.steps for r in runs],
            "h": [r.h for r in runs],
            "error": [r.error if math.isfinite(r.error) else None for r in runs],
            "excluded": [r.excluded for r in runs],
            "slopes": [round(s, 4) for s in self.refinement.slopes],
            "observed_order": None if observed is None else round(observed, 4),
            "order_of_short_steps": None if (short := self.refinement.short) is None else round(short, 4),
            "verdict": self.verdict,
            "reason": self.sentence(),
            "failure": "",
        }

    def sentence(self) -> str:
        """Return the verdict and its reason in one line."""
        if self.observed is None:
            reasons = sorted({r.excluded for r in self.refinement.runs if r.excluded})
            why = self.undefined or "; ".join(reasons) or "too few steps"
            advice = f"; {EARLIER}" if any(reason.startswith(LATE) for reason in reasons) else ""
            return f"undecided: no two consecutive runs are usable ({why}){advice}"
        about = f"observed order {self.observed:.2f}, stated {self.stated.order} ({self.stated.certificate})"
        if self.limit < self.stated.order:
            return f"undecided: {about}; {self._crossed()}"
        if self.verdict == "undecided":
            return f"undecided: {about}, but {self._unsettled()}"
        if self.faster:
            about += "; on this scene, the method converges faster than the order conditions guarantee"
        if self.refinement.short is None or abs(self.refinement.short - self.observed) <= TOLERANCE:
            return f"{self.verdict}: {about}"
        return f"{self.verdict}: {about}; {self._short()}"

    def _crossed(self) -> str:
        """Return a text that explains how kinks (points where the field is not smooth) limit the order."""
        reasons = []
        if self._crossing < self.stated.order:
            reasons.append(f"the solution crosses {self._places()} where the field is not smooth")
        for step, place, bound in zip(("first", "last"), ("start", "end"), self.ends, strict=True):
            if bound < self.stated.order:
                reasons.append(
                    f"the {place} of the solution is a point where the field is not smooth, and the {step} "
                    "step evaluates the field at this point or on its other side"
                )
        return (
            f"{', and '.join(reasons)}; therefore runs with equal steps have at most order {self.limit}"
            f"{self._aligned()}; order {self.stated.order} requires a smooth field"
        )

    def _places(self) -> str:
        return "one point" if len(self.kinks) == 1 else f"{len(self.kinks)} points"

    def _aligned(self) -> str:
        """Return a condition of the bound :attr:`limit` for the message, or an empty text.

        The bound holds if no step ends at a kink. The condition is needed if the last slope exceeds the bound
        and the bound comes from a kink that the solution crosses.
        """
        last = self.refinement.observed
        if self._crossing > self.limit or last is None or last <= self.limit + TOLERANCE:
            return ""
        return " if no step ends at such a point"

    def _short(self) -> str:
        """Return a text that compares the order at very short steps with the order at the usual steps."""
        text = f"very short steps, computed with 100 digits, show order {self.refinement.short:.2f}"
        if not self.refinement.settled:
            text = f"the slopes do not settle, but {text}"
        if self.spread:
            return f"{text}; the coefficients are rounded (uncertainty {self.spread:.1e})"
        if not self.refinement.settled:
            return text
        return (
            f"{text}; the usual steps are so long that the leading term is not the largest term of the error"
        )

    def _unsettled(self) -> str:
        """Return the reason why the slopes do not determine the order, and a hint to the user."""
        if any(r.excluded.startswith(LATE) for r in self.refinement.runs):
            return f"{LATE} dominates before the slopes settle; {EARLIER}"
        if self.refinement.settled:
            return f"{self._short()}; try finer steps"
        if self.kinks:
            return (
                f"the slopes have not settled; the solution crosses {self._places()} where the field is not "
                "smooth, and the error depends on the position of such a point in its step; choose numbers "
                "of steps with which a step ends at each of these points"
            )
        if any(r.excluded == ROUNDING for r in self.refinement.runs):
            return "rounding dominates before the slopes settle; use --target interpreter --digits 40"
        if len(self.refinement.clean) < FEWEST:
            return f"{len(self.refinement.clean)} runs are usable, but {FEWEST} are required; try other steps"
        return "the slopes have not settled; try finer steps"


@dataclass(frozen=True)
class NotEmitted:
    """A method that cannot be emitted for the scene. ``failure`` is the reason."""

    scene: str
    method: str
    target: str
    failure: str
    verdict: str = "fails"

    def as_json(self) -> dict[str, object]:
        """Return the JSON object that ``orderconds converge`` prints."""
        empty: list[object] = []
        return {
            "scene": self.scene,
            "method": self.method,
            "target": self.target,
            "stated_order": None,
            "certificate": "none",
            "steps": empty,
            "h": empty,
            "error": empty,
            "excluded": empty,
            "slopes": empty,
            "observed_order": None,
            "order_of_short_steps": None,
            "verdict": self.verdict,
            "reason": self.sentence(),
            "failure": self.failure,
        }

    def sentence(self) -> str:
        """Return the verdict and its reason in one line."""
        return f"{self.verdict}: {self.failure}"


def converge(
    runner: Runner,
    stated: CertifiedOrder,
    exact: Reference,
    *,
    steps: Sequence[int] = (),
    to_rounding: bool = False,
    form: ClassicalForm | None = None,
) -> Convergence:
    """Run a method with shorter and shorter steps, and return the errors and the observed order.

    - ``stated``: the order to test.
    - ``exact``: the reference solution.
    - ``steps``: the numbers of steps of the runs, by default 5, 10, 20, ... up to ``runner.most_steps``.
      The default can be different if the solution crosses a point where the field is not smooth. For
      example, for a point at one third of the time span, the default can be 6, 12, 24, ..., because a step
      then ends at this point.
    - ``to_rounding``: If True, the runs continue until rounding errors dominate.
    - ``form``: the form of the equations that ``runner`` integrates, or None for the equations of the scene.

    Final states are converted to the coordinates of the scene before errors are measured.
    """
    scene = runner.compiled.scene if form is None else form.scene
    label = runner.compiled.method.label if form is None else f"{runner.compiled.method.label} ({form.name})"
    noise = Noise.of(scene, exact, runner.epsilon)

    def run(n: int) -> Run:
        return _rung(scene, runner, exact, n, noise, form)

    places = Places.of(exact.kinks, exact.times, scene.span, stated.order)
    refinement = (
        Refinement(tuple(run(n) for n in sorted(steps)))
        if steps
        else refine(run, runner.most_steps, to_rounding, places)
    )
    spread = uncertainty(runner.compiled.method)
    visible = visible_uncertainty(runner.compiled.method)
    ends = end_limits(runner.compiled, _end(exact, form))
    result = Convergence(scene.name, label, runner.target, stated, refinement, exact.kinks, visible, ends)
    proved = stated.certificate not in UNPROVED
    if result.limit < stated.order:
        return result
    if result.observed is None:
        failed = bool(refinement.runs) and all(math.isinf(r.error) for r in refinement.runs)
        return replace(
            result, undefined=undefined_beyond(runner.compiled, _end(exact, form)) if failed else ""
        )
    if result.verdict == "holds" and proved:
        return result
    short = order_of_short_steps(runner.compiled, stated.order, 0.0 if visible else spread)
    result = replace(result, refinement=replace(refinement, short=short))
    observed = result.observed
    higher = result.verdict == "fails" and observed is not None and observed > stated.order
    return replace(result, derived=derived_order(runner.compiled)) if higher else result


def derived_order(compiled: Optimised) -> int | None:
    """Return the order that the order conditions give, or None if they do not decide it."""
    try:
        order = certified_order(compiled.method, compiled.scene)
    except MethodError:
        return None
    return None if order.certificate in UNDERIVED else order.order


def _end(exact: Reference, form: ClassicalForm | None) -> Vector:
    """Return the exact final state in the coordinates that the method integrates."""
    return exact.state if form is None else form.form_state(PreciseDomain(0, DIGITS), exact.state)


def uncertainty(method: Method) -> float:
    """Return the largest uncertainty of a coefficient of a method, or 0 if all coefficients are exact."""
    return 0.0 if method.coefficients is None else largest_radius(method.tableau)


def visible_uncertainty(method: Method) -> float:
    """Return the largest uncertainty of a coefficient if it exceeds :data:`SPREAD`, and otherwise 0."""
    spread = uncertainty(method)
    return spread if spread > SPREAD else 0.0


def _rung(
    scene: Problem,
    runner: Runner,
    exact: Reference,
    steps: int,
    noise: Noise,
    form: ClassicalForm | None,
) -> Run:
    h = float(Fraction(scene.span[1] - scene.span[0]) / steps)
    try:
        state = runner.final(steps)
        if form is not None:
            state = form.scene_state(runner.domain, state)
        error = distance(scene, state, exact.state)
    except RunFailed as failure:
        return Run(steps, h, math.inf, f"the run failed: {failure}")
    if not math.isfinite(error):
        return Run(steps, h, math.inf, "the final state is not finite")
    gaps = [abs(float(b - a)) for a, b in zip(state, exact.state, strict=True)]
    if error <= CLEAR * noise.of_state(steps, gaps):
        return Run(steps, h, error, ROUNDING)
    if error <= CLEAR * noise.of_time(gaps):
        return Run(steps, h, error, noise.late)
    if error <= CLEAR * exact.uncertainty:
        return Run(steps, h, error, "the reference solution is not accurate enough to measure the error")
    return Run(steps, h, error)
