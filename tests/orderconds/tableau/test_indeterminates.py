"""What a file's spelling proves whatever its decimals are, and what it does not."""

from __future__ import annotations

import pytest

from orderconds.proof.certificate import certify
from orderconds.proof.equations import gauss_nodes
from orderconds.proof.krawczyk import NotProved
from orderconds.ring import QQ
from orderconds.tableau import Tableau, find
from orderconds.tableau.properties import properties

TEXT = find("cf_magnus6").read_text(encoding="utf-8")


def test_a_palindrome_of_decimals_and_radicals_is_symmetric() -> None:
    assert properties(Tableau.loads(TEXT))["symmetric"] is True


def test_one_sign_in_the_palindrome_undoes_the_proof() -> None:
    tableau = Tableau.loads(TEXT.replace('b = "-f12"', 'b = "f12"'))
    assert properties(tableau)["symmetric"] is not True
    with pytest.raises(NotProved, match="do not prove that the method is symmetric"):
        certify(tableau)


def test_the_proof_needs_the_nodes_of_gauss() -> None:
    with pytest.raises(NotProved):
        certify(Tableau.loads(TEXT.replace('"1/2 - r/10"', '"1/2 - r/11"').replace("+ r/10", "+ r/11")))


def test_cf_magnus6_has_the_second_weight_of_its_source() -> None:
    assert 'f21 = "0.387524052025311865' in TEXT


def test_gauss_nodes_are_told_from_others() -> None:
    half = QQ.rational(1, 2)
    assert gauss_nodes([half], QQ)
    assert not gauss_nodes([half, half], QQ)
    assert not gauss_nodes([QQ.zero, half, QQ.one], QQ)
