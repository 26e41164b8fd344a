"""The table ``[proof]`` of a tableau file, and the unknowns of the equations.

A coefficient in a tableau file can contain a rounded decimal, which is marked by ``~``, for example
``0.81772~``. The table ``[proof]`` selects order conditions of the method. The selected conditions are
equations, and the rounded decimals are approximate values of the unknowns in these equations.

::

    [proof]
    conditions = "cg"          # the equations are the independent conditions of this family
    order = 4                  # all conditions up to this order
    pins = ["a31", "a42"]      # these decimals count as exact numbers, not as unknowns
    reduction = "symmetric"    # optional: the method is symmetric, and equations of even order are omitted
    printed = { a21 = "0.8177227988124852" }   # optional: the digits printed in the source

Each unknown has a name. If the rounded decimal of the unknown occurs in the definition of a named number, for
example ``numbers.a21 = "0.5~"``, the unknown has the name of the number, here ``a21``. Otherwise, the name is
the position of the coefficient that contains the decimal, for example ``A[2][1]``. If one coefficient or
number contains several decimals, the value of the decimal is appended to the name, for example
``A[2][1]: 0.25``. Equal decimals in the file are one unknown. The first of the equal decimals determines the
name of the unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Protocol, cast

from msgspec import Struct

from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.evaluate import Definition, Scalars, evaluate_in, rounded_and_exact
from orderconds.tableau.grammar import Constant, Expression, Name
from orderconds.tableau.methods import LowerOrder
from orderconds.tableau.products import Method

Built = tuple[Method, LowerOrder | None]
"""A method and its embedded method."""


class RootedRing(Ring, Protocol):
    """A ring in which real n-th roots can be computed. An example is the ring of balls (intervals)."""

    def root(self, x: Element, index: int) -> Element:
        """Return the real n-th root of x, where n is ``index``."""


class Unknown(Struct, frozen=True):
    """A rounded decimal in a tableau file. ``name`` is the name of the unknown that the decimal approximates,
    for example ``A[2][1]`` (see the module docstring). ``constant`` is the absolute value of the decimal."""

    name: str
    constant: Constant


@dataclass(frozen=True)
class Proof:
    """The table ``[proof]`` of a file.

    The equations are the order conditions of the family ``conditions`` up to order ``order``. The rounded
    decimals in ``unknowns`` are approximate values of the unknowns in these equations. The rounded decimals
    in ``pinned`` count as exact numbers. ``printed`` maps the names of numbers in the file to their decimals
    in the cited publication.
    """

    conditions: str
    order: int
    reduction: str | None
    assumptions: Mapping[str, int]
    printed: Mapping[str, Fraction]
    unknowns: tuple[Unknown, ...]
    pinned: tuple[Unknown, ...]
    symbolic: SymbolicCoefficients = field(repr=False)

    def over(self, ring: RootedRing, values: Mapping[str, Element]) -> Built:
        """Return the method with coefficients in ``ring``, for the given ``values`` of the unknowns."""
        return self.symbolic.method(ring, self._known(ring, values))

    def number(self, name: str, ring: RootedRing, values: Mapping[str, Element]) -> Element:
        """Evaluate a named number or a coefficient of the file. ``values`` contains the values of the
        unknowns. For a coefficient, ``name`` is its position in the file, for example ``A[2][1]``."""
        return self.symbolic.number(name, ring, self._known(ring, values))

    def _known(self, ring: RootedRing, values: Mapping[str, Element]) -> dict[Constant, Element]:
        known = {u.constant: values[u.name] for u in self.unknowns}
        for u in self.pinned:
            known[u.constant] = ring.rational(*u.constant.value.as_integer_ratio())
        return known


class SymbolicCoefficients(Struct, frozen=True):
    """The coefficients of a tableau file as parsed expressions. The function :meth:`method` evaluates the
    expressions in a given ring. The caller provides an element of the ring for each rounded decimal, for
    example an interval that contains the exact coefficient."""

    expressions: Mapping[str, Expression]
    numbers: Mapping[str, Definition]
    where: str
    build: Callable[[Mapping[str, Element], Ring], Built]

    def method(self, ring: RootedRing, known: Mapping[Constant, Element]) -> Built:
        """Return the method with coefficients in ``ring``. ``known`` maps each rounded decimal of the file to
        the value that replaces it."""
        values = evaluate_in(_Substituted(ring, known), self.expressions, self.numbers, self.where)
        return self.build(values, ring)

    def number(self, name: str, ring: RootedRing, known: Mapping[Constant, Element]) -> Element:
        """Return a named number or a coefficient of the file. ``known`` maps each rounded decimal of the file
        to the value that replaces it. For a coefficient, ``name`` is its position in the file, for example
        ``A[2][1]``."""
        expression = {name: Name(name) if name in self.numbers else self.expressions[name]}
        return evaluate_in(_Substituted(ring, known), expression, self.numbers, self.where)[name]

    def decimals(self) -> tuple[Unknown, ...]:
        """Return each rounded decimal of the file once. The decimals of the named numbers in the file come
        before the decimals of the coefficients."""
        names_of: dict[Constant, str] = {}
        for name, definition in (*self.numbers.items(), *self.expressions.items()):
            for constant in rounded_and_exact(definition):
                if constant.unit:
                    names_of.setdefault(constant, name)
        names = list(names_of.values())
        return tuple(
            Unknown(name if names.count(name) == 1 else f"{name}: {float(constant.value):.6g}", constant)
            for constant, name in names_of.items()
        )


class _Substituted:
    """The operations that evaluate the expressions of a tableau file in ``ring``. ``known`` maps each rounded
    decimal of the file to the element of ``ring`` that replaces the decimal."""

    def __init__(self, ring: RootedRing, known: Mapping[Constant, Element]) -> None:
        self.ring, self.known = ring, known

    def constant(self, value: Fraction, unit: Fraction) -> Element:
        if unit:
            return self.known[Constant(value, unit)]
        return self.ring.rational(value.numerator, value.denominator)

    def root(self, x: Element, index: int) -> Element:
        return self.ring.root(x, index)

    def named_root(self, minpoly: Sequence[Fraction], near: Fraction, unit: Fraction, name: str) -> Element:
        return cast("Scalars", self.ring).named_root(minpoly, near, unit, name)

    def size(self, x: Element) -> int:
        size = getattr(self.ring, "size", None)
        # The evaluation of an expression fails if the size of a number exceeds a limit. If the ring does not
        # define sizes, the result 0 prevents this failure.
        return 0 if size is None else int(size(x))
