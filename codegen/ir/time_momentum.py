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
    """The new value of the momentum u conjugate to the time, after a linear step from y to Y = (Q, P).

    The new value is u + (Q.P' - P.Q')/2. The prime denotes the derivative with respect to the time t for
    fixed y and h. The operation has three arguments: the point (y, u) before the step, the point (Y, u), and
    the time t. The result is Y with the new value of u. The program ``step`` computes Y from y and t, and
    does not change u.
    """

    step: Program
    takes, gives = P + P + R, P
    name = "time_momentum"
    noun = "evaluation{s} of the momentum conjugate to the time"

    def evaluate(self, problem: AnyProblem, domain: Domain, args: Values) -> Values:
        """Return the point that consists of Y and the new momentum u + (Q.P' - P.Q')/2."""
        start, end, t = args
        # If the point ``end`` consists of expressions, it is differentiated directly. Otherwise it consists
        # of numbers, and :meth:`_evaluated` first computes it again as expressions.
        if isinstance(domain, ExprDomain):
            return ((*end[:-1], end[-1] + _increment(end[:-1], t)),)
        increment = self._evaluated(cast("Problem", problem), domain, start, t)
        return ((*end[:-1], end[-1] + increment),)

    def _evaluated(self, problem: Problem, domain: Domain, start: Values, t: object) -> object:
        """Return the increment (Q.P' - P.Q')/2 of the momentum u as a scalar of ``domain``."""
        # The step is computed with symbols for y and t, because expressions can be differentiated. At the
        # end, the scalars ``start`` and ``t`` replace the symbols.
        formal = ExprDomain()
        point = tuple(formal.space.sym(s) for s in problem.symbols)
        time = formal.space.sym("t")
        inputs = {"y": point, "t": time}
        # y and t are independent symbols, so the derivative of Y with respect to t is taken for fixed y.
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
