"""Makes one implicit step with an emitted Python module, and returns the values of the unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType
from typing import Protocol


class LoadedModule(Protocol):
    """An object that contains an emitted Python module. The method ``run`` makes steps with this module."""

    module: ModuleType

    def run(self, state: list[float], h: float, steps: int, t: float) -> object:
        """Make ``steps`` steps of size ``h``. If a step fails, the method raises ArithmeticError."""


def solutions(integrator: LoadedModule, state: Sequence[float], t: float, h: float) -> list[list[float]]:
    """Make one step and return the list of the values of the unknowns for each substep.

    The function raises the exceptions of ``integrator.run``.
    """
    module = integrator.module
    # Each substep passes the values of the unknowns to the emitted function ``_remember``, as the second
    # argument.
    remember, solved = module._remember, dict[int, list[float]]()

    def observe(memory: object, solution: Sequence[float]) -> None:
        # Each substep has its own record ``memory``, so ``id(memory)`` distinguishes the substeps.
        solved[id(memory)] = list(solution)
        remember(memory, solution)

    # During this step, ``observe`` replaces ``_remember``, and records the unknowns.
    vars(module)["_remember"] = observe
    try:
        integrator.run(list(state), h, 1, t)
    finally:
        # The module gets the original function ``_remember`` back, even if the step fails.
        vars(module)["_remember"] = remember
    # The unknowns were inserted in the order of the substeps, and a dictionary keeps this order.
    return list(solved.values())
