"""Constraints and structures: what the spelled coefficients satisfy, whatever the free ones are."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq

from orderconds import solve
from orderconds.errors import InputError
from orderconds.families.elementary_weights import conjugate
from orderconds.ring import QQ
from orderconds.ring.laurent import LaurentPolynomials
from orderconds.solve.linear import Elimination, equality
from orderconds.solve.parametrise import ansatz
from orderconds.solve.spec import Spec
from orderconds.tableau import Tableau, find
from orderconds.tableau.method_properties import diagonally_implicit, explicit, fsal, symmetric, symplectic


def member(family: str, spec: Spec, structure: str = "full"):
    """Return a method of the ansatz with rational numbers for its free coefficients."""
    found = ansatz(family, spec, structure)
    return found.method([fmpq(3 * k + 2, 7 + (k * k) % 5) for k in range(len(found.free))], QQ)


@pytest.mark.parametrize("s", [1, 2, 3, 4])
def test_symmetric_tableaux_are_symmetric(s: int) -> None:
    assert symmetric(member("rk", Spec(s, symmetric=True)), QQ) is True


def test_explicit_and_fsal_tableaux_are_that() -> None:
    method = member("rk", Spec(4, explicit=True, fsal=True))
    assert explicit(method, QQ) is True
    assert fsal(method, QQ) is True


@pytest.mark.parametrize("s", [2, 3, 4])
def test_the_three_abscissae_agree(s: int) -> None:
    method = member("vcg", Spec(s), "abscissae")
    b, chat = method.b, [sum(row) for row in conjugate(method.A, method.b)]
    times = [sum(b[:i], fmpq(0)) + b[i] / 2 for i in range(s)]
    assert list(method.c) == times
    assert chat == times


def test_the_three_abscissae_agree_for_commutator_free_methods() -> None:
    method = member("vcf", Spec(3, exponentials=3, inner=2), "abscissae")
    total = method.as_runge_kutta(QQ)
    y = [sum(row) for row in method.update.exponentials]
    for i in range(3):
        later = sum(
            row[i] * (y[J] / 2 + sum(y[J + 1 :], fmpq(0))) for J, row in enumerate(method.update.exponentials)
        )
        assert total.c[i] == 1 - later / total.b[i]
    assert [sum(row) for row in conjugate(total.A, total.b)] == list(total.c)


@pytest.mark.parametrize(("s", "m", "inner"), [(2, 2, 2), (3, 2, 2), (3, 3, 3), (4, 4, 3)])
def test_symmetric_paths_reach_a_stage_from_either_end(s: int, m: int, inner: int) -> None:
    method = member("vcf", Spec(s, symmetric=True, exponentials=m, inner=inner), "symmetric")

    def bar(row):
        return tuple(-x for x in row[::-1])

    def reduced(rows):
        """Cancel and merge neighbours that are multiples of each other."""
        found = []
        for row in rows:
            if found and parallel(found[-1], row):
                merged = tuple(x + y for x, y in zip(found.pop(), row, strict=True))
                if any(merged):
                    found.append(merged)
            else:
                found.append(row)
        return found

    def parallel(x, y):
        return all(x[i] * y[j] == x[j] * y[i] for i in range(s) for j in range(s))

    update = method.update.exponentials
    assert tuple(tuple(row[::-1]) for row in update[::-1]) == update
    for i in range(s):
        seen = reduced([*update, *map(bar, method.stages[s - 1 - i].exponentials)])
        assert seen == reduced(method.stages[i].exponentials)


def test_a_fixed_node_is_the_sum_of_its_row() -> None:
    found = solve("rk", stages=3, order=3, explicit=True, fix=["c2=1/2", "c3=1"]).tableau
    assert ((0, 0, 0), (Fraction(1, 2), 0, 0), (-1, 2, 0)) == found.A
    # b2 c2 = 1/2, so the node and the weight are equal to the root of 1/2.
    equal = solve("rk", stages=2, order=2, explicit=True, fix=["c2 = b2"]).tableau
    assert equal.c[1] == equal.b[1]
    assert abs(float(equal.c[1]) ** 2 - 0.5) < 1e-12
    with pytest.raises(InputError, match="contradicts"):
        solve("rk", stages=2, order=2, explicit=True, fix=["c1=1/2"])


def test_a_fixed_entry_may_depend_on_others() -> None:
    found = ansatz("rk", Spec(2, fix=("a21 = 2*b1 - 1/3", "b2 = 1 - b1")))
    assert "a21" not in found.free
    assert found.numbers["a21"] == "-1/3 + 2*b1"


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (Spec(2, fix=("a21=1/2", "a21=1/3")), "contradicts"),
        (Spec(2, explicit=True, fix=("a12=1",)), "contradicts"),
        (Spec(2, fix=("a31=1",)), "unknown coefficient 'a31'"),
        (Spec(2, fix=("a21",)), "linear equation"),
        (Spec(2, fix=("a21=b1*b2",)), "not linear"),
        (Spec(2, fix=("a21=1/0",)), "not linear"),
        (Spec(2, fix=("a21=",)), "linear equation"),
        (Spec(0), "0 stages"),
        (Spec(2, rkn=True), "--rkn"),
    ],
)
def test_wishes_that_make_no_sense_are_refused(spec: Spec, said: str) -> None:
    with pytest.raises(InputError) as problem:
        ansatz("rk", spec)
    assert said in str(problem.value)


def test_a_contradiction_names_exactly_the_constraints_that_cause_it() -> None:
    def said(spec: Spec) -> str:
        with pytest.raises(InputError) as problem:
            ansatz("rk", spec)
        return str(problem.value.found)

    assert said(Spec(2, fix=("b1=b1+1",))) == "'--fix b1=b1+1' does not hold for any coefficients"
    fix = ("a21=1", "b1=1", "b2=0", "c2=2")
    expected = "'--fix c2=2' contradicts '--explicit (a22 = 0)', '--fix a21=1'"
    assert said(Spec(2, explicit=True, fix=fix)) == expected
    fix = ("b1=b2", "a21=b1", "a12=a21-b2+1", "a12=2")
    expected = "'--fix a12=2' contradicts '--fix b1=b2', '--fix a21=b1', '--fix a12=a21-b2+1'"
    assert said(Spec(2, fix=fix)) == expected
    # Here b1=b2 is not needed for the contradiction, although the formula of a21 uses it.
    fix = ("b1=b2", "a21=b1", "a12=a21-b1+1", "a12=2")
    expected = "'--fix a12=2' contradicts '--fix a21=b1', '--fix a12=a21-b1+1'"
    assert said(Spec(2, fix=fix)) == expected


@pytest.mark.parametrize(
    ("family", "fix"),
    [
        ("vcg", ("b2=0",)),
        ("vcg", ("b1=b2-1", "b2=1")),
        ("vcf", ("b1_2=0", "b2_2=0")),
        ("vcf", ("b1_2=1-b2_2-1",)),
        ("symplectic_rk", ("b2=0",)),
    ],
)
def test_a_zero_weight_is_refused_if_formulas_divide_by_it(family: str, fix: tuple[str, ...]) -> None:
    with pytest.raises(InputError, match=r"the constraints imply b[12] = 0; expected nonzero weights"):
        solve(family, order=2, stages=2, fix=fix, starts=64)


def test_elimination_keeps_every_constraint() -> None:
    names = ("x", "y", "z")
    found = Elimination(names)
    constraints = [equality("x + y + z = 1"), equality("x - 2*z = 1/2")]
    found.impose(constraints)
    R = LaurentPolynomials(list(found.free))
    value = dict(zip(found.free, R.generators, strict=True))

    def cell(name):
        form = found.cell(name)
        q = form.get("", Fraction(0))
        terms = [R.rational(x.numerator, x.denominator) * value[n] for n, x in form.items() if n]
        return sum(terms, R.rational(q.numerator, q.denominator))

    x, y, z = map(cell, names)
    assert R.is_zero(x + y + z - 1)
    assert R.is_zero(x - z * 2 - R.rational(1, 2))


@pytest.mark.parametrize(("s", "m", "inner"), [(2, 2, 2), (3, 3, 3), (4, 4, 3), (5, 4, 3)])
def test_symmetric_methods_can_have_the_right_abscissae_as_well(s: int, m: int, inner: int) -> None:
    spec = Spec(s, symmetric=True, exponentials=m, inner=inner)
    method = member("vcf", spec, "symmetric abscissae")
    total, update = method.as_runge_kutta(QQ), method.update.exponentials
    y = [sum(row) for row in update]
    for i in range(s):
        later = sum(row[i] * (y[J] / 2 + sum(y[J + 1 :], fmpq(0))) for J, row in enumerate(update))
        assert total.c[i] == 1 - later / total.b[i]
    assert [sum(row) for row in conjugate(total.A, total.b)] == list(total.c)


def test_exponents_may_sum_to_the_gauss_tableau() -> None:
    gauss = Tableau.load(find("gauss2"))
    found = ansatz("vcf", Spec(2, symmetric=True), "symmetric gauss")
    tableau = Tableau.loads(found.text(dict.fromkeys(found.free, "1/7")))
    total, known = tableau.abelian(), gauss.method
    text = tableau.ring.text
    assert [text(x) for x in total.b] == [gauss.ring.text(x) for x in known.b]
    assert [[text(x) for x in row] for row in total.A] == [
        [gauss.ring.text(x) for x in row] for row in known.A
    ]


def test_the_nodes_of_diagonally_implicit_symplectic_methods_can_be_fixed() -> None:
    # These methods are compositions of midpoint rules: a_ij = b_j for j < i, and a_ii = b_i/2.
    method = member("symplectic_rk", Spec(3, dirk=True, fix=("c2=1/2",)))
    assert method.c[1] == fmpq(1, 2)
    assert symplectic(method, QQ) is True
    assert diagonally_implicit(method, QQ) is True


@pytest.mark.parametrize(
    ("family", "spec", "message"),
    [
        ("splitting(3)", Spec(2), "methods of family 'splitting(3)' cannot be searched"),
        ("rk", Spec(2, explicit=True, fix=("a21=5",), size=Fraction(1)), "the constraints imply a21 = 5"),
        ("splitting", Spec(2, fix=("a1=5", "a2=1/2"), size=Fraction(9, 2)), "imply a1 = 5"),
        ("symplectic_rk", Spec(2, fix=("a12=a21",)), "the constraints determine both a12 and a21"),
    ],
)
def test_a_search_that_makes_no_sense_is_refused(family: str, spec: Spec, message: str) -> None:
    with pytest.raises(InputError) as refused:
        ansatz(family, spec)
    assert message in str(refused.value)


def test_explicit_is_stronger_than_diagonally_implicit() -> None:
    """In an explicit commutator-free method, stage i has no coefficient of stage i."""
    free = ansatz("cf", Spec(2, explicit=True, dirk=True, inner=1)).free
    assert [name for name in free if name[0] == "a"] == ["a2_1_1"]


def test_a_symmetric_commutator_free_method_may_be_diagonally_implicit() -> None:
    free = ansatz("cf", Spec(2, symmetric=True, dirk=True), "symmetric").free
    assert not [name for name in free if name.startswith("a1_") and name.endswith("_2")]


def test_a_nystroem_splitting_can_be_searched_by_the_name_of_its_family() -> None:
    assert 'rkn = "V"' in ansatz("rkn", Spec(2)).body
    assert 'rkn = "V"' not in ansatz("splitting", Spec(2)).body


@pytest.mark.parametrize(
    ("family", "spec", "expected"),
    [
        ("symplectic_rk", Spec(2, fix=("a11=0", "b1=1/2")), "symplecticity with nonzero weights"),
        ("composition", Spec(3, fix=("g1=1/3", "g3=1/2")), "step sizes that form a palindrome"),
        ("symplectic_rk", Spec(2, fix=("b2=0",)), "nonzero weights"),
    ],
)
def test_a_contradiction_names_the_assumptions(family: str, spec: Spec, expected: str) -> None:
    with pytest.raises(InputError) as refused:
        ansatz(family, spec)
    assert expected in str(refused.value)
