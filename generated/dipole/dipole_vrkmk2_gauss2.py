"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2

method:     family vrkmk(2), tableau gauss2
source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1;
            Table 3.1c of Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of v1, v2, m1, m2: Newton's method with the matrix to
            first order in h, 6 unknowns (1.9 sweeps of 957 operations and 1.00
            matrices of 671 a step; fixed point: 3.3 sweeps of 891 operations;
            Newton's method: 2.6 sweeps of 957 operations and 0.05 matrices of 5374)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   7 dexpt, 1 lin (sharing)
            1 dexpt, 2 lin (dead code)
            2 dexpt (common sums)
            1 lin (sharing)
            3 hamilton (body frame)
            2 Adt (opposites)
            1 force, 1 lin (dead code)
            2 Adinv, 2 Adt, 2 dexpinv, 2 dexpinvt, 3 dexpt (functions)
            2 legendre, 2 lin, 2 series, 2 seriest (sharing)
            2 Ad, 4 Adtinv, 2 seriest (factors)
            2 lin (scalars)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 54 add, 74 mul, 1 stumpff_1 a step
            2 mul a start, in steps that follow no other
            102 add, 137 mul a matrix of the equations of v1, v2, m1, m2
            339 add, 489 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of
            the equations of v1, v2, m1, m2
made by:    orderconds emit dipole --method 'vrkmk(2):gauss2' --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vrkmk2_gauss2

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vrkmk2_gauss2.run(state, 0.005, 100))
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


def _stumpff_1_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 1.0:
        return _stumpff_series_1(z)
    s = sqrt(z if z <= 4503599627370496.0 else float("nan"))
    return sin(s) / s


def _stumpff_123_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return ratio * cos(half), 0.5 * (ratio * ratio), c3


def _stumpff_123(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z), _stumpff_small_3(z)
    return _stumpff_123_far(z)


def _stumpff_1(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 0.0625:
        return _stumpff_small_1(z)
    return _stumpff_1_far(z)


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
        v1_0, v1_1, v1_2, v2_0, v2_1, v2_2 = memory.extrapolated()
    else:
        Wxi0_0 = 0.9900990099009901 * m_0
        Wxi0_2 = 100.0 * m_2
        v1_0 = Wxi0_0
        v1_1 = m_1
        v1_2 = Wxi0_2
        v2_0 = Wxi0_0
        v2_1 = m_1
        v2_2 = Wxi0_2
    w69 = 0.5 * h
    w70 = 0.5386751345948129 * h
    w71 = 0.25 * h
    w104 = -0.03867513459481288 * h
    w158 = -0.5386751345948129 * h
    w172 = -0.25 * h
    w187 = -0.25 * h
    w188 = 0.03867513459481288 * h
    # the equations of v1, v2, m1, m2: Newton's method with the matrix to first order in h in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    w1 = -0.24752475247524752 * h
    w2 = m_2 * w1
    w3 = 50.0 * m_2 * h
    w4 = w3 - 0.49504950495049505 * m_2 * h
    w5 = 0.25 * w4
    w6 = -0.24752475247524752 * h
    w7 = 0.005 * v1_2 - 0.5 * v1_2
    w8 = 0.99 * v1_2
    w9 = 0.49504950495049505 * h
    w10 = w6 + w9
    w11 = m_1 * w1
    w12 = 0.5 * m_1 * h
    w13 = w12 - 0.49504950495049505 * m_1 * h
    w14 = -0.25 * w13
    w15 = 0.005 * v1_1 - 0.5 * v1_1
    w16 = 0.99 * v1_1
    w17 = -0.5333417174206068 * h
    w18 = 0.005 * v2_2 - 0.5 * v2_2
    w19 = 0.99 * v2_2
    w20 = w9 + w17
    w21 = 0.005 * v2_1 - 0.5 * v2_1
    w22 = 0.99 * v2_1
    w23 = -0.25 * h
    w24 = m_2 * w23
    w25 = w3 - 0.5 * m_2 * h
    w26 = -0.25 * w25
    w27 = -0.25 * h
    w28 = 0.505 * v1_2 - 0.005 * v1_2
    w29 = 0.5 * h
    w30 = w27 + w29
    w31 = m_0 * w23
    w32 = 0.49504950495049505 * m_0 * h
    w33 = w32 - 0.5 * m_0 * h
    w34 = 0.25 * w33
    w35 = 0.505 * v1_0 - 0.005 * v1_0
    w36 = -0.5386751345948129 * h
    w37 = 0.505 * v2_2 - 0.005 * v2_2
    w38 = w29 + w36
    w39 = 0.505 * v2_0 - 0.005 * v2_0
    w40 = -25.0 * h
    w41 = m_1 * w40
    w42 = w12 - 50.0 * m_1 * h
    w43 = 0.25 * w42
    w44 = -25.0 * h
    w45 = 0.5 * v1_1 - 0.505 * v1_1
    w46 = 0.01 * v1_1
    w47 = 50.0 * h
    w48 = w44 + w47
    w49 = m_0 * w40
    w50 = w32 - 50.0 * m_0 * h
    w51 = -0.25 * w50
    w52 = 0.5 * v1_0 - 0.505 * v1_0
    w53 = 0.01 * v1_0
    w54 = -53.86751345948129 * h
    w55 = 0.5 * v2_1 - 0.505 * v2_1
    w56 = 0.01 * v2_1
    w57 = w47 + w54
    w58 = 0.5 * v2_0 - 0.505 * v2_0
    w59 = 0.01 * v2_0
    w60 = 0.03829221247011177 * h
    w61 = w9 + w60
    w62 = w1 + w9
    w63 = 0.03867513459481288 * h
    w64 = w29 + w63
    w65 = w23 + w29
    w66 = 3.8675134594812883 * h
    w67 = w47 + w66
    w68 = w40 + w47
    row_1_1 = [
        1.0,
        w2 - (w5 + w6 * w7 + w8 * w10),
        -(w14 + w6 * w15 + w10 * w16 + w11),
        0.0,
        w2 - (w17 * w18 - 0.03867513459481288 * w4 + w19 * w20),
        -(0.03867513459481288 * w13 + w17 * w21 + w20 * w22 + w11),
    ]
    row_1_2 = [
        -(w26 + w27 * w28 - v1_2 * w30 + w24),
        1.0,
        w31 - (w34 + w27 * w35 - v1_0 * w30),
        -(0.03867513459481288 * w25 + w36 * w37 - v2_2 * w38 + w24),
        0.0,
        w31 - (w36 * w39 - 0.03867513459481288 * w33 - v2_0 * w38),
    ]
    row_1_3 = [
        w41 - (w43 + w44 * w45 + w46 * w48),
        -(w51 + w44 * w52 + w48 * w53 + w49),
        1.0,
        w41 - (w54 * w55 - 0.03867513459481288 * w42 + w56 * w57),
        -(0.03867513459481288 * w50 + w54 * w58 + w57 * w59 + w49),
        0.0,
    ]
    row_1_4 = [
        0.0,
        w2 - (0.5386751345948129 * w4 + w7 * w60 + w8 * w61),
        -(w15 * w60 - 0.5386751345948129 * w13 + w16 * w61 + w11),
        1.0,
        w2 - (w5 + w1 * w18 + w19 * w62),
        -(w14 + w1 * w21 + w22 * w62 + w11),
    ]
    row_1_5 = [
        -(w28 * w63 - 0.5386751345948129 * w25 - v1_2 * w64 + w24),
        0.0,
        w31 - (0.5386751345948129 * w33 + w35 * w63 - v1_0 * w64),
        -(w26 + w23 * w37 - v2_2 * w65 + w24),
        1.0,
        w31 - (w34 + w23 * w39 - v2_0 * w65),
    ]
    row_1_6 = [
        w41 - (0.5386751345948129 * w42 + w45 * w66 + w46 * w67),
        -(w52 * w66 - 0.5386751345948129 * w50 + w53 * w67 + w49),
        0.0,
        w41 - (w43 + w40 * w55 + w56 * w68),
        -(w51 + w40 * w58 + w59 * w68 + w49),
        1.0,
    ]
    inverse_1 = invert([row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6])
    if inverse_1 is None:
        raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, 0, statistics)
    row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6 = inverse_1
    for sweep in range(1, 101):
        X2_0 = v1_0 * w70 + v2_0 * w71
        X2_1 = v1_1 * w70 + v2_1 * w71
        w72 = v2_1 * X2_0 - v2_0 * X2_1
        X2_2 = v1_2 * w70 + v2_2 * w71
        w73 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2
        c1_1, c2_1, c3_1 = _stumpff_123(w73)
        w75 = 1.0 - 0.08333333333333333 * w73
        w76 = 1.0 / (w75 * w75 + 0.25 * w73)
        w77 = w76 * (0.25 - 0.08333333333333333 * w75)
        w79 = -0.5 * w76
        w80 = w73 * (w77 * c1_1 + w79 * c2_1) - (w79 + c1_1)
        w81 = v2_0 * X2_2 - v2_2 * X2_0
        w82 = v2_2 * X2_1 - v2_1 * X2_2
        w83 = X2_0 * w81 - X2_1 * w82
        w84 = w77 + c2_1 + w79 * c1_1 - w77 * c2_1 * w73
        p_2_2 = 0.01 * (v2_2 + w72 * w80 + w83 * w84)
        w85 = X2_2 * w82 - X2_0 * w72
        a_6_1 = v2_1 + w80 * w81 + w84 * w85
        w86 = X2_0 * c2_1
        w87 = X2_1 * w86
        w88 = X2_2 * c1_1
        w89 = X2_0 * w86
        w90 = X2_2 * c2_1 * X2_2
        w91 = X2_0 * c1_1
        w92 = X2_1 * c2_1
        w93 = X2_2 * w92
        Q2_7 = g20 * (w87 - w88) + g21 * (1.0 - (w89 + w90)) + g22 * (w91 + w93)
        w94 = X2_1 * c1_1
        w95 = X2_2 * w86
        w96 = X2_1 * w92
        Q2_8 = g20 * (w94 + w95) + g21 * (w93 - w91) + g22 * (1.0 - (w89 + w96))
        w97 = 1.5 - 2.0 * Q2_8
        w98 = 1.0 / sqrt(1.01 + 1.5 * (w97 - 0.2 * Q2_7))
        w99 = w98 * w98 * (0.5 * w98)
        w100 = 1.0 / sqrt(1.01 + 1.5 * (w97 + 0.2 * Q2_7))
        w101 = w100 * w100 * (0.5 * w100)
        w102 = -1.0 - 2.0 * (1.5 * w99 - 1.5 * w101)
        w103 = -0.3 * w99 - 0.3 * w101
        Nn2_0 = Q2_7 * w102 - Q2_8 * w103 + 99.0 * a_6_1 * p_2_2
        X1_0 = v1_0 * w71 + v2_0 * w104
        X1_1 = v1_1 * w71 + v2_1 * w104
        w105 = v1_1 * X1_0 - v1_0 * X1_1
        X1_2 = v1_2 * w71 + v2_2 * w104
        w106 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
        c1_2, c2_2, c3_2 = _stumpff_123(w106)
        w108 = 1.0 - 0.08333333333333333 * w106
        w109 = 1.0 / (w108 * w108 + 0.25 * w106)
        w110 = w109 * (0.25 - 0.08333333333333333 * w108)
        w112 = -0.5 * w109
        w113 = w106 * (w110 * c1_2 + w112 * c2_2) - (w112 + c1_2)
        w114 = v1_0 * X1_2 - v1_2 * X1_0
        w115 = v1_2 * X1_1 - v1_1 * X1_2
        w116 = X1_0 * w114 - X1_1 * w115
        w117 = w110 + c2_2 + w112 * c1_2 - w110 * c2_2 * w106
        p_2 = 0.01 * (v1_2 + w105 * w113 + w116 * w117)
        w118 = X1_2 * w115 - X1_0 * w105
        a_2_1 = v1_1 + w113 * w114 + w117 * w118
        w119 = X1_0 * c2_2
        w120 = X1_1 * w119
        w121 = X1_2 * c1_2
        w122 = X1_0 * w119
        w123 = X1_2 * c2_2 * X1_2
        w124 = X1_0 * c1_2
        w125 = X1_1 * c2_2
        w126 = X1_2 * w125
        Q1_7 = g20 * (w120 - w121) + g21 * (1.0 - (w122 + w123)) + g22 * (w124 + w126)
        w127 = X1_1 * c1_2
        w128 = X1_2 * w119
        w129 = X1_1 * w125
        Q1_8 = g20 * (w127 + w128) + g21 * (w126 - w124) + g22 * (1.0 - (w122 + w129))
        w130 = 1.5 - 2.0 * Q1_8
        w131 = 1.0 / sqrt(1.01 + 1.5 * (w130 - 0.2 * Q1_7))
        w132 = w131 * w131 * (0.5 * w131)
        w133 = 1.0 / sqrt(1.01 + 1.5 * (w130 + 0.2 * Q1_7))
        w134 = w133 * w133 * (0.5 * w133)
        w135 = -1.0 - 2.0 * (1.5 * w132 - 1.5 * w134)
        w136 = -0.3 * w132 - 0.3 * w134
        Nn1_0 = Q1_7 * w135 - Q1_8 * w136 + 99.0 * a_2_1 * p_2
        s_L_0 = m_0 + w69 * (Nn2_0 + Nn1_0)
        Y_0 = (v1_0 + v2_0) * w69
        Y_1 = (v1_1 + v2_1) * w69
        Y_2 = (v1_2 + v2_2) * w69
        w137 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
        c2_3, c3_3 = _stumpff_23(w137)
        w138 = c2_3
        w139 = X2_1 * w72 - X2_2 * w81
        a_6_0 = v2_0 + w80 * w82 + w84 * w139
        Q2_6 = g20 * (1.0 - (w90 + w96)) + g21 * (w87 + w88) + g22 * (w95 - w94)
        Nn2_1 = -100.0 * a_6_0 * p_2_2 - w102 * Q2_6
        w140 = X1_1 * w105 - X1_2 * w114
        a_2_0 = v1_0 + w113 * w115 + w117 * w140
        Q1_6 = g20 * (1.0 - (w123 + w129)) + g21 * (w120 + w121) + g22 * (w128 - w127)
        Nn1_1 = -100.0 * a_2_0 * p_2 - w135 * Q1_6
        s_L_1 = m_1 + w69 * (Nn2_1 + Nn1_1)
        Nn2_2 = 0.01 * a_6_0 * a_6_1 + w103 * Q2_6
        Nn1_2 = 0.01 * a_2_0 * a_2_1 + w136 * Q1_6
        s_L_2 = m_2 + w69 * (Nn2_2 + Nn1_2)
        w141 = Y_2 * s_L_1 - Y_1 * s_L_2
        w143 = Y_0 * s_L_2 - s_L_0 * Y_2
        w144 = s_L_0 * Y_1 - Y_0 * s_L_1
        L_4_0 = s_L_0 - w138 * w141 + (Y_2 * w143 - Y_1 * w144) * c3_3
        w145 = X2_1 * Nn2_2 - X2_2 * Nn2_1
        w147 = X2_0 * Nn2_1 - X2_1 * Nn2_0
        w148 = X2_2 * Nn2_0 - X2_0 * Nn2_2
        p_2_0 = 1.01 * a_6_0
        w149 = X2_2 * p_2_0 - X2_0 * p_2_2
        w150 = X2_1 * p_2_2 - X2_2 * a_6_1
        w151 = X2_0 * a_6_1 - X2_1 * p_2_0
        a_8_1 = a_6_1 - w80 * w149 + w84 * (X2_2 * w150 - X2_0 * w151)
        a_5_2 = v2_2 - w72 * w79 + w77 * w83
        a_5_1 = v2_1 - w79 * w81 + w77 * w85
        a_5_0 = v2_0 - w79 * w82 + w77 * w139
        w152 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0)
        a_8_2 = p_2_2 - w80 * w151 + w84 * (X2_0 * w149 - X2_1 * w150)
        w153 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2)
        a_8_0 = p_2_0 - w80 * w150 + w84 * (X2_1 * w151 - X2_2 * w149)
        w154 = X2_0 * a_8_2 - X2_2 * a_8_0
        w155 = -0.08333333333333333 * a_5_2
        w156 = X2_1 * a_8_0 - X2_0 * a_8_1
        w157 = -0.08333333333333333 * a_5_1
        sum_d2_0 = (
            Nn2_0
            + w145 * c2_1
            + (X2_1 * w147 - X2_2 * w148) * c3_1
            - (a_8_1 * w152 - a_8_2 * w153 + (w154 * w155 - w156 * w157))
        )
        w159 = X1_1 * Nn1_2 - X1_2 * Nn1_1
        w161 = X1_0 * Nn1_1 - X1_1 * Nn1_0
        w162 = X1_2 * Nn1_0 - X1_0 * Nn1_2
        p_0 = 1.01 * a_2_0
        w163 = X1_2 * p_0 - X1_0 * p_2
        w164 = X1_1 * p_2 - X1_2 * a_2_1
        w165 = X1_0 * a_2_1 - X1_1 * p_0
        a_4_1 = a_2_1 - w113 * w163 + w117 * (X1_2 * w164 - X1_0 * w165)
        a_2 = v1_2 - w105 * w112 + w110 * w116
        a_1 = v1_1 - w112 * w114 + w110 * w118
        a_0 = v1_0 - w112 * w115 + w110 * w140
        w166 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0)
        a_4_2 = p_2 - w113 * w165 + w117 * (X1_0 * w163 - X1_1 * w164)
        w167 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2)
        a_4_0 = p_0 - w113 * w164 + w117 * (X1_1 * w165 - X1_2 * w163)
        w168 = X1_0 * a_4_2 - X1_2 * a_4_0
        w169 = -0.08333333333333333 * a_2
        w170 = X1_1 * a_4_0 - X1_0 * a_4_1
        w171 = -0.08333333333333333 * a_1
        sum_d1_0 = (
            Nn1_0
            + w159 * c2_2
            + (X1_1 * w161 - X1_2 * w162) * c3_2
            - (a_4_1 * w166 - a_4_2 * w167 + (w168 * w169 - w170 * w171))
        )
        w1_0 = L_4_0 + sum_d2_0 * w158 + sum_d1_0 * w172
        w173 = c1_2 - 0.5 - w106 * (0.08333333333333333 * c1_2 - 0.5 * c2_2)
        L_4_2 = s_L_2 - w138 * w144 + (Y_1 * w141 - Y_0 * w143) * c3_3
        w174 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1)
        w175 = X2_2 * a_8_1 - X2_1 * a_8_2
        w176 = -0.08333333333333333 * a_5_0
        sum_d2_2 = (
            Nn2_2
            + w147 * c2_1
            + (X2_0 * w148 - X2_1 * w145) * c3_1
            - (w153 * a_8_0 - a_8_1 * w174 + (w157 * w175 - w154 * w176))
        )
        w177 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1)
        w178 = X1_2 * a_4_1 - X1_1 * a_4_2
        w179 = -0.08333333333333333 * a_0
        sum_d1_2 = (
            Nn1_2
            + w161 * c2_2
            + (X1_0 * w162 - X1_1 * w159) * c3_2
            - (w167 * a_4_0 - a_4_1 * w177 + (w171 * w178 - w168 * w179))
        )
        w1_2 = L_4_2 + w158 * sum_d2_2 + w172 * sum_d1_2
        L_4_1 = s_L_1 - w138 * w143 + (Y_0 * w144 - Y_2 * w141) * c3_3
        sum_d2_1 = (
            Nn2_1
            + w148 * c2_1
            + (X2_2 * w145 - X2_0 * w147) * c3_1
            - (a_8_2 * w174 - w152 * a_8_0 + (w156 * w176 - w155 * w175))
        )
        sum_d1_1 = (
            Nn1_1
            + w162 * c2_2
            + (X1_2 * w159 - X1_0 * w161) * c3_2
            - (a_4_2 * w177 - w166 * a_4_0 + (w170 * w179 - w169 * w178))
        )
        w1_1 = L_4_1 + w158 * sum_d2_1 + w172 * sum_d1_1
        w180 = X1_1 * w1_2 - X1_2 * w1_1
        w181 = (
            0.08333333333333333 + c2_2 - 0.5 * c1_2 - 0.08333333333333333 * c2_2 * w106
        )
        w182 = X1_0 * w1_1 - X1_1 * w1_0
        w183 = X1_2 * w1_0 - X1_0 * w1_2
        Wxi1_0 = (
            0.9900990099009901
            * (w1_0 - w173 * w180 + w181 * (X1_1 * w182 - X1_2 * w183))
        )
        Wxi1_2 = 100.0 * (w1_2 - w173 * w182 + w181 * (X1_0 * w183 - X1_1 * w180))
        Pxi1_1 = w1_1 - w173 * w183 + w181 * (X1_2 * w180 - X1_0 * w182)
        w184 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1
        w185 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0
        w186 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2
        w2_0 = L_4_0 + sum_d2_0 * w187 + sum_d1_0 * w188
        w189 = c1_1 - 0.5 - w73 * (0.08333333333333333 * c1_1 - 0.5 * c2_1)
        w2_2 = L_4_2 + sum_d2_2 * w187 + sum_d1_2 * w188
        w2_1 = L_4_1 + sum_d2_1 * w187 + sum_d1_1 * w188
        w190 = X2_1 * w2_2 - X2_2 * w2_1
        w191 = (
            0.08333333333333333 + c2_1 - 0.5 * c1_1 - 0.08333333333333333 * c2_1 * w73
        )
        w192 = X2_0 * w2_1 - X2_1 * w2_0
        w193 = X2_2 * w2_0 - X2_0 * w2_2
        Wxi2_0 = (
            0.9900990099009901
            * (w2_0 - w189 * w190 + w191 * (X2_1 * w192 - X2_2 * w193))
        )
        Wxi2_2 = 100.0 * (w2_2 - w189 * w192 + w191 * (X2_0 * w193 - X2_1 * w190))
        Pxi2_1 = w2_1 - w189 * w193 + w191 * (X2_2 * w190 - X2_0 * w192)
        w194 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1
        w195 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0
        w196 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2
        next_v1_0 = Wxi1_0 + w173 * w184 + w181 * (X1_1 * w185 - X1_2 * w186)
        next_v1_1 = Pxi1_1 + w173 * w186 + w181 * (X1_2 * w184 - X1_0 * w185)
        next_v1_2 = Wxi1_2 + w173 * w185 + w181 * (X1_0 * w186 - X1_1 * w184)
        next_v2_0 = Wxi2_0 + w189 * w194 + w191 * (X2_1 * w195 - X2_2 * w196)
        next_v2_1 = Pxi2_1 + w189 * w196 + w191 * (X2_2 * w194 - X2_0 * w195)
        next_v2_2 = Wxi2_2 + w189 * w195 + w191 * (X2_0 * w196 - X2_1 * w194)
        residual_v1_0 = next_v1_0 - v1_0
        residual_v1_1 = next_v1_1 - v1_1
        residual_v1_2 = next_v1_2 - v1_2
        residual_v2_0 = next_v2_0 - v2_0
        residual_v2_1 = next_v2_1 - v2_1
        residual_v2_2 = next_v2_2 - v2_2
        total = (
            residual_v1_0
            + residual_v1_1
            + residual_v1_2
            + residual_v2_0
            + residual_v2_1
            + residual_v2_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
        change_v1_0 = (
            row_1_1[0] * residual_v1_0
            + row_1_1[1] * residual_v1_1
            + row_1_1[2] * residual_v1_2
            + row_1_1[3] * residual_v2_0
            + row_1_1[4] * residual_v2_1
            + row_1_1[5] * residual_v2_2
        )
        change_v1_1 = (
            row_1_2[0] * residual_v1_0
            + row_1_2[1] * residual_v1_1
            + row_1_2[2] * residual_v1_2
            + row_1_2[3] * residual_v2_0
            + row_1_2[4] * residual_v2_1
            + row_1_2[5] * residual_v2_2
        )
        change_v1_2 = (
            row_1_3[0] * residual_v1_0
            + row_1_3[1] * residual_v1_1
            + row_1_3[2] * residual_v1_2
            + row_1_3[3] * residual_v2_0
            + row_1_3[4] * residual_v2_1
            + row_1_3[5] * residual_v2_2
        )
        change_v2_0 = (
            row_1_4[0] * residual_v1_0
            + row_1_4[1] * residual_v1_1
            + row_1_4[2] * residual_v1_2
            + row_1_4[3] * residual_v2_0
            + row_1_4[4] * residual_v2_1
            + row_1_4[5] * residual_v2_2
        )
        change_v2_1 = (
            row_1_5[0] * residual_v1_0
            + row_1_5[1] * residual_v1_1
            + row_1_5[2] * residual_v1_2
            + row_1_5[3] * residual_v2_0
            + row_1_5[4] * residual_v2_1
            + row_1_5[5] * residual_v2_2
        )
        change_v2_2 = (
            row_1_6[0] * residual_v1_0
            + row_1_6[1] * residual_v1_1
            + row_1_6[2] * residual_v1_2
            + row_1_6[3] * residual_v2_0
            + row_1_6[4] * residual_v2_1
            + row_1_6[5] * residual_v2_2
        )
        v1_0 += change_v1_0
        v1_1 += change_v1_1
        v1_2 += change_v1_2
        v2_0 += change_v2_0
        v2_1 += change_v2_1
        v2_2 += change_v2_2
        change = max(
            abs(change_v1_0),
            abs(change_v1_1),
            abs(change_v1_2),
            abs(change_v2_0),
            abs(change_v2_1),
            abs(change_v2_2),
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
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        if sweep == 1:
            memory.first = max(memory.first, change)
        if previous_1 > 0.0:
            rate_1 = max(change / previous_1, 0.000244140625)
        close = change * rate_1 <= 1.1102230246251565e-16 * scale
        if still or (close and change <= 5.684341886080802e-14 * scale):
            memory.rates[0] = rate_1 if sweep > 1 else 2.0 * rate_1
            break
        previous_1 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    w197 = Y_1 * w138
    w198 = Y_1 * w197
    w199 = Y_2 * w138 * Y_2
    g_0 = 1.0 - (w198 + w199)
    c1_3 = _stumpff_1(w137)
    w201 = Y_2 * c1_3
    w202 = Y_0 * w138
    w203 = Y_1 * w202
    g_3 = w201 + w203
    w204 = Y_2 * w202
    w205 = Y_1 * c1_3
    g_6 = w204 - w205
    g_1 = w203 - w201
    w206 = Y_0 * w202
    g_4 = 1.0 - (w199 + w206)
    w207 = Y_0 * c1_3
    w208 = Y_2 * w197
    g_7 = w207 + w208
    g_2 = w204 + w205
    g_5 = w208 - w207
    g_8 = 1.0 - (w198 + w206)
    change_0 = s_L_0 * g_0 + s_L_1 * g_1 + s_L_2 * g_2 - m_0
    change_1 = s_L_0 * g_3 + s_L_1 * g_4 + s_L_2 * g_5 - m_1
    change_2 = s_L_0 * g_6 + s_L_1 * g_7 + s_L_2 * g_8 - m_2
    new_g00 = g00 * g_0 + g01 * g_3 + g02 * g_6
    new_g01 = g00 * g_1 + g01 * g_4 + g02 * g_7
    new_g02 = g00 * g_2 + g01 * g_5 + g02 * g_8
    new_g10 = g10 * g_0 + g11 * g_3 + g12 * g_6
    new_g11 = g10 * g_1 + g11 * g_4 + g12 * g_7
    new_g12 = g10 * g_2 + g11 * g_5 + g12 * g_8
    new_g20 = g20 * g_0 + g21 * g_3 + g22 * g_6
    new_g21 = g20 * g_1 + g21 * g_4 + g22 * g_7
    new_g22 = g20 * g_2 + g21 * g_5 + g22 * g_8
    new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0
    new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1
    new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2
    found = v1_0, v1_1, v1_2, v2_0, v2_1, v2_2
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
