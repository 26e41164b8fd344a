"""Variations of a state: the coordinates in which the Jacobian of a step is expressed.

A group element q is varied by an element xi of the Lie algebra: dq = xi.q (right trivialisation). In all
other values (for example, momenta) each component is varied independently.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.errors import SceneError
from codegen.groups.actions import LeftMultiplication
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import CotangentBundle, RightTrivialisation
from codegen.ir.domain import ExprDomain
from codegen.ir.expr import Expr
from codegen.ir.values import Kind
from codegen.scene.problem import Problem


@dataclass(frozen=True)
class Variations:
    """Describes the variation of each part of a state.

    Each part is a pair (group, coordinates). If the group is None, each coordinate is varied independently.
    Otherwise the variation is an element of the Lie algebra.
    """

    parts: tuple[tuple[RightTrivialisation | None, tuple[str, ...]], ...]

    @classmethod
    def of(cls, scene: Problem) -> Variations:
        """Return the parts of the state of ``scene``.

        SceneError is raised if the state contains an element of a group without right trivialisation.
        """
        parts: list[tuple[LieGroup | None, tuple[str, ...]]] = []
        for block in scene.state:
            # If the group acts on itself by left multiplication, a point of the manifold is a group element.
            moved = block.kind is Kind.POINT and isinstance(scene.action, LeftMultiplication)
            bundle = scene.group.offers(CotangentBundle) if moved else None
            if bundle is not None:
                base = bundle.base
                # In the right trivialisation, an element of T*G is a pair of a group element and a momentum.
                parts += [(base, block.symbols[: base.size]), (None, block.symbols[base.size :])]
            elif block.kind is Kind.GROUP or moved:
                parts.append((scene.group, block.symbols))
            else:
                parts.append((None, block.symbols))
        return cls(tuple((_trivialised(scene, group), symbols) for group, symbols in parts))

    @property
    def dim(self) -> int:
        """The number of components of a variation."""
        return sum(len(symbols) if group is None else group.dim for group, symbols in self.parts)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the components of a variation."""
        # Names in a scene are identifiers, so a name with a dot is always new.
        return tuple(f"vary.{k}" for k in range(self.dim))

    def seeds(self, domain: ExprDomain) -> dict[str, Expr]:
        """Return the derivative of each symbol of the state in the direction of the variation."""
        rest = tuple(domain.space.sym(name) for name in self.names)
        seeds: dict[str, Expr] = {}
        for group, symbols in self.parts:
            count = len(symbols) if group is None else group.dim
            # The next ``count`` components of the variation belong to this part of the state.
            own, rest = rest[:count], rest[count:]
            state = tuple(domain.space.sym(s) for s in symbols)
            # For a group element q and a variation xi, ``velocity`` computes the derivative dq = xi.q.
            rates = own if group is None else group.velocity(domain, own, state)
            seeds |= dict(zip(symbols, rates, strict=True))
        return seeds

    def ends(self, domain: ExprDomain, state: tuple[Expr, ...], rates: tuple[Expr, ...]) -> tuple[Expr, ...]:
        """Return the variation of the state after a step.

        ``state`` contains the coordinates of the state after the step. For each of these coordinates,
        ``rates`` contains the directional derivative along the variation of the old state. For each group
        element g with the derivative v in ``rates``, the result contains the element xi of the Lie algebra
        with v = xi.g.
        """
        rates_of_end: list[Expr] = []
        for group, symbols in self.parts:
            count = len(symbols)
            g, v, state, rates = state[:count], rates[:count], state[count:], rates[count:]
            # For a group element g with the derivative v, ``rate`` computes the element xi of the Lie algebra
            # with v = xi.g.
            rates_of_end += v if group is None else group.rate(domain, v, g)
        return tuple(rates_of_end)

    def text(self) -> str:
        """Return a text that lists the components of a variation with their indices and their meaning."""
        words = []
        first = 0
        for group, symbols in self.parts:
            count = len(symbols) if group is None else group.dim
            what = (
                f"d({symbols[0]}..{symbols[-1]})" if group is None else f"xi, where dq = xi.q on {group.name}"
            )
            words.append(f"[{first}..{first + count - 1}] {what}")
            first += count
        return "; ".join(words)


def _trivialised(scene: Problem, group: LieGroup | None) -> RightTrivialisation | None:
    """Return the right trivialisation of ``group``, or None if ``group`` is None.

    SceneError is raised if the group has no right trivialisation.
    """
    if group is None:
        return None
    trivialised = group.offers(RightTrivialisation)
    if trivialised is None:
        raise SceneError(
            "the derivative of a step requires a right trivialisation, "
            f"which is not implemented for {group.name}",
            where=scene.name,
            expected="a group with right-trivialised tangent vectors",
        )
    return trivialised
