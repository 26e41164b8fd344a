"""check: the exact order, the first failing conditions with their residuals, and the certificate."""

from __future__ import annotations

import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds import Tableau, check, families
from orderconds.cli import program
from orderconds.errors import InputError, UnknownName, ZeroWeight
from orderconds.tableau.library import available, root


def rk(A: str, b: str, claims: str = "", name: str = "method") -> Tableau:
    return Tableau.loads(
        f'name = "{name}"\nfamily = "rk"\nA = {A}\nb = {b}\nsource = "a test"\n[claims]\n{claims}'
    )


RK4 = ('[[], ["1/2"], ["0", "1/2"], ["0", "0", "1"]]', '["1/6", "1/3", "1/3", "1/6"]')
CG3 = ('[[], ["3/4"], ["119/216", "17/108"]]', '["13/51", "-2/3", "24/17"]')


def order(tableau: Tableau, family: str) -> int:
    return check(tableau, family=family).orders[0].order


def test_an_exact_tableau_is_certified_exact() -> None:
    report = check(rk(*RK4, "rk = 4"))
    assert report.verdict == "holds"
    assert [(f.family, f.claimed, f.order, f.certificate) for f in report.orders] == [("rk", 4, 4, "exact")]


def test_the_first_failing_order_has_all_its_failing_conditions_with_exact_residuals() -> None:
    (found,) = check(rk('[[], ["1/2"]]', '["0", "1"]'), family="rk").orders
    assert found.order == 2
    assert [(f.condition.tree, f.condition.order, f.residual) for f in found.failing] == [
        ("[[.]]", 3, "-1/6"),
        ("[..]", 3, "-1/12"),
    ]
    assert found.error_norm == pytest.approx(float(Fraction(5, 144)) ** 0.5, rel=1e-14)


@pytest.mark.parametrize("claimed", [3, 5])
def test_a_claim_is_an_equality(claimed: int) -> None:
    report = check(rk(*RK4, f"rk = {claimed}"))
    assert (report.verdict, report.orders[0].verdict, report.orders[0].order) == ("fails", "fails", 4)


def test_a_perturbation_of_5e_minus_11_is_seen_with_its_residual() -> None:
    off = Fraction(1, 6) + Fraction(5, 10**11)
    report = check(rk(RK4[0], f'["{off}", "1/3", "1/3", "1/6"]', "rk = 4"))
    (found,) = report.orders
    assert (report.verdict, found.order) == ("fails", 0)
    assert [(f.condition.tree, f.residual) for f in found.failing] == [(".", "1/20000000000")]


def test_cg3_with_the_two_coefficients_of_its_third_row_exchanged_has_order_2() -> None:
    assert order(rk(*CG3), "cg") == 3
    exchanged = rk(CG3[0].replace('"119/216", "17/108"', '"17/108", "119/216"'), CG3[1])
    assert order(exchanged, "cg") == 2


def test_the_order_required_stands_in_place_of_the_claims_and_is_a_lower_bound() -> None:
    assert check(rk(*RK4, "rk = 3"), order=4).verdict == "holds"
    assert check(rk(*RK4, "rk = 4"), order=3).verdict == "holds"
    assert check(rk(*RK4, "rk = 4"), order=5).verdict == "fails"


def test_a_family_asked_for_is_checked_alone_claimed_or_not() -> None:
    report = check(rk(*RK4, "rk = 4"), family="cg")
    assert [(f.family, f.claimed) for f in report.orders] == [("cg", None)]
    assert report.verdict == "unclaimed"


def test_without_claims_the_family_of_the_format_is_checked() -> None:
    assert [f.family for f in check(rk(*RK4)).orders] == ["rk"]


class TestBalls:
    """A ball never proves zero."""

    @staticmethod
    def midpoint(half: str, claims: str = "rk = 2") -> Tableau:
        return rk(f'[["{half}"]]', '["1"]', claims)

    def test_sixteen_digits_support_the_order_and_the_certificate_is_decimal(self) -> None:
        (found,) = check(self.midpoint("0.5000000000000000~")).orders
        assert (found.order, found.verdict, found.certificate) == (2, "holds", "decimal")

    def test_two_digits_leave_the_order_undecided(self) -> None:
        report = check(self.midpoint("0.50~"))
        (found,) = report.orders
        assert (report.verdict, found.verdict, found.order, found.failing) == (
            "undecided",
            "undecided",
            1,
            (),
        )
        assert found.certificate == "none"
        assert report.undecided["a_stable"] == "rounded decimals"

    def test_a_ball_that_excludes_zero_proves_that_the_condition_fails(self) -> None:
        (found,) = check(self.midpoint("0.50000001000~")).orders
        assert (found.order, found.verdict) == (1, "fails")
        assert abs(Decimal(found.failing[0].decimal) - Decimal("1e-8")) < Decimal("1e-11")


def test_a_claimed_property_that_does_not_hold_fails_and_is_named() -> None:
    report = check(rk(*RK4, "rk = 4\nsymplectic = true"))
    assert report.verdict == "fails"
    assert any("symplectic" in claim for claim in report.broken_claims)
    assert check(rk(*RK4, "rk = 4\nsymplectic = false\nexplicit = true")).verdict == "holds"


def test_an_embedded_row_has_the_order_it_states() -> None:
    def with_embedded(b: str, stated: int) -> str:
        text = f'name = "m"\nfamily = "rk"\nA = {CG3[0]}\nb = {CG3[1]}\nsource = "a test"\n'
        return check(Tableau.loads(f"{text}embedded = {{ b = {b}, order = {stated} }}\n")).verdict

    assert with_embedded('["17/54", "19/54", "1/3"]', 2) == "unclaimed"
    assert with_embedded('["17/54", "19/54", "1/3"]', 3) == "fails"
    with pytest.raises(InputError, match="the error estimate would always be zero"):
        with_embedded(CG3[1], 2)


def test_an_unknown_family_is_an_input_error() -> None:
    with pytest.raises(UnknownName):
        check(rk(*RK4), family="cgg")


def test_a_zero_weight_where_the_family_divides_by_it_is_an_input_error() -> None:
    with pytest.raises(ZeroWeight, match="b_1"):
        check(rk('[[], ["1/2"]]', '["0", "1"]'), family="sprk")


def test_a_format_the_family_cannot_read_is_an_input_error() -> None:
    cf3 = Tableau.loads(
        'name = "m"\nfamily = "cf"\nsource = "a test"\n'
        '[[stage]]\n[[stage]]\nexp = [["1/2"]]\n[update]\nexp = [["0", "1"]]\n'
    )
    assert order(cf3, "rk") == 2
    with pytest.raises(InputError, match="vcg"):
        check(cf3, family="vcg")


def test_every_family_that_takes_it_finds_order_1_of_the_euler_method() -> None:
    euler = rk("[[]]", '["1"]')
    for name in families.names():
        if name == "symplectic_rk" or "rk" not in families.get(name).formats:
            continue
        assert order(euler, name) == 1, name


def test_json_of_a_report_has_the_documented_keys() -> None:
    record = check(rk(*RK4, "rk = 3")).as_json()
    assert list(record) == [
        "name",
        "file",
        "format",
        "verdict",
        "orders",
        "properties",
        "work",
        "low_storage",
        "symmetry",
    ]
    (found,) = record["orders"].values()  # type: ignore[attr-defined]
    assert list(found) == ["claimed", "order", "verdict", "certificate", "failing", "error_norm"]
    assert list(found["failing"][0]) == ["order", "tree", "expression", "residual"]


def test_a_demand_for_certificates_refuses_decimals_but_those_that_are_listed(tmp_path: Path) -> None:
    decimal = 'name = "half"\nfamily = "rk"\nA = [["0.50000000000000000~"]]\nb = ["1"]\n[claims]\nrk = 2\n'
    report = check(Tableau.loads(decimal), certified=True)
    assert report.broken_claims == ("rk: certificate decimal",)
    (tmp_path / "half.toml").write_text(decimal, encoding="utf-8")

    def status() -> int:
        return CliRunner().invoke(program, ["check", "--certified", str(tmp_path)]).exit_code

    assert status() == 1
    (tmp_path / "DECIMAL").write_text("# why\nhalf: a test\n", encoding="utf-8")
    assert status() == 0


def test_at_most_five_tableaux_of_the_library_are_decimals_each_with_a_reason() -> None:
    lines = (root() / "DECIMAL").read_text(encoding="utf-8").splitlines()
    listed = [line for line in lines if line and not line.startswith("#")]
    assert len(listed) <= 5
    for line in listed:
        name, _, reason = line.partition(":")
        assert name in available()
        assert reason.strip()


@pytest.mark.parametrize("name", ["rk4", "vcg4_s6", "cf5_s7", "cf_magnus8", "lobatto3ab5"])
def test_a_check_imports_no_numerical_library(name: str) -> None:
    code = (
        "import sys; from orderconds.checking import check; check(sys.argv[1]);"
        "print([m for m in ('sympy', 'networkx', 'numpy', 'scipy', 'matplotlib') if m in sys.modules])"
    )
    found = subprocess.run([sys.executable, "-c", code, name], check=True, capture_output=True, text=True)
    assert found.stdout.strip() == "[]"


PAIR = """name = "pair"
family = "prk"
A = [[], ["1"]]
b = ["1/2", "1/2"]
A_hat = [[], ["1"]]
b_hat = ["1/3", "2/3"]
[claims]
"""


@pytest.mark.parametrize("name", ["sprk_separable", "prk_same_weights"])
def test_a_claim_in_a_family_without_the_method_is_refuted(name: str, tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    path.write_text(f"{PAIR}prk = 1\n{name} = 2\n")
    report = check(path)
    assert report.verdict == "fails"
    (broken,) = report.broken_claims
    assert broken.startswith(f"{name}: the method is not in this family, because b_1 ")
    assert [(f.family, f.verdict) for f in report.orders] == [("prk", "holds")]
    assert CliRunner().invoke(program, ["check", str(path)]).exit_code == 1
    # The option --family names the family of the user, so the input is wrong.
    with pytest.raises(InputError, match=f"family {name}"):
        check(path, family=name)


def test_a_report_without_orders_has_no_table(tmp_path: Path) -> None:
    path = tmp_path / "alone.toml"
    path.write_text(f"{PAIR}sprk_separable = 2\n")
    done = CliRunner().invoke(program, ["check", str(path)])
    assert done.exit_code == 1
    assert "claim fails: sprk_separable: the method is not in this family" in done.output
    assert "error norm" not in done.output
