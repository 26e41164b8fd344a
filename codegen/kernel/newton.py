"""Matrices 1 - g'(u) of Newton's method for equations u = g(u).

A matrix is either exact or expanded to first order in the step size h. Each iteration with the expanded
matrix multiplies the error of u by O(h^2).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import factorial

from codegen.ir.domain import ExprDomain
from codegen.ir.elementary import ELEMENTARY
from codegen.ir.expr import Expr, Space, evaluate, walk
from codegen.ir.jacobian import jacobian
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, CHOOSE

SMALL = 3
"""The largest number of rows of a matrix whose inverse is computed from cofactors.

For larger matrices, Gaussian elimination takes fewer operations.
"""

LEAST_NUMERATOR = 2**50
"""The number m in a test for rounding errors in quotients whose divisor is zero at h = 0.

The numerator of such a quotient is a sum of a few terms. Let s be the sum of the absolute values of these
terms (:func:`_size`). The rounding error of the numerator is at most a few times 2^-53 s, where 2^-53 is the
unit roundoff. If the absolute value of the numerator is at most s/m, the numerator is replaced by zero.
"""

Rows = tuple[tuple[Expr, ...], ...]

AT_ZERO = {
    # The Stumpff series is c_k(x) = sum_i (-x)^i/(2 i + k)!, so c_k(0) = 1/k!.
    **{f"stumpff{k}": Fraction(1, factorial(k)) for k in range(4)},
    **{f"signed_stumpff{k}": Fraction(1, factorial(k)) for k in range(4)},
    # Let c_k(x) be the Stumpff series. The function ``slope{k}`` is the derivative c_k'. The value c_k'(0) is
    # -1/(k + 2)!.
    **{f"slope{k}": Fraction(-1, factorial(k + 2)) for k in (2, 3)},
    # Let c_k(x) be the Stumpff series. The function ``curvature{k}`` is c_k''.
    # The value c_k''(0) is 2/(k + 4)!.
    **{f"curvature{k}": Fraction(2, factorial(k + 4)) for k in (2, 3)},
    **{f"signed_slope{k}": Fraction(-1, factorial(k + 2)) for k in (1, 2, 3)},
    **{"sin": Fraction(0), "cos": Fraction(1), "exp": Fraction(1), "sqrt": Fraction(0), "log": None},
    **{name: function.at_zero for name, function in ELEMENTARY.items()},
}
"""The values of functions at zero. If a value is not rational or not finite, the entry is None."""


def matrix(images: Sequence[Expr], unknowns: Sequence[str]) -> Rows:
    """Return the rows of Newton's matrix 1 - g'(u).

    ``unknowns`` are the names of the components of u. The expressions ``images`` are the components of g(u).
    ZeroDivisionError is raised if the divisor of a quotient cannot be evaluated at h = 0, for example if the
    divisor is 1/h or log(h). The divisor may be zero at h = 0.
    """
    space = images[0].space
    rows = jacobian(_regular(images), unknowns)
    units = [[space.one if i == j else space.zero for j in range(len(rows))] for i in range(len(rows))]
    return tuple(tuple(e - x for e, x in zip(*pair, strict=True)) for pair in zip(units, rows, strict=True))


def leading_matrix(images: Sequence[Expr], unknowns: Sequence[str]) -> Rows:
    """Return the rows of Newton's matrix 1 - g'(u) to first order in h.

    ``unknowns`` are the names of the components of u. The expressions ``images`` are the components of g(u).
    ZeroDivisionError is raised as in :func:`leading_terms`.
    """
    return matrix(leading_terms(images), unknowns)


def leading_terms(images: Sequence[Expr]) -> list[Expr]:
    """Return the expansion of each expression in ``images`` to first order in h.

    ZeroDivisionError is raised for a division by zero at h = 0, and for values such as log(0) or acos(0) at
    h = 0.
    """
    space = images[0].space
    h = space.sym("h")
    # ``slopes`` are the derivatives of ``images`` with respect to h.
    slopes = [row[0] for row in jacobian(images, ["h"])]
    # One call inserts h = 0 in both lists. Therefore a subexpression that occurs in ``images`` and also in
    # ``slopes`` is evaluated only once.
    values = _at_zero(space, [*images, *slopes])
    # Higher powers of h are dropped, because Newton's method needs only an approximate matrix.
    n = len(images)
    return [a + h * b for a, b in zip(values[:n], values[n:], strict=True)]


class _Regular(ExprDomain):
    def call(self, function: str, *args: Expr) -> Expr:
        """Return the expression function(args). See :func:`_regular` for quotients."""
        if function == "quotient" and _at_zero(self.space, args[1:])[0].is_zero:
            bound = self.space.const(Number.rational(1, LEAST_NUMERATOR)) * _size(args[0])
            excess = self.space.call(ABSOLUTE, args[0]) - bound
            args = (self.space.call(CHOOSE, excess, args[0], self.space.zero), *args[1:])
        return super().call(function, *args)


def _size(root: Expr) -> Expr:
    """Return the sum of the absolute values of the terms of a sum.

    Cancellation within a term, as in (a - b)^2, is neglected, because a better estimate would need longer
    formulas.
    """
    # A sum may contain another sum several times. ``walk`` visits this sum only once.
    sizes: dict[int, Expr] = {}
    for node in walk([root], lambda x: x.op not in ("add", "sub", "neg")):
        own = [sizes[a.id] for a in node.args if a.id in sizes]
        match node.op:
            case "add" | "sub":
                sizes[node.id] = own[0] + own[-1]
            case "neg":
                sizes[node.id] = own[0]
            case _:
                sizes[node.id] = root.space.call(ABSOLUTE, node)
    return sizes[root.id]


def _regular(images: Sequence[Expr]) -> Sequence[Expr]:
    """Set numerators in ``images`` to zero if they consist only of rounding errors, and return the result.

    Only quotients whose divisor is zero at h = 0 are changed. If the divisor is tiny, a rounding error in the
    numerator can cause huge, wrong entries of Newton's matrix. The inverse of the matrix is then tiny, and
    therefore the iteration changes the unknowns very little. The iteration would stop, as if it had
    converged, before it is near the solution.
    """
    space = images[0].space
    if not any(n.op == "call" and n.payload == "quotient" for n in walk(images)):
        return images
    names = sorted({n.payload for n in walk(images) if n.op == "sym"})
    return evaluate(images, _Regular(space), {name: space.sym(name) for name in names})


class _AtZero(ExprDomain):
    def call(self, function: str, *args: Expr) -> Expr:
        """Return the expression function(args).

        The table :data:`AT_ZERO` contains values of functions at zero. If the first argument is zero and the
        table contains the function, the value in the table is returned. ZeroDivisionError is raised if this
        value is None.
        """
        # The closed forms of Stumpff functions are 0/0 at zero, so the values come from :data:`AT_ZERO`.
        if args[0].is_zero and function in AT_ZERO:
            value = AT_ZERO[function]
            if value is None:
                raise ZeroDivisionError(f"{function} of zero")
            return self.rational(value.numerator, value.denominator)
        return super().call(function, *args)


def _at_zero(space: Space, roots: Sequence[Expr]) -> list[Expr]:
    """Return the expressions ``roots`` with 0 in place of h."""
    names = {n.payload for n in walk(roots) if n.op == "sym"}
    # New nodes must be created in the same order in every run of the compiler.
    values = {name: space.zero if name == "h" else space.sym(name) for name in sorted(names)}
    return evaluate(roots, _AtZero(space), values)


def inverse(rows: Rows) -> Rows:
    """Return the inverse of a matrix of at most :data:`SMALL` rows, by cofactors."""
    space = rows[0][0].space
    n = len(rows)
    cofactors = [[_cofactor(rows, i, j) for j in range(n)] for i in range(n)]
    # Cofactors need no pivoting, so the emitted code has no branches.
    determinant = space.zero
    # The determinant is expanded along the first row.
    for entry, cofactor in zip(rows[0], cofactors[0], strict=True):
        determinant = determinant + entry * cofactor
    # One division and n^2 products cost less than n^2 divisions.
    factor = space.one / determinant
    # The inverse is the transposed matrix of cofactors divided by the determinant.
    return tuple(tuple(factor * cofactors[j][i] for j in range(n)) for i in range(n))


def _cofactor(rows: Rows, i: int, j: int) -> Expr:
    n, space = len(rows), rows[0][0].space
    if n == 1:
        return space.one
    # With cyclic indices, a cofactor of a 3 x 3 matrix needs no sign factor.
    a, b = ((i + k) % n for k in (1, n - 1))
    c, d = ((j + k) % n for k in (1, n - 1))
    # A cofactor of a 2 x 2 matrix is an entry of the matrix, with or without a change of sign.
    if n == 2:
        return rows[a][c] if (i + j) % 2 == 0 else -rows[a][c]
    return rows[a][c] * rows[b][d] - rows[a][d] * rows[b][c]
