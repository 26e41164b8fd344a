"""Emitted C in every dialect: the files of generated/, alone and beside the usual headers and each other."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from codegen.build import Compiler
from codegen.printers.c.words import RESERVED
from tests.dialects import DIALECTS, HEADERS, objections, surroundings
from tests.emissions import emitted
from tests.promises import COMPILERS, usage_program

GENERATED = sorted((Path(__file__).parents[2] / "generated").glob("*/*.c"))

WITH_OPTIONS = (
    ("free_rigid_body", "ambient:radau2a3", (("adaptive", True), ("jacobian", True))),
    ("actuated_rigid_body", "rkmk:gauss2", (("precision", "single"), ("inputs", ("u0",)))),
    ("heavy_top", "slgi:midpoint", (("frame", "body"), ("precision", "single"), ("jacobian", True))),
)

# These dialects lie between C11 and C2x. A file that compiles in both usually compiles in these, too.
BETWEEN = ("c17", "gnu11", "gnu17")

QUICK = [("gcc", d) for d in DIALECTS if d not in BETWEEN] + [("clang", "c2x")]
"""Compilers and dialects of every run: each dialect that is not between others, and each compiler."""

dialects = pytest.mark.parametrize(
    "dialect",
    [pytest.param(d, id=d or "default", marks=[pytest.mark.slow] * (d in BETWEEN)) for d in DIALECTS],
)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """All modules, their examples, modules with options, and programs that include modules and headers."""
    folder = tmp_path_factory.mktemp("dialects")
    texts = surroundings(GENERATED)
    for path in GENERATED:
        header, program = path.with_suffix(".h"), usage_program(path.read_text(encoding="utf-8"))
        assert f'"{header.name}"' in program
        texts[path.name] = program.replace(f'"{header.name}"', f'"{header}"')
    for number, (scene, method, options) in enumerate(WITH_OPTIONS):
        (folder / str(number)).mkdir()
        module = emitted(scene, method, options).files
        texts |= {f"{number}/{name}": text for name, text in module.items()}
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return [*GENERATED, *sorted(folder.rglob("*.c"))]


@pytest.mark.parametrize(
    ("compiler", "dialect"),
    [
        pytest.param(c, d, id=f"{c}-{d or 'default'}", marks=() if (c, d) in QUICK else pytest.mark.slow)
        for c in COMPILERS
        for d in DIALECTS
    ],
    indirect=["compiler"],
)
def test_no_file_has_a_warning_alone_or_beside_the_usual_headers(
    compiler: Compiler, dialect: str, files: list[Path]
) -> None:
    assert len(files) == 2 * len(GENERATED) + len(WITH_OPTIONS) + 3
    assert objections(compiler.command[0], dialect, files) == ""


@pytest.mark.slow
@dialects
@pytest.mark.parametrize("level", ["-O0", "-O2", "-O3"])
def test_an_optimiser_finds_nothing_to_warn_about(
    compiler: Compiler, dialect: str, level: str, files: list[Path], tmp_path: Path
) -> None:
    """Warnings of uninitialised variables and of array bounds need the analysis of the optimiser."""
    flags = (level, "-S", "-o", str(tmp_path / "out.s"))
    assert "".join(objections(compiler.command[0], dialect, [path], *flags) for path in files) == ""


@pytest.mark.parametrize("path", GENERATED, ids=lambda path: path.stem)
def test_static_names_types_and_constants_have_the_prefix(path: Path, tmp_path: Path) -> None:
    prefix, out = f"{path.stem}_", tmp_path / "out.o"
    # Without optimisation, static functions and tables keep their symbols.
    subprocess.run(["cc", "-std=c11", "-O0", "-c", "-o", out, path], check=True)
    listing = subprocess.run(["nm", "--defined-only", out], capture_output=True, text=True, check=True)
    symbols = {line.split()[-1] for line in listing.stdout.splitlines()}
    names = {name for name in symbols if re.fullmatch(r"\w+", name)}  # no labels of the compiler
    text = "".join(p.read_text(encoding="utf-8") for p in (path, path.with_suffix(".h")))
    types = re.findall(r"^struct (\w+) \{|^\} (\w+);|^typedef .*\(\*(\w+)\)", text, re.MULTILINE)
    names |= {name for found in types for name in found if name}
    assert f"{prefix}run" in names
    assert [name for name in sorted(names) if not name.startswith(prefix)] == []
    constants = re.findall(r"^#define (\w+)|^ {4}(\w+) = \d,? /\*", text, re.MULTILINE)
    assert len(constants) > 3
    assert [name for pair in constants for name in pair if name and not name.startswith(prefix.upper())] == []


@pytest.mark.parametrize("options", [("-D_GNU_SOURCE",), ("-std=c11",), ("-std=c2x",), ()])
def test_no_variable_has_the_name_of_a_macro_of_the_usual_headers(
    compiler: Compiler, options: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "all.c").write_text("".join(f"#include <{name}>\n" for name in HEADERS), encoding="utf-8")
    command = [*compiler.command, *options, "-dM", "-E", str(tmp_path / "all.c")]
    defined = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    # A macro with arguments leaves a variable alone, because no parenthesis follows the variable.
    macros = set(re.findall(r"^#define ([A-Za-z]\w*)(?: |$)", defined, re.MULTILINE))
    assert "NULL" in macros
    assert sorted(macros - RESERVED) == []
