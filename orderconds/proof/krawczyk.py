"""Krawczyk's operator. With ball arithmetic, it proves that a square system has exactly one zero in a box.

Let F: R^n -> R^n, let X be a box with midpoint x, and let Y be an approximate inverse of the Jacobian matrix
at x. Krawczyk's operator K is

    K(X) = x - Y F(x) + (I - Y F'(X)) (X - x).

Here I is the identity matrix, and F'(X) is a ball matrix that contains the Jacobian matrix of F at every
point of X. If K(X) lies in the interior of X, then F has exactly one zero in X. The zero lies in K(X)
(Krawczyk 1969; Neumaier, *Interval Methods for Systems of Equations*, Theorem 5.1.8).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import arb, arb_mat

from orderconds.ring.jets import Jet, Jets
from orderconds.ring.precision import precision

System = Callable[[Sequence[Jet], Jets], Sequence[Jet]]
"""A system of n functions of n variables. The first argument contains one jet (a value with its gradient) for
each variable. The second argument is the ring of the jets."""

MAX_SWEEPS = 40


class NotProved(Exception):
    """The error that is raised if a proof fails. The message states the reason."""


def enclose(system: System, box: Sequence[arb], bits: int) -> tuple[arb, ...]:
    """Return balls that enclose the only zero of ``system`` in ``box``.

    An iteration with a precision of ``bits`` bits reduces the radii of the balls. Raises :class:`NotProved`
    if Krawczyk's operator does not map the box into the interior of the box.

    >>> with precision(128):
    ...     (root,) = enclose(lambda x, ring: [x[0] * x[0] - 2], [arb(1.4142, 1e-3)], 128)
    ...     bool((root - arb(2).sqrt()).contains(0)), bool(root.rad() < 1e-30)
    (True, True)
    """
    with precision(bits):
        image = _image(system, box)
        for i, (inner, outer) in enumerate(zip(image, box, strict=True)):
            if not outer.contains_interior(inner):
                raise NotProved(
                    f"Krawczyk's operator does not map the box into itself: for unknown number {i + 1}, the "
                    f"box has the interval {outer.str(12)} and the image has the interval {inner.str(12)}"
                )
        for _ in range(MAX_SWEEPS):
            sharper = [x.intersection(y) for x, y in zip(image, _image(system, image), strict=True)]
            if not any(2 * y.rad() < x.rad() for x, y in zip(image, sharper, strict=True)):
                return tuple(sharper)
            image = sharper
        return tuple(image)


def _image(system: System, box: Sequence[arb]) -> list[arb]:
    """Return the value of Krawczyk's operator for a box. Raise :class:`NotProved` if the system is not
    square, or if the Jacobian at the midpoint is singular."""
    middle = [x.mid() for x in box]
    at_middle = jets(system, middle)
    over_box = jets(system, box)
    n = len(box)
    if len(over_box) != n:
        raise NotProved(f"{len(over_box)} equations for {n} unknowns")
    Y = inverse(_jacobian(at_middle))
    contraction = _identity(n) - Y * _jacobian(over_box)
    shift = Y * arb_mat(n, 1, [f.value for f in at_middle])
    spread = contraction * arb_mat(n, 1, [x - m for x, m in zip(box, middle, strict=True)])
    return [m - shift[i, 0] + spread[i, 0] for i, m in enumerate(middle)]


def jets(system: System, point: Sequence[arb]) -> Sequence[Jet]:
    """Return the values and gradients of the equations at ``point``. If the entries of ``point`` are
    balls with positive radii, the results enclose the values and gradients at all points in these balls.

    >>> (square,) = jets(lambda x, ring: [x[0] * x[0]], [arb(3)])
    >>> square.value == 9, [x == 6 for x in square.gradient]
    (True, [True])
    """
    ring = Jets(len(point))
    return system([ring.variable(i, x) for i, x in enumerate(point)], ring)


def inverse(matrix: arb_mat) -> arb_mat:
    """Return an approximate inverse of a square matrix of balls. The entries of the result have radius zero.

    Raises :class:`NotProved` if the balls may contain a singular matrix.

    >>> inverse(arb_mat(1, 1, [4]))[0, 0] == 0.25
    True
    """
    try:
        inverted = matrix.inv()
    except ZeroDivisionError:
        raise NotProved(
            "the Jacobian of the equations is singular at the decimal values of the unknowns"
        ) from None
    return inverted.mid()


def _jacobian(values: Sequence[Jet]) -> arb_mat:
    return arb_mat(len(values), len(values[0].gradient), [g for f in values for g in f.gradient])


def _identity(n: int) -> arb_mat:
    return arb_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])
