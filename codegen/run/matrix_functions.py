"""Build the emitted functions for the matrix exponential, its derivatives, and the inverse of a matrix.

The algorithms are described in :mod:`codegen.ir.matrix_exponential` and :mod:`codegen.ir.matrix_inverse`.
Matrices are stored row by row. A jet consists of a matrix and its derivatives. All matrices of a jet are
stored in one array.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import factorial

from codegen.ir.exponential_action import ExponentialAction
from codegen.ir.matrix_exponential import DEGREES, LEAST_DIGITS, largest_norms, pairs
from codegen.ir.matrix_functions import MatrixExponential, MatrixInverse
from codegen.ir.matrix_product import MatrixCommutator, MatrixProduct
from codegen.ir.precision import Precision
from codegen.ir.unitary_exponential import SpecialUnitaryExponential
from codegen.ir.vector_calls import vector_function
from codegen.ir.vector_function import VectorFunction
from codegen.run.exponential_action import exponential_action
from codegen.run.language import (
    Array,
    Assign,
    Call,
    For,
    Function,
    If,
    Return,
    Statement,
    Table,
    While,
    statements,
)
from codegen.run.terms import (
    INFINITY,
    Kind,
    Term,
    both,
    call,
    count,
    number,
    real,
    select,
    size,
    total,
    whole,
)
from codegen.run.unitary_exponential import unitary_functions

UNROLLED = 4
"""The largest number of rows for which each entry of a matrix product is computed without a loop."""

COEFFICIENTS = "inverse_factorial"
"""The name of the table that contains the coefficients 1/k!."""

_ROW, _COLUMN, _TERM, _PLACE = count("i"), count("j"), count("k"), count("place")


def used(functions: Iterable[Function]) -> list[VectorFunction]:
    """Return the matrix exponentials and other vector functions that ``functions`` call."""
    called = {s.function for f in functions for s in statements(f.body) if isinstance(s, Call)}
    # Sorting the names makes the order of the emitted functions reproducible.
    functions_called = map(vector_function, sorted(called))
    return [function for function in functions_called if function is not None]


def matrix_functions(functions: Iterable[VectorFunction], precision: Precision) -> list[Function]:
    """Return emitted functions that compute ``functions``, for example a matrix exponential.

    Each emitted function comes after the functions that it calls.
    """
    listed: dict[str, Function] = {}
    for function in functions:
        match function:
            case MatrixExponential():
                own = _Exponential(function, precision).functions()
            case MatrixProduct():
                own = [_Exponential(MatrixExponential(function.n), precision).product_of(function.name)]
            case ExponentialAction():
                own = [exponential_action(function, precision)]
            case MatrixCommutator():
                own = [_commutator(function)]
            case SpecialUnitaryExponential():
                own = unitary_functions(function, precision, _coefficient())
            case _:
                assert isinstance(function, MatrixInverse)
                own = [_inverse(function)]
        # Exponentials of matrices of equal size share the norm function, so it is listed once.
        listed |= {f.name: f for f in own}
    return list(listed.values())


def matrix_tables(functions: Iterable[VectorFunction], precision: Precision) -> tuple[Table, ...]:
    """Return a tuple with the table of the coefficients 1/k!, or () if no function needs this table."""
    if not any(isinstance(f, MatrixExponential | SpecialUnitaryExponential) for f in functions):
        return ()
    row = tuple(precision.round(Fraction(1, factorial(k))) for k in range(DEGREES[-1] + 1))
    return (Table(_coefficient(), (row,), "1/k!"),)


def _coefficient() -> Term:
    """Return the array of the coefficients 1/k! up to the highest degree of the Taylor polynomials."""
    return real(COEFFICIENTS, DEGREES[-1] + 1)


def _is_lost(array: Term) -> For:
    """Return the statement that fills an array with NaNs."""
    return For(_PLACE, whole(array.shape[0]), (Assign(array[_PLACE], INFINITY - INFINITY),))


class _Exponential:
    """Builds the emitted functions for the exponential of a jet (a matrix and its derivatives)."""

    def __init__(self, function: MatrixExponential, precision: Precision) -> None:
        self.name, self.n, self.level = function.name, function.n, function.level
        self.size, self.one = function.size, function.n**2
        self.precision = precision
        self.norms = largest_norms(precision.bits)
        self.coefficient = _coefficient()

    def functions(self) -> list[Function]:
        """Return three emitted functions: norm of a matrix, product of two jets, exponential of a jet."""
        return [self._norm(), self.product_of(f"{self.name}_product"), self._exponential()]

    def entry(self, array: Term, row: Term, column: Term, part: int = 0) -> Term:
        """Return the entry in ``row`` and ``column`` of one matrix in ``array``. The array contains a matrix
        and its derivatives. If ``part`` is 0, the entry belongs to the matrix itself. Otherwise, it belongs
        to the derivative number ``part``.
        """
        place = self.n * row + column
        return array[place + self.one * part if part else place]

    def norm(self, array: Term, target: Term) -> Call:
        """Return the statement that computes the norm of the first matrix in ``array``."""
        return Call(f"norm{self.n}", (array.part(0, self.one),), (target,))

    def _norm(self) -> Function:
        a, square = real("a", self.one), real("square")
        body = (
            Assign(square, number(0.0)),
            For(_PLACE, whole(self.one), (Assign(square, square + a[_PLACE] * a[_PLACE]),)),
            Return(call("sqrt", square)),
        )
        about = f"Return the Frobenius norm of a {self.n} x {self.n} matrix."
        return Function(f"norm{self.n}", about, (a,), body, Kind.REAL)

    def product(self, a: Term, b: Term, result: Term) -> Call:
        """Return the statement that computes result = a b for jets a and b."""
        return Call(f"{self.name}_product", (a, b, result))

    def product_of(self, name: str) -> Function:
        """Return the function that multiplies two jets. A jet consists of a matrix and its derivatives."""
        a, b, result = (real(x, self.size) for x in ("a", "b", "result"))
        inner: list[Statement] = []
        for part, factors in enumerate(pairs(self.level)):
            entry = self.entry(result, _ROW, _COLUMN, part)
            inner += self._sum(a, b, factors, entry, part)
        rows = For(_ROW, whole(self.n), (For(_COLUMN, whole(self.n), tuple(inner)),))
        about = f"result = a b for {self.n} x {self.n} matrices{' with derivatives' if self.level else ''}."
        return Function(name, about, (a, b, result), (rows,))

    def _sum(
        self, a: Term, b: Term, factors: Sequence[tuple[int, int]], entry: Term, part: int
    ) -> list[Statement]:
        """Return the statements that compute ``entry``, an entry of the product of the jets ``a`` and ``b``.

        A jet is a list of matrices. The entry belongs to the matrix with the index ``part``. This matrix is
        the sum of the products a_p b_q over all pairs (p, q) in ``factors``.
        """

        def terms(k: Term) -> list[Term]:
            return [self.entry(a, _ROW, k, p) * self.entry(b, k, _COLUMN, q) for p, q in factors]

        # A small matrix needs no loop for this sum. The loop for larger matrices adds the terms in the same
        # order, so the sum has the same rounding errors with and without a loop.
        if self.n <= UNROLLED:
            return [Assign(entry, total(x for k in range(self.n) for x in terms(whole(k))))]
        # The terms are added in a scalar variable. The sum is then stored in ``entry``.
        value = real(f"total_{part}" if self.level else "total")
        added = tuple(Assign(value, value + x) for x in terms(_TERM))
        loop = For(_TERM, whole(self.n), added)
        return [Assign(value, number(0.0)), loop, Assign(entry, value)]

    def _exponential(self) -> Function:
        a, result, work = real("a", self.size), real("result", self.size), real("work", self.size)
        powers = tuple(real(f"power_{k}", self.size) for k in (1, 2, 3, 4))
        # If the norm of a matrix is at most ``least``, the Taylor polynomial of degree 16 is accurate enough.
        scale, norm, least = real("scale"), real("norm"), self.norms[-1]
        squarings, growth = count("squarings"), real("growth")
        bits = self.precision.bits
        body: list[Statement] = [
            *map(Array, (*powers, work)),
            self.norm(a, norm),
            Assign(scale, number(1.0)),
            Assign(squarings, whole(0)),
            While(
                # Each squaring can double the relative error, so the number of squarings is limited.
                both(norm * scale > least, squarings < bits),
                (Assign(scale, number(0.5) * scale), Assign(squarings, squarings + 1)),
            ),
            Assign(norm, norm * scale),
            # The repeated squaring undoes the multiplication by ``scale``.
            For(_PLACE, whole(self.size), (Assign(powers[0][_PLACE], a[_PLACE] * scale),)),
            *self._polynomial(powers, work, result, norm),
            If(
                squarings > 0,
                (
                    *self._growth(a, scale, growth),
                    *self._squared(result, work, squarings, growth),
                ),
            ),
            # The number of squarings is limited, so the scaled norm may still exceed ``least``.
            If(norm > least, (_is_lost(result),)),
        ]
        return Function(self.name, self._about(), (a, result), tuple(body))

    def _about(self) -> str:
        # ``what`` is a text about the result. If there are derivatives, the text also describes the contents
        # of the arrays 'a' and 'result'.
        what = f"exp(A) for the {self.n} x {self.n} matrix A in array 'a'"
        if self.level:
            single = (
                ". The array 'a' contains A and then a matrix E. The array 'result' contains exp(A) and "
                "then the derivative of exp at A in the direction E"
            )
            several = f". The matrix A is a function of {self.level} variables"
            what += (
                single
                if self.level == 1
                else f"{several}. The array 'a' contains A and then all partial derivatives of A "
                "with order at most 1 in each variable, such as A_xy. The array 'result' contains exp(A) "
                "and then the same partial derivatives of exp(A)"
            )
        return (
            f"result = {what}. The algorithm is scaling and squaring: a Taylor polynomial of exp(A/2^s) is "
            "squared s times. If the estimate of the relative error exceeds "
            f"2^-{LEAST_DIGITS}, all entries of the result are NaN."
        )

    def _polynomial(self, powers: Sequence[Term], work: Term, result: Term, norm: Term) -> list[Statement]:
        """Return the statements that evaluate a Taylor polynomial of exp.

        The argument of exp is the matrix ``powers[0]``. The norm ``norm`` of the matrix determines the
        degree: 4, 8, 12 or 16.
        """
        # The polynomial is evaluated by the method of Paterson and Stockmeyer: Horner's rule in the fourth
        # power of the matrix.
        b1, b2, b3, b4 = powers
        groups, group, c = count("groups"), count("group"), self.coefficient
        # The degree of the Taylor polynomial is 4 times ``chosen``.
        first, second, third, _ = self.norms
        chosen = select(
            norm > third, whole(4), select(norm > second, whole(3), select(norm > first, whole(2), whole(1)))
        )
        # Horner's rule begins with the leading coefficient ``c[4 * groups]`` times b^4.
        start = Assign(work[_PLACE], c[4 * groups] * b4[_PLACE])

        def added(base: Term) -> tuple[Statement, ...]:
            # The sum begins with the terms of high degree, because they are usually small.
            value = ((work[_PLACE] + c[base + 3] * b3[_PLACE]) + c[base + 2] * b2[_PLACE]) + c[base + 1] * b1[
                _PLACE
            ]
            # ``value`` omits the term ``c[base]`` times the unit matrix. The second loop below adds this term
            # to the diagonal entries.
            diagonal = result[(self.n + 1) * _ROW]
            return (
                For(_PLACE, whole(self.size), (Assign(result[_PLACE], value),)),
                For(_ROW, whole(self.n), (Assign(diagonal, diagonal + c[base]),)),
            )

        inner = (
            If(
                # The loop over ``group`` runs backwards from ``groups`` - 1, so this condition is false only
                # in the first iteration.
                group + 1 < groups,
                (self.product(result, b4, work),),
                (For(_PLACE, whole(self.size), (start,)),),
            ),
            *added(4 * group),
        )
        return [
            Assign(groups, chosen),
            self.product(b1, b1, b2),
            self.product(b2, b1, b3),
            self.product(b2, b2, b4),
            For(group, groups, inner, reverse=True),
        ]

    def _growth(self, a: Term, scale: Term, growth: Term) -> list[Statement]:
        """Return the statements that compute ``growth``, a bound of the spectral norm of exp(scale a)."""
        # Let mu be the logarithmic norm of ``a``, the largest eigenvalue of its symmetric part. The spectral
        # norm of exp(``a``) is at most exp(mu). Gershgorin's theorem gives the upper bound ``largest`` of mu.
        largest, sums, c = real("largest_sum"), real("row_sum"), self.coefficient
        off = number(0.5) * size(self.entry(a, _ROW, _COLUMN) + self.entry(a, _COLUMN, _ROW))
        row = (
            Assign(sums, a[(self.n + 1) * _ROW]),
            For(_COLUMN, whole(self.n), (If(_COLUMN.differs(_ROW), (Assign(sums, sums + off),)),)),
            Assign(largest, select(sums > largest, sums, largest)),
        )
        return [
            Assign(largest, a[0]),
            For(_ROW, whole(self.n), row),
            Assign(largest, largest * scale),
            # The exponential of the scalar ``largest`` is computed by its Taylor polynomial, with the table
            # of 1/k!.
            Assign(growth, c[DEGREES[-1]]),
            For(_TERM, whole(DEGREES[-1]), (Assign(growth, c[_TERM] + largest * growth),), reverse=True),
        ]

    def _squared(self, result: Term, work: Term, squarings: Term, growth: Term) -> list[Statement]:
        """Return the statements that square ``result`` repeatedly. The number of squarings is ``squarings``.

        ``result`` contains a matrix and its derivatives. ``growth`` is an upper bound of the spectral norm of
        the matrix. The emitted statements also estimate the relative error. If the estimate exceeds
        2^-LEAST_DIGITS, all entries of ``result`` become NaN.
        """
        n, unit = self.n, self.precision.unit
        error, bound = real("error_bound"), real("bound")
        body = (
            self.norm(result, bound),
            # The Frobenius norm (``bound``) and ``growth`` are two upper bounds of the spectral norm of the
            # matrix. The smaller bound is used.
            Assign(bound, select(bound < growth, bound, growth)),
            # Let r = ``bound`` be an upper bound of the norm of the n x n matrix, and let e = ``error`` be an
            # upper bound of the error of the matrix. With the unit roundoff u, the error of the computed
            # square is at most about 2 r e + n^2 u r^2.
            Assign(error, 2.0 * bound * error + (n * n * unit) * (bound * bound)),
            # If the norm of a matrix is at most ``growth``, the norm of its square is at most ``growth``^2.
            Assign(growth, growth * growth),
            self.product(result, result, work),
            # The product cannot overwrite its factors, so the square is computed in ``work`` and then copied.
            Assign(result, work),
        )
        return [
            # Before the first squaring, ``error`` is an upper bound of the error of the Taylor polynomial.
            Assign(error, number((n + 8) * unit * n)),
            For(_TERM, squarings, body),
            self.norm(result, bound),
            If(error > 2.0**-LEAST_DIGITS * bound, (_is_lost(result),)),
        ]


def _commutator(function: MatrixCommutator) -> Function:
    """Return the function that computes the commutator a b - b a of two matrices."""
    n, k, i, j = function.n, _TERM, _ROW, _COLUMN
    a, b, result = (real(x, function.size) for x in ("a", "b", "result"))
    forward, backward = real("forward"), real("backward")
    terms = (
        Assign(forward, forward + a[n * i + k] * b[n * k + j]),
        Assign(backward, backward + b[n * i + k] * a[n * k + j]),
    )
    entry = (
        Assign(forward, number(0.0)),
        Assign(backward, number(0.0)),
        For(k, whole(n), terms),
        Assign(result[n * i + j], forward - backward),
    )
    body = For(i, whole(n), (For(j, whole(n), entry),))
    return Function(function.name, f"result = a b - b a for {n} x {n} matrices.", (a, b, result), (body,))


def _inverse(function: MatrixInverse) -> Function:
    """Return the function that inverts a matrix."""
    n, a, b = function.n, real("a", function.size), real("result", function.size)
    order, pivot, kept = count("order", n), count("pivot"), real("kept")
    factor, multiple = real("factor"), real("multiple")
    k, i, j = _TERM, _ROW, _COLUMN
    # ``row`` is the array index of entry (k, j). ``at`` is the array index of the pivot (k, k).
    row, at = n * k + j, n * k + k
    # The pivot has the largest absolute value in column k on and below the diagonal, so rounding errors stay
    # small.
    regular = both(size(b[at]) > 0.0, size(b[at]) < INFINITY)
    search = If(size(b[n * i + k]) > size(b[n * pivot + k]), (Assign(pivot, i),))
    exchanged = (Assign(kept, b[row]), Assign(b[row], b[n * pivot + j]), Assign(b[n * pivot + j], kept))
    # The Gauss-Jordan elimination works in place: the inverse overwrites the entries of ``b``.
    eliminated = (
        Assign(multiple, b[n * i + k]),
        For(j, whole(n), (Assign(b[n * i + j], b[n * i + j] - multiple * b[row]),)),
        Assign(b[n * i + k], -(multiple * factor)),
    )
    column = (
        Assign(pivot, k),
        For(i, whole(n), (If(i > k, (search,)),)),
        Assign(order[k], pivot),
        For(j, whole(n), exchanged),
        # With an infinite pivot, the factor 0 would give a finite result. With the factor NaN, all entries of
        # the result are NaN.
        Assign(factor, select(regular, 1.0 / b[at], INFINITY - INFINITY)),
        For(j, whole(n), (Assign(b[row], b[row] * factor),)),
        # In a Gauss-Jordan inversion, the reciprocal of the pivot replaces the pivot.
        Assign(b[at], factor),
        For(i, whole(n), (If(i.differs(k), eliminated),)),
    )
    # An exchange of two rows of a matrix exchanges the same two columns of its inverse.
    swapped = (
        Assign(kept, b[n * i + k]),
        Assign(b[n * i + k], b[n * i + order[k]]),
        Assign(b[n * i + order[k]], kept),
    )
    body = (
        Array(order),
        Assign(b, a),
        For(k, whole(n), column),
        For(k, whole(n), (For(i, whole(n), swapped),), reverse=True),
    )
    about = f"result = the inverse of the {n} x {n} matrix a: elimination with row exchanges."
    return Function(function.name, about, (a, b), tuple(body))
