"""Prints the formulas of a step on Fourier modes as text in a target language."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from codegen.ir.kernel import Kernel
from codegen.ir.mode_step import POWER, STATE, Factor, ModeStep, Table, Term
from codegen.kernel.schedule import Assignment, arrange
from codegen.printers.expression import Style, render


@dataclass(frozen=True)
class Lines:
    """The text of a formula with several outputs.

    ``assignments`` contains the pairs (variable, text of its value) in the order of evaluation. The texts in
    ``outputs`` may contain these variables.
    """

    assignments: tuple[tuple[str, str], ...]
    outputs: tuple[str, ...]


@dataclass(frozen=True)
class ModeFormulas:
    """Writes the formulas of a step on Fourier modes.

    - ``style`` is the notation of constants and function names in the target language.
    - ``names`` maps symbols, such as parameters, to identifiers of the target language.
    - ``reserved`` contains identifiers that are not available for intermediate variables.
    """

    step: ModeStep
    style: Style
    names: Mapping[str, str]
    reserved: Collection[str]

    def lines(self, kernel: Kernel, **more: str) -> Lines:
        """Return the formulas of a kernel as text. ``more`` extends the dictionary ``self.names``."""
        arranged = arrange(kernel)
        names = {**self.names, **more}
        taken = {*self.reserved, *names.values()}
        assignments = []
        for statement in arranged.statements:
            # The formulas call only functions with one result, so each statement assigns one value.
            assert isinstance(statement, Assignment)
            # If the name is reserved or already in use, underscores are appended to it.
            own = identifier(statement.name, taken)
            taken.add(own)
            assignments.append((own, " ".join(render(statement.value, names, self.style))))
            names[statement.name] = own
        # ``names`` now contains all assigned variables.
        outputs = tuple(" ".join(render(x, names, self.style)) for x in arranged.outputs)
        return Lines(tuple(assignments), outputs)

    def factor(self, factor: Factor, call: Callable[[str, str], str]) -> str:
        """Return the text of a factor, for example ``exp(z)``.

        The number z is the step size times an eigenvalue of the linear part of the equation.
        ``call(name, argument)`` returns the text of a function call.
        """
        scale = self.style.constant(factor.scale)
        argument = "z" if factor.scale.is_one else f"{scale} * z"
        # A factor with the name POWER is the number ``scale`` * z itself, so no function is called.
        return argument if factor.function == POWER else call(factor.function, argument)

    def table(self, table: Table) -> str:
        """Return the formula that computes a coefficient of the step for one Fourier mode.

        In the formula, ``f0``, ``f1``, ... are the values of the functions in ``step.factors``.
        """
        number = {factor: f"f{k}" for k, factor in enumerate(self.step.factors)}
        words: list[str] = []
        for monomial, value in table.multiplier.key:
            # A power is written as a product of equal factors.
            factors = [number[f] for f, n in monomial for _ in range(n)]
            text = self.style.constant(value)
            minus, size = text.startswith("-"), text.removeprefix("-")
            # The number 1 is not printed before other factors.
            unit = value.is_one or value.is_minus_one
            shown = " * ".join([*([] if unit and factors else [size]), *factors])
            words.append(
                (f"- {shown}" if words else f"-{shown}") if minus else f"+ {shown}" if words else shown
            )
        inner = " ".join(words)
        # Coefficients of the old state have no factor h.
        if not table.power:
            return inner
        # Values of the nonlinear part are multiplied by h.
        return f"h * ({inner})" if len(words) > 1 else f"h * {inner}"

    def spectrum(self, term: Term) -> str:
        """Return the name of the array to which ``term.source`` refers.

        The array contains the Fourier coefficients of the old state, or of a value of the nonlinear part.
        """
        return "spectrum" if term.source == STATE else f"value{term.source + 1}"

    def time(self, number: int, start: str) -> str:
        """Return the text of the time of ``self.step.evaluations[number]``.

        ``start`` is the text of the time at which the step begins.
        """
        c = self.step.evaluations[number].time
        if c.is_zero:
            return start
        # ``start + h`` is printed instead of ``start + 1 * h``.
        return f"{start} + h" if c.is_one else f"{start} + {self.style.constant(c)} * h"


def identifier(name: str, taken: Collection[str]) -> str:
    """Return ``name``, with underscores appended until the result is not in ``taken``."""
    while name in taken:
        name += "_"
    return name
