"""The wheel and the source archive contain what the program needs: it works where there is no clone."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

import click
import pytest

from orderconds.cli import program

ROOT = Path(__file__).parents[1]
pytestmark = pytest.mark.slow

COMMANDS = {
    "bench": "free_rigid_body --method cf:cf4 --budget 0.001",
    "check": "cg3 --family cg",
    "cite": "cg3",
    "completion": "bash",
    "construct": "gauss --stages 2 --output gauss2.toml",
    "converge": "free_rigid_body --method cf:cf4",
    "convert": "rk4 --to csv",
    "derive": "vcg --order 3",
    "emit": "free_rigid_body --method cf:cf4 --target c --target python --output out",
    "extend": "rk4 --order 3",
    "list": "",
    "localerror": "free_rigid_body --method cf:cf4",
    "longrun": "free_rigid_body --method cf:cf4 --steps 400 --no-rounding",
    "modified": "midpoint --order 3",
    "recommend": "free_rigid_body --error 1e-4 --tableau cf4 --budget 5",
    "refine": "yoshida6.toml --output refined.toml",
    "regenerate": "--output generated",
    "report": "free_rigid_body --method cf:cf4 --quick --output report",
    "series": "bch --order 3",
    "solve": "rk --stages 2 --order 2 --explicit --output found.toml",
    "stability": "free_rigid_body --method cf:cf4 --quick",
    "table": "",
    "trees": "rooted --order 4 --svg trees.svg",
}
"""Each command with arguments that take seconds."""


@pytest.fixture(scope="session")
def archives(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the wheel and the source archive, and return their folder."""
    folder = tmp_path_factory.mktemp("dist")
    _run([sys.executable, "-m", "hatchling", "build", "-d", str(folder)], ROOT)
    return folder


@pytest.fixture(scope="session")
def installed(archives: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Install the wheel in a new environment, without network, and return the folder of its programs.

    The dependencies are those of this environment: a path file adds its packages, but not its own
    installation of this project.
    """
    place = tmp_path_factory.mktemp("environment")
    _run([sys.executable, "-m", "venv", str(place)], place)
    programs = place / "bin"
    (wheel,) = archives.glob("*.whl")
    pip = [str(programs / "python"), "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", str(wheel)]
    _run(pip, place)
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages = place / "lib" / version / "site-packages"
    paths = [sysconfig.get_path("purelib"), sysconfig.get_path("platlib")]
    (packages / "dependencies.pth").write_text("\n".join(dict.fromkeys(paths)) + "\n", encoding="utf-8")
    return programs


def _run(command: list[str], folder: Path) -> str:
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COV"))}
    done = subprocess.run(command, cwd=folder, env=kept, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}"
    return done.stdout


def test_every_command_is_tried() -> None:
    assert sorted(COMMANDS) == sorted(program.list_commands(click.Context(program)))


def test_the_packages_of_the_wheel_are_used(installed: Path, tmp_path: Path) -> None:
    code = "import codegen, orderconds; print(orderconds.__file__, codegen.__file__)"
    files = _run([str(installed / "python"), "-c", code], tmp_path).split()
    assert all(Path(file).is_relative_to(installed.parent) for file in files)


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_works_outside_of_the_clone(name: str, installed: Path, tmp_path: Path) -> None:
    shutil.copy(ROOT / "tableaux/composition/yoshida6.toml", tmp_path)
    assert _run([str(installed / "orderconds"), name, *COMMANDS[name].split()], tmp_path) or any(
        path.name != "yoshida6.toml" for path in tmp_path.iterdir()
    )


def test_the_plugin_of_pytest_works_outside_of_the_clone(installed: Path, tmp_path: Path) -> None:
    shutil.copy(ROOT / "tableaux/cg/cg3.toml", tmp_path)
    assert "1 passed" in _run([str(installed / "python"), "-m", "pytest", "--orderconds", "."], tmp_path)


def test_the_python_interface_works_outside_of_the_clone(installed: Path, tmp_path: Path) -> None:
    code = (
        "import codegen, orderconds\n"
        "assert orderconds.check('cg3').verdict == 'holds'\n"
        "integrator = codegen.load(codegen.emit('free_rigid_body', 'cf4', target='c'))\n"
        "print(round(integrator.run([0.6, 0.0, 0.8], h=0.1, steps=10)[0], 6))\n"
    )
    assert _run([str(installed / "python"), "-c", code], tmp_path) == "0.511554\n"


def test_the_wheel_has_every_file_of_the_packages_and_all_tableaux(archives: Path) -> None:
    (wheel,) = archives.glob("*.whl")
    names = set(zipfile.ZipFile(wheel).namelist())
    for package in ("orderconds", "codegen"):
        files = [p for p in (ROOT / package).rglob("*") if p.is_file() and "__pycache__" not in p.parts]
        assert {p.relative_to(ROOT).as_posix() for p in files} <= names
    tableaux = [p for p in (ROOT / "tableaux").rglob("*") if p.is_file()]
    assert {f"orderconds/_tableaux/{p.relative_to(ROOT / 'tableaux').as_posix()}" for p in tableaux} <= names


def test_the_source_archive_gives_the_same_wheel(archives: Path, tmp_path: Path) -> None:
    (source,) = archives.glob("*.tar.gz")
    with tarfile.open(source) as archive:
        archive.extractall(tmp_path, filter="data")
    (folder,) = tmp_path.iterdir()
    _run([sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path / "dist")], folder)
    (wheel,) = archives.glob("*.whl")
    (again,) = (tmp_path / "dist").glob("*.whl")
    assert again.read_bytes() == wheel.read_bytes()
