"""``orderconds report``: one self-contained page about methods on scenes."""

from __future__ import annotations

import click

from orderconds.commands.place import FOLDER
from orderconds.commands.screen import print_json, working
from orderconds.commands.variadic import Variadic


@click.command(
    "report", cls=Variadic, short_help="Write one HTML page: orders, convergence, error against run time."
)
@click.argument("scenes", nargs=-1, metavar="[SCENE]...")
@click.option("--method", "-m", "methods", multiple=True, help="TABLEAU or FAMILY:TABLEAU; may be repeated.")
@click.option(
    "--output", "-o", type=FOLDER, metavar="DIR", required=True, help="The folder to write index.html to."
)
@click.option("--json", "as_json", is_flag=True, help="The measurements on stdout, nothing else.")
def command(scenes: tuple[str, ...], methods: tuple[str, ...], output: str, as_json: bool) -> int:
    """Measure SCENEs (names of the gallery or Python files; dipole and free_rigid_body by default).

    The page needs no network. The exit status is 1 when an observed order is not the computed one; the page
    is written in any case.
    """
    from codegen.lab.report import report

    with working("reading scenes and methods") as tell:
        path, studies = report(scenes, methods, output, tell)
    if as_json:
        print_json(
            {
                "page": str(path),
                "scenes": [
                    {"scene": s.scene.name, "methods": [m.as_json() for m in s.methods]} for s in studies
                ],
            }
        )
    else:
        for study in studies:
            for found in study.methods:
                click.echo(f"{study.scene.name} {found.method.label} {found.compiled.sentence()}")
        click.echo(f"the report: {path}")
    held = all(found.verdict == "holds" for study in studies for found in study.methods)
    return 0 if held else 1
