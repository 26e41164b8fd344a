"""Tableaux that are wrong as published tableaux have been wrong: each rejected for the right reason.

``tests/invalid`` holds one file a trap, each claiming what it would have without its fault.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds.checking import Report, check
from orderconds.cli import program
from orderconds.errors import InputError

FOLDER = Path(__file__).parents[1] / "invalid"

WRONG_ORDER = {
    "cf4_factors_swapped": ("cf", 2, "[.] .", "0.3333333333"),
    "cf4_stage_from_start": ("cf", 1, "[.]", "-0.083333333"),
    "cg3_rows_reversed": ("cg", 2, "[[.]]", "0.4166666666"),
    "cg3_update_reversed": ("cf", 2, "[.] .", "0.3333333333"),
    "cg3_weights_exchanged": ("cg", 1, "[.]", "-0.819444444"),
    "cg4_application_reversed": ("cf", 3, "[[.].]", "0.0833333333"),
    "cg4_wrong_copy": ("cg", 3, "[[.].]", "-0.272244510"),
    "cg4a_application_reversed": ("cf", 3, "[[.].]", "0.0833333333"),
    "cg4a_rows_reversed": ("cg", 2, "[[.]]", "0.3281748646"),
    "cg4a_update_reversed": ("cf", 2, "[.] .", "0.3333333333"),
    "dormand_prince_sign": ("rk", 1, "[.]", "0.0716391509"),
    "fehlberg_digit": ("rk", 1, "[.]", "0.0003189792"),
    "gauss2_as_vcg4": ("vcg", 2, "o(o|L(o))", "0.0111645496"),
    "gauss2_ten_digits": ("rk", 2, "[[.]]", "-2.994783826"),
    "kutta38_sign": ("rk", 1, "[.]", "0.25"),
    "kutta3_better": ("rk", 3, "[[[.]]]", "-0.041666666"),
    "luescher3_digit": ("cf", 1, "[.]", "-0.011424731"),
    "magnus4_bracket_sign": ("magnus", 2, "1 2", "-0.166666666"),
    "mclachlan4_coefficient": ("composition", 2, "1 2", "-0.00102880"),
    "rk4_as_cg4": ("cg", 2, "[.] .", "0.0277777777"),
    "rk4_weight_off": ("rk", 0, ".", "5e-11"),
    "rkmk4_first_stage_again": ("rkmk(2)", 2, "[[.]]", "-0.083333333"),
    "rkmk4_no_brackets": ("rkmk(0)", 2, "[.] .", "0.1666666666"),
    "rkmk4_one_bracket": ("rkmk(1)", 3, "[.] . .", "-0.0625"),
    "strang_half_step": ("splitting", 0, "A", "0.5"),
    "strang_not_symmetric": ("splitting", 1, "AB", "0.5"),
    "suzuki_square_root": ("rk", 2, "[[.]]", "-0.025726163"),
    "triple_jump_plus": ("vcg", 2, "o(o o)", "-0.009621825"),
    "yoshida6_as_printed": ("symmetric_composition", 2, "3", "-8.975558976"),
}
"""File: family, the order it has, the first condition that fails, the first digits of its residual."""

BROKEN_CLAIM = {
    "cf43_embedded_exchanged": "the embedded method has order 2 (cf), not 3 as claimed; [.] .: ",
    "cg4a_proof_digit": "no proof: Krawczyk's operator does not map the box into itself",
    "dormand_prince_fsal": "property fsal: claimed true, computed false",
    "fehlberg_embedded": "the embedded method has order 4 (rk), not 5 as claimed; [[[[.]]]]: ",
    "lobatto3a_l_stable": "property l_stable: claimed true, computed false",
    "rk4_symplectic": "property symplectic: claimed true, computed false",
    "sdirk3_stable": "property a_stable: claimed true, computed false",
    "strang_not_symmetric": "property symmetric: claimed true, computed false",
}

REFUSED = {
    "cf4_embedded_equal": "embedded: an embedded method that is equal to the method itself",
    "coefficient_code": 'b[1]: the character "\'" in',
    "coefficient_divides_by_zero": "b[1]: division by zero",
    "coefficient_explodes": "b[1]: a power of a power needs parentheses in '9^9^9^9'",
    "embedded_equal": "the error estimate would always be zero",
    "name_twice": "Cannot overwrite a value",
    "row_sums": "c_3 = 17/25, but the sum of row 3 of A is 17/24",
    "unknown_family": "unknown_family.toml: claims.rkkm: unknown family 'rkkm'",
}

UNDECIDED = {"gauss2_four_digits": ("rk", 3)}


def checked(name: str) -> Report:
    return check(FOLDER / f"{name}.toml")


def test_every_file_is_expected_to_fail_in_one_way() -> None:
    expected = {*WRONG_ORDER, *BROKEN_CLAIM, *REFUSED, *UNDECIDED}
    assert {path.stem for path in FOLDER.glob("*.toml")} == expected
    assert len(expected) >= 20


@pytest.mark.parametrize("name", WRONG_ORDER)
def test_the_order_is_found_with_the_first_failing_condition_and_its_residual(name: str) -> None:
    family, order, tree, residual = WRONG_ORDER[name]
    report = checked(name)
    assert report.verdict == "fails"
    found = next(f for f in report.orders if f.family == family)
    assert (found.order, found.verdict) == (order, "fails")
    first = found.failing[0]
    assert (first.condition.tree, first.condition.order) == (tree, order + 1)
    assert first.decimal.startswith(residual), first.decimal


@pytest.mark.parametrize("name", BROKEN_CLAIM)
def test_a_claim_that_is_no_order_is_named(name: str) -> None:
    report = checked(name)
    assert report.verdict == "fails"
    assert any(broken.startswith(BROKEN_CLAIM[name]) for broken in report.broken_claims)


@pytest.mark.parametrize("name", REFUSED)
def test_a_file_that_makes_no_sense_is_refused(name: str) -> None:
    with pytest.raises(InputError) as refusal:
        checked(name)
    assert REFUSED[name] in str(refusal.value)


@pytest.mark.parametrize("name", UNDECIDED)
def test_digits_that_cannot_tell_leave_the_order_open(name: str) -> None:
    (found,) = checked(name).orders
    assert (found.family, found.order, found.verdict) == (*UNDECIDED[name], "undecided")


def test_the_command_ends_with_1_for_a_wrong_claim_and_2_for_a_file_without_sense() -> None:
    for name in (*WRONG_ORDER, *BROKEN_CLAIM, *UNDECIDED, *REFUSED):
        result = CliRunner().invoke(program, ["check", str(FOLDER / f"{name}.toml")])
        assert result.exit_code == (2 if name in REFUSED else 1), name
        assert "Traceback" not in result.output


def test_the_order_of_application_in_the_rows_of_cg3_does_not_matter() -> None:
    text = (FOLDER / "cg3_update_reversed.toml").read_text(encoding="utf-8")
    rows, update = '[["119/216"], ["0", "17/108"]]', '[["0", "0", "24/17"], ["0", "-2/3"], ["13/51"]]'
    assert rows in text
    assert update in text
    kept = text.replace(rows, '[["0", "17/108"], ["119/216"]]')
    kept = kept.replace(update, '[["13/51"], ["0", "-2/3"], ["0", "0", "24/17"]]')
    from orderconds import Tableau

    assert check(Tableau.loads(kept)).verdict == "holds"
