"""How each block of equations is solved: by a fixed point, Newton's method or chords, whichever is cheapest.

Newton's method keeps an exact matrix as long as it contracts; chords compute one, to first order in h, in
each step. A fixed point needs none. Its sweeps gain one power of h each, those of equation (3.19) of H.
Marthinsen's thesis too, because momenta are computed within a sweep; were they unknowns beside the
velocities, two sweeps would gain one.

All are tried: the executor (:mod:`codegen.run.execute`) makes a few steps from the initial state, of the
length that the usage example takes. It makes the sweeps and matrices that emitted code makes; these are
weighed by their operations. A solver that also converges in steps :data:`LONGER` times as long, in few
sweeps, is preferred: near its limit a method fails at a user's next step size.

Where there are more than :data:`MANY` unknowns, in one block or several, a fixed point that needs at most
:data:`FEW` sweeps is accepted: products with the inverse cost most of what the fewer sweeps of Newton's
method save, or more, and its matrices are longer than the step. For long steps chords are not tried where
Newton's method works on residuals and converges.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from codegen.errors import MethodError
from codegen.ir.angle_depth import chain
from codegen.ir.differentiate import NotDifferentiable
from codegen.ir.kernel import CHORD, FIXED_POINT, NEWTON, Kernel, Loop
from codegen.ir.program import Program
from codegen.kernel.operations import matrix_of, operations
from codegen.kernel.schedule import METHODS, arrange
from codegen.kernel.translate import is_long, to_kernel
from codegen.run.execute import Machine
from codegen.run.floats import EmittedFloats
from codegen.run.plan import STATISTICS, Plan
from codegen.run.precision import DOUBLE
from codegen.run.terms import OK, STATUSES
from codegen.run.unit import unit_of
from codegen.scene.problem import Problem
from orderconds.errors import UnknownName

AUTO = "auto"
CHOICES = (AUTO, NEWTON, CHORD, FIXED_POINT)
"""What a caller may ask for."""

STEPS, LONGER, PARTS = 20, 8, 100
"""Steps of a trial; how much longer steps of the second trial are; how many steps make the scene's span."""

SWEEPS = 20
"""The most sweeps that a longer step may take."""

MANY, FEW = 20, 5.0
"""In how many sweeps fixed points must find more than so many unknowns to be taken at once."""

WEIGHTS = {"add": 1, "mul": 1, "div": 4}
"""What operations cost; calls cost :data:`CALL`."""
CALL = 15

RELIABLE = {NEWTON: 0.8}
"""How much less a solver must cost: how long a matrix serves depends on where the motion is."""


MEASURED = f"counted over the first {STEPS} steps of the example"
"""What the numbers of a reason are: the executor makes the sweeps of emitted code in these steps."""


@dataclass(frozen=True)
class Choice:
    """How one block is solved, and why."""

    label: str
    unknowns: int
    solver: str
    reason: str

    def text(self) -> str:
        """Say it in words."""
        return f"{self.label}: {METHODS[self.solver]}, {self.unknowns} unknowns ({self.reason})"


@dataclass(frozen=True)
class _Trial:
    """What a few steps took: sweeps a step by block, matrices a step and block, and whether all were made."""

    sweeps: tuple[float, ...]
    matrices: float
    good: bool


def known_solver(name: str) -> str:
    """Return the name; an UnknownName where it is none of :data:`CHOICES`."""
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
    """Return the kernel of a program with every block solved as ``asked``, and what was chosen.

    ``initial`` is the state that trials start from; signals that are taken at run time are zero in them.
    ``asked`` is one of :data:`CHOICES`; UnknownName for another, MethodError for Newton's method where a
    function of the scene or group has no derivative here. ``iterated`` is the kernel with fixed points, for a
    caller that has it.
    """
    known_solver(asked)
    fixed = iterated or to_kernel(program, scene)
    labels = [loop.label for loop in fixed.loops]
    if not labels:
        return fixed, ()
    if asked == FIXED_POINT:
        return fixed, _choices(fixed, dict.fromkeys(labels, "asked for"))
    tried = _Tried(scene, initial)
    if asked == AUTO:
        tried.add(FIXED_POINT, fixed)
        if tried.soon():
            return fixed, _choices(fixed, tried.reasons_for_fixed_points())
    refused: dict[str, str] = {}
    for solver in (NEWTON, CHORD):
        if asked not in (AUTO, solver):
            continue
        if solver == CHORD and (fixed.outlined or is_long(fixed.body)) and tried.serves(NEWTON):
            continue
        try:
            kernel = to_kernel(program, scene, dict.fromkeys(labels, solver))
        except (NotDifferentiable, ZeroDivisionError) as error:
            refused[solver] = str(error)
            continue
        if asked == solver:
            return kernel, _choices(kernel, dict.fromkeys(labels, "asked for"))
        tried.add(solver, kernel)
    if asked in refused:
        raise MethodError(
            f"{METHODS[asked]} for {program.name}: {refused[asked]}",
            where=scene.name,
            expected="functions whose derivatives are known",
            hint=f"ask for --solver {FIXED_POINT}",
        )
    if len(tried.kernels) == 1:
        return fixed, _choices(fixed, dict.fromkeys(labels, refused[NEWTON]))
    chosen, reasons = tried.compared()
    alike = set(chosen.values())
    kernel = tried.kernels[alike.pop()] if len(alike) == 1 else to_kernel(program, scene, chosen)
    return kernel, _choices(kernel, reasons)


def _choices(kernel: Kernel, reasons: Mapping[str, str]) -> tuple[Choice, ...]:
    return tuple(
        Choice(loop.label, len(loop.unknowns), loop.solver, reasons[loop.label]) for loop in kernel.loops
    )


class _Tried:
    """Kernels of one program by solver, each with its trials in usual and in longer steps."""

    def __init__(self, scene: Problem, initial: tuple[float, ...]) -> None:
        self.scene, self.initial = scene, initial
        self.kernels: dict[str, Kernel] = {}
        self.usual: dict[str, _Trial] = {}
        self.far: dict[str, _Trial] = {}
        self.work: dict[str, dict[str, dict[str, int]]] = {}

    def add(self, solver: str, kernel: Kernel) -> None:
        """Try a kernel."""
        trials = _Trials(kernel, self.scene, self.initial)
        self.kernels[solver] = kernel
        self.usual[solver], self.far[solver] = trials.run(1), trials.run(LONGER)
        self.work[solver] = operations(arrange(kernel))

    def soon(self) -> bool:
        """Whether fixed points solve a long step's many unknowns in few sweeps, and a longer step's at all.

        A matrix of so many unknowns in one block costs more than all sweeps that a longer step may take.
        """
        usual, far = self.usual[FIXED_POINT], self.far[FIXED_POINT]
        sizes = [len(loop.unknowns) for loop in self.kernels[FIXED_POINT].loops]
        lasts = max(far.sweeps) <= SWEEPS or min(sizes) > MANY
        if sum(sizes) <= MANY or not usual.good:
            return False
        return (max(usual.sweeps) <= FEW and far.good and lasts) or self._cheapest()

    def _cheapest(self) -> bool:
        """Whether Newton's method would cost more with two sweeps and one matrix in all steps of a trial."""
        fixed, least = 0.0, 0.0
        for k, loop in enumerate(self.kernels[FIXED_POINT].loops):
            each, n = _weight(self.work[FIXED_POINT][loop.label]), len(loop.unknowns)
            fixed += self.usual[FIXED_POINT].sweeps[k] * each
            least += 2 * (each + 2 * n**2) + 2 * n**3 / STEPS
        return fixed <= least

    def reasons_for_fixed_points(self) -> dict[str, str]:
        """Return the reason for each block where nothing else was tried."""
        part = "substep" if self.kernels[FIXED_POINT].substeps else "step"
        return {
            loop.label: f"{self._sweeps(FIXED_POINT, k)} a {part}; no matrix of so many unknowns was tried; "
            f"{MEASURED}"
            for k, loop in enumerate(self.kernels[FIXED_POINT].loops)
        }

    def serves(self, solver: str) -> bool:
        """Whether a solver was tried that works on residuals in every block, and converges."""
        return (
            solver in self.kernels
            and self.usual[solver].good
            and all(loop.newton is not None and loop.newton.residuals for loop in self.kernels[solver].loops)
        )

    def compared(self) -> tuple[dict[str, str], dict[str, str]]:
        """Return the solver that serves each block best, and the reason for each block."""
        kernels, usual, far = self.kernels, self.usual, self.far
        able = [s for s in kernels if usual[s].good]
        sure = [s for s in able if far[s].good and max(far[s].sweeps) <= SWEEPS] or able
        chosen, reasons = {}, {}
        for k, loop in enumerate(kernels[FIXED_POINT].loops):
            cost, texts = {}, {}
            for solver in kernels:
                cost[solver] = usual[solver].sweeps[k] * _weight(self.work[solver][loop.label])
                texts[solver] = self._sweeps(solver, k)
                if solver != FIXED_POINT:
                    matrix = _matrix(kernels[solver].loops[k], self.work[solver])
                    matrices = usual[solver].matrices if solver == NEWTON else 1.0
                    cost[solver] += matrices * matrix
                    texts[solver] += f" and {matrices:.2f} matrices of {matrix}"
                if solver not in sure:
                    lasting = (
                        f"takes {max(far[solver].sweeps):.0f} sweeps"
                        if far[solver].good
                        else "does not converge"
                    )
                    texts[solver] = (
                        f"{lasting} with steps {LONGER} times as long"
                        if solver in able
                        else "does not converge"
                    )
            newton = kernels[NEWTON].loops[k].newton if NEWTON in kernels else None
            compared = newton is not None and newton.residuals and NEWTON in able
            best = (
                NEWTON
                if compared
                else min(sure, key=lambda s: cost[s] / RELIABLE.get(s, 1.0))
                if sure
                else NEWTON
            )
            others = [f"{METHODS[s]}: {text}" for s, text in texts.items() if s != best]
            chosen[loop.label] = best
            part = "substep" if kernels[FIXED_POINT].substeps else "step"
            reasons[loop.label] = "; ".join([f"{texts[best]} a {part}", *others, MEASURED])
        return chosen, reasons

    def _sweeps(self, solver: str, k: int) -> str:
        """Spell what the sweeps over a block cost."""
        each = _weight(self.work[solver][self.kernels[solver].loops[k].label])
        return f"{self.usual[solver].sweeps[k]:.1f} sweeps of {each} operations"


def _matrix(loop: Loop, work: Mapping[str, Mapping[str, int]]) -> int:
    """Return what a matrix costs with its inversion."""
    assert loop.newton is not None
    inversion = 0 if loop.newton.inverted else 2 * len(loop.unknowns) ** 3
    return _weight(work[matrix_of(loop.label)]) + inversion


def _weight(counts: Mapping[str, int]) -> int:
    return sum(n * WEIGHTS.get(name, CALL) for name, n in counts.items())


class _Trials:
    """A kernel carried out from the initial state, with the sweeps and matrices that emitted code makes.

    A step that does not converge is tried again without the solutions before it, and no more: one that needs
    continuation is too long for its solver.
    """

    def __init__(self, kernel: Kernel, scene: Problem, initial: tuple[float, ...]) -> None:
        self.plan = Plan(replace(kernel, estimate=None, vary=None), DOUBLE, tries=1)
        self.machine = Machine(unit_of(self.plan), EmittedFloats(chain=chain(kernel)))
        self.initial, self.span, self.repeated = initial, scene.span, max(1, len(kernel.substeps))
        self.values = [float(scene.parameters[p.text]) for p in self.plan.parameters]

    def run(self, longer: int) -> _Trial:
        """Make steps, ``longer`` times as long as usual: several where they are not."""
        first, last = self.span
        number, blocks = len(self.plan.kernel.inputs), len(self.plan.kernel.loops)
        counts, state = self.machine.record(STATISTICS), list(self.initial)
        time = [float(first)] if self.plan.time else []
        signals = [lambda t: (0.0,) * number] if number else []
        steps, h = STEPS if longer == 1 else 1, float(longer * (last - first) / PARTS)
        arguments = [state, *time, h, steps, *self.values, *signals, None, 0, counts, None]
        status = self.machine.call("run", *arguments)
        parts = steps * self.repeated
        matrices = counts.matrices / parts / blocks if self.plan.newton else 0.0
        return _Trial(tuple(n / parts for n in counts.sweeps), matrices, status == STATUSES.index(OK))
