"""Shell completion of names in commands, for example the names of families and tableaux."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import click
from click.shell_completion import CompletionItem

Complete = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]


def completing(names: Callable[[], Iterable[str]], *, files: bool = False) -> Complete:
    """Return a function that completes a word in the shell to one of the words ``names()``.

    If ``files`` is true and no completion begins with the word, the shell completes the word to a path.

    >>> [item.value for item in completing(lambda: ["cf4", "rk4"])(None, None, "c")]
    ['cf4']
    """

    def complete(ctx: click.Context, parameter: click.Parameter, typed: str) -> list[CompletionItem]:
        fitting = [CompletionItem(name) for name in names() if name.startswith(typed)]
        return fitting or ([CompletionItem(typed, type="file")] if files else [])

    return complete


def family_names() -> list[str]:
    """Return the names of all families.

    >>> "cf" in family_names()
    True
    """
    from orderconds import families

    return sorted(families.names())


def tableau_names() -> list[str]:
    """Return the names of the tableaux of the library.

    >>> "cf4" in tableau_names()
    True
    """
    from orderconds.tableau.library import available

    return sorted(available())
