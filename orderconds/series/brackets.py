"""Runge-Kutta-Munthe-Kaas methods with few brackets (commutators). The arguments of the exponentials are
simplified in a graded free Lie algebra.

A linear combination x of the stage values k_1, ..., k_s has grade g if h x is of order h^g, where h is the
step size. The combination q_j is the sum of k_j and multiples of k_1, ..., k_(j-1). The multiples are chosen
to make the grade of q_j as large as possible. For a method of order p, terms above grade p - 1 can be omitted
from the arguments of the stages, and terms above grade p can be omitted from the argument of the step
(Munthe-Kaas and Owren, Phil. Trans. R. Soc. A 357 (1999) 957; Casas and Owren, BIT 43 (2003) 723).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from random import Random

from orderconds.errors import InputError
from orderconds.ring.protocol import Element, Ring
from orderconds.series.bracket_bounds import beyond_lie, least_brackets, newest_factors
from orderconds.series.dexpinv import DexpinvSeries
from orderconds.series.graded import GradedAlgebra, Polynomial, solve
from orderconds.trees.levels import branches
from orderconds.trees.ordered import ordered_trees

Name = tuple[str, int]
"""The name of a stage value ``("k", j)`` or of a bracket ``("B", r)``. The indices j and r are counted from
0."""

Row = dict[Name, Element]


@dataclass(frozen=True)
class BracketProgram:
    """A program that computes the arguments of the exponentials in one step of a method.

    The stage values are k_i = f(exp(u_i) y0) with the arguments u_1, ..., u_s. The result of a step of size h
    is exp(u) y0 with the argument u. A row is a map from names to coefficients. It represents a linear
    combination of brackets and elements h k_j.

    - ``brackets[r]``: two rows. The first row represents x, and the second row represents y in the bracket
      B_r = [x, y].
    - ``stages``: the rows of u_1, ..., u_s.
    - ``update``: the row of u.
    - ``least``: a lower bound for the number of brackets in every program that computes the arguments.
    - ``grades``: integers g_1, ..., g_s. Let p be the order of the method. Then g_j is the largest integer
      g <= p with the following property: there are numbers x_1, ..., x_(j-1) for which the combination
      h (x_1 k_1 + ... + x_(j-1) k_(j-1) + k_j) is O(h^g).

    >>> from orderconds.ring import QQ
    >>> euler = BracketProgram((), ({},), {("k", 0): QQ.one}, 0, (1,))
    >>> print(euler.text(QQ))
    u1 = 0
    u = k1
    """

    brackets: tuple[tuple[Row, Row], ...]
    stages: tuple[Row, ...]
    update: Row
    least: int
    grades: tuple[int, ...]

    def text(self, ring: Ring) -> str:
        """Return the program as text. There is one line for each bracket and for each argument of an
        exponential. The step size h is omitted, and indices start at 1."""
        lines = [
            f"B{r + 1} = [{_spell(x, ring)}, {_spell(y, ring)}]" for r, (x, y) in enumerate(self.brackets)
        ]
        lines += [f"u{i + 1} = {_spell(row, ring)}" for i, row in enumerate(self.stages)]
        return "\n".join([*lines, f"u = {_spell(self.update, ring)}"])


def fewest_brackets(
    ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element], order: int, attempts: int = 4
) -> BracketProgram:
    """Return a program with few brackets for the Runge-Kutta-Munthe-Kaas method (RKMK) of an explicit tableau
    (A, b). The program has the same order as the RKMK method.

    The order of the Runge-Kutta method (A, b) must be ``order``. The ring must support division and a test
    whether an element is zero.

    The search tries increasing numbers of brackets. For each number of brackets, the search uses at most
    ``attempts`` seeds of a random number generator. Raises :class:`~orderconds.errors.InputError` for an
    implicit tableau.

    >>> from orderconds.ring import QQ
    >>> half, third, sixth = QQ.rational(1, 2), QQ.rational(1, 3), QQ.rational(1, 6)
    >>> none, one = QQ.zero, QQ.one
    >>> A = [[none] * 4, [half, none, none, none], [none, half, none, none], [none, none, one, none]]
    >>> print(fewest_brackets(QQ, A, [sixth, third, third, sixth], 4).text(QQ))
    B1 = [k1, -1/8 k2]
    B2 = [k1, 7/6 k2 - 1/12 k4]
    u1 = 0
    u2 = 1/2 k1
    u3 = 1/2 k2 + B1
    u4 = k3
    u = 1/6 k1 + 1/3 k2 + 1/3 k3 + 1/6 k4 + 28/3 B1 + B2
    """
    for i, row in enumerate(A):
        for j in range(i, len(b)):
            if ring.is_zero(row[j]) is not True:
                raise InputError(
                    f"a_{i + 1}{j + 1} = {ring.text(row[j])}",
                    where="fewest brackets",
                    expected="an explicit tableau, a_ij = 0 for j >= i",
                )
    values = [*A, b]
    bases = _graded_bases(ring, A, b, order)
    algebra = GradedAlgebra(ring, [grade for grade, _ in bases], order)
    arguments, rows = _arguments(algebra, values, bases), [row for _, row in bases]
    least, shared = least_brackets(algebra, arguments), _shared(algebra, arguments)
    plans = [before for before in (shared, {}) if before or not shared]
    tries = [(seed, before) for seed in (None, *range(attempts)) for before in plans]
    searches = (
        _Search(algebra, rows, None if seed is None else Random(seed), most).program(arguments, before, least)
        for most in count(least)
        for seed, before in tries
    )
    return next(program for program in searches if program is not None)


def _graded_bases(
    ring: Ring, A: Sequence[Sequence[Element]], b: Sequence[Element], order: int
) -> list[tuple[int, list[Element]]]:
    """Let h be the step size, and let k_1, k_2, ... be the stage values. For each stage j, consider the
    combinations q = c_1 k_1 + ... + c_(j-1) k_(j-1) + k_j. The coefficient of k_j is 1. Choose the other
    coefficients such that h q is of order h^g, where the grade g is as large as possible, but at most
    ``order``. Return a pair (g, [c_1, ..., c_(j-1), 1]) for each stage j."""
    series, bases = DexpinvSeries(ring, A, b), list[tuple[int, list[Element]]]()
    trees = [[*ordered_trees(n)] for n in range(1, order)]
    values = [{t: series.stage(j, branches(t)) for of_size in trees for t in of_size} for j in range(len(b))]
    for j in range(len(b)):
        row: list[Element] = [ring.one if n == j else ring.zero for n in range(j + 1)]
        grade = 1
        while grade < order:
            below = [t for of_size in trees[:grade] for t in of_size]
            columns = [{t: values[n][t] for t in below} for n in range(j)]
            combination = solve(ring, columns, {t: values[j][t] for t in below})
            if combination is None:
                break
            row = [*(ring.zero - x for x in combination), ring.one]
            grade += 1
        bases.append((grade, row))
    return bases


def _arguments(
    algebra: GradedAlgebra, rows: Sequence[Sequence[Element]], bases: Sequence[tuple[int, list[Element]]]
) -> list[Polynomial]:
    """Return the arguments of the exponentials as polynomials: one for each stage, and one for the step. The
    letters 0, 1, 2, ... denote h q_1, h q_2, h q_3, .... Here h is the step size, and q_j is the sum of k_j
    and multiples of k_1, ..., k_(j-1) (module docstring)."""
    ring, values, pulled, arguments = algebra.ring, list[Polynomial](), list[Polynomial](), list[Polynomial]()
    for j, (_, row) in enumerate(bases):
        earlier = [(ring.zero - x, value) for x, value in zip(row, values, strict=False)]
        values.append(algebra.combine((ring.one, {(j,): ring.one}), *earlier))
    for j, coefficients in enumerate(rows):
        arguments.append(algebra.combine(*zip(coefficients, pulled, strict=False)))
        if j < len(values):
            pulled.append(algebra.dexpinv(arguments[-1], values[j]))
    return arguments


def _limit(algebra: GradedAlgebra, arguments: Sequence[Polynomial], i: int) -> int:
    return algebra.largest - (i < len(arguments) - 1)


def _shared(algebra: GradedAlgebra, arguments: Sequence[Polynomial]) -> dict[int, list[Polynomial]]:
    """Return polynomials that a program may compute in addition to ``arguments``, in order to save brackets.

    The result is a map from indices i to lists of polynomials. The list of index i should be computed just
    before ``arguments[i]``. Each polynomial P in this list belongs to a later argument u. This argument u is
    a linear combination of P, ``arguments[i]``, h k_1, h k_2, ..., where h is the step size and k_1, k_2, ...
    are the stage values. Therefore, after P and ``arguments[i]``, u needs no new brackets."""
    one, shared = algebra.ring.one, dict[int, list[Polynomial]]()
    stages = [algebra.cut(u, algebra.largest - 1) for u in arguments[:-1]]
    for i, argument in enumerate(stages):
        excess = beyond_lie(algebra, newest_factors(argument, i - 1).get(i - 1, {}))
        for later in stages[i + 1 :] if excess else []:
            nested = {word: x for word, x in later.items() if len(word) > 1 or word[0] < i}
            also = beyond_lie(algebra, newest_factors(nested, i - 1).get(i - 1, {}))
            ratio = solve(algebra.ring, [excess], also) if also else None
            if ratio is not None and all(max(word) < i for word in nested):
                combination = algebra.combine((one, nested), (algebra.ring.zero - ratio[0], argument))
                shared.setdefault(i, []).append(combination)
    return shared


@dataclass(frozen=True)
class _Shape:
    """A description of the brackets that are added to a program (:class:`BracketProgram`) to compute one more
    element of the Lie algebra.

    The pool is the list of elements that are known before the brackets are added. The first element of the
    pool is q_1. The symbols x, y, z_n and w_n denote unknown linear combinations of elements of the pool.

    - ``inner``: the number k of nested brackets C_k, ..., C_1, which are added in this order. The first one
      is C_k = [q_1, z_k]. The bracket after C_(n+1) is C_n = [q_1, z_n + C_(n+1)].
    - ``outer``: True if, after C_1, the bracket [q_1 + x, y + C_1] is added. If k is zero, this bracket is
      [q_1 + x, y].
    - ``leading``: True if x may be nonzero.
    - ``extra``: indices of pool elements, counted from 0. For each index n in ``extra``, there is a bracket
      [e_n, w_n], where e_n is the pool element with the index n.
    """

    outer: bool = False
    leading: bool = False
    inner: int = 0
    extra: tuple[int, ...] = ()

    @property
    def brackets(self) -> int:
        """Return the number of all brackets that this object describes."""
        return self.outer + self.inner + len(self.extra)


def _shapes(pool: int) -> Iterator[_Shape]:
    """Yield infinitely many shapes (:class:`_Shape`), sorted by the number of brackets. A shape
    describes brackets that are added to a program. ``pool`` is the number of elements of the Lie algebra that
    the program computes before these brackets."""
    yield _Shape()
    for brackets in count(1):
        for others in range(min(brackets - 1, 2) + 1):
            for extra in ([()], [(e,) for e in range(1, pool)], [(1, e) for e in range(2, pool)])[others]:
                for leading in (True, False):
                    yield _Shape(True, leading, brackets - 1 - others, tuple(extra))


class _Search:
    """A search for a :class:`BracketProgram` with at most ``most`` brackets.

    ``pool`` contains a pair (element, row) for each element that the program has computed so far. The row
    represents the element as a linear combination of brackets and stage values (:class:`BracketProgram`).
    """

    def __init__(
        self, algebra: GradedAlgebra, bases: Sequence[list[Element]], random: Random | None, most: int
    ) -> None:
        self.algebra, self.ring, self._bases = algebra, algebra.ring, bases
        self._random, self._most = random, most
        self.pool: list[tuple[Polynomial, Row]] = []
        self.brackets: list[tuple[Row, Row]] = []

    def program(
        self, arguments: Sequence[Polynomial], before: Mapping[int, Sequence[Polynomial]], least: int
    ) -> BracketProgram | None:
        """Return a program that computes ``arguments[0]``, ``arguments[1]``, ... in this order. Before
        ``arguments[i]``, the program computes the elements ``before[i]``. Return None if the search finds no
        program with at most ``most`` brackets (:class:`_Search`)."""
        rows = []
        for i, argument in enumerate(arguments):
            if i:
                row = {("k", n): x for n, x in enumerate(self._bases[i - 1])}
                self.pool.append(({(i - 1,): self.ring.one}, self._clean(row)))
            for combination in before.get(i, ()):
                if self._written(combination, self.algebra.largest - 1) is None:
                    return None
            written = self._written(argument, _limit(self.algebra, arguments, i))
            if written is None:
                return None
            rows.append(written)
        return BracketProgram(tuple(self.brackets), tuple(rows[:-1]), rows[-1], least, self.algebra.grades)

    def _written(self, argument: Polynomial, limit: int) -> Row | None:
        for shape in _shapes(len(self.pool)):
            if len(self.brackets) + shape.brackets > self._most:
                return None
            row = self._fitted(shape, argument, limit)
            if row is not None:
                return row
        return None

    def _fitted(self, shape: _Shape, argument: Polynomial, limit: int) -> Row | None:
        """Return a linear combination of stage values and brackets that equals ``argument`` up to grade
        ``limit``. Return None if no such combination is found. ``shape`` describes the brackets that are
        added to the program.

        If both factors of one added bracket are unknown, the equations contain products of two unknowns, and
        are solved by iteration. Otherwise, the equations are linear."""
        if shape.leading and len(self.pool) < 3:
            return None
        for fixed_left in (False, True) if shape.leading else (False,):
            right = dict(self.pool[1][0]) if shape.leading else {}
            left: dict[int, Element] = {}
            for sweep in range(self.algebra.largest):
                reach = limit - 1 if fixed_left and not sweep else limit
                columns = self._columns(shape, right, left)
                solution = self._solved(shape, columns, argument, reach, left)
                if solution is None:
                    break
                numbers = {name: x for (name, _), x in zip(columns, solution, strict=True)}
                numbers |= {("left", 0, n): x for n, x in left.items()}
                brackets, before = len(self.brackets), len(self.pool)
                row, value, used = self._built(shape, numbers)
                defect = self.algebra.combine((self.ring.one, argument), (self.ring.rational(-1), value))
                if not self.algebra.cut(defect, limit):
                    return row
                del self.brackets[brackets:], self.pool[before:]
                if fixed_left:
                    left = {n: numbers["left", 0, n] for n in self._lightest_left()}
                else:
                    right = used
        return None

    def _lightest_left(self) -> list[int]:
        """Return the indices of the elements of lowest order in the step size h in ``self.pool[2:]``.

        The indices belong to ``self.pool``, so they are at least 2.
        """
        least = [min(map(self.algebra.grade, x)) for x, _ in self.pool]
        return [n for n, grade in enumerate(least) if n > 1 and grade == min(least[2:])]

    def _solved(
        self,
        shape: _Shape,
        columns: Sequence[tuple[tuple[str, int, int], Polynomial]],
        argument: Polynomial,
        limit: int,
        left: Mapping[int, Element],
    ) -> list[Element] | None:
        algebra, one = self.algebra, self.ring.one
        constant: Polynomial = {}
        if shape.leading:
            constant = algebra.bracket(self._left_factor(left), self.pool[1][0])
        target = algebra.combine((one, argument), (self.ring.rational(-1), constant))
        cut = [algebra.cut(column, limit) for _, column in columns]
        return self._any_solution(cut, algebra.cut(target, limit))

    def _any_solution(self, columns: Sequence[Polynomial], target: Polynomial) -> list[Element] | None:
        """Return numbers x_n with ``sum_n x_n columns[n] = target``, or None if there is no solution. If
        ``self._random`` is not None, the solution may be chosen at random."""
        if self._random is None or self._random.random() < 0.4:
            return solve(self.ring, columns, target)
        moved = [self.ring.zero] * len(columns)
        for n in range(len(columns)):
            if self._random.random() < 0.25:
                numerator, denominator = self._random.choice((-2, -1, 1, 2)), self._random.choice((1, 2, 3))
                moved[n] = self.ring.rational(numerator, denominator)
        shift = [(self.ring.zero - x, column) for x, column in zip(moved, columns, strict=True)]
        solution = solve(self.ring, columns, self.algebra.combine((self.ring.one, target), *shift))
        return None if solution is None else [x + y for x, y in zip(solution, moved, strict=True)]

    def _left_factor(self, left: Mapping[int, Element]) -> Polynomial:
        more = ((x, self.pool[n][0]) for n, x in left.items())
        return self.algebra.combine((self.ring.one, self.pool[0][0]), *more)

    def _columns(
        self, shape: _Shape, right: Polynomial, left: Mapping[int, Element]
    ) -> list[tuple[tuple[str, int, int], Polynomial]]:
        bracket, pool = self.algebra.bracket, [x for x, _ in self.pool]
        columns = [(("linear", 0, n), x) for n, x in enumerate(pool)]
        if shape.outer:
            first, factor = 2 if shape.leading else 1, self._left_factor(left)
            columns += [(("right", 0, n), bracket(factor, x)) for n, x in enumerate(pool) if n >= first]
        if shape.leading:
            columns += [
                (("left", 0, n), bracket(x, right)) for n, x in enumerate(pool) if n > 1 and n not in left
            ]
        for place in shape.extra:
            columns += [(("extra", place, n), bracket(pool[place], x)) for n, x in enumerate(pool)]
        nested = [bracket(pool[0], x) for x in pool]
        for depth in range(1, shape.inner + 1):
            nested = [bracket(pool[0], x) for x in nested]
            columns += [(("inner", depth, n), x) for n, x in enumerate(nested) if n]
        return columns

    def _built(
        self, shape: _Shape, numbers: Mapping[tuple[str, int, int], Element]
    ) -> tuple[Row, Polynomial, Polynomial]:
        """Compute an element from new brackets of the given shape, and add the brackets to the pool.
        ``numbers`` maps the names of the unknowns to their values. Return three values:

        - the row of the element (:class:`BracketProgram`)
        - the element as a polynomial
        - if ``shape.outer`` is True, the linear combination y in the bracket [q_1 + x, y + C_1]
          (:class:`_Shape`), as a polynomial; otherwise, the zero polynomial
        """
        one, size = self.ring.one, len(self.pool)

        def of(kind: str, depth: int, *more: tuple[Element, int]) -> list[tuple[Element, int]]:
            return [*more, *((x, n) for (k, d, n), x in numbers.items() if (k, d) == (kind, depth))]

        above: list[tuple[Element, int]] = []
        for depth in range(shape.inner, 0, -1):
            above = [(one, self._bracket([(one, 0)], of("inner", depth, *above)))]
        terms = of("linear", 0)
        y: list[tuple[Element, int]] = []
        if shape.outer:
            y = of("right", 0, *above, *([(one, 1)] if shape.leading else []))
            terms.append((one, self._bracket(of("left", 0, (one, 0)), y)))
        for place in shape.extra:
            terms.append((one, self._bracket([(one, place)], of("extra", place))))
        value = self.algebra.combine(*((x, self.pool[n][0]) for x, n in terms))
        right = self.algebra.combine(*((x, self.pool[n][0]) for x, n in y if n < size))
        return self._row(terms), value, right

    def _bracket(self, left: Sequence[tuple[Element, int]], right: Sequence[tuple[Element, int]]) -> int:
        """Add the bracket of two linear combinations of pool elements to the pool, and return its index."""
        x, y = (self.algebra.combine(*((c, self.pool[n][0]) for c, n in side)) for side in (left, right))
        rows = self._row(left), self._row(right)
        if len(rows[0]) == 1:
            rows[1].pop(next(iter(rows[0])), None)  # Remove multiples of x from y, because [x, x] = 0.
        self.brackets.append(rows)
        self.pool.append((self.algebra.bracket(x, y), {("B", len(self.brackets) - 1): self.ring.one}))
        return len(self.pool) - 1

    def _row(self, terms: Sequence[tuple[Element, int]]) -> Row:
        result: Row = {}
        for x, n in terms:
            for name, value in self.pool[n][1].items():
                result[name] = result.get(name, self.ring.zero) + x * value
        return self._clean(result)

    def _clean(self, row: Row) -> Row:
        kept = {name: x for name, x in row.items() if self.ring.is_zero(x) is not True}
        return dict(sorted(kept.items(), key=lambda item: (item[0][0] == "B", item[0][1])))


def _spell(row: Mapping[Name, Element], ring: Ring) -> str:
    terms = []
    for (kind, n), x in row.items():
        number = ring.text(x)
        name = f"{kind}{n + 1}"
        terms.append({"1": name, "-1": f"-{name}"}.get(number, f"{number} {name}"))
    return " + ".join(terms).replace("+ -", "- ") or "0"
