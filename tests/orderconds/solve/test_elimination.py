"""Proofs that no method exists: the combination of conditions is multiplied out again here."""

from __future__ import annotations

from importlib import import_module

import pytest
import sympy

from orderconds.checking.verdict import check
from orderconds.ring.laurent import LaurentPolynomials
from orderconds.ring.polynomials import Polynomials
from orderconds.solve.elimination import _certificate, _consequence, _nonzero, infeasible
from orderconds.solve.path_ansatz import MIRRORED
from orderconds.solve.problem import find_problem
from orderconds.solve.solver import Order, solve
from orderconds.solve.spec import Spec
from orderconds.tableau import RungeKutta, Tableau
from orderconds.tableau.method_properties import symplectic

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


PADDED = """
name = "padded"
family = "rk"
A = [["7"], ["0", "w/2"], ["0", "w", "1/2 - w"], ["0", "w", "1 - 2*w", "w/2"]]
b = ["0", "w", "1 - 2*w", "w"]
[numbers]
w = "1/(2 - 2^(1/3))"
[claims]
symplectic_rk = 4
symplectic = true
"""


def test_a_proof_for_symplectic_methods_with_options_assumes_nonzero_weights() -> None:
    """The method PADDED satisfies the options, but its first weight is zero, so the symplecticity of the
    method does not imply 2 a_11 = b_1."""
    assert check(Tableau.loads(PADDED, "padded")).verdict == "holds"
    spec = Spec(4, dirk=True, fix=("a11=7", "a22=a44"))
    proof = infeasible(find_problem("symplectic_rk", 4, spec, "full"))
    assert proof is not None
    assert proof.assumptions == ("all weights b_i are nonzero",)
    assert proof.as_json()["assumptions"] == list(proof.assumptions)


@pytest.mark.parametrize(
    ("family", "order", "spec", "structure", "assumption"),
    [
        ("vcg", 3, Spec(2), "full", ""),
        ("rk", 4, Spec(3, explicit=True), "full", ""),
        (
            "composition",
            6,
            Spec(3),
            "full",
            "the method composes steps of one symmetric method of order 2, "
            "and the step sizes form a palindrome",
        ),
        (
            "splitting",
            4,
            Spec(4, symmetric=True, fix=("b1=0",)),
            "full",
            "the step sizes of T form a palindrome, and the step sizes of V form a palindrome",
        ),
        (
            "rk",
            2,
            Spec(3, fsal=True, fix=("b3=2/5+a11", "a21=a11", "a22=-a11", "a23=0")),
            "full",
            "a_1j = 0 and a_sj = b_j for all j",
        ),
        ("rk", 3, Spec(1, symmetric=True), "full", "a_ij + a_(s+1-i)(s+1-j) = b_j for all i and j"),
        ("symplectic_rk", 3, Spec(2, dirk=True), "full", "all weights b_i are nonzero"),
        (
            "cf",
            4,
            Spec(2, explicit=True),
            "full",
            "the update is y0 multiplied by at most 2 exponentials, "
            "and stage i is y0 multiplied by at most n_i exponentials, with n = (0, 2)",
        ),
        (
            "cf",
            4,
            Spec(2, symmetric=True, exponentials=1),
            "symmetric",
            "the update is y0 multiplied by at most 1 exponentials, "
            "and stage i is y0 multiplied by at most n_i exponentials, with n = (2, 1); "
            f"stage i begins with the first k_i exponentials of the update, k = (1, 0); {MIRRORED}",
        ),
    ],
)
def test_a_proof_states_what_it_assumes(
    family: str, order: int, spec: Spec, structure: str, assumption: str
) -> None:
    proof = infeasible(find_problem(family, order, spec, structure))
    assert proof is not None
    assert proof.assumptions == ((assumption,) if assumption else ())


@pytest.mark.parametrize(
    ("stages", "fix"),
    [
        # Gauss's method, and a method with the weights of Simpson's rule in another order.
        (2, ("b1=1/2", "b2=1/2")),
        (3, ("b1=2/3", "a13=5/24", "a21=5/6", "a23=1/12", "a33=1/12")),
    ],
)
def test_a_fixed_weight_is_a_divisor_as_a_whole(stages: int, fix: tuple[str, ...]) -> None:
    """The formula a_12 = b_2 - b_2 a_21/b_1 needs parentheses if b_1 is a fraction."""
    problem = find_problem("symplectic_rk", 4, Spec(stages, fix=fix), "full")
    ring = LaurentPolynomials(problem.ansatz.free)
    method = problem.ansatz.method(ring.generators, ring)
    assert isinstance(method, RungeKutta)
    assert symplectic(method, ring) is True
    assert infeasible(problem) is None
    assert solve(Order("symplectic_rk", 4, Spec(stages, fix=fix))).solution is not None


def test_an_ansatz_that_is_not_symplectic_proves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    spec = Spec(2, dirk=True)
    assert infeasible(find_problem("symplectic_rk", 3, spec, "full")) is not None
    elimination = import_module("orderconds.solve.elimination")
    monkeypatch.setattr(elimination, "symplectic", lambda method, ring: None)
    assert infeasible(find_problem("symplectic_rk", 3, spec, "full")) is None


def test_the_abscissae_are_exact_for_fixed_weights() -> None:
    problem = find_problem("vcg", 3, Spec(3, fix=("b1=1/3", "b2=2/5")), "abscissae")
    ring = LaurentPolynomials(problem.ansatz.free)
    method = problem.ansatz.method(ring.generators, ring)
    assert isinstance(method, RungeKutta)
    A, b = method.A, method.b
    m = [sum(b[:i], ring.zero) + b[i] * ring.rational(1, 2) for i in range(3)]
    for i in range(3):
        assert ring.is_zero(sum(A[i], ring.zero) - m[i])
        column = sum((b[k] * A[k][i] for k in range(3)), ring.zero)
        assert ring.is_zero(column - b[i] * (ring.one - m[i]))


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
        "the only real solution of b1^3 + b1 = 0 is b1 = 0 (Sturm's theorem), "
        "but the formulas of the family divide by b1"
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
