"""Free rigid body on the sphere: one step by rkmk:rk4

method:     family rkmk, tableau rk4
source:     Kutta 1901; Hairer, Norsett and Wanner, Solving Ordinary Differential
            Equations I, Table II.1.2; with brackets: Munthe-Kaas 1998
order:      4, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 5.6e-17
scene:      Free rigid body on the sphere, group SO(3)
state:      [0..2] y: point on which SO(3) acts by rotation
left out:   1 action, 1 exponential: coefficients are zero, or terms cancel
            1 evaluation of the field, 1 sum: equal values are computed once
            4 exponentials: exp(x).y is computed without exp(x)
            arguments for constant parameters: alpha = 0
            the time is not needed: no formula depends on the time
            a solver for implicit equations: all stages are explicit
operations: 77 add, 141 mul, 4 stumpff_12 a step
command:    orderconds emit free_rigid_body --method rkmk:rk4 --target python -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_rkmk_rk4

    state = [0.4535961214255773, 0.0, 0.8912073600614354]
    print(free_rigid_body_rkmk_rk4.run(state, 0.02, 100))
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
    half = 0.5 * sqrt(z if z <= 65536.0 else float("nan"))
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
        w1 = -0.5 * h
        w2 = -0.25 * h
        w3 = m0 * w2
        w4 = 0.5 * h
        w5 = m1 * w4
        w6 = -0.75 * h
        w7 = m2 * w6
        w8 = w3 * w3 + w5 * w5 + w7 * w7
        c1_1, c2_1 = _stumpff_12(w8)
        w10 = m2 * w5 + m1 * w7
        w12 = m1 * w3 + m0 * w5
        w13 = m0 * w7 - m2 * w3
        w14 = m0 - w10 * c1_1 - (w5 * w12 + w7 * w13) * c2_1
        w15 = h * m1
        w16 = m2 + w12 * c1_1 + (w3 * w13 - w5 * w10) * c2_1
        w17 = 0.1875 * h * w16
        w18 = -1.5 * h
        w19 = m2 * w18
        w20 = (w7 * w10 + w3 * w12) * c2_1 - (m1 + w13 * c1_1)
        w21 = -0.125 * h * w20
        w22 = w2 * w14 - (w15 * w17 + w19 * w21)
        w23 = 0.0625 * h * w14
        w24 = m0 * w1
        w25 = w19 * w23 - w17 * w24 + w4 * w20
        w26 = w15 * w23 + w21 * w24 + w6 * w16
        w27 = w22 * w22 + w25 * w25 + w26 * w26
        c1_2, c2_2 = _stumpff_12(w27)
        w29 = m2 * w25 - m1 * w26
        w31 = m1 * w22 - m0 * w25
        w32 = m0 * w26 - m2 * w22
        w33 = m0 + w29 * c1_2 + (w25 * w31 - w26 * w32) * c2_2
        w34 = w1 * w33
        w35 = m1 + w32 * c1_2 + (w26 * w29 - w22 * w31) * c2_2
        w36 = h * w35
        w37 = m2 + w31 * c1_2 + (w22 * w32 - w25 * w29) * c2_2
        w38 = w18 * w37
        w39 = w34 * w34 + w36 * w36 + w38 * w38
        c1_3, c2_3 = _stumpff_12(w39)
        w41 = m2 * w36 + m1 * w38
        w43 = m1 * w34 + m0 * w36
        w44 = m0 * w38 - m2 * w34
        w45 = m0 - w41 * c1_3 - (w36 * w43 + w38 * w44) * c2_3
        w46 = 0.16666666666666666 * h
        w47 = 0.3333333333333333 * h
        w48 = m2 + w43 * c1_3 + (w34 * w44 - w36 * w41) * c2_3
        w49 = 0.125 * h * w48
        w50 = (w38 * w41 + w34 * w43) * c2_3 - (m1 + w44 * c1_3)
        w51 = -0.08333333333333333 * h * w50
        w52 = (
            (-0.5 * m0 - 0.5 * w45) * w46 + (-0.5 * w14 - 0.5 * w33) * w47
            - (w15 * w49 + w19 * w51)
        )
        w53 = 0.041666666666666664 * h * w45
        w54 = w19 * w53 - w24 * w49 + (w46 * (w50 - m1) + w47 * (w20 - w35))
        w55 = (
            w24 * w51 + w15 * w53
            + (w46 * (-1.5 * m2 - 1.5 * w48) + w47 * (-1.5 * w16 - 1.5 * w37))
        )
        w56 = w52 * w52 + w54 * w54 + w55 * w55
        c1_4, c2_4 = _stumpff_12(w56)
        w58 = m2 * w54 - m1 * w55
        w60 = m1 * w52 - m0 * w54
        w61 = m0 * w55 - m2 * w52
        new_m0 = m0 + w58 * c1_4 + (w54 * w60 - w55 * w61) * c2_4
        new_m1 = m1 + w61 * c1_4 + (w55 * w58 - w52 * w60) * c2_4
        new_m2 = m2 + w60 * c1_4 + (w52 * w61 - w54 * w58) * c2_4
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
