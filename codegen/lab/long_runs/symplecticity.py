"""The symplectic defect of a step on T*G: how much the tangent map of the step changes the canonical form.

In right trivialisation the form at (q, mu) is <nu_2, xi_1> - <nu_1, xi_2> - <mu, [xi_1, xi_2]> (H.
Marthinsen, *Lie group integrators*, eq. (2.26)). The interpreter computes the tangent map by central
differences in 60 digits. The error of the difference quotients is therefore negligible beside the defect of
the method.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy

from codegen.emitter import Compiled
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.lab.number_types import Scalar, Vector
from codegen.lab.runner import split_state
from codegen.lower import problem_for

DIGITS = 60
OFFSET = 15
"""The offset of a central difference is 10^-OFFSET; the error of the difference is about 10^(-2 OFFSET)."""

SWEEPS = 100
"""Largest number of iterations of an implicit block. Longer steps may converge too slowly for 60 digits."""


def symplectic_defect(compiled: Compiled, state: Sequence[float], h: float, t: float = 0.0) -> float:
    """Return the largest entry of J^T Omega(end) J - Omega(start) divided by the largest entry of
    Omega(start).

    Entries are compared by absolute value.

    ``state`` contains the coordinates of the group element, then the momentum. The scene must be Hamiltonian.
    Raises :class:`NotConverged` if an implicit block takes more than :data:`SWEEPS` iterations.
    """
    scene = compiled.scene
    domain = PreciseDomain(h, DIGITS)
    group, n = scene.group, scene.group.dim
    number = domain.context.mpf
    q, mu = tuple(map(number, state[: group.size])), tuple(map(number, state[group.size :]))
    epsilon = domain.context.mpf(10) ** -OFFSET

    def step(q: Vector, mu: Vector) -> tuple[Vector, Vector]:
        return _step(compiled, domain, q, mu, number(t))

    end, momentum = step(q, mu)
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
    compiled: Compiled, domain: PreciseDomain, q: Vector, mu: Vector, t: Scalar
) -> tuple[Vector, Vector]:
    problem = problem_for(compiled.scene, compiled.method)
    values: dict[str, Scalar] = {"t": t, **split_state(problem, (*q, *mu))}
    program = compiled.program
    inputs = {v.name: values[v.name] for v in program.inputs}
    outputs = interpret(program, problem, domain, inputs, limit=SWEEPS, newton=False)
    state = tuple(x for block in problem.state for x in flatten(block.kind, outputs[block.name]))
    return state[: len(q)], state[len(q) :]


def _form(compiled: Compiled, domain: PreciseDomain, mu: Vector) -> numpy.ndarray:
    group, n = compiled.scene.group, compiled.scene.group.dim
    basis = [tuple(domain.rational(int(i == j)) for j in range(n)) for i in range(n)]
    bracket = [
        [float(sum(m * x for m, x in zip(mu, group.ad(domain, a, b), strict=True))) for b in basis]
        for a in basis
    ]
    unit, zero = numpy.eye(n), numpy.zeros((n, n))
    return numpy.block([[-numpy.array(bracket), unit], [-unit, zero]])
