"""SciPy's solvers DOP853, Radau and LSODA. DOP853 and Radau have variants with projection."""

from __future__ import annotations

import math
from functools import partial

import numpy

from codegen.ir.domain import FloatDomain
from codegen.lab.number_functions import of_scalars
from codegen.lab.peers import Outcome, Peer, PeerFailed, Prepared
from codegen.lab.peers.projection import projection
from codegen.lab.straight_line_field import velocity
from codegen.scene.problem import Problem

FUNCTIONS = of_scalars(math)


def peer(name: str) -> Peer:
    """Return the SciPy solver with a name such as ``scipy-radau``, for comparison.

    If the name ends in ``-projected``, the state is projected onto the manifold of the scene after each step.
    """
    import scipy

    method = {"dop853": "DOP853", "radau": "Radau", "lsoda": "LSODA"}[name.split("-")[1]]
    projects = name.endswith("-projected")
    prepare = partial(_prepare, method, projects)
    return Peer(name, "tolerance", prepare, f"scipy {scipy.__version__}", projects)


def _prepare(method: str, projected: bool, scene: Problem, tolerance: float) -> Prepared:
    import scipy.integrate

    compute = velocity(scene).python(float, FUNCTIONS)
    project = projection(scene) if projected else None
    start = numpy.array(scene.initial(FloatDomain(0.0)))
    first, last = map(float, scene.span)
    least = 100 * numpy.finfo(float).eps
    options = {"rtol": max(tolerance, least), "atol": tolerance}

    def field(t: float, y: numpy.ndarray) -> tuple[float, ...]:
        value: tuple[float, ...] = compute(y.tolist(), t)
        return value

    def run(spans: int = 1) -> Outcome:
        end = first + spans * (last - first)
        try:
            solver = getattr(scipy.integrate, method)(field, first, start.copy(), end, **options)
            steps = 0
            while solver.status == "running":
                message = solver.step()
                steps += 1
                if project is not None and solver.status != "failed":
                    solver.y = numpy.array(project(solver.y.tolist()))
                    if hasattr(solver, "f"):
                        solver.f = numpy.asarray(field(solver.t, solver.y))
        except (ArithmeticError, ValueError) as error:
            raise PeerFailed(f"{method}: {error}") from error
        if solver.status == "failed":
            raise PeerFailed(f"{method}: {message}")
        return Outcome(tuple(solver.y.tolist()), steps, int(solver.nfev))

    return Prepared(run)
