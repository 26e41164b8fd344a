"""The requirements (columns) and the errors (rows) of a table that recommends methods."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.lab.efficiency.goal import Goal

DECADES = range(2, 13)
"""Methods are recommended for errors of 10^-k, for each k in this range."""

STACK = 4096
"""The largest stack memory of a call, in bytes, that the requirement ``embedded target`` permits."""


@dataclass(frozen=True)
class Requirement:
    """A requirement: its name, its meaning, the needs of its goals, and the largest stack memory."""

    name: str
    meaning: str
    needs: tuple[str, ...] = ()
    stack: int | None = None

    def goal(self, decade: int) -> Goal:
        """Return the goal for the error 10^-decade."""
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
