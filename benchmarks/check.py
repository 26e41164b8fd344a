"""Time ``orderconds check FILE`` on every tableau of the library, each in fresh processes.

The script prints wall and CPU seconds of each file, the slowest file first, and the number of files that took
longer than the limit. Times include the start of the interpreter. Each time is the least of a few runs,
because other processes can only increase it. Byte code is compiled before the first run, as in an
installation.
"""

from __future__ import annotations

import compileall
import os
import resource
import subprocess
import sys
import time
from pathlib import Path

import orderconds
from orderconds.tableau import available, find

REPEATS = 3
LIMIT = 0.3


def main() -> None:
    """Time all tableaux and print the table."""
    compileall.compile_dir(str(Path(orderconds.__file__).parent), quiet=1)
    rows = sorted(((*least(name), name) for name in available()), reverse=True)
    print(f"{'tableau':<22}{'CPU':>8}{'wall':>8}")
    for cpu, wall, name in rows:
        print(f"{name:<22}{cpu:>8.2f}{wall:>8.2f}")
    cpus, walls = [cpu for cpu, _, _ in rows], [wall for _, wall, _ in rows]
    print(f"{len(rows)} files; CPU median {cpus[len(cpus) // 2]:.2f} s, most {cpus[0]:.2f} s")
    for kind, times in (("CPU", cpus), ("wall", walls)):
        print(f"longer than {LIMIT} s of {kind} time: {sum(t > LIMIT for t in times)}")


def least(name: str) -> tuple[float, float]:
    """Return the least CPU and wall time in seconds of checking one tableau with all its claims."""
    runs = [once(name) for _ in range(REPEATS)]
    return min(cpu for cpu, _ in runs), min(wall for _, wall in runs)


def once(name: str) -> tuple[float, float]:
    """Return CPU and wall time in seconds of one fresh process."""
    before, start = _children(), time.perf_counter()
    command = [sys.executable, "-m", "orderconds", "check", str(find(name))]
    subprocess.run(command, check=True, capture_output=True, env=os.environ)
    return _children() - before, time.perf_counter() - start


def _children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
