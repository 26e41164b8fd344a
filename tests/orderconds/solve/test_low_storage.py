"""``solve --low-storage``: two registers, the conditions of rooted trees, the error and order on groups."""

from __future__ import annotations

import shlex

import pytest
from click.testing import CliRunner

from orderconds import families, solve
from orderconds.checking import check, read
from orderconds.cli import program
from orderconds.errors import InputError
from orderconds.solve.certify_solution import principal_error
from orderconds.solve.parametrise import structures
from orderconds.solve.problem import Problem
from orderconds.solve.spec import Spec
from orderconds.tableau import Tableau

TWO = Spec(3, low_storage=True)


def test_williamsons_scheme_is_found_from_two_of_its_coefficients() -> None:
    found = solve("cf", 3, 3, low_storage=True, fix=("A2=-5/9", "B1=1/3"))
    assert found.tableau.method == read("williamson3").method
    assert found.certificate == "exact"
    assert "--low-storage" in found.command


@pytest.mark.parametrize("order", [3, 4, 5])
def test_the_equations_are_those_of_rooted_trees(order: int) -> None:
    rk = families.get("rk")
    every = [c for n in range(1, order + 1) for c in rk.conditions(n)]
    problem = Problem("cf", order, Spec(len(every), low_storage=True), "low-storage")
    assert list(problem.conditions) == every


def test_two_conditions_of_order_six_follow_from_the_others() -> None:
    problem = Problem("cf", 6, Spec(20, low_storage=True), "low-storage")
    assert len(problem.conditions) == 35


def test_a_scheme_found_with_these_equations_has_its_order_on_groups() -> None:
    text = solve("cf", 5, 4, low_storage=True, starts=64).tableau
    report = check(text, certified=True)
    assert {x.family: x.order for x in report.orders} == {"rk": 4, "cf": 4, "vcf": 2}
    assert report.properties["low_storage"] is True


@pytest.mark.parametrize("family", ["rk", "cf"])
def test_the_error_is_that_of_the_requested_family(family: str) -> None:
    found = solve(family, 3, 3, low_storage=True, fix=("A2=-5/9", "B1=1/3"))
    assert found.error_norm == principal_error(found.tableau, family, 4)
    assert found.error_norm != principal_error(found.tableau, {"rk": "cf", "cf": "rk"}[family], 4)


@pytest.mark.parametrize(
    ("family", "spec", "found", "where"),
    [
        (
            "cf",
            {"fix": ("A1=1",)},
            "'--fix A1=1' contradicts 'the register K is zero at the start of a step (A1 = 0)'",
            "constraints",
        ),
        (
            "cf",
            {"exponentials": 3},
            "--exponentials is not available for family cf with --low-storage",
            "solve",
        ),
        ("cf", {"dirk": True}, "--dirk is not available for family cf with --low-storage", "solve"),
        ("rk", {"symmetric": True}, "--symmetric is not available for family rk with --low-storage", "solve"),
        ("cf", {"fsal": True}, "--fsal is not available for family cf with --low-storage", "solve"),
        ("cf", {"fix": ("a31=1/2",)}, "unknown coefficient 'a31' in 'a31=1/2'", "--fix"),
        ("vcg", {}, "the option --low-storage with family vcg", "solve"),
    ],
)
def test_contradictory_constraints_are_refused(
    family: str, spec: dict[str, object], found: str, where: str
) -> None:
    with pytest.raises(InputError) as refusal:
        Problem(family, 3, Spec(3, low_storage=True, **spec), "low-storage").ansatz.symbolic()
    assert (refusal.value.found, refusal.value.where) == (found, where)


def test_there_is_one_structure() -> None:
    assert structures("cf", TWO) == ("low-storage",)


def test_the_command_writes_the_two_registers() -> None:
    result = CliRunner().invoke(
        program,
        shlex.split("solve cf --low-storage --stages 3 --order 3 --fix A2=-5/9 --fix B1=1/3 --processes 1"),
    )
    assert result.exit_code == 0, result.stderr
    assert '[low_storage]\nA = ["0", "-5/9", "A3"]\nB = ["1/3", "B2", "B3"]\n' in result.stdout
    assert Tableau.loads(result.stdout).method == read("williamson3").method
