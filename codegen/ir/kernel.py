"""Kernels: a step as scalar assignments and loops that solve equations, ready for a printer.

A kernel is single assignment. A :class:`Loop` repeats its body with the unknowns replaced by their images, or
corrected by Newton's method, until they converge. Body values may be read afterwards: they have the values
of the last sweep. A :class:`Start` says where the unknowns of all loops begin, unless solutions of earlier
steps are known. A kernel never branches on data apart from that: it selects.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number
from codegen.ir.program import Substep

LEAD = "lead.h"
"""The duration of the last flow of a step; the dot keeps it apart from names that users give."""

ELAPSED = "elapsed.h"
"""The total duration of the steps whose flows are deferred."""

LONGEST = 256
"""The most steps for which a flow is deferred: its angles stay moderate."""

FIXED_POINT, NEWTON, SIMPLIFIED_NEWTON = "fixed-point", "newton", "simplified-newton"
"""The methods that a block may be solved by."""

SLOWEST = 2.0**-12
"""The smallest rate of convergence that is assumed: a rate measured near rounding is not reliable."""

UNIT = 2.0**-53
"""Half a unit in the last place of one."""

LOST = 2.0**-47
"""A change below this fraction of the largest number in a block of the state is lost in rounding."""

VARIATION = "variation"
"""The name of the state field that holds a variation."""

VARIED = "the variation of "
"""The prefix of the labels of equations for variations."""


@dataclass(frozen=True)
class Let:
    """name = value; symbols in value are inputs, unknowns of an enclosing loop, or earlier names."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Newton:
    """The matrix of Newton's method for u = g(u): ``matrix`` is 1 - g'(u), ``body`` computes its entries.

    It is kept from sweep to sweep and from step to step (:mod:`codegen.run.sweeps`); a matrix to ``leading``
    order in h is computed and inverted in each step instead. Entries that are ``inverted`` are those of the
    inverse already.

    If the loop's images are ``residuals``, which vanish at the solution, the matrix is minus their derivative
    to first order in h, and serves ``period`` steps. ``changes`` names the last change of the unknowns, by
    which values that are read after the loop may be corrected.
    """

    body: tuple[Let, ...]
    matrix: tuple[tuple[Expr, ...], ...]
    leading: bool = False
    inverted: bool = False
    residuals: bool = False
    changes: tuple[str, ...] = ()

    CONTRACTION: ClassVar[float] = 2.0**-6

    @property
    def period(self) -> int:
        """The number of steps that an inverse for residuals serves; 0: as long as it contracts.

        An inverse costs a multiple of n^3, a sweep one of n; the older the inverse, the more sweeps.
        """
        # With n = len(matrix), n/2 steps share the cost of order n^3, so a step pays one of order n^2.
        return max(1, len(self.matrix) // 2) if self.residuals else 0


@dataclass(frozen=True)
class Loop:
    """Solve unknowns = images over body until the largest change is at rounding level.

    ``label`` names the block in messages and statistics ("stage 2"); ``starts`` are evaluated before the
    loop, and empty where a :class:`Start` gives them. Without ``newton`` the change of the unknowns is images
    - unknowns, and the unknowns keep the values that the last body was computed from; with it the change is
    that times the inverse of ``newton.matrix``, and the last change is made too.

    ``tolerance``, ``close`` and ``limit`` are numbers of the stopping rule (:mod:`codegen.run.stopping`): the
    largest change, in units of the largest unknown, at which an iteration may stand still; the largest after
    which a contraction is trusted to finish; the most sweeps. ``read_anew`` says that only the unknowns are
    read after the loop, so that the last change may be larger.
    """

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    body: tuple[Let, ...]
    images: tuple[Expr, ...]
    # 512 roundings: changes at rounding level grow with the number of terms in a sweep.
    tolerance: float = 2.0**-44
    limit: int = 100
    newton: Newton | None = None
    read_anew: bool = False

    @property
    def solver(self) -> str:
        """The name of the method."""
        if self.newton is None:
            return FIXED_POINT
        return SIMPLIFIED_NEWTON if self.newton.leading else NEWTON

    @property
    def close(self) -> float:
        """The largest change after which a contraction is trusted to finish.

        Values that are read after the loop were computed before the last change. Simplified Newton contracts
        by (h L)^2 while these values change by h L, so a rate that ends the loop bounds their error too.
        """
        # Values after the loop are recomputed from the last
        # unknowns: their error is the rate times the last change.
        if self.read_anew and not (self.newton is not None and self.newton.residuals):
            return 16 * self.tolerance
        first_order = self.solver == SIMPLIFIED_NEWTON or (self.newton is not None and self.newton.residuals)
        return self.tolerance if first_order else self.tolerance / 16


@dataclass(frozen=True)
class Start:
    """unknowns = values over body, unless solutions of earlier steps are known.

    The unknowns then begin at the polynomial through the last solutions, continued by a step: with u1,
    u2, ... (latest first) at u1, 2 u1 - u2, 3 u1 - 3 u2 + u3 and so on. At most ``depth`` solutions are
    kept; the degree grows while their differences fall. The first change of the loops is the error of this
    guess: if it exceeds ``ROUGH`` times the change of the unknowns in the step, only u1 is kept for the next.
    The unknowns are those of all loops of the kernel, in order.

    If the loops do not converge, earlier solutions are dropped; then the step is halved until they do. The
    solution of each step is the start of a longer one (continuation in h), until the whole step is solved.
    It fails after ``TRIES`` steps, or when even a step longer by the fraction ``SHORTEST`` does not converge.
    """

    unknowns: tuple[str, ...]
    body: tuple[Let, ...]
    values: tuple[Expr, ...]
    depth: int = 16

    # A guess that misses by half of the change is hardly better than u1, the guess of degree 0.
    ROUGH: ClassVar[float] = 0.5
    # A limit that is hardly ever reached: before the first success each try halves the step, so 100 of them
    # reach 2^-100 h. After it, each failure takes the root of the factor: nine in a row end the search.
    TRIES: ClassVar[int] = 100
    # The largest factor is 4, and 4^(1/2^9) < 1 + 2^-8: the ninth failure in a row is the last.
    SHORTEST: ClassVar[float] = 2.0**-8


@dataclass(frozen=True)
class Field:
    """A named block of scalars in the state, input or output: its names in order, and its meaning."""

    name: str
    symbols: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class Deferred:
    """Flows deferred across steps.

    A step is ``begin``, the kernel with :data:`LEAD` = ``last`` h, and ``finish`` with :data:`ELAPSED` = h.
    Steps one after the other are ``begin`` once, the kernel as often, with LEAD = ``later`` h in all but the
    last, and ``finish`` once, with ELAPSED as long as all of them.
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
    """The momentum m that a run carries from step to step in place of the state's mu.

    m = ``inward``(q, mu) and mu = ``outward``(q, m), which are the numbers from ``first`` on. A step is
    ``inward``, the kernel on (q, m), and mu + outward(q', m') - outward(q, m) with the new q', m'. Steps one
    after the other are ``inward`` once, the kernel for each step, and such an end once. A q that is not quite
    orthogonal by rounding then rotates only the change of the momentum.
    """

    inward: Kernel
    outward: Kernel
    first: int


@dataclass(frozen=True)
class Sample:
    """Run-time inputs at one time of the step: a symbol for each, in the order of ``Kernel.inputs``."""

    time: Expr
    symbols: tuple[str, ...]


@dataclass(frozen=True)
class Estimate:
    """The new state less one of lower order, component by component; both differ from the flow by O(h^order)
    or less in one step."""

    errors: tuple[Expr, ...]
    order: int


@dataclass(frozen=True)
class Function:
    """A function that a kernel calls in several places: ``outputs`` over ``body``, of ``inputs`` alone.

    Its k-th result is the expression that calls ``NAME.k``; ``about`` writes it in operations of a program.
    """

    name: str
    inputs: tuple[str, ...]
    body: tuple[Let, ...]
    outputs: tuple[Expr, ...]
    about: str


@dataclass(frozen=True)
class Kernel:
    """One step: state fields, scalar inputs (h, t, run-time parameters), body, new state in field order.

    ``inputs`` names functions of time that the caller supplies, ``samples`` are the times they are read at.
    ``vary`` carries a variation along: its state is this one's and then the variation, its outputs are the
    variation of the new state. With ``substeps`` this is one of the parts of a step, all alike: h and t are
    those of the part. ``outlined`` are functions that its expressions call. With ``carried`` the state's
    momentum is another for the kernel.
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

    @property
    def loops(self) -> tuple[Loop, ...]:
        """Every loop in order."""
        return tuple(s for s in self.body if isinstance(s, Loop))

    @property
    def start(self) -> Start | None:
        """The common start of all loops, None if each has its own."""
        # A kernel has one Start at most: warm starts extrapolate the unknowns of all loops as one vector.
        return next((s for s in self.body if isinstance(s, Start)), None)

    def lets(self) -> Iterator[Let]:
        """Yield every assignment, those in loops included."""
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement
                continue
            yield from statement.body
            if isinstance(statement, Loop) and statement.newton is not None:
                yield from statement.newton.body

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression root in order."""
        yield from (sample.time for sample in self.samples)
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement.value
                continue
            yield from (let.value for let in statement.body)
            # A Start has values, a Loop has starts and images; only a Loop may have a matrix.
            if isinstance(statement, Start):
                yield from statement.values
                continue
            yield from (*statement.starts, *statement.images)
            if statement.newton is not None:
                yield from (let.value for let in statement.newton.body)
                yield from (x for row in statement.newton.matrix for x in row)
        yield from self.outputs
        if self.estimate is not None:
            yield from self.estimate.errors

    def functions(self) -> tuple[str, ...]:
        """Return the scalar functions that are called, sorted."""
        return tuple(sorted({n.payload for n in walk(self.expressions()) if n.op == "call"}))

    def used_scalars(self) -> tuple[str, ...]:
        """Return the ``scalars`` that an expression reads, deferred flows included, in order."""
        read = {n.payload for n in walk(self.expressions()) if n.op == "sym"}
        if self.deferred is not None:
            # A parameter that only a deferred flow reads is still an argument of the step.
            read |= {s for kernel in self.deferred.kernels for s in kernel.used_scalars()}
        return tuple(s for s in self.scalars if s in read)
