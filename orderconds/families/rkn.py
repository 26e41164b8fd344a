"""Runge-Kutta-Nystroem splittings: H = T(q, p) + V(q), where T is quadratic in p.

Let x and y be functions of q alone. Then [x,y] = 0. Because T is quadratic in p, [x,[T,y]] is also a function
of q alone. For example, [V,[V,T]] is a function of q alone, so [V,[V,[V,T]]] = 0. The free algebra over T and
V has no such relations. Two rules define a set B in this algebra: V is in B, and if x and y are in B, then
[x,[T,y]] is also in B. The first two elements of B are V and [V,[T,V]]. The brackets [x,y] of all x and y in
B generate an ideal of the free algebra. For the functions T and V, all these brackets are zero. Therefore the
part of the local error that lies in the ideal is zero, and this part gives no order conditions.

A functional is a linear map from the free algebra to the rational numbers. The functionals that are zero on
the ideal form a vector space. Each element of a basis of this vector space gives one condition. Many of these
conditions depend on others: if two conditions hold, the product of their left-hand sides is known, and this
product is a linear combination of left-hand sides of higher order. The numbers of independent conditions of
orders 1, 2, ... are 2, 1, 2, 2, 4, 5, 10, 14, 25, ... (McLachlan, SIAM J. Sci. Comput. 16 (1995) 151;
McLachlan and Murua, J. Comput. Dyn. 6 (2019) 345).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import combinations
from math import lcm, prod
from typing import TYPE_CHECKING, Self

from flint import fmpq, fmpq_mat

from orderconds.conditions import OrderCondition
from orderconds.errors import InputError
from orderconds.families.base import Family, expect
from orderconds.families.registry import register
from orderconds.families.relations import Polynomial, with_relations
from orderconds.families.splitting import SplittingFamily, two_part_formula
from orderconds.families.stage_form import StageForm, refuse_explicit
from orderconds.formula import Formula, total
from orderconds.ring.protocol import Element, Ring
from orderconds.tableau.products import Method, Splitting
from orderconds.tableau.record import Tableau
from orderconds.tableau.work import Work
from orderconds.words.lie import expand
from orderconds.words.quotient import Functional, independent_on_lie, orthogonal
from orderconds.words.shuffle import Series, Word, add, shuffle

if TYPE_CHECKING:
    import numpy as np

    from orderconds.ring.residues import Residues

T, V = 0, 1


@register
class NystroemFamily(Family):
    """Splittings of the Hamiltonian T + V, where T is quadratic in p and V depends on q only. A tableau file
    can use other names for T and V. The key ``rkn`` of the file contains the name of V.

    >>> [len(NystroemFamily().conditions(n)) for n in range(1, 6)]
    [2, 1, 2, 2, 4]
    >>> print(NystroemFamily().conditions(3)[0].tree, NystroemFamily().conditions(3)[0])
    TTV sum_i c_i^2 b_i = 1/3
    """

    name = "rkn"
    description = (
        "Runge-Kutta-Nystroem splittings: H = T(q, p) + V(q) with T quadratic in p, so [V,[V,[V,T]]] = 0."
    )
    formats = ("splitting",)
    symbols = SplittingFamily.symbols
    unknowns = "splitting"

    def require(self, method: Method, ring: Ring) -> None:
        """Raise :class:`~orderconds.errors.InputError` if the tableau file of ``method`` has no key
        ``rkn``."""
        if expect(method, Splitting).rkn is None:
            raise InputError(
                "the splitting has no key rkn",
                where=f"family {self.name}",
                expected='a line such as rkn = "V", which states that [V,[V,[V,T]]] = 0 for the parts T and '
                "V of the splitting",
                hint="use the family 'splitting'",
            )

    def conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the independent conditions of exactly the given order."""
        return tuple(map(self._condition, independent(order)))

    def all_conditions(self, order: int) -> tuple[OrderCondition, ...]:
        """Return the conditions of the given order, one for each element of :func:`functionals`.

        The attribute ``relation`` of a dependent condition is a polynomial in left-hand sides of independent
        conditions.
        """
        return with_relations(map(self._condition, functionals(order)), relation, text)

    def evaluate(
        self, method: Method, ring: Ring, conditions: Sequence[OrderCondition]
    ) -> tuple[Element, ...]:
        """Return the values of the left-hand sides for one step of a splitting. Each left-hand side is
        multiplied by the factor that :func:`_scale` returns."""
        self.require(method, ring)
        splitting = expect(method, Splitting)
        swap = splitting.rkn == T
        steps = [(1 - part if swap else part, x) for part, x in splitting.steps]
        values = SplittingFamily().series(Splitting(("T", "V"), tuple(steps)), ring)
        results = []
        for condition in conditions:
            value = ring.zero
            for word, scale in condition.key:
                value = value + values(word) * scale
            results.append(value * _scale(condition.key))
        return tuple(results)

    def in_stages(self, stages: int, *, explicit: bool = False) -> StageForm:
        """Return the unknowns of a splitting T + V. Each of the ``stages`` stages has two unknowns, the step
        sizes of the flows of T and V."""
        refuse_explicit(self.label(), explicit)
        form = SplittingFamily().in_stages(stages)
        return StageForm(form.names, lambda values, ring: _nystroem(form.method(values, ring)))

    @classmethod
    def claimable(cls, tableau: Tableau) -> Self | None:
        """Return this family if the method is a splitting and its tableau file contains the key ``rkn``.
        Otherwise return None."""
        method = tableau.method
        return cls() if isinstance(method, Splitting) and method.rkn is not None else None

    def symmetric_facts(self, order: int) -> tuple[tuple[str, int], ...]:
        """Return the pairs ("rkn", ``order``) and ("splitting", min(``order``, 4)).

        Each pair contains a family and a lower bound for the order of a symmetric method in this family. The
        argument ``order`` is the order of the method in the family ``rkn``.

        Up to order 3, the families ``rkn`` and ``splitting`` have the same conditions. If ``order`` >= 3, the
        method therefore has at least order 3 in the family ``splitting``. The order of a symmetric method is
        even, so the method has at least order 4 in the family ``splitting``.
        """
        return ((self.label(), order), ("splitting", min(order, 4)))

    def work(self, tableau: Tableau) -> Work | None:
        """Return None. A step is a product of flows of T and V, and the cost of these flows depends on the
        problem."""
        return None

    def random_method(self, ring: Residues, generator: np.random.Generator, order: int) -> Splitting:
        """Return a splitting of T + V in which the step sizes of all flows are random."""
        return _nystroem(SplittingFamily().random_method(ring, generator, order))

    def _condition(self, functional: Functional) -> OrderCondition:
        splitting, scale = SplittingFamily(), _scale(functional)
        rhs = sum((splitting.exact(word) * x for word, x in functional), Fraction(0))
        return OrderCondition(
            self.name,
            len(functional[0][0]),
            text(functional),
            lambda: formula(functional),
            rhs * scale,
            functional,
        )


def _nystroem(method: Method) -> Splitting:
    return Splitting(("T", "V"), expect(method, Splitting).steps, V)


def text(functional: Functional) -> str:
    """Return a linear combination of words as text.

    >>> text((((0, 1, 1, 1), 1), ((1, 1, 1, 0), 1)))
    'TVVV + VVVT'
    """
    written = ""
    for word, scale in functional:
        sign = (" - " if scale < 0 else " + ") if written else ("-" if scale < 0 else "")
        size = "" if abs(scale) == 1 else f"{abs(scale)} "
        written += sign + size + "".join("TV"[letter] for letter in word)
    return written


def formula(functional: Functional) -> Formula:
    """Return the left-hand side of the condition of ``functional`` as an index sum.

    ``functional`` contains pairs (word, coefficient). In a word, the letter 0 is T and the letter 1 is V.

    In stage i of a splitting T + V, the step sizes are a_i for T and b_i for V. Let c_i = a_1 + ... + a_i.

    >>> from orderconds.formula import named
    >>> named(formula((((0, 1), 1), ((1, 0), 1)))).text()
    'sum_i c_i b_i + sum_i b_i (sum_j a_j - c_i)'
    """
    splitting, scale = SplittingFamily(), _scale(functional)
    return total(*((Fraction(scale * x, splitting.scale(w)), two_part_formula(w)) for w, x in functional))


def _scale(functional: Functional) -> int:
    """Return the least common denominator of the coefficients in the left-hand side of a condition."""
    splitting = SplittingFamily()
    return lcm(*(Fraction(x, splitting.scale(word)).denominator for word, x in functional))


@lru_cache(maxsize=32)
def functionals(order: int) -> tuple[Functional, ...]:
    """Return one functional for each condition of order ``order`` of Runge-Kutta-Nystroem splittings.

    A functional is a linear combination of words over T and V. If x and y are functions of q alone, the
    bracket [x,y] is zero. The brackets [x,y] of all functions x and y of q alone generate an ideal of the
    free algebra over T and V (see the module docstring). For example, [V,[V,[T,V]]] is in the ideal, because
    V and [V,[T,V]] are functions of q alone. The returned functionals are a basis of the vector space of all
    functionals on words of length ``order`` that are zero on the ideal.

    >>> [len(functionals(n)) for n in (1, 2, 3, 4)]
    [2, 4, 8, 15]
    """
    return orthogonal(_ideal(order), (T, V), order)


@lru_cache(maxsize=32)
def independent(order: int) -> tuple[Functional, ...]:
    """Return functionals from :func:`functionals` whose conditions are independent. If these conditions and
    all conditions of lower order hold, the conditions of all other functionals hold, too.

    >>> [text(functional) for functional in independent(4)]
    ['TTTV', 'TTVV']
    """
    return independent_on_lie(functionals(order), order)


@lru_cache(maxsize=32)
def _potentials(weight: int) -> tuple[Series, ...]:
    """Return polynomials in T and V: the elements of degree ``weight`` in the set B.

    The module docstring defines T, V, the set B and an ideal. If x and y are in B, the brackets [x,[T,y]] and
    [y,[T,x]] are equal modulo the ideal. The result contains only one of these two brackets.
    """
    if weight == 1:
        return (expand(V),)
    potentials = []
    for left in range(1, weight // 2 + 1):
        right = weight - 1 - left
        for i, x in enumerate(_potentials(left)):
            for y in _potentials(right)[i if left == right else 0 :] if right >= left else ():
                potentials.append(_commutator(x, _commutator(expand(T), y)))
    return tuple(potentials)


@lru_cache(maxsize=32)
def _ideal(order: int) -> tuple[Series, ...]:
    """Return the brackets [x, y] that generate the ideal up to degree ``order``. The module docstring defines
    x, y and the ideal."""
    known = [(n, x) for n in range(1, order) for x in _potentials(n)]
    return tuple(
        bracket
        for (m, x), (n, y) in combinations(known, 2)
        if m + n <= order and (bracket := _commutator(x, y))
    )


def _commutator(x: Series, y: Series) -> Series:
    forth = {u + v: a * b for u, a in x.items() for v, b in y.items()}
    back: Series = {}
    for v, b in y.items():
        for u, a in x.items():
            back[v + u] = back.get(v + u, Fraction(0)) + a * b
    return add((1, forth), (-1, back))


@lru_cache(maxsize=1 << 12)
def _relation(functional: Functional) -> tuple[tuple[tuple[Functional, ...], Fraction], ...]:
    n, content = len(functional[0][0]), sorted(functional[0][0])
    own: list[tuple[Functional, ...]] = [(f,) for f in independent(n) if sorted(f[0][0]) == content]
    monomials = own + [m for m in _monomials(n, n - 1) if sorted(w for f in m for w in f[0][0]) == content]
    columns = [_shuffled(monomial) for monomial in monomials] + [dict(functional)]
    words = sorted({word for column in columns for word in column})
    matrix = fmpq_mat([[fmpq(column.get(word, 0)) for column in columns] for word in words])
    reduced, rank = matrix.rref()
    result = []
    for r in range(rank):
        pivot = next(k for k in range(len(columns)) if reduced[r, k] != 0)
        value = reduced[r, len(columns) - 1]
        if value != 0:
            result.append((monomials[pivot], Fraction(int(value.p), int(value.q))))
    return tuple(result)


def relation(functional: Functional) -> Polynomial:
    """Return a polynomial in the left-hand sides of independent conditions. The polynomial is equal to the
    left-hand side of the condition of ``functional``.

    >>> relation((((1, 0), 1),))
    {((((0,), 1),), (((1,), 1),)): Fraction(1, 1), ((((0, 1), 1),),): Fraction(-1, 1)}
    """
    scaled = {
        tuple(sorted(monomial)): value * _scale(functional) / prod(map(_scale, monomial))
        for monomial, value in _relation(functional)
    }
    return dict(sorted(scaled.items(), key=lambda term: (-len(term[0]), term[0])))


def _monomials(order: int, heaviest: int) -> list[tuple[Functional, ...]]:
    """Return all products of functionals from :func:`independent`, as tuples of the factors. The orders of
    the factors are at most ``heaviest`` and have the sum ``order``."""
    known = [f for n in range(heaviest, 0, -1) for f in independent(n)]

    def extend(left: int, start: int) -> list[tuple[Functional, ...]]:
        if left == 0:
            return [()]
        extensions = []
        for place in range(start, len(known)):
            n = len(known[place][0][0])
            if n <= left:
                extensions += [(known[place], *rest) for rest in extend(left - n, place)]
        return extensions

    return extend(order, 0)


def _shuffled(monomial: tuple[Functional, ...]) -> dict[Word, int]:
    result: dict[Word, int] = {(): 1}
    for functional in monomial:
        product: dict[Word, int] = {}
        for u, a in result.items():
            for v, b in functional:
                for word, times in shuffle(u, v).items():
                    product[word] = product.get(word, 0) + times * a * b
        result = product
    return result
