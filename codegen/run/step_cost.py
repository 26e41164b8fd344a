"""The cost model predicts the CPU time of a step.

A sweep is one iteration of a solver of implicit equations.

The predicted time is a sum of amounts of work, each multiplied by its weight (:data:`WEIGHTS`). The amounts
are:

- Operations (:mod:`codegen.kernel.operations`). Operations in a sweep are multiplied by the number of sweeps.
  Operations that compute a Newton matrix are multiplied by the number of Newton matrices. All other
  operations are counted once in each step.
- Unknowns. The times of the warm start and of the stopping rule are proportional to the number of unknowns.
- Corrections. Newton's method for equations u = g(u) multiplies the inverse matrix by g(u) - u. The next
  sweep must wait for this product. Each sweep of this method is counted as one correction.
- Cubes. The inversion of an n x n matrix by elimination is counted as n^3.

Evidence: ``benchmarks/solver_choice.py`` measures the time of emitted C for all implicit methods, solvers and
problems of the gallery. With the option ``--fit`` this program prints the non-negative weights that minimise
the sum of the squared relative errors of the predictions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass

from codegen.ir.kernel import Kernel, Loop
from codegen.kernel.operations import STEP, matrix_of, operations
from codegen.kernel.schedule import arrange

Work = Mapping[str, Mapping[str, int]]
"""The numbers of operations in the parts of a step (:func:`codegen.kernel.operations.operations`).

The parts are one sweep of each loop, the Newton matrix of each loop, and all other statements."""


@dataclass(frozen=True)
class Amounts:
    """Amounts of work, with one field for each kind of work.

    The weights of the cost model (:data:`WEIGHTS`) are also an object of this class.

    - ``unknowns`` is the number of unknowns.
    - ``swept`` is the number of unknowns times the number of sweeps, summed over all loops.
    - ``arithmetic`` is the number of additions, products and other operations of about one cycle.
    - ``divisions`` is the number of divisions.
    - ``calls`` is the number of function calls.
    - ``corrections`` is the number of sweeps of Newton's method for equations u = g(u). Each of these sweeps
      multiplies an inverse matrix by g(u) - u. Sweeps for equations r(u) = 0 are not included.
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
        # ``astuple`` lists all attributes of the class, so this line needs no change if an attribute is added
        # to the class.
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
"""The weights of the cost model in nanoseconds per unit of work, fitted by ``benchmarks/solver_choice.py``.

The choice of a solver depends only on the ratios of the weights.
"""


CHEAP = ("add", "mul", "choose", "fabs")
"""Operations that take about one cycle of a processor."""


def of_operations(counts: Mapping[str, int]) -> Amounts:
    """Return the amounts of work for ``counts``, the number of operations of each kind.

    >>> of_operations({"add": 2, "mul": 3, "div": 1, "stumpff_12": 4}) == Amounts(
    ...     arithmetic=5, divisions=1, calls=4
    ... )
    True
    """
    arithmetic, divisions = sum(counts.get(name, 0) for name in CHEAP), counts.get("div", 0)
    # Nearly all calls evaluate Stumpff functions of small arguments. These calls take about the same time.
    calls = sum(counts.values()) - arithmetic - divisions
    return Amounts(arithmetic=arithmetic, divisions=divisions, calls=calls)


def of_step(kernel: Kernel, work: Work) -> Amounts:
    """Return the amounts of work in a step, excluding the sweeps and matrices of the solvers."""
    # The time of the warm start is proportional to the number of unknowns in all substeps.
    unknowns = max(1, len(kernel.substeps)) * sum(len(loop.unknowns) for loop in kernel.loops)
    return of_operations(work[STEP]) + Amounts(unknowns=unknowns)


def of_sweep(loop: Loop, work: Work) -> Amounts:
    """Return the amounts of work in one sweep."""
    # A correction is the product of an inverse matrix and the vector g(u) - u. Each sweep of Newton's method
    # for equations u = g(u) computes one correction. For equations r(u) = 0 (``residuals`` is true), no
    # correction is counted.
    corrected = loop.newton is not None and not loop.newton.residuals
    return of_operations(work[loop.label]) + Amounts(swept=len(loop.unknowns), corrections=int(corrected))


def of_matrix(loop: Loop, work: Work) -> Amounts:
    """Return the amounts of work for one matrix and its inversion.

    Fixed-point iteration has no matrix, so all amounts are zero.
    """
    if loop.newton is None:
        return Amounts()
    return of_operations(work[matrix_of(loop.label)]) + inversion(
        # If a formula computes the inverse, ``work`` contains the operations of the formula. Then no
        # elimination is counted.
        0 if loop.newton.inverted else len(loop.unknowns)
    )


def inversion(n: int) -> Amounts:
    """Return the amounts of work for the inversion of an n x n matrix."""
    # The predicted time of the inversion is n^3 times the constant ``WEIGHTS.cubes``.
    return Amounts(cubes=n**3)


class StepCost:
    """Predicts the cost of a step of one kernel.

    ``sweeps[k]`` is the average number of sweeps that loop k of the kernel makes in a step. ``matrices[k]``
    is the average number of matrices that loop k computes in a step.
    """

    def __init__(self, kernel: Kernel) -> None:
        # ``work`` stores the operation counts, because the choice of a solver reads the counts many times.
        self.kernel, self.work = kernel, operations(arrange(kernel))

    def amounts(self, sweeps: Sequence[float], matrices: Sequence[float]) -> Amounts:
        """Return the amounts of work in a step."""
        total = of_step(self.kernel, self.work)
        for k, (n, m) in enumerate(zip(sweeps, matrices, strict=True)):
            total += self.block(k, n, m)
        return total

    def block(self, k: int, sweeps: float, matrices: float) -> Amounts:
        """Return the work of the loop with the index ``k`` in one step.

        On average, the loop makes ``sweeps`` sweeps and computes ``matrices`` matrices in a step.
        """
        loop = self.kernel.loops[k]
        return of_sweep(loop, self.work).times(sweeps) + of_matrix(loop, self.work).times(matrices)

    def step(self, sweeps: Sequence[float], matrices: Sequence[float]) -> float:
        """Return the predicted time of a step in nanoseconds."""
        return self.amounts(sweeps, matrices).cost(WEIGHTS)
