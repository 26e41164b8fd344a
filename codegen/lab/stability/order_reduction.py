"""Measures the observed order of methods on stiff variants of a scene (order reduction).

A stiff variant of a scene has a fast motion with a known rate. In each further run, the step size h is half
that of the run before. A run is in the stiff regime if the product of h and the rate is above one. The slope
between two successive runs is the change of log(error) divided by the change of log(h). The observed order is
the median of the slopes in the stiff regime.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TypeAlias

from codegen.certify import certified_order
from codegen.emitter import compile_method
from codegen.lab.distance import distance
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted, RunFailed
from codegen.method import Method
from codegen.scene.stiff_variant import StiffVariant

DOUBLINGS = 15
"""The largest number of runs. Run k has 2^k steps, for k = 0, 1, ..., DOUBLINGS - 1."""

StiffRun: TypeAlias = tuple[float, float | None, str]
"""A run: the step size, the error (None if the run failed), and the reason of a failure (or '')."""

CLOSE = 0.1
"""A run is accurate if its error is less than CLOSE times max(1, norm of the exact final state)."""


@dataclass(frozen=True)
class OrderReduction:
    """The results of the runs of a method on a stiff variant of a scene.

    - ``variant``: the name of the stiff variant.
    - ``rate``: the rate of the fast motion, per unit of time.
    - ``stated``: the order computed from the order conditions.
    - ``runs``: a triple (step size, error or None, reason of a failure) for each run.
    - ``observed``: the order observed with steps longer than 1/``rate``, or None if too few runs are
      accurate.
    - ``verdict``: a sentence about the observed order or the usable step sizes.
    """

    variant: str
    rate: float
    stated: int
    runs: tuple[StiffRun, ...]
    observed: float | None
    verdict: str

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON."""
        return {
            "variant": self.variant,
            "rate": self.rate,
            "stated_order": self.stated,
            "h": [h for h, _, _ in self.runs],
            "error": [e for _, e, _ in self.runs],
            "failures": [why for _, _, why in self.runs],
            "observed_order": self.observed,
            "verdict": self.verdict,
        }


def order_reduction(variant: StiffVariant, method: Method, exact: Reference) -> OrderReduction:
    """Run a method on a stiff variant with different step sizes, and return the results.

    ``exact`` is the reference solution of the variant. Raises MethodError if the method cannot be compiled
    for the variant.
    """
    scene = variant.scene
    compiled = compile_method(scene, method)
    order = certified_order(method, scene)
    runner = Emitted(compiled, order=order)
    span = scene.span[1] - scene.span[0]
    size = max(1.0, math.hypot(*map(float, exact.state)))
    runs: list[StiffRun] = []
    for k in range(DOUBLINGS):
        h = float(Fraction(span) / 2**k)
        try:
            error = distance(scene, runner.final(2**k), exact.state)
        except RunFailed as failure:
            runs.append((h, None, str(failure).partition(": ")[2] or str(failure)))
            continue
        runs.append((h, error if math.isfinite(error) else None, "" if math.isfinite(error) else "infinite"))
        if error < 1e-13 * size:
            break
    stiff = [
        (h, e) for h, e, _ in runs if e is not None and h * variant.rate > 1.0 and 0.0 < e < CLOSE * size
    ]
    slopes = [
        math.log(a[1] / b[1]) / math.log(a[0] / b[0]) for a, b in pairwise(stiff) if 0.4 < b[0] / a[0] < 0.6
    ]
    observed = statistics.median(slopes) if slopes else None
    return OrderReduction(
        variant.name,
        variant.rate,
        order.order,
        tuple(runs),
        observed,
        _verdict(order.order, observed, runs, size, variant),
    )


def _verdict(
    stated: int, observed: float | None, runs: Sequence[StiffRun], size: float, variant: StiffVariant
) -> str:
    """Return a sentence about the observed order, or about the usable step sizes if no order is observed."""
    close = [h for h, e, _ in runs if e is not None and e < CLOSE * size]
    if not close:
        failed = [why for _, e, why in runs if e is None]
        reason = f" ({failed[-1]})" if failed else ""
        return f"no step size down to h = {runs[-1][0]:.1e} is usable{reason}"
    if observed is None:
        limit = "stability or accuracy requires steps that resolve the fast motion"
        relative = f"{max(close) * variant.rate:.2g}/(rate of the fast motion)"
        return f"usable up to h = {max(close):.1e} ({relative}): {limit}"
    if observed < stated - 0.5:
        return (
            f"order reduction from {stated} to {max(observed, 0.0):.1f} "
            "with steps longer than 1/(rate of the fast motion)"
        )
    return (
        f"order {stated} is preserved (observed {observed:.1f}) "
        "with steps longer than 1/(rate of the fast motion)"
    )
