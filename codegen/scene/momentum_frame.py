"""The frame of the momenta that emitted code accepts and returns."""

from __future__ import annotations

from dataclasses import replace

from codegen.errors import SceneError
from codegen.groups.capabilities import Coadjoint
from codegen.ir.program import BODY, SPACE
from codegen.scene.problem import Problem
from orderconds.errors import UnknownName

FRAMES = (SPACE, BODY)
"""The frames of the momentum: right-trivialised (space) and left-trivialised (body)."""


def with_frame(problem: Problem, frame: str) -> Problem:
    """Return a problem with the momenta of emitted code in a frame: ``space`` or ``body``.

    The momentum in the body is Ad*_q mu, left-trivialised. Step programs compute with mu, whichever frame is
    chosen. :class:`SceneError` is raised for the body frame of a problem without momenta, or on an abelian
    group.
    """
    if frame not in FRAMES:
        raise UnknownName(f"unknown frame {frame}", expected=" or ".join(FRAMES))
    if frame == BODY and (not problem.paired or problem.group.abelian):
        raise SceneError(
            f"{problem.name} has no momentum in the body frame",
            expected="a Hamiltonian scene on a group that is not abelian",
            hint="remove the option --frame",
        )
    return replace(problem, body_group=problem.group.require(Coadjoint) if frame == BODY else None)
