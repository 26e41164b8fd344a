"""The interface of exact flows. An exact flow is the exact solution for one summand (part) of a Hamiltonian.

The flow of a part H_k moves the state (q, mu) along the solution of

    q' = xi.q,   mu' = n - ad*_xi mu,   xi = D_2 H_k,   n = -(D_1 H_k).q^-1.

D_1 and D_2 are the derivatives with respect to q and mu (eq. 2.27 of H. Marthinsen's thesis).
:mod:`codegen.flows` has one class for each kind of flow in closed form.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain


class Flow(ABC):
    """The exact flow of one part of the Hamiltonian, in closed form.

    ``timed`` is True if the part depends on t. The value of t is constant along the flow. The argument
    ``values`` of the methods contains the initial values of all symbols: the state, the parameters and t.
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
        """Return (xi, n), where q' = xi.q and mu' = n - ad*_xi mu along this flow.

        ArithmeticError is raised if the flow has no formula for its field.
        """

    @abstractmethod
    def text(self) -> str:
        """Return a text that describes the motion along the flow."""
