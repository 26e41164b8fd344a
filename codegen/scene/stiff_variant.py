"""Stiff variants of a scene: the same problem with a very short time scale, or near a singularity.

The file of a gallery scene may define the function ``stiff_variants()``, which returns a list of variants.
``orderconds stability`` measures the order of methods on each variant.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.scene.problem import Problem

RADIANS = 200
"""The largest angle, in radians, of the fastest undamped rotation in a stiff variant during its time span.

For angles above a few hundred radians the phase error hides the order of every explicit method.
"""


@dataclass(frozen=True)
class StiffVariant:
    """A stiff variant of a scene.

    - ``name``: the name of the variant.
    - ``about``: a phrase that describes why the problem is stiff, such as "frequency 1e+03".
    - ``scene``: the problem.
    - ``rate``: the fastest rate of the problem, the reciprocal of its shortest time scale.
    """

    name: str
    about: str
    scene: Problem
    rate: float
