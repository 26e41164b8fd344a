"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (2.1 sweeps of 306
            operations and 0.05 matrices of 106 a step; fixed point: 3.2 sweeps of
            304 operations; Newton's method with the matrix to first order in h: 2.0
            sweeps of 319 operations and 1.00 matrices of 105)
solved by:  the equations of xi2, n2: Newton's method, 3 unknowns (2.1 sweeps of 381
            operations and 0.05 matrices of 73 a step; fixed point: 3.4 sweeps of
            379 operations; Newton's method with the matrix to first order in h: 2.0
            sweeps of 394 operations and 1.00 matrices of 111)
solved by:  the equations of xi3, n3: Newton's method, 3 unknowns (2.0 sweeps of 387
            operations and 0.05 matrices of 124 a step; fixed point: 3.2 sweeps of
            385 operations; Newton's method with the matrix to first order in h: 1.9
            sweeps of 400 operations and 1.00 matrices of 109)
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
            1 mul (rows)
            6 dexpt (functions)
            1 Adinv (opposites)
            2 Adinv, 3 legendre (sharing)
            1 lin (scalars)
            1 lin (sharing)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 214 add, 340 mul, 5 stumpff_12, 4 sqrt, 4 div a step
            2 mul a start, in steps that follow no other
            29 add, 73 mul, 1 div a matrix of the equations of xi1, n1
            87 add, 136 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi1, n1
            23 add, 46 mul, 1 div a matrix of the equations of xi2, n2
            117 add, 181 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
            the equations of xi2, n2
            41 add, 79 mul, 1 div a matrix of the equations of xi3, n3
            123 add, 181 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
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
        self.first = 0.0
        self.rates = [1.0] * 3
        self.inverses = [None] * 3

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
    w1 = 0.6756035959798288 * h
    w15 = 1.3512071919596575 * h
    w16 = -1.3512071919596575 * h
    w23 = -0.6756035959798288 * h
    # the equations of xi1, n1: Newton's method in xi1_0, xi1_1, xi1_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
        p_2 = 0.01 * xi1_2
        xE1_1_0 = xi1_0 * w1
        xE1_1_1 = xi1_1 * w1
        xE1_1_2 = xi1_2 * w1
        w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2
        c1_1, c2_1 = _stumpff_12(w2)
        w4 = g22 * xE1_1_0 - g20 * xE1_1_2
        w6 = g20 * xE1_1_1 - g21 * xE1_1_0
        w7 = g21 * xE1_1_2 - g22 * xE1_1_1
        Q1_7 = g21 + w4 * c1_1 + (xE1_1_0 * w6 - xE1_1_2 * w7) * c2_1
        Q1_8 = g22 + w6 * c1_1 + (xE1_1_1 * w7 - xE1_1_0 * w4) * c2_1
        w8 = 1.5 - 2.0 * Q1_8
        w9 = 1.0 / sqrt(1.01 + 1.5 * (w8 - 0.2 * Q1_7))
        w10 = w9 * w9 * (0.5 * w9)
        w11 = 1.0 / sqrt(1.01 + 1.5 * (w8 + 0.2 * Q1_7))
        w12 = w11 * w11 * (0.5 * w11)
        w13 = -1.0 - 2.0 * (1.5 * w10 - 1.5 * w12)
        w14 = -0.3 * w10 - 0.3 * w12
        Nr1_0 = Q1_7 * w13 - Q1_8 * w14 + 99.0 * xi1_1 * p_2
        s_mu_0 = m_0 + Nr1_0 * w15
        y1_0 = xi1_0 * w16
        y1_1 = xi1_1 * w16
        y1_2 = xi1_2 * w16
        w17 = y1_0 * y1_0 + y1_1 * y1_1 + y1_2 * y1_2
        c2_2, c3_1 = _stumpff_23(w17)
        Q1_6 = g20 + w7 * c1_1 + (xE1_1_2 * w4 - xE1_1_1 * w6) * c2_1
        Nr1_2 = 0.01 * xi1_0 * xi1_1 + w14 * Q1_6
        s_mu_2 = m_2 + w15 * Nr1_2
        Nr1_1 = -100.0 * xi1_0 * p_2 - w13 * Q1_6
        s_mu_1 = m_1 + w15 * Nr1_1
        w19 = y1_1 * s_mu_2 - y1_2 * s_mu_1
        w21 = y1_0 * s_mu_1 - s_mu_0 * y1_1
        w22 = s_mu_0 * y1_2 - y1_0 * s_mu_2
        p1_4_0 = s_mu_0 - w19 * c2_2 + (y1_1 * w21 - y1_2 * w22) * c3_1
        y1_2_0 = xi1_0 * w23
        y1_2_1 = xi1_1 * w23
        y1_2_2 = xi1_2 * w23
        w24 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w24)
        w26 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2
        w28 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1
        w29 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0
        M1_0 = (
            p1_4_0 + w23 * (Nr1_0 - w26 * c2_3 + (y1_2_1 * w28 - y1_2_2 * w29) * c3_2)
        )
        w30 = xE1_1_1 * c2_1
        w31 = xE1_1_1 * w30
        w32 = xE1_1_2 * c2_1 * xE1_1_2
        gE1_1_0 = 1.0 - (w31 + w32)
        p_0 = 1.01 * xi1_0
        w33 = xE1_1_0 * c2_1
        w34 = xE1_1_1 * w33
        w35 = xE1_1_2 * c1_1
        gE1_1_1 = w34 - w35
        w36 = xE1_1_1 * c1_1
        w37 = xE1_1_2 * w33
        gE1_1_2 = w36 + w37
        a_2_0 = gE1_1_0 * p_0 + xi1_1 * gE1_1_1 + p_2 * gE1_1_2
        residual_0 = M1_0 - a_2_0
        p1_4_1 = s_mu_1 - w22 * c2_2 + (y1_2 * w19 - y1_0 * w21) * c3_1
        M1_1 = (
            p1_4_1 + w23 * (Nr1_1 - w29 * c2_3 + (y1_2_2 * w26 - y1_2_0 * w28) * c3_2)
        )
        gE1_1_3 = w34 + w35
        w38 = xE1_1_0 * w33
        gE1_1_4 = 1.0 - (w32 + w38)
        w39 = xE1_1_2 * w30
        w40 = xE1_1_0 * c1_1
        gE1_1_5 = w39 - w40
        a_2_1 = xi1_1 * gE1_1_4 + p_0 * gE1_1_3 + p_2 * gE1_1_5
        residual_1 = M1_1 - a_2_1
        p1_4_2 = s_mu_2 - w21 * c2_2 + (y1_0 * w22 - y1_1 * w19) * c3_1
        M1_2 = (
            p1_4_2 + w23 * (Nr1_2 - w28 * c2_3 + (y1_2_0 * w29 - y1_2_1 * w26) * c3_2)
        )
        gE1_1_6 = w37 - w36
        gE1_1_7 = w39 + w40
        gE1_1_8 = 1.0 - (w31 + w38)
        a_2_2 = xi1_1 * gE1_1_7 + p_0 * gE1_1_6 + p_2 * gE1_1_8
        residual_2 = M1_2 - a_2_2
        s_mu_0_seen = s_mu_0
        s_mu_1_seen = s_mu_1
        s_mu_2_seen = s_mu_2
        total = residual_0 + residual_1 + residual_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
        if make_1:
            w41 = (
                0.6756035959798288 * g00 * mu0
                + 0.6756035959798288 * g10 * mu1
                + 0.6756035959798288 * g20 * mu2
            )
            w42 = h * (w41 - 1.3512071919596575 * xi1_0)
            w43 = (
                -0.6756035959798288 * g00 * mu0
                - 0.6756035959798288 * g10 * mu1
                - 0.6756035959798288 * g20 * mu2
            )
            w44 = h * (0.013512071919596576 * xi1_0 + w43)
            w45 = 0.01 - w42 * w44
            w46 = (
                0.6756035959798288 * g02 * mu0
                + 0.6756035959798288 * g12 * mu1
                + 0.6756035959798288 * g22 * mu2
            )
            w47 = h * (1.337695120040061 * xi1_2 + w46)
            w48 = (
                0.6756035959798288 * g01 * mu0
                + 0.6756035959798288 * g11 * mu1
                + 0.6756035959798288 * g21 * mu2
            )
            w49 = h * (0.013512071919596576 * xi1_1 + w48)
            w50 = (
                -0.6756035959798288 * g02 * mu0
                - 0.6756035959798288 * g12 * mu1
                - 0.6756035959798288 * g22 * mu2
            )
            w51 = h * (w50 - 1.3512071919596575 * xi1_2)
            w52 = w42 * w49 + 0.01 * w51
            w53 = (
                -0.6756035959798288 * g01 * mu0
                - 0.6756035959798288 * g11 * mu1
                - 0.6756035959798288 * g21 * mu2
            )
            w54 = h * (1.337695120040061 * xi1_1 + w53)
            w55 = w49 + w44 * w51
            w56 = 1.0 / (1.01 * w45 - w47 * w52 - w54 * w55)
            row_1_1 = [
                w45 * w56,
                w56 * (w44 * w54 + 0.01 * w47),
                w56 * (w54 + w42 * w47),
            ]
            row_1_2 = [
                w52 * w56,
                w56 * (0.0101 - w49 * w54),
                w56 * (w51 * w54 + 1.01 * w42),
            ]
            row_1_3 = [
                w55 * w56,
                w56 * (w47 * w49 + 1.01 * w44),
                w56 * (1.01 - w47 * w51),
            ]
            memory.inverses[0] = [row_1_1, row_1_2, row_1_3]
            if statistics is not None:
                statistics.matrices += 1
        row_1_1, row_1_2, row_1_3 = memory.inverses[0]
        d_xi1_0 = (
            row_1_1[0] * residual_0 + row_1_1[1] * residual_1 + row_1_1[2] * residual_2
        )
        d_xi1_1 = (
            row_1_2[0] * residual_0 + row_1_2[1] * residual_1 + row_1_2[2] * residual_2
        )
        d_xi1_2 = (
            row_1_3[0] * residual_0 + row_1_3[1] * residual_1 + row_1_3[2] * residual_2
        )
        xi1_0 += d_xi1_0
        xi1_1 += d_xi1_1
        xi1_2 += d_xi1_2
        change = max(abs(d_xi1_0), abs(d_xi1_1), abs(d_xi1_2))
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
        make_1 = 0.0 < 0.25 * previous_1 < change
        previous_1 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi1, n1", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    xe1_1 = xi1_1 * w15
    xe1_0 = xi1_0 * w15
    w57 = xe1_0 * xe1_0
    w58 = xe1_1 * xe1_1
    w59 = w57 + w58
    xe1_2 = xi1_2 * w15
    w60 = xe1_2 * xe1_2
    w61 = w59 + w60
    c1_2, c2_4 = _stumpff_12(w61)
    w63 = xe1_1 * c2_4
    w64 = xe1_1 * w63
    w65 = xe1_2 * c2_4
    w66 = xe1_2 * w65
    w67 = w64 + w66
    ge1_0 = 1.0 - w67
    w68 = 1.337695120040061 * h
    w69 = xi1_2 * w68
    w70 = d_xi1_1 * w69
    w71 = s_mu_0_seen + w70
    w72 = xi1_1 * w68
    w73 = d_xi1_2 * w72
    w74 = w71 + w73
    w76 = xe1_1 * c1_2
    w77 = xe1_0 * c2_4
    w78 = xe1_2 * w77
    ge1_2 = w76 + w78
    w79 = -0.8512071919596577 * h
    w85 = xe1_2 * w63
    w86 = xe1_0 * c1_2
    ge1_5 = w85 - w86
    w91 = xe1_0 * w77
    w92 = w64 + w91
    ge1_8 = 1.0 - w92
    w98 = xe1_1 * w77
    w99 = xe1_2 * c1_2
    ge1_1 = w98 - w99
    w100 = w66 + w91
    ge1_4 = 1.0 - w100
    ge1_7 = w85 + w86
    w108 = -1.7024143839193153 * h
    y1_2_ = xi1_2 * w16
    w110 = d_xi1_0 * y1_2_
    w111 = s_mu_1_seen + w110
    y1_0_ = xi1_0 * w16
    w112 = d_xi1_2 * y1_0_
    w113 = w111 + w112
    ge1_3 = w98 + w99
    ge1_6 = w78 - w76
    w115 = 0.013512071919596576 * h
    w116 = xi1_1 * w115
    w117 = d_xi1_0 * w116
    w118 = s_mu_2_seen + w117
    w119 = xi1_0 * w115
    w120 = d_xi1_1 * w119
    w121 = w118 + w120
    w123 = 1.7024143839193153 * h
    w130 = 0.8512071919596577 * h
    # the equations of xi2, n2: Newton's method in xi2_0, xi2_1, xi2_2
    previous_2 = 0.0
    rate_2 = memory.rates[1] if memory.past else 1.0
    make_2 = memory.inverses[1] is None
    for sweep in range(1, 101):
        xE2_2_1 = xi2_1 * w79
        xE2_2_0 = xi2_0 * w79
        xE2_2_2 = xi2_2 * w79
        w80 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2
        c1_3, c2_5 = _stumpff_12(w80)
        w82 = xE2_2_1 * c2_5
        w83 = xE2_2_1 * w82
        w84 = xE2_2_2 * c2_5 * xE2_2_2
        gE2_2_0 = 1.0 - (w83 + w84)
        w87 = xE2_2_0 * c2_5
        w88 = xE2_2_1 * w87
        w90 = xE2_2_2 * c1_3
        gE2_2_1 = w88 - w90
        w93 = xE2_2_1 * c1_3
        w94 = xE2_2_2 * w87
        gE2_2_2 = w93 + w94
        E2_2_2 = ge1_2 * gE2_2_0 + ge1_5 * gE2_2_1 + ge1_8 * gE2_2_2
        gE2_2_3 = w88 + w90
        w95 = xE2_2_0 * w87
        gE2_2_4 = 1.0 - (w84 + w95)
        w96 = xE2_2_2 * w82
        w97 = xE2_2_0 * c1_3
        gE2_2_5 = w96 - w97
        E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5
        gE2_2_6 = w94 - w93
        gE2_2_7 = w96 + w97
        gE2_2_8 = 1.0 - (w83 + w95)
        E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8
        a_3_2 = xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8
        p_2_2 = 0.01 * a_3_2
        E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7
        E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7
        E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7
        a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7
        Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7
        Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8
        w101 = 1.5 - 2.0 * Q2_8
        w102 = 1.0 / sqrt(1.01 + 1.5 * (w101 - 0.2 * Q2_7))
        w103 = w102 * w102 * (0.5 * w102)
        w104 = 1.0 / sqrt(1.01 + 1.5 * (w101 + 0.2 * Q2_7))
        w105 = w104 * w104 * (0.5 * w104)
        w106 = -1.0 - 2.0 * (1.5 * w103 - 1.5 * w105)
        w107 = -0.3 * w103 - 0.3 * w105
        Nr2_0 = Q2_7 * w106 - Q2_8 * w107 + 99.0 * a_3_1 * p_2_2
        w109 = Nr2_0 * w108
        s_m2_4_0 = w74 + w109
        E2_2_0 = ge1_0 * gE2_2_0 + gE2_2_1 * ge1_3 + gE2_2_2 * ge1_6
        E2_2_3 = ge1_0 * gE2_2_3 + gE2_2_4 * ge1_3 + gE2_2_5 * ge1_6
        E2_2_6 = ge1_0 * gE2_2_6 + gE2_2_7 * ge1_3 + gE2_2_8 * ge1_6
        a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6
        Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6
        Nr2_1 = -100.0 * a_3_0 * p_2_2 - w106 * Q2_6
        w114 = w108 * Nr2_1
        s_m2_4_1 = w113 + w114
        Nr2_2 = 0.01 * a_3_0 * a_3_1 + w107 * Q2_6
        w122 = w108 * Nr2_2
        s_m2_4_2 = w121 + w122
        m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2
        y2_0 = xi2_0 * w123
        y2_1 = xi2_1 * w123
        y2_2 = xi2_2 * w123
        w124 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2
        c2_6, c3_3 = _stumpff_23(w124)
        m2_4_2_2 = ge1_7 * s_m2_4_1 + s_m2_4_0 * ge1_6 + ge1_8 * s_m2_4_2
        m2_4_2_1 = ge1_4 * s_m2_4_1 + s_m2_4_0 * ge1_3 + ge1_5 * s_m2_4_2
        w126 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1
        w128 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1
        w129 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2
        p2_5_0 = m2_4_2_0 - w126 * c2_6 + (y2_1 * w128 - y2_2 * w129) * c3_3
        m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2
        y2_2_0 = xi2_0 * w130
        y2_2_1 = xi2_1 * w130
        y2_2_2 = xi2_2 * w130
        w131 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2
        c2_7, c3_4 = _stumpff_23(w131)
        m2_3_2 = ge1_7 * Nr2_1 + Nr2_0 * ge1_6 + ge1_8 * Nr2_2
        m2_3_1 = ge1_4 * Nr2_1 + Nr2_0 * ge1_3 + ge1_5 * Nr2_2
        w133 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1
        w135 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1
        w136 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2
        M2_0 = (
            p2_5_0
            + w130 * (m2_3_0 - w133 * c2_7 + (y2_2_1 * w135 - y2_2_2 * w136) * c3_4)
        )
        p_2_0 = 1.01 * a_3_0
        a_6_0 = E2_2_0 * p_2_0 + E2_2_1 * a_3_1 + E2_2_2 * p_2_2
        residual_2_0 = M2_0 - a_6_0
        p2_5_1 = m2_4_2_1 - w129 * c2_6 + (y2_2 * w126 - y2_0 * w128) * c3_3
        M2_1 = (
            p2_5_1
            + w130 * (m2_3_1 - w136 * c2_7 + (y2_2_2 * w133 - y2_2_0 * w135) * c3_4)
        )
        a_6_1 = E2_2_3 * p_2_0 + E2_2_4 * a_3_1 + E2_2_5 * p_2_2
        residual_2_1 = M2_1 - a_6_1
        p2_5_2 = m2_4_2_2 - w128 * c2_6 + (y2_0 * w129 - y2_1 * w126) * c3_3
        M2_2 = (
            p2_5_2
            + w130 * (m2_3_2 - w135 * c2_7 + (y2_2_0 * w136 - y2_2_1 * w133) * c3_4)
        )
        a_6_2 = E2_2_6 * p_2_0 + E2_2_7 * a_3_1 + E2_2_8 * p_2_2
        residual_2_2 = M2_2 - a_6_2
        total = residual_2_0 + residual_2_1 + residual_2_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi2, n2", 1, sweep, statistics)
        if make_2:
            w137 = -1.337695120040061 * xi1_0
            w138 = (
                h
                * (w137 - 0.8512071919596577 * s_mu_0_seen + 1.7024143839193153 * xi2_0)
            )
            w139 = (
                h
                * (0.8512071919596577 * s_mu_0_seen + w137 - 0.01702414383919315 * xi2_0)
            )
            w140 = 0.01 - w138 * w139
            w141 = -0.013512071919596576 * xi1_2
            w142 = (
                h
                * (w141 - 0.8512071919596577 * s_mu_2_seen - 1.6853902400801222 * xi2_2)
            )
            w143 = 1.3512071919596575 * xi1_1
            w144 = (
                h
                * (w143 - 0.8512071919596577 * s_mu_1_seen - 0.01702414383919315 * xi2_1)
            )
            w145 = (
                h
                * (0.8512071919596577 * s_mu_2_seen + w141 + 1.7024143839193153 * xi2_2)
            )
            w146 = w138 * w144 + 0.01 * w145
            w147 = (
                h
                * (0.8512071919596577 * s_mu_1_seen + w143 - 1.6853902400801222 * xi2_1)
            )
            w148 = w144 + w139 * w145
            w149 = 1.0 / (1.01 * w140 - w142 * w146 - w147 * w148)
            row_2_1 = [
                w140 * w149,
                w149 * (w139 * w147 + 0.01 * w142),
                w149 * (w147 + w138 * w142),
            ]
            row_2_2 = [
                w146 * w149,
                w149 * (0.0101 - w144 * w147),
                w149 * (w145 * w147 + 1.01 * w138),
            ]
            row_2_3 = [
                w148 * w149,
                w149 * (w142 * w144 + 1.01 * w139),
                w149 * (1.01 - w142 * w145),
            ]
            memory.inverses[1] = [row_2_1, row_2_2, row_2_3]
            if statistics is not None:
                statistics.matrices += 1
        row_2_1, row_2_2, row_2_3 = memory.inverses[1]
        d_xi2_0 = (
            row_2_1[0] * residual_2_0
            + row_2_1[1] * residual_2_1
            + row_2_1[2] * residual_2_2
        )
        d_xi2_1 = (
            row_2_2[0] * residual_2_0
            + row_2_2[1] * residual_2_1
            + row_2_2[2] * residual_2_2
        )
        d_xi2_2 = (
            row_2_3[0] * residual_2_0
            + row_2_3[1] * residual_2_1
            + row_2_3[2] * residual_2_2
        )
        xi2_0 += d_xi2_0
        xi2_1 += d_xi2_1
        xi2_2 += d_xi2_2
        change = max(abs(d_xi2_0), abs(d_xi2_1), abs(d_xi2_2))
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
        make_2 = 0.0 < 0.25 * previous_2 < change
        previous_2 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi2, n2", 1, sweep, statistics)
    if statistics is not None:
        statistics.count(1, sweep)
    xe2_1 = xi2_1 * w108
    xe2_0 = xi2_0 * w108
    w150 = xe2_0 * xe2_0
    w151 = xe2_1 * xe2_1
    w152 = w150 + w151
    xe2_2 = xi2_2 * w108
    w153 = xe2_2 * xe2_2
    w154 = w152 + w153
    c1_4, c2_8 = _stumpff_12(w154)
    w156 = xe2_1 * c2_8
    w157 = xe2_1 * w156
    w158 = xe2_2 * c2_8
    w159 = xe2_2 * w158
    w160 = w157 + w159
    ge2_0 = 1.0 - w160
    w161 = ge1_0 * ge2_0
    w162 = xe2_0 * c2_8
    w163 = xe2_1 * w162
    w165 = xe2_2 * c1_4
    ge2_1 = w163 - w165
    w166 = ge1_3 * ge2_1
    w167 = w161 + w166
    w168 = xe2_1 * c1_4
    w169 = xe2_2 * w162
    ge2_2 = w168 + w169
    w170 = ge1_6 * ge2_2
    e2_0 = w167 + w170
    xE2_2_1_ = xi2_1 * w79
    xE2_2_0_ = xi2_0 * w79
    w171 = xE2_2_0_ * xE2_2_0_
    w172 = xE2_2_1_ * xE2_2_1_
    w173 = w171 + w172
    xE2_2_2_ = xi2_2 * w79
    w174 = xE2_2_2_ * xE2_2_2_
    w175 = w173 + w174
    c1_5, c2_9 = _stumpff_12(w175)
    w177 = xE2_2_1_ * c2_9
    w178 = xE2_2_1_ * w177
    w179 = xE2_2_2_ * c2_9
    w180 = xE2_2_2_ * w179
    w181 = w178 + w180
    gE2_2_0_ = 1.0 - w181
    w182 = ge1_2 * gE2_2_0_
    w183 = xE2_2_0_ * c2_9
    w184 = xE2_2_1_ * w183
    w186 = xE2_2_2_ * c1_5
    gE2_2_1_ = w184 - w186
    w187 = ge1_5 * gE2_2_1_
    w188 = w182 + w187
    w189 = xE2_2_1_ * c1_5
    w190 = xE2_2_2_ * w183
    gE2_2_2_ = w189 + w190
    w191 = ge1_8 * gE2_2_2_
    E2_2_2_ = w188 + w191
    w192 = xi2_0 * E2_2_2_
    gE2_2_3_ = w184 + w186
    w193 = ge1_2 * gE2_2_3_
    w194 = xE2_2_0_ * w183
    w195 = w180 + w194
    gE2_2_4_ = 1.0 - w195
    w196 = ge1_5 * gE2_2_4_
    w197 = w193 + w196
    w198 = xE2_2_2_ * w177
    w199 = xE2_2_0_ * c1_5
    gE2_2_5_ = w198 - w199
    w200 = ge1_8 * gE2_2_5_
    E2_2_5_ = w197 + w200
    w201 = xi2_1 * E2_2_5_
    w202 = w192 + w201
    gE2_2_6_ = w190 - w189
    w203 = ge1_2 * gE2_2_6_
    gE2_2_7_ = w198 + w199
    w204 = ge1_5 * gE2_2_7_
    w205 = w203 + w204
    w206 = w178 + w194
    gE2_2_8_ = 1.0 - w206
    w207 = ge1_8 * gE2_2_8_
    E2_2_8_ = w205 + w207
    w208 = xi2_2 * E2_2_8_
    a_3_2_ = w202 + w208
    p_2_2_ = 0.01 * a_3_2_
    w209 = ge1_1 * gE2_2_0_
    w210 = ge1_4 * gE2_2_1_
    w211 = w209 + w210
    w212 = ge1_7 * gE2_2_2_
    E2_2_1_ = w211 + w212
    w213 = xi2_0 * E2_2_1_
    w214 = ge1_1 * gE2_2_3_
    w215 = ge1_4 * gE2_2_4_
    w216 = w214 + w215
    w217 = ge1_7 * gE2_2_5_
    E2_2_4_ = w216 + w217
    w218 = xi2_1 * E2_2_4_
    w219 = w213 + w218
    w220 = ge1_1 * gE2_2_6_
    w221 = ge1_4 * gE2_2_7_
    w222 = w220 + w221
    w223 = ge1_7 * gE2_2_8_
    E2_2_7_ = w222 + w223
    w224 = xi2_2 * E2_2_7_
    a_3_1_ = w219 + w224
    w225 = 99.0 * a_3_1_
    w226 = p_2_2_ * w225
    w227 = g20 * E2_2_1_
    w228 = g21 * E2_2_4_
    w229 = w227 + w228
    w230 = g22 * E2_2_7_
    Q2_7_ = w229 + w230
    w231 = g20 * E2_2_2_
    w232 = g21 * E2_2_5_
    w233 = w231 + w232
    w234 = g22 * E2_2_8_
    Q2_8_ = w233 + w234
    w235 = -2.0 * Q2_8_
    w236 = 1.5 + w235
    w237 = -0.2 * Q2_7_
    w238 = w236 + w237
    w239 = 1.5 * w238
    w240 = 1.01 + w239
    w241 = sqrt(w240)
    w242 = 1.0 / w241
    w243 = w242 * w242
    w244 = 0.5 * w242
    w245 = w243 * w244
    w246 = 1.5 * w245
    w247 = 0.2 * Q2_7_
    w248 = w236 + w247
    w249 = 1.5 * w248
    w250 = 1.01 + w249
    w251 = sqrt(w250)
    w252 = 1.0 / w251
    w253 = w252 * w252
    w254 = 0.5 * w252
    w255 = w253 * w254
    w256 = 1.5 * w255
    w257 = w246 - w256
    w258 = -2.0 * w257
    w259 = w258 - 1.0
    w260 = Q2_7_ * w259
    w261 = -0.3 * w245
    w262 = -0.3 * w255
    w263 = w261 + w262
    w264 = Q2_8_ * w263
    w265 = w260 - w264
    Nr2_0_ = w226 + w265
    w266 = w108 * Nr2_0_
    p_2_ = 0.01 * xi1_2
    w267 = 99.0 * xi1_1
    w268 = p_2_ * w267
    xE1_1_0_ = xi1_0 * w1
    w269 = xE1_1_0_ * xE1_1_0_
    xE1_1_1_ = xi1_1 * w1
    w270 = xE1_1_1_ * xE1_1_1_
    w271 = w269 + w270
    xE1_1_2_ = xi1_2 * w1
    w272 = xE1_1_2_ * xE1_1_2_
    w273 = w271 + w272
    c1_6, c2_10 = _stumpff_12(w273)
    w275 = g22 * xE1_1_0_
    w276 = g20 * xE1_1_2_
    w277 = w275 - w276
    w278 = w277 * c1_6
    w279 = g21 + w278
    w281 = g20 * xE1_1_1_
    w282 = g21 * xE1_1_0_
    w283 = w281 - w282
    w284 = xE1_1_0_ * w283
    w285 = g21 * xE1_1_2_
    w286 = g22 * xE1_1_1_
    w287 = w285 - w286
    w288 = xE1_1_2_ * w287
    w289 = w284 - w288
    w290 = w289 * c2_10
    Q1_7_ = w279 + w290
    w291 = w283 * c1_6
    w292 = g22 + w291
    w293 = xE1_1_1_ * w287
    w294 = xE1_1_0_ * w277
    w295 = w293 - w294
    w296 = w295 * c2_10
    Q1_8_ = w292 + w296
    w297 = -2.0 * Q1_8_
    w298 = 1.5 + w297
    w299 = -0.2 * Q1_7_
    w300 = w298 + w299
    w301 = 1.5 * w300
    w302 = 1.01 + w301
    w303 = sqrt(w302)
    w304 = 1.0 / w303
    w305 = w304 * w304
    w306 = 0.5 * w304
    w307 = w305 * w306
    w308 = 1.5 * w307
    w309 = 0.2 * Q1_7_
    w310 = w298 + w309
    w311 = 1.5 * w310
    w312 = 1.01 + w311
    w313 = sqrt(w312)
    w314 = 1.0 / w313
    w315 = w314 * w314
    w316 = 0.5 * w314
    w317 = w315 * w316
    w318 = 1.5 * w317
    w319 = w308 - w318
    w320 = -2.0 * w319
    w321 = w320 - 1.0
    w322 = Q1_7_ * w321
    w323 = -0.3 * w307
    w324 = -0.3 * w317
    w325 = w323 + w324
    w326 = Q1_8_ * w325
    w327 = w322 - w326
    Nr1_0_ = w268 + w327
    w328 = ge1_2 * ge2_0
    w329 = ge1_5 * ge2_1
    w330 = w328 + w329
    w331 = ge1_8 * ge2_2
    e2_2 = w330 + w331
    ge2_3 = w163 + w165
    w337 = ge1_2 * ge2_3
    w338 = xe2_0 * w162
    w339 = w159 + w338
    ge2_4 = 1.0 - w339
    w340 = ge1_5 * ge2_4
    w341 = w337 + w340
    w342 = xe2_2 * w156
    w343 = xe2_0 * c1_4
    ge2_5 = w342 - w343
    w344 = ge1_8 * ge2_5
    e2_5 = w341 + w344
    ge2_6 = w169 - w168
    w349 = ge1_2 * ge2_6
    ge2_7 = w342 + w343
    w350 = ge1_5 * ge2_7
    w351 = w349 + w350
    w352 = w157 + w338
    ge2_8 = 1.0 - w352
    w353 = ge1_8 * ge2_8
    e2_8 = w351 + w353
    w359 = ge1_1 * ge2_0
    w360 = ge1_4 * ge2_1
    w361 = w359 + w360
    w362 = ge1_7 * ge2_2
    e2_1 = w361 + w362
    w363 = ge1_1 * ge2_3
    w364 = ge1_4 * ge2_4
    w365 = w363 + w364
    w366 = ge1_7 * ge2_5
    e2_4 = w365 + w366
    w367 = ge1_1 * ge2_6
    w368 = ge1_4 * ge2_7
    w369 = w367 + w368
    w370 = ge1_7 * ge2_8
    e2_7 = w369 + w370
    w378 = ge1_0 * gE2_2_0_
    w379 = ge1_3 * gE2_2_1_
    w380 = w378 + w379
    w381 = ge1_6 * gE2_2_2_
    E2_2_0_ = w380 + w381
    w382 = xi2_0 * E2_2_0_
    w383 = ge1_0 * gE2_2_3_
    w384 = ge1_3 * gE2_2_4_
    w385 = w383 + w384
    w386 = ge1_6 * gE2_2_5_
    E2_2_3_ = w385 + w386
    w387 = xi2_1 * E2_2_3_
    w388 = w382 + w387
    w389 = ge1_0 * gE2_2_6_
    w390 = ge1_3 * gE2_2_7_
    w391 = w389 + w390
    w392 = ge1_6 * gE2_2_8_
    E2_2_6_ = w391 + w392
    w393 = xi2_2 * E2_2_6_
    a_3_0_ = w388 + w393
    w394 = -100.0 * a_3_0_
    w395 = p_2_2_ * w394
    w396 = g20 * E2_2_0_
    w397 = g21 * E2_2_3_
    w398 = w396 + w397
    w399 = g22 * E2_2_6_
    Q2_6_ = w398 + w399
    w400 = w259 * Q2_6_
    Nr2_1_ = w395 - w400
    w401 = w108 * Nr2_1_
    w402 = -100.0 * xi1_0
    w403 = p_2_ * w402
    w404 = w287 * c1_6
    w405 = g20 + w404
    w406 = xE1_1_2_ * w277
    w407 = xE1_1_1_ * w283
    w408 = w406 - w407
    w409 = w408 * c2_10
    Q1_6_ = w405 + w409
    w410 = w321 * Q1_6_
    Nr1_1_ = w403 - w410
    w411 = ge1_0 * ge2_3
    w412 = ge1_3 * ge2_4
    w413 = w411 + w412
    w414 = ge1_6 * ge2_5
    e2_3 = w413 + w414
    w415 = ge1_0 * ge2_6
    w416 = ge1_3 * ge2_7
    w417 = w415 + w416
    w418 = ge1_6 * ge2_8
    e2_6 = w417 + w418
    w419 = 0.01 * a_3_0_
    w420 = a_3_1_ * w419
    w421 = w263 * Q2_6_
    Nr2_2_ = w420 + w421
    w422 = w108 * Nr2_2_
    w423 = 0.01 * xi1_0
    w424 = xi1_1 * w423
    w425 = w325 * Q1_6_
    Nr1_2_ = w424 + w425
    # the equations of xi3, n3: Newton's method in xi3_0, xi3_1, xi3_2
    previous_3 = 0.0
    rate_3 = memory.rates[2] if memory.past else 1.0
    make_3 = memory.inverses[2] is None
    for sweep in range(1, 101):
        xE3_3_1 = xi3_1 * w1
        xE3_3_0 = xi3_0 * w1
        xE3_3_2 = xi3_2 * w1
        w332 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2
        c1_7, c2_11 = _stumpff_12(w332)
        w334 = xE3_3_1 * c2_11
        w335 = xE3_3_1 * w334
        w336 = xE3_3_2 * c2_11 * xE3_3_2
        gE3_3_0 = 1.0 - (w335 + w336)
        w345 = xE3_3_0 * c2_11
        w346 = xE3_3_1 * w345
        w348 = xE3_3_2 * c1_7
        gE3_3_1 = w346 - w348
        w354 = xE3_3_1 * c1_7
        w355 = xE3_3_2 * w345
        gE3_3_2 = w354 + w355
        E3_3_2 = e2_2 * gE3_3_0 + e2_5 * gE3_3_1 + e2_8 * gE3_3_2
        gE3_3_3 = w346 + w348
        w356 = xE3_3_0 * w345
        gE3_3_4 = 1.0 - (w336 + w356)
        w357 = xE3_3_2 * w334
        w358 = xE3_3_0 * c1_7
        gE3_3_5 = w357 - w358
        E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5
        gE3_3_6 = w355 - w354
        gE3_3_7 = w357 + w358
        gE3_3_8 = 1.0 - (w335 + w356)
        E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8
        a_5_2 = xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8
        p_3_2 = 0.01 * a_5_2
        E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7
        E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7
        E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7
        a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7
        Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7
        Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8
        w371 = 1.5 - 2.0 * Q3_8
        w372 = 1.0 / sqrt(1.01 + 1.5 * (w371 - 0.2 * Q3_7))
        w373 = w372 * w372 * (0.5 * w372)
        w374 = 1.0 / sqrt(1.01 + 1.5 * (w371 + 0.2 * Q3_7))
        w375 = w374 * w374 * (0.5 * w374)
        w376 = -1.0 - 2.0 * (1.5 * w373 - 1.5 * w375)
        w377 = -0.3 * w373 - 0.3 * w375
        Nr3_0 = Q3_7 * w376 - Q3_8 * w377 + 99.0 * a_5_1 * p_3_2
        s_m3_5_0 = m_0 + w15 * (Nr1_0_ + Nr3_0) + w266
        E3_3_0 = e2_0 * gE3_3_0 + gE3_3_1 * e2_3 + gE3_3_2 * e2_6
        E3_3_3 = e2_0 * gE3_3_3 + gE3_3_4 * e2_3 + gE3_3_5 * e2_6
        E3_3_6 = e2_0 * gE3_3_6 + gE3_3_7 * e2_3 + gE3_3_8 * e2_6
        a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6
        Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6
        Nr3_1 = -100.0 * a_5_0 * p_3_2 - w376 * Q3_6
        s_m3_5_1 = m_1 + w15 * (Nr1_1_ + Nr3_1) + w401
        Nr3_2 = 0.01 * a_5_0 * a_5_1 + w377 * Q3_6
        s_m3_5_2 = m_2 + w15 * (Nr1_2_ + Nr3_2) + w422
        m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2
        y3_0 = xi3_0 * w16
        y3_1 = xi3_1 * w16
        y3_2 = xi3_2 * w16
        w426 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2
        c2_12, c3_5 = _stumpff_23(w426)
        m3_5_2_2 = e2_7 * s_m3_5_1 + s_m3_5_0 * e2_6 + e2_8 * s_m3_5_2
        m3_5_2_1 = e2_4 * s_m3_5_1 + s_m3_5_0 * e2_3 + e2_5 * s_m3_5_2
        w428 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1
        w430 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1
        w431 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2
        p3_6_0 = m3_5_2_0 - w428 * c2_12 + (y3_1 * w430 - y3_2 * w431) * c3_5
        m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2
        y3_2_0 = xi3_0 * w23
        y3_2_1 = xi3_1 * w23
        y3_2_2 = xi3_2 * w23
        w432 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2
        c2_13, c3_6 = _stumpff_23(w432)
        m3_4_2 = e2_7 * Nr3_1 + Nr3_0 * e2_6 + e2_8 * Nr3_2
        m3_4_1 = e2_4 * Nr3_1 + Nr3_0 * e2_3 + e2_5 * Nr3_2
        w434 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1
        w436 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1
        w437 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2
        M3_0 = (
            p3_6_0
            + w23 * (m3_4_0 - w434 * c2_13 + (y3_2_1 * w436 - y3_2_2 * w437) * c3_6)
        )
        p_3_0 = 1.01 * a_5_0
        a_8_0 = E3_3_0 * p_3_0 + E3_3_1 * a_5_1 + E3_3_2 * p_3_2
        residual_3_0 = M3_0 - a_8_0
        p3_6_1 = m3_5_2_1 - w431 * c2_12 + (y3_2 * w428 - y3_0 * w430) * c3_5
        M3_1 = (
            p3_6_1
            + w23 * (m3_4_1 - w437 * c2_13 + (y3_2_2 * w434 - y3_2_0 * w436) * c3_6)
        )
        a_8_1 = E3_3_3 * p_3_0 + E3_3_4 * a_5_1 + E3_3_5 * p_3_2
        residual_3_1 = M3_1 - a_8_1
        p3_6_2 = m3_5_2_2 - w430 * c2_12 + (y3_0 * w431 - y3_1 * w428) * c3_5
        M3_2 = (
            p3_6_2
            + w23 * (m3_4_2 - w436 * c2_13 + (y3_2_0 * w437 - y3_2_1 * w434) * c3_6)
        )
        a_8_2 = E3_3_6 * p_3_0 + E3_3_7 * a_5_1 + E3_3_8 * p_3_2
        residual_3_2 = M3_2 - a_8_2
        s_m3_5_0_seen = s_m3_5_0
        s_m3_5_1_seen = s_m3_5_1
        s_m3_5_2_seen = s_m3_5_2
        total = residual_3_0 + residual_3_1 + residual_3_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi3, n3", 2, sweep, statistics)
        if make_3:
            w438 = 1.6853902400801222 * xi2_0
            w439 = (
                0.6756035959798288 * g00 * mu0
                + 0.6756035959798288 * g10 * mu1
                + 0.6756035959798288 * g20 * mu2
            )
            w440 = -1.337695120040061 * xi1_0
            w441 = h * (w439 + w440 + w438 - 1.3512071919596575 * xi3_0)
            w442 = (
                -0.6756035959798288 * g00 * mu0
                - 0.6756035959798288 * g10 * mu1
                - 0.6756035959798288 * g20 * mu2
            )
            w443 = h * (w440 + w442 + w438 + 0.013512071919596576 * xi3_0)
            w444 = 0.01 - w441 * w443
            w445 = 0.01702414383919315 * xi2_2
            w446 = (
                0.6756035959798288 * g02 * mu0
                + 0.6756035959798288 * g12 * mu1
                + 0.6756035959798288 * g22 * mu2
            )
            w447 = -0.013512071919596576 * xi1_2
            w448 = h * (w446 + w447 + w445 + 1.337695120040061 * xi3_2)
            w449 = -1.7024143839193153 * xi2_1
            w450 = (
                0.6756035959798288 * g01 * mu0
                + 0.6756035959798288 * g11 * mu1
                + 0.6756035959798288 * g21 * mu2
            )
            w451 = 1.3512071919596575 * xi1_1
            w452 = h * (w450 + w451 + w449 + 0.013512071919596576 * xi3_1)
            w453 = (
                -0.6756035959798288 * g02 * mu0
                - 0.6756035959798288 * g12 * mu1
                - 0.6756035959798288 * g22 * mu2
            )
            w454 = h * (w447 + w453 + w445 - 1.3512071919596575 * xi3_2)
            w455 = w441 * w452 + 0.01 * w454
            w456 = (
                -0.6756035959798288 * g01 * mu0
                - 0.6756035959798288 * g11 * mu1
                - 0.6756035959798288 * g21 * mu2
            )
            w457 = h * (w451 + w456 + w449 + 1.337695120040061 * xi3_1)
            w458 = w452 + w443 * w454
            w459 = 1.0 / (1.01 * w444 - w448 * w455 - w457 * w458)
            row_3_1 = [
                w444 * w459,
                w459 * (w443 * w457 + 0.01 * w448),
                w459 * (w457 + w441 * w448),
            ]
            row_3_2 = [
                w455 * w459,
                w459 * (0.0101 - w452 * w457),
                w459 * (w454 * w457 + 1.01 * w441),
            ]
            row_3_3 = [
                w458 * w459,
                w459 * (w448 * w452 + 1.01 * w443),
                w459 * (1.01 - w448 * w454),
            ]
            memory.inverses[2] = [row_3_1, row_3_2, row_3_3]
            if statistics is not None:
                statistics.matrices += 1
        row_3_1, row_3_2, row_3_3 = memory.inverses[2]
        d_xi3_0 = (
            row_3_1[0] * residual_3_0
            + row_3_1[1] * residual_3_1
            + row_3_1[2] * residual_3_2
        )
        d_xi3_1 = (
            row_3_2[0] * residual_3_0
            + row_3_2[1] * residual_3_1
            + row_3_2[2] * residual_3_2
        )
        d_xi3_2 = (
            row_3_3[0] * residual_3_0
            + row_3_3[1] * residual_3_1
            + row_3_3[2] * residual_3_2
        )
        xi3_0 += d_xi3_0
        xi3_1 += d_xi3_1
        xi3_2 += d_xi3_2
        change = max(abs(d_xi3_0), abs(d_xi3_1), abs(d_xi3_2))
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
        make_3 = 0.0 < 0.25 * previous_3 < change
        previous_3 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi3, n3", 2, sweep, statistics)
    if statistics is not None:
        statistics.count(2, sweep)
    xe3_1 = xi3_1 * w15
    xe3_0 = xi3_0 * w15
    xe3_2 = xi3_2 * w15
    w460 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2
    c1_8, c2_14 = _stumpff_12(w460)
    w462 = xe3_1 * c2_14
    w463 = xe3_1 * w462
    w464 = xe3_2 * c2_14 * xe3_2
    ge3_0 = 1.0 - (w463 + w464)
    w465 = xe3_0 * c2_14
    w466 = xe3_1 * w465
    w468 = xe3_2 * c1_8
    ge3_1 = w466 - w468
    w469 = xe3_1 * c1_8
    w470 = xe3_2 * w465
    ge3_2 = w469 + w470
    e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2
    ge3_3 = w466 + w468
    w471 = xe3_0 * w465
    ge3_4 = 1.0 - (w464 + w471)
    w472 = xe3_2 * w462
    w473 = xe3_0 * c1_8
    ge3_5 = w472 - w473
    e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5
    ge3_6 = w470 - w469
    ge3_7 = w472 + w473
    ge3_8 = 1.0 - (w463 + w471)
    e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8
    e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2
    e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5
    e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8
    e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2
    e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5
    e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8
    w474 = s_m3_5_0_seen + xi3_2 * w68 * d_xi3_1 + xi3_1 * w68 * d_xi3_2
    y3_2_ = xi3_2 * w16
    y3_0_ = xi3_0 * w16
    w475 = s_m3_5_1_seen + d_xi3_0 * y3_2_ + d_xi3_2 * y3_0_
    w476 = s_m3_5_2_seen + xi3_1 * w115 * d_xi3_0 + xi3_0 * w115 * d_xi3_1
    change_0 = e3_0 * w474 + e3_1 * w475 + e3_2 * w476 - m_0
    change_1 = e3_3 * w474 + e3_4 * w475 + e3_5 * w476 - m_1
    change_2 = e3_6 * w474 + e3_7 * w475 + e3_8 * w476 - m_2
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
