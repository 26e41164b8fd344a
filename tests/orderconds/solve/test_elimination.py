"""Proofs that no method exists: the combination of conditions is multiplied out again here."""

from __future__ import annotations

import pytest
import sympy

from orderconds.ring.polynomials import Polynomials
from orderconds.solve.elimination import _certificate, _consequence, _nonzero, infeasible
from orderconds.solve.problem import find_problem
from orderconds.solve.spec import Spec

CASES = [
    ("vcg", 3, Spec(2)),
    ("vcg", 3, Spec(1)),
    ("rk", 4, Spec(3, explicit=True)),
    ("cg", 3, Spec(2, explicit=True)),
    ("vcg", 5, Spec(3)),
    ("composition", 6, Spec(3)),
    ("symplectic_rk", 3, Spec(2, dirk=True)),
]


@pytest.mark.parametrize(("family", "order", "spec"), CASES)
def test_the_combination_of_conditions_is_the_contradiction(family: str, order: int, spec: Spec) -> None:
    proof = infeasible(find_problem(family, order, spec, "full"))
    assert proof is not None
    total = sum(
        sympy.sympify(m.replace("^", "**")) * sympy.sympify(e.replace("^", "**"))
        for m, e in zip(proof.multipliers, proof.equations, strict=True)
    )
    consequence = sympy.sympify(proof.consequence.replace("^", "**"))
    assert sympy.expand(total - consequence) == 0
    assert sympy.real_roots(consequence) == [] if proof.real else consequence == 1


def test_the_equations_are_the_conditions() -> None:
    proof = infeasible(find_problem("vcg", 3, Spec(2), "full"))
    assert proof is not None
    b1, b2 = sympy.symbols("b1 b2")
    half = sympy.Rational(1, 2)
    printed = b1 * (b2 + half * b1) ** 2 + b2 * (half * b2) ** 2 - sympy.Rational(1, 3)
    assert str(proof.conditions[1]) == "sum_i b_i (sum_{j>i} b_j + 1/2 b_i)^2 = 1/3"
    assert sympy.expand(printed - sympy.sympify(proof.equations[1].replace("^", "**"))) == 0


@pytest.mark.parametrize(
    ("family", "order", "spec"),
    [
        ("vcg", 3, Spec(3)),
        ("rk", 3, Spec(3, explicit=True)),
        ("vcg", 2, Spec(1)),
        ("symplectic_rk", 4, Spec(2)),
    ],
)
def test_what_exists_is_not_refuted(family: str, order: int, spec: Spec) -> None:
    assert infeasible(find_problem(family, order, spec, "full")) is None


def test_a_weight_that_may_be_zero_in_the_equation_is_named_in_the_reason() -> None:
    """No method of VCG has a weight zero, but the equation b1^3 + b1 = 0 has the real root 0."""
    problem = find_problem("vcg", 3, Spec(2), "full")
    plain = Polynomials(problem.ansatz.free)
    k = plain.names.index("b1")
    b1 = plain.generators[k]
    member = b1 * (b1 * b1 + plain.one)
    assert _nonzero(problem, plain) == {"b1", "b2"}
    found = _consequence(_nonzero(problem, plain), [k], [member], plain)
    assert found is not None
    consequence, weight = found
    assert (plain.text(consequence), weight) == ("b1^3 + b1", "b1")
    (condition,) = problem.family.conditions(1)
    proof = _certificate([k], [(condition, member)], consequence, weight, plain)
    assert proof is not None
    assert proof.reason == (
        "b1^3 + b1 = 0 has no real root except zero (Sturm), but "
        "b1 must not be zero: the formulas of the family divide by b1"
    )


def test_a_weight_zero_is_a_root_where_no_formula_divides_by_it() -> None:
    problem = find_problem("rk", 3, Spec(2, explicit=True), "full")
    plain = Polynomials(problem.ansatz.free)
    k = plain.names.index("b1")
    b1 = plain.generators[k]
    assert _nonzero(problem, plain) == frozenset()
    assert _consequence(frozenset(), [k], [b1 * (b1 * b1 + plain.one)], plain) is None


@pytest.mark.parametrize(
    ("exponentials", "structure", "expected"),
    [(1, "full", {"b1_1", "b1_2"}), (2, "full", set()), (2, "symmetric", set())],
)
def test_a_coefficient_of_one_of_two_exponentials_is_no_weight(
    exponentials: int, structure: str, expected: set[str]
) -> None:
    """A commutator-free method may have such a coefficient zero, because the weight is a sum."""
    problem = find_problem("vcf", 2, Spec(2, exponentials=exponentials), structure)
    assert _nonzero(problem, Polynomials(problem.ansatz.free)) == expected
