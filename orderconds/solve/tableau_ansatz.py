"""The ansatz of Runge-Kutta methods: constraints, names of coefficients, and the text of the tableau file."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.solve.abscissae import WHERE, crouch_grossman_times, transport
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.coefficients import DIVIDES, Cells, eliminated, require_nonzero, row_text
from orderconds.solve.linear import Elimination, divisor, equal, named, spell, sum_to_one, zero
from orderconds.solve.spec import Spec, refuse


def tableau_structures(family: Family, spec: Spec) -> tuple[str, ...]:
    """Return the names of the parametrisations that a search for tableaux (A, b) tries, in order of trial.

    >>> from orderconds.families import get
    >>> [tableau_structures(get(name), Spec(stages=3)) for name in ("vcg", "cg")]
    [('abscissae', 'full'), ('full',)]
    """
    return ("abscissae", "full") if family.equal_abscissae and not spec.explicit else ("full",)


def runge_kutta(family: Family, spec: Spec, structure: str, name: str) -> Ansatz:
    """Return the ansatz of a Runge-Kutta method with the coefficients A and b.

    >>> from orderconds.families import get
    >>> runge_kutta(get("rk"), Spec(stages=1), "full", "m").free
    ('b1', 'a11')
    """
    refuse(family.label(), spec, ("rkn", "exponentials", "inner"))
    s = spec.stages
    A = [[named("a", i + 1, j + 1) for j in range(s)] for i in range(s)]
    b = [named("b", i + 1) for i in range(s)]
    names = [*b, *(x for line in A for x in line)]
    constraints = []
    if spec.explicit or spec.dirk:
        why = "--explicit" if spec.explicit else "--dirk"
        last = 0 if spec.explicit else 1
        constraints += [zero(A[i][j], why) for i in range(s) for j in range(i + last, s)]
    if spec.symmetric:
        constraints += [equal("--symmetric", (1, b[s - 1 - i]), (-1, b[i])) for i in range(s // 2)]
        constraints += [
            equal("--symmetric", (1, A[s - 1 - i][s - 1 - j]), (1, A[i][j]), (-1, b[j]))
            for i in range(s)
            for j in range(s)
        ]
    if spec.fsal:
        constraints += [equal("--fsal", (1, A[s - 1][j]), (-1, b[j])) for j in range(s)]
        constraints += [zero(A[0][j], "--fsal") for j in range(s)]
    if family.symplectic:
        refuse(family.label(), spec, ("explicit", "fsal"))
        why = "symplecticity with nonzero weights"  # b_i a_ij + b_j a_ji = b_i b_j for all i and j
        constraints += [equal(why, (2, A[i][i]), (-1, b[i])) for i in range(s)]
        if spec.dirk:  # For j < i, a_ji = 0. Then b_i a_ij + b_j a_ji = b_i b_j gives a_ij = b_j.
            constraints += [equal(why, (1, A[i][j]), (-1, b[j])) for i in range(s) for j in range(i)]
    if structure == "abscissae":
        constraints.append(sum_to_one(b))
    nodes = {named("c", i + 1): line for i, line in enumerate(A)}
    elimination = eliminated(names, spec, constraints, nodes)
    if family.needs_nonzero_weights:
        require_nonzero(elimination, {x: [x] for x in b}, DIVIDES)
    extra = {}
    if structure == "abscissae":
        weights = [Cells(elimination).written(x) for x in b]
        extra = {**crouch_grossman_times(weights), **transport(A, weights, _fixed(A, elimination))}
    if family.symplectic:
        extra = _symplectic(A, b, elimination, spec.symmetric)
    cells = Cells(elimination, extra)
    free = tuple(x for x in elimination.free if x not in extra)
    rows = [row_text(cells, line) for line in A]
    body = (f'name = "{name}"', 'family = "rk"', *_matrix(rows), f"b = {row_text(cells, b, full=True)}")
    return Ansatz(
        family.solved_as(spec.rkn),
        name,
        structure,
        body,
        free,
        cells.numbers(names),
        cells.unknown(names),
        assumptions=_assumptions(family, spec),
    )


def _assumptions(family: Family, spec: Spec) -> tuple[str, ...]:
    """Return the assumptions of :func:`runge_kutta` that do not follow from the family and the options."""
    assumptions = []
    if spec.symmetric:
        assumptions.append("a_ij + a_(s+1-i)(s+1-j) = b_j for all i and j")
    if spec.fsal:
        assumptions.append("a_1j = 0 and a_sj = b_j for all j")
    # The proof in :func:`orderconds.solve.elimination.infeasible` considers only nonzero weights. Each
    # symplectic method with zero weights computes the same step as a symplectic method with nonzero weights.
    # But the method with nonzero weights may violate --dirk, --symmetric or --fix. Therefore nonzero weights
    # are an assumption only if one of these options is used. If ``needs_nonzero_weights`` is true, the family
    # already excludes zero weights.
    if family.symplectic and not family.needs_nonzero_weights and (spec.dirk or spec.symmetric or spec.fix):
        assumptions.append("all weights b_i are nonzero")
    return tuple(assumptions)


def _symplectic(
    A: Sequence[Sequence[str]], b: Sequence[str], elimination: Elimination, symmetric: bool
) -> dict[str, str]:
    """Return formulas for entries of A such that b_i a_ij + b_j a_ji = b_i b_j for all i and j
    (symplecticity).

    For a symmetric method with s stages, the equations for (i, j) and for (s + 1 - j, s + 1 - i) are
    equivalent. The equation for (i, s + 1 - i) follows from the symmetry.

    Raises InputError if the constraints imply b_i = 0 for a weight. Also raises InputError if the constraints
    determine both a_ij and a_ji, but do not imply the equation for (i, j).
    """
    require_nonzero(
        elimination,
        {x: [x] for x in b},
        "a symplectic method computes the same step without the stages of weight 0",
    )
    cells, last = Cells(elimination), len(b) - 1
    formulas: dict[str, str] = {}
    for j in range(len(b)):
        for i in range(j):
            mirrored = (last - j, last - i)
            if symmetric and (mirrored == (i, j) or mirrored < (i, j)):
                continue
            # The formula computes A[row][column] from A[column][row]. This is impossible if a constraint
            # computes A[column][row] from A[row][column].
            choices = [
                (row, column)
                for row, column in ((j, i), (i, j))
                if A[row][column] in elimination.free
                and A[row][column] not in elimination.cell(A[column][row])
            ]
            chosen = choices[0] if choices else None
            if chosen is None and _is_symplectic(elimination, (A[i][j], A[j][i]), (b[i], b[j])):
                continue
            if chosen is None:
                raise InputError(
                    f"the constraints determine both {A[i][j]} and {A[j][i]}",
                    where="constraints",
                    expected="constraints that determine at most one of the two entries; "
                    "symplecticity determines the other entry",
                )
            row, column = chosen
            weight, other = cells.written(b[column]), cells.written(A[column][row])
            product = f" - {weight}*{other}/{divisor(cells.written(b[row]))}" if other != "0" else ""
            formulas[A[row][column]] = f"{weight}{product}"
    return formulas


def _is_symplectic(elimination: Elimination, entries: tuple[str, str], weights: tuple[str, str]) -> bool:
    """Return True if b_i a_ij + b_j a_ji = b_i b_j is an identity in the free coefficients."""
    (a, mirrored), (b, c) = map(elimination.cell, entries), map(elimination.cell, weights)
    total: dict[tuple[str, ...], Fraction] = {}
    for sign, left, right in ((1, b, a), (1, c, mirrored), (-1, b, c)):
        for x, p in left.items():
            for y, q in right.items():
                key = tuple(sorted((x, y)))
                total[key] = total.get(key, Fraction(0)) + sign * p * q
    return not any(total.values())


def _fixed(A: Sequence[Sequence[str]], elimination: Elimination) -> dict[str, str]:
    """Return the texts of the constant entries of A. Raises InputError if an entry is neither constant nor
    free."""
    values = {}
    for name in (x for line in A for x in line):
        form = elimination.cell(name)
        if set(form) <= {""}:
            values[name] = spell(form)
        elif name in elimination.solved:
            raise InputError(
                f"{name} = {spell(form)}",
                where=WHERE,
                expected="only numbers and free coefficients as entries of A",
            )
    return values


def _matrix(rows: Sequence[str]) -> list[str]:
    line = f"A = [{', '.join(rows)}]"
    return [line] if len(line) <= 110 else ["A = [", *(f"  {x}," for x in rows), "]"]
