"""The class Tableau: the coefficients of a method, their source, and claims such as the order."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib import import_module
from os import PathLike
from pathlib import Path
from types import ModuleType

from orderconds import argument
from orderconds.argument import described
from orderconds.errors import TableauError
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.butcher import tableau_html, tableau_latex
from orderconds.tableau.claims import Claims
from orderconds.tableau.construction import Claimed, commutator_free, named, runge_kutta
from orderconds.tableau.extension import Extension
from orderconds.tableau.file import File, parsed, read, text_of
from orderconds.tableau.file_format import Data
from orderconds.tableau.library import find
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    EmbeddedUpdate,
    LowerOrder,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
)
from orderconds.tableau.products import AdjointComposition, Method
from orderconds.tableau.real_number import Value, value_of
from orderconds.tableau.unknowns import Proof
from orderconds.tableau.write import as_data


@dataclass(frozen=True, repr=False)
class Tableau:
    """A named method with coefficients in ``ring``. ``family`` names the format of the coefficients in
    a tableau file, for example ``rk`` or ``cf``. The coefficients can also belong to other families.

    >>> heun = Tableau.rk([[0, 0], [1, 0]], ["1/2", "1/2"], name="heun")
    >>> heun, heun.c, heun.orders["rk"]
    (Tableau('heun', rk, 2 stages), (Fraction(0, 1), Fraction(1, 1)), 2)
    """

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
    """The table ``[proof]`` of the file. It contains equations. The rounded decimals in the file approximate
    an exact solution of these equations."""
    file: File | None = field(default=None, compare=False, repr=False)
    """The parsed tableau file, or None if the tableau is a copy with other coefficients."""
    doubles: bool = False
    """True if coefficients were given as binary floats (:mod:`orderconds.tableau.doubles`)."""

    @staticmethod
    def rk(
        A: object,
        b: object,
        bhat: object = None,
        *,
        c: object = None,
        claims: Claimed = None,
        name: str = "tableau",
        source: str = "",
    ) -> Tableau:
        """Return the Runge-Kutta method with s weights b and a matrix A of s rows.

        A and b are lists, NumPy arrays or SymPy matrices. The entries are integers, fractions, SymPy numbers,
        floats, or texts such as ``"1/4 - sqrt(3)/6"``. Short binary fractions, such as the float 0.5, are
        exact. All other floats count as rounded numbers.

        - ``bhat``: the s weights of an embedded method
        - ``c``: the abscissae, which must equal the row sums of A
        - ``claims``: the claimed order, or a mapping such as ``{"rk": 4, "vcg": 2}``

        Raises :class:`~orderconds.errors.TableauError` for a wrong entry.

        >>> Tableau.rk([[], [0.5]], [0, 1]).b
        (Fraction(0, 1), Fraction(1, 1))
        >>> Tableau.rk([[0, 0], ["half", 0]], [0, 1])
        Traceback (most recent call last):
        orderconds.errors.TableauError: tableau: A[2][1]: the name 'half'; expected a number, or a name \
from the table [numbers] (defined names: none)
        """
        data = named(runge_kutta(A, b, c, bhat), name, source, claims)
        return _with_embedded_order(data, name)

    @staticmethod
    def cf(
        stages: object,
        update: object,
        *,
        starts: Mapping[int, int] | None = None,
        embedded: object = None,
        claims: Claimed = None,
        name: str = "tableau",
        source: str = "",
    ) -> Tableau:
        """Return the commutator-free method with the given stages and the given update.

        ``stages`` contains one list of exponentials for each stage, and ``update`` is a list of exponentials.
        The first exponential of a list acts first. An exponential is a row of s coefficients (numbers as in
        :meth:`rk`), where s is the number of stages. Zeros at the end of a row may be omitted.

        - ``starts``: maps i to j if the exponentials of stage i act on the value of an earlier stage j, not
          on y0. Stages are counted from 1.
        - ``embedded``: a second update for an error estimate

        >>> euler_midpoint = Tableau.cf([[], [["1/2"]]], [[0, 1]])
        >>> euler_midpoint.orders["cf"]
        2
        """
        data = named(commutator_free(stages, update, starts, embedded), name, source, claims)
        return _with_embedded_order(data, name)

    @staticmethod
    def load(path: str | PathLike[str]) -> Tableau:
        """Read a tableau. ``path`` is the path of a tableau file, or the name of a tableau in the library.

        Raises :class:`orderconds.errors.TableauError` for a file that is not valid. Raises
        :class:`orderconds.errors.UnknownName` for a name that is not in the library.

        >>> Tableau.load("gauss2").A[0]
        (Fraction(1, 4), 1/4 - sqrt(3)/6)
        """
        if not isinstance(path, str | PathLike):
            raise TableauError(
                described(path),
                where="tableau",
                expected="a Tableau, the name of a tableau in the library, or a path",
                hint="Tableau.rk(A, b) builds a tableau from arrays",
            )
        given = Path(path)
        if given.suffix and given.suffix != ".toml":
            read_foreign: Callable[[Path], Tableau | None] = _above("exchange").load_foreign
            if (foreign := read_foreign(given)) is not None:
                return foreign
        bare = given.name == str(path) and given.suffix != ".toml"
        return load(find(given.name) if bare and not _exists(given) else given)

    @staticmethod
    def loads(text: str, where: str = "<text>") -> Tableau:
        """Return the tableau that a TOML text defines. Error messages contain ``where`` as the name of the
        text."""
        return loads(argument.text(text, "text", "TOML as a str"), where)

    @property
    def s(self) -> int:
        """The number of stages. Raises TableauError for a splitting or a Magnus method."""
        return len(self.abelian().b)

    @property
    def A(self) -> tuple[tuple[Value, ...], ...]:
        """The rows of A. Exact rational entries are Fractions. All other entries are floats if the tableau
        contains doubles, and :class:`~orderconds.tableau.real_number.RealNumber` objects otherwise.

        On vector spaces, a commutator-free method reduces to the Runge-Kutta method with the matrix A.
        """
        return tuple(self._values(x) for x in self.abelian().A)

    @property
    def b(self) -> tuple[Value, ...]:
        """The weights b. Their types are those of the entries of :attr:`A`."""
        return self._values(self.abelian().b)

    @property
    def c(self) -> tuple[Value, ...]:
        """The row sums of A. Their types are those of the entries of :attr:`A`."""
        return self._values(self.abelian().c)

    @property
    def bhat(self) -> tuple[Value, ...] | None:
        """The embedded weights, or None if there is no embedded method."""
        lower = self.lower()
        return None if lower is None else lower.b

    @property
    def extension(self) -> Extension | None:
        """The continuous extension in the tableau file, or None. A copy of the tableau with other
        coefficients has no extension."""
        return None if self.file is None else self.file.extension

    def _values(self, row: Row) -> tuple[Value, ...]:
        return tuple(value_of(x, self.ring, self.doubles) for x in row)

    @cached_property
    def orders(self) -> dict[str, int]:
        """The computed order of the method in each family of integrators, for example ``{"rk": 4, ...}``."""
        orders_of: Callable[[Tableau], dict[str, int]] = _above("checking.computed_orders").orders_of
        return orders_of(self)

    def __repr__(self) -> str:
        return f"Tableau({self.name!r}, {self.family}{self._stages()})"

    def _stages(self) -> str:
        if not isinstance(self.method, RungeKutta | PartitionedRungeKutta | CommutatorFree):
            return ""
        return f", {self.s} stage" + "s" * (self.s != 1)

    def __hash__(self) -> int:
        # The coefficients may be balls or algebraic numbers, which cannot be hashed.
        return hash((self.name, self.family, self.source, self.bibtex, self.path, self.doubles))

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {tableau_latex(self)}$"

    def _repr_html_(self) -> str:
        return tableau_html(self)

    def __reduce__(self) -> tuple[Callable[..., Tableau], tuple[object, ...]]:
        # Objects of python-flint cannot be pickled.
        where = self.path or self.name
        return from_data, (as_data(self), where, self.path)

    def over(self, ring: Ring, convert: Callable[[Element], Element] | None = None) -> Tableau:
        """Return a copy of the tableau with coefficients in ``ring``.

        If ``convert`` is None, the ring of this tableau is embedded in ``ring``. Raises TypeError if
        ``convert`` is None and there is no embedding (:func:`orderconds.ring.embed.embedding`).
        """
        if convert is None:
            from orderconds.ring.embed import embedding

            convert = embedding(self.ring, ring)
        embedded = None if self.embedded is None else self.embedded.map(convert)
        return replace(
            self, ring=ring, method=self.method.map(convert), embedded=embedded, proof=None, file=None
        )

    def lower(self) -> Tableau | None:
        """Return the embedded method as a tableau with the stages of this tableau, or None if there is no
        embedded method. The result has no claims, because the claims of this tableau do not concern the
        embedded method.

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
        return replace(self, method=lower, claims=Claims(), embedded=None, proof=None, file=None)

    def read_as(self, formats: tuple[str, ...]) -> Method | None:
        """Convert the method to the first format in ``formats`` for which a conversion exists. Return None if
        there is no such format.

        In the format ``rk``, a composition of symmetric steps becomes a composition of implicit midpoint
        rules. A composition with adjoints becomes a composition of explicit and implicit Euler methods.
        """
        method = self.method
        for wanted in formats:
            if wanted == self.family:
                return method
            if wanted in READINGS and (read := READINGS[wanted](method, self.ring)) is not None:
                return read
        return None

    def abelian(self) -> RungeKutta:
        """Return the Runge-Kutta tableau (A, b) to which this method reduces on vector spaces. For a
        partitioned method, return the tableau for the first part of the system.

        Raises :class:`TableauError` for a splitting or a Magnus method.
        """
        if isinstance(self.method, PartitionedRungeKutta):
            return self.method.first()
        if isinstance(self.method, CommutatorFree | Composition | AdjointComposition):
            return self.method.as_runge_kutta(self.ring)
        if isinstance(self.method, RungeKutta):
            return self.method
        raise TableauError(
            f"a tableau of format {self.family} cannot be converted to a Runge-Kutta method",
            where=self.path or self.name,
            expected="format rk, prk, cf or composition",
        )


def load(path: str | Path) -> Tableau:
    """Read the tableau file at ``path``.

    Raises :class:`TableauError` for a file that is not valid.

    >>> from orderconds.tableau import find
    >>> load(find("kutta3")).name
    'kutta3'
    """
    return loads(text_of(path), str(path), str(path))


def loads(text: str, where: str = "<text>", path: str | None = None) -> Tableau:
    """Return the tableau that a TOML text defines. Error messages contain ``where`` as the name of the text.

    >>> loads('name = "euler"\\nfamily = "rk"\\nA = [[]]\\nb = ["1"]').method
    RungeKutta(A=((0,),), b=(1,))
    """
    return from_data(parsed(text, where), where, path)


def from_data(data: Mapping[str, object], where: str = "<data>", path: str | None = None) -> Tableau:
    """Return the tableau that ``data`` defines. ``data`` contains keys and values, parsed from TOML or JSON.

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


def _exists(path: Path) -> bool:
    """Return True if ``path`` is an existing file or folder. Return False if the operating system rejects
    the path, for example because the path is too long."""
    try:
        return path.exists()
    except OSError:
        return False


def _with_embedded_order(data: Data, name: str) -> Tableau:
    """Return the tableau that ``data`` defines. The file format requires the order of an embedded method, so
    this order is computed and stored in ``data``."""
    tableau = from_data(data, name)
    family: Callable[[str], object] = _above("families").get
    for claim in tableau.claims.orders:
        family(claim.family)  # raises UnknownName for an unknown family
    lower = tableau.lower()
    if lower is None:
        return tableau
    order_on_vector_spaces: Callable[[Tableau], int] = _above("exchange").order_on_vector_spaces
    data["embedded"]["order"] = max(1, order_on_vector_spaces(lower))
    return from_data(data, name)


def _above(module: str) -> ModuleType:
    """Import ``orderconds.<module>`` at the time of the call, because an import at the top of this file would
    be circular."""
    return import_module(f"orderconds.{module}")


def _composed(method: Method, ring: Ring) -> Method | None:
    return method.as_runge_kutta(ring) if isinstance(method, Composition | AdjointComposition) else None


def _flows(method: Method, ring: Ring) -> Method | None:
    return method.as_splitting() if isinstance(method, AdjointComposition) else None


READINGS: dict[str, Callable[[Method, Ring], Method | None]] = {"rk": _composed, "splitting": _flows}
"""Maps the name of a tableau format to a function that converts a method to this format. The function returns
None if the method cannot be converted."""
