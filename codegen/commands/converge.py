"""``orderconds converge``: measure the order of emitted integrators."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from codegen.commands.arguments import methods_option, scene_argument, target_names, values_option
from orderconds.commands.names import completing
from orderconds.commands.screen import counting, is_shown, print_json, print_table, working
from orderconds.commands.variadic import Variadic
from orderconds.errors import InputError

if TYPE_CHECKING:
    from codegen.lab.orders.convergence import Convergence, NotEmitted


@click.command("converge", cls=Variadic)
@scene_argument(required=False)
@methods_option(required=True)
@values_option
@click.option(
    "--target",
    "-t",
    help="A target language (see `orderconds list targets`) or the word 'interpreter'; by default 'c'.",
    shell_complete=completing(lambda: (*target_names(), "interpreter")),
)
@click.option(
    "--form",
    help="Form of the equations: 'printed' (the equations of the scene), 'body-matrix' or 'quaternion'. The "
    "default is 'printed'.",
)
@click.option("--steps", multiple=True, help="Numbers of steps, such as 20,40,80,160.")
@click.option("--digits", type=click.IntRange(16, 60), help="Precision of the interpreter in decimal digits.")
@click.option(
    "--protocol",
    type=click.Choice(["strict"]),
    help="The protocol 'strict' measures the order of each method with 50 digits, on built-in scenes. With "
    "--protocol, omit the argument SCENE.",
)
@click.option(
    "--stated",
    type=click.IntRange(1, 20),
    help="The order that is compared with the observed order.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the results as JSON.")
def command(
    scene: str | None,
    methods: tuple[str, ...],
    parameters: tuple[str, ...],
    target: str | None,
    form: str | None,
    steps: tuple[str, ...],
    digits: int | None,
    protocol: str | None,
    stated: int | None,
    as_json: bool,
) -> int:
    """Measure the order of methods on SCENE (a gallery name or a Python file).

    The command compares the observed order of a method with a stated order. The default of --stated is the
    order that the order conditions give. With --protocol strict, the default is the order in the tableau
    file, if the file gives one.

    The exit status is 1 if an observed order differs from the stated order or is undecided, or if a method
    cannot be emitted. A method can converge faster on one scene than on others: a higher observed order is
    accepted if the order conditions give the stated order.

    \b
    Examples:
        orderconds converge free_rigid_body --method cf4 'rkmk(2):rk4'
        orderconds converge driven_spin -m cf4 -P nu=3/2 --target python
        orderconds converge --protocol strict --method cf4
    """
    if (scene is None) != (protocol is not None):
        raise click.UsageError(
            "give either SCENE or --protocol strict; the strict protocol has its own scenes"
        )
    from codegen.scenes import with_values

    chosen = (target, form, digits)
    if scene is None and (steps or parameters or any(option is not None for option in chosen)):
        raise click.UsageError(
            "--protocol strict cannot be used with --target, --steps, --digits, --form or --parameter; the "
            "strict protocol sets the numbers of steps and uses 50 digits"
        )
    results = (
        _by_protocol(methods, stated, as_json)
        if scene is None
        else _on_scene(
            with_values(scene, parameters), methods, target, form, steps, digits or 16, stated, as_json
        )
    )
    if as_json:
        print_json([result.as_json() for result in results])
    return 0 if all(result.verdict == "holds" for result in results) else 1


def _on_scene(
    scene: str,
    methods: tuple[str, ...],
    target: str | None,
    form: str | None,
    steps: tuple[str, ...],
    digits: int,
    stated: int | None,
    as_json: bool,
) -> list[Convergence | NotEmitted]:
    from codegen.lab.orders.scene_convergence import ConvergenceTest

    test = ConvergenceTest.of(
        scene, methods, target=target, form=form, steps=read_steps(steps), digits=digits, stated=stated
    )
    with working("reference solution"):
        exact = test.reference()
    results: list[Convergence | NotEmitted] = []
    for method in test.methods:
        with working(f"compiling {method.label}") as progress:
            results.append(test.result(method, exact, progress))
        if not as_json and is_shown(results[-1].verdict == "holds"):
            show(results[-1], first=len(results) == 1)
    return results


def _by_protocol(
    methods: tuple[str, ...], stated: int | None, as_json: bool
) -> list[Convergence | NotEmitted]:
    from codegen.lab.orders.strict_protocol import stated_order, strict
    from codegen.lower import names
    from codegen.method import parse

    results: list[Convergence | NotEmitted] = []
    for method in [parse(name, names()) for name in methods]:
        with counting(f"{method.label}") as done:
            for result in strict(method, stated_order(method, stated), done):
                results.append(result)
                if not as_json and is_shown(result.verdict == "holds"):
                    click.echo(f"{result.method} on {result.scene}: {result.sentence()}")
    return results


def read_steps(texts: tuple[str, ...]) -> list[int]:
    """Return the numbers of steps in texts such as ``20,40,80``, sorted and without duplicates.

    If a number of steps is not a whole number from 1 to 99999999, :class:`InputError` is raised.

    >>> read_steps(("40,20", "80"))
    [20, 40, 80]
    """
    words = [word.strip() for text in texts for word in text.split(",")]
    for word in words:
        if not (word.isdecimal() and int(word[:9]) > 0 and len(word) < 9):
            expected = "whole numbers from 1 to 99999999, such as 20,40,80,160"
            raise InputError(f"steps {word!r}", where="--steps", expected=expected)
    return sorted({int(word) for word in words})


def show(result: Convergence | NotEmitted, first: bool) -> None:
    """Print a table of the runs of one method, and the verdict on the order of the method.

    If the method cannot be emitted, print the reason instead.
    """
    from codegen.lab.orders.convergence import NotEmitted

    if not first:
        click.echo()
    click.echo(f"{result.method} on {result.scene}, {result.target}")
    if isinstance(result, NotEmitted):
        click.echo(f"  {result.sentence()}")
        return
    runs, clean = result.refinement.runs, result.refinement.clean
    slopes = dict(zip((r.steps for r in clean[1:]), result.refinement.slopes, strict=True))
    rows = [
        [
            str(r.steps),
            f"{r.h:.6g}",
            f"{r.error:.3e}",
            f"{slopes[r.steps]:.3f}" if r.steps in slopes else "",
            r.excluded,
        ]
        for r in runs
    ]
    print_table(["steps", "h", "error", "slope", "excluded"], rows, indent=2)
    click.echo(f"  {result.sentence()}")
