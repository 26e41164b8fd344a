"""Texts that explain the status codes of emitted code, in header comments and in error messages."""

from __future__ import annotations

from dataclasses import dataclass

from codegen.run.language import RAISES_STATUS, Unit, terms
from codegen.run.terms import (
    BAD_EVENT,
    BAD_OPERATOR,
    BAD_SHAPE,
    BAD_STEP,
    BAD_TIMES,
    EVENT,
    LEAST_STEP,
    LIMIT,
    NOT_CONVERGED,
    NOT_FINITE,
    OK,
    SINGULAR,
    STATUSES,
    TOO_FAR,
    TOO_SHORT,
)

MEANINGS = {
    OK: "success",
    NOT_CONVERGED: "an implicit block did not converge",
    NOT_FINITE: "the new state would contain an infinity or a NaN",
    BAD_STEP: "h is infinite or NaN",
    LIMIT: "the end was not reached in the given number of steps",
    TOO_FAR: "the step is too long: no finite new state was computed; a shorter step succeeds",
    SINGULAR: "the matrix of an implicit block is singular",
    TOO_SHORT: "the end was not reached: the step became too small to change t",
    EVENT: "the run ended at an event",
    BAD_TIMES: "an output time is NaN, out of order, or not between t and end",
    LEAST_STEP: "the end was not reached: a step of the least size was rejected",
    BAD_EVENT: "an event function is infinite or NaN",
    BAD_SHAPE: "a dimension has too few sites, or an odd number of sites where a step needs an even number",
    BAD_OPERATOR: "a function of the linear operator h L, such as exp(h L), is infinite or NaN",
}
"""Maps each status to the comment that explains it in the header of emitted code."""

REASONS = {
    # OK and EVENT are missing, because they are no failures.
    NOT_CONVERGED: "{block} did not converge",
    NOT_FINITE: "the new state is not finite",
    BAD_STEP: "the step size h = {h} is not finite",
    LIMIT: "the end time is not reached within the limit of steps",
    TOO_FAR: "the step is too long: no finite new state was computed; take a shorter step",
    SINGULAR: "the matrix of {block} is singular",
    TOO_SHORT: "the end is not reached: the step became too small to change t",
    BAD_TIMES: "the output times are not finite, not in order, or not between t and end",
    LEAST_STEP: "the end is not reached: a step of the least size was rejected",
    BAD_EVENT: "the value of an event function is not finite",
    BAD_SHAPE: "a dimension has too few sites, or an odd number of sites where a step needs an even number",
    BAD_OPERATOR: "a function of the linear operator h L, such as exp(h L), is not finite for h = {h}",
}
"""Maps each status of a failure to the text that explains the failure in error messages.

``{block}`` is replaced by the label of the implicit block that failed, and ``{h}`` by the step size."""

NOT_FINITE_BLOCK = "{block} computed a number that is not finite"
"""The error message for the status NOT_FINITE if an implicit block has failed.

In other cases, the text in REASONS is used."""


@dataclass(frozen=True)
class StatusCode:
    """A status code with its texts for header comments (``meaning``) and error messages (``reason``).

    If the status is no failure, ``reason`` is empty.
    """

    name: str
    number: int
    meaning: str
    reason: str


# All emitted modules use the index in STATUSES as the number of a status.
MODE_STATUSES = {name: STATUSES.index(name) for name in (OK, NOT_FINITE, BAD_STEP, BAD_SHAPE, BAD_OPERATOR)}
"""Maps each status of a step on Fourier modes to its number."""

MODE_MEANINGS = {
    **{name: MEANINGS[name] for name in (OK, NOT_FINITE, BAD_STEP, BAD_OPERATOR)},
    # In a step on Fourier modes, n is the number of points of the grid.
    BAD_SHAPE: "n is zero, odd, or not the number of points for which the tables were prepared",
}
"""Maps each status of a step on Fourier modes to its comment in the header of emitted code."""


def reason(status: str, block: str, h: float) -> str:
    """Return the text that explains a failure in an error message.

    ``block`` is the label of the block of equations that failed, or '' if no block failed.

    >>> reason("SINGULAR", "the equations of x", 0.1)
    'the matrix of the equations of x is singular'
    >>> reason("NOT_FINITE", "", 0.1)
    'the new state is not finite'
    """
    # If a block of equations fails, the step ends before a new state is computed. Therefore the text
    # REASONS[NOT_FINITE], which mentions the new state, would be wrong.
    text = NOT_FINITE_BLOCK if status == NOT_FINITE and block else REASONS[status]
    return text.format(block=block, h=h)


def statuses(unit: Unit) -> tuple[StatusCode, ...]:
    """Return the status codes that the emitted functions can return, in the order of their numbers."""
    # Every function that returns a status can return OK.
    used = {OK}
    for function in unit.functions:
        used |= {term.text for term in terms(function.body) if term.op == "status"}
        # With the guard RAISES_STATUS, a function also returns NOT_FINITE after an arithmetic error.
        if function.guard == RAISES_STATUS:
            used.add(NOT_FINITE)
    return tuple(
        StatusCode(name, k, MEANINGS[name], REASONS.get(name, ""))
        for k, name in enumerate(STATUSES)
        if name in used
    )
