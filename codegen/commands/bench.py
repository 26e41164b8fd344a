"""``orderconds bench``: measure the error and the run time of emitted integrators and of peers.

Peers are other integrators, for example those of SciPy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from codegen.commands.arguments import methods_option, scene_argument, targets_option, values_option
from orderconds.commands.place import FOLDER
from orderconds.commands.screen import counting, print_json, print_table, working
from orderconds.commands.variadic import Variadic
from orderconds.errors import InputError

if TYPE_CHECKING:
    from codegen.lab.efficiency.bench import Result


@click.command(
    "bench", cls=Variadic, short_help="Compare the errors and run times of integrators on a scene."
)
@scene_argument()
@methods_option()
@values_option
@click.option(
    "--adaptive", multiple=True, help="Methods to run with step-size control, at several tolerances."
)
@targets_option
@click.option(
    "--against",
    "-a",
    "peers",
    multiple=True,
    help="Names of peers to measure. Peers are other integrators, such as those of SciPy. The names 'scipy', "
    "'c' and 'all' select groups of peers.",
)
@click.option(
    "--form",
    "forms",
    multiple=True,
    help="A form of the equations to measure, such as 'printed' (the equations of the scene), 'body-matrix' "
    "or 'quaternion'. The option may be repeated. Default: all forms. The option is for the methods "
    "ambient:TABLEAU and for peers (see --against). Other methods ignore the option.",
)
@click.option("--budget", default=1.0, show_default=True, help="The longest CPU time of one run, in seconds.")
@click.option(
    "--output",
    "-o",
    type=FOLDER,
    metavar="DIR",
    help="The folder for SCENE.csv, SCENE.json and SCENE.svg.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(
    scene: str,
    methods: tuple[str, ...],
    parameters: tuple[str, ...],
    adaptive: tuple[str, ...],
    targets: tuple[str, ...],
    peers: tuple[str, ...],
    forms: tuple[str, ...],
    budget: float,
    output: str | None,
    as_json: bool,
) -> int:
    """Run methods on SCENE (a gallery name or a Python file) with shorter and shorter steps, and measure
    error and run time.

    With --adaptive, methods run with step-size control. Their tableaux must have an embedded method for the
    error estimate. Examples are ambient:dop853, rkmk(3):dormand_prince5 and ambient:radau2a3.

    With --against, other integrators (peers) also run. Their names are scipy-lsoda, scipy-dop853,
    scipy-dop853-projected, scipy-radau, scipy-radau-projected, heyoka, diffrax, c-dop853 and c-rk4-projected.
    The name 'scipy' selects all installed peers of SciPy, 'c' selects all peers in C, and 'all' selects all
    installed peers.

    The equations of a scene may have several classical forms, for example with a quaternion instead of a
    rotation matrix. The methods ambient:TABLEAU and most peers run on each form.

    If a measurement with -o is interrupted, repeat the command to continue the measurement. If a method or
    peer has no successful run, the exit status is 1.

    \b
    Examples:
        orderconds bench free_rigid_body --method cf4 rkmk:rk4 --against scipy
        orderconds bench dipole --method vcg:midpoint --adaptive ambient:dop853 -o out
    """
    from codegen.lab.efficiency.bench import bench
    from codegen.printers import DEFAULT
    from codegen.scenes import with_values

    if not 0 < budget < 1e5:
        raise InputError(
            f"the budget {budget:g}",
            where="--budget",
            expected="CPU seconds above 0 and below 100000",
        )
    with working("reading scene and methods") as progress:
        targets = targets or (DEFAULT,)
        candidates = bench(
            with_values(scene, parameters), methods, targets, peers, budget, output, progress, adaptive, forms
        )
    with counting(f"{candidates.scene.name}: runs") as done:
        result = candidates.run(lambda row: done(f"{row.method} ({row.target})"))
    if as_json:
        print_json([row.as_json() for row in result.rows])
    else:
        show(result)
    return 0 if all(any(r.error is not None for r in rows) for rows in result.entries.values()) else 1


def show(result: Result) -> None:
    """Print the result as tables, and print the paths of the written files."""
    from codegen.lab.efficiency.ranking import in_form
    from codegen.lab.page.formatting import duration

    rows = []
    for row in result.rows:
        if row.failure:
            label = in_form(row.method, row.form)
            rows.append([label, row.target, f"{row.control:g}", "", row.failure, "", "", "", "", ""])
            continue
        cells = [
            in_form(row.method, row.form),
            row.target,
            f"{row.control:g}",
            str(row.steps),
            f"{row.error:.2e}",
        ]
        cells += [duration(row.seconds), f"{row.spread:.0%}" if row.spread is not None else ""]
        cells += ["" if x is None else str(x) for x in (row.evaluations, row.exponentials, row.iterations)]
        rows.append(cells)
    columns = ["method", "target", "requested", "steps", "error", "CPU time", "spread", "evaluations"]
    print_table([*columns, "exponentials", "iterations"], rows)
    click.echo()
    print_table(
        ["error", "fastest", "CPU time", "second", "times slower"],
        [
            [
                f"1e-{p.decade}",
                p.winner,
                duration(p.seconds),
                p.second,
                "" if p.behind is None else f"{p.behind / p.seconds:.2f}",
            ]
            for p in result.places
        ],
    )
    click.echo()
    print_table(
        ["set-up", "emission", "compilation"],
        [[label, f"{a:.2f} s" if a else "", f"{b:.2f} s"] for label, a, b in result.setups],
    )
    for path in result.paths:
        click.echo(path)
