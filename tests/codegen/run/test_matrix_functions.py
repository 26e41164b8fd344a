"""The matrix exponential and the inverse: against many digits, and alike in the executor, C and Python."""

from __future__ import annotations

import math
import random
from itertools import accumulate

import mpmath
import pytest
from cffi import FFI

from codegen.build import build
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.ir.matrix_functions import MatrixExponential, MatrixInverse
from codegen.ir.matrix_product import MatrixCommutator, MatrixProduct
from codegen.ir.precision import DOUBLE
from codegen.ir.unitary_exponential import SpecialUnitaryExponential
from codegen.printers.c.functions import FunctionPrinter as InC
from codegen.printers.c.words import RESERVED as WORDS_OF_C
from codegen.printers.python.functions import FunctionPrinter as InPython
from codegen.printers.python.terms import Constants
from codegen.printers.python.words import RESERVED as WORDS_OF_PYTHON
from codegen.run.execute import Machine
from codegen.run.identifiers import identify
from codegen.run.language import Unit
from codegen.run.matrix_functions import matrix_functions, matrix_tables

ULP = 2.0**-52
ROWS = (1, 2, 3, *(pytest.param(n, marks=pytest.mark.slow) for n in (4, 5, 6, 8)))


def skew(n, norm, rng):
    a = [[rng.gauss(0, 1) for _ in range(n)] for _ in range(n)]
    return scaled([[a[i][j] - a[j][i] for j in range(n)] for i in range(n)], norm)


def scaled(rows, norm):
    size = math.sqrt(sum(x * x for row in rows for x in row)) or 1.0
    return [x * (norm / size) for row in rows for x in row]


def unit(n, i, j):
    return [float((k, m) == (i, j)) for k in range(n) for m in range(n)]


def samples(n):
    """Pairs of a name and a matrix of at most norm 100."""
    rng = random.Random(n)
    for norm in (1e-300, 1e-8, 1e-3, 0.03, 0.2, 0.6, 0.7, 2.0, 10.0, 100.0):
        yield f"random, {norm}", scaled([[rng.gauss(0, 1) for _ in range(n)] for _ in range(n)], norm)
        yield f"skew, {norm}", skew(n, norm, rng)
        triangle = [[rng.gauss(0, 1) * (j > i) for j in range(n)] for i in range(n)]
        yield f"nilpotent, {norm}", scaled(triangle, norm)
        jordan = [[float(j == i + 1) - 0.5 * (i == j) for j in range(n)] for i in range(n)]
        yield f"defective, {norm}", scaled(jordan, norm)
        far = [[(10.0 if j > i else 0.1 * rng.gauss(0, 1)) - (i == j) for j in range(n)] for i in range(n)]
        yield f"far from normal, {norm}", scaled(far, norm)
    for turn in (math.pi, 2 * math.pi):
        for away in (-1e-9, 0.0, 1e-9):
            angle = turn + away
            places = zip(unit(n, 0, n - 1), unit(n, n - 1, 0), strict=True)
            yield f"angle {angle}", [angle * (x - y) for x, y in places]


def exact(n, a):
    """The exponential by mpmath's own function, with digits to spare."""
    context = mpmath.mp.clone()
    context.dps = 160
    rows = context.matrix([a[n * i : n * i + n] for i in range(n)])
    return list(context.expm(rows))


def frobenius(a):
    return mpmath.sqrt(sum(x * x for x in a))


@pytest.mark.parametrize("n", ROWS)
def test_the_error_is_at_most_8_times_1_plus_the_norm_ulps_of_the_norm(n):
    function = MatrixExponential(n)
    for name, a in samples(n):
        expected = exact(n, a)
        error = frobenius([x - y for x, y in zip(function.in_doubles(a), expected, strict=True)])
        assert error <= 8 * (1 + frobenius(a)) * ULP * frobenius(expected), name


@pytest.mark.parametrize("n", ROWS)
def test_the_exponential_of_a_skew_matrix_is_orthogonal_to_rounding(n):
    for name, a in samples(n):
        if name.startswith(("skew", "angle")):
            g = MatrixExponential(n).in_doubles(a)
            columns = [g[j::n] for j in range(n)]
            gram = [math.fsum(x * y for x, y in zip(p, q, strict=True)) for p in columns for q in columns]
            defect = max(abs(x - (k % (n + 1) == 0)) for k, x in enumerate(gram))
            assert defect <= 4 * (1 + math.hypot(*a)) * ULP, name


def test_the_derivative_is_the_block_of_a_larger_exponential():
    n = 3
    rng = random.Random(0)
    for norm in (1e-8, 0.1, 1.0, 30.0):
        a, e = (scaled([[rng.gauss(0, 1) for _ in range(n)] for _ in range(n)], x) for x in (norm, 1.0))
        whole = [
            x
            for i in range(2 * n)
            for x in (
                (*a[n * i : n * i + n], *e[n * i : n * i + n])
                if i < n
                else (*[0.0] * n, *a[n * (i - n) : n * (i - n) + n])
            )
        ]
        larger = exact(2 * n, whole)
        expected = [larger[2 * n * i + n + j] for i in range(n) for j in range(n)]
        found = MatrixExponential(n, 1).in_doubles([*a, *e])
        assert list(found[: n * n]) == list(MatrixExponential(n).in_doubles(a))
        error = frobenius([x - y for x, y in zip(found[n * n :], expected, strict=True)])
        assert error <= 16 * (1 + norm) * ULP * frobenius(expected)
        sharp = PreciseDomain(0, 40)
        digits = sharp.vector("expm3_d1", [sharp.context.mpf(x) for x in (*a, *e)])
        error = frobenius([x - y for x, y in zip(digits[n * n :], expected, strict=True)])
        assert error <= 1e-38 * frobenius(expected)


@pytest.mark.parametrize("size", [2.0**46, 1e200, math.inf, math.nan])
def test_a_result_with_fewer_than_three_digits_is_nan(size):
    turn = [0.0, size, -size, 0.0]
    assert all(map(math.isnan, MatrixExponential(2).in_doubles(turn)))
    assert any(map(math.isnan, MatrixExponential(2, 1).in_doubles([*turn, 1.0, 0.0, 0.0, 1.0])))


def test_a_result_with_three_digits_is_not_nan():
    size = 2.0**36
    found = MatrixExponential(2).in_doubles([0.0, size, -size, 0.0])
    assert abs(found[0] - mpmath.cos(size)) < 1e-3


def test_cancellation_in_the_squarings_is_seen():
    # The entries of exp(a/2) exceed those of exp(a) by 17 orders of magnitude.
    n, large = 3, 1e9
    a = [-1.0, large, 0.0, 0.0, -1.0, large, 0.0, 0.0, -1.0]
    b = [x * 40 for x in a]
    b[6] = -1e-3
    found = MatrixExponential(n).in_doubles(b)
    expected = exact(n, b)
    error = frobenius([x - y for x, y in zip(found, expected, strict=True)])
    assert any(map(math.isnan, found)) or error <= 1e-3 * frobenius(expected)


def arrays(function, a):
    """The arguments as one list for each array."""
    ends = list(accumulate(function.arrays))
    return [list(a[end - size : end]) for end, size in zip(ends, function.arrays, strict=True)]


def in_c(unit, function):
    printer = InC(unit, identify(unit, WORDS_OF_C), DOUBLE, "")
    lines = [line for table in unit.tables for line in printer.table(table)]
    lines += [line for f in unit.functions for line in (*printer.definition(f), "")]
    head = "void entry(const double *a, double *result)"
    given = [f"a + {sum(function.arrays[:k])}" for k in range(len(function.arrays))]
    entry = [f"{head};", f"{head} {{ {function.name}({', '.join(given)}, result); }}"]
    source = "\n".join(["#include <math.h>", "#include <string.h>", *lines, *entry])
    ffi = FFI()
    ffi.cdef(f"{head};")
    library = ffi.dlopen(str(build({"probe.c": source})))

    def call(a):
        result = ffi.new("double[]", function.size)
        library.entry(ffi.new("double[]", list(a)), result)
        return list(result)

    return call


def in_python(unit, function):
    printer = InPython(unit, identify(unit, WORDS_OF_PYTHON), Constants(DOUBLE, frozenset()))
    namespace = {"nan": math.nan, "inf": math.inf, "sqrt": math.sqrt}
    for table in unit.tables:
        exec("\n".join(printer.table(table)), namespace)
    for each in unit.functions:
        exec("\n".join(printer.definition(each)), namespace)

    def call(a):
        result = [0.0] * function.size
        namespace[f"_{function.name}"](*arrays(function, a), result)
        return result

    return call


def by_executor(unit, function):
    machine = Machine(unit, FloatDomain(0.0))

    def call(a):
        result = [0.0] * function.size
        machine.call(function.name, *arrays(function, a), result)
        return result

    return call


def same(found, expected):
    return all(x == y or (x != x and y != y) for x, y in zip(found, expected, strict=True))


@pytest.mark.parametrize("carried_out", [by_executor, in_python, in_c])
@pytest.mark.parametrize(
    "function",
    [
        MatrixExponential(3),
        MatrixExponential(5, 1),
        MatrixInverse(5),
        MatrixProduct(3),
        MatrixProduct(5),
        MatrixCommutator(6),
        SpecialUnitaryExponential(),
    ],
    ids=lambda f: f.name,
)
def test_emitted_functions_agree_with_the_domain_in_every_bit(function, carried_out):
    listed = matrix_functions([function], DOUBLE)
    call = carried_out(Unit((), (), matrix_tables([function], DOUBLE), tuple(listed)), function)
    rng = random.Random(1)
    for scale in (1e-300, 1e-5, 1e-2, 0.1, 1.0, 30.0, 1e20):
        a = [rng.gauss(0, 1) * scale for _ in range(sum(function.arrays))]
        assert same(call(a), function.in_doubles(a)), scale


def test_an_inverse_times_the_matrix_is_one():
    n, rng = 6, random.Random(2)
    a = [rng.gauss(0, 1) * (i != 0) for i in range(n * n)]  # the first pivot is zero
    b = MatrixInverse(n).in_doubles(a)
    for i in range(n):
        for j in range(n):
            entry = math.fsum(x * y for x, y in zip(a[n * i : n * i + n], b[j::n], strict=True))
            assert abs(entry - (i == j)) < 1e-13


def test_a_singular_matrix_has_no_inverse():
    assert all(map(math.isnan, MatrixInverse(2).in_doubles([1.0, 2.0, 2.0, 4.0])))


@pytest.mark.parametrize("carried_out", [by_executor, in_python, in_c])
def test_a_matrix_that_is_singular_or_not_finite_has_an_inverse_of_nans(carried_out):
    function = MatrixInverse(3)
    call = carried_out(Unit((), (), (), tuple(matrix_functions([function], DOUBLE))), function)
    for place in range(9):
        for value in (math.inf, -math.inf, math.nan):
            a = [3.0, 1.0, 0.0, 0.0, 0.0, 4.0, 0.0, 2.0, 1.0]
            a[place] = value
            assert all(map(math.isnan, function.in_doubles(a)))
            assert all(map(math.isnan, call(a))), (place, value)
    assert all(map(math.isnan, call([1.0, 2.0, 0.0, 2.0, 4.0, 0.0, 0.0, 0.0, 1.0])))


def test_the_text_of_the_functions_does_not_grow_with_the_matrix():
    lengths = set()
    for n in (5, 9):
        functions = [MatrixExponential(n, 1), MatrixInverse(n), MatrixProduct(n), MatrixCommutator(n)]
        unit = Unit((), (), matrix_tables(functions, DOUBLE), tuple(matrix_functions(functions, DOUBLE)))
        printer = InC(unit, identify(unit, WORDS_OF_C), DOUBLE, "")
        lengths.add(sum(len(printer.definition(f)) for f in unit.functions))
    assert len(lengths) == 1
