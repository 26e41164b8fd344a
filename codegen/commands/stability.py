"""``orderconds stability``: test emitted integrators on stiff and extreme inputs."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

import click

from codegen.commands.arguments import methods_option, scene_argument, values_option
from orderconds.commands.screen import counting, is_shown, print_json, print_table
from orderconds.commands.variadic import Variadic
from orderconds.processes import in_processes

if TYPE_CHECKING:
    from codegen.lab.stability.stability_study import NotTested, Stability

Job: TypeAlias = tuple[str, tuple[str, ...], bool]
"""The stress tests of one scene: the name of the scene, the names of the methods, and a flag.

If the flag is True, runs of ten million steps are included.
"""


@click.command("stability", cls=Variadic, short_help="Stress-test emitted steps on stiff and extreme inputs.")
@scene_argument(required=False)
@methods_option()
@values_option
@click.option(
    "--all", "everything", is_flag=True, help="Test every scene of the gallery with its default methods."
)
@click.option("--quick", is_flag=True, help="Omit the runs of ten million steps.")
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(
    scene: str | None,
    methods: tuple[str, ...],
    parameters: tuple[str, ...],
    everything: bool,
    quick: bool,
    as_json: bool,
) -> int:
    """Test single steps of emitted C on extreme inputs, and find the largest usable step.

    The result of each step is compared with a computation in at least 60 digits. An extreme input passes the
    test if the result is accurate, or if the emitted code returns an error status. If an input does not pass
    the test, or if a method cannot be emitted for the scene, the exit status is 1.

    A stability interval is the largest interval from 0, on the negative real or the positive imaginary axis,
    on which |R| <= 1. R is the stability function of the tableau. The ends are computed in exact
    arithmetic. "none" means that |R| > 1 right after 0, even if |R| is only slightly above 1. "unbounded"
    means that |R| <= 1 is proved on the whole half-axis. "undecided" means that the tableau contains rounded
    coefficients whose digits do not determine the end, or that the exact computation would take too long.

    \b
    Examples:
        orderconds stability free_rigid_body --method cf4 --quick
        orderconds stability --all --quick
    """
    from codegen import scenes
    from codegen.lab.default_methods import methods_for

    if everything == (scene is not None):
        raise click.UsageError("give either SCENE or --all")
    if everything and parameters:
        raise click.UsageError("--parameter cannot be used with --all")
    names = scenes.GALLERY if scene is None else (scenes.with_values(scene, parameters),)
    for name in names:
        # If a scene or a method cannot be tested, raise InputError before the first test.
        scenes.with_one_system(scenes.load(name)).require_formulas()
        methods_for(scenes.load(name), methods)
    all_results: list[Stability | NotTested] = []
    with counting("stability", total=len(names) if len(names) > 1 else None) as done:
        work = _alone if len(names) > 1 else partial(_run, progress=done)
        for name, results in zip(
            names, in_processes(work, [(name, methods, not quick) for name in names]), strict=True
        ):
            done(name)
            for result in results:
                all_results.append(result)
                if not as_json and is_shown(result.held):
                    show(result)
    if as_json:
        print_json([result.as_json() for result in all_results])
    return 0 if all(result.held for result in all_results) else 1


def _run(job: Job, progress: Callable[[str], object]) -> list[Stability | NotTested]:
    """Return the results of all stress tests of a job."""
    from codegen import scenes
    from codegen.lab.default_methods import methods_for
    from codegen.lab.stability.stability_study import stability

    name, methods, endurance = job
    problem = scenes.load(name)
    return list(stability(problem, methods_for(problem, methods), progress, endurance=endurance))


def _alone(job: Job) -> list[Stability | NotTested]:
    """Run the stress tests of a job without progress messages, and return the results."""
    return _run(job, str)


def show(result: Stability | NotTested) -> None:
    """Print the results of the stress tests of one method, or the reason why the method was not tested."""
    from codegen.lab.measurements.stability import endurance_text
    from codegen.lab.stability.linear_stability import interval
    from codegen.lab.stability.stability_study import NotTested

    click.echo(f"{result.method} on {result.scene}")
    if isinstance(result, NotTested):
        click.echo(f"  fails: {result.failure}\n")
        return
    if result.region is not None:
        lengths = [interval(x) for x in (result.region.real, result.region.imaginary)]
        click.echo(f"  stability intervals: real axis {lengths[0]}, imaginary axis {lengths[1]}")
    findings = result.findings
    limit = findings.limit
    size = "none" if limit.h is None else f"{limit.h:.3g} ({limit.steps} steps in the time span)"
    click.echo(f"  largest usable step: {size}; limited by: {limit.reason}")
    rows = []
    for a in findings.answers:
        error = "" if a.error is None else f"{a.error:.1e}"
        digits = "" if a.determined is None else f"{a.determined:.0f}"
        rows.append([a.case.name, a.verdict, error, digits])
    print_table(["case", "result", "error", "digits determined"], rows, indent=2)
    for s in findings.stiff:
        click.echo(f"  {s.variant}: {s.verdict}")
    for e in findings.endurance:
        click.echo(f"  {e.name}: {endurance_text(e)}")
    for note in findings.notes:
        click.echo(f"  {note}")
    click.echo()
