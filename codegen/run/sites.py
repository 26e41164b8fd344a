"""The emitted functions for steps and runs of a lattice (:mod:`codegen.ir.site_step`).

The number of sites in each dimension is an argument of the emitted functions. Row k of an array contains
component k of all sites. Within a row of an array, the last index of a site changes fastest.

A sweep is a loop over all sites. Sweep number K has three functions. ``sweep_K`` computes consecutive sites
whose neighbours all exist. ``site_K`` computes one site, which may be at the boundary. ``pass_K`` computes
every site once, with ``sweep_K`` or with ``site_K``.

``sweep_K`` uses fast sines, cosines and Stumpff functions, which return NaN for arguments far from zero. If
the new state is not finite at some site, the step is repeated with ``site_K`` for all sites. A finite result
of ``sweep_K`` is equal to the result of ``site_K``, bit for bit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

from codegen.ir.site_step import EXISTS, OWN, RESULT, STATE, WORK, Load, Row, SiteStep, Sweep
from codegen.run.batch import VECTORISED, called_by
from codegen.run.language import (
    Assign,
    Call,
    For,
    Function,
    If,
    Return,
    Statement,
    While,
)
from codegen.run.plan import STEP, STEPS, TIME, Plan, symbols_of
from codegen.run.site_solver import iterated, solvers
from codegen.run.site_sums import sum_of_terms, summed
from codegen.run.site_terms import (
    ARRAYS,
    BAD,
    COLUMN,
    COLUMNS,
    FIRST,
    INDEX,
    NUMBER,
    PLACE,
    ROW,
    SITE,
    SITES,
    SIZE,
    STRIDE,
    WHOLE,
    chunks,
    distributed,
    entry_of,
    moved,
    padded,
    shape_of,
    split,
    with_stride,
)
from codegen.run.step import exact_time
from codegen.run.terms import (
    BAD_SHAPE,
    BAD_STEP,
    NOT_FINITE,
    OK,
    STATUS,
    Kind,
    Term,
    both,
    code,
    count,
    either,
    flag,
    given,
    greatest,
    is_finite,
    negated,
    number,
    own,
    paired,
    real,
    select,
    size,
    total,
    whole,
)

_PART, _INNER, _LEAD = count("part"), count("inner"), count("lead")
_DONE, _COMPLETED = count("done"), count("completed", 1, optional=True, cell=True)
_STATE, _WORK, _RESULT = ARRAYS[STATE], ARRAYS[WORK], ARRAYS[RESULT]

ADVANCE, ABOUT_STEP = "advance", "One step of all sites; return its status."

RETURNED = Return(select(BAD > 0, code(NOT_FINITE), code(OK)))
"""The statement that returns the status: OK, or NOT_FINITE if the new state of a site is not finite."""


def functions(plan: Plan, step: SiteStep) -> list[Function]:
    """Return the functions of a method that is not a composition of flows. Callees come before callers."""
    loops = [Loop(plan, step, sweep, k) for k, sweep in enumerate(step.sweeps, 1)]
    listed = [f for loop in loops for f in (loop.sweep(), loop.site(), loop.all_sites())]
    listed += [*([sum_of_terms()] if step.totals else []), *solvers(plan, step)]
    return complete(plan, step, [*listed, _advance(plan, step, loops)])


def complete(plan: Plan, step: SiteStep, listed: list[Function]) -> list[Function]:
    """Return all functions of a step: the functions ``listed``, followed by the public functions."""
    shape = shape_of(step)
    counted = Assign(SITES, _product(shape, step.dimension))
    # The user of the emitted code allocates the workspace.
    size = Return(step.workspace * STRIDE)
    workspace = Function(
        "workspace", "", (shape,), (counted, Assign(STRIDE, padded(SITES)), size), Kind.COUNT, public=True
    )
    return [*map(with_stride, listed), workspace, _run(plan, step, any(f.near for f in listed))]


def _product(shape: Term, dimension: int) -> Term:
    return reduce(lambda a, b: a * b, (shape[k] for k in range(dimension)))


def checked(values: Sequence[Term]) -> list[Statement]:
    """Return the statements that add 1 to BAD if one of the ``values`` is not finite."""
    # ``x - x`` is 0 for a finite x, and NaN otherwise.
    check = real("check")
    bad = select(check.equals(number(0.0)), whole(0), whole(1))
    return [Assign(check, paired([x - x for x in values])), Assign(BAD, BAD + bad)]


@dataclass(frozen=True)
class Loop:
    """Builds the emitted functions of one sweep. If ``tested`` is False, the functions do not test whether
    new values are finite."""

    plan: Plan
    step: SiteStep
    own: Sweep
    index: int
    tested: bool = True

    @property
    def last(self) -> bool:
        """True if the sweep stores the new state and tests whether the new state is finite."""
        return self.tested and any(row.array == RESULT for row in self.own.stores)

    @property
    def near(self) -> bool:
        """True if ``sweep_K`` calls fast sines, cosines and Stumpff functions that are valid only near zero.
        They have no branches, and are used only if all other functions in the sweep have no branches either.
        """
        before, inside, _ = split(self.own.kernel, set())
        called = called_by([*before, *inside])
        return all(name in VECTORISED or name.startswith("stumpff_") for name in called)

    @property
    def neighbours(self) -> tuple[int, ...]:
        """The neighbours whose values the sweep reads, as indices of :attr:`SiteStep.offsets`."""
        return self.own.neighbours

    @property
    def arrays(self) -> tuple[Term, ...]:
        """The arrays that the sweep reads or changes."""
        used = {load.row.array for load in self.own.loads} | {row.array for row in self.own.stores}
        return tuple(array for name, array in ARRAYS.items() if name in used)

    @property
    def scalars(self) -> tuple[Term, ...]:
        """The scalars that the sweep reads: time, step size, sums over all sites, and parameters."""
        read = {s for kernel in self.own.kernels for s in kernel.used_scalars()}
        totals = map(own, self.step.totals)
        return tuple(x for x in (TIME, STEP, *totals, *self.plan.parameters) if x.text in read)

    @property
    def shared(self) -> set[str]:
        """The names of the scalars that the sweep reads."""
        return {x.text for x in self.scalars}

    def entry(self, row: Row, place: Term) -> Term:
        """Return the entry with the index ``place`` in ``row``."""
        return entry_of(self.step, row, place)

    def loaded(
        self, load: Load, place: Term, around: dict[int, Term], exist: Mapping[int, Term] | None = None
    ) -> Term:
        """Return the entry that a load reads.

        ``around`` contains the site index of each neighbour, and ``exist`` contains a flag for each
        neighbour. If ``exist`` is None, all neighbours exist.
        """
        if load.row.array == EXISTS:
            one = number(1.0)
            return one if exist is None else select(exist[load.row.number], one, number(0.0))
        return self.entry(load.row, place if load.neighbour == OWN else around[load.neighbour])

    def stored(self, ends: Sequence[Term], place: Term) -> list[Statement]:
        """Return the statements that store the results ``ends`` of a site and test for infinity and NaN."""
        # Newton's method needs the residuals instead of the new values of the unknowns.
        body, images = self._images(ends)
        tested = []
        replaced = images if self.own.measured else self._residuals(images)
        for row, end in zip(self.own.stores, [*replaced, *ends[len(images) :]], strict=True):
            if self.last and row.array == RESULT:
                # Two statements use the value, so it is assigned to a variable.
                name = own(f"new {self.plan.symbols[row.number]}")
                body.append(Assign(name, end))
                tested.append(name)
                end = name
            body.append(Assign(self.entry(row, place), end))
        body += self._measured(images, place) if self.own.measured else []
        body += checked(tested) if tested else []
        return body

    def _images(self, ends: Sequence[Term]) -> tuple[list[Statement], list[Term]]:
        """Return the assignments of the new values of all unknowns, and the variables for the new values."""
        images = [own(f"next {u}") for u in self.own.unknowns]
        # ``ends`` begins with the new values of the unknowns. Other results may follow.
        return [Assign(x, end) for x, end in zip(images, ends, strict=False)], images

    def _residuals(self, images: Sequence[Term]) -> list[Term]:
        """Return the residuals g(u) - u for Newton's method. ``images`` contains g(u)."""
        return [x - own(u) for x, u in zip(images, self.own.unknowns, strict=True)]

    def _measured(self, images: Sequence[Term], place: Term) -> list[Statement]:
        """Return the statements that store two numbers of a site: the largest change of an unknown, and the
        largest absolute value of an unknown."""
        unknowns = [own(u) for u in self.own.unknowns]
        changes = [own(f"change {u}") for u in self.own.unknowns]
        body: list[Statement] = [
            Assign(c, size(x - u)) for c, x, u in zip(changes, images, unknowns, strict=True)
        ]
        # A maximum may ignore a NaN. ``sum_of_changes - sum_of_changes`` is NaN if a change is not finite,
        # and 0 otherwise.
        sum_of_changes = real("total")
        body.append(Assign(sum_of_changes, total(changes)))
        largest = (greatest(changes) + (sum_of_changes - sum_of_changes), greatest(map(size, unknowns)))
        rows = zip(self.own.measured, largest, strict=True)
        return [*body, *(Assign(self.entry(row, place), x) for row, x in rows)]

    def function(
        self, name: str, about: str, parameters: tuple[Term, ...], body: list[Statement]
    ) -> Function:
        """Return an emitted function with the statements ``body``.

        If :attr:`last` is true, the function returns the number of sites whose new state is not finite.
        """
        if self.last:
            body = [Assign(BAD, whole(0)), *body, Return(BAD)]
        kind = Kind.COUNT if self.last else None
        vector = name == self.name("sweep") and self.near
        return Function(name, about, parameters, tuple(body), kind, often=True, near=vector)

    def name(self, of: str) -> str:
        """Return the name of a function. For ``of`` = "site" and sweep number 2, the name is ``site_2``."""
        return f"{of}_{self.index}"

    def sweep(self) -> Function:
        """Return the function ``sweep_K`` (K = ``index``) for consecutive sites. None of these sites is at an
        open boundary of the lattice, so all neighbours of these sites exist."""
        before, inside, ends = split(self.own.kernel, self.shared)
        starts = [count(f"start_{k}") for k in self.neighbours]
        nears = {k: start + INDEX for k, start in zip(self.neighbours, starts, strict=True)}
        loads = [Assign(own(x.symbol), self.loaded(x, PLACE, nears)) for x in self._read()]
        body: list[Statement] = [Assign(PLACE, SITE + INDEX), *loads, *inside]
        body += self.stored(ends, PLACE)
        loop = For(INDEX, NUMBER, tuple(body), independent=True)
        parameters = (SITE, NUMBER, *starts, SITES, *self.arrays, *self.scalars)
        about = f"Sweep {self.index} over consecutive sites whose neighbours exist: {self.own.about}."
        return self.function(self.name("sweep"), about, parameters, [*before, loop])

    def _read(self) -> list[Load]:
        """Return the elements of ``own.loads`` whose values the sweep uses."""
        # The change of an unknown is its new value minus its old value, so the old value is always loaded.
        read = symbols_of(self.own.kernel) | set(self.own.unknowns)
        return [load for load in self.own.loads if load.symbol in read]

    def site(self) -> Function:
        """Return ``site_K``, the function for one site. The site may be at the boundary."""
        before, inside, ends = split(self.own.kernel, self.shared)
        column: list[Statement] = [Assign(PLACE, ROW + COLUMN)]
        nears: dict[int, Term] = {}
        exist: dict[int, Term] = {}
        for k in self.neighbours:
            offset = self.step.offsets[k][-1]
            nears[k] = count(f"near_{k}")
            there, near = moved(COLUMN, offset, COLUMNS, self.step.periodic)
            column.append(Assign(nears[k], count(f"row_{k}") + near))
            # In a periodic lattice every neighbour exists.
            if not self.step.periodic:
                exist[k] = flag(f"exists_{k}")
                outer = [flag(f"inside_{k}")] if self.step.dimension > 1 else []
                tests = [*outer, *([there] if there is not None else [])]
                column.append(Assign(exist[k], both(*tests)))
        body = [*column, *self._loads_of_site(nears, exist), *before, *inside]
        body += self.stored(ends, PLACE)
        parameters = (COLUMN, COLUMNS, *self.rows(), SITES, *self.arrays, *self.scalars)
        about = f"One site of sweep {self.index}. The site may be at the boundary."
        return self.function(self.name("site"), about, parameters, body)

    def _loads_of_site(self, nears: dict[int, Term], exist: dict[int, Term]) -> list[Statement]:
        """Return the statements that load all numbers that the sweep reads at one site."""
        first = [load for load in self.own.loads if load.neighbour == OWN]
        body: list[Statement] = [Assign(own(x.symbol), self.loaded(x, PLACE, nears, exist)) for x in first]
        around = [load for load in self._read() if load.neighbour != OWN]
        if self.own.outside is None:
            return [*body, *(Assign(own(x.symbol), self.loaded(x, PLACE, nears)) for x in around)]
        # At an open boundary, some neighbours do not exist. The kernel ``outside`` computes the numbers that
        # replace the coordinates of such neighbours. This kernel may read values of the site.
        before, inside, ghosts = split(self.own.outside, set())
        body += [*before, *inside]
        for load, ghost in zip(around, ghosts, strict=True):
            # For a missing neighbour, this load reads some existing site. The value is not used.
            there = self.loaded(load, PLACE, nears)
            body.append(Assign(own(load.symbol), select(exist[load.neighbour], there, ghost)))
        return body

    def rows(self) -> tuple[Term, ...]:
        """Return the arguments that describe one row of the lattice.

        ROW is the index of the first site in this row. For each neighbour k, ``row_k`` is the index of the
        first site in the row of neighbour k. In an open lattice with several rows, the last arguments are
        flags. The flag ``inside_k`` is true if the row of neighbour k exists.
        """
        starts = [count(f"row_{k}") for k in self.neighbours]
        flags = [] if self.step.periodic or self.step.dimension == 1 else self.neighbours
        return (ROW, *starts, *(flag(f"inside_{k}") for k in flags))

    def all_sites(self) -> Function:
        """Return the emitted function that computes this sweep for all sites. Its name is ``pass_K``, where K
        is the number of the sweep."""
        body = self._row()
        bad = (("+", BAD),) if self.last else ()
        step, shape = self.step, shape_of(self.step)
        outer = [count(f"i{e}") for e in range(step.dimension - 1)]
        for e in range(step.dimension - 2, -1, -1):
            # Only the outermost loop is distributed over several processors.
            loop = For(outer[e], shape[e], tuple(body))
            body = [loop if e else distributed(loop, bad)]
        parameters = (WHOLE, shape, SITES, *self.arrays, *self.scalars)
        about = f"Compute sweep {self.index} at all sites of the lattice."
        first = [Assign(COLUMNS, shape[step.dimension - 1])]
        return self.function(self.name("pass"), about, parameters, [*first, *body])

    def _row(self) -> list[Statement]:
        """Return the statements that compute one row of the lattice."""
        step, shape = self.step, shape_of(self.step)
        outer = [count(f"i{e}") for e in range(step.dimension - 1)]
        body: list[Statement] = [Assign(ROW, first_site(outer, shape))]
        for k in self.neighbours:
            places = []
            tests = []
            for e, index in enumerate(outer):
                there, place = moved(index, step.offsets[k][e], shape[e], step.periodic)
                places.append(place)
                tests += [there] if there is not None else []
            body.append(Assign(count(f"row_{k}"), first_site(places, shape)))
            if outer and not step.periodic:
                inside = both(*tests) if tests else Term("number", (), Kind.FLAG, number=1)
                body.append(Assign(flag(f"inside_{k}"), inside))
        # The first ``low`` sites of the row have a neighbour beyond the left end of the row. The last
        # ``high`` sites of the row have a neighbour beyond the right end.
        lasts = [step.offsets[k][-1] for k in self.neighbours]
        low, high = max([0, *(-x for x in lasts)]), max([0, *lasts])
        flags = [flag(f"inside_{k}") for k in self.neighbours] if outer and not step.periodic else []
        regular = both(negated(WHOLE), COLUMNS > low + high, *flags)
        body.append(Assign(_INNER, select(regular, COLUMNS - (low + high), whole(0))))
        # The first ``_LEAD`` sites of the row are computed one by one, and the next ``_INNER`` sites by
        # ``sweep_K``. If ``_INNER`` is 0, all sites of the row are computed one by one.
        body.append(Assign(_LEAD, select(_INNER > 0, whole(low), COLUMNS)))
        chain = self.step.dimension == 1
        bad = (("+", BAD),) if self.last else ()
        lead = self._peeled(_LEAD, INDEX)
        # If the scene is a chain, several processors share the iterations of this loop.
        body.append(distributed(lead, bad) if chain else lead)
        starts = [_plus(count(f"row_{k}"), low + step.offsets[k][-1]) for k in self.neighbours]
        places, number = [_plus(ROW, low), *starts], _INNER
        # A chain has only one row, so processors share the sites of this row.
        if chain:
            places, number = [place + FIRST for place in places], SIZE
        arguments = (places[0], number, *places[1:], SITES, *self.arrays, *self.scalars)
        sweep = self._called("sweep", arguments)
        body.append(If(_INNER > 0, (chunks(_INNER, sweep, bad),) if chain else tuple(sweep)))
        body.append(self._peeled(COLUMNS - _LEAD - _INNER, _LEAD + _INNER + INDEX))
        return body

    def _peeled(self, number: Term, column: Term) -> For:
        arguments = (column, COLUMNS, *self.rows(), SITES, *self.arrays, *self.scalars)
        return For(INDEX, number, tuple(self._called("site", arguments)))

    def _called(self, of: str, arguments: tuple[Term, ...]) -> list[Statement]:
        if not self.last:
            return [Call(self.name(of), arguments)]
        return [Call(self.name(of), arguments, (_PART,)), Assign(BAD, BAD + _PART)]


def _plus(x: Term, n: int) -> Term:
    return x + n if n else x


def first_site(indices: Sequence[Term], shape: Term) -> Term:
    """Return the index of the first site of a row.

    A row extends along the last dimension of the lattice. ``indices`` contains the indices of the row in all
    other dimensions.
    """
    if not indices:
        return whole(0)
    # For two indices i and j, Horner's rule gives ``i * shape[1] + j``.
    total = indices[0]
    for e, index in enumerate(indices[1:], 1):
        total = total * shape[e] + index
    return total * COLUMNS


def _advance(plan: Plan, step: SiteStep, loops: Sequence[Loop]) -> Function:
    """Return the function that makes one step. The function does not test the shape of the lattice."""
    body: list[Statement] = []
    ends = {block.last: (number, block) for number, block in enumerate(step.blocks, 1)}
    calls: list[Statement] = []
    for k, loop in enumerate(loops):
        arguments = (WHOLE, shape_of(step), SITES, *loop.arrays, *loop.scalars)
        calls.append(Call(loop.name("pass"), arguments, (BAD,) if loop.last else ()))
        calls += summed(step, step.sweeps[k])
        # A block of equations may need several loops over all sites. Each iteration of the solver executes
        # all loops of the block. Therefore ``calls`` collects the calls for all loops of the block. After the
        # last loop of the block, ``iterated`` returns an iteration that contains the collected calls.
        if any(block.first <= k < block.last for block in step.blocks):
            continue
        body += iterated(plan, step, *ends[k], calls) if k in ends else calls
        calls = []
    return Function(ADVANCE, ABOUT_STEP, advance_parameters(plan, step), (*body, RETURNED), Kind.STATUS)


def advance_parameters(plan: Plan, step: SiteStep) -> tuple[Term, ...]:
    """Return the parameters of the function that makes one step."""
    return (WHOLE, shape_of(step), SITES, _STATE, _WORK, _RESULT, *plan.moment(), *plan.parameters)


def _too_small(step: SiteStep) -> Term:
    """Return a test that is true if the step cannot be computed on a lattice of the given shape.

    If a step changes pairs of neighbours in dimension e of a periodic lattice, ``shape[e]`` must be even.
    """
    shape, tests = shape_of(step), []
    for e in range(step.dimension):
        # A periodic index is corrected only once, by plus or minus ``shape[e]``. Therefore ``shape[e]`` must
        # be larger than all offsets.
        far = max(abs(offset[e]) for offset in step.offsets) if step.periodic else 0
        tests.append(shape[e] <= far if far else shape[e].equals(whole(0)))
        if step.periodic and any(sweep.axis == e for sweep in step.sweeps):
            # Pairs must not overlap, but in a periodic row of 3 sites, (0, 1) and (2, 0) share site 0.
            tests.append((shape[e] % 2).equals(whole(1)))
    return either(*tests)


def _run(plan: Plan, step: SiteStep, twice: bool) -> Function:
    """Return the public function that makes several steps of equal size.

    If ``twice`` is True, a step whose result is not finite is repeated once. The repetition does not use the
    fast variants of sines, cosines and Stumpff functions.
    """
    later = exact_time(TIME, _DONE, STEP)

    def advance(old: Term, new: Term, separately: bool) -> Call:
        every = Term("number", (), Kind.FLAG, number=int(separately))
        moment = plan.moment(later)
        return Call(
            ADVANCE, (every, shape_of(step), SITES, old, _WORK, new, *moment, *plan.parameters), (STATUS,)
        )

    def tried(old: Term, new: Term) -> tuple[Statement, ...]:
        # The fast sines, cosines and Stumpff functions return NaN for large arguments. Then the step is
        # repeated with ``site_K``.
        again = If(STATUS.equals(code(NOT_FINITE)), (advance(old, new, True),))
        return (advance(old, new, False), *((again,) if twice else ()))

    even = (_DONE % 2).equals(whole(0))
    # Steps alternate between ``state`` and the workspace, so the state is not copied after each step.
    body = (
        If(even, tried(_STATE, _WORK), tried(_WORK, _STATE)),
        If(STATUS.equals(code(OK)), (Assign(_DONE, _DONE + 1),)),
    )
    place = count("place")
    copied = distributed(For(place, step.size * SITES, (Assign(_STATE[place], _WORK[place]),)))
    statements: tuple[Statement, ...] = (
        If(given(_COMPLETED), (Assign(_COMPLETED[0], whole(0)),)),
        If(_too_small(step), (Return(code(BAD_SHAPE)),)),
        # If the number of steps is 0, the step size is not used, so it is not tested.
        If(both(STEPS > 0, negated(is_finite(STEP))), (Return(code(BAD_STEP)),)),
        Assign(SITES, _product(shape_of(step), step.dimension)),
        Assign(STATUS, code(OK)),
        Assign(_DONE, whole(0)),
        While(both(_DONE < STEPS, STATUS.equals(code(OK))), body),
        # After an odd number of steps, the new state is in the workspace and must be copied.
        If(negated((_DONE % 2).equals(whole(0))), (copied,)),
        If(given(_COMPLETED), (Assign(_COMPLETED[0], _DONE),)),
        Return(STATUS),
    )
    time = (TIME,) if plan.time else ()
    parameters = (shape_of(step), _STATE, *time, STEP, STEPS, *plan.parameters, _WORK, _COMPLETED)
    return Function("run", "", parameters, statements, Kind.STATUS, public=True)
