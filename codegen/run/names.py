"""Identifiers: a legal and unique identifier of the target language for each name of a program."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable


class Names:
    """A mapping from program names to identifiers of a target, in order of first use.

    >>> names = Names({"double", "state"}); names.add_all(["m0", "double", "k.1"])
    >>> names.identifiers
    {'m0': 'm0', 'double': 'double_', 'k.1': 'k_1'}
    >>> names.fresh("m0")
    'm0_'
    """

    def __init__(self, reserved: Collection[str]) -> None:
        # The order of a set could differ from run to run, so the words are sorted.
        self._taken = dict.fromkeys(sorted(reserved), True)
        self._reserved = len(self._taken)
        self.identifiers: dict[str, str] = {}

    @property
    def count(self) -> int:
        """The number of identifiers in use."""
        return len(self._taken) - self._reserved

    def add_all(self, names: Iterable[str]) -> None:
        """Give each name an identifier."""
        for name in names:
            if name not in self.identifiers:
                self.identifiers[name] = self.fresh(name)

    def fresh(self, proposal: str) -> str:
        """Return a new identifier: ``proposal``, or a similar name if that is illegal or already taken."""
        # Only ASCII letters are kept, because compilers differ in the other letters that they allow.
        name = re.sub(r"\W", "_", proposal, flags=re.ASCII)
        # C reserves identifiers with two leading underscores, and Python mangles such names in classes.
        if not name or name[0].isdigit() or name.startswith("__"):
            name = "v" + name
        # An underscore is appended, because a number could be mistaken for an index, as in xi_1.
        while name in self._taken:
            name += "_"
        self._taken[name] = True
        return name
