"""The ansatz of a search for methods: a tableau file in which some coefficients are unknown.

Constraints on the method, for example that it is explicit, reduce the number of unknown coefficients.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from orderconds import families
from orderconds.errors import InputError
from orderconds.families import Family
from orderconds.solve.abscissae import (
    WHERE,
    commutator_free_times,
    crouch_grossman_times,
    symmetric_transport,
    transport,
)
from orderconds.solve.ansatz import Ansatz
from orderconds.solve.coefficients import Cells, eliminated, row_text
from orderconds.solve.linear import Constraint, Elimination, equal, named, spell, sum_to_one, zero
from orderconds.solve.low_storage import low_storage
from orderconds.solve.paths import Path, full_paths, symmetric_paths
from orderconds.solve.spec import Spec, refuse


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
        constraints += [equal("symplecticity", (2, A[i][i]), (-1, b[i])) for i in range(s)]
    if structure == "abscissae":
        constraints.append(sum_to_one(b))
    nodes = {named("c", i + 1): line for i, line in enumerate(A)}
    elimination = eliminated(names, spec, constraints, nodes)
    extra = {}
    if structure == "abscissae":
        weights = [Cells(elimination).written(x) for x in b]
        extra = {**crouch_grossman_times(weights), **transport(A, weights, _fixed(A, elimination))}
    if family.symplectic:
        extra = _symplectic(A, b, elimination, spec.symmetric)
    cells = Cells(elimination, extra)
    free = tuple(x for x in elimination.free if x not in extra)
    rows = [row_text(cells, line) for line in A]
    body = (
        f'name = "{name}"',
        'family = "rk"',
        *_matrix(rows),
        f"b = {row_text(cells, b, full=True)}",
    )
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
    # Without these options, a stage with the weight zero can be replaced by a stage with a nonzero weight
    # (:func:`orderconds.solve.elimination.infeasible`).
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
    """
    cells, last = Cells(elimination), len(b) - 1
    formulas: dict[str, str] = {}
    for j in range(len(b)):
        for i in range(j):
            mirrored = (last - j, last - i)
            if symmetric and (mirrored == (i, j) or mirrored < (i, j)):
                continue
            choices = [(j, i), (i, j)]
            chosen = next((k for k in choices if A[k[0]][k[1]] in elimination.free), None)
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
            product = f" - {weight}*{other}/{cells.written(b[row])}" if other != "0" else ""
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
        assumptions=(_numbers_of_exponentials(stages, update),),
    )


def _numbers_of_exponentials(stages: Sequence[Path], update: Path) -> str:
    """Return a clause about the exponentials of each stage (:mod:`orderconds.solve.paths`).

    >>> _numbers_of_exponentials(*full_paths(Spec(stages=2, explicit=True))[:2])
    'the numbers of exponentials are at most 2 in the update and n_i in stage i, with n = 0, 2'
    """
    counts = ", ".join(str(len(path)) for path in stages)
    shared = [sum(x == y for x, y in zip(path, update, strict=False)) for path in stages]
    numbers = (
        f"the numbers of exponentials are at most {len(update)} in the update and n_i in stage i, "
        f"with n = {counts}"
    )
    if not any(shared):
        return numbers
    begins = ", ".join(map(str, shared))
    return f"{numbers}; stage i begins with k_i exponentials of the update, with k = {begins}"


def _abscissae(
    stages: Sequence[Sequence[Sequence[str]]], update: Sequence[Sequence[str]], elimination: Elimination
) -> dict[str, str]:
    """Return a map from names to formulas. If the coefficients of a commutator-free method satisfy these
    formulas, the three abscissae of each stage are equal. The module :mod:`orderconds.solve.abscissae`
    defines the abscissae.

    Let a_ij be the sum of the coefficients of stage j in all exponentials of stage i. The map contains
    formulas for

    - the numbers in :func:`commutator_free_times`;
    - the sums a_ij; if a sum can be chosen freely, its name is mapped to itself;
    - the coefficients of the last exponential of each stage i: the coefficient of stage j is a_ij minus the
      coefficients of stage j in the other exponentials of stage i.
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
    """Return the weights w1, w2, ... and the entries g11, g12, ... of A of the Gauss method with s stages, as
    a map from names to formulas."""
    from orderconds.tableau.collocation import construct

    tableau = construct("gauss", s)
    method, every, text = tableau.abelian(), range(s), tableau.ring.text
    weights = {f"w{j + 1}": text(method.b[j]) for j in every}
    return weights | {f"g{i + 1}{j + 1}": text(method.A[i][j]) for i in every for j in every}


def _totals(stages: Sequence[Sequence[Sequence[str]]], update: Sequence[Sequence[str]]) -> list[Constraint]:
    """Return two kinds of constraints. Here a_ij and b_j are the coefficients of the Gauss method with
    ``len(stages)`` stages. Let k_j be the vector field at stage j.

    - In the exponentials of stage i, the coefficients of k_j add up to a_ij.
    - In the exponentials of the update, the coefficients of k_j add up to b_j.
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
        equal("a symmetric composition", (1, gamma[s - 1 - i]), (-1, gamma[i])) for i in range(s // 2)
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
        assumptions=("the step sizes form a palindrome",),
    )


def splitting(family: Family, spec: Spec, structure: str, name: str) -> Ansatz:
    """Return the ansatz of splitting methods for two vector fields T and V. The first flow and the last flow
    are flows of T.

    >>> from orderconds.families import get
    >>> splitting(get("splitting"), Spec(stages=1), "full", "m").free
    ('a1',)
    """
    refuse(family.label(), spec, ("fsal", "explicit", "dirk", "exponentials", "inner"))
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
        *(['rkn = "V"'] if spec.rkn else []),
        "step = [",
        *(f"  {x}," for x in steps),
        "]",
    )
    label = family.solved_as(spec.rkn)
    return Ansatz(label, name, structure, body, elimination.free, cells.numbers(order), cells.unknown(order))


def tableau_structures(family: Family, spec: Spec) -> tuple[str, ...]:
    """Return the names of the parametrisations that a search for tableaux (A, b) tries, in order of trial.

    >>> from orderconds.families import get
    >>> [tableau_structures(get(name), Spec(stages=3)) for name in ("vcg", "cg")]
    [('abscissae', 'full'), ('full',)]
    """
    return ("abscissae", "full") if family.equal_abscissae and not spec.explicit else ("full",)


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


def one_structure(family: Family, spec: Spec) -> tuple[str, ...]:
    """Return ``("full",)``. Compositions and splittings have only one parametrisation. The arguments are not
    used.

    >>> from orderconds.families import get
    >>> one_structure(get("splitting"), Spec(stages=3))
    ('full',)
    """
    return ("full",)


@dataclass(frozen=True)
class Layout:
    """The parametrisations of one tableau format. Each parametrisation is called a structure, and is denoted
    by a text such as ``"full"``.

    ``ansatz`` returns an :class:`~orderconds.solve.ansatz.Ansatz`, a tableau with free coefficients. The four
    arguments of ``ansatz`` are a family of methods, the required properties of the method (:class:`Spec`), a
    structure, and a name for the tableau. ``structures`` returns the structures that a search tries, in order
    of trial.
    """

    ansatz: Callable[[Family, Spec, str, str], Ansatz]
    structures: Callable[[Family, Spec], tuple[str, ...]]


LAYOUTS = {
    "rk": Layout(runge_kutta, tableau_structures),
    "cf": Layout(commutator_free, path_structures),
    "composition": Layout(composition, one_structure),
    "splitting": Layout(splitting, one_structure),
}
"""Maps the name of a tableau format to a pair of functions (:class:`Layout`). The first function returns an
ansatz. The second function returns the names of the parametrisations that a search tries."""

TWO_REGISTERS = Layout(low_storage, lambda family, spec: ("low-storage",))
"""The parametrisation of low-storage schemes (:mod:`orderconds.solve.low_storage`)."""


def ansatz(family: str, spec: Spec, structure: str = "full", name: str = "found") -> Ansatz:
    """Return the ansatz for methods that satisfy the specification. ``family`` is the label of a family.

    Raises :class:`~orderconds.errors.InputError` if options of the specification contradict each other, or if
    the family does not support an option.

    >>> example = ansatz("rk", Spec(stages=2, explicit=True, fix=("a21=1/2",)))
    >>> example.free, example.body[2]
    (('b1', 'b2'), 'A = [[], ["1/2"]]')
    """
    member = families.get(family)
    layout = _layout(member, spec)
    if spec.stages < 1:
        raise InputError(f"{spec.stages} stages", where="--stages", expected="at least one")
    return layout.ansatz(member, spec, structure, name)


def structures(family: str, spec: Spec) -> tuple[str, ...]:
    """Return the names of the parametrisations that a search in ``family`` tries, in order of trial.

    >>> structures("vcg", Spec(stages=3)), structures("cg", Spec(stages=3))
    (('abscissae', 'full'), ('full',))
    """
    chosen = families.get(family)
    return _layout(chosen, spec).structures(chosen, spec)


def _layout(family: Family, spec: Spec) -> Layout:
    if spec.low_storage:
        return TWO_REGISTERS
    if family.unknowns not in LAYOUTS:
        searched = [n for n in families.names() if families.family_class(n).unknowns in LAYOUTS]
        raise InputError(
            f"methods of family {family.label()!r} cannot be searched",
            where="solve",
            expected=f"one of {', '.join(searched)}",
        )
    return LAYOUTS[family.unknowns]
