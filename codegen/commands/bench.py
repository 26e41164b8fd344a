"""``orderconds bench``: error against run time of emitted integrators, beside peers."""

from __future__ import annotations

from typing import Any

import click

from orderconds.commands.place import FOLDER
from orderconds.commands.screen import counting, print_json, print_table, working
from orderconds.commands.variadic import Variadic
from orderconds.errors import InputError


@click.command("bench", cls=Variadic, short_help="Measure error against run time, beside peers.")
@click.argument("scene")
@click.option("--method", "-m", "methods", multiple=True, help="TABLEAU or FAMILY:TABLEAU; may be repeated.")
@click.option("--adaptive", multiple=True, help="Methods that choose their steps, over tolerances.")
@click.option("--target", "-t", "targets", multiple=True, help="c (the default) or python; may be repeated.")
@click.option("--against", "-a", "peers", multiple=True, help="Peers, or scipy, c or all for several.")
@click.option("--budget", default=1.0, show_default=True, help="CPU seconds that one run may take.")
@click.option(
    "--output", "-o", type=FOLDER, metavar="DIR", help="Write SCENE.csv, SCENE.json and SCENE.svg there."
)
@click.option("--json", "as_json", is_flag=True, help="The rows on stdout, nothing else.")
def command(
    scene: str,
    methods: tuple[str, ...],
    adaptive: tuple[str, ...],
    targets: tuple[str, ...],
    peers: tuple[str, ...],
    budget: float,
    output: str | None,
    as_json: bool,
) -> int:
    """Run methods on SCENE (a gallery name or a Python file) over ladders of steps, and time them.

    --adaptive takes methods with an embedded row, as ambient:dop853, rkmk(3):dormand_prince5 or
    ambient:radau2a3; they run beside those of equal steps, or alone. Peers: scipy-dop853, scipy-radau,
    scipy-lsoda, heyoka, diffrax, c-dop853, c-rk4-projected; those not installed are left out of groups. With
    -o an interrupted measurement goes on where it stopped. The exit status is 1 when some method has no run
    that succeeds.
    """
    from codegen.lab.bench import bench

    if not 0 < budget < 1e5:
        raise InputError(f"the budget {budget:g}", where="--budget", expected="CPU seconds above 0")
    with working("reading scene and methods") as tell:
        match = bench(scene, methods, targets or ("c",), peers, budget, output, tell, adaptive)
    with counting(f"{match.scene.name}: first runs") as done:
        result = match.run(lambda row: done(f"{row.method} ({row.target})"))
    if as_json:
        print_json([row.as_json() for row in result.rows])
    else:
        show(result)
    return 0 if all(any(r.error is not None for r in rows) for rows in result.entries.values()) else 1


def show(result: Any) -> None:
    """Print each ladder's best rows, the winner of each decade, and set-up times."""
    rows = []
    for row in result.rows:
        if row.failure:
            rows.append([row.method, row.target, f"{row.control:g}", "", row.failure, "", "", "", "", ""])
            continue
        cells = [row.method, row.target, f"{row.control:g}", str(row.steps), f"{row.error:.2e}"]
        cells += [duration(row.seconds), f"{row.spread:.0%}" if row.spread is not None else ""]
        cells += ["" if x is None else str(x) for x in (row.evaluations, row.exponentials, row.iterations)]
        rows.append(cells)
    columns = ["method", "target", "asked", "steps", "error", "CPU time", "spread", "evaluations"]
    print_table([*columns, "exponentials", "iterations"], rows)
    click.echo()
    print_table(
        ["error", "fastest", "CPU time", "next", "times slower"],
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


def duration(seconds: float) -> str:
    """Return a time with three digits and a unit.

    >>> duration(1.234e-5), duration(2.0)
    ('12.3 µs', '2 s')
    """
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= 0.9995 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"
