"""Values of step programs: their kinds, their names, and coefficients of linear combinations."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from codegen.ir.domain import Domain, Scalar
from codegen.ir.number import Number


# The dual of the algebra is a separate kind, because Ad and Ad* differ.
class Kind(StrEnum):
    """The space that contains a value.

    The spaces are the real numbers, the Lie algebra (``Alg``), its dual, the group, and the manifold
    (``Point``).
    """

    REAL = "Real"
    ALG = "Alg"
    DUAL = "Dual"
    GROUP = "Group"
    POINT = "Point"


@dataclass(frozen=True)
class Var:
    """A named value. Names are unique within a program."""

    name: str
    kind: Kind


@dataclass(frozen=True)
class Coefficient:
    """The coefficient ``value`` * h**``power`` of a linear combination."""

    value: Number
    power: int = 0

    # A ball that contains 0 or 1 may represent another number, so ``is_zero`` and ``is_one`` require a proof.
    @property
    def is_zero(self) -> bool:
        """True if the coefficient is provably zero."""
        return self.value.is_zero

    @property
    def is_one(self) -> bool:
        """True if this is provably the constant 1, without a power of h."""
        return self.power == 0 and self.value.is_one

    def text(self) -> str:
        """Return the coefficient as text, for example ``1/2 h``."""
        # The first power of h is printed without an exponent.
        h = "" if self.power == 0 else " h" if self.power == 1 else f" h^{self.power}"
        return f"{self.value.text()}{h}"

    def evaluate(self, domain: Domain) -> Scalar:
        """Return the value of the coefficient in a domain."""
        value = domain.number(self.value)
        # The scalar h^p c is computed first, so that terms with equal coefficients can share it.
        for _ in range(self.power):
            value = domain.h * value
        return value


ONE = Coefficient(Number.rational(1))
MINUS_ONE = Coefficient(Number.rational(-1))
