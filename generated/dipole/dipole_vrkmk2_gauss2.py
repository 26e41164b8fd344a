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
operations: 54 add, 81 mul, 1 stumpff_1 a step
            365 add, 535 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of
            the equations of v1, v2, m1, m2
made by:    orderconds emit dipole --method 'vrkmk(2):gauss2' --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vrkmk2_gauss2

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vrkmk2_gauss2.run(state, 0.005, 100))
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
    w1 = 0.9900990099009901 * (g00 * mu0 + g10 * mu1 + g20 * mu2)
    w2 = g01 * mu0 + g11 * mu1 + g21 * mu2
    w3 = 100.0 * (g02 * mu0 + g12 * mu1 + g22 * mu2)
    xi0_0 = g00 * w1 + g01 * w2 + g02 * w3
    xi0_1 = g10 * w1 + g11 * w2 + g12 * w3
    xi0_2 = g20 * w1 + g21 * w2 + g22 * w3
    m0_1_0 = 0.5 * mu0
    m0_1_1 = 0.5 * mu1
    m0_1_2 = 0.5 * mu2
    w4 = 0.25 * h
    w5 = -0.03867513459481288 * h
    w29 = 0.5386751345948129 * h
    w83 = -0.26933756729740643 * h
    w120 = -0.125 * h
    w121 = 0.5 * h
    w149 = 0.01933756729740644 * h
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
    previous_1 = 0.0
    for sweep in range(1, 101):
        X1_1 = v1_1 * w4 + v2_1 * w5
        X1_0 = v1_0 * w4 + v2_0 * w5
        X1_2 = v1_2 * w4 + v2_2 * w5
        w6 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
        c1_1, c2_1, c3_1 = _stumpff_123(w6)
        w8 = X1_1 * c2_1
        w9 = X1_1 * w8
        w10 = X1_2 * c2_1 * X1_2
        g1_0 = 1.0 - (w9 + w10)
        w11 = X1_0 * c2_1
        w12 = X1_1 * w11
        w14 = X1_2 * c1_1
        g1_1 = w12 - w14
        w15 = X1_1 * c1_1
        w16 = X1_2 * w11
        g1_2 = w15 + w16
        Q1_0 = g00 * g1_0 + g10 * g1_1 + g20 * g1_2
        w1_2 = 2.0 * m1_2
        w1_0 = 2.0 * m1_0
        w1_1 = 2.0 * m1_1
        w17 = X1_1 * w1_0 - X1_0 * w1_1
        w18 = X1_2 * w1_1 - X1_1 * w1_2
        w19 = X1_0 * w1_2 - X1_2 * w1_0
        M1_2 = w1_2 - 0.5 * w17 + 0.08333333333333333 * (X1_1 * w18 - X1_0 * w19)
        g1_6 = w16 - w15
        w20 = X1_0 * c1_1
        w21 = X1_2 * w8
        g1_7 = w20 + w21
        w22 = X1_0 * w11
        g1_8 = 1.0 - (w9 + w22)
        Q1_6 = g00 * g1_6 + g10 * g1_7 + g20 * g1_8
        M1_0 = w1_0 - 0.5 * w18 + 0.08333333333333333 * (X1_2 * w19 - X1_1 * w17)
        M1_1 = w1_1 - 0.5 * w19 + 0.08333333333333333 * (X1_0 * w17 - X1_2 * w18)
        g1_3 = w12 + w14
        g1_4 = 1.0 - (w10 + w22)
        g1_5 = w21 - w20
        Q1_3 = g00 * g1_3 + g10 * g1_4 + g20 * g1_5
        w23 = 0.9900990099009901 * (M1_1 * Q1_3 + Q1_0 * M1_0 + M1_2 * Q1_6)
        Q1_1 = g01 * g1_0 + g11 * g1_1 + g21 * g1_2
        Q1_7 = g01 * g1_6 + g11 * g1_7 + g21 * g1_8
        Q1_4 = g01 * g1_3 + g11 * g1_4 + g21 * g1_5
        w24 = M1_0 * Q1_1 + M1_1 * Q1_4 + M1_2 * Q1_7
        Q1_2 = g02 * g1_0 + g12 * g1_1 + g22 * g1_2
        Q1_8 = g02 * g1_6 + g12 * g1_7 + g22 * g1_8
        Q1_5 = g02 * g1_3 + g12 * g1_4 + g22 * g1_5
        w25 = 100.0 * (M1_0 * Q1_2 + M1_1 * Q1_5 + M1_2 * Q1_8)
        xi1_0 = Q1_0 * w23 + Q1_1 * w24 + Q1_2 * w25
        xi1_2 = Q1_6 * w23 + Q1_7 * w24 + Q1_8 * w25
        xi1_1 = Q1_3 * w23 + Q1_4 * w24 + Q1_5 * w25
        w26 = X1_1 * xi1_2 - X1_2 * xi1_1
        w27 = X1_0 * xi1_1 - X1_1 * xi1_0
        w28 = X1_2 * xi1_0 - X1_0 * xi1_2
        u1_0 = xi1_0 - 0.5 * w26 + 0.08333333333333333 * (X1_1 * w27 - X1_2 * w28)
        u1_1 = xi1_1 - 0.5 * w28 + 0.08333333333333333 * (X1_2 * w26 - X1_0 * w27)
        u1_2 = xi1_2 - 0.5 * w27 + 0.08333333333333333 * (X1_0 * w28 - X1_1 * w26)
        X2_1 = v1_1 * w29 + v2_1 * w4
        X2_0 = v1_0 * w29 + v2_0 * w4
        X2_2 = v1_2 * w29 + v2_2 * w4
        w30 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2
        c1_2, c2_2, c3_2 = _stumpff_123(w30)
        w32 = X2_1 * c2_2
        w33 = X2_1 * w32
        w34 = X2_2 * c2_2 * X2_2
        g2_0 = 1.0 - (w33 + w34)
        w35 = X2_0 * c2_2
        w36 = X2_1 * w35
        w38 = X2_2 * c1_2
        g2_1 = w36 - w38
        w39 = X2_1 * c1_2
        w40 = X2_2 * w35
        g2_2 = w39 + w40
        Q2_0 = g00 * g2_0 + g10 * g2_1 + g20 * g2_2
        w2_2 = 2.0 * m2_2
        w2_0 = 2.0 * m2_0
        w2_1 = 2.0 * m2_1
        w41 = X2_1 * w2_0 - X2_0 * w2_1
        w42 = X2_2 * w2_1 - X2_1 * w2_2
        w43 = X2_0 * w2_2 - X2_2 * w2_0
        M2_2 = w2_2 - 0.5 * w41 + 0.08333333333333333 * (X2_1 * w42 - X2_0 * w43)
        g2_6 = w40 - w39
        w44 = X2_0 * c1_2
        w45 = X2_2 * w32
        g2_7 = w44 + w45
        w46 = X2_0 * w35
        g2_8 = 1.0 - (w33 + w46)
        Q2_6 = g00 * g2_6 + g10 * g2_7 + g20 * g2_8
        M2_0 = w2_0 - 0.5 * w42 + 0.08333333333333333 * (X2_2 * w43 - X2_1 * w41)
        M2_1 = w2_1 - 0.5 * w43 + 0.08333333333333333 * (X2_0 * w41 - X2_2 * w42)
        g2_3 = w36 + w38
        g2_4 = 1.0 - (w34 + w46)
        g2_5 = w45 - w44
        Q2_3 = g00 * g2_3 + g10 * g2_4 + g20 * g2_5
        w47 = 0.9900990099009901 * (M2_1 * Q2_3 + Q2_0 * M2_0 + M2_2 * Q2_6)
        Q2_1 = g01 * g2_0 + g11 * g2_1 + g21 * g2_2
        Q2_7 = g01 * g2_6 + g11 * g2_7 + g21 * g2_8
        Q2_4 = g01 * g2_3 + g11 * g2_4 + g21 * g2_5
        w48 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7
        Q2_2 = g02 * g2_0 + g12 * g2_1 + g22 * g2_2
        Q2_8 = g02 * g2_6 + g12 * g2_7 + g22 * g2_8
        Q2_5 = g02 * g2_3 + g12 * g2_4 + g22 * g2_5
        w49 = 100.0 * (M2_0 * Q2_2 + M2_1 * Q2_5 + M2_2 * Q2_8)
        xi2_0 = Q2_0 * w47 + Q2_1 * w48 + Q2_2 * w49
        xi2_2 = Q2_6 * w47 + Q2_7 * w48 + Q2_8 * w49
        xi2_1 = Q2_3 * w47 + Q2_4 * w48 + Q2_5 * w49
        w50 = X2_1 * xi2_2 - X2_2 * xi2_1
        w51 = X2_0 * xi2_1 - X2_1 * xi2_0
        w52 = X2_2 * xi2_0 - X2_0 * xi2_2
        u2_0 = xi2_0 - 0.5 * w50 + 0.08333333333333333 * (X2_1 * w51 - X2_2 * w52)
        u2_1 = xi2_1 - 0.5 * w52 + 0.08333333333333333 * (X2_2 * w50 - X2_0 * w51)
        u2_2 = xi2_2 - 0.5 * w51 + 0.08333333333333333 * (X2_0 * w52 - X2_1 * w50)
        w53 = M2_1 * w47
        w54 = 1.5 + 0.1 * Q2_7 - Q2_8
        w55 = 0.1 * Q2_1 - Q2_2
        w56 = 0.1 * Q2_4 - Q2_5
        w57 = 1.0 / sqrt(w55 * w55 + w56 * w56 + w54 * w54)
        w58 = w57 * w57 * (0.5 * w57)
        w59 = 2.0 * w56 * w58
        w60 = 1.5 - 0.1 * Q2_7 - Q2_8
        w61 = -0.1 * Q2_1 - Q2_2
        w62 = -0.1 * Q2_4 - Q2_5
        w63 = sqrt(w61 * w61 + w62 * w62 + w60 * w60)
        w64 = 1.0 / w63
        w65 = -1.0 / w63 * w64 * (0.5 * w64)
        w66 = 2.0 * w62 * w65
        w67 = 0.1 * w66 - 0.1 * w59 + M2_1 * w48
        w68 = w59 + w66 + M2_1 * w49
        w69 = M2_2 * w47
        w70 = 2.0 * w54 * w58
        w71 = 2.0 * w60 * w65
        w72 = 0.1 * w71 - 0.1 * w70 + M2_2 * w48
        w73 = w70 - 1.0 + w71 + M2_2 * w49
        n2_0 = (
            Q2_6 * w53 + Q2_7 * w67 + Q2_8 * w68 - Q2_3 * w69 - Q2_4 * w72 - Q2_5 * w73
        )
        w74 = M2_0 * w47
        w75 = 2.0 * w55 * w58
        w76 = 2.0 * w61 * w65
        w77 = 0.1 * w76 - 0.1 * w75 + M2_0 * w48
        w78 = w75 + w76 + M2_0 * w49
        n2_2 = (
            Q2_3 * w74 + Q2_4 * w77 + Q2_5 * w78 - Q2_0 * w53 - Q2_1 * w67 - Q2_2 * w68
        )
        n2_1 = (
            Q2_0 * w69
            - (Q2_6 * w74 + Q2_7 * w77 + Q2_8 * w78)
            + Q2_1 * w72
            + Q2_2 * w73
        )
        w79 = X2_1 * n2_2 - X2_2 * n2_1
        w81 = X2_0 * n2_1 - X2_1 * n2_0
        w82 = X2_2 * n2_0 - X2_0 * n2_2
        d2_0 = n2_0 - w79 * c2_2 + (X2_1 * w81 - X2_2 * w82) * c3_2
        w84 = 0.5 * xi2_2 - 0.08333333333333333 * w51
        w85 = 0.5 * xi2_1 - 0.08333333333333333 * w52
        w86 = m2_2 * X2_0 - m2_0 * X2_2
        w87 = -0.08333333333333333 * xi2_2
        w88 = m2_0 * X2_1 - m2_1 * X2_0
        w89 = -0.08333333333333333 * xi2_1
        P2_0 = m2_1 * w84 - m2_2 * w85 + (w86 * w87 - w88 * w89)
        w90 = M1_1 * w23
        w91 = 1.5 + 0.1 * Q1_7 - Q1_8
        w92 = 0.1 * Q1_1 - Q1_2
        w93 = 0.1 * Q1_4 - Q1_5
        w94 = 1.0 / sqrt(w92 * w92 + w93 * w93 + w91 * w91)
        w95 = w94 * w94 * (0.5 * w94)
        w96 = 2.0 * w93 * w95
        w97 = 1.5 - 0.1 * Q1_7 - Q1_8
        w98 = -0.1 * Q1_1 - Q1_2
        w99 = -0.1 * Q1_4 - Q1_5
        w100 = sqrt(w98 * w98 + w99 * w99 + w97 * w97)
        w101 = 1.0 / w100
        w102 = -1.0 / w100 * w101 * (0.5 * w101)
        w103 = 2.0 * w99 * w102
        w104 = 0.1 * w103 - 0.1 * w96 + M1_1 * w24
        w105 = w96 + w103 + M1_1 * w25
        w106 = M1_2 * w23
        w107 = 2.0 * w91 * w95
        w108 = 2.0 * w97 * w102
        w109 = 0.1 * w108 - 0.1 * w107 + M1_2 * w24
        w110 = w107 - 1.0 + w108 + M1_2 * w25
        n1_0 = (
            Q1_6 * w90
            + Q1_7 * w104
            + Q1_8 * w105
            - Q1_3 * w106
            - Q1_4 * w109
            - Q1_5 * w110
        )
        w111 = M1_0 * w23
        w112 = 2.0 * w92 * w95
        w113 = 2.0 * w98 * w102
        w114 = 0.1 * w113 - 0.1 * w112 + M1_0 * w24
        w115 = w112 + w113 + M1_0 * w25
        n1_2 = (
            Q1_3 * w111
            + Q1_4 * w114
            + Q1_5 * w115
            - Q1_0 * w90
            - Q1_1 * w104
            - Q1_2 * w105
        )
        n1_1 = (
            Q1_0 * w106
            - (Q1_6 * w111 + Q1_7 * w114 + Q1_8 * w115)
            + Q1_1 * w109
            + Q1_2 * w110
        )
        w116 = X1_1 * n1_2 - X1_2 * n1_1
        w118 = X1_0 * n1_1 - X1_1 * n1_0
        w119 = X1_2 * n1_0 - X1_0 * n1_2
        d1_0 = n1_0 - w116 * c2_1 + (X1_1 * w118 - X1_2 * w119) * c3_1
        nu2_0 = g2_0 * n2_0 + g2_3 * n2_1 + g2_6 * n2_2
        Y_0 = w121 * (u1_0 + u2_0)
        Y_1 = w121 * (u1_1 + u2_1)
        Y_2 = w121 * (u1_2 + u2_2)
        w122 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
        c2_3, c3_3 = _stumpff_23(w122)
        w123 = c2_3
        nu2_1 = g2_1 * n2_0 + g2_4 * n2_1 + g2_7 * n2_2
        nu2_2 = g2_2 * n2_0 + g2_5 * n2_1 + g2_8 * n2_2
        w124 = Y_2 * nu2_1 - Y_1 * nu2_2
        w126 = Y_0 * nu2_2 - nu2_0 * Y_2
        w127 = nu2_0 * Y_1 - Y_0 * nu2_1
        L_3_0 = nu2_0 - w123 * w124 + (Y_2 * w126 - Y_1 * w127) * c3_3
        w128 = 0.5 * xi1_2 - 0.08333333333333333 * w27
        w129 = 0.5 * xi1_1 - 0.08333333333333333 * w28
        w130 = m1_2 * X1_0 - m1_0 * X1_2
        w131 = -0.08333333333333333 * xi1_2
        w132 = m1_0 * X1_1 - m1_1 * X1_0
        w133 = -0.08333333333333333 * xi1_1
        P1_0 = m1_1 * w128 - m1_2 * w129 + (w130 * w131 - w132 * w133)
        nu1_0 = g1_0 * n1_0 + g1_3 * n1_1 + g1_6 * n1_2
        nu1_1 = g1_1 * n1_0 + g1_4 * n1_1 + g1_7 * n1_2
        nu1_2 = g1_2 * n1_0 + g1_5 * n1_1 + g1_8 * n1_2
        w134 = Y_2 * nu1_1 - Y_1 * nu1_2
        w135 = Y_0 * nu1_2 - Y_2 * nu1_0
        w136 = Y_1 * nu1_0 - Y_0 * nu1_1
        L_2_0 = nu1_0 - w123 * w134 + (Y_2 * w135 - Y_1 * w136) * c3_3
        w137 = mu1 * Y_2 - mu2 * Y_1
        w138 = mu2 * Y_0 - mu0 * Y_2
        w139 = mu0 * Y_1 - mu1 * Y_0
        w140 = 0.5 * (mu0 - w123 * w137 + (Y_2 * w138 - Y_1 * w139) * c3_3)
        p1_0 = (
            d2_0 * w83 + w29 * P2_0 + d1_0 * w120 + w4 * (P1_0 + L_2_0 + L_3_0) + w140
        )
        d2_1 = n2_1 - w82 * c2_2 + (X2_2 * w79 - X2_0 * w81) * c3_2
        w141 = 0.5 * xi2_0 - 0.08333333333333333 * w50
        w142 = -0.08333333333333333 * xi2_0
        w143 = m2_1 * X2_2 - m2_2 * X2_1
        P2_1 = m2_2 * w141 - m2_0 * w84 + (w88 * w142 - w87 * w143)
        d1_1 = n1_1 - w119 * c2_1 + (X1_2 * w116 - X1_0 * w118) * c3_1
        L_3_1 = nu2_1 - w123 * w126 + (Y_0 * w127 - Y_2 * w124) * c3_3
        w144 = 0.5 * xi1_0 - 0.08333333333333333 * w26
        w145 = -0.08333333333333333 * xi1_0
        w146 = m1_1 * X1_2 - m1_2 * X1_1
        P1_1 = m1_2 * w144 - m1_0 * w128 + (w132 * w145 - w131 * w146)
        L_2_1 = nu1_1 - w123 * w135 + (Y_0 * w136 - Y_2 * w134) * c3_3
        w147 = 0.5 * (mu1 - w123 * w138 + (Y_0 * w139 - Y_2 * w137) * c3_3)
        p1_1 = (
            w29 * P2_1 + w83 * d2_1 + w120 * d1_1 + w4 * (P1_1 + L_2_1 + L_3_1) + w147
        )
        d2_2 = n2_2 - w81 * c2_2 + (X2_0 * w82 - X2_1 * w79) * c3_2
        P2_2 = m2_0 * w85 - m2_1 * w141 + (w89 * w143 - w86 * w142)
        d1_2 = n1_2 - w118 * c2_1 + (X1_0 * w119 - X1_1 * w116) * c3_1
        L_3_2 = nu2_2 - w123 * w127 + (Y_1 * w124 - Y_0 * w126) * c3_3
        P1_2 = m1_0 * w129 - m1_1 * w144 + (w133 * w146 - w130 * w145)
        L_2_2 = nu1_2 - w123 * w136 + (Y_1 * w134 - Y_0 * w135) * c3_3
        w148 = 0.5 * (mu2 - w123 * w139 + (Y_1 * w137 - Y_0 * w138) * c3_3)
        p1_2 = (
            w29 * P2_2 + w83 * d2_2 + w120 * d1_2 + w4 * (P1_2 + L_2_2 + L_3_2) + w148
        )
        p2_0 = (
            d2_0 * w120 + w4 * (P2_0 + L_2_0 + L_3_0) + d1_0 * w149 + w5 * P1_0 + w140
        )
        p2_1 = (
            w4 * (P2_1 + L_2_1 + L_3_1) + w120 * d2_1 + d1_1 * w149 + w5 * P1_1 + w147
        )
        p2_2 = (
            w4 * (P2_2 + L_2_2 + L_3_2) + w120 * d2_2 + d1_2 * w149 + w5 * P1_2 + w148
        )
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
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
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
    w150 = Y_1 * w123
    w151 = Y_1 * w150
    w152 = Y_2 * w123 * Y_2
    g_0 = 1.0 - (w151 + w152)
    w153 = Y_0 * w123
    w154 = Y_1 * w153
    c1_3 = _stumpff_1(w122)
    w156 = Y_2 * c1_3
    g_1 = w154 - w156
    w157 = Y_1 * c1_3
    w158 = Y_2 * w153
    g_2 = w157 + w158
    g_3 = w154 + w156
    w159 = Y_0 * w153
    g_4 = 1.0 - (w152 + w159)
    w160 = Y_2 * w150
    w161 = Y_0 * c1_3
    g_5 = w160 - w161
    g_6 = w158 - w157
    g_7 = w160 + w161
    g_8 = 1.0 - (w151 + w159)
    mubar_0 = mu0 + w121 * (nu2_0 + nu1_0)
    mubar_1 = mu1 + w121 * (nu2_1 + nu1_1)
    mubar_2 = mu2 + w121 * (nu2_2 + nu1_2)
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
