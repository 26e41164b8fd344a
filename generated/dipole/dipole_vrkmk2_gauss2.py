"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vrkmk(2):gauss2

method:     family vrkmk(2), tableau gauss2
source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1;
            Table 3.1c of Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of v1, v2, m1, m2: Newton's method, 6 unknowns (4.1 sweeps
            of 990 operations and 0.12 matrices of 5744 a step, not 5.6 sweeps of
            924 operations)
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
            2286 add, 2936 mul, 3 slope2, 3 slope3 a matrix of the equations of v1,
            v2, m1, m2
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
    block that failed, 0 if none has; matrices: how often a matrix of Newton's method
    was made.
    """

    labels = [
        "the equations of v1, v2, m1, m2",
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
        self.inverses = [None] * 1

    def extrapolated(self):
        """Return the polynomial through the last solutions, continued by a step."""
        if len(self.past) == 1:
            return self.past[0]
        if len(self.past) == 2:
            return [2.0 * a - b for a, b in zip(*self.past)]
        return [3.0 * (a - b) + c for a, b, c in zip(*self.past)]


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


def _stumpff_12_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


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


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    return _stumpff_12_far(z)


def _stumpff_1(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 0.0625:
        return _stumpff_small_1(z)
    return _stumpff_1_far(z)


def slope3(z):
    """Return the derivative of c_3 for z >= 0."""
    if z > 1.0:
        before, c = _stumpff_23(z)
        return 0.5 * (before - 3.0 * c) / z
    total = 6.576508197299464e-17
    total = -1.9680200780418645e-14 + z * total
    total = 4.58829823909189e-12 + z * total
    total = -8.029521918410807e-10 + z * total
    total = 1.0020843354176688e-07 + z * total
    total = -8.267195767195768e-06 + z * total
    total = 0.0003968253968253968 + z * total
    total = -0.008333333333333333 + z * total
    return total


def slope2(z):
    """Return the derivative of c_2 for z >= 0."""
    if z > 1.0:
        before, c = _stumpff_12(z)
        return 0.5 * (before - 2.0 * c) / z
    total = 1.249536557486898e-15
    total = -3.3456341326711696e-13 + z * total
    total = 6.882447358637835e-11 + z * total
    total = -1.043837849393405e-08 + z * total
    total = 1.1022927689594355e-06 + z * total
    total = -7.440476190476191e-05 + z * total
    total = 0.002777777777777778 + z * total
    total = -0.041666666666666664 + z * total
    return total


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
    w1 = 0.5 * h
    w2 = 0.5386751345948129 * h
    w3 = 0.25 * h
    w52 = -0.03867513459481288 * h
    w130 = -0.26933756729740643 * h
    w152 = -0.125 * h
    w209 = 0.01933756729740644 * h
    # the equations of v1, v2, m1, m2: Newton's method in v1_0, v1_1, v1_2, v2_0, v2_1, v2_2
    previous_1 = 0.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
        X2_0 = v1_0 * w2 + v2_0 * w3
        w4 = v2_1 * X2_0
        X2_1 = v1_1 * w2 + v2_1 * w3
        w5 = v2_0 * X2_1
        w6 = w4 - w5
        X2_2 = v1_2 * w2 + v2_2 * w3
        w7 = X2_2 * X2_2
        w8 = X2_0 * X2_0 + X2_1 * X2_1 + w7
        c1_1, c2_1, c3_1 = _stumpff_123(w8)
        w10 = 1.0 - 0.08333333333333333 * w8
        w11 = 1.0 / (w10 * w10 + 0.25 * w8)
        w12 = 0.25 - 0.08333333333333333 * w10
        w13 = w11 * w12
        w15 = -0.5 * w11
        w16 = w13 * c1_1 + w15 * c2_1
        w17 = w8 * w16 - (w15 + c1_1)
        w18 = v2_0 * X2_2
        w19 = v2_2 * X2_0
        w20 = w18 - w19
        w21 = v2_2 * X2_1
        w22 = v2_1 * X2_2
        w23 = w21 - w22
        w24 = X2_0 * w20 - X2_1 * w23
        w25 = w13 * c2_1
        w26 = w13 + c2_1 + w15 * c1_1 - w8 * w25
        a_6_2 = v2_2 + w6 * w17 + w24 * w26
        p_2_2 = 0.01 * a_6_2
        w27 = X2_2 * w23 - X2_0 * w6
        a_6_1 = v2_1 + w17 * w20 + w26 * w27
        w28 = 99.0 * a_6_1
        w29 = X2_0 * c2_1
        w30 = X2_1 * w29
        w31 = X2_2 * c1_1
        w32 = X2_0 * w29
        w33 = X2_2 * c2_1
        w34 = X2_2 * w33
        w35 = X2_0 * c1_1
        w36 = X2_1 * c2_1
        w37 = X2_2 * w36
        Q2_7 = g20 * (w30 - w31) + g21 * (1.0 - (w32 + w34)) + g22 * (w35 + w37)
        w38 = X2_1 * c1_1
        w39 = X2_2 * w29
        w40 = X2_1 * w36
        Q2_8 = g20 * (w38 + w39) + g21 * (w37 - w35) + g22 * (1.0 - (w32 + w40))
        w41 = 1.5 - 2.0 * Q2_8
        w42 = 1.0 / sqrt(1.01 + 1.5 * (w41 - 0.2 * Q2_7))
        w43 = w42 * w42
        w44 = 0.5 * w42
        w45 = w43 * w44
        w46 = 1.0 / sqrt(1.01 + 1.5 * (w41 + 0.2 * Q2_7))
        w47 = w46 * w46
        w48 = 0.5 * w46
        w49 = w47 * w48
        w50 = -1.0 - 2.0 * (1.5 * w45 - 1.5 * w49)
        w51 = -0.3 * w45 - 0.3 * w49
        Nn2_0 = Q2_7 * w50 - Q2_8 * w51 + p_2_2 * w28
        X1_0 = v1_0 * w3 + v2_0 * w52
        w53 = v1_1 * X1_0
        X1_1 = v1_1 * w3 + v2_1 * w52
        w54 = v1_0 * X1_1
        w55 = w53 - w54
        X1_2 = v1_2 * w3 + v2_2 * w52
        w56 = X1_2 * X1_2
        w57 = X1_0 * X1_0 + X1_1 * X1_1 + w56
        c1_2, c2_2, c3_2 = _stumpff_123(w57)
        w59 = 1.0 - 0.08333333333333333 * w57
        w60 = 1.0 / (w59 * w59 + 0.25 * w57)
        w61 = 0.25 - 0.08333333333333333 * w59
        w62 = w60 * w61
        w64 = -0.5 * w60
        w65 = w62 * c1_2 + w64 * c2_2
        w66 = w57 * w65 - (w64 + c1_2)
        w67 = v1_0 * X1_2
        w68 = v1_2 * X1_0
        w69 = w67 - w68
        w70 = v1_2 * X1_1
        w71 = v1_1 * X1_2
        w72 = w70 - w71
        w73 = X1_0 * w69 - X1_1 * w72
        w74 = w62 * c2_2
        w75 = w62 + c2_2 + w64 * c1_2 - w57 * w74
        a_2_2 = v1_2 + w55 * w66 + w73 * w75
        p_2 = 0.01 * a_2_2
        w76 = X1_2 * w72 - X1_0 * w55
        a_2_1 = v1_1 + w66 * w69 + w75 * w76
        w77 = 99.0 * a_2_1
        w78 = X1_0 * c2_2
        w79 = X1_1 * w78
        w80 = X1_2 * c1_2
        w81 = X1_0 * w78
        w82 = X1_2 * c2_2
        w83 = X1_2 * w82
        w84 = X1_0 * c1_2
        w85 = X1_1 * c2_2
        w86 = X1_2 * w85
        Q1_7 = g20 * (w79 - w80) + g21 * (1.0 - (w81 + w83)) + g22 * (w84 + w86)
        w87 = X1_1 * c1_2
        w88 = X1_2 * w78
        w89 = X1_1 * w85
        Q1_8 = g20 * (w87 + w88) + g21 * (w86 - w84) + g22 * (1.0 - (w81 + w89))
        w90 = 1.5 - 2.0 * Q1_8
        w91 = 1.0 / sqrt(1.01 + 1.5 * (w90 - 0.2 * Q1_7))
        w92 = w91 * w91
        w93 = 0.5 * w91
        w94 = w92 * w93
        w95 = 1.0 / sqrt(1.01 + 1.5 * (w90 + 0.2 * Q1_7))
        w96 = w95 * w95
        w97 = 0.5 * w95
        w98 = w96 * w97
        w99 = -1.0 - 2.0 * (1.5 * w94 - 1.5 * w98)
        w100 = -0.3 * w94 - 0.3 * w98
        Nn1_0 = Q1_7 * w99 - Q1_8 * w100 + p_2 * w77
        s_L_0 = m_0 + w1 * (Nn2_0 + Nn1_0)
        Y_0 = (v1_0 + v2_0) * w1
        Y_1 = (v1_1 + v2_1) * w1
        Y_2 = (v1_2 + v2_2) * w1
        w101 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
        c2_3, c3_3 = _stumpff_23(w101)
        w102 = c2_3
        w103 = X2_1 * w6 - X2_2 * w20
        a_6_0 = v2_0 + w17 * w23 + w26 * w103
        w104 = -100.0 * a_6_0
        w105 = p_2_2 * w104
        Q2_6 = g20 * (1.0 - (w34 + w40)) + g21 * (w30 + w31) + g22 * (w39 - w38)
        w106 = w50 * Q2_6
        Nn2_1 = w105 - w106
        w107 = X1_1 * w55 - X1_2 * w69
        a_2_0 = v1_0 + w66 * w72 + w75 * w107
        w108 = -100.0 * a_2_0
        w109 = p_2 * w108
        Q1_6 = g20 * (1.0 - (w83 + w89)) + g21 * (w79 + w80) + g22 * (w88 - w87)
        w110 = w99 * Q1_6
        Nn1_1 = w109 - w110
        s_L_1 = m_1 + w1 * (Nn2_1 + Nn1_1)
        w111 = Y_2 * s_L_1
        w112 = 0.01 * a_6_0
        Nn2_2 = a_6_1 * w112 + w51 * Q2_6
        w113 = 0.01 * a_2_0
        Nn1_2 = a_2_1 * w113 + w100 * Q1_6
        s_L_2 = m_2 + w1 * (Nn2_2 + Nn1_2)
        w114 = Y_1 * s_L_2
        w115 = w111 - w114
        w117 = Y_0 * s_L_2
        w118 = s_L_0 * Y_2
        w119 = w117 - w118
        w120 = s_L_0 * Y_1
        w121 = Y_0 * s_L_1
        w122 = w120 - w121
        w123 = Y_2 * w119 - Y_1 * w122
        w124 = 0.5 * (s_L_0 - w102 * w115 + w123 * c3_3)
        w125 = X2_1 * Nn2_2 - X2_2 * Nn2_1
        w127 = X2_0 * Nn2_1 - X2_1 * Nn2_0
        w128 = X2_2 * Nn2_0 - X2_0 * Nn2_2
        w129 = X2_1 * w127 - X2_2 * w128
        d2_0 = Nn2_0 + w125 * c2_1 + w129 * c3_1
        p_2_0 = 1.01 * a_6_0
        w131 = X2_2 * p_2_0 - X2_0 * p_2_2
        w132 = X2_1 * p_2_2 - X2_2 * a_6_1
        w133 = X2_0 * a_6_1 - X2_1 * p_2_0
        w134 = X2_2 * w132 - X2_0 * w133
        a_8_1 = a_6_1 - w17 * w131 + w26 * w134
        s_2_1 = 0.5 * a_8_1
        a_5_2 = v2_2 - w6 * w15 + w13 * w24
        a_5_1 = v2_1 - w15 * w20 + w13 * w27
        a_5_0 = v2_0 - w15 * w23 + w13 * w103
        w135 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0)
        w136 = X2_0 * w131 - X2_1 * w132
        a_8_2 = p_2_2 - w17 * w133 + w26 * w136
        s_2_2 = 0.5 * a_8_2
        w137 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2)
        w138 = X2_0 * s_2_2
        w139 = X2_1 * w133 - X2_2 * w131
        a_8_0 = p_2_0 - w17 * w132 + w26 * w139
        s_2_0 = 0.5 * a_8_0
        w140 = X2_2 * s_2_0
        w141 = w138 - w140
        w142 = -0.08333333333333333 * a_5_2
        w143 = X2_1 * s_2_0
        w144 = X2_0 * s_2_1
        w145 = w143 - w144
        w146 = -0.08333333333333333 * a_5_1
        P2_0 = s_2_1 * w135 - s_2_2 * w137 + (w141 * w142 - w145 * w146)
        w147 = X1_1 * Nn1_2 - X1_2 * Nn1_1
        w149 = X1_0 * Nn1_1 - X1_1 * Nn1_0
        w150 = X1_2 * Nn1_0 - X1_0 * Nn1_2
        w151 = X1_1 * w149 - X1_2 * w150
        d1_0 = Nn1_0 + w147 * c2_2 + w151 * c3_2
        p_0 = 1.01 * a_2_0
        w153 = X1_2 * p_0 - X1_0 * p_2
        w154 = X1_1 * p_2 - X1_2 * a_2_1
        w155 = X1_0 * a_2_1 - X1_1 * p_0
        w156 = X1_2 * w154 - X1_0 * w155
        a_4_1 = a_2_1 - w66 * w153 + w75 * w156
        s_1 = 0.5 * a_4_1
        a_2 = v1_2 - w55 * w64 + w62 * w73
        a_1 = v1_1 - w64 * w69 + w62 * w76
        a_0 = v1_0 - w64 * w72 + w62 * w107
        w157 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0)
        w158 = X1_0 * w153 - X1_1 * w154
        a_4_2 = p_2 - w66 * w155 + w75 * w158
        s_2 = 0.5 * a_4_2
        w159 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2)
        w160 = X1_0 * s_2
        w161 = X1_1 * w155 - X1_2 * w153
        a_4_0 = p_0 - w66 * w154 + w75 * w161
        s_0 = 0.5 * a_4_0
        w162 = X1_2 * s_0
        w163 = w160 - w162
        w164 = -0.08333333333333333 * a_2
        w165 = X1_1 * s_0
        w166 = X1_0 * s_1
        w167 = w165 - w166
        w168 = -0.08333333333333333 * a_1
        P1_0 = s_1 * w157 - s_2 * w159 + (w163 * w164 - w167 * w168)
        w1_0 = 2.0 * (d2_0 * w130 + w2 * P2_0 + d1_0 * w152 + w3 * P1_0 + w124)
        w169 = c1_2 - 0.5
        w170 = 0.08333333333333333 * c1_2 - 0.5 * c2_2
        w171 = w57 * w170
        w172 = w169 - w171
        w173 = Y_1 * w115 - Y_0 * w119
        w174 = 0.5 * (s_L_2 - w102 * w122 + w173 * c3_3)
        w175 = X2_0 * w128 - X2_1 * w125
        d2_2 = Nn2_2 + w127 * c2_1 + w175 * c3_1
        w176 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1)
        w177 = X2_2 * s_2_1
        w178 = X2_1 * s_2_2
        w179 = w177 - w178
        w180 = -0.08333333333333333 * a_5_0
        P2_2 = w137 * s_2_0 - s_2_1 * w176 + (w146 * w179 - w141 * w180)
        w181 = X1_0 * w150 - X1_1 * w147
        d1_2 = Nn1_2 + w149 * c2_2 + w181 * c3_2
        w182 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1)
        w183 = X1_2 * s_1
        w184 = X1_1 * s_2
        w185 = w183 - w184
        w186 = -0.08333333333333333 * a_0
        P1_2 = w159 * s_0 - s_1 * w182 + (w168 * w185 - w163 * w186)
        w1_2 = 2.0 * (w2 * P2_2 + w130 * d2_2 + w152 * d1_2 + w3 * P1_2 + w174)
        w187 = Y_0 * w122 - Y_2 * w115
        w188 = 0.5 * (s_L_1 - w102 * w119 + w187 * c3_3)
        w189 = X2_2 * w125 - X2_0 * w127
        d2_1 = Nn2_1 + w128 * c2_1 + w189 * c3_1
        P2_1 = s_2_2 * w176 - w135 * s_2_0 + (w145 * w180 - w142 * w179)
        w190 = X1_2 * w147 - X1_0 * w149
        d1_1 = Nn1_1 + w150 * c2_2 + w190 * c3_2
        P1_1 = s_2 * w182 - w157 * s_0 + (w167 * w186 - w164 * w185)
        w1_1 = 2.0 * (w2 * P2_1 + w130 * d2_1 + w152 * d1_1 + w3 * P1_1 + w188)
        w191 = X1_1 * w1_2 - X1_2 * w1_1
        w192 = 0.08333333333333333 + c2_2 - 0.5 * c1_2
        w193 = 0.08333333333333333 * c2_2
        w194 = w57 * w193
        w195 = w192 - w194
        w196 = X1_0 * w1_1 - X1_1 * w1_0
        w197 = X1_2 * w1_0
        w198 = X1_0 * w1_2
        w199 = w197 - w198
        w200 = X1_1 * w196 - X1_2 * w199
        Wxi1_0 = 0.9900990099009901 * (w1_0 - w172 * w191 + w195 * w200)
        w201 = X1_0 * w199 - X1_1 * w191
        Wxi1_2 = 100.0 * (w1_2 - w172 * w196 + w195 * w201)
        w202 = X1_2 * w191 - X1_0 * w196
        Pxi1_1 = w1_1 - w172 * w199 + w195 * w202
        w203 = X1_1 * Wxi1_2 - X1_2 * Pxi1_1
        w204 = X1_0 * Pxi1_1 - X1_1 * Wxi1_0
        w205 = X1_2 * Wxi1_0 - X1_0 * Wxi1_2
        w206 = X1_1 * w204 - X1_2 * w205
        w207 = X1_2 * w203 - X1_0 * w204
        w208 = X1_0 * w205 - X1_1 * w203
        w2_0 = 2.0 * (d2_0 * w152 + w3 * P2_0 + d1_0 * w209 + w52 * P1_0 + w124)
        w210 = c1_1 - 0.5
        w211 = 0.08333333333333333 * c1_1 - 0.5 * c2_1
        w212 = w8 * w211
        w213 = w210 - w212
        w2_2 = 2.0 * (w3 * P2_2 + w152 * d2_2 + d1_2 * w209 + w52 * P1_2 + w174)
        w2_1 = 2.0 * (w3 * P2_1 + w152 * d2_1 + d1_1 * w209 + w52 * P1_1 + w188)
        w214 = X2_1 * w2_2 - X2_2 * w2_1
        w215 = 0.08333333333333333 + c2_1 - 0.5 * c1_1
        w216 = 0.08333333333333333 * c2_1
        w217 = w8 * w216
        w218 = w215 - w217
        w219 = X2_0 * w2_1 - X2_1 * w2_0
        w220 = X2_2 * w2_0
        w221 = X2_0 * w2_2
        w222 = w220 - w221
        w223 = X2_1 * w219 - X2_2 * w222
        Wxi2_0 = 0.9900990099009901 * (w2_0 - w213 * w214 + w218 * w223)
        w224 = X2_0 * w222 - X2_1 * w214
        Wxi2_2 = 100.0 * (w2_2 - w213 * w219 + w218 * w224)
        w225 = X2_2 * w214 - X2_0 * w219
        Pxi2_1 = w2_1 - w213 * w222 + w218 * w225
        w226 = X2_1 * Wxi2_2 - X2_2 * Pxi2_1
        w227 = X2_0 * Pxi2_1 - X2_1 * Wxi2_0
        w228 = X2_2 * Wxi2_0 - X2_0 * Wxi2_2
        w229 = X2_1 * w227 - X2_2 * w228
        w230 = X2_2 * w226 - X2_0 * w227
        w231 = X2_0 * w228 - X2_1 * w226
        next_v1_0 = Wxi1_0 + w172 * w203 + w195 * w206
        next_v1_1 = Pxi1_1 + w172 * w205 + w195 * w207
        next_v1_2 = Wxi1_2 + w172 * w204 + w195 * w208
        next_v2_0 = Wxi2_0 + w213 * w226 + w218 * w229
        next_v2_1 = Pxi2_1 + w213 * w228 + w218 * w230
        next_v2_2 = Wxi2_2 + w213 * w227 + w218 * w231
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
        if make_1:
            w232 = X1_1 * w195
            w233 = w194 - w192
            w234 = X1_2 * w233
            w235 = X1_1 * w172
            w236 = w235 - X1_0 * w234
            w237 = 100.0 * w195
            w238 = -100.0 * w172
            w239 = X1_0 * w237
            w240 = w199 * w237 + w1_1 * w238 - w1_2 * w239
            w241 = 1.0 - X1_1 * w232 + X1_2 * w234
            w242 = 0.9900990099009901 * w195
            w243 = X1_1 * w242
            w244 = X1_2 * w242
            w245 = w1_1 * w243 + w1_2 * w244
            w246 = X1_2 * w172
            w247 = X1_0 * w232 - w246
            w248 = X1_0 * w233
            w249 = w171 - w169
            w250 = w196 * w233 + w1_1 * w248 - w1_2 * w249
            w251 = (
                Pxi1_1 * w232 - Wxi1_2 * w234 + w236 * w240 + w241 * w245 + w247 * w250
            )
            w252 = X1_1 * w237
            w253 = 100.0 - X1_0 * w239 - X1_1 * w252
            w254 = -0.9900990099009901 * w172
            w255 = X1_0 * w244 + X1_1 * w254
            w256 = X1_2 * w195
            w257 = X1_1 * w256
            w258 = w257 - X1_0 * w249
            w259 = w236 * w253 + w241 * w255 + w247 * w258
            w260 = 2.0 * Y_0
            w261 = slope3(w101)
            w262 = slope2(w101)
            w263 = w173 * w261 + w262 * (w121 - w120)
            w264 = w119 * c3_3
            w265 = w1 * (w260 * w263 - w264)
            w266 = -0.5386751345948129 * h
            w267 = w128 * c3_1
            w268 = X2_0 * c3_1
            w269 = w267 + Nn2_1 * c2_1 - Nn2_2 * w268
            w270 = 1.0773502691896257 * h
            w271 = 0.08333333333333333 * a_5_2
            w272 = s_2_2 * w180
            w273 = s_2_0 * w271 - w272
            w274 = w266 * w269 + w270 * w273
            w275 = -0.25 * h
            w276 = w150 * c3_2
            w277 = X1_0 * c3_2
            w278 = w276 + Nn1_1 * c2_2 - Nn1_2 * w277
            w279 = 0.08333333333333333 * a_2
            w280 = s_2 * w186
            w281 = s_0 * w279 - w280
            w282 = w275 * w278 + w1 * w281
            w283 = X1_0 * w186
            w284 = X1_1 * w168
            w285 = w283 + w284
            w286 = w1 * w285
            w287 = 0.5 * w75
            w288 = X1_0 * w287
            w289 = 0.5 - X1_0 * w288
            w290 = X1_1 * w287
            w291 = w289 - X1_1 * w290
            w292 = 0.01 * w75
            w293 = X1_0 * w292
            w294 = 0.01 * w66
            w295 = X1_2 * w293 - X1_1 * w294
            w296 = -0.5 * w66
            w297 = X1_0 * w296
            w298 = w297 + X1_2 * w290
            w299 = X1_0 * w75
            w300 = X1_2 * w66
            w301 = X1_1 * w299 + w300
            w302 = -1.01 * X1_1
            w303 = 1.01 * X1_2
            w304 = w296 * w302 + w288 * w303
            w305 = X1_1 * w75
            w306 = X1_2 * w75
            w307 = X1_2 * w306
            w308 = 1.0 - X1_1 * w305 - w307
            w309 = w153 * w287
            w310 = a_2_1 * w296
            w311 = w69 * w292 + v1_1 * w294 - v1_2 * w293
            w312 = w54 - w53
            w313 = v1_2 * w66
            w314 = w75 * w312 - v1_1 * w299 - w313
            w315 = v1_2 * w306
            w316 = v1_1 * w305 + w315
            w317 = w309 + w310 - p_2 * w288 + w291 * w311 + w298 * w314 + w304 * w316
            w318 = w291 * w295 + w298 * w301 + w304 * w308 + w3 * w317
            w319 = X1_2 * w168 - w182
            w320 = w1 * w319
            w321 = X1_2 * w287
            w322 = X1_1 * w321 - w297
            w323 = w289 - X1_2 * w321
            w324 = w296 * w303 - w288 * w302
            w325 = w155 * w287
            w326 = p_2 * w296
            w327 = (
                w311 * w322 - (w325 + a_2_1 * w288 + w326) + w314 * w323 + w316 * w324
            )
            w328 = w295 * w322 + w301 * w323 + w308 * w324 + w3 * w327
            w329 = w159 + X1_2 * w186
            w330 = w1 * w329
            w331 = X1_0 * w321 + X1_1 * w296
            w332 = X1_0 * w290 - X1_2 * w296
            w333 = 0.505 + w290 * w302 - w303 * w321
            w334 = a_2_1 * w290
            w335 = p_2 * w321
            w336 = w334 + w335 + w311 * w331 + w314 * w332 + w316 * w333
            w337 = w295 * w331 + w301 * w332 + w308 * w333 + w3 * w336
            w338 = (
                w265 + w2 * w274 + w3 * w282 - w286 * w318 + w320 * w328 + w330 * w337
            )
            w339 = 0.08333333333333333 * X1_0
            w340 = -0.08333333333333333 * X1_1
            w341 = s_0 * w339 - s_1 * w340
            w342 = w1 * w341
            w343 = X1_1 * w64
            w344 = X1_0 * w62
            w345 = v1_1 * w64
            w346 = w62 * w69 - w345 - v1_2 * w344
            w347 = w343 + X1_2 * w344 + w3 * w346
            w348 = 0.08333333333333333 * X1_2
            w349 = 0.25 * a_4_0 - 0.08333333333333333 * w185 - s_1 * w348
            w350 = w1 * w349
            w351 = X1_2 * w64
            w352 = v1_2 * w64
            w353 = w62 * w312 - v1_1 * w344 + w352
            w354 = X1_1 * w344 - w351 + w3 * w353
            w355 = -0.08333333333333333 * X1_2
            w356 = s_0 * w355 - 0.08333333333333333 * (w162 - w160) - 0.25 * a_4_1
            w357 = w1 * w356
            w358 = X1_1 * w62
            w359 = X1_1 * w358
            w360 = X1_2 * w62
            w361 = X1_2 * w360
            w362 = v1_1 * w358
            w363 = v1_2 * w360
            w364 = w362 + w363
            w365 = 1.0 - w359 - w361 + w3 * w364
            w366 = X2_0 * w180
            w367 = X2_1 * w146
            w368 = w366 + w367
            w369 = w270 * w368
            w370 = 0.5 * w26
            w371 = w131 * w370
            w372 = -0.5 * w17
            w373 = a_6_1 * w372
            w374 = X2_0 * w370
            w375 = 0.5 - X2_0 * w374
            w376 = X2_1 * w370
            w377 = w375 - X2_1 * w376
            w378 = 0.01 * w26
            w379 = 0.01 * w17
            w380 = X2_0 * w378
            w381 = w20 * w378 + v2_1 * w379 - v2_2 * w380
            w382 = X2_0 * w372
            w383 = w382 + X2_2 * w376
            w384 = w5 - w4
            w385 = X2_0 * w26
            w386 = v2_2 * w17
            w387 = w26 * w384 - v2_1 * w385 - w386
            w388 = -1.01 * X2_1
            w389 = 1.01 * X2_2
            w390 = w372 * w388 + w374 * w389
            w391 = X2_1 * w26
            w392 = X2_2 * w26
            w393 = v2_2 * w392
            w394 = v2_1 * w391 + w393
            w395 = w371 + w373 - p_2_2 * w374 + w377 * w381 + w383 * w387 + w390 * w394
            w396 = w2 * w395
            w397 = X2_2 * w146 - w176
            w398 = w270 * w397
            w399 = X2_2 * w370
            w400 = X2_1 * w399 - w382
            w401 = w133 * w370
            w402 = p_2_2 * w372
            w403 = w375 - X2_2 * w399
            w404 = w372 * w389 - w374 * w388
            w405 = (
                w381 * w400 - (w401 + a_6_1 * w374 + w402) + w387 * w403 + w394 * w404
            )
            w406 = w2 * w405
            w407 = (
                w338
                + w342 * w347
                + w350 * w354
                + w357 * w365
                - w369 * w396
                + w398 * w406
            )
            w408 = w137 + X2_2 * w180
            w409 = w270 * w408
            w410 = a_6_1 * w376
            w411 = p_2_2 * w399
            w412 = X2_0 * w399 + X2_1 * w372
            w413 = X2_0 * w376 - X2_2 * w372
            w414 = 0.505 + w376 * w388 - w389 * w399
            w415 = w410 + w411 + w381 * w412 + w387 * w413 + w394 * w414
            w416 = w2 * w415
            w417 = 0.08333333333333333 * X2_0
            w418 = -0.08333333333333333 * X2_1
            w419 = s_2_0 * w417 - s_2_1 * w418
            w420 = w270 * w419
            w421 = v2_1 * w15
            w422 = X2_0 * w13
            w423 = w13 * w20 - w421 - v2_2 * w422
            w424 = w2 * w423
            w425 = 0.08333333333333333 * X2_2
            w426 = 0.25 * a_8_0 - 0.08333333333333333 * w179 - s_2_1 * w425
            w427 = w270 * w426
            w428 = v2_2 * w15
            w429 = w13 * w384 - v2_1 * w422 + w428
            w430 = w2 * w429
            w431 = -0.08333333333333333 * X2_2
            w432 = s_2_0 * w431 - 0.08333333333333333 * (w140 - w138) - 0.25 * a_8_1
            w433 = w270 * w432
            w434 = X2_1 * w13
            w435 = v2_1 * w434
            w436 = X2_2 * w13
            w437 = v2_2 * w436
            w438 = w435 + w437
            w439 = w2 * w438
            w440 = w1 * s_L_1
            w441 = w102 * w440
            w442 = w407 + w409 * w416 + w420 * w424 + w427 * w430 + w433 * w439 + w441
            w443 = X1_0 * w238 + X1_2 * w252
            w444 = X1_0 * w243 - X1_2 * w254
            w445 = 1.0 + X1_0 * w248 - X1_2 * w256
            w446 = w236 * w443 + w241 * w444 + w247 * w445
            w447 = w122 * c3_3
            w448 = w187 * w261 + w262 * (w118 - w117)
            w449 = w1 * (w447 + w260 * w448)
            w450 = w127 * c3_1
            w451 = Nn2_2 * c2_1
            w452 = w450 + Nn2_1 * w268 + w451
            w453 = s_2_0 * w146
            w454 = s_2_1 * w180 + w453
            w455 = w266 * w452 + w270 * w454
            w456 = w149 * c3_2
            w457 = Nn1_2 * c2_2
            w458 = w456 + Nn1_1 * w277 + w457
            w459 = s_0 * w168
            w460 = s_1 * w186 + w459
            w461 = w275 * w458 + w1 * w460
            w462 = w182 + X1_1 * w164
            w463 = w1 * w462
            w464 = X1_2 * w164
            w465 = w283 + w464
            w466 = w1 * w465
            w467 = X1_1 * w186 - w157
            w468 = w1 * w467
            w469 = (
                w449 - w2 * w455 - w3 * w461 + w318 * w463 - w328 * w466 + w337 * w468
            )
            w470 = -0.08333333333333333 * (w184 - w183) - 0.25 * a_4_0 + s_2 * w340
            w471 = w1 * w470
            w472 = -0.08333333333333333 * X1_0
            w473 = s_2 * w348 - s_0 * w472
            w474 = w1 * w473
            w475 = 0.08333333333333333 * X1_1
            w476 = -0.08333333333333333 * w167 - s_0 * w475 + 0.25 * a_4_2
            w477 = w1 * w476
            w478 = w176 + X2_1 * w142
            w479 = w270 * w478
            w480 = X2_2 * w142
            w481 = w366 + w480
            w482 = w270 * w481
            w483 = (
                w469
                + w347 * w471
                + w354 * w474
                + w365 * w477
                + w396 * w479
                - w406 * w482
            )
            w484 = X2_1 * w180 - w135
            w485 = w270 * w484
            w486 = -0.08333333333333333 * (w178 - w177) - 0.25 * a_8_0 + s_2_2 * w418
            w487 = w270 * w486
            w488 = -0.08333333333333333 * X2_0
            w489 = s_2_2 * w425 - s_2_0 * w488
            w490 = w270 * w489
            w491 = 0.08333333333333333 * X2_1
            w492 = -0.08333333333333333 * w145 - s_2_0 * w491 + 0.25 * a_8_2
            w493 = w270 * w492
            w494 = Y_0 * c3_3
            w495 = w440 * w494
            w496 = w483 + w416 * w485 + w424 * w487 + w430 * w490 + w439 * w493 - w495
            w497 = X1_2 * w239 - X1_1 * w238
            w498 = 0.9900990099009901 - X1_1 * w243 - X1_2 * w244
            w499 = X1_1 * w248
            w500 = X1_2 * w249 - w499
            w501 = w236 * w497 + w241 * w498 + w247 * w500
            w502 = w123 * w261 + w262 * (w114 - w111)
            w503 = w260 * w502 * w1
            w504 = X2_1 * c3_1
            w505 = X2_2 * c3_1
            w506 = Nn2_2 * w505
            w507 = Nn2_1 * w504 + w506
            w508 = s_2_1 * w146
            w509 = s_2_2 * w142
            w510 = w508 + w509 + w508 - s_2_2 * w271
            w511 = w266 * w507 + w270 * w510
            w512 = X1_1 * c3_2
            w513 = X1_2 * c3_2
            w514 = Nn1_2 * w513
            w515 = Nn1_1 * w512 + w514
            w516 = s_1 * w168
            w517 = s_2 * w164
            w518 = w516 + w517 + w516 - s_2 * w279
            w519 = w275 * w515 + w1 * w518
            w520 = X1_0 * w164 - w159
            w521 = w1 * w520
            w522 = w157 + X1_0 * w168
            w523 = w1 * w522
            w524 = w284 + w464
            w525 = w1 * w524
            w526 = (
                w503 + w2 * w511 + w3 * w519 + w318 * w521 + w328 * w523 - w337 * w525
            )
            w527 = 0.25 * a_4_1 - 0.08333333333333333 * w163 - s_2 * w339
            w528 = w1 * w527
            w529 = s_1 * w472 - 0.08333333333333333 * (w166 - w165) - 0.25 * a_4_2
            w530 = w1 * w529
            w531 = s_1 * w475 - s_2 * w355
            w532 = w1 * w531
            w533 = X2_0 * w142 - w137
            w534 = w270 * w533
            w535 = w135 + X2_0 * w146
            w536 = w270 * w535
            w537 = (
                w526
                + w347 * w528
                + w354 * w530
                + w365 * w532
                + w396 * w534
                + w406 * w536
            )
            w538 = w367 + w480
            w539 = w270 * w538
            w540 = 0.25 * a_8_1 - 0.08333333333333333 * w141 - s_2_2 * w417
            w541 = w270 * w540
            w542 = s_2_1 * w488 - 0.08333333333333333 * (w144 - w143) - 0.25 * a_8_2
            w543 = w270 * w542
            w544 = s_2_1 * w491 - s_2_2 * w431
            w545 = w270 * w544
            w546 = Y_1 * c3_3
            w547 = w440 * w546
            w548 = w537 - w416 * w539 + w424 * w541 + w430 * w543 + w439 * w545 + w547
            w549 = w1 * s_L_2
            w550 = Y_2 * c3_3
            w551 = w501 * w550 - (w102 * w446 + w259 * w494)
            w552 = w549 * w551
            w553 = 0.99 * a_2_2
            w554 = -2.0 * Q1_7
            w555 = w96 * (0.5 * w96 + 2.0 * w95 * w97) * w97
            w556 = 2.25 * w555
            w557 = 0.45 * w555
            w558 = w554 * w556 - Q1_8 * w557
            w559 = w92 * (0.5 * w92 + 2.0 * w91 * w93) * w93
            w560 = -2.25 * w559
            w561 = 0.45 * w559
            w562 = w554 * w560 - Q1_8 * w561
            w563 = -2.0 * w558 - w100 - 2.0 * w562
            w564 = g20 * X1_2
            w565 = g22 * X1_0
            w566 = w564 - w565
            w567 = g22 * w78
            w568 = g21 * c1_2
            w569 = w566 * c2_2 - (w567 + w568)
            w570 = w99 + 0.2 * w558 - 0.2 * w562
            w571 = g22 * c1_2
            w572 = g21 * w78
            w573 = g20 * X1_1
            w574 = w573 - g21 * X1_0
            w575 = w571 - w572 + w574 * c2_2
            w576 = w563 * w569 + w570 * w575 + w77 * w311 + w314 * w553
            w577 = w77 * w295 + w301 * w553 + w3 * w576
            w578 = X1_2 * w277 - w85
            w579 = w1 * Y_1
            w580 = w102 * w579
            w581 = w275 * w578 - w580
            w582 = w82 + X1_1 * w277
            w583 = w494 * w579
            w584 = w275 * w582 + w583
            w585 = X1_1 * w512
            w586 = X1_2 * w513
            w587 = 1.0 - w585 - w586
            w588 = w546 * w579
            w589 = w1 + w275 * w587 - w588
            w590 = w1 * Y_2
            w591 = w551 * w590
            w592 = w259 * w581 + w446 * w584 + w501 * w589 - w591
            w593 = (
                w3 * w251 + w259 * w442 + w446 * w496 + w501 * w548 + w552 + w577 * w592
            )
            w594 = -2.0 * Q2_7
            w595 = w47 * (0.5 * w47 + 2.0 * w46 * w48) * w48
            w596 = 2.25 * w595
            w597 = 0.45 * w595
            w598 = w594 * w596 - Q2_8 * w597
            w599 = w43 * (0.5 * w43 + 2.0 * w42 * w44) * w44
            w600 = -2.25 * w599
            w601 = 0.45 * w599
            w602 = w594 * w600 - Q2_8 * w601
            w603 = -2.0 * w598 - w51 - 2.0 * w602
            w604 = g20 * X2_2
            w605 = g22 * X2_0
            w606 = w604 - w605
            w607 = g22 * w29
            w608 = g21 * c1_1
            w609 = w606 * c2_1 - (w607 + w608)
            w610 = w50 + 0.2 * w598 - 0.2 * w602
            w611 = g22 * c1_1
            w612 = g21 * w29
            w613 = g20 * X2_1
            w614 = w613 - g21 * X2_0
            w615 = w611 - w612 + w614 * c2_1
            w616 = 0.99 * a_6_2
            w617 = w603 * w609 + w610 * w615 + w28 * w381 + w387 * w616
            w618 = w2 * w617
            w619 = X2_2 * w268 - w36
            w620 = w266 * w619 - w580
            w621 = w33 + X2_1 * w268
            w622 = w583 + w266 * w621
            w623 = X2_1 * w504
            w624 = X2_2 * w505
            w625 = 1.0 - w623 - w624
            w626 = w1 + w266 * w625 - w588
            w627 = w259 * w620 + w446 * w622 + w501 * w626 - w591
            w628 = 0.01 * a_2_1
            w629 = g22 * X1_2
            w630 = w629 + g21 * X1_1
            w631 = w630 * c2_2
            w632 = Q1_6 * w557
            w633 = Q1_6 * w561
            w634 = -2.0 * w632 - 2.0 * w633
            w635 = 0.2 * w632 - 0.2 * w633
            w636 = w100 * w631 + w569 * w634 + w575 * w635 + w113 * w314 + w316 * w628
            w637 = w113 * w301 + w308 * w628 + w3 * w636
            w638 = 1.0 - X1_0 * w277
            w639 = w638 - w585
            w640 = w1 + w275 * w639
            w641 = X1_1 * w513 - w78
            w642 = w275 * w641
            w643 = w85 + X1_0 * w513
            w644 = w275 * w643
            w645 = w1 * Y_0
            w646 = w551 * w645
            w647 = w259 * w546 - w446 * w550 - w102 * w501
            w648 = w579 * w647
            w649 = w259 * w640 + w446 * w642 + w501 * w644 + w646 - w648
            w650 = 2.0 * Q1_6
            w651 = w556 * w650
            w652 = w560 * w650
            w653 = -2.0 * w651 - 2.0 * w652
            w654 = 0.2 * w651 - 0.2 * w652
            w655 = w569 * w653 - w99 * w631 + w575 * w654 + w108 * w311 - a_2_2 * w316
            w656 = w108 * w295 - a_2_2 * w308 + w3 * w655
            w657 = w78 + X1_2 * w512
            w658 = w102 * w645
            w659 = w275 * w657 + w658
            w660 = w638 - w586
            w661 = w494 * w645
            w662 = w1 + w275 * w660 - w661
            w663 = X1_0 * w512 - w82
            w664 = w546 * w645
            w665 = w275 * w663 + w664
            w666 = w590 * w647
            w667 = w259 * w659 + w446 * w662 + w501 * w665 + w666
            w668 = 2.0 * X1_0
            w669 = w3 * w668
            w670 = c3_2 - c2_2
            w671 = slope2(w57)
            w672 = -0.25 * w670 - w193 + w59 * w671
            w673 = 0.5 * w670
            w674 = w673 * (1.0 - 0.08333333333333333 * w57) - w170 + 0.5 * w57 * w671
            w675 = 100.0 * w201 * w672 - 100.0 * w196 * w674
            w676 = 0.9900990099009901 * w200 * w672 - 0.9900990099009901 * w191 * w674
            w677 = w202 * w672 + w674 * (w198 - w197)
            w678 = slope3(w57)
            w679 = w181 * w678 + w149 * w671
            w680 = w57 * c2_2
            w681 = w60 * w60
            w682 = 0.25 - 0.16666666666666666 * w59
            w683 = 0.006944444444444444 * w60 - w61 * w681 * w682
            w684 = 0.5 * w681 * w682
            w685 = w57 * w62
            w686 = (
                (1.0 - w680) * w683
                - w74
                + w684 * c1_2
                + w64 * w673
                + w671 * (1.0 - w685)
            )
            w687 = (
                w65
                + w57 * c1_2 * w683
                + w684 * (w680 - 1.0)
                + w673 * (w685 - 1.0)
                + w57 * w64 * w671
            )
            w688 = 0.01 * w73 * w686 + 0.01 * w55 * w687
            w689 = w76 * w686 + w69 * w687
            w690 = w107 * w686 + w72 * w687
            w691 = (
                0.5 * w158 * w686
                - 0.5 * w155 * w687
                + w291 * w688
                + w298 * w689
                + w304 * w690
            )
            w692 = (
                0.5 * w156 * w686
                - 0.5 * w153 * w687
                + w322 * w688
                + w323 * w689
                + w324 * w690
            )
            w693 = (
                0.5 * w161 * w686
                - 0.5 * w154 * w687
                + w331 * w688
                + w332 * w689
                + w333 * w690
            )
            w694 = w73 * w683 + w312 * w684
            w695 = w68 - w67
            w696 = w76 * w683 + w684 * w695
            w697 = (
                w275 * w679
                - w286 * w691
                + w320 * w692
                + w330 * w693
                + w342 * w694
                + w350 * w696
            )
            w698 = w71 - w70
            w699 = w107 * w683 + w684 * w698
            w700 = w697 + w357 * w699
            w701 = (
                w206 * w672
                + w203 * w674
                + w236 * w675
                + w241 * w676
                + w247 * w677
                + w259 * w700
            )
            w702 = w190 * w678 + w150 * w671
            w703 = (
                w275 * w702
                + w463 * w691
                - w466 * w692
                + w468 * w693
                + w471 * w694
                + w474 * w696
            )
            w704 = w703 + w477 * w699
            w705 = w151 * w678 + w147 * w671
            w706 = (
                w275 * w705
                + w521 * w691
                + w523 * w692
                - w525 * w693
                + w528 * w694
                + w530 * w696
            )
            w707 = w706 + w532 * w699
            w708 = g21 * X1_2 - g22 * X1_1
            w709 = w671 * (X1_1 * w708 + X1_0 * w566) + w574 * w673
            w710 = w673 * (w565 - w564) + w671 * (X1_1 * w629 - g21 * w56 + X1_0 * w574)
            w711 = w563 * w709 + w570 * w710 + w77 * w688 + w553 * w689
            w712 = w673 * w708
            w713 = X1_0 * w630 - (g20 * w56 + X1_1 * w573)
            w714 = (
                w100 * w712
                + w100 * w713 * w671
                + w634 * w709
                + w635 * w710
                + w113 * w689
            )
            w715 = w714 + w628 * w690
            w716 = (
                w653 * w709
                - (w99 * w712 + w99 * w713 * w671)
                + w654 * w710
                + w108 * w688
            )
            w717 = w716 - a_2_2 * w690
            w718 = (
                w701
                + w446 * w704
                + w501 * w707
                + w592 * w711
                + w649 * w715
                + w667 * w717
            )
            w719 = g22 * X2_2
            w720 = w719 + g21 * X2_1
            w721 = w720 * c2_1
            w722 = Q2_6 * w597
            w723 = Q2_6 * w601
            w724 = -2.0 * w722 - 2.0 * w723
            w725 = 0.2 * w722 - 0.2 * w723
            w726 = 0.01 * a_6_1
            w727 = w51 * w721 + w609 * w724 + w615 * w725 + w112 * w387 + w394 * w726
            w728 = w2 * w727
            w729 = 1.0 - X2_0 * w268
            w730 = w729 - w623
            w731 = w1 + w266 * w730
            w732 = X2_1 * w505 - w29
            w733 = w266 * w732
            w734 = w36 + X2_0 * w505
            w735 = w266 * w734
            w736 = w259 * w731 + w446 * w733 + w501 * w735 + w646 - w648
            w737 = (
                w593
                + w618 * w627
                + w637 * w649
                + w656 * w667
                + w669 * w718
                + w728 * w736
            )
            w738 = 2.0 * Q2_6
            w739 = w596 * w738
            w740 = w600 * w738
            w741 = -2.0 * w739 - 2.0 * w740
            w742 = 0.2 * w739 - 0.2 * w740
            w743 = w609 * w741 - w50 * w721 + w615 * w742 + w104 * w381 - a_6_2 * w394
            w744 = w2 * w743
            w745 = w29 + X2_2 * w504
            w746 = w658 + w266 * w745
            w747 = w729 - w624
            w748 = w1 + w266 * w747 - w661
            w749 = X2_0 * w504 - w33
            w750 = w664 + w266 * w749
            w751 = w259 * w746 + w446 * w748 + w501 * w750 + w666
            w752 = 2.0 * X2_0
            w753 = w2 * w752
            w754 = slope3(w8)
            w755 = slope2(w8)
            w756 = w175 * w754 + w127 * w755
            w757 = w8 * c2_1
            w758 = w11 * w11
            w759 = 0.25 - 0.16666666666666666 * w10
            w760 = 0.006944444444444444 * w11 - w12 * w758 * w759
            w761 = 0.5 * w758 * w759
            w762 = c3_1 - c2_1
            w763 = 0.5 * w762
            w764 = w8 * w13
            w765 = (
                (1.0 - w757) * w760
                - w25
                + w761 * c1_1
                + w15 * w763
                + w755 * (1.0 - w764)
            )
            w766 = (
                w16
                + w8 * c1_1 * w760
                + w761 * (w757 - 1.0)
                + w763 * (w764 - 1.0)
                + w8 * w15 * w755
            )
            w767 = 0.01 * w24 * w765 + 0.01 * w6 * w766
            w768 = w27 * w765 + w20 * w766
            w769 = w103 * w765 + w23 * w766
            w770 = (
                0.5 * w136 * w765
                - 0.5 * w133 * w766
                + w377 * w767
                + w383 * w768
                + w390 * w769
            )
            w771 = (
                0.5 * w134 * w765
                - 0.5 * w131 * w766
                + w400 * w767
                + w403 * w768
                + w404 * w769
            )
            w772 = (
                0.5 * w139 * w765
                - 0.5 * w132 * w766
                + w412 * w767
                + w413 * w768
                + w414 * w769
            )
            w773 = w24 * w760 + w384 * w761
            w774 = w19 - w18
            w775 = w27 * w760 + w761 * w774
            w776 = (
                w266 * w756
                - w369 * w770
                + w398 * w771
                + w409 * w772
                + w420 * w773
                + w427 * w775
            )
            w777 = w22 - w21
            w778 = w103 * w760 + w761 * w777
            w779 = w776 + w433 * w778
            w780 = w189 * w754 + w128 * w755
            w781 = (
                w266 * w780
                + w479 * w770
                - w482 * w771
                + w485 * w772
                + w487 * w773
                + w490 * w775
            )
            w782 = w781 + w493 * w778
            w783 = w129 * w754 + w125 * w755
            w784 = (
                w266 * w783
                + w534 * w770
                + w536 * w771
                - w539 * w772
                + w541 * w773
                + w543 * w775
            )
            w785 = w784 + w545 * w778
            w786 = g21 * X2_2 - g22 * X2_1
            w787 = w755 * (X2_1 * w786 + X2_0 * w606) + w614 * w763
            w788 = w763 * (w605 - w604) + w755 * (X2_1 * w719 - g21 * w7 + X2_0 * w614)
            w789 = w603 * w787 + w610 * w788 + w28 * w767 + w616 * w768
            w790 = w763 * w786
            w791 = X2_0 * w720 - (g20 * w7 + X2_1 * w613)
            w792 = (
                w51 * w790 + w51 * w791 * w755 + w724 * w787 + w725 * w788 + w112 * w768
            )
            w793 = w792 + w726 * w769
            w794 = (
                w741 * w787
                - (w50 * w790 + w50 * w791 * w755)
                + w742 * w788
                + w104 * w767
            )
            w795 = w794 - a_6_2 * w769
            w796 = (
                w259 * w779
                + w446 * w782
                + w501 * w785
                + w627 * w789
                + w736 * w793
                + w751 * w795
            )
            w797 = w172 * Wxi1_2
            w798 = w191 * w237 + w1_0 * w238 + w1_2 * w252
            w799 = w196 * w242 - w1_0 * w243 + w1_2 * w254
            w800 = w1_2 * w256 - w1_0 * w248
            w801 = (
                w195 * w204
                - Wxi1_0 * w232
                + w797
                - w236 * w798
                + w241 * w799
                + w247 * w800
            )
            w802 = w115 * c3_3
            w803 = 2.0 * Y_1
            w804 = w1 * (w802 + w263 * w803)
            w805 = w125 * c3_1 + Nn2_0 * c2_1
            w806 = w805 + Nn2_2 * w504
            w807 = s_2_1 * w142
            w808 = s_2_2 * w146 + w807
            w809 = w266 * w806 + w270 * w808
            w810 = w147 * c3_2 + Nn1_0 * c2_2
            w811 = w810 + Nn1_2 * w512
            w812 = s_1 * w164
            w813 = s_2 * w168 + w812
            w814 = w275 * w811 + w1 * w813
            w815 = X1_1 * w292
            w816 = X1_0 * w294 + X1_2 * w815
            w817 = 1.0 - X1_0 * w299 - w307
            w818 = X1_0 * w305 - w300
            w819 = w292 * w698 - v1_0 * w294 - v1_2 * w815
            w820 = w154 * w287 + p_0 * w296
            w821 = w315 + v1_0 * w299
            w822 = w55 * w75 - v1_0 * w305 + w313
            w823 = w291 * w819 - (w820 + p_2 * w290) + w298 * w821 + w304 * w822
            w824 = w291 * w816 + w298 * w817 + w304 * w818 + w3 * w823
            w825 = p_0 * w288
            w826 = w335 + w825 + w322 * w819 + w323 * w821 + w324 * w822
            w827 = w322 * w816 + w323 * w817 + w324 * w818 + w3 * w826
            w828 = w325 - p_0 * w290 + w326 + w331 * w819 + w332 * w821 + w333 * w822
            w829 = w331 * w816 + w332 * w817 + w333 * w818 + w3 * w828
            w830 = (
                w804 - w2 * w809 - w3 * w814 - w286 * w824 + w320 * w827 + w330 * w829
            )
            w831 = X1_0 * w64
            w832 = v1_0 * w64
            w833 = w62 * w698 + w832 - v1_2 * w358
            w834 = X1_2 * w358 - w831 + w3 * w833
            w835 = 1.0 - X1_0 * w344
            w836 = v1_0 * w344
            w837 = w363 + w836
            w838 = w835 - w361 + w3 * w837
            w839 = w55 * w62 - v1_0 * w358 - w352
            w840 = w351 + X1_0 * w358 + w3 * w839
            w841 = X2_1 * w378
            w842 = w378 * w777 - v2_0 * w379 - v2_2 * w841
            w843 = w132 * w370 + p_2_0 * w372
            w844 = w393 + v2_0 * w385
            w845 = w6 * w26 - v2_0 * w391 + w386
            w846 = w377 * w842 - (w843 + p_2_2 * w376) + w383 * w844 + w390 * w845
            w847 = w2 * w846
            w848 = p_2_0 * w374
            w849 = w411 + w848 + w400 * w842 + w403 * w844 + w404 * w845
            w850 = w2 * w849
            w851 = (
                w830
                + w342 * w834
                + w350 * w838
                + w357 * w840
                - w369 * w847
                + w398 * w850
            )
            w852 = w401 - p_2_0 * w376 + w402 + w412 * w842 + w413 * w844 + w414 * w845
            w853 = w2 * w852
            w854 = v2_0 * w15
            w855 = w13 * w777 + w854 - v2_2 * w434
            w856 = w2 * w855
            w857 = v2_0 * w422
            w858 = w437 + w857
            w859 = w2 * w858
            w860 = w6 * w13 - v2_0 * w434 - w428
            w861 = w2 * w860
            w862 = w1 * s_L_0
            w863 = w102 * w862
            w864 = w851 + w409 * w853 + w420 * w856 + w427 * w859 + w433 * w861 - w863
            w865 = w448 * w803 * w1
            w866 = Nn2_0 * w268
            w867 = w506 + w866
            w868 = s_2_0 * w180
            w869 = 0.08333333333333333 * a_5_0
            w870 = w509 + w868 - s_2_0 * w869 + w509
            w871 = w266 * w867 + w270 * w870
            w872 = Nn1_0 * w277
            w873 = w514 + w872
            w874 = s_0 * w186
            w875 = 0.08333333333333333 * a_0
            w876 = w517 + w874 - s_0 * w875 + w517
            w877 = w275 * w873 + w1 * w876
            w878 = (
                w865 + w2 * w871 + w3 * w877 + w463 * w824 - w466 * w827 + w468 * w829
            )
            w879 = (
                w878
                + w471 * w834
                + w474 * w838
                + w477 * w840
                + w479 * w847
                - w482 * w850
            )
            w880 = w494 * w862
            w881 = w879 + w485 * w853 + w487 * w856 + w490 * w859 + w493 * w861 + w880
            w882 = w1 * (w502 * w803 - w447)
            w883 = w450 - Nn2_0 * w504 + w451
            w884 = s_2_1 * w869 - w453
            w885 = w266 * w883 + w270 * w884
            w886 = w456 - Nn1_0 * w512 + w457
            w887 = s_1 * w875 - w459
            w888 = w275 * w886 + w1 * w887
            w889 = (
                w882 + w2 * w885 + w3 * w888 + w521 * w824 + w523 * w827 - w525 * w829
            )
            w890 = (
                w889
                + w528 * w834
                + w530 * w838
                + w532 * w840
                + w534 * w847
                + w536 * w850
            )
            w891 = w546 * w862
            w892 = w890 - w539 * w853 + w541 * w856 + w543 * w859 + w545 * w861 - w891
            w893 = g20 * c1_2
            w894 = g22 * w85
            w895 = w893 - w894 + w708 * c2_2
            w896 = g20 * w78
            w897 = w896 + w629 * c2_2
            w898 = w563 * w895 + w570 * w897 + w77 * w819 + w553 * w821
            w899 = w77 * w816 + w553 * w817 + w3 * w898
            w900 = g20 * c1_1
            w901 = g22 * w36
            w902 = w900 - w901 + w786 * c2_1
            w903 = g20 * w29
            w904 = w903 + w719 * c2_1
            w905 = w603 * w902 + w610 * w904 + w28 * w842 + w616 * w844
            w906 = w2 * w905
            w907 = (
                w3 * w801
                + w259 * w864
                + w446 * w881
                + w501 * w892
                + w592 * w899
                + w627 * w906
            )
            w908 = w549 * w647
            w909 = w572 - g20 * w85 - w571 - w573 * c2_2
            w910 = w100 * w909 + w634 * w895 + w635 * w897 + w113 * w821 + w628 * w822
            w911 = w113 * w817 + w628 * w818 + w3 * w910
            w912 = w653 * w895 - w99 * w909 + w654 * w897 + w108 * w819 - a_2_2 * w822
            w913 = w108 * w816 - a_2_2 * w818 + w3 * w912
            w914 = 2.0 * X1_1
            w915 = w3 * w914
            w916 = w612 - g20 * w36 - w611 - w613 * c2_1
            w917 = w51 * w916 + w724 * w902 + w725 * w904 + w112 * w844 + w726 * w845
            w918 = w2 * w917
            w919 = w741 * w902 - w50 * w916 + w742 * w904 + w104 * w842 - a_6_2 * w845
            w920 = w2 * w919
            w921 = (
                w907
                - w908
                + w649 * w911
                + w667 * w913
                + w718 * w915
                + w736 * w918
                + w751 * w920
            )
            w922 = 2.0 * X2_1
            w923 = w2 * w922
            w924 = w172 * Pxi1_1
            w925 = w1_0 * w239 + w1_1 * w252
            w926 = w199 * w242 + w1_0 * w244 + w1_1 * w254
            w927 = w1_0 * w249 + w191 * w195 - w1_1 * w256
            w928 = (
                w205 * w233
                + Wxi1_0 * w234
                - w924
                + w236 * w925
                - w241 * w926
                + w247 * w927
            )
            w929 = 2.0 * Y_2
            w930 = w263 * w929 * w1
            w931 = w106 - w105
            w932 = w866 - w504 * w931
            w933 = 0.08333333333333333 * a_5_1
            w934 = w508 + w868 + w868 - s_2_1 * w933
            w935 = w266 * w932 + w270 * w934
            w936 = w110 - w109
            w937 = w872 - w512 * w936
            w938 = 0.08333333333333333 * a_1
            w939 = w516 + w874 + w874 - s_1 * w938
            w940 = w275 * w937 + w1 * w939
            w941 = 0.01 - X1_0 * w293 - X1_1 * w815
            w942 = X1_1 * w306 - X1_0 * w66
            w943 = X1_0 * w306 + X1_1 * w66
            w944 = v1_0 * w293 + v1_1 * w815
            w945 = w72 * w75 + v1_0 * w66 - v1_1 * w306
            w946 = w75 * w695 - v1_0 * w306 - v1_1 * w66
            w947 = w334 + w825 + w291 * w944 + w298 * w945 + w304 * w946
            w948 = w291 * w941 + w298 * w942 + w304 * w943 + w3 * w947
            w949 = w820 - a_2_1 * w321 + w322 * w944 + w323 * w945 + w324 * w946
            w950 = w322 * w941 + w323 * w942 + w324 * w943 + w3 * w949
            w951 = w331 * w944 - (w309 + p_0 * w321 + w310) + w332 * w945 + w333 * w946
            w952 = w331 * w941 + w332 * w942 + w333 * w943 + w3 * w951
            w953 = (
                w930 + w2 * w935 + w3 * w940 - w286 * w948 + w320 * w950 + w330 * w952
            )
            w954 = w362 + w836
            w955 = w835 - w359 + w3 * w954
            w956 = w62 * w72 - w832 - v1_1 * w360
            w957 = w831 + X1_1 * w360 + w3 * w956
            w958 = w62 * w695 - v1_0 * w360 + w345
            w959 = X1_0 * w360 - w343 + w3 * w958
            w960 = v2_0 * w380 + v2_1 * w841
            w961 = w23 * w26 + v2_0 * w17 - v2_1 * w392
            w962 = w26 * w774 - v2_0 * w392 - v2_1 * w17
            w963 = w410 + w848 + w377 * w960 + w383 * w961 + w390 * w962
            w964 = w2 * w963
            w965 = w843 - a_6_1 * w399 + w400 * w960 + w403 * w961 + w404 * w962
            w966 = w2 * w965
            w967 = (
                w953
                + w342 * w955
                + w350 * w957
                + w357 * w959
                - w369 * w964
                + w398 * w966
            )
            w968 = (
                w412 * w960 - (w371 + p_2_0 * w399 + w373) + w413 * w961 + w414 * w962
            )
            w969 = w2 * w968
            w970 = w435 + w857
            w971 = w2 * w970
            w972 = w13 * w23 - w854 - v2_1 * w436
            w973 = w2 * w972
            w974 = w13 * w774 - v2_0 * w436 + w421
            w975 = w2 * w974
            w976 = w967 + w409 * w969 + w420 * w971 + w427 * w973 + w433 * w975
            w977 = w1 * (w448 * w929 - w802)
            w978 = w805 + w505 * w931
            w979 = s_2_2 * w933 - w807
            w980 = w266 * w978 + w270 * w979
            w981 = w810 + w513 * w936
            w982 = s_2 * w938 - w812
            w983 = w275 * w981 + w1 * w982
            w984 = (
                w977 + w2 * w980 + w3 * w983 + w463 * w948 - w466 * w950 + w468 * w952
            )
            w985 = (
                w984
                + w471 * w955
                + w474 * w957
                + w477 * w959
                + w479 * w964
                - w482 * w966
            )
            w986 = w985 + w485 * w969 + w487 * w971 + w490 * w973 + w493 * w975
            w987 = w1 * (w264 + w502 * w929)
            w988 = w931 * c2_1 - (w267 + Nn2_0 * w505)
            w989 = w272 + s_2_0 * w142
            w990 = w266 * w988 - w270 * w989
            w991 = w936 * c2_2 - (w276 + Nn1_0 * w513)
            w992 = w280 + s_0 * w164
            w993 = w275 * w991 - w1 * w992
            w994 = (
                w987 + w2 * w990 + w3 * w993 + w521 * w948 + w523 * w950 - w525 * w952
            )
            w995 = (
                w994
                + w528 * w955
                + w530 * w957
                + w532 * w959
                + w534 * w964
                + w536 * w966
            )
            w996 = w995 - w539 * w969 + w541 * w971 + w543 * w973 + w545 * w975
            w997 = w551 * w862
            w998 = w896 + g21 * w85
            w999 = 2.0 * w82
            w1000 = w894 - g21 * w999 - w893
            w1001 = w563 * w998 + w570 * w1000 + w77 * w944 + w553 * w945
            w1002 = w77 * w941 + w553 * w942 + w3 * w1001
            w1003 = (
                w3 * w928
                + w259 * w976
                + w446 * w986
                + w501 * w996
                - w997
                + w592 * w1002
            )
            w1004 = w903 + g21 * w36
            w1005 = 2.0 * w33
            w1006 = w901 - g21 * w1005 - w900
            w1007 = w603 * w1004 + w610 * w1006 + w28 * w960 + w616 * w961
            w1008 = w2 * w1007
            w1009 = w440 * w647
            w1010 = w567 - g20 * w999 + w568
            w1011 = (
                w100 * w1010 + w634 * w998 + w635 * w1000 + w113 * w945 + w628 * w946
            )
            w1012 = w113 * w942 + w628 * w943 + w3 * w1011
            w1013 = (
                w653 * w998 - w99 * w1010 + w654 * w1000 + w108 * w944 - a_2_2 * w946
            )
            w1014 = w108 * w941 - a_2_2 * w943 + w3 * w1013
            w1015 = 2.0 * X1_2
            w1016 = w3 * w1015
            w1017 = w607 - g20 * w1005 + w608
            w1018 = (
                w51 * w1017 + w724 * w1004 + w725 * w1006 + w112 * w961 + w726 * w962
            )
            w1019 = w2 * w1018
            w1020 = (
                w1003
                + w627 * w1008
                + w1009
                + w649 * w1012
                + w667 * w1014
                + w718 * w1016
                + w736 * w1019
            )
            w1021 = (
                w741 * w1004 - w50 * w1017 + w742 * w1006 + w104 * w960 - a_6_2 * w962
            )
            w1022 = w2 * w1021
            w1023 = 2.0 * X2_2
            w1024 = w2 * w1023
            w1025 = w52 * w317
            w1026 = w52 * w327
            w1027 = w52 * w336
            w1028 = (
                w265
                + w3 * w274
                + w52 * w282
                - w286 * w1025
                + w320 * w1026
                + w330 * w1027
            )
            w1029 = w52 * w346
            w1030 = w52 * w353
            w1031 = w52 * w364
            w1032 = X2_2 * w380 - X2_1 * w379
            w1033 = X2_2 * w17
            w1034 = X2_1 * w385 + w1033
            w1035 = X2_2 * w392
            w1036 = 1.0 - X2_1 * w391 - w1035
            w1037 = w377 * w1032 + w383 * w1034 + w390 * w1036 + w3 * w395
            w1038 = w400 * w1032 + w403 * w1034 + w404 * w1036 + w3 * w405
            w1039 = (
                w1028
                + w342 * w1029
                + w350 * w1030
                + w357 * w1031
                - w369 * w1037
                + w398 * w1038
            )
            w1040 = w412 * w1032 + w413 * w1034 + w414 * w1036 + w3 * w415
            w1041 = X2_1 * w15
            w1042 = w1041 + X2_2 * w422 + w3 * w423
            w1043 = X2_2 * w15
            w1044 = X2_1 * w422 - w1043 + w3 * w429
            w1045 = X2_1 * w434
            w1046 = X2_2 * w436
            w1047 = 1.0 - w1045 - w1046 + w3 * w438
            w1048 = (
                w1039 + w409 * w1040 + w420 * w1042 + w427 * w1044 + w433 * w1047 + w441
            )
            w1049 = (
                w449
                - w3 * w455
                - w52 * w461
                + w463 * w1025
                - w466 * w1026
                + w468 * w1027
            )
            w1050 = (
                w1049
                + w471 * w1029
                + w474 * w1030
                + w477 * w1031
                + w479 * w1037
                - w482 * w1038
            )
            w1051 = (
                w1050 + w485 * w1040 + w487 * w1042 + w490 * w1044 + w493 * w1047 - w495
            )
            w1052 = (
                w503
                + w3 * w511
                + w52 * w519
                + w521 * w1025
                + w523 * w1026
                - w525 * w1027
            )
            w1053 = (
                w1052
                + w528 * w1029
                + w530 * w1030
                + w532 * w1031
                + w534 * w1037
                + w536 * w1038
            )
            w1054 = (
                w1053 - w539 * w1040 + w541 * w1042 + w543 * w1044 + w545 * w1047 + w547
            )
            w1055 = w52 * w576
            w1056 = (
                w52 * w251
                + w259 * w1048
                + w446 * w1051
                + w501 * w1054
                + w552
                + w592 * w1055
            )
            w1057 = w28 * w1032 + w616 * w1034 + w3 * w617
            w1058 = w52 * w636
            w1059 = w52 * w655
            w1060 = w52 * w668
            w1061 = w112 * w1034 + w726 * w1036 + w3 * w727
            w1062 = (
                w1056
                + w627 * w1057
                + w649 * w1058
                + w667 * w1059
                + w718 * w1060
                + w736 * w1061
            )
            w1063 = w104 * w1032 - a_6_2 * w1036 + w3 * w743
            w1064 = w3 * w752
            w1065 = w52 * w823
            w1066 = w52 * w826
            w1067 = w52 * w828
            w1068 = (
                w804
                - w3 * w809
                - w52 * w814
                - w286 * w1065
                + w320 * w1066
                + w330 * w1067
            )
            w1069 = w52 * w833
            w1070 = w52 * w837
            w1071 = w52 * w839
            w1072 = X2_0 * w379 + X2_2 * w841
            w1073 = 1.0 - X2_0 * w385 - w1035
            w1074 = X2_0 * w391 - w1033
            w1075 = w377 * w1072 + w383 * w1073 + w390 * w1074 + w3 * w846
            w1076 = w400 * w1072 + w403 * w1073 + w404 * w1074 + w3 * w849
            w1077 = (
                w1068
                + w342 * w1069
                + w350 * w1070
                + w357 * w1071
                - w369 * w1075
                + w398 * w1076
            )
            w1078 = w412 * w1072 + w413 * w1073 + w414 * w1074 + w3 * w852
            w1079 = X2_0 * w15
            w1080 = X2_2 * w434 - w1079 + w3 * w855
            w1081 = 1.0 - X2_0 * w422
            w1082 = w1081 - w1046 + w3 * w858
            w1083 = w1043 + X2_0 * w434 + w3 * w860
            w1084 = (
                w1077 + w409 * w1078 + w420 * w1080 + w427 * w1082 + w433 * w1083 - w863
            )
            w1085 = (
                w865
                + w3 * w871
                + w52 * w877
                + w463 * w1065
                - w466 * w1066
                + w468 * w1067
            )
            w1086 = (
                w1085
                + w471 * w1069
                + w474 * w1070
                + w477 * w1071
                + w479 * w1075
                - w482 * w1076
            )
            w1087 = (
                w1086 + w485 * w1078 + w487 * w1080 + w490 * w1082 + w493 * w1083 + w880
            )
            w1088 = (
                w882
                + w3 * w885
                + w52 * w888
                + w521 * w1065
                + w523 * w1066
                - w525 * w1067
            )
            w1089 = (
                w1088
                + w528 * w1069
                + w530 * w1070
                + w532 * w1071
                + w534 * w1075
                + w536 * w1076
            )
            w1090 = (
                w1089 - w539 * w1078 + w541 * w1080 + w543 * w1082 + w545 * w1083 - w891
            )
            w1091 = w52 * w898
            w1092 = w28 * w1072 + w616 * w1073 + w3 * w905
            w1093 = (
                w52 * w801
                + w259 * w1084
                + w446 * w1087
                + w501 * w1090
                + w592 * w1091
                + w627 * w1092
            )
            w1094 = w52 * w910
            w1095 = w52 * w912
            w1096 = w52 * w914
            w1097 = w112 * w1073 + w726 * w1074 + w3 * w917
            w1098 = w104 * w1072 - a_6_2 * w1074 + w3 * w919
            w1099 = (
                w1093
                - w908
                + w649 * w1094
                + w667 * w1095
                + w718 * w1096
                + w736 * w1097
                + w751 * w1098
            )
            w1100 = w3 * w922
            w1101 = w52 * w947
            w1102 = w52 * w949
            w1103 = w52 * w951
            w1104 = (
                w930
                + w3 * w935
                + w52 * w940
                - w286 * w1101
                + w320 * w1102
                + w330 * w1103
            )
            w1105 = w52 * w954
            w1106 = w52 * w956
            w1107 = w52 * w958
            w1108 = 0.01 - X2_0 * w380 - X2_1 * w841
            w1109 = X2_1 * w392 - X2_0 * w17
            w1110 = X2_0 * w392 + X2_1 * w17
            w1111 = w377 * w1108 + w383 * w1109 + w390 * w1110 + w3 * w963
            w1112 = w400 * w1108 + w403 * w1109 + w404 * w1110 + w3 * w965
            w1113 = (
                w1104
                + w342 * w1105
                + w350 * w1106
                + w357 * w1107
                - w369 * w1111
                + w398 * w1112
            )
            w1114 = w412 * w1108 + w413 * w1109 + w414 * w1110 + w3 * w968
            w1115 = w1081 - w1045 + w3 * w970
            w1116 = w1079 + X2_1 * w436 + w3 * w972
            w1117 = X2_0 * w436 - w1041 + w3 * w974
            w1118 = w1113 + w409 * w1114 + w420 * w1115 + w427 * w1116 + w433 * w1117
            w1119 = (
                w977
                + w3 * w980
                + w52 * w983
                + w463 * w1101
                - w466 * w1102
                + w468 * w1103
            )
            w1120 = (
                w1119
                + w471 * w1105
                + w474 * w1106
                + w477 * w1107
                + w479 * w1111
                - w482 * w1112
            )
            w1121 = w1120 + w485 * w1114 + w487 * w1115 + w490 * w1116 + w493 * w1117
            w1122 = (
                w987
                + w3 * w990
                + w52 * w993
                + w521 * w1101
                + w523 * w1102
                - w525 * w1103
            )
            w1123 = (
                w1122
                + w528 * w1105
                + w530 * w1106
                + w532 * w1107
                + w534 * w1111
                + w536 * w1112
            )
            w1124 = w1123 - w539 * w1114 + w541 * w1115 + w543 * w1116 + w545 * w1117
            w1125 = w52 * w1001
            w1126 = (
                w52 * w928
                + w259 * w1118
                + w446 * w1121
                + w501 * w1124
                - w997
                + w592 * w1125
            )
            w1127 = w28 * w1108 + w616 * w1109 + w3 * w1007
            w1128 = w52 * w1011
            w1129 = w52 * w1013
            w1130 = w52 * w1015
            w1131 = w112 * w1109 + w726 * w1110 + w3 * w1018
            w1132 = (
                w1126
                + w627 * w1127
                + w1009
                + w649 * w1128
                + w667 * w1129
                + w718 * w1130
                + w736 * w1131
            )
            w1133 = w104 * w1108 - a_6_2 * w1110 + w3 * w1021
            w1134 = w3 * w1023
            w1135 = X1_0 * w172
            w1136 = w257 - w1135
            w1137 = w246 - w499
            w1138 = (
                w204 * w233
                + Pxi1_1 * w248
                - w797
                + w240 * w1136
                + w245 * w1137
                + w250 * w445
            )
            w1139 = w253 * w1136 + w255 * w1137 + w258 * w445
            w1140 = w443 * w1136 + w444 * w1137 + w445 * w445
            w1141 = w497 * w1136 + w498 * w1137 + w445 * w500
            w1142 = w550 * w1141 - (w494 * w1139 + w102 * w1140)
            w1143 = w549 * w1142
            w1144 = w590 * w1142
            w1145 = w581 * w1139 + w584 * w1140 + w589 * w1141 - w1144
            w1146 = (
                w3 * w1138
                + w442 * w1139
                + w496 * w1140
                + w548 * w1141
                + w1143
                + w577 * w1145
            )
            w1147 = w620 * w1139 + w622 * w1140 + w626 * w1141 - w1144
            w1148 = w645 * w1142
            w1149 = w546 * w1139 - w550 * w1140 - w102 * w1141
            w1150 = w579 * w1149
            w1151 = w642 * w1140 + w640 * w1139 + w644 * w1141 + w1148 - w1150
            w1152 = w590 * w1149
            w1153 = w659 * w1139 + w662 * w1140 + w665 * w1141 + w1152
            w1154 = (
                w207 * w672
                + w205 * w674
                + w675 * w1136
                + w676 * w1137
                + w445 * w677
                + w700 * w1139
            )
            w1155 = (
                w1154
                + w704 * w1140
                + w707 * w1141
                + w711 * w1145
                + w715 * w1151
                + w717 * w1153
            )
            w1156 = w733 * w1140 + w731 * w1139 + w735 * w1141 + w1148 - w1150
            w1157 = (
                w1146
                + w618 * w1147
                + w637 * w1151
                + w656 * w1153
                + w669 * w1155
                + w728 * w1156
            )
            w1158 = w746 * w1139 + w748 * w1140 + w750 * w1141 + w1152
            w1159 = (
                w779 * w1139
                + w782 * w1140
                + w785 * w1141
                + w789 * w1147
                + w793 * w1156
                + w795 * w1158
            )
            w1160 = (
                Wxi1_2 * w256
                - Wxi1_0 * w248
                - w798 * w1136
                + w799 * w1137
                + w445 * w800
            )
            w1161 = (
                w3 * w1160
                + w864 * w1139
                + w881 * w1140
                + w892 * w1141
                + w899 * w1145
                + w906 * w1147
            )
            w1162 = w549 * w1149
            w1163 = (
                w1161
                - w1162
                + w911 * w1151
                + w913 * w1153
                + w915 * w1155
                + w918 * w1156
                + w920 * w1158
            )
            w1164 = w172 * Wxi1_0
            w1165 = (
                w195 * w203
                + w1164
                - Pxi1_1 * w256
                + w925 * w1136
                - w926 * w1137
                + w445 * w927
            )
            w1166 = w862 * w1142
            w1167 = (
                w3 * w1165
                + w976 * w1139
                + w986 * w1140
                + w996 * w1141
                - w1166
                + w1002 * w1145
            )
            w1168 = w440 * w1149
            w1169 = (
                w1167
                + w1008 * w1147
                + w1168
                + w1012 * w1151
                + w1014 * w1153
                + w1016 * w1155
                + w1019 * w1156
            )
            w1170 = (
                w52 * w1138
                + w1048 * w1139
                + w1051 * w1140
                + w1054 * w1141
                + w1143
                + w1055 * w1145
            )
            w1171 = (
                w1170
                + w1057 * w1147
                + w1058 * w1151
                + w1059 * w1153
                + w1060 * w1155
                + w1061 * w1156
            )
            w1172 = (
                w52 * w1160
                + w1084 * w1139
                + w1087 * w1140
                + w1090 * w1141
                + w1091 * w1145
                + w1092 * w1147
            )
            w1173 = (
                w1172
                - w1162
                + w1094 * w1151
                + w1095 * w1153
                + w1096 * w1155
                + w1097 * w1156
                + w1098 * w1158
            )
            w1174 = (
                w52 * w1165
                + w1118 * w1139
                + w1121 * w1140
                + w1124 * w1141
                - w1166
                + w1125 * w1145
            )
            w1175 = (
                w1174
                + w1127 * w1147
                + w1168
                + w1128 * w1151
                + w1129 * w1153
                + w1130 * w1155
                + w1131 * w1156
            )
            w1176 = X1_0 * w195
            w1177 = X1_1 * w233
            w1178 = 1.0 - X1_0 * w1176 + X1_1 * w1177
            w1179 = X1_2 * w1176 - w235
            w1180 = w1135 - X1_2 * w1177
            w1181 = (
                w924
                + w195 * w205
                - Wxi1_2 * w1176
                + w240 * w1178
                + w245 * w1179
                + w250 * w1180
            )
            w1182 = w253 * w1178 + w255 * w1179 + w258 * w1180
            w1183 = w443 * w1178 + w444 * w1179 + w445 * w1180
            w1184 = w497 * w1178 + w498 * w1179 + w500 * w1180
            w1185 = w550 * w1184 - (w494 * w1182 + w102 * w1183)
            w1186 = w549 * w1185
            w1187 = w590 * w1185
            w1188 = w581 * w1182 + w584 * w1183 + w589 * w1184 - w1187
            w1189 = (
                w3 * w1181
                + w442 * w1182
                + w496 * w1183
                + w548 * w1184
                + w1186
                + w577 * w1188
            )
            w1190 = w620 * w1182 + w622 * w1183 + w626 * w1184 - w1187
            w1191 = w645 * w1185
            w1192 = w546 * w1182 - w550 * w1183 - w102 * w1184
            w1193 = w579 * w1192
            w1194 = w642 * w1183 + w640 * w1182 + w644 * w1184 + w1191 - w1193
            w1195 = w590 * w1192
            w1196 = w659 * w1182 + w662 * w1183 + w665 * w1184 + w1195
            w1197 = (
                w208 * w672
                + w204 * w674
                + w675 * w1178
                + w676 * w1179
                + w677 * w1180
                + w700 * w1182
            )
            w1198 = (
                w1197
                + w704 * w1183
                + w707 * w1184
                + w711 * w1188
                + w715 * w1194
                + w717 * w1196
            )
            w1199 = w733 * w1183 + w731 * w1182 + w735 * w1184 + w1191 - w1193
            w1200 = (
                w1189
                + w618 * w1190
                + w637 * w1194
                + w656 * w1196
                + w669 * w1198
                + w728 * w1199
            )
            w1201 = w746 * w1182 + w748 * w1183 + w750 * w1184 + w1195
            w1202 = (
                w779 * w1182
                + w782 * w1183
                + w785 * w1184
                + w789 * w1190
                + w793 * w1199
                + w795 * w1201
            )
            w1203 = (
                w203 * w233
                - w1164
                + Wxi1_2 * w1177
                - w798 * w1178
                + w799 * w1179
                + w800 * w1180
            )
            w1204 = (
                w3 * w1203
                + w864 * w1182
                + w881 * w1183
                + w892 * w1184
                + w899 * w1188
                + w906 * w1190
            )
            w1205 = w549 * w1192
            w1206 = (
                w1204
                - w1205
                + w911 * w1194
                + w913 * w1196
                + w915 * w1198
                + w918 * w1199
                + w920 * w1201
            )
            w1207 = (
                Wxi1_0 * w1176
                - Pxi1_1 * w1177
                + w925 * w1178
                - w926 * w1179
                + w927 * w1180
            )
            w1208 = w862 * w1185
            w1209 = (
                w3 * w1207
                + w976 * w1182
                + w986 * w1183
                + w996 * w1184
                - w1208
                + w1002 * w1188
            )
            w1210 = w440 * w1192
            w1211 = (
                w1209
                + w1008 * w1190
                + w1210
                + w1012 * w1194
                + w1014 * w1196
                + w1016 * w1198
                + w1019 * w1199
            )
            w1212 = (
                w52 * w1181
                + w1048 * w1182
                + w1051 * w1183
                + w1054 * w1184
                + w1186
                + w1055 * w1188
            )
            w1213 = (
                w1212
                + w1057 * w1190
                + w1058 * w1194
                + w1059 * w1196
                + w1060 * w1198
                + w1061 * w1199
            )
            w1214 = (
                w52 * w1203
                + w1084 * w1182
                + w1087 * w1183
                + w1090 * w1184
                + w1091 * w1188
                + w1092 * w1190
            )
            w1215 = (
                w1214
                - w1205
                + w1094 * w1194
                + w1095 * w1196
                + w1096 * w1198
                + w1097 * w1199
                + w1098 * w1201
            )
            w1216 = (
                w52 * w1207
                + w1118 * w1182
                + w1121 * w1183
                + w1124 * w1184
                - w1208
                + w1125 * w1188
            )
            w1217 = (
                w1216
                + w1127 * w1190
                + w1210
                + w1128 * w1194
                + w1129 * w1196
                + w1130 * w1198
                + w1131 * w1199
            )
            w1218 = X2_1 * w218
            w1219 = w217 - w215
            w1220 = X2_2 * w1219
            w1221 = X2_1 * w213
            w1222 = w1221 - X2_0 * w1220
            w1223 = 100.0 * w218
            w1224 = -100.0 * w213
            w1225 = X2_0 * w1223
            w1226 = w222 * w1223 + w2_1 * w1224 - w2_2 * w1225
            w1227 = 1.0 - X2_1 * w1218 + X2_2 * w1220
            w1228 = 0.9900990099009901 * w218
            w1229 = X2_1 * w1228
            w1230 = X2_2 * w1228
            w1231 = w2_1 * w1229 + w2_2 * w1230
            w1232 = X2_2 * w213
            w1233 = X2_0 * w1218 - w1232
            w1234 = X2_0 * w1219
            w1235 = w212 - w210
            w1236 = w219 * w1219 + w2_1 * w1234 - w2_2 * w1235
            w1237 = (
                Pxi2_1 * w1218
                - Wxi2_2 * w1220
                + w1222 * w1226
                + w1227 * w1231
                + w1233 * w1236
            )
            w1238 = X2_1 * w1223
            w1239 = 100.0 - X2_0 * w1225 - X2_1 * w1238
            w1240 = -0.9900990099009901 * w213
            w1241 = X2_0 * w1230 + X2_1 * w1240
            w1242 = X2_2 * w218
            w1243 = X2_1 * w1242
            w1244 = w1243 - X2_0 * w1235
            w1245 = w1222 * w1239 + w1227 * w1241 + w1233 * w1244
            w1246 = w1 * w273 + w269 * w275
            w1247 = 0.03867513459481288 * h
            w1248 = -0.07735026918962576 * h
            w1249 = w278 * w1247 + w281 * w1248
            w1250 = w285 * w1248
            w1251 = w319 * w1248
            w1252 = w329 * w1248
            w1253 = (
                w265
                + w2 * w1246
                + w3 * w1249
                - w318 * w1250
                + w328 * w1251
                + w337 * w1252
            )
            w1254 = w341 * w1248
            w1255 = w349 * w1248
            w1256 = w356 * w1248
            w1257 = w1 * w368
            w1258 = w1 * w397
            w1259 = (
                w1253
                + w347 * w1254
                + w354 * w1255
                + w365 * w1256
                - w396 * w1257
                + w406 * w1258
            )
            w1260 = w1 * w408
            w1261 = w1 * w419
            w1262 = w1 * w426
            w1263 = w1 * w432
            w1264 = (
                w1259 + w416 * w1260 + w424 * w1261 + w430 * w1262 + w439 * w1263 + w441
            )
            w1265 = X2_0 * w1224 + X2_2 * w1238
            w1266 = X2_0 * w1229 - X2_2 * w1240
            w1267 = 1.0 + X2_0 * w1234 - X2_2 * w1242
            w1268 = w1222 * w1265 + w1227 * w1266 + w1233 * w1267
            w1269 = w275 * w452 + w1 * w454
            w1270 = w458 * w1247 + w460 * w1248
            w1271 = w462 * w1248
            w1272 = w465 * w1248
            w1273 = w467 * w1248
            w1274 = (
                w449
                - w2 * w1269
                - w3 * w1270
                + w318 * w1271
                - w328 * w1272
                + w337 * w1273
            )
            w1275 = w470 * w1248
            w1276 = w473 * w1248
            w1277 = w476 * w1248
            w1278 = w1 * w478
            w1279 = w1 * w481
            w1280 = (
                w1274
                + w347 * w1275
                + w354 * w1276
                + w365 * w1277
                + w396 * w1278
                - w406 * w1279
            )
            w1281 = w1 * w484
            w1282 = w1 * w486
            w1283 = w1 * w489
            w1284 = w1 * w492
            w1285 = (
                w1280 + w416 * w1281 + w424 * w1282 + w430 * w1283 + w439 * w1284 - w495
            )
            w1286 = X2_2 * w1225 - X2_1 * w1224
            w1287 = 0.9900990099009901 - X2_1 * w1229 - X2_2 * w1230
            w1288 = X2_1 * w1234
            w1289 = X2_2 * w1235 - w1288
            w1290 = w1222 * w1286 + w1227 * w1287 + w1233 * w1289
            w1291 = w275 * w507 + w1 * w510
            w1292 = w515 * w1247 + w518 * w1248
            w1293 = w520 * w1248
            w1294 = w522 * w1248
            w1295 = w524 * w1248
            w1296 = (
                w503
                + w2 * w1291
                + w3 * w1292
                + w318 * w1293
                + w328 * w1294
                - w337 * w1295
            )
            w1297 = w527 * w1248
            w1298 = w529 * w1248
            w1299 = w531 * w1248
            w1300 = w1 * w533
            w1301 = w1 * w535
            w1302 = (
                w1296
                + w347 * w1297
                + w354 * w1298
                + w365 * w1299
                + w396 * w1300
                + w406 * w1301
            )
            w1303 = w1 * w538
            w1304 = w1 * w540
            w1305 = w1 * w542
            w1306 = w1 * w544
            w1307 = (
                w1302 - w416 * w1303 + w424 * w1304 + w430 * w1305 + w439 * w1306 + w547
            )
            w1308 = w550 * w1290 - (w494 * w1245 + w102 * w1268)
            w1309 = w549 * w1308
            w1310 = w578 * w1247 - w580
            w1311 = w583 + w582 * w1247
            w1312 = w1 + w587 * w1247 - w588
            w1313 = w590 * w1308
            w1314 = w1245 * w1310 + w1268 * w1311 + w1290 * w1312 - w1313
            w1315 = (
                w2 * w1237
                + w1245 * w1264
                + w1268 * w1285
                + w1290 * w1307
                + w1309
                + w577 * w1314
            )
            w1316 = w275 * w619 - w580
            w1317 = w583 + w275 * w621
            w1318 = w1 + w275 * w625 - w588
            w1319 = w1245 * w1316 + w1268 * w1317 + w1290 * w1318 - w1313
            w1320 = w1 + w639 * w1247
            w1321 = w641 * w1247
            w1322 = w643 * w1247
            w1323 = w645 * w1308
            w1324 = w546 * w1245 - w550 * w1268 - w102 * w1290
            w1325 = w579 * w1324
            w1326 = w1245 * w1320 + w1268 * w1321 + w1290 * w1322 + w1323 - w1325
            w1327 = w658 + w657 * w1247
            w1328 = w1 + w660 * w1247 - w661
            w1329 = w664 + w663 * w1247
            w1330 = w590 * w1324
            w1331 = w1245 * w1327 + w1268 * w1328 + w1290 * w1329 + w1330
            w1332 = (
                w679 * w1247
                - w691 * w1250
                + w692 * w1251
                + w693 * w1252
                + w694 * w1254
                + w696 * w1255
            )
            w1333 = w1332 + w699 * w1256
            w1334 = (
                w702 * w1247
                + w691 * w1271
                - w692 * w1272
                + w693 * w1273
                + w694 * w1275
                + w696 * w1276
            )
            w1335 = w1334 + w699 * w1277
            w1336 = (
                w705 * w1247
                + w691 * w1293
                + w692 * w1294
                - w693 * w1295
                + w694 * w1297
                + w696 * w1298
            )
            w1337 = w1336 + w699 * w1299
            w1338 = (
                w1245 * w1333
                + w1268 * w1335
                + w1290 * w1337
                + w711 * w1314
                + w715 * w1326
                + w717 * w1331
            )
            w1339 = w1 + w275 * w730
            w1340 = w275 * w732
            w1341 = w275 * w734
            w1342 = w1245 * w1339 + w1268 * w1340 + w1290 * w1341 + w1323 - w1325
            w1343 = (
                w1315
                + w618 * w1319
                + w637 * w1326
                + w656 * w1331
                + w669 * w1338
                + w728 * w1342
            )
            w1344 = w658 + w275 * w745
            w1345 = w1 + w275 * w747 - w661
            w1346 = w664 + w275 * w749
            w1347 = w1245 * w1344 + w1268 * w1345 + w1290 * w1346 + w1330
            w1348 = -0.25 * w762 - w216 + w10 * w755
            w1349 = w763 * (1.0 - 0.08333333333333333 * w8) - w211 + 0.5 * w8 * w755
            w1350 = 100.0 * w224 * w1348 - 100.0 * w219 * w1349
            w1351 = (
                0.9900990099009901 * w223 * w1348 - 0.9900990099009901 * w214 * w1349
            )
            w1352 = w225 * w1348 + w1349 * (w221 - w220)
            w1353 = (
                w275 * w756
                - w770 * w1257
                + w771 * w1258
                + w772 * w1260
                + w773 * w1261
                + w775 * w1262
            )
            w1354 = w1353 + w778 * w1263
            w1355 = (
                w229 * w1348
                + w226 * w1349
                + w1222 * w1350
                + w1227 * w1351
                + w1233 * w1352
                + w1245 * w1354
            )
            w1356 = (
                w275 * w780
                + w770 * w1278
                - w771 * w1279
                + w772 * w1281
                + w773 * w1282
                + w775 * w1283
            )
            w1357 = w1356 + w778 * w1284
            w1358 = (
                w275 * w783
                + w770 * w1300
                + w771 * w1301
                - w772 * w1303
                + w773 * w1304
                + w775 * w1305
            )
            w1359 = w1358 + w778 * w1306
            w1360 = (
                w1355
                + w1268 * w1357
                + w1290 * w1359
                + w789 * w1319
                + w793 * w1342
                + w795 * w1347
            )
            w1361 = w213 * Wxi2_2
            w1362 = w214 * w1223 + w2_0 * w1224 + w2_2 * w1238
            w1363 = w219 * w1228 - w2_0 * w1229 + w2_2 * w1240
            w1364 = w2_2 * w1242 - w2_0 * w1234
            w1365 = (
                w218 * w227
                - Wxi2_0 * w1218
                + w1361
                - w1222 * w1362
                + w1227 * w1363
                + w1233 * w1364
            )
            w1366 = w275 * w806 + w1 * w808
            w1367 = w811 * w1247 + w813 * w1248
            w1368 = (
                w804
                - w2 * w1366
                - w3 * w1367
                - w824 * w1250
                + w827 * w1251
                + w829 * w1252
            )
            w1369 = (
                w1368
                + w834 * w1254
                + w838 * w1255
                + w840 * w1256
                - w847 * w1257
                + w850 * w1258
            )
            w1370 = (
                w1369 + w853 * w1260 + w856 * w1261 + w859 * w1262 + w861 * w1263 - w863
            )
            w1371 = w275 * w867 + w1 * w870
            w1372 = w873 * w1247 + w876 * w1248
            w1373 = (
                w865
                + w2 * w1371
                + w3 * w1372
                + w824 * w1271
                - w827 * w1272
                + w829 * w1273
            )
            w1374 = (
                w1373
                + w834 * w1275
                + w838 * w1276
                + w840 * w1277
                + w847 * w1278
                - w850 * w1279
            )
            w1375 = (
                w1374 + w853 * w1281 + w856 * w1282 + w859 * w1283 + w861 * w1284 + w880
            )
            w1376 = w275 * w883 + w1 * w884
            w1377 = w886 * w1247 + w887 * w1248
            w1378 = (
                w882
                + w2 * w1376
                + w3 * w1377
                + w824 * w1293
                + w827 * w1294
                - w829 * w1295
            )
            w1379 = (
                w1378
                + w834 * w1297
                + w838 * w1298
                + w840 * w1299
                + w847 * w1300
                + w850 * w1301
            )
            w1380 = (
                w1379 - w853 * w1303 + w856 * w1304 + w859 * w1305 + w861 * w1306 - w891
            )
            w1381 = (
                w2 * w1365
                + w1245 * w1370
                + w1268 * w1375
                + w1290 * w1380
                + w899 * w1314
                + w906 * w1319
            )
            w1382 = w549 * w1324
            w1383 = (
                w1381
                - w1382
                + w911 * w1326
                + w913 * w1331
                + w915 * w1338
                + w918 * w1342
                + w920 * w1347
            )
            w1384 = w213 * Pxi2_1
            w1385 = w2_0 * w1225 + w2_1 * w1238
            w1386 = w222 * w1228 + w2_0 * w1230 + w2_1 * w1240
            w1387 = w2_0 * w1235 + w214 * w218 - w2_1 * w1242
            w1388 = (
                w228 * w1219
                + Wxi2_0 * w1220
                - w1384
                + w1222 * w1385
                - w1227 * w1386
                + w1233 * w1387
            )
            w1389 = w275 * w932 + w1 * w934
            w1390 = w937 * w1247 + w939 * w1248
            w1391 = (
                w930
                + w2 * w1389
                + w3 * w1390
                - w948 * w1250
                + w950 * w1251
                + w952 * w1252
            )
            w1392 = (
                w1391
                + w955 * w1254
                + w957 * w1255
                + w959 * w1256
                - w964 * w1257
                + w966 * w1258
            )
            w1393 = w1392 + w969 * w1260 + w971 * w1261 + w973 * w1262 + w975 * w1263
            w1394 = w275 * w978 + w1 * w979
            w1395 = w981 * w1247 + w982 * w1248
            w1396 = (
                w977
                + w2 * w1394
                + w3 * w1395
                + w948 * w1271
                - w950 * w1272
                + w952 * w1273
            )
            w1397 = (
                w1396
                + w955 * w1275
                + w957 * w1276
                + w959 * w1277
                + w964 * w1278
                - w966 * w1279
            )
            w1398 = w1397 + w969 * w1281 + w971 * w1282 + w973 * w1283 + w975 * w1284
            w1399 = w275 * w988 - w1 * w989
            w1400 = w991 * w1247 - w992 * w1248
            w1401 = (
                w987
                + w2 * w1399
                + w3 * w1400
                + w948 * w1293
                + w950 * w1294
                - w952 * w1295
            )
            w1402 = (
                w1401
                + w955 * w1297
                + w957 * w1298
                + w959 * w1299
                + w964 * w1300
                + w966 * w1301
            )
            w1403 = w1402 - w969 * w1303 + w971 * w1304 + w973 * w1305 + w975 * w1306
            w1404 = w862 * w1308
            w1405 = (
                w2 * w1388
                + w1245 * w1393
                + w1268 * w1398
                + w1290 * w1403
                - w1404
                + w1002 * w1314
            )
            w1406 = w440 * w1324
            w1407 = (
                w1405
                + w1008 * w1319
                + w1406
                + w1012 * w1326
                + w1014 * w1331
                + w1016 * w1338
                + w1019 * w1342
            )
            w1408 = (
                w265
                + w3 * w1246
                + w52 * w1249
                - w1025 * w1250
                + w1026 * w1251
                + w1027 * w1252
            )
            w1409 = (
                w1408
                + w1029 * w1254
                + w1030 * w1255
                + w1031 * w1256
                - w1037 * w1257
                + w1038 * w1258
            )
            w1410 = (
                w1409
                + w1040 * w1260
                + w1042 * w1261
                + w1044 * w1262
                + w1047 * w1263
                + w441
            )
            w1411 = (
                w449
                - w3 * w1269
                - w52 * w1270
                + w1025 * w1271
                - w1026 * w1272
                + w1027 * w1273
            )
            w1412 = (
                w1411
                + w1029 * w1275
                + w1030 * w1276
                + w1031 * w1277
                + w1037 * w1278
                - w1038 * w1279
            )
            w1413 = (
                w1412
                + w1040 * w1281
                + w1042 * w1282
                + w1044 * w1283
                + w1047 * w1284
                - w495
            )
            w1414 = (
                w503
                + w3 * w1291
                + w52 * w1292
                + w1025 * w1293
                + w1026 * w1294
                - w1027 * w1295
            )
            w1415 = (
                w1414
                + w1029 * w1297
                + w1030 * w1298
                + w1031 * w1299
                + w1037 * w1300
                + w1038 * w1301
            )
            w1416 = (
                w1415
                - w1040 * w1303
                + w1042 * w1304
                + w1044 * w1305
                + w1047 * w1306
                + w547
            )
            w1417 = (
                w3 * w1237
                + w1245 * w1410
                + w1268 * w1413
                + w1290 * w1416
                + w1309
                + w1055 * w1314
            )
            w1418 = (
                w1417
                + w1057 * w1319
                + w1058 * w1326
                + w1059 * w1331
                + w1060 * w1338
                + w1061 * w1342
            )
            w1419 = (
                w804
                - w3 * w1366
                - w52 * w1367
                - w1065 * w1250
                + w1066 * w1251
                + w1067 * w1252
            )
            w1420 = (
                w1419
                + w1069 * w1254
                + w1070 * w1255
                + w1071 * w1256
                - w1075 * w1257
                + w1076 * w1258
            )
            w1421 = (
                w1420
                + w1078 * w1260
                + w1080 * w1261
                + w1082 * w1262
                + w1083 * w1263
                - w863
            )
            w1422 = (
                w865
                + w3 * w1371
                + w52 * w1372
                + w1065 * w1271
                - w1066 * w1272
                + w1067 * w1273
            )
            w1423 = (
                w1422
                + w1069 * w1275
                + w1070 * w1276
                + w1071 * w1277
                + w1075 * w1278
                - w1076 * w1279
            )
            w1424 = (
                w1423
                + w1078 * w1281
                + w1080 * w1282
                + w1082 * w1283
                + w1083 * w1284
                + w880
            )
            w1425 = (
                w882
                + w3 * w1376
                + w52 * w1377
                + w1065 * w1293
                + w1066 * w1294
                - w1067 * w1295
            )
            w1426 = (
                w1425
                + w1069 * w1297
                + w1070 * w1298
                + w1071 * w1299
                + w1075 * w1300
                + w1076 * w1301
            )
            w1427 = (
                w1426
                - w1078 * w1303
                + w1080 * w1304
                + w1082 * w1305
                + w1083 * w1306
                - w891
            )
            w1428 = (
                w3 * w1365
                + w1245 * w1421
                + w1268 * w1424
                + w1290 * w1427
                + w1091 * w1314
                + w1092 * w1319
            )
            w1429 = (
                w1428
                - w1382
                + w1094 * w1326
                + w1095 * w1331
                + w1096 * w1338
                + w1097 * w1342
                + w1098 * w1347
            )
            w1430 = (
                w930
                + w3 * w1389
                + w52 * w1390
                - w1101 * w1250
                + w1102 * w1251
                + w1103 * w1252
            )
            w1431 = (
                w1430
                + w1105 * w1254
                + w1106 * w1255
                + w1107 * w1256
                - w1111 * w1257
                + w1112 * w1258
            )
            w1432 = (
                w1431 + w1114 * w1260 + w1115 * w1261 + w1116 * w1262 + w1117 * w1263
            )
            w1433 = (
                w977
                + w3 * w1394
                + w52 * w1395
                + w1101 * w1271
                - w1102 * w1272
                + w1103 * w1273
            )
            w1434 = (
                w1433
                + w1105 * w1275
                + w1106 * w1276
                + w1107 * w1277
                + w1111 * w1278
                - w1112 * w1279
            )
            w1435 = (
                w1434 + w1114 * w1281 + w1115 * w1282 + w1116 * w1283 + w1117 * w1284
            )
            w1436 = (
                w987
                + w3 * w1399
                + w52 * w1400
                + w1101 * w1293
                + w1102 * w1294
                - w1103 * w1295
            )
            w1437 = (
                w1436
                + w1105 * w1297
                + w1106 * w1298
                + w1107 * w1299
                + w1111 * w1300
                + w1112 * w1301
            )
            w1438 = (
                w1437 - w1114 * w1303 + w1115 * w1304 + w1116 * w1305 + w1117 * w1306
            )
            w1439 = (
                w3 * w1388
                + w1245 * w1432
                + w1268 * w1435
                + w1290 * w1438
                - w1404
                + w1125 * w1314
            )
            w1440 = (
                w1439
                + w1127 * w1319
                + w1406
                + w1128 * w1326
                + w1129 * w1331
                + w1130 * w1338
                + w1131 * w1342
            )
            w1441 = X2_0 * w213
            w1442 = w1243 - w1441
            w1443 = w1232 - w1288
            w1444 = (
                w227 * w1219
                + Pxi2_1 * w1234
                - w1361
                + w1226 * w1442
                + w1231 * w1443
                + w1236 * w1267
            )
            w1445 = w1239 * w1442 + w1241 * w1443 + w1244 * w1267
            w1446 = w1265 * w1442 + w1266 * w1443 + w1267 * w1267
            w1447 = w1286 * w1442 + w1287 * w1443 + w1267 * w1289
            w1448 = w550 * w1447 - (w494 * w1445 + w102 * w1446)
            w1449 = w549 * w1448
            w1450 = w590 * w1448
            w1451 = w1310 * w1445 + w1311 * w1446 + w1312 * w1447 - w1450
            w1452 = (
                w2 * w1444
                + w1264 * w1445
                + w1285 * w1446
                + w1307 * w1447
                + w1449
                + w577 * w1451
            )
            w1453 = w1316 * w1445 + w1317 * w1446 + w1318 * w1447 - w1450
            w1454 = w645 * w1448
            w1455 = w546 * w1445 - w550 * w1446 - w102 * w1447
            w1456 = w579 * w1455
            w1457 = w1321 * w1446 + w1320 * w1445 + w1322 * w1447 + w1454 - w1456
            w1458 = w590 * w1455
            w1459 = w1327 * w1445 + w1328 * w1446 + w1329 * w1447 + w1458
            w1460 = (
                w1333 * w1445
                + w1335 * w1446
                + w1337 * w1447
                + w711 * w1451
                + w715 * w1457
                + w717 * w1459
            )
            w1461 = w1340 * w1446 + w1339 * w1445 + w1341 * w1447 + w1454 - w1456
            w1462 = (
                w1452
                + w618 * w1453
                + w637 * w1457
                + w656 * w1459
                + w669 * w1460
                + w728 * w1461
            )
            w1463 = w1344 * w1445 + w1345 * w1446 + w1346 * w1447 + w1458
            w1464 = (
                w230 * w1348
                + w228 * w1349
                + w1350 * w1442
                + w1351 * w1443
                + w1267 * w1352
                + w1354 * w1445
            )
            w1465 = (
                w1464
                + w1357 * w1446
                + w1359 * w1447
                + w789 * w1453
                + w793 * w1461
                + w795 * w1463
            )
            w1466 = (
                Wxi2_2 * w1242
                - Wxi2_0 * w1234
                - w1362 * w1442
                + w1363 * w1443
                + w1267 * w1364
            )
            w1467 = (
                w2 * w1466
                + w1370 * w1445
                + w1375 * w1446
                + w1380 * w1447
                + w899 * w1451
                + w906 * w1453
            )
            w1468 = w549 * w1455
            w1469 = (
                w1467
                - w1468
                + w911 * w1457
                + w913 * w1459
                + w915 * w1460
                + w918 * w1461
                + w920 * w1463
            )
            w1470 = w213 * Wxi2_0
            w1471 = (
                w218 * w226
                + w1470
                - Pxi2_1 * w1242
                + w1385 * w1442
                - w1386 * w1443
                + w1267 * w1387
            )
            w1472 = w862 * w1448
            w1473 = (
                w2 * w1471
                + w1393 * w1445
                + w1398 * w1446
                + w1403 * w1447
                - w1472
                + w1002 * w1451
            )
            w1474 = w440 * w1455
            w1475 = (
                w1473
                + w1008 * w1453
                + w1474
                + w1012 * w1457
                + w1014 * w1459
                + w1016 * w1460
                + w1019 * w1461
            )
            w1476 = (
                w3 * w1444
                + w1410 * w1445
                + w1413 * w1446
                + w1416 * w1447
                + w1449
                + w1055 * w1451
            )
            w1477 = (
                w1476
                + w1057 * w1453
                + w1058 * w1457
                + w1059 * w1459
                + w1060 * w1460
                + w1061 * w1461
            )
            w1478 = (
                w3 * w1466
                + w1421 * w1445
                + w1424 * w1446
                + w1427 * w1447
                + w1091 * w1451
                + w1092 * w1453
            )
            w1479 = (
                w1478
                - w1468
                + w1094 * w1457
                + w1095 * w1459
                + w1096 * w1460
                + w1097 * w1461
                + w1098 * w1463
            )
            w1480 = (
                w3 * w1471
                + w1432 * w1445
                + w1435 * w1446
                + w1438 * w1447
                - w1472
                + w1125 * w1451
            )
            w1481 = (
                w1480
                + w1127 * w1453
                + w1474
                + w1128 * w1457
                + w1129 * w1459
                + w1130 * w1460
                + w1131 * w1461
            )
            w1482 = X2_0 * w218
            w1483 = X2_1 * w1219
            w1484 = 1.0 - X2_0 * w1482 + X2_1 * w1483
            w1485 = X2_2 * w1482 - w1221
            w1486 = w1441 - X2_2 * w1483
            w1487 = (
                w1384
                + w218 * w228
                - Wxi2_2 * w1482
                + w1226 * w1484
                + w1231 * w1485
                + w1236 * w1486
            )
            w1488 = w1239 * w1484 + w1241 * w1485 + w1244 * w1486
            w1489 = w1265 * w1484 + w1266 * w1485 + w1267 * w1486
            w1490 = w1286 * w1484 + w1287 * w1485 + w1289 * w1486
            w1491 = w550 * w1490 - (w494 * w1488 + w102 * w1489)
            w1492 = w549 * w1491
            w1493 = w590 * w1491
            w1494 = w1310 * w1488 + w1311 * w1489 + w1312 * w1490 - w1493
            w1495 = (
                w2 * w1487
                + w1264 * w1488
                + w1285 * w1489
                + w1307 * w1490
                + w1492
                + w577 * w1494
            )
            w1496 = w1316 * w1488 + w1317 * w1489 + w1318 * w1490 - w1493
            w1497 = w645 * w1491
            w1498 = w546 * w1488 - w550 * w1489 - w102 * w1490
            w1499 = w579 * w1498
            w1500 = w1321 * w1489 + w1320 * w1488 + w1322 * w1490 + w1497 - w1499
            w1501 = w590 * w1498
            w1502 = w1327 * w1488 + w1328 * w1489 + w1329 * w1490 + w1501
            w1503 = (
                w1333 * w1488
                + w1335 * w1489
                + w1337 * w1490
                + w711 * w1494
                + w715 * w1500
                + w717 * w1502
            )
            w1504 = w1340 * w1489 + w1339 * w1488 + w1341 * w1490 + w1497 - w1499
            w1505 = (
                w1495
                + w618 * w1496
                + w637 * w1500
                + w656 * w1502
                + w669 * w1503
                + w728 * w1504
            )
            w1506 = w1344 * w1488 + w1345 * w1489 + w1346 * w1490 + w1501
            w1507 = (
                w231 * w1348
                + w227 * w1349
                + w1350 * w1484
                + w1351 * w1485
                + w1352 * w1486
                + w1354 * w1488
            )
            w1508 = (
                w1507
                + w1357 * w1489
                + w1359 * w1490
                + w789 * w1496
                + w793 * w1504
                + w795 * w1506
            )
            w1509 = (
                w226 * w1219
                - w1470
                + Wxi2_2 * w1483
                - w1362 * w1484
                + w1363 * w1485
                + w1364 * w1486
            )
            w1510 = (
                w2 * w1509
                + w1370 * w1488
                + w1375 * w1489
                + w1380 * w1490
                + w899 * w1494
                + w906 * w1496
            )
            w1511 = w549 * w1498
            w1512 = (
                w1510
                - w1511
                + w911 * w1500
                + w913 * w1502
                + w915 * w1503
                + w918 * w1504
                + w920 * w1506
            )
            w1513 = (
                Wxi2_0 * w1482
                - Pxi2_1 * w1483
                + w1385 * w1484
                - w1386 * w1485
                + w1387 * w1486
            )
            w1514 = w862 * w1491
            w1515 = (
                w2 * w1513
                + w1393 * w1488
                + w1398 * w1489
                + w1403 * w1490
                - w1514
                + w1002 * w1494
            )
            w1516 = w440 * w1498
            w1517 = (
                w1515
                + w1008 * w1496
                + w1516
                + w1012 * w1500
                + w1014 * w1502
                + w1016 * w1503
                + w1019 * w1504
            )
            w1518 = (
                w3 * w1487
                + w1410 * w1488
                + w1413 * w1489
                + w1416 * w1490
                + w1492
                + w1055 * w1494
            )
            w1519 = (
                w1518
                + w1057 * w1496
                + w1058 * w1500
                + w1059 * w1502
                + w1060 * w1503
                + w1061 * w1504
            )
            w1520 = (
                w3 * w1509
                + w1421 * w1488
                + w1424 * w1489
                + w1427 * w1490
                + w1091 * w1494
                + w1092 * w1496
            )
            w1521 = (
                w1520
                - w1511
                + w1094 * w1500
                + w1095 * w1502
                + w1096 * w1503
                + w1097 * w1504
                + w1098 * w1506
            )
            w1522 = (
                w3 * w1513
                + w1432 * w1488
                + w1435 * w1489
                + w1438 * w1490
                - w1514
                + w1125 * w1494
            )
            w1523 = (
                w1522
                + w1127 * w1496
                + w1516
                + w1128 * w1500
                + w1129 * w1502
                + w1130 * w1503
                + w1131 * w1504
            )
            row_1_1 = [
                1.0 - (w737 + w744 * w751 + w753 * w796),
                -(w921 + w796 * w923),
                -(w1020 + w751 * w1022 + w796 * w1024),
                -(w1062 + w751 * w1063 + w796 * w1064),
                -(w1099 + w796 * w1100),
                -(w1132 + w751 * w1133 + w796 * w1134),
            ]
            row_1_2 = [
                -(w1157 + w744 * w1158 + w753 * w1159),
                1.0 - (w1163 + w923 * w1159),
                -(w1169 + w1022 * w1158 + w1024 * w1159),
                -(w1171 + w1063 * w1158 + w1064 * w1159),
                -(w1173 + w1100 * w1159),
                -(w1175 + w1133 * w1158 + w1134 * w1159),
            ]
            row_1_3 = [
                -(w1200 + w744 * w1201 + w753 * w1202),
                -(w1206 + w923 * w1202),
                1.0 - (w1211 + w1022 * w1201 + w1024 * w1202),
                -(w1213 + w1063 * w1201 + w1064 * w1202),
                -(w1215 + w1100 * w1202),
                -(w1217 + w1133 * w1201 + w1134 * w1202),
            ]
            row_1_4 = [
                -(w1343 + w744 * w1347 + w753 * w1360),
                -(w1383 + w923 * w1360),
                -(w1407 + w1022 * w1347 + w1024 * w1360),
                1.0 - (w1418 + w1063 * w1347 + w1064 * w1360),
                -(w1429 + w1100 * w1360),
                -(w1440 + w1133 * w1347 + w1134 * w1360),
            ]
            row_1_5 = [
                -(w1462 + w744 * w1463 + w753 * w1465),
                -(w1469 + w923 * w1465),
                -(w1475 + w1022 * w1463 + w1024 * w1465),
                -(w1477 + w1063 * w1463 + w1064 * w1465),
                1.0 - (w1479 + w1100 * w1465),
                -(w1481 + w1133 * w1463 + w1134 * w1465),
            ]
            row_1_6 = [
                -(w1505 + w744 * w1506 + w753 * w1508),
                -(w1512 + w923 * w1508),
                -(w1517 + w1022 * w1506 + w1024 * w1508),
                -(w1519 + w1063 * w1506 + w1064 * w1508),
                -(w1521 + w1100 * w1508),
                1.0 - (w1523 + w1133 * w1506 + w1134 * w1508),
            ]
            memory.inverses[0] = invert([row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[0] is None:
                raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
        row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6 = memory.inverses[0]
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
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        make_1 = 0.0 < 0.0625 * previous_1 < change
        previous_1 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of v1, v2, m1, m2", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    w1524 = Y_1 * w102
    w1525 = Y_1 * w1524
    w1526 = Y_2 * w102 * Y_2
    g_0 = 1.0 - (w1525 + w1526)
    c1_3 = _stumpff_1(w101)
    w1528 = Y_2 * c1_3
    w1529 = Y_0 * w102
    w1530 = Y_1 * w1529
    g_3 = w1528 + w1530
    w1531 = Y_2 * w1529
    w1532 = Y_1 * c1_3
    g_6 = w1531 - w1532
    q1_0 = g00 * g_0 + g01 * g_3 + g02 * g_6
    g_1 = w1530 - w1528
    w1533 = Y_0 * w1529
    g_4 = 1.0 - (w1526 + w1533)
    w1534 = Y_0 * c1_3
    w1535 = Y_2 * w1524
    g_7 = w1534 + w1535
    q1_1 = g00 * g_1 + g01 * g_4 + g02 * g_7
    g_2 = w1531 + w1532
    g_5 = w1535 - w1534
    g_8 = 1.0 - (w1525 + w1533)
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
    memory.past = [found, *memory.past[:2]]
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
