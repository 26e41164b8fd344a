"""A law of Lie groups as a pair of values, and the sample elements at which laws are compared."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from codegen.groups.base import LieGroup
from codegen.groups.linear_algebra import Vector
from codegen.ir.rounding_domain import RoundingDomain, Sized

DIGITS = 60
"""The number of decimal digits of the comparisons."""

EXACT = 20
"""The two sides of a law are equal if they differ by at most 10^-EXACT of their size, or by rounding."""

STEP, SLOPE = 10, 12
"""The step of difference quotients is 10^-STEP, and 10^-SLOPE is their tolerance.

The error of a difference quotient is about 10^-20, the square of the step.
"""

DEXPINV_ORDER = 8
"""The series of dexp^{-1} are compared up to this order."""

Element = Vector[Sized]


@dataclass(frozen=True)
class Law:
    """A law of groups: ``left`` and ``right`` are the values of its two sides, and ``text`` is the law.

    If the two sides differ, the method of the group with the name ``method`` is probably wrong. If ``slope``
    is true, one side is a difference quotient.
    """

    method: str
    text: str
    left: Element
    right: Element
    slope: bool = False


class Sample:
    """Elements x, y, z of the algebra, a covector mu, and elements g and k of ``group``.

    The components of x, y, z and mu are rational numbers that do not depend on the machine.
    """

    def __init__(self, group: LieGroup) -> None:
        self.group = group
        self.d = RoundingDomain(0, DIGITS)
        # Each numerator 2 (p^i mod q) - q is odd, so that no component is zero. The numerators of one vector
        # are distinct, because p is a primitive root of the prime q. The denominators bound the components.
        q, n = 101, group.dim
        self.x, self.y, self.z, self.mu = (
            tuple(self.d.rational(2 * pow(p, i, q) - q, 2 * (q + 10 * n)) for i in range(1, n + 1))
            for p in (2, 3, 7, 11)
        )

    @cached_property
    def g(self) -> Element:
        """The element exp(x) exp(y)."""
        return self.group.mul(self.d, self.exp(self.x), self.exp(self.y))

    @cached_property
    def k(self) -> Element:
        """The element exp(z) exp(x)."""
        return self.group.mul(self.d, self.exp(self.z), self.exp(self.x))

    @cached_property
    def e(self) -> Element:
        """The neutral element."""
        return self.group.identity(self.d)

    def exp(self, x: Element, factor: int = 1) -> Element:
        """Return exp(factor x)."""
        return self.group.exp(self.d, self.times(factor, x))

    def mul(self, *elements: Element) -> Element:
        """Return the product of group elements, evaluated from left to right."""
        total = elements[0]
        for g in elements[1:]:
            total = self.group.mul(self.d, total, g)
        return total

    def times(self, factor: int, x: Element) -> Element:
        """Return factor x."""
        scale = self.d.rational(factor)
        return tuple(scale * a for a in x)

    def slope(self, path: Callable[[Element], Element], x: Element) -> Element:
        """Return the derivative of path(eps x) at eps = 0, as a central difference."""
        eps = self.d.rational(1, 10**STEP)
        ends = [path(tuple(t * a for a in x)) for t in (eps, -eps)]
        return tuple((a - b) / (eps + eps) for a, b in zip(*ends, strict=True))
