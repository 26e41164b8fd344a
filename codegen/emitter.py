"""From scene and method, or from a kernel, to emitted files and a manifest entry.

:func:`compile_method` runs the whole compiler: lowering, passes, kernel. Emitted files depend on scene,
method and options only, so the same arguments give the same bytes.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any

from codegen import scenes
from codegen.artifact import Artifact, digest
from codegen.certify import CertifiedOrder, certified_order, rounding_of_digits
from codegen.error_estimate import order_of_estimate
from codegen.errors import MethodError
from codegen.ir.domain import FloatDomain
from codegen.ir.kernel import Kernel, Loop
from codegen.ir.precision import DOUBLE, Precision
from codegen.ir.precision import precision as known_precision
from codegen.ir.program import Program
from codegen.ir.smoothness import features
from codegen.kernel.array_kernel import array_method
from codegen.kernel.column_choice import fastest
from codegen.kernel.operations import STEP, step_operations
from codegen.kernel.taylor_expansion import looped_kernel, with_step_control
from codegen.kernel.translate import to_kernel
from codegen.kernel.variations import Variations
from codegen.lower import lower, lower_composed, lowering, method_for, problem_for
from codegen.method import Method
from codegen.passes import Optimiser, PassReport, optimise, summaries
from codegen.prefix import default_prefix, prefix_of
from codegen.printers import DEFAULT
from codegen.printers import names as target_names
from codegen.printers import target as known_target
from codegen.printers.interface import Interface
from codegen.printers.recipe import Recipe
from codegen.run.solver_choice import AUTO, Choice, known_solver, solved
from codegen.run.trial import PARTS
from codegen.scene.classical_forms import PRINTED, ClassicalForm, find_form
from codegen.scene.momentum_frame import with_frame
from codegen.scene.problem import TIME, Problem
from codegen.scene.run_time import with_inputs, with_runtime
from orderconds import __version__
from orderconds.argument import named_as_arguments, text, texts
from orderconds.errors import InputError
from orderconds.tableau import Tableau

SINGLE_IS = "single: constants are rounded once, implicit stages converge to single precision"

NOT_SMOOTH = "the order holds for steps in which the solution crosses none of these points"
"""A remark in the header of emitted code, for a scene whose field is not smooth."""

COUNTED = "; the numbers of sweeps above are for double precision"
"""A remark in the header if the solvers were compared in double precision."""

SWEEPS = 5
WEIGHTS = {"div": 4, "sqrt": 5, "choose": 1, "fabs": 1}
"""The cost of operations in units of an addition; two forms of a step are compared by these costs. Additions
and products cost 1, and functions that are not listed cost 12."""


@dataclass(frozen=True)
class Optimised:
    """A method on a scene, ready to be interpreted: the program before and after each pass.

    ``problem`` is the scene in the form that the method's family requires.
    """

    scene: Problem
    method: Method
    problem: Problem
    lowered: Program
    program: Program
    trace: tuple[PassReport, ...]


@dataclass(frozen=True)
class Compiled(Optimised):
    """A method on a scene, ready to be printed: the optimised program with its kernel.

    ``solvers`` are the solvers of the implicit blocks; ``asked`` is the value of the option ``--solver``.
    ``form`` is the classical form whose equations ``scene`` contains. None means that ``scene`` contains its
    own equations.
    """

    kernel: Kernel
    solvers: tuple[Choice, ...] = ()
    asked: str = AUTO
    form: ClassicalForm | None = None


def optimise_method(scene: Problem, method: Method) -> Optimised:
    """Return the optimised step program of a method on a scene. The group need not have closed forms of
    its operations, because no kernel is built."""
    scene.require_formulas()
    problem, lowered = problem_for(scene, method), lower(scene, method)
    program, trace = optimise(lowered, problem, composed=lower_composed(scene, method))
    return Optimised(scene, method, problem, lowered, program, trace)


def compile_method(
    scene: Problem | str,
    method: Method | Tableau | str,
    parameters: Sequence[str] = (),
    inputs: Sequence[str] = (),
    frame: str = "space",
    adaptive: bool = False,
    *,
    solver: str = AUTO,
    jacobian: bool = False,
    form: str = PRINTED,
    family: str = "",
) -> Compiled:
    """Return a method on a scene (or their names), lowered, optimised and translated to a kernel.

    ``parameters`` stay run-time arguments, or become constants with a given value (``alpha=1/2``). All other
    parameters become constants with the scene's values. ``inputs`` are signals that become run-time inputs.
    ``frame`` is the frame of momenta (:func:`codegen.scene.momentum_frame.with_frame`). ``solver`` is the
    solver of implicit blocks (:mod:`codegen.run.solver_choice`). ``adaptive`` adds the error estimate of an
    embedded method, ``jacobian`` the derivative of a step. ``form`` is the key of a classical form of the
    scene (:mod:`codegen.scene.classical_forms`). ``family`` chooses the family for a tableau
    (:func:`codegen.method.method_of`). Errors: SceneError, MethodError, UnknownName, TableauError.
    """
    scene = scenes.problem_of(scene)
    parameters = texts(parameters, "parameters", "alpha=1/2")
    inputs = texts(inputs, "inputs", "u")
    if parameters:
        scene = with_runtime(scene, tuple(parameters))
    if inputs:
        scene = with_inputs(scene, tuple(inputs))
    chosen = find_form(scene, form) if form != PRINTED else None
    scene = with_frame(scene if chosen is None else chosen.problem, frame)
    method = method_for(scene, method, family)
    if adaptive:
        method = replace(method, adaptive=True)
    problem = problem_for(scene, method)
    if scene.matrices is not None and not lowering(method.family).in_coordinates:
        return _with_arrays(scene, method, jacobian)
    lowered = lower(scene, method)
    passes = Optimiser(lowered, problem, lower_composed(scene, method))
    candidates, degree = [], lowering(method.family).degree(method)
    estimated = order_of_estimate(method, scene) if method.adaptive and not degree else 0
    for program, trace in (passes.plain(), *([passes.framed()] if problem.has_body else [])):
        looped = looped_kernel(program, problem, degree) if degree else None
        kernel = looped or fastest(program, problem)
        candidates.append(Compiled(scene, method, problem, lowered, program, trace, kernel, form=chosen))
    best = min(candidates, key=lambda c: work(c.kernel))
    if known_solver(solver) and best.kernel.loops:
        kernel, choices = solved(best.program, problem, start_of(scene), solver, best.kernel)
        best = replace(best, kernel=kernel, solvers=choices, asked=solver)
    if jacobian:
        vary = to_kernel(best.program, problem, variations=Variations.of(problem))
        best = replace(best, kernel=replace(best.kernel, vary=vary))
    if degree and method.adaptive:
        return replace(best, kernel=with_step_control(best.kernel, problem, degree))
    estimate = best.kernel.estimate
    if estimate is None:
        return best
    return replace(best, kernel=replace(best.kernel, estimate=replace(estimate, order=estimated)))


def with_batch(compiled: Compiled) -> Compiled:
    """Return a compiled method whose module also has a function that steps many independent systems."""
    return replace(compiled, kernel=replace(compiled.kernel, batch=True))


def _with_arrays(scene: Problem, method: Method, jacobian: bool) -> Compiled:
    """Return a method on a scene whose field is given by formulas of matrices."""
    if jacobian:
        what = "the derivative of a step for a scene with large matrices"
        raise MethodError(what, where=scene.name, expected="a scene with formulas in coordinates")
    own = array_method(scene, method)
    kernel = own.kernel
    if kernel.estimate is not None:
        order = order_of_estimate(method, scene)
        kernel = replace(kernel, estimate=replace(kernel.estimate, order=order))
    return Compiled(scene, method, scene, own.lowered, own.program, own.trace, kernel)


def work(kernel: Kernel) -> int:
    """Estimate the cost of a step in units of one addition. The operations of each block are counted SWEEPS
    times, all other operations once."""
    total, sweeps = 0, SWEEPS * max(1, len(kernel.substeps))
    for key, counts in step_operations(kernel).items():
        cost = sum(n * WEIGHTS.get(name, 1 if name in ("add", "mul") else 12) for name, n in counts.items())
        total += cost * (1 if key == STEP else sweeps)
    return total


def emit(
    scene: Problem | str,
    method: Method | Tableau | str,
    target: str = DEFAULT,
    *,
    prefix: str = "",
    parameters: Sequence[str] = (),
    precision: str = DOUBLE.name,
    inputs: Sequence[str] = (),
    frame: str = "space",
    adaptive: bool = False,
    solver: str = AUTO,
    jacobian: bool = False,
    form: str = PRINTED,
    family: str = "",
    batch: bool = False,
) -> Artifact:
    """Return the integrator of a method on a scene as a module of a target.

    ``scene`` is a name of the gallery, the path of a Python file, or a problem. ``method`` is
    ``FAMILY:TABLEAU`` or ``TABLEAU``, or an :class:`orderconds.Tableau`, which is used in ``family``, by
    default in the family in which its order is highest. External names begin with ``prefix``, by default
    scene and method. ``precision`` is ``double`` or ``single``. ``inputs`` are signals of the scene that
    become run-time inputs. ``frame`` is the frame of momenta, ``space`` or ``body``. ``adaptive`` adds a run
    with step control, ``jacobian`` the derivative of a step. ``solver`` is the solver of implicit blocks:
    ``newton``, ``simplified-newton``, ``fixed-point``, or ``auto`` for the cheapest. ``form`` is the key of a
    classical form of the scene, by default the equations as printed. ``batch`` adds a C function that steps
    many independent systems (:meth:`codegen.integrator.Integrator.run_batch`). Errors: the errors of
    :func:`compile_method`, UnknownName for an unknown target, and InputError for a prefix that is not a valid
    name in C.
    """
    known_target(target)
    known_precision(precision)
    text(prefix, "prefix", "a text")
    problem = scenes.problem_of(scene)
    with named_as_arguments():
        compiled = compile_method(
            problem,
            method,
            parameters,
            inputs,
            frame,
            adaptive,
            jacobian=jacobian,
            solver=solver,
            form=form,
            family=text(family, "family", "a family, such as rkmk(2)"),
        )
        compiled = with_batch(compiled) if batch else compiled
    named = {"scene": bare(scene) if isinstance(scene, str) else problem.name}
    whole = isinstance(method, str) and not family
    named["method"] = bare(str(method)) if whole else compiled.method.label
    with named_as_arguments():
        return emit_compiled(compiled, target, prefix, named, precision=precision)


def emit_compiled(
    compiled: Compiled,
    target: str,
    prefix: str = "",
    named: Mapping[str, str] | None = None,
    order: CertifiedOrder | None = None,
    *,
    precision: str = DOUBLE.name,
) -> Artifact:
    """Return a compiled method as a module of a target.

    ``named`` contains the names of scene and method in the header's command. ``order`` is the result
    of :func:`certified_order`, if the caller has computed it already.
    """
    scene, method = compiled.scene, compiled.method
    own = scene if compiled.form is None else compiled.form.scene
    named = named or {"scene": own.name, "method": method.label}
    body = scene.body_group is not None
    single = known_precision(precision) is not DOUBLE
    chosen = (
        prefix_of(prefix) if prefix else default_prefix(scene, method) + "body_" * body + "single_" * single
    )
    order = order or certified_order(method, scene)
    options = [f"--prefix {chosen}"] if prefix else []
    words = ["orderconds emit", quoted(named["scene"]), "--method", quoted(named["method"])]
    words += ["--target", target, *options, *options_of(compiled, precision), "-o", "."]
    recipe = recipe_of(compiled, order, " ".join(words), known_precision(precision))
    about = {
        "scene": own.name,
        **({} if compiled.form is None else {"form": compiled.form.key}),
        "method": method.label,
        "family": method.family_label,
        "tableau": method.name,
        "source": method.source,
        "order": order.order,
        "certificate": order.certificate,
        "initial": list(recipe.initial),
        "span": [float(t) for t in scene.span],
        "left_out": list(recipe.left_out),
        "solvers": [choice.as_json() for choice in compiled.solvers],
    }
    return emit_kernel(compiled.kernel, recipe, target, chosen, about, precision)


def options_of(compiled: Compiled, precision: str) -> list[str]:
    """Return the options of the command that regenerates a module, except the prefix."""
    scene = compiled.scene
    options = ["--frame body"] if scene.body_group is not None else []
    options += [f"--form {compiled.form.key}"] if compiled.form is not None else []
    options += ["--adaptive"] if compiled.method.adaptive else []
    options += ["--batch"] if compiled.kernel.batch else []
    options += ["--jacobian"] if compiled.kernel.vary is not None else []
    options += [f"--precision {precision}"] if precision != DOUBLE.name else []
    options += [f"--solver {compiled.asked}"] if compiled.asked != AUTO else []
    options += [f"--parameter {p}" for p in scene.runtime]
    # If a parameter with a given value remains a run-time argument, the value is the argument's default.
    options += [f"--parameter {p}={value}" for p, value in scene.fixed]
    return [*options, *(f"--input {name}" for name in scene.inputs)]


def recipe_of(compiled: Compiled, order: CertifiedOrder, command: str, target: Precision) -> Recipe:
    """Return the content of the header of a module."""
    scene, method = compiled.scene, compiled.method
    first, last = scene.span
    single = target is not DOUBLE
    # A method without a tableau has no coefficients that could be rounded.
    tableau = method.coefficients is not None
    digits = (("digits", rounding_of_digits(method, order, target, scene)),) if tableau else ()
    return Recipe(
        title=f"{scene.title}: one step by {method.label}",
        facts=(
            ("method", f"family {method.family_label}" + f", tableau {method.name}" * bool(method.name)),
            ("source", method.source),
            *coordinates_of(compiled),
            ("order", order.text()),
            *digits,
            *scene_facts(compiled),
            *((("flows", flows_of(compiled.problem)),) if compiled.problem.flows else ()),
            *((("substeps", substeps_of(compiled.kernel)),) if compiled.kernel.substeps else ()),
            *(("solved by", choice.text()) for choice in compiled.solvers),
            *((("precision", SINGLE_IS + COUNTED * bool(compiled.solvers)),) if single else ()),
            *((("steps", steps_of(compiled.kernel)),) if method.adaptive else ()),
        ),
        initial=start_of(scene),
        h=float((last - first) / PARTS),
        steps=PARTS,
        defaults={p: float(scene.parameters[p]) for p in scene.runtime},
        left_out=left_out(compiled),
        command=command,
        version=__version__,
    )


def coordinates_of(compiled: Compiled) -> Sequence[tuple[str, str]]:
    """Return the sentence about the coordinate map of the scene, if the method uses the map."""
    used = compiled.scene.coordinates if lowering(compiled.method.family).reads_coordinates else None
    if used is None:
        return ()
    unread = f"; the cut-off {compiled.method.cutoff} is not read, because nothing is truncated"
    return (("coordinates", used.text + unread * (compiled.method.cutoff is not None)),)


def emit_kernel(
    kernel: Kernel,
    recipe: Recipe,
    target: str,
    prefix: str,
    about: Mapping[str, Any] | None = None,
    precision: str = DOUBLE.name,
) -> Artifact:
    """Return a kernel as a module of a target; ``about`` is added to the manifest entry.

    Every external C name and every file name begins with the prefix. UnknownName is raised for an unknown
    target.
    """
    interface = Interface.of(kernel, prefix, precision)
    if kernel.batch and not known_target(target).batches:
        able = next(name for name in target_names() if known_target(name).batches)
        raise InputError(
            f"the target {target}",
            where="--batch",
            expected="a target with batches",
            hint=f"add --target {able}",
        )
    files = known_target(target).print_module(kernel, interface, recipe)
    manifest = {
        **(about or {}),
        "module": interface.module,
        "target": target,
        "interface": interface.as_json(),
        "defaults": {p: float(recipe.defaults[p]) for p in interface.parameters if p in recipe.defaults},
        "files": {name: digest(text) for name, text in files.items()},
        "operations": step_operations(kernel),
        "state": [{"name": f.name, "symbols": list(f.symbols), "meaning": f.meaning} for f in kernel.state],
        "command": recipe.command,
        "version": recipe.version,
    }
    return Artifact(files, manifest)


def scene_facts(compiled: Compiled) -> tuple[tuple[str, str], ...]:
    """Return the lines of the header about the scene, and about the form of its equations."""
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


def steps_of(kernel: Kernel) -> str:
    """Describe the step control of a run."""
    if kernel.expansion is not None:
        last = kernel.expansion.degree
        return f"constant, or chosen from the Taylor coefficients {last - 1} and {last} of each step"
    assert kernel.estimate is not None
    return (
        f"constant, or chosen by a proportional-integral controller with an error estimate "
        f"of order O(h^{kernel.estimate.order}) by the embedded method"
    )


def substeps_of(kernel: Kernel) -> str:
    """Describe the substeps of a step."""
    each = ", ".join(f"{float(step.fraction):.6g}" for step in kernel.substeps)
    return f"{len(kernel.substeps)} calls of one function, with step sizes {each} times h"


def start_of(scene: Problem) -> tuple[float, ...]:
    """Return the initial state in the format of emitted code."""
    domain = FloatDomain(0.0)
    state = tuple(float(x) for x in scene.initial(domain))
    if scene.body_group is None:
        return state
    q, mu = state[: scene.body_group.size], state[scene.body_group.size :]
    return (*q, *scene.body_group.Adt(domain, q, mu))


def left_out(compiled: Compiled) -> tuple[str, ...]:
    """Return a line for each simplification that this scene and method allow."""
    kernel, scene = compiled.kernel, compiled.scene
    lines = [*summaries(compiled.trace)]
    folded = [f"{name} = {x.text()}" for name, x in scene.parameters.items() if name not in scene.runtime]
    if folded:
        lines.append(f"arguments for parameters, which are constants: {', '.join(folded)}")
    closed = [name for name in scene.signals if name not in scene.inputs]
    if closed:
        lines.append(f"run-time inputs: {', '.join(closed)} computed by formula")
    if TIME not in kernel.used_scalars():
        lines.append("the time: the scene does not depend on it")
    if not any(isinstance(s, Loop) for s in kernel.body):
        lines.append("equation solving: every stage is explicit")
    return tuple(lines)


def flows_of(problem: Problem) -> str:
    """Describe the exact flows that a splitting composes."""
    return "; ".join(f"{name}, {flow.text()}" for name, flow in problem.flows.items())


def bare(name: str) -> str:
    """Return a name without folders, because emitted text must not contain a path of the machine.

    >>> bare("vcg:some/where/mine.toml"), bare("scenes/top.py")
    ('vcg:mine.toml', 'top.py')
    """
    name, bracket, values = name.partition("[")
    family, colon, rest = name.rpartition(":") if re.match(r"[a-z_]+(\(\d+\))?:", name) else ("", "", name)
    return f"{family}{colon}{PurePath(rest).name}{bracket}{values}"


def quoted(word: str) -> str:
    """Quote a word if a shell would otherwise interpret characters in it.

    >>> quoted("rkmk(2):rk4"), quoted("linear_oscillator+u")
    ("'rkmk(2):rk4'", 'linear_oscillator+u')
    """
    return shlex.quote(word)
