"""The formats of a tableau file, one class each: which keys it has and which method they make.

A format is read in two steps, since the ring of a tableau is known only once all its coefficients have been
seen: ``coefficients`` yields every spelled coefficient with its place, ``build`` takes their values. Places
are named as in the file, entries counted from 1.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

from msgspec import Meta, Struct, field

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    Method,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
    Stage,
)

Coefficient = str | int
Places = Iterator[tuple[str, Coefficient]]
MAX_STAGES = 200


class RootEntry(Struct, forbid_unknown_fields=True):
    """A real root: ``minpoly`` with ascending coefficients, ``near`` a decimal that isolates it."""

    minpoly: list[Coefficient]
    near: str


class CutoffClaim(Struct, forbid_unknown_fields=True):
    """The claimed order of a family that takes a cutoff."""

    cutoff: Annotated[int, Meta(ge=0)]
    order: Annotated[int, Meta(ge=1)]


class ProofEntry(Struct, forbid_unknown_fields=True):
    """Which equations the rounded decimals of the file solve (:mod:`orderconds.tableau.unknowns`)."""

    conditions: str
    order: Annotated[int, Meta(ge=1, le=20)]
    pins: list[str] = []
    reduction: Literal["symmetric", "low-storage", "simplifying"] | None = None
    assumptions: dict[Literal["B", "C", "D"], Annotated[int, Meta(ge=0, le=40)]] = {}
    printed: dict[str, Coefficient] = {}


Number = Coefficient | RootEntry
"""What may stand under ``numbers``."""
Claim = bool | Annotated[int, Meta(ge=1)] | list[CutoffClaim]
"""What may stand under ``claims``: a property, the order of a family, orders by cutoff."""


class Format(Struct, forbid_unknown_fields=True, kw_only=True):
    """The keys that every format has; ``numbers`` holds :data:`Number`, ``claims`` :data:`Claim`."""

    name: str
    family: str
    source: str = ""
    bibtex: str = ""
    numbers: dict[str, Any] = {}
    claims: dict[str, Any] = {}
    proof: ProofEntry | None = None

    def coefficients(self) -> Places:
        """Yield (place, spelling) of every coefficient."""
        yield from ()

    def verify(self, where: str) -> None:
        """Raise :class:`TableauError` unless the shapes fit."""

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, Embedded | None]:
        """Return the method, given the value at every place."""
        raise TypeError(f"{type(self).__name__} is the part that formats share")


class EmbeddedEntry(Struct, forbid_unknown_fields=True):
    """Weights of lower order for an error estimate."""

    b: list[Coefficient]
    order: Annotated[int, Meta(ge=1)]


class RungeKuttaFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "rk"``: A by rows, zeros at the end of a row may be left out, and b."""

    A: list[list[Coefficient]]
    b: list[Coefficient]
    embedded: EmbeddedEntry | None = None

    def verify(self, where: str) -> None:
        """Check len(A) = len(b) and that no row is longer."""
        s = _stages(len(self.b), f"{where}: b")
        if len(self.A) != s:
            raise TableauError(
                f"{len(self.A)} rows for {s} weights b",
                where=f"{where}: A",
                expected="a square A: as many rows as b has entries",
            )
        for i, row in enumerate(self.A):
            _short_enough(row, s, f"{where}: A[{i + 1}]")
        if self.embedded:
            _short_enough(self.embedded.b, s, f"{where}: embedded.b")

    def coefficients(self) -> Places:
        """Yield A by rows, then b, then the embedded weights."""
        for i, row in enumerate(self.A):
            yield from _row(row, f"A[{i + 1}]")
        yield from _row(self.b, "b")
        if self.embedded:
            yield from _row(self.embedded.b, "embedded.b")

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, Embedded | None]:
        """Return the Runge-Kutta method."""
        s = len(self.b)
        A = tuple(_filled(values, f"A[{i + 1}]", s, ring) for i in range(s))
        embedded = None
        if self.embedded:
            embedded = Embedded(_filled(values, "embedded.b", s, ring), self.embedded.order)
        return RungeKutta(A, _filled(values, "b", s, ring)), embedded


class PartitionedFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "prk"``: A, b for the first part of a system and A_hat, b_hat for the second."""

    A: list[list[Coefficient]]
    b: list[Coefficient]
    A_hat: list[list[Coefficient]]
    b_hat: list[Coefficient]

    def _parts(self) -> Iterator[tuple[str, list[list[Coefficient]], str, list[Coefficient]]]:
        yield "A", self.A, "b", self.b
        yield "A_hat", self.A_hat, "b_hat", self.b_hat

    def verify(self, where: str) -> None:
        """Check that both parts have the same number of stages and that no row is longer."""
        s = _stages(len(self.b), f"{where}: b")
        if len(self.b_hat) != s:
            raise TableauError(
                f"{len(self.b_hat)} entries for {s} in b",
                where=f"{where}: b_hat",
                expected="b and b_hat of one length",
            )
        for name, rows, weights, _ in self._parts():
            if len(rows) != s:
                raise TableauError(
                    f"{len(rows)} rows for {s} weights {weights}",
                    where=f"{where}: {name}",
                    expected=f"a square {name}: as many rows as {weights} has entries",
                )
            for i, row in enumerate(rows):
                _short_enough(row, s, f"{where}: {name}[{i + 1}]")

    def coefficients(self) -> Places:
        """Yield A by rows, then b, then A_hat and b_hat alike."""
        for name, rows, weights, b in self._parts():
            for i, row in enumerate(rows):
                yield from _row(row, f"{name}[{i + 1}]")
            yield from _row(b, weights)

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, Embedded | None]:
        """Return the partitioned method."""
        s = len(self.b)
        A, A_hat = (
            tuple(_filled(values, f"{name}[{i + 1}]", s, ring) for i in range(s)) for name in ("A", "A_hat")
        )
        b, b_hat = (_filled(values, name, s, ring) for name in ("b", "b_hat"))
        return PartitionedRungeKutta(A, b, A_hat, b_hat), None


class StageEntry(Struct, forbid_unknown_fields=True):
    """A product of exponentials, the first acts first, on stage ``from`` (counted from 1; default y0)."""

    exp: list[list[Coefficient]] = []
    start: int | None = field(default=None, name="from")


class LowStorage(Struct, forbid_unknown_fields=True):
    """K <- A_i K + F(Y), Y <- exp(h B_i K) Y, in two registers (2N)."""

    A: list[Coefficient]
    B: list[Coefficient]


class CommutatorFreeFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "cf"``: either stages and an update, or a low-storage scheme, expanded on load."""

    stage: list[StageEntry] = []
    update: StageEntry | None = None
    low_storage: LowStorage | None = None

    def verify(self, where: str) -> None:
        """Check that one of the two forms is given and that stages start from earlier ones."""
        if self.low_storage:
            if self.stage or self.update:
                raise TableauError(
                    "low_storage beside stage or update", where=where, expected="one of the two forms"
                )
            s = _stages(len(self.low_storage.B), f"{where}: low_storage.B")
            if len(self.low_storage.A) != s:
                raise TableauError(
                    f"{len(self.low_storage.A)} entries for {s} in B",
                    where=f"{where}: low_storage.A",
                    expected="A and B of one length",
                )
            return
        if self.update is None:
            raise TableauError("no update", where=where, expected="[[stage]] and [update], or [low_storage]")
        s = _stages(len(self.stage), f"{where}: stage")
        for i, (place, entry) in enumerate(self._entries()):
            for r, row in enumerate(entry.exp):
                _short_enough(row, s, f"{where}: {place}.exp[{r + 1}]")
            if entry.start is not None and not 1 <= entry.start <= i:
                raise TableauError(
                    f"from = {entry.start}",
                    where=f"{where}: {place}",
                    expected=f"an earlier stage, 1 to {i}" if i else "no from: nothing comes before stage 1",
                )

    def _entries(self) -> Iterator[tuple[str, StageEntry]]:
        for i, entry in enumerate(self.stage):
            yield f"stage[{i + 1}]", entry
        if self.update:
            yield "update", self.update

    def coefficients(self) -> Places:
        """Yield the exponentials of the stages and the update, or A and B."""
        if self.low_storage:
            yield from _row(self.low_storage.A, "low_storage.A")
            yield from _row(self.low_storage.B, "low_storage.B")
        for place, entry in self._entries():
            for r, row in enumerate(entry.exp):
                yield from _row(row, f"{place}.exp[{r + 1}]")

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, Embedded | None]:
        """Return the commutator-free method."""
        if self.low_storage:
            s = len(self.low_storage.B)
            A, B = (_filled(values, f"low_storage.{key}", s, ring) for key in "AB")
            return _low_storage(A, B, ring), None
        s = len(self.stage)
        products = [
            Stage(
                None if entry.start is None else entry.start - 1,
                tuple(_filled(values, f"{place}.exp[{r + 1}]", s, ring) for r in range(len(entry.exp))),
            )
            for place, entry in self._entries()
        ]
        return CommutatorFree(tuple(products[:-1]), products[-1]), None


def _low_storage(A: Row, B: Row, ring: Ring) -> CommutatorFree:
    """Expand a 2N scheme: stage i + 1 is one exponential, of B_i K_i, on stage i.

    K_i = sum_{j <= i} A_{j+1} ... A_i F_j.
    """
    s = len(B)
    register: list[Element] = [ring.zero] * s
    products = [Stage(None, ())]
    for i in range(s):
        register = [A[i] * x for x in register]
        register[i] = ring.one
        products.append(Stage(i, (tuple(B[i] * x for x in register),)))
    return CommutatorFree(tuple(products[:-1]), products[-1])


class CompositionFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "composition"``: steps gamma of a symmetric method of order 2."""

    base: Literal["symmetric-2"]
    gamma: list[Coefficient]

    def verify(self, where: str) -> None:
        """Check that there is a step."""
        _stages(len(self.gamma), f"{where}: gamma")

    def coefficients(self) -> Places:
        """Yield the steps."""
        yield from _row(self.gamma, "gamma")

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, Embedded | None]:
        """Return the composition."""
        return Composition(self.base, _filled(values, "gamma", len(self.gamma), ring)), None


FORMATS: dict[str, type[Format]] = {
    "cf": CommutatorFreeFile,
    "composition": CompositionFile,
    "prk": PartitionedFile,
    "rk": RungeKuttaFile,
}


def _row(row: list[Coefficient], place: str) -> Places:
    for j, spelled in enumerate(row):
        yield f"{place}[{j + 1}]", spelled


def _filled(values: Mapping[str, Element], place: str, s: int, ring: Ring) -> Row:
    """Return the row at ``place``, zeros following what the file gives."""
    return tuple(values.get(f"{place}[{j + 1}]", ring.zero) for j in range(s))


def _stages(s: int, where: str) -> int:
    if not 1 <= s <= MAX_STAGES:
        raise TableauError(f"{s} stages", where=where, expected=f"1 to {MAX_STAGES}")
    return s


def _short_enough(row: list[Coefficient], s: int, where: str) -> None:
    if len(row) > s:
        raise TableauError(
            f"{len(row)} entries",
            where=where,
            expected=f"at most {s}, one for each stage (zeros may be left out)",
        )
