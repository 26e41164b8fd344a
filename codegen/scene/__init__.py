"""What a user writes (scenes) and what the compiler sees of it (problems).

A scene file imports its names from this package:
``from codegen.scene import FieldScene, HamiltonianScene, param, signal``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy

if TYPE_CHECKING:
    from codegen.scene.parameters import Parameter as Parameter
    from codegen.scene.parameters import Signal as Signal
    from codegen.scene.scene import FieldScene as FieldScene
    from codegen.scene.scene import HamiltonianScene as HamiltonianScene
    from codegen.scene.scene import param as param
    from codegen.scene.scene import signal as signal

__all__ = ["FieldScene", "HamiltonianScene", "param", "signal"]

lazy(__name__, scene=("FieldScene", "HamiltonianScene", "param", "signal"))
