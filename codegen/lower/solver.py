"""How each block of equations is solved: by fixed point or by Newton's method, whichever does less work.

Both are tried: the step is printed as Python and makes a few steps from the initial state, of the length that
the usage example takes. Sweeps and matrices are counted and weighed by their operations. A fixed point must
also settle with steps :data:`LONGER` times as long, if Newton's method does: where it is near its limit, a
user's next step size is beyond it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

from codegen.errors import MethodError
from codegen.ir.differentiate import NotDifferentiable
from codegen.ir.kernel import FIXED_POINT, NEWTON, Kernel
from codegen.ir.program import Program
from codegen.lower.kernel import to_kernel
from codegen.printers.arrange import arrange
from codegen.printers.interface import Interface
from codegen.printers.operations import matrix_of, operations
from codegen.printers.python.module import print_module
from codegen.printers.recipe import Recipe
from codegen.scene import Setting
from orderconds.errors import UnknownName

AUTO = "auto"
CHOICES = (AUTO, NEWTON, FIXED_POINT)
"""What a caller may ask for."""

STEPS, LONGER, PARTS = 8, 8, 100
"""Steps of a trial; how much longer steps of the second trial are; how many steps make the scene's span."""

WEIGHTS = {"add": 1, "mul": 1, "div": 4}
"""What operations cost; calls cost :data:`CALL`."""
CALL = 15


@dataclass(frozen=True)
class Choice:
    """How one block is solved, and why."""

    label: str
    unknowns: int
    solver: str
    reason: str

    def text(self) -> str:
        """Say it in words."""
        how = {NEWTON: "Newton's method", FIXED_POINT: "fixed point"}[self.solver]
        return f"{self.label}: {how}, {self.unknowns} unknowns ({self.reason})"


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
    program: Program, scene: Setting, initial: tuple[float, ...], asked: str = AUTO
) -> tuple[Kernel, tuple[Choice, ...]]:
    """Return the kernel of a program with every block solved as ``asked``, and what was chosen.

    ``initial`` is the state that trials start from; signals that are taken at run time are zero in them.
    ``asked`` is one of :data:`CHOICES`; UnknownName for another, MethodError for Newton's method where a
    function of the scene or group has no derivative here.
    """
    known_solver(asked)
    iterated = to_kernel(program, scene)
    labels = [loop.label for loop in iterated.loops]
    if not labels:
        return iterated, ()
    if asked == FIXED_POINT:
        return iterated, _choices(iterated, dict.fromkeys(labels, "asked for"))
    try:
        corrected = to_kernel(program, scene, labels)
    except NotDifferentiable as error:
        if asked == NEWTON:
            raise MethodError(
                f"Newton's method for {program.name}: {error}",
                where=scene.name,
                expected="functions whose derivatives are known",
                hint=f"ask for --solver {FIXED_POINT}",
            ) from None
        return iterated, _choices(iterated, dict.fromkeys(labels, str(error)))
    if asked == NEWTON:
        return corrected, _choices(corrected, dict.fromkeys(labels, "asked for"))
    chosen, reasons = _compared(iterated, corrected, scene, initial)
    mixed = 0 < len(chosen) < len(labels)
    kernel = to_kernel(program, scene, chosen) if mixed else corrected if chosen else iterated
    return kernel, _choices(kernel, reasons)


def _choices(kernel: Kernel, reasons: Mapping[str, str]) -> tuple[Choice, ...]:
    return tuple(
        Choice(loop.label, len(loop.unknowns), loop.solver, reasons[loop.label]) for loop in kernel.loops
    )


def _compared(
    iterated: Kernel, corrected: Kernel, scene: Setting, initial: tuple[float, ...]
) -> tuple[Collection[str], dict[str, str]]:
    """Return the blocks that Newton's method serves better, and the reason for each block."""
    kernels = (iterated, corrected)
    usual = [_trial(kernel, scene, initial, 1) for kernel in kernels]
    far = [_trial(kernel, scene, initial, LONGER).good for kernel in kernels]
    work = [operations(arrange(kernel)) for kernel in kernels]
    chosen, reasons = [], {}
    for k, loop in enumerate(corrected.loops):
        label = loop.label
        sweeps = [trial.sweeps[k] for trial in usual]
        each = [_weight(counts[label]) for counts in work]
        matrix = _weight(work[1][matrix_of(label)]) + 2 * len(loop.unknowns) ** 3
        costs = [sweeps[0] * each[0], sweeps[1] * each[1] + usual[1].matrices * matrix]
        if not usual[0].good:
            reasons[label], newton = "a fixed point does not settle", True
        elif not usual[1].good:
            reasons[label], newton = "Newton's method does not settle", False
        elif far[1] and not far[0]:
            reasons[label], newton = f"a fixed point does not settle with steps {LONGER} times as long", True
        else:
            newton = costs[1] < costs[0]
            spelled = [f"{sweeps[i]:.1f} sweeps of {each[i]:.0f} operations" for i in range(2)]
            spelled[1] += f" and {usual[1].matrices:.2f} matrices of {matrix:.0f}"
            here, there = (spelled[1], spelled[0]) if newton else spelled
            reasons[label] = f"{here} a step, not {there}"
        if newton:
            chosen.append(label)
    return chosen, reasons


def _weight(counts: Mapping[str, int]) -> int:
    return sum(n * WEIGHTS.get(name, CALL) for name, n in counts.items())


def _trial(kernel: Kernel, scene: Setting, initial: tuple[float, ...], longer: int) -> _Trial:
    """Make steps from the initial state with the kernel printed as Python, without an error estimate."""
    kernel = replace(kernel, estimate=None)
    interface = Interface.of(kernel, "trial_")
    defaults = {name: float(scene.parameters[name]) for name in scene.runtime}
    text = print_module(kernel, interface, Recipe("trial", (), initial, defaults=defaults))["trial.py"]
    module: dict[str, Any] = {"__name__": "trial"}
    exec(compile(text, "trial.py", "exec"), module)
    first, last = scene.span
    counts, good = module["Statistics"](), True
    time = [float(first)] if interface.time else []
    signals = [lambda t: (0.0,) * len(interface.inputs)] if interface.inputs else []
    steps, h = STEPS if longer == 1 else 1, float(longer * (last - first) / PARTS)
    try:
        module["run"](initial, *time, h, steps, *signals, statistics=counts)
    except module["StepFailed"]:
        good = False
    matrices = counts.matrices / steps / len(interface.blocks) if interface.newton else 0.0
    return _Trial(tuple(n / steps for n in counts.sweeps), matrices, good)
