"""Taylor polynomials of the solution of a problem on R^n, over any domain."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.taylor_recurrence import Recurrence
from codegen.ir.taylor_series import Coefficient

if TYPE_CHECKING:
    from codegen.scene.problem import Problem


def step(problem: Problem, domain: Domain, degree: int, y: Vector[S], t: S | None = None) -> Vector[S]:
    """Return the Taylor polynomial of the solution through y at the time t, after the time h."""
    # The coefficients include powers of h, which saves the powers in the polynomial.
    rows = coefficients(problem, domain, degree, y, t, domain.h)
    result = []
    for first, *further in rows:
        # The sum follows the order in which the coefficients become known. The first coefficient is added
        # last, so that the rounding errors are those of the change in one step.
        change = None
        for x in further:
            change = x if change is None else change if x is None else change + x
        result.append(first if change is None else first + change)
    return tuple(result)


def coefficients(
    problem: Problem, domain: Domain, degree: int, y: Sequence[S], t: S | None, scale: S
) -> list[list[Coefficient]]:
    """Return the coefficients 0, ..., degree of each coordinate, in powers of the time divided by ``scale``.

    A coefficient that is zero for all states is None.
    """
    return recurrence(problem, domain, y, t, scale).extend(degree)


def recurrence(problem: Problem, domain: Domain, y: Sequence[S], t: S | None, scale: S) -> Recurrence:
    """Return the recurrence of the coefficients, for :func:`coefficients`."""
    return Recurrence(problem.roots, domain, problem.symbols, y, problem.values(domain, y, t), scale)
