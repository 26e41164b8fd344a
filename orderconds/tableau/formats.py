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
from orderconds.tableau.brackets import Term, has_product, leaves
from orderconds.tableau.brackets import parse as parse_term
from orderconds.tableau.brackets import spell as spell_term
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    EmbeddedUpdate,
    LowerOrder,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
    Stage,
)
from orderconds.tableau.products import AdjointComposition, Magnus, Method, Splitting

Coefficient = str | int
Places = Iterator[tuple[str, Coefficient]]
MAX_STAGES = 200
MAX_PARTS = 6


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
    reduction: Literal["symmetric", "low-storage", "simplifying", "spelling"] | None = None
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

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the method, given the value at every place."""
        raise TypeError(f"{type(self).__name__} is the part that formats share")


class EmbeddedEntry(Struct, forbid_unknown_fields=True):
    """Weights of lower order for an error estimate."""

    b: list[Coefficient]
    order: Annotated[int, Meta(ge=1)]


class RungeKuttaFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "rk"``: A by rows, zeros at their ends may be left out, and b; c, if given, is verified."""

    A: list[list[Coefficient]]
    b: list[Coefficient]
    c: list[Coefficient] = []
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
        if self.c and len(self.c) != s:
            raise TableauError(
                f"{len(self.c)} entries for {s} weights b", where=f"{where}: c", expected="c as long as b"
            )
        if self.embedded:
            _short_enough(self.embedded.b, s, f"{where}: embedded.b")

    def coefficients(self) -> Places:
        """Yield A by rows, then b, then the embedded weights."""
        for i, row in enumerate(self.A):
            yield from _row(row, f"A[{i + 1}]")
        yield from _row(self.b, "b")
        yield from _row(self.c, "c")
        if self.embedded:
            yield from _row(self.embedded.b, "embedded.b")

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the Runge-Kutta method, and its embedded weights."""
        s = len(self.b)
        A = tuple(_filled(values, f"A[{i + 1}]", s, ring) for i in range(s))
        method, embedded = RungeKutta(A, _filled(values, "b", s, ring)), None
        if self.c:
            self._compare(method, _filled(values, "c", s, ring), ring)
        if self.embedded:
            embedded = Embedded(_filled(values, "embedded.b", s, ring), self.embedded.order)
            if all(ring.is_zero(x - y) for x, y in zip(method.b, embedded.b, strict=True)):
                raise _identically_zero(f"{self.name}: embedded.b", "other weights than b")
        return method, embedded

    def _compare(self, method: RungeKutta, c: Row, ring: Ring) -> None:
        """Refuse a c that is not the row sums."""
        for i, (given, total) in enumerate(zip(c, method.c, strict=True)):
            if ring.is_zero(given - total) is False:
                raise TableauError(
                    f"c_{i + 1} = {ring.text(given)} beside a row of A that sums to {ring.text(total)}",
                    where=f"{self.name}: c[{i + 1}]",
                    expected="c_i = sum_j a_ij",
                    hint="correct the row, or leave c out: it is computed",
                )


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

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
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


class EmbeddedProduct(StageEntry, forbid_unknown_fields=True, kw_only=True):
    """A second update of lower order, from the same stages."""

    order: Annotated[int, Meta(ge=1)]


class LowStorage(Struct, forbid_unknown_fields=True):
    """K <- A_i K + F(Y), Y <- exp(h B_i K) Y, in two registers (2N)."""

    A: list[Coefficient]
    B: list[Coefficient]


class CommutatorFreeFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "cf"``: either stages and an update, or a low-storage scheme, expanded on load.

    ``embedded`` is a second update from the same stages.
    """

    stage: list[StageEntry] = []
    update: StageEntry | None = None
    low_storage: LowStorage | None = None
    embedded: EmbeddedProduct | None = None

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
        else:
            if self.update is None:
                raise TableauError(
                    "no update", where=where, expected="[[stage]] and [update], or [low_storage]"
                )
            s = _stages(len(self.stage), f"{where}: stage")
        for i, (place, entry) in enumerate(self._entries()):
            _verify_product(entry, min(i, s), s, f"{where}: {place}")
        if self.embedded:
            _verify_product(self.embedded, s, s, f"{where}: embedded")

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
        if self.embedded:
            for r, row in enumerate(self.embedded.exp):
                yield from _row(row, f"embedded.exp[{r + 1}]")

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the commutator-free method, and its embedded update."""
        if self.low_storage:
            s = len(self.low_storage.B)
            A, B = (_filled(values, f"low_storage.{key}", s, ring) for key in "AB")
            method = _low_storage(A, B, ring)
        else:
            s = len(self.stage)
            *stages, update = (_product(entry, place, values, s, ring) for place, entry in self._entries())
            method = CommutatorFree(tuple(stages), update)
        if self.embedded is None:
            return method, None
        lower = _product(self.embedded, "embedded", values, s, ring)
        if method.same_update(lower, ring):
            raise _identically_zero(f"{self.name}: embedded", "another product than the update")
        return method, EmbeddedUpdate(lower, self.embedded.order)


def _verify_product(entry: StageEntry, before: int, s: int, where: str) -> None:
    """Check that rows are no longer than s and that the product starts from one of the stages before it."""
    for r, row in enumerate(entry.exp):
        _short_enough(row, s, f"{where}.exp[{r + 1}]")
    if entry.start is not None and not 1 <= entry.start <= before:
        raise TableauError(
            f"from = {entry.start}",
            where=where,
            expected=f"an earlier stage, 1 to {before}"
            if before
            else "no from: nothing comes before stage 1",
        )


def _product(entry: StageEntry, place: str, values: Mapping[str, Element], s: int, ring: Ring) -> Stage:
    rows = tuple(_filled(values, f"{place}.exp[{r + 1}]", s, ring) for r in range(len(entry.exp)))
    return Stage(None if entry.start is None else entry.start - 1, rows)


def _identically_zero(where: str, expected: str) -> TableauError:
    return TableauError(
        "an embedded row equal to the main one: its error estimate is identically zero",
        where=where,
        expected=expected,
    )


def _low_storage(A: Row, B: Row, ring: Ring) -> CommutatorFree:
    """Expand a 2N scheme: stage i + 1 is one exponential, of B_i K_i, on stage i.

    K_i = F_i + sum_{j < i} A_{j+1} ... A_i F_j; ``register`` is the sum, F_i is not multiplied by one.
    """
    s = len(B)
    register: list[Element] = []
    products = [Stage(None, ())]
    for i in range(s):
        register = [*(A[i] * x for x in register), A[i]] if i else []
        row = (*(B[i] * x for x in register), B[i], *([ring.zero] * (s - i - 1)))
        products.append(Stage(i, (row,)))
    return CommutatorFree(tuple(products[:-1]), products[-1])


class CompositionFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "composition"``: steps gamma of a symmetric method of order 2, or pairs alpha, beta."""

    base: Literal["symmetric-2", "adjoint-pair"]
    gamma: list[Coefficient] | None = None
    alpha: list[Coefficient] | None = None
    beta: list[Coefficient] | None = None

    def verify(self, where: str) -> None:
        """Check that the steps are those of the base, and that each alpha has its beta."""
        pair = self.base == "adjoint-pair"
        for key, row in (("gamma", self.gamma), ("alpha", self.alpha), ("beta", self.beta)):
            if (row is None) is (pair is (key != "gamma")):
                raise TableauError(
                    f"{'no ' if row is None else ''}{key} with base {self.base}",
                    where=where,
                    expected="alpha and beta with base adjoint-pair, gamma with base symmetric-2",
                )
        for key, row in self._rows():
            _stages(len(row), f"{where}: {key}")
        if self.alpha and self.beta and len(self.alpha) != len(self.beta):
            raise TableauError(
                f"{len(self.beta)} entries for {len(self.alpha)} in alpha",
                where=f"{where}: beta",
                expected="alpha and beta of one length",
            )

    def _rows(self) -> Iterator[tuple[str, list[Coefficient]]]:
        for key, row in (("gamma", self.gamma), ("alpha", self.alpha), ("beta", self.beta)):
            if row is not None:
                yield key, row

    def coefficients(self) -> Places:
        """Yield the steps."""
        for key, row in self._rows():
            yield from _row(row, key)

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the composition."""
        rows = {key: _filled(values, key, len(row), ring) for key, row in self._rows()}
        if self.base == "adjoint-pair":
            return AdjointComposition(rows["alpha"], rows["beta"]), None
        return Composition(self.base, rows["gamma"]), None


class SplittingFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "splitting"``: the flows of named parts in turn; ``rkn`` is V with [V,[V,[V,T]]] = 0."""

    parts: list[str]
    step: list[tuple[str, Coefficient]]
    rkn: str | None = None

    def verify(self, where: str) -> None:
        """Check that parts are named once each and that steps and ``rkn`` name parts."""
        if not 2 <= len(self.parts) <= MAX_PARTS:
            raise TableauError(
                f"{len(self.parts)} parts", where=f"{where}: parts", expected=f"2 to {MAX_PARTS} parts"
            )
        for name in self.parts:
            if not name or self.parts.count(name) > 1:
                found = f"the part {name!r} twice" if name else "a part without name"
                raise TableauError(found, where=f"{where}: parts", expected="a name for each part")
        _stages(len(self.step), f"{where}: step")
        known = ", ".join(self.parts)
        for k, (name, _) in enumerate(self.step):
            if name not in self.parts:
                raise TableauError(
                    f"the part {name!r}", where=f"{where}: step[{k + 1}]", expected=f"one of {known}"
                )
        if self.rkn is not None and (self.rkn not in self.parts or len(self.parts) != 2):
            raise TableauError(
                f"rkn = {self.rkn!r} with parts {known}",
                where=f"{where}: rkn",
                expected="two parts and the name of the one that is linear in no velocity, V",
            )

    def coefficients(self) -> Places:
        """Yield the steps."""
        for k, (_, spelled) in enumerate(self.step):
            yield f"step[{k + 1}]", spelled

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the splitting."""
        steps = tuple(
            (self.parts.index(name), values[f"step[{k + 1}]"]) for k, (name, _) in enumerate(self.step)
        )
        rkn = None if self.rkn is None else self.parts.index(self.rkn)
        return Splitting(tuple(self.parts), steps, rkn), None


class MagnusFile(Format, forbid_unknown_fields=True, kw_only=True):
    """``family = "magnus"``: nodes c and exponents, tables of brackets over nodes counted from 1.

    ``elements`` names Lie elements for those after it and for the exponents; ``map`` is ``exp`` or ``cay``.
    """

    c: list[Coefficient]
    exponents: list[dict[str, Coefficient]]
    elements: dict[str, dict[str, Coefficient]] = {}
    map: Literal["exp", "cay"] = "exp"

    def _tables(self) -> Iterator[tuple[str, dict[str, Coefficient]]]:
        for name, table in self.elements.items():
            yield f"elements.{name}", table
        for k, table in enumerate(self.exponents):
            yield f"exponents[{k + 1}]", table

    def verify(self, where: str) -> None:
        """Check that terms are brackets of nodes and of elements named before, products with cay alone."""
        s = _stages(len(self.c), f"{where}: c")
        _stages(len(self.exponents), f"{where}: exponents", "exponents")
        known: list[str] = []
        for place, table in self._tables():
            terms = []
            for key in table:
                term = parse_term(key, f"{where}: {place}")
                self._verify_term(term, key, s, known, f"{where}: {place}")
                if term in terms:
                    raise TableauError(
                        f"the term {spell_term(term)!r} twice", where=f"{where}: {place}", expected="it once"
                    )
                terms.append(term)
            if place.startswith("elements."):
                name = place.removeprefix("elements.")
                if not name.isidentifier() or not name.isascii():
                    raise TableauError(
                        f"the name {name!r}",
                        where=f"{where}: elements",
                        expected="a letter, then letters and digits",
                    )
                known.append(name)

    def _verify_term(self, term: Term, key: str, s: int, known: list[str], where: str) -> None:
        for leaf in leaves(term):
            if isinstance(leaf, int) and not 0 <= leaf < s:
                raise TableauError(f"the node {leaf + 1} in {key!r}", where=where, expected=f"1 to {s}")
            if isinstance(leaf, str) and leaf not in known:
                names = ", ".join(known) or "none"
                raise TableauError(
                    f"the name {leaf!r} in {key!r}", where=where, expected=f"an element before it ({names})"
                )
        if self.map == "exp" and has_product(term):
            raise TableauError(
                f"the product {key!r}",
                where=where,
                expected='brackets; products stand with map = "cay" alone',
            )

    def coefficients(self) -> Places:
        """Yield the nodes, then the coefficients of the elements and the exponents."""
        yield from _row(self.c, "c")
        for place, table in self._tables():
            for key, spelled in table.items():
                yield f"{place}.{key}", spelled

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the method; TableauError where products do not pair up to elements of quadratic groups."""
        tables = {
            place: tuple((parse_term(key, place), values[f"{place}.{key}"]) for key in table)
            for place, table in self._tables()
        }
        method = Magnus(
            _filled(values, "c", len(self.c), ring),
            tuple(tables[f"exponents[{k + 1}]"] for k in range(len(self.exponents))),
            tuple((name, tables[f"elements.{name}"]) for name in self.elements),
            self.map,
        )
        # brackets alone lie in every Lie algebra
        products = any(has_product(term) for table in tables.values() for term, _ in table)
        for k, series in enumerate(method.words(ring) if products else ()):
            for word, value in series.items():
                mirrored = series.get(word[::-1], ring.zero)
                if ring.is_zero(value - mirrored if len(word) % 2 else value + mirrored) is False:
                    raise TableauError(
                        f"a product that leaves quadratic groups in exponent {k + 1}",
                        where=f"{self.name}: exponents[{k + 1}]",
                        expected="x*y*z beside z*y*x with one coefficient, x*y beside y*x with opposite ones",
                    )
        return method, None


FORMATS: dict[str, type[Format]] = {
    "cf": CommutatorFreeFile,
    "composition": CompositionFile,
    "magnus": MagnusFile,
    "prk": PartitionedFile,
    "rk": RungeKuttaFile,
    "splitting": SplittingFile,
}


def _row(row: list[Coefficient], place: str) -> Places:
    for j, spelled in enumerate(row):
        yield f"{place}[{j + 1}]", spelled


def _filled(values: Mapping[str, Element], place: str, s: int, ring: Ring) -> Row:
    """Return the row at ``place``, zeros following what the file gives."""
    return tuple(values.get(f"{place}[{j + 1}]", ring.zero) for j in range(s))


def _stages(s: int, where: str, noun: str = "stages") -> int:
    if not 1 <= s <= MAX_STAGES:
        raise TableauError(f"{s} {noun}", where=where, expected=f"1 to {MAX_STAGES}")
    return s


def _short_enough(row: list[Coefficient], s: int, where: str) -> None:
    if len(row) > s:
        raise TableauError(
            f"{len(row)} entries",
            where=where,
            expected=f"at most {s}, one for each stage (zeros may be left out)",
        )
