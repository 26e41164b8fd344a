"""Run-time inputs: the parameters and signals of a problem that are arguments of emitted code."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.errors import SceneError
from codegen.groups.actions import Stiefel
from codegen.ir.number import Number
from codegen.scene.consistency import check_problem
from codegen.scene.hamiltonian_scene import check_flows
from codegen.scene.hamiltonian_sites import check_parts_of_site
from codegen.scene.problem import Problem
from codegen.scene.semilinear_scene import check_operator
from codegen.scene.site_scene import check_sites, with_frozen_neighbours
from codegen.scene.stiefel_scene import check_tangent


def with_runtime(problem: Problem, names: Sequence[str]) -> Problem:
    """Return a copy of ``problem`` with other values of parameters, or with parameters as run-time inputs.

    An entry ``alpha`` of ``names`` makes the parameter alpha an input. An entry ``alpha=1/2`` sets alpha to
    1/2. With both entries, 1/2 is the default value of the input. The initial state, the invariants, the
    parts and the flows of the scene are then checked again: for the new values, and for further values of the
    inputs (:func:`codegen.scene.orbit.variants`).

    :class:`SceneError` is raised for an unknown parameter, for two values of one parameter, for a value
    that is not a number, and for formulas that contradict each other.
    """
    values = dict(problem.parameters)
    runtime, fixed, folded = set(problem.runtime), dict(problem.fixed), set[str]()
    for request in names:
        name, given, text = request.partition("=")
        if name not in problem.parameters:
            known = ", ".join(sorted(problem.parameters)) or "none"
            raise SceneError(f"unknown parameter {name!r}", where=problem.name, expected=f"one of: {known}")
        if not given:
            runtime.add(name)
            continue
        if name in folded:
            raise SceneError(f"two values of the parameter {name}", where=problem.name, expected="one value")
        try:
            values[name] = Number.read(text)
        except ValueError as error:
            raise SceneError(
                f"the value {text[:40]!r} of the parameter {name}", where=problem.name, expected=str(error)
            ) from None
        folded.add(name)
        fixed[name] = values[name].text()
    changed = replace(
        problem, parameters=values, runtime=tuple(sorted(runtime)), fixed=tuple(sorted(fixed.items()))
    )
    _check(changed)
    return changed


def _check(problem: Problem) -> None:
    """Raise SceneError if formulas of the scene contradict each other for a value of a parameter."""
    # Large matrices and semilinear equations have no formulas in coordinates.
    if problem.roots:
        # On a lattice, the formulas of the scene are checked at one site with fixed neighbours.
        check_problem(problem if problem.sites is None else with_frozen_neighbours(problem), {})
    if problem.semilinear is not None:
        check_operator(problem, problem.semilinear)
    check_flows(problem)
    if problem.sites is not None:
        check_sites(problem)
    if problem.sites is not None and problem.paired:
        check_parts_of_site(problem)
    if isinstance(problem.action, Stiefel) and problem.matrices is not None:
        check_tangent(problem, problem.matrices)


def with_inputs(problem: Problem, names: Sequence[str]) -> Problem:
    """Return a problem whose emitted code reads the signals in ``names`` at run time, in the order of
    ``names``. SceneError is raised for an unknown signal.
    """
    for name in names:
        if name not in problem.signals:
            known = ", ".join(problem.signals)
            expected = f"one of: {known}" if known else "no input, because the scene has no signals"
            raise SceneError(f"unknown signal {name!r}", where=problem.name, expected=expected)
    return replace(problem, inputs=tuple(dict.fromkeys(names)))
