"""``orderconds figure``: draw a figure of a scene as an SVG file."""

from __future__ import annotations

import click

from codegen.commands.arguments import scene_argument, values_option
from orderconds.commands.place import FILE, put
from orderconds.commands.screen import counting, is_shown, print_json


@click.command("figure", short_help="Draw a figure of a scene as an SVG file.")
@scene_argument()
@click.argument("name")
@values_option
@click.option("--output", "-o", type=FILE, metavar="FILE", required=True, help="The SVG file to write.")
@click.option("--json", "as_json", is_flag=True, help="Print the numbers behind the figure as JSON.")
def command(scene: str, name: str, parameters: tuple[str, ...], output: str, as_json: bool) -> int:
    """Draw the figure NAME of SCENE as an SVG file.

    `orderconds list figures` prints the names of all figures. If the scene has no figure of this name, the
    exit status is 2.

    \b
    Examples:
        orderconds figure heavy_top centre -o centre.svg
        orderconds figure dipole orders -o orders.svg
    """
    from codegen import scenes
    from codegen.lab.page.svg import standalone
    from codegen.lab.pictures.registry import draw, find
    from codegen.lab.pictures.source import Source

    problem = scenes.load(scenes.with_values(scene, parameters))
    figure = find(problem, name)
    if not figure.shows_lattices:
        scenes.with_one_system(problem)
    with counting(f"{problem.name}: {figure.name}") as progress:
        drawn = draw(figure, Source(problem, progress))
    put(output, standalone(str(drawn.svg)).encode())
    if as_json:
        caption = " ".join(filter(None, (figure.caption, drawn.note)))
        print_json(
            {
                "scene": problem.name,
                "name": figure.name,
                "title": figure.title,
                "source": figure.source,
                "caption": caption,
                "file": output,
                "numbers": drawn.numbers,
            }
        )
    elif is_shown(True):
        click.echo(f"{figure.title}: {output}")
        if drawn.note:
            click.echo(f"  {drawn.note}")
    return 0
