"""The gallery's references against digits kept here, published numbers, invariants and closed forms."""

from __future__ import annotations

import mpmath
import pytest

from codegen.ir.domain import PreciseDomain
from codegen.lab.reference import reference
from codegen.scenes import load

DOMAIN = PreciseDomain(0, 45)

KEPT = {
    "driven_spin": (
        "0.39487172689305533683979312893099 0.45711748393985351495789279455874 0.79694411672148887411020845859758"
    ),
    "heavy_top": (
        "-0.25043581906025738792990871283567 -0.76467465724034635544346826555845 0.59376305805091717538453440966237 "
        "0.43010514407669864790528029695531 -0.63733738050798865316750704721876 -0.63938300606598669840849942383296 "
        "0.86734737306939502852901597908667 0.095256138813066018088100343643956 0.48850261252939638429386960584635 "
        "-5112.407961375768858446128934562 -65928.578299026365014723622896279 42746.846938112282231179702816668"
    ),
    "free_rigid_body_attitude": (
        "0.73516815103300685888241293226373 0.037281660543043521312942286690639 0.67685882390190000980987732061079 "
        "0.64626670006295419187343031765117 0.26283969750625812719483177225157 -0.71641792677497841180580439266103 "
        "-0.2046146184817927922104834185599 0.96411896112563412082302397974572 0.16913747870173062981635071798698 "
        "1.8 0.4 -0.9"
    ),
    "fast_heavy_top": (
        "-0.48744908223626571034119550651998 -0.15041682274564175981003083072188 0.86009776866477711868463808592742 "
        "-0.53793974384415059330852785578959 -0.7241655916368956507485543970962 -0.43151480609832443127963554425784 "
        "0.68776029561171377099795594519622 -0.6730222695604440960502210469884 0.27207866593284562739332583924832 "
        "-88.210437710671374351707527727186 -13.425569140880910407670848545349 -70.3124296875"
    ),
    "stiff_driven_spin": (
        "-0.041993890372205292148037817314859 -0.027203324196412282905438114252136 "
        "0.99874746173598463553467513419668"
    ),
}
"""States at the end of the span, from two codes: extrapolation with mpmath's numbers and with Arb's."""

MINUTES = ("fast_heavy_top", "stiff_driven_spin")
NAMES = [pytest.param(n, marks=pytest.mark.slow) if n in MINUTES else n for n in KEPT]


def kept(name):
    return tuple(DOMAIN.context.mpf(x) for x in KEPT[name].split())


@pytest.mark.parametrize("name", NAMES)
def test_the_reference_is_the_one_kept_here(name):
    found = reference(load(name))
    for x, y in zip(found.state, kept(name), strict=True):
        assert abs(x - y) < 1e-25 * max(1, abs(y))


@pytest.mark.parametrize("name", KEPT)
def test_the_reference_keeps_every_invariant(name):
    scene = load(name)
    for invariant in scene.invariants:
        before = scene.invariant(DOMAIN, invariant, scene.initial(DOMAIN))
        after = scene.invariant(DOMAIN, invariant, kept(name))
        assert abs(after - before) < 1e-25 * max(1, abs(before))


def rows(state):
    return mpmath.matrix(3, 3) + mpmath.matrix([state[0:3], state[3:6], state[6:9]])


@pytest.mark.parametrize("name", [n for n in KEPT if "spin" not in n])
def test_the_attitude_stays_a_rotation(name):
    with mpmath.workdps(45):
        g = rows(kept(name))
        assert mpmath.norm(g.T * g - mpmath.eye(3)) < 1e-25
        assert mpmath.det(g) > 0


def test_the_fast_top_has_the_published_angular_velocity():
    """The world's omega_y at t = 2 is -106.16380414 (Bruels and Cardona 2010)."""
    with mpmath.workdps(45):
        state = kept("fast_heavy_top")
        g, mu = rows(state), mpmath.matrix(state[9:])
        inertia = mpmath.diag([mpmath.mpf(x) for x in ("15.234375", "0.46875", "15.234375")])
        omega = g * inertia**-1 * g.T * mu
        assert mpmath.nstr(omega[1], 11) == "-106.16380414"


def test_the_energy_of_the_top_as_printed_is_that_of_the_start():
    """H0 = 5 10^4 12 + 1: one half of 10^2 (1, 5, 6) 10^3 summed, and e3.e3."""
    scene = load("heavy_top")
    assert scene.invariant(DOMAIN, "energy", scene.initial(DOMAIN)) == 600001


