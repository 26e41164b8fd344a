"""The emitted function that computes the product of a matrix exponential and a vector.

In double precision, the function executes the same operations as
:meth:`codegen.ir.exponential_action.ExponentialAction.in_doubles`.
"""

from __future__ import annotations

from codegen.ir.exponential_action import HALVINGS, SPARSE, ExponentialAction, degrees, largest_norms
from codegen.ir.precision import Precision
from codegen.run.language import Array, Assign, For, Function, If, Statement, While
from codegen.run.terms import INFINITY, Term, both, count, number, real, select, size, total, whole

_ROW, _COLUMN, _PLACE, _PART = count("i"), count("j"), count("place"), count("part")


def exponential_action(function: ExponentialAction, precision: Precision) -> Function:
    """Return the emitted function that computes exp(a) y for a matrix a and a vector y.

    The matrix is halved s times, until its norm is small. The Taylor polynomial of exp(a/2^s) is
    then applied 2^s times to the vector. If s would exceed HALVINGS, all entries of the result are NaN.
    """
    n, entries = function.n, len(function.places)
    a, y, result = real("a", entries), real("y", n), real("result", n)
    b, p, work = real("scaled", entries), real("p", n), real("work", n)
    norm, scale, weight = real("norm"), real("scale"), real("weight")
    parts, degree, factor = count("parts"), real("degree"), real("factor")
    sizes, bounds = degrees(precision.bits), largest_norms(precision.bits)
    chosen = number(float(sizes[-1]))
    for m, bound in reversed(list(zip(sizes[:-1], bounds[:-1], strict=True))):
        chosen = select(norm > bound, chosen, number(float(m)))
    # Let b be the scaled matrix, m the degree, and v the vector ``result``. Horner's rule computes
    # p = m!/1! v + m!/2! b v + ... + m!/m! b^(m - 1) v. The Taylor polynomial of exp(b) v is v + b p/m!.
    # Unlike the coefficients 1/j!, the integers m!/j! have no rounding errors.
    horner = (
        Assign(weight, weight * factor),
        Assign(factor, factor - 1.0),
        *_product(function, b, p, work),
        For(_ROW, whole(n), (Assign(p[_ROW], work[_ROW] + weight * result[_ROW]),)),
    )
    # At the end of Horner's rule, ``weight`` is the factorial of ``degree``.
    part = (
        Assign(p, result),
        Assign(weight, number(1.0)),
        Assign(factor, degree),
        While(factor > 1.0, horner),
        For(_ROW, whole(n), (Assign(p[_ROW], p[_ROW] / weight),)),
        *_product(function, b, p, work),
        For(_ROW, whole(n), (Assign(result[_ROW], result[_ROW] + work[_ROW]),)),
    )
    computed = (
        # ``scale`` is a power of two, so this product has no rounding error.
        For(_PLACE, whole(entries), (Assign(b[_PLACE], a[_PLACE] * scale),)),
        Assign(degree, chosen),
        Assign(result, y),
        For(_PART, parts, part),
    )
    body: tuple[Statement, ...] = (
        *map(Array, (b, p, work)),
        *_norm(function, a, norm),
        Assign(scale, number(1.0)),
        Assign(parts, whole(1)),
        While(
            # Each halving doubles ``parts`` and the computing time, so at most HALVINGS halvings are made.
            both(norm * scale > bounds[-1], parts < 2**HALVINGS),
            (Assign(scale, number(0.5) * scale), Assign(parts, parts * 2)),
        ),
        Assign(norm, norm * scale),
        If(norm > bounds[-1], (_nan(result),), computed),
    )
    about = f"result = exp(a) y for the {n} x {n} matrix a, by Taylor polynomials{_entries(function)}."
    return Function(function.name, about, (a, y, result), body)


def _nan(result: Term) -> For:
    """Return the statement that fills the result with NaNs."""
    return For(_ROW, whole(result.shape[0]), (Assign(result[_ROW], INFINITY - INFINITY),))


def _entries(function: ExponentialAction) -> str:
    return "; the array a does not contain the entries that are always zero" if function.pattern else ""


def _norm(function: ExponentialAction, a: Term, norm: Term) -> list[Statement]:
    """Return the statements that compute ``norm``, the infinity norm (largest absolute row sum) of ``a``."""
    row = real("row_sum")
    larger = Assign(norm, select(row > norm, row, norm))
    # Loops compute the sums for a large matrix. For a small matrix, the sums are unrolled.
    if function.n > SPARSE:
        added = Assign(row, row + size(a[function.n * _ROW + _COLUMN]))
        inner = (Assign(row, number(0.0)), For(_COLUMN, whole(function.n), (added,)), larger)
        return [Assign(norm, number(0.0)), For(_ROW, whole(function.n), inner)]
    result: list[Statement] = [Assign(norm, number(0.0))]
    for entries in function.rows:
        if entries:
            result += [Assign(row, total(size(a[k]) for k, _ in entries)), larger]
    return result


def _product(function: ExponentialAction, a: Term, y: Term, result: Term) -> list[Statement]:
    """Return the statements that assign the product of ``a`` and ``y`` to ``result``."""
    if function.n > SPARSE:
        value = real("total")
        added = Assign(value, value + a[function.n * _ROW + _COLUMN] * y[_COLUMN])
        inner = (Assign(value, number(0.0)), For(_COLUMN, whole(function.n), (added,)))
        return [For(_ROW, whole(function.n), (*inner, Assign(result[_ROW], value)))]
    return [
        # If a row of ``a`` is always zero, the sum has no terms.
        Assign(result[i], total(a[k] * y[j] for k, j in row) if row else number(0.0))
        for i, row in enumerate(function.rows)
    ]
