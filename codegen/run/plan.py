"""Data that all functions of a kernel share: common arguments, and the features that the kernel needs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from codegen.ir.expr import walk
from codegen.ir.kernel import ELAPSED, LEAD, NEWTON, Kernel, Start
from codegen.ir.precision import Precision
from codegen.kernel.schedule import Arrangement, arrange
from codegen.run.terms import Term, count, own, real, record, signal

TIME, STEP = own("t"), own("h")
"""The time at the beginning of a step, and the size of the step."""

MEMORY, STATISTICS = "memory", "statistics"
"""The names of two record types. An argument of such a type has the name of its type."""

INPUTS = signal("inputs")
"""The function of time that returns the run-time inputs."""

STEPS, STRIDE = count("steps"), count("stride")


@dataclass(frozen=True)
class Plan:
    """A kernel and the floating-point format of its module.

    The continuation in the step size repeats a step that does not converge. ``tries`` is the largest number
    of attempts. None means ``Start.TRIES``.
    """

    kernel: Kernel
    format: Precision
    # Trials of solvers have ``tries`` = 1, because more attempts of the continuation could hide that a solver
    # fails.
    tries: int | None = None

    @cached_property
    def arrangement(self) -> Arrangement:
        """The statements of the kernel."""
        # The statements are cached, because many functions read them, and scheduling rewrites all
        # expressions.
        return arrange(self.kernel)

    @property
    def symbols(self) -> tuple[str, ...]:
        """The symbols of the components of the state, in order."""
        return tuple(s for f in self.kernel.state for s in f.symbols)

    @property
    def size(self) -> int:
        """The number of components of a state."""
        return len(self.symbols)

    @cached_property
    def _used(self) -> tuple[str, ...]:
        # The result is cached, because nearly every property below reads it, and computing it walks through
        # the whole kernel.
        return self.kernel.used_scalars()

    @property
    def time(self) -> bool:
        """True if a step reads the time."""
        return TIME.text in self._used

    @property
    def parameters(self) -> tuple[Term, ...]:
        """The run-time parameters that the kernel reads."""
        # The times and durations of a step have arguments of their own, so they are not listed here.
        return tuple(map(own, (s for s in self._used if s not in ("t", "h", LEAD, ELAPSED))))

    @property
    def counting(self) -> bool:
        """True if the kernel has implicit blocks. Then the statistics count the sweeps of these blocks."""
        return bool(self.kernel.loops)

    @property
    def newton(self) -> bool:
        """True if matrices of Newton's method are stored from step to step."""
        # Simplified Newton computes its matrix in each step and stores nothing.
        return any(loop.solver == NEWTON for loop in self.kernel.loops)

    @property
    def start(self) -> Start | None:
        """The warm start, which gives the loops their initial guesses; None if there is no warm start."""
        return self.kernel.start

    @property
    def remembers(self) -> bool:
        """True if a step stores solutions of equations, or matrices of Newton's method, for the next step."""
        # Kernels without implicit equations store nothing, so their steps have no argument for a memory.
        return self.start is not None or self.newton

    @property
    def parts(self) -> int:
        """The number of substeps of a step; 0 if there are none."""
        return len(self.kernel.substeps)

    @property
    def memory(self) -> Term:
        """The memory: the data that one step or substep stores for the next one."""
        return record(MEMORY, MEMORY)

    @property
    def memories(self) -> Term:
        """The memory of a step. If there are substeps, it is an array with one memory for each substep."""
        # Substeps differ in length. The solutions of one substep cannot be extrapolated to the next substep,
        # so each substep has its own memory.
        return record(MEMORY, MEMORY, self.parts) if self.parts else self.memory

    @property
    def statistics(self) -> Term:
        """The argument for the record of statistics, which the caller may omit."""
        return record(STATISTICS, STATISTICS, optional=True)

    @property
    def error(self) -> Term:
        """The optional array that receives the error estimate of a step."""
        return real("error", self.size, optional=True)

    def state(self, name: str = "state") -> Term:
        """Return the array ``name`` with the numbers of a state."""
        return real(name, self.size)

    def remembering(self, memory: Term) -> tuple[Term, ...]:
        """Return a tuple with the argument ``memory``. The tuple is empty if steps store nothing."""
        return (memory,) if self.remembers else ()

    @property
    def counted(self) -> tuple[Term, ...]:
        """A tuple with the argument for statistics. It is empty if nothing is counted."""
        return (self.statistics,) if self.counting else ()

    def moment(self, t: Term = TIME, h: Term = STEP) -> tuple[Term, ...]:
        """Return the arguments for the time and the step size.

        The time is omitted if the step does not depend on time.
        """
        # C compilers would warn about an unused argument. Each step would also compute an unused time.
        return (t, h) if self.time else (h,)

    def sampled(self, inputs: Term = INPUTS) -> tuple[Term, ...]:
        """Return a tuple with the argument for run-time inputs. It is empty if the kernel has no inputs."""
        return (inputs,) if self.kernel.inputs else ()

    @property
    def held(self) -> tuple[Term, ...]:
        """The argument for inputs that are constant over a step."""
        return (real("held", len(self.kernel.inputs)),) if self.kernel.inputs else ()

    def read(self, scalars: Iterable[str]) -> tuple[Term, ...]:
        """Return the terms for those names in ``scalars`` that the statements of the kernel read."""
        # Only the scheduled statements are searched, because scheduling may remove a statement that reads a
        # scalar.
        symbols = self.arrangement.symbols()
        return tuple(own(s) for s in scalars if s in symbols)


def symbols_of(kernel: Kernel) -> frozenset[str]:
    """Return every symbol that an expression of a kernel reads."""
    return frozenset(n.payload for n in walk(kernel.expressions()) if n.op == "sym")
