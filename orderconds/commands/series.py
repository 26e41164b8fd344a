"""``orderconds series``: print the BCH, Magnus and dexp series as sums of brackets."""

from __future__ import annotations

import click

from orderconds.commands import screen


@click.command(name="series")
@click.argument("name")
@click.option(
    "--order",
    "-p",
    type=click.IntRange(1, 14),
    required=True,
    help="The largest weight of the printed brackets. The weight of a bracket is the number of its factors. "
    "In the Magnus series of X1 + t X2 + t^2 X3 + ..., X2 counts as two factors, X3 as three, and so on.",
)
@click.option(
    "--basis",
    type=click.Choice(["lyndon", "hall"]),
    default="lyndon",
    show_default=True,
    help="The basis of the free Lie algebra: bracketed Lyndon words, or a Hall basis.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(name: str, order: int, basis: str, as_json: bool) -> int:
    """Print the Lie series NAME as a sum of brackets [x, y] = x y - y x, with exact coefficients.

    \b
    bch            log(exp A exp B)
    symmetric-bch  log(exp(A/2) exp(B) exp(A/2))
    magnus         log Y(1) for Y' = (X1 + t X2 + t^2 X3 + ...) Y and Y(0) = 1
    dexp           dexp_U(X) = sum_k ad_U^k X/(k+1)!, where ad_U X = [U, X]
    dexpinv        the inverse of dexp_U, applied to X

    \b
    Examples:
        orderconds series bch --order 5
        orderconds series bch --order 4 --basis hall
        orderconds series magnus --order 5 --json
    """
    from orderconds.explain.differentials import commutator
    from orderconds.words.lie_series import lie_terms, named_series

    summary = named_series(name).summary
    with screen.working(f"expanding {name} to order {order}"):
        terms = lie_terms(name, order, basis)
    rows = [(term.weight, commutator(term.bracket, str), str(term.coefficient)) for term in terms]
    if as_json:
        records = [{"weight": n, "bracket": text, "coefficient": x} for n, text, x in rows]
        screen.print_json({"series": name, "order": order, "basis": basis, "terms": records})
        return 0
    click.echo(f"{name}: {summary}")
    screen.print_table(
        ("weight", "coefficient", "bracket"), [(str(n), x, text) for n, text, x in rows], indent=2
    )
    return 0
