"""Heavy top with inertia fixed in space, T*SO(3): one step by slgi:midpoint

method:     family slgi, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are zero
scene:      Heavy top with inertia fixed in space, T*SO(3), group SO(3)
solved by:  the equations of xi1, n1: Newton's method, 6 unknowns; 4.85 sweeps and 1
            matrix a step, measured over the first 20 steps of size h = 0.01
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of
            SO(3)
left out:   the time is not needed: no formula depends on the time
operations: 50 add, 71 mul, 1 stumpff_1 a step
            3 mul once in each run, for the initial guess of the first step
            105 add, 215 mul, 2 slope2, 2 slope3 for each matrix of the equations of
            xi1, n1
            73 add, 111 mul, 1 stumpff_123, 1 stumpff_23 for each sweep of the
            equations of xi1, n1
command:    orderconds emit heavy_top --method slgi:midpoint --target python -o .
version:    orderconds 0.1.0

Use:

    import heavy_top_slgi_midpoint

    state = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 10000.0, 50000.0, 60000.0]
    print(heavy_top_slgi_midpoint.run(state, 0.01, 100))
"""

from math import cos, fabs, isfinite, sin, sqrt
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


def _stumpff_1_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 1.0:
        return _stumpff_series_1(z)
    # NaN if the angle is too large for an accurate result
    s = sqrt(z if z <= 4398046511104.0 else float("nan"))
    return sin(s) / s


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


def _stumpff_1(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 0.00390625:
        return _stumpff_tiny_1(z)
    if z <= 0.0625:
        return _stumpff_small_1(z)
    return _stumpff_1_far(z)


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
            xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2 = memory.guess
        else:
            xi1_0 = 0.001 * mu0
            xi1_1 = 0.0002 * mu1
            xi1_2 = 0.00016666666666666666 * mu2
            n1_0 = -g12
            n1_1 = g02
            n1_2 = 0.0
        w8 = -0.5 * h
        w16 = 0.5 * h
        # the equations of xi1, n1: Newton's method, 6 unknowns
        previous_1 = 0.0
        rate_1 = memory.rate_1 if memory.known > 0 else 1.0
        make_1 = not memory.age_1 > 0
        astray = False
        sweep = 0
        status = NOT_CONVERGED
        while True:
            sweep += 1
            Y_0 = h * xi1_0
            Y_1 = h * xi1_1
            Y_2 = h * xi1_2
            w1 = Y_0 * Y_0 + Y_1 * Y_1 + Y_2 * Y_2
            c2_1, c3_1 = _stumpff_23(w1)
            w2 = c2_1
            w3 = mu1 * Y_2 - mu2 * Y_1
            w5 = mu2 * Y_0 - mu0 * Y_2
            w6 = mu0 * Y_1 - mu1 * Y_0
            w7 = Y_2 * w5 - Y_1 * w6
            z_0 = xi1_0 * w8
            z_1 = xi1_1 * w8
            z_2 = xi1_2 * w8
            w9 = z_0 * z_0 + z_1 * z_1 + z_2 * z_2
            c1_1, c2_2, c3_2 = _stumpff_123(w9)
            w10 = c2_2
            w11 = n1_2 * z_1 - n1_1 * z_2
            w13 = n1_1 * z_0 - n1_0 * z_1
            w14 = n1_0 * z_2 - n1_2 * z_0
            w15 = z_1 * w13 - z_2 * w14
            M1_0 = mu0 - w2 * w3 + w7 * c3_1 + w16 * (n1_0 - w10 * w11 + w15 * c3_2)
            w17 = Y_0 * w6 - Y_2 * w3
            w18 = z_2 * w11 - z_0 * w13
            M1_1 = mu1 - w2 * w5 + w17 * c3_1 + w16 * (n1_1 - w10 * w14 + w18 * c3_2)
            w19 = Y_1 * w3 - Y_0 * w5
            w20 = z_0 * w14 - z_1 * w11
            M1_2 = mu2 - w2 * w6 + w19 * c3_1 + w16 * (n1_2 - w10 * w13 + w20 * c3_2)
            X1_2 = xi1_2 * w16
            w21 = c1_1
            w22 = X1_2 * w21
            X1_1 = xi1_1 * w16
            X1_0 = xi1_0 * w16
            w23 = w10 * X1_0
            w24 = X1_1 * w23
            w25 = w10 * X1_2
            w26 = X1_2 * w25
            w27 = w10 * X1_1
            Q1_5 = (
                g02 * (w22 + w24) + g12 * (1.0 - (X1_0 * w23 + w26))
                + g22 * (X1_2 * w27 - w21 * X1_0)
            )
            Q1_2 = (
                g12 * (w24 - w22) + g02 * (1.0 - (w26 + X1_1 * w27))
                + g22 * (X1_2 * w23 + w21 * X1_1)
            )
            next_xi1_0 = 0.001 * M1_0
            next_xi1_1 = 0.0002 * M1_1
            next_xi1_2 = 0.00016666666666666666 * M1_2
            next_n1_0 = -Q1_5
            next_n1_2 = 0.0
            residual_xi1_0 = next_xi1_0 - xi1_0
            residual_xi1_1 = next_xi1_1 - xi1_1
            residual_xi1_2 = next_xi1_2 - xi1_2
            residual_n1_0 = next_n1_0 - n1_0
            residual_n1_1 = Q1_2 - n1_1
            residual_n1_2 = next_n1_2 - n1_2
            if (
                make_1
                and isfinite(residual_xi1_0 + residual_xi1_1 + residual_xi1_2 + residual_n1_0 + residual_n1_1 + residual_n1_2)
            ):
                w28 = 0.001 * c3_1
                w29 = Y_1 * w28
                w30 = h * mu1
                w31 = Y_2 * w28
                w32 = h * mu2
                w33 = slope3(w1)
                w34 = slope2(w1)
                w35 = 0.001 * w7 * w33 - 0.001 * w3 * w34
                w36 = 2.0 * Y_0 * h
                w37 = 0.0005 * h
                w38 = w37 * c3_2
                w39 = z_1 * w38
                w40 = n1_1 * w8
                w41 = z_2 * w38
                w42 = n1_2 * w8
                w43 = slope3(w9)
                w44 = slope2(w9)
                w45 = w15 * w37 * w43 - w11 * w37 * w44
                w46 = 2.0 * z_0 * w8
                w47 = (
                    w29 * w30 + w31 * w32 + w35 * w36 + w39 * w40 + w41 * w42
                    + w45 * w46
                )
                w48 = h * mu0
                w49 = -0.001 * w2
                w50 = 2.0 * Y_1 * h
                w51 = w13 * w38 * w8 - w6 * w28 * h - w29 * w48 - w32 * w49 + w35 * w50
                w52 = n1_0 * w8
                w53 = w10 * w37
                w54 = 2.0 * z_1 * w8
                w55 = 2.0 * Y_2 * h
                w56 = w5 * w28 * h - w14 * w38 * w8 - w31 * w48 + w30 * w49 + w35 * w55
                w57 = 2.0 * z_2 * w8
                w58 = 0.0002 * c3_1
                w59 = 0.0001 * h
                w60 = w59 * c3_2
                w61 = Y_0 * w58
                w62 = -0.0002 * w2
                w63 = 0.0002 * w17 * w33 - 0.0002 * w5 * w34
                w64 = w6 * w58 * h - w13 * w60 * w8 - w30 * w61 + w32 * w62 + w36 * w63
                w65 = z_0 * w60
                w66 = w10 * w59
                w67 = w18 * w59 * w43 - w14 * w59 * w44
                w68 = Y_2 * w58
                w69 = z_2 * w60
                w70 = (
                    w48 * w61 + w32 * w68 + w50 * w63 + w52 * w65 + w42 * w69
                    + w54 * w67
                )
                w71 = w11 * w60 * w8 - w3 * w58 * h - w48 * w62 - w30 * w68 + w55 * w63
                w72 = 8.333333333333333e-05 * h
                w73 = w72 * c3_2
                w74 = 0.00016666666666666666 * c3_1
                w75 = -0.00016666666666666666 * w2
                w76 = Y_0 * w74
                w77 = (
                    0.00016666666666666666 * w19 * w33
                    - 0.00016666666666666666 * w6 * w34
                )
                w78 = w14 * w73 * w8 - w5 * w74 * h - w30 * w75 - w32 * w76 + w36 * w77
                w79 = w10 * w72
                w80 = z_0 * w73
                w81 = w20 * w72 * w43 - w13 * w72 * w44
                w82 = Y_1 * w74
                w83 = w3 * w74 * h - w11 * w73 * w8 + w48 * w75 - w32 * w82 + w50 * w77
                w84 = z_1 * w73
                w85 = (
                    w48 * w76 + w30 * w82 + w55 * w77 + w52 * w80 + w40 * w84
                    + w57 * w81
                )
                w86 = g22 * w21
                w87 = w10 * w16
                w88 = g02 * X1_1
                w89 = g12 * X1_0 - w88
                w90 = 0.5 * (c3_2 - w10)
                w91 = X1_2 * w90
                w92 = X1_2 * X1_2
                w93 = g22 * X1_2
                w94 = (
                    g22 * X1_0 * w90 - g02 * w91
                    + w44 * (g12 * w92 - X1_1 * w93 + X1_0 * w89)
                )
                w95 = w16 * w23
                w96 = 2.0 * w25
                w97 = w16 * w21
                w98 = w93 + g12 * X1_1
                w99 = (
                    g22 * X1_1 * w90 - g12 * w91
                    + w44 * (X1_0 * w98 - (g02 * w92 + X1_1 * w88))
                )
                w100 = -(w16 * (w86 - g02 * w27) + g12 * w95 - w87 * w88 + w54 * w99)
                memory.inverse_1[:] = (
                    1.0 - w47, -(w51 - w39 * w52 - w42 * w53 + w45 * w54),
                    -(w56 - w41 * w52 + w40 * w53 + w45 * w57),
                    z_2 * w41 - (w37 - z_1 * w39), -(z_0 * w39 + z_2 * w53),
                    z_1 * w53 - z_0 * w41, -(w64 - w40 * w65 + w42 * w66 + w46 * w67),
                    1.0 - w70, -(w71 - w52 * w66 - w40 * w69 + w57 * w67),
                    z_2 * w66 - z_1 * w65, z_2 * w69 - (w59 - z_0 * w65),
                    -(z_0 * w66 + z_1 * w69),
                    -(w78 - w40 * w79 - w42 * w80 + w46 * w81),
                    -(w83 + w52 * w79 - w42 * w84 + w54 * w81), 1.0 - w85,
                    -(z_1 * w79 + z_2 * w80), z_0 * w79 - z_2 * w84,
                    z_1 * w84 - (w72 - z_0 * w80),
                    -(w16 * (g12 * w23 + w86) + w87 * w89 + w46 * w94),
                    g02 * w95 + w87 * w93 - w54 * w94,
                    -(w16 * (g12 * w96 - g22 * w27) - g02 * w97 + w57 * w94), 1.0, 0.0,
                    0.0, -(w87 * w98 + w46 * w99), w100,
                    -(w16 * (g22 * w23 - g02 * w96) - g12 * w97 + w57 * w99), 0.0, 1.0,
                    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
                )
                memory.age_1 = invert(6, memory.inverse_1)
                if memory.age_1 > 0:
                    _count_matrix(statistics)
            change_xi1_0 = (
                memory.inverse_1[0] * residual_xi1_0
                + memory.inverse_1[1] * residual_xi1_1 + (memory.inverse_1[2]
                * residual_xi1_2 + memory.inverse_1[3] * residual_n1_0)
                + (memory.inverse_1[4] * residual_n1_1
                + memory.inverse_1[5] * residual_n1_2)
            )
            change_xi1_1 = (
                memory.inverse_1[6] * residual_xi1_0
                + memory.inverse_1[7] * residual_xi1_1 + (memory.inverse_1[8]
                * residual_xi1_2 + memory.inverse_1[9] * residual_n1_0)
                + (memory.inverse_1[10] * residual_n1_1
                + memory.inverse_1[11] * residual_n1_2)
            )
            change_xi1_2 = (
                memory.inverse_1[12] * residual_xi1_0
                + memory.inverse_1[13] * residual_xi1_1 + (memory.inverse_1[14]
                * residual_xi1_2 + memory.inverse_1[15] * residual_n1_0)
                + (memory.inverse_1[16] * residual_n1_1
                + memory.inverse_1[17] * residual_n1_2)
            )
            change_n1_0 = (
                memory.inverse_1[18] * residual_xi1_0
                + memory.inverse_1[19] * residual_xi1_1 + (memory.inverse_1[20]
                * residual_xi1_2 + memory.inverse_1[21] * residual_n1_0)
                + (memory.inverse_1[22] * residual_n1_1
                + memory.inverse_1[23] * residual_n1_2)
            )
            change_n1_1 = (
                memory.inverse_1[24] * residual_xi1_0
                + memory.inverse_1[25] * residual_xi1_1 + (memory.inverse_1[26]
                * residual_xi1_2 + memory.inverse_1[27] * residual_n1_0)
                + (memory.inverse_1[28] * residual_n1_1
                + memory.inverse_1[29] * residual_n1_2)
            )
            change_n1_2 = (
                memory.inverse_1[30] * residual_xi1_0
                + memory.inverse_1[31] * residual_xi1_1 + (memory.inverse_1[32]
                * residual_xi1_2 + memory.inverse_1[33] * residual_n1_0)
                + (memory.inverse_1[34] * residual_n1_1
                + memory.inverse_1[35] * residual_n1_2)
            )
            change = (
                max(abs(change_xi1_0), abs(change_xi1_1), abs(change_xi1_2),
                abs(change_n1_0), abs(change_n1_1), abs(change_n1_2))
            )
            scale = (
                max(abs(xi1_0), abs(xi1_1), abs(xi1_2), abs(n1_0), abs(n1_1), abs(n1_2))
            )
            if sweep == 1:
                memory.first = max(memory.first, change)
            if previous_1 > 0.0:
                rate_1 = max(change / previous_1, 0.000244140625)
            xi1_0 += change_xi1_0
            xi1_1 += change_xi1_1
            xi1_2 += change_xi1_2
            n1_0 += change_n1_0
            n1_1 += change_n1_1
            n1_2 += change_n1_2
            still = previous_1 > 0.0 and change >= previous_1
            close = (
                change <= 3.552713678800501e-15 * scale
                and change * rate_1 <= 1.1102230246251565e-16 * scale
            )
            converged = (
                close or (still and (change <= 5.684341886080802e-14 * scale
                or (change * abs(h) <= 7.105427357601002e-15 * max(map(abs, state[0:9]))
                and change * abs(h) <= 7.105427357601002e-15 * max(map(abs, state[9:12])))))
            )
            status = (
                (OK if memory.age_1 > 0 and converged else NOT_CONVERGED)
                if isfinite(change_xi1_0 + change_xi1_1 + change_xi1_2 + change_n1_0 + change_n1_1 + change_n1_2)
                else NOT_FINITE
            )
            astray = (still and make_1) or (not memory.age_1 > 0)
            make_1 = 0.015625 * previous_1 > 0.0 and change > 0.015625 * previous_1
            previous_1 = change
            if not (status == NOT_CONVERGED and sweep < 100 and not astray):
                break
        if status != OK and (status == NOT_CONVERGED and not memory.age_1 > 0):
            status = SINGULAR
        _count_sweeps(statistics, 0, sweep, status != OK)
        if status != OK:
            return status
        memory.rate_1 = rate_1 if sweep > 1 else 2.0 * rate_1
        solution = [xi1_0, xi1_1, xi1_2, n1_0, n1_1, n1_2]
        _remember(memory, solution)
        w101 = Y_1 * w2
        w102 = Y_1 * w101
        w103 = Y_2 * w2 * Y_2
        g_0 = 1.0 - (w102 + w103)
        w104 = Y_0 * w2
        w105 = Y_1 * w104
        c1_2 = _stumpff_1(w1)
        w107 = Y_2 * c1_2
        g_1 = w105 - w107
        w108 = Y_1 * c1_2
        w109 = Y_2 * w104
        g_2 = w108 + w109
        g_3 = w105 + w107
        w110 = Y_0 * w104
        g_4 = 1.0 - (w103 + w110)
        w111 = Y_2 * w101
        w112 = Y_0 * c1_2
        g_5 = w111 - w112
        g_6 = w109 - w108
        g_7 = w111 + w112
        g_8 = 1.0 - (w102 + w110)
        w113 = z_1 * w10
        w114 = z_2 * w10 * z_2
        w115 = z_2 * w21
        w116 = z_0 * w10
        w117 = z_1 * w116
        mu1_0 = (
            mu0 * g_0 + mu1 * g_1 + mu2 * g_2
            + h * (n1_0 * (1.0 - (z_1 * w113 + w114)) + n1_1 * (w115 + w117))
        )
        mu1_1 = (
            mu0 * g_3 + mu1 * g_4 + mu2 * g_5
            + h * (n1_0 * (w117 - w115) + n1_1 * (1.0 - (w114 + z_0 * w116)))
        )
        w118 = h * (n1_0 * (z_1 * w21 + z_2 * w116) + n1_1 * (z_2 * w113 - z_0 * w21))
        new_g00 = g00 * g_0 + g10 * g_1 + g20 * g_2
        new_g01 = g01 * g_0 + g11 * g_1 + g21 * g_2
        new_g02 = g02 * g_0 + g12 * g_1 + g22 * g_2
        new_g10 = g00 * g_3 + g10 * g_4 + g20 * g_5
        new_g11 = g01 * g_3 + g11 * g_4 + g21 * g_5
        new_g12 = g02 * g_3 + g12 * g_4 + g22 * g_5
        new_g20 = g00 * g_6 + g10 * g_7 + g20 * g_8
        new_g21 = g01 * g_6 + g11 * g_7 + g21 * g_8
        new_g22 = g02 * g_6 + g12 * g_7 + g22 * g_8
        new_mu2 = mu0 * g_6 + mu1 * g_7 + mu2 * g_8 + w118
        if not all(map(isfinite, (new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21, new_g22, mu1_0, mu1_1, new_mu2))):
            return NOT_FINITE
        state[:] = (
            new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21,
            new_g22, mu1_0, mu1_1, new_mu2,
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
