"""``orderconds refine``: more digits for the rounded decimals of a tableau, and their proof."""

from __future__ import annotations

import click

from orderconds.commands import screen
from orderconds.commands.place import FILE, put


@click.command(name="refine", short_help="Compute more digits of a tableau's decimals and prove them.")
@click.argument("file", metavar="FILE")
@click.option(
    "--digits", type=click.IntRange(10, 1000), default=60, show_default=True, help="Decimal places to write."
)
@click.option("--output", "-o", type=FILE, metavar="FILE", help="Write to this file instead of stdout.")
@click.option("--json", "as_json", is_flag=True, help="Print digits, fixed decimals and proof as JSON.")
def command(file: str, digits: int, output: str | None, as_json: bool) -> int:
    """Solve the equations that the [proof] table of FILE names. Newton's method starts at the rounded
    decimals ("0.8177~") of the file. Write the file again with more digits, a list of the decimals that were
    kept fixed (pins), and a record of the old digits.

    Exits with 0 if interval arithmetic proves the new digits, 1 if not, 2 for a file that cannot be read.

    \b
    Examples:
        orderconds refine mine.toml --digits 100 -o mine.toml
    """
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved
    from orderconds.proof.refine import refine
    from orderconds.tableau import Tableau
    from orderconds.tableau.file import text_of

    text = text_of(file)
    try:
        with screen.working(f"refining {file}"):
            refined = refine(text, file, digits)
            proof = certify(Tableau.loads(refined.text, file))
    except NotProved as problem:
        click.echo(f"orderconds: {file}: no proof: {problem}", err=True)
        if as_json:
            screen.print_json({"decimals": {}, "proof": None, "reason": str(problem)})
        return 1
    if output is not None:
        put(output, refined.text.encode())
    if as_json:
        screen.print_json({"decimals": refined.decimals, "proof": proof.as_json()})
    elif output is None:
        click.echo(refined.text.encode(), nl=False)  # the output file is UTF-8 even if the terminal is not
    return 0
