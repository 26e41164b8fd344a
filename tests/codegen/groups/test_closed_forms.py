"""The closed forms of exp, dexp, dexp* and their inverses, in emitted code, against their definitions.

A probe scene turns closed forms into emitted code: its action replaces the state (x, v, ...) by the results
of all operations on x and v. The reference is the series of the definition in 60 digits, at the doubles x and
v.
"""

from __future__ import annotations

import math
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from unittest.mock import patch

import mpmath
import pytest
from flint import arb, arb_mat, ctx
from sympy import Matrix, Symbol

from codegen.emitter import emit
from codegen.groups import SE2, SE3, SE23, SL2, SO2, SO3, SU2, Rn, Semidirect
from codegen.groups.actions import Action
from codegen.groups.base import LieGroup
from codegen.groups.capabilities import ClosedFormSeries
from codegen.groups.representations import PlaneVectors
from codegen.ir.ad_series import Factor
from codegen.ir.domain import FloatDomain, PreciseDomain
from codegen.loader import load
from codegen.scene import FieldScene

DIGITS = 60
UNITS = 8
"""The largest error in units of the last place, for an angle of one; it grows with the angle."""

GROUPS = {
    "SO(2)": SO2(),
    "SO(3)": SO3(),
    "SU(2)": SU2(),
    "SL(2)": SL2(),
    "SE(2)": SE2(),
    "SO(2) |x R^2": Semidirect(SO2(), PlaneVectors()),
    "SE(3)": SE3(),
    "SE(3) over SU(2)": SE3(SU2()),
    "SE_2(3)": SE23(),
}
QUICK = (("SE(3)", "c"), ("SL(2)", "python"))

WORDS = {
    "dexp": ((Factor("dexp", Fraction(1)),), False),
    "left dexp": ((Factor("dexp", Fraction(-1)),), False),
    "dexp*": ((Factor("dexp", Fraction(1)),), True),
    "left dexp*": ((Factor("dexp", Fraction(-1)),), True),
    "1/dexp": ((Factor("dexp", Fraction(1), 0, -1),), False),
    "1/dexp*": ((Factor("dexp", Fraction(1), 0, -1),), True),
    "left 1/dexp": ((Factor("dexp", Fraction(-1), 0, -1),), False),
    "left 1/dexp*": ((Factor("dexp", Fraction(-1), 0, -1),), True),
}
"""The functions of ad_x, and whether ad*_x replaces ad_x."""

TWO_PI = 2 * math.pi
ANGLES = [
    *(1e-300, 1e-160, 1e-16, 1e-8, 1e-3, 0.0624, 0.0626, 0.249, 0.251, 0.5, 0.999, 1.001, 1.999, 2.001, 3.0),
    *(math.pi - 1e-9, math.pi, math.pi + 1e-9, TWO_PI - 1e-9, TWO_PI, TWO_PI + 1e-9),
]


@dataclass
class Probe(Action):
    """The map of (x, v, w) to (x, v, w + F(x, v) - F(0, v)), where x is also an element of R^n.

    F(x, v) contains exp x and the functions of ad_x applied to v. Zero acts as the identity, as in an action.
    """

    group: LieGroup
    name = "probe"

    def velocity(self, d, group, x, y):
        """Return the derivative of :meth:`act` as a central difference."""
        step = d.rational(1, 10**12)
        ends = [self.act(d, group, tuple(sign * step * a for a in x), y) for sign in (1, -1)]
        return tuple((a - b) / (2 * step) for a, b in zip(*ends, strict=True))

    def act(self, d, group, g, y):
        """Return the results of all operations."""
        group, n = self.group, self.group.dim
        v = y[n : 2 * n]
        results, before = [*group.exp(d, g)], [*group.identity(d)]
        closed = group.offers(ClosedFormSeries)
        for word, dual in WORDS.values() if closed is not None else ():
            results += closed.series(d, word, dual, g, v)
            before += v
        if closed is None:
            results += group.dexpt(d, g, v)
            before += v
        moved = (a + (b - c) for a, b, c in zip(y[2 * n :], results, before, strict=True))
        return (*y[: 2 * n], *moved)


def words(group: LieGroup) -> list[str]:
    """The functions of ad that a group has in closed form."""
    return list(WORDS) if group.offers(ClosedFormSeries) else ["dexp*"]


def length(group: LieGroup) -> int:
    return 2 * group.dim + group.size + group.dim * len(words(group))


@cache
def emitted(name, target):
    group = GROUPS[name]
    y = [Symbol(f"y{k}", real=True) for k in range(length(group))]
    start = [Fraction(1, 3)] * len(y)
    x = Matrix(y[: group.dim])
    # The probe is not an action of R^n, so the laws of actions are not checked.
    with patch("codegen.scene.field_scene.check_action"):
        scene = FieldScene(
            group=Rn(group.dim),
            action=Probe(group),
            y=Matrix(y),
            f=x,
            y0=start,
            span=(0, 1),
            name="probe",
        )
    return load(emit(scene, "rkmk(0):euler", target))


def operator(group, x, scale):
    """The matrix of dexp_(scale x) = sum of ad^k/(k+1)!, a block of the exponential of [[ad, 1], [0, 0]]."""
    n = group.dim
    units = [tuple(arb(int(i == j)) for j in range(n)) for i in range(n)]
    columns = [group.ad(Balls(), tuple(scale * a for a in x), e) for e in units]
    rows = [[*(columns[j][i] for j in range(n)), *units[i]] for i in range(n)]
    whole = arb_mat([*rows, *([[arb(0)] * 2 * n] * n)]).exp()
    return arb_mat([[whole[i, n + j] for j in range(n)] for i in range(n)])


class Balls:
    """The constants of the domain of balls, which the brackets of a group use."""

    def rational(self, p, q=1):
        """Return p/q."""
        return arb(p) / q


def operators(group, x):
    """The matrix of each function of ad_x, by name."""
    right, left = operator(group, x, 1), operator(group, x, -1)
    # At a full turn dexp has no inverse.
    turn = math.hypot(*map(float, x[: rotations(group)]))
    inverse, opposite = (right.inv(), left.inv()) if abs(turn - TWO_PI) > 1e-10 else (None, None)
    return {
        "dexp": right,
        "left dexp": left,
        "dexp*": right.transpose(),
        "left dexp*": left.transpose(),
        **({} if inverse is None else {"1/dexp": inverse, "1/dexp*": inverse.transpose()}),
        **({} if opposite is None else {"left 1/dexp": opposite, "left 1/dexp*": opposite.transpose()}),
    }


@cache
def expected(name, x, v):
    """For each function of ad_x its value at v, the sum of the absolute values of its terms, and the change
    of the value if x changes by a unit in the last place."""
    group, unit = GROUPS[name], 2.0**-52
    with precision():
        exact = [operators(group, [arb(a) * (1 + arb(s) * unit) for a in x]) for s in (0, 1, -1)]
        column = arb_mat([[arb(b)] for b in v])
        found = {}
        for word, matrix in exact[0].items():
            values = [number(y) for y in (matrix * column).entries()]
            rows = [sum(abs(number(matrix[i, j]) * v[j]) for j in range(len(v))) for i in range(len(v))]
            ends = [[number(y) for y in (m[word] * column).entries()] for m in exact[1:] if word in m]
            change = max(abs(a - b) for end in ends for a, b in zip(end, values, strict=True))
            found[word] = values, max(rows), change
        return found


def number(x):
    """The midpoint of a ball as a number of mpmath; the ball must be small."""
    assert x.rad() <= abs(x.mid()) * arb(2) ** -150 + arb(2) ** -150
    return mpmath.mpf(x.mid().str(DIGITS, radius=False))


@contextmanager
def precision():
    """Work with balls of 400 bits and mpmath numbers of as many digits as the reference has."""
    before, ctx.prec = ctx.prec, 400
    try:
        with mpmath.workdps(DIGITS):
            yield
    finally:
        ctx.prec = before


def rotations(group):
    """The number of components of the angular velocity."""
    return 1 if isinstance(group, SE2) else getattr(group, "linear", group).dim


def point(group, angle):
    """An element of the algebra whose rotation has a given angle, and a vector."""
    turning = {1: (1.0,), 3: (2 / 7, -3 / 7, 6 / 7)}
    linear = rotations(group)
    x = [angle * a for a in turning[linear]]
    others = [0.7, -1.3, 0.4, 0.9, -0.2, 1.1]
    return x + others[: group.dim - linear], [0.3, -0.8, 0.5, 1.2, -0.6, 0.9, -1.1, 0.2, 0.7][: group.dim]


def check(name, target, x, v):
    group = GROUPS[name]
    start = [*x, *v, *group.identity(FloatDomain(0.0)), *list(v) * len(words(group))]
    found = emitted(name, target).step(start, 1.0)[2 * group.dim :]
    with mpmath.workdps(DIGITS):
        d = PreciseDomain(Fraction(1), DIGITS)
        element = group.exp(d, tuple(d.context.mpf(a) for a in x))
        angle = max(1.0, math.hypot(*x))
        allowed = UNITS * angle * 2.0**-53 * max(1, *map(abs, element))
        for a, b in zip(found, element, strict=False):
            assert abs(a - b) <= allowed, ("exp", float(a - b))
        for word, (value, size, change) in expected(name, tuple(x), tuple(v)).items():
            if word not in words(group):
                continue
            first = group.size + words(group).index(word) * group.dim
            allowed = UNITS * (angle * 2.0**-53 * size + change)
            for a, b in zip(found[first : first + group.dim], value, strict=True):
                assert abs(a - b) <= allowed, (word, float(a), float(b), float(allowed))


CASES = [
    pytest.param(
        name, target, id=f"{name}-{target}", marks=() if (name, target) in QUICK else pytest.mark.slow
    )
    for name in GROUPS
    for target in ("c", "python")
]


@pytest.mark.parametrize(("name", "target"), CASES)
def test_closed_forms_are_accurate_from_zero_to_beyond_a_turn(name, target):
    for angle in ANGLES:
        check(name, target, *point(GROUPS[name], angle))


@pytest.mark.parametrize("target", ["c", "python"])
def test_closed_forms_of_sl2_hold_for_all_eigenvalues(target):
    """Hyperbolic and parabolic elements, and rotations by angles up to a turn of the adjoint map."""
    elements = [
        (1.0, 2.0, 0.25),
        (3.0, -3.0, 3.0),
        (1e-300, 2e-160, 0.0),
        (0.5, -2.0, 1.0),
        (1.0, 0.999, 1e-9),
    ]
    angles = (1e-300, 1e-8, 1.5, 3.0, math.pi - 1e-9, math.pi + 1e-9)
    for x in (*elements, *((a, -a, 0.0) for a in angles)):
        check("SL(2)", target, x, (0.3, -0.8, 0.5))


@pytest.mark.parametrize("name", [name for name, group in GROUPS.items() if group.offers(ClosedFormSeries)])
def test_the_exponential_of_the_reference_is_that_of_the_definition(name):
    """The reference for exp is the group itself in 80 digits: its velocity is x.exp(s x)."""
    group, d = GROUPS[name], PreciseDomain(Fraction(1), DIGITS)
    x, mp = tuple(d.context.mpf(a) for a in point(group, 2.5)[0]), d.context
    step = mp.mpf(10) ** -20
    ends = [group.exp(d, tuple((1 + s * step) * a for a in x)) for s in (1, -1)]
    rate = [(a - b) / (2 * step) for a, b in zip(*ends, strict=True)]
    expected = group.velocity(d, x, group.exp(d, x))
    assert max(abs(a - b) for a, b in zip(rate, expected, strict=True)) < mp.mpf(10) ** -35
