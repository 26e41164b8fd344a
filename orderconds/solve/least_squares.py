"""Damped least squares (Levenberg 1944; Marquardt 1963) for many starting points at once.

The damping parameter is the norm of the residual times an adaptive factor (Fan and Yuan 2005). The solution
need not be isolated.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from orderconds.solve.tape import Floats

System = Callable[[Floats], tuple[Floats, Floats]]
"""A function that evaluates m equations at k points. The points form an array of shape (k, n). The function
returns the residuals, an array of shape (k, m), and the Jacobians, an array of shape (k, m, n)."""

SOLVED = 1e-13
"""Iterations stop if the norm of the residual is at most SOLVED."""


def least_squares(system: System, points: Floats, sweeps: int = 200) -> tuple[Floats, Floats]:
    """Improve each starting point in ``points`` by at most ``sweeps`` iterations. Return the improved points,
    and the 2-norms of the residuals at these points.

    >>> def circle(x):
    ...     return (x * x).sum(axis=1, keepdims=True) - 1, 2 * x[:, None, :]
    ...
    >>> points, norms = least_squares(circle, np.array([[3.0, 4.0]]))
    >>> np.round(points, 9).tolist(), bool(norms[0] < SOLVED)
    ([[0.6, 0.8]], True)
    """
    points = points.copy()
    values, slopes = system(points)
    size = _squares(values)
    damping = np.full(len(points), 1e-2)
    active = np.isfinite(size)
    diagonal = np.arange(points.shape[1])
    for _ in range(sweeps):
        active = active & (size > SOLVED**2) & (damping < 1e8)
        if not active.any():
            break
        J, r = slopes[active], values[active]
        normal = np.matmul(J.transpose(0, 2, 1), J)
        normal[:, diagonal, diagonal] += (damping[active] * np.sqrt(size[active]) + 1e-18)[:, None]
        right = np.matmul(J.transpose(0, 2, 1), r[..., None])
        tried = points[active] - _solved(normal, right)[..., 0]
        residuals, sloped = system(tried)
        there = _squares(residuals)
        better = (there < size[active]) & np.isfinite(sloped).all(axis=(1, 2))
        chosen = np.flatnonzero(active)[better]
        points[chosen], values[chosen], slopes[chosen] = tried[better], residuals[better], sloped[better]
        size[chosen] = there[better]
        factor = np.where(better, 0.3, 4.0)
        damping[active] = np.maximum(damping[active] * factor, 1e-6)
    return points, np.sqrt(np.where(np.isfinite(size), size, np.inf))


def _squares(values: Floats) -> Floats:
    with np.errstate(all="ignore"):
        total: Floats = (values * values).sum(axis=1)
    return np.where(np.isfinite(total), total, np.inf)


def _solved(normal: Floats, right: Floats) -> Floats:
    try:
        return np.asarray(np.linalg.solve(normal, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        # At least one matrix is singular, and numpy does not say which.
        eye = np.eye(normal.shape[1]) * 1e-9 * (1 + np.trace(normal, axis1=1, axis2=2))[:, None, None]
        return np.asarray(np.linalg.solve(normal + eye, right), dtype=np.float64)


def rank(jacobian: Floats, tolerance: float = 1e-7) -> int:
    """Return the numerical rank of a Jacobian.

    The rows are scaled to length one, because residuals may have different scales. The rank is the number of
    singular values of the scaled matrix above ``tolerance``.

    >>> rank(np.array([[1.0, 0.0], [1e6, 0.0]]))
    1
    """
    lengths = np.linalg.norm(jacobian, axis=1)
    scaled = jacobian[lengths > 1e-12] / lengths[lengths > 1e-12, None]
    return int((np.linalg.svd(scaled, compute_uv=False) > tolerance).sum()) if len(scaled) else 0
