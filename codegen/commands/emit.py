"""``orderconds emit``: write a specialised integrator for a scene."""

from __future__ import annotations

from typing import Any

import click

from orderconds.commands import screen
from orderconds.commands.place import FOLDER


@click.command(name="emit", short_help="Write a specialised integrator for a scene.")
@click.argument("scene", metavar="SCENE")
@click.option(
    "--method", "-m", required=True, help="TABLEAU or FAMILY:TABLEAU, as cf4, vcg:triple_jump, 'rkmk(2):rk4'."
)
@click.option("--target", "-t", "targets", multiple=True, help="c (the default) or python; may be repeated.")
@click.option("--output", "-o", type=FOLDER, metavar="DIR", help="The folder to write to.")
@click.option("--prefix", default="", help="Start of every external name; by default scene and method.")
@click.option(
    "--parameter",
    "-p",
    "parameters",
    multiple=True,
    help="A parameter to keep a run-time argument, or NAME=VALUE to fold.",
)
@click.option("--input", "inputs", multiple=True, help="A signal of the scene to take at run time.")
@click.option("--frame", default="space", help="Momenta of the space (the default) or of the body.")
@click.option("--jacobian", is_flag=True, help="Add the derivative of a step by the state.")
@click.option("--adaptive", is_flag=True, help="Add a run that chooses its steps by the embedded row.")
@click.option("--precision", default="double", help="double (the default) or single.")
@click.option(
    "--solver", default="auto", help="newton, chord, fixed-point or auto (the default), the cheapest."
)
@click.option("--explain", is_flag=True, help="Print the program after each pass, and what was left out.")
@click.option("--json", "as_json", is_flag=True, help="One record a module on stdout, nothing else.")
def command(
    scene: str,
    method: str,
    targets: tuple[str, ...],
    output: str | None,
    prefix: str,
    parameters: tuple[str, ...],
    inputs: tuple[str, ...],
    frame: str,
    jacobian: bool,
    adaptive: bool,
    precision: str,
    solver: str,
    explain: bool,
    as_json: bool,
) -> int:
    """Write an integrator specialised to SCENE, a name of the gallery or the path of a Python file.

    Without -o nothing is written: with --explain or --json what would be is told.
    """
    from codegen.emitter import bare, compile_method, emit_compiled
    from codegen.printers import target as known_target
    from codegen.printers.precision import precision as known_precision

    if output is None and not (explain or as_json):
        raise click.UsageError("-o DIR is missing: where to write (or ask for --explain or --json)")
    for name in targets:
        known_target(name)
    known_precision(precision)
    compiled = compile_method(
        scene, method, parameters, inputs, frame, adaptive, solver=solver, jacobian=jacobian
    )
    named = {"scene": bare(scene), "method": bare(method)}
    records: list[dict[str, Any]] = []
    if explain and not as_json:
        click.echo(explanation(compiled))
    for name in targets or ("c",):
        emission = emit_compiled(compiled, name, prefix, named, precision=precision)
        paths = [str(path) for path in emission.write(output)] if output is not None else []
        records.append({**emission.manifest, "paths": paths})
        if not as_json:
            for path in paths:
                click.echo(path)
    if as_json:
        if explain:
            for record in records:
                record["passes"] = [
                    {"name": r.name, "before": r.before, "after": r.after, "removed": r.removed}
                    for r in compiled.trace
                ]
                record["functions"] = functions_of(compiled)
        screen.print_json(records)
    return 0


def explanation(compiled: Any) -> str:
    """Return the program as lowered and after each pass, with operation counts, and what was left out."""
    from codegen.emitter import left_out
    from codegen.kernel.operations import operations, sentences
    from codegen.kernel.schedule import arrange

    parts = [f"# lowered: {counted(compiled.lowered.counts())}\n{compiled.lowered.text()}"]
    for report in compiled.trace:
        gone = counted({name: n for name, n in report.removed.items() if n > 0}) or "nothing"
        came = counted({name: -n for name, n in report.removed.items() if n < 0})
        added = f", put in {came}" if came else ""
        parts.append(f"# {report.name}: took out {gone}{added}; left {counted(report.after)}")
        parts.append(report.program.text())
    costs = sentences(operations(arrange(compiled.kernel)))
    parts.append("# kernel\n" + "".join(f"  {line}\n" for line in costs))
    functions = functions_of(compiled)
    if functions:
        lines = [f"  {p['name']}, {p['calls']} calls: {p['about']}\n" for p in functions]
        parts.append("# functions of what the kernel repeats\n" + "".join(lines))
    if compiled.solvers:
        parts.append("# solved by\n" + "".join(f"  {choice.text()}\n" for choice in compiled.solvers))
    parts.append("# left out\n" + "".join(f"  {line}\n" for line in left_out(compiled)))
    return "\n".join(parts)


def functions_of(compiled: Any) -> list[dict[str, Any]]:
    """Return the functions of what a long step repeats: name, number of calls in its text, what it does."""
    from codegen.kernel.outlined_functions import calls

    often = calls(compiled.kernel)
    return [{"name": p.name, "calls": often[p.name], "about": p.about} for p in compiled.kernel.outlined]


def counted(counts: dict[str, int]) -> str:
    """Spell operation counts."""
    return ", ".join(f"{n} {name}" for name, n in counts.items())
