"""The emitted Stumpff functions against mpmath, in both targets and in every set."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest
from cffi import FFI

from codegen.build import build
from codegen.emitter import emit
from codegen.integrator import StepFailed
from codegen.ir.precision import DOUBLE, SINGLE, Precision
from codegen.loader import load
from codegen.snippets.graph import needed
from codegen.snippets.stumpff import ROUNDINGS, SETS, SMALL, SWITCH, TINY, coefficients, economised, limit

POINTS = [
    *(
        0.0,
        5e-324,
        1e-310,
        1e-300,
        1e-16,
        1e-8,
        1e-3,
        2.0**-8,
        math.nextafter(2.0**-8, 1),
        0.01,
        0.0625,
        math.nextafter(0.0625, 1),
        0.1,
        0.5,
    ),
    *(math.nextafter(1.0, 0), 1.0, math.nextafter(1.0, 2), 2.0, 2.5),
    *(math.nextafter(4.0, 0), 4.0, math.nextafter(4.0, 5), 7.0),
    *(math.pi**2, math.nextafter(math.pi**2, 99), 20.2, 4 * math.pi**2, 100.0, 12345.678, 1e6, 1e15),
]


def reference(k: int, z: float) -> mpmath.mpf:
    """c_k(z) by its series in 40 digits beyond what cancels."""
    with mpmath.workdps(40 + int(math.sqrt(z) / 2) if z < 1e4 else 60):
        x = mpmath.mpf(z)
        if x > 1e4 or (x > 1 and k < 2):
            s = mpmath.sqrt(x)
            return (mpmath.cos(s), mpmath.sin(s) / s, (1 - mpmath.cos(s)) / x, (s - mpmath.sin(s)) / (x * s))[
                k
            ]
        total, term, j = mpmath.mpf(0), 1 / mpmath.factorial(k), 0
        while abs(term) > mpmath.mpf(10) ** -mpmath.mp.dps:
            total += term
            j += 1
            term = -term * x / ((2 * j + k) * (2 * j + k - 1))
        return total


def allowed(k: int, z: float, precision: Precision = DOUBLE) -> float:
    """The bound in the documentation of ROUNDINGS."""
    coarser = precision.unit / DOUBLE.unit
    with mpmath.workdps(60):
        exact, moves = reference(k, z), mpmath.mpf(1.5) * math.ulp(z) * coarser
        moved = max(abs(reference(k, x) - exact) for x in (z + moves, max(z - moves, 0)))
        return float(ROUNDINGS[k] * precision.unit * abs(exact) + moved)


@cache
def dense():
    """Numbers z with the values of the functions and the bounds of the errors.

    Just below twice a power of four, the rounding error of sqrt z has its largest effect, sqrt(2) units in z.
    """
    rng = random.Random(1)
    points = [2.0 ** rng.uniform(-12, 40) for _ in range(150)] + [rng.uniform(0, 5) for _ in range(150)]
    points += [2 * 4.0 ** rng.randrange(20) * rng.uniform(0.98, 1) for _ in range(100)]
    return [(z, [reference(k, z) for k in range(4)], [allowed(k, z) for k in range(4)]) for z in points]


@pytest.fixture(scope="module")
def compiled():
    return in_c(DOUBLE)


@pytest.fixture(scope="module")
def interpreted():
    return in_python(DOUBLE)


def in_c(precision):
    """Every set as a function z -> tuple, in C."""
    real = precision.c_type
    functions = ["stumpff_" + "".join(map(str, orders)) for orders in SETS]
    parts, declared = ["#include <math.h>", *needed("c", functions, precision).texts], []
    for name, orders in zip(functions, SETS, strict=True):
        head = f"void probe_{name}({real} z, {real} *c)"
        many = ", ".join(["z", *(f"&c[{i}]" for i in range(len(orders)))])
        call = f"{name}({many})" if len(orders) > 1 else f"c[0] = {name}(z)"
        parts.append(f"{head};\n{head} {{ {call}; }}")
        declared.append(f"{head};")
    ffi = FFI()
    ffi.cdef("\n".join(declared))
    library = ffi.dlopen(str(build({"probe.c": "\n".join(parts) + "\n"})))

    def call(orders, z):
        values = ffi.new(f"{real}[4]")
        getattr(library, "probe_stumpff_" + "".join(map(str, orders)))(z, values)
        return tuple(values)[: len(orders)]

    return call


def in_python(precision):
    """Every set as a function z -> tuple, in Python."""
    found = needed("python", ["stumpff_" + "".join(map(str, orders)) for orders in SETS], precision)
    library, number = (math, float) if precision is DOUBLE else (np, np.float32)
    namespace = {name: getattr(library, name) for name in found.library} | {"float32": number}
    exec("\n\n".join(found.texts), namespace)

    def call(orders, z):
        value = namespace["_stumpff_" + "".join(map(str, orders))](number(z))
        return value if isinstance(value, tuple) else (value,)

    return call


@pytest.mark.parametrize("orders", SETS, ids=str)
@pytest.mark.parametrize("target", ["compiled", "interpreted"])
def test_stumpff_functions_are_accurate_from_zero_to_a_million(request, orders, target):
    call = request.getfixturevalue(target)
    for z in POINTS:
        if z > limit():
            assert all(math.isnan(x) for x in call(orders, z))
            continue
        for k, value in zip(orders, call(orders, z), strict=True):
            error = abs(float(mpmath.mpf(value) - reference(k, z)))
            assert error <= allowed(k, z), (k, z, value, error / math.ulp(value))


@pytest.mark.parametrize("target", ["compiled", "interpreted"])
def test_between_these_points_the_functions_are_as_accurate(request, target):
    call = request.getfixturevalue(target)
    for z, references, bounds in dense():
        for orders in ((0, 1, 2, 3), (0,), (1,), (2,), (3,)):
            for k, value in zip(orders, call(orders, z), strict=True):
                assert abs(value - references[k]) <= bounds[k], (k, z, value)


def test_c_and_python_spell_the_same_roundings(compiled, interpreted):
    for orders in SETS:
        for z in POINTS:
            if z <= 1.0:
                assert compiled(orders, z) == interpreted(orders, z)


@pytest.mark.parametrize("k", range(4))
def test_no_branch_jumps_at_its_switch(compiled, k):
    for z in (float(TINY), float(SMALL), float(SWITCH[k])):
        below, above = compiled((k,), z)[0], compiled((k,), math.nextafter(z, 9))[0]
        assert abs(below - above) <= 2 * math.ulp(below)


@pytest.mark.parametrize("last", [TINY, SMALL])
@pytest.mark.parametrize("k", range(4))
def test_short_polynomials_err_by_a_sixteenth_of_a_unit_and_no_shorter_ones_would(k, last):
    terms = economised(k, last)

    def error(terms):
        places = [last * j / 400 for j in range(401)]
        return max(
            abs(sum(c * z**j for j, c in enumerate(terms)) - c_k(k, z)) * math.factorial(k) for z in places
        )

    assert error(terms) <= Fraction(1, 2**57)
    assert error(coefficients(k, last, 60)[: len(terms)]) > error(terms)
    assert terms[0] == Fraction(1, math.factorial(k))


def c_k(k, z):
    """The series, exact to far beyond a double."""
    return sum(Fraction((-1) ** j, math.factorial(2 * j + k)) * z**j for j in range(14))


def test_at_zero_the_values_are_exact(compiled):
    assert compiled((0, 1, 2, 3), 0.0) == (1.0, 1.0, 0.5, 1 / 6)


def test_what_is_no_number_stays_so(compiled):
    assert all(math.isnan(x) for x in compiled((0, 1, 2, 3), math.nan))


@pytest.mark.parametrize("spelled", [in_c, in_python], ids=["c", "python"])
def test_floats_are_as_accurate_in_their_last_places(spelled):
    call = spelled(SINGLE)
    for orders in SETS:
        for z in map(float, map(np.float32, POINTS)):
            if z > limit(SINGLE):
                assert all(math.isnan(x) for x in call(orders, z))
                continue
            for k, value in zip(orders, call(orders, z), strict=True):
                error = abs(float(mpmath.mpf(float(value)) - reference(k, z)))
                assert error <= allowed(k, z, SINGLE), (k, z, value)


def test_polynomials_are_as_long_as_the_precision_asks_for():
    for precision, terms in ((DOUBLE, (10, 9, 9, 11)), (SINGLE, (6, 6, 5, 7))):
        assert tuple(len(coefficients(k, bits=precision.bits)) for k in range(4)) == terms
    texts = [needed("c", ["stumpff_1"], precision).texts[0] for precision in (DOUBLE, SINGLE)]
    assert ["double" in text for text in texts] == [True, False]


@pytest.mark.parametrize("target", ["c", "python"])
def test_an_angle_beyond_two_fifths_of_its_digits_is_no_angle(target):
    """The step that asked for it fails with a status; the last angle that is answered is 2^21."""
    step = load(emit("free_rigid_body", "rkmk(0):euler", target))
    speed = math.hypot(0.5 * math.cos(1.1), 1.5 * math.sin(1.1))
    start = [math.cos(1.1), 0.0, math.sin(1.1)]
    assert math.hypot(*step.step(start, 0.999 * 2.0**21 / speed)) == pytest.approx(1.0)
    with pytest.raises(StepFailed, match="the step is too long"):
        step.step(start, 1.001 * 2.0**21 / speed)
