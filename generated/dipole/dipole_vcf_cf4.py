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
operations: 129 add, 185 mul, 3 div, 2 sqrt, 1 stumpff_12 a step
            642 add, 890 mul, 9 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of
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
    w18 = 0.1 * w17 - 0.1 * w10
    w19 = w18 + mu1 * w2
    w20 = w10 + w17
    w21 = w20 + mu1 * w3
    w22 = mu2 * w1
    w23 = 2.0 * w5 * w9
    w24 = 2.0 * w11 * w16
    w25 = 0.1 * w24 - 0.1 * w23
    w26 = w25 + mu2 * w2
    w27 = w23 - 1.0 + w24
    w28 = w27 + mu2 * w3
    n0_0 = g20 * w4 + g21 * w19 + g22 * w21 - g10 * w22 - g11 * w26 - g12 * w28
    w29 = mu0 * w1
    w30 = 2.0 * w6 * w9
    w31 = 2.0 * w12 * w16
    w32 = 0.1 * w31 - 0.1 * w30
    w33 = w32 + mu0 * w2
    w34 = w30 + w31
    w35 = w34 + mu0 * w3
    n0_1 = g00 * w22 - (g20 * w29 + g21 * w33 + g22 * w35) + g01 * w26 + g02 * w28
    n0_2 = g10 * w29 + g11 * w33 + g12 * w35 - g00 * w4 - g01 * w19 - g02 * w21
    w36 = -0.5 * h
    w37 = 0.5 * h
    w75 = -0.25 * h
    w77 = -0.16666666666666666 * h
    w79 = 0.08333333333333333 * h
    w90 = 0.25 * h
    w125 = 0.16666666666666666 * h
    w126 = -0.08333333333333333 * h
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
    previous_1 = 0.0
    for sweep in range(1, 101):
        xE2_1_1 = xi1_1 * w37
        xE2_1_0 = xi1_0 * w37
        xE2_1_2 = xi1_2 * w37
        w38 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2
        c1_1, c2_1 = _stumpff_12(w38)
        w40 = xE2_1_1 * c1_1
        w42 = xE2_1_0 * c2_1
        w43 = xE2_1_2 * w42
        gE2_1_2 = w40 + w43
        yE2_1_1 = xi1_1 * w36
        w44 = h * xi3_1
        xE4_2_1 = yE2_1_1 + w44
        yE2_1_0 = xi1_0 * w36
        w45 = h * xi3_0
        xE4_2_0 = yE2_1_0 + w45
        yE2_1_2 = xi1_2 * w36
        w46 = h * xi3_2
        xE4_2_2 = yE2_1_2 + w46
        w47 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2
        c1_2, c2_2 = _stumpff_12(w47)
        w49 = xE4_2_1 * c2_2
        w50 = xE4_2_1 * w49
        w51 = xE4_2_2 * c2_2 * xE4_2_2
        gE4_2_0 = 1.0 - (w50 + w51)
        w52 = xE2_1_1 * c2_1
        w53 = xE2_1_2 * w52
        w54 = xE2_1_0 * c1_1
        gE2_1_5 = w53 - w54
        w55 = xE4_2_0 * c2_2
        w56 = xE4_2_1 * w55
        w58 = xE4_2_2 * c1_2
        gE4_2_1 = w56 - w58
        w59 = xE2_1_0 * w42
        w60 = xE2_1_1 * w52
        gE2_1_8 = 1.0 - (w59 + w60)
        w61 = xE4_2_1 * c1_2
        w62 = xE4_2_2 * w55
        gE4_2_2 = w61 + w62
        E4_2_2 = gE2_1_2 * gE4_2_0 + gE2_1_5 * gE4_2_1 + gE2_1_8 * gE4_2_2
        gE4_2_3 = w56 + w58
        w63 = xE4_2_0 * w55
        gE4_2_4 = 1.0 - (w51 + w63)
        w64 = xE4_2_2 * w49
        w65 = xE4_2_0 * c1_2
        gE4_2_5 = w64 - w65
        E4_2_5 = gE2_1_2 * gE4_2_3 + gE2_1_5 * gE4_2_4 + gE2_1_8 * gE4_2_5
        gE4_2_6 = w62 - w61
        gE4_2_7 = w64 + w65
        gE4_2_8 = 1.0 - (w50 + w63)
        E4_2_8 = gE2_1_2 * gE4_2_6 + gE2_1_5 * gE4_2_7 + gE2_1_8 * gE4_2_8
        nu4_2 = n4_0 * E4_2_2 + n4_1 * E4_2_5 + n4_2 * E4_2_8
        nu2_2 = n2_0 * gE2_1_2 + n2_1 * gE2_1_5 + n2_2 * gE2_1_8
        s_nu2_2 = w36 * nu4_2 - h * nu2_2
        w66 = yE2_1_0 * yE2_1_0 + yE2_1_1 * yE2_1_1 + yE2_1_2 * yE2_1_2
        c2_3, c3_1 = _stumpff_23(w66)
        w68 = xE2_1_1 * w42
        w69 = xE2_1_2 * c1_1
        gE2_1_1 = w68 - w69
        w70 = xE2_1_2 * c2_1 * xE2_1_2
        gE2_1_4 = 1.0 - (w59 + w70)
        gE2_1_7 = w53 + w54
        E4_2_1 = gE4_2_0 * gE2_1_1 + gE4_2_1 * gE2_1_4 + gE4_2_2 * gE2_1_7
        E4_2_4 = gE4_2_3 * gE2_1_1 + gE4_2_4 * gE2_1_4 + gE4_2_5 * gE2_1_7
        E4_2_7 = gE4_2_6 * gE2_1_1 + gE4_2_7 * gE2_1_4 + gE4_2_8 * gE2_1_7
        nu4_1 = n4_0 * E4_2_1 + n4_1 * E4_2_4 + n4_2 * E4_2_7
        nu2_1 = n2_0 * gE2_1_1 + n2_1 * gE2_1_4 + n2_2 * gE2_1_7
        s_nu2_1 = w36 * nu4_1 - h * nu2_1
        gE2_1_0 = 1.0 - (w60 + w70)
        gE2_1_3 = w68 + w69
        gE2_1_6 = w43 - w40
        E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6
        E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6
        E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6
        nu4_0 = n4_0 * E4_2_0 + n4_1 * E4_2_3 + n4_2 * E4_2_6
        nu2_0 = n2_0 * gE2_1_0 + n2_1 * gE2_1_3 + n2_2 * gE2_1_6
        s_nu2_0 = w36 * nu4_0 - h * nu2_0
        w71 = yE2_1_0 * s_nu2_1 - yE2_1_1 * s_nu2_0
        w73 = yE2_1_2 * s_nu2_0 - yE2_1_0 * s_nu2_2
        w74 = yE2_1_1 * s_nu2_2 - yE2_1_2 * s_nu2_1
        w76 = xi2_0 + xi3_0
        w78 = w76 * w77
        ye1_0 = xi1_0 * w75 + w78 + xi4_0 * w79
        w80 = xi2_1 + xi3_1
        w81 = w77 * w80
        ye1_1 = xi1_1 * w75 + w81 + xi4_1 * w79
        w82 = xi2_2 + xi3_2
        w83 = w77 * w82
        ye1_2 = xi1_2 * w75 + w83 + xi4_2 * w79
        w84 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2
        c2_4, c3_2 = _stumpff_23(w84)
        w86 = mu1 * ye1_0 - mu0 * ye1_1
        w88 = mu0 * ye1_2 - mu2 * ye1_0
        w89 = mu2 * ye1_1 - mu1 * ye1_2
        p1_2 = mu2 - w86 * c2_4 + (ye1_0 * w88 - ye1_1 * w89) * c3_2
        w91 = n1_1 * ye1_0 - n1_0 * ye1_1
        w92 = n1_0 * ye1_2 - n1_2 * ye1_0
        w93 = n1_2 * ye1_1 - n1_1 * ye1_2
        w94 = nu4_1 * ye1_0 - nu4_0 * ye1_1
        w95 = nu4_0 * ye1_2 - nu4_2 * ye1_0
        w96 = nu4_2 * ye1_1 - nu4_1 * ye1_2
        w97 = (
            n1_2
            - w91 * c2_4
            + (ye1_0 * w92 - ye1_1 * w93) * c3_2
            + (nu4_2 - w94 * c2_4 + (ye1_0 * w95 - ye1_1 * w96) * c3_2)
        )
        m1_13_2 = gE2_1_6 * nu4_0 + gE2_1_7 * nu4_1 + gE2_1_8 * nu4_2
        yE4_2_0 = xE2_1_0 - w45
        yE4_2_1 = xE2_1_1 - w44
        yE4_2_2 = xE2_1_2 - w46
        w98 = yE4_2_0 * yE4_2_0 + yE4_2_1 * yE4_2_1 + yE4_2_2 * yE4_2_2
        c2_5, c3_3 = _stumpff_23(w98)
        m1_13_1 = gE2_1_3 * nu4_0 + gE2_1_4 * nu4_1 + gE2_1_5 * nu4_2
        m1_13_0 = gE2_1_0 * nu4_0 + gE2_1_1 * nu4_1 + gE2_1_2 * nu4_2
        w100 = yE4_2_0 * m1_13_1 - yE4_2_1 * m1_13_0
        w102 = yE4_2_2 * m1_13_0 - m1_13_2 * yE4_2_0
        w103 = m1_13_2 * yE4_2_1 - yE4_2_2 * m1_13_1
        p1_13_2 = m1_13_2 - w100 * c2_5 + (yE4_2_0 * w102 - yE4_2_1 * w103) * c3_3
        w104 = nu2_1 * ye1_0 - nu2_0 * ye1_1
        w105 = nu2_0 * ye1_2 - nu2_2 * ye1_0
        w106 = nu2_2 * ye1_1 - nu2_1 * ye1_2
        xE3_1_1 = xi2_1 * w37
        xE3_1_0 = xi2_0 * w37
        xE3_1_2 = xi2_2 * w37
        w107 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2
        c1_3, c2_6 = _stumpff_12(w107)
        w109 = xE3_1_1 * c1_3
        w111 = xE3_1_0 * c2_6
        w112 = xE3_1_2 * w111
        gE3_1_2 = w109 + w112
        w113 = xE3_1_1 * c2_6
        w114 = xE3_1_2 * w113
        w115 = xE3_1_0 * c1_3
        gE3_1_5 = w114 - w115
        w116 = xE3_1_0 * w111
        w117 = xE3_1_1 * w113
        gE3_1_8 = 1.0 - (w116 + w117)
        nu3_2 = n3_0 * gE3_1_2 + n3_1 * gE3_1_5 + n3_2 * gE3_1_8
        w118 = xE3_1_1 * w111
        w119 = xE3_1_2 * c1_3
        gE3_1_1 = w118 - w119
        w120 = xE3_1_2 * c2_6 * xE3_1_2
        gE3_1_4 = 1.0 - (w116 + w120)
        gE3_1_7 = w114 + w115
        nu3_1 = n3_0 * gE3_1_1 + n3_1 * gE3_1_4 + n3_2 * gE3_1_7
        gE3_1_0 = 1.0 - (w117 + w120)
        gE3_1_3 = w118 + w119
        gE3_1_6 = w112 - w109
        nu3_0 = n3_0 * gE3_1_0 + n3_1 * gE3_1_3 + n3_2 * gE3_1_6
        w121 = ye1_0 * nu3_1 - ye1_1 * nu3_0
        w122 = ye1_2 * nu3_0 - ye1_0 * nu3_2
        w123 = ye1_1 * nu3_2 - ye1_2 * nu3_1
        w124 = (
            nu2_2
            - w104 * c2_4
            + (ye1_0 * w105 - ye1_1 * w106) * c3_2
            + (nu3_2 - w121 * c2_4 + (ye1_0 * w122 - ye1_1 * w123) * c3_2)
        )
        xe1_2 = xi1_2 * w90 + w82 * w125 + xi4_2 * w126
        xe1_0 = xi1_0 * w90 + w76 * w125 + xi4_0 * w126
        xe1_1 = xi1_1 * w90 + w80 * w125 + xi4_1 * w126
        w127 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_4, c2_7 = _stumpff_12(w127)
        w129 = xe1_0 * c2_7
        w130 = xe1_2 * w129
        w132 = xe1_1 * c1_4
        ge1_6 = w130 - w132
        w133 = xe1_0 * c1_4
        w134 = xe1_1 * c2_7
        w135 = xe1_2 * w134
        ge1_7 = w133 + w135
        w136 = xe1_0 * w129
        w137 = xe1_1 * w134
        ge1_8 = 1.0 - (w136 + w137)
        m1_6_2 = mu0 * ge1_6 + mu1 * ge1_7 + mu2 * ge1_8
        ye2_0 = w78 + xi1_0 * w79 + xi4_0 * w75
        ye2_1 = w81 + xi1_1 * w79 + xi4_1 * w75
        ye2_2 = w83 + xi1_2 * w79 + xi4_2 * w75
        w138 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
        c2_8, c3_4 = _stumpff_23(w138)
        w140 = xe1_2 * c1_4
        w141 = xe1_1 * w129
        ge1_3 = w140 + w141
        w142 = xe1_2 * c2_7 * xe1_2
        ge1_4 = 1.0 - (w136 + w142)
        ge1_5 = w135 - w133
        m1_6_1 = mu0 * ge1_3 + mu1 * ge1_4 + mu2 * ge1_5
        ge1_0 = 1.0 - (w137 + w142)
        ge1_1 = w141 - w140
        ge1_2 = w130 + w132
        m1_6_0 = mu0 * ge1_0 + mu1 * ge1_1 + mu2 * ge1_2
        w143 = ye2_0 * m1_6_1 - ye2_1 * m1_6_0
        w145 = ye2_2 * m1_6_0 - m1_6_2 * ye2_0
        w146 = m1_6_2 * ye2_1 - ye2_2 * m1_6_1
        p1_6_2 = m1_6_2 - w143 * c2_8 + (ye2_0 * w145 - ye2_1 * w146) * c3_4
        m1_7_2 = n1_0 * ge1_6 + n1_1 * ge1_7 + n1_2 * ge1_8
        m1_7_1 = n1_0 * ge1_3 + n1_1 * ge1_4 + n1_2 * ge1_5
        m1_7_0 = n1_0 * ge1_0 + n1_1 * ge1_1 + n1_2 * ge1_2
        w147 = ye2_0 * m1_7_1 - ye2_1 * m1_7_0
        w148 = ye2_2 * m1_7_0 - ye2_0 * m1_7_2
        w149 = ye2_1 * m1_7_2 - ye2_2 * m1_7_1
        p1_7_2 = m1_7_2 - w147 * c2_8 + (ye2_0 * w148 - ye2_1 * w149) * c3_4
        m1_10_2 = nu4_0 * ge1_6 + nu4_1 * ge1_7 + nu4_2 * ge1_8
        m1_10_1 = nu4_0 * ge1_3 + nu4_1 * ge1_4 + nu4_2 * ge1_5
        m1_10_0 = nu4_0 * ge1_0 + nu4_1 * ge1_1 + nu4_2 * ge1_2
        w150 = ye2_0 * m1_10_1 - ye2_1 * m1_10_0
        w151 = ye2_2 * m1_10_0 - ye2_0 * m1_10_2
        w152 = ye2_1 * m1_10_2 - ye2_2 * m1_10_1
        p1_10_2 = m1_10_2 - w150 * c2_8 + (ye2_0 * w151 - ye2_1 * w152) * c3_4
        w153 = p1_7_2 + p1_10_2
        w154 = (
            1.5 * p1_2 + w90 * w97 + w37 * (p1_13_2 + w124) - 0.5 * p1_6_2 + w126 * w153
        )
        m1_8_2 = nu2_0 * ge1_6 + nu2_1 * ge1_7 + nu2_2 * ge1_8
        m1_8_1 = nu2_0 * ge1_3 + nu2_1 * ge1_4 + nu2_2 * ge1_5
        m1_8_0 = nu2_0 * ge1_0 + nu2_1 * ge1_1 + nu2_2 * ge1_2
        w155 = ye2_0 * m1_8_1 - ye2_1 * m1_8_0
        w156 = ye2_2 * m1_8_0 - ye2_0 * m1_8_2
        w157 = ye2_1 * m1_8_2 - ye2_2 * m1_8_1
        p1_8_2 = m1_8_2 - w155 * c2_8 + (ye2_0 * w156 - ye2_1 * w157) * c3_4
        m1_9_2 = nu3_0 * ge1_6 + nu3_1 * ge1_7 + nu3_2 * ge1_8
        m1_9_1 = nu3_0 * ge1_3 + nu3_1 * ge1_4 + nu3_2 * ge1_5
        m1_9_0 = nu3_0 * ge1_0 + nu3_1 * ge1_1 + nu3_2 * ge1_2
        w158 = ye2_0 * m1_9_1 - ye2_1 * m1_9_0
        w159 = ye2_2 * m1_9_0 - ye2_0 * m1_9_2
        w160 = ye2_1 * m1_9_2 - ye2_2 * m1_9_1
        p1_9_2 = m1_9_2 - w158 * c2_8 + (ye2_0 * w159 - ye2_1 * w160) * c3_4
        w161 = p1_8_2 + p1_9_2
        M1_2 = (
            w154
            + w77 * w161
            + (s_nu2_2 - w71 * c2_3 + (yE2_1_0 * w73 - yE2_1_1 * w74) * c3_1)
        )
        p1_0 = mu0 - w89 * c2_4 + (ye1_1 * w86 - ye1_2 * w88) * c3_2
        w162 = (
            n1_0
            - w93 * c2_4
            + (ye1_1 * w91 - ye1_2 * w92) * c3_2
            + (nu4_0 - w96 * c2_4 + (ye1_1 * w94 - ye1_2 * w95) * c3_2)
        )
        p1_13_0 = m1_13_0 - w103 * c2_5 + (yE4_2_1 * w100 - yE4_2_2 * w102) * c3_3
        w163 = (
            nu2_0
            - w106 * c2_4
            + (ye1_1 * w104 - ye1_2 * w105) * c3_2
            + (nu3_0 - w123 * c2_4 + (ye1_1 * w121 - ye1_2 * w122) * c3_2)
        )
        p1_6_0 = m1_6_0 - w146 * c2_8 + (ye2_1 * w143 - ye2_2 * w145) * c3_4
        p1_7_0 = m1_7_0 - w149 * c2_8 + (ye2_1 * w147 - ye2_2 * w148) * c3_4
        p1_10_0 = m1_10_0 - w152 * c2_8 + (ye2_1 * w150 - ye2_2 * w151) * c3_4
        w164 = p1_7_0 + p1_10_0
        w165 = (
            1.5 * p1_0
            + w90 * w162
            + w37 * (p1_13_0 + w163)
            - 0.5 * p1_6_0
            + w126 * w164
        )
        p1_8_0 = m1_8_0 - w157 * c2_8 + (ye2_1 * w155 - ye2_2 * w156) * c3_4
        p1_9_0 = m1_9_0 - w160 * c2_8 + (ye2_1 * w158 - ye2_2 * w159) * c3_4
        w166 = p1_8_0 + p1_9_0
        M1_0 = (
            w165
            + w77 * w166
            + (s_nu2_0 - w74 * c2_3 + (yE2_1_1 * w71 - yE2_1_2 * w73) * c3_1)
        )
        p1_1 = mu1 - w88 * c2_4 + (ye1_2 * w89 - ye1_0 * w86) * c3_2
        w167 = (
            n1_1
            - w92 * c2_4
            + (ye1_2 * w93 - ye1_0 * w91) * c3_2
            + (nu4_1 - w95 * c2_4 + (ye1_2 * w96 - ye1_0 * w94) * c3_2)
        )
        p1_13_1 = m1_13_1 - w102 * c2_5 + (yE4_2_2 * w103 - yE4_2_0 * w100) * c3_3
        w168 = (
            nu2_1
            - w105 * c2_4
            + (ye1_2 * w106 - ye1_0 * w104) * c3_2
            + (nu3_1 - w122 * c2_4 + (ye1_2 * w123 - ye1_0 * w121) * c3_2)
        )
        p1_6_1 = m1_6_1 - w145 * c2_8 + (ye2_2 * w146 - ye2_0 * w143) * c3_4
        p1_7_1 = m1_7_1 - w148 * c2_8 + (ye2_2 * w149 - ye2_0 * w147) * c3_4
        p1_10_1 = m1_10_1 - w151 * c2_8 + (ye2_2 * w152 - ye2_0 * w150) * c3_4
        w169 = p1_7_1 + p1_10_1
        w170 = (
            1.5 * p1_1
            + w90 * w167
            + w37 * (p1_13_1 + w168)
            - 0.5 * p1_6_1
            + w126 * w169
        )
        p1_8_1 = m1_8_1 - w156 * c2_8 + (ye2_2 * w157 - ye2_0 * w155) * c3_4
        p1_9_1 = m1_9_1 - w159 * c2_8 + (ye2_2 * w160 - ye2_0 * w158) * c3_4
        w171 = p1_8_1 + p1_9_1
        M1_1 = (
            w170
            + w77 * w171
            + (s_nu2_1 - w73 * c2_3 + (yE2_1_2 * w74 - yE2_1_0 * w71) * c3_1)
        )
        w172 = 0.9900990099009901 * (g00 * M1_0 + g10 * M1_1 + g20 * M1_2)
        w173 = g01 * M1_0 + g11 * M1_1 + g21 * M1_2
        w174 = 100.0 * (g02 * M1_0 + g12 * M1_1 + g22 * M1_2)
        f1_0 = g00 * w172 + g01 * w173 + g02 * w174
        f1_1 = g10 * w172 + g11 * w173 + g12 * w174
        f1_2 = g20 * w172 + g21 * w173 + g22 * w174
        Q2_0 = g00 * gE2_1_0 + g10 * gE2_1_1 + g20 * gE2_1_2
        Q2_6 = g00 * gE2_1_6 + g10 * gE2_1_7 + g20 * gE2_1_8
        w175 = (
            0.5 * (p1_2 + p1_6_2)
            + w79 * (w97 + p1_7_2 + p1_10_2)
            + w125 * (w124 + p1_8_2 + p1_9_2)
        )
        yE3_1_0 = xi2_0 * w36
        yE3_1_1 = xi2_1 * w36
        yE3_1_2 = xi2_2 * w36
        w176 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2
        c2_9, c3_5 = _stumpff_23(w176)
        w178 = nu3_1 * yE3_1_0 - nu3_0 * yE3_1_1
        w180 = nu3_0 * yE3_1_2 - nu3_2 * yE3_1_0
        w181 = nu3_2 * yE3_1_1 - nu3_1 * yE3_1_2
        M2_2 = (
            w175
            + w36 * (nu3_2 - w178 * c2_9 + (yE3_1_0 * w180 - yE3_1_1 * w181) * c3_5)
        )
        w182 = (
            0.5 * (p1_0 + p1_6_0)
            + w79 * (w162 + p1_7_0 + p1_10_0)
            + w125 * (w163 + p1_8_0 + p1_9_0)
        )
        M2_0 = (
            w182
            + w36 * (nu3_0 - w181 * c2_9 + (yE3_1_1 * w178 - yE3_1_2 * w180) * c3_5)
        )
        Q2_3 = g00 * gE2_1_3 + g10 * gE2_1_4 + g20 * gE2_1_5
        w183 = (
            0.5 * (p1_1 + p1_6_1)
            + w79 * (w167 + p1_7_1 + p1_10_1)
            + w125 * (w168 + p1_8_1 + p1_9_1)
        )
        M2_1 = (
            w183
            + w36 * (nu3_1 - w180 * c2_9 + (yE3_1_2 * w181 - yE3_1_0 * w178) * c3_5)
        )
        w184 = 0.9900990099009901 * (Q2_0 * M2_0 + Q2_3 * M2_1 + Q2_6 * M2_2)
        Q2_1 = g01 * gE2_1_0 + g11 * gE2_1_1 + g21 * gE2_1_2
        Q2_7 = g01 * gE2_1_6 + g11 * gE2_1_7 + g21 * gE2_1_8
        Q2_4 = g01 * gE2_1_3 + g11 * gE2_1_4 + g21 * gE2_1_5
        w185 = M2_0 * Q2_1 + M2_1 * Q2_4 + M2_2 * Q2_7
        Q2_2 = g02 * gE2_1_0 + g12 * gE2_1_1 + g22 * gE2_1_2
        Q2_8 = g02 * gE2_1_6 + g12 * gE2_1_7 + g22 * gE2_1_8
        Q2_5 = g02 * gE2_1_3 + g12 * gE2_1_4 + g22 * gE2_1_5
        w186 = 100.0 * (M2_0 * Q2_2 + M2_1 * Q2_5 + M2_2 * Q2_8)
        f2_0 = Q2_0 * w184 + Q2_1 * w185 + Q2_2 * w186
        f2_1 = Q2_3 * w184 + Q2_4 * w185 + Q2_5 * w186
        f2_2 = Q2_6 * w184 + Q2_7 * w185 + Q2_8 * w186
        Q3_0 = g00 * gE3_1_0 + g10 * gE3_1_1 + g20 * gE3_1_2
        Q3_6 = g00 * gE3_1_6 + g10 * gE3_1_7 + g20 * gE3_1_8
        M3_2 = w175 + w36 * p1_13_2
        M3_0 = w182 + w36 * p1_13_0
        Q3_3 = g00 * gE3_1_3 + g10 * gE3_1_4 + g20 * gE3_1_5
        M3_1 = w183 + w36 * p1_13_1
        w187 = 0.9900990099009901 * (Q3_0 * M3_0 + Q3_3 * M3_1 + Q3_6 * M3_2)
        Q3_1 = g01 * gE3_1_0 + g11 * gE3_1_1 + g21 * gE3_1_2
        Q3_7 = g01 * gE3_1_6 + g11 * gE3_1_7 + g21 * gE3_1_8
        Q3_4 = g01 * gE3_1_3 + g11 * gE3_1_4 + g21 * gE3_1_5
        w188 = M3_0 * Q3_1 + M3_1 * Q3_4 + M3_2 * Q3_7
        Q3_2 = g02 * gE3_1_0 + g12 * gE3_1_1 + g22 * gE3_1_2
        Q3_8 = g02 * gE3_1_6 + g12 * gE3_1_7 + g22 * gE3_1_8
        Q3_5 = g02 * gE3_1_3 + g12 * gE3_1_4 + g22 * gE3_1_5
        w189 = 100.0 * (M3_0 * Q3_2 + M3_1 * Q3_5 + M3_2 * Q3_8)
        f3_0 = Q3_0 * w187 + Q3_1 * w188 + Q3_2 * w189
        f3_1 = Q3_3 * w187 + Q3_4 * w188 + Q3_5 * w189
        f3_2 = Q3_6 * w187 + Q3_7 * w188 + Q3_8 * w189
        Q4_0 = g00 * E4_2_0 + g10 * E4_2_1 + g20 * E4_2_2
        Q4_6 = g00 * E4_2_6 + g10 * E4_2_7 + g20 * E4_2_8
        M4_2 = (
            w97 * w126
            - 0.5 * p1_2
            + w77 * w124
            + 1.5 * p1_6_2
            + w90 * w153
            + w37 * w161
        )
        M4_0 = (
            w126 * w162
            - 0.5 * p1_0
            + w77 * w163
            + 1.5 * p1_6_0
            + w90 * w164
            + w37 * w166
        )
        Q4_3 = g00 * E4_2_3 + g10 * E4_2_4 + g20 * E4_2_5
        M4_1 = (
            w126 * w167
            - 0.5 * p1_1
            + w77 * w168
            + 1.5 * p1_6_1
            + w90 * w169
            + w37 * w171
        )
        w190 = 0.9900990099009901 * (Q4_0 * M4_0 + Q4_3 * M4_1 + Q4_6 * M4_2)
        Q4_1 = g01 * E4_2_0 + g11 * E4_2_1 + g21 * E4_2_2
        Q4_7 = g01 * E4_2_6 + g11 * E4_2_7 + g21 * E4_2_8
        Q4_4 = g01 * E4_2_3 + g11 * E4_2_4 + g21 * E4_2_5
        w191 = M4_0 * Q4_1 + M4_1 * Q4_4 + M4_2 * Q4_7
        Q4_2 = g02 * E4_2_0 + g12 * E4_2_1 + g22 * E4_2_2
        Q4_8 = g02 * E4_2_6 + g12 * E4_2_7 + g22 * E4_2_8
        Q4_5 = g02 * E4_2_3 + g12 * E4_2_4 + g22 * E4_2_5
        w192 = 100.0 * (M4_0 * Q4_2 + M4_1 * Q4_5 + M4_2 * Q4_8)
        f4_0 = Q4_0 * w190 + Q4_1 * w191 + Q4_2 * w192
        f4_1 = Q4_3 * w190 + Q4_4 * w191 + Q4_5 * w192
        f4_2 = Q4_6 * w190 + Q4_7 * w191 + Q4_8 * w192
        w193 = M1_1 * w172
        w194 = w18 + M1_1 * w173
        w195 = w20 + M1_1 * w174
        w196 = M1_2 * w172
        w197 = w25 + M1_2 * w173
        w198 = w27 + M1_2 * w174
        r1_0 = (
            g20 * w193 + g21 * w194 + g22 * w195 - g10 * w196 - g11 * w197 - g12 * w198
        )
        w199 = M1_0 * w172
        w200 = w32 + M1_0 * w173
        w201 = w34 + M1_0 * w174
        r1_1 = (
            g00 * w196
            - (g20 * w199 + g21 * w200 + g22 * w201)
            + g01 * w197
            + g02 * w198
        )
        r1_2 = (
            g10 * w199 + g11 * w200 + g12 * w201 - g00 * w193 - g01 * w194 - g02 * w195
        )
        w202 = M2_1 * w184
        w203 = 1.5 + 0.1 * Q2_7 - Q2_8
        w204 = 0.1 * Q2_1 - Q2_2
        w205 = 0.1 * Q2_4 - Q2_5
        w206 = 1.0 / sqrt(w204 * w204 + w205 * w205 + w203 * w203)
        w207 = w206 * w206 * (0.5 * w206)
        w208 = 2.0 * w205 * w207
        w209 = 1.5 - 0.1 * Q2_7 - Q2_8
        w210 = -0.1 * Q2_1 - Q2_2
        w211 = -0.1 * Q2_4 - Q2_5
        w212 = sqrt(w210 * w210 + w211 * w211 + w209 * w209)
        w213 = 1.0 / w212
        w214 = -1.0 / w212 * w213 * (0.5 * w213)
        w215 = 2.0 * w211 * w214
        w216 = 0.1 * w215 - 0.1 * w208 + M2_1 * w185
        w217 = w208 + w215 + M2_1 * w186
        w218 = M2_2 * w184
        w219 = 2.0 * w203 * w207
        w220 = 2.0 * w209 * w214
        w221 = 0.1 * w220 - 0.1 * w219 + M2_2 * w185
        w222 = w219 - 1.0 + w220 + M2_2 * w186
        r2_0 = (
            Q2_6 * w202
            + Q2_7 * w216
            + Q2_8 * w217
            - Q2_3 * w218
            - Q2_4 * w221
            - Q2_5 * w222
        )
        w223 = M2_0 * w184
        w224 = 2.0 * w204 * w207
        w225 = 2.0 * w210 * w214
        w226 = 0.1 * w225 - 0.1 * w224 + M2_0 * w185
        w227 = w224 + w225 + M2_0 * w186
        r2_1 = (
            Q2_0 * w218
            - (Q2_6 * w223 + Q2_7 * w226 + Q2_8 * w227)
            + Q2_1 * w221
            + Q2_2 * w222
        )
        r2_2 = (
            Q2_3 * w223
            + Q2_4 * w226
            + Q2_5 * w227
            - Q2_0 * w202
            - Q2_1 * w216
            - Q2_2 * w217
        )
        w228 = M3_1 * w187
        w229 = 1.5 + 0.1 * Q3_7 - Q3_8
        w230 = 0.1 * Q3_1 - Q3_2
        w231 = 0.1 * Q3_4 - Q3_5
        w232 = 1.0 / sqrt(w230 * w230 + w231 * w231 + w229 * w229)
        w233 = w232 * w232 * (0.5 * w232)
        w234 = 2.0 * w231 * w233
        w235 = 1.5 - 0.1 * Q3_7 - Q3_8
        w236 = -0.1 * Q3_1 - Q3_2
        w237 = -0.1 * Q3_4 - Q3_5
        w238 = sqrt(w236 * w236 + w237 * w237 + w235 * w235)
        w239 = 1.0 / w238
        w240 = -1.0 / w238 * w239 * (0.5 * w239)
        w241 = 2.0 * w237 * w240
        w242 = 0.1 * w241 - 0.1 * w234 + M3_1 * w188
        w243 = w234 + w241 + M3_1 * w189
        w244 = M3_2 * w187
        w245 = 2.0 * w229 * w233
        w246 = 2.0 * w235 * w240
        w247 = 0.1 * w246 - 0.1 * w245 + M3_2 * w188
        w248 = w245 - 1.0 + w246 + M3_2 * w189
        r3_0 = (
            Q3_6 * w228
            + Q3_7 * w242
            + Q3_8 * w243
            - Q3_3 * w244
            - Q3_4 * w247
            - Q3_5 * w248
        )
        w249 = M3_0 * w187
        w250 = 2.0 * w230 * w233
        w251 = 2.0 * w236 * w240
        w252 = 0.1 * w251 - 0.1 * w250 + M3_0 * w188
        w253 = w250 + w251 + M3_0 * w189
        r3_1 = (
            Q3_0 * w244
            - (Q3_6 * w249 + Q3_7 * w252 + Q3_8 * w253)
            + Q3_1 * w247
            + Q3_2 * w248
        )
        r3_2 = (
            Q3_3 * w249
            + Q3_4 * w252
            + Q3_5 * w253
            - Q3_0 * w228
            - Q3_1 * w242
            - Q3_2 * w243
        )
        w254 = M4_1 * w190
        w255 = 1.5 + 0.1 * Q4_7 - Q4_8
        w256 = 0.1 * Q4_1 - Q4_2
        w257 = 0.1 * Q4_4 - Q4_5
        w258 = 1.0 / sqrt(w256 * w256 + w257 * w257 + w255 * w255)
        w259 = w258 * w258 * (0.5 * w258)
        w260 = 2.0 * w257 * w259
        w261 = 1.5 - 0.1 * Q4_7 - Q4_8
        w262 = -0.1 * Q4_1 - Q4_2
        w263 = -0.1 * Q4_4 - Q4_5
        w264 = sqrt(w262 * w262 + w263 * w263 + w261 * w261)
        w265 = 1.0 / w264
        w266 = -1.0 / w264 * w265 * (0.5 * w265)
        w267 = 2.0 * w263 * w266
        w268 = 0.1 * w267 - 0.1 * w260 + M4_1 * w191
        w269 = w260 + w267 + M4_1 * w192
        w270 = M4_2 * w190
        w271 = 2.0 * w255 * w259
        w272 = 2.0 * w261 * w266
        w273 = 0.1 * w272 - 0.1 * w271 + M4_2 * w191
        w274 = w271 - 1.0 + w272 + M4_2 * w192
        r4_0 = (
            Q4_6 * w254
            + Q4_7 * w268
            + Q4_8 * w269
            - Q4_3 * w270
            - Q4_4 * w273
            - Q4_5 * w274
        )
        w275 = M4_0 * w190
        w276 = 2.0 * w256 * w259
        w277 = 2.0 * w262 * w266
        w278 = 0.1 * w277 - 0.1 * w276 + M4_0 * w191
        w279 = w276 + w277 + M4_0 * w192
        r4_1 = (
            Q4_0 * w270
            - (Q4_6 * w275 + Q4_7 * w278 + Q4_8 * w279)
            + Q4_1 * w273
            + Q4_2 * w274
        )
        r4_2 = (
            Q4_3 * w275
            + Q4_4 * w278
            + Q4_5 * w279
            - Q4_0 * w254
            - Q4_1 * w268
            - Q4_2 * w269
        )
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
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
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
    xe2_1 = w126 * f1_1 + w125 * (f2_1 + f3_1) + w90 * f4_1
    xe2_0 = w126 * f1_0 + w125 * (f2_0 + f3_0) + w90 * f4_0
    xe2_2 = w126 * f1_2 + w125 * (f2_2 + f3_2) + w90 * f4_2
    w280 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2
    c1_5, c2_10 = _stumpff_12(w280)
    w282 = xe2_1 * c2_10
    w283 = xe2_1 * w282
    w284 = xe2_2 * c2_10 * xe2_2
    ge2_0 = 1.0 - (w283 + w284)
    w285 = xe2_0 * c2_10
    w286 = xe2_1 * w285
    w288 = xe2_2 * c1_5
    ge2_1 = w286 - w288
    w289 = xe2_1 * c1_5
    w290 = xe2_2 * w285
    ge2_2 = w289 + w290
    e2_0 = ge1_0 * ge2_0 + ge1_3 * ge2_1 + ge1_6 * ge2_2
    e2_1 = ge1_1 * ge2_0 + ge1_4 * ge2_1 + ge1_7 * ge2_2
    e2_2 = ge1_2 * ge2_0 + ge1_5 * ge2_1 + ge1_8 * ge2_2
    ge2_3 = w286 + w288
    w291 = xe2_0 * w285
    ge2_4 = 1.0 - (w284 + w291)
    w292 = xe2_2 * w282
    w293 = xe2_0 * c1_5
    ge2_5 = w292 - w293
    e2_3 = ge1_0 * ge2_3 + ge1_3 * ge2_4 + ge1_6 * ge2_5
    e2_4 = ge1_1 * ge2_3 + ge1_4 * ge2_4 + ge1_7 * ge2_5
    e2_5 = ge1_2 * ge2_3 + ge1_5 * ge2_4 + ge1_8 * ge2_5
    ge2_6 = w290 - w289
    ge2_7 = w292 + w293
    ge2_8 = 1.0 - (w283 + w291)
    e2_6 = ge1_0 * ge2_6 + ge1_3 * ge2_7 + ge1_6 * ge2_8
    e2_7 = ge1_1 * ge2_6 + ge1_4 * ge2_7 + ge1_7 * ge2_8
    e2_8 = ge1_2 * ge2_6 + ge1_5 * ge2_7 + ge1_8 * ge2_8
    w294 = 0.3333333333333333 * h
    mubar_0 = mu0 + (nu2_0 + nu3_0) * w294 + w125 * (nu4_0 + r1_0)
    mubar_1 = mu1 + w294 * (nu2_1 + nu3_1) + w125 * (nu4_1 + r1_1)
    mubar_2 = mu2 + w294 * (nu2_2 + nu3_2) + w125 * (nu4_2 + r1_2)
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
