"""A Hamiltonian that depends on time, extended by the time and its momentum u: a scene on request only.

On T*(G x R) the Hamiltonian K(q, tau, mu, u) = H(q, mu, tau) + u has no time: tau' = 1 and u' = -dH/dt, so
u + H is kept, and u starts at -H (thesis, section 4.3.2). Variational methods carry u by the sum of Example
4.4.5 and keep the extended symplectic form, discrete gradients keep K.
"""

from __future__ import annotations

from dataclasses import replace

from codegen.errors import SceneError
from codegen.groups.euclidean import Rn
from codegen.groups.product import Product
from codegen.ir.differentiate import gradient
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.scene.canonical_equations import force
from codegen.scene.problem import TIME, Problem, StateField


def extended(scene: Problem) -> Problem:
    """Return the extended scene; SceneError for a field, and for a Hamiltonian that does not depend on time.

    The new coordinates are called tau and u, with underscores where the scene has these names. The part
    called in ``parts`` that does not depend on time takes u, or a part of its own.
    """
    if scene.hamiltonian is None or not scene.paired:
        raise SceneError(f"{scene.name} has no momentum u", expected="a Hamiltonian scene")
    if not _reads(scene.hamiltonian, TIME):
        raise SceneError(
            f"the Hamiltonian of {scene.name} does not depend on time",
            expected="one that does",
            hint="leave +u out: u would stay as it is",
        )
    space = scene.hamiltonian.space
    domain = ExprDomain(space)
    taken = {*scene.symbols, *scene.parameters}
    tau, u = (_fresh(name, taken) for name in ("tau", "u"))
    here = {s: space.sym(s) for s in sorted(taken)}

    def moved(root: Expr) -> Expr:
        """Return root with tau in place of the time."""
        (found,) = evaluate([root], domain, {**here, TIME: space.sym(tau)})
        assert isinstance(found, Expr)
        return found

    hamiltonian = moved(scene.hamiltonian) + space.sym(u)
    group = Product(scene.group, Rn(1))
    q, mu = scene.state
    start = space.const(Number.rational(scene.span[0].numerator, scene.span[0].denominator))
    values = {**here, TIME: start}
    values |= {s: e for block in scene.state for s, e in zip(block.symbols, block.initial, strict=True)}
    momentum = -evaluate([scene.hamiltonian], domain, values)[0]
    state = (
        StateField("q", q.kind, (*q.symbols, tau), (*q.initial, start)),
        StateField("mu", mu.kind, (*mu.symbols, u), (*mu.initial, momentum)),
    )
    qs, mus = state[0].symbols, state[1].symbols
    slopes = gradient(hamiltonian, qs + mus)
    parts = {name: moved(part) for name, part in scene.parts.items()}
    still = next((name for name, part in scene.parts.items() if not _reads(part, TIME)), None)
    if parts:
        parts[still or "u"] = parts[still] + space.sym(u) if still else space.sym(u)
    return replace(
        scene,
        title=f"{scene.title}, extended by u",
        group=group,
        state=state,
        hamiltonian=hamiltonian,
        roots=(*slopes[len(qs) :], *force(space, group, qs, slopes[: len(qs)])),
        invariants={"energy": hamiltonian} | {k: moved(x) for k, x in scene.invariants.items()},
        parts=parts,
        signals={},
        open_roots=(),
    )


def _reads(root: Expr, symbol: str) -> bool:
    return any(n.op == "sym" and n.payload == symbol for n in walk([root]))


def _fresh(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name
