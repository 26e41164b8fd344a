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
operations: 114 add, 178 mul, 2 sqrt, 6 div, 1 stumpff_12 a step
            148 add, 230 mul, 6 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
made by:    orderconds emit dipole --method vcg:midpoint --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_midpoint

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_midpoint.run(state, 0.005, 100))
"""

from math import cos, inf, isfinite, sin, sqrt

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
    w1 = 100.0 * g22
    w2 = 100.0 * g02
    w3 = 100.0 * g12
    w4 = mu0 * w2 + mu1 * w3 + mu2 * w1
    w5 = 0.9900990099009901 * g20
    w6 = 0.9900990099009901 * g00
    w7 = 0.9900990099009901 * g10
    w8 = mu0 * w6 + mu1 * w7 + mu2 * w5
    w9 = g01 * mu0 + g11 * mu1 + g21 * mu2
    w10 = 0.5 * mu0
    w11 = 0.5 * mu1
    w12 = 0.5 * mu2
    w13 = g01 * w10 + g11 * w11 + g21 * w12
    w14 = g00 * w10 + g10 * w11 + g20 * w12
    w15 = 0.5 * (g00 * w8 + g01 * w9 + g02 * w4) + g01 * w13 + w6 * w14
    w16 = g02 * w10 + g12 * w11 + g22 * w12
    w17 = 0.5 * (g10 * w8 + g11 * w9 + g12 * w4) + g11 * w13 + w7 * w14
    w18 = 0.5 * (g20 * w8 + g21 * w9 + g22 * w4) + g21 * w13 + w5 * w14
    w19 = w8 * w11 + 0.9900990099009901 * (mu1 * w14)
    w20 = 1.5 + 0.1 * g21 - g22
    w21 = 0.1 * g01 - g02
    w22 = 0.1 * g11 - g12
    w23 = sqrt(w21 * w21 + w22 * w22 + w20 * w20)
    w24 = 1.0 / w23 / w23 * (0.5 / w23)
    w25 = 2.0 * w22 * w24
    w26 = 1.5 - 0.1 * g21 - g22
    w27 = -0.1 * g01 - g02
    w28 = -0.1 * g11 - g12
    w29 = sqrt(w27 * w27 + w28 * w28 + w26 * w26)
    w30 = -1.0 / w29 / w29 * (0.5 / w29)
    w31 = 2.0 * w28 * w30
    w32 = 0.1 * w31 - 0.1 * w25 + w9 * w11 + mu1 * w13
    w33 = w25 + w31 + w4 * w11 + 100.0 * (mu1 * w16)
    w34 = w8 * w12 + 0.9900990099009901 * (mu2 * w14)
    w35 = 2.0 * w20 * w24
    w36 = 2.0 * w26 * w30
    w37 = 0.1 * w36 - 0.1 * w35 + w9 * w12 + mu2 * w13
    w38 = w35 - 1.0 + w36 + w4 * w12 + 100.0 * (mu2 * w16)
    n0_0 = g20 * w19 + g21 * w32 + g22 * w33 - g10 * w34 - g11 * w37 - g12 * w38
    w39 = w8 * w10 + 0.9900990099009901 * (mu0 * w14)
    w40 = 2.0 * w21 * w24
    w41 = 2.0 * w27 * w30
    w42 = 0.1 * w41 - 0.1 * w40 + w9 * w10 + mu0 * w13
    w43 = w40 + w41 + w4 * w10 + 100.0 * (mu0 * w16)
    n0_1 = g00 * w34 - (g20 * w39 + g21 * w42 + g22 * w43) + g01 * w37 + g02 * w38
    n0_2 = g10 * w39 + g11 * w42 + g12 * w43 - g00 * w19 - g01 * w32 - g02 * w33
    w44 = 0.5 * h
    w68 = -0.5 * h
    # the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2
    xi1_0 = w15 + w2 * w16
    xi1_1 = w17 + w3 * w16
    xi1_2 = w18 + w1 * w16
    n1_0 = n0_0
    n1_1 = n0_1
    n1_2 = n0_2
    previous_1 = inf
    for sweep in range(1, 101):
        xE1_1_1 = xi1_1 * w44
        xE1_1_0 = xi1_0 * w44
        xE1_1_2 = xi1_2 * w44
        w45 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2
        c1_1, c2_1 = _stumpff_12(w45)
        w47 = xE1_1_1 * c2_1
        w48 = xE1_1_1 * w47
        w49 = xE1_1_2 * c2_1 * xE1_1_2
        gE1_1_0 = 1.0 - (w48 + w49)
        w50 = xE1_1_0 * c2_1
        w51 = xE1_1_1 * w50
        w53 = xE1_1_2 * c1_1
        gE1_1_1 = w51 - w53
        w54 = xE1_1_1 * c1_1
        w55 = xE1_1_2 * w50
        gE1_1_2 = w54 + w55
        Q1_2 = g02 * gE1_1_0 + g12 * gE1_1_1 + g22 * gE1_1_2
        w56 = xE1_1_2 * w47
        w57 = xE1_1_0 * c1_1
        gE1_1_5 = w56 - w57
        w58 = xE1_1_0 * w50
        gE1_1_8 = 1.0 - (w48 + w58)
        nu1_2 = n1_0 * gE1_1_2 + n1_1 * gE1_1_5 + n1_2 * gE1_1_8
        s_mu_2 = mu2 + h * nu1_2
        w59 = h * xi1_0
        w60 = h * xi1_1
        w61 = h * xi1_2
        w62 = w59 * w59 + w60 * w60 + w61 * w61
        c2_2, c3_1 = _stumpff_23(w62)
        gE1_1_3 = w51 + w53
        gE1_1_6 = w55 - w54
        nu1_0 = n1_0 * gE1_1_0 + n1_1 * gE1_1_3 + n1_2 * gE1_1_6
        s_mu_0 = mu0 + h * nu1_0
        gE1_1_4 = 1.0 - (w49 + w58)
        gE1_1_7 = w56 + w57
        nu1_1 = n1_0 * gE1_1_1 + n1_1 * gE1_1_4 + n1_2 * gE1_1_7
        s_mu_1 = mu1 + h * nu1_1
        w64 = w60 * s_mu_0 - w59 * s_mu_1
        w66 = w61 * s_mu_1 - s_mu_2 * w60
        w67 = s_mu_2 * w59 - w61 * s_mu_0
        y1_2_0 = xi1_0 * w68
        y1_2_1 = xi1_1 * w68
        y1_2_2 = xi1_2 * w68
        w69 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w69)
        w71 = nu1_1 * y1_2_0 - nu1_0 * y1_2_1
        w73 = nu1_0 * y1_2_2 - nu1_2 * y1_2_0
        w74 = nu1_2 * y1_2_1 - nu1_1 * y1_2_2
        M1_2 = (
            s_mu_2
            - w64 * c2_2
            + (w60 * w66 - w59 * w67) * c3_1
            + w68 * (nu1_2 - w71 * c2_3 + (y1_2_0 * w73 - y1_2_1 * w74) * c3_2)
        )
        Q1_8 = g02 * gE1_1_6 + g12 * gE1_1_7 + g22 * gE1_1_8
        w75 = 100.0 * Q1_8
        M1_0 = (
            s_mu_0
            - w66 * c2_2
            + (w61 * w67 - w60 * w64) * c3_1
            + w68 * (nu1_0 - w74 * c2_3 + (y1_2_1 * w71 - y1_2_2 * w73) * c3_2)
        )
        w76 = 100.0 * Q1_2
        M1_1 = (
            s_mu_1
            - w67 * c2_2
            + (w59 * w64 - w61 * w66) * c3_1
            + w68 * (nu1_1 - w73 * c2_3 + (y1_2_2 * w74 - y1_2_0 * w71) * c3_2)
        )
        Q1_5 = g02 * gE1_1_3 + g12 * gE1_1_4 + g22 * gE1_1_5
        w77 = 100.0 * Q1_5
        w78 = M1_0 * w76 + M1_1 * w77 + M1_2 * w75
        Q1_0 = g00 * gE1_1_0 + g10 * gE1_1_1 + g20 * gE1_1_2
        Q1_6 = g00 * gE1_1_6 + g10 * gE1_1_7 + g20 * gE1_1_8
        w79 = 0.9900990099009901 * Q1_6
        w80 = 0.9900990099009901 * Q1_0
        Q1_3 = g00 * gE1_1_3 + g10 * gE1_1_4 + g20 * gE1_1_5
        w81 = 0.9900990099009901 * Q1_3
        w82 = M1_0 * w80 + M1_1 * w81 + M1_2 * w79
        Q1_1 = g01 * gE1_1_0 + g11 * gE1_1_1 + g21 * gE1_1_2
        Q1_7 = g01 * gE1_1_6 + g11 * gE1_1_7 + g21 * gE1_1_8
        Q1_4 = g01 * gE1_1_3 + g11 * gE1_1_4 + g21 * gE1_1_5
        w83 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7
        w84 = 0.5 * M1_0
        w85 = 0.5 * M1_1
        w86 = 0.5 * M1_2
        w87 = Q1_1 * w84 + Q1_4 * w85 + Q1_7 * w86
        w88 = Q1_0 * w84 + Q1_3 * w85 + Q1_6 * w86
        w89 = 0.5 * (Q1_0 * w82 + Q1_1 * w83 + Q1_2 * w78) + Q1_1 * w87 + w80 * w88
        w90 = Q1_2 * w84 + Q1_5 * w85 + Q1_8 * w86
        f1_0 = w89 + w76 * w90
        w91 = 0.5 * (Q1_3 * w82 + Q1_4 * w83 + Q1_5 * w78) + Q1_4 * w87 + w81 * w88
        f1_1 = w91 + w77 * w90
        w92 = 0.5 * (Q1_6 * w82 + Q1_7 * w83 + Q1_8 * w78) + Q1_7 * w87 + w79 * w88
        f1_2 = w92 + w75 * w90
        w93 = w82 * w85 + 0.9900990099009901 * (M1_1 * w88)
        w94 = 1.5 + 0.1 * Q1_7 - Q1_8
        w95 = 0.1 * Q1_1 - Q1_2
        w96 = 0.1 * Q1_4 - Q1_5
        w97 = sqrt(w95 * w95 + w96 * w96 + w94 * w94)
        w98 = 1.0 / w97 / w97 * (0.5 / w97)
        w99 = 2.0 * w96 * w98
        w100 = 1.5 - 0.1 * Q1_7 - Q1_8
        w101 = -0.1 * Q1_1 - Q1_2
        w102 = -0.1 * Q1_4 - Q1_5
        w103 = sqrt(w101 * w101 + w102 * w102 + w100 * w100)
        w104 = -1.0 / w103 / w103 * (0.5 / w103)
        w105 = 2.0 * w102 * w104
        w106 = 0.1 * w105 - 0.1 * w99 + w83 * w85 + M1_1 * w87
        w107 = w99 + w105 + w78 * w85 + 100.0 * (M1_1 * w90)
        w108 = w82 * w86 + 0.9900990099009901 * (M1_2 * w88)
        w109 = 2.0 * w94 * w98
        w110 = 2.0 * w100 * w104
        w111 = 0.1 * w110 - 0.1 * w109 + w83 * w86 + M1_2 * w87
        w112 = w109 - 1.0 + w110 + w78 * w86 + 100.0 * (M1_2 * w90)
        r1_0 = (
            Q1_6 * w93
            + Q1_7 * w106
            + Q1_8 * w107
            - Q1_3 * w108
            - Q1_4 * w111
            - Q1_5 * w112
        )
        w113 = w82 * w84 + 0.9900990099009901 * (M1_0 * w88)
        w114 = 2.0 * w95 * w98
        w115 = 2.0 * w101 * w104
        w116 = 0.1 * w115 - 0.1 * w114 + w83 * w84 + M1_0 * w87
        w117 = w114 + w115 + w78 * w84 + 100.0 * (M1_0 * w90)
        r1_1 = (
            Q1_0 * w108
            - (Q1_6 * w113 + Q1_7 * w116 + Q1_8 * w117)
            + Q1_1 * w111
            + Q1_2 * w112
        )
        r1_2 = (
            Q1_3 * w113
            + Q1_4 * w116
            + Q1_5 * w117
            - Q1_0 * w93
            - Q1_1 * w106
            - Q1_2 * w107
        )
        f1_0 = f1_0
        f1_1 = f1_1
        f1_2 = f1_2
        r1_0 = r1_0
        r1_1 = r1_1
        r1_2 = r1_2
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
        settled = change >= previous_1 or change == 0.0
        if settled and change <= 5.684341886080802e-14 * scale:
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
    w118 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
    c1_2, c2_4 = _stumpff_12(w118)
    w120 = xe1_1 * c2_4
    w121 = xe1_1 * w120
    w122 = xe1_2 * c2_4 * xe1_2
    ge1_0 = 1.0 - (w121 + w122)
    w123 = xe1_0 * c2_4
    w124 = xe1_1 * w123
    w126 = xe1_2 * c1_2
    ge1_1 = w124 - w126
    w127 = xe1_1 * c1_2
    w128 = xe1_2 * w123
    ge1_2 = w127 + w128
    ge1_3 = w124 + w126
    w129 = xe1_0 * w123
    ge1_4 = 1.0 - (w122 + w129)
    w130 = xe1_2 * w120
    w131 = xe1_0 * c1_2
    ge1_5 = w130 - w131
    ge1_6 = w128 - w127
    ge1_7 = w130 + w131
    ge1_8 = 1.0 - (w121 + w129)
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
