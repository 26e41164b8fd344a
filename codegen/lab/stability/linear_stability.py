"""Linear stability: the stability function of a tableau, and its stability intervals on the real and
imaginary axes.

If a Runge-Kutta method solves y' = lambda y, each step of size h multiplies y by R(h lambda). The function R
is the stability function of the method.

A Lie group method for y' = f(y).y, where f(y) is in the Lie algebra, is exact if f is constant. If f(y)
varies along the solution, the stability intervals of the tableau limit the step size.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from codegen.method import Method
from orderconds.errors import InputError
from orderconds.families import get
from orderconds.ring import QQ
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau import Tableau
from orderconds.tableau.stability import Undecided, determinants, stability_function
from orderconds.tableau.stability_intervals import (
    Intervals,
    Vanishing,
    stability_intervals,
    vanishing_coefficients,
)


@dataclass(frozen=True)
class Quotient:
    """A rational function of a complex number z, with the coefficients in ascending powers of z."""

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]

    def __call__(self, z: complex) -> complex:
        """Return the value at z, or infinity if the denominator is zero."""
        top, bottom = (_horner(row, z) for row in (self.numerator, self.denominator))
        return top / bottom if bottom else complex("inf")


@dataclass(frozen=True)
class Region:
    """The stability function of a method, and its stability intervals.

    ``label`` is the name of the method, and ``value`` is the stability function R in double precision. On a
    stability interval, which begins at zero, |R(z)| <= 1. ``real`` and ``imaginary`` are the lengths of the
    largest intervals on the negative real and the positive imaginary axis. They are computed from the exact
    coefficients: a length is infinite only if this is proved, and None if it is undecided
    (:class:`~orderconds.tableau.stability_intervals.Intervals`).
    """

    label: str
    value: Callable[[complex], complex]
    real: float | None
    imaginary: float | None

    def as_json(self) -> dict[str, object]:
        """Return plain data, which can be written as JSON.

        If the length of a stability interval is infinite or undecided, the length becomes None. The value of
        the key ``undecided`` lists the axes (``real`` or ``imaginary``) on which the length is undecided.
        """
        lengths = {"real": self.real, "imaginary": self.imaginary}
        known = {axis: None if length == float("inf") else length for axis, length in lengths.items()}
        return {**known, UNDECIDED: [axis for axis, length in lengths.items() if length is None]}


UNDECIDED = "undecided"
"""The text for the length of a stability interval if the length is not known.

In the result of :meth:`Region.as_json`, UNDECIDED is also a key. The value of this key is the list of the
axes (``real`` or ``imaginary``) on which the length is not known.
"""


def interval(length: float | None, digits: int = 4) -> str:
    """Return the length of a stability interval as a text with ``digits`` significant digits.

    >>> interval(2.0), interval(float("inf")), interval(0.0), interval(None)
    ('2', 'unbounded', 'none', 'undecided')
    """
    if length is None:
        return UNDECIDED
    return "unbounded" if length == float("inf") else f"{length:.{digits}g}" if length else "none"


def region(method: Method) -> Region | None:
    """Return the stability function and the stability intervals of the tableau of a method.

    The result is None if the stability function is not known, for example for splitting methods.
    """
    known = get(method.family_label).stability_coefficients()
    if known is not None:
        P, Q = [QQ.rational(x.numerator, x.denominator) for x in known], [QQ.one]
        lengths = stability_intervals(P, Q, QQ)
        return Region(method.label, _quotient(P, Q, QQ), lengths.real, lengths.imaginary)
    try:
        tableau = method.tableau
        lengths = _intervals(tableau)
        value = _value(tableau)
    except (InputError, TypeError, ValueError, ArithmeticError, AttributeError):
        return None
    return Region(method.label, value, lengths.real, lengths.imaginary)


def _intervals(tableau: Tableau) -> Intervals:
    P, Q = determinants(tableau.abelian(), tableau.ring)
    return stability_intervals(P, Q, tableau.ring, _proved_order(tableau), _identities(tableau))


def _proved_order(tableau: Tableau) -> int:
    """Return a proved lower bound of the order on vector spaces, or 0 if the tableau has no valid proof."""
    if tableau.proof is None:
        return 0
    from orderconds.proof.certificate import certify
    from orderconds.proof.implications import least_order
    from orderconds.proof.krawczyk import NotProved

    try:
        return least_order(certify(tableau).facts, get("rk"))
    except NotProved:
        return 0


def _identities(tableau: Tableau) -> Vanishing:
    """Return which coefficients of |Q|^2 - |P|^2 are zero, where P/Q is the stability function.

    On the negative real axis and on the imaginary axis, |Q|^2 - |P|^2 is a polynomial (:class:`Vanishing`).
    If the tableau file contains no equations for the exact tableau (the table ``[proof]``), no coefficient
    counts as zero. Otherwise, the function replaces the rounded decimals and the radicals in the tableau by
    random numbers that satisfy these equations. If a coefficient is zero for the random numbers, it counts as
    zero for the exact tableau. The probability of a wrong result is negligible
    (:mod:`orderconds.tableau.random_member`).
    """
    if tableau.proof is None:
        return Vanishing()
    from orderconds.tableau.random_member import OUTSIDE, RandomMember

    ring = RandomMember(tableau.proof.symbolic)
    try:
        drawn = replace(tableau, method=ring.method(), ring=ring)
        return vanishing_coefficients(*determinants(drawn.abelian(), ring), ring)
    except OUTSIDE:
        return Vanishing()


def _value(tableau: Tableau) -> Quotient:
    """Return the stability function in double precision.

    Common factors of the numerator and the denominator are removed, with one exception. If coefficients of
    the tableau are balls (intervals), and a ball contains zero and other numbers, common factors can remain.
    """
    method, ring = tableau.abelian(), tableau.ring
    try:
        R = stability_function(method, ring)
    except Undecided:
        return _quotient(*determinants(method, ring), ring)
    return _quotient(R.numerator, R.denominator, ring)


def _quotient(P: Sequence[Element], Q: Sequence[Element], ring: Ring) -> Quotient:
    top, bottom = (tuple(float(ring.approximate(x, 20)) for x in p) for p in (P, Q))
    return Quotient(top, bottom)


def _horner(row: Sequence[float], z: complex) -> complex:
    total = 0j
    for c in reversed(row):
        total = total * z + c
    return total
