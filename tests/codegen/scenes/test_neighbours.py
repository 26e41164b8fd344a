"""Scene files that import modules beside them."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from codegen import scenes
from codegen.errors import SceneError

SCENE = '''"""{about}"""
from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene
{imports}

y = Rn(1).point("y")
scene = FieldScene(group=Rn(1), action=LeftMultiplication(), y=y, f=[-y[0]], y0=[START], span=(0, 1))
'''


def write(folder: Path, start: str, imports: str = "from constants import START") -> str:
    folder.mkdir()
    (folder / "constants.py").write_text(
        f"from fractions import Fraction\nSTART = {start}\n", encoding="utf-8"
    )
    (folder / "decay.py").write_text(SCENE.format(about="Decay.", imports=imports), encoding="utf-8")
    return str(folder / "decay.py")


def first(path: str) -> str:
    return str(scenes.load(path).state[0].initial[0])


def test_neighbours_of_the_same_name_are_those_of_each_scene(tmp_path: Path) -> None:
    one, two = write(tmp_path / "one", "0.5"), write(tmp_path / "two", "0.25")
    before = dict(sys.modules), list(sys.path), list(sys.meta_path)
    assert [first(path) for path in (one, two, one)] == ["1/2", "1/4", "1/2"]
    assert "constants" not in sys.modules
    assert (sys.path, sys.meta_path) == before[1:]
    assert not list(tmp_path.rglob("__pycache__"))


def test_a_changed_neighbour_is_read_again(tmp_path: Path) -> None:
    path = write(tmp_path / "one", "0.5")
    assert first(path) == "1/2"
    (tmp_path / "one" / "constants.py").write_text("START = 0.7\n", encoding="utf-8")
    assert first(path) == "7/10"


def test_modules_of_the_caller_return(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = type(sys)("constants")
    monkeypatch.setitem(sys.modules, "constants", own)
    assert first(write(tmp_path / "one", "0.5")) == "1/2"
    assert sys.modules["constants"] is own


def test_packages_and_their_modules_are_neighbours(tmp_path: Path) -> None:
    path = write(tmp_path / "one", "0", "from model.data import START")
    (tmp_path / "one" / "model").mkdir()
    (tmp_path / "one" / "model" / "__init__.py").write_text("", encoding="utf-8")
    (tmp_path / "one" / "model" / "data.py").write_text("from constants import START as zero\nSTART = 3\n")
    assert first(path) == "3"
    assert not {"model", "model.data", "constants"} & set(sys.modules)


def test_a_neighbour_hides_no_installed_module(tmp_path: Path) -> None:
    path = write(tmp_path / "one", "2")
    for name in ("sympy", "random", "codegen"):
        (tmp_path / "one" / f"{name}.py").write_text("raise RuntimeError\n", encoding="utf-8")
    assert first(path) == "2"


def test_an_error_in_a_neighbour_names_the_line_of_the_scene(tmp_path: Path) -> None:
    path = write(tmp_path / "one", "1/0")
    with pytest.raises(SceneError, match=r"decay\.py:4: the scene raises ZeroDivisionError"):
        scenes.load(path)
    assert "constants" not in sys.modules
