"""Draws the errors of runs against a parameter, and marks the least error."""

from __future__ import annotations

import math

import numpy

from codegen.errors import SceneError
from codegen.integrator import StepFailed
from codegen.lab.distance import distance
from codegen.lab.page.axes import annotate, few_decades, label_axes
from codegen.lab.page.formatting import scientific
from codegen.lab.page.svg import INK
from codegen.lab.pictures.canvas import Canvas, failures, marks, styles
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source, sweep_values
from codegen.scene.figure import Run, Scan, Sweep

DIGITS = 1e-8
"""The tolerance of the minimisation as a fraction of the length of the parameter interval."""


def draw(figure: Scan, source: Source) -> Drawn:
    """Return the picture: the error of each run against the parameter, with a cross at the least error."""
    looks = styles(figure)
    numbers: dict[str, dict[str, float]] = {}
    canvas = Canvas.of(1, height=3.4)
    axes = canvas.panels[0]
    axes.set_yscale("log")
    notes = []
    for k, run in enumerate(figure.runs):
        values = sweep_values(run)
        sizes = [error(source, figure, run, value) for value in values]
        chosen = marks(len(values), k / len(figure.runs))
        name = _sweep(run).name
        texts = [f"{run.name}: {scientific(sizes[i])} at {name} = {values[i]:.4g}" for i in chosen]
        if len(figure.runs) == 1:
            canvas.title(axes, run.name)
        canvas.line(axes, (values, sizes), run.name, looks[run.name], chosen, texts)
        best, least = minimum(source, figure, run, values, sizes)
        axes.plot([best], [least], marker="x", color=INK, markersize=7, zorder=5)
        annotate(axes, f"{name} = {best:.4g}", (best, least), (6, 4), "left")
        numbers[run.name] = {name: best, "error": least}
        notes.append(f"The least error of {run.name} is {scientific(least, 3)}, at {name} = {best:.5g}.")
    label_axes(axes, _sweep(figure.runs[0]).name, figure.axis or "distance from the final reference state")
    few_decades(axes)
    notes.append(failures(figure.runs, [source.path(run).failure for run in figure.runs]))
    note = " ".join(filter(None, notes))
    return Drawn(canvas.finish(figure, source.problem, note), note, numbers)


def error(source: Source, figure: Scan, run: Run, value: float) -> float:
    """Return the error of a run: the distance of its final state from the final state of the reference run.

    In the run, the varied parameter has the value ``value``. If a step of the run fails, the result is
    infinity. If the reference run fails, SceneError is raised.
    """
    if figure.reference is None:
        raise ValueError("expected a reference run in a scan, found none")
    try:
        exact = source.end(figure.reference)
    except StepFailed as failed:
        raise SceneError(
            f"the reference run fails: {failed}",
            where=source.problem.name,
            expected="a reference run whose steps all succeed",
        ) from None
    try:
        return distance(source.problem_of(run), source.end(run, value), exact)
    except StepFailed:
        return math.inf


def minimum(
    source: Source, figure: Scan, run: Run, values: list[float], sizes: list[float]
) -> tuple[float, float]:
    """Return a pair: the parameter value with the least error, and the least error.

    ``values`` is sorted, and ``sizes`` contains the error for each value. Let x be the entry of ``values``
    with the least error. Brent's method minimises the error in the interval from the entry before x to the
    entry after x.
    """
    from scipy.optimize import minimize_scalar

    k = int(numpy.argmin(sizes))
    ends = values[max(k - 1, 0)], values[min(k + 1, len(values) - 1)]
    width = abs(values[-1] - values[0])
    result = minimize_scalar(
        lambda x: error(source, figure, run, float(x)), bounds=ends, options={"xatol": DIGITS * width}
    )
    return min((float(result.fun), float(result.x)), (sizes[k], values[k]))[::-1]


def _sweep(run: Run) -> Sweep:
    if run.sweep is None:
        raise ValueError(
            "expected the argument sweep (the values of the varied parameter) in every run of a scan, "
            "found a run without this argument"
        )
    return run.sweep
