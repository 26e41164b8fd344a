"""What every emitted module promises, as checks that any test may ask for.

C compiles without a warning under the stated flags, exports its prefix and nothing else, and its own usage
example runs clean under the address and undefined behaviour sanitizers; Python runs its usage example with
no package on its path.
"""

from __future__ import annotations

import ast
import math
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import pytest

from codegen.artifact import Artifact
from codegen.build import CompileError, Compiler, compile_files
from codegen.printers.c.module import FLAGS

COMPILERS = ("gcc", "clang")
SANITIZE = (*FLAGS[:1], "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
"""Flags of the sanitizers. With -g, which only adds lines to their reports, gcc takes up to twice as long."""


def exported(path: Path) -> list[str]:
    """Return the names that an object file defines for others."""
    listing = subprocess.run(["nm", "-g", "--defined-only", path], capture_output=True, text=True, check=True)
    return [line.split()[-1] for line in listing.stdout.splitlines() if line]


def promised(emission: Artifact) -> list[str]:
    """Return the names that a header declares, sorted."""
    header = next(text for name, text in emission.files.items() if name.endswith(".h"))
    return sorted(re.findall(r"^int (\w+)\(", header, re.MULTILINE))


def usage_program(source: str) -> str:
    """Return the example in the head of an emitted C file."""
    example = source.partition(" * Use:\n *\n")[2].partition(" */")[0]
    return "".join(re.sub(r"^ \*( {5})?", "", line) for line in example.splitlines(keepends=True))


def usage_lines(source: str) -> str:
    """Return the example in the docstring of an emitted Python module."""
    example = (ast.get_docstring(ast.parse(source)) or "").partition("Use:\n\n")[2]
    return "".join(re.sub(r"^ {4}", "", line) for line in example.splitlines(keepends=True))


@cache
def sanitizes(compiler: Compiler) -> bool:
    """Return whether a compiler links programs with its sanitizers; Debian packages clang's library apart."""
    with tempfile.TemporaryDirectory() as folder:
        source = {"a.c": "int main(void) { return 0; }"}
        try:
            compile_files(source, Path(folder), Path(folder) / "a", SANITIZE, compiler)
        except CompileError:
            return False
    return True


def clean_c(emission: Artifact, compiler: Compiler, folder: Path) -> list[float]:
    """Check what emitted C promises of its text; return the numbers that its example prints."""
    for name in ("object", "sanitized"):
        (folder / name).mkdir()
    compile_files(emission.files, folder / "object", folder / "object/out.o", (*FLAGS, "-c"), compiler)
    prefix = emission.manifest["interface"]["prefix"]
    assert sorted(exported(folder / "object/out.o")) == promised(emission)
    assert {f"{prefix}run", f"{prefix}step"} <= set(promised(emission))
    if not sanitizes(compiler):
        pytest.skip(f"{compiler.command[0]} has no library for its sanitizers")
    source = next(text for name, text in emission.files.items() if name.endswith(".c"))
    files = {**emission.files, "example.c": usage_program(source)}
    compile_files(files, folder / "sanitized", folder / "sanitized/example", SANITIZE, compiler)
    run = subprocess.run([folder / "sanitized/example"], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, ""), run.stdout + run.stderr
    return [float(word) for word in run.stdout.splitlines()[1:]]


def clean_python(emission: Artifact, folder: Path) -> list[float]:
    """Run the example of emitted Python where there is nothing but the module; return what it prints."""
    ((name, source),) = emission.files.items()
    (folder / name).write_text(source, encoding="utf-8")
    (folder / "example.py").write_text(usage_lines(source), encoding="utf-8")
    start = f"import sys, runpy; sys.path.insert(0, {str(folder)!r}); runpy.run_module('example')"
    command = [sys.executable, "-I", "-S", "-c", start]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    return [float(word) for word in re.findall(r"[-+.\w]+", run.stdout)]


def ulps(found: Sequence[float], expected: Sequence[float]) -> float:
    """Return the largest difference, in units in the last place of the largest component, or of one."""
    unit = math.ulp(max(1.0, *map(abs, expected)))
    return max(abs(x - y) for x, y in zip(found, expected, strict=True)) / unit
