"""A file claims an order in every family that its tableau can claim."""

from __future__ import annotations

import pytest

from orderconds import Tableau, check
from orderconds.checking import claimable_families, read, unclaimed
from orderconds.tableau import available


@pytest.mark.parametrize("name", available())
def test_the_library_claims_every_family(name: str) -> None:
    assert unclaimed(read(name)) == ()


def test_a_missing_claim_fails_a_complete_check_and_no_other() -> None:
    text = 'name = "t"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\n[claims]\nrk = 2\ncg = 2\n'
    tableau = Tableau.loads(text)
    assert check(tableau).verdict == "holds"
    report = check(tableau, complete=True)
    assert report.verdict == "fails"
    assert report.broken_claims == ("no claim in family rkmk; the method has order 2 in this family",)


def names(tableau: Tableau) -> list[str]:
    return [family.label() for family in claimable_families(tableau)]


def test_a_zero_weight_bars_the_variational_families() -> None:
    assert names(read("cg4")) == ["rk", "cg", "rkmk"]
    assert names(read("cf4")) == ["rk", "cf", "vcf"]


def test_a_pair_serves_separable_systems_where_it_is_symplectic_else_prk() -> None:
    text = 'name = "t"\nfamily = "prk"\nA = [["0"]]\nb = ["1"]\nA_hat = [["{}"]]\nb_hat = ["1"]\n'
    assert names(Tableau.loads(text.format("1"))) == ["sprk_separable"]
    assert names(Tableau.loads(text.format("1/2"))) == ["prk"]
