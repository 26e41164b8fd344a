"""Run-time inputs: the parameters and signals of a problem that are arguments of emitted code."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from codegen.errors import SceneError
from codegen.ir.number import Number
from codegen.scene.consistency import check_problem
from codegen.scene.problem import Problem
from codegen.scene.site_scene import with_frozen_neighbours


def with_runtime(problem: Problem, names: Sequence[str]) -> Problem:
    """Return a copy of ``problem`` with other values of parameters, or with parameters as run-time inputs.

    An entry ``alpha`` of ``names`` makes the parameter alpha an input. An entry ``alpha=1/2`` sets alpha to
    1/2. With both entries, 1/2 is the default value of the input. If ``names`` sets a value, the initial
    state and the invariants are checked again.

    :class:`SceneError` is raised for an unknown parameter, for two values of one parameter, and for a value
    that is not a number.
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
    if fixed:
        # On a lattice, the formulas of the scene are checked at one site with fixed neighbours.
        check_problem(changed if changed.sites is None else with_frozen_neighbours(changed), {})
    return changed


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
