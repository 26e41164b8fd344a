"""The stability study goes on after a method that fails, and on scenes without a reference solution."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from codegen.commands.report import command as report
from codegen.commands.stability import command
from codegen.errors import MethodError
from codegen.lab import subject as lab_subject
from codegen.lab.stability import stability_study
from codegen.method import Method
from codegen.scene.problem import Problem

SINGULAR = """
from sympy import Matrix, Symbol
from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene
y = Symbol("y", real=True)
scene = FieldScene(group=Rn(1), action=LeftMultiplication(), y=Matrix([y]), f=Matrix([y**2]), y0=[1],
    span=(0, 2))
"""
"""The solution is infinite at t = 1."""

RESTING = """
from sympy import Matrix, Rational, symbols
from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene
y = Matrix(symbols("y0:3", real=True))
scene = FieldScene(group=Rn(3), action=LeftMultiplication(), y=y,
    f=Matrix([y[0] / 3, y[0] / 3, y[0] - y[1] + y[2] ** 2]), span=(0, 1),
    y0=[Rational(1, 3), Rational(1, 3), 0])
"""
"""The third coordinate stays zero."""

PARTS = ("orders", "cost", "stability", "long", "emitted")


@pytest.fixture
def refuse_rk4(monkeypatch: pytest.MonkeyPatch) -> None:
    """The methods with the tableau rk4 cannot be compiled."""
    real = stability_study.compile_method

    def compile_method(scene: Problem, method: Method) -> object:
        if method.tableau.name == "rk4":
            raise MethodError("no lowering")
        return real(scene, method)

    monkeypatch.setattr(stability_study, "compile_method", compile_method)
    monkeypatch.setattr(lab_subject, "compile_method", compile_method)


@pytest.mark.usefixtures("refuse_rk4")
def test_a_method_that_cannot_be_emitted_is_a_row_and_the_others_are_tested() -> None:
    words = ["free_rigid_body", "-m", "rkmk(2):rk4", "-m", "cg:cg3", "--quick", "--json"]
    done = CliRunner().invoke(command, words, standalone_mode=False)
    assert done.exception is None
    assert done.return_value == 1
    refused, tested = json.loads(done.output)
    assert (refused["method"], refused["verdict"], refused["failure"]) == (
        "rkmk(2):rk4",
        "fails",
        "no lowering",
    )
    assert (tested["method"], tested["verdict"], tested["failure"]) == ("cg:cg3", "holds", "")
    printed = CliRunner().invoke(command, words[:-1], standalone_mode=False)
    assert "rkmk(2):rk4 on free_rigid_body\n  fails: no lowering\n" in printed.output


def test_a_scene_without_a_reference_is_tested_without_its_largest_step(tmp_path: Path) -> None:
    scene = tmp_path / "singular.py"
    scene.write_text(SINGULAR)
    done = CliRunner().invoke(
        command, [str(scene), "-m", "ambient:rk4", "--quick", "--json"], standalone_mode=False
    )
    assert done.exception is None
    (result,) = json.loads(done.output)
    assert result["largest_step"]["reason"].startswith("not measured: ")
    assert "no reference solution beyond t = " in result["largest_step"]["reason"]
    assert len(result["cases"]) > 10


def test_a_report_of_a_scene_without_a_reference_has_its_other_sections(tmp_path: Path) -> None:
    scene = tmp_path / "singular.py"
    scene.write_text(SINGULAR)
    words = [str(scene), "free_rigid_body", "-m", "ambient:rk4", "--quick", "-o", str(tmp_path), "--json"]
    done = CliRunner().invoke(
        report, [*words, *(w for p in PARTS for w in ("--only", p))], standalone_mode=False
    )
    assert done.exception is None
    assert done.return_value == 1
    singular, good = json.loads(done.stdout)["scenes"]
    assert "no reference solution beyond" in singular["methods"]["failure"]
    assert "no reference solution beyond" in singular["cost"]["failure"]
    assert singular["stability"][0]["largest_step"]["h"] is None
    assert singular["longruns"][0]["method"] == "ambient:rk4"
    assert good["methods"][0]["verdict"] == "holds"
    page = (tmp_path / "singular.html").read_text(encoding="utf-8")
    assert "no reference solution beyond" in page


def test_a_coordinate_that_stays_zero_goes_through_the_whole_report(tmp_path: Path) -> None:
    scene = tmp_path / "resting.py"
    scene.write_text(RESTING)
    done = CliRunner().invoke(
        report,
        [str(scene), "-m", "ambient:rk4", "--quick", "-o", str(tmp_path), "--json"],
        standalone_mode=False,
    )
    assert done.exception is None
    (found,) = json.loads(done.stdout)["scenes"]
    assert found["methods"][0]["verdict"] == "holds"
    assert done.return_value == 0
