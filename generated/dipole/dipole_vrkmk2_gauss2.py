"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2

method:     family vrkmk(2), tableau gauss2
source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1;
            Table 3.1c of Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   7 dexpt, 1 lin (sharing)
            1 dexpt, 2 lin (dead code)
            parameters, folded: beta = 1
            the time: the scene does not depend on it
operations: 69 add, 106 mul, 1 stumpff_1 a step
            413 add, 613 mul, 12 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of
            the equations of v1, v2, m1, m2
made by:    orderconds emit dipole --method 'vrkmk(2):gauss2' --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vrkmk2_gauss2

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vrkmk2_gauss2.run(state, 0.005, 100))
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
        "the equations of v1, v2, m1, m2",
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


def _stumpff_123(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z)
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return ratio * cos(half), 0.5 * (ratio * ratio), c3


def _stumpff_1(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 1.0:
        return _stumpff_series_1(z)
    s = sqrt(z)
    return sin(s) / s


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
    m0_1_0 = 0.5 * mu0
    m0_1_1 = 0.5 * mu1
    m0_1_2 = 0.5 * mu2
    w10 = g01 * m0_1_0 + g11 * m0_1_1 + g21 * m0_1_2
    w11 = g00 * m0_1_0 + g10 * m0_1_1 + g20 * m0_1_2
    w12 = 0.5 * (g00 * w8 + g01 * w9 + g02 * w4) + g01 * w10 + w6 * w11
    w13 = g02 * m0_1_0 + g12 * m0_1_1 + g22 * m0_1_2
    xi0_0 = w12 + w2 * w13
    w14 = 0.5 * (g10 * w8 + g11 * w9 + g12 * w4) + g11 * w10 + w7 * w11
    xi0_1 = w14 + w3 * w13
    w15 = 0.5 * (g20 * w8 + g21 * w9 + g22 * w4) + g21 * w10 + w5 * w11
    xi0_2 = w15 + w1 * w13
    w16 = 0.25 * h
    w17 = -0.03867513459481288 * h
    w56 = 0.5386751345948129 * h
    w124 = -0.26933756729740643 * h
    w160 = -0.125 * h
    w161 = 0.5 * h
    w189 = 0.01933756729740644 * h
    # the equations of v1, v2, m1, m2: fixed point in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2, m1_0, m1_1, m1_2, m2_0, m2_1, m2_2
    v1_0 = xi0_0
    v1_1 = xi0_1
    v1_2 = xi0_2
    v2_0 = xi0_0
    v2_1 = xi0_1
    v2_2 = xi0_2
    m1_0 = m0_1_0
    m1_1 = m0_1_1
    m1_2 = m0_1_2
    m2_0 = m0_1_0
    m2_1 = m0_1_1
    m2_2 = m0_1_2
    previous_1 = inf
    for sweep in range(1, 101):
        X1_1 = v1_1 * w16 + v2_1 * w17
        X1_0 = v1_0 * w16 + v2_0 * w17
        X1_2 = v1_2 * w16 + v2_2 * w17
        w18 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
        c1_1, c2_1, c3_1 = _stumpff_123(w18)
        w20 = X1_1 * c2_1
        w21 = X1_1 * w20
        w22 = X1_2 * c2_1 * X1_2
        g1_0 = 1.0 - (w21 + w22)
        w23 = X1_0 * c2_1
        w24 = X1_1 * w23
        w26 = X1_2 * c1_1
        g1_1 = w24 - w26
        w27 = X1_1 * c1_1
        w28 = X1_2 * w23
        g1_2 = w27 + w28
        Q1_2 = g02 * g1_0 + g12 * g1_1 + g22 * g1_2
        w1_2 = 2.0 * m1_2
        w1_0 = 2.0 * m1_0
        w1_1 = 2.0 * m1_1
        w29 = X1_1 * w1_0 - X1_0 * w1_1
        w30 = X1_2 * w1_1 - X1_1 * w1_2
        w31 = X1_0 * w1_2 - X1_2 * w1_0
        M1_2 = w1_2 - 0.5 * w29 + 0.08333333333333333 * (X1_1 * w30 - X1_0 * w31)
        g1_6 = w28 - w27
        w32 = X1_0 * c1_1
        w33 = X1_2 * w20
        g1_7 = w32 + w33
        w34 = X1_0 * w23
        g1_8 = 1.0 - (w21 + w34)
        Q1_8 = g02 * g1_6 + g12 * g1_7 + g22 * g1_8
        w35 = 100.0 * Q1_8
        M1_0 = w1_0 - 0.5 * w30 + 0.08333333333333333 * (X1_2 * w31 - X1_1 * w29)
        w36 = 100.0 * Q1_2
        M1_1 = w1_1 - 0.5 * w31 + 0.08333333333333333 * (X1_0 * w29 - X1_2 * w30)
        g1_3 = w24 + w26
        g1_4 = 1.0 - (w22 + w34)
        g1_5 = w33 - w32
        Q1_5 = g02 * g1_3 + g12 * g1_4 + g22 * g1_5
        w37 = 100.0 * Q1_5
        w38 = M1_0 * w36 + M1_1 * w37 + M1_2 * w35
        Q1_0 = g00 * g1_0 + g10 * g1_1 + g20 * g1_2
        Q1_6 = g00 * g1_6 + g10 * g1_7 + g20 * g1_8
        w39 = 0.9900990099009901 * Q1_6
        w40 = 0.9900990099009901 * Q1_0
        Q1_3 = g00 * g1_3 + g10 * g1_4 + g20 * g1_5
        w41 = 0.9900990099009901 * Q1_3
        w42 = M1_0 * w40 + M1_1 * w41 + M1_2 * w39
        Q1_1 = g01 * g1_0 + g11 * g1_1 + g21 * g1_2
        Q1_7 = g01 * g1_6 + g11 * g1_7 + g21 * g1_8
        Q1_4 = g01 * g1_3 + g11 * g1_4 + g21 * g1_5
        w43 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7
        w44 = 0.5 * M1_0
        w45 = 0.5 * M1_1
        w46 = 0.5 * M1_2
        w47 = Q1_1 * w44 + Q1_4 * w45 + Q1_7 * w46
        w48 = Q1_0 * w44 + Q1_3 * w45 + Q1_6 * w46
        w49 = 0.5 * (Q1_0 * w42 + Q1_1 * w43 + Q1_2 * w38) + Q1_1 * w47 + w40 * w48
        w50 = Q1_2 * w44 + Q1_5 * w45 + Q1_8 * w46
        xi1_0 = w49 + w36 * w50
        w51 = 0.5 * (Q1_6 * w42 + Q1_7 * w43 + Q1_8 * w38) + Q1_7 * w47 + w39 * w48
        xi1_2 = w51 + w35 * w50
        w52 = 0.5 * (Q1_3 * w42 + Q1_4 * w43 + Q1_5 * w38) + Q1_4 * w47 + w41 * w48
        xi1_1 = w52 + w37 * w50
        w53 = X1_1 * xi1_2 - X1_2 * xi1_1
        w54 = X1_0 * xi1_1 - X1_1 * xi1_0
        w55 = X1_2 * xi1_0 - X1_0 * xi1_2
        u1_0 = xi1_0 - 0.5 * w53 + 0.08333333333333333 * (X1_1 * w54 - X1_2 * w55)
        u1_1 = xi1_1 - 0.5 * w55 + 0.08333333333333333 * (X1_2 * w53 - X1_0 * w54)
        u1_2 = xi1_2 - 0.5 * w54 + 0.08333333333333333 * (X1_0 * w55 - X1_1 * w53)
        X2_1 = v1_1 * w56 + v2_1 * w16
        X2_0 = v1_0 * w56 + v2_0 * w16
        X2_2 = v1_2 * w56 + v2_2 * w16
        w57 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2
        c1_2, c2_2, c3_2 = _stumpff_123(w57)
        w59 = X2_1 * c2_2
        w60 = X2_1 * w59
        w61 = X2_2 * c2_2 * X2_2
        g2_0 = 1.0 - (w60 + w61)
        w62 = X2_0 * c2_2
        w63 = X2_1 * w62
        w65 = X2_2 * c1_2
        g2_1 = w63 - w65
        w66 = X2_1 * c1_2
        w67 = X2_2 * w62
        g2_2 = w66 + w67
        Q2_2 = g02 * g2_0 + g12 * g2_1 + g22 * g2_2
        w2_2 = 2.0 * m2_2
        w2_0 = 2.0 * m2_0
        w2_1 = 2.0 * m2_1
        w68 = X2_1 * w2_0 - X2_0 * w2_1
        w69 = X2_2 * w2_1 - X2_1 * w2_2
        w70 = X2_0 * w2_2 - X2_2 * w2_0
        M2_2 = w2_2 - 0.5 * w68 + 0.08333333333333333 * (X2_1 * w69 - X2_0 * w70)
        g2_6 = w67 - w66
        w71 = X2_0 * c1_2
        w72 = X2_2 * w59
        g2_7 = w71 + w72
        w73 = X2_0 * w62
        g2_8 = 1.0 - (w60 + w73)
        Q2_8 = g02 * g2_6 + g12 * g2_7 + g22 * g2_8
        w74 = 100.0 * Q2_8
        M2_0 = w2_0 - 0.5 * w69 + 0.08333333333333333 * (X2_2 * w70 - X2_1 * w68)
        w75 = 100.0 * Q2_2
        M2_1 = w2_1 - 0.5 * w70 + 0.08333333333333333 * (X2_0 * w68 - X2_2 * w69)
        g2_3 = w63 + w65
        g2_4 = 1.0 - (w61 + w73)
        g2_5 = w72 - w71
        Q2_5 = g02 * g2_3 + g12 * g2_4 + g22 * g2_5
        w76 = 100.0 * Q2_5
        w77 = M2_0 * w75 + M2_1 * w76 + M2_2 * w74
        Q2_0 = g00 * g2_0 + g10 * g2_1 + g20 * g2_2
        Q2_6 = g00 * g2_6 + g10 * g2_7 + g20 * g2_8
        w78 = 0.9900990099009901 * Q2_6
        w79 = 0.9900990099009901 * Q2_0
        Q2_3 = g00 * g2_3 + g10 * g2_4 + g20 * g2_5
        w80 = 0.9900990099009901 * Q2_3
        w81 = M2_0 * w79 + M2_1 * w80 + M2_2 * w78
        Q2_1 = g01 * g2_0 + g11 * g2_1 + g21 * g2_2
        Q2_7 = g01 * g2_6 + g11 * g2_7 + g21 * g2_8
        Q2_4 = g01 * g2_3 + g11 * g2_4 + g21 * g2_5
        w82 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7
        w83 = 0.5 * M2_0
        w84 = 0.5 * M2_1
        w85 = 0.5 * M2_2
        w86 = Q2_1 * w83 + Q2_4 * w84 + Q2_7 * w85
        w87 = Q2_0 * w83 + Q2_3 * w84 + Q2_6 * w85
        w88 = 0.5 * (Q2_0 * w81 + Q2_1 * w82 + Q2_2 * w77) + Q2_1 * w86 + w79 * w87
        w89 = Q2_2 * w83 + Q2_5 * w84 + Q2_8 * w85
        xi2_0 = w88 + w75 * w89
        w90 = 0.5 * (Q2_6 * w81 + Q2_7 * w82 + Q2_8 * w77) + Q2_7 * w86 + w78 * w87
        xi2_2 = w90 + w74 * w89
        w91 = 0.5 * (Q2_3 * w81 + Q2_4 * w82 + Q2_5 * w77) + Q2_4 * w86 + w80 * w87
        xi2_1 = w91 + w76 * w89
        w92 = X2_1 * xi2_2 - X2_2 * xi2_1
        w93 = X2_0 * xi2_1 - X2_1 * xi2_0
        w94 = X2_2 * xi2_0 - X2_0 * xi2_2
        u2_0 = xi2_0 - 0.5 * w92 + 0.08333333333333333 * (X2_1 * w93 - X2_2 * w94)
        u2_1 = xi2_1 - 0.5 * w94 + 0.08333333333333333 * (X2_2 * w92 - X2_0 * w93)
        u2_2 = xi2_2 - 0.5 * w93 + 0.08333333333333333 * (X2_0 * w94 - X2_1 * w92)
        w95 = w81 * w84 + 0.9900990099009901 * (M2_1 * w87)
        w96 = 1.5 + 0.1 * Q2_7 - Q2_8
        w97 = 0.1 * Q2_1 - Q2_2
        w98 = 0.1 * Q2_4 - Q2_5
        w99 = sqrt(w97 * w97 + w98 * w98 + w96 * w96)
        w100 = 1.0 / w99 / w99 * (0.5 / w99)
        w101 = 2.0 * w98 * w100
        w102 = 1.5 - 0.1 * Q2_7 - Q2_8
        w103 = -0.1 * Q2_1 - Q2_2
        w104 = -0.1 * Q2_4 - Q2_5
        w105 = sqrt(w103 * w103 + w104 * w104 + w102 * w102)
        w106 = -1.0 / w105 / w105 * (0.5 / w105)
        w107 = 2.0 * w104 * w106
        w108 = 0.1 * w107 - 0.1 * w101 + w82 * w84 + M2_1 * w86
        w109 = w101 + w107 + w77 * w84 + 100.0 * (M2_1 * w89)
        w110 = w81 * w85 + 0.9900990099009901 * (M2_2 * w87)
        w111 = 2.0 * w96 * w100
        w112 = 2.0 * w102 * w106
        w113 = 0.1 * w112 - 0.1 * w111 + w82 * w85 + M2_2 * w86
        w114 = w111 - 1.0 + w112 + w77 * w85 + 100.0 * (M2_2 * w89)
        n2_0 = (
            Q2_6 * w95
            + Q2_7 * w108
            + Q2_8 * w109
            - Q2_3 * w110
            - Q2_4 * w113
            - Q2_5 * w114
        )
        w115 = w81 * w83 + 0.9900990099009901 * (M2_0 * w87)
        w116 = 2.0 * w97 * w100
        w117 = 2.0 * w103 * w106
        w118 = 0.1 * w117 - 0.1 * w116 + w82 * w83 + M2_0 * w86
        w119 = w116 + w117 + w77 * w83 + 100.0 * (M2_0 * w89)
        n2_2 = (
            Q2_3 * w115
            + Q2_4 * w118
            + Q2_5 * w119
            - Q2_0 * w95
            - Q2_1 * w108
            - Q2_2 * w109
        )
        n2_1 = (
            Q2_0 * w110
            - (Q2_6 * w115 + Q2_7 * w118 + Q2_8 * w119)
            + Q2_1 * w113
            + Q2_2 * w114
        )
        w120 = X2_1 * n2_2 - X2_2 * n2_1
        w122 = X2_0 * n2_1 - X2_1 * n2_0
        w123 = X2_2 * n2_0 - X2_0 * n2_2
        d2_0 = n2_0 - w120 * c2_2 + (X2_1 * w122 - X2_2 * w123) * c3_2
        w125 = 0.5 * xi2_2 - 0.08333333333333333 * w93
        w126 = 0.5 * xi2_1 - 0.08333333333333333 * w94
        w127 = m2_2 * X2_0 - m2_0 * X2_2
        w128 = -0.08333333333333333 * xi2_2
        w129 = m2_0 * X2_1 - m2_1 * X2_0
        w130 = -0.08333333333333333 * xi2_1
        P2_0 = m2_1 * w125 - m2_2 * w126 + (w127 * w128 - w129 * w130)
        w131 = w42 * w45 + 0.9900990099009901 * (M1_1 * w48)
        w132 = 1.5 + 0.1 * Q1_7 - Q1_8
        w133 = 0.1 * Q1_1 - Q1_2
        w134 = 0.1 * Q1_4 - Q1_5
        w135 = sqrt(w133 * w133 + w134 * w134 + w132 * w132)
        w136 = 1.0 / w135 / w135 * (0.5 / w135)
        w137 = 2.0 * w134 * w136
        w138 = 1.5 - 0.1 * Q1_7 - Q1_8
        w139 = -0.1 * Q1_1 - Q1_2
        w140 = -0.1 * Q1_4 - Q1_5
        w141 = sqrt(w139 * w139 + w140 * w140 + w138 * w138)
        w142 = -1.0 / w141 / w141 * (0.5 / w141)
        w143 = 2.0 * w140 * w142
        w144 = 0.1 * w143 - 0.1 * w137 + w43 * w45 + M1_1 * w47
        w145 = w137 + w143 + w38 * w45 + 100.0 * (M1_1 * w50)
        w146 = w42 * w46 + 0.9900990099009901 * (M1_2 * w48)
        w147 = 2.0 * w132 * w136
        w148 = 2.0 * w138 * w142
        w149 = 0.1 * w148 - 0.1 * w147 + w43 * w46 + M1_2 * w47
        w150 = w147 - 1.0 + w148 + w38 * w46 + 100.0 * (M1_2 * w50)
        n1_0 = (
            Q1_6 * w131
            + Q1_7 * w144
            + Q1_8 * w145
            - Q1_3 * w146
            - Q1_4 * w149
            - Q1_5 * w150
        )
        w151 = w42 * w44 + 0.9900990099009901 * (M1_0 * w48)
        w152 = 2.0 * w133 * w136
        w153 = 2.0 * w139 * w142
        w154 = 0.1 * w153 - 0.1 * w152 + w43 * w44 + M1_0 * w47
        w155 = w152 + w153 + w38 * w44 + 100.0 * (M1_0 * w50)
        n1_2 = (
            Q1_3 * w151
            + Q1_4 * w154
            + Q1_5 * w155
            - Q1_0 * w131
            - Q1_1 * w144
            - Q1_2 * w145
        )
        n1_1 = (
            Q1_0 * w146
            - (Q1_6 * w151 + Q1_7 * w154 + Q1_8 * w155)
            + Q1_1 * w149
            + Q1_2 * w150
        )
        w156 = X1_1 * n1_2 - X1_2 * n1_1
        w158 = X1_0 * n1_1 - X1_1 * n1_0
        w159 = X1_2 * n1_0 - X1_0 * n1_2
        d1_0 = n1_0 - w156 * c2_1 + (X1_1 * w158 - X1_2 * w159) * c3_1
        nu2_0 = g2_0 * n2_0 + g2_3 * n2_1 + g2_6 * n2_2
        Y_0 = w161 * (u1_0 + u2_0)
        Y_1 = w161 * (u1_1 + u2_1)
        Y_2 = w161 * (u1_2 + u2_2)
        w162 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
        c2_3, c3_3 = _stumpff_23(w162)
        w163 = c2_3
        nu2_1 = g2_1 * n2_0 + g2_4 * n2_1 + g2_7 * n2_2
        nu2_2 = g2_2 * n2_0 + g2_5 * n2_1 + g2_8 * n2_2
        w164 = Y_2 * nu2_1 - Y_1 * nu2_2
        w166 = Y_0 * nu2_2 - nu2_0 * Y_2
        w167 = nu2_0 * Y_1 - Y_0 * nu2_1
        L_3_0 = nu2_0 - w163 * w164 + (Y_2 * w166 - Y_1 * w167) * c3_3
        w168 = 0.5 * xi1_2 - 0.08333333333333333 * w54
        w169 = 0.5 * xi1_1 - 0.08333333333333333 * w55
        w170 = m1_2 * X1_0 - m1_0 * X1_2
        w171 = -0.08333333333333333 * xi1_2
        w172 = m1_0 * X1_1 - m1_1 * X1_0
        w173 = -0.08333333333333333 * xi1_1
        P1_0 = m1_1 * w168 - m1_2 * w169 + (w170 * w171 - w172 * w173)
        nu1_0 = g1_0 * n1_0 + g1_3 * n1_1 + g1_6 * n1_2
        nu1_1 = g1_1 * n1_0 + g1_4 * n1_1 + g1_7 * n1_2
        nu1_2 = g1_2 * n1_0 + g1_5 * n1_1 + g1_8 * n1_2
        w174 = Y_2 * nu1_1 - Y_1 * nu1_2
        w175 = Y_0 * nu1_2 - Y_2 * nu1_0
        w176 = Y_1 * nu1_0 - Y_0 * nu1_1
        L_2_0 = nu1_0 - w163 * w174 + (Y_2 * w175 - Y_1 * w176) * c3_3
        w177 = mu1 * Y_2 - mu2 * Y_1
        w178 = mu2 * Y_0 - mu0 * Y_2
        w179 = mu0 * Y_1 - mu1 * Y_0
        w180 = 0.5 * (mu0 - w163 * w177 + (Y_2 * w178 - Y_1 * w179) * c3_3)
        p1_0 = (
            d2_0 * w124 + w56 * P2_0 + d1_0 * w160 + w16 * (P1_0 + L_2_0 + L_3_0) + w180
        )
        d2_1 = n2_1 - w123 * c2_2 + (X2_2 * w120 - X2_0 * w122) * c3_2
        w181 = 0.5 * xi2_0 - 0.08333333333333333 * w92
        w182 = -0.08333333333333333 * xi2_0
        w183 = m2_1 * X2_2 - m2_2 * X2_1
        P2_1 = m2_2 * w181 - m2_0 * w125 + (w129 * w182 - w128 * w183)
        d1_1 = n1_1 - w159 * c2_1 + (X1_2 * w156 - X1_0 * w158) * c3_1
        L_3_1 = nu2_1 - w163 * w166 + (Y_0 * w167 - Y_2 * w164) * c3_3
        w184 = 0.5 * xi1_0 - 0.08333333333333333 * w53
        w185 = -0.08333333333333333 * xi1_0
        w186 = m1_1 * X1_2 - m1_2 * X1_1
        P1_1 = m1_2 * w184 - m1_0 * w168 + (w172 * w185 - w171 * w186)
        L_2_1 = nu1_1 - w163 * w175 + (Y_0 * w176 - Y_2 * w174) * c3_3
        w187 = 0.5 * (mu1 - w163 * w178 + (Y_0 * w179 - Y_2 * w177) * c3_3)
        p1_1 = (
            w56 * P2_1 + w124 * d2_1 + w160 * d1_1 + w16 * (P1_1 + L_2_1 + L_3_1) + w187
        )
        d2_2 = n2_2 - w122 * c2_2 + (X2_0 * w123 - X2_1 * w120) * c3_2
        P2_2 = m2_0 * w126 - m2_1 * w181 + (w130 * w183 - w127 * w182)
        d1_2 = n1_2 - w158 * c2_1 + (X1_0 * w159 - X1_1 * w156) * c3_1
        L_3_2 = nu2_2 - w163 * w167 + (Y_1 * w164 - Y_0 * w166) * c3_3
        P1_2 = m1_0 * w169 - m1_1 * w184 + (w173 * w186 - w170 * w185)
        L_2_2 = nu1_2 - w163 * w176 + (Y_1 * w174 - Y_0 * w175) * c3_3
        w188 = 0.5 * (mu2 - w163 * w179 + (Y_1 * w177 - Y_0 * w178) * c3_3)
        p1_2 = (
            w56 * P2_2 + w124 * d2_2 + w160 * d1_2 + w16 * (P1_2 + L_2_2 + L_3_2) + w188
        )
        p2_0 = (
            d2_0 * w160 + w16 * (P2_0 + L_2_0 + L_3_0) + d1_0 * w189 + w17 * P1_0 + w180
        )
        p2_1 = (
            w16 * (P2_1 + L_2_1 + L_3_1) + w160 * d2_1 + d1_1 * w189 + w17 * P1_1 + w187
        )
        p2_2 = (
            w16 * (P2_2 + L_2_2 + L_3_2) + w160 * d2_2 + d1_2 * w189 + w17 * P1_2 + w188
        )
        u1_0 = u1_0
        u1_1 = u1_1
        u1_2 = u1_2
        u2_0 = u2_0
        u2_1 = u2_1
        u2_2 = u2_2
        p1_0 = p1_0
        p1_1 = p1_1
        p1_2 = p1_2
        p2_0 = p2_0
        p2_1 = p2_1
        p2_2 = p2_2
        change_v1_0 = abs(u1_0 - v1_0)
        change_v1_1 = abs(u1_1 - v1_1)
        change_v1_2 = abs(u1_2 - v1_2)
        change_v2_0 = abs(u2_0 - v2_0)
        change_v2_1 = abs(u2_1 - v2_1)
        change_v2_2 = abs(u2_2 - v2_2)
        change_m1_0 = abs(p1_0 - m1_0)
        change_m1_1 = abs(p1_1 - m1_1)
        change_m1_2 = abs(p1_2 - m1_2)
        change_m2_0 = abs(p2_0 - m2_0)
        change_m2_1 = abs(p2_1 - m2_1)
        change_m2_2 = abs(p2_2 - m2_2)
        change = max(
            change_v1_0,
            change_v1_1,
            change_v1_2,
            change_v2_0,
            change_v2_1,
            change_v2_2,
            change_m1_0,
            change_m1_1,
            change_m1_2,
            change_m2_0,
            change_m2_1,
            change_m2_2,
        )
        scale = max(
            1.0,
            abs(v1_0),
            abs(v1_1),
            abs(v1_2),
            abs(v2_0),
            abs(v2_1),
            abs(v2_2),
            abs(m1_0),
            abs(m1_1),
            abs(m1_2),
            abs(m2_0),
            abs(m2_1),
            abs(m2_2),
        )
        total = (
            change_v1_0
            + change_v1_1
            + change_v1_2
            + change_v2_0
            + change_v2_1
            + change_v2_2
            + change_m1_0
            + change_m1_1
            + change_m1_2
            + change_m2_0
            + change_m2_1
            + change_m2_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
        settled = change >= previous_1 or change == 0.0
        if settled and change <= 5.684341886080802e-14 * scale:
            break
        previous_1 = change
        v1_0 = u1_0
        v1_1 = u1_1
        v1_2 = u1_2
        v2_0 = u2_0
        v2_1 = u2_1
        v2_2 = u2_2
        m1_0 = p1_0
        m1_1 = p1_1
        m1_2 = p1_2
        m2_0 = p2_0
        m2_1 = p2_1
        m2_2 = p2_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    w190 = Y_1 * w163
    w191 = Y_1 * w190
    w192 = Y_2 * w163 * Y_2
    g_0 = 1.0 - (w191 + w192)
    w193 = Y_0 * w163
    w194 = Y_1 * w193
    c1_3 = _stumpff_1(w162)
    w196 = Y_2 * c1_3
    g_1 = w194 - w196
    w197 = Y_1 * c1_3
    w198 = Y_2 * w193
    g_2 = w197 + w198
    g_3 = w194 + w196
    w199 = Y_0 * w193
    g_4 = 1.0 - (w192 + w199)
    w200 = Y_2 * w190
    w201 = Y_0 * c1_3
    g_5 = w200 - w201
    g_6 = w198 - w197
    g_7 = w200 + w201
    g_8 = 1.0 - (w191 + w199)
    mubar_0 = mu0 + w161 * (nu2_0 + nu1_0)
    mubar_1 = mu1 + w161 * (nu2_1 + nu1_1)
    mubar_2 = mu2 + w161 * (nu2_2 + nu1_2)
    new_g00 = g00 * g_0 + g10 * g_1 + g20 * g_2
    new_g01 = g01 * g_0 + g11 * g_1 + g21 * g_2
    new_g02 = g02 * g_0 + g12 * g_1 + g22 * g_2
    new_g10 = g00 * g_3 + g10 * g_4 + g20 * g_5
    new_g11 = g01 * g_3 + g11 * g_4 + g21 * g_5
    new_g12 = g02 * g_3 + g12 * g_4 + g22 * g_5
    new_g20 = g00 * g_6 + g10 * g_7 + g20 * g_8
    new_g21 = g01 * g_6 + g11 * g_7 + g21 * g_8
    new_g22 = g02 * g_6 + g12 * g_7 + g22 * g_8
    new_mu0 = g_0 * mubar_0 + g_1 * mubar_1 + g_2 * mubar_2
    new_mu1 = g_3 * mubar_0 + g_4 * mubar_1 + g_5 * mubar_2
    new_mu2 = g_6 * mubar_0 + g_7 * mubar_1 + g_8 * mubar_2
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
