"""The ansatz of low-storage (2N) schemes with the coefficients A_i and B_i.

By a theorem, a 2N scheme has the same order on a Lie group as on a vector space
(:mod:`orderconds.proof.equations`). A search therefore solves the order conditions of Runge-Kutta methods.
"""

from __future__ import annotations

from orderconds import families
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.coefficients import Cells, eliminated, row_text
from orderconds.solve.linear import named, zero
from orderconds.solve.spec import Spec, refuse

CENTRE = {"A": -0.8, "B": 0.25}
"""Random starts are chosen near these typical values of A_i and B_i in published schemes."""


def low_storage(family: Family, spec: Spec, structure: str, name: str) -> Ansatz:
    """Return the ansatz of low-storage schemes for the equation Y' = F(Y) Y. The step size is h. Stage i
    replaces the register K by A_i K + F(Y), and then Y by exp(h B_i K) Y. The coefficient A_1 is zero.

    >>> low_storage(families.get("cf"), Spec(stages=2, low_storage=True), "low-storage", "m").free
    ('B1', 'B2', 'A2')
    """
    solved = solved_family(family)
    refuse(
        f"{family.label()} with --low-storage",
        spec,
        ("dirk", "symmetric", "fsal", "rkn", "exponentials", "inner"),
    )
    stages = range(1, spec.stages + 1)
    A, B = ([named(letter, i) for i in stages] for letter in "AB")
    names = [*B, *A]
    elimination = eliminated(names, spec, [zero(A[0], "the register K is zero at the start of a step")])
    cells = Cells(elimination)
    numbers = {x: text for x, text in cells.numbers(names).items() if text != x}
    tail = (
        "",
        "[low_storage]",
        f"A = {row_text(cells, A, full=True)}",
        f"B = {row_text(cells, B, full=True)}",
    )
    return Ansatz(
        family=solved.label(),
        name=name,
        structure=structure,
        body=(f'name = "{name}"', 'family = "cf"'),
        free=elimination.free,
        numbers=numbers,
        cells=cells.unknown(names),
        tail=tail,
        reduction="low-storage",
        abelian=True,
        measured=family.label(),
        centre={x: CENTRE[x[0]] for x in elimination.free},
    )


def solved_family(family: Family) -> Family:
    """Return a family F with the following property. If a low-storage (2N) scheme has order p as a method of
    the family F, the scheme has order p as a method of ``family``, and conversely. The family F does not have
    more order conditions than ``family`` (:mod:`orderconds.proof.equations`).

    Raises :class:`~orderconds.errors.InputError` if no such family is known for ``family``.

    >>> solved_family(families.get("cf")).label()
    'rk'
    """
    known = {n: families.family_class(n).low_storage for n in families.names()}
    for name, implied in known.items():
        if family.label() in implied:
            return families.get(name)
    claimable = sorted({label for implied in known.values() for label in implied})
    raise InputError(
        f"the option --low-storage with family {family.label()}",
        where="solve",
        expected=f"one of the families {', '.join(claimable)}, or no --low-storage",
    )
