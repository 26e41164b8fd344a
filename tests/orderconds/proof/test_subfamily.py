"""The reduction ``spelling``: conditions that follow from others for a sub-family, found by ranks."""

from __future__ import annotations

import pytest

from orderconds import families
from orderconds.checking import check
from orderconds.proof.certificate import certify
from orderconds.proof.krawczyk import NotProved
from orderconds.proof.subfamily import independent_conditions
from orderconds.solve.parametrise import ansatz
from orderconds.solve.spec import Spec
from orderconds.tableau import Tableau, find
from orderconds.tableau.file import text_of


def counts(family: str, order: int, spec: Spec, structure: str) -> list[int]:
    found = ansatz(family, spec, structure)
    conditions = independent_conditions(families.get(found.family), found.symbolic(), order)
    return [sum(c.order == n for c in conditions) for n in range(1, order + 1)]


@pytest.mark.parametrize(("family", "expected"), [("rk", [1, 1, 2, 4]), ("vcg", [1, 1, 6, 25])])
def test_a_free_tableau_has_the_conditions_of_the_family(family: str, expected: list[int]) -> None:
    assert counts(family, 4, Spec(4), "full") == expected


def test_compositions_of_midpoints_have_one_condition_at_every_odd_order_first() -> None:
    # Composed midpoints under vcg: 1, 0, 1, 1 conditions; sum b = 1 holds by the spelling.
    text = 'name = "m"\nfamily = "rk"\nA = [["b1/2"], ["b1", "b2/2"], ["b1", "b2", "b3/2"]]\n'
    text += 'b = ["b1", "b2", "b3"]\n[numbers]\nb1 = "0.31~"\nb2 = "0.47~"\nb3 = "1 - b1 - b2"\n'
    spelled = Tableau.loads(text + '[proof]\nconditions = "vcg"\norder = 4').proof.symbolic
    found = independent_conditions(families.get("vcg"), spelled, 4)
    assert [c.order for c in found] == [3, 4]


def test_right_abscissae_leave_few_conditions() -> None:
    assert counts("vcg", 4, Spec(4), "abscissae") == [0, 0, 1, 3]
    assert counts("vcf", 4, Spec(3), "abscissae") == [0, 0, 1, 4]


def test_symmetric_methods_have_conditions_of_odd_order_only() -> None:
    assert counts("vcf", 4, Spec(2), "symmetric")[1::2] == [0, 0]
    assert counts("cf", 4, Spec(2, symmetric=True), "symmetric")[1::2] == [0, 0]
    assert counts("rk", 4, Spec(3, symmetric=True), "full")[1::2] == [0, 0]


FILE = """name = "spelled"
family = "rk"
A = [["b1/2"], ["b1", "b2/2"], ["b1", "b2", "b1/2"]]
b = ["b1", "b2", "b1"]
numbers = { b1 = "1.351207191959657634047687808971460826921999~", b2 = "1 - 2*b1" }
[proof]
conditions = "vcg"
order = 4
reduction = "spelling"
"""


def test_it_proves_a_method_that_has_more_conditions_than_coefficients() -> None:
    proof = certify(Tableau.loads(FILE))
    assert proof.facts == (("vcg", 4),)
    assert proof.equations == 1
    (order,) = check(Tableau.loads(FILE), "vcg").orders
    assert (order.order, order.certificate) == (4, "ball")
    without = FILE.replace('reduction = "spelling"\n', "")
    with pytest.raises(NotProved, match="equations for 1 unknowns"):
        certify(Tableau.loads(without))


def test_it_refuses_a_spelling_that_leaves_too_many_conditions() -> None:
    with pytest.raises(NotProved, match="equations for 1 unknowns"):
        certify(Tableau.loads(FILE.replace('["b1", "b2/2"]', '["b1 - 1/9", "b2/2 + 1/9"]')))


def test_it_refuses_digits_that_solve_nothing() -> None:
    with pytest.raises(NotProved, match="does not map the box into itself"):
        certify(Tableau.loads(FILE.replace("1.3512", "1.3513")))


def test_a_whole_family_needs_no_reduction() -> None:
    text = text_of(find("cg4a")).replace("order = 4", 'order = 4\nreduction = "spelling"', 1)
    assert certify(Tableau.loads(text)).equations == 13
