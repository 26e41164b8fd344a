"""Free rigid body with attitude, S^3 (thesis section 2.6): one step by
discrete_gradient:midpoint

method:     family discrete_gradient, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Free rigid body with attitude, S^3 (thesis section 2.6), group S^3
solved by:  the equations of xi: Newton's method, 3 unknowns (a fixed point does not
            settle with steps 8 times as long)
state:      [0..3] y: element of S^3, real part first
left out:   1 lin (zeros)
            1 act, 1 exp, 2 lin (sharing)
            3 act (fusion)
            3 exp (dead code)
            the time: the scene does not depend on it
operations: 34 add, 59 mul, 1 stumpff_01 a step
            21 add, 42 mul a start, in steps that follow no other
            606 add, 798 mul, 2 quotient, 2 stumpff_23 a matrix of the equations of
            xi
            148 add, 240 mul, 3 quotient, 2 stumpff_01 a sweep of the equations of
            xi
made by:    orderconds emit free_rigid_body_s3 --method discrete_gradient:midpoint
            --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_s3_discrete_gradient_midpoint

    state = [1.0, 0.0, 0.0, 0.0]
    print(free_rigid_body_s3_discrete_gradient_midpoint.run(state, 0.02, 100))
"""

from math import cos, fabs, isfinite, sin, sqrt

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
        "the equations of xi",
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

    past: solutions of its equations, the latest first; inverses: of Newton's matrices, by
    block.
    """

    def __init__(self):
        self.past = []
        self.inverses = [None] * 1

    def extrapolated(self):
        """Return the polynomial through the last solutions, continued by a step."""
        if len(self.past) == 1:
            return self.past[0]
        if len(self.past) == 2:
            return [2.0 * a - b for a, b in zip(*self.past)]
        return [3.0 * (a - b) + c for a, b, c in zip(*self.past)]


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


def _stumpff_small_0(z):
    """Return c_0(z) for z <= 1/16."""
    w = z * z
    w2 = w * w
    return (
        (1.0 + z * -0.5)
        + w * (0.041666666666666664 + z * -0.001388888888888889)
        + w2 * (2.48015873015873e-05 + z * -2.755731922398589e-07)
        + w * w2 * (2.08767569878681e-09)
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


def _stumpff_series_0(z):
    """Return c_0(z) = sum (-z)^j/(2j+0)! up to z = 1."""
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
    half = 0.5 * sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(half) / half
    c3 = _stumpff_series_3(z) if z <= 4.0 else (1.0 - ratio * cos(half)) / z
    return 0.5 * (ratio * ratio), c3


def _stumpff_23(z):
    """Return, for z >= 0 and s = sqrt(z): c_2 = (1 - cos(s))/s^2, c_3 = (s - sin(s))/s^3."""
    if z <= 0.0625:
        return _stumpff_small_2(z), _stumpff_small_3(z)
    return _stumpff_23_far(z)


def _stumpff_01_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s."""
    if z <= 1.0:
        return _stumpff_series_0(z), _stumpff_series_1(z)
    s = sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(s) / s
    return cos(s), ratio


def _stumpff_01(z):
    """Return, for z >= 0 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s."""
    if z <= 0.0625:
        return _stumpff_small_0(z), _stumpff_small_1(z)
    return _stumpff_01_far(z)


def quotient(a, b):
    """Return a/b, and 0 where b = 0, which is the limit there."""
    return a / b if b else b


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
    q0, q1, q2, q3 = state
    w1 = -120.0 * q2 - 5.0 * q3
    w2 = 2.0 * q3
    w3 = 120.0 * q1 + w2
    w4 = -2.0 * q2
    w5 = 5.0 * q1 + w4
    w6 = (
        -1.0
        - 0.016666666666666666 * q0 * w5
        + 0.016666666666666666 * q1 * w3
        - 0.016666666666666666 * q2 * w1
    )
    w7 = 1.0 - q0 * w1 + q2 * w5 - q3 * w3
    w8 = 0.5 - 0.2 * q0 * w3 - 0.2 * q1 * w5 + 0.2 * q3 * w1
    if memory.past:
        xi_0, xi_1, xi_2 = memory.extrapolated()
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
            -0.5
            - 0.008333333333333333 * q0 * w5
            + w12 * w14
            + 0.008333333333333333 * q1 * w3
            + 0.5 * q1 * w10
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
    # the equations of xi: Newton's method in xi_0, xi_1, xi_2
    previous_1 = 0.0
    make_1 = memory.inverses[0] is None
    for sweep in range(1, 101):
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
            -0.2 * (w32 * w58)
            - w32 * w59
            + w29 * w60
            + 0.016666666666666666 * (w29 * w63)
            + 120.0 * w66
        )
        w68 = w44 * w58 - Y1_1 * w59 - Y1_0 * w60 + w35 * w63 + Y1_2 * w40
        w69 = w67 + 5.0 * w68
        w70 = (
            -0.2 * (w29 * w58)
            - w29 * w59
            - w32 * w60
            - 0.016666666666666666 * (w32 * w63)
            + w26 * w64
        )
        w71 = Y1_3 * w59 + w43 * w58 - Y1_2 * w60 + w27 * w63 + Y1_0 * w64
        w72 = (
            -0.016666666666666666 * (w26 * w63)
            - w26 * w60
            - 120.0 * w71
            + w32 * w40
            - 2.0 * w68
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
            w87 * w88
            + w92 * w93
            + 0.5 * (w83 * w83)
            - H0
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
        total = residual_xi_0 + residual_xi_1 + residual_xi_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi", 0, sweep, statistics)
        if make_1:
            w134 = quotient(1.0, w117)
            w135 = d1_0 * w134
            w136 = h * w116
            w137 = quotient(1.0, w74)
            w138 = w93 * w137
            w139 = 0.5 * w92 * w137
            w140 = 0.5 * w87 * w137
            w141 = w88 * w137
            w142 = w83 * w137
            w143 = w91 * w138 - Y_0 * w139 + Y_1 * w140 + w85 * w141 - Y_3 * w142
            w144 = (
                -0.2 * w80 * w138
                - w80 * w139
                + w82 * w140
                + 0.016666666666666666 * w82 * w141
                + 120.0 * w143
            )
            w145 = w90 * w138 - Y_1 * w139 - Y_0 * w140 + w86 * w141 + Y_2 * w142
            w146 = w144 + 5.0 * w145
            w147 = w81 * w142
            w148 = (
                -0.2 * w82 * w138
                - w82 * w139
                - w80 * w140
                - 0.016666666666666666 * w80 * w141
            )
            w149 = w147 - w148
            w150 = Y_3 * w139 + w89 * w138 - Y_2 * w140 + w84 * w141 - Y_0 * w142
            w151 = w81 * w139 + 0.2 * w81 * w138 - w82 * w142 + 2.0 * w143 - 5.0 * w150
            w152 = (
                -0.016666666666666666 * w81 * w141
                - w81 * w140
                - 120.0 * w150
                + w80 * w142
                - 2.0 * w145
            )
            w153 = q0 * w146 + q1 * w149 + q2 * w151 - q3 * w152
            w154 = q0 * w151 + q3 * w149 + q1 * w152 - q2 * w146
            w155 = q0 * w152 + q2 * w149 - q1 * w151 + q3 * w146
            c2_1, c3_1 = _stumpff_23(w74)
            w156 = (x_2 * w154 + x_1 * w155 + x_0 * w153) * (0.5 * (c3_1 - c2_1))
            w157 = (
                (q3 * w151 + q2 * w152 + q1 * w146 + q0 * (w148 - w147)) * (0.5 * c1_2)
            )
            w158 = w156 - (w116 * w137 + w157)
            w159 = h * (w153 * c1_2 - d1_0 * w137 + 2.0 * x_0 * w158)
            w160 = d1_2 * w134
            w161 = d1_1 * w134
            w162 = x_2 * w160 + x_1 * w161 + x_0 * w135
            w163 = w135 * w136 + w159 * w162
            w164 = w18 * c1_1
            w165 = q2 * w164
            w166 = 2.0 * x1_0 * w18
            c2_2, c3_2 = _stumpff_23(w19)
            w167 = 0.5 * (c3_2 - c2_2)
            w168 = x1_2 * w167
            w169 = 0.5 * c1_1
            w170 = x1_1 * w167
            w171 = x1_0 * w167
            w172 = q0 * w168 - q3 * w169 - q1 * w170 + q2 * w171
            w173 = w165 + w166 * w172
            w174 = -2.0 * w46
            w175 = 2.0 * w40
            w176 = w52 * w174 - 0.5 * (w29 + w41) + w25 * w175
            w177 = w53 * w118
            w178 = w25 * w118
            w179 = D_2 * w134
            w180 = 2.0 * d1_2
            w181 = w118 * w134
            w182 = x_2 * w137
            w183 = w179 - w180 * w181 + w160 - w162 * w182
            w184 = w55 * w183
            w185 = w59 + 0.1 * w57
            w186 = 2.0 * w64 - 5.0 * w185
            w187 = 0.08333333333333333 * Y1_2 + 0.03333333333333333 * Y1_1
            w188 = w185 + w126 * w187
            w189 = -0.016666666666666666 * w32
            w190 = Y1_3 * w189
            w191 = Y1_0 * w188 - (w65 + w126 * w190)
            w192 = w29 - 5.0 * Y1_0
            w193 = w28 + w192
            w194 = Y1_0 * w193 - w56
            w195 = 0.5 * w26 - 2.5 * Y1_3
            w196 = 0.2 * w26 - Y1_3 - 0.4 * Y1_0
            w197 = -0.2 * w29
            w198 = Y1_0 * w196 - Y1_3 * w197
            w199 = -0.008333333333333333 * w62 - w60
            w200 = -0.016666666666666666 * w26
            w201 = 0.03333333333333333 * Y1_0
            w202 = w49 + w200 + w201
            w203 = w199 + w126 * w202
            w204 = -120.0 * Y1_0
            w205 = 0.4 * Y1_1 - 24.0 * Y1_3
            w206 = -120.0 * w185 - 5.0 * w203 + w192 * w204 + w195 * w205
            w207 = (
                Y1_0 * w186 - w70 - 5.0 * w191 + w192 * w194 + w195 * w198 + Y1_1 * w206
            )
            w208 = w64 + w128 * w187
            w209 = -0.1 * w57 - w59
            w210 = w128 * w202 + Y1_3 * w204 + w53 * w205
            w211 = (
                Y1_0 * w208
                - (Y1_3 * w209 + w128 * w190)
                + Y1_3 * w194
                + w53 * w198
                + Y1_1 * w210
            )
            w212 = 0.016666666666666666 * w29 - 0.08333333333333333 * Y1_0 + w47
            w213 = w126 * w212
            w214 = 120.0 * Y1_3
            w215 = -0.2 * w32 - Y1_1 - 24.0 * Y1_0
            w216 = w60 + 0.008333333333333333 * w62
            w217 = w216 + w128 * w212 + Y1_3 * w214 + w53 * w215
            w218 = 120.0 * w64 - 5.0 * w213 + w192 * w214 + w195 * w215 + 2.0 * w217
            w219 = w207 + 2.0 * w211 - Y1_2 * w218
            w220 = w34 - w33
            w221 = -5.0 * w220 - w29 + w50
            w222 = w31 * w42 + w25 * w28
            w223 = w31 + w32
            w224 = 5.0 * Y1_2
            w225 = Y1_1 * w223 - Y1_2 * w224
            w226 = w118 * w222 + w184 * w225
            w227 = D_1 * w134
            w228 = 2.0 * d1_1
            w229 = x_1 * w137
            w230 = w227 - w181 * w228 + w161 - w162 * w229
            w231 = w55 * w230
            w232 = Y1_2 * w189
            w233 = Y1_2 * w64 + w126 * w232 + Y1_1 * w188
            w234 = w61 + Y1_1 * w193
            w235 = Y1_2 * w197 + Y1_1 * w196
            w236 = (
                w69 - Y1_1 * w186 + 5.0 * w233 - w192 * w234 - w195 * w235 + Y1_0 * w206
            )
            w237 = (
                Y1_0 * w210
                - (Y1_2 * w209 + w128 * w232 + Y1_1 * w208 + Y1_3 * w234 + w53 * w235)
            )
            w238 = Y1_0 * w223 + Y1_3 * w224
            w239 = w236 + 2.0 * w237 + Y1_3 * w218 + w221 * w238
            w240 = (
                w118 * w176
                - 5.0 * w177
                + 2.0 * w178
                + w184 * w219
                + w221 * w226
                + w231 * w239
            )
            w241 = w49 * w52 + w25 * w37
            w242 = Y1_1 + 2.5 * Y1_2
            w243 = -0.5 * w32
            w244 = -0.5 * w26
            w245 = w244 + 60.0 * Y1_2 + Y1_0
            w246 = 0.5 * w29
            w247 = w246 + 2.5 * w220 + 60.0 * Y1_1
            w248 = Y1_0 * w242 - Y1_3 * w243 + Y1_1 * w245 - Y1_2 * w247
            w249 = Y1_0 * w245 - (Y1_2 * w243 + Y1_1 * w242) + Y1_3 * w247
            w250 = w118 * w241 + w184 * w248 + w231 * w249
            w251 = w240 + w187 * w250
            w252 = q1 * w168 - q2 * w169 + q0 * w170 - q3 * w171
            w253 = q3 * w164
            w254 = w166 * w252 - w253
            w255 = 2.0 * w36
            w256 = -2.0 * w40
            w257 = 0.5 * (w32 + w48) + w52 * w255 + w42 * w256
            w258 = w42 * w118
            w259 = Y1_3 * w199
            w260 = Y1_0 + w244
            w261 = w187 * w260 - 5.0 * w199
            w262 = w49 - w32 + w204
            w263 = (
                2.0 * w259
                - w69
                - w190 * w260
                + Y1_0 * w261
                - 120.0 * w191
                + w194 * w262
            )
            w264 = Y1_1 - 60.0 * Y1_3
            w265 = (
                w256
                - 120.0 * w199
                + w256
                + w202 * w260
                - 120.0 * w203
                + w204 * w262
                + w205 * w264
            )
            w266 = 5.0 * w40 - 2.0 * w209
            w267 = w266 + w212 * w260 - 120.0 * w213 + w214 * w262 + w215 * w264
            w268 = w263 + w198 * w264 + Y1_1 * w265 - Y1_2 * w267
            w269 = w223 - 120.0 * w220
            w270 = Y1_2 * w199
            w271 = (
                2.0 * w270
                - w70
                - w232 * w260
                - Y1_1 * w261
                + 120.0 * w233
                - w234 * w262
            )
            w272 = w271 - w235 * w264 + Y1_0 * w265 + Y1_3 * w267 + w238 * w269
            w273 = (
                w118 * w257
                - 2.0 * w258
                - 120.0 * w177
                + w184 * w268
                + w226 * w269
                + w231 * w272
            )
            w274 = w200 + w201 + w49
            w275 = w273 + w250 * w274
            w276 = q0 * w164
            w277 = q3 * w170 - (q1 * w169 + q2 * w168) + q0 * w171
            w278 = w276 + w166 * w277
            w279 = 2.0 * w46
            w280 = -2.0 * w36
            w281 = w42 * w279 + w25 * w280
            w282 = w246 - 2.5 * Y1_0
            w283 = 2.0 * w216 + w187 * w282
            w284 = -5.0 * Y1_2
            w285 = w243 - 2.5 * Y1_1
            w286 = (
                w72 - 5.0 * w259 - w190 * w282 + Y1_0 * w283 + w194 * w284 + w198 * w285
            )
            w287 = w266 + w202 * w282 + w204 * w284 + w205 * w285
            w288 = 5.0 * w209
            w289 = (
                w288
                + 120.0 * w216
                + w288
                + w212 * w282
                + w214 * w284
                + w215 * w285
                + 120.0 * w217
            )
            w290 = w286 + Y1_1 * w287 + 120.0 * w211 - Y1_2 * w289
            w291 = w224 - 120.0 * Y1_3
            w292 = (
                -5.0 * w270
                - w73
                - w232 * w282
                - Y1_1 * w283
                - w234 * w284
                - w235 * w285
            )
            w293 = w292 + Y1_0 * w287 + 120.0 * w237 + Y1_3 * w289 + w238 * w291
            w294 = (
                w118 * w281
                + 5.0 * w258
                + 120.0 * w178
                + w184 * w290
                + w226 * w291
                + w231 * w293
            )
            w295 = w294 + w212 * w250
            w296 = w55 * w134
            w297 = w132 * w134
            w298 = w125 * w134
            w299 = x_2 * w297 + x_1 * w298 + x_0 * w296
            w300 = w126 * w174 + w128 * w175
            w301 = 0.5 * w51
            w302 = 0.1 * w26 + w301 + w119 * w174 + w52 * w175
            w303 = D_0 * w134
            w304 = w127 * w179 + w120 * w227 + w53 * w303
            w305 = w129 * w179 + w123 * w227 + w25 * w303
            w306 = w133 * w134
            w307 = w297 - w180 * w306 - w182 * w299
            w308 = (
                w179 * w300
                + w227 * w302
                + w176 * w303
                - 5.0 * w304
                + 2.0 * w305
                + w219 * w307
            )
            w309 = w31 * w52 + w28 * w128
            w310 = w31 * w121 + w28 * w52
            w311 = w179 * w309 + w227 * w310 + w222 * w303 + w225 * w307
            w312 = w298 - w228 * w306 - w229 * w299
            w313 = w49 * w126 + w37 * w128
            w314 = w49 * w119 + w37 * w52
            w315 = w179 * w313 + w227 * w314 + w241 * w303 + w248 * w307 + w249 * w312
            w316 = w308 + w221 * w311 + w239 * w312 + w187 * w315
            w317 = -0.008333333333333333 * w26 - 0.5 * w51 + w126 * w255 + w52 * w256
            w318 = w119 * w255 + w121 * w256
            w319 = w130 * w179 + w122 * w227 + w42 * w303
            w320 = (
                w179 * w317
                + w227 * w318
                + w257 * w303
                - 2.0 * w319
                - 120.0 * w304
                + w268 * w307
            )
            w321 = w320 + w269 * w311 + w272 * w312 + w274 * w315
            w322 = 0.5 * w41
            w323 = 0.008333333333333333 * w29 + w322 + w52 * w279 + w128 * w280
            w324 = -0.1 * w32 - 0.5 * w48 + w121 * w279 + w52 * w280
            w325 = (
                w179 * w323
                + w227 * w324
                + w281 * w303
                + 5.0 * w319
                + 120.0 * w305
                + w290 * w307
            )
            w326 = w325 + w291 * w311 + w293 * w312 + w212 * w315
            w327 = w159 * w299 + w136 * w296 + w173 * w316 + w254 * w321 + w278 * w326
            w328 = Y1_1 * w189
            w329 = Y1_2 * w188 - (Y1_1 * w64 + w126 * w328)
            w330 = Y1_2 * w193 - w26 * Y1_1
            w331 = Y1_2 * w196 - Y1_1 * w197
            w332 = (
                Y1_2 * w186 - w72 - 5.0 * w329 + w192 * w330 + w195 * w331 - Y1_3 * w206
            )
            w333 = (
                Y1_2 * w208
                - (Y1_1 * w209 + w128 * w328)
                + Y1_3 * w330
                + w53 * w331
                - Y1_3 * w210
            )
            w334 = Y1_0 * w224 - Y1_3 * w223
            w335 = Y1_2 * w242 - Y1_1 * w243 - Y1_3 * w245 + Y1_0 * w247
            w336 = w332 + 2.0 * w333 + Y1_0 * w218 + w221 * w334 + w187 * w335
            w337 = Y1_1 * w199
            w338 = (
                w73
                + 2.0 * w337
                - w260 * w328
                + Y1_2 * w261
                - 120.0 * w329
                + w262 * w330
            )
            w339 = (
                w338
                + w264 * w331
                - Y1_3 * w265
                + Y1_0 * w267
                + w269 * w334
                + w274 * w335
            )
            w340 = (
                -5.0 * w337
                - w70
                - w282 * w328
                + Y1_2 * w283
                + w284 * w330
                + w285 * w331
            )
            w341 = (
                w340
                - Y1_3 * w287
                + 120.0 * w333
                + Y1_0 * w289
                + w291 * w334
                + w212 * w335
            )
            w342 = w173 * w336 + w254 * w339 + w278 * w341
            w343 = 2.0 * d1_0
            w344 = x_0 * w137
            w345 = w303 - w181 * w343 + w135 - w162 * w344
            w346 = w296 - w306 * w343 - w299 * w344
            w347 = w55 * w345 - w133 - d1_0 * w346
            w348 = (
                w55 * w163
                + w173 * w251
                + w254 * w275
                + w278 * w295
                - d1_0 * w327
                + w342 * w347
            )
            w349 = w173 * w196 + w205 * w254 + w215 * w278
            w350 = w50 * w52 + w42 * w47
            w351 = w195 + w220
            w352 = -0.5 * w29
            w353 = w285 + 60.0 * w220
            w354 = Y1_0 * w351 - Y1_3 * w352 + Y1_1 * w264 - Y1_2 * w353
            w355 = Y1_0 * w264 - (Y1_2 * w352 + Y1_1 * w351) + Y1_3 * w353
            w356 = w50 * w126 + w47 * w52
            w357 = w50 * w119 + w47 * w121
            w358 = w179 * w356 + w227 * w357 + w303 * w350 + w307 * w354 + w312 * w355
            w359 = Y1_2 * w351 - Y1_1 * w352 - Y1_3 * w264 + Y1_0 * w353
            w360 = w118 * w350 + w184 * w354 + w231 * w355 - d1_0 * w358 + w347 * w359
            w361 = q1 * w164
            w362 = q0 * w169 + q3 * w168 + q2 * w170 + q1 * w171
            w363 = w361 + w166 * w362
            w364 = w244 + w301
            w365 = 2.0 * w209 - 5.0 * w64 + w187 * w243
            w366 = -120.0 * w64 - 2.0 * w199 + w202 * w243 + w26 * w204 + w205 * w352
            w367 = (
                w73 - w190 * w243 + Y1_0 * w365 + w26 * w194 + w198 * w352 + Y1_1 * w366
            )
            w368 = 5.0 * w199 + 120.0 * w209 + w212 * w243 + w26 * w214 + w215 * w352
            w369 = w367 - Y1_2 * w368
            w370 = (
                w72 - w232 * w243 - Y1_1 * w365 - w26 * w234 - w235 * w352 + Y1_0 * w366
            )
            w371 = w370 + Y1_3 * w368 - w26 * w238
            w372 = 0.5 * w48 - 0.008333333333333333 * w32
            w373 = w322 - 0.1 * w29
            w374 = (
                w179 * w372
                + w227 * w373
                + w303 * w364
                + w307 * w369
                - w26 * w311
                + w312 * w371
            )
            w375 = w374 + w189 * w315
            w376 = (
                w118 * w364
                + w184 * w369
                - w26 * w226
                + w231 * w371
                + w189 * w250
                - d1_0 * w375
            )
            w377 = (
                w69 - w243 * w328 + Y1_2 * w365 + w26 * w330 + w331 * w352 - Y1_3 * w366
            )
            w378 = w377 + Y1_0 * w368 - w26 * w334 + w189 * w335
            w379 = w376 + w347 * w378 + w197 * w360
            w380 = 2.0 * x1_1 * w18
            w381 = w165 + w362 * w380
            w382 = h * (w155 * c1_2 - d1_1 * w137 + 2.0 * x_1 * w158)
            w383 = w136 * w161 + w162 * w382
            w384 = w172 * w380 - w361
            w385 = w276 + w252 * w380
            w386 = w253 + w277 * w380
            w387 = w136 * w298 + w299 * w382 + w316 * w384 + w321 * w385 + w326 * w386
            w388 = w336 * w384 + w339 * w385 + w341 * w386
            w389 = (
                w55 * w383
                + w251 * w384
                + w275 * w385
                + w295 * w386
                - d1_0 * w387
                + w347 * w388
            )
            w390 = w196 * w384 + w205 * w385 + w215 * w386
            w391 = 2.0 * x1_2 * w18
            w392 = w253 + w362 * w391
            w393 = h * (w154 * c1_2 - d1_2 * w137 + 2.0 * x_2 * w158)
            w394 = w136 * w160 + w162 * w393
            w395 = w276 + w172 * w391
            w396 = w361 + w252 * w391
            w397 = w277 * w391 - w165
            w398 = w136 * w297 + w299 * w393 + w316 * w395 + w321 * w396 + w326 * w397
            w399 = w336 * w395 + w339 * w396 + w341 * w397
            w400 = (
                w55 * w394
                + w251 * w395
                + w275 * w396
                + w295 * w397
                - d1_0 * w398
                + w347 * w399
            )
            w401 = w196 * w395 + w205 * w396 + w215 * w397
            w402 = w125 * w183
            w403 = w118 * w310 + w225 * w402
            w404 = w125 * w230 - w133
            w405 = w118 * w314 + w248 * w402 + w249 * w404
            w406 = w114 - w113
            w407 = (
                w118 * w373
                + w369 * w402
                - w26 * w403
                + w371 * w404
                + w189 * w405
                + w375 * w406
            )
            w408 = w125 * w345 + w346 * w406
            w409 = w118 * w357 + w354 * w402 + w355 * w404 + w358 * w406 + w359 * w408
            w410 = w407 + w378 * w408 + w197 * w409
            w411 = w118 * w120
            w412 = w118 * w123
            w413 = (
                w118 * w302
                - 5.0 * w411
                + 2.0 * w412
                + w219 * w402
                + w221 * w403
                + w239 * w404
            )
            w414 = w413 + w187 * w405
            w415 = w118 * w122
            w416 = (
                w118 * w318
                - 2.0 * w415
                - 120.0 * w411
                + w268 * w402
                + w269 * w403
                + w272 * w404
            )
            w417 = w416 + w274 * w405
            w418 = (
                w118 * w324
                + 5.0 * w415
                + 120.0 * w412
                + w290 * w402
                + w291 * w403
                + w293 * w404
            )
            w419 = w418 + w212 * w405
            w420 = (
                w125 * w163
                + w173 * w414
                + w254 * w417
                + w278 * w419
                + w327 * w406
                + w342 * w408
            )
            w421 = (
                w125 * w383
                + w384 * w414
                + w385 * w417
                + w386 * w419
                + w387 * w406
                + w388 * w408
            )
            w422 = (
                w125 * w394
                + w395 * w414
                + w396 * w417
                + w397 * w419
                + w398 * w406
                + w399 * w408
            )
            w423 = w132 * w183 - w133
            w424 = w118 * w309 + w225 * w423
            w425 = w132 * w230
            w426 = w118 * w313 + w248 * w423 + w249 * w425
            w427 = (
                w118 * w372
                + w369 * w423
                - w26 * w424
                + w371 * w425
                + w189 * w426
                - d1_2 * w375
            )
            w428 = w132 * w345 - d1_2 * w346
            w429 = w118 * w356 + w354 * w423 + w355 * w425 - d1_2 * w358 + w359 * w428
            w430 = w427 + w378 * w428 + w197 * w429
            w431 = w118 * w127
            w432 = w118 * w129
            w433 = (
                w118 * w300
                - 5.0 * w431
                + 2.0 * w432
                + w219 * w423
                + w221 * w424
                + w239 * w425
            )
            w434 = w433 + w187 * w426
            w435 = w118 * w130
            w436 = (
                w118 * w317
                - 2.0 * w435
                - 120.0 * w431
                + w268 * w423
                + w269 * w424
                + w272 * w425
            )
            w437 = w436 + w274 * w426
            w438 = (
                w118 * w323
                + 5.0 * w435
                + 120.0 * w432
                + w290 * w423
                + w291 * w424
                + w293 * w425
            )
            w439 = w438 + w212 * w426
            w440 = (
                w132 * w163
                + w173 * w434
                + w254 * w437
                + w278 * w439
                - d1_2 * w327
                + w342 * w428
            )
            w441 = (
                w132 * w383
                + w384 * w434
                + w385 * w437
                + w386 * w439
                - d1_2 * w387
                + w388 * w428
            )
            w442 = (
                w132 * w394
                + w395 * w434
                + w396 * w437
                + w397 * w439
                - d1_2 * w398
                + w399 * w428
            )
            row_1_1 = [
                1.0 - (w348 + w349 * w360 - w363 * w379),
                w379 * w381 - (w389 + w360 * w390),
                w379 * w392 - (w400 + w360 * w401),
            ]
            row_1_2 = [
                w363 * w410 - (w420 + w349 * w409),
                1.0 - (w421 + w390 * w409 - w381 * w410),
                w392 * w410 - (w422 + w401 * w409),
            ]
            row_1_3 = [
                w363 * w430 - (w440 + w349 * w429),
                w381 * w430 - (w441 + w390 * w429),
                1.0 - (w442 + w401 * w429 - w392 * w430),
            ]
            memory.inverses[0] = invert([row_1_1, row_1_2, row_1_3])
            if statistics is not None:
                statistics.matrices += 1
            if memory.inverses[0] is None:
                raise _failed(NOT_CONVERGED, "the equations of xi", 0, sweep, statistics)
        row_1_1, row_1_2, row_1_3 = memory.inverses[0]
        change_xi_0 = (
            row_1_1[0] * residual_xi_0
            + row_1_1[1] * residual_xi_1
            + row_1_1[2] * residual_xi_2
        )
        change_xi_1 = (
            row_1_2[0] * residual_xi_0
            + row_1_2[1] * residual_xi_1
            + row_1_2[2] * residual_xi_2
        )
        change_xi_2 = (
            row_1_3[0] * residual_xi_0
            + row_1_3[1] * residual_xi_1
            + row_1_3[2] * residual_xi_2
        )
        xi_0 += change_xi_0
        xi_1 += change_xi_1
        xi_2 += change_xi_2
        change = max(abs(change_xi_0), abs(change_xi_1), abs(change_xi_2))
        scale = max(1.0, abs(xi_0), abs(xi_1), abs(xi_2))
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 9.094947017729282e-13 * scale):
            break
        make_1 = 0.0 < 0.0625 * previous_1 < change
        previous_1 = change
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    x_0_ = h * xi_0
    x_1_ = h * xi_1
    x_2_ = h * xi_2
    w443 = x_0_ * x_0_ + x_1_ * x_1_ + x_2_ * x_2_
    c0_3, c1_3 = _stumpff_01(w443)
    w446 = x_0_ * c1_3
    w447 = x_1_ * c1_3
    w448 = x_2_ * c1_3
    Y_0_ = q0 * c0_3 - (q1 * w446 + q2 * w447 + q3 * w448)
    Y_1_ = q3 * w447 - q2 * w448 + (q0 * w446 + q1 * c0_3)
    Y_2_ = q1 * w448 - q3 * w446 + (q0 * w447 + q2 * c0_3)
    Y_3_ = q2 * w446 - q1 * w447 + (q0 * w448 + q3 * c0_3)
    found = xi_0, xi_1, xi_2
    memory.past = [found, *memory.past[:2]]
    return Y_0_, Y_1_, Y_2_, Y_3_


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
    if len(state) != 4:
        raise ValueError(f"expected 4 numbers in state, found {len(state)}")
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
