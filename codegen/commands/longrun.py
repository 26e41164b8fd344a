"""``orderconds longrun``: what emitted integrators keep over many steps."""

from __future__ import annotations

from typing import Any

import click

from orderconds.commands.screen import counting, print_json, print_table, working
from orderconds.commands.variadic import Variadic
from orderconds.errors import InputError

FEWEST = 200


@click.command("longrun", cls=Variadic, short_help="Measure what is kept over many steps.")
@click.argument("scene")
@click.option("--method", "-m", "methods", multiple=True, help="TABLEAU or FAMILY:TABLEAU; may be repeated.")
@click.option("--h", "size", type=float, help="The step size; by default a hundredth of the scene's span.")
@click.option("--steps", default=100_000, show_default=True, type=click.IntRange(FEWEST, 10**9))
@click.option("--one-way", is_flag=True, help="Leave out the way back.")
@click.option("--no-rounding", is_flag=True, help="Leave out how rounding grows.")
@click.option("--json", "as_json", is_flag=True, help="The measurements on stdout, nothing else.")
def command(
    scene: str,
    methods: tuple[str, ...],
    size: float | None,
    steps: int,
    one_way: bool,
    no_rounding: bool,
    as_json: bool,
) -> int:
    """Run methods on SCENE over many steps; say what became of energy, invariants and the manifold.

    What a method keeps exactly is followed from several starts, by emitted C and by the same steps with
    compensated summation: the root mean square of what rounding did, and the exponent of its growth.
    The exit status is 1 when a run ends early.
    """
    from codegen import scenes
    from codegen.emitter import compile_method
    from codegen.lab.longrun import longrun
    from codegen.lab.study import methods_for

    problem = scenes.load(scene)
    h = float((problem.span[1] - problem.span[0]) / 100) if size is None else size
    if not 1e-300 <= abs(h) <= 1e300:  # NaN is not
        raise InputError(
            f"the step size {h:g}", where="--h", expected="a number between 1e-300 and 1e300 in size"
        )
    with working("emitting"):
        compiled = [compile_method(problem, m) for m in methods_for(problem, methods)]
    found = []
    with counting(f"{problem.name}: {steps} steps") as done:
        for made in compiled:
            found.append(longrun(made, h, steps, back=not one_way, rounding=not no_rounding))
            done(made.method.label)
    if as_json:
        print_json([run.as_json() for run in found])
    else:
        for run in found:
            show(run)
    return 1 if any(run.failure for run in found) else 0


def show(run: Any) -> None:
    """Print one run: a line a kept quantity, then the way back and the symplectic defect."""
    click.echo(f"{run.method} on {run.scene}, {run.steps} steps of {run.h:g}")
    rows = [
        [
            kept.name,
            f"{kept.drift.largest:.2e}",
            f"{kept.drift.slope:+.1e} ± {kept.drift.half_width:.0e}",
            f"{kept.drift.exponent:.2f}",
            kept.drift.law,
        ]
        for kept in run.kept
    ]
    print_table(["kept", "largest", "drift a unit of time", "t^p", "law"], rows, indent=2)
    for steps, distance in run.reversals:
        click.echo(f"  {steps} steps there and back: {distance:.2e} from the start")
    if run.rounding:
        rows = [
            [
                g.quantity,
                "compensated" if g.compensated else "plain",
                f"{g.sizes[-1]:.1e}",
                f"{g.exponent:.2f} ± {g.half_width:.2f}",
                g.law,
            ]
            for g in run.rounding
        ]
        click.echo(f"  rounding over {run.rounding[0].steps[-1]} steps, in what is kept exactly")
        print_table(["kept", "steps", "rms", "steps^p", "law"], rows, indent=4)
    if run.symplectic is not None:
        click.echo(f"  symplectic defect of a step: {run.symplectic:.1e}")
    if run.failure:
        click.echo(f"  stopped: {run.failure}")
