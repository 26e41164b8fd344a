"""An ansatz: a tableau file whose decimals are the unknowns of a search.

The coefficients of a family with a number of stages, named a21, b1, ... and related by constraints, are
written as a file. The same text then runs through every engine: over recorded programs for the search, over
residues for ranks, over balls for the proof.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from orderconds import families
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.ring.protocol import Element
from orderconds.solve.spec import Spec
from orderconds.tableau import Method, Tableau
from orderconds.tableau.unknowns import RootedRing, Spelled

if TYPE_CHECKING:
    from orderconds.solve.parametrise import Layout


@dataclass(frozen=True)
class Ansatz:
    """Coefficients as text: ``numbers`` by name, the names of unknown ones in ``free``, and the ``body``.

    ``cells`` are the names of the coefficients that are not constants.
    """

    family: str
    name: str
    structure: str
    body: tuple[str, ...]
    free: tuple[str, ...]
    numbers: Mapping[str, str]
    cells: tuple[str, ...]
    tail: tuple[str, ...] = ()

    def text(self, values: Mapping[str, str], head: Sequence[str] = (), foot: Sequence[str] = ()) -> str:
        """Return the file with these texts for the free coefficients."""
        spelled = {**{name: values[name] for name in self.free}, **self.numbers}
        numbers = [f'{name} = "{spelled[name]}"' for name in sorted(spelled, key=_place)]
        table = ["", "[numbers]", *numbers] if numbers else []
        return "\n".join([*self.body, *head, *table, *self.tail, *foot]) + "\n"

    def spelled(self) -> Spelled:
        """Return the parsed file with an unknown for each free coefficient."""
        places = {name: f"0.{123456789 + 7919 * place}~" for place, name in enumerate(self.free)}
        foot = ["", "[proof]", f'conditions = "{self.family.partition("(")[0]}"', "order = 1"]
        proof = Tableau.loads(self.text(places, foot=foot if self.free else ()), self.name).proof
        if proof is None:
            raise InputError(
                "the constraints leave no coefficient free",
                where="constraints",
                expected="something to solve for",
            )
        return proof.spelled

    def method(self, values: Sequence[Element], ring: RootedRing) -> Method:
        """Return the method with these elements of a ring for the free coefficients."""
        spelled = self._spelled
        known = {u.constant: x for u, x in zip(spelled.decimals(), self._sorted(values), strict=True)}
        return spelled.method(ring, known)[0]

    def _sorted(self, values: Sequence[Element]) -> list[Element]:
        """Return the values in the order in which the file names them."""
        return [x for _, x in sorted(zip(self.free, values, strict=True), key=lambda pair: _place(pair[0]))]

    @cached_property
    def _spelled(self) -> Spelled:
        return self.spelled()

    def coefficients(self, values: Sequence[Element], ring: RootedRing) -> list[Element]:
        """Return every coefficient that is no constant, in the order of ``cells``."""
        spelled = self._spelled
        known = {u.constant: x for u, x in zip(spelled.decimals(), self._sorted(values), strict=True)}
        return [spelled.number(name, ring, known) for name in self.cells]


def _place(name: str) -> tuple[bool, bool, str, list[int]]:
    """Sort names by their letters, then by their indices as numbers."""
    letters = name.rstrip("0123456789_")
    return (letters != "m", letters != "b", letters, [int(x) for x in name[len(letters) :].split("_") if x])


def ansatz(family: str, spec: Spec, structure: str = "full", name: str = "found") -> Ansatz:
    """Return the ansatz of a family, by its label, for a specification.

    Raises :class:`~orderconds.errors.InputError` for options that contradict each other or that the family
    cannot meet.

    >>> found = ansatz("rk", Spec(stages=2, explicit=True, fix=("a21=1/2",)))
    >>> found.free, found.body[2]
    (('b1', 'b2'), 'A = [[], ["1/2"]]')
    """
    found = families.get(family)
    layout = _layout(found)
    if spec.stages < 1:
        raise InputError(f"{spec.stages} stages", where="--stages", expected="at least one")
    return layout.ansatz(found, spec, structure, name)


def structures(family: str, spec: Spec) -> tuple[str, ...]:
    """Return the structures in which a search of this family begins, the most promising first.

    >>> structures("vcg", Spec(stages=3)), structures("cg", Spec(stages=3))
    (('abscissae', 'full'), ('full',))
    """
    found = families.get(family)
    return _layout(found).structures(found, spec)


def _layout(family: Family) -> Layout:
    from orderconds.solve.parametrise import LAYOUTS

    if family.unknowns not in LAYOUTS:
        searched = [n for n in families.names() if families.family_class(n).unknowns in LAYOUTS]
        raise InputError(
            f"no search in family {family.label()!r}",
            where="solve",
            expected=f"one of {', '.join(searched)}",
        )
    return LAYOUTS[family.unknowns]


def renamed(found: Ansatz, name: str) -> Ansatz:
    """Return the same ansatz with another name in its file.

    >>> renamed(ansatz("rk", Spec(stages=1)), "mine").body[0]
    'name = "mine"'
    """
    body = (f'name = "{name}"', *found.body[1:])
    return replace(found, name=name, body=body)
