"""Taylor's method of degree P: each step evaluates the Taylor polynomial of the solution.

Recurrences compute the coefficients of the polynomial (automatic differentiation). The order of the method is
P for every vector field, so there are no order conditions.

Source: A. Jorba and M. Zou, *A software package for the numerical integration of ODEs by means of high-order
Taylor methods*, Experimental Mathematics 14 (2005) 99.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import factorial

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families.base import Family
from orderconds.families.registry import register
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.products import Method
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work

HIGHEST = 40
"""The highest degree P. The degree is limited, because the size of the emitted code grows like P^2."""


@register
class TaylorFamily(Family):
    """Taylor's method. ``degree`` is the degree P of the Taylor polynomial.

    >>> TaylorFamily(3).label(), TaylorFamily(3).degree_of_step()
    ('taylor(3)', 3)
    >>> TaylorFamily(3).stability_coefficients()
    (Fraction(1, 1), Fraction(1, 1), Fraction(1, 2), Fraction(1, 6))
    """

    name = "taylor"
    description = "Taylor polynomials of a given degree, such as taylor(12); the order is the degree."
    has_tableau = False
    controls_steps = True
    keeps_manifold = True
    source = "A. Jorba and M. Zou, Experimental Mathematics 14 (2005) 99, sections 2 and 3"

    def __init__(self, degree: int | None = None) -> None:
        if degree is not None and not 1 <= degree <= HIGHEST:
            raise InputError(
                f"the degree {degree}", where=f"family {self.name}", expected=f"a degree from 1 to {HIGHEST}"
            )
        self.degree = degree

    def label(self) -> str:
        """Return ``taylor(P)`` for the degree P. If no degree is given, return ``taylor``."""
        return self.name if self.degree is None else f"{self.name}({self.degree})"

    def degree_of_step(self) -> int:
        """Return the degree of the Taylor polynomial.

        Raises :class:`~orderconds.errors.InputError` if the family was created without a degree.
        """
        if self.degree is None:
            raise InputError(
                f"the family {self.name} has no degree", expected="a degree", hint="write taylor(12)"
            )
        return self.degree

    def stability_coefficients(self) -> tuple[Fraction, ...]:
        """Return the coefficients 1/k! of the stability function R(z) = sum_{k <= P} z^k/k!, where P is the
        degree."""
        return tuple(Fraction(1, factorial(k)) for k in range(self.degree_of_step() + 1))

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Raise :class:`~orderconds.errors.InputError`. The message explains why the family has no order
        conditions."""
        raise self._unconditional()

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Raise :class:`~orderconds.errors.InputError`. The message explains why the family has no order
        conditions."""
        raise self._unconditional()

    def read(self, tableau: Tableau) -> Method | None:
        """Raise :class:`~orderconds.errors.InputError`, because the family has no tableaux."""
        raise self._unconditional()

    def work(self, tableau: Tableau) -> Work | None:
        """Return None, because a step of Taylor's method evaluates recurrences and not the vector field."""
        return None

    def _unconditional(self) -> InputError:
        return InputError(
            f"family {self.name} has no tableau and no order conditions: "
            "a step of taylor(P) is the Taylor polynomial of degree P, so its order is P by construction",
            expected="a family with a tableau",
            hint="orderconds localerror SCENE -m 'taylor(8)' computes the order for a problem SCENE",
        )
