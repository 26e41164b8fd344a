"""``orderconds stability``: stiff and extreme cases of emitted integrators, and how each was answered."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import click

from orderconds.processes import in_processes
from orderconds.commands.screen import counting, print_json, print_table
from orderconds.commands.variadic import Variadic


@click.command("stability", cls=Variadic, short_help="Try stiff and extreme cases; say what held.")
@click.argument("scene", required=False)
@click.option("--method", "-m", "methods", multiple=True, help="TABLEAU or FAMILY:TABLEAU; may be repeated.")
@click.option("--all", "everything", is_flag=True, help="Every scene of the gallery with its usual methods.")
@click.option("--quick", is_flag=True, help="Leave out the runs of ten million steps.")
@click.option("--json", "as_json", is_flag=True, help="The measurements on stdout, nothing else.")
def command(scene: str | None, methods: tuple[str, ...], everything: bool, quick: bool, as_json: bool) -> int:
    """Compare single steps of emitted C with 60 digits on extreme input; find the largest step and more.

    Each case reads accurate or a status of the emitted code. The exit status is 1 when an answer is neither.
    """
    from codegen import scenes
    from codegen.lab.stability.study import Stability
    from codegen.lab.study import methods_for

    if everything == (scene is not None):
        raise click.UsageError("name one SCENE, or give --all")
    names = scenes.GALLERY if scene is None else (scene,)
    for name in names:
        methods_for(scenes.load(name), methods)  # what is wrong with the input is found before the work
    found: list[Stability] = []
    with counting("stability") as done:
        work = _alone if len(names) > 1 else partial(_studied, tell=done)
        for name, results in zip(
            names, in_processes(work, [(name, methods, not quick) for name in names]), strict=True
        ):
            done(name)
            for result in results:
                found.append(result)
                if not as_json:
                    show(result)
    if as_json:
        print_json([result.as_json() for result in found])
    return 0 if all(result.held for result in found) else 1


def _studied(job: tuple[str, tuple[str, ...], bool], tell: Callable[[str], object]) -> list[Any]:
    """Return the stability of methods on a scene; the job is its name, theirs and whether runs are long."""
    from codegen import scenes
    from codegen.lab.stability.study import study
    from codegen.lab.study import methods_for

    name, methods, long = job
    problem = scenes.load(name)
    return list(study(problem, methods_for(problem, methods), tell, long=long))


def _alone(job: tuple[str, tuple[str, ...], bool]) -> list[Any]:
    """Do the job in a process of its own, where nobody listens."""
    return _studied(job, str)


def show(result: Any) -> None:
    """Print the tables of one method on one scene."""
    click.echo(f"{result.method} on {result.scene}")
    if result.region is not None:
        lengths = [interval(x) for x in (result.region.real, result.region.imaginary)]
        click.echo(f"  linear stability: real axis {lengths[0]}, imaginary axis {lengths[1]}")
    limit = result.limit
    size = "none" if limit.h is None else f"{limit.h:.3g} ({limit.steps} steps)"
    click.echo(f"  largest usable step: {size}; limited by: {limit.reason}")
    rows = []
    for a in result.answers:
        error = "" if a.error is None else f"{a.error:.1e}"
        digits = "" if a.determined is None else f"{a.determined:.0f}"
        rows.append([a.case.name, a.verdict, error, digits])
    print_table(["case", "answer", "error", "digits determined"], rows, indent=2)
    for s in result.stiff:
        click.echo(f"  {s.variant}: {s.verdict}")
    for e in result.endurance:
        click.echo(f"  {e.name}: {endurance(e)}")
    for note in result.notes:
        click.echo(f"  {note}")
    click.echo()


def interval(length: float) -> str:
    """Return the length of a stability interval in words.

    >>> interval(2.0), interval(float("inf")), interval(0.0)
    ('2', 'unbounded', 'none')
    """
    return "unbounded" if length == float("inf") else f"{length:.4g}" if length else "none"


def endurance(run: Any) -> str:
    """Say how a long run ended."""
    if run.failure:
        return run.failure  # type: ignore[no-any-return]
    parts = [f"{run.steps} steps"]
    if run.defect is not None:
        parts.append(f"{run.defect:.1e} off the manifold")
    if run.returned is not None:
        parts.append(f"{run.returned:.1e} from the start")
    return ", ".join(parts) + ("" if run.held else ": more than rounding explains")
