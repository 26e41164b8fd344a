"""Relations of dependent action conditions: over Q at methods they were not found from, and at the flow."""

from __future__ import annotations

from fractions import Fraction
from math import prod

import numpy as np
import pytest
from flint import fmpq

from orderconds.families import get
from orderconds.ring import QQ, Residues
from orderconds.ring.rank import pivot_columns
from orderconds.series.action_counts import tree_counts
from orderconds.series.monomials import products
from orderconds.tableau import CommutatorFree, RungeKutta, Stage

FAMILIES = ("vcg", "vcf", "vrkmk(0)", "vrkmk(1)", "vrkmk(2)", "vrkmk")
FRESH = 1073741789  # the largest prime below 2^30, not one that the sets and relations are found with


@pytest.fixture
def method(random_tableau, random_commutator_free):
    return {name: random_commutator_free if name == "vcf" else random_tableau(4) for name in FAMILIES}


@pytest.mark.parametrize("name", FAMILIES)
def test_relations_hold_exactly_at_random_rational_methods_and_at_the_flow(method, name):
    family = get(name)
    for order in range(1, 5):
        conditions = family.all_conditions(order)
        lower = [c for n in range(1, order) for c in family.conditions(n)]
        known = [*lower, *conditions]
        values = dict(zip((c.key for c in known), family.evaluate(method[name], QQ, known), strict=True))
        exact = {c.key: c.rhs for c in known}
        for tree, polynomial in family.relations(order).items():
            right = [(fmpq(q.numerator, q.denominator), trees) for q, trees in polynomial]
            assert values[tree] == sum(
                (q * prod((values[t] for t in ts), start=1) for q, ts in right), QQ.zero
            )
            assert exact[tree] == sum(
                q * prod((exact[t] for t in ts), start=Fraction(1)) for q, ts in polynomial
            )


@pytest.mark.parametrize("name", FAMILIES)
def test_a_condition_has_a_relation_unless_it_is_independent(name):
    family = get(name)
    for order in range(1, 5):
        independent = {c.key for c in family.conditions(order)}
        assert {c.key for c in family.all_conditions(order) if c.relation is None} == independent
        assert all(c.relation is None for c in family.conditions(order))


def test_relations_are_spelled_with_the_trees_of_the_conditions_as_printed():
    told = {c.tree: c.relation for n in (2, 3, 4) for c in get("vcg").all_conditions(n)}
    assert told["o(|L(o))"] == "1/2 <o> <o>"
    assert told["o(|L(o(o)))"] == "-<o(o|L(o))> + <o> <o(o)>"
    assert told["o(o|L(o(|L(o))))"] == "-<o(o|L(o) L(o))> + 3 <o(o|L(o o))>"


def test_vcg_has_three_relations_of_order_four_more_than_vcf():
    """They follow from psi_{L(H|L)} = 3 psi_{L(HH)} - psi_{L(H)}^2."""
    vcg, vcf = ({c.tree: c.relation for c in get(name).all_conditions(4)} for name in ("vcg", "vcf"))
    assert {tree: told for tree, told in vcg.items() if told and vcf[tree] is None} == {
        "o(|L(o) L(o(o)))": "<o(o|L(o) L(o))> - 3 <o(o|L(o o))> + 1/2 <o> <o> <o(o)>",
        "o(|L(o) L(o o))": "1/3 <o(|L(o) L(o) L(o))> + 1/24 <o> <o> <o> <o>",
        "o(|L(o) L(o(|f(*))))": "<o(|f(*) L(o) L(o))> - 3 <o(|f(*) L(o o))> + 1/2 <o> <o> <o(o)>",
    }


@pytest.mark.parametrize(("name", "highest"), [("vcg", 5), ("vcf", 4), ("vrkmk", 5), ("vrkmk(1)", 3)])
def test_independence_is_proved_modulo_another_prime(name, highest):
    """With all products of lower ones: monomials of each degree have full rank at random methods."""
    family, ring, generator = get(name), Residues(FRESH, 240), np.random.default_rng(5)

    def row(length=4):
        return tuple(ring.random(generator) for _ in range(length))

    method = (
        random_commutator_free_rows(row)
        if name == "vcf"
        else RungeKutta(tuple(row() for _ in range(4)), row())
    )
    graded = []
    for order in range(1, highest + 1):
        values = family.evaluate(method, ring, family.conditions(order))
        graded += [(order, x) for x in values]
        monomials = list(products(graded, order))
        assert len(pivot_columns(monomials)) == len(monomials)


def random_commutator_free_rows(row):
    stages = tuple(Stage(None, (row(), row())) for _ in range(4))
    return CommutatorFree(stages, Stage(None, (row(), row(), row())))


def test_vcf_has_as_many_independent_conditions_as_there_are_elementary_hamiltonians():
    counts = tuple(len(get("vcf").conditions(n)) for n in range(1, 6))
    assert counts == tree_counts(5)
