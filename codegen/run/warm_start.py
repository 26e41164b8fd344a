"""Warm start: the initial guess of a step is extrapolated from the solutions of previous steps.

The guess is the value of a polynomial through the latest solutions. The degree of the polynomial is adapted
to the sizes of the backward differences. If the error of the guess exceeds ``Start.ROUGH`` times the change
of the unknowns over the step, the earlier solutions are discarded. The next guess is then the latest
solution.

For at most :data:`FEW` unknowns, loops over arrays would be too slow. Therefore scalar variables are used for
these unknowns.
"""

from __future__ import annotations

from collections.abc import Callable
from math import comb

from codegen.ir.kernel import Start
from codegen.kernel.schedule import Beginning
from codegen.run.language import (
    Array,
    Assign,
    Call,
    For,
    Function,
    If,
    Note,
    Record,
    Return,
    Statement,
    Table,
)
from codegen.run.plan import MEMORY, Plan
from codegen.run.terms import (
    Kind,
    Term,
    count,
    flag,
    number,
    own,
    real,
    select,
    size,
    truth,
    value,
    whole,
)
from codegen.run.values import simple

FEW = 12
"""The largest number of unknowns for which backward differences are computed in scalar variables."""

SELDOM = 8
"""The degree of the extrapolation polynomial is adapted in every SELDOM-th step of a run.

In the first steps, until the ring buffer of solutions is full, the degree is adapted in each step.
"""

_I = count("i")


def begun(plan: Plan, statement: Beginning) -> If:
    """Return the statement that sets the unknowns of all implicit equations to their initial guess."""
    unknowns = [own(u) for u in statement.start.unknowns]
    guess = plan.memory.field("guess", Kind.REAL, (len(unknowns),))
    cold: list[Statement] = []
    for inner in statement.body:
        cold += simple(inner)
    cold += [Assign(u, value(x)) for u, x in zip(unknowns, statement.values, strict=True)]
    warm = tuple(Assign(u, guess[k]) for k, u in enumerate(unknowns))
    return If(plan.memory.field("known", Kind.COUNT) > 0, warm, tuple(cold))


def memory_record(plan: Plan) -> Record:
    """Return the type of the record in which a step stores data for the next step of a run."""
    fields: list[tuple[Term, str]] = []
    # ``words`` describes the data that this kernel stores, for the comment in the emitted code.
    words = []
    if plan.start is not None:
        past, depth = len(plan.start.unknowns), plan.start.depth
        fields += [
            (count("known"), "number of stored solutions"),
            (real("first"), "error of the latest guess"),
            (count("degree"), "degree of the extrapolation"),
            (count("place"), "row of the latest solution"),
            (real("guess", past), "initial guess for the next step"),
            (
                real("values", 2 * depth, past),
                "ring buffer, stored twice to avoid a modulo",
            ),
        ]
        # Without a warm start, the rates of convergence of the loops are not stored.
        fields += [(real(f"rate_{k}"), "") for k in range(1, len(plan.kernel.loops) + 1)]
        words.append("solutions of the implicit equations, the latest first")
    for k, loop in enumerate(plan.kernel.loops, 1):
        # Simplified Newton (``leading`` is true) uses one matrix in all sweeps of a step, and computes a new
        # matrix in the next step. Therefore simplified Newton stores no matrix for the next step.
        if loop.newton is not None and not loop.newton.leading:
            n = len(loop.unknowns)
            fields += [
                (count(f"age_{k}"), "age of the stored inverse of the Newton matrix; 0 if none is stored"),
                (real(f"inverse_{k}", n * n), ""),
            ]
    if plan.newton:
        words.append("inverse matrices of Newton's method")
    about = f"Data that a step stores for the next step of the run: {', and '.join(words)}."
    return Record(MEMORY, about, tuple(fields))


def differences(start: Start) -> Table:
    """Return the table of the coefficients of backward differences.

    Row k contains the coefficients of order k. The first coefficient belongs to the latest solution.
    """
    rows = tuple(
        tuple(float((-1) ** j * comb(order, j)) for j in range(order + 1)) for order in range(start.depth + 1)
    )
    # ``difference_of_few`` reads the coefficients in pairs. If the number of coefficients in a row is odd,
    # the last pair contains a zero.
    padded = tuple((*row, *(0.0,) * (start.depth + 2 - len(row))) for row in rows)
    about = "Row k: coefficients of the backward difference of order k, latest solution first."
    return Table(_factors(start), padded, about)


def _factors(start: Start) -> Term:
    return real("differences", start.depth + 1, start.depth + 2)


def each(n: int, statement: Callable[[Term], Statement]) -> list[Statement]:
    """Return ``statement(k)`` for k = 0, ..., n - 1 if n is at most FEW, otherwise a loop over k."""
    if n <= FEW:
        # For few indices, separate statements are faster than a loop.
        return [statement(whole(k)) for k in range(n)]
    return [For(_I, whole(n), (statement(_I),))]


class WarmStart:
    """Builds the functions that store solutions and compute the guess for the next step."""

    def __init__(self, plan: Plan) -> None:
        assert plan.start is not None
        self.start, self.memory = plan.start, plan.memory
        self.n, self.depth = len(plan.start.unknowns), plan.start.depth
        self.known, self.degree, self.place = (
            plan.memory.field(name, Kind.COUNT) for name in ("known", "degree", "place")
        )
        self.first = plan.memory.field("first")
        self.guess = plan.memory.field("guess", Kind.REAL, (self.n,))
        # ``values`` contains two equal copies of a ring buffer with ``depth`` rows, one after the other. A
        # loop from a row of the first copy continues in the second copy and needs no index modulo ``depth``.
        self.values = plan.memory.field("values", Kind.REAL, (2 * self.depth, self.n))
        self.factors = _factors(plan.start)

    def functions(self) -> tuple[Function, ...]:
        """Return the functions of the warm start. Each function comes after the functions that it calls."""
        return self.difference(), self.difference_size(), self.remember()

    def difference(self) -> Function:
        """Return the function that computes a backward difference of the stored solutions.

        The latest solution is added last. Therefore a processor can do all other additions before the latest
        solution is known.
        """
        order, first, sign, result = count("order"), count("first"), real("sign"), real("sum", self.n)
        body = self.difference_of_few(order, first, sign, result) if self.n <= FEW else []
        if self.n > FEW:
            i, j = _I, count("j")
            # The term with the index j = ``first`` contains the latest solution.
            term = sign * self.factors[order][j] * self.values[self.place + (j - first)][i]
            inner = For(i, whole(self.n), (Assign(result[i], result[i] + term),))
            body = [
                For(i, whole(self.n), (Assign(result[i], number(0.0)),)),
                For(
                    # The outer loop runs over the solutions, from the oldest to the latest. The unknowns
                    # of a solution are contiguous in memory, so the inner loop runs over the unknowns.
                    count("back"),
                    order + 1 - first,
                    (Assign(j, first + count("back")), inner),
                    reverse=True,
                ),
            ]
        about = (
            "Let 1, d_1, ..., d_order be the coefficients of the backward difference of the given order. Let "
            "u_0 be the latest stored solution, and u_k the solution k steps earlier. If first = 0 "
            "and sign = 1, compute the backward difference sum = u_0 + d_1 u_1 + ... + d_order u_order. "
            "If first = 1 and sign = -1, compute the solution extrapolated to the next step, "
            "sum = -d_1 u_0 - ... - d_order u_(order-1)."
        )
        parameters = (self.memory, order, first, sign, result)
        return Function("difference", about, parameters, tuple(body), often=True)

    def difference_of_few(self, order: Term, first: Term, sign: Term, result: Term) -> list[Statement]:
        """Return the statements that compute a backward difference for at most FEW unknowns."""
        pair, place, column = count("pair"), count("row"), count("column")
        sums = [real(f"sum_{k}") for k in range(self.n)]
        newer, older = real("newer"), real("older")
        inner: list[Statement] = [
            Assign(place, self.place + 2 * pair),
            Assign(column, first + 2 * pair),
            Assign(newer, self.factors[order][column]),
            Assign(older, self.factors[order][column + 1]),
        ]
        for k, partial in enumerate(sums):
            later, earlier = self.values[place][k], self.values[place + 1][k]
            # The products do not depend on ``partial``, so a processor can compute them early.
            inner.append(Assign(partial, partial + sign * (newer * later + older * earlier)))
        return [
            *(Assign(partial, number(0.0)) for partial in sums),
            # The latest solution is added last. Therefore a processor can do all other additions before the
            # latest solution is known.
            For(pair, (order - first) // 2 + 1, tuple(inner), reverse=True),
            *(Assign(result[k], partial) for k, partial in enumerate(sums)),
        ]

    def difference_size(self) -> Function:
        """Return the function that sums the absolute values of the components of a backward difference."""
        order, row, size_now = count("order"), real("row", self.n), real("size")
        body = (
            Array(row),
            # The backward difference of order k is the error of an extrapolation of degree k - 1.
            Call("difference", (self.memory, order, whole(0), number(1.0), row)),
            Assign(size_now, number(0.0)),
            For(_I, whole(self.n), (Assign(size_now, size_now + size(row[_I])),)),
            Return(size_now),
        )
        # The size of a difference is measured by a sum, because a maximum would need comparisons.
        about = "The sum of the absolute values of the components of a backward difference."
        return Function("difference_size", about, (self.memory, order), body, Kind.REAL)

    def remember(self) -> Function:
        """Return the function that stores a solution and computes the guess for the next step."""
        solution, place = real("solution", self.n), count("place")
        body: list[Statement] = [
            Note("the guess is tested only if at least three solutions are stored"),
            If(self.known > 2, tuple(self.judged(solution))),
        ]
        body += [
            Assign(self.first, number(0.0)),
            # The index ``place`` decreases by one in each step, modulo ``depth``.
            Assign(place, select(self.place > 0, self.place - 1, self.depth - 1)),
            Assign(self.place, place),
        ]

        # The rows from ``depth`` on are a second copy of the ring buffer. Therefore the rows from ``place``
        # to ``place + depth - 1`` contain the latest ``depth`` solutions, and the inner loops need no index
        # modulo ``depth``.
        for row in (place, place + self.depth):
            body.append(Assign(self.values[row], solution))
        body.append(If(self.known < self.depth, (Assign(self.known, self.known + 1),)))
        body += self.chosen(place)
        body += [
            Note("extrapolate the polynomial through the latest solutions"),
            # For a polynomial of degree k, the backward difference of order k + 1 is zero. This difference is
            # a linear combination of the value at the next step and of previous values. The coefficient of
            # the value at the next step is 1. Therefore the guess for this value is minus the sum of all
            # terms with previous values.
            Call("difference", (self.memory, self.degree + 1, whole(1), number(-1.0), self.guess)),
        ]
        about = (
            "Store a solution. Then compute the guess for the next step by polynomial extrapolation of the "
            "latest stored solutions."
        )
        return Function("remember", about, (self.memory, solution), tuple(body), often=True)

    def judged(self, solution: Term) -> list[Statement]:
        """Return the statements that discard the stored solutions if the error of the last guess is large."""
        moved = real("moved")

        def added(k: Term) -> Statement:
            return Assign(moved, moved + size(solution[k] - self.values[self.place][k]))

        # The stored matrix of Newton's method is not discarded. The loop of Newton's method tests whether it
        # needs a new matrix.
        forgotten = (Assign(self.known, whole(0)), Assign(self.degree, whole(0)))
        return [
            Assign(moved, number(0.0)),
            *each(self.n, added),
            # ``first`` is the error of the extrapolated guess. ``moved`` is the error of the simplest guess,
            # the previous solution. If ``first`` exceeds ``Start.ROUGH * moved``, extrapolation is of little
            # use, so the stored solutions are discarded.
            If(self.first > Start.ROUGH * moved, forgotten),
        ]

    def chosen(self, place: Term) -> list[Statement]:
        """Return the statements that adapt the degree of the extrapolation.

        Let n be the degree, and let d_k be the size of the backward difference of order k. If n + 2 solutions
        are stored and d_(n+1) is below d_n, the degree becomes n + 1. Otherwise, if d_(n-1) is below d_n, the
        degree becomes n - 1. In all remaining cases, the degree stays n.
        """
        size_now = real("size")

        def measured(order: Term, name: str) -> Statement:
            return Call("difference_size", (self.memory, order), (real(name),))

        higher = (
            measured(self.degree + 1, "higher"),
            Assign(flag("grows"), real("higher") < size_now),
        )
        lower = (
            measured(self.degree - 1, "lower"),
            If(size_now > real("lower"), (Assign(self.degree, self.degree - 1),)),
        )
        grows = flag("grows")
        adapt = (
            # Let d_k be the size of the backward difference of order k. The best degree is the k with the
            # smallest d_k. The best degree changes slowly, so the current degree is compared only with the
            # next lower and the next higher degree.
            measured(self.degree, "size"),
            Assign(grows, truth(False)),
            # A backward difference of order k is computed from k + 1 solutions.
            If(self.degree + 1 < self.known, higher),
            If(
                grows,
                (Assign(self.degree, self.degree + 1),),
                (If(self.degree > 0, lower),),
            ),
        )
        # ``place`` decreases by one in each step, modulo ``depth``. Because ``depth`` is a multiple of
        # SELDOM, ``place`` is divisible by SELDOM in every SELDOM-th step.
        often = Term("or", (self.known < self.depth, (place % SELDOM).equals(0)), Kind.FLAG)
        return [
            Note(f"adapt the degree in each step until the ring buffer is full, then every {SELDOM} steps"),
            If(often, adapt),
        ]
