"""Elementary weights: by definition, over stages and over polynomials in the nodes."""

from __future__ import annotations

import pytest

from orderconds.ring import QQ
from orderconds.series.b_series import ElementaryWeights, StageVectors, Sums, runge_kutta_series, sparse
from orderconds.tableau import Tableau, find
from orderconds.trees import directed
from orderconds.trees.levels import children
from orderconds.trees.rooted import rooted_trees


def stage_weight(matrices, branches, tree, i):
    """tau_tree(i), summed from its definition."""
    result = QQ.one
    for kind, child in branches(tree):
        row = matrices[kind][i]
        result = result * sum(
            (a * stage_weight(matrices, branches, child, j) for j, a in enumerate(row)), QQ.zero
        )
    return result


def weight(matrices, b, branches, tree):
    return sum((x * stage_weight(matrices, branches, tree, i) for i, x in enumerate(b)), QQ.zero)


@pytest.mark.parametrize("vertices", range(1, 7))
def test_runge_kutta_weights_are_the_sums_of_their_definition(vertices, random_tableau):
    method = random_tableau(3)
    series = runge_kutta_series(QQ, method.A, method.b)

    def branches(tree):
        return [(0, child) for child in children(tree)]

    for tree in rooted_trees(vertices):
        assert series(tree) == weight([method.A], method.b, branches, tree)


@pytest.mark.parametrize("vertices", range(1, 6))
def test_weights_with_two_matrices_take_the_matrix_of_each_edge(vertices, random_tableau):
    one, other = random_tableau(2), random_tableau(2)
    series = ElementaryWeights(QQ, (one.A, other.A), one.b, directed.branches)
    for tree in directed.directed_rooted_trees(vertices):
        assert series(tree) == weight([one.A, other.A], one.b, directed.branches, tree)


@pytest.mark.parametrize("name", ["gauss3", "radau2a3", "lobatto3c4"])
def test_polynomials_in_the_nodes_give_the_weights_of_vectors_over_the_stages(name):
    tableau = Tableau.load(find(name))
    method, ring = tableau.method, tableau.ring
    series = runge_kutta_series(ring, method.A, method.b)
    stages = StageVectors(ring, (method.A,), method.b)

    def vector(tree):
        result = stages.one
        for child in children(tree):
            result = stages.multiply(result, stages.apply(0, vector(child)))
        return result

    for n in range(1, 6):
        assert all(series(tree) == stages.weigh(vector(tree)) for tree in rooted_trees(n))


def test_rows_that_begin_with_the_same_weights_share_partial_sums():
    class Weight:
        """A weight that counts its products."""

        products = 0

        def __init__(self, value):
            self.value = value

        def __mul__(self, x):
            Weight.products += 1
            return self.value * x

    weights = [Weight(QQ.rational(n + 1, 3)) for n in range(6)]
    rows = [tuple(enumerate(weights[:n])) for n in range(1, 7)]
    x = [QQ.rational(n * n + 1) for n in range(6)]
    sums = Sums(rows, QQ.zero)(x)
    assert Weight.products == 6  # one for each weight, not 1 + 2 + ... + 6
    assert sums == [sum((w.value * x[j] for j, w in row), QQ.zero) for row in rows]


def test_sparse_rows_leave_out_what_is_known_to_be_zero():
    row = [QQ.zero, QQ.rational(2), QQ.zero, QQ.rational(-1)]
    assert sparse(QQ, row) == ((1, 2), (3, -1))
