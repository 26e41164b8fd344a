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
            21 add, 42 mul for an initial guess, in the first step of a run
            617 add, 828 mul, 1 div, 2 quotient, 2 stumpff_23 for each matrix of the
            equations of xi
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

from math import cos, isfinite, sin, sqrt
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
    """Let d_0, ..., d_order be the coefficients of the backward difference of the
    given order. Let u_0 be the latest stored solution, and let u_k be the
    solution k steps earlier. If first = 0 and sign = 1, compute sum = d_0 u_0 +
    d_1 u_1 + ... + d_order u_order, the backward difference. If first = 1 and
    sign = -1, compute sum = -(d_1 u_0 + d_2 u_1 + ... + d_order u_(order-1)), the
    extrapolated solution of the next step.
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
        w94 = w7 * w7
        w95 = 0.5 * w94
        w96 = q1 * w3
        w97 = q0 * w5
        w98 = -60.0 - w97
        w99 = w96 + w98
        w100 = q2 * w1
        w101 = w99 - w100
        w102 = 0.5 * w101
        w103 = w6 * w102
        w104 = q3 * w1
        w105 = q0 * w3
        w106 = 2.5 - w105
        w107 = q1 * w5
        w108 = w106 - w107
        w109 = w104 + w108
        w110 = 0.5 * w109
        w111 = w8 * w110
        w112 = w103 + w111
        H0 = w95 + w112
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
            w84 = -0.016666666666666666 * Y_2
            w85 = 0.016666666666666666 * Y_1
            w86 = -0.016666666666666666 * Y_0
            w87 = w80 * w86 - 1.0 + w82 * w85 + w81 * w84
            w88 = 0.5 * (-60.0 - w80 * Y_0 + Y_1 * w82 - Y_2 * w81)
            w89 = 0.2 * Y_3
            w90 = -0.2 * Y_1
            w91 = -0.2 * Y_0
            w92 = 0.5 + w82 * w91 + w80 * w90 + w81 * w89
            w93 = 0.5 * (2.5 - Y_0 * w82 - Y_1 * w80 + Y_3 * w81)
            w113 = Y1_3 * w69 - Y1_2 * w70 + Y1_0 * w72
            w114 = Y1_1 * w73
            d1_1 = w113 - w114
            d1_2 = Y1_1 * w72 - (Y1_3 * w70 + Y1_2 * w69) + Y1_0 * w73
            w115 = (
                w87 * w88 + w92 * w93 + 0.5 * (w83 * w83) - H0
                - (d1_0 * x_0 + x_1 * d1_1 + x_2 * d1_2)
            )
            w116 = quotient(w115, w74)
            D_0 = d1_0 + x_0 * w116
            D_1 = d1_1 + x_1 * w116
            D_2 = d1_2 + x_2 * w116
            w117 = d1_0 * d1_0 + d1_1 * d1_1 + d1_2 * d1_2
            w118 = quotient(d1_0 * D_0 + d1_1 * D_1 + d1_2 * D_2, w117)
            w119 = 0.5 * Y1_3
            w120 = 0.1 * Y1_3
            w121 = -0.5 * Y1_1
            w122 = -0.1 * Y1_1
            w123 = -0.1 * Y1_0
            w124 = 0.25 + w29 * w123 + w41 * w52 + w32 * w122 + w48 * w121 + w26 * w120
            w125 = w51 * w119 + w124
            w126 = -0.5 * Y1_2
            w127 = -0.008333333333333333 * Y1_2
            w128 = 0.5 * Y1_1
            w129 = 0.008333333333333333 * Y1_1
            w130 = -0.008333333333333333 * Y1_0
            w131 = w32 * w130 - 0.5 + w48 * w52 + w29 * w129 + w41 * w128 + w26 * w127
            w132 = w51 * w126 + w131
            w133 = quotient(D_1 * w125 + w55 * D_0 + D_2 * w132, w117)
            next_xi_0 = w55 * w118 - d1_0 * w133
            next_xi_1 = w118 * w125 - d1_1 * w133
            next_xi_2 = w118 * w132 - d1_2 * w133
            residual_xi_0 = next_xi_0 - xi_0
            residual_xi_1 = next_xi_1 - xi_1
            residual_xi_2 = next_xi_2 - xi_2
            if make_1 and isfinite(residual_xi_0 + residual_xi_1 + residual_xi_2):
                w134 = quotient(1.0, w117)
                w135 = d1_1 * w134
                w136 = h * w116
                w137 = quotient(1.0, w74)
                w138 = w88 * w137
                w139 = 0.5 * w87 * w137
                w140 = 0.5 * w92 * w137
                w141 = w93 * w137
                w142 = w83 * w137
                w143 = Y_3 * w140 + w89 * w141 - Y_2 * w139 + w84 * w138 - Y_0 * w142
                w144 = w90 * w141 - Y_1 * w140 - Y_0 * w139 + w86 * w138 + Y_2 * w142
                w145 = (
                    -0.016666666666666666 * w81 * w138 - w81 * w139 - 120.0 * w143
                    + w80 * w142 - 2.0 * w144
                )
                w146 = w81 * w142
                w147 = (
                    -0.2 * w82 * w141 - w82 * w140 - w80 * w139
                    - 0.016666666666666666 * w80 * w138
                )
                w148 = w146 - w147
                w149 = w91 * w141 - Y_0 * w140 + Y_1 * w139 + w85 * w138 - Y_3 * w142
                w150 = (
                    w81 * w140 + 0.2 * w81 * w141 - w82 * w142 + 2.0 * w149 - 5.0 * w143
                )
                w151 = (
                    -0.2 * w80 * w141 - w80 * w140 + w82 * w139
                    + 0.016666666666666666 * w82 * w138 + 120.0 * w149
                )
                w152 = w151 + 5.0 * w144
                w153 = q0 * w145 + q2 * w148 - q1 * w150 + q3 * w152
                w154 = q0 * w150 + q3 * w148 + q1 * w145 - q2 * w152
                w155 = q0 * w152 + q1 * w148 + q2 * w150 - q3 * w145
                c2_1, c3_1 = _stumpff_23(w74)
                w156 = (x_2 * w154 + x_1 * w153 + x_0 * w155) * (0.5 * (c3_1 - c2_1))
                w157 = (
                    (q3 * w150 + q2 * w145 + q1 * w152 + q0 * (w147 - w146))
                    * (0.5 * c1_2)
                )
                w158 = w156 - (w116 * w137 + w157)
                w159 = h * (w153 * c1_2 - d1_1 * w137 + 2.0 * x_1 * w158)
                w160 = d1_2 * w134
                w161 = d1_0 * w134
                w162 = x_2 * w160 + x_1 * w135 + x_0 * w161
                w163 = w135 * w136 + w159 * w162
                w164 = 2.0 * x1_1 * w18
                c2_2, c3_2 = _stumpff_23(w19)
                w165 = 0.5 * (c3_2 - c2_2)
                w166 = x1_2 * w165
                w167 = 0.5 * c1_1
                w168 = x1_1 * w165
                w169 = x1_0 * w165
                w170 = q0 * w166 - q3 * w167 - q1 * w168 + q2 * w169
                w171 = w18 * c1_1
                w172 = q1 * w171
                w173 = w164 * w170 - w172
                w174 = 0.5 * w51
                w175 = -2.0 * w46
                w176 = 2.0 * w40
                w177 = 0.1 * w26 + w174 + w119 * w175 + w52 * w176
                w178 = w118 * w120
                w179 = w118 * w123
                w180 = D_2 * w134
                w181 = 2.0 * d1_2
                w182 = w118 * w134
                w183 = x_2 * w137
                w184 = w180 - w181 * w182 + w160 - w162 * w183
                w185 = w125 * w184
                w186 = w59 + 0.1 * w57
                w187 = 2.0 * w64 - 5.0 * w186
                w188 = 0.08333333333333333 * Y1_2 + 0.03333333333333333 * Y1_1
                w189 = w186 + w126 * w188
                w190 = -0.016666666666666666 * w32
                w191 = Y1_3 * w190
                w192 = Y1_0 * w189 - (w65 + w126 * w191)
                w193 = w29 - 5.0 * Y1_0
                w194 = w28 + w193
                w195 = Y1_0 * w194 - w56
                w196 = 0.5 * w26 - 2.5 * Y1_3
                w197 = 0.2 * w26 - Y1_3 - 0.4 * Y1_0
                w198 = -0.2 * w29
                w199 = Y1_0 * w197 - Y1_3 * w198
                w200 = -0.008333333333333333 * w62 - w60
                w201 = -0.016666666666666666 * w26
                w202 = 0.03333333333333333 * Y1_0
                w203 = w49 + w201 + w202
                w204 = w200 + w126 * w203
                w205 = -120.0 * Y1_0
                w206 = 0.4 * Y1_1 - 24.0 * Y1_3
                w207 = -120.0 * w186 - 5.0 * w204 + w193 * w205 + w196 * w206
                w208 = (
                    Y1_0 * w187 - w70 - 5.0 * w192 + w193 * w195 + w196 * w199
                    + Y1_1 * w207
                )
                w209 = w64 + w128 * w188
                w210 = -0.1 * w57 - w59
                w211 = w128 * w203 + Y1_3 * w205 + w53 * w206
                w212 = (
                    Y1_0 * w209 - (Y1_3 * w210 + w128 * w191) + Y1_3 * w195 + w53 * w199
                    + Y1_1 * w211
                )
                w213 = 0.016666666666666666 * w29 - 0.08333333333333333 * Y1_0 + w47
                w214 = w126 * w213
                w215 = 120.0 * Y1_3
                w216 = -0.2 * w32 - Y1_1 - 24.0 * Y1_0
                w217 = w60 + 0.008333333333333333 * w62
                w218 = w217 + w128 * w213 + Y1_3 * w215 + w53 * w216
                w219 = 120.0 * w64 - 5.0 * w214 + w193 * w215 + w196 * w216 + 2.0 * w218
                w220 = w208 + 2.0 * w212 - Y1_2 * w219
                w221 = w34 - w33
                w222 = -5.0 * w221 - w29 + w50
                w223 = w31 * w121 + w28 * w52
                w224 = w31 + w32
                w225 = 5.0 * Y1_2
                w226 = Y1_1 * w224 - Y1_2 * w225
                w227 = w118 * w223 + w185 * w226
                w228 = D_1 * w134
                w229 = 2.0 * d1_1
                w230 = x_1 * w137
                w231 = w228 - w182 * w229 + w135 - w162 * w230
                w232 = w125 * w231 - w133
                w233 = Y1_2 * w190
                w234 = Y1_2 * w64 + w126 * w233 + Y1_1 * w189
                w235 = w61 + Y1_1 * w194
                w236 = Y1_2 * w198 + Y1_1 * w197
                w237 = (
                    w69 - Y1_1 * w187 + 5.0 * w234 - w193 * w235 - w196 * w236
                    + Y1_0 * w207
                )
                w238 = (
                    Y1_0 * w211
                    - (Y1_2 * w210 + w128 * w233 + Y1_1 * w209 + Y1_3 * w235 + w53 * w236)
                )
                w239 = Y1_0 * w224 + Y1_3 * w225
                w240 = w237 + 2.0 * w238 + Y1_3 * w219 + w222 * w239
                w241 = (
                    w118 * w177 - 5.0 * w178 + 2.0 * w179 + w185 * w220 + w222 * w227
                    + w232 * w240
                )
                w242 = w49 * w119 + w37 * w52
                w243 = Y1_1 + 2.5 * Y1_2
                w244 = -0.5 * w32
                w245 = -0.5 * w26
                w246 = w245 + 60.0 * Y1_2 + Y1_0
                w247 = 0.5 * w29
                w248 = w247 + 2.5 * w221 + 60.0 * Y1_1
                w249 = Y1_0 * w243 - Y1_3 * w244 + Y1_1 * w246 - Y1_2 * w248
                w250 = Y1_0 * w246 - (Y1_2 * w244 + Y1_1 * w243) + Y1_3 * w248
                w251 = w118 * w242 + w185 * w249 + w232 * w250
                w252 = w241 + w188 * w251
                w253 = q0 * w171
                w254 = q1 * w166 - q2 * w167 + q0 * w168 - q3 * w169
                w255 = w253 + w164 * w254
                w256 = 2.0 * w36
                w257 = -2.0 * w40
                w258 = w119 * w256 + w121 * w257
                w259 = w118 * w122
                w260 = Y1_3 * w200
                w261 = Y1_0 + w245
                w262 = w188 * w261 - 5.0 * w200
                w263 = w49 - w32 + w205
                w264 = (
                    2.0 * w260 - w69 - w191 * w261 + Y1_0 * w262 - 120.0 * w192
                    + w195 * w263
                )
                w265 = Y1_1 - 60.0 * Y1_3
                w266 = (
                    w257 - 120.0 * w200 + w257 + w203 * w261 - 120.0 * w204
                    + w205 * w263 + w206 * w265
                )
                w267 = 5.0 * w40 - 2.0 * w210
                w268 = w267 + w213 * w261 - 120.0 * w214 + w215 * w263 + w216 * w265
                w269 = w264 + w199 * w265 + Y1_1 * w266 - Y1_2 * w268
                w270 = w224 - 120.0 * w221
                w271 = Y1_2 * w200
                w272 = (
                    2.0 * w271 - w70 - w233 * w261 - Y1_1 * w262 + 120.0 * w234
                    - w235 * w263
                )
                w273 = w272 - w236 * w265 + Y1_0 * w266 + Y1_3 * w268 + w239 * w270
                w274 = (
                    w118 * w258 - 2.0 * w259 - 120.0 * w178 + w185 * w269 + w227 * w270
                    + w232 * w273
                )
                w275 = w201 + w202 + w49
                w276 = w274 + w251 * w275
                w277 = q3 * w171
                w278 = q3 * w168 - (q1 * w167 + q2 * w166) + q0 * w169
                w279 = w277 + w164 * w278
                w280 = 2.0 * w46
                w281 = -2.0 * w36
                w282 = -0.1 * w32 - 0.5 * w48 + w121 * w280 + w52 * w281
                w283 = w247 - 2.5 * Y1_0
                w284 = 2.0 * w217 + w188 * w283
                w285 = -5.0 * Y1_2
                w286 = w244 - 2.5 * Y1_1
                w287 = (
                    w72 - 5.0 * w260 - w191 * w283 + Y1_0 * w284 + w195 * w285
                    + w199 * w286
                )
                w288 = w267 + w203 * w283 + w205 * w285 + w206 * w286
                w289 = 5.0 * w210
                w290 = (
                    w289 + 120.0 * w217 + w289 + w213 * w283 + w215 * w285 + w216 * w286
                    + 120.0 * w218
                )
                w291 = w287 + Y1_1 * w288 + 120.0 * w212 - Y1_2 * w290
                w292 = w225 - 120.0 * Y1_3
                w293 = (
                    -5.0 * w271 - w73 - w233 * w283 - Y1_1 * w284 - w235 * w285
                    - w236 * w286
                )
                w294 = w293 + Y1_0 * w288 + 120.0 * w238 + Y1_3 * w290 + w239 * w292
                w295 = (
                    w118 * w282 + 5.0 * w259 + 120.0 * w179 + w185 * w291 + w227 * w292
                    + w232 * w294
                )
                w296 = w295 + w213 * w251
                w297 = w114 - w113
                w298 = w125 * w134
                w299 = w132 * w134
                w300 = w55 * w134
                w301 = x_2 * w299 + x_1 * w298 + x_0 * w300
                w302 = w126 * w175 + w128 * w176
                w303 = D_0 * w134
                w304 = w52 * w175 - 0.5 * (w29 + w41) + w25 * w176
                w305 = w127 * w180 + w120 * w228 + w53 * w303
                w306 = w129 * w180 + w123 * w228 + w25 * w303
                w307 = w133 * w134
                w308 = w299 - w181 * w307 - w183 * w301
                w309 = (
                    w180 * w302 + w177 * w228 + w303 * w304 - 5.0 * w305 + 2.0 * w306
                    + w220 * w308
                )
                w310 = w31 * w52 + w28 * w128
                w311 = w31 * w42 + w25 * w28
                w312 = w180 * w310 + w223 * w228 + w303 * w311 + w226 * w308
                w313 = w298 - w229 * w307 - w230 * w301
                w314 = w49 * w126 + w37 * w128
                w315 = w49 * w52 + w25 * w37
                w316 = (
                    w180 * w314 + w228 * w242 + w303 * w315 + w249 * w308 + w250 * w313
                )
                w317 = w309 + w222 * w312 + w240 * w313 + w188 * w316
                w318 = (
                    -0.008333333333333333 * w26 - 0.5 * w51 + w126 * w256 + w52 * w257
                )
                w319 = 0.5 * (w32 + w48) + w52 * w256 + w42 * w257
                w320 = w130 * w180 + w122 * w228 + w42 * w303
                w321 = (
                    w180 * w318 + w228 * w258 + w303 * w319 - 2.0 * w320 - 120.0 * w305
                    + w269 * w308
                )
                w322 = w321 + w270 * w312 + w273 * w313 + w275 * w316
                w323 = 0.5 * w41
                w324 = 0.008333333333333333 * w29 + w323 + w52 * w280 + w128 * w281
                w325 = w42 * w280 + w25 * w281
                w326 = (
                    w180 * w324 + w228 * w282 + w303 * w325 + 5.0 * w320 + 120.0 * w306
                    + w291 * w308
                )
                w327 = w326 + w292 * w312 + w294 * w313 + w213 * w316
                w328 = (
                    w159 * w301 + w136 * w298 + w173 * w317 + w255 * w322 + w279 * w327
                )
                w329 = Y1_1 * w190
                w330 = Y1_2 * w189 - (Y1_1 * w64 + w126 * w329)
                w331 = Y1_2 * w194 - w26 * Y1_1
                w332 = Y1_2 * w197 - Y1_1 * w198
                w333 = (
                    Y1_2 * w187 - w72 - 5.0 * w330 + w193 * w331 + w196 * w332
                    - Y1_3 * w207
                )
                w334 = (
                    Y1_2 * w209 - (Y1_1 * w210 + w128 * w329) + Y1_3 * w331 + w53 * w332
                    - Y1_3 * w211
                )
                w335 = Y1_0 * w225 - Y1_3 * w224
                w336 = Y1_2 * w243 - Y1_1 * w244 - Y1_3 * w246 + Y1_0 * w248
                w337 = w333 + 2.0 * w334 + Y1_0 * w219 + w222 * w335 + w188 * w336
                w338 = Y1_1 * w200
                w339 = (
                    w73 + 2.0 * w338 - w261 * w329 + Y1_2 * w262 - 120.0 * w330
                    + w263 * w331
                )
                w340 = (
                    w339 + w265 * w332 - Y1_3 * w266 + Y1_0 * w268 + w270 * w335
                    + w275 * w336
                )
                w341 = (
                    -5.0 * w338 - w70 - w283 * w329 + Y1_2 * w284 + w285 * w331
                    + w286 * w332
                )
                w342 = (
                    w341 - Y1_3 * w288 + 120.0 * w334 + Y1_0 * w290 + w292 * w335
                    + w213 * w336
                )
                w343 = w173 * w337 + w255 * w340 + w279 * w342
                w344 = 2.0 * d1_0
                w345 = x_0 * w137
                w346 = w303 - w182 * w344 + w161 - w162 * w345
                w347 = w300 - w307 * w344 - w301 * w345
                w348 = w125 * w346 + w297 * w347
                w349 = (
                    w125 * w163 + w173 * w252 + w255 * w276 + w279 * w296 + w297 * w328
                    + w343 * w348
                )
                w350 = w173 * w197 + w206 * w255 + w216 * w279
                w351 = w50 * w119 + w47 * w121
                w352 = w196 + w221
                w353 = -0.5 * w29
                w354 = w286 + 60.0 * w221
                w355 = Y1_0 * w352 - Y1_3 * w353 + Y1_1 * w265 - Y1_2 * w354
                w356 = Y1_0 * w265 - (Y1_2 * w353 + Y1_1 * w352) + Y1_3 * w354
                w357 = w50 * w126 + w47 * w52
                w358 = w50 * w52 + w42 * w47
                w359 = (
                    w180 * w357 + w228 * w351 + w303 * w358 + w308 * w355 + w313 * w356
                )
                w360 = Y1_2 * w352 - Y1_1 * w353 - Y1_3 * w265 + Y1_0 * w354
                w361 = (
                    w118 * w351 + w185 * w355 + w232 * w356 + w297 * w359 + w348 * w360
                )
                w362 = q2 * w171
                w363 = q0 * w167 + q3 * w166 + q2 * w168 + q1 * w169
                w364 = w362 + w164 * w363
                w365 = w323 - 0.1 * w29
                w366 = 2.0 * w210 - 5.0 * w64 + w188 * w244
                w367 = (
                    -120.0 * w64 - 2.0 * w200 + w203 * w244 + w26 * w205 + w206 * w353
                )
                w368 = (
                    w73 - w191 * w244 + Y1_0 * w366 + w26 * w195 + w199 * w353
                    + Y1_1 * w367
                )
                w369 = (
                    5.0 * w200 + 120.0 * w210 + w213 * w244 + w26 * w215 + w216 * w353
                )
                w370 = w368 - Y1_2 * w369
                w371 = (
                    w72 - w233 * w244 - Y1_1 * w366 - w26 * w235 - w236 * w353
                    + Y1_0 * w367
                )
                w372 = w371 + Y1_3 * w369 - w26 * w239
                w373 = 0.5 * w48 - 0.008333333333333333 * w32
                w374 = w174 + w245
                w375 = (
                    w180 * w373 + w228 * w365 + w303 * w374 + w308 * w370 - w26 * w312
                    + w313 * w372
                )
                w376 = w375 + w190 * w316
                w377 = (
                    w118 * w365 + w185 * w370 - w26 * w227 + w232 * w372 + w190 * w251
                    + w297 * w376
                )
                w378 = (
                    w69 - w244 * w329 + Y1_2 * w366 + w26 * w331 + w332 * w353
                    - Y1_3 * w367
                )
                w379 = w378 + Y1_0 * w369 - w26 * w335 + w190 * w336
                w380 = w377 + w348 * w379 + w198 * w361
                w381 = 1.0 - (w349 + w350 * w361 - w364 * w380)
                w382 = h * (w154 * c1_2 - d1_2 * w137 + 2.0 * x_2 * w158)
                w383 = w136 * w160 + w162 * w382
                w384 = 2.0 * x1_2 * w18
                w385 = w253 + w170 * w384
                w386 = w118 * w127
                w387 = w118 * w129
                w388 = w132 * w184 - w133
                w389 = w118 * w310 + w226 * w388
                w390 = w132 * w231
                w391 = (
                    w118 * w302 - 5.0 * w386 + 2.0 * w387 + w220 * w388 + w222 * w389
                    + w240 * w390
                )
                w392 = w118 * w314 + w249 * w388 + w250 * w390
                w393 = w391 + w188 * w392
                w394 = w172 + w254 * w384
                w395 = w118 * w130
                w396 = (
                    w118 * w318 - 2.0 * w395 - 120.0 * w386 + w269 * w388 + w270 * w389
                    + w273 * w390
                )
                w397 = w396 + w275 * w392
                w398 = w278 * w384 - w362
                w399 = (
                    w118 * w324 + 5.0 * w395 + 120.0 * w387 + w291 * w388 + w292 * w389
                    + w294 * w390
                )
                w400 = w399 + w213 * w392
                w401 = (
                    w136 * w299 + w301 * w382 + w317 * w385 + w322 * w394 + w327 * w398
                )
                w402 = w337 * w385 + w340 * w394 + w342 * w398
                w403 = w132 * w346 - d1_2 * w347
                w404 = (
                    w132 * w383 + w385 * w393 + w394 * w397 + w398 * w400 - d1_2 * w401
                    + w402 * w403
                )
                w405 = w197 * w385 + w206 * w394 + w216 * w398
                w406 = (
                    w118 * w357 + w355 * w388 + w356 * w390 - d1_2 * w359 + w360 * w403
                )
                w407 = w277 + w363 * w384
                w408 = (
                    w118 * w373 + w370 * w388 - w26 * w389 + w372 * w390 + w190 * w392
                    - d1_2 * w376
                )
                w409 = w408 + w379 * w403 + w198 * w406
                w410 = 1.0 - (w404 + w405 * w406 - w407 * w409)
                w411 = (
                    w125 * w383 + w252 * w385 + w276 * w394 + w296 * w398 + w297 * w401
                    + w348 * w402
                )
                w412 = w380 * w407 - (w411 + w361 * w405)
                w413 = (
                    w132 * w163 + w173 * w393 + w255 * w397 + w279 * w400 - d1_2 * w328
                    + w343 * w403
                )
                w414 = w364 * w409 - (w413 + w350 * w406)
                w415 = w381 * w410 - w412 * w414
                w416 = h * (w155 * c1_2 - d1_0 * w137 + 2.0 * x_0 * w158)
                w417 = w136 * w161 + w162 * w416
                w418 = 2.0 * x1_0 * w18
                w419 = w362 + w170 * w418
                w420 = w53 * w118
                w421 = w25 * w118
                w422 = w55 * w184
                w423 = w118 * w311 + w226 * w422
                w424 = w55 * w231
                w425 = (
                    w118 * w304 - 5.0 * w420 + 2.0 * w421 + w220 * w422 + w222 * w423
                    + w240 * w424
                )
                w426 = w118 * w315 + w249 * w422 + w250 * w424
                w427 = w425 + w188 * w426
                w428 = w254 * w418 - w277
                w429 = w42 * w118
                w430 = (
                    w118 * w319 - 2.0 * w429 - 120.0 * w420 + w269 * w422 + w270 * w423
                    + w273 * w424
                )
                w431 = w430 + w275 * w426
                w432 = w253 + w278 * w418
                w433 = (
                    w118 * w325 + 5.0 * w429 + 120.0 * w421 + w291 * w422 + w292 * w423
                    + w294 * w424
                )
                w434 = w433 + w213 * w426
                w435 = (
                    w136 * w300 + w301 * w416 + w317 * w419 + w322 * w428 + w327 * w432
                )
                w436 = w337 * w419 + w340 * w428 + w342 * w432
                w437 = w55 * w346 - w133 - d1_0 * w347
                w438 = (
                    w55 * w417 + w419 * w427 + w428 * w431 + w432 * w434 - d1_0 * w435
                    + w436 * w437
                )
                w439 = w197 * w419 + w206 * w428 + w216 * w432
                w440 = (
                    w118 * w358 + w355 * w422 + w356 * w424 - d1_0 * w359 + w360 * w437
                )
                w441 = w172 + w363 * w418
                w442 = (
                    w118 * w374 + w370 * w422 - w26 * w423 + w372 * w424 + w190 * w426
                    - d1_0 * w376
                )
                w443 = w442 + w379 * w437 + w198 * w440
                w444 = 1.0 - (w438 + w439 * w440 - w441 * w443)
                w445 = (
                    w55 * w163 + w173 * w427 + w255 * w431 + w279 * w434 - d1_0 * w328
                    + w343 * w437
                )
                w446 = w364 * w443 - (w445 + w350 * w440)
                w447 = (
                    w132 * w417 + w393 * w419 + w397 * w428 + w400 * w432 - d1_2 * w435
                    + w403 * w436
                )
                w448 = w409 * w441 - (w447 + w406 * w439)
                w449 = (
                    w125 * w417 + w252 * w419 + w276 * w428 + w296 * w432 + w297 * w435
                    + w348 * w436
                )
                w450 = w380 * w441 - (w449 + w361 * w439)
                w451 = w412 * w448 - w410 * w450
                w452 = (
                    w55 * w383 + w385 * w427 + w394 * w431 + w398 * w434 - d1_0 * w401
                    + w402 * w437
                )
                w453 = w407 * w443 - (w452 + w405 * w440)
                w454 = w414 * w450 - w381 * w448
                w455 = 1.0 / (w446 * w451 + w415 * w444 + w453 * w454)
                memory.inverse_1[:] = (
                    w415 * w455, w455 * (w414 * w453 - w410 * w446),
                    w455 * (w412 * w446 - w381 * w453), w451 * w455,
                    w455 * (w410 * w444 - w448 * w453),
                    w455 * (w450 * w453 - w412 * w444), w454 * w455,
                    w455 * (w446 * w448 - w414 * w444),
                    w455 * (w381 * w444 - w446 * w450),
                )
                memory.age_1 = 1
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
                if isfinite(residual_xi_0 + residual_xi_1 + residual_xi_2)
                else NOT_FINITE
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
        w456 = x_0_ * x_0_ + x_1_ * x_1_ + x_2_ * x_2_
        c0_3, c1_3 = _stumpff_01(w456)
        w459 = x_0_ * c1_3
        w460 = x_1_ * c1_3
        w461 = x_2_ * c1_3
        Y_0_ = q0 * c0_3 - (q1 * w459 + q2 * w460 + q3 * w461)
        Y_1_ = q3 * w460 - q2 * w461 + (q0 * w459 + q1 * c0_3)
        Y_2_ = q1 * w461 - q3 * w459 + (q0 * w460 + q2 * c0_3)
        Y_3_ = q2 * w459 - q1 * w460 + (q0 * w461 + q3 * c0_3)
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
