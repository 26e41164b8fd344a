"""SE_2(3): the extended poses of a vehicle, with attitude, velocity and position."""

from __future__ import annotations

from codegen.groups.base import LieGroup
from codegen.groups.representations import AlgebraVectors
from codegen.groups.semidirect import Semidirect
from codegen.groups.so3 import SO3


class SE23(Semidirect):
    """Extended poses (R, v, p): attitude R (row by row), velocity v and position p.

    An element of the algebra is (w, a, u), where w is the angular velocity. The vectors a = dv/dt and
    u = dp/dt are derivatives at the identity.

    - The product is (R, v, p)(R', v', p') = (R R', v + R v', p + R p').
    - The exponential is exp(w, a, u) = (exp w, dexp_w a, dexp_w u).
    - The matrix of an extended pose is [[R, v, p], [0, 1, 0], [0, 0, 1]] (A. Barrau and S. Bonnabel, IEEE
      Transactions on Automatic Control 62 (2017), 1797-1812).
    """

    covering_formula = f"{SO3.covering_formula}; the velocity and the position are copied"

    def __init__(self, attitude: LieGroup | None = None) -> None:
        attitude = SO3() if attitude is None else attitude
        named = attitude.name == SO3.name
        name = "SE_2(3)" if named else f"SE_2(3) over {attitude.name}"
        super().__init__(attitude, AlgebraVectors(2), name)
        self.layout = f": attitude in {attitude.name}{attitude.layout}; velocity; position"

    def with_linear(self, linear: LieGroup) -> SE23:
        """Return SE_2(3) with the attitude in the group ``linear``."""
        return SE23(linear)
