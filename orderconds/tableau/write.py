"""Conversion of a tableau to a tableau file. Reading the file gives the same tableau."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import deepcopy
from typing import TYPE_CHECKING, Any

from orderconds.ring.protocol import Element
from orderconds.tableau.brackets import Combination, spell
from orderconds.tableau.claims import Claims
from orderconds.tableau.file_format import Data
from orderconds.tableau.methods import (
    CommutatorFree,
    Composition,
    Embedded,
    EmbeddedUpdate,
    PartitionedRungeKutta,
    Row,
    RungeKutta,
    Stage,
)
from orderconds.tableau.products import AdjointComposition, Magnus, Splitting
from orderconds.tableau.toml_text import toml_text

if TYPE_CHECKING:
    from orderconds.tableau.record import Tableau

Spell = Callable[[Element], str]


def dumps(tableau: Tableau) -> str:
    """Return the tableau as TOML text.

    If the tableau was read from a file, the coefficients are copied as they are written in the file, together
    with the named numbers and the table ``[proof]``. In all other cases, each named number is replaced by its
    value (:func:`without_names`). A number with an error bound is written as a decimal with ``~``.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["2*a"]\\n[numbers]\\na = "0.50~"\\n'
    >>> dumps(Tableau.loads(text)) == text
    True
    """
    return toml_text(as_data(tableau))


def as_data(tableau: Tableau) -> Data:
    """Return the keys and values of a tableau file, including source, claims and proof.

    >>> from orderconds.tableau import Tableau, find
    >>> as_data(Tableau.load(find("cg4")))["b"]
    ['w', '0', '1/2 - w', '1/2 - w', 'w']
    """
    file = tableau.file
    if file is None or file.method is not tableau.method or file.embedded is not tableau.embedded:
        return without_names(tableau)
    data = deepcopy(dict(file.data)) | {"name": tableau.name}
    for key in ("source", "bibtex"):
        if getattr(tableau, key) != data.get(key, ""):
            data[key] = getattr(tableau, key)
    if file.claims != tableau.claims:
        for key in ("claims", "order"):
            data.pop(key, None)
        data |= _claims(tableau.claims)
    return data


def without_names(tableau: Tableau, *, name_radicals: bool = True) -> Data:
    """Return the content of a tableau file. Each name of a number is replaced by the number.

    There are two exceptions. A root of a polynomial (``minpoly``) keeps its name. If ``name_radicals`` is
    true, nested square roots get new names r1, r2, ....

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["2*a"]\\nnumbers = { a = "1/2" }\\n'
    >>> without_names(Tableau.loads(text))
    {'name': 'm', 'family': 'rk', 'A': [['1/2']], 'b': ['1']}
    """
    radicals = _Radicals(tableau.ring) if name_radicals else None
    text = radicals.spell if radicals else tableau.ring.text
    data: Data = {"name": tableau.name, "family": tableau.family, **_coefficients(tableau, text)}
    data |= {key: x for key in ("source", "bibtex") if (x := getattr(tableau, key))}
    numbers = (radicals.numbers if radicals else {}) | _named_roots(tableau)
    return data | ({"numbers": numbers} if numbers else {}) | _claims(tableau.claims)


def _coefficients(tableau: Tableau, text: Spell) -> Data:
    method, embedded = tableau.method, tableau.embedded

    def row(x: Row) -> list[str]:
        """Return the texts of a row without the zeros at its end."""
        kept = list(x)
        while kept and tableau.ring.is_zero(kept[-1]) is True:
            kept.pop()
        return [text(x) for x in kept]

    def product(stage: Stage) -> Data:
        start = {} if stage.start is None else {"from": stage.start + 1}
        return start | ({"exp": [row(x) for x in stage.exponentials]} if stage.exponentials else {})

    data: Data = {}
    if isinstance(method, RungeKutta | PartitionedRungeKutta):
        data |= {"A": [row(x) for x in method.A], "b": [text(x) for x in method.b]}
    if isinstance(method, PartitionedRungeKutta):
        data |= {"A_hat": [row(x) for x in method.A_hat], "b_hat": [text(x) for x in method.b_hat]}
    if isinstance(method, CommutatorFree):
        data |= {"stage": [product(stage) for stage in method.stages], "update": product(method.update)}
    if isinstance(method, Composition):
        data |= {"base": method.base, "gamma": [text(x) for x in method.gamma]}
    if isinstance(method, AdjointComposition | Splitting | Magnus):
        data |= _product(method, text)
    if isinstance(embedded, Embedded):
        data["embedded"] = {"b": row(embedded.b), "order": embedded.order}
    if isinstance(embedded, EmbeddedUpdate):
        data["embedded"] = {"order": embedded.order, **product(embedded.update)}
    return data


def _product(method: AdjointComposition | Splitting | Magnus, text: Spell) -> Data:
    if isinstance(method, AdjointComposition):
        rows = {key: [text(x) for x in getattr(method, key)] for key in ("alpha", "beta")}
        return {"base": method.base, **rows}
    if isinstance(method, Splitting):
        kinetic = {} if method.rkn is None else {"rkn": method.parts[method.rkn]}
        steps = [[method.parts[part], text(x)] for part, x in method.steps]
        return {"parts": list(method.parts), **kinetic, "step": steps}

    def combination(x: Combination) -> Data:
        return {spell(term): text(value) for term, value in x}

    data: Data = {"c": [text(x) for x in method.c]}
    if method.transform != "exp":
        data["map"] = method.transform
    if method.elements:
        data["elements"] = {name: combination(x) for name, x in method.elements}
    return data | {"exponents": [combination(x) for x in method.exponents]}


class _Radicals:
    """The names r1, r2, ... of the nested square roots in the coefficients."""

    def __init__(self, ring: Any) -> None:
        self.text: Spell = ring.text
        generators = getattr(ring, "generators", ())
        nested = any("sqrt" in g.symbol for g in generators) and all(g.index == 2 for g in generators)
        self.names = {g.power(1): f"r{k + 1}" for k, g in enumerate(generators)} if nested else {}
        inside = list(self.names)
        self.numbers = {
            self.names[x]: f"sqrt({self._named(g.symbol, inside[:k])})"
            for k, (x, g) in enumerate(zip(inside, generators, strict=False))
        }

    def _named(self, text: str, known: Sequence[str]) -> str:
        for radical in reversed(known):
            text = text.replace(radical, self.names[radical])
        return text

    def spell(self, x: Element) -> str:
        return self._named(self.text(x), list(self.names))


def _named_roots(tableau: Tableau) -> Data:
    """Return the definitions of the named roots: for each root, a polynomial and a decimal near the root."""
    return {
        name: {"minpoly": list(minpoly), "near": near}
        for name, minpoly, near in getattr(tableau.ring, "named_roots", ())
    }


def _claims(claims: Claims) -> Data:
    table: Data = {}
    for claim in claims.orders:
        if claim.cutoff is None:
            table[claim.family] = claim.order
        else:
            table.setdefault(claim.family, []).append({"cutoff": claim.cutoff, "order": claim.order})
    table |= claims.properties
    return {"claims": table} if table else {}
