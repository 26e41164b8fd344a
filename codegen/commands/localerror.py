"""``orderconds localerror``: the exact order of emitted steps from their local errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from orderconds.commands.screen import print_json, print_table, working
from orderconds.commands.variadic import Variadic

if TYPE_CHECKING:
    from codegen.lab.orders.exact_order import ExactLocalError


@click.command("localerror", cls=Variadic, short_help="Compute the exact order of emitted steps.")
@click.argument("scene")
@click.option("--method", "-m", "methods", multiple=True, help="TABLEAU or FAMILY:TABLEAU; may be repeated.")
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(scene: str, methods: tuple[str, ...], as_json: bool) -> int:
    """Compute the leading term of the local error of one step on SCENE, with exact coefficients.

    The step program runs over power series in h with exact coefficients and is compared with the Taylor
    series of the solution. The field must be a rational function of the coordinates. Initial coordinates
    that are not rational are replaced by nearby rational numbers. The exit status is 1 if the exact order is
    below the order that the order conditions state.
    """
    from codegen import scenes
    from codegen.lab.default_methods import methods_for
    from codegen.lab.orders.exact_order import exact_local_error

    problem = scenes.load(scene)
    errors = []
    with working("local errors") as progress:
        for method in methods_for(problem, methods):
            progress(method.label)
            errors.append(exact_local_error(problem, method))
    if as_json:
        print_json([result.as_json() for result in errors])
    else:
        for number, result in enumerate(errors):
            show(result, first=not number)
    return 0 if all(result.verdict == "holds" for result in errors) else 1


def show(result: ExactLocalError, first: bool) -> None:
    """Print the leading coefficients as a table with the verdict below it."""
    if not first:
        click.echo()
    click.echo(f"{result.method} on {result.scene}")
    if not result.vanishes:
        power = f"coefficient of h^{result.order + 1}"
        rows = [list(row) for row in zip(result.symbols, result.start, result.coefficients, strict=True)]
        print_table(["coordinate", "initial value", power], rows, indent=2)
    click.echo(f"  {result.sentence()}")
