"""Free rigid body with attitude, S^3 (thesis section 2.6): one step by
discrete_gradient:midpoint

method:     family discrete_gradient, tableau midpoint
source:     Table 3.2a of Bogfjellmo and Marthinsen
order:      2, certificate: exact (every order condition up to it is zero in exact
            arithmetic)
scene:      Free rigid body with attitude, S^3 (thesis section 2.6), group S^3
state:      [0..3] y: element of S^3, real part first
left out:   1 lin (zeros)
            1 act, 1 exp, 2 lin (sharing)
            3 act (fusion)
            3 exp (dead code)
            the time: the scene does not depend on it
operations: 55 add, 101 mul, 1 stumpff_01 a step
            142 add, 231 mul, 3 quotient, 2 stumpff_01 a sweep of the equations of
            xi
made by:    orderconds emit free_rigid_body_s3 --method discrete_gradient:midpoint
            --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_s3_discrete_gradient_midpoint

    state = [1.0, 0.0, 0.0, 0.0]
    print(free_rigid_body_s3_discrete_gradient_midpoint.run(state, 0.02, 100))
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
    """Fixed-point sweeps, added up over all steps that are given this object.

    sweeps: by block; most: the most that one block took in one step; failed: 1 + the
    block that failed, 0 if none has.
    """

    labels = [
        "the equations of xi",
    ]

    def __init__(self):
        self.sweeps, self.most, self.failed = [0] * 1, 0, 0

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


def _stumpff_01(z):
    """Return, for z >= 0 and s = sqrt(z): c_0 = cos(s), c_1 = sin(s)/s."""
    if z <= 0.0625:
        return _stumpff_small_0(z), _stumpff_small_1(z)
    if z <= 1.0:
        return _stumpff_series_0(z), _stumpff_series_1(z)
    s = sqrt(z if z <= 4503599627370496.0 else float("nan"))
    ratio = sin(s) / s
    return cos(s), ratio


def quotient(a, b):
    """Return a/b, and 0 where b = 0, which is the limit there."""
    return a / b if b else b


def _advance(state, h, statistics):
    """Return the state after one step as a tuple."""
    q0, q1, q2, q3 = state
    w1 = -0.5 * q3
    w2 = -120.0 * q2 - 5.0 * q3
    w3 = 2.0 * q3
    w4 = 120.0 * q1 + w3
    w5 = -2.0 * q2
    w6 = 5.0 * q1 + w5
    w7 = (
        -1.0
        - 0.016666666666666666 * q0 * w6
        + 0.016666666666666666 * q1 * w4
        - 0.016666666666666666 * q2 * w2
    )
    w8 = 1.0 - q0 * w2 + q2 * w6 - q3 * w4
    w9 = w3 * w8 - 2.0 * q1 * w7
    w10 = 0.5 * q2
    w11 = 0.5 - 0.2 * q0 * w4 - 0.2 * q1 * w6 + 0.2 * q3 * w2
    w12 = w5 * w8 + 2.0 * q1 * w11
    w13 = 2.0 * q2 * w7 - 2.0 * q3 * w11
    w14 = 0.5 * q0
    w15 = 0.5 - 0.5 * q0 * w2 + w13 * w14 + w6 * w10 + w10 * w12 + w1 * w4
    w16 = 0.25 - 0.1 * q0 * w4 + w9 * w14 - 0.1 * q1 * w6 - 0.5 * q1 * w12
    w17 = (
        -0.5
        - 0.008333333333333333 * q0 * w6
        + w12 * w14
        + 0.008333333333333333 * q1 * w4
        + 0.5 * q1 * w9
    )
    w18 = 0.5 * h
    w73 = w8 * w8
    w74 = 0.5 * w73
    w75 = q1 * w4
    w76 = q0 * w6
    w77 = -60.0 - w76
    w78 = w75 + w77
    w79 = q2 * w2
    w80 = w78 - w79
    w81 = 0.5 * w80
    w82 = w7 * w81
    w83 = q3 * w2
    w84 = q0 * w4
    w85 = 2.5 - w84
    w86 = q1 * w6
    w87 = w85 - w86
    w88 = w83 + w87
    w89 = 0.5 * w88
    w90 = w11 * w89
    w91 = w82 + w90
    H0 = w74 + w91
    # the equations of xi: fixed point in xi_0, xi_1, xi_2
    xi_0 = w1 * w9 + w15
    xi_1 = w16 + 0.1 * q3 * w2 + 0.5 * q3 * w13
    xi_2 = w17 - 0.008333333333333333 * q2 * w2 - 0.5 * q2 * w13
    previous_1 = 0.0
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
        Y1_0 = q0 * c0_1 - (q1 * w21 + q2 * w22 + q3 * w24)
        w33 = -0.016666666666666666 * Y1_0
        w34 = w32 * w33 - 1.0 + w29 * w30 + w26 * w27
        w35 = 1.0 - w26 * Y1_0 + Y1_2 * w32
        w36 = Y1_3 * w29
        w37 = w35 - w36
        w38 = w28 * w37 - 2.0 * Y1_1 * w34
        w39 = 0.5 * Y1_2
        w40 = 0.2 * Y1_3
        w41 = -0.2 * Y1_1
        w42 = -0.2 * Y1_0
        w43 = 0.5 + w29 * w42 + w32 * w41 + w26 * w40
        w44 = 2.0 * Y1_1 * w43 + w31 * w37
        w45 = 2.0 * Y1_2 * w34 - 2.0 * Y1_3 * w43
        w46 = 0.5 * Y1_0
        w47 = 0.5 - 0.5 * Y1_0 * w26 + w45 * w46 + w32 * w39 + w39 * w44 + w25 * w29
        w48 = w25 * w38 + w47
        w49 = 0.5 * (2.5 - w29 * Y1_0 - Y1_1 * w32 + Y1_3 * w26)
        w50 = 0.5 * w43
        w51 = 0.5 * w34
        w52 = 0.5 * (-60.0 - w32 * Y1_0 + Y1_1 * w29 - Y1_2 * w26)
        w53 = w36 - w35
        w54 = w42 * w49 - Y1_0 * w50 + Y1_1 * w51 + w30 * w52 + Y1_3 * w53
        w55 = (
            -0.2 * (w32 * w49)
            - w32 * w50
            + w29 * w51
            + 0.016666666666666666 * (w29 * w52)
            + 120.0 * w54
        )
        w56 = w41 * w49 - Y1_1 * w50 - Y1_0 * w51 + w33 * w52 + Y1_2 * w37
        w57 = w55 + 5.0 * w56
        w58 = (
            -0.2 * (w29 * w49)
            - w29 * w50
            - w32 * w51
            - 0.016666666666666666 * (w32 * w52)
            + w26 * w53
        )
        w59 = Y1_3 * w50 + w40 * w49 - Y1_2 * w51 + w27 * w52 + Y1_0 * w53
        w60 = (
            -0.016666666666666666 * (w26 * w52)
            - w26 * w51
            - 120.0 * w59
            + w32 * w37
            - 2.0 * w56
        )
        w61 = w26 * w50 + 0.2 * (w26 * w49) + w29 * w53 + 2.0 * w54 - 5.0 * w59
        d1_0 = Y1_0 * w57 - Y1_1 * w58 - Y1_3 * w60 + Y1_2 * w61
        x_0 = h * xi_0
        x_2 = h * xi_2
        x_1 = h * xi_1
        w62 = x_0 * x_0 + x_1 * x_1 + x_2 * x_2
        c0_2, c1_2 = _stumpff_01(w62)
        w64 = x_2 * c1_2
        w65 = x_0 * c1_2
        w67 = x_1 * c1_2
        Y_2 = q1 * w64 - q3 * w65 + (q0 * w67 + q2 * c0_2)
        Y_1 = q3 * w67 - q2 * w64 + (q0 * w65 + q1 * c0_2)
        w68 = 5.0 * Y_1 - 2.0 * Y_2
        Y_0 = q0 * c0_2 - (q1 * w65 + q2 * w67 + q3 * w64)
        Y_3 = q2 * w65 - q1 * w67 + (q0 * w64 + q3 * c0_2)
        w69 = -120.0 * Y_2 - 5.0 * Y_3
        w70 = 120.0 * Y_1 + 2.0 * Y_3
        w71 = (
            (-1.0 - 0.016666666666666666 * Y_0 * w68 + 0.016666666666666666 * Y_1 * w70 - 0.016666666666666666 * Y_2 * w69)
            * (0.5 * (-60.0 - w68 * Y_0 + Y_1 * w70 - Y_2 * w69))
        )
        w72 = (
            (0.5 - 0.2 * Y_0 * w70 - 0.2 * Y_1 * w68 + 0.2 * Y_3 * w69)
            * (0.5 * (2.5 - Y_0 * w70 - Y_1 * w68 + Y_3 * w69))
        )
        p_1 = 1.0 - Y_0 * w69 + Y_2 * w68 - Y_3 * w70
        H1 = w71 + w72 + 0.5 * (p_1 * p_1)
        d1_1 = Y1_3 * w57 - Y1_2 * w58 + Y1_0 * w60 - Y1_1 * w61
        d1_2 = Y1_1 * w60 - (Y1_3 * w58 + Y1_2 * w57) + Y1_0 * w61
        w92 = quotient(H1 - H0 - (d1_0 * x_0 + x_1 * d1_1 + x_2 * d1_2), w62)
        D_0 = d1_0 + x_0 * w92
        D_1 = d1_1 + x_1 * w92
        D_2 = d1_2 + x_2 * w92
        w93 = d1_0 * d1_0 + d1_1 * d1_1 + d1_2 * d1_2
        w94 = quotient(d1_0 * D_0 + d1_1 * D_1 + d1_2 * D_2, w93)
        w95 = 0.25 - 0.1 * Y1_0 * w29 + w38 * w46 - 0.1 * Y1_1 * w32 - 0.5 * Y1_1 * w44
        w96 = 0.1 * Y1_3 * w26 + w95 + 0.5 * Y1_3 * w45
        w97 = (
            -0.5
            - 0.008333333333333333 * Y1_0 * w32
            + w44 * w46
            + 0.008333333333333333 * Y1_1 * w29
            + 0.5 * Y1_1 * w38
        )
        w98 = w97 - 0.008333333333333333 * Y1_2 * w26 - 0.5 * Y1_2 * w45
        w99 = quotient(D_1 * w96 + w48 * D_0 + D_2 * w98, w93)
        f_0 = w48 * w94 - d1_0 * w99
        f_1 = w94 * w96 - d1_1 * w99
        f_2 = w94 * w98 - d1_2 * w99
        change_xi_0 = abs(f_0 - xi_0)
        change_xi_1 = abs(f_1 - xi_1)
        change_xi_2 = abs(f_2 - xi_2)
        change = max(change_xi_0, change_xi_1, change_xi_2)
        scale = max(1.0, abs(xi_0), abs(xi_1), abs(xi_2))
        total = change_xi_0 + change_xi_1 + change_xi_2
        if not isfinite(total):
            raise _failed(NOT_FINITE, "the equations of xi", 0, sweep, statistics)
        still = 0.0 < previous_1 <= change <= 5.684341886080802e-14 * scale
        close = change * change <= 1.1102230246251565e-16 * scale * previous_1
        if still or (close and change <= 3.552713678800501e-15 * scale):
            break
        previous_1 = change
        xi_0 = f_0
        xi_1 = f_1
        xi_2 = f_2
    else:
        raise _failed(NOT_CONVERGED, "the equations of xi", 0, sweep, statistics)
    if statistics is not None:
        statistics.count(0, sweep)
    x1_2_0 = h * f_0
    x1_2_1 = h * f_1
    x1_2_2 = h * f_2
    w100 = x1_2_0 * x1_2_0 + x1_2_1 * x1_2_1 + x1_2_2 * x1_2_2
    c0_3, c1_3 = _stumpff_01(w100)
    w103 = x1_2_0 * c1_3
    w104 = x1_2_1 * c1_3
    w105 = x1_2_2 * c1_3
    new_q0 = q0 * c0_3 - (q1 * w103 + q2 * w104 + q3 * w105)
    new_q1 = q3 * w104 - q2 * w105 + (q0 * w103 + q1 * c0_3)
    new_q2 = q1 * w105 - q3 * w103 + (q0 * w104 + q2 * c0_3)
    new_q3 = q2 * w103 - q1 * w104 + (q0 * w105 + q3 * c0_3)
    return new_q0, new_q1, new_q2, new_q3


def _checked(state, h, statistics):
    """Return the state after one step, which is finite."""
    try:
        new = _advance(state, h, statistics)
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
    made = 0
    try:
        if steps > 0 and not isfinite(h):
            raise StepFailed(BAD_STEP, f"the step size h = {h} is not finite")
        for made in range(steps):
            state = _checked(state, h, statistics)
            if stride > 0 and (made + 1) % stride == 0:
                rows.append(list(state))
    except StepFailed as failure:
        failure.step, failure.state = made, state
        raise
    return rows if stride > 0 else list(state)
