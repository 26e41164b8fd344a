"""Kernels: a step as scalar assignments and fixed-point loops, ready for a printer.

A kernel is single assignment. A :class:`Loop` repeats its body with the unknowns replaced by their images
until they stand still; the unknowns keep the values that the last body was computed from, so that body
values may be read afterwards. A kernel never branches on data apart from loops: it selects.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from codegen.ir.expr import Expr, walk
from codegen.ir.number import Number

LEAD = "lead.h"
"""How long the first flow of a step lasts; no name that a user can give."""

ELAPSED = "elapsed.h"
"""How long the steps lasted whose end is put off."""

LONGEST = 256
"""After how many steps a run makes what commutes with all of them: the angles in it shall stay moderate."""

UNIT = 2.0**-53
"""Half a unit in the last place of one."""


@dataclass(frozen=True)
class Let:
    """name = value; symbols in value are inputs, unknowns of an enclosing loop, or earlier names."""

    name: str
    value: Expr


@dataclass(frozen=True)
class Loop:
    """Iterate unknowns <- images over body until the largest change stands still at rounding level.

    ``label`` names the block in messages and statistics ("stage 2"); ``starts`` are evaluated before the
    loop. With the largest change d and its predecessor e, both in units of max(1, largest unknown), the
    iteration has converged when d <= ``tolerance`` and d >= e (it stands still), or d <= ``close`` and
    d^2/e <= ``UNIT`` (the next change would be below rounding); after ``limit`` sweeps without that it has
    failed, and so has a change that is not finite.
    """

    label: str
    unknowns: tuple[str, ...]
    starts: tuple[Expr, ...]
    body: tuple[Let, ...]
    images: tuple[Expr, ...]
    tolerance: float = 2.0**-44
    limit: int = 100

    @property
    def close(self) -> float:
        """The largest change after which a contraction is trusted to finish."""
        return self.tolerance / 16

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
class Field:
    """A named block of scalars in the state, input or output: its names in order, and what it means."""

    name: str
    symbols: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class PutOff:
    """What a run does once and not in each step.

    A step is the kernel with :data:`LEAD` = ``first`` h, and ``finish`` after it. Made n times, that equals
    the kernel n times, with LEAD = ``later`` h from the second on, and ``finish`` once with :data:`ELAPSED` =
    n h and the t of the last step.
    """

    finish: Kernel
    first: Number
    later: Number


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
    """

    name: str
    state: tuple[Field, ...]
    scalars: tuple[str, ...]
    body: tuple[Let | Loop, ...]
    outputs: tuple[Expr, ...]
    put_off: PutOff | None = None
    inputs: tuple[str, ...] = ()
    samples: tuple[Sample, ...] = ()
    estimate: Estimate | None = None

    def lets(self) -> Iterator[Let]:
        """Yield every assignment, those in loops included."""
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement
            else:
                yield from statement.body

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression root in order."""
        yield from (sample.time for sample in self.samples)
        for statement in self.body:
            if isinstance(statement, Let):
                yield statement.value
            else:
                yield from statement.starts
                yield from (let.value for let in statement.body)
                yield from statement.images
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
            read |= set(self.put_off.finish.used_scalars())
        return tuple(s for s in self.scalars if s in read)
