"""Step control for Taylor methods: the Taylor coefficients of the solution determine the size of each step.

No step is rejected. Let c_k be the k-th Taylor coefficient of the solution at the state y, and p the degree
of the Taylor polynomial. All norms are maximum norms. Let epsilon = atol + rtol |y|. The step size is
exp(-0.7/(p - 1)) times the smaller of the numbers (epsilon/|c_k|)^(1/k) for k = p - 1 and k = p. The formula
is taken from A. Jorba and M. Zou, Experimental Mathematics 14 (2005) 99, section 3.2.1.
"""

from __future__ import annotations

import math

from codegen.ir.kernel import Expansion
from codegen.ir.taylor_loop import INVERSE, LINEAR, NEXT, ORDER, coordinate_names
from codegen.run.arithmetic import computed, filling, loaded, stored
from codegen.run.language import (
    RAISES_NAN,
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
from codegen.run.plan import STEP, TIME, Plan
from codegen.run.step import ADVANCE
from codegen.run.step_control import ATOL, RTOL, usable_tolerances
from codegen.run.terms import (
    BAD_STEP,
    LIMIT,
    NOT_FINITE,
    OK,
    STATUS,
    TOO_FAR,
    TOO_SHORT,
    Kind,
    Term,
    all_finite,
    both,
    call,
    code,
    count,
    either,
    flag,
    given,
    is_finite,
    largest,
    negated,
    number,
    own,
    real,
    select,
    size,
    total,
    value,
    whole,
)

ENTER, EXPAND, EVALUATE, LEAVE, ADVISE = "coordinates", "expand", "evaluate", "moved_state", "advise"
"""The names of the emitted functions that the run with step control calls."""

LEAST = 1e-30
"""The least norm of a Taylor coefficient in the formula of the step size.

The formula divides by the norm, so a norm below LEAST is replaced by LEAST."""

ROWS = 4
"""The number of products that :func:`inner_sums` adds to a sum in one iteration."""


ORDER_TERM = own(ORDER)


def functions(plan: Plan) -> tuple[Function, ...]:
    """Return functions that ``run_adaptive`` (the run with step control) calls, then ``run_adaptive`` itself.

    If the kernel has no Taylor expansion with step control, the tuple is empty.
    """
    expansion = plan.kernel.expansion
    if expansion is None or not expansion.controlled:
        return ()
    own = _Controlled(plan, expansion)
    return *(own.polynomial() if plan.kernel.outputs else ()), own.advise(), own.run()


def polynomial_step(plan: Plan) -> tuple[Function, ...]:
    """Return the function that makes one step by the Taylor polynomial, and the functions that it calls."""
    expansion = plan.kernel.expansion
    assert expansion is not None
    own = _Controlled(plan, expansion)
    return *own.polynomial(), own.advance()


def inner_sums(k: Term, width: int, left: Term, right: Term, sums: Term) -> list[Statement]:
    """Return the statements that compute the inner sums for products of Taylor series.

    The inner sum of order n = k + 1 of two series a and b is the sum of a_j b_{n-j} over 0 < j < n. The
    number of products is ``width``. Product c uses column c of ``left``, column c of ``right``, and entry c
    of ``sums``. Row j - 1 of ``left`` contains a_j, and row j - 1 of ``right`` contains b_j.
    """
    # In each column, the entry in row r of ``left`` is multiplied by the entry in row k - 1 - r of ``right``,
    # for r = 0, ..., k - 1. Here k is the argument of ``inner_sums``.
    j, lane, first, last = count("j"), count("lane"), count("first_row"), count("last_row")

    def products(i: int) -> Term:
        """Return the product of two entries: row ``first + i`` of ``left`` and row ``last - i`` of ``right``.

        Both factors are in the column ``lane``.
        """
        return left[(first + i) * width + lane] * right[(last - i) * width + lane]

    def together(rows: int) -> Term:
        # The products are added in pairs, because a processor can compute several pairs at the same time.
        pairs = [products(i) for i in range(rows)]
        return total(total(pairs[i : i + 2]) for i in range(0, rows, 2))

    # The sums do not depend on one another, so a compiler can use vector instructions in the inner loop over
    # the sums.
    many = For(
        j,
        k // ROWS,
        (
            Assign(first, j * ROWS),
            Assign(last, k - first - 1),
            For(lane, whole(width), (Assign(sums[lane], sums[lane] + together(ROWS)),)),
        ),
    )
    # If k is not a multiple of ROWS, the remaining rows are added one by one.
    single = For(
        j,
        k % ROWS,
        (
            Assign(first, k - j - 1),
            Assign(last, j),
            For(lane, whole(width), (Assign(sums[lane], sums[lane] + products(0)),)),
        ),
    )
    return [For(lane, whole(width), (Assign(sums[lane], number(0.0)),)), many, single]


class _Controlled:
    """Builds the run with step control."""

    t, h = real("t", 1, cell=True), real("h", 1, cell=True)
    end, limit = real("end"), count("limit")
    accepted, rejected = (count(name, 1, optional=True, cell=True) for name in ("accepted", "rejected"))
    steps, last, finite = count("accepted_steps"), flag("last"), flag("finite")
    now, length, left, taken = real("now"), real("size"), real("left"), real("taken")
    following, advised = real("then"), real("advised")

    def __init__(self, plan: Plan, expansion: Expansion) -> None:
        self.plan, self.expansion = plan, expansion
        self.degree = expansion.degree
        # The state of the plan ``own`` consists of the coordinates that are expanded in Taylor series.
        self.own = Plan(expansion.coefficients, plan.format)
        self.size = self.own.size
        self.state, self.trial = plan.state(), plan.state("trial")
        # If the solution is expanded in the coordinates of the state itself, no conversion is needed, and the
        # arrays of the state are used directly.
        self.start = self.state if expansion.enter is None else real("start", self.size)
        self.moved = self.trial if expansion.leave is None else real("moved", self.size)
        # Row k - 1 of ``series`` contains the Taylor coefficients of order k of all coordinates.
        self.series = real("series", self.degree * self.size)

    def polynomial(self) -> tuple[Function, ...]:
        """Return the emitted functions ENTER, EXPAND, EVALUATE and LEAVE.

        EXPAND computes the Taylor coefficients, and EVALUATE evaluates the Taylor polynomial. ENTER converts
        the state to the coordinates of the polynomial, and LEAVE converts these coordinates to the state. If
        a conversion is not needed, the function for this conversion is omitted.
        """
        enter, leave = self.expansion.enter, self.expansion.leave
        listed = []
        if enter is not None:
            about = "Convert the state to the coordinates in which the Taylor polynomial is computed."
            listed.append(filling(Plan(enter, self.plan.format), ENTER, about, self.start))
        listed.append(self.expand() if self.expansion.following is None else self.expand_in_loop())
        listed.append(self.evaluate())
        if leave is not None:
            about = (
                "Convert the value of the Taylor polynomial to the state after the step. The array state "
                "contains the old state, followed by the value of the polynomial."
            )
            listed.append(filling(Plan(leave, self.plan.format), LEAVE, about, self.trial))
        return tuple(listed)

    def advance(self) -> Function:
        """Return the function that makes one step of size h."""
        plan = self.plan
        body: list[Statement] = [
            If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
            *self.arrays(),
            *self.entered(),
            Call(EXPAND, (self.start, *self.moment, self.series)),
            Call(EVALUATE, (self.start, self.series, STEP, self.moved)),
            *self.returned(),
            # The state is overwritten only after this test, so a failed step leaves the state unchanged.
            If(negated(self.is_sound()), (Return(code(NOT_FINITE)),)),
            Assign(self.state, self.trial),
            Return(code(OK)),
        ]
        parameters = (self.state, *plan.moment(), *plan.parameters)
        return Function(ADVANCE, "One step.", parameters, tuple(body), Kind.STATUS, RAISES_STATUS)

    def arrays(self) -> tuple[Statement, ...]:
        """Return the declarations of all local arrays of a step."""
        # ``start`` and ``moved`` are not declared if they are the arrays ``state`` and ``trial``.
        separate = [x for x, y in ((self.start, self.state), (self.moved, self.trial)) if x is not y]
        return tuple(map(Array, (self.series, self.trial, *separate)))

    def entered(self) -> tuple[Statement, ...]:
        """Return the statement that converts the old state to the coordinates in which the solution is
        expanded.

        If no conversion is needed, an empty tuple is returned.
        """
        return () if self.expansion.enter is None else (Call(ENTER, (self.state, self.start)),)

    def returned(self) -> tuple[Statement, ...]:
        """Return the statements that compute the new state from the coordinates after the step.

        The tuple is empty if no conversion is needed.
        """
        if self.expansion.leave is None:
            return ()
        n = self.plan.size
        pair = real("pair", n + self.size)
        return (
            # The argument of the function LEAVE is one array: the old state, followed by the new coordinates.
            Array(pair),
            Assign(pair.part(0, n), self.state),
            Assign(pair.part(n, self.size), self.moved),
            Call(LEAVE, (pair, self.trial)),
        )

    def is_sound(self) -> Term:
        """Return the test whether the old state and the new state are finite.

        The new state can be finite although the old state contains a NaN, so both states are tested.
        """
        return both(all_finite(self.trial), all_finite(self.state))

    def expand_in_loop(self) -> Function:
        """Return the function that computes the coefficients in a loop over their order."""
        first, n, following = self.own, self.size, self.expansion.following
        assert following is not None
        every = Plan(following, self.plan.format)
        ends, symbols = first.arrangement.outputs, every.arrangement.symbols()
        m, k = self.expansion.sums, count("k")
        # The number m of inner sums is rounded up to an even number, because a vector instruction computes
        # at least two numbers.
        width = m + m % 2
        left, right = (real(name, (self.degree - 1) * width) for name in ("left", "right"))
        # The kernel ``first`` is executed once. After it, a loop computes the coefficients from order 2 on.
        # The last n outputs of ``first`` are the coefficients of order 1. The other outputs of ``first`` are
        # values that the loop reads.
        sums, values = own("sum", width), len(ends) - n
        operands = [value(x) for x in every.arrangement.outputs]
        padding = [number(0.0)] * (width - m)
        inner = (
            # The order is a floating-point variable, because the formulas divide by the order.
            Assign(ORDER_TERM, ORDER_TERM + 1.0),
            *self.numbers(symbols),
            *inner_sums(k, width, left, right, sums),
            *(
                # Row k of ``series`` contains the coefficients of order k + 1.
                Assign(own(s), self.series[k * n + i])
                for i, s in enumerate(coordinate_names(n))
                if s in symbols
            ),
            *computed(every),
            # The formulas contain m products of two series, a left factor and a right factor. The outputs of
            # the kernel ``every`` are the coefficients of the m left factors, then those of the m right
            # factors, and then the next coefficients of the solution.
            *(Assign(left[k * width + c], x) for c, x in enumerate([*operands[:m], *padding])),
            *(Assign(right[k * width + c], x) for c, x in enumerate([*operands[m : 2 * m], *padding])),
            *(Assign(self.series[k * n + (n + i)], x) for i, x in enumerate(operands[2 * m :])),
        )
        body = (
            *loaded(first.symbols, self.start, first.arrangement.symbols()),
            *computed(first),
            Array(own("first", values), tuple(map(value, ends[:values]))),
            *stored(self.series, [value(x) for x in ends[values:]]),
            Array(left),
            Array(right),
            Array(sums),
            Assign(ORDER_TERM, number(0.0)),
            # The coefficients of order 1 are computed before this loop.
            For(k, whole(self.degree - 1), inner),
        )
        about = (
            f"Store the Taylor coefficients 1 to {self.degree} of the solution, lowest order first. "
            "The arrays left and right contain the coefficients of the operands of all products."
        )
        return Function(EXPAND, about, (self.start, *self.moment, self.series), body, guard=RAISES_NAN)

    def numbers(self, symbols: frozenset[str]) -> list[Statement]:
        """Return the statements that compute numbers that depend only on the order, for example 1/order.

        Numbers whose names are not in ``symbols`` are omitted.
        """
        # LINEAR is the Taylor coefficient of the function t: 1 for order 1, and 0 for the orders 2, 3 and so
        # on. The order is a floating-point number, so order 1 is recognised by the test order < 1.5.
        one, linear = number(1.0), select(ORDER_TERM < 1.5, number(1.0), number(0.0))
        known = {INVERSE: one / ORDER_TERM, NEXT: one / (ORDER_TERM + 1.0), LINEAR: linear}
        return [Assign(own(name), x) for name, x in known.items() if name in symbols]

    @property
    def moment(self) -> tuple[Term, ...]:
        """The time and the parameters, as arguments of the emitted function ``expand``."""
        return (*((TIME,) if self.own.time else ()), *self.own.parameters)

    def expand(self) -> Function:
        """Return the function that computes the Taylor coefficients."""
        own = self.own
        body = [
            *loaded(own.symbols, self.start, own.arrangement.symbols()),
            *computed(own),
            *stored(self.series, [value(x) for x in own.arrangement.outputs]),
        ]
        about = f"Store the Taylor coefficients 1 to {self.degree} of the solution, lowest order first."
        parameters = (self.start, *self.moment, self.series)
        return Function(EXPAND, about, parameters, tuple(body), guard=RAISES_NAN)

    def evaluate(self) -> Function:
        """Return the function that evaluates the polynomial by Horner's rule."""
        n, i, result = self.size, count("i"), real("total")
        entries = [self.series[i + k * n] for k in range(self.degree)]
        # The state is added last, because this order reduces rounding errors.
        horner = [Assign(result, result * STEP + x) for x in reversed(entries[:-1])]
        inner = (Assign(result, entries[-1]), *horner, Assign(self.moved[i], self.start[i] + STEP * result))
        about = "The value of the Taylor polynomial at the end of a step of size h."
        parameters = (self.start, self.series, STEP, self.moved)
        return Function(EVALUATE, about, parameters, (For(i, whole(n), inner),), guard=RAISES_NAN)

    def advise(self) -> Function:
        """Return the function that computes the step size from the Taylor coefficients."""
        n, p = self.size, self.degree
        permitted, epsilon = real("permitted"), real("epsilon")
        smaller, reached = real("smaller"), real("reached")
        body: list[Statement] = [
            Assign(permitted, ATOL + RTOL * largest(self.start)),
            # If ``atol`` and the state are zero, no error is permitted, and the step size would be zero.
            Assign(epsilon, select(permitted > 0.0, permitted, number(LEAST))),
        ]
        # The last Taylor coefficient alone can mislead: it may be zero, because every second Taylor
        # coefficient of an even function is zero. Therefore the last two coefficients are used.
        for k, result in ((p - 1, smaller), (p, reached)):
            norm = real(f"norm_{k}")
            body.append(Assign(norm, largest(self.series.part((k - 1) * n, n))))
            ratio = epsilon / select(norm > LEAST, norm, number(LEAST))
            body.append(Assign(result, call("power", ratio, self.rounded(1 / k))))
        least = select(smaller < reached, smaller, reached)
        body.append(Return(self.rounded(math.exp(-0.7 / (p - 1))) * least))
        about = "Return a step size for which the last two Taylor terms do not exceed the tolerance."
        parameters = (self.start, self.series, RTOL, ATOL)
        return Function(ADVISE, about, parameters, tuple(body), Kind.REAL, RAISES_NAN)

    def rounded(self, x: float) -> Term:
        """Return the constant ``x``, rounded to the precision of the emitted code."""
        return number(self.plan.format.round(x))

    def run(self) -> Function:
        """Return the emitted function that integrates with step control."""
        plan = self.plan
        chosen = (self.t, self.end, self.h, RTOL, ATOL, self.limit)
        parameters = (self.state, *chosen, *plan.parameters, self.accepted, self.rejected)
        # The run may go forwards or backwards in time.
        moving = either(self.now < self.end, self.now > self.end)
        numbers = both(*(is_finite(x) for x in (self.length, self.now, self.end)))
        body: tuple[Statement, ...] = (
            Assign(STATUS, code(OK)),
            Assign(self.steps, whole(0)),
            Assign(self.now, self.t[0]),
            # If the caller gives a step size, it is an upper bound for the first step.
            Assign(self.length, size(self.h[0])),
            Assign(self.advised, self.length),
            If(negated(both(numbers, usable_tolerances())), (Assign(STATUS, code(BAD_STEP)),)),
            *self.arrays(),
            While(both(STATUS.equals(code(OK)), moving), self.step()),
            Assign(self.t[0], self.now),
            Assign(self.h[0], self.advised),
            If(given(self.accepted), (Assign(self.accepted[0], self.steps),)),
            # The number of rejected steps is 0. The argument ``rejected`` exists, because ``run_adaptive``
            # has the same arguments for all methods.
            If(given(self.rejected), (Assign(self.rejected[0], whole(0)),)),
            Return(STATUS),
        )
        return Function("run_adaptive", "", parameters, body, Kind.STATUS, public=True)

    def step(self) -> tuple[Statement, ...]:
        """Return the statements of one step."""
        n, p = self.size, self.degree
        moment = tuple(self.now if x is TIME else x for x in self.moment)
        bounded = both(self.length > 0.0, self.advised > self.length)
        # If t + h equals t in floating-point arithmetic, the run ends with the status TOO_SHORT.
        stuck = negated(either(self.following > self.now, self.following < self.now))
        ended = select(stuck, code(TOO_SHORT), code(LIMIT))
        return (
            *self.entered(),
            Call(EXPAND, (self.start, *moment, self.series)),
            # The coefficients do not depend on h. If a coefficient is infinite or a NaN, a shorter step would
            # fail too.
            Assign(self.finite, all_finite(self.series.part((p - 1) * n, n))),
            Call(ADVISE, (self.start, self.series, RTOL, ATOL), (self.advised,)),
            If(bounded, (Assign(self.advised, self.length),)),
            # The caller's step size bounds only the first step.
            Assign(self.length, number(0.0)),
            Assign(self.left, self.end - self.now),
            Assign(self.last, self.advised >= size(self.left)),
            Assign(self.taken, select(self.last, self.left, call("copysign", self.advised, self.left))),
            # After the last step the time is exactly ``end``. The sum ``t + h`` could differ from ``end``
            # by a rounding error.
            Assign(self.following, select(self.last, self.end, self.now + self.taken)),
            If(
                negated(self.finite),
                (Assign(STATUS, code(NOT_FINITE)),),
                (If(either(self.steps >= self.limit, stuck), (Assign(STATUS, ended),), self.move()),),
            ),
        )

    def move(self) -> tuple[Statement, ...]:
        """Return the statements that change the state and the time."""
        return (
            Call(EVALUATE, (self.start, self.series, self.taken, self.moved)),
            *self.returned(),
            If(
                self.is_sound(),
                (
                    Assign(self.state, self.trial),
                    Assign(self.now, self.following),
                    Assign(self.steps, self.steps + 1),
                ),
                # The highest Taylor coefficients are finite here. If the old state is also finite but the new
                # state is not, the step was too long.
                (Assign(STATUS, select(all_finite(self.state), code(TOO_FAR), code(NOT_FINITE))),),
            ),
        )
