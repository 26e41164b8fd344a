"""The order of a continuous extension is computed: polynomial identities in theta, exact and complete."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from pathlib import Path

import pytest
from click.testing import CliRunner

from orderconds import check
from orderconds.checking.continuous import extension_order
from orderconds.cli import program
from orderconds.errors import TableauError
from orderconds.families import get
from orderconds.ring import QQ
from orderconds.tableau import RungeKutta, Tableau, dumps
from orderconds.tableau.library import available
from orderconds.tableau.record import from_data

EXTENDED = {
    "heun_euler": 2,
    "kutta3": 2,
    "bogacki_shampine3": 3,
    "rk4": 3,
    "merson4": 3,
    "dormand_prince5": 4,
    "fehlberg5": 3,
    "cash_karp5": 3,
    "verner6": 4,
}
MIDPOINT = 'name = "mine"\nfamily = "rk"\nA = [[], ["1/2"]]\nb = ["0", "1"]\n[dense]\n'


def test_every_extension_of_the_library_is_listed_here() -> None:
    assert sorted(EXTENDED) == sorted(n for n in available() if Tableau.load(n).extension is not None)


@pytest.mark.parametrize("name", EXTENDED)
def test_extensions_of_the_library_have_their_claimed_order(name: str) -> None:
    dense = check(name, family="rk").dense
    assert dense is not None
    assert (dense.claimed, dense.order, dense.certificate) == (EXTENDED[name], EXTENDED[name], "exact")
    assert dense.continuous is True
    assert dense.smooth is (Tableau.load(name).claims.properties.get("fsal") is True)


@pytest.mark.parametrize("name", EXTENDED)
def test_at_each_theta_the_weights_satisfy_the_conditions_of_a_step_of_length_theta(name: str) -> None:
    """A second route: the scaled method (A, b(theta)) with A / theta and b / theta has the order q."""
    tableau, family = Tableau.load(name), get("rk")
    extension, method = tableau.extension, tableau.method
    assert extension is not None
    assert isinstance(method, RungeKutta)
    generator = random.Random(name)
    for _ in range(3):
        theta = Fraction(generator.randint(1, 40), generator.randint(41, 60))
        x = QQ.rational(theta.numerator, theta.denominator)
        b = extension.combined(tuple(x ** (p - 1) for p in range(1, extension.degree + 1)))
        A = tuple(tuple(a / x for a in row) for row in method.A)
        for n in range(1, EXTENDED[name] + 2):
            conditions = family.conditions(n)
            values = family.evaluate(RungeKutta(A, b), QQ, conditions)
            exact = [QQ.rational(c.rhs.numerator, c.rhs.denominator) for c in conditions]
            holds = [QQ.is_zero(v - r) for v, r in zip(values, exact, strict=True)]
            assert all(holds) is (n <= EXTENDED[name])


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ('order = 2\nb = [["1", "-1"], ["0", "1"]]', ""),
        ('order = 1\nb = [["1", "-1"], ["0", "1"]]', "has order 2, not 1 as claimed"),
        ('order = 3\nb = [["1", "-1"], ["0", "1"]]', "has order 2, not 3 as claimed"),
        ('order = 2\nb = [["1", "-1"], ["0", "1/2"]]', "has order 0, not 2 as claimed; theta^2, "),
        ('order = 1\nb = [["1"]  , []]', "does not end at the new state"),
        ('order = 1\nb = [["1"], ["0"]]', "does not end at the new state"),
    ],
)
def test_a_wrong_extension_is_reported(entries: str, message: str) -> None:
    report = check(Tableau.loads(MIDPOINT + entries + "\n[claims]\nrk = 2\n"))
    assert report.verdict == ("fails" if message else "holds")
    assert any(message in x for x in report.broken_claims) is bool(message)


def test_a_digit_that_is_off_by_little_is_found() -> None:
    text = dumps(Tableau.load("rk4")).replace('"-2/3"', '"-200000001/300000000"', 1)
    assert "200000001" in text
    dense = extension_order(Tableau.loads(text))
    assert dense is not None
    assert (dense.order, dense.continuous) == (0, False)
    assert str(dense.failing[0]).startswith("theta^3, ")


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ('order = 2\nb = [["1", "-1"]]', r"dense.b: 1 rows; expected 2 rows"),
        ("order = 2\nb = [[], []]", "polynomials of degree 0; expected a degree from 1 to 40"),
        ('order = 2\nb = [["1", "x"], ["0", "1"]]', r"dense.b\[1\]\[2\]"),
        ('b = [["1", "-1"], ["0", "1"]]', "no order"),
        ('order = 2\nc = 1\nb = [["1", "-1"], ["0", "1"]]', "unknown key 'c'"),
    ],
)
def test_a_malformed_extension_is_refused(entries: str, message: str) -> None:
    with pytest.raises(TableauError, match=message):
        Tableau.loads(MIDPOINT + entries + "\n")


def test_extensions_survive_conversion_to_toml_and_json() -> None:
    tableau = Tableau.load("dormand_prince5")
    again = Tableau.loads(dumps(tableau))
    assert again.extension == tableau.extension
    done = CliRunner().invoke(program, ["convert", "dormand_prince5", "--to", "json"])
    assert done.exit_code == 0, done.output
    assert from_data(json.loads(done.stdout)).extension == tableau.extension


@pytest.mark.parametrize("order", [None, 2])
def test_the_command_extend_writes_an_extension_that_check_proves(order: int | None, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    options = [] if order is None else ["--order", str(order)]
    done = CliRunner().invoke(program, ["extend", "ralston3", "-o", str(path), "--json", *options])
    assert done.exit_code == 0, done.output
    record = json.loads(done.stdout)
    assert record["dense"] == {
        "claimed": 2,
        "order": 2,
        "certificate": "exact",
        "continuous": True,
        "smooth": False,
    }
    checked = CliRunner().invoke(program, ["check", str(path), "--json"])
    assert checked.exit_code == 0
    assert json.loads(checked.stdout)[0]["dense"] == record["dense"]


def test_extend_names_what_is_impossible() -> None:
    for words, message in (
        (["ralston3", "--order", "3"], "give no continuous extension of order 3"),
        (["cf4"], "a tableau of format cf"),
    ):
        done = CliRunner().invoke(program, ["extend", *words])
        assert done.exit_code == 2
        assert message in done.stderr
        assert "Traceback" not in done.stderr


def test_extend_writes_no_wrong_claim(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(MIDPOINT.replace("[dense]", "[claims]\nrk = 3\nsymplectic = true"))
    done = CliRunner().invoke(program, ["extend", str(path), "-o", str(path)])
    assert done.exit_code == 2
    assert "rk: claimed order 3, computed order 2" in done.stderr
    assert "property symplectic: claimed true, computed false" in done.stderr
    assert "dense" not in path.read_text()


def test_extensions_over_number_fields_are_exact() -> None:
    from orderconds.solve.extension import extended

    dense = check(extended(Tableau.load("kvaerno3")), family="rk").dense
    assert dense is not None
    assert (dense.order, dense.certificate, dense.continuous, dense.smooth) == (3, "exact", True, True)
