"""Emitted modules as Python objects: compiled C through cffi (ABI mode), or emitted Python, with one face."""

from __future__ import annotations

import math
import operator
import types
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from pathlib import Path
from typing import Any

from codegen.build import build
from codegen.emission import Emission, read
from codegen.printers.c.module import prototypes
from codegen.printers.interface import Interface

State = Any
"""A sequence of floats; a numpy array is answered by a numpy array, anything else by a list."""

Signals = Callable[[float], Sequence[float]]
"""A function from the time to the run-time inputs."""


class Status(IntEnum):
    """Why a step was not made; the numbers are those of emitted code."""

    OK = 0
    NOT_CONVERGED = 1
    NOT_FINITE = 2
    BAD_STEP = 3
    LIMIT = 4


class StepFailed(ArithmeticError):
    """A step that could not be made: its status, how many steps were made before it, the last good state."""

    def __init__(self, status: Status, step: int, state: State, reason: str) -> None:
        super().__init__(f"step {step + 1}: {reason}")
        self.status, self.step, self.state, self.reason = status, step, state, reason


@dataclass(frozen=True)
class Arrival:
    """Where a run that chose its steps ended: the size to go on with, steps made and steps refused."""

    state: State
    t: float
    h: float
    accepted: int
    rejected: int


@dataclass
class Statistics:
    """Sweeps by block, the most one block took in one step, and 1 + the block that failed.

    ``matrices`` is how often a matrix of Newton's method was made.
    """

    sweeps: list[int] = field(default_factory=list)
    most: int = 0
    failed: int = 0
    matrices: int = 0


class Integrator(ABC):
    """A loaded step: ``interface`` tells its arguments, ``defaults`` the scene's parameter values."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float]) -> None:
        self.interface, self.defaults = interface, dict(defaults)

    def step(
        self,
        state: State,
        h: float,
        t: float = 0.0,
        statistics: Statistics | None = None,
        inputs: Sequence[float] | None = None,
        **parameters: float,
    ) -> State:
        """Return the state after one step of size h; a StepFailed if it cannot be made.

        ``inputs`` are the run-time inputs, in the interface's order, held over the step.
        """
        held = None if inputs is None else tuple(inputs)
        function = None if held is None else lambda t: held
        return self.run(state, h, 1, t, statistics, function, **parameters)

    def run(
        self,
        state: State,
        h: float,
        steps: int,
        t: float = 0.0,
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        **parameters: float,
    ) -> State:
        """Return the state after that many steps of size h from time t; a StepFailed if one fails.

        ``inputs`` is a function from the time to the run-time inputs, in the interface's order.
        """
        steps = self._checked_count(steps)
        self._known(inputs)
        numbers, values = self._numbers(state), self._values(parameters)
        final, _ = self._call(numbers, t, h, steps, values, 0, statistics, state, inputs)
        return like(state, final)

    def trajectory(
        self,
        state: State,
        h: float,
        steps: int,
        stride: int = 1,
        t: float = 0.0,
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        **parameters: float,
    ) -> State:
        """Return rows: the initial state and every stride-th state after it."""
        if stride < 1:
            raise ValueError(f"expected a stride of at least 1, found {stride}")
        values = self._values(parameters)
        steps = self._checked_count(steps)
        self._known(inputs)
        _, rows = self._call(self._numbers(state), t, h, steps, values, stride, statistics, state, inputs)
        return like(state, rows)

    def adaptive(
        self,
        state: State,
        t: float,
        end: float,
        h: float = 0.0,
        *,
        rtol: float = 1e-6,
        atol: float = 1e-9,
        limit: int = 100_000,
        statistics: Statistics | None = None,
        inputs: Signals | None = None,
        **parameters: float,
    ) -> Arrival:
        """Return where steps from t to end lead, as large as the tolerances allow; ``h`` is the first.

        TypeError for a module without an estimate of the error (``emit --adaptive``), StepFailed as
        :meth:`run`, and with the status ``LIMIT`` where the end is not reached.
        """
        if not self.interface.adaptive:
            raise TypeError("this module has no run that chooses its steps; emit it with --adaptive")
        self._known(inputs)
        span, tolerances = (float(t), float(end), float(h)), (float(rtol), float(atol))
        numbers, values = self._numbers(state), self._values(parameters)
        found = self._adapt(
            numbers, span, tolerances, operator.index(limit), values, statistics, inputs, state
        )
        return replace(found, state=like(state, found.state))

    def jacobian(
        self,
        state: State,
        h: float,
        t: float = 0.0,
        inputs: Sequence[float] | None = None,
        **parameters: float,
    ) -> State:
        """Return the derivative of one step, rows of the variations that the module's head names.

        TypeError for a module without it (``emit --jacobian``); StepFailed as :meth:`step`.
        """
        if not self.interface.variations:
            raise TypeError("this module has no derivative of its step; emit it with --jacobian")
        if bool(self.interface.inputs) != (inputs is not None):
            raise TypeError(f"expected values for {', '.join(self.interface.inputs) or 'no inputs'}")
        held = None if inputs is None else [float(x) for x in inputs]
        rows = self._derive(self._numbers(state), t, h, self._values(parameters), held, state)
        return like(state, rows)

    def _checked_count(self, steps: int) -> int:
        count = operator.index(steps)
        if count < 0:
            raise ValueError(f"expected no negative number of steps, found {steps}")
        return count

    def _known(self, inputs: Signals | None) -> None:
        names = self.interface.inputs
        if bool(names) != (inputs is not None):
            raise TypeError(f"expected {'a function for ' + ', '.join(names) if names else 'no inputs'}")

    def _numbers(self, state: State) -> list[float]:
        numbers = [float(x) for x in state]
        if len(numbers) != self.interface.size:
            raise ValueError(f"expected {self.interface.size} numbers in state, found {len(numbers)}")
        return numbers

    def _values(self, parameters: Mapping[str, float]) -> list[float]:
        known = self.interface.parameters
        for name in parameters:
            if name not in known:
                raise TypeError(f"unknown parameter {name}; this step reads {', '.join(known) or 'none'}")
        values = {**self.defaults, **parameters}
        for name in known:
            if name not in values:
                raise TypeError(f"the parameter {name} has no value")
        return [float(values[name]) for name in known]

    def _count(self, counts: Any, statistics: Statistics | None) -> None:
        """Add what emitted code counted."""
        if counts is not None and statistics is not None:
            before = statistics.sweeps or [0] * len(self.interface.blocks)
            statistics.sweeps = [a + b for a, b in zip(before, counts.sweeps, strict=True)]
            statistics.most = max(statistics.most, counts.most)
            statistics.failed = counts.failed
            statistics.matrices += counts.matrices if self.interface.newton else 0

    @abstractmethod
    def _call(
        self,
        numbers: list[float],
        t: float,
        h: float,
        steps: int,
        values: list[float],
        stride: int,
        statistics: Statistics | None,
        like_state: State,
        inputs: Signals | None,
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        """Run and return the final state and the rows."""

    @abstractmethod
    def _derive(
        self,
        numbers: list[float],
        t: float,
        h: float,
        values: list[float],
        inputs: list[float] | None,
        like_state: State,
    ) -> list[list[float]]:
        """Return the rows of the Jacobian."""

    @abstractmethod
    def _adapt(
        self,
        numbers: list[float],
        span: tuple[float, float, float],
        tolerances: tuple[float, float],
        limit: int,
        values: list[float],
        statistics: Statistics | None,
        inputs: Signals | None,
        like_state: State,
    ) -> Arrival:
        """Run with chosen steps; ``span`` is (t, end, h)."""


class CompiledIntegrator(Integrator):
    """A step in a shared object; calls let go of the interpreter lock."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], path: Path) -> None:
        from cffi import FFI

        super().__init__(interface, defaults)
        self._ffi = FFI()
        self._ffi.cdef(prototypes(interface))
        self._library = self._ffi.dlopen(str(path))
        self._run = getattr(self._library, f"{interface.prefix}run")

    def _call(
        self,
        numbers: list[float],
        t: float,
        h: float,
        steps: int,
        values: list[float],
        stride: int,
        statistics: Statistics | None,
        like_state: State,
        inputs: Signals | None,
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        size, blocks = self.interface.size, self.interface.blocks
        real = self.interface.format.c_type
        state = self._ffi.new(f"{real}[]", numbers)
        row_count = steps // stride + 1 if stride else 0
        rows = self._ffi.new(f"{real}[]", row_count * size) if stride else self._ffi.NULL
        completed = self._ffi.new("size_t *")
        counts = self._ffi.new(f"{self.interface.prefix}statistics *") if blocks else None
        callback = None if inputs is None else _Callback(self._ffi, self.interface, inputs)
        sampled = [] if callback is None else [callback.pointer, self._ffi.NULL]
        arguments = [state, *([t] if self.interface.time else []), h, steps, *values, *sampled, rows, stride]
        status = Status(self._run(*arguments, *([counts] if blocks else []), completed))
        if callback is not None and callback.failure is not None:
            raise callback.failure
        self._count(counts, statistics)
        final = self._ffi.unpack(state, size)
        if status != Status.OK:
            block = blocks[counts.failed - 1] if counts is not None and counts.failed else ""
            raise StepFailed(status, completed[0], like(like_state, final), reason(status, block, h))
        flat = self._ffi.unpack(rows, row_count * size) if stride else []
        return final, [flat[i : i + size] for i in range(0, len(flat), size)]

    def _adapt(
        self,
        numbers: list[float],
        span: tuple[float, float, float],
        tolerances: tuple[float, float],
        limit: int,
        values: list[float],
        statistics: Statistics | None,
        inputs: Signals | None,
        like_state: State,
    ) -> Arrival:
        real, prefix, new = self.interface.format.c_type, self.interface.prefix, self._ffi.new
        state, t, h = new(f"{real}[]", numbers), new(f"{real} *", span[0]), new(f"{real} *", span[2])
        accepted, rejected = new("size_t *"), new("size_t *")
        counts = new(f"{prefix}statistics *") if self.interface.blocks else None
        callback = None if inputs is None else _Callback(self._ffi, self.interface, inputs)
        sampled = [] if callback is None else [callback.pointer, self._ffi.NULL]
        run = getattr(self._library, f"{prefix}run_adaptive")
        counted = [] if counts is None else [counts]
        found = run(
            *(state, t, span[1], h, *tolerances, limit, *values, *sampled, *counted, accepted, rejected)
        )
        if callback is not None and callback.failure is not None:
            raise callback.failure
        self._count(counts, statistics)
        final, status = self._ffi.unpack(state, self.interface.size), Status(found)
        if status != Status.OK:
            block = self.interface.blocks[counts.failed - 1] if counts is not None and counts.failed else ""
            raise StepFailed(status, accepted[0], like(like_state, final), reason(status, block, span[2]))
        return Arrival(final, t[0], h[0], accepted[0], rejected[0])

    def _derive(
        self,
        numbers: list[float],
        t: float,
        h: float,
        values: list[float],
        inputs: list[float] | None,
        like_state: State,
    ) -> list[list[float]]:
        real, size = self.interface.format.c_type, self.interface.variations
        found = self._ffi.new(f"{real}[]", size * size)
        time, held = [t] if self.interface.time else [], [] if inputs is None else [inputs]
        derive = getattr(self._library, f"{self.interface.prefix}jacobian")
        status = Status(derive(numbers, *time, h, *values, *held, found))
        if status != Status.OK:
            raise StepFailed(status, 0, like(like_state, numbers), reason(status, "an implicit block", h))
        flat = self._ffi.unpack(found, size * size)
        return [flat[i : i + size] for i in range(0, size * size, size)]


class _Callback:
    """A function of time that C may call; what it raises is kept, and the step that asked for it fails."""

    def __init__(self, ffi: Any, interface: Interface, function: Signals) -> None:
        self.function, self.count = function, len(interface.inputs)
        self.failure: BaseException | None = None
        real = interface.format.c_type
        self.pointer = ffi.callback(f"void({real}, {real} *, void *)", self._write)

    def _write(self, t: float, values: Any, context: Any) -> None:
        found = [math.nan] * self.count
        try:
            if self.failure is None:
                found = [float(x) for x in self.function(t)]
            if len(found) != self.count:
                raise TypeError(f"expected {self.count} inputs, found {len(found)}")
        except BaseException as error:  # nothing may be raised through C
            self.failure, found = error, [math.nan] * self.count
        for k, x in enumerate(found):
            values[k] = x


class InterpretedIntegrator(Integrator):
    """A step in an emitted Python module."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], source: str) -> None:
        super().__init__(interface, defaults)
        self.module = types.ModuleType(interface.module)
        exec(compile(source, f"{interface.module}.py", "exec"), self.module.__dict__)

    def _call(
        self,
        numbers: list[float],
        t: float,
        h: float,
        steps: int,
        values: list[float],
        stride: int,
        statistics: Statistics | None,
        like_state: State,
        inputs: Signals | None,
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        keywords: dict[str, Any] = {}
        counts = self.module.Statistics() if self.interface.blocks else None
        if counts is not None:
            keywords["statistics"] = counts
        try:
            found = self.module.run(
                *(numbers, *([t] if self.interface.time else []), h, steps),
                *([] if inputs is None else [inputs]),
                *values,
                stride=stride,
                **keywords,
            )
        except self.module.StepFailed as failure:
            status = Status(failure.status)
            raise StepFailed(status, failure.step, like(like_state, failure.state), failure.reason) from None
        finally:
            self._count(counts, statistics)
        return (found[-1], found) if stride else (found, [])

    def _adapt(
        self,
        numbers: list[float],
        span: tuple[float, float, float],
        tolerances: tuple[float, float],
        limit: int,
        values: list[float],
        statistics: Statistics | None,
        inputs: Signals | None,
        like_state: State,
    ) -> Arrival:
        t, end, h = span
        sampled = [] if inputs is None else [inputs]
        keywords: dict[str, Any] = dict(zip(("rtol", "atol"), tolerances, strict=True)) | {"limit": limit}
        keywords |= dict(zip(self.interface.parameters, values, strict=True))
        counts = self.module.Statistics() if self.interface.blocks else None
        if counts is not None:
            keywords["statistics"] = counts
        try:
            return Arrival(*self.module.run_adaptive(numbers, t, end, *sampled, h, **keywords))
        except self.module.StepFailed as failure:
            state = like(like_state, failure.state)
            raise StepFailed(Status(failure.status), failure.step, state, failure.reason) from None
        finally:
            self._count(counts, statistics)

    def _derive(
        self,
        numbers: list[float],
        t: float,
        h: float,
        values: list[float],
        inputs: list[float] | None,
        like_state: State,
    ) -> list[list[float]]:
        time, held = [t] if self.interface.time else [], [] if inputs is None else [inputs]
        try:
            return list(self.module.jacobian(numbers, *time, h, *held, *values))
        except self.module.StepFailed as failure:
            state = like(like_state, numbers)
            raise StepFailed(Status(failure.status), 0, state, failure.reason) from None


def reason(status: Status, block: str, h: float) -> str:
    """Say in words why a step failed."""
    match status:
        case Status.BAD_STEP:
            return f"the step size h = {h} is not finite"
        case Status.LIMIT:
            return "the end is not reached within the tolerance"
        case Status.NOT_CONVERGED:
            return f"{block} did not converge"
        case _:
            return f"{block} met a number that is not finite" if block else "the new state is not finite"


def like(state: State, values: Sequence[Any]) -> State:
    """Return values as a numpy array if state is one, else as a list."""
    if type(state).__module__ == "numpy":
        import numpy as np

        return np.array(values, dtype=float)
    return list(values)


def load(source: Emission | str | Path, module: str = "", target: str = "") -> Integrator:
    """Return the integrator of an emission, or of a module in a folder that holds a manifest.

    ``module`` and ``target`` choose among the folder's modules where it has several. C is compiled, or taken
    from the cache. Errors: CompilerMissing, CompileError, InputError for a folder without such a module.
    """
    emission = source if isinstance(source, Emission) else read(Path(source), module, target)
    interface = Interface.from_json(emission.manifest["interface"])
    defaults = emission.manifest["defaults"]
    if emission.manifest["target"] == "c":
        path = build(emission.files)
        try:
            return CompiledIntegrator(interface, defaults, path)
        except OSError:  # a damaged file in the cache; what is built anew and fails again is told
            path.unlink(missing_ok=True)
            return CompiledIntegrator(interface, defaults, build(emission.files))
    return InterpretedIntegrator(interface, defaults, emission.files[f"{interface.module}.py"])
