"""Measures the CPU time that each recipe needs to reach a required error.

A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.
The accuracy of the runs is increased until two consecutive runs have small enough errors. One run is not
sufficient, because the error of a single run can be small by accident.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field, replace

from codegen.artifact import Artifact
from codegen.certify import certified_order
from codegen.emitter import Compiled, emit_compiled
from codegen.integrator import Integrator
from codegen.ir.domain import FloatDomain
from codegen.lab.efficiency.candidates import Recipe
from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.features import Features, features
from codegen.lab.efficiency.work_precision import MOST_STEPS
from codegen.lab.number_types import Vector
from codegen.lab.reference import Reference
from codegen.lab.timing import Overhead, span_times
from codegen.loader import load
from codegen.printers import DEFAULT
from codegen.printers import target as known_target
from codegen.scene.classical_forms import PRINTED

HALVINGS = 6
"""The maximum number of bisection steps in the search for the fastest run that is accurate enough.

The bisection varies the number of equal steps or the tolerance of the step-size control.
"""

FINEST = 15.0
"""The exponent k of the smallest tolerance 10^-k."""

LONGEST = 0.2
"""After a run of more than LONGEST seconds of CPU time, no run with higher accuracy is made."""

BRIEF = 0.01
"""A CPU time below BRIEF seconds never counts as too long.

Short times are not reliable, because the first run of a module is slower than later runs.
"""

PATIENT = 8.0
"""A factor in the time limit of :meth:`Racer.reach`.

If a run takes more than PATIENT * ``best`` + BRIEF seconds of CPU time, no run with higher accuracy is made.
Here ``best`` is the argument of :meth:`Racer.reach`. The term :data:`BRIEF` is added because times below
BRIEF seconds are not reliable.
"""


@dataclass(frozen=True)
class Entry:
    """An entry of the race. The race is a comparison of the CPU times of recipes.

    - ``recipe``: a method, one form of the equations, and the choice of equal steps or step-size control.
    - ``artifact``: the module that is emitted for the recipe.
    - ``features``: properties of the emitted method, for example whether the method is symplectic.
    - ``label``: the label of the method.
    """

    recipe: Recipe
    artifact: Artifact
    features: Features
    label: str

    @property
    def code(self) -> str:
        """The code of the step, without the header comment, the module name, and the prefix of the functions.

        Two recipes with equal code compute the same steps.
        """
        manifest = self.artifact.manifest
        source = self.artifact.files[known_target(manifest["target"]).step_file(manifest["module"])]
        body = source.replace(manifest["interface"]["prefix"], "").replace(manifest["module"], "")
        return body.partition("*/")[2]


def entry(recipe: Recipe, compiled: Compiled) -> Entry:
    """Emit the code of a compiled recipe, and return the recipe as an entry of the race."""
    order = certified_order(compiled.method, compiled.scene)
    artifact = emit_compiled(compiled, DEFAULT, order=order)
    properties = features(compiled, artifact, recipe.label)
    if recipe.form != PRINTED:
        # The recipe integrates a system on R^n, so the states may leave the manifold of the scene.
        properties = replace(properties, on_manifold=False)
    return Entry(recipe, artifact, properties, compiled.method.label)


@dataclass(frozen=True)
class Result:
    """The fastest run whose error is at most the required error.

    If no run reaches the required error, ``control``, ``steps`` and ``error`` describe the most accurate run.

    - ``control``: the number of equal steps, or the exponent k of the tolerance 10^-k.
    - ``steps``: the number of accepted steps.
    - ``error``: the error of the run.
    - ``seconds``: the CPU time of the run, or infinity if no run reaches the required error.
    - ``reached``: False if no run reaches the required error.
    - ``failure``: a message if every run failed, and otherwise ''.
    """

    entry: Entry
    control: float
    steps: int
    error: float
    seconds: float
    reached: bool = True
    failure: str = ""

    @property
    def tolerance(self) -> float | None:
        """The relative and absolute tolerance of a run, or None for a run with equal steps."""
        return 10.0**-self.control if self.entry.recipe.adaptive else None


@dataclass
class Racer:
    """Runs one entry of the race.

    A run is specified by its control: the number of equal steps, or the exponent k of the tolerance 10^-k.

    - ``equations``: the equations in the form that the entry integrates.
    - ``exact``: the reference solution at the end of the time span.
    - ``errors``: a dictionary that maps the control of each run to its error.
    - ``counts``: a dictionary that maps the control of each successful run to its number of steps.
    """

    equations: Equations
    exact: Reference
    entry: Entry
    errors: dict[float, float] = field(default_factory=dict)
    counts: dict[float, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.integrator: Integrator = load(self.entry.artifact)
        problem = self.equations.problem
        self.initial = list(problem.initial(FloatDomain(0.0)))
        self.first, self.last = map(float, problem.span)
        self.overhead = Overhead(lambda: self.run(1.0, 0))

    def run(self, control: float, spans: int = 1) -> tuple[Vector, int]:
        """Run the integrator over ``spans`` time spans. Return the final state and the number of steps.

        ``control`` is the number of equal steps in one time span, or the exponent k of the tolerance 10^-k.
        """
        length = self.last - self.first
        if self.entry.recipe.adaptive:
            tolerance, last = (10.0**-control, self.first + spans * length)
            end = self.integrator.adaptive(
                self.initial, self.first, last, rtol=tolerance, atol=tolerance, limit=MOST_STEPS
            )
            return tuple(end.state), end.accepted
        steps = round(control)
        h = length / max(steps, 1)
        return tuple(self.integrator.run(self.initial, h, spans * steps, self.first)), spans * steps

    def prepare(self, control: float) -> None:
        """Do nothing, because an emitted module needs no preparation before a run."""

    def error(self, control: float) -> float:
        """Return the error of the run with the given control, or infinity if the run fails.

        ``control`` is the number of equal steps, or the exponent k of the tolerance 10^-k.
        """
        if control not in self.errors:
            try:
                state, self.counts[control] = self.run(control)
                self.errors[control] = self.equations.error(state, self.exact)
            except ArithmeticError:
                self.errors[control] = math.inf
        return self.errors[control]

    def seconds(self, control: float, batch: float = 0.002, batches: int = 5) -> float:
        """Return the CPU time of a run in seconds, without the overhead of calling emitted code.

        ``control`` is the number of equal steps, or the exponent k of the tolerance 10^-k. The arguments
        ``batch`` and ``batches`` are explained at :func:`codegen.lab.timing.samples`.
        """
        return span_times(lambda n: self.run(control, n)[1], self.overhead, batch, batches)[0]

    def reach(self, error: float, best: float = math.inf) -> Result:
        """Return the result for the fastest run whose error is at most ``error``.

        A recipe is a method on one form of the equations, with equal steps or with step-size control. The
        argument ``best`` is the CPU time in seconds that another recipe needs for this error, or infinity.
        After a run that takes much longer than ``best``, no run with higher accuracy is made
        (:data:`PATIENT`). If the error is not reached, the attribute ``reached`` of the result is False.
        """
        longest = min(LONGEST, PATIENT * best + BRIEF)
        control, fine = self._refined(error, longest)
        if not fine:
            known = {c: e for c, e in self.errors.items() if math.isfinite(e)}
            if not known:
                return Result(self.entry, 0.0, 0, math.inf, math.inf, False, "every run failed")
            control = min(known, key=lambda c: known[c])
            return Result(self.entry, control, self.counts[control], known[control], math.inf, False)
        control = self._coarsened(control, error)
        return Result(self.entry, control, self.counts[control], self.errors[control], self.seconds(control))

    def halved(self, result: Result) -> Result | None:
        """Return the result of a run with half the step size of ``result``.

        The result is None if the recipe has step-size control, if the run fails, or if the run would have
        more than MOST_STEPS steps.
        """
        control = 2.0 * result.control
        if self.entry.recipe.adaptive or control > MOST_STEPS or not math.isfinite(self.error(control)):
            return None
        steps, error = self.counts[control], self.errors[control]
        return replace(result, control=control, steps=steps, error=error, seconds=self.seconds(control))

    def _refined(self, error: float, longest: float) -> tuple[float, bool]:
        """Increase the accuracy of the runs until two consecutive runs have small enough errors.

        The control of a run is the number of equal steps, or the exponent k of the tolerance 10^-k. If two
        consecutive runs have small enough errors, return (c, True), where c is the control of the first of
        these runs. Otherwise, return (c, False) with a number c that has no meaning.
        """
        control, seen = 1.0, [self.error(1.0)]
        while control <= (FINEST if self.entry.recipe.adaptive else MOST_STEPS):
            finer = self._finer(control)
            self.prepare(finer)
            start = time.process_time()
            seen.append(self.error(finer))
            if seen[-2] <= error and seen[-1] <= 2 * error:
                return control, True
            if time.process_time() - start > longest or self._at_rounding(seen):
                break
            control = self._finer(control)
        return control, False

    def _at_rounding(self, values: list[float]) -> bool:
        """Return True if rounding errors probably prevent further convergence.

        ``values`` contains the errors of successive runs.
        """
        size = max(1.0, math.hypot(*map(float, self.exact.state)))
        return len(values) > 4 and min(values) < 1e-9 * size and min(values[-3:]) > min(values[:-3]) / 2

    def _finer(self, control: float) -> float:
        return control + 1.0 if self.entry.recipe.adaptive else 2.0 * control

    def _coarsened(self, control: float, error: float) -> float:
        """Reduce ``control`` by bisection, and return the smallest value that reaches ``error``.

        ``control`` is the number of equal steps, or the exponent k of the tolerance 10^-k. The given value
        must reach the error.
        """
        adaptive = self.entry.recipe.adaptive
        low = control - 1.0 if adaptive else control / 2
        for _ in range(HALVINGS):
            middle = (low + control) / 2 if adaptive else float(round(math.sqrt(low * control)))
            if middle in (low, control) or low < 0.5:
                break
            if self.error(middle) <= error:
                control = middle
            else:
                low = middle
        return control
