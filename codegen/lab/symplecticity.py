"""By how much a step on T*G fails to be symplectic: the form (2.26) pulled back along the step.

In right trivialisation the form at (q, mu) is <nu_2, xi_1> - <nu_1, xi_2> - <mu, [xi_1, xi_2]>. The tangent
map is taken by central differences in 60 digits, on the program itself run by the interpreter, so that what
is measured is the method and not the difference quotient.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from codegen.emitter import Compiled
from codegen.ir.domain import PreciseDomain
from codegen.ir.interpret import flatten, interpret
from codegen.lower import problem_for

DIGITS = 60
OFFSET = 15
"""Decimal digits of the offset of a central difference: its error is about the offset squared."""

SWEEPS = 100
"""Sweeps of an implicit block; steps that contract more slowly are too long to be looked at in 60 digits."""

Values = tuple[Any, ...]


def symplectic_defect(compiled: Compiled, state: Sequence[float], h: float, t: float = 0.0) -> float:
    """Return the largest entry of J^T Omega(end) J - Omega(start), relative to that of Omega(start).

    ``state`` is flat: the group element, then the momentum. The scene must be Hamiltonian.
    :class:`NotConverged` where an implicit block takes more than :data:`SWEEPS` sweeps.
    """
    import numpy

    scene = compiled.scene
    domain = PreciseDomain(h, DIGITS)
    group, n = scene.group, scene.group.dim
    number = domain.context.mpf
    q, mu = tuple(map(number, state[: group.size])), tuple(map(number, state[group.size :]))
    epsilon = domain.context.mpf(10) ** -OFFSET

    def step(q: Values, mu: Values) -> tuple[Values, Values]:
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


def _step(compiled: Compiled, domain: PreciseDomain, q: Values, mu: Values, t: Any) -> tuple[Values, Values]:
    view = problem_for(compiled.scene, compiled.method)
    flat, values, start = (*q, *mu), {"t": t}, 0
    for block in view.state:
        values[block.name] = tuple(flat[start : start + len(block.symbols)])
        start += len(block.symbols)
    program = compiled.program
    inputs = {v.name: values[v.name] for v in program.inputs}
    found = interpret(program, view, domain, inputs, limit=SWEEPS, newton=False)
    state = tuple(x for block in view.state for x in flatten(block.kind, found[block.name]))
    return state[: len(q)], state[len(q) :]


def _form(compiled: Compiled, domain: PreciseDomain, mu: Values) -> Any:
    import numpy

    group, n = compiled.scene.group, compiled.scene.group.dim
    basis = [tuple(domain.rational(int(i == j)) for j in range(n)) for i in range(n)]
    bracket = [
        [float(sum(m * x for m, x in zip(mu, group.ad(domain, a, b), strict=True))) for b in basis]
        for a in basis
    ]
    unit, zero = numpy.eye(n), numpy.zeros((n, n))
    return numpy.block([[-numpy.array(bracket), unit], [-unit, zero]])
