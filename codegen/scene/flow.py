"""The interface of the exact flows of the parts H_k of a Hamiltonian.

The exact flow of a part H_k moves the group element q and the momentum mu along the exact solution of

    q' = xi.q,   mu' = n - ad*_xi mu,   xi = D_2 H_k,   n = -(D_1 H_k).q^-1.

D_1 and D_2 are the derivatives with respect to q and mu (eq. 2.27 of H. Marthinsen's thesis).
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

from codegen.groups.capabilities import Coadjoint
from codegen.groups.linear_algebra import S, Vector
from codegen.ir.domain import Domain
from codegen.ir.expr import Expr


class Flow(ABC):
    """The exact flow of one part of the Hamiltonian, in closed form.

    ``timed`` is True if the part depends on the time t. Along the flow, t keeps its initial value. The
    argument ``values`` contains the parameters, the time t, and the state at the start of the flow.
    """

    timed: bool = False

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """The formulas that the flow evaluates. A flow that has only rational coefficients has none."""
        return ()

    @abstractmethod
    def advance(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], tau: S, q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return (q, mu) after the time tau."""

    @abstractmethod
    def field(
        self, d: Domain, group: Coadjoint, values: Mapping[str, S], q: Vector[S], mu: Vector[S]
    ) -> tuple[Vector[S], Vector[S]]:
        """Return the velocity xi and the force n, where q' = xi.q and mu' = n - ad*_xi mu along this flow.

        ArithmeticError is raised if no formulas for xi and n are known.
        """

    @abstractmethod
    def text(self) -> str:
        """Return a short description of the flow."""
