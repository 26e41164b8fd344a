"""Identifiers: program names made legal and unique in a target language."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable


class Names:
    """A mapping from program names to identifiers of a target, in order of first use.

    >>> names = Names({"double", "state"}); names.add_all(["m0", "double", "k.1"])
    >>> names.spelled
    {'m0': 'm0', 'double': 'double_', 'k.1': 'k_1'}
    >>> names.fresh("m0")
    'm0_'
    """

    def __init__(self, reserved: Collection[str]) -> None:
        self._taken = dict.fromkeys(sorted(reserved), True)
        self._reserved = len(self._taken)
        self.spelled: dict[str, str] = {}

    @property
    def count(self) -> int:
        """How many identifiers were given, by wish or for a name."""
        return len(self._taken) - self._reserved

    def add_all(self, names: Iterable[str]) -> None:
        """Give each name an identifier."""
        for name in names:
            if name not in self.spelled:
                self.spelled[name] = self.fresh(name)

    def fresh(self, wish: str) -> str:
        """Return an identifier not given before, close to the wish."""
        name = re.sub(r"\W", "_", wish, flags=re.ASCII)
        if not name or name[0].isdigit() or name.startswith("__"):
            name = "v" + name
        while name in self._taken:
            name += "_"
        self._taken[name] = True
        return name
