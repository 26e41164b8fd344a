"""The emitted functions that compute the exponential of a matrix in the Lie algebra su(3).

The formulas are derived in :mod:`codegen.ir.unitary_exponential`. The emitted code evaluates
the formulas in its own precision.
"""

from __future__ import annotations

from codegen.ir.matrix_exponential import LEAST_DIGITS, largest_norms
from codegen.ir.precision import Precision
from codegen.ir.unitary_exponential import (
    COORDINATES,
    ROWS,
    SIZE,
    SpecialUnitaryExponential,
    combined,
    determinant,
    half_trace,
    most_squarings,
    square_of_hermitian,
)
from codegen.run.language import Array, Assign, Call, For, Function, If, Statement, While
from codegen.run.terms import INFINITY, Term, both, call, count, negated, number, real, select, whole

_ROW, _COLUMN, _TERM, _PLACE = count("i"), count("j"), count("k"), count("place")


def unitary_functions(
    function: SpecialUnitaryExponential, precision: Precision, coefficient: Term
) -> list[Function]:
    """Return the function that squares a matrix, and the function for the exponential of a matrix in su(3).

    ``coefficient`` is the table of the numbers 1/k!.
    """
    return [_square(function), _exponential(function, precision, coefficient)]


def _exponential(function: SpecialUnitaryExponential, precision: Precision, coefficient: Term) -> Function:
    """Return the function that computes the exponential of a matrix in su(3)."""
    a, result, work = real("a", COORDINATES), real("result", 2 * SIZE), real("work", 2 * SIZE)
    y, scale, norm, squarings = real("y", COORDINATES), real("scale"), real("norm"), count("squarings")
    # The emitted Taylor polynomials have degrees up to 16. If the norm of a matrix exceeds ``least``, even
    # the polynomial of degree 16 is not accurate enough.
    least = largest_norms(precision.bits)[-1]
    body: tuple[Statement, ...] = (
        Array(y),
        Array(work),
        # Let i H be the matrix with the coordinates a, and let p = tr(H^2)/2. The eigenvalues x, y, z of H
        # satisfy x + y + z = 0 and x^2 + y^2 + z^2 = 2 p. Because y^2 + z^2 >= (y + z)^2/2 = x^2/2, it
        # follows that |x| <= (4 p/3)^(1/2).
        Assign(norm, call("sqrt", 1.3333333333333333 * half_trace(_coordinates(a)))),
        Assign(scale, number(1.0)),
        Assign(squarings, whole(0)),
        While(
            # Each squaring doubles the relative error, so the number of squarings is limited.
            both(norm * scale > least, squarings < most_squarings(precision.bits)),
            (Assign(scale, number(0.5) * scale), Assign(squarings, squarings + 1)),
        ),
        Assign(norm, norm * scale),
        For(_PLACE, whole(COORDINATES), (Assign(y[_PLACE], a[_PLACE] * scale),)),
        *_polynomial(y, norm, result, coefficient, precision),
        For(
            _TERM,
            squarings,
            # The square of a matrix cannot overwrite the matrix, so it is computed in ``work`` and then
            # copied.
            (Call(f"{function.name}_square", (result, work)), Assign(result, work)),
        ),
        # The loop above halves the matrix until ``norm`` is at most ``least``, but the number of halvings is
        # limited. If ``norm`` exceeds ``least`` after the loop, all results are set to NaN. The results must
        # also be NaN if ``norm`` is a NaN. Therefore the test is the negation of ``norm <= least``. For a
        # NaN, this negation is true, but the comparison ``norm > least`` is false.
        If(
            negated(norm <= least),
            (For(_PLACE, whole(2 * SIZE), (Assign(result[_PLACE], INFINITY - INFINITY),)),),
        ),
    )
    about = (
        "result = exp(X), where X is the traceless skew-Hermitian 3 x 3 matrix with the coordinates a. X is "
        "divided by 2^s to make its norm small. The Taylor polynomial of exp(X/2^s) is evaluated modulo the "
        "characteristic polynomial of X/2^s, and the resulting matrix is squared s times. The real parts of "
        "all entries of exp(X) come first. If the bound of the relative error exceeds "
        f"2^-{LEAST_DIGITS}, all results are NaN."
    )
    return Function(function.name, about, (a, result), body)


def _polynomial(
    y: Term, norm: Term, result: Term, coefficient: Term, precision: Precision
) -> list[Statement]:
    """Return the statements that evaluate a Taylor polynomial of the exponential.

    The argument is the matrix with the coordinates ``y``. Its norm is at most ``norm``.
    """
    first, second, third, _ = largest_norms(precision.bits)
    groups, group = count("groups"), count("group")
    trace, det = real("half_trace"), real("determinant")
    # Horner's rule multiplies the complex coefficients only by real numbers. Therefore the real parts
    # ``even`` and the imaginary parts ``odd`` are computed separately.
    parts = [[real(f"{name}_{k}") for k in range(3)] for name in ("even", "odd")]
    zero, coordinates = number(0.0), _coordinates(y)
    steps: list[Statement] = []
    for k in (3, 2, 1, 0):
        # The coefficient i^k/k! is real for even k and imaginary for odd k.
        for parity, part in enumerate(parts):
            steps += _horner(part, trace, det, (coefficient[4 * group + k], k) if k % 2 == parity else None)
    square = [real(f"square_{k}") for k in range(SIZE)]
    squares = zip(square, square_of_hermitian(coordinates), strict=True)
    entries = combined(coordinates, square, *parts)
    return [
        Assign(
            groups,
            select(
                norm > third,
                whole(4),
                select(norm > second, whole(3), select(norm > first, whole(2), whole(1))),
            ),
        ),
        Assign(trace, half_trace(coordinates)),
        Assign(det, determinant(coordinates)),
        *(Assign(x, zero) for part in parts for x in part),
        # The degree n is a multiple of 4, so i^n = 1. The coefficient of the highest power is 1/n!.
        Assign(parts[0][0], coefficient[4 * groups]),
        # Horner's rule starts at the highest powers. Each iteration makes four steps of Horner's rule.
        For(group, groups, tuple(steps), reverse=True),
        *(Assign(target, value) for target, value in squares),
        *(Assign(result[k], value) for k, value in enumerate(entries)),
    ]


def _coordinates(array: Term) -> tuple[Term, ...]:
    return tuple(array[k] for k in range(COORDINATES))


def _horner(part: list[Term], trace: Term, det: Term, added: tuple[Term, int] | None) -> list[Statement]:
    """Return the statements of one step of Horner's rule for a polynomial in a 3 x 3 matrix H.

    H is Hermitian and has the trace 0, so H^3 = ``trace`` H + ``det`` I. The argument ``trace`` is tr(H^2)/2,
    ``det`` is the determinant of H, and I is the identity matrix. ``part`` contains the real parts or the
    imaginary parts of the coefficients of I, H and H^2.

    If ``added`` is a pair (a, k) with a real number a, the number i^k a is added to the coefficient of I,
    where i is the imaginary unit. For even k, i^k a is real, and ``part`` must contain the real parts. For
    odd k, i^k a is imaginary, and ``part`` must contain the imaginary parts. If ``added`` is None, nothing is
    added.
    """
    last = real("last")
    # For k = 0, 1, 2, 3, the number i^k a is a, i a, -a, -i a. ``constant`` is this number without the factor
    # i: a, a, -a, -a.
    constant = number(0.0) if added is None else -added[0] if added[1] >= 2 else added[0]
    return [
        # The old coefficient of H^2 is saved, because the last two statements still need it.
        Assign(last, part[2]),
        Assign(part[2], part[1]),
        Assign(part[1], part[0] + trace * last),
        Assign(part[0], constant + det * last if added is not None else det * last),
    ]


def _square(function: SpecialUnitaryExponential) -> Function:
    """Return the function that squares a complex matrix."""
    g, result, i, j, k = real("g", 2 * SIZE), real("result", 2 * SIZE), _ROW, _COLUMN, _TERM
    re, im = real("real"), real("imaginary")
    # The first SIZE numbers of a matrix are the real parts of its entries. The imaginary parts follow.
    left, right = ROWS * i + k, ROWS * k + j
    terms = (
        Assign(re, re + (g[left] * g[right] - g[SIZE + left] * g[SIZE + right])),
        Assign(im, im + (g[left] * g[SIZE + right] + g[SIZE + left] * g[right])),
    )
    entry = (
        Assign(re, number(0.0)),
        Assign(im, number(0.0)),
        For(k, whole(ROWS), terms),
        Assign(result[ROWS * i + j], re),
        Assign(result[SIZE + ROWS * i + j], im),
    )
    body = For(i, whole(ROWS), (For(j, whole(ROWS), entry),))
    about = "result = g g for a complex 3 x 3 matrix g. The real parts of the entries come first."
    return Function(f"{function.name}_square", about, (g, result), (body,))
