"""Order conditions for a fixed number of stages, as polynomials without sums over indices."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from orderconds import families
from orderconds.errors import InputError
from orderconds.families.stage_form import Name
from orderconds.formula import Coefficient, Formula, Power, Product, Total
from orderconds.ring.protocol import Element

if TYPE_CHECKING:
    from flint import fmpq

    from orderconds.derivation import Derivation
    from orderconds.ring.laurent import LaurentPolynomials
    from orderconds.ring.polynomials import Polynomials


MAX_COMPUTED = 5_000_000
"""If the estimated number of terms exceeds MAX_COMPUTED, the expansion is refused. The computation of
MAX_COMPUTED terms needs about 500 MB of memory."""

MAX_TERMS = 500_000
"""The expanded conditions may have at most MAX_TERMS terms in total. Writing the text of MAX_TERMS terms
needs 1.5 GB of memory."""


def expand_stages(derivation: Derivation, stages: int, *, explicit: bool = False) -> Derivation:
    """Expand the conditions of a derivation as polynomials in the coefficients of a method with ``stages``
    stages.

    If ``explicit`` is true, only the strictly lower triangular entries of A are variables.

    Raises :class:`~orderconds.errors.InputError` if there are too many terms (:data:`MAX_COMPUTED`,
    :data:`MAX_TERMS`). The same error is raised for families such as ``cf``, whose tableaux are not
    tableaux of Runge-Kutta methods, compositions or splittings.

    >>> from orderconds.derivation import derive
    >>> derivation = derive("rk", order=2)
    >>> print(*expand_stages(derivation, 2).conditions, sep="; ")
    b_1 + b_2 = 1; b_1 a_11 + b_1 a_12 + b_2 a_21 + b_2 a_22 = 1/2
    >>> print(expand_stages(derivation, 2, explicit=True).conditions[-1])
    b_2 a_21 = 1/2
    """
    _refuse_more_terms(derivation, _terms_at_most(derivation, stages, explicit=explicit), MAX_COMPUTED)
    ring, names, values = polynomials(derivation, stages, explicit=explicit)
    _refuse_more_terms(derivation, sum(len(list(ring.terms(value))) for value in values), MAX_TERMS)
    symbols = [Coefficient(*name) for name in names]
    expanded = iter(values)
    return replace(
        derivation,
        by_order=tuple(
            tuple(replace(c, source=_formula(symbols, ring.terms(next(expanded)))) for c in conditions)
            for conditions in derivation.by_order
        ),
    )


def _terms_at_most(derivation: Derivation, stages: int, *, explicit: bool) -> int:
    """Return an estimate of the total number of terms of the expanded conditions.

    In explicit methods, the sum of a_ij over j has (stages - 1)/2 terms on average. The estimate uses this
    average.
    """
    factor = Fraction(stages - 1, 2) if explicit else Fraction(stages)
    sizes = enumerate(derivation.counts)
    return sum(int(count * stages * factor**edges) for edges, count in sizes)


def _refuse_more_terms(derivation: Derivation, terms: int, most: int) -> None:
    if terms > most:
        raise InputError(
            f"the conditions have {'about ' * (most == MAX_COMPUTED)}{terms} terms",
            where=derivation.family,
            expected=f"at most {most}",
            hint="lower the order or the number of stages",
        )


def polynomials(
    derivation: Derivation, stages: int, *, explicit: bool = False
) -> tuple[Polynomials | LaurentPolynomials, tuple[Name, ...], tuple[Element, ...]]:
    """Return a polynomial ring, its variables, and the left-hand sides of the conditions as polynomials.

    If weights b_i occur in denominators in the order conditions, the ring consists of Laurent polynomials.
    Raises :class:`~orderconds.errors.InputError` for families such as ``cf``, whose tableaux are not
    tableaux of Runge-Kutta methods, compositions or splittings.

    >>> from orderconds.derivation import derive
    >>> ring, names, values = polynomials(derive("rk", order=2), 2, explicit=True)
    >>> names, ring.text(values[1])
    ((('b', ('1',)), ('b', ('2',)), ('a', ('2', '1'))), 'b_2*a_2_1')
    """
    family = families.get(derivation.family)
    form = family.in_stages(stages, explicit=explicit)
    from orderconds.ring.laurent import LaurentPolynomials
    from orderconds.ring.polynomials import Polynomials

    names = ["_".join((letter, *indices)) for letter, indices in form.names]
    ring = LaurentPolynomials(names) if form.divides else Polynomials(names)
    method = form.method(ring.generators, ring)
    return ring, form.names, family.evaluate(method, ring, derivation.conditions)


def _formula(symbols: list[Coefficient], terms: Iterable[tuple[tuple[int, ...], fmpq]]) -> Formula:
    """Return a polynomial as a formula. Each term is a pair (exponents, coefficient), where ``exponents[k]``
    is the exponent of ``symbols[k]``."""
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
