"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (3.4 sweeps of 304
            operations and 0.12 matrices of 1057 a step, not 5.6 sweeps of 289
            operations)
solved by:  the equations of xi2, n2: Newton's method, 3 unknowns (3.4 sweeps of 394
            operations and 0.12 matrices of 1508 a step, not 5.6 sweeps of 379
            operations)
solved by:  the equations of xi3, n3: Newton's method, 3 unknowns (3.2 sweeps of 394
            operations and 0.12 matrices of 1508 a step, not 5.6 sweeps of 379
            operations)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   7 Adtinv, 3 exp, 7 mul (zeros)
            3 Adtinv, 3 dexpt, 3 exp, 6 identity, 6 lin, 1 mul, 2 zero (sharing)
            1 Adtinv, 3 dexpt, 1 identity, 1 zero (dead code)
            3 Adtinv, 6 dexpt (factors)
            2 lin (cancellation)
            1 lin (sharing)
            4 hamilton (body frame)
            1 Adinv (opposites)
            3 Adt (opposites)
            7 Adtinv, 1 force (dead code)
            6 dexpt (functions)
            1 Adinv (opposites)
            2 Adinv, 3 legendre (sharing)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 117 add, 164 mul, 3 stumpff_12 a step
            2 mul a start, in steps that follow no other
            379 add, 534 mul, 3 slope2, 2 slope3, 1 stumpff_3 a matrix of the
            equations of xi1, n1
            84 add, 137 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
            557 add, 807 mul, 3 slope2, 2 slope3, 1 stumpff_3 a matrix of the
            equations of xi2, n2
            120 add, 191 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi2, n2
            557 add, 807 mul, 3 slope2, 2 slope3, 1 stumpff_3 a matrix of the
            equations of xi3, n3
            120 add, 191 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi3, n3
made by:    orderconds emit dipole --method vcg:triple_jump --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_triple_jump

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_triple_jump.run(state, 0.005, 100))
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
        "the equations of xi2, n2",
        "the equations of xi3, n3",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 3, 0, 0
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
        self.inverses = [None] * 3

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
    w1 = 0.6756035959798288 * h
    w29 = 1.3512071919596575 * h
    w30 = -1.3512071919596575 * h
    w47 = -0.6756035959798288 * h
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
        s_mu_0 = m_0 + Nr1_0 * w29
        y1_0 = xi1_0 * w30
        y1_1 = xi1_1 * w30
        y1_2 = xi1_2 * w30
        w31 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2
        c2_2, c3_1 = _stumpff_23(w31)
        w33 = 0.01 * xi1_0
        gE1_1_3 = w10 + w12
        gE1_1_6 = w17 - w16
        Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6
        Nr1_2 = xi1_1 * w33 + w28 * Q1_6
        s_mu_2 = m_2 + w29 * Nr1_2
        w34 = y1_1 * s_mu_2
        w35 = -100.0 * xi1_0 * p_2
        w36 = w27 * Q1_6
        Nr1_1 = w35 - w36
        s_mu_1 = m_1 + w29 * Nr1_1
        w37 = y1_2 * s_mu_1
        w38 = w34 - w37
        w40 = y1_0 * s_mu_1
        w41 = s_mu_0 * y1_1
        w42 = w40 - w41
        w43 = s_mu_0 * y1_2
        w44 = y1_0 * s_mu_2
        w45 = w43 - w44
        w46 = y1_1 * w42 - y1_2 * w45
        y1_2_0 = xi1_0 * w47
        y1_2_1 = xi1_1 * w47
        y1_2_2 = xi1_2 * w47
        w48 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w48)
        w50 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2
        w52 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1
        w53 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0
        w54 = y1_2_1 * w52 - y1_2_2 * w53
        M1_0 = (
            s_mu_0 - w38 * c2_2 + w46 * c3_1 + w47 * (Nr1_0 - w50 * c2_3 + w54 * c3_2)
        )
        w55 = y1_2 * w38 - y1_0 * w42
        w56 = y1_2_2 * w50 - y1_2_0 * w52
        M1_1 = (
            s_mu_1 - w45 * c2_2 + w55 * c3_1 + w47 * (Nr1_1 - w53 * c2_3 + w56 * c3_2)
        )
        w57 = y1_0 * w45 - y1_1 * w38
        w58 = y1_2_0 * w53 - y1_2_1 * w50
        M1_2 = (
            s_mu_2 - w42 * c2_2 + w57 * c3_1 + w47 * (Nr1_2 - w52 * c2_3 + w58 * c3_2)
        )
        Wf1_0 = 0.9900990099009901 * (gE1_1_0 * M1_0 + gE1_1_3 * M1_1 + gE1_1_6 * M1_2)
        Pf1_1 = gE1_1_1 * M1_0 + gE1_1_4 * M1_1 + gE1_1_7 * M1_2
        Wf1_2 = 100.0 * (gE1_1_2 * M1_0 + gE1_1_5 * M1_1 + gE1_1_8 * M1_2)
        next_xi1_0 = gE1_1_0 * Wf1_0 + gE1_1_1 * Pf1_1 + gE1_1_2 * Wf1_2
        next_xi1_1 = gE1_1_3 * Wf1_0 + gE1_1_4 * Pf1_1 + gE1_1_5 * Wf1_2
        next_xi1_2 = gE1_1_6 * Wf1_0 + gE1_1_7 * Pf1_1 + gE1_1_8 * Wf1_2
        residual_xi1_0 = next_xi1_0 - xi1_0
        residual_xi1_1 = next_xi1_1 - xi1_1
        residual_xi1_2 = next_xi1_2 - xi1_2
        total = residual_xi1_0 + residual_xi1_1 + residual_xi1_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
        if make_1:
            w59 = w1 * c2_1
            w60 = xE1_1_2 * w59
            w61 = 100.0 * gE1_1_8
            w62 = w47 * c3_2
            w63 = w53 * w62 * w47 + w45 * c3_1 * w30
            w64 = slope3(w31)
            w65 = slope2(w31)
            w66 = w57 * w64 + w65 * (w41 - w40)
            w67 = 2.0 * y1_0 * w30
            w68 = slope3(w48)
            w69 = slope2(w48)
            w70 = w47 * w58 * w68 - w47 * w52 * w69
            w71 = 2.0 * y1_2_0 * w47
            w72 = w30 * s_mu_1
            w73 = w72 * c2_2
            w74 = y1_0 * c3_1
            w75 = w30 * s_mu_2
            w76 = w47 * c2_3
            w77 = Nr1_1 * w47
            w78 = y1_2_0 * w62
            w79 = Nr1_2 * w47
            w80 = w63 + w66 * w67 + w70 * w71 - w73 - w74 * w75 - w76 * w77 - w78 * w79
            w81 = 100.0 * M1_2
            w82 = w1 * w9
            w83 = w82 + xE1_1_0 * w59
            w84 = 100.0 * gE1_1_5
            w85 = w55 * w64 + w65 * (w44 - w43)
            w86 = w52 * w62 * w47 + w42 * c3_1 * w30
            w87 = w47 * w56 * w68 - w47 * w53 * w69
            w88 = w75 * c2_2
            w89 = w76 * w79
            w90 = w67 * w85 - w86 + w71 * w87 - w72 * w74 + w88 - w77 * w78 + w89
            w91 = 100.0 * gE1_1_2
            w92 = w46 * w64 + w65 * (w37 - w34)
            w93 = w47 * w54 * w68 - w47 * w50 * w69
            w94 = y1_1 * c3_1
            w95 = w72 * w94
            w96 = y1_2 * c3_1
            w97 = w75 * w96
            w98 = y1_2_1 * w62
            w99 = y1_2_2 * w62
            w100 = w79 * w99
            w101 = w67 * w92 + w71 * w93 + w95 + w97 + w77 * w98 + w100
            w102 = 100.0 * M1_1
            w103 = w1 * c1_1
            w104 = w29 + w47
            w105 = w29 * y1_0
            w106 = w104 - w74 * w105
            w107 = w29 * y1_1
            w108 = w94 * w107
            w109 = y1_2_0 * w78
            w110 = y1_2_1 * w98
            w111 = w106 - w108 - w109 - w110
            w112 = w105 * c2_2
            w113 = y1_2_0 * w76
            w114 = w112 + w96 * w107 + w113 + y1_2_1 * w99
            w115 = w107 * c2_2
            w116 = y1_2_1 * w76
            w117 = w96 * w105 - w115 + y1_2_0 * w99 - w116
            w118 = w61 * w111 + w84 * w114 + w91 * w117
            w119 = w24 * (0.5 * w24 + 2.0 * w23 * w25) * w25
            w120 = 0.45 * w119
            w121 = Q1_6 * w120
            w122 = w20 * (0.5 * w20 + 2.0 * w19 * w21) * w21
            w123 = 0.45 * w122
            w124 = Q1_6 * w123
            w125 = -2.0 * w121 - 2.0 * w124
            w126 = g22 * w125
            w127 = 0.2 * w121 - 0.2 * w124
            w128 = g21 * w127
            w129 = g22 * w28
            w130 = g21 * w28
            w131 = xE1_1_1 * w59
            w132 = g22 * w127
            w133 = (
                0.01 * xi1_1
                - w83 * w126
                - w83 * w128
                + w60 * w129
                + w130 * w131
                + w103 * w132
            )
            w134 = g21 * w125
            w135 = w133 - w103 * w134
            w136 = (
                w61 * w80
                - w81 * w83
                + w84 * w90
                + w91 * w101
                - w102 * w103
                + w118 * w135
            )
            w137 = w29 * y1_2
            w138 = w94 * w137 - w112 - w113 + y1_2_2 * w98
            w139 = w96 * w137
            w140 = y1_2_2 * w99
            w141 = w106 - w139 - w109 - w140
            w142 = w137 * c2_2
            w143 = y1_2_2 * w76
            w144 = w94 * w105 + w142 + y1_2_0 * w98 + w143
            w145 = w61 * w138 + w84 * w141 + w91 * w144
            w146 = 2.0 * Q1_6
            w147 = 2.25 * w119
            w148 = w146 * w147
            w149 = -2.25 * w122
            w150 = w146 * w149
            w151 = 0.2 * w148 - 0.2 * w150
            w152 = g22 * w151
            w153 = -2.0 * w148 - 2.0 * w150
            w154 = g22 * w153
            w155 = g21 * w151
            w156 = g22 * w27
            w157 = g21 * w27
            w158 = (
                w103 * w152
                - (xi1_2 + w83 * w154 + w83 * w155 + w60 * w156 + w131 * w157)
            )
            w159 = g21 * w153
            w160 = w158 - w103 * w159
            w161 = w115 + w74 * w137 + w116 + y1_2_2 * w78
            w162 = w74 * w107 - w142 + y1_2_1 * w78 - w143
            w163 = w104 - w108 - w139 - w110 - w140
            w164 = w61 * w161 + w84 * w162 + w91 * w163
            w165 = -2.0 * Q1_7
            w166 = w147 * w165 - Q1_8 * w120
            w167 = w149 * w165 - Q1_8 * w123
            w168 = w27 + 0.2 * w166 - 0.2 * w167
            w169 = g22 * w168
            w170 = -2.0 * w166 - w28 - 2.0 * w167
            w171 = g22 * w170
            w172 = g21 * w168
            w173 = g21 * w170
            w174 = w103 * w169 - (w83 * w171 + w83 * w172) - w103 * w173
            w175 = g20 * w125
            w176 = g20 * w153
            w177 = g20 * w170
            w178 = 100.0 * M1_0 + w118 * w175 + w145 * w176 + w164 * w177
            w179 = w136 + w145 * w160 + w164 * w174 + w60 * w178
            w180 = 0.9900990099009901 * M1_2
            w181 = 0.9900990099009901 * M1_1
            w182 = 0.9900990099009901 * gE1_1_6
            w183 = 0.9900990099009901 * gE1_1_3
            w184 = 0.9900990099009901 * gE1_1_0
            w185 = w111 * w182 + w114 * w183 + w117 * w184
            w186 = (
                w60 * w180
                + w131 * w181
                + w80 * w182
                + w90 * w183
                + w101 * w184
                + w135 * w185
            )
            w187 = w138 * w182 + w141 * w183 + w144 * w184
            w188 = w161 * w182 + w162 * w183 + w163 * w184
            w189 = w175 * w185 + w176 * w187 + w177 * w188
            w190 = w186 + w160 * w187 + w174 * w188 + w60 * w189
            w191 = gE1_1_7 * w111 + gE1_1_4 * w114 + gE1_1_1 * w117
            w192 = (
                gE1_1_7 * w80
                - M1_1 * w83
                + gE1_1_4 * w90
                + gE1_1_1 * w101
                + M1_2 * w103
                + w135 * w191
            )
            w193 = gE1_1_7 * w138 + gE1_1_4 * w141 + gE1_1_1 * w144
            w194 = gE1_1_7 * w161 + gE1_1_4 * w162 + gE1_1_1 * w163
            w195 = w175 * w191 + w176 * w193 + w177 * w194
            w196 = w192 + w160 * w193 + w174 * w194 + w60 * w195
            w197 = g20 * w127
            w198 = g20 * w151
            w199 = g20 * w168
            w200 = w118 * w197 + w145 * w198 + w164 * w199
            w201 = w185 * w197 + w187 * w198 + w188 * w199
            w202 = M1_0 + w191 * w197 + w193 * w198 + w194 * w199
            w203 = Pf1_1 + gE1_1_2 * w200 + gE1_1_0 * w201 + gE1_1_1 * w202
            w204 = 2.0 * xE1_1_0 * w1
            c3_3 = _stumpff_3(w3)
            w205 = 0.5 * (c3_3 - c2_1)
            w206 = xE1_1_1 * w205
            w207 = slope2(w3)
            w208 = xE1_1_0 * w207
            w209 = xE1_1_2 * w208
            w210 = w206 + w209
            w211 = w2 * w207
            w212 = xE1_1_1 * w207
            w213 = xE1_1_1 * w212
            w214 = w211 + w213
            w215 = xE1_1_2 * w212
            w216 = xE1_1_0 * w205
            w217 = w215 - w216
            w218 = xE1_1_0 * w208
            w219 = w213 + w218
            w220 = w209 - w206
            w221 = g20 * w28
            w222 = w211 + w218
            w223 = xE1_1_2 * w205
            w224 = xE1_1_1 * w208
            w225 = w223 + w224
            w226 = w215 + w216
            w227 = (
                w129 * w220
                - (w126 * w219 + w214 * w221 + w128 * w222)
                + w130 * w225
                + w132 * w226
            )
            w228 = w227 + w134 * w217
            w229 = g20 * w27
            w230 = (
                w214 * w229
                - w154 * w219
                - w155 * w222
                - w156 * w220
                - w157 * w225
                + w152 * w226
            )
            w231 = w230 + w159 * w217
            w232 = w169 * w226 - (w171 * w219 + w172 * w222) + w173 * w217
            w233 = (
                w102 * w217
                - w81 * w219
                + w118 * w228
                + w145 * w231
                + w164 * w232
                + w178 * w210
            )
            w234 = 0.9900990099009901 * M1_0
            w235 = (
                w180 * w220
                - w214 * w234
                + w181 * w225
                + w185 * w228
                + w187 * w231
                + w188 * w232
            )
            w236 = w235 + w189 * w210
            w237 = (
                M1_2 * w226
                - M1_1 * w222
                + w191 * w228
                + w193 * w231
                + w194 * w232
                + w195 * w210
            )
            w238 = w224 - w223
            w239 = (
                Wf1_2 * w210
                - Wf1_0 * w214
                + gE1_1_2 * w233
                + gE1_1_0 * w236
                + gE1_1_1 * w237
                + w203 * w238
            )
            w240 = (
                Wf1_2 * w60
                + gE1_1_2 * w179
                + gE1_1_0 * w190
                + gE1_1_1 * w196
                + w131 * w203
                + w204 * w239
            )
            w241 = Wf1_2 * w103
            w242 = 2.0 * w5 * w1
            w243 = 2.0 * y1_1 * w30
            w244 = w50 * w62 * w47 + w38 * c3_1 * w30
            w245 = 2.0 * y1_2_1 * w47
            w246 = s_mu_0 * w30
            w247 = w246 * c2_2
            w248 = Nr1_0 * w47
            w249 = w76 * w248
            w250 = w66 * w243 - w244 + w70 * w245 + w247 - w75 * w94 + w249 - w79 * w98
            w251 = w74 * w246
            w252 = w78 * w248
            w253 = w85 * w243 + w87 * w245 + w251 + w97 + w252 + w100
            w254 = w86 + w92 * w243 + w93 * w245 - w94 * w246 - w88 - w98 * w248 - w89
            w255 = w1 * w7
            w256 = (
                w33 - w221 * w242 - w126 * w242 - w103 * w129 + w82 * w130 + w132 * w255
            )
            w257 = w256 + w134 * w255
            w258 = (
                w61 * w250
                - w81 * w242
                + w84 * w253
                + w91 * w254
                + w102 * w255
                + w118 * w257
            )
            w259 = (
                w229 * w242
                - w154 * w242
                + w103 * w156
                - w82 * w157
                + w152 * w255
                + w159 * w255
            )
            w260 = 0.99 * xi1_2 - w171 * w242 + w169 * w255 + w173 * w255
            w261 = w258 + w145 * w259 + w164 * w260 + w103 * w178
            w262 = (
                w82 * w181
                - (w234 * w242 + w103 * w180)
                + w182 * w250
                + w183 * w253
                + w184 * w254
            )
            w263 = w262 + w185 * w257 + w187 * w259 + w188 * w260 + w103 * w189
            w264 = (
                gE1_1_7 * w250
                + gE1_1_4 * w253
                + gE1_1_1 * w254
                + M1_2 * w255
                + w191 * w257
                + w193 * w259
            )
            w265 = w264 + w194 * w260 + w103 * w195
            w266 = (
                w241
                - Wf1_0 * w242
                + gE1_1_2 * w261
                + gE1_1_0 * w263
                + gE1_1_1 * w265
                + w82 * w203
            )
            w267 = 2.0 * xE1_1_1 * w1
            w268 = 2.0 * w7 * w1
            w269 = 2.0 * y1_2 * w30
            w270 = 2.0 * y1_2_2 * w47
            w271 = w47 * (w36 - w35)
            w272 = w66 * w269 + w70 * w270 + w251 + w95 + w252 - w98 * w271
            w273 = w244 + w85 * w269 + w87 * w270 - w247 - w72 * w96 - w249 + w99 * w271
            w274 = (
                w92 * w269
                - w63
                + w93 * w270
                - w96 * w246
                + w73
                - w99 * w248
                - w76 * w271
            )
            w275 = w1 * w5
            w276 = (
                w82 * w129
                - (w221 * w268 + w128 * w268)
                + w103 * w130
                + w132 * w275
                + w134 * w275
            )
            w277 = (
                w229 * w268
                - xi1_0
                - w155 * w268
                - w82 * w156
                - w103 * w157
                + w152 * w275
            )
            w278 = w277 + w159 * w275
            w279 = (
                w61 * w272
                + w84 * w273
                + w91 * w274
                + w102 * w275
                + w118 * w276
                + w145 * w278
            )
            w280 = 0.99 * xi1_1 - w172 * w268 + w169 * w275 + w173 * w275
            w281 = w279 + w164 * w280 + w82 * w178
            w282 = (
                w82 * w180
                - w234 * w268
                + w103 * w181
                + w182 * w272
                + w183 * w273
                + w184 * w274
            )
            w283 = w282 + w185 * w276 + w187 * w278 + w188 * w280 + w82 * w189
            w284 = (
                gE1_1_7 * w272
                - M1_1 * w268
                + gE1_1_4 * w273
                + gE1_1_1 * w274
                + M1_2 * w275
                + w191 * w276
            )
            w285 = w284 + w193 * w278 + w194 * w280 + w82 * w195
            w286 = (
                Wf1_2 * w82
                - Wf1_0 * w268
                + gE1_1_2 * w281
                + gE1_1_0 * w283
                + gE1_1_1 * w285
                - w103 * w203
            )
            w287 = 2.0 * xE1_1_2 * w1
            w288 = (
                Wf1_0 * w131
                - Pf1_1 * w83
                - w241
                + gE1_1_5 * w179
                + gE1_1_3 * w190
                + gE1_1_4 * w196
            )
            w289 = gE1_1_5 * w200 + gE1_1_3 * w201 + gE1_1_4 * w202
            w290 = (
                Wf1_0 * w225
                - Pf1_1 * w222
                + Wf1_2 * w217
                + gE1_1_5 * w233
                + gE1_1_3 * w236
                + gE1_1_4 * w237
            )
            w291 = w290 + w238 * w289
            w292 = Wf1_0 * w82
            w293 = (
                w292
                + Wf1_2 * w255
                + gE1_1_5 * w261
                + gE1_1_3 * w263
                + gE1_1_4 * w265
                + w82 * w289
            )
            w294 = Wf1_0 * w103
            w295 = (
                w294
                - Pf1_1 * w268
                + Wf1_2 * w275
                + gE1_1_5 * w281
                + gE1_1_3 * w283
                + gE1_1_4 * w285
            )
            w296 = (
                Wf1_0 * w60
                - Wf1_2 * w83
                + Pf1_1 * w103
                + gE1_1_8 * w179
                + gE1_1_6 * w190
                + gE1_1_7 * w196
            )
            w297 = gE1_1_8 * w200 + gE1_1_6 * w201 + gE1_1_7 * w202
            w298 = (
                Wf1_0 * w220
                - Wf1_2 * w219
                + Pf1_1 * w226
                + gE1_1_8 * w233
                + gE1_1_6 * w236
                + gE1_1_7 * w237
            )
            w299 = w298 + w238 * w297
            w300 = (
                Pf1_1 * w255
                - (w294 + Wf1_2 * w242)
                + gE1_1_8 * w261
                + gE1_1_6 * w263
                + gE1_1_7 * w265
            )
            w301 = (
                w292
                + Pf1_1 * w275
                + gE1_1_8 * w281
                + gE1_1_6 * w283
                + gE1_1_7 * w285
                - w103 * w297
            )
            row_1_1 = [
                1.0 - w240,
                -(w266 + w239 * w267),
                -(w286 + w239 * w287),
            ]
            row_1_2 = [
                -(w288 + w131 * w289 + w204 * w291),
                1.0 - (w293 + w267 * w291),
                -(w295 - w103 * w289 + w287 * w291),
            ]
            row_1_3 = [
                -(w296 + w131 * w297 + w204 * w299),
                -(w300 + w82 * w297 + w267 * w299),
                1.0 - (w301 + w287 * w299),
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
    xe1_1 = xi1_1 * w29
    xe1_0 = xi1_0 * w29
    w302 = xe1_0 * xe1_0
    w303 = xe1_1 * xe1_1
    w304 = w302 + w303
    xe1_2 = xi1_2 * w29
    w305 = xe1_2 * xe1_2
    w306 = w304 + w305
    c1_2, c2_4 = _stumpff_12(w306)
    w308 = xe1_1 * c2_4
    w309 = xe1_1 * w308
    w310 = xe1_2 * c2_4
    w311 = xe1_2 * w310
    w312 = w309 + w311
    ge1_0 = 1.0 - w312
    w313 = -0.8512071919596577 * h
    w322 = xe1_2 * c1_2
    w323 = xe1_0 * c2_4
    w324 = xe1_1 * w323
    ge1_3 = w322 + w324
    w329 = xe1_2 * w323
    w330 = xe1_1 * c1_2
    ge1_6 = w329 - w330
    ge1_2 = w329 + w330
    w333 = xe1_2 * w308
    w334 = xe1_0 * c1_2
    ge1_5 = w333 - w334
    w335 = xe1_0 * w323
    w336 = w309 + w335
    ge1_8 = 1.0 - w336
    ge1_1 = w324 - w322
    w340 = w311 + w335
    ge1_4 = 1.0 - w340
    ge1_7 = w333 + w334
    w352 = -1.7024143839193153 * h
    w357 = 1.7024143839193153 * h
    w371 = 0.8512071919596577 * h
    # the equations of xi2, n2: Newton's method in xi2_0, xi2_1, xi2_2
    previous_2 = 0.0
    make_2 = memory.inverses[1] is None
    for sweep in range(1, 101):
        xE2_2_1 = xi2_1 * w313
        xE2_2_0 = xi2_0 * w313
        xE2_2_2 = xi2_2 * w313
        w314 = xE2_2_2 * xE2_2_2
        w315 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + w314
        c1_3, c2_5 = _stumpff_12(w315)
        w317 = xE2_2_1 * c2_5
        w318 = xE2_2_1 * w317
        w319 = xE2_2_2 * c2_5
        w320 = xE2_2_2 * w319
        gE2_2_0 = 1.0 - (w318 + w320)
        w325 = xE2_2_0 * c2_5
        w326 = xE2_2_1 * w325
        w328 = xE2_2_2 * c1_3
        gE2_2_1 = w326 - w328
        w331 = xE2_2_1 * c1_3
        w332 = xE2_2_2 * w325
        gE2_2_2 = w331 + w332
        E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2
        E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8
        gE2_2_3 = w326 + w328
        w337 = xE2_2_0 * w325
        gE2_2_4 = 1.0 - (w320 + w337)
        w338 = xE2_2_2 * w317
        w339 = xE2_2_0 * c1_3
        gE2_2_5 = w338 - w339
        E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5
        gE2_2_6 = w332 - w331
        gE2_2_7 = w338 + w339
        gE2_2_8 = 1.0 - (w318 + w337)
        E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8
        a_3_2 = xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8
        p_2_2 = 0.01 * a_3_2
        E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7
        E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7
        E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7
        a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7
        Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7
        Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8
        w341 = 1.5 - 2.0 * Q2_8
        w342 = 1.0 / sqrt(1.01 + 1.5 * (w341 - 0.2 * Q2_7))
        w343 = w342 * w342
        w344 = 0.5 * w342
        w345 = w343 * w344
        w346 = 1.0 / sqrt(1.01 + 1.5 * (w341 + 0.2 * Q2_7))
        w347 = w346 * w346
        w348 = 0.5 * w346
        w349 = w347 * w348
        w350 = -1.0 - 2.0 * (1.5 * w345 - 1.5 * w349)
        w351 = -0.3 * w345 - 0.3 * w349
        Nr2_0 = Q2_7 * w350 - Q2_8 * w351 + 99.0 * a_3_1 * p_2_2
        w353 = Nr2_0 * w352
        s_m2_4_0 = s_mu_0 + w353
        E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5
        E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8
        a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6
        Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6
        Nr2_1 = -100.0 * a_3_0 * p_2_2 - w350 * Q2_6
        w354 = w352 * Nr2_1
        s_m2_4_1 = s_mu_1 + w354
        w355 = 0.01 * a_3_0
        Nr2_2 = a_3_1 * w355 + w351 * Q2_6
        w356 = w352 * Nr2_2
        s_m2_4_2 = s_mu_2 + w356
        m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2
        y2_0 = xi2_0 * w357
        y2_1 = xi2_1 * w357
        y2_2 = xi2_2 * w357
        w358 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2
        c2_6, c3_4 = _stumpff_23(w358)
        m2_4_2_2 = ge1_6 * s_m2_4_0 + ge1_7 * s_m2_4_1 + ge1_8 * s_m2_4_2
        w360 = y2_1 * m2_4_2_2
        m2_4_2_1 = ge1_3 * s_m2_4_0 + ge1_4 * s_m2_4_1 + ge1_5 * s_m2_4_2
        w361 = y2_2 * m2_4_2_1
        w362 = w360 - w361
        w364 = y2_0 * m2_4_2_1
        w365 = m2_4_2_0 * y2_1
        w366 = w364 - w365
        w367 = m2_4_2_0 * y2_2
        w368 = y2_0 * m2_4_2_2
        w369 = w367 - w368
        w370 = y2_1 * w366 - y2_2 * w369
        m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2
        y2_2_0 = xi2_0 * w371
        y2_2_1 = xi2_1 * w371
        y2_2_2 = xi2_2 * w371
        w372 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2
        c2_7, c3_5 = _stumpff_23(w372)
        m2_3_2 = ge1_6 * Nr2_0 + ge1_7 * Nr2_1 + ge1_8 * Nr2_2
        m2_3_1 = ge1_3 * Nr2_0 + ge1_4 * Nr2_1 + ge1_5 * Nr2_2
        w374 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1
        w376 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1
        w377 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2
        w378 = y2_2_1 * w376 - y2_2_2 * w377
        M2_0 = (
            m2_4_2_0
            - w362 * c2_6
            + w370 * c3_4
            + w371 * (m2_3_0 - w374 * c2_7 + w378 * c3_5)
        )
        w379 = y2_2 * w362 - y2_0 * w366
        w380 = y2_2_2 * w374 - y2_2_0 * w376
        M2_1 = (
            m2_4_2_1
            - w369 * c2_6
            + w379 * c3_4
            + w371 * (m2_3_1 - w377 * c2_7 + w380 * c3_5)
        )
        w381 = y2_0 * w369 - y2_1 * w362
        w382 = y2_2_0 * w377 - y2_2_1 * w374
        M2_2 = (
            m2_4_2_2
            - w366 * c2_6
            + w381 * c3_4
            + w371 * (m2_3_2 - w376 * c2_7 + w382 * c3_5)
        )
        Wf2_0 = 0.9900990099009901 * (E2_2_0 * M2_0 + E2_2_3 * M2_1 + E2_2_6 * M2_2)
        Pf2_1 = E2_2_1 * M2_0 + E2_2_4 * M2_1 + E2_2_7 * M2_2
        Wf2_2 = 100.0 * (E2_2_2 * M2_0 + E2_2_5 * M2_1 + E2_2_8 * M2_2)
        next_xi2_0 = E2_2_0 * Wf2_0 + E2_2_1 * Pf2_1 + E2_2_2 * Wf2_2
        next_xi2_1 = E2_2_3 * Wf2_0 + E2_2_4 * Pf2_1 + E2_2_5 * Wf2_2
        next_xi2_2 = E2_2_6 * Wf2_0 + E2_2_7 * Pf2_1 + E2_2_8 * Wf2_2
        residual_xi2_0 = next_xi2_0 - xi2_0
        residual_xi2_1 = next_xi2_1 - xi2_1
        residual_xi2_2 = next_xi2_2 - xi2_2
        total = residual_xi2_0 + residual_xi2_1 + residual_xi2_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi2, n2", 1, sweep, statistics)
        if make_2:
            w383 = w313 * c2_5
            w384 = xE2_2_2 * ge1_6 + xE2_2_1 * ge1_3
            w385 = w383 * w384
            w386 = xE2_2_2 * ge1_8 + xE2_2_1 * ge1_5
            w387 = w383 * w386
            w388 = xE2_2_2 * ge1_7 + xE2_2_1 * ge1_4
            w389 = w383 * w388
            w390 = 100.0 * E2_2_8
            w391 = w371 * c3_5
            w392 = w377 * w391 * w371 + w369 * c3_4 * w357
            w393 = slope3(w358)
            w394 = slope2(w358)
            w395 = w381 * w393 + w394 * (w365 - w364)
            w396 = 2.0 * y2_0 * w357
            w397 = slope3(w372)
            w398 = slope2(w372)
            w399 = w371 * w382 * w397 - w371 * w376 * w398
            w400 = 2.0 * y2_2_0 * w371
            w401 = w357 * m2_4_2_1
            w402 = w401 * c2_6
            w403 = y2_0 * c3_4
            w404 = w357 * m2_4_2_2
            w405 = w371 * c2_7
            w406 = w371 * m2_3_1
            w407 = w405 * w406
            w408 = y2_2_0 * w391
            w409 = w371 * m2_3_2
            w410 = (
                w392
                + w395 * w396
                + w399 * w400
                - w402
                - w403 * w404
                - w407
                - w408 * w409
            )
            w411 = 100.0 * E2_2_5
            w412 = w379 * w393 + w394 * (w368 - w367)
            w413 = w376 * w391 * w371 + w366 * c3_4 * w357
            w414 = w371 * w380 * w397 - w371 * w377 * w398
            w415 = w404 * c2_6
            w416 = w405 * w409
            w417 = (
                w396 * w412
                - w413
                + w400 * w414
                - w401 * w403
                + w415
                - w406 * w408
                + w416
            )
            w418 = 100.0 * E2_2_2
            w419 = w370 * w393 + w394 * (w361 - w360)
            w420 = w371 * w378 * w397 - w371 * w374 * w398
            w421 = y2_1 * c3_4
            w422 = w401 * w421
            w423 = y2_2 * c3_4
            w424 = w404 * w423
            w425 = y2_2_1 * w391
            w426 = w406 * w425
            w427 = y2_2_2 * w391
            w428 = w409 * w427
            w429 = w396 * w419 + w400 * w420 + w422 + w424 + w426 + w428
            w430 = 100.0 * M2_0
            w431 = w313 * w325
            w432 = w431 + xE2_2_0 * w383
            w433 = 100.0 * M2_2
            w434 = ge1_8 * w433
            w435 = 100.0 * M2_1
            w436 = ge1_5 * w435
            w437 = (
                w390 * w410
                + w411 * w417
                + w418 * w429
                + w387 * w430
                - w432 * w434
                - w432 * w436
            )
            w438 = ge1_8 * w352
            w439 = ge1_5 * w352
            w440 = ge1_2 * w352
            w441 = y2_0 * w439 - y2_1 * w440
            w442 = y2_2 * w440 - y2_0 * w438
            w443 = y2_1 * w438 - y2_2 * w439
            w444 = ge1_5 * y2_2_0 - ge1_2 * y2_2_1
            w445 = (
                w438
                + ge1_8 * w371
                - w441 * c2_6
                + w403 * w442
                - w421 * w443
                - w405 * w444
            )
            w446 = ge1_2 * y2_2_2 - ge1_8 * y2_2_0
            w447 = ge1_8 * y2_2_1 - ge1_5 * y2_2_2
            w448 = w445 + w408 * w446 - w425 * w447
            w449 = (
                w439
                + ge1_5 * w371
                - w403 * w441
                - w442 * c2_6
                + w423 * w443
                - w408 * w444
            )
            w450 = w449 - w405 * w446 + w427 * w447
            w451 = (
                w440
                + ge1_2 * w371
                + w421 * w441
                - w423 * w442
                - w443 * c2_6
                + w425 * w444
            )
            w452 = w451 - w427 * w446 - w405 * w447
            w453 = w390 * w448 + w411 * w450 + w418 * w452
            w454 = 0.01 * a_3_1
            w455 = g20 * w351 + xi2_0 * w454
            w456 = w347 * (0.5 * w347 + 2.0 * w346 * w348) * w348
            w457 = 0.45 * w456
            w458 = Q2_6 * w457
            w459 = w343 * (0.5 * w343 + 2.0 * w342 * w344) * w344
            w460 = 0.45 * w459
            w461 = Q2_6 * w460
            w462 = -2.0 * w458 - 2.0 * w461
            w463 = g20 * w462
            w464 = 0.2 * w458 - 0.2 * w461
            w465 = g20 * w464 + xi2_0 * w355
            w466 = g22 * w351 + xi2_2 * w454
            w467 = g22 * w462
            w468 = g22 * w464 + xi2_2 * w355
            w469 = ge1_6 * w466 + ge1_8 * w467 + ge1_7 * w468
            w470 = (
                E2_2_1 * w355
                + E2_2_0 * w454
                + w385 * w455
                + w387 * w463
                + w389 * w465
                - w432 * w469
            )
            w471 = g21 * w351 + xi2_1 * w454
            w472 = g21 * w462
            w473 = g21 * w464 + xi2_1 * w355
            w474 = ge1_3 * w471 + ge1_5 * w472 + ge1_4 * w473
            w475 = w470 - w432 * w474
            w476 = ge1_7 * w352
            w477 = ge1_4 * w352
            w478 = ge1_1 * w352
            w479 = y2_0 * w477 - y2_1 * w478
            w480 = y2_2 * w478 - y2_0 * w476
            w481 = y2_1 * w476 - y2_2 * w477
            w482 = ge1_4 * y2_2_0 - ge1_1 * y2_2_1
            w483 = (
                w476
                + ge1_7 * w371
                - w479 * c2_6
                + w403 * w480
                - w421 * w481
                - w405 * w482
            )
            w484 = ge1_1 * y2_2_2 - ge1_7 * y2_2_0
            w485 = ge1_7 * y2_2_1 - ge1_4 * y2_2_2
            w486 = w483 + w408 * w484 - w425 * w485
            w487 = (
                w477
                + ge1_4 * w371
                - w403 * w479
                - w480 * c2_6
                + w423 * w481
                - w408 * w482
            )
            w488 = w487 - w405 * w484 + w427 * w485
            w489 = (
                w478
                + ge1_1 * w371
                + w421 * w479
                - w423 * w480
                - w481 * c2_6
                + w425 * w482
            )
            w490 = w489 - w427 * w484 - w405 * w485
            w491 = w390 * w486 + w411 * w488 + w418 * w490
            w492 = 2.0 * Q2_6
            w493 = 2.25 * w456
            w494 = w492 * w493
            w495 = -2.25 * w459
            w496 = w492 * w495
            w497 = -2.0 * w494 - 2.0 * w496
            w498 = g20 * w497 - xi2_0 * a_3_0
            w499 = g20 * w350 + xi2_0 * a_3_2
            w500 = 0.2 * w494 - 0.2 * w496
            w501 = g20 * w500
            w502 = g22 * w497 - xi2_2 * a_3_0
            w503 = g22 * w350 + xi2_2 * a_3_2
            w504 = g22 * w500
            w505 = ge1_8 * w502 - ge1_6 * w503 + ge1_7 * w504
            w506 = (
                w387 * w498
                - (E2_2_2 * a_3_0 + E2_2_0 * a_3_2 + w385 * w499)
                + w389 * w501
                - w432 * w505
            )
            w507 = g21 * w497 - xi2_1 * a_3_0
            w508 = g21 * w350 + xi2_1 * a_3_2
            w509 = g21 * w500
            w510 = ge1_5 * w507 - ge1_3 * w508 + ge1_4 * w509
            w511 = w506 - w432 * w510
            w512 = w313 * c1_3
            w513 = ge1_3 * w466 + ge1_5 * w467 + ge1_4 * w468
            w514 = ge1_5 * w502 - ge1_3 * w503 + ge1_4 * w504
            w515 = ge1_5 * w433 + w453 * w513 + w491 * w514
            w516 = xE2_2_2 * w383
            w517 = ge1_0 * w466 + ge1_2 * w467 + ge1_1 * w468
            w518 = ge1_2 * w502 - ge1_0 * w503 + ge1_1 * w504
            w519 = ge1_2 * w433 + w453 * w517 + w491 * w518
            w520 = ge1_6 * w352
            w521 = ge1_3 * w352
            w522 = ge1_0 * w352
            w523 = y2_0 * w521 - y2_1 * w522
            w524 = y2_2 * w522 - y2_0 * w520
            w525 = y2_1 * w520 - y2_2 * w521
            w526 = ge1_3 * y2_2_0 - ge1_0 * y2_2_1
            w527 = (
                w520
                + ge1_6 * w371
                - w523 * c2_6
                + w403 * w524
                - w421 * w525
                - w405 * w526
            )
            w528 = ge1_0 * y2_2_2 - ge1_6 * y2_2_0
            w529 = ge1_6 * y2_2_1 - ge1_3 * y2_2_2
            w530 = w527 + w408 * w528 - w425 * w529
            w531 = (
                w521
                + ge1_3 * w371
                - w403 * w523
                - w524 * c2_6
                + w423 * w525
                - w408 * w526
            )
            w532 = w531 - w405 * w528 + w427 * w529
            w533 = (
                w522
                + ge1_0 * w371
                + w421 * w523
                - w423 * w524
                - w525 * c2_6
                + w425 * w526
            )
            w534 = w533 - w427 * w528 - w405 * w529
            w535 = w390 * w530 + w411 * w532 + w418 * w534
            w536 = 0.99 * a_3_1
            w537 = 0.99 * a_3_2
            w538 = -2.0 * Q2_7
            w539 = w493 * w538 - Q2_8 * w457
            w540 = w495 * w538 - Q2_8 * w460
            w541 = -2.0 * w539 - w351 - 2.0 * w540
            w542 = g20 * w541 + xi2_0 * w536
            w543 = w350 + 0.2 * w539 - 0.2 * w540
            w544 = g20 * w543 + xi2_0 * w537
            w545 = g22 * w541 + xi2_2 * w536
            w546 = g22 * w543 + xi2_2 * w537
            w547 = ge1_8 * w545 + ge1_7 * w546
            w548 = g21 * w541 + xi2_1 * w536
            w549 = g21 * w543 + xi2_1 * w537
            w550 = ge1_5 * w548 + ge1_4 * w549
            w551 = (
                E2_2_2 * w536
                + E2_2_1 * w537
                + w387 * w542
                + w389 * w544
                - w432 * w547
                - w432 * w550
            )
            w552 = ge1_5 * w545 + ge1_4 * w546
            w553 = ge1_2 * w545 + ge1_1 * w546
            w554 = w551 + w512 * w552 + w516 * w553
            w555 = (
                w437
                + w453 * w475
                + w491 * w511
                + w512 * w515
                + w516 * w519
                + w535 * w554
            )
            w556 = ge1_6 * w471 + ge1_8 * w472 + ge1_7 * w473
            w557 = ge1_8 * w507 - ge1_6 * w508 + ge1_7 * w509
            w558 = ge1_8 * w548 + ge1_7 * w549
            w559 = ge1_8 * w435 + w453 * w556 + w491 * w557 + w535 * w558
            w560 = w555 - w512 * w559
            w561 = 0.9900990099009901 * M2_0
            w562 = 0.9900990099009901 * E2_2_6
            w563 = 0.9900990099009901 * E2_2_3
            w564 = 0.9900990099009901 * E2_2_0
            w565 = 0.9900990099009901 * M2_2
            w566 = ge1_6 * w565
            w567 = 0.9900990099009901 * M2_1
            w568 = ge1_3 * w567
            w569 = (
                w385 * w561
                + w410 * w562
                + w417 * w563
                + w429 * w564
                - w432 * w566
                - w432 * w568
            )
            w570 = w448 * w562 + w450 * w563 + w452 * w564
            w571 = w486 * w562 + w488 * w563 + w490 * w564
            w572 = ge1_3 * w565 + w513 * w570 + w514 * w571
            w573 = ge1_0 * w565 + w517 * w570 + w518 * w571
            w574 = w530 * w562 + w532 * w563 + w534 * w564
            w575 = (
                w569
                + w475 * w570
                + w511 * w571
                + w512 * w572
                + w516 * w573
                + w554 * w574
            )
            w576 = ge1_6 * w567 + w556 * w570 + w557 * w571 + w558 * w574
            w577 = w575 - w512 * w576
            w578 = ge1_7 * M2_2
            w579 = ge1_4 * M2_1
            w580 = (
                E2_2_7 * w410
                + E2_2_4 * w417
                + E2_2_1 * w429
                + M2_0 * w389
                - w432 * w578
                - w432 * w579
            )
            w581 = E2_2_7 * w448 + E2_2_4 * w450 + E2_2_1 * w452
            w582 = E2_2_7 * w486 + E2_2_4 * w488 + E2_2_1 * w490
            w583 = ge1_4 * M2_2 + w513 * w581 + w514 * w582
            w584 = ge1_1 * M2_2 + w517 * w581 + w518 * w582
            w585 = E2_2_7 * w530 + E2_2_4 * w532 + E2_2_1 * w534
            w586 = (
                w580
                + w475 * w581
                + w511 * w582
                + w512 * w583
                + w516 * w584
                + w554 * w585
            )
            w587 = ge1_7 * M2_1 + w556 * w581 + w557 * w582 + w558 * w585
            w588 = w586 - w512 * w587
            w589 = (
                Wf2_0 * w385
                + Wf2_2 * w387
                + Pf2_1 * w389
                + E2_2_2 * w560
                + E2_2_0 * w577
                + E2_2_1 * w588
            )
            w590 = xE2_2_1 * w383
            w591 = ge1_0 * w471 + ge1_2 * w472 + ge1_1 * w473
            w592 = ge1_2 * w507 - ge1_0 * w508 + ge1_1 * w509
            w593 = ge1_2 * w548 + ge1_1 * w549
            w594 = ge1_2 * w435 + w453 * w591 + w491 * w592 + w535 * w593
            w595 = ge1_0 * w567 + w570 * w591 + w571 * w592 + w574 * w593
            w596 = ge1_1 * M2_1 + w581 * w591 + w582 * w592 + w585 * w593
            w597 = E2_2_2 * w594 + E2_2_0 * w595 + E2_2_1 * w596
            w598 = 2.0 * xE2_2_0 * w313
            c3_6 = _stumpff_3(w315)
            w599 = 0.5 * (c3_6 - c2_5)
            w600 = xE2_2_1 * w599
            w601 = slope2(w315)
            w602 = w314 * w601
            w603 = xE2_2_1 * w601
            w604 = xE2_2_1 * w603
            w605 = w602 + w604
            w606 = xE2_2_2 * w599
            w607 = xE2_2_0 * w601
            w608 = ge1_6 * w600 - ge1_0 * w605 - ge1_3 * w606 + w384 * w607
            w609 = ge1_8 * w600 - ge1_2 * w605 - ge1_5 * w606 + w386 * w607
            w610 = ge1_7 * w600 - ge1_1 * w605 - ge1_4 * w606 + w388 * w607
            w611 = xE2_2_0 * w607
            w612 = w604 + w611
            w613 = w602 + w611
            w614 = w455 * w608 + w463 * w609 + w465 * w610 - w469 * w612 - w474 * w613
            w615 = w498 * w609 - w499 * w608 + w501 * w610 - w505 * w612 - w510 * w613
            w616 = xE2_2_0 * w599
            w617 = xE2_2_2 * w603
            w618 = w616 + w617
            w619 = (
                w430 * w609
                - w434 * w612
                - w436 * w613
                + w453 * w614
                + w491 * w615
                + w515 * w618
            )
            w620 = xE2_2_2 * w607 - w600
            w621 = (
                w542 * w609
                + w544 * w610
                - w547 * w612
                - w550 * w613
                + w552 * w618
                + w553 * w620
            )
            w622 = w617 - w616
            w623 = w619 + w519 * w620 + w535 * w621 + w559 * w622
            w624 = (
                w561 * w608
                - w566 * w612
                - w568 * w613
                + w570 * w614
                + w571 * w615
                + w572 * w618
            )
            w625 = w624 + w573 * w620 + w574 * w621 + w576 * w622
            w626 = (
                M2_0 * w610
                - w578 * w612
                - w579 * w613
                + w581 * w614
                + w582 * w615
                + w583 * w618
            )
            w627 = w626 + w584 * w620 + w585 * w621 + w587 * w622
            w628 = (
                Wf2_0 * w608
                + Wf2_2 * w609
                + Pf2_1 * w610
                + E2_2_2 * w623
                + E2_2_0 * w625
                + E2_2_1 * w627
            )
            w629 = w606 + xE2_2_1 * w607
            w630 = w628 + w597 * w629
            w631 = 2.0 * w317
            w632 = ge1_6 * w512 - ge1_0 * w631 * w313 + ge1_3 * w431
            w633 = ge1_8 * w512 - ge1_2 * w631 * w313 + ge1_5 * w431
            w634 = ge1_7 * w512 - ge1_1 * w631 * w313 + ge1_4 * w431
            w635 = 2.0 * y2_1 * w357
            w636 = w374 * w391 * w371 + w362 * c3_4 * w357
            w637 = 2.0 * y2_2_1 * w371
            w638 = m2_4_2_0 * w357
            w639 = w638 * c2_6
            w640 = w371 * m2_3_0
            w641 = w405 * w640
            w642 = (
                w395 * w635
                - w636
                + w399 * w637
                + w639
                - w404 * w421
                + w641
                - w409 * w425
            )
            w643 = w403 * w638
            w644 = w408 * w640
            w645 = w412 * w635 + w414 * w637 + w643 + w424 + w644 + w428
            w646 = (
                w413
                + w419 * w635
                + w420 * w637
                - w421 * w638
                - w415
                - w425 * w640
                - w416
            )
            w647 = w313 * w631
            w648 = (
                E2_2_4 * w355
                + E2_2_3 * w454
                + w455 * w632
                + w463 * w633
                + w465 * w634
                - w469 * w647
            )
            w649 = (
                w390 * w642
                + w411 * w645
                + w418 * w646
                + w430 * w633
                - w434 * w647
                + w453 * w648
            )
            w650 = (
                w498 * w633
                - (E2_2_5 * a_3_0 + a_3_2 * E2_2_3 + w499 * w632)
                + w501 * w634
                - w505 * w647
            )
            w651 = w313 * w319
            w652 = (
                E2_2_5 * w536
                + E2_2_4 * w537
                + w542 * w633
                + w544 * w634
                - w547 * w647
                + w552 * w651
            )
            w653 = w652 - w512 * w553
            w654 = (
                w649
                + w491 * w650
                + w515 * w651
                - w512 * w519
                + w535 * w653
                + w559 * w651
            )
            w655 = (
                w561 * w632
                + w562 * w642
                + w563 * w645
                + w564 * w646
                - w566 * w647
                + w570 * w648
            )
            w656 = (
                w655
                + w571 * w650
                + w572 * w651
                - w512 * w573
                + w574 * w653
                + w576 * w651
            )
            w657 = (
                E2_2_7 * w642
                + E2_2_4 * w645
                + E2_2_1 * w646
                + M2_0 * w634
                - w578 * w647
                + w581 * w648
            )
            w658 = (
                w657
                + w582 * w650
                + w583 * w651
                - w512 * w584
                + w585 * w653
                + w587 * w651
            )
            w659 = (
                Wf2_0 * w632
                + Wf2_2 * w633
                + Pf2_1 * w634
                + E2_2_2 * w654
                + E2_2_0 * w656
                + E2_2_1 * w658
            )
            w660 = 2.0 * xE2_2_1 * w313
            w661 = 2.0 * w319
            w662 = ge1_6 * w431 - ge1_0 * w661 * w313 - ge1_3 * w512
            w663 = ge1_8 * w431 - ge1_2 * w661 * w313 - ge1_5 * w512
            w664 = ge1_7 * w431 - ge1_1 * w661 * w313 - ge1_4 * w512
            w665 = 2.0 * y2_2 * w357
            w666 = 2.0 * y2_2_2 * w371
            w667 = w395 * w665 + w399 * w666 + w643 + w422 + w644 + w426
            w668 = (
                w636
                + w412 * w665
                + w414 * w666
                - w639
                - w401 * w423
                - w641
                - w406 * w427
            )
            w669 = (
                w419 * w665
                - w392
                + w420 * w666
                - w423 * w638
                + w402
                - w427 * w640
                + w407
            )
            w670 = w313 * w661
            w671 = (
                E2_2_7 * w355
                + E2_2_6 * w454
                + w455 * w662
                + w463 * w663
                + w465 * w664
                - w474 * w670
            )
            w672 = (
                w390 * w667
                + w411 * w668
                + w418 * w669
                + w430 * w663
                - w436 * w670
                + w453 * w671
            )
            w673 = (
                w498 * w663
                - (E2_2_8 * a_3_0 + a_3_2 * E2_2_6 + w499 * w662)
                + w501 * w664
                - w510 * w670
            )
            w674 = w313 * w317
            w675 = (
                E2_2_8 * w536
                + E2_2_7 * w537
                + w542 * w663
                + w544 * w664
                - w550 * w670
                + w552 * w674
            )
            w676 = w675 + w431 * w553
            w677 = (
                w672
                + w491 * w673
                + w515 * w674
                + w431 * w519
                + w535 * w676
                + w559 * w674
            )
            w678 = (
                w561 * w662
                + w562 * w667
                + w563 * w668
                + w564 * w669
                - w568 * w670
                + w570 * w671
            )
            w679 = (
                w678
                + w571 * w673
                + w572 * w674
                + w431 * w573
                + w574 * w676
                + w576 * w674
            )
            w680 = (
                E2_2_7 * w667
                + E2_2_4 * w668
                + E2_2_1 * w669
                + M2_0 * w664
                - w579 * w670
                + w581 * w671
            )
            w681 = (
                w680
                + w582 * w673
                + w583 * w674
                + w431 * w584
                + w585 * w676
                + w587 * w674
            )
            w682 = (
                Wf2_0 * w662
                + Wf2_2 * w663
                + Pf2_1 * w664
                + E2_2_2 * w677
                + E2_2_0 * w679
                + E2_2_1 * w681
            )
            w683 = 2.0 * xE2_2_2 * w313
            w684 = ge1_3 * Wf2_0 + ge1_5 * Wf2_2 + ge1_4 * Pf2_1
            w685 = ge1_6 * Wf2_0 + ge1_8 * Wf2_2 + ge1_7 * Pf2_1
            w686 = ge1_0 * Wf2_0 + ge1_2 * Wf2_2 + ge1_1 * Pf2_1
            w687 = w686 + E2_2_5 * w594 + E2_2_3 * w595 + E2_2_4 * w596
            w688 = (
                E2_2_5 * w560
                - (w432 * w684 + w512 * w685)
                + E2_2_3 * w577
                + E2_2_4 * w588
                + w590 * w687
            )
            w689 = (
                w622 * w685
                - w613 * w684
                + E2_2_5 * w623
                + E2_2_3 * w625
                + E2_2_4 * w627
                + w629 * w687
            )
            w690 = (
                w651 * w685
                + E2_2_5 * w654
                + E2_2_3 * w656
                + E2_2_4 * w658
                + w431 * w687
                + w660 * w689
            )
            w691 = (
                w674 * w685
                - w670 * w684
                + E2_2_5 * w677
                + E2_2_3 * w679
                + E2_2_4 * w681
                + w512 * w687
            )
            w692 = (
                w512 * w684
                - w432 * w685
                + w516 * w686
                + E2_2_8 * w560
                + E2_2_6 * w577
                + E2_2_7 * w588
            )
            w693 = E2_2_8 * w594 + E2_2_6 * w595 + E2_2_7 * w596
            w694 = (
                w618 * w684
                - w612 * w685
                + w620 * w686
                + E2_2_8 * w623
                + E2_2_6 * w625
                + E2_2_7 * w627
            )
            w695 = w694 + w629 * w693
            w696 = (
                w651 * w684
                - w647 * w685
                - w512 * w686
                + E2_2_8 * w654
                + E2_2_6 * w656
                + E2_2_7 * w658
            )
            w697 = (
                w674 * w684
                + w431 * w686
                + E2_2_8 * w677
                + E2_2_6 * w679
                + E2_2_7 * w681
                + w512 * w693
            )
            row_2_1 = [
                1.0 - (w589 + w590 * w597 + w598 * w630),
                -(w659 + w431 * w597 + w630 * w660),
                -(w682 + w512 * w597 + w630 * w683),
            ]
            row_2_2 = [
                -(w688 + w598 * w689),
                1.0 - w690,
                -(w691 + w683 * w689),
            ]
            row_2_3 = [
                -(w692 + w590 * w693 + w598 * w695),
                -(w696 + w431 * w693 + w660 * w695),
                1.0 - (w697 + w683 * w695),
            ]
            memory.inverses[1] = invert([row_2_1, row_2_2, row_2_3])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[1] is None:
                raise _failed(NOT_CONVERGED, "the equations of xi2, n2", 1, sweep, statistics)
        row_2_1, row_2_2, row_2_3 = memory.inverses[1]
        change_xi2_0 = (
            row_2_1[0] * residual_xi2_0
            + row_2_1[1] * residual_xi2_1
            + row_2_1[2] * residual_xi2_2
        )
        change_xi2_1 = (
            row_2_2[0] * residual_xi2_0
            + row_2_2[1] * residual_xi2_1
            + row_2_2[2] * residual_xi2_2
        )
        change_xi2_2 = (
            row_2_3[0] * residual_xi2_0
            + row_2_3[1] * residual_xi2_1
            + row_2_3[2] * residual_xi2_2
        )
        xi2_0 += change_xi2_0
        xi2_1 += change_xi2_1
        xi2_2 += change_xi2_2
        change = max(abs(change_xi2_0), abs(change_xi2_1), abs(change_xi2_2))
        scale = max(1.0, abs(xi2_0), abs(xi2_1), abs(xi2_2))
        still = 0.0 < previous_2 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_2
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        make_2 = 0.0 < 0.0625 * previous_2 < change
        previous_2 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi2, n2", 1, sweep, statistics)
    if statistics is not None:
        statistics.count(1, sweep)
    xe2_1 = xi2_1 * w352
    xe2_0 = xi2_0 * w352
    w698 = xe2_0 * xe2_0
    w699 = xe2_1 * xe2_1
    w700 = w698 + w699
    xe2_2 = xi2_2 * w352
    w701 = xe2_2 * xe2_2
    w702 = w700 + w701
    c1_4, c2_8 = _stumpff_12(w702)
    w704 = xe2_1 * c2_8
    w705 = xe2_1 * w704
    w706 = xe2_2 * c2_8
    w707 = xe2_2 * w706
    w708 = w705 + w707
    ge2_0 = 1.0 - w708
    w709 = ge1_0 * ge2_0
    w710 = xe2_0 * c2_8
    w711 = xe2_1 * w710
    w713 = xe2_2 * c1_4
    ge2_1 = w711 - w713
    w714 = ge1_3 * ge2_1
    w715 = w709 + w714
    w716 = xe2_1 * c1_4
    w717 = xe2_2 * w710
    ge2_2 = w716 + w717
    w718 = ge1_6 * ge2_2
    e2_0 = w715 + w718
    ge2_3 = w711 + w713
    w726 = ge1_0 * ge2_3
    w727 = xe2_0 * w710
    w728 = w707 + w727
    ge2_4 = 1.0 - w728
    w729 = ge1_3 * ge2_4
    w730 = w726 + w729
    w731 = xe2_2 * w704
    w732 = xe2_0 * c1_4
    ge2_5 = w731 - w732
    w733 = ge1_6 * ge2_5
    e2_3 = w730 + w733
    ge2_6 = w717 - w716
    w738 = ge1_0 * ge2_6
    ge2_7 = w731 + w732
    w739 = ge1_3 * ge2_7
    w740 = w738 + w739
    w741 = w705 + w727
    ge2_8 = 1.0 - w741
    w742 = ge1_6 * ge2_8
    e2_6 = w740 + w742
    w745 = ge1_2 * ge2_0
    w746 = ge1_5 * ge2_1
    w747 = w745 + w746
    w748 = ge1_8 * ge2_2
    e2_2 = w747 + w748
    w749 = ge1_2 * ge2_3
    w750 = ge1_5 * ge2_4
    w751 = w749 + w750
    w752 = ge1_8 * ge2_5
    e2_5 = w751 + w752
    w753 = ge1_2 * ge2_6
    w754 = ge1_5 * ge2_7
    w755 = w753 + w754
    w756 = ge1_8 * ge2_8
    e2_8 = w755 + w756
    w760 = ge1_1 * ge2_0
    w761 = ge1_4 * ge2_1
    w762 = w760 + w761
    w763 = ge1_7 * ge2_2
    e2_1 = w762 + w763
    w764 = ge1_1 * ge2_3
    w765 = ge1_4 * ge2_4
    w766 = w764 + w765
    w767 = ge1_7 * ge2_5
    e2_4 = w766 + w767
    w768 = ge1_1 * ge2_6
    w769 = ge1_4 * ge2_7
    w770 = w768 + w769
    w771 = ge1_7 * ge2_8
    e2_7 = w770 + w771
    # the equations of xi3, n3: Newton's method in xi3_0, xi3_1, xi3_2
    previous_3 = 0.0
    make_3 = memory.inverses[2] is None
    for sweep in range(1, 101):
        xE3_3_1 = xi3_1 * w1
        xE3_3_0 = xi3_0 * w1
        xE3_3_2 = xi3_2 * w1
        w719 = xE3_3_2 * xE3_3_2
        w720 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + w719
        c1_5, c2_9 = _stumpff_12(w720)
        w722 = xE3_3_1 * c2_9
        w723 = xE3_3_1 * w722
        w724 = xE3_3_2 * c2_9
        w725 = xE3_3_2 * w724
        gE3_3_0 = 1.0 - (w723 + w725)
        w734 = xE3_3_0 * c2_9
        w735 = xE3_3_1 * w734
        w737 = xE3_3_2 * c1_5
        gE3_3_1 = w735 - w737
        w743 = xE3_3_1 * c1_5
        w744 = xE3_3_2 * w734
        gE3_3_2 = w743 + w744
        E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2
        E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8
        gE3_3_3 = w735 + w737
        w757 = xE3_3_0 * w734
        gE3_3_4 = 1.0 - (w725 + w757)
        w758 = xE3_3_2 * w722
        w759 = xE3_3_0 * c1_5
        gE3_3_5 = w758 - w759
        E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5
        gE3_3_6 = w744 - w743
        gE3_3_7 = w758 + w759
        gE3_3_8 = 1.0 - (w723 + w757)
        E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8
        a_5_2 = xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8
        p_3_2 = 0.01 * a_5_2
        E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7
        E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7
        E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7
        a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7
        Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7
        Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8
        w772 = 1.5 - 2.0 * Q3_8
        w773 = 1.0 / sqrt(1.01 + 1.5 * (w772 - 0.2 * Q3_7))
        w774 = w773 * w773
        w775 = 0.5 * w773
        w776 = w774 * w775
        w777 = 1.0 / sqrt(1.01 + 1.5 * (w772 + 0.2 * Q3_7))
        w778 = w777 * w777
        w779 = 0.5 * w777
        w780 = w778 * w779
        w781 = -1.0 - 2.0 * (1.5 * w776 - 1.5 * w780)
        w782 = -0.3 * w776 - 0.3 * w780
        Nr3_0 = Q3_7 * w781 - Q3_8 * w782 + 99.0 * a_5_1 * p_3_2
        s_m3_5_0 = s_m2_4_0 + w29 * Nr3_0
        E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5
        E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8
        a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6
        Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6
        Nr3_1 = -100.0 * a_5_0 * p_3_2 - w781 * Q3_6
        s_m3_5_1 = s_m2_4_1 + w29 * Nr3_1
        w783 = 0.01 * a_5_0
        Nr3_2 = a_5_1 * w783 + w782 * Q3_6
        s_m3_5_2 = s_m2_4_2 + w29 * Nr3_2
        m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2
        y3_0 = xi3_0 * w30
        y3_1 = xi3_1 * w30
        y3_2 = xi3_2 * w30
        w784 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2
        c2_10, c3_7 = _stumpff_23(w784)
        m3_5_2_2 = e2_6 * s_m3_5_0 + e2_7 * s_m3_5_1 + e2_8 * s_m3_5_2
        w786 = y3_1 * m3_5_2_2
        m3_5_2_1 = e2_3 * s_m3_5_0 + e2_4 * s_m3_5_1 + e2_5 * s_m3_5_2
        w787 = y3_2 * m3_5_2_1
        w788 = w786 - w787
        w790 = y3_0 * m3_5_2_1
        w791 = m3_5_2_0 * y3_1
        w792 = w790 - w791
        w793 = m3_5_2_0 * y3_2
        w794 = y3_0 * m3_5_2_2
        w795 = w793 - w794
        w796 = y3_1 * w792 - y3_2 * w795
        m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2
        y3_2_0 = xi3_0 * w47
        y3_2_1 = xi3_1 * w47
        y3_2_2 = xi3_2 * w47
        w797 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2
        c2_11, c3_8 = _stumpff_23(w797)
        m3_4_2 = e2_6 * Nr3_0 + e2_7 * Nr3_1 + e2_8 * Nr3_2
        m3_4_1 = e2_3 * Nr3_0 + e2_4 * Nr3_1 + e2_5 * Nr3_2
        w799 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1
        w801 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1
        w802 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2
        w803 = y3_2_1 * w801 - y3_2_2 * w802
        M3_0 = (
            m3_5_2_0
            - w788 * c2_10
            + w796 * c3_7
            + w47 * (m3_4_0 - w799 * c2_11 + w803 * c3_8)
        )
        w804 = y3_2 * w788 - y3_0 * w792
        w805 = y3_2_2 * w799 - y3_2_0 * w801
        M3_1 = (
            m3_5_2_1
            - w795 * c2_10
            + w804 * c3_7
            + w47 * (m3_4_1 - w802 * c2_11 + w805 * c3_8)
        )
        w806 = y3_0 * w795 - y3_1 * w788
        w807 = y3_2_0 * w802 - y3_2_1 * w799
        M3_2 = (
            m3_5_2_2
            - w792 * c2_10
            + w806 * c3_7
            + w47 * (m3_4_2 - w801 * c2_11 + w807 * c3_8)
        )
        Wf3_0 = 0.9900990099009901 * (E3_3_0 * M3_0 + E3_3_3 * M3_1 + E3_3_6 * M3_2)
        Pf3_1 = E3_3_1 * M3_0 + E3_3_4 * M3_1 + E3_3_7 * M3_2
        Wf3_2 = 100.0 * (E3_3_2 * M3_0 + E3_3_5 * M3_1 + E3_3_8 * M3_2)
        next_xi3_0 = E3_3_0 * Wf3_0 + E3_3_1 * Pf3_1 + E3_3_2 * Wf3_2
        next_xi3_1 = E3_3_3 * Wf3_0 + E3_3_4 * Pf3_1 + E3_3_5 * Wf3_2
        next_xi3_2 = E3_3_6 * Wf3_0 + E3_3_7 * Pf3_1 + E3_3_8 * Wf3_2
        residual_xi3_0 = next_xi3_0 - xi3_0
        residual_xi3_1 = next_xi3_1 - xi3_1
        residual_xi3_2 = next_xi3_2 - xi3_2
        total = residual_xi3_0 + residual_xi3_1 + residual_xi3_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi3, n3", 2, sweep, statistics)
        if make_3:
            w808 = w1 * c2_9
            w809 = xE3_3_2 * e2_6 + xE3_3_1 * e2_3
            w810 = w808 * w809
            w811 = xE3_3_2 * e2_8 + xE3_3_1 * e2_5
            w812 = w808 * w811
            w813 = xE3_3_2 * e2_7 + xE3_3_1 * e2_4
            w814 = w808 * w813
            w815 = 100.0 * E3_3_8
            w816 = w47 * c3_8
            w817 = w802 * w816 * w47 + w795 * c3_7 * w30
            w818 = slope3(w784)
            w819 = slope2(w784)
            w820 = w806 * w818 + w819 * (w791 - w790)
            w821 = 2.0 * y3_0 * w30
            w822 = slope3(w797)
            w823 = slope2(w797)
            w824 = w47 * w807 * w822 - w47 * w801 * w823
            w825 = 2.0 * y3_2_0 * w47
            w826 = w30 * m3_5_2_1
            w827 = w826 * c2_10
            w828 = y3_0 * c3_7
            w829 = w30 * m3_5_2_2
            w830 = w47 * c2_11
            w831 = w47 * m3_4_1
            w832 = w830 * w831
            w833 = y3_2_0 * w816
            w834 = w47 * m3_4_2
            w835 = (
                w817
                + w820 * w821
                + w824 * w825
                - w827
                - w828 * w829
                - w832
                - w833 * w834
            )
            w836 = 100.0 * E3_3_5
            w837 = w804 * w818 + w819 * (w794 - w793)
            w838 = w801 * w816 * w47 + w792 * c3_7 * w30
            w839 = w47 * w805 * w822 - w47 * w802 * w823
            w840 = w829 * c2_10
            w841 = w830 * w834
            w842 = (
                w821 * w837
                - w838
                + w825 * w839
                - w826 * w828
                + w840
                - w831 * w833
                + w841
            )
            w843 = 100.0 * E3_3_2
            w844 = w796 * w818 + w819 * (w787 - w786)
            w845 = w47 * w803 * w822 - w47 * w799 * w823
            w846 = y3_1 * c3_7
            w847 = w826 * w846
            w848 = y3_2 * c3_7
            w849 = w829 * w848
            w850 = y3_2_1 * w816
            w851 = w831 * w850
            w852 = y3_2_2 * w816
            w853 = w834 * w852
            w854 = w821 * w844 + w825 * w845 + w847 + w849 + w851 + w853
            w855 = 100.0 * M3_0
            w856 = w1 * w734
            w857 = w856 + xE3_3_0 * w808
            w858 = 100.0 * M3_2
            w859 = e2_8 * w858
            w860 = 100.0 * M3_1
            w861 = e2_5 * w860
            w862 = (
                w815 * w835
                + w836 * w842
                + w843 * w854
                + w812 * w855
                - w857 * w859
                - w857 * w861
            )
            w863 = w29 * e2_8
            w864 = w29 * e2_5
            w865 = w29 * e2_2
            w866 = y3_0 * w864 - y3_1 * w865
            w867 = y3_2 * w865 - y3_0 * w863
            w868 = y3_1 * w863 - y3_2 * w864
            w869 = e2_5 * y3_2_0 - e2_2 * y3_2_1
            w870 = (
                w863
                + w47 * e2_8
                - w866 * c2_10
                + w828 * w867
                - w846 * w868
                - w830 * w869
            )
            w871 = e2_2 * y3_2_2 - e2_8 * y3_2_0
            w872 = e2_8 * y3_2_1 - e2_5 * y3_2_2
            w873 = w870 + w833 * w871 - w850 * w872
            w874 = (
                w864
                + w47 * e2_5
                - w828 * w866
                - w867 * c2_10
                + w848 * w868
                - w833 * w869
            )
            w875 = w874 - w830 * w871 + w852 * w872
            w876 = (
                w865
                + w47 * e2_2
                + w846 * w866
                - w848 * w867
                - w868 * c2_10
                + w850 * w869
            )
            w877 = w876 - w852 * w871 - w830 * w872
            w878 = w815 * w873 + w836 * w875 + w843 * w877
            w879 = 0.01 * a_5_1
            w880 = g20 * w782 + xi3_0 * w879
            w881 = w778 * (0.5 * w778 + 2.0 * w777 * w779) * w779
            w882 = 0.45 * w881
            w883 = Q3_6 * w882
            w884 = w774 * (0.5 * w774 + 2.0 * w773 * w775) * w775
            w885 = 0.45 * w884
            w886 = Q3_6 * w885
            w887 = -2.0 * w883 - 2.0 * w886
            w888 = g20 * w887
            w889 = 0.2 * w883 - 0.2 * w886
            w890 = g20 * w889 + xi3_0 * w783
            w891 = g22 * w782 + xi3_2 * w879
            w892 = g22 * w887
            w893 = g22 * w889 + xi3_2 * w783
            w894 = e2_6 * w891 + e2_8 * w892 + e2_7 * w893
            w895 = (
                E3_3_1 * w783
                + E3_3_0 * w879
                + w810 * w880
                + w812 * w888
                + w814 * w890
                - w857 * w894
            )
            w896 = g21 * w782 + xi3_1 * w879
            w897 = g21 * w887
            w898 = g21 * w889 + xi3_1 * w783
            w899 = e2_3 * w896 + e2_5 * w897 + e2_4 * w898
            w900 = w895 - w857 * w899
            w901 = w29 * e2_7
            w902 = w29 * e2_4
            w903 = w29 * e2_1
            w904 = y3_0 * w902 - y3_1 * w903
            w905 = y3_2 * w903 - y3_0 * w901
            w906 = y3_1 * w901 - y3_2 * w902
            w907 = e2_4 * y3_2_0 - e2_1 * y3_2_1
            w908 = (
                w901
                + w47 * e2_7
                - w904 * c2_10
                + w828 * w905
                - w846 * w906
                - w830 * w907
            )
            w909 = e2_1 * y3_2_2 - e2_7 * y3_2_0
            w910 = e2_7 * y3_2_1 - e2_4 * y3_2_2
            w911 = w908 + w833 * w909 - w850 * w910
            w912 = (
                w902
                + w47 * e2_4
                - w828 * w904
                - w905 * c2_10
                + w848 * w906
                - w833 * w907
            )
            w913 = w912 - w830 * w909 + w852 * w910
            w914 = (
                w903
                + w47 * e2_1
                + w846 * w904
                - w848 * w905
                - w906 * c2_10
                + w850 * w907
            )
            w915 = w914 - w852 * w909 - w830 * w910
            w916 = w815 * w911 + w836 * w913 + w843 * w915
            w917 = 2.0 * Q3_6
            w918 = 2.25 * w881
            w919 = w917 * w918
            w920 = -2.25 * w884
            w921 = w917 * w920
            w922 = -2.0 * w919 - 2.0 * w921
            w923 = g20 * w922 - xi3_0 * a_5_0
            w924 = g20 * w781 + xi3_0 * a_5_2
            w925 = 0.2 * w919 - 0.2 * w921
            w926 = g20 * w925
            w927 = g22 * w922 - xi3_2 * a_5_0
            w928 = g22 * w781 + xi3_2 * a_5_2
            w929 = g22 * w925
            w930 = e2_8 * w927 - e2_6 * w928 + e2_7 * w929
            w931 = (
                w812 * w923
                - (E3_3_2 * a_5_0 + E3_3_0 * a_5_2 + w810 * w924)
                + w814 * w926
                - w857 * w930
            )
            w932 = g21 * w922 - xi3_1 * a_5_0
            w933 = g21 * w781 + xi3_1 * a_5_2
            w934 = g21 * w925
            w935 = e2_5 * w932 - e2_3 * w933 + e2_4 * w934
            w936 = w931 - w857 * w935
            w937 = w1 * c1_5
            w938 = e2_3 * w891 + e2_5 * w892 + e2_4 * w893
            w939 = e2_5 * w927 - e2_3 * w928 + e2_4 * w929
            w940 = e2_5 * w858 + w878 * w938 + w916 * w939
            w941 = xE3_3_2 * w808
            w942 = e2_0 * w891 + e2_2 * w892 + e2_1 * w893
            w943 = e2_2 * w927 - e2_0 * w928 + e2_1 * w929
            w944 = e2_2 * w858 + w878 * w942 + w916 * w943
            w945 = w29 * e2_6
            w946 = w29 * e2_3
            w947 = w29 * e2_0
            w948 = y3_0 * w946 - y3_1 * w947
            w949 = y3_2 * w947 - y3_0 * w945
            w950 = y3_1 * w945 - y3_2 * w946
            w951 = e2_3 * y3_2_0 - e2_0 * y3_2_1
            w952 = (
                w945
                + w47 * e2_6
                - w948 * c2_10
                + w828 * w949
                - w846 * w950
                - w830 * w951
            )
            w953 = e2_0 * y3_2_2 - e2_6 * y3_2_0
            w954 = e2_6 * y3_2_1 - e2_3 * y3_2_2
            w955 = w952 + w833 * w953 - w850 * w954
            w956 = (
                w946
                + w47 * e2_3
                - w828 * w948
                - w949 * c2_10
                + w848 * w950
                - w833 * w951
            )
            w957 = w956 - w830 * w953 + w852 * w954
            w958 = (
                w947
                + w47 * e2_0
                + w846 * w948
                - w848 * w949
                - w950 * c2_10
                + w850 * w951
            )
            w959 = w958 - w852 * w953 - w830 * w954
            w960 = w815 * w955 + w836 * w957 + w843 * w959
            w961 = 0.99 * a_5_1
            w962 = 0.99 * a_5_2
            w963 = -2.0 * Q3_7
            w964 = w918 * w963 - Q3_8 * w882
            w965 = w920 * w963 - Q3_8 * w885
            w966 = -2.0 * w964 - w782 - 2.0 * w965
            w967 = g20 * w966 + xi3_0 * w961
            w968 = w781 + 0.2 * w964 - 0.2 * w965
            w969 = g20 * w968 + xi3_0 * w962
            w970 = g22 * w966 + xi3_2 * w961
            w971 = g22 * w968 + xi3_2 * w962
            w972 = e2_8 * w970 + e2_7 * w971
            w973 = g21 * w966 + xi3_1 * w961
            w974 = g21 * w968 + xi3_1 * w962
            w975 = e2_5 * w973 + e2_4 * w974
            w976 = (
                E3_3_2 * w961
                + E3_3_1 * w962
                + w812 * w967
                + w814 * w969
                - w857 * w972
                - w857 * w975
            )
            w977 = e2_5 * w970 + e2_4 * w971
            w978 = e2_2 * w970 + e2_1 * w971
            w979 = w976 + w937 * w977 + w941 * w978
            w980 = (
                w862
                + w878 * w900
                + w916 * w936
                + w937 * w940
                + w941 * w944
                + w960 * w979
            )
            w981 = e2_6 * w896 + e2_8 * w897 + e2_7 * w898
            w982 = e2_8 * w932 - e2_6 * w933 + e2_7 * w934
            w983 = e2_8 * w973 + e2_7 * w974
            w984 = e2_8 * w860 + w878 * w981 + w916 * w982 + w960 * w983
            w985 = w980 - w937 * w984
            w986 = 0.9900990099009901 * M3_0
            w987 = 0.9900990099009901 * E3_3_6
            w988 = 0.9900990099009901 * E3_3_3
            w989 = 0.9900990099009901 * E3_3_0
            w990 = 0.9900990099009901 * M3_2
            w991 = e2_6 * w990
            w992 = 0.9900990099009901 * M3_1
            w993 = e2_3 * w992
            w994 = (
                w810 * w986
                + w835 * w987
                + w842 * w988
                + w854 * w989
                - w857 * w991
                - w857 * w993
            )
            w995 = w873 * w987 + w875 * w988 + w877 * w989
            w996 = w911 * w987 + w913 * w988 + w915 * w989
            w997 = e2_3 * w990 + w938 * w995 + w939 * w996
            w998 = e2_0 * w990 + w942 * w995 + w943 * w996
            w999 = w955 * w987 + w957 * w988 + w959 * w989
            w1000 = (
                w994
                + w900 * w995
                + w936 * w996
                + w937 * w997
                + w941 * w998
                + w979 * w999
            )
            w1001 = e2_6 * w992 + w981 * w995 + w982 * w996 + w983 * w999
            w1002 = w1000 - w937 * w1001
            w1003 = e2_7 * M3_2
            w1004 = e2_4 * M3_1
            w1005 = (
                E3_3_7 * w835
                + E3_3_4 * w842
                + E3_3_1 * w854
                + M3_0 * w814
                - w857 * w1003
                - w857 * w1004
            )
            w1006 = E3_3_7 * w873 + E3_3_4 * w875 + E3_3_1 * w877
            w1007 = E3_3_7 * w911 + E3_3_4 * w913 + E3_3_1 * w915
            w1008 = e2_4 * M3_2 + w938 * w1006 + w939 * w1007
            w1009 = e2_1 * M3_2 + w942 * w1006 + w943 * w1007
            w1010 = E3_3_7 * w955 + E3_3_4 * w957 + E3_3_1 * w959
            w1011 = (
                w1005
                + w900 * w1006
                + w936 * w1007
                + w937 * w1008
                + w941 * w1009
                + w979 * w1010
            )
            w1012 = e2_7 * M3_1 + w981 * w1006 + w982 * w1007 + w983 * w1010
            w1013 = w1011 - w937 * w1012
            w1014 = (
                Wf3_0 * w810
                + Wf3_2 * w812
                + Pf3_1 * w814
                + E3_3_2 * w985
                + E3_3_0 * w1002
                + E3_3_1 * w1013
            )
            w1015 = xE3_3_1 * w808
            w1016 = e2_0 * w896 + e2_2 * w897 + e2_1 * w898
            w1017 = e2_2 * w932 - e2_0 * w933 + e2_1 * w934
            w1018 = e2_2 * w973 + e2_1 * w974
            w1019 = e2_2 * w860 + w878 * w1016 + w916 * w1017 + w960 * w1018
            w1020 = e2_0 * w992 + w995 * w1016 + w996 * w1017 + w999 * w1018
            w1021 = e2_1 * M3_1 + w1006 * w1016 + w1007 * w1017 + w1010 * w1018
            w1022 = E3_3_2 * w1019 + E3_3_0 * w1020 + E3_3_1 * w1021
            w1023 = 2.0 * xE3_3_0 * w1
            c3_9 = _stumpff_3(w720)
            w1024 = 0.5 * (c3_9 - c2_9)
            w1025 = xE3_3_1 * w1024
            w1026 = slope2(w720)
            w1027 = w719 * w1026
            w1028 = xE3_3_1 * w1026
            w1029 = xE3_3_1 * w1028
            w1030 = w1027 + w1029
            w1031 = xE3_3_2 * w1024
            w1032 = xE3_3_0 * w1026
            w1033 = e2_6 * w1025 - e2_0 * w1030 - e2_3 * w1031 + w809 * w1032
            w1034 = e2_8 * w1025 - e2_2 * w1030 - e2_5 * w1031 + w811 * w1032
            w1035 = e2_7 * w1025 - e2_1 * w1030 - e2_4 * w1031 + w813 * w1032
            w1036 = xE3_3_0 * w1032
            w1037 = w1029 + w1036
            w1038 = w1027 + w1036
            w1039 = (
                w880 * w1033 + w888 * w1034 + w890 * w1035 - w894 * w1037 - w899 * w1038
            )
            w1040 = (
                w923 * w1034 - w924 * w1033 + w926 * w1035 - w930 * w1037 - w935 * w1038
            )
            w1041 = xE3_3_0 * w1024
            w1042 = xE3_3_2 * w1028
            w1043 = w1041 + w1042
            w1044 = (
                w855 * w1034
                - w859 * w1037
                - w861 * w1038
                + w878 * w1039
                + w916 * w1040
                + w940 * w1043
            )
            w1045 = xE3_3_2 * w1032 - w1025
            w1046 = (
                w967 * w1034
                + w969 * w1035
                - w972 * w1037
                - w975 * w1038
                + w977 * w1043
                + w978 * w1045
            )
            w1047 = w1042 - w1041
            w1048 = w1044 + w944 * w1045 + w960 * w1046 + w984 * w1047
            w1049 = (
                w986 * w1033
                - w991 * w1037
                - w993 * w1038
                + w995 * w1039
                + w996 * w1040
                + w997 * w1043
            )
            w1050 = w1049 + w998 * w1045 + w999 * w1046 + w1001 * w1047
            w1051 = (
                M3_0 * w1035
                - w1003 * w1037
                - w1004 * w1038
                + w1006 * w1039
                + w1007 * w1040
                + w1008 * w1043
            )
            w1052 = w1051 + w1009 * w1045 + w1010 * w1046 + w1012 * w1047
            w1053 = (
                Wf3_0 * w1033
                + Wf3_2 * w1034
                + Pf3_1 * w1035
                + E3_3_2 * w1048
                + E3_3_0 * w1050
                + E3_3_1 * w1052
            )
            w1054 = w1031 + xE3_3_1 * w1032
            w1055 = w1053 + w1022 * w1054
            w1056 = 2.0 * w722
            w1057 = e2_6 * w937 - e2_0 * w1056 * w1 + e2_3 * w856
            w1058 = e2_8 * w937 - e2_2 * w1056 * w1 + e2_5 * w856
            w1059 = e2_7 * w937 - e2_1 * w1056 * w1 + e2_4 * w856
            w1060 = 2.0 * y3_1 * w30
            w1061 = w799 * w816 * w47 + w788 * c3_7 * w30
            w1062 = 2.0 * y3_2_1 * w47
            w1063 = w30 * m3_5_2_0
            w1064 = w1063 * c2_10
            w1065 = w47 * m3_4_0
            w1066 = w830 * w1065
            w1067 = (
                w820 * w1060
                - w1061
                + w824 * w1062
                + w1064
                - w829 * w846
                + w1066
                - w834 * w850
            )
            w1068 = w828 * w1063
            w1069 = w833 * w1065
            w1070 = w837 * w1060 + w839 * w1062 + w1068 + w849 + w1069 + w853
            w1071 = (
                w838
                + w844 * w1060
                + w845 * w1062
                - w846 * w1063
                - w840
                - w850 * w1065
                - w841
            )
            w1072 = w1 * w1056
            w1073 = (
                E3_3_4 * w783
                + E3_3_3 * w879
                + w880 * w1057
                + w888 * w1058
                + w890 * w1059
                - w894 * w1072
            )
            w1074 = (
                w815 * w1067
                + w836 * w1070
                + w843 * w1071
                + w855 * w1058
                - w859 * w1072
                + w878 * w1073
            )
            w1075 = (
                w923 * w1058
                - (E3_3_5 * a_5_0 + a_5_2 * E3_3_3 + w924 * w1057)
                + w926 * w1059
                - w930 * w1072
            )
            w1076 = w1 * w724
            w1077 = (
                E3_3_5 * w961
                + E3_3_4 * w962
                + w967 * w1058
                + w969 * w1059
                - w972 * w1072
                + w977 * w1076
            )
            w1078 = w1077 - w937 * w978
            w1079 = (
                w1074
                + w916 * w1075
                + w940 * w1076
                - w937 * w944
                + w960 * w1078
                + w984 * w1076
            )
            w1080 = (
                w986 * w1057
                + w987 * w1067
                + w988 * w1070
                + w989 * w1071
                - w991 * w1072
                + w995 * w1073
            )
            w1081 = (
                w1080
                + w996 * w1075
                + w997 * w1076
                - w937 * w998
                + w999 * w1078
                + w1001 * w1076
            )
            w1082 = (
                E3_3_7 * w1067
                + E3_3_4 * w1070
                + E3_3_1 * w1071
                + M3_0 * w1059
                - w1003 * w1072
                + w1006 * w1073
            )
            w1083 = (
                w1082
                + w1007 * w1075
                + w1008 * w1076
                - w937 * w1009
                + w1010 * w1078
                + w1012 * w1076
            )
            w1084 = (
                Wf3_0 * w1057
                + Wf3_2 * w1058
                + Pf3_1 * w1059
                + E3_3_2 * w1079
                + E3_3_0 * w1081
                + E3_3_1 * w1083
            )
            w1085 = 2.0 * xE3_3_1 * w1
            w1086 = 2.0 * w724
            w1087 = e2_6 * w856 - e2_0 * w1086 * w1 - e2_3 * w937
            w1088 = e2_8 * w856 - e2_2 * w1086 * w1 - e2_5 * w937
            w1089 = e2_7 * w856 - e2_1 * w1086 * w1 - e2_4 * w937
            w1090 = 2.0 * y3_2 * w30
            w1091 = 2.0 * y3_2_2 * w47
            w1092 = w820 * w1090 + w824 * w1091 + w1068 + w847 + w1069 + w851
            w1093 = (
                w1061
                + w837 * w1090
                + w839 * w1091
                - w1064
                - w826 * w848
                - w1066
                - w831 * w852
            )
            w1094 = (
                w844 * w1090
                - w817
                + w845 * w1091
                - w848 * w1063
                + w827
                - w852 * w1065
                + w832
            )
            w1095 = w1 * w1086
            w1096 = (
                E3_3_7 * w783
                + E3_3_6 * w879
                + w880 * w1087
                + w888 * w1088
                + w890 * w1089
                - w899 * w1095
            )
            w1097 = (
                w815 * w1092
                + w836 * w1093
                + w843 * w1094
                + w855 * w1088
                - w861 * w1095
                + w878 * w1096
            )
            w1098 = (
                w923 * w1088
                - (E3_3_8 * a_5_0 + a_5_2 * E3_3_6 + w924 * w1087)
                + w926 * w1089
                - w935 * w1095
            )
            w1099 = w1 * w722
            w1100 = (
                E3_3_8 * w961
                + E3_3_7 * w962
                + w967 * w1088
                + w969 * w1089
                - w975 * w1095
                + w977 * w1099
            )
            w1101 = w1100 + w856 * w978
            w1102 = (
                w1097
                + w916 * w1098
                + w940 * w1099
                + w856 * w944
                + w960 * w1101
                + w984 * w1099
            )
            w1103 = (
                w986 * w1087
                + w987 * w1092
                + w988 * w1093
                + w989 * w1094
                - w993 * w1095
                + w995 * w1096
            )
            w1104 = (
                w1103
                + w996 * w1098
                + w997 * w1099
                + w856 * w998
                + w999 * w1101
                + w1001 * w1099
            )
            w1105 = (
                E3_3_7 * w1092
                + E3_3_4 * w1093
                + E3_3_1 * w1094
                + M3_0 * w1089
                - w1004 * w1095
                + w1006 * w1096
            )
            w1106 = (
                w1105
                + w1007 * w1098
                + w1008 * w1099
                + w856 * w1009
                + w1010 * w1101
                + w1012 * w1099
            )
            w1107 = (
                Wf3_0 * w1087
                + Wf3_2 * w1088
                + Pf3_1 * w1089
                + E3_3_2 * w1102
                + E3_3_0 * w1104
                + E3_3_1 * w1106
            )
            w1108 = 2.0 * xE3_3_2 * w1
            w1109 = e2_3 * Wf3_0 + e2_5 * Wf3_2 + e2_4 * Pf3_1
            w1110 = e2_6 * Wf3_0 + e2_8 * Wf3_2 + e2_7 * Pf3_1
            w1111 = e2_0 * Wf3_0 + e2_2 * Wf3_2 + e2_1 * Pf3_1
            w1112 = w1111 + E3_3_5 * w1019 + E3_3_3 * w1020 + E3_3_4 * w1021
            w1113 = (
                E3_3_5 * w985
                - (w857 * w1109 + w937 * w1110)
                + E3_3_3 * w1002
                + E3_3_4 * w1013
                + w1015 * w1112
            )
            w1114 = (
                w1047 * w1110
                - w1038 * w1109
                + E3_3_5 * w1048
                + E3_3_3 * w1050
                + E3_3_4 * w1052
                + w1054 * w1112
            )
            w1115 = (
                w1076 * w1110
                + E3_3_5 * w1079
                + E3_3_3 * w1081
                + E3_3_4 * w1083
                + w856 * w1112
                + w1085 * w1114
            )
            w1116 = (
                w1099 * w1110
                - w1095 * w1109
                + E3_3_5 * w1102
                + E3_3_3 * w1104
                + E3_3_4 * w1106
                + w937 * w1112
            )
            w1117 = (
                w937 * w1109
                - w857 * w1110
                + w941 * w1111
                + E3_3_8 * w985
                + E3_3_6 * w1002
                + E3_3_7 * w1013
            )
            w1118 = E3_3_8 * w1019 + E3_3_6 * w1020 + E3_3_7 * w1021
            w1119 = (
                w1043 * w1109
                - w1037 * w1110
                + w1045 * w1111
                + E3_3_8 * w1048
                + E3_3_6 * w1050
                + E3_3_7 * w1052
            )
            w1120 = w1119 + w1054 * w1118
            w1121 = (
                w1076 * w1109
                - w1072 * w1110
                - w937 * w1111
                + E3_3_8 * w1079
                + E3_3_6 * w1081
                + E3_3_7 * w1083
            )
            w1122 = (
                w1099 * w1109
                + w856 * w1111
                + E3_3_8 * w1102
                + E3_3_6 * w1104
                + E3_3_7 * w1106
                + w937 * w1118
            )
            row_3_1 = [
                1.0 - (w1014 + w1015 * w1022 + w1023 * w1055),
                -(w1084 + w856 * w1022 + w1055 * w1085),
                -(w1107 + w937 * w1022 + w1055 * w1108),
            ]
            row_3_2 = [
                -(w1113 + w1023 * w1114),
                1.0 - w1115,
                -(w1116 + w1108 * w1114),
            ]
            row_3_3 = [
                -(w1117 + w1015 * w1118 + w1023 * w1120),
                -(w1121 + w856 * w1118 + w1085 * w1120),
                1.0 - (w1122 + w1108 * w1120),
            ]
            memory.inverses[2] = invert([row_3_1, row_3_2, row_3_3])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[2] is None:
                raise _failed(NOT_CONVERGED, "the equations of xi3, n3", 2, sweep, statistics)
        row_3_1, row_3_2, row_3_3 = memory.inverses[2]
        change_xi3_0 = (
            row_3_1[0] * residual_xi3_0
            + row_3_1[1] * residual_xi3_1
            + row_3_1[2] * residual_xi3_2
        )
        change_xi3_1 = (
            row_3_2[0] * residual_xi3_0
            + row_3_2[1] * residual_xi3_1
            + row_3_2[2] * residual_xi3_2
        )
        change_xi3_2 = (
            row_3_3[0] * residual_xi3_0
            + row_3_3[1] * residual_xi3_1
            + row_3_3[2] * residual_xi3_2
        )
        xi3_0 += change_xi3_0
        xi3_1 += change_xi3_1
        xi3_2 += change_xi3_2
        change = max(abs(change_xi3_0), abs(change_xi3_1), abs(change_xi3_2))
        scale = max(1.0, abs(xi3_0), abs(xi3_1), abs(xi3_2))
        still = 0.0 < previous_3 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_3
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        make_3 = 0.0 < 0.0625 * previous_3 < change
        previous_3 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi3, n3", 2, sweep, statistics)
    if statistics is not None:
        statistics.count(2, sweep)
    xe3_1 = xi3_1 * w29
    xe3_0 = xi3_0 * w29
    xe3_2 = xi3_2 * w29
    w1123 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2
    c1_6, c2_12 = _stumpff_12(w1123)
    w1125 = xe3_1 * c2_12
    w1126 = xe3_1 * w1125
    w1127 = xe3_2 * c2_12 * xe3_2
    ge3_0 = 1.0 - (w1126 + w1127)
    w1128 = xe3_0 * c2_12
    w1129 = xe3_1 * w1128
    w1131 = xe3_2 * c1_6
    ge3_1 = w1129 - w1131
    w1132 = xe3_1 * c1_6
    w1133 = xe3_2 * w1128
    ge3_2 = w1132 + w1133
    e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2
    ge3_3 = w1129 + w1131
    w1134 = xe3_0 * w1128
    ge3_4 = 1.0 - (w1127 + w1134)
    w1135 = xe3_2 * w1125
    w1136 = xe3_0 * c1_6
    ge3_5 = w1135 - w1136
    e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5
    ge3_6 = w1133 - w1132
    ge3_7 = w1135 + w1136
    ge3_8 = 1.0 - (w1126 + w1134)
    e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8
    q1_0 = g00 * e3_0 + g01 * e3_3 + g02 * e3_6
    e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2
    e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5
    e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8
    q1_1 = g00 * e3_1 + g01 * e3_4 + g02 * e3_7
    e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2
    e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5
    e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8
    q1_2 = g00 * e3_2 + g01 * e3_5 + g02 * e3_8
    q1_3 = g10 * e3_0 + g11 * e3_3 + g12 * e3_6
    q1_4 = g10 * e3_1 + g11 * e3_4 + g12 * e3_7
    q1_5 = g10 * e3_2 + g11 * e3_5 + g12 * e3_8
    q1_6 = g20 * e3_0 + g21 * e3_3 + g22 * e3_6
    q1_7 = g20 * e3_1 + g21 * e3_4 + g22 * e3_7
    q1_8 = g20 * e3_2 + g21 * e3_5 + g22 * e3_8
    mubar_0 = m_0 + w29 * (Nr1_0 + Nr3_0) + w353
    mubar_1 = m_1 + w29 * (Nr1_1 + Nr3_1) + w354
    mubar_2 = m_2 + w29 * (Nr1_2 + Nr3_2) + w356
    new_mu0 = q1_0 * mubar_0 + q1_1 * mubar_1 + q1_2 * mubar_2
    new_mu1 = q1_3 * mubar_0 + q1_4 * mubar_1 + q1_5 * mubar_2
    new_mu2 = q1_6 * mubar_0 + q1_7 * mubar_1 + q1_8 * mubar_2
    found = xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2
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
