"""Runs an emitted method with equal steps, and measures errors and CPU times.

The runs give one curve of a work-precision diagram.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from codegen.certify import certified_order
from codegen.emitter import Compiled, compile_method
from codegen.integrator import Statistics
from codegen.ir.operations import Operation
from codegen.ir.program import Assign
from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.work_precision import (
    BUDGET,
    Row,
    at_rounding,
    beyond_budget,
    doubled_steps,
)
from codegen.lab.reference import Reference
from codegen.lab.runner import Emitted, RunFailed
from codegen.lab.timing import Overhead, span_times, spread
from codegen.method import Method
from codegen.printers import DEFAULT
from codegen.printers import target as known_target
from codegen.scene.problem import Problem


@dataclass
class EmittedCandidate:
    """A method that is emitted to a target, compiled, and run over the time span with equal steps.

    - ``exact``: the reference solution of the scene.
    - ``target``: the name of a programming language, such as ``c``.
    - ``budget``: the limit of the CPU time of a run, in seconds.
    - ``precompiled``: the result of :func:`compile_method`, or None. If ``precompiled`` is given, the
      attribute ``emit_seconds`` does not include the time of :func:`compile_method`.
    - ``equations``: the form of the equations, by default the form that the scene states.
    """

    scene: Problem
    method: Method
    exact: Reference
    target: str = DEFAULT
    budget: float = BUDGET
    precompiled: Compiled | None = None
    equations: Equations | None = None

    def __post_init__(self) -> None:
        start = time.perf_counter()
        self.equations = self.equations or Equations(self.scene)
        self.form = self.equations.name
        problem = self.equations.problem
        self.compiled: Compiled = self.precompiled or compile_method(problem, self.method)
        self.runner = Emitted(self.compiled, self.target, certified_order(self.method, problem))
        self.label = self.method.label
        self.key = repr(sorted(self.runner.artifact.manifest["files"].items()))
        self.emit_seconds = time.perf_counter() - start
        self.compile_seconds = 0.0
        self.overhead = Overhead(lambda: self.run(1.0, 0))

    def controls(self) -> Iterator[float]:
        """Yield the numbers of steps of the runs: 1, 2, 4, ..."""
        return doubled_steps()

    def prepare(self) -> None:
        """Compile the module, measure the time of the compiler, and load the module.

        The module is compiled even if it is in the cache of compiled modules.
        """
        measure = known_target(self.target).compile_seconds
        if measure is not None:
            self.compile_seconds = measure(self.runner.artifact.files)
        self.runner.final(0)

    def error(self, state: Sequence[float]) -> float:
        """Return the error of a final state: its distance from the reference solution, in the norm of the
        scene.
        """
        assert self.equations is not None
        return self.equations.error(state, self.exact)

    def measure(self, control: float) -> Row:
        """Run over the time span, and return the error and the CPU time as a row.

        ``control`` is the number of steps. If the run fails, the row contains the reason.
        """
        steps = int(control)
        first, last = self.scene.span
        h = float(Fraction(last - first) / steps)
        statistics = Statistics()
        try:
            state = self.runner.final(steps, statistics)
            error = self.error(state)
            if not math.isfinite(error):
                raise RunFailed("the final state is not finite")
        except ArithmeticError as failure:
            return self._row(control, h, steps, failure=str(failure))
        times = span_times(lambda n: self.run(control, n), self.overhead)
        return self._row(control, h, steps, error, times, statistics)

    def run(self, control: float, spans: int) -> int:
        """Run over ``spans`` time spans of the scene with equal steps, and return the total number of steps.

        ``control`` is the number of steps for one time span.
        """
        self.runner.final(int(control), spans=spans)
        return spans * int(control)

    def enough(self, rows: Sequence[Row]) -> bool:
        """Return True if the next run would take too long, or if rounding errors dominate.

        ``rows`` contains the results of the previous runs.
        """
        return beyond_budget(rows, self.budget) or at_rounding(rows, self.exact)

    def _row(
        self,
        control: float,
        h: float,
        steps: int,
        error: float | None = None,
        times: Sequence[float] = (),
        statistics: Statistics | None = None,
        failure: str = "",
    ) -> Row:
        iterations = statistics.sweeps if statistics is not None else []
        return Row(
            scene=self.scene.name,
            method=self.label,
            target=self.target,
            control=control,
            h=h,
            steps=steps,
            error=error,
            seconds=times[0] if times else None,
            spread=spread(times),
            ns_per_step=1e9 * times[0] / steps if times else None,
            evaluations=None if failure else self._count(lambda o: o.evaluates_scene, steps, iterations),
            exponentials=None if failure else self._count(lambda o: o.exponentials, steps, iterations),
            iterations=None if failure else sum(iterations),
            emit_seconds=self.emit_seconds,
            compile_seconds=self.compile_seconds,
            failure=failure,
            form=self.form,
        )

    def _count(self, cost: Callable[[Operation], int], steps: int, iterations: Sequence[int]) -> int:
        """Return the sum of ``cost`` over all operations that a run executes.

        ``iterations`` contains the number of iterations of each system of implicit equations in the whole
        run.
        """
        total, block = 0, 0
        parts = steps * max(1, len(self.compiled.program.substeps))
        for statement in self.compiled.program.body:
            if isinstance(statement, Assign):
                total += parts * cost(statement.operation)
                continue
            inside = sum(cost(a.operation) for a in statement.body)
            total += inside * iterations[block]
            block += 1
        return total
