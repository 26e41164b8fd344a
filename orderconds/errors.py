"""Errors that a user can cause: one class for each cause. A message has four parts: the problem, its place in
the input, the expected input, and a hint.

The command line turns every :class:`InputError` into exit status 2 and its message, never a traceback.
"""

from __future__ import annotations


class InputError(Exception):
    """Bad input or usage.

    ``found`` is the problem, ``where`` the file, key or flag, ``expected`` a description of valid input, and
    ``hint`` a suggestion; empty parts are left out of the message.
    """

    def __init__(self, found: str, *, where: str = "", expected: str = "", hint: str = "") -> None:
        self.found, self.where, self.expected, self.hint = found, where, expected, hint
        super().__init__(found)

    def __str__(self) -> str:
        parts = [f"{self.where}: {self.found}" if self.where else self.found]
        if self.expected:
            parts.append(f"expected {self.expected}")
        if self.hint:
            parts.append(self.hint)
        return "; ".join(parts)


class TableauError(InputError):
    """A tableau file that cannot be read: unknown key, wrong shape, bad coefficient, name used twice."""


class UnknownName(InputError):
    """A family, tableau, scene, group or command that is not registered."""


class ZeroWeight(InputError):
    """A weight b_i = 0 in a family whose formulas divide by b_i (SPRK, VCG, VRKMK, VCF)."""
