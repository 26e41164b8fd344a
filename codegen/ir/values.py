"""The variables of step programs, the spaces that contain their values, and the coefficients of linear
combinations. A step program (:mod:`codegen.ir.program`) is the list of assignments that computes one step.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from codegen.ir.domain import Domain, Scalar
from codegen.ir.number import Number


# The Lie algebra and its dual are different kinds, because they have different operations.
class Kind(StrEnum):
    """The space that contains a value.

    The spaces are the real numbers (``Real``), the Lie algebra (``Alg``), its dual (``Dual``), the Lie group
    (``Group``), and the manifold on which the group acts (``Point``).
    """

    REAL = "Real"
    ALG = "Alg"
    DUAL = "Dual"
    GROUP = "Group"
    POINT = "Point"


@dataclass(frozen=True)
class Var:
    """A variable of a step program. ``kind`` is the space that contains its value. Each name in a program
    belongs to only one variable.
    """

    name: str
    kind: Kind


@dataclass(frozen=True)
class Coefficient:
    """The coefficient ``value`` * h**``power`` of a linear combination."""

    value: Number
    power: int = 0

    # ``is_zero`` is False if the program cannot decide whether ``value`` is 0. In the same way, ``is_one`` is
    # False if the program cannot decide whether ``value`` is 1.
    @property
    def is_zero(self) -> bool:
        """True if the coefficient is provably zero."""
        return self.value.is_zero

    @property
    def is_one(self) -> bool:
        """True if ``value`` is provably 1 and ``power`` is 0."""
        return self.power == 0 and self.value.is_one

    def text(self) -> str:
        """Return the coefficient as text, for example ``1/2 h``."""
        # The first power of h is printed without an exponent.
        h = "" if self.power == 0 else " h" if self.power == 1 else f" h^{self.power}"
        return f"{self.value.text()}{h}"

    def evaluate(self, domain: Domain) -> Scalar:
        """Return the coefficient as a scalar of ``domain``, for example as a double or a power series."""
        value = domain.number(self.value)
        # The loop computes ``value`` h^``power``. The emitted code computes this product only once for all
        # terms with the same ``value`` and the same ``power``.
        for _ in range(self.power):
            value = domain.h * value
        return value


ONE = Coefficient(Number.rational(1))
MINUS_ONE = Coefficient(Number.rational(-1))
