"""Continuous extensions (dense output). An extension gives the solution at every time t_0 + theta h inside a
step from t_0 to t_0 + h.

The extension of a Runge-Kutta method replaces the weights b_i of the stages by polynomials b_i(theta). The
order condition of a rooted tree t with n nodes and density gamma(t) is: the elementary weight of t, computed
with the weights b_i(theta), equals ``theta^n / gamma(t)``. The extension has order q if the conditions of all
trees with at most q nodes are satisfied (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations
I, section II.6).

The extension of an RKMK method (Runge-Kutta-Munthe-Kaas) uses the polynomials b_i(theta) of the Runge-Kutta
method. Let k_i be the Lie algebra element of stage i. The exponential of ``h sum_i b_i(theta) k_i`` maps the
initial value y_0 to the solution at the time t_0 + theta h.
"""

from __future__ import annotations

from dataclasses import dataclass

from orderconds.ring.protocol import Element
from orderconds.tableau.methods import Row


@dataclass(frozen=True)
class Extension:
    """The weights b_i(theta) of a continuous extension. ``rows`` contains one row for each stage: the
    coefficients of theta, theta^2, ... in the weight. ``order`` is the order that the tableau file claims.

    >>> Extension(((1, -1), (0, 1)), 1).power(2)
    (-1, 1)
    """

    rows: tuple[Row, ...]
    order: int

    @property
    def degree(self) -> int:
        """The degree of the weights as polynomials in theta."""
        return len(self.rows[0])

    def power(self, p: int) -> Row:
        """Return the coefficient of theta^p in the weight of each stage."""
        return tuple(row[p - 1] for row in self.rows)

    def at_end(self) -> Row:
        """Return the weights at the end of the step, where theta is 1."""
        return self.combined(tuple(1 for _ in self.rows[0]))

    def combined(self, factors: tuple[Element, ...]) -> Row:
        """For each stage, return the scalar product of its row and ``factors``."""
        return tuple(sum((f * x for f, x in zip(factors, row, strict=True)), 0 * row[0]) for row in self.rows)
