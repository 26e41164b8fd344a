"""Heavy top as printed, T*SO(3) (thesis section 2.5): one step by slgi:midpoint

method:     family slgi, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Heavy top as printed, T*SO(3) (thesis section 2.5), group SO(3)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   the time: the scene does not depend on it
operations: 52 add, 80 mul, 1 stumpff_12, 1 stumpff_1 a step
            45 add, 78 mul, 1 stumpff_12, 2 stumpff_23 a sweep of the equations of
            xi1, n1
made by:    orderconds emit heavy_top --method slgi:midpoint --target python -o .
version:    orderconds 0.1.0

Use:

    import heavy_top_slgi_midpoint

    state = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 10000.0, 50000.0, 60000.0]
    print(heavy_top_slgi_midpoint.run(state, 0.01, 100))
"""

from math import cos, isfinite, sin, sqrt

OK = 0
NOT_CONVERGED = 1
NOT_FINITE = 2
BAD_STEP = 3


class StepFailed(ArithmeticError):
    """A step that could not be made.

    status: NOT_CONVERGED, NOT_FINITE or BAD_STEP; step: how many steps were made before it;
    state: the last good state, as a tuple.
    """

    def __init__(self, status, reason):
        super().__init__(reason)
        self.status, self.reason, self.step, self.state = status, reason, 0, ()

    def __str__(self):
        return f"step {self.step + 1}: {self.reason}"


class Statistics:
    """Fixed-point sweeps, added up over all steps that are given this object.

    sweeps: by block; most: the most that one block took in one step; failed: 1 + the
    block that failed, 0 if none has.
    """

    labels = [
        "the equations of xi1, n1",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 1, 0, 0

    def count(self, block, sweeps):
        """Add the sweeps of one block in one step."""
        self.sweeps[block] += sweeps
        self.most = max(self.most, sweeps)


def _failed(status, label, block, sweep, statistics):
    """Return the failure of a block, noted in the statistics."""
    if statistics is not None:
        statistics.count(block, sweep)
        statistics.failed = block + 1
    reason = "met a number that is not finite" if status == NOT_FINITE else "did not converge"
    return StepFailed(status, f"{label} {reason} after {sweep} sweeps")


def _stumpff_small_3(z):
    """Return c_3(z) for z <= 1/16."""
    w = z * z
    w2 = w * w
    return (
        (0.16666666666666666 + z * -0.008333333333333333)
        + w * (0.0001984126984126984 + z * -2.7557319223985893e-06)
        + w2 * (2.505210838544172e-08 + z * -1.6059043836821613e-10)
    )


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


def _stumpff_series_3(z):
    """Return c_3(z) = sum (-z)^j/(2j+3)! up to z = 4."""
    w = z * z
    w2 = w * w
    even = -1.9572941063391263e-20
    even = -1.6059043836821613e-10 + w * -2.8114572543455206e-15 + w2 * even
    even = -0.008333333333333333 + w * -2.7557319223985893e-06 + w2 * even
    odd = 3.868170170630684e-23
    odd = 7.647163731819816e-13 + w * 8.22063524662433e-18 + w2 * odd
    odd = 0.0001984126984126984 + w * 2.505210838544172e-08 + w2 * odd
    return 0.16666666666666666 + z * (even + z * odd)


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


def _stumpff_23(z):
    """Return, for z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_2(z), _stumpff_small_3(z)
    if z <= 1.0:
        return _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return 0.5 * (ratio * ratio), c3


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_1(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 0.0625:
        return _stumpff_small_1(z)
    if z <= 1.0:
        return _stumpff_series_1(z)
    s = sqrt(z if z <= 4503599627370496.0 else float("nan"))
    return sin(s) / s


def _advance(state, h, statistics):
    """Return the state after one step as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    w10 = -0.5 * h
    w17 = 0.5 * h
    # the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2
    xi1_0 = 0.001 * mu0
    xi1_1 = 0.0002 * mu1
    xi1_2 = 0.00016666666666666666 * mu2
    n1_0 = -g12
    n1_1 = g02
    n1_2 = 0.0
    previous_1 = 0.0
    for sweep in range(1, 101):
        w1 = h * xi1_0
        w2 = h * xi1_1
        w3 = h * xi1_2
        w4 = w1 * w1 + w2 * w2 + w3 * w3
        c2_1, c3_1 = _stumpff_23(w4)
        w6 = mu1 * w3 - mu2 * w2
        w8 = mu2 * w1 - mu0 * w3
        w9 = mu0 * w2 - mu1 * w1
        z_0 = xi1_0 * w10
        z_1 = xi1_1 * w10
        z_2 = xi1_2 * w10
        w11 = z_0 * z_0 + z_1 * z_1 + z_2 * z_2
        c2_2, c3_2 = _stumpff_23(w11)
        w12 = c2_2
        w13 = n1_2 * z_1 - n1_1 * z_2
        w15 = n1_1 * z_0 - n1_0 * z_1
        w16 = n1_0 * z_2 - n1_2 * z_0
        M1_0 = (
            mu0
            - w6 * c2_1
            + (w3 * w8 - w2 * w9) * c3_1
            + w17 * (n1_0 - w12 * w13 + (z_1 * w15 - z_2 * w16) * c3_2)
        )
        f1_0 = 0.001 * M1_0
        M1_1 = (
            mu1
            - w8 * c2_1
            + (w1 * w9 - w3 * w6) * c3_1
            + w17 * (n1_1 - w12 * w16 + (z_2 * w13 - z_0 * w15) * c3_2)
        )
        f1_1 = 0.0002 * M1_1
        M1_2 = (
            mu2
            - w9 * c2_1
            + (w2 * w6 - w1 * w8) * c3_1
            + w17 * (n1_2 - w12 * w15 + (z_0 * w16 - z_1 * w13) * c3_2)
        )
        f1_2 = 0.00016666666666666666 * M1_2
        X1_2 = xi1_2 * w17
        X1_0 = xi1_0 * w17
        X1_1 = xi1_1 * w17
        w18 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
        c1_1, c2_3 = _stumpff_12(w18)
        w20 = X1_2 * c1_1
        w22 = X1_0 * c2_3
        w23 = X1_1 * w22
        w24 = X1_2 * c2_3 * X1_2
        w25 = X1_1 * c2_3
        Q1_5 = (
            g02 * (w20 + w23)
            + g12 * (1.0 - (X1_0 * w22 + w24))
            + g22 * (X1_2 * w25 - X1_0 * c1_1)
        )
        Q1_2 = (
            g12 * (w23 - w20)
            + g02 * (1.0 - (w24 + X1_1 * w25))
            + g22 * (X1_2 * w22 + X1_1 * c1_1)
        )
        next_n1_0 = -Q1_5
        next_n1_2 = 0.0
        change_xi1_0 = abs(f1_0 - xi1_0)
        change_xi1_1 = abs(f1_1 - xi1_1)
        change_xi1_2 = abs(f1_2 - xi1_2)
        change_n1_0 = abs(next_n1_0 - n1_0)
        change_n1_1 = abs(Q1_2 - n1_1)
        change_n1_2 = abs(next_n1_2 - n1_2)
        change = max(
            change_xi1_0,
            change_xi1_1,
            change_xi1_2,
            change_n1_0,
            change_n1_1,
            change_n1_2,
        )
        scale = max(
            1.0,
            abs(xi1_0),
            abs(xi1_1),
            abs(xi1_2),
            abs(n1_0),
            abs(n1_1),
            abs(n1_2),
        )
        total = (
            change_xi1_0
            + change_xi1_1
            + change_xi1_2
            + change_n1_0
            + change_n1_1
            + change_n1_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_1 = change
        xi1_0 = f1_0
        xi1_1 = f1_1
        xi1_2 = f1_2
        n1_0 = next_n1_0
        n1_1 = Q1_2
        n1_2 = next_n1_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    Y_1 = h * f1_1
    Y_0 = h * f1_0
    Y_2 = h * f1_2
    w26 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
    c1_2, c2_4 = _stumpff_12(w26)
    w28 = Y_1 * c2_4
    w29 = Y_1 * w28
    w30 = Y_2 * c2_4 * Y_2
    g_0 = 1.0 - (w29 + w30)
    w31 = Y_0 * c2_4
    w32 = Y_1 * w31
    w34 = Y_2 * c1_2
    g_1 = w32 - w34
    w35 = Y_1 * c1_2
    w36 = Y_2 * w31
    g_2 = w35 + w36
    g_3 = w32 + w34
    w37 = Y_0 * w31
    g_4 = 1.0 - (w30 + w37)
    w38 = Y_2 * w28
    w39 = Y_0 * c1_2
    g_5 = w38 - w39
    g_6 = w36 - w35
    g_7 = w38 + w39
    g_8 = 1.0 - (w29 + w37)
    c1_3 = _stumpff_1(w11)
    w41 = z_2 * c1_3
    w42 = z_0 * w12
    w43 = z_1 * w42
    w44 = z_1 * w12
    w45 = z_2 * w12 * z_2
    mu1_0 = (
        mu0 * g_0
        + mu1 * g_1
        + mu2 * g_2
        + h * (Q1_2 * (w41 + w43) - Q1_5 * (1.0 - (z_1 * w44 + w45)))
    )
    mu1_1 = (
        mu0 * g_3
        + mu1 * g_4
        + mu2 * g_5
        + h * (Q1_2 * (1.0 - (w45 + z_0 * w42)) - Q1_5 * (w43 - w41))
    )
    w46 = h * (Q1_2 * (z_2 * w44 - z_0 * c1_3) - Q1_5 * (z_2 * w42 + z_1 * c1_3))
    new_g00 = g00 * g_0 + g10 * g_1 + g20 * g_2
    new_g01 = g01 * g_0 + g11 * g_1 + g21 * g_2
    new_g02 = g02 * g_0 + g12 * g_1 + g22 * g_2
    new_g10 = g00 * g_3 + g10 * g_4 + g20 * g_5
    new_g11 = g01 * g_3 + g11 * g_4 + g21 * g_5
    new_g12 = g02 * g_3 + g12 * g_4 + g22 * g_5
    new_g20 = g00 * g_6 + g10 * g_7 + g20 * g_8
    new_g21 = g01 * g_6 + g11 * g_7 + g21 * g_8
    new_g22 = g02 * g_6 + g12 * g_7 + g22 * g_8
    new_mu2 = mu0 * g_6 + mu1 * g_7 + mu2 * g_8 + w46
    return (
        new_g00,
        new_g01,
        new_g02,
        new_g10,
        new_g11,
        new_g12,
        new_g20,
        new_g21,
        new_g22,
        mu1_0,
        mu1_1,
        new_mu2,
    )


def _checked(state, h, statistics):
    """Return the state after one step, which is finite."""
    try:
        new = _advance(state, h, statistics)
    except StepFailed:
        raise
    except (ArithmeticError, ValueError) as error:
        raise StepFailed(NOT_FINITE, f"the new state is not finite ({error})") from None
    if not all(map(isfinite, new)):
        raise StepFailed(NOT_FINITE, "the new state is not finite")
    return new


def step(state, h, *, statistics=None):
    """Return the state after one step of size h as a list; state itself is left alone.

    A step that cannot be made raises StepFailed.
    """
    return run(state, h, 1, statistics=statistics)


def run(state, h, steps, *, stride=0, statistics=None):
    """Return the state after that many steps of size h, as a list.

    With a positive stride, return rows instead: the initial state and every stride-th one
    after it. A step that cannot be made raises StepFailed, which holds the last good state.
    """
    state = tuple(map(float, state))
    h = float(h)
    if len(state) != 12:
        raise ValueError(f"expected 12 numbers in state, found {len(state)}")
    rows = [list(state)]
    made = 0
    try:
        if steps > 0 and not isfinite(h):
            raise StepFailed(BAD_STEP, f"the step size h = {h} is not finite")
        for made in range(steps):
            state = _checked(state, h, statistics)
            if stride > 0 and (made + 1) % stride == 0:
                rows.append(list(state))
    except StepFailed as failure:
        failure.step, failure.state = made, state
        raise
    return rows if stride > 0 else list(state)
