"""The symplectic defect of a step on T*G, the cotangent bundle of a group G.

The defect measures how much the tangent map of the step changes the canonical symplectic form.

Let q be an element of G, and let mu be its momentum. In right trivialisation, a tangent vector at (q, mu) is
a pair (xi, nu) of an element xi of the Lie algebra and an element nu of the dual of the Lie algebra. For two
pairs (xi_1, nu_1) and (xi_2, nu_2), the symplectic form has the value

    <nu_2, xi_1> - <nu_1, xi_2> - <mu, [xi_1, xi_2]>

The brackets <nu, xi> denote the pairing of the dual with the Lie algebra, and [xi_1, xi_2] is the Lie
bracket. The formula is eq. (2.26) of H. Marthinsen, *Lie group integrators*.

Each direction of the tangent space is measured in a scale of its own (:class:`_Scales`), and the increments
of the finite differences are proportional to these scales. Therefore the defect does not depend on the units
of length, mass and time if all coordinates of a block of the group element have the same unit, and all
coordinates of a block of the momentum have the same unit (:attr:`codegen.groups.base.LieGroup.blocks`). The
blocks of SE(3), for example, are the rotations and the translations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

from codegen.emitter import Compiled
from codegen.ir.domain import PreciseDomain
from codegen.lab.invariants import FUNCTIONS
from codegen.lab.long_runs.trajectory import Trajectory
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.runner import Emitted
from codegen.lab.stability.extreme_steps import CORRECTIONS, precise_step, solutions
from codegen.lab.straight_line_field import velocity

if TYPE_CHECKING:
    import mpmath

DIGITS = 80
OFFSET = 25
"""The tangent map is approximated by central differences. The increment in each direction is 10^-OFFSET times
the scale of this direction.

The third derivative of the step causes a relative error of about 10^(-2 OFFSET) = 10^-50. Rounding causes a
relative error of about 10^(OFFSET - DIGITS) = 10^-55.

The scales are computed from norms of whole vectors, so a component can be much smaller than its scale. If a
component of the momentum is, for example, 10^12 times smaller than its scale, the increment is
10^-OFFSET * 10^12 = 10^-13 times this component, and the relative error is about (10^-13)^2 = 10^-26.
"""

SWEEPS = 80
"""The largest number of fixed-point iterations for each system of implicit equations in a step."""

LEFT = 0.5
"""The largest permitted relative deviation of a conserved quantity (:func:`largest_defect`)."""


def largest_defect(compiled: Compiled, runner: Emitted, trajectory: Trajectory, h: float) -> float:
    """Compute the symplectic defect of each of up to three steps of size ``h``, and return the largest.

    The trajectory is used only up to the first large deviation of a conserved quantity (:data:`LEFT`). In
    this part, the steps start at the first sample, the middle sample, and the sample with the fastest motion.
    Two of these samples may be the same.
    Raises ArithmeticError or ValueError if a step cannot be computed with :data:`DIGITS` digits.
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
    before and after the step. All matrices refer to the scaled basis of :class:`_Scales`, and the forms are
    divided by the scale of the action. The defect is the largest absolute entry of the matrix
    transpose(J) B J - A, divided by the largest absolute entry of A. It is a number without unit.

    ``state`` contains the coordinates of a group element and of its momentum. The scene must be Hamiltonian.
    If fixed-point iteration fails for an implicit step, Newton's method starts from the approximate solution
    ``near``. Raises ArithmeticError or ValueError if no solution is found. Raises ArithmeticError if
    all coordinates of the momentum are zero before and after the step. The same error is raised if all
    coordinates of the group element are zero before and after the step, for example in the group R^n.
    """
    scene = compiled.scene
    domain = PreciseDomain(h, DIGITS)
    group = scene.group
    number = domain.context.mpf
    q, mu = tuple(map(number, state[: group.size])), tuple(map(number, state[group.size :]))
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
    scales = _scales(compiled, domain, (q, end), (mu, momentum))
    J = _tangent_map(compiled, domain, step, (q, mu), end, scales)
    before, after = (_form(compiled, domain, m, scales) for m in (mu, momentum))
    defect = J.T * after * J - before
    return float(max(map(abs, defect)) / max(map(abs, before)))


@dataclass(frozen=True)
class _Scales:
    """The units in which tangent vectors (xi, nu) at a state are measured.

    ``positions`` contains a scale for each coordinate of xi, and ``action`` is the scale of the symplectic
    form. The scale of a coordinate of nu is ``action`` divided by the scale of the same coordinate of xi. If
    the units of the scene change, all scales change with them.
    """

    positions: tuple[Scalar, ...]
    action: Scalar

    @property
    def all(self) -> tuple[Scalar, ...]:
        """The scales of all coordinates of a tangent vector (xi, nu).

        Here xi is an element of the Lie algebra, and nu is an element of the dual space. The scales of the
        coordinates of xi come first.
        """
        return (*self.positions, *(self.action / x for x in self.positions))


def _scales(
    compiled: Compiled, domain: PreciseDomain, elements: Sequence[Vector], momenta: Sequence[Vector]
) -> _Scales:
    """Return the units (scales) in which tangent vectors (xi, nu) are measured at a step.

    Here xi is an element of the Lie algebra, and nu is an element of its dual space.
    ``elements`` contains the coordinates q of the group element before and after the step, and ``momenta``
    contains the momentum mu before and after the step.

    The coordinates are divided into blocks (:attr:`codegen.groups.base.LieGroup.blocks`), because the
    coordinates of different blocks can have different units.

    Let e_k be the basis elements of the Lie algebra, and let v be the derivative of exp(t e_k) q with respect
    to t at t = 0. Let q_b and v_b be block b of q and v, and let m_k be the norm of the block of mu that
    contains coordinate k.

    - The scale of coordinate k of xi is s_k = min_b |q_b|/|v_b|. Blocks with q_b = 0 or v_b = 0 are omitted.
    - If all blocks are omitted for a coordinate k, s_k is ``action``/m_k for m_k > 0, and max_j s_j for
      m_k = 0. Here j runs over the coordinates for which not all blocks are omitted.
    - The scale of coordinate k of nu is ``action``/s_k, where ``action`` = max_j (s_j m_j). If all products
      s_j m_j are zero, ``action`` is max_j s_j times the largest of all m_k.

    The norms |q_b|, |v_b| and m_k are computed before and after the step. For each norm, the larger of the
    two values is used, because q or mu can be zero before or after the step.

    Raises ArithmeticError if q is zero before and after the step, or if mu is zero before and after the step.
    """
    group, context = compiled.scene.group, domain.context
    dims, parts = zip(*group.blocks, strict=True)
    place = [b for b, n in enumerate(dims) for _ in range(n)]
    sizes, momenta_of = _norms(context, elements, parts), _norms(context, momenta, dims)
    if not any(sizes) or not any(momenta_of):
        what = "momentum" if any(sizes) else "position"
        raise ArithmeticError(
            f"the symplectic defect is measured relative to the {what}, "
            "which is zero before and after the step"
        )
    known: dict[int, Scalar] = {}
    for k, e in enumerate(_basis(group.dim, domain)):
        speeds = _norms(context, [group.velocity(domain, e, q) for q in elements], parts)
        quotients = [q / v for q, v in zip(sizes, speeds, strict=True) if q and v]
        if quotients:
            known[k] = min(quotients)
    largest = max(known.values())
    action = max(known[k] * momenta_of[place[k]] for k in known)
    if not action:
        action = largest * max(momenta_of)
    positions = (
        known.get(k) or (action / momenta_of[b] if momenta_of[b] else largest) for k, b in enumerate(place)
    )
    return _Scales(tuple(positions), action)


def _norms(context: mpmath.ctx_mp.MPContext, vectors: Sequence[Vector], sizes: Sequence[int]) -> list[Scalar]:
    """Return for each block of coordinates the largest norm of this block in ``vectors``."""
    ends = list(accumulate(sizes))
    return [max(context.norm(v[end - n : end]) for v in vectors) for n, end in zip(sizes, ends, strict=True)]


def _tangent_map(
    compiled: Compiled,
    domain: PreciseDomain,
    step: Callable[[Vector, Vector], tuple[Vector, Vector]],
    state: tuple[Vector, Vector],
    end: Vector,
    scales: _Scales,
) -> mpmath.matrix:
    """Return the matrix of the tangent map of a step in the scaled basis, by central differences.

    ``state`` is the pair of the group element and the momentum before the step, and ``end`` is the group
    element after the step.
    """
    group, context = compiled.scene.group, domain.context
    basis = _basis(group.dim, domain)
    frame = context.matrix([list(group.velocity(domain, e, end)) for e in basis]).T
    epsilon = context.mpf(10) ** -OFFSET
    q, mu = state
    columns = []
    for k, unit in enumerate(scales.all):
        direction, ends = basis[k % group.dim], []
        for sign in (1, -1):
            move = tuple(sign * epsilon * unit * x for x in direction)
            if k < group.dim:
                ends.append(step(tuple(group.mul(domain, group.exp(domain, move), q)), mu))
            else:
                ends.append(step(q, tuple(m + x for m, x in zip(mu, move, strict=True))))
        dq, dmu = (
            [(a - b) / (2 * epsilon) for a, b in zip(x, y, strict=True)] for x, y in zip(*ends, strict=True)
        )
        # ``frame`` has full rank, so this is the least-squares solution.
        xi = context.lu_solve(frame.T * frame, frame.T * context.matrix(dq))
        columns.append([x / s for x, s in zip([*xi, *dmu], scales.all, strict=True)])
    return context.matrix(columns).T


def _basis(n: int, domain: PreciseDomain) -> list[tuple[Scalar, ...]]:
    return [tuple(domain.rational(int(i == j)) for j in range(n)) for i in range(n)]


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


def _form(compiled: Compiled, domain: PreciseDomain, mu: Vector, scales: _Scales) -> mpmath.matrix:
    """Return the symplectic form at ``mu`` as a matrix in the scaled basis, divided by ``scales.action``."""
    group, context, n = compiled.scene.group, domain.context, compiled.scene.group.dim
    basis, units = _basis(n, domain), scales.positions
    form = context.matrix(2 * n, 2 * n)
    for i, a in enumerate(basis):
        form[i, n + i], form[n + i, i] = context.mpf(1), context.mpf(-1)
        for j, b in enumerate(basis):
            bracket = sum(m * x for m, x in zip(mu, group.ad(domain, a, b), strict=True))
            form[i, j] = -bracket * units[i] * units[j] / scales.action
    return form
