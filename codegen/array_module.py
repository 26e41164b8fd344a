"""The base class of emitted modules for lattices and for semilinear equations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from codegen import lanes
from codegen.argument import described, real
from codegen.arrival import Status
from codegen.artifact import Artifact
from codegen.printers.interface import Interface

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


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


def real_array(given: object, content: str) -> NDArray[Any]:
    """Return ``given`` as an array of real numbers.

    ValueError is raised for rows of different lengths, and TypeError for entries that are not real numbers.
    ``content`` is a word for the entries in error messages, such as "values".
    """
    import numpy as np

    try:
        array: NDArray[np.generic] = np.asarray(given)
    except ValueError:
        raise ValueError(f"expected an array of {content}, found rows of different lengths") from None
    if array.dtype.kind not in "fiub":
        raise TypeError(f"expected real numbers, found {described(given)}")
    return array
