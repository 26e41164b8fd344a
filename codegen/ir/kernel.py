"""Kernels. A kernel contains the statements of one step, and is translated to C or Python code.

The statements are scalar assignments and loops. A kernel has no conditional statements. Each name is the
target of only one assignment.

A :class:`Loop` solves equations u = g(u) for its unknowns u. The values g(u) are called images. Each sweep
(iteration) of a loop replaces the unknowns by their images, or corrects the unknowns by Newton's method. A
:class:`Start` sets the first values of the unknowns of all loops.
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
"""The name of a symbol: the duration of the last flow in a step of a splitting method.

In a run of several steps, this flow leads into the next step, because it includes the first flow of the next
step. The dot distinguishes the name from all names that a user can choose.
"""

ELAPSED = "elapsed.h"
"""The name of a symbol. In a splitting method, a flow that commutes with all other flows may be applied once
after n steps. The symbol is the duration n h of this flow.
"""

LONGEST = 256
"""The largest number of steps that share one deferred flow (:class:`Deferred`).

The rounding errors of the angles in a deferred flow are proportional to the number of steps.
"""

FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON = "fixed-point", "newton", "simplified-newton"
"""The names of the methods that solve implicit equations."""

SLOWEST = 2.0**-12
"""A lower bound for the contraction factor in the stopping rule.

The contraction factor is the quotient of two successive changes of the unknowns. This quotient may be tiny by
accident if the changes are rounding errors.
"""

UNIT = 2.0**-53
"""The unit roundoff of doubles, that is, the largest relative rounding error."""

LOST = 2.0**-47
"""A relative bound for rounding errors of the state (:mod:`codegen.run.stopping`)."""

VARIATION = "variation"
"""The name of the :class:`Field` that contains a variation: a directional derivative of the state with
respect to the initial state.
"""

VARIED = "the variation of "
"""If a loop computes a variation, its label begins with this text."""


@dataclass(frozen=True)
class Let:
    """The assignment name = value."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Newton:
    """Newton's method for the equations of a loop (:mod:`codegen.run.sweeps`).

    ``body`` computes the entries of ``matrix``. The method has three forms:
    - Newton: the equations are u = g(u), and the matrix is 1 - g'(u). The matrix is kept in later sweeps and
      steps, until the iteration converges too slowly.
    - Simplified Newton (``leading`` is true): the equations are u = g(u). The matrix is 1 - g'(u), expanded
      to first order in h. Each step computes and inverts the matrix.
    - Residuals (``residuals`` is true): the equations are r(u) = 0, and the ``images`` of the loop are the
      residuals r(u). The matrix is -r'(u), expanded to first order in h. The matrix is computed and
      inverted again after :attr:`period` steps.

    If ``inverted`` is true, ``matrix`` is the inverse of the matrix described above. If ``residuals`` is
    true, ``changes`` contains one variable name for each unknown. The variable stores the change of this
    unknown in a sweep.
    """

    body: tuple[Let, ...]
    matrix: tuple[tuple[Expr, ...], ...]
    leading: bool = False
    inverted: bool = False
    residuals: bool = False
    changes: tuple[str, ...] = ()

    # If the change in a sweep exceeds CONTRACTION times the previous change, Newton's matrix is computed
    # again.
    CONTRACTION: ClassVar[float] = 2.0**-6

    @property
    def period(self) -> int:
        """For equations r(u) = 0, the number of steps after which ``matrix`` is inverted again.

        For equations u = g(u) (``residuals`` is false), the value is 0, because other rules decide when
        ``matrix`` is inverted again (see :class:`Newton`).
        """
        # The inversion of an n x n matrix costs O(n^3) operations. If one inversion serves n/2 steps of the
        # integrator, the cost of inversions is only O(n^2) operations in each step.
        return max(1, len(self.matrix) // 2) if self.residuals else 0


@dataclass(frozen=True)
class Loop:
    """A loop that solves the equations u = g(u) by iteration.

    The values u are called unknowns, and the values g(u) are called images. ``body`` computes the images. If
    ``newton.residuals`` is true, the equations are r(u) = 0, and the images are the residuals r(u).

    ``label`` is the name of the equations in messages and statistics, for example "stage 2". ``starts`` are
    the first values of the unknowns. If a :class:`Start` computes the first values, ``starts`` is empty.

    One iteration of the loop is called a sweep. Each sweep computes a change of the unknowns:
    - Fixed-point iteration (``newton`` is None): g(u) - u.
    - Newton's method for u = g(u): M^{-1} (g(u) - u), where the matrix M approximates 1 - g'(u).
    - Newton's method for r(u) = 0: M^{-1} r(u), where the matrix M approximates -r'(u).

    Newton's method adds the change to the unknowns in each sweep. Fixed-point iteration first tests whether
    the loop has converged, and adds the change only if the loop continues.

    ``limit`` is the largest number of sweeps. For equations u = g(u), the stopping rule
    (:mod:`codegen.run.stopping`) ends the loop in two main cases:
    - The change no longer decreases, and it is at most ``tolerance`` times the largest unknown.
    - The change is at most :attr:`close` times the largest unknown, and the predicted change of a further
      sweep is at rounding level.

    The stopping rule for equations r(u) = 0 is described in the method ``Stopping.converged_by_residuals``.

    ``only_unknowns_read`` is true if the code after the loop reads no variable of ``body``.
    """

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    body: tuple[Let, ...]
    images: tuple[Expr, ...]
    # The rounding errors of all operations in a sweep may add up to many times the unit roundoff 2^-53.
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
        """A factor in the stopping rule of a loop for u = g(u). The loop ends if both conditions hold:

        - The last change is at most ``close`` times the largest unknown.
        - The predicted change of a further sweep is at rounding level.
        """
        # The last sweep computes the values in ``body`` before it changes the unknowns. The error of these
        # values is therefore about as large as the last change of the unknowns. If the code after the loop
        # does not read these values, a larger last change is allowed.
        if self.only_unknowns_read and not (self.newton is not None and self.newton.residuals):
            return 16 * self.tolerance
        # ``first_order`` is true if Newton's matrix is expanded to first order in h.
        first_order = self.solver == SIMPLIFIED_NEWTON or (self.newton is not None and self.newton.residuals)
        return self.tolerance if first_order else self.tolerance / 16


@dataclass(frozen=True)
class Start:
    """The statement that sets the first values of the unknowns of all loops.

    ``body`` computes ``values``. If no solution is stored, the first values are ``values``. Otherwise the
    first values are extrapolated from at most ``depth`` stored solutions. Let u1 be the solution of the last
    step, u2 the solution of the step before it, and so on. The extrapolations of degree 0, 1 and 2 are u1,
    2 u1 - u2 and 3 u1 - 3 u2 + u3.

    The backward differences are u1 - u2 (order 1), u1 - 2 u2 + u3 (order 2), and so on. The sizes of the
    backward differences determine the degree of the next extrapolation (:mod:`codegen.run.warm_start`). If
    the estimated error of the first values exceeds a bound, all stored solutions except u1 are discarded. The
    bound is ``ROUGH`` times the change of the unknowns from one step to the next.

    A failed step is repeated by continuation in h. The step size is halved until the loops converge. Then the
    step size grows to h. Each solution provides the first values for the next larger step size. After a
    successful step size s < h, the next step size is s times a growth factor, but at most h. If this longer
    step fails, the growth factor is reduced. The continuation fails if the reduced growth factor is at most
    1 + ``SHORTEST``, or if ``TRIES`` attempted steps do not reach the step size h.
    """

    unknowns: tuple[str, ...]
    body: tuple[Let, ...]
    values: tuple[Expr, ...]
    depth: int = 16

    # An iteration can start from the solution of the last step. The error of this initial guess is the change
    # of the unknowns from one step to the next. An extrapolation from several solutions is useful only if its
    # error is at most half of this change.
    ROUGH: ClassVar[float] = 0.5
    # Successful continuations need far fewer than 100 attempts.
    TRIES: ClassVar[int] = 100
    # ``SHORTEST`` is a lower bound for the relative increase of the step size. The continuation fails if the
    # growth factor is at most 1 + ``SHORTEST``, because the step size would hardly grow.
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
    """A run of a splitting method, where some flows are joined across steps or applied only at the end.

    A run has at most :data:`LONGEST` steps. The run calls ``begin``, then the kernel of the step once for
    each step, and then ``finish``.

    The last flow of a step and the first flow of the next step may be joined into one flow. The joined flow
    is applied at the end of the step, so the next step omits its first flow. The first step omits its first
    flow, too, because ``begin`` applies this flow before the first step.

    The kernel of the step reads the duration of its last flow from the symbol :data:`LEAD`. In the final step
    of a run, the value of this symbol must be ``last`` * h, because no step follows. In all other steps, the
    value must be ``later`` * h, which is the duration of the joined flow. If no flows are joined, ``begin``
    is None, and the kernel does not read the symbol.

    The steps may omit flows that commute with all other flows. ``finish`` applies the omitted flows, for the
    total duration of the run. If no flows are omitted, ``finish`` is None.
    """

    begin: Kernel | None
    finish: Kernel | None
    last: Number
    later: Number

    @property
    def kernels(self) -> tuple[Kernel, ...]:
        """The kernels ``begin`` and ``finish``, if they exist."""
        return tuple(kernel for kernel in (self.begin, self.finish) if kernel is not None)


@dataclass(frozen=True)
class Carried:
    """The conversions between the space momentum mu of the caller and the body momentum m of the steps.

    The conversions are m = ``inward``(q, mu) and mu = ``outward``(q, m), where q is the group element in the
    state. ``first`` is the index of the first momentum component in the state.

    If the steps map (q, m) to (q', m'), the new space momentum is
    mu' = mu + (outward(q', m') - outward(q, m)). In exact arithmetic, this is outward(q', m'). In
    floating-point arithmetic, q and q' are slightly non-orthogonal, and the resulting errors nearly cancel in
    the difference.
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

    The error estimate of one step is O(h^``order``). ``errors`` contains the components of the estimate. For
    an :class:`ArrayStep`, ``errors`` is empty.
    """

    errors: tuple[Expr, ...]
    order: int


@dataclass(frozen=True)
class Expansion:
    """The Taylor polynomial of the solution as a function of time.

    The polynomial is computed in coordinates of the state. ``enter`` computes the coordinates from the state.
    At the end of a step, ``leave`` computes the state from the coordinates. If the coordinates are the state
    itself, ``enter`` and ``leave`` are None. If ``controlled`` is true, a run may choose the step size from
    the Taylor coefficients.

    If ``following`` is None, the kernel ``coefficients`` computes the Taylor coefficients of the orders
    1, 2, ..., ``degree``.

    If ``following`` is a kernel, a loop over the order n computes the Taylor coefficients
    (:class:`codegen.ir.taylor_loop.OrderLoop`). The kernel ``coefficients`` is executed before this loop. The
    loop needs some values that do not depend on n (``OrderLoop.first``). These values are the first outputs
    of the kernel ``coefficients``. The other outputs are the coefficients of order 1.

    Coefficient n of a product of two series a and b contains the inner sum a_1 b_(n-1) + ... + a_(n-1) b_1.
    Pass n of the loop first computes this inner sum for each product (``sums`` is the number of products).
    Then the loop executes the kernel ``following``, which has these outputs, in this order:
    - a_n for each product,
    - b_n for each product,
    - the Taylor coefficients of order n + 1.
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

    The solution at the time t + theta h is the action of exp(sigma(theta)) on the state at the time t. Here
    sigma(theta) is a polynomial with values in the Lie algebra. The kernel ``coefficients`` computes the
    coefficients of theta, theta^2, ..., theta^``degree``, in this order. The kernel ``moved`` computes the
    action of exp(x) on a state, where x are the coordinates of an element of the Lie algebra.
    """

    coefficients: Kernel
    moved: Kernel
    degree: int
    order: int


@dataclass(frozen=True)
class Observed:
    """The properties of the emitted function that integrates to a given end time.

    ``events`` is the number of event functions. The ``extension`` (dense output) computes the states at
    output times. If ``extension`` is None, a separate step computes each of these states.
    """

    events: int = 0
    extension: Continuous | None = None


@dataclass(frozen=True)
class Function:
    """A function that a kernel calls in several places. A call executes ``body`` and returns ``outputs``.

    In expressions, ``NAME.k`` denotes output k of the function ``NAME``, counted from 0. ``about`` describes
    the function in words.
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
    - ``vary`` is the kernel of the variational equation.
    - ``substeps`` are the substeps of a composition method. If there are substeps, ``body`` is executed once
      for each substep.
    - ``outlined`` are functions. The expressions in ``body`` and ``outputs`` may contain calls of these
      functions.
    - ``carried`` contains the conversions between the space momentum of the caller and the body momentum of
      the steps. If no conversion is needed, ``carried`` is None.
    - ``expansion`` is the Taylor polynomial of a Taylor method.
    - ``estimate`` is the error estimate of an adaptive method that is not a Taylor method.
    - ``batch`` is true if emitted code also contains a function that steps many independent systems.
    - ``observed`` describes the emitted function that integrates to a given end time. If there is no such
      function, ``observed`` is None.

    If a kernel has no ``outputs``, one of four attributes describes the step: ``expansion`` (a Taylor
    polynomial), ``arrays`` (large matrices), ``sites`` (a lattice) or ``modes`` (Fourier modes).
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
        """The :class:`Start` of the kernel, or None if the kernel has no :class:`Start`."""
        # A kernel has at most one ``Start``, before its first loop.
        return next((s for s in self.body if isinstance(s, Start)), None)

    def lets(self) -> Iterator[Let]:
        """Yield every assignment in ``body``, including the assignments inside loops."""
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
        # The caller's functions of time are evaluated before the first statement of ``body``.
        yield from (sample.time for sample in self.samples)
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement.value
                continue
            yield from (let.value for let in statement.body)
            if isinstance(statement, Start):
                yield from statement.values
                continue
            # The statement is a loop.
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
        """Return the sorted names of the functions that occur in the expressions of the kernel."""
        # The order of a set is not fixed, so the names are sorted.
        return tuple(sorted({n.payload for n in walk(self.expressions()) if n.op == "call"}))

    def used_scalars(self) -> tuple[str, ...]:
        """Return the names in ``scalars`` that the step uses, in the order of ``scalars``."""
        read = {n.payload for n in walk(self.expressions()) if n.op == "sym"}
        if self.deferred is not None:
            # The kernels ``begin`` and ``finish`` may use additional scalars.
            read |= {s for kernel in self.deferred.kernels for s in kernel.used_scalars()}
        if self.expansion is not None:
            # The Taylor coefficients may contain scalars that are not yet in ``read``.
            read |= set(self.expansion.coefficients.used_scalars())
        return tuple(s for s in self.scalars if s in read)
