"""Draws the errors of runs against their step sizes, and reference lines of given slopes."""

from __future__ import annotations

import math
import statistics
from collections.abc import Mapping, Sequence
from itertools import pairwise

from codegen.errors import SceneError
from codegen.integrator import StepFailed
from codegen.lab.distance import distance
from codegen.lab.page.axes import annotate, label_axes, log_ticks
from codegen.lab.page.formatting import scientific, superscript
from codegen.lab.page.svg import MUTED
from codegen.lab.pictures.canvas import Canvas, styles
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.lab.reference import cached_reference
from codegen.scene.figure import Orders, Run


def draw(figure: Orders, source: Source) -> Drawn:
    """Return the picture of a figure, with logarithmic axes.

    Each order p in ``figure.orders`` has a dashed line of slope p near the curve whose observed order is
    closest to p.
    """
    looks = styles(figure)
    numbers: dict[str, dict[str, float]] = {}
    canvas = Canvas.of(1)
    axes = canvas.panels[0]
    axes.set_xscale("log")
    axes.set_yscale("log")
    curves = {run.name: errors(figure, source, run) for run in figure.runs}
    for name, points in curves.items():
        if not points:
            raise SceneError(
                f"{name} fails with all step sizes", where=source.problem.name, expected="smaller step sizes"
            )
        texts = [f"{name}: h = {h:.3g}, error {scientific(e, 4)}" for h, e in points]
        sizes, values = zip(*points, strict=True)
        canvas.line(axes, (sizes, values), name, looks[name], range(len(points)), texts)
        numbers[name] = {f"{h:.6g}": e for h, e in points}
    for order in figure.orders:
        nearest = min(curves.values(), key=lambda points: abs(slope(points) - order))
        (h, e), (finest, _) = nearest[0], nearest[-1]
        ends = [finest, h]
        line = [0.5 * e * (x / h) ** order for x in ends]
        axes.plot(ends, line, color=MUTED, linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)
        annotate(axes, f"h{superscript(order)}", (ends[0], line[0]), (-2, -7), "right")
    label_axes(axes, "step size h", figure.axis)
    log_ticks(axes.xaxis, lambda x: f"{x:g}")
    listed = "; ".join(
        f"{name}: {', '.join(f'{e:.3e}' for e in rows.values())}" for name, rows in numbers.items()
    )
    svg = canvas.finish(figure, source.problem, f"Errors for decreasing h. {listed}.")
    return Drawn(svg, _failures(figure, curves), numbers)


def _failures(figure: Orders, curves: Mapping[str, Sequence[tuple[float, float]]]) -> str:
    """Return a text with one sentence for each run that fails with at least one step size."""
    missing = {run.name: figure.halvings + 1 - len(curves[run.name]) for run in figure.runs}
    return " ".join(
        f"{name} fails with {count} of {figure.halvings + 1} step sizes."
        for name, count in missing.items()
        if count
    )


def errors(figure: Orders, source: Source, run: Run) -> list[tuple[float, float]]:
    """Return pairs (step size, error at the end of the time span), in order of decreasing step size.

    A pair is omitted if a step fails or the error is not finite.
    """
    problem = source.problem_of(run)
    exact = cached_reference(problem).state
    integrator = source.integrator(run)
    first, last = integrator.span
    points = []
    for k in range(figure.halvings + 1):
        steps = round((last - first) / run.h) * 2**k
        h = (last - first) / steps
        try:
            end = integrator.run(integrator.initial, h, steps, first)
        except StepFailed:
            continue
        size = distance(problem, end, exact)
        if math.isfinite(size):
            points.append((h, size))
    return points


def slope(points: Sequence[tuple[float, float]]) -> float:
    """Return the median of the observed orders between consecutive points (step size, error).

    If an error of two consecutive points is zero, they have no observed order. If there is no observed order,
    the result is 0.

    >>> slope([(0.4, 16.0), (0.2, 4.0), (0.1, 1.0), (0.05, 1.0)])
    2.0
    """
    rates = (
        math.log(a[1] / b[1]) / math.log(a[0] / b[0]) for a, b in pairwise(points) if a[1] > 0 and b[1] > 0
    )
    return statistics.median([*rates] or [0.0])
