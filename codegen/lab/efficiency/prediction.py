"""Predicts the time in which a recipe reaches an error, from a few interpreted steps and counted operations.

A recipe is a method with equal steps or step-size control, on one form of the equations. The step program is
interpreted with a small number of steps. The error of this run and the order of the method give the number of
steps for another error. If the error remains large, a run with step-size control is also interpreted. The
cost of a step is the sum of the costs of its operations.

The prediction ignores that the compiler computes common subexpressions only once. Therefore the prediction
only decides which recipes are measured first, and which recipes are too slow to be compiled.
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
"""The number of steps is doubled from FEW_STEPS to MANY_STEPS until the error is small."""

SMALL = 1e-2
"""An error below SMALL, relative to the size of the state, is approximately proportional to h^p, where p is
the order of the method."""

PATIENCE = 0.4
"""The interpretation of one recipe ends after this CPU time in seconds."""

PARTS = 64
"""The span is divided into PARTS equal parts. If no run on the whole span succeeds, only the first part is
interpreted.

The error on the whole span is then predicted as PARTS times the error on the first part.
"""

TRIES = 3
"""If TRIES consecutive methods of one kind failed on the whole span, further methods of this kind are
interpreted only on the first part of the span.
"""

FEWEST_SWEEPS = 3
USUAL_SWEEPS = 5
"""FEWEST_SWEEPS is the smallest, and USUAL_SWEEPS the usual number of sweeps (iterations) over an implicit
block.
"""

TOLERANCES = (1, 3, 5, 7, 9, 11)
"""The exponents k of the tolerances 10^-k of interpreted runs with step-size control."""

FAR = 10.0
"""A method is not interpreted if methods of the next two higher orders have more than FAR times the required
error. The method is then assumed to miss this error too.
"""

CALL = 8.0
"""The time in nanoseconds that the loop around a step needs to read and write the state."""

DIGITS = 16
"""Emitted code solves implicit equations to DIGITS decimal digits, the interpreter to DIGITS/2 digits."""


@dataclass(frozen=True)
class Prediction:
    """The error of a recipe with ``steps`` steps, and the cost of a step.

    - ``outside``: the time in nanoseconds of all operations of a step outside of implicit blocks.
    - ``sweep``: the time in nanoseconds of one iteration over all implicit blocks.
    - ``sweeps``: the average number of iterations in a step.
    - ``explicit``: True if no equation is solved.
    - ``error``: infinity if the interpreted runs failed.
    - ``rough``: True if all interpreted runs on the whole span had large errors.
    - ``controlled``: the prediction with step-size control, or None.
    - ``vague``: True if ``error`` is large, so that the predicted time for a small error is too short.
    - ``failure``: the reason if the scene or the family does not accept the method.
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
        """Return the predicted number of steps for an error, or infinity if the interpreted runs failed."""
        if not math.isfinite(self.error):
            return math.inf
        return max(1.0, self.steps * math.pow(self.error / error, 1 / max(self.order, 1)))

    def seconds(self, error: float) -> float:
        """Return the predicted CPU seconds of a run that reaches an error."""
        count = self.count(error)
        if not math.isfinite(count):
            return math.inf
        sweeps = self.sweeps
        if sweeps:
            # Each iteration reduces the error by a factor proportional to h, so short steps need fewer
            # sweeps.
            sweeps = DIGITS / max(DIGITS / sweeps + math.log10(count / self.steps), 0.5)
        return 1e-9 * count * (CALL + self.outside + max(sweeps, FEWEST_SWEEPS) * self.sweep)

    def error_within(self, seconds: float) -> float:
        """Return the predicted error of a run of ``seconds`` seconds, or infinity if a single step takes
        longer.
        """
        steps = seconds / (1e-9 * (CALL + self.outside + max(self.sweeps, FEWEST_SWEEPS) * self.sweep))
        return self.error * math.pow(self.steps / steps, self.order) if steps >= 1 else math.inf


@dataclass(frozen=True)
class Bar:
    """The bar that a recipe must reach: an error of at most ``error`` in at most ``seconds``.

    ``least`` contains triples (family, explicit, error): the least errors that methods of the next two higher
    orders reach in ``seconds``. The family '' means all families. ``steps`` is the number of steps of the
    first interpreted run. If ``explicit`` is true, methods that solve equations are excluded.
    """

    error: float
    seconds: float = math.inf
    least: tuple[tuple[str, bool, float], ...] = ()
    steps: int = FEW_STEPS
    explicit: bool = False

    def too_high(self, family: str, explicit: bool, step_seconds: float = 0.0) -> bool:
        """Return True if a method whose step takes at least ``step_seconds`` cannot reach the bar."""
        if step_seconds > self.seconds or (self.explicit and not explicit):
            return True
        known = {(name, kind): error for name, kind, error in self.least}
        return known.get((family, explicit), known.get(("", explicit), 0.0)) > FAR * self.error

    def most(self, step_seconds: float) -> float:
        """Return the largest number of steps to interpret, for steps that take ``step_seconds`` in compiled
        code.

        A compiled run with more steps would exceed the time limit ``seconds`` of the bar. The result is
        between ``steps`` and :data:`MANY_STEPS`.
        """
        return max(self.steps, min(MANY_STEPS, self.seconds / step_seconds)) if step_seconds else MANY_STEPS

    def hopeless(self, family: str) -> bool:
        """Return True if neither explicit nor implicit methods of a family can reach the bar."""
        return self.too_high(family, True) and self.too_high(family, False)


@dataclass
class Predictor:
    """Predicts the times of recipes for one form of a scene.

    ``beginning`` returns the equations on the first of :data:`PARTS` parts of the span, and the reference at
    the end of this part. A kind of method is a pair: the family, and True for explicit methods. For each
    kind, ``failures`` counts the runs on the whole span that failed since the last success. ``uncontrolled``
    counts the failed runs with step-size control.
    """

    equations: Equations
    exact: Reference
    beginning: Callable[[], tuple[Equations, Reference]] | None = None
    failures: Counter[tuple[str, bool]] = field(default_factory=Counter)
    uncontrolled: Counter[tuple[str, bool]] = field(default_factory=Counter)
    costs: dict[str, tuple[float, tuple[int, ...]]] = field(default_factory=dict)
    numeric: NumericPrograms = field(default_factory=NumericPrograms)

    def predict(self, method: Method, order: int, *bars: Bar, controlled: Method | None = None) -> Prediction:
        """Return the prediction for a method of the given order. Raise InputError if the scene does not
        accept the method.

        Each bar is an error and a time. If the method can reach no bar, the predicted error is infinite.
        ``controlled`` is the same method with step-size control.
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
        # If the error is large because the bars permit few steps, the method is too slow for the bars. Then
        # the first part of the span is not interpreted.
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
        """Return the prediction for a method with step-size control, or None if there is no accurate run.

        ``equal`` is the prediction for equal steps. The tolerance is reduced until the error is at most
        ``target`` or the time for interpreted runs is used up.
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
            # A run with a smaller tolerance takes longer, so no run begins in the second half of the time.
            if error <= target or 2 * time.process_time() > start + end:
                break
        reached = known.error <= SMALL * size_of(self.exact)
        self.uncontrolled[kind] = 0 if reached else self.uncontrolled[kind] + 1
        return known if reached else None

    def _program(self, method: Method) -> tuple[Problem, Program, dict[Var, int]]:
        """Return the problem that the method integrates, its step program, and the numbers of components of
        the inputs of the program.
        """
        scene = self.equations.problem
        problem = problem_for(scene, method)
        program = lower_composed(scene, method) or lower(scene, method)
        for each in plain_passes(problem):
            program = each.run(program)
        return problem, program, widths_of_inputs(program, problem)

    def cost(self, program: Program, problem: Problem, widths: dict[Var, int]) -> tuple[float, float]:
        """Return the time of the operations outside of implicit blocks, and the time of one sweep over all
        implicit blocks. Both times are in nanoseconds.

        ``widths`` contains the numbers of components of the inputs. The function adds an entry for every
        other variable.
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
        """Return the time of one assignment in nanoseconds. Add the numbers of components of its targets to
        ``widths``.
        """
        shape = tuple((a.kind.value, widths[a]) for a in assign.args)
        # Problems of the same scene may have different groups, so the key contains the group.
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
    """Return the number of steps, the error and the sweeps per step of the first run with a small error.

    If there is no such run, the results belong to the most accurate run. The number of steps is doubled up to
    ``most``, or until the process has used ``end`` CPU seconds. The error is infinite if all runs failed.
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
    """Return the time in nanoseconds for the matrix of Newton's method and its inversion.

    ``sweep`` is the time of one evaluation of the equations. All stages evaluate the same field. Therefore
    one evaluation of all equations gives one column of the derivative for every stage.
    """
    own = [widths[u] for u in block.unknowns]
    return max(own) * sweep + WEIGHTS.arithmetic * sum(own) ** 2 + WEIGHTS.cubes * sum(own) ** 3


def size_of(exact: Reference) -> float:
    """Return the Euclidean norm of the final state, or 1 if the norm is less than 1."""
    return max(1.0, math.hypot(*map(float, exact.state)))


def widths_of_inputs(program: Program, problem: Problem) -> dict[Var, int]:
    """Return the numbers of components of the inputs of a program."""
    fields = {block.name: len(block.symbols) for block in problem.state}
    return {var: fields.get(var.name, 1) for var in program.inputs}


def amounts(roots: Sequence[Expr]) -> Amounts:
    """Return the numbers of arithmetic operations, divisions and calls in expressions.

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
            # One call computes all results of a vector function. Its operations are counted at index 0 only.
            function, index = vector
            arithmetic += sum(function.operations.values()) if index == 0 else 0
        else:
            calls += node.op == "call"
    return Amounts(arithmetic=arithmetic, divisions=divisions, calls=calls)
