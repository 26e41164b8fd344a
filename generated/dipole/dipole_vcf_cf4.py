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
            parameters, folded: beta = 1
            the time: the scene does not depend on it
operations: 153 add, 224 mul, 2 sqrt, 6 div, 1 stumpff_12 a step
            738 add, 1044 mul, 18 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of
            the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
made by:    orderconds emit dipole --method vcf:cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcf_cf4

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcf_cf4.run(state, 0.005, 100))
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
    xi0_0 = w15 + w2 * w16
    w17 = 0.5 * (g10 * w8 + g11 * w9 + g12 * w4) + g11 * w13 + w7 * w14
    xi0_1 = w17 + w3 * w16
    w18 = 0.5 * (g20 * w8 + g21 * w9 + g22 * w4) + g21 * w13 + w5 * w14
    xi0_2 = w18 + w1 * w16
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
    w32 = 0.1 * w31 - 0.1 * w25
    w33 = w32 + w9 * w11 + mu1 * w13
    w34 = w25 + w31
    w35 = w34 + w4 * w11 + 100.0 * (mu1 * w16)
    w36 = w8 * w12 + 0.9900990099009901 * (mu2 * w14)
    w37 = 2.0 * w20 * w24
    w38 = 2.0 * w26 * w30
    w39 = 0.1 * w38 - 0.1 * w37
    w40 = w39 + w9 * w12 + mu2 * w13
    w41 = w37 - 1.0 + w38
    w42 = w41 + w4 * w12 + 100.0 * (mu2 * w16)
    n0_0 = g20 * w19 + g21 * w33 + g22 * w35 - g10 * w36 - g11 * w40 - g12 * w42
    w43 = w8 * w10 + 0.9900990099009901 * (mu0 * w14)
    w44 = 2.0 * w21 * w24
    w45 = 2.0 * w27 * w30
    w46 = 0.1 * w45 - 0.1 * w44
    w47 = w46 + w9 * w10 + mu0 * w13
    w48 = w44 + w45
    w49 = w48 + w4 * w10 + 100.0 * (mu0 * w16)
    n0_1 = g00 * w36 - (g20 * w43 + g21 * w47 + g22 * w49) + g01 * w40 + g02 * w42
    n0_2 = g10 * w43 + g11 * w47 + g12 * w49 - g00 * w19 - g01 * w33 - g02 * w35
    w50 = -0.5 * h
    w51 = 0.5 * h
    w89 = -0.25 * h
    w91 = -0.16666666666666666 * h
    w93 = 0.08333333333333333 * h
    w104 = 0.25 * h
    w139 = 0.16666666666666666 * h
    w140 = -0.08333333333333333 * h
    # the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2, n1_0, n1_1, n1_2, n2_0, n2_1, n2_2, n3_0, n3_1, n3_2, n4_0, n4_1, n4_2
    xi1_0 = xi0_0
    xi1_1 = xi0_1
    xi1_2 = xi0_2
    xi2_0 = xi0_0
    xi2_1 = xi0_1
    xi2_2 = xi0_2
    xi3_0 = xi0_0
    xi3_1 = xi0_1
    xi3_2 = xi0_2
    xi4_0 = xi0_0
    xi4_1 = xi0_1
    xi4_2 = xi0_2
    n1_0 = n0_0
    n1_1 = n0_1
    n1_2 = n0_2
    n2_0 = n0_0
    n2_1 = n0_1
    n2_2 = n0_2
    n3_0 = n0_0
    n3_1 = n0_1
    n3_2 = n0_2
    n4_0 = n0_0
    n4_1 = n0_1
    n4_2 = n0_2
    previous_1 = inf
    for sweep in range(1, 101):
        xE2_1_1 = xi1_1 * w51
        xE2_1_0 = xi1_0 * w51
        xE2_1_2 = xi1_2 * w51
        w52 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2
        c1_1, c2_1 = _stumpff_12(w52)
        w54 = xE2_1_1 * c1_1
        w56 = xE2_1_0 * c2_1
        w57 = xE2_1_2 * w56
        gE2_1_2 = w54 + w57
        yE2_1_1 = xi1_1 * w50
        w58 = h * xi3_1
        xE4_2_1 = yE2_1_1 + w58
        yE2_1_0 = xi1_0 * w50
        w59 = h * xi3_0
        xE4_2_0 = yE2_1_0 + w59
        yE2_1_2 = xi1_2 * w50
        w60 = h * xi3_2
        xE4_2_2 = yE2_1_2 + w60
        w61 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2
        c1_2, c2_2 = _stumpff_12(w61)
        w63 = xE4_2_1 * c2_2
        w64 = xE4_2_1 * w63
        w65 = xE4_2_2 * c2_2 * xE4_2_2
        gE4_2_0 = 1.0 - (w64 + w65)
        w66 = xE2_1_1 * c2_1
        w67 = xE2_1_2 * w66
        w68 = xE2_1_0 * c1_1
        gE2_1_5 = w67 - w68
        w69 = xE4_2_0 * c2_2
        w70 = xE4_2_1 * w69
        w72 = xE4_2_2 * c1_2
        gE4_2_1 = w70 - w72
        w73 = xE2_1_0 * w56
        w74 = xE2_1_1 * w66
        gE2_1_8 = 1.0 - (w73 + w74)
        w75 = xE4_2_1 * c1_2
        w76 = xE4_2_2 * w69
        gE4_2_2 = w75 + w76
        E4_2_2 = gE2_1_2 * gE4_2_0 + gE2_1_5 * gE4_2_1 + gE2_1_8 * gE4_2_2
        gE4_2_3 = w70 + w72
        w77 = xE4_2_0 * w69
        gE4_2_4 = 1.0 - (w65 + w77)
        w78 = xE4_2_2 * w63
        w79 = xE4_2_0 * c1_2
        gE4_2_5 = w78 - w79
        E4_2_5 = gE2_1_2 * gE4_2_3 + gE2_1_5 * gE4_2_4 + gE2_1_8 * gE4_2_5
        gE4_2_6 = w76 - w75
        gE4_2_7 = w78 + w79
        gE4_2_8 = 1.0 - (w64 + w77)
        E4_2_8 = gE2_1_2 * gE4_2_6 + gE2_1_5 * gE4_2_7 + gE2_1_8 * gE4_2_8
        nu4_2 = n4_0 * E4_2_2 + n4_1 * E4_2_5 + n4_2 * E4_2_8
        nu2_2 = n2_0 * gE2_1_2 + n2_1 * gE2_1_5 + n2_2 * gE2_1_8
        s_nu2_2 = w50 * nu4_2 - h * nu2_2
        w80 = yE2_1_0 * yE2_1_0 + yE2_1_1 * yE2_1_1 + yE2_1_2 * yE2_1_2
        c2_3, c3_1 = _stumpff_23(w80)
        w82 = xE2_1_1 * w56
        w83 = xE2_1_2 * c1_1
        gE2_1_1 = w82 - w83
        w84 = xE2_1_2 * c2_1 * xE2_1_2
        gE2_1_4 = 1.0 - (w73 + w84)
        gE2_1_7 = w67 + w68
        E4_2_1 = gE4_2_0 * gE2_1_1 + gE4_2_1 * gE2_1_4 + gE4_2_2 * gE2_1_7
        E4_2_4 = gE4_2_3 * gE2_1_1 + gE4_2_4 * gE2_1_4 + gE4_2_5 * gE2_1_7
        E4_2_7 = gE4_2_6 * gE2_1_1 + gE4_2_7 * gE2_1_4 + gE4_2_8 * gE2_1_7
        nu4_1 = n4_0 * E4_2_1 + n4_1 * E4_2_4 + n4_2 * E4_2_7
        nu2_1 = n2_0 * gE2_1_1 + n2_1 * gE2_1_4 + n2_2 * gE2_1_7
        s_nu2_1 = w50 * nu4_1 - h * nu2_1
        gE2_1_0 = 1.0 - (w74 + w84)
        gE2_1_3 = w82 + w83
        gE2_1_6 = w57 - w54
        E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6
        E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6
        E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6
        nu4_0 = n4_0 * E4_2_0 + n4_1 * E4_2_3 + n4_2 * E4_2_6
        nu2_0 = n2_0 * gE2_1_0 + n2_1 * gE2_1_3 + n2_2 * gE2_1_6
        s_nu2_0 = w50 * nu4_0 - h * nu2_0
        w85 = yE2_1_0 * s_nu2_1 - yE2_1_1 * s_nu2_0
        w87 = yE2_1_2 * s_nu2_0 - yE2_1_0 * s_nu2_2
        w88 = yE2_1_1 * s_nu2_2 - yE2_1_2 * s_nu2_1
        w90 = xi2_0 + xi3_0
        w92 = w90 * w91
        ye1_0 = xi1_0 * w89 + w92 + xi4_0 * w93
        w94 = xi2_1 + xi3_1
        w95 = w91 * w94
        ye1_1 = xi1_1 * w89 + w95 + xi4_1 * w93
        w96 = xi2_2 + xi3_2
        w97 = w91 * w96
        ye1_2 = xi1_2 * w89 + w97 + xi4_2 * w93
        w98 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2
        c2_4, c3_2 = _stumpff_23(w98)
        w100 = mu1 * ye1_0 - mu0 * ye1_1
        w102 = mu0 * ye1_2 - mu2 * ye1_0
        w103 = mu2 * ye1_1 - mu1 * ye1_2
        p1_2 = mu2 - w100 * c2_4 + (ye1_0 * w102 - ye1_1 * w103) * c3_2
        w105 = n1_1 * ye1_0 - n1_0 * ye1_1
        w106 = n1_0 * ye1_2 - n1_2 * ye1_0
        w107 = n1_2 * ye1_1 - n1_1 * ye1_2
        w108 = nu4_1 * ye1_0 - nu4_0 * ye1_1
        w109 = nu4_0 * ye1_2 - nu4_2 * ye1_0
        w110 = nu4_2 * ye1_1 - nu4_1 * ye1_2
        w111 = (
            n1_2
            - w105 * c2_4
            + (ye1_0 * w106 - ye1_1 * w107) * c3_2
            + (nu4_2 - w108 * c2_4 + (ye1_0 * w109 - ye1_1 * w110) * c3_2)
        )
        m1_13_2 = gE2_1_6 * nu4_0 + gE2_1_7 * nu4_1 + gE2_1_8 * nu4_2
        yE4_2_0 = xE2_1_0 - w59
        yE4_2_1 = xE2_1_1 - w58
        yE4_2_2 = xE2_1_2 - w60
        w112 = yE4_2_0 * yE4_2_0 + yE4_2_1 * yE4_2_1 + yE4_2_2 * yE4_2_2
        c2_5, c3_3 = _stumpff_23(w112)
        m1_13_1 = gE2_1_3 * nu4_0 + gE2_1_4 * nu4_1 + gE2_1_5 * nu4_2
        m1_13_0 = gE2_1_0 * nu4_0 + gE2_1_1 * nu4_1 + gE2_1_2 * nu4_2
        w114 = yE4_2_0 * m1_13_1 - yE4_2_1 * m1_13_0
        w116 = yE4_2_2 * m1_13_0 - m1_13_2 * yE4_2_0
        w117 = m1_13_2 * yE4_2_1 - yE4_2_2 * m1_13_1
        p1_13_2 = m1_13_2 - w114 * c2_5 + (yE4_2_0 * w116 - yE4_2_1 * w117) * c3_3
        w118 = nu2_1 * ye1_0 - nu2_0 * ye1_1
        w119 = nu2_0 * ye1_2 - nu2_2 * ye1_0
        w120 = nu2_2 * ye1_1 - nu2_1 * ye1_2
        xE3_1_1 = xi2_1 * w51
        xE3_1_0 = xi2_0 * w51
        xE3_1_2 = xi2_2 * w51
        w121 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2
        c1_3, c2_6 = _stumpff_12(w121)
        w123 = xE3_1_1 * c1_3
        w125 = xE3_1_0 * c2_6
        w126 = xE3_1_2 * w125
        gE3_1_2 = w123 + w126
        w127 = xE3_1_1 * c2_6
        w128 = xE3_1_2 * w127
        w129 = xE3_1_0 * c1_3
        gE3_1_5 = w128 - w129
        w130 = xE3_1_0 * w125
        w131 = xE3_1_1 * w127
        gE3_1_8 = 1.0 - (w130 + w131)
        nu3_2 = n3_0 * gE3_1_2 + n3_1 * gE3_1_5 + n3_2 * gE3_1_8
        w132 = xE3_1_1 * w125
        w133 = xE3_1_2 * c1_3
        gE3_1_1 = w132 - w133
        w134 = xE3_1_2 * c2_6 * xE3_1_2
        gE3_1_4 = 1.0 - (w130 + w134)
        gE3_1_7 = w128 + w129
        nu3_1 = n3_0 * gE3_1_1 + n3_1 * gE3_1_4 + n3_2 * gE3_1_7
        gE3_1_0 = 1.0 - (w131 + w134)
        gE3_1_3 = w132 + w133
        gE3_1_6 = w126 - w123
        nu3_0 = n3_0 * gE3_1_0 + n3_1 * gE3_1_3 + n3_2 * gE3_1_6
        w135 = ye1_0 * nu3_1 - ye1_1 * nu3_0
        w136 = ye1_2 * nu3_0 - ye1_0 * nu3_2
        w137 = ye1_1 * nu3_2 - ye1_2 * nu3_1
        w138 = (
            nu2_2
            - w118 * c2_4
            + (ye1_0 * w119 - ye1_1 * w120) * c3_2
            + (nu3_2 - w135 * c2_4 + (ye1_0 * w136 - ye1_1 * w137) * c3_2)
        )
        xe1_2 = xi1_2 * w104 + w96 * w139 + xi4_2 * w140
        xe1_0 = xi1_0 * w104 + w90 * w139 + xi4_0 * w140
        xe1_1 = xi1_1 * w104 + w94 * w139 + xi4_1 * w140
        w141 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_4, c2_7 = _stumpff_12(w141)
        w143 = xe1_0 * c2_7
        w144 = xe1_2 * w143
        w146 = xe1_1 * c1_4
        ge1_6 = w144 - w146
        w147 = xe1_0 * c1_4
        w148 = xe1_1 * c2_7
        w149 = xe1_2 * w148
        ge1_7 = w147 + w149
        w150 = xe1_0 * w143
        w151 = xe1_1 * w148
        ge1_8 = 1.0 - (w150 + w151)
        m1_6_2 = mu0 * ge1_6 + mu1 * ge1_7 + mu2 * ge1_8
        ye2_0 = w92 + xi1_0 * w93 + xi4_0 * w89
        ye2_1 = w95 + xi1_1 * w93 + xi4_1 * w89
        ye2_2 = w97 + xi1_2 * w93 + xi4_2 * w89
        w152 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
        c2_8, c3_4 = _stumpff_23(w152)
        w154 = xe1_2 * c1_4
        w155 = xe1_1 * w143
        ge1_3 = w154 + w155
        w156 = xe1_2 * c2_7 * xe1_2
        ge1_4 = 1.0 - (w150 + w156)
        ge1_5 = w149 - w147
        m1_6_1 = mu0 * ge1_3 + mu1 * ge1_4 + mu2 * ge1_5
        ge1_0 = 1.0 - (w151 + w156)
        ge1_1 = w155 - w154
        ge1_2 = w144 + w146
        m1_6_0 = mu0 * ge1_0 + mu1 * ge1_1 + mu2 * ge1_2
        w157 = ye2_0 * m1_6_1 - ye2_1 * m1_6_0
        w159 = ye2_2 * m1_6_0 - m1_6_2 * ye2_0
        w160 = m1_6_2 * ye2_1 - ye2_2 * m1_6_1
        p1_6_2 = m1_6_2 - w157 * c2_8 + (ye2_0 * w159 - ye2_1 * w160) * c3_4
        m1_7_2 = n1_0 * ge1_6 + n1_1 * ge1_7 + n1_2 * ge1_8
        m1_7_1 = n1_0 * ge1_3 + n1_1 * ge1_4 + n1_2 * ge1_5
        m1_7_0 = n1_0 * ge1_0 + n1_1 * ge1_1 + n1_2 * ge1_2
        w161 = ye2_0 * m1_7_1 - ye2_1 * m1_7_0
        w162 = ye2_2 * m1_7_0 - ye2_0 * m1_7_2
        w163 = ye2_1 * m1_7_2 - ye2_2 * m1_7_1
        p1_7_2 = m1_7_2 - w161 * c2_8 + (ye2_0 * w162 - ye2_1 * w163) * c3_4
        m1_10_2 = nu4_0 * ge1_6 + nu4_1 * ge1_7 + nu4_2 * ge1_8
        m1_10_1 = nu4_0 * ge1_3 + nu4_1 * ge1_4 + nu4_2 * ge1_5
        m1_10_0 = nu4_0 * ge1_0 + nu4_1 * ge1_1 + nu4_2 * ge1_2
        w164 = ye2_0 * m1_10_1 - ye2_1 * m1_10_0
        w165 = ye2_2 * m1_10_0 - ye2_0 * m1_10_2
        w166 = ye2_1 * m1_10_2 - ye2_2 * m1_10_1
        p1_10_2 = m1_10_2 - w164 * c2_8 + (ye2_0 * w165 - ye2_1 * w166) * c3_4
        w167 = p1_7_2 + p1_10_2
        w168 = (
            1.5 * p1_2
            + w104 * w111
            + w51 * (p1_13_2 + w138)
            - 0.5 * p1_6_2
            + w140 * w167
        )
        m1_8_2 = nu2_0 * ge1_6 + nu2_1 * ge1_7 + nu2_2 * ge1_8
        m1_8_1 = nu2_0 * ge1_3 + nu2_1 * ge1_4 + nu2_2 * ge1_5
        m1_8_0 = nu2_0 * ge1_0 + nu2_1 * ge1_1 + nu2_2 * ge1_2
        w169 = ye2_0 * m1_8_1 - ye2_1 * m1_8_0
        w170 = ye2_2 * m1_8_0 - ye2_0 * m1_8_2
        w171 = ye2_1 * m1_8_2 - ye2_2 * m1_8_1
        p1_8_2 = m1_8_2 - w169 * c2_8 + (ye2_0 * w170 - ye2_1 * w171) * c3_4
        m1_9_2 = nu3_0 * ge1_6 + nu3_1 * ge1_7 + nu3_2 * ge1_8
        m1_9_1 = nu3_0 * ge1_3 + nu3_1 * ge1_4 + nu3_2 * ge1_5
        m1_9_0 = nu3_0 * ge1_0 + nu3_1 * ge1_1 + nu3_2 * ge1_2
        w172 = ye2_0 * m1_9_1 - ye2_1 * m1_9_0
        w173 = ye2_2 * m1_9_0 - ye2_0 * m1_9_2
        w174 = ye2_1 * m1_9_2 - ye2_2 * m1_9_1
        p1_9_2 = m1_9_2 - w172 * c2_8 + (ye2_0 * w173 - ye2_1 * w174) * c3_4
        w175 = p1_8_2 + p1_9_2
        M1_2 = (
            w168
            + w91 * w175
            + (s_nu2_2 - w85 * c2_3 + (yE2_1_0 * w87 - yE2_1_1 * w88) * c3_1)
        )
        p1_0 = mu0 - w103 * c2_4 + (ye1_1 * w100 - ye1_2 * w102) * c3_2
        w176 = (
            n1_0
            - w107 * c2_4
            + (ye1_1 * w105 - ye1_2 * w106) * c3_2
            + (nu4_0 - w110 * c2_4 + (ye1_1 * w108 - ye1_2 * w109) * c3_2)
        )
        p1_13_0 = m1_13_0 - w117 * c2_5 + (yE4_2_1 * w114 - yE4_2_2 * w116) * c3_3
        w177 = (
            nu2_0
            - w120 * c2_4
            + (ye1_1 * w118 - ye1_2 * w119) * c3_2
            + (nu3_0 - w137 * c2_4 + (ye1_1 * w135 - ye1_2 * w136) * c3_2)
        )
        p1_6_0 = m1_6_0 - w160 * c2_8 + (ye2_1 * w157 - ye2_2 * w159) * c3_4
        p1_7_0 = m1_7_0 - w163 * c2_8 + (ye2_1 * w161 - ye2_2 * w162) * c3_4
        p1_10_0 = m1_10_0 - w166 * c2_8 + (ye2_1 * w164 - ye2_2 * w165) * c3_4
        w178 = p1_7_0 + p1_10_0
        w179 = (
            1.5 * p1_0
            + w104 * w176
            + w51 * (p1_13_0 + w177)
            - 0.5 * p1_6_0
            + w140 * w178
        )
        p1_8_0 = m1_8_0 - w171 * c2_8 + (ye2_1 * w169 - ye2_2 * w170) * c3_4
        p1_9_0 = m1_9_0 - w174 * c2_8 + (ye2_1 * w172 - ye2_2 * w173) * c3_4
        w180 = p1_8_0 + p1_9_0
        M1_0 = (
            w179
            + w91 * w180
            + (s_nu2_0 - w88 * c2_3 + (yE2_1_1 * w85 - yE2_1_2 * w87) * c3_1)
        )
        p1_1 = mu1 - w102 * c2_4 + (ye1_2 * w103 - ye1_0 * w100) * c3_2
        w181 = (
            n1_1
            - w106 * c2_4
            + (ye1_2 * w107 - ye1_0 * w105) * c3_2
            + (nu4_1 - w109 * c2_4 + (ye1_2 * w110 - ye1_0 * w108) * c3_2)
        )
        p1_13_1 = m1_13_1 - w116 * c2_5 + (yE4_2_2 * w117 - yE4_2_0 * w114) * c3_3
        w182 = (
            nu2_1
            - w119 * c2_4
            + (ye1_2 * w120 - ye1_0 * w118) * c3_2
            + (nu3_1 - w136 * c2_4 + (ye1_2 * w137 - ye1_0 * w135) * c3_2)
        )
        p1_6_1 = m1_6_1 - w159 * c2_8 + (ye2_2 * w160 - ye2_0 * w157) * c3_4
        p1_7_1 = m1_7_1 - w162 * c2_8 + (ye2_2 * w163 - ye2_0 * w161) * c3_4
        p1_10_1 = m1_10_1 - w165 * c2_8 + (ye2_2 * w166 - ye2_0 * w164) * c3_4
        w183 = p1_7_1 + p1_10_1
        w184 = (
            1.5 * p1_1
            + w104 * w181
            + w51 * (p1_13_1 + w182)
            - 0.5 * p1_6_1
            + w140 * w183
        )
        p1_8_1 = m1_8_1 - w170 * c2_8 + (ye2_2 * w171 - ye2_0 * w169) * c3_4
        p1_9_1 = m1_9_1 - w173 * c2_8 + (ye2_2 * w174 - ye2_0 * w172) * c3_4
        w185 = p1_8_1 + p1_9_1
        M1_1 = (
            w184
            + w91 * w185
            + (s_nu2_1 - w87 * c2_3 + (yE2_1_2 * w88 - yE2_1_0 * w85) * c3_1)
        )
        w186 = w2 * M1_0 + w3 * M1_1 + w1 * M1_2
        w187 = w6 * M1_0 + w7 * M1_1 + w5 * M1_2
        w188 = g01 * M1_0 + g11 * M1_1 + g21 * M1_2
        w189 = 0.5 * M1_0
        w190 = 0.5 * M1_1
        w191 = 0.5 * M1_2
        w192 = g01 * w189 + g11 * w190 + g21 * w191
        w193 = g00 * w189 + g10 * w190 + g20 * w191
        w194 = 0.5 * (g00 * w187 + g01 * w188 + g02 * w186) + g01 * w192 + w6 * w193
        w195 = g02 * w189 + g12 * w190 + g22 * w191
        f1_0 = w194 + w2 * w195
        w196 = 0.5 * (g10 * w187 + g11 * w188 + g12 * w186) + g11 * w192 + w7 * w193
        f1_1 = w196 + w3 * w195
        w197 = 0.5 * (g20 * w187 + g21 * w188 + g22 * w186) + g21 * w192 + w5 * w193
        f1_2 = w197 + w1 * w195
        Q2_2 = g02 * gE2_1_0 + g12 * gE2_1_1 + g22 * gE2_1_2
        w198 = (
            0.5 * (p1_2 + p1_6_2)
            + w93 * (w111 + p1_7_2 + p1_10_2)
            + w139 * (w138 + p1_8_2 + p1_9_2)
        )
        yE3_1_0 = xi2_0 * w50
        yE3_1_1 = xi2_1 * w50
        yE3_1_2 = xi2_2 * w50
        w199 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2
        c2_9, c3_5 = _stumpff_23(w199)
        w201 = nu3_1 * yE3_1_0 - nu3_0 * yE3_1_1
        w203 = nu3_0 * yE3_1_2 - nu3_2 * yE3_1_0
        w204 = nu3_2 * yE3_1_1 - nu3_1 * yE3_1_2
        M2_2 = (
            w198
            + w50 * (nu3_2 - w201 * c2_9 + (yE3_1_0 * w203 - yE3_1_1 * w204) * c3_5)
        )
        Q2_8 = g02 * gE2_1_6 + g12 * gE2_1_7 + g22 * gE2_1_8
        w205 = 100.0 * Q2_8
        w206 = (
            0.5 * (p1_0 + p1_6_0)
            + w93 * (w176 + p1_7_0 + p1_10_0)
            + w139 * (w177 + p1_8_0 + p1_9_0)
        )
        M2_0 = (
            w206
            + w50 * (nu3_0 - w204 * c2_9 + (yE3_1_1 * w201 - yE3_1_2 * w203) * c3_5)
        )
        w207 = 100.0 * Q2_2
        w208 = (
            0.5 * (p1_1 + p1_6_1)
            + w93 * (w181 + p1_7_1 + p1_10_1)
            + w139 * (w182 + p1_8_1 + p1_9_1)
        )
        M2_1 = (
            w208
            + w50 * (nu3_1 - w203 * c2_9 + (yE3_1_2 * w204 - yE3_1_0 * w201) * c3_5)
        )
        Q2_5 = g02 * gE2_1_3 + g12 * gE2_1_4 + g22 * gE2_1_5
        w209 = 100.0 * Q2_5
        w210 = M2_0 * w207 + M2_1 * w209 + M2_2 * w205
        Q2_0 = g00 * gE2_1_0 + g10 * gE2_1_1 + g20 * gE2_1_2
        Q2_6 = g00 * gE2_1_6 + g10 * gE2_1_7 + g20 * gE2_1_8
        w211 = 0.9900990099009901 * Q2_6
        w212 = 0.9900990099009901 * Q2_0
        Q2_3 = g00 * gE2_1_3 + g10 * gE2_1_4 + g20 * gE2_1_5
        w213 = 0.9900990099009901 * Q2_3
        w214 = M2_0 * w212 + M2_1 * w213 + M2_2 * w211
        Q2_1 = g01 * gE2_1_0 + g11 * gE2_1_1 + g21 * gE2_1_2
        Q2_7 = g01 * gE2_1_6 + g11 * gE2_1_7 + g21 * gE2_1_8
        Q2_4 = g01 * gE2_1_3 + g11 * gE2_1_4 + g21 * gE2_1_5
        w215 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7
        w216 = 0.5 * M2_0
        w217 = 0.5 * M2_1
        w218 = 0.5 * M2_2
        w219 = Q2_1 * w216 + Q2_4 * w217 + Q2_7 * w218
        w220 = Q2_0 * w216 + Q2_3 * w217 + Q2_6 * w218
        w221 = (
            0.5 * (Q2_0 * w214 + Q2_1 * w215 + Q2_2 * w210) + Q2_1 * w219 + w212 * w220
        )
        w222 = Q2_2 * w216 + Q2_5 * w217 + Q2_8 * w218
        f2_0 = w221 + w207 * w222
        w223 = (
            0.5 * (Q2_3 * w214 + Q2_4 * w215 + Q2_5 * w210) + Q2_4 * w219 + w213 * w220
        )
        f2_1 = w223 + w209 * w222
        w224 = (
            0.5 * (Q2_6 * w214 + Q2_7 * w215 + Q2_8 * w210) + Q2_7 * w219 + w211 * w220
        )
        f2_2 = w224 + w205 * w222
        Q3_2 = g02 * gE3_1_0 + g12 * gE3_1_1 + g22 * gE3_1_2
        M3_2 = w198 + w50 * p1_13_2
        Q3_8 = g02 * gE3_1_6 + g12 * gE3_1_7 + g22 * gE3_1_8
        w225 = 100.0 * Q3_8
        M3_0 = w206 + w50 * p1_13_0
        w226 = 100.0 * Q3_2
        M3_1 = w208 + w50 * p1_13_1
        Q3_5 = g02 * gE3_1_3 + g12 * gE3_1_4 + g22 * gE3_1_5
        w227 = 100.0 * Q3_5
        w228 = M3_0 * w226 + M3_1 * w227 + M3_2 * w225
        Q3_0 = g00 * gE3_1_0 + g10 * gE3_1_1 + g20 * gE3_1_2
        Q3_6 = g00 * gE3_1_6 + g10 * gE3_1_7 + g20 * gE3_1_8
        w229 = 0.9900990099009901 * Q3_6
        w230 = 0.9900990099009901 * Q3_0
        Q3_3 = g00 * gE3_1_3 + g10 * gE3_1_4 + g20 * gE3_1_5
        w231 = 0.9900990099009901 * Q3_3
        w232 = M3_0 * w230 + M3_1 * w231 + M3_2 * w229
        Q3_1 = g01 * gE3_1_0 + g11 * gE3_1_1 + g21 * gE3_1_2
        Q3_7 = g01 * gE3_1_6 + g11 * gE3_1_7 + g21 * gE3_1_8
        Q3_4 = g01 * gE3_1_3 + g11 * gE3_1_4 + g21 * gE3_1_5
        w233 = M3_0 * Q3_1 + M3_1 * Q3_4 + M3_2 * Q3_7
        w234 = 0.5 * M3_0
        w235 = 0.5 * M3_1
        w236 = 0.5 * M3_2
        w237 = Q3_1 * w234 + Q3_4 * w235 + Q3_7 * w236
        w238 = Q3_0 * w234 + Q3_3 * w235 + Q3_6 * w236
        w239 = (
            0.5 * (Q3_0 * w232 + Q3_1 * w233 + Q3_2 * w228) + Q3_1 * w237 + w230 * w238
        )
        w240 = Q3_2 * w234 + Q3_5 * w235 + Q3_8 * w236
        f3_0 = w239 + w226 * w240
        w241 = (
            0.5 * (Q3_3 * w232 + Q3_4 * w233 + Q3_5 * w228) + Q3_4 * w237 + w231 * w238
        )
        f3_1 = w241 + w227 * w240
        w242 = (
            0.5 * (Q3_6 * w232 + Q3_7 * w233 + Q3_8 * w228) + Q3_7 * w237 + w229 * w238
        )
        f3_2 = w242 + w225 * w240
        Q4_2 = g02 * E4_2_0 + g12 * E4_2_1 + g22 * E4_2_2
        M4_2 = (
            w111 * w140
            - 0.5 * p1_2
            + w91 * w138
            + 1.5 * p1_6_2
            + w104 * w167
            + w51 * w175
        )
        Q4_8 = g02 * E4_2_6 + g12 * E4_2_7 + g22 * E4_2_8
        w243 = 100.0 * Q4_8
        M4_0 = (
            w140 * w176
            - 0.5 * p1_0
            + w91 * w177
            + 1.5 * p1_6_0
            + w104 * w178
            + w51 * w180
        )
        w244 = 100.0 * Q4_2
        M4_1 = (
            w140 * w181
            - 0.5 * p1_1
            + w91 * w182
            + 1.5 * p1_6_1
            + w104 * w183
            + w51 * w185
        )
        Q4_5 = g02 * E4_2_3 + g12 * E4_2_4 + g22 * E4_2_5
        w245 = 100.0 * Q4_5
        w246 = M4_0 * w244 + M4_1 * w245 + M4_2 * w243
        Q4_0 = g00 * E4_2_0 + g10 * E4_2_1 + g20 * E4_2_2
        Q4_6 = g00 * E4_2_6 + g10 * E4_2_7 + g20 * E4_2_8
        w247 = 0.9900990099009901 * Q4_6
        w248 = 0.9900990099009901 * Q4_0
        Q4_3 = g00 * E4_2_3 + g10 * E4_2_4 + g20 * E4_2_5
        w249 = 0.9900990099009901 * Q4_3
        w250 = M4_0 * w248 + M4_1 * w249 + M4_2 * w247
        Q4_1 = g01 * E4_2_0 + g11 * E4_2_1 + g21 * E4_2_2
        Q4_7 = g01 * E4_2_6 + g11 * E4_2_7 + g21 * E4_2_8
        Q4_4 = g01 * E4_2_3 + g11 * E4_2_4 + g21 * E4_2_5
        w251 = M4_0 * Q4_1 + M4_1 * Q4_4 + M4_2 * Q4_7
        w252 = 0.5 * M4_0
        w253 = 0.5 * M4_1
        w254 = 0.5 * M4_2
        w255 = Q4_1 * w252 + Q4_4 * w253 + Q4_7 * w254
        w256 = Q4_0 * w252 + Q4_3 * w253 + Q4_6 * w254
        w257 = (
            0.5 * (Q4_0 * w250 + Q4_1 * w251 + Q4_2 * w246) + Q4_1 * w255 + w248 * w256
        )
        w258 = Q4_2 * w252 + Q4_5 * w253 + Q4_8 * w254
        f4_0 = w257 + w244 * w258
        w259 = (
            0.5 * (Q4_3 * w250 + Q4_4 * w251 + Q4_5 * w246) + Q4_4 * w255 + w249 * w256
        )
        f4_1 = w259 + w245 * w258
        w260 = (
            0.5 * (Q4_6 * w250 + Q4_7 * w251 + Q4_8 * w246) + Q4_7 * w255 + w247 * w256
        )
        f4_2 = w260 + w243 * w258
        w261 = w187 * w190 + 0.9900990099009901 * (M1_1 * w193)
        w262 = w32 + w188 * w190 + M1_1 * w192
        w263 = w34 + w186 * w190 + 100.0 * (M1_1 * w195)
        w264 = w187 * w191 + 0.9900990099009901 * (M1_2 * w193)
        w265 = w39 + w188 * w191 + M1_2 * w192
        w266 = w41 + w186 * w191 + 100.0 * (M1_2 * w195)
        r1_0 = (
            g20 * w261 + g21 * w262 + g22 * w263 - g10 * w264 - g11 * w265 - g12 * w266
        )
        w267 = w187 * w189 + 0.9900990099009901 * (M1_0 * w193)
        w268 = w46 + w188 * w189 + M1_0 * w192
        w269 = w48 + w186 * w189 + 100.0 * (M1_0 * w195)
        r1_1 = (
            g00 * w264
            - (g20 * w267 + g21 * w268 + g22 * w269)
            + g01 * w265
            + g02 * w266
        )
        r1_2 = (
            g10 * w267 + g11 * w268 + g12 * w269 - g00 * w261 - g01 * w262 - g02 * w263
        )
        w270 = w214 * w217 + 0.9900990099009901 * (M2_1 * w220)
        w271 = 1.5 + 0.1 * Q2_7 - Q2_8
        w272 = 0.1 * Q2_1 - Q2_2
        w273 = 0.1 * Q2_4 - Q2_5
        w274 = sqrt(w272 * w272 + w273 * w273 + w271 * w271)
        w275 = 1.0 / w274 / w274 * (0.5 / w274)
        w276 = 2.0 * w273 * w275
        w277 = 1.5 - 0.1 * Q2_7 - Q2_8
        w278 = -0.1 * Q2_1 - Q2_2
        w279 = -0.1 * Q2_4 - Q2_5
        w280 = sqrt(w278 * w278 + w279 * w279 + w277 * w277)
        w281 = -1.0 / w280 / w280 * (0.5 / w280)
        w282 = 2.0 * w279 * w281
        w283 = 0.1 * w282 - 0.1 * w276 + w215 * w217 + M2_1 * w219
        w284 = w276 + w282 + w210 * w217 + 100.0 * (M2_1 * w222)
        w285 = w214 * w218 + 0.9900990099009901 * (M2_2 * w220)
        w286 = 2.0 * w271 * w275
        w287 = 2.0 * w277 * w281
        w288 = 0.1 * w287 - 0.1 * w286 + w215 * w218 + M2_2 * w219
        w289 = w286 - 1.0 + w287 + w210 * w218 + 100.0 * (M2_2 * w222)
        r2_0 = (
            Q2_6 * w270
            + Q2_7 * w283
            + Q2_8 * w284
            - Q2_3 * w285
            - Q2_4 * w288
            - Q2_5 * w289
        )
        w290 = w214 * w216 + 0.9900990099009901 * (M2_0 * w220)
        w291 = 2.0 * w272 * w275
        w292 = 2.0 * w278 * w281
        w293 = 0.1 * w292 - 0.1 * w291 + w215 * w216 + M2_0 * w219
        w294 = w291 + w292 + w210 * w216 + 100.0 * (M2_0 * w222)
        r2_1 = (
            Q2_0 * w285
            - (Q2_6 * w290 + Q2_7 * w293 + Q2_8 * w294)
            + Q2_1 * w288
            + Q2_2 * w289
        )
        r2_2 = (
            Q2_3 * w290
            + Q2_4 * w293
            + Q2_5 * w294
            - Q2_0 * w270
            - Q2_1 * w283
            - Q2_2 * w284
        )
        w295 = w232 * w235 + 0.9900990099009901 * (M3_1 * w238)
        w296 = 1.5 + 0.1 * Q3_7 - Q3_8
        w297 = 0.1 * Q3_1 - Q3_2
        w298 = 0.1 * Q3_4 - Q3_5
        w299 = sqrt(w297 * w297 + w298 * w298 + w296 * w296)
        w300 = 1.0 / w299 / w299 * (0.5 / w299)
        w301 = 2.0 * w298 * w300
        w302 = 1.5 - 0.1 * Q3_7 - Q3_8
        w303 = -0.1 * Q3_1 - Q3_2
        w304 = -0.1 * Q3_4 - Q3_5
        w305 = sqrt(w303 * w303 + w304 * w304 + w302 * w302)
        w306 = -1.0 / w305 / w305 * (0.5 / w305)
        w307 = 2.0 * w304 * w306
        w308 = 0.1 * w307 - 0.1 * w301 + w233 * w235 + M3_1 * w237
        w309 = w301 + w307 + w228 * w235 + 100.0 * (M3_1 * w240)
        w310 = w232 * w236 + 0.9900990099009901 * (M3_2 * w238)
        w311 = 2.0 * w296 * w300
        w312 = 2.0 * w302 * w306
        w313 = 0.1 * w312 - 0.1 * w311 + w233 * w236 + M3_2 * w237
        w314 = w311 - 1.0 + w312 + w228 * w236 + 100.0 * (M3_2 * w240)
        r3_0 = (
            Q3_6 * w295
            + Q3_7 * w308
            + Q3_8 * w309
            - Q3_3 * w310
            - Q3_4 * w313
            - Q3_5 * w314
        )
        w315 = w232 * w234 + 0.9900990099009901 * (M3_0 * w238)
        w316 = 2.0 * w297 * w300
        w317 = 2.0 * w303 * w306
        w318 = 0.1 * w317 - 0.1 * w316 + w233 * w234 + M3_0 * w237
        w319 = w316 + w317 + w228 * w234 + 100.0 * (M3_0 * w240)
        r3_1 = (
            Q3_0 * w310
            - (Q3_6 * w315 + Q3_7 * w318 + Q3_8 * w319)
            + Q3_1 * w313
            + Q3_2 * w314
        )
        r3_2 = (
            Q3_3 * w315
            + Q3_4 * w318
            + Q3_5 * w319
            - Q3_0 * w295
            - Q3_1 * w308
            - Q3_2 * w309
        )
        w320 = w250 * w253 + 0.9900990099009901 * (M4_1 * w256)
        w321 = 1.5 + 0.1 * Q4_7 - Q4_8
        w322 = 0.1 * Q4_1 - Q4_2
        w323 = 0.1 * Q4_4 - Q4_5
        w324 = sqrt(w322 * w322 + w323 * w323 + w321 * w321)
        w325 = 1.0 / w324 / w324 * (0.5 / w324)
        w326 = 2.0 * w323 * w325
        w327 = 1.5 - 0.1 * Q4_7 - Q4_8
        w328 = -0.1 * Q4_1 - Q4_2
        w329 = -0.1 * Q4_4 - Q4_5
        w330 = sqrt(w328 * w328 + w329 * w329 + w327 * w327)
        w331 = -1.0 / w330 / w330 * (0.5 / w330)
        w332 = 2.0 * w329 * w331
        w333 = 0.1 * w332 - 0.1 * w326 + w251 * w253 + M4_1 * w255
        w334 = w326 + w332 + w246 * w253 + 100.0 * (M4_1 * w258)
        w335 = w250 * w254 + 0.9900990099009901 * (M4_2 * w256)
        w336 = 2.0 * w321 * w325
        w337 = 2.0 * w327 * w331
        w338 = 0.1 * w337 - 0.1 * w336 + w251 * w254 + M4_2 * w255
        w339 = w336 - 1.0 + w337 + w246 * w254 + 100.0 * (M4_2 * w258)
        r4_0 = (
            Q4_6 * w320
            + Q4_7 * w333
            + Q4_8 * w334
            - Q4_3 * w335
            - Q4_4 * w338
            - Q4_5 * w339
        )
        w340 = w250 * w252 + 0.9900990099009901 * (M4_0 * w256)
        w341 = 2.0 * w322 * w325
        w342 = 2.0 * w328 * w331
        w343 = 0.1 * w342 - 0.1 * w341 + w251 * w252 + M4_0 * w255
        w344 = w341 + w342 + w246 * w252 + 100.0 * (M4_0 * w258)
        r4_1 = (
            Q4_0 * w335
            - (Q4_6 * w340 + Q4_7 * w343 + Q4_8 * w344)
            + Q4_1 * w338
            + Q4_2 * w339
        )
        r4_2 = (
            Q4_3 * w340
            + Q4_4 * w343
            + Q4_5 * w344
            - Q4_0 * w320
            - Q4_1 * w333
            - Q4_2 * w334
        )
        f1_0 = f1_0
        f1_1 = f1_1
        f1_2 = f1_2
        f2_0 = f2_0
        f2_1 = f2_1
        f2_2 = f2_2
        f3_0 = f3_0
        f3_1 = f3_1
        f3_2 = f3_2
        f4_0 = f4_0
        f4_1 = f4_1
        f4_2 = f4_2
        r1_0 = r1_0
        r1_1 = r1_1
        r1_2 = r1_2
        r2_0 = r2_0
        r2_1 = r2_1
        r2_2 = r2_2
        r3_0 = r3_0
        r3_1 = r3_1
        r3_2 = r3_2
        r4_0 = r4_0
        r4_1 = r4_1
        r4_2 = r4_2
        change_xi1_0 = abs(f1_0 - xi1_0)
        change_xi1_1 = abs(f1_1 - xi1_1)
        change_xi1_2 = abs(f1_2 - xi1_2)
        change_xi2_0 = abs(f2_0 - xi2_0)
        change_xi2_1 = abs(f2_1 - xi2_1)
        change_xi2_2 = abs(f2_2 - xi2_2)
        change_xi3_0 = abs(f3_0 - xi3_0)
        change_xi3_1 = abs(f3_1 - xi3_1)
        change_xi3_2 = abs(f3_2 - xi3_2)
        change_xi4_0 = abs(f4_0 - xi4_0)
        change_xi4_1 = abs(f4_1 - xi4_1)
        change_xi4_2 = abs(f4_2 - xi4_2)
        change_n1_0 = abs(r1_0 - n1_0)
        change_n1_1 = abs(r1_1 - n1_1)
        change_n1_2 = abs(r1_2 - n1_2)
        change_n2_0 = abs(r2_0 - n2_0)
        change_n2_1 = abs(r2_1 - n2_1)
        change_n2_2 = abs(r2_2 - n2_2)
        change_n3_0 = abs(r3_0 - n3_0)
        change_n3_1 = abs(r3_1 - n3_1)
        change_n3_2 = abs(r3_2 - n3_2)
        change_n4_0 = abs(r4_0 - n4_0)
        change_n4_1 = abs(r4_1 - n4_1)
        change_n4_2 = abs(r4_2 - n4_2)
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
            change_n1_0,
            change_n1_1,
            change_n1_2,
            change_n2_0,
            change_n2_1,
            change_n2_2,
            change_n3_0,
            change_n3_1,
            change_n3_2,
            change_n4_0,
            change_n4_1,
            change_n4_2,
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
            abs(n1_0),
            abs(n1_1),
            abs(n1_2),
            abs(n2_0),
            abs(n2_1),
            abs(n2_2),
            abs(n3_0),
            abs(n3_1),
            abs(n3_2),
            abs(n4_0),
            abs(n4_1),
            abs(n4_2),
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
            + change_n1_0
            + change_n1_1
            + change_n1_2
            + change_n2_0
            + change_n2_1
            + change_n2_2
            + change_n3_0
            + change_n3_1
            + change_n3_2
            + change_n4_0
            + change_n4_1
            + change_n4_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
        settled = change >= previous_1 or change == 0.0
        if settled and change <= 5.684341886080802e-14 * scale:
            break
        previous_1 = change
        xi1_0 = f1_0
        xi1_1 = f1_1
        xi1_2 = f1_2
        xi2_0 = f2_0
        xi2_1 = f2_1
        xi2_2 = f2_2
        xi3_0 = f3_0
        xi3_1 = f3_1
        xi3_2 = f3_2
        xi4_0 = f4_0
        xi4_1 = f4_1
        xi4_2 = f4_2
        n1_0 = r1_0
        n1_1 = r1_1
        n1_2 = r1_2
        n2_0 = r2_0
        n2_1 = r2_1
        n2_2 = r2_2
        n3_0 = r3_0
        n3_1 = r3_1
        n3_2 = r3_2
        n4_0 = r4_0
        n4_1 = r4_1
        n4_2 = r4_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    xe2_1 = w140 * f1_1 + w139 * (f2_1 + f3_1) + w104 * f4_1
    xe2_0 = w140 * f1_0 + w139 * (f2_0 + f3_0) + w104 * f4_0
    xe2_2 = w140 * f1_2 + w139 * (f2_2 + f3_2) + w104 * f4_2
    w345 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2
    c1_5, c2_10 = _stumpff_12(w345)
    w347 = xe2_1 * c2_10
    w348 = xe2_1 * w347
    w349 = xe2_2 * c2_10 * xe2_2
    ge2_0 = 1.0 - (w348 + w349)
    w350 = xe2_0 * c2_10
    w351 = xe2_1 * w350
    w353 = xe2_2 * c1_5
    ge2_1 = w351 - w353
    w354 = xe2_1 * c1_5
    w355 = xe2_2 * w350
    ge2_2 = w354 + w355
    e2_0 = ge1_0 * ge2_0 + ge1_3 * ge2_1 + ge1_6 * ge2_2
    e2_1 = ge1_1 * ge2_0 + ge1_4 * ge2_1 + ge1_7 * ge2_2
    e2_2 = ge1_2 * ge2_0 + ge1_5 * ge2_1 + ge1_8 * ge2_2
    ge2_3 = w351 + w353
    w356 = xe2_0 * w350
    ge2_4 = 1.0 - (w349 + w356)
    w357 = xe2_2 * w347
    w358 = xe2_0 * c1_5
    ge2_5 = w357 - w358
    e2_3 = ge1_0 * ge2_3 + ge1_3 * ge2_4 + ge1_6 * ge2_5
    e2_4 = ge1_1 * ge2_3 + ge1_4 * ge2_4 + ge1_7 * ge2_5
    e2_5 = ge1_2 * ge2_3 + ge1_5 * ge2_4 + ge1_8 * ge2_5
    ge2_6 = w355 - w354
    ge2_7 = w357 + w358
    ge2_8 = 1.0 - (w348 + w356)
    e2_6 = ge1_0 * ge2_6 + ge1_3 * ge2_7 + ge1_6 * ge2_8
    e2_7 = ge1_1 * ge2_6 + ge1_4 * ge2_7 + ge1_7 * ge2_8
    e2_8 = ge1_2 * ge2_6 + ge1_5 * ge2_7 + ge1_8 * ge2_8
    w359 = 0.3333333333333333 * h
    mubar_0 = mu0 + (nu2_0 + nu3_0) * w359 + w139 * (nu4_0 + r1_0)
    mubar_1 = mu1 + w359 * (nu2_1 + nu3_1) + w139 * (nu4_1 + r1_1)
    mubar_2 = mu2 + w359 * (nu2_2 + nu3_2) + w139 * (nu4_2 + r1_2)
    new_g00 = g00 * e2_0 + g10 * e2_1 + g20 * e2_2
    new_g01 = g01 * e2_0 + g11 * e2_1 + g21 * e2_2
    new_g02 = g02 * e2_0 + g12 * e2_1 + g22 * e2_2
    new_g10 = g00 * e2_3 + g10 * e2_4 + g20 * e2_5
    new_g11 = g01 * e2_3 + g11 * e2_4 + g21 * e2_5
    new_g12 = g02 * e2_3 + g12 * e2_4 + g22 * e2_5
    new_g20 = g00 * e2_6 + g10 * e2_7 + g20 * e2_8
    new_g21 = g01 * e2_6 + g11 * e2_7 + g21 * e2_8
    new_g22 = g02 * e2_6 + g12 * e2_7 + g22 * e2_8
    new_mu0 = e2_0 * mubar_0 + e2_1 * mubar_1 + e2_2 * mubar_2
    new_mu1 = e2_3 * mubar_0 + e2_4 * mubar_1 + e2_5 * mubar_2
    new_mu2 = e2_6 * mubar_0 + e2_7 * mubar_1 + e2_8 * mubar_2
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
