"""Dipole on a stick, T*SO(3): one step by vcf:cf4

method:     family vcf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, On symplectic
            integration in Lie groups and manifolds, PhD thesis, NTNU 2014, Section
            2.2.1
order:      4, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 3.2e-17
scene:      Dipole on a stick, T*SO(3), group SO(3)
solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12
            unknowns; 1.7 sweeps and 0.2 matrices a step, measured over the first 20
            steps of size h = 0.005
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of
            SO(3)
left out:   24 adjoint maps, 5 products, 1 sum: coefficients are zero, or terms
            cancel
            4 Legendre transforms, 19 adjoint maps, 31 evaluations of dexp*, 1
            exponential, 4 sums: equal values are computed once
            7 adjoint maps, 1 evaluation of the derivatives of H: no result depends
            on these operations
            4 adjoint maps, 9 evaluations of dexp*: a linear map is applied once to
            a sum and not to each term
            4 adjoint maps: an adjoint map and its inverse cancel
            5 evaluations of dexp*: functions of the same ad_x are combined
            arguments for constant parameters: beta = 1, depth = 3/2
            the time is not needed: no formula depends on the time
operations: 116 add, 179 mul, 2 sqrt, 2 div, 2 stumpff_12 a step
            2 mul once in each run, for the initial guess of the first step
            102 add, 184 mul for each matrix of the equations of xi1, xi2, xi3, xi4,
            n1, n2, n3, n4
            442 add, 562 mul, 6 div, 6 sqrt, 4 stumpff_123, 1 stumpff_23 for each
            sweep of the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
            12 add, 18 mul at the start of a run, 12 add, 9 mul at the end of a run
command:    orderconds emit dipole --method vcf:cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcf_cf4

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcf_cf4.run(state, 0.005, 100))
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
        self.sweeps = [0] * 1  # by block: the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
        self.most = 0  # largest number of sweeps of one block in one step or substep
        self.failed = 0  # number of the block that failed, counted from 1; 0 if none
        self.matrices = 0  # number of Newton matrices that were computed

    labels = [
        "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4",
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
        self.guess = [0.0] * 12  # initial guess for the next step
        self.values = [[0.0] * 12 for _ in range(32)]
        self.rate_1 = 0.0
        self.age_1 = 0  # age of the stored inverse of the Newton matrix; 0 if none is stored
        self.inverse_1 = [0.0] * 144


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
    sum_6 = 0.0
    sum_7 = 0.0
    sum_8 = 0.0
    sum_9 = 0.0
    sum_10 = 0.0
    sum_11 = 0.0
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
        sum_6 += (
            sign * (newer * memory.values[row][6] + older * memory.values[row + 1][6])
        )
        sum_7 += (
            sign * (newer * memory.values[row][7] + older * memory.values[row + 1][7])
        )
        sum_8 += (
            sign * (newer * memory.values[row][8] + older * memory.values[row + 1][8])
        )
        sum_9 += (
            sign * (newer * memory.values[row][9] + older * memory.values[row + 1][9])
        )
        sum_10 += (
            sign * (newer * memory.values[row][10] + older * memory.values[row + 1][10])
        )
        sum_11 += (
            sign * (newer * memory.values[row][11] + older * memory.values[row + 1][11])
        )
    sum[:] = (
        sum_0, sum_1, sum_2, sum_3, sum_4, sum_5, sum_6, sum_7, sum_8, sum_9, sum_10,
        sum_11,
    )


def _difference_size(memory, order):
    """The sum of the absolute values of the components of a backward difference."""
    row = [0.0] * 12
    _difference(memory, order, 0, 1.0, row)
    size = 0.0
    for i in range(12):
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
        moved += abs(solution[6] - memory.values[memory.place][6])
        moved += abs(solution[7] - memory.values[memory.place][7])
        moved += abs(solution[8] - memory.values[memory.place][8])
        moved += abs(solution[9] - memory.values[memory.place][9])
        moved += abs(solution[10] - memory.values[memory.place][10])
        moved += abs(solution[11] - memory.values[memory.place][11])
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
            (
                xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0,
                xi4_1, xi4_2,
            ) = memory.guess
        else:
            Wxi0_0 = 0.9900990099009901 * mu0
            Wxi0_2 = 100.0 * mu2
            xi1_0 = Wxi0_0
            xi1_1 = mu1
            xi1_2 = Wxi0_2
            xi2_0 = Wxi0_0
            xi2_1 = mu1
            xi2_2 = Wxi0_2
            xi3_0 = Wxi0_0
            xi3_1 = mu1
            xi3_2 = Wxi0_2
            xi4_0 = Wxi0_0
            xi4_1 = mu1
            xi4_2 = Wxi0_2
        w1 = -0.5 * h
        w2 = 0.5 * h
        w59 = 0.16666666666666666 * h
        w60 = 3.0 * g22
        w61 = 3.26 - w60
        w62 = 0.3 * g21
        w63 = w61 - w62
        w64 = _sqrt(w63)
        w65 = w63 * w64
        w66 = 1.5 / w65
        w67 = w61 + w62
        w68 = _sqrt(w67)
        w69 = w67 * w68
        w70 = 1.5 / w69
        w71 = w66 - w70
        w72 = -1.0 - w71
        w73 = g21 * w72
        w74 = w66 + w70
        w75 = 0.1 * w74
        w76 = g22 * w75
        w77 = w73 + w76
        w103 = 0.3333333333333333 * h
        w104 = 0.25 * h
        w107 = -0.08333333333333333 * h
        w114 = g20 * w72
        w117 = g20 * w75
        w131 = 0.08333333333333333 * h
        w132 = -0.16666666666666666 * h
        w133 = -0.25 * h
        # the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12
        # unknowns
        previous_1 = 0.0
        rate_1 = memory.rate_1 if memory.known > 0 else 1.0
        make_1 = not memory.age_1 > 0
        sweep = 0
        status = NOT_CONVERGED
        while True:
            sweep += 1
            xE2_1_1 = xi1_1 * w2
            xE2_1_0 = xi1_0 * w2
            xE2_1_2 = xi1_2 * w2
            w3 = xE2_1_0 * xE2_1_0 + xE2_1_1 * xE2_1_1 + xE2_1_2 * xE2_1_2
            c1_1, c2_1, c3_1 = _stumpff_123(w3)
            w5 = xE2_1_0 * c2_1
            w6 = xE2_1_1 * w5
            w8 = xE2_1_2 * c1_1
            gE2_1_1 = w6 - w8
            xE4_2_1 = h * xi3_1 + xi1_1 * w1
            xE4_2_0 = h * xi3_0 + xi1_0 * w1
            xE4_2_2 = h * xi3_2 + xi1_2 * w1
            w9 = xE4_2_0 * xE4_2_0 + xE4_2_1 * xE4_2_1 + xE4_2_2 * xE4_2_2
            c1_2, c2_2, c3_2 = _stumpff_123(w9)
            w11 = xE4_2_1 * c2_2
            w12 = xE4_2_1 * w11
            w13 = xE4_2_2 * c2_2 * xE4_2_2
            gE4_2_0 = 1.0 - (w12 + w13)
            w14 = xE2_1_0 * w5
            w15 = xE2_1_2 * c2_1 * xE2_1_2
            gE2_1_4 = 1.0 - (w14 + w15)
            w16 = xE4_2_0 * c2_2
            w17 = xE4_2_1 * w16
            w19 = xE4_2_2 * c1_2
            gE4_2_1 = w17 - w19
            w20 = xE2_1_0 * c1_1
            w21 = xE2_1_1 * c2_1
            w22 = xE2_1_2 * w21
            gE2_1_7 = w20 + w22
            w23 = xE4_2_1 * c1_2
            w24 = xE4_2_2 * w16
            gE4_2_2 = w23 + w24
            E4_2_1 = gE2_1_1 * gE4_2_0 + gE2_1_4 * gE4_2_1 + gE2_1_7 * gE4_2_2
            gE4_2_3 = w17 + w19
            w25 = xE4_2_0 * w16
            gE4_2_4 = 1.0 - (w13 + w25)
            w26 = xE4_2_2 * w11
            w27 = xE4_2_0 * c1_2
            gE4_2_5 = w26 - w27
            E4_2_4 = gE2_1_1 * gE4_2_3 + gE2_1_4 * gE4_2_4 + gE2_1_7 * gE4_2_5
            gE4_2_6 = w24 - w23
            gE4_2_7 = w26 + w27
            gE4_2_8 = 1.0 - (w12 + w25)
            E4_2_7 = gE2_1_1 * gE4_2_6 + gE2_1_4 * gE4_2_7 + gE2_1_7 * gE4_2_8
            a_5_1 = xi4_0 * E4_2_1 + xi4_1 * E4_2_4 + xi4_2 * E4_2_7
            w28 = xE2_1_1 * c1_1
            w29 = xE2_1_2 * w5
            gE2_1_2 = w28 + w29
            gE2_1_5 = w22 - w20
            w30 = xE2_1_1 * w21
            gE2_1_8 = 1.0 - (w14 + w30)
            E4_2_2 = gE4_2_0 * gE2_1_2 + gE4_2_1 * gE2_1_5 + gE4_2_2 * gE2_1_8
            E4_2_5 = gE4_2_3 * gE2_1_2 + gE4_2_4 * gE2_1_5 + gE4_2_5 * gE2_1_8
            E4_2_8 = gE4_2_6 * gE2_1_2 + gE4_2_7 * gE2_1_5 + gE4_2_8 * gE2_1_8
            a_5_2 = xi4_0 * E4_2_2 + xi4_1 * E4_2_5 + xi4_2 * E4_2_8
            Q4_7 = g20 * E4_2_1 + g21 * E4_2_4 + g22 * E4_2_7
            Q4_8 = g20 * E4_2_2 + g21 * E4_2_5 + g22 * E4_2_8
            w31 = 3.26 - 3.0 * Q4_8
            w32 = 0.3 * Q4_7
            w33 = w31 - w32
            w34 = 1.5 / (w33 * _sqrt(w33))
            w35 = w31 + w32
            w36 = 1.5 / (w35 * _sqrt(w35))
            w37 = -1.0 - (w34 - w36)
            w38 = 0.1 * (w34 + w36)
            Nr4_0 = Q4_7 * w37 + Q4_8 * w38 + 0.99 * (a_5_1 * a_5_2)
            a_1 = xi2_0 * gE2_1_1 + xi2_1 * gE2_1_4 + xi2_2 * gE2_1_7
            a_2 = xi2_0 * gE2_1_2 + xi2_1 * gE2_1_5 + xi2_2 * gE2_1_8
            w39 = g22 * xE2_1_0 - g20 * xE2_1_2
            w40 = g20 * xE2_1_1 - g21 * xE2_1_0
            w41 = g21 * xE2_1_2 - g22 * xE2_1_1
            Q2_7 = g21 + w39 * c1_1 + (xE2_1_0 * w40 - xE2_1_2 * w41) * c2_1
            Q2_8 = g22 + w40 * c1_1 + (xE2_1_1 * w41 - xE2_1_0 * w39) * c2_1
            w42 = 3.26 - 3.0 * Q2_8
            w43 = 0.3 * Q2_7
            w44 = w42 - w43
            w45 = 1.5 / (w44 * _sqrt(w44))
            w46 = w42 + w43
            w47 = 1.5 / (w46 * _sqrt(w46))
            w48 = -1.0 - (w45 - w47)
            w49 = 0.1 * (w45 + w47)
            sum_Nr4_0 = Nr4_0 + 2.0 * (Q2_7 * w48 + Q2_8 * w49 + 0.99 * (a_1 * a_2))
            s_nu2_0 = w1 * sum_Nr4_0
            gE2_1_0 = 1.0 - (w15 + w30)
            gE2_1_3 = w6 + w8
            gE2_1_6 = w29 - w28
            a_0 = xi2_0 * gE2_1_0 + xi2_1 * gE2_1_3 + xi2_2 * gE2_1_6
            Q2_6 = g20 + w41 * c1_1 + (xE2_1_2 * w39 - xE2_1_1 * w40) * c2_1
            E4_2_0 = gE4_2_0 * gE2_1_0 + gE4_2_1 * gE2_1_3 + gE4_2_2 * gE2_1_6
            E4_2_3 = gE4_2_3 * gE2_1_0 + gE4_2_4 * gE2_1_3 + gE4_2_5 * gE2_1_6
            E4_2_6 = gE4_2_6 * gE2_1_0 + gE4_2_7 * gE2_1_3 + gE4_2_8 * gE2_1_6
            a_5_0 = xi4_0 * E4_2_0 + xi4_1 * E4_2_3 + xi4_2 * E4_2_6
            Q4_6 = g20 * E4_2_0 + g21 * E4_2_3 + g22 * E4_2_6
            w50 = a_5_2 * a_5_0 + w37 * Q4_6
            sum_Nr4_1 = -2.0 * (a_2 * a_0 + w48 * Q2_6) - w50
            s_nu2_1 = w1 * sum_Nr4_1
            Nr4_2 = 0.01 * (a_5_1 * a_5_0) - w38 * Q4_6
            sum_Nr4_2 = Nr4_2 + 2.0 * (0.01 * (a_1 * a_0) - w49 * Q2_6)
            s_nu2_2 = w1 * sum_Nr4_2
            w51 = xE2_1_2 * s_nu2_1 - xE2_1_1 * s_nu2_2
            w53 = xE2_1_0 * s_nu2_2 - xE2_1_2 * s_nu2_0
            w54 = xE2_1_1 * s_nu2_0 - xE2_1_0 * s_nu2_1
            p1_11_2_0 = s_nu2_0 - w51 * c2_1 + (xE2_1_2 * w53 - xE2_1_1 * w54) * c3_1
            m1_13_0 = Nr4_0 * gE2_1_0 - gE2_1_1 * w50 + gE2_1_2 * Nr4_2
            m1_13_1 = Nr4_0 * gE2_1_3 - gE2_1_4 * w50 + gE2_1_5 * Nr4_2
            m1_13_2 = Nr4_0 * gE2_1_6 - gE2_1_7 * w50 + gE2_1_8 * Nr4_2
            w55 = xE4_2_2 * m1_13_1 - xE4_2_1 * m1_13_2
            w57 = xE4_2_0 * m1_13_2 - xE4_2_2 * m1_13_0
            w58 = xE4_2_1 * m1_13_0 - xE4_2_0 * m1_13_1
            p1_13_0 = m1_13_0 - w55 * c2_2 + (xE4_2_2 * w57 - xE4_2_1 * w58) * c3_2
            Nr1_0 = 0.99 * (xi1_1 * xi1_2) + w77
            xE3_1_1 = xi2_1 * w2
            xE3_1_0 = xi2_0 * w2
            xE3_1_2 = xi2_2 * w2
            w78 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2
            c1_3, c2_3, c3_3 = _stumpff_123(w78)
            w80 = xE3_1_0 * c2_3
            w81 = xE3_1_1 * w80
            w83 = xE3_1_2 * c1_3
            gE3_1_1 = w81 - w83
            w84 = xE3_1_0 * w80
            w85 = xE3_1_2 * c2_3 * xE3_1_2
            gE3_1_4 = 1.0 - (w84 + w85)
            w86 = xE3_1_0 * c1_3
            w87 = xE3_1_1 * c2_3
            w88 = xE3_1_2 * w87
            gE3_1_7 = w86 + w88
            a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7
            w89 = xE3_1_1 * c1_3
            w90 = xE3_1_2 * w80
            gE3_1_2 = w89 + w90
            gE3_1_5 = w88 - w86
            w91 = xE3_1_1 * w87
            gE3_1_8 = 1.0 - (w84 + w91)
            a_3_2 = xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8
            w92 = g22 * xE3_1_0 - g20 * xE3_1_2
            w93 = g20 * xE3_1_1 - g21 * xE3_1_0
            w94 = g21 * xE3_1_2 - g22 * xE3_1_1
            Q3_7 = g21 + w92 * c1_3 + (xE3_1_0 * w93 - xE3_1_2 * w94) * c2_3
            Q3_8 = g22 + w93 * c1_3 + (xE3_1_1 * w94 - xE3_1_0 * w92) * c2_3
            w95 = 3.26 - 3.0 * Q3_8
            w96 = 0.3 * Q3_7
            w97 = w95 - w96
            w98 = 1.5 / (w97 * _sqrt(w97))
            w99 = w95 + w96
            w100 = 1.5 / (w99 * _sqrt(w99))
            w101 = -1.0 - (w98 - w100)
            w102 = 0.1 * (w98 + w100)
            Nr3_0 = Q3_7 * w101 + Q3_8 * w102 + 0.99 * (a_3_1 * a_3_2)
            s_p1_0 = mu0 + w59 * (sum_Nr4_0 + Nr1_0) + Nr3_0 * w103
            w105 = xi2_0 + xi3_0
            w106 = w59 * w105
            xe1_0 = xi1_0 * w104 + w106 + xi4_0 * w107
            w108 = xi2_1 + xi3_1
            w109 = w59 * w108
            xe1_1 = xi1_1 * w104 + w109 + xi4_1 * w107
            w110 = xi2_2 + xi3_2
            w111 = w59 * w110
            xe1_2 = xi1_2 * w104 + w111 + xi4_2 * w107
            w112 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
            c1_4, c2_4, c3_4 = _stumpff_123(w112)
            w115 = xi1_0 * xi1_2 + w114
            gE3_1_0 = 1.0 - (w85 + w91)
            gE3_1_3 = w81 + w83
            gE3_1_6 = w90 - w89
            a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6
            Q3_6 = g20 + w94 * c1_3 + (xE3_1_2 * w92 - xE3_1_1 * w93) * c2_3
            w116 = a_3_2 * a_3_0 + w101 * Q3_6
            s_p1_1 = mu1 + w59 * (sum_Nr4_1 - w115) - w103 * w116
            Nr1_2 = 0.01 * (xi1_0 * xi1_1) - w117
            Nr3_2 = 0.01 * (a_3_1 * a_3_0) - w102 * Q3_6
            s_p1_2 = mu2 + w59 * (sum_Nr4_2 + Nr1_2) + w103 * Nr3_2
            w118 = xe1_2 * s_p1_1 - xe1_1 * s_p1_2
            w120 = xe1_0 * s_p1_2 - s_p1_0 * xe1_2
            w121 = s_p1_0 * xe1_1 - xe1_0 * s_p1_1
            p1_11_0 = s_p1_0 - w118 * c2_4 + (xe1_2 * w120 - xe1_1 * w121) * c3_4
            w122 = xe1_1 * c2_4
            w123 = xe1_1 * w122
            w124 = xe1_2 * c2_4 * xe1_2
            ge1_0 = 1.0 - (w123 + w124)
            w125 = xe1_0 * c2_4
            w126 = xe1_1 * w125
            w128 = xe1_2 * c1_4
            ge1_1 = w126 - w128
            w129 = xe1_1 * c1_4
            w130 = xe1_2 * w125
            ge1_2 = w129 + w130
            m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2
            ye2_0 = xi1_0 * w131 + w105 * w132 + xi4_0 * w133
            ye2_1 = xi1_1 * w131 + w108 * w132 + xi4_1 * w133
            ye2_2 = xi1_2 * w131 + w110 * w132 + xi4_2 * w133
            w134 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
            c2_5, c3_5 = _stumpff_23(w134)
            ge1_6 = w130 - w129
            w136 = xe1_0 * c1_4
            w137 = xe1_2 * w122
            ge1_7 = w136 + w137
            w138 = xe1_0 * w125
            ge1_8 = 1.0 - (w123 + w138)
            m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8
            ge1_3 = w126 + w128
            ge1_4 = 1.0 - (w124 + w138)
            ge1_5 = w137 - w136
            m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5
            w139 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1
            w141 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1
            w142 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2
            p1_6_2_0 = m1_6_2_0 - w139 * c2_5 + (ye2_1 * w141 - ye2_2 * w142) * c3_5
            M1_0 = p1_11_2_0 + w2 * p1_13_0 + 1.5 * p1_11_0 - 0.5 * p1_6_2_0
            residual_0 = M1_0 - 1.01 * xi1_0
            p1_11_2_1 = s_nu2_1 - w53 * c2_1 + (xE2_1_0 * w54 - xE2_1_2 * w51) * c3_1
            p1_13_1 = m1_13_1 - w57 * c2_2 + (xE4_2_0 * w58 - xE4_2_2 * w55) * c3_2
            p1_11_1 = s_p1_1 - w120 * c2_4 + (xe1_0 * w121 - xe1_2 * w118) * c3_4
            p1_6_2_1 = m1_6_2_1 - w142 * c2_5 + (ye2_2 * w139 - ye2_0 * w141) * c3_5
            M1_1 = p1_11_2_1 + w2 * p1_13_1 + 1.5 * p1_11_1 - 0.5 * p1_6_2_1
            residual_1 = M1_1 - xi1_1
            p1_11_2_2 = s_nu2_2 - w54 * c2_1 + (xE2_1_1 * w51 - xE2_1_0 * w53) * c3_1
            p1_13_2 = m1_13_2 - w58 * c2_2 + (xE4_2_1 * w55 - xE4_2_0 * w57) * c3_2
            p1_11_2 = s_p1_2 - w121 * c2_4 + (xe1_1 * w118 - xe1_0 * w120) * c3_4
            p1_6_2_2 = m1_6_2_2 - w141 * c2_5 + (ye2_0 * w142 - ye2_1 * w139) * c3_5
            M1_2 = p1_11_2_2 + w2 * p1_13_2 + 1.5 * p1_11_2 - 0.5 * p1_6_2_2
            residual_2 = M1_2 - 0.01 * xi1_2
            w143 = 0.5 * (p1_11_0 + p1_6_2_0)
            w144 = xE3_1_1 * Nr3_2 + xE3_1_2 * w116
            w146 = xE3_1_0 * Nr3_2 - xE3_1_2 * Nr3_0
            w147 = xE3_1_0 * w116 + xE3_1_1 * Nr3_0
            M2_0 = (
                w143
                + w1 * (Nr3_0 + w144 * c2_3 + (xE3_1_2 * w146 - xE3_1_1 * w147) * c3_3)
            )
            p_2_0 = 1.01 * a_0
            p_2_2 = 0.01 * a_2
            a_4_0 = gE2_1_0 * p_2_0 + gE2_1_1 * a_1 + gE2_1_2 * p_2_2
            residual_2_0 = M2_0 - a_4_0
            w148 = 0.5 * (p1_11_1 + p1_6_2_1)
            M2_1 = (
                w148
                + w1 * ((xE3_1_2 * w144 + xE3_1_0 * w147) * c3_3 - (w116 + w146 * c2_3))
            )
            a_4_1 = gE2_1_3 * p_2_0 + gE2_1_4 * a_1 + gE2_1_5 * p_2_2
            residual_2_1 = M2_1 - a_4_1
            w149 = 0.5 * (p1_11_2 + p1_6_2_2)
            M2_2 = (
                w149
                + w1 * (Nr3_2 - w147 * c2_3 - (xE3_1_0 * w146 + xE3_1_1 * w144) * c3_3)
            )
            a_4_2 = gE2_1_6 * p_2_0 + gE2_1_7 * a_1 + gE2_1_8 * p_2_2
            residual_2_2 = M2_2 - a_4_2
            M3_0 = w143 + w1 * p1_13_0
            p_3_0 = 1.01 * a_3_0
            p_3_2 = 0.01 * a_3_2
            a_7_0 = gE3_1_0 * p_3_0 + gE3_1_1 * a_3_1 + gE3_1_2 * p_3_2
            residual_3_0 = M3_0 - a_7_0
            M3_1 = w148 + w1 * p1_13_1
            a_7_1 = gE3_1_3 * p_3_0 + gE3_1_4 * a_3_1 + gE3_1_5 * p_3_2
            residual_3_1 = M3_1 - a_7_1
            M3_2 = w149 + w1 * p1_13_2
            a_7_2 = gE3_1_6 * p_3_0 + gE3_1_7 * a_3_1 + gE3_1_8 * p_3_2
            residual_3_2 = M3_2 - a_7_2
            M4_0 = 1.5 * p1_6_2_0 - 0.5 * p1_11_0
            p_4_0 = 1.01 * a_5_0
            p_4_2 = 0.01 * a_5_2
            a_9_0 = E4_2_0 * p_4_0 + E4_2_1 * a_5_1 + E4_2_2 * p_4_2
            residual_4_0 = M4_0 - a_9_0
            M4_1 = 1.5 * p1_6_2_1 - 0.5 * p1_11_1
            a_9_1 = E4_2_3 * p_4_0 + E4_2_4 * a_5_1 + E4_2_5 * p_4_2
            residual_4_1 = M4_1 - a_9_1
            M4_2 = 1.5 * p1_6_2_2 - 0.5 * p1_11_2
            a_9_2 = E4_2_6 * p_4_0 + E4_2_7 * a_5_1 + E4_2_8 * p_4_2
            residual_4_2 = M4_2 - a_9_2
            s_p1_0_seen = s_p1_0
            s_p1_1_seen = s_p1_1
            s_p1_2_seen = s_p1_2
            if make_1:
                w150 = 0.165 * xi1_2
                w151 = 0.08333333333333333 * mu2
                w152 = 0.165 * xi1_1
                w153 = -0.08333333333333333 * mu1
                w154 = -0.66 * h
                w155 = 0.33 * h
                w156 = xi3_2 * w155
                w157 = xi3_1 * w155
                w158 = 0.165 * xi4_2
                w159 = -0.08333333333333333 * mu2
                w160 = 0.165 * xi4_1
                w161 = 0.08333333333333333 * mu1
                w162 = -0.16666666666666666 * xi1_2
                w163 = -0.16666666666666666 * xi1_0
                w164 = 0.08333333333333333 * mu0
                w165 = 0.6666666666666666 * h
                w166 = -0.3333333333333333 * h
                w167 = xi3_2 * w166
                w168 = xi3_0 * w166
                w169 = -0.16666666666666666 * xi4_2
                w170 = -0.16666666666666666 * xi4_0
                w171 = -0.08333333333333333 * mu0
                w172 = 0.0016666666666666668 * xi1_1
                w173 = 0.0016666666666666668 * xi1_0
                w174 = -0.006666666666666667 * h
                w175 = 0.0033333333333333335 * h
                w176 = xi3_1 * w175
                w177 = xi3_0 * w175
                w178 = 0.0016666666666666668 * xi4_1
                w179 = 0.0016666666666666668 * xi4_0
                w180 = 0.16666666666666666 * mu2
                w181 = w150 + w180
                w182 = -0.16666666666666666 * mu1
                w183 = w152 + w182
                w184 = 0.33 * xi2_2
                w185 = -0.005 * xi1_2
                w186 = 0.33 * xi2_1
                w187 = 0.5 * xi1_1
                w188 = 0.165 * h
                w189 = xi4_2 * w188
                w190 = xi4_1 * w188
                w191 = -0.16666666666666666 * mu2
                w192 = w162 + w191
                w193 = 0.16666666666666666 * mu0
                w194 = w163 + w193
                w195 = -0.3333333333333333 * xi2_2
                w196 = -0.3333333333333333 * xi2_0
                w197 = -0.495 * xi1_0
                w198 = xi4_2 * w132
                w199 = xi4_0 * w132
                w200 = 0.16666666666666666 * mu1
                w201 = w172 + w200
                w202 = -0.16666666666666666 * mu0
                w203 = w173 + w202
                w204 = 0.0033333333333333335 * xi2_1
                w205 = 0.0033333333333333335 * xi2_0
                w206 = 0.0016666666666666668 * h
                w207 = xi4_1 * w206
                w208 = xi4_0 * w206
                w209 = 0.33 * xi3_2
                w210 = -0.005 * xi2_2
                w211 = 0.33 * xi3_1
                w212 = 0.5 * xi2_1
                w213 = -0.33 * h
                w214 = -0.3333333333333333 * xi3_2
                w215 = -0.3333333333333333 * xi3_0
                w216 = -0.495 * xi2_0
                w217 = 0.0033333333333333335 * xi3_1
                w218 = 0.0033333333333333335 * xi3_0
                w219 = -0.0033333333333333335 * h
                w220 = 0.3333333333333333 * mu2
                w221 = -0.3333333333333333 * mu1
                w222 = -0.01 * xi3_2
                w223 = -0.3333333333333333 * mu2
                w224 = 0.3333333333333333 * mu0
                w225 = -0.99 * xi3_0
                w226 = 0.3333333333333333 * mu1
                w227 = -0.3333333333333333 * mu0
                memory.inverse_1[:] = (
                    1.01, -h * (w150 + w151), -h * (w152 + w153), 0.0, -xi2_2 * w154,
                    -xi2_1 * w154, 0.0, -w156, -w157, 0.0, -h * (w158 + w159),
                    -h * (w160 + w161), -h * (w159 + w162), 1.0, -h * (w163 + w164),
                    -xi2_2 * w165, 0.0, -xi2_0 * w165, -w167, 0.0, -w168,
                    -h * (w151 + w169), 0.0, -h * (w170 + w171), -h * (w161 + w172),
                    -h * (w171 + w173), 0.01, -xi2_1 * w174, -xi2_0 * w174, 0.0, -w176,
                    -w177, 0.0, -h * (w153 + w178), -h * (w164 + w179), 0.0, 0.0,
                    -h * (0.5 * xi2_2 + w181), -h * (w183 - 0.005 * xi2_1), 1.01,
                    -h * (w180 + w185 + w184), -h * (w182 + w187 + w186), 0.0,
                    -h * (w180 - 0.165 * xi3_2), -h * (w182 - 0.165 * xi3_1), 0.0,
                    -w189, -w190, -h * (w192 - 0.495 * xi2_2), 0.0,
                    -h * (w194 - 0.005 * xi2_0), -h * (w185 + w191 + w195), 1.0,
                    -h * (w193 + w197 + w196),
                    -h * (0.16666666666666666 * xi3_2 + w191), 0.0,
                    -h * (0.16666666666666666 * xi3_0 + w193), -w198, 0.0, -w199,
                    -h * (w201 - 0.495 * xi2_1), -h * (0.5 * xi2_0 + w203), 0.0,
                    -h * (w187 + w200 + w204), -h * (w197 + w202 + w205), 0.01,
                    -h * (w200 - 0.0016666666666666668 * xi3_1),
                    -h * (w202 - 0.0016666666666666668 * xi3_0), 0.0, -w207, -w208, 0.0,
                    0.0, -h * w181, -h * w183, 0.0, -h * (w180 + w184 + 0.5 * xi3_2),
                    -h * (w182 + w186 - 0.005 * xi3_1), 1.01, -h * (w180 + w210 + w209),
                    -h * (w182 + w212 + w211), 0.0, -xi4_2 * w213, -xi4_1 * w213,
                    -h * w192, 0.0, -h * w194, -h * (w191 + w195 - 0.495 * xi3_2), 0.0,
                    -h * (w193 + w196 - 0.005 * xi3_0), -h * (w191 + w210 + w214), 1.0,
                    -h * (w193 + w216 + w215), -xi4_2 * w103, 0.0, -xi4_0 * w103,
                    -h * w201, -h * w203, 0.0, -h * (w200 + w204 - 0.495 * xi3_1),
                    -h * (w202 + w205 + 0.5 * xi3_0), 0.0, -h * (w200 + w212 + w217),
                    -h * (w202 + w216 + w218), 0.01, -xi4_1 * w219, -xi4_0 * w219, 0.0,
                    0.0, -h * (0.25 * mu2 + w150), -h * (w152 - 0.25 * mu1), 0.0,
                    -h * (w184 + w220), -h * (w186 + w221), 0.0,
                    -h * (w209 + w220 + xi4_2), -h * (w211 + w221 - 0.01 * xi4_1), 1.01,
                    -h * (w151 + w222 + w158), -h * (xi3_1 + w153 + w160),
                    -h * (w162 - 0.25 * mu2), 0.0, -h * (0.25 * mu0 + w163),
                    -h * (w195 + w223), 0.0, -h * (w196 + w224),
                    -h * (w214 + w223 - 0.99 * xi4_2), 0.0,
                    -h * (w215 + w224 - 0.01 * xi4_0), -h * (w159 + w222 + w169), 1.0,
                    -h * (w164 + w225 + w170), -h * (0.25 * mu1 + w172),
                    -h * (w173 - 0.25 * mu0), 0.0, -h * (w204 + w226),
                    -h * (w205 + w227), 0.0, -h * (w217 + w226 - 0.99 * xi4_1),
                    -h * (w218 + w227 + xi4_0), 0.0, -h * (xi3_1 + w161 + w178),
                    -h * (w171 + w225 + w179), 0.01,
                )
                memory.age_1 = invert(12, memory.inverse_1)
                if memory.age_1 > 0:
                    _count_matrix(statistics)
            d_xi1_0 = (
                memory.inverse_1[0] * residual_0 + memory.inverse_1[1] * residual_1
                + (memory.inverse_1[2] * residual_2
                + memory.inverse_1[3] * residual_2_0) + (memory.inverse_1[4]
                * residual_2_1 + memory.inverse_1[5] * residual_2_2)
                + (memory.inverse_1[6] * residual_3_0
                + memory.inverse_1[7] * residual_3_1) + (memory.inverse_1[8]
                * residual_3_2 + memory.inverse_1[9] * residual_4_0)
                + (memory.inverse_1[10] * residual_4_1
                + memory.inverse_1[11] * residual_4_2)
            )
            d_xi1_1 = (
                memory.inverse_1[12] * residual_0 + memory.inverse_1[13] * residual_1
                + (memory.inverse_1[14] * residual_2
                + memory.inverse_1[15] * residual_2_0) + (memory.inverse_1[16]
                * residual_2_1 + memory.inverse_1[17] * residual_2_2)
                + (memory.inverse_1[18] * residual_3_0
                + memory.inverse_1[19] * residual_3_1) + (memory.inverse_1[20]
                * residual_3_2 + memory.inverse_1[21] * residual_4_0)
                + (memory.inverse_1[22] * residual_4_1
                + memory.inverse_1[23] * residual_4_2)
            )
            d_xi1_2 = (
                memory.inverse_1[24] * residual_0 + memory.inverse_1[25] * residual_1
                + (memory.inverse_1[26] * residual_2
                + memory.inverse_1[27] * residual_2_0) + (memory.inverse_1[28]
                * residual_2_1 + memory.inverse_1[29] * residual_2_2)
                + (memory.inverse_1[30] * residual_3_0
                + memory.inverse_1[31] * residual_3_1) + (memory.inverse_1[32]
                * residual_3_2 + memory.inverse_1[33] * residual_4_0)
                + (memory.inverse_1[34] * residual_4_1
                + memory.inverse_1[35] * residual_4_2)
            )
            d_xi2_0 = (
                memory.inverse_1[36] * residual_0 + memory.inverse_1[37] * residual_1
                + (memory.inverse_1[38] * residual_2
                + memory.inverse_1[39] * residual_2_0) + (memory.inverse_1[40]
                * residual_2_1 + memory.inverse_1[41] * residual_2_2)
                + (memory.inverse_1[42] * residual_3_0
                + memory.inverse_1[43] * residual_3_1) + (memory.inverse_1[44]
                * residual_3_2 + memory.inverse_1[45] * residual_4_0)
                + (memory.inverse_1[46] * residual_4_1
                + memory.inverse_1[47] * residual_4_2)
            )
            d_xi2_1 = (
                memory.inverse_1[48] * residual_0 + memory.inverse_1[49] * residual_1
                + (memory.inverse_1[50] * residual_2
                + memory.inverse_1[51] * residual_2_0) + (memory.inverse_1[52]
                * residual_2_1 + memory.inverse_1[53] * residual_2_2)
                + (memory.inverse_1[54] * residual_3_0
                + memory.inverse_1[55] * residual_3_1) + (memory.inverse_1[56]
                * residual_3_2 + memory.inverse_1[57] * residual_4_0)
                + (memory.inverse_1[58] * residual_4_1
                + memory.inverse_1[59] * residual_4_2)
            )
            d_xi2_2 = (
                memory.inverse_1[60] * residual_0 + memory.inverse_1[61] * residual_1
                + (memory.inverse_1[62] * residual_2
                + memory.inverse_1[63] * residual_2_0) + (memory.inverse_1[64]
                * residual_2_1 + memory.inverse_1[65] * residual_2_2)
                + (memory.inverse_1[66] * residual_3_0
                + memory.inverse_1[67] * residual_3_1) + (memory.inverse_1[68]
                * residual_3_2 + memory.inverse_1[69] * residual_4_0)
                + (memory.inverse_1[70] * residual_4_1
                + memory.inverse_1[71] * residual_4_2)
            )
            d_xi3_0 = (
                memory.inverse_1[72] * residual_0 + memory.inverse_1[73] * residual_1
                + (memory.inverse_1[74] * residual_2
                + memory.inverse_1[75] * residual_2_0) + (memory.inverse_1[76]
                * residual_2_1 + memory.inverse_1[77] * residual_2_2)
                + (memory.inverse_1[78] * residual_3_0
                + memory.inverse_1[79] * residual_3_1) + (memory.inverse_1[80]
                * residual_3_2 + memory.inverse_1[81] * residual_4_0)
                + (memory.inverse_1[82] * residual_4_1
                + memory.inverse_1[83] * residual_4_2)
            )
            d_xi3_1 = (
                memory.inverse_1[84] * residual_0 + memory.inverse_1[85] * residual_1
                + (memory.inverse_1[86] * residual_2
                + memory.inverse_1[87] * residual_2_0) + (memory.inverse_1[88]
                * residual_2_1 + memory.inverse_1[89] * residual_2_2)
                + (memory.inverse_1[90] * residual_3_0
                + memory.inverse_1[91] * residual_3_1) + (memory.inverse_1[92]
                * residual_3_2 + memory.inverse_1[93] * residual_4_0)
                + (memory.inverse_1[94] * residual_4_1
                + memory.inverse_1[95] * residual_4_2)
            )
            d_xi3_2 = (
                memory.inverse_1[96] * residual_0 + memory.inverse_1[97] * residual_1
                + (memory.inverse_1[98] * residual_2
                + memory.inverse_1[99] * residual_2_0) + (memory.inverse_1[100]
                * residual_2_1 + memory.inverse_1[101] * residual_2_2)
                + (memory.inverse_1[102] * residual_3_0
                + memory.inverse_1[103] * residual_3_1) + (memory.inverse_1[104]
                * residual_3_2 + memory.inverse_1[105] * residual_4_0)
                + (memory.inverse_1[106] * residual_4_1
                + memory.inverse_1[107] * residual_4_2)
            )
            d_xi4_0 = (
                memory.inverse_1[108] * residual_0 + memory.inverse_1[109] * residual_1
                + (memory.inverse_1[110] * residual_2
                + memory.inverse_1[111] * residual_2_0) + (memory.inverse_1[112]
                * residual_2_1 + memory.inverse_1[113] * residual_2_2)
                + (memory.inverse_1[114] * residual_3_0
                + memory.inverse_1[115] * residual_3_1) + (memory.inverse_1[116]
                * residual_3_2 + memory.inverse_1[117] * residual_4_0)
                + (memory.inverse_1[118] * residual_4_1
                + memory.inverse_1[119] * residual_4_2)
            )
            d_xi4_1 = (
                memory.inverse_1[120] * residual_0 + memory.inverse_1[121] * residual_1
                + (memory.inverse_1[122] * residual_2
                + memory.inverse_1[123] * residual_2_0) + (memory.inverse_1[124]
                * residual_2_1 + memory.inverse_1[125] * residual_2_2)
                + (memory.inverse_1[126] * residual_3_0
                + memory.inverse_1[127] * residual_3_1) + (memory.inverse_1[128]
                * residual_3_2 + memory.inverse_1[129] * residual_4_0)
                + (memory.inverse_1[130] * residual_4_1
                + memory.inverse_1[131] * residual_4_2)
            )
            d_xi4_2 = (
                memory.inverse_1[132] * residual_0 + memory.inverse_1[133] * residual_1
                + (memory.inverse_1[134] * residual_2
                + memory.inverse_1[135] * residual_2_0) + (memory.inverse_1[136]
                * residual_2_1 + memory.inverse_1[137] * residual_2_2)
                + (memory.inverse_1[138] * residual_3_0
                + memory.inverse_1[139] * residual_3_1) + (memory.inverse_1[140]
                * residual_3_2 + memory.inverse_1[141] * residual_4_0)
                + (memory.inverse_1[142] * residual_4_1
                + memory.inverse_1[143] * residual_4_2)
            )
            change = (
                abs(d_xi1_0) + abs(d_xi1_1) + (abs(d_xi1_2) + abs(d_xi2_0))
                + (abs(d_xi2_1) + abs(d_xi2_2)) + (abs(d_xi3_0) + abs(d_xi3_1))
                + (abs(d_xi3_2) + abs(d_xi4_0)) + (abs(d_xi4_1) + abs(d_xi4_2))
            )
            scale = (
                abs(xi1_0) + abs(xi1_1) + (abs(xi1_2) + abs(xi2_0))
                + (abs(xi2_1) + abs(xi2_2)) + (abs(xi3_0) + abs(xi3_1))
                + (abs(xi3_2) + abs(xi4_0)) + (abs(xi4_1) + abs(xi4_2))
            )
            xi1_0 += d_xi1_0
            xi1_1 += d_xi1_1
            xi1_2 += d_xi1_2
            xi2_0 += d_xi2_0
            xi2_1 += d_xi2_1
            xi2_2 += d_xi2_2
            xi3_0 += d_xi3_0
            xi3_1 += d_xi3_1
            xi3_2 += d_xi3_2
            xi4_0 += d_xi4_0
            xi4_1 += d_xi4_1
            xi4_2 += d_xi4_2
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
        solution = [
            xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1,
            xi4_2,
        ]
        _remember(memory, solution)
        w228 = xi2_1 + xi3_1
        w229 = w59 * w228
        xe1_1_ = xi1_1 * w104 + w229 + xi4_1 * w107
        w230 = xi2_0 + xi3_0
        w231 = w59 * w230
        xe1_0_ = xi1_0 * w104 + w231 + xi4_0 * w107
        w232 = xi2_2 + xi3_2
        w233 = w59 * w232
        xe1_2_ = xi1_2 * w104 + w233 + xi4_2 * w107
        w234 = xe1_0_ * xe1_0_ + xe1_1_ * xe1_1_ + xe1_2_ * xe1_2_
        c1_5, c2_6 = _stumpff_12(w234)
        w236 = xe1_1_ * c2_6
        w237 = xe1_1_ * w236
        w238 = xe1_2_ * c2_6 * xe1_2_
        ge1_0_ = 1.0 - (w237 + w238)
        xe2_1 = w229 + xi1_1 * w107 + xi4_1 * w104
        ye2_0_ = xi1_0 * w131 + w132 * w230 + xi4_0 * w133
        ye2_1_ = xi1_1 * w131 + w132 * w228 + xi4_1 * w133
        ye2_2_ = xi1_2 * w131 + w132 * w232 + xi4_2 * w133
        w239 = ye2_0_ * ye2_0_ + ye2_1_ * ye2_1_ + ye2_2_ * ye2_2_
        c1_6, c2_7 = _stumpff_12(w239)
        w241 = xe2_1 * c2_7
        w242 = xe2_1 * w241
        xe2_2 = w233 + xi1_2 * w107 + xi4_2 * w104
        w243 = xe2_2 * c2_7 * xe2_2
        ge2_0 = 1.0 - (w242 + w243)
        w245 = xe1_2_ * c1_5
        w246 = xe1_0_ * c2_6
        w247 = xe1_1_ * w246
        ge1_3_ = w245 + w247
        xe2_0 = w231 + xi1_0 * w107 + xi4_0 * w104
        w248 = xe2_0 * c2_7
        w249 = xe2_1 * w248
        w251 = xe2_2 * c1_6
        ge2_1 = w249 - w251
        w252 = xe1_2_ * w246
        w253 = xe1_1_ * c1_5
        ge1_6_ = w252 - w253
        w254 = xe2_1 * c1_6
        w255 = xe2_2 * w248
        ge2_2 = w254 + w255
        e2_0 = ge1_0_ * ge2_0 + ge1_3_ * ge2_1 + ge1_6_ * ge2_2
        ge2_3 = w249 + w251
        w256 = xe2_0 * w248
        ge2_4 = 1.0 - (w243 + w256)
        w257 = w241 * xe2_2
        w258 = xe2_0 * c1_6
        ge2_5 = w257 - w258
        e2_3 = ge1_0_ * ge2_3 + ge1_3_ * ge2_4 + ge1_6_ * ge2_5
        ge2_6 = w255 - w254
        ge2_7 = w257 + w258
        ge2_8 = 1.0 - (w242 + w256)
        e2_6 = ge1_0_ * ge2_6 + ge1_3_ * ge2_7 + ge1_6_ * ge2_8
        ge1_1_ = w247 - w245
        w259 = xe1_0_ * w246
        ge1_4_ = 1.0 - (w238 + w259)
        w260 = xe1_0_ * c1_5
        w261 = xe1_2_ * w236
        ge1_7_ = w260 + w261
        e2_1 = ge2_0 * ge1_1_ + ge2_1 * ge1_4_ + ge2_2 * ge1_7_
        e2_4 = ge2_3 * ge1_1_ + ge2_4 * ge1_4_ + ge2_5 * ge1_7_
        e2_7 = ge2_6 * ge1_1_ + ge2_7 * ge1_4_ + ge2_8 * ge1_7_
        ge1_2_ = w252 + w253
        ge1_5_ = w261 - w260
        ge1_8_ = 1.0 - (w237 + w259)
        e2_2 = ge2_0 * ge1_2_ + ge2_1 * ge1_5_ + ge2_2 * ge1_8_
        e2_5 = ge2_3 * ge1_2_ + ge2_4 * ge1_5_ + ge2_5 * ge1_8_
        e2_8 = ge2_6 * ge1_2_ + ge2_7 * ge1_5_ + ge2_8 * ge1_8_
        w262 = 0.165 * h
        w263 = 0.33 * h
        w264 = (
            s_p1_0_seen + xi1_2 * w262 * d_xi1_1 + xi1_1 * w262 * d_xi1_2
            + xi2_2 * w263 * d_xi2_1 + xi2_1 * w263 * d_xi2_2
        )
        w265 = xi3_2 * w263
        w266 = xi3_1 * w263
        w267 = xi4_2 * w262
        w268 = xi4_1 * w262
        w269 = -0.3333333333333333 * h
        w270 = (
            s_p1_1_seen + xi1_2 * w132 * d_xi1_0 + xi1_0 * w132 * d_xi1_2
            + xi2_2 * w269 * d_xi2_0 + xi2_0 * w269 * d_xi2_2
        )
        w271 = xi3_2 * w269
        w272 = xi3_0 * w269
        w273 = xi4_2 * w132
        w274 = xi4_0 * w132
        w275 = 0.0016666666666666668 * h
        w276 = 0.0033333333333333335 * h
        w277 = (
            s_p1_2_seen + xi1_1 * w275 * d_xi1_0 + xi1_0 * w275 * d_xi1_1
            + xi2_1 * w276 * d_xi2_0 + xi2_0 * w276 * d_xi2_1
        )
        w278 = xi3_1 * w276
        w279 = xi3_0 * w276
        w280 = xi4_1 * w275
        w281 = xi4_0 * w275
        new_g00 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6
        new_g01 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7
        new_g02 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8
        new_g10 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6
        new_g11 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7
        new_g12 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8
        new_g20 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6
        new_g21 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7
        new_g22 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8
        new_mu0 = (
            w264 + d_xi3_1 * w265 + d_xi3_2 * w266 + d_xi4_1 * w267 + d_xi4_2 * w268
        )
        new_mu1 = (
            w270 + d_xi3_0 * w271 + d_xi3_2 * w272 + d_xi4_0 * w273 + d_xi4_2 * w274
        )
        new_mu2 = (
            w277 + d_xi3_0 * w278 + d_xi3_1 * w279 + d_xi4_0 * w280 + d_xi4_1 * w281
        )
        if not all(map(isfinite, (new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21, new_g22, new_mu0, new_mu1, new_mu2))):
            return NOT_FINITE
        memory.age_1 = memory.age_1 + 1 if memory.age_1 % 6 > 0 else 0
        state[:] = (
            new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21,
            new_g22, new_mu0, new_mu1, new_mu2,
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
    known_solution = [0.0] * 12
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
