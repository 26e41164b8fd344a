"""``orderconds derive``: print a family's order conditions, as index sums or written out for S stages."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from orderconds.commands import screen

if TYPE_CHECKING:
    from orderconds.derive import Derivation

FORMATS = ("text", "latex", "sympy", "json")


@click.command(name="derive", short_help="Print the independent order conditions of a family.")
@click.argument("family")
@click.option("--order", "-p", type=click.IntRange(1, 20), required=True, help="Highest order.")
@click.option("--stages", "-s", type=click.IntRange(1, 12), help="Write the sums out for this many stages.")
@click.option("--format", "form", type=click.Choice(FORMATS), default="text", show_default=True)
@click.option("--all", "every", is_flag=True, help="Every tree's condition, not only an independent set.")
@click.option("--json", "as_json", is_flag=True, help="The same as --format json.")
def command(family: str, order: int, stages: int | None, form: str, every: bool, as_json: bool) -> int:
    """Print the independent order conditions of FAMILY (rk, vcg, "rkmk(1)", ...) up to an order."""
    from orderconds.derive import derive

    with screen.working(f"deriving {family} to order {order}"):
        derivation = derive(family, order, every=every)
        if stages is not None:
            from orderconds.written_out import write_out

            derivation = write_out(derivation, stages)
    match "json" if as_json else form:
        case "json":
            screen.print_json(derivation.as_json())
        case "latex":
            _print_latex(derivation)
        case "sympy":
            for condition in derivation.conditions:
                click.echo(condition.sympy())
        case _:
            _print_text(derivation)
    return 0


def _print_text(derivation: Derivation) -> None:
    """Print each order with its count, its trees and its equations."""
    click.echo(f"{derivation.family}: {', '.join(map(str, derivation.counts))} conditions of order 1, 2, ...")
    for order, conditions in enumerate(derivation.by_order, start=1):
        click.echo(f"\norder {order}: {len(conditions)} condition{'' if len(conditions) == 1 else 's'}")
        screen.print_table(
            ("tree", "condition"), [(condition.tree, str(condition)) for condition in conditions], indent=2
        )


def _print_latex(derivation: Derivation) -> None:
    r"""Print one ``align*`` environment (package amsmath), the trees as comments."""
    lines = list(_aligned(derivation))
    click.echo("\n".join([r"\begin{align*}", *lines, r"\end{align*}"]))


def _aligned(derivation: Derivation) -> Iterator[str]:
    for number, condition in enumerate(derivation.conditions, start=1):
        left, _, right = condition.latex_equation.rpartition(" = ")
        end = r" \\" if number < len(derivation.conditions) else ""
        yield f"  % order {condition.order}, {condition.tree}"
        yield f"  {left} &= {right}{end}"
