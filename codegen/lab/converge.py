"""Convergence: the observed order of an executed method on a scene, against the stated one.

The error at the end of the span is measured in the scene's own way (:mod:`codegen.lab.distance`) against a
reference of another kind, on a ladder of halved steps that stops when its slopes have settled
(:mod:`codegen.lab.ladder`). The stated order comes from the order conditions, never from the slopes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from codegen.certify import CertifiedOrder
from codegen.lab.distance import distance
from codegen.lab.ladder import CLEAR, Ladder, Rung, climb, rounding
from codegen.lab.reference import Reference
from codegen.lab.runner import RunFailed, Runner
from codegen.scene.problem import Problem

ROUNDING = "rounding"
FEWEST = 4
"""Runs that three slopes need."""


@dataclass(frozen=True)
class Convergence:
    """What one method did on one scene: its ladder, and the order that its conditions state."""

    scene: str
    method: str
    target: str
    stated: CertifiedOrder
    ladder: Ladder

    @property
    def observed(self) -> float | None:
        """The last clean slope."""
        return self.ladder.observed

    @property
    def verdict(self) -> str:
        """``holds``, ``fails`` or ``undecided``."""
        return self.ladder.verdict(self.stated.order)

    def as_json(self) -> dict[str, Any]:
        """Return the JSON object of ``orderconds converge``; an error that is not finite is null."""
        rungs = self.ladder.rungs
        observed = self.observed
        return {
            "scene": self.scene,
            "method": self.method,
            "target": self.target,
            "stated_order": self.stated.order,
            "certificate": self.stated.certificate,
            "steps": [r.steps for r in rungs],
            "h": [r.h for r in rungs],
            "error": [r.error if math.isfinite(r.error) else None for r in rungs],
            "excluded": [r.excluded for r in rungs],
            "slopes": [round(s, 4) for s in self.ladder.slopes],
            "observed_order": None if observed is None else round(observed, 4),
            "verdict": self.verdict,
        }

    def sentence(self) -> str:
        """Say the verdict and its reason in one line."""
        if self.observed is None:
            reasons = sorted({r.excluded for r in self.ladder.rungs if r.excluded})
            return f"undecided: no two neighbouring runs count ({'; '.join(reasons) or 'too few steps'})"
        about = f"observed order {self.observed:.2f}, stated {self.stated.order} ({self.stated.certificate})"
        if self.verdict == "undecided":
            return f"undecided: {about}, but {self._unsettled()}"
        return f"{self.verdict}: {about}"

    def _unsettled(self) -> str:
        """Say why the slopes have not settled, and what to type."""
        if any(r.excluded == ROUNDING for r in self.ladder.rungs):
            return "rounding is met before the slopes settle; --target interpreter --digits 40 sees further"
        if len(self.ladder.clean) < FEWEST:
            return f"{FEWEST} runs that count are needed, there are {len(self.ladder.clean)}"
        return "the slopes have not settled; finer steps may show more"


def converge(
    runner: Runner,
    stated: CertifiedOrder,
    exact: Reference,
    *,
    steps: Sequence[int] = (),
    to_rounding: bool = False,
) -> Convergence:
    """Climb the ladder of a runner and return what was seen.

    ``steps`` prescribes the rungs, in increasing numbers of steps; without it the ladder doubles from five
    steps until its slopes settle (``to_rounding``: until rounding is met), or the runner's patience ends.
    """
    scene = runner.compiled.scene
    size = math.hypot(*(float(x) for x in exact.state))

    def rung(n: int) -> Rung:
        return _rung(scene, runner, exact, n, size)

    ladder = (
        Ladder(tuple(rung(n) for n in sorted(steps)))
        if steps
        else climb(rung, runner.most_steps, to_rounding)
    )
    return Convergence(scene.name, runner.compiled.method.label, runner.target, stated, ladder)


def _rung(scene: Problem, runner: Runner, exact: Reference, steps: int, size: float) -> Rung:
    h = float(Fraction(scene.span[1] - scene.span[0]) / steps)
    try:
        error = distance(scene, runner.final(steps), exact.state)
    except RunFailed as failure:
        return Rung(steps, h, math.inf, f"no run: {failure}")
    if not math.isfinite(error):
        return Rung(steps, h, math.inf, "the final state is not finite")
    if error <= CLEAR * rounding(steps, runner.epsilon, size):
        return Rung(steps, h, error, ROUNDING)
    if error <= CLEAR * exact.uncertainty:
        return Rung(steps, h, error, "below what the reference can tell")
    return Rung(steps, h, error)
