"""Classes for the coefficients of a method, and conversions between the classes. All coefficients of a method
are elements of one ring.

In this module, stages are counted from 0, and in files from 1. A product of exponentials is a sequence of
rows of coefficients. The first row defines the rightmost factor, which acts first. HLW denotes Hairer, Lubich
and Wanner, *Geometric Numerical Integration*.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from operator import add

from orderconds.ring.protocol import Element, Ring

Row = tuple[Element, ...]
Convert = Callable[[Element], Element]


def _converted(row: Row, convert: Convert) -> Row:
    return tuple(convert(x) for x in row)


@dataclass(frozen=True)
class RungeKutta:
    """A Runge-Kutta tableau. ``A`` has s rows of s entries, and ``b`` has s entries."""

    A: tuple[Row, ...]
    b: Row

    @property
    def s(self) -> int:
        """The number of stages."""
        return len(self.b)

    @property
    def c(self) -> Row:
        """The abscissae (nodes) c_i = sum_j a_ij."""
        return tuple(reduce(add, row) for row in self.A)

    def map(self, convert: Convert) -> RungeKutta:
        """Return a copy of the method in which ``convert`` is applied to every coefficient."""
        return RungeKutta(tuple(_converted(row, convert) for row in self.A), _converted(self.b, convert))

    def as_crouch_grossman(self, ring: Ring) -> CommutatorFree:
        """Return the Crouch-Grossman method that has the coefficients of this tableau.

        Stage i is exp(h a_is k_s) ... exp(h a_i1 k_1) y0, where k_j is the vector field at stage j. The
        update is exp(h b_s k_s) ... exp(h b_1 k_1) y0 (HLW IV.8.1).
        """

        def product(row: Row) -> Stage:
            rows = []
            for j, x in enumerate(row):
                if ring.is_zero(x) is not True:
                    rows.append(tuple(x if k == j else ring.zero for k in range(self.s)))
            return Stage(None, tuple(rows))

        return CommutatorFree(tuple(product(row) for row in self.A), product(self.b))


@dataclass(frozen=True)
class PartitionedRungeKutta:
    """A partitioned Runge-Kutta method: the tableau (A, b) for y' = f(y, z), and the tableau (A_hat, b_hat)
    for z' = g(y, z) (HLW II.2.1)."""

    A: tuple[Row, ...]
    b: Row
    A_hat: tuple[Row, ...]
    b_hat: Row

    @property
    def s(self) -> int:
        """The number of stages."""
        return len(self.b)

    def map(self, convert: Convert) -> PartitionedRungeKutta:
        """Return a copy of the method in which ``convert`` is applied to every coefficient."""
        return PartitionedRungeKutta(
            tuple(_converted(row, convert) for row in self.A),
            _converted(self.b, convert),
            tuple(_converted(row, convert) for row in self.A_hat),
            _converted(self.b_hat, convert),
        )

    def first(self) -> RungeKutta:
        """Return the Runge-Kutta method (A, b). The partitioned method uses it for the component y."""
        return RungeKutta(self.A, self.b)


@dataclass(frozen=True)
class Stage:
    """A product of exponentials that acts on y0 or on the value of a stage.

    ``start`` is the index of the stage, or None for y0. A row beta of ``exponentials`` defines exp(h sum_j
    beta_j k_j), where h is the step size and k_j is the vector field at stage j. The exponential of the first
    row acts first.
    """

    start: int | None
    exponentials: tuple[Row, ...]

    def map(self, convert: Convert) -> Stage:
        """Return a copy in which ``convert`` is applied to every coefficient."""
        return Stage(self.start, tuple(_converted(row, convert) for row in self.exponentials))


@dataclass(frozen=True)
class CommutatorFree:
    """A commutator-free method. Each of the s stages and the update is a product of exponentials."""

    stages: tuple[Stage, ...]
    update: Stage

    @property
    def s(self) -> int:
        """The number of stages."""
        return len(self.stages)

    def map(self, convert: Convert) -> CommutatorFree:
        """Return a copy of the method in which ``convert`` is applied to every coefficient."""
        return CommutatorFree(tuple(stage.map(convert) for stage in self.stages), self.update.map(convert))

    def from_start(self, stage: Stage) -> tuple[Row, ...]:
        """Return the exponentials that lead from y0 to the value of ``stage``, in the order of their
        application. A row contains the coefficients of one exponential."""
        before = () if stage.start is None else self.from_start(self.stages[stage.start])
        return before + stage.exponentials

    def same_update(self, other: Stage, ring: Ring) -> bool:
        """Return True if the update ``other`` and the update of this method are provably equal for all vector
        fields.

        The test compares the simplified exponents of both updates (:func:`_reduced`; Chen 1958).
        """
        one, two = (_reduced(self.from_start(stage), ring) for stage in (self.update, other))
        return len(one) == len(two) and all(
            ring.is_zero(x - y) is True
            for row, same in zip(one, two, strict=True)
            for x, y in zip(row, same, strict=True)
        )

    def as_runge_kutta(self, ring: Ring) -> RungeKutta:
        """Return the Runge-Kutta method that equals this method on an abelian group. On such a group, a
        product of exponentials is the exponential of the sum of the exponents."""

        def total(stage: Stage) -> Row:
            zero = (ring.zero,) * self.s
            rows = self.from_start(stage)
            return reduce(lambda x, y: tuple(map(add, x, y)), rows, zero)

        return RungeKutta(tuple(total(stage) for stage in self.stages), total(self.update))


def _reduced(rows: tuple[Row, ...], ring: Ring) -> list[Row]:
    """Simplify a product of exponentials without changing its value. Neighbouring exponentials with
    proportional exponents commute, so they are combined."""
    kept: list[Row] = []
    for row in rows:
        if kept and _proportional(kept[-1], row, ring):
            row = tuple(x + y for x, y in zip(kept.pop(), row, strict=True))
        if any(ring.is_zero(x) is not True for x in row):
            kept.append(row)
    return kept


def _proportional(x: Row, y: Row, ring: Ring) -> bool:
    pairs = ((i, j) for i in range(len(x)) for j in range(i))
    return all(ring.is_zero(x[i] * y[j] - x[j] * y[i]) is True for i, j in pairs)


@dataclass(frozen=True)
class Composition:
    """A composition of steps of one basic method with the step sizes gamma_1 h, ..., gamma_s h. The step of
    size gamma_1 h is applied first.

    Every symmetric method of order 2 is allowed as the basic method. The value of ``base`` is always
    ``"symmetric-2"``.
    """

    base: str
    gamma: Row

    @property
    def s(self) -> int:
        """The number of basic steps."""
        return len(self.gamma)

    def map(self, convert: Convert) -> Composition:
        """Return a copy of the composition in which ``convert`` is applied to every coefficient."""
        return Composition(self.base, _converted(self.gamma, convert))

    def as_runge_kutta(self, ring: Ring) -> RungeKutta:
        """Return the composition of implicit midpoint rules as a diagonally implicit Runge-Kutta method.

        The coefficients are b_i = gamma_i, a_ii = gamma_i/2, and a_ij = gamma_j for j < i (Bogfjellmo and
        Marthinsen 2016, Lemma 3.5.4).
        """
        half = ring.rational(1, 2)
        A = tuple(
            (*self.gamma[:i], step * half, *((ring.zero,) * (self.s - i - 1)))
            for i, step in enumerate(self.gamma)
        )
        return RungeKutta(A, self.gamma)


@dataclass(frozen=True)
class Embedded:
    """A second row of weights for an estimate of the local error. With these weights, the method has order
    ``order``."""

    b: Row
    order: int

    def map(self, convert: Convert) -> Embedded:
        """Return a copy of the weights in which ``convert`` is applied to every coefficient."""
        return Embedded(_converted(self.b, convert), self.order)


@dataclass(frozen=True)
class EmbeddedUpdate:
    """A second update of a commutator-free method, for an estimate of the local error. With this update, the
    method has order ``order``."""

    update: Stage
    order: int

    def map(self, convert: Convert) -> EmbeddedUpdate:
        """Return a copy of the update in which ``convert`` is applied to every coefficient."""
        return EmbeddedUpdate(self.update.map(convert), self.order)


LowerOrder = Embedded | EmbeddedUpdate
"""The data for an error estimate: a second row of weights of a Runge-Kutta method, or a second update of a
commutator-free method."""
