"""The file formats of compositions, splitting methods and Magnus methods."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import ClassVar, Literal

from msgspec import field

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.brackets import Term, has_product, leaves
from orderconds.tableau.brackets import parse as parse_term
from orderconds.tableau.brackets import spell as spell_term
from orderconds.tableau.file_format import (
    MAX_PARTS,
    Coefficient,
    Data,
    Format,
    Places,
    counted,
    filled_row,
    row_places,
)
from orderconds.tableau.methods import (
    Composition,
    LowerOrder,
)
from orderconds.tableau.products import AdjointComposition, Magnus, Method, Splitting


class CompositionFile(Format, forbid_unknown_fields=True, kw_only=True):
    """The format ``family = "composition"``: a composition of basic steps.

    With the key gamma, all steps use one symmetric method of order 2, and the step sizes are gamma_i h. With
    the keys alpha and beta, steps alpha_i h of a basic method alternate with steps beta_i h of its adjoint.
    """

    base: Literal["symmetric-2", "adjoint-pair"]
    gamma: list[Coefficient] | None = None
    alpha: list[Coefficient] | None = None
    beta: list[Coefficient] | None = None

    in_arrays: ClassVar[bool] = True

    @classmethod
    def defaults(cls, names: Collection[str]) -> Data:
        """Return a dictionary with the key ``base``. Its value is ``symmetric-2`` if ``names`` contains
        gamma, and ``adjoint-pair`` otherwise."""
        return {"base": "symmetric-2" if "gamma" in names else "adjoint-pair"}

    def verify(self, where: str) -> None:
        """Check that the file contains the correct keys: gamma for the base ``symmetric-2``, or alpha and
        beta of equal length for the base ``adjoint-pair``."""
        pair = self.base == "adjoint-pair"
        for key, row in (("gamma", self.gamma), ("alpha", self.alpha), ("beta", self.beta)):
            if (row is None) is (pair is (key != "gamma")):
                raise TableauError(
                    f"base = {self.base} {'without' if row is None else 'with'} the key {key}",
                    where=where,
                    expected="alpha and beta if the base is adjoint-pair, or gamma if the base is "
                    "symmetric-2",
                )
        for key, row in self._rows():
            counted(len(row), f"{where}: {key}")
        if self.alpha and self.beta and len(self.alpha) != len(self.beta):
            raise TableauError(
                f"beta has {len(self.beta)} entries, alpha has {len(self.alpha)}",
                where=f"{where}: beta",
                expected="alpha and beta of the same length",
            )

    def _rows(self) -> Iterator[tuple[str, list[Coefficient]]]:
        for key, row in (("gamma", self.gamma), ("alpha", self.alpha), ("beta", self.beta)):
            if row is not None:
                yield key, row

    def coefficients(self) -> Places:
        """Yield the coefficients gamma, or alpha and beta, with their positions in the file."""
        for key, row in self._rows():
            yield from row_places(row, key)

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return a pair: the composition method, and None (no embedded method)."""
        rows = {key: filled_row(values, key, len(row), ring) for key, row in self._rows()}
        if self.base == "adjoint-pair":
            return AdjointComposition(rows["alpha"], rows["beta"]), None
        return Composition(self.base, rows["gamma"]), None


class SplittingFile(Format, forbid_unknown_fields=True, kw_only=True):
    """The format ``family = "splitting"``: a product of flows of the parts of a vector field.

    ``parts`` contains the names of the parts. The optional key ``rkn`` is for two parts T and V with
    [V,[V,[V,T]]] = 0. Its value is the name of V.
    """

    parts: list[str]
    step: list[tuple[str, Coefficient]]
    rkn: str | None = None

    def verify(self, where: str) -> None:
        """Check that the parts have different names, and that each flow in ``step`` is the flow of a part.
        The optional key ``rkn`` requires two parts, and the value of ``rkn`` must be the name of a part."""
        if not 2 <= len(self.parts) <= MAX_PARTS:
            raise TableauError(
                f"{len(self.parts)} parts", where=f"{where}: parts", expected=f"2 to {MAX_PARTS} parts"
            )
        for name in self.parts:
            if not name or self.parts.count(name) > 1:
                problem = f"the part {name!r} twice" if name else "a part without name"
                raise TableauError(problem, where=f"{where}: parts", expected="different names of the parts")
        counted(len(self.step), f"{where}: step")
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
                expected="two parts, and the name of one part as the value of rkn, such as "
                'parts = ["T", "V"] and rkn = "V"',
            )

    def coefficients(self) -> Places:
        """Yield the coefficients of the flows, with their positions in the file."""
        for k, (_, coefficient) in enumerate(self.step):
            yield f"step[{k + 1}]", coefficient

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return a pair: the splitting method, and None (no embedded method)."""
        steps = tuple(
            (self.parts.index(name), values[f"step[{k + 1}]"]) for k, (name, _) in enumerate(self.step)
        )
        rkn = None if self.rkn is None else self.parts.index(self.rkn)
        return Splitting(tuple(self.parts), steps, rkn), None


class MagnusFile(Format, forbid_unknown_fields=True, kw_only=True):
    """The format ``family = "magnus"``: the nodes c, and one table for each exponent. The table contains the
    coefficient of each term. A term is written as the number of a node (counted from 1), as the name of an
    element, or as a bracket of two terms.

    ``elements`` defines named Lie elements. ``map`` is the map to the group: ``exp`` (exponential) or ``cay``
    (Cayley transform). With ``cay``, a term may also be a product of terms.
    """

    c: list[Coefficient]
    exponents: list[dict[str, Coefficient]]
    elements: dict[str, dict[str, Coefficient]] = field(default_factory=dict)
    map: Literal["exp", "cay"] = "exp"

    def _tables(self) -> Iterator[tuple[str, dict[str, Coefficient]]]:
        for name, table in self.elements.items():
            yield f"elements.{name}", table
        for k, table in enumerate(self.exponents):
            yield f"exponents[{k + 1}]", table

    def verify(self, where: str) -> None:
        """Check the terms of all elements and exponents. If the definition of an element contains the
        name of another element, the other element must be defined earlier."""
        s = counted(len(self.c), f"{where}: c")
        counted(len(self.exponents), f"{where}: exponents", "exponents")
        known: list[str] = []
        for place, table in self._tables():
            terms = []
            for key in table:
                term = parse_term(key, f"{where}: {place}")
                self._verify_term(term, key, s, known, f"{where}: {place}")
                if term in terms:
                    raise TableauError(
                        f"the term {spell_term(term)!r} occurs twice",
                        where=f"{where}: {place}",
                        expected="each term at most once",
                    )
                terms.append(term)
            if place.startswith("elements."):
                name = place.removeprefix("elements.")
                if not name.isidentifier() or not name.isascii():
                    raise TableauError(
                        f"the name {name!r}",
                        where=f"{where}: elements",
                        expected="a letter, then letters, digits and _",
                    )
                known.append(name)

    def _verify_term(self, term: Term, key: str, s: int, known: list[str], where: str) -> None:
        for leaf in leaves(term):
            if isinstance(leaf, int) and not 0 <= leaf < s:
                raise TableauError(
                    f"the node {leaf + 1} in {key!r}", where=where, expected=f"a node from 1 to {s}"
                )
            if isinstance(leaf, str) and leaf not in known:
                names = ", ".join(known) or "none"
                raise TableauError(
                    f"the name {leaf!r} in {key!r}",
                    where=where,
                    expected=f"a name from the table [elements] (names that are allowed here: {names})",
                )
        if self.map == "exp" and has_product(term):
            raise TableauError(
                f"the product {key!r}",
                where=where,
                expected='a bracket, or map = "cay"',
            )

    def coefficients(self) -> Places:
        """Yield a pair such as ``("c[1]", "1/2")`` for every coefficient: the position of the coefficient in
        the file, and the coefficient."""
        yield from row_places(self.c, "c")
        for place, table in self._tables():
            for key, coefficient in table.items():
                yield f"{place}.{key}", coefficient

    def build(self, values: Mapping[str, Element], ring: Ring) -> tuple[Method, LowerOrder | None]:
        """Return the Magnus method, and None instead of an embedded update.

        Consider the equation Y' = A(t) Y on a quadratic Lie group, for example SO(n) or Sp(2n). The matrices
        A(t) lie in the Lie algebra of this group. Each exponent of the method must lie in this Lie algebra,
        too. TableauError is raised if an exponent violates this requirement for some quadratic Lie group.
        """
        tables = {
            place: tuple((parse_term(key, place), values[f"{place}.{key}"]) for key in table)
            for place, table in self._tables()
        }
        method = Magnus(
            filled_row(values, "c", len(self.c), ring),
            tuple(tables[f"exponents[{k + 1}]"] for k in range(len(self.exponents))),
            tuple((name, tables[f"elements.{name}"]) for name in self.elements),
            self.map,
        )
        # A product of two elements of a Lie algebra may lie outside the Lie algebra.
        products = any(has_product(term) for table in tables.values() for term, _ in table)
        for k, series in enumerate(method.words(ring) if products else ()):
            for word, value in series.items():
                mirrored = series.get(word[::-1], ring.zero)
                if ring.is_zero(value - mirrored if len(word) % 2 else value + mirrored) is False:
                    raise TableauError(
                        f"for some quadratic Lie groups, exponent number {k + 1} is not in the Lie algebra",
                        where=f"{self.name}: exponents[{k + 1}]",
                        expected="a linear combination of A, A*B - B*A, A*B*C + C*B*A, A*B*C*D - D*C*B*A, "
                        "..., where A, B, C, D are values of the matrix at nodes",
                    )
        return method, None
