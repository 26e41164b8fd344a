"""Continuous extensions (dense output): weights b_i(theta) for the solution at time t_0 + theta h, inside a
step from t_0 to t_0 + h.

The extension of a Runge-Kutta method uses the stages of the step, with the weights b_i(theta) in place of
b_i. Let t be a rooted tree with |t| nodes and density gamma(t). The extension has order q if each tree t
with at most q nodes satisfies this condition: the elementary weight of t with the weights b_i(theta) is
theta^|t| / gamma(t) (Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.6).
The extension of an RKMK method (Runge-Kutta-Munthe-Kaas) uses the same weights for the Lie algebra elements
k_i of the stages: y(theta) = exp(h sum_i b_i(theta) k_i).y_0. Here the dot denotes the action
of the Lie group on a point.
"""

from __future__ import annotations

from dataclasses import dataclass

from orderconds.ring.protocol import Element
from orderconds.tableau.methods import Row


@dataclass(frozen=True)
class Extension:
    """The polynomials b_i(theta). Row i contains the coefficients of theta, theta^2, .... All rows have the
    same length. ``order`` is the claimed order.

    >>> Extension(((1, -1), (0, 1)), 1).power(2)
    (-1, 1)
    """

    rows: tuple[Row, ...]
    order: int

    @property
    def degree(self) -> int:
        """The degree of the polynomials b_i(theta)."""
        return len(self.rows[0])

    def power(self, p: int) -> Row:
        """Return the coefficients of theta^p in the polynomials, one for each stage."""
        return tuple(row[p - 1] for row in self.rows)

    def at_end(self) -> Row:
        """Return the weights b_i(1)."""
        return self.combined(tuple(1 for _ in self.rows[0]))

    def combined(self, factors: tuple[Element, ...]) -> Row:
        """Return the number ``sum_p factors[p - 1] beta_ip`` for each stage i. Here beta_ip is the
        coefficient of theta^p in b_i(theta)."""
        return tuple(sum((f * x for f, x in zip(factors, row, strict=True)), 0 * row[0]) for row in self.rows)
