"""An ansatz: the text of a tableau file in which some coefficients are unknown.

The coefficients are evaluated in four ways:

- with doubles, for the numerical search
- with integers modulo primes, for the ranks of the conditions
- with interval arithmetic (balls), for the proof of the order
- with polynomials, for the proof that no method exists
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from orderconds.errors import InputError
from orderconds.ring.protocol import Element
from orderconds.tableau import Method, Tableau
from orderconds.tableau.unknowns import RootedRing, SymbolicCoefficients


@dataclass(frozen=True)
class Ansatz:
    """The text of a tableau file without the values of the free coefficients.

    - ``free``: the names of the free coefficients (the unknowns)
    - ``numbers``: formulas for all other named coefficients
    - ``body``, ``tail``: the lines of the file before and after the table [numbers]
    - ``cells``: the names of all coefficients that are not constants
    - ``family``: the label of the method family whose order conditions are solved
    - ``reduction``: the name of a theorem that reduces the number of order conditions in a proof
      (:mod:`orderconds.proof.equations`)
    - ``abelian``: if True, the order conditions are evaluated on abelian groups; there, a commutator-free
      method is a Runge-Kutta method
    - ``measured``: the label of the family in which the principal error is computed; None means ``family``
    - ``centre``: values of the free coefficients; random starts are chosen near these values
    - ``assumptions``: restrictions on the methods in addition to the options of the search; each
      restriction is a clause such as ``all weights b_i are nonzero``
    """

    family: str
    name: str
    structure: str
    body: tuple[str, ...]
    free: tuple[str, ...]
    numbers: Mapping[str, str]
    cells: tuple[str, ...]
    tail: tuple[str, ...] = ()
    reduction: str = "spelling"
    abelian: bool = False
    measured: str | None = None
    centre: Mapping[str, float] | None = None
    assumptions: tuple[str, ...] = ()

    def text(self, values: Mapping[str, str], head: Sequence[str] = (), foot: Sequence[str] = ()) -> str:
        """Return the text of a tableau file in which the free coefficients have the given ``values``. The
        lines ``head`` precede the table [numbers]. The lines ``foot`` are added at the end of the file.
        """
        texts = {**{name: values[name] for name in self.free}, **self.numbers}
        numbers = [f'{name} = "{texts[name]}"' for name in sorted(texts, key=_place)]
        table = ["", "[numbers]", *numbers] if numbers else []
        return "\n".join([*self.body, *head, *table, *self.tail, *foot]) + "\n"

    def symbolic(self) -> SymbolicCoefficients:
        """Return the coefficients of the method as expressions in the free coefficients. Raises InputError if
        no coefficient is free."""
        places = {name: f"0.{123456789 + 7919 * place}~" for place, name in enumerate(self.free)}
        foot = ["", "[proof]", f'conditions = "{self.family.partition("(")[0]}"', "order = 1"]
        proof = Tableau.loads(self.text(places, foot=foot if self.free else ()), self.name).proof
        if proof is None:
            raise InputError(
                "the constraints leave no free coefficient",
                where="constraints",
                expected="at least one free coefficient",
            )
        return proof.symbolic

    def method(self, values: Sequence[Element], ring: RootedRing) -> Method:
        """Return the method whose free coefficients have the given ``values``. The values are elements of
        ``ring``."""
        symbolic = self._symbolic
        known = {u.constant: x for u, x in zip(symbolic.decimals(), self._sorted(values), strict=True)}
        return symbolic.method(ring, known)[0]

    def _sorted(self, values: Sequence[Element]) -> list[Element]:
        """Return the values of the free coefficients, sorted by coefficient name (:func:`_place`)."""
        return [x for _, x in sorted(zip(self.free, values, strict=True), key=lambda pair: _place(pair[0]))]

    @cached_property
    def _symbolic(self) -> SymbolicCoefficients:
        return self.symbolic()

    def coefficients(self, values: Sequence[Element], ring: RootedRing) -> list[Element]:
        """Return the values of the coefficients named in ``cells``, in the order of ``cells``. ``values``
        contains the values of the free coefficients, as elements of ``ring``."""
        symbolic = self._symbolic
        known = {u.constant: x for u, x in zip(symbolic.decimals(), self._sorted(values), strict=True)}
        return [symbolic.number(name, ring, known) for name in self.cells]


def _place(name: str) -> tuple[bool, bool, str, list[int]]:
    """Return the sort key of the name of a coefficient. Names m1, m2, ... come first, then b1, b2, ..., then
    all other names."""
    letters = name.rstrip("0123456789_")
    return (letters != "m", letters != "b", letters, [int(x) for x in name[len(letters) :].split("_") if x])


def renamed(ansatz: Ansatz, name: str) -> Ansatz:
    """Return a copy of ``ansatz`` for a tableau with the given name.

    >>> from orderconds.solve.parametrise import ansatz
    >>> from orderconds.solve.spec import Spec
    >>> renamed(ansatz("rk", Spec(stages=1)), "mine").body[0]
    'name = "mine"'
    """
    body = (f'name = "{name}"', *ansatz.body[1:])
    return replace(ansatz, name=name, body=body)
