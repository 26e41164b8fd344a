"""What discrete gradients see of a scene: its energy H, the trivialised differential of H, and the bivector.

Thesis section 2.6: a field that keeps H is x' = f(x).x with f = i_{dH} omega for a bivector omega on g*. The
differential is gamma(x) = R*_x dH in g*, paired with e what dH is with e.x. On T*G the bivector is the
canonical one; elsewhere it is made of f and gamma, which is taken for an element of g by the Euclidean inner
product of the algebra's coordinates: omega = (gamma wedge f)/|gamma|^2, and f = 0 wherever gamma = 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, Protocol

from codegen.groups.base import Scalars, dot
from codegen.groups.cotangent import Cotangent
from codegen.ir.differentiate import gradient
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr, evaluate

ENERGY = "energy"
"""The invariant of a field scene that is kept."""

OPERATIONS = frozenset({"energy", "differential", "secant", "bivector"})
"""The operations of step programs that this module carries out."""


class Conservative(Protocol):
    """The parts of a scene that are read here."""

    @property
    def group(self) -> Any:
        """The group."""

    @property
    def action(self) -> Any:
        """Its action."""

    @property
    def roots(self) -> tuple[Expr, ...]:
        """The components of f."""

    @property
    def hamiltonian(self) -> Expr | None:
        """H, where there is one."""

    @property
    def invariants(self) -> Mapping[str, Expr]:
        """The declared invariants."""

    @property
    def symbols(self) -> tuple[str, ...]:
        """All coordinates of the state in order."""

    def values(self, domain: Domain, state: Any, t: Any = None) -> dict[str, Any]:
        """Return the values of all symbols."""


def energy_of(scene: Conservative) -> Expr | None:
    """Return the Hamiltonian, or the invariant called ``energy``; None where there is neither."""
    return scene.hamiltonian if scene.hamiltonian is not None else scene.invariants.get(ENERGY)


def apply(scene: Conservative, d: Domain, name: str, args: tuple[Any, ...]) -> Any:
    """Return the value of one of :data:`OPERATIONS`; a scene without an energy is a KeyError."""
    match name:
        case "energy":
            return _energy(scene, d, *args)
        case "differential":
            return differential(scene, d, *args)
        case "bivector":
            return bivector(scene, d, *args)
        case _:
            return secant(d, *args)


def _root(scene: Conservative) -> Expr:
    root = energy_of(scene)
    return scene.invariants[ENERGY] if root is None else root


def _energy(scene: Conservative, d: Domain, y: Scalars) -> Any:
    """Return H(y)."""
    return evaluate([_root(scene)], d, scene.values(d, y))[0]


@lru_cache(maxsize=64)
def _slopes(root: Expr, symbols: tuple[str, ...]) -> tuple[Expr, ...]:
    return tuple(gradient(root, symbols))


def differential(scene: Conservative, d: Domain, y: Scalars) -> Scalars:
    """Return gamma(y): its pairing with e is the derivative of H(exp(eps e).y) at eps = 0."""
    slopes = evaluate(_slopes(_root(scene), scene.symbols), d, scene.values(d, y))
    n = scene.group.dim
    units = (tuple(d.rational(int(i == j)) for j in range(n)) for i in range(n))
    return tuple(dot(tuple(slopes), scene.action.velocity(d, scene.group, e, y)) for e in units)


def bivector(scene: Conservative, d: Domain, y: Scalars, alpha: Scalars) -> Scalars:
    """Return omega_y(alpha, .) in the algebra, for a covector alpha; f(y) where alpha is gamma(y)."""
    if isinstance(scene.group, Cotangent) and scene.hamiltonian is not None:
        return tuple(scene.group.canonical(d, y, alpha))
    gamma = differential(scene, d, y)
    f = evaluate(scene.roots, d, scene.values(d, y))
    size = dot(gamma, gamma)
    along, across = (d.call("quotient", dot(x, alpha), size) for x in (gamma, tuple(f)))
    return tuple(along * a - across * b for a, b in zip(f, gamma, strict=True))


def secant(d: Domain, g: Scalars, x: Scalars, before: Any, after: Any) -> Scalars:
    """Return the covector nearest to g whose pairing with x is ``after - before`` (thesis eq. 2.31).

    Nearest in the Euclidean norm: g plus a multiple of x, which vanishes with x.
    """
    factor = d.call("quotient", after - before - dot(g, x), dot(x, x))
    return tuple(a + factor * b for a, b in zip(g, x, strict=True))
