"""The order of an embedded error estimate, compared with the order of the local error.

The estimate is the difference between the results of the method and of its embedded method. If both results
have the same leading error term, the estimate has a higher order than the local error of the method. An
estimate of higher order is called blind.

The orders are measured with very short steps of two sizes, computed with 100 digits. The local error of a
step of size h is approximated by the difference between this step and two steps of size h/2.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from codegen.certify import certified_order
from codegen.errors import MethodError
from codegen.ir.ball_domain import BallDomain
from codegen.ir.domain import Scalar
from codegen.ir.interpret import flatten, interpret
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import blocks
from codegen.scene.problem import Problem

DIGITS = 100
SMALLEST = 60
"""The function :func:`is_blind` compares steps of the sizes h and RATIO h.

The size h satisfies (h/T)^(p + 2) = 10^-SMALLEST. Here T is the length of the time span of the scene, and p
is the order of the method.
"""

ROUNDING = 1e-90
"""A bound for relative rounding errors in computations with DIGITS digits."""

RATIO = 8
HIGHER = 0.5
"""A measured order is higher than another measured order if their difference exceeds HIGHER."""

LARGEST_CUTOFF = 12

State = tuple[Scalar, ...]


def order_of_estimate(method: Method, scene: Problem) -> int:
    """Return the order p of the error estimate of a method. For the step size h, the estimate is O(h^p).

    :class:`MethodError` is raised if there is no embedded method, or if the estimate is too small on this
    scene (:func:`is_blind`).
    """
    embedded = method.embedded()
    if embedded is None:
        raise MethodError(f"{method.label} computes no error estimate", expected="an adaptive method")
    order, lower_order = (certified_order(m, scene).order for m in (method, embedded))
    # If the field depends only on the time, two methods of different orders can give the same result. The
    # error estimate is the difference of the two results, so it is zero in this case.
    if order != lower_order and scene.linear and is_blind(method, embedded, scene, order):
        raise MethodError(
            f"no error estimate for {method.label}: the results of the method and its embedded method have "
            "the same leading error, so their difference does not estimate the error; the leading errors are "
            "equal because the field of the scene does not depend on the state",
            where=scene.name,
            expected="an embedded method whose leading error on this scene differs from that of the method",
            hint="use another tableau with an embedded method, for example cf:cf3 or rkmk(4):dormand_prince5",
        )
    if order == lower_order and is_blind(method, embedded, scene, order):
        raise MethodError(
            f"no error estimate for {method.label}: the method and its embedded method have order {order} "
            "and the same leading error",
            where=scene.name,
            expected="an embedded method of another order",
            hint=_hint(method, scene),
        )
    return 1 + min(order, lower_order)


def is_blind(method: Method, embedded: Method, scene: Problem, order: int) -> bool:
    """Return True if the error estimate of a method is blind.

    A blind estimate is zero, or of higher order in the step size than the local error. If a step fails, or if
    the local error is zero, the result is False. ``order`` is the order of ``method``.
    """
    h = float(scene.span[1] - scene.span[0]) * 10.0 ** (-SMALLEST / (order + 2))
    main, other = (_stepper(m, scene) for m in (replace(method, adaptive=False), embedded))
    try:
        estimate, error = [], []
        with (domain := BallDomain(0, DIGITS)).precision():
            start = problem_for(scene, method).initial(domain)
            for size in (h, RATIO * h):
                one = main(start, 0.0, size)
                middle = main(start, 0.0, size / 2)
                estimate.append(_gap(one, other(start, 0.0, size)))
                error.append(_gap(one, main(middle, size / 2, size / 2)))
    except (ArithmeticError, ValueError):
        return False
    if not all(error):
        return False
    return not all(estimate) or _slope(estimate) > _slope(error) + HIGHER


def _stepper(method: Method, scene: Problem) -> Callable[[Sequence[Scalar], float, float], State]:
    """Return a function that computes a step of a method in 100 digits.

    The function takes a state, the time since the start of the time span, and the step size.
    """
    # The program from ``lower`` solves the equations of all stages by iteration, even for explicit stages.
    # ``blocks.run`` replaces explicit stages by assignments.
    problem, program = problem_for(scene, method), blocks.run(lower(scene, method))

    def step(state: Sequence[Scalar], elapsed: float, h: float) -> State:
        domain = BallDomain(h, DIGITS)
        t = domain.rational(*scene.span[0].as_integer_ratio()) + domain.scalar(elapsed)
        values: dict[str, Scalar] = {"t": t}
        place = 0
        for field in problem.state:
            values[field.name] = tuple(state[place : place + len(field.symbols)])
            place += len(field.symbols)
        results = interpret(program, problem, domain, {v.name: values[v.name] for v in program.inputs})
        return tuple(x for field in problem.state for x in flatten(field.kind, results[field.name]))

    return step


def _gap(a: State, b: State) -> Scalar:
    """Return the largest difference between the entries of two states.

    If the difference can be explained by rounding errors (:data:`ROUNDING`), the result is 0.
    """
    largest = max(abs(x - y).mid() for x, y in zip(a, b, strict=True))
    return largest if largest > ROUNDING * max(1, *(abs(x).mid() for x in a)) else 0


def _slope(gaps: Sequence[Scalar]) -> float:
    return math.log(float(gaps[1] / gaps[0])) / math.log(RATIO)


def _hint(method: Method, scene: Problem) -> str:
    """Return a hint for a user whose method has a blind error estimate (:func:`is_blind`).

    If possible, the hint names a method with more brackets in the series of dexp^{-1}.
    """
    if method.cutoff is not None:
        for cutoff in range(method.cutoff + 1, LARGEST_CUTOFF + 1):
            longer = replace(method, cutoff=cutoff)
            try:
                order_of_estimate(longer, scene)
            except MethodError:
                continue
            return f"write {longer.label}"
    return "use another tableau with an embedded method"
