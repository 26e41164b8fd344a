"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4

method:     family vcf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section
            2.2.1
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point, 12
            unknowns (3.0 sweeps of 1065 operations a step; Newton's method: 2.5
            sweeps of 1341 operations and 0.05 matrices of 11276; Newton's method
            with the matrix to first order in h: 2.3 sweeps of 1341 operations and
            1.00 matrices of 3992)
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
            6 Adtinv, 1 force (dead code)
            1 lin (sharing)
            5 dexpt (functions)
            3 Adinv, 4 legendre (sharing)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 89 add, 131 mul, 2 sqrt, 2 div, 1 stumpff_12 a step
            2 mul a start, in steps that follow no other
            327 add, 489 mul, 6 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of
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
    """Sweeps over the equations, added up over all steps that are given this object.

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


class _Memory:
    """What one step of a run leaves for the next.

    past: solutions of its equations, the latest first.
    """

    def __init__(self):
        self.past = []
        self.first = 0.0
        self.rates = [1.0] * 1

    def keep(self, found):
        """Add a solution; alone where the one before it was expected too far off."""
        if len(self.past) > 1:
            moved = max(abs(x - y) for x, y in zip(found, self.past[0]))
            if self.first > 0.5 * moved:
                self.past = []
        self.past = [found, *self.past[:8]]
        self.first = 0.0

    def extrapolated(self):
        """Return the polynomial through the last solutions, continued by a step."""
        weights = (
            (1.0,),
            (2.0, -1.0),
            (3.0, -3.0, 1.0),
            (4.0, -6.0, 4.0, -1.0),
            (5.0, -10.0, 10.0, -5.0, 1.0),
            (6.0, -15.0, 20.0, -15.0, 6.0, -1.0),
            (7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0),
            (8.0, -28.0, 56.0, -70.0, 56.0, -28.0, 8.0, -1.0),
            (9.0, -36.0, 84.0, -126.0, 126.0, -84.0, 36.0, -9.0, 1.0),
        )[len(self.past) - 1]
        return [
            sum(w * x for w, x in zip(weights, values)) for values in zip(*self.past)
        ]


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


def _stumpff_23_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return 0.5 * (ratio * ratio), c3


def _stumpff_23(z):
    """Return, for z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_2(z), _stumpff_small_3(z)
    return _stumpff_23_far(z)


def _stumpff_12_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    return _stumpff_12_far(z)


def _advance(state, h, memory, statistics):
    """Return the state after one step as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    m_0 = g00 * mu0 + g10 * mu1 + g20 * mu2
    m_1 = g01 * mu0 + g11 * mu1 + g21 * mu2
    m_2 = g02 * mu0 + g12 * mu1 + g22 * mu2
    if memory.past:
        (
            xi1_0,
            xi1_1,
            xi1_2,
            xi2_0,
            xi2_1,
            xi2_2,
            xi3_0,
            xi3_1,
            xi3_2,
            xi4_0,
            xi4_1,
            xi4_2,
        ) = memory.extrapolated()
    else:
        Wxi0_0 = 0.9900990099009901 * m_0
        Wxi0_2 = 100.0 * m_2
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
    w1 = -0.5 * h
    w2 = 0.5 * h
    w60 = 0.16666666666666666 * h
    w61 = -2.0 * g22
    w62 = 1.5 + w61
    w63 = -0.2 * g21
    w64 = w62 + w63
    w65 = 1.5 * w64
    w66 = 1.01 + w65
    w67 = sqrt(w66)
    w68 = 1.0 / w67
    w69 = w68 * w68
    w70 = 0.5 * w68
    w71 = w69 * w70
    w72 = 1.5 * w71
    w73 = 0.2 * g21
    w74 = w62 + w73
    w75 = 1.5 * w74
    w76 = 1.01 + w75
    w77 = sqrt(w76)
    w78 = 1.0 / w77
    w79 = w78 * w78
    w80 = 0.5 * w78
    w81 = w79 * w80
    w82 = 1.5 * w81
    w83 = w72 - w82
    w84 = -2.0 * w83
    w85 = w84 - 1.0
    w86 = g21 * w85
    w87 = -0.3 * w71
    w88 = -0.3 * w81
    w89 = w87 + w88
    w90 = g22 * w89
    w91 = w86 - w90
    w113 = 0.3333333333333333 * h
    w114 = -0.25 * h
    w116 = -0.16666666666666666 * h
    w118 = 0.08333333333333333 * h
    w125 = g20 * w89
    w126 = g20 * w85
    w132 = 0.25 * h
    w134 = -0.08333333333333333 * h
    # the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: fixed point in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
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
        w34 = 1.5 - 2.0 * Q4_8
        w35 = 1.0 / sqrt(1.01 + 1.5 * (w34 - 0.2 * Q4_7))
        w36 = w35 * w35 * (0.5 * w35)
        w37 = 1.0 / sqrt(1.01 + 1.5 * (w34 + 0.2 * Q4_7))
        w38 = w37 * w37 * (0.5 * w37)
        w39 = -1.0 - 2.0 * (1.5 * w36 - 1.5 * w38)
        w40 = -0.3 * w36 - 0.3 * w38
        Nr4_0 = Q4_7 * w39 - Q4_8 * w40 + 99.0 * a_5_1 * p_4_2
        p_2_2 = 0.01 * (xi2_0 * gE2_1_2 + xi2_1 * gE2_1_5 + xi2_2 * gE2_1_8)
        a_1 = xi2_0 * gE2_1_1 + xi2_1 * gE2_1_4 + xi2_2 * gE2_1_7
        Q2_7 = g20 * gE2_1_1 + g21 * gE2_1_4 + g22 * gE2_1_7
        Q2_8 = g20 * gE2_1_2 + g21 * gE2_1_5 + g22 * gE2_1_8
        w41 = 1.5 - 2.0 * Q2_8
        w42 = 1.0 / sqrt(1.01 + 1.5 * (w41 - 0.2 * Q2_7))
        w43 = w42 * w42 * (0.5 * w42)
        w44 = 1.0 / sqrt(1.01 + 1.5 * (w41 + 0.2 * Q2_7))
        w45 = w44 * w44 * (0.5 * w44)
        w46 = -1.0 - 2.0 * (1.5 * w43 - 1.5 * w45)
        w47 = -0.3 * w43 - 0.3 * w45
        sum_Nr4_0 = Nr4_0 + 2.0 * (Q2_7 * w46 - Q2_8 * w47 + 99.0 * a_1 * p_2_2)
        s_nu2_0 = w1 * sum_Nr4_0
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
        sum_Nr4_2 = Nr4_2 + 2.0 * (0.01 * a_0 * a_1 + w47 * Q2_6)
        s_nu2_2 = w1 * sum_Nr4_2
        Nr4_1 = -100.0 * a_5_0 * p_4_2 - w39 * Q4_6
        sum_Nr4_1 = Nr4_1 + 2.0 * (-100.0 * a_0 * p_2_2 - w46 * Q2_6)
        s_nu2_1 = w1 * sum_Nr4_1
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
        w92 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2
        c1_3, c2_5 = _stumpff_12(w92)
        w94 = xE3_1_1 * c1_3
        w96 = xE3_1_0 * c2_5
        w97 = xE3_1_2 * w96
        gE3_1_2 = w94 + w97
        w98 = xE3_1_1 * c2_5
        w99 = xE3_1_2 * w98
        w100 = xE3_1_0 * c1_3
        gE3_1_5 = w99 - w100
        w101 = xE3_1_0 * w96
        w102 = xE3_1_1 * w98
        gE3_1_8 = 1.0 - (w101 + w102)
        p_3_2 = 0.01 * (xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8)
        w103 = xE3_1_1 * w96
        w104 = xE3_1_2 * c1_3
        gE3_1_1 = w103 - w104
        w105 = xE3_1_2 * c2_5 * xE3_1_2
        gE3_1_4 = 1.0 - (w101 + w105)
        gE3_1_7 = w99 + w100
        a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7
        Q3_7 = g20 * gE3_1_1 + g21 * gE3_1_4 + g22 * gE3_1_7
        Q3_8 = g20 * gE3_1_2 + g21 * gE3_1_5 + g22 * gE3_1_8
        w106 = 1.5 - 2.0 * Q3_8
        w107 = 1.0 / sqrt(1.01 + 1.5 * (w106 - 0.2 * Q3_7))
        w108 = w107 * w107 * (0.5 * w107)
        w109 = 1.0 / sqrt(1.01 + 1.5 * (w106 + 0.2 * Q3_7))
        w110 = w109 * w109 * (0.5 * w109)
        w111 = -1.0 - 2.0 * (1.5 * w108 - 1.5 * w110)
        w112 = -0.3 * w108 - 0.3 * w110
        Nr3_0 = Q3_7 * w111 - Q3_8 * w112 + 99.0 * a_3_1 * p_3_2
        s_p1_0 = m_0 + w60 * (w91 + 99.0 * xi1_1 * p_2 + sum_Nr4_0) + Nr3_0 * w113
        w115 = xi2_0 + xi3_0
        w117 = w115 * w116
        ye1_0 = xi1_0 * w114 + w117 + xi4_0 * w118
        w119 = xi2_1 + xi3_1
        w120 = w116 * w119
        ye1_1 = xi1_1 * w114 + w120 + xi4_1 * w118
        w121 = xi2_2 + xi3_2
        w122 = w116 * w121
        ye1_2 = xi1_2 * w114 + w122 + xi4_2 * w118
        w123 = ye1_0 * ye1_0 + ye1_1 * ye1_1 + ye1_2 * ye1_2
        c2_6, c3_3 = _stumpff_23(w123)
        gE3_1_0 = 1.0 - (w102 + w105)
        gE3_1_3 = w103 + w104
        gE3_1_6 = w97 - w94
        a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6
        Q3_6 = g20 * gE3_1_0 + g21 * gE3_1_3 + g22 * gE3_1_6
        Nr3_2 = 0.01 * a_3_0 * a_3_1 + w112 * Q3_6
        s_p1_2 = m_2 + w60 * (0.01 * xi1_0 * xi1_1 + w125 + sum_Nr4_2) + w113 * Nr3_2
        Nr3_1 = -100.0 * a_3_0 * p_3_2 - w111 * Q3_6
        s_p1_1 = m_1 + w60 * (-100.0 * xi1_0 * p_2 - w126 + sum_Nr4_1) + w113 * Nr3_1
        w127 = ye1_1 * s_p1_2 - ye1_2 * s_p1_1
        w129 = ye1_0 * s_p1_1 - s_p1_0 * ye1_1
        w130 = s_p1_0 * ye1_2 - ye1_0 * s_p1_2
        p1_11_0 = s_p1_0 - w127 * c2_6 + (ye1_1 * w129 - ye1_2 * w130) * c3_3
        w131 = (
            s_nu2_0
            - w50 * c2_3
            + (yE2_1_1 * w52 - yE2_1_2 * w53) * c3_1
            + w2 * p1_13_0
            + 1.5 * p1_11_0
        )
        w133 = w60 * w119
        xe1_1 = xi1_1 * w132 + w133 + xi4_1 * w134
        w135 = w60 * w115
        xe1_0 = xi1_0 * w132 + w135 + xi4_0 * w134
        w136 = w60 * w121
        xe1_2 = xi1_2 * w132 + w136 + xi4_2 * w134
        w137 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_4, c2_7 = _stumpff_12(w137)
        w139 = xe1_1 * c2_7
        w140 = xe1_1 * w139
        w141 = xe1_2 * c2_7 * xe1_2
        ge1_0 = 1.0 - (w140 + w141)
        w142 = xe1_0 * c2_7
        w143 = xe1_1 * w142
        w145 = xe1_2 * c1_4
        ge1_1 = w143 - w145
        w146 = xe1_1 * c1_4
        w147 = xe1_2 * w142
        ge1_2 = w146 + w147
        m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2
        ye2_0 = w117 + xi1_0 * w118 + xi4_0 * w114
        ye2_1 = w120 + xi1_1 * w118 + xi4_1 * w114
        ye2_2 = w122 + xi1_2 * w118 + xi4_2 * w114
        w148 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
        c2_8, c3_4 = _stumpff_23(w148)
        ge1_6 = w147 - w146
        w150 = xe1_0 * c1_4
        w151 = xe1_2 * w139
        ge1_7 = w150 + w151
        w152 = xe1_0 * w142
        ge1_8 = 1.0 - (w140 + w152)
        m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8
        ge1_3 = w143 + w145
        ge1_4 = 1.0 - (w141 + w152)
        ge1_5 = w151 - w150
        m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5
        w153 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1
        w155 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1
        w156 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2
        p1_6_2_0 = m1_6_2_0 - w153 * c2_8 + (ye2_1 * w155 - ye2_2 * w156) * c3_4
        p1_13_1 = m1_13_1 - w59 * c2_4 + (yE4_2_2 * w56 - yE4_2_0 * w58) * c3_2
        p1_11_1 = s_p1_1 - w130 * c2_6 + (ye1_2 * w127 - ye1_0 * w129) * c3_3
        w157 = (
            s_nu2_1
            - w53 * c2_3
            + (yE2_1_2 * w50 - yE2_1_0 * w52) * c3_1
            + w2 * p1_13_1
            + 1.5 * p1_11_1
        )
        p1_6_2_1 = m1_6_2_1 - w156 * c2_8 + (ye2_2 * w153 - ye2_0 * w155) * c3_4
        p1_13_2 = m1_13_2 - w58 * c2_4 + (yE4_2_0 * w59 - yE4_2_1 * w56) * c3_2
        p1_11_2 = s_p1_2 - w129 * c2_6 + (ye1_0 * w130 - ye1_1 * w127) * c3_3
        w158 = (
            s_nu2_2
            - w52 * c2_3
            + (yE2_1_0 * w53 - yE2_1_1 * w50) * c3_1
            + w2 * p1_13_2
            + 1.5 * p1_11_2
        )
        p1_6_2_2 = m1_6_2_2 - w155 * c2_8 + (ye2_0 * w156 - ye2_1 * w153) * c3_4
        w159 = 0.5 * (p1_11_0 + p1_6_2_0)
        yE3_1_0 = xi2_0 * w1
        yE3_1_1 = xi2_1 * w1
        yE3_1_2 = xi2_2 * w1
        w160 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2
        c2_9, c3_5 = _stumpff_23(w160)
        w162 = Nr3_2 * yE3_1_1 - Nr3_1 * yE3_1_2
        w164 = Nr3_1 * yE3_1_0 - Nr3_0 * yE3_1_1
        w165 = Nr3_0 * yE3_1_2 - Nr3_2 * yE3_1_0
        M2_0 = (
            w159 + w1 * (Nr3_0 - w162 * c2_9 + (yE3_1_1 * w164 - yE3_1_2 * w165) * c3_5)
        )
        w166 = 0.5 * (p1_11_1 + p1_6_2_1)
        M2_1 = (
            w166 + w1 * (Nr3_1 - w165 * c2_9 + (yE3_1_2 * w162 - yE3_1_0 * w164) * c3_5)
        )
        w167 = 0.5 * (p1_11_2 + p1_6_2_2)
        M2_2 = (
            w167 + w1 * (Nr3_2 - w164 * c2_9 + (yE3_1_0 * w165 - yE3_1_1 * w162) * c3_5)
        )
        Wf2_0 = 0.9900990099009901 * (gE2_1_0 * M2_0 + gE2_1_3 * M2_1 + gE2_1_6 * M2_2)
        Pf2_1 = gE2_1_1 * M2_0 + gE2_1_4 * M2_1 + gE2_1_7 * M2_2
        Wf2_2 = 100.0 * (gE2_1_2 * M2_0 + gE2_1_5 * M2_1 + gE2_1_8 * M2_2)
        M3_0 = w159 + w1 * p1_13_0
        M3_1 = w166 + w1 * p1_13_1
        M3_2 = w167 + w1 * p1_13_2
        Wf3_0 = 0.9900990099009901 * (gE3_1_0 * M3_0 + gE3_1_3 * M3_1 + gE3_1_6 * M3_2)
        Pf3_1 = gE3_1_1 * M3_0 + gE3_1_4 * M3_1 + gE3_1_7 * M3_2
        Wf3_2 = 100.0 * (gE3_1_2 * M3_0 + gE3_1_5 * M3_1 + gE3_1_8 * M3_2)
        M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0
        M4_1 = 1.5 * p1_6_2_1 - 0.5 * p1_11_1
        M4_2 = 1.5 * p1_6_2_2 - 0.5 * p1_11_2
        Wf4_0 = 0.9900990099009901 * (E4_2_0 * M4_0 + E4_2_3 * M4_1 + E4_2_6 * M4_2)
        Pf4_1 = E4_2_1 * M4_0 + E4_2_4 * M4_1 + E4_2_7 * M4_2
        Wf4_2 = 100.0 * (E4_2_2 * M4_0 + E4_2_5 * M4_1 + E4_2_8 * M4_2)
        next_xi1_0 = 0.9900990099009901 * (w131 - 0.5 * p1_6_2_0)
        next_xi1_1 = w157 - 0.5 * p1_6_2_1
        next_xi1_2 = 100.0 * (w158 - 0.5 * p1_6_2_2)
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
        if sweep == 1:
            memory.first = max(memory.first, change)
        if previous_1 > 0.0:
            rate_1 = max(change / previous_1, 0.000244140625)
        close = change * rate_1 <= 1.1102230246251565e-16 * scale
        if still or (close and change <= 3.552713678800501e-15 * scale):
            memory.rates[0] = rate_1 if sweep > 1 else 2.0 * rate_1
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
    xe2_1 = w133 + xi1_1 * w134 + xi4_1 * w132
    xe2_0 = w135 + xi1_0 * w134 + xi4_0 * w132
    xe2_2 = w136 + xi1_2 * w134 + xi4_2 * w132
    w168 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2
    c1_5, c2_10 = _stumpff_12(w168)
    w170 = xe2_1 * c2_10
    w171 = xe2_1 * w170
    w172 = xe2_2 * c2_10 * xe2_2
    ge2_0 = 1.0 - (w171 + w172)
    w173 = xe2_0 * c2_10
    w174 = xe2_1 * w173
    w176 = xe2_2 * c1_5
    ge2_1 = w174 - w176
    w177 = xe2_1 * c1_5
    w178 = xe2_2 * w173
    ge2_2 = w177 + w178
    e2_0 = ge1_0 * ge2_0 + ge1_3 * ge2_1 + ge1_6 * ge2_2
    ge2_3 = w174 + w176
    w179 = xe2_0 * w173
    ge2_4 = 1.0 - (w172 + w179)
    w180 = xe2_2 * w170
    w181 = xe2_0 * c1_5
    ge2_5 = w180 - w181
    e2_3 = ge1_0 * ge2_3 + ge1_3 * ge2_4 + ge1_6 * ge2_5
    ge2_6 = w178 - w177
    ge2_7 = w180 + w181
    ge2_8 = 1.0 - (w171 + w179)
    e2_6 = ge1_0 * ge2_6 + ge1_3 * ge2_7 + ge1_6 * ge2_8
    e2_1 = ge1_1 * ge2_0 + ge1_4 * ge2_1 + ge1_7 * ge2_2
    e2_4 = ge1_1 * ge2_3 + ge1_4 * ge2_4 + ge1_7 * ge2_5
    e2_7 = ge1_1 * ge2_6 + ge1_4 * ge2_7 + ge1_7 * ge2_8
    e2_2 = ge1_2 * ge2_0 + ge1_5 * ge2_1 + ge1_8 * ge2_2
    e2_5 = ge1_2 * ge2_3 + ge1_5 * ge2_4 + ge1_8 * ge2_5
    e2_8 = ge1_2 * ge2_6 + ge1_5 * ge2_7 + ge1_8 * ge2_8
    change_0 = s_p1_0 * e2_0 + s_p1_1 * e2_1 + s_p1_2 * e2_2 - m_0
    change_1 = s_p1_0 * e2_3 + s_p1_1 * e2_4 + s_p1_2 * e2_5 - m_1
    change_2 = s_p1_0 * e2_6 + s_p1_1 * e2_7 + s_p1_2 * e2_8 - m_2
    new_g00 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6
    new_g01 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7
    new_g02 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8
    new_g10 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6
    new_g11 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7
    new_g12 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8
    new_g20 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6
    new_g21 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7
    new_g22 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8
    new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0
    new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1
    new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2
    found = (
        xi1_0,
        xi1_1,
        xi1_2,
        xi2_0,
        xi2_1,
        xi2_2,
        xi3_0,
        xi3_1,
        xi3_2,
        xi4_0,
        xi4_1,
        xi4_2,
    )
    memory.keep(found)
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


def _checked(state, h, memory, statistics):
    """Return the state after one step, which is finite."""
    try:
        new = _advance(state, h, memory, statistics)
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
    memory = _Memory()
    made = 0
    try:
        if steps > 0 and not isfinite(h):
            raise StepFailed(BAD_STEP, f"the step size h = {h} is not finite")
        for made in range(steps):
            try:
                state = _checked(state, h, memory, statistics)
            except StepFailed:
                if not memory.past:
                    raise
                # The solutions before may mislead where the motion changes.
                memory = _Memory()
                if statistics is not None:
                    statistics.failed = 0
                state = _checked(state, h, memory, statistics)
            if stride > 0 and (made + 1) % stride == 0:
                rows.append(list(state))
    except StepFailed as failure:
        failure.step, failure.state = made, state
        raise
    return rows if stride > 0 else list(state)
