"""Errors that a user can cause, with one class for each cause.

The command line prints the message of such an error without a traceback and exits with status 2.
"""

from __future__ import annotations


class InputError(Exception):
    """The error for invalid input, and for the wrong use of a command.

    ``found`` describes the problem, ``where`` is the file, key or option, ``expected`` describes valid
    input, and ``hint`` is a suggestion. The message omits empty texts.
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
    """The error for a tableau file that is not valid."""


class UnknownName(InputError):
    """The error for an unknown name of a family, tableau, scene, group or command."""


class ZeroWeight(InputError):
    """The error for a weight b_i = 0 in a family whose formulas divide by b_i.

    Examples are the families ``sprk``, ``vcg``, ``vrkmk`` and ``vcf``.
    """
