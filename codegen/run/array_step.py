"""Build the emitted functions of a step whose variables are matrices (:mod:`codegen.ir.array_step`).

The functions compute the entries of the matrices in loops.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction

from codegen.ir.array_program import Combination, Matrix, Multiplication
from codegen.ir.array_program import Term as Summand
from codegen.ir.array_step import MOST_TERMS, ArrayStep, Move
from codegen.ir.expr import Space
from codegen.ir.precision import Precision
from codegen.run.array_loops import ArrayLoops, tables
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
    Table,
    While,
)
from codegen.run.plan import STEP, Plan
from codegen.run.step import ADVANCE
from codegen.run.terms import (
    BAD_STEP,
    INFINITY,
    NOT_FINITE,
    OK,
    Kind,
    Term,
    all_finite,
    both,
    call,
    code,
    count,
    given,
    is_finite,
    negated,
    number,
    own,
    real,
    select,
    whole,
)

RECIPROCALS = "reciprocal"
"""The name of the table with the entries 1/(j + 2) for j = 0, 1, ..."""

MOST_PARTS = 2**20
"""The largest number of equal factors into which a matrix exponential is split.

The number of factors is doubled until the exponent of each factor has a norm of at most 1."""

_PLACE, _ROW, _COLUMN = count("place"), count("i"), count("j")


def array_functions(plan: Plan, step: ArrayStep) -> tuple[Function, ...]:
    """Return the functions of a step. Each function comes after the functions that it calls."""
    # A move is a statement that multiplies a point by a matrix exponential. Several moves can call the same
    # function. For each function name, ``moves`` contains the first move.
    moves: dict[str, Move] = {}
    for move in (s for s in step.body if isinstance(s, Move)):
        # The sizes of the matrices are constants in the function. Therefore all moves that call the function
        # must have matrices of the same sizes.
        assert _sizes(moves.setdefault(_name(move), move)) == _sizes(move)
    functions = [_Exponential(name, move, plan.format).function() for name, move in moves.items()]
    return (*functions, _advance(plan, step))


def array_tables(step: ArrayStep, precision: Precision) -> tuple[Table, ...]:
    """Return the table of the numbers 1/2, 1/3, ..., and the tables with the entries of constant matrices."""
    row = tuple(precision.round(Fraction(1, j + 2)) for j in range(MOST_TERMS + 1))
    own_table = Table(real(RECIPROCALS, MOST_TERMS + 1), (row,), "1/(j + 2)")
    return (own_table, *tables(step.constants(), precision))


def _name(move: Move) -> str:
    """Return the name of the emitted function for a move.

    The name contains the numbers of rows of the matrices ``core`` and ``start``.
    """
    start = 0 if move.start is None else move.start.rows
    return f"exponential{move.core.rows}" + (f"_from{start}" if start else "")


def _sizes(move: Move) -> tuple[tuple[int, int] | None, ...]:
    """Return the numbers of rows and columns of four matrices of a move: ``core``, ``gram``, ``target`` and
    ``start``, in this sequence.
    """
    matrices = (move.core, move.gram, move.target, move.start)
    return tuple(None if x is None else (x.rows, x.columns) for x in matrices)


def _advance(plan: Plan, step: ArrayStep) -> Function:
    """Return the function that makes one step."""
    state = plan.state()
    given_arrays = {step.argument.name: state}
    if step.error is not None:
        given_arrays[step.error.name] = plan.error
    # The state and the error estimate are arrays of the caller.
    loops = ArrayLoops(given_arrays)
    result = loops.array(step.result)
    parameters = (state, *plan.moment(), *plan.parameters)
    parameters += () if step.error is None else (plan.error,)
    body: list[Statement] = [
        If(negated(is_finite(STEP)), (Return(code(BAD_STEP)),)),
        *_declared(step, loops),
    ]
    for statement in step.body:
        if isinstance(statement, Move):
            body.append(_call(statement, loops))
        else:
            body += loops.statements(statement)
    body += [
        # The state is overwritten only after this test, so a failed step leaves the state unchanged.
        If(negated(all_finite(result)), (Return(code(NOT_FINITE)),)),
        *_estimated(plan, step, loops),
        Assign(state, result),
        Return(code(OK)),
    ]
    return Function(ADVANCE, "One step.", parameters, tuple(body), Kind.STATUS, RAISES_STATUS, often=True)


def _estimated(plan: Plan, step: ArrayStep, loops: ArrayLoops) -> list[Statement]:
    """Return a list with the statement that computes the error estimate, if the step has an estimate."""
    if step.error is None:
        return []
    body = [s for statement in step.estimate for s in loops.statements(statement)]
    return [If(given(plan.error), tuple(body))]


def _declared(step: ArrayStep, loops: ArrayLoops) -> list[Statement]:
    """Return the declarations of the local arrays, and add the arrays to ``loops``."""
    sizes: dict[str, int] = {}
    for statement in (*step.body, *step.estimate):
        target = statement.target
        # The array of a target has at least ``end`` entries.
        end = target.place(target.rows - 1, target.columns - 1) + 1
        sizes[target.name] = max(end, sizes.get(target.name, 0))
    local = [name for name in sizes if name not in loops.arrays]
    loops.arrays.update({name: own(name, sizes[name]) for name in local})
    return [Array(loops.arrays[name]) for name in local]


def _call(move: Move, loops: ArrayLoops) -> Call:
    start = () if move.start is None else (loops.array(move.start),)
    arguments = (loops.array(move.core), loops.array(move.gram), *start, loops.array(move.target))
    return Call(_name(move), arguments)


@dataclass
class _Exponential:
    """Builds the function that multiplies a matrix exponential by an n x k matrix."""

    name: str
    move: Move
    precision: Precision

    def function(self) -> Function:
        """Return the function that multiplies a point X by exp(B S B^T).

        B is the basis of the step, S is the core, and G = B^T B is the Gram matrix
        (:mod:`codegen.ir.array_step`). Let the n x k matrix X_0 be the state at the beginning of the step.
        A point X = X_0 + B D is represented by the matrix D, which is called the displacement of X. The
        function reads the displacement of X and computes the displacement of the product exp(B S B^T) X.

        The first k columns of B are X_0. Therefore X_0 = B E, where the matrix E consists of the first k
        columns of the unit matrix. Hence X = X_0 + B D = B C with C = E + D. The displacement of the product
        exp(B S B^T) X is D + S phi(G S) G C, where phi(z) = (exp(z) - 1)/z.
        """
        move, k = self.move, self.move.target.columns
        m = move.core.rows
        core, gram = Matrix("core", m, m), Matrix("gram", move.gram.rows, move.gram.columns)
        target = Matrix("result", move.target.rows, k)
        start = None if move.start is None else Matrix("start", move.start.rows, k)
        self.core, self.gram, self.target, self.start = core, gram, target, start
        # ``matrix`` is the product of the leading m x m block of ``gram`` and the matrix ``core``. ``total``
        # is the partial sum of a power series in ``matrix``, and ``term`` is the current term of this series.
        self.matrix = Matrix("matrix", m, m)
        self.total, self.term, self.next = (Matrix(n, m, k) for n in ("total", "term", "next"))
        given = [core, gram, *([start] if start is not None else []), target]
        loops = ArrayLoops({x.name: real(x.name, x.size) for x in given})
        local = (self.matrix, self.total, self.term, self.next)
        loops.arrays.update({x.name: real(x.name, x.size) for x in local})
        self.loops = loops
        parameters = tuple(loops.arrays[x.name] for x in given)
        body = (*(Array(loops.arrays[x.name]) for x in local), *self.statements())
        about = (
            "Multiply an intermediate state X = X_0 + B D by the matrix exponential exp(B S B^T). X_0 is the "
            "initial state of the step. All X have the same B. "
            f"Input: core = S ({m} x {m}), gram = B^T B, and start = the first rows of D. The other rows of "
            "D are 0. Without start, D = 0. "
            "Output: result = R with exp(B S B^T) X = X_0 + B R."
        )
        return Function(self.name, about, parameters, tuple(body))

    def statements(self) -> Iterator[Statement]:
        """Yield the statements in the body of the function."""
        m = self.core.rows
        square, norm, scale = real("square"), real("norm"), real("scale")
        parts, part = count("parts"), count("part")
        matrix = self.loops.array(self.matrix)
        # ``part`` selects the leading m x m block of the Gram matrix.
        yield from self.loops.statements(Multiplication(self.matrix, self.gram.part(0, 0, m, m), self.core))
        product, total = matrix[m * _ROW + _COLUMN] * matrix[m * _COLUMN + _ROW], real("pairs")
        diagonal = matrix[(m + 1) * _ROW]
        # The trace of M^2 is the sum of M_ij M_ji, where M is ``matrix``. The sums over j < i and over j > i
        # are equal, so only one is computed.
        below = For(_COLUMN, _ROW, (Assign(total, total + product),))
        added = Assign(square, square - (2.0 * total + diagonal * diagonal))
        yield Assign(square, number(0.0))
        # The loop sets ``square`` to -trace(M^2) for the matrix M = B^T B S. This number is the squared
        # Frobenius norm of the skew matrix B S B^T. The eigenvalues of a skew matrix form conjugate pairs, so
        # the squared spectral norm is at most half of ``square``.
        yield For(_ROW, whole(m), (Assign(total, number(0.0)), below, added))
        # Rounding can make ``square`` slightly negative. Then ``square - square`` gives the norm 0. If
        # ``square`` is a NaN, ``square - square`` is a NaN, too, so the norm is a NaN.
        yield Assign(norm, call("sqrt", select(square > 0.0, 0.5 * square, square - square)))
        yield Assign(scale, number(1.0))
        yield Assign(parts, whole(1))
        # Powers of 2 are exact, so ``scale`` = 1/``parts`` has no rounding error.
        halved = (Assign(scale, 0.5 * scale), Assign(parts, 2 * parts))
        yield While(both(norm * scale > 1.0, parts < MOST_PARTS), halved)
        yield from self.terms(norm * scale)
        yield from self.begun()
        yield For(part, parts, tuple(self.advanced(scale)))
        # The matrix exponential is a product of at most ``MOST_PARTS`` equal factors. If the exponent of a
        # factor has a norm above 1, the series of the factor is inaccurate, so the result is set to NaN.
        lost = For(
            _PLACE,
            whole(self.target.size),
            (Assign(self.loops.array(self.target)[_PLACE], INFINITY - INFINITY),),
        )
        yield If(norm * scale > 1.0, (lost,))

    def terms(self, size: Term) -> Iterator[Statement]:
        """Yield the statements that choose the number of terms in the series of phi(z) = (exp(z) - 1)/z.

        The constant term 1 is not counted. ``size`` is the norm of the matrix z.
        """
        terms, bound, theta = count("terms"), real("bound"), real("theta")
        # Let z be the exponent, ``theta`` its norm, and n the number ``terms``. The series of phi(z) is
        # truncated after z^n/(n + 1)!, so the first omitted term is z^(n + 1)/(n + 2)!. Therefore the first
        # omitted term of exp(z) = 1 + z phi(z) is z^(n + 2)/(n + 2)!. The norm of this term is at most
        # ``bound`` = theta^(n + 2)/(n + 2)!.
        tiny = 0.5 * self.precision.unit
        yield Assign(theta, size)
        yield Assign(terms, whole(0))
        yield Assign(bound, 0.5 * theta * theta)
        more = (
            Assign(terms, terms + 1),
            Assign(bound, bound * theta * real(RECIPROCALS, MOST_TERMS + 1)[terms]),
        )
        yield While(both(bound > tiny, terms < MOST_TERMS), more)

    def begun(self) -> Iterator[Statement]:
        """Yield the statements that copy ``self.start`` to the first rows of ``self.target``.

        The other rows of ``self.target`` are set to zero. If ``self.start`` is None, all rows are set to
        zero.
        """
        one = Space().one
        terms = () if self.start is None else (Summand(one, self.start),)
        yield from self.loops.statements(Combination(self.target, terms))

    def advanced(self, scale: Term) -> Iterator[Statement]:
        """Yield the statements that multiply the current point by a matrix exponential.

        The exponent is ``scale`` times the matrix B S B^T (see :meth:`function`).
        """
        m, k, loops = self.core.rows, self.target.columns, self.loops
        total, term, following = (loops.array(x) for x in (self.total, self.term, self.next))
        terms, order, factor = count("terms"), count("order"), real("ratio")
        first = self.gram.part(0, 0, m, k)
        entry = loops.entry(self.total, _ROW, _COLUMN)
        # ``total`` becomes the first m rows of B^T X. X is the current point, and B is the basis of the step.
        copied = Assign(entry, loops.entry(first, _ROW, _COLUMN))
        yield For(_ROW, whole(m), (For(_COLUMN, whole(k), (copied,)),))
        moved_by = Multiplication(
            self.total, self.gram.part(0, 0, m, self.target.rows), self.target, added=True
        )
        displaced = tuple(loops.statements(moved_by))
        # If ``self.start`` is None, the product is zero in the first iteration, so the product is skipped.
        yield from displaced if self.start is not None else (If(count("part") > 0, displaced),)
        yield Assign(term, total)
        added = (
            Assign(term[_PLACE], factor * following[_PLACE]),
            Assign(total[_PLACE], total[_PLACE] + term[_PLACE]),
        )
        # Let z be ``scale`` times ``self.matrix``, and let T be ``total`` before the loop. The loop adds the
        # terms z^j T/(j + 1)! for j = 1, 2, ... to ``total``.
        series = (
            *loops.statements(Multiplication(self.next, self.matrix, self.term)),
            Assign(factor, scale * real(RECIPROCALS, MOST_TERMS + 1)[order]),
            For(_PLACE, whole(self.total.size), added),
        )
        yield For(order, terms, series)
        # The displacement increases by ``scale`` times the product of ``core`` and ``total``.
        yield from loops.statements(Multiplication(self.next, self.core, self.total))
        result = loops.array(self.target)
        moved = Assign(result[_PLACE], result[_PLACE] + scale * following[_PLACE])
        yield For(_PLACE, whole(self.next.size), (moved,))
