"""Jets: derivatives by the rules of calculus, and nothing lost where a variable has not entered."""

from __future__ import annotations

from flint import arb, arb_mat

from orderconds.ring.jets import Jet, Jets
from orderconds.ring.precision import precision


def test_slopes_are_those_of_the_formula() -> None:
    with precision(128):
        ring = Jets(3)
        x, y, z = (ring.variable(i, arb(v)) for i, v in enumerate((2, 3, 5)))
        for found, expected in [
            (x + y, (1, 1, 0)),
            (x - 2 * y + 7, (1, -2, 0)),
            (x * y, (3, 2, 0)),
            (x * y * x, (12, 4, 0)),
            ((x + z) * (y + z), (8, 7, 15)),
            (x**3 / 4, (3, 0, 0)),
            ((1 - z) * ring.rational(3, 2), (0, 0, -1.5)),
            (ring.root(x * 2, 2) * y, (1.5, 2, 0)),
            (-(z**-1), (0, 0, arb(1) / 25)),
            (y / x, (-0.75, 0.5, 0)),
            (ring.rational(5), (0, 0, 0)),
        ]:
            assert all(
                (g - e).contains(0) and g.rad() < 1e-30 for g, e in zip(found.gradient, expected, strict=True)
            )


def test_a_slope_that_is_not_touched_is_the_one_that_would_be_computed() -> None:
    with precision(200):
        ring = Jets(2)
        x = ring.variable(0, arb(1) / 3)
        dense = Jet(x.value, 2, arb_mat([[1, 0]]))
        for sparse, full in [(x * x + x, dense * dense + dense), (1 / (x + 2), 1 / (dense + 2))]:
            pairs = zip((sparse.value, *sparse.gradient), (full.value, *full.gradient), strict=True)
            assert all(str(a.mid()) == str(b.mid()) and str(a.rad()) == str(b.rad()) for a, b in pairs)
