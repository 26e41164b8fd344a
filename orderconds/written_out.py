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


def write_out(derivation: Derivation, stages: int) -> Derivation:
    """Return the same conditions as polynomials in the entries of a full tableau with ``stages`` stages.

    The engine itself is run over a ring of (Laurent) polynomials. Raises
    :class:`~orderconds.errors.InputError` for a family whose coefficients are not those of a Butcher tableau.

    >>> from orderconds.derive import derive
    >>> print(write_out(derive("rk", order=1), 2).conditions[0])
    b_1 + b_2 = 1
    """
    family = families.get(derivation.family)
    if family.formats[0] != "rk":
        raise InputError(
            f"family {derivation.family} is not written out by a number of stages alone",
            where="--stages",
            expected="a family whose coefficients are a_ij and b_i, as rk, sprk, cg, rkmk or vcg",
            hint="leave --stages out",
        )
    from orderconds.ring.laurent import LaurentPolynomials
    from orderconds.tableau import RungeKutta

    indices = [str(i) for i in range(1, stages + 1)]
    names = [("b", (i,)) for i in indices] + [("a", (i, j)) for i in indices for j in indices]
    ring = LaurentPolynomials([name + "_".join(index) for name, index in names])
    b, a = ring.generators[:stages], ring.generators[stages:]
    method = RungeKutta(A=tuple(a[i * stages : (i + 1) * stages] for i in range(stages)), b=tuple(b))
    symbols = [Coefficient(name, index) for name, index in names]

    def written(conditions: Iterable[Any]) -> tuple[Any, ...]:
        values = family.evaluate(method, ring, tuple(conditions))
        return tuple(
            replace(condition, source=_formula(symbols, ring.terms(value)))
            for condition, value in zip(conditions, values, strict=True)
        )

    return replace(derivation, by_order=tuple(written(conditions) for conditions in derivation.by_order))


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
