"""Peers: integrators that do not belong to this project, for comparison with emitted code.

A peer integrates the differential equation of a scene in the coordinates of the state. The set-up time (the
time before the first step, including compilation) is reported separately.

A peer whose name ends in ``projected`` projects the state onto the manifold after each step. The multistep
method LSODA has no projected peer, because its stored data of earlier steps would not fit the projected
state.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Protocol, cast

from codegen.scene.problem import Problem
from orderconds.errors import InputError, UnknownName


class PeerFailed(ArithmeticError):
    """Raised if a peer does not reach the end of the time span.

    The message contains the reason.
    """


@dataclass(frozen=True)
class Outcome:
    """The result of a run of a peer: the final state, the number of steps, and the number of field
    evaluations.

    If the peer does not count the evaluations, ``evaluations`` is None.
    """

    state: tuple[float, ...]
    steps: int
    evaluations: int | None


class Run(Protocol):
    """The type of a function that runs a peer (an integrator for comparison)."""

    def __call__(self, spans: int = 1, /) -> Outcome:
        """Integrate from t0 to t0 + n T, where n = ``spans``, and [t0, t0 + T] is the scene's time span."""


@dataclass(frozen=True)
class Prepared:
    """A peer (an integrator for comparison), prepared for one scene and for one tolerance or number of steps.

    - ``run``: ``run(n)`` integrates over n times the length of the time span. If the integration ends early,
      ``run`` raises :class:`PeerFailed`.
    - ``idle``: a function whose CPU time is the overhead of a call of ``run``, or None if the overhead is
      negligible.
    """

    run: Run
    idle: Callable[[], object] | None = None


@dataclass(frozen=True)
class Peer:
    """An integrator for comparison: an integrator of other software, or a classical integrator in C.

    - ``controlled``: the quantity that the user chooses, ``"tolerance"`` or ``"steps"`` (number of steps).
    - ``prepare(scene, control)``: prepares the peer with the tolerance or number of steps ``control``.
    - ``version``: the name and version of the software.
    - ``projects``: True if the peer projects the state onto the manifold of the scene after each step.
    """

    name: str
    controlled: str
    prepare: Callable[[Problem, float], Prepared]
    version: str
    projects: bool = False


class PeerModule(Protocol):
    """The interface of the modules in :data:`PEERS`."""

    def peer(self, name: str) -> Peer:
        """Return the peer with the given name."""


PEERS = {
    "scipy-dop853": ("solve_ivp", "scipy"),
    "scipy-dop853-projected": ("solve_ivp", "scipy"),
    "scipy-radau": ("solve_ivp", "scipy"),
    "scipy-radau-projected": ("solve_ivp", "scipy"),
    "scipy-lsoda": ("solve_ivp", "scipy"),
    "heyoka": ("heyoka", "heyoka"),
    "diffrax": ("jax", "diffrax"),
    "c-dop853": ("compiled", ""),
    "c-rk4-projected": ("compiled", ""),
}
"""Maps the name of each peer to the name of its module and the name of its Python package.

If the peer needs no Python package, the name of the package is ''.
"""

TOLERANCES = tuple(10.0**-k for k in range(3, 14))
"""The tolerances (absolute and relative) for runs of peers, from loose to tight."""

GROUPS = {
    "scipy": tuple(n for n in PEERS if n.startswith("scipy")),
    "c": ("c-dop853", "c-rk4-projected"),
    "all": tuple(PEERS),
}
"""Maps the name of each group of peers to the names of the peers in the group."""


def installed(name: str) -> bool:
    """Return True if a peer needs no Python package, or if the package that it needs is installed.

    >>> installed("scipy-dop853")
    True
    """
    package = PEERS[name][1]
    return not package or find_spec(package) is not None


def find(names: Sequence[str]) -> tuple[Peer, ...]:
    """Return the peers with the given names, in the order of :data:`PEERS`.

    The name of a group (see :data:`GROUPS`) selects all installed peers of the group. Raises
    :class:`UnknownName` for an unknown name, and :class:`InputError` for a peer that is not installed.
    """
    chosen: set[str] = set()
    for name in names:
        if name not in PEERS and name not in GROUPS:
            raise UnknownName(f"unknown peer {name!r}", expected=f"one of {', '.join([*GROUPS, *PEERS])}")
        if name in PEERS and not installed(name):
            package = PEERS[name][1]
            raise InputError(
                f"the software of the peer {name} is not installed", hint=f"type: pip install {package}"
            )
        chosen |= {n for n in GROUPS.get(name, (name,)) if installed(n)}
    return tuple(_peer(name) for name in PEERS if name in chosen)


def _peer(name: str) -> Peer:
    module = cast("PeerModule", import_module(f"codegen.lab.peers.{PEERS[name][0]}"))
    return module.peer(name)
