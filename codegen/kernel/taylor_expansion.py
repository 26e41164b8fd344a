"""Kernels of Taylor polynomials: the coefficients, unrolled or as a loop over the order, and the projection.

Unrolled code of degree P takes about P^2 operations for each product of the field. It is fastest as long as
it fits into the instruction cache, so longer code becomes a loop.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from codegen.errors import MethodError
from codegen.ir.expr import Expr
from codegen.ir.kernel import Expansion, Field, Kernel, Let
from codegen.ir.program import Program
from codegen.ir.taylor_loop import OrderLoop, order_loop
from codegen.kernel.assignments import Assignments
from codegen.kernel.carried_momentum import Frames
from codegen.kernel.shared_angles import SharedArguments
from codegen.scene.problem import TIME, Problem
from codegen.scene.taylor import coefficients, recurrence

UNROLLED = 3500
"""The largest estimate of the operations of unrolled code, products times P^2.

The instruction cache of most processors holds 32 KB, about 4000 operations. On heavy_top, with 21 products,
a step of taylor(12) takes 0.42 us unrolled and 0.53 us in a loop, a step of taylor(16) 1.5 us and 0.82 us. On
dipole, with 85 products, a step of taylor(6) takes 0.39 us and 0.53 us, a step of taylor(8) 1.4 us and 0.88
us."""


def looped_kernel(program: Program, problem: Problem, degree: int) -> Kernel | None:
    """Return the kernel that computes the coefficients in a loop, None if unrolled code is short enough."""
    if problem.body_group is not None:
        return None
    loop = _loop(problem)
    if len(loop.sums) * degree**2 <= UNROLLED:
        return None
    fields = Frames(problem, program).fields()
    empty = Kernel(program.name, fields, (TIME, "h", *problem.runtime), (), ())
    expansion = replace(_expansion(empty, problem, degree, loop), controlled=False)
    return replace(empty, expansion=expansion)


def with_step_control(kernel: Kernel, problem: Problem, degree: int) -> Kernel:
    """Return a kernel with a run that chooses its steps from the coefficients.

    :class:`codegen.errors.MethodError` for a state with momenta of the body.
    """
    if problem.body_group is not None:
        raise MethodError(
            "step control by Taylor coefficients in the body frame",
            expected="the momentum in space",
            hint="leave --frame body out",
        )
    if kernel.expansion is not None:
        return replace(kernel, expansion=replace(kernel.expansion, controlled=True))
    return replace(kernel, expansion=_expansion(kernel, problem, degree, None))


def _loop(problem: Problem) -> OrderLoop:
    domain = SharedArguments()
    state = tuple(map(domain.space.sym, problem.symbols))
    terms = recurrence(problem, domain, state, domain.space.sym(TIME), domain.space.one)
    return order_loop(terms, domain.space)


def _expansion(kernel: Kernel, problem: Problem, degree: int, loop: OrderLoop | None) -> Expansion:
    """Return the expansion of a problem: a loop where one is given, else unrolled."""
    correction = _correction(kernel, problem)
    if loop is None:
        return Expansion(degree, _unrolled(kernel, problem, degree), correction)
    name = _names(kernel)
    first = _kernel(kernel, kernel.state, (*loop.first, *loop.start), name)
    following = _kernel(kernel, (), (*loop.left, *loop.right, *loop.following), name)
    return Expansion(degree, first, correction, following, len(loop.sums))


def _unrolled(kernel: Kernel, problem: Problem, degree: int) -> Kernel:
    domain = SharedArguments()
    space = domain.space
    state = tuple(map(space.sym, problem.symbols))
    # In powers of the time itself: the step size is not known when they are computed.
    rows = coefficients(problem, domain, degree, state, space.sym(TIME), space.one)
    ends = [space.zero if row[n] is None else row[n] for n in range(1, degree + 1) for row in rows]
    return _kernel(kernel, kernel.state, ends, _names(kernel))


def _correction(kernel: Kernel, problem: Problem) -> Kernel | None:
    domain = SharedArguments()
    old = tuple(map(domain.space.sym, problem.symbols))
    names = tuple(f"{s}.moved" for s in problem.symbols)  # a dot: no name that a user gives
    new = tuple(map(domain.space.sym, names))
    ends = problem.to_orbit(domain, new, old)
    if all(a is b for a, b in zip(ends, new, strict=True)):
        return None
    fields = (*kernel.state, Field("moved", names, "the state after the step"))
    return _kernel(kernel, fields, ends, _names(kernel))


def _names(kernel: Kernel) -> Callable[[str], str]:
    """Return a function that returns names which differ from those of the kernel and from one another."""
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
    """Return the kernel that computes expressions of a state."""
    schedule = Assignments((), ends, {}, name)
    body = tuple(x for x in schedule.run() if isinstance(x, Let))
    return Kernel(kernel.name, tuple(state), kernel.scalars, body, schedule.outputs)
