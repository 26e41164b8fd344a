"""Run all benchmarks of batches, chains, lattices, rods and semilinear equations; write them to README.md.

    python benchmarks/scale_all.py [--elastica PYTHON] [--quick]

The scripts run one after another in one run. Their output replaces the earlier output in README.md, together
with the required figure of each script and its exit status, which is 1 if the figure is missed. PYTHON can
import elastica; without it, the comparison with PyElastica is left out. With --quick the README is not
changed. A run takes about 15 minutes.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from codegen.build import find_compiler

HERE = Path(__file__).parent
MARK, END = "<!-- scale_all.py writes what follows -->", "<!-- end of the output of scale_all.py -->"


@dataclass(frozen=True)
class Script:
    """A script with its arguments, environment, and required figure."""

    name: str
    required: str
    arguments: tuple[str, ...] = ()
    compiler: str = "gcc"


SCRIPTS = (
    Script("scale.py", "scalar time / batch time is at least 0.6 times the number of doubles in a register"),
    Script("batches.py", "the fastest emitted method is not slower than the batch mode of heyoka"),
    Script("lattice.py", "at most 1.2 times the time of hand-written loops; 5 times faster than NumPy"),
    Script("lattice.py", "the same figures with clang", compiler="clang"),
    Script("chain.py", "the time of Newton's method grows as N^p with p between 0.9 and 1.1"),
    Script("rod.py", "p between 0.9 and 1.1; at least 5 times faster than PyElastica at the error 1e-4"),
    Script("semilinear.py", "none: the share of the transforms is reported"),
)


def processor() -> str:
    """Return the name of the processor and the widest vector instructions that it reports."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text(encoding="utf-8").splitlines() if info.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    flags = next((line.split() for line in lines if line.startswith("flags")), [])
    widest = next((x for x in ("avx512f", "avx2", "avx", "sse2") if x in flags), "unknown instructions")
    return f"{names[0] if names else platform.processor()}, {widest}"


def section(script: Script, given: tuple[str, ...]) -> tuple[str, int]:
    """Run a script; return a section of README.md, and the exit status."""
    words = [sys.executable, str(HERE / script.name), *script.arguments, *given]
    done = subprocess.run(words, capture_output=True, text=True, env=os.environ | {"CC": script.compiler})
    if done.returncode not in (0, 1):
        raise SystemExit(f"{script.name} ends with status {done.returncode}: {done.stderr[-2000:]}")
    verdict = "reached" if done.returncode == 0 else "missed"
    text = f"### {script.name}, {script.compiler}\n\nRequired: {script.required}. Result: {verdict}.\n\n"
    output = done.stdout.strip()
    return text + (output if output.startswith("|") else f"```text\n{output}\n```"), done.returncode


def main() -> int:
    """Print the sections and write them to README.md; return 1 if a required figure is missed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--elastica", metavar="PYTHON", help="a Python that can import elastica")
    parser.add_argument("--quick", action="store_true", help="do not change README.md")
    options = parser.parse_args()
    begin, worst, sections = time.monotonic(), 0, []
    for k, script in enumerate(SCRIPTS, 1):
        given = ("--elastica", options.elastica) if script.name == "rod.py" and options.elastica else ()
        text, status = section(script, given)
        worst = max(worst, status)
        sections.append(text)
        print(text, flush=True)
        spent = (time.monotonic() - begin) / 60
        print(f"{k} of {len(SCRIPTS)} scripts in {spent:.1f} minutes", file=sys.stderr, flush=True)
    if not options.quick:
        page = HERE / "README.md"
        before, _, rest = page.read_text(encoding="utf-8").partition(MARK)
        after = rest.partition(END)[2]
        about = f"Processor: {processor()}. Compiler: {find_compiler().version}."
        new = "\n\n".join([MARK, about, *sections, END])
        page.write_text(before + new + after, encoding="utf-8")
    return worst


if __name__ == "__main__":
    raise SystemExit(main())
