"""Conditions that are not evaluated hold: every reduction against the engine, which knows of none."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from orderconds import families
from orderconds.checking import family_order, read
from orderconds.families.reductions import Reductions
from orderconds.ring import QQ
from orderconds.series.action_lie import MuntheKaasActionSeries
from orderconds.series.action_switching import representatives
from orderconds.series.action_trees import transport, velocity
from orderconds.series.dexpinv import DexpinvSeries
from orderconds.tableau import PartitionedRungeKutta, RungeKutta, Tableau
from orderconds.trees.ordered import ordered_forests

CASES = [
    ("gauss2", "rk", {}),
    ("gauss2", "sprk", {}),
    ("gauss2", "vrkmk(1)", {"sprk": 4}),
    ("gauss3", "vrkmk(2)", {"sprk": 6}),
    ("gauss2", "rkmk(2)", {"rk": 4}),
    ("radau2a2", "vrkmk(1)", {"sprk": 2}),
    ("rk4", "rkmk(1)", {"rk": 4}),
    ("rk4", "vrkmk(2)", {"sprk": 4}),
    ("lobatto3ab3", "prk", {}),
    ("lobatto3ab4", "prk_same_weights", {}),
    ("vcf_gauss2", "vcf", {}),
    ("triple_jump", "vcg", {}),
]


@pytest.mark.parametrize(("name", "label", "proved"), CASES)
def test_the_order_is_what_every_condition_says(
    name: str, label: str, proved: dict[str, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    tableau, family = read(name), families.get(label)
    spared = family_order(tableau, family, proved=proved)
    monkeypatch.setattr(type(family), "reductions", lambda self, method, ring, orders: Reductions(ring))
    assert spared == family_order(tableau, family)


@pytest.mark.parametrize("cutoff", [0, 1, 2, 3])
def test_trees_without_long_words_do_not_see_the_cut(cutoff: int) -> None:
    method = _made_up()
    cut, whole = (MuntheKaasActionSeries(QQ, method.A, method.b, r) for r in (cutoff, None))
    spared = families.get(f"vrkmk({cutoff})").reductions(method, QQ, {"sprk": 9})
    assert spared.cut is not None
    unseen = 0
    for tree in (tree for n in range(1, 6) for tree in representatives(n)):
        if spared.follows(tree.vertices, tree):
            unseen += 1
            assert cut.condition(tree) == whole.condition(tree), tree
    assert unseen > (1, 9, 400, 400)[cutoff]
    leaf = velocity()
    seen = velocity((leaf,), (transport((leaf,) * spared.cut.longest),))
    assert not spared.follows(seen.vertices, seen)
    assert cut.condition(seen) != whole.condition(seen), "one letter more sees it"


@pytest.mark.parametrize("cutoff", [0, 1, 2])
def test_forests_without_long_words_do_not_see_the_cut(cutoff: int) -> None:
    method = _made_up()
    cut, whole = (DexpinvSeries(QQ, method.A, method.b, r) for r in (cutoff, None))
    spared = families.get(f"rkmk({cutoff})").reductions(method, QQ, {"rk": 9})
    differ = 0
    for n in range(1, 7):
        for forest in ordered_forests(n):
            if spared.follows(n, forest):
                assert cut(forest) == whole(forest)
            differ += cut(forest) != whole(forest)
    assert differ


def test_nothing_follows_beyond_the_order_without_the_cut() -> None:
    spared = families.get("vrkmk(2)").reductions(read("rk4").method, QQ, {"sprk": 4})
    first = representatives(5)[0]
    assert not spared.follows(5, first)
    assert spared.follows(4, representatives(4)[0])


def test_a_method_is_symmetric_in_a_family_only_where_its_paths_are() -> None:
    gauss2 = read("gauss2")
    for label, expected in (("rk", True), ("sprk", True), ("vcg", False), ("rkmk(2)", False)):
        found = families.get(label).reductions(gauss2.method, gauss2.ring, {})
        assert found.order_follows(4) is expected, label
        assert not found.order_follows(5)
    kutta3 = read("kutta3")
    assert not families.get("rk").reductions(kutta3.method, kutta3.ring, {}).order_follows(4)


def test_root_switching_needs_a_symplectic_pair_with_equal_weights() -> None:
    pair: Any = read("lobatto3ab3")
    family = families.get("prk")
    assert family.reductions(pair.method, pair.ring, {}).rest_follows(4)
    assert not family.reductions(pair.method, pair.ring, {}).rest_follows(5), "its order is 4"
    m = pair.method
    swapped = PartitionedRungeKutta(m.A, m.b, m.A, m.b)
    assert not family.reductions(swapped, pair.ring, {}).rest_follows(4)


def _made_up() -> RungeKutta:
    """Return a full tableau that is none in particular."""

    def entry(i: int, j: int) -> Any:
        return QQ.rational(*Fraction(3 * i * i + 5 * j + 2, 7 + i + 2 * j).as_integer_ratio())

    return RungeKutta(
        tuple(tuple(entry(i, j) for j in range(2)) for i in range(2)), tuple(entry(3, j) for j in range(2))
    )


def test_balls_keep_the_certificate_that_they_have() -> None:
    text = 'name = "d"\nfamily = "rk"\nA = [["0.2500000000~"]]\nb = ["0.5000000000~"]'
    tableau = Tableau.loads(text)
    found = families.get("rk").reductions(tableau.method, tableau.ring, {})
    assert not found.even
    assert found.substitute is None
