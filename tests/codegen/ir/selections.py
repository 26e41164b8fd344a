"""Formulas with functions that select, angles and tables: sympy formulas of x and y for tests."""

from __future__ import annotations

import sympy

from codegen.scene import table

x, y = sympy.symbols("x y", real=True)
XS, YS = [0, 0.5, 1.1, 2, 3], [1.0, 0.3, -0.2, 0.7, 0.6]

FORMULAS = {
    "abs": sympy.Abs(y - 3) * x,
    "sign": sympy.sign(y - 2) * x + y,
    "minimum": sympy.Min(x, y, sympy.Rational(1, 3)) * y,
    "maximum": sympy.Max(x * y, y / 3),
    "heaviside": sympy.Heaviside(x - y) * y + x,
    "roots": sympy.Piecewise((sympy.sqrt(x - 2) * y, x > 2), (sympy.log(x) * y, x > 0), (y, True)),
    "conditions": sympy.Piecewise(
        (x * y, (x > 1) & (y <= sympy.Rational(3, 2))),
        (1 / (x - 1), sympy.Or(x >= 2, sympy.Ne(y, sympy.Rational(3, 2)))),
        (y, True),
    ),
    "angle": sympy.atan2(x, y),
    "spline": table(XS, YS, x) * y,
    "line": table(XS, YS, x * y, "linear") + x,
    "beyond": table(XS, YS, 4 * y, outside="extrapolate") * x,
}
"""Each formula is smooth near (2/5, 1) and near the other points of the tests."""
