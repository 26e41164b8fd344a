"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4

method:     family vcf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section
            2.2.1
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   1 Adt, 23 Adtinv, 5 mul (zeros)
            16 Adtinv, 31 dexpt, 1 exp, 4 identity, 2 lin (sharing)
            1 identity (dead code)
            1 dexpt (factors)
            4 Adtinv, 8 dexpt (common sums)
            1 lin (cancellation)
            1 lin (sharing)
            5 hamilton (body frame)
            3 Adt (opposites)
            7 Adtinv, 1 force (dead code)
            1 lin (sharing)
            5 dexpt (functions)
            3 Adinv, 4 legendre (sharing)
            parameters, folded: beta = 1
            the time: the scene does not depend on it
operations: 75 add, 120 mul, 2 sqrt, 2 div, 1 stumpff_12 a step
            324 add, 477 mul, 6 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of
            the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
made by:    orderconds emit dipole --method vcf:cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcf_cf4

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcf_cf4.run(state, 0.005, 100))
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
        "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4",
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
    m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2
    Wxi0_0 = 0.9900990099009901 * m_0
    m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2
    m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2
    Wxi0_2 = 100.0 * m_2
    w1 = -0.5 * h
    w2 = 0.5 * h
    w60 = 0.16666666666666666 * h
    w61 = -3.0 * g22
    w62 = 3.26 + w61
    w63 = -0.3 * g21
    w64 = w62 + w63
    w65 = sqrt(w64)
    w66 = 1.0 / w65
    w67 = w66 * w66
    w68 = 0.5 * w66
    w69 = w67 * w68
    w70 = 0.3 * g21
    w71 = w62 + w70
    w72 = sqrt(w71)
    w73 = 1.0 / w72
    w74 = w73 * w73
    w75 = 0.5 * w73
    w76 = w74 * w75
    w77 = w69 - w76
    w78 = -3.0 * w77
    w79 = w78 - 1.0
    w80 = g21 * w79
    w81 = -0.3 * w69
    w82 = -0.3 * w76
    w83 = w81 + w82
    w84 = g22 * w83
    w85 = w80 - w84
    w107 = 0.3333333333333333 * h
    w108 = -0.25 * h
    w110 = -0.16666666666666666 * h
    w112 = 0.08333333333333333 * h
    w119 = g20 * w83
    w120 = g20 * w79
    w126 = 0.25 * h
    w128 = -0.08333333333333333 * h
    # the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2
    xi1_0 = Wxi0_0
    xi1_1 = m_1
    xi1_2 = Wxi0_2
    xi2_0 = Wxi0_0
    xi2_1 = m_1
    xi2_2 = Wxi0_2
    xi3_0 = Wxi0_0
    xi3_1 = m_1
    xi3_2 = Wxi0_2
    xi4_0 = Wxi0_0
    xi4_1 = m_1
    xi4_2 = Wxi0_2
    previous_1 = 0.0
    for sweep in range(1, 101):
        xE2_1_1 = xi1_1 * w2
        xE2_1_0 = xi1_0 * w2
        xE2_1_2 = xi1_2 * w2
        w3 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2
        c1_1, c2_1 = _stumpff_12(w3)
        w5 = xE2_1_1 * c1_1
        w7 = xE2_1_0 * c2_1
        w8 = xE2_1_2 * w7
        gE2_1_2 = w5 + w8
        yE2_1_1 = xi1_1 * w1
        w9 = h * xi3_1
        xE4_2_1 = yE2_1_1 + w9
        yE2_1_0 = xi1_0 * w1
        w10 = h * xi3_0
        xE4_2_0 = yE2_1_0 + w10
        yE2_1_2 = xi1_2 * w1
        w11 = h * xi3_2
        xE4_2_2 = yE2_1_2 + w11
        w12 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2
        c1_2, c2_2 = _stumpff_12(w12)
        w14 = xE4_2_1 * c2_2
        w15 = xE4_2_1 * w14
        w16 = xE4_2_2 * c2_2 * xE4_2_2
        gE4_2_0 = 1.0 - (w15 + w16)
        w17 = xE2_1_1 * c2_1
        w18 = xE2_1_2 * w17
        w19 = xE2_1_0 * c1_1
        gE2_1_5 = w18 - w19
        w20 = xE4_2_0 * c2_2
        w21 = xE4_2_1 * w20
        w23 = xE4_2_2 * c1_2
        gE4_2_1 = w21 - w23
        w24 = xE2_1_0 * w7
        w25 = xE2_1_1 * w17
        gE2_1_8 = 1.0 - (w24 + w25)
        w26 = xE4_2_1 * c1_2
        w27 = xE4_2_2 * w20
        gE4_2_2 = w26 + w27
        E4_2_2 = gE2_1_2 * gE4_2_0 + gE2_1_5 * gE4_2_1 + gE2_1_8 * gE4_2_2
        gE4_2_3 = w21 + w23
        w28 = xE4_2_0 * w20
        gE4_2_4 = 1.0 - (w16 + w28)
        w29 = xE4_2_2 * w14
        w30 = xE4_2_0 * c1_2
        gE4_2_5 = w29 - w30
        E4_2_5 = gE2_1_2 * gE4_2_3 + gE2_1_5 * gE4_2_4 + gE2_1_8 * gE4_2_5
        gE4_2_6 = w27 - w26
        gE4_2_7 = w29 + w30
        gE4_2_8 = 1.0 - (w15 + w28)
        E4_2_8 = gE2_1_2 * gE4_2_6 + gE2_1_5 * gE4_2_7 + gE2_1_8 * gE4_2_8
        p_4_2 = 0.01 * (xi4_0 * E4_2_2 + xi4_1 * E4_2_5 + xi4_2 * E4_2_8)
        w31 = xE2_1_1 * w7
        w32 = xE2_1_2 * c1_1
        gE2_1_1 = w31 - w32
        w33 = xE2_1_2 * c2_1 * xE2_1_2
        gE2_1_4 = 1.0 - (w24 + w33)
        gE2_1_7 = w18 + w19
        E4_2_1 = gE4_2_0 * gE2_1_1 + gE4_2_1 * gE2_1_4 + gE4_2_2 * gE2_1_7
        E4_2_4 = gE4_2_3 * gE2_1_1 + gE4_2_4 * gE2_1_4 + gE4_2_5 * gE2_1_7
        E4_2_7 = gE4_2_6 * gE2_1_1 + gE4_2_7 * gE2_1_4 + gE4_2_8 * gE2_1_7
        a_5_1 = xi4_0 * E4_2_1 + xi4_1 * E4_2_4 + xi4_2 * E4_2_7
        Q4_7 = g20 * E4_2_1 + g21 * E4_2_4 + g22 * E4_2_7
        Q4_8 = g20 * E4_2_2 + g21 * E4_2_5 + g22 * E4_2_8
        w34 = 3.26 - 3.0 * Q4_8
        w35 = 1.0 / sqrt(w34 - 0.3 * Q4_7)
        w36 = w35 * w35 * (0.5 * w35)
        w37 = 1.0 / sqrt(w34 + 0.3 * Q4_7)
        w38 = w37 * w37 * (0.5 * w37)
        w39 = -1.0 - 3.0 * (w36 - w38)
        w40 = -0.3 * w36 - 0.3 * w38
        Nr4_0 = Q4_7 * w39 - Q4_8 * w40 + 99.0 * a_5_1 * p_4_2
        p_2_2 = 0.01 * (xi2_0 * gE2_1_2 + xi2_1 * gE2_1_5 + xi2_2 * gE2_1_8)
        a_1 = xi2_0 * gE2_1_1 + xi2_1 * gE2_1_4 + xi2_2 * gE2_1_7
        Q2_7 = g20 * gE2_1_1 + g21 * gE2_1_4 + g22 * gE2_1_7
        Q2_8 = g20 * gE2_1_2 + g21 * gE2_1_5 + g22 * gE2_1_8
        w41 = 3.26 - 3.0 * Q2_8
        w42 = 1.0 / sqrt(w41 - 0.3 * Q2_7)
        w43 = w42 * w42 * (0.5 * w42)
        w44 = 1.0 / sqrt(w41 + 0.3 * Q2_7)
        w45 = w44 * w44 * (0.5 * w44)
        w46 = -1.0 - 3.0 * (w43 - w45)
        w47 = -0.3 * w43 - 0.3 * w45
        Nr2_0 = Q2_7 * w46 - Q2_8 * w47 + 99.0 * a_1 * p_2_2
        s_nu2_0 = w1 * Nr4_0 - h * Nr2_0
        w48 = yE2_1_0 * yE2_1_0 + yE2_1_1 * yE2_1_1 + yE2_1_2 * yE2_1_2
        c2_3, c3_1 = _stumpff_23(w48)
        gE2_1_0 = 1.0 - (w25 + w33)
        gE2_1_3 = w31 + w32
        gE2_1_6 = w8 - w5
        E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6
        E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6
        E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6
        a_5_0 = xi4_0 * E4_2_0 + xi4_1 * E4_2_3 + xi4_2 * E4_2_6
        Q4_6 = g20 * E4_2_0 + g21 * E4_2_3 + g22 * E4_2_6
        Nr4_2 = 0.01 * a_5_0 * a_5_1 + w40 * Q4_6
        a_0 = xi2_0 * gE2_1_0 + xi2_1 * gE2_1_3 + xi2_2 * gE2_1_6
        Q2_6 = g20 * gE2_1_0 + g21 * gE2_1_3 + g22 * gE2_1_6
        Nr2_2 = 0.01 * a_0 * a_1 + w47 * Q2_6
        s_nu2_2 = w1 * Nr4_2 - h * Nr2_2
        Nr4_1 = -100.0 * a_5_0 * p_4_2 - w39 * Q4_6
        Nr2_1 = -100.0 * a_0 * p_2_2 - w46 * Q2_6
        s_nu2_1 = w1 * Nr4_1 - h * Nr2_1
        w50 = yE2_1_1 * s_nu2_2 - yE2_1_2 * s_nu2_1
        w52 = yE2_1_0 * s_nu2_1 - yE2_1_1 * s_nu2_0
        w53 = yE2_1_2 * s_nu2_0 - yE2_1_0 * s_nu2_2
        m1_13_0 = gE2_1_1 * Nr4_1 + Nr4_0 * gE2_1_0 + gE2_1_2 * Nr4_2
        yE4_2_0 = xE2_1_0 - w10
        yE4_2_1 = xE2_1_1 - w9
        yE4_2_2 = xE2_1_2 - w11
        w54 = yE4_2_0 * yE4_2_0 + yE4_2_1 * yE4_2_1 + yE4_2_2 * yE4_2_2
        c2_4, c3_2 = _stumpff_23(w54)
        m1_13_2 = gE2_1_7 * Nr4_1 + Nr4_0 * gE2_1_6 + gE2_1_8 * Nr4_2
        m1_13_1 = gE2_1_4 * Nr4_1 + Nr4_0 * gE2_1_3 + gE2_1_5 * Nr4_2
        w56 = yE4_2_1 * m1_13_2 - yE4_2_2 * m1_13_1
        w58 = yE4_2_0 * m1_13_1 - m1_13_0 * yE4_2_1
        w59 = m1_13_0 * yE4_2_2 - yE4_2_0 * m1_13_2
        p1_13_0 = m1_13_0 - w56 * c2_4 + (yE4_2_1 * w58 - yE4_2_2 * w59) * c3_2
        p_2 = 0.01 * xi1_2
        xE3_1_1 = xi2_1 * w2
        xE3_1_0 = xi2_0 * w2
        xE3_1_2 = xi2_2 * w2
        w86 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2
        c1_3, c2_5 = _stumpff_12(w86)
        w88 = xE3_1_1 * c1_3
        w90 = xE3_1_0 * c2_5
        w91 = xE3_1_2 * w90
        gE3_1_2 = w88 + w91
        w92 = xE3_1_1 * c2_5
        w93 = xE3_1_2 * w92
        w94 = xE3_1_0 * c1_3
        gE3_1_5 = w93 - w94
        w95 = xE3_1_0 * w90
        w96 = xE3_1_1 * w92
        gE3_1_8 = 1.0 - (w95 + w96)
        p_3_2 = 0.01 * (xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8)
        w97 = xE3_1_1 * w90
        w98 = xE3_1_2 * c1_3
        gE3_1_1 = w97 - w98
        w99 = xE3_1_2 * c2_5 * xE3_1_2
        gE3_1_4 = 1.0 - (w95 + w99)
        gE3_1_7 = w93 + w94
        a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7
        Q3_7 = g20 * gE3_1_1 + g21 * gE3_1_4 + g22 * gE3_1_7
        Q3_8 = g20 * gE3_1_2 + g21 * gE3_1_5 + g22 * gE3_1_8
        w100 = 3.26 - 3.0 * Q3_8
        w101 = 1.0 / sqrt(w100 - 0.3 * Q3_7)
        w102 = w101 * w101 * (0.5 * w101)
        w103 = 1.0 / sqrt(w100 + 0.3 * Q3_7)
        w104 = w103 * w103 * (0.5 * w103)
        w105 = -1.0 - 3.0 * (w102 - w104)
        w106 = -0.3 * w102 - 0.3 * w104
        Nr3_0 = Q3_7 * w105 - Q3_8 * w106 + 99.0 * a_3_1 * p_3_2
        s_p1_0 = m_0 + w60 * (w85 + 99.0 * xi1_1 * p_2 + Nr4_0) + (Nr2_0 + Nr3_0) * w107
        w109 = xi2_0 + xi3_0
        w111 = w109 * w110
        ye1_0 = xi1_0 * w108 + w111 + xi4_0 * w112
        w113 = xi2_1 + xi3_1
        w114 = w110 * w113
        ye1_1 = xi1_1 * w108 + w114 + xi4_1 * w112
        w115 = xi2_2 + xi3_2
        w116 = w110 * w115
        ye1_2 = xi1_2 * w108 + w116 + xi4_2 * w112
        w117 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2
        c2_6, c3_3 = _stumpff_23(w117)
        gE3_1_0 = 1.0 - (w96 + w99)
        gE3_1_3 = w97 + w98
        gE3_1_6 = w91 - w88
        a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6
        Q3_6 = g20 * gE3_1_0 + g21 * gE3_1_3 + g22 * gE3_1_6
        Nr3_2 = 0.01 * a_3_0 * a_3_1 + w106 * Q3_6
        s_p1_2 = (
            m_2 + w60 * (0.01 * xi1_0 * xi1_1 + w119 + Nr4_2) + w107 * (Nr2_2 + Nr3_2)
        )
        Nr3_1 = -100.0 * a_3_0 * p_3_2 - w105 * Q3_6
        s_p1_1 = (
            m_1 + w60 * (-100.0 * xi1_0 * p_2 - w120 + Nr4_1) + w107 * (Nr2_1 + Nr3_1)
        )
        w121 = ye1_1 * s_p1_2 - ye1_2 * s_p1_1
        w123 = ye1_0 * s_p1_1 - s_p1_0 * ye1_1
        w124 = s_p1_0 * ye1_2 - ye1_0 * s_p1_2
        p1_11_0 = s_p1_0 - w121 * c2_6 + (ye1_1 * w123 - ye1_2 * w124) * c3_3
        w125 = (
            s_nu2_0
            - w50 * c2_3
            + (yE2_1_1 * w52 - yE2_1_2 * w53) * c3_1
            + w2 * p1_13_0
            + 1.5 * p1_11_0
        )
        w127 = w60 * w113
        xe1_1 = xi1_1 * w126 + w127 + xi4_1 * w128
        w129 = w60 * w109
        xe1_0 = xi1_0 * w126 + w129 + xi4_0 * w128
        w130 = w60 * w115
        xe1_2 = xi1_2 * w126 + w130 + xi4_2 * w128
        w131 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_4, c2_7 = _stumpff_12(w131)
        w133 = xe1_1 * c2_7
        w134 = xe1_1 * w133
        w135 = xe1_2 * c2_7 * xe1_2
        ge1_0 = 1.0 - (w134 + w135)
        w136 = xe1_0 * c2_7
        w137 = xe1_1 * w136
        w139 = xe1_2 * c1_4
        ge1_1 = w137 - w139
        w140 = xe1_1 * c1_4
        w141 = xe1_2 * w136
        ge1_2 = w140 + w141
        m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2
        ye2_0 = w111 + xi1_0 * w112 + xi4_0 * w108
        ye2_1 = w114 + xi1_1 * w112 + xi4_1 * w108
        ye2_2 = w116 + xi1_2 * w112 + xi4_2 * w108
        w142 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
        c2_8, c3_4 = _stumpff_23(w142)
        ge1_6 = w141 - w140
        w144 = xe1_0 * c1_4
        w145 = xe1_2 * w133
        ge1_7 = w144 + w145
        w146 = xe1_0 * w136
        ge1_8 = 1.0 - (w134 + w146)
        m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8
        ge1_3 = w137 + w139
        ge1_4 = 1.0 - (w135 + w146)
        ge1_5 = w145 - w144
        m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5
        w147 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1
        w149 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1
        w150 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2
        p1_6_2_0 = m1_6_2_0 - w147 * c2_8 + (ye2_1 * w149 - ye2_2 * w150) * c3_4
        p1_13_1 = m1_13_1 - w59 * c2_4 + (yE4_2_2 * w56 - yE4_2_0 * w58) * c3_2
        p1_11_1 = s_p1_1 - w124 * c2_6 + (ye1_2 * w121 - ye1_0 * w123) * c3_3
        w151 = (
            s_nu2_1
            - w53 * c2_3
            + (yE2_1_2 * w50 - yE2_1_0 * w52) * c3_1
            + w2 * p1_13_1
            + 1.5 * p1_11_1
        )
        p1_6_2_1 = m1_6_2_1 - w150 * c2_8 + (ye2_2 * w147 - ye2_0 * w149) * c3_4
        p1_13_2 = m1_13_2 - w58 * c2_4 + (yE4_2_0 * w59 - yE4_2_1 * w56) * c3_2
        p1_11_2 = s_p1_2 - w123 * c2_6 + (ye1_0 * w124 - ye1_1 * w121) * c3_3
        w152 = (
            s_nu2_2
            - w52 * c2_3
            + (yE2_1_0 * w53 - yE2_1_1 * w50) * c3_1
            + w2 * p1_13_2
            + 1.5 * p1_11_2
        )
        p1_6_2_2 = m1_6_2_2 - w149 * c2_8 + (ye2_0 * w150 - ye2_1 * w147) * c3_4
        w153 = 0.5 * (p1_11_0 + p1_6_2_0)
        yE3_1_0 = xi2_0 * w1
        yE3_1_1 = xi2_1 * w1
        yE3_1_2 = xi2_2 * w1
        w154 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2
        c2_9, c3_5 = _stumpff_23(w154)
        w156 = Nr3_2 * yE3_1_1 - Nr3_1 * yE3_1_2
        w158 = Nr3_1 * yE3_1_0 - Nr3_0 * yE3_1_1
        w159 = Nr3_0 * yE3_1_2 - Nr3_2 * yE3_1_0
        M2_0 = (
            w153 + w1 * (Nr3_0 - w156 * c2_9 + (yE3_1_1 * w158 - yE3_1_2 * w159) * c3_5)
        )
        w160 = 0.5 * (p1_11_1 + p1_6_2_1)
        M2_1 = (
            w160 + w1 * (Nr3_1 - w159 * c2_9 + (yE3_1_2 * w156 - yE3_1_0 * w158) * c3_5)
        )
        w161 = 0.5 * (p1_11_2 + p1_6_2_2)
        M2_2 = (
            w161 + w1 * (Nr3_2 - w158 * c2_9 + (yE3_1_0 * w159 - yE3_1_1 * w156) * c3_5)
        )
        Wf2_0 = 0.9900990099009901 * (gE2_1_0 * M2_0 + gE2_1_3 * M2_1 + gE2_1_6 * M2_2)
        Pf2_1 = gE2_1_1 * M2_0 + gE2_1_4 * M2_1 + gE2_1_7 * M2_2
        Wf2_2 = 100.0 * (gE2_1_2 * M2_0 + gE2_1_5 * M2_1 + gE2_1_8 * M2_2)
        M3_0 = w153 + w1 * p1_13_0
        M3_1 = w160 + w1 * p1_13_1
        M3_2 = w161 + w1 * p1_13_2
        Wf3_0 = 0.9900990099009901 * (gE3_1_0 * M3_0 + gE3_1_3 * M3_1 + gE3_1_6 * M3_2)
        Pf3_1 = gE3_1_1 * M3_0 + gE3_1_4 * M3_1 + gE3_1_7 * M3_2
        Wf3_2 = 100.0 * (gE3_1_2 * M3_0 + gE3_1_5 * M3_1 + gE3_1_8 * M3_2)
        M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0
        M4_1 = 1.5 * p1_6_2_1 - 0.5 * p1_11_1
        M4_2 = 1.5 * p1_6_2_2 - 0.5 * p1_11_2
        Wf4_0 = 0.9900990099009901 * (E4_2_0 * M4_0 + E4_2_3 * M4_1 + E4_2_6 * M4_2)
        Pf4_1 = E4_2_1 * M4_0 + E4_2_4 * M4_1 + E4_2_7 * M4_2
        Wf4_2 = 100.0 * (E4_2_2 * M4_0 + E4_2_5 * M4_1 + E4_2_8 * M4_2)
        next_xi1_0 = 0.9900990099009901 * (w125 - 0.5 * p1_6_2_0)
        next_xi1_1 = w151 - 0.5 * p1_6_2_1
        next_xi1_2 = 100.0 * (w152 - 0.5 * p1_6_2_2)
        next_xi2_0 = gE2_1_0 * Wf2_0 + gE2_1_1 * Pf2_1 + gE2_1_2 * Wf2_2
        next_xi2_1 = gE2_1_3 * Wf2_0 + gE2_1_4 * Pf2_1 + gE2_1_5 * Wf2_2
        next_xi2_2 = gE2_1_6 * Wf2_0 + gE2_1_7 * Pf2_1 + gE2_1_8 * Wf2_2
        next_xi3_0 = gE3_1_0 * Wf3_0 + gE3_1_1 * Pf3_1 + gE3_1_2 * Wf3_2
        next_xi3_1 = gE3_1_3 * Wf3_0 + gE3_1_4 * Pf3_1 + gE3_1_5 * Wf3_2
        next_xi3_2 = gE3_1_6 * Wf3_0 + gE3_1_7 * Pf3_1 + gE3_1_8 * Wf3_2
        next_xi4_0 = E4_2_0 * Wf4_0 + E4_2_1 * Pf4_1 + E4_2_2 * Wf4_2
        next_xi4_1 = E4_2_3 * Wf4_0 + E4_2_4 * Pf4_1 + E4_2_5 * Wf4_2
        next_xi4_2 = E4_2_6 * Wf4_0 + E4_2_7 * Pf4_1 + E4_2_8 * Wf4_2
        change_xi1_0 = abs(next_xi1_0 - xi1_0)
        change_xi1_1 = abs(next_xi1_1 - xi1_1)
        change_xi1_2 = abs(next_xi1_2 - xi1_2)
        change_xi2_0 = abs(next_xi2_0 - xi2_0)
        change_xi2_1 = abs(next_xi2_1 - xi2_1)
        change_xi2_2 = abs(next_xi2_2 - xi2_2)
        change_xi3_0 = abs(next_xi3_0 - xi3_0)
        change_xi3_1 = abs(next_xi3_1 - xi3_1)
        change_xi3_2 = abs(next_xi3_2 - xi3_2)
        change_xi4_0 = abs(next_xi4_0 - xi4_0)
        change_xi4_1 = abs(next_xi4_1 - xi4_1)
        change_xi4_2 = abs(next_xi4_2 - xi4_2)
        change = max(
            change_xi1_0,
            change_xi1_1,
            change_xi1_2,
            change_xi2_0,
            change_xi2_1,
            change_xi2_2,
            change_xi3_0,
            change_xi3_1,
            change_xi3_2,
            change_xi4_0,
            change_xi4_1,
            change_xi4_2,
        )
        scale = max(
            1.0,
            abs(xi1_0),
            abs(xi1_1),
            abs(xi1_2),
            abs(xi2_0),
            abs(xi2_1),
            abs(xi2_2),
            abs(xi3_0),
            abs(xi3_1),
            abs(xi3_2),
            abs(xi4_0),
            abs(xi4_1),
            abs(xi4_2),
        )
        total = (
            change_xi1_0
            + change_xi1_1
            + change_xi1_2
            + change_xi2_0
            + change_xi2_1
            + change_xi2_2
            + change_xi3_0
            + change_xi3_1
            + change_xi3_2
            + change_xi4_0
            + change_xi4_1
            + change_xi4_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_1 = change
        xi1_0 = next_xi1_0
        xi1_1 = next_xi1_1
        xi1_2 = next_xi1_2
        xi2_0 = next_xi2_0
        xi2_1 = next_xi2_1
        xi2_2 = next_xi2_2
        xi3_0 = next_xi3_0
        xi3_1 = next_xi3_1
        xi3_2 = next_xi3_2
        xi4_0 = next_xi4_0
        xi4_1 = next_xi4_1
        xi4_2 = next_xi4_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    xe2_1 = w127 + xi1_1 * w128 + xi4_1 * w126
    xe2_0 = w129 + xi1_0 * w128 + xi4_0 * w126
    xe2_2 = w130 + xi1_2 * w128 + xi4_2 * w126
    w162 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2
    c1_5, c2_10 = _stumpff_12(w162)
    w164 = xe2_1 * c2_10
    w165 = xe2_1 * w164
    w166 = xe2_2 * c2_10 * xe2_2
    ge2_0 = 1.0 - (w165 + w166)
    w167 = xe2_0 * c2_10
    w168 = xe2_1 * w167
    w170 = xe2_2 * c1_5
    ge2_1 = w168 - w170
    w171 = xe2_1 * c1_5
    w172 = xe2_2 * w167
    ge2_2 = w171 + w172
    e2_0 = ge1_0 * ge2_0 + ge1_3 * ge2_1 + ge1_6 * ge2_2
    ge2_3 = w168 + w170
    w173 = xe2_0 * w167
    ge2_4 = 1.0 - (w166 + w173)
    w174 = xe2_2 * w164
    w175 = xe2_0 * c1_5
    ge2_5 = w174 - w175
    e2_3 = ge1_0 * ge2_3 + ge1_3 * ge2_4 + ge1_6 * ge2_5
    ge2_6 = w172 - w171
    ge2_7 = w174 + w175
    ge2_8 = 1.0 - (w165 + w173)
    e2_6 = ge1_0 * ge2_6 + ge1_3 * ge2_7 + ge1_6 * ge2_8
    q1_0 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6
    e2_1 = ge1_1 * ge2_0 + ge1_4 * ge2_1 + ge1_7 * ge2_2
    e2_4 = ge1_1 * ge2_3 + ge1_4 * ge2_4 + ge1_7 * ge2_5
    e2_7 = ge1_1 * ge2_6 + ge1_4 * ge2_7 + ge1_7 * ge2_8
    q1_1 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7
    e2_2 = ge1_2 * ge2_0 + ge1_5 * ge2_1 + ge1_8 * ge2_2
    e2_5 = ge1_2 * ge2_3 + ge1_5 * ge2_4 + ge1_8 * ge2_5
    e2_8 = ge1_2 * ge2_6 + ge1_5 * ge2_7 + ge1_8 * ge2_8
    q1_2 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8
    q1_3 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6
    q1_4 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7
    q1_5 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8
    q1_6 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6
    q1_7 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7
    q1_8 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8
    new_mu0 = s_p1_0 * q1_0 + s_p1_1 * q1_1 + s_p1_2 * q1_2
    new_mu1 = s_p1_0 * q1_3 + s_p1_1 * q1_4 + s_p1_2 * q1_5
    new_mu2 = s_p1_0 * q1_6 + s_p1_1 * q1_7 + s_p1_2 * q1_8
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
