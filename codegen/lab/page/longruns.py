"""Long runs on the page: how far energy and the other kept quantities went, and by which law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from markupsafe import Markup

from codegen.lab.drift import CONFIDENCE
from codegen.lab.figures import Curve, growth_figure
from codegen.lab.invariants import MANIFOLD
from codegen.lab.longrun import LongRun
from codegen.lab.page.spelling import Picture, scientific

LEAST = 1e-17
"""Deviations below this are drawn there: a logarithm has no zero."""


def section(runs: Sequence[LongRun], again: str) -> dict[str, Any]:
    """Return what the templates need of long runs; ``again`` is the command that measures them again."""
    names = list(dict.fromkeys(k.name for run in runs for k in run.kept))
    shown = [n for n in names if n == "energy"] or [n for n in names if n != MANIFOLD][:1]
    shown += [MANIFOLD] if MANIFOLD in names else []
    pictures = []
    for name in shown:
        curves = [
            Curve(run.method, points, place=k) for k, run in enumerate(runs) if (points := _growth(run, name))
        ]
        if curves:
            pictures.append(
                Picture(
                    Markup(growth_figure(f"{runs[0].scene} {name}", curves, f"largest deviation of {name}")),
                    f"The largest deviation of the {name} so far. Dotted: growth like √t and like t.",
                    again,
                )
            )
    first = runs[0]
    return {
        "pictures": pictures,
        "steps": f"{first.steps:,}".replace(",", "\u00a0"),
        "h": f"{first.h:g}",
        "confidence": f"{100 * CONFIDENCE:.0f}\u00a0%",
        "rounded": max((g.steps[-1] for run in runs for g in run.rounding), default=0),
        "runs": [_run(run) for run in runs],
    }


def _growth(run: LongRun, name: str) -> tuple[tuple[float, float], ...]:
    """Return the running maximum of a quantity's deviation, a point where it rises and one at the end."""
    for kept in run.kept:
        if kept.name != name:
            continue
        points: list[tuple[float, float]] = []
        largest = LEAST
        for t, x in zip(kept.times, kept.deviations, strict=True):
            if abs(x) > 1.02 * largest or not points:
                largest = max(abs(x), LEAST)
                points.append((abs(t), largest))
        end = (abs(kept.times[-1]), largest)
        return (*points, end) if points[-1] != end else tuple(points)
    return ()


def _run(run: LongRun) -> dict[str, Any]:
    return {
        "label": run.method,
        "kept": [
            {
                "name": k.name,
                "largest": scientific(k.drift.largest),
                "slope": f"{scientific(k.drift.slope)} ± {scientific(k.drift.half_width, 1)}",
                "exponent": f"{k.drift.exponent:.2f}",
                "law": k.drift.law,
            }
            for k in run.kept
        ],
        "symplectic": "–" if run.symplectic is None else scientific(run.symplectic),
        "back": "; ".join(f"{scientific(x)} after {n}" for n, x in run.reversals),
        "failure": run.failure,
        "rounding": [
            {
                "name": g.quantity,
                "steps": "compensated" if g.compensated else "plain",
                "rms": scientific(g.sizes[-1]),
                "exponent": f"{g.exponent:.2f} ± {g.half_width:.2f}",
                "law": g.law,
            }
            for g in run.rounding
        ],
    }
