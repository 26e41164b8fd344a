"""Kernels: a step as a list of scalar assignments and of loops that solve equations. C or Python code is
printed from a kernel.

Each name in a kernel is assigned only once. A :class:`Loop` solves equations u = g(u) for its unknowns u. The
values g(u) are called images. Each sweep (iteration) of a loop replaces the unknowns by their images, or
corrects the unknowns by Newton's method. A :class:`Start` sets the first values of the unknowns of all loops.
A kernel has no branches that depend on data, apart from its loops.
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
"""The name of a symbol in the steps of splitting methods: the duration of the last flow of a step. Between
two steps of a run, the last flow of one step and the first flow of the next step are joined to one flow. The
name contains a dot, so it differs from every name that a user can choose.
"""

ELAPSED = "elapsed.h"
"""The name of a symbol in splitting methods: the total duration of successive steps. The symbol is used in
flows that are applied only once for all of these steps (:class:`Deferred`).
"""

LONGEST = 256
"""The largest number of successive steps for which a flow is applied only once (:class:`Deferred`). The
angles in this flow are proportional to the number of steps. Their rounding errors grow in the same
proportion.
"""

FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON = "fixed-point", "newton", "simplified-newton"
"""The names of the methods that solve implicit equations."""

SLOWEST = 2.0**-12
"""A lower bound of the contraction factor in the stopping rule.

The contraction factor is estimated as the quotient of two successive changes of the unknowns. Near rounding
level, an estimate below this bound is unreliable, and the bound replaces it.
"""

UNIT = 2.0**-53
"""The unit roundoff of doubles, that is, the largest relative rounding error."""

LOST = 2.0**-47
"""A change counts as a rounding error if it is below this fraction of the largest number in the same
:class:`Field` of the state.
"""

VARIATION = "variation"
"""The name of the :class:`Field` that contains a variation, that is, a derivative of the state with respect
to the initial state in one direction.
"""

VARIED = "the variation of "
"""If a loop solves equations for a variation, its label begins with this text."""


@dataclass(frozen=True)
class Let:
    """The assignment name = value."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Newton:
    """Newton's method for the equations of a loop. ``matrix`` is the matrix of the method, and ``body``
    computes its entries. For equations u = g(u), the matrix is 1 - g'(u).

    - ``leading`` is true if this matrix is expanded to first order in h. It is then computed and inverted in
      each step. If ``leading`` is false, the matrix is reused in later sweeps and steps
      (:mod:`codegen.run.sweeps`).
    - ``inverted`` is true if ``matrix`` contains the entries of the inverse matrix.
    - ``residuals`` is true if the loop solves equations r(u) = 0. Its ``images`` are then the residuals r(u),
      and the matrix is -r'(u), expanded to first order in h. The inverse is used for :attr:`period` steps.
    - ``changes`` are the names of the variables with the last changes of the unknowns.
    """

    body: tuple[Let, ...]
    matrix: tuple[tuple[Expr, ...], ...]
    leading: bool = False
    inverted: bool = False
    residuals: bool = False
    changes: tuple[str, ...] = ()

    # The matrix is computed again if the change of the unknowns in a sweep exceeds CONTRACTION times the
    # change in the previous sweep.
    CONTRACTION: ClassVar[float] = 2.0**-6

    @property
    def period(self) -> int:
        """The number of steps for which an inverse matrix is used. The value 0 means that it is used as long
        as the sweeps reduce the changes sufficiently.

        The cost of the inverse of an n x n matrix is proportional to n^3. With a longer period the inverse is
        computed less often. But an older inverse is less accurate, so a step needs more sweeps.
        """
        # An inverse costs O(n^3) operations. It is used for about n/2 steps, so its share of each step is
        # O(n^2).
        return max(1, len(self.matrix) // 2) if self.residuals else 0


@dataclass(frozen=True)
class Loop:
    """A loop that solves the equations u = g(u) by iteration, where u are the unknowns and g(u) the images.

    ``body`` computes the images. The loop ends when the changes of the unknowns are at rounding level.

    ``label`` is the name of the equations in messages and statistics, for example "stage 2". ``starts`` are
    the first values of the unknowns. ``starts`` is empty if a :class:`Start` computes the first values.

    In each sweep the change of the unknowns is computed. It is g(u) - u for fixed-point iteration. If
    ``newton`` is given, the change is the inverse of ``newton.matrix`` times g(u) - u. The change of the last
    sweep is added to the unknowns only if ``newton`` is given.

    The stopping rule (:mod:`codegen.run.stopping`) uses these numbers:
    - ``tolerance``: a loop whose change no longer decreases ends if the change is below ``tolerance`` times
      the largest unknown.
    - ``close``: a loop whose rate of convergence predicts a small error ends if the change is below ``close``
      times the largest unknown.
    - ``limit`` is the largest number of sweeps.
    - ``only_unknowns_read`` is true if the code after the loop uses only the unknowns, and no values of
      ``body``. The loop may then end at a larger change.
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
        """A bound of the change of the unknowns, divided by the largest unknown.

        If the change is below this bound and a small error is predicted, the loop ends (see :class:`Loop`).
        Statements after the loop may use values of ``body``. These values were computed before the last
        change of the unknowns, so their error is about h L times this change. Here h L is the Lipschitz
        constant of the images g(u).

        With simplified Newton, each sweep multiplies the change by about (h L)^2. The loop converges only if
        this factor is small. Hence h L is small when the loop ends.
        """
        # No value of ``body`` is used after the loop, so only the error of the unknowns matters. It is
        # smaller than the change of the unknowns in the last sweep.
        if self.only_unknowns_read and not (self.newton is not None and self.newton.residuals):
            return 16 * self.tolerance
        # If the matrix of Newton's method is expanded to first order in h, the loop converges only if the
        # Lipschitz constant h L of the images is small. All other loops may converge for larger h L. The
        # errors of the values of ``body`` may then be larger, so these loops need a smaller bound.
        first_order = self.solver == SIMPLIFIED_NEWTON or (self.newton is not None and self.newton.residuals)
        return self.tolerance if first_order else self.tolerance / 16


@dataclass(frozen=True)
class Start:
    """The statement that sets the first values of the unknowns of all loops.

    If no solutions of earlier steps are known, the unknowns are set to ``values``, which ``body`` computes.
    Otherwise the first values are extrapolated from the solutions u1, u2, ... of the last steps (latest
    first). The extrapolations of degree 0, 1 and 2 are u1, 2 u1 - u2 and 3 u1 - 3 u2 + u3. At most ``depth``
    solutions are stored.

    The degree d is adapted to the sizes of the backward differences u1 - u2 (order 1), u1 - 2 u2 + u3
    (order 2), and so on. If the difference of order d + 1 is smaller than the difference of order d, then d
    is increased. Otherwise, if the difference of order d - 1 is smaller, d is reduced. If the estimated error
    of an extrapolation exceeds ``ROUGH`` times the change of the unknowns in the step, all solutions except
    u1 are discarded.

    If the loops do not converge, the step size is halved until they converge. The solution for this step size
    provides the first values for a larger step size. This is repeated until the step size is h (continuation
    in h). If the loops do not converge for a larger step size, the step size grows by a smaller factor. The
    continuation fails if this factor is at most 1 + ``SHORTEST``, or after ``TRIES`` step sizes.
    """

    unknowns: tuple[str, ...]
    body: tuple[Let, ...]
    values: tuple[Expr, ...]
    depth: int = 16

    # The simplest first value is u1, the solution of the last step. Its error is the change of the unknowns
    # in the step. If the error of an extrapolation exceeds half of this change, the extrapolation is hardly
    # better than u1.
    ROUGH: ClassVar[float] = 0.5
    # The continuation tries at most ``TRIES`` step sizes. This limit is hardly ever reached: after 100
    # halvings the step size would be 2^-100 h.
    TRIES: ClassVar[int] = 100
    # The step size grows by a factor of at most 4. If the loops do not converge for a larger step size, the
    # factor is replaced by its square root. After nine successive failures the factor is at most 4^(1/2^9).
    # This number is less than 1 + 2^-8.
    SHORTEST: ClassVar[float] = 2.0**-8


@dataclass(frozen=True)
class Field:
    """A named part of the state, of the input or of the output of a kernel.

    An example is the momentum mu, a part of the state. ``symbols`` are the names of the scalars in the field,
    and ``meaning`` describes the field in words.
    """

    name: str
    symbols: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class Deferred:
    """The flows of a splitting method that a run of several steps applies only once, before its first step or
    after its last step.

    A single step calls ``begin``, the kernel of the step, and ``finish``. A run of several steps calls
    ``begin`` once, the kernel of the step once for each step, and ``finish`` once. A long run is divided into
    runs of at most :data:`LONGEST` steps.

    The symbol :data:`LEAD` is the duration of the last flow of the kernel. In a single step and in the last
    step of a run, this duration is h times the number ``last``. In all other steps it is h times the number
    ``later``. The symbol :data:`ELAPSED` is the duration of the single step or of the whole run.
    """

    begin: Kernel | None
    finish: Kernel | None
    last: Number
    later: Number

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """A tuple of the kernels ``begin`` and ``finish``, without those that are None."""
        return tuple(kernel for kernel in (self.begin, self.finish) if kernel is not None)


@dataclass(frozen=True)
class Carried:
    """The conversions of a step that uses the momentum m in the body frame in place of the space momentum mu.

    The conversions are m = ``inward``(q, mu) and mu = ``outward``(q, m). The momentum begins at the index
    ``first`` of the state. The kernel of the step maps (q, m) to (q', m').

    A run of several steps computes m at its beginning, and calls the kernel once for each step. At its end it
    computes the new space momentum: mu' = mu + outward(q', m') - outward(q, m). Rounding errors make q
    slightly non-orthogonal, so outward(q, m) has a small error. A similar error of outward(q', m') nearly
    cancels it.
    """

    inward: Kernel
    outward: Kernel
    first: int


@dataclass(frozen=True)
class Sample:
    """The values of the caller's input functions at the time ``time``.

    ``symbols`` are the names of these values, in the order of the functions in ``Kernel.inputs``.
    """

    time: Expr
    symbols: tuple[str, ...]


@dataclass(frozen=True)
class Estimate:
    """An error estimate: the new state minus an embedded solution of lower order.

    The error estimate of one step is O(h^``order``). ``errors`` contains the components of the estimate. It
    is empty if the step is an :class:`ArrayStep`, which computes the estimate as a matrix.
    """

    errors: tuple[Expr, ...]
    order: int


@dataclass(frozen=True)
class Expansion:
    """The Taylor polynomial of the solution as a function of time. Its initial value is the state.

    The outputs of the kernel ``coefficients`` are the Taylor coefficients of the orders 1, ..., ``degree``,
    one order after the other. If the polynomial uses other coordinates than the state, ``enter`` computes
    these coordinates from the state, and ``leave`` computes the new state from them. Otherwise ``enter`` and
    ``leave`` are None. If ``controlled`` is true, a run may choose the step size from the coefficients.

    If ``following`` is given, a loop over the order n computes the coefficients
    (:class:`codegen.ir.taylor_loop.OrderLoop`). In this case ``coefficients`` has two groups of outputs: the
    values that the loop uses but does not compute, and the coefficients of order 1.

    Coefficient n of a product of two series a and b contains the inner sum a_1 b_(n-1) + ... + a_(n-1) b_1.
    The loop computes ``sums`` inner sums. The kernel ``following`` has three groups of outputs: the
    coefficients a_n for all inner sums, the coefficients b_n for all inner sums, and the Taylor coefficients
    of order n + 1.
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
    """A continuous extension (dense output) of order ``order``.

    The solution at the time t + theta h is exp(sigma(theta)).y. Here y is the state at the time t, and
    sigma(theta) is a polynomial with values in the Lie algebra. The outputs of ``coefficients`` are the
    coefficients of theta, ..., theta^``degree`` in sigma, one after the other. ``moved`` computes exp(x).y
    from a state y and the coordinates x of an element of the Lie algebra.
    """

    coefficients: Kernel
    moved: Kernel
    degree: int
    order: int


@dataclass(frozen=True)
class Observed:
    """The properties of a run, an emitted function that integrates to a given end time.

    The run writes the states at given output times, and finds the zeros of event functions. ``events`` is the
    number of event functions, which the caller supplies. The ``extension`` (dense output) computes the states
    at output times. If ``extension`` is None, the run takes shorter steps that end at the output times.
    """

    events: int = 0
    extension: Continuous | None = None


@dataclass(frozen=True)
class Function:
    """A function that a kernel calls in several places. It executes ``body`` and returns ``outputs``.

    In expressions, the function name ``NAME.k`` denotes output k of the function ``NAME``. ``about``
    describes the function in words.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Let, ...]
    outputs: tuple[Expr, ...]
    about: str


@dataclass(frozen=True)
class Kernel:
    """One step: the state, scalar arguments (h, t, run-time parameters), the statements, and the new state.

    - ``outputs`` are the scalars of the new state.
    - ``inputs`` are the names of functions of time that the caller supplies. ``samples`` contains the times
      at which these functions are evaluated.
    - ``vary`` is the kernel of the variational equation. It computes the variation (a derivative of the
      state) after the step.
    - ``substeps`` are the substeps of a composition method. The kernel is called once for each substep.
    - ``outlined`` are functions that the expressions of the kernel call.
    - ``carried`` contains the conversions of the momentum if the kernel uses the body momentum in place of
      the space momentum.
    - ``expansion`` is the Taylor polynomial of a Taylor method. ``estimate`` is the error estimate of any
      other method. A run with step-size control needs one of them.
    - ``batch`` is true if emitted code also contains a function that steps many independent systems.
    - ``observed`` is given if emitted code also contains a run to a given end time.

    A kernel without ``outputs`` is of one of four types. With ``expansion`` it evaluates a Taylor polynomial.
    With ``arrays`` it executes a step on large matrices, with ``sites`` on a lattice, and with ``modes`` on
    Fourier modes.
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
        """True if the emitted code contains a function that integrates with step-size control."""
        # Step-size control needs an error estimate or Taylor coefficients.
        return self.estimate is not None or (self.expansion is not None and self.expansion.controlled)

    @property
    def loops(self) -> tuple[Loop, ...]:
        """The loops of the kernel, in the order of execution."""
        return tuple(s for s in self.body if isinstance(s, Loop))

    @property
    def start(self) -> Start | None:
        """The statement that computes the first values of all unknowns, or None if there is none."""
        # A kernel has at most one ``Start``, before its first loop.
        return next((s for s in self.body if isinstance(s, Start)), None)

    def lets(self) -> Iterator[Let]:
        """Yield every assignment, including the assignments inside loops."""
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement
                continue
            yield from statement.body
            # The assignments in ``newton.body`` compute the matrix of Newton's method.
            if isinstance(statement, Loop) and statement.newton is not None:
                yield from statement.newton.body

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression of the kernel, in the order of execution."""
        # The times of ``samples`` come first, because the functions of time are evaluated before the step.
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
        """Return the sorted names of the functions that the expressions call."""
        # The order of a set is not fixed, so the names are sorted.
        return tuple(sorted({n.payload for n in walk(self.expressions()) if n.op == "call"}))

    def used_scalars(self) -> tuple[str, ...]:
        """Return those of the ``scalars`` that the step uses, in the order of ``scalars``."""
        read = {n.payload for n in walk(self.expressions()) if n.op == "sym"}
        if self.deferred is not None:
            # The step also calls the kernels of the deferred flows.
            read |= {s for kernel in self.deferred.kernels for s in kernel.used_scalars()}
        if self.expansion is not None:
            # The kernel that computes the Taylor coefficients is also a part of the step.
            read |= set(self.expansion.coefficients.used_scalars())
        return tuple(s for s in self.scalars if s in read)
