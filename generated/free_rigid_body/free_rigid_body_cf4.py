"""Free rigid body on the sphere (thesis section 2.8): one step by cf:cf4

method:     family cf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section
            2.2.1
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Free rigid body on the sphere (thesis section 2.8), group SO(3)
state:      [0..2] y: point that SO(3) acts on by rotation
left out:   1 field (sharing)
            5 act (fusion)
            5 exp (dead code)
            parameters, folded: alpha = 0
            the time: the scene does not depend on it
            equation solving: every stage is explicit here
operations: 89 add, 145 mul, 5 stumpff_12 a step
made by:    orderconds emit free_rigid_body --method cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_cf4

    state = [0.4535961214255773, 0.0, 0.8912073600614354]
    print(free_rigid_body_cf4.run(state, 0.02, 100))
"""

from math import cos, isfinite, sin, sqrt

OK = 0
NOT_FINITE = 2
BAD_STEP = 3


class StepFailed(ArithmeticError):
    """A step that could not be made.

    status: NOT_FINITE or BAD_STEP; step: how many steps were made before it;
    state: the last good state, as a tuple.
    """

    def __init__(self, status, reason):
        super().__init__(reason)
        self.status, self.reason, self.step, self.state = status, reason, 0, ()

    def __str__(self):
        return f"step {self.step + 1}: {self.reason}"


def _stumpff_small_2(z):
    """Return c_2(z) for z <= 1/16."""
    w = z * z
    w2 = w * w
    return (
        (0.5 + z * -0.041666666666666664)
        + w * (0.001388888888888889 + z * -2.48015873015873e-05)
        + w2 * (2.755731922398589e-07 + z * -2.08767569878681e-09)
    )


def _stumpff_small_1(z):
    """Return c_1(z) for z <= 1/16."""
    w = z * z
    w2 = w * w
    return (
        (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333333333 + z * -0.0001984126984126984)
        + w2 * (2.7557319223985893e-06 + z * -2.505210838544172e-08)
    )


def _stumpff_series_2(z):
    """Return c_2(z) = sum (-z)^j/(2j+2)! up to z = 1."""
    w = z * z
    w2 = w * w
    even = -2.08767569878681e-09 + w * -4.779477332387385e-14
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even
    odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd
    return 0.5 + z * (even + z * odd)


def _stumpff_series_1(z):
    """Return c_1(z) = sum (-z)^j/(2j+1)! up to z = 1."""
    w = z * z
    w2 = w * w
    even = -2.505210838544172e-08 + w * -7.647163731819816e-13
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even
    odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd
    return 1.0 + z * (even + z * odd)


def _stumpff_12_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    return _stumpff_12_far(z)


def _advance(state, h):
    """Return the state after one step as a tuple."""
    m0, m1, m2 = state
    k0_0 = -0.5 * m0
    w1 = 0.25 * h
    w2 = 0.5 * h
    x2_0 = k0_0 * w2
    w3 = m1 * w2
    k0_2 = -1.5 * m2
    x2_2 = w2 * k0_2
    w4 = x2_0 * x2_0 + w3 * w3 + x2_2 * x2_2
    c1_1, c2_1 = _stumpff_12(w4)
    w6 = m2 * w3 + m1 * x2_2
    w8 = m1 * x2_0 + m0 * w3
    w9 = m0 * x2_2 - m2 * x2_0
    Y2_0 = m0 - w6 * c1_1 - (w3 * w8 + x2_2 * w9) * c2_1
    f2_0 = -0.5 * Y2_0
    x3_0 = w2 * f2_0
    w10 = (x2_2 * w6 + x2_0 * w8) * c2_1
    w11 = m1 + w9 * c1_1
    f2_1 = w10 - w11
    x3_1 = w2 * f2_1
    Y2_2 = m2 + w8 * c1_1 + (x2_0 * w9 - w3 * w6) * c2_1
    f2_2 = -1.5 * Y2_2
    x3_2 = w2 * f2_2
    w12 = x3_0 * x3_0 + x3_1 * x3_1 + x3_2 * x3_2
    c1_2, c2_2 = _stumpff_12(w12)
    w14 = m2 * x3_1 - m1 * x3_2
    w16 = m1 * x3_0 - m0 * x3_1
    w17 = m0 * x3_2 - m2 * x3_0
    f3_0 = -0.5 * (m0 + w14 * c1_2 + (x3_1 * w16 - x3_2 * w17) * c2_2)
    w18 = 0.16666666666666666 * h
    w19 = (f2_0 + f3_0) * w18
    w20 = -0.5 * h
    x4_0 = k0_0 * w20 + h * f3_0
    Y3_1 = m1 + w17 * c1_2 + (x3_2 * w14 - x3_0 * w16) * c2_2
    w21 = m1 * w20 + h * Y3_1
    f3_2 = -1.5 * (m2 + w16 * c1_2 + (x3_0 * w17 - x3_1 * w14) * c2_2)
    x4_2 = k0_2 * w20 + h * f3_2
    w22 = x4_0 * x4_0 + w21 * w21 + x4_2 * x4_2
    c1_3, c2_3 = _stumpff_12(w22)
    Y2_1 = w11 - w10
    w24 = Y2_2 * w21 + x4_2 * Y2_1
    w26 = Y2_0 * w21 + x4_0 * Y2_1
    w27 = Y2_0 * x4_2 - Y2_2 * x4_0
    f4_0 = -0.5 * (Y2_0 - w24 * c1_3 - (w21 * w26 + x4_2 * w27) * c2_3)
    w28 = -0.08333333333333333 * h
    x_0 = k0_0 * w1 + w19 + f4_0 * w28
    w29 = w18 * (f2_1 - Y3_1)
    f4_1 = (x4_2 * w24 + x4_0 * w26) * c2_3 - (Y2_1 + w27 * c1_3)
    x_1 = w29 - m1 * w1 + w28 * f4_1
    w30 = w18 * (f2_2 + f3_2)
    f4_2 = -1.5 * (Y2_2 + w26 * c1_3 + (x4_0 * w27 - w21 * w24) * c2_3)
    x_2 = w30 + w1 * k0_2 + w28 * f4_2
    w31 = x_0 * x_0 + x_1 * x_1 + x_2 * x_2
    c1_4, c2_4 = _stumpff_12(w31)
    w33 = m2 * x_1 - m1 * x_2
    w35 = m1 * x_0 - m0 * x_1
    w36 = m0 * x_2 - m2 * x_0
    Y_0 = m0 + w33 * c1_4 + (x_1 * w35 - x_2 * w36) * c2_4
    x_2_0 = w19 + k0_0 * w28 + w1 * f4_0
    x_2_1 = w29 - m1 * w28 + w1 * f4_1
    x_2_2 = w30 + k0_2 * w28 + w1 * f4_2
    w37 = x_2_0 * x_2_0 + x_2_1 * x_2_1 + x_2_2 * x_2_2
    c1_5, c2_5 = _stumpff_12(w37)
    Y_2 = m2 + w35 * c1_4 + (x_0 * w36 - x_1 * w33) * c2_4
    Y_1 = m1 + w36 * c1_4 + (x_2 * w33 - x_0 * w35) * c2_4
    w39 = x_2_1 * Y_2 - x_2_2 * Y_1
    w41 = x_2_0 * Y_1 - Y_0 * x_2_1
    w42 = Y_0 * x_2_2 - x_2_0 * Y_2
    new_m0 = Y_0 + w39 * c1_5 + (x_2_1 * w41 - x_2_2 * w42) * c2_5
    new_m1 = Y_1 + w42 * c1_5 + (x_2_2 * w39 - x_2_0 * w41) * c2_5
    new_m2 = Y_2 + w41 * c1_5 + (x_2_0 * w42 - x_2_1 * w39) * c2_5
    return new_m0, new_m1, new_m2


def _checked(state, h):
    """Return the state after one step, which is finite."""
    try:
        new = _advance(state, h)
    except StepFailed:
        raise
    except (ArithmeticError, ValueError) as error:
        raise StepFailed(NOT_FINITE, f"the new state is not finite ({error})") from None
    if not all(map(isfinite, new)):
        raise StepFailed(NOT_FINITE, "the new state is not finite")
    return new


def step(state, h):
    """Return the state after one step of size h as a list; state itself is left alone.

    A step that cannot be made raises StepFailed.
    """
    return run(state, h, 1)


def run(state, h, steps, *, stride=0):
    """Return the state after that many steps of size h, as a list.

    With a positive stride, return rows instead: the initial state and every stride-th one
    after it. A step that cannot be made raises StepFailed, which holds the last good state.
    """
    state = tuple(map(float, state))
    h = float(h)
    if len(state) != 3:
        raise ValueError(f"expected 3 numbers in state, found {len(state)}")
    rows = [list(state)]
    made = 0
    try:
        if steps > 0 and not isfinite(h):
            raise StepFailed(BAD_STEP, f"the step size h = {h} is not finite")
        for made in range(steps):
            state = _checked(state, h)
            if stride > 0 and (made + 1) % stride == 0:
                rows.append(list(state))
    except StepFailed as failure:
        failure.step, failure.state = made, state
        raise
    return rows if stride > 0 else list(state)
