"""Order conditions written out for a fixed number of stages: polynomials in a_ij, b_i, no index sums."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from orderconds import families
from orderconds.derive import Derivation
from orderconds.errors import InputError
from orderconds.formula import Coefficient, Formula, Power, Product, Total
from orderconds.ring.protocol import Element

Name = tuple[str, tuple[str, ...]]
"""A coefficient's letter and indices."""


def write_out(derivation: Derivation, stages: int, *, explicit: bool = False) -> Derivation:
    """Return the same conditions as polynomials in the entries of a tableau with ``stages`` stages.

    The tableau is full, or with ``explicit`` strictly lower triangular. Raises
    :class:`~orderconds.errors.InputError` for a family whose coefficients are not numbered by stages alone.

    >>> from orderconds.derive import derive
    >>> derivation = derive("rk", order=2)
    >>> print(*write_out(derivation, 2).conditions, sep="; ")
    b_1 + b_2 = 1; b_1 a_11 + b_1 a_12 + b_2 a_21 + b_2 a_22 = 1/2
    >>> print(write_out(derivation, 2, explicit=True).conditions[-1])
    b_2 a_21 = 1/2
    """
    ring, names, values = polynomials(derivation, stages, explicit=explicit)
    symbols = [Coefficient(*name) for name in names]
    written = iter(values)
    return replace(
        derivation,
        by_order=tuple(
            tuple(replace(c, source=_formula(symbols, ring.terms(next(written)))) for c in conditions)
            for conditions in derivation.by_order
        ),
    )


def polynomials(
    derivation: Derivation, stages: int, *, explicit: bool = False
) -> tuple[Any, tuple[Name, ...], tuple[Element, ...]]:
    """Return a ring of polynomials, its variables, and the left-hand sides as elements of the ring.

    The engine itself is run over that ring: polynomials, or Laurent polynomials for a family that divides by
    weights. Raises :class:`~orderconds.errors.InputError` as :func:`write_out` does.

    >>> from orderconds.derive import derive
    >>> ring, names, values = polynomials(derive("rk", order=2), 2, explicit=True)
    >>> names, ring.text(values[1])
    ((('b', ('1',)), ('b', ('2',)), ('a', ('2', '1'))), 'b_2*a_2_1')
    """
    family = families.get(derivation.family)
    if hasattr(family, "in_stages"):
        return _in_stages(family, derivation, stages, explicit)
    if family.formats[0] != "rk":
        raise InputError(
            f"family {derivation.family} is not written out by a number of stages alone",
            where="--stages",
            expected="a family whose coefficients are numbered by stages, as rk, sprk, cg, vcg or splitting",
            hint="leave --stages out",
        )
    from orderconds.ring.laurent import LaurentPolynomials
    from orderconds.ring.polynomials import Polynomials
    from orderconds.tableau import RungeKutta

    rows = range(1, stages + 1)
    entries = [(i, j) for i in rows for j in (range(1, i) if explicit else rows)]
    names: list[Name] = [("b", (str(i),)) for i in rows] + [("a", (str(i), str(j))) for i, j in entries]
    # A family that reads other formats too completes the tableau to a pair, and divides by weights for that.
    divides = family.needs_nonzero_weights or family.formats != ("rk",)
    ring = (LaurentPolynomials if divides else Polynomials)(["_".join((n, *ix)) for n, ix in names])
    a = dict(zip(entries, ring.generators[stages:], strict=True))
    method = RungeKutta(
        A=tuple(tuple(a.get((i, j), ring.zero) for j in rows) for i in rows),
        b=tuple(ring.generators[:stages]),
    )
    return ring, tuple(names), family.evaluate(method, ring, derivation.conditions)


def _in_stages(
    family: Any, derivation: Derivation, stages: int, explicit: bool
) -> tuple[Any, tuple[Name, ...], tuple[Element, ...]]:
    """Return the same for a splitting or a composition, whose steps are its coefficients."""
    if explicit:
        raise InputError(
            f"family {derivation.family} has no tableau that could be explicit",
            where="--explicit",
            expected="a family whose coefficients are a_ij and b_i",
            hint="leave --explicit out",
        )
    from orderconds.ring.polynomials import Polynomials

    names, method = family.in_stages(stages)
    ring = Polynomials(["_".join((name, *indices)) for name, indices in names])
    return ring, names, family.evaluate(method(ring.generators), ring, derivation.conditions)


def _formula(symbols: list[Coefficient], terms: Iterable[tuple[tuple[int, ...], Any]]) -> Formula:
    """Turn a polynomial's terms into a formula; exponent k belongs to ``symbols[k]``."""
    return Total(
        tuple(
            (
                Fraction(int(scale.p), int(scale.q)),
                Product(
                    tuple(s if e == 1 else Power(s, e) for s, e in zip(symbols, exponents, strict=True) if e)
                ),
            )
            for exponents, scale in terms
        )
    )
