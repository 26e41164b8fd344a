"""``orderconds figure`` draws the figures of the gallery and of users' files."""

from __future__ import annotations

import json

from click.testing import CliRunner

from orderconds.cli import program

SCENE = '''"""A point on a circle."""
from codegen.groups import Rn, LeftMultiplication
from codegen.scene import FieldScene
from codegen.scene.figure import PlaneCurves, Run
y = Rn(2).point("y")
scene = FieldScene(
    group=Rn(2), action=LeftMultiplication(), y=y, f=[-y[1], y[0]], y0=[1, 0], span=(0, 1),
)
figures = PlaneCurves(name="spiral", title="Spiral", point=tuple(y), runs=(Run("rk:euler", 0.1, 60),))
'''


def test_a_figure_of_a_user_is_drawn(tmp_path):
    scene, path = tmp_path / "circle.py", tmp_path / "spiral.svg"
    scene.write_text(SCENE, encoding="utf-8")
    words = [str(scene), "spiral", "-o", str(path)]
    result = CliRunner().invoke(program, ["figure", *words])
    assert result.exit_code == 0, result.output
    assert result.stdout == f"Spiral: {path}\n"
    assert str(tmp_path) not in path.read_text(encoding="utf-8")


def test_the_file_and_the_numbers_are_written(tmp_path):
    path = tmp_path / "frozen.svg"
    result = CliRunner().invoke(program, ["figure", "duffing", "frozen", "-o", str(path), "--json"])
    assert result.exit_code == 0
    document = json.loads(result.stdout)
    assert document["name"] == "frozen"
    assert set(document["numbers"]) == {"translations", "SL(2)", "SE(2)"}
    assert path.read_text(encoding="utf-8").startswith("<?xml")


def test_an_unknown_figure_has_the_exit_status_2(tmp_path):
    result = CliRunner().invoke(program, ["figure", "duffing", "frosen", "-o", str(tmp_path / "a.svg")])
    assert result.exit_code == 2
    assert "did you mean frozen?" in result.stderr
    assert not list(tmp_path.iterdir())
