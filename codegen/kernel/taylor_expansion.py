"""Kernels that compute the coefficients of Taylor polynomials, by unrolled code or by a loop.

If unrolled code fits into the instruction cache, it is faster than a loop.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from codegen.groups.capabilities import Coadjoint
from codegen.ir.expr import Expr
from codegen.ir.kernel import Expansion, Field, Kernel, Let
from codegen.ir.program import Program
from codegen.ir.taylor_loop import OrderLoop, order_loop
from codegen.kernel.assignments import Assignments
from codegen.kernel.carried_momentum import Frames
from codegen.kernel.shared_angles import SharedArguments
from codegen.scene.evolution import Evolution
from codegen.scene.problem import TIME, Problem

UNROLLED = 5000
"""The largest number of operations of unrolled code. Longer code becomes a loop.

The number of operations is estimated as s P^2. Here s is the number of products in the differential equation,
and P is the degree of the Taylor polynomial. With 18 products (heavy_top), a step of taylor(16) takes 0.53 us
with unrolled code and 0.64 us with a loop. With 24 products, the step takes 1.5 us with unrolled code and
0.82 us with a loop.
"""


def looped_kernel(program: Program, problem: Problem, degree: int) -> Kernel | None:
    """Return the kernel that computes the Taylor coefficients in a loop, or None if unrolled code is used."""
    if problem.body_group is not None:
        return None
    assert problem.evolution is not None
    loop = _loop(problem.evolution)
    if len(loop.sums) * degree**2 <= UNROLLED:
        return None
    fields = Frames(problem, program).fields()
    # The expansion computes the whole step, so the kernel itself has no statements and no outputs.
    empty = Kernel(program.name, fields, (TIME, "h", *problem.runtime), (), ())
    # With ``controlled=False``, the step size does not depend on the Taylor coefficients.
    expansion = replace(_expansion(empty, problem, degree, loop), controlled=False)
    return replace(empty, expansion=expansion)


def with_step_control(kernel: Kernel, problem: Problem, degree: int) -> Kernel:
    """Return a kernel that also computes the Taylor coefficients of the solution.

    A run can choose its step size from the Taylor coefficients.
    """
    if kernel.expansion is not None:
        return replace(kernel, expansion=replace(kernel.expansion, controlled=True))
    assert problem.evolution is not None
    return replace(kernel, expansion=_expansion(kernel, problem, degree, None))


def _loop(inner: Evolution) -> OrderLoop:
    domain = SharedArguments()
    state = tuple(map(domain.space.sym, inner.inner.symbols))
    # The argument 1 in place of h gives coefficients without powers of h.
    terms = inner.recurrence(domain, state, domain.space.sym(TIME), domain.space.one)
    return order_loop(terms, domain.space)


def _expansion(kernel: Kernel, problem: Problem, degree: int, loop: OrderLoop | None) -> Expansion:
    """Return the kernels that compute the Taylor coefficients of the solution.

    If ``loop`` is None, unrolled code computes the coefficients.
    """
    work, frame = problem.evolution, problem.body_group
    assert work is not None
    enter, leave = _enter(kernel, work, frame), _leave(kernel, work, frame)
    fields = (Field("start", work.inner.symbols, "coordinates in which the Taylor polynomial is computed"),)
    if loop is None:
        return Expansion(degree, _unrolled(kernel, fields, work, degree), enter, leave)
    # ``name`` never returns a name twice. Therefore the two kernels use different names for intermediate
    # values.
    name = _names(kernel)
    first = _kernel(kernel, fields, (*loop.first, *loop.start), name)
    # Let n be the loop index. For each product of two power series a and b, ``left`` contains a_n, and
    # ``right`` contains b_n.
    following = _kernel(kernel, (), (*loop.left, *loop.right, *loop.following), name)
    return Expansion(degree, first, enter, leave, following, len(loop.sums))


def _unrolled(kernel: Kernel, fields: Sequence[Field], work: Evolution, degree: int) -> Kernel:
    domain = SharedArguments()
    space = domain.space
    state = tuple(map(space.sym, work.inner.symbols))
    # Coefficient n contains no factor h^n, because step-size control chooses h later.
    rows = work.coefficients(domain, degree, state, space.sym(TIME), space.one)
    # A coefficient that is identically zero is None in ``rows``.
    ends = [space.zero if row[n] is None else row[n] for n in range(1, degree + 1) for row in rows]
    return _kernel(kernel, fields, ends, _names(kernel))


def _enter(kernel: Kernel, work: Evolution, frame: Coadjoint | None) -> Kernel | None:
    domain = SharedArguments()
    state = tuple(s for f in kernel.state for s in f.symbols)
    given = tuple(map(domain.space.sym, state))
    ends = work.enter(domain, given, frame)
    # ``ends`` contains formulas for the coordinates in which the Taylor polynomial is computed. If these
    # formulas are the symbols ``given`` of the state, no conversion is needed.
    if ends == given:
        return None
    return _kernel(kernel, kernel.state, ends, _names(kernel))


def _leave(kernel: Kernel, work: Evolution, frame: Coadjoint | None) -> Kernel | None:
    domain = SharedArguments()
    old = tuple(domain.space.sym(s) for f in kernel.state for s in f.symbols)
    names = tuple(f"{s}.moved" for s in work.inner.symbols)  # names that a user chooses contain no dot
    new = tuple(map(domain.space.sym, names))
    ends = work.leave(domain, new, old, frame)
    if ends == new:
        return None
    fields = (*kernel.state, Field("moved", names, "the coordinates after the step"))
    return _kernel(kernel, fields, ends, _names(kernel))


def _names(kernel: Kernel) -> Callable[[str], str]:
    """Return a function that creates names that the kernel does not use."""
    taken = {s for f in kernel.state for s in f.symbols} | set(kernel.scalars)

    def name(base: str) -> str:
        while base in taken:
            base += "_"
        taken.add(base)
        return base

    return name


def _kernel(
    kernel: Kernel, state: Sequence[Field], ends: Sequence[Expr], name: Callable[[str], str]
) -> Kernel:
    """Return a kernel that computes the expressions ``ends`` from the fields ``state``."""
    schedule = Assignments((), ends, {}, name)
    body = tuple(x for x in schedule.run() if isinstance(x, Let))
    return Kernel(kernel.name, tuple(state), kernel.scalars, body, schedule.outputs)
