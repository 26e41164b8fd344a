"""Compile a method for a scene, and emit a module.

:func:`compile_method` translates the method and the scene to a kernel. :func:`emit_compiled` prints the
kernel in the target language. The same scene, method and options always give the same module.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Unpack

from codegen import scenes
from codegen.artifact import Artifact, digest
from codegen.certify import CertifiedOrder, certified_order
from codegen.command_names import bare, quoted
from codegen.error_estimate import order_of_estimate
from codegen.errors import MethodError
from codegen.header_facts import recipe_of
from codegen.ir.kernel import SIMPLIFIED_NEWTON, Kernel
from codegen.ir.precision import DOUBLE
from codegen.ir.precision import precision as known_precision
from codegen.ir.program import Program
from codegen.kernel.array_kernel import array_method
from codegen.kernel.column_choice import fastest
from codegen.kernel.compensation import compensated as add_carries
from codegen.kernel.large_linear_kernel import large_linear_method
from codegen.kernel.mode_kernel import mode_method
from codegen.kernel.operations import STEP, step_operations
from codegen.kernel.site_kernel import site_method
from codegen.kernel.taylor_expansion import looped_kernel, with_step_control
from codegen.kernel.translate import to_kernel
from codegen.kernel.variations import Variations
from codegen.lower import lower, lower_composed, lowering, method_for, problem_for
from codegen.method import Method
from codegen.passes import Optimiser, PassReport, optimise
from codegen.prefix import default_prefix, prefix_of
from codegen.printers import DEFAULT
from codegen.printers import names as target_names
from codegen.printers import target as known_target
from codegen.printers.interface import Interface
from codegen.printers.recipe import Recipe
from codegen.run.site_choice import site_choices
from codegen.run.solver_choice import AUTO, Choice, known_solver, solved
from codegen.run_options import RunOptions, RunRequest, observed_run, refuse_with_carries
from codegen.scene.classical_forms import PRINTED, ClassicalForm, find_form
from codegen.scene.momentum_frame import start_of, with_frame
from codegen.scene.problem import Problem
from codegen.scene.run_time import with_inputs, with_runtime
from orderconds.argument import named_as_arguments, text, texts
from orderconds.errors import InputError
from orderconds.tableau import Tableau

SWEEPS = 5
WEIGHTS = {"div": 4, "sqrt": 5, "choose": 1, "fabs": 1}
"""The costs of operations. Additions and products cost 1, and functions that are not listed cost 12."""


@dataclass(frozen=True)
class Optimised:
    """The optimised step program of a method on a scene.

    - ``problem`` is ``scene``, rewritten for the family of the method.
    - ``lowered`` is the step program before the first compiler pass.
    - ``program`` is the step program after the last pass.
    - ``trace`` contains a report of each pass.
    """

    scene: Problem
    method: Method
    problem: Problem
    lowered: Program
    program: Program
    trace: tuple[PassReport, ...]


@dataclass(frozen=True)
class Compiled(Optimised):
    """The optimised step program of a method on a scene, and the kernel of this program.

    - ``solvers`` are the solvers of the implicit equations.
    - ``asked`` is the value of the option ``--solver``.
    - ``form`` contains the equations on R^n that the user chose with the option ``--form``. If the step uses
      the equations of the scene, ``form`` is None.
    """

    kernel: Kernel
    solvers: tuple[Choice, ...] = ()
    asked: str = AUTO
    form: ClassicalForm | None = None
    compensated: bool = False
    """True if the step uses compensated summation."""


def optimise_method(scene: Problem, method: Method) -> Optimised:
    """Return the optimised step program of a method on a scene, without a kernel.

    Unlike a kernel, the step program does not need closed forms for the operations of the group.
    """
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
    **run: Unpack[RunOptions],
) -> Compiled:
    """Compile a method on a scene. Invalid arguments raise a subclass of InputError.

    - ``scene``: a problem or its name. ``method``: a method, its name, or a tableau.
    - ``family``: the family of the tableau. ``form``: ``printed`` or another form, such as ``quaternion``.
    - ``parameters``: ``alpha`` for a run-time argument, or ``alpha=1/2`` for a constant. Parameters that are
      not listed are constants.
    - ``inputs``: the names of the signals that become run-time inputs.
    - ``frame``: the frame of momenta, ``space`` or ``body``. ``solver``: the solver of implicit equations.
    - ``adaptive``: add the error estimate of an embedded method.
    - ``jacobian``: add the derivative of a step.
    - ``integrate``: add a run to a given end time, with states at given output times.
    - ``events``: the number of event functions that the run to the end time evaluates.
    - ``dense``: compute the states at output times with the continuous extension of the tableau.
    - ``compensate``: use compensated summation. The state then contains correction terms.
    """
    request = RunRequest(**run)
    scene = _with_arguments(scenes.problem_of(scene), parameters, inputs)
    chosen = find_form(scene, form) if form != PRINTED else None
    scene = with_frame(scene if chosen is None else chosen.problem, frame)
    method = method_for(scene, method, family)
    if adaptive:
        method = replace(method, adaptive=True)
    if scene.sites is not None or scene.semilinear is not None:
        return _of_fields(scene, method, known_solver(solver), jacobian, request)
    problem = problem_for(scene, method)
    if scene.matrices is not None and not lowering(method.family).in_coordinates:
        return _with_arrays(scene, method, jacobian, request)
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
    best = _with_run(best, degree, jacobian, request)
    if degree and method.adaptive:
        return replace(best, kernel=with_step_control(best.kernel, problem, degree))
    estimate = best.kernel.estimate
    if estimate is None:
        return best
    return replace(best, kernel=replace(best.kernel, estimate=replace(estimate, order=estimated)))


def _with_arguments(scene: Problem, parameters: Sequence[str], inputs: Sequence[str]) -> Problem:
    parameters = texts(parameters, "parameters", "alpha=1/2")
    inputs = texts(inputs, "inputs", "u")
    scene = with_runtime(scene, tuple(parameters)) if parameters else scene
    return with_inputs(scene, tuple(inputs)) if inputs else scene


def _with_run(compiled: Compiled, degree: int, jacobian: bool, request: RunRequest) -> Compiled:
    """Return the compiled method with the requested features.

    For a Taylor method, ``degree`` is the degree of the Taylor polynomial. Otherwise ``degree`` is 0.
    """
    method = compiled.method
    if request.compensate:
        others = {"jacobian": jacobian, "adaptive": method.adaptive, "dense": request.dense}
        refuse_with_carries(method, others)
        compiled = compensated(compiled)
    if jacobian:
        problem = compiled.problem
        vary = to_kernel(compiled.program, problem, variations=Variations.of(problem))
        compiled = replace(compiled, kernel=replace(compiled.kernel, vary=vary))
    if request.observed:
        observed = observed_run(method, compiled.scene, degree, request.events, request.dense)
        compiled = replace(compiled, kernel=replace(compiled.kernel, observed=observed))
    return compiled


def compensated(compiled: Compiled) -> Compiled:
    """Return a compiled method with compensated summation.

    MethodError is raised if the step does not have the form y + increment.
    """
    kernel = add_carries(compiled.kernel, compiled.program, compiled.problem)
    return replace(compiled, kernel=kernel, compensated=True)


def with_batch(compiled: Compiled) -> Compiled:
    """Return a compiled method whose module can also step many independent systems.

    MethodError is raised for a semilinear equation.
    """
    kernel = compiled.kernel
    if kernel.modes is not None:
        raise MethodError(
            "--batch is not available on a semilinear equation",
            where=compiled.scene.name,
            expected="a run of one system",
        )
    changed = kernel.deferred or kernel.expansion or kernel.carried or compiled.compensated
    if kernel.outlined and not kernel.loops and not changed:
        # C compilers do not vectorise a loop that contains function calls.
        plain, own = to_kernel(compiled.program, compiled.problem, outlining=False), kernel.estimate
        estimate = own and replace(own, errors=plain.estimate.errors if plain.estimate else ())
        kernel = replace(kernel, body=plain.body, outputs=plain.outputs, outlined=(), estimate=estimate)
    return replace(compiled, kernel=replace(kernel, batch=True))


def _with_arrays(scene: Problem, method: Method, jacobian: bool, request: RunRequest) -> Compiled:
    """Return a compiled method on a scene whose formulas contain large matrices.

    MethodError is raised if a requested option is not available on such a scene.
    """
    options = {
        "--jacobian": jacobian,
        "--compensate": request.compensate,
        "--dense": request.dense,
        "--events": request.events > 0,
        "--integrate": request.integrate,
    }
    given = next((option for option, is_given in options.items() if is_given), None)
    if given is not None:
        raise MethodError(
            f"{given} is not available for {method.label} on a scene whose formulas contain large matrices",
            where=scene.name,
            expected="a scene with formulas in coordinates, such as FieldScene or LinearScene",
            hint=f"leave out {given}",
        )
    own = large_linear_method(scene, method) if scene.linear else array_method(scene, method)
    kernel = own.kernel
    if kernel.estimate is not None:
        order = order_of_estimate(method, scene)
        kernel = replace(kernel, estimate=replace(kernel.estimate, order=order))
    return Compiled(scene, method, scene, own.lowered, own.program, own.trace, kernel)


def _of_fields(scene: Problem, method: Method, solver: str, jacobian: bool, request: RunRequest) -> Compiled:
    """Return a compiled method on a chain, a lattice or a semilinear equation.

    MethodError is raised if a requested feature is not available on such a scene.
    """
    requests = {
        "an error estimate": method.adaptive,
        "a Jacobian": jacobian,
        "compensated summation": request.compensate,
        "a run to an end time": request.any,
    }
    refused = [what for what, wanted in requests.items() if wanted]
    if refused:
        kind = "a chain or lattice" if scene.semilinear is None else "a semilinear equation"
        what = f"{refused[0]} is not available on {kind}"
        raise MethodError(what, where=scene.name, expected=f"a module without {refused[0]}")
    if scene.semilinear is not None:
        # Without ``coordinates``, dexp^{-1} is computed by its truncated series, not by a closed form.
        scene = scene if method.cutoff is None else replace(scene, coordinates=None)
        modes = mode_method(scene, method)
        return Compiled(scene, method, modes.problem, modes.lowered, modes.program, modes.trace, modes.kernel)
    own = site_method(scene, method, solver == SIMPLIFIED_NEWTON)
    choices = site_choices(own.kernel, solver, scene.name)
    parts = (own.problem, own.lowered, own.program, own.trace, own.kernel)
    return Compiled(scene, method, *parts, solvers=choices, asked=solver)


def work(kernel: Kernel) -> int:
    """Return an estimate of the cost of a step, in the unit of :data:`WEIGHTS`.

    The estimate assumes :data:`SWEEPS` iterations for each implicit equation.
    """
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
    **run: Unpack[RunOptions],
) -> Artifact:
    """Return the integrator of a method on a scene as a module in a target language.

    - ``scene``: the name of a built-in scene, the path of a Python file, or a problem.
    - ``method``: ``FAMILY:TABLEAU``, ``TABLEAU``, or an object of :class:`orderconds.Tableau`.
    - ``family``: the family of a tableau, by default the family in which the order of the tableau is highest.
    - ``prefix``: the beginning of external names, by default the names of the scene and the method.
    - ``precision``: ``double`` or ``single``. ``frame``: the frame of momenta, ``space`` or ``body``.
    - ``solver``: the solver of implicit equations: ``newton``, ``simplified-newton``, ``fixed-point`` or
      ``auto``. With ``auto``, the compiler selects the solver.
    - ``form``: the form of the equations, by default ``printed`` (as in the scene), or, e.g., ``quaternion``.
    - ``adaptive``: add step-size control.
    - ``batch``: add a C function for many systems (:meth:`codegen.integrator.Integrator.run_batch`).
    - ``integrate``: the module also contains a function that integrates to a given end time.
    - ``compensate``: use compensated summation. The state then contains correction terms, initially zero.

    :func:`compile_method` describes the other arguments and most errors. UnknownName is raised for an unknown
    target, and InputError for a prefix that is not a valid name in C.
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
            **run,
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
    """Return a compiled method as a module in a target language.

    The header of the module shows the shell command that emits the module. In this command,
    ``named["scene"]`` is the name of the scene, and ``named["method"]`` is the name of the method.
    ``order`` is the result of :func:`certified_order`.
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
    """Return the options of the command that emits ``compiled``. The option ``--prefix`` is omitted."""
    scene = compiled.scene
    options = ["--frame body"] if scene.body_group is not None else []
    options += [f"--form {compiled.form.key}"] if compiled.form is not None else []
    options += ["--adaptive"] if compiled.method.adaptive else []
    options += ["--batch"] if compiled.kernel.batch else []
    options += ["--jacobian"] if compiled.kernel.vary is not None else []
    observed = compiled.kernel.observed
    options += ["--integrate"] if observed is not None and not observed.events else []
    options += ["--dense"] if observed is not None and observed.extension is not None else []
    options += [f"--events {observed.events}"] if observed is not None and observed.events else []
    options += ["--compensate"] if compiled.compensated else []
    options += [f"--precision {precision}"] if precision != DOUBLE.name else []
    options += [f"--solver {compiled.asked}"] if compiled.asked != AUTO else []
    options += [f"--parameter {p}" for p in scene.runtime]
    # For a run-time argument p, ``--parameter p=value`` sets the default value.
    options += [f"--parameter {p}={value}" for p, value in scene.fixed]
    return [*options, *(f"--input {name}" for name in scene.inputs)]


def emit_kernel(
    kernel: Kernel,
    recipe: Recipe,
    target: str,
    prefix: str,
    about: Mapping[str, Any] | None = None,
    precision: str = DOUBLE.name,
) -> Artifact:
    """Return a module for a kernel in a target language. ``about`` is added to the manifest of the module.

    UnknownName is raised for an unknown target. InputError is raised if the target or the precision is not
    available for this kernel.
    """
    interface = Interface.of(kernel, prefix, precision)
    if kernel.batch and not known_target(target).batches:
        able = next(name for name in target_names() if known_target(name).batches)
        raise InputError(
            f"the target {target} has no code for batches",
            where="--batch",
            expected="a target with code for batches",
            hint=f"add --target {able}",
        )
    if kernel.sites is not None and not known_target(target).lattice_loader:
        able = next(name for name in target_names() if known_target(name).lattice_loader)
        raise InputError(
            f"the target {target} has no code for chains and lattices",
            where=interface.module,
            expected="a target with code for chains and lattices",
            hint=f"add --target {able}",
        )
    if kernel.modes is not None and not known_target(target).spectral_loader:
        able = next(name for name in target_names() if known_target(name).spectral_loader)
        raise InputError(
            f"the target {target} has no code for semilinear equations",
            where=interface.module,
            expected="a target with code for semilinear equations",
            hint=f"add --target {able}",
        )
    if kernel.modes is not None and interface.format is not DOUBLE:
        raise InputError(
            f"{interface.format.name} precision is not available on a semilinear equation",
            where=interface.module,
            expected=f"{DOUBLE.name} precision",
            hint="leave out --precision",
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
