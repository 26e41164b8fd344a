"""``orderconds refine``: make the coefficients of a tableau exact or more precise."""

from __future__ import annotations

from collections.abc import Sequence

import click
from click.core import ParameterSource

from orderconds.argument import DIGITS
from orderconds.commands import screen
from orderconds.commands.tableau_output import output_format, put_tableau, tableau_output
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
    help="The number of decimal places of the new coefficients. This option has no effect if FILE has no "
    "[proof] table.",
)
@tableau_output
@click.option(
    "--json",
    "as_json",
    is_flag=True,
    help="Print one JSON record on stdout. It contains the new coefficients and the proof. The proof is null "
    "if FILE has no [proof] table.",
)
def command(file: str, digits: int, output: str | None, as_json: bool) -> int:
    """Make the coefficients of FILE exact or more precise.

    If FILE has a [proof] table, solve the equations of this table. The unknowns are the rounded
    decimals of the file, such as "0.8177~". The table [proof.printed] of the new file contains the original
    digits. If there are more unknowns than equations, some decimals do not change. The list `pins` in the
    [proof] table of the new file contains the names of these decimals.

    If FILE has no [proof] table, replace binary floats and rounded decimals by nearby fractions or numbers
    p + q sqrt(d), where p, q and d are rational. The order of the method does not change.

    The format on stdout is TOML. Only TOML and JSON files can contain the proof and the continuous extension.
    For other formats, the command prints a note about each omitted key.

    The new file contains the claims of FILE. The command tests them with the new coefficients. If a claim
    is wrong, the command writes nothing.

    Exits with 0 if new coefficients were found. Exits with 1 if no new coefficients were found, if the
    proof failed, or if a claim is wrong. Exits with 2 if the file cannot be read.

    \b
    Examples:
        orderconds refine mine.toml --digits 100 -o mine.toml
        orderconds refine mine.npz -o exact.toml
    """
    from orderconds.checking import read

    to = output_format(output)
    tableau = read(file)
    if tableau.proof is None:
        _note_digits(file)
        return _exact(tableau, output, to, as_json)
    from orderconds.checking.refuted import refuted_claims
    from orderconds.proof.certificate import certify
    from orderconds.proof.krawczyk import NotProved
    from orderconds.proof.refine import refine
    from orderconds.tableau.file import parsed, text_of

    text = text_of(file) if file.endswith(".toml") else dumps(tableau)
    try:
        with screen.working(f"refining {file}"):
            refined = refine(text, file, digits)
            new = Tableau.loads(refined.text, file)
            proof = certify(new)
            refuted = refuted_claims(new)
    except NotProved as problem:
        return _failed(file, f"no proof: {problem}", "decimals", as_json, str(problem))
    if refuted:
        return _failed(file, _wrong(refuted), "decimals", as_json)
    if output is not None:
        put_tableau(output, to, parsed(refined.text, file), refined.text)
    if as_json:
        screen.print_json({"decimals": refined.decimals, "proof": proof.as_json()})
    elif output is None:
        # The text is written in UTF-8, even if the terminal has another encoding.
        click.echo(refined.text.encode(), nl=False)
    return 0


def _note_digits(file: str) -> None:
    """Print a note on stderr if the command line contains ``--digits``, which needs a ``[proof]`` table."""
    if click.get_current_context().get_parameter_source("digits") is ParameterSource.COMMANDLINE:
        click.echo(
            f"note: {file} has no [proof] table, so --digits has no effect; the new coefficients are exact",
            err=True,
        )


def _exact(tableau: Tableau, output: str | None, to: str, as_json: bool) -> int:
    """Write the tableau with exact coefficients, and return the exit status."""
    from orderconds.checking.exact_forms import exact_forms
    from orderconds.checking.refuted import refuted_claims
    from orderconds.exchange import export

    with screen.working(f"refining {tableau.path}"):
        forms = exact_forms(tableau)
        refuted = () if forms is None else refuted_claims(forms.tableau)
    if forms is None:
        exact = tableau.file is not None and not tableau.file.symbolic.decimals()
        reason = "all coefficients are exact already" if exact else UNKNOWN
        return _failed(str(tableau.path), reason, "exact", as_json)
    if refuted:
        return _failed(str(tableau.path), _wrong(refuted), "exact", as_json)
    if output is not None:
        put_tableau(output, to, forms.data)
    if as_json:
        screen.print_json({"exact": forms.texts, "proof": None})
    elif output is None:
        click.echo(export(forms.data, "toml"), nl=False)
    return 0


def _wrong(refuted: Sequence[str]) -> str:
    return f"a claim of the file is wrong: {'; '.join(refuted)}; correct the claim and repeat the command"


def _failed(file: str, message: str, key: str, as_json: bool, reason: str | None = None) -> int:
    """Print why there are no new coefficients, and return the exit status 1.

    ``key`` is the key of the new coefficients in the JSON record. The record also contains the text
    ``reason``, or ``message`` if ``reason`` is None.
    """
    click.echo(f"orderconds: {file}: {message}", err=True)
    if as_json:
        screen.print_json({key: {}, "proof": None, "reason": reason or message})
    return 1
