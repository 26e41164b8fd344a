"""The cost model: predicted CPU time of a step, from counts of operations, sweeps and matrices.

The predicted time is a sum of amounts of work, each multiplied by its weight (:data:`WEIGHTS`). The amounts
are:

- Operations (:mod:`codegen.kernel.operations`). The operations of a sweep are counted in each sweep. The
  operations of a matrix are counted each time that the matrix is computed. All other operations are counted
  once in each step.
- Unknowns. In each step, the warm start takes some time for each unknown. In each sweep, the stopping rule
  takes some time for each unknown.
- Corrections. For equations u = g(u), a sweep of Newton's method ends with the product of the inverse and the
  residuals g(u) - u. The next sweep cannot begin before this product is computed. This delay is counted as
  one correction in each sweep. For equations in the form r(u) = 0, no corrections are counted.
- Cubes. If no formula computes the inverse of an n x n matrix, its numerical inversion is counted as n^3.

Evidence: ``benchmarks/solver_choice.py`` measures the time of emitted C for all implicit methods, solvers and
problems of the gallery. It writes predictions and measurements into ``benchmarks/README.md``. With the option
``--fit`` it prints the weights that minimise the sum of the squared relative errors of the predictions. No
weight may be negative.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass

from codegen.ir.kernel import Kernel, Loop
from codegen.kernel.operations import STEP, matrix_of, operations
from codegen.kernel.schedule import arrange

Work = Mapping[str, Mapping[str, int]]
"""The counts of operations for each part of a step: its sweeps, its matrices, and the rest of the step
(:func:`codegen.kernel.operations.operations`)."""


@dataclass(frozen=True)
class Amounts:
    """Amounts of work, with one field for each kind of work.

    The weights of the cost model (:data:`WEIGHTS`) are also an object of this class. Each of their fields is
    the time of one unit of work in nanoseconds.

    - ``unknowns`` is the number of unknowns, counted once in a step.
    - ``swept`` is the number of unknowns, added once for each sweep.
    - ``arithmetic`` is the number of additions, products and other operations of about one cycle.
    - ``divisions`` is the number of divisions.
    - ``calls`` is the number of function calls.
    - ``corrections`` is the number of sweeps of Newton's method for equations u = g(u).
    - ``cubes`` is the sum of n^3 over all inversions of n x n matrices.
    """

    unknowns: float = 0.0
    swept: float = 0.0
    arithmetic: float = 0.0
    divisions: float = 0.0
    calls: float = 0.0
    corrections: float = 0.0
    cubes: float = 0.0

    def __add__(self, other: Amounts) -> Amounts:
        # The fields are added by position, so this method also works if a field is added to the class.
        return Amounts(*(a + b for a, b in zip(astuple(self), astuple(other), strict=True)))

    def times(self, factor: float) -> Amounts:
        """Return the amounts multiplied by ``factor``."""
        return Amounts(*(factor * x for x in astuple(self)))

    def cost(self, weights: Amounts) -> float:
        """Return the sum of all amounts, each multiplied by its weight.

        >>> Amounts(unknowns=3, calls=1).cost(Amounts(unknowns=2, calls=10))
        16.0
        """
        return float(sum(a * b for a, b in zip(astuple(self), astuple(weights), strict=True)))


WEIGHTS = Amounts(
    unknowns=2.1, swept=1.7, arithmetic=0.097, divisions=1.5, calls=3.4, corrections=6.1, cubes=0.26
)
"""The weights: the nanoseconds that one unit of each kind of work took in the measurements.

The choice of a solver depends only on the ratios of the weights, and not on the speed of the machine."""


CHEAP = ("add", "mul", "choose", "fabs")
"""Operations that take about one cycle of a processor."""


def of_operations(counts: Mapping[str, int]) -> Amounts:
    """Return the amounts of work for counted operations.

    >>> of_operations({"add": 2, "mul": 3, "div": 1, "stumpff_12": 4}) == Amounts(
    ...     arithmetic=5, divisions=1, calls=4
    ... )
    True
    """
    arithmetic, divisions = sum(counts.get(name, 0) for name in CHEAP), counts.get("div", 0)
    # All calls have the same weight. Nearly all of them compute Stumpff functions of small arguments by short
    # polynomials, which take about the same time.
    calls = sum(counts.values()) - arithmetic - divisions
    return Amounts(arithmetic=arithmetic, divisions=divisions, calls=calls)


def of_step(kernel: Kernel, work: Work) -> Amounts:
    """Return the amounts of work that occur once in a step. The work of sweeps and matrices is not
    included."""
    # The counts of operations include all substeps, but not the warm start. The work of the warm start is
    # proportional to the number of unknowns in all substeps.
    unknowns = max(1, len(kernel.substeps)) * sum(len(loop.unknowns) for loop in kernel.loops)
    return of_operations(work[STEP]) + Amounts(unknowns=unknowns)


def of_sweep(loop: Loop, work: Work) -> Amounts:
    """Return the amounts of work in one sweep."""
    # For equations u = g(u), the next sweep reads unknowns that were corrected by the product of the inverse
    # and the residuals. A processor cannot begin the sweep before this product is computed.
    corrected = loop.newton is not None and not loop.newton.residuals
    return of_operations(work[loop.label]) + Amounts(swept=len(loop.unknowns), corrections=int(corrected))


def of_matrix(loop: Loop, work: Work) -> Amounts:
    """Return the amounts of work for one matrix and its inversion; zero for fixed-point iteration."""
    if loop.newton is None:
        return Amounts()
    return of_operations(work[matrix_of(loop.label)]) + inversion(
        # If a formula computes the inverse, the operations of the formula are already counted.
        0 if loop.newton.inverted else len(loop.unknowns)
    )


def inversion(n: int) -> Amounts:
    """Return the amounts of work for the inversion of an n x n matrix."""
    # The elimination takes a constant times n^3 operations. The weight of ``cubes`` contains this constant.
    return Amounts(cubes=n**3)


class StepCost:
    """Predicts the cost of a step of one kernel.

    The functions of this class have the arguments ``sweeps`` and ``matrices``. These are the average numbers
    of sweeps and of matrices in a step, with one number for each block of equations. The function ``block``
    gets only the numbers of one block.
    """

    def __init__(self, kernel: Kernel) -> None:
        # The operations are counted only once, in this constructor, because the choice of a solver reads the
        # counts many times.
        self.kernel, self.work = kernel, operations(arrange(kernel))

    def amounts(self, sweeps: Sequence[float], matrices: Sequence[float]) -> Amounts:
        """Return the amounts of work in a step."""
        total = of_step(self.kernel, self.work)
        for k, (n, m) in enumerate(zip(sweeps, matrices, strict=True)):
            total += self.block(k, n, m)
        return total

    def block(self, k: int, sweeps: float, matrices: float) -> Amounts:
        """Return the amounts of work that block number ``k`` adds to a step."""
        # ``sweeps`` and ``matrices`` are averages over several steps, so they may be fractions.
        loop = self.kernel.loops[k]
        return of_sweep(loop, self.work).times(sweeps) + of_matrix(loop, self.work).times(matrices)

    def step(self, sweeps: Sequence[float], matrices: Sequence[float]) -> float:
        """Return the predicted time of a step in nanoseconds."""
        return self.amounts(sweeps, matrices).cost(WEIGHTS)
