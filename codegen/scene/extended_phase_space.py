"""The extended phase space, on which a Hamiltonian H that depends on time becomes autonomous.

The time becomes the coordinate tau, and u is the momentum conjugate to tau. The new Hamiltonian on T*(G x R)
is K(q, tau, mu, u) = H(q, mu, tau) + u. The equations of tau and u are tau' = 1 and u' = -dH/dtau. The
initial value of u is -H at the initial state. Therefore K is zero along the exact solution (H. Marthinsen's
thesis, section 4.3.2).
"""

from __future__ import annotations

from dataclasses import replace

from codegen.errors import SceneError
from codegen.groups.product import Product
from codegen.groups.rn import Rn
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.scene.canonical_equations import force
from codegen.scene.linear_extension import extended_linear
from codegen.scene.problem import TIME, Problem, StateField


def extended(problem: Problem) -> Problem:
    """Return the problem on the extended phase space.

    The problem must have a Hamiltonian that depends on time, or it must be a linear Hamiltonian equation
    y' = A(t).y. For all other problems SceneError is raised.

    A linear equation gets one new coordinate: u, the momentum conjugate to the time. The time does not become
    a coordinate, because A(t).y would then be nonlinear. Other problems get two new coordinates: u and the
    time tau. If a name is already used, underscores are appended. If the Hamiltonian has parts, u is added to
    the first part that does not depend on time. If all parts depend on time, u becomes a new part.
    """
    if problem.linear and not problem.paired and not problem.carries_momentum:
        return extended_linear(problem, _fresh("u", {*problem.symbols, *problem.parameters}))
    hamiltonian = _timed(problem)
    space = hamiltonian.space
    domain = ExprDomain(space)
    taken = {*problem.symbols, *problem.parameters}
    tau, u = (_fresh(name, taken) for name in ("tau", "u"))
    symbols = {s: space.sym(s) for s in sorted(taken)}

    def moved(root: Expr) -> Expr:
        """Return the expression ``root`` with tau in place of the time."""
        replaced: Expr = evaluate([root], domain, {**symbols, TIME: space.sym(tau)})[0]
        return replaced

    extended_hamiltonian = moved(hamiltonian) + space.sym(u)
    group = Product(problem.group, Rn(1))
    q, mu = problem.state
    start = space.const(Number.rational(problem.span[0].numerator, problem.span[0].denominator))
    values = {**symbols, TIME: start}
    values |= {s: e for block in problem.state for s, e in zip(block.symbols, block.initial, strict=True)}
    momentum = -evaluate([hamiltonian], domain, values)[0]
    state = (
        StateField("q", q.kind, (*q.symbols, tau), (*q.initial, start)),
        StateField("mu", mu.kind, (*mu.symbols, u), (*mu.initial, momentum)),
    )
    qs, mus = state[0].symbols, state[1].symbols
    slopes = gradient(extended_hamiltonian, qs + mus)
    parts = {name: moved(part) for name, part in problem.parts.items()}
    still = next((name for name, part in problem.parts.items() if not _reads(part, TIME)), None)
    if parts:
        parts[still or "u"] = parts[still] + space.sym(u) if still else space.sym(u)
    return replace(
        problem,
        title=f"{problem.title}, extended by u",
        group=group,
        state=state,
        hamiltonian=extended_hamiltonian,
        roots=(*slopes[len(qs) :], *force(space, group, qs, slopes[: len(qs)])),
        invariants={"energy": extended_hamiltonian} | {k: moved(x) for k, x in problem.invariants.items()},
        parts=parts,
        signals={},
        open_roots=(),
    )


def _timed(problem: Problem) -> Expr:
    """Return the time-dependent Hamiltonian of a problem. Raise SceneError if the problem has none."""
    if problem.hamiltonian is None or not problem.paired:
        raise SceneError(
            f"{problem.name} cannot be extended by a momentum u conjugate to the time",
            expected="a Hamiltonian scene, or a linear scene y' = A(t).y",
        )
    if not _reads(problem.hamiltonian, TIME):
        raise SceneError(
            f"the Hamiltonian of {problem.name} does not depend on time",
            expected="a Hamiltonian that depends on t",
            hint="remove +u from the name of the scene",
        )
    return problem.hamiltonian


def _reads(root: Expr, symbol: str) -> bool:
    return any(n.op == "sym" and n.payload == symbol for n in walk([root]))


def _fresh(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name
