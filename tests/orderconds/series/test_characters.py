"""Composition, inverse, adjoint, modified equations and substitution, against tableaux and concrete flows."""

import pytest

from orderconds import families
from orderconds.ring import QQ
from orderconds.series.b_series import runge_kutta_series
from orderconds.series.characters import ORDERED, ROOTED, Character, exact_flow
from orderconds.tableau import CommutatorFree, RungeKutta, Stage
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


def in_sequence(one, other):
    """The tableau of one step of ``one`` and then one of ``other``."""
    none = (QQ.zero,) * other.s
    A = [(*row, *none) for row in one.A] + [(*one.b, *row) for row in other.A]
    return RungeKutta(tuple(A), (*one.b, *other.b))


def undoing(method):
    """From y1 back to y0 by the same stages: a_ij - b_j and -b_j."""
    A = tuple(tuple(x - w for x, w in zip(row, method.b, strict=True)) for row in method.A)
    return RungeKutta(A, tuple(-w for w in method.b))


def rows_for(rows, before, after):
    return tuple((QQ.zero,) * before + row + (QQ.zero,) * after for row in rows)


def in_sequence_on_groups(one, other):
    first = one.from_start(one.update)
    stages = [Stage(None, rows_for(one.from_start(s), 0, other.s)) for s in one.stages]
    start = rows_for(first, 0, other.s)
    for stage in (*other.stages, other.update):
        stages.append(Stage(None, start + rows_for(other.from_start(stage), one.s, 0)))
    return CommutatorFree(tuple(stages[:-1]), stages[-1])


def undoing_on_groups(method):
    update = tuple(tuple(-x for x in row) for row in method.from_start(method.update)[::-1])
    stages = tuple(Stage(None, update + method.from_start(stage)) for stage in method.stages)
    return CommutatorFree(stages, Stage(None, update))


def test_composed_b_series_are_those_of_tableaux_in_sequence(random_tableau):
    one, other = random_tableau(2), random_tableau(2)
    assert agree(b_series(one).then(b_series(other)), b_series(in_sequence(one, other)))
    assert not agree(b_series(one).then(b_series(other)), b_series(in_sequence(other, one)), 3)


def test_inverse_b_series_are_those_of_the_tableau_that_undoes_the_step(random_tableau):
    method = random_tableau(3)
    assert agree(b_series(method).inverse(), b_series(undoing(method)))


def test_composed_lie_butcher_series_are_those_of_products_in_sequence(
    random_commutator_free, commutator_free
):
    one, other = random_commutator_free, commutator_free["cf3"]
    both = lie_butcher(in_sequence_on_groups(one, other))
    assert agree(lie_butcher(one).then(lie_butcher(other)), both)
    assert not agree(lie_butcher(other).then(lie_butcher(one)), both, 3)


def test_inverse_lie_butcher_series_are_those_of_the_product_that_undoes_the_step(random_commutator_free):
    method = random_commutator_free
    assert agree(lie_butcher(method).inverse(), lie_butcher(undoing_on_groups(method)))


@pytest.mark.parametrize("algebra", [ROOTED, ORDERED])
def test_steps_form_a_group(algebra, random_tableau):
    make = b_series if algebra is ROOTED else lambda method: lie_butcher(method, "rkmk(1)")
    a, b, c = (make(random_tableau(1)) for _ in range(3))
    identity = Character(QQ, algebra, lambda forest: QQ.zero)
    assert agree(a.then(b).then(c), a.then(b.then(c)), 5)
    assert agree(a.then(a.inverse()), identity, 5)
    assert agree(a.inverse().then(a), identity, 5)


@pytest.mark.parametrize("algebra", [ROOTED, ORDERED])
def test_the_flow_is_a_group_in_time(algebra):
    flow = exact_flow(QQ, algebra)
    assert agree(flow.then(flow), flow.scaled(QQ.rational(2)))
    assert agree(flow.adjoint(), flow)


def test_symmetric_methods_and_no_others_are_their_own_adjoints(tableaux):
    midpoint, euler = tableaux["midpoint"], tableaux["euler"]
    assert agree(b_series(midpoint).adjoint(), b_series(midpoint))
    assert agree(lie_butcher(midpoint, "cg").adjoint(), lie_butcher(midpoint, "cg"))
    assert not agree(b_series(euler).adjoint(), b_series(euler), 2)


# Concrete problems in the plane, interpreted over Q[[h]].
