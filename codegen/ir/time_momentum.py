"""The operation that updates the momentum conjugate to the time after a linear step y -> M(t) y."""

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
    """The update of the momentum u conjugate to the time, after a linear step from y to Y = (Q, P).

    Q and P are the new positions and momenta. The new value of u is u + (Q.P' - P.Q')/2. The prime denotes
    the derivative with respect to the time t for fixed y and fixed step size h. The arguments are the point
    (y, u) before the step, the point (Y, u) after the step, and t. The result is Y with the new value of u.
    The program ``step`` computes (Y, u) from (y, u) and t.
    """

    step: Program
    takes, gives = P + P + R, P
    name = "time_momentum"
    noun = "evaluation{s} of the momentum conjugate to the time"

    def evaluate(self, problem: AnyProblem, domain: Domain, args: Values) -> Values:
        """Return the point that consists of Y and the new momentum u + (Q.P' - P.Q')/2."""
        start, end, t = args
        # Only expressions can be differentiated. In other domains, the step is therefore repeated with
        # expressions.
        if isinstance(domain, ExprDomain):
            return ((*end[:-1], end[-1] + _increment(end[:-1], t)),)
        increment = self._evaluated(cast("Problem", problem), domain, start, t)
        return ((*end[:-1], end[-1] + increment),)

    def _evaluated(self, problem: Problem, domain: Domain, start: Values, t: object) -> object:
        """Return the increment (Q.P' - P.Q')/2 of the momentum u as a scalar of ``domain``."""
        # The step is computed with symbols for y and t, and differentiated. The values ``start`` and ``t``
        # then replace the symbols.
        formal = ExprDomain()
        point = tuple(formal.space.sym(s) for s in problem.symbols)
        time = formal.space.sym("t")
        inputs = {"y": point, "t": time}
        # The symbols in ``point`` do not depend on t. Hence y is fixed in the derivative with respect to t.
        end = interpret(self.step, problem, formal, inputs)["y"]
        values = problem.values(domain, start, t) | {"h": domain.h}
        return evaluate([_increment(end[:-1], time)], domain, values)[0]


def _increment(end: tuple[Expr, ...], t: Expr) -> Expr:
    """Return (Q.P' - P.Q')/2 for the point ``end`` = (Q, P).

    The prime denotes the derivative with respect to the symbol t.
    """
    # The first half of ``end`` is Q, and the second half is P.
    space, n = t.space, len(end) // 2
    # ``t.payload`` is the name of the symbol t. ``rates`` contains the derivatives of the entries of ``end``.
    rates = tangents(end, {str(t.payload): space.one})
    total = space.zero
    for k in range(n):
        total = total + (end[k] * rates[n + k] - end[n + k] * rates[k])
    return space.const(Number.rational(1, 2)) * total
