"""Kernels: a step as scalar assignments and loops that solve equations, ready for a printer.

A kernel is single assignment. A :class:`Loop` repeats its body with the unknowns replaced by their images, or
corrected by Newton's method, until they stand still. Body values may be read afterwards: they are those of
the last sweep. A :class:`Start` says where the unknowns of all loops begin, unless solutions of earlier steps
are known. A kernel never branches on data apart from that: it selects.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number

LEAD = "lead.h"
"""How long the last flow of a step lasts; no name that a user can give."""

ELAPSED = "elapsed.h"
"""How long the steps lasted for which something was put off."""

LONGEST = 256
"""After how many steps a run makes what commutes with all of them: the angles in it shall stay moderate."""

FIXED_POINT, NEWTON = "fixed-point", "newton"
"""The methods that a block may be solved by."""

UNIT = 2.0**-53
"""Half a unit in the last place of one."""


@dataclass(frozen=True)
class Let:
    """name = value; symbols in value are inputs, unknowns of an enclosing loop, or earlier names."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Newton:
    """The matrix of Newton's method for u = g(u): ``matrix`` is 1 - g'(u), ``body`` computes its entries.

    The matrix is inverted in the first sweep of all, and kept from sweep to sweep and from step to step until
    a correction is not smaller than ``CONTRACTION`` times the one before it; it is then made anew.
    """

    body: tuple[Let, ...]
    matrix: tuple[tuple[Expr, ...], ...]

    CONTRACTION: ClassVar[float] = 2.0**-4


@dataclass(frozen=True)
class Loop:
    """Solve unknowns = images over body until the largest change stands still at rounding level.

    ``label`` names the block in messages and statistics ("stage 2"); ``starts`` are evaluated before the
    loop, and empty where a :class:`Start` gives them. Without ``newton`` the change of the unknowns is images
    - unknowns, and the unknowns keep the values that the last body was computed from; with it the change is
    that times the inverse of ``newton.matrix``, and the last change is made too.

    With the largest change d and its predecessor e, both in units of max(1, largest unknown), the iteration
    has converged when d <= ``tolerance`` and d >= e (it stands still), or d <= ``close`` and
    d^2/e <= ``UNIT`` (the next change would be below rounding); after ``limit`` sweeps without that it has
    failed, and so has a change that is not finite. ``read_anew`` says that nothing but the unknowns is read
    after the loop, so that the last change may be larger.
    """

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    body: tuple[Let, ...]
    images: tuple[Expr, ...]
    tolerance: float = 2.0**-44
    limit: int = 100
    newton: Newton | None = None
    read_anew: bool = False

    @property
    def solver(self) -> str:
        """The name of the method: ``newton`` or ``fixed-point``."""
        return FIXED_POINT if self.newton is None else NEWTON

    @property
    def close(self) -> float:
        """The largest change after which a contraction is trusted to finish."""
        return self.tolerance * (16 if self.read_anew else 1 / 16)

    def settled(self, change: float, previous: float, scale: float) -> bool:
        """Return whether a change ends the iteration; ``previous`` is 0 in the first sweep.

        >>> loop = Loop("x", (), (), (), ())
        >>> loop.settled(1e-15, 1e-13, 1.0), loop.settled(1e-15, 2e-15, 1.0), loop.settled(1e-15, 0.0, 1.0)
        (True, False, False)
        """
        if change <= self.close * scale and change * change <= UNIT * scale * previous:
            return True
        return previous > 0 and previous <= change <= self.tolerance * scale


@dataclass(frozen=True)
class Start:
    """unknowns = values over body, unless solutions of earlier steps are known.

    With the last solutions u1, u2, ... (the latest first) the unknowns begin at u1 after one step, at
    2 u1 - u2 after two, and at the quadratic extrapolation 3 (u1 - u2) + u3 from then on. They are of all
    loops of the kernel, in order.
    """

    unknowns: tuple[str, ...]
    body: tuple[Let, ...]
    values: tuple[Expr, ...]

    DEPTH: ClassVar[int] = 3


@dataclass(frozen=True)
class Field:
    """A named block of scalars in the state, input or output: its names in order, and what it means."""

    name: str
    symbols: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class PutOff:
    """What a run does not do in each step.

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
        """Those that there are."""
        return tuple(kernel for kernel in (self.begin, self.finish) if kernel is not None)


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
class Kernel:
    """One step: state fields, scalar inputs (h, t, run-time parameters), body, new state in field order.

    ``inputs`` names functions of time that the caller supplies, ``samples`` are the times they are read at.
    ``vary`` carries a variation along: its state is this one's and then the variation, its outputs are the
    variation of the new state.
    """

    name: str
    state: tuple[Field, ...]
    scalars: tuple[str, ...]
    body: tuple[Let | Start | Loop, ...]
    outputs: tuple[Expr, ...]
    put_off: PutOff | None = None
    inputs: tuple[str, ...] = ()
    samples: tuple[Sample, ...] = ()
    estimate: Estimate | None = None
    vary: Kernel | None = None

    @property
    def loops(self) -> tuple[Loop, ...]:
        """Every loop in order."""
        return tuple(s for s in self.body if isinstance(s, Loop))

    @property
    def start(self) -> Start | None:
        """Where the loops begin, where the kernel says so for all of them together."""
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
        """Return those of ``scalars`` that some expression reads, in order; what is put off reads too."""
        read = {n.payload for n in walk(self.expressions()) if n.op == "sym"}
        if self.put_off is not None:
            read |= {s for kernel in self.put_off.kernels for s in kernel.used_scalars()}
        return tuple(s for s in self.scalars if s in read)
