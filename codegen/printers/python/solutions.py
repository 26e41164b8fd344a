"""Makes one implicit step with an emitted Python module, and returns the solved unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType
from typing import Protocol


class LoadedModule(Protocol):
    """An integrator that runs an emitted Python module."""

    module: ModuleType

    def run(self, state: list[float], h: float, steps: int, t: float) -> object:
        """Make ``steps`` steps of size ``h``. ArithmeticError is raised if a step fails."""


def solutions(integrator: LoadedModule, state: Sequence[float], t: float, h: float) -> list[list[float]]:
    """Make one step. For each substep, return the list of the solved unknowns.

    The function raises the exceptions of ``integrator.run``.
    """
    module = integrator.module
    # Each substep calls the emitted function ``_remember`` once. The second argument contains the unknowns.
    remember, solved = module._remember, dict[int, list[float]]()

    def observe(memory: object, solution: Sequence[float]) -> None:
        solved[id(memory)] = list(solution)
        remember(memory, solution)

    # The module looks up the global name ``_remember`` at each call. During this step, the name refers to
    # ``observe``.
    vars(module)["_remember"] = observe
    try:
        integrator.run(list(state), h, 1, t)
    finally:
        vars(module)["_remember"] = remember
    # A dictionary keeps the order of insertion, which is the order of the substeps.
    return list(solved.values())
