"""Kernels: a step as scalar assignments and loops that solve equations, ready for a printer.

Each name in a kernel is assigned once. A :class:`Loop` solves u = g(u) for its unknowns u. The values g(u)
are called images. Each sweep of a loop replaces the unknowns by their images, or corrects the unknowns by
Newton's method. A :class:`Start` sets the first values of the unknowns of all loops. A kernel has no branches
that depend on data, apart from its loops.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from codegen.ir.array_step import ArrayStep
from codegen.ir.expr import Expr, walk
from codegen.ir.linear_array_step import LinearArrayStep
from codegen.ir.mode_step import ModeStep
from codegen.ir.number import Number
from codegen.ir.program import Substep
from codegen.ir.site_step import SiteStep

LEAD = "lead.h"
"""The symbol for the duration of the last flow of a step. Between two steps of a run, the last flow of one
step and the first flow of the next step are joined. The symbol contains a dot, so it differs from every name
in a scene.
"""

ELAPSED = "elapsed.h"
"""The symbol for the total duration of several steps, at most :data:`LONGEST`. Some flows are applied only
once for all these steps (:class:`Deferred`).
"""

LONGEST = 256
"""The largest number of steps for which a flow is applied only once (:class:`Deferred`). The limit bounds the
angles of this flow, and thus the rounding errors of the angles.
"""

FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON = "fixed-point", "newton", "simplified-newton"
"""The names of the methods that solve implicit equations."""

SLOWEST = 2.0**-12
"""The smallest contraction factor that is assumed for a sweep. It replaces smaller measured factors, which
are unreliable near rounding level.
"""

UNIT = 2.0**-53
"""Half the distance from 1 to the next larger double: the largest relative rounding error of a double."""

LOST = 2.0**-47
"""A change below this fraction of the largest number in a field of the state counts as a rounding error."""

VARIATION = "variation"
"""The name of the field of the state that contains a variation, that is, a derivative of the state."""

VARIED = "the variation of "
"""The prefix of the labels of loops that solve equations for a variation, a derivative of the state."""


@dataclass(frozen=True)
class Let:
    """The assignment name = value."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Newton:
    """Newton's method for u = g(u). ``matrix`` is 1 - g'(u), and ``body`` computes its entries.

    - ``leading``: the matrix is expanded to leading order in h, and is computed and inverted in each step. If
      ``leading`` is false, the matrix is reused in later sweeps and steps (:mod:`codegen.run.sweeps`).
    - ``inverted``: ``matrix`` contains the entries of the inverse matrix.
    - ``residuals``: the images of the loop are residuals, which are zero at the solution. In this case the
      matrix is minus the derivative of the residuals to first order in h. Its inverse is used for ``period``
      steps.
    - ``changes``: the names of the last changes of the unknowns.
    """

    body: tuple[Let, ...]
    matrix: tuple[tuple[Expr, ...], ...]
    leading: bool = False
    inverted: bool = False
    residuals: bool = False
    changes: tuple[str, ...] = ()

    # If a sweep reduces the change by less than a factor of 2^6, the matrix is computed again.
    CONTRACTION: ClassVar[float] = 2.0**-6

    @property
    def period(self) -> int:
        """The number of steps for which an inverse is used, or 0 if it is used as long as the loop contracts.

        The cost of the inverse of an n x n matrix is proportional to n^3. With a longer period the inverse is
        computed less often, but an older inverse is less accurate, so a step takes more sweeps.
        """
        # An inverse costs O(n^3) and is used for about n/2 steps, so it adds O(n^2) operations to each step.
        return max(1, len(self.matrix) // 2) if self.residuals else 0


@dataclass(frozen=True)
class Loop:
    """A loop that solves the equations unknowns = images by iteration.

    ``body`` computes the images. The loop ends when the changes of the unknowns are at rounding level.

    ``label`` is the name of the equations in messages and statistics, for example "stage 2". ``starts`` are
    the first values of the unknowns. They are empty if a :class:`Start` computes the first values.

    The change of the unknowns in a sweep is images - unknowns. If ``newton`` is given, the inverse of
    ``newton.matrix`` is applied to this difference. The last change is applied only if ``newton`` is given.

    The stopping rule (:mod:`codegen.run.stopping`) uses these numbers:
    - ``tolerance``: if the change is below this multiple of the largest unknown and no longer decreases, the
      loop ends.
    - ``close``: if the change is below this bound and the rate of convergence predicts a small error, the
      loop ends.
    - ``limit``: the largest number of sweeps.
    - ``only_unknowns_read``: no values of the body are used after the loop, so the loop may end at a larger
      change.
    """

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    body: tuple[Let, ...]
    images: tuple[Expr, ...]
    # A tolerance of one rounding unit would be too small, because each sweep adds many rounding errors.
    tolerance: float = 2.0**-44
    limit: int = 100
    newton: Newton | None = None
    only_unknowns_read: bool = False

    @property
    def solver(self) -> str:
        """The name of the method that solves the equations."""
        if self.newton is None:
            return FIXED_POINT
        return SIMPLIFIED_NEWTON if self.newton.leading else NEWTON

    @property
    def close(self) -> float:
        """The largest change of the unknowns at which the test of the rate of convergence may end the loop.

        Statements after the loop may use values of the body, which were computed before the last change. The
        error of these values is about h L times this change, where L is the Lipschitz constant of the images.
        Simplified Newton converges at the rate (h L)^2, so h L is small at the end of the loop.
        """
        # If only the unknowns are used after the loop, only the error of the unknowns matters, which is
        # smaller than their last change.
        if self.only_unknowns_read and not (self.newton is not None and self.newton.residuals):
            return 16 * self.tolerance
        # A loop without a first-order matrix may also converge if h L is not small. Its bound is therefore
        # smaller.
        first_order = self.solver == SIMPLIFIED_NEWTON or (self.newton is not None and self.newton.residuals)
        return self.tolerance if first_order else self.tolerance / 16


@dataclass(frozen=True)
class Start:
    """Set the first values of the unknowns of an iteration.

    If no solutions of earlier steps are known, the unknowns are set to ``values``, which ``body`` computes.
    Otherwise the polynomial through the last solutions is extrapolated by one step. With the solutions u1,
    u2, ... (latest first), the extrapolations of degree 0, 1 and 2 are u1, 2 u1 - u2 and 3 u1 - 3 u2 + u3. At
    most ``depth`` solutions are stored. The degree grows while the differences of the solutions decrease. If
    the estimated error of an extrapolation exceeds ``ROUGH`` times the change of the unknowns in the step,
    all solutions except u1 are dropped.

    If the loops do not converge, the step size is halved until they converge. The solution for a small step
    size provides the first values for a larger step size, until the whole step is solved (continuation in h).
    The continuation fails after ``TRIES`` step sizes. It also fails if the loops do not converge although the
    step size has grown only by the fraction ``SHORTEST``.
    """

    unknowns: tuple[str, ...]
    body: tuple[Let, ...]
    values: tuple[Expr, ...]
    depth: int = 16

    # The extrapolation of degree 0 is u1, and its error is the change of the unknowns. An extrapolation of a
    # higher degree whose error exceeds half of this change is hardly better than u1.
    ROUGH: ClassVar[float] = 0.5
    # The limit ``TRIES`` is hardly ever reached. Each try halves the step until a step converges, so 100
    # tries reach 2^-100 h.
    TRIES: ClassVar[int] = 100
    # The factor from one step size to the next is at most 4. A failure after a success replaces the factor by
    # its square root. After nine such failures in a row the factor is at most 4^(1/2^9) < 1 + 2^-8.
    SHORTEST: ClassVar[float] = 2.0**-8


@dataclass(frozen=True)
class Field:
    """A named part of the state, the input or the output, with the names of its scalars in order."""

    name: str
    symbols: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class Deferred:
    """The flows that a run of several steps applies only once, before its first step or after its last step.

    A single step calls ``begin``, the kernel, and ``finish``. A run of several steps calls ``begin`` once,
    the kernel once for each step, and ``finish`` once. A long run is divided into runs of at most
    :data:`LONGEST` steps.

    The last flow of the kernel has the duration :data:`LEAD`. The duration is ``last`` times h in a single
    step and in the last step of a run, and ``later`` times h in all other steps. The symbol :data:`ELAPSED`
    is the duration of the single step or of the whole run.
    """

    begin: Kernel | None
    finish: Kernel | None
    last: Number
    later: Number

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """The kernels ``begin`` and ``finish``, if there are any."""
        return tuple(kernel for kernel in (self.begin, self.finish) if kernel is not None)


@dataclass(frozen=True)
class Carried:
    """The momentum m in the body frame. A run stores m in place of the space momentum mu.

    The conversions are m = ``inward``(q, mu) and mu = ``outward``(q, m). The momentum begins at the index
    ``first`` of the state. The kernel maps (q, m) to (q', m'). A run of several steps computes m once, calls
    the kernel once for each step, and computes mu' once. The new space momentum is mu' = mu + outward(q', m')
    - outward(q, m). Rounding makes q slightly non-orthogonal. In the formula for mu' this error affects only
    the change of the momentum.
    """

    inward: Kernel
    outward: Kernel
    first: int


@dataclass(frozen=True)
class Sample:
    """The inputs at one time of the step. ``symbols`` are in the order of ``Kernel.inputs``."""

    time: Expr
    symbols: tuple[str, ...]


@dataclass(frozen=True)
class Estimate:
    """An error estimate: the new state minus an embedded solution of lower order.

    After one step from the same state, both solutions differ from the exact flow by O(h^order). ``errors``
    contains the components of the estimate. It is empty if the kernel computes with whole matrices.
    """

    errors: tuple[Expr, ...]
    order: int


@dataclass(frozen=True)
class Expansion:
    """The Taylor polynomial of the solution at a state.

    The outputs of ``coefficients`` are the coefficients 1, ..., ``degree`` of the state, one order after the
    other. If the polynomial is in other coordinates than the state, ``enter`` computes the coordinates of the
    state, and ``leave`` computes the new state. Otherwise ``enter`` and ``leave`` are None. If ``controlled``
    is true, a run may choose the step size from the coefficients.

    If ``following`` is given, a loop over the order n computes the coefficients
    (:class:`codegen.ir.taylor_loop.OrderLoop`). In this case ``coefficients`` has two groups of outputs:
    values of order 0 that all later orders use, and the coefficients of order 1. The loop computes ``sums``
    inner sums a_1 b_(n-1) + ... + a_(n-1) b_1. ``following`` has three groups of outputs: the values a_n, the
    values b_n, and the coefficients of order n + 1.
    """

    degree: int
    coefficients: Kernel
    enter: Kernel | None
    leave: Kernel | None
    following: Kernel | None = None
    sums: int = 0
    controlled: bool = True


@dataclass(frozen=True)
class Continuous:
    """A continuous extension of order ``order``: the solution at the time t + theta h is exp(sigma(theta)).y.

    Here y is the state at the time t, and sigma is a polynomial in theta with values in the Lie algebra. The
    outputs of ``coefficients`` are the coefficients of theta, ..., theta^``degree`` of sigma, one after the
    other. ``moved`` computes exp(x).y from a state y and the coordinates x of an algebra element.
    """

    coefficients: Kernel
    moved: Kernel
    degree: int
    order: int


@dataclass(frozen=True)
class Observed:
    """The data of a run to a given end time.

    The run writes the states at given output times, and finds the zeros of event functions. The caller
    supplies ``events`` such functions. The ``extension`` computes the states at output times. If
    ``extension`` is None, the run takes shorter steps that end at the output times.
    """

    events: int = 0
    extension: Continuous | None = None


@dataclass(frozen=True)
class Function:
    """A function that a kernel calls in several places. It evaluates ``body`` and returns ``outputs``.

    In expressions, a call of ``NAME.k`` returns output k of the function NAME. ``about`` describes the
    function in words.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Let, ...]
    outputs: tuple[Expr, ...]
    about: str


@dataclass(frozen=True)
class Kernel:
    """One step: the state, scalar inputs (h, t, run-time parameters), the statements, and the new state.

    - ``inputs`` are the names of functions of time that the caller supplies. ``samples`` are the times at
      which these functions are evaluated.
    - ``vary`` is the kernel of the variational equation. Its outputs are the derivative of the new state.
    - ``substeps`` are the parts of a composed step. The kernel is called once for each part.
    - ``outlined`` are functions that the expressions of the kernel call.
    - ``carried``: the kernel uses the body momentum in place of the space momentum.
    - ``expansion`` or ``estimate``: emitted code can have a run with step-size control.
    - ``batch``: emitted code also has a function that steps many independent systems.
    - ``observed``: emitted code also has a run to a given end time.

    A kernel without ``outputs`` evaluates the polynomial of its ``expansion``, or executes a step on large
    matrices (``arrays``), on a lattice (``sites``) or on Fourier modes (``modes``).
    """

    name: str
    state: tuple[Field, ...]
    scalars: tuple[str, ...]
    body: tuple[Let | Start | Loop, ...]
    outputs: tuple[Expr, ...]
    deferred: Deferred | None = None
    inputs: tuple[str, ...] = ()
    samples: tuple[Sample, ...] = ()
    estimate: Estimate | None = None
    vary: Kernel | None = None
    substeps: tuple[Substep, ...] = ()
    outlined: tuple[Function, ...] = ()
    carried: Carried | None = None
    expansion: Expansion | None = None
    arrays: ArrayStep | LinearArrayStep | None = None
    batch: bool = False
    observed: Observed | None = None
    sites: SiteStep | None = None
    modes: ModeStep | None = None

    @property
    def adaptive(self) -> bool:
        """True if the emitted code contains a run that chooses its step sizes."""
        # A run needs an error estimate or Taylor coefficients to choose its step sizes.
        return self.estimate is not None or (self.expansion is not None and self.expansion.controlled)

    @property
    def loops(self) -> tuple[Loop, ...]:
        """Every loop in order."""
        return tuple(s for s in self.body if isinstance(s, Loop))

    @property
    def start(self) -> Start | None:
        """The statement that computes the first values of all unknowns, if there is one."""
        # A kernel has at most one Start, before its first loop.
        return next((s for s in self.body if isinstance(s, Start)), None)

    def lets(self) -> Iterator[Let]:
        """Yield every assignment, including the assignments inside loops."""
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement
                continue
            yield from statement.body
            # Newton's method has assignments of its own for the entries of its matrix.
            if isinstance(statement, Loop) and statement.newton is not None:
                yield from statement.newton.body

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression, in order."""
        # The times of the inputs come first, because the inputs are evaluated before the step.
        yield from (sample.time for sample in self.samples)
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement.value
                continue
            yield from (let.value for let in statement.body)
            if isinstance(statement, Start):
                yield from statement.values
                continue
            # The other statements are loops.
            yield from (*statement.starts, *statement.images)
            if statement.newton is not None:
                yield from (let.value for let in statement.newton.body)
                yield from (x for row in statement.newton.matrix for x in row)
        yield from self.outputs
        if self.arrays is not None:
            yield from self.arrays.expressions()
        if self.sites is not None:
            yield from self.sites.expressions()
        if self.modes is not None:
            yield from self.modes.expressions()
        if self.estimate is not None:
            yield from self.estimate.errors

    def functions(self) -> tuple[str, ...]:
        """Return the scalar functions that are called, sorted."""
        # The order of a set is not fixed, so the names are sorted.
        return tuple(sorted({n.payload for n in walk(self.expressions()) if n.op == "call"}))

    def used_scalars(self) -> tuple[str, ...]:
        """Return those ``scalars`` that occur in an expression of the step, in order."""
        read = {n.payload for n in walk(self.expressions()) if n.op == "sym"}
        if self.deferred is not None:
            # The parameters of deferred flows are arguments of the step, too.
            read |= {s for kernel in self.deferred.kernels for s in kernel.used_scalars()}
        if self.expansion is not None:
            # A separate kernel computes the coefficients of the Taylor polynomial.
            read |= set(self.expansion.coefficients.used_scalars())
        return tuple(s for s in self.scalars if s in read)
