"""The bound of residuals is an upper bound, although it is rounded to a double."""

from __future__ import annotations

import math
import random
from fractions import Fraction

from codegen.rounded_conditions import upper


def test_a_rounded_bound_is_not_less_than_the_exact_bound_and_the_smallest_such_double() -> None:
    generator = random.Random(7)
    below = 0
    for _ in range(200):
        x = Fraction(generator.getrandbits(80) + 1, generator.getrandbits(90) + 1)
        y = upper(x)
        below += Fraction(float(x)) < x
        assert Fraction(y) >= x
        assert Fraction(math.nextafter(y, -math.inf)) < x
    assert below > 50  # rounding to the nearest double would be too small


def test_a_double_is_its_own_bound() -> None:
    assert upper(Fraction(0)) == 0.0
    assert upper(Fraction(3, 8)) == 0.375
