"""Warm starts: the unknowns of a step begin at the polynomial through the solutions of the steps before.

Its degree grows while the backward differences of the solutions fall. After many solutions it is looked at in
every eighth step alone. Where the guess was off by more than ``Start.ROUGH`` of what the unknowns have moved,
the motion has changed, and only the last solution is kept.

Solutions lie in a ring, each twice, so that the last ``depth`` are neighbours in it. Up to :data:`FEW`
unknowns each has a variable of its own; loops over arrays would take as long as the sweeps they save.
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
"""Up to so many unknowns differences are spelled one by one."""

SELDOM = 8
"""Of many solutions the degree is chosen in every so many steps."""

_I = count("i")


def begun(plan: Plan, statement: Beginning) -> If:
    """Return the statement that gives the unknowns of all loops their first values."""
    unknowns = [own(u) for u in statement.start.unknowns]
    guess = plan.memory.field("guess", Kind.REAL, (len(unknowns),))
    cold: list[Statement] = []
    for inner in statement.body:
        cold += simple(inner)
    cold += [Assign(u, value(x)) for u, x in zip(unknowns, statement.values, strict=True)]
    warm = tuple(Assign(u, guess[k]) for k, u in enumerate(unknowns))
    return If(plan.memory.field("known", Kind.COUNT) > 0, warm, tuple(cold))


def memory_record(plan: Plan) -> Record:
    """Return the record of what one step of a run leaves for the next."""
    fields: list[tuple[Term, str]] = []
    words = []
    if plan.start is not None:
        past, depth = len(plan.start.unknowns), plan.start.depth
        fields += [
            (count("known"), "how many solutions there are"),
            (real("first"), "by how much the last guess was off"),
            (count("degree"), "of the polynomial"),
            (count("place"), "of the latest solution"),
            (real("guess", past), "the polynomial, continued by a step"),
            (real("values", 2 * depth, past), "each solution twice: the last ones are neighbours"),
        ]
        fields += [(real(f"rate_{k}"), "") for k in range(1, len(plan.kernel.loops) + 1)]
        words.append("solutions of its equations, the latest first")
    for k, loop in enumerate(plan.kernel.loops, 1):
        if loop.newton is not None and not loop.newton.leading:
            n = len(loop.unknowns)
            fields += [
                (count(f"made_{k}"), "for how many steps the inverse has served, 0: there is none"),
                (real(f"inverse_{k}", n * n), ""),
            ]
    if plan.newton:
        words.append("inverses of Newton's matrices")
    about = f"What one step of a run leaves for the next: {', and '.join(words)}."
    return Record(MEMORY, about, tuple(fields))


def differences(start: Start) -> Table:
    """Return the factors of backward differences, by their order."""
    rows = tuple(
        tuple(float((-1) ** j * comb(order, j)) for j in range(order + 1)) for order in range(start.depth + 1)
    )
    padded = tuple((*row, *(0.0,) * (start.depth + 2 - len(row))) for row in rows)
    about = "Backward differences by their order: the factors of the solutions, the latest first."
    return Table(_factors(start), padded, about)


def _factors(start: Start) -> Term:
    return real("differences", start.depth + 1, start.depth + 2)


def each(n: int, statement: Callable[[Term], Statement]) -> list[Statement]:
    """Return a statement for every index, one by one where they are few, else as a loop."""
    if n <= FEW:
        return [statement(whole(k)) for k in range(n)]
    return [For(_I, whole(n), (statement(_I),))]


class WarmStart:
    """The functions that take up solutions and guess the next."""

    def __init__(self, plan: Plan) -> None:
        assert plan.start is not None
        self.start, self.memory = plan.start, plan.memory
        self.n, self.depth = len(plan.start.unknowns), plan.start.depth
        self.known, self.degree, self.place = (
            plan.memory.field(name, Kind.COUNT) for name in ("known", "degree", "place")
        )
        self.first = plan.memory.field("first")
        self.guess = plan.memory.field("guess", Kind.REAL, (self.n,))
        self.values = plan.memory.field("values", Kind.REAL, (2 * self.depth, self.n))
        self.factors = _factors(plan.start)

    def functions(self) -> tuple[Function, ...]:
        """Return all of them, callees first."""
        return self.difference(), self.difference_size(), self.remember()

    def difference(self) -> Function:
        """Return the function that fills ``sum`` by a backward difference.

        The latest solution is added last: the rest of the sum does not wait for it.
        """
        order, first, sign, result = count("order"), count("first"), real("sign"), real("sum", self.n)
        body = self.difference_of_few(order, first, sign, result) if self.n <= FEW else []
        if self.n > FEW:
            i, j = _I, count("j")
            term = sign * self.factors[order][j] * self.values[self.place + (j - first)][i]
            inner = For(i, whole(self.n), (Assign(result[i], result[i] + term),))
            body = [
                For(i, whole(self.n), (Assign(result[i], number(0.0)),)),
                For(
                    count("back"), order + 1 - first, (Assign(j, first + count("back")), inner), reverse=True
                ),
            ]
        about = (
            "A backward difference, times sign, of an order without its first terms, which were of later "
            "solutions. The latest is added last: the rest of the sum does not wait for it."
        )
        parameters = (self.memory, order, first, sign, result)
        return Function("difference", about, parameters, tuple(body), often=True)

    def difference_of_few(self, order: Term, first: Term, sign: Term, result: Term) -> list[Statement]:
        """Return the statements with a variable for each sum, two solutions at a time."""
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
            inner.append(Assign(partial, partial + sign * (newer * later + older * earlier)))
        return [
            *(Assign(partial, number(0.0)) for partial in sums),
            For(pair, (order - first) // 2 + 1, tuple(inner), reverse=True),
            *(Assign(result[k], partial) for k, partial in enumerate(sums)),
        ]

    def difference_size(self) -> Function:
        """Return the function that measures a difference."""
        order, row, size_now = count("order"), real("row", self.n), real("size")
        body = (
            Array(row),
            Call("difference", (self.memory, order, whole(0), number(1.0), row)),
            Assign(size_now, number(0.0)),
            For(_I, whole(self.n), (Assign(size_now, size_now + size(row[_I])),)),
            Return(size_now),
        )
        about = "The size of a backward difference."
        return Function("difference_size", about, (self.memory, order), body, Kind.REAL)

    def remember(self) -> Function:
        """Return the function that takes up a solution."""
        solution, place = real("solution", self.n), count("place")
        body: list[Statement] = [
            Note("the guess was no mere copy"),
            If(self.known > 2, tuple(self.judged(solution))),
        ]
        body += [
            Assign(self.first, number(0.0)),
            Assign(place, select(self.place > 0, self.place - 1, self.depth - 1)),
            Assign(self.place, place),
        ]

        # Each solution is stored twice, so that the last ones are neighbours wherever the ring begins.
        for row in (place, place + self.depth):
            body.append(Assign(self.values[row], solution))
        body.append(If(self.known < self.depth, (Assign(self.known, self.known + 1),)))
        body += self.chosen(place)
        body += [
            Note("the next difference vanishes where this is the next solution"),
            Call("difference", (self.memory, self.degree + 1, whole(1), number(-1.0), self.guess)),
        ]
        about = (
            "Store a solution and extrapolate the next one: the polynomial through the last solutions, "
            "evaluated one step later."
        )
        return Function("remember", about, (self.memory, solution), tuple(body), often=True)

    def judged(self, solution: Term) -> list[Statement]:
        """Return the statements that forget all solutions but the next where the guess was too far off."""
        moved = real("moved")

        def added(k: Term) -> Statement:
            return Assign(moved, moved + size(solution[k] - self.values[self.place][k]))

        forgotten = (Assign(self.known, whole(0)), Assign(self.degree, whole(0)))
        return [
            Assign(moved, number(0.0)),
            *each(self.n, added),
            If(self.first > Start.ROUGH * moved, forgotten),
        ]

    def chosen(self, place: Term) -> list[Statement]:
        """Return the statements that let the degree grow while the differences fall."""
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
        look = (
            measured(self.degree, "size"),
            Assign(grows, truth(False)),
            If(self.degree + 1 < self.known, higher),
            If(
                grows,
                (Assign(self.degree, self.degree + 1),),
                (If(self.degree > 0, lower),),
            ),
        )
        often = Term("or", (self.known < self.depth, (place % SELDOM).equals(0)), Kind.FLAG)
        return [
            Note(f"the degree grows while differences fall; with many it is chosen once in {SELDOM} steps"),
            If(often, look),
        ]
