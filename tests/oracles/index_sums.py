"""The value of an index sum, summed straight from its definition.

The engines of the families never evaluate the formulas that they print. These functions do, so that tests can
prove that a printed condition has the value that the engine computes.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence

from orderconds.formula.nodes import Coefficient, Formula, IndexSum, Power, Product, Total, coefficients
from orderconds.ring.protocol import Element, Ring

Table = Sequence
"""A nested sequence of ring elements: one axis an index."""


class RungeKuttaTables(Mapping[str, Table]):
    """Coefficient tables a, b, c, ahat, bhat, chat of a Runge-Kutta tableau, derived ones on demand."""

    def __init__(self, ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element]) -> None:
        self._ring = ring
        self._tables: dict[str, Table] = {"a": A, "b": b, "bhat": b}

    def __getitem__(self, name: str) -> Table:
        if name not in self._tables:
            self._tables[name] = self._derive(name)
        return self._tables[name]

    def __iter__(self) -> Iterator[str]:
        return iter(("a", "b", "c", "ahat", "bhat", "chat"))

    def __len__(self) -> int:
        return 6

    def _derive(self, name: str) -> Table:
        a, b = self._tables["a"], self._tables["b"]
        stages = range(len(b))
        match name:
            case "c":
                return [sum(row, self._ring.zero) for row in a]
            case "ahat":
                return [[b[j] - b[j] * a[j][i] / b[i] for j in stages] for i in stages]
            case "chat":
                return [sum(row, self._ring.zero) for row in self["ahat"]]
        raise KeyError(name)


def runge_kutta_value(
    formula: Formula, ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element]
) -> Element:
    """Return the value of a formula for the Runge-Kutta tableau (A, b) over ``ring``.

    Derived are ``c_i = sum_j a_ij``, ``ahat_ij = b_j - b_j a_ji / b_i``, ``chat_i = sum_j ahat_ij``.
    """
    return value(formula, ring, RungeKuttaTables(ring, A, b))


def value(
    formula: Formula, ring: Ring, tables: Mapping[str, Table], at: Mapping[str, int] | None = None
) -> Element:
    """Sum a formula over coefficient ``tables``, its free indices fixed ``at`` values counted from 0.

    An index runs along the axis of the first table that has this index.

    >>> from orderconds.formula import coefficient, index_sum
    >>> from orderconds.ring import QQ
    >>> tables = {"b": (QQ.rational(1, 3), QQ.rational(2, 3))}
    >>> value(index_sum(("i",), (), coefficient("b", "i")), QQ, tables)
    1
    """
    at = at or {}
    match formula:
        case Coefficient(name, indices):
            entry = tables[name]
            for index in indices:
                entry = entry[at[index]]
            return entry
        case Product(factors):
            result = ring.one
            for factor in factors:
                result = result * value(factor, ring, tables, at)
            return result
        case Power(base, exponent):
            inner, result = value(base, ring, tables, at), ring.one
            for _ in range(abs(exponent)):
                result = result * inner
            return result if exponent >= 0 else ring.one / result
        case Total(terms):
            result = ring.zero
            for scale, term in terms:
                number = ring.rational(scale.numerator, scale.denominator)
                result = result + number * value(term, ring, tables, at)
            return result
        case IndexSum(indices, relations, body):
            result = ring.zero
            for values in itertools.product(*(range(_length(body, index, tables)) for index in indices)):
                bound = {**at, **dict(zip(indices, values, strict=True))}
                if all(_holds(bound[low], sign, bound[high]) for low, sign, high in relations):
                    result = result + value(body, ring, tables, bound)
            return result
    raise TypeError(f"not a formula: {formula!r}")


def _length(body: Formula, index: str, tables: Mapping[str, Table]) -> int:
    for entry in coefficients(body):
        if index in entry.indices:
            table = tables[entry.name]
            for _ in range(entry.indices.index(index)):
                table = table[0]
            return len(table)
    raise ValueError(f"index {index} does not occur in {body.text()}")


def _holds(x: int, sign: str, y: int) -> bool:
    return x < y if sign == "<" else x <= y
