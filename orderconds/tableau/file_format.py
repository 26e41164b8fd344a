"""The keys that all tableau formats share, and functions that read rows of coefficients.

The choice of a common ring depends on all coefficients of a file. Therefore the file is read in two steps:

1. ``coefficients`` yields every coefficient, as it is written in the file, with its position.
2. ``build`` receives the value of every coefficient and returns the method.

In a position, such as ``A[2][1]``, indices start at 1.
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
    the constant term. Exactly one real root of the polynomial must lie between ``near`` - u and ``near`` + u.
    Here u is one unit in the last digit of the decimal ``near``."""

    minpoly: list[Coefficient]
    near: str


class CutoffClaim(Struct, forbid_unknown_fields=True):
    """The claimed order of a method for one value of the option ``cutoff``. Some families of methods truncate
    a series, for example the series of dexpinv. The option ``cutoff`` of such a family is the highest power
    in the truncated series."""

    cutoff: Annotated[int, Meta(ge=0)]
    order: Annotated[int, Meta(ge=1)]


class ProofEntry(Struct, forbid_unknown_fields=True):
    """The table ``[proof]`` of a file with rounded decimals: equations that the exact coefficients solve. The
    module :mod:`orderconds.tableau.unknowns` explains the keys."""

    conditions: str
    order: Annotated[int, Meta(ge=1, le=20)]
    pins: list[str] = []
    reduction: Literal["symmetric", "low-storage", "simplifying", "spelling"] | None = None
    assumptions: dict[Literal["B", "C", "D"], Annotated[int, Meta(ge=0, le=40)]] = {}
    printed: dict[str, Coefficient] = {}


Number = Coefficient | RootEntry
"""A value in the table ``numbers`` of a tableau file."""
Claim = bool | Annotated[int, Meta(ge=1)] | list[CutoffClaim]
"""A value in the table ``claims`` of a tableau file. For a property, the value is True or False. For a family
of methods, the value is the claimed order. If the order depends on the option ``cutoff`` of the family, the
value is a list of :class:`CutoffClaim`."""


class Format(Struct, forbid_unknown_fields=True, kw_only=True):
    """The base class of all formats.

    ``family`` is the family of the method, for example ``rk``. It also determines the format. ``order`` is
    the claimed order of the method in this family. ``numbers`` defines names for numbers (:data:`Number`).
    ``claims`` contains the claimed properties, and the claimed orders in other families (:data:`Claim`).
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
    """True if a tableau of this format can be stored as named arrays (:mod:`orderconds.exchange.arrays`)."""
    distinctive_key: ClassVar[str] = ""
    """If stored arrays include an array with this name, the tableau has this format."""
    as_products: ClassVar[bool] = False
    """True if this is a format for methods whose stages and update are products of exponentials."""

    @classmethod
    def defaults(cls, names: Collection[str]) -> Data:
        """Return default values for a tableau that is stored as named arrays. The result maps keys of a
        tableau file to these values. ``names`` contains the names of the arrays. A default value is used if
        no array has the name of the key."""
        return {}

    def coefficients(self) -> Places:
        """Yield a pair such as ``("A[2][1]", "1/2")`` for every coefficient: its position and its entry in
        the file."""
        yield from ()

    def verify(self, where: str) -> None:
        """Raise :class:`TableauError` if values of the file contradict each other, for example if a row is
        longer than the number of stages."""

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the method, and the embedded method or None. ``values`` maps positions, such as ``A[2][1]``,
        to the values of the coefficients."""
        raise TypeError(f"{type(self).__name__} is an abstract format")

    def extension(self, values: Mapping[str, Element], ring: Ring) -> Extension | None:
        """Return the continuous extension, or None if the file has none. ``values`` maps positions, such as
        ``dense.b[2][1]``, to the values of the coefficients."""
        return None


def row_places(row: list[Coefficient], place: str) -> Places:
    """Yield a pair for each entry of a row: the position of the entry in the file, and the entry.

    >>> list(row_places(["1/2", 1], "b"))
    [('b[1]', '1/2'), ('b[2]', 1)]
    """
    for j, coefficient in enumerate(row):
        yield f"{place}[{j + 1}]", coefficient


def filled_row(values: Mapping[str, Element], place: str, s: int, ring: Ring) -> Row:
    """Return a row of coefficients, padded with zeros to length ``s``. ``values`` maps positions, such as
    ``b[1]``, to the values of the coefficients.

    >>> from orderconds.ring import QQ
    >>> filled_row({"b[1]": QQ.one}, "b", 2, QQ)
    (1, 0)
    """
    return tuple(values.get(f"{place}[{j + 1}]", ring.zero) for j in range(s))


def counted(s: int, where: str, noun: str = "stages") -> int:
    """Return s if 1 <= s <= :data:`MAX_STAGES`, and raise :class:`TableauError` otherwise. The error message
    contains ``noun``, the name of the counted objects.

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
            expected=f"at most {s}, one for each stage (zeros at the end may be left out)",
        )
