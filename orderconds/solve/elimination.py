"""Proofs that no method exists, by exact elimination from the order conditions.

A Groebner basis is computed for a subset of the conditions. The conditions in the subset depend on at most
:data:`MAX_VARIABLES` coefficients of the method. If the basis contains 1, no real or complex method satisfies
the conditions. If the basis contains a polynomial in one coefficient, and the polynomial has no real root
(Sturm's theorem), no real method satisfies the conditions. Some families require nonzero weights b_i. For
such a weight, zero does not count as a root.

Let the conditions be e_k = 0. The proof is an identity sum_k p_k e_k = r with polynomials p_k. The right-hand
side r is 1 or the polynomial in one coefficient. This identity is verified exactly.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING, cast

from flint import fmpq, fmpq_mat, fmpq_mpoly

from orderconds.conditions import OrderCondition
from orderconds.ring.laurent import Laurent, LaurentPolynomials
from orderconds.ring.polynomials import Polynomials
from orderconds.solve.problem import Problem
from orderconds.tableau import RungeKutta
from orderconds.tableau.method_properties import symplectic

if TYPE_CHECKING:
    import sympy

    from orderconds.tableau.unknowns import RootedRing

Member = tuple[OrderCondition, fmpq_mpoly]
"""An order condition and the numerator of its residual."""

MAX_VARIABLES = 3
"""Elimination uses only conditions that contain at most MAX_VARIABLES coefficients."""

MAX_UNKNOWNS, MAX_ORDER = 16, 5
"""Elimination is tried for at most MAX_UNKNOWNS unknowns, with the conditions up to order MAX_ORDER. The two
limits keep the number of terms in the polynomials small."""

MAX_DEGREE = 8
"""Elimination multiplies equations by polynomials of degree less than MAX_DEGREE."""


@dataclass(frozen=True)
class Infeasible:
    """A proof by contradiction that no method with real coefficients satisfies ``conditions``.

    The sum of the products ``multipliers[k] * equations[k]`` is the polynomial ``consequence``. There are
    three kinds of proofs:

    - If ``real`` is false, the equation ``consequence`` = 0 has no real or complex solution.
    - If ``real`` is true and ``weight`` is empty, the equation has no real solution.
    - If ``weight`` is the name of a weight, this weight is zero in each real solution of the equation. This
      is impossible: the formulas of the family divide by the weight.

    The proof is valid for the methods that satisfy the options of the search and all ``assumptions``. An
    assumption is a text such as ``all weights b_i are nonzero``.

    Entry k of ``equations`` is the numerator of the residual of condition k: left-hand side minus right-hand
    side.
    """

    variables: tuple[str, ...]
    conditions: tuple[OrderCondition, ...]
    equations: tuple[str, ...]
    multipliers: tuple[str, ...]
    consequence: str
    real: bool
    weight: str = ""
    assumptions: tuple[str, ...] = ()

    @property
    def reason(self) -> str:
        """A text that says why no method with real coefficients satisfies ``conditions``. The conditions
        imply the equation ``consequence`` = 0, and the text says why this equation cannot hold."""
        if not self.real:
            return f"{self.consequence} = 0 is false"
        if self.weight:
            return (
                f"the only real solution of {self.consequence} = 0 is {self.weight} = 0 (Sturm's theorem), "
                f"but the formulas of the family divide by {self.weight}"
            )
        return f"{self.consequence} = 0 has no real root (Sturm)"

    def as_json(self) -> dict[str, object]:
        """Return the proof as a dictionary for JSON."""
        return {
            "conditions": [{"order": c.order, "tree": c.tree, "expression": str(c)} for c in self.conditions],
            "equations": list(self.equations),
            "multipliers": list(self.multipliers),
            "consequence": self.consequence,
            "reason": self.reason,
            "assumptions": list(self.assumptions),
        }


def infeasible(problem: Problem) -> Infeasible | None:
    """Return a proof that no method with real coefficients satisfies the order conditions of ``problem``.
    Return None if elimination yields no proof.

    >>> from orderconds.solve.spec import Spec
    >>> from orderconds.solve.problem import find_problem
    >>> print(infeasible(find_problem("vcg", 3, Spec(stages=2), "full")).reason)
    3*b2^2 - 3*b2 + 1 = 0 has no real root (Sturm)
    >>> print(infeasible(find_problem("rk", 3, Spec(stages=2, explicit=True), "full")).reason)
    1 = 0 is false
    """
    names = problem.ansatz.free
    if len(names) > MAX_UNKNOWNS:
        return None
    # The formulas of symplectic methods divide by the weights, so the proof considers only methods with
    # nonzero weights. This is sufficient, because every method with a zero weight b_i can be replaced by a
    # method with fewer zero weights that computes the same step. Symplecticity implies a_ki = 0 for each
    # stage k with b_k != 0. Hence stage i has no effect on the step. Choose a stage j with b_j != 0. Replace
    # stage i by a copy of stage j, and divide b_j and all coefficients a_1j, ..., a_sj equally between stage
    # j and the copy. The new method can violate the options --dirk, --symmetric and --fix. With one of these
    # options, the proof therefore assumes nonzero weights (``Ansatz.assumptions``).
    divides = problem.family.needs_nonzero_weights or problem.family.symplectic
    ring = LaurentPolynomials(names) if divides else Polynomials(names)
    try:
        values = problem.residuals(ring.generators, cast("RootedRing", ring), _conditions(problem))
        nonzero = _nonzero(problem, ring)
        # The formulas of the ansatz must make every method symplectic. If some methods are not symplectic,
        # the formulas are wrong, and a proof with these formulas would not be valid.
        if problem.family.symplectic and not _is_symplectic(problem, ring):
            return None
    except (
        AttributeError,
        ArithmeticError,
        TypeError,
        ValueError,
    ):  # Elimination requires residuals that are Laurent polynomials.
        return None
    plain = Polynomials(names)
    system = [(c, _numerator(x, plain)) for c, x in zip(_conditions(problem), values, strict=True)]
    for variables, members in _subsystems([x for x in system if not plain.is_zero(x[1])], plain):
        contradiction = _consequence(nonzero, variables, [x for _, x in members], plain)
        if contradiction is not None:
            certificate = _certificate(variables, members, *contradiction, plain)
            if certificate is not None:
                return replace(certificate, assumptions=problem.ansatz.assumptions)
    return None


def _is_symplectic(problem: Problem, ring: LaurentPolynomials | Polynomials) -> bool:
    method = problem.ansatz.method(ring.generators, cast("RootedRing", ring))
    return isinstance(method, RungeKutta) and symplectic(method, ring) is True


def _conditions(problem: Problem) -> tuple[OrderCondition, ...]:
    return tuple(c for n in range(1, min(problem.order, MAX_ORDER) + 1) for c in problem.family.conditions(n))


def _nonzero(problem: Problem, ring: LaurentPolynomials | Polynomials) -> frozenset[str]:
    """Return the names of the weights among the free coefficients if the family requires nonzero weights.
    Otherwise, return an empty set."""
    if not problem.family.needs_nonzero_weights:
        return frozenset()
    weights = problem.weights(ring.generators, cast("RootedRing", ring))
    return frozenset(
        name
        for name, x in zip(ring.names, ring.generators, strict=True)
        if any(ring.is_zero(w - x) for w in weights)
    )


def _numerator(x: Laurent | fmpq_mpoly, plain: Polynomials) -> fmpq_mpoly:
    """Return the numerator of ``x`` as a polynomial."""
    numerator = x.numerator if isinstance(x, Laurent) else x
    return plain.zero.context().from_dict({tuple(map(int, e)): c for e, c in numerator.terms()})


def _support(x: fmpq_mpoly) -> frozenset[int]:
    return frozenset(k for exponents, _ in x.terms() for k, e in enumerate(exponents) if e)


def _subsystems(
    system: Sequence[Member], plain: Polynomials
) -> Iterator[tuple[tuple[int, ...], list[Member]]]:
    supports = sorted({_support(x) for _, x in system if len(_support(x)) <= MAX_VARIABLES}, key=sorted)
    wanted = {*supports, *(x | y for x, y in combinations(supports, 2) if len(x | y) <= MAX_VARIABLES)}
    for variables in sorted(wanted, key=lambda x: (len(x), sorted(x))):
        members = [(c, x) for c, x in system if _support(x) <= variables]
        if len(members) > len(variables) or not variables or len(members) > 1:
            yield tuple(sorted(variables)), members


def _consequence(
    nonzero: frozenset[str], variables: Sequence[int], members: Sequence[fmpq_mpoly], plain: Polynomials
) -> tuple[fmpq_mpoly, str] | None:
    """Consider the equations p = 0 for all polynomials p in ``members``. Assume that the weights in
    ``nonzero`` are nonzero. Prove that the equations have no real solution. Return None if no proof is found.

    The proof is a pair (polynomial, text). The polynomial lies in the ideal of ``members`` and has at most
    one variable. There are two kinds of proofs:

    - The polynomial has no real root. The text is empty.
    - The only real root of the polynomial is zero, but the variable of the polynomial is a weight in
      ``nonzero``. The text is the name of this weight.
    """
    import sympy

    symbols = [sympy.Symbol(plain.names[k]) for k in variables]
    if not symbols:
        return plain.one, ""
    expressions = [_sympy(x, variables, symbols) for x in members]
    basis = sympy.groebner(expressions, *symbols, order="lex")
    for polynomial in basis.polys:
        free = polynomial.free_symbols_in_domain | polynomial.as_expr().free_symbols
        if not free:
            return plain.one, ""
        if len(free) == 1:
            (symbol,) = free
            weight = ""
            univariate = sympy.Poly(polynomial.as_expr(), symbol)
            while symbol.name in nonzero and not univariate.eval(0):
                univariate = sympy.div(univariate, sympy.Poly(symbol, symbol))[0]
                weight = symbol.name
            if univariate.count_roots() == 0:
                return _flint(sympy.Poly(polynomial.as_expr(), symbol), plain), weight
    return None


def _sympy(x: fmpq_mpoly, variables: Sequence[int], symbols: Sequence[sympy.Symbol]) -> sympy.Expr:
    import sympy

    return sum(
        sympy.Rational(int(c.p), int(c.q))
        * sympy.prod([s ** int(exponents[k]) for k, s in zip(variables, symbols, strict=True)])
        for exponents, c in x.terms()
    )


def _flint(polynomial: sympy.Poly, plain: Polynomials) -> fmpq_mpoly:
    """Convert a univariate polynomial from sympy to flint, scaled to integer coefficients without a common
    factor.
    """
    place = plain.names.index(polynomial.gen.name)
    result = plain.zero
    for (power,), c in polynomial.primitive()[1].clear_denoms(convert=True)[1].terms():
        result = result + plain.rational(int(c)) * plain.generators[place] ** power
    return result


def _certificate(
    variables: Sequence[int],
    members: Sequence[Member],
    consequence: fmpq_mpoly,
    weight: str,
    plain: Polynomials,
) -> Infeasible | None:
    """Return a proof that the conditions in ``members`` imply the equation ``consequence`` = 0. The proof
    multiplies the polynomial of each condition by another polynomial, such that the sum of the products is
    ``consequence``. Return None if no multipliers of a degree below :data:`MAX_DEGREE` are found."""
    for degree in range(MAX_DEGREE):
        multipliers = _multipliers(variables, [x for _, x in members], consequence, degree, plain)
        if multipliers is not None:
            total = sum((m * x for m, (_, x) in zip(multipliers, members, strict=True)), plain.zero)
            assert plain.is_zero(total - consequence)
            used = [(c, x, m) for m, (c, x) in zip(multipliers, members, strict=True) if not plain.is_zero(m)]
            return Infeasible(
                variables=tuple(plain.names[k] for k in variables),
                conditions=tuple(c for c, _, _ in used),
                equations=tuple(plain.text(x) for _, x, _ in used),
                multipliers=tuple(plain.text(m) for _, _, m in used),
                consequence=plain.text(consequence),
                real=bool(_support(consequence)),
                weight=weight,
            )
    return None


def _multipliers(
    variables: Sequence[int],
    members: Sequence[fmpq_mpoly],
    consequence: fmpq_mpoly,
    degree: int,
    plain: Polynomials,
) -> list[fmpq_mpoly] | None:
    """Return polynomials m_k of degree at most ``degree`` with sum_k m_k ``members[k]`` = ``consequence``, or
    None."""
    monomials = [plain.one]
    frontier = [plain.one]
    for _ in range(degree):
        frontier = list(
            {
                str(m * plain.generators[k]): m * plain.generators[k] for m in frontier for k in variables
            }.values()
        )
        monomials += frontier
    columns = [m * f for f in members for m in monomials]
    rows: dict[tuple[int, ...], int] = {}
    for x in (*columns, consequence):
        for exponents, _ in x.terms():
            rows.setdefault(tuple(map(int, exponents)), len(rows))
    matrix = fmpq_mat(len(rows), len(columns) + 1)
    for j, x in enumerate((*columns, consequence)):
        for exponents, c in x.terms():
            matrix[rows[tuple(map(int, exponents))], j] = c
    reduced, rank = matrix.rref()
    values = [fmpq(0)] * len(columns)
    for i in range(rank):
        pivot = next(j for j in range(len(columns) + 1) if reduced[i, j])
        if pivot == len(columns):
            return None
        values[pivot] = reduced[i, len(columns)]
    products = []
    for k in range(len(members)):
        share = values[k * len(monomials) : (k + 1) * len(monomials)]
        products.append(
            sum(
                (plain.rational(int(c.p), int(c.q)) * m for c, m in zip(share, monomials, strict=True) if c),
                plain.zero,
            )
        )
    return products
