"""Time ``orderconds check`` on every tableau of the library, each in a fresh process; medians of five."""

from __future__ import annotations

import statistics
import subprocess
import sys
import time

from orderconds.tableau import available

REPEATS = 5


def main() -> None:
    """Print a table of wall times, start of the interpreter included."""
    print(f"{'tableau':<16}{'seconds':>8}")
    for name in available():
        print(f"{name:<16}{median(name):>8.2f}", flush=True)


def median(name: str) -> float:
    """Return the median wall time in seconds of checking one tableau with all its claims."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        subprocess.run([sys.executable, "-m", "orderconds", "check", name], check=True, capture_output=True)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


if __name__ == "__main__":
    main()
