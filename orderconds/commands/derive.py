"""``orderconds derive``: print the order conditions of a family. If the number of stages is given,
the sums over stages are expanded."""

from __future__ import annotations

import io
from contextlib import redirect_stdout
from typing import TYPE_CHECKING

import click

from orderconds.argument import CONDITION_ORDER, EXPANDED_STAGES
from orderconds.commands import screen
from orderconds.commands.names import completing, family_names
from orderconds.commands.place import FILE, put
from orderconds.exit_status import json_text
from orderconds.typeset.counts import sum_of_counts

if TYPE_CHECKING:
    from orderconds.derivation import Derivation

FORMATS = ("text", "latex", "sympy", "json")


@click.command(name="derive")
@click.argument("family", shell_complete=completing(family_names))
@click.option(
    "--order", "-p", type=click.IntRange(*CONDITION_ORDER), required=True, help="The highest order."
)
@click.option(
    "--stages",
    "-s",
    type=click.IntRange(*EXPANDED_STAGES),
    help="Expand the sums over the stages for methods with this number of stages.",
)
@click.option(
    "--explicit",
    is_flag=True,
    help="Expand the sums for explicit methods, where a_ij = 0 for j >= i. This option requires --stages.",
)
@click.option("--format", "form", type=click.Choice(FORMATS), help="The output format. Default: text.")
@click.option(
    "--all",
    "every",
    is_flag=True,
    help="Print the conditions of all trees, and state how the dependent conditions follow from the "
    "independent ones.",
)
@click.option("--explain", is_flag=True, help="Draw each tree and name its elementary differential.")
@click.option("--output", "-o", type=FILE, metavar="FILE", help="Write to this file instead of stdout.")
@click.option(
    "--json",
    "as_json",
    is_flag=True,
    help="The same as --format json. If --output is given, the JSON is also written to stdout.",
)
def command(
    family: str,
    order: int,
    stages: int | None,
    explicit: bool,
    form: str | None,
    every: bool,
    explain: bool,
    output: str | None,
    as_json: bool,
) -> int:
    """Print the independent order conditions of FAMILY (rk, vcg, "rkmk(1)", ...) up to the given order.

    With --format latex, the equations have numbers and labels, and fit into a two-column article.

    \b
    Examples:
        orderconds derive vcg --order 3
        orderconds derive rk --order 4 --stages 4 --explicit
        orderconds derive cf --order 4 --format latex -o conditions.tex
    """
    from orderconds.derivation import derive

    if explicit and stages is None:
        raise click.UsageError("--explicit has no effect without --stages; give --stages S too")
    if as_json and form not in (None, "json"):
        raise click.UsageError(f"--json and --format {form} select two output formats; omit one of them")
    if explain and form == "sympy":
        raise click.UsageError("--explain has no effect with --format sympy; omit one of them")
    with screen.working(f"deriving {family} to order {order}"):
        derivation = derive(family, order, stages, explicit=explicit, every=every)
    chosen = "json" if as_json else form or "text"
    if output is not None:
        put(output, _text(derivation, chosen, explain).encode())
    if output is None or as_json:
        _print(derivation, chosen, explain)
    return 0


def _text(derivation: Derivation, form: str, explain: bool) -> str:
    """Return the conditions of a derivation as text. ``form`` is one of :data:`FORMATS`."""
    if form == "json":
        return json_text(_record(derivation, explain)) + "\n"
    with redirect_stdout(io.StringIO()) as printed:
        _print(derivation, form, explain)
    return printed.getvalue()


def _print(derivation: Derivation, form: str, explain: bool) -> None:
    """Print the conditions of a derivation."""
    match form:
        case "json":
            screen.print_json(_record(derivation, explain))
        case "latex":
            from orderconds.typeset.article import article

            click.echo(article(derivation.family, derivation.by_order, explain=explain))
        case "sympy":
            for condition in derivation.conditions:
                click.echo(condition.sympy())
        case _:
            _print_text(derivation, explain)


def _print_text(derivation: Derivation, explain: bool) -> None:
    """Print the number of conditions of each order, and the tree and the equation of each condition."""
    click.echo(f"{derivation.family}: {sum_of_counts(derivation.counts)}")
    for order, conditions in enumerate(derivation.by_order, start=1):
        click.echo(f"\norder {order}: {len(conditions)} condition{'' if len(conditions) == 1 else 's'}")
        if explain:
            _print_entries(derivation, order)
            continue
        columns: tuple[str, ...] = ("tree", "condition")
        rows: list[tuple[str, ...]] = [(condition.tree, str(condition)) for condition in conditions]
        if any(condition.relation is not None for condition in conditions):
            columns += ("equals",)
            rows = [(*row, c.relation or "") for row, c in zip(rows, conditions, strict=True)]
        screen.print_table(columns, rows, indent=2)
    if derivation.remark:
        click.echo(f"\n{derivation.remark}")


def _print_entries(derivation: Derivation, order: int) -> None:
    """Print the conditions of one order, and explain the tree of each condition."""
    from orderconds.explain import kinds

    kind = kinds.of_family(derivation.family)
    for condition in derivation.by_order[order - 1]:
        lines = (
            [condition.tree, f"    condition  {condition}"]
            if kind is None
            else kind.entry(condition.key, condition, screen.drawing_style())
        )
        click.echo("\n".join(f"  {line}" for line in lines))


def _record(derivation: Derivation, explain: bool) -> dict[str, object]:
    """Return the JSON object of a derivation, with elementary differentials if ``explain`` is true."""
    record: dict[str, object] = derivation.as_json()
    if explain:
        from orderconds.explain.kinds import named_by

        record["conditions"] = [{**c.as_json(), "names": named_by(c)} for c in derivation.conditions]
    return record
