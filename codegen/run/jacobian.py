"""The derivative of a step with respect to the initial state, as a matrix.

A tangent vector at the initial state is called a variation. The linearised step maps the k-th unit vector to
column k of the matrix. In an implicit step, fixed-point iteration computes the derivatives of the unknowns,
even if the step uses Newton's method. If the iteration does not converge, the call fails.
"""

from __future__ import annotations

from codegen.run.arithmetic import computed, loaded, outputs, sampled, stored
from codegen.run.language import (
    RAISES_STATUS,
    Array,
    Assign,
    Call,
    For,
    Function,
    If,
    Return,
    Statement,
    While,
)
from codegen.run.momentum import ENTER, LEAVE, MOVING, momentum_before
from codegen.run.plan import STEP, Plan
from codegen.run.step import SUBSTEP, part_moment
from codegen.run.terms import (
    BAD_STEP,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    absent,
    all_finite,
    both,
    code,
    count,
    holding,
    is_finite,
    negated,
    number,
    real,
    record,
    whole,
)


def functions(plan: Plan) -> tuple[Function, ...]:
    """Return the functions for the derivative of a step. The tuple is empty if the derivative was not
    requested."""
    if plan.kernel.vary is None:
        return ()
    # The linearised step has its own kernel ``vary``, and each kernel needs a plan.
    varying = Plan(plan.kernel.vary, plan.format)
    return vary(plan, varying), _Jacobian(plan, varying).function()


def _vector(varying: Plan) -> Term:
    return real("vector", len(varying.kernel.outputs))


def vary(plan: Plan, varying: Plan) -> Function:
    """Return the function that applies the linearised step or substep to a variation."""
    state, vector, n = plan.state(), _vector(varying), plan.size
    # The linearised kernel has two vectors as inputs: first the state with n numbers, and then the variation.
    symbols, read = varying.symbols, varying.arrangement.symbols()
    ends, new = outputs(varying.arrangement, symbols[n:])
    body: list[Statement] = [
        If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
        *sampled(varying),
        *loaded(symbols[:n], state, read),
        *loaded(symbols[n:], vector, read),
        # The iterations in ``vary`` are not counted, because the statistics describe only the integration.
        *computed(varying, counting=False),
        *ends,
        # The test comes before the assignment, so a failure leaves ``vector`` unchanged.
        If(negated(all_finite(*new)), (Return(code(NOT_FINITE)),)),
        *stored(vector, new),
        Return(code(OK)),
    ]
    parameters = (state, vector, *plan.moment(), *plan.parameters, *plan.sampled())
    about = (
        "Multiply the derivative of one step by the tangent vector 'vector'. The product overwrites 'vector'."
    )
    return Function("vary", about, parameters, tuple(body), Kind.STATUS, RAISES_STATUS)


class _Jacobian:
    """Builds the public function ``jacobian``. The attributes are variables of the emitted function."""

    column, row = count("column"), count("row")

    def __init__(self, plan: Plan, varying: Plan) -> None:
        self.plan, self.vector = plan, _vector(varying)
        self.dim = self.vector.shape[0]
        self.given = real("inputs", len(plan.kernel.inputs))
        # ``vary`` expects the run-time inputs as functions of time, so constant functions are passed.
        self.inputs = tuple(map(holding, plan.held))

    def function(self) -> Function:
        """Return the emitted function."""
        plan, dim = self.plan, self.dim
        matrix = real("jacobian", dim * dim)
        # The run-time inputs are constant during the step. The array ``inputs`` contains their values.
        given = (self.given,) if plan.held else ()
        # ``vector`` contains one column of the Jacobian matrix. The matrix is stored row by row.
        entry = Assign(matrix[dim * self.row + self.column], self.vector[self.row])
        inner: tuple[Statement, ...] = (
            Array(self.vector, zero=True),
            # The columns of the Jacobian matrix are computed from unit vectors.
            Assign(self.vector[self.column], number(1.0)),
            *(self.composed() if plan.parts else self.single()),
            If(STATUS.equals(code(OK)), (For(self.row, whole(dim), (entry,)),)),
            Assign(self.column, self.column + 1),
        )
        body: list[Statement] = []
        for held in plan.held:
            # In C, the caller's array of inputs is ``const``, but ``vary`` reads the inputs through a pointer
            # without ``const``. Therefore ``vary`` gets a copy of the inputs.
            body += [Array(held), Assign(held, self.given)]
        body += [
            Assign(STATUS, code(OK)),
            Assign(self.column, whole(0)),
            # The loop ends after the first column that cannot be computed.
            While(both(STATUS.equals(code(OK)), self.column < dim), inner),
            Return(STATUS),
        ]
        parameters = (plan.state(), *plan.moment(), *plan.parameters, *given, matrix)
        return Function("jacobian", "", parameters, tuple(body), Kind.STATUS, public=True)

    def single(self) -> list[Statement]:
        """Return the call of ``vary`` for a step without substeps."""
        plan = self.plan
        arguments = (*plan.moment(), *plan.parameters, *self.inputs)
        return [Call("vary", (plan.state(), self.vector, *arguments), (STATUS,))]

    def composed(self) -> list[Statement]:
        """Return the loop over the substeps. Each substep advances first the variation and then the state."""
        plan, part, point = self.plan, count("part_number"), self.plan.state("point")
        # A substep stores data for later steps, such as solutions of implicit equations. Substep k uses the
        # record ``memories[k]`` for these data.
        memories = record("memory", "memory", plan.parts)
        moment = (*part_moment(plan, part), *plan.parameters, *self.inputs)
        # The substep only computes the state for the next call of ``vary``, so the caller's statistics do not
        # count it.
        more = (*plan.remembering(memories[part]), *(absent(x) for x in plan.counted))
        moved: list[Statement] = [Call(SUBSTEP, (point, *moment, *more), (STATUS,))]
        arrays: list[Statement] = []
        if plan.kernel.carried is not None:
            # The substep needs the body momentum, so the momentum is converted before and after the substep.
            moving, before = plan.state(MOVING), momentum_before(plan)
            arrays = [Array(moving), Array(before)]
            moved = [
                Call(ENTER, (point, moving, before)),
                Call(SUBSTEP, (moving, *moment, *more), (STATUS,)),
                If(STATUS.equals(code(OK)), (Call(LEAVE, (moving, before, point), (STATUS,)),)),
            ]
        inner: tuple[Statement, ...] = (
            # The linearised substep is evaluated at the state before the substep.
            Call("vary", (point, self.vector, *moment), (STATUS,)),
            If(STATUS.equals(code(OK)), tuple(moved)),
            # After a failure, this increment has no effect, because the loop ends.
            Assign(part, part + 1),
        )
        return [
            # The substeps advance a copy of the caller's state.
            Array(point),
            Assign(point, plan.state()),
            *([Array(memories, zero=True)] if plan.remembers else []),
            *arrays,
            Assign(part, whole(0)),
            While(both(STATUS.equals(code(OK)), part < plan.parts), inner),
        ]
