"""A file's method with random numbers in place of its rounded decimals and its radicals, over Q.

What holds there holds whatever numbers they stand for. An identity between rational functions of degree at
most D that is false holds at a point drawn from 2^128 values a coordinate with probability at most D / 2^128
(Schwartz 1980; Zippel 1979). The numbers come from a digest of the file, so that a search for a file whose
own point deceives is hopeless. Arithmetic is exact: no prime enters.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from flint import fmpq

from orderconds.errors import TableauError, ZeroWeight
from orderconds.ring.draws import Draws
from orderconds.ring.rationals import Rationals
from orderconds.tableau.evaluate import Definition
from orderconds.tableau.grammar import Chain, Constant, Power
from orderconds.tableau.products import Method
from orderconds.tableau.unknowns import Spelled

BITS = 128
"""Size of the numbers drawn. Values are bounded in size, so that a degree stays far below 2^40."""

OUTSIDE = (TableauError, ZeroWeight, ZeroDivisionError)
"""What is raised where a member cannot be evaluated: its numbers explode, or a divisor is zero."""


class RandomMember(Rationals):
    """Q, with a number drawn for each decimal and each radical of a file."""

    def __init__(self, formulas: Spelled, draws: Draws | None = None) -> None:
        self._formulas, self._draws = formulas, draws or Draws(description(formulas))

    def variable(self, constant: Constant) -> fmpq:
        """Return the number that is drawn for a decimal."""
        return self._drawn(f"decimal {constant.value} {constant.unit}")

    def root(self, x: fmpq, index: int) -> fmpq:
        """Return the number that is drawn for this root."""
        return self._drawn(f"root {index} {x}")

    def named_root(self, minpoly: Any, near: Fraction, unit: Fraction, name: str) -> fmpq:
        """Return the number that is drawn for this name."""
        return self._drawn(f"named {name}")

    def size(self, x: fmpq) -> int:
        """Return the bits of the larger of numerator and denominator."""
        return max(int(x.p).bit_length(), int(x.q).bit_length())

    def method(self) -> Method:
        """Return the method.

        Raises one of :data:`OUTSIDE` where it cannot be evaluated.

        >>> from orderconds.tableau import Tableau
        >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["2*a"]\\nnumbers = { a = "0.5~" }\\n'
        >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
        >>> method = RandomMember(proof.spelled).method()
        >>> method.b[0] / method.A[0][0]
        2
        """
        return self._formulas.method(
            self, {u.constant: self.variable(u.constant) for u in self._formulas.decimals()}
        )[0]

    def _drawn(self, name: str) -> fmpq:
        return fmpq(self._draws.number(name, BITS))


def description(formulas: Spelled) -> str:
    """Return a text that fixes the coefficients as functions of the decimals."""
    return repr(([*formulas.expressions.items()], [*formulas.numbers.items()]))


def radicals(formulas: Spelled) -> tuple[Power, ...]:
    """Return the different radicals that stand in a file.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["sqrt(3)"]\\nnumbers.a = "0.5~*sqrt(3)"\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> len(radicals(proof.spelled))
    1
    """
    definitions = (*formulas.numbers.values(), *formulas.expressions.values())
    return tuple(dict.fromkeys(radical for x in definitions for radical in _radicals(x)))


def _radicals(x: Definition) -> Iterator[Power]:
    if isinstance(x, Power):
        if x.exponent.denominator > 1:
            yield x
        yield from _radicals(x.base)
    elif isinstance(x, Chain):
        for operand in x.operands:
            yield from _radicals(operand)
