"""Free rigid body on the sphere: one step by cg:cg3

method:     family cg, tableau cg3
source:     Crouch and Grossman 1993; Hairer, Lubich and Wanner, Table IV.8.1, left
order:      3, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 1.6e-16
scene:      Free rigid body on the sphere, group SO(3)
state:      [0..2] y: point on which SO(3) acts by rotation
left out:   1 evaluation of the field: equal values are computed once
            6 exponentials: exp(x).y is computed without exp(x)
            arguments for constant parameters: alpha = 0
            the time is not needed: no formula depends on the time
            a solver for implicit equations: all stages are explicit
operations: 84 add, 161 mul, 6 stumpff_12 a step
command:    orderconds emit free_rigid_body --method cg:cg3 --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_cg3

    state = [0.4535961214255773, 0.0, 0.8912073600614354]
    print(free_rigid_body_cg3.run(state, 0.02, 100))
"""

from math import cos, isfinite, sin, sqrt
from operator import index

OK = 0  # success
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
    half = 0.5 * sqrt(z if z <= 16777216.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.00390625:
        return _stumpff_tiny_1(z), _stumpff_tiny_2(z)
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    return _stumpff_12_far(z)


def _loop(state, h, steps, trajectory, stride, completed):
    """The loop over the steps of a run."""
    status = OK
    step = 0
    recording = stride > 0 and trajectory is not None
    row = 0
    if recording:
        trajectory[0][:] = state
    if steps > 0 and not isfinite(h):
        status = BAD_STEP
    m0, m1, m2 = state
    while status == OK and step < steps:
        w1 = -0.12745098039215685 * h * m0
        w2 = 0.2549019607843137 * h * m1
        w3 = -0.38235294117647056 * h * m2
        w4 = w1 * w1 + w2 * w2 + w3 * w3
        c1_1, c2_1 = _stumpff_12(w4)
        w6 = m2 * w2 + m1 * w3
        w8 = m1 * w1 + m0 * w2
        w9 = m0 * w3 - m2 * w1
        w10 = m0 - w6 * c1_1 - (w2 * w8 + w3 * w9) * c2_1
        w11 = -0.375 * h * m0
        w12 = 0.75 * h * m1
        w13 = -1.125 * h * m2
        w14 = w11 * w11 + w12 * w12 + w13 * w13
        c1_2, c2_2 = _stumpff_12(w14)
        w16 = m2 * w12 + m1 * w13
        w18 = m1 * w11 + m0 * w12
        w19 = m0 * w13 - m2 * w11
        w20 = m0 - w16 * c1_2 - (w12 * w18 + w13 * w19) * c2_2
        w21 = 0.3333333333333333 * h * w20
        w22 = (w13 * w16 + w11 * w18) * c2_2 - (m1 + w19 * c1_2)
        w23 = -0.6666666666666666 * h * w22
        w24 = m2 + w18 * c1_2 + (w11 * w19 - w12 * w16) * c2_2
        w25 = h * w24
        w26 = w21 * w21 + w23 * w23 + w25 * w25
        c1_3, c2_3 = _stumpff_12(w26)
        w28 = m2 + w8 * c1_1 + (w1 * w9 - w2 * w6) * c2_1
        w29 = m1 + w9 * c1_1 - (w3 * w6 + w1 * w8) * c2_1
        w30 = w23 * w28 - w25 * w29
        w32 = w21 * w29 - w10 * w23
        w33 = w10 * w25 - w21 * w28
        w34 = w10 + w30 * c1_3 + (w23 * w32 - w25 * w33) * c2_3
        w35 = -0.27546296296296297 * h * m0
        w36 = 0.5509259259259259 * h * m1
        w37 = -0.8263888888888888 * h * m2
        w38 = w35 * w35 + w36 * w36 + w37 * w37
        c1_4, c2_4 = _stumpff_12(w38)
        w40 = m2 * w36 + m1 * w37
        w42 = m1 * w35 + m0 * w36
        w43 = m0 * w37 - m2 * w35
        w44 = m0 - w40 * c1_4 - (w36 * w42 + w37 * w43) * c2_4
        w45 = -0.0787037037037037 * h * w20
        w46 = 0.1574074074074074 * h * w22
        w47 = -0.2361111111111111 * h * w24
        w48 = w45 * w45 + w46 * w46 + w47 * w47
        c1_5, c2_5 = _stumpff_12(w48)
        w50 = m2 + w42 * c1_4 + (w35 * w43 - w36 * w40) * c2_4
        w51 = m1 + w43 * c1_4 - (w37 * w40 + w35 * w42) * c2_4
        w52 = w46 * w50 - w47 * w51
        w54 = w45 * w51 - w44 * w46
        w55 = w44 * w47 - w45 * w50
        w56 = (
            -0.7058823529411765 * h
            * (w44 + w52 * c1_5 + (w46 * w54 - w47 * w55) * c2_5)
        )
        w57 = (
            1.411764705882353 * h * (w51 + w55 * c1_5 + (w47 * w52 - w45 * w54) * c2_5)
        )
        w58 = (
            -2.1176470588235294 * h
            * (w50 + w54 * c1_5 + (w45 * w55 - w46 * w52) * c2_5)
        )
        w59 = w56 * w56 + w57 * w57 + w58 * w58
        c1_6, c2_6 = _stumpff_12(w59)
        w61 = w28 + w32 * c1_3 + (w21 * w33 - w23 * w30) * c2_3
        w62 = w29 + w33 * c1_3 + (w25 * w30 - w21 * w32) * c2_3
        w63 = w57 * w61 + w58 * w62
        w65 = w34 * w57 + w56 * w62
        w66 = w34 * w58 - w56 * w61
        new_m0 = w34 - w63 * c1_6 - (w57 * w65 + w58 * w66) * c2_6
        new_m1 = w62 + w66 * c1_6 - (w58 * w63 + w56 * w65) * c2_6
        new_m2 = w61 + w65 * c1_6 + (w56 * w66 - w57 * w63) * c2_6
        if all(map(isfinite, (new_m0, new_m1, new_m2))):
            m0 = new_m0
            m1 = new_m1
            m2 = new_m2
            step += 1
            if recording and step % stride == 0:
                row += 1
                trajectory[row][:] = m0, m1, m2
        else:
            status = NOT_FINITE
    state[:] = m0, m1, m2
    if completed is not None:
        completed[0] = step
    return status


def _cause(state, h):
    """Find the cause of a failed step. If a step of size zero succeeds, the cause is
    the step size. Otherwise the cause is the state.
    """
    same = [0.0] * 3
    same[:] = state
    status = _loop(same, 0.0 * h, 1, None, 0, None)
    return TOO_FAR if status == OK else NOT_FINITE


def _run(state, h, steps, trajectory, stride, completed):
    status = _loop(state, h, steps, trajectory, stride, completed)
    if status == NOT_FINITE:
        status = _cause(state, h)
    return status


def _numbers(state):
    """Return a state as a list of numbers; raise ValueError if its length is wrong."""
    numbers = list(map(float, state))
    if len(numbers) != 3:
        raise ValueError(f"expected 3 numbers in state, found {len(numbers)}")
    return numbers


_REASONS = {
    NOT_FINITE: "the new state is not finite",
    BAD_STEP: "the step size h = {h} is not finite",
    TOO_FAR: "the step is too long: no finite new state was computed; take a shorter step",
}


def _failure(status, step, state, h):
    """Return the error of a failed step."""
    reason = _REASONS[status]
    reason = reason.format(h=h)
    return StepFailed(status, reason, step, tuple(map(float, state)))


def step(state, h):
    """Return the state after one step of size h as a list; the given state is unchanged.

    If the step fails, StepFailed is raised.
    """
    return run(state, h, 1)


def run(state, h, steps, *, stride=0):
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
    rows = [[0.0] * 3 for _ in range(steps // stride + 1)] if stride > 0 else None
    completed = [0]
    status = _run(state, h, steps, rows, stride, completed)
    if status != OK:
        raise _failure(status, completed[0], state, h)
    return rows if stride > 0 else state
