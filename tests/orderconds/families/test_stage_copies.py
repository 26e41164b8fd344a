"""Order 4 as SPRK and as CG does not give order 4 as VCG: copies of a stage part them.

A stage divided into copies that share its weight and its column is the same stage to SPRK and to CG, since
equal stages have equal velocities. VCG varies each copy's exponential on its own: the sum of the b_i^3, one
of its conditions of order 3, sees how the weight was divided.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import fmpq

from orderconds.checking import check
from orderconds.families import get
from orderconds.ring import QQ
from orderconds.tableau.methods import RungeKutta

FIXTURES = Path(__file__).resolve().parents[2] / "valid"


def divided(method, stage, parts):
    """Divide one stage into copies with these parts of its weight."""

    def columns(row):
        return (*row[:stage], *(row[stage] * part for part in parts), *row[stage + 1 :])

    rows = [columns(row) for row in method.A]
    return RungeKutta((*rows[:stage], *[rows[stage]] * len(parts), *rows[stage + 1 :]), columns(method.b))


@pytest.mark.parametrize("family", ["rk", "sprk", "cg", "cf"])
@pytest.mark.parametrize("parts", [(fmpq(1, 3), fmpq(2, 3)), (fmpq(1, 2), fmpq(1), fmpq(-1, 2))])
def test_copies_of_a_stage_change_no_condition_of_rk_sprk_cg_and_cf(random_tableau, family, parts):
    method, family = random_tableau(3), get(family)
    copied = divided(method, 1, parts)
    for order in range(1, 5):
        conditions = family.conditions(order)
        assert family.evaluate(copied, QQ, conditions) == family.evaluate(method, QQ, conditions)


def test_copies_whose_cubes_add_up_to_one_change_no_condition_of_vcg_below_order_four(random_tableau):
    method, family = random_tableau(3), get("vcg")
    halved, cubes = (divided(method, 1, p) for p in ([fmpq(1, 2)] * 2, [fmpq(1, 2), fmpq(1), fmpq(-1, 2)]))

    def changed(copied, order):
        conditions = family.conditions(order)
        return family.evaluate(copied, QQ, conditions) != family.evaluate(method, QQ, conditions)

    assert [changed(halved, order) for order in (1, 2, 3)] == [False, False, True]
    assert [changed(cubes, order) for order in (1, 2, 3, 4)] == [False, False, False, True]


@pytest.mark.parametrize(
    ("name", "vcg", "certificate"),
    [
        ("triple_jump_stage_halved", 2, "exact"),
        ("triple_jump_stage_in_three", 3, "exact"),
        ("sprk4_cg4", 2, "decimal"),
    ],
)
def test_order_four_of_sprk_and_cg_with_less_of_vcg(name, vcg, certificate):
    report = check(FIXTURES / f"{name}.toml")
    assert report.verdict == "holds"
    assert {f.family: (f.order, f.certificate) for f in report.orders} == {
        "rk": (4, certificate),
        "sprk": (4, certificate),
        "cg": (4, certificate),
        "vcg": (vcg, certificate),
    }
