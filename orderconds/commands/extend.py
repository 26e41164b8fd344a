"""``orderconds extend``: find a continuous extension of a Runge-Kutta method, for output at times inside a
step."""

from __future__ import annotations

import click

from orderconds.commands import screen
from orderconds.commands.tableau_output import output_format, put_tableau, tableau_output
from orderconds.errors import InputError


@click.command(name="extend")
@click.argument("tableau")
@click.option(
    "--order",
    "-p",
    type=click.IntRange(1, 12),
    help="The order of the extension.  [default: the highest order for which an extension exists]",
)
@tableau_output
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(tableau: str, order: int | None, output: str | None, as_json: bool) -> int:
    """Add a continuous extension to TABLEAU and write the result. TABLEAU is a file, or the name of a tableau
    of the library.

    The extension gives the solution at each time t + theta h inside a step from t to t + h. The weights
    b_i(theta) of the extension are polynomials. The order of the extension is proved.

    The result contains the claims of TABLEAU. The command tests them. If a claim is wrong, the command writes
    nothing and exits with 2.

    Only TOML and JSON files can contain an extension, so the file of the option -o must have the suffix .toml
    or .json.

    \b
    Examples:
        orderconds extend rk4
        orderconds extend mine.toml --order 3 -o mine.toml
    """
    from orderconds.checking import check
    from orderconds.exchange import can_contain
    from orderconds.solve.extension import extended
    from orderconds.tableau import Tableau
    from orderconds.tableau.toml_text import toml_text
    from orderconds.tableau.write import as_data

    to = output_format(output)
    if not can_contain("dense", to):
        raise InputError(
            f"the format {to} cannot contain a continuous extension",
            where=f"--output {output}",
            expected="a file with the suffix .toml or .json",
        )
    extension = extended(Tableau.load(tableau), order)
    data = as_data(extension)
    text = toml_text(data)
    if output is not None:
        put_tableau(output, to, data, text)
    if as_json:
        dense = check(extension).dense
        assert dense is not None
        screen.print_json({"name": extension.name, "dense": dense.as_json(), "file": output, "tableau": text})
    elif output is None:
        click.echo(text, nl=False)
    return 0
