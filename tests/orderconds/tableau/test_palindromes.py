"""Symmetric commutator-free methods: seen from y1 they are what they are seen from y0."""

from __future__ import annotations

import pytest

from orderconds.tableau import Tableau, find
from orderconds.tableau.palindromes import symmetric_paths

HEAD = 'name = "t"\nfamily = "cf"\n'


def verdict(text: str) -> bool | None:
    tableau = Tableau.loads(HEAD + text)
    return symmetric_paths(tableau.method, tableau.ring)


@pytest.mark.parametrize(
    ("text", "symmetric"),
    [
        ('[[stage]]\nexp = [["1/2"]]\n[update]\nexp = [["1"]]\n', True),
        ('[[stage]]\nexp = [["1/3"]]\n[update]\nexp = [["1"]]\n', False),
        # Gauss's two stages in one exponential: neighbours are no multiples, nothing cancels.
        (
            '[[stage]]\nexp = [["1/4", "1/4 - sqrt(3)/6"]]\n[[stage]]\nexp = [["1/4 + sqrt(3)/6", "1/4"]]\n'
            '[update]\nexp = [["1/2", "1/2"]]\n',
            False,
        ),
        # Two midpoint rules, one after the other.
        (
            '[[stage]]\nexp = [["1/4"]]\n[[stage]]\nexp = [["1/2"], ["0", "1/4"]]\n'
            '[update]\nexp = [["1/2"], ["0", "1/2"]]\n',
            True,
        ),
        (
            '[[stage]]\nexp = [["1/4"]]\n[[stage]]\nexp = [["1/2"], ["0", "1/4"]]\n'
            '[update]\nexp = [["0", "1/2"], ["1/2"]]\n',
            False,
        ),
    ],
)
def test_small_methods(text: str, symmetric: bool) -> None:
    assert verdict(text) is symmetric


def test_rounded_decimals_do_not_tell() -> None:
    text = '[[stage]]\nexp = [["0.50~"]]\n[update]\nexp = [["1"]]\n'
    assert verdict(text) is None


@pytest.mark.parametrize("name", ["vcf_gauss2", "vcf_gauss3"])
def test_one_changed_coefficient_is_seen(name: str) -> None:
    text = find(name).read_text(encoding="utf-8")
    assert symmetric_paths(Tableau.loads(text).method, Tableau.loads(text).ring) is True
    changed = Tableau.loads(text.replace("[update]\nexp = [[", '[update]\nexp = [["1/9"], [', 1))
    assert symmetric_paths(changed.method, changed.ring) is False
