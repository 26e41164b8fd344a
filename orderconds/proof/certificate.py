"""Proof that the equations in the ``[proof]`` table of a tableau file have an exact solution near the rounded
decimals in the file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache

from flint import arb, fmpq

from orderconds.proof.equations import Equations, equations, independent
from orderconds.proof.implications import Fact
from orderconds.proof.krawczyk import NotProved, enclose
from orderconds.ring.balls import Balls
from orderconds.ring.decimals import endpoints, rational_decimal
from orderconds.ring.jets import Jet, Jets
from orderconds.ring.precision import precision
from orderconds.tableau import Tableau
from orderconds.tableau.unknowns import Proof


@dataclass(frozen=True)
class Misrounded:
    """A decimal of a tableau file that differs from the correctly rounded solution. ``given`` contains the
    digits in the file, and ``solution`` contains the correct digits."""

    name: str
    given: str
    solution: str

    def __str__(self) -> str:
        given = f"{self.name} = {self.given}~"
        return f"{given} is not correctly rounded: the solution rounds to {self.solution}~"


@dataclass(frozen=True)
class Certificate:
    """A proved solution of the equations in the [proof] table of a tableau file. The solution is close to the
    decimals in the file.

    - ``tableau``: the coefficients of the solution, as balls.
    - ``facts``: the orders that the equations imply, as pairs (family, order).
    - ``equations``: the number of equations.
    - ``radius``: a bound of the largest error of a decimal in the file.
    - ``printed``: a map from the names of the decimals in ``[proof.printed]`` to bounds of their errors.
    - ``misrounded``: the decimals that differ from the correctly rounded solution.
    - ``lower_facts``: the orders of the embedded method, as pairs (family, order).
    """

    tableau: Tableau
    facts: tuple[Fact, ...]
    equations: int
    radius: str
    printed: dict[str, str] = field(default_factory=dict)
    misrounded: tuple[Misrounded, ...] = ()
    lower_facts: tuple[Fact, ...] = ()

    def as_json(self) -> dict[str, object]:
        """Return the proved statement as a dictionary for JSON. The key "unknowns" lists the names of the
        unknowns of the equations, such as "A[2][1]". The key "pins" lists the names of the decimals
        in the file that are not unknowns. The proof treats these decimals as exact numbers."""
        proof = self.tableau.proof
        assert proof is not None
        return {
            "conditions": proof.conditions,
            "order": proof.order,
            "reduction": proof.reduction,
            "unknowns": [u.name for u in proof.unknowns],
            "pins": [u.name for u in proof.pinned],
            "radius": self.radius,
            "printed": self.printed,
        }


def certify(tableau: Tableau, bits: int = 256) -> Certificate:
    """Prove that the equations in the [proof] table of ``tableau`` have exactly one solution near the decimal
    values of the unknowns.

    The proof uses ball arithmetic with at least ``bits`` bits. Raises
    :class:`~orderconds.proof.krawczyk.NotProved` if the proof fails.

    >>> from orderconds.tableau import find
    >>> certificate = certify(Tableau.load(find("cg4a")))
    >>> certificate.facts, certificate.equations
    ((('cg', 4),), 13)
    """
    certificate = _certify(_Key(tableau), bits)
    return replace(certificate, tableau=replace(certificate.tableau, path=tableau.path))


class _Key:
    """A key in the cache of proofs. Two keys of the same tableau object are equal. The keys of two objects
    are equal if the objects are equal and their files have equal content."""

    def __init__(self, tableau: Tableau) -> None:
        self.tableau = tableau

    def __hash__(self) -> int:
        return hash(self.tableau.name)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Key):
            return False
        own, others = self.content, other.content
        same = own is not None and own == others and self.tableau == other.tableau
        return same or self.tableau is other.tableau

    @property
    def content(self) -> Mapping[str, object] | None:
        """The content of the tableau file. The content is None if there is no file, or if ``tableau.proof``
        was changed after the file was read."""
        file = self.tableau.file
        return None if file is None or file.proof is not self.tableau.proof else file.data


@lru_cache(maxsize=64)
def _certify(key: _Key, least: int) -> Certificate:
    tableau = key.tableau
    proof = tableau.proof
    if proof is None:
        raise NotProved("the file specifies no equations; add a table [proof]")
    if not proof.unknowns:
        raise NotProved(
            'every decimal is in the list "pins", so no decimal is an unknown; '
            'remove the name of at least one decimal from "pins", or, if all decimals are exact, '
            'remove the table [proof] and the sign "~" after each decimal'
        )
    bits = max(least, 64 + 4 * max(len(str(u.constant.unit.denominator)) for u in proof.unknowns))
    system = equations(tableau)
    with precision(bits):
        box = [
            arb(_fmpq(u.constant.value)) + arb(0, arb(_fmpq(u.constant.unit)).upper()) for u in proof.unknowns
        ]
        ring = Jets(len(box))
        over_box = system([ring.variable(i, x) for i, x in enumerate(box)], ring)
        kept = independent(system, over_box)
    if len(kept) != len(box):
        raise NotProved(_mismatch(len(kept), len(box)))

    def square(point: Sequence[Jet], over: Jets) -> list[Jet]:
        at_box = all(x.value is y for x, y in zip(point, box, strict=True))
        values = over_box if at_box else system(point, over)
        return [values[i] for i in kept]

    solution = enclose(square, box, bits)
    return _certificate(system, proof, solution, bits, len(kept))


def _mismatch(conditions: int, unknowns: int) -> str:
    advice = (
        f'add {unknowns - conditions} of the unknowns to "pins", a list of names in [proof]; '
        "the proof then treats the decimals of these unknowns as exact numbers"
        if unknowns > conditions
        else 'add the key "reduction" to [proof]; its value, such as "symmetric", names a theorem by which '
        "some of the equations follow from the others"
    )
    return f"{conditions} equations for {unknowns} unknowns; {advice}"


def _certificate(
    system: Equations, proof: Proof, solution: tuple[arb, ...], bits: int, count: int
) -> Certificate:
    ring = Balls(bits)
    values = {u.name: ring.enclose(x) for u, x in zip(proof.unknowns, solution, strict=True)}
    method, embedded = proof.over(ring, values)
    distances = [_distance(x, _fmpq(u.constant.value)) for u, x in zip(proof.unknowns, solution, strict=True)]
    printed = {
        name: rational_decimal(_distance(proof.number(name, ring, values).value, _fmpq(given)), 3)
        for name, given in proof.printed.items()
    }
    return Certificate(
        tableau=replace(system.tableau, ring=ring, method=method, embedded=embedded),
        facts=system.facts,
        equations=count,
        radius=rational_decimal(max(distances), 3),
        printed=printed,
        misrounded=tuple(_misrounded(proof, solution)),
        lower_facts=system.lower_facts,
    )


def _misrounded(proof: Proof, solution: Sequence[arb]) -> Iterator[Misrounded]:
    """Yield the decimals whose errors are proved to be larger than half a unit of the last digit."""
    for unknown, x in zip(proof.unknowns, solution, strict=True):
        given, unit = _fmpq(unknown.constant.value), _fmpq(unknown.constant.unit)
        low, high = endpoints(x)
        if low <= given + unit / 2 and high >= given - unit / 2:
            continue
        nearest = ((low + high) / 2 / unit + fmpq(1, 2)).floor() * unit
        yield Misrounded(unknown.name, *(_decimal(value, unit) for value in (given, nearest)))


def _decimal(value: fmpq, unit: fmpq) -> str:
    """Return ``value`` in decimal notation. The argument ``value`` must be an integer multiple of ``unit``,
    and ``unit`` must be a power of ten."""
    places = len(str(unit.q)) - 1
    return f"{Decimal(int((value / unit).p)).scaleb(-places):f}" if places else str(value)


def _distance(x: arb, to: fmpq) -> fmpq:
    """Return the maximum of abs(y - to) over all y in the ball ``x``."""
    low, high = endpoints(x)
    return max(abs(low - to), abs(high - to))


def _fmpq(x: Fraction) -> fmpq:
    return fmpq(*x.as_integer_ratio())
