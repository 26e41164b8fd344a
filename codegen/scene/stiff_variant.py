"""Stiff variants of a scene: the same problem with a very short time scale, or near a singularity.

A scene file may define the function ``stiff_variants()``, which returns a list of variants. ``orderconds
stability`` measures the order of methods on each variant.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.scene.problem import Problem

RADIANS = 200
"""The largest angle, in radians, by which the fastest undamped rotation of a variant may turn during the time
span.

For angles above a few hundred radians the phase error hides the order of every explicit method.
"""


@dataclass(frozen=True)
class StiffVariant:
    """A stiff variant of a scene.

    - ``name``: the name of the variant.
    - ``about``: a phrase that describes the stiff feature.
    - ``scene``: the problem.
    - ``rate``: the fastest rate of the problem in 1/time.
    """

    name: str
    about: str
    scene: Problem
    rate: float
