"""Relations of dependent conditions, read back from their text, hold for random methods and for the flow."""

import re
from math import prod

import pytest

from orderconds import families
from orderconds.ring import QQ
from orderconds.tableau import PartitionedRungeKutta, RungeKutta


def evaluated(relation, values):
    """The value of a printed polynomial, ``<tree>`` replaced by its value."""
    result = 0
    for sign, factor, trees in re.findall(r"(^-?|[+-] )([\d/]+ )?((?:<[^>]*> ?)+)", relation):
        number = QQ.rational(*map(int, (factor or "1").strip().split("/")))
        product = prod((values[tree] for tree in re.findall(r"<([^>]*)>", trees)), start=number)
        result = result - product if "-" in sign else result + product
    return result


def symplectic(method):
    A = [list(row) for row in method.A]
    for i, x in enumerate(method.b):
        A[i][i] = x / 2
        for j in range(i):
            A[i][j] = method.b[j] - method.b[j] * A[j][i] / x
    return RungeKutta(tuple(map(tuple, A)), method.b)


def symplectic_pair(first, second):
    A, b, weights = first.A, first.b, second.b
    stages = range(first.s)
    hats = tuple(tuple(weights[j] - weights[j] * A[j][i] / b[i] for j in stages) for i in stages)
    return PartitionedRungeKutta(A, b, hats, weights)


@pytest.mark.parametrize(
    ("name", "order"),
    [("symplectic_rk", 7), ("sprk", 5), ("sprk_separable", 6), ("cg", 6), ("rkmk(2)", 5), ("rk", 5)],
)
def test_relations_hold_for_methods_and_for_the_exact_flow(name, order, random_tableau):
    family, method = families.get(name), random_tableau(2)
    if name == "symplectic_rk":
        method = symplectic(method)
    if name == "sprk_separable":
        method = symplectic_pair(method, random_tableau(2))
    values, exact, dependent = {}, {}, 0
    for n in range(1, order + 1):
        conditions = family.all_conditions(n)
        found = family.evaluate(method, QQ, conditions)
        values |= {c.tree: x for c, x in zip(conditions, found, strict=True)}
        exact |= {c.tree: QQ.rational(c.rhs.numerator, c.rhs.denominator) for c in conditions}
        independent = {c.tree for c in family.conditions(n)}
        for condition in conditions:
            assert (condition.relation is None) == (condition.tree in independent)
            if condition.relation is not None:
                dependent += 1
                assert evaluated(condition.relation, values) == values[condition.tree]
                assert evaluated(condition.relation, exact) == exact[condition.tree]
    assert (dependent > 0) == (name != "rk")


def test_relations_do_not_hold_for_methods_outside_the_family(random_tableau):
    family, method = families.get("symplectic_rk"), random_tableau(2)
    conditions = [c for n in (1, 2) for c in family.all_conditions(n)]
    values = dict(zip((c.tree for c in conditions), family.evaluate(method, QQ, conditions), strict=True))
    assert evaluated(conditions[1].relation, values) != values["[.]"]


def test_relations_name_independent_conditions_only():
    family = families.get("cg")
    independent = {c.tree for n in range(1, 6) for c in family.conditions(n)}
    for condition in family.all_conditions(5):
        assert set(re.findall(r"<([^>]*)>", condition.relation or "")) <= independent


def test_a_printed_polynomial_reads_back():
    values = {"a b": QQ.rational(2), "c": QQ.rational(3)}
    assert evaluated("-<a b> + 1/2 <c> <c> - 3 <c>", values) == QQ.rational(-13, 2)
