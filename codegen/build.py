"""Compile emitted C to a shared object in a cache.

If the cache already contains the shared object for the sources, the compiler and the flags, nothing is
compiled.

Each process compiles in its own temporary folder and writes the finished file atomically into the cache
(:mod:`codegen.cache_entry`).
"""

from __future__ import annotations

import errno
import hashlib
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from codegen.cache_entry import cache_directory, keep, recall, temporary_directory, working_directory
from codegen.printers.c.module import FLAGS
from orderconds.errors import InputError
from orderconds.input_file import reason

UNWRITABLE = (errno.EACCES, errno.EPERM, errno.EROFS)
"""The error numbers (errno) for a folder without write access."""


class CompilerMissing(InputError):
    """Raised if there is no C compiler, or if the command in $CC cannot be run."""


class CompileError(InputError):
    """Raised if the C compiler fails or takes too long.

    If the C compiler fails and prints a message, the error contains this message.
    """


@dataclass(frozen=True)
class Compiler:
    """A C compiler.

    ``command`` contains the name of the program and its options. ``version`` is the first line of output for
    the option ``--version``.
    """

    command: tuple[str, ...]
    version: str


def find_compiler() -> Compiler:
    """Return the C compiler: $CC if it is set, else the first of cc, gcc and clang that exists.

    CompilerMissing is raised if no compiler is found, or if the compiler cannot be run.
    """
    return _find(os.environ.get("CC", ""), os.environ.get("PATH", os.defpath))


@cache
def _find(named: str, path: str) -> Compiler:
    try:
        candidates = [shlex.split(named)] if named.strip() else [["cc"], ["gcc"], ["clang"]]
    except ValueError as error:
        raise CompilerMissing(
            f"{named!r} is not a command: {str(error).lower()}", where="$CC", hint="set CC to a C compiler"
        ) from None
    for words in candidates:
        if shutil.which(words[0], path=path):
            return _identify(tuple(words))
    where = "$CC" if named.strip() else "PATH"
    message = f"the compiler {candidates[0][0]} does not exist" if named.strip() else "no C compiler"
    raise CompilerMissing(
        message, where=where, expected="cc, gcc or clang", hint="install a compiler, or set CC to its command"
    )


def _identify(command: tuple[str, ...]) -> Compiler:
    try:
        answer = subprocess.run(
            [*command, "--version"], capture_output=True, text=True, errors="replace", timeout=60, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CompilerMissing(
            f"the compiler {command[0]} cannot be run: {error}", where="$CC", hint="set CC to a C compiler"
        ) from None
    return Compiler(command, answer.stdout.partition("\n")[0].strip())


def build(
    files: Mapping[str, str],
    flags: tuple[str, ...] = FLAGS,
    compiler: Compiler | None = None,
    *,
    again: bool = False,
    seconds: float | None = None,
) -> Path:
    """Return the path of a shared object compiled from C files. ``files`` maps file names to texts.

    If ``again`` is true, the files are compiled even if the cache contains their shared object. ``seconds``
    is the time limit for the C compiler.

    CompilerMissing is raised if there is no C compiler. CompileError is raised if the compiler fails or
    exceeds the time limit. InputError is raised if the shared object cannot be written.
    """
    compiler = compiler or find_compiler()
    suffix = ".dylib" if sys.platform == "darwin" else ".so"
    name = next(n for n in sorted(files) if n.endswith(".c")).removesuffix(".c")
    key = hashlib.sha256(repr((compiler, flags, sys.platform, sorted(files.items()))).encode()).hexdigest()
    file = f"{name[:200]}-{key[:24]}{suffix}"
    directory, lasting = cache_directory(), True
    while again or recall(directory / file) is None:
        try:
            with working_directory(directory) as folder:
                shared = (*flags, "-fPIC", "-shared")
                compile_files(files, folder, folder / "out", shared, compiler, seconds)
                keep(directory / file, (folder / "out").read_bytes())
            break
        except OSError as error:
            if error.errno not in UNWRITABLE or not lasting:
                raise InputError(
                    f"cannot write to this path: {reason(error)}",
                    where=str(directory),
                    hint="free some space, or set XDG_CACHE_HOME to another folder",
                ) from None
            directory, lasting = temporary_directory(f"{directory}: {reason(error)}"), False
    return directory / file


def compile_seconds(files: Mapping[str, str]) -> float:
    """Compile the files of a module without the cache, and return the elapsed time in seconds."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        flags = (*FLAGS, "-fPIC", "-shared")
        compile_files(files, Path(folder), Path(folder) / "out", flags, find_compiler())
        return time.perf_counter() - start


def compile_files(
    files: Mapping[str, str],
    directory: Path,
    output: Path,
    flags: tuple[str, ...],
    compiler: Compiler,
    seconds: float | None = None,
) -> None:
    """Write files into a directory, and compile the C files to the file ``output``.

    CompileError is raised if the compiler fails or exceeds the time limit ``seconds``. CompilerMissing is
    raised if the compiler does not exist.
    """
    for name, text in files.items():
        (directory / name).write_text(text, encoding="utf-8")
    sources = [name for name in sorted(files) if name.endswith(".c")]
    libraries = () if "-c" in flags else ("-lm",)
    command = [*compiler.command, *flags, "-o", str(output), *sources, *libraries]
    # The compiler writes its temporary files to ``directory``. The caller removes ``directory``.
    environment = {**os.environ, "TMPDIR": str(directory)}
    try:
        answer = _finished(command, directory, environment, seconds)
    except FileNotFoundError:
        raise CompilerMissing(
            f"the compiler {compiler.command[0]} no longer exists", where="$CC", hint="set CC to a C compiler"
        ) from None
    except subprocess.TimeoutExpired:
        raise CompileError(
            f"{compiler.command[0]} did not compile the module within {seconds:g} seconds",
            where=", ".join(sources),
            hint="choose a method with fewer stages or a lower order",
        ) from None
    if answer.returncode or not output.exists():
        words = (answer.stderr or answer.stdout).strip()
        did = f"rejected the source (status {answer.returncode})" if answer.returncode else "wrote no output"
        raise CompileError(
            f"{compiler.command[0]} {did}" + (f":\n{words}" if words else ""),
            where=", ".join(sources),
            hint=f"the compiler is {compiler.version or compiler.command[0]}; set CC to use another one",
        )


def _finished(
    command: Sequence[str], directory: Path, environment: Mapping[str, str], seconds: float | None
) -> subprocess.CompletedProcess[str]:
    """Run a compiler and return its exit status and output.

    If TimeoutExpired or another exception is raised, all processes of the compiler are killed.
    """
    # One signal kills the process group: the compiler and the programs that the compiler starts.
    with subprocess.Popen(
        command,
        cwd=directory,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        process_group=0,
    ) as process:
        try:
            output, messages = process.communicate(timeout=seconds)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
    return subprocess.CompletedProcess(command, process.returncode, output, messages)
