"""Polynomials over Q in one variable, for iterated integrals over [0, 1].

The polynomials have python-flint's type ``fmpq_poly``, with the operators ``+ - *``. Python-flint always
prints the variable as x.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TypeAlias

from flint import fmpq_poly

UnivariatePolynomial: TypeAlias = fmpq_poly
"""A polynomial over Q in one variable."""

ZERO = fmpq_poly()
ONE = fmpq_poly([1])
VARIABLE = fmpq_poly([0, 1])


def integral_from_zero(f: UnivariatePolynomial) -> UnivariatePolynomial:
    """Return the integral of f from 0 to s, as a polynomial in s. The example prints s as x.

    >>> integral_from_zero(ONE)
    x
    """
    return f.integral()


def integral_to_one(f: UnivariatePolynomial) -> UnivariatePolynomial:
    """Return the integral of f from s to 1, as a polynomial in s. The example prints s as x.

    >>> integral_to_one(ONE)
    (-1)*x + 1
    """
    primitive = f.integral()
    return primitive(1) - primitive


def value_at_one(f: UnivariatePolynomial) -> Fraction:
    """Return f(1).

    >>> value_at_one(integral_from_zero(integral_from_zero(ONE)))
    Fraction(1, 2)
    """
    value = f(1)
    return Fraction(int(value.p), int(value.q))


def derivative(f: UnivariatePolynomial) -> UnivariatePolynomial:
    """Return the derivative of f.

    >>> derivative(VARIABLE * VARIABLE)
    2*x
    """
    return f.derivative()
