"""SE(3): the rigid motions of space."""

from __future__ import annotations

from codegen.groups.base import LieGroup
from codegen.groups.representations import AlgebraVectors
from codegen.groups.semidirect import Semidirect
from codegen.groups.so3 import SO3


class SE3(Semidirect):
    """Motions z -> R z + a of space. An element of the group is stored as the rotation matrix R, row by row,
    and then the translation a.

    An element of the algebra is (w, u): the angular velocity w, and the velocity u of the point at the
    origin. An element of the dual is (m, p): the angular momentum m about the origin, and the linear momentum
    p.

    - The bracket is [(w, u), (w', u')] = (w cross w', w cross u' - w' cross u).
    - The exponential is exp(w, u) = (exp w, dexp_w u).
    - A function of ad_(w, u) is computed with dual numbers: w is replaced by w + e u, where e^2 = 0.

    An element of ``SE3(SU2())`` has a unit quaternion in place of R.
    """

    covering_formula = f"{SO3.covering_formula}; the position is copied"

    def __init__(self, attitude: LieGroup | None = None) -> None:
        attitude = SO3() if attitude is None else attitude
        named = attitude.name == SO3.name
        super().__init__(attitude, AlgebraVectors(), "SE(3)" if named else f"SE(3) over {attitude.name}")
        self.layout = f": the attitude in {attitude.name}{attitude.layout}, then the position"

    def with_linear(self, linear: LieGroup) -> SE3:
        """Return the form of SE(3) in which elements of the group ``linear`` represent the rotations."""
        return SE3(linear)
