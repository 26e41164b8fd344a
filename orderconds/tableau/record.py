"""The tableau: exact coefficients over one ring, with their source and what the file claims of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from msgspec import Struct

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    EmbeddedUpdate,
    LowerOrder,
    PartitionedRungeKutta,
    RungeKutta,
)
from orderconds.tableau.products import AdjointComposition, Method
from orderconds.tableau.unknowns import Proof, Spelled


@dataclass(frozen=True)
class OrderClaim:
    """The claim that ``family`` (with ``cutoff``, where it takes one) has exactly this order."""

    family: str
    cutoff: int | None
    order: int

    @property
    def label(self) -> str:
        """The family as reports name it: ``vcg``, ``rkmk(1)``."""
        return self.family if self.cutoff is None else f"{self.family}({self.cutoff})"


@dataclass(frozen=True)
class Claims:
    """What a tableau file says of its method; every entry is compared with what is computed."""

    orders: tuple[OrderClaim, ...] = ()
    properties: dict[str, bool] = field(default_factory=dict)

    def order(self, family: str, cutoff: int | None = None) -> int | None:
        """Return the claimed order of a family, or None where nothing is claimed."""
        for claim in self.orders:
            if (claim.family, claim.cutoff) == (family, cutoff):
                return claim.order
        return None


class File(Struct, frozen=True):
    """What a file spells: its keys and values, and the method, embedded row and claims that were read."""

    data: Mapping[str, object]
    spelled: Spelled
    method: Method
    embedded: LowerOrder | None
    claims: Claims


@dataclass(frozen=True)
class Tableau:
    """A named method over ``ring``; ``family`` is its file's format: ``rk``, ``prk``, ``cf`` ...."""

    name: str
    family: str
    ring: Ring
    method: Method
    source: str = ""
    bibtex: str = ""
    claims: Claims = field(default_factory=Claims)
    embedded: LowerOrder | None = None
    path: str | None = None
    proof: Proof | None = field(default=None, compare=False)
    """Which equations the rounded decimals solve, where the file says so."""
    file: File | None = field(default=None, compare=False, repr=False)
    """How the coefficients are spelled, as long as they are those of the file."""

    @staticmethod
    def load(path: str | Path) -> Tableau:
        """Read a tableau file; raises :class:`orderconds.errors.TableauError` naming file and key."""
        from orderconds.tableau.file import load

        return load(path)

    @staticmethod
    def loads(text: str, where: str = "<text>") -> Tableau:
        """Read a tableau from TOML text; ``where`` names it in messages."""
        from orderconds.tableau.file import loads

        return loads(text, where)

    def over(self, ring: Ring, convert: Callable[[Element], Element] | None = None) -> Tableau:
        """Return the same method with coefficients in another ring.

        ``convert`` maps one coefficient; without it the embedding of this ring in ``ring`` is used
        (:func:`orderconds.ring.embed.embedding`), which raises TypeError where there is none.
        """
        if convert is None:
            from orderconds.ring.embed import embedding

            convert = embedding(self.ring, ring)
        embedded = None if self.embedded is None else self.embedded.map(convert)
        return replace(
            self, ring=ring, method=self.method.map(convert), embedded=embedded, proof=None, file=None
        )

    def lower(self) -> Tableau | None:
        """Return the method that the embedded row makes of the same stages, None where there is none.

        >>> from orderconds.tableau import find
        >>> [str(x) for x in Tableau.load(find("cg3")).lower().method.b]
        ['17/54', '19/54', '1/3']
        """
        method, embedded = self.method, self.embedded
        if isinstance(embedded, Embedded) and isinstance(method, RungeKutta):
            lower: Method = RungeKutta(method.A, embedded.b)
        elif isinstance(embedded, EmbeddedUpdate) and isinstance(method, CommutatorFree):
            lower = CommutatorFree(method.stages, embedded.update)
        else:
            return None
        return replace(self, method=lower, embedded=None, proof=None, file=None)

    def read_as(self, formats: tuple[str, ...]) -> Method | None:
        """Return the method in the first of these formats that it can be read in, or None.

        A tableau reads as what its file says; a composition also as ``rk`` (composed midpoints, or Euler
        methods for an adjoint pair), one of an adjoint pair as ``splitting`` too. How an ``rk`` tableau
        serves other families is for the family to say.
        """
        method = self.method
        for wanted in formats:
            if wanted == self.family:
                return method
            if wanted in READINGS and (read := READINGS[wanted](method, self.ring)) is not None:
                return read
        return None

    def abelian(self) -> RungeKutta:
        """Return the Runge-Kutta tableau this method is on an abelian group; of a pair, the first part's.

        Raises :class:`TableauError` for a splitting or a Magnus method, which is none.
        """
        if isinstance(self.method, PartitionedRungeKutta):
            return self.method.first()
        if isinstance(self.method, CommutatorFree | Composition | AdjointComposition):
            return self.method.as_runge_kutta(self.ring)
        if isinstance(self.method, RungeKutta):
            return self.method
        raise TableauError(
            f"a tableau of format {self.family} is no Runge-Kutta method",
            where=self.path or self.name,
            expected="format rk, prk, cf or composition",
        )


def _composed(method: Method, ring: Ring) -> Method | None:
    return method.as_runge_kutta(ring) if isinstance(method, Composition | AdjointComposition) else None


def _flows(method: Method, ring: Ring) -> Method | None:
    return method.as_splitting() if isinstance(method, AdjointComposition) else None


READINGS: dict[str, Callable[[Method, Ring], Method | None]] = {"rk": _composed, "splitting": _flows}
"""File format to the function that reads methods of other formats in it; None for those it does not read."""
