"""Time emitted steps of the Kuramoto-Sivashinsky equation, and the share of the Fourier transforms.

    python benchmarks/semilinear.py [--points N] [--turns N]

The scene is `kuramoto_sivashinsky`. Emitted C and emitted Python make steps of cf4, and
ETDRK4 (Kassam and Trefethen 2005, coefficients by means over 32 points of a circle) is written here with
NumPy. The CPU times of a step are medians of all turns. The share of the transforms is
the CPU time of as many transforms as a step makes, divided by the time of the step. For emitted C it is one
minus the share of steps with transforms that do nothing. The errors are those at t = 10 for the same
step size, as the largest difference from a run of emitted C with steps of a sixteenth of the size.
"""

from __future__ import annotations

import argparse
import ctypes
import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import codegen
from codegen.build import build
from codegen.emitter import compile_method
from codegen.spectral import Spectral

SCENE = "kuramoto_sivashinsky"
METHOD, H, STEPS, END = "cf:cf4", 1 / 16, 200, 10.0


class Etdrk4:
    """ETDRK4 for the Kuramoto-Sivashinsky equation on n points, with steps of size h."""

    def __init__(self, n: int, length: float, h: float) -> None:
        k = 2 * np.pi * np.arange(n // 2 + 1) / length
        operator = k**2 - k**4
        self.n = n
        self.whole, self.half = np.exp(h * operator), np.exp(h * operator / 2)
        circle = np.exp(1j * np.pi * (np.arange(1, 33) - 0.5) / 32)
        z = h * operator[:, None] + circle[None, :]

        def mean(values: Any) -> Any:
            return h * np.real(values.mean(axis=1))

        self.stage = mean((np.exp(z / 2) - 1) / z)
        self.first = mean((-4 - z + np.exp(z) * (4 - 3 * z + z**2)) / z**3)
        self.middle = mean((2 + z + np.exp(z) * (z - 2)) / z**3)
        self.last = mean((-4 - 3 * z - z**2 + np.exp(z) * (4 - z)) / z**3)
        self.factor = -0.5j * k
        self.factor[-1] = 0

    def nonlinear(self, spectrum: Any) -> Any:
        """Return the spectrum of -(u^2)_x/2."""
        return self.factor * np.fft.rfft(np.fft.irfft(spectrum, self.n) ** 2)

    def run(self, u: Any, steps: int) -> Any:
        """Return the values after some steps."""
        v = np.fft.rfft(u)
        for _ in range(steps):
            n1 = self.nonlinear(v)
            a = self.half * v + self.stage * n1
            n2 = self.nonlinear(a)
            b = self.half * v + self.stage * n2
            n3 = self.nonlinear(b)
            c = self.half * a + self.stage * (2 * n3 - n1)
            n4 = self.nonlinear(c)
            v = self.whole * v + self.first * n1 + 2 * self.middle * (n2 + n3) + self.last * n4
        return np.fft.irfft(v, self.n)


def seconds(work: Callable[[], object], repeated: int, turns: int) -> float:
    """Return the median of the CPU times of one of ``repeated`` repetitions that ``work`` makes."""
    work()
    found = []
    for _ in range(turns):
        start = time.process_time()
        work()
        found.append((time.process_time() - start) / repeated)
    return statistics.median(found)


IDLE = """
#include <stddef.h>
void forward(size_t n, const double *values, double *spectrum, void *context);
void backward(size_t n, double *spectrum, double *values, void *context);
void forward(size_t n, const double *values, double *spectrum, void *context)
{
    (void)n, (void)values, (void)spectrum, (void)context;
}
void backward(size_t n, double *spectrum, double *values, void *context)
{
    (void)n, (void)values, (void)spectrum, (void)context;
}
"""


def without_transforms(module: Any, n: int) -> Callable[[], None]:
    """Return a function that makes steps of the emitted C module with transforms that do nothing."""
    tables, work, u = (
        np.zeros(int(m)) for m in (module._function("tables")(n), module._function("workspace")(n), n)
    )
    module._function("prepare")(n, H, module._pointer(tables))
    ffi = module._ffi
    library = ctypes.CDLL(str(build({"idle.c": IDLE})))
    transform = ffi.new(f"{module.interface.prefix}transform *")
    for name, kind in (("forward", "const double *, double *"), ("backward", "double *, double *")):
        address = ctypes.cast(getattr(library, name), ctypes.c_void_p).value
        setattr(transform, name, ffi.cast(f"void(*)(size_t, {kind}, void *)", address))
    pointers = [module._pointer(array) for array in (u, tables, work)]
    arrays = tables, work, u, library

    def steps() -> None:
        assert arrays  # the reference keeps the memory behind the pointers
        module._function("run")(n, pointers[0], STEPS, pointers[1], transform, pointers[2], ffi.NULL)

    return steps


def transform_numpy(u: Any, pairs: int) -> Callable[[], None]:
    """Return a function that makes pairs of transforms of NumPy."""

    def work() -> None:
        for _ in range(pairs):
            np.fft.irfft(np.fft.rfft(u), u.size)

    return work


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--points", type=int, default=1024)
    parser.add_argument("--turns", type=int, default=9)
    options = parser.parse_args()
    n, turns = options.points, options.turns
    step = compile_method(SCENE, METHOD).kernel.modes
    assert step is not None
    pairs = step.transforms // 2
    compiled, interpreted = (
        codegen.load_spectral(codegen.emit(SCENE, METHOD, target=target)) for target in ("c", "python")
    )
    u = compiled.start(n)
    peer = Etdrk4(n, float(compiled.points(n)[1] * n), H)
    exact = compiled.run(u, H / 16, int(16 * END / H)).values

    def error(values: Any) -> float:
        return float(abs(values - exact).max())

    def emitted(module: Spectral) -> tuple[float, float]:
        taken = seconds(lambda: module.run(u, H, STEPS), STEPS, turns)
        return taken, error(module.run(u, H, int(END / H)).values)

    rest = seconds(without_transforms(compiled, n), STEPS, turns)
    other = seconds(transform_numpy(u, 200), 200, turns) * pairs
    first = emitted(compiled)
    rows = [
        ("emitted C, cf4", *first, first[0] - rest),
        ("emitted Python, cf4", *emitted(interpreted), other),
        ("ETDRK4 in NumPy", seconds(lambda: peer.run(u, STEPS), STEPS, turns), 0.0, other),
    ]
    rows[2] = (*rows[2][:2], error(peer.run(u, int(END / H))), other)
    print(f"n = {n}, h = {H}, {step.transforms} transforms a step, {turns} turns")
    print("| program | microseconds a step | transforms | error at t = 10 |")
    print("| --- | ---: | ---: | ---: |")
    for name, taken, wrong, transforms in rows:
        print(f"| {name} | {1e6 * taken:.3g} | {100 * transforms / taken:.0f} % | {wrong:.1e} |")


if __name__ == "__main__":
    main()
