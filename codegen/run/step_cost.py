"""The cost model: predicted CPU time of a step, from counts of operations, sweeps and matrices.

A prediction is a sum of amounts times :data:`WEIGHTS`:

- operations (:mod:`codegen.kernel.operations`): operations of a sweep count in each sweep, and operations of
  a matrix count each time that the matrix is computed. All other operations count once in each step.
- unknowns: the warm start takes time for each unknown once in a step. The stopping rule takes time for each
  unknown in each sweep.
- corrections: a sweep of Newton's method on u = g(u) ends with the product of the inverse and the residuals
  g(u) - u. The next sweep cannot begin before this product is computed, so each sweep adds one correction.
  For blocks in the form r(u) = 0 (not u = g(u)), the sweep already includes the time of this product, and no
  correction is added.
- cubes: if there is no closed formula for the inverse of an n x n matrix, its numerical inversion counts n^3.

Evidence: ``benchmarks/solver_choice.py`` measures the time of emitted C for all implicit methods, solvers and
scenes of the gallery. It writes predictions and measurements into ``benchmarks/README.md``. With the option
``--fit`` it prints the weights that fit the measurements best. They minimise the sum of squared relative
errors, under the condition that no weight is negative.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass

from codegen.ir.kernel import Kernel, Loop
from codegen.kernel.operations import STEP, matrix_of, operations
from codegen.kernel.schedule import arrange

Work = Mapping[str, Mapping[str, int]]
"""The counts of operations for each part of a step (:func:`codegen.kernel.operations.operations`)."""


@dataclass(frozen=True)
class Amounts:
    """Amounts of work, with one field for each kind of work.

    The weights have the same type. Their fields are the nanoseconds that one unit of each kind takes.

    - ``unknowns``: the unknowns of a step, counted once.
    - ``swept``: the unknowns, counted in each sweep.
    - ``arithmetic``: additions, products and other operations of about one cycle.
    - ``divisions``: the divisions.
    - ``calls``: function calls.
    - ``corrections``: the sweeps of Newton's method on u = g(u).
    - ``cubes``: the sum of n^3 over all inversions of n x n matrices.
    """

    unknowns: float = 0.0
    swept: float = 0.0
    arithmetic: float = 0.0
    divisions: float = 0.0
    calls: float = 0.0
    corrections: float = 0.0
    cubes: float = 0.0

    def __add__(self, other: Amounts) -> Amounts:
        # Fields are added by position, so that a new kind of work needs no change of this method.
        return Amounts(*(a + b for a, b in zip(astuple(self), astuple(other), strict=True)))

    def times(self, factor: float) -> Amounts:
        """Return the amounts multiplied by ``factor``."""
        return Amounts(*(factor * x for x in astuple(self)))

    def cost(self, weights: Amounts) -> float:
        """Return the sum of amounts times weights.

        >>> Amounts(unknowns=3, calls=1).cost(Amounts(unknowns=2, calls=10))
        16.0
        """
        return float(sum(a * b for a, b in zip(astuple(self), astuple(weights), strict=True)))


WEIGHTS = Amounts(
    unknowns=2.1, swept=1.7, arithmetic=0.097, divisions=1.5, calls=3.4, corrections=6.1, cubes=0.26
)
"""The weights: nanoseconds for one unit of each amount, on the machine of the measurements.

The choice of a solver depends only on the ratios of these weights."""


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
    # All calls count alike, because nearly all of them compute Stumpff functions of small arguments by short
    # polynomials.
    calls = sum(counts.values()) - arithmetic - divisions
    return Amounts(arithmetic=arithmetic, divisions=divisions, calls=calls)


def of_step(kernel: Kernel, work: Work) -> Amounts:
    """Return the amounts of work in one step, without its sweeps and matrices."""
    # The counts of operations already include all substeps. They do not include the warm start, whose work is
    # proportional to the number of unknowns of all substeps.
    unknowns = max(1, len(kernel.substeps)) * sum(len(loop.unknowns) for loop in kernel.loops)
    return of_operations(work[STEP]) + Amounts(unknowns=unknowns)


def of_sweep(loop: Loop, work: Work) -> Amounts:
    """Return the amounts of work in one sweep."""
    # The next sweep reads the corrected unknowns. A processor cannot begin it before the product of the
    # inverse and the residuals is computed.
    corrected = loop.newton is not None and not loop.newton.residuals
    return of_operations(work[loop.label]) + Amounts(swept=len(loop.unknowns), corrections=int(corrected))


def of_matrix(loop: Loop, work: Work) -> Amounts:
    """Return the amounts of work for one matrix and its inversion; zero for fixed-point iteration."""
    if loop.newton is None:
        return Amounts()
    return of_operations(work[matrix_of(loop.label)]) + inversion(
        # If a formula computes the inverse, its operations are already counted in the kernel.
        0 if loop.newton.inverted else len(loop.unknowns)
    )


def inversion(n: int) -> Amounts:
    """Return the amounts of work for the inversion of an n x n matrix."""
    # The weight of the cubes contains the constant factor of the elimination.
    return Amounts(cubes=n**3)


class StepCost:
    """The predicted cost of a kernel's steps.

    The arguments ``sweeps`` and ``matrices`` of the methods are average numbers per step, for each block.
    """

    def __init__(self, kernel: Kernel) -> None:
        # Operations are counted once, because the choice of a solver uses the same counts many times.
        self.kernel, self.work = kernel, operations(arrange(kernel))

    def amounts(self, sweeps: Sequence[float], matrices: Sequence[float]) -> Amounts:
        """Return the amounts of work in a step."""
        total = of_step(self.kernel, self.work)
        for k, (n, m) in enumerate(zip(sweeps, matrices, strict=True)):
            total += self.block(k, n, m)
        return total

    def block(self, k: int, sweeps: float, matrices: float) -> Amounts:
        """Return the amounts of work that block number ``k`` adds to a step."""
        # The numbers are averages over several steps, so they may be fractions.
        loop = self.kernel.loops[k]
        return of_sweep(loop, self.work).times(sweeps) + of_matrix(loop, self.work).times(matrices)

    def step(self, sweeps: Sequence[float], matrices: Sequence[float]) -> float:
        """Return the predicted nanoseconds of a step."""
        return self.amounts(sweeps, matrices).cost(WEIGHTS)
