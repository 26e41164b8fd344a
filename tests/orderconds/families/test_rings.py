"""One engine over any ring: values over one ring map to values over another."""

from fractions import Fraction

import pytest

from orderconds import families
from orderconds.ring import QQ, Balls, Polynomials, PowerSeries
from orderconds.tableau import RungeKutta

LABELS = ("rk", "sprk", "cg", "cf", "rkmk(0)", "rkmk(1)", "rkmk(2)", "rkmk")


class Fractions:
    """The rationals as Python has them: all that the engines use of a ring."""

    name = "fractions"
    zero, one = Fraction(0), Fraction(1)

    def rational(self, p, q=1):
        return Fraction(p, q)

    def is_zero(self, x):
        return x == 0


class Floats(Fractions):
    name = "floats"
    zero, one = 0.0, 1.0

    def rational(self, p, q=1):
        return p / q


def mapped(method, convert):
    return RungeKutta(tuple(tuple(map(convert, row)) for row in method.A), tuple(map(convert, method.b)))


def values(name, method, ring, order=4):
    family = families.get(name)
    return [x for n in range(1, order + 1) for x in family.evaluate(method, ring, family.conditions(n))]


@pytest.mark.parametrize("name", LABELS)
def test_python_fractions_give_the_values_of_flint_rationals(name, random_tableau):
    method = random_tableau(3)
    over = values(name, mapped(method, lambda x: Fraction(int(x.p), int(x.q))), Fractions())
    assert [QQ.rational(x.numerator, x.denominator) for x in over] == values(name, method, QQ)


@pytest.mark.parametrize("name", LABELS)
def test_floats_give_the_values_to_rounding(name, tableaux):
    method = tableaux["rk4"]
    over = values(name, mapped(method, lambda x: int(x.p) / int(x.q)), Floats())
    assert over == pytest.approx([int(x.p) / int(x.q) for x in values(name, method, QQ)], abs=1e-14)


@pytest.mark.parametrize("name", LABELS)
def test_balls_contain_the_values(name, tableaux):
    method, balls = tableaux["cg3"], Balls(80)
    over = values(name, mapped(method, lambda x: balls.rational(int(x.p), int(x.q))), balls)
    differences = [
        x - balls.rational(int(y.p), int(y.q)) for x, y in zip(over, values(name, method, QQ), strict=True)
    ]
    assert all(balls.is_zero(difference) is not False for difference in differences)


@pytest.mark.parametrize("name", [name for name in LABELS if name != "sprk"])
def test_power_series_are_expansions_along_a_line_of_tableaux(name, random_tableau):
    # Values are polynomials in the coefficients (not so for sprk, where ahat divides), of degree at most 9:
    # the series in h along A + h D, b + h d is the whole polynomial, and may be summed at h = 1/7.
    ring, start, direction = PowerSeries(QQ, 9), random_tableau(2), random_tableau(2)
    along = RungeKutta(
        tuple(
            tuple(ring.constant(x) + ring.h * ring.constant(d) for x, d in zip(row, slope, strict=True))
            for row, slope in zip(start.A, direction.A, strict=True)
        ),
        tuple(
            ring.constant(x) + ring.h * ring.constant(d) for x, d in zip(start.b, direction.b, strict=True)
        ),
    )
    h = QQ.rational(1, 7)
    there = RungeKutta(
        tuple(
            tuple(x + h * d for x, d in zip(row, slope, strict=True))
            for row, slope in zip(start.A, direction.A, strict=True)
        ),
        tuple(x + h * d for x, d in zip(start.b, direction.b, strict=True)),
    )
    summed = [
        sum((c * h**n for n, c in enumerate(x.coefficients)), QQ.zero)
        for x in values(name, along, ring, order=3)
    ]
    assert summed == values(name, there, QQ, order=3)


@pytest.mark.parametrize("name", ["rk", "cg", "rkmk(1)"])
def test_polynomials_in_the_coefficients_spell_the_conditions_of_two_explicit_stages(name):
    ring = Polynomials(("a21", "b1", "b2"))
    a21, b1, b2 = (ring.generator(x) for x in ring.names)
    method = RungeKutta(((ring.zero, ring.zero), (a21, ring.zero)), (b1, b2))
    found = values(name, method, ring, order=3)
    assert found[:2] == [b1 + b2, b2 * a21]
    assert ring.zero in found  # sum b_i a_ij c_j vanishes with two explicit stages
    if name == "cg":
        assert found[-1] == b2 * b2 * a21
