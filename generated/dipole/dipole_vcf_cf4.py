"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4

method:     family vcf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section
            2.2.1
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12
            unknowns (2.5 sweeps of 1304 operations and 0.05 matrices of 3910 a
            step; fixed point: 3.0 sweeps of 1065 operations; Newton's method with
            the matrix to first order in h: 2.3 sweeps of 1341 operations and 1.00
            matrices of 3992)
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
operations: 136 add, 208 mul, 2 sqrt, 2 div, 2 stumpff_12 a step
            2 mul a start, in steps that follow no other
            150 add, 304 mul a matrix of the equations of xi1, xi2, xi3, xi4, n1,
            n2, n3, n4
            453 add, 602 mul, 6 div, 6 sqrt, 4 stumpff_12, 5 stumpff_23 a sweep of
            the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
made by:    orderconds emit dipole --method vcf:cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcf_cf4

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcf_cf4.run(state, 0.005, 100))
"""

from math import cos, fabs, isfinite, sin, sqrt

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
    block that failed, 0 if none has; matrices: how often a matrix of Newton's method
    was made.
    """

    labels = [
        "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 1, 0, 0
        self.matrices = 0

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

    past: solutions of its equations, the latest first; inverses: of Newton's matrices, by
    block.
    """

    def __init__(self):
        self.past = []
        self.first = 0.0
        self.rates = [1.0] * 1
        self.inverses = [None] * 1

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


def invert(a):
    """Return the inverse of a square matrix, a list of rows that is used up; None where it has none."""
    n = len(a)
    order = [0] * n
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: fabs(a[i][k]))
        if not fabs(a[pivot][k]) > 0.0:
            return None
        order[k] = pivot
        a[k], a[pivot] = a[pivot], a[k]
        factor = 1.0 / a[k][k]
        a[k][k] = 1.0
        a[k] = [x * factor for x in a[k]]
        for i in range(n):
            if i != k:
                multiple, a[i][k] = a[i][k], 0.0
                a[i] = [x - multiple * y for x, y in zip(a[i], a[k])]
    for k in reversed(range(n)):
        for row in a:
            row[k], row[order[k]] = row[order[k]], row[k]
    return a


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
    w131 = 0.25 * h
    w133 = -0.08333333333333333 * h
    # the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    make_1 = memory.inverses[0] is None
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
        a_5_2 = xi4_0 * E4_2_2 + xi4_1 * E4_2_5 + xi4_2 * E4_2_8
        p_4_2 = 0.01 * a_5_2
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
        p1_11_2_0 = s_nu2_0 - w50 * c2_3 + (yE2_1_1 * w52 - yE2_1_2 * w53) * c3_1
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
        Nr1_0 = w91 + 99.0 * xi1_1 * p_2
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
        s_p1_0 = m_0 + w60 * (sum_Nr4_0 + Nr1_0) + Nr3_0 * w113
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
        Nr1_2 = 0.01 * xi1_0 * xi1_1 + w125
        gE3_1_0 = 1.0 - (w102 + w105)
        gE3_1_3 = w103 + w104
        gE3_1_6 = w97 - w94
        a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6
        Q3_6 = g20 * gE3_1_0 + g21 * gE3_1_3 + g22 * gE3_1_6
        Nr3_2 = 0.01 * a_3_0 * a_3_1 + w112 * Q3_6
        s_p1_2 = m_2 + w60 * (sum_Nr4_2 + Nr1_2) + w113 * Nr3_2
        Nr1_1 = -100.0 * xi1_0 * p_2 - w126
        Nr3_1 = -100.0 * a_3_0 * p_3_2 - w111 * Q3_6
        s_p1_1 = m_1 + w60 * (sum_Nr4_1 + Nr1_1) + w113 * Nr3_1
        w127 = ye1_1 * s_p1_2 - ye1_2 * s_p1_1
        w129 = ye1_0 * s_p1_1 - s_p1_0 * ye1_1
        w130 = s_p1_0 * ye1_2 - ye1_0 * s_p1_2
        p1_11_0 = s_p1_0 - w127 * c2_6 + (ye1_1 * w129 - ye1_2 * w130) * c3_3
        w132 = w60 * w119
        xe1_1 = xi1_1 * w131 + w132 + xi4_1 * w133
        w134 = w60 * w115
        xe1_0 = xi1_0 * w131 + w134 + xi4_0 * w133
        w135 = w60 * w121
        xe1_2 = xi1_2 * w131 + w135 + xi4_2 * w133
        w136 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_4, c2_7 = _stumpff_12(w136)
        w138 = xe1_1 * c2_7
        w139 = xe1_1 * w138
        w140 = xe1_2 * c2_7 * xe1_2
        ge1_0 = 1.0 - (w139 + w140)
        w141 = xe1_0 * c2_7
        w142 = xe1_1 * w141
        w144 = xe1_2 * c1_4
        ge1_1 = w142 - w144
        w145 = xe1_1 * c1_4
        w146 = xe1_2 * w141
        ge1_2 = w145 + w146
        m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2
        ye2_0 = w117 + xi1_0 * w118 + xi4_0 * w114
        ye2_1 = w120 + xi1_1 * w118 + xi4_1 * w114
        ye2_2 = w122 + xi1_2 * w118 + xi4_2 * w114
        w147 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
        c2_8, c3_4 = _stumpff_23(w147)
        ge1_6 = w146 - w145
        w149 = xe1_0 * c1_4
        w150 = xe1_2 * w138
        ge1_7 = w149 + w150
        w151 = xe1_0 * w141
        ge1_8 = 1.0 - (w139 + w151)
        m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8
        ge1_3 = w142 + w144
        ge1_4 = 1.0 - (w140 + w151)
        ge1_5 = w150 - w149
        m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5
        w152 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1
        w154 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1
        w155 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2
        p1_6_2_0 = m1_6_2_0 - w152 * c2_8 + (ye2_1 * w154 - ye2_2 * w155) * c3_4
        M1_0 = p1_11_2_0 + w2 * p1_13_0 + 1.5 * p1_11_0 - 0.5 * p1_6_2_0
        residual_0 = M1_0 - 1.01 * xi1_0
        p1_11_2_1 = s_nu2_1 - w53 * c2_3 + (yE2_1_2 * w50 - yE2_1_0 * w52) * c3_1
        p1_13_1 = m1_13_1 - w59 * c2_4 + (yE4_2_2 * w56 - yE4_2_0 * w58) * c3_2
        p1_11_1 = s_p1_1 - w130 * c2_6 + (ye1_2 * w127 - ye1_0 * w129) * c3_3
        p1_6_2_1 = m1_6_2_1 - w155 * c2_8 + (ye2_2 * w152 - ye2_0 * w154) * c3_4
        M1_1 = p1_11_2_1 + w2 * p1_13_1 + 1.5 * p1_11_1 - 0.5 * p1_6_2_1
        residual_1 = M1_1 - xi1_1
        p1_11_2_2 = s_nu2_2 - w52 * c2_3 + (yE2_1_0 * w53 - yE2_1_1 * w50) * c3_1
        p1_13_2 = m1_13_2 - w58 * c2_4 + (yE4_2_0 * w59 - yE4_2_1 * w56) * c3_2
        p1_11_2 = s_p1_2 - w129 * c2_6 + (ye1_0 * w130 - ye1_1 * w127) * c3_3
        p1_6_2_2 = m1_6_2_2 - w154 * c2_8 + (ye2_0 * w155 - ye2_1 * w152) * c3_4
        M1_2 = p1_11_2_2 + w2 * p1_13_2 + 1.5 * p1_11_2 - 0.5 * p1_6_2_2
        residual_2 = M1_2 - p_2
        w156 = 0.5 * (p1_11_0 + p1_6_2_0)
        yE3_1_0 = xi2_0 * w1
        yE3_1_1 = xi2_1 * w1
        yE3_1_2 = xi2_2 * w1
        w157 = yE3_1_0 * yE3_1_0 + yE3_1_1 * yE3_1_1 + yE3_1_2 * yE3_1_2
        c2_9, c3_5 = _stumpff_23(w157)
        w159 = Nr3_2 * yE3_1_1 - Nr3_1 * yE3_1_2
        w161 = Nr3_1 * yE3_1_0 - Nr3_0 * yE3_1_1
        w162 = Nr3_0 * yE3_1_2 - Nr3_2 * yE3_1_0
        M2_0 = (
            w156 + w1 * (Nr3_0 - w159 * c2_9 + (yE3_1_1 * w161 - yE3_1_2 * w162) * c3_5)
        )
        p_2_0 = 1.01 * a_0
        a_4_0 = gE2_1_0 * p_2_0 + gE2_1_1 * a_1 + gE2_1_2 * p_2_2
        residual_2_0 = M2_0 - a_4_0
        w163 = 0.5 * (p1_11_1 + p1_6_2_1)
        M2_1 = (
            w163 + w1 * (Nr3_1 - w162 * c2_9 + (yE3_1_2 * w159 - yE3_1_0 * w161) * c3_5)
        )
        a_4_1 = gE2_1_3 * p_2_0 + gE2_1_4 * a_1 + gE2_1_5 * p_2_2
        residual_2_1 = M2_1 - a_4_1
        w164 = 0.5 * (p1_11_2 + p1_6_2_2)
        M2_2 = (
            w164 + w1 * (Nr3_2 - w161 * c2_9 + (yE3_1_0 * w162 - yE3_1_1 * w159) * c3_5)
        )
        a_4_2 = gE2_1_6 * p_2_0 + gE2_1_7 * a_1 + gE2_1_8 * p_2_2
        residual_2_2 = M2_2 - a_4_2
        M3_0 = w156 + w1 * p1_13_0
        p_3_0 = 1.01 * a_3_0
        a_7_0 = gE3_1_0 * p_3_0 + gE3_1_1 * a_3_1 + gE3_1_2 * p_3_2
        residual_3_0 = M3_0 - a_7_0
        M3_1 = w163 + w1 * p1_13_1
        a_7_1 = gE3_1_3 * p_3_0 + gE3_1_4 * a_3_1 + gE3_1_5 * p_3_2
        residual_3_1 = M3_1 - a_7_1
        M3_2 = w164 + w1 * p1_13_2
        a_7_2 = gE3_1_6 * p_3_0 + gE3_1_7 * a_3_1 + gE3_1_8 * p_3_2
        residual_3_2 = M3_2 - a_7_2
        M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0
        p_4_0 = 1.01 * a_5_0
        a_9_0 = E4_2_0 * p_4_0 + E4_2_1 * a_5_1 + E4_2_2 * p_4_2
        residual_4_0 = M4_0 - a_9_0
        M4_1 = 1.5 * p1_6_2_1 - 0.5 * p1_11_1
        a_9_1 = E4_2_3 * p_4_0 + E4_2_4 * a_5_1 + E4_2_5 * p_4_2
        residual_4_1 = M4_1 - a_9_1
        M4_2 = 1.5 * p1_6_2_2 - 0.5 * p1_11_2
        a_9_2 = E4_2_6 * p_4_0 + E4_2_7 * a_5_1 + E4_2_8 * p_4_2
        residual_4_2 = M4_2 - a_9_2
        s_p1_0_seen = s_p1_0
        s_p1_1_seen = s_p1_1
        s_p1_2_seen = s_p1_2
        total = (
            residual_0
            + residual_1
            + residual_2
            + residual_2_0
            + residual_2_1
            + residual_2_2
            + residual_3_0
            + residual_3_1
            + residual_3_2
            + residual_4_0
            + residual_4_1
            + residual_4_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
        if make_1:
            w165 = 0.165 * xi1_2
            w166 = (
                0.08333333333333333 * g02 * mu0
                + 0.08333333333333333 * g12 * mu1
                + 0.08333333333333333 * g22 * mu2
            )
            w167 = 0.165 * xi1_1
            w168 = (
                -0.08333333333333333 * g01 * mu0
                - 0.08333333333333333 * g11 * mu1
                - 0.08333333333333333 * g21 * mu2
            )
            w169 = -0.66 * h
            w170 = 0.33 * h
            w171 = xi3_2 * w170
            w172 = xi3_1 * w170
            w173 = 0.165 * xi4_2
            w174 = (
                -0.08333333333333333 * g02 * mu0
                - 0.08333333333333333 * g12 * mu1
                - 0.08333333333333333 * g22 * mu2
            )
            w175 = 0.165 * xi4_1
            w176 = (
                0.08333333333333333 * g01 * mu0
                + 0.08333333333333333 * g11 * mu1
                + 0.08333333333333333 * g21 * mu2
            )
            w177 = -0.16666666666666666 * xi1_2
            w178 = -0.16666666666666666 * xi1_0
            w179 = (
                0.08333333333333333 * g00 * mu0
                + 0.08333333333333333 * g10 * mu1
                + 0.08333333333333333 * g20 * mu2
            )
            w180 = 0.6666666666666666 * h
            w181 = -0.3333333333333333 * h
            w182 = xi3_2 * w181
            w183 = xi3_0 * w181
            w184 = -0.16666666666666666 * xi4_2
            w185 = -0.16666666666666666 * xi4_0
            w186 = (
                -0.08333333333333333 * g00 * mu0
                - 0.08333333333333333 * g10 * mu1
                - 0.08333333333333333 * g20 * mu2
            )
            w187 = 0.0016666666666666668 * xi1_1
            w188 = 0.0016666666666666668 * xi1_0
            w189 = -0.006666666666666667 * h
            w190 = 0.0033333333333333335 * h
            w191 = xi3_1 * w190
            w192 = xi3_0 * w190
            w193 = 0.0016666666666666668 * xi4_1
            w194 = 0.0016666666666666668 * xi4_0
            w195 = (
                0.16666666666666666 * g02 * mu0
                + 0.16666666666666666 * g12 * mu1
                + 0.16666666666666666 * g22 * mu2
            )
            w196 = w165 + w195
            w197 = (
                -0.16666666666666666 * g01 * mu0
                - 0.16666666666666666 * g11 * mu1
                - 0.16666666666666666 * g21 * mu2
            )
            w198 = w167 + w197
            w199 = 0.33 * xi2_2
            w200 = -0.005 * xi1_2
            w201 = 0.33 * xi2_1
            w202 = 0.5 * xi1_1
            w203 = 0.165 * h
            w204 = xi4_2 * w203
            w205 = xi4_1 * w203
            w206 = (
                -0.16666666666666666 * g02 * mu0
                - 0.16666666666666666 * g12 * mu1
                - 0.16666666666666666 * g22 * mu2
            )
            w207 = w177 + w206
            w208 = (
                0.16666666666666666 * g00 * mu0
                + 0.16666666666666666 * g10 * mu1
                + 0.16666666666666666 * g20 * mu2
            )
            w209 = w178 + w208
            w210 = -0.3333333333333333 * xi2_2
            w211 = -0.3333333333333333 * xi2_0
            w212 = -0.495 * xi1_0
            w213 = xi4_2 * w116
            w214 = xi4_0 * w116
            w215 = (
                0.16666666666666666 * g01 * mu0
                + 0.16666666666666666 * g11 * mu1
                + 0.16666666666666666 * g21 * mu2
            )
            w216 = w187 + w215
            w217 = (
                -0.16666666666666666 * g00 * mu0
                - 0.16666666666666666 * g10 * mu1
                - 0.16666666666666666 * g20 * mu2
            )
            w218 = w188 + w217
            w219 = 0.0033333333333333335 * xi2_1
            w220 = 0.0033333333333333335 * xi2_0
            w221 = 0.0016666666666666668 * h
            w222 = xi4_1 * w221
            w223 = xi4_0 * w221
            w224 = 0.33 * xi3_2
            w225 = -0.005 * xi2_2
            w226 = 0.33 * xi3_1
            w227 = 0.5 * xi2_1
            w228 = -0.33 * h
            w229 = -0.3333333333333333 * xi3_2
            w230 = -0.3333333333333333 * xi3_0
            w231 = -0.495 * xi2_0
            w232 = 0.0033333333333333335 * xi3_1
            w233 = 0.0033333333333333335 * xi3_0
            w234 = -0.0033333333333333335 * h
            w235 = h * (0.25 * g02 * mu0 + 0.25 * g12 * mu1 + 0.25 * g22 * mu2 + w165)
            w236 = h * (-0.25 * g01 * mu0 - 0.25 * g11 * mu1 - 0.25 * g21 * mu2 + w167)
            w237 = (
                0.3333333333333333 * g02 * mu0
                + 0.3333333333333333 * g12 * mu1
                + 0.3333333333333333 * g22 * mu2
            )
            w238 = (
                -0.3333333333333333 * g01 * mu0
                - 0.3333333333333333 * g11 * mu1
                - 0.3333333333333333 * g21 * mu2
            )
            w239 = -0.01 * xi3_2
            w240 = h * (-0.25 * g02 * mu0 - 0.25 * g12 * mu1 - 0.25 * g22 * mu2 + w177)
            w241 = h * (0.25 * g00 * mu0 + 0.25 * g10 * mu1 + 0.25 * g20 * mu2 + w178)
            w242 = (
                -0.3333333333333333 * g02 * mu0
                - 0.3333333333333333 * g12 * mu1
                - 0.3333333333333333 * g22 * mu2
            )
            w243 = (
                0.3333333333333333 * g00 * mu0
                + 0.3333333333333333 * g10 * mu1
                + 0.3333333333333333 * g20 * mu2
            )
            w244 = -0.99 * xi3_0
            w245 = h * (0.25 * g01 * mu0 + 0.25 * g11 * mu1 + 0.25 * g21 * mu2 + w187)
            w246 = h * (-0.25 * g00 * mu0 - 0.25 * g10 * mu1 - 0.25 * g20 * mu2 + w188)
            w247 = (
                0.3333333333333333 * g01 * mu0
                + 0.3333333333333333 * g11 * mu1
                + 0.3333333333333333 * g21 * mu2
            )
            w248 = (
                -0.3333333333333333 * g00 * mu0
                - 0.3333333333333333 * g10 * mu1
                - 0.3333333333333333 * g20 * mu2
            )
            row_1_1 = [
                1.01,
                -h * (w165 + w166),
                -h * (w167 + w168),
                0.0,
                -xi2_2 * w169,
                -xi2_1 * w169,
                0.0,
                -w171,
                -w172,
                0.0,
                -h * (w173 + w174),
                -h * (w175 + w176),
            ]
            row_1_2 = [
                -h * (w174 + w177),
                1.0,
                -h * (w178 + w179),
                -xi2_2 * w180,
                0.0,
                -xi2_0 * w180,
                -w182,
                0.0,
                -w183,
                -h * (w166 + w184),
                0.0,
                -h * (w185 + w186),
            ]
            row_1_3 = [
                -h * (w176 + w187),
                -h * (w186 + w188),
                0.01,
                -xi2_1 * w189,
                -xi2_0 * w189,
                0.0,
                -w191,
                -w192,
                0.0,
                -h * (w168 + w193),
                -h * (w179 + w194),
                0.0,
            ]
            row_1_4 = [
                0.0,
                -h * (0.5 * xi2_2 + w196),
                -h * (w198 - 0.005 * xi2_1),
                1.01,
                -h * (w195 + w200 + w199),
                -h * (w197 + w202 + w201),
                0.0,
                -h * (w195 - 0.165 * xi3_2),
                -h * (w197 - 0.165 * xi3_1),
                0.0,
                -w204,
                -w205,
            ]
            row_1_5 = [
                -h * (w207 - 0.495 * xi2_2),
                0.0,
                -h * (w209 - 0.005 * xi2_0),
                -h * (w200 + w206 + w210),
                1.0,
                -h * (w208 + w212 + w211),
                -h * (0.16666666666666666 * xi3_2 + w206),
                0.0,
                -h * (0.16666666666666666 * xi3_0 + w208),
                -w213,
                0.0,
                -w214,
            ]
            row_1_6 = [
                -h * (w216 - 0.495 * xi2_1),
                -h * (0.5 * xi2_0 + w218),
                0.0,
                -h * (w202 + w215 + w219),
                -h * (w212 + w217 + w220),
                0.01,
                -h * (w215 - 0.0016666666666666668 * xi3_1),
                -h * (w217 - 0.0016666666666666668 * xi3_0),
                0.0,
                -w222,
                -w223,
                0.0,
            ]
            row_1_7 = [
                0.0,
                -h * w196,
                -h * w198,
                0.0,
                -h * (w195 + w199 + 0.5 * xi3_2),
                -h * (w197 + w201 - 0.005 * xi3_1),
                1.01,
                -h * (w195 + w225 + w224),
                -h * (w197 + w227 + w226),
                0.0,
                -xi4_2 * w228,
                -xi4_1 * w228,
            ]
            row_1_8 = [
                -h * w207,
                0.0,
                -h * w209,
                -h * (w206 + w210 - 0.495 * xi3_2),
                0.0,
                -h * (w208 + w211 - 0.005 * xi3_0),
                -h * (w206 + w225 + w229),
                1.0,
                -h * (w208 + w231 + w230),
                -xi4_2 * w113,
                0.0,
                -xi4_0 * w113,
            ]
            row_1_9 = [
                -h * w216,
                -h * w218,
                0.0,
                -h * (w215 + w219 - 0.495 * xi3_1),
                -h * (w217 + w220 + 0.5 * xi3_0),
                0.0,
                -h * (w215 + w227 + w232),
                -h * (w217 + w231 + w233),
                0.01,
                -xi4_1 * w234,
                -xi4_0 * w234,
                0.0,
            ]
            row_1_10 = [
                0.0,
                -w235,
                -w236,
                0.0,
                -h * (w199 + w237),
                -h * (w201 + w238),
                0.0,
                -h * (w224 + w237 + xi4_2),
                -h * (w226 + w238 - 0.01 * xi4_1),
                1.01,
                -h * (w166 + w239 + w173),
                -h * (xi3_1 + w168 + w175),
            ]
            row_1_11 = [
                -w240,
                0.0,
                -w241,
                -h * (w210 + w242),
                0.0,
                -h * (w211 + w243),
                -h * (w229 + w242 - 0.99 * xi4_2),
                0.0,
                -h * (w230 + w243 - 0.01 * xi4_0),
                -h * (w174 + w239 + w184),
                1.0,
                -h * (w179 + w244 + w185),
            ]
            row_1_12 = [
                -w245,
                -w246,
                0.0,
                -h * (w219 + w247),
                -h * (w220 + w248),
                0.0,
                -h * (w232 + w247 - 0.99 * xi4_1),
                -h * (w233 + w248 + xi4_0),
                0.0,
                -h * (xi3_1 + w176 + w193),
                -h * (w186 + w244 + w194),
                0.01,
            ]
            memory.inverses[0] = invert([row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6, row_1_7, row_1_8, row_1_9, row_1_10, row_1_11, row_1_12])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[0] is None:
                raise _failed(NOT_CONVERGED, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
        (
            row_1_1,
            row_1_2,
            row_1_3,
            row_1_4,
            row_1_5,
            row_1_6,
            row_1_7,
            row_1_8,
            row_1_9,
            row_1_10,
            row_1_11,
            row_1_12,
        ) = memory.inverses[0]
        d_xi1_0 = (
            row_1_1[0] * residual_0
            + row_1_1[1] * residual_1
            + row_1_1[2] * residual_2
            + row_1_1[3] * residual_2_0
            + row_1_1[4] * residual_2_1
            + row_1_1[5] * residual_2_2
            + row_1_1[6] * residual_3_0
            + row_1_1[7] * residual_3_1
            + row_1_1[8] * residual_3_2
            + row_1_1[9] * residual_4_0
            + row_1_1[10] * residual_4_1
            + row_1_1[11] * residual_4_2
        )
        d_xi1_1 = (
            row_1_2[0] * residual_0
            + row_1_2[1] * residual_1
            + row_1_2[2] * residual_2
            + row_1_2[3] * residual_2_0
            + row_1_2[4] * residual_2_1
            + row_1_2[5] * residual_2_2
            + row_1_2[6] * residual_3_0
            + row_1_2[7] * residual_3_1
            + row_1_2[8] * residual_3_2
            + row_1_2[9] * residual_4_0
            + row_1_2[10] * residual_4_1
            + row_1_2[11] * residual_4_2
        )
        d_xi1_2 = (
            row_1_3[0] * residual_0
            + row_1_3[1] * residual_1
            + row_1_3[2] * residual_2
            + row_1_3[3] * residual_2_0
            + row_1_3[4] * residual_2_1
            + row_1_3[5] * residual_2_2
            + row_1_3[6] * residual_3_0
            + row_1_3[7] * residual_3_1
            + row_1_3[8] * residual_3_2
            + row_1_3[9] * residual_4_0
            + row_1_3[10] * residual_4_1
            + row_1_3[11] * residual_4_2
        )
        d_xi2_0 = (
            row_1_4[0] * residual_0
            + row_1_4[1] * residual_1
            + row_1_4[2] * residual_2
            + row_1_4[3] * residual_2_0
            + row_1_4[4] * residual_2_1
            + row_1_4[5] * residual_2_2
            + row_1_4[6] * residual_3_0
            + row_1_4[7] * residual_3_1
            + row_1_4[8] * residual_3_2
            + row_1_4[9] * residual_4_0
            + row_1_4[10] * residual_4_1
            + row_1_4[11] * residual_4_2
        )
        d_xi2_1 = (
            row_1_5[0] * residual_0
            + row_1_5[1] * residual_1
            + row_1_5[2] * residual_2
            + row_1_5[3] * residual_2_0
            + row_1_5[4] * residual_2_1
            + row_1_5[5] * residual_2_2
            + row_1_5[6] * residual_3_0
            + row_1_5[7] * residual_3_1
            + row_1_5[8] * residual_3_2
            + row_1_5[9] * residual_4_0
            + row_1_5[10] * residual_4_1
            + row_1_5[11] * residual_4_2
        )
        d_xi2_2 = (
            row_1_6[0] * residual_0
            + row_1_6[1] * residual_1
            + row_1_6[2] * residual_2
            + row_1_6[3] * residual_2_0
            + row_1_6[4] * residual_2_1
            + row_1_6[5] * residual_2_2
            + row_1_6[6] * residual_3_0
            + row_1_6[7] * residual_3_1
            + row_1_6[8] * residual_3_2
            + row_1_6[9] * residual_4_0
            + row_1_6[10] * residual_4_1
            + row_1_6[11] * residual_4_2
        )
        d_xi3_0 = (
            row_1_7[0] * residual_0
            + row_1_7[1] * residual_1
            + row_1_7[2] * residual_2
            + row_1_7[3] * residual_2_0
            + row_1_7[4] * residual_2_1
            + row_1_7[5] * residual_2_2
            + row_1_7[6] * residual_3_0
            + row_1_7[7] * residual_3_1
            + row_1_7[8] * residual_3_2
            + row_1_7[9] * residual_4_0
            + row_1_7[10] * residual_4_1
            + row_1_7[11] * residual_4_2
        )
        d_xi3_1 = (
            row_1_8[0] * residual_0
            + row_1_8[1] * residual_1
            + row_1_8[2] * residual_2
            + row_1_8[3] * residual_2_0
            + row_1_8[4] * residual_2_1
            + row_1_8[5] * residual_2_2
            + row_1_8[6] * residual_3_0
            + row_1_8[7] * residual_3_1
            + row_1_8[8] * residual_3_2
            + row_1_8[9] * residual_4_0
            + row_1_8[10] * residual_4_1
            + row_1_8[11] * residual_4_2
        )
        d_xi3_2 = (
            row_1_9[0] * residual_0
            + row_1_9[1] * residual_1
            + row_1_9[2] * residual_2
            + row_1_9[3] * residual_2_0
            + row_1_9[4] * residual_2_1
            + row_1_9[5] * residual_2_2
            + row_1_9[6] * residual_3_0
            + row_1_9[7] * residual_3_1
            + row_1_9[8] * residual_3_2
            + row_1_9[9] * residual_4_0
            + row_1_9[10] * residual_4_1
            + row_1_9[11] * residual_4_2
        )
        d_xi4_0 = (
            row_1_10[0] * residual_0
            + row_1_10[1] * residual_1
            + row_1_10[2] * residual_2
            + row_1_10[3] * residual_2_0
            + row_1_10[4] * residual_2_1
            + row_1_10[5] * residual_2_2
            + row_1_10[6] * residual_3_0
            + row_1_10[7] * residual_3_1
            + row_1_10[8] * residual_3_2
            + row_1_10[9] * residual_4_0
            + row_1_10[10] * residual_4_1
            + row_1_10[11] * residual_4_2
        )
        d_xi4_1 = (
            row_1_11[0] * residual_0
            + row_1_11[1] * residual_1
            + row_1_11[2] * residual_2
            + row_1_11[3] * residual_2_0
            + row_1_11[4] * residual_2_1
            + row_1_11[5] * residual_2_2
            + row_1_11[6] * residual_3_0
            + row_1_11[7] * residual_3_1
            + row_1_11[8] * residual_3_2
            + row_1_11[9] * residual_4_0
            + row_1_11[10] * residual_4_1
            + row_1_11[11] * residual_4_2
        )
        d_xi4_2 = (
            row_1_12[0] * residual_0
            + row_1_12[1] * residual_1
            + row_1_12[2] * residual_2
            + row_1_12[3] * residual_2_0
            + row_1_12[4] * residual_2_1
            + row_1_12[5] * residual_2_2
            + row_1_12[6] * residual_3_0
            + row_1_12[7] * residual_3_1
            + row_1_12[8] * residual_3_2
            + row_1_12[9] * residual_4_0
            + row_1_12[10] * residual_4_1
            + row_1_12[11] * residual_4_2
        )
        xi1_0 += d_xi1_0
        xi1_1 += d_xi1_1
        xi1_2 += d_xi1_2
        xi2_0 += d_xi2_0
        xi2_1 += d_xi2_1
        xi2_2 += d_xi2_2
        xi3_0 += d_xi3_0
        xi3_1 += d_xi3_1
        xi3_2 += d_xi3_2
        xi4_0 += d_xi4_0
        xi4_1 += d_xi4_1
        xi4_2 += d_xi4_2
        change = max(
            abs(d_xi1_0),
            abs(d_xi1_1),
            abs(d_xi1_2),
            abs(d_xi2_0),
            abs(d_xi2_1),
            abs(d_xi2_2),
            abs(d_xi3_0),
            abs(d_xi3_1),
            abs(d_xi3_2),
            abs(d_xi4_0),
            abs(d_xi4_1),
            abs(d_xi4_2),
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
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        if sweep == 1:
            memory.first = max(memory.first, change)
        if previous_1 > 0.0:
            rate_1 = max(change / previous_1, 0.000244140625)
        close = change * rate_1 <= 1.1102230246251565e-16 * scale
        if still or (close and change <= 5.684341886080802e-14 * scale):
            memory.rates[0] = rate_1 if sweep > 1 else 2.0 * rate_1
            break
        make_1 = 0.0 < 0.25 * previous_1 < change
        previous_1 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    w249 = xi2_1 + xi3_1
    w250 = w60 * w249
    xe1_1_ = xi1_1 * w131 + w250 + xi4_1 * w133
    w251 = xi2_0 + xi3_0
    w252 = w60 * w251
    xe1_0_ = xi1_0 * w131 + w252 + xi4_0 * w133
    w253 = xi2_2 + xi3_2
    w254 = w60 * w253
    xe1_2_ = xi1_2 * w131 + w254 + xi4_2 * w133
    w255 = xe1_0_ * xe1_0_ + xe1_1_ * xe1_1_ + xe1_2_ * xe1_2_
    c1_5, c2_10 = _stumpff_12(w255)
    w257 = xe1_1_ * c2_10
    w258 = xe1_1_ * w257
    w259 = xe1_2_ * c2_10 * xe1_2_
    ge1_0_ = 1.0 - (w258 + w259)
    xe2_1 = w250 + xi1_1 * w133 + xi4_1 * w131
    xe2_0 = w252 + xi1_0 * w133 + xi4_0 * w131
    xe2_2 = w254 + xi1_2 * w133 + xi4_2 * w131
    w260 = xe2_0 * xe2_0 + xe2_1 * xe2_1 + xe2_2 * xe2_2
    c1_6, c2_11 = _stumpff_12(w260)
    w262 = xe2_1 * c2_11
    w263 = xe2_1 * w262
    w264 = xe2_2 * c2_11 * xe2_2
    ge2_0 = 1.0 - (w263 + w264)
    w266 = xe1_2_ * c1_5
    w267 = xe1_0_ * c2_10
    w268 = xe1_1_ * w267
    ge1_3_ = w266 + w268
    w269 = xe2_0 * c2_11
    w270 = xe2_1 * w269
    w272 = xe2_2 * c1_6
    ge2_1 = w270 - w272
    w273 = xe1_2_ * w267
    w274 = xe1_1_ * c1_5
    ge1_6_ = w273 - w274
    w275 = xe2_1 * c1_6
    w276 = xe2_2 * w269
    ge2_2 = w275 + w276
    e2_0 = ge1_0_ * ge2_0 + ge1_3_ * ge2_1 + ge1_6_ * ge2_2
    ge2_3 = w270 + w272
    w277 = xe2_0 * w269
    ge2_4 = 1.0 - (w264 + w277)
    w278 = xe2_2 * w262
    w279 = xe2_0 * c1_6
    ge2_5 = w278 - w279
    e2_3 = ge1_0_ * ge2_3 + ge1_3_ * ge2_4 + ge1_6_ * ge2_5
    ge2_6 = w276 - w275
    ge2_7 = w278 + w279
    ge2_8 = 1.0 - (w263 + w277)
    e2_6 = ge1_0_ * ge2_6 + ge1_3_ * ge2_7 + ge1_6_ * ge2_8
    ge1_1_ = w268 - w266
    w280 = xe1_0_ * w267
    ge1_4_ = 1.0 - (w259 + w280)
    w281 = xe1_0_ * c1_5
    w282 = xe1_2_ * w257
    ge1_7_ = w281 + w282
    e2_1 = ge2_0 * ge1_1_ + ge2_1 * ge1_4_ + ge2_2 * ge1_7_
    e2_4 = ge2_3 * ge1_1_ + ge2_4 * ge1_4_ + ge2_5 * ge1_7_
    e2_7 = ge2_6 * ge1_1_ + ge2_7 * ge1_4_ + ge2_8 * ge1_7_
    ge1_2_ = w273 + w274
    ge1_5_ = w282 - w281
    ge1_8_ = 1.0 - (w258 + w280)
    e2_2 = ge2_0 * ge1_2_ + ge2_1 * ge1_5_ + ge2_2 * ge1_8_
    e2_5 = ge2_3 * ge1_2_ + ge2_4 * ge1_5_ + ge2_5 * ge1_8_
    e2_8 = ge2_6 * ge1_2_ + ge2_7 * ge1_5_ + ge2_8 * ge1_8_
    w283 = 0.165 * h
    w284 = 0.33 * h
    w285 = (
        s_p1_0_seen
        + xi1_2 * w283 * d_xi1_1
        + xi1_1 * w283 * d_xi1_2
        + xi2_2 * w284 * d_xi2_1
        + xi2_1 * w284 * d_xi2_2
    )
    w286 = xi3_2 * w284
    w287 = xi3_1 * w284
    w288 = xi4_2 * w283
    w289 = xi4_1 * w283
    w290 = w285 + d_xi3_1 * w286 + d_xi3_2 * w287 + d_xi4_1 * w288 + d_xi4_2 * w289
    w291 = -0.3333333333333333 * h
    w292 = (
        s_p1_1_seen
        + xi1_2 * w116 * d_xi1_0
        + xi1_0 * w116 * d_xi1_2
        + xi2_2 * w291 * d_xi2_0
        + xi2_0 * w291 * d_xi2_2
    )
    w293 = xi3_2 * w291
    w294 = xi3_0 * w291
    w295 = xi4_2 * w116
    w296 = xi4_0 * w116
    w297 = w292 + d_xi3_0 * w293 + d_xi3_2 * w294 + d_xi4_0 * w295 + d_xi4_2 * w296
    w298 = 0.0016666666666666668 * h
    w299 = 0.0033333333333333335 * h
    w300 = (
        s_p1_2_seen
        + xi1_1 * w298 * d_xi1_0
        + xi1_0 * w298 * d_xi1_1
        + xi2_1 * w299 * d_xi2_0
        + xi2_0 * w299 * d_xi2_1
    )
    w301 = xi3_1 * w299
    w302 = xi3_0 * w299
    w303 = xi4_1 * w298
    w304 = xi4_0 * w298
    w305 = w300 + d_xi3_0 * w301 + d_xi3_1 * w302 + d_xi4_0 * w303 + d_xi4_1 * w304
    change_0 = e2_0 * w290 + e2_1 * w297 + e2_2 * w305 - m_0
    change_1 = e2_3 * w290 + e2_4 * w297 + e2_5 * w305 - m_1
    change_2 = e2_6 * w290 + e2_7 * w297 + e2_8 * w305 - m_2
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
