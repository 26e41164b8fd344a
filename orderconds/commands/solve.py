"""``orderconds solve``: find a method of a family, prove its order, and write its tableau."""

from __future__ import annotations

import os
import re
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from orderconds.argument import EXPONENTIALS, PROCESSES, SEED, SOLVED_ORDER, SOLVED_STAGES, STARTS
from orderconds.commands import screen
from orderconds.commands.names import completing, family_names
from orderconds.commands.place import FILE, put
from orderconds.commands.tableau_output import output_format, put_tableau, tableau_output
from orderconds.errors import InputError

if TYPE_CHECKING:
    from orderconds.solve.elimination import Infeasible
    from orderconds.solve.solver import Order, Outcome


@click.command(name="solve")
@click.argument("family", shell_complete=completing(family_names))
@click.option(
    "--stages",
    "-s",
    type=click.IntRange(*SOLVED_STAGES),
    required=True,
    help="The number of stages. If FAMILY is composition: the number of steps of the base method. If FAMILY "
    "is splitting (of a vector field T + V): the number of flows of V in one step.",
)
@click.option(
    "--order", "-p", type=click.IntRange(*SOLVED_ORDER), required=True, help="The order of the method."
)
@click.option(
    "--low-storage",
    is_flag=True,
    help="Search only for low-storage schemes with two registers K and Y. For the equation Y' = F(Y) Y, "
    "stage i computes K <- A_i K + F(Y), then Y <- exp(h B_i K) Y.",
)
@click.option("--explicit", is_flag=True, help="Search only for explicit methods: a_ij = 0 for j >= i.")
@click.option("--dirk", is_flag=True, help="Search only for diagonally implicit methods: a_ij = 0 for j > i.")
@click.option(
    "--symmetric",
    is_flag=True,
    help="Search only for symmetric methods. A method is symmetric if a step of length -h undoes a step of "
    "length h. For Lie group methods with a Butcher tableau, the option applies to the Runge-Kutta method of "
    "the tableau. The Lie group method itself may not be symmetric.",
)
@click.option(
    "--fsal",
    is_flag=True,
    help="Search only for FSAL methods (first same as last): the last stage of a step is the first stage of "
    "the next step.",
)
@click.option(
    "--fix",
    multiple=True,
    metavar="a21=1/2",
    help="Require a linear equation between coefficients. If the method has a Butcher tableau, the "
    "equation may contain the nodes c_i. The option may be repeated.",
)
@click.option(
    "--positive",
    multiple=True,
    metavar="NAME",
    help="The name of a coefficient that must be positive; the name b denotes all weights.",
)
@click.option("--size", metavar="X", help="An upper bound for the absolute values of all coefficients.")
@click.option(
    "--exponentials",
    type=click.IntRange(*EXPONENTIALS),
    default=2,
    show_default=True,
    help="For the families cf and vcf: the number of exponentials in the update.",
)
@click.option(
    "--inner",
    type=click.IntRange(*EXPONENTIALS),
    default=2,
    show_default=True,
    help="For the families cf and vcf: the number of exponentials in each stage. With --symmetric, a stage "
    "can have more exponentials.",
)
@click.option(
    "--rkn",
    is_flag=True,
    help="For the family splitting: assume that the vector field is a sum T + V with "
    "[V,[V,[V,T]]] = 0. Equations q'' = g(q) have this property.",
)
@click.option(
    "--minimise",
    type=click.Choice(["error"]),
    help="Search from all random starts, and write the method with the least principal error. This error is "
    "the norm of the residuals of the order conditions of order p + 1, where p is the order of the method.",
)
@click.option(
    "--starts",
    type=click.IntRange(*STARTS),
    help="The number of random starts. If the search tries several parametrisations of the coefficients, "
    "the search uses this number of starts for each parametrisation.  "
    "[default: 4096, or 1024 if --minimise is given]",
)
@click.option("--seed", type=click.IntRange(*SEED), default=0, show_default=True)
@click.option(
    "--processes",
    type=click.IntRange(*PROCESSES),
    help="The number of local processes.  [default: one for each processor]",
)
@click.option(
    "--dask",
    metavar="ADDRESS",
    help="Run the search on the dask cluster with the scheduler at tcp://host:port.",
)
@click.option("--name", default="found", show_default=True, help="The name of the new tableau.")
@tableau_output
@click.option(
    "--checkpoint",
    type=FILE,
    metavar="FILE",
    help="Save the results of finished random starts to this file.  [default: OUT.search if -o OUT is given]",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(family: str, output: str | None, as_json: bool, **options: Any) -> int:
    """Find a method of FAMILY, prove its order, and write its tableau.

    Exits with 0 if a method was found and its order was proved. Exits with 1 if no method was found, or if
    the command proved that no method exists. Exits with 2 if options contradict each other. For a given seed,
    the result does not depend on the number of processes.

    If a search is interrupted, repeat the command to continue the search from the file of
    --checkpoint.

    The format on stdout is TOML. Only TOML and JSON files can contain the proof of the order. For all other
    formats, the command prints a note that the output does not contain this proof.

    \b
    Examples:
        orderconds solve rk --stages 3 --order 3 --explicit --fix c2=1/2 --fix c3=1
        orderconds solve vcg --stages 3 --order 3 --minimise error -o mine.toml
    """
    # With several threads, the results could depend on the number of processor cores.
    for library in ("OPENBLAS", "OMP", "MKL"):
        os.environ[f"{library}_NUM_THREADS"] = "1"
    from orderconds.solve.solver import solve

    to = _format(family, output)
    order = _order(family, output, options)
    try:
        with screen.working(f"searching {family}") as report:
            outcome = solve(order, report)
    except KeyboardInterrupt as interrupt:
        path = order.checkpoint
        if path is not None and path.exists():
            interrupt.add_note(
                f"the results of the finished random starts are saved in {path}; to continue "
                f"the search, repeat the command"
            )
        raise
    if outcome.solution is not None and output is not None:
        _put(output, to, outcome.solution.text)
    if as_json:
        screen.print_json(_record(order, outcome, output))
    else:
        _print(order, outcome, output)
    return 0 if outcome.solution is not None else 1


def _format(family: str, output: str | None) -> str:
    """Return the format of the output file.

    Raise InputError before the search if the format cannot represent a method of the family.
    """
    from orderconds import families
    from orderconds.exchange import COMPLETE
    from orderconds.tableau.formats import FORMATS

    to = output_format(output)
    if to not in COMPLETE and not any(FORMATS[name].in_arrays for name in families.get(family).formats):
        raise InputError(
            f"the format {to} cannot represent methods of the family {family}",
            where=f"--output {output}",
            expected="a file with the suffix .toml or .json",
        )
    return to


def _put(output: str, to: str, text: str) -> None:
    """Write the tableau with the TOML text ``text`` to the output file.

    If the tableau cannot be written in the format ``to``, write a TOML file and raise InputError. Without the
    TOML file, the result of a search of several hours could be lost.
    """
    from orderconds.tableau.file import parsed

    try:
        put_tableau(output, to, parsed(text, output), text)
    except InputError as problem:
        if to != "toml":
            put(f"{output}.toml", text.encode())
            problem.hint = f"the method was written to the file {output}.toml"
        raise


def _order(family: str, output: str | None, options: dict[str, Any]) -> Order:
    from orderconds import families
    from orderconds.explain.kinds import refuse_too_many_trees
    from orderconds.solve.solver import Order
    from orderconds.solve.spec import Spec
    from orderconds.tableau.file import verify_name

    # An invalid name is refused before the search, because a search may take hours.
    verify_name(options["name"], "--name")
    # Let p be ``options["order"]``. This test counts only the trees up to order p - 1, because not every
    # search needs the trees of order p. If p is even, a search for symmetric methods does not need these
    # trees, because each symmetric method of order p - 1 also has order p.
    refuse_too_many_trees(families.get(family), options["order"] - 1)
    spec = Spec(
        **{key: options[key] for key in ("stages", "explicit", "dirk", "symmetric", "fsal", "rkn")},
        **{key: options[key] for key in ("low_storage", "fix", "positive", "exponentials", "inner")},
        size=_size(options["size"]),
    )
    device = output is not None and Path(output).exists() and not Path(output).is_file()
    path = options["checkpoint"] or (f"{output}.search" if output and not device else None)
    for given, option in ((output, "--output"), (path, "--checkpoint")):
        if given is not None and not Path(given).absolute().parent.is_dir():
            raise InputError(
                "no such folder", where=f"{option} {given}", expected="a file in an existing folder"
            )
    # If a symbolic link points to itself, Path.resolve raises a RuntimeError. os.path.realpath does not.
    if output and path and os.path.realpath(output) == os.path.realpath(path):
        raise InputError(
            "--checkpoint and --output name the same file",
            where=f"--checkpoint {path}",
            expected="a different file",
        )
    return Order(
        family,
        options["order"],
        spec,
        seed=options["seed"],
        minimised=options["minimise"] is not None,
        starts=options["starts"],
        processes=options["processes"] or os.cpu_count() or 1,
        cluster=options["dask"],
        checkpoint=Path(path) if path else None,
        name=options["name"],
    )


def _size(text: str | None) -> Fraction | None:
    if text is None:
        return None
    # A number with a long exponent could fill the memory.
    number = r"\d{1,20}(/\d{1,20}|\.\d{0,20})?([eE][+-]?\d{1,2})?"
    try:
        size = Fraction(text) if re.fullmatch(number, text, re.ASCII) else Fraction(0)
    except (ValueError, ZeroDivisionError):
        # The pattern also matches texts that are not numbers, for example 1/0.
        size = Fraction(0)
    if size <= 0:
        raise InputError(repr(text), where="--size", expected="a positive number such as 2 or 3/2")
    return size


def _record(order: Order, outcome: Outcome, output: str | None) -> dict[str, object]:
    verdict = "found" if outcome.solution else "infeasible" if outcome.none else "nothing found"
    record: dict[str, object] = {"verdict": verdict, "family": order.family, "order": order.order}
    record |= {"stages": order.spec.stages, "seed": order.seed, "command": order.command()}
    if outcome.none is not None:
        return {**record, "proof": outcome.none.as_json()}
    record |= {"tried": outcome.tried, "best_residual": outcome.best}
    if outcome.solution is not None:
        record |= {
            "certificate": outcome.solution.certificate,
            "error_norm": outcome.solution.error,
            "file": output,
            "tableau": outcome.solution.text,
        }
    return record


def _print(order: Order, outcome: Outcome, output: str | None) -> None:
    if outcome.none is not None:
        _print_proof(order, outcome.none)
    elif outcome.solution is None:
        click.echo(
            f"orderconds: no {order.family} method of order {order.order} with {_stages(order)} was "
            f"found and proved; the least residual norm is {outcome.best:.3g}",
            err=True,
        )
        for line in outcome.tried:
            click.echo(f"  tried {line}", err=True)
    elif output is None:
        click.echo(outcome.solution.text, nl=False)
    else:
        error = "" if outcome.solution.error is None else f", principal error {outcome.solution.error:.6g}"
        click.echo(
            f"{output}: family {order.family}, order {order.order}, certificate: "
            f"{outcome.solution.certificate}{error}"
        )


def _stages(order: Order) -> str:
    return f"{order.spec.stages} stage" + ("" if order.spec.stages == 1 else "s")


def _print_proof(order: Order, proof: Infeasible) -> None:
    options = order.restrictions()
    restricted = f" and the options {options}" if options else ""
    assumed = " and the following properties" if proof.assumptions else ""
    methods = f"{order.family} method with {_stages(order)}{restricted}{assumed}"
    click.echo(f"no {methods} has order {order.order}:")
    for assumption in proof.assumptions:
        click.echo(f"  - {assumption}")
    if proof.assumptions:
        click.echo("proof:")
    for condition, equation, multiplier in zip(
        proof.conditions, proof.equations, proof.multipliers, strict=True
    ):
        click.echo(f"  {condition}")
        click.echo(f"    ({multiplier}) * ({equation})")
    click.echo("if all conditions hold, every product above is zero, and the sum of the products is zero;")
    click.echo(f"but the sum of the products is the polynomial {proof.consequence}, and {proof.reason}")
