"""Runs the methods of a figure as emitted C code, and evaluates the quantities that the figure shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy

from codegen import scenes
from codegen.artifact import Artifact
from codegen.emitter import emit
from codegen.errors import SceneError
from codegen.integrator import Integrator, StepFailed
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate
from codegen.lab.long_runs.trajectory import ArrayFunction, array_functions
from codegen.lab.progress import Progress
from codegen.loader import load
from codegen.printers import DEFAULT
from codegen.scene.extended_phase_space import extended
from codegen.scene.figure import STEP, Quantity, Run
from codegen.scene.formulas import Reader
from codegen.scene.problem import TIME, Problem

STEP_LIMIT = 10**7
"""The largest number of steps of a run with step-size control."""


@dataclass(frozen=True)
class Path:
    """The computed states of one run or of one sweep.

    A sweep is a sequence of runs with different values of a parameter or of the step size.

    - ``times``: the output times of the run. For a sweep, the values of the parameter or of the step size.
    - ``states``: each row is the state at one output time. For a sweep, each row is the final state of one
      run.
    - ``failure``: the reason why a run ended early, or '' if all steps succeeded.
    """

    times: numpy.ndarray
    states: numpy.ndarray
    failure: str = ""


class Source:
    """Runs emitted modules for the figures of one scene.

    The emitted modules and the results of :meth:`path` are stored and reused.
    """

    def __init__(self, problem: Problem, progress: Progress = str) -> None:
        self.problem, self.progress = problem, progress
        self._problems: dict[str, Problem] = {"": problem}
        self._artifacts: dict[tuple[object, ...], Artifact] = {}
        self._integrators: dict[tuple[object, ...], Integrator] = {}
        self._paths: dict[Run, Path] = {}

    def problem_of(self, run: Run) -> Problem:
        """Return the scene that ``run`` names. The default is ``self.problem``."""
        if run.scene not in self._problems:
            own = run.scene == scenes.EXTENDED
            self._problems[run.scene] = extended(self.problem) if own else scenes.load(run.scene)
        return self._problems[run.scene]

    def artifact(self, run: Run) -> Artifact:
        """Return the emitted module for a run. The first call emits this module, and later calls reuse it."""
        key = _key(run)
        if key not in self._artifacts:
            self.progress(f"{self.problem.name}, {run.name}: compiling")
            names = () if run.sweep is None or run.sweep.name == STEP else (run.sweep.name,)
            controlled = run.tolerance > 0
            problem = self.problem_of(run)
            self._artifacts[key] = emit(
                *(problem, run.method, DEFAULT), parameters=names, adaptive=controlled, integrate=controlled
            )
        return self._artifacts[key]

    def integrator(self, run: Run) -> Integrator:
        """Return the loaded module for a run. The first call loads this module, and later calls reuse it."""
        key = _key(run)
        if key not in self._integrators:
            self._integrators[key] = load(self.artifact(run))
        return self._integrators[key]

    def path(self, run: Run) -> Path:
        """Return the states of a run at its output times.

        For a sweep over a parameter or the step size, return the final state for each swept value.
        """
        if run not in self._paths:
            integrator = self.integrator(run)
            self.progress(f"{self.problem.name}, {run.name}: {run.steps} steps")
            if run.sweep is not None:
                self._paths[run] = _swept(self, run)
            elif run.tolerance > 0:
                self._paths[run] = _controlled(integrator, run)
            else:
                self._paths[run] = _equal_steps(integrator, run)
        return self._paths[run]

    def end(self, run: Run, value: float | None = None) -> list[float]:
        """Return the final state of a run.

        A sweep repeats a run with different values of one parameter or of the step size. If the run has a
        sweep, ``value`` is one of these values. Raises :class:`codegen.integrator.StepFailed` if a step
        fails.
        """
        integrator = self.integrator(run)
        swept = "" if run.sweep is None or value is None else run.sweep.name
        h = run.h if swept != STEP or value is None else value
        start, first = integrator.initial, integrator.span[0]
        state: list[float]
        if not swept or swept == STEP:
            state = integrator.run(start, h, run.steps, first)
        else:
            state = integrator.run(start, h, run.steps, first, **cast("Mapping[str, Any]", {swept: value}))
        return state

    def start(self, run: Run, quantities: Sequence[Quantity]) -> numpy.ndarray:
        """Return the values of the quantities at the initial state of a run."""
        integrator = self.integrator(run)
        state, time = numpy.array(integrator.initial)[:, None], numpy.array([integrator.span[0]])
        column: numpy.ndarray = formulas(self.problem_of(run), quantities)(state, time)[:, 0]
        return column

    def values(self, run: Run, quantities: Sequence[Quantity]) -> numpy.ndarray:
        """Return the values of the quantities at all states of ``path(run)``.

        Each row of the result contains the values of one quantity.
        """
        path, problem, rows = self.path(run), self.problem_of(run), self.path(run).states.T
        if run.sweep is None:
            return formulas(problem, quantities)(rows, path.times)
        # For a sweep, ``path.states`` contains final states, and ``path.times`` contains the varied values.
        values, first = path.times, self.integrator(run).span[0]
        if run.sweep.name == STEP:
            return formulas(problem, quantities)(rows, first + values * run.steps)
        end = numpy.full(len(values), first + run.h * run.steps)
        return formulas(problem, quantities, run.sweep.name)(numpy.vstack([rows, values]), end)

    def beside(self, run: Run, reference: Run, quantity: Quantity) -> numpy.ndarray:
        """Return the values of a quantity along the reference run, at the output times of ``run``.

        Raises :class:`codegen.errors.SceneError` if the reference run has no states at the output times of
        ``run``.
        """
        times, exact = self.path(run).times, self.path(reference).times
        count = len(times)
        if len(exact) < count or numpy.abs(exact[:count] - times).max() > 1e-6 * (1.0 + abs(times).max()):
            raise SceneError(
                f"the reference {reference.name} and the run {run.name} have different output times",
                where=self.problem.name,
                expected="a reference run that has at least as many outputs as the run, "
                "with the same interval between outputs (step size times stride)",
            )
        row: numpy.ndarray = self.values(reference, [quantity])[0][:count]
        return row


def formulas(problem: Problem, quantities: Sequence[Quantity], swept: str = "") -> ArrayFunction:
    """Return a function of the arrays ``states`` and ``times`` that evaluates quantities of a scene.

    Each row of ``states`` contains the values of one coordinate. Each row of the result contains the values
    of one quantity. If ``swept`` is the name of a parameter, ``states`` has an additional last row with the
    values of this parameter.
    :class:`codegen.errors.SceneError` is raised for a formula with an unknown symbol.
    """
    import sympy

    names = (swept,) if swept else ()
    # The swept parameter must stay a symbol in the formulas, as run-time parameters do.
    problem = replace(problem, runtime=(*problem.runtime, *names))
    reader = Reader(problem.name, [sympy.Symbol(s) for s in problem.symbols])
    domain = ExprDomain(reader.space)
    state = tuple(reader.space.sym(s) for s in problem.symbols)
    time = reader.space.sym(TIME)
    known = problem.values(domain, state, time)

    def root(quantity: Quantity) -> Expr:
        if isinstance(quantity, str):
            return _invariant(problem, domain, quantity)
        value: Expr = evaluate([reader.scalar(quantity, "the formula of a figure")], domain, known)[0]
        return value

    return array_functions(problem, {"": tuple(map(root, quantities))}, names)[""]


def _invariant(problem: Problem, domain: ExprDomain, name: str) -> Expr:
    """Return the formula of the invariant ``name`` of a scene, or raise SceneError if there is none."""
    if name not in problem.invariants:
        raise SceneError(
            f"a figure shows the unknown quantity {name!r}",
            where=problem.name,
            expected=f"one of {', '.join(problem.invariants)}, or a sympy formula",
        )
    state = tuple(domain.space.sym(s) for s in problem.symbols)
    value: Expr = problem.invariant(domain, name, state, domain.space.sym(TIME))
    return value


def _key(run: Run) -> tuple[object, ...]:
    """Return a dictionary key: runs with equal keys share one emitted module."""
    return run.scene, run.method, run.sweep and run.sweep.name, run.tolerance > 0


def sweep_values(run: Run) -> list[float]:
    """Return the parameter values or step sizes for the repetitions of a run.

    If the run has no sweep, the result is [].
    """
    sweep = run.sweep
    if sweep is None:
        return []
    width = (sweep.last - sweep.first) / max(sweep.count - 1, 1)
    return [sweep.first + width * k for k in range(sweep.count)]


def _swept(source: Source, run: Run) -> Path:
    states, values = [], sweep_values(run)
    for value in values:
        try:
            states.append(source.end(run, value))
        except StepFailed as failed:
            return Path(numpy.array(values[: len(states)]), numpy.array(states), failed.reason)
    return Path(numpy.array(values), numpy.array(states))


def _equal_steps(integrator: Integrator, run: Run) -> Path:
    first, steps, failure = integrator.span[0], run.steps, ""
    state = numpy.array(integrator.initial)
    try:
        states = integrator.trajectory(state, run.h, steps, run.stride, first)
    except StepFailed as failed:
        failure = f"step {failed.step + 1}: {failed.reason}"
        states = integrator.trajectory(state, run.h, failed.step, run.stride, first)
    rows = numpy.asarray(states)
    return Path(first + run.h * run.stride * numpy.arange(len(rows)), rows, failure)


def _controlled(integrator: Integrator, run: Run) -> Path:
    first = integrator.span[0]
    times = [first + run.h * run.stride * k for k in range(run.steps // run.stride + 1)]
    start, tolerance = numpy.array(integrator.initial), run.tolerance
    arrival = integrator.integrate(
        start, first, t_eval=times, rtol=tolerance, atol=tolerance, limit=STEP_LIMIT
    )
    return Path(numpy.array(times), numpy.asarray(arrival.states))
