"""Emitted modules for chains and lattices, called from Python."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
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
class LatticeRun(ArrayRun):
    """The result of a run on a lattice with n1 x ... x nd sites and ``size`` numbers for each site.

    ``states`` contains the final states as an array of shape (n1, ..., nd, size).
    """

    states: Floats


class Lattice(ArrayModule, ABC):
    """An emitted module for a chain or lattice with any number of sites, as a Python object."""

    def run(self, states: object, h: float, steps: int, t: float = 0.0, **parameters: object) -> LatticeRun:
        """Return the states of all sites after ``steps`` steps of size h from time t.

        ``states`` has the shape (n1, ..., nd, size), with one state for each site of the lattice. If a step
        fails, the result contains the status and the states before the failed step.

        ValueError is raised if ``states`` has a wrong shape or contains a number that is not finite, or if
        the method cannot be used with n1, ..., nd sites. TypeError is raised for arguments of a wrong type
        and for unknown parameters. InputError is raised if there is not enough memory.
        """
        import numpy as np

        interface = self.interface
        table = self._table(states)
        shape = tuple(int(n) for n in table.shape[1:])
        h, t, steps = real(h, "h"), real(t, "t"), count(steps, "steps")
        values = self._values(parameters)
        finite = np.isfinite(table).all(axis=0)
        if not finite.all():
            place = tuple(int(i) for i in np.argwhere(~finite)[0])
            state = table[(slice(None), *place)].tolist()
            raise ValueError(f"expected finite numbers, found the state {state} at site {place}")
        try:
            work = np.empty(interface.workspace_of(finite.size), table.dtype)
        except MemoryError:
            raise InputError(
                f"not enough memory for the workspace of {finite.size} sites",
                expected=f"memory for {interface.workspace} numbers for each site",
                hint="use fewer sites",
            ) from None
        status, completed = self.advance(shape, table, (t, h, steps), values, work)
        if status == Status.BAD_SHAPE:
            raise ValueError(
                f"the method cannot be used on a lattice of shape {shape}: {reason(status.name, '', h)}"
            )
        block = "" if status == Status.NOT_FINITE else "the equations of the step"
        why = "" if status == Status.OK else reason(status.name, block, h)
        return LatticeRun(states=np.moveaxis(table, 0, -1), status=status, completed=completed, reason=why)

    def _table(self, states: object) -> Any:
        """Return states of shape (n1, ..., nd, size) as a new array of shape (size, n1, ..., nd)."""
        import numpy as np

        n, size = self.interface.dimension, self.interface.size
        kind = np.dtype({"double": np.float64, "float": np.float32}[self.interface.format.c_type])
        given = real_array(states, "states")
        if given.ndim != n + 1 or given.shape[-1] != size or 0 in given.shape:
            expected = ", ".join([*(f"n{k + 1}" for k in range(n)), str(size)])
            raise ValueError(
                f"expected an array of shape ({expected}), found an array of shape {given.shape}"
            )
        return np.array(np.moveaxis(given, -1, 0), dtype=kind, order="C")

    @abstractmethod
    def advance(
        self,
        shape: Sequence[int],
        table: Any,
        moment: tuple[float, float, int],
        values: Sequence[float],
        work: Any,
    ) -> tuple[Status, int]:
        """Update the states in ``table`` step by step. Return the status and the number of completed steps.

        - ``shape``: the numbers of sites (n1, ..., nd) in the d directions.
        - ``table``: the states, an array of shape (size, n1, ..., nd) or (size, n1 x ... x nd).
        - ``moment``: t, h and the number of steps.
        - ``values``: the values of the run-time parameters.
        - ``work``: an array for intermediate results.
        """


class CompiledLattice(Lattice):
    """A compiled C module for a lattice."""

    def __init__(self, interface: Interface, defaults: Mapping[str, float], path: Path) -> None:
        from cffi import FFI

        from codegen.printers.c.lattice import lattice_prototypes

        super().__init__(interface, defaults)
        self._ffi = FFI()
        self._ffi.cdef(lattice_prototypes(interface))
        self._library = self._ffi.dlopen(str(path))
        self._run = getattr(self._library, f"{interface.prefix}run")

    def advance(
        self,
        shape: Sequence[int],
        table: Any,
        moment: tuple[float, float, int],
        values: Sequence[float],
        work: Any,
    ) -> tuple[Status, int]:
        """Call the compiled function. The base class describes the arguments and the result."""
        (t, h, steps), kind = moment, self.interface.format.c_type
        completed = self._ffi.new("size_t *")

        def pointer(array: Any) -> Any:
            return self._ffi.cast(f"{kind} *", self._ffi.from_buffer(array))

        time = [t] if self.interface.time else []
        arguments = [list(shape), pointer(table), *time, h, steps, *values, pointer(work), completed]
        return Status(self._run(*arguments)), completed[0]
