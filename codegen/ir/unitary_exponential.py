"""The exponential of a matrix of su(3) by the Cayley-Hamilton theorem.

Let X = i H with a Hermitian 3 x 3 matrix H of trace zero, and let I be the unit matrix. Then H^3 = p H + q I,
where p = tr(H^2)/2 and q = det H. Hence exp X is a linear combination of I, H and H^2. In the Taylor
polynomial of exp X, the formula for H^3 eliminates the powers H^3, H^4, .... No step divides by differences
of eigenvalues (M. Luescher, SU(3) matrix functions, notes of openQCD).

All eigenvalues of H are bounded by 2 (p/3)^(1/2) in absolute value. If this bound is large, the Taylor
polynomial is evaluated for X/2^s instead of X. The matrix exp(X/2^s) is then squared s times.

Let E_jk be the matrix with the entry 1 at (j, k) and zeros elsewhere. The first six coordinates of X belong
to the pairs (j, k) = (1, 2), (1, 3), (2, 3). The two coordinates of a pair are the coefficients of
E_jk - E_kj and i (E_jk + E_kj). The last two coordinates are the coefficients of i (E_11 - E_22) and
i (E_22 - E_33).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from codegen.ir.matrix_exponential import DEGREES, LEAST_DIGITS, largest_norms
from codegen.ir.matrix_functions import MatrixExponential
from codegen.ir.vector_function import VectorFunction

if TYPE_CHECKING:
    from codegen.ir.domain import Scalar
    from codegen.ir.expr import Expr

T = TypeVar("T")

ROWS, COORDINATES = 3, 8
SIZE = ROWS * ROWS
"""The number of entries of the matrix exp X. The results of :class:`SpecialUnitaryExponential` are the real
parts of all entries, followed by the imaginary parts.
"""

PLACES = ((0, 1), (0, 2), (1, 2))
"""The indices (j, k) of the entries above the diagonal of a 3 x 3 matrix, row by row."""

GENERAL = MatrixExponential(2 * ROWS)
"""The exponential of a 6 x 6 matrix. The entries are mpmath numbers or power series."""


def most_squarings(bits: int) -> int:
    """Return the largest allowed number of squarings in the scaling and squaring method.

    Let 2^-``bits`` be the unit roundoff. For s squarings, the relative error is at most
    2^(s - ``bits`` + 6). This bound must not exceed 2^-10, so that about three decimal digits are correct.

    >>> most_squarings(53)
    37
    """
    return bits - LEAST_DIGITS - 6


@dataclass(frozen=True)
class SpecialUnitaryExponential(VectorFunction):
    """The exponential of a matrix X of su(3). The arguments are the eight coordinates of X. The module
    docstring defines these coordinates.
    """

    n: int = ROWS

    @property
    def name(self) -> str:
        """The name of the function in expressions and in emitted code."""
        return f"expsu{self.n}"

    @property
    def size(self) -> int:
        """The number of results of the function."""
        return 2 * SIZE

    @property
    def arrays(self) -> tuple[int, ...]:
        """The lengths of the argument arrays. The only array contains the eight coordinates of X."""
        return (COORDINATES,)

    @property
    def operations(self) -> dict[str, int]:
        """The numbers of additions and multiplications in a call with Taylor degree 12 and no squarings."""
        return {"add": 110, "mul": 120}

    def tangent(self, args: Sequence[Expr], rates: Sequence[Expr]) -> tuple[Expr, ...]:
        """Return the derivatives of the real parts and of the imaginary parts of all entries of exp X.

        ``args`` are the coordinates of X, and ``rates`` are their derivatives.
        """
        zero = args[0].space.zero
        # Since ``embedded`` is linear, ``embedded(rates, zero)`` contains the derivatives of the matrix
        # entries.
        both = (*embedded(args, zero), *embedded(rates, zero))
        # ``MatrixExponential(n, 1)`` returns the entries of the exponential, then the entries of its first
        # derivative.
        general = MatrixExponential(2 * ROWS, 1)
        slopes = args[0].space.vector(general.name, both)
        return first_columns(slopes[GENERAL.size :])

    def expanded(self, args: Sequence[Expr]) -> tuple[Expr, ...] | None:
        """Return the unit matrix if all coordinates are zero, otherwise None."""
        if not all(x.is_zero for x in args):
            return None
        space = args[0].space
        return tuple(space.one if k in range(0, SIZE, ROWS + 1) else space.zero for k in range(2 * SIZE))

    def in_doubles(self, args: Sequence[float]) -> tuple[float, ...]:
        """Return the exponential in doubles, computed by the same operations as in emitted code."""
        return in_doubles(args)

    def in_digits(self, context: Any, digits: int, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exponential in mpmath numbers of ``context``, correct to about ``digits`` digits."""
        return first_columns(GENERAL.in_digits(context, digits, embedded(args, context.mpf(0))))

    def over_series(self, ring: Any, args: Sequence[Scalar]) -> tuple[Scalar, ...]:
        """Return the exponential for power series. The constant terms of all coordinates must be zero."""
        return first_columns(GENERAL.over_series(ring, embedded(args, ring.zero)))


def embedded(x: Sequence[T], zero: T) -> tuple[T, ...]:
    """Return the real 6 x 6 matrix with the block rows (A, -B) and (B, A), row by row.

    A and B are real matrices, and A + i B is the matrix X with the coordinates ``x``.
    """
    width = 2 * ROWS
    result = [zero] * width**2

    def put(i: int, j: int, real: T, imaginary: T) -> None:
        # The matrix has the block rows (A, -B) and (B, A). The arguments are the entries A_ij = ``real`` and
        # B_ij = ``imaginary``.
        result[width * i + j] = result[width * (ROWS + i) + ROWS + j] = real
        result[width * (ROWS + i) + j] = imaginary
        result[width * i + ROWS + j] = -imaginary  # type: ignore[operator]

    for (j, k), a, b in zip(PLACES, x[0:6:2], x[1:6:2], strict=True):
        # The entry (k, j) of X is minus the complex conjugate of the entry (j, k).
        put(j, k, a, b)
        put(k, j, -a, b)  # type: ignore[operator]
    # The diagonal entries of X are imaginary, because X is skew-Hermitian.
    for j, b in enumerate((x[6], x[7] - x[6], -x[7])):  # type: ignore[operator]
        put(j, j, zero, b)
    return tuple(result)


def first_columns(matrix: Sequence[T]) -> tuple[T, ...]:
    """Return the entries of A, then the entries of B, for a matrix with the block rows (A, -B) and (B, A)."""
    width = 2 * ROWS
    return tuple(matrix[width * i + j] for i in range(width) for j in range(ROWS))


def in_doubles(x: Sequence[float]) -> tuple[float, ...]:
    """Return the exponential of the matrix with the coordinates ``x``.

    If the norm of the matrix is too large (:func:`most_squarings`), all results are NaN.
    """
    scale, squarings, norm = _halvings(_bound(x))
    total = _polynomial([a * scale for a in x], norm)
    # The matrix exp(X) is the square of exp(X/2), because X commutes with itself.
    for _ in range(squarings):
        total = _square(total)
    # The condition ``not norm <= ...`` is also true if ``norm`` is NaN.
    if not norm <= largest_norms(53)[-1]:
        total = [math.nan] * len(total)
    return tuple(total)


def _bound(x: Sequence[float]) -> float:
    """Return an upper bound of the absolute values of the eigenvalues of a Hermitian matrix H of trace zero.

    ``x`` are the coordinates of the matrix X = i H, where i is the imaginary unit.
    """
    # Let p be ``half_trace(x)``, and q = det H. Each eigenvalue z of H satisfies z^3 = p z + q. By the
    # trigonometric formula for this equation, z is (4 p/3)^(1/2) times a cosine.
    return math.sqrt(1.3333333333333333 * half_trace(x))


def _halvings(norm: float) -> tuple[float, int, float]:
    """Return the scale 2^-s, the number s of halvings, and the bound of the norm of the scaled matrix.

    ``norm`` is the bound before scaling.
    """
    scale, squarings = 1.0, 0
    # A NaN is not larger than the bound, so a NaN causes no halvings.
    while norm * scale > largest_norms(53)[-1] and squarings < most_squarings(53):
        scale *= 0.5
        squarings += 1
    return scale, squarings, norm * scale


def half_trace(x: Sequence[Any]) -> Any:
    """Return p = tr(H^2)/2 for the matrix i H with the coordinates ``x``."""
    # The diagonal of H is (x_6, x_7 - x_6, -x_7).
    total = x[6] * x[6] + x[7] * (x[7] - x[6])
    for a in x[:6]:
        total = total + a * a
    return total


def determinant(x: Sequence[Any]) -> Any:
    """Return q = det H, where ``x`` are the coordinates of X = i H."""
    a, b, c, d, e, f = x[:6]
    first, last = x[6], -x[7]
    middle = x[7] - x[6]
    # ``product`` is the real part of H_12 H_23 H_31.
    product = (b * f - a * e) * d + (a * f + b * e) * c
    # With the diagonal entries d_j of H, the determinant of H is
    # 2 ``product`` + d_1 d_2 d_3 - d_1 |H_23|^2 - d_2 |H_13|^2 - d_3 |H_12|^2.
    diagonal = first * (middle * last - (e * e + f * f)) - middle * (c * c + d * d)
    return (product + product) + (diagonal - last * (a * a + b * b))


def square_of_hermitian(x: Sequence[Any]) -> tuple[Any, ...]:
    """Return the diagonal of H^2, then the real and the imaginary part of each entry above the diagonal.

    ``x`` are the coordinates of the matrix i H.
    """
    a, b, c, d, e, f = x[:6]
    first, last = x[6], -x[7]
    middle = x[7] - x[6]
    # ``ab``, ``cd`` and ``ef`` are |H_12|^2, |H_13|^2 and |H_23|^2.
    ab, cd, ef = a * a + b * b, c * c + d * d, e * e + f * f
    # The trace of H is zero, so the sum of two diagonal entries of H is minus the remaining diagonal entry.
    return (
        *(first * first + (ab + cd), middle * middle + (ab + ef), last * last + (cd + ef)),
        *((d * f + c * e) - last * b, last * a + (d * e - c * f)),
        *((b * f - a * e) - middle * d, middle * c - (b * e + a * f)),
        *((b * d + a * c) - first * f, first * e + (a * d - b * c)),
    )


def combined(x: Sequence[Any], square: Sequence[Any], u: Sequence[Any], v: Sequence[Any]) -> list[Any]:
    """Return the matrix (u_0 I + u_1 H + u_2 H^2) + i (v_0 I + v_1 H + v_2 H^2), where I is the unit matrix.

    The result contains the real parts of all entries, then the imaginary parts. ``x`` are the coordinates of
    the matrix i H, and ``square`` is the result of :func:`square_of_hermitian`.
    """
    real, imaginary = [None] * SIZE, [None] * SIZE
    for j, h in enumerate((x[6], x[7] - x[6], -x[7])):
        real[(ROWS + 1) * j] = (u[2] * square[j] + u[1] * h) + u[0]
        imaginary[(ROWS + 1) * j] = (v[2] * square[j] + v[1] * h) + v[0]
    for m, (j, k) in enumerate(PLACES):
        a, b, re, im = x[2 * m], x[2 * m + 1], square[ROWS + 2 * m], square[ROWS + 2 * m + 1]
        # The entry (j, k) of H is b - i a, and the entry (j, k) of H^2 is re + i im.
        p, q = u[2] * re + u[1] * b, u[2] * im - u[1] * a
        r, s = v[2] * re + v[1] * b, v[2] * im - v[1] * a
        # Let U = u_0 I + u_1 H + u_2 H^2 and V = v_0 I + v_1 H + v_2 H^2. The entry (j, k) of U is p + i q,
        # and the entry (j, k) of V is r + i s. Both matrices are Hermitian. Therefore the entry (k, j) of U
        # is p - i q, and the entry (k, j) of V is r - i s. The two lines below store the entries (j, k) and
        # (k, j) of U + i V.
        real[ROWS * j + k], imaginary[ROWS * j + k] = p - s, q + r
        real[ROWS * k + j], imaginary[ROWS * k + j] = p + s, r - q
    return [*real, *imaginary]


def _polynomial(y: list[float], norm: float) -> list[float]:
    """Return a Taylor polynomial of exp X for the matrix X with the coordinates ``y``.

    ``norm`` is an upper bound of the norm of X.
    """
    groups = 1 + sum(norm > bound for bound in largest_norms(53)[:-1])
    c = [1 / math.factorial(k) for k in range(DEGREES[-1] + 1)]
    p, q = half_trace(y), determinant(y)
    # The degree n is a multiple of 4, so the leading coefficient i^n/n! equals 1/n!.
    parts = [c[4 * groups], 0.0, 0.0], [0.0, 0.0, 0.0]
    for group in reversed(range(groups)):
        for k in (3, 2, 1, 0):
            # In the term i^n H^n/n! of degree n = 4 * ``group`` + k, the factor i^n equals i^k.
            added = (0.0, c[4 * group + k]) if k % 2 else (c[4 * group + k], 0.0)
            for part, term in zip(parts, added, strict=True):
                # The powers i^2 and i^3 are -1 and -i, so both have a minus sign.
                signed = -term if k >= 2 else term
                # Since H^3 = p H + q I, the product of H and a I + b H + c H^2 is
                # q c I + (a + p c) H + b H^2.
                part[:] = signed + q * part[2], part[0] + p * part[2], part[1]
    return combined(y, square_of_hermitian(y), *parts)


def _square(g: list[float]) -> list[float]:
    """Return the square of the complex matrix ``g``.

    Both ``g`` and the result contain the real parts of all entries, then the imaginary parts.
    """
    result = [0.0] * (2 * SIZE)
    for i in range(ROWS):
        for j in range(ROWS):
            real, imaginary = 0.0, 0.0
            for k in range(ROWS):
                # The imaginary part of an entry is stored ``SIZE`` places after its real part.
                left, right = ROWS * i + k, ROWS * k + j
                real += g[left] * g[right] - g[SIZE + left] * g[SIZE + right]
                imaginary += g[left] * g[SIZE + right] + g[SIZE + left] * g[right]
            result[ROWS * i + j], result[SIZE + ROWS * i + j] = real, imaginary
    return result
