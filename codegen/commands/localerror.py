"""``orderconds localerror``: compute the exact order of an emitted method from the local error of a step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from codegen.commands.arguments import methods_option, scene_argument, values_option
from orderconds.commands.screen import counting, is_shown, print_json, print_table
from orderconds.commands.variadic import Variadic

if TYPE_CHECKING:
    from codegen.lab.orders.exact_order import ExactLocalError, NotExact


@click.command("localerror", cls=Variadic, short_help="Compute the exact order of emitted steps.")
@scene_argument()
@methods_option()
@values_option
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(scene: str, methods: tuple[str, ...], parameters: tuple[str, ...], as_json: bool) -> int:
    """Compute the leading term of the local error of one step on SCENE, with exact coefficients.

    The command computes the state after one emitted step as a power series in the step size h. The power
    series is compared with the Taylor series of the solution. If all computed coefficients are zero at the
    initial state, steps from later points of the solution are examined. The vector field must be a rational
    function of the coordinates. Initial coordinates that are not rational are replaced by nearby rational
    numbers.

    If the exact order is lower than predicted by the order conditions, the exit status is 1. If the exact
    order cannot be computed, the exit status is also 1.

    \b
    Examples:
        orderconds localerror free_rigid_body --method cf4
    """
    from codegen import scenes
    from codegen.lab.default_methods import methods_for
    from codegen.lab.orders.exact_order import local_error_or_reason

    problem = scenes.with_one_system(scenes.load(scenes.with_values(scene, parameters)))
    problem.require_formulas()
    errors = []
    chosen = methods_for(problem, methods)
    with counting("local errors", total=len(chosen)) as done:
        for method in chosen:
            errors.append(local_error_or_reason(problem, method))
            done(method.label)
    if as_json:
        print_json([result.as_json() for result in errors])
    else:
        shown = [result for result in errors if is_shown(result.verdict == "holds")]
        for number, result in enumerate(shown):
            show(result, first=not number)
    return 0 if all(result.verdict == "holds" for result in errors) else 1


def show(result: ExactLocalError | NotExact, first: bool) -> None:
    """Print the leading coefficients of the local error, and the verdict on the method's order.

    If the local error cannot be computed exactly, print the reason instead.
    """
    from codegen.lab.orders.exact_order import ExactLocalError

    if not first:
        click.echo()
    click.echo(f"{result.method} on {result.scene}")
    if isinstance(result, ExactLocalError) and not result.vanishes:
        power = f"coefficient of h^{result.order + 1}"
        rows = [list(row) for row in zip(result.symbols, result.start, result.coefficients, strict=True)]
        value = "initial value" if result.points == 1 else f"value at t = {result.time}"
        print_table(["coordinate", value, power], rows, indent=2)
    click.echo(f"  {result.sentence()}")
