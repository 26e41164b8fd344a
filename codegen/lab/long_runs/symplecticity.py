"""The symplectic defect of a step on T*G, the cotangent bundle of a group G.

The defect measures how much the tangent map of the step changes the canonical symplectic form.

Let q be an element of G, and let mu be its momentum. In right trivialisation, a tangent vector at (q, mu) is
a pair (xi, nu) of an element xi of the Lie algebra and an element nu of the dual of the Lie algebra. For two
pairs (xi_1, nu_1) and (xi_2, nu_2), the symplectic form has the value

    <nu_2, xi_1> - <nu_1, xi_2> - <mu, [xi_1, xi_2]>

The brackets <nu, xi> denote the pairing of the dual with the Lie algebra, and [xi_1, xi_2] is the Lie
bracket. The formula is eq. (2.26) of H. Marthinsen, *Lie group integrators*.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy

from codegen.emitter import Compiled
from codegen.ir.domain import PreciseDomain
from codegen.lab.invariants import FUNCTIONS
from codegen.lab.long_runs.trajectory import Trajectory
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.runner import Emitted
from codegen.lab.stability.extreme_steps import CORRECTIONS, precise_step, solutions
from codegen.lab.straight_line_field import velocity

DIGITS = 40
OFFSET = 10
"""The tangent map is approximated by central differences with the increment 10^-OFFSET."""

SWEEPS = 40
"""The largest number of fixed-point iterations for each system of implicit equations in a step."""

LEFT = 0.5
"""The largest permitted relative deviation of a conserved quantity (:func:`largest_defect`)."""


def largest_defect(compiled: Compiled, runner: Emitted, trajectory: Trajectory, h: float) -> float:
    """Return the largest symplectic defect of at most three steps of size ``h``.

    The trajectory is used only up to the first large deviation of a conserved quantity (:data:`LEFT`). In
    this part, the steps start at the first sample, the middle sample, and the sample with the fastest motion.
    Two of these samples may be the same.
    Raises ArithmeticError or ValueError if a step cannot be computed with 40 digits.
    """
    defects = [
        symplectic_defect(compiled, state, h, t, solutions(runner, state, t, h))
        for t, state in _measured_states(compiled, trajectory)
    ]
    return max(defects)


def _measured_states(compiled: Compiled, trajectory: Trajectory) -> list[tuple[float, list[float]]]:
    """Return the first sample, the middle sample, and the sample with the fastest motion.

    A sample is a pair (time, state) of the trajectory. The motion is fastest at the sample where the time
    derivative of the state has the largest Euclidean norm.

    Samples are used only until the relative deviation of a conserved quantity exceeds :data:`LEFT`.
    """
    valid = 1
    for k in range(1, len(trajectory.states)):
        peaks = (s.peaks[k - 1] / trajectory.scales[name] for name, s in trajectory.series.items())
        if not all(x <= LEFT for x in peaks):
            break
        valid = k + 1
    field = velocity(compiled.scene).python(float, FUNCTIONS)

    def speed(k: int) -> float:
        try:
            return math.hypot(*field(trajectory.states[k], trajectory.times[k]))
        except (ArithmeticError, ValueError):
            return 0.0

    chosen = {0, valid // 2, max(range(valid), key=speed)}
    return [(trajectory.times[k], trajectory.states[k]) for k in sorted(chosen)]


def symplectic_defect(
    compiled: Compiled,
    state: Sequence[float],
    h: float,
    t: float = 0.0,
    near: list[list[float]] | None = None,
) -> float:
    """Return the symplectic defect of a step of size ``h``.

    Let J be the matrix of the tangent map of the step. Let A and B be the matrices of the symplectic form
    before and after the step. The defect is the largest absolute entry of the matrix transpose(J) B J - A,
    divided by the largest absolute entry of A.

    ``state`` contains the coordinates of a group element and of its momentum. The scene must be Hamiltonian.
    If fixed-point iteration fails for an implicit step, Newton's method starts from the approximate solution
    ``near``. Raises ArithmeticError or ValueError if no solution is found.
    """
    scene = compiled.scene
    domain = PreciseDomain(h, DIGITS)
    group, n = scene.group, scene.group.dim
    number = domain.context.mpf
    q, mu = tuple(map(number, state[: group.size])), tuple(map(number, state[group.size :]))
    epsilon = domain.context.mpf(10) ** -OFFSET

    solution: list[list[Scalar]] | None = None

    def step(q: Vector, mu: Vector) -> tuple[Vector, Vector]:
        start = None if solution is None else [list(block) for block in solution]
        return _step(compiled, domain, q, mu, number(t), start)

    try:
        end, momentum = step(q, mu)
    except (ArithmeticError, ValueError):
        if near is None:
            raise
        solution = [list(block) for block in near]
        # This call replaces the entries of ``solution`` by more accurate numbers.
        end, momentum = _step(compiled, domain, q, mu, number(t), solution)
    basis = [tuple(number(int(i == j)) for j in range(n)) for i in range(n)]
    frame = numpy.array([[float(x) for x in group.velocity(domain, e, end)] for e in basis]).T
    columns = []
    for k in range(2 * n):
        ends = []
        for sign in (1, -1):
            moved_q, moved_mu = q, mu
            if k < n:
                turn = group.exp(domain, tuple(sign * epsilon * x for x in basis[k]))
                moved_q = tuple(group.mul(domain, turn, q))
            else:
                moved_mu = tuple(m + sign * epsilon * x for m, x in zip(mu, basis[k - n], strict=True))
            ends.append(step(moved_q, moved_mu))
        dq, dmu = (
            [float((a - b) / (2 * epsilon)) for a, b in zip(x, y, strict=True)]
            for x, y in zip(*ends, strict=True)
        )
        xi = numpy.linalg.lstsq(frame, numpy.array(dq), rcond=None)[0]
        columns.append([*xi, *dmu])
    J = numpy.array(columns).T
    before, after = _form(compiled, domain, mu), _form(compiled, domain, momentum)
    return float(numpy.abs(J.T @ after @ J - before).max() / numpy.abs(before).max())


def _step(
    compiled: Compiled,
    domain: PreciseDomain,
    q: Vector,
    mu: Vector,
    t: Scalar,
    near: list[list[Scalar]] | None,
) -> tuple[Vector, Vector]:
    newton = near is not None
    limit = CORRECTIONS if newton else SWEEPS
    state = precise_step(compiled, (*q, *mu), t, domain.h, near, limit=limit, newton=newton, digits=DIGITS)
    return tuple(state[: len(q)]), tuple(state[len(q) :])


def _form(compiled: Compiled, domain: PreciseDomain, mu: Vector) -> numpy.ndarray:
    group, n = compiled.scene.group, compiled.scene.group.dim
    basis = [tuple(domain.rational(int(i == j)) for j in range(n)) for i in range(n)]
    bracket = [
        [float(sum(m * x for m, x in zip(mu, group.ad(domain, a, b), strict=True))) for b in basis]
        for a in basis
    ]
    unit, zero = numpy.eye(n), numpy.zeros((n, n))
    return numpy.block([[-numpy.array(bracket), unit], [-unit, zero]])
