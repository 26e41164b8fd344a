"""Common data of the emitted functions of a kernel, for example their arguments."""

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
"""The names of two record types in the emitted code.

An argument of the type ``memory`` has the name ``memory``. An argument of the type ``statistics`` has the
name ``statistics``.
"""

INPUTS = signal("inputs")
"""The function of time that returns the run-time inputs."""

STEPS, STRIDE = count("steps"), count("stride")


@dataclass(frozen=True)
class Plan:
    """A kernel (the arithmetic of a step) and the floating-point format of the emitted module.

    After a failed step, the continuation method (:mod:`codegen.run.continuation`) makes at most ``tries``
    attempts. If ``tries`` is None, the limit is ``Start.TRIES``.
    """

    kernel: Kernel
    format: Precision
    # If solvers are compared, ``tries`` is 1, because more attempts could hide the failure of a solver.
    tries: int | None = None

    @cached_property
    def arrangement(self) -> Arrangement:
        """The statements of the kernel in the order of the emitted code."""
        # The result is cached, because many functions read it, and scheduling a large kernel takes time.
        return arrange(self.kernel)

    @property
    def symbols(self) -> tuple[str, ...]:
        """The symbols of the components of the state, in the order of the state array."""
        return tuple(s for f in self.kernel.state for s in f.symbols)

    @property
    def size(self) -> int:
        """The number of components of a state."""
        return len(self.symbols)

    @cached_property
    def _used(self) -> tuple[str, ...]:
        # ``used_scalars`` visits the whole kernel, so the result is cached.
        return self.kernel.used_scalars()

    @property
    def time(self) -> bool:
        """True if a step reads the time."""
        return TIME.text in self._used

    @property
    def parameters(self) -> tuple[Term, ...]:
        """The run-time parameters that the kernel reads."""
        # Times and durations are omitted, because they are separate arguments of the functions.
        return tuple(map(own, (s for s in self._used if s not in ("t", "h", LEAD, ELAPSED))))

    @property
    def counting(self) -> bool:
        """True if the kernel solves equations iteratively. The statistics then count the iterations."""
        return bool(self.kernel.loops)

    @property
    def newton(self) -> bool:
        """True if a loop of the kernel uses Newton's method (not simplified Newton)."""
        # Only Newton's method stores its matrix for the next step.
        return any(loop.solver == NEWTON for loop in self.kernel.loops)

    @property
    def start(self) -> Start | None:
        """The part of the kernel that computes initial guesses for the loops, or None (no warm start)."""
        return self.kernel.start

    @property
    def remembers(self) -> bool:
        """True if a step stores solutions of equations, or matrices of Newton's method, for the next step."""
        # If the result is False, the emitted functions have no argument ``memory``.
        return self.start is not None or self.newton

    @property
    def parts(self) -> int:
        """The number of substeps of a step (0 without substeps)."""
        return len(self.kernel.substeps)

    @property
    def memory(self) -> Term:
        """The record with the data that a step or substep stores for the next step."""
        return record(MEMORY, MEMORY)

    @property
    def memories(self) -> Term:
        """The memory of a step: one record, or an array with one record for each substep."""
        # Substeps have different lengths, so the solutions of one substep are bad initial guesses for the
        # next substep.
        return record(MEMORY, MEMORY, self.parts) if self.parts else self.memory

    @property
    def statistics(self) -> Term:
        """The optional argument ``statistics``: a record for the statistics of a run."""
        return record(STATISTICS, STATISTICS, optional=True)

    @property
    def error(self) -> Term:
        """The optional array that receives the error estimate of a step."""
        return real("error", self.size, optional=True)

    def state(self, name: str = "state") -> Term:
        """Return an array called ``name`` that has the size of a state."""
        return real(name, self.size)

    def remembering(self, memory: Term) -> tuple[Term, ...]:
        """Return ``(memory,)`` if steps store numbers for the next step, and ``()`` otherwise."""
        return (memory,) if self.remembers else ()

    @property
    def counted(self) -> tuple[Term, ...]:
        """``(statistics,)`` if ``counting`` is True, otherwise ``()``: arguments of emitted functions."""
        return (self.statistics,) if self.counting else ()

    def moment(self, t: Term = TIME, h: Term = STEP) -> tuple[Term, ...]:
        """Return the arguments ``t`` (time) and ``h`` (step size) of a step.

        If the step does not depend on time, ``t`` is omitted.
        """
        # If a step had an unused parameter for the time, C compilers would give a warning, and the caller of
        # the step would compute the time in vain.
        return (t, h) if self.time else (h,)

    def sampled(self, inputs: Term = INPUTS) -> tuple[Term, ...]:
        """Return ``(inputs,)`` if the kernel has run-time inputs, and ``()`` otherwise.

        The step samples (evaluates) the function ``inputs`` at one or more times.
        """
        return (inputs,) if self.kernel.inputs else ()

    @property
    def held(self) -> tuple[Term, ...]:
        """A tuple with the array of inputs (constant during a step). Without inputs, the tuple is empty."""
        return (real("held", len(self.kernel.inputs)),) if self.kernel.inputs else ()

    def read(self, scalars: Iterable[str]) -> tuple[Term, ...]:
        """Return a term for each name in ``scalars`` that occurs in the kernel's statements."""
        # Scheduling may remove statements. Names that occur only in removed statements are omitted.
        symbols = self.arrangement.symbols()
        return tuple(own(s) for s in scalars if s in symbols)


def symbols_of(kernel: Kernel) -> frozenset[str]:
    """Return the symbols that the expressions of a kernel read."""
    return frozenset(n.payload for n in walk(kernel.expressions()) if n.op == "sym")
