"""The keys that all tableau formats share, and functions that read rows of coefficients.

All coefficients of a tableau are elements of one ring, for example of the rational numbers. The ring is
chosen after all coefficients are read. Therefore a file is read in two steps:

1. ``coefficients`` yields the text of every coefficient with its position in the file.
2. ``build`` receives the value of every coefficient and returns the method.

A position consists of a key and indices, such as ``A[2][1]``. The indices count from 1.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from msgspec import Meta, Struct

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.extension import Extension
from orderconds.tableau.methods import LowerOrder, Row
from orderconds.tableau.products import Method

Coefficient = str | int
Data = dict[str, Any]
Places = Iterator[tuple[str, Coefficient]]
MAX_STAGES = 200
MAX_PARTS = 6


class RootEntry(Struct, forbid_unknown_fields=True):
    """A real root of a polynomial. ``minpoly`` contains the coefficients of the polynomial, beginning with
    the constant term. The decimal ``near`` is an approximation of the root. Its error is at most one unit of
    its last digit. No other real root may be so close to ``near``."""

    minpoly: list[Coefficient]
    near: str


class CutoffClaim(Struct, forbid_unknown_fields=True):
    """The claimed order of a method in a family of methods that truncates a series, such as the series of
    dexpinv. The option ``cutoff`` is the highest power in the truncated series. The claim is for one value of
    this option."""

    cutoff: Annotated[int, Meta(ge=0)]
    order: Annotated[int, Meta(ge=1)]


class ProofEntry(Struct, forbid_unknown_fields=True):
    """The table ``[proof]`` of a file with rounded decimals. It defines equations for the exact coefficients.
    The equations have a solution close to the rounded decimals. The keys are explained in
    :mod:`orderconds.tableau.unknowns`."""

    conditions: str
    order: Annotated[int, Meta(ge=1, le=20)]
    pins: list[str] = []
    reduction: Literal["symmetric", "low-storage", "simplifying", "spelling"] | None = None
    assumptions: dict[Literal["B", "C", "D"], Annotated[int, Meta(ge=0, le=40)]] = {}
    printed: dict[str, Coefficient] = {}


Number = Coefficient | RootEntry
"""A value in the table ``numbers``."""
Claim = bool | Annotated[int, Meta(ge=1)] | list[CutoffClaim]
"""A value in the table ``claims``. For a property, the value is True or False. For a family of methods, the
value is the order of the method in this family. If the order depends on the option ``cutoff`` of the family,
the value is a list of :class:`CutoffClaim`."""


class Format(Struct, forbid_unknown_fields=True, kw_only=True):
    """The base class of all formats. It defines the keys that all formats share. The values in the table
    ``numbers`` have the type :data:`Number`. The values in the table ``claims`` have the type :data:`Claim`.

    ``family`` is the name of the format. A family of methods has the same name. ``order`` is the claimed
    order of the method in this family.
    """

    name: str
    family: str
    source: str = ""
    bibtex: str = ""
    numbers: dict[str, Any] = {}
    claims: dict[str, Any] = {}
    order: Annotated[int, Meta(ge=1)] | None = None
    proof: ProofEntry | None = None

    in_arrays: ClassVar[bool] = False
    """True if a tableau of this format can be stored in named arrays (:mod:`orderconds.exchange.arrays`)."""
    distinctive_key: ClassVar[str] = ""
    """The name of an array. If a tableau is stored in named arrays, and one of them has this name, then the
    tableau has this format. The default format has an empty name here."""
    as_products: ClassVar[bool] = False
    """True if a tableau of this format consists of products of exponentials. Named arrays store their
    coefficients in the array ``exponentials`` (:mod:`orderconds.exchange.arrays`)."""

    @classmethod
    def defaults(cls, names: Collection[str]) -> Data:
        """Return default values for the keys of a tableau that was stored in named arrays. ``names`` contains
        the names of the arrays. A caller uses the default value of a key only if the key is missing."""
        return {}

    def coefficients(self) -> Places:
        """Yield a pair (position in the file, text) for every coefficient."""
        yield from ()

    def verify(self, where: str) -> None:
        """Raise :class:`TableauError` if values of the file contradict each other, for example if the lengths
        of rows do not match."""

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the method and its embedded method. Without an embedded method, the second value is None.
        ``values`` maps the position of each coefficient to the value of the coefficient."""
        raise TypeError(f"{type(self).__name__} is an abstract format")

    def extension(self, values: Mapping[str, Element], ring: Ring) -> Extension | None:
        """Return the continuous extension, or None if the file has none. ``values`` maps the position of each
        coefficient to the value of the coefficient."""
        return None


def row_places(row: list[Coefficient], place: str) -> Places:
    """Yield a pair for each entry of a row: the position of the entry in the file, and the entry.

    >>> list(row_places(["1/2", 1], "b"))
    [('b[1]', '1/2'), ('b[2]', 1)]
    """
    for j, coefficient in enumerate(row):
        yield f"{place}[{j + 1}]", coefficient


def filled_row(values: Mapping[str, Element], place: str, s: int, ring: Ring) -> Row:
    """Return a row of coefficients, padded with zeros to length ``s``. ``place`` is the position of the row
    in the file. ``values`` maps the position of each coefficient to the value of the coefficient.

    >>> from orderconds.ring import QQ
    >>> filled_row({"b[1]": QQ.one}, "b", 2, QQ)
    (1, 0)
    """
    return tuple(values.get(f"{place}[{j + 1}]", ring.zero) for j in range(s))


def counted(s: int, where: str, noun: str = "stages") -> int:
    """Return s if 1 <= s <= :data:`MAX_STAGES`, and raise :class:`TableauError` otherwise. The error
    message contains ``noun``, the name of the objects whose number is s.

    >>> counted(3, "b")
    3
    """
    if not 1 <= s <= MAX_STAGES:
        raise TableauError(f"{s} {noun}", where=where, expected=f"1 to {MAX_STAGES}")
    return s


def verify_length(row: list[Coefficient], s: int, where: str) -> None:
    """Raise :class:`TableauError` if a row has more than ``s`` entries, where ``s`` is the number of stages.

    >>> verify_length(["1/2"], 2, "A[2]")
    """
    if len(row) > s:
        raise TableauError(
            f"{len(row)} entries",
            where=where,
            expected=f"at most {s}, one for each stage (zeros may be left out)",
        )
