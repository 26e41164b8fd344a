"""Minimisation of the principal error over the solutions of the order conditions.

Let F be the vector of residuals of the conditions. Let E be the vector of residuals of the conditions of
order q + 1, where q is the required order. The principal error is the norm of E. Let F' and E' be the
Jacobians of F and E. Each step adds a vector p to the coefficients. The vector p minimises
|E + E' p|^2 + d |p|^2 under the constraint F + F' p = 0, where d is a damping parameter. The constraint is
the linearisation of the conditions at the current coefficients. A few iterations of
:func:`orderconds.solve.least_squares.least_squares` then solve the conditions again.

The method is sequential quadratic programming with the Gauss-Newton Hessian (Nocedal and Wright, *Numerical
Optimization*, Section 18.4).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from orderconds.solve.least_squares import least_squares
from orderconds.solve.tape import Floats

if TYPE_CHECKING:
    from orderconds.solve.problem import Problem

MAX_STEPS = 400
RESTORED = 1e-12
ENOUGH = 1e-7
"""The minimisation ends if the relative decrease of the principal error stays below ENOUGH in
:data:`PATIENCE` accepted steps in a row."""
PATIENCE = 12


def minimise(problem: Problem, point: Floats, steps: int = MAX_STEPS) -> tuple[Floats, float]:
    """Return a solution near ``point`` with locally minimal principal error, and the principal error of the
    solution. The argument ``point`` must solve the conditions.

    >>> from orderconds.solve.spec import Spec
    >>> from orderconds.solve.problem import find_problem
    >>> problem = find_problem("rk", 2, Spec(stages=2, explicit=True), "full")
    >>> point, error = minimise(problem, np.array([0.0, 1.0, 0.5]))
    >>> np.round(point, 6).tolist(), round(error, 6)  # Ralston's method
    ([0.25, 0.75, 0.666667], 0.166667)
    """
    damping, idle = 1e-3, 0
    values, slopes = problem.system(point[None])
    error, sloped = problem.error.jacobians(point[None])
    size = float(np.linalg.norm(error[0]))
    for _ in range(steps):
        step = _step(values[0], slopes[0], error[0], sloped[0], damping)
        moved, norms = least_squares(problem.system, (point + step)[None], sweeps=20)
        accepted = False
        if norms[0] < RESTORED:
            there = float(np.linalg.norm(problem.error.values(moved)[0]))
            accepted = there < size
        if not accepted:
            damping *= 5
            if damping > 1e6:
                break
            continue
        idle = idle + 1 if size - there < ENOUGH * size else 0
        point, size, damping = moved[0], there, max(damping * 0.3, 1e-9)
        if idle >= PATIENCE:
            break
        values, slopes = problem.system(point[None])
        error, sloped = problem.error.jacobians(point[None])
    return point, size


def _step(values: Floats, slopes: Floats, error: Floats, sloped: Floats, damping: float) -> Floats:
    """Return one step of sequential quadratic programming. The norm of ``error`` is minimised subject to
    ``values`` = 0. ``slopes`` is the Jacobian of the residuals ``values``. ``sloped`` is the Jacobian of
    ``error``."""
    if len(values):
        _, sizes, right = np.linalg.svd(slopes, full_matrices=True)
        rank = int((sizes > 1e-10 * max(sizes[0], 1e-300)).sum())
        normal: Floats = -np.linalg.pinv(slopes, rcond=1e-10) @ values
        tangent = right[rank:].T
    else:
        normal, tangent = np.zeros(slopes.shape[1]), np.eye(slopes.shape[1])
    J = sloped @ tangent
    target = error + sloped @ normal
    hessian = J.T @ J
    hessian += damping * np.eye(len(hessian)) * max(np.trace(hessian) / max(len(hessian), 1), 1e-12)
    along: Floats = np.linalg.solve(hessian, -(J.T @ target)) if len(hessian) else np.zeros(0)
    return normal + tangent @ along
