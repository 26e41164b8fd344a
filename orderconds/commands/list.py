"""``orderconds list``: list families, tableaux, and objects of other packages.

Another package can add objects to the printed lists. For this purpose, the package registers a function as
an entry point in the group ``orderconds.listings``. The function has no arguments and returns one dictionary
for each object, with the keys "name" and "about" (one line).
"""

from __future__ import annotations

import difflib
from collections.abc import Callable, Iterable
from importlib import metadata

import click

from orderconds.commands import screen
from orderconds.errors import InputError, UnknownName

LISTING_GROUP = "orderconds.listings"
"""The entry-point group in which other packages register listings."""

Records = Iterable[dict[str, str]]


@click.command(name="list")
@click.argument("kind", required=False)
@click.option("--json", "as_json", is_flag=True, help="Print names and descriptions on stdout as JSON.")
def command(kind: str | None, as_json: bool) -> int:
    """List one KIND (families, tableaux, groups, actions, scenes), or all kinds.

    \b
    Examples:
        orderconds list families
        orderconds list tableaux
        orderconds list scenes --json
    """
    kinds = [kind] if kind is not None else kinds_offered()
    listings = {name: list(listing(name)()) for name in kinds}
    if as_json:
        screen.print_json(listings)
        return 0
    for number, (name, records) in enumerate(listings.items()):
        if number:
            click.echo()
        screen.print_table((name, ""), [(record["name"], record["about"]) for record in records])
    return 0


def kinds_offered() -> list[str]:
    """Return the kinds of objects that can be listed. The built-in kinds come first.

    >>> kinds_offered()[:2]
    ['families', 'tableaux']
    """
    others = {entry.name for entry in metadata.entry_points(group=LISTING_GROUP)}
    return [*BUILT_IN, *sorted(others - set(BUILT_IN))]


def listing(kind: str) -> Callable[[], Records]:
    """Return the function that yields the records of the given kind. Raise UnknownName for an unknown kind.

    >>> next(iter(listing("families")()))["name"]
    'rk'
    """
    if kind in BUILT_IN:
        return BUILT_IN[kind]
    for entry in metadata.entry_points(group=LISTING_GROUP):
        if entry.name == kind:
            try:
                function: Callable[[], Records] = entry.load()
            except (ImportError, AttributeError) as error:
                where = f"{kind} ({entry.value})"
                raise InputError(f"cannot load the listing: {error}", where=where) from error
            return function
    kinds = kinds_offered()
    close = difflib.get_close_matches(kind, kinds, n=1)
    raise UnknownName(
        f"there is no listing {kind!r}",
        expected=f"one of {', '.join(kinds)}",
        hint=f"type: orderconds list {close[0]}" if close else "",
    )


def _families() -> Records:
    from orderconds import families

    for name in families.installed_names():
        yield {"name": name, "about": families.family_class(name).description}


def _tableaux() -> Records:
    from orderconds.tableau import Tableau, available, find

    for name in available():
        yield {"name": name, "about": Tableau.load(find(name)).source}


BUILT_IN: dict[str, Callable[[], Records]] = {"families": _families, "tableaux": _tableaux}
"""Maps each built-in kind of objects to a function that yields the records of this kind."""
