"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:midpoint

method:     family vcg, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (3.4 sweeps of 285
            operations and 0.12 matrices of 851 a step, not 5.6 sweeps of 270
            operations)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   3 Adtinv, 2 mul (zeros)
            1 identity (sharing)
            1 identity (dead code)
            1 dexpt (factors)
            1 lin (sharing)
            2 hamilton (body frame)
            1 Adinv (opposites)
            1 Adt (opposites)
            3 Adtinv, 1 force (dead code)
            1 Adt, 2 dexpt (functions)
            1 Adinv (opposites)
            1 legendre (sharing)
            1 lin, 2 seriest (factors)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 42 add, 59 mul, 1 stumpff_12 a step
            2 mul a start, in steps that follow no other
            277 add, 445 mul, 2 slope2, 2 slope3, 1 stumpff_3 a matrix of the
            equations of xi1, n1
            75 add, 127 mul, 2 div, 2 sqrt, 1 stumpff_12, 1 stumpff_23, 1 stumpff_3
            a sweep of the equations of xi1, n1
made by:    orderconds emit dipole --method vcg:midpoint --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_midpoint

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_midpoint.run(state, 0.005, 100))
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
        "the equations of xi1, n1",
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


def _stumpff_3_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_3 = (s - sin(s))/s^3."""
    if z <= 4.0:
        return _stumpff_series_3(z)
    s = sqrt(z if z <= 4503599627370496.0 else float("nan"))
    return (1.0 - sin(s) / s) / z


def _stumpff_3(z):
    """Return, for z >= 0 and s = sqrt(z): c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_3(z)
    return _stumpff_3_far(z)


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
        xi1_0, xi1_1, xi1_2 = memory.extrapolated()
    else:
        xi1_0 = 0.9900990099009901 * m_0
        xi1_1 = m_1
        xi1_2 = 100.0 * m_2
    w1 = 0.5 * h
    w39 = -0.5 * h
    # the equations of xi1, n1: Newton's method in xi1_0, xi1_1, xi1_2
    previous_1 = 0.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
        xE1_1_1 = xi1_1 * w1
        xE1_1_0 = xi1_0 * w1
        xE1_1_2 = xi1_2 * w1
        w2 = xE1_1_2 * xE1_1_2
        w3 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + w2
        c1_1, c2_1 = _stumpff_12(w3)
        w5 = xE1_1_1 * c2_1
        w6 = xE1_1_1 * w5
        w7 = xE1_1_2 * c2_1
        w8 = xE1_1_2 * w7
        gE1_1_0 = 1.0 - (w6 + w8)
        p_2 = 0.01 * xi1_2
        w9 = xE1_1_0 * c2_1
        w10 = xE1_1_1 * w9
        w12 = xE1_1_2 * c1_1
        gE1_1_1 = w10 - w12
        w13 = xE1_1_0 * w9
        gE1_1_4 = 1.0 - (w8 + w13)
        w14 = xE1_1_0 * c1_1
        w15 = xE1_1_2 * w5
        gE1_1_7 = w14 + w15
        Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7
        w16 = xE1_1_1 * c1_1
        w17 = xE1_1_2 * w9
        gE1_1_2 = w16 + w17
        gE1_1_5 = w15 - w14
        gE1_1_8 = 1.0 - (w6 + w13)
        Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8
        w18 = 1.5 - 2.0 * Q1_8
        w19 = 1.0 / sqrt(1.01 + 1.5 * (w18 - 0.2 * Q1_7))
        w20 = w19 * w19
        w21 = 0.5 * w19
        w22 = w20 * w21
        w23 = 1.0 / sqrt(1.01 + 1.5 * (w18 + 0.2 * Q1_7))
        w24 = w23 * w23
        w25 = 0.5 * w23
        w26 = w24 * w25
        w27 = -1.0 - 2.0 * (1.5 * w22 - 1.5 * w26)
        w28 = -0.3 * w22 - 0.3 * w26
        Nr1_0 = Q1_7 * w27 - Q1_8 * w28 + 99.0 * xi1_1 * p_2
        s_mu_0 = m_0 + h * Nr1_0
        xe1_0 = h * xi1_0
        xe1_1 = h * xi1_1
        xe1_2 = h * xi1_2
        w29 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        w30 = 0.25 * w29
        c3_1 = _stumpff_3(w30)
        w32 = 0.25 * c3_1
        w33 = 0.01 * xi1_0
        gE1_1_3 = w10 + w12
        gE1_1_6 = w17 - w16
        Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6
        Nr1_2 = xi1_1 * w33 + w28 * Q1_6
        s_mu_2 = m_2 + h * Nr1_2
        w34 = xe1_0 * s_mu_2 - s_mu_0 * xe1_2
        w35 = -100.0 * xi1_0 * p_2
        w36 = w27 * Q1_6
        Nr1_1 = w35 - w36
        s_mu_1 = m_1 + h * Nr1_1
        w37 = s_mu_0 * xe1_1 - xe1_0 * s_mu_1
        w38 = xe1_2 * w34 - xe1_1 * w37
        y1_2_0 = xi1_0 * w39
        y1_2_1 = xi1_1 * w39
        y1_2_2 = xi1_2 * w39
        w40 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_2, c3_2 = _stumpff_23(w40)
        w42 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2
        w44 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1
        w45 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0
        w46 = y1_2_1 * w44 - y1_2_2 * w45
        Wf1_0 = (
            0.9900990099009901
            * (s_mu_0 + w32 * w38 + w39 * (Nr1_0 + w42 * c2_2 + w46 * c3_2))
        )
        w47 = xe1_2 * s_mu_1 - xe1_1 * s_mu_2
        w48 = xe1_0 * w37 - xe1_2 * w47
        w49 = y1_2_2 * w42 - y1_2_0 * w44
        M1_2_1 = s_mu_1 + w32 * w48 + w39 * (Nr1_1 + w45 * c2_2 + w49 * c3_2)
        w50 = xe1_1 * w47 - xe1_0 * w34
        w51 = y1_2_0 * w45 - y1_2_1 * w42
        Wf1_2 = 100.0 * (s_mu_2 + w32 * w50 + w39 * (Nr1_2 + w44 * c2_2 + w51 * c3_2))
        next_xi1_0 = gE1_1_0 * Wf1_0 + gE1_1_1 * M1_2_1 + gE1_1_2 * Wf1_2
        next_xi1_1 = gE1_1_3 * Wf1_0 + gE1_1_4 * M1_2_1 + gE1_1_5 * Wf1_2
        next_xi1_2 = gE1_1_6 * Wf1_0 + gE1_1_7 * M1_2_1 + gE1_1_8 * Wf1_2
        residual_xi1_0 = next_xi1_0 - xi1_0
        residual_xi1_1 = next_xi1_1 - xi1_1
        residual_xi1_2 = next_xi1_2 - xi1_2
        total = residual_xi1_0 + residual_xi1_1 + residual_xi1_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
        if make_1:
            w52 = w1 * c2_1
            w53 = xE1_1_2 * w52
            w54 = xE1_1_1 * w52
            w55 = -50.0 * h
            w56 = w55 * c3_2
            w57 = 25.0 * c3_1
            w58 = xe1_0 * w57
            w59 = h * s_mu_2
            w60 = slope3(w40)
            w61 = slope2(w40)
            w62 = w51 * w55 * w60 + w44 * w55 * w61
            w63 = 2.0 * y1_2_0 * w39
            w64 = 100.0 * w50
            w65 = 0.0625 * slope3(w30)
            w66 = 2.0 * xe1_0 * w65 * h
            w67 = w45 * w56 * w39 - w34 * w57 * h - w58 * w59 + w62 * w63 + w64 * w66
            w68 = w55 * c2_2
            w69 = Nr1_1 * w39
            w70 = y1_2_0 * w56
            w71 = Nr1_2 * w39
            w72 = h * xe1_0
            w73 = xe1_1 * w57
            w74 = h * xe1_1
            w75 = y1_2_1 * w56
            w76 = 100.0 * h + w55 - w58 * w72 - w73 * w74 - y1_2_0 * w70 - y1_2_1 * w75
            w77 = g22 * w28
            w78 = g21 * w28
            w79 = 0.01 * xi1_1 + w53 * w77 + w54 * w78
            w80 = w1 * w9
            w81 = w80 + xE1_1_0 * w52
            w82 = w1 * c1_1
            w83 = g21 * w82
            w84 = g20 * w53 - (g22 * w81 + w83)
            w85 = -2.0 * Q1_7
            w86 = w24 * (0.5 * w24 + 2.0 * w23 * w25) * w25
            w87 = 2.25 * w86
            w88 = 0.45 * w86
            w89 = w85 * w87 - Q1_8 * w88
            w90 = w20 * (0.5 * w20 + 2.0 * w19 * w21) * w21
            w91 = -2.25 * w90
            w92 = 0.45 * w90
            w93 = w85 * w91 - Q1_8 * w92
            w94 = -2.0 * w89 - w28 - 2.0 * w93
            w95 = h * xe1_2
            w96 = w58 * w95 - y1_2_1 * w68 + y1_2_2 * w70
            w97 = Q1_6 * w88
            w98 = Q1_6 * w92
            w99 = -2.0 * w97 - 2.0 * w98
            w100 = w94 * w96 + w76 * w99
            w101 = w73 * w95 + y1_2_0 * w68 + y1_2_2 * w75
            w102 = 2.0 * Q1_6
            w103 = w87 * w102
            w104 = w91 * w102
            w105 = -2.0 * w103 - 2.0 * w104
            w106 = g22 * w27
            w107 = g21 * w27
            w108 = w84 * w105 - (xi1_2 + w53 * w106 + w54 * w107)
            w109 = w67 + w68 * w69 - w70 * w71 + w76 * w79 + w84 * w100 + w101 * w108
            w110 = g22 * w82
            w111 = w110 - g21 * w81 + g20 * w54
            w112 = w27 + 0.2 * w89 - 0.2 * w93
            w113 = 0.2 * w97 - 0.2 * w98
            w114 = 0.2 * w103 - 0.2 * w104
            w115 = w96 * w112 + w76 * w113 + w101 * w114
            w116 = w109 + w111 * w115
            w117 = 0.24752475247524752 * c3_1
            w118 = xe1_1 * w117
            w119 = h * s_mu_1
            w120 = xe1_2 * w117
            w121 = -0.49504950495049505 * h
            w122 = w46 * w121 * w60 + w42 * w121 * w61
            w123 = 0.9900990099009901 * w38
            w124 = w121 * c3_2
            w125 = y1_2_1 * w124
            w126 = y1_2_2 * w124
            w127 = (
                w118 * w119
                + w59 * w120
                + w63 * w122
                + w66 * w123
                + w69 * w125
                + w71 * w126
            )
            w128 = w121 * c2_2
            w129 = y1_2_0 * w126 + w72 * w120 + y1_2_1 * w128
            w130 = (
                0.9900990099009901 * h
                + w121
                - w74 * w118
                - w95 * w120
                - y1_2_1 * w125
                - y1_2_2 * w126
            )
            w131 = w94 * w130 + w99 * w129
            w132 = y1_2_0 * w125 + w72 * w118 - y1_2_2 * w128
            w133 = w112 * w130 + w113 * w129 + w114 * w132
            w134 = w127 + w79 * w129 + w84 * w131 + w108 * w132 + w111 * w133
            w135 = w39 * c3_2
            w136 = xe1_0 * w32
            w137 = w39 * w49 * w60 + w39 * w45 * w61
            w138 = (
                w32 * w37 * h - w44 * w135 * w39 - w119 * w136 + w63 * w137 + w48 * w66
            )
            w139 = y1_2_0 * w135
            w140 = w39 * c2_2
            w141 = xe1_2 * w32
            w142 = y1_2_2 * w135
            w143 = w74 * w141 - y1_2_0 * w140 + y1_2_1 * w142
            w144 = y1_2_1 * w139 + w74 * w136 + y1_2_2 * w140
            w145 = w94 * w144 + w99 * w143
            w146 = h + w39 - w72 * w136 - w95 * w141 - y1_2_0 * w139 - y1_2_2 * w142
            w147 = (
                w138 - w69 * w139 - w71 * w140 + w79 * w143 + w84 * w145 + w108 * w146
            )
            w148 = w112 * w144 + w113 * w143 + w114 * w146
            w149 = w147 + w111 * w148
            w150 = 2.0 * xE1_1_0 * w1
            c3_3 = _stumpff_3(w3)
            w151 = 0.5 * (c3_3 - c2_1)
            w152 = xE1_1_1 * w151
            w153 = slope2(w3)
            w154 = w2 * w153
            w155 = xE1_1_1 * w153
            w156 = xE1_1_1 * w155
            w157 = xE1_1_2 * w151
            w158 = xE1_1_0 * w153
            w159 = xE1_1_2 * w158
            w160 = xE1_1_1 * w158
            w161 = (
                Wf1_2 * w152
                - (Wf1_0 * w154 + Wf1_0 * w156 + M1_2_1 * w157)
                + Wf1_2 * w159
                + M1_2_1 * w160
            )
            w162 = g21 * w157 - (g20 * w154 + g20 * w156) - g22 * w152
            w163 = w28 * w162 + w77 * w159 + w78 * w160
            w164 = xE1_1_0 * w158
            w165 = xE1_1_0 * w151
            w166 = xE1_1_2 * w155
            w167 = (
                g20 * w152
                - (g22 * w156 + g22 * w164)
                - g21 * w165
                + g21 * w166
                + g20 * w159
            )
            w168 = w105 * w167 - (w27 * w162 + w106 * w159 + w107 * w160)
            w169 = (
                g22 * w165
                - (g21 * w154 + g21 * w164 + g20 * w157)
                + g22 * w166
                + g20 * w160
            )
            w170 = w76 * w163 + w100 * w167 + w101 * w168 + w115 * w169
            w171 = w129 * w163 + w131 * w167 + w132 * w168 + w133 * w169
            w172 = w143 * w163 + w145 * w167 + w146 * w168 + w148 * w169
            w173 = w161 + gE1_1_2 * w170 + gE1_1_0 * w171 + gE1_1_1 * w172
            w174 = (
                Wf1_2 * w53
                + M1_2_1 * w54
                + gE1_1_2 * w116
                + gE1_1_0 * w134
                + gE1_1_1 * w149
                + w150 * w173
            )
            w175 = Wf1_2 * w82
            w176 = 2.0 * w5 * w1
            w177 = 2.0 * y1_2_1 * w39
            w178 = 2.0 * xe1_1 * w65 * h
            w179 = w47 * w57 * h - w42 * w56 * w39 - w59 * w73 + w62 * w177 + w64 * w178
            w180 = Nr1_0 * w39
            w181 = 0.99 * xi1_2
            w182 = w110 + g20 * w176
            w183 = w33 - w28 * w182 + w78 * w80
            w184 = g20 * w82
            w185 = w1 * w7
            w186 = w184 - g22 * w176 + g21 * w185
            w187 = w179 - w68 * w180 - w71 * w75 + w96 * w181 + w76 * w183 + w100 * w186
            w188 = w27 * w182 - w80 * w107 + w105 * w186
            w189 = g20 * w80
            w190 = g22 * w185 + w189
            w191 = w187 + w101 * w188 + w115 * w190
            w192 = h * s_mu_0
            w193 = (
                w44 * w124 * w39
                - w37 * w117 * h
                - w118 * w192
                + w122 * w177
                + w123 * w178
            )
            w194 = (
                w193
                - w125 * w180
                + w71 * w128
                + w130 * w181
                + w129 * w183
                + w131 * w186
            )
            w195 = w194 + w132 * w188 + w133 * w190
            w196 = (
                w136 * w192
                + w59 * w141
                + w137 * w177
                + w48 * w178
                + w139 * w180
                + w71 * w142
            )
            w197 = (
                w196
                + w144 * w181
                + w143 * w183
                + w145 * w186
                + w146 * w188
                + w148 * w190
            )
            w198 = (
                w175
                - Wf1_0 * w176
                + M1_2_1 * w80
                + gE1_1_2 * w191
                + gE1_1_0 * w195
                + gE1_1_1 * w197
            )
            w199 = 2.0 * xE1_1_1 * w1
            w200 = 2.0 * w7 * w1
            w201 = M1_2_1 * w82
            w202 = 2.0 * y1_2_2 * w39
            w203 = 2.0 * xe1_2 * w65 * h
            w204 = w39 * (w36 - w35)
            w205 = (
                w58 * w192
                + w73 * w119
                + w62 * w202
                + w64 * w203
                + w70 * w180
                - w75 * w204
            )
            w206 = 0.99 * xi1_1
            w207 = w83 - g20 * w200
            w208 = w28 * w207 + w77 * w80
            w209 = w1 * w5
            w210 = w189 + g21 * w209
            w211 = w105 * w210 - (xi1_0 + w27 * w207 + w80 * w106)
            w212 = g22 * w209 - (w184 + g21 * w200)
            w213 = (
                w205 + w96 * w206 + w76 * w208 + w100 * w210 + w101 * w211 + w115 * w212
            )
            w214 = (
                w34 * w117 * h
                - w45 * w124 * w39
                - w120 * w192
                + w122 * w202
                + w123 * w203
            )
            w215 = (
                w214
                - w126 * w180
                + w128 * w204
                + w130 * w206
                + w129 * w208
                + w131 * w210
            )
            w216 = w215 + w132 * w211 + w133 * w212
            w217 = (
                w42 * w135 * w39
                - w32 * w47 * h
                - w119 * w141
                + w137 * w202
                + w48 * w203
            )
            w218 = (
                w217
                + w140 * w180
                + w142 * w204
                + w144 * w206
                + w143 * w208
                + w145 * w210
            )
            w219 = w218 + w146 * w211 + w148 * w212
            w220 = (
                Wf1_2 * w80
                - (Wf1_0 * w200 + w201)
                + gE1_1_2 * w213
                + gE1_1_0 * w216
                + gE1_1_1 * w219
            )
            w221 = 2.0 * xE1_1_2 * w1
            w222 = (
                Wf1_0 * w54
                - (w175 + M1_2_1 * w81)
                + gE1_1_5 * w116
                + gE1_1_3 * w134
                + gE1_1_4 * w149
            )
            w223 = (
                Wf1_0 * w157
                - (M1_2_1 * w154 + M1_2_1 * w164)
                - Wf1_2 * w165
                + Wf1_2 * w166
                + Wf1_0 * w160
            )
            w224 = w223 + gE1_1_5 * w170 + gE1_1_3 * w171 + gE1_1_4 * w172
            w225 = Wf1_0 * w80
            w226 = (
                Wf1_2 * w185
                + w225
                + gE1_1_5 * w191
                + gE1_1_3 * w195
                + gE1_1_4 * w197
                + w199 * w224
            )
            w227 = Wf1_0 * w82
            w228 = (
                w227
                - M1_2_1 * w200
                + Wf1_2 * w209
                + gE1_1_5 * w213
                + gE1_1_3 * w216
                + gE1_1_4 * w219
            )
            w229 = (
                w201
                - Wf1_2 * w81
                + Wf1_0 * w53
                + gE1_1_8 * w116
                + gE1_1_6 * w134
                + gE1_1_7 * w149
            )
            w230 = (
                M1_2_1 * w165
                - (Wf1_2 * w156 + Wf1_2 * w164 + Wf1_0 * w152)
                + M1_2_1 * w166
                + Wf1_0 * w159
            )
            w231 = w230 + gE1_1_8 * w170 + gE1_1_6 * w171 + gE1_1_7 * w172
            w232 = (
                M1_2_1 * w185
                - (w227 + Wf1_2 * w176)
                + gE1_1_8 * w191
                + gE1_1_6 * w195
                + gE1_1_7 * w197
            )
            w233 = (
                w225
                + M1_2_1 * w209
                + gE1_1_8 * w213
                + gE1_1_6 * w216
                + gE1_1_7 * w219
                + w221 * w231
            )
            row_1_1 = [
                1.0 - w174,
                -(w198 + w173 * w199),
                -(w220 + w173 * w221),
            ]
            row_1_2 = [
                -(w222 + w150 * w224),
                1.0 - w226,
                -(w228 + w221 * w224),
            ]
            row_1_3 = [
                -(w229 + w150 * w231),
                -(w232 + w199 * w231),
                1.0 - w233,
            ]
            memory.inverses[0] = invert([row_1_1, row_1_2, row_1_3])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[0] is None:
                raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
        row_1_1, row_1_2, row_1_3 = memory.inverses[0]
        change_xi1_0 = (
            row_1_1[0] * residual_xi1_0
            + row_1_1[1] * residual_xi1_1
            + row_1_1[2] * residual_xi1_2
        )
        change_xi1_1 = (
            row_1_2[0] * residual_xi1_0
            + row_1_2[1] * residual_xi1_1
            + row_1_2[2] * residual_xi1_2
        )
        change_xi1_2 = (
            row_1_3[0] * residual_xi1_0
            + row_1_3[1] * residual_xi1_1
            + row_1_3[2] * residual_xi1_2
        )
        xi1_0 += change_xi1_0
        xi1_1 += change_xi1_1
        xi1_2 += change_xi1_2
        change = max(abs(change_xi1_0), abs(change_xi1_1), abs(change_xi1_2))
        scale = max(1.0, abs(xi1_0), abs(xi1_1), abs(xi1_2))
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        make_1 = 0.0 < 0.0625 * previous_1 < change
        previous_1 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    c1_2, c2_3 = _stumpff_12(w29)
    w235 = xe1_1 * c2_3
    w236 = xe1_1 * w235
    w237 = xe1_2 * c2_3 * xe1_2
    ge1_0 = 1.0 - (w236 + w237)
    w239 = xe1_2 * c1_2
    w240 = xe1_0 * c2_3
    w241 = xe1_1 * w240
    ge1_3 = w239 + w241
    w242 = xe1_2 * w240
    w243 = xe1_1 * c1_2
    ge1_6 = w242 - w243
    q1_0 = g00 * ge1_0 + g01 * ge1_3 + g02 * ge1_6
    ge1_1 = w241 - w239
    w244 = xe1_0 * w240
    ge1_4 = 1.0 - (w237 + w244)
    w245 = xe1_0 * c1_2
    w246 = xe1_2 * w235
    ge1_7 = w245 + w246
    q1_1 = g00 * ge1_1 + g01 * ge1_4 + g02 * ge1_7
    ge1_2 = w242 + w243
    ge1_5 = w246 - w245
    ge1_8 = 1.0 - (w236 + w244)
    q1_2 = g00 * ge1_2 + g01 * ge1_5 + g02 * ge1_8
    q1_3 = g10 * ge1_0 + g11 * ge1_3 + g12 * ge1_6
    q1_4 = g10 * ge1_1 + g11 * ge1_4 + g12 * ge1_7
    q1_5 = g10 * ge1_2 + g11 * ge1_5 + g12 * ge1_8
    q1_6 = g20 * ge1_0 + g21 * ge1_3 + g22 * ge1_6
    q1_7 = g20 * ge1_1 + g21 * ge1_4 + g22 * ge1_7
    q1_8 = g20 * ge1_2 + g21 * ge1_5 + g22 * ge1_8
    new_mu0 = s_mu_0 * q1_0 + s_mu_1 * q1_1 + s_mu_2 * q1_2
    new_mu1 = s_mu_0 * q1_3 + s_mu_1 * q1_4 + s_mu_2 * q1_5
    new_mu2 = s_mu_0 * q1_6 + s_mu_1 * q1_7 + s_mu_2 * q1_8
    found = xi1_0, xi1_1, xi1_2
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
