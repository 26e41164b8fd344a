"""The function :func:`recommend` finds the fastest method of the library that reaches a required accuracy.

The user may also require properties of the method, for example symplecticity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from html import escape
from math import inf
from typing import cast

from codegen.artifact import Artifact
from codegen.emitter import emit
from codegen.lab.efficiency import recommend as search
from codegen.lab.efficiency.measured import MOST_SECONDS
from codegen.lab.efficiency.recommend import Recommendation, Request
from codegen.lab.progress import Progress
from codegen.printers import DEFAULT
from orderconds.argument import described, integer, named_as_arguments, real, text, texts
from orderconds.errors import InputError

SECONDS = 50.0
"""The default time limit of a search, in seconds."""


@dataclass(frozen=True)
class AdvisedMethod:
    """A recommended method, whose error is at most the required error.

    - ``form``: the form of the equations (for example, ``quaternion``), as in the option ``--form``.
    - ``adaptive``: True for a method with step-size control, and False for a method with equal steps.
    - ``h``: the step size of a method with equal steps, and otherwise None.
    - ``tolerance``: for a method with step-size control, the number that is both the relative and the
      absolute tolerance. Otherwise the value is None.
    - ``error``: the measured error.
    - ``seconds``: the measured CPU time of a run over the time span.
    - ``command``: the shell command that emits the integrator.
    """

    method: str
    form: str
    adaptive: bool
    h: float | None
    tolerance: float | None
    error: float
    seconds: float | None
    command: str

    def text(self) -> str:
        """Return the name of the method and its step size or tolerance as text."""
        return f"{self.method}, " + (
            f"h = {self.h:.3g}" if self.h is not None else f"rtol = {self.tolerance:.1e}"
        )


@dataclass(frozen=True, repr=False)
class Advice:
    """The result of :func:`recommend`: the fastest methods that reach the required error.

    - ``best``: the fastest method, or None if no method reaches the required error.
    - ``runner_up``: the second fastest method, or None if at most one method reaches the required error.
    - ``search``: all details of the search.

    ``bool(advice)`` is True if ``best`` is not None.
    """

    scene: str
    best: AdvisedMethod | None
    runner_up: AdvisedMethod | None
    search: Recommendation

    def __bool__(self) -> bool:
        return self.best is not None

    def emit(self, target: str = DEFAULT) -> Artifact:
        """Emit the fastest method in the language ``target``, and return the emitted module.

        ValueError is raised if no method reaches the required error.
        """
        if self.best is None:
            raise ValueError("no method reaches the required error")
        best = self.best
        return emit(self.scene, best.method, target, adaptive=best.adaptive, form=best.form)

    def __repr__(self) -> str:
        if self.best is None:
            return f"<no method reaches the required error on {self.scene}>"
        return f"<{self.scene}: {self.best.text()}; error {self.best.error:.1e}>"

    def _repr_html_(self) -> str:
        rows = [("recommended", self.best), ("runner-up", self.runner_up)]
        cells = "".join(
            f"<tr><td>{name}</td><td>{escape(x.text())}</td><td>{x.error:.1e}</td></tr>"
            for name, x in rows
            if x is not None
        )
        return f"<table><tr><th></th><th>method</th><th>error</th></tr>{cells}</table>"


def recommend(
    scene: str,
    error: float,
    *,
    needs: Sequence[str] | str = (),
    stack: int | None = None,
    span: tuple[Fraction | int | str, Fraction | int | str] | None = None,
    budget: float = SECONDS,
    tableaux: Sequence[str] = (),
    progress: Progress = str,
) -> Advice:
    """Search the library for the fastest method whose error at the end of the time span is at most ``error``.

    The command ``orderconds recommend`` has the same arguments. ``needs`` lists the required properties
    of the method (for example, ``"symplectic"``). For a wrong argument, SceneError, UnknownName or
    InputError is raised.
    """
    words = needs.split(",") if isinstance(needs, str) else texts(needs, "needs", "symplectic")
    text(scene, "scene", "a name of the gallery, or a path of a Python file")
    with named_as_arguments():
        request = Request(
            scene,
            real(error, "error", (0, inf)),
            tuple(word.strip() for word in words),
            None if stack is None else integer(stack, "stack", (1, 2**31)),
            None if span is None else _interval(span),
            real(budget, "budget", (0, MOST_SECONDS)),
            texts(tableaux, "tableaux", "rk4"),
        )
        result = search.recommend(request, progress)
    record = result.as_json()
    return Advice(scene, _advised(record["recommended"]), _advised(record["runner_up"]), result)


def _interval(span: object) -> tuple[Fraction, Fraction]:
    """Return ``span`` as a pair of fractions, or raise InputError."""
    try:
        first, last = (Fraction(t) for t in span)  # type: ignore[attr-defined]
    except (TypeError, ValueError, OverflowError, ZeroDivisionError):
        raise InputError(
            described(span), where="span", expected="a pair of rational numbers, such as (0, 1)"
        ) from None
    if first >= last:
        raise InputError(f"({first}, {last})", where="span", expected="a start time less than the end time")
    return first, last


def _advised(record: object) -> AdvisedMethod | None:
    """Return the method that a JSON record describes, or None if the record is None."""
    if record is None:
        return None
    values = cast("dict[str, object]", record)
    return AdvisedMethod(
        method=str(values["method"]),
        form=str(values["form"]),
        adaptive=bool(values["adaptive"]),
        h=cast("float | None", values["h"]),
        tolerance=cast("float | None", values["tolerance"]),
        error=cast("float", values["error"]),
        seconds=cast("float | None", values["seconds"]),
        command=str(values["command"]),
    )
