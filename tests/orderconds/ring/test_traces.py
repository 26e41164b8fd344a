"""Recorded arithmetic: a program run over any ring gives what the engine gives there."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq

from orderconds import families
from orderconds.ring import QQ, PowerSeries
from orderconds.ring.traces import Traces, evaluate
from orderconds.tableau import RungeKutta


@pytest.mark.parametrize("label", ["rk", "cg", "vcg", "sprk", "rkmk(2)", "vrkmk(1)"])
def test_a_recorded_engine_gives_what_the_engine_gives(label: str) -> None:
    family, values = families.get(label), [fmpq(3, 7), fmpq(-2, 5), fmpq(1, 3), fmpq(2), fmpq(5, 2), fmpq(-1)]
    conditions = [c for n in (1, 2, 3) for c in family.conditions(n)]

    def method(x):
        return RungeKutta(((x[0], x[1]), (x[2], x[3])), (x[4], x[5]))

    R = Traces(6)
    recorded = family.evaluate(method(R.inputs), R, conditions)
    found = evaluate(R.operations, values, QQ)
    direct = family.evaluate(method(values), QQ, conditions)
    assert [
        found[x.place] if x.constant is None else QQ.rational(*x.constant.as_integer_ratio())
        for x in recorded
    ] == list(direct)


def test_equal_operations_are_recorded_once() -> None:
    R = Traces(2)
    x, y = R.inputs
    assert (x * y).place == (y * x).place
    assert (x / y).place != (y / x).place
    assert (x - x * 1).place == (x - x).place


def test_constants_fold_and_do_not_enter_the_program() -> None:
    R = Traces(1)
    assert (R.rational(1, 2) * 4 - 2).constant == 0
    assert (R.inputs[0] * 0).constant == 0
    assert (1 / R.rational(3)).constant == Fraction(1, 3)
    assert len(R.operations) == 1


def test_a_program_runs_over_power_series() -> None:
    R, S = Traces(1), PowerSeries(QQ, 3)
    y = 1 / (1 - R.inputs[0])
    assert [str(c) for c in evaluate(R.operations, [S.h], S)[y.place].coefficients] == ["1", "1", "1", "1"]
