"""A proof is computed once for a file; a tableau or a proof that differs from the file has its own proof."""

from __future__ import annotations

from dataclasses import replace

import pytest

from orderconds.proof import certificate
from orderconds.tableau import Tableau, find


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the tableaux whose equations were solved."""
    solved: list[str] = []
    equations = certificate.equations

    def counting(tableau: Tableau) -> object:
        solved.append(tableau.name)
        return equations(tableau)

    certificate._certify.cache_clear()
    monkeypatch.setattr(certificate, "equations", counting)
    return solved


def test_a_file_that_is_read_again_is_proved_once(counted: list[str]) -> None:
    first, second = (certificate.certify(Tableau.load(find("cg4a"))) for _ in range(2))
    assert first == second
    assert counted == ["cg4a"]


def test_another_proof_of_the_same_file_is_not_taken_from_the_cache(counted: list[str]) -> None:
    tableau = Tableau.load(find("cg4a"))
    assert tableau.proof is not None
    certificate.certify(tableau)
    certificate.certify(replace(tableau, proof=replace(tableau.proof)))
    certificate.certify(replace(tableau, name="cg4a_copy"))
    assert counted == ["cg4a", "cg4a", "cg4a_copy"]
