"""Random methods over Q: random numbers replace the rounded decimals and the radicals of a tableau file.

The coefficients of the method are rational functions of the replaced numbers. An identity between two
rational functions is tested at one random point. An identity that holds for all points also holds for the
radicals and for the unknown numbers that the rounded decimals approximate.

Each coordinate of the random point is drawn from 2^128 numbers. Let f and g be two different functions, and
let D be the degree of the numerator of f - g. The probability that f and g have the same value at the random
point is at most D / 2^128 (Schwartz 1980; Zippel 1979).

If the random point were known, the author of a file could choose coefficients such that f and g are different
but have the same value at this point. Therefore the random numbers are computed from a digest of all
coefficients in the file: if one coefficient is changed, all random numbers change.
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
from orderconds.tableau.unknowns import SymbolicCoefficients

BITS = 128
"""The number of bits of a random number. A non-zero function of degree D vanishes at random numbers with
probability at most D / 2^128. This probability is small, because the degree D of tested functions is far
below 2^40. The limit :data:`orderconds.tableau.evaluate.MAX_SIZE` keeps D small."""

OUTSIDE = (TableauError, ZeroWeight, ZeroDivisionError)
"""The errors that :meth:`RandomMember.method` raises."""


class RandomMember(Rationals):
    """The ring of rational numbers, for tests of identities between coefficients of a tableau file. A random
    number replaces each rounded decimal and each radical in the file, because an identity that holds for
    random numbers almost certainly holds for all numbers."""

    def __init__(self, symbolic: SymbolicCoefficients, draws: Draws | None = None) -> None:
        self._symbolic, self._draws = symbolic, draws or Draws(description(symbolic))

    def variable(self, constant: Constant) -> fmpq:
        """Return the random number that replaces the rounded decimal ``constant``."""
        return self._drawn(f"decimal {constant.value} {constant.unit}")

    def root(self, x: fmpq, index: int) -> fmpq:
        """Return the random number that replaces the root x^(1/``index``). The random number depends on x and
        ``index``."""
        return self._drawn(f"root {index} {x}")

    def named_root(self, minpoly: Any, near: Fraction, unit: Fraction, name: str) -> fmpq:
        """Return the random number that replaces the root ``name`` of a polynomial. The random number depends
        on ``name`` only."""
        return self._drawn(f"named {name}")

    def size(self, x: fmpq) -> int:
        """Return the number of bits of the numerator or of the denominator, whichever is larger."""
        return max(int(x.p).bit_length(), int(x.q).bit_length())

    def method(self) -> Method:
        """Return the method with random numbers in place of the rounded decimals and the radicals.

        Raises one of the errors in :data:`OUTSIDE` if the method cannot be evaluated.

        >>> from orderconds.tableau import Tableau
        >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["2*a"]\\nnumbers = { a = "0.5~" }\\n'
        >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
        >>> method = RandomMember(proof.symbolic).method()
        >>> method.b[0] / method.A[0][0]
        2
        """
        return self._symbolic.method(
            self, {u.constant: self.variable(u.constant) for u in self._symbolic.decimals()}
        )[0]

    def _drawn(self, name: str) -> fmpq:
        return fmpq(self._draws.number(name, BITS))


def description(symbolic: SymbolicCoefficients) -> str:
    """Return a text that contains all coefficients and all named numbers of a file. :class:`RandomMember`
    uses the text as the seed of its random numbers.

    >>> from orderconds.tableau import Tableau
    >>> file = Tableau.loads('name = "m"\\nfamily = "rk"\\nA = [["0.5~"]]\\nb = ["1"]').file
    >>> "b[1]" in description(file.symbolic)
    True
    """
    return repr(([*symbolic.expressions.items()], [*symbolic.numbers.items()]))


def radicals(symbolic: SymbolicCoefficients) -> tuple[Power, ...]:
    """Return the radicals in a file, each radical once. A radical is a power with a non-integer exponent.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["sqrt(3)"]\\nnumbers.a = "0.5~*sqrt(3)"\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> len(radicals(proof.symbolic))
    1
    """
    definitions = (*symbolic.numbers.values(), *symbolic.expressions.values())
    return tuple(dict.fromkeys(radical for x in definitions for radical in _radicals(x)))


def _radicals(x: Definition) -> Iterator[Power]:
    if isinstance(x, Power):
        if x.exponent.denominator > 1:
            yield x
        yield from _radicals(x.base)
    elif isinstance(x, Chain):
        for operand in x.operands:
            yield from _radicals(operand)
