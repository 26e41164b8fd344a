"""The formats of a tableau file. Each subclass of :class:`Format` defines the keys of one format, and builds
a method from the values of these keys."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Annotated, ClassVar

from msgspec import Meta, Struct, field

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.extension import Extension
from orderconds.tableau.file_format import (
    Coefficient,
    Format,
    Places,
    counted,
    filled_row,
    row_places,
    verify_length,
)
from orderconds.tableau.methods import (
    CommutatorFree,
    Embedded,
    EmbeddedUpdate,
    LowerOrder,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
    Stage,
)
from orderconds.tableau.product_formats import CompositionFile, MagnusFile, SplittingFile
from orderconds.tableau.products import Method
from orderconds.tableau.two_registers import TwoRegisters

MAX_DEGREE = 40
"""The highest degree of a polynomial in a continuous extension."""


class EmbeddedEntry(Struct, forbid_unknown_fields=True):
    """The weights of an embedded method for an error estimate. The integer ``order`` is the order of the
    embedded method."""

    b: list[Coefficient]
    order: Annotated[int, Meta(ge=1)]


class ExtensionEntry(Struct, forbid_unknown_fields=True):
    """The weights b_i(theta) of a continuous extension. Row i of ``b`` contains the coefficients of theta,
    theta^2, ... in the polynomial b_i. Zeros at the end of a row may be omitted."""

    b: list[list[Coefficient]]
    order: Annotated[int, Meta(ge=1)]


class RungeKuttaFile(Format, forbid_unknown_fields=True, kw_only=True):
    """The format ``family = "rk"``: a Butcher tableau with the matrix A and the weights b. Zeros at the end
    of a row of A may be omitted. The nodes c are optional, and must equal the row sums of A.
    """

    A: list[list[Coefficient]]
    b: list[Coefficient]
    c: list[Coefficient] = field(default_factory=list)
    embedded: EmbeddedEntry | None = None
    dense: ExtensionEntry | None = None

    in_arrays: ClassVar[bool] = True
    distinctive_key: ClassVar[str] = "A"

    def verify(self, where: str) -> None:
        """Check that A has s rows, and that each row has s entries, where s is the number of entries of b. If
        the file contains c or embedded weights, check that they also have s entries."""
        s = counted(len(self.b), f"{where}: b")
        if len(self.A) != s:
            raise TableauError(
                f"A has {len(self.A)} rows, b has {s} entries",
                where=f"{where}: A",
                expected="a square A: one row for each entry of b",
            )
        for i, row in enumerate(self.A):
            verify_length(row, s, f"{where}: A[{i + 1}]")
        if self.c and len(self.c) != s:
            raise TableauError(
                f"c has {len(self.c)} entries, b has {s} entries",
                where=f"{where}: c",
                expected="c with as many entries as b",
            )
        if self.embedded:
            verify_length(self.embedded.b, s, f"{where}: embedded.b")
        if self.dense:
            self._verify_extension(self.dense, f"{where}: dense.b")

    def _verify_extension(self, dense: ExtensionEntry, where: str) -> None:
        s = len(self.b)
        if len(dense.b) != s:
            expected = f"{s} rows, one for each stage"
            raise TableauError(f"{len(dense.b)} rows", where=where, expected=expected)
        if not 1 <= max(map(len, dense.b)) <= MAX_DEGREE:
            degree = max(map(len, dense.b))
            expected = f"a degree from 1 to {MAX_DEGREE}"
            raise TableauError(f"polynomials of degree {degree}", where=where, expected=expected)

    def coefficients(self) -> Places:
        """Yield the position and the entry of every coefficient. The order is A, b, c, the embedded weights,
        and the continuous extension."""
        for i, row in enumerate(self.A):
            yield from row_places(row, f"A[{i + 1}]")
        yield from row_places(self.b, "b")
        yield from row_places(self.c, "c")
        if self.embedded:
            yield from row_places(self.embedded.b, "embedded.b")
        if self.dense:
            for i, row in enumerate(self.dense.b):
                yield from row_places(row, f"dense.b[{i + 1}]")

    def extension(self, values: Mapping[str, Element], ring: Ring) -> Extension | None:
        """Return the continuous extension, or None if the file has none."""
        if self.dense is None:
            return None
        degree = max(map(len, self.dense.b))
        rows = (filled_row(values, f"dense.b[{i + 1}]", degree, ring) for i in range(len(self.b)))
        return Extension(tuple(rows), self.dense.order)

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the Runge-Kutta method, and the embedded weights or None. Raises TableauError if c differs
        from the row sums of A, or if the embedded weights equal b."""
        s = len(self.b)
        A = tuple(filled_row(values, f"A[{i + 1}]", s, ring) for i in range(s))
        method, embedded = RungeKutta(A, filled_row(values, "b", s, ring)), None
        if self.c:
            self._compare(method, filled_row(values, "c", s, ring), ring)
        if self.embedded:
            embedded = Embedded(filled_row(values, "embedded.b", s, ring), self.embedded.order)
            if all(ring.is_zero(x - y) for x, y in zip(method.b, embedded.b, strict=True)):
                raise _identically_zero(f"{self.name}: embedded.b", "weights that differ from b")
        return method, embedded

    def _compare(self, method: RungeKutta, c: Row, ring: Ring) -> None:
        """Raise TableauError if c differs from the row sums of A."""
        for i, (given, total) in enumerate(zip(c, method.c, strict=True)):
            if ring.is_zero(given - total) is False:
                raise TableauError(
                    f"c_{i + 1} = {ring.text(given)}, but the sum of row {i + 1} of A is {ring.text(total)}",
                    where=f"{self.name}: c[{i + 1}]",
                    expected="c_i = sum_j a_ij",
                    hint="correct the row of A, or leave c out: it is computed from A",
                )


class PartitionedFile(Format, forbid_unknown_fields=True, kw_only=True):
    """The format ``family = "prk"``: a partitioned Runge-Kutta method for systems y' = f(y, z), z' = g(y, z).
    The tableau (A, b) is used for y, and the tableau (A_hat, b_hat) for z."""

    A: list[list[Coefficient]]
    b: list[Coefficient]
    A_hat: list[list[Coefficient]]
    b_hat: list[Coefficient]

    in_arrays: ClassVar[bool] = True
    distinctive_key: ClassVar[str] = "A_hat"

    def _parts(self) -> Iterator[tuple[str, list[list[Coefficient]], str, list[Coefficient]]]:
        yield "A", self.A, "b", self.b
        yield "A_hat", self.A_hat, "b_hat", self.b_hat

    def verify(self, where: str) -> None:
        """Check that b and b_hat have the same length s, that A and A_hat have s rows, and that no row has
        more than s entries."""
        s = counted(len(self.b), f"{where}: b")
        if len(self.b_hat) != s:
            raise TableauError(
                f"b_hat has {len(self.b_hat)} entries, b has {s} entries",
                where=f"{where}: b_hat",
                expected="b and b_hat of the same length",
            )
        for name, rows, weights, _ in self._parts():
            if len(rows) != s:
                raise TableauError(
                    f"{name} has {len(rows)} rows, {weights} has {s} entries",
                    where=f"{where}: {name}",
                    expected=f"a square {name}: one row for each entry of {weights}",
                )
            for i, row in enumerate(rows):
                verify_length(row, s, f"{where}: {name}[{i + 1}]")

    def coefficients(self) -> Places:
        """Yield the position and the entry of every coefficient, in the order A, b, A_hat, b_hat."""
        for name, rows, weights, b in self._parts():
            for i, row in enumerate(rows):
                yield from row_places(row, f"{name}[{i + 1}]")
            yield from row_places(b, weights)

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the pair (partitioned method, None). The second value is None, because this format has no
        embedded method."""
        s = len(self.b)
        A, A_hat = (
            tuple(filled_row(values, f"{name}[{i + 1}]", s, ring) for i in range(s))
            for name in ("A", "A_hat")
        )
        b, b_hat = (filled_row(values, name, s, ring) for name in ("b", "b_hat"))
        return PartitionedRungeKutta(A, b, A_hat, b_hat), None


class StageEntry(Struct, forbid_unknown_fields=True):
    """A product of exponentials, which acts on a point of the manifold. Let Y_j be the point of stage j,
    where the first stage is Y_1. If ``from`` is the integer j, the product acts on Y_j. If ``from`` is
    missing, the product acts on the initial value y0.

    A row beta of ``exp`` defines exp(h sum_j beta_j k_j), where h is the step size and k_j is the vector
    field at Y_j. The exponential of the first row acts first.
    """

    exp: list[list[Coefficient]] = []
    start: int | None = field(default=None, name="from")


class EmbeddedProduct(StageEntry, forbid_unknown_fields=True, kw_only=True):
    """The embedded update, for an error estimate. The embedded update is a product of exponentials. Let s be
    the number of stages.

    - If ``from`` is an integer i from 1 to s, the product acts on the point of stage i.
    - If ``from`` is s + 1, the product acts on the result of the main update.
    - If ``from`` is missing, the product acts on the initial value y0.
    """

    order: Annotated[int, Meta(ge=1)]


class LowStorage(Struct, forbid_unknown_fields=True):
    """A low-storage scheme for the state Y and one element K of the Lie algebra. Let F be the vector field
    and h the step size. Stage i replaces K by A_i K + F(Y), and then replaces Y by exp(h B_i K) Y."""

    A: list[Coefficient]
    B: list[Coefficient]


class CommutatorFreeFile(Format, forbid_unknown_fields=True, kw_only=True):
    """The format ``family = "cf"``: a commutator-free method. The file contains either stages and an update,
    or a low-storage scheme.

    ``embedded`` is a second update for an error estimate.
    """

    stage: list[StageEntry] = field(default_factory=list)
    update: StageEntry | None = None
    low_storage: LowStorage | None = None
    embedded: EmbeddedProduct | None = None

    in_arrays: ClassVar[bool] = True
    distinctive_key: ClassVar[str] = "exponentials"
    as_products: ClassVar[bool] = True

    def verify(self, where: str) -> None:
        """Check that the file contains either stages and an update, or a low-storage scheme. Check that every
        stage starts from y0 or from an earlier stage."""
        if self.low_storage:
            if self.stage or self.update:
                raise TableauError(
                    "the file contains low_storage, and also stage or update",
                    where=where,
                    expected="either low_storage, or stage and update",
                )
            s = counted(len(self.low_storage.B), f"{where}: low_storage.B")
            if len(self.low_storage.A) != s:
                raise TableauError(
                    f"A has {len(self.low_storage.A)} entries, B has {s} entries",
                    where=f"{where}: low_storage.A",
                    expected="A and B of the same length",
                )
        else:
            if self.update is None:
                raise TableauError(
                    "no update", where=where, expected="[[stage]] and [update], or [low_storage]"
                )
            s = counted(len(self.stage), f"{where}: stage")
        for i, (place, entry) in enumerate(self._entries()):
            _verify_product(entry, min(i, s), s, f"{where}: {place}")
        if self.embedded:
            _verify_product(self.embedded, s + 1, s, f"{where}: embedded")

    def _entries(self) -> Iterator[tuple[str, StageEntry]]:
        for i, entry in enumerate(self.stage):
            yield f"stage[{i + 1}]", entry
        if self.update:
            yield "update", self.update

    def coefficients(self) -> Places:
        """Yield the position and the entry of every coefficient. The embedded update is last."""
        if self.low_storage:
            yield from row_places(self.low_storage.A, "low_storage.A")
            yield from row_places(self.low_storage.B, "low_storage.B")
        for place, entry in self._entries():
            for r, row in enumerate(entry.exp):
                yield from row_places(row, f"{place}.exp[{r + 1}]")
        if self.embedded:
            for r, row in enumerate(self.embedded.exp):
                yield from row_places(row, f"embedded.exp[{r + 1}]")

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the pair (commutator-free method, embedded update). If the file has no embedded update, the
        second value is None."""
        if self.low_storage:
            s = len(self.low_storage.B)
            A, B = (filled_row(values, f"low_storage.{key}", s, ring) for key in "AB")
            method = TwoRegisters(A, B).as_commutator_free(ring)
        else:
            s = len(self.stage)
            *stages, update = (_product(entry, place, values, s, ring) for place, entry in self._entries())
            method = CommutatorFree(tuple(stages), update)
        if self.embedded is None:
            return method, None
        lower = _product(self.embedded, "embedded", values, s, ring)
        if lower.start == s:
            lower = Stage(method.update.start, (*method.update.exponentials, *lower.exponentials))
        if method.same_update(lower, ring):
            raise _identically_zero(f"{self.name}: embedded", "a product that differs from the update")
        return method, EmbeddedUpdate(lower, self.embedded.order)


def _verify_product(entry: StageEntry, before: int, s: int, where: str) -> None:
    for r, row in enumerate(entry.exp):
        verify_length(row, s, f"{where}.exp[{r + 1}]")
    if entry.start is not None and not 1 <= entry.start <= before:
        raise TableauError(
            f"from = {entry.start}",
            where=where,
            expected=f"an earlier stage, 1 to {before}"
            if before
            else "no key 'from', because there is no earlier stage",
        )


def _product(entry: StageEntry, place: str, values: Mapping[str, Element], s: int, ring: Ring) -> Stage:
    rows = tuple(filled_row(values, f"{place}.exp[{r + 1}]", s, ring) for r in range(len(entry.exp)))
    return Stage(None if entry.start is None else entry.start - 1, rows)


def _identically_zero(where: str, expected: str) -> TableauError:
    return TableauError(
        "an embedded method that is equal to the method itself: the error estimate would always be zero",
        where=where,
        expected=expected,
    )


FORMATS: dict[str, type[Format]] = {
    "cf": CommutatorFreeFile,
    "composition": CompositionFile,
    "magnus": MagnusFile,
    "prk": PartitionedFile,
    "rk": RungeKuttaFile,
    "splitting": SplittingFile,
}


def array_format(names: Collection[str]) -> str:
    """Return the name of the format of a tableau that is stored as arrays with the given ``names``. A format
    fits if ``names`` contains the ``distinctive_key`` of the format. The result is the alphabetically first
    format that fits, or ``composition`` if no format fits.

    >>> array_format(["A", "b"]), array_format(["A", "A_hat"]), array_format(["alpha", "beta"])
    ('rk', 'prk', 'composition')
    """
    kinds = {name: kind for name, kind in FORMATS.items() if kind.in_arrays}
    distinct = [name for name, kind in kinds.items() if kind.distinctive_key in names]
    return min(distinct or [name for name, kind in kinds.items() if not kind.distinctive_key])
