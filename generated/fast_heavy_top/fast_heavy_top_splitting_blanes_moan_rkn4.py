"""Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010): one step by
splitting:blanes_moan_rkn4

method:     family splitting, tableau blanes_moan_rkn4
source:     Blanes and Moan 2002, Table 3, SRKN_6^b of order four
order:      4, certificate: ball (interval arithmetic proves that a method of this
            order exists, and that its coefficients differ from the decimals of the
            tableau by at most one unit in the last digit)
digits:     with the coefficients rounded to double precision, the residuals of the
            order conditions are at most 5.6e-17
scene:      Fast heavy top with body inertia, T*SO(3) (Brüls and Cardona 2010),
            group SO(3)
flows:      T.mean, rotation about the momentum; T.turn, turn about the axis (0, 1,
            0) fixed in the body; V, kick
state:      [0..8] q: element of SO(3), row by row
            [9..11] mu: right-trivialised momentum in the dual of the Lie algebra of
            SO(3)
left out:   5 flows: two flows of one term of H are joined if they commute with all
            flows between them
            the time is not needed: no formula depends on the time
            a solver for implicit equations: all stages are explicit
operations: 201 add, 335 mul, 6 stumpff_12 a step
            2 add, 4 mul once in each run
            9 add, 21 mul, 1 stumpff_12 once in each run
command:    orderconds emit fast_heavy_top --method splitting:blanes_moan_rkn4
            --target python -o .
version:    orderconds 0.1.0

Use:

    import fast_heavy_top_splitting_blanes_moan_rkn4

    state = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 70.3125, -70.3124296875]
    print(fast_heavy_top_splitting_blanes_moan_rkn4.run(state, 0.02, 100))
"""

from math import cos, isfinite, nan, sin, sqrt
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
    half = 0.5 * sqrt(z if z <= 4398046511104.0 else float("nan"))
    ratio = sin(half) / half
    return ratio * cos(half), 0.5 * (ratio * ratio)


def _stumpff_12(z):
    """Return, for z >= 0 and s = sqrt(z): c_1 = sin(s)/s, c_2 = (1 - cos(s))/s^2."""
    if z <= 0.00390625:
        return _stumpff_tiny_1(z), _stumpff_tiny_2(z)
    if z <= 0.0625:
        return _stumpff_small_1(z), _stumpff_small_2(z)
    return _stumpff_12_far(z)


def _advance(state, h, lead_h):
    """Apply all flows of one step except the deferred flows."""
    try:
        g01 = state[1]
        g02 = state[2]
        g11 = state[4]
        g12 = state[5]
        g21, g22, mu0, mu1, mu2 = state[7:12]
        w1 = 0.016101675138249585 * h
        w2 = mu0 * w1
        w3 = mu1 * w1
        w4 = mu2 * w1
        w5 = w4 * w4
        w6 = w2 * w2 + w3 * w3 + w5
        w8 = g01 * w4 - g21 * w2
        w10 = g21 * w3 - g11 * w4
        w11 = g11 * w2 - g01 * w3
        w13 = 0.03970446215949653 * h
        w14 = 58.31698729048485 * h
        w15 = w13 * w14
        w17 = -58.31698729048485 * h
        w18 = w13 * w17
        w21 = mu2 * w13
        w22 = w21 * w21
        w31 = -0.022985624477233298 * h
        w33 = -5.747135269323566 * h
        w34 = w31 * w33
        w37 = 5.747135269323566 * h
        w38 = w31 * w37
        w41 = mu2 * w31
        w42 = w41 * w41
        w54 = 17.587985149035177 * h
        w55 = w31 * w54
        w58 = -17.587985149035177 * h
        w59 = w31 * w58
        w73 = w13 * w33
        w76 = w13 * w37
        w90 = w1 * w14
        w93 = w1 * w17
        w105 = g12 * w2 - g02 * w3
        w106 = g02 * w4 - g22 * w2
        w107 = g22 * w3 - g12 * w4
        c1_1, c2_1 = _stumpff_12(w6)
        w12 = w4 * w10 - w2 * w11
        w19 = w3 * w11 - w4 * w8
        q1_4 = g11 + w8 * c1_1 + w12 * c2_1
        w16 = w13 * (mu0 - g11 * w14) - w8 * w15 * c1_1 - w12 * w15 * c2_1
        w20 = w13 * (mu1 - g01 * w17) - w10 * w18 * c1_1 - w18 * w19 * c2_1
        w23 = w16 * w16 + w20 * w20 + w22
        q1_1 = g01 + w10 * c1_1 + w19 * c2_1
        q1_7 = g21 + w11 * c1_1 + (w2 * w8 - w3 * w10) * c2_1
        w25 = w21 * q1_1 - w16 * q1_7
        w27 = w20 * q1_7 - q1_4 * w21
        w28 = q1_4 * w16 - w20 * q1_1
        w32 = mu0 - q1_4 * w14
        w36 = mu1 - w17 * q1_1
        q1_8 = g22 + w105 * c1_1 + (w2 * w106 - w3 * w107) * c2_1
        q1_5 = g12 + w106 * c1_1 + (w4 * w107 - w2 * w105) * c2_1
        q1_2 = g02 + w107 * c1_1 + (w3 * w105 - w4 * w106) * c2_1
        w108 = w16 * q1_5 - w20 * q1_2
        w109 = w21 * q1_2 - w16 * q1_8
        w110 = w20 * q1_8 - w21 * q1_5
        c1_2, c2_2 = _stumpff_12(w23)
        w29 = w21 * w27 - w16 * w28
        w39 = w20 * w28 - w21 * w25
        w30 = q1_4 + w25 * c1_2 + w29 * c2_2
        w35 = w31 * (w32 - q1_4 * w33) - w25 * w34 * c1_2 - w29 * w34 * c2_2
        w40 = w31 * (w36 - q1_1 * w37) - w27 * w38 * c1_2 - w38 * w39 * c2_2
        w43 = w35 * w35 + w40 * w40 + w42
        w45 = q1_1 + w27 * c1_2 + w39 * c2_2
        w46 = q1_7 + w28 * c1_2 + (w16 * w25 - w20 * w27) * c2_2
        w47 = w41 * w45 - w35 * w46
        w49 = w40 * w46 - w30 * w41
        w50 = w30 * w35 - w40 * w45
        w53 = w32 - w30 * w33
        w57 = w36 - w37 * w45
        w111 = q1_8 + w108 * c1_2 + (w16 * w109 - w20 * w110) * c2_2
        w112 = q1_5 + w109 * c1_2 + (w21 * w110 - w16 * w108) * c2_2
        w113 = q1_2 + w110 * c1_2 + (w20 * w108 - w21 * w109) * c2_2
        w114 = w35 * w112 - w40 * w113
        w115 = w41 * w113 - w35 * w111
        w116 = w40 * w111 - w41 * w112
        c1_3, c2_3 = _stumpff_12(w43)
        w51 = w41 * w49 - w35 * w50
        w60 = w40 * w50 - w41 * w47
        w52 = w30 + w47 * c1_3 + w51 * c2_3
        w56 = w31 * (w53 - w30 * w54) - w47 * w55 * c1_3 - w51 * w55 * c2_3
        w61 = w31 * (w57 - w45 * w58) - w49 * w59 * c1_3 - w59 * w60 * c2_3
        w62 = w56 * w56 + w61 * w61 + w42
        w64 = w45 + w49 * c1_3 + w60 * c2_3
        w65 = w46 + w50 * c1_3 + (w35 * w47 - w40 * w49) * c2_3
        w66 = w41 * w64 - w56 * w65
        w68 = w61 * w65 - w41 * w52
        w69 = w52 * w56 - w61 * w64
        w72 = w53 - w52 * w54
        w75 = w57 - w58 * w64
        w117 = w111 + w114 * c1_3 + (w35 * w115 - w40 * w116) * c2_3
        w118 = w112 + w115 * c1_3 + (w41 * w116 - w35 * w114) * c2_3
        w119 = w113 + w116 * c1_3 + (w40 * w114 - w41 * w115) * c2_3
        w120 = w56 * w118 - w61 * w119
        w121 = w41 * w119 - w56 * w117
        w122 = w61 * w117 - w41 * w118
        c1_4, c2_4 = _stumpff_12(w62)
        w70 = w41 * w68 - w56 * w69
        w77 = w61 * w69 - w41 * w66
        w71 = w52 + w66 * c1_4 + w70 * c2_4
        w74 = w13 * (w72 - w33 * w52) - w66 * w73 * c1_4 - w70 * w73 * c2_4
        w78 = w13 * (w75 - w37 * w64) - w68 * w76 * c1_4 - w76 * w77 * c2_4
        w79 = w74 * w74 + w78 * w78 + w22
        w81 = w64 + w68 * c1_4 + w77 * c2_4
        w82 = w65 + w69 * c1_4 + (w56 * w66 - w61 * w68) * c2_4
        w83 = w21 * w81 - w74 * w82
        w85 = w78 * w82 - w21 * w71
        w86 = w71 * w74 - w78 * w81
        w89 = w72 - w33 * w71
        w92 = w75 - w37 * w81
        w123 = w117 + w120 * c1_4 + (w56 * w121 - w61 * w122) * c2_4
        w124 = w118 + w121 * c1_4 + (w41 * w122 - w56 * w120) * c2_4
        w125 = w119 + w122 * c1_4 + (w61 * w120 - w41 * w121) * c2_4
        w126 = w74 * w124 - w78 * w125
        w127 = w21 * w125 - w74 * w123
        w128 = w78 * w123 - w21 * w124
        c1_5, c2_5 = _stumpff_12(w79)
        w87 = w21 * w85 - w74 * w86
        w94 = w78 * w86 - w21 * w83
        w88 = w71 + w83 * c1_5 + w87 * c2_5
        w91 = w1 * (w89 - w14 * w71) - w83 * w90 * c1_5 - w87 * w90 * c2_5
        w95 = w1 * (w92 - w17 * w81) - w85 * w93 * c1_5 - w93 * w94 * c2_5
        w96 = w91 * w91 + w95 * w95 + w5
        w98 = w81 + w85 * c1_5 + w94 * c2_5
        w99 = w82 + w86 * c1_5 + (w74 * w83 - w78 * w85) * c2_5
        w100 = w4 * w98 - w91 * w99
        w102 = w95 * w99 - w4 * w88
        w103 = w88 * w91 - w95 * w98
        w129 = w123 + w126 * c1_5 + (w74 * w127 - w78 * w128) * c2_5
        w130 = w124 + w127 * c1_5 + (w21 * w128 - w74 * w126) * c2_5
        w131 = w125 + w128 * c1_5 + (w78 * w126 - w21 * w127) * c2_5
        w132 = w91 * w130 - w95 * w131
        w133 = w4 * w131 - w91 * w129
        w134 = w95 * w129 - w4 * w130
        c1_6, c2_6 = _stumpff_12(w96)
        w104 = w88 + w100 * c1_6 + (w4 * w102 - w91 * w103) * c2_6
        w135 = w129 + w132 * c1_6 + (w91 * w133 - w95 * w134) * c2_6
        w136 = w99 + w103 * c1_6 + (w91 * w100 - w95 * w102) * c2_6
        w137 = w130 + w133 * c1_6 + (w4 * w134 - w91 * w132) * c2_6
        w138 = w98 + w102 * c1_6 + (w95 * w103 - w4 * w100) * c2_6
        w139 = w131 + w134 * c1_6 + (w95 * w132 - w4 * w133) * c2_6
        new_g00 = w104 * w135 - w136 * w137
        new_g10 = w136 * w139 - w135 * w138
        new_g20 = w137 * w138 - w104 * w139
        new_mu0 = w89 - w14 * w88 - 147.15 * lead_h * w104
        new_mu1 = w92 - w17 * w98 + 147.15 * lead_h * w138
        new_mu2 = mu2
        state[:] = (
            new_g00, w138, w139, new_g10, w104, w137, new_g20, w136, w135, new_mu0,
            new_mu1, new_mu2,
        )
    except (ArithmeticError, ValueError):
        state[:] = [nan] * len(state)


def _begin(state, h):
    """Apply the first flow of a step."""
    try:
        g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
        new_g00 = g00
        new_g01 = g01
        new_g02 = g02
        new_g10 = g10
        new_g11 = g11
        new_g12 = g12
        new_g20 = g20
        new_g21 = g21
        new_g22 = g22
        new_mu0 = mu0 - 12.211155404321127 * h * g11
        new_mu1 = mu1 + 12.211155404321127 * h * g01
        new_mu2 = mu2
        state[:] = (
            new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21,
            new_g22, new_mu0, new_mu1, new_mu2,
        )
    except (ArithmeticError, ValueError):
        state[:] = [nan] * len(state)


def _finish(state, elapsed_h):
    """Apply the flows that commute with all other flows."""
    try:
        g00, g01, g02, g10, g11, g12, g20, g21, g22, mu0, mu1, mu2 = state
        w1 = (g01 * mu0 + g11 * mu1 + g21 * mu2) * (2.0676923076923077 * elapsed_h)
        w2 = w1 * w1
        c1_1, c2_1 = _stumpff_12(w2)
        w3 = 1.0 - w1 * c2_1 * w1
        w4 = w1 * c1_1
        new_g00 = g00 * w3 - g02 * w4
        new_g01 = g01
        new_g02 = g00 * w4 + g02 * w3
        new_g10 = g10 * w3 - g12 * w4
        new_g11 = g11
        new_g12 = g10 * w4 + g12 * w3
        new_g20 = g20 * w3 - g22 * w4
        new_g21 = g21
        new_g22 = g20 * w4 + g22 * w3
        new_mu0 = mu0
        new_mu1 = mu1
        new_mu2 = mu2
        state[:] = (
            new_g00, new_g01, new_g02, new_g10, new_g11, new_g12, new_g20, new_g21,
            new_g22, new_mu0, new_mu1, new_mu2,
        )
    except (ArithmeticError, ValueError):
        state[:] = [nan] * len(state)


def _complete_step(state, h):
    """Make one step. Defer no flow to a later step."""
    if not isfinite(h):
        return BAD_STEP
    if not all(map(isfinite, state)):
        return NOT_FINITE
    next = [0.0] * 12
    next[:] = state
    lead = 0.08298440641740487 * h
    _begin(next, h)
    _advance(next, h, lead)
    _finish(next, h)
    if not all(map(isfinite, next)):
        return NOT_FINITE
    state[:] = next
    return OK


def _cause(state, h):
    """Find the cause of a failed step. If a step of size zero succeeds, the cause is
    the step size. Otherwise the cause is the state.
    """
    same = [0.0] * 12
    same[:] = state
    status = _complete_step(same, 0.0 * h)
    return TOO_FAR if status == OK else NOT_FINITE


def _run(state, h, steps, trajectory, stride, completed):
    status = OK
    asked = steps
    if steps > 0 and not isfinite(h):
        status = BAD_STEP
        asked = 0
    if status == OK and steps > 0 and not all(map(isfinite, state)):
        status = NOT_FINITE
        asked = 0
    next = [0.0] * 12
    complete = [0.0] * 12
    careful = False
    step = 0
    while True:
        step = 0
        late = 0
        begun = False
        recording = stride > 0 and trajectory is not None
        row = 0
        if recording:
            trajectory[0][:] = state
        next[:] = state
        complete[:] = state
        good = True
        while good and step < asked:
            shown = recording and (step + 1) % stride == 0
            late += 1
            stop = shown or careful or step + 1 == asked or late == 256
            lead = (0.08298440641740487 if stop else 0.16596881283480974) * h
            if not begun:
                _begin(next, h)
            begun = not stop
            _advance(next, h, lead)
            if stop:
                _finish(next, late * h)
                good = all(map(isfinite, next))
                if good:
                    late = 0
                    complete[:] = next
                    if shown:
                        row += 1
                        trajectory[row][:] = complete
            if good:
                step += 1
        again = not good
        if again:
            if careful:
                status = NOT_FINITE
                asked = step
            careful = True
        if not again:
            break
    state[:] = complete
    if status == NOT_FINITE:
        status = _cause(state, h)
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
    rows = [[0.0] * 12 for _ in range(steps // stride + 1)] if stride > 0 else None
    completed = [0]
    status = _run(state, h, steps, rows, stride, completed)
    if status != OK:
        raise _failure(status, completed[0], state, h)
    return rows if stride > 0 else state
