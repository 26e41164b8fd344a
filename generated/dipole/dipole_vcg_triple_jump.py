"""Dipole on a stick, T*SO(3): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 2.3e-16
scene:      Dipole on a stick, T*SO(3), group SO(3)
substeps:   3 calls of one function with the step sizes 1.35121 h, -1.70241 h,
            1.35121 h
solved by:  the equations of xi1, n1: Newton's method, 3 unknowns; 4.85 sweeps and 3
            matrices a step, measured over the first 20 steps of size h = 0.005
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of
            SO(3)
left out:   17 adjoint maps, 15 evaluations of dexp*, 2 evaluations of the
            derivatives of H, 10 exponentials, 12 products, 16 sums: the step is a
            sequence of substeps
            3 adjoint maps, 2 products: coefficients are zero, or terms cancel
            1 Legendre transform, 1 sum: equal values are computed once
            3 adjoint maps, 1 evaluation of the derivatives of H: no result depends
            on these operations
            1 evaluation of dexp*, 1 exponential, 2 functions of ad, 1 sum: a linear
            map is applied once to a sum and not to each term
            4 adjoint maps: an adjoint map and its inverse cancel
            2 adjoint maps, 2 evaluations of dexp*: functions of the same ad_x are
            combined
            arguments for constant parameters: beta = 1, depth = 3/2
            the time is not needed: no formula depends on the time
operations: 114 add, 174 mul, 3 stumpff_12 a step
            6 mul once in each run, for the initial guess of the first step
            11 add, 34 mul, 1 div for each matrix of the equations of xi1, n1
            51 add, 73 mul, 2 div, 2 sqrt, 1 stumpff_123 for each sweep of the
            equations of xi1, n1
            12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run
command:    orderconds emit dipole --method vcg:triple_jump --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_triple_jump

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_triple_jump.run(state, 0.005, 100))
"""

from math import cos, isfinite, nan, sin, sqrt
from operator import index

OK = 0  # success
NOT_CONVERGED = 1  # an implicit block did not converge
NOT_FINITE = 2  # the new state would contain an infinity or a NaN
BAD_STEP = 3  # h is infinite or NaN
TOO_FAR = 5  # the step is too long: no finite new state was computed; a shorter step succeeds


class StepFailed(ArithmeticError):
    """A step failed.

    status: one of the codes above; reason: the cause of the failure, as a text;
    step: the number of completed steps; state: the last good state, as a tuple.
    """

    def __init__(self, status, reason, step, state):
        super().__init__(reason)
        self.status, self.reason, self.step, self.state = status, reason, step, state

    def __str__(self):
        return f"step {self.step + 1}: {self.reason}"


class Statistics:
    """Statistics of the iterations (sweeps) since the caller set all fields to zero."""

    def __init__(self):
        self.clear()

    def clear(self):
        """Set all fields to zero."""
        self.sweeps = [0] * 1  # by block: the equations of xi1, n1
        self.most = 0  # largest number of sweeps of one block in one step or substep
        self.failed = 0  # number of the block that failed, counted from 1; 0 if none
        self.matrices = 0  # number of Newton matrices that were computed

    labels = [
        "the equations of xi1, n1",
    ]


class _Memory:
    """Data that a step stores for the next step of the run: solutions of the
    implicit equations, the latest first, and inverse matrices of Newton's method.
    """

    def __init__(self):
        self.clear()

    def clear(self):
        """Set all fields to zero."""
        self.known = 0  # number of stored solutions
        self.first = 0.0  # error of the latest guess
        self.degree = 0  # degree of the extrapolation
        self.place = 0  # row of the latest solution
        self.guess = [0.0] * 3  # initial guess for the next step
        self.values = [[0.0] * 3 for _ in range(32)]  # ring buffer, stored twice to avoid a modulo
        self.rate_1 = 0.0
        self.age_1 = 0  # age of the stored inverse of the Newton matrix; 0 if none is stored
        self.inverse_1 = [0.0] * 9


def _stumpff_tiny_2(z):
    """Return c_2(z) for z <= 1/256."""
    w = z * z
    return (
        (0.5 + z * -0.04166666666666365)
        + w * (0.0013888888842068215 + z * -2.4799519568559804e-05)
    )


def _stumpff_tiny_1(z):
    """Return c_1(z) for z <= 1/256."""
    w = z * z
    return (
        (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344)
    )


def _stumpff_small_3(z):
    """Return c_3(z) for z <= 1/16."""
    w = z * z
    return (
        (0.16666666666666666 + z * -0.008333333333333163)
        + w * (0.0001984126983861331 + z * -2.755730638646008e-06)
        + w * w * 2.5027657390139978e-08
    )


def _stumpff_small_2(z):
    """Return c_2(z) for z <= 1/16."""
    w = z * z
    return (
        (0.5 + z * -0.041666666666666664)
        + w * (0.0013888888888888278 + z * -2.4801587297080002e-05)
        + w * w * (2.7557304737591345e-07 + z * -2.0855622118602925e-09)
    )


def _stumpff_small_1(z):
    """Return c_1(z) for z <= 1/16."""
    w = z * z
    return (
        (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08)
    )


def _stumpff_series_3(z):
    """Return c_3(z) = sum_j (-z)^j/(2j+3)!, truncated, for z <= 4."""
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
    """Return c_2(z) = sum_j (-z)^j/(2j+2)!, truncated, for z <= 1."""
    w = z * z
    w2 = w * w
    even = -2.08767569878681e-09 + w * -4.779477332387385e-14
    even = -0.041666666666666664 + w * -2.48015873015873e-05 + w2 * even
    odd = 1.1470745597729725e-11 + w * 1.5619206968586225e-16
    odd = 0.001388888888888889 + w * 2.755731922398589e-07 + w2 * odd
    return 0.5 + z * (even + z * odd)


def _stumpff_series_1(z):
    """Return c_1(z) = sum_j (-z)^j/(2j+1)!, truncated, for z <= 1."""
    w = z * z
    w2 = w * w
    even = -2.505210838544172e-08 + w * -7.647163731819816e-13
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even
    odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd
    return 1.0 + z * (even + z * odd)


def _stumpff_12_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z)
    # NaN if the angle is too large for an accurate result
    half = 0.5 * sqrt(z if z <= 4398046511104.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_123_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z), _stumpff_series_3(z)
    # NaN if the angle is too large for an accurate result
    half = 0.5 * sqrt(z if z <= 4398046511104.0 else float("nan"))
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
    if z <= 0.00390625:
        return _stumpff_tiny_1(z), _stumpff_tiny_2(z)
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    return _stumpff_12_far(z)


def _sqrt(x):
    """Return sqrt(x), or the NaN of IEEE arithmetic."""
    try:
        return sqrt(x)
    except ValueError:
        return float("nan")


# Row k: coefficients of the backward difference of order k, latest solution first.
differences = (
    (
        1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0,
    ),
    (
        1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0,
    ),
    (
        1.0, -2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0,
    ),
    (
        1.0, -3.0, 3.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0,
    ),
    (
        1.0, -4.0, 6.0, -4.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0,
    ),
    (
        1.0, -5.0, 10.0, -10.0, 5.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0,
    ),
    (
        1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0,
    ),
    (
        1.0, -7.0, 21.0, -35.0, 35.0, -21.0, 7.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -9.0, 36.0, -84.0, 126.0, -126.0, 84.0, -36.0, 9.0, -1.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -10.0, 45.0, -120.0, 210.0, -252.0, 210.0, -120.0, 45.0, -10.0, 1.0, 0.0,
        0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -11.0, 55.0, -165.0, 330.0, -462.0, 462.0, -330.0, 165.0, -55.0, 11.0,
        -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -12.0, 66.0, -220.0, 495.0, -792.0, 924.0, -792.0, 495.0, -220.0, 66.0,
        -12.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -13.0, 78.0, -286.0, 715.0, -1287.0, 1716.0, -1716.0, 1287.0, -715.0,
        286.0, -78.0, 13.0, -1.0, 0.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -14.0, 91.0, -364.0, 1001.0, -2002.0, 3003.0, -3432.0, 3003.0, -2002.0,
        1001.0, -364.0, 91.0, -14.0, 1.0, 0.0, 0.0, 0.0,
    ),
    (
        1.0, -15.0, 105.0, -455.0, 1365.0, -3003.0, 5005.0, -6435.0, 6435.0, -5005.0,
        3003.0, -1365.0, 455.0, -105.0, 15.0, -1.0, 0.0, 0.0,
    ),
    (
        1.0, -16.0, 120.0, -560.0, 1820.0, -4368.0, 8008.0, -11440.0, 12870.0, -11440.0,
        8008.0, -4368.0, 1820.0, -560.0, 120.0, -16.0, 1.0, 0.0,
    ),
)


# Lengths of the substeps, in units of h.
fraction = (1.3512071919596575, -1.7024143839193153, 1.3512071919596575)


def _count_sweeps(statistics, block, sweeps, failed):
    """Record the number of sweeps over one block, and whether the block failed."""
    if statistics is not None:
        statistics.sweeps[block] += sweeps
        if sweeps > statistics.most:
            statistics.most = sweeps
        if failed:
            statistics.failed = block + 1


def _count_matrix(statistics):
    """Add one matrix."""
    if statistics is not None:
        statistics.matrices += 1


def _difference(memory, order, first, sign, sum):
    """Let 1, d_1, ..., d_order be the coefficients of the backward difference of the
    given order. Let u_0 be the latest stored solution, and u_k the solution k
    steps earlier. If first = 0 and sign = 1, compute the backward difference sum
    = u_0 + d_1 u_1 + ... + d_order u_order. If first = 1 and sign = -1, compute
    the solution extrapolated to the next step, sum = -d_1 u_0 - ... - d_order
    u_(order-1).
    """
    sum_0 = 0.0
    sum_1 = 0.0
    sum_2 = 0.0
    for pair in reversed(range((order - first) // 2 + 1)):
        row = memory.place + 2 * pair
        column = first + 2 * pair
        newer = differences[order][column]
        older = differences[order][column + 1]
        sum_0 += (
            sign * (newer * memory.values[row][0] + older * memory.values[row + 1][0])
        )
        sum_1 += (
            sign * (newer * memory.values[row][1] + older * memory.values[row + 1][1])
        )
        sum_2 += (
            sign * (newer * memory.values[row][2] + older * memory.values[row + 1][2])
        )
    sum[:] = sum_0, sum_1, sum_2


def _difference_size(memory, order):
    """The sum of the absolute values of the components of a backward difference."""
    row = [0.0] * 3
    _difference(memory, order, 0, 1.0, row)
    size = 0.0
    for i in range(3):
        size += abs(row[i])
    return size


def _remember(memory, solution):
    """Store a solution. Then compute the guess for the next step by polynomial
    extrapolation of the latest stored solutions.
    """
    # the guess is tested only if at least three solutions are stored
    if memory.known > 2:
        moved = 0.0
        moved += abs(solution[0] - memory.values[memory.place][0])
        moved += abs(solution[1] - memory.values[memory.place][1])
        moved += abs(solution[2] - memory.values[memory.place][2])
        if memory.first > 0.5 * moved:
            memory.known = 0
            memory.degree = 0
    memory.first = 0.0
    place = memory.place - 1 if memory.place > 0 else 15
    memory.place = place
    memory.values[place][:] = solution
    memory.values[place + 16][:] = solution
    if memory.known < 16:
        memory.known += 1
    # adapt the degree in each step until the ring buffer is full, then every 8
    # steps
    if memory.known < 16 or place % 8 == 0:
        size = _difference_size(memory, memory.degree)
        grows = False
        if memory.degree + 1 < memory.known:
            higher = _difference_size(memory, memory.degree + 1)
            grows = higher < size
        if grows:
            memory.degree += 1
        elif memory.degree > 0:
            lower = _difference_size(memory, memory.degree - 1)
            if size > lower:
                memory.degree -= 1
    # extrapolate the polynomial through the latest solutions
    _difference(memory, memory.degree + 1, 1, -1.0, memory.guess)


def _substep(state, h, memory, statistics):
    """One substep."""
    try:
        if not isfinite(h):
            return BAD_STEP
        g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
        if memory.known > 0:
            xi1_0, xi1_1, xi1_2 = memory.guess
        else:
            xi1_0 = 0.9900990099009901 * mu0
            xi1_1 = mu1
            xi1_2 = 100.0 * mu2
        w1 = 0.5 * h
        # the equations of xi1, n1: Newton's method, 3 unknowns
        previous_1 = 0.0
        rate_1 = memory.rate_1 if memory.known > 0 else 1.0
        make_1 = not memory.age_1 > 0
        sweep = 0
        status = NOT_CONVERGED
        while True:
            sweep += 1
            xE1_1_0 = xi1_0 * w1
            xE1_1_1 = xi1_1 * w1
            xE1_1_2 = xi1_2 * w1
            w2 = xE1_1_0 * xE1_1_0 + xE1_1_1 * xE1_1_1 + xE1_1_2 * xE1_1_2
            c1_1, c2_1, c3_1 = _stumpff_123(w2)
            w4 = g22 * xE1_1_0 - g20 * xE1_1_2
            w6 = g20 * xE1_1_1 - g21 * xE1_1_0
            w7 = g21 * xE1_1_2 - g22 * xE1_1_1
            Q1_7 = g21 + w4 * c1_1 + (xE1_1_0 * w6 - xE1_1_2 * w7) * c2_1
            Q1_8 = g22 + w6 * c1_1 + (xE1_1_1 * w7 - xE1_1_0 * w4) * c2_1
            w8 = 3.26 - 3.0 * Q1_8
            w9 = 0.3 * Q1_7
            w10 = w8 - w9
            w11 = 1.5 / (w10 * _sqrt(w10))
            w12 = w8 + w9
            w13 = 1.5 / (w12 * _sqrt(w12))
            w14 = -1.0 - (w11 - w13)
            w15 = 0.1 * (w11 + w13)
            Nr1_0 = Q1_7 * w14 + Q1_8 * w15 + 0.99 * (xi1_1 * xi1_2)
            w16 = w1 * Nr1_0
            w17 = mu0 + w16
            Q1_6 = g20 + w7 * c1_1 + (xE1_1_2 * w4 - xE1_1_1 * w6) * c2_1
            w18 = xi1_0 * xi1_2 + w14 * Q1_6
            w19 = w1 * w18
            Nr1_2 = 0.01 * (xi1_0 * xi1_1) - w15 * Q1_6
            w21 = w1 * Nr1_2
            w22 = mu2 + w21
            w23 = w19 * c2_1 + (xE1_1_0 * w22 - xE1_1_2 * w17) * c3_1
            w24 = mu1 - w19
            w25 = (xE1_1_1 * w17 - xE1_1_0 * w24) * c3_1 - w21 * c2_1
            M1_2_0 = xE1_1_2 * w23 - xE1_1_1 * w25 + w17
            residual_0 = M1_2_0 - 1.01 * xi1_0
            w26 = (xE1_1_2 * w24 - xE1_1_1 * w22) * c3_1 - w16 * c2_1
            M1_2_1 = xE1_1_0 * w25 - xE1_1_2 * w26 + w24
            residual_1 = M1_2_1 - xi1_1
            M1_2_2 = xE1_1_1 * w26 - xE1_1_0 * w23 + w22
            residual_2 = M1_2_2 - 0.01 * xi1_2
            s_mu_0 = mu0 + h * Nr1_0
            s_mu_0_seen = s_mu_0
            s_mu_1 = mu1 - h * w18
            s_mu_1_seen = s_mu_1
            s_mu_2 = mu2 + h * Nr1_2
            s_mu_2_seen = s_mu_2
            if make_1:
                w27 = -0.5 * h
                w28 = xi1_0 * w27
                w29 = 0.005 * h
                w30 = xi1_0 * w29
                w31 = 0.01 - w28 * w30
                w32 = 0.495 * h
                w33 = xi1_2 * w32
                w34 = xi1_1 * w29
                w35 = xi1_2 * w27
                w36 = w28 * w34 + 0.01 * w35
                w37 = xi1_1 * w32
                w38 = w34 + w30 * w35
                w39 = 1.0 / (1.01 * w31 - w33 * w36 - w37 * w38)
                memory.inverse_1[:] = (
                    w31 * w39, w39 * (w30 * w37 + 0.01 * w33), w39 * (w37 + w28 * w33),
                    w36 * w39, w39 * (0.0101 - w34 * w37),
                    w39 * (w35 * w37 + 1.01 * w28), w38 * w39,
                    w39 * (w33 * w34 + 1.01 * w30), w39 * (1.01 - w33 * w35),
                )
                memory.age_1 = 1 if max(map(abs, memory.inverse_1)) > 0.0 else 0
                _count_matrix(statistics)
            d_xi1_0 = (
                memory.inverse_1[0] * residual_0 + memory.inverse_1[1] * residual_1
                + memory.inverse_1[2] * residual_2
            )
            d_xi1_1 = (
                memory.inverse_1[3] * residual_0 + memory.inverse_1[4] * residual_1
                + memory.inverse_1[5] * residual_2
            )
            d_xi1_2 = (
                memory.inverse_1[6] * residual_0 + memory.inverse_1[7] * residual_1
                + memory.inverse_1[8] * residual_2
            )
            change = abs(d_xi1_0) + abs(d_xi1_1) + abs(d_xi1_2)
            scale = abs(xi1_0) + abs(xi1_1) + abs(xi1_2)
            xi1_0 += d_xi1_0
            xi1_1 += d_xi1_1
            xi1_2 += d_xi1_2
            if previous_1 > 0.0:
                rate_1 = change / previous_1
            else:
                memory.first += change
            contracts = rate_1 < 0.5
            converged = (
                change * (rate_1 + 0.0001220703125) <= 8.881784197001252e-16 * scale
                if contracts else sweep > 1
                and (change * rate_1 <= 8.881784197001252e-16 * scale * (1.0 - rate_1)
                or (rate_1 >= 1.0 and (change <= 5.684341886080802e-14 * scale
                or (change * abs(h) <= 7.105427357601002e-15 * max(map(abs, state[0:9]))
                and change * abs(h) <= 7.105427357601002e-15 * max(map(abs, state[9:12]))))))
            )
            status = (
                (OK if converged else NOT_CONVERGED)
                if isfinite(change) and memory.age_1 > 0 else NOT_FINITE
            )
            make_1 = False
            previous_1 = change
            if not (status == NOT_CONVERGED and sweep < 100):
                break
        _count_sweeps(statistics, 0, sweep, status != OK)
        if status != OK:
            return status
        memory.rate_1 = rate_1
        solution = [xi1_0, xi1_1, xi1_2]
        _remember(memory, solution)
        xe1_1 = h * xi1_1
        xe1_0 = h * xi1_0
        xe1_2 = h * xi1_2
        w40 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_2, c2_2 = _stumpff_12(w40)
        w42 = xe1_1 * c2_2
        w43 = xe1_1 * w42
        w44 = xe1_2 * c2_2 * xe1_2
        ge1_0 = 1.0 - (w43 + w44)
        w46 = xe1_2 * c1_2
        w47 = xe1_0 * c2_2
        w48 = xe1_1 * w47
        ge1_3 = w46 + w48
        w49 = xe1_2 * w47
        w50 = xe1_1 * c1_2
        ge1_6 = w49 - w50
        ge1_1 = w48 - w46
        w51 = xe1_0 * w47
        ge1_4 = 1.0 - (w44 + w51)
        w52 = xe1_0 * c1_2
        w53 = xe1_2 * w42
        ge1_7 = w52 + w53
        ge1_2 = w49 + w50
        ge1_5 = w53 - w52
        ge1_8 = 1.0 - (w43 + w51)
        w54 = 0.99 * h
        w55 = 0.01 * h
        new_g00 = g00 * ge1_0 + g01 * ge1_3 + g02 * ge1_6
        new_g01 = g00 * ge1_1 + g01 * ge1_4 + g02 * ge1_7
        new_g02 = g00 * ge1_2 + g01 * ge1_5 + g02 * ge1_8
        new_g10 = g10 * ge1_0 + g11 * ge1_3 + g12 * ge1_6
        new_g11 = g10 * ge1_1 + g11 * ge1_4 + g12 * ge1_7
        new_g12 = g10 * ge1_2 + g11 * ge1_5 + g12 * ge1_8
        new_g20 = g20 * ge1_0 + g21 * ge1_3 + g22 * ge1_6
        new_g21 = g20 * ge1_1 + g21 * ge1_4 + g22 * ge1_7
        new_g22 = g20 * ge1_2 + g21 * ge1_5 + g22 * ge1_8
        new_mu0 = s_mu_0_seen + xi1_2 * w54 * d_xi1_1 + xi1_1 * w54 * d_xi1_2
        new_mu1 = s_mu_1_seen - d_xi1_0 * xe1_2 - d_xi1_2 * xe1_0
        new_mu2 = s_mu_2_seen + xi1_1 * w55 * d_xi1_0 + xi1_0 * w55 * d_xi1_1
        if not all(map(isfinite, (new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21, new_g22, new_mu0, new_mu1, new_mu2))):
            return NOT_FINITE
        memory.age_1 = 0
        state[:] = (
            new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21,
            new_g22, new_mu0, new_mu1, new_mu2,
        )
        return OK
    except (ArithmeticError, ValueError):
        return NOT_FINITE


def _continued(state, h, memory, statistics):
    """Repeat a failed substep with a new initial guess. If the substep fails again,
    the step size is halved until the substep succeeds. Each solution is then the
    initial guess for a longer substep (continuation in h).
    """
    if not (h < 0.0 or h > 0.0):
        return OK if all(map(isfinite, state)) else NOT_FINITE
    known_solution = [0.0] * 3
    trial = [0.0] * 12
    solved = 0.0
    part = 1.0
    factor = 2.0
    failure = NOT_CONVERGED
    done = False
    tries = 0
    while not done and tries < 100 and factor > 1.00390625:
        trial[:] = state
        memory.clear()
        if solved > 0.0:
            memory.known = 1
            memory.guess[:] = known_solution
            memory.rate_1 = 1.0
        status = _substep(trial, part * h, memory, statistics)
        done = status == OK and part >= 1.0
        if status == OK:
            known_solution[:] = memory.values[memory.place]
            solved = part
            factor *= factor
        else:
            failure = status
            factor = sqrt(factor) if solved > 0.0 else factor
        if not done:
            factor = factor if factor < 4.0 else 4.0
            part = solved * factor if solved > 0.0 else 0.5 * part
            part = part if part < 1.0 else 1.0
        tries += 1
    if not done:
        return TOO_FAR if solved > 0.0 and failure == NOT_FINITE else failure
    state[:] = trial
    memory.known = 1
    if statistics is not None:
        statistics.failed = 0
    return OK


def _advance(state, h, memory, statistics):
    """One step: the composition of its substeps."""
    next = [0.0] * 12
    next[:] = state
    status = OK
    part_number = 0
    while status == OK and part_number < 3:
        status = _substep(
            next, fraction[part_number] * h, memory[part_number], statistics,
        )
        if status != OK and status != BAD_STEP:
            status = _continued(
                next, fraction[part_number] * h, memory[part_number], statistics,
            )
        part_number += 1
    if status == OK:
        state[:] = next
    return status


def _to_body(state, momentum):
    """Convert space momentum to body momentum."""
    try:
        g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
        momentum[:] = (
            g00 * mu0 + g10 * mu1 + g20 * mu2, g01 * mu0 + g11 * mu1 + g21 * mu2,
            g02 * mu0 + g12 * mu1 + g22 * mu2,
        )
    except (ArithmeticError, ValueError):
        momentum[:] = [nan] * len(momentum)


def _to_space(state, momentum):
    """Convert body momentum to space momentum."""
    try:
        g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
        momentum[:] = (
            g00 * mu0 + g01 * mu1 + g02 * mu2, g11 * mu1 + g10 * mu0 + g12 * mu2,
            g20 * mu0 + g21 * mu1 + g22 * mu2,
        )
    except (ArithmeticError, ValueError):
        momentum[:] = [nan] * len(momentum)


def _enter_body(state, moving, before):
    """Copy the state to 'moving', and convert the momentum to the body frame. Then
    convert this momentum back to the space frame, and write the result into
    'before'.
    """
    _to_body(state, before)
    moving[0:9] = state[0:9]
    moving[9:12] = before
    _to_space(moving, before)


def _leave_body(moving, before, state):
    """Update the state at the end of a run. The group element is copied from
    'moving'. The momentum in 'moving' is converted to the space frame. The
    converted momentum minus 'before' is the increase of the momentum during the
    run. This increase is added to the momentum of the state.
    """
    momentum = [0.0] * 3
    _to_space(moving, momentum)
    for i in range(3):
        momentum[i] = state[i + 9] + (momentum[i] - before[i])
    if not all(map(isfinite, momentum)):
        return NOT_FINITE
    state[0:9] = moving[0:9]
    state[9:12] = momentum
    return OK


def _run(state, h, steps, trajectory, stride, statistics, completed):
    status = OK
    step = 0
    memory = [_Memory() for _ in range(3)]
    recording = stride > 0 and trajectory is not None
    row = 0
    if recording:
        trajectory[0][:] = state
    moving = [0.0] * 12
    before = [0.0] * 3
    _enter_body(state, moving, before)
    while status == OK and step < steps:
        status = _advance(moving, h, memory, statistics)
        if status == OK:
            step += 1
            if recording and step % stride == 0:
                row += 1
                trajectory[row][:] = state
                status = _leave_body(moving, before, trajectory[row])
    if step > 0:
        ended = _leave_body(moving, before, state)
        if ended != OK:
            status = NOT_FINITE
            step = 0
    if completed is not None:
        completed[0] = step
    return status


def _numbers(state):
    """Return a state as a list of numbers; raise ValueError if its length is wrong."""
    numbers = list(map(float, state))
    if len(numbers) != 12:
        raise ValueError(f"expected 12 numbers in state, found {len(numbers)}")
    return numbers


_REASONS = {
    NOT_CONVERGED: "{block} did not converge",
    NOT_FINITE: "the new state is not finite",
    BAD_STEP: "the step size h = {h} is not finite",
    TOO_FAR: "the step is too long: no finite new state was computed; take a shorter step",
}


def _failure(status, step, state, h, statistics):
    """Return the error of a failed step."""
    reason = _REASONS[status]
    block = "an implicit block"
    if statistics is not None and statistics.failed > 0:
        block = Statistics.labels[statistics.failed - 1]
        if status == NOT_FINITE:
            reason = "{block} computed a number that is not finite"
    reason = reason.format(block=block, h=h)
    return StepFailed(status, reason, step, tuple(map(float, state)))


def step(state, h, *, statistics=None):
    """Return the state after one step of size h as a list; the given state is unchanged.

    If the step fails, StepFailed is raised.
    """
    return run(state, h, 1, statistics=statistics)


def run(state, h, steps, *, stride=0, statistics=None):
    """Return the state after ``steps`` steps of size h, as a list.

    With a positive stride, return rows instead: the initial state, and the state after every
    stride-th step. If a step fails, StepFailed is raised; it contains the last good state.
    """
    state = _numbers(state)
    h = float(h)
    try:
        steps = index(steps)
    except TypeError:
        raise TypeError(f"expected an integer for steps, found {steps!r}") from None
    if steps < 0:
        raise ValueError(f"expected no negative number of steps, found {steps}")
    rows = [[0.0] * 12 for _ in range(steps // stride + 1)] if stride > 0 else None
    completed = [0]
    counted = Statistics() if statistics is None else statistics
    counted.failed = 0
    status = _run(state, h, steps, rows, stride, counted, completed)
    if status != OK:
        raise _failure(status, completed[0], state, h, counted)
    return rows if stride > 0 else state
