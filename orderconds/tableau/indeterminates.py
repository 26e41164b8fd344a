"""A file's method with its rounded decimals and its radicals as indeterminates.

What holds there, as an identity between polynomials, holds whatever numbers they stand for.
"""

from __future__ import annotations

from collections.abc import Iterator

from flint.utils.flint_exceptions import DomainError

from orderconds.ring.polynomials import Polynomials
from orderconds.ring.protocol import Element
from orderconds.tableau.evaluate import Definition
from orderconds.tableau.grammar import Chain, Power
from orderconds.tableau.products import Method
from orderconds.tableau.unknowns import Spelled, Unknown

OUTSIDE = (ArithmeticError, AttributeError, DomainError, TypeError, ValueError)
"""What is raised where a quotient or a named root is no polynomial; DomainError is flint's."""


class Indeterminates(Polynomials):
    """Polynomials over Q in the decimals of a file, and in one more variable for each radical in it."""

    def __init__(self, spelled: Spelled) -> None:
        decimals = spelled.decimals()
        super().__init__([f"x{i}" for i in range(len(decimals) + len(radicals(spelled)))])
        self._known = {u.constant: x for u, x in zip(decimals, self.generators, strict=False)}
        self._free = iter(self.generators[len(decimals) :])
        self._roots: dict[tuple[str, int], Element] = {}
        self._spelled = spelled

    def variable(self, unknown: Unknown) -> Element:
        """Return the variable that stands for a decimal."""
        return self._known[unknown.constant]

    def root(self, x: Element, index: int) -> Element:
        """Return the variable that stands for this root."""
        key = self.text(x), index
        if key not in self._roots:
            self._roots[key] = next(self._free)
        return self._roots[key]

    def method(self) -> Method:
        """Return the method over this ring.

        Raises one of :data:`OUTSIDE` where quotients or named roots leave it.

        >>> from orderconds.tableau import Tableau
        >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["2*a"]\\nnumbers = { a = "0.5~" }\\n'
        >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
        >>> Indeterminates(proof.spelled).method()
        RungeKutta(A=((x0,),), b=(2*x0,))
        """
        return self._spelled.method(self, self._known)[0]


def radicals(spelled: Spelled) -> tuple[Power, ...]:
    """Return the different radicals that stand in a file.

    >>> from orderconds.tableau import Tableau
    >>> text = 'name = "m"\\nfamily = "rk"\\nA = [["a"]]\\nb = ["sqrt(3)"]\\nnumbers.a = "0.5~*sqrt(3)"\\n'
    >>> proof = Tableau.loads(text + '[proof]\\nconditions = "rk"\\norder = 1').proof
    >>> len(radicals(proof.spelled))
    1
    """
    definitions = (*spelled.numbers.values(), *spelled.expressions.values())
    return tuple(dict.fromkeys(radical for x in definitions for radical in _radicals(x)))


def _radicals(x: Definition) -> Iterator[Power]:
    if isinstance(x, Power):
        if x.exponent.denominator > 1:
            yield x
        yield from _radicals(x.base)
    elif isinstance(x, Chain):
        for operand in x.operands:
            yield from _radicals(operand)
