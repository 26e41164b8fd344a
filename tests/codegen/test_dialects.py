"""Each C file of generated/ in every dialect, alone and beside the usual headers and other modules."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

from codegen.build import Compiler
from codegen.emitter import emit
from codegen.printers.c.words import RESERVED
from tests.dialects import DIALECTS, HEADERS, objections, standard, surroundings
from tests.promises import usage_program

GENERATED = sorted((Path(__file__).parents[2] / "generated").glob("*/*.c"))

dialects = pytest.mark.parametrize("dialect", [pytest.param(d, id=d or "default") for d in DIALECTS])


@pytest.fixture(scope="module")
def together(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Programs that include all modules and the usual headers, in several orders."""
    folder = tmp_path_factory.mktemp("together")
    for name, text in surroundings(GENERATED).items():
        (folder / name).write_text(text, encoding="utf-8")
    return sorted(folder.iterdir())


@dialects
def test_each_file_and_all_files_beside_the_usual_headers_have_no_warning(
    compiler: Compiler, dialect: str, together: list[Path]
) -> None:
    assert objections(compiler.command[0], dialect, [*GENERATED, *together]) == ""


@pytest.mark.slow
@dialects
@pytest.mark.parametrize("level", ["-O0", "-O2", "-O3"])
def test_an_optimiser_finds_nothing_to_warn_about(
    compiler: Compiler, dialect: str, level: str, together: list[Path]
) -> None:
    """Warnings of uninitialised variables and of array bounds need the analysis of the optimiser."""
    flags = (level, "-S", "-o", "/dev/null")
    assert [objections(compiler.command[0], dialect, [path], *flags) for path in GENERATED] == [""] * len(
        GENERATED
    )


@dialects
def test_examples_in_headers_have_no_warning(compiler: Compiler, dialect: str, tmp_path: Path) -> None:
    for path in GENERATED:
        header = path.with_suffix(".h")
        program = usage_program(path.read_text(encoding="utf-8"))
        assert f'"{header.name}"' in program
        (tmp_path / path.name).write_text(program.replace(f'"{header.name}"', f'"{header}"'), encoding="utf-8")
    assert objections(compiler.command[0], dialect, sorted(tmp_path.iterdir())) == ""


@pytest.mark.parametrize("path", GENERATED, ids=lambda path: path.stem)
def test_static_names_types_and_macros_have_the_prefix(path: Path, tmp_path: Path) -> None:
    prefix = f"{path.stem}_"
    command = ["cc", "-std=c11", "-O0", "-c", "-o", tmp_path / "out.o", path]
    subprocess.run(command, check=True)
    listing = subprocess.run(
        ["nm", "--defined-only", tmp_path / "out.o"], capture_output=True, text=True, check=True
    )
    names = {line.split()[-1].lstrip("_") for line in listing.stdout.splitlines()}
    names = {name for name in names if not name.startswith(".")}  # sections
    text = "".join(p.read_text(encoding="utf-8") for p in (path, path.with_suffix(".h")))
    types = set(re.findall(r"^struct (\w+) \{|^\} (\w+);|^typedef .*\(\*(\w+)\)", text, re.MULTILINE))
    names |= {name for found in types for name in found if name}
    assert f"{prefix}run" in names
    assert [name for name in sorted(names) if not name.startswith(prefix)] == []
    constants = re.findall(r"^#define (\w+)|^ {4}(\w+) = \d,? /\*", text, re.MULTILINE)
    assert len(constants) > 3
    assert [name for pair in constants for name in pair if name and not name.startswith(prefix.upper())] == []


@pytest.mark.parametrize("options", [("-D_GNU_SOURCE",), *(standard(d) for d in DIALECTS)])
def test_no_variable_has_the_name_of_a_macro_of_the_usual_headers(
    compiler: Compiler, options: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "all.c").write_text("".join(f"#include <{name}>\n" for name in HEADERS))
    command = [*compiler.command, *options, "-dM", "-E", tmp_path / "all.c"]
    defined = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    # A macro with arguments leaves a variable alone, because no parenthesis follows the variable.
    macros = set(re.findall(r"^#define ([A-Za-z]\w*)(?: |$)", defined, re.MULTILINE))
    assert "NULL" in macros
    assert sorted(macros - RESERVED) == []


@dialects
@pytest.mark.parametrize(
    ("scene", "method", "options"),
    [
        ("linear_oscillator", "rk4", {"precision": "single", "jacobian": True}),
        ("free_rigid_body", "rkmk:dormand_prince5", {"adaptive": True, "precision": "single"}),
        ("free_rigid_body", "ambient:gauss2", {"adaptive": False, "solver": "newton", "jacobian": True}),
    ],
)
def test_options_add_no_warning(
    compiler: Compiler, dialect: str, scene: str, method: str, options: dict[str, object], tmp_path: Path
) -> None:
    for name, text in emitted(scene, method, tuple(options.items())).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    (source,) = tmp_path.glob("*.c")
    assert objections(compiler.command[0], dialect, [source]) == ""
