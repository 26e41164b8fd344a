"""``orderconds refine``: make the coefficients of a tableau exact or more precise."""

from __future__ import annotations

import click

from orderconds.argument import DIGITS
from orderconds.commands import screen
from orderconds.commands.place import FILE, put
from orderconds.tableau import Tableau, dumps

UNKNOWN = (
    "no exact method of this order was found near the given coefficients; only fractions and "
    "numbers p + q sqrt(d) with rational p, q and d were tried"
)


@click.command(name="refine")
@click.argument("file", metavar="FILE")
@click.option(
    "--digits",
    type=click.IntRange(*DIGITS),
    default=60,
    show_default=True,
    help="The number of decimal places of the new coefficients.",
)
@click.option("--output", "-o", type=FILE, metavar="FILE", help="Write to this file instead of stdout.")
@click.option(
    "--json",
    "as_json",
    is_flag=True,
    help="Print one JSON record on stdout. It contains the new coefficients and the proof.",
)
def command(file: str, digits: int, output: str | None, as_json: bool) -> int:
    """Make the coefficients of FILE exact or more precise.

    If FILE has a [proof] table, solve the equations of this table. The unknowns are the rounded
    decimals of the file, such as "0.8177~". The table [proof.printed] of the new file contains the original
    digits. If there are more unknowns than equations, some decimals do not change. The list `pins` in the
    [proof] table of the new file contains the names of these decimals.

    If FILE has no [proof] table, replace binary floats and rounded decimals by nearby fractions or numbers
    p + q sqrt(d), where p, q and d are rational. The order of the method does not change. The suffix of
    the output file determines the format. The format on stdout is TOML.

    Exits with 0 if new coefficients were found. Exits with 1 if no new coefficients were found, or if the
    proof failed. Exits with 2 if the file cannot be read.

    \b
    Examples:
        orderconds refine mine.toml --digits 100 -o mine.toml
        orderconds refine mine.npz -o exact.toml
    """
    from orderconds.checking import read

    tableau = read(file)
    if tableau.proof is None:
        return _exact(tableau, output, as_json)
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved
    from orderconds.proof.refine import refine
    from orderconds.tableau.file import text_of

    text = text_of(file) if file.endswith(".toml") else dumps(tableau)
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
        # The text is written in UTF-8, even if the terminal has another encoding.
        click.echo(refined.text.encode(), nl=False)
    return 0


def _exact(tableau: Tableau, output: str | None, as_json: bool) -> int:
    """Write the tableau with exact coefficients, and return the exit status."""
    from orderconds.checking.exact_forms import exact_forms
    from orderconds.exchange import export, format_of

    with screen.working(f"refining {tableau.path}"):
        forms = exact_forms(tableau)
    if forms is None:
        exact = tableau.file is not None and not tableau.file.symbolic.decimals()
        reason = "all coefficients are exact already" if exact else UNKNOWN
        click.echo(f"orderconds: {tableau.path}: {reason}", err=True)
        if as_json:
            screen.print_json({"exact": {}, "proof": None, "reason": reason})
        return 1
    content = export(forms.data, "toml" if output is None else format_of(output))
    if output is not None:
        put(output, content)
    if as_json:
        screen.print_json({"exact": forms.texts, "proof": None})
    elif output is None:
        click.echo(content, nl=False)
    return 0
