"""``orderconds trees``: enumerate, count, draw and explain the trees, forests or words of a given order."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from orderconds.argument import TREE_ORDER
from orderconds.commands import screen
from orderconds.commands.place import FILE, put

if TYPE_CHECKING:
    from orderconds.explain.kinds import Kind


@click.command(name="trees")
@click.argument("kind")
@click.option(
    "--order",
    "-p",
    type=click.IntRange(*TREE_ORDER),
    required=True,
    help="The number of vertices, or the weight of a word.",
)
@click.option("--count", is_flag=True, help="Print only the number of trees or words.")
@click.option("--draw", is_flag=True, help="Draw each tree or word.")
@click.option(
    "--explain",
    is_flag=True,
    help="For each tree or word, show a drawing, the elementary differential and the order condition.",
)
@click.option("--ascii", "plain", is_flag=True, help="Draw with ASCII characters only.")
@click.option("--svg", type=FILE, metavar="FILE", help="Write all drawings to this file as SVG.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(
    kind: str, order: int, count: bool, draw: bool, explain: bool, plain: bool, svg: str | None, as_json: bool
) -> int:
    """Enumerate the trees or words of one KIND and a given order.

    \b
    rooted       rooted trees, unordered                       rk
    ordered      ordered (planar) rooted trees                 cg, cf, rkmk
    forests      words of ordered trees                        cg, cf, rkmk
    lyndon       Lyndon words of ordered trees                 cg, cf, rkmk
    bicoloured   rooted trees with vertices of two colours     prk
    free         free (unrooted) trees                         symplectic_rk
    essential    free trees without two equal halves           symplectic_rk
    directed     free trees whose edges have a direction       sprk
    directed-rooted  rooted trees with directed edges          prk_same_weights
    alternating  free trees with vertices of two colours       sprk_separable
    action       action trees of variational methods           vcg, vcf, vrkmk
    graded       Lyndon words; letter k has the weight k       composition, magnus
    letters      Lyndon words of letters A and B               splitting

    The last column lists families of methods. Each tree or word gives one order condition of these methods.
    In an alternating tree, each edge joins two vertices of different colours. A tree has two equal halves if
    the removal of one edge leaves two equal trees.

    In text drawings, the root is in the first line. In pictures (--svg), the root is at the bottom.

    In a tree with directed edges, each dot is a derivative of the Hamiltonian H. Each edge that begins at a
    dot differentiates H once with respect to the position. Each edge that ends at a dot differentiates H once
    with respect to the momentum. The momentum is p, or mu on a Lie group.

    The vertices of an action tree are dots and diamonds. A diamond denotes a coadjoint action on mu. With
    --ascii, a dot is drawn as o and a diamond is drawn as L. All edges at a diamond begin at the diamond.

    In a text drawing, a note such as (>*>) can follow a vertex. The note lists edges of this vertex from
    left to right. The sign > is an edge to a child. The sign * is the edge to the parent.

    \b
    Examples:
        orderconds trees rooted --order 4 --draw
        orderconds trees ordered --order 12 --count
    """
    from orderconds.explain import kinds
    from orderconds.explain.enumeration import trees

    chosen = kinds.get(kind)
    _refuse_idle_options(count, draw, explain, plain, svg, as_json)
    if not count or svg is not None:
        members = trees(kind, order)  # Raises an error for an order with too many trees.
    if svg is not None:
        put(svg, members.svg(explain=explain).encode())
    if as_json:
        screen.print_json(_record(kind, chosen, order, count, draw, explain, plain))
    elif count:
        click.echo(chosen.count(order))
    elif svg is None:
        for line in _listed(chosen, order, draw, explain, plain):
            click.echo(line)
    return 0


def _refuse_idle_options(
    count: bool, draw: bool, explain: bool, plain: bool, svg: str | None, as_json: bool
) -> None:
    """Raise click.UsageError for an option that would not change the output."""
    if count and (draw or (explain and svg is None)):
        raise click.UsageError("--count prints only a number; omit --draw and --explain")
    drawn = not count and (draw if as_json else svg is None and (draw or explain))
    if plain and not drawn:
        raise click.UsageError(
            "--ascii has no effect, because the output contains no text drawings; give --draw"
        )


def _record(
    name: str, kind: Kind, order: int, count: bool, draw: bool, explain: bool, plain: bool
) -> dict[str, object]:
    from orderconds.explain import lines

    record: dict[str, object] = {"kind": name, "order": order, "count": kind.count(order)}
    if count:
        return record
    members = list(kind.members(order))
    record["trees"] = [kind.text(member) for member in members]
    if draw:
        style = lines.ASCII if plain else lines.UNICODE
        record["drawings"] = [lines.draw(kind.diagram(member), style) for member in members]
    if explain:
        conditions = kind.conditions(order)
        record["names"] = [kind.names(member) for member in members]
        record["conditions"] = [str(conditions[member]) for member in members]
    return record


def _listed(kind: Kind, order: int, draw: bool, explain: bool, plain: bool) -> Iterator[str]:
    from orderconds.explain import lines

    style = screen.drawing_style(plain)
    conditions = kind.conditions(order) if explain else {}
    for member in kind.members(order):
        if explain:
            yield from kind.entry(member, conditions.get(member), style)
        else:
            yield kind.text(member)
        if draw and not explain:
            yield from (f"    {line}" for line in lines.draw(kind.diagram(member), style))
        if draw or explain:
            yield ""
