"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2

method:     family vrkmk(2), tableau gauss2
source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1;
            Table 3.1c of Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of v1, v2, m1, m2: Newton's method with the matrix to
            first order in h, 6 unknowns (2.0 sweeps of 990 operations and 1.00
            matrices of 675 a step; fixed point: 3.3 sweeps of 924 operations;
            Newton's method: 2.6 sweeps of 990 operations and 0.05 matrices of 5744)
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
operations: 42 add, 64 mul, 1 stumpff_1 a step
            2 mul a start, in steps that follow no other
            99 add, 144 mul a matrix of the equations of v1, v2, m1, m2
            345 add, 516 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 a sweep of
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
        self.rough = False
        self.rates = [1.0] * 1

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
    w63 = 0.5 * h
    w64 = 0.5386751345948129 * h
    w65 = 0.25 * h
    w98 = -0.03867513459481288 * h
    w144 = -0.26933756729740643 * h
    w158 = -0.125 * h
    w184 = 0.01933756729740644 * h
    # the equations of v1, v2, m1, m2: Newton's method with the matrix to first order in h in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    w1 = -0.24752475247524752 * h
    w2 = m_2 * w1
    w3 = 0.49504950495049505 * h
    w4 = 0.5 * (0.5 * v1_2 - 0.005 * v1_2)
    w5 = 0.99 * v1_2
    w6 = w1 + w3
    w7 = 50.0 * m_2 * h
    w8 = w7 - 0.49504950495049505 * m_2 * h
    w9 = 0.25 * w8
    w10 = m_1 * w1
    w11 = 0.25 * v1_1 - 0.0025 * v1_1
    w12 = 0.99 * v1_1
    w13 = 0.5 * m_1
    w14 = h * w13 - 0.49504950495049505 * m_1 * h
    w15 = -0.25 * w14
    w16 = 1.0666834348412135 * h
    w17 = 0.5 * (0.5 * v2_2 - 0.005 * v2_2)
    w18 = 0.99 * v2_2
    w19 = w3 - 0.5333417174206068 * h
    w20 = 0.25 * v2_1 - 0.0025 * v2_1
    w21 = 0.99 * v2_1
    w22 = -0.25 * h
    w23 = m_2 * w22
    w24 = 0.5 * h
    w25 = 0.0025 * v1_2 - 0.2525 * v1_2
    w26 = w22 + w24
    w27 = w7 - 0.5 * m_2 * h
    w28 = -0.25 * w27
    w29 = m_0 * w22
    w30 = 0.0025 * v1_0 - 0.2525 * v1_0
    w31 = 0.49504950495049505 * m_0
    w32 = h * w31 - 0.5 * m_0 * h
    w33 = 0.25 * w32
    w34 = 1.0773502691896257 * h
    w35 = 0.0025 * v2_2 - 0.2525 * v2_2
    w36 = w24 - 0.5386751345948129 * h
    w37 = 0.0025 * v2_0 - 0.2525 * v2_0
    w38 = -25.0 * h
    w39 = m_1 * w38
    w40 = 50.0 * h
    w41 = 0.2525 * v1_1 - 0.25 * v1_1
    w42 = 0.01 * v1_1
    w43 = w38 + w40
    w44 = h * (w13 - 50.0 * m_1)
    w45 = 0.25 * w44
    w46 = m_0 * w38
    w47 = 0.5 * (0.505 * v1_0 - 0.5 * v1_0)
    w48 = 0.01 * v1_0
    w49 = h * (w31 - 50.0 * m_0)
    w50 = -0.25 * w49
    w51 = 107.73502691896257 * h
    w52 = 0.2525 * v2_1 - 0.25 * v2_1
    w53 = 0.01 * v2_1
    w54 = w40 - 53.86751345948129 * h
    w55 = 0.5 * (0.505 * v2_0 - 0.5 * v2_0)
    w56 = 0.01 * v2_0
    w57 = -0.07658442494022354 * h
    w58 = 0.03829221247011177 * h + w3
    w59 = -0.07735026918962576 * h
    w60 = 0.03867513459481288 * h + w24
    w61 = -7.735026918962577 * h
    w62 = 3.8675134594812883 * h + w40
    row_1_1 = [
        1.0,
        w2 - (w3 * w4 + w5 * w6 + w9),
        -(w3 * w11 + w6 * w12 + w15 + w10),
        0.0,
        w2 - (w16 * w17 + w18 * w19 - 0.03867513459481288 * w8),
        -(w16 * w20 + w19 * w21 + 0.03867513459481288 * w14 + w10),
    ]
    row_1_2 = [
        -(w24 * w25 - v1_2 * w26 + w28 + w23),
        1.0,
        w29 - (w24 * w30 - v1_0 * w26 + w33),
        -(w34 * w35 - v2_2 * w36 + 0.03867513459481288 * w27 + w23),
        0.0,
        w29 - (w34 * w37 - v2_0 * w36 - 0.03867513459481288 * w32),
    ]
    row_1_3 = [
        w39 - (w40 * w41 + w42 * w43 + w45),
        -(w40 * w47 + w43 * w48 + w50 + w46),
        1.0,
        w39 - (w51 * w52 + w53 * w54 - 0.03867513459481288 * w44),
        -(w51 * w55 + w54 * w56 + 0.03867513459481288 * w49 + w46),
        0.0,
    ]
    row_1_4 = [
        0.0,
        w2 - (w5 * w58 + w4 * w57 + 0.5386751345948129 * w8),
        -(w11 * w57 + w12 * w58 - 0.5386751345948129 * w14 + w10),
        1.0,
        w2 - (w3 * w17 + w6 * w18 + w9),
        -(w3 * w20 + w6 * w21 + w15 + w10),
    ]
    row_1_5 = [
        -(w25 * w59 - v1_2 * w60 - 0.5386751345948129 * w27 + w23),
        0.0,
        w29 - (w30 * w59 - v1_0 * w60 + 0.5386751345948129 * w32),
        -(w24 * w35 - v2_2 * w26 + w28 + w23),
        1.0,
        w29 - (w24 * w37 - v2_0 * w26 + w33),
    ]
    row_1_6 = [
        w39 - (w42 * w62 + w41 * w61 + 0.5386751345948129 * w44),
        -(w48 * w62 + w47 * w61 - 0.5386751345948129 * w49 + w46),
        0.0,
        w39 - (w40 * w52 + w43 * w53 + w45),
        -(w40 * w55 + w43 * w56 + w50 + w46),
        1.0,
    ]
    inverse_1 = invert([row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6])
    if inverse_1 is None:
        raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, 0, statistics)
    row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6 = inverse_1
    for sweep in range(1, 101):
        X2_0 = v1_0 * w64 + v2_0 * w65
        X2_1 = v1_1 * w64 + v2_1 * w65
        w66 = v2_1 * X2_0 - v2_0 * X2_1
        X2_2 = v1_2 * w64 + v2_2 * w65
        w67 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2
        c1_1, c2_1, c3_1 = _stumpff_123(w67)
        w69 = 1.0 - 0.08333333333333333 * w67
        w70 = 1.0 / (w69 * w69 + 0.25 * w67)
        w71 = w70 * (0.25 - 0.08333333333333333 * w69)
        w73 = -0.5 * w70
        w74 = w67 * (w71 * c1_1 + w73 * c2_1) - (w73 + c1_1)
        w75 = v2_0 * X2_2 - v2_2 * X2_0
        w76 = v2_2 * X2_1 - v2_1 * X2_2
        w77 = X2_0 * w75 - X2_1 * w76
        w78 = w71 + c2_1 + w73 * c1_1 - w71 * c2_1 * w67
        p_2_2 = 0.01 * (v2_2 + w66 * w74 + w77 * w78)
        w79 = X2_2 * w76 - X2_0 * w66
        a_6_1 = v2_1 + w74 * w75 + w78 * w79
        w80 = X2_0 * c2_1
        w81 = X2_1 * w80
        w82 = X2_2 * c1_1
        w83 = X2_0 * w80
        w84 = X2_2 * c2_1 * X2_2
        w85 = X2_0 * c1_1
        w86 = X2_1 * c2_1
        w87 = X2_2 * w86
        Q2_7 = g20 * (w81 - w82) + g21 * (1.0 - (w83 + w84)) + g22 * (w85 + w87)
        w88 = X2_1 * c1_1
        w89 = X2_2 * w80
        w90 = X2_1 * w86
        Q2_8 = g20 * (w88 + w89) + g21 * (w87 - w85) + g22 * (1.0 - (w83 + w90))
        w91 = 1.5 - 2.0 * Q2_8
        w92 = 1.0 / sqrt(1.01 + 1.5 * (w91 - 0.2 * Q2_7))
        w93 = w92 * w92 * (0.5 * w92)
        w94 = 1.0 / sqrt(1.01 + 1.5 * (w91 + 0.2 * Q2_7))
        w95 = w94 * w94 * (0.5 * w94)
        w96 = -1.0 - 2.0 * (1.5 * w93 - 1.5 * w95)
        w97 = -0.3 * w93 - 0.3 * w95
        Nn2_0 = Q2_7 * w96 - Q2_8 * w97 + 99.0 * a_6_1 * p_2_2
        X1_0 = v1_0 * w65 + v2_0 * w98
        X1_1 = v1_1 * w65 + v2_1 * w98
        w99 = v1_1 * X1_0 - v1_0 * X1_1
        X1_2 = v1_2 * w65 + v2_2 * w98
        w100 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
        c1_2, c2_2, c3_2 = _stumpff_123(w100)
        w102 = 1.0 - 0.08333333333333333 * w100
        w103 = 1.0 / (w102 * w102 + 0.25 * w100)
        w104 = w103 * (0.25 - 0.08333333333333333 * w102)
        w106 = -0.5 * w103
        w107 = w100 * (w104 * c1_2 + w106 * c2_2) - (w106 + c1_2)
        w108 = v1_0 * X1_2 - v1_2 * X1_0
        w109 = v1_2 * X1_1 - v1_1 * X1_2
        w110 = X1_0 * w108 - X1_1 * w109
        w111 = w104 + c2_2 + w106 * c1_2 - w104 * c2_2 * w100
        p_2 = 0.01 * (v1_2 + w99 * w107 + w110 * w111)
        w112 = X1_2 * w109 - X1_0 * w99
        a_2_1 = v1_1 + w107 * w108 + w111 * w112
        w113 = X1_0 * c2_2
        w114 = X1_1 * w113
        w115 = X1_2 * c1_2
        w116 = X1_0 * w113
        w117 = X1_2 * c2_2 * X1_2
        w118 = X1_0 * c1_2
        w119 = X1_1 * c2_2
        w120 = X1_2 * w119
        Q1_7 = g20 * (w114 - w115) + g21 * (1.0 - (w116 + w117)) + g22 * (w118 + w120)
        w121 = X1_1 * c1_2
        w122 = X1_2 * w113
        w123 = X1_1 * w119
        Q1_8 = g20 * (w121 + w122) + g21 * (w120 - w118) + g22 * (1.0 - (w116 + w123))
        w124 = 1.5 - 2.0 * Q1_8
        w125 = 1.0 / sqrt(1.01 + 1.5 * (w124 - 0.2 * Q1_7))
        w126 = w125 * w125 * (0.5 * w125)
        w127 = 1.0 / sqrt(1.01 + 1.5 * (w124 + 0.2 * Q1_7))
        w128 = w127 * w127 * (0.5 * w127)
        w129 = -1.0 - 2.0 * (1.5 * w126 - 1.5 * w128)
        w130 = -0.3 * w126 - 0.3 * w128
        Nn1_0 = Q1_7 * w129 - Q1_8 * w130 + 99.0 * a_2_1 * p_2
        s_L_0 = m_0 + w63 * (Nn2_0 + Nn1_0)
        Y_0 = (v1_0 + v2_0) * w63
        Y_1 = (v1_1 + v2_1) * w63
        Y_2 = (v1_2 + v2_2) * w63
        w131 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
        c2_3, c3_3 = _stumpff_23(w131)
        w132 = c2_3
        w133 = X2_1 * w66 - X2_2 * w75
        a_6_0 = v2_0 + w74 * w76 + w78 * w133
        Q2_6 = g20 * (1.0 - (w84 + w90)) + g21 * (w81 + w82) + g22 * (w89 - w88)
        Nn2_1 = -100.0 * a_6_0 * p_2_2 - w96 * Q2_6
        w134 = X1_1 * w99 - X1_2 * w108
        a_2_0 = v1_0 + w107 * w109 + w111 * w134
        Q1_6 = g20 * (1.0 - (w117 + w123)) + g21 * (w114 + w115) + g22 * (w122 - w121)
        Nn1_1 = -100.0 * a_2_0 * p_2 - w129 * Q1_6
        s_L_1 = m_1 + w63 * (Nn2_1 + Nn1_1)
        Nn2_2 = 0.01 * a_6_0 * a_6_1 + w97 * Q2_6
        Nn1_2 = 0.01 * a_2_0 * a_2_1 + w130 * Q1_6
        s_L_2 = m_2 + w63 * (Nn2_2 + Nn1_2)
        w135 = Y_2 * s_L_1 - Y_1 * s_L_2
        w137 = Y_0 * s_L_2 - s_L_0 * Y_2
        w138 = s_L_0 * Y_1 - Y_0 * s_L_1
        w139 = 0.5 * (s_L_0 - w132 * w135 + (Y_2 * w137 - Y_1 * w138) * c3_3)
        w140 = X2_1 * Nn2_2 - X2_2 * Nn2_1
        w142 = X2_0 * Nn2_1 - X2_1 * Nn2_0
        w143 = X2_2 * Nn2_0 - X2_0 * Nn2_2
        d2_0 = Nn2_0 + w140 * c2_1 + (X2_1 * w142 - X2_2 * w143) * c3_1
        p_2_0 = 1.01 * a_6_0
        w145 = X2_2 * p_2_0 - X2_0 * p_2_2
        w146 = X2_1 * p_2_2 - X2_2 * a_6_1
        w147 = X2_0 * a_6_1 - X2_1 * p_2_0
        s_2_1 = 0.5 * (a_6_1 - w74 * w145 + w78 * (X2_2 * w146 - X2_0 * w147))
        a_5_2 = v2_2 - w66 * w73 + w71 * w77
        a_5_1 = v2_1 - w73 * w75 + w71 * w79
        a_5_0 = v2_0 - w73 * w76 + w71 * w133
        w148 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0)
        s_2_2 = 0.5 * (p_2_2 - w74 * w147 + w78 * (X2_0 * w145 - X2_1 * w146))
        w149 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2)
        s_2_0 = 0.5 * (p_2_0 - w74 * w146 + w78 * (X2_1 * w147 - X2_2 * w145))
        w150 = X2_0 * s_2_2 - X2_2 * s_2_0
        w151 = -0.08333333333333333 * a_5_2
        w152 = X2_1 * s_2_0 - X2_0 * s_2_1
        w153 = -0.08333333333333333 * a_5_1
        P2_0 = s_2_1 * w148 - s_2_2 * w149 + (w150 * w151 - w152 * w153)
        w154 = X1_1 * Nn1_2 - X1_2 * Nn1_1
        w156 = X1_0 * Nn1_1 - X1_1 * Nn1_0
        w157 = X1_2 * Nn1_0 - X1_0 * Nn1_2
        d1_0 = Nn1_0 + w154 * c2_2 + (X1_1 * w156 - X1_2 * w157) * c3_2
        p_0 = 1.01 * a_2_0
        w159 = X1_2 * p_0 - X1_0 * p_2
        w160 = X1_1 * p_2 - X1_2 * a_2_1
        w161 = X1_0 * a_2_1 - X1_1 * p_0
        s_1 = 0.5 * (a_2_1 - w107 * w159 + w111 * (X1_2 * w160 - X1_0 * w161))
        a_2 = v1_2 - w99 * w106 + w104 * w110
        a_1 = v1_1 - w106 * w108 + w104 * w112
        a_0 = v1_0 - w106 * w109 + w104 * w134
        w162 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0)
        s_2 = 0.5 * (p_2 - w107 * w161 + w111 * (X1_0 * w159 - X1_1 * w160))
        w163 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2)
        s_0 = 0.5 * (p_0 - w107 * w160 + w111 * (X1_1 * w161 - X1_2 * w159))
        w164 = X1_0 * s_2 - X1_2 * s_0
        w165 = -0.08333333333333333 * a_2
        w166 = X1_1 * s_0 - X1_0 * s_1
        w167 = -0.08333333333333333 * a_1
        P1_0 = s_1 * w162 - s_2 * w163 + (w164 * w165 - w166 * w167)
        w1_0 = 2.0 * (d2_0 * w144 + w64 * P2_0 + d1_0 * w158 + w65 * P1_0 + w139)
        w168 = c1_2 - 0.5 - w100 * (0.08333333333333333 * c1_2 - 0.5 * c2_2)
        w169 = 0.5 * (s_L_2 - w132 * w138 + (Y_1 * w135 - Y_0 * w137) * c3_3)
        d2_2 = Nn2_2 + w142 * c2_1 + (X2_0 * w143 - X2_1 * w140) * c3_1
        w170 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1)
        w171 = X2_2 * s_2_1 - X2_1 * s_2_2
        w172 = -0.08333333333333333 * a_5_0
        P2_2 = w149 * s_2_0 - s_2_1 * w170 + (w153 * w171 - w150 * w172)
        d1_2 = Nn1_2 + w156 * c2_2 + (X1_0 * w157 - X1_1 * w154) * c3_2
        w173 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1)
        w174 = X1_2 * s_1 - X1_1 * s_2
        w175 = -0.08333333333333333 * a_0
        P1_2 = w163 * s_0 - s_1 * w173 + (w167 * w174 - w164 * w175)
        w1_2 = 2.0 * (w64 * P2_2 + w144 * d2_2 + w158 * d1_2 + w65 * P1_2 + w169)
        w176 = 0.5 * (s_L_1 - w132 * w137 + (Y_0 * w138 - Y_2 * w135) * c3_3)
        d2_1 = Nn2_1 + w143 * c2_1 + (X2_2 * w140 - X2_0 * w142) * c3_1
        P2_1 = s_2_2 * w170 - w148 * s_2_0 + (w152 * w172 - w151 * w171)
        d1_1 = Nn1_1 + w157 * c2_2 + (X1_2 * w154 - X1_0 * w156) * c3_2
        P1_1 = s_2 * w173 - w162 * s_0 + (w166 * w175 - w165 * w174)
        w1_1 = 2.0 * (w64 * P2_1 + w144 * d2_1 + w158 * d1_1 + w65 * P1_1 + w176)
        w177 = X1_1 * w1_2 - X1_2 * w1_1
        w178 = (
            0.08333333333333333 + c2_2 - 0.5 * c1_2 - 0.08333333333333333 * c2_2 * w100
        )
        w179 = X1_0 * w1_1 - X1_1 * w1_0
        w180 = X1_2 * w1_0 - X1_0 * w1_2
        Wxi1_0 = (
            0.9900990099009901
            * (w1_0 - w168 * w177 + w178 * (X1_1 * w179 - X1_2 * w180))
        )
        Wxi1_2 = 100.0 * (w1_2 - w168 * w179 + w178 * (X1_0 * w180 - X1_1 * w177))
        Pxi1_1 = w1_1 - w168 * w180 + w178 * (X1_2 * w177 - X1_0 * w179)
        w181 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1
        w182 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0
        w183 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2
        w2_0 = 2.0 * (d2_0 * w158 + w65 * P2_0 + d1_0 * w184 + w98 * P1_0 + w139)
        w185 = c1_1 - 0.5 - w67 * (0.08333333333333333 * c1_1 - 0.5 * c2_1)
        w2_2 = 2.0 * (w65 * P2_2 + w158 * d2_2 + d1_2 * w184 + w98 * P1_2 + w169)
        w2_1 = 2.0 * (w65 * P2_1 + w158 * d2_1 + d1_1 * w184 + w98 * P1_1 + w176)
        w186 = X2_1 * w2_2 - X2_2 * w2_1
        w187 = (
            0.08333333333333333 + c2_1 - 0.5 * c1_1 - 0.08333333333333333 * c2_1 * w67
        )
        w188 = X2_0 * w2_1 - X2_1 * w2_0
        w189 = X2_2 * w2_0 - X2_0 * w2_2
        Wxi2_0 = (
            0.9900990099009901
            * (w2_0 - w185 * w186 + w187 * (X2_1 * w188 - X2_2 * w189))
        )
        Wxi2_2 = 100.0 * (w2_2 - w185 * w188 + w187 * (X2_0 * w189 - X2_1 * w186))
        Pxi2_1 = w2_1 - w185 * w189 + w187 * (X2_2 * w186 - X2_0 * w188)
        w190 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1
        w191 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0
        w192 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2
        next_v1_0 = Wxi1_0 + w168 * w181 + w178 * (X1_1 * w182 - X1_2 * w183)
        next_v1_1 = Pxi1_1 + w168 * w183 + w178 * (X1_2 * w181 - X1_0 * w182)
        next_v1_2 = Wxi1_2 + w168 * w182 + w178 * (X1_0 * w183 - X1_1 * w181)
        next_v2_0 = Wxi2_0 + w185 * w190 + w187 * (X2_1 * w191 - X2_2 * w192)
        next_v2_1 = Pxi2_1 + w185 * w192 + w187 * (X2_2 * w190 - X2_0 * w191)
        next_v2_2 = Wxi2_2 + w185 * w191 + w187 * (X2_0 * w192 - X2_1 * w190)
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
        if sweep == 1 and change > 0.015625 * scale:
            memory.rough = True
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
    w193 = Y_1 * w132
    w194 = Y_1 * w193
    w195 = Y_2 * w132 * Y_2
    g_0 = 1.0 - (w194 + w195)
    c1_3 = _stumpff_1(w131)
    w197 = Y_2 * c1_3
    w198 = Y_0 * w132
    w199 = Y_1 * w198
    g_3 = w197 + w199
    w200 = Y_2 * w198
    w201 = Y_1 * c1_3
    g_6 = w200 - w201
    q1_0 = g00 * g_0 + g01 * g_3 + g02 * g_6
    g_1 = w199 - w197
    w202 = Y_0 * w198
    g_4 = 1.0 - (w195 + w202)
    w203 = Y_0 * c1_3
    w204 = Y_2 * w193
    g_7 = w203 + w204
    q1_1 = g00 * g_1 + g01 * g_4 + g02 * g_7
    g_2 = w200 + w201
    g_5 = w204 - w203
    g_8 = 1.0 - (w194 + w202)
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
    found = v1_0, v1_1, v1_2, v2_0, v2_1, v2_2
    memory.past = [found, *([] if memory.rough else memory.past[:8])]
    memory.rough = False
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
