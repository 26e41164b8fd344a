"""Dipole on a stick, T*SO(3) (thesis section 3.6): one step by vcg:triple_jump

method:     family vcg, tableau triple_jump
source:     Yoshida 1990; Hairer, Lubich and Wanner, (II.4.4); Table 3.2b of
            Bogfjellmo and Marthinsen
order:      4, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Dipole on a stick, T*SO(3) (thesis section 3.6), group SO(3)
substeps:   3, all made by one function, of 1.35121, -1.70241, 1.35121 times h
solved by:  the equations of xi1, n1: Newton's method, 3 unknowns (2.0 sweeps of 177
            operations and 0.05 matrices of 49 (in C: 1.00) a substep; fixed point:
            3.2 sweeps of 183 operations; Newton's method with the matrix to first
            order in h: 1.9 sweeps of 198 operations and 1.00 matrices of 61)
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual algebra of SO(3)
left out:   2 Adt, 15 Adtinv, 15 dexpt, 10 exp, 2 hamilton, 2 identity, 16 lin, 12
            mul, 3 zero (substeps)
            3 Adtinv, 2 mul (zeros)
            1 identity (sharing)
            1 identity (dead code)
            1 dexpt (factors)
            1 lin (sharing)
            2 hamilton (body frame)
            1 Adinv, 1 Adt (opposites)
            1 Adt (opposites)
            3 Adtinv, 1 force (dead code)
            1 mul (rows)
            1 Adt, 2 dexpt (functions)
            1 Adinv (opposites)
            1 Ad (functions)
            1 legendre (sharing)
            1 exp, 1 lin, 2 seriest (factors)
            parameters, folded: beta = 1, depth = 3/2
            the time: the scene does not depend on it
operations: 114 add, 174 mul, 3 stumpff_12 a step
            6 mul a start, in steps that follow no other
            11 add, 34 mul, 1 div a matrix of the equations of xi1, n1
            51 add, 73 mul, 2 div, 2 sqrt, 1 stumpff_123 a sweep of the equations of
            xi1, n1
            12 add, 18 mul where a run begins, 12 add, 9 mul where it ends
made by:    orderconds emit dipole --method vcg:triple_jump --target python -o .
version:    orderconds 0.1.0

Use:

    import dipole_vcg_triple_jump

    state = [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.01, 0.0]
    print(dipole_vcg_triple_jump.run(state, 0.005, 100))
"""

from math import comb, cos, isfinite, sin, sqrt

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


def _substep(state, h, memory, statistics):
    """Return the state after one part of a step as a tuple."""
    g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
    if memory.past:
        xi1_0, xi1_1, xi1_2 = memory.guess
    else:
        xi1_0 = 0.9900990099009901 * mu0
        xi1_1 = mu1
        xi1_2 = 100.0 * mu2
    w1 = 0.5 * h
    # the equations of xi1, n1: Newton's method in xi1_0, xi1_1, xi1_2
    previous_1 = 0.0
    rate_1 = memory.rates[0] if memory.past else 1.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
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
        w11 = 1.5 / (w10 * sqrt(w10))
        w12 = w8 + w9
        w13 = 1.5 / (w12 * sqrt(w12))
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
        total = residual_0 + residual_1 + residual_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi1, n1", 0, sweep, statistics)
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
            row_1_1 = [
                w31 * w39, w39 * (w30 * w37 + 0.01 * w33), w39 * (w37 + w28 * w33),
            ]
            row_1_2 = [
                w36 * w39, w39 * (0.0101 - w34 * w37), w39 * (w35 * w37 + 1.01 * w28),
            ]
            row_1_3 = [
                w38 * w39, w39 * (w33 * w34 + 1.01 * w30), w39 * (1.01 - w33 * w35),
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
        scale = max(0.0, abs(xi1_0), abs(xi1_1), abs(xi1_2))
        still = 0.0 < previous_1 <= change and (
            change <= 5.684341886080802e-14 * scale
            or change * abs(h) <= 7.105427357601002e-15 * min(max(map(abs, state[0:9])), max(map(abs, state[9:12])))
        )
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
    found = xi1_0, xi1_1, xi1_2
    memory.keep(found)
    return (
        new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21, new_g22,
        new_mu0, new_mu1, new_mu2,
    )


def _checked(state, h, memory, statistics):
    """Return the state after one part of a step, which is finite."""
    try:
        new = _substep(state, h, memory, statistics)
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


# How long the parts of a step are, in units of h.
SUBSTEPS = (
    1.3512071919596575,
    -1.7024143839193153,
    1.3512071919596575,
)


def _composed(state, h, memory, statistics):
    """Return the state after one step, all its parts, as a tuple."""
    for k, fraction in enumerate(SUBSTEPS):
        try:
            state = _checked(state, fraction * h, memory[k], statistics)
        except StepFailed:
            if statistics is not None:
                statistics.failed = 0
            state = _continued(state, fraction * h, memory[k], statistics)
    return state


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
    if steps < 0:
        raise ValueError(f"expected no negative number of steps, found {steps}")
    rows = [list(state)]
    memory = [_Memory() for _ in SUBSTEPS]
    made = 0
    moving, before = _entered(state)
    try:
        if steps > 0 and not isfinite(h):
            raise StepFailed(BAD_STEP, f"the step size h = {h} is not finite")
        for made in range(steps):
            moving = _composed(moving, h, memory, statistics)
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
