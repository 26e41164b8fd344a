"""Recognition of the exact flow of a part of a Hamiltonian from the formula of the part.

For each kind of flow, a function examines the formula of a part. There are three results:

- If the part has a flow of this kind, the function returns the part with its flow.
- If the part has no flow of this kind, but another kind is possible, the function returns None.
- If no kind of exact flow is possible, the function returns a part without a flow. The attribute ``reason``
  of the part says why it has no flow.

These are the kinds of flow:

- The flow of a potential V(q) is a kick.
- On an abelian group such as R^n, the flow of a function of the momentum is a drift.
- On R^n, the flow of a quadratic function of the position and the momentum is linear
  (:mod:`codegen.flows.linear`).
- On non-abelian groups, a quadratic function of the momentum is split into terms. The flows of the terms are
  rotations (:mod:`codegen.flows.top`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from codegen.flows import drift, kick, linear, stated, top
from codegen.flows.part import Formula, Part
from codegen.scene.problem import Problem


def _timed(formula: Formula) -> Part | None:
    return formula.refused("it depends on the momentum and on t") if formula.timed else None


KINDS: Sequence[Callable[[Formula], Part | None]] = (
    stated.recognise,
    kick.recognise,
    _timed,
    drift.recognise,
    linear.recognise,
    top.recognise,
)
"""The functions that look for the exact flow of a part of a Hamiltonian.

The functions are called in the order of the list until a function returns a :class:`Part`.
"""


def recognise(problem: Problem) -> tuple[Part, ...]:
    """Find the exact flows for the parts of the Hamiltonian of a problem, and return the parts.

    If no exact flow is known for a part, the attribute ``reason`` of the part says why.
    """
    return tuple(_part(Formula(problem, name, root)) for name, root in problem.parts.items())


def _part(formula: Formula) -> Part:
    answers = (kind(formula) for kind in KINDS)
    return next((part for part in answers if part is not None), formula.refused("no closed form is known"))
