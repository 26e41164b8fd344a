"""Every order claimed on a group is that of the local error of one step, computed without any series engine.

On SO(3), GL(2) and the unitriangular 4 x 4 matrices the step and the exact flow of a random polynomial
field (or energy on the cotangent bundle) are series in h, exactly, modulo a prime; for proved decimals to
100 digits. They agree up to h^p on each group, and differ at h^(p + 1).
"""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from orderconds.tableau import Tableau, available, find
from orderconds.tableau.claims import OrderClaim
from tests.exact_steps import GROUPS, certified, local_error_power

FAMILIES = ("cg", "cf", "rkmk", "vcg", "vrkmk", "vcf")
OTHERS = ("rk", "sprk", "prk", "prk_same_weights", "sprk_separable", "composition", "symmetric_composition")
"""Families of no group, or of compositions, which are claimed beside ``vcg``."""
LINEAR = ("splitting", "splitting(3)", "rkn", "magnus", "cf_magnus", "fer", "cayley")
"""Families of words, whose second route is in ``families/test_word_families_local_error.py``."""
QUICK = ("cf4", "cg3", "cg4", "cg4a", "gauss2", "triple_jump")


CLAIMS = [
    pytest.param(name, claim, id=f"{name}-{claim.label}", marks=[] if name in QUICK else [pytest.mark.slow])
    for name in available()
    for claim in Tableau.load(find(name)).claims.orders
    if claim.family in FAMILIES
]


@pytest.mark.parametrize(("name", "claim"), CLAIMS)
def test_a_claimed_order_is_that_of_the_local_error(name: str, claim: OrderClaim) -> None:
    powers = {
        group: local_error_power(certified(name), claim.family, claim.cutoff, GROUPS[group], claim.order + 1)
        for group in GROUPS
    }
    if claim.cutoff is not None and claim.cutoff >= 2 and powers["nilpotent"] is None:
        # All brackets of four vanish there, so that a cut-off from two on leaves nothing out.
        del powers["nilpotent"]
    assert set(powers.values()) == {claim.order + 1}, powers


def test_no_claim_of_any_file_is_left_out() -> None:
    """Count claims in the files as they are written, without the package's reader."""
    written = set()
    for path in Path(find("rk4")).parents[1].rglob("*.toml"):
        record = tomllib.loads(path.read_text(encoding="utf-8"))
        for family, claim in record.get("claims", {}).items():
            assert isinstance(claim, bool) or family in (*FAMILIES, *OTHERS, *LINEAR), (path.name, family)
            if family in FAMILIES:
                claims = claim if isinstance(claim, list) else [{"order": claim}]
                written |= {(record["name"], family, c.get("cutoff"), c["order"]) for c in claims}
    confirmed = [param.values for param in CLAIMS]
    assert written == {(name, claim.family, claim.cutoff, claim.order) for name, claim in confirmed}
    assert len(written) == len(confirmed) > 600


@pytest.mark.parametrize(
    ("family", "text", "power"),
    [
        ("cg", 'family = "rk"\nA = [[], ["3/4"], ["17/108", "119/216"]]\nb = ["13/51", "-2/3", "24/17"]', 3),
        ("vcg", 'family = "rk"\nA = [["1/4", "1/6"], ["1/3", "1/4"]]\nb = ["1/2", "1/2"]', 3),
        ("rkmk", 'family = "rk"\nA = [[], ["1/2"]]\nb = ["1/2", "1/2"]', 2),
    ],
)
def test_the_route_sees_a_method_that_misses_its_order(family: str, text: str, power: int) -> None:
    wrong = Tableau.loads(f'name = "wrong"\n{text}\n')
    assert {local_error_power(wrong, family, 2, group, 4) for group in GROUPS.values()} == {power}
