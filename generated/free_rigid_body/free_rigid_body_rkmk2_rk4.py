"""Free rigid body on the sphere: one step by rkmk(2):rk4

method:     family rkmk(2), tableau rk4
source:     Kutta 1901; Hairer, Norsett and Wanner, Solving Ordinary Differential
            Equations I, Table II.1.2; with brackets: Munthe-Kaas 1998
order:      4, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 5.6e-17
scene:      Free rigid body on the sphere, group SO(3)
state:      [0..2] y: point on which SO(3) acts by rotation
left out:   1 action, 1 evaluation of dexpinv, 1 exponential: coefficients are zero,
            or terms cancel
            1 evaluation of the field: equal values are computed once
            4 exponentials: exp(x).y is computed without exp(x)
            arguments for constant parameters: alpha = 0
            the time is not needed: no formula depends on the time
            a solver for implicit equations: all stages are explicit
operations: 101 add, 164 mul, 4 stumpff_12 a step
command:    orderconds emit free_rigid_body --method 'rkmk(2):rk4' --target python
            -o .
version:    orderconds 0.1.0

Use:

    import free_rigid_body_rkmk2_rk4

    state = [0.4535961214255773, 0.0, 0.8912073600614354]
    print(free_rigid_body_rkmk2_rk4.run(state, 0.02, 100))
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
        k0_0 = -0.5 * m0
        w1 = 0.5 * h
        u2_0 = k0_0 * w1
        w2 = m1 * w1
        k0_2 = -1.5 * m2
        u2_2 = w1 * k0_2
        w3 = u2_0 * u2_0 + w2 * w2 + u2_2 * u2_2
        c1_1, c2_1 = _stumpff_12(w3)
        w5 = m2 * w2 + m1 * u2_2
        w7 = m1 * u2_0 + m0 * w2
        w8 = m0 * u2_2 - m2 * u2_0
        k2_0 = -0.5 * (m0 - w5 * c1_1 - (w2 * w7 + u2_2 * w8) * c2_1)
        k2_2 = -1.5 * (m2 + w7 * c1_1 + (u2_0 * w8 - w2 * w5) * c2_1)
        k2_1 = (u2_2 * w5 + u2_0 * w7) * c2_1 - (m1 + w8 * c1_1)
        w9 = w2 * k2_2 + u2_2 * k2_1
        w10 = u2_0 * k2_1 + w2 * k2_0
        w11 = u2_2 * k2_0 - u2_0 * k2_2
        w2_0 = k2_0 + 0.5 * w9 - 0.08333333333333333 * (w2 * w10 + u2_2 * w11)
        u3_0 = w1 * w2_0
        w2_1 = k2_1 - 0.5 * w11 - 0.08333333333333333 * (u2_2 * w9 + u2_0 * w10)
        u3_1 = w1 * w2_1
        w2_2 = k2_2 - 0.5 * w10 + 0.08333333333333333 * (u2_0 * w11 - w2 * w9)
        u3_2 = w1 * w2_2
        w12 = u3_0 * u3_0 + u3_1 * u3_1 + u3_2 * u3_2
        c1_2, c2_2 = _stumpff_12(w12)
        w14 = m2 * u3_1 - m1 * u3_2
        w16 = m1 * u3_0 - m0 * u3_1
        w17 = m0 * u3_2 - m2 * u3_0
        k3_0 = -0.5 * (m0 + w14 * c1_2 + (u3_1 * w16 - u3_2 * w17) * c2_2)
        k3_2 = -1.5 * (m2 + w16 * c1_2 + (u3_0 * w17 - u3_1 * w14) * c2_2)
        Y3_1 = m1 + w17 * c1_2 + (u3_2 * w14 - u3_0 * w16) * c2_2
        w18 = u3_1 * k3_2 + u3_2 * Y3_1
        w19 = u3_0 * Y3_1 + u3_1 * k3_0
        w20 = u3_2 * k3_0 - u3_0 * k3_2
        w3_0 = k3_0 - 0.5 * w18 - 0.08333333333333333 * (u3_1 * w19 + u3_2 * w20)
        u4_0 = h * w3_0
        w3_1 = -0.5 * w20 - Y3_1 + 0.08333333333333333 * (u3_2 * w18 + u3_0 * w19)
        u4_1 = h * w3_1
        w3_2 = k3_2 + 0.5 * w19 + 0.08333333333333333 * (u3_0 * w20 - u3_1 * w18)
        u4_2 = h * w3_2
        w21 = u4_0 * u4_0 + u4_1 * u4_1 + u4_2 * u4_2
        c1_3, c2_3 = _stumpff_12(w21)
        w23 = m2 * u4_1 - m1 * u4_2
        w25 = m1 * u4_0 - m0 * u4_1
        w26 = m0 * u4_2 - m2 * u4_0
        k4_0 = -0.5 * (m0 + w23 * c1_3 + (u4_1 * w25 - u4_2 * w26) * c2_3)
        k4_2 = -1.5 * (m2 + w25 * c1_3 + (u4_0 * w26 - u4_1 * w23) * c2_3)
        Y4_1 = m1 + w26 * c1_3 + (u4_2 * w23 - u4_0 * w25) * c2_3
        w27 = u4_1 * k4_2 + u4_2 * Y4_1
        w28 = u4_0 * Y4_1 + u4_1 * k4_0
        w29 = u4_2 * k4_0 - u4_0 * k4_2
        w30 = 0.16666666666666666 * h
        w31 = 0.3333333333333333 * h
        u_0 = (
            (k4_0 - 0.5 * w27 - 0.08333333333333333 * (u4_1 * w28 + u4_2 * w29) + k0_0) * w30
            + (w2_0 + w3_0) * w31
        )
        u_1 = (
            w30 * (-0.5 * w29 - Y4_1 + 0.08333333333333333 * (u4_2 * w27 + u4_0 * w28) - m1)
            + w31 * (w2_1 + w3_1)
        )
        u_2 = (
            w30 * (k4_2 + 0.5 * w28 + 0.08333333333333333 * (u4_0 * w29 - u4_1 * w27) + k0_2)
            + w31 * (w2_2 + w3_2)
        )
        w32 = u_0 * u_0 + u_1 * u_1 + u_2 * u_2
        c1_4, c2_4 = _stumpff_12(w32)
        w34 = m2 * u_1 - m1 * u_2
        w36 = m1 * u_0 - m0 * u_1
        w37 = m0 * u_2 - m2 * u_0
        new_m0 = m0 + w34 * c1_4 + (u_1 * w36 - u_2 * w37) * c2_4
        new_m1 = m1 + w37 * c1_4 + (u_2 * w34 - u_0 * w36) * c2_4
        new_m2 = m2 + w36 * c1_4 + (u_0 * w37 - u_1 * w34) * c2_4
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
