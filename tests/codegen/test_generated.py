"""Each module of generated/ is usable alone: copied to an empty folder, built as its header says, run.

The line that builds it and the example are taken from the file itself, and where the example ends is
compared with the interpreter, which has seen neither.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

from codegen.lab.runner import Interpreted
from codegen.regenerate import entries
from codegen.run.trial import PARTS
from tests.compilations import compiled
from tests.promises import ulps, usage_lines, usage_program

GENERATED = Path(__file__).parents[2] / "generated"
MODULES = [
    pytest.param(path.parent, entry, id=f"{entry['module']}-{entry['target']}")
    for path in sorted(GENERATED.glob("*/manifest.json"))
    for entry in json.loads(path.read_text(encoding="utf-8"))["modules"]
]
OF = {target: [m for m in MODULES if m.values[1]["target"] == target] for target in ("c", "python")}

ROUNDING_ULPS = 2048
"""How far the ends of a hundred steps may be apart: implicit stages are solved to rounding each time."""


@cache
def expected(scene: str, method: str) -> tuple[float, ...]:
    """Where the interpreter is at the end of the span, by the steps of the examples."""
    return Interpreted(compiled(scene, method)).final(PARTS)


def copied(folder: Path, entry: dict[str, object], place: Path) -> str:
    """Copy a module's files into an empty folder; return the text with its header."""
    texts = {name: (folder / name).read_text(encoding="utf-8") for name in entry["files"]}
    for name, text in texts.items():
        (place / name).write_text(text, encoding="utf-8")
    return next(text for name, text in texts.items() if name.endswith((".c", ".py")))


def test_every_listed_module_is_there():
    listed = {(e.scene, e.method, target) for e in entries() for target in e.targets}
    assert {(m.values[1]["scene"], m.values[1]["target"]) for m in MODULES} == {(s, t) for s, _, t in listed}
    assert len(MODULES) == len(listed)


@pytest.mark.parametrize(("folder", "entry"), OF["c"])
def test_c_is_built_by_the_line_in_its_header_and_its_example_runs(folder, entry, tmp_path):
    source = copied(folder, entry, tmp_path)
    (tmp_path / "example.c").write_text(usage_program(source), encoding="utf-8")
    line = re.search(r"^ \* Build: (cc .*)$", source, re.MULTILINE)[1].split()
    assert [word for word in line if word.startswith("-l")] == []
    module = entry["module"]
    for command in (line, [*line[:-1], "example.c"], ["cc", f"{module}.o", "example.o", "-lm", "-o", "run"]):
        made = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert (made.returncode, made.stderr) == (0, "")
    answer = subprocess.run([tmp_path / "run"], capture_output=True, text=True, check=False)
    first, *numbers = answer.stdout.splitlines()
    assert (answer.returncode, first) == (0, f"status 0 after {PARTS} steps")
    assert ulps([float(x) for x in numbers], expected(entry["scene"], entry["method"])) <= ROUNDING_ULPS


def python_in(place: Path, program: str) -> list[float]:
    """Run a program where nothing but the standard library and ``place`` can be imported."""
    start = f"import sys; sys.path.append({str(place)!r})\n{program}"
    command = [sys.executable, "-I", "-S", "-c", start]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (answer.returncode, answer.stderr) == (0, "")
    return [float(word) for word in re.findall(r"[-+.\w]+", answer.stdout)]


@pytest.mark.parametrize(("folder", "entry"), OF["python"])
def test_python_runs_its_example_without_any_package(folder, entry, tmp_path):
    found = python_in(tmp_path, usage_lines(copied(folder, entry, tmp_path)))
    assert ulps(found, expected(entry["scene"], entry["method"])) <= ROUNDING_ULPS


@pytest.mark.parametrize(("folder", "entry"), OF["python"])
def test_python_takes_numpy_states_where_numpy_is_the_only_package(folder, entry, tmp_path):
    copied(folder, entry, tmp_path)
    packages = Path(find_spec("numpy").origin).parents[1]
    for name in ("numpy", "numpy.libs"):  # the second holds the shared libraries of its wheels
        if (packages / name).exists():
            (tmp_path / name).symlink_to(packages / name)
    program = (
        f"import numpy, {entry['module']} as m\n"
        "assert not {'sympy', 'scipy', 'flint', 'codegen', 'orderconds'} & set(sys.modules)\n"
        f"state = numpy.array({entry['initial']})\n"
        f"after = m.step(state, {'0.0, ' if entry['interface']['time'] else ''}numpy.float64(0.01))\n"
        f"assert state.tolist() == {entry['initial']}\n"
        "print(numpy.array(after).tolist())\n"
    )
    assert len(python_in(tmp_path, program)) == entry["interface"]["size"]
