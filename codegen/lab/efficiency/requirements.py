"""Defines the table of recommended methods in the report.

Each column belongs to a requirement on the methods, for example that they are explicit. Each row belongs to
an upper bound of the error.
"""

from __future__ import annotations

from dataclasses import dataclass

from codegen.lab.efficiency.goal import Goal

DECADES = range(2, 13)
"""The exponents k of the errors 10^-k for which the table recommends methods."""

STACK = 4096
"""The largest stack memory of a call, in bytes, that the requirement ``embedded target`` permits."""


@dataclass(frozen=True)
class Requirement:
    """A requirement on a method.

    A method must meet all ``needs`` (:data:`codegen.lab.efficiency.goal.NEEDS`). ``stack`` is the largest
    allowed stack memory of a call in bytes, or None for no limit.
    """

    name: str
    meaning: str
    needs: tuple[str, ...] = ()
    stack: int | None = None

    def goal(self, decade: int) -> Goal:
        """Return a goal: a method that meets this requirement and has an error of at most 10^-``decade``."""
        return Goal(10.0**-decade, self.needs, self.stack)


REQUIREMENTS = (
    Requirement("any emitted method", "no requirement"),
    Requirement("on the manifold", "the state stays on the manifold up to rounding", ("manifold",)),
    Requirement(
        "symplectic", "energy and momenta stay close to their initial values for long times", ("symplectic",)
    ),
    Requirement("explicit", "no equations are solved; each step takes the same time", ("explicit",)),
    Requirement("adaptive", "step sizes are controlled by an error estimate", ("adaptive",)),
    Requirement(
        "embedded target",
        f"explicit, equal steps, at most {STACK} bytes of stack",
        ("explicit", "fixed"),
        STACK,
    ),
)
