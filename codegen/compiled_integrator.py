"""Integrators that call emitted C code. The package ``cffi`` loads the code from a shared object."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from codegen.arrival import Arrival, Begun, Reached, Signals, Status
from codegen.event import EventValues
from codegen.integrator import Integrator
from codegen.printers.c.module import prototypes
from codegen.printers.interface import Interface
from codegen.run.status import reason
from orderconds.errors import InputError


class CompiledIntegrator(Integrator):
    """An integrator whose C code is in a shared object.

    While the C code runs, Python's global interpreter lock is released.
    """

    def __init__(self, interface: Interface, defaults: Mapping[str, float], path: Path) -> None:
        from cffi import FFI

        super().__init__(interface, defaults)
        self._ffi = FFI()
        self._ffi.cdef(prototypes(interface))
        self._library = self._ffi.dlopen(str(path))
        try:
            self._run = getattr(self._library, f"{interface.prefix}run")
        except AttributeError:
            # ``dlopen`` reads a rebuilt file only after the old library is closed.
            self._ffi.dlclose(self._library)
            raise

    def _call(
        self, begun: Begun, t: float, h: float, steps: int, stride: int
    ) -> tuple[Sequence[float], Sequence[Sequence[float]]]:
        size, real, new = self.interface.size, self.interface.format.c_type, self._ffi.new
        state, completed = new(f"{real}[]", begun.numbers), new("size_t *")
        row_count = steps // stride + 1 if stride else 0
        try:
            rows = new(f"{real}[]", row_count * size) if stride else self._ffi.NULL
        except (MemoryError, OverflowError):
            raise InputError(
                f"not enough memory for {row_count} states",
                expected="enough memory for all states of the trajectory",
                hint="use a larger stride, or fewer steps",
            ) from None
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
                why = f"expected finite numbers, rtol >= 0, atol >= 0 and rtol + atol > 0, found {given}"
            failed = begun.failed(status, accepted[0], final, why)
            failed.arrival = Arrival(
                failed.state, t[0], h[0], accepted[0], rejected[0], None, (), failed.status
            )
            raise failed
        return Arrival(final, t[0], h[0], accepted[0], rejected[0])

    def _integrate(
        self,
        begun: Begun,
        values: EventValues,
        span: tuple[float, float, float],
        bounds: tuple[float, ...],
        limit: int,
        times: Sequence[float],
    ) -> Reached:
        interface, size = self.interface, self.interface.size
        real, new = interface.format.c_type, self._ffi.new
        state, t, h = new(f"{real}[]", begun.numbers), new(f"{real} *", span[0]), new(f"{real} *", span[2])
        rows, written = new(f"{real}[]", max(1, len(times)) * size), new("size_t *")
        counts = [new("size_t *"), new("size_t *")] if interface.controlled else [new("size_t *")]
        chosen = [h, *bounds] if interface.controlled else [span[2]]
        buffers = _Buffers(self._ffi, interface, values) if interface.events else None
        with self._observed(begun) as (sampled, counted):
            status = getattr(self._library, f"{interface.prefix}integrate")(
                *(state, t, span[1], *chosen, limit, *begun.values, *sampled),
                *(list(times), len(times), rows, written),
                *([] if buffers is None else buffers.arguments),
                *(*counted, *counts),
            )
        why = ""
        if status not in (Status.OK, Status.EVENT):
            why = reason(Status(status).name, self._block(counted), span[2])
        if status == Status.BAD_STEP:
            given = "t={}, end={}, h={}".format(*span)
            given += ", rtol={}, atol={}, least={}, greatest={}".format(*bounds) * interface.controlled
            bounded = "rtol >= 0, atol >= 0, rtol + atol > 0, 0 <= least <= greatest, and greatest > 0"
            expected = bounded if interface.controlled else "and a step size other than 0"
            why = f"expected finite numbers, {expected}; found {given}"
        flat = self._ffi.unpack(rows, written[0] * size) if written[0] else []
        return Reached(
            status,
            self._ffi.unpack(state, size),
            t[0],
            h[0],
            [flat[i : i + size] for i in range(0, len(flat), size)],
            [] if buffers is None else buffers.crossings(),
            counts[0][0],
            counts[1][0] if interface.controlled else 0,
            why,
        )

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
        """Yield two lists of arguments for a C function.

        The first list is for the run-time inputs, and the second list is for the iteration counts.

        This method is a context manager. In the body of the ``with`` statement, the caller passes both lists
        to the C function. The C function calls the user's Python function that computes the run-time inputs.
        If the Python function raises an error, the C function cannot pass on the error. Therefore this method
        raises this error at the end of the ``with`` statement.
        """
        callback = None if begun.inputs is None else _Callback(self._ffi, self.interface, begun.inputs)
        blocks, prefix = self.interface.blocks, self.interface.prefix
        counted = [self._ffi.new(f"{prefix}statistics *")] if blocks else []
        yield [] if callback is None else [callback.pointer, self._ffi.NULL], counted
        if callback is not None and callback.failure is not None:
            raise callback.failure
        self._count(counted[0] if counted else None, begun.statistics)

    def _block(self, counted: list[Any]) -> str:
        """Return the label of the system of equations that the C code could not solve.

        The result is '' if all systems were solved.
        """
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


class _Buffers:
    """The arguments for events in one call of the C function ``integrate``.

    The C code stores events in arrays. If the arrays become full, the C code ends the run. To prevent this,
    the arrays are emptied each time the C code calls the event functions: the stored events are moved to the
    list ``events``.
    """

    def __init__(self, ffi: Any, interface: Interface, values: EventValues) -> None:
        real, size = interface.format.c_type, interface.size
        self.size, self.null = size, ffi.NULL
        self.events: list[tuple[int, float, int, list[float]]] = []
        # Let n be the number of event functions. When the C code calls the event functions, ``write`` first
        # empties the arrays that store events. Then the C code stores at most n new events, and it ends the
        # run if fewer than n entries are left for the events of the next step. With 2 n entries in the
        # arrays, at least n entries are left.
        self.room = 2 * interface.events

        def write(t: float, state: Any, array: Any, data: Any) -> None:
            self.empty()
            for k, x in enumerate(values(t, ffi.unpack(state, size))):
                array[k] = x

        self.function = ffi.callback(f"void({real}, const {real} *, {real} *, void *)", write)
        stops = [event.stops for event in values.events]
        self.stops = ffi.new("size_t[]", stops + [0] * (interface.events - len(stops)))
        self.times, self.rows = ffi.new(f"{real}[]", self.room), ffi.new(f"{real}[]", self.room * size)
        self.numbers, self.count = ffi.new("size_t[]", self.room), ffi.new("size_t *")

    @property
    def arguments(self) -> list[Any]:
        """The arguments for events, in the order of the parameters of the C function ``integrate``."""
        buffers = [self.times, self.rows, self.numbers, self.count]
        return [self.function, self.null, self.stops, self.room, *buffers]

    def crossings(self) -> list[tuple[int, float, int, list[float]]]:
        """Return the zeros that the C code found.

        Each zero is a tuple (index of the event function, time, direction, state).
        """
        self.empty()
        return self.events

    def empty(self) -> None:
        """Move the stored events from the C arrays to the list ``events``."""
        n = self.size
        for k in range(self.count[0]):
            row = [self.rows[k * n + i] for i in range(n)]
            self.events.append((self.numbers[k] // 2, self.times[k], 2 * (self.numbers[k] % 2) - 1, row))
        self.count[0] = 0


class _Callback:
    """A Python function that C code calls to compute the run-time inputs at a given time.

    ``function`` returns one float for each run-time input. If it raises an error, the attribute ``failure``
    is this error.
    """

    def __init__(self, ffi: Any, interface: Interface, function: Signals) -> None:
        self.function, self.count = function, len(interface.inputs)
        self.failure: BaseException | None = None
        real = interface.format.c_type
        self.pointer = ffi.callback(f"void({real}, {real} *, void *)", self._write)

    def _write(self, t: float, values: Any, context: Any) -> None:
        inputs = [math.nan] * self.count
        try:
            if self.failure is None:
                inputs = list(self.function(t))
        except BaseException as error:  # a Python exception must not pass through C code
            self.failure, inputs = error, [math.nan] * self.count
        for k, x in enumerate(inputs):
            values[k] = x
