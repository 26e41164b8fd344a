"""Emitted modules for semilinear partial differential equations, as Python objects."""

from __future__ import annotations

import types
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from codegen.argument import count, real, real_array
from codegen.array_module import ArrayModule, ArrayRun
from codegen.arrival import Status
from codegen.printers.interface import Interface
from codegen.run.status import reason
from orderconds.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SpectralRun(ArrayRun):
    """The result of a run. ``values`` are the values of the solution after the last completed step."""

    values: Floats


class Spectral(ArrayModule, ABC):
    """An emitted module for a semilinear equation in x, for grids with any even number of points."""

    def points(self, n: int, **parameters: object) -> Floats:
        """Return the coordinates x of n equally spaced points in one period. The first point is x = 0."""
        import numpy as np

        n = _even(count(n, "n"))
        return np.arange(n) * self._period(self._values(parameters)) / n

    def start(self, n: int, **parameters: object) -> Floats:
        """Return the initial values of the scene at n equally spaced points in one period."""
        return self._initial(self.points(n, **parameters), self._values(parameters))

    def run(self, u: object, h: float, steps: int, t: float = 0.0, **parameters: object) -> SpectralRun:
        """Return the values of the solution after ``steps`` steps of size h from time t.

        ``u`` contains the values at time t at an even number of equally spaced points. If a step fails, the
        result contains the status of the failed step, and the values after the last completed step.

        ValueError is raised for an array with more than one axis, for an odd number of points, and for values
        that are not finite. TypeError is raised for values that are not real numbers, and for unknown
        parameters.
        """
        import numpy as np

        h, t, steps = real(h, "h"), real(t, "t"), count(steps, "steps")
        values = self._values(parameters)
        given = real_array(u, "values")
        if given.ndim != 1:
            raise ValueError(f"expected an array of shape (n,), found an array of shape {given.shape}")
        _even(given.size)
        array = np.array(given, dtype=np.float64)
        finite = np.isfinite(array)
        if not finite.all():
            place = int(np.argmin(finite))
            raise ValueError(f"expected finite numbers, found the value {array[place]} at point {place}")
        result, status, completed = self._call(array, (t, h, steps), values)
        why = "" if status == Status.OK else reason(status.name, "", h)
        return SpectralRun(values=result, status=status, completed=completed, reason=why)

    @abstractmethod
    def _period(self, values: list[float]) -> float:
        """Return the period of the solution in x, for the given values of the parameters."""

    @abstractmethod
    def _initial(self, points: Floats, values: list[float]) -> Floats:
        """Return the initial values at the given points, for the given values of the parameters."""

    @abstractmethod
    def _call(
        self, u: Floats, moment: tuple[float, float, int], values: list[float]
    ) -> tuple[Floats, Status, int]:
        """Return the final solution, the status, and the number of completed steps.

        ``u`` is the initial solution. ``moment`` contains the start time, the step size and the number of
        steps.
        """


def _even(n: int) -> int:
    if n < 2 or n % 2:
        raise ValueError(f"expected an even number of points, at least 2, found {n}")
    return n


class InterpretedSpectral(Spectral):
    """An emitted Python module for a semilinear equation."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], text: str) -> None:
        super().__init__(interface, defaults)
        self._module = types.ModuleType(interface.module)
        exec(compile(text, f"{interface.module}.py", "exec"), self._module.__dict__)

    def _period(self, values: list[float]) -> float:
        return float(self._module.period(*values))

    def _initial(self, points: Floats, values: list[float]) -> Floats:
        result: Floats = self._module.initial(points, *values)
        return result

    def _call(
        self, u: Floats, moment: tuple[float, float, int], values: list[float]
    ) -> tuple[Floats, Status, int]:
        t, h, steps = moment
        result, status, completed = self._module.run(u, h, steps, t, *values)
        return result, Status(status), completed


class CompiledSpectral(Spectral):
    """An emitted C module for a semilinear equation, loaded from a shared object.

    If the number of points is a power of two, the module uses its own Fourier transforms. Otherwise the
    module calls the transforms of NumPy.
    """

    def __init__(self, interface: Interface, defaults: Mapping[str, float], path: Path) -> None:
        from cffi import FFI

        from codegen.printers.c.modes import mode_prototypes

        super().__init__(interface, defaults)
        self._ffi = FFI()
        self._ffi.cdef(mode_prototypes(interface))
        self._library = self._ffi.dlopen(str(path))
        self._function("run")

    def _function(self, name: str) -> Any:
        return getattr(self._library, f"{self.interface.prefix}{name}")

    def _pointer(self, array: Any) -> Any:
        return self._ffi.cast("double *", self._ffi.from_buffer(array))

    def _period(self, values: list[float]) -> float:
        return float(self._function("period")(*values))

    def _initial(self, points: Floats, values: list[float]) -> Floats:
        import numpy as np

        u = np.empty(points.size)
        self._function("initial")(u.size, self._pointer(u), *values)
        return u

    def _call(
        self, u: Floats, moment: tuple[float, float, int], values: list[float]
    ) -> tuple[Floats, Status, int]:
        (t, h, steps), n = moment, u.size
        try:
            tables, work, memory = (self._memory(name, n) for name in ("tables", "workspace", "fft_memory"))
        except MemoryError:
            raise InputError(
                f"not enough memory for {n} points",
                expected="enough memory for the tables and the workspace of the step",
                hint="use fewer points",
            ) from None
        status = Status(self._function("prepare")(n, h, *values, self._pointer(tables)))
        if status != Status.OK:
            return u, status, 0
        transform = self._ffi.new(f"{self.interface.prefix}transform *")
        failures: list[BaseException] = []
        callbacks = self._numpy(failures)  # Python must not delete the callbacks while C calls them
        if self._function("fft_prepare")(n, self._pointer(memory)) == Status.OK:
            transform[0] = self._function("fft")(self._pointer(memory))
        else:
            transform.forward, transform.backward = callbacks
        time = [t] if self.interface.time else []
        completed = self._ffi.new("size_t *")
        arguments = [*values, self._pointer(tables), transform, self._pointer(work), completed]
        status = Status(self._function("run")(n, self._pointer(u), *time, steps, *arguments))
        if failures:
            raise failures[0]
        return u, status, int(completed[0])

    def _memory(self, name: str, n: int) -> Floats:
        """Return an uninitialised array. Its length is the result of the C function ``name`` for n."""
        import numpy as np

        return np.empty(int(self._function(name)(n)))

    def _numpy(self, failures: list[BaseException]) -> tuple[Any, Any]:
        """Return the forward and the backward Fourier transform of NumPy as functions that C can call.

        If a transform raises an error, for example KeyboardInterrupt, the error is added to ``failures``, and
        all results are NaNs.
        """
        import numpy as np

        def doubles(pointer: Any, n: int) -> Floats:
            return np.frombuffer(self._ffi.buffer(pointer, 8 * n), dtype=np.float64)

        def store(array: Floats, transform: Callable[[], Floats]) -> None:
            try:
                # The step tests its results, so NumPy need not warn about infinities.
                with np.errstate(all="ignore"):
                    array[:] = transform()
            except BaseException as error:  # a Python exception must not pass through C code
                failures.append(error)
                array[:] = np.nan

        def forward(n: int, values: Any, spectrum: Any, context: Any) -> None:
            store(doubles(spectrum, n + 2), lambda: np.fft.rfft(doubles(values, n)).view(np.float64))

        def backward(n: int, spectrum: Any, values: Any, context: Any) -> None:
            modes = doubles(spectrum, n + 2).view(np.complex128)
            store(doubles(values, n), lambda: np.fft.irfft(modes, n))

        kinds = ("size_t, const double *, double *, void *", "size_t, double *, double *, void *")
        first, second = (f"void({kind})" for kind in kinds)
        return self._ffi.callback(first, forward), self._ffi.callback(second, backward)
