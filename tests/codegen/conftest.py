"""Kernels to print, and ``check_codegen``: every promise of emitted code, checked for one kernel."""

from __future__ import annotations

import math
import os
import random
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import mpmath
import pytest

from codegen.artifact import Artifact
from codegen.build import Compiler, build
from codegen.emitter import emit_kernel
from codegen.ir.expr import Expr, Space, evaluate
from codegen.ir.kernel import Field, Kernel, Let, Loop
from codegen.ir.number import Number
from codegen.loader import load
from codegen.printers.recipe import Recipe
from tests.promises import COMPILERS, SANITIZE, clean_c


class Doubles:
    """Doubles as a domain; Stumpff functions are those of mpmath, rounded once."""

    def number(self, value: Number) -> float:
        return float(value)

    def call(self, function: str, x: float) -> float:
        if function.startswith("stumpff"):
            return stumpff(int(function[-1]), x)
        return float(getattr(math, function)(x))


def stumpff(k: int, z: float) -> float:
    """c_k(z), z >= 0, from 60 digits."""
    with mpmath.workdps(60):
        x = mpmath.mpf(z)
        if x < mpmath.mpf("1e-20"):
            return float((1 - x / ((k + 1) * (k + 2))) / mpmath.factorial(k))
        s = mpmath.sqrt(x)
        exact = (mpmath.cos(s), mpmath.sin(s) / s, (1 - mpmath.cos(s)) / x, (s - mpmath.sin(s)) / (x * s))
        return float(exact[k])


def interpret(kernel: Kernel, values: Mapping[str, float]) -> tuple[float, ...]:
    """Carry out a kernel in doubles."""
    known: dict[str, Any] = dict(values)

    def value(expressions: tuple[Expr, ...]) -> list[float]:
        return evaluate(expressions, Doubles(), known)

    for statement in kernel.body:
        if isinstance(statement, Let):
            known[statement.name] = value((statement.value,))[0]
            continue
        known.update(zip(statement.unknowns, value(statement.starts), strict=True))
        previous = 0.0
        for _ in range(statement.limit):
            for let in statement.body:
                known[let.name] = value((let.value,))[0]
            images = value(statement.images)
            now = [known[u] for u in statement.unknowns]
            change = max(abs(a - b) for a, b in zip(images, now, strict=True))
            scale = max(1.0, *map(abs, now))
            close = change <= statement.close * scale and change * change <= 2.0**-53 * scale * previous
            if close or 0 < previous <= change <= statement.tolerance * scale:
                break
            previous = change
            known.update(zip(statement.unknowns, images, strict=True))
        else:
            raise AssertionError("the interpreted loop did not converge")
    return tuple(value(kernel.outputs))


def rotation() -> Kernel:
    """Lie-Euler for the free rigid body: exp(h f(m)) m by Rodrigues' formula."""
    s = Space()
    h, m = s.sym("h"), [s.sym(f"m{i}") for i in range(3)]
    diagonal = [Number.rational(-1, 2), Number.rational(-1), Number.rational(-3, 2)]
    lets = [Let(f"w{i}", s.const(d) * m[i] * h) for i, d in enumerate(diagonal)]
    w = [s.sym(f"w{i}") for i in range(3)]
    lets.append(Let("z", w[0] ** 2 + w[1] ** 2 + w[2] ** 2))
    lets += [Let(f"v{i}", x) for i, x in enumerate(cross(w, m))]
    v = [s.sym(f"v{i}") for i in range(3)]
    c1, c2 = s.call("stumpff1", s.sym("z")), s.call("stumpff2", s.sym("z"))
    outputs = tuple(x + c1 * y + c2 * u for x, y, u in zip(m, v, cross(w, v), strict=True))
    state = (Field("m", ("m0", "m1", "m2"), "angular momentum in the body"),)
    return Kernel("rigid", state, ("t", "h"), tuple(lets), outputs)


def cross(a: list[Expr], b: list[Expr]) -> list[Expr]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def pendulum(limit: int = 100) -> Kernel:
    """Implicit midpoint for q'' = -k sin(q + t), with names that C or Python reserve."""
    s = Space()
    h, t, q, p, k = (s.sym(n) for n in ("h", "t", "q", "state", "lambda"))
    half = s.const(Number.rational(1, 2))
    Q, K, L = (s.sym(n) for n in ("double", "K", "L"))
    loop = Loop(
        "stage 1",
        ("K", "L"),
        (p, -k * s.call("sin", q + t)),
        (
            Let("double", q + half * h * K),
            Let("force", -k * s.call("sin", Q + t + half * h)),
        ),
        (p + half * h * L, s.sym("force")),
        limit=limit,
    )
    kick = Let("kick", h * s.sym("force"))
    state = (Field("q", ("q",), "angle"), Field("p", ("state",), "momentum"))
    return Kernel("pendulum", state, ("t", "h", "lambda"), (loop, kick), (q + h * K, p + s.sym("kick")))


def powers() -> Kernel:
    """Powers, quotients, signs and nested sums in every position."""
    s = Space()
    x, y, h = s.sym("x"), s.sym("y"), s.sym("h")
    third = s.const(Number.rational(1, 3))
    big = (x + y) ** 7 - third * (x - (y - h)) ** 2 / (x * (y / (h + 2)))
    small = -(-(x - y) * (third * (x * y))) / (s.call("sqrt", x * x + y**4) * (1 + h))
    return Kernel("powers", (Field("x", ("x", "y"), "numbers"),), ("t", "h"), (), (big, small - x * h**3))


def single() -> Kernel:
    """One of everything: component, unknown, Stumpff function of an argument; odd names; a plain output."""
    s = Space()
    x, h, u, y = s.sym("for"), s.sym("h"), s.sym("u.1"), s.sym("2y")
    loop = Loop(
        'the "first" */ stage',
        ("u.1",),
        (x,),
        (Let("c", s.call("stumpff1", u * u)),),
        (x + h * s.sym("c"),),
    )
    more = Let("2y", x + h * s.call("stumpff3", u * u) + h * s.sym("c"))
    return Kernel("single", (Field("x", ("for",), "a number"),), ("t", "h"), (loop, more), (y,))


STATES = {"rigid": (0.4, -0.3, 0.9), "pendulum": (0.5, 0.25), "powers": (1.25, 0.5), "single": (0.5,)}
KERNELS = {"single": single, "rigid": rotation, "pendulum": pendulum, "powers": powers}


def recipe(kernel: Kernel) -> Recipe:
    defaults = {"lambda": 2.0} if "lambda" in kernel.scalars else {}
    facts = (("method", "hand-made, for tests"), ("order", "1"))
    steps = 2 if kernel.name == "powers" else 8  # its third step overflows
    return Recipe(
        kernel.name, facts, STATES[kernel.name], 0.125, steps, defaults, command="none", version="test"
    )


def emission(kernel: Kernel, target: str, prefix: str = "") -> Artifact:
    return emit_kernel(kernel, recipe(kernel), target, prefix or f"{kernel.name}_")


@pytest.fixture(scope="session")
def kernels() -> SimpleNamespace:
    """The kernels of this file by name, and how to emit and interpret them."""
    return SimpleNamespace(
        **KERNELS, recipe=recipe, emission=emission, interpret=interpret, STATES=STATES, SANITIZE=SANITIZE
    )


@pytest.fixture(params=COMPILERS)
def compiler(request: pytest.FixtureRequest) -> Compiler:
    """Each compiler in turn; one that is not there is a visible skip."""
    if shutil.which(request.param) is None:
        pytest.skip(f"{request.param} is not installed")
    return Compiler((request.param,), request.param)


@pytest.fixture(scope="session", autouse=True)
def private_cache(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Keep what tests compile out of the user's cache. The processes of one run share their cache."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "cache"
    folder.mkdir(mode=0o700, exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(folder))
        yield


@pytest.fixture
def check_codegen(compiler: Compiler, tmp_path: Path) -> Callable[..., None]:
    """Return the check of one C emission and its Python twin.

    The C keeps what :func:`tests.promises.clean_c` checks; the loaded C and Python agree with ``step``, a
    function from (state, h, t) to a state, within ``ulps`` units in the last place of the largest component.
    States are any numbers, or those of a run where the emitted code holds ``on_group`` only.
    """

    def check(
        c: Artifact,
        python: Artifact,
        step: Callable[[tuple[float, ...], float, float], tuple[float, ...]],
        state: tuple[float, ...],
        h: float,
        ulps: float = 8,
        on_group: bool = False,
    ) -> None:
        clean_c(c, compiler, tmp_path)
        loaded = load(c), load(python)
        generator = random.Random(20)
        for _ in range(5):
            start = state if on_group else tuple(x * generator.uniform(0.5, 1.5) for x in state)
            t = generator.uniform(0, 2)
            expected = step(start, h, t)
            close = ulps * math.ulp(max(1.0, *map(abs, expected)))
            for integrator in loaded:
                assert integrator.step(list(start), h, t) == pytest.approx(expected, rel=0, abs=close)
            state = expected if on_group else state

    return check


@pytest.fixture(scope="session")
def built() -> Callable[..., Path]:
    """Build an emission with whatever compiler is there."""
    return lambda emission: build(emission.files)
