"""The exhaustive search: each recipe is raced, or its bound excludes it, and a sample tests the bound."""

from __future__ import annotations

import math

import pytest

from codegen.lab.efficiency import exhaustive
from codegen.lab.efficiency.exhaustive import exhaust, sampled
from codegen.lab.efficiency.recommend import Request

TABLEAUX = ("rk4", "heun", "kutta3", "dormand_prince5")


@pytest.fixture(scope="module")
def request_() -> Request:
    return Request("free_rigid_body", 1.0, tableaux=TABLEAUX)


@pytest.mark.slow
def test_the_bound_excludes_recipes_and_keeps_the_fastest(
    request_: Request, monkeypatch: pytest.MonkeyPatch
) -> None:
    everything = exhaust(request_, {1e-8: math.inf})
    assert everything.complete
    assert (everything.excluded, everything.nearest) == (0, math.inf)
    assert everything.raced + everything.refused + everything.copies == everything.recipes
    best = everything.best(1e-8)
    monkeypatch.setattr(exhaustive, "SAMPLE", 2)
    bounded = exhaust(request_, {1e-8: best})
    assert bounded.complete
    assert 0 < bounded.excluded < everything.recipes
    total = bounded.raced + bounded.refused + bounded.copies + bounded.excluded
    assert total == bounded.recipes == everything.recipes
    # No recipe that the bound excludes is as fast as the accepted ratio.
    kept = {r.entry.recipe for r in bounded.results[1e-8]}
    close = {r.entry.recipe for r in everything.results[1e-8] if r.reached and r.seconds <= 1.25 * best}
    assert close <= kept
    assert f"{bounded.excluded} excluded because their predicted time is too long" in bounded.text()


def test_the_sample_contains_the_recipes_closest_to_the_bound_and_others() -> None:
    chosen = sampled(range(1000))
    half = exhaustive.SAMPLE // 2
    assert chosen[:half] == list(range(half))
    assert len(set(chosen)) == exhaustive.SAMPLE
    assert max(chosen) > 800
