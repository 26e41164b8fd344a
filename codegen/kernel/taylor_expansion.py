"""Kernels of a run that chooses its steps from Taylor coefficients: the coefficients, and the projection."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.errors import MethodError
from codegen.ir.expr import Expr
from codegen.ir.kernel import Expansion, Field, Kernel, Let
from codegen.kernel.assignments import Assignments
from codegen.kernel.shared_angles import SharedArguments
from codegen.scene.problem import TIME, Problem
from codegen.scene.taylor import coefficients


def with_expansion(kernel: Kernel, problem: Problem, degree: int) -> Kernel:
    """Return a kernel with the Taylor polynomial of its problem.

    :class:`codegen.errors.MethodError` for a state with momenta of the body.
    """
    if problem.body_group is not None:
        raise MethodError(
            "step control by Taylor coefficients in the body frame",
            expected="the momentum in space",
            hint="leave --frame body out",
        )
    expansion = Expansion(degree, _coefficients(kernel, problem, degree), _correction(kernel, problem))
    return replace(kernel, expansion=expansion)


def _coefficients(kernel: Kernel, problem: Problem, degree: int) -> Kernel:
    domain = SharedArguments()
    space = domain.space
    state = tuple(map(space.sym, problem.symbols))
    # In powers of the time itself: the step size is not known when they are computed.
    rows = coefficients(problem, domain, degree, state, space.sym(TIME), space.one)
    ends = [space.zero if row[n] is None else row[n] for n in range(1, degree + 1) for row in rows]
    return _kernel(kernel, kernel.state, ends)


def _correction(kernel: Kernel, problem: Problem) -> Kernel | None:
    domain = SharedArguments()
    old = tuple(map(domain.space.sym, problem.symbols))
    names = tuple(f"{s}.moved" for s in problem.symbols)  # a dot: no name that a user gives
    new = tuple(map(domain.space.sym, names))
    ends = problem.to_orbit(domain, new, old)
    if all(a is b for a, b in zip(ends, new, strict=True)):
        return None
    return _kernel(kernel, (*kernel.state, Field("moved", names, "the state after the step")), ends)


def _kernel(kernel: Kernel, state: Sequence[Field], ends: Sequence[Expr]) -> Kernel:
    """Return the kernel that computes expressions of a state."""
    taken = {s for f in state for s in f.symbols} | set(kernel.scalars)

    def name(base: str) -> str:
        while base in taken:
            base += "_"
        taken.add(base)
        return base

    schedule = Assignments((), ends, {}, name)
    body = tuple(x for x in schedule.run() if isinstance(x, Let))
    return Kernel(kernel.name, tuple(state), kernel.scalars, body, schedule.outputs)
