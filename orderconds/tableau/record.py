"""The tableau: the coefficients of a method over one ring, with their source and the claims of the file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.claims import Claims
from orderconds.tableau.file import File, parsed, read, text_of
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
from orderconds.tableau.unknowns import Proof


@dataclass(frozen=True)
class Tableau:
    """A named method over ``ring``; ``family`` is the format of its file: ``rk``, ``prk``, ``cf``, ..."""

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
    """The equations that the true values of the rounded decimals solve; None if the file names none."""
    file: File | None = field(default=None, compare=False, repr=False)
    """The file from which the tableau was read; None if the coefficients differ from the coefficients of the
    file."""
    doubles: bool = False
    """Whether coefficients were given as binary floats (:mod:`orderconds.tableau.doubles`)."""

    @staticmethod
    def load(path: str | Path) -> Tableau:
        """Read a tableau file. Raises :class:`orderconds.errors.TableauError`, whose message names the file
        and the key."""
        return load(path)

    @staticmethod
    def loads(text: str, where: str = "<text>") -> Tableau:
        """Read a tableau from TOML text; ``where`` names it in messages."""
        return loads(text, where)

    def over(self, ring: Ring, convert: Callable[[Element], Element] | None = None) -> Tableau:
        """Return the same method with coefficients in another ring.

        ``convert`` maps one coefficient. By default it is the embedding of the tableau's ring in ``ring``.
        Raises TypeError if there is no embedding (:func:`orderconds.ring.embed.embedding`).
        """
        if convert is None:
            from orderconds.ring.embed import embedding

            convert = embedding(self.ring, ring)
        embedded = None if self.embedded is None else self.embedded.map(convert)
        return replace(
            self, ring=ring, method=self.method.map(convert), embedded=embedded, proof=None, file=None
        )

    def lower(self) -> Tableau | None:
        """Return the method with the same stages and with the embedded row as its update. Return None if
        there is no embedded row.

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
        """Return the method in the first of these formats to which it can be converted, or None.

        A tableau has the format of its file. A composition also has the format ``rk`` (composed midpoints, or
        Euler methods for an adjoint pair). A composition of an adjoint pair has the format ``splitting`` as
        well.
        """
        method = self.method
        for wanted in formats:
            if wanted == self.family:
                return method
            if wanted in READINGS and (read := READINGS[wanted](method, self.ring)) is not None:
                return read
        return None

    def abelian(self) -> RungeKutta:
        """Return the Runge-Kutta tableau of this method on an abelian group; for a partitioned pair, the
        tableau of its first part.

        Raises :class:`TableauError` for a splitting or a Magnus method.
        """
        if isinstance(self.method, PartitionedRungeKutta):
            return self.method.first()
        if isinstance(self.method, CommutatorFree | Composition | AdjointComposition):
            return self.method.as_runge_kutta(self.ring)
        if isinstance(self.method, RungeKutta):
            return self.method
        raise TableauError(
            f"a tableau of format {self.family} is not a Runge-Kutta method",
            where=self.path or self.name,
            expected="format rk, prk, cf or composition",
        )


def load(path: str | Path) -> Tableau:
    """Read the tableau file at ``path``.

    Raises :class:`TableauError` with the file, the key, its value and the expected value.

    >>> from orderconds.tableau import find
    >>> load(find("kutta3")).name
    'kutta3'
    """
    return loads(text_of(path), str(path), str(path))


def loads(text: str, where: str = "<text>", path: str | None = None) -> Tableau:
    """Read a tableau from TOML text; ``where`` names it in messages.

    >>> loads('name = "euler"\\nfamily = "rk"\\nA = [[]]\\nb = ["1"]').method
    RungeKutta(A=((0,),), b=(1,))
    """
    return from_data(parsed(text, where), where, path)


def from_data(data: Mapping[str, object], where: str = "<data>", path: str | None = None) -> Tableau:
    """Return the tableau, given the keys and values of a file as parsed from TOML or JSON.

    >>> from_data({"name": "euler", "family": "rk", "A": [[]], "b": ["1"]}).method
    RungeKutta(A=((0,),), b=(1,))
    """
    file = read(data, where)
    return Tableau(
        name=file.entry.name,
        family=file.entry.family,
        ring=file.ring,
        method=file.method,
        source=file.entry.source,
        bibtex=file.entry.bibtex,
        claims=file.claims,
        embedded=file.embedded,
        path=path,
        proof=file.proof,
        file=file,
        doubles=file.doubles,
    )


def _composed(method: Method, ring: Ring) -> Method | None:
    return method.as_runge_kutta(ring) if isinstance(method, Composition | AdjointComposition) else None


def _flows(method: Method, ring: Ring) -> Method | None:
    return method.as_splitting() if isinstance(method, AdjointComposition) else None


READINGS: dict[str, Callable[[Method, Ring], Method | None]] = {"rk": _composed, "splitting": _flows}
"""For each file format, a function that converts a method to this format, or returns None if it cannot."""
