"""The dialects, warnings and headers with which every emitted C file compiles."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path

DIALECTS = ("c11", "c17", "c2x", "gnu11", "gnu17", "")
"""Values of -std; an empty text is the default of the compiler."""

WARNINGS = ("-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion", "-Wshadow", "-Werror")

HEADERS = ("math.h", "stdio.h", "stdlib.h", "string.h", "unistd.h", "complex.h", "strings.h")


def standard(dialect: str) -> tuple[str, ...]:
    """Return the option that chooses a dialect."""
    return (f"-std={dialect}",) if dialect else ()


def surroundings(files: Iterable[Path]) -> dict[str, str]:
    """Return programs that include all files: after the headers, before them, and with GNU extensions."""
    headers = [f"#include <{name}>" for name in HEADERS]
    modules = [f'#include "{path}"' for path in files]
    extended = ["#define _GNU_SOURCE", *headers, *modules, *headers]
    programs = {"after.c": [*headers, *modules], "before.c": [*modules, *headers], "extended.c": extended}
    return {name: "\n".join((*lines, "")) for name, lines in programs.items()}


def objections(compiler: str, dialect: str, files: Iterable[Path], *flags: str) -> str:
    """Return the warnings and errors of a compiler about files, each of which is compiled separately."""
    command = [compiler, *standard(dialect), *WARNINGS, *(flags or ("-fsyntax-only",)), *map(str, files)]
    return subprocess.run(command, capture_output=True, text=True, check=False).stderr
