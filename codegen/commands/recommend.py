"""``orderconds recommend``: find the fastest method that reaches a given accuracy on a scene."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import click

from codegen.commands.arguments import scene_argument, values_option
from codegen.errors import SceneError
from orderconds.commands.screen import print_json, print_table, working

if TYPE_CHECKING:
    from codegen.lab.efficiency.race import Result
    from codegen.lab.efficiency.recommend import Recommendation, Request


NOTICED = 0.1
"""If the reference solution takes at least this fraction of the time budget, the output says so."""


@click.command("recommend", short_help="Find the fastest method with a required accuracy on a scene.")
@scene_argument()
@values_option
@click.option(
    "--error", type=float, required=True, help="The largest allowed error at the end of the time span."
)
@click.option(
    "--need",
    "needs",
    multiple=True,
    help="One or more required properties, separated by commas. The properties are: manifold (the state "
    "stays on the manifold), symplectic, explicit, adaptive (step-size control), fixed (equal steps).",
)
@click.option("--stack", type=click.IntRange(1), help="The largest allowed stack memory of a call, in bytes.")
@click.option("--span", metavar="A:B", help="The time interval; by default the interval of the scene.")
@click.option(
    "--budget", type=float, help="Time in seconds for the reference solution and the search; by default 50."
)
@click.option(
    "--tableau", "tableaux", multiple=True, help="Search only these tableaux; by default the whole library."
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(
    scene: str,
    parameters: tuple[str, ...],
    error: float,
    needs: tuple[str, ...],
    stack: int | None,
    span: str | None,
    budget: float | None,
    tableaux: tuple[str, ...],
    as_json: bool,
) -> int:
    """Find the fastest method whose error on SCENE (a gallery name or a Python file) is at most --error.

    By default the search uses all tableaux of the library, in every family that accepts the scene. The error
    is the distance from a reference solution at the end of the time span.

    The option --need accepts five properties: manifold (the state stays on the manifold up to rounding),
    symplectic, explicit (no equations are solved), adaptive (step-size control) and fixed (equal steps). With
    --need symplectic, the search also excludes methods that lose a conserved quantity in a long run. The exit
    status is 1 if no method is found.

    \b
    Examples:
        orderconds recommend free_rigid_body --error 1e-8
        orderconds recommend dipole --error 1e-4 --need symplectic
    """
    from codegen.lab.efficiency.recommend import Request, recommend
    from codegen.lab.efficiency.task import BUDGET
    from codegen.scenes import with_values
    from orderconds.errors import InputError

    if budget is not None and not 0 < budget < 1e5:
        raise InputError(
            f"the budget {budget:g}", where="--budget", expected="seconds above 0 and below 100000"
        )
    request = Request(
        with_values(scene, parameters),
        error,
        tuple(dict.fromkeys(word.strip() for need in needs for word in need.split(","))),
        stack,
        None if span is None else span_of(span),
        BUDGET if budget is None else budget,
        tableaux,
    )
    with working("reading the scene") as progress:
        result = recommend(request, progress)
    if as_json:
        print_json(result.as_json())
    else:
        show(result)
    return 0 if result.places else 1


def show(result: Recommendation) -> None:
    """Print the fastest method, the second fastest method, and the command that emits the fastest method."""
    from codegen.lab.page.formatting import duration

    asked = result.request
    if not result.places:
        click.echo(unreached(result))
        return
    names = ("recommended", "runner-up")
    rows = [
        [name, p.entry.recipe.label, control(asked, p), str(p.steps), f"{p.error:.1e}", duration(p.seconds)]
        for name, p in zip(names, result.places, strict=False)
    ]
    print_table(["", "method", "step or tolerance", "steps", "error", "CPU time"], rows)
    click.echo()
    click.echo(f"  {result.places[0].entry.recipe.command(asked.scene)}")
    click.echo()
    click.echo(searched(result))


def control(asked: Request, place: Result) -> str:
    """Return the tolerance of a run with step-size control, or the step size of a run with equal steps.

    If the step size is unknown, the result is ''.
    """
    if place.tolerance is not None:
        return f"rtol = atol = {place.tolerance:.1e}"
    from codegen.lab.efficiency.recommend import step_of

    h = step_of(asked.task, place)
    return "" if h is None else f"h = {h:.6g}"


def searched(result: Recommendation) -> str:
    """Describe the search: its duration, how many methods were compared, and warnings."""
    text = (
        f"the search took {result.seconds:.0f} s; the CPU time was predicted for {result.predicted} methods "
        f"and measured for {result.raced} methods"
    )
    if result.kinks:
        text += (
            f"; the solution crosses {result.kinks} points where the vector field is not smooth, which can "
        )
        text += "lower the order of a method; other time intervals can contain more such points"
    text += "" if result.complete else "; the time budget ended the search; increase --budget"
    if result.referred >= NOTICED:
        text += f"; the reference solution took {result.referred:.0%} of the budget"
    return text + "".join(f"; {label} loses a conserved quantity in a long run" for label in result.lost)


def unreached(result: Recommendation) -> str:
    """Return a message for a search that does not recommend a method.

    The message states one of three reasons:
    - No error was measured.
    - Every method that reaches the requested error loses a conserved quantity.
    - No method reaches the requested error. In this case the message contains the smallest measured error.

    A method reaches the requested error only if a second run with higher accuracy confirms the first run. If
    the smallest measured error is at most the requested error, the message says that the run with this
    error is not confirmed.
    """
    asked = result.request
    needs = f" with {', '.join(asked.needs)}" if asked.needs else ""
    missed = f"no method{needs} reaches the error {asked.error:g}"
    if result.lost:
        missed = (
            f"every measured method{needs} that reaches the error {asked.error:g} loses a conserved quantity"
        )
        return f"{asked.scene}: {missed} in a long run; relax --need or --error\n{searched(result)}"
    if result.best is None and not result.complete:
        missed = f"no method{needs} was measured before the time budget ended"
        return f"{asked.scene}: {missed}; increase --budget"
    if result.best is None:
        return f"{asked.scene}: {missed}; no method has the required properties; relax --need or --stack"
    best = result.best
    by = f"reached by {best.entry.recipe.label} ({control(asked, best)})"
    least = f"the smallest measured error is {best.error:.1e}, {by}"
    if best.error <= asked.error:
        # The error of a single run can be small by accident (codegen.lab.efficiency.race).
        missed += " in two consecutive runs"
        least += (
            ", but this run is not confirmed, because the next run failed, was not made, or had more than "
            "twice the requested error (the next run has half the step size or a tenth of the tolerance)"
        )
    return f"{asked.scene}: {missed}; {least}; relax --error\n{searched(result)}"


def span_of(text: str) -> tuple[Fraction, Fraction]:
    """Return the time interval (A, B) that a text ``A:B`` describes.

    If the text does not contain two numbers A < B, :class:`SceneError` is raised.

    >>> span_of("0:5/2")
    (Fraction(0, 1), Fraction(5, 2))
    """
    try:
        first, last = map(Fraction, text.split(":"))
    except (ValueError, ZeroDivisionError):
        raise SceneError(f"the span {text!r}", where="--span", expected="A:B, two numbers") from None
    if not first < last:
        raise SceneError(f"the span {text!r}", where="--span", expected="A:B with A < B")
    return first, last
