"""Embeddings of rings keep sums and products."""

from __future__ import annotations

import pytest

from orderconds.ring import QQ, Balls, PowerSeries, Residues, Ring
from orderconds.ring.embed import embedding
from orderconds.ring.tower import Tower


def sqrt_two() -> tuple[Ring, list[object]]:
    tower = Tower()
    root = tower.root(tower.rational(2), 2)
    return tower.field, [root, root / 3 - 1, tower.rational(5, 7)]


RATIONALS = (QQ, [QQ.rational(1, 2), QQ.rational(-7, 3), QQ.rational(4)])


@pytest.mark.parametrize(
    ("source", "target"),
    [
        (RATIONALS, Balls(100)),
        (RATIONALS, PowerSeries(QQ, 2)),
        (RATIONALS, Residues(10007, 2)),
        (RATIONALS, PowerSeries(Balls(80), 2)),
        (RATIONALS, QQ),
        (sqrt_two(), Balls(100)),
    ],
    ids=str,
)
def test_an_embedding_is_a_ring_map(source: tuple[Ring, list[object]], target: Ring) -> None:
    ring, elements = source
    into = embedding(ring, target)
    for x in elements:
        for y in elements:
            for difference in (into(x + y) - into(x) - into(y), into(x * y) - into(x) * into(y)):  # type: ignore[operator]
                assert target.is_zero(difference) is not False
    assert target.is_zero(into(ring.one) - target.one) is not False
    assert target.is_zero(into(elements[0])) is False


def test_there_is_no_map_out_of_balls_or_residues_into_the_rationals() -> None:
    for source in (Balls(64), Residues(101, 1)):
        with pytest.raises(TypeError, match="no map from"):
            embedding(source, QQ)
