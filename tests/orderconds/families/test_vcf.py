"""Family vcf: counts by number of exponentials, printed sums against the engine, VCG as a special case."""

from __future__ import annotations

import pytest
from flint import fmpq

from orderconds.errors import ZeroWeight
from orderconds.families import get
from orderconds.families.cf import coefficient_tables
from orderconds.ring import QQ
from orderconds.tableau import Tableau
from orderconds.tableau.library import find
from orderconds.tableau.methods import CommutatorFree, RungeKutta, Stage
from tests.oracles.index_sums import value

ROWS = [
    [[fmpq(1, 3), fmpq(1, 5)], [fmpq(-1, 2), fmpq(1, 7)]],
    [[fmpq(1, 4), fmpq(2, 3)], [fmpq(1, 6), fmpq(-1)]],
]
UPDATE = [[fmpq(1, 2), fmpq(-1, 3)], [fmpq(-1, 4), fmpq(5, 6)], [fmpq(1, 2), fmpq(-1, 4)]]
GENERAL = CommutatorFree(
    tuple(Stage(None, tuple(map(tuple, rows))) for rows in ROWS), Stage(None, tuple(map(tuple, UPDATE)))
)


@pytest.mark.parametrize(
    ("update", "stage", "counts"),
    [
        (None, None, [1, 1, 6, 28, 174]),
        (3, 2, [1, 1, 6, 28, 174]),
        (2, 2, [1, 1, 6, 27]),
    ],
)
def test_independent_conditions_by_number_of_exponentials(update, stage, counts):
    family = get("vcf", update=update, stage=stage)
    assert [len(family.conditions(n)) for n in range(1, len(counts) + 1)] == counts


@pytest.mark.parametrize(("update", "stage", "order", "rank"), [(3, 1, 4, 25), (1, 2, 3, 3)])
def test_too_few_exponentials_cannot_reach_an_order_and_the_conditions_say_so(update, stage, order, rank):
    # One condition more than the rank at methods: the flow breaks a relation that all these methods satisfy.
    assert len(get("vcf", update=update, stage=stage).conditions(order)) == rank + 1


@pytest.mark.parametrize("order", [1, 2, 3])
def test_printed_sums_are_what_the_engine_computes(order):
    family = get("vcf")
    tables = coefficient_tables(GENERAL, QQ)
    conditions = family.all_conditions(order)
    values = family.evaluate(GENERAL, QQ, conditions)
    for condition, expected in zip(conditions, values, strict=True):
        assert value(condition.formula, QQ, tables) == expected, condition


def test_one_stage_in_each_exponential_is_vcg():
    tableau = RungeKutta(
        ((fmpq(0), fmpq(1, 2)), (fmpq(2, 3), fmpq(-1, 5))),
        (fmpq(1, 4), fmpq(3, 4)),
    )
    vcf, vcg = get("vcf"), get("vcg")
    for order in (1, 2, 3, 4):
        expected = vcg.evaluate(tableau, QQ, vcg.all_conditions(order))
        assert vcf.evaluate(tableau, QQ, vcf.all_conditions(order)) == expected
        commutator_free = tableau.as_crouch_grossman(QQ)
        assert vcf.evaluate(commutator_free, QQ, vcf.all_conditions(order)) == expected


def test_cf4_read_variationally_keeps_order_four_and_its_swapped_factors_do_not():
    family, method = get("vcf"), Tableau.load(find("cf4")).method
    swapped = CommutatorFree(method.stages, Stage(None, method.update.exponentials[::-1]))

    def failing(method, order):
        conditions = family.decisive_conditions(order)
        return [
            c for c, r in zip(conditions, family.residuals(method, QQ, conditions), strict=True) if r != 0
        ]

    assert not any(failing(method, order) for order in (1, 2, 3, 4))
    assert failing(method, 5)
    assert not failing(swapped, 2)
    assert failing(swapped, 3)


def test_weights_that_cancel_between_exponentials_are_refused():
    cancelled = CommutatorFree(
        (Stage(None, ()), Stage(None, ())),
        Stage(None, ((fmpq(1), fmpq(1, 2)), (fmpq(0), fmpq(-1, 2)))),
    )
    with pytest.raises(ZeroWeight, match="b_2 = 0"):
        get("vcf").evaluate(cancelled, QQ, get("vcf").all_conditions(1))
