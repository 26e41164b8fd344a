"""Duffing's equation, SL(2) acting linearly: one step by cf:cf4

method:     family cf, tableau cf4
source:     Celledoni, Marthinsen and Owren 2003; H. Marthinsen, On symplectic
            integration in Lie groups and manifolds, PhD thesis, NTNU 2014, Section
            2.2.1
order:      4, certificate: exact (the residuals of all order conditions up to this
            order are zero in exact arithmetic)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 2.8e-17
scene:      Duffing's equation, SL(2) acting linearly, group SL(2)
state:      [0..1] y: point on which SL(2) acts by linear maps
left out:   1 evaluation of the field: equal values are computed once
            5 exponentials: exp(x).y is computed without exp(x)
            the time is not needed: no formula depends on the time
            a solver for implicit equations: all stages are explicit
operations: 23 add, 48 mul, 5 signed_stumpff0, 5 signed_stumpff1 a step
command:    orderconds emit duffing_sl2 --method cf4 --target python -o .
version:    orderconds 0.1.0

Use:

    import duffing_sl2_cf4

    state = [0.75, 0.75]
    print(duffing_sl2_cf4.run(state, 0.02, 100))
"""

from math import cos, cosh, isfinite, sin, sinh, sqrt
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


def _stumpff_tiny_1(z):
    """Return c_1(z) for z <= 1/256."""
    w = z * z
    return (
        (1.0 + z * -0.16666666666663651)
        + w * (0.00833333328651266 + z * -0.00019839202108242344)
    )


def _stumpff_tiny_0(z):
    """Return c_0(z) for z <= 1/256."""
    w = z * z
    return (
        (1.0 + z * -0.5)
        + w * (0.04166666666665553 + z * -0.001388888880278194)
        + w * w * 2.479896366618844e-05
    )


def _stumpff_small_1(z):
    """Return c_1(z) for z <= 1/16."""
    w = z * z
    return (
        (1.0 + z * -0.16666666666666666)
        + w * (0.008333333333332476 + z * -0.0001984126983495962)
        + w * w * (2.755729894303353e-06 + z * -2.5022519568470477e-08)
    )


def _stumpff_small_0(z):
    """Return c_0(z) for z <= 1/16."""
    w = z * z
    return (
        (1.0 + z * -0.49999999999999994)
        + w * (0.04166666666665553 + z * -0.0013888888880685601)
        + w * w * (2.480156093634923e-05 + z * -2.7518853761923276e-07)
    )


def _stumpff_series_1(z):
    """Return c_1(z) = sum_j (-z)^j/(2j+1)!, truncated, for z <= 1."""
    w = z * z
    w2 = w * w
    even = -2.505210838544172e-08 + w * -7.647163731819816e-13
    even = -0.16666666666666666 + w * -0.0001984126984126984 + w2 * even
    odd = 1.6059043836821613e-10 + w * 2.8114572543455206e-15
    odd = 0.008333333333333333 + w * 2.7557319223985893e-06 + w2 * odd
    return 1.0 + z * (even + z * odd)


def _stumpff_series_0(z):
    """Return c_0(z) = sum_j (-z)^j/(2j+0)!, truncated, for z <= 1."""
    w = z * z
    w2 = w * w
    even = -1.5619206968586225e-16
    even = -2.755731922398589e-07 + w * -1.1470745597729725e-11 + w2 * even
    even = -0.5 + w * -0.001388888888888889 + w2 * even
    odd = 2.08767569878681e-09 + w * 4.779477332387385e-14
    odd = 0.041666666666666664 + w * 2.48015873015873e-05 + w2 * odd
    return 1.0 + z * (even + z * odd)


def _stumpff_1_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 1.0:
        return _stumpff_series_1(z)
    # NaN if the angle is too large for an accurate result
    s = sqrt(z if z <= 65536.0 else float("nan"))
    return sin(s) / s


def _stumpff_1(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s."""
    if z <= 0.00390625:
        return _stumpff_tiny_1(z)
    if z <= 0.0625:
        return _stumpff_small_1(z)
    return _stumpff_1_far(z)


def _stumpff_0_far(z):
    """Return, for z > 1/16 and s = sqrt(z): c_0 = cos(s)."""
    if z <= 1.0:
        return _stumpff_series_0(z)
    # NaN if the angle is too large for an accurate result
    s = sqrt(z if z <= 65536.0 else float("nan"))
    return cos(s)


def _stumpff_0(z):
    """Return, for z >= 0 and s = sqrt(z): c_0 = cos(s)."""
    if z <= 0.00390625:
        return _stumpff_tiny_0(z)
    if z <= 0.0625:
        return _stumpff_small_0(z)
    return _stumpff_0_far(z)


def signed_stumpff1(z):
    """Return c_1: sin(s)/s with s = sqrt(z) for z >= 0, sinh(r)/r with r = sqrt(-z) for z < 0."""
    if z >= 0.0:
        return _stumpff_1(z)
    r = sqrt(-z)
    try:
        return sinh(r) / r
    except OverflowError:
        return float("inf")


def signed_stumpff0(z):
    """Return c_0: cos(s) with s = sqrt(z) for z >= 0, cosh(r) with r = sqrt(-z) for z < 0."""
    if z >= 0.0:
        return _stumpff_0(z)
    r = sqrt(-z)
    try:
        return cosh(r)
    except OverflowError:
        return float("inf")


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
    z0 = state[0]
    z1 = state[1]
    while status == OK and step < steps:
        w1 = 0.25 * h
        w2 = 0.3333333333333333 * h
        w3 = -0.08333333333333333 * h
        x_0 = w1 + w2 + w3
        k0_1 = -1.0 - z0 * z0
        x2_0 = 0.5 * h
        w4 = x2_0 * x2_0
        w5 = -k0_1 * w4
        w6 = signed_stumpff0(w5)
        w7 = signed_stumpff1(w5)
        w8 = z0 * w6 + x2_0 * w7 * z1
        w9 = -1.0 - w8 * w8
        w10 = -w4 * w9
        p_1 = z0 * signed_stumpff0(w10) + x2_0 * signed_stumpff1(w10) * z1
        w11 = -1.0 - p_1 * p_1
        w12 = 0.16666666666666666 * h * (w9 + w11)
        w13 = -0.5 * h
        x4_0 = h + w13
        w14 = -x4_0 * (k0_1 * w13 + h * w11)
        w15 = (
            w8 * signed_stumpff0(w14)
            + x4_0 * signed_stumpff1(w14) * (z1 * w6 + k0_1 * x2_0 * w7 * z0)
        )
        w16 = -1.0 - w15 * w15
        w17 = w12 + w1 * k0_1 + w3 * w16
        w18 = -x_0 * w17
        w19 = signed_stumpff0(w18)
        w20 = signed_stumpff1(w18)
        w21 = z0 * w19 + x_0 * w20 * z1
        x_2_0 = w2 + w3 + w1
        w22 = w12 + w3 * k0_1 + w1 * w16
        w23 = -x_2_0 * w22
        w24 = signed_stumpff0(w23)
        w25 = w17 * w20 * z0 + z1 * w19
        w26 = signed_stumpff1(w23)
        new_z0 = w21 * w24 + x_2_0 * w26 * w25
        new_z1 = w22 * w26 * w21 + w24 * w25
        if all(map(isfinite, (new_z0, new_z1))):
            z0 = new_z0
            z1 = new_z1
            step += 1
            if recording and step % stride == 0:
                row += 1
                trajectory[row][0] = z0
                trajectory[row][1] = z1
        else:
            status = NOT_FINITE
    state[0] = z0
    state[1] = z1
    if completed is not None:
        completed[0] = step
    return status


def _cause(state, h):
    """Find the cause of a failed step. If a step of size zero succeeds, the cause is
    the step size. Otherwise the cause is the state.
    """
    same = [0.0] * 2
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
    if len(numbers) != 2:
        raise ValueError(f"expected 2 numbers in state, found {len(numbers)}")
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
    rows = [[0.0] * 2 for _ in range(steps // stride + 1)] if stride > 0 else None
    completed = [0]
    status = _run(state, h, steps, rows, stride, completed)
    if status != OK:
        raise _failure(status, completed[0], state, h)
    return rows if stride > 0 else state
