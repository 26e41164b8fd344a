"""Dipole on a stick, T*SO(3): one step by vrkmk(2):gauss2

method:     family vrkmk(2), tableau gauss2
source:     Hammer and Hollingsworth 1955; Hairer, Lubich and Wanner, Table II.1.1;
            Table 3.1c of Bogfjellmo and Marthinsen
order:      4, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 1.6e-17
scene:      Dipole on a stick, T*SO(3), group SO(3)
solved by:  the equations of v1, v2, m1, m2: Newton's method, 6 unknowns; 1.7 sweeps
            and 0.35 matrices a step, measured over the first 20 steps of size h =
            0.005
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of
            SO(3)
left out:   2 Legendre transforms, 7 evaluations of dexp*, 4 functions of ad, 4
            sums: equal values are computed once
            1 adjoint map, 1 evaluation of dexp*, 1 evaluation of the derivatives of
            H, 3 sums: no result depends on these operations
            6 adjoint maps, 2 evaluations of dexp*, 2 exponentials, 2 functions of
            ad: a linear map is applied once to a sum and not to each term
            3 adjoint maps: an adjoint map and its inverse cancel
            4 adjoint maps, 3 evaluations of dexp*, 4 evaluations of dexpinv:
            functions of the same ad_x are combined
            2 sums: numeric factors become coefficients of sums
            arguments for constant parameters: beta = 1, depth = 3/2
            the time is not needed: no formula depends on the time
operations: 47 add, 80 mul, 1 stumpff_12 a step
            2 mul once in each run, for the initial guess of the first step
            48 add, 72 mul for each matrix of the equations of v1, v2, m1, m2
            269 add, 371 mul, 6 div, 4 sqrt, 2 stumpff_123, 1 stumpff_23 for each
            sweep of the equations of v1, v2, m1, m2
            12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run
command:    orderconds emit dipole --method 'vrkmk(2):gauss2' --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vrkmk2_gauss2

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vrkmk2_gauss2.run(state, 0.005, 100))
"""

from math import cos, fabs, isfinite, nan, sin, sqrt
from operator import index

OK = 0  # success
NOT_CONVERGED = 1  # an implicit block did not converge
NOT_FINITE = 2  # the new state would contain an infinity or a NaN
BAD_STEP = 3  # h is infinite or NaN
TOO_FAR = 5  # the step is too long: no finite new state was computed; a shorter step succeeds
SINGULAR = 6  # the matrix of an implicit block is singular


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
        self.sweeps = [0] * 1  # by block: the equations of v1, v2, m1, m2
        self.most = 0  # largest number of sweeps of one block in one step or substep
        self.failed = 0  # number of the block that failed, counted from 1; 0 if none
        self.matrices = 0  # number of Newton matrices that were computed

    labels = [
        "the equations of v1, v2, m1, m2",
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
        self.guess = [0.0] * 6  # initial guess for the next step
        self.values = [[0.0] * 6 for _ in range(32)]
        self.rate_1 = 0.0
        self.age_1 = 0  # age of the stored inverse of the Newton matrix; 0 if none is stored
        self.inverse_1 = [0.0] * 36


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


def invert(n, matrix):
    """Invert an n x n matrix, stored row by row, in place; return 0 if it is singular or not finite, else 1."""
    a, order = [matrix[n * i : n * i + n] for i in range(n)], [0] * n
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: fabs(a[i][k]))
        if not (fabs(a[pivot][k]) > 0.0 and isfinite(a[pivot][k])):
            matrix[:] = [x for row in a for x in row]
            return 0
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
    matrix[:] = [x for row in a for x in row]
    return 1


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
    sum_3 = 0.0
    sum_4 = 0.0
    sum_5 = 0.0
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
        sum_3 += (
            sign * (newer * memory.values[row][3] + older * memory.values[row + 1][3])
        )
        sum_4 += (
            sign * (newer * memory.values[row][4] + older * memory.values[row + 1][4])
        )
        sum_5 += (
            sign * (newer * memory.values[row][5] + older * memory.values[row + 1][5])
        )
    sum[:] = sum_0, sum_1, sum_2, sum_3, sum_4, sum_5


def _difference_size(memory, order):
    """The sum of the absolute values of the components of a backward difference."""
    row = [0.0] * 6
    _difference(memory, order, 0, 1.0, row)
    size = 0.0
    for i in range(6):
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
        moved += abs(solution[3] - memory.values[memory.place][3])
        moved += abs(solution[4] - memory.values[memory.place][4])
        moved += abs(solution[5] - memory.values[memory.place][5])
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
        g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
        if memory.known > 0:
            v1_0, v1_1, v1_2, v2_0, v2_1, v2_2 = memory.guess
        else:
            Wxi0_0 = 0.9900990099009901 * mu0
            Wxi0_2 = 100.0 * mu2
            v1_0 = Wxi0_0
            v1_1 = mu1
            v1_2 = Wxi0_2
            v2_0 = Wxi0_0
            v2_1 = mu1
            v2_2 = Wxi0_2
        w1 = 0.5 * h
        w2 = 0.5386751345948129 * h
        w3 = 0.25 * h
        w29 = -0.03867513459481288 * h
        w78 = -0.5386751345948129 * h
        w92 = -0.25 * h
        w99 = -0.25 * h
        w100 = 0.03867513459481288 * h
        # the equations of v1, v2, m1, m2: Newton's method, 6 unknowns
        previous_1 = 0.0
        rate_1 = memory.rate_1 if memory.known > 0 else 1.0
        make_1 = not memory.age_1 > 0
        sweep = 0
        status = NOT_CONVERGED
        while True:
            sweep += 1
            X2_2 = v1_2 * w2 + v2_2 * w3
            X2_0 = v1_0 * w2 + v2_0 * w3
            w4 = v2_0 * X2_2 - v2_2 * X2_0
            X2_1 = v1_1 * w2 + v2_1 * w3
            w5 = X2_0 * X2_0 + X2_1 * X2_1 + X2_2 * X2_2
            c1_1, c2_1, c3_1 = _stumpff_123(w5)
            w7 = 1.0 - 0.08333333333333333 * w5
            w8 = 1.0 / (w7 * w7 + 0.25 * w5)
            w9 = w8 * (0.25 - 0.08333333333333333 * w7)
            w11 = -0.5 * w8
            w12 = w5 * (w9 * c1_1 + w11 * c2_1) - (w11 + c1_1)
            w13 = v2_2 * X2_1 - v2_1 * X2_2
            w14 = v2_1 * X2_0 - v2_0 * X2_1
            w15 = X2_2 * w13 - X2_0 * w14
            w16 = w9 + c2_1 + w11 * c1_1 - w9 * c2_1 * w5
            a_6_1 = v2_1 + w4 * w12 + w15 * w16
            w17 = X2_0 * w4 - X2_1 * w13
            a_6_2 = v2_2 + w12 * w14 + w16 * w17
            w18 = g22 * X2_0 - g20 * X2_2
            w19 = g20 * X2_1 - g21 * X2_0
            w20 = g21 * X2_2 - g22 * X2_1
            Q2_7 = g21 + w18 * c1_1 + (X2_0 * w19 - X2_2 * w20) * c2_1
            Q2_8 = g22 + w19 * c1_1 + (X2_1 * w20 - X2_0 * w18) * c2_1
            w21 = 3.26 - 3.0 * Q2_8
            w22 = 0.3 * Q2_7
            w23 = w21 - w22
            w24 = 1.5 / (w23 * _sqrt(w23))
            w25 = w21 + w22
            w26 = 1.5 / (w25 * _sqrt(w25))
            w27 = -1.0 - (w24 - w26)
            w28 = 0.1 * (w24 + w26)
            Nn2_0 = Q2_7 * w27 + Q2_8 * w28 + 0.99 * (a_6_1 * a_6_2)
            X1_2 = v1_2 * w3 + v2_2 * w29
            X1_0 = v1_0 * w3 + v2_0 * w29
            w30 = v1_0 * X1_2 - v1_2 * X1_0
            X1_1 = v1_1 * w3 + v2_1 * w29
            w31 = X1_0 * X1_0 + X1_1 * X1_1 + X1_2 * X1_2
            c1_2, c2_2, c3_2 = _stumpff_123(w31)
            w33 = 1.0 - 0.08333333333333333 * w31
            w34 = 1.0 / (w33 * w33 + 0.25 * w31)
            w35 = w34 * (0.25 - 0.08333333333333333 * w33)
            w37 = -0.5 * w34
            w38 = w31 * (w35 * c1_2 + w37 * c2_2) - (w37 + c1_2)
            w39 = v1_2 * X1_1 - v1_1 * X1_2
            w40 = v1_1 * X1_0 - v1_0 * X1_1
            w41 = X1_2 * w39 - X1_0 * w40
            w42 = w35 + c2_2 + w37 * c1_2 - w35 * c2_2 * w31
            a_2_1 = v1_1 + w30 * w38 + w41 * w42
            w43 = X1_0 * w30 - X1_1 * w39
            a_2_2 = v1_2 + w38 * w40 + w42 * w43
            w44 = g22 * X1_0 - g20 * X1_2
            w45 = g20 * X1_1 - g21 * X1_0
            w46 = g21 * X1_2 - g22 * X1_1
            Q1_7 = g21 + w44 * c1_2 + (X1_0 * w45 - X1_2 * w46) * c2_2
            Q1_8 = g22 + w45 * c1_2 + (X1_1 * w46 - X1_0 * w44) * c2_2
            w47 = 3.26 - 3.0 * Q1_8
            w48 = 0.3 * Q1_7
            w49 = w47 - w48
            w50 = 1.5 / (w49 * _sqrt(w49))
            w51 = w47 + w48
            w52 = 1.5 / (w51 * _sqrt(w51))
            w53 = -1.0 - (w50 - w52)
            w54 = 0.1 * (w50 + w52)
            Nn1_0 = Q1_7 * w53 + Q1_8 * w54 + 0.99 * (a_2_1 * a_2_2)
            s_L_0 = mu0 + w1 * (Nn2_0 + Nn1_0)
            Y_0 = (v1_0 + v2_0) * w1
            Y_1 = (v1_1 + v2_1) * w1
            Y_2 = (v1_2 + v2_2) * w1
            w55 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
            c2_3, c3_3 = _stumpff_23(w55)
            w57 = X2_1 * w14 - X2_2 * w4
            a_6_0 = v2_0 + w12 * w13 + w16 * w57
            Q2_6 = g20 + w20 * c1_1 + (X2_2 * w18 - X2_1 * w19) * c2_1
            w58 = a_6_2 * a_6_0 + w27 * Q2_6
            w59 = X1_1 * w40 - X1_2 * w30
            a_2_0 = v1_0 + w38 * w39 + w42 * w59
            Q1_6 = g20 + w46 * c1_2 + (X1_2 * w44 - X1_1 * w45) * c2_2
            w60 = a_2_2 * a_2_0 + w53 * Q1_6
            s_L_1 = mu1 - w1 * (w58 + w60)
            Nn2_2 = 0.01 * (a_6_1 * a_6_0) - w28 * Q2_6
            Nn1_2 = 0.01 * (a_2_1 * a_2_0) - w54 * Q1_6
            s_L_2 = mu2 + w1 * (Nn2_2 + Nn1_2)
            w61 = Y_2 * s_L_1 - Y_1 * s_L_2
            w63 = Y_0 * s_L_2 - s_L_0 * Y_2
            w64 = s_L_0 * Y_1 - Y_0 * s_L_1
            L_4_0 = s_L_0 - w61 * c2_3 + (Y_2 * w63 - Y_1 * w64) * c3_3
            w65 = X2_1 * Nn2_2 + X2_2 * w58
            w67 = X2_0 * w58 + X2_1 * Nn2_0
            w68 = X2_2 * Nn2_0 - X2_0 * Nn2_2
            p_2_0 = 1.01 * a_6_0
            p_2_2 = 0.01 * a_6_2
            w69 = X2_2 * p_2_0 - X2_0 * p_2_2
            w70 = X2_1 * p_2_2 - X2_2 * a_6_1
            w71 = X2_0 * a_6_1 - X2_1 * p_2_0
            a_8_1 = a_6_1 - w12 * w69 + w16 * (X2_2 * w70 - X2_0 * w71)
            a_5_2 = v2_2 - w11 * w14 + w9 * w17
            a_5_1 = v2_1 - w4 * w11 + w9 * w15
            a_5_0 = v2_0 - w11 * w13 + w9 * w57
            w72 = 0.5 * a_5_2 - 0.08333333333333333 * (X2_0 * a_5_1 - X2_1 * a_5_0)
            a_8_2 = p_2_2 - w12 * w71 + w16 * (X2_0 * w69 - X2_1 * w70)
            w73 = 0.5 * a_5_1 - 0.08333333333333333 * (X2_2 * a_5_0 - X2_0 * a_5_2)
            a_8_0 = p_2_0 - w12 * w70 + w16 * (X2_1 * w71 - X2_2 * w69)
            w74 = X2_0 * a_8_2 - X2_2 * a_8_0
            w75 = -0.08333333333333333 * a_5_2
            w76 = X2_1 * a_8_0 - X2_0 * a_8_1
            w77 = -0.08333333333333333 * a_5_1
            sum_d2_0 = (
                Nn2_0 + w65 * c2_1 - (X2_1 * w67 + X2_2 * w68) * c3_1
                - (a_8_1 * w72 - a_8_2 * w73 + (w74 * w75 - w76 * w77))
            )
            w79 = X1_1 * Nn1_2 + X1_2 * w60
            w81 = X1_0 * w60 + X1_1 * Nn1_0
            w82 = X1_2 * Nn1_0 - X1_0 * Nn1_2
            p_0 = 1.01 * a_2_0
            p_2 = 0.01 * a_2_2
            w83 = X1_2 * p_0 - X1_0 * p_2
            w84 = X1_1 * p_2 - X1_2 * a_2_1
            w85 = X1_0 * a_2_1 - X1_1 * p_0
            a_4_1 = a_2_1 - w38 * w83 + w42 * (X1_2 * w84 - X1_0 * w85)
            a_2 = v1_2 - w37 * w40 + w35 * w43
            a_1 = v1_1 - w30 * w37 + w35 * w41
            a_0 = v1_0 - w37 * w39 + w35 * w59
            w86 = 0.5 * a_2 - 0.08333333333333333 * (X1_0 * a_1 - X1_1 * a_0)
            a_4_2 = p_2 - w38 * w85 + w42 * (X1_0 * w83 - X1_1 * w84)
            w87 = 0.5 * a_1 - 0.08333333333333333 * (X1_2 * a_0 - X1_0 * a_2)
            a_4_0 = p_0 - w38 * w84 + w42 * (X1_1 * w85 - X1_2 * w83)
            w88 = X1_0 * a_4_2 - X1_2 * a_4_0
            w89 = -0.08333333333333333 * a_2
            w90 = X1_1 * a_4_0 - X1_0 * a_4_1
            w91 = -0.08333333333333333 * a_1
            sum_d1_0 = (
                Nn1_0 + w79 * c2_2 - (X1_1 * w81 + X1_2 * w82) * c3_2
                - (a_4_1 * w86 - a_4_2 * w87 + (w88 * w89 - w90 * w91))
            )
            w1_0 = L_4_0 + sum_d2_0 * w78 + sum_d1_0 * w92
            residual_0 = w1_0 - a_4_0
            L_4_1 = s_L_1 - w63 * c2_3 + (Y_0 * w64 - Y_2 * w61) * c3_3
            w93 = 0.5 * a_5_0 - 0.08333333333333333 * (X2_1 * a_5_2 - X2_2 * a_5_1)
            w94 = -0.08333333333333333 * a_5_0
            w95 = X2_2 * a_8_1 - X2_1 * a_8_2
            sum_d2_1 = (
                w68 * c2_1 - w58 + (X2_2 * w65 + X2_0 * w67) * c3_1
                - (a_8_2 * w93 - w72 * a_8_0 + (w76 * w94 - w75 * w95))
            )
            w96 = 0.5 * a_0 - 0.08333333333333333 * (X1_1 * a_2 - X1_2 * a_1)
            w97 = -0.08333333333333333 * a_0
            w98 = X1_2 * a_4_1 - X1_1 * a_4_2
            sum_d1_1 = (
                w82 * c2_2 - w60 + (X1_2 * w79 + X1_0 * w81) * c3_2
                - (a_4_2 * w96 - w86 * a_4_0 + (w90 * w97 - w89 * w98))
            )
            w1_1 = L_4_1 + w78 * sum_d2_1 + w92 * sum_d1_1
            residual_1 = w1_1 - a_4_1
            L_4_2 = s_L_2 - w64 * c2_3 + (Y_1 * w61 - Y_0 * w63) * c3_3
            sum_d2_2 = (
                Nn2_2 - w67 * c2_1 + (X2_0 * w68 - X2_1 * w65) * c3_1
                - (w73 * a_8_0 - a_8_1 * w93 + (w77 * w95 - w74 * w94))
            )
            sum_d1_2 = (
                Nn1_2 - w81 * c2_2 + (X1_0 * w82 - X1_1 * w79) * c3_2
                - (w87 * a_4_0 - a_4_1 * w96 + (w91 * w98 - w88 * w97))
            )
            w1_2 = L_4_2 + w78 * sum_d2_2 + w92 * sum_d1_2
            residual_2 = w1_2 - a_4_2
            w2_0 = L_4_0 + sum_d2_0 * w99 + sum_d1_0 * w100
            residual_2_0 = w2_0 - a_8_0
            w2_1 = L_4_1 + sum_d2_1 * w99 + sum_d1_1 * w100
            residual_2_1 = w2_1 - a_8_1
            w2_2 = L_4_2 + sum_d2_2 * w99 + sum_d1_2 * w100
            residual_2_2 = w2_2 - a_8_2
            s_L_0_seen = s_L_0
            s_L_1_seen = s_L_1
            s_L_2_seen = s_L_2
            if make_1:
                w101 = 0.0001933756729740644 * v2_2
                w102 = 0.25 * mu2
                w103 = -0.01933756729740644 * v2_1
                w104 = -0.25 * mu1
                w105 = -0.25 * mu2
                w106 = 0.019144191624432375 * v2_0
                w107 = 0.25 * mu0
                w108 = 0.25 * mu1
                w109 = -0.25 * mu0
                w110 = -0.0026933756729740645 * v1_2
                w111 = 0.26933756729740643 * v1_1
                w112 = -0.26664419162443237 * v1_0
                memory.inverse_1[:] = (
                    1.01, -h * (0.495 * v1_2 + w102 + w101),
                    -h * (0.495 * v1_1 + w104 + w103), 0.0,
                    -h * (w102 - 0.01933756729740644 * v1_2 + 0.22835580837556763 * v2_2),
                    -h * (0.0001933756729740644 * v1_1 + w104 + 0.22835580837556763 * v2_1),
                    -h * (w105 - 0.5 * v1_2 + w101), 1.0,
                    -h * (w107 - 0.5 * v1_0 + w106),
                    -h * (0.019144191624432375 * v1_2 + w105 - 0.23066243270259357 * v2_2),
                    0.0,
                    -h * (0.0001933756729740644 * v1_0 + w107 - 0.23066243270259357 * v2_0),
                    -h * (0.005 * v1_1 + w108 + w103),
                    -h * (0.005 * v1_0 + w109 + w106), 0.01,
                    -h * (0.019144191624432375 * v1_1 + w108 + 0.0023066243270259356 * v2_1),
                    -h * (w109 - 0.01933756729740644 * v1_0 + 0.0023066243270259356 * v2_0),
                    0.0, 0.0,
                    -h * (0.5141441916244324 * v1_2 + w102 + 0.26933756729740643 * v2_2),
                    -h * (0.5141441916244324 * v1_1 + w104 - 0.0026933756729740645 * v2_1),
                    1.01, -h * (w102 + w110 + 0.495 * v2_2),
                    -h * (w104 + w111 + 0.495 * v2_1),
                    -h * (w105 - 0.5193375672974064 * v1_2 - 0.26664419162443237 * v2_2),
                    0.0,
                    -h * (w107 - 0.5193375672974064 * v1_0 - 0.0026933756729740645 * v2_0),
                    -h * (w105 + w110 - 0.5 * v2_2), 1.0,
                    -h * (w107 + w112 - 0.5 * v2_0),
                    -h * (0.005193375672974065 * v1_1 + w108 - 0.26664419162443237 * v2_1),
                    -h * (0.005193375672974065 * v1_0 + w109 + 0.26933756729740643 * v2_0),
                    0.0, -h * (w108 + w111 + 0.005 * v2_1),
                    -h * (w109 + w112 + 0.005 * v2_0), 0.01,
                )
                memory.age_1 = invert(6, memory.inverse_1)
                if memory.age_1 > 0:
                    _count_matrix(statistics)
            d_v1_0 = (
                memory.inverse_1[0] * residual_0 + memory.inverse_1[1] * residual_1
                + (memory.inverse_1[2] * residual_2
                + memory.inverse_1[3] * residual_2_0) + (memory.inverse_1[4]
                * residual_2_1 + memory.inverse_1[5] * residual_2_2)
            )
            d_v1_1 = (
                memory.inverse_1[6] * residual_0 + memory.inverse_1[7] * residual_1
                + (memory.inverse_1[8] * residual_2
                + memory.inverse_1[9] * residual_2_0) + (memory.inverse_1[10]
                * residual_2_1 + memory.inverse_1[11] * residual_2_2)
            )
            d_v1_2 = (
                memory.inverse_1[12] * residual_0 + memory.inverse_1[13] * residual_1
                + (memory.inverse_1[14] * residual_2
                + memory.inverse_1[15] * residual_2_0) + (memory.inverse_1[16]
                * residual_2_1 + memory.inverse_1[17] * residual_2_2)
            )
            d_v2_0 = (
                memory.inverse_1[18] * residual_0 + memory.inverse_1[19] * residual_1
                + (memory.inverse_1[20] * residual_2
                + memory.inverse_1[21] * residual_2_0) + (memory.inverse_1[22]
                * residual_2_1 + memory.inverse_1[23] * residual_2_2)
            )
            d_v2_1 = (
                memory.inverse_1[24] * residual_0 + memory.inverse_1[25] * residual_1
                + (memory.inverse_1[26] * residual_2
                + memory.inverse_1[27] * residual_2_0) + (memory.inverse_1[28]
                * residual_2_1 + memory.inverse_1[29] * residual_2_2)
            )
            d_v2_2 = (
                memory.inverse_1[30] * residual_0 + memory.inverse_1[31] * residual_1
                + (memory.inverse_1[32] * residual_2
                + memory.inverse_1[33] * residual_2_0) + (memory.inverse_1[34]
                * residual_2_1 + memory.inverse_1[35] * residual_2_2)
            )
            change = (
                abs(d_v1_0) + abs(d_v1_1) + (abs(d_v1_2) + abs(d_v2_0))
                + (abs(d_v2_1) + abs(d_v2_2))
            )
            scale = (
                abs(v1_0) + abs(v1_1) + (abs(v1_2) + abs(v2_0))
                + (abs(v2_1) + abs(v2_2))
            )
            v1_0 += d_v1_0
            v1_1 += d_v1_1
            v1_2 += d_v1_2
            v2_0 += d_v2_0
            v2_1 += d_v2_1
            v2_2 += d_v2_2
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
                (OK if memory.age_1 > 0 and converged else NOT_CONVERGED)
                if isfinite(change) else NOT_FINITE
            )
            make_1 = False
            previous_1 = change
            if (
                not (status == NOT_CONVERGED and sweep < 100
                and not (not memory.age_1 > 0))
            ):
                break
        if status != OK and (status == NOT_CONVERGED and not memory.age_1 > 0):
            status = SINGULAR
        _count_sweeps(statistics, 0, sweep, status != OK)
        if status != OK:
            return status
        memory.rate_1 = rate_1
        solution = [v1_0, v1_1, v1_2, v2_0, v2_1, v2_2]
        _remember(memory, solution)
        Y_1_ = (v1_1 + v2_1) * w1
        Y_0_ = (v1_0 + v2_0) * w1
        Y_2_ = (v1_2 + v2_2) * w1
        w113 = Y_0_ * Y_0_ + Y_1_ * Y_1_ + Y_2_ * Y_2_
        c1_3, c2_4 = _stumpff_12(w113)
        w115 = Y_1_ * c2_4
        w116 = Y_1_ * w115
        w117 = Y_2_ * c2_4 * Y_2_
        g_0 = 1.0 - (w116 + w117)
        w119 = Y_2_ * c1_3
        w120 = Y_0_ * c2_4
        w121 = Y_1_ * w120
        g_3 = w119 + w121
        w122 = Y_2_ * w120
        w123 = Y_1_ * c1_3
        g_6 = w122 - w123
        g_1 = w121 - w119
        w124 = Y_0_ * w120
        g_4 = 1.0 - (w117 + w124)
        w125 = Y_0_ * c1_3
        w126 = Y_2_ * w115
        g_7 = w125 + w126
        g_2 = w122 + w123
        g_5 = w126 - w125
        g_8 = 1.0 - (w116 + w124)
        w127 = 0.495 * h
        w128 = (
            s_L_0_seen + v1_2 * w127 * d_v1_1 + v1_1 * w127 * d_v1_2
            + v2_2 * w127 * d_v2_1 + v2_1 * w127 * d_v2_2
        )
        w129 = -0.5 * h
        w130 = (
            s_L_1_seen + v1_2 * w129 * d_v1_0 + v1_0 * w129 * d_v1_2
            + v2_2 * w129 * d_v2_0 + v2_0 * w129 * d_v2_2
        )
        w131 = 0.005 * h
        w132 = (
            s_L_2_seen + v1_1 * w131 * d_v1_0 + v1_0 * w131 * d_v1_1
            + v2_1 * w131 * d_v2_0 + v2_0 * w131 * d_v2_1
        )
        new_g00 = g00 * g_0 + g01 * g_3 + g02 * g_6
        new_g01 = g00 * g_1 + g01 * g_4 + g02 * g_7
        new_g02 = g00 * g_2 + g01 * g_5 + g02 * g_8
        new_g10 = g10 * g_0 + g11 * g_3 + g12 * g_6
        new_g11 = g10 * g_1 + g11 * g_4 + g12 * g_7
        new_g12 = g10 * g_2 + g11 * g_5 + g12 * g_8
        new_g20 = g20 * g_0 + g21 * g_3 + g22 * g_6
        new_g21 = g20 * g_1 + g21 * g_4 + g22 * g_7
        new_g22 = g20 * g_2 + g21 * g_5 + g22 * g_8
        if not all(map(isfinite, (new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21, new_g22, w128, w130, w132))):
            return NOT_FINITE
        memory.age_1 = memory.age_1 + 1 if memory.age_1 % 3 > 0 else 0
        state[:] = (
            new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21,
            new_g22, w128, w130, w132,
        )
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
    known_solution = [0.0] * 6
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
    memory = _Memory()
    recording = stride > 0 and trajectory is not None
    row = 0
    if recording:
        trajectory[0][:] = state
    moving = [0.0] * 12
    before = [0.0] * 3
    _enter_body(state, moving, before)
    while status == OK and step < steps:
        status = _advance(moving, h, memory, statistics)
        if status != OK and status != BAD_STEP:
            status = _continued(moving, h, memory, statistics)
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
    SINGULAR: "the matrix of {block} is singular",
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
