"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   7 Adtinv, 3 exp, 7 mul (zeros)
            3 Adtinv, 3 dexpt, 3 exp, 6 identity, 6 lin, 1 mul, 2 zero (sharing)
            1 Adtinv, 3 dexpt, 1 identity, 1 zero (dead code)
            3 Adtinv, 6 dexpt (factors)
            1 lin (sharing)
            parameters, folded: beta = 1
            the time: the scene does not depend on it
operations: 178 add, 259 mul, 3 div, 2 sqrt, 3 stumpff_12 a step
            124 add, 191 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
            148 add, 227 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi2, n2
            148 add, 227 mul, 3 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi3, n3
made by:    orderconds emit dipole --method vcg:triple_jump --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_triple_jump

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_triple_jump.run(state, 0.005, 100))
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
        "the equations of xi2, n2",
        "the equations of xi3, n3",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 3, 0, 0

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
    xi0_0 = g00 * w1 + g01 * w2 + g02 * w3
    xi0_1 = g10 * w1 + g11 * w2 + g12 * w3
    xi0_2 = g20 * w1 + g21 * w2 + g22 * w3
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
    w30 = 0.6756035959798288 * h
    w45 = 1.3512071919596575 * h
    w46 = -1.3512071919596575 * h
    w53 = -0.6756035959798288 * h
    # the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2
    xi1_0 = xi0_0
    xi1_1 = xi0_1
    xi1_2 = xi0_2
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
        s_mu_2 = mu2 + nu1_2 * w45
        y1_0 = xi1_0 * w46
        y1_1 = xi1_1 * w46
        y1_2 = xi1_2 * w46
        w47 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2
        c2_2, c3_1 = _stumpff_23(w47)
        gE1_1_4 = 1.0 - (w35 + w44)
        nu1_1 = n1_0 * gE1_1_1 + n1_1 * gE1_1_4 + n1_2 * gE1_1_7
        s_mu_1 = mu1 + w45 * nu1_1
        gE1_1_3 = w37 + w39
        nu1_0 = n1_0 * gE1_1_0 + n1_1 * gE1_1_3 + n1_2 * gE1_1_6
        s_mu_0 = mu0 + w45 * nu1_0
        w49 = y1_0 * s_mu_1 - y1_1 * s_mu_0
        w51 = y1_2 * s_mu_0 - s_mu_2 * y1_0
        w52 = s_mu_2 * y1_1 - y1_2 * s_mu_1
        y1_2_0 = xi1_0 * w53
        y1_2_1 = xi1_1 * w53
        y1_2_2 = xi1_2 * w53
        w54 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w54)
        w56 = nu1_1 * y1_2_0 - nu1_0 * y1_2_1
        w58 = nu1_0 * y1_2_2 - nu1_2 * y1_2_0
        w59 = nu1_2 * y1_2_1 - nu1_1 * y1_2_2
        M1_2 = (
            s_mu_2
            - w49 * c2_2
            + (y1_0 * w51 - y1_1 * w52) * c3_1
            + w53 * (nu1_2 - w56 * c2_3 + (y1_2_0 * w58 - y1_2_1 * w59) * c3_2)
        )
        M1_0 = (
            s_mu_0
            - w52 * c2_2
            + (y1_1 * w49 - y1_2 * w51) * c3_1
            + w53 * (nu1_0 - w59 * c2_3 + (y1_2_1 * w56 - y1_2_2 * w58) * c3_2)
        )
        Q1_3 = g00 * gE1_1_3 + g10 * gE1_1_4 + g20 * gE1_1_5
        M1_1 = (
            s_mu_1
            - w51 * c2_2
            + (y1_2 * w52 - y1_0 * w49) * c3_1
            + w53 * (nu1_1 - w58 * c2_3 + (y1_2_2 * w59 - y1_2_0 * w56) * c3_2)
        )
        w60 = 0.9900990099009901 * (Q1_0 * M1_0 + Q1_3 * M1_1 + Q1_6 * M1_2)
        Q1_1 = g01 * gE1_1_0 + g11 * gE1_1_1 + g21 * gE1_1_2
        Q1_7 = g01 * gE1_1_6 + g11 * gE1_1_7 + g21 * gE1_1_8
        Q1_4 = g01 * gE1_1_3 + g11 * gE1_1_4 + g21 * gE1_1_5
        w61 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7
        Q1_2 = g02 * gE1_1_0 + g12 * gE1_1_1 + g22 * gE1_1_2
        Q1_8 = g02 * gE1_1_6 + g12 * gE1_1_7 + g22 * gE1_1_8
        Q1_5 = g02 * gE1_1_3 + g12 * gE1_1_4 + g22 * gE1_1_5
        w62 = 100.0 * (M1_0 * Q1_2 + M1_1 * Q1_5 + M1_2 * Q1_8)
        f1_0 = Q1_0 * w60 + Q1_1 * w61 + Q1_2 * w62
        f1_1 = Q1_3 * w60 + Q1_4 * w61 + Q1_5 * w62
        f1_2 = Q1_6 * w60 + Q1_7 * w61 + Q1_8 * w62
        w63 = M1_1 * w60
        w64 = 1.5 + 0.1 * Q1_7 - Q1_8
        w65 = 0.1 * Q1_1 - Q1_2
        w66 = 0.1 * Q1_4 - Q1_5
        w67 = 1.0 / sqrt(w65 * w65 + w66 * w66 + w64 * w64)
        w68 = w67 * w67 * (0.5 * w67)
        w69 = 2.0 * w66 * w68
        w70 = 1.5 - 0.1 * Q1_7 - Q1_8
        w71 = -0.1 * Q1_1 - Q1_2
        w72 = -0.1 * Q1_4 - Q1_5
        w73 = sqrt(w71 * w71 + w72 * w72 + w70 * w70)
        w74 = 1.0 / w73
        w75 = -1.0 / w73 * w74 * (0.5 * w74)
        w76 = 2.0 * w72 * w75
        w77 = 0.1 * w76 - 0.1 * w69 + M1_1 * w61
        w78 = w69 + w76 + M1_1 * w62
        w79 = M1_2 * w60
        w80 = 2.0 * w64 * w68
        w81 = 2.0 * w70 * w75
        w82 = 0.1 * w81 - 0.1 * w80 + M1_2 * w61
        w83 = w80 - 1.0 + w81 + M1_2 * w62
        r1_0 = (
            Q1_6 * w63 + Q1_7 * w77 + Q1_8 * w78 - Q1_3 * w79 - Q1_4 * w82 - Q1_5 * w83
        )
        w84 = M1_0 * w60
        w85 = 2.0 * w65 * w68
        w86 = 2.0 * w71 * w75
        w87 = 0.1 * w86 - 0.1 * w85 + M1_0 * w61
        w88 = w85 + w86 + M1_0 * w62
        r1_1 = (
            Q1_0 * w79
            - (Q1_6 * w84 + Q1_7 * w87 + Q1_8 * w88)
            + Q1_1 * w82
            + Q1_2 * w83
        )
        r1_2 = (
            Q1_3 * w84 + Q1_4 * w87 + Q1_5 * w88 - Q1_0 * w63 - Q1_1 * w77 - Q1_2 * w78
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
    xe1_1 = w45 * f1_1
    xe1_0 = w45 * f1_0
    w89 = xe1_0 * xe1_0
    w90 = xe1_1 * xe1_1
    w91 = w89 + w90
    xe1_2 = w45 * f1_2
    w92 = xe1_2 * xe1_2
    w93 = w91 + w92
    c1_2, c2_4 = _stumpff_12(w93)
    w95 = xe1_1 * c2_4
    w96 = xe1_1 * w95
    w97 = xe1_2 * c2_4
    w98 = xe1_2 * w97
    w99 = w96 + w98
    ge1_0 = 1.0 - w99
    w100 = -0.8512071919596577 * h
    w107 = xe1_2 * c1_2
    w108 = xe1_0 * c2_4
    w109 = xe1_1 * w108
    ge1_3 = w107 + w109
    w114 = xe1_2 * w108
    w115 = xe1_1 * c1_2
    ge1_6 = w114 - w115
    ge1_1 = w109 - w107
    w118 = xe1_0 * w108
    w119 = w98 + w118
    ge1_4 = 1.0 - w119
    w120 = xe1_0 * c1_2
    w121 = xe1_2 * w95
    ge1_7 = w120 + w121
    ge1_2 = w114 + w115
    ge1_5 = w121 - w120
    w122 = w96 + w118
    ge1_8 = 1.0 - w122
    w126 = s_mu_0 * ge1_6
    w127 = s_mu_1 * ge1_7
    w128 = w126 + w127
    w129 = s_mu_2 * ge1_8
    m2_4_2 = w128 + w129
    w130 = -1.7024143839193153 * h
    w131 = 1.7024143839193153 * h
    w134 = s_mu_0 * ge1_3
    w135 = s_mu_1 * ge1_4
    w136 = w134 + w135
    w137 = s_mu_2 * ge1_5
    m2_4_1 = w136 + w137
    w138 = s_mu_0 * ge1_0
    w139 = s_mu_1 * ge1_1
    w140 = w138 + w139
    w141 = s_mu_2 * ge1_2
    m2_4_0 = w140 + w141
    w146 = 0.8512071919596577 * h
    # the equations of xi2, n2: fixed point in xi2_0, xi2_1, xi2_2, n2_0, n2_1, n2_2
    xi2_0 = xi0_0
    xi2_1 = xi0_1
    xi2_2 = xi0_2
    n2_0 = n0_0
    n2_1 = n0_1
    n2_2 = n0_2
    previous_2 = 0.0
    for sweep in range(1, 101):
        xE2_2_1 = xi2_1 * w100
        xE2_2_0 = xi2_0 * w100
        xE2_2_2 = xi2_2 * w100
        w101 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2
        c1_3, c2_5 = _stumpff_12(w101)
        w103 = xE2_2_1 * c2_5
        w104 = xE2_2_1 * w103
        w105 = xE2_2_2 * c2_5 * xE2_2_2
        gE2_2_0 = 1.0 - (w104 + w105)
        w110 = xE2_2_0 * c2_5
        w111 = xE2_2_1 * w110
        w113 = xE2_2_2 * c1_3
        gE2_2_1 = w111 - w113
        w116 = xE2_2_1 * c1_3
        w117 = xE2_2_2 * w110
        gE2_2_2 = w116 + w117
        E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2
        E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7
        E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8
        Q2_0 = g00 * E2_2_0 + g10 * E2_2_1 + g20 * E2_2_2
        gE2_2_6 = w117 - w116
        w123 = xE2_2_0 * c1_3
        w124 = xE2_2_2 * w103
        gE2_2_7 = w123 + w124
        w125 = xE2_2_0 * w110
        gE2_2_8 = 1.0 - (w104 + w125)
        E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8
        E2_2_7 = ge1_1 * gE2_2_6 + ge1_4 * gE2_2_7 + ge1_7 * gE2_2_8
        E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8
        Q2_6 = g00 * E2_2_6 + g10 * E2_2_7 + g20 * E2_2_8
        gE2_2_3 = w111 + w113
        gE2_2_4 = 1.0 - (w105 + w125)
        gE2_2_5 = w124 - w123
        E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5
        nu2_0 = n2_0 * E2_2_0 + n2_1 * E2_2_3 + n2_2 * E2_2_6
        E2_2_4 = ge1_1 * gE2_2_3 + ge1_4 * gE2_2_4 + ge1_7 * gE2_2_5
        nu2_1 = n2_0 * E2_2_1 + n2_1 * E2_2_4 + n2_2 * E2_2_7
        E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5
        nu2_2 = n2_0 * E2_2_2 + n2_1 * E2_2_5 + n2_2 * E2_2_8
        m2_3_2 = ge1_6 * nu2_0 + ge1_7 * nu2_1 + ge1_8 * nu2_2
        s_m2_2 = m2_4_2 + m2_3_2 * w130
        y2_0 = xi2_0 * w131
        y2_1 = xi2_1 * w131
        y2_2 = xi2_2 * w131
        w132 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2
        c2_6, c3_3 = _stumpff_23(w132)
        m2_3_1 = ge1_3 * nu2_0 + ge1_4 * nu2_1 + ge1_5 * nu2_2
        s_m2_1 = m2_4_1 + w130 * m2_3_1
        m2_3_0 = ge1_0 * nu2_0 + ge1_1 * nu2_1 + ge1_2 * nu2_2
        s_m2_0 = m2_4_0 + w130 * m2_3_0
        w142 = y2_0 * s_m2_1 - y2_1 * s_m2_0
        w144 = y2_2 * s_m2_0 - s_m2_2 * y2_0
        w145 = s_m2_2 * y2_1 - y2_2 * s_m2_1
        y2_2_0 = xi2_0 * w146
        y2_2_1 = xi2_1 * w146
        y2_2_2 = xi2_2 * w146
        w147 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2
        c2_7, c3_4 = _stumpff_23(w147)
        w149 = m2_3_1 * y2_2_0 - m2_3_0 * y2_2_1
        w151 = m2_3_0 * y2_2_2 - m2_3_2 * y2_2_0
        w152 = m2_3_2 * y2_2_1 - m2_3_1 * y2_2_2
        M2_2 = (
            s_m2_2
            - w142 * c2_6
            + (y2_0 * w144 - y2_1 * w145) * c3_3
            + w146 * (m2_3_2 - w149 * c2_7 + (y2_2_0 * w151 - y2_2_1 * w152) * c3_4)
        )
        M2_0 = (
            s_m2_0
            - w145 * c2_6
            + (y2_1 * w142 - y2_2 * w144) * c3_3
            + w146 * (m2_3_0 - w152 * c2_7 + (y2_2_1 * w149 - y2_2_2 * w151) * c3_4)
        )
        Q2_3 = g00 * E2_2_3 + g10 * E2_2_4 + g20 * E2_2_5
        M2_1 = (
            s_m2_1
            - w144 * c2_6
            + (y2_2 * w145 - y2_0 * w142) * c3_3
            + w146 * (m2_3_1 - w151 * c2_7 + (y2_2_2 * w152 - y2_2_0 * w149) * c3_4)
        )
        w153 = 0.9900990099009901 * (Q2_0 * M2_0 + Q2_3 * M2_1 + Q2_6 * M2_2)
        Q2_1 = g01 * E2_2_0 + g11 * E2_2_1 + g21 * E2_2_2
        Q2_7 = g01 * E2_2_6 + g11 * E2_2_7 + g21 * E2_2_8
        Q2_4 = g01 * E2_2_3 + g11 * E2_2_4 + g21 * E2_2_5
        w154 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7
        Q2_2 = g02 * E2_2_0 + g12 * E2_2_1 + g22 * E2_2_2
        Q2_8 = g02 * E2_2_6 + g12 * E2_2_7 + g22 * E2_2_8
        Q2_5 = g02 * E2_2_3 + g12 * E2_2_4 + g22 * E2_2_5
        w155 = 100.0 * (M2_0 * Q2_2 + M2_1 * Q2_5 + M2_2 * Q2_8)
        f2_0 = Q2_0 * w153 + Q2_1 * w154 + Q2_2 * w155
        f2_1 = Q2_3 * w153 + Q2_4 * w154 + Q2_5 * w155
        f2_2 = Q2_6 * w153 + Q2_7 * w154 + Q2_8 * w155
        w156 = M2_1 * w153
        w157 = 1.5 + 0.1 * Q2_7 - Q2_8
        w158 = 0.1 * Q2_1 - Q2_2
        w159 = 0.1 * Q2_4 - Q2_5
        w160 = 1.0 / sqrt(w158 * w158 + w159 * w159 + w157 * w157)
        w161 = w160 * w160 * (0.5 * w160)
        w162 = 2.0 * w159 * w161
        w163 = 1.5 - 0.1 * Q2_7 - Q2_8
        w164 = -0.1 * Q2_1 - Q2_2
        w165 = -0.1 * Q2_4 - Q2_5
        w166 = sqrt(w164 * w164 + w165 * w165 + w163 * w163)
        w167 = 1.0 / w166
        w168 = -1.0 / w166 * w167 * (0.5 * w167)
        w169 = 2.0 * w165 * w168
        w170 = 0.1 * w169 - 0.1 * w162 + M2_1 * w154
        w171 = w162 + w169 + M2_1 * w155
        w172 = M2_2 * w153
        w173 = 2.0 * w157 * w161
        w174 = 2.0 * w163 * w168
        w175 = 0.1 * w174 - 0.1 * w173 + M2_2 * w154
        w176 = w173 - 1.0 + w174 + M2_2 * w155
        r2_0 = (
            Q2_6 * w156
            + Q2_7 * w170
            + Q2_8 * w171
            - Q2_3 * w172
            - Q2_4 * w175
            - Q2_5 * w176
        )
        w177 = M2_0 * w153
        w178 = 2.0 * w158 * w161
        w179 = 2.0 * w164 * w168
        w180 = 0.1 * w179 - 0.1 * w178 + M2_0 * w154
        w181 = w178 + w179 + M2_0 * w155
        r2_1 = (
            Q2_0 * w172
            - (Q2_6 * w177 + Q2_7 * w180 + Q2_8 * w181)
            + Q2_1 * w175
            + Q2_2 * w176
        )
        r2_2 = (
            Q2_3 * w177
            + Q2_4 * w180
            + Q2_5 * w181
            - Q2_0 * w156
            - Q2_1 * w170
            - Q2_2 * w171
        )
        change_xi2_0 = abs(f2_0 - xi2_0)
        change_xi2_1 = abs(f2_1 - xi2_1)
        change_xi2_2 = abs(f2_2 - xi2_2)
        change_n2_0 = abs(r2_0 - n2_0)
        change_n2_1 = abs(r2_1 - n2_1)
        change_n2_2 = abs(r2_2 - n2_2)
        change = max(
            change_xi2_0,
            change_xi2_1,
            change_xi2_2,
            change_n2_0,
            change_n2_1,
            change_n2_2,
        )
        scale = max(
            1.0,
            abs(xi2_0),
            abs(xi2_1),
            abs(xi2_2),
            abs(n2_0),
            abs(n2_1),
            abs(n2_2),
        )
        total = (
            change_xi2_0
            + change_xi2_1
            + change_xi2_2
            + change_n2_0
            + change_n2_1
            + change_n2_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi2, n2", 1, sweep, statistics)
        still = 0.0 < previous_2 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_2
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_2 = change
        xi2_0 = f2_0
        xi2_1 = f2_1
        xi2_2 = f2_2
        n2_0 = r2_0
        n2_1 = r2_1
        n2_2 = r2_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi2, n2", 1, sweep, statistics)
    if statistics is not None:
        statistics.count(1, sweep)
    xe2_1 = w130 * f2_1
    xe2_0 = w130 * f2_0
    w182 = xe2_0 * xe2_0
    w183 = xe2_1 * xe2_1
    w184 = w182 + w183
    xe2_2 = w130 * f2_2
    w185 = xe2_2 * xe2_2
    w186 = w184 + w185
    c1_4, c2_8 = _stumpff_12(w186)
    w188 = xe2_1 * c2_8
    w189 = xe2_1 * w188
    w190 = xe2_2 * c2_8
    w191 = xe2_2 * w190
    w192 = w189 + w191
    ge2_0 = 1.0 - w192
    w193 = ge1_0 * ge2_0
    w194 = xe2_0 * c2_8
    w195 = xe2_1 * w194
    w197 = xe2_2 * c1_4
    ge2_1 = w195 - w197
    w198 = ge1_3 * ge2_1
    w199 = w193 + w198
    w200 = xe2_1 * c1_4
    w201 = xe2_2 * w194
    ge2_2 = w200 + w201
    w202 = ge1_6 * ge2_2
    e2_0 = w199 + w202
    ge2_3 = w195 + w197
    w208 = ge1_0 * ge2_3
    w209 = xe2_0 * w194
    w210 = w191 + w209
    ge2_4 = 1.0 - w210
    w211 = ge1_3 * ge2_4
    w212 = w208 + w211
    w213 = xe2_2 * w188
    w214 = xe2_0 * c1_4
    ge2_5 = w213 - w214
    w215 = ge1_6 * ge2_5
    e2_3 = w212 + w215
    ge2_6 = w201 - w200
    w220 = ge1_0 * ge2_6
    ge2_7 = w213 + w214
    w221 = ge1_3 * ge2_7
    w222 = w220 + w221
    w223 = w189 + w209
    ge2_8 = 1.0 - w223
    w224 = ge1_6 * ge2_8
    e2_6 = w222 + w224
    w227 = ge1_1 * ge2_0
    w228 = ge1_4 * ge2_1
    w229 = w227 + w228
    w230 = ge1_7 * ge2_2
    e2_1 = w229 + w230
    w231 = ge1_1 * ge2_3
    w232 = ge1_4 * ge2_4
    w233 = w231 + w232
    w234 = ge1_7 * ge2_5
    e2_4 = w233 + w234
    w235 = ge1_1 * ge2_6
    w236 = ge1_4 * ge2_7
    w237 = w235 + w236
    w238 = ge1_7 * ge2_8
    e2_7 = w237 + w238
    w239 = ge1_2 * ge2_0
    w240 = ge1_5 * ge2_1
    w241 = w239 + w240
    w242 = ge1_8 * ge2_2
    e2_2 = w241 + w242
    w243 = ge1_2 * ge2_3
    w244 = ge1_5 * ge2_4
    w245 = w243 + w244
    w246 = ge1_8 * ge2_5
    e2_5 = w245 + w246
    w247 = ge1_2 * ge2_6
    w248 = ge1_5 * ge2_7
    w249 = w247 + w248
    w250 = ge1_8 * ge2_8
    e2_8 = w249 + w250
    w254 = nu2_0 * w130
    s_mu_3_0 = s_mu_0 + w254
    w255 = e2_6 * s_mu_3_0
    w256 = nu2_1 * w130
    s_mu_3_1 = s_mu_1 + w256
    w257 = e2_7 * s_mu_3_1
    w258 = w255 + w257
    w259 = nu2_2 * w130
    s_mu_3_2 = s_mu_2 + w259
    w260 = e2_8 * s_mu_3_2
    m3_5_2 = w258 + w260
    w263 = e2_3 * s_mu_3_0
    w264 = e2_4 * s_mu_3_1
    w265 = w263 + w264
    w266 = e2_5 * s_mu_3_2
    m3_5_1 = w265 + w266
    w267 = e2_0 * s_mu_3_0
    w268 = e2_1 * s_mu_3_1
    w269 = w267 + w268
    w270 = e2_2 * s_mu_3_2
    m3_5_0 = w269 + w270
    # the equations of xi3, n3: fixed point in xi3_0, xi3_1, xi3_2, n3_0, n3_1, n3_2
    xi3_0 = xi0_0
    xi3_1 = xi0_1
    xi3_2 = xi0_2
    n3_0 = n0_0
    n3_1 = n0_1
    n3_2 = n0_2
    previous_3 = 0.0
    for sweep in range(1, 101):
        xE3_3_1 = xi3_1 * w30
        xE3_3_0 = xi3_0 * w30
        xE3_3_2 = xi3_2 * w30
        w203 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2
        c1_5, c2_9 = _stumpff_12(w203)
        w205 = xE3_3_1 * c2_9
        w206 = xE3_3_1 * w205
        w207 = xE3_3_2 * c2_9 * xE3_3_2
        gE3_3_0 = 1.0 - (w206 + w207)
        w216 = xE3_3_0 * c2_9
        w217 = xE3_3_1 * w216
        w219 = xE3_3_2 * c1_5
        gE3_3_1 = w217 - w219
        w225 = xE3_3_1 * c1_5
        w226 = xE3_3_2 * w216
        gE3_3_2 = w225 + w226
        E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2
        E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7
        E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8
        Q3_0 = g00 * E3_3_0 + g10 * E3_3_1 + g20 * E3_3_2
        gE3_3_6 = w226 - w225
        w251 = xE3_3_0 * c1_5
        w252 = xE3_3_2 * w205
        gE3_3_7 = w251 + w252
        w253 = xE3_3_0 * w216
        gE3_3_8 = 1.0 - (w206 + w253)
        E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8
        E3_3_7 = e2_1 * gE3_3_6 + e2_4 * gE3_3_7 + e2_7 * gE3_3_8
        E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8
        Q3_6 = g00 * E3_3_6 + g10 * E3_3_7 + g20 * E3_3_8
        gE3_3_3 = w217 + w219
        gE3_3_4 = 1.0 - (w207 + w253)
        gE3_3_5 = w252 - w251
        E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5
        nu3_0 = n3_0 * E3_3_0 + n3_1 * E3_3_3 + n3_2 * E3_3_6
        E3_3_4 = e2_1 * gE3_3_3 + e2_4 * gE3_3_4 + e2_7 * gE3_3_5
        nu3_1 = n3_0 * E3_3_1 + n3_1 * E3_3_4 + n3_2 * E3_3_7
        E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5
        nu3_2 = n3_0 * E3_3_2 + n3_1 * E3_3_5 + n3_2 * E3_3_8
        m3_4_2 = e2_6 * nu3_0 + e2_7 * nu3_1 + e2_8 * nu3_2
        s_m3_2 = m3_5_2 + w45 * m3_4_2
        y3_0 = xi3_0 * w46
        y3_1 = xi3_1 * w46
        y3_2 = xi3_2 * w46
        w261 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2
        c2_10, c3_5 = _stumpff_23(w261)
        m3_4_1 = e2_3 * nu3_0 + e2_4 * nu3_1 + e2_5 * nu3_2
        s_m3_1 = m3_5_1 + w45 * m3_4_1
        m3_4_0 = e2_0 * nu3_0 + e2_1 * nu3_1 + e2_2 * nu3_2
        s_m3_0 = m3_5_0 + w45 * m3_4_0
        w271 = y3_0 * s_m3_1 - y3_1 * s_m3_0
        w273 = y3_2 * s_m3_0 - s_m3_2 * y3_0
        w274 = s_m3_2 * y3_1 - y3_2 * s_m3_1
        y3_2_0 = xi3_0 * w53
        y3_2_1 = xi3_1 * w53
        y3_2_2 = xi3_2 * w53
        w275 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2
        c2_11, c3_6 = _stumpff_23(w275)
        w277 = m3_4_1 * y3_2_0 - m3_4_0 * y3_2_1
        w279 = m3_4_0 * y3_2_2 - m3_4_2 * y3_2_0
        w280 = m3_4_2 * y3_2_1 - m3_4_1 * y3_2_2
        M3_2 = (
            s_m3_2
            - w271 * c2_10
            + (y3_0 * w273 - y3_1 * w274) * c3_5
            + w53 * (m3_4_2 - w277 * c2_11 + (y3_2_0 * w279 - y3_2_1 * w280) * c3_6)
        )
        M3_0 = (
            s_m3_0
            - w274 * c2_10
            + (y3_1 * w271 - y3_2 * w273) * c3_5
            + w53 * (m3_4_0 - w280 * c2_11 + (y3_2_1 * w277 - y3_2_2 * w279) * c3_6)
        )
        Q3_3 = g00 * E3_3_3 + g10 * E3_3_4 + g20 * E3_3_5
        M3_1 = (
            s_m3_1
            - w273 * c2_10
            + (y3_2 * w274 - y3_0 * w271) * c3_5
            + w53 * (m3_4_1 - w279 * c2_11 + (y3_2_2 * w280 - y3_2_0 * w277) * c3_6)
        )
        w281 = 0.9900990099009901 * (Q3_0 * M3_0 + Q3_3 * M3_1 + Q3_6 * M3_2)
        Q3_1 = g01 * E3_3_0 + g11 * E3_3_1 + g21 * E3_3_2
        Q3_7 = g01 * E3_3_6 + g11 * E3_3_7 + g21 * E3_3_8
        Q3_4 = g01 * E3_3_3 + g11 * E3_3_4 + g21 * E3_3_5
        w282 = M3_0 * Q3_1 + M3_1 * Q3_4 + M3_2 * Q3_7
        Q3_2 = g02 * E3_3_0 + g12 * E3_3_1 + g22 * E3_3_2
        Q3_8 = g02 * E3_3_6 + g12 * E3_3_7 + g22 * E3_3_8
        Q3_5 = g02 * E3_3_3 + g12 * E3_3_4 + g22 * E3_3_5
        w283 = 100.0 * (M3_0 * Q3_2 + M3_1 * Q3_5 + M3_2 * Q3_8)
        f3_0 = Q3_0 * w281 + Q3_1 * w282 + Q3_2 * w283
        f3_1 = Q3_3 * w281 + Q3_4 * w282 + Q3_5 * w283
        f3_2 = Q3_6 * w281 + Q3_7 * w282 + Q3_8 * w283
        w284 = M3_1 * w281
        w285 = 1.5 + 0.1 * Q3_7 - Q3_8
        w286 = 0.1 * Q3_1 - Q3_2
        w287 = 0.1 * Q3_4 - Q3_5
        w288 = 1.0 / sqrt(w286 * w286 + w287 * w287 + w285 * w285)
        w289 = w288 * w288 * (0.5 * w288)
        w290 = 2.0 * w287 * w289
        w291 = 1.5 - 0.1 * Q3_7 - Q3_8
        w292 = -0.1 * Q3_1 - Q3_2
        w293 = -0.1 * Q3_4 - Q3_5
        w294 = sqrt(w292 * w292 + w293 * w293 + w291 * w291)
        w295 = 1.0 / w294
        w296 = -1.0 / w294 * w295 * (0.5 * w295)
        w297 = 2.0 * w293 * w296
        w298 = 0.1 * w297 - 0.1 * w290 + M3_1 * w282
        w299 = w290 + w297 + M3_1 * w283
        w300 = M3_2 * w281
        w301 = 2.0 * w285 * w289
        w302 = 2.0 * w291 * w296
        w303 = 0.1 * w302 - 0.1 * w301 + M3_2 * w282
        w304 = w301 - 1.0 + w302 + M3_2 * w283
        r3_0 = (
            Q3_6 * w284
            + Q3_7 * w298
            + Q3_8 * w299
            - Q3_3 * w300
            - Q3_4 * w303
            - Q3_5 * w304
        )
        w305 = M3_0 * w281
        w306 = 2.0 * w286 * w289
        w307 = 2.0 * w292 * w296
        w308 = 0.1 * w307 - 0.1 * w306 + M3_0 * w282
        w309 = w306 + w307 + M3_0 * w283
        r3_1 = (
            Q3_0 * w300
            - (Q3_6 * w305 + Q3_7 * w308 + Q3_8 * w309)
            + Q3_1 * w303
            + Q3_2 * w304
        )
        r3_2 = (
            Q3_3 * w305
            + Q3_4 * w308
            + Q3_5 * w309
            - Q3_0 * w284
            - Q3_1 * w298
            - Q3_2 * w299
        )
        change_xi3_0 = abs(f3_0 - xi3_0)
        change_xi3_1 = abs(f3_1 - xi3_1)
        change_xi3_2 = abs(f3_2 - xi3_2)
        change_n3_0 = abs(r3_0 - n3_0)
        change_n3_1 = abs(r3_1 - n3_1)
        change_n3_2 = abs(r3_2 - n3_2)
        change = max(
            change_xi3_0,
            change_xi3_1,
            change_xi3_2,
            change_n3_0,
            change_n3_1,
            change_n3_2,
        )
        scale = max(
            1.0,
            abs(xi3_0),
            abs(xi3_1),
            abs(xi3_2),
            abs(n3_0),
            abs(n3_1),
            abs(n3_2),
        )
        total = (
            change_xi3_0
            + change_xi3_1
            + change_xi3_2
            + change_n3_0
            + change_n3_1
            + change_n3_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi3, n3", 2, sweep, statistics)
        still = 0.0 < previous_3 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_3
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_3 = change
        xi3_0 = f3_0
        xi3_1 = f3_1
        xi3_2 = f3_2
        n3_0 = r3_0
        n3_1 = r3_1
        n3_2 = r3_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi3, n3", 2, sweep, statistics)
    if statistics is not None:
        statistics.count(2, sweep)
    xe3_1 = w45 * f3_1
    xe3_0 = w45 * f3_0
    xe3_2 = w45 * f3_2
    w310 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2
    c1_6, c2_12 = _stumpff_12(w310)
    w312 = xe3_1 * c2_12
    w313 = xe3_1 * w312
    w314 = xe3_2 * c2_12 * xe3_2
    ge3_0 = 1.0 - (w313 + w314)
    w315 = xe3_0 * c2_12
    w316 = xe3_1 * w315
    w318 = xe3_2 * c1_6
    ge3_1 = w316 - w318
    w319 = xe3_1 * c1_6
    w320 = xe3_2 * w315
    ge3_2 = w319 + w320
    e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2
    e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2
    e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2
    ge3_3 = w316 + w318
    w321 = xe3_0 * w315
    ge3_4 = 1.0 - (w314 + w321)
    w322 = xe3_2 * w312
    w323 = xe3_0 * c1_6
    ge3_5 = w322 - w323
    e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5
    e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5
    e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5
    ge3_6 = w320 - w319
    ge3_7 = w322 + w323
    ge3_8 = 1.0 - (w313 + w321)
    e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8
    e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8
    e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8
    mubar_0 = mu0 + w45 * (nu1_0 + nu3_0) + w254
    mubar_1 = mu1 + w45 * (nu1_1 + nu3_1) + w256
    mubar_2 = mu2 + w45 * (nu1_2 + nu3_2) + w259
    new_g00 = g00 * e3_0 + g10 * e3_1 + g20 * e3_2
    new_g01 = g01 * e3_0 + g11 * e3_1 + g21 * e3_2
    new_g02 = g02 * e3_0 + g12 * e3_1 + g22 * e3_2
    new_g10 = g00 * e3_3 + g10 * e3_4 + g20 * e3_5
    new_g11 = g01 * e3_3 + g11 * e3_4 + g21 * e3_5
    new_g12 = g02 * e3_3 + g12 * e3_4 + g22 * e3_5
    new_g20 = g00 * e3_6 + g10 * e3_7 + g20 * e3_8
    new_g21 = g01 * e3_6 + g11 * e3_7 + g21 * e3_8
    new_g22 = g02 * e3_6 + g12 * e3_7 + g22 * e3_8
    new_mu0 = e3_0 * mubar_0 + e3_1 * mubar_1 + e3_2 * mubar_2
    new_mu1 = e3_3 * mubar_0 + e3_4 * mubar_1 + e3_5 * mubar_2
    new_mu2 = e3_6 * mubar_0 + e3_7 * mubar_1 + e3_8 * mubar_2
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
