"""Scenes and problems.

A scene is the description of a differential equation by a user. The compiler converts each scene to a
problem, its internal form.

A scene file imports names from this package, for example
``from codegen.scene import FieldScene, HamiltonianScene, LinearScene, param, signal, table``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy

if TYPE_CHECKING:
    from codegen.scene.bonds import Bond as Bond
    from codegen.scene.derivative import Dx as Dx
    from codegen.scene.field_scene import FieldScene as FieldScene
    from codegen.scene.hamiltonian_scene import HamiltonianScene as HamiltonianScene
    from codegen.scene.hamiltonian_sites import HamiltonianSiteScene as HamiltonianSiteScene
    from codegen.scene.large_linear_scene import LargeLinearScene as LargeLinearScene
    from codegen.scene.linear_scene import LinearScene as LinearScene
    from codegen.scene.matrix_formula import banded as banded
    from codegen.scene.matrix_formula import full as full
    from codegen.scene.matrix_formula import unknown as unknown
    from codegen.scene.parameters import Parameter as Parameter
    from codegen.scene.parameters import Signal as Signal
    from codegen.scene.parameters import param as param
    from codegen.scene.parameters import signal as signal
    from codegen.scene.problem import Problem as Problem
    from codegen.scene.semilinear_scene import SemilinearScene as SemilinearScene
    from codegen.scene.site_parts import Pair as Pair
    from codegen.scene.site_scene import SiteScene as SiteScene
    from codegen.scene.sites import left as left
    from codegen.scene.sites import neighbour as neighbour
    from codegen.scene.sites import right as right
    from codegen.scene.stiefel_scene import StiefelScene as StiefelScene
    from codegen.scene.tables import table as table

__all__ = [
    "Bond",
    "Dx",
    "FieldScene",
    "HamiltonianScene",
    "HamiltonianSiteScene",
    "LargeLinearScene",
    "LinearScene",
    "Pair",
    "Problem",
    "SemilinearScene",
    "SiteScene",
    "StiefelScene",
    "banded",
    "full",
    "left",
    "neighbour",
    "param",
    "right",
    "signal",
    "table",
    "unknown",
]

lazy(
    __name__,
    bonds=("Bond",),
    derivative=("Dx",),
    field_scene=("FieldScene",),
    hamiltonian_scene=("HamiltonianScene",),
    hamiltonian_sites=("HamiltonianSiteScene",),
    large_linear_scene=("LargeLinearScene",),
    linear_scene=("LinearScene",),
    matrix_formula=("banded", "full", "unknown"),
    parameters=("Parameter", "Signal", "param", "signal"),
    problem=("Problem",),
    semilinear_scene=("SemilinearScene",),
    site_parts=("Pair",),
    site_scene=("SiteScene",),
    sites=("left", "neighbour", "right"),
    stiefel_scene=("StiefelScene",),
    tables=("table",),
)
