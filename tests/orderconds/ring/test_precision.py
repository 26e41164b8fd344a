"""The working precision of balls."""

from __future__ import annotations

from flint import ctx

from orderconds.ring import Balls


def test_working_precision_belongs_to_the_ring_and_is_given_back() -> None:
    before = ctx.prec
    fine, coarse = Balls(500), Balls(40)
    assert (fine.one / 3).value.rel_accuracy_bits() > 480
    assert (coarse.one / 3).value.rel_accuracy_bits() < 45
    assert ctx.prec == before
