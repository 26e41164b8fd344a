"""``orderconds emit``: write a specialised integrator for a scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from codegen.commands.arguments import method_names, scene_argument, targets_option
from orderconds.commands import screen
from orderconds.commands.names import completing
from orderconds.commands.place import FOLDER

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Unpack

    from codegen.artifact import Artifact
    from codegen.emitter import Compiled
    from codegen.run_options import RunOptions


@click.command(name="emit", short_help="Write a specialised integrator for a scene.")
@scene_argument()
@click.option(
    "--method",
    "-m",
    required=True,
    shell_complete=completing(method_names, files=True),
    help="The method: TABLEAU or FAMILY:TABLEAU, such as cf4, vcg:triple_jump, 'rkmk(2):rk4'.",
)
@targets_option
@click.option("--output", "-o", type=FOLDER, metavar="DIR", help="The folder to write to.")
@click.option(
    "--prefix",
    help="Prefix of every external name in the emitted code. The default consists of the names of the scene "
    "and the method.",
)
@click.option(
    "--parameter",
    "-P",
    "parameters",
    multiple=True,
    help="A parameter of the scene. With NAME, the parameter becomes a run-time argument. With NAME=VALUE, "
    "the parameter becomes a constant. With both, VALUE is the default of the run-time argument.",
)
@click.option("--input", "inputs", multiple=True, help="Make this signal of the scene a run-time input.")
@click.option("--frame", default="space", help="Frame of momenta: space (the default) or body.")
@click.option(
    "--form",
    default="printed",
    help="Form of the equations: 'printed' (the equations of the scene), 'body-matrix' or 'quaternion'. The "
    "default is 'printed'. The header of the emitted file describes the form.",
)
@click.option(
    "--jacobian", is_flag=True, help="Also emit the derivative of a step with respect to the state."
)
@click.option(
    "--batch", is_flag=True, help="Also emit a C function that steps many copies of the system at once."
)
@click.option(
    "--adaptive",
    is_flag=True,
    help="Also emit a function with step-size control; the embedded method of the tableau estimates the "
    "error.",
)
@click.option(
    "--integrate",
    is_flag=True,
    help="Also emit a function that integrates to a given end time. The function accepts output times "
    "and bounds on the step size. A call can continue the run of an earlier call.",
)
@click.option(
    "--dense",
    is_flag=True,
    help="Compute the states at output times with the continuous extension of the tableau. By default, "
    "each state is computed by a separate step that ends at the output time. This option implies "
    "--integrate.",
)
@click.option(
    "--events",
    type=click.IntRange(0),
    default=0,
    metavar="N",
    help="The number of event functions, by default 0. A positive number implies --integrate: the function "
    "that integrates to a given end time also finds zeros of the event functions.",
)
@click.option(
    "--compensate",
    is_flag=True,
    help="Use compensated (Kahan) summation. The state stores the rounding error of each "
    "coordinate, and the next step corrects this error.",
)
@click.option(
    "--precision", default="double", help="Floating-point precision: double (the default) or single."
)
@click.option(
    "--solver",
    default="auto",
    help="Solver of implicit stages: newton, simplified-newton, fixed-point or auto. The default, auto, "
    "selects a fast and robust solver.",
)
@click.option(
    "--explain",
    is_flag=True,
    help="Print the operations of a step after each compiler pass, and the number of removed operations. "
    "For a lattice, also measure the memory bandwidth of a step.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record for each module.")
def command(
    scene: str,
    method: str,
    targets: tuple[str, ...],
    output: str | None,
    prefix: str | None,
    parameters: tuple[str, ...],
    inputs: tuple[str, ...],
    frame: str,
    form: str,
    jacobian: bool,
    batch: bool,
    adaptive: bool,
    precision: str,
    solver: str,
    explain: bool,
    as_json: bool,
    **run: Unpack[RunOptions],
) -> int:
    """Write an integrator specialised to SCENE. SCENE is the name of a scene in the gallery, or the path of
    a Python file.

    For an implicit method, --solver auto tests solvers of the implicit equations. If no solver converges, the
    command prints a warning.

    At least one of -o, --explain and --json is required. Without -o, the command writes no file
    and only prints the output of --explain or --json.

    \b
    Examples:
        orderconds emit free_rigid_body --method cf4 -o out
        orderconds emit dipole -m vcg:midpoint -t c -t python -o out
        orderconds emit driven_spin -m ambient:dop853 --adaptive --parameter nu -o out
    """
    from codegen.command_names import bare
    from codegen.emitter import compile_method, emit_compiled, with_batch
    from codegen.printers import DEFAULT

    if output is None and not (explain or as_json):
        raise click.UsageError("-o DIR is missing; give -o DIR, --explain or --json")
    _require_known(targets, precision, prefix)
    options = {"solver": solver, "form": form}
    compiled = compile_method(
        scene, method, parameters, inputs, frame, adaptive, jacobian=jacobian, **options, **run
    )
    compiled = with_batch(compiled) if batch else compiled
    _warn(compiled, scene, method)
    if chosen := family_note(compiled, method):
        click.echo(f"note: {chosen}", err=True)
    named = {"scene": bare(scene), "method": bare(method)}
    if explain and not as_json:
        click.echo(explanation(compiled))
    artifacts = [
        emit_compiled(compiled, t, prefix or "", named, precision=precision) for t in targets or (DEFAULT,)
    ]
    more = explained(compiled) if explain and as_json else {}
    if explain and compiled.kernel.sites is not None:
        more |= _bandwidth(compiled, artifacts[0], as_json)
    _write(artifacts, output, bool(chosen), as_json, more)
    return 0


def _bandwidth(compiled: Compiled, artifact: Artifact, as_json: bool) -> dict[str, object]:
    """Measure the memory bandwidth of a step on a lattice.

    If ``as_json`` is True, return the result as an entry for a JSON record. Otherwise print the result.
    """
    from codegen.lab.bandwidth import measure

    measured = measure(compiled, artifact)
    if as_json:
        return {"bandwidth": measured.as_json()}
    click.echo("# memory bandwidth\n" + "".join(f"  {line}\n" for line in measured.lines()))
    return {}


def _write(
    artifacts: Sequence[Artifact],
    output: str | None,
    family_chosen: bool,
    as_json: bool,
    more: Mapping[str, object],
) -> None:
    """Write the files of all modules to the folder ``output``. If ``output`` is None, no file is written.

    If ``as_json`` is True, print one JSON record for each module, with ``family_chosen`` and the entries of
    ``more``. Otherwise print the paths of the written files.
    """
    records: list[dict[str, object]] = []
    for artifact in artifacts:
        paths = [str(path) for path in artifact.write(output)] if output is not None else []
        records.append({**artifact.manifest, "family_chosen": family_chosen, "paths": paths, **more})
        if not as_json:
            for path in paths:
                click.echo(path)
    if as_json:
        screen.print_json(records)


def _require_known(targets: tuple[str, ...], precision: str, prefix: str | None) -> None:
    """Raise UnknownName for an unknown target or precision, and InputError for a prefix that is no name."""
    from codegen.ir.precision import precision as known_precision
    from codegen.prefix import prefix_of
    from codegen.printers import target as known_target

    for name in targets:
        known_target(name)
    known_precision(precision)
    if prefix is not None:
        prefix_of(prefix)


def explained(compiled: Compiled) -> dict[str, object]:
    """Return the data that ``--explain`` adds to the JSON record of a module.

    The data describe the compiler passes, the outlined functions and the compared solvers.
    """
    return {
        "passes": [
            {"name": r.name, "before": r.before, "after": r.after, "removed": r.removed}
            for r in compiled.trace
        ],
        "functions": functions_of(compiled),
        "compared": [list(choice.compared) for choice in compiled.solvers],
        "loops": [] if compiled.kernel.sites is None else compiled.kernel.sites.explanation(),
    }


def family_note(compiled: Compiled, method: str) -> str:
    """Return a note if the compiler has chosen the family of a method.

    If ``method`` names its family, or if the scene is not Hamiltonian, the result is ''.
    """
    from codegen.lower import families_for
    from codegen.method import PATTERN
    from orderconds.families import family_class

    match = PATTERN.fullmatch(method.strip())
    if not compiled.scene.is_hamiltonian or not compiled.method.name or match is None or match["family"]:
        return ""
    formats = compiled.method.tableau.family
    others = [
        family
        for family in families_for(compiled.scene)
        if family != compiled.method.family and formats in family_class(family).formats
    ]
    other = f"; an alternative is {others[0]}:{compiled.method.name}" if others else ""
    return f"{method.strip()} is given without a family; it is emitted as {compiled.method.label}{other}"


def _warn(compiled: Compiled, scene: str, method: str) -> None:
    """If no solver converges for a system of implicit equations, print a warning."""
    for choice in compiled.solvers:
        if not choice.converges:
            click.echo(f"warning: {scene}, {method}: {choice.text()}", err=True)


def explanation(compiled: Compiled) -> str:
    """Return the text that ``--explain`` prints.

    The text lists and counts the operations of a step after each compiler pass.
    """
    from codegen.header_facts import left_out
    from codegen.kernel.operations import sentences, step_operations

    parts = [f"# lowered: {counted(compiled.lowered.counts())}\n{compiled.lowered.text()}"]
    for report in compiled.trace:
        gone = counted({name: n for name, n in report.removed.items() if n > 0}) or "nothing"
        came = counted({name: -n for name, n in report.removed.items() if n < 0})
        added = f", added {came}" if came else ""
        parts.append(f"# {report.name}: removed {gone}{added}; remaining: {counted(report.after)}")
        parts.append(report.program.text())
    costs = sentences(step_operations(compiled.kernel))
    parts.append("# kernel\n" + "".join(f"  {line}\n" for line in costs))
    if compiled.kernel.sites is not None:
        parts.append(
            "# loops over sites\n" + "".join(f"  {x}\n" for x in compiled.kernel.sites.explanation())
        )
    if compiled.kernel.modes is not None:
        parts.append(
            "# on Fourier modes\n" + "".join(f"  {x}\n" for x in compiled.kernel.modes.explanation())
        )
    functions = functions_of(compiled)
    if functions:
        lines = [f"  {p['name']}, {p['calls']} calls: {p['about']}\n" for p in functions]
        parts.append("# outlined functions\n" + "".join(lines))
    if compiled.solvers:
        parts.append("# solved by\n" + "".join(f"  {line}\n" for line in solvers_of(compiled)))
    parts.append("# left out\n" + "".join(f"  {line}\n" for line in left_out(compiled)))
    return "\n".join(parts)


def solvers_of(compiled: Compiled) -> list[str]:
    """Return lines about the solvers of implicit equations.

    For each system of equations, the first line names the chosen solver. Each following line describes one
    solver that was considered.
    """
    return [
        line for choice in compiled.solvers for line in (choice.text(), *map("  {}".format, choice.compared))
    ]


def functions_of(compiled: Compiled) -> list[dict[str, object]]:
    """For each outlined function, return its name, the number of its calls and a description.

    An outlined function replaces a group of operations that occurs several times in a step.
    """
    from codegen.kernel.outlined_functions import calls

    often = calls(compiled.kernel)
    return [{"name": p.name, "calls": often[p.name], "about": p.about} for p in compiled.kernel.outlined]


def counted(counts: dict[str, int]) -> str:
    """Return operation counts as a text, such as ``3 add, 2 mul``."""
    return ", ".join(f"{n} {name}" for name, n in counts.items())
