"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
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
operations: 117 add, 166 mul, 3 stumpff_12 a step
            78 add, 128 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
            114 add, 182 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi2, n2
            114 add, 182 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi3, n3
made by:    orderconds emit dipole --method vcg:triple_jump --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_triple_jump

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_triple_jump.run(state, 0.005, 100))
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
        "the equations of xi1, n1",
        "the equations of xi2, n2",
        "the equations of xi3, n3",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 3, 0, 0

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


def _stumpff_23(z):
    """Return, for z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_2(z), _stumpff_small_3(z)
    if z <= 1.0:
        return _stumpff_series_2(z), _stumpff_series_3(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return 0.5 * (ratio * ratio), c3


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
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
    w1 = 0.6756035959798288 * h
    w23 = 1.3512071919596575 * h
    w24 = -1.3512071919596575 * h
    w31 = -0.6756035959798288 * h
    # the equations of xi1, n1: fixed point in xi1_0, xi1_1, xi1_2
    xi1_0 = Wxi0_0
    xi1_1 = m_1
    xi1_2 = Wxi0_2
    previous_1 = 0.0
    for sweep in range(1, 101):
        xE1_1_1 = xi1_1 * w1
        xE1_1_0 = xi1_0 * w1
        xE1_1_2 = xi1_2 * w1
        w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2
        c1_1, c2_1 = _stumpff_12(w2)
        w4 = xE1_1_1 * c2_1
        w5 = xE1_1_1 * w4
        w6 = xE1_1_2 * c2_1 * xE1_1_2
        gE1_1_0 = 1.0 - (w5 + w6)
        p_2 = 0.01 * xi1_2
        w7 = xE1_1_0 * c2_1
        w8 = xE1_1_1 * w7
        w10 = xE1_1_2 * c1_1
        gE1_1_1 = w8 - w10
        w11 = xE1_1_0 * w7
        gE1_1_4 = 1.0 - (w6 + w11)
        w12 = xE1_1_0 * c1_1
        w13 = xE1_1_2 * w4
        gE1_1_7 = w12 + w13
        Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7
        w14 = xE1_1_1 * c1_1
        w15 = xE1_1_2 * w7
        gE1_1_2 = w14 + w15
        gE1_1_5 = w13 - w12
        gE1_1_8 = 1.0 - (w5 + w11)
        Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8
        w16 = 1.5 - 2.0 * Q1_8
        w17 = 1.0 / sqrt(1.01 + 1.5 * (w16 - 0.2 * Q1_7))
        w18 = w17 * w17 * (0.5 * w17)
        w19 = 1.0 / sqrt(1.01 + 1.5 * (w16 + 0.2 * Q1_7))
        w20 = w19 * w19 * (0.5 * w19)
        w21 = -1.0 - 2.0 * (1.5 * w18 - 1.5 * w20)
        w22 = -0.3 * w18 - 0.3 * w20
        Nr1_0 = Q1_7 * w21 - Q1_8 * w22 + 99.0 * xi1_1 * p_2
        s_mu_0 = m_0 + Nr1_0 * w23
        y1_0 = xi1_0 * w24
        y1_1 = xi1_1 * w24
        y1_2 = xi1_2 * w24
        w25 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2
        c2_2, c3_1 = _stumpff_23(w25)
        gE1_1_3 = w8 + w10
        gE1_1_6 = w15 - w14
        Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6
        Nr1_2 = 0.01 * xi1_0 * xi1_1 + w22 * Q1_6
        s_mu_2 = m_2 + w23 * Nr1_2
        Nr1_1 = -100.0 * xi1_0 * p_2 - w21 * Q1_6
        s_mu_1 = m_1 + w23 * Nr1_1
        w27 = y1_1 * s_mu_2 - y1_2 * s_mu_1
        w29 = y1_0 * s_mu_1 - s_mu_0 * y1_1
        w30 = s_mu_0 * y1_2 - y1_0 * s_mu_2
        y1_2_0 = xi1_0 * w31
        y1_2_1 = xi1_1 * w31
        y1_2_2 = xi1_2 * w31
        w32 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w32)
        w34 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2
        w36 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1
        w37 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0
        M1_0 = (
            s_mu_0
            - w27 * c2_2
            + (y1_1 * w29 - y1_2 * w30) * c3_1
            + w31 * (Nr1_0 - w34 * c2_3 + (y1_2_1 * w36 - y1_2_2 * w37) * c3_2)
        )
        M1_1 = (
            s_mu_1
            - w30 * c2_2
            + (y1_2 * w27 - y1_0 * w29) * c3_1
            + w31 * (Nr1_1 - w37 * c2_3 + (y1_2_2 * w34 - y1_2_0 * w36) * c3_2)
        )
        M1_2 = (
            s_mu_2
            - w29 * c2_2
            + (y1_0 * w30 - y1_1 * w27) * c3_1
            + w31 * (Nr1_2 - w36 * c2_3 + (y1_2_0 * w37 - y1_2_1 * w34) * c3_2)
        )
        Wf1_0 = 0.9900990099009901 * (gE1_1_0 * M1_0 + gE1_1_3 * M1_1 + gE1_1_6 * M1_2)
        Pf1_1 = gE1_1_1 * M1_0 + gE1_1_4 * M1_1 + gE1_1_7 * M1_2
        Wf1_2 = 100.0 * (gE1_1_2 * M1_0 + gE1_1_5 * M1_1 + gE1_1_8 * M1_2)
        next_xi1_0 = gE1_1_0 * Wf1_0 + gE1_1_1 * Pf1_1 + gE1_1_2 * Wf1_2
        next_xi1_1 = gE1_1_3 * Wf1_0 + gE1_1_4 * Pf1_1 + gE1_1_5 * Wf1_2
        next_xi1_2 = gE1_1_6 * Wf1_0 + gE1_1_7 * Pf1_1 + gE1_1_8 * Wf1_2
        change_xi1_0 = abs(next_xi1_0 - xi1_0)
        change_xi1_1 = abs(next_xi1_1 - xi1_1)
        change_xi1_2 = abs(next_xi1_2 - xi1_2)
        change = max(change_xi1_0, change_xi1_1, change_xi1_2)
        scale = max(1.0, abs(xi1_0), abs(xi1_1), abs(xi1_2))
        total = change_xi1_0 + change_xi1_1 + change_xi1_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_1 = change
        xi1_0 = next_xi1_0
        xi1_1 = next_xi1_1
        xi1_2 = next_xi1_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    xe1_1 = xi1_1 * w23
    xe1_0 = xi1_0 * w23
    w38 = xe1_0 * xe1_0
    w39 = xe1_1 * xe1_1
    w40 = w38 + w39
    xe1_2 = xi1_2 * w23
    w41 = xe1_2 * xe1_2
    w42 = w40 + w41
    c1_2, c2_4 = _stumpff_12(w42)
    w44 = xe1_1 * c2_4
    w45 = xe1_1 * w44
    w46 = xe1_2 * c2_4
    w47 = xe1_2 * w46
    w48 = w45 + w47
    ge1_0 = 1.0 - w48
    w49 = -0.8512071919596577 * h
    w56 = xe1_2 * c1_2
    w57 = xe1_0 * c2_4
    w58 = xe1_1 * w57
    ge1_3 = w56 + w58
    w63 = xe1_2 * w57
    w64 = xe1_1 * c1_2
    ge1_6 = w63 - w64
    ge1_2 = w63 + w64
    w67 = xe1_2 * w44
    w68 = xe1_0 * c1_2
    ge1_5 = w67 - w68
    w69 = xe1_0 * w57
    w70 = w45 + w69
    ge1_8 = 1.0 - w70
    ge1_1 = w58 - w56
    w74 = w47 + w69
    ge1_4 = 1.0 - w74
    ge1_7 = w67 + w68
    w82 = -1.7024143839193153 * h
    w86 = 1.7024143839193153 * h
    w93 = 0.8512071919596577 * h
    # the equations of xi2, n2: fixed point in xi2_0, xi2_1, xi2_2
    xi2_0 = Wxi0_0
    xi2_1 = m_1
    xi2_2 = Wxi0_2
    previous_2 = 0.0
    for sweep in range(1, 101):
        xE2_2_1 = xi2_1 * w49
        xE2_2_0 = xi2_0 * w49
        xE2_2_2 = xi2_2 * w49
        w50 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2
        c1_3, c2_5 = _stumpff_12(w50)
        w52 = xE2_2_1 * c2_5
        w53 = xE2_2_1 * w52
        w54 = xE2_2_2 * c2_5 * xE2_2_2
        gE2_2_0 = 1.0 - (w53 + w54)
        w59 = xE2_2_0 * c2_5
        w60 = xE2_2_1 * w59
        w62 = xE2_2_2 * c1_3
        gE2_2_1 = w60 - w62
        w65 = xE2_2_1 * c1_3
        w66 = xE2_2_2 * w59
        gE2_2_2 = w65 + w66
        E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2
        E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8
        gE2_2_3 = w60 + w62
        w71 = xE2_2_0 * w59
        gE2_2_4 = 1.0 - (w54 + w71)
        w72 = xE2_2_2 * w52
        w73 = xE2_2_0 * c1_3
        gE2_2_5 = w72 - w73
        E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5
        gE2_2_6 = w66 - w65
        gE2_2_7 = w72 + w73
        gE2_2_8 = 1.0 - (w53 + w71)
        E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8
        p_2_2 = 0.01 * (xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8)
        E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7
        E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7
        E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7
        a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7
        Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7
        Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8
        w75 = 1.5 - 2.0 * Q2_8
        w76 = 1.0 / sqrt(1.01 + 1.5 * (w75 - 0.2 * Q2_7))
        w77 = w76 * w76 * (0.5 * w76)
        w78 = 1.0 / sqrt(1.01 + 1.5 * (w75 + 0.2 * Q2_7))
        w79 = w78 * w78 * (0.5 * w78)
        w80 = -1.0 - 2.0 * (1.5 * w77 - 1.5 * w79)
        w81 = -0.3 * w77 - 0.3 * w79
        Nr2_0 = Q2_7 * w80 - Q2_8 * w81 + 99.0 * a_3_1 * p_2_2
        w83 = Nr2_0 * w82
        s_m2_4_0 = s_mu_0 + w83
        E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5
        E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8
        a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6
        Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6
        Nr2_1 = -100.0 * a_3_0 * p_2_2 - w80 * Q2_6
        w84 = w82 * Nr2_1
        s_m2_4_1 = s_mu_1 + w84
        Nr2_2 = 0.01 * a_3_0 * a_3_1 + w81 * Q2_6
        w85 = w82 * Nr2_2
        s_m2_4_2 = s_mu_2 + w85
        m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2
        y2_0 = xi2_0 * w86
        y2_1 = xi2_1 * w86
        y2_2 = xi2_2 * w86
        w87 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2
        c2_6, c3_3 = _stumpff_23(w87)
        m2_4_2_2 = ge1_6 * s_m2_4_0 + ge1_7 * s_m2_4_1 + ge1_8 * s_m2_4_2
        m2_4_2_1 = ge1_3 * s_m2_4_0 + ge1_4 * s_m2_4_1 + ge1_5 * s_m2_4_2
        w89 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1
        w91 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1
        w92 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2
        m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2
        y2_2_0 = xi2_0 * w93
        y2_2_1 = xi2_1 * w93
        y2_2_2 = xi2_2 * w93
        w94 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2
        c2_7, c3_4 = _stumpff_23(w94)
        m2_3_2 = ge1_6 * Nr2_0 + ge1_7 * Nr2_1 + ge1_8 * Nr2_2
        m2_3_1 = ge1_3 * Nr2_0 + ge1_4 * Nr2_1 + ge1_5 * Nr2_2
        w96 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1
        w98 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1
        w99 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2
        M2_0 = (
            m2_4_2_0
            - w89 * c2_6
            + (y2_1 * w91 - y2_2 * w92) * c3_3
            + w93 * (m2_3_0 - w96 * c2_7 + (y2_2_1 * w98 - y2_2_2 * w99) * c3_4)
        )
        M2_1 = (
            m2_4_2_1
            - w92 * c2_6
            + (y2_2 * w89 - y2_0 * w91) * c3_3
            + w93 * (m2_3_1 - w99 * c2_7 + (y2_2_2 * w96 - y2_2_0 * w98) * c3_4)
        )
        M2_2 = (
            m2_4_2_2
            - w91 * c2_6
            + (y2_0 * w92 - y2_1 * w89) * c3_3
            + w93 * (m2_3_2 - w98 * c2_7 + (y2_2_0 * w99 - y2_2_1 * w96) * c3_4)
        )
        Wf2_0 = 0.9900990099009901 * (E2_2_0 * M2_0 + E2_2_3 * M2_1 + E2_2_6 * M2_2)
        Pf2_1 = E2_2_1 * M2_0 + E2_2_4 * M2_1 + E2_2_7 * M2_2
        Wf2_2 = 100.0 * (E2_2_2 * M2_0 + E2_2_5 * M2_1 + E2_2_8 * M2_2)
        next_xi2_0 = E2_2_0 * Wf2_0 + E2_2_1 * Pf2_1 + E2_2_2 * Wf2_2
        next_xi2_1 = E2_2_3 * Wf2_0 + E2_2_4 * Pf2_1 + E2_2_5 * Wf2_2
        next_xi2_2 = E2_2_6 * Wf2_0 + E2_2_7 * Pf2_1 + E2_2_8 * Wf2_2
        change_xi2_0 = abs(next_xi2_0 - xi2_0)
        change_xi2_1 = abs(next_xi2_1 - xi2_1)
        change_xi2_2 = abs(next_xi2_2 - xi2_2)
        change = max(change_xi2_0, change_xi2_1, change_xi2_2)
        scale = max(1.0, abs(xi2_0), abs(xi2_1), abs(xi2_2))
        total = change_xi2_0 + change_xi2_1 + change_xi2_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi2, n2", 1, sweep, statistics)
        still = 0.0 < previous_2 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_2
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_2 = change
        xi2_0 = next_xi2_0
        xi2_1 = next_xi2_1
        xi2_2 = next_xi2_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi2, n2", 1, sweep, statistics)
    if statistics is not None:
        statistics.count(1, sweep)
    xe2_1 = xi2_1 * w82
    xe2_0 = xi2_0 * w82
    w100 = xe2_0 * xe2_0
    w101 = xe2_1 * xe2_1
    w102 = w100 + w101
    xe2_2 = xi2_2 * w82
    w103 = xe2_2 * xe2_2
    w104 = w102 + w103
    c1_4, c2_8 = _stumpff_12(w104)
    w106 = xe2_1 * c2_8
    w107 = xe2_1 * w106
    w108 = xe2_2 * c2_8
    w109 = xe2_2 * w108
    w110 = w107 + w109
    ge2_0 = 1.0 - w110
    w111 = ge1_0 * ge2_0
    w112 = xe2_0 * c2_8
    w113 = xe2_1 * w112
    w115 = xe2_2 * c1_4
    ge2_1 = w113 - w115
    w116 = ge1_3 * ge2_1
    w117 = w111 + w116
    w118 = xe2_1 * c1_4
    w119 = xe2_2 * w112
    ge2_2 = w118 + w119
    w120 = ge1_6 * ge2_2
    e2_0 = w117 + w120
    ge2_3 = w113 + w115
    w126 = ge1_0 * ge2_3
    w127 = xe2_0 * w112
    w128 = w109 + w127
    ge2_4 = 1.0 - w128
    w129 = ge1_3 * ge2_4
    w130 = w126 + w129
    w131 = xe2_2 * w106
    w132 = xe2_0 * c1_4
    ge2_5 = w131 - w132
    w133 = ge1_6 * ge2_5
    e2_3 = w130 + w133
    ge2_6 = w119 - w118
    w138 = ge1_0 * ge2_6
    ge2_7 = w131 + w132
    w139 = ge1_3 * ge2_7
    w140 = w138 + w139
    w141 = w107 + w127
    ge2_8 = 1.0 - w141
    w142 = ge1_6 * ge2_8
    e2_6 = w140 + w142
    w145 = ge1_2 * ge2_0
    w146 = ge1_5 * ge2_1
    w147 = w145 + w146
    w148 = ge1_8 * ge2_2
    e2_2 = w147 + w148
    w149 = ge1_2 * ge2_3
    w150 = ge1_5 * ge2_4
    w151 = w149 + w150
    w152 = ge1_8 * ge2_5
    e2_5 = w151 + w152
    w153 = ge1_2 * ge2_6
    w154 = ge1_5 * ge2_7
    w155 = w153 + w154
    w156 = ge1_8 * ge2_8
    e2_8 = w155 + w156
    w160 = ge1_1 * ge2_0
    w161 = ge1_4 * ge2_1
    w162 = w160 + w161
    w163 = ge1_7 * ge2_2
    e2_1 = w162 + w163
    w164 = ge1_1 * ge2_3
    w165 = ge1_4 * ge2_4
    w166 = w164 + w165
    w167 = ge1_7 * ge2_5
    e2_4 = w166 + w167
    w168 = ge1_1 * ge2_6
    w169 = ge1_4 * ge2_7
    w170 = w168 + w169
    w171 = ge1_7 * ge2_8
    e2_7 = w170 + w171
    # the equations of xi3, n3: fixed point in xi3_0, xi3_1, xi3_2
    xi3_0 = Wxi0_0
    xi3_1 = m_1
    xi3_2 = Wxi0_2
    previous_3 = 0.0
    for sweep in range(1, 101):
        xE3_3_1 = xi3_1 * w1
        xE3_3_0 = xi3_0 * w1
        xE3_3_2 = xi3_2 * w1
        w121 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2
        c1_5, c2_9 = _stumpff_12(w121)
        w123 = xE3_3_1 * c2_9
        w124 = xE3_3_1 * w123
        w125 = xE3_3_2 * c2_9 * xE3_3_2
        gE3_3_0 = 1.0 - (w124 + w125)
        w134 = xE3_3_0 * c2_9
        w135 = xE3_3_1 * w134
        w137 = xE3_3_2 * c1_5
        gE3_3_1 = w135 - w137
        w143 = xE3_3_1 * c1_5
        w144 = xE3_3_2 * w134
        gE3_3_2 = w143 + w144
        E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2
        E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8
        gE3_3_3 = w135 + w137
        w157 = xE3_3_0 * w134
        gE3_3_4 = 1.0 - (w125 + w157)
        w158 = xE3_3_2 * w123
        w159 = xE3_3_0 * c1_5
        gE3_3_5 = w158 - w159
        E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5
        gE3_3_6 = w144 - w143
        gE3_3_7 = w158 + w159
        gE3_3_8 = 1.0 - (w124 + w157)
        E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8
        p_3_2 = 0.01 * (xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8)
        E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7
        E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7
        E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7
        a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7
        Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7
        Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8
        w172 = 1.5 - 2.0 * Q3_8
        w173 = 1.0 / sqrt(1.01 + 1.5 * (w172 - 0.2 * Q3_7))
        w174 = w173 * w173 * (0.5 * w173)
        w175 = 1.0 / sqrt(1.01 + 1.5 * (w172 + 0.2 * Q3_7))
        w176 = w175 * w175 * (0.5 * w175)
        w177 = -1.0 - 2.0 * (1.5 * w174 - 1.5 * w176)
        w178 = -0.3 * w174 - 0.3 * w176
        Nr3_0 = Q3_7 * w177 - Q3_8 * w178 + 99.0 * a_5_1 * p_3_2
        s_m3_5_0 = s_m2_4_0 + w23 * Nr3_0
        E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5
        E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8
        a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6
        Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6
        Nr3_1 = -100.0 * a_5_0 * p_3_2 - w177 * Q3_6
        s_m3_5_1 = s_m2_4_1 + w23 * Nr3_1
        Nr3_2 = 0.01 * a_5_0 * a_5_1 + w178 * Q3_6
        s_m3_5_2 = s_m2_4_2 + w23 * Nr3_2
        m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2
        y3_0 = xi3_0 * w24
        y3_1 = xi3_1 * w24
        y3_2 = xi3_2 * w24
        w179 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2
        c2_10, c3_5 = _stumpff_23(w179)
        m3_5_2_2 = e2_6 * s_m3_5_0 + e2_7 * s_m3_5_1 + e2_8 * s_m3_5_2
        m3_5_2_1 = e2_3 * s_m3_5_0 + e2_4 * s_m3_5_1 + e2_5 * s_m3_5_2
        w181 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1
        w183 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1
        w184 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2
        m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2
        y3_2_0 = xi3_0 * w31
        y3_2_1 = xi3_1 * w31
        y3_2_2 = xi3_2 * w31
        w185 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2
        c2_11, c3_6 = _stumpff_23(w185)
        m3_4_2 = e2_6 * Nr3_0 + e2_7 * Nr3_1 + e2_8 * Nr3_2
        m3_4_1 = e2_3 * Nr3_0 + e2_4 * Nr3_1 + e2_5 * Nr3_2
        w187 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1
        w189 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1
        w190 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2
        M3_0 = (
            m3_5_2_0
            - w181 * c2_10
            + (y3_1 * w183 - y3_2 * w184) * c3_5
            + w31 * (m3_4_0 - w187 * c2_11 + (y3_2_1 * w189 - y3_2_2 * w190) * c3_6)
        )
        M3_1 = (
            m3_5_2_1
            - w184 * c2_10
            + (y3_2 * w181 - y3_0 * w183) * c3_5
            + w31 * (m3_4_1 - w190 * c2_11 + (y3_2_2 * w187 - y3_2_0 * w189) * c3_6)
        )
        M3_2 = (
            m3_5_2_2
            - w183 * c2_10
            + (y3_0 * w184 - y3_1 * w181) * c3_5
            + w31 * (m3_4_2 - w189 * c2_11 + (y3_2_0 * w190 - y3_2_1 * w187) * c3_6)
        )
        Wf3_0 = 0.9900990099009901 * (E3_3_0 * M3_0 + E3_3_3 * M3_1 + E3_3_6 * M3_2)
        Pf3_1 = E3_3_1 * M3_0 + E3_3_4 * M3_1 + E3_3_7 * M3_2
        Wf3_2 = 100.0 * (E3_3_2 * M3_0 + E3_3_5 * M3_1 + E3_3_8 * M3_2)
        next_xi3_0 = E3_3_0 * Wf3_0 + E3_3_1 * Pf3_1 + E3_3_2 * Wf3_2
        next_xi3_1 = E3_3_3 * Wf3_0 + E3_3_4 * Pf3_1 + E3_3_5 * Wf3_2
        next_xi3_2 = E3_3_6 * Wf3_0 + E3_3_7 * Pf3_1 + E3_3_8 * Wf3_2
        change_xi3_0 = abs(next_xi3_0 - xi3_0)
        change_xi3_1 = abs(next_xi3_1 - xi3_1)
        change_xi3_2 = abs(next_xi3_2 - xi3_2)
        change = max(change_xi3_0, change_xi3_1, change_xi3_2)
        scale = max(1.0, abs(xi3_0), abs(xi3_1), abs(xi3_2))
        total = change_xi3_0 + change_xi3_1 + change_xi3_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi3, n3", 2, sweep, statistics)
        still = 0.0 < previous_3 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_3
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_3 = change
        xi3_0 = next_xi3_0
        xi3_1 = next_xi3_1
        xi3_2 = next_xi3_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi3, n3", 2, sweep, statistics)
    if statistics is not None:
        statistics.count(2, sweep)
    xe3_1 = xi3_1 * w23
    xe3_0 = xi3_0 * w23
    xe3_2 = xi3_2 * w23
    w191 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2
    c1_6, c2_12 = _stumpff_12(w191)
    w193 = xe3_1 * c2_12
    w194 = xe3_1 * w193
    w195 = xe3_2 * c2_12 * xe3_2
    ge3_0 = 1.0 - (w194 + w195)
    w196 = xe3_0 * c2_12
    w197 = xe3_1 * w196
    w199 = xe3_2 * c1_6
    ge3_1 = w197 - w199
    w200 = xe3_1 * c1_6
    w201 = xe3_2 * w196
    ge3_2 = w200 + w201
    e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2
    ge3_3 = w197 + w199
    w202 = xe3_0 * w196
    ge3_4 = 1.0 - (w195 + w202)
    w203 = xe3_2 * w193
    w204 = xe3_0 * c1_6
    ge3_5 = w203 - w204
    e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5
    ge3_6 = w201 - w200
    ge3_7 = w203 + w204
    ge3_8 = 1.0 - (w194 + w202)
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
    mubar_0 = m_0 + w23 * (Nr1_0 + Nr3_0) + w83
    mubar_1 = m_1 + w23 * (Nr1_1 + Nr3_1) + w84
    mubar_2 = m_2 + w23 * (Nr1_2 + Nr3_2) + w85
    new_mu0 = q1_0 * mubar_0 + q1_1 * mubar_1 + q1_2 * mubar_2
    new_mu1 = q1_3 * mubar_0 + q1_4 * mubar_1 + q1_5 * mubar_2
    new_mu2 = q1_6 * mubar_0 + q1_7 * mubar_1 + q1_8 * mubar_2
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
