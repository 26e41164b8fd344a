"""Substitution of one field in another: the law of substitution, and modifying fields."""

import pytest

from orderconds import families
from orderconds.ring import QQ
from orderconds.series.b_series import runge_kutta_series
from orderconds.series.characters import ORDERED, ROOTED, Character, exact_flow
from orderconds.series.modified_equations import modified_field
from orderconds.series.substitution import partitions, substituted
from orderconds.trees.ordered import ordered_forests
from orderconds.trees.rooted import rooted_trees

ORDER = 6


MEMBERS = {ROOTED: rooted_trees, ORDERED: ordered_forests}


def b_series(method):
    return Character(QQ, ROOTED, runge_kutta_series(QQ, method.A, method.b))


def lie_butcher(method, name="cf"):
    return Character(QQ, ORDERED, families.get(name).series(method, QQ))


def agree(one, other, order=ORDER):
    members = MEMBERS[one.algebra]
    return all(one(t) == other(t) for n in range(1, order + 1) for t in members(n))


@pytest.mark.parametrize("algebra", [ROOTED, ORDERED])
def test_the_modified_field_substituted_in_the_flow_is_the_method(algebra, random_tableau):
    method = random_tableau(2)
    step = b_series(method) if algebra is ROOTED else lie_butcher(method, "cg")
    assert agree(substituted(modified_field(step), exact_flow(QQ, algebra)), step, 5)


@pytest.mark.parametrize("algebra", [ROOTED, ORDERED])
def test_substitution_distributes_over_composition(algebra, random_tableau):
    first, second, third = random_tableau(1), random_tableau(1), random_tableau(2)
    make = b_series if algebra is ROOTED else lambda method: lie_butcher(method, "cg")
    field = modified_field(make(third))
    together = substituted(field, make(first).then(make(second)))
    assert agree(together, substituted(field, make(first)).then(substituted(field, make(second))), 5)


def test_every_set_of_edges_parts_a_tree():
    for tree in rooted_trees(6):
        found = partitions(tree)
        assert len(found) == 2**5
        assert all(sum(map(len, pieces)) == 6 and len(pieces) == len(rest) for pieces, rest in found)
