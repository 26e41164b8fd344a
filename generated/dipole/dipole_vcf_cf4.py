"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcf:cf4

method:     family vcf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, thesis, Section
            2.2.1
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
solved by:  the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method, 12
            unknowns (2.4 sweeps of 1202 operations and 0.05 matrices of 3742 a
            step; fixed point: 3.0 sweeps of 959 operations; Newton's method with
            the matrix to first order in h: 2.1 sweeps of 1235 operations and 1.00
            matrices of 4064)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   1 Adt, 23 Adtinv, 5 mul (zeros)
            16 Adtinv, 31 dexpt, 1 exp, 4 identity, 2 lin (sharing)
            1 identity (dead code)
            1 dexpt (factors)
            4 Adtinv, 8 dexpt (common sums)
            1 lin (cancellation)
            1 lin (sharing)
            5 hamilton (body frame)
            1 Adt (opposites)
            3 Adt (opposites)
            7 Adtinv, 1 force (dead code)
            1 lin (sharing)
            2 mul (rows)
            5 dexpt (functions)
            3 Adinv, 4 legendre (sharing)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 116 add, 182 mul, 2 sqrt, 2 div, 2 stumpff_12 a step
            2 mul a start, in steps that follow no other
            102 add, 184 mul a matrix of the equations of xi1, xi2, xi3, xi4, n1,
            n2, n3, n4
            442 add, 571 mul, 6 div, 6 sqrt, 4 stumpff_123, 1 stumpff_23 a sweep of
            the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4
            12 add, 18 mul where a run begins, 12 add, 9 mul where it ends
made by:    orderconds emit dipole --method vcf:cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcf_cf4

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcf_cf4.run(state, 0.005, 100))
"""

from math import comb, cos, fabs, isfinite, sin, sqrt

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
        "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 1, 0, 0
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

    past: the last solutions of its equations, the latest first; count: of all;
    guess: the polynomial through the last solutions, continued by a step; inverses: of Newton's
    matrices, by block.
    """

    def __init__(self):
        self.past, self.guess, self.degree, self.count = [], [], 0, 0
        self.first = 0.0
        self.rates = [1.0] * 1
        self.inverses = [None] * 1

    def keep(self, found):
        """Add a solution; alone where the one before it was expected too far off."""
        if len(self.past) > 2:
            moved = _size(x - y for x, y in zip(found, self.past[0]))
            if self.first > 0.5 * moved:
                self.past, self.degree = [], 0
        self.first = 0.0
        self.past = [found, *self.past[:15]]
        self.count += 1
        if len(self.past) < 16 or self.count % 16 % 8 == 0:
            self.choose()
        self.guess = [-x for x in self.difference(self.degree + 1, 1)]

    def choose(self):
        """Let the degree grow while differences fall; of many, they are seldom looked at."""
        k, size = self.degree, _size(self.difference(self.degree, 0))
        if k + 1 < len(self.past) and _size(self.difference(k + 1, 0)) < size:
            self.degree = k + 1
        elif k > 0 and size > _size(self.difference(k - 1, 0)):
            self.degree = k - 1

    def difference(self, order, first):
        """Return a backward difference without its first terms, which were of later solutions.

        The latest is added last.
        """
        rows = range(first, order + 1)
        factors = [float((-1) ** j * comb(order, j)) for j in rows]
        terms = [[f * x for x in row] for f, row in zip(factors, self.past)]
        pairs = [[x + y for x, y in zip(*pair)] for pair in zip(terms[::2], terms[1::2])]
        total, *rest = (terms[-1:] if len(terms) % 2 else []) + pairs[::-1]
        for pair in rest:
            total = [x + y for x, y in zip(total, pair)]
        return total


def _size(row):
    """Return the sum of absolute values, added one by one."""
    total = 0.0
    for x in row:
        total += abs(x)
    return total


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
    half = 0.5 * sqrt(z if z <= 4398046511104.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_123_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 1.0:
        return _stumpff_series_1(z), _stumpff_series_2(z), _stumpff_series_3(z)
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


def invert(a):
    """Return the inverse of a square matrix, a list of rows that is used up; None where it has none."""
    n = len(a)
    order = [0] * n
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: fabs(a[i][k]))
        if not fabs(a[pivot][k]) > 0.0:
            return None
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
    return a


def _advance(state, h, memory, statistics):
    """Return the state after one step as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    if memory.past:
        (
            xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1,
            xi4_2,
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
    w64 = sqrt(w63)
    w65 = 1.0 / w64
    w66 = w65 * w65
    w67 = w65 * w66
    w68 = w61 + w62
    w69 = sqrt(w68)
    w70 = 1.0 / w69
    w71 = w70 * w70
    w72 = w70 * w71
    w73 = w67 - w72
    w74 = 1.5 * w73
    w75 = -1.0 - w74
    w76 = g21 * w75
    w77 = w67 + w72
    w78 = 0.15 * w77
    w79 = g22 * w78
    w80 = w76 + w79
    w106 = 0.3333333333333333 * h
    w107 = 0.25 * h
    w110 = -0.08333333333333333 * h
    w117 = g20 * w75
    w120 = g20 * w78
    w134 = 0.08333333333333333 * h
    w135 = -0.16666666666666666 * h
    w136 = -0.25 * h
    # the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4: Newton's method in xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1, xi4_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
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
        w33 = 1.0 / sqrt(w31 - w32)
        w34 = w33 * w33 * w33
        w35 = 1.0 / sqrt(w31 + w32)
        w36 = w35 * w35 * w35
        w37 = -1.0 - 1.5 * (w34 - w36)
        w38 = 0.15 * (w34 + w36)
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
        w44 = 1.0 / sqrt(w42 - w43)
        w45 = w44 * w44 * w44
        w46 = 1.0 / sqrt(w42 + w43)
        w47 = w46 * w46 * w46
        w48 = -1.0 - 1.5 * (w45 - w47)
        w49 = 0.15 * (w45 + w47)
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
        Nr1_0 = 0.99 * (xi1_1 * xi1_2) + w80
        xE3_1_1 = xi2_1 * w2
        xE3_1_0 = xi2_0 * w2
        xE3_1_2 = xi2_2 * w2
        w81 = xE3_1_0 * xE3_1_0 + xE3_1_1 * xE3_1_1 + xE3_1_2 * xE3_1_2
        c1_3, c2_3, c3_3 = _stumpff_123(w81)
        w83 = xE3_1_0 * c2_3
        w84 = xE3_1_1 * w83
        w86 = xE3_1_2 * c1_3
        gE3_1_1 = w84 - w86
        w87 = xE3_1_0 * w83
        w88 = xE3_1_2 * c2_3 * xE3_1_2
        gE3_1_4 = 1.0 - (w87 + w88)
        w89 = xE3_1_0 * c1_3
        w90 = xE3_1_1 * c2_3
        w91 = xE3_1_2 * w90
        gE3_1_7 = w89 + w91
        a_3_1 = xi3_0 * gE3_1_1 + xi3_1 * gE3_1_4 + xi3_2 * gE3_1_7
        w92 = xE3_1_1 * c1_3
        w93 = xE3_1_2 * w83
        gE3_1_2 = w92 + w93
        gE3_1_5 = w91 - w89
        w94 = xE3_1_1 * w90
        gE3_1_8 = 1.0 - (w87 + w94)
        a_3_2 = xi3_0 * gE3_1_2 + xi3_1 * gE3_1_5 + xi3_2 * gE3_1_8
        w95 = g22 * xE3_1_0 - g20 * xE3_1_2
        w96 = g20 * xE3_1_1 - g21 * xE3_1_0
        w97 = g21 * xE3_1_2 - g22 * xE3_1_1
        Q3_7 = g21 + w95 * c1_3 + (xE3_1_0 * w96 - xE3_1_2 * w97) * c2_3
        Q3_8 = g22 + w96 * c1_3 + (xE3_1_1 * w97 - xE3_1_0 * w95) * c2_3
        w98 = 3.26 - 3.0 * Q3_8
        w99 = 0.3 * Q3_7
        w100 = 1.0 / sqrt(w98 - w99)
        w101 = w100 * w100 * w100
        w102 = 1.0 / sqrt(w98 + w99)
        w103 = w102 * w102 * w102
        w104 = -1.0 - 1.5 * (w101 - w103)
        w105 = 0.15 * (w101 + w103)
        Nr3_0 = Q3_7 * w104 + Q3_8 * w105 + 0.99 * (a_3_1 * a_3_2)
        s_p1_0 = mu0 + w59 * (sum_Nr4_0 + Nr1_0) + Nr3_0 * w106
        w108 = xi2_0 + xi3_0
        w109 = w59 * w108
        xe1_0 = xi1_0 * w107 + w109 + xi4_0 * w110
        w111 = xi2_1 + xi3_1
        w112 = w59 * w111
        xe1_1 = xi1_1 * w107 + w112 + xi4_1 * w110
        w113 = xi2_2 + xi3_2
        w114 = w59 * w113
        xe1_2 = xi1_2 * w107 + w114 + xi4_2 * w110
        w115 = xe1_0 * xe1_0 + xe1_1 * xe1_1 + xe1_2 * xe1_2
        c1_4, c2_4, c3_4 = _stumpff_123(w115)
        w118 = xi1_0 * xi1_2 + w117
        gE3_1_0 = 1.0 - (w88 + w94)
        gE3_1_3 = w84 + w86
        gE3_1_6 = w93 - w92
        a_3_0 = xi3_0 * gE3_1_0 + xi3_1 * gE3_1_3 + xi3_2 * gE3_1_6
        Q3_6 = g20 + w97 * c1_3 + (xE3_1_2 * w95 - xE3_1_1 * w96) * c2_3
        w119 = a_3_2 * a_3_0 + w104 * Q3_6
        s_p1_1 = mu1 + w59 * (sum_Nr4_1 - w118) - w106 * w119
        Nr1_2 = 0.01 * (xi1_0 * xi1_1) - w120
        Nr3_2 = 0.01 * (a_3_1 * a_3_0) - w105 * Q3_6
        s_p1_2 = mu2 + w59 * (sum_Nr4_2 + Nr1_2) + w106 * Nr3_2
        w121 = xe1_2 * s_p1_1 - xe1_1 * s_p1_2
        w123 = xe1_0 * s_p1_2 - s_p1_0 * xe1_2
        w124 = s_p1_0 * xe1_1 - xe1_0 * s_p1_1
        p1_11_0 = s_p1_0 - w121 * c2_4 + (xe1_2 * w123 - xe1_1 * w124) * c3_4
        w125 = xe1_1 * c2_4
        w126 = xe1_1 * w125
        w127 = xe1_2 * c2_4 * xe1_2
        ge1_0 = 1.0 - (w126 + w127)
        w128 = xe1_0 * c2_4
        w129 = xe1_1 * w128
        w131 = xe1_2 * c1_4
        ge1_1 = w129 - w131
        w132 = xe1_1 * c1_4
        w133 = xe1_2 * w128
        ge1_2 = w132 + w133
        m1_6_2_0 = s_p1_0 * ge1_0 + s_p1_1 * ge1_1 + s_p1_2 * ge1_2
        ye2_0 = xi1_0 * w134 + w108 * w135 + xi4_0 * w136
        ye2_1 = xi1_1 * w134 + w111 * w135 + xi4_1 * w136
        ye2_2 = xi1_2 * w134 + w113 * w135 + xi4_2 * w136
        w137 = ye2_0 * ye2_0 + ye2_1 * ye2_1 + ye2_2 * ye2_2
        c2_5, c3_5 = _stumpff_23(w137)
        ge1_6 = w133 - w132
        w139 = xe1_0 * c1_4
        w140 = xe1_2 * w125
        ge1_7 = w139 + w140
        w141 = xe1_0 * w128
        ge1_8 = 1.0 - (w126 + w141)
        m1_6_2_2 = s_p1_0 * ge1_6 + s_p1_1 * ge1_7 + s_p1_2 * ge1_8
        ge1_3 = w129 + w131
        ge1_4 = 1.0 - (w127 + w141)
        ge1_5 = w140 - w139
        m1_6_2_1 = s_p1_0 * ge1_3 + s_p1_1 * ge1_4 + s_p1_2 * ge1_5
        w142 = ye2_1 * m1_6_2_2 - ye2_2 * m1_6_2_1
        w144 = ye2_0 * m1_6_2_1 - m1_6_2_0 * ye2_1
        w145 = m1_6_2_0 * ye2_2 - ye2_0 * m1_6_2_2
        p1_6_2_0 = m1_6_2_0 - w142 * c2_5 + (ye2_1 * w144 - ye2_2 * w145) * c3_5
        M1_0 = p1_11_2_0 + w2 * p1_13_0 + 1.5 * p1_11_0 - 0.5 * p1_6_2_0
        residual_0 = M1_0 - 1.01 * xi1_0
        p1_11_2_1 = s_nu2_1 - w53 * c2_1 + (xE2_1_0 * w54 - xE2_1_2 * w51) * c3_1
        p1_13_1 = m1_13_1 - w57 * c2_2 + (xE4_2_0 * w58 - xE4_2_2 * w55) * c3_2
        p1_11_1 = s_p1_1 - w123 * c2_4 + (xe1_0 * w124 - xe1_2 * w121) * c3_4
        p1_6_2_1 = m1_6_2_1 - w145 * c2_5 + (ye2_2 * w142 - ye2_0 * w144) * c3_5
        M1_1 = p1_11_2_1 + w2 * p1_13_1 + 1.5 * p1_11_1 - 0.5 * p1_6_2_1
        residual_1 = M1_1 - xi1_1
        p1_11_2_2 = s_nu2_2 - w54 * c2_1 + (xE2_1_1 * w51 - xE2_1_0 * w53) * c3_1
        p1_13_2 = m1_13_2 - w58 * c2_2 + (xE4_2_1 * w55 - xE4_2_0 * w57) * c3_2
        p1_11_2 = s_p1_2 - w124 * c2_4 + (xe1_1 * w121 - xe1_0 * w123) * c3_4
        p1_6_2_2 = m1_6_2_2 - w144 * c2_5 + (ye2_0 * w145 - ye2_1 * w142) * c3_5
        M1_2 = p1_11_2_2 + w2 * p1_13_2 + 1.5 * p1_11_2 - 0.5 * p1_6_2_2
        residual_2 = M1_2 - 0.01 * xi1_2
        w146 = 0.5 * (p1_11_0 + p1_6_2_0)
        w147 = xE3_1_1 * Nr3_2 + xE3_1_2 * w119
        w149 = xE3_1_0 * Nr3_2 - xE3_1_2 * Nr3_0
        w150 = xE3_1_0 * w119 + xE3_1_1 * Nr3_0
        M2_0 = (
            w146 + w1 * (Nr3_0 + w147 * c2_3 + (xE3_1_2 * w149 - xE3_1_1 * w150) * c3_3)
        )
        p_2_0 = 1.01 * a_0
        p_2_2 = 0.01 * a_2
        a_4_0 = gE2_1_0 * p_2_0 + gE2_1_1 * a_1 + gE2_1_2 * p_2_2
        residual_2_0 = M2_0 - a_4_0
        w151 = 0.5 * (p1_11_1 + p1_6_2_1)
        M2_1 = (
            w151
            + w1 * ((xE3_1_2 * w147 + xE3_1_0 * w150) * c3_3 - (w119 + w149 * c2_3))
        )
        a_4_1 = gE2_1_3 * p_2_0 + gE2_1_4 * a_1 + gE2_1_5 * p_2_2
        residual_2_1 = M2_1 - a_4_1
        w152 = 0.5 * (p1_11_2 + p1_6_2_2)
        M2_2 = (
            w152 + w1 * (Nr3_2 - w150 * c2_3 - (xE3_1_0 * w149 + xE3_1_1 * w147) * c3_3)
        )
        a_4_2 = gE2_1_6 * p_2_0 + gE2_1_7 * a_1 + gE2_1_8 * p_2_2
        residual_2_2 = M2_2 - a_4_2
        M3_0 = w146 + w1 * p1_13_0
        p_3_0 = 1.01 * a_3_0
        p_3_2 = 0.01 * a_3_2
        a_7_0 = gE3_1_0 * p_3_0 + gE3_1_1 * a_3_1 + gE3_1_2 * p_3_2
        residual_3_0 = M3_0 - a_7_0
        M3_1 = w151 + w1 * p1_13_1
        a_7_1 = gE3_1_3 * p_3_0 + gE3_1_4 * a_3_1 + gE3_1_5 * p_3_2
        residual_3_1 = M3_1 - a_7_1
        M3_2 = w152 + w1 * p1_13_2
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
        total = (
            residual_0 + residual_1 + residual_2 + residual_2_0 + residual_2_1
            + residual_2_2 + residual_3_0 + residual_3_1 + residual_3_2 + residual_4_0
            + residual_4_1 + residual_4_2
        )
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
        if make_1:
            w153 = 0.165 * xi1_2
            w154 = 0.08333333333333333 * mu2
            w155 = 0.165 * xi1_1
            w156 = -0.08333333333333333 * mu1
            w157 = -0.66 * h
            w158 = 0.33 * h
            w159 = xi3_2 * w158
            w160 = xi3_1 * w158
            w161 = 0.165 * xi4_2
            w162 = -0.08333333333333333 * mu2
            w163 = 0.165 * xi4_1
            w164 = 0.08333333333333333 * mu1
            w165 = -0.16666666666666666 * xi1_2
            w166 = -0.16666666666666666 * xi1_0
            w167 = 0.08333333333333333 * mu0
            w168 = 0.6666666666666666 * h
            w169 = -0.3333333333333333 * h
            w170 = xi3_2 * w169
            w171 = xi3_0 * w169
            w172 = -0.16666666666666666 * xi4_2
            w173 = -0.16666666666666666 * xi4_0
            w174 = -0.08333333333333333 * mu0
            w175 = 0.0016666666666666668 * xi1_1
            w176 = 0.0016666666666666668 * xi1_0
            w177 = -0.006666666666666667 * h
            w178 = 0.0033333333333333335 * h
            w179 = xi3_1 * w178
            w180 = xi3_0 * w178
            w181 = 0.0016666666666666668 * xi4_1
            w182 = 0.0016666666666666668 * xi4_0
            w183 = 0.16666666666666666 * mu2
            w184 = w153 + w183
            w185 = -0.16666666666666666 * mu1
            w186 = w155 + w185
            w187 = 0.33 * xi2_2
            w188 = -0.005 * xi1_2
            w189 = 0.33 * xi2_1
            w190 = 0.5 * xi1_1
            w191 = 0.165 * h
            w192 = xi4_2 * w191
            w193 = xi4_1 * w191
            w194 = -0.16666666666666666 * mu2
            w195 = w165 + w194
            w196 = 0.16666666666666666 * mu0
            w197 = w166 + w196
            w198 = -0.3333333333333333 * xi2_2
            w199 = -0.3333333333333333 * xi2_0
            w200 = -0.495 * xi1_0
            w201 = xi4_2 * w135
            w202 = xi4_0 * w135
            w203 = 0.16666666666666666 * mu1
            w204 = w175 + w203
            w205 = -0.16666666666666666 * mu0
            w206 = w176 + w205
            w207 = 0.0033333333333333335 * xi2_1
            w208 = 0.0033333333333333335 * xi2_0
            w209 = 0.0016666666666666668 * h
            w210 = xi4_1 * w209
            w211 = xi4_0 * w209
            w212 = 0.33 * xi3_2
            w213 = -0.005 * xi2_2
            w214 = 0.33 * xi3_1
            w215 = 0.5 * xi2_1
            w216 = -0.33 * h
            w217 = -0.3333333333333333 * xi3_2
            w218 = -0.3333333333333333 * xi3_0
            w219 = -0.495 * xi2_0
            w220 = 0.0033333333333333335 * xi3_1
            w221 = 0.0033333333333333335 * xi3_0
            w222 = -0.0033333333333333335 * h
            w223 = 0.3333333333333333 * mu2
            w224 = -0.3333333333333333 * mu1
            w225 = -0.01 * xi3_2
            w226 = -0.3333333333333333 * mu2
            w227 = 0.3333333333333333 * mu0
            w228 = -0.99 * xi3_0
            w229 = 0.3333333333333333 * mu1
            w230 = -0.3333333333333333 * mu0
            row_1_1 = [
                1.01, -h * (w153 + w154), -h * (w155 + w156), 0.0, -xi2_2 * w157,
                -xi2_1 * w157, 0.0, -w159, -w160, 0.0, -h * (w161 + w162),
                -h * (w163 + w164),
            ]
            row_1_2 = [
                -h * (w162 + w165), 1.0, -h * (w166 + w167), -xi2_2 * w168, 0.0,
                -xi2_0 * w168, -w170, 0.0, -w171, -h * (w154 + w172), 0.0,
                -h * (w173 + w174),
            ]
            row_1_3 = [
                -h * (w164 + w175), -h * (w174 + w176), 0.01, -xi2_1 * w177,
                -xi2_0 * w177, 0.0, -w179, -w180, 0.0, -h * (w156 + w181),
                -h * (w167 + w182), 0.0,
            ]
            row_1_4 = [
                0.0, -h * (0.5 * xi2_2 + w184), -h * (w186 - 0.005 * xi2_1), 1.01,
                -h * (w183 + w188 + w187), -h * (w185 + w190 + w189), 0.0,
                -h * (w183 - 0.165 * xi3_2), -h * (w185 - 0.165 * xi3_1), 0.0, -w192,
                -w193,
            ]
            row_1_5 = [
                -h * (w195 - 0.495 * xi2_2), 0.0, -h * (w197 - 0.005 * xi2_0),
                -h * (w188 + w194 + w198), 1.0, -h * (w196 + w200 + w199),
                -h * (0.16666666666666666 * xi3_2 + w194), 0.0,
                -h * (0.16666666666666666 * xi3_0 + w196), -w201, 0.0, -w202,
            ]
            row_1_6 = [
                -h * (w204 - 0.495 * xi2_1), -h * (0.5 * xi2_0 + w206), 0.0,
                -h * (w190 + w203 + w207), -h * (w200 + w205 + w208), 0.01,
                -h * (w203 - 0.0016666666666666668 * xi3_1),
                -h * (w205 - 0.0016666666666666668 * xi3_0), 0.0, -w210, -w211, 0.0,
            ]
            row_1_7 = [
                0.0, -h * w184, -h * w186, 0.0, -h * (w183 + w187 + 0.5 * xi3_2),
                -h * (w185 + w189 - 0.005 * xi3_1), 1.01, -h * (w183 + w213 + w212),
                -h * (w185 + w215 + w214), 0.0, -xi4_2 * w216, -xi4_1 * w216,
            ]
            row_1_8 = [
                -h * w195, 0.0, -h * w197, -h * (w194 + w198 - 0.495 * xi3_2), 0.0,
                -h * (w196 + w199 - 0.005 * xi3_0), -h * (w194 + w213 + w217), 1.0,
                -h * (w196 + w219 + w218), -xi4_2 * w106, 0.0, -xi4_0 * w106,
            ]
            row_1_9 = [
                -h * w204, -h * w206, 0.0, -h * (w203 + w207 - 0.495 * xi3_1),
                -h * (w205 + w208 + 0.5 * xi3_0), 0.0, -h * (w203 + w215 + w220),
                -h * (w205 + w219 + w221), 0.01, -xi4_1 * w222, -xi4_0 * w222, 0.0,
            ]
            row_1_10 = [
                0.0, -h * (0.25 * mu2 + w153), -h * (w155 - 0.25 * mu1), 0.0,
                -h * (w187 + w223), -h * (w189 + w224), 0.0, -h * (w212 + w223 + xi4_2),
                -h * (w214 + w224 - 0.01 * xi4_1), 1.01, -h * (w154 + w225 + w161),
                -h * (xi3_1 + w156 + w163),
            ]
            row_1_11 = [
                -h * (w165 - 0.25 * mu2), 0.0, -h * (0.25 * mu0 + w166),
                -h * (w198 + w226), 0.0, -h * (w199 + w227),
                -h * (w217 + w226 - 0.99 * xi4_2), 0.0,
                -h * (w218 + w227 - 0.01 * xi4_0), -h * (w162 + w225 + w172), 1.0,
                -h * (w167 + w228 + w173),
            ]
            row_1_12 = [
                -h * (0.25 * mu1 + w175), -h * (w176 - 0.25 * mu0), 0.0,
                -h * (w207 + w229), -h * (w208 + w230), 0.0,
                -h * (w220 + w229 - 0.99 * xi4_1), -h * (w221 + w230 + xi4_0), 0.0,
                -h * (xi3_1 + w164 + w181), -h * (w174 + w228 + w182), 0.01,
            ]
            memory.inverses[0] = invert([row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6, row_1_7, row_1_8, row_1_9, row_1_10, row_1_11, row_1_12])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[0] is None:
                raise _failed(NOT_CONVERGED, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
        (
            row_1_1, row_1_2, row_1_3, row_1_4, row_1_5, row_1_6, row_1_7, row_1_8,
            row_1_9, row_1_10, row_1_11, row_1_12,
        ) = memory.inverses[0]
        d_xi1_0 = (
            row_1_1[0] * residual_0 + row_1_1[1] * residual_1 + row_1_1[2] * residual_2
            + row_1_1[3] * residual_2_0 + row_1_1[4] * residual_2_1
            + row_1_1[5] * residual_2_2 + row_1_1[6] * residual_3_0
            + row_1_1[7] * residual_3_1 + row_1_1[8] * residual_3_2
            + row_1_1[9] * residual_4_0 + row_1_1[10] * residual_4_1
            + row_1_1[11] * residual_4_2
        )
        d_xi1_1 = (
            row_1_2[0] * residual_0 + row_1_2[1] * residual_1 + row_1_2[2] * residual_2
            + row_1_2[3] * residual_2_0 + row_1_2[4] * residual_2_1
            + row_1_2[5] * residual_2_2 + row_1_2[6] * residual_3_0
            + row_1_2[7] * residual_3_1 + row_1_2[8] * residual_3_2
            + row_1_2[9] * residual_4_0 + row_1_2[10] * residual_4_1
            + row_1_2[11] * residual_4_2
        )
        d_xi1_2 = (
            row_1_3[0] * residual_0 + row_1_3[1] * residual_1 + row_1_3[2] * residual_2
            + row_1_3[3] * residual_2_0 + row_1_3[4] * residual_2_1
            + row_1_3[5] * residual_2_2 + row_1_3[6] * residual_3_0
            + row_1_3[7] * residual_3_1 + row_1_3[8] * residual_3_2
            + row_1_3[9] * residual_4_0 + row_1_3[10] * residual_4_1
            + row_1_3[11] * residual_4_2
        )
        d_xi2_0 = (
            row_1_4[0] * residual_0 + row_1_4[1] * residual_1 + row_1_4[2] * residual_2
            + row_1_4[3] * residual_2_0 + row_1_4[4] * residual_2_1
            + row_1_4[5] * residual_2_2 + row_1_4[6] * residual_3_0
            + row_1_4[7] * residual_3_1 + row_1_4[8] * residual_3_2
            + row_1_4[9] * residual_4_0 + row_1_4[10] * residual_4_1
            + row_1_4[11] * residual_4_2
        )
        d_xi2_1 = (
            row_1_5[0] * residual_0 + row_1_5[1] * residual_1 + row_1_5[2] * residual_2
            + row_1_5[3] * residual_2_0 + row_1_5[4] * residual_2_1
            + row_1_5[5] * residual_2_2 + row_1_5[6] * residual_3_0
            + row_1_5[7] * residual_3_1 + row_1_5[8] * residual_3_2
            + row_1_5[9] * residual_4_0 + row_1_5[10] * residual_4_1
            + row_1_5[11] * residual_4_2
        )
        d_xi2_2 = (
            row_1_6[0] * residual_0 + row_1_6[1] * residual_1 + row_1_6[2] * residual_2
            + row_1_6[3] * residual_2_0 + row_1_6[4] * residual_2_1
            + row_1_6[5] * residual_2_2 + row_1_6[6] * residual_3_0
            + row_1_6[7] * residual_3_1 + row_1_6[8] * residual_3_2
            + row_1_6[9] * residual_4_0 + row_1_6[10] * residual_4_1
            + row_1_6[11] * residual_4_2
        )
        d_xi3_0 = (
            row_1_7[0] * residual_0 + row_1_7[1] * residual_1 + row_1_7[2] * residual_2
            + row_1_7[3] * residual_2_0 + row_1_7[4] * residual_2_1
            + row_1_7[5] * residual_2_2 + row_1_7[6] * residual_3_0
            + row_1_7[7] * residual_3_1 + row_1_7[8] * residual_3_2
            + row_1_7[9] * residual_4_0 + row_1_7[10] * residual_4_1
            + row_1_7[11] * residual_4_2
        )
        d_xi3_1 = (
            row_1_8[0] * residual_0 + row_1_8[1] * residual_1 + row_1_8[2] * residual_2
            + row_1_8[3] * residual_2_0 + row_1_8[4] * residual_2_1
            + row_1_8[5] * residual_2_2 + row_1_8[6] * residual_3_0
            + row_1_8[7] * residual_3_1 + row_1_8[8] * residual_3_2
            + row_1_8[9] * residual_4_0 + row_1_8[10] * residual_4_1
            + row_1_8[11] * residual_4_2
        )
        d_xi3_2 = (
            row_1_9[0] * residual_0 + row_1_9[1] * residual_1 + row_1_9[2] * residual_2
            + row_1_9[3] * residual_2_0 + row_1_9[4] * residual_2_1
            + row_1_9[5] * residual_2_2 + row_1_9[6] * residual_3_0
            + row_1_9[7] * residual_3_1 + row_1_9[8] * residual_3_2
            + row_1_9[9] * residual_4_0 + row_1_9[10] * residual_4_1
            + row_1_9[11] * residual_4_2
        )
        d_xi4_0 = (
            row_1_10[0] * residual_0 + row_1_10[1] * residual_1
            + row_1_10[2] * residual_2 + row_1_10[3] * residual_2_0
            + row_1_10[4] * residual_2_1 + row_1_10[5] * residual_2_2
            + row_1_10[6] * residual_3_0 + row_1_10[7] * residual_3_1
            + row_1_10[8] * residual_3_2 + row_1_10[9] * residual_4_0
            + row_1_10[10] * residual_4_1 + row_1_10[11] * residual_4_2
        )
        d_xi4_1 = (
            row_1_11[0] * residual_0 + row_1_11[1] * residual_1
            + row_1_11[2] * residual_2 + row_1_11[3] * residual_2_0
            + row_1_11[4] * residual_2_1 + row_1_11[5] * residual_2_2
            + row_1_11[6] * residual_3_0 + row_1_11[7] * residual_3_1
            + row_1_11[8] * residual_3_2 + row_1_11[9] * residual_4_0
            + row_1_11[10] * residual_4_1 + row_1_11[11] * residual_4_2
        )
        d_xi4_2 = (
            row_1_12[0] * residual_0 + row_1_12[1] * residual_1
            + row_1_12[2] * residual_2 + row_1_12[3] * residual_2_0
            + row_1_12[4] * residual_2_1 + row_1_12[5] * residual_2_2
            + row_1_12[6] * residual_3_0 + row_1_12[7] * residual_3_1
            + row_1_12[8] * residual_3_2 + row_1_12[9] * residual_4_0
            + row_1_12[10] * residual_4_1 + row_1_12[11] * residual_4_2
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
        change = max(
            abs(d_xi1_0), abs(d_xi1_1), abs(d_xi1_2), abs(d_xi2_0), abs(d_xi2_1),
            abs(d_xi2_2), abs(d_xi3_0), abs(d_xi3_1), abs(d_xi3_2), abs(d_xi4_0),
            abs(d_xi4_1), abs(d_xi4_2),
        )
        scale = max(
            1.0, abs(xi1_0), abs(xi1_1), abs(xi1_2), abs(xi2_0), abs(xi2_1), abs(xi2_2),
            abs(xi3_0), abs(xi3_1), abs(xi3_2), abs(xi4_0), abs(xi4_1), abs(xi4_2),
        )
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
        raise _failed(NOT_CONVERGED, "the equations of xi1, xi2, xi3, xi4, n1, n2, n3, n4", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    w231 = xi2_1 + xi3_1
    w232 = w59 * w231
    xe1_1_ = xi1_1 * w107 + w232 + xi4_1 * w110
    w233 = xi2_0 + xi3_0
    w234 = w59 * w233
    xe1_0_ = xi1_0 * w107 + w234 + xi4_0 * w110
    w235 = xi2_2 + xi3_2
    w236 = w59 * w235
    xe1_2_ = xi1_2 * w107 + w236 + xi4_2 * w110
    w237 = xe1_0_ * xe1_0_ + xe1_1_ * xe1_1_ + xe1_2_ * xe1_2_
    c1_5, c2_6 = _stumpff_12(w237)
    w239 = xe1_1_ * c2_6
    w240 = xe1_1_ * w239
    w241 = xe1_2_ * c2_6 * xe1_2_
    ge1_0_ = 1.0 - (w240 + w241)
    xe2_1 = w232 + xi1_1 * w110 + xi4_1 * w107
    ye2_0_ = xi1_0 * w134 + w135 * w233 + xi4_0 * w136
    ye2_1_ = xi1_1 * w134 + w135 * w231 + xi4_1 * w136
    ye2_2_ = xi1_2 * w134 + w135 * w235 + xi4_2 * w136
    w242 = ye2_0_ * ye2_0_ + ye2_1_ * ye2_1_ + ye2_2_ * ye2_2_
    c1_6, c2_7 = _stumpff_12(w242)
    w244 = xe2_1 * c2_7
    w245 = xe2_1 * w244
    xe2_2 = w236 + xi1_2 * w110 + xi4_2 * w107
    w246 = xe2_2 * c2_7 * xe2_2
    ge2_0 = 1.0 - (w245 + w246)
    w248 = xe1_2_ * c1_5
    w249 = xe1_0_ * c2_6
    w250 = xe1_1_ * w249
    ge1_3_ = w248 + w250
    xe2_0 = w234 + xi1_0 * w110 + xi4_0 * w107
    w251 = xe2_0 * c2_7
    w252 = xe2_1 * w251
    w254 = xe2_2 * c1_6
    ge2_1 = w252 - w254
    w255 = xe1_2_ * w249
    w256 = xe1_1_ * c1_5
    ge1_6_ = w255 - w256
    w257 = xe2_1 * c1_6
    w258 = xe2_2 * w251
    ge2_2 = w257 + w258
    e2_0 = ge1_0_ * ge2_0 + ge1_3_ * ge2_1 + ge1_6_ * ge2_2
    ge2_3 = w252 + w254
    w259 = xe2_0 * w251
    ge2_4 = 1.0 - (w246 + w259)
    w260 = w244 * xe2_2
    w261 = xe2_0 * c1_6
    ge2_5 = w260 - w261
    e2_3 = ge1_0_ * ge2_3 + ge1_3_ * ge2_4 + ge1_6_ * ge2_5
    ge2_6 = w258 - w257
    ge2_7 = w260 + w261
    ge2_8 = 1.0 - (w245 + w259)
    e2_6 = ge1_0_ * ge2_6 + ge1_3_ * ge2_7 + ge1_6_ * ge2_8
    ge1_1_ = w250 - w248
    w262 = xe1_0_ * w249
    ge1_4_ = 1.0 - (w241 + w262)
    w263 = xe1_0_ * c1_5
    w264 = xe1_2_ * w239
    ge1_7_ = w263 + w264
    e2_1 = ge2_0 * ge1_1_ + ge2_1 * ge1_4_ + ge2_2 * ge1_7_
    e2_4 = ge2_3 * ge1_1_ + ge2_4 * ge1_4_ + ge2_5 * ge1_7_
    e2_7 = ge2_6 * ge1_1_ + ge2_7 * ge1_4_ + ge2_8 * ge1_7_
    ge1_2_ = w255 + w256
    ge1_5_ = w264 - w263
    ge1_8_ = 1.0 - (w240 + w262)
    e2_2 = ge2_0 * ge1_2_ + ge2_1 * ge1_5_ + ge2_2 * ge1_8_
    e2_5 = ge2_3 * ge1_2_ + ge2_4 * ge1_5_ + ge2_5 * ge1_8_
    e2_8 = ge2_6 * ge1_2_ + ge2_7 * ge1_5_ + ge2_8 * ge1_8_
    w265 = 0.165 * h
    w266 = 0.33 * h
    w267 = (
        s_p1_0_seen + xi1_2 * w265 * d_xi1_1 + xi1_1 * w265 * d_xi1_2
        + xi2_2 * w266 * d_xi2_1 + xi2_1 * w266 * d_xi2_2
    )
    w268 = xi3_2 * w266
    w269 = xi3_1 * w266
    w270 = xi4_2 * w265
    w271 = xi4_1 * w265
    w272 = -0.3333333333333333 * h
    w273 = (
        s_p1_1_seen + xi1_2 * w135 * d_xi1_0 + xi1_0 * w135 * d_xi1_2
        + xi2_2 * w272 * d_xi2_0 + xi2_0 * w272 * d_xi2_2
    )
    w274 = xi3_2 * w272
    w275 = xi3_0 * w272
    w276 = xi4_2 * w135
    w277 = xi4_0 * w135
    w278 = 0.0016666666666666668 * h
    w279 = 0.0033333333333333335 * h
    w280 = (
        s_p1_2_seen + xi1_1 * w278 * d_xi1_0 + xi1_0 * w278 * d_xi1_1
        + xi2_1 * w279 * d_xi2_0 + xi2_0 * w279 * d_xi2_1
    )
    w281 = xi3_1 * w279
    w282 = xi3_0 * w279
    w283 = xi4_1 * w278
    w284 = xi4_0 * w278
    new_g00 = g00 * e2_0 + g01 * e2_3 + g02 * e2_6
    new_g01 = g00 * e2_1 + g01 * e2_4 + g02 * e2_7
    new_g02 = g00 * e2_2 + g01 * e2_5 + g02 * e2_8
    new_g10 = g10 * e2_0 + g11 * e2_3 + g12 * e2_6
    new_g11 = g10 * e2_1 + g11 * e2_4 + g12 * e2_7
    new_g12 = g10 * e2_2 + g11 * e2_5 + g12 * e2_8
    new_g20 = g20 * e2_0 + g21 * e2_3 + g22 * e2_6
    new_g21 = g20 * e2_1 + g21 * e2_4 + g22 * e2_7
    new_g22 = g20 * e2_2 + g21 * e2_5 + g22 * e2_8
    new_mu0 = w267 + d_xi3_1 * w268 + d_xi3_2 * w269 + d_xi4_1 * w270 + d_xi4_2 * w271
    new_mu1 = w273 + d_xi3_0 * w274 + d_xi3_2 * w275 + d_xi4_0 * w276 + d_xi4_2 * w277
    new_mu2 = w280 + d_xi3_0 * w281 + d_xi3_1 * w282 + d_xi4_0 * w283 + d_xi4_1 * w284
    found = (
        xi1_0, xi1_1, xi1_2, xi2_0, xi2_1, xi2_2, xi3_0, xi3_1, xi3_2, xi4_0, xi4_1,
        xi4_2,
    )
    memory.keep(found)
    return (
        new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21, new_g22,
        new_mu0, new_mu1, new_mu2,
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


def _continued(state, h, memory, statistics):
    """Return the state after a step whose equations do not settle.

    They are tried without the solutions before. Then those of a shorter step are solved, and the
    solution is continued in h, as far at a time as it can be followed: it is the one that tends
    to the motion as h tends to zero. A step of no length changes nothing.
    """
    if h == 0.0 and all(map(isfinite, state)):
        return state
    solved, part, factor, found, failure = 0.0, 1.0, 2.0, None, None
    for _ in range(100):
        memory.__init__()
        if found is not None:
            memory.past, memory.guess = [found], found
        try:
            new = _checked(state, part * h, memory, statistics)
        except StepFailed as error:
            failure = error
            factor = factor**0.5 if found is not None else factor
        else:
            found, solved = memory.past[0], part
            memory.past, memory.guess, memory.degree = [found], found, 0
            if part >= 1.0:
                if statistics is not None:
                    statistics.failed = 0
                return new
            factor *= factor
        if factor <= 1.00390625:
            break
        factor = min(factor, 4.0)
        part = 0.5 * part if found is None else min(solved * factor, 1.0)
    raise failure


def _inward(state):
    """Return the momentum that steps are made with, of a state, as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    momentum_0 = g00 * mu0 + g10 * mu1 + g20 * mu2
    momentum_1 = g01 * mu0 + g11 * mu1 + g21 * mu2
    momentum_2 = g02 * mu0 + g12 * mu1 + g22 * mu2
    return momentum_0, momentum_1, momentum_2


def _outward(state):
    """Return the momentum in space, of a state with the other, as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    momentum_0 = g00 * mu0 + g01 * mu1 + g02 * mu2
    momentum_1 = g11 * mu1 + g10 * mu0 + g12 * mu2
    momentum_2 = g20 * mu0 + g21 * mu1 + g22 * mu2
    return momentum_0, momentum_1, momentum_2


def _entered(state):
    """Return the state with that momentum, and what this is in space."""
    moving = state[:9] + _inward(state)
    return moving, _outward(moving)


def _left(state, moving, before):
    """Return the state in space of one with the other momentum.

    What this has gained in space is added to that of the state: where rounding has made q
    not quite orthogonal, it turns that alone.
    """
    gained = zip(state[9:], _outward(moving), before)
    new = moving[:9] + tuple(mu + (y - x) for mu, y, x in gained)
    if not all(map(isfinite, new)):
        raise StepFailed(NOT_FINITE, "the new momentum is finite in the body alone")
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
    moving, before = _entered(state)
    try:
        if steps > 0 and not isfinite(h):
            raise StepFailed(BAD_STEP, f"the step size h = {h} is not finite")
        for made in range(steps):
            try:
                moving = _checked(moving, h, memory, statistics)
            except StepFailed:
                if statistics is not None:
                    statistics.failed = 0
                new = _continued(moving, h, memory, statistics)
                moving = new
            if stride > 0 and (made + 1) % stride == 0:
                rows.append(list(_left(state, moving, before)))
        end = _left(state, moving, before) if steps > 0 else state
    except StepFailed as failure:
        try:
            end = _left(state, moving, before) if made > 0 else state
        except StepFailed:
            made, end = 0, state
        failure.step, failure.state = made, end
        raise
    return rows if stride > 0 else list(end)
