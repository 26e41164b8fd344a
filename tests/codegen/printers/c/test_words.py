"""Reserved words of C: keywords, macros of the headers, and each function that printed code calls."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest

from codegen.ir.precision import DOUBLE
from codegen.printers.c.module import helpers
from codegen.printers.c.words import RESERVED
from codegen.run.identifiers import identify
from codegen.run.language import Assign, Function, Return, Unit
from codegen.run.plan import Plan
from codegen.run.terms import Kind, number, own
from codegen.run.unit import unit_of
from codegen.snippets.graph import LIBRARY

HEADERS = ("math.h", "stddef.h", "string.h")
"""The headers that an emitted file includes."""

GENERATED = sorted((Path(__file__).parents[4] / "generated").rglob("*.c"))
STATEMENTS = frozenset({"defined", "error"})
"""Words of the preprocessor; they cannot meet a variable."""


@pytest.mark.parametrize("word", sorted(RESERVED))
def test_no_variable_is_a_reserved_word(word: str) -> None:
    body = (Assign(own(word), number(1.0)), Return(own(word)))
    unit = Unit((), (), (), (Function("f", "", (), body, Kind.REAL),))
    identifier = identify(unit, RESERVED)["f"].of(own(word))
    assert identifier not in RESERVED
    assert re.fullmatch(r"[A-Za-z_]\w*", identifier)


@pytest.mark.parametrize("name", ["single", "rigid", "pendulum", "powers"])
def test_the_library_functions_of_a_unit_are_reserved(kernels: SimpleNamespace, name: str) -> None:
    unit = unit_of(Plan(getattr(kernels, name)(), DOUBLE))
    assert set(helpers(unit)) & set(LIBRARY) <= RESERVED


def called(text: str) -> set[str]:
    """Return the functions that C code calls; keywords have a space before the parenthesis."""
    code = re.sub(r'/\*.*?\*/|"[^"\n]*"', "", text, flags=re.DOTALL)
    return set(re.findall(r"\b([A-Za-z_]\w*)\(", code))


def defined(text: str) -> set[str]:
    """Return the functions that a file defines, at the beginning of a line."""
    return set(re.findall(r"^[a-z][\w ]*[ *](\w+)\(", text, re.MULTILINE))


@pytest.mark.parametrize("path", GENERATED, ids=lambda path: path.stem)
def test_a_library_function_that_emitted_code_calls_is_reserved(path: Path) -> None:
    text = path.read_text()
    assert called(text) - defined(text) - STATEMENTS <= RESERVED


@pytest.mark.skipif(shutil.which("cc") is None, reason="no compiler cc")
@pytest.mark.parametrize("word", ["int", "while", "restrict", "_Bool", "inline", "return"])
def test_the_compiler_refuses_a_keyword_as_a_variable(word: str, tmp_path: Path) -> None:
    assert word in RESERVED
    source = tmp_path / "a.c"
    source.write_text(f"double f(void) {{ double {word} = 1.0; return {word}; }}\n")
    command = ["cc", "-std=c11", "-fsyntax-only", str(source)]
    assert subprocess.run(command, capture_output=True, check=False).returncode != 0


@pytest.mark.skipif(shutil.which("cc") is None, reason="no compiler cc")
def test_macros_of_the_included_headers_are_reserved() -> None:
    source = "".join(f"#include <{header}>\n" for header in HEADERS)
    command = ["cc", "-std=c11", "-dM", "-E", "-x", "c", "-"]
    listing = subprocess.run(command, input=source, capture_output=True, text=True, check=True).stdout
    macros = re.findall(r"^#define ([A-Za-z]\w*) (.+)", listing, re.MULTILINE)
    # A macro that expands to its own name, such as stdin, can be hidden by a variable.
    names = {name for name, text in macros if text != name}
    assert names <= RESERVED
