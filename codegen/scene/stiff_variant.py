"""Stiff variants of a scene, with a very short time scale or a solution near a singularity.

The file of a gallery scene may define a function ``stiff_variants()`` that returns a list of variants.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.scene.problem import Problem

RADIANS = 200
"""The largest angle, in radians, by which an undamped solution of a stiff variant rotates.

At larger angles, the phase error of explicit methods is too large to measure their order.
"""


@dataclass(frozen=True)
class StiffVariant:
    """A stiff variant of a scene.

    - ``name``: the name of the variant.
    - ``about``: a phrase that describes why the problem is stiff, for example "frequency 1e+03".
    - ``scene``: the problem.
    - ``rate``: the fastest rate of the problem, the reciprocal of its shortest time scale.
    """

    name: str
    about: str
    scene: Problem
    rate: float
