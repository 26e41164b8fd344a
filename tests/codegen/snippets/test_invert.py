"""Matrices are inverted with rows exchanged: to rounding, and alike with and without loops over a row."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from cffi import FFI

from codegen.build import build
from codegen.snippets.graph import needed

SIZE = 6


def in_c(wide):
    head = "int probe(double *a)"
    call = f"return (int)invert({SIZE}, a);"
    (text,) = needed("c", ["invert"], wide=wide, widest=SIZE).texts
    ffi = FFI()
    ffi.cdef(f"{head};")
    source = f"#include <math.h>\n#include <stddef.h>\n{text}\n{head};\n{head} {{ {call} }}\n"
    library = ffi.dlopen(str(build({"probe.c": source})))

    def inverted(rows):
        a = ffi.new("double[]", [x for row in rows for x in row])
        return [list(a[SIZE * i : SIZE * (i + 1)]) for i in range(SIZE)] if library.probe(a) else None

    return inverted


def in_python():
    found = needed("python", ["invert"])
    namespace = {"fabs": abs, "isfinite": math.isfinite}
    exec("\n\n".join(found.texts), namespace)

    def inverted(rows):
        a = [x for row in rows for x in row]
        done = namespace["invert"](SIZE, a)
        return [a[SIZE * i : SIZE * (i + 1)] for i in range(SIZE)] if done else None

    return inverted


@pytest.fixture(scope="module")
def versions():
    return [in_c(0), in_c(SIZE), in_python()]


def matrices():
    rng = random.Random(6)
    for _ in range(20):
        yield [[rng.uniform(-1, 1) for _ in range(SIZE)] for _ in range(SIZE)]
    yield [[float(j == (i + 1) % SIZE) for j in range(SIZE)] for i in range(SIZE)]  # no entry on the diagonal


def test_an_inverse_times_the_matrix_is_one(versions):
    for a in matrices():
        error = np.array(versions[1](a)) @ np.array(a) - np.eye(SIZE)
        assert np.abs(error).max() < 1e-13 * np.linalg.cond(a)


def test_all_versions_round_alike(versions):
    for a in matrices():
        assert versions[0](a) == versions[1](a) == versions[2](a)


def test_what_has_no_inverse_is_refused(versions):
    rows = [[float(i * j) for j in range(SIZE)] for i in range(SIZE)]
    assert [invert(rows) for invert in versions] == [None, None, None]


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_a_matrix_with_an_entry_that_is_not_finite_is_refused(versions, value):
    """The reciprocal of an infinite pivot is 0, so the infinity could disappear."""
    for place in range(SIZE * SIZE):
        rows = next(matrices())
        rows[place // SIZE][place % SIZE] = value
        assert [invert(rows) for invert in versions] == [None, None, None]
