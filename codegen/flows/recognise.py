"""Recognition: the exact flows of the parts of a Hamiltonian, found from the formulas of the parts.

Each kind of flow has a function that examines the formula of a part. If the part has a flow of this kind, the
function returns the part with its flow. If the part may have a flow of another kind, the function returns
None. If the function finds that the part has no flow of any kind, it returns a part without a flow. The
attribute ``reason`` of this part says why.

The flow of a potential V(q) is a kick. On T*R^n the flow of a function of the momentum alone is a drift. Some
quadratic functions of q and the momentum have linear flows. On groups other than R^n a quadratic function of
the momentum is split into rotations (:mod:`codegen.flows.top`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from codegen.flows import drift, kick, linear, stated, top
from codegen.flows.part import Formula, Part
from codegen.scene.problem import Problem


def _timed(formula: Formula) -> Part | None:
    """If the part depends on the time, return a :class:`Part` that has no flow. Otherwise return None."""
    return formula.refused("it depends on the momentum and on t") if formula.timed else None


KINDS: Sequence[Callable[[Formula], Part | None]] = (
    stated.recognise,
    kick.recognise,
    _timed,
    drift.recognise,
    linear.recognise,
    top.recognise,
)
"""The functions for the kinds of flow, in the order in which they are called for a part.

The first result other than None is used.
"""


def recognise(problem: Problem) -> tuple[Part, ...]:
    """Return the parts of the Hamiltonian of a problem with their exact flows.

    If no flow of a part is known, the attribute ``reason`` of the part says why.
    """
    return tuple(_part(Formula(problem, name, root)) for name, root in problem.parts.items())


def _part(formula: Formula) -> Part:
    answers = (kind(formula) for kind in KINDS)
    return next((part for part in answers if part is not None), formula.refused("no closed form is known"))
