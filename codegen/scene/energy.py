"""The operations from which discrete gradient methods are built: the energy, its trivialised differential,
the discrete gradient (secant), and the bivector (section 2.6 of H. Marthinsen's thesis).

Consider the equation x' = f(x).x, where f(x) is in the Lie algebra g, and the dot denotes the action of g on
the state x. Let gamma be the trivialised differential of the energy H (:func:`differential`). The bivector
omega is a skew bilinear form on the dual g*, and <lambda, f> = omega(gamma, lambda) for all lambda in g*.
Therefore H is constant along the solutions: <gamma, f> = omega(gamma, gamma) = 0.

For Hamilton's equations on T*G, omega is the canonical bivector. For all other equations, f is given, and
the matrix of omega is (gamma f^T - f gamma^T)/|gamma|^2, where gamma and f are columns of coordinates. The
formula requires that f is zero wherever gamma is zero.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import CotangentBundle, DirectProduct
from codegen.groups.linear_algebra import S, Vector, dot, units
from codegen.ir.differentiate import gradient
from codegen.ir.domain import Domain, Value, Values
from codegen.ir.expr import Expr, evaluate
from codegen.scene.values import Bindings

if TYPE_CHECKING:
    from codegen.scene.sites import Sites

ENERGY = "energy"
"""If a problem has no Hamiltonian, its energy is the invariant with this name."""

OPERATIONS = frozenset({"energy", "differential", "secant", "bivector"})
"""The names of the operations that :func:`apply` evaluates."""


class Conservative(Protocol):
    """A problem y' = f.y, where f is the field. ``hamiltonian`` may be None. ``invariants`` may be empty."""

    @property
    def group(self) -> LieGroup:
        """The group that acts on the states."""

    @property
    def action(self) -> Action:
        """The action of the group on the states."""

    @property
    def roots(self) -> tuple[Expr, ...]:
        """The formulas of the field f in the equation y' = f.y. The values of f are in the Lie algebra."""

    @property
    def hamiltonian(self) -> Expr | None:
        """The Hamiltonian H, or None for field scenes and for scenes with a wrench."""

    @property
    def invariants(self) -> Mapping[str, Expr]:
        """The formulas of the invariants that the scene declares, by name."""

    @property
    def sites(self) -> Sites | None:
        """The lattice if the scene describes one site of a lattice. Otherwise the value is None."""

    @property
    def symbols(self) -> tuple[str, ...]:
        """The symbols of all coordinates of the state."""

    def values(self, domain: Domain, state: Sequence[S], t: S | None = None) -> Bindings:
        """Return the value of each symbol in the formulas of the problem, for the given state and time."""


def energy_of(problem: Conservative) -> Expr | None:
    """Return the energy of a problem, or None if the problem has no energy.

    If ``problem`` describes one site of a lattice, the result is the energy of the site plus the energies of
    all bonds of the site. For a problem without a Hamiltonian, the result is the invariant with the name
    ``energy``.
    """
    if problem.sites is not None:
        return problem.sites.energy
    return problem.hamiltonian if problem.hamiltonian is not None else problem.invariants.get(ENERGY)


def apply(problem: Conservative, d: Domain, name: str, args: Values) -> Value:
    """Return the value of the operation ``name``, one of :data:`OPERATIONS`.

    KeyError is raised if the operation needs the energy, but the problem has no energy.
    """
    match name:
        case "energy":
            return evaluate([_root(problem)], d, problem.values(d, *args))[0]
        case "differential":
            return differential(problem, d, *args)
        case "bivector":
            return bivector(problem, d, *args)
        case _:
            return secant(d, *args)


def _root(problem: Conservative) -> Expr:
    root = energy_of(problem)
    return problem.invariants[ENERGY] if root is None else root


@lru_cache(maxsize=64)
def _slopes(root: Expr, symbols: tuple[str, ...]) -> tuple[Expr, ...]:
    return tuple(gradient(root, symbols))


def differential(problem: Conservative, d: Domain, y: Vector[S]) -> Vector[S]:
    """Return the covector gamma(y), the trivialised differential of the energy H.

    For each element e of the Lie algebra, <gamma(y), e> is the derivative of H(exp(eps e).y) with respect to
    eps at eps = 0.
    """
    slopes: Vector[S] = tuple(evaluate(_slopes(_root(problem), problem.symbols), d, problem.values(d, y)))
    basis: tuple[Vector[S], ...] = units(d, problem.group.dim)
    return tuple(dot(slopes, problem.action.velocity(d, problem.group, e, y)) for e in basis)


def bivector(problem: Conservative, d: Domain, y: Vector[S], alpha: Vector[S]) -> Vector[S]:
    """Apply the bivector omega at the state y to the covector alpha.

    For alpha = ``differential(problem, d, y)``, the result is the field f(y).
    """
    if canonical(problem):
        return _canonical(problem.group, d, y, alpha)
    gamma = differential(problem, d, y)
    f: Vector[S] = tuple(evaluate(problem.roots, d, problem.values(d, y)))
    size = dot(gamma, gamma)
    along, across = (d.call("quotient", dot(x, alpha), size) for x in (gamma, f))
    return tuple(along * a - across * b for a, b in zip(f, gamma, strict=True))


def canonical(problem: Conservative) -> bool:
    """Return True if the equations are Hamilton's equations on T*G, or on a product T*G_1 x ... x T*G_n."""
    hamiltonian = problem.hamiltonian is not None or (problem.sites is not None and bool(problem.sites.force))
    product = problem.group.offers(DirectProduct)
    factors = (problem.group,) if product is None else product.factors
    return hamiltonian and all(factor.offers(CotangentBundle) is not None for factor in factors)


def _canonical(group: LieGroup, d: Domain, y: Vector[S], alpha: Vector[S]) -> Vector[S]:
    """Apply the canonical bivector at the state y to the covector alpha.

    ``group`` is a cotangent bundle T*G, or a product T*G_1 x ... x T*G_n.
    """
    product = group.offers(DirectProduct)
    if product is None:
        return group.require(CotangentBundle).canonical(d, y, alpha)
    rows = zip(product.factors, product.parts(y), product.parts(alpha), strict=True)
    return tuple(x for factor, z, a in rows for x in _canonical(factor, d, z, a))


def secant(d: Domain, g: Vector[S], x: Vector[S], before: S, after: S) -> Vector[S]:
    """Return the discrete gradient for a displacement by exp(x) (eq. 2.31 of Marthinsen's thesis).

    The covector g approximates the differential of the energy. Among all covectors p for which <p, x> is the
    energy increment ``after - before``, the result is nearest to g in the Euclidean norm. If x is zero, the
    result is g.
    """
    factor: S = d.call("quotient", after - before - dot(g, x), dot(x, x))
    return tuple(a + factor * b for a, b in zip(g, x, strict=True))
