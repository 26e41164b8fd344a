"""``orderconds cite``: the BibTeX entry of a tableau's source."""

from __future__ import annotations

import difflib

import click

from orderconds.commands import screen
from orderconds.commands.names import completing, tableau_names
from orderconds.errors import TableauError, UnknownName


@click.command(name="cite")
@click.argument("name", shell_complete=completing(tableau_names, files=True))
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record on stdout and nothing else.")
def command(name: str, as_json: bool) -> int:
    """Print the BibTeX entry of a source. NAME is a tableau of the library, a tableau file or a BibTeX key.

    \b
    Examples:
        orderconds cite cf4
    """
    entries = bibliography()
    source = ""
    key = name
    if name not in entries:
        from orderconds.checking import read

        try:
            tableau = read(name)
        except UnknownName as error:
            close = difflib.get_close_matches(name, entries, n=1)
            hint = f"type: orderconds cite {close[0]}" if close else "type: orderconds list tableaux"
            raise UnknownName(
                f"{name!r} is neither a tableau nor a BibTeX key", expected=error.expected, hint=hint
            ) from error
        key, source = tableau.bibtex, tableau.source
        if key not in entries:
            raise TableauError(
                f"BibTeX key {key!r} is not in sources.bib" if key else "no BibTeX key",
                where=tableau.path or tableau.name,
                expected=f"bibtex = one of {', '.join(entries)}",
            )
    if as_json:
        screen.print_json({"name": name, "key": key, "source": source, "bibtex": entries[key]})
    else:
        click.echo(f"% {source}\n{entries[key]}" if source else entries[key])
    return 0


def bibliography() -> dict[str, str]:
    """Return the BibTeX entries of the library's file ``sources.bib`` as a map from keys to entries.

    >>> "kutta1901" in bibliography()
    True
    """
    from orderconds.tableau.library import bibliography as file

    return dict(split_entries(file().read_text(encoding="utf-8")))


def split_entries(text: str) -> list[tuple[str, str]]:
    """Split BibTeX text into pairs (key, entry).

    >>> split_entries("@book{a, title = {A {B}}}\\n\\n@misc{c,\\n}")
    [('a', '@book{a, title = {A {B}}}'), ('c', '@misc{c,\\n}')]
    """
    entries: list[tuple[str, str]] = []
    start, depth = 0, 0
    for place, sign in enumerate(text):
        if sign == "@" and depth == 0:
            start = place
        depth += {"{": 1, "}": -1}.get(sign, 0)
        if sign == "}" and depth == 0:
            entry = text[start : place + 1]
            entries.append((entry[entry.index("{") + 1 : entry.index(",")].strip(), entry))
    return entries
