"""Free rigid body on the sphere (thesis section 2.8): one step by cg:cg3

method:     family cg, tableau cg3
source:     Crouch and Grossman 1993; Hairer, Lubich and Wanner, Table IV.8.1, left
order:      3, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Free rigid body on the sphere (thesis section 2.8), group SO(3)
state:      [0..2] y: point that SO(3) acts on by rotation
left out:   1 field (sharing)
            6 act (fusion)
            6 exp (dead code)
            parameters, folded: alpha = 0
            the time: the scene does not depend on it
            equation solving: every stage is explicit here
operations: 84 add, 156 mul, 6 stumpff_12 a step
made by:    orderconds emit free_rigid_body --method cg:cg3 --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_cg3

    state = [0.4535961214255773, 0.0, 0.8912073600614354]
    print(free_rigid_body_cg3.run(state, 0.02, 100))
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
    w1 = 0.2549019607843137 * h
    x_0 = k0_0 * w1
    w2 = m1 * w1
    k0_2 = -1.5 * m2
    x_2 = w1 * k0_2
    w3 = x_0 * x_0 + w2 * w2 + x_2 * x_2
    c1_1, c2_1 = _stumpff_12(w3)
    w5 = m2 * w2 + m1 * x_2
    w7 = m1 * x_0 + m0 * w2
    w8 = m0 * x_2 - m2 * x_0
    Y_0 = m0 - w5 * c1_1 - (w2 * w7 + x_2 * w8) * c2_1
    w9 = 0.75 * h
    x2_0 = k0_0 * w9
    w10 = m1 * w9
    x2_2 = k0_2 * w9
    w11 = x2_0 * x2_0 + w10 * w10 + x2_2 * x2_2
    c1_2, c2_2 = _stumpff_12(w11)
    w13 = m2 * w10 + m1 * x2_2
    w15 = m1 * x2_0 + m0 * w10
    w16 = m0 * x2_2 - m2 * x2_0
    f2_0 = -0.5 * (m0 - w13 * c1_2 - (w10 * w15 + x2_2 * w16) * c2_2)
    w17 = -0.6666666666666666 * h
    x_2_0 = f2_0 * w17
    f2_1 = (x2_2 * w13 + x2_0 * w15) * c2_2 - (m1 + w16 * c1_2)
    x_2_1 = w17 * f2_1
    f2_2 = -1.5 * (m2 + w15 * c1_2 + (x2_0 * w16 - w10 * w13) * c2_2)
    x_2_2 = w17 * f2_2
    w18 = x_2_0 * x_2_0 + x_2_1 * x_2_1 + x_2_2 * x_2_2
    c1_3, c2_3 = _stumpff_12(w18)
    Y_2 = m2 + w7 * c1_1 + (x_0 * w8 - w2 * w5) * c2_1
    Y_1 = m1 + w8 * c1_1 - (x_2 * w5 + x_0 * w7) * c2_1
    w20 = x_2_1 * Y_2 - x_2_2 * Y_1
    w22 = x_2_0 * Y_1 - Y_0 * x_2_1
    w23 = Y_0 * x_2_2 - x_2_0 * Y_2
    Y_2_0 = Y_0 + w20 * c1_3 + (x_2_1 * w22 - x_2_2 * w23) * c2_3
    w24 = 0.5509259259259259 * h
    x3_0 = k0_0 * w24
    w25 = m1 * w24
    x3_2 = k0_2 * w24
    w26 = x3_0 * x3_0 + w25 * w25 + x3_2 * x3_2
    c1_4, c2_4 = _stumpff_12(w26)
    w28 = m2 * w25 + m1 * x3_2
    w30 = m1 * x3_0 + m0 * w25
    w31 = m0 * x3_2 - m2 * x3_0
    Y3_0 = m0 - w28 * c1_4 - (w25 * w30 + x3_2 * w31) * c2_4
    w32 = 0.1574074074074074 * h
    x3_2_0 = f2_0 * w32
    x3_2_1 = f2_1 * w32
    x3_2_2 = f2_2 * w32
    w33 = x3_2_0 * x3_2_0 + x3_2_1 * x3_2_1 + x3_2_2 * x3_2_2
    c1_5, c2_5 = _stumpff_12(w33)
    Y3_2 = m2 + w30 * c1_4 + (x3_0 * w31 - w25 * w28) * c2_4
    Y3_1 = m1 + w31 * c1_4 - (x3_2 * w28 + x3_0 * w30) * c2_4
    w35 = x3_2_1 * Y3_2 - x3_2_2 * Y3_1
    w37 = x3_2_0 * Y3_1 - Y3_0 * x3_2_1
    w38 = Y3_0 * x3_2_2 - x3_2_0 * Y3_2
    w39 = 1.411764705882353 * h
    x_3_0 = -0.5 * (Y3_0 + w35 * c1_5 + (x3_2_1 * w37 - x3_2_2 * w38) * c2_5) * w39
    w40 = w39 * (Y3_1 + w38 * c1_5 + (x3_2_2 * w35 - x3_2_0 * w37) * c2_5)
    x_3_2 = -1.5 * (Y3_2 + w37 * c1_5 + (x3_2_0 * w38 - x3_2_1 * w35) * c2_5) * w39
    w41 = x_3_0 * x_3_0 + w40 * w40 + x_3_2 * x_3_2
    c1_6, c2_6 = _stumpff_12(w41)
    Y_2_2 = Y_2 + w22 * c1_3 + (x_2_0 * w23 - x_2_1 * w20) * c2_3
    Y_2_1 = Y_1 + w23 * c1_3 + (x_2_2 * w20 - x_2_0 * w22) * c2_3
    w43 = w40 * Y_2_2 + x_3_2 * Y_2_1
    w45 = Y_2_0 * w40 + x_3_0 * Y_2_1
    w46 = Y_2_0 * x_3_2 - x_3_0 * Y_2_2
    new_m0 = Y_2_0 - w43 * c1_6 - (w40 * w45 + x_3_2 * w46) * c2_6
    new_m1 = Y_2_1 + w46 * c1_6 - (x_3_2 * w43 + x_3_0 * w45) * c2_6
    new_m2 = Y_2_2 + w45 * c1_6 + (x_3_0 * w46 - w40 * w43) * c2_6
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
