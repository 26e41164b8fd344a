"""Tests three properties of a method: symplecticity, symmetry, and no drift of a conserved quantity.

Table 2.1 of H. Marthinsen's thesis *On symplectic integration in Lie groups and manifolds* has a column for
each of the three properties. Symplecticity and symmetry are tested with more digits than doubles have.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from codegen.emitter import Compiled
from codegen.integrator import StepFailed
from codegen.ir.domain import NotConverged, PreciseDomain
from codegen.lab.distance import distance
from codegen.lab.long_runs.drift import ROUNDING
from codegen.lab.long_runs.long_run import LongRun
from codegen.lab.long_runs.rounding_growth import exactly_conserved
from codegen.lab.long_runs.symplecticity import symplectic_defect
from codegen.lab.runner import Emitted
from codegen.lab.stability.extreme_steps import DIGITS, solutions, solved_step
from codegen.lower import problem_for
from codegen.method import Method
from orderconds.tableau.uncertainty import uncertainty

SYMPLECTIC = 1e-24
"""A step counts as symplectic if its symplectic defect is below this number.

The defect of symplectic steps is at most the error of the finite differences. This error is usually about
1e-50. If components of the state differ by a factor of 1e12, this error is about 1e-26
(:data:`~codegen.lab.long_runs.symplecticity.OFFSET`). The defect of other steps is proportional to a
power of the step size. For small steps, this defect can be far below the precision of doubles, so the limit
must be far below this precision, too.
"""

ROUNDED = 1e-12
"""The limit for the symplectic defect of a method whose coefficients are rounded, for example to doubles.

This limit replaces :data:`SYMPLECTIC` if the coefficients have fewer than :data:`ACCURATE` bits. The rounding
of the coefficients, about 1e-16 for doubles, causes a defect also in symplectic methods. For the same reason,
this limit also replaces :data:`SYMMETRIC`.
"""

ACCURATE = 100
"""The limits are :data:`SYMPLECTIC` and :data:`SYMMETRIC` if the coefficients of the method are known to at
least ACCURATE bits, and otherwise :data:`ROUNDED`. 100 bits are about 30 decimal digits.
"""

SYMMETRIC = 1e-30
"""A step counts as symmetric if the distance computed by :func:`reversal` is below this number."""

VISIBLE = 1e-3
"""If a step differs from two steps of half the size by more than VISIBLE, its error is visible.

The difference is divided by the change of the state.
"""


@dataclass(frozen=True)
class Properties:
    """The measured properties of a method. A property that was not measured is None.

    - ``symplectic``, ``symmetric``: True if the method has the property.
    - ``steady``: False if the deviation of the first conserved quantity grows over many steps. None if
      rounding errors hide the deviation that the method causes.
    - ``quantity``: the name of the first conserved quantity, or '' if there is none.
    - ``reversal``: the result of :func:`reversal`.
    """

    method: str
    symplectic: bool | None
    symmetric: bool | None
    steady: bool | None
    quantity: str
    reversal: float | None

    def as_json(self) -> dict[str, object]:
        """Return the properties as a dictionary of plain data for JSON."""
        return {
            "symplectic": self.symplectic,
            "symmetric": self.symmetric,
            "no_drift": self.steady,
            "quantity": self.quantity,
            "reversal": self.reversal,
        }


def properties(compiled: Compiled, run: LongRun) -> Properties:
    """Return the properties of a method. ``run`` contains the results of a long run of the method.

    If the steps of the run are short, the symplectic defect and :func:`reversal` of any method of high order
    are below the limits. Therefore both are also computed for the step size :func:`revealing_size`.
    """
    runner, rounded = Emitted(compiled), _is_rounded(compiled.method)
    size = revealing_size(compiled, runner, run.h)
    back, defect = reversal(compiled, size), run.symplectic
    if defect is not None and size != run.h:
        defect = _defect(compiled, runner, size, defect)
    kept = run.kept[0] if run.kept and not run.failure else None
    drifts = None if kept is None else kept.drift.drifts
    if kept is not None and kept.drift.law == ROUNDING:
        # Rounding errors can hide a drift. Therefore ``drifts`` is False only if the method conserves the
        # quantity exactly, and otherwise None (unknown).
        start = float(compiled.scene.span[0]), runner.initial
        drifts = False if kept.name in exactly_conserved(compiled, [start], size) else None
    return Properties(
        run.method,
        None if defect is None else defect < (ROUNDED if rounded else SYMPLECTIC),
        None if back is None else back < (ROUNDED if rounded else SYMMETRIC),
        None if drifts is None else not drifts,
        "" if kept is None else kept.name,
        back,
    )


def _is_rounded(method: Method) -> bool:
    """Return True if the coefficients of the method are known to fewer than :data:`ACCURATE` bits."""
    tableau = method.coefficients
    return tableau is not None and (tableau.doubles or uncertainty(tableau, ACCURATE) != "")


def revealing_size(compiled: Compiled, runner: Emitted, h: float) -> float:
    """Return ``h``, doubled until a step of twice the size would have a visible error (:data:`VISIBLE`).

    The steps start at the initial state. The doubling also ends if a step fails, or if a step of twice the
    size would be longer than the time span of the scene.
    """
    first, last = map(float, compiled.scene.span)
    start = runner.initial
    while 2 * abs(h) <= abs(last - first):
        try:
            coarse, fine = (runner.integrator.run(start, size, n, first) for size, n in ((2 * h, 1), (h, 2)))
        except StepFailed:
            break
        change = distance(compiled.scene, fine, start)
        if not distance(compiled.scene, coarse, fine) <= VISIBLE * change < math.inf:
            break
        h *= 2
    return h


def _defect(compiled: Compiled, runner: Emitted, h: float, known: float) -> float | None:
    """Return the larger of ``known`` and the symplectic defect of a step of size ``h`` from the start.

    The result is None if the step cannot be computed with many digits.
    """
    first = float(compiled.scene.span[0])
    try:
        near = solutions(runner, runner.initial, first, h)
        return max(known, symplectic_defect(compiled, runner.initial, h, first, near))
    except (ArithmeticError, ValueError):
        return None


def reversal(compiled: Compiled, h: float) -> float | None:
    """Return the distance from the start after a step of size h and a step of size -h.

    The distance is divided by the change of the state in the step of size h. The result is None if a step
    fails or if the step of size h does not change the state.
    """
    problem, domain = problem_for(compiled.scene, compiled.method), PreciseDomain(0, DIGITS)
    runner, start = Emitted(compiled), problem.initial(domain)
    t = domain.context.mpf(float(compiled.scene.span[0]))
    try:
        first = solved_step(compiled, runner, start, t, h)
        after = solved_step(compiled, runner, first, t + h, h)
        back = solved_step(compiled, runner, after, t + 2 * h, -h)
    except (NotConverged, ArithmeticError, ValueError):
        return None
    change = distance(compiled.scene, after, first)
    return distance(compiled.scene, back, first) / change if change > 0 else None
