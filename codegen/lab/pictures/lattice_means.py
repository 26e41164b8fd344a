"""Draws mean values over the sites of a lattice as functions of time."""

from __future__ import annotations

from typing import Any

import numpy

from codegen.errors import SceneError
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import evaluate
from codegen.lab.long_runs.trajectory import FUNCTIONS
from codegen.lab.page.axes import label_axes
from codegen.lab.page.series_style import numbered
from codegen.lab.pictures.canvas import WIDE, Canvas, marks
from codegen.lab.pictures.picture import Drawn
from codegen.lab.pictures.source import Source
from codegen.lab.straight_line_field import straight_line
from codegen.loader import load_lattice
from codegen.scene.figure import LatticeMeans, Quantity, Run
from codegen.scene.formulas import Reader
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import Offset, neighbour, offset_of


def draw(figure: LatticeMeans, source: Source) -> Drawn:
    """Return the picture, with one curve for each quantity of each run.

    Raises :class:`codegen.errors.SceneError` if the scene is not a chain or lattice, or if a step fails.
    """
    canvas = Canvas.of(1, 1, 3.4, width=WIDE)
    (axes,) = canvas.panels
    numbers: dict[str, dict[str, list[float]]] = {}
    total = len(figure.runs) * len(figure.quantities)
    for k, run in enumerate(figure.runs):
        times, rows = _series(figure, source, run)
        numbers[run.name] = {}
        for j, (name, row) in enumerate(zip(figure.quantities, rows.T, strict=True)):
            place = k * len(figure.quantities) + j
            label = ", ".join(([run.name] if len(figure.runs) > 1 else []) + [name])
            style = numbered(place)
            chosen = marks(len(times), (place + 0.5) / total)
            texts = [f"{label}: {row[i]:.6g} at t = {times[i]:.4g}" for i in chosen]
            canvas.line(axes, (times, row), label, style, chosen, texts)
            numbers[run.name][name] = [float(row[0]), float(row.max()), float(row[-1])]
    label_axes(axes, "time t", figure.axis)
    note = f"Lattice of {' x '.join(map(str, figure.shape))} sites. "
    note += " ".join(
        f"{run}, {name}: {first:.6g} at the start, maximum {most:.6g}, {last:.6g} at the end."
        for run, series in numbers.items()
        for name, (first, most, last) in series.items()
    )
    return Drawn(canvas.finish(figure, source.problem, note), note, numbers)


def _series(figure: LatticeMeans, source: Source, run: Run) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Return the output times of a run, and an array. Entry (i, j) is the mean of quantity j at time i."""
    problem = source.problem
    evaluate_means = means(problem, list(figure.quantities.values()))
    lattice = load_lattice(source.artifact(run))
    states, first = numpy.asarray(figure.start(figure.shape), dtype=float), float(problem.span[0])
    times, rows = [first], [evaluate_means(states, first)]
    for done in range(run.stride, run.steps + 1, run.stride):
        source.progress(f"{problem.name}, {run.name}: step {done} of {run.steps}")
        result = lattice.run(states, run.h, run.stride, times[-1])
        if not result.ok:
            raise SceneError(
                f"{run.name} fails after t = {times[-1]:g}: {result.reason}",
                where=problem.name,
                expected="a run without a failed step",
                hint="use smaller steps",
            )
        states = result.states
        times.append(first + run.h * done)
        rows.append(evaluate_means(states, times[-1]))
    return numpy.array(times), numpy.array(rows)


def means(problem: Problem, quantities: list[Quantity]) -> Any:
    """Return a function of (states, time) that computes the mean of each quantity over all sites.

    A quantity is a formula in the coordinates of a site. On a periodic lattice, the formula may also contain
    coordinates of neighbours. Raises :class:`codegen.errors.SceneError` if the scene is not a chain or
    lattice, or if a quantity is not such a formula.
    """
    import sympy

    if problem.sites is None:
        raise SceneError(
            "the figure shows means over sites, but the scene has no sites",
            where=problem.name,
            expected="a chain or lattice (SiteScene)",
        )
    own = [sympy.Symbol(s, real=True) for s in problem.symbols]
    free = {str(s) for q in quantities for s in getattr(q, "free_symbols", ())}
    offsets = sorted({o for s in free if (o := offset_of(s, problem.symbols)) is not None})
    if offsets and not problem.sites.periodic:
        raise SceneError(
            "a formula contains coordinates of neighbours, but the lattice has an open boundary",
            where=problem.name,
            expected="a formula without coordinates of neighbours",
        )
    around = [str(s) for offset in offsets for s in neighbour(own, offset)]
    reader = Reader(problem.name, own)
    domain = ExprDomain(reader.space)
    state = tuple(map(reader.space.sym, problem.symbols))
    known = problem.values(domain, state, reader.space.sym(TIME))
    known |= {name: reader.space.sym(name) for name in around}
    roots = [reader.scalar(_formula(problem, q), "the formula of a figure", more=around) for q in quantities]
    names = (*problem.symbols, *around)
    line = straight_line(problem.name, names, tuple(evaluate(roots, domain, known)))
    compute = line.python(float, FUNCTIONS)

    def mean(states: numpy.ndarray, time: float) -> list[float]:
        arrays = [
            moved for offset in ((0,) * (states.ndim - 1), *offsets) for moved in _moved(states, offset)
        ]
        return [float(numpy.mean(x)) for x in compute(arrays, time)]

    return mean


def _formula(problem: Problem, quantity: Quantity) -> Any:
    """Return ``quantity``, or raise SceneError if ``quantity`` is a string instead of a formula."""
    if isinstance(quantity, str):
        raise SceneError(
            f"the quantity {quantity!r} is not a formula", where=problem.name, expected="a sympy formula"
        )
    return quantity


def _moved(states: numpy.ndarray, offset: Offset) -> list[numpy.ndarray]:
    """Shift the lattice by ``offset``, and return one array for each coordinate of a site.

    At the index k, the array of a coordinate contains the value of this coordinate at the site
    k + ``offset``. The lattice counts as periodic.
    """
    rolled = numpy.roll(states, [-d for d in offset], axis=tuple(range(len(offset))))
    return [rolled[..., k] for k in range(states.shape[-1])]
