"""The calling convention of an emitted module: its functions and their arguments.

The header of the module describes the convention for users. The loader reads the convention from the manifest
of the module.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from codegen.ir.kernel import ELAPSED, LEAD, NEWTON, Kernel
from codegen.ir.precision import DOUBLE, Precision, precision
from codegen.run.site_terms import padded

LISTS = ("parameters", "blocks", "inputs", "solvers")
"""The fields of :class:`Interface` that are tuples. In JSON they are lists."""

LATTICE = ("dimension", "workspace")
"""The fields of :class:`Interface` that the manifest contains only for a lattice."""

MODES = ("modes",)
"""The field ``modes`` of :class:`Interface`. The manifest contains this field only if its value is True."""

RUN = ("integrated", "controlled", "events", "dense")
"""The fields of :class:`Interface` about runs to a given end time.

The manifest contains these fields only if the module has a function for these runs.
"""


@dataclass(frozen=True)
class Interface:
    """The calling convention of one module.

    - ``prefix`` is the beginning of every external C name, including a final underscore.
    - ``size`` is the number of coordinates of a state.
    - ``time`` is True if the time t is an argument of the step.
    - ``parameters`` are the run-time parameters in the order of the arguments.
    - ``inputs`` are the names of the run-time inputs (functions of time).
    - ``blocks`` are the labels of the blocks of implicit equations.
    - ``solvers`` has the solution method of each block, in the order of ``blocks``.
    - ``precision`` is the name of the number format (:mod:`codegen.ir.precision`).
    - ``adaptive`` is True if the module has a function for runs with step-size control.
    - ``variations`` is the number of rows of the Jacobian of a step, or 0 if the module does not compute the
      Jacobian.
    - ``batch`` is True if the module has a function for many independent systems.
    - ``integrated`` is True if the module has a function for runs to a given end time.
    - ``controlled`` is True if runs to a given end time have step-size control.
    - ``events`` is the number of event functions of runs to a given end time.
    - ``dense`` is the order of the continuous extension, or 0 if there is none.
    - ``dimension`` is the dimension of the lattice, or 0 for a single system.
    - ``workspace`` is the number of rows of the array for intermediate values on a lattice.
    - ``modes`` is True for a step on Fourier modes.
    """

    prefix: str
    size: int
    time: bool
    parameters: tuple[str, ...]
    blocks: tuple[str, ...]
    precision: str = DOUBLE.name
    inputs: tuple[str, ...] = ()
    adaptive: bool = False
    variations: int = 0
    solvers: tuple[str, ...] = ()
    batch: bool = False
    integrated: bool = False
    controlled: bool = False
    events: int = 0
    dense: int = 0
    dimension: int = 0
    workspace: int = 0
    modes: bool = False

    def workspace_of(self, sites: int) -> int:
        """Return the number of entries in the workspace of a lattice with ``sites`` sites."""
        # The padding of the rows avoids cache conflicts.
        return self.workspace * padded(sites)

    @classmethod
    def of(cls, kernel: Kernel, prefix: str, precision: str = DOUBLE.name) -> Interface:
        """Return the interface of a kernel.

        The time t and the parameters are arguments only if the kernel reads them.
        """
        used = kernel.used_scalars()
        # Run-time inputs are functions of the time t, so a kernel with inputs reads t.
        assert not kernel.inputs or "t" in used
        return cls(
            prefix=prefix,
            # For a lattice, ``size`` is the number of coordinates of one site.
            size=sum(len(field.symbols) for field in kernel.state),
            time="t" in used,
            # Parameters that simplification removed are not in ``used``, so they are not arguments.
            parameters=tuple(name for name in used if name not in ("h", "t", LEAD, ELAPSED)),
            blocks=tuple(loop.label for loop in kernel.loops),
            precision=precision,
            inputs=kernel.inputs,
            adaptive=kernel.adaptive,
            # The outputs of ``kernel.vary`` are the entries of one column of the Jacobian.
            variations=0 if kernel.vary is None else len(kernel.vary.outputs),
            solvers=tuple(loop.solver for loop in kernel.loops),
            batch=kernel.batch,
            integrated=kernel.observed is not None,
            # A run to a given end time chooses the step sizes itself if there is an error estimate.
            controlled=kernel.observed is not None and kernel.estimate is not None,
            events=0 if kernel.observed is None else kernel.observed.events,
            dense=_order_of_extension(kernel),
            dimension=0 if kernel.sites is None else kernel.sites.dimension,
            workspace=0 if kernel.sites is None else kernel.sites.workspace,
            modes=kernel.modes is not None,
        )

    @property
    def format(self) -> Precision:
        """The floating-point format. Its name is ``self.precision``."""
        return precision(self.precision)

    @property
    def newton(self) -> bool:
        """True if Newton's method solves at least one block. The simplified Newton method does not count."""
        return NEWTON in self.solvers

    @property
    def module(self) -> str:
        """The name of the module: the prefix without the underscore at the end."""
        return self.prefix.removesuffix("_")

    def as_json(self) -> dict[str, Any]:
        """Return the interface as JSON data for the manifest."""
        # JSON has no tuples, so tuples become lists.
        data = asdict(self) | {name: list(getattr(self, name)) for name in LISTS}
        # Fields that the module does not use are omitted (see RUN, LATTICE and MODES).
        hidden = (*(() if self.integrated else RUN), *(() if self.dimension else LATTICE))
        hidden += () if self.modes else MODES
        return {k: x for k, x in data.items() if k not in hidden}

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> Interface:
        """Convert ``data``, a result of :meth:`as_json`, back to an interface."""
        # The method ``as_json`` converted tuples to lists. Here, the lists are converted back to tuples.
        return cls(**(data | {name: tuple(data.get(name, ())) for name in LISTS}))


def _order_of_extension(kernel: Kernel) -> int:
    """Return the order of the continuous extension of a kernel, or 0 if there is none."""
    # Only runs to a given end time use a continuous extension. If ``kernel.observed`` is None, the module has
    # no function for these runs, and therefore no extension.
    extension = None if kernel.observed is None else kernel.observed.extension
    return 0 if extension is None else extension.order
