"""The interface of exact flows. An exact flow advances the state of a problem along one summand (part) of its
Hamiltonian.

The part H_k of H = sum H_k moves (q, mu) for a time tau along the solution of q' = xi.q, mu' = n - ad*_xi mu.
Here xi = D_2 H_k and n = -(D_1 H_k).q^-1, where D_1 and D_2 are the derivatives with respect to q and mu (eq.
2.27 of H. Marthinsen's thesis). :mod:`codegen.flows` has one class for each kind of flow in closed form.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Flow(ABC):
    """The exact flow of one part of the Hamiltonian, in closed form over any number domain.

    ``timed`` is True if the part depends on t. The flow then keeps t fixed while the state moves. The
    argument ``values`` of the methods maps all symbols (the state, the parameters and t) to their values
    before the motion along the flow.
    """

    timed: bool = False

    @abstractmethod
    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (q, mu) after the time tau."""

    @abstractmethod
    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the field (xi, n) of this flow.

        ArithmeticError is raised if the flow has no formula for its field.
        """

    @abstractmethod
    def text(self) -> str:
        """Return a text that describes the motion along the flow."""
