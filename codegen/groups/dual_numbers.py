"""Dual numbers a + a' e with e^2 = 0, whose components a and a' are scalars of any domain.

The value of a function f at a + a' e is f(a) + f'(a) a' e. The bracket of two vectors of dual numbers is
[x + u e, y + v e] = [x, y] + ([x, v] + [u, y]) e.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic

from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain, Scalar
from codegen.ir.number import Number


@dataclass(frozen=True)
class Dual(Generic[S]):
    """The dual number ``real`` + ``rate`` e, where e^2 = 0."""

    real: S
    rate: S

    def __add__(self, other: Dual[S]) -> Dual[S]:
        return Dual(self.real + other.real, self.rate + other.rate)

    def __sub__(self, other: Dual[S]) -> Dual[S]:
        return Dual(self.real - other.real, self.rate - other.rate)

    def __mul__(self, other: Dual[S]) -> Dual[S]:
        return Dual(self.real * other.real, self.real * other.rate + self.rate * other.real)

    def __truediv__(self, other: Dual[S]) -> Dual[S]:
        quotient = self.real / other.real
        return Dual(quotient, (self.rate - quotient * other.rate) / other.real)

    def __neg__(self) -> Dual[S]:
        return Dual(-self.real, -self.rate)


def duals(real: Vector[S], rate: Vector[S]) -> tuple[Dual[S], ...]:
    """Return the vector ``real`` + ``rate`` e of dual numbers, where e^2 = 0."""
    return tuple(Dual(a, b) for a, b in zip(real, rate, strict=True))


class DualDomain:
    """A domain (:mod:`codegen.ir.domain`) of dual numbers. The components of the dual numbers are scalars of
    ``domain``. Only arithmetic and Stumpff functions are implemented.
    """

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.zero: Scalar = domain.rational(0)
        self.h = Dual(domain.h, self.zero)

    def number(self, value: Number) -> Scalar:
        """Convert an exact number to the dual number ``value`` + 0 e."""
        return Dual(self.domain.number(value), self.zero)

    def rational(self, p: int, q: int = 1) -> Scalar:
        """Return the dual number p/q + 0 e."""
        return Dual(self.domain.rational(p, q), self.zero)

    def call(self, function: str, *args: Scalar) -> Scalar:
        """Return the value of the Stumpff function ``function`` at the dual number in ``args``.

        ArithmeticError is raised if ``function`` is not the name of a Stumpff function.
        """
        name, digit = function[:-1], function[-1:]
        if not (name.endswith("stumpff") and digit.isdecimal()):
            raise ArithmeticError(f"{function} has no formula for dual numbers; expected a Stumpff function")
        d, (x,), k = self.domain, args, int(digit)
        slope: Scalar
        if k == 0:
            slope = -(d.rational(1, 2) * d.call(f"{name}1", x.real))
        elif function == "stumpff1":
            slope = d.rational(1, 2) * (d.call("stumpff3", x.real) - d.call("stumpff2", x.real))
        else:
            slope = d.call(f"{name.removesuffix('stumpff')}slope{k}", x.real)
        return Dual(d.call(function, x.real), slope * x.rate)

    def vector(self, function: str, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Raise ArithmeticError, because vector functions of dual numbers are not implemented."""
        raise ArithmeticError(f"{function} has no formula for dual numbers; expected a Stumpff function")

    def settled(self, old: Sequence[Scalar], new: Sequence[Scalar], previous: Scalar) -> tuple[bool, Scalar]:
        """Raise ArithmeticError, because iterations with dual numbers are not supported."""
        raise ArithmeticError("iterations with dual numbers are not supported")
