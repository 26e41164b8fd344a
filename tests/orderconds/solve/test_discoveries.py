"""What the solver found and the library ships: reproducible, proved, better than what it is compared with.

That the orders are those of the local error on three groups, from below and above, is what
``tests/orderconds/test_second_route.py`` computes for every claim of every file.
"""

from __future__ import annotations

import json
import re
import shlex

import pytest
from click.testing import CliRunner

from orderconds.checking import check, read
from orderconds.cli import program
from orderconds.ring import QQ
from orderconds.solve.certify_solution import principal_error
from orderconds.solve.parametrise import ansatz
from orderconds.solve.solver import Order, solve
from orderconds.solve.spec import Spec
from orderconds.tableau import Tableau, available, find
from orderconds.tableau.file import text_of

FOUND = [name for name in available() if Tableau.load(find(name)).bibtex == "orderconds"]


def test_there_are_discoveries() -> None:
    assert {"vcf_gauss2", "vcf_gauss3"} <= set(FOUND)


@pytest.mark.parametrize("name", FOUND)
def test_a_discovery_is_certified_in_every_family_it_serves(name: str) -> None:
    assert check(name, complete=True, certified=True).verdict == "holds"


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in FOUND if name.startswith(("vcf", "vcg3"))])
def test_its_command_finds_it_again(name: str) -> None:
    text = text_of(find(name))
    (command,) = re.findall(r'^source = "(orderconds solve .*)"$', text, re.MULTILINE)
    result = CliRunner().invoke(
        program, [*shlex.split(command)[1:], "--name", name, "--processes", "1", "--json"]
    )
    assert result.exit_code == 0, result.stderr
    found = json.loads(result.stdout)
    if "[proof]" not in text:
        written = [line for line in text.splitlines() if line and not line.startswith(("#", "bibtex"))]
        assert [line for line in found["tableau"].splitlines() if line] == written
        return
    # Digits where an error is least hang on the last bits of a processor's arithmetic; its value does not.
    family = command.split()[2]
    assert found["certificate"] == "ball"
    shipped = principal_error(Tableau.loads(text), family, found["order"] + 1)
    assert found["error_norm"] == pytest.approx(shipped, rel=1e-2)


def test_the_two_stage_method_is_symmetric_with_positive_weights() -> None:
    tableau = read("vcf_gauss2")
    assert [tableau.ring.text(x) for x in tableau.abelian().b] == ["1/2", "1/2"]
    spelled = ansatz("vcf", Spec(2, symmetric=True), "symmetric")
    free = {"b1_1": "1/4 + sqrt(3)/6", "b1_2": "1/4 - sqrt(3)/6", "a1_2_1": "-sqrt(3)/6", "a1_2_2": "0"}
    again = Tableau.loads(spelled.text(free))
    assert again.method == tableau.method


def test_the_three_stage_method_has_the_weights_and_sums_of_gauss() -> None:
    total, gauss = read("vcf_gauss3").abelian(), read("gauss3")
    found = read("vcf_gauss3")
    assert [found.ring.text(x) for x in total.b] == [
        QQ.text(x) for x in map(QQ.rational, (5, 4, 5), (18, 9, 18))
    ]
    assert [found.ring.approximate(x, 15) for row in total.A for x in row] == [
        gauss.ring.approximate(x, 15) for row in gauss.method.A for x in row
    ]


@pytest.mark.slow
def test_five_stages_have_half_of_the_error_of_suzukis_composition() -> None:
    found = solve(Order("vcg", 4, Spec(5), minimised=True, starts=128)).solution
    assert found is not None
    assert found.certificate == "ball"
    suzuki = principal_error(read("suzuki4"), "vcg", 5)
    assert found.error is not None
    assert suzuki is not None
    assert 2 * found.error < suzuki
