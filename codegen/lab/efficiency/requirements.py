"""Requirements on a method besides accuracy, and the fastest method that satisfies each requirement.

Recommendations are computed from the rows of a work-precision diagram. For each requirement and accuracy, the
fastest candidate that satisfies the requirement is recommended. The properties of a method are computed from
its program and its tableau.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from codegen.artifact import Artifact
from codegen.emitter import Compiled
from codegen.lab.efficiency.ranking import fastest_form, in_form
from codegen.lab.efficiency.work_precision import Row
from codegen.lower import lowering
from codegen.printers import target as known_target

DECADES = (3, 6, 9, 12)
"""Recommendations are given for errors of 10^-k, for each k in this tuple."""

STACK = 4096
"""The largest stack of a call, in bytes, that the requirement ``embedded target`` permits."""


@dataclass(frozen=True)
class Features:
    """Properties of an emitted method.

    ``on_manifold``: a step acts by group elements, so the state stays on the manifold up to rounding.
    ``explicit``: no equations are solved, so all steps take the same time. ``stack`` is an upper bound of the
    stack of a call in bytes, 0 if it is not known. ``lines`` is the number of lines of the file that contains
    the step.
    """

    label: str
    on_manifold: bool
    symplectic: bool
    explicit: bool
    adaptive: bool
    stack: int
    lines: int


def features(compiled: Compiled, artifact: Artifact, label: str = "") -> Features:
    """Return the properties of a method; ``label`` defaults to the label of the method."""
    target = known_target(artifact.manifest["target"])
    source = artifact.files[target.step_file(artifact.manifest["module"])]
    stack = re.search(target.stack, source) if target.stack else None
    return Features(
        label or compiled.method.label,
        compiled.method.kind.keeps_manifold or compiled.scene.group.abelian,
        is_symplectic(compiled),
        not compiled.kernel.loops,
        compiled.method.adaptive,
        int(stack[1]) if stack else 0,
        source.count("\n"),
    )


def is_symplectic(compiled: Compiled) -> bool:
    """Whether steps of constant size are symplectic maps.

    False for methods with step-size control, because variable steps destroy the long-time behaviour of
    symplectic methods.
    """
    scene, method = compiled.scene, compiled.method
    if not scene.is_hamiltonian or method.adaptive:
        return False
    return lowering(method.family).symplectic(scene, method)


@dataclass(frozen=True)
class Need:
    """A requirement: its name, its meaning, and a function that tests whether a method satisfies it."""

    name: str
    meaning: str
    met: Callable[[Features], bool]


NEEDS = (
    Need("any emitted method", "no requirement", lambda f: True),
    Need("on the manifold", "the state stays on the manifold up to rounding", lambda f: f.on_manifold),
    Need(
        "symplectic",
        "energy and momenta stay close to their initial values for long times",
        lambda f: f.symplectic,
    ),
    Need("explicit", "no equations are solved; each step takes the same time", lambda f: f.explicit),
    Need("adaptive", "step sizes are controlled by an error estimate", lambda f: f.adaptive),
    Need(
        "embedded target",
        f"explicit, equal steps, at most {STACK} bytes of stack",
        lambda f: f.explicit and not f.adaptive and 0 < f.stack <= STACK,
    ),
)


@dataclass(frozen=True)
class Advice:
    """For one requirement, the fastest candidate and its CPU seconds for each of :data:`DECADES`.

    An entry of ``best`` is None if no candidate reaches the accuracy.
    """

    need: str
    meaning: str
    best: tuple[tuple[str, float] | None, ...]


def advise(entries: Mapping[str, Sequence[Row]], known: Sequence[Features]) -> tuple[Advice, ...]:
    """Return the advice for every requirement. If peers were measured, the last entry is for the peers."""
    ours = [(need, [f.label for f in known if need.met(f) and f.label in entries]) for need in NEEDS]
    advice = [Advice(need.name, need.meaning, _best(entries, labels)) for need, labels in ours]
    peers = [label for label, rows in entries.items() if rows and rows[0].target == "peer"]
    if peers:
        advice.append(
            Advice("a peer, for comparison", "other software on the same equations", _best(entries, peers))
        )
    return tuple(advice)


def _best(
    entries: Mapping[str, Sequence[Row]], labels: Sequence[str]
) -> tuple[tuple[str, float] | None, ...]:
    best = []
    for decade in DECADES:
        times = [(fastest_form(entries[label], 10.0**-decade), label) for label in labels]
        reached = sorted((f[0], in_form(label, f[1])) for f, label in times if f is not None)
        best.append((reached[0][1], reached[0][0]) if reached else None)
    return tuple(best)
