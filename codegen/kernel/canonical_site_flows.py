"""Translates splitting steps of a Hamiltonian lattice to sweeps. A sweep is a loop over all sites.

A kick changes only the momenta, and reads the group elements q of neighbouring sites. All other flows change
each site independently of its neighbours.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from codegen.flows.kick import Kick
from codegen.flows.part import Summand
from codegen.groups.capabilities import Coadjoint
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel, Let
from codegen.ir.number import Number
from codegen.ir.site_step import NO_TIME, OWN, RESULT, STATE, Load, Row, SiteFlow, SiteStep, Sweep
from codegen.kernel.assignments import Assignments, unique_name
from codegen.kernel.shared_angles import SharedArguments
from codegen.scene.flow import Flow
from codegen.scene.problem import TIME, Problem

Timed = tuple[str, Flow, Number]
"""A flow in a sequence of flows: its name, the flow, and a ratio of durations.

The ratio is the duration of this flow, divided by the duration of the first flow in the sequence.
"""

Word = Sequence[tuple[Summand, Number]]
"""The flows of a step in the order of application, each with its duration as a multiple of h."""

COPY = "the state is copied"
"""The description of a sweep that copies the state.

A copy is added before the first sweep if the first sweep reads neighbours or visits pairs of sites. A copy is
added after the last sweep if the last sweep reads neighbours or visits pairs of sites.
"""


def canonical_kernel(scene: Problem, label: str, word: Word, carrier: Summand | None) -> Kernel:
    """Return the kernel of a splitting method on a Hamiltonian lattice.

    ``carrier`` is the summand of the Hamiltonian whose flows advance the time t. If ``carrier`` is None, t is
    constant.
    """
    listed, elapsed = [], NO_TIME
    for summand, duration in word:
        listed += [(name, flow, duration, elapsed) for name, flow in summand.flows]
        # ``elapsed`` is the increase of the time t since the beginning of the step, divided by h. Only the
        # flows of the summand ``carrier`` increase t.
        elapsed = elapsed + duration if summand is carrier else elapsed
    # Except for kicks, no exact flow of a time-dependent summand is known.
    assert all(isinstance(flow, Kick) for _, flow, _, _ in listed if flow.timed)
    sweeps: list[Sweep] = []
    index: dict[tuple[object, ...], int] = {}
    flows: list[SiteFlow] = []
    for kick, group in groupby(listed, key=lambda item: isinstance(item[1], Kick)):
        run = list(group)
        # ``run`` contains successive flows that one sweep applies. If a later run contains the same flows
        # with proportional durations, no new sweep is created: the step executes the existing sweep again,
        # with the durations of the later run.
        first, moment = run[0][2:]
        ratios = [(name, flow, duration / first) for name, flow, duration, _ in run]
        key = tuple((name, ratio) for name, _, ratio in ratios)
        if key not in index:
            index[key] = len(sweeps)
            sweeps.append(_kick(scene, label, ratios) if kick else _local(scene, label, ratios))
        # The second argument, ``colour``, matters only in sweeps over pairs of sites.
        flows.append(SiteFlow(index[key], 0, first, moment))
    return kernel_of(scene, label, sweeps, flows)


def kernel_of(scene: Problem, label: str, sweeps: list[Sweep], flows: list[SiteFlow]) -> Kernel:
    """Return the kernel of a step that executes ``flows`` in the given order.

    If necessary, a sweep that copies the state is added before or after the flows (:data:`COPY`).
    """
    assert scene.sites is not None
    ends = [k for k in (0, -1) if not flows or not _over_sites(sweeps[flows[k].sweep])]
    # A copy of the state is represented by a flow with duration zero.
    if ends:
        sweeps = [*sweeps, _copy(scene, label)]
        copied = SiteFlow(len(sweeps) - 1, 0, Number.rational(0))
        flows = [*([copied] if 0 in ends else []), *flows, *([copied] if -1 in ends else [])]
    sites, size = scene.sites, len(scene.symbols)
    # No flow stores intermediate values, so the workspace has no rows.
    step = SiteStep(sites.dimension, sites.offsets, sites.periodic, tuple(sweeps), size, 0, tuple(flows))
    about = "coordinates of each site; row k of a state array contains coordinate k of all sites"
    name = "y" if scene.paired else scene.state[0].name
    state = (StateBlock(name, scene.symbols, about),)
    return Kernel(label, state, (TIME, "h", *scene.runtime), (), (), sites=step)


def _over_sites(sweep: Sweep) -> bool:
    """Return True if a sweep visits every site, and reads no coordinates of neighbours."""
    return sweep.axis == OWN and not sweep.neighbours


def _copy(scene: Problem, label: str) -> Sweep:
    domain = SharedArguments()
    outputs = tuple(map(domain.space.sym, scene.symbols))
    loads = tuple(Load(s, Row(STATE, k)) for k, s in enumerate(scene.symbols))
    stores = tuple(Row(RESULT, k) for k in range(len(outputs)))
    block = StateBlock("site", scene.symbols, COPY)
    return Sweep(COPY, Kernel(label, (block,), (), (), outputs), loads, stores)


def _local(scene: Problem, label: str, run: Sequence[Timed]) -> Sweep:
    """Return the sweep for flows that act on each site separately.

    In the formulas of the sweep, h is the duration of the first flow, and not the step size.
    """
    ends = _moved(scene, SharedArguments(), run)
    loads = tuple(Load(s, Row(STATE, k)) for k, s in enumerate(scene.symbols))
    stores = tuple(Row(RESULT, k) for k in range(len(scene.symbols)))
    return Sweep(_text(run), _scheduled(scene, label, ends), loads, stores)


def _kick(scene: Problem, label: str, run: Sequence[Timed]) -> Sweep:
    """Return the sweep for successive kicks.

    In the kernel of the sweep, h denotes the duration of the first kick in ``run``, and not the step size.
    The durations of all kicks are expressed as multiples of h.
    """
    sites = scene.sites
    assert sites is not None
    domain = SharedArguments()
    q, mu = (block.symbols for block in scene.state)
    # A kick does not change q, so only the momenta are computed and stored.
    ends = _moved(scene, domain, run)[len(q) :]
    kernel = _scheduled(scene, label, ends)
    read = {str(n.payload) for n in walk(ends) if n.op == "sym"}
    around = [
        (s, k, row) for k, column in enumerate(sites.symbols) for row, s in enumerate(column) if s in read
    ]
    outside = None
    # At an open boundary, formulas of the scene give the coordinates of the missing neighbours.
    if sites.outside:
        values = {s: domain.space.sym(s) for s in scene.symbols}
        values |= scene.scalars(domain, domain.space.sym(TIME))
        ghosts = [evaluate([sites.outside[k][row]], domain, values)[0] for _, k, row in around]
        outside = _scheduled(scene, label, ghosts)
        read |= {str(n.payload) for n in walk(ghosts) if n.op == "sym"}
    # Momenta are overwritten in place. This is possible because no site reads the momenta of its neighbours.
    own = [Load(s, Row(RESULT, k)) for k, s in enumerate(scene.symbols) if s in read]
    near = [Load(s, Row(RESULT, row), k) for s, k, row in around]
    stores = tuple(Row(RESULT, len(q) + k) for k in range(len(mu)))
    return Sweep(_text(run), kernel, (*own, *near), stores, outside)


def _moved(scene: Problem, domain: SharedArguments, run: Sequence[Timed]) -> list[Expr]:
    """Return the coordinates of a site after the flows of ``run``, as formulas in the old coordinates."""
    assert scene.sites is not None
    group, size = scene.group.require(Coadjoint), len(scene.state[0].symbols)
    # All flows in ``run`` use the same parameters and the same coordinates of the neighbours.
    fixed = {s: domain.space.sym(s) for s in scene.sites.names}
    fixed |= scene.scalars(domain, domain.space.sym(TIME))
    state = tuple(map(domain.space.sym, scene.symbols))
    q, mu = state[:size], state[size:]
    for _, flow, ratio in run:
        tau = domain.number(ratio) * domain.space.sym("h")
        # Each flow starts from the coordinates that the previous flow returned.
        values = fixed | dict(zip(scene.symbols, (*q, *mu), strict=True))
        q, mu = flow.advance(domain, group, values, tau, q, mu)
    return [*q, *mu]


def _scheduled(scene: Problem, label: str, ends: list[Expr]) -> Kernel:
    """Return a kernel with the outputs ``ends``. Its inputs are coordinates of a site and its neighbours."""
    assert scene.sites is not None
    symbols = (*scene.symbols, *scene.sites.names)
    taken = {*symbols, *scene.runtime, "h", TIME}

    schedule = Assignments((), ends, {}, lambda base: unique_name(base, taken))
    body = tuple(statement for statement in schedule.run() if isinstance(statement, Let))
    block = StateBlock("site", symbols, "the numbers that the sweep reads")
    return Kernel(label, (block,), (TIME, "h", *scene.runtime), body, schedule.outputs)


def _text(run: Sequence[Timed]) -> str:
    names = [name for name, _, _ in run]
    return f"flow of {names[0]}" if len(names) == 1 else f"flows of {', '.join(names)}"
