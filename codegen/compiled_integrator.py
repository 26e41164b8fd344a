"""Emitted C modules, compiled to shared objects and called through cffi (ABI mode)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from codegen.integrator import Arrival, Begun, Integrator, Signals, Status
from codegen.printers.c.module import prototypes
from codegen.printers.interface import Interface
from codegen.run.status import reason


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
            # The library has no such function and is closed. If it stayed open, loading a rebuilt library of
            # the same name would return the old library.
            self._ffi.dlclose(self._library)
            raise

    def _call(
        self, begun: Begun, t: float, h: float, steps: int, stride: int
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
            why = reason(Status(status).name, self._block(counted), h)
            raise begun.failed(status, completed[0], final, why)
        flat = self._ffi.unpack(rows, row_count * size) if stride else []
        return final, [flat[i : i + size] for i in range(0, len(flat), size)]

    def _adapt(
        self, begun: Begun, span: tuple[float, float, float], tolerances: tuple[float, float], limit: int
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

    def _call_batch(self, table: Any, moment: tuple[float, float, int], values: Any, held: Any) -> Any:
        if not self.interface.batch:
            return super()._call_batch(table, moment, values, held)
        import numpy as np

        (t, h, steps), number, real = moment, table.shape[1], self.interface.format.c_type
        statuses, completed = np.zeros(number, np.int32), np.zeros(number, np.uintp)

        def pointer(array: Any, kind: str) -> Any:
            return self._ffi.cast(f"{kind} *", self._ffi.from_buffer(array))

        time = [t] if self.interface.time else []
        data = [pointer(x, real) for x in (values, held) if len(x)]
        run = getattr(self._library, f"{self.interface.prefix}run_batch")
        run(
            number,
            number,
            pointer(table, real),
            *time,
            h,
            steps,
            *data,
            pointer(statuses, "int"),
            pointer(completed, "size_t"),
        )
        return statuses, completed

    @contextmanager
    def _observed(self, begun: Begun) -> Iterator[tuple[list[Any], list[Any]]]:
        """Yield the arguments for inputs and statistics. After the call, raise the error that an input
        function has raised during the call, if any."""
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

    def _derive(self, begun: Begun, t: float, h: float, held: list[float] | None) -> list[list[float]]:
        real, size = self.interface.format.c_type, self.interface.variations
        matrix = self._ffi.new(f"{real}[]", size * size)
        time, inputs = [t] if self.interface.time else [], [] if held is None else [held]
        derive = getattr(self._library, f"{self.interface.prefix}jacobian")
        status = derive(begun.numbers, *time, h, *begun.values, *inputs, matrix)
        if status != Status.OK:
            why = reason(Status(status).name, "an implicit block", h)
            raise begun.failed(status, 0, begun.numbers, why)
        flat = self._ffi.unpack(matrix, size * size)
        return [flat[i : i + size] for i in range(0, size * size, size)]


class _Callback:
    """A function of time that C can call. If the Python function raises an error, the error is stored, and
    the inputs are NaNs, with which the step fails."""

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
        except BaseException as error:  # a Python exception must not pass through C code
            self.failure, inputs = error, [math.nan] * self.count
        for k, x in enumerate(inputs):
            values[k] = x
