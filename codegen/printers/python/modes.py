"""Prints a step on Fourier modes as a Python module. The module needs NumPy."""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.ir.mode_step import BERNOULLI, PHI, ModeStep, Term
from codegen.ir.number import Number
from codegen.ir.precision import DOUBLE
from codegen.printers.expression import Style
from codegen.printers.interface import Interface
from codegen.printers.mode_formulas import ModeFormulas, identifier
from codegen.printers.mode_header import mode_header
from codegen.printers.python.words import RESERVED
from codegen.printers.recipe import Recipe
from codegen.run.status import MODE_MEANINGS, MODE_STATUSES
from codegen.templates import environment

NUMPY = {"atan": "arctan", "asin": "arcsin", "acos": "arccos", "atan2": "arctan2", "fabs": "abs"}
"""The NumPy names of functions whose names in C and in NumPy differ."""

_OWN = """
    np prepare run n h t steps tables completed status spectrum result point k z re im period modes mask
    values points derivatives grid period initial
"""

OWN = RESERVED | frozenset(_OWN.split())
"""The reserved names of the emitted module."""


def _constant(value: Number) -> str:
    return DOUBLE.text(DOUBLE.round(value))


STYLE = Style(_constant, lambda name: f"np.{NUMPY.get(name, name)}")


def print_modes(kernel: Kernel, interface: Interface, recipe: Recipe) -> dict[str, str]:
    """Return the emitted Python module, as a map from the name of its file to its text."""
    step = kernel.modes
    assert step is not None
    # The emitted module has the variables f0, f1, ... for factors of the coefficients, and the variables
    # value1, value2, ... for values of the nonlinear part of the equation.
    reserved = {*OWN, *(f"f{i}" for i in range(len(step.factors)))}
    reserved |= {f"value{i + 1}" for i in range(len(step.evaluations))}
    names: dict[str, str] = {"t": "t"}
    # Formulas are evaluated at all grid points (the array ``points``) at once.
    names[step.space] = "points"
    for name in (*interface.parameters, step.space, *(s for _, s in step.nonlinearity.inner)):
        names.setdefault(name, identifier(name, {*reserved, *names.values()}))
    write = ModeFormulas(step, STYLE, names, reserved)
    parameters = [names[p] for p in interface.parameters]
    # A parameter without a default value in ``recipe`` gets the default zero.
    given = [f"{names[p]}={_text(recipe.defaults.get(p, 0.0))}" for p in interface.parameters]
    factors = [write.factor(f, lambda function, w: f"{CALLS[function]}({w})") for f in step.factors]
    variables = {
        # A backslash or triple quotes would damage the docstring of the emitted module.
        "recipe": [
            line.replace("\\", "\\\\").replace('"""', "'''") for line in mode_header(kernel, recipe, 84)
        ],
        "module": interface.module,
        "step": step,
        "statuses": [(name, number, MODE_MEANINGS[name]) for name, number in MODE_STATUSES.items()],
        "parameters": parameters,
        "given": given,
        "length": write.lines(step.length),
        # The Fourier symbol of the linear part is a function of the wave number k.
        "symbol": write.lines(step.symbol, **{step.wave: "k"}),
        "factors": factors,
        "tables": [write.table(table) for table in step.tables],
        "functions": _functions(step),
        "formulas": write.lines(step.nonlinearity.formulas),
        "inner": [(order, names[s]) for order, s in step.nonlinearity.inner],
        # The derivative of order 0 is the function itself, so the order 0 is omitted.
        "orders": sorted({*step.nonlinearity.outer, *(m for m, _ in step.nonlinearity.inner)} - {0}),
        "kept": step.nonlinearity.kept,
        "evaluations": [(_sum(write, e.point), write.time(i, "t")) for i, e in enumerate(step.evaluations)],
        "result": _sum(write, step.result),
        "time": interface.time,
        "h": _text(recipe.h),
        "steps": recipe.steps,
        "initial": write.lines(step.initial),
    }
    text = environment("python").get_template("module/modes.py.j2").render(variables)
    return {f"{interface.module}.py": text}


# The helpers ``_phi1`` and ``_bernoulli`` return the limit 1 at 0, instead of 0/0.
CALLS = {"exp": "np.exp", PHI: "_phi1", BERNOULLI: "_bernoulli"}
"""The Python name of each mathematical function that a step can use."""


def _functions(step: ModeStep) -> set[str]:
    return {factor.function for factor in step.factors}


def _sum(write: ModeFormulas, terms: tuple[Term, ...]) -> str:
    words = []
    for term in terms:
        name = write.spectrum(term)
        words.append(name if term.table is None else f"tables[{term.table}] * {name}")
    # An empty sum is zero.
    return " + ".join(words) or "np.zeros_like(spectrum)"


def _text(x: float) -> str:
    return DOUBLE.text(DOUBLE.round(float(x)))
