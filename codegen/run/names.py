"""Choose a legal and unique identifier of the target language for each given name."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable


class Names:
    """A mapping from names such as ``k.1`` to legal and unique identifiers of the target language.

    >>> names = Names({"double", "state"}); names.add_all(["m0", "double", "k.1"])
    >>> names.identifiers
    {'m0': 'm0', 'double': 'double_', 'k.1': 'k_1'}
    >>> names.fresh("m0")
    'm0_'
    """

    def __init__(self, reserved: Collection[str]) -> None:
        # The order of a set differs from run to run, so ``reserved`` is sorted.
        self._taken = dict.fromkeys(sorted(reserved), True)
        self._reserved = len(self._taken)
        self.identifiers: dict[str, str] = {}

    @property
    def count(self) -> int:
        """The number of chosen identifiers. The reserved words are not counted."""
        return len(self._taken) - self._reserved

    def add_all(self, names: Iterable[str]) -> None:
        """Choose an identifier for each of ``names``. Identifiers from earlier calls are kept."""
        for name in names:
            if name not in self.identifiers:
                self.identifiers[name] = self.fresh(name)

    def fresh(self, proposal: str) -> str:
        """Return a new identifier: ``proposal``, or a similar name if ``proposal`` is illegal or in use."""
        # Letters outside of ASCII are replaced, because some compilers do not accept them.
        name = re.sub(r"\W", "_", proposal, flags=re.ASCII)
        # C reserves identifiers that begin with two underscores.
        if not name or name[0].isdigit() or name.startswith("__"):
            name = "v" + name
        # An appended number could be mistaken for an index, as in ``xi_1``.
        while name in self._taken:
            name += "_"
        self._taken[name] = True
        return name
