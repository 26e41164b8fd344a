"""Translates programs to sweeps over the sites of a lattice (:mod:`codegen.ir.site_step`).

The value of the field at a site depends on the states of neighbouring sites. Therefore one sweep stores the
arguments of the field for all sites, and the next sweep evaluates the field.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.errors import MethodError
from codegen.ir.kernel import Field as StateBlock
from codegen.ir.kernel import Kernel
from codegen.ir.program import Program
from codegen.ir.site_step import SiteStep
from codegen.kernel.site_execution import EVALUATED
from codegen.kernel.site_flows import flow_program
from codegen.kernel.site_plan import Planner
from codegen.kernel.site_sums import with_sums
from codegen.kernel.site_taylor import TaylorSweeps
from codegen.lower import lower, problem_for
from codegen.lower import lowering as lowering_of
from codegen.lower.flow_words import FlowLowering
from codegen.method import Method
from codegen.passes import PassReport, optimise
from codegen.scene.problem import TIME, Problem
from codegen.scene.site_scene import with_frozen_neighbours


def refused(scene: Problem, what: str, expected: str) -> MethodError:
    """Return the error for a method whose step cannot be computed by sweeps over sites.

    ``what`` is the reason, and ``expected`` describes the methods that are accepted.
    """
    hint = "use a method of another family, for example cf:cf4 or splitting:strang"
    return MethodError(what, where=scene.name, expected=expected, hint=hint)


@dataclass(frozen=True)
class SiteMethod:
    """A compiled method for a lattice.

    ``problem`` describes one site, and the states of its neighbours are parameters. For a splitting method,
    ``problem`` describes the whole lattice. ``lowered`` is the program of a step before the compiler passes,
    and ``program`` is the program after the passes. ``trace`` contains a report of each pass that changed the
    program.
    """

    problem: Problem
    lowered: Program
    program: Program
    trace: tuple[PassReport, ...]
    kernel: Kernel


def site_method(scene: Problem, method: Method, newton: bool = False) -> SiteMethod:
    """Compile ``method`` for the lattice ``scene``.

    If ``newton`` is true, Newton's method solves the implicit equations. The lattice must then be
    one-dimensional.

    The method may evaluate the field, the energy, and the derivatives of the energy. If the method evaluates
    another function of the scene, MethodError is raised. This rule does not apply to splitting methods and to
    Taylor's method.
    """
    lowering = lowering_of(method.family)
    # No compiler pass rewrites flows, so the passes are skipped for splitting methods.
    if isinstance(lowering, FlowLowering):
        program, kernel = flow_program(scene, method, lowering)
        return SiteMethod(scene, program, program, (), kernel)
    # The compiler passes need the problem of a single site, with the states of its neighbours as parameters.
    frozen = with_frozen_neighbours(scene)
    problem, lowered = problem_for(frozen, method), lower(frozen, method)
    program, trace = optimise(lowered, problem)
    degree = lowering.degree(method)
    if degree:
        return SiteMethod(problem, lowered, program, trace, taylor_kernel(program, problem, degree))
    operations = [assign.operation for assign in program.assigns()]
    # Operations that evaluate no formulas of the scene are always permitted.
    other = [x for x in operations if x.evaluates_scene and not isinstance(x, EVALUATED)]
    if other:
        what = f"the operation {other[0].name} of {method.label} is not available on lattices"
        raise refused(
            scene,
            what,
            "a method that evaluates only the field, the energy, and the derivatives of the energy",
        )
    return SiteMethod(
        problem, lowered, program, trace, site_kernel(with_sums(program, problem), problem, newton)
    )


def site_kernel(program: Program, problem: Problem, newton: bool = False) -> Kernel:
    """Return the kernel of a step program.

    ``problem`` describes one site with fixed neighbours
    (:func:`codegen.scene.site_scene.with_frozen_neighbours`). If ``newton`` is true, Newton's method solves
    the implicit equations.
    """
    assert problem.sites is not None
    return _kernel(program, problem, Planner(program, problem, problem.sites, newton=newton).step())


def taylor_kernel(program: Program, problem: Problem, degree: int) -> Kernel:
    """Return the kernel of Taylor's method of the given degree. ``problem`` describes one site."""
    assert problem.sites is not None
    return _kernel(program, problem, TaylorSweeps(program, problem, problem.sites, degree).step())


def _kernel(program: Program, problem: Problem, step: SiteStep) -> Kernel:
    assert problem.sites is not None
    # The sweeps read the states of neighbours from arrays, so these states are not arguments of the step.
    known = tuple(s for s in problem.runtime if s not in problem.sites.names)
    about = "coordinates of each site; row k of a state array contains coordinate k of all sites"
    name = "y" if problem.paired else problem.state[0].name
    state = (StateBlock(name, problem.symbols, about),)
    return Kernel(program.name, state, (TIME, "h", *known), (), (), sites=step)
