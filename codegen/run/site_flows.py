"""The emitted functions of a lattice step that is a composition of flows.

The vector field of the problem is a sum of parts, and the flow of each part is computed exactly. Most flows
change single sites, or pairs of neighbours along one axis of the lattice. Pairs whose first site has an even
index form one set, and all other pairs form a second set. No two pairs of a set have a common site.

Part number K has several functions:

- ``flow_K`` is a loop over consecutive sites, or over pairs of one set.
- ``part_K`` calls ``flow_K`` for all sites, or for all pairs of one set.
- ``whole_K`` is ``flow_K`` without the fast variants of sines, cosines and Stumpff functions. The fast
  variants are valid only near zero.
- ``pair_K`` applies the flow to one pair: the last and the first site of a periodic row.

A kick is a flow that reads neighbours and changes only momenta. A kick has other functions: ``sweep_K``,
``site_K`` and ``pass_K`` (:mod:`codegen.run.sites`).
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.ir.domain import ExprDomain
from codegen.ir.site_step import OWN, RESULT, STATE, Load, Row, SiteFlow, SiteStep, Sweep
from codegen.run.batch import VECTORISED, called_by
from codegen.run.language import Assign, Call, For, Function, If, Return, Statement
from codegen.run.plan import STEP, TIME, Plan, symbols_of
from codegen.run.site_terms import (
    ARRAYS,
    BAD,
    COLUMNS,
    FIRST,
    INDEX,
    NUMBER,
    PLACE,
    SITE,
    SITES,
    SIZE,
    WHOLE,
    chunks,
    distributed,
    shape_of,
    split,
)
from codegen.run.sites import (
    ABOUT_STEP,
    ADVANCE,
    RETURNED,
    Loop,
    advance_parameters,
    checked,
    complete,
    first_site,
)
from codegen.run.terms import Kind, Term, count, own, select, value, whole

_PART_BAD = count("part")
_NEAR, _START, _COLOUR, _PAIR, _ROW, _OTHER = (
    count(name) for name in ("near", "start", "colour", "pair", "row", "other")
)


def functions(plan: Plan, step: SiteStep) -> list[Function]:
    """Return the functions of a method that composes flows. Callees come before their callers."""
    parts = [_part(plan, step, sweep, k) for k, sweep in enumerate(step.sweeps)]
    listed = [f for part in parts for f in part.functions()]
    return complete(plan, step, [*listed, _advance(plan, step, parts)])


def _part(plan: Plan, step: SiteStep, sweep: Sweep, index: int) -> _Part | _Kick:
    # A kick changes single sites, but reads their neighbours.
    if sweep.axis == OWN and sweep.neighbours:
        # The last flow of a step is never a kick. The last flow checks the whole new state for infinities and
        # NaNs, so a kick needs no check.
        return _Kick(Loop(plan, step, sweep, index, tested=False))
    return _Part(plan, step, sweep, index)


@dataclass(frozen=True)
class _Kick:
    """Builds the functions of a kick: a flow that reads neighbours and changes only momenta."""

    loop: Loop

    def functions(self) -> list[Function]:
        """Return ``sweep_K``, ``site_K`` and ``pass_K``.

        Each function comes after the functions that it calls.
        """
        return [self.loop.sweep(), self.loop.site(), self.loop.all_sites()]

    def called(self, flow: SiteFlow, duration: Term, first: bool) -> Call:
        """Return the call that applies ``flow`` to all sites. The flow has the duration ``duration``."""
        shape = shape_of(self.loop.step)
        domain = ExprDomain()
        space = domain.space
        # If the kick depends on time, ``moment`` is the time at which the kick is evaluated.
        moment = (
            TIME
            if flow.elapsed.is_zero
            else value(space.sym(TIME.text) + domain.number(flow.elapsed) * space.sym(STEP.text))
        )
        # In the kernel of a kick, the symbol h denotes the duration of the kick.
        given = {STEP.text: duration, TIME.text: moment}
        scalars = tuple(given.get(x.text, x) for x in self.loop.scalars)
        # A kick changes the array RESULT in place.
        return Call(self.loop.name("pass"), (WHOLE, shape, SITES, ARRAYS[RESULT], *scalars))


@dataclass(frozen=True)
class _Part:
    """Builds the emitted functions of one flow, for all flows except kicks.

    A kick is a flow that changes single sites and reads their neighbours. The functions of a kick must treat
    sites at the boundary separately, so another class builds them (``_Kick``).
    """

    plan: Plan
    step: SiteStep
    own: Sweep
    index: int

    @property
    def paired(self) -> bool:
        """True if the flow changes pairs of neighbours, and False if it changes single sites."""
        return self.own.axis != OWN

    @property
    def special(self) -> bool:
        """True if the emitted code has two functions for flow number K: ``flow_K`` and ``whole_K``.

        If the property is True, ``flow_K`` calls fast sines, cosines and Stumpff functions, which are valid
        only near zero, and ``whole_K`` calls functions that are valid for all arguments. If the property is
        False, only ``flow_K`` exists, and calls functions that are valid for all arguments.
        """
        _, inside, _ = split(self.own.kernel, set())
        # The functions ``sqrt``, ``fabs`` and ``choose`` never have branches, so they need no fast variant.
        called = called_by(inside) - {"sqrt", "fabs", "choose"}
        # If a called function has branches, compilers cannot use vector instructions for the loop.
        able = all(name in VECTORISED or name.startswith("stumpff_") for name in called)
        return bool(called) and able

    @property
    def strided(self) -> bool:
        """True if the flow changes pairs of neighbours along the last axis of the lattice.

        The two sites of a pair are then adjacent in memory. Therefore the first sites of consecutive pairs
        have the distance (stride) 2.
        """
        return self.paired and self.own.axis == self.step.dimension - 1

    @property
    def scalars(self) -> tuple[Term, ...]:
        """The duration and the problem parameters. Scalars that the flow does not read are omitted."""
        read = symbols_of(self.own.kernel)
        return tuple(x for x in (STEP, *self.plan.parameters) if x.text in read)

    @property
    def arrays(self) -> tuple[Term, ...]:
        """The arrays that the flow reads or changes, as arguments of the emitted functions.

        A flow of pairs of sites reads and overwrites one array. A flow of single sites reads the first of
        two arrays and writes the second.
        """
        # The first flow of a step reads the old state and writes the new state, so no state is copied.
        return (ARRAYS[RESULT],) if self.paired else (ARRAYS[STATE], ARRAYS[RESULT])

    def functions(self) -> list[Function]:
        """Return the functions of this flow. Each function comes after the functions that it calls."""
        loops = [self.loop("flow", self.special), *([self.loop("whole", False)] if self.special else [])]
        # In a periodic row, the last and the first site are neighbours but not adjacent in memory.
        ends = [self.single_pair()] if self.strided and self.step.periodic else []
        return [*loops, *ends, self.pairs() if self.paired else self.all_sites()]

    def entry(self, row: Row, neighbour: int) -> Term:
        """Return the entry of ``row`` for one site.

        A row contains one number for each site of the lattice. In a flow of single sites, ``neighbour`` is
        OWN. In a flow of pairs, ``neighbour`` is OWN for the first site of a pair, and 0 for the second site.
        """
        place = PLACE if neighbour == OWN else _NEAR
        array = ARRAYS[row.array]
        return (
            # A row of a state contains exactly ``sites`` entries, without padding.
            array[(row.number * SITES if row.number > 1 else SITES) + place] if row.number else array[place]
        )

    def loop(self, name: str, near: bool) -> Function:
        """Return the function ``flow_K`` or ``whole_K`` for K = ``index``.

        ``name`` is ``flow`` or ``whole``. If ``near`` is True, the function calls fast variants of sines,
        cosines and Stumpff functions, which are valid only near zero.
        """
        before, inside, ends = split(self.own.kernel, {x.text for x in self.scalars})
        body: list[Statement] = [Assign(PLACE, SITE + (2 * INDEX if self.strided else INDEX))]
        if self.paired:
            # Adjacent indices allow compilers to load both sites of a pair with one instruction.
            body.append(Assign(_NEAR, PLACE + 1 if self.strided else _START + INDEX))
        body += self._moved(inside, ends)
        # The last flow of a step is never a flow of pairs, and checks every site for infinities and NaNs.
        # Therefore a flow of pairs needs no check.
        if not self.paired:
            body += checked(self._news)
        # No site occurs in two iterations, so compilers may use vector instructions.
        loop = For(INDEX, NUMBER, tuple(body), independent=True)
        # If ``strided`` is True, pair number k consists of the sites SITE + 2 k and SITE + 2 k + 1, so one
        # start index is enough. If ``strided`` is False, pair number k consists of the sites SITE + k and
        # _START + k.
        starts = (SITE, _START) if self.paired and not self.strided else (SITE,)
        parameters = (*starts, NUMBER, SITES, *self.arrays, *self.scalars)
        about = f"Consecutive sites: {self.own.about}."
        if self.paired:
            about = f"Loop over disjoint pairs of neighbours: {self.own.about}."
        return self._function(f"{name}_{self.index}", about, parameters, [*before, loop], near)

    @property
    def _news(self) -> list[Term]:
        return [own(f"new {load.symbol}") for load in self.own.loads]

    def _moved(self, inside: list[Statement], ends: list[Term]) -> list[Statement]:
        """Return the statements that apply this flow to one site or to one pair of sites."""
        # The old and the new state may be the same array, so all loads precede the first store.
        read = symbols_of(self.own.kernel)
        body: list[Statement] = [
            Assign(own(x.symbol), self._loaded(x)) for x in self.own.loads if x.symbol in read
        ]
        body += inside
        body += [Assign(new, end) for new, end in zip(self._news, ends, strict=True)]
        for k, (row, new) in enumerate(zip(self.own.stores, self._news, strict=True)):
            # The new values with k < ``size`` belong to the first site, and all other new values to the
            # second site of a pair.
            body.append(Assign(self.entry(row, OWN if k < self.step.size else 0), new))
        return body

    def called(self, flow: SiteFlow, duration: Term, first: bool) -> Call:
        """Return the call of the function ``part_K`` for K = ``flow.sweep``.

        If ``first`` is True, the function reads the old state and writes the new state. Otherwise, the
        function changes the new state in place. A function for pairs of sites always changes the new state in
        place, so ``first`` must be False.
        """
        old, new = ARRAYS[STATE], ARRAYS[RESULT]
        # In the kernel of a flow, the symbol h denotes the duration of the flow.
        scalars = tuple(duration if x is STEP else x for x in self.scalars)
        if self.paired:
            given = (WHOLE, shape_of(self.step), whole(flow.colour), SITES, new, *scalars)
            return Call(f"part_{flow.sweep}", given)
        # The result of the call is assigned to BAD.
        return Call(f"part_{flow.sweep}", (WHOLE, SITES, old if first else new, new, *scalars), (BAD,))

    def single_pair(self) -> Function:
        """Return the function that applies the flow to one pair of sites.

        The pair consists of the last and the first site of a periodic row.
        """
        before, inside, ends = split(self.own.kernel, {x.text for x in self.scalars})
        parameters = (PLACE, _NEAR, SITES, *self.arrays, *self.scalars)
        body = [*before, *self._moved(inside, ends)]
        return self._function(f"pair_{self.index}", f"One pair: {self.own.about}.", parameters, body)

    def _loaded(self, load: Load) -> Term:
        return self.entry(load.row, load.neighbour)

    def _function(
        self, name: str, about: str, parameters: tuple[Term, ...], body: list[Statement], near: bool = False
    ) -> Function:
        if self.paired:
            return Function(name, about, parameters, tuple(body), often=True, near=near)
        body = [Assign(BAD, whole(0)), *body, Return(BAD)]
        return Function(name, about, parameters, tuple(body), Kind.COUNT, often=True, near=near)

    def _called(self, arguments: tuple[Term, ...], *results: Term) -> list[Statement]:
        """Return the statements that call ``whole_K`` if WHOLE is true at run time, and otherwise ``flow_K``.

        K is ``index``. If ``whole_K`` does not exist, the statements always call ``flow_K``.
        """
        given = (*arguments, SITES, *self.arrays, *self.scalars)
        call = Call(f"flow_{self.index}", given, results)
        if not self.special:
            return [call]
        return [If(WHOLE, (Call(f"whole_{self.index}", given, results),), (call,))]

    def all_sites(self) -> Function:
        """Return the function ``part_K``, which applies the flow to each site. K is ``index``."""
        parameters = (WHOLE, SITES, *self.arrays, *self.scalars)
        call = self._called((FIRST, SIZE), _PART_BAD)
        # Several processors add to the counter BAD, so the loop declares BAD as a sum (a reduction).
        body: list[Statement] = [chunks(SITES, [*call, Assign(BAD, BAD + _PART_BAD)], (("+", BAD),))]
        return self._function(f"part_{self.index}", f"All sites: {self.own.about}.", parameters, body)

    def pairs(self) -> Function:
        """Return the function ``part_K`` for a flow that changes pairs of sites.

        The argument ``colour`` of ``part_K`` is 0 for the pairs whose first site has an even index, and 1 for
        the other pairs.
        """
        shape = shape_of(self.step)
        last, periodic = self.step.dimension - 1, self.step.periodic
        outer = [count(f"i{e}") for e in range(last)]
        length = shape[self.own.axis]
        # The first site of a pair of colour 1 has an odd index along the axis. Therefore, in an open lattice,
        # the site with the index 0 belongs to no pair of colour 1.
        number = length // 2 if periodic else (length - _COLOUR) // 2
        body: list[Statement]
        if self.strided:
            body = [Assign(_ROW, first_site(outer, shape))]
            # ``pairs`` omits the pair of the last and the first site of a periodic row.
            pairs = (COLUMNS - _COLOUR) // 2
            # In one dimension, the only row is divided into chunks for several processors.
            if last:
                body += self._called((_ROW + _COLOUR, pairs))
            else:
                body.append(chunks(pairs, self._called((_ROW + _COLOUR + 2 * FIRST, SIZE))))
            if periodic:
                # The first site of this pair is in the last column. The number of columns is even, so the
                # last column has an odd index. Therefore this pair has the colour 1.
                ends = (_ROW + COLUMNS - 1, _ROW, SITES, *self.arrays, *self.scalars)
                body.append(If(_COLOUR > 0, (Call(f"pair_{self.index}", ends),)))
        else:
            body = self._rows(outer, shape)
        # The loop over ``_PAIR`` computes two neighbouring rows in each iteration.
        for e in range(last - 1, -1, -1):
            mine = e == self.own.axis
            loop = For(_PAIR if mine else outer[e], number if mine else shape[e], tuple(body))
            # No two iterations change the same site, so the outermost loop can be parallel.
            body = [loop if e else distributed(loop)]
        parameters = (WHOLE, shape, _COLOUR, SITES, *self.arrays, *self.scalars)
        first = [Assign(COLUMNS, shape[last])]
        about = (
            f"Apply a flow to pairs of sites: {self.own.about}. The two sites of each pair are neighbours "
            "along one axis of the lattice. If colour is 0, the first site of each pair has an even index "
            "along this axis. If colour is 1, the first site has an odd index."
        )
        return self._function(f"part_{self.index}", about, parameters, [*first, *body])

    def _rows(self, outer: list[Term], shape: Term) -> list[Statement]:
        """Return the statements that apply the flow to the pairs of sites in two adjacent rows.

        Pair number k consists of site k of the first row and site k of the second row.
        """
        axis, length = self.own.axis, shape[self.own.axis]
        index = outer[axis]
        there = count("there")
        following = [there if e == axis else x for e, x in enumerate(outer)]
        # In a periodic lattice, the row after the last row is the first row.
        moved = select(index + 1 < length, index + 1, whole(0)) if self.step.periodic else index + 1
        return [
            Assign(index, 2 * _PAIR + _COLOUR),
            Assign(there, moved),
            Assign(_ROW, first_site(outer, shape)),
            Assign(_OTHER, first_site(following, shape)),
            *self._called((_ROW, _OTHER, COLUMNS)),
        ]


def _advance(plan: Plan, step: SiteStep, parts: list[_Part | _Kick]) -> Function:
    """Return the function that makes one step. The caller tests whether the lattice has a valid shape."""
    domain = ExprDomain()
    body: list[Statement] = []
    for number, flow in enumerate(step.flows):
        duration = value(domain.number(flow.duration) * domain.space.sym("h"))
        # The first flow reads the old state. All later flows read the new state.
        body.append(parts[flow.sweep].called(flow, duration, number == 0))
    return Function(ADVANCE, ABOUT_STEP, advance_parameters(plan, step), (*body, RETURNED), Kind.STATUS)
