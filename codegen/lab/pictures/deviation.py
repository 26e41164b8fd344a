"""Draws the largest deviation of a quantity up to the time t, as a function of t.

If ``figure.window`` is positive, the largest deviation in each group of ``figure.window`` consecutive states
is drawn instead. The deviation is the absolute difference from the value along the reference run. Without a
reference run, the deviation is the absolute difference from the initial value.
"""

from __future__ import annotations

import numpy

from codegen.lab.page.axes import label_axes
from codegen.lab.page.figures import spread
from codegen.lab.page.formatting import scientific
from codegen.lab.pictures.canvas import MARKS, WIDE, Canvas, failures, styles
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.scene.figure import Deviation, Run

LEAST = 1e-17
"""Deviations smaller than LEAST are drawn as LEAST."""

GROWS = 1.02
"""A constant that limits the number of points of a curve.

The curve shows the largest deviation up to the time t as a function of t. The levels of the deviation are the
numbers LEAST * GROWS**k with k = 0, 1, 2, and so on. For each level, the first point that reaches the level
is drawn. The last point is always drawn. All other points are omitted.
"""


def draw(figure: Deviation, source: Source) -> Drawn:
    """Return the picture, with one curve for each run. The vertical axis is logarithmic."""
    looks = styles(figure)
    numbers: dict[str, float] = {}
    canvas = Canvas.of(1, height=4.2, width=WIDE)
    axes = canvas.panels[0]
    axes.set_yscale("log")
    for k, run in enumerate(figure.runs):
        times, sizes = maxima(figure, source, run)
        chosen = spread(times.tolist(), MARKS, k / len(figure.runs))
        texts = [f"{run.name}: {scientific(sizes[i])} at t = {times[i]:.4g}" for i in chosen]
        canvas.line(axes, (times, sizes), run.name, looks[run.name], chosen, texts, {"linewidth": 1.0})
        numbers[run.name] = float(sizes.max())
    label_axes(axes, "time t", figure.axis)
    largest = "; ".join(f"{name}: largest deviation {scientific(x, 3)}" for name, x in numbers.items())
    note = failures(figure.runs, [source.path(run).failure for run in figure.runs])
    return Drawn(canvas.finish(figure, source.problem, f"{largest}."), note, numbers)


def maxima(figure: Deviation, source: Source, run: Run) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return an array of times, and an array with the largest deviation for each of these times.

    If ``figure.window`` is 0, the entry for a time t is the largest deviation up to t. In this case, the
    array of times contains the last time and all times at which the largest deviation reaches a new level
    (:data:`GROWS` defines the levels). If ``figure.window`` is positive, each entry is the largest deviation
    in a group of ``figure.window`` states, and the time of the entry is the end of the group.
    """
    values, times = source.values(run, [figure.quantity])[0], source.path(run).times
    start = values[0] if figure.reference is None else source.beside(run, figure.reference, figure.quantity)
    sizes = numpy.maximum(numpy.abs(values - start), LEAST)[1:]
    if not figure.window:
        largest = numpy.maximum.accumulate(sizes)
        levels = numpy.floor(numpy.log(largest / LEAST) / numpy.log(GROWS))
        shown = numpy.flatnonzero(numpy.diff(levels, prepend=-1.0))
        kept = numpy.unique([*shown, len(largest) - 1])
        return times[1:][kept], largest[kept]
    ends = [*range(figure.window, len(sizes), figure.window), len(sizes)]
    starts = [0, *ends[:-1]]
    return times[ends], numpy.array([sizes[a:b].max() for a, b in zip(starts, ends, strict=True)])
