"""The equations of a search: independent order conditions as functions of the free coefficients."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache

import numpy as np

from orderconds import families
from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.proof.subfamily import independent_conditions
from orderconds.ring.protocol import Element, Ring
from orderconds.ring.traces import Trace, Traces
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.parametrise import ansatz
from orderconds.solve.spec import Spec
from orderconds.solve.tape import Floats, Tape
from orderconds.tableau import CommutatorFree, Method, RungeKutta
from orderconds.tableau.unknowns import RootedRing

MARGIN = 0.01
"""If a coefficient must be positive but is not, the search moves it towards this value. Each positive value
is accepted."""


@dataclass(frozen=True)
class Problem:
    """The equations of one search. Create a problem with :func:`find_problem`. This function caches problems.

    >>> problem = find_problem("rk", 2, Spec(stages=2, explicit=True), "full")
    >>> problem.ansatz.free, problem.tape.size
    (('b1', 'b2', 'a21'), 2)
    """

    label: str
    order: int
    spec: Spec
    structure: str

    @cached_property
    def ansatz(self) -> Ansatz:
        """Return the ansatz: the text of a tableau file without the values of the unknowns."""
        return ansatz(self.label, self.spec, self.structure)

    @cached_property
    def family(self) -> Family:
        """Return the family whose order conditions the search solves."""
        return families.get(self.ansatz.family)

    @cached_property
    def measured(self) -> Family:
        """Return the family in which the principal error is computed."""
        return families.get(self.ansatz.measured or self.ansatz.family)

    @cached_property
    def conditions(self) -> tuple[OrderCondition, ...]:
        """Return order conditions that are sufficient for the required order.

        In a search for symmetric methods of even order p, the conditions of order p are omitted. These
        conditions follow from the others, because symmetric methods have even order (Hairer, Lubich and
        Wanner, *Geometric Numerical Integration*, Theorem II.3.2).
        """
        symmetric = self.structure.startswith("symmetric")
        highest = self.order - 1 if symmetric and self.order % 2 == 0 else self.order
        return independent_conditions(self.family, self.ansatz.symbolic(), highest, self._read)

    @cached_property
    def tape(self) -> Tape:
        """Return a program that evaluates the residuals of the conditions at many points."""
        return Tape(self.trace(), len(self.ansatz.free))

    def trace(self) -> list[Trace]:
        """Return the residuals of the conditions as traces. A trace records the arithmetic operations."""
        ring = Traces(len(self.ansatz.free))
        return list(self.residuals(ring.inputs, ring, self.conditions))

    def residuals(
        self, values: Sequence[Element], ring: RootedRing, conditions: Sequence[OrderCondition]
    ) -> list[Element]:
        """Return the residuals of ``conditions``: left-hand side minus right-hand side. ``values`` contains
        the free coefficients as elements of ``ring``."""
        method = self._read(self.ansatz.method(values, ring), ring)
        return list(self.family.residuals(method, ring, conditions))

    def _read(self, method: Method, ring: Ring) -> Method:
        """If ``ansatz.abelian`` is true and ``method`` is commutator-free, return the Runge-Kutta method that
        equals ``method`` on abelian groups. Otherwise, return ``method``."""
        if self.ansatz.abelian and isinstance(method, CommutatorFree):
            return method.as_runge_kutta(ring)
        return method

    @cached_property
    def error(self) -> Tape:
        """Return a program that evaluates the residuals of the order conditions of order p + 1, where p is
        the required order. The 2-norm of these residuals is the principal error."""
        ring = Traces(len(self.ansatz.free))
        method = self.ansatz.method(ring.inputs, ring)
        if self.measured.label() == self.family.label():
            method = self._read(method, ring)
        return Tape(self.measured.principal_residuals(method, ring, self.order + 1), len(self.ansatz.free))

    def weights(self, values: Sequence[Element], ring: RootedRing) -> list[Element]:
        """Return the weights b_i. ``values`` contains the free coefficients as elements of ``ring``.

        On abelian groups, a commutator-free method equals a Runge-Kutta method. The result contains the
        weights of this Runge-Kutta method. For compositions and splittings, the list is empty.
        """
        return list(_weights(self.ansatz.method(values, ring), ring))

    @cached_property
    def coefficients(self) -> Tape:
        """Return a program that computes coefficients of the method from the free coefficients.

        The first outputs are the free coefficients and all coefficients that depend on them
        (``ansatz.cells``). The remaining outputs are the weights b_i (:meth:`weights`).
        """
        ring = Traces(len(self.ansatz.free))
        cells = self.ansatz.coefficients(ring.inputs, ring)
        return Tape([*cells, *self.weights(ring.inputs, ring)], len(self.ansatz.free))

    @cached_property
    def positive(self) -> tuple[int, ...]:
        """Return the indices of the coefficients that must be positive. Index k refers to output k of the
        program :attr:`coefficients`. Constant weights are not included. Raises InputError if a constant
        weight is not positive."""
        names = self.ansatz.cells
        indices: list[int] = []
        for wish in self.spec.positive:
            places = [k for k, name in enumerate(names) if name == wish]
            if wish == "b":
                places = list(range(len(names), self.coefficients.size))
            if not places:
                raise InputError(
                    f"{wish!r}",
                    where="--positive",
                    expected=f"b (all weights), or one of the nonconstant coefficients {', '.join(names)}",
                )
            constants = self._constant_weights()
            indices += [k for k in places if k - len(names) not in constants]
            for i, value in constants.items():
                if wish == "b" and value <= 0:
                    raise InputError(
                        f"the constraints imply b{i + 1} = {value}",
                        where="--positive",
                        expected="constraints that allow positive weights",
                    )
        return tuple(indices)

    def _constant_weights(self) -> dict[int, Fraction]:
        """Return the weights that are rational constants. The key of b_i is i - 1."""
        ring = Traces(len(self.ansatz.free))
        constants = (x.constant for x in self.weights(ring.inputs, ring))
        return {i: x for i, x in enumerate(constants) if x is not None}

    def bounds(self, points: Floats) -> tuple[Floats, Floats]:
        """Return the violations of the bounds on the coefficients. Also return the derivatives of the
        violations with respect to the free coefficients. Each row of ``points`` contains values of the free
        coefficients, and gives one row of violations.

        If a bound is satisfied, its violation is zero. The bound of the option ``--size`` applies to the
        coefficients in the tableau file (``ansatz.cells``). For low-storage schemes, the bound also applies
        to the weights b_i (:meth:`weights`). For other commutator-free methods, the bound does not apply to
        b_i, because b_i is a sum of several coefficients.
        """
        values, slopes = self.coefficients.jacobians(points)
        rows, derivatives = [], []
        if self.positive:
            places = list(self.positive)
            required = values[:, places]
            # A coefficient between 0 and MARGIN is positive, so it is no violation.
            rows.append(np.where(required > 0, 0.0, MARGIN - required))
            derivatives.append(-slopes[:, places])
        if self.spec.size is not None:
            count = self.coefficients.size if self.ansatz.abelian else len(self.ansatz.cells)
            cells, sloped = values[:, :count], slopes[:, :count]
            rows.append(np.maximum(0.0, np.abs(cells) - float(self.spec.size)))
            derivatives.append(sloped * np.sign(cells)[..., None])
        if not rows:
            return values[:, :0], slopes[:, :0]
        beyond, sloped = np.concatenate(rows, axis=1), np.concatenate(derivatives, axis=1)
        return beyond, sloped * (beyond > 0)[..., None]

    def system(self, points: Floats) -> tuple[Floats, Floats]:
        """Return a matrix with one row for each point. Each row contains the residuals of the conditions at
        one point, followed by the violations of the bounds at this point (:meth:`bounds`). Also return the
        derivatives of the entries of the matrix with respect to the free coefficients."""
        values, slopes = self.tape.jacobians(points)
        beyond, sloped = self.bounds(points)
        return np.concatenate([values, beyond], axis=1), np.concatenate([slopes, sloped], axis=1)

    def starts(self, generator: np.random.Generator, count: int) -> Floats:
        """Return ``count`` random starting points near the point ``ansatz.centre``. If ``ansatz.centre`` is
        None, a default centre is used."""
        free = self.ansatz.free
        if self.ansatz.centre is not None:
            centre = np.array([self.ansatz.centre[name] for name in free])
            return centre + 0.4 * generator.standard_normal((count, len(free)))
        weights = [name for name in self.ansatz.cells if name[0] in "bg"]
        mean = np.array([1 / max(len(weights), 1) if name[0] in "bg" else 0.0 for name in free])
        return mean + 0.5 * generator.standard_normal((count, len(free)))


@lru_cache(maxsize=8)
def find_problem(label: str, order: int, spec: Spec, structure: str) -> Problem:
    """Return the :class:`Problem` of a search for methods of the given order in the family ``label``.
    ``structure`` is the name of the parametrisation of the coefficients. Problems are cached.

    >>> spec = Spec(stages=2)
    >>> find_problem("rk", 2, spec, "full") is find_problem("rk", 2, spec, "full")
    True
    """
    return Problem(label, order, spec, structure)


def _weights(method: Method, ring: Ring) -> list[Element]:
    if isinstance(method, RungeKutta):
        return list(method.b)
    return list(method.as_runge_kutta(ring).b) if isinstance(method, CommutatorFree) else []
