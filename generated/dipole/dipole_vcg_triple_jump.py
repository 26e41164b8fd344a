"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, n1: Newton's method with the matrix to first order
            in h, 3 unknowns (1.9 sweeps of 304 operations and 1.00 matrices of 105
            a step; fixed point: 3.2 sweeps of 289 operations; Newton's method: 2.5
            sweeps of 304 operations and 0.05 matrices of 1048)
solved by:  the equations of xi2, n2: Newton's method with the matrix to first order
            in h, 3 unknowns (2.0 sweeps of 394 operations and 1.00 matrices of 111
            a step; fixed point: 3.4 sweeps of 379 operations; Newton's method: 2.5
            sweeps of 394 operations and 0.05 matrices of 1499)
solved by:  the equations of xi3, n3: Newton's method with the matrix to first order
            in h, 3 unknowns (1.9 sweeps of 400 operations and 1.00 matrices of 109
            a step; fixed point: 3.2 sweeps of 385 operations; Newton's method: 2.4
            sweeps of 400 operations and 0.05 matrices of 1499)
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
            6 Adtinv, 1 force (dead code)
            6 dexpt (functions)
            1 Adinv (opposites)
            2 Adinv, 3 legendre (sharing)
            1 lin (scalars)
            1 lin (sharing)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 120 add, 170 mul, 3 stumpff_12 a step
            2 mul a start, in steps that follow no other
            29 add, 72 mul, 1 div a matrix of the equations of xi1, n1
            84 add, 137 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
            32 add, 75 mul, 1 div a matrix of the equations of xi2, n2
            120 add, 191 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi2, n2
            32 add, 73 mul, 1 div a matrix of the equations of xi3, n3
            126 add, 191 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
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
    """Sweeps over the equations, added up over all steps that are given this object.

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


class _Memory:
    """What one step of a run leaves for the next.

    past: solutions of its equations, the latest first.
    """

    def __init__(self):
        self.past = []
        self.first = 0.0
        self.rates = [1.0] * 3

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
    w46 = 0.6756035959798288 * h
    w69 = 1.3512071919596575 * h
    w70 = -1.3512071919596575 * h
    w79 = -0.6756035959798288 * h
    # the equations of xi1, n1: Newton's method with the matrix to first order in h in xi1_0, xi1_1, xi1_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    w1 = 100.0 * m_0
    Wxi0_0_ = 0.9900990099009901 * m_0
    w2 = h * Wxi0_0_
    w3 = h * w1 - w2
    w4 = -50.0 * h
    w5 = m_0 * w4
    w6 = 1.3512071919596575 * w5
    w7 = 0.01 * xi1_0
    w8 = 67.56035959798288 * h
    w9 = 0.6756035959798288 * w3 + w6 + w7 * w8
    w10 = h * m_0
    w11 = w2 - w10
    w12 = -0.5 * h
    w13 = m_0 * w12
    w14 = -1.3512071919596575 * w13
    w15 = 0.6756035959798288 * h
    w16 = -100.0 * xi1_0
    w17 = 0.6756035959798288 * w11 + w14 + 0.01 * (w15 * w16)
    w18 = 1.0 - w9 * w17
    Wxi0_2_ = 100.0 * m_2
    w19 = h * Wxi0_2_
    w20 = 0.9900990099009901 * m_2
    w21 = w19 - h * w20
    w22 = -0.49504950495049505 * h
    w23 = m_2 * w22
    w24 = -1.3512071919596575 * w23
    w25 = 0.668914451465177 * h
    w26 = 0.6756035959798288 * w21 + w24 + 0.99 * xi1_2 * w25
    w27 = h * m_1
    w28 = 100.0 * m_1
    w29 = w27 - h * w28
    w30 = m_1 * w4
    w31 = -1.3512071919596575 * w30
    w32 = 0.6756035959798288 * w29 + w31 + 0.01 * xi1_1 * w8
    xE1_1_2 = xi1_2 * w15
    w33 = h * m_2 - w19
    w34 = m_2 * w12
    w35 = 1.3512071919596575 * w34
    w36 = xE1_1_2 - (0.6756035959798288 * w33 + w35)
    w37 = w17 * w32 - w36
    w38 = 0.9900990099009901 * m_1
    w39 = h * w38 - w27
    w40 = m_1 * w22
    w41 = 1.3512071919596575 * w40
    w42 = 99.0 * xi1_1
    w43 = 0.6756035959798288 * w39 + w41 + 0.01 * (w25 * w42)
    w44 = w32 - w9 * w36
    w45 = 1.0 / (w18 - w26 * w37 - w43 * w44)
    row_1_1 = [
        w18 * w45,
        w45 * (w26 + w9 * w43),
        w45 * (w43 + w17 * w26),
    ]
    row_1_2 = [
        w37 * w45,
        w45 * (1.0 - w32 * w43),
        w45 * (w17 - w36 * w43),
    ]
    row_1_3 = [
        w44 * w45,
        w45 * (w9 + w26 * w32),
        w45 * (1.0 + w26 * w36),
    ]
    for sweep in range(1, 101):
        xE1_1_1 = xi1_1 * w46
        xE1_1_0 = xi1_0 * w46
        xE1_1_2_ = xi1_2 * w46
        w47 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2_ * xE1_1_2_
        c1_1, c2_1 = _stumpff_12(w47)
        w49 = xE1_1_1 * c2_1
        w50 = xE1_1_1 * w49
        w51 = xE1_1_2_ * c2_1 * xE1_1_2_
        gE1_1_0 = 1.0 - (w50 + w51)
        p_2 = 0.01 * xi1_2
        w52 = 99.0 * xi1_1
        w53 = xE1_1_0 * c2_1
        w54 = xE1_1_1 * w53
        w56 = xE1_1_2_ * c1_1
        gE1_1_1 = w54 - w56
        w57 = xE1_1_0 * w53
        gE1_1_4 = 1.0 - (w51 + w57)
        w58 = xE1_1_0 * c1_1
        w59 = xE1_1_2_ * w49
        gE1_1_7 = w58 + w59
        Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7
        w60 = xE1_1_1 * c1_1
        w61 = xE1_1_2_ * w53
        gE1_1_2 = w60 + w61
        gE1_1_5 = w59 - w58
        gE1_1_8 = 1.0 - (w50 + w57)
        Q1_8 = g20 * gE1_1_2 + g21 * gE1_1_5 + g22 * gE1_1_8
        w62 = 1.5 - 2.0 * Q1_8
        w63 = 1.0 / sqrt(1.01 + 1.5 * (w62 - 0.2 * Q1_7))
        w64 = w63 * w63 * (0.5 * w63)
        w65 = 1.0 / sqrt(1.01 + 1.5 * (w62 + 0.2 * Q1_7))
        w66 = w65 * w65 * (0.5 * w65)
        w67 = -1.0 - 2.0 * (1.5 * w64 - 1.5 * w66)
        w68 = -0.3 * w64 - 0.3 * w66
        Nr1_0 = Q1_7 * w67 - Q1_8 * w68 + p_2 * w52
        s_mu_0 = m_0 + Nr1_0 * w69
        y1_0 = xi1_0 * w70
        y1_1 = xi1_1 * w70
        y1_2 = xi1_2 * w70
        w71 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2
        c2_2, c3_1 = _stumpff_23(w71)
        w73 = 0.01 * xi1_0
        gE1_1_3 = w54 + w56
        gE1_1_6 = w61 - w60
        Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6
        Nr1_2 = xi1_1 * w73 + w68 * Q1_6
        s_mu_2 = m_2 + w69 * Nr1_2
        w74 = -100.0 * xi1_0
        Nr1_1 = p_2 * w74 - w67 * Q1_6
        s_mu_1 = m_1 + w69 * Nr1_1
        w75 = y1_1 * s_mu_2 - y1_2 * s_mu_1
        w77 = y1_0 * s_mu_1 - s_mu_0 * y1_1
        w78 = s_mu_0 * y1_2 - y1_0 * s_mu_2
        y1_2_0 = xi1_0 * w79
        y1_2_1 = xi1_1 * w79
        y1_2_2 = xi1_2 * w79
        w80 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w80)
        w82 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2
        w84 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1
        w85 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0
        M1_0 = (
            s_mu_0
            - w75 * c2_2
            + (y1_1 * w77 - y1_2 * w78) * c3_1
            + w79 * (Nr1_0 - w82 * c2_3 + (y1_2_1 * w84 - y1_2_2 * w85) * c3_2)
        )
        M1_1 = (
            s_mu_1
            - w78 * c2_2
            + (y1_2 * w75 - y1_0 * w77) * c3_1
            + w79 * (Nr1_1 - w85 * c2_3 + (y1_2_2 * w82 - y1_2_0 * w84) * c3_2)
        )
        M1_2 = (
            s_mu_2
            - w77 * c2_2
            + (y1_0 * w78 - y1_1 * w75) * c3_1
            + w79 * (Nr1_2 - w84 * c2_3 + (y1_2_0 * w85 - y1_2_1 * w82) * c3_2)
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
        raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    xe1_1 = xi1_1 * w69
    xe1_0 = xi1_0 * w69
    w124 = xe1_0 * xe1_0
    w125 = xe1_1 * xe1_1
    w126 = w124 + w125
    xe1_2 = xi1_2 * w69
    w127 = xe1_2 * xe1_2
    w128 = w126 + w127
    c1_2, c2_4 = _stumpff_12(w128)
    w130 = xe1_1 * c2_4
    w131 = xe1_1 * w130
    w132 = xe1_2 * c2_4
    w133 = xe1_2 * w132
    w134 = w131 + w133
    ge1_0 = 1.0 - w134
    w135 = -0.8512071919596577 * h
    w142 = xe1_2 * c1_2
    w143 = xe1_0 * c2_4
    w144 = xe1_1 * w143
    ge1_3 = w142 + w144
    w149 = xe1_2 * w143
    w150 = xe1_1 * c1_2
    ge1_6 = w149 - w150
    ge1_2 = w149 + w150
    w153 = xe1_2 * w130
    w154 = xe1_0 * c1_2
    ge1_5 = w153 - w154
    w155 = xe1_0 * w143
    w156 = w131 + w155
    ge1_8 = 1.0 - w156
    ge1_1 = w144 - w142
    w160 = w133 + w155
    ge1_4 = 1.0 - w160
    ge1_7 = w153 + w154
    w168 = -1.7024143839193153 * h
    w172 = 1.7024143839193153 * h
    w179 = 0.8512071919596577 * h
    # the equations of xi2, n2: Newton's method with the matrix to first order in h in xi2_0, xi2_1, xi2_2
    previous_2 = 0.0
    rate_2 = memory.rates[1] if memory.past else 1.0
    w86 = 0.8512071919596577 * h
    w87 = -1.7024143839193153 * h
    w88 = w86 + w87
    Wxi0_0__ = 0.9900990099009901 * m_0
    w89 = h * Wxi0_0__
    w90 = h * m_0
    w91 = w89 - w90
    w92 = -0.5 * h
    w93 = m_0 * w92
    w94 = (
        -0.01 * (100.0 * xi2_0 * w88)
        - 0.8512071919596577 * w91
        + 1.7024143839193153 * w93
    )
    w95 = 85.12071919596576 * h - 170.24143839193152 * h
    w96 = 100.0 * m_0
    w97 = h * w96 - w89
    w98 = -50.0 * h
    w99 = m_0 * w98
    w100 = 0.01 * xi2_0 * w95 - 0.8512071919596577 * w97 - 1.7024143839193153 * w99
    w101 = 1.0 - w94 * w100
    w102 = 0.842779397979859 * h - 1.685558795959718 * h
    Wxi0_2__ = 100.0 * m_2
    w103 = h * Wxi0_2__
    w104 = 0.9900990099009901 * m_2
    w105 = w103 - h * w104
    w106 = -0.49504950495049505 * h
    w107 = m_2 * w106
    w108 = 0.99 * xi2_2 * w102 - 0.8512071919596577 * w105 + 1.7024143839193153 * w107
    w109 = h * m_2 - w103
    w110 = m_2 * w92
    w111 = -0.8512071919596577 * w109 - xi2_2 * w88 - 1.7024143839193153 * w110
    w112 = h * m_1
    w113 = 100.0 * m_1
    w114 = w112 - h * w113
    w115 = m_1 * w98
    w116 = 0.01 * xi2_1 * w95 - 0.8512071919596577 * w114 + 1.7024143839193153 * w115
    w117 = w111 + w94 * w116
    w118 = 0.9900990099009901 * m_1
    w119 = h * w118 - w112
    w120 = m_1 * w106
    w121 = (
        0.01 * (99.0 * xi2_1 * w102)
        - 0.8512071919596577 * w119
        - 1.7024143839193153 * w120
    )
    w122 = w116 + w100 * w111
    w123 = 1.0 / (w101 - w108 * w117 - w121 * w122)
    row_2_1 = [
        w101 * w123,
        w123 * (w108 + w100 * w121),
        w123 * (w121 + w94 * w108),
    ]
    row_2_2 = [
        w117 * w123,
        w123 * (1.0 - w116 * w121),
        w123 * (w94 + w111 * w121),
    ]
    row_2_3 = [
        w122 * w123,
        w123 * (w100 + w108 * w116),
        w123 * (1.0 - w108 * w111),
    ]
    for sweep in range(1, 101):
        xE2_2_1 = xi2_1 * w135
        xE2_2_0 = xi2_0 * w135
        xE2_2_2 = xi2_2 * w135
        w136 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2
        c1_3, c2_5 = _stumpff_12(w136)
        w138 = xE2_2_1 * c2_5
        w139 = xE2_2_1 * w138
        w140 = xE2_2_2 * c2_5 * xE2_2_2
        gE2_2_0 = 1.0 - (w139 + w140)
        w145 = xE2_2_0 * c2_5
        w146 = xE2_2_1 * w145
        w148 = xE2_2_2 * c1_3
        gE2_2_1 = w146 - w148
        w151 = xE2_2_1 * c1_3
        w152 = xE2_2_2 * w145
        gE2_2_2 = w151 + w152
        E2_2_0 = ge1_0 * gE2_2_0 + ge1_3 * gE2_2_1 + ge1_6 * gE2_2_2
        E2_2_2 = gE2_2_0 * ge1_2 + gE2_2_1 * ge1_5 + gE2_2_2 * ge1_8
        gE2_2_3 = w146 + w148
        w157 = xE2_2_0 * w145
        gE2_2_4 = 1.0 - (w140 + w157)
        w158 = xE2_2_2 * w138
        w159 = xE2_2_0 * c1_3
        gE2_2_5 = w158 - w159
        E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5
        gE2_2_6 = w152 - w151
        gE2_2_7 = w158 + w159
        gE2_2_8 = 1.0 - (w139 + w157)
        E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8
        p_2_2 = 0.01 * (xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8)
        E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7
        E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7
        E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7
        a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7
        Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7
        Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8
        w161 = 1.5 - 2.0 * Q2_8
        w162 = 1.0 / sqrt(1.01 + 1.5 * (w161 - 0.2 * Q2_7))
        w163 = w162 * w162 * (0.5 * w162)
        w164 = 1.0 / sqrt(1.01 + 1.5 * (w161 + 0.2 * Q2_7))
        w165 = w164 * w164 * (0.5 * w164)
        w166 = -1.0 - 2.0 * (1.5 * w163 - 1.5 * w165)
        w167 = -0.3 * w163 - 0.3 * w165
        Nr2_0 = Q2_7 * w166 - Q2_8 * w167 + 99.0 * a_3_1 * p_2_2
        w169 = Nr2_0 * w168
        s_m2_4_0 = s_mu_0 + w169
        E2_2_3 = ge1_0 * gE2_2_3 + ge1_3 * gE2_2_4 + ge1_6 * gE2_2_5
        E2_2_6 = ge1_0 * gE2_2_6 + ge1_3 * gE2_2_7 + ge1_6 * gE2_2_8
        a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6
        Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6
        Nr2_1 = -100.0 * a_3_0 * p_2_2 - w166 * Q2_6
        w170 = w168 * Nr2_1
        s_m2_4_1 = s_mu_1 + w170
        Nr2_2 = 0.01 * a_3_0 * a_3_1 + w167 * Q2_6
        w171 = w168 * Nr2_2
        s_m2_4_2 = s_mu_2 + w171
        m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2
        y2_0 = xi2_0 * w172
        y2_1 = xi2_1 * w172
        y2_2 = xi2_2 * w172
        w173 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2
        c2_6, c3_3 = _stumpff_23(w173)
        m2_4_2_2 = ge1_6 * s_m2_4_0 + ge1_7 * s_m2_4_1 + ge1_8 * s_m2_4_2
        m2_4_2_1 = ge1_3 * s_m2_4_0 + ge1_4 * s_m2_4_1 + ge1_5 * s_m2_4_2
        w175 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1
        w177 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1
        w178 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2
        m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2
        y2_2_0 = xi2_0 * w179
        y2_2_1 = xi2_1 * w179
        y2_2_2 = xi2_2 * w179
        w180 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2
        c2_7, c3_4 = _stumpff_23(w180)
        m2_3_2 = ge1_6 * Nr2_0 + ge1_7 * Nr2_1 + ge1_8 * Nr2_2
        m2_3_1 = ge1_3 * Nr2_0 + ge1_4 * Nr2_1 + ge1_5 * Nr2_2
        w182 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1
        w184 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1
        w185 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2
        M2_0 = (
            m2_4_2_0
            - w175 * c2_6
            + (y2_1 * w177 - y2_2 * w178) * c3_3
            + w179 * (m2_3_0 - w182 * c2_7 + (y2_2_1 * w184 - y2_2_2 * w185) * c3_4)
        )
        M2_1 = (
            m2_4_2_1
            - w178 * c2_6
            + (y2_2 * w175 - y2_0 * w177) * c3_3
            + w179 * (m2_3_1 - w185 * c2_7 + (y2_2_2 * w182 - y2_2_0 * w184) * c3_4)
        )
        M2_2 = (
            m2_4_2_2
            - w177 * c2_6
            + (y2_0 * w178 - y2_1 * w175) * c3_3
            + w179 * (m2_3_2 - w184 * c2_7 + (y2_2_0 * w185 - y2_2_1 * w182) * c3_4)
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
        if sweep == 1:
            memory.first = max(memory.first, change)
        if previous_2 > 0.0:
            rate_2 = max(change / previous_2, 0.000244140625)
        close = change * rate_2 <= 1.1102230246251565e-16 * scale
        if still or (close and change <= 5.684341886080802e-14 * scale):
            memory.rates[1] = rate_2 if sweep > 1 else 2.0 * rate_2
            break
        previous_2 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi2, n2", 1, sweep, statistics)
    if statistics is not None:
        statistics.count(1, sweep)
    xe2_1 = xi2_1 * w168
    xe2_0 = xi2_0 * w168
    w221 = xe2_0 * xe2_0
    w222 = xe2_1 * xe2_1
    w223 = w221 + w222
    xe2_2 = xi2_2 * w168
    w224 = xe2_2 * xe2_2
    w225 = w223 + w224
    c1_4, c2_8 = _stumpff_12(w225)
    w227 = xe2_1 * c2_8
    w228 = xe2_1 * w227
    w229 = xe2_2 * c2_8
    w230 = xe2_2 * w229
    w231 = w228 + w230
    ge2_0 = 1.0 - w231
    w232 = ge1_0 * ge2_0
    w233 = xe2_0 * c2_8
    w234 = xe2_1 * w233
    w236 = xe2_2 * c1_4
    ge2_1 = w234 - w236
    w237 = ge1_3 * ge2_1
    w238 = w232 + w237
    w239 = xe2_1 * c1_4
    w240 = xe2_2 * w233
    ge2_2 = w239 + w240
    w241 = ge1_6 * ge2_2
    e2_0 = w238 + w241
    ge2_3 = w234 + w236
    w247 = ge1_0 * ge2_3
    w248 = xe2_0 * w233
    w249 = w230 + w248
    ge2_4 = 1.0 - w249
    w250 = ge1_3 * ge2_4
    w251 = w247 + w250
    w252 = xe2_2 * w227
    w253 = xe2_0 * c1_4
    ge2_5 = w252 - w253
    w254 = ge1_6 * ge2_5
    e2_3 = w251 + w254
    ge2_6 = w240 - w239
    w259 = ge1_0 * ge2_6
    ge2_7 = w252 + w253
    w260 = ge1_3 * ge2_7
    w261 = w259 + w260
    w262 = w228 + w248
    ge2_8 = 1.0 - w262
    w263 = ge1_6 * ge2_8
    e2_6 = w261 + w263
    w266 = ge1_2 * ge2_0
    w267 = ge1_5 * ge2_1
    w268 = w266 + w267
    w269 = ge1_8 * ge2_2
    e2_2 = w268 + w269
    w270 = ge1_2 * ge2_3
    w271 = ge1_5 * ge2_4
    w272 = w270 + w271
    w273 = ge1_8 * ge2_5
    e2_5 = w272 + w273
    w274 = ge1_2 * ge2_6
    w275 = ge1_5 * ge2_7
    w276 = w274 + w275
    w277 = ge1_8 * ge2_8
    e2_8 = w276 + w277
    w281 = ge1_1 * ge2_0
    w282 = ge1_4 * ge2_1
    w283 = w281 + w282
    w284 = ge1_7 * ge2_2
    e2_1 = w283 + w284
    w285 = ge1_1 * ge2_3
    w286 = ge1_4 * ge2_4
    w287 = w285 + w286
    w288 = ge1_7 * ge2_5
    e2_4 = w287 + w288
    w289 = ge1_1 * ge2_6
    w290 = ge1_4 * ge2_7
    w291 = w289 + w290
    w292 = ge1_7 * ge2_8
    e2_7 = w291 + w292
    # the equations of xi3, n3: Newton's method with the matrix to first order in h in xi3_0, xi3_1, xi3_2
    previous_3 = 0.0
    rate_3 = memory.rates[2] if memory.past else 1.0
    w186 = -0.5 * h
    w187 = m_0 * w186
    w188 = -1.3512071919596575 * w187
    Wxi0_0___ = 0.9900990099009901 * m_0
    w189 = w46 * Wxi0_0___
    w190 = h * m_0
    w191 = w69 + w79
    w192 = w189 - 0.6756035959798288 * w190 - 0.01 * (100.0 * xi3_0 * w191) + w188
    w193 = -50.0 * h
    w194 = m_0 * w193
    w195 = 1.3512071919596575 * w194
    w196 = 100.0 * m_0
    w197 = 135.12071919596576 * h - 67.56035959798288 * h
    w198 = w46 * w196 - w189 + 0.01 * xi3_0 * w197 + w195
    w199 = 1.0 - w192 * w198
    w200 = -0.49504950495049505 * h
    w201 = m_2 * w200
    w202 = -1.3512071919596575 * w201
    w203 = 0.9900990099009901 * m_2
    w204 = 1.337828902930354 * h - 0.668914451465177 * h
    w205 = 67.56035959798288 * m_2 * h - w46 * w203 + 0.99 * xi3_2 * w204 + w202
    w206 = m_2 * w186
    w207 = 1.3512071919596575 * w206
    Wxi0_2___ = 100.0 * m_2
    w208 = 0.6756035959798288 * m_2 * h - w46 * Wxi0_2___ - xi3_2 * w191 + w207
    w209 = m_1 * w193
    w210 = -1.3512071919596575 * w209
    w211 = 100.0 * m_1
    w212 = m_1 * w46 - w46 * w211 + 0.01 * xi3_1 * w197 + w210
    w213 = w208 + w192 * w212
    w214 = m_1 * w200
    w215 = 1.3512071919596575 * w214
    w216 = 0.9900990099009901 * m_1
    w217 = h * m_1
    w218 = w46 * w216 - 0.6756035959798288 * w217 + 0.01 * (99.0 * xi3_1 * w204) + w215
    w219 = w212 + w198 * w208
    w220 = 1.0 / (w199 - w205 * w213 - w218 * w219)
    row_3_1 = [
        w199 * w220,
        w220 * (w205 + w198 * w218),
        w220 * (w218 + w192 * w205),
    ]
    row_3_2 = [
        w213 * w220,
        w220 * (1.0 - w212 * w218),
        w220 * (w192 + w208 * w218),
    ]
    row_3_3 = [
        w219 * w220,
        w220 * (w198 + w205 * w212),
        w220 * (1.0 - w205 * w208),
    ]
    for sweep in range(1, 101):
        xE3_3_1 = xi3_1 * w46
        xE3_3_0 = xi3_0 * w46
        xE3_3_2 = xi3_2 * w46
        w242 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2
        c1_5, c2_9 = _stumpff_12(w242)
        w244 = xE3_3_1 * c2_9
        w245 = xE3_3_1 * w244
        w246 = xE3_3_2 * c2_9 * xE3_3_2
        gE3_3_0 = 1.0 - (w245 + w246)
        w255 = xE3_3_0 * c2_9
        w256 = xE3_3_1 * w255
        w258 = xE3_3_2 * c1_5
        gE3_3_1 = w256 - w258
        w264 = xE3_3_1 * c1_5
        w265 = xE3_3_2 * w255
        gE3_3_2 = w264 + w265
        E3_3_0 = e2_0 * gE3_3_0 + e2_3 * gE3_3_1 + e2_6 * gE3_3_2
        E3_3_2 = gE3_3_0 * e2_2 + gE3_3_1 * e2_5 + gE3_3_2 * e2_8
        gE3_3_3 = w256 + w258
        w278 = xE3_3_0 * w255
        gE3_3_4 = 1.0 - (w246 + w278)
        w279 = xE3_3_2 * w244
        w280 = xE3_3_0 * c1_5
        gE3_3_5 = w279 - w280
        E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5
        gE3_3_6 = w265 - w264
        gE3_3_7 = w279 + w280
        gE3_3_8 = 1.0 - (w245 + w278)
        E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8
        p_3_2 = 0.01 * (xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8)
        E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7
        E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7
        E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7
        a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7
        Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7
        Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8
        w293 = 1.5 - 2.0 * Q3_8
        w294 = 1.0 / sqrt(1.01 + 1.5 * (w293 - 0.2 * Q3_7))
        w295 = w294 * w294 * (0.5 * w294)
        w296 = 1.0 / sqrt(1.01 + 1.5 * (w293 + 0.2 * Q3_7))
        w297 = w296 * w296 * (0.5 * w296)
        w298 = -1.0 - 2.0 * (1.5 * w295 - 1.5 * w297)
        w299 = -0.3 * w295 - 0.3 * w297
        Nr3_0 = Q3_7 * w298 - Q3_8 * w299 + 99.0 * a_5_1 * p_3_2
        s_m3_5_0 = m_0 + w69 * (Nr1_0 + Nr3_0) + w169
        E3_3_3 = e2_0 * gE3_3_3 + e2_3 * gE3_3_4 + e2_6 * gE3_3_5
        E3_3_6 = e2_0 * gE3_3_6 + e2_3 * gE3_3_7 + e2_6 * gE3_3_8
        a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6
        Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6
        Nr3_1 = -100.0 * a_5_0 * p_3_2 - w298 * Q3_6
        s_m3_5_1 = m_1 + w69 * (Nr1_1 + Nr3_1) + w170
        Nr3_2 = 0.01 * a_5_0 * a_5_1 + w299 * Q3_6
        s_m3_5_2 = m_2 + w69 * (Nr1_2 + Nr3_2) + w171
        m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2
        y3_0 = xi3_0 * w70
        y3_1 = xi3_1 * w70
        y3_2 = xi3_2 * w70
        w300 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2
        c2_10, c3_5 = _stumpff_23(w300)
        m3_5_2_2 = e2_6 * s_m3_5_0 + e2_7 * s_m3_5_1 + e2_8 * s_m3_5_2
        m3_5_2_1 = e2_3 * s_m3_5_0 + e2_4 * s_m3_5_1 + e2_5 * s_m3_5_2
        w302 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1
        w304 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1
        w305 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2
        m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2
        y3_2_0 = xi3_0 * w79
        y3_2_1 = xi3_1 * w79
        y3_2_2 = xi3_2 * w79
        w306 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2
        c2_11, c3_6 = _stumpff_23(w306)
        m3_4_2 = e2_6 * Nr3_0 + e2_7 * Nr3_1 + e2_8 * Nr3_2
        m3_4_1 = e2_3 * Nr3_0 + e2_4 * Nr3_1 + e2_5 * Nr3_2
        w308 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1
        w310 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1
        w311 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2
        M3_0 = (
            m3_5_2_0
            - w302 * c2_10
            + (y3_1 * w304 - y3_2 * w305) * c3_5
            + w79 * (m3_4_0 - w308 * c2_11 + (y3_2_1 * w310 - y3_2_2 * w311) * c3_6)
        )
        M3_1 = (
            m3_5_2_1
            - w305 * c2_10
            + (y3_2 * w302 - y3_0 * w304) * c3_5
            + w79 * (m3_4_1 - w311 * c2_11 + (y3_2_2 * w308 - y3_2_0 * w310) * c3_6)
        )
        M3_2 = (
            m3_5_2_2
            - w304 * c2_10
            + (y3_0 * w305 - y3_1 * w302) * c3_5
            + w79 * (m3_4_2 - w310 * c2_11 + (y3_2_0 * w311 - y3_2_1 * w308) * c3_6)
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
        if sweep == 1:
            memory.first = max(memory.first, change)
        if previous_3 > 0.0:
            rate_3 = max(change / previous_3, 0.000244140625)
        close = change * rate_3 <= 1.1102230246251565e-16 * scale
        if still or (close and change <= 5.684341886080802e-14 * scale):
            memory.rates[2] = rate_3 if sweep > 1 else 2.0 * rate_3
            break
        previous_3 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi3, n3", 2, sweep, statistics)
    if statistics is not None:
        statistics.count(2, sweep)
    xe3_1 = xi3_1 * w69
    xe3_0 = xi3_0 * w69
    xe3_2 = xi3_2 * w69
    w312 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2
    c1_6, c2_12 = _stumpff_12(w312)
    w314 = xe3_1 * c2_12
    w315 = xe3_1 * w314
    w316 = xe3_2 * c2_12 * xe3_2
    ge3_0 = 1.0 - (w315 + w316)
    w317 = xe3_0 * c2_12
    w318 = xe3_1 * w317
    w320 = xe3_2 * c1_6
    ge3_1 = w318 - w320
    w321 = xe3_1 * c1_6
    w322 = xe3_2 * w317
    ge3_2 = w321 + w322
    e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2
    ge3_3 = w318 + w320
    w323 = xe3_0 * w317
    ge3_4 = 1.0 - (w316 + w323)
    w324 = xe3_2 * w314
    w325 = xe3_0 * c1_6
    ge3_5 = w324 - w325
    e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5
    ge3_6 = w322 - w321
    ge3_7 = w324 + w325
    ge3_8 = 1.0 - (w315 + w323)
    e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8
    e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2
    e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5
    e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8
    e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2
    e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5
    e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8
    change_0 = s_m3_5_0 * e3_0 + s_m3_5_1 * e3_1 + s_m3_5_2 * e3_2 - m_0
    change_1 = s_m3_5_0 * e3_3 + s_m3_5_1 * e3_4 + s_m3_5_2 * e3_5 - m_1
    change_2 = s_m3_5_0 * e3_6 + s_m3_5_1 * e3_7 + s_m3_5_2 * e3_8 - m_2
    new_g00 = g00 * e3_0 + g01 * e3_3 + g02 * e3_6
    new_g01 = g00 * e3_1 + g01 * e3_4 + g02 * e3_7
    new_g02 = g00 * e3_2 + g01 * e3_5 + g02 * e3_8
    new_g10 = g10 * e3_0 + g11 * e3_3 + g12 * e3_6
    new_g11 = g10 * e3_1 + g11 * e3_4 + g12 * e3_7
    new_g12 = g10 * e3_2 + g11 * e3_5 + g12 * e3_8
    new_g20 = g20 * e3_0 + g21 * e3_3 + g22 * e3_6
    new_g21 = g20 * e3_1 + g21 * e3_4 + g22 * e3_7
    new_g22 = g20 * e3_2 + g21 * e3_5 + g22 * e3_8
    new_mu0 = g00 * change_0 + g01 * change_1 + g02 * change_2 + mu0
    new_mu1 = g10 * change_0 + g11 * change_1 + g12 * change_2 + mu1
    new_mu2 = g20 * change_0 + g21 * change_1 + g22 * change_2 + mu2
    found = xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2
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
