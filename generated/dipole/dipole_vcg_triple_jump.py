"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (2.1 sweeps of 291
            operations and 0.05 matrices of 106 a step; fixed point: 3.2 sweeps of
            289 operations; Newton's method with the matrix to first order in h: 1.9
            sweeps of 304 operations and 1.00 matrices of 105)
solved by:  the equations of xi2, n2: Newton's method, 3 unknowns (2.0 sweeps of 381
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
            6 dexpt (functions)
            1 Adinv (opposites)
            2 Adinv, 3 legendre (sharing)
            1 lin (scalars)
            1 lin (sharing)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 220 add, 343 mul, 5 stumpff_12, 4 sqrt, 4 div a step
            2 mul a start, in steps that follow no other
            29 add, 73 mul, 1 div a matrix of the equations of xi1, n1
            81 add, 127 mul, 2 div, 2 sqrt, 1 stumpff_12, 2 stumpff_23 a sweep of
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
    w23 = 1.3512071919596575 * h
    w24 = -1.3512071919596575 * h
    w31 = -0.6756035959798288 * h
    # the equations of xi1, n1: Newton's method in xi1_0, xi1_1, xi1_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
        p_2 = 0.01 * xi1_2
        xE1_1_1 = xi1_1 * w1
        xE1_1_0 = xi1_0 * w1
        xE1_1_2 = xi1_2 * w1
        w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2
        c1_1, c2_1 = _stumpff_12(w2)
        w4 = xE1_1_0 * c2_1
        w5 = xE1_1_1 * w4
        w7 = xE1_1_2 * c1_1
        gE1_1_1 = w5 - w7
        w8 = xE1_1_0 * w4
        w9 = xE1_1_2 * c2_1 * xE1_1_2
        gE1_1_4 = 1.0 - (w8 + w9)
        w10 = xE1_1_0 * c1_1
        w11 = xE1_1_1 * c2_1
        w12 = xE1_1_2 * w11
        gE1_1_7 = w10 + w12
        Q1_7 = g20 * gE1_1_1 + g21 * gE1_1_4 + g22 * gE1_1_7
        w13 = xE1_1_1 * c1_1
        w14 = xE1_1_2 * w4
        gE1_1_2 = w13 + w14
        gE1_1_5 = w12 - w10
        w15 = xE1_1_1 * w11
        gE1_1_8 = 1.0 - (w8 + w15)
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
        gE1_1_0 = 1.0 - (w9 + w15)
        gE1_1_3 = w5 + w7
        gE1_1_6 = w14 - w13
        Q1_6 = g20 * gE1_1_0 + g21 * gE1_1_3 + g22 * gE1_1_6
        Nr1_2 = 0.01 * xi1_0 * xi1_1 + w22 * Q1_6
        s_mu_2 = m_2 + w23 * Nr1_2
        Nr1_1 = -100.0 * xi1_0 * p_2 - w21 * Q1_6
        s_mu_1 = m_1 + w23 * Nr1_1
        w27 = y1_1 * s_mu_2 - y1_2 * s_mu_1
        w29 = y1_0 * s_mu_1 - s_mu_0 * y1_1
        w30 = s_mu_0 * y1_2 - y1_0 * s_mu_2
        p1_4_0 = s_mu_0 - w27 * c2_2 + (y1_1 * w29 - y1_2 * w30) * c3_1
        y1_2_0 = xi1_0 * w31
        y1_2_1 = xi1_1 * w31
        y1_2_2 = xi1_2 * w31
        w32 = y1_2_0 * y1_2_0 + y1_2_1 * y1_2_1 + y1_2_2 * y1_2_2
        c2_3, c3_2 = _stumpff_23(w32)
        w34 = Nr1_2 * y1_2_1 - Nr1_1 * y1_2_2
        w36 = Nr1_1 * y1_2_0 - Nr1_0 * y1_2_1
        w37 = Nr1_0 * y1_2_2 - Nr1_2 * y1_2_0
        M1_0 = (
            p1_4_0 + w31 * (Nr1_0 - w34 * c2_3 + (y1_2_1 * w36 - y1_2_2 * w37) * c3_2)
        )
        p_0 = 1.01 * xi1_0
        a_2_0 = gE1_1_0 * p_0 + xi1_1 * gE1_1_1 + p_2 * gE1_1_2
        residual_0 = M1_0 - a_2_0
        p1_4_1 = s_mu_1 - w30 * c2_2 + (y1_2 * w27 - y1_0 * w29) * c3_1
        M1_1 = (
            p1_4_1 + w31 * (Nr1_1 - w37 * c2_3 + (y1_2_2 * w34 - y1_2_0 * w36) * c3_2)
        )
        a_2_1 = gE1_1_3 * p_0 + xi1_1 * gE1_1_4 + p_2 * gE1_1_5
        residual_1 = M1_1 - a_2_1
        p1_4_2 = s_mu_2 - w29 * c2_2 + (y1_0 * w30 - y1_1 * w27) * c3_1
        M1_2 = (
            p1_4_2 + w31 * (Nr1_2 - w36 * c2_3 + (y1_2_0 * w37 - y1_2_1 * w34) * c3_2)
        )
        a_2_2 = gE1_1_6 * p_0 + xi1_1 * gE1_1_7 + p_2 * gE1_1_8
        residual_2 = M1_2 - a_2_2
        s_mu_0_seen = s_mu_0
        s_mu_1_seen = s_mu_1
        s_mu_2_seen = s_mu_2
        total = residual_0 + residual_1 + residual_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
        if make_1:
            w38 = (
                0.6756035959798288 * g00 * mu0
                + 0.6756035959798288 * g10 * mu1
                + 0.6756035959798288 * g20 * mu2
            )
            w39 = h * (w38 - 1.3512071919596575 * xi1_0)
            w40 = (
                -0.6756035959798288 * g00 * mu0
                - 0.6756035959798288 * g10 * mu1
                - 0.6756035959798288 * g20 * mu2
            )
            w41 = h * (0.013512071919596576 * xi1_0 + w40)
            w42 = 0.01 - w39 * w41
            w43 = (
                0.6756035959798288 * g02 * mu0
                + 0.6756035959798288 * g12 * mu1
                + 0.6756035959798288 * g22 * mu2
            )
            w44 = h * (1.337695120040061 * xi1_2 + w43)
            w45 = (
                0.6756035959798288 * g01 * mu0
                + 0.6756035959798288 * g11 * mu1
                + 0.6756035959798288 * g21 * mu2
            )
            w46 = h * (0.013512071919596576 * xi1_1 + w45)
            w47 = (
                -0.6756035959798288 * g02 * mu0
                - 0.6756035959798288 * g12 * mu1
                - 0.6756035959798288 * g22 * mu2
            )
            w48 = h * (w47 - 1.3512071919596575 * xi1_2)
            w49 = w39 * w46 + 0.01 * w48
            w50 = (
                -0.6756035959798288 * g01 * mu0
                - 0.6756035959798288 * g11 * mu1
                - 0.6756035959798288 * g21 * mu2
            )
            w51 = h * (1.337695120040061 * xi1_1 + w50)
            w52 = w46 + w41 * w48
            w53 = 1.0 / (1.01 * w42 - w44 * w49 - w51 * w52)
            row_1_1 = [
                w42 * w53,
                w53 * (w41 * w51 + 0.01 * w44),
                w53 * (w51 + w39 * w44),
            ]
            row_1_2 = [
                w49 * w53,
                w53 * (0.0101 - w46 * w51),
                w53 * (w48 * w51 + 1.01 * w39),
            ]
            row_1_3 = [
                w52 * w53,
                w53 * (w44 * w46 + 1.01 * w41),
                w53 * (1.01 - w44 * w48),
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
    xe1_1 = xi1_1 * w23
    xe1_0 = xi1_0 * w23
    w54 = xe1_0 * xe1_0
    w55 = xe1_1 * xe1_1
    w56 = w54 + w55
    xe1_2 = xi1_2 * w23
    w57 = xe1_2 * xe1_2
    w58 = w56 + w57
    c1_2, c2_4 = _stumpff_12(w58)
    w60 = xe1_1 * c2_4
    w61 = xe1_1 * w60
    w62 = xe1_2 * c2_4
    w63 = xe1_2 * w62
    w64 = w61 + w63
    ge1_0 = 1.0 - w64
    w65 = 1.337695120040061 * h
    w66 = xi1_2 * w65
    w67 = d_xi1_1 * w66
    w68 = s_mu_0_seen + w67
    w69 = xi1_1 * w65
    w70 = d_xi1_2 * w69
    w71 = w68 + w70
    w73 = xe1_1 * c1_2
    w74 = xe1_0 * c2_4
    w75 = xe1_2 * w74
    ge1_2 = w73 + w75
    w76 = -0.8512071919596577 * h
    w82 = xe1_2 * w60
    w83 = xe1_0 * c1_2
    ge1_5 = w82 - w83
    w88 = xe1_0 * w74
    w89 = w61 + w88
    ge1_8 = 1.0 - w89
    w95 = xe1_1 * w74
    w96 = xe1_2 * c1_2
    ge1_1 = w95 - w96
    w97 = w63 + w88
    ge1_4 = 1.0 - w97
    ge1_7 = w82 + w83
    w105 = -1.7024143839193153 * h
    y1_2_ = xi1_2 * w24
    w107 = d_xi1_0 * y1_2_
    w108 = s_mu_1_seen + w107
    y1_0_ = xi1_0 * w24
    w109 = d_xi1_2 * y1_0_
    w110 = w108 + w109
    ge1_3 = w95 + w96
    ge1_6 = w75 - w73
    w112 = 0.013512071919596576 * h
    w113 = xi1_1 * w112
    w114 = d_xi1_0 * w113
    w115 = s_mu_2_seen + w114
    w116 = xi1_0 * w112
    w117 = d_xi1_1 * w116
    w118 = w115 + w117
    w120 = 1.7024143839193153 * h
    w127 = 0.8512071919596577 * h
    # the equations of xi2, n2: Newton's method in xi2_0, xi2_1, xi2_2
    previous_2 = 0.0
    rate_2 = memory.rates[1] if memory.past else 1.0
    make_2 = memory.inverses[1] is None
    for sweep in range(1, 101):
        xE2_2_1 = xi2_1 * w76
        xE2_2_0 = xi2_0 * w76
        xE2_2_2 = xi2_2 * w76
        w77 = xE2_2_0 * xE2_2_0 + xE2_2_1 * xE2_2_1 + xE2_2_2 * xE2_2_2
        c1_3, c2_5 = _stumpff_12(w77)
        w79 = xE2_2_1 * c2_5
        w80 = xE2_2_1 * w79
        w81 = xE2_2_2 * c2_5 * xE2_2_2
        gE2_2_0 = 1.0 - (w80 + w81)
        w84 = xE2_2_0 * c2_5
        w85 = xE2_2_1 * w84
        w87 = xE2_2_2 * c1_3
        gE2_2_1 = w85 - w87
        w90 = xE2_2_1 * c1_3
        w91 = xE2_2_2 * w84
        gE2_2_2 = w90 + w91
        E2_2_2 = ge1_2 * gE2_2_0 + ge1_5 * gE2_2_1 + ge1_8 * gE2_2_2
        gE2_2_3 = w85 + w87
        w92 = xE2_2_0 * w84
        gE2_2_4 = 1.0 - (w81 + w92)
        w93 = xE2_2_2 * w79
        w94 = xE2_2_0 * c1_3
        gE2_2_5 = w93 - w94
        E2_2_5 = ge1_2 * gE2_2_3 + ge1_5 * gE2_2_4 + ge1_8 * gE2_2_5
        gE2_2_6 = w91 - w90
        gE2_2_7 = w93 + w94
        gE2_2_8 = 1.0 - (w80 + w92)
        E2_2_8 = ge1_2 * gE2_2_6 + ge1_5 * gE2_2_7 + ge1_8 * gE2_2_8
        a_3_2 = xi2_0 * E2_2_2 + xi2_1 * E2_2_5 + xi2_2 * E2_2_8
        p_2_2 = 0.01 * a_3_2
        E2_2_1 = gE2_2_0 * ge1_1 + gE2_2_1 * ge1_4 + gE2_2_2 * ge1_7
        E2_2_4 = gE2_2_3 * ge1_1 + gE2_2_4 * ge1_4 + gE2_2_5 * ge1_7
        E2_2_7 = gE2_2_6 * ge1_1 + gE2_2_7 * ge1_4 + gE2_2_8 * ge1_7
        a_3_1 = xi2_0 * E2_2_1 + xi2_1 * E2_2_4 + xi2_2 * E2_2_7
        Q2_7 = g20 * E2_2_1 + g21 * E2_2_4 + g22 * E2_2_7
        Q2_8 = g20 * E2_2_2 + g21 * E2_2_5 + g22 * E2_2_8
        w98 = 1.5 - 2.0 * Q2_8
        w99 = 1.0 / sqrt(1.01 + 1.5 * (w98 - 0.2 * Q2_7))
        w100 = w99 * w99 * (0.5 * w99)
        w101 = 1.0 / sqrt(1.01 + 1.5 * (w98 + 0.2 * Q2_7))
        w102 = w101 * w101 * (0.5 * w101)
        w103 = -1.0 - 2.0 * (1.5 * w100 - 1.5 * w102)
        w104 = -0.3 * w100 - 0.3 * w102
        Nr2_0 = Q2_7 * w103 - Q2_8 * w104 + 99.0 * a_3_1 * p_2_2
        w106 = Nr2_0 * w105
        s_m2_4_0 = w71 + w106
        E2_2_0 = ge1_0 * gE2_2_0 + gE2_2_1 * ge1_3 + gE2_2_2 * ge1_6
        E2_2_3 = ge1_0 * gE2_2_3 + gE2_2_4 * ge1_3 + gE2_2_5 * ge1_6
        E2_2_6 = ge1_0 * gE2_2_6 + gE2_2_7 * ge1_3 + gE2_2_8 * ge1_6
        a_3_0 = xi2_0 * E2_2_0 + xi2_1 * E2_2_3 + xi2_2 * E2_2_6
        Q2_6 = g20 * E2_2_0 + g21 * E2_2_3 + g22 * E2_2_6
        Nr2_1 = -100.0 * a_3_0 * p_2_2 - w103 * Q2_6
        w111 = w105 * Nr2_1
        s_m2_4_1 = w110 + w111
        Nr2_2 = 0.01 * a_3_0 * a_3_1 + w104 * Q2_6
        w119 = w105 * Nr2_2
        s_m2_4_2 = w118 + w119
        m2_4_2_0 = ge1_0 * s_m2_4_0 + ge1_1 * s_m2_4_1 + ge1_2 * s_m2_4_2
        y2_0 = xi2_0 * w120
        y2_1 = xi2_1 * w120
        y2_2 = xi2_2 * w120
        w121 = y2_0 * y2_0 + y2_1 * y2_1 + y2_2 * y2_2
        c2_6, c3_3 = _stumpff_23(w121)
        m2_4_2_2 = ge1_7 * s_m2_4_1 + s_m2_4_0 * ge1_6 + ge1_8 * s_m2_4_2
        m2_4_2_1 = ge1_4 * s_m2_4_1 + s_m2_4_0 * ge1_3 + ge1_5 * s_m2_4_2
        w123 = y2_1 * m2_4_2_2 - y2_2 * m2_4_2_1
        w125 = y2_0 * m2_4_2_1 - m2_4_2_0 * y2_1
        w126 = m2_4_2_0 * y2_2 - y2_0 * m2_4_2_2
        p2_5_0 = m2_4_2_0 - w123 * c2_6 + (y2_1 * w125 - y2_2 * w126) * c3_3
        m2_3_0 = ge1_0 * Nr2_0 + ge1_1 * Nr2_1 + ge1_2 * Nr2_2
        y2_2_0 = xi2_0 * w127
        y2_2_1 = xi2_1 * w127
        y2_2_2 = xi2_2 * w127
        w128 = y2_2_0 * y2_2_0 + y2_2_1 * y2_2_1 + y2_2_2 * y2_2_2
        c2_7, c3_4 = _stumpff_23(w128)
        m2_3_2 = ge1_7 * Nr2_1 + Nr2_0 * ge1_6 + ge1_8 * Nr2_2
        m2_3_1 = ge1_4 * Nr2_1 + Nr2_0 * ge1_3 + ge1_5 * Nr2_2
        w130 = y2_2_1 * m2_3_2 - y2_2_2 * m2_3_1
        w132 = y2_2_0 * m2_3_1 - m2_3_0 * y2_2_1
        w133 = m2_3_0 * y2_2_2 - y2_2_0 * m2_3_2
        M2_0 = (
            p2_5_0
            + w127 * (m2_3_0 - w130 * c2_7 + (y2_2_1 * w132 - y2_2_2 * w133) * c3_4)
        )
        p_2_0 = 1.01 * a_3_0
        a_6_0 = E2_2_0 * p_2_0 + E2_2_1 * a_3_1 + E2_2_2 * p_2_2
        residual_2_0 = M2_0 - a_6_0
        p2_5_1 = m2_4_2_1 - w126 * c2_6 + (y2_2 * w123 - y2_0 * w125) * c3_3
        M2_1 = (
            p2_5_1
            + w127 * (m2_3_1 - w133 * c2_7 + (y2_2_2 * w130 - y2_2_0 * w132) * c3_4)
        )
        a_6_1 = E2_2_3 * p_2_0 + E2_2_4 * a_3_1 + E2_2_5 * p_2_2
        residual_2_1 = M2_1 - a_6_1
        p2_5_2 = m2_4_2_2 - w125 * c2_6 + (y2_0 * w126 - y2_1 * w123) * c3_3
        M2_2 = (
            p2_5_2
            + w127 * (m2_3_2 - w132 * c2_7 + (y2_2_0 * w133 - y2_2_1 * w130) * c3_4)
        )
        a_6_2 = E2_2_6 * p_2_0 + E2_2_7 * a_3_1 + E2_2_8 * p_2_2
        residual_2_2 = M2_2 - a_6_2
        total = residual_2_0 + residual_2_1 + residual_2_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi2, n2", 1, sweep, statistics)
        if make_2:
            w134 = -1.337695120040061 * xi1_0
            w135 = (
                h
                * (w134 - 0.8512071919596577 * s_mu_0_seen + 1.7024143839193153 * xi2_0)
            )
            w136 = (
                h
                * (0.8512071919596577 * s_mu_0_seen + w134 - 0.01702414383919315 * xi2_0)
            )
            w137 = 0.01 - w135 * w136
            w138 = -0.013512071919596576 * xi1_2
            w139 = (
                h
                * (w138 - 0.8512071919596577 * s_mu_2_seen - 1.6853902400801222 * xi2_2)
            )
            w140 = 1.3512071919596575 * xi1_1
            w141 = (
                h
                * (w140 - 0.8512071919596577 * s_mu_1_seen - 0.01702414383919315 * xi2_1)
            )
            w142 = (
                h
                * (0.8512071919596577 * s_mu_2_seen + w138 + 1.7024143839193153 * xi2_2)
            )
            w143 = w135 * w141 + 0.01 * w142
            w144 = (
                h
                * (0.8512071919596577 * s_mu_1_seen + w140 - 1.6853902400801222 * xi2_1)
            )
            w145 = w141 + w136 * w142
            w146 = 1.0 / (1.01 * w137 - w139 * w143 - w144 * w145)
            row_2_1 = [
                w137 * w146,
                w146 * (w136 * w144 + 0.01 * w139),
                w146 * (w144 + w135 * w139),
            ]
            row_2_2 = [
                w143 * w146,
                w146 * (0.0101 - w141 * w144),
                w146 * (w142 * w144 + 1.01 * w135),
            ]
            row_2_3 = [
                w145 * w146,
                w146 * (w139 * w141 + 1.01 * w136),
                w146 * (1.01 - w139 * w142),
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
    xe2_1 = xi2_1 * w105
    xe2_0 = xi2_0 * w105
    w147 = xe2_0 * xe2_0
    w148 = xe2_1 * xe2_1
    w149 = w147 + w148
    xe2_2 = xi2_2 * w105
    w150 = xe2_2 * xe2_2
    w151 = w149 + w150
    c1_4, c2_8 = _stumpff_12(w151)
    w153 = xe2_1 * c2_8
    w154 = xe2_1 * w153
    w155 = xe2_2 * c2_8
    w156 = xe2_2 * w155
    w157 = w154 + w156
    ge2_0 = 1.0 - w157
    w158 = ge1_0 * ge2_0
    w159 = xe2_0 * c2_8
    w160 = xe2_1 * w159
    w162 = xe2_2 * c1_4
    ge2_1 = w160 - w162
    w163 = ge1_3 * ge2_1
    w164 = w158 + w163
    w165 = xe2_1 * c1_4
    w166 = xe2_2 * w159
    ge2_2 = w165 + w166
    w167 = ge1_6 * ge2_2
    e2_0 = w164 + w167
    xE2_2_1_ = xi2_1 * w76
    xE2_2_0_ = xi2_0 * w76
    w168 = xE2_2_0_ * xE2_2_0_
    w169 = xE2_2_1_ * xE2_2_1_
    w170 = w168 + w169
    xE2_2_2_ = xi2_2 * w76
    w171 = xE2_2_2_ * xE2_2_2_
    w172 = w170 + w171
    c1_5, c2_9 = _stumpff_12(w172)
    w174 = xE2_2_1_ * c2_9
    w175 = xE2_2_1_ * w174
    w176 = xE2_2_2_ * c2_9
    w177 = xE2_2_2_ * w176
    w178 = w175 + w177
    gE2_2_0_ = 1.0 - w178
    w179 = ge1_2 * gE2_2_0_
    w180 = xE2_2_0_ * c2_9
    w181 = xE2_2_1_ * w180
    w183 = xE2_2_2_ * c1_5
    gE2_2_1_ = w181 - w183
    w184 = ge1_5 * gE2_2_1_
    w185 = w179 + w184
    w186 = xE2_2_1_ * c1_5
    w187 = xE2_2_2_ * w180
    gE2_2_2_ = w186 + w187
    w188 = ge1_8 * gE2_2_2_
    E2_2_2_ = w185 + w188
    w189 = xi2_0 * E2_2_2_
    gE2_2_3_ = w181 + w183
    w190 = ge1_2 * gE2_2_3_
    w191 = xE2_2_0_ * w180
    w192 = w177 + w191
    gE2_2_4_ = 1.0 - w192
    w193 = ge1_5 * gE2_2_4_
    w194 = w190 + w193
    w195 = xE2_2_2_ * w174
    w196 = xE2_2_0_ * c1_5
    gE2_2_5_ = w195 - w196
    w197 = ge1_8 * gE2_2_5_
    E2_2_5_ = w194 + w197
    w198 = xi2_1 * E2_2_5_
    w199 = w189 + w198
    gE2_2_6_ = w187 - w186
    w200 = ge1_2 * gE2_2_6_
    gE2_2_7_ = w195 + w196
    w201 = ge1_5 * gE2_2_7_
    w202 = w200 + w201
    w203 = w175 + w191
    gE2_2_8_ = 1.0 - w203
    w204 = ge1_8 * gE2_2_8_
    E2_2_8_ = w202 + w204
    w205 = xi2_2 * E2_2_8_
    a_3_2_ = w199 + w205
    p_2_2_ = 0.01 * a_3_2_
    w206 = ge1_1 * gE2_2_0_
    w207 = ge1_4 * gE2_2_1_
    w208 = w206 + w207
    w209 = ge1_7 * gE2_2_2_
    E2_2_1_ = w208 + w209
    w210 = xi2_0 * E2_2_1_
    w211 = ge1_1 * gE2_2_3_
    w212 = ge1_4 * gE2_2_4_
    w213 = w211 + w212
    w214 = ge1_7 * gE2_2_5_
    E2_2_4_ = w213 + w214
    w215 = xi2_1 * E2_2_4_
    w216 = w210 + w215
    w217 = ge1_1 * gE2_2_6_
    w218 = ge1_4 * gE2_2_7_
    w219 = w217 + w218
    w220 = ge1_7 * gE2_2_8_
    E2_2_7_ = w219 + w220
    w221 = xi2_2 * E2_2_7_
    a_3_1_ = w216 + w221
    w222 = 99.0 * a_3_1_
    w223 = p_2_2_ * w222
    w224 = g20 * E2_2_1_
    w225 = g21 * E2_2_4_
    w226 = w224 + w225
    w227 = g22 * E2_2_7_
    Q2_7_ = w226 + w227
    w228 = g20 * E2_2_2_
    w229 = g21 * E2_2_5_
    w230 = w228 + w229
    w231 = g22 * E2_2_8_
    Q2_8_ = w230 + w231
    w232 = -2.0 * Q2_8_
    w233 = 1.5 + w232
    w234 = -0.2 * Q2_7_
    w235 = w233 + w234
    w236 = 1.5 * w235
    w237 = 1.01 + w236
    w238 = sqrt(w237)
    w239 = 1.0 / w238
    w240 = w239 * w239
    w241 = 0.5 * w239
    w242 = w240 * w241
    w243 = 1.5 * w242
    w244 = 0.2 * Q2_7_
    w245 = w233 + w244
    w246 = 1.5 * w245
    w247 = 1.01 + w246
    w248 = sqrt(w247)
    w249 = 1.0 / w248
    w250 = w249 * w249
    w251 = 0.5 * w249
    w252 = w250 * w251
    w253 = 1.5 * w252
    w254 = w243 - w253
    w255 = -2.0 * w254
    w256 = w255 - 1.0
    w257 = Q2_7_ * w256
    w258 = -0.3 * w242
    w259 = -0.3 * w252
    w260 = w258 + w259
    w261 = Q2_8_ * w260
    w262 = w257 - w261
    Nr2_0_ = w223 + w262
    w263 = w105 * Nr2_0_
    p_2_ = 0.01 * xi1_2
    w264 = 99.0 * xi1_1
    w265 = p_2_ * w264
    xE1_1_1_ = xi1_1 * w1
    xE1_1_0_ = xi1_0 * w1
    w266 = xE1_1_0_ * xE1_1_0_
    w267 = xE1_1_1_ * xE1_1_1_
    w268 = w266 + w267
    xE1_1_2_ = xi1_2 * w1
    w269 = xE1_1_2_ * xE1_1_2_
    w270 = w268 + w269
    c1_6, c2_10 = _stumpff_12(w270)
    w272 = xE1_1_0_ * c2_10
    w273 = xE1_1_1_ * w272
    w275 = xE1_1_2_ * c1_6
    gE1_1_1_ = w273 - w275
    w276 = g20 * gE1_1_1_
    w277 = xE1_1_0_ * w272
    w278 = xE1_1_2_ * c2_10
    w279 = xE1_1_2_ * w278
    w280 = w277 + w279
    gE1_1_4_ = 1.0 - w280
    w281 = g21 * gE1_1_4_
    w282 = w276 + w281
    w283 = xE1_1_0_ * c1_6
    w284 = xE1_1_1_ * c2_10
    w285 = xE1_1_2_ * w284
    gE1_1_7_ = w283 + w285
    w286 = g22 * gE1_1_7_
    Q1_7_ = w282 + w286
    w287 = xE1_1_1_ * c1_6
    w288 = xE1_1_2_ * w272
    gE1_1_2_ = w287 + w288
    w289 = g20 * gE1_1_2_
    gE1_1_5_ = w285 - w283
    w290 = g21 * gE1_1_5_
    w291 = w289 + w290
    w292 = xE1_1_1_ * w284
    w293 = w277 + w292
    gE1_1_8_ = 1.0 - w293
    w294 = g22 * gE1_1_8_
    Q1_8_ = w291 + w294
    w295 = -2.0 * Q1_8_
    w296 = 1.5 + w295
    w297 = -0.2 * Q1_7_
    w298 = w296 + w297
    w299 = 1.5 * w298
    w300 = 1.01 + w299
    w301 = sqrt(w300)
    w302 = 1.0 / w301
    w303 = w302 * w302
    w304 = 0.5 * w302
    w305 = w303 * w304
    w306 = 1.5 * w305
    w307 = 0.2 * Q1_7_
    w308 = w296 + w307
    w309 = 1.5 * w308
    w310 = 1.01 + w309
    w311 = sqrt(w310)
    w312 = 1.0 / w311
    w313 = w312 * w312
    w314 = 0.5 * w312
    w315 = w313 * w314
    w316 = 1.5 * w315
    w317 = w306 - w316
    w318 = -2.0 * w317
    w319 = w318 - 1.0
    w320 = Q1_7_ * w319
    w321 = -0.3 * w305
    w322 = -0.3 * w315
    w323 = w321 + w322
    w324 = Q1_8_ * w323
    w325 = w320 - w324
    Nr1_0_ = w265 + w325
    w326 = ge1_2 * ge2_0
    w327 = ge1_5 * ge2_1
    w328 = w326 + w327
    w329 = ge1_8 * ge2_2
    e2_2 = w328 + w329
    ge2_3 = w160 + w162
    w335 = ge1_2 * ge2_3
    w336 = xe2_0 * w159
    w337 = w156 + w336
    ge2_4 = 1.0 - w337
    w338 = ge1_5 * ge2_4
    w339 = w335 + w338
    w340 = xe2_2 * w153
    w341 = xe2_0 * c1_4
    ge2_5 = w340 - w341
    w342 = ge1_8 * ge2_5
    e2_5 = w339 + w342
    ge2_6 = w166 - w165
    w347 = ge1_2 * ge2_6
    ge2_7 = w340 + w341
    w348 = ge1_5 * ge2_7
    w349 = w347 + w348
    w350 = w154 + w336
    ge2_8 = 1.0 - w350
    w351 = ge1_8 * ge2_8
    e2_8 = w349 + w351
    w357 = ge1_1 * ge2_0
    w358 = ge1_4 * ge2_1
    w359 = w357 + w358
    w360 = ge1_7 * ge2_2
    e2_1 = w359 + w360
    w361 = ge1_1 * ge2_3
    w362 = ge1_4 * ge2_4
    w363 = w361 + w362
    w364 = ge1_7 * ge2_5
    e2_4 = w363 + w364
    w365 = ge1_1 * ge2_6
    w366 = ge1_4 * ge2_7
    w367 = w365 + w366
    w368 = ge1_7 * ge2_8
    e2_7 = w367 + w368
    w376 = ge1_0 * gE2_2_0_
    w377 = ge1_3 * gE2_2_1_
    w378 = w376 + w377
    w379 = ge1_6 * gE2_2_2_
    E2_2_0_ = w378 + w379
    w380 = xi2_0 * E2_2_0_
    w381 = ge1_0 * gE2_2_3_
    w382 = ge1_3 * gE2_2_4_
    w383 = w381 + w382
    w384 = ge1_6 * gE2_2_5_
    E2_2_3_ = w383 + w384
    w385 = xi2_1 * E2_2_3_
    w386 = w380 + w385
    w387 = ge1_0 * gE2_2_6_
    w388 = ge1_3 * gE2_2_7_
    w389 = w387 + w388
    w390 = ge1_6 * gE2_2_8_
    E2_2_6_ = w389 + w390
    w391 = xi2_2 * E2_2_6_
    a_3_0_ = w386 + w391
    w392 = -100.0 * a_3_0_
    w393 = p_2_2_ * w392
    w394 = g20 * E2_2_0_
    w395 = g21 * E2_2_3_
    w396 = w394 + w395
    w397 = g22 * E2_2_6_
    Q2_6_ = w396 + w397
    w398 = w256 * Q2_6_
    Nr2_1_ = w393 - w398
    w399 = w105 * Nr2_1_
    w400 = -100.0 * xi1_0
    w401 = p_2_ * w400
    w402 = w279 + w292
    gE1_1_0_ = 1.0 - w402
    w403 = g20 * gE1_1_0_
    gE1_1_3_ = w273 + w275
    w404 = g21 * gE1_1_3_
    w405 = w403 + w404
    gE1_1_6_ = w288 - w287
    w406 = g22 * gE1_1_6_
    Q1_6_ = w405 + w406
    w407 = w319 * Q1_6_
    Nr1_1_ = w401 - w407
    w408 = ge1_0 * ge2_3
    w409 = ge1_3 * ge2_4
    w410 = w408 + w409
    w411 = ge1_6 * ge2_5
    e2_3 = w410 + w411
    w412 = ge1_0 * ge2_6
    w413 = ge1_3 * ge2_7
    w414 = w412 + w413
    w415 = ge1_6 * ge2_8
    e2_6 = w414 + w415
    w416 = 0.01 * a_3_0_
    w417 = a_3_1_ * w416
    w418 = w260 * Q2_6_
    Nr2_2_ = w417 + w418
    w419 = w105 * Nr2_2_
    w420 = 0.01 * xi1_0
    w421 = xi1_1 * w420
    w422 = w323 * Q1_6_
    Nr1_2_ = w421 + w422
    # the equations of xi3, n3: Newton's method in xi3_0, xi3_1, xi3_2
    previous_3 = 0.0
    rate_3 = memory.rates[2] if memory.past else 1.0
    make_3 = memory.inverses[2] is None
    for sweep in range(1, 101):
        xE3_3_1 = xi3_1 * w1
        xE3_3_0 = xi3_0 * w1
        xE3_3_2 = xi3_2 * w1
        w330 = xE3_3_0 * xE3_3_0 + xE3_3_1 * xE3_3_1 + xE3_3_2 * xE3_3_2
        c1_7, c2_11 = _stumpff_12(w330)
        w332 = xE3_3_1 * c2_11
        w333 = xE3_3_1 * w332
        w334 = xE3_3_2 * c2_11 * xE3_3_2
        gE3_3_0 = 1.0 - (w333 + w334)
        w343 = xE3_3_0 * c2_11
        w344 = xE3_3_1 * w343
        w346 = xE3_3_2 * c1_7
        gE3_3_1 = w344 - w346
        w352 = xE3_3_1 * c1_7
        w353 = xE3_3_2 * w343
        gE3_3_2 = w352 + w353
        E3_3_2 = e2_2 * gE3_3_0 + e2_5 * gE3_3_1 + e2_8 * gE3_3_2
        gE3_3_3 = w344 + w346
        w354 = xE3_3_0 * w343
        gE3_3_4 = 1.0 - (w334 + w354)
        w355 = xE3_3_2 * w332
        w356 = xE3_3_0 * c1_7
        gE3_3_5 = w355 - w356
        E3_3_5 = e2_2 * gE3_3_3 + e2_5 * gE3_3_4 + e2_8 * gE3_3_5
        gE3_3_6 = w353 - w352
        gE3_3_7 = w355 + w356
        gE3_3_8 = 1.0 - (w333 + w354)
        E3_3_8 = e2_2 * gE3_3_6 + e2_5 * gE3_3_7 + e2_8 * gE3_3_8
        a_5_2 = xi3_0 * E3_3_2 + xi3_1 * E3_3_5 + xi3_2 * E3_3_8
        p_3_2 = 0.01 * a_5_2
        E3_3_1 = gE3_3_0 * e2_1 + gE3_3_1 * e2_4 + gE3_3_2 * e2_7
        E3_3_4 = gE3_3_3 * e2_1 + gE3_3_4 * e2_4 + gE3_3_5 * e2_7
        E3_3_7 = gE3_3_6 * e2_1 + gE3_3_7 * e2_4 + gE3_3_8 * e2_7
        a_5_1 = xi3_0 * E3_3_1 + xi3_1 * E3_3_4 + xi3_2 * E3_3_7
        Q3_7 = g20 * E3_3_1 + g21 * E3_3_4 + g22 * E3_3_7
        Q3_8 = g20 * E3_3_2 + g21 * E3_3_5 + g22 * E3_3_8
        w369 = 1.5 - 2.0 * Q3_8
        w370 = 1.0 / sqrt(1.01 + 1.5 * (w369 - 0.2 * Q3_7))
        w371 = w370 * w370 * (0.5 * w370)
        w372 = 1.0 / sqrt(1.01 + 1.5 * (w369 + 0.2 * Q3_7))
        w373 = w372 * w372 * (0.5 * w372)
        w374 = -1.0 - 2.0 * (1.5 * w371 - 1.5 * w373)
        w375 = -0.3 * w371 - 0.3 * w373
        Nr3_0 = Q3_7 * w374 - Q3_8 * w375 + 99.0 * a_5_1 * p_3_2
        s_m3_5_0 = m_0 + w23 * (Nr1_0_ + Nr3_0) + w263
        E3_3_0 = e2_0 * gE3_3_0 + gE3_3_1 * e2_3 + gE3_3_2 * e2_6
        E3_3_3 = e2_0 * gE3_3_3 + gE3_3_4 * e2_3 + gE3_3_5 * e2_6
        E3_3_6 = e2_0 * gE3_3_6 + gE3_3_7 * e2_3 + gE3_3_8 * e2_6
        a_5_0 = xi3_0 * E3_3_0 + xi3_1 * E3_3_3 + xi3_2 * E3_3_6
        Q3_6 = g20 * E3_3_0 + g21 * E3_3_3 + g22 * E3_3_6
        Nr3_1 = -100.0 * a_5_0 * p_3_2 - w374 * Q3_6
        s_m3_5_1 = m_1 + w23 * (Nr1_1_ + Nr3_1) + w399
        Nr3_2 = 0.01 * a_5_0 * a_5_1 + w375 * Q3_6
        s_m3_5_2 = m_2 + w23 * (Nr1_2_ + Nr3_2) + w419
        m3_5_2_0 = e2_0 * s_m3_5_0 + e2_1 * s_m3_5_1 + e2_2 * s_m3_5_2
        y3_0 = xi3_0 * w24
        y3_1 = xi3_1 * w24
        y3_2 = xi3_2 * w24
        w423 = y3_0 * y3_0 + y3_1 * y3_1 + y3_2 * y3_2
        c2_12, c3_5 = _stumpff_23(w423)
        m3_5_2_2 = e2_7 * s_m3_5_1 + s_m3_5_0 * e2_6 + e2_8 * s_m3_5_2
        m3_5_2_1 = e2_4 * s_m3_5_1 + s_m3_5_0 * e2_3 + e2_5 * s_m3_5_2
        w425 = y3_1 * m3_5_2_2 - y3_2 * m3_5_2_1
        w427 = y3_0 * m3_5_2_1 - m3_5_2_0 * y3_1
        w428 = m3_5_2_0 * y3_2 - y3_0 * m3_5_2_2
        p3_6_0 = m3_5_2_0 - w425 * c2_12 + (y3_1 * w427 - y3_2 * w428) * c3_5
        m3_4_0 = e2_0 * Nr3_0 + e2_1 * Nr3_1 + e2_2 * Nr3_2
        y3_2_0 = xi3_0 * w31
        y3_2_1 = xi3_1 * w31
        y3_2_2 = xi3_2 * w31
        w429 = y3_2_0 * y3_2_0 + y3_2_1 * y3_2_1 + y3_2_2 * y3_2_2
        c2_13, c3_6 = _stumpff_23(w429)
        m3_4_2 = e2_7 * Nr3_1 + Nr3_0 * e2_6 + e2_8 * Nr3_2
        m3_4_1 = e2_4 * Nr3_1 + Nr3_0 * e2_3 + e2_5 * Nr3_2
        w431 = y3_2_1 * m3_4_2 - y3_2_2 * m3_4_1
        w433 = y3_2_0 * m3_4_1 - m3_4_0 * y3_2_1
        w434 = m3_4_0 * y3_2_2 - y3_2_0 * m3_4_2
        M3_0 = (
            p3_6_0
            + w31 * (m3_4_0 - w431 * c2_13 + (y3_2_1 * w433 - y3_2_2 * w434) * c3_6)
        )
        p_3_0 = 1.01 * a_5_0
        a_8_0 = E3_3_0 * p_3_0 + E3_3_1 * a_5_1 + E3_3_2 * p_3_2
        residual_3_0 = M3_0 - a_8_0
        p3_6_1 = m3_5_2_1 - w428 * c2_12 + (y3_2 * w425 - y3_0 * w427) * c3_5
        M3_1 = (
            p3_6_1
            + w31 * (m3_4_1 - w434 * c2_13 + (y3_2_2 * w431 - y3_2_0 * w433) * c3_6)
        )
        a_8_1 = E3_3_3 * p_3_0 + E3_3_4 * a_5_1 + E3_3_5 * p_3_2
        residual_3_1 = M3_1 - a_8_1
        p3_6_2 = m3_5_2_2 - w427 * c2_12 + (y3_0 * w428 - y3_1 * w425) * c3_5
        M3_2 = (
            p3_6_2
            + w31 * (m3_4_2 - w433 * c2_13 + (y3_2_0 * w434 - y3_2_1 * w431) * c3_6)
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
            w435 = 1.6853902400801222 * xi2_0
            w436 = (
                0.6756035959798288 * g00 * mu0
                + 0.6756035959798288 * g10 * mu1
                + 0.6756035959798288 * g20 * mu2
            )
            w437 = -1.337695120040061 * xi1_0
            w438 = h * (w436 + w437 + w435 - 1.3512071919596575 * xi3_0)
            w439 = (
                -0.6756035959798288 * g00 * mu0
                - 0.6756035959798288 * g10 * mu1
                - 0.6756035959798288 * g20 * mu2
            )
            w440 = h * (w437 + w439 + w435 + 0.013512071919596576 * xi3_0)
            w441 = 0.01 - w438 * w440
            w442 = 0.01702414383919315 * xi2_2
            w443 = (
                0.6756035959798288 * g02 * mu0
                + 0.6756035959798288 * g12 * mu1
                + 0.6756035959798288 * g22 * mu2
            )
            w444 = -0.013512071919596576 * xi1_2
            w445 = h * (w443 + w444 + w442 + 1.337695120040061 * xi3_2)
            w446 = -1.7024143839193153 * xi2_1
            w447 = (
                0.6756035959798288 * g01 * mu0
                + 0.6756035959798288 * g11 * mu1
                + 0.6756035959798288 * g21 * mu2
            )
            w448 = 1.3512071919596575 * xi1_1
            w449 = h * (w447 + w448 + w446 + 0.013512071919596576 * xi3_1)
            w450 = (
                -0.6756035959798288 * g02 * mu0
                - 0.6756035959798288 * g12 * mu1
                - 0.6756035959798288 * g22 * mu2
            )
            w451 = h * (w444 + w450 + w442 - 1.3512071919596575 * xi3_2)
            w452 = w438 * w449 + 0.01 * w451
            w453 = (
                -0.6756035959798288 * g01 * mu0
                - 0.6756035959798288 * g11 * mu1
                - 0.6756035959798288 * g21 * mu2
            )
            w454 = h * (w448 + w453 + w446 + 1.337695120040061 * xi3_1)
            w455 = w449 + w440 * w451
            w456 = 1.0 / (1.01 * w441 - w445 * w452 - w454 * w455)
            row_3_1 = [
                w441 * w456,
                w456 * (w440 * w454 + 0.01 * w445),
                w456 * (w454 + w438 * w445),
            ]
            row_3_2 = [
                w452 * w456,
                w456 * (0.0101 - w449 * w454),
                w456 * (w451 * w454 + 1.01 * w438),
            ]
            row_3_3 = [
                w455 * w456,
                w456 * (w445 * w449 + 1.01 * w440),
                w456 * (1.01 - w445 * w451),
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
    xe3_1 = xi3_1 * w23
    xe3_0 = xi3_0 * w23
    xe3_2 = xi3_2 * w23
    w457 = xe3_0 * xe3_0 + xe3_1 * xe3_1 + xe3_2 * xe3_2
    c1_8, c2_14 = _stumpff_12(w457)
    w459 = xe3_1 * c2_14
    w460 = xe3_1 * w459
    w461 = xe3_2 * c2_14 * xe3_2
    ge3_0 = 1.0 - (w460 + w461)
    w462 = xe3_0 * c2_14
    w463 = xe3_1 * w462
    w465 = xe3_2 * c1_8
    ge3_1 = w463 - w465
    w466 = xe3_1 * c1_8
    w467 = xe3_2 * w462
    ge3_2 = w466 + w467
    e3_0 = e2_0 * ge3_0 + e2_3 * ge3_1 + e2_6 * ge3_2
    ge3_3 = w463 + w465
    w468 = xe3_0 * w462
    ge3_4 = 1.0 - (w461 + w468)
    w469 = xe3_2 * w459
    w470 = xe3_0 * c1_8
    ge3_5 = w469 - w470
    e3_3 = e2_0 * ge3_3 + e2_3 * ge3_4 + e2_6 * ge3_5
    ge3_6 = w467 - w466
    ge3_7 = w469 + w470
    ge3_8 = 1.0 - (w460 + w468)
    e3_6 = e2_0 * ge3_6 + e2_3 * ge3_7 + e2_6 * ge3_8
    e3_1 = e2_1 * ge3_0 + e2_4 * ge3_1 + e2_7 * ge3_2
    e3_4 = e2_1 * ge3_3 + e2_4 * ge3_4 + e2_7 * ge3_5
    e3_7 = e2_1 * ge3_6 + e2_4 * ge3_7 + e2_7 * ge3_8
    e3_2 = e2_2 * ge3_0 + e2_5 * ge3_1 + e2_8 * ge3_2
    e3_5 = e2_2 * ge3_3 + e2_5 * ge3_4 + e2_8 * ge3_5
    e3_8 = e2_2 * ge3_6 + e2_5 * ge3_7 + e2_8 * ge3_8
    w471 = s_m3_5_0_seen + xi3_2 * w65 * d_xi3_1 + xi3_1 * w65 * d_xi3_2
    y3_2_ = xi3_2 * w24
    y3_0_ = xi3_0 * w24
    w472 = s_m3_5_1_seen + d_xi3_0 * y3_2_ + d_xi3_2 * y3_0_
    w473 = s_m3_5_2_seen + xi3_1 * w112 * d_xi3_0 + xi3_0 * w112 * d_xi3_1
    change_0 = e3_0 * w471 + e3_1 * w472 + e3_2 * w473 - m_0
    change_1 = e3_3 * w471 + e3_4 * w472 + e3_5 * w473 - m_1
    change_2 = e3_6 * w471 + e3_7 * w472 + e3_8 * w473 - m_2
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
