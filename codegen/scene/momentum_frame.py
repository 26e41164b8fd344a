"""The frame (space or body) of the momenta in the input and output of emitted code."""

from __future__ import annotations

from dataclasses import replace

from codegen.errors import SceneError
from codegen.groups.capabilities import Coadjoint
from codegen.ir.domain import FloatDomain
from codegen.ir.program import BODY, SPACE
from codegen.scene.problem import Problem
from orderconds.errors import UnknownName

FRAMES = (SPACE, BODY)
"""The frames of the momentum: ``space`` denotes the right-trivialised momentum, and ``body`` denotes the
left-trivialised momentum.
"""


def with_frame(problem: Problem, frame: str) -> Problem:
    """Return the problem with a frame in which emitted code accepts and returns momenta.

    The frame ``space`` means the right-trivialised momentum mu. The frame ``body`` means the left-trivialised
    momentum Ad*_q mu at the configuration q. :class:`SceneError` is raised for ``body`` if the problem is not
    Hamiltonian or the group is abelian.
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


def start_of(scene: Problem) -> tuple[float, ...]:
    """Return the initial state, with the momentum in the frame that emitted code uses."""
    domain = FloatDomain(0.0)
    state = tuple(float(x) for x in scene.initial(domain))
    if scene.body_group is None:
        return state
    q, mu = state[: scene.body_group.size], state[scene.body_group.size :]
    return (*q, *scene.body_group.Adt(domain, q, mu))
