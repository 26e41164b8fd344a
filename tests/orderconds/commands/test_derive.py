"""``orderconds derive``: counts, formats, and conditions written out for a number of stages."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from orderconds import families
from orderconds.cli import program
from orderconds.derivation import derive
from orderconds.formula import coefficients
from orderconds.formula.notation import LATEX


def run(*args: str) -> Result:
    return CliRunner().invoke(program, ["derive", *args])


def derived(*args: str) -> Any:
    result = run(*args, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


@pytest.mark.parametrize(
    ("family", "counts"),
    [
        ("rk", [1, 1, 2, 4, 9]),
        ("sprk", [1, 1, 3, 8]),
        ("cg", [1, 1, 3, 8]),
        ("cf", [1, 1, 3, 8]),
        ("rkmk", [1, 1, 2, 4, 9]),
        ("rkmk(2)", [1, 1, 2, 4]),
        ("rkmk(1)", [1, 1, 2, 5]),  # one that no tableau meets
        ("vcg", [1, 1, 6]),
    ],
)
def test_counts_of_independent_conditions(family: str, counts: list[int]) -> None:
    record = derived(family, "--order", str(len(counts)))
    assert list(record) == ["family", "order", "counts", "conditions"]
    assert (record["family"], record["order"], record["counts"]) == (family, len(counts), counts)
    assert [sum(c["order"] == n for c in record["conditions"]) for n in range(1, len(counts) + 1)] == counts
    assert all(list(c) == ["order", "tree", "expression", "latex", "rhs"] for c in record["conditions"])


def test_the_generating_set_of_rkmk_is_named_beside_its_independent_conditions() -> None:
    last = run("rkmk", "--order", "4").stdout.splitlines()[-1]
    assert last.startswith(
        "A method on a group has order p if the conditions of orders 1 to p hold for all Lyndon words "
        "over ordered trees. Starting with order 1, the numbers of these conditions are 1, 1, 3, 8. "
    )


def test_all_prints_the_condition_of_every_tree() -> None:
    assert derived("vcg", "--order", "3", "--all")["counts"] == [1, 3, 17]


def test_dependent_conditions_say_what_they_equal() -> None:
    lines = run("vcg", "--order", "2", "--all").stdout.splitlines()
    assert "  tree      condition                                  equals" in lines
    assert any(line.startswith("  o(|L(o))") and line.endswith("1/2 <o> <o>") for line in lines)
    assert "% equals <o(o)>" in run("vcg", "--order", "2", "--all", "--format", "latex").stdout


@pytest.mark.parametrize("family", families.with_conditions())
def test_explanations_name_what_each_condition_is_about(family: str) -> None:
    result = run(family, "--order", "2", "--explain")
    assert result.exit_code == 0
    record = derived(family, "--order", "2", "--explain")
    assert result.stdout.count("    condition  ") == len(record["conditions"])
    assert all(condition["names"] for condition in record["conditions"])


def test_the_explanation_of_a_condition() -> None:
    out = run("vcg", "--order", "2", "--explain").stdout
    assert "  o(o)\n      ●\n      └▸●\n      names      H_q(H_m)\n" in out
    assert "% names H_q(H_m)" in run("vcg", "--order", "2", "--explain", "--format", "latex").stdout


def test_explicit_methods_have_fewer_coefficients() -> None:
    args = ("rk", "--order", "2", "--stages", "2", "--explicit")
    assert [c["expression"] for c in derived(*args)["conditions"]] == ["b_1 + b_2", "b_2 a_21"]


def test_text_has_the_six_conditions_of_vcg_order_3() -> None:
    result = run("vcg", "--order", "3")
    assert "order 3: 6 conditions" in result.stdout
    assert "sum_i b_i c_i^2 = 1/3" in result.stdout
    assert "sum_{i,j} b_i a_ij c_j = 1/6" in result.stdout


def test_latex_has_one_environment_and_a_tree_and_a_label_for_each_condition() -> None:
    lines = run("rk", "--order", "3", "--format", "latex").stdout.splitlines()
    first, last = lines.index(r"\begin{alignat}{2}"), lines.index(r"\end{alignat}")
    rows = [line for line in lines[first + 1 : last] if not line.lstrip().startswith("%")]
    assert len(rows) == 4
    assert all(r"\tikz[tree]{" in row and "&=" in row for row in rows)
    labels = ["rk:1:1", "rk:2:1", "rk:3:1", "rk:3:2"]
    assert [re.findall(r"\\label\{(.*?)\}", row) for row in rows] == [[label] for label in labels]
    assert sum(row.endswith(r"\\") for row in rows) == 3


@pytest.mark.parametrize("family", families.with_conditions())
def test_latex_defines_every_symbol(family: str) -> None:
    order = families.get(family).order_bound or 3
    *_, sentence = run(family, "--order", str(order), "--format", "latex").stdout.splitlines()
    found = {c.name for x in derive(family, order) for c in coefficients(x.formula)}
    for name in found:
        shown = LATEX.names.get(name, name)
        assert re.search(rf"(?:^|[ $,;]){re.escape(shown)}_", sentence), (name, sentence)


def test_the_option_output_writes_what_stdout_shows(tmp_path: Path) -> None:
    file = tmp_path / "conditions.tex"
    result = run("vcg", "--order", "2", "--format", "latex", "-o", str(file))
    assert (result.exit_code, result.stdout) == (0, "")
    assert file.read_text(encoding="utf-8") == run("vcg", "--order", "2", "--format", "latex").stdout


def test_sympy_form_reads_back_in_sympy() -> None:
    sympy = pytest.importorskip("sympy")
    lines = run("rk", "--order", "2", "--stages", "2", "--format", "sympy").stdout.splitlines()
    assert len(lines) == 2
    names = {name: sympy.IndexedBase(name) for name in "ab"}
    assert all(isinstance(sympy.sympify(line, locals=names), sympy.Eq) for line in lines)


def test_written_out_for_two_stages() -> None:
    expressions = [c["expression"] for c in derived("rk", "--order", "2", "--stages", "2")["conditions"]]
    assert expressions == ["b_1 + b_2", "b_1 a_11 + b_1 a_12 + b_2 a_21 + b_2 a_22"]


@pytest.mark.parametrize(
    "family", [name for name in families.with_conditions() if families.get(name).formats[0] == "rk"]
)
@pytest.mark.parametrize("explicit", [False, True])
def test_written_out_conditions_have_the_values_of_the_engine(family: str, explicit: bool) -> None:
    from orderconds.derivation import derive
    from orderconds.ring import QQ
    from orderconds.stage_expansion import expand_stages
    from orderconds.tableau import RungeKutta
    from tests.oracles.index_sums import value as brute_force

    entries = [QQ.rational(k * k - 7, 5 + k) for k in range(6)]
    A, b = (tuple(entries[:2]), tuple(entries[2:4])), tuple(entries[4:])
    if explicit:
        A = ((QQ.zero, QQ.zero), (entries[2], QQ.zero))
    derivation = derive(family, order=families.get(family).order_bound or 3)
    engine = families.get(family).evaluate(RungeKutta(A, b), QQ, derivation.conditions)
    at = {"a": A, "b": b}
    for condition, value in zip(
        expand_stages(derivation, 2, explicit=explicit).conditions, engine, strict=True
    ):
        assert brute_force(condition.formula, QQ, at, {"1": 0, "2": 1}) == value


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["vgc", "--order", "3"], "vcg"),
        (["rk", "--order", "0"], "--order"),
        (["rk"], "--order"),
        (["rk", "--order", "2", "--format", "word"], "--format"),
        (["cf", "--order", "2", "--stages", "2"], "stages: "),
        (["rk(1)", "--order", "2"], "rk"),
        (["rk", "--order", "2", "--explicit"], "--stages"),
        (["rkn", "--order", "2", "--stages", "2", "--explicit"], "family rkn has no explicit methods"),
        (["rk", "--order", "2", "--json", "--format", "latex"], "--json and --format latex"),
        (["rk", "--order", "2", "-p", "3"], "--order is given twice"),
    ],
)
def test_bad_usage_exits_2_with_one_message(args: list[str], said: str) -> None:
    result = run(*args)
    assert result.exit_code == 2
    assert result.stdout == "" or "error" in json.loads(result.stdout)
    assert isinstance(result.exception, SystemExit)
    assert said in result.stderr
    assert result.stderr.count("\n") == 1


def test_output_does_not_depend_on_the_hash_seed() -> None:
    def output(seed: str) -> str:
        command = [sys.executable, "-m", "orderconds", "derive", "vcg", "--order", "3", "--json"]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        return subprocess.run(command, capture_output=True, text=True, env=environment, check=True).stdout

    assert output("0") == output("1") == output("4242")


def test_right_hand_sides_are_fractions() -> None:
    assert all(Fraction(c["rhs"]) > 0 for c in derived("rk", "--order", "4")["conditions"])


@pytest.mark.parametrize(
    ("family", "order", "trees"), [("rk", 13, 12486), ("vcg", 7, 51677), ("splitting", 17, 7710)]
)
def test_an_order_with_more_trees_than_can_be_derived_is_refused_at_once(
    family: str, order: int, trees: int
) -> None:
    result = run(family, "--order", "20")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"orderconds: {family}: there are {trees} trees of order {order}; ")
    assert f"lower the order to {order - 1}" in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [("-s 6 --order 6", "about "), pytest.param("-s 4 --order 6", "", marks=pytest.mark.slow)],
)
def test_more_terms_than_can_be_written_are_refused(words: str, said: str) -> None:
    result = CliRunner().invoke(program, ["derive", "rkmk", "--all", *words.split()])
    assert result.exit_code == 2
    assert re.search(
        rf"the conditions have {said}\d+ terms; expected at most \d+; lower the order", result.stderr
    )


def test_an_explanation_that_a_format_cannot_contain_is_refused() -> None:
    result = run("rk", "-p", "3", "--format", "sympy", "--explain")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "--explain has no effect with --format sympy" in result.stderr
    for form in ("text", "latex", "json"):
        explained = run("rk", "-p", "3", "--format", form, "--explain")
        assert explained.exit_code == 0
        assert explained.stdout != run("rk", "-p", "3", "--format", form).stdout
