"""Free rigid body with attitude, S^3: one step by discrete_gradient:midpoint

method:     family discrete_gradient, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are zero
scene:      Free rigid body with attitude, S^3, group S^3
solved by:  the equations of xi: Newton's method, 3 unknowns; 6.2 sweeps and 0.85
            matrices a step, measured over the first 20 steps of size h = 0.02
state:      [0..3] y: element of S^3, real part first
left out:   1 sum: coefficients are zero, or terms cancel
            1 action, 1 exponential, 2 sums: equal values are computed once
            3 exponentials: exp(x).y is computed without exp(x)
            the time is not needed: no formula depends on the time
operations: 34 add, 59 mul, 1 stumpff_01 a step
            21 add, 42 mul once in each run, for the initial guess of the first step
            633 add, 839 mul, 1 div, 2 choose, 10 fabs, 5 quotient, 2 stumpff_23 for
            each matrix of the equations of xi
            148 add, 240 mul, 3 quotient, 2 stumpff_01 for each sweep of the
            equations of xi
command:    orderconds emit free_rigid_body_s3 --method discrete_gradient:midpoint
            --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_s3_discrete_gradient_midpoint

    state = [1.0, 0.0, 0.0, 0.0]
    print(free_rigid_body_s3_discrete_gradient_midpoint.run(state, 0.02, 100))
"""

from math import cos, fabs, isfinite, sin, sqrt
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
        self.sweeps = [0] * 1  # by block: the equations of xi
        self.most = 0  # largest number of sweeps of one block in one step or substep
        self.failed = 0  # number of the block that failed, counted from 1; 0 if none
        self.matrices = 0  # number of Newton matrices that were computed

    labels = [
        "the equations of xi",
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


def _stumpff_tiny_3(z):
    """Return c_3(z) for z <= 1/256."""
    w = z * z
    return (
        (0.16666666666666666 + z * -0.008333333333333059)
        + w * (0.00019841269798705593 + z * -2.7555439466688165e-06)
    )


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


def _stumpff_tiny_0(z):
    """Return c_0(z) for z <= 1/256."""
    w = z * z
    return (
        (1.0 + z * -0.5)
        + w * (0.04166666666665553 + z * -0.001388888880278194)
        + w * w * 2.479896366618844e-05
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


def _stumpff_small_0(z):
    """Return c_0(z) for z <= 1/16."""
    w = z * z
    return (
        (1.0 + z * -0.49999999999999994)
        + w * (0.04166666666665553 + z * -0.0013888888880685601)
        + w * w * (2.480156093634923e-05 + z * -2.7518853761923276e-07)
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


def _stumpff_series_0(z):
    """Return c_0(z) = sum_j (-z)^j/(2j+0)!, truncated, for z <= 1."""
    w = z * z
    w2 = w * w
    even = -1.5619206968586225e-16
    even = -2.755731922398589e-07 + w * -1.1470745597729725e-11 + w2 * even
    even = -0.5 + w * -0.001388888888888889 + w2 * even
    odd = 2.08767569878681e-09 + w * 4.779477332387385e-14
    odd = 0.041666666666666664 + w * 2.48015873015873e-05 + w2 * odd
    return 1.0 + z * (even + z * odd)


def _stumpff_23_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_2(z), _stumpff_series_3(z)
    # NaN if the angle is too large for an accurate result
    half = 0.5 * sqrt(z if z <= 4398046511104.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return 0.5 * (ratio * ratio), c3


def _stumpff_23(z):
    """Return, for z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.00390625:
        return _stumpff_tiny_2(z), _stumpff_tiny_3(z)
    if z <= 0.0625:
        return _stumpff_small_2(z), _stumpff_small_3(z)
    return _stumpff_23_far(z)


def _stumpff_01_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s."""
    if z <= 1.0:
        return _stumpff_series_0(z), _stumpff_series_1(z)
    # NaN if the angle is too large for an accurate result
    s = sqrt(z if z <= 4398046511104.0 else float("nan"))
    ratio = sin(s) / s
    return cos(s), ratio


def _stumpff_01(z):
    """Return, for z >= 0 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s."""
    if z <= 0.00390625:
        return _stumpff_tiny_0(z), _stumpff_tiny_1(z)
    if z <= 0.0625:
        return _stumpff_small_0(z), _stumpff_small_1(z)
    return _stumpff_01_far(z)


def quotient(a, b):
    """Return a/b, or its limit 0 if b = 0."""
    return a / b if b else b


def choose(x, a, b):
    """Return a if x > 0, b if x <= 0, and NaN if x is NaN."""
    return a if x > 0.0 else b if x <= 0.0 else x


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


def _advance(state, h, memory, statistics):
    """One step."""
    try:
        if not isfinite(h):
            return BAD_STEP
        q0, q1, q2, q3 = state
        w1 = -120.0 * q2 - 5.0 * q3
        w2 = 2.0 * q3
        w3 = 120.0 * q1 + w2
        w4 = -2.0 * q2
        w5 = 5.0 * q1 + w4
        w6 = (
            -1.0 - 0.016666666666666666 * q0 * w5 + 0.016666666666666666 * q1 * w3
            - 0.016666666666666666 * q2 * w1
        )
        w7 = 1.0 - q0 * w1 + q2 * w5 - q3 * w3
        w8 = 0.5 - 0.2 * q0 * w3 - 0.2 * q1 * w5 + 0.2 * q3 * w1
        if memory.known > 0:
            xi_0, xi_1, xi_2 = memory.guess
        else:
            w9 = -0.5 * q3
            w10 = w2 * w7 - 2.0 * q1 * w6
            w11 = 0.5 * q2
            w12 = w4 * w7 + 2.0 * q1 * w8
            w13 = 2.0 * q2 * w6 - 2.0 * q3 * w8
            w14 = 0.5 * q0
            w15 = 0.5 - 0.5 * q0 * w1 + w13 * w14 + w5 * w11 + w11 * w12 + w3 * w9
            w16 = 0.25 - 0.1 * q0 * w3 + w10 * w14 - 0.1 * q1 * w5 - 0.5 * q1 * w12
            w17 = (
                -0.5 - 0.008333333333333333 * q0 * w5 + w12 * w14
                + 0.008333333333333333 * q1 * w3 + 0.5 * q1 * w10
            )
            xi_0 = w9 * w10 + w15
            xi_1 = w16 + 0.1 * q3 * w1 + 0.5 * q3 * w13
            xi_2 = w17 - 0.008333333333333333 * q2 * w1 - 0.5 * q2 * w13
        w18 = 0.5 * h
        w97 = w7 * w7
        w98 = 0.5 * w97
        w99 = q1 * w3
        w100 = q0 * w5
        w101 = -60.0 - w100
        w102 = w99 + w101
        w103 = q2 * w1
        w104 = w102 - w103
        w105 = 0.5 * w104
        w106 = w6 * w105
        w107 = q3 * w1
        w108 = q0 * w3
        w109 = 2.5 - w108
        w110 = q1 * w5
        w111 = w109 - w110
        w112 = w107 + w111
        w113 = 0.5 * w112
        w114 = w8 * w113
        w115 = w106 + w114
        H0 = w98 + w115
        # the equations of xi: Newton's method, 3 unknowns
        previous_1 = 0.0
        rate_1 = memory.rate_1 if memory.known > 0 else 1.0
        make_1 = not memory.age_1 > 0
        astray = False
        sweep = 0
        status = NOT_CONVERGED
        while True:
            sweep += 1
            x1_0 = xi_0 * w18
            x1_1 = xi_1 * w18
            x1_2 = xi_2 * w18
            w19 = x1_0 * x1_0 + x1_1 * x1_1 + x1_2 * x1_2
            c0_1, c1_1 = _stumpff_01(w19)
            w21 = x1_0 * c1_1
            w22 = x1_1 * c1_1
            w24 = x1_2 * c1_1
            Y1_3 = q2 * w21 - q1 * w22 + (q0 * w24 + q3 * c0_1)
            w25 = -0.5 * Y1_3
            Y1_2 = q1 * w24 - q3 * w21 + (q0 * w22 + q2 * c0_1)
            w26 = -120.0 * Y1_2 - 5.0 * Y1_3
            w27 = -0.016666666666666666 * Y1_2
            Y1_1 = q3 * w22 - q2 * w24 + (q0 * w21 + q1 * c0_1)
            w28 = 2.0 * Y1_3
            w29 = 120.0 * Y1_1 + w28
            w30 = 0.016666666666666666 * Y1_1
            w31 = -2.0 * Y1_2
            w32 = 5.0 * Y1_1 + w31
            w33 = q0 * c0_1
            w34 = q1 * w21 + q2 * w22 + q3 * w24
            Y1_0 = w33 - w34
            w35 = -0.016666666666666666 * Y1_0
            w36 = w32 * w35 - 1.0 + w29 * w30 + w26 * w27
            w37 = -2.0 * Y1_1
            w38 = 1.0 - w26 * Y1_0 + Y1_2 * w32
            w39 = Y1_3 * w29
            w40 = w38 - w39
            w41 = w36 * w37 + w28 * w40
            w42 = 0.5 * Y1_2
            w43 = 0.2 * Y1_3
            w44 = -0.2 * Y1_1
            w45 = -0.2 * Y1_0
            w46 = 0.5 + w29 * w45 + w32 * w44 + w26 * w43
            w47 = 2.0 * Y1_1
            w48 = w46 * w47 + w31 * w40
            w49 = 2.0 * Y1_2
            w50 = -2.0 * Y1_3
            w51 = w36 * w49 + w46 * w50
            w52 = 0.5 * Y1_0
            w53 = -0.5 * Y1_0
            w54 = 0.5 + w26 * w53 + w51 * w52 + w32 * w42 + w42 * w48 + w25 * w29
            w55 = w25 * w41 + w54
            w56 = Y1_3 * w26
            w57 = 2.5 - w29 * Y1_0 - Y1_1 * w32 + w56
            w58 = 0.5 * w57
            w59 = 0.5 * w46
            w60 = 0.5 * w36
            w61 = Y1_2 * w26
            w62 = -60.0 - w32 * Y1_0 + Y1_1 * w29 - w61
            w63 = 0.5 * w62
            w64 = w39 - w38
            w65 = Y1_3 * w64
            w66 = w45 * w58 - Y1_0 * w59 + Y1_1 * w60 + w30 * w63 + w65
            w67 = (
                -0.2 * (w32 * w58) - w32 * w59 + w29 * w60
                + 0.016666666666666666 * (w29 * w63) + 120.0 * w66
            )
            w68 = w44 * w58 - Y1_1 * w59 - Y1_0 * w60 + w35 * w63 + Y1_2 * w40
            w69 = w67 + 5.0 * w68
            w70 = (
                -0.2 * (w29 * w58) - w29 * w59 - w32 * w60
                - 0.016666666666666666 * (w32 * w63) + w26 * w64
            )
            w71 = Y1_3 * w59 + w43 * w58 - Y1_2 * w60 + w27 * w63 + Y1_0 * w64
            w72 = (
                -0.016666666666666666 * (w26 * w63) - w26 * w60 - 120.0 * w71
                + w32 * w40 - 2.0 * w68
            )
            w73 = w26 * w59 + 0.2 * (w26 * w58) + w29 * w64 + 2.0 * w66 - 5.0 * w71
            d1_0 = Y1_0 * w69 - Y1_1 * w70 - Y1_3 * w72 + Y1_2 * w73
            x_0 = h * xi_0
            x_2 = h * xi_2
            x_1 = h * xi_1
            w74 = x_0 * x_0 + x_1 * x_1 + x_2 * x_2
            c0_2, c1_2 = _stumpff_01(w74)
            w76 = x_2 * c1_2
            w77 = x_0 * c1_2
            w79 = x_1 * c1_2
            Y_2 = q1 * w76 - q3 * w77 + (q0 * w79 + q2 * c0_2)
            Y_1 = q3 * w79 - q2 * w76 + (q0 * w77 + q1 * c0_2)
            w80 = 5.0 * Y_1 - 2.0 * Y_2
            Y_0 = q0 * c0_2 - (q1 * w77 + q2 * w79 + q3 * w76)
            Y_3 = q2 * w77 - q1 * w79 + (q0 * w76 + q3 * c0_2)
            w81 = -120.0 * Y_2 - 5.0 * Y_3
            w82 = 120.0 * Y_1 + 2.0 * Y_3
            w83 = 1.0 - Y_0 * w81 + Y_2 * w80 - Y_3 * w82
            w84 = 0.5 * (w83 * w83)
            w85 = -0.016666666666666666 * Y_2
            w86 = 0.016666666666666666 * Y_1
            w87 = -0.016666666666666666 * Y_0
            w88 = w80 * w87 - 1.0 + w82 * w86 + w81 * w85
            w89 = 0.5 * (-60.0 - w80 * Y_0 + Y_1 * w82 - Y_2 * w81)
            w90 = w88 * w89
            w91 = 0.2 * Y_3
            w92 = -0.2 * Y_1
            w93 = -0.2 * Y_0
            w94 = 0.5 + w82 * w93 + w80 * w92 + w81 * w91
            w95 = 0.5 * (2.5 - Y_0 * w82 - Y_1 * w80 + Y_3 * w81)
            w96 = w94 * w95
            w116 = d1_0 * x_0
            w117 = Y1_3 * w69 - Y1_2 * w70 + Y1_0 * w72
            w118 = Y1_1 * w73
            d1_1 = w117 - w118
            w119 = x_1 * d1_1
            d1_2 = Y1_1 * w72 - (Y1_3 * w70 + Y1_2 * w69) + Y1_0 * w73
            w120 = x_2 * d1_2
            w121 = w90 + w96 + w84 - H0 - (w116 + w119 + w120)
            w122 = quotient(w121, w74)
            D_0 = d1_0 + x_0 * w122
            D_1 = d1_1 + x_1 * w122
            D_2 = d1_2 + x_2 * w122
            w123 = d1_0 * d1_0 + d1_1 * d1_1 + d1_2 * d1_2
            w124 = quotient(d1_0 * D_0 + d1_1 * D_1 + d1_2 * D_2, w123)
            w125 = 0.5 * Y1_3
            w126 = 0.1 * Y1_3
            w127 = -0.5 * Y1_1
            w128 = -0.1 * Y1_1
            w129 = -0.1 * Y1_0
            w130 = 0.25 + w29 * w129 + w41 * w52 + w32 * w128 + w48 * w127 + w26 * w126
            w131 = w51 * w125 + w130
            w132 = -0.5 * Y1_2
            w133 = -0.008333333333333333 * Y1_2
            w134 = 0.5 * Y1_1
            w135 = 0.008333333333333333 * Y1_1
            w136 = -0.008333333333333333 * Y1_0
            w137 = w32 * w136 - 0.5 + w48 * w52 + w29 * w135 + w41 * w134 + w26 * w133
            w138 = w51 * w132 + w137
            w139 = quotient(D_1 * w131 + w55 * D_0 + D_2 * w138, w123)
            next_xi_0 = w55 * w124 - d1_0 * w139
            next_xi_1 = w124 * w131 - d1_1 * w139
            next_xi_2 = w124 * w138 - d1_2 * w139
            residual_xi_0 = next_xi_0 - xi_0
            residual_xi_1 = next_xi_1 - xi_1
            residual_xi_2 = next_xi_2 - xi_2
            if make_1 and isfinite(residual_xi_0 + residual_xi_1 + residual_xi_2):
                w140 = quotient(1.0, w123)
                w141 = d1_1 * w140
                w142 = (
                    fabs(w90) + fabs(w96) + fabs(w84)
                    + (fabs(w106) + fabs(w114) + fabs(w98))
                )
                w143 = (
                    fabs(w121)
                    - 8.881784197001252e-16 * (fabs(w116) + fabs(w119) + fabs(w120) + w142)
                )
                w144 = quotient(choose(w143, w121, 0.0), w74)
                w145 = h * w144
                w146 = quotient(1.0, w74)
                w147 = choose(w143, 1.0, 0.0) * w146
                w148 = w89 * w147
                w149 = 0.5 * w88 * w147
                w150 = 0.5 * w94 * w147
                w151 = w95 * w147
                w152 = w83 * w147
                w153 = Y_3 * w150 + w91 * w151 - Y_2 * w149 + w85 * w148 - Y_0 * w152
                w154 = w92 * w151 - Y_1 * w150 - Y_0 * w149 + w87 * w148 + Y_2 * w152
                w155 = (
                    -0.016666666666666666 * w81 * w148 - w81 * w149 - 120.0 * w153
                    + w80 * w152 - 2.0 * w154
                )
                w156 = w81 * w152
                w157 = (
                    -0.2 * w82 * w151 - w82 * w150 - w80 * w149
                    - 0.016666666666666666 * w80 * w148
                )
                w158 = w156 - w157
                w159 = w93 * w151 - Y_0 * w150 + Y_1 * w149 + w86 * w148 - Y_3 * w152
                w160 = (
                    w81 * w150 + 0.2 * w81 * w151 - w82 * w152 + 2.0 * w159 - 5.0 * w153
                )
                w161 = (
                    -0.2 * w80 * w151 - w80 * w150 + w82 * w149
                    + 0.016666666666666666 * w82 * w148 + 120.0 * w159
                )
                w162 = w161 + 5.0 * w154
                w163 = q0 * w155 + q2 * w158 - q1 * w160 + q3 * w162
                w164 = q0 * w160 + q3 * w158 + q1 * w155 - q2 * w162
                w165 = q0 * w162 + q1 * w158 + q2 * w160 - q3 * w155
                c2_1, c3_1 = _stumpff_23(w74)
                w166 = (x_2 * w164 + x_1 * w163 + x_0 * w165) * (0.5 * (c3_1 - c2_1))
                w167 = (
                    (q3 * w160 + q2 * w155 + q1 * w162 + q0 * (w157 - w156))
                    * (0.5 * c1_2)
                )
                w168 = w166 - (w144 * w146 + w167)
                w169 = h * (w163 * c1_2 - d1_1 * w147 + 2.0 * x_1 * w168)
                w170 = d1_2 * w140
                w171 = d1_0 * w140
                w172 = x_2 * w170 + x_1 * w141 + x_0 * w171
                w173 = w141 * w145 + w169 * w172
                w174 = 2.0 * x1_1 * w18
                c2_2, c3_2 = _stumpff_23(w19)
                w175 = 0.5 * (c3_2 - c2_2)
                w176 = x1_2 * w175
                w177 = 0.5 * c1_1
                w178 = x1_1 * w175
                w179 = x1_0 * w175
                w180 = q0 * w176 - q3 * w177 - q1 * w178 + q2 * w179
                w181 = w18 * c1_1
                w182 = q1 * w181
                w183 = w174 * w180 - w182
                w184 = d1_0 + x_0 * w144
                w185 = d1_1 + x_1 * w144
                w186 = d1_2 + x_2 * w144
                w187 = quotient(d1_0 * w184 + d1_1 * w185 + d1_2 * w186, w123)
                w188 = 0.5 * w51
                w189 = -2.0 * w46
                w190 = 2.0 * w40
                w191 = 0.1 * w26 + w188 + w125 * w189 + w52 * w190
                w192 = w126 * w187
                w193 = w129 * w187
                w194 = w140 * w186
                w195 = 2.0 * d1_2
                w196 = w140 * w187
                w197 = x_2 * w147
                w198 = w170 + w194 - w195 * w196 - w172 * w197
                w199 = w131 * w198
                w200 = w59 + 0.1 * w57
                w201 = 2.0 * w64 - 5.0 * w200
                w202 = 0.08333333333333333 * Y1_2 + 0.03333333333333333 * Y1_1
                w203 = w200 + w132 * w202
                w204 = -0.016666666666666666 * w32
                w205 = Y1_3 * w204
                w206 = Y1_0 * w203 - (w65 + w132 * w205)
                w207 = w29 - 5.0 * Y1_0
                w208 = w28 + w207
                w209 = Y1_0 * w208 - w56
                w210 = 0.5 * w26 - 2.5 * Y1_3
                w211 = 0.2 * w26 - Y1_3 - 0.4 * Y1_0
                w212 = -0.2 * w29
                w213 = Y1_0 * w211 - Y1_3 * w212
                w214 = -0.008333333333333333 * w62 - w60
                w215 = -0.016666666666666666 * w26
                w216 = 0.03333333333333333 * Y1_0
                w217 = w49 + w215 + w216
                w218 = w214 + w132 * w217
                w219 = -120.0 * Y1_0
                w220 = 0.4 * Y1_1 - 24.0 * Y1_3
                w221 = -120.0 * w200 - 5.0 * w218 + w207 * w219 + w210 * w220
                w222 = (
                    Y1_0 * w201 - w70 - 5.0 * w206 + w207 * w209 + w210 * w213
                    + Y1_1 * w221
                )
                w223 = w64 + w134 * w202
                w224 = -0.1 * w57 - w59
                w225 = w134 * w217 + Y1_3 * w219 + w53 * w220
                w226 = (
                    Y1_0 * w223 - (Y1_3 * w224 + w134 * w205) + Y1_3 * w209 + w53 * w213
                    + Y1_1 * w225
                )
                w227 = 0.016666666666666666 * w29 - 0.08333333333333333 * Y1_0 + w47
                w228 = w132 * w227
                w229 = 120.0 * Y1_3
                w230 = -0.2 * w32 - Y1_1 - 24.0 * Y1_0
                w231 = w60 + 0.008333333333333333 * w62
                w232 = w231 + w134 * w227 + Y1_3 * w229 + w53 * w230
                w233 = 120.0 * w64 - 5.0 * w228 + w207 * w229 + w210 * w230 + 2.0 * w232
                w234 = w222 + 2.0 * w226 - Y1_2 * w233
                w235 = w34 - w33
                w236 = -5.0 * w235 - w29 + w50
                w237 = w31 * w127 + w28 * w52
                w238 = w31 + w32
                w239 = 5.0 * Y1_2
                w240 = Y1_1 * w238 - Y1_2 * w239
                w241 = w187 * w237 + w199 * w240
                w242 = w140 * w185
                w243 = 2.0 * d1_1
                w244 = x_1 * w147
                w245 = w141 + w242 - w196 * w243 - w172 * w244
                w246 = quotient(w55 * w184 + w131 * w185 + w138 * w186, w123)
                w247 = w131 * w245 - w246
                w248 = Y1_2 * w204
                w249 = Y1_2 * w64 + w132 * w248 + Y1_1 * w203
                w250 = w61 + Y1_1 * w208
                w251 = Y1_2 * w212 + Y1_1 * w211
                w252 = (
                    w69 - Y1_1 * w201 + 5.0 * w249 - w207 * w250 - w210 * w251
                    + Y1_0 * w221
                )
                w253 = (
                    Y1_0 * w225
                    - (Y1_2 * w224 + w134 * w248 + Y1_1 * w223 + Y1_3 * w250 + w53 * w251)
                )
                w254 = Y1_0 * w238 + Y1_3 * w239
                w255 = w252 + 2.0 * w253 + Y1_3 * w233 + w236 * w254
                w256 = (
                    w187 * w191 - 5.0 * w192 + 2.0 * w193 + w199 * w234 + w236 * w241
                    + w247 * w255
                )
                w257 = w49 * w125 + w37 * w52
                w258 = Y1_1 + 2.5 * Y1_2
                w259 = -0.5 * w32
                w260 = -0.5 * w26
                w261 = w260 + 60.0 * Y1_2 + Y1_0
                w262 = 0.5 * w29
                w263 = w262 + 2.5 * w235 + 60.0 * Y1_1
                w264 = Y1_0 * w258 - Y1_3 * w259 + Y1_1 * w261 - Y1_2 * w263
                w265 = Y1_0 * w261 - (Y1_2 * w259 + Y1_1 * w258) + Y1_3 * w263
                w266 = w187 * w257 + w199 * w264 + w247 * w265
                w267 = w256 + w202 * w266
                w268 = q0 * w181
                w269 = q1 * w176 - q2 * w177 + q0 * w178 - q3 * w179
                w270 = w268 + w174 * w269
                w271 = 2.0 * w36
                w272 = -2.0 * w40
                w273 = w125 * w271 + w127 * w272
                w274 = w128 * w187
                w275 = Y1_3 * w214
                w276 = Y1_0 + w260
                w277 = w202 * w276 - 5.0 * w214
                w278 = w49 - w32 + w219
                w279 = (
                    2.0 * w275 - w69 - w205 * w276 + Y1_0 * w277 - 120.0 * w206
                    + w209 * w278
                )
                w280 = Y1_1 - 60.0 * Y1_3
                w281 = (
                    w272 - 120.0 * w214 + w272 + w217 * w276 - 120.0 * w218
                    + w219 * w278 + w220 * w280
                )
                w282 = 5.0 * w40 - 2.0 * w224
                w283 = w282 + w227 * w276 - 120.0 * w228 + w229 * w278 + w230 * w280
                w284 = w279 + w213 * w280 + Y1_1 * w281 - Y1_2 * w283
                w285 = w238 - 120.0 * w235
                w286 = Y1_2 * w214
                w287 = (
                    2.0 * w286 - w70 - w248 * w276 - Y1_1 * w277 + 120.0 * w249
                    - w250 * w278
                )
                w288 = w287 - w251 * w280 + Y1_0 * w281 + Y1_3 * w283 + w254 * w285
                w289 = (
                    w187 * w273 - 2.0 * w274 - 120.0 * w192 + w199 * w284 + w241 * w285
                    + w247 * w288
                )
                w290 = w215 + w216 + w49
                w291 = w289 + w266 * w290
                w292 = q3 * w181
                w293 = q3 * w178 - (q1 * w177 + q2 * w176) + q0 * w179
                w294 = w292 + w174 * w293
                w295 = 2.0 * w46
                w296 = -2.0 * w36
                w297 = -0.1 * w32 - 0.5 * w48 + w127 * w295 + w52 * w296
                w298 = w262 - 2.5 * Y1_0
                w299 = 2.0 * w231 + w202 * w298
                w300 = -5.0 * Y1_2
                w301 = w259 - 2.5 * Y1_1
                w302 = (
                    w72 - 5.0 * w275 - w205 * w298 + Y1_0 * w299 + w209 * w300
                    + w213 * w301
                )
                w303 = w282 + w217 * w298 + w219 * w300 + w220 * w301
                w304 = 5.0 * w224
                w305 = (
                    w304 + 120.0 * w231 + w304 + w227 * w298 + w229 * w300 + w230 * w301
                    + 120.0 * w232
                )
                w306 = w302 + Y1_1 * w303 + 120.0 * w226 - Y1_2 * w305
                w307 = w239 - 120.0 * Y1_3
                w308 = (
                    -5.0 * w286 - w73 - w248 * w298 - Y1_1 * w299 - w250 * w300
                    - w251 * w301
                )
                w309 = w308 + Y1_0 * w303 + 120.0 * w253 + Y1_3 * w305 + w254 * w307
                w310 = (
                    w187 * w297 + 5.0 * w274 + 120.0 * w193 + w199 * w306 + w241 * w307
                    + w247 * w309
                )
                w311 = w310 + w227 * w266
                w312 = w118 - w117
                w313 = w131 * w140
                w314 = w138 * w140
                w315 = w55 * w140
                w316 = x_2 * w314 + x_1 * w313 + x_0 * w315
                w317 = w132 * w189 + w134 * w190
                w318 = w140 * w184
                w319 = w52 * w189 - 0.5 * (w29 + w41) + w25 * w190
                w320 = w133 * w194 + w126 * w242 + w53 * w318
                w321 = w135 * w194 + w129 * w242 + w25 * w318
                w322 = w140 * w246
                w323 = w314 - w195 * w322 - w197 * w316
                w324 = (
                    w194 * w317 + w191 * w242 + w318 * w319 - 5.0 * w320 + 2.0 * w321
                    + w234 * w323
                )
                w325 = w31 * w52 + w28 * w134
                w326 = w31 * w42 + w25 * w28
                w327 = w194 * w325 + w237 * w242 + w318 * w326 + w240 * w323
                w328 = w313 - w243 * w322 - w244 * w316
                w329 = w49 * w132 + w37 * w134
                w330 = w49 * w52 + w25 * w37
                w331 = (
                    w194 * w329 + w242 * w257 + w318 * w330 + w264 * w323 + w265 * w328
                )
                w332 = w324 + w236 * w327 + w255 * w328 + w202 * w331
                w333 = (
                    -0.008333333333333333 * w26 - 0.5 * w51 + w132 * w271 + w52 * w272
                )
                w334 = 0.5 * (w32 + w48) + w52 * w271 + w42 * w272
                w335 = w136 * w194 + w128 * w242 + w42 * w318
                w336 = (
                    w194 * w333 + w242 * w273 + w318 * w334 - 2.0 * w335 - 120.0 * w320
                    + w284 * w323
                )
                w337 = w336 + w285 * w327 + w288 * w328 + w290 * w331
                w338 = 0.5 * w41
                w339 = 0.008333333333333333 * w29 + w338 + w52 * w295 + w134 * w296
                w340 = w42 * w295 + w25 * w296
                w341 = (
                    w194 * w339 + w242 * w297 + w318 * w340 + 5.0 * w335 + 120.0 * w321
                    + w306 * w323
                )
                w342 = w341 + w307 * w327 + w309 * w328 + w227 * w331
                w343 = (
                    w169 * w316 + w145 * w313 + w183 * w332 + w270 * w337 + w294 * w342
                )
                w344 = Y1_1 * w204
                w345 = Y1_2 * w203 - (Y1_1 * w64 + w132 * w344)
                w346 = Y1_2 * w208 - w26 * Y1_1
                w347 = Y1_2 * w211 - Y1_1 * w212
                w348 = (
                    Y1_2 * w201 - w72 - 5.0 * w345 + w207 * w346 + w210 * w347
                    - Y1_3 * w221
                )
                w349 = (
                    Y1_2 * w223 - (Y1_1 * w224 + w134 * w344) + Y1_3 * w346 + w53 * w347
                    - Y1_3 * w225
                )
                w350 = Y1_0 * w239 - Y1_3 * w238
                w351 = Y1_2 * w258 - Y1_1 * w259 - Y1_3 * w261 + Y1_0 * w263
                w352 = w348 + 2.0 * w349 + Y1_0 * w233 + w236 * w350 + w202 * w351
                w353 = Y1_1 * w214
                w354 = (
                    w73 + 2.0 * w353 - w276 * w344 + Y1_2 * w277 - 120.0 * w345
                    + w278 * w346
                )
                w355 = (
                    w354 + w280 * w347 - Y1_3 * w281 + Y1_0 * w283 + w285 * w350
                    + w290 * w351
                )
                w356 = (
                    -5.0 * w353 - w70 - w298 * w344 + Y1_2 * w299 + w300 * w346
                    + w301 * w347
                )
                w357 = (
                    w356 - Y1_3 * w303 + 120.0 * w349 + Y1_0 * w305 + w307 * w350
                    + w227 * w351
                )
                w358 = w183 * w352 + w270 * w355 + w294 * w357
                w359 = 2.0 * d1_0
                w360 = x_0 * w147
                w361 = w171 + w318 - w196 * w359 - w172 * w360
                w362 = w315 - w322 * w359 - w316 * w360
                w363 = w131 * w361 + w312 * w362
                w364 = (
                    w131 * w173 + w183 * w267 + w270 * w291 + w294 * w311 + w312 * w343
                    + w358 * w363
                )
                w365 = w183 * w211 + w220 * w270 + w230 * w294
                w366 = w50 * w125 + w47 * w127
                w367 = w210 + w235
                w368 = -0.5 * w29
                w369 = w301 + 60.0 * w235
                w370 = Y1_0 * w367 - Y1_3 * w368 + Y1_1 * w280 - Y1_2 * w369
                w371 = Y1_0 * w280 - (Y1_2 * w368 + Y1_1 * w367) + Y1_3 * w369
                w372 = w50 * w132 + w47 * w52
                w373 = w50 * w52 + w42 * w47
                w374 = (
                    w194 * w372 + w242 * w366 + w318 * w373 + w323 * w370 + w328 * w371
                )
                w375 = Y1_2 * w367 - Y1_1 * w368 - Y1_3 * w280 + Y1_0 * w369
                w376 = (
                    w187 * w366 + w199 * w370 + w247 * w371 + w312 * w374 + w363 * w375
                )
                w377 = q2 * w181
                w378 = q0 * w177 + q3 * w176 + q2 * w178 + q1 * w179
                w379 = w377 + w174 * w378
                w380 = w338 - 0.1 * w29
                w381 = 2.0 * w224 - 5.0 * w64 + w202 * w259
                w382 = (
                    -120.0 * w64 - 2.0 * w214 + w217 * w259 + w26 * w219 + w220 * w368
                )
                w383 = (
                    w73 - w205 * w259 + Y1_0 * w381 + w26 * w209 + w213 * w368
                    + Y1_1 * w382
                )
                w384 = (
                    5.0 * w214 + 120.0 * w224 + w227 * w259 + w26 * w229 + w230 * w368
                )
                w385 = w383 - Y1_2 * w384
                w386 = (
                    w72 - w248 * w259 - Y1_1 * w381 - w26 * w250 - w251 * w368
                    + Y1_0 * w382
                )
                w387 = w386 + Y1_3 * w384 - w26 * w254
                w388 = 0.5 * w48 - 0.008333333333333333 * w32
                w389 = w188 + w260
                w390 = (
                    w194 * w388 + w242 * w380 + w318 * w389 + w323 * w385 - w26 * w327
                    + w328 * w387
                )
                w391 = w390 + w204 * w331
                w392 = (
                    w187 * w380 + w199 * w385 - w26 * w241 + w247 * w387 + w204 * w266
                    + w312 * w391
                )
                w393 = (
                    w69 - w259 * w344 + Y1_2 * w381 + w26 * w346 + w347 * w368
                    - Y1_3 * w382
                )
                w394 = w393 + Y1_0 * w384 - w26 * w350 + w204 * w351
                w395 = w392 + w363 * w394 + w212 * w376
                w396 = 1.0 - (w364 + w365 * w376 - w379 * w395)
                w397 = h * (w164 * c1_2 - d1_2 * w147 + 2.0 * x_2 * w168)
                w398 = w145 * w170 + w172 * w397
                w399 = 2.0 * x1_2 * w18
                w400 = w268 + w180 * w399
                w401 = w133 * w187
                w402 = w135 * w187
                w403 = w138 * w198 - w246
                w404 = w187 * w325 + w240 * w403
                w405 = w138 * w245
                w406 = (
                    w187 * w317 - 5.0 * w401 + 2.0 * w402 + w234 * w403 + w236 * w404
                    + w255 * w405
                )
                w407 = w187 * w329 + w264 * w403 + w265 * w405
                w408 = w406 + w202 * w407
                w409 = w182 + w269 * w399
                w410 = w136 * w187
                w411 = (
                    w187 * w333 - 2.0 * w410 - 120.0 * w401 + w284 * w403 + w285 * w404
                    + w288 * w405
                )
                w412 = w411 + w290 * w407
                w413 = w293 * w399 - w377
                w414 = (
                    w187 * w339 + 5.0 * w410 + 120.0 * w402 + w306 * w403 + w307 * w404
                    + w309 * w405
                )
                w415 = w414 + w227 * w407
                w416 = (
                    w145 * w314 + w316 * w397 + w332 * w400 + w337 * w409 + w342 * w413
                )
                w417 = w352 * w400 + w355 * w409 + w357 * w413
                w418 = w138 * w361 - d1_2 * w362
                w419 = (
                    w138 * w398 + w400 * w408 + w409 * w412 + w413 * w415 - d1_2 * w416
                    + w417 * w418
                )
                w420 = w211 * w400 + w220 * w409 + w230 * w413
                w421 = (
                    w187 * w372 + w370 * w403 + w371 * w405 - d1_2 * w374 + w375 * w418
                )
                w422 = w292 + w378 * w399
                w423 = (
                    w187 * w388 + w385 * w403 - w26 * w404 + w387 * w405 + w204 * w407
                    - d1_2 * w391
                )
                w424 = w423 + w394 * w418 + w212 * w421
                w425 = 1.0 - (w419 + w420 * w421 - w422 * w424)
                w426 = (
                    w131 * w398 + w267 * w400 + w291 * w409 + w311 * w413 + w312 * w416
                    + w363 * w417
                )
                w427 = w395 * w422 - (w426 + w376 * w420)
                w428 = (
                    w138 * w173 + w183 * w408 + w270 * w412 + w294 * w415 - d1_2 * w343
                    + w358 * w418
                )
                w429 = w379 * w424 - (w428 + w365 * w421)
                w430 = w396 * w425 - w427 * w429
                w431 = h * (w165 * c1_2 - d1_0 * w147 + 2.0 * x_0 * w168)
                w432 = w145 * w171 + w172 * w431
                w433 = 2.0 * x1_0 * w18
                w434 = w377 + w180 * w433
                w435 = w53 * w187
                w436 = w25 * w187
                w437 = w55 * w198
                w438 = w187 * w326 + w240 * w437
                w439 = w55 * w245
                w440 = (
                    w187 * w319 - 5.0 * w435 + 2.0 * w436 + w234 * w437 + w236 * w438
                    + w255 * w439
                )
                w441 = w187 * w330 + w264 * w437 + w265 * w439
                w442 = w440 + w202 * w441
                w443 = w269 * w433 - w292
                w444 = w42 * w187
                w445 = (
                    w187 * w334 - 2.0 * w444 - 120.0 * w435 + w284 * w437 + w285 * w438
                    + w288 * w439
                )
                w446 = w445 + w290 * w441
                w447 = w268 + w293 * w433
                w448 = (
                    w187 * w340 + 5.0 * w444 + 120.0 * w436 + w306 * w437 + w307 * w438
                    + w309 * w439
                )
                w449 = w448 + w227 * w441
                w450 = (
                    w145 * w315 + w316 * w431 + w332 * w434 + w337 * w443 + w342 * w447
                )
                w451 = w352 * w434 + w355 * w443 + w357 * w447
                w452 = w55 * w361 - w246 - d1_0 * w362
                w453 = (
                    w55 * w432 + w434 * w442 + w443 * w446 + w447 * w449 - d1_0 * w450
                    + w451 * w452
                )
                w454 = w211 * w434 + w220 * w443 + w230 * w447
                w455 = (
                    w187 * w373 + w370 * w437 + w371 * w439 - d1_0 * w374 + w375 * w452
                )
                w456 = w182 + w378 * w433
                w457 = (
                    w187 * w389 + w385 * w437 - w26 * w438 + w387 * w439 + w204 * w441
                    - d1_0 * w391
                )
                w458 = w457 + w394 * w452 + w212 * w455
                w459 = 1.0 - (w453 + w454 * w455 - w456 * w458)
                w460 = (
                    w55 * w173 + w183 * w442 + w270 * w446 + w294 * w449 - d1_0 * w343
                    + w358 * w452
                )
                w461 = w379 * w458 - (w460 + w365 * w455)
                w462 = (
                    w138 * w432 + w408 * w434 + w412 * w443 + w415 * w447 - d1_2 * w450
                    + w418 * w451
                )
                w463 = w424 * w456 - (w462 + w421 * w454)
                w464 = (
                    w131 * w432 + w267 * w434 + w291 * w443 + w311 * w447 + w312 * w450
                    + w363 * w451
                )
                w465 = w395 * w456 - (w464 + w376 * w454)
                w466 = w427 * w463 - w425 * w465
                w467 = (
                    w55 * w398 + w400 * w442 + w409 * w446 + w413 * w449 - d1_0 * w416
                    + w417 * w452
                )
                w468 = w422 * w458 - (w467 + w420 * w455)
                w469 = w429 * w465 - w396 * w463
                w470 = 1.0 / (w461 * w466 + w430 * w459 + w468 * w469)
                memory.inverse_1[:] = (
                    w430 * w470, w470 * (w429 * w468 - w425 * w461),
                    w470 * (w427 * w461 - w396 * w468), w466 * w470,
                    w470 * (w425 * w459 - w463 * w468),
                    w470 * (w465 * w468 - w427 * w459), w469 * w470,
                    w470 * (w461 * w463 - w429 * w459),
                    w470 * (w396 * w459 - w461 * w465),
                )
                memory.age_1 = 1 if max(map(abs, memory.inverse_1)) > 0.0 else 0
                _count_matrix(statistics)
            change_xi_0 = (
                memory.inverse_1[0] * residual_xi_0
                + memory.inverse_1[1] * residual_xi_1
                + memory.inverse_1[2] * residual_xi_2
            )
            change_xi_1 = (
                memory.inverse_1[3] * residual_xi_0
                + memory.inverse_1[4] * residual_xi_1
                + memory.inverse_1[5] * residual_xi_2
            )
            change_xi_2 = (
                memory.inverse_1[6] * residual_xi_0
                + memory.inverse_1[7] * residual_xi_1
                + memory.inverse_1[8] * residual_xi_2
            )
            change = max(abs(change_xi_0), abs(change_xi_1), abs(change_xi_2))
            scale = max(abs(xi_0), abs(xi_1), abs(xi_2))
            if sweep == 1:
                memory.first = max(memory.first, change)
            if previous_1 > 0.0:
                rate_1 = max(change / previous_1, 0.000244140625)
            xi_0 += change_xi_0
            xi_1 += change_xi_1
            xi_2 += change_xi_2
            still = previous_1 > 0.0 and change >= previous_1
            close = (
                change <= 9.094947017729282e-13 * scale
                and change * rate_1 <= 1.1102230246251565e-16 * scale
            )
            converged = (
                close or (still and (change <= 5.684341886080802e-14 * scale
                or change * abs(h) <= 7.105427357601002e-15 * max(map(abs, state))))
            )
            status = (
                (OK if converged else NOT_CONVERGED)
                if isfinite(change_xi_0 + change_xi_1 + change_xi_2)
                and memory.age_1 > 0 else NOT_FINITE
            )
            astray = still and make_1
            make_1 = 0.015625 * previous_1 > 0.0 and change > 0.015625 * previous_1
            previous_1 = change
            if not (status == NOT_CONVERGED and sweep < 100 and not astray):
                break
        _count_sweeps(statistics, 0, sweep, status != OK)
        if status != OK:
            return status
        memory.rate_1 = rate_1 if sweep > 1 else 2.0 * rate_1
        solution = [xi_0, xi_1, xi_2]
        _remember(memory, solution)
        x_0_ = h * xi_0
        x_1_ = h * xi_1
        x_2_ = h * xi_2
        w471 = x_0_ * x_0_ + x_1_ * x_1_ + x_2_ * x_2_
        c0_3, c1_3 = _stumpff_01(w471)
        w474 = x_0_ * c1_3
        w475 = x_1_ * c1_3
        w476 = x_2_ * c1_3
        Y_0_ = q0 * c0_3 - (q1 * w474 + q2 * w475 + q3 * w476)
        Y_1_ = q3 * w475 - q2 * w476 + (q0 * w474 + q1 * c0_3)
        Y_2_ = q1 * w476 - q3 * w474 + (q0 * w475 + q2 * c0_3)
        Y_3_ = q2 * w474 - q1 * w475 + (q0 * w476 + q3 * c0_3)
        if not all(map(isfinite, (Y_0_, Y_1_, Y_2_, Y_3_))):
            return NOT_FINITE
        state[:] = Y_0_, Y_1_, Y_2_, Y_3_
        return OK
    except (ArithmeticError, ValueError):
        return NOT_FINITE


def _continued(state, h, memory, statistics):
    """Repeat a failed step with a new initial guess. If the step fails again, the
    step size is halved until the step succeeds. Each solution is then the initial
    guess for a longer step (continuation in h).
    """
    if not (h < 0.0 or h > 0.0):
        return OK if all(map(isfinite, state)) else NOT_FINITE
    known_solution = [0.0] * 3
    trial = [0.0] * 4
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
        status = _advance(trial, part * h, memory, statistics)
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


def _run(state, h, steps, trajectory, stride, statistics, completed):
    status = OK
    step = 0
    memory = _Memory()
    recording = stride > 0 and trajectory is not None
    row = 0
    if recording:
        trajectory[0][:] = state
    while status == OK and step < steps:
        status = _advance(state, h, memory, statistics)
        if status != OK and status != BAD_STEP:
            status = _continued(state, h, memory, statistics)
        if status == OK:
            step += 1
            if recording and step % stride == 0:
                row += 1
                trajectory[row][:] = state
    if completed is not None:
        completed[0] = step
    return status


def _numbers(state):
    """Return a state as a list of numbers; raise ValueError if its length is wrong."""
    numbers = list(map(float, state))
    if len(numbers) != 4:
        raise ValueError(f"expected 4 numbers in state, found {len(numbers)}")
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
    rows = [[0.0] * 4 for _ in range(steps // stride + 1)] if stride > 0 else None
    completed = [0]
    counted = Statistics() if statistics is None else statistics
    counted.failed = 0
    status = _run(state, h, steps, rows, stride, counted, completed)
    if status != OK:
        raise _failure(status, completed[0], state, h, counted)
    return rows if stride > 0 else state
