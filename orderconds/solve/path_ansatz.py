"""The ansatz of commutator-free methods: constraints, names of coefficients, and the text of the tableau
file."""

from __future__ import annotations

from collections.abc import Sequence

from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.solve.abscissae import WHERE, commutator_free_times, symmetric_transport, transport
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.coefficients import DIVIDES, Cells, eliminated, require_nonzero, row_text
from orderconds.solve.linear import Constraint, Elimination, equal, named, spell, sum_to_one
from orderconds.solve.paths import Path, full_paths, symmetric_paths
from orderconds.solve.spec import Spec, refuse
from orderconds.solve.tableau_ansatz import tableau_structures

# MIRRORED contains k_i. Therefore :func:`_numbers_of_exponentials` puts a definition of k_i before MIRRORED:
# "stage i begins with the first k_i exponentials of the update".
MIRRORED = (
    "Y_1, ..., Y_m are the exponents of the update; s is the number of stages; "
    "stage i has the exponents Y_1, ..., Y_(k_i), X_i1, X_i2, ..., in this order; "
    "if m and s are odd, stage i = (s+1)/2 has one more exponent, (1/2) Y_(k_i+1), directly before X_i1; "
    "bar X is X with its coefficients in reverse order; Y_I = bar Y_J if I + J = m + 1; "
    "X_ir = -bar X_jr if i + j = s + 1"
)
"""The assumptions about the exponents of symmetric methods (:mod:`orderconds.solve.paths`)."""


def path_structures(family: Family, spec: Spec) -> tuple[str, ...]:
    """Return the names of the parametrisations that a search for commutator-free methods tries, in order of
    trial.

    >>> from orderconds.families import get
    >>> path_structures(get("vcf"), Spec(stages=3, symmetric=True))
    ('symmetric gauss', 'symmetric abscissae', 'symmetric')
    """
    if not spec.symmetric:
        return tableau_structures(family, spec)
    first = ("symmetric gauss", "symmetric abscissae") if family.equal_abscissae else ()
    return (*first, "symmetric")


def commutator_free(family: Family, spec: Spec, structure: str, name: str) -> Ansatz:
    """Return the ansatz of commutator-free methods. A step of such a method is a product of exponentials.

    >>> from orderconds.families import get
    >>> commutator_free(get("cf"), Spec(stages=1, exponentials=1, inner=1), "full", "m").free
    ('b1_1', 'a1_1_1')
    """
    refuse(family.label(), spec, ("rkn", "fsal"))
    make = symmetric_paths if structure.startswith("symmetric") else full_paths
    stages, update, names, constraints = make(spec)
    extra: dict[str, str] = {}
    if structure.endswith("abscissae"):
        constraints.append(sum_to_one([x for line in update for x in line]))
    totals = _gauss(spec.stages) if structure.endswith("gauss") else {}
    if totals:
        constraints += _totals(stages, update)
        names = [*totals, *names]
    elimination = eliminated(names, spec, constraints)
    if family.needs_nonzero_weights:
        columns = zip(*update, strict=True)
        weights = {named("b", j): column for j, column in enumerate(columns, start=1)}
        require_nonzero(elimination, weights, DIVIDES)
    extra |= {name: text for name, text in totals.items() if name in elimination.free}
    if structure == "abscissae":
        extra = _abscissae(stages, update, elimination)
    elif structure.endswith("abscissae"):
        extra = _symmetric_abscissae(stages, update, elimination)
    cells = Cells(elimination, extra)
    free = tuple(x for x in elimination.free if x not in extra)
    free = (*free, *(x for x in extra if extra[x] == x))
    numbers = {x: text for x, text in cells.numbers(names).items() if text != x}
    tail = [""]
    for stage in stages:
        tail += ["[[stage]]", *_exponentials(stage, cells)]
    tail += ["[update]", *_exponentials(update, cells)]
    body = (f'name = "{name}"', 'family = "cf"')
    return Ansatz(
        family.solved_as(spec.rkn),
        name,
        structure,
        body,
        free,
        numbers,
        cells.unknown(names),
        tuple(tail),
        assumptions=(_numbers_of_exponentials(stages, update, spec.symmetric),),
    )


def _numbers_of_exponentials(stages: Sequence[Path], update: Path, symmetric: bool) -> str:
    """Return a text that states the largest possible numbers of exponentials in the update and in each stage.
    For symmetric methods, the text also describes the symmetry (:mod:`orderconds.solve.paths`).

    >>> _numbers_of_exponentials(*full_paths(Spec(stages=2, explicit=True))[:2], symmetric=False)
    'the update is y0 multiplied by at most 2 exponentials, and stage i is y0 multiplied by at most n_i \
exponentials, with n = (0, 2)'
    """
    counts = ", ".join(str(len(path)) for path in stages)
    shared = [sum(x == y for x, y in zip(path, update, strict=False)) for path in stages]
    numbers = (
        f"the update is y0 multiplied by at most {len(update)} exponentials, and stage i is y0 multiplied by "
        f"at most n_i exponentials, with n = ({counts})"
    )
    if not symmetric:
        return numbers
    begins = ", ".join(map(str, shared))
    return (
        f"{numbers}; stage i begins with the first k_i exponentials of the update, k = ({begins}); {MIRRORED}"
    )


def _abscissae(
    stages: Sequence[Sequence[Sequence[str]]], update: Sequence[Sequence[str]], elimination: Elimination
) -> dict[str, str]:
    """Stage i of a variational method on a Lie group has three abscissae c_i, chat_i and m_i
    (:mod:`orderconds.solve.abscissae`). Return a map from names to formulas. If the coefficients of a
    commutator-free method satisfy these formulas, c_i = chat_i = m_i for each stage i.

    Let k_j be the vector field at stage j, and let a_ij be the sum of the coefficients of k_j in all
    exponentials of stage i. The map contains formulas for

    - the weights b_i, the abscissae m_i, and the sum y_J of each row J of ``update``
      (:func:`commutator_free_times`);
    - the sums a_ij; if a sum can be chosen freely, its name is mapped to itself;
    - the coefficients in the last exponential of each stage i: the coefficient of k_j is a_ij minus the
      coefficients of k_j in the other exponentials of stage i.
    """
    every = range(1, len(stages) + 1)
    for name in (x for path in stages for line in path for x in line):
        if name in elimination.solved:
            raise InputError(
                f"{name} = {spell(elimination.cell(name))}",
                where=WHERE,
                expected="stage coefficients without constraints",
            )
    A = [[named("a", i, j) for j in every] for i in every]
    b = [named("b", i) for i in every]
    written = [[Cells(elimination).written(x) for x in line] for line in update]
    determined = transport(A, b, {})
    extra = {**commutator_free_times(written, b)}
    extra |= {x: determined.get(x, x) for line in A for x in line}
    for i, path in enumerate(stages):
        for j, last in enumerate(path[-1]):
            extra[last] = " - ".join([A[i][j], *(line[j] for line in path[:-1])])
    return extra


def _gauss(s: int) -> dict[str, str]:
    """Return a map from names to formulas for the coefficients of the Gauss method with s stages. The names
    w1, w2, ... denote the weights, and g11, g12, ... denote the entries of the coefficient matrix."""
    from orderconds.tableau.collocation import construct

    tableau = construct("gauss", s)
    method, every, text = tableau.abelian(), range(s), tableau.ring.text
    weights = {f"w{j + 1}": text(method.b[j]) for j in every}
    return weights | {f"g{i + 1}{j + 1}": text(method.A[i][j]) for i in every for j in every}


def _totals(stages: Sequence[Sequence[Sequence[str]]], update: Sequence[Sequence[str]]) -> list[Constraint]:
    """Return two kinds of constraints. Let k_j be the vector field at stage j.

    - In the exponentials of stage i, the coefficients of k_j add up to the coefficient a_ij of the Gauss
      method with ``len(stages)`` stages.
    - In the exponentials of the update, the coefficients of k_j add up to the weight b_j of the same Gauss
      method.
    """
    why, every = "Gauss's tableau", range(len(stages))
    constraints = [equal(why, (-1, f"w{j + 1}"), *((1, line[j]) for line in update)) for j in every]
    constraints += [
        equal(why, (-1, f"g{i + 1}{j + 1}"), *((1, line[j]) for line in path))
        for i, path in enumerate(stages)
        for j in every
    ]
    return constraints


def _symmetric_abscissae(
    stages: Sequence[Sequence[Sequence[str]]], update: Sequence[Sequence[str]], elimination: Elimination
) -> dict[str, str]:
    s, half = len(stages), len(stages) // 2
    if half == 0:
        raise InputError("one stage", where=WHERE, expected="at least two stages")
    cells = Cells(elimination)
    b = [named("b", i) for i in range(1, s + 1)]
    written = [[cells.written(x) for x in line] for line in update]
    x = [[named("x", i, j) for j in range(1, s + 1)] for i in range(1, half + 1)]
    leave = [sum(line in update for line in path) for path in stages[:half]]
    own = [path[k:] for path, k in zip(stages[:half], leave, strict=True)]
    for name in (name for path in own for line in path for name in line):
        if name in elimination.solved:
            raise InputError(
                f"{name} = {spell(elimination.cell(name))}",
                where=WHERE,
                expected="stage coefficients without constraints",
            )
    middle: list[str] = []
    extra = commutator_free_times(written, b)
    if s % 2:
        path = stages[half]
        rows = path[len(update) // 2 + len(update) % 2 :]
        middle = [f"z{j}" for j in range(1, s + 1)]
        extra |= {
            f"z{j + 1}": " + ".join(cells.written(line[j]) for line in rows).replace("+ -", "- ")
            for j in range(half)
        }
    extra |= {name: name for line in x for name in line}
    extra |= symmetric_transport(x, leave, written, middle)
    for i, path in enumerate(own):
        for j, last in enumerate(path[-1]):
            extra[last] = " - ".join([x[i][j], *(line[j] for line in path[:-1])])
    return extra


def _exponentials(rows: Sequence[Sequence[str]], cells: Cells) -> list[str]:
    lines = [line for names in rows if (line := row_text(cells, names)) != "[]"]
    if not lines:
        return []
    text = f"exp = [{', '.join(lines)}]"
    return [text] if len(text) <= 110 else ["exp = [", *(f"  {x}," for x in lines), "]"]
