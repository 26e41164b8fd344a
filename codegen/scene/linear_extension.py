"""The extended phase space of a linear Hamiltonian problem y' = A(t).y.

The canonical coordinates are y = (q, p) in R^2n. Let J be the 2n x 2n block matrix (0, I; -I, 0). If A(t) is
in sp(2n), y' = A(t).y is Hamilton's equation for H = -y^T J A y/2.

The momentum u conjugate to the time has the initial value -H. The derivative u' is minus the partial
derivative of H with respect to t.

A step of a method for linear problems starts at the time t in the state y. The new state is M(t) y, where
M(t) is a symplectic matrix that depends on t. The method must also compute the new value of u. By equation
(4.15) of H. Marthinsen's thesis, the step in the coordinates (q, p, t, u) is canonical if the new value of u
is

    u + y^T M^T J (dM/dt) y/2.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from codegen.errors import SceneError
from codegen.groups.actions import FactorwiseAction, LeftMultiplication
from codegen.groups.product import Product
from codegen.groups.rn import Rn
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, Space, evaluate
from codegen.ir.formulas import Formulas
from codegen.ir.normal_form import NormalForms
from codegen.ir.number import Number
from codegen.scene.problem import TIME, Problem, StateField


def extended_linear(problem: Problem, u: str) -> Problem:
    """Return a linear problem with one more coordinate, the momentum ``u`` conjugate to the time.

    The invariant ``energy`` is H + u, where H is the Hamiltonian. :class:`SceneError` is raised if
    ``problem`` is not Hamiltonian, or if H does not depend on the time.
    """
    hamiltonian = _hamiltonian(problem)
    space = hamiltonian.space
    (block,) = problem.state
    start, values = problem.span[0], {s: space.sym(s) for s in problem.parameters}
    values |= dict(zip(block.symbols, block.initial, strict=True)) | {TIME: _constant(space, start)}
    momentum = -evaluate([hamiltonian], ExprDomain(space), values)[0]
    (slope,) = gradient(hamiltonian, (TIME,))
    return replace(
        problem,
        title=f"{problem.title}, extended by u",
        group=Product(problem.group, Rn(1)),
        action=FactorwiseAction(problem.action, LeftMultiplication()),
        state=(StateField("y", block.kind, (*block.symbols, u), (*block.initial, momentum)),),
        roots=(*problem.roots, -slope),
        invariants={"energy": hamiltonian + space.sym(u), **problem.invariants},
        signals={},
        open_roots=(),
        carries_momentum=True,
    )


def without_momentum_rate(problem: Problem) -> Problem:
    """Return the extended linear problem with u' = 0, where u is the momentum conjugate to the time.

    In a linear problem y' = A(t) y, the formulas of A must not contain the state y. The formula -dH/dt
    contains the state. Therefore the equation u' = -dH/dt is replaced by u' = 0.
    """
    zero = problem.roots[-1].space.zero
    return replace(problem, roots=(*problem.roots[:-1], zero))


def _hamiltonian(problem: Problem) -> Expr:
    refusal = f"the linear problem {problem.name} has no momentum u conjugate to the time"
    if not problem.roots:
        problem.require_formulas()
    (block,) = problem.state
    symbols, space = block.symbols, problem.roots[0].space
    if len(symbols) % 2:
        raise SceneError(
            f"{refusal}, because the number of coordinates is odd: {len(symbols)}",
            expected="an even number of coordinates: first q, then p",
        )
    point = tuple(space.sym(s) for s in symbols)
    rates = problem.action.velocity(Formulas(ExprDomain(space)), problem.group, tuple(problem.roots), point)
    n = len(symbols) // 2
    total = space.zero
    for x, y in zip((*rates[:n], *(-r for r in rates[n:])), (*point[n:], *point[:n]), strict=True):
        total = total + x * y
    hamiltonian = _constant(space, Fraction(1, 2)) * total
    slopes = gradient(hamiltonian, symbols)
    normal = NormalForms(space)
    # The linear equation is Hamilton's equation for ``hamiltonian`` if and only if A(t) is in sp(2n).
    canonical = (*slopes[n:], *(-s for s in slopes[:n]))
    if not all(normal(a - b).is_zero for a, b in zip(rates, canonical, strict=True)):
        raise SceneError(
            f"{refusal}, because A(t) is not in sp({2 * n}) for the coordinates (q, p)",
            expected="A(t) with J A symmetric, where J = (0, I; -I, 0)",
        )
    if normal(gradient(hamiltonian, (TIME,))[0]).is_zero:
        raise SceneError(
            f"the Hamiltonian of {problem.name} does not depend on time",
            expected="a Hamiltonian that depends on t",
            hint="remove +u from the name of the scene",
        )
    return hamiltonian


def _constant(space: Space, x: Fraction) -> Expr:
    return space.const(Number.rational(x.numerator, x.denominator))
