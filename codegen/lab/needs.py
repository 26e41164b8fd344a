"""What a user may need of a method beside accuracy, and who then is the fastest.

A recommendation is read off the bench: for each need and each accuracy the contestant that has what is needed
and gets there first. What a method has is derived from its program and its tableau, not declared.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from codegen.artifact import Artifact
from codegen.emitter import Compiled
from codegen.lab.contest import Row
from codegen.lab.ranking import seconds_to
from codegen.lower import lowering

DECADES = (3, 6, 9, 12)
"""Accuracies that are asked about: errors of 10^-decade."""

STACK = 4096
"""Bytes of stack that a small processor grants a call."""

DEFECT = 1e-9
"""Symplectic defects of a step that rounding explains."""


@dataclass(frozen=True)
class Features:
    """What an emitted method has.

    ``on_manifold``: steps are made by the group, so that only rounding leaves it; ``explicit``: it solves no
    equations, so that every step of one size takes the same time; ``stack`` is what a call takes of it at
    most, in bytes, ``lines`` the length of its C.
    """

    label: str
    on_manifold: bool
    symplectic: bool
    explicit: bool
    adaptive: bool
    stack: int
    lines: int


def features(compiled: Compiled, emission: Artifact, label: str = "") -> Features:
    """Return what a method has as emitted to C; ``label`` names the contestant where it is not the method."""
    source = emission.files[f"{emission.manifest['module']}.c"]
    found = re.search(r"stack: +at most (\d+) bytes", source)
    return Features(
        label or compiled.method.label,
        compiled.method.kind.keeps_manifold or compiled.scene.group.abelian,
        is_symplectic(compiled),
        not compiled.kernel.loops,
        compiled.method.adaptive,
        int(found[1]) if found else 0,
        source.count("\n"),
    )


def is_symplectic(compiled: Compiled) -> bool:
    """Whether steps of one size are symplectic maps.

    Variational methods and compositions of exact flows are; methods for fields are where T*G is a vector
    space and their tableau is symplectic. Steps that are chosen by an error estimate spoil what that is good
    for, so such a run is none.
    """
    scene, method = compiled.scene, compiled.method
    if not scene.is_hamiltonian or method.adaptive:
        return False
    return lowering(method.family).symplectic(scene, method)


@dataclass(frozen=True)
class Need:
    """A need: its name, what it means, and who meets it."""

    name: str
    meaning: str
    met: Callable[[Features], bool]


NEEDS = (
    Need("any emitted method", "the fastest of all", lambda f: True),
    Need("on the manifold", "the state stays on it but for rounding", lambda f: f.on_manifold),
    Need("symplectic", "energy and momenta stay near their values for long times", lambda f: f.symplectic),
    Need("explicit", "no equations to solve: each step takes the same time", lambda f: f.explicit),
    Need("adaptive", "steps are chosen by an estimate of the error", lambda f: f.adaptive),
    Need(
        "embedded target",
        f"explicit, in steps of one size, with at most {STACK} bytes of stack",
        lambda f: f.explicit and not f.adaptive and 0 < f.stack <= STACK,
    ),
)


@dataclass(frozen=True)
class Advice:
    """For one need: the fastest contestant and its CPU seconds at each of :data:`DECADES`, or None."""

    need: str
    meaning: str
    best: tuple[tuple[str, float] | None, ...]


def advise(entries: Mapping[str, Sequence[Row]], known: Sequence[Features]) -> tuple[Advice, ...]:
    """Return the advice for every need, and last of all for peers where some ran."""
    ours = [(need, [f.label for f in known if need.met(f) and f.label in entries]) for need in NEEDS]
    found = [Advice(need.name, need.meaning, _best(entries, labels)) for need, labels in ours]
    peers = [label for label, rows in entries.items() if rows and rows[0].target == "peer"]
    if peers:
        found.append(
            Advice("a peer, to compare", "other software on the same equations", _best(entries, peers))
        )
    return tuple(found)


def _best(
    entries: Mapping[str, Sequence[Row]], labels: Sequence[str]
) -> tuple[tuple[str, float] | None, ...]:
    best = []
    for decade in DECADES:
        times = [(seconds_to(entries[label], 10.0**-decade), label) for label in labels]
        reached = sorted((t, label) for t, label in times if t is not None)
        best.append((reached[0][1], reached[0][0]) if reached else None)
    return tuple(best)
