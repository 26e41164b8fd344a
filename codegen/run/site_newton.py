"""Newton's method for the equations of a chain, with a block-tridiagonal matrix.

The equations are u = g(u). Newton's matrix is 1 - g', where g' is the Jacobian of g. The matrix is computed
to first order in the step size h, because higher orders would cost more. In each step, the matrix is factored
once. The rows for site i contain three blocks of the matrix: A_i, B_i and C_i. These blocks multiply the
unknowns of the left neighbour, of site i, and of the right neighbour.

Block elimination (the Thomas algorithm) visits the sites from left to right. The pivot block of site i is
D_i = B_i - A_i D_{i-1}^{-1} C_{i-1}, where A_i, B_i and C_{i-1} are the original blocks. In memory,
D_i^{-1} A_i then overwrites A_i, D_i^{-1} overwrites B_i, and D_i^{-1} C_i overwrites C_i. Rows are exchanged
only within a pivot block.

For a periodic chain, let x be Newton's correction at the last site, and let y be the correction at all other
sites. Newton's matrix consists of four submatrices T, E, F and G. The linear equations are T y + E x = r for
all other sites, and F y + G x = s for the last site. The matrix T is block-tridiagonal, and the vectors r and
s are residuals. The matrix E is called the border. Block elimination computes T^{-1} E and T^{-1} r. The
equation (G - F T^{-1} E) x = s - F T^{-1} r determines x. Then y = T^{-1} r - T^{-1} E x.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.site_step import OWN, SiteBlock, SiteNewton, SiteStep
from codegen.run.language import Array, Assign, Call, For, Function, If, Return, Statement
from codegen.run.plan import STEP, TIME, Plan, symbols_of
from codegen.run.site_terms import (
    ARRAYS,
    MEASURED,
    PLACE,
    SITES,
    STRIDE,
    distributed,
    entry_of,
    moved,
    row_of,
    split,
)
from codegen.run.terms import (
    NOT_FINITE,
    OK,
    SINGULAR,
    STATUS,
    Kind,
    Term,
    all_finite,
    code,
    count,
    greatest,
    number,
    own,
    real,
    select,
    size,
    whole,
)

_INNER, _BEFORE, _BASE, _FIRST = count("inner"), count("last"), count("base"), count("first")
_SITE, _I, _J, _K, _SUM = count("site"), count("i"), count("j"), count("k"), real("sum")
_REGULAR, _ENTRY = count("regular"), count("entry")
# The order of the three blocks of a site in memory.
LEFT, OWN_BLOCK, RIGHT = range(3)


@dataclass(frozen=True)
class ChainSolver:
    """Builds the functions that solve the linear equations of Newton's method for one implicit block.

    An implicit block is a set of equations of the step that are solved together. ``index`` is the number
    of the block.
    """

    plan: Plan
    step: SiteStep
    block: SiteBlock
    index: int

    @property
    def newton(self) -> SiteNewton:
        """The description of Newton's matrix for the implicit block."""
        assert self.block.newton is not None
        return self.block.newton

    @property
    def n(self) -> int:
        """The number of unknowns at each site."""
        return self.newton.size

    @property
    def work(self) -> Term:
        """The workspace of the step: the array ``work`` of the emitted code."""
        return ARRAYS["work"]

    def name(self, of: str) -> str:
        """Return the name of a function. For ``of`` = "factor" and block 2, the name is ``factor_2``."""
        return f"{of}_{self.index}"

    def functions(self) -> list[Function]:
        """Return the emitted functions. Callees come before their callers."""
        return [self.linearise(), self.substitute(), self.factor(), self.correct()]

    def prepared(self) -> list[Statement]:
        """Return the calls that compute and factor the matrix.

        The call for the factorisation sets the status to OK, SINGULAR or NOT_FINITE.
        """
        linearise = self.linearise()
        return [
            Call(linearise.name, linearise.parameters),
            Call(self.name("factor"), (SITES, self.work), (STATUS,)),
        ]

    def corrected(self) -> Statement:
        """Return the call that solves the linear equations, with the residuals as right-hand side.

        The called function also adds the solution to the unknowns.
        """
        return Call(self.name("correct"), (SITES, self.work, MEASURED))

    def row(self, number: int) -> Term:
        """Return the index at which row ``number`` of the workspace begins."""
        return row_of(self.step, number)

    def cell(self, site: Term, block: int, i: Term, j: Term) -> Term:
        """Return entry (i, j) of a block of the matrix; ``block`` is LEFT, OWN_BLOCK or RIGHT."""
        # The three blocks of a site are stored together, because the elimination uses them together.
        n = self.n
        inner = i * n + j + block * n * n if block else i * n + j
        return self.work[_BASE + site * (3 * n * n) + inner]

    def border(self, site: Term, i: Term, j: Term) -> Term:
        """Return an entry of the border of Newton's matrix, for a periodic chain.

        The border contains the coefficients of the last site's unknowns in the equations of all other sites.
        The entry belongs to equation ``i`` at ``site`` and to unknown ``j`` of the last site.
        """
        # ``substitute`` solves linear equations. The right-hand side is either the residuals or a column of
        # the border. Therefore each column of the border is stored in the same way as the residuals.
        return self.work[row_of(self.step, j * self.n + i + self.newton.border) + site]

    def opening(self) -> list[Statement]:
        """Return the statements that assign the variables ``_BASE`` and ``_INNER``.

        ``_BASE`` is the index of the first matrix entry in the workspace. ``_INNER`` is the number of sites
        in the block elimination. In a periodic chain, the block elimination omits the last site.
        """
        # A periodic chain has at least two sites, so ``SITES - 1`` is positive.
        inner = SITES - 1 if self.step.periodic else SITES
        return [Assign(_BASE, self.row(self.newton.matrix)), Assign(_INNER, inner)]

    def dot(self, term: Term, plus: bool = False) -> list[Statement]:
        """Return a loop over k that subtracts ``term`` from ``_SUM``, or adds it if ``plus`` is True."""
        return [For(_K, whole(self.n), (Assign(_SUM, _SUM + term if plus else _SUM - term),))]

    def linearise(self) -> Function:
        """Return the function that computes the blocks of the matrix at all sites."""
        newton, step = self.newton, self.step
        before, inside, ends = split(
            newton.kernel, {TIME.text, STEP.text, *(p.text for p in self.plan.parameters)}
        )
        nears = {OWN: PLACE}
        body: list[Statement] = []
        for k in sorted({load.neighbour for load in newton.loads} - {OWN}):
            there, place = moved(PLACE, step.offsets[k][0], SITES, step.periodic)
            nears[k] = count(f"near_{k}")
            body.append(Assign(nears[k], place))
        read = symbols_of(newton.kernel)
        # Each symbol in ``newton.exists`` is 1 if the neighbour exists, and 0 otherwise.
        for k, symbol in enumerate(newton.exists):
            there, _ = moved(PLACE, step.offsets[k][0], SITES, step.periodic)
            if symbol in read and there is not None:
                body.append(Assign(own(symbol), select(there, number(1.0), number(0.0))))
        body += [Assign(own(x.symbol), entry_of(step, x.row, nears[x.neighbour])) for x in newton.loads]
        # The outputs of the kernel are the entries of the blocks LEFT, OWN_BLOCK and RIGHT, in this order.
        first = Assign(_ENTRY, _BASE + PLACE * (3 * self.n * self.n))
        stores = [
            Assign(self.work[_ENTRY + k] if k else self.work[_ENTRY], end) for k, end in enumerate(ends)
        ]
        # Each site writes only its own blocks, so several processors can execute the loop.
        loop = distributed(For(PLACE, SITES, (*body, *inside, first, *stores)))
        arrays = {x.row.array for x in newton.loads} | {"work"}
        scalars = tuple(x for x in (TIME, STEP, *self.plan.parameters) if x.text in read)
        given = tuple(array for name, array in ARRAYS.items() if name in arrays)
        about = "Compute the blocks of Newton's matrix at all sites."
        start = Assign(_BASE, self.row(newton.matrix))
        return Function(self.name("linearise"), about, (SITES, *given, *scalars), (start, *before, loop))

    def substitute(self) -> Function:
        """Return the function that solves the factored linear equations for one right-hand side.

        The solution overwrites the right-hand side.
        """
        n, value = self.n, real("value", self.n)

        def x(site: Term, k: Term) -> Term:
            return self.work[_FIRST + k * STRIDE + site]

        # After ``factor``, OWN_BLOCK contains the inverse P of the pivot block. ``factor`` has also replaced
        # LEFT by the product P LEFT.
        left = self.cell(_SITE, LEFT, _I, _K) * x(_SITE - 1, _K)
        forward = For(
            _I,
            whole(n),
            (
                Assign(_SUM, number(0.0)),
                *self.dot(self.cell(_SITE, OWN_BLOCK, _I, _K) * x(_SITE, _K), plus=True),
                If(_SITE > 0, tuple(self.dot(left))),
                Assign(value[_I], _SUM),
            ),
        )
        # Each new component needs all old components, so the new components are first stored in ``value``.
        taken = For(_I, whole(n), (Assign(x(_SITE, _I), value[_I]),))
        right = self.cell(_SITE, RIGHT, _I, _K) * x(_SITE + 1, _K)
        backward = For(
            _I,
            whole(n),
            (Assign(_SUM, x(_SITE, _I)), *self.dot(right), Assign(x(_SITE, _I), _SUM)),
        )
        body: list[Statement] = [
            Assign(_BASE, self.row(self.newton.matrix)),
            For(_SITE, _INNER, (Array(value), forward, taken)),
            For(_SITE, _INNER - 1, (backward,), reverse=True),
        ]
        about = (
            "Solve the equations of the sites 0, ..., inner - 1 by forward and back substitution. The "
            "solution overwrites the right-hand side."
        )
        return Function(self.name("substitute"), about, (_INNER, SITES, self.work, _FIRST), tuple(body))

    def factor(self) -> Function:
        """Return the emitted function that factors the matrix and returns a status."""
        n, diagonal, column = self.n, real("diagonal", self.n * self.n), real("column", self.n)
        invert = Call("invert", (whole(n), diagonal), (_REGULAR,))
        # A later failure overwrites the status. However, if a pivot block contains an infinity or a NaN, all
        # later pivot blocks contain one, too. Therefore SINGULAR never overwrites NOT_FINITE.
        cause = select(all_finite(diagonal), code(SINGULAR), code(NOT_FINITE))
        tested = If(_REGULAR.equals(whole(0)), (Assign(STATUS, cause),))
        # At site i - 1, the block RIGHT was already multiplied by the inverse of the pivot block.
        left = self.cell(_SITE, LEFT, _I, _K) * self.cell(_SITE - 1, RIGHT, _K, _J)
        pivot = (
            Assign(_SUM, self.cell(_SITE, OWN_BLOCK, _I, _J)),
            If(_SITE > 0, tuple(self.dot(left))),
            Assign(diagonal[_I * n + _J], _SUM),
        )
        scaled: list[Statement] = []
        for block in (LEFT, RIGHT):
            entry = (
                Assign(_SUM, number(0.0)),
                For(
                    _K,
                    whole(n),
                    (Assign(_SUM, _SUM + diagonal[_I * n + _K] * self.cell(_SITE, block, _K, _J)),),
                ),
                Assign(column[_I], _SUM),
            )
            # Each new entry needs the whole old column, so the new entries are first stored in ``column``.
            back = Assign(self.cell(_SITE, block, _I, _J), column[_I])
            scaled.append(For(_J, whole(n), (For(_I, whole(n), entry), For(_I, whole(n), (back,)))))
        stored = Assign(self.cell(_SITE, OWN_BLOCK, _I, _J), diagonal[_I * n + _J])
        site = (self.both(pivot), invert, tested, *scaled, self.both((stored,)))
        body: list[Statement] = [
            *self.opening(),
            Assign(STATUS, code(OK)),
            Array(diagonal),
            Array(column),
            # ``border_columns`` must come before the loop over the sites, because the loop overwrites entries
            # that ``border_columns`` reads.
            *(self.border_columns() if self.step.periodic else []),
            For(_SITE, _INNER, site),
            *(self.border_pivot(diagonal, invert, tested) if self.step.periodic else []),
            Return(STATUS),
        ]
        about = "Factor the matrix by block elimination. Return a status other than OK if it has no inverse."
        return Function(self.name("factor"), about, (SITES, self.work), tuple(body), Kind.STATUS)

    def both(self, body: tuple[Statement, ...]) -> For:
        """Return two nested loops that execute ``body`` for each entry (i, j) of a block."""
        return For(_I, whole(self.n), (For(_J, whole(self.n), body),))

    def border_columns(self) -> list[Statement]:
        """Return the statements that compute the border of Newton's matrix, for a periodic chain.

        The border contains the coefficients of the last site's unknowns in the equations of all other sites.
        """
        # The sites are 0, 1, ..., ``_INNER``, and the chain is periodic. Therefore the unknowns of site
        # ``_INNER`` occur in the equations of its neighbours, the sites 0 and ``_BEFORE`` = ``_INNER`` - 1.
        # In the equations of the sites 1, ..., ``_BEFORE`` - 1, the coefficients of these unknowns are zero.
        n, ends = self.n, []
        for site, block in ((whole(0), LEFT), (_BEFORE, RIGHT)):
            there = self.border(site, _I, _J)
            # In a periodic chain of two sites, the last site is both neighbours of site 0, the left one and
            # the right one. Then two coefficients belong to the same entry ``there``. They are added, because
            # otherwise the second coefficient would overwrite the first one.
            ends.append(self.both((Assign(there, there + self.cell(site, block, _I, _J)),)))
        place = count("place")
        zero = Assign(self.work[self.row(self.newton.border) + place], number(0.0))
        return [Assign(_BEFORE, _INNER - 1), For(place, n * n * STRIDE, (zero,)), *ends]

    def border_pivot(self, diagonal: Term, invert: Call, tested: If) -> list[Statement]:
        """Return the statements that compute and invert the pivot block of the last site.

        Let T be Newton's matrix without the rows and columns of the last site. For each column c of the
        border (:meth:`border`), the statements first solve the equation T x = c with ``substitute``. The
        solution x overwrites the column c.
        """
        n = self.n
        first = row_of(self.step, _J * n + self.newton.border)
        solved = For(_J, whole(n), (Call(self.name("substitute"), (_INNER, SITES, self.work, first)),))
        # The sites are 0, 1, ..., ``_INNER``. The left neighbour of site ``_INNER`` is site ``_BEFORE``. The
        # right neighbour is site 0, because the chain is periodic.
        right = self.cell(_INNER, RIGHT, _I, _K) * self.border(whole(0), _K, _J)
        left = self.cell(_INNER, LEFT, _I, _K) * self.border(_BEFORE, _K, _J)
        pivot = (
            Assign(_SUM, self.cell(_INNER, OWN_BLOCK, _I, _J)),
            *self.dot(right),
            *self.dot(left),
            Assign(diagonal[_I * n + _J], _SUM),
        )
        stored = Assign(self.cell(_INNER, OWN_BLOCK, _I, _J), diagonal[_I * n + _J])
        return [solved, self.both(pivot), invert, tested, self.both((stored,))]

    def correct(self) -> Function:
        """Return the function that solves the linear equations, with the residuals as right-hand side.

        The function adds the solution to the unknowns.
        """
        first = self.row(self.newton.residual)
        most, moves, largest, change = real("most"), real("moves"), real("largest_unknown"), real("change")
        rows = {load.symbol: load.row for load in self.step.sweeps[self.block.last].loads}
        inner: list[Statement] = []
        for k, symbol in enumerate(self.step.sweeps[self.block.last].unknowns):
            unknown = entry_of(self.step, rows[symbol], PLACE)
            # The changes of the unknowns have overwritten the residuals.
            inner += [
                Assign(change, self.work[self.row(self.newton.residual + k) + PLACE]),
                Assign(most, greatest([most, size(change)])),
                # A maximum may ignore a NaN, but a sum does not.
                Assign(moves, moves + size(change)),
                Assign(largest, greatest([largest, size(unknown)])),
                Assign(unknown, unknown + change),
            ]
        base, inner_sites = self.opening()
        body: list[Statement] = [
            # In an open chain, no statement of this function reads ``_BASE``.
            *([base] if self.step.periodic else []),
            inner_sites,
            Call(self.name("substitute"), (_INNER, SITES, self.work, first)),
            *(self.border_solved(first) if self.step.periodic else []),
            *(Assign(x, number(0.0)) for x in (most, moves, largest)),
            For(PLACE, SITES, tuple(inner)),
            *(Assign(MEASURED[k], x) for k, x in enumerate((most, largest, moves))),
        ]
        about = "Solve the linear equations, and add the solution to the unknowns. Compute the maximum "
        about += "norm of the solution, the maximum norm of the old unknowns, and the 1-norm of the solution."
        return Function(self.name("correct"), about, (SITES, self.work, MEASURED), tuple(body))

    def border_solved(self, first: Term) -> list[Statement]:
        """Return the statements that complete Newton's correction in a periodic chain.

        Before these statements, the corrections at all sites except the last were computed as if the
        correction at the last site were zero. The statements compute the correction at the last site, and
        then subtract the effect of this correction from the corrections at the other sites. ``first`` is the
        index in the workspace at which the right-hand side begins.
        """
        n, value = self.n, real("value", self.n)

        def x(site: Term, k: Term) -> Term:
            return self.work[first + k * STRIDE + site]

        # In the equations of the last site, the terms of its neighbours move to the right-hand side.
        rest = (
            Assign(_SUM, x(_INNER, _I)),
            *self.dot(self.cell(_INNER, RIGHT, _I, _K) * x(whole(0), _K)),
            *self.dot(self.cell(_INNER, LEFT, _I, _K) * x(_BEFORE, _K)),
            Assign(value[_I], _SUM),
        )
        own_block = (
            Assign(_SUM, number(0.0)),
            *self.dot(self.cell(_INNER, OWN_BLOCK, _I, _K) * value[_K], plus=True),
            Assign(x(_INNER, _I), _SUM),
        )
        # Back substitution: the solution at the last site corrects the solutions at all other sites.
        others = (
            Assign(_SUM, x(_SITE, _I)),
            *self.dot(self.border(_SITE, _I, _K) * x(_INNER, _K)),
            Assign(x(_SITE, _I), _SUM),
        )
        return [
            Assign(_BEFORE, _INNER - 1),
            Array(value),
            For(_I, whole(n), rest),
            For(_I, whole(n), own_block),
            For(_SITE, _INNER, (For(_I, whole(n), others),)),
        ]
