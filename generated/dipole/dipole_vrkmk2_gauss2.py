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
            2 dexpt (common sums)
            1 lin (sharing)
            3 hamilton (body frame)
            2 Adt (opposites)
            1 Adtinv, 1 force, 1 lin (dead code)
            2 Adinv, 2 Adt, 2 dexpinv, 2 dexpinvt, 3 dexpt (functions)
            2 legendre, 2 lin, 2 series, 2 seriest (sharing)
            2 Ad, 4 Adtinv, 2 seriest (factors)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 42 add, 66 mul, 1 stumpff_1 a step
            315 add, 480 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of
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


def _stumpff_123(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z), _stumpff_small_3(z)
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return ratio * cos(half), 0.5 * (ratio * ratio), c3


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
    m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2
    Wxi0_0 = 0.9900990099009901 * m_0
    m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2
    m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2
    Wxi0_2 = 100.0 * m_2
    w1 = 0.5 * h
    w2 = 0.5386751345948129 * h
    w3 = 0.25 * h
    w36 = -0.03867513459481288 * h
    w82 = -0.26933756729740643 * h
    w96 = -0.125 * h
    w122 = 0.01933756729740644 * h
    # the equations of v1, v2, m1, m2: fixed point in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2
    v1_0 = Wxi0_0
    v1_1 = m_1
    v1_2 = Wxi0_2
    v2_0 = Wxi0_0
    v2_1 = m_1
    v2_2 = Wxi0_2
    previous_1 = 0.0
    for sweep in range(1, 101):
        X2_0 = v1_0 * w2 + v2_0 * w3
        X2_1 = v1_1 * w2 + v2_1 * w3
        w4 = v2_1 * X2_0 - v2_0 * X2_1
        X2_2 = v1_2 * w2 + v2_2 * w3
        w5 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2
        c1_1, c2_1, c3_1 = _stumpff_123(w5)
        w7 = 1.0 - 0.08333333333333333 * w5
        w8 = 1.0 / (w7 * w7 + 0.25 * w5)
        w9 = w8 * (0.25 - 0.08333333333333333 * w7)
        w11 = -0.5 * w8
        w12 = w5 * (w9 * c1_1 + w11 * c2_1) - (w11 + c1_1)
        w13 = v2_0 * X2_2 - v2_2 * X2_0
        w14 = v2_2 * X2_1 - v2_1 * X2_2
        w15 = X2_0 * w13 - X2_1 * w14
        w16 = w9 + c2_1 + w11 * c1_1 - w9 * c2_1 * w5
        p_2_2 = 0.01 * (v2_2 + w4 * w12 + w15 * w16)
        w17 = X2_2 * w14 - X2_0 * w4
        a_6_1 = v2_1 + w12 * w13 + w16 * w17
        w18 = X2_0 * c2_1
        w19 = X2_1 * w18
        w20 = X2_2 * c1_1
        w21 = X2_0 * w18
        w22 = X2_2 * c2_1 * X2_2
        w23 = X2_0 * c1_1
        w24 = X2_1 * c2_1
        w25 = X2_2 * w24
        Q2_7 = g20 * (w19 - w20) + g21 * (1.0 - (w21 + w22)) + g22 * (w23 + w25)
        w26 = X2_1 * c1_1
        w27 = X2_2 * w18
        w28 = X2_1 * w24
        Q2_8 = g20 * (w26 + w27) + g21 * (w25 - w23) + g22 * (1.0 - (w21 + w28))
        w29 = 1.5 - 2.0 * Q2_8
        w30 = 1.0 / sqrt(1.01 + 1.5 * (w29 - 0.2 * Q2_7))
        w31 = w30 * w30 * (0.5 * w30)
        w32 = 1.0 / sqrt(1.01 + 1.5 * (w29 + 0.2 * Q2_7))
        w33 = w32 * w32 * (0.5 * w32)
        w34 = -1.0 - 2.0 * (1.5 * w31 - 1.5 * w33)
        w35 = -0.3 * w31 - 0.3 * w33
        Nn2_0 = Q2_7 * w34 - Q2_8 * w35 + 99.0 * a_6_1 * p_2_2
        X1_0 = v1_0 * w3 + v2_0 * w36
        X1_1 = v1_1 * w3 + v2_1 * w36
        w37 = v1_1 * X1_0 - v1_0 * X1_1
        X1_2 = v1_2 * w3 + v2_2 * w36
        w38 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
        c1_2, c2_2, c3_2 = _stumpff_123(w38)
        w40 = 1.0 - 0.08333333333333333 * w38
        w41 = 1.0 / (w40 * w40 + 0.25 * w38)
        w42 = w41 * (0.25 - 0.08333333333333333 * w40)
        w44 = -0.5 * w41
        w45 = w38 * (w42 * c1_2 + w44 * c2_2) - (w44 + c1_2)
        w46 = v1_0 * X1_2 - v1_2 * X1_0
        w47 = v1_2 * X1_1 - v1_1 * X1_2
        w48 = X1_0 * w46 - X1_1 * w47
        w49 = w42 + c2_2 + w44 * c1_2 - w42 * c2_2 * w38
        p_2 = 0.01 * (v1_2 + w37 * w45 + w48 * w49)
        w50 = X1_2 * w47 - X1_0 * w37
        a_2_1 = v1_1 + w45 * w46 + w49 * w50
        w51 = X1_0 * c2_2
        w52 = X1_1 * w51
        w53 = X1_2 * c1_2
        w54 = X1_0 * w51
        w55 = X1_2 * c2_2 * X1_2
        w56 = X1_0 * c1_2
        w57 = X1_1 * c2_2
        w58 = X1_2 * w57
        Q1_7 = g20 * (w52 - w53) + g21 * (1.0 - (w54 + w55)) + g22 * (w56 + w58)
        w59 = X1_1 * c1_2
        w60 = X1_2 * w51
        w61 = X1_1 * w57
        Q1_8 = g20 * (w59 + w60) + g21 * (w58 - w56) + g22 * (1.0 - (w54 + w61))
        w62 = 1.5 - 2.0 * Q1_8
        w63 = 1.0 / sqrt(1.01 + 1.5 * (w62 - 0.2 * Q1_7))
        w64 = w63 * w63 * (0.5 * w63)
        w65 = 1.0 / sqrt(1.01 + 1.5 * (w62 + 0.2 * Q1_7))
        w66 = w65 * w65 * (0.5 * w65)
        w67 = -1.0 - 2.0 * (1.5 * w64 - 1.5 * w66)
        w68 = -0.3 * w64 - 0.3 * w66
        Nn1_0 = Q1_7 * w67 - Q1_8 * w68 + 99.0 * a_2_1 * p_2
        s_L_0 = m_0 + w1 * (Nn2_0 + Nn1_0)
        Y_0 = (v1_0 + v2_0) * w1
        Y_1 = (v1_1 + v2_1) * w1
        Y_2 = (v1_2 + v2_2) * w1
        w69 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
        c2_3, c3_3 = _stumpff_23(w69)
        w70 = c2_3
        w71 = X2_1 * w4 - X2_2 * w13
        a_6_0 = v2_0 + w12 * w14 + w16 * w71
        Q2_6 = g20 * (1.0 - (w22 + w28)) + g21 * (w19 + w20) + g22 * (w27 - w26)
        Nn2_1 = -100.0 * a_6_0 * p_2_2 - w34 * Q2_6
        w72 = X1_1 * w37 - X1_2 * w46
        a_2_0 = v1_0 + w45 * w47 + w49 * w72
        Q1_6 = g20 * (1.0 - (w55 + w61)) + g21 * (w52 + w53) + g22 * (w60 - w59)
        Nn1_1 = -100.0 * a_2_0 * p_2 - w67 * Q1_6
        s_L_1 = m_1 + w1 * (Nn2_1 + Nn1_1)
        Nn2_2 = 0.01 * a_6_0 * a_6_1 + w35 * Q2_6
        Nn1_2 = 0.01 * a_2_0 * a_2_1 + w68 * Q1_6
        s_L_2 = m_2 + w1 * (Nn2_2 + Nn1_2)
        w73 = Y_2 * s_L_1 - Y_1 * s_L_2
        w75 = Y_0 * s_L_2 - s_L_0 * Y_2
        w76 = s_L_0 * Y_1 - Y_0 * s_L_1
        w77 = 0.5 * (s_L_0 - w70 * w73 + (Y_2 * w75 - Y_1 * w76) * c3_3)
        w78 = X2_1 * Nn2_2 - X2_2 * Nn2_1
        w80 = X2_0 * Nn2_1 - X2_1 * Nn2_0
        w81 = X2_2 * Nn2_0 - X2_0 * Nn2_2
        d2_0 = Nn2_0 + w78 * c2_1 + (X2_1 * w80 - X2_2 * w81) * c3_1
        p_2_0 = 1.01 * a_6_0
        w83 = X2_2 * p_2_0 - X2_0 * p_2_2
        w84 = X2_1 * p_2_2 - X2_2 * a_6_1
        w85 = X2_0 * a_6_1 - X2_1 * p_2_0
        s_2_1 = 0.5 * (a_6_1 - w12 * w83 + w16 * (X2_2 * w84 - X2_0 * w85))
        a_5_2 = v2_2 - w4 * w11 + w9 * w15
        a_5_1 = v2_1 - w11 * w13 + w9 * w17
        a_5_0 = v2_0 - w11 * w14 + w9 * w71
        w86 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0)
        s_2_2 = 0.5 * (p_2_2 - w12 * w85 + w16 * (X2_0 * w83 - X2_1 * w84))
        w87 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2)
        s_2_0 = 0.5 * (p_2_0 - w12 * w84 + w16 * (X2_1 * w85 - X2_2 * w83))
        w88 = X2_0 * s_2_2 - X2_2 * s_2_0
        w89 = -0.08333333333333333 * a_5_2
        w90 = X2_1 * s_2_0 - X2_0 * s_2_1
        w91 = -0.08333333333333333 * a_5_1
        P2_0 = s_2_1 * w86 - s_2_2 * w87 + (w88 * w89 - w90 * w91)
        w92 = X1_1 * Nn1_2 - X1_2 * Nn1_1
        w94 = X1_0 * Nn1_1 - X1_1 * Nn1_0
        w95 = X1_2 * Nn1_0 - X1_0 * Nn1_2
        d1_0 = Nn1_0 + w92 * c2_2 + (X1_1 * w94 - X1_2 * w95) * c3_2
        p_0 = 1.01 * a_2_0
        w97 = X1_2 * p_0 - X1_0 * p_2
        w98 = X1_1 * p_2 - X1_2 * a_2_1
        w99 = X1_0 * a_2_1 - X1_1 * p_0
        s_1 = 0.5 * (a_2_1 - w45 * w97 + w49 * (X1_2 * w98 - X1_0 * w99))
        a_2 = v1_2 - w37 * w44 + w42 * w48
        a_1 = v1_1 - w44 * w46 + w42 * w50
        a_0 = v1_0 - w44 * w47 + w42 * w72
        w100 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0)
        s_2 = 0.5 * (p_2 - w45 * w99 + w49 * (X1_0 * w97 - X1_1 * w98))
        w101 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2)
        s_0 = 0.5 * (p_0 - w45 * w98 + w49 * (X1_1 * w99 - X1_2 * w97))
        w102 = X1_0 * s_2 - X1_2 * s_0
        w103 = -0.08333333333333333 * a_2
        w104 = X1_1 * s_0 - X1_0 * s_1
        w105 = -0.08333333333333333 * a_1
        P1_0 = s_1 * w100 - s_2 * w101 + (w102 * w103 - w104 * w105)
        w1_0 = 2.0 * (d2_0 * w82 + w2 * P2_0 + d1_0 * w96 + w3 * P1_0 + w77)
        w106 = c1_2 - 0.5 - w38 * (0.08333333333333333 * c1_2 - 0.5 * c2_2)
        w107 = 0.5 * (s_L_2 - w70 * w76 + (Y_1 * w73 - Y_0 * w75) * c3_3)
        d2_2 = Nn2_2 + w80 * c2_1 + (X2_0 * w81 - X2_1 * w78) * c3_1
        w108 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1)
        w109 = X2_2 * s_2_1 - X2_1 * s_2_2
        w110 = -0.08333333333333333 * a_5_0
        P2_2 = w87 * s_2_0 - s_2_1 * w108 + (w91 * w109 - w88 * w110)
        d1_2 = Nn1_2 + w94 * c2_2 + (X1_0 * w95 - X1_1 * w92) * c3_2
        w111 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1)
        w112 = X1_2 * s_1 - X1_1 * s_2
        w113 = -0.08333333333333333 * a_0
        P1_2 = w101 * s_0 - s_1 * w111 + (w105 * w112 - w102 * w113)
        w1_2 = 2.0 * (w2 * P2_2 + w82 * d2_2 + w96 * d1_2 + w3 * P1_2 + w107)
        w114 = 0.5 * (s_L_1 - w70 * w75 + (Y_0 * w76 - Y_2 * w73) * c3_3)
        d2_1 = Nn2_1 + w81 * c2_1 + (X2_2 * w78 - X2_0 * w80) * c3_1
        P2_1 = s_2_2 * w108 - w86 * s_2_0 + (w90 * w110 - w89 * w109)
        d1_1 = Nn1_1 + w95 * c2_2 + (X1_2 * w92 - X1_0 * w94) * c3_2
        P1_1 = s_2 * w111 - w100 * s_0 + (w104 * w113 - w103 * w112)
        w1_1 = 2.0 * (w2 * P2_1 + w82 * d2_1 + w96 * d1_1 + w3 * P1_1 + w114)
        w115 = X1_1 * w1_2 - X1_2 * w1_1
        w116 = (
            0.08333333333333333 + c2_2 - 0.5 * c1_2 - 0.08333333333333333 * c2_2 * w38
        )
        w117 = X1_0 * w1_1 - X1_1 * w1_0
        w118 = X1_2 * w1_0 - X1_0 * w1_2
        Wxi1_0 = (
            0.9900990099009901
            * (w1_0 - w106 * w115 + w116 * (X1_1 * w117 - X1_2 * w118))
        )
        Wxi1_2 = 100.0 * (w1_2 - w106 * w117 + w116 * (X1_0 * w118 - X1_1 * w115))
        Pxi1_1 = w1_1 - w106 * w118 + w116 * (X1_2 * w115 - X1_0 * w117)
        w119 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1
        w120 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0
        w121 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2
        w2_0 = 2.0 * (d2_0 * w96 + w3 * P2_0 + d1_0 * w122 + w36 * P1_0 + w77)
        w123 = c1_1 - 0.5 - w5 * (0.08333333333333333 * c1_1 - 0.5 * c2_1)
        w2_2 = 2.0 * (w3 * P2_2 + w96 * d2_2 + d1_2 * w122 + w36 * P1_2 + w107)
        w2_1 = 2.0 * (w3 * P2_1 + w96 * d2_1 + d1_1 * w122 + w36 * P1_1 + w114)
        w124 = X2_1 * w2_2 - X2_2 * w2_1
        w125 = 0.08333333333333333 + c2_1 - 0.5 * c1_1 - 0.08333333333333333 * c2_1 * w5
        w126 = X2_0 * w2_1 - X2_1 * w2_0
        w127 = X2_2 * w2_0 - X2_0 * w2_2
        Wxi2_0 = (
            0.9900990099009901
            * (w2_0 - w123 * w124 + w125 * (X2_1 * w126 - X2_2 * w127))
        )
        Wxi2_2 = 100.0 * (w2_2 - w123 * w126 + w125 * (X2_0 * w127 - X2_1 * w124))
        Pxi2_1 = w2_1 - w123 * w127 + w125 * (X2_2 * w124 - X2_0 * w126)
        w128 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1
        w129 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0
        w130 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2
        next_v1_0 = Wxi1_0 + w106 * w119 + w116 * (X1_1 * w120 - X1_2 * w121)
        next_v1_1 = Pxi1_1 + w106 * w121 + w116 * (X1_2 * w119 - X1_0 * w120)
        next_v1_2 = Wxi1_2 + w106 * w120 + w116 * (X1_0 * w121 - X1_1 * w119)
        next_v2_0 = Wxi2_0 + w123 * w128 + w125 * (X2_1 * w129 - X2_2 * w130)
        next_v2_1 = Pxi2_1 + w123 * w130 + w125 * (X2_2 * w128 - X2_0 * w129)
        next_v2_2 = Wxi2_2 + w123 * w129 + w125 * (X2_0 * w130 - X2_1 * w128)
        change_v1_0 = abs(next_v1_0 - v1_0)
        change_v1_1 = abs(next_v1_1 - v1_1)
        change_v1_2 = abs(next_v1_2 - v1_2)
        change_v2_0 = abs(next_v2_0 - v2_0)
        change_v2_1 = abs(next_v2_1 - v2_1)
        change_v2_2 = abs(next_v2_2 - v2_2)
        change = max(
            change_v1_0,
            change_v1_1,
            change_v1_2,
            change_v2_0,
            change_v2_1,
            change_v2_2,
        )
        scale = max(
            1.0,
            abs(v1_0),
            abs(v1_1),
            abs(v1_2),
            abs(v2_0),
            abs(v2_1),
            abs(v2_2),
        )
        total = (
            change_v1_0
            + change_v1_1
            + change_v1_2
            + change_v2_0
            + change_v2_1
            + change_v2_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_1 = change
        v1_0 = next_v1_0
        v1_1 = next_v1_1
        v1_2 = next_v1_2
        v2_0 = next_v2_0
        v2_1 = next_v2_1
        v2_2 = next_v2_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    w131 = Y_1 * w70
    w132 = Y_1 * w131
    w133 = Y_2 * w70 * Y_2
    g_0 = 1.0 - (w132 + w133)
    c1_3 = _stumpff_1(w69)
    w135 = Y_2 * c1_3
    w136 = Y_0 * w70
    w137 = Y_1 * w136
    g_3 = w135 + w137
    w138 = Y_2 * w136
    w139 = Y_1 * c1_3
    g_6 = w138 - w139
    q1_0 = g00 * g_0 + g01 * g_3 + g02 * g_6
    g_1 = w137 - w135
    w140 = Y_0 * w136
    g_4 = 1.0 - (w133 + w140)
    w141 = Y_0 * c1_3
    w142 = Y_2 * w131
    g_7 = w141 + w142
    q1_1 = g00 * g_1 + g01 * g_4 + g02 * g_7
    g_2 = w138 + w139
    g_5 = w142 - w141
    g_8 = 1.0 - (w132 + w140)
    q1_2 = g00 * g_2 + g01 * g_5 + g02 * g_8
    q1_3 = g10 * g_0 + g11 * g_3 + g12 * g_6
    q1_4 = g10 * g_1 + g11 * g_4 + g12 * g_7
    q1_5 = g10 * g_2 + g11 * g_5 + g12 * g_8
    q1_6 = g20 * g_0 + g21 * g_3 + g22 * g_6
    q1_7 = g20 * g_1 + g21 * g_4 + g22 * g_7
    q1_8 = g20 * g_2 + g21 * g_5 + g22 * g_8
    new_mu0 = s_L_0 * q1_0 + s_L_1 * q1_1 + s_L_2 * q1_2
    new_mu1 = s_L_0 * q1_3 + s_L_1 * q1_4 + s_L_2 * q1_5
    new_mu2 = s_L_0 * q1_6 + s_L_1 * q1_7 + s_L_2 * q1_8
    return (
        q1_0,
        q1_1,
        q1_2,
        q1_3,
        q1_4,
        q1_5,
        q1_6,
        q1_7,
        q1_8,
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
