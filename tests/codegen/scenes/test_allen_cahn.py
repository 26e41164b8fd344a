"""The Allen-Cahn equation: its field, and Lie-Euler as the exponential Euler method."""

from __future__ import annotations

from fractions import Fraction

import mpmath

from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import interpret
from codegen.lower import families_for, lower, problem_for
from codegen.method import parse
from codegen.scenes import load

POINTS = 6


def second_difference():
    """Return eps (n + 1)^2 times the second difference with zeros at both ends, eps = 1/10."""
    L = mpmath.matrix(POINTS, POINTS)
    for i in range(POINTS):
        L[i, i] = mpmath.mpf(-98) / 10
        if i:
            L[i, i - 1] = L[i - 1, i] = mpmath.mpf(49) / 10
    return L


def test_lie_euler_is_the_exponential_euler_method():
    """exp(h L) u + h phi(h L) N(u) by a Taylor series with 60 digits."""
    scene, d = load("allen_cahn"), PreciseDomain(Fraction(1, 8), 45)
    method = parse("rkmk(0):euler", families_for(scene))
    start = scene.initial(d)
    found = interpret(lower(scene, method), problem_for(scene, method), d, {"y": start})["y"]
    with mpmath.workdps(60):
        step = mpmath.mpf(1) / 8 * second_difference()
        u = mpmath.matrix([mpmath.mpf(x) for x in start])
        phi, term = mpmath.eye(POINTS), mpmath.eye(POINTS)
        for k in range(2, 120):
            term = term * step / k
            phi += term
        expected = u + phi * (step * u + u / 8 - u.apply(lambda x: x**3) / 8)
        assert max(abs(mpmath.mpf(a) - b) for a, b in zip(found, expected, strict=True)) < 1e-40


def test_the_velocity_is_the_second_difference_and_the_reaction():
    scene, d = load("allen_cahn"), PreciseDomain(0, 45)
    with mpmath.workdps(45):
        u = mpmath.matrix([mpmath.mpf(k * k - 7) / 5 for k in range(POINTS)])
        rate = second_difference() * u + u - u.apply(lambda x: x**3)
        found = scene.velocity(d, tuple(u), d.rational(0))
        assert max(abs(a - b) for a, b in zip(rate, found, strict=True)) < 1e-40
