"""``orderconds longrun``: measure the drift of conserved quantities over many steps of emitted
integrators.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from codegen.commands.arguments import methods_option, scene_argument, values_option
from orderconds.commands.screen import counting, print_json, print_table
from orderconds.commands.variadic import Variadic
from orderconds.errors import InputError

if TYPE_CHECKING:
    from codegen.lab.long_runs.long_run import LongRun
    from codegen.lab.long_runs.properties import Properties

FEWEST = 200
"""The smallest number of steps that ``--steps`` accepts. In a shorter run, a drift cannot be measured."""


@click.command(
    "longrun", cls=Variadic, short_help="Measure the drift of conserved quantities over many steps."
)
@scene_argument()
@methods_option()
@values_option
@click.option(
    "--h", "size", type=float, help="The step size; by default 1/100 of the time span of the scene."
)
@click.option(
    "--steps",
    default=100_000,
    show_default=True,
    type=click.IntRange(FEWEST, 10**9),
    help="The number of steps.",
)
@click.option("--one-way", is_flag=True, help="Omit the run back to the initial state.")
@click.option("--no-rounding", is_flag=True, help="Do not measure the growth of rounding errors.")
@click.option(
    "--properties",
    "with_properties",
    is_flag=True,
    help="Also test whether each method is symplectic and symmetric (with steps of size H and longer "
    "steps), and whether the first conserved quantity drifts.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(
    scene: str,
    methods: tuple[str, ...],
    parameters: tuple[str, ...],
    size: float | None,
    steps: int,
    one_way: bool,
    no_rounding: bool,
    with_properties: bool,
    as_json: bool,
) -> int:
    """Run methods on SCENE over many steps and report the drift of energy, invariants and manifold equations.

    The column "law" describes how a quantity deviates from its initial value: exact, bounded, random walk,
    drift, rounding, lost or too short to tell. The word "drift" is used only if the run covers the time span
    of SCENE. The word "rounding" means that rounding errors explain the deviation, and "lost" that it is
    about as large as the quantity. If a method conserves a quantity in exact arithmetic, the rounding errors
    are measured with and without compensated summation. The rms error over several initial states grows like
    steps^p. The column "steps^p" contains p. If a run ends early or a method fails, the exit status is 1.

    \b
    Examples:
        orderconds longrun dipole --method vcg:midpoint --steps 100000
        orderconds longrun free_rigid_body --method cf4 --h 0.05 --one-way
        orderconds longrun heavy_top --method slgi:euler --h 0.05 --properties
    """
    from codegen import scenes
    from codegen.emitter import compile_method
    from codegen.lab.default_methods import methods_for
    from codegen.lab.long_runs.long_run import LongRun, long_run
    from codegen.lab.long_runs.properties import properties

    problem = scenes.with_one_system(scenes.load(scenes.with_values(scene, parameters)))
    h = float((problem.span[1] - problem.span[0]) / 100) if size is None else size
    # NaN is also rejected, because both comparisons are false for NaN.
    if not 1e-300 <= abs(h) <= 1e300:
        raise InputError(
            f"the step size {h:g}", where="--h", expected="an absolute value between 1e-300 and 1e300"
        )
    runs: list[LongRun] = []
    measured: list[Properties] = []
    chosen = methods_for(problem, methods)
    with counting(f"{problem.name}: {steps} steps", total=len(chosen)) as done:
        for method in chosen:
            try:
                compiled = compile_method(problem, method)
                runs.append(long_run(compiled, h, steps, back=not one_way, rounding=not no_rounding))
                if with_properties:
                    measured.append(properties(compiled, runs[-1]))
            except (InputError, ArithmeticError) as error:
                runs.append(LongRun(problem.name, method.label, h, 0, (), (), None, str(error)))
            done(method.label)
    if as_json:
        table = {row.method: {"properties": row.as_json()} for row in measured}
        print_json([run.as_json() | table.get(run.method, {}) for run in runs])
    else:
        for run in runs:
            show(run)
        show_properties(measured)
    return 1 if any(run.failure for run in runs) else 0


def show_properties(rows: Sequence[Properties]) -> None:
    """Print whether each method is symplectic and symmetric, and whether a conserved quantity drifts.

    If ``rows`` is empty, nothing is printed.
    """
    if not rows:
        return
    words = {True: "yes", False: "no", None: "-"}
    quantity = next((row.quantity for row in rows if row.quantity), "quantity")
    print_table(
        ["method", "symplectic", "symmetric", f"no drift of {quantity}"],
        [[r.method, words[r.symplectic], words[r.symmetric], words[r.steady]] for r in rows],
    )


def show(run: LongRun) -> None:
    """Print the drift of each conserved quantity in one run, and the other measured errors."""
    click.echo(f"{run.method} on {run.scene}, {run.steps} steps of {run.h:g}")
    rows = [
        [
            kept.name,
            f"{kept.drift.largest:.2e}",
            f"{kept.drift.slope:+.1e} ± {kept.drift.half_width:.0e}",
            f"{kept.drift.exponent:.2f}",
            kept.drift.law + ("" if (t := kept.drift.until) is None else f", saturates at t = {t:.3g}"),
        ]
        for kept in run.kept
    ]
    if rows or run.failure:
        print_table(["quantity", "largest", "slope per unit of time", "t^p", "law"], rows, indent=2)
    else:
        click.echo("  the scene has no conserved quantity")
    for steps, distance in run.reversals:
        click.echo(
            f"    distance {distance:.2e} from the start after {steps} steps forward and {steps} steps back"
        )
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
        click.echo(f"    rounding errors of conserved quantities over {run.rounding[0].steps[-1]} steps")
        print_table(["quantity", "steps", "rms", "steps^p", "law"], rows, indent=4)
    if run.symplectic is not None:
        click.echo(f"  largest symplectic defect of a step: {run.symplectic:.1e}")
    if run.unmeasured:
        click.echo(f"  symplectic defect not measured: {run.unmeasured}")
    if run.failure:
        click.echo(f"  stopped: {run.failure}")
