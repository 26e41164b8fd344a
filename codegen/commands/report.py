"""``orderconds report``: a page a scene and an overview, about methods on scenes."""

from __future__ import annotations

import click

from orderconds.commands.place import FOLDER
from orderconds.commands.screen import counting, print_json
from orderconds.commands.variadic import Variadic

PARTS = ("orders", "cost", "stability", "long")


@click.command(
    "report",
    cls=Variadic,
    short_help="Write HTML pages: orders, cost, stability, long runs.",
)
@click.argument("scenes", nargs=-1, metavar="[SCENE]...")
@click.option("--method", "-m", "methods", multiple=True, help="TABLEAU or FAMILY:TABLEAU; may be repeated.")
@click.option("--adaptive", multiple=True, help="Methods that choose their steps, for the cost.")
@click.option("--against", "-a", "peers", multiple=True, help="Peers, as for bench.")
@click.option("--only", "parts", multiple=True, type=click.Choice(PARTS), help="Parts; all by default.")
@click.option("--all", "everything", is_flag=True, help="Every scene of the gallery.")
@click.option("--quick", "effort", flag_value="quick", help="Short runs, no harsh variants: seconds a scene.")
@click.option("--full", "effort", flag_value="full", help="All peers, a million steps: many minutes a scene.")
@click.option(
    "--output", "-o", type=FOLDER, metavar="DIR", required=True, help="The folder to write index.html to."
)
@click.option("--json", "as_json", is_flag=True, help="The measurements on stdout, nothing else.")
def command(
    scenes: tuple[str, ...],
    methods: tuple[str, ...],
    adaptive: tuple[str, ...],
    peers: tuple[str, ...],
    parts: tuple[str, ...],
    everything: bool,
    effort: str | None,
    output: str,
    as_json: bool,
) -> int:
    """Measure SCENEs (names of the gallery or Python files; dipole and free_rigid_body by default).

    Writes DIR/SCENE.html for each and DIR/index.html, which says for every scene which method to take. A
    Hamiltonian scene takes one to two minutes, a field some ten seconds; an interrupted report goes on where
    it stopped. The pages need no network. The exit status is 1 when an observed order is not the computed one
    or an extreme step was answered wrongly; the pages are written in any case.
    """
    from codegen.lab.report import Request, read_scenes, report

    if everything and scenes:
        raise click.UsageError("name SCENEs, or give --all")
    request = Request(read_scenes(scenes, everything), methods, peers, parts, effort or "usual", adaptive)
    with counting("reading scenes and methods") as tell:
        path, surveys = report(request, output, tell)
    if as_json:
        print_json({"page": str(path), "scenes": [survey.as_json() for survey in surveys]})
    else:
        for survey in surveys:
            for found in survey.orders:
                click.echo(f"{survey.scene.name} {found.method.label} {found.compiled.sentence()}")
            for tried in survey.stability:
                for wrong in tried.wrong:
                    click.echo(f"{survey.scene.name} {tried.method}: {wrong.case.name}: {wrong.verdict}")
        click.echo(f"the report: {path}")
    return 0 if all(survey.held for survey in surveys) else 1
