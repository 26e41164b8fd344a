"""Predicts the CPU time that a recipe needs to reach a required error.

A recipe consists of a method, one form of the equations, and the choice of equal steps or step-size control.
The method is run in Python, without emitted code. The number of equal steps is doubled until the error is
small. The number of steps for a required error is predicted from the most accurate run and the order of the
method. The time of a step is predicted as the sum of the times of its operations.

The prediction ignores that the compiler computes common subexpressions only once.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from codegen.error_estimate import order_of_estimate
from codegen.ir.expr import Expr, walk
from codegen.ir.program import Assign, Program, Solve
from codegen.ir.values import Var
from codegen.ir.vector_calls import component
from codegen.lab.efficiency.equations import Equations
from codegen.lab.efficiency.interpreted_runs import controlled_run, run
from codegen.lab.efficiency.numeric_program import NumericPrograms, symbolic
from codegen.lab.reference import Reference
from codegen.lower import lower, lower_composed, problem_for
from codegen.method import Method
from codegen.passes import plain_passes
from codegen.run.step_cost import WEIGHTS, Amounts
from codegen.scene.problem import Problem

FEW_STEPS, MANY_STEPS = 8, 1024
"""Limits for the number of equal steps in the test runs of a method.

A test run is made in Python, without emitted code. The first test run of a method has FEW_STEPS steps. The
number of steps is doubled from run to run, up to MANY_STEPS. A :class:`Bar` can change both limits.
"""

SMALL = 1e-2
"""An error counts as small if it is at most SMALL, relative to the size of the state.

A small error is assumed to be proportional to h^p, where h is the step size and p is the order of the method.
"""

PATIENCE = 0.4
"""The time limit for a series of test runs with equal steps, in seconds of CPU time.

For a series of runs with step-size control, the limit is PATIENCE/2.
"""

PARTS = 64
"""The number of equal intervals into which the time span is divided.

Some runs cover only the first interval. For these runs, the predicted error at the end of the time span is
PARTS times the error at the end of the first interval.
"""

TRIES = 3
"""If TRIES consecutive methods of one kind fail, fewer test runs are made for this kind.

A kind is a pair (family, explicit). Failures with equal steps and failures with step-size control are
counted separately:

- After TRIES failures with equal steps, the runs with equal steps cover only the first interval of the time
  span (:data:`PARTS`).
- After TRIES failures with step-size control, no runs with step-size control are made.
"""

FEWEST_SWEEPS = 3
USUAL_SWEEPS = 5
"""Two constants for the prediction of the time of an implicit step.

A sweep is one iteration for the implicit equations of the step. The predicted time includes at least
FEWEST_SWEEPS sweeps. Before the first run of a method, the number of sweeps is unknown, and USUAL_SWEEPS
sweeps are assumed.
"""

TOLERANCES = (1, 3, 5, 7, 9, 11)
"""In the interpreter, runs with step-size control have the tolerances 10^-k, with k in TOLERANCES."""

FAR = 10.0
"""A method is assumed to be at most FAR times as accurate as methods of higher order with the same CPU time.

Let e be the least error that is predicted for the methods of the orders p + 1 and p + 2, with a given CPU
time. With the same CPU time, the error of a method of order p is assumed to be at least e/FAR. Therefore
methods of order p are excluded if e/FAR exceeds the required error.
"""

CALL = 8.0
"""The time in nanoseconds that a run needs in each step to read and write the state."""

DIGITS = 16
"""The assumed number of correct decimal digits of the solutions of implicit equations in emitted code."""


@dataclass(frozen=True)
class Prediction:
    """The predicted error of a recipe with ``steps`` steps, and the predicted time of one step.

    - ``explicit``: True if the method solves no equations.
    - ``outside``: the time in nanoseconds that one step needs for all operations outside the implicit
      equations.
    - ``sweep``: the time in nanoseconds of one sweep (iteration) over all implicit equations of a step.
    - ``sweeps``: the mean number of sweeps in a step.
    - ``steps``: the number of steps for which ``error`` is predicted.
    - ``error``: the predicted error with ``steps`` steps. The error is predicted from runs of the method in
      an interpreter, and is infinite if these runs fail.
    - ``rough``: True if ``error`` is predicted from a run with a large error (above :data:`SMALL`) or from a
      run over a part of the time span. Also True if all runs fail.
    - ``controlled``: the prediction with step-size control, or None.
    - ``vague``: True if ``error`` is finite but not small, and ``steps`` is at most MANY_STEPS.
    - ``failure``: the reason if the method cannot be used for the scene, and otherwise ''.
    """

    method: str
    order: int
    family: str = ""
    explicit: bool = True
    outside: float = 0.0
    sweep: float = 0.0
    sweeps: float = 0.0
    steps: int = FEW_STEPS
    error: float = math.inf
    rough: bool = False
    controlled: Prediction | None = None
    vague: bool = False
    failure: str = ""

    def count(self, error: float) -> float:
        """Return the predicted number of steps that a run needs to reach ``error``.

        If no test run of the method has a finite error, the number of steps cannot be predicted, and the
        result is infinity.
        """
        if not math.isfinite(self.error):
            return math.inf
        return max(1.0, self.steps * math.pow(self.error / error, 1 / max(self.order, 1)))

    def seconds(self, error: float) -> float:
        """Return the predicted CPU time in seconds of a run with the given error."""
        count = self.count(error)
        if not math.isfinite(count):
            return math.inf
        sweeps = self.sweeps
        if sweeps:
            # Each sweep multiplies the error of the unknowns by a factor proportional to the step size.
            sweeps = DIGITS / max(DIGITS / sweeps + math.log10(count / self.steps), 0.5)
        return 1e-9 * count * (CALL + self.outside + max(sweeps, FEWEST_SWEEPS) * self.sweep)

    def error_within(self, seconds: float) -> float:
        """Return the predicted error of a run that takes ``seconds`` seconds of CPU time.

        The result is infinity if a single step takes longer than ``seconds``.
        """
        steps = seconds / (1e-9 * (CALL + self.outside + max(self.sweeps, FEWEST_SWEEPS) * self.sweep))
        return self.error * math.pow(self.steps / steps, self.order) if steps >= 1 else math.inf


@dataclass(frozen=True)
class Bar:
    """Limits on the error and the CPU time of a recipe.

    - ``error``: the largest accepted error.
    - ``seconds``: the largest accepted CPU time in seconds.
    - ``least``: triples (family, x, e) for :meth:`too_high`. Each triple describes the methods of the family
      that have the order p + 1 or p + 2, where p is the order of the recipe. If x is True, only explicit
      methods count. If x is False, only implicit methods count. The number e is the smallest predicted error
      of these methods in a run of ``seconds`` seconds of CPU time. The family '' represents all families.
    - ``steps``: the number of time steps in the first test run of the recipe. The step size is constant in
      this run.
    - ``explicit``: True if only explicit methods are accepted.
    """

    error: float
    seconds: float = math.inf
    least: tuple[tuple[str, bool, float], ...] = ()
    steps: int = FEW_STEPS
    explicit: bool = False

    def too_high(self, family: str, explicit: bool, step_seconds: float = 0.0) -> bool:
        """Return True if the limits exclude a method of the given family.

        The argument ``explicit`` is True for an explicit method. This object contains limits for methods of
        one order p. A method is excluded in three cases:

        - ``step_seconds``, the predicted CPU time of one step, exceeds ``self.seconds``.
        - The method is implicit, and the limits accept only explicit methods (``self.explicit`` is True).
        - Even methods of the higher orders p + 1 and p + 2 are far too inaccurate: their smallest predicted
          error e is more than :data:`FAR` times ``self.error``. The number e comes from the triple
          (``family``, ``explicit``, e) in ``self.least``. If this triple is missing, e comes from the triple
          ('', ``explicit``, e) for all families. If both triples are missing, e is 0.
        """
        if step_seconds > self.seconds or (self.explicit and not explicit):
            return True
        known = {(name, kind): error for name, kind, error in self.least}
        return known.get((family, explicit), known.get(("", explicit), 0.0)) > FAR * self.error

    def most(self, step_seconds: float) -> float:
        """Return the largest number of steps for a test run of a method in the interpreter.

        A test run predicts the error of a run of compiled code with the same number of steps. The run of
        compiled code may take at most ``self.seconds`` of CPU time, and one of its steps takes about
        ``step_seconds``. Therefore it has at most q = ``self.seconds``/``step_seconds`` steps, and test runs
        with more steps are useless. The result is q, but at most :data:`MANY_STEPS` and at least
        ``self.steps``. If ``step_seconds`` is 0, the result is MANY_STEPS.
        """
        return max(self.steps, min(MANY_STEPS, self.seconds / step_seconds)) if step_seconds else MANY_STEPS

    def hopeless(self, family: str) -> bool:
        """Return True if :meth:`too_high` excludes both the explicit and the implicit methods of a family."""
        return self.too_high(family, True) and self.too_high(family, False)


@dataclass
class Predictor:
    """Predicts the CPU times of recipes for the equations of a scene.

    - ``equations``: the equations of the scene in certain coordinates, for example with unit quaternions.
    - ``exact``: the reference solution.
    - ``beginning``: None, or a function that returns the pair (equations, reference solution) for the first
      part of the time span. The length of this part is 1/:data:`PARTS` of the length of the time span. The
      reference solution is the state at the end of this part.
    - ``failures``: for each kind of method, a count of the methods that failed in runs with a constant step
      size. If a method of a kind succeeds, the count for this kind is set to zero.
    - ``uncontrolled``: for each kind of method, a count of the methods that failed with step-size control. A
      method fails if none of its runs with step-size control has a small error (:data:`SMALL`). If the count
      is :data:`TRIES`, step-size control is no longer used for this kind. If a method of a kind succeeds, the
      count for this kind is set to zero.
    - ``costs``: for each operation, a pair. The first entry is the predicted time of the operation in
      nanoseconds. The second entry contains the number of components of each result of the operation.
    """

    equations: Equations
    exact: Reference
    beginning: Callable[[], tuple[Equations, Reference]] | None = None
    failures: Counter[tuple[str, bool]] = field(default_factory=Counter)
    uncontrolled: Counter[tuple[str, bool]] = field(default_factory=Counter)
    costs: dict[str, tuple[float, tuple[int, ...]]] = field(default_factory=dict)
    numeric: NumericPrograms = field(default_factory=NumericPrograms)

    def predict(self, method: Method, order: int, *bars: Bar, controlled: Method | None = None) -> Prediction:
        """Return the prediction for a method of the given order.

        A bar contains limits on the error and the CPU time. If the limits of every bar exclude the method
        (:meth:`Bar.too_high`), no run is made, and the attribute ``error`` of the result is infinity.
        ``controlled`` is the same method with step-size control, or None. Raises InputError if the method
        cannot be used for the scene.
        """
        problem, program, widths = self._program(method)
        outside, sweep = self.cost(program, problem, widths)
        explicit = not any(isinstance(s, Solve) for s in program.body)
        step = 1e-9 * (outside + USUAL_SWEEPS * sweep)
        bars = tuple(bar for bar in bars if not bar.too_high(method.family, explicit, step))
        if not bars:
            return Prediction(method.label, order, method.family, explicit, outside, sweep)
        numeric = self.numeric.of(program, problem, widths)
        first, most = min(bar.steps for bar in bars), max(bar.most(step) for bar in bars)
        kind, reached = (method.family, explicit), (FEW_STEPS, math.inf, 0.0)
        if self.failures[kind] < TRIES:
            end = time.process_time() + PATIENCE
            reached = _reached(numeric, problem, self.equations, self.exact, first, most, end)
            self.failures[kind] = 0 if math.isfinite(reached[1]) else self.failures[kind] + 1
        large = SMALL * size_of(self.exact)
        rough = reached[1] > large
        # In two cases, runs over the first part of the time span are made. In the first case, no run over the
        # whole time span succeeds. In the second case, the error of the most accurate run is large, and the
        # largest number of steps, ``most``, is at least MANY_STEPS.
        if self.beginning is not None and (reached[1] == math.inf or (rough and most >= MANY_STEPS)):
            equations, exact = self.beginning()
            part = replace(problem, span=equations.problem.span)
            end = time.process_time() + PATIENCE
            steps, error, sweeps = _reached(numeric, part, equations, exact, FEW_STEPS, MANY_STEPS, end)
            if math.isfinite(error):
                reached = PARTS * steps, PARTS * error, sweeps
        steps, error, sweeps = reached
        amounts = (outside, sweep, sweeps, steps, error)
        known = Prediction(method.label, order, method.family, explicit, *amounts, rough)
        known = replace(known, vague=large < error < math.inf and steps <= MANY_STEPS)
        if controlled is None or not rough:
            return known
        return replace(known, controlled=self.controlled(controlled, known, min(bar.error for bar in bars)))

    def controlled(self, method: Method, equal: Prediction, target: float) -> Prediction | None:
        """Return the prediction for a method with step-size control, or None.

        The interpreted runs use decreasing tolerances (:data:`TOLERANCES`). The runs end after a failure,
        after an error of at most ``target``, or after PATIENCE/4 seconds of CPU time. The result is None in
        three cases:

        - No run has a small error (:data:`SMALL`).
        - The method has no embedded solution.
        - The last :data:`TRIES` methods of the same kind failed with step-size control.
        """
        kind = (method.family, equal.explicit)
        if method.embedded() is None or self.uncontrolled[kind] >= TRIES:
            return None
        problem, program, widths = self._program(method)
        outside, sweep = self.cost(program, problem, widths)
        outside += sum(matrix(s, widths, sweep) for s in program.body if isinstance(s, Solve))
        numeric = self.numeric.of(program, problem, widths)
        order = order_of_estimate(method, self.equations.problem)
        known = replace(equal, outside=outside, sweep=sweep, error=math.inf, controlled=None)
        start = time.process_time()
        end = start + PATIENCE / 2
        for exponent in TOLERANCES:
            try:
                state, steps, sweeps = controlled_run(numeric, problem, order, 10.0**-exponent, end)
                error = self.equations.error(state, self.exact)
            except (ArithmeticError, ValueError):
                break
            if error < known.error:
                known = replace(known, steps=steps, sweeps=sweeps, error=error, rough=False, vague=False)
            # If more than half of the permitted time is used, the next run would probably exceed the limit.
            if error <= target or 2 * time.process_time() > start + end:
                break
        reached = known.error <= SMALL * size_of(self.exact)
        self.uncontrolled[kind] = 0 if reached else self.uncontrolled[kind] + 1
        return known if reached else None

    def _program(self, method: Method) -> tuple[Problem, Program, dict[Var, int]]:
        """Return the problem, the program of one step, and the number of components of each program input."""
        scene = self.equations.problem
        problem = problem_for(scene, method)
        program = lower_composed(scene, method) or lower(scene, method)
        for each in plain_passes(problem):
            program = each.run(program)
        return problem, program, widths_of_inputs(program, problem)

    def cost(self, program: Program, problem: Problem, widths: dict[Var, int]) -> tuple[float, float]:
        """Return two predicted times (outside, sweep) in nanoseconds.

        ``outside`` is the time that one step needs for all operations outside the implicit equations.
        ``sweep`` is the time of one sweep. A sweep is one iteration over all implicit equations. ``widths``
        maps each input of the program to its number of components. The function adds an entry for each
        computed variable to ``widths``.
        """
        outside = sweep = 0.0
        for statement in program.body:
            if isinstance(statement, Assign):
                outside += self._operation(statement, problem, widths)
                continue
            widths.update((u, widths[s]) for u, s in zip(statement.unknowns, statement.starts, strict=True))
            sweep += sum(self._operation(assign, problem, widths) for assign in statement.body)
            sweep += WEIGHTS.swept * sum(widths[u] for u in statement.unknowns)
        parts = max(1, len(program.substeps))
        return parts * outside, parts * sweep

    def _operation(self, assign: Assign, problem: Problem, widths: dict[Var, int]) -> float:
        """Return the predicted time of one assignment in nanoseconds.

        The number of components of each assigned variable is stored in ``widths``.
        """
        shape = tuple((a.kind.value, widths[a]) for a in assign.args)
        # The key contains the group, because methods may use different groups for the same scene.
        key = f"{problem.group.name} {len(problem.roots)} {assign.operation!r} {shape}"
        if key not in self.costs:
            known = symbolic(assign, problem, shape)
            self.costs[key] = amounts(known.expressions).cost(WEIGHTS), known.widths
        cost, results = self.costs[key]
        widths.update(zip(assign.targets, results, strict=True))
        return cost


def _reached(
    program: Program,
    problem: Problem,
    equations: Equations,
    exact: Reference,
    steps: int,
    most: float,
    end: float,
) -> tuple[int, float, float]:
    """Run a program with N, 2 N, 4 N, ... equal steps, where N is ``steps``.

    No run has more than ``most`` steps. No further run is started if the error is small (:data:`SMALL`), or
    if the CPU time of the process (``time.process_time``) reaches ``end``.

    Returns three numbers for the most accurate run: the number of steps, the error (infinite if all runs
    failed), and the number of sweeps (iterations for implicit equations) in a step.
    """
    size = size_of(exact)
    best = FEW_STEPS, math.inf, 0.0
    while steps <= most and time.process_time() < end:
        try:
            state, sweeps = run(program, problem, steps, end)
            error = equations.error(state, exact)
        except (ArithmeticError, ValueError):
            error, sweeps = math.inf, 0.0
        if error < best[1]:
            best = steps, error, sweeps
        if error <= SMALL * size:
            break
        steps *= 2
    return best


def matrix(block: Solve, widths: Mapping[Var, int], sweep: float) -> float:
    """Return the predicted time in nanoseconds to compute and to invert the matrix of Newton's method.

    ``block`` is a system of implicit equations. ``sweep`` is the time to evaluate the equations once.
    ``widths`` contains the number of components of each unknown.
    """
    own = [widths[u] for u in block.unknowns]
    return max(own) * sweep + WEIGHTS.arithmetic * sum(own) ** 2 + WEIGHTS.cubes * sum(own) ** 3


def size_of(exact: Reference) -> float:
    """Return the size of the reference solution: the Euclidean norm of the final state, but at least 1."""
    return max(1.0, math.hypot(*map(float, exact.state)))


def widths_of_inputs(program: Program, problem: Problem) -> dict[Var, int]:
    """Return the number of components of each input of a program."""
    fields = {block.name: len(block.symbols) for block in problem.state}
    return {var: fields.get(var.name, 1) for var in program.inputs}


def amounts(roots: Sequence[Expr]) -> Amounts:
    """Count the operations in expressions: calls, divisions, and all other arithmetic operations.

    >>> from codegen.ir.expr import Space
    >>> x, y = map(Space().sym, "xy")
    >>> amounts([x * y + x / y]) == Amounts(arithmetic=2, divisions=1)
    True
    """
    arithmetic = divisions = calls = 0
    for node in walk(roots):
        if node.op in ("add", "sub", "mul", "pow"):
            arithmetic += 1
        divisions += node.op == "div"
        vector = component(node.payload) if node.op == "call" else None
        if vector is not None:
            # The operations of a vector function are counted once, for its first component.
            function, index = vector
            arithmetic += sum(function.operations.values()) if index == 0 else 0
        else:
            calls += node.op == "call"
    return Amounts(arithmetic=arithmetic, divisions=divisions, calls=calls)
