"""The option ``cutoff``: which words the truncation of dexpinv changes, and which values are refused."""

from __future__ import annotations

import pytest

from orderconds import families
from orderconds.errors import InputError
from orderconds.families.dexpinv_cut import longest_unseen
from orderconds.series.dexpinv import bernoulli


def test_the_first_omitted_power_has_a_nonzero_bernoulli_number() -> None:
    for cutoff in range(40):
        omitted = (n for n in range(cutoff + 1, cutoff + 3) if bernoulli(n))
        assert longest_unseen(cutoff) == next(omitted)


def test_a_large_cutoff_needs_no_bernoulli_numbers() -> None:
    assert longest_unseen(10**9) == 10**9 + 2


@pytest.mark.parametrize("cutoff", [-1, True, 1.0, "1"])
@pytest.mark.parametrize("family", ["rkmk", "vrkmk"])
def test_a_cutoff_is_a_nonnegative_integer(family: str, cutoff: object) -> None:
    with pytest.raises(InputError, match="expected an integer >= 0"):
        families.get(family, cutoff=cutoff)
