"""Options for the runs of an emitted module: end time, continuous extension, compensated summation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypedDict

from codegen.argument import count
from codegen.certify import certified_order
from codegen.errors import MethodError
from codegen.ir.kernel import Continuous, Observed
from codegen.kernel.dense_output import continuous
from codegen.lower import lowering, problem_for
from codegen.method import Method
from codegen.scene.problem import Problem
from orderconds.errors import InputError

MOST_EVENTS = 64
"""The largest number of event functions of an emitted module."""


def extension_of(method: Method, scene: Problem) -> Continuous:
    """Return the continuous extension of a method in the form that the printers use.

    The order of the result is the smaller of two orders: the order of the extension on vector spaces, and
    the order of the method on the scene. :class:`MethodError` is raised for a method without an extension.
    """
    from orderconds.checking.continuous import extension_order

    problem = problem_for(scene, method)
    program = None if method.coefficients is None else lowering(method.family).extension(problem, method)
    computed = None if program is None else extension_order(method.tableau)
    if program is None or computed is None or not computed.order or computed.continuous is not True:
        raise MethodError(
            f"{method.label} has no continuous extension",
            where=scene.name,
            expected='the family rk or rkmk(r), and an explicit tableau that has the key "dense"',
            hint="to find an extension, run: orderconds extend TABLEAU; or use --integrate, which "
            "computes the state at each output time by a separate step",
        )
    order = min(computed.order, certified_order(method, scene).order)
    return continuous(program, problem, order)


class RunOptions(TypedDict, total=False):
    """The options ``integrate``, ``events``, ``dense`` and ``compensate`` of :func:`codegen.emit`."""

    integrate: bool
    events: int
    dense: bool
    compensate: bool


@dataclass(frozen=True)
class RunRequest:
    """The values of all options of :class:`RunOptions`, with defaults for the options that are not given."""

    integrate: bool = False
    events: int = 0
    dense: bool = False
    compensate: bool = False

    @property
    def observed(self) -> bool:
        """True if the module contains a function for a run to an end time."""
        return self.integrate or self.events > 0 or self.dense

    @property
    def any(self) -> bool:
        """True if an option differs from its default."""
        return self.observed or self.compensate


def refuse_with_carries(method: Method, options: Mapping[str, bool]) -> None:
    """Raise :class:`MethodError` if one of ``options`` is requested together with compensated summation.

    The caller has already tested that compensated summation is requested. Each key of ``options`` is the name
    of an option that cannot be combined with compensated summation. The value is True if the option is
    requested. The message of the error names ``method``.
    """
    for option, requested in options.items():
        if requested:
            raise MethodError(
                f"--{option} is not available for {method.label} with compensated summation",
                expected="steps of constant size, without a Jacobian and without a continuous extension",
                hint=f"leave out --{option} or --compensate",
            )


def observed_run(method: Method, scene: Problem, degree: int, events: int, dense: bool) -> Observed:
    """Return the description of a run to a given end time.

    ``events`` is the number of event functions. ``degree`` is the degree of the Taylor polynomial of a step,
    or 0 if a step has no Taylor polynomial. MethodError is raised for a Taylor method with step control.
    """
    if count(events, "events") > MOST_EVENTS:
        raise InputError(
            f"{events} event functions are too many", where="events", expected=f"at most {MOST_EVENTS}"
        )
    if degree and method.adaptive:
        raise MethodError(
            f"the Taylor method {method.label} cannot combine step control with a run to a given end time",
            expected="a Taylor method with constant step size, or an embedded method with step control",
            hint="leave out --adaptive, or leave out --integrate, --events and --dense",
        )
    return Observed(events, extension_of(method, scene) if dense else None)
