"""The time of a step on a large lattice, and the fraction of the memory bandwidth that the step uses.

The arrays of the lattice are larger than the last-level cache. Therefore each loop over all sites reads and
writes main memory. The bandwidth of the step is compared with that of the triad ``a[i] = b[i] + s * c[i]`` of
the STREAM benchmark (McCalpin 1995).

Each number that a loop reads or writes is counted once. The additional read of a cache line before a write is
not counted. For this reason, the counted bandwidth of a step can exceed that of the triad.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING

from codegen.arrival import Status
from codegen.build import build
from codegen.ir.domain import FloatDomain
from codegen.ir.precision import precision
from codegen.lattice import Lattice
from codegen.loader import LOOP_FLAGS, load_lattice
from codegen.printers import target as known_target
from codegen.run.execute import Machine
from codegen.run.plan import Plan
from codegen.run.trial import PARTS
from codegen.run.unit import unit_of
from codegen.scene.momentum_frame import start_of
from orderconds.errors import InputError

if TYPE_CHECKING:
    from codegen.artifact import Artifact
    from codegen.emitter import Compiled
    from codegen.ir.site_step import SiteStep

COMPILE_SECONDS = 8.0
"""The limit for the compile time of a module, in seconds."""

STEP_SECONDS = 0.5
"""The lattice is made smaller if a step would take more than this CPU time in seconds."""

RESOLVED = 0.01
"""The shortest duration of a timed run in seconds: far above the resolution of the clock."""

REPEATED = 5
"""The number of timed runs. The fastest run is used, because other processes can only slow a run down."""

CACHES = 8
"""The arrays are at most CACHES times as large as the last-level cache."""

FREE_SHARE = 8
"""The arrays take at most the fraction 1/FREE_SHARE of the free memory."""

USUAL_CACHE, USUAL_MEMORY = 32 << 20, 1 << 30
"""Assumed sizes of the last-level cache and the free memory in bytes, used if the true sizes are unknown."""

FEW_SITES = 4096
"""The number of sites in a short run that estimates the CPU time for each site."""

SHORTER, ATTEMPTS = 64, 4
"""If the first step fails, the step size is divided by SHORTER, and the step is repeated.

At most ATTEMPTS attempts are made.
"""

COUNTED_STEPS, SIDES = 4, {1: 16, 2: 6}
"""The iterations are counted in COUNTED_STEPS steps on a small lattice.

In dimension d, this lattice has SIDES[d] sites along each axis (4 for d > 2).
"""

TRIAD = """\
#include <stddef.h>
void triad(size_t n, double *restrict a, const double *b, const double *c, double s);
void triad(size_t n, double *restrict a, const double *b, const double *c, double s)
{
    for (size_t i = 0; i < n; i++) {
        a[i] = b[i] + s * c[i];
    }
}
"""


@dataclass(frozen=True)
class Bandwidth:
    """The measured CPU time and memory bandwidth of a step on a lattice.

    - ``shape``: the number of sites in each dimension.
    - ``array_bytes``: the size of the states and the workspace of all sites in bytes.
    - ``cache_bytes``: the size of the last-level cache in bytes.
    - ``ns``: the CPU time for each site and step in nanoseconds.
    - ``moved``: the number of bytes that are read and written for each site and step.
    - ``triad``: the bandwidth of the triad loop in GB/s, where 1 GB is 10^9 bytes.
    - ``sweeps``: for each system of implicit equations, the mean number of iterations in a step.
    """

    shape: tuple[int, ...]
    array_bytes: int
    cache_bytes: int
    ns: float
    moved: float
    triad: float
    sweeps: tuple[float, ...] = ()

    @property
    def rate(self) -> float:
        """The rate at which the step reads and writes memory, in GB/s."""
        return self.moved / self.ns

    @property
    def fraction(self) -> float:
        """The bandwidth of the step divided by the bandwidth of the triad loop."""
        return self.rate / self.triad

    def lines(self) -> list[str]:
        """Return the measurement as lines of text."""
        sites = " x ".join(map(str, self.shape))
        arrays, cache = self.array_bytes / 1e6, self.cache_bytes / 1e6
        first = f"the lattice has {sites} sites, and one thread takes {self.ns:.1f} ns for each site and step"
        lines = [first, f"the arrays take {arrays:.1f} MB, the last-level cache has {cache:.1f} MB"]
        if self.sweeps:
            lines.append("mean number of iterations in a step: " + ", ".join(f"{n:.1f}" for n in self.sweeps))
        of = f"{self.fraction:.2f} of the bandwidth of a triad loop ({self.triad:.1f} GB/s)"
        return [*lines, f"{self.rate:.1f} GB/s, which is {of}"]

    def as_json(self) -> dict[str, object]:
        """Return the measurement as a dictionary for the key ``bandwidth`` of a JSON record."""
        return {
            "shape": list(self.shape),
            "array_bytes": self.array_bytes,
            "cache_bytes": self.cache_bytes,
            "ns_per_site_step": self.ns,
            "bytes_per_site_step": self.moved,
            "sweeps": list(self.sweeps),
            "gigabytes_per_second": self.rate,
            "triad_gigabytes_per_second": self.triad,
            "fraction": self.fraction,
        }


@dataclass(frozen=True)
class Unmeasured:
    """The reason why the bandwidth of a module was not measured."""

    reason: str

    def lines(self) -> list[str]:
        """Return a line of text with the reason why the bandwidth was not measured."""
        return [f"bandwidth not measured: {self.reason}"]

    def as_json(self) -> dict[str, object]:
        """Return a dictionary that contains ``reason``."""
        return {"reason": self.reason}


def measure(
    compiled: Compiled, artifact: Artifact, most_bytes: int | None = None, seconds: float = COMPILE_SECONDS
) -> Bandwidth | Unmeasured:
    """Return the measured bandwidth of an emitted module, or the reason why the measurement is impossible.

    ``most_bytes`` limits the size of the arrays, and ``seconds`` limits the compile time. ValueError is
    raised if the module is not for a chain or lattice.
    """
    step = compiled.kernel.sites
    if step is None:
        raise ValueError("expected a module for a chain or lattice")
    target = known_target(artifact.manifest["target"])
    if target.compile_seconds is None:
        return Unmeasured(f"modules in {target.title} are not compiled")
    try:
        build(artifact.files, LOOP_FLAGS, seconds=seconds)
        triad = _triad()
        lattice = load_lattice(artifact)
    except InputError as error:
        return Unmeasured(error.found.partition("\n")[0])
    most = free_bytes() // FREE_SHARE if most_bytes is None else most_bytes
    runs = _Runs(lattice, start_of(compiled.scene), _step_size(compiled, step))
    array_bytes = min(CACHES * cache_bytes(), most)
    side = runs.side(FEW_SITES)
    status = runs.shortened(side)
    if status != Status.OK:
        return Unmeasured(f"a step from the initial state fails with the status {status.name}")
    _, pace = runs.timed(side, 1)
    sites = array_bytes // (runs.itemsize * runs.numbers)
    side = runs.side(min(sites, int(STEP_SECONDS / max(pace, 1e-10))))
    used = runs.itemsize * runs.numbers * side**runs.dimension
    before = triad(used)
    ns = 1e9 * runs.best(side)
    sweeps = _sweeps(compiled, artifact, step, runs)
    rate = max(before, triad(used))
    moved = runs.itemsize * step.numbers_moved(sweeps)
    return Bandwidth((side,) * runs.dimension, used, cache_bytes(), ns, moved, rate, sweeps)


def _step_size(compiled: Compiled, step: SiteStep) -> float:
    """Return the step size for the measurement."""
    first, last = compiled.scene.span
    h = float((last - first) / PARTS)
    return h if step.blocks else h / SHORTER


@dataclass
class _Runs:
    """Runs a module with step size ``h`` on lattices of different sizes.

    All sites start from the state ``start``.
    """

    lattice: Lattice
    start: Sequence[float]
    h: float

    @property
    def dimension(self) -> int:
        return self.lattice.interface.dimension

    @property
    def numbers(self) -> int:
        """The number of floating-point numbers in the state and the workspace of one site together."""
        return self.lattice.interface.size + self.lattice.interface.workspace

    @property
    def itemsize(self) -> int:
        """The size of a number in bytes."""
        return precision(self.lattice.interface.precision).bits // 24 * 4

    def side(self, sites: int) -> int:
        """Return the number of sites along each axis of a cubic lattice with about ``sites`` sites in all.

        The returned number is even, because some methods split the lattice into pairs of sites.
        """
        return max(4, int(sites ** (1 / self.dimension)) // 2 * 2)

    def shortened(self, side: int) -> Status:
        """Run one step, repeat it with a smaller ``h`` after a failure, and return the last status."""
        for _ in range(ATTEMPTS):
            status, _ = self.timed(side, 1)
            if status == Status.OK:
                break
            self.h /= SHORTER
        return status

    def timed(self, side: int, steps: int, repeated: int = 1) -> tuple[Status, float]:
        """Return the status of a run, and the CPU time in seconds for one site and one step.

        The same run is made several times, and the shortest CPU time is returned. The argument ``repeated``
        is the number of runs. If a run fails, the method returns the status of this run and a meaningless CPU
        time.
        """
        import numpy as np

        kind = np.dtype(f"f{self.itemsize}")
        shape, interface = (side,) * self.dimension, self.lattice.interface
        sites, least = prod(shape), float("inf")
        work, table = np.zeros(interface.workspace_of(sites), kind), np.empty((interface.size, sites), kind)
        values = [self.lattice.defaults[name] for name in interface.parameters]
        for _ in range(repeated):
            table[:] = np.array(self.start, kind)[:, None]
            began = time.process_time()
            status, _ = self.lattice.advance(shape, table, (0.0, self.h, steps), values, work)
            least = min(least, time.process_time() - began)
            if status != Status.OK:
                return status, least
        return Status.OK, least / (sites * steps)

    def best(self, side: int) -> float:
        """Return the CPU time in seconds for one site and one step.

        The number of steps is doubled until a run takes at least :data:`RESOLVED` seconds or fails. Then
        :data:`REPEATED` runs are made. The CPU time of the fastest run is divided by the number of sites and
        by the number of steps.
        """
        steps, sites = 1, side**self.dimension
        status, pace = self.timed(side, steps, 2)
        while status == Status.OK and pace * sites * steps < RESOLVED:
            steps *= 2
            status, pace = self.timed(side, steps)
        # If the last run failed, for example because the method is unstable, its number of steps is halved,
        # because the run before it had half as many steps and succeeded.
        steps = steps if status == Status.OK else max(steps // 2, 1)
        return self.timed(side, steps, REPEATED)[1]


class _Counting(Machine):
    """Executes the emitted functions in Python, and counts the calls of each function."""

    def call(self, name: str, *arguments: object) -> object:
        self.counts[name] = self.counts.get(name, 0) + 1
        return super().call(name, *arguments)

    counts: dict[str, int]


def _sweeps(compiled: Compiled, artifact: Artifact, step: SiteStep, runs: _Runs) -> tuple[float, ...]:
    """Return the mean number of iterations in a step, for each system of implicit equations.

    The steps are executed in Python, because emitted modules do not report the number of iterations.
    """
    if not step.blocks:
        return ()
    interface = runs.lattice.interface
    plan = Plan(compiled.kernel, precision(interface.precision))
    machine, side = _Counting(unit_of(plan), FloatDomain(0.0)), SIDES.get(step.dimension, 4)
    machine.counts = {}
    sites = side**step.dimension
    state = [float(x) for x in runs.start for _ in range(sites)]
    work = [0.0] * interface.workspace_of(sites)
    time_at_start = [0.0] if interface.time else []
    values = [runs.lattice.defaults[name] for name in interface.parameters]
    shape, done = [side] * step.dimension, [0]
    machine.call("run", shape, state, *time_at_start, runs.h, COUNTED_STEPS, *values, work, done)
    steps = max(done[0], 1)
    return tuple(machine.counts.get(f"pass_{block.first + 1}", 0) / steps for block in step.blocks)


def _triad() -> Callable[[int], float]:
    """Return a function that measures the bandwidth of the triad loop in GB/s.

    The argument of the returned function is the total size of the three arrays in bytes.
    """
    import numpy as np
    from cffi import FFI

    ffi = FFI()
    ffi.cdef("void triad(size_t n, double *a, const double *b, const double *c, double s);")
    library = ffi.dlopen(str(build({"triad.c": TRIAD}, LOOP_FLAGS)))

    def bandwidth(total: int) -> float:
        n = max(total // 24, 1)
        arrays = [np.full(n, x) for x in (0.0, 1.0, 2.0)]
        a, b, c = (ffi.cast("double *", ffi.from_buffer(x)) for x in arrays)

        def run(times: int) -> float:
            began = time.process_time()
            for _ in range(times):
                library.triad(n, a, b, c, 0.5)
            return (time.process_time() - began) / times

        times = 1
        while (one := run(times)) * times < RESOLVED:
            times *= 2
        return 24e-9 * n / min(one, *(run(times) for _ in range(REPEATED)))

    return bandwidth


def cache_bytes() -> int:
    """Return the size of the last-level cache in bytes, or :data:`USUAL_CACHE` if the system does not state
    it."""
    sizes = {}
    for folder in Path("/sys/devices/system/cpu/cpu0/cache").glob("index*"):
        try:
            level, size = ((folder / name).read_text().strip() for name in ("level", "size"))
            sizes[int(level)] = int(size.rstrip("KMG")) << {"K": 10, "M": 20, "G": 30}.get(size[-1:], 0)
        except (OSError, ValueError):
            continue
    return sizes[max(sizes)] if sizes else USUAL_CACHE


def free_bytes() -> int:
    """Return the free memory in bytes, or :data:`USUAL_MEMORY` if the free memory is unknown."""
    try:
        return os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (ValueError, OSError, AttributeError):
        return USUAL_MEMORY
