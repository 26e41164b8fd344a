"""Polynomials in the nodes: the same weights as stage by stage in the number field."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import arb, fmpq

from orderconds.checking import read
from orderconds.families.elementary_weights import conjugate
from orderconds.ring import QQ
from orderconds.ring.nodal import nodal_algebra, simplest
from orderconds.ring.precision import precision
from orderconds.series.b_series import ElementaryWeights, StageVectors
from orderconds.tableau import RungeKutta, Tableau
from orderconds.trees.directed import branches, directed_rooted_trees


@pytest.mark.parametrize(
    "name", ["gauss2", "gauss3", "radau1a3", "radau2a3", "lobatto3c4", "lobatto3b4", "lobatto3d4"]
)
def test_weights_are_those_of_vectors_over_the_field(name: str) -> None:
    tableau = read(name)
    method, ring = tableau.method, tableau.ring
    assert isinstance(method, RungeKutta)
    matrices = (method.A, conjugate(method.A, method.b))
    algebra = nodal_algebra(ring, matrices, method.b)
    assert algebra is not None
    quick = ElementaryWeights(ring, matrices, method.b, branches)
    slow = ElementaryWeights(ring, matrices, method.b, branches)
    slow._stages, slow._rational = StageVectors(ring, matrices, method.b), False
    for tree in (tree for n in range(1, 6) for tree in directed_rooted_trees(n)):
        assert quick(tree) == slow(tree)


@pytest.mark.parametrize("name", ["crouzeix3", "alexander2", "triple_jump", "rk4"])
def test_methods_whose_nodes_are_not_all_the_roots_of_a_polynomial_are_left(name: str) -> None:
    tableau = read(name)
    method = tableau.abelian()
    assert nodal_algebra(tableau.ring, (method.A,), method.b) is None


def test_rational_nodes_are_not_enough() -> None:
    # c = (1, 2) is rational, A is not.
    text = 'name = "m"\nfamily = "rk"\nA = [["sqrt(2)", "1 - sqrt(2)"], ["1", "1"]]\nb = ["1/2", "1/2"]'
    tableau = Tableau.loads(text)
    method = tableau.method
    assert nodal_algebra(tableau.ring, (method.A,), method.b) is None
    weights = Tableau.loads(
        text.replace('["sqrt(2)", "1 - sqrt(2)"]', '["1", "0"]').replace('["1/2"', '["sqrt(2)"')
    )
    assert nodal_algebra(weights.ring, (weights.method.A,), weights.method.b) is None


def test_equal_nodes_do_not_tell_stages_apart() -> None:
    text = 'name = "m"\nfamily = "rk"\nA = [["sqrt(2)", "1 - sqrt(2)"], ["0", "1"]]\nb = ["1/2", "1/2"]'
    tableau = Tableau.loads(text)
    assert nodal_algebra(tableau.ring, (tableau.method.A,), tableau.method.b) is None


def test_a_rational_tableau_stays_as_it_is() -> None:
    assert nodal_algebra(QQ, ([[QQ.one]],), [QQ.one]) is None


@pytest.mark.parametrize("text", ["0", "-3", "22/7", "-123456789/987654321", "1/1000003"])
def test_the_simplest_number_in_a_narrow_ball_is_the_one_it_was_made_of(text: str) -> None:
    q = fmpq(*Fraction(text).as_integer_ratio())
    with precision(200):
        assert simplest(arb(q) + arb(0, 1e-40)) == q
        assert simplest(arb(q)) == q
