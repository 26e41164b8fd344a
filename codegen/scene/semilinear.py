"""Semilinear problems u' = L u + N(u) on a periodic interval, and a scalar model problem for tests."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from codegen.groups.base import LieGroup
from codegen.groups.coordinate_maps.base import CoordinateMap
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr, Space
from codegen.ir.number import Number
from codegen.scene.problem import TIME, Problem

TERMS = 20
"""The index of the last term in the series of dexp^{-1} for the model problem.

Term k is about (z/(2 pi))^k, where z is the step size times the eigenvalue -1/2 of the model problem. For
step sizes up to 1/4, |z| is at most 1/8, and the omitted terms are below (16 pi)^-21 = 2e-36.
"""


@dataclass(frozen=True)
class Semilinear:
    """The operator L and the nonlinear term N of a semilinear problem u' = L u + N(u), as formulas.

    - ``wave``, ``space``: the symbols of the wave number and of x.
    - ``symbol``: the eigenvalue of L as a formula in the wave number. A complex eigenvalue has two formulas,
      one for the real part and one for the imaginary part.
    - ``length``: the period.
    - ``initial``: the initial state as a formula in x.
    - ``formulas``, ``outer``: formulas g_i and orders m_i. N is the sum of all (d/dx)^m_i g_i.
    - ``inner``: a pair (n, s) for each derivative of u that occurs in ``formulas``. The symbol s denotes the
      n-th derivative of u. For u itself, n is 0.
    - ``kept``: the fraction of the Fourier modes of N that is kept; the highest modes are replaced by zero.
    - ``timed``: True if N depends on the time.
    """

    wave: str
    space: str
    symbol: tuple[Expr, ...]
    length: Expr
    initial: Expr
    inner: tuple[tuple[int, str], ...]
    outer: tuple[int, ...]
    formulas: tuple[Expr, ...]
    kept: Fraction
    timed: bool

    def text(self) -> str:
        """Return a text that describes the operator, for the header of emitted code."""
        kind = "complex" if len(self.symbol) > 1 else "real"
        return f"L multiplies exp(i k x) by a {kind} function of the wave number k"


class ExactExponential(CoordinateMap):
    """The exponential map of the group of affine maps.

    Emitted code computes its inverse differential by a closed form (:mod:`codegen.kernel.mode_kernel`). The
    model problem (:func:`model_of`) uses the series of the inverse differential up to term :data:`TERMS`.
    """

    name = "exp"
    text = "exponential map, with its exact inverse differential in closed form"

    def check(self, group: LieGroup, where: str = "") -> None:
        """Accept every group, because every group has the exponential map."""

    def element(self, d: Domain, group: LieGroup, x: Vector[S]) -> Vector[S]:
        """Return exp(x)."""
        return group.exp(d, x)

    def inverse_differential(self, d: Domain, group: LieGroup, x: Vector[S], y: Vector[S]) -> Vector[S]:
        """Return dexp^{-1}_x y."""
        return group.dexpinv(d, x, y, TERMS)


def model_of(scene: Problem) -> Problem:
    """Return the scalar model problem u' = -u/2 + N(u).

    N(u) is u^2 + t if the nonlinear term of the scene depends on the time, otherwise u^2.
    """
    assert scene.semilinear is not None
    (block,) = scene.state
    space = Space()
    u = space.sym(block.symbols[0])
    value = u * u + space.sym(TIME) if scene.semilinear.timed else u * u
    return replace(
        scene,
        roots=(space.one, value),
        state=(replace(block, initial=(space.const(Number.rational(1, 2)),)),),
        parameters={},
        runtime=(),
        semilinear=None,
    )


EIGENVALUE = Fraction(-1, 2)
"""The eigenvalue of the linear part -u/2 of the model problem."""
