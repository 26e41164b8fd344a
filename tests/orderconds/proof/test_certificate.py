"""Rounded decimals proved to stand for a true method: what is proved, and what is refused and why."""

from __future__ import annotations

import re
from decimal import Decimal
from pathlib import Path

import pytest

from orderconds import Tableau, check, families
from orderconds.proof.certificate import certify
from orderconds.proof.equations import equations
from orderconds.proof.implications import implied
from orderconds.proof.krawczyk import NotProved
from orderconds.proof.refine import refine
from orderconds.tableau import find

SHIPPED = ["yoshida6", "cg4a", "carpenter_kennedy4"]


def text(name: str) -> str:
    return find(name).read_text(encoding="utf-8")


def kutta3(digits: str, proof: str = 'conditions = "rk"\norder = 3') -> str:
    """Kutta's method with its stage weight and the others as unknowns: four equations."""
    return (
        'name = "kutta"\nfamily = "rk"\nA = [[], ["1/2"], ["x", "y"]]\nb = ["p", "q", "1 - p - q"]\n'
        f'[numbers]\nx = "-1.{digits}~"\ny = "2.{digits}~"\np = "0.16666666666666666666~"\n'
        f'q = "0.66666666666666666667~"\n[proof]\n{proof}\n'
    )


ZEROS = "0" * 20


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_decimals_are_proved_in_every_family_claimed(name: str) -> None:
    tableau = Tableau.load(find(name))
    proof = certify(tableau)
    assert Decimal(proof.radius) < Decimal("1e-59")
    for claim in tableau.claims.orders:
        assert implied(proof.facts, families.get(claim.label), claim.order), claim


@pytest.mark.parametrize("name", SHIPPED)
def test_the_source_prints_numbers_beside_the_solution(name: str) -> None:
    distances = certify(Tableau.load(find(name))).printed
    assert distances
    assert all(0 < Decimal(d) < Decimal("1e-14") for d in distances.values())


def test_a_solution_raises_the_certificate_to_ball_in_the_families_it_implies() -> None:
    report = check(Tableau.loads(text("cg4a")), family="rkmk(1)")
    assert [(f.order, f.certificate) for f in report.orders] == [(3, "ball")]
    assert check("cg4a", family="cg").orders[0].certificate == "ball"


def test_without_a_proof_the_same_decimals_are_only_decimals() -> None:
    bare = re.sub(r"\[proof\].*?(?=\[claims\])", "", text("cg4a"), flags=re.DOTALL)
    assert check(Tableau.loads(bare), family="cg").orders[0].certificate == "decimal"


def test_one_unit_more_in_a_digit_is_no_solution() -> None:
    digits = next(iter(re.findall(r'a21 = "(.*)~"', text("cg4a"))))
    changed = digits[:-2] + str((int(digits[-2]) + 2) % 10) + digits[-1]
    report = check(Tableau.loads(text("cg4a").replace(digits, changed)), family="cg")
    assert report.proof is None
    assert report.verdict == "fails"
    assert "no proof: Krawczyk's operator does not map the box into itself" in report.broken_claims[0]


def test_equations_that_hold_whatever_the_decimals_are_do_not_count() -> None:
    assert certify(Tableau.loads(kutta3(ZEROS, 'conditions = "rk"\norder = 3\npins = ["x"]'))).equations == 3


REFUSED: dict[str, tuple[str, str]] = {
    "too few equations": (
        kutta3(ZEROS),
        '3 equations for 4 unknowns; add 1 of the unknowns to "pins"',
    ),
    "too many equations": (
        kutta3(ZEROS, 'conditions = "rk"\norder = 4\npins = ["x"]'),
        '7 equations for 3 unknowns; add the key "reduction" to [proof]',
    ),
    "not symmetric": (
        text("yoshida6").replace('"g3", "g2", "g1"]', '"g3", "g1", "g2"]'),
        "the formulas in the file do not prove that the method is symmetric",
    ),
    "odd order of a symmetric method": (
        text("yoshida6").replace("order = 6\nreduction", "order = 5\nreduction"),
        "the order of a symmetric method is even",
    ),
    "not low-storage": (
        kutta3(ZEROS, 'conditions = "rk"\norder = 3\nreduction = "low-storage"\npins = ["x"]'),
        "no table [low_storage]",
    ),
    "low-storage in a family without the theorem": (
        text("carpenter_kennedy4").replace('conditions = "rk"', 'conditions = "cf"'),
        'requires conditions = "rk"',
    ),
    "assumptions too weak": (
        kutta3(
            ZEROS,
            'conditions = "rk"\norder = 3\nreduction = "simplifying"\nassumptions = { B = 3, C = 1 }',
        ),
        "the simplifying assumptions imply only order 2, but [proof] states order = 3",
    ),
}


@pytest.mark.parametrize("cause", REFUSED)
def test_no_proof_and_why(cause: str) -> None:
    file, reason = REFUSED[cause]
    with pytest.raises(NotProved, match=re.escape(reason)):
        certify(Tableau.loads(file))


def test_simplifying_assumptions_prove_a_collocation_method() -> None:
    """Gauss 2 with its six coefficients as decimals: B(4), C(2) are six equations."""
    file = (
        'name = "gauss"\nfamily = "rk"\nA = [["p", "-q"], ["r", "u"]]\nb = ["v", "w"]\n[numbers]\n'
        'p = "0.25000000000000000000~"\nq = "0.03867513459481288225~"\nr = "0.53867513459481288225~"\n'
        'u = "0.250000000000000000000~"\nv = "0.50000000000000000000~"\nw = "0.500000000000000000000~"\n'
        '[proof]\nconditions = "rk"\norder = 4\nreduction = "simplifying"\n'
        "assumptions = { B = 4, C = 2, D = 1 }\n"
        "[claims]\nrk = 4\n"
    )
    with pytest.raises(NotProved, match="8 equations for 6 unknowns"):
        certify(Tableau.loads(file))
    fewer = file.replace("order = 4", "order = 3").replace(", D = 1", "").replace("rk = 4", "rk = 3")
    assert certify(Tableau.loads(fewer)).facts == (("rk", 3),)


def test_the_digits_that_a_source_prints_are_refined_and_recorded() -> None:
    short = re.sub(r"(\.\d{13})\d*~", r"\1~", text("cg4a"))
    short = re.sub(
        r"\[proof\].*?(?=\[claims\])", '[proof]\nconditions = "cg"\norder = 4\n\n', short, flags=re.DOTALL
    )
    found = refine(short, digits=40)
    assert len(found.pinned) == 2
    proof = certify(Tableau.loads(found.text))
    assert Decimal(proof.radius) < Decimal("1e-39")
    assert set(proof.printed) == set(found.decimals)
    assert all(Decimal(d) < Decimal("1e-11") for d in proof.printed.values())


def test_refining_what_solves_nothing_is_refused() -> None:
    wrong = text("cg4a").replace('b1 = "0.1', 'b1 = "0.9')
    with pytest.raises(NotProved, match="moved too far from the decimal"):
        refine(wrong)


def test_a_solution_at_which_the_equations_are_singular_is_neither_proved_nor_refined() -> None:
    """The eleven exponentials of order eight in print, listed in tableaux/DECIMAL for this reason."""
    proof = '[proof]\nconditions = "cf_magnus"\norder = 8\nreduction = "symmetric"\n\n[claims]'
    named = text("cf_magnus8_11").replace("[claims]", proof)
    with pytest.raises(NotProved, match="only 17 of the 22 conditions are independent"):
        refine(named)
    with pytest.raises(NotProved):
        certify(Tableau.loads(named))


def test_low_storage_schemes_are_proved_by_the_independent_conditions_of_rooted_trees() -> None:
    named = text("carpenter_kennedy4").replace("order = 4\nreduction", "order = 6\nreduction")
    kept = equations(Tableau.loads(named)).kept
    assert kept is not None
    assert len(kept) == 1 + 1 + 2 + 4 + 9 + 18


@pytest.mark.parametrize(
    ("facts", "label", "order"),
    [
        ([("cg", 4)], "rk", 4),
        ([("cg", 4)], "vcg", 2),
        ([("rk", 6)], "rkmk(2)", 5),
        ([("rk", 6)], "rkmk(3)", 5),
        ([("rk", 6)], "rkmk(4)", 6),
        ([("rk", 4)], "rkmk(0)", 2),
        ([("rk", 4)], "sprk", 2),
        ([("vcg", 3)], "cg", 3),
        ([("composition", 6)], "vcg", 6),
        ([("composition", 6)], "vrkmk(2)", 5),
        ([("sprk", 4)], "vrkmk", 4),
        ([("rk", 1)], "cg", 1),
    ],
)
def test_an_implied_order_and_no_more(facts: list[tuple[str, int]], label: str, order: int) -> None:
    family = families.get(label)
    assert implied(facts, family, order)
    assert not implied(facts, family, order + 1)


def test_a_nystroem_splitting_is_proved_in_both_families_and_implies_order_three_alone_in_the_other() -> None:
    tableau = Tableau.load(find("blanes_moan_rkn6"))
    proof = certify(tableau)
    assert proof.facts == (("rkn", 6), ("splitting", 4))
    assert Decimal(proof.radius) < Decimal("1e-59")
    assert all(0 < Decimal(d) < Decimal("1e-13") for d in proof.printed.values())
    splitting = families.get("splitting")
    assert implied(proof.facts, splitting, 4)
    assert implied(proof.facts[:1], splitting, 3)
    assert not implied(proof.facts[:1], splitting, 4)
    assert {found.family: found.certificate for found in check(tableau).orders} == {
        "splitting": "ball",
        "rkn": "ball",
    }


def test_the_embedded_method_of_a_2n_scheme_is_proved_and_a_changed_digit_is_seen():
    path = find("cf5_2n_s10")
    certificate = certify(Tableau.load(path))
    assert certificate.lower_facts == (("rk", 4), ("cf", 4))
    assert certificate.equations == 17 + 8
    text = Path(path).read_text(encoding="utf-8")
    digits = "0.05966264050678518851276448465631159651893211903217~"
    assert digits in text
    wrong = Tableau.loads(text.replace(digits, digits.replace("0.0596626405", "0.0596626406")))
    assert "fails" in check(wrong, family="cf").verdict or check(wrong).broken_claims
