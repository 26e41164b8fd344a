"""Family vcg: Proposition 3.5.7, counts of independent conditions, printed sums, orders."""

from __future__ import annotations

import numpy as np
import pytest
from flint import fmpq

from orderconds.errors import ZeroWeight
from orderconds.families import get
from orderconds.ring import QQ, Residues
from orderconds.ring.laurent import LaurentPolynomials
from orderconds.ring.rank import pivot_columns
from orderconds.series.action import CommutatorFreeSeries, crouch_grossman_rows
from orderconds.series.action_enumeration import velocities
from orderconds.series.action_rank import independent_trees
from orderconds.series.action_trees import transport, velocity
from orderconds.tableau import Tableau
from orderconds.tableau.library import find
from orderconds.tableau.methods import RungeKutta
from tests.oracles.index_sums import runge_kutta_value

VCG = get("vcg")


def butcher(rows, weights):
    s = len(weights)
    full = [[*row, *["0"] * (s - len(row))] for row in rows]
    exact = [tuple(fmpq(*map(int, x.split("/"))) for x in row) for row in (*full, weights)]
    return RungeKutta(tuple(exact[:-1]), exact[-1])


def composition(*gamma):
    """Composed implicit midpoints as a tableau (Lemma 3.5.4)."""
    return Tableau.loads(
        'name = "composition"\nfamily = "composition"\nbase = "symmetric-2"\ngamma = ['
        + ", ".join(f'"{g}"' for g in gamma)
        + ']\nsource = "test"\n[numbers]\ng = "1/(2-2^(1/3))"\n'
    )


MIDPOINT = butcher([["1/2"]], ["1"])
KUTTA3 = butcher([[], ["1/2"], ["-1", "2"]], ["1/6", "2/3", "1/6"])
RK4 = butcher([[], ["1/2"], ["0", "1/2"], ["0", "0", "1"]], ["1/6", "1/3", "1/3", "1/6"])


def failing(method, order, ring=QQ):
    conditions = VCG.all_conditions(order)
    return [
        c
        for c, r in zip(conditions, VCG.residuals(method, ring, conditions), strict=True)
        if not ring.is_zero(r)
    ]


def order_of(method, highest, ring=QQ):
    for order in range(1, highest + 1):
        if failing(method, order, ring):
            return order - 1
    return highest


def random_tableau(ring, stages, seed):
    generator = np.random.default_rng(seed)
    rows = [[ring.random(generator) for _ in range(stages)] for _ in range(stages + 1)]
    return rows[:-1], rows[-1]


def test_independent_conditions_number_1_1_6_25_139():
    assert [len(VCG.conditions(n)) for n in range(1, 6)] == [1, 1, 6, 25, 139]


def test_order_three_prints_proposition_3_5_7_up_to_lower_orders():
    assert [str(c) for c in VCG.conditions(3)] == [
        "sum_i b_i c_i^2 = 1/3",
        "sum_{i,j} b_i a_ij c_j = 1/6",
        "sum_i b_i c_i (sum_{j>i} b_j + 1/2 b_i) = 1/6",
        "sum_i b_i^-1 (sum_j b_j a_ji)^2 = 1/3",
        "sum_{i,j} b_j a_ji (sum_{k>i} b_k + 1/2 b_i) = 1/3",
        "sum_i b_i (sum_{j>i} b_j + 1/2 b_i)^2 = 1/3",
    ]


def printed_proposition(ring, A, b):
    """The six left-hand sides of Proposition 3.5.7, made homogeneous where it uses sum b = 1."""
    stages = range(len(b))
    c = [sum(row, ring.zero) for row in A]
    chat = [sum((b[j] - b[j] * A[j][i] / b[i] for j in stages), ring.zero) for i in stages]
    before = [sum((b[j] for j in range(i)), b[i] / 2) for i in stages]
    return [
        sum((b[i] * c[i] * c[i] for i in stages), ring.zero),
        sum((b[i] * A[i][j] * c[j] for i in stages for j in stages), ring.zero),
        sum((b[i] * c[i] * before[i] for i in stages), ring.zero),
        sum((b[i] * chat[i] * chat[i] for i in stages), ring.zero),
        sum((b[i] * chat[i] * before[i] for i in stages), ring.zero),
        sum((b[i] * b[i] * b[i] for i in stages), ring.zero),
    ]


def test_derived_and_printed_order_three_span_the_same_space_modulo_products():
    ring = Residues(samples=40)
    A, b = random_tableau(ring, 3, 7)
    derived = list(VCG.evaluate(RungeKutta(A, b), ring, VCG.conditions(3)))
    first, second = (VCG.evaluate(RungeKutta(A, b), ring, VCG.conditions(n))[0] for n in (1, 2))
    products = [first * first * first, first * second]
    printed = printed_proposition(ring, A, b)
    ranks = [len(pivot_columns([*products, *extra])) for extra in (derived, printed, derived + printed)]
    assert ranks == [8, 8, 8]


def test_more_stages_find_no_more_conditions():
    for stages in (2, 3, 4):
        # random_series takes the order and makes one stage less
        found = independent_trees(lambda ring, g, s=stages: VCG.random_series(ring, g, s + 1), 4)
        assert [len(trees) for trees in found] == ([1, 1, 6, 22] if stages == 2 else [1, 1, 6, 25])


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_printed_sums_are_what_the_engine_computes(order):
    entries = iter(fmpq(3 * k % 17 - 8, k % 5 + 1) for k in range(1, 40))
    A = [[next(entries) for _ in range(3)] for _ in range(3)]
    b = [fmpq(2, 3), fmpq(-1, 4), fmpq(5, 7)]
    conditions = VCG.all_conditions(order) if order < 4 else VCG.all_conditions(4)[::7]
    values = VCG.evaluate(RungeKutta(A, b), QQ, conditions)
    for condition, value in zip(conditions, values, strict=True):
        assert runge_kutta_value(condition.formula, QQ, A, b) == value, condition


def test_midpoint_has_order_two_and_kutta_drops_to_two():
    assert order_of(MIDPOINT, 4) == 2
    assert order_of(KUTTA3, 4) == 2
    assert order_of(RK4, 4) == 2


def test_order_conditions_hold_for_every_tree_once_the_independent_ones_hold():
    # The midpoint fails at order 3, and already among the independent conditions.
    assert {c.tree for c in VCG.conditions(3)} & {c.tree for c in failing(MIDPOINT, 3)}


def test_a_zero_weight_is_refused_by_name():
    with pytest.raises(ZeroWeight, match="b_2 = 0"):
        VCG.evaluate(butcher([[], ["1"]], ["1", "0"]), QQ, VCG.all_conditions(1))


def test_zero_coefficients_left_out_change_nothing():
    rows = crouch_grossman_rows(QQ, KUTTA3.A, KUTTA3.b)
    assert [len(row) for row in rows] == [0, 1, 2, 3]
    full = tuple(tuple(((j, x),) for j, x in enumerate(row)) for row in (*KUTTA3.A, KUTTA3.b))
    trees = [c.key for n in (1, 2, 3) for c in VCG.all_conditions(n)]
    sparse, dense = CommutatorFreeSeries(QQ, rows), CommutatorFreeSeries(QQ, full)
    assert [sparse.condition(t) for t in trees] == [dense.condition(t) for t in trees]


def test_triple_jump_has_order_exactly_four_over_its_number_field():
    tableau = composition("g", "1-2*g", "g")
    method = tableau.read_as(VCG.formats)
    assert order_of(method, 5, tableau.ring) == 4


def test_triple_jump_with_a_wrong_middle_step_loses_its_order():
    tableau = composition("g", "1-2*g", "g")
    method = tableau.read_as(VCG.formats)
    nudged = RungeKutta(method.A, (*method.b[:2], method.b[2] + tableau.ring.rational(5, 10**11)))
    assert order_of(nudged, 2, tableau.ring) == 0


@pytest.mark.parametrize("stages", [2, 3])
def test_gauss_tableaux_stay_at_order_two(stages):
    tableau = Tableau.load(find(f"gauss{stages}"))
    assert order_of(tableau.method, 3, tableau.ring) == 2


def test_compositions_of_midpoints_have_1_0_1_1_independent_conditions():
    def random(ring, generator, stages=5):
        gamma = [ring.random(generator) for _ in range(stages)]
        half = ring.rational(1, 2)
        A = [[*gamma[:i], gamma[i] * half, *[ring.zero] * (stages - i - 1)] for i in range(stages)]
        return CommutatorFreeSeries(ring, crouch_grossman_rows(ring, A, gamma))

    assert [len(trees) for trees in independent_trees(random, 4)] == [1, 0, 1, 1]


def test_three_conditions_of_order_four_are_lost_by_one_identity():
    """psi_{L(H|L)} = 3 psi_{L(HH)} - psi_{L(H)}^2, H the leaf and H|L the leaf with a transported leg."""
    leaf = velocity()
    series = CommutatorFreeSeries(QQ, crouch_grossman_rows(QQ, RK4.A, RK4.b))
    single, double = series.psi(transport((leaf,))), series.psi(transport((leaf, leaf)))
    nested = series.psi(transport((velocity((), (transport((leaf,)),)),)))
    assert nested == [3 * y - x * x for x, y in zip(single, double, strict=True)]


def test_trees_without_momenta_have_the_values_of_crouch_grossman():
    lie_butcher = get("cg").series(KUTTA3, QQ)
    series = VCG.series(KUTTA3, QQ)

    def levels(tree, level=0):
        return bytes([level]) + b"".join(levels(t, level + 1) for t in tree.word)

    def without_momenta(tree):
        return not tree.momenta and all(map(without_momenta, tree.word))

    plain = [t for n in range(1, 6) for t in velocities(n) if without_momenta(t)]
    assert len(plain) == 1 + 1 + 2 + 5 + 14
    assert [series.condition(t) for t in plain] == [lie_butcher(levels(t)) for t in plain]


def test_the_engine_runs_over_symbols_that_may_be_divided_by():
    ring = LaurentPolynomials(["a11", "b1"])
    a, b = ring.generators
    conditions = VCG.conditions(3)
    values = VCG.evaluate(RungeKutta(((a,),), (b,)), ring, conditions)
    assert [ring.text(x) for x in values[:4]] == ["a11^2*b1"] * 2 + ["1/2*a11*b1^2", "a11^2*b1"]


@pytest.mark.slow
def test_order_six_has_800_independent_conditions():
    assert [len(VCG.conditions(n)) for n in (5, 6)] == [139, 800]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["triple_jump6", "yoshida6"])
def test_sixth_order_compositions_have_order_exactly_six(name):
    tableau = Tableau.load(find(name))
    method = tableau.read_as(VCG.formats)
    ring = tableau.ring
    for order in range(1, 7):
        conditions = VCG.decisive_conditions(order)
        assert not any(ring.is_zero(r) is False for r in VCG.residuals(method, ring, conditions))
    first = VCG.decisive_conditions(7)[:20]
    assert any(ring.is_zero(r) is False for r in VCG.residuals(method, ring, first))
