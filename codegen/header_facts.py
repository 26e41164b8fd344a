"""The content of the header of an emitted module.

The header states facts about the method and the scene. The header line ``left out`` names omitted operations
and arguments, and gives the reasons.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from codegen.certify import CertifiedOrder, rounding_of_digits
from codegen.ir.kernel import Kernel, Loop
from codegen.ir.precision import DOUBLE, Precision
from codegen.ir.smoothness import features
from codegen.lower import lowering
from codegen.passes import summaries
from codegen.printers.recipe import Recipe
from codegen.run.trial import PARTS
from codegen.scene.momentum_frame import start_of
from codegen.scene.problem import TIME, Problem
from orderconds import __version__

if TYPE_CHECKING:
    from codegen.emitter import Compiled

SINGLE_IS = (
    "single: exact constants are rounded to single precision, and implicit stages converge to this precision"
)

NOT_SMOOTH = "the stated order requires a vector field that is smooth along the whole step"
"""The header of an emitted module contains this remark if the vector field of the scene is not smooth."""

COMPENSATED = "compensated: the second half of the state contains correction terms, initially zero"
COUNTED = "; the numbers of sweeps in this header are for double precision"
"""A remark in the header of a module in single precision. A sweep is one iteration of the solver for
implicit equations.
"""


def recipe_of(compiled: Compiled, order: CertifiedOrder, command: str, target: Precision) -> Recipe:
    """Return the content of a module's header, and the data for the usage example in the header."""
    scene, method = compiled.scene, compiled.method
    first, last = scene.span
    single = target is not DOUBLE
    # If the method has a tableau, the header line ``digits`` describes the rounding of its coefficients.
    tableau = method.coefficients is not None
    carries = (0.0,) * (len(scene.symbols) if compiled.compensated else 0)
    digits = (("digits", rounding_of_digits(method, order, target, scene)),) if tableau else ()
    return Recipe(
        title=f"{scene.title}: one step by {method.label}",
        facts=(
            ("method", method.described),
            ("source", method.source),
            *coordinates_of(compiled),
            *_storage_facts(compiled),
            ("order", order.text()),
            *digits,
            *scene_facts(compiled),
            *site_facts(compiled),
            *_mode_facts(compiled),
            *((("flows", flows_of(compiled.problem)),) if compiled.problem.flows else ()),
            *((("substeps", substeps_of(compiled.kernel)),) if compiled.kernel.substeps else ()),
            *(("solved by", choice.text()) for choice in compiled.solvers),
            *((("precision", SINGLE_IS + COUNTED * bool(compiled.solvers)),) if single else ()),
            *((("steps", steps_of(compiled.kernel)),) if method.adaptive else ()),
            *_output_facts(compiled.kernel),
            *((("summation", COMPENSATED),) if compiled.compensated else ()),
        ),
        initial=(*start_of(scene), *carries),
        h=float((last - first) / PARTS),
        steps=PARTS,
        defaults={p: float(scene.parameters[p]) for p in scene.runtime},
        left_out=left_out(compiled),
        command=command,
        version=__version__,
    )


def _output_facts(kernel: Kernel) -> tuple[tuple[str, str], ...]:
    """Return a tuple with one header line, the line about the continuous extension.

    A header line is a pair (label, text). If the module uses no continuous extension, the tuple is empty.
    """
    extension = None if kernel.observed is None else kernel.observed.extension
    if extension is None:
        return ()
    text = f"continuous extension of the tableau: order {extension.order}"
    return (("output", f"{text}, polynomial weights of degree {extension.degree}"),)


def _storage_facts(compiled: Compiled) -> tuple[tuple[str, str], ...]:
    """Return the header line about the memory of a step, if the method has a low-storage scheme."""
    text = lowering(compiled.method.family).storage(compiled.method)
    if text and compiled.kernel.sites is not None:
        text = f"{text}; each site of the lattice stores two additional states"
    return (("storage", text),) if text else ()


def coordinates_of(compiled: Compiled) -> Sequence[tuple[str, str]]:
    """Return the header line about the coordinate map of the scene.

    There is no such line if the method does not use the coordinate map.
    """
    used = compiled.scene.coordinates if lowering(compiled.method.family).reads_coordinates else None
    if used is None:
        return ()
    unread = f"; the cut-off {compiled.method.cutoff} has no effect, because no series is truncated"
    return (("coordinates", used.text + unread * (compiled.method.cutoff is not None)),)


def scene_facts(compiled: Compiled) -> tuple[tuple[str, str], ...]:
    """Return the header lines about the scene and about the form of its equations."""
    form = compiled.form
    chosen = features(compiled.scene.roots)
    smooth = (("smooth", f"no: {chosen}; {NOT_SMOOTH}"),) if chosen else ()
    if form is None:
        return (("scene", f"{compiled.scene.title}, group {compiled.scene.group.name}"), *smooth)
    return (
        *smooth,
        ("scene", f"{form.scene.title}, group {form.scene.group.name}"),
        ("form", f"{form.name}; {form.state}"),
        *((("to scene", form.conversion),) if form.conversion else ()),
    )


def site_facts(compiled: Compiled) -> tuple[tuple[str, str], ...]:
    """Return the header lines about the sites of a lattice, and about the loops and the memory of a step."""
    step, sites = compiled.kernel.sites, compiled.scene.sites
    if step is None or sites is None:
        return ()
    *_, workspace, traffic = step.explanation()
    loops = f"a step has {len(step.sweeps)} loops over all sites; {workspace}; {traffic}"
    return (("sites", sites.text()), ("loops", loops))


def _mode_facts(compiled: Compiled) -> tuple[tuple[str, str], ...]:
    """Return the header line about the linear operator, if the equation is semilinear."""
    semilinear = compiled.scene.semilinear
    return () if semilinear is None else (("operator", semilinear.text()),)


def steps_of(kernel: Kernel) -> str:
    """Return the text of the header line that says how a run chooses its step sizes."""
    if kernel.expansion is not None:
        last = kernel.expansion.degree
        return (
            f"h is constant, or given by the solution's Taylor coefficients of degrees {last - 1} and {last}"
        )
    assert kernel.estimate is not None
    return (
        f"h is constant, or set by a proportional-integral controller; "
        f"the embedded method's error estimate is O(h^{kernel.estimate.order})"
    )


def substeps_of(kernel: Kernel) -> str:
    """Return the text of the header line about the substeps of a step."""
    each = ", ".join(f"{float(step.fraction):.6g} h" for step in kernel.substeps)
    return f"{len(kernel.substeps)} calls of one function with the step sizes {each}"


def left_out(compiled: Compiled) -> tuple[str, ...]:
    """Return the entries of the header line ``left out``.

    An entry says which operation or argument the module does not need, and why.
    """
    kernel, scene = compiled.kernel, compiled.scene
    lines = [*summaries(compiled.trace)]
    folded = [f"{name} = {x.text()}" for name, x in scene.parameters.items() if name not in scene.runtime]
    if folded:
        lines.append(f"arguments for constant parameters: {', '.join(folded)}")
    closed = [name for name in scene.signals if name not in scene.inputs]
    if closed:
        lines.append(f"inputs for {', '.join(closed)} are not needed: the scene contains their formulas")
    if TIME not in kernel.used_scalars():
        lines.append("the time is not needed: no formula depends on the time")
    if not any(isinstance(s, Loop) for s in kernel.body):
        lines.append("a solver for implicit equations: all stages are explicit")
    return tuple(lines)


def flows_of(problem: Problem) -> str:
    """Return the text of the header line about the exact flows that a splitting method composes."""
    return "; ".join(f"{name}, {flow.text()}" for name, flow in problem.flows.items())
