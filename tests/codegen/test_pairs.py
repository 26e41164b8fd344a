"""Every family on every group and by every action: the emitted step and its order, or a clear refusal."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from codegen.certify import certified_order
from codegen.emitter import compile_method, emit_compiled
from codegen.groups import actions, listing
from codegen.lab.orders.local_error import local_error, valuation
from codegen.loader import load
from codegen.lower import names
from codegen.printers import names as target_names
from tests.codegen import pairs
from tests.codegen.groups.action_cases import ONE_OF_EACH
from tests.codegen.test_family_target import IMPLICIT_ULPS, stepper
from tests.promises import ulps

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "pairs.md"

ALL = [
    (kind, row, family)
    for kind in (pairs.GROUP, pairs.ACTION)
    for row in pairs.rows(kind)
    for family in names()
]


def test_every_group_and_every_action_has_a_sample():
    registered = {"Unipotent", "Shear"}
    assert {row["name"] for row in listing()} - registered <= set(pairs.SAMPLES)
    assert {row["name"] for row in actions.listing()} - registered <= set(ONE_OF_EACH)


@pytest.mark.slow
def test_the_page_shows_the_pairs():
    assert PAGE.read_text(encoding="utf-8") == pairs.page()


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "row", "family"), ALL)
def test_a_pair_has_its_order_and_is_emitted_or_is_refused(kind, row, family):
    found = pairs.pair(kind, row, family)
    if found.refusal:
        what, _, expected = found.refusal.partition("; expected ")
        assert what
        assert expected
        return
    made = compile_method(
        pairs.scene_of(kind, row, found.hamiltonian, found.energy, found.linear), found.method
    )
    order = certified_order(made.method, made.scene).order
    assert order == found.order
    error = local_error(made.program, made.problem, made.method.ring, order + 1)
    assert valuation(error) == order + 1
    rng = random.Random(found.method)
    for target in sorted(target_names()):
        emission = emit_compiled(made, target, prefix="pair_")
        integrator, step = load(emission), stepper(made)
        state = list(emission.manifest["initial"])
        for _ in range(3):
            h, t = rng.choice((-1, 1)) * rng.uniform(1, 2) / 64, rng.uniform(0, 3)
            new = step(state, h, t)
            assert ulps(integrator.step(state, h, t), new) <= IMPLICIT_ULPS
            state = new
