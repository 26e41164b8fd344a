"""What the functions around one kernel have in common: arguments, and what of a run the kernel needs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.expr import walk
from codegen.ir.kernel import ELAPSED, LEAD, NEWTON, Kernel, Start
from codegen.kernel.schedule import Arrangement, arrange
from codegen.run.precision import Precision
from codegen.run.terms import Term, count, own, real, record, signal

TIME, STEP = own("t"), own("h")
"""The time at the beginning of a step, and its size."""

MEMORY, STATISTICS = "memory", "statistics"
"""The names of records, and of the arguments that are such."""

INPUTS = signal("inputs")
"""The function of time that gives the run-time inputs."""

STEPS, STRIDE = count("steps"), count("stride")


@dataclass(frozen=True)
class Plan:
    """A kernel in a format.

    A step whose equations do not converge is tried ``tries`` times, by default ``Start.TRIES``.
    """

    kernel: Kernel
    format: Precision
    tries: int | None = None

    @cached_property
    def arrangement(self) -> Arrangement:
        """The statements of the kernel."""
        return arrange(self.kernel)

    @property
    def symbols(self) -> tuple[str, ...]:
        """The names of the state's numbers."""
        return tuple(s for f in self.kernel.state for s in f.symbols)

    @property
    def size(self) -> int:
        """How many numbers a state has."""
        return len(self.symbols)

    @cached_property
    def _used(self) -> tuple[str, ...]:
        return self.kernel.used_scalars()

    @property
    def time(self) -> bool:
        """Whether a step reads the time."""
        return TIME.text in self._used

    @property
    def parameters(self) -> tuple[Term, ...]:
        """The run-time parameters."""
        return tuple(map(own, (s for s in self._used if s not in ("t", "h", LEAD, ELAPSED))))

    @property
    def counting(self) -> bool:
        """Whether there are implicit blocks, whose sweeps are counted."""
        return bool(self.kernel.loops)

    @property
    def newton(self) -> bool:
        """Whether matrices of Newton's method are kept from step to step."""
        return any(loop.solver == NEWTON for loop in self.kernel.loops)

    @property
    def start(self) -> Start | None:
        """Where the loops begin, if solutions of earlier steps say so."""
        return self.kernel.start

    @property
    def remembers(self) -> bool:
        """Whether a step leaves something for the next."""
        return self.start is not None or self.newton

    @property
    def parts(self) -> int:
        """How many substeps a step has, 0 where it is one."""
        return len(self.kernel.substeps)

    @property
    def memory(self) -> Term:
        """What one step, or substep, leaves for the next."""
        return record(MEMORY, MEMORY)

    @property
    def memories(self) -> Term:
        """That of all parts of a step."""
        return record(MEMORY, MEMORY, self.parts) if self.parts else self.memory

    @property
    def statistics(self) -> Term:
        """What a caller wants counted, or nothing."""
        return record(STATISTICS, STATISTICS, optional=True)

    @property
    def error(self) -> Term:
        """The array that receives the estimate of the error of a step, if it is there."""
        return real("error", self.size, optional=True)

    def state(self, name: str = "state") -> Term:
        """Return a state."""
        return real(name, self.size)

    def remembering(self, memory: Term) -> tuple[Term, ...]:
        """Return the argument for what steps remember, none where they do not."""
        return (memory,) if self.remembers else ()

    @property
    def counted(self) -> tuple[Term, ...]:
        """The argument for statistics, none where nothing is counted."""
        return (self.statistics,) if self.counting else ()

    def moment(self, t: Term = TIME, h: Term = STEP) -> tuple[Term, ...]:
        """Return the arguments for the time, where it is read, and the step size."""
        return (t, h) if self.time else (h,)

    def sampled(self, inputs: Term = INPUTS) -> tuple[Term, ...]:
        """Return the argument for run-time inputs, none where there are none."""
        return (inputs,) if self.kernel.inputs else ()

    @property
    def held(self) -> tuple[Term, ...]:
        """The argument for inputs that stay the same over a step."""
        return (real("held", len(self.kernel.inputs)),) if self.kernel.inputs else ()

    def read(self, scalars: Iterable[str]) -> tuple[Term, ...]:
        """Return those of some scalars that the kernel's statements read."""
        symbols = self.arrangement.symbols()
        return tuple(own(s) for s in scalars if s in symbols)


def symbols_of(kernel: Kernel) -> frozenset[str]:
    """Return every symbol that an expression of a kernel reads."""
    return frozenset(n.payload for n in walk(kernel.expressions()) if n.op == "sym")
