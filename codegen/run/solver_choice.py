"""The choice of a solver for each block of equations: fixed-point iteration, Newton's method or simplified
Newton.

The matrices of the two Newton methods are described in :class:`codegen.ir.kernel.Newton`. Fixed-point
iteration needs no matrix, and each sweep multiplies the error by a factor O(h).

Usually the solver with the shortest predicted time is chosen. Each solver is tested in at most two trials
(:mod:`codegen.run.trial`). Every problem has an example with an initial state and a step size, called the
usual step size. The first trial makes :data:`STEPS` steps of the usual size from this initial state, and
counts sweeps and matrices. From these numbers, the cost model (:mod:`codegen.run.step_cost`) predicts the
time of a step. ``benchmarks/solver_choice.py`` compares the choices with measured times.

The second trial makes one step of :data:`LONGER` times the usual size. A solver is robust if it converges in
both trials and needs at most :data:`SWEEPS` sweeps in the second trial.

A robust solver is preferred if its predicted time is at most :data:`PRICE` times the time of the fastest
solver.

For linear equations, a robust solver is always preferred.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from codegen.errors import MethodError
from codegen.ir.differentiate import NotDifferentiable
from codegen.ir.expr import Expr, walk
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON, Kernel, Loop
from codegen.ir.program import Program
from codegen.kernel.newton import SMALL
from codegen.kernel.schedule import METHODS
from codegen.kernel.translate import to_kernel
from codegen.run.step_cost import WEIGHTS, Amounts, StepCost, inversion
from codegen.run.trial import Trial, Trials
from codegen.scene.problem import Problem
from orderconds.errors import UnknownName

AUTO = "auto"
CHOICES = (AUTO, NEWTON, SIMPLIFIED_NEWTON, FIXED_POINT)
"""The values of the option for the solver."""

ASKED = "as asked for"
"""The reason that is reported for a solver that the user has requested by name."""

STEPS, FEW_STEPS, LONGER = 20, 5, 8
"""The first trial of a solver makes STEPS steps of the usual size. For more than LARGE unknowns, it makes
FEW_STEPS steps.

The second trial makes one step. The step size is the usual size, multiplied by LONGER.
"""

SWEEPS = 50
"""A solver that needs more than SWEEPS sweeps in its second trial is not robust.

The second trial makes one step. The size of this step is the step size of the problem's example, multiplied
by LONGER.

SWEEPS is half of ``Loop.limit``, the largest number of sweeps of an iteration.
"""

PRICE = 4.0
"""A robust solver is preferred if its step takes at most PRICE times as long as a step with the fastest
solver.
"""

LARGE = 64
"""With more than LARGE unknowns, the first trial makes only FEW_STEPS steps.

With more than LARGE unknowns, continuation in h is not tried.
"""


NONLINEAR = 2
"""The degree that ``_degree`` returns for every nonlinear expression in the unknowns, such as u^3 or sin(u).

An expression without unknowns has the degree 0, and a linear expression has the degree 1.
"""


@dataclass(frozen=True)
class Choice:
    """The solver of one block of equations, and the reason for this choice.

    - ``label`` is the name of the block, and ``unknowns`` is the number of its unknowns.
    - ``compared`` contains a sentence on each solver that was considered.
    - ``converges`` is False if all trials of all solvers failed.
    """

    label: str
    unknowns: int
    solver: str
    reason: str
    compared: tuple[str, ...] = ()
    converges: bool = True

    def text(self) -> str:
        """Return the line that describes this choice in the header of emitted code.

        >>> Choice("stage 1", 3, "newton", "as asked for").text()
        "stage 1: Newton's method, 3 unknowns; as asked for"
        """
        return f"{self.label}: {METHODS[self.solver]}, {self.unknowns} unknowns; {self.reason}"

    def as_json(self) -> dict[str, str | int]:
        """Return this choice as an entry of the manifest (a JSON file that describes the emitted code)."""
        return {
            "label": self.label,
            "unknowns": self.unknowns,
            "solver": self.solver,
            "reason": self.reason,
        }


def known_solver(name: str) -> str:
    """Return ``name`` unchanged if it is in :data:`CHOICES`. Raise UnknownName otherwise."""
    if name not in CHOICES:
        raise UnknownName(f"unknown solver {name}", expected=" or ".join(CHOICES))
    return name


def solved(
    program: Program,
    scene: Problem,
    initial: tuple[float, ...],
    asked: str = AUTO,
    iterated: Kernel | None = None,
) -> tuple[Kernel, tuple[Choice, ...]]:
    """Return the kernel of a step, and the choice of the solver for each block of equations.

    - ``program`` is the method applied to the problem ``scene``.
    - ``initial`` is the initial state of the trials. In a trial, a solver makes a few steps. Run-time inputs
      are zero in a trial.
    - ``asked`` is the requested solver, one of :data:`CHOICES`.
    - ``iterated`` is the kernel with fixed-point iteration, if the caller has already built it.

    UnknownName is raised if ``asked`` is not in :data:`CHOICES`. MethodError is raised if the requested
    solver needs a matrix that cannot be computed.
    """
    known_solver(asked)
    fixed = iterated or to_kernel(program, scene)
    # An explicit method has no equations, so there is nothing to choose.
    if not fixed.loops:
        return fixed, ()
    if asked == AUTO:
        return _Selection(program, scene, initial, fixed).chosen()
    if asked == FIXED_POINT:
        return fixed, _choices(fixed, ASKED)
    try:
        kernel = to_kernel(program, scene, {loop.label: asked for loop in fixed.loops})
    # Both errors mean that the matrix of Newton's method cannot be computed.
    except (NotDifferentiable, ZeroDivisionError) as error:
        raise MethodError(
            f"{METHODS[asked]} is not possible for {program.name}: {error}",
            where=scene.name,
            expected="functions whose derivatives are known",
            hint=f"use --solver {FIXED_POINT}",
        ) from error
    return kernel, _choices(kernel, ASKED)


def _choices(kernel: Kernel, reason: str) -> tuple[Choice, ...]:
    return tuple(Choice(loop.label, len(loop.unknowns), loop.solver, reason) for loop in kernel.loops)


def unknowns_of(kernel: Kernel) -> int:
    """Return the total number of unknowns in all blocks of equations."""
    return sum(len(loop.unknowns) for loop in kernel.loops)


def trial_steps(kernel: Kernel) -> int:
    """Return the number of steps in the first trial of a kernel."""
    return STEPS if unknowns_of(kernel) <= LARGE else FEW_STEPS


def is_linear(loop: Loop) -> bool:
    """Return True if the equations u = g(u) of ``loop`` are linear in the unknowns u."""
    # A symbol that is not in this dictionary does not depend on the unknowns, so its degree is 0.
    degrees: dict[str, int] = dict.fromkeys(loop.unknowns, 1)
    # Each statement uses only names that are assigned above it.
    for let in loop.body:
        degrees[let.name] = _degree(let.value, degrees)
    return all(_degree(image, degrees) <= 1 for image in loop.images)


def _degree(root: Expr, degrees: Mapping[str, int]) -> int:
    """Return the degree of an expression as a polynomial in the unknowns: 0, 1 or NONLINEAR.

    Symbols that are not in ``degrees`` have the degree 0.
    """
    degree_of: dict[int, int] = {}
    for e in walk((root,)):
        # Arguments are visited before the expressions that contain them.
        args = [degree_of[a.id] for a in e.args]
        if e.op == "sym":
            degree = degrees.get(str(e.payload), 0)
        elif e.op in ("add", "sub", "neg"):
            degree = max(args)
        elif e.op == "mul":
            degree = sum(args)
        # A quotient is a polynomial in the unknowns only if the denominator contains no unknowns.
        elif e.op == "div" and not args[1]:
            degree = args[0]
        # Any other operation on the unknowns counts as nonlinear.
        else:
            degree = NONLINEAR if any(args) else 0
        # The degrees are limited to 2, because all nonlinear expressions are treated alike.
        degree_of[e.id] = min(degree, NONLINEAR)
    return degree_of[root.id]


class Candidate:
    """A kernel with its cost model and the results of two trials.

    The first trial makes steps of the usual size, and the second trial makes one longer step.
    """

    def __init__(self, kernel: Kernel, scene: Problem, initial: tuple[float, ...]) -> None:
        self.kernel, self.cost = kernel, StepCost(kernel)
        trials = Trials(kernel, scene, initial)
        self.usual = trials.run(trial_steps(kernel))
        # A solver that fails in steps of the usual size is not tried in a longer step.
        self.far = trials.run(1, LONGER) if self.usual.converged else None

    @property
    def robust(self) -> bool:
        """True if steps of the usual size converge, and a longer step converges in at most SWEEPS sweeps."""
        return self.far is not None and self.far.converged and self.far.most <= SWEEPS

    def block(self, k: int) -> float:
        """Return the predicted time in nanoseconds that block number ``k`` adds to a step."""
        return self.cost.block(k, self.usual.sweeps[k], self.usual.matrices[k]).cost(WEIGHTS)

    def step(self) -> float:
        """Return the predicted time of a step in nanoseconds."""
        return self.cost.step(self.usual.sweeps, self.usual.matrices)

    def text(self, k: int) -> str:
        """Return a text with the results of the trial steps for block number ``k`` of the kernel."""
        # If the first trial failed, there was no second trial, and ``far`` is None.
        if self.far is None:
            return f"fails in one of the first {self.usual.steps} steps of size h = {self.usual.h:.6g}"
        text = f"{counted(self.usual, k)}, predicted {self.block(k):.0f} ns"
        if self.robust:
            return text
        if not self.far.converged:
            return f"{text}; the solver does not converge in a step of size {LONGER} h"
        return f"{text}; takes {self.far.most} sweeps in a step of {LONGER} h"


def counted(trial: Trial, k: int) -> str:
    """Return a text such as ``3.35 sweeps and 0.1 matrices a step`` for block number ``k``.

    Both numbers are averages over the trial. If block ``k`` computed no matrix, the text contains only the
    sweeps.
    """
    text = amount(trial.sweeps[k], "sweep", "sweeps")
    if trial.matrices[k]:
        text += f" and {amount(trial.matrices[k], 'matrix', 'matrices')}"
    return f"{text} a step"


def amount(x: float, one: str, several: str) -> str:
    """Return a number as text with at most two decimals, followed by the noun ``one`` or ``several``.

    >>> [amount(x, "matrix", "matrices") for x in (1.0, 0.35, 2.0)]
    ['1 matrix', '0.35 matrices', '2 matrices']
    """
    # Trailing zeros and a trailing decimal point are removed.
    number = f"{x:.2f}".rstrip("0").rstrip(".")
    return f"{number} {one if number == '1' else several}"


def measured(trial: Trial, k: int) -> str:
    """Return the text of :func:`counted`, followed by the number and the size of the steps in the trial."""
    return f"{counted(trial, k)}, measured over the first {trial.steps} steps of size h = {trial.h:.6g}"


class _Selection:
    """Chooses the solvers for one program.

    - ``candidates[s]`` contains the kernel of the solver s and the results of its trials.
    - ``left_out[s]`` is the reason why the solver s has no trials.
    - ``refused[s]`` is the error message for a solver s whose kernel cannot be built.
    """

    def __init__(self, program: Program, scene: Problem, initial: tuple[float, ...], fixed: Kernel) -> None:
        self.program, self.scene, self.initial, self.fixed = program, scene, initial, fixed
        # Fixed-point iteration needs no matrix, so its kernel always exists.
        self.candidates = {FIXED_POINT: Candidate(fixed, scene, initial)}
        self.left_out: dict[str, str] = {}
        self.refused: dict[str, str] = {}

    def chosen(self) -> tuple[Kernel, tuple[Choice, ...]]:
        """Return the kernel, and the choice of the solver for each block."""
        # Newton's method is tried first. If it is fast, simplified Newton is not tried.
        for solver in (NEWTON, SIMPLIFIED_NEWTON):
            self.consider(solver)
        able = {s: c for s, c in self.candidates.items() if c.usual.converged}
        # If every solver fails, continuation in the step size h may help.
        if not able:
            return self.by_continuation()
        robust = {s: c for s, c in able.items() if c.robust}
        least = min(c.step() for c in able.values())
        if not (robust and self.linear) and all(c.step() > PRICE * least for c in robust.values()):
            robust = able
        blocks = range(len(self.fixed.loops))
        # Different blocks of one step may have different solvers.
        best = [min(robust, key=lambda s: robust[s].block(k)) for k in blocks]
        candidate = self.combined(robust, best)
        fastest = [min(able, key=lambda s: able[s].block(k)) for k in blocks]
        reasons = []
        for k, loop in enumerate(candidate.kernel.loops):
            reason = measured(candidate.usual, k)
            # If the fastest solver of this block is not robust, the text states the weakness of that solver.
            if fastest[k] not in robust:
                reason += f"; {METHODS[fastest[k]]} would be faster, but {self.weakness(fastest[k])}"
            elif NEWTON in self.refused:
                reason += f"; Newton's method is not possible: {self.refused[NEWTON]}"
            elif not candidate.robust:
                reason += f"; longer steps may fail, because the solver {self.weakness(loop.solver)}"
            reasons.append(reason)
        return candidate.kernel, self.choices(candidate.kernel, reasons)

    def consider(self, solver: str) -> None:
        """Build and try the kernel of a solver, unless a lower bound of its step time is too large."""
        least = self.least(solver)
        # For linear equations a robust solver is preferred even if it is slow.
        needed = solver == NEWTON and self.linear and not self.candidates[FIXED_POINT].robust
        if not needed and any(
            self.allowed(s, c) <= least for s, c in self.candidates.items() if c.usual.converged
        ):
            # The lower bound ``least`` of the step time is too large, so the kernel is not built.
            self.left_out[solver] = f"not tried, because it would take at least {least:.0f} ns a step"
            return
        try:
            kernel = self.kernel(dict.fromkeys((loop.label for loop in self.fixed.loops), solver))
        except (NotDifferentiable, ZeroDivisionError) as error:
            # The matrix of this solver cannot be computed.
            self.refused[solver] = str(error)
            self.left_out[solver] = f"not possible: {error}"
            return
        self.candidates[solver] = Candidate(kernel, self.scene, self.initial)

    @cached_property
    def linear(self) -> bool:
        """True if the equations of all blocks are linear."""
        return all(is_linear(loop) for loop in self.fixed.loops)

    def allowed(self, solver: str, candidate: Candidate) -> float:
        """Return a bound in nanoseconds. A solver whose step time reaches the bound is worse than ``solver``.

        ``candidate`` contains the results of the trials of ``solver``.
        """
        # A robust solver is preferred, even if it is slower by a factor of up to PRICE.
        sure = candidate.robust or (solver == NEWTON and unknowns_of(self.fixed) > LARGE)
        return candidate.step() * (1.0 if sure else PRICE)

    def kernel(self, solvers: Mapping[str, str]) -> Kernel:
        """Return the kernel of the program, where ``solvers`` maps the label of each block to its solver."""
        return to_kernel(self.program, self.scene, solvers)

    def least(self, solver: str) -> float:
        """Return a lower bound of the time of a step with ``solver``, in nanoseconds.

        The bound assumes one sweep for each block in each substep, and omits the inversion of small matrices.
        """
        # The number of matrices is 0 for each block here, because the loop below adds the work for matrices.
        total = self.candidates[FIXED_POINT].cost.amounts(
            [float(self.parts)] * len(self.fixed.loops), [0.0] * len(self.fixed.loops)
        )
        for loop in self.fixed.loops:
            n = len(loop.unknowns)
            # The product of the inverse and a vector takes n^2 multiplications and about n^2 additions.
            total += Amounts(arithmetic=2 * n * n).times(self.parts)
            # Simplified Newton inverts matrices in every step. In the best case, Newton's method inverts
            # matrices only in the first step of the trial.
            if n > SMALL:
                total += inversion(n).times(
                    self.parts / (1 if solver == SIMPLIFIED_NEWTON else trial_steps(self.fixed))
                )
        return total.cost(WEIGHTS)

    @property
    def parts(self) -> int:
        """The number of substeps in a step, or 1 if a step has no substeps."""
        return max(1, len(self.fixed.substeps))

    def combined(self, robust: Mapping[str, Candidate], best: list[str]) -> Candidate:
        """Choose between a combination of solvers and a single solver for all blocks.

        In the combination, the solver ``best[k]`` solves block number k, for each k. The single solver is the
        solver of the fastest candidate in ``robust``. The result is the candidate with the combination,
        unless the single solver is more reliable.
        """
        uniform = robust[min(robust, key=lambda s: robust[s].step())]
        if len(set(best)) == 1:
            return robust[best[0]]
        solvers = {loop.label: s for loop, s in zip(self.fixed.loops, best, strict=True)}
        # Each solver alone converged for all blocks, but the combination of solvers may fail.
        mixed = Candidate(self.kernel(solvers), self.scene, self.initial)
        return mixed if mixed.robust or (mixed.usual.converged and not uniform.robust) else uniform

    def by_continuation(self) -> tuple[Kernel, tuple[Choice, ...]]:
        """Return the kernel and the choices for a problem on which every solver failed in its first trial.

        With at most :data:`LARGE` unknowns, each solver makes a new trial with continuation in h (initial
        guesses from shorter steps). The fastest solver that converges in this trial is chosen. With more
        unknowns, or if no solver converges, Newton's method is chosen. If its matrix cannot be computed,
        fixed-point iteration is chosen.
        """
        kernels = {s: c.kernel for s, c in self.candidates.items()}
        small = unknowns_of(self.fixed) <= LARGE
        trials = {
            s: Trials(k, self.scene, self.initial, True).run(STEPS) for s, k in kernels.items() if small
        }
        able = [s for s, trial in trials.items() if trial.converged]
        costs = {s: self.candidates[s].cost.step(trials[s].sweeps, trials[s].matrices) for s in able}
        solver = (
            min(able, key=costs.__getitem__)
            if able
            else next(s for s in (NEWTON, FIXED_POINT) if s in kernels)
        )
        usual = self.candidates[solver].usual
        failed = f"no solver converges in the first {usual.steps} steps of size h = {usual.h:.6g}"
        reasons = []
        for k in range(len(self.fixed.loops)):
            if able:
                reasons.append(
                    f"{failed} without continuation in h (initial guesses from shorter steps); with "
                    f"continuation, the solver needs {counted(trials[solver], k)}"
                )
            else:
                # Continuation was tried only if ``small`` is True.
                reasons.append(f"{failed}{', with or without continuation in h' * small}; take shorter steps")
        choices = self.choices(kernels[solver], reasons)
        return kernels[solver], tuple(replace(choice, converges=bool(able)) for choice in choices)

    def weakness(self, solver: str) -> str:
        """Return the reason why a solver is not robust although its first trial converged."""
        far = self.candidates[solver].far
        # The first trial converged, so there was a second trial.
        assert far is not None
        if not far.converged:
            return f"does not converge in a step of {LONGER} h"
        return f"takes {far.most} sweeps in a step of {LONGER} h"

    def choices(self, kernel: Kernel, reasons: list[str]) -> tuple[Choice, ...]:
        """Return one ``Choice`` for each block of the kernel. The reason for block k is ``reasons[k]``."""
        choices = []
        for k, (loop, reason) in enumerate(zip(kernel.loops, reasons, strict=True)):
            # ``left_out`` contains the texts for the solvers that were not tried.
            figures = {s: c.text(k) for s, c in self.candidates.items()} | self.left_out
            compared = tuple(f"{METHODS[s]}: {text}" for s, text in figures.items())
            choices.append(Choice(loop.label, len(loop.unknowns), loop.solver, reason, compared))
        return tuple(choices)
