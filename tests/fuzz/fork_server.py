"""Runs command lines in forks of one process that has imported everything.

Reads one request a line from stdin, ``{"words": [...], "folder": "..."}``, and answers each with one line,
the fields of :class:`Ending`. A fork works in the folder and writes its output there. It is the real program:
its own limits and signals.
"""

from __future__ import annotations

import importlib
import json
import os
import pkgutil
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from types import FrameType

import codegen
import orderconds

SECONDS = 20
"""CPU time after which a line is interrupted, as by Ctrl-C."""

MEGABYTES = 2048
"""Memory that a line may take; the limit of the operating system is higher, so that the excess is seen."""

OUT, ERR = "stdout.captured", "stderr.captured"

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Ending:
    """How a line ended: exit status (minus the signal), CPU seconds, memory, and what it needed to end."""

    status: int
    seconds: float
    megabytes: int
    interrupted: bool
    left_processes: bool


@contextmanager
def running(cache: Path) -> Iterator[subprocess.Popen[str]]:
    """Start a server; ``cache`` is the cache folder of its lines."""
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": str(cache),
        "XDG_CACHE_HOME": str(cache),
        "PYTHONPATH": str(ROOT),
        "OPENBLAS_NUM_THREADS": "1",
        "ORDERCONDS_TRACEBACK": "1",
    }
    command = [sys.executable, "-m", "tests.fuzz.fork_server"]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment, text=True, cwd=ROOT
    ) as server:
        yield server
        assert server.stdin is not None
        server.stdin.close()


def run(server: subprocess.Popen[str], words: list[str], folder: Path) -> Ending:
    """Run one command line in a folder."""
    assert server.stdin is not None
    assert server.stdout is not None
    print(json.dumps({"words": words, "folder": str(folder)}), file=server.stdin, flush=True)
    return Ending(**json.loads(server.stdout.readline()))


def import_everything() -> None:
    for package in (orderconds, codegen):
        for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not module.name.endswith("__main__") and ".scenes." not in module.name:
                importlib.import_module(module.name)
    for name in ("numpy.linalg", "sympy.parsing"):
        importlib.import_module(name)


def become(words: list[str], folder: str) -> None:
    """Make this fork a fresh process in its own group and folder."""
    os.setpgid(0, 0)
    os.chdir(folder)
    flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
    for stream, place in enumerate((os.devnull, OUT, ERR)):
        handle = os.open(place, flags if stream else os.O_RDONLY, 0o600)
        os.dup2(handle, stream)
        os.close(handle)
    sys.argv = ["orderconds", *words]
    resource.setrlimit(resource.RLIMIT_AS, (4 * MEGABYTES << 20,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (3 * SECONDS, 3 * SECONDS))

    def interrupt(number: int, frame: FrameType | None) -> None:
        Path("interrupted").touch()
        os.kill(os.getpid(), signal.SIGINT)

    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell ignores it in background jobs
    signal.signal(signal.SIGPROF, interrupt)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)


def waited(process: int, folder: str) -> Ending:
    """Wait for a fork; interrupt it if it waits for too long itself, and kill it if that does not help."""
    started, interrupted = time.monotonic(), False
    while True:
        found, state, usage = os.wait4(process, os.WNOHANG)
        if found:
            break
        elapsed = time.monotonic() - started
        if elapsed > 6 * SECONDS and not interrupted:
            interrupted = True
            os.kill(process, signal.SIGINT)
        if elapsed > 12 * SECONDS:
            os.killpg(process, signal.SIGKILL)
        time.sleep(0.002 if elapsed < 1 else 0.05)
    left = False
    with suppress(ProcessLookupError):
        os.killpg(process, signal.SIGKILL)
        left = True
    seconds = round(usage.ru_utime + usage.ru_stime, 2)
    unit = 1 << 20 if sys.platform == "darwin" else 1 << 10
    interrupted = interrupted or Path(folder, "interrupted").exists()
    return Ending(os.waitstatus_to_exitcode(state), seconds, usage.ru_maxrss // unit, interrupted, left)


def serve() -> bool:
    """Answer requests; return True in a fork, which then is the program."""
    from codegen.commands import regenerate

    regenerate.source_folder = lambda: Path("generated")  # else a line changes the source tree
    for line in sys.stdin:
        request = json.loads(line)
        process = os.fork()
        if process == 0:
            become(request["words"], request["folder"])
            return True
        with suppress(OSError):  # the fork may have done it, or have ended
            os.setpgid(process, process)
        print(json.dumps(asdict(waited(process, request["folder"]))), flush=True)
    return False


if __name__ == "__main__":
    import atexit
    import gc

    from orderconds.cli import main

    import_everything()
    gc.freeze()
    if serve():
        status = 0
        try:
            main()
        except SystemExit as end:
            status = int(end.code or 0)
        finally:
            atexit._run_exitfuncs()
            for stream in (sys.stdout, sys.stderr):
                with suppress(OSError):
                    stream.flush()
        os._exit(status)  # tearing down the modules would take longer than most lines
