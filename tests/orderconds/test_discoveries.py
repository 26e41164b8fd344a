"""The orders of the methods that `solve` found, on GL(3) and a nilpotent group, from below and from above.

One step and the exact flow are series in h, computed from the formulas of the method without trees (see
``tests/exact_steps.py``). A method has order at least p if they agree up to h^p, and at most p if they differ
at h^(p + 1). Every family in which the file of the method states an order is tested.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from orderconds.tableau import Tableau, available, find
from tests.exact_steps import GL3, NILPOTENT, certified, local_error_power

ROOT = Path(__file__).parents[2]
GROUPS = {"GL(3)": GL3, "nilpotent": NILPOTENT}
FAMILIES = ("cg", "cf", "rkmk", "vcg", "vrkmk", "vcf")
FOUND = [name for name in available() if Tableau.load(find(name)).source.startswith("orderconds solve")]
QUICK = [("cf5_2n_s10", "cf"), ("vcf_gauss2", "vcf"), ("vcg3_s3", "vcg")]


CASES = [
    pytest.param(
        name,
        claim,
        group,
        id=f"{name}-{claim.label}-{group}",
        marks=[] if (name, claim.label) in QUICK else [pytest.mark.slow],
    )
    for name in FOUND
    for claim in Tableau.load(find(name)).claims.orders
    if claim.family in FAMILIES
    for group in GROUPS
]


@pytest.mark.parametrize(("name", "claim", "group"), CASES)
def test_the_local_error_begins_at_the_power_after_the_order(name, claim, group):
    found = local_error_power(certified(name), claim.family, claim.cutoff, GROUPS[group], claim.order + 1)
    if group == "nilpotent" and claim.cutoff is not None and claim.cutoff >= 2 and found is None:
        # Brackets of four elements are zero here, so that the cut-off omits nothing.
        return
    assert found == claim.order + 1


@pytest.mark.parametrize("name", FOUND)
def test_every_method_has_a_group_order_and_a_place_in_the_documentation(name):
    assert [case for case in CASES if case.values[0] == name]
    page = (ROOT / "docs" / "reference" / "discoveries.md").read_text(encoding="utf-8")
    family, *_, number = name.rpartition("s")
    assert f"`{name}`" in page or (f"`{family}s3` ... `{family}s6`" in page and 3 <= int(number) <= 6)


@pytest.mark.parametrize("group", GROUPS)
def test_the_embedded_method_of_a_2n_scheme_has_order_four(group):
    lower = certified("cf5_2n_s10").lower()
    assert local_error_power(lower, "cf", None, GROUPS[group], 5) == 5


@pytest.mark.parametrize("group", GROUPS)
def test_a_change_of_1e_20_is_seen(group):
    """The last coefficient of the update is changed, so that the sum of the weights is not one."""
    right = certified("cf5_2n_s10")
    (row,) = right.method.update.exponentials
    changed = (*row[:-1], row[-1] + right.ring.rational(1, 10**20))
    update = replace(right.method.update, exponentials=(changed,))
    wrong = replace(right, method=replace(right.method, update=update))
    assert local_error_power(right, "cf", None, GROUPS[group], 5) is None
    assert local_error_power(wrong, "cf", None, GROUPS[group], 5) == 1
