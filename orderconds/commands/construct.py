"""``orderconds construct``: write the tableau of a Gauss, Radau or Lobatto method."""

from __future__ import annotations

from dataclasses import replace

import click

from orderconds.argument import CONSTRUCTED_STAGES
from orderconds.commands import screen
from orderconds.commands.tableau_output import output_format, put_tableau, tableau_output


@click.command(name="construct")
@click.argument("kind")
@click.option(
    "--stages", "-s", type=click.IntRange(*CONSTRUCTED_STAGES), required=True, help="The number of stages."
)
@tableau_output
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(kind: str, stages: int, output: str | None, as_json: bool) -> int:
    """Write the tableau of a method of the given KIND, with exact coefficients. KIND is gauss, radau1a,
    radau2a, lobatto3a, lobatto3b, lobatto3c, lobatto3c_star, lobatto3d or lobatto3e.

    \b
    Examples:
        orderconds construct gauss --stages 3
        orderconds construct lobatto3d --stages 4 -o mine.toml
    """
    from orderconds.tableau.collocation import KINDS, construct
    from orderconds.tableau.toml_text import toml_text
    from orderconds.tableau.write import as_data

    to = output_format(output)
    tableau = construct(kind, stages)
    name = f"{KINDS[kind].called}, {stages} {'stage' if stages == 1 else 'stages'}"
    data = as_data(replace(tableau, source=f"{name}: orderconds construct {kind} --stages {stages}"))
    text = toml_text(data)
    if output is not None:
        put_tableau(output, to, data, text)
    if as_json:
        record = {"name": tableau.name, "kind": kind, "stages": stages, "order": KINDS[kind].order(stages)}
        screen.print_json({**record, "tableau": text})
    elif output is None:
        click.echo(text, nl=False)
    return 0
