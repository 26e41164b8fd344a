"""On R^n every family is its classical method, and time enters at the stages: the oscillator of Paper 3.

The classical methods are written once more here, in 40 digits at a time that is not zero, so that a stage
time that is wrong in any family shows. The exact step over Q[[h]] gives the orders.
"""

from __future__ import annotations

from fractions import Fraction

import mpmath
import pytest

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.interpret import interpret
from codegen.ir.operations import Advance
from codegen.kernel.operations import operations
from codegen.kernel.schedule import arrange
from codegen.lab.orders.convergence import converge
from codegen.lab.orders.local_error import local_error, valuation
from codegen.lab.reference import reference
from codegen.lab.runner import Emitted
from codegen.lower import lower, problem_for
from codegen.method import Method
from codegen.passes import optimise
from codegen.passes.rewrite import rewrite
from codegen.scenes import load
from orderconds.ring import QQ
from tests.promises import COMPILERS
from tests.strategies import full, shipped, starting

SCENE = load("linear_oscillator")
DOMAIN = PreciseDomain(Fraction(1, 50), 40)
ENOUGH = 25
"""Sweeps of fixed-point iteration: each gains at least a factor 25."""


def stepped(method, program=None):
    """One step of the optimised program from the initial state at the time 1/3, as (q, p)."""
    view = problem_for(SCENE, method)
    made = program or optimise(lower(SCENE, method), view)[0]
    inputs = {k: v for k, v in starting(view, DOMAIN).items() if k in [i.name for i in made.inputs]}
    found = interpret(made, view, DOMAIN, inputs)
    flat = [x for block in view.state for x in found[block.name]]
    return flat[:4], flat[4:]


def numbers(method, rows):
    return [[DOMAIN.number(method.number(x)) for x in row] for row in rows]


def stiffness(c):
    """1 + eps sin(alpha t) at the stage time 1/3 + c h."""
    t = DOMAIN.rational(1, 3) + c * DOMAIN.h
    return 1 + DOMAIN.rational(1, 10) * DOMAIN.call("sin", DOMAIN.rational(123, 1000) * t)


def combined(start, row, slopes):
    return [
        x + DOMAIN.h * sum(a * s[k] for a, s in zip(row, slopes, strict=True)) for k, x in enumerate(start)
    ]


Q0, P0 = [DOMAIN.rational(n) for n in (1, 2, 3, 4)], [DOMAIN.rational(n) for n in (4, 1, 2, 3)]


def partitioned(A, Ahat, b):
    """A partitioned Runge-Kutta method for q' = p, p' = -stiffness(t) q, the time with A's nodes."""
    c = [sum(row) for row in A]
    Q, P = [Q0] * len(b), [P0] * len(b)
    for _ in range(ENOUGH):
        F = [[-stiffness(ci) * x for x in q] for ci, q in zip(c, Q, strict=True)]
        Q, P = [combined(Q0, row, P) for row in A], [combined(P0, row, F) for row in Ahat]
    F = [[-stiffness(ci) * x for x in q] for ci, q in zip(c, Q, strict=True)]
    return combined(Q0, b, P), combined(P0, b, F)


def close(found, expected):
    pairs = [pair for x, y in zip(found, expected, strict=True) for pair in zip(x, y, strict=True)]
    return all(abs(x - y) < 1e-36 for x, y in pairs)


def coefficients(name):
    """A and b of a Butcher tableau, or of a commutator-free one whose exponentials are added up."""
    tableau = shipped(name) if isinstance(name, str) else name
    method = Method("rk", tableau)
    if tableau.family != "cf":
        rk = method.runge_kutta()
        *A, b = numbers(method, [*rk.A, rk.b])
        return A, b
    free = Method("cf", tableau).commutator_free()
    rows = []
    for stage in (*free.stages, free.update):
        exponentials = numbers(method, stage.exponentials)
        own = [sum(column) for column in zip(*exponentials, strict=True)] or [0] * free.s
        rows.append(
            own if stage.start is None else [x + y for x, y in zip(own, rows[stage.start], strict=True)]
        )
    return rows[:-1], rows[-1]


COLLAPSED = [
    *(
        (family, name, cutoff)
        for name in ("rk4", "gauss2")
        for family, cutoff in (("rk", None), ("cg", None))
    ),
    *(("rkmk", name, cutoff) for name in ("kutta3", "gauss2") for cutoff in (0, 1, 2)),
    ("cg", "cg3", None),
    ("rkmk", full(2), 2),
    ("cg", full(3), None),
    *(("cf", name, None) for name in ("cf3", "cf4", "luescher3")),
]


@pytest.mark.parametrize(
    ("family", "name", "cutoff"), COLLAPSED, ids=[f"{f}{c}-{getattr(n, 'name', n)}" for f, n, c in COLLAPSED]
)
def test_lie_group_methods_are_runge_kutta_methods(family, name, cutoff):
    A, b = coefficients(name)
    method = Method(family, shipped(name) if isinstance(name, str) else name, cutoff)
    assert close(stepped(method), partitioned(A, A, b))


def test_the_commutator_free_method_of_order_four_is_the_classical_runge_kutta_method():
    pairs = zip(coefficients("cf4"), coefficients("rk4"), strict=True)
    (A, Ark), (b, brk) = pairs
    assert close([*A, b], [*Ark, brk])
    assert close(stepped(Method("cf", shipped("cf4"))), stepped(Method("rk", shipped("rk4"))))


@pytest.mark.parametrize("name", ["midpoint", "kutta3", "gauss2", "triple_jump", full(2)])
def test_variational_methods_are_symplectic_partitioned_ones(name):
    A, b = coefficients(name)
    stages = range(len(b))
    Ahat = [[b[j] - b[j] * A[j][i] / b[i] for j in stages] for i in stages]
    method = Method("vcg", shipped(name) if isinstance(name, str) else name)
    assert close(stepped(method), partitioned(A, Ahat, b))


def test_another_tableau_is_told_apart():
    """The check itself."""
    assert not close(
        stepped(Method("rk", shipped("rk4"))), partitioned(*[coefficients("gauss2")[0]] * 2, [0.5, 0.5])
    )


METHODS = [
    (Method("rk", shipped("rk4")), 4),
    (Method("rkmk", shipped("rk4"), 2), 4),
    (Method("rkmk", shipped("rk4"), 0), 4),
    (Method("cg", shipped("cg3")), 3),
    (Method("cf", shipped("cf4")), 4),
    (Method("cf", shipped("williamson3")), 3),
    (Method("vcg", shipped("midpoint")), 2),
    (Method("vcg", shipped("kutta3")), 3),
]
IDS = [m.label for m, _ in METHODS]


def still(program):
    """The program with every stage time at t: the classic fault."""

    def rule(rewriter, assign):
        return assign.args if isinstance(assign.operation, Advance) else rewriter.emit(assign)

    return rewrite(program, rule)


@pytest.mark.parametrize(("method", "order"), METHODS, ids=IDS)
def test_the_order_with_time_is_exact(method, order):
    """Brackets vanish here: RKMK without any has the order of its tableau."""
    view = problem_for(SCENE, method)
    program, _ = optimise(lower(SCENE, method), view)
    assert valuation(local_error(program, view, QQ, order + 1)) == order + 1


@pytest.mark.parametrize(("method", "order"), METHODS, ids=IDS)
def test_a_time_that_stands_still_leaves_order_one(method, order):
    view = problem_for(SCENE, method)
    program, _ = optimise(lower(SCENE, method), view)
    assert valuation(local_error(still(program), view, QQ, order + 1)) == 2
    assert not close(stepped(method, still(program)), stepped(method))


@pytest.mark.parametrize("spelling", ["rkmk(2):rk4", "rkmk(0):rk4"])
def test_nothing_is_left_of_brackets_and_exponentials(spelling):
    plain, lie = compile_method("linear_oscillator", "rk:rk4"), compile_method("linear_oscillator", spelling)
    assert operations(arrange(lie.kernel)) == operations(arrange(plain.kernel))


@pytest.mark.parametrize(
    ("compiler", "spelling"),
    [
        pytest.param(c, m, marks=() if c == "gcc" or m == "cf4" else pytest.mark.slow)
        for c in COMPILERS
        for m in ("vcg:midpoint", "cf4", "rk:gauss2")
    ],
    indirect=["compiler"],
)
def test_emitted_code_reads_the_time(check_codegen, spelling):
    made = compile_method("linear_oscillator", spelling)
    c, python = emit_compiled(made, "c"), emit_compiled(made, "python")
    assert c.manifest["interface"]["time"]
    view = problem_for(made.scene, made.method)

    def step(state, h, t):
        inputs, first = {"t": t}, 0
        for block in view.state:
            inputs[block.name] = tuple(state[first : first + len(block.symbols)])
            first += len(block.symbols)
        found = interpret(made.program, view, FloatDomain(h), inputs)
        return tuple(x for block in view.state for x in found[block.name])

    check_codegen(c, python, step, tuple(c.manifest["initial"]), 0.05, 64)


def test_the_reference_is_the_solution_by_its_power_series():
    """q'' = -(1 + eps sin(alpha t)) q for one coordinate, by the recursion of Taylor coefficients."""
    context = mpmath.mp.clone()
    context.dps = 40
    terms, alpha = 120, context.mpf(123) / 1000
    drive = [context.mpf(0)] * terms
    for k in range(1, terms, 2):
        drive[k] = (-1) ** (k // 2) * alpha**k / context.factorial(k) / 10
    drive[0] += 1
    x = [context.mpf(1), context.mpf(4)]
    for n in range(terms - 2):
        x.append(-sum(drive[k] * x[n - k] for k in range(n + 1)) / ((n + 1) * (n + 2)))
    q0 = sum(a * context.mpf(3) ** k for k, a in enumerate(x))
    p0 = sum(k * a * context.mpf(3) ** (k - 1) for k, a in enumerate(x) if k)
    found = reference(SCENE)
    assert abs(found.state[0] - q0) < 1e-30
    assert abs(found.state[4] - p0) < 1e-30


@pytest.mark.parametrize(
    ("spelling", "order", "elsewhere"), [("vcg:gauss2", 4, 2), ("rkmk(0):rk4", 4, 2), ("cf:cf4", 4, 4)]
)
def test_the_stated_order_is_the_classical_one_and_is_observed(spelling, order, elsewhere):
    made = compile_method(SCENE, spelling)
    stated = certified_order(made.method, SCENE)
    assert stated.order == emit_compiled(made, "c").manifest["order"] == order
    assert "because the group is abelian" in stated.text()
    assert certified_order(made.method).order == elsewhere
    found = converge(Emitted(made, "c", stated), stated, reference(SCENE))
    assert found.verdict == "holds", found.sentence()
