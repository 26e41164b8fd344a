"""Translates splitting methods on a lattice to sweeps over sites or over pairs of sites."""

from __future__ import annotations

from codegen.errors import MethodError
from codegen.flows.part import Summand
from codegen.flows.site_flow import SiteFlow as FlowOfPart
from codegen.ir.expr import Expr, evaluate
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel, Let
from codegen.ir.number import Number
from codegen.ir.program import Assign, Program
from codegen.ir.scene_operations import SiteFlowOf
from codegen.ir.site_step import RESULT, STATE, Load, Row, SiteFlow, Sweep
from codegen.ir.values import Coefficient, Kind, Var
from codegen.kernel.assignments import Assignments, unique_name
from codegen.kernel.canonical_site_flows import canonical_kernel, kernel_of
from codegen.kernel.shared_angles import SharedArguments
from codegen.lower.flow_words import FlowLowering
from codegen.method import Method
from codegen.scene.problem import TIME, Problem
from codegen.scene.sites import SitePart


def flow_program(scene: Problem, method: Method, lowering: FlowLowering) -> tuple[Program, Kernel]:
    """Return the program and the kernel of a splitting method on a lattice.

    MethodError is raised in four cases:
    - A part of the vector field has no exact flow.
    - The tableau of the method has the wrong format or the wrong number of parts.
    - The field depends on time and the scene is not Hamiltonian.
    - All parts depend on time.
    """
    assert scene.sites is not None
    if not scene.autonomous and not scene.paired:
        raise MethodError(
            f"a splitting cannot be used on {scene.name}, because the field of this lattice depends on t",
            expected="a field that does not depend on t, or a Hamiltonian lattice (HamiltonianSiteScene)",
        )
    reading = lowering.read(scene, method)
    word = reading.word
    # The function returns a program and a kernel. The kernel is built from ``word``. The program is built
    # from the assignments in ``body``.
    y = Var("y", Kind.POINT)
    body, last = [], y
    named = [(name, duration) for summand, duration in word for name, _ in summand.flows]
    for number, (name, duration) in enumerate(named, 1):
        target = Var(f"y{number}", Kind.POINT)
        body.append(Assign((target,), SiteFlowOf(name, Coefficient(duration, 1)), (last,)))
        last = target
    program = Program(method.label, (y,), tuple(body), (("y", last),))
    if scene.paired:
        return program, canonical_kernel(scene, method.label, word, reading.carrier)
    return program, _kernel(scene, method.label, word)


def _kernel(scene: Problem, label: str, word: tuple[tuple[Summand, Number], ...]) -> Kernel:
    assert scene.sites is not None
    # A summand of the field may have several flows, for example one for even pairs and one for odd pairs.
    listed = [(flow, duration) for summand, duration in word for _, flow in summand.flows]
    sweeps: list[Sweep] = []
    index: dict[int, int] = {}
    flows: list[SiteFlow] = []
    for flow, duration in listed:
        assert isinstance(flow, FlowOfPart)
        # All flows of one part use the same sweep.
        if flow.part not in index:
            index[flow.part] = len(sweeps)
            sweeps.append(_sweep(scene, label, scene.sites.parts[flow.part]))
        flows.append(SiteFlow(index[flow.part], flow.colour, duration))
    return kernel_of(scene, label, sweeps, flows)


def _sweep(scene: Problem, label: str, part: SitePart) -> Sweep:
    """Return the sweep for the flow of one part of the vector field.

    In the kernel of this sweep, the symbol h is the duration of the flow, and not the step size.
    """
    domain, dim, size = SharedArguments(), scene.group.dim, len(scene.symbols)
    names = [scene.symbols, *([part.symbols] if part.symbols else [])]
    symbols = {s: domain.space.sym(s) for own in names for s in own}
    # No time is passed to ``scalars``, because the vector field is autonomous.
    roots = evaluate(list(part.roots), domain, {**symbols, **scene.scalars(domain)})
    duration = domain.space.sym("h")
    ends: list[Expr] = []
    for k, own in enumerate(names):
        # For each site, ``roots`` contains an element of the Lie algebra that is constant along the flow.
        x = tuple(duration * r for r in roots[k * dim : (k + 1) * dim])
        ends += scene.action.actexp(domain, scene.group, x, tuple(symbols[s] for s in own))
    taken = {*symbols, *scene.runtime, "h", TIME}

    schedule = Assignments((), ends, {}, lambda base: unique_name(base, taken))
    body = tuple(statement for statement in schedule.run() if isinstance(statement, Let))
    # In one sweep each site belongs to only one pair, so a sweep over pairs can work in place.
    array = RESULT if part.symbols else STATE
    # ``side`` is 0 for the first site of a pair (or for a single site), and 1 for the second site. The third
    # argument of ``Load`` must be -1 for the first site and 0 for the second site
    # (:class:`codegen.ir.site_step.Sweep`).
    loads = [Load(s, Row(array, k), side - 1) for side, own in enumerate(names) for k, s in enumerate(own)]
    stores = [Row(RESULT, k) for _ in names for k in range(size)]
    about = f"flow of {part.name}" + (f", pairs along axis {part.axis}" if part.symbols else "")
    block = StateBlock("site", tuple(symbols), "the numbers that the sweep reads")
    kernel = Kernel(label, (block,), ("h", *scene.runtime), body, schedule.outputs)
    return Sweep(about, kernel, tuple(loads), tuple(stores), axis=part.axis)
