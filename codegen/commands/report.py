"""``orderconds report``: write an HTML page of measurements for each scene, and an overview page."""

from __future__ import annotations

import click

from codegen.commands.arguments import methods_option, scene_names, values_option
from orderconds.commands.names import completing
from orderconds.commands.place import FOLDER
from orderconds.commands.screen import counting, is_shown, print_json
from orderconds.commands.variadic import Variadic


@click.command(
    "report",
    cls=Variadic,
    short_help="Write HTML pages: orders, cost, stability, long runs.",
)
@click.argument("scenes", nargs=-1, metavar="[SCENE]...", shell_complete=completing(scene_names, files=True))
@methods_option()
@values_option
@click.option("--adaptive", multiple=True, help="Methods to measure with step-size control.")
@click.option(
    "--against",
    "-a",
    "peers",
    multiple=True,
    help="Names of peers to measure. Peers are other integrators, such as those of SciPy; see bench --help.",
)
@click.option(
    "--only",
    "parts",
    multiple=True,
    help="A measurement to make (see `orderconds list measurements`). The option may be repeated. Default: "
    "all measurements.",
)
@click.option("--all", "everything", is_flag=True, help="Measure every scene of the gallery.")
@click.option(
    "--quick",
    "effort",
    flag_value="quick",
    help="Make short runs and omit stiff variants of the scenes. Each scene then takes some seconds.",
)
@click.option(
    "--full",
    "effort",
    flag_value="full",
    help="Measure all peers (see --against) and make runs of a million steps. Each scene then takes many "
    "minutes.",
)
@click.option("--output", "-o", type=FOLDER, metavar="DIR", required=True, help="The folder for the pages.")
@click.option(
    "--processes",
    type=click.IntRange(1),
    metavar="N",
    help="The number of scenes measured at the same time; by default the number of processors.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(
    scenes: tuple[str, ...],
    methods: tuple[str, ...],
    parameters: tuple[str, ...],
    adaptive: tuple[str, ...],
    peers: tuple[str, ...],
    parts: tuple[str, ...],
    everything: bool,
    effort: str | None,
    output: str,
    processes: int | None,
    as_json: bool,
) -> int:
    """Measure SCENEs (names of scenes in the gallery, or paths of Python files). The default scenes are
    dipole and free_rigid_body.

    The command writes a page DIR/SCENE.html for each scene, and a page DIR/index.html with the fastest
    methods for every scene. A Hamiltonian scene takes one to two minutes, and other scenes take about half a
    minute. All measured times are CPU times. If a report is interrupted, repeat the command to continue the
    report.

    For more than eight scenes, the command measures less: the search for the fastest method is shortened, and
    the growth of rounding errors is measured only with --full.

    The exit status is 1 in three cases: an observed order contradicts the order conditions, a step with
    extremely large or small numbers gives a wrong result, or a method fails. The pages are
    written in these cases, too.

    \b
    Examples:
        orderconds report free_rigid_body dipole --quick -o report
        orderconds report top.py --method cf4 --only orders -o report
    """
    from codegen.lab.report import Request, read_scenes, report
    from codegen.scenes import with_values

    if everything and scenes:
        raise click.UsageError("SCENE cannot be used with --all")
    if parameters and not scenes:
        raise click.UsageError("--parameter requires the argument SCENE")
    scenes = tuple(with_values(name, parameters) for name in scenes)
    request = Request(
        read_scenes(scenes, everything), methods, peers, parts, effort or "usual", adaptive, processes
    )
    count = len(request.names())
    with counting("report", total=count if count > 1 else None) as progress:
        path, pages = report(request, output, progress)
    held = all(page.held for page in pages)
    if as_json:
        print_json({"page": str(path), "scenes": [page.json for page in pages]})
    else:
        for line in (line for page in pages if is_shown(page.held) for line in page.lines):
            click.echo(line)
        if is_shown(held):
            click.echo(f"the report: {path}")
    return 0 if held else 1
