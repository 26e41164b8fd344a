"""The ansatz of compositions and splittings: constraints, names of coefficients, and the text of the tableau
file."""

from __future__ import annotations

from fractions import Fraction

from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.coefficients import Cells, eliminated, row_text
from orderconds.solve.linear import Constraint, Elimination, equal, named
from orderconds.solve.spec import Spec, refuse

COMPOSED = (
    "the method composes steps of one symmetric method of order 2, and the step sizes form a palindrome"
)
"""The assumption about compositions."""

PALINDROMES = "the step sizes of T form a palindrome, and the step sizes of V form a palindrome"
"""The assumption about symmetric splittings. If some step sizes are zero, a symmetric splitting can violate
the assumption."""


def one_structure(family: Family, spec: Spec) -> tuple[str, ...]:
    """Return ``("full",)``. Compositions and splittings have only one parametrisation. The arguments are not
    used.

    >>> from orderconds.families import get
    >>> one_structure(get("splitting"), Spec(stages=3))
    ('full',)
    """
    return ("full",)


def composition(family: Family, spec: Spec, structure: str, name: str) -> Ansatz:
    """Return the ansatz of methods that compose steps of a symmetric method of order 2. The step sizes form a
    palindrome and add up to 1.

    >>> from orderconds.families import get
    >>> composition(get("composition"), Spec(stages=3), "full", "m").free
    ('g1',)
    """
    refuse(family.label(), spec, ("rkn", "fsal", "explicit", "dirk", "exponentials", "inner"))
    s = spec.stages
    gamma = [named("g", i + 1) for i in range(s)]
    total = Constraint("the step sizes add up to 1", {**dict.fromkeys(gamma, Fraction(1)), "": Fraction(-1)})
    mirrored = [
        equal("step sizes that form a palindrome", (1, gamma[s - 1 - i]), (-1, gamma[i]))
        for i in range(s // 2)
    ]
    # The step sizes in the middle come last.
    order = sorted(gamma, key=lambda x: -abs(2 * int(x[1:]) - s - 1))
    elimination = Elimination(tuple(order))
    elimination.impose(mirrored)
    names = [x for x in order if x not in elimination.solved]
    elimination = eliminated(order, spec, [*mirrored, total])
    cells = Cells(elimination)
    body = (
        f'name = "{name}"',
        'family = "composition"',
        'base = "symmetric-2"',
        f"gamma = {row_text(cells, gamma, full=True)}",
    )
    return Ansatz(
        family.solved_as(spec.rkn),
        name,
        structure,
        body,
        elimination.free,
        cells.numbers(order),
        cells.unknown(names),
        assumptions=(COMPOSED,),
    )


def splitting(family: Family, spec: Spec, structure: str, name: str) -> Ansatz:
    """Return the ansatz of splitting methods for two vector fields T and V. The first flow and the last flow
    are flows of T.

    >>> from orderconds.families import get
    >>> splitting(get("splitting"), Spec(stages=1), "full", "m").free
    ('a1',)
    """
    refuse(family.label(), spec, ("fsal", "explicit", "dirk", "exponentials", "inner"))
    if family.label() != family.name:
        raise InputError(
            f"methods of family {family.label()!r} cannot be searched",
            where="solve",
            expected=f"{family.name} (two parts)",
        )
    label = family.solved_as(spec.rkn)
    s = spec.stages
    a, b = ([named(x, i + 1) for i in range(n)] for x, n in (("a", s + 1), ("b", s)))
    constraints = []
    if spec.symmetric:
        constraints += [
            equal("--symmetric", (1, x[len(x) - 1 - i]), (-1, x[i]))
            for x in (a, b)
            for i in range(len(x) // 2)
        ]
    order = [name for x in (a, b) for name in sorted(x, key=lambda y: -abs(2 * int(y[1:]) - len(x) - 1))]
    constraints += [
        Constraint(
            "the step sizes of each flow add up to 1",
            {**dict.fromkeys(x, Fraction(1)), "": Fraction(-1)},
        )
        for x in (a, b)
    ]
    elimination = eliminated(order, spec, constraints)
    cells = Cells(elimination)
    steps = [f'["T", "{cells.written(a[0])}"]']
    for i in range(s):
        steps += [f'["V", "{cells.written(b[i])}"]', f'["T", "{cells.written(a[i + 1])}"]']
    body = (
        f'name = "{name}"',
        'family = "splitting"',
        'parts = ["T", "V"]',
        *(['rkn = "V"'] if label == family.solved_as(nystroem=True) else []),
        "step = [",
        *(f"  {x}," for x in steps),
        "]",
    )
    return Ansatz(
        label,
        name,
        structure,
        body,
        elimination.free,
        cells.numbers(order),
        cells.unknown(order),
        assumptions=(PALINDROMES,) if spec.symmetric else (),
    )
