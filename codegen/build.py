"""Compile emitted C to a shared object, once: results are kept by content and compiler identity.

Nothing half built ever carries its final name: the compiler writes into a directory of its own inside the
cache, and ``os.replace`` puts the finished file in place, so that two processes may build the same thing.
"""

from __future__ import annotations

import hashlib
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from codegen.printers.c.module import FLAGS
from orderconds.errors import InputError


class CompilerMissing(InputError):
    """There is no C compiler, or the one that $CC names is not there."""


class CompileError(InputError):
    """The compiler refused the source; its message is part of ours."""


@dataclass(frozen=True)
class Compiler:
    """A C compiler: its command line words and the first line with which it tells its version."""

    command: tuple[str, ...]
    version: str


def find_compiler() -> Compiler:
    """Return the C compiler: $CC if it is set, else the first of cc, gcc and clang that is there.

    A CompilerMissing says what was looked for.
    """
    return _find(os.environ.get("CC", ""), os.environ.get("PATH", os.defpath))


@cache
def _find(named: str, path: str) -> Compiler:
    try:
        candidates = [shlex.split(named)] if named.strip() else [["cc"], ["gcc"], ["clang"]]
    except ValueError as error:
        raise CompilerMissing(
            f"cannot read {named!r}: {str(error).lower()}", where="$CC", hint="set CC to a C compiler"
        ) from None
    for words in candidates:
        if shutil.which(words[0], path=path):
            return _identify(tuple(words))
    where = "$CC" if named.strip() else "PATH"
    found = f"{candidates[0][0]} is not there" if named.strip() else "no C compiler"
    raise CompilerMissing(
        found, where=where, expected="cc, gcc or clang", hint="install one, or set CC to its command"
    )


def _identify(command: tuple[str, ...]) -> Compiler:
    try:
        answer = subprocess.run(
            [*command, "--version"], capture_output=True, text=True, errors="replace", timeout=60, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CompilerMissing(
            f"{command[0]} does not run: {error}", where="$CC", hint="set CC to a C compiler"
        ) from None
    return Compiler(command, answer.stdout.partition("\n")[0].strip())


def cache_directory() -> Path:
    """Return where shared objects are kept: $XDG_CACHE_HOME/orderconds, else ~/.cache/orderconds."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(base) if os.path.isabs(base) else Path.home() / ".cache") / "orderconds"


def build(files: Mapping[str, str], flags: tuple[str, ...] = FLAGS, compiler: Compiler | None = None) -> Path:
    """Return the path of a shared object made of C files (name -> text); built only when it is not cached.

    Errors: CompilerMissing, CompileError.
    """
    compiler = compiler or find_compiler()
    suffix = ".dylib" if sys.platform == "darwin" else ".so"
    name = next(n for n in sorted(files) if n.endswith(".c")).removesuffix(".c")
    key = hashlib.sha256(repr((compiler, flags, sys.platform, sorted(files.items()))).encode()).hexdigest()
    directory = cache_directory()
    target = directory / f"{name}-{key[:24]}{suffix}"
    if target.exists():
        return target
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=directory, prefix="building-") as made:
            compile_files(files, Path(made), Path(made) / "out", (*flags, "-fPIC", "-shared"), compiler)
            os.replace(Path(made) / "out", target)
    except OSError as error:
        raise InputError(
            f"cannot write there: {error.strerror}",
            where=str(directory),
            hint="set XDG_CACHE_HOME to a directory that can be written",
        ) from None
    return target


def compile_files(
    files: Mapping[str, str], directory: Path, output: Path, flags: tuple[str, ...], compiler: Compiler
) -> None:
    """Write files into a directory and compile its C sources; a CompileError if that fails."""
    for name, text in files.items():
        (directory / name).write_text(text, encoding="utf-8")
    sources = [name for name in sorted(files) if name.endswith(".c")]
    libraries = () if "-c" in flags else ("-lm",)
    command = [*compiler.command, *flags, "-o", str(output), *sources, *libraries]
    answer = subprocess.run(
        command, cwd=directory, capture_output=True, text=True, errors="replace", check=False
    )
    if answer.returncode or not output.exists():
        words = (answer.stderr or answer.stdout).strip()
        did = f"refused it (status {answer.returncode})" if answer.returncode else "wrote nothing"
        raise CompileError(
            f"{compiler.command[0]} {did}" + (f":\n{words}" if words else ""),
            where=", ".join(sources),
            hint=f"the compiler is {compiler.version or compiler.command[0]}; CC chooses another",
        )
