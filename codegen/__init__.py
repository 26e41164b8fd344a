"""The compiler of integrators writes C or Python code for one step of a method.

A scene describes a differential equation on a manifold. The compiler translates a scene and a method to a
step program: the list of the operations of one step.

>>> import codegen
>>> integrator = codegen.load(codegen.emit("free_rigid_body", "cf4", target="python"))
>>> [round(x, 6) for x in integrator.run([0.6, 0.0, 0.8], h=0.1, steps=10)]
[0.511554, -0.443424, 0.735994]
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orderconds.lazy import lazy

if TYPE_CHECKING:
    from codegen.emitter import emit as emit
    from codegen.lab.efficiency.advice import recommend as recommend
    from codegen.lab.efficiency.measured import bench as bench
    from codegen.lab.orders.scene_convergence import converge as converge
    from codegen.loader import load as load
    from codegen.loader import load_lattice as load_lattice
    from codegen.loader import load_spectral as load_spectral

__all__ = ["bench", "converge", "emit", "load", "load_lattice", "load_spectral", "recommend"]

lazy(
    __name__,
    emitter=("emit",),
    loader=("load", "load_lattice", "load_spectral"),
    **{
        "lab.efficiency.advice": ("recommend",),
        "lab.efficiency.measured": ("bench",),
        "lab.orders.scene_convergence": ("converge",),
    },
)
