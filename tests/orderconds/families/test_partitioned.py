"""Families on coloured, free and alternating trees: counts, independence, published pairs, local error."""

import numpy as np
import pytest

from orderconds import families
from orderconds.checking import check
from orderconds.errors import InputError, TableauError
from orderconds.ring import QQ, PowerSeries, Residues
from orderconds.ring.rank import pivot_columns
from orderconds.ring.residues import PRIMES
from orderconds.series.monomials import products
from orderconds.tableau import PartitionedRungeKutta, RungeKutta, Tableau, dumps, find
from tests.oracles.index_sums import value

COUNTS = {
    "prk": [2, 4, 14, 52, 214, 916],
    "prk_same_weights": [1, 2, 7, 26, 107, 458],
    "symplectic_rk": [1, 0, 1, 1, 3, 4, 11, 19, 47, 97],
    "sprk": [1, 1, 3, 8, 27, 91, 350, 1376],
    "sprk_separable": [2, 1, 2, 3, 6, 10, 22, 42],
    "rk": [1, 1, 2, 4, 9, 20, 48, 115, 286, 719, 1842, 4766],
    "cg": [1, 1, 3, 8, 25, 75, 245, 800, 2700],
    "cf": [1, 1, 3, 8, 25, 75, 245, 800, 2700],
    "rkmk": [1, 1, 3, 8, 25, 75, 245, 800, 2700],
}

VERLET = find("stormer_verlet").read_text(encoding="utf-8")
RUTH = find("ruth3_pair").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", COUNTS)
def test_conditions_are_as_many_as_the_literature_counts(name):
    family = families.get(name)
    found = [len(family.conditions(n)) for n in range(1, len(COUNTS[name]) + 1)]
    assert found == COUNTS[name]


def test_stormer_verlet_and_ruth_have_their_orders():
    for text in (VERLET, RUTH):
        assert check(Tableau.loads(text)).verdict == "holds"


def test_a_wrong_coefficient_of_ruth_is_refused_as_not_symplectic():
    moved = Tableau.loads(RUTH.replace('A_hat = [[], ["2/3"]', 'A_hat = [[], ["2/5"]'))
    with pytest.raises(InputError, match="b_2 ahat_21"):
        check(moved, "sprk_separable")


def test_the_library_s_symplectic_methods_have_their_order_and_rk4_is_refused():
    assert check("gauss2", "symplectic_rk").orders[0].order == 4
    assert check("gauss2", "sprk_separable").orders[0].order == 4
    with pytest.raises(InputError, match="expected a symplectic method"):
        check("rk4", "symplectic_rk")


def test_different_weights_are_refused_where_they_must_be_equal():
    with pytest.raises(InputError, match="the same weights"):
        check(Tableau.loads(RUTH), "prk_same_weights")


def test_a_pair_reads_back_as_written_and_misshapen_ones_are_refused():
    tableau = Tableau.loads(VERLET)
    assert isinstance(tableau.method, PartitionedRungeKutta)
    assert Tableau.loads(dumps(tableau)) == tableau
    with pytest.raises(TableauError, match="square A_hat"):
        Tableau.loads(VERLET.replace('A_hat = [["1/2"], ["1/2"]]', 'A_hat = [["1/2"]]'))
    with pytest.raises(TableauError, match="same length"):
        Tableau.loads(VERLET.replace('b_hat = ["1/2", "1/2"]', 'b_hat = ["1/2"]'))
    with pytest.raises(TableauError, match="at most 2"):
        Tableau.loads(VERLET.replace('A_hat = [["1/2"]', 'A_hat = [["1/2", "0", "1"]'))


def random_pair(ring, draw, stages):
    def rows():
        return tuple(tuple(draw() for _ in range(stages)) for _ in range(stages))

    return PartitionedRungeKutta(rows(), rows()[0], rows(), rows()[0])


def random_symplectic_pair(ring, draw, stages):
    pair = random_pair(ring, draw, stages)
    A_hat = tuple(
        tuple(pair.b_hat[j] - pair.b_hat[j] * pair.A[j][i] / pair.b[i] for j in range(stages))
        for i in range(stages)
    )
    return PartitionedRungeKutta(pair.A, pair.b, A_hat, pair.b_hat)


def random_symplectic(ring, draw, stages):
    pair, half = random_pair(ring, draw, stages), ring.rational(1, 2)
    b = pair.b
    A = [list(row) for row in pair.A]
    for i in range(stages):
        A[i][i] = b[i] * half
        for j in range(i):
            A[i][j] = b[j] - b[j] * A[j][i] / b[i]
    return RungeKutta(tuple(map(tuple, A)), b)


def with_same_weights(ring, draw, stages):
    pair = random_pair(ring, draw, stages)
    return PartitionedRungeKutta(pair.A, pair.b, pair.A_hat, pair.b)


RANDOM = {
    "prk": random_pair,
    "prk_same_weights": with_same_weights,
    "sprk_separable": random_symplectic_pair,
    "symplectic_rk": random_symplectic,
}


@pytest.mark.parametrize(
    ("name", "order"), [("prk", 4), ("prk_same_weights", 5), ("sprk_separable", 6), ("symplectic_rk", 7)]
)
def test_listed_conditions_are_independent_and_imply_all_others(name, order):
    ring, family = Residues(PRIMES[0], 160 if name != "prk_same_weights" else 260), families.get(name)
    generator = np.random.default_rng(11)
    method = RANDOM[name](ring, lambda: ring.random(generator), order)
    generators, listed, everything = [], [], []
    for n in range(1, order + 1):
        lower = list(products(generators, n))
        values = list(family.evaluate(method, ring, family.conditions(n)))
        all_values = list(family.evaluate(method, ring, family.all_conditions(n)))
        below = len(pivot_columns(lower))
        listed.append(len(pivot_columns([*lower, *values])) - below)
        everything.append(len(pivot_columns([*lower, *values, *all_values])) - below)
        generators += [(n, x) for x in values]
    assert listed == everything == COUNTS[name][:order]


@pytest.mark.parametrize("name", ["prk", "sprk_separable"])
def test_printed_sums_are_what_the_engine_evaluates(name, random_rational):
    method, family = RANDOM[name](QQ, random_rational, 2), families.get(name)
    tables = {
        "a": method.A,
        "ahat": method.A_hat,
        "b": method.b,
        "bhat": method.b_hat,
        "c": [sum(row, QQ.zero) for row in method.A],
        "chat": [sum(row, QQ.zero) for row in method.A_hat],
    }
    for n in range(1, 5):
        conditions = family.conditions(n)
        assert [value(c.formula, QQ, tables) for c in conditions] == list(
            family.evaluate(method, QQ, conditions)
        )


def test_stormer_verlet_agrees_with_the_flow_to_order_two_and_no_further():
    # y' = z + y z, z' = 1 + y - z^2 from (1, 1) over Q[[h]].
    ring = PowerSeries(QQ, 3)
    tableau = Tableau.loads(VERLET)
    steps = stepped(tableau.method, ring)
    flow = picard(ring)
    errors = [
        [x.coefficients[n] - y.coefficients[n] for x, y in zip(steps, flow, strict=True)] for n in range(4)
    ]
    assert errors[:3] == [[0, 0]] * 3
    assert any(errors[3])


def field(ring, y, z):
    return z + y * z, ring.one + y - z * z


def stepped(method, ring):
    """Fixed-point iteration: each sweep makes one more power of h right."""
    s, h = method.s, ring.h
    k = [(ring.zero, ring.zero)] * s

    def combined(rows, part, row):
        return ring.one + h * sum((ring.constant(x) * k[j][part] for j, x in enumerate(rows[row])), ring.zero)

    for _ in range(5):
        k = [field(ring, combined(method.A, 0, i), combined(method.A_hat, 1, i)) for i in range(s)]
    return combined((method.b,), 0, 0), combined((method.b_hat,), 1, 0)


def picard(ring):
    y = z = ring.one
    for _ in range(4):
        y, z = (ring.one + integral(ring, x) for x in field(ring, y, z))
    return y, z


def integral(ring, x):
    shifted = [QQ.zero] + [c * QQ.rational(1, n) for n, c in enumerate(x.coefficients[:-1], start=1)]
    return ring.from_coefficients(tuple(shifted))
