from __future__ import annotations

import math
from fractions import Fraction
from random import Random

import mpmath
import pytest

from codegen.ir.domain import ExprDomain, FloatDomain, NotConverged, PreciseDomain, SeriesDomain, stumpff
from codegen.ir.kernel import Loop
from codegen.ir.number import Number
from orderconds.ring import QQ
from tests.strategies import shipped


def exact_stumpff(k, z):
    with mpmath.workdps(60):
        z = mpmath.mpf(z)
        terms = ((-z) ** j / mpmath.factorial(2 * j + k) for j in range(120))
        return sum(terms, mpmath.mpf(0))


ARGUMENTS = (0.0, 1e-300, 1e-14, 1e-7, 0.3, 0.4999, 0.5, 0.7, 1.0, 3.9999, 4.0, 9.8, 30.0, 200.0)


class TestStumpffFunctions:
    @pytest.mark.parametrize("k", range(4))
    @pytest.mark.parametrize("z", ARGUMENTS)
    def test_in_doubles_to_a_few_units_in_the_last_place(self, k, z):
        # Relative to the amplitude of the oscillation: c_0, c_1, c_2 have zeros. sqrt z is rounded once.
        root = math.sqrt(z)
        amplitude = min(1 / math.factorial(k), (1, 1 / root, 2 / z, 1 / z)[k] if z else 1.0)
        assert abs(stumpff(k, z) - exact_stumpff(k, z)) <= (4 + root) * 2.0**-53 * amplitude

    @pytest.mark.parametrize("k", range(4))
    @pytest.mark.parametrize("z", ARGUMENTS)
    def test_in_forty_digits(self, k, z):
        d = PreciseDomain(0, 40)
        found = d.call(f"stumpff{k}", d.context.mpf(z))
        assert abs(found - d.context.mpf(exact_stumpff(k, z))) <= 1e-38

    @pytest.mark.parametrize("k", range(4))
    def test_over_series_by_their_definition(self, k):
        d = SeriesDomain(QQ, 6)
        found = d.call(f"stumpff{k}", d.h)
        expected = [Fraction((-1) ** j, math.factorial(2 * j + k)) for j in range(7)]
        assert [Fraction(int(c.p), int(c.q)) for c in found.coefficients] == expected


class TestSeries:
    @pytest.mark.parametrize("function", ["sin", "cos", "exp"])
    def test_entire_functions_are_their_taylor_series(self, function):
        d = SeriesDomain(QQ, 8)
        with mpmath.workdps(30):
            expected = mpmath.taylor(getattr(mpmath, function), 0, 8)
            found = [mpmath.mpf(int(c.p)) / int(c.q) for c in d.call(function, d.h).coefficients]
            assert all(abs(c - e) < 1e-25 for c, e in zip(found, expected, strict=True))

    def test_addition_theorem(self):
        d = SeriesDomain(QQ, 7)
        x = d.h * 2 - d.h * d.h
        total = d.call("sin", x) * d.call("sin", x) + d.call("cos", x) * d.call("cos", x)
        assert d.ring.is_zero(total - 1) is True

    def test_a_constant_term_is_refused(self):
        d = SeriesDomain(QQ, 3)
        with pytest.raises(ArithmeticError, match="constant term"):
            d.call("sin", d.h + 1)

    def test_functions_without_exact_series_are_refused(self):
        d = SeriesDomain(QQ, 3)
        with pytest.raises(ArithmeticError, match="cannot be computed for exact power series"):
            d.call("sqrt", d.h)

    def test_numbers_of_the_base_field_stay_exact(self):
        tableau = shipped("gauss2")
        d = SeriesDomain(tableau.ring, 2)
        x = d.number(Number(tableau.ring, tableau.method.A[0][1]))
        assert d.ring.is_zero((x - d.rational(1, 4)) * (x - d.rational(1, 4)) - d.rational(1, 12)) is True

    def test_standing_still_is_exact(self):
        d = SeriesDomain(QQ, 3)
        nearly = d.h + d.h * d.h * d.h * d.rational(1, 10**30)
        assert d.settled([d.h], [d.h], None)[0]
        assert not d.settled([d.h], [nearly], None)[0]


class TestStandingStillInDoubles:
    def test_no_change_is_enough(self):
        assert FloatDomain(0.1).settled([1.0], [1.0], None) == (True, 0.0)

    def test_a_first_change_is_never_the_last(self):
        assert not FloatDomain(0.1).settled([1.0], [1.0 + 2.0**-50], None)[0]

    def test_the_last_change_contracts_to_below_rounding(self):
        d = FloatDomain(0.1)
        assert d.settled([1.0], [1.0 + 2.0**-50], 2.0**-46) == (True, 2.0**-50)  # next: 2^-54
        assert not d.settled([1.0], [1.0 + 2.0**-50], 2.0**-49)[0]  # next: 2^-51
        assert not d.settled([1.0], [1.0 + 2.0**-47], 2.0**-20)[0]  # a fast one is not trusted from afar

    def test_a_change_at_rounding_level_that_grows_is_the_last(self):
        d = FloatDomain(0.1)
        assert d.settled([1.0], [1.0 + 2.0**-45], 2.0**-46)[0]
        assert not d.settled([1.0], [1.0 + 2.0**-45], 2.0**-44)[0]

    def test_the_rule_is_that_of_loops(self):
        d, loop, random = FloatDomain(0.1), Loop("x", (), (), (), ()), Random(8)
        for _ in range(500):
            change, previous = (2.0 ** random.randint(-52, -40) for _ in range(2))
            small = change <= loop.close and change * change <= 2.0**-53 * previous
            still = previous <= change <= loop.tolerance
            assert d.settled([1.0], [1.0 + change], previous)[0] == (small or still)

    def test_a_large_change_is_not(self):
        assert not FloatDomain(0.1).settled([1.0], [1.1], 0.05)[0]

    def test_leaving_the_numbers_is_an_error(self):
        with pytest.raises(NotConverged, match="finite"):
            FloatDomain(0.1).settled([1.0], [math.inf], None)


def test_precise_numbers_are_rounded_at_the_domains_precision():
    d = PreciseDomain(Fraction(1, 3), 50)
    assert abs(d.h * 3 - 1) < 1e-49
    root = shipped("gauss2")
    x = d.number(Number(root.ring, root.method.c[0]))
    assert abs((x - d.rational(1, 2)) ** 2 - d.rational(1, 12)) < 1e-49


def test_expressions_are_not_iterated():
    with pytest.raises(NotConverged):
        ExprDomain().settled([], [], None)


@pytest.mark.parametrize("function", ["sin", "cos", "exp", "stumpff1", "slope2"])
def test_a_function_of_a_number_that_diverges_is_an_error_and_does_not_take_hours(function):
    d = PreciseDomain(0, 60)
    huge = d.context.mpf(10) ** (10**7)
    with pytest.raises(OverflowError, match="exceeds"):
        d.call(function, huge)
    assert abs(d.call("sin", d.context.mpf(10) ** 300)) <= 1
    assert d.call("stumpff0", d.context.mpf(0)) == 1
