"""Emitted modules as Python objects with one interface: compiled C through cffi (ABI mode), or Python.

A target names the function that loads its modules (:attr:`codegen.printers.Target.loader`).
"""

from __future__ import annotations

import math
import operator
import types
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from enum import IntEnum
from pathlib import Path
from typing import Any

from codegen.artifact import Artifact, read
from codegen.build import build
from codegen.ir.kernel import FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON
from codegen.printers import target as known_target
from codegen.printers.c.module import prototypes
from codegen.printers.interface import Interface
from codegen.run.status import reason
from orderconds.errors import InputError

State = Any
"""A sequence of floats. Results are numpy arrays if the argument is a numpy array, else lists."""

Signals = Callable[[float], Sequence[float]]
"""A function from the time to the run-time inputs."""


SOLVERS = (NEWTON, SIMPLIFIED_NEWTON, FIXED_POINT)
"""The solvers of implicit blocks, the most robust first."""


class Status(IntEnum):
    """The result of a step; emitted code returns these numbers."""

    OK = 0
    NOT_CONVERGED = 1
    NOT_FINITE = 2
    BAD_STEP = 3
    LIMIT = 4
    TOO_FAR = 5
    SINGULAR = 6
    TOO_SHORT = 7


class StepFailed(ArithmeticError):
    """The error of a failed step: its status, the number of steps completed before it, and the state after
    these steps."""

    def __init__(self, status: Status, step: int, state: State, reason: str) -> None:
        super().__init__(f"step {step + 1}: {reason}")
        self.status, self.step, self.state, self.reason = status, step, state, reason


@dataclass(frozen=True)
class Arrival:
    """The end of an adaptive run: state, time, size of the next step, accepted and rejected steps."""

    state: State
    t: float
    h: float
    accepted: int
    rejected: int


@dataclass
class Statistics:
    """Counts of a run: ``sweeps`` of each block in all steps, and ``most``, the largest number of sweeps of a
    block in one step. ``failed`` is the index of the block that failed, counted from 1, or 0 if no block
    failed.

    ``matrices`` is the number of Newton matrices that were computed.
    """

    sweeps: list[int] = field(default_factory=list)
    most: int = 0
    failed: int = 0
    matrices: int = 0


@dataclass(frozen=True)
class _Begun:
    """The checked arguments of a call: state, state as numbers, parameter values, inputs, statistics."""

    state: State
    numbers: list[float]
    values: list[float]
    inputs: Signals | None = None
    statistics: Statistics | None = None
    solvers: tuple[str, ...] = ()

    def failed(self, status: int, step: int, state: Sequence[float], reason: str) -> StepFailed:
        """Return the error of a failed step; its state has the type of the caller's state.

        If an implicit block did not converge, the message names the other solvers.
        """
        if status == Status.NOT_CONVERGED:
            others = [s for s in SOLVERS if s not in self.solvers]
            options = f", or emit with --solver {' or '.join(others)}" if others else ""
            reason += f"; take shorter steps{options}"
        return StepFailed(Status(status), step, like(self.state, state), reason)


class Integrator(ABC):
    """A loaded module: ``interface`` lists its arguments, ``defaults`` the scene's parameter values."""

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
        """Return the state after one step of size h; raise StepFailed if the step fails.

        ``inputs`` are the run-time inputs, in the interface's order; they are constant during the step.
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
        """Return the state after ``steps`` steps of size h from time t; raise StepFailed if a step fails.

        ``inputs`` is a function from the time to the run-time inputs, in the interface's order.
        """
        begun = self._begin(state, parameters, inputs, statistics)
        final, _ = self._call(begun, t, h, self._checked_count(steps), 0)
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
        """Return a list of states: the initial state and every stride-th state after it."""
        if stride < 1:
            raise ValueError(f"expected a stride of at least 1, found {stride}")
        begun = self._begin(state, parameters, inputs, statistics)
        _, rows = self._call(begun, t, h, self._checked_count(steps), stride)
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
        """Integrate from t to end with steps as large as the tolerances allow; the first step has size ``h``.

        TypeError is raised for a module without an error estimate (``emit --adaptive``). StepFailed is raised
        if a step fails. It is also raised, with the status ``LIMIT``, if ``limit`` steps do not reach the
        end.
        """
        if not self.interface.adaptive:
            raise TypeError("this module has no adaptive run; emit it with --adaptive")
        span, tolerances = (float(t), float(end), float(h)), (float(rtol), float(atol))
        begun = self._begin(state, parameters, inputs, statistics)
        arrival = self._adapt(begun, span, tolerances, operator.index(limit))
        return replace(arrival, state=like(state, arrival.state))

    def jacobian(
        self,
        state: State,
        h: float,
        t: float = 0.0,
        inputs: Sequence[float] | None = None,
        **parameters: float,
    ) -> State:
        """Return the derivative of one step with respect to the state. The header of the emitted module
        describes its rows and columns.

        TypeError is raised for a module without a Jacobian (``emit --jacobian``), StepFailed if the step
        fails.
        """
        if not self.interface.variations:
            raise TypeError("this module has no derivative of its step; emit it with --jacobian")
        if bool(self.interface.inputs) != (inputs is not None):
            raise TypeError(f"expected values for {', '.join(self.interface.inputs) or 'no inputs'}")
        held = None if inputs is None else [float(x) for x in inputs]
        begun = _Begun(state, self._numbers(state), self._values(parameters), solvers=self.interface.solvers)
        return like(state, self._derive(begun, t, h, held))

    def _begin(
        self,
        state: State,
        parameters: Mapping[str, float],
        inputs: Signals | None,
        statistics: Statistics | None,
    ) -> _Begun:
        """Return the checked arguments; raise TypeError for wrong names or inputs, ValueError for a wrong
        state."""
        names = self.interface.inputs
        if bool(names) != (inputs is not None):
            raise TypeError(f"expected {'a function for ' + ', '.join(names) if names else 'no inputs'}")
        return _Begun(
            state,
            self._numbers(state),
            self._values(parameters),
            inputs,
            statistics,
            self.interface.solvers,
        )

    def _checked_count(self, steps: int) -> int:
        count = operator.index(steps)
        if count < 0:
            raise ValueError(f"expected no negative number of steps, found {steps}")
        return count

    def _numbers(self, state: State) -> list[float]:
        numbers = [float(x) for x in state]
        if len(numbers) != self.interface.size:
            raise ValueError(f"expected {self.interface.size} numbers in state, found {len(numbers)}")
        return numbers

    def _values(self, parameters: Mapping[str, float]) -> list[float]:
        known = self.interface.parameters
        for name in parameters:
            if name not in known:
                raise TypeError(f"unknown parameter {name}; the parameters are: {', '.join(known) or 'none'}")
        values = {**self.defaults, **parameters}
        for name in known:
            if name not in values:
                raise TypeError(f"the parameter {name} has no value")
        return [float(values[name]) for name in known]

    def _count(self, counts: Any, statistics: Statistics | None) -> None:
        """Add the counts that emitted code has returned to the caller's statistics."""
        if counts is not None and statistics is not None:
            before = statistics.sweeps or [0] * len(self.interface.blocks)
            statistics.sweeps = [a + b for a, b in zip(before, counts.sweeps, strict=True)]
            statistics.most = max(statistics.most, counts.most)
            statistics.failed = counts.failed
            statistics.matrices += counts.matrices if self.interface.newton else 0

    @abstractmethod
    def _call(
        self, begun: _Begun, t: float, h: float, steps: int, stride: int
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        """Run the steps, and return the final state and the rows of the trajectory."""

    @abstractmethod
    def _derive(self, begun: _Begun, t: float, h: float, held: list[float] | None) -> list[list[float]]:
        """Return the rows of the Jacobian."""

    @abstractmethod
    def _adapt(
        self, begun: _Begun, span: tuple[float, float, float], tolerances: tuple[float, float], limit: int
    ) -> Arrival:
        """Run with step control; ``span`` is (t, end, h)."""


class CompiledIntegrator(Integrator):
    """An emitted C module in a shared object. Calls release Python's global interpreter lock."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], path: Path) -> None:
        from cffi import FFI

        super().__init__(interface, defaults)
        self._ffi = FFI()
        self._ffi.cdef(prototypes(interface))
        self._library = self._ffi.dlopen(str(path))
        try:
            self._run = getattr(self._library, f"{interface.prefix}run")
        except AttributeError:
            # The library is closed, because loading a rebuilt library of the same name would otherwise return
            # this one.
            self._ffi.dlclose(self._library)
            raise

    def _call(
        self, begun: _Begun, t: float, h: float, steps: int, stride: int
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        size, real, new = self.interface.size, self.interface.format.c_type, self._ffi.new
        state, completed = new(f"{real}[]", begun.numbers), new("size_t *")
        row_count = steps // stride + 1 if stride else 0
        rows = new(f"{real}[]", row_count * size) if stride else self._ffi.NULL
        time = [t] if self.interface.time else []
        with self._observed(begun) as (sampled, counted):
            arguments = [state, *time, h, steps, *begun.values, *sampled, rows, stride, *counted, completed]
            status = self._run(*arguments)
        final = self._ffi.unpack(state, size)
        if status != Status.OK:
            raise begun.failed(
                status, completed[0], final, reason(Status(status).name, self._block(counted), h)
            )
        flat = self._ffi.unpack(rows, row_count * size) if stride else []
        return final, [flat[i : i + size] for i in range(0, len(flat), size)]

    def _adapt(
        self, begun: _Begun, span: tuple[float, float, float], tolerances: tuple[float, float], limit: int
    ) -> Arrival:
        real, new = self.interface.format.c_type, self._ffi.new
        state, t, h = new(f"{real}[]", begun.numbers), new(f"{real} *", span[0]), new(f"{real} *", span[2])
        accepted, rejected = new("size_t *"), new("size_t *")
        run = getattr(self._library, f"{self.interface.prefix}run_adaptive")
        with self._observed(begun) as (sampled, counted):
            arguments = [state, t, span[1], h, *tolerances, limit, *begun.values, *sampled, *counted]
            status = run(*arguments, accepted, rejected)
        final = self._ffi.unpack(state, self.interface.size)
        if status != Status.OK:
            why = reason(Status(status).name, self._block(counted), span[2])
            if status == Status.BAD_STEP:
                given = "t={}, end={}, h={}, rtol={}, atol={}".format(*span, *tolerances)
                why = f"expected finite numbers and no negative tolerance, found {given}"
            raise begun.failed(status, accepted[0], final, why)
        return Arrival(final, t[0], h[0], accepted[0], rejected[0])

    @contextmanager
    def _observed(self, begun: _Begun) -> Iterator[tuple[list[Any], list[Any]]]:
        """Yield the arguments for inputs and statistics. After the call, raise the error that an input
        function has raised in it, if any."""
        callback = None if begun.inputs is None else _Callback(self._ffi, self.interface, begun.inputs)
        blocks, prefix = self.interface.blocks, self.interface.prefix
        counted = [self._ffi.new(f"{prefix}statistics *")] if blocks else []
        yield [] if callback is None else [callback.pointer, self._ffi.NULL], counted
        if callback is not None and callback.failure is not None:
            raise callback.failure
        self._count(counted[0] if counted else None, begun.statistics)

    def _block(self, counted: list[Any]) -> str:
        """Return the label of the block that failed; '' if no block failed."""
        failed = counted[0].failed if counted else 0
        return self.interface.blocks[failed - 1] if failed else ""

    def _derive(self, begun: _Begun, t: float, h: float, held: list[float] | None) -> list[list[float]]:
        real, size = self.interface.format.c_type, self.interface.variations
        matrix = self._ffi.new(f"{real}[]", size * size)
        time, inputs = [t] if self.interface.time else [], [] if held is None else [held]
        derive = getattr(self._library, f"{self.interface.prefix}jacobian")
        status = derive(begun.numbers, *time, h, *begun.values, *inputs, matrix)
        if status != Status.OK:
            raise begun.failed(status, 0, begun.numbers, reason(Status(status).name, "an implicit block", h))
        flat = self._ffi.unpack(matrix, size * size)
        return [flat[i : i + size] for i in range(0, size * size, size)]


class _Callback:
    """A function of time that C may call. If it raises, the error is stored, and NaNs make the step fail."""

    def __init__(self, ffi: Any, interface: Interface, function: Signals) -> None:
        self.function, self.count = function, len(interface.inputs)
        self.failure: BaseException | None = None
        real = interface.format.c_type
        self.pointer = ffi.callback(f"void({real}, {real} *, void *)", self._write)

    def _write(self, t: float, values: Any, context: Any) -> None:
        inputs = [math.nan] * self.count
        try:
            if self.failure is None:
                inputs = [float(x) for x in self.function(t)]
            if len(inputs) != self.count:
                raise TypeError(f"expected {self.count} inputs, found {len(inputs)}")
        except BaseException as error:  # an exception must not cross C frames
            self.failure, inputs = error, [math.nan] * self.count
        for k, x in enumerate(inputs):
            values[k] = x


class InterpretedIntegrator(Integrator):
    """An emitted Python module."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], source: str) -> None:
        super().__init__(interface, defaults)
        self.module = types.ModuleType(interface.module)
        exec(compile(source, f"{interface.module}.py", "exec"), self.module.__dict__)

    def _call(
        self, begun: _Begun, t: float, h: float, steps: int, stride: int
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        time, sampled = [t] if self.interface.time else [], [] if begun.inputs is None else [begun.inputs]
        with self._observed(begun) as counted:
            arguments = [begun.numbers, *time, h, steps, *sampled, *begun.values]
            answer = self.module.run(*arguments, stride=stride, **counted)
        return (answer[-1], answer) if stride else (answer, [])

    def _adapt(
        self, begun: _Begun, span: tuple[float, float, float], tolerances: tuple[float, float], limit: int
    ) -> Arrival:
        t, end, h = span
        sampled = [] if begun.inputs is None else [begun.inputs]
        keywords: dict[str, Any] = dict(zip(("rtol", "atol"), tolerances, strict=True)) | {"limit": limit}
        keywords |= dict(zip(self.interface.parameters, begun.values, strict=True))
        with self._observed(begun) as counted:
            return Arrival(
                *self.module.run_adaptive(begun.numbers, t, end, *sampled, h, **keywords, **counted)
            )

    def _derive(self, begun: _Begun, t: float, h: float, held: list[float] | None) -> list[list[float]]:
        time, inputs = [t] if self.interface.time else [], [] if held is None else [held]
        try:
            return list(self.module.jacobian(begun.numbers, *time, h, *inputs, *begun.values))
        except self.module.StepFailed as failure:
            raise begun.failed(failure.status, 0, begun.numbers, failure.reason) from None

    @contextmanager
    def _observed(self, begun: _Begun) -> Iterator[dict[str, Any]]:
        """Yield the argument for statistics; convert StepFailed of the emitted module to
        :class:`StepFailed`."""
        counts = self.module.Statistics() if self.interface.blocks else None
        try:
            yield {} if counts is None else {"statistics": counts}
        except self.module.StepFailed as failure:
            raise begun.failed(failure.status, failure.step, failure.state, failure.reason) from None
        finally:
            self._count(counts, begun.statistics)


def like(state: State, values: Sequence[Any]) -> State:
    """Return values as a numpy array if state is a numpy array, else as a list."""
    if type(state).__module__ == "numpy":
        import numpy as np

        return np.array(values, dtype=float)
    return list(values)


def load(source: Artifact | str | Path, module: str = "", target: str = "") -> Integrator:
    """Return the integrator of an artifact, or of a module in a folder with a manifest.

    ``module`` and ``target`` choose a module if the folder has several. C code is compiled, or a compiled
    file is read from the cache. Errors: CompilerMissing, CompileError, and InputError for a folder without
    such a module.
    """
    artifact = source if isinstance(source, Artifact) else read(Path(source), module, target)
    try:
        interface = Interface.from_json(artifact.manifest["interface"])
        defaults = dict(artifact.manifest["defaults"])
    except (KeyError, TypeError, ValueError, AttributeError):
        raise InputError(
            f"the manifest's entry for {artifact.key[0]} was changed", hint="emit the module again"
        ) from None
    return known_target(artifact.manifest["target"]).load(interface, defaults, artifact.files)


def load_compiled(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Integrator:
    """Return the integrator of a C module; the module is compiled unless the cache contains it."""
    try:
        return CompiledIntegrator(interface, defaults, build(files))
    except (OSError, AttributeError):
        # The cached file has the recorded digest, but it is no library or it lacks the functions of the
        # module. It is built again.
        return CompiledIntegrator(interface, defaults, build(files, again=True))


def load_interpreted(
    interface: Interface, defaults: Mapping[str, float], files: Mapping[str, str]
) -> Integrator:
    """Return the integrator of a Python module."""
    return InterpretedIntegrator(interface, defaults, files[f"{interface.module}.py"])
