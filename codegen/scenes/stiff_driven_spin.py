"""Stiff driven spin on the sphere: the equation of ``driven_spin`` with K = 2000 and alpha = 1/2.

The equation has the rates K = 2000 and alpha K = 1000, so explicit methods need steps of about 1/1000. But
the solution is slow: the spin follows the slowly rotating magnetic field.
"""

from dataclasses import replace

from sympy import Rational

from codegen.scene.stiff_variant import StiffVariant
from codegen.scenes.driven_spin import driven_spin

scene = driven_spin("Stiff driven spin on the sphere", 2000, Rational(1, 2), 100, 5)


def stiff_variants() -> list[StiffVariant]:
    """Return the scene itself as its only stiff variant."""
    named = replace(scene, name=__name__.rpartition(".")[2])
    return [StiffVariant("stiff driven spin", "rates 2000 and 1000", named, 2000.0)]
