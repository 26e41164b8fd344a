"""The update of the momentum u conjugate to the time t, in a step of a linear Hamiltonian system.

The step maps the state y to M(t) y. In the extended phase space, t and u are additional coordinates. Since M
depends on t, a step in the extended phase space is symplectic only if u changes, too
(:mod:`codegen.scene.linear_extension`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from codegen.ir.domain import Domain, ExprDomain, Values
from codegen.ir.expr import Expr, evaluate
from codegen.ir.interpret import interpret
from codegen.ir.number import Number
from codegen.ir.operations import Operation, P, R
from codegen.ir.operations import Problem as AnyProblem
from codegen.ir.program import Program
from codegen.ir.tangent import tangents

if TYPE_CHECKING:
    from codegen.scene.problem import Problem


@dataclass(frozen=True)
class TimeMomentum(Operation):
    """The update of the coordinate u in a step of a linear Hamiltonian system that depends on the time t.

    In the extended phase space, t is an additional position, and u is the momentum conjugate to t. The step
    maps y to Y = M(t) y. Let Q and P be the positions and the momenta in Y. The new value of u is
    u + (Q.P' - P.Q')/2. The prime denotes the derivative with respect to t for fixed y and fixed step size h.

    The arguments are the points (y, u) and (Y, u), and the time t. The program ``step`` computes Y from y and
    t, and does not change u. Therefore both points contain the old value of u.
    """

    step: Program
    takes, gives = P + P + R, P
    name = "time_momentum"
    noun = "evaluation{s} of the momentum conjugate to the time"

    def evaluate(self, problem: AnyProblem, domain: Domain, args: Values) -> Values:
        """Return the coordinates after the step.

        The last coordinate is the updated momentum conjugate to the time.
        """
        start, end, t = args
        # ``_increment`` differentiates symbolically, so it accepts only expressions.
        if isinstance(domain, ExprDomain):
            return ((*end[:-1], end[-1] + _increment(end[:-1], t)),)
        increment = self._evaluated(cast("Problem", problem), domain, start, t)
        # The last coordinate of the point is the momentum u.
        return ((*end[:-1], end[-1] + increment),)

    def _evaluated(self, problem: Problem, domain: Domain, start: Values, t: object) -> object:
        """Return the number that a step adds to the momentum conjugate to the time.

        The step begins at the time ``t`` with the coordinates ``start``. The docstring of
        :class:`TimeMomentum` contains the formula. The result is a scalar of ``domain``.
        """
        # The step is evaluated with symbols, because the result is differentiated symbolically.
        formal = ExprDomain()
        point = tuple(formal.space.sym(s) for s in problem.symbols)
        time = formal.space.sym("t")
        inputs = {"y": point, "t": time}
        # The point y consists of symbols that do not depend on t. Therefore ``_increment`` differentiates
        # ``end`` with respect to t for fixed y.
        end = interpret(self.step, problem, formal, inputs)["y"]
        values = problem.values(domain, start, t) | {"h": domain.h}
        return evaluate([_increment(end[:-1], time)], domain, values)[0]


def _increment(end: tuple[Expr, ...], t: Expr) -> Expr:
    """Return (Q.P' - P.Q')/2 for the point ``end`` = (Q, P).

    The prime denotes the derivative with respect to the symbol t.
    """
    # The first half of ``end`` is Q, and the second half is P.
    space, n = t.space, len(end) // 2
    # ``t.payload`` is the name of the symbol t.
    rates = tangents(end, {str(t.payload): space.one})
    total = space.zero
    for k in range(n):
        total = total + (end[k] * rates[n + k] - end[n + k] * rates[k])
    return space.const(Number.rational(1, 2)) * total
