"""The emitted Stumpff functions against mpmath, in both targets and in every set."""

from __future__ import annotations

import math
from types import SimpleNamespace

import mpmath
import pytest
from cffi import FFI

from codegen.build import build
from codegen.snippets.graph import needed
from codegen.snippets.stumpff import SETS, SMALL, SWITCH

POINTS = [
    *(0.0, 5e-324, 1e-310, 1e-300, 1e-16, 1e-8, 1e-3, 0.0625, math.nextafter(0.0625, 1), 0.1, 0.5),
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


def slope(k: int, z: float) -> float:
    """|c_k'(z)|, by the difference of references."""
    with mpmath.workdps(40):
        step = z * 1e-9
        return float(abs(reference(k, z + step) - reference(k, z)) / step) if z > 1e-9 else 1.0


def allowed(k: int, z: float) -> float:
    """Two units in the last place, and what half a unit in sqrt z, that is one in z, causes."""
    exact = float(reference(k, z))
    return 2 * math.ulp(exact) + slope(k, z) * math.ulp(z)


@pytest.fixture(scope="module")
def compiled():
    """Every set as a function z -> tuple, in C."""
    functions = ["stumpff_" + "".join(map(str, orders)) for orders in SETS]
    parts, declared = ["#include <math.h>", *needed("c", functions).texts], []
    for name, orders in zip(functions, SETS, strict=True):
        head = f"void probe_{name}(double z, double *c)"
        many = ", ".join(["z", *(f"&c[{i}]" for i in range(len(orders)))])
        call = f"{name}({many})" if len(orders) > 1 else f"c[0] = {name}(z)"
        parts.append(f"{head};\n{head} {{ {call}; }}")
        declared.append(f"{head};")
    ffi = FFI()
    ffi.cdef("\n".join(declared))
    library = ffi.dlopen(str(build({"probe.c": "\n".join(parts) + "\n"})))

    def call(orders, z):
        values = ffi.new("double[4]")
        getattr(library, "probe_stumpff_" + "".join(map(str, orders)))(z, values)
        return tuple(values)[: len(orders)]

    return call


@pytest.fixture(scope="module")
def interpreted():
    """Every set as a function z -> tuple, in Python."""
    found = needed("python", ["stumpff_" + "".join(map(str, orders)) for orders in SETS])
    module = SimpleNamespace(**{name: getattr(math, name) for name in found.library})
    namespace = dict(vars(module))
    exec("\n\n".join(found.texts), namespace)

    def call(orders, z):
        value = namespace["_stumpff_" + "".join(map(str, orders))](z)
        return value if isinstance(value, tuple) else (value,)

    return call


@pytest.mark.parametrize("orders", SETS, ids=str)
@pytest.mark.parametrize("target", ["compiled", "interpreted"])
def test_stumpff_functions_are_accurate_from_zero_to_a_million(request, orders, target):
    call = request.getfixturevalue(target)
    for z in POINTS:
        for k, value in zip(orders, call(orders, z), strict=True):
            error = abs(float(mpmath.mpf(value) - reference(k, z)))
            assert error <= allowed(k, z), (k, z, value, error / math.ulp(value))


def test_c_and_python_spell_the_same_roundings(compiled, interpreted):
    for orders in SETS:
        for z in POINTS:
            if z <= 1.0:
                assert compiled(orders, z) == interpreted(orders, z)


@pytest.mark.parametrize("k", range(4))
def test_no_branch_jumps_at_its_switch(compiled, k):
    for z in (float(SMALL), float(SWITCH[k])):
        below, above = compiled((k,), z)[0], compiled((k,), math.nextafter(z, 9))[0]
        assert abs(below - above) <= 2 * math.ulp(below)


def test_at_zero_the_values_are_exact(compiled):
    assert compiled((0, 1, 2, 3), 0.0) == (1.0, 1.0, 0.5, 1 / 6)


def test_what_is_no_number_stays_so(compiled):
    assert all(math.isnan(x) for x in compiled((0, 1, 2, 3), math.nan))
