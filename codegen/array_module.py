"""The base class of emitted modules for lattices and for semilinear equations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from codegen import lanes
from codegen.argument import real
from codegen.arrival import Status
from codegen.artifact import Artifact
from codegen.printers.interface import Interface


@dataclass(frozen=True, kw_only=True)
class ArrayRun:
    """The result of a run: the status code, the number of completed steps, and the reason for a failure."""

    status: Status
    completed: int
    reason: str = ""

    @property
    def ok(self) -> bool:
        """True if no step failed."""
        return self.status == Status.OK


class ArrayModule:
    """An emitted module whose functions take the number of lattice sites or grid points as an argument."""

    artifact: Artifact

    def __init__(self, interface: Interface, defaults: Mapping[str, float]) -> None:
        self.interface, self.defaults = interface, dict(defaults)

    def _values(self, parameters: Mapping[str, object]) -> list[float]:
        """Return the values of all parameters, in the order of ``interface.parameters``.

        TypeError is raised if ``parameters`` contains an unknown name.
        """
        pairs = lanes.chosen(self.interface.parameters, self.defaults, parameters)
        return [real(x, name) for name, x in pairs]
