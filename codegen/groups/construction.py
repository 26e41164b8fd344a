"""Checks of the arguments from which groups are constructed."""

from __future__ import annotations

from codegen.errors import SceneError
from codegen.groups.base import LieGroup


def check_size(name: str, n: object, least: int) -> None:
    """Raise :class:`SceneError` if the size n of a group is not an integer of at least ``least``.

    >>> check_size("SO", "3", 2)
    Traceback (most recent call last):
    codegen.errors.SceneError: SO('3'): this size is not allowed; expected an integer of at least 2
    """
    if not isinstance(n, int) or isinstance(n, bool) or n < least:
        raise SceneError(
            "this size is not allowed",
            where=f"{name}({n!r})",
            expected=f"an integer of at least {least}",
        )


def check_factor(name: str, group: object) -> None:
    """Raise :class:`SceneError` if ``group`` is not a group.

    The error message contains the text ``name``, for example "a product".
    """
    if not isinstance(group, LieGroup):
        shown = group.__name__ if isinstance(group, type) else repr(group)
        raise SceneError(
            f"{shown} in {name} is not a group", expected="an object of codegen.groups, such as SO3()"
        )
