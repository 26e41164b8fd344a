"""Scenes and tableaux with extreme numbers are compiled or refused in one line: no internal error.

Programs overflow, or iterate away, in the steps that suit moderate numbers. The check of a pass then compares
them in shorter steps and in many digits.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from pathlib import Path

import pytest

from orderconds.cli import program
from orderconds.tableau import find

PAGE = Path(__file__).parents[3] / "docs/howto/scene.md"


def scene(folder: Path, *changes: tuple[str, str]) -> str:
    """Write the heavy top of the documentation with some words replaced, and return its path."""
    text = PAGE.read_text(encoding="utf-8").partition("# top.py")[2].partition("```")[0]
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / "top.py").write_text("# top.py" + text, encoding="utf-8")
    return str(folder / "top.py")


def tableau(folder: Path, name: str, old: str, new: str) -> str:
    """Write a tableau of the library, without its claims, with one coefficient replaced."""
    text = find(name).read_text(encoding="utf-8").partition("[claims]")[0]
    assert old in text
    path = folder / "changed.toml"
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    return str(path)


Emission = Callable[[str, str], tuple[int, str]]


@pytest.fixture
def emitted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Emission:
    """Return a function from a scene and a method to the status of the program and its stderr."""

    def run(scene: str, method: str) -> tuple[int, str]:
        out = tmp_path / "out"
        arguments = ["emit", scene, "--method", method, "--target", "python", "-o", str(out)]
        with pytest.raises(SystemExit) as ended:
            program.main(arguments, prog_name="orderconds")
        for path in out.glob("*.py"):
            ast.parse(path.read_text(encoding="utf-8"))
        status = ended.value.code or 0
        assert isinstance(status, int)
        return status, capsys.readouterr().err

    return run


HEAVY = [(('weight", 1)', f'weight", 10**{power})'),) for power in (4, 6)]
STIFF = (
    ("diag(1, 1, 2)", "diag(1, 2, 1) / 10**6"),
    (', "axial": P[2]', ""),
)


@pytest.mark.parametrize(
    ("changes", "method"),
    [
        (HEAVY[0], "ambient:dop853"),
        (HEAVY[1], "ambient:dop853"),
        (HEAVY[1], "rkmk(5):fehlberg8"),
        pytest.param(STIFF, "ambient:lobatto3a4", marks=pytest.mark.slow),
        pytest.param((*STIFF, *HEAVY[0]), "ambient:lobatto3a4", marks=pytest.mark.slow),
    ],
)
def test_a_scene_with_large_numbers_is_compiled(
    changes: tuple[tuple[str, str], ...], method: str, tmp_path: Path, emitted: Emission
) -> None:
    status, said = emitted(scene(tmp_path, *changes), method)
    assert status == 0
    assert all(line.startswith("warning: ") for line in said.splitlines())


@pytest.mark.parametrize(
    ("where", "family", "name", "old"),
    [
        ("free_rigid_body", "cf", "cf4", '"-1/2", "0", "1"'),
        pytest.param("dipole", "vcf", "cf4", '"-1/2", "0", "1"', marks=pytest.mark.slow),
        ("driven_spin", "cg", "gauss1", '"1/2"'),
        ("free_rigid_body", "cg", "rk4", '"0", "0", "1"'),
        ("free_rigid_body", "rkmk(3)", "dormand_prince5", '"1/5"'),
    ],
)
def test_a_tableau_with_a_huge_coefficient_is_compiled(
    where: str, family: str, name: str, old: str, tmp_path: Path, emitted: Emission
) -> None:
    huge = old.rpartition('"1')[0] + '"10^64"'
    path = tableau(tmp_path, name, old, huge)
    status, said = emitted(where, f"{family}:{path}")
    assert status == 0
    assert all(line.startswith("warning: ") for line in said.splitlines())


def test_a_coefficient_beyond_the_format_is_refused(tmp_path: Path, emitted: Emission) -> None:
    path = tableau(tmp_path, "rk4", '"0", "0", "1"', '"0", "0", "10^310"')
    status, said = emitted("free_rigid_body", f"cg:{path}")
    assert (status, said.count("\n")) == (2, 1)


@pytest.mark.parametrize("family", ["vcg", "vrkmk(1)", "slgi"])
def test_a_weight_that_may_be_zero_is_refused(family: str, tmp_path: Path, emitted: Emission) -> None:
    path = tmp_path / "wide.toml"
    path.write_text('name = "wide"\nfamily = "rk"\nA = [["1/2"]]\nb = ["0.1~"]\n', encoding="utf-8")
    status, said = emitted("linear_oscillator", f"{family}:{path}")
    assert status == 2
    assert said.startswith(f"orderconds: {family}:wide: b_1 = ")
    assert said.count("\n") == 1
    assert "may be zero" in said


def test_a_scene_extended_by_u_has_an_ambient_equation(emitted: Emission) -> None:
    assert emitted("linear_oscillator+u", "ambient:rk4") == (0, "")


def test_a_field_that_is_nowhere_finite_is_refused(tmp_path: Path, emitted: Emission) -> None:
    """The field of the scene is finite, but H = T + V overflows with the square of this momentum."""
    path = scene(tmp_path, ("mu0=Matrix([1, 0, 3])", "mu0=Matrix([10**200, 0, 3 * 10**200])"))
    status, said = emitted(path, "rkmk(1):rk4")
    assert (status, said.count("\n")) == (2, 1)
    assert "internal" not in said


@pytest.mark.parametrize("power", [100, 300])
def test_a_parameter_near_the_largest_double_is_compiled(
    power: int, tmp_path: Path, emitted: Emission
) -> None:
    path = scene(tmp_path, ('weight", 1)', f'weight", 10**{power})'))
    assert emitted(path, "rkmk(1):rk4") == (0, "")
