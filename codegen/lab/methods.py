"""Which families a scene can take, in the order of preference when a method names none."""

from __future__ import annotations

from codegen.lower import LOWERINGS, ON_COTANGENT
from codegen.method import Method, parse
from codegen.scene import Setting


def families_for(scene: Setting) -> tuple[str, ...]:
    """Return the families that can be lowered onto a scene, in the order of :data:`LOWERINGS`.

    ``rk`` needs R^n; the variational ones need a Hamiltonian.
    """
    abelian = scene.as_field().group.abelian
    return tuple(
        f for f in LOWERINGS if (f != "rk" or abelian) and (f not in ON_COTANGENT or scene.is_hamiltonian)
    )


def parse_for(scene: Setting, spelling: str) -> Method:
    """Return the method of that spelling among those the scene can take."""
    return parse(spelling, families_for(scene))
