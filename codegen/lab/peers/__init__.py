"""Peers: integrators of other makers, run on a scene's ambient equations beside the emitted ones.

Peers see y' = f(y).y in the coordinates of the state, compiled as well as their makers allow; those called
*projected* are brought back to the manifold after each step (LSODA is not: its steps live on a history). What
they need before the first step (a compilation, a symbolic jet) is their set-up and timed apart, like ours.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from codegen.scene.problem import Problem
from orderconds.errors import InputError, UnknownName


class PeerFailed(ArithmeticError):
    """A peer that stopped before the end of the span, with its own reason."""


@dataclass(frozen=True)
class Outcome:
    """The final state of a run, its steps, and its evaluations of the field where the peer counts them."""

    state: tuple[float, ...]
    steps: int
    evaluations: int | None


@dataclass(frozen=True)
class Prepared:
    """A peer made ready for one scene and one control.

    ``run`` integrates over the span, :class:`PeerFailed` where it does not get to the end; ``idle`` makes the
    same call over no time, and is None where that costs as good as nothing beside a run.
    """

    run: Callable[[], Outcome]
    idle: Callable[[], object] | None = None


@dataclass(frozen=True)
class Peer:
    """A peer by name: ``controlled`` by a tolerance, or by a number of steps.

    ``prepare(scene, control)`` returns a run over the scene's span; ``version`` says of what.
    """

    name: str
    controlled: str
    prepare: Callable[[Problem, float], Prepared]
    version: str


PEERS = {
    "scipy-dop853": ("solve_ivp", "scipy"),
    "scipy-dop853-projected": ("solve_ivp", "scipy"),
    "scipy-radau": ("solve_ivp", "scipy"),
    "scipy-radau-projected": ("solve_ivp", "scipy"),
    "scipy-lsoda": ("solve_ivp", "scipy"),
    "heyoka": ("taylor", "heyoka"),
    "diffrax": ("jax", "diffrax"),
    "c-dop853": ("compiled", ""),
    "c-rk4-projected": ("compiled", ""),
}
"""Name -> (module here that runs it, package that it needs or '')."""

TOLERANCES = tuple(10.0**-k for k in range(3, 14))
"""From loose to tight; the absolute tolerance equals the relative one."""

GROUPS = {
    "scipy": tuple(n for n in PEERS if n.startswith("scipy")),
    "c": ("c-dop853", "c-rk4-projected"),
    "all": tuple(PEERS),
}
"""Names for several peers at once."""


def installed(name: str) -> bool:
    """Say whether the software of a peer is here.

    >>> installed("scipy-dop853")
    True
    """
    package = PEERS[name][1]
    return not package or find_spec(package) is not None


def find(names: Sequence[str]) -> tuple[Peer, ...]:
    """Return the peers of these names, in the order of :data:`PEERS`; groups give what of them is installed.

    :class:`UnknownName` for a name that is none, :class:`InputError` for a named peer that is not installed.
    """
    chosen: set[str] = set()
    for name in names:
        if name not in PEERS and name not in GROUPS:
            raise UnknownName(f"unknown peer {name!r}", expected=f"one of {', '.join([*GROUPS, *PEERS])}")
        if name in PEERS and not installed(name):
            package = PEERS[name][1]
            raise InputError(f"the peer {name} is not installed", hint=f"type: pip install {package}")
        chosen |= {n for n in GROUPS.get(name, (name,)) if installed(n)}
    return tuple(_peer(name) for name in PEERS if name in chosen)


def _peer(name: str) -> Peer:
    module: Any = import_module(f"codegen.lab.peers.{PEERS[name][0]}")
    peer: Peer = module.peer(name)
    return peer
