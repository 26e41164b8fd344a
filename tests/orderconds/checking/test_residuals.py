"""Residuals by balls first: the same verdicts, the same exact numbers, the same digits."""

from __future__ import annotations

from decimal import Decimal
from typing import Any

import pytest

from orderconds import families
from orderconds.checking import read
from orderconds.checking.residuals import Failure, judge
from orderconds.ring import QQ, Balls, NumberField


@pytest.mark.parametrize(
    ("name", "label", "order"),
    [
        ("triple_jump", "cg", 5),
        ("triple_jump", "vrkmk(1)", 4),
        ("gauss3", "vcg", 3),
        ("radau2a3", "rkmk(2)", 6),
        ("gauss2", "rk", 5),
        ("cg4", "cg", 5),
    ],
)
def test_balls_first_changes_no_answer(name: str, label: str, order: int) -> None:
    tableau, family = read(name), families.get(label)
    method = tableau.read_as(family.formats)
    assert isinstance(tableau.ring, NumberField)
    conditions = family.decisive_conditions(order)
    plain, quick = (judge(family, method, tableau.ring, conditions, first) for first in (False, True))
    assert plain == quick
    assert plain[0] >= {"fails"}
    for one, other in zip(plain[1], quick[1], strict=True):
        assert one.decimal == other.decimal
        assert one.size == other.size == Decimal(one.decimal)


def test_zero_is_proved_where_balls_cannot_tell() -> None:
    tableau, family = read("triple_jump"), families.get("composition")
    method = tableau.read_as(family.formats)
    assert judge(family, method, tableau.ring, family.conditions(3), True) == ({"zero"}, ())


def test_a_residual_that_is_asked_for_alone_is_evaluated_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    tableau, family = read("triple_jump"), families.get("cg")
    method = tableau.read_as(family.formats)
    _, failing = judge(family, method, tableau.ring, family.conditions(5), True)
    known = [f for f in failing if f.enclosure is not None]
    evaluated: list[int] = []

    def counted(conditions: Any) -> Any:
        evaluated.append(len(conditions))
        return family.residuals(method, tableau.ring, conditions)

    monkeypatch.setattr(known[0].exact.func, "_evaluate", counted)  # type: ignore[attr-defined]
    first = known[0].residual
    assert evaluated == [1]
    assert {f.residual for f in known} > {first}
    assert evaluated == [1, len(family.conditions(5)) - 1], "then all others at once"


def test_a_decimal_that_ends_is_spelled_as_it_ends() -> None:
    tableau, family = read("gauss2"), families.get("cg")
    method = tableau.read_as(family.formats)
    _, failing = judge(family, method, tableau.ring, family.conditions(4), True)
    _, plain = judge(family, method, tableau.ring, family.conditions(4))
    assert [f.decimal for f in failing] == [f.decimal for f in plain]


def test_failures_are_equal_where_condition_and_residual_are() -> None:
    (condition,) = families.get("rk").conditions(1)
    ring = read("rk4").ring
    half, third = (Failure(condition, ring, lambda q=q: ring.rational(1, q)) for q in (2, 3))
    assert half == Failure(condition, ring, lambda: ring.rational(2, 4))
    assert half != third
    assert hash(half) == hash(third)
    assert half.as_json()["residual"] == "1/2"
    assert str(half) == ".: sum_i b_i = 1, residual 1/2 (0.5)"


@pytest.mark.parametrize(
    ("name", "label"),
    [("gauss2", "rk"), ("cg4", "cg"), ("gauss2", "vrkmk(2)"), ("gauss2", "sprk"), ("cg4a", "cg")],
)
def test_orders_evaluated_one_after_the_other_are_those_evaluated_alone(name: str, label: str) -> None:
    # A family keeps the series of the last two methods between orders.
    tableau, kept = read(name), families.get(label)
    balls = Balls(128)
    exact: Any = tableau.ring
    enclosed = tableau.method.map(lambda x: balls.enclose(exact.ball(x, 128)))
    for n in range(1, 5):
        for method, ring in ((tableau.method, tableau.ring), (enclosed, balls), (read("rk4").method, QQ)):
            conditions = kept.conditions(n)
            alone = families.get(label).residuals(method, ring, conditions)
            together = kept.residuals(method, ring, conditions)
            assert [ring.text(x) for x in together] == [ring.text(x) for x in alone]
