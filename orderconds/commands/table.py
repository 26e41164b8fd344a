"""``orderconds table``: print the tableaux of the library in a Markdown table, or print Butcher tableaux."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypedDict

import click

from orderconds.commands import screen
from orderconds.commands.names import completing, tableau_names
from orderconds.commands.place import put
from orderconds.errors import InputError
from orderconds.input_file import read_text

if TYPE_CHECKING:
    from orderconds.tableau import OrderClaim

BEGIN, END = "<!-- begin: orderconds table -->", "<!-- end: orderconds table -->"
COLUMNS = ("tableau", "format", "orders claimed", "stages", "exponentials", "error norm", "certificate")


@click.command(name="table")
@click.argument("methods", nargs=-1, metavar="[METHOD]...", shell_complete=completing(tableau_names))
@click.option(
    "--write",
    metavar="FILE",
    help="Replace the table in FILE. Comments in FILE mark the beginning and the end of the table.",
)
@click.option(
    "--check", "against", metavar="FILE", help="Exit with status 1 if the table in FILE is out of date."
)
@click.option(
    "--json", "as_json", is_flag=True, help="Print the rows of the table as JSON on stdout and nothing else."
)
def command(methods: tuple[str, ...], write: str | None, against: str | None, as_json: bool) -> int:
    """Print a table with one line for each tableau of the library. The last three columns contain the number
    of exponentials, the norm of the leading error and the certificate of the order. These values belong to
    the family in which the tableau claims the highest order. With --check FILE, the command exits with 1 if
    the table in FILE is out of date.

    For each given METHOD, print its order and its Butcher tableau. METHOD is TABLEAU or FAMILY:TABLEAU.
    TABLEAU is a file, or the name of a tableau of the library. FAMILY is the family in which the order is
    computed. For a commutator-free method or a composition, the Butcher tableau describes the method on
    vector spaces only.

    \b
    Examples:
        orderconds table
        orderconds table "vrkmk(1):kutta3" "vrkmk(2):gauss2"
        orderconds table --check docs/reference/library.md
    """
    if methods:
        if write is not None or against is not None:
            raise click.UsageError("--write and --check concern the whole library; omit the names of methods")
        return _print_methods(methods, as_json)
    texts = {path: _around(path) for path in (write, against) if path is not None}
    rows = list(computed())
    table = "\n".join([BEGIN, *markdown(rows), END])
    status = 0
    for path, (text, before, after) in texts.items():
        new = before + table + after
        if path == write:
            put(path, new.encode())
        elif new != text:
            click.echo(f"{path}: the table is out of date; type:  orderconds table --write {path}", err=True)
            status = 1
    if as_json:
        keys = [column.replace(" ", "_") for column in COLUMNS]
        screen.print_json([dict(zip(keys, cells, strict=True)) for cells in rows])
    elif write is None and against is None:
        click.echo("\n".join(table.splitlines()[1:-1]))
    return status


def _print_methods(methods: Sequence[str], as_json: bool) -> int:
    """Print the order and the Butcher tableau of each method."""
    records = [butcher(method) for method in methods]
    if as_json:
        screen.print_json(records)
        return 0
    for number, record in enumerate(records):
        order = f"order {record['order']} ({record['certificate']})"
        click.echo(("\n" if number else "") + f"{record['method']}, {order}")
        for line in record["tableau"]:
            click.echo(f"  {line}")
    return 0


class Butcher(TypedDict):
    """A method with its order, the certificate of the order, and the lines of its Butcher tableau."""

    method: str
    order: int | None
    certificate: str
    tableau: list[str]


def butcher(method: str) -> Butcher:
    """Return the order and the Butcher tableau of a method.

    ``method`` is TABLEAU or FAMILY:TABLEAU, where TABLEAU is a file or the name of a tableau. Without FAMILY,
    the family with the highest claimed order is used.

    >>> butcher("vrkmk(1):kutta3")["order"], butcher("rkmk(0):kutta3")["order"]
    (3, 2)
    """
    from orderconds.checking import check
    from orderconds.tableau import Tableau
    from orderconds.tableau.butcher_text import butcher_text

    family, _, name = method.rpartition(":")
    tableau = Tableau.load(name)
    lines = butcher_text(tableau)
    main = min(tableau.claims.orders, key=_first, default=None)
    label = family or (main.label if main else None)
    with screen.working(f"checking {method}"):
        own = check(tableau, family=label).orders[0]
    shown = method if family or label is None else f"{label}:{name}"
    return {"method": shown, "order": own.order, "certificate": own.certificate, "tableau": lines}


def computed() -> Iterator[tuple[str, ...]]:
    """Yield the row of the table for each tableau of the library.

    >>> next(computed())[:2]
    ('alexander2', 'rk')
    """
    from orderconds.tableau import available

    for name in available():
        with screen.working(f"checking {name}"):
            yield row(name)


def markdown(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the lines of a Markdown table with the headings :data:`COLUMNS` and the given rows.

    >>> next(markdown([]))
    '| tableau | format | orders claimed | stages | exponentials | error norm | certificate |'
    """
    yield f"| {' | '.join(COLUMNS)} |"
    yield "|" + "---|" * len(COLUMNS)
    for cells in rows:
        yield f"| {' | '.join(cells)} |"


def row(name: str) -> tuple[str, ...]:
    """Return the row for the tableau ``name``. The row has one text for each of the :data:`COLUMNS`.

    >>> row("cf4")
    ('cf4', 'cf', 'cf 4, rk 4, vcf 4', '4', '5', '5.68e-02', 'exact')
    """
    from orderconds.checking import check
    from orderconds.tableau import Tableau, find

    tableau = Tableau.load(find(name))
    best: dict[str, int] = {}
    for claim in tableau.claims.orders:
        best[claim.family] = max(best.get(claim.family, 0), claim.order)
    main = min(tableau.claims.orders, key=_first, default=None)
    report = check(tableau, family=main.label if main else None)
    own = report.orders[0]
    cost = report.work.get(own.family)
    method = tableau.method
    return (
        name,
        tableau.family,
        ", ".join(f"{family} {order}" for family, order in sorted(best.items(), key=lambda x: (-x[1], x[0]))),
        str(getattr(method, "s", None) or len(getattr(method, "stages", ())) or "-"),
        str(cost.exponentials) if cost and cost.exponentials is not None else "-",
        "-" if own.error_norm is None else f"{own.error_norm:.2e}",
        own.certificate,
    )


def _first(claim: OrderClaim) -> tuple[int, bool, int, int]:
    """Return a key that sorts claims by decreasing order. Among claims of equal order, the claims for
    families of Lie group methods come first."""
    from orderconds import families

    family = families.get(claim.label)
    place = families.position(family.name) if family.on_groups else 0
    return -claim.order, not family.on_groups, place, claim.cutoff or 0


def _around(path: str) -> tuple[str, str, str]:
    """Return three texts: the whole file, the part before the table, and the part after the table.

    Raise InputError if the comments that enclose the table are missing.
    """
    text = read_text(path)
    start, end = text.find(BEGIN), text.find(END)
    if not 0 <= start < end:
        raise InputError(
            "cannot find the comments that enclose the table", where=path, expected=f"{BEGIN} and {END}"
        )
    return text, text[:start], text[end + len(END) :]
