"""What is left of a method's order on harsh variants of a scene, while steps do not resolve the fast rates.

A ladder of steps is climbed from one step over the span. Slopes between rungs with h times the rate above one
are the order in the stiff regime; their median beside the stated order names the reduction.
"""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from codegen.certify import certified_order
from codegen.emitter import compile_method
from codegen.lab.distance import distance
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted, RunFailed
from codegen.lab.stability.harsh import Harsh
from codegen.method import Method

RUNGS = 15
"""Doublings of the number of steps."""

CLOSE = 0.1
"""Errors above this part of the state's size show no order."""


@dataclass(frozen=True)
class Stiff:
    """A ladder on a harsh variant: (h, error or None where the run failed, reason), and what it shows."""

    variant: str
    rate: float
    stated: int
    rungs: tuple[tuple[float, float | None, str], ...]
    observed: float | None
    verdict: str

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "variant": self.variant,
            "rate": self.rate,
            "stated_order": self.stated,
            "h": [h for h, _, _ in self.rungs],
            "error": [e for _, e, _ in self.rungs],
            "failures": [why for _, _, why in self.rungs],
            "observed_order": self.observed,
            "verdict": self.verdict,
        }


def order_left(harsh: Harsh, method: Method, exact: Reference) -> Stiff:
    """Return the ladder of a method on a harsh variant; MethodError where the method cannot serve it."""
    scene = harsh.scene
    compiled = compile_method(scene, method)
    order = certified_order(method, scene)
    runner = Emitted(compiled, "c", order)
    span = scene.span[1] - scene.span[0]
    size = max(1.0, math.hypot(*map(float, exact.state)))
    rungs: list[tuple[float, float | None, str]] = []
    for k in range(RUNGS):
        h = float(Fraction(span) / 2**k)
        try:
            error = distance(scene, runner.final(2**k), exact.state)
        except RunFailed as failure:
            rungs.append((h, None, str(failure).partition(": ")[2] or str(failure)))
            continue
        rungs.append((h, error if math.isfinite(error) else None, "" if math.isfinite(error) else "infinite"))
        if error < 1e-13 * size:
            break
    stiff = [(h, e) for h, e, _ in rungs if e is not None and h * harsh.rate > 1.0 and 0.0 < e < CLOSE * size]
    slopes = [
        math.log(a[1] / b[1]) / math.log(a[0] / b[0]) for a, b in pairwise(stiff) if 0.4 < b[0] / a[0] < 0.6
    ]
    observed = statistics.median(slopes) if slopes else None
    return Stiff(
        harsh.name,
        harsh.rate,
        order.order,
        tuple(rungs),
        observed,
        _named(order.order, observed, rungs, size, harsh),
    )


def _named(stated: int, observed: float | None, rungs: Any, size: float, harsh: Harsh) -> str:
    """Say in words what the ladder shows."""
    close = [h for h, e, _ in rungs if e is not None and e < CLOSE * size]
    if not close:
        failed = [why for _, e, why in rungs if e is None]
        return f"no usable step down to h = {rungs[-1][0]:.1e}" + (f" ({failed[-1]})" if failed else "")
    if observed is None:
        limit = "stability or accuracy needs the fast motion resolved"
        return f"usable from h = {max(close):.1e} on, h times rate {max(close) * harsh.rate:.2g}: {limit}"
    if observed < stated - 0.5:
        return f"order reduction {stated} to {max(observed, 0.0):.1f} while h times rate is above 1"
    return f"order {stated} is kept (observed {observed:.1f}) while h times rate is above 1"
