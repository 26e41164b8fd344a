"""The keys that all tableau formats share, and functions that read rows of coefficients.

A file is read in two steps, because the ring of a tableau depends on all its coefficients. First,
``coefficients`` yields the text of every coefficient with its position in the file. After all coefficients
are evaluated, ``build`` receives the value at each position. A position consists of a key and indices, such
as ``A[2][1]``. The indices count from 1.
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
    """A real root of a polynomial. ``minpoly`` contains the ascending coefficients of the polynomial. The
    decimal ``near`` identifies the root. Exactly one root lies within one unit of the last digit of this
    decimal."""

    minpoly: list[Coefficient]
    near: str


class CutoffClaim(Struct, forbid_unknown_fields=True):
    """The claimed order in a family, for one value of the option ``cutoff`` of the family. The family
    truncates a series, such as the series of dexpinv, after the power ``cutoff``."""

    cutoff: Annotated[int, Meta(ge=0)]
    order: Annotated[int, Meta(ge=1)]


class ProofEntry(Struct, forbid_unknown_fields=True):
    """The table ``[proof]``. It defines equations that have an exact solution close to the rounded decimals
    of the file. The keys are explained in :mod:`orderconds.tableau.unknowns`."""

    conditions: str
    order: Annotated[int, Meta(ge=1, le=20)]
    pins: list[str] = []
    reduction: Literal["symmetric", "low-storage", "simplifying", "spelling"] | None = None
    assumptions: dict[Literal["B", "C", "D"], Annotated[int, Meta(ge=0, le=40)]] = {}
    printed: dict[str, Coefficient] = {}


Number = Coefficient | RootEntry
"""A value in the table ``numbers``."""
Claim = bool | Annotated[int, Meta(ge=1)] | list[CutoffClaim]
"""A value in the table ``claims``: True or False for a property, the order in a family, or a list of orders
for several values of the option ``cutoff`` of a family."""


class Format(Struct, forbid_unknown_fields=True, kw_only=True):
    """The base class of all formats, with the keys that all formats share. The values in the table
    ``numbers`` have the type :data:`Number`. The values in the table ``claims`` have the type :data:`Claim`.

    The value of ``family`` is the name of the format, and also of a family of methods. ``order`` is the
    claimed order of the method in this family.
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
    """If a tableau is stored in named arrays, its format is recognised by the array with this name. The name
    is empty for the default format."""
    as_products: ClassVar[bool] = False
    """True if the array ``exponentials`` stores the coefficients (:mod:`orderconds.exchange.arrays`)."""

    @classmethod
    def defaults(cls, names: Collection[str]) -> Data:
        """Return default values for keys that are missing if a tableau is stored in named arrays. ``names``
        contains the names of these arrays."""
        return {}

    def coefficients(self) -> Places:
        """Yield a pair (position in the file, text) for every coefficient."""
        yield from ()

    def verify(self, where: str) -> None:
        """Raise :class:`TableauError` if values of the file contradict each other, for example if the lengths
        of rows do not match."""

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the method and its embedded method. Without an embedded method, the second value is None.
        ``values`` maps each position in the file to the value of its coefficient."""
        raise TypeError(f"{type(self).__name__} is an abstract format")

    def extension(self, values: Mapping[str, Element], ring: Ring) -> Extension | None:
        """Return the continuous extension, or None if the file has none. ``values`` maps each position in the
        file to the value of its coefficient."""
        return None


def row_places(row: list[Coefficient], place: str) -> Places:
    """Yield the position in the file and the text of each entry of a row.

    >>> list(row_places(["1/2", 1], "b"))
    [('b[1]', '1/2'), ('b[2]', 1)]
    """
    for j, coefficient in enumerate(row):
        yield f"{place}[{j + 1}]", coefficient


def filled_row(values: Mapping[str, Element], place: str, s: int, ring: Ring) -> Row:
    """Return a row of coefficients, padded with zeros to length ``s``. ``place`` is the position of the row
    in the file. ``values`` maps the position of each coefficient to its value.

    >>> from orderconds.ring import QQ
    >>> filled_row({"b[1]": QQ.one}, "b", 2, QQ)
    (1, 0)
    """
    return tuple(values.get(f"{place}[{j + 1}]", ring.zero) for j in range(s))


def counted(s: int, where: str, noun: str = "stages") -> int:
    """Return s if 1 <= s <= :data:`MAX_STAGES`, and raise :class:`TableauError` otherwise. In the message,
    ``noun`` is the name of the counted objects.

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
