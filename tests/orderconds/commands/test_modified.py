"""``orderconds modified``: terms as text and JSON, and one message for bad input."""

from __future__ import annotations

import json

import pytest
from click.testing import CliRunner, Result

from orderconds.cli import program


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["modified", *args])


def test_the_implicit_midpoint_rule_has_the_published_modified_equation() -> None:
    # HLW IX.9 gives h^2 (f'f'f/12 - f''(f, f)/24) and H~ = H - h^2/24 H''(f, f).
    lines = run("midpoint", "--order", "3").stdout.splitlines()
    assert [line.split(maxsplit=3) for line in lines[2:5]] == [
        ["1", ".", "1", "f"],
        ["3", "[[.]]", "1/12", "f'(f'(f))"],
        ["3", "[..]", "-1/24", "f''(f, f)"],
    ]
    assert lines[-1].split(maxsplit=3) == ["3", "[..]", "-1/24", "H''(f, f)"]


def test_a_method_that_is_not_symplectic_has_no_hamiltonian_in_text_or_json() -> None:
    assert "Hamiltonian" not in run("rk4", "--order", "5").stdout
    assert json.loads(run("rk4", "--order", "5", "--json").stdout)["hamiltonian"] is None


def test_json_has_exact_and_decimal_coefficients() -> None:
    record = json.loads(run("gauss2", "--order", "5", "--json").stdout)
    assert (record["tableau"], record["family"], record["order"]) == ("gauss2", "rk", 5)
    assert record["modifying"] is False
    last = record["terms"][-1]
    assert last == {
        "order": 5,
        "tree": "[....]",
        "name": "f^(4)(f, f, f, f)",
        "coefficient": "-1/4320",
        "approximate": "-0.00023148148148148148",
    }


def test_lie_group_families_give_commutators() -> None:
    record = json.loads(run("rk4", "--family", "rkmk(1)", "--order", "4", "--json").stdout)
    assert [(t["coefficient"], t["name"]) for t in record["terms"]] == [
        ("1", "f"),
        ("-1/96", "[[f[f], f], f]"),
    ]


def test_the_modifying_equation_of_a_method_is_printed_on_request() -> None:
    record = json.loads(run("euler", "--order", "2", "--modifying", "--json").stdout)
    assert record["modifying"] is True
    assert [t["coefficient"] for t in record["terms"]] == ["1", "1/2"]


@pytest.mark.parametrize(
    "args",
    [
        ["no_such_tableau", "--order", "3"],
        ["rk4"],
        ["rk4", "--order", "0"],
        ["rk4", "--order", "3", "--family", "magnus"],
        ["strang", "--order", "3"],
        ["cf4", "--order", "3", "--modifying"],
    ],
)
def test_bad_usage_exits_2_with_one_message(args: list[str]) -> None:
    result = run(*args)
    assert (result.exit_code, result.stdout, result.stderr.count("\n")) == (2, "", 1)


def test_the_examples_of_the_help_run() -> None:
    text = run("--help").stdout
    examples = [
        line.split("modified ", 1)[1] for line in text.splitlines() if "  orderconds modified " in line
    ]
    assert len(examples) == 4
    for example in examples:
        assert run(*example.replace('"', "").split()).exit_code == 0
