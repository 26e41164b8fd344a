"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:midpoint

method:     family vcg, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   3 Adtinv, 2 mul (zeros)
            1 identity (sharing)
            1 identity (dead code)
            1 dexpt (factors)
            1 lin (sharing)
            parameters, folded: beta = 1
            the time: the scene does not depend on it
operations: 90 add, 139 mul, 3 div, 2 sqrt, 1 stumpff_12 a step
            124 add, 191 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
made by:    orderconds emit dipole --method vcg:midpoint --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_midpoint

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_midpoint.run(state, 0.005, 100))
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


def _stumpff_series_3(z):
    """Return c_3(z) = sum (-z)^j/(2j+3)! for small z."""
    w = z * z
    w2 = w * w
    if z <= 0.0625:
        return (
            (0.16666666666666666 + z * -0.008333333333333333)
            + w * (0.0001984126984126984 + z * -2.7557319223985893e-06)
            + w2 * (2.505210838544172e-08 + z * -1.6059043836821613e-10)
        )
    even = -1.9572941063391263e-20
    even = -1.6059043836821613e-10 + w * -2.8114572543455206e-15 + w2 * even
    even = -0.008333333333333333 + w * -2.7557319223985893e-06 + w2 * even
    odd = 3.868170170630684e-23
    odd = 7.647163731819816e-13 + w * 8.22063524662433e-18 + w2 * odd
    odd = 0.0001984126984126984 + w * 2.505210838544172e-08 + w2 * odd
    return 0.16666666666666666 + z * (even + z * odd)


def _stumpff_series_2(z):
    """Return c_2(z) = sum (-z)^j/(2j+2)! for small z."""
    w = z * z
    w2 = w * w
    if z <= 0.0625:
        return (
            (0.5 + z * -0.041666666666666664)
            + w * (0.001388888888888889 + z * -2.48015873015873e-05)
            + w2 * (2.755731922398589e-07 + z * -2.08767569878681e-09)
        )
    even = -2.08767569878681e-09 + w * -4.779477332387385e-14
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even
    odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd
    return 0.5 + z * (even + z * odd)


def _stumpff_series_1(z):
    """Return c_1(z) = sum (-z)^j/(2j+1)! for small z."""
    w = z * z
    w2 = w * w
    if z <= 0.0625:
        return (
            (1.0 + z * -0.16666666666666666)
            + w * (0.008333333333333333 + z * -0.0001984126984126984)
            + w2 * (2.7557319223985893e-06 + z * -2.505210838544172e-08)
        )
    even = -2.505210838544172e-08 + w * -7.647163731819816e-13
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even
    odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd
    return 1.0 + z * (even + z * odd)


def _stumpff_23(z):
    """Return, for z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z)
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return 0.5 * (ratio * ratio), c3


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    half = 0.5 * sqrt(z)
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _advance(state, h, statistics):
    """Return the state after one step as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    w1 = 0.9900990099009901 * (g00 * mu0 + g10 * mu1 + g20 * mu2)
    w2 = g01 * mu0 + g11 * mu1 + g21 * mu2
    w3 = 100.0 * (g02 * mu0 + g12 * mu1 + g22 * mu2)
    w4 = mu1 * w1
    w5 = 1.5 + 0.1 * g21 - g22
    w6 = 0.1 * g01 - g02
    w7 = 0.1 * g11 - g12
    w8 = 1.0 / sqrt(w6 * w6 + w7 * w7 + w5 * w5)
    w9 = w8 * w8 * (0.5 * w8)
    w10 = 2.0 * w7 * w9
    w11 = 1.5 - 0.1 * g21 - g22
    w12 = -0.1 * g01 - g02
    w13 = -0.1 * g11 - g12
    w14 = sqrt(w12 * w12 + w13 * w13 + w11 * w11)
    w15 = 1.0 / w14
    w16 = -1.0 / w14 * w15 * (0.5 * w15)
    w17 = 2.0 * w13 * w16
    w18 = 0.1 * w17 - 0.1 * w10 + mu1 * w2
    w19 = w10 + w17 + mu1 * w3
    w20 = mu2 * w1
    w21 = 2.0 * w5 * w9
    w22 = 2.0 * w11 * w16
    w23 = 0.1 * w22 - 0.1 * w21 + mu2 * w2
    w24 = w21 - 1.0 + w22 + mu2 * w3
    n0_0 = g20 * w4 + g21 * w18 + g22 * w19 - g10 * w20 - g11 * w23 - g12 * w24
    w25 = mu0 * w1
    w26 = 2.0 * w6 * w9
    w27 = 2.0 * w12 * w16
    w28 = 0.1 * w27 - 0.1 * w26 + mu0 * w2
    w29 = w26 + w27 + mu0 * w3
    n0_1 = g00 * w20 - (g20 * w25 + g21 * w28 + g22 * w29) + g01 * w23 + g02 * w24
    n0_2 = g10 * w25 + g11 * w28 + g12 * w29 - g00 * w4 - g01 * w18 - g02 * w19
    w30 = 0.5 * h
    w54 = -0.5 * h
    # the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2
    xi1_0 = g00 * w1 + g01 * w2 + g02 * w3
    xi1_1 = g10 * w1 + g11 * w2 + g12 * w3
    xi1_2 = g20 * w1 + g21 * w2 + g22 * w3
    n1_0 = n0_0
    n1_1 = n0_1
    n1_2 = n0_2
    previous_1 = 0.0
    for sweep in range(1, 101):
        xE1_1_1 = xi1_1 * w30
        xE1_1_0 = xi1_0 * w30
        xE1_1_2 = xi1_2 * w30
        w31 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2
        c1_1, c2_1 = _stumpff_12(w31)
        w33 = xE1_1_1 * c2_1
        w34 = xE1_1_1 * w33
        w35 = xE1_1_2 * c2_1 * xE1_1_2
        gE1_1_0 = 1.0 - (w34 + w35)
        w36 = xE1_1_0 * c2_1
        w37 = xE1_1_1 * w36
        w39 = xE1_1_2 * c1_1
        gE1_1_1 = w37 - w39
        w40 = xE1_1_1 * c1_1
        w41 = xE1_1_2 * w36
        gE1_1_2 = w40 + w41
        Q1_0 = g00 * gE1_1_0 + g10 * gE1_1_1 + g20 * gE1_1_2
        gE1_1_6 = w41 - w40
        w42 = xE1_1_0 * c1_1
        w43 = xE1_1_2 * w33
        gE1_1_7 = w42 + w43
        w44 = xE1_1_0 * w36
        gE1_1_8 = 1.0 - (w34 + w44)
        Q1_6 = g00 * gE1_1_6 + g10 * gE1_1_7 + g20 * gE1_1_8
        gE1_1_5 = w43 - w42
        nu1_2 = n1_0 * gE1_1_2 + n1_1 * gE1_1_5 + n1_2 * gE1_1_8
        s_mu_2 = mu2 + h * nu1_2
        w45 = h * xi1_0
        w46 = h * xi1_1
        w47 = h * xi1_2
        w48 = w45 * w45 + w46 * w46 + w47 * w47
        c2_2, c3_1 = _stumpff_23(w48)
        gE1_1_3 = w37 + w39
        nu1_0 = n1_0 * gE1_1_0 + n1_1 * gE1_1_3 + n1_2 * gE1_1_6
        s_mu_0 = mu0 + h * nu1_0
        gE1_1_4 = 1.0 - (w35 + w44)
        nu1_1 = n1_0 * gE1_1_1 + n1_1 * gE1_1_4 + n1_2 * gE1_1_7
        s_mu_1 = mu1 + h * nu1_1
        w50 = w46 * s_mu_0 - w45 * s_mu_1
        w52 = w47 * s_mu_1 - s_mu_2 * w46
        w53 = s_mu_2 * w45 - w47 * s_mu_0
        y1_2_0 = xi1_0 * w54
        y1_2_1 = xi1_1 * w54
        y1_2_2 = xi1_2 * w54
        w55 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w55)
        w57 = nu1_1 * y1_2_0 - nu1_0 * y1_2_1
        w59 = nu1_0 * y1_2_2 - nu1_2 * y1_2_0
        w60 = nu1_2 * y1_2_1 - nu1_1 * y1_2_2
        M1_2 = (
            s_mu_2
            - w50 * c2_2
            + (w46 * w52 - w45 * w53) * c3_1
            + w54 * (nu1_2 - w57 * c2_3 + (y1_2_0 * w59 - y1_2_1 * w60) * c3_2)
        )
        M1_0 = (
            s_mu_0
            - w52 * c2_2
            + (w47 * w53 - w46 * w50) * c3_1
            + w54 * (nu1_0 - w60 * c2_3 + (y1_2_1 * w57 - y1_2_2 * w59) * c3_2)
        )
        Q1_3 = g00 * gE1_1_3 + g10 * gE1_1_4 + g20 * gE1_1_5
        M1_1 = (
            s_mu_1
            - w53 * c2_2
            + (w45 * w50 - w47 * w52) * c3_1
            + w54 * (nu1_1 - w59 * c2_3 + (y1_2_2 * w60 - y1_2_0 * w57) * c3_2)
        )
        w61 = 0.9900990099009901 * (Q1_0 * M1_0 + Q1_3 * M1_1 + Q1_6 * M1_2)
        Q1_1 = g01 * gE1_1_0 + g11 * gE1_1_1 + g21 * gE1_1_2
        Q1_7 = g01 * gE1_1_6 + g11 * gE1_1_7 + g21 * gE1_1_8
        Q1_4 = g01 * gE1_1_3 + g11 * gE1_1_4 + g21 * gE1_1_5
        w62 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7
        Q1_2 = g02 * gE1_1_0 + g12 * gE1_1_1 + g22 * gE1_1_2
        Q1_8 = g02 * gE1_1_6 + g12 * gE1_1_7 + g22 * gE1_1_8
        Q1_5 = g02 * gE1_1_3 + g12 * gE1_1_4 + g22 * gE1_1_5
        w63 = 100.0 * (M1_0 * Q1_2 + M1_1 * Q1_5 + M1_2 * Q1_8)
        f1_0 = Q1_0 * w61 + Q1_1 * w62 + Q1_2 * w63
        f1_1 = Q1_3 * w61 + Q1_4 * w62 + Q1_5 * w63
        f1_2 = Q1_6 * w61 + Q1_7 * w62 + Q1_8 * w63
        w64 = M1_1 * w61
        w65 = 1.5 + 0.1 * Q1_7 - Q1_8
        w66 = 0.1 * Q1_1 - Q1_2
        w67 = 0.1 * Q1_4 - Q1_5
        w68 = 1.0 / sqrt(w66 * w66 + w67 * w67 + w65 * w65)
        w69 = w68 * w68 * (0.5 * w68)
        w70 = 2.0 * w67 * w69
        w71 = 1.5 - 0.1 * Q1_7 - Q1_8
        w72 = -0.1 * Q1_1 - Q1_2
        w73 = -0.1 * Q1_4 - Q1_5
        w74 = sqrt(w72 * w72 + w73 * w73 + w71 * w71)
        w75 = 1.0 / w74
        w76 = -1.0 / w74 * w75 * (0.5 * w75)
        w77 = 2.0 * w73 * w76
        w78 = 0.1 * w77 - 0.1 * w70 + M1_1 * w62
        w79 = w70 + w77 + M1_1 * w63
        w80 = M1_2 * w61
        w81 = 2.0 * w65 * w69
        w82 = 2.0 * w71 * w76
        w83 = 0.1 * w82 - 0.1 * w81 + M1_2 * w62
        w84 = w81 - 1.0 + w82 + M1_2 * w63
        r1_0 = (
            Q1_6 * w64 + Q1_7 * w78 + Q1_8 * w79 - Q1_3 * w80 - Q1_4 * w83 - Q1_5 * w84
        )
        w85 = M1_0 * w61
        w86 = 2.0 * w66 * w69
        w87 = 2.0 * w72 * w76
        w88 = 0.1 * w87 - 0.1 * w86 + M1_0 * w62
        w89 = w86 + w87 + M1_0 * w63
        r1_1 = (
            Q1_0 * w80
            - (Q1_6 * w85 + Q1_7 * w88 + Q1_8 * w89)
            + Q1_1 * w83
            + Q1_2 * w84
        )
        r1_2 = (
            Q1_3 * w85 + Q1_4 * w88 + Q1_5 * w89 - Q1_0 * w64 - Q1_1 * w78 - Q1_2 * w79
        )
        change_xi1_0 = abs(f1_0 - xi1_0)
        change_xi1_1 = abs(f1_1 - xi1_1)
        change_xi1_2 = abs(f1_2 - xi1_2)
        change_n1_0 = abs(r1_0 - n1_0)
        change_n1_1 = abs(r1_1 - n1_1)
        change_n1_2 = abs(r1_2 - n1_2)
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
        n1_0 = r1_0
        n1_1 = r1_1
        n1_2 = r1_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    xe1_1 = h * f1_1
    xe1_0 = h * f1_0
    xe1_2 = h * f1_2
    w90 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
    c1_2, c2_4 = _stumpff_12(w90)
    w92 = xe1_1 * c2_4
    w93 = xe1_1 * w92
    w94 = xe1_2 * c2_4 * xe1_2
    ge1_0 = 1.0 - (w93 + w94)
    w95 = xe1_0 * c2_4
    w96 = xe1_1 * w95
    w98 = xe1_2 * c1_2
    ge1_1 = w96 - w98
    w99 = xe1_1 * c1_2
    w100 = xe1_2 * w95
    ge1_2 = w99 + w100
    ge1_3 = w96 + w98
    w101 = xe1_0 * w95
    ge1_4 = 1.0 - (w94 + w101)
    w102 = xe1_2 * w92
    w103 = xe1_0 * c1_2
    ge1_5 = w102 - w103
    ge1_6 = w100 - w99
    ge1_7 = w102 + w103
    ge1_8 = 1.0 - (w93 + w101)
    new_g00 = g00 * ge1_0 + g10 * ge1_1 + g20 * ge1_2
    new_g01 = g01 * ge1_0 + g11 * ge1_1 + g21 * ge1_2
    new_g02 = g02 * ge1_0 + g12 * ge1_1 + g22 * ge1_2
    new_g10 = g00 * ge1_3 + g10 * ge1_4 + g20 * ge1_5
    new_g11 = g01 * ge1_3 + g11 * ge1_4 + g21 * ge1_5
    new_g12 = g02 * ge1_3 + g12 * ge1_4 + g22 * ge1_5
    new_g20 = g00 * ge1_6 + g10 * ge1_7 + g20 * ge1_8
    new_g21 = g01 * ge1_6 + g11 * ge1_7 + g21 * ge1_8
    new_g22 = g02 * ge1_6 + g12 * ge1_7 + g22 * ge1_8
    new_mu0 = s_mu_0 * ge1_0 + s_mu_1 * ge1_1 + s_mu_2 * ge1_2
    new_mu1 = s_mu_0 * ge1_3 + s_mu_1 * ge1_4 + s_mu_2 * ge1_5
    new_mu2 = s_mu_0 * ge1_6 + s_mu_1 * ge1_7 + s_mu_2 * ge1_8
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
        new_mu0,
        new_mu1,
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
