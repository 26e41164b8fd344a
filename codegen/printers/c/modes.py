"""Prints a step of a Fourier spectral method as a C module, with the files PREFIX.h and PREFIX.c.

A third file, PREFIX_fft.c, contains a fast Fourier transform. A user may supply another transform instead.
"""

from __future__ import annotations

from codegen.ir.kernel import Kernel
from codegen.ir.mode_step import BERNOULLI, EXP, PHI, ModeStep, Term
from codegen.ir.precision import DOUBLE
from codegen.printers.c.terms import literal, style
from codegen.printers.c.text import comment
from codegen.printers.c.words import RESERVED
from codegen.printers.interface import Interface
from codegen.printers.mode_formulas import ModeFormulas, identifier
from codegen.printers.mode_header import mode_header
from codegen.printers.recipe import Recipe
from codegen.run.status import MODE_MEANINGS, MODE_STATUSES
from codegen.templates import environment

OWN = RESERVED | frozenset(
    [
        "n",
        "u",
        "h",
        "t",
        "now",
        "steps",
        "tables",
        "table",
        "completed",
        "status",
        "spectrum",
        "result",
        "point",
        "k",
        "z",
        "re",
        "im",
        "modes",
        "mode",
        "wave",
        "width",
        "values",
        "scratch",
        "work",
        "transform",
        "length",
        "points",
        "done",
        "old",
        "sum",
        "imaginary",
        "order",
        "factor",
        "forward",
        "backward",
        "expm1",
        "creal",
        "cimag",
        "CMPLX",
    ]
)
"""Names that parameters of a scene must not have: reserved names of C and names that the module uses."""

POINTS = 128
"""The number of grid points in the usage example."""


def print_modes(kernel: Kernel, interface: Interface, recipe: Recipe) -> dict[str, str]:
    """Return the texts of PREFIX.h, PREFIX.c and PREFIX_fft.c for one step."""
    step = kernel.modes
    assert step is not None
    inner, outer = step.nonlinearity.inner, step.nonlinearity.outer
    # The template has its own variables: f0, f1, ..., value0, value1, ..., array0, ... and term0, ...
    reserved = {*OWN, *(f"f{i}" for i in range(len(step.factors)))}
    reserved |= {f"value{i}" for i in range(max(len(step.evaluations), len(step.tables)) + 1)}
    reserved |= {f"{name}{i}" for name in ("array", "term") for i in range(len(inner) + len(outer))}
    # In the module, ``points`` is the array of grid points (the space coordinate), and ``t`` is the time.
    names = {"t": "t", step.space: "points"}
    for name in (*interface.parameters, *(s for _, s in inner)):
        names.setdefault(name, identifier(name, {*reserved, *names.values()}))
    write = ModeFormulas(step, style(DOUBLE), names, reserved)
    parameters = [names[p] for p in interface.parameters]
    prefix = interface.prefix
    exponential = "cexp" if step.complex else "exp"
    calls = {EXP: exponential, PHI: f"{prefix}phi1", BERNOULLI: f"{prefix}bernoulli"}
    variables = {
        "recipe": [comment(line) for line in mode_header(kernel, recipe, 96)],
        "usage": _usage(interface, recipe),
        "module": interface.module,
        "prefix": prefix,
        "upper": prefix.upper(),
        "step": step,
        "number": "double complex" if step.complex else "double",
        "statuses": [(name, number, MODE_MEANINGS[name]) for name, number in MODE_STATUSES.items()],
        "parameters": parameters,
        "declared": [f"double {p}" for p in parameters],
        "length": write.lines(step.length),
        "symbol": write.lines(step.symbol, **{step.wave: "k"}),
        "initial": write.lines(step.initial),
        "formulas": write.lines(step.nonlinearity.formulas),
        "factors": [write.factor(f, lambda function, w: f"{calls[function]}({w})") for f in step.factors],
        "tables": [write.table(table) for table in step.tables],
        "local": _local(step),
        # ``spare`` decides whether C declares ``spectrum``: an unused variable would cause a warning.
        "spare": bool(inner) or len(outer) > 1,
        "functions": {factor.function for factor in step.factors},
        "inner": [(order, names[s]) for order, s in inner],
        "outer": outer,
        "kept": step.nonlinearity.kept,
        "derivatives": any(outer) or any(order for order, _ in inner),
        "evaluations": [
            (_terms(write, e.point), write.time(i, "now")) for i, e in enumerate(step.evaluations)
        ],
        "result": _terms(write, step.result),
        "time": interface.time,
        # Four spectra contain the old state, the new state, an argument of the nonlinear part N, and a
        # temporary result.
        "spectra": 4 + len(step.evaluations),
        # The number of arrays that contain grid values.
        "arrays": len(inner) + len(outer),
    }
    files = {".h": "modes.h.j2", ".c": "modes.c.j2", "_fft.c": "modes_fft.c.j2"}
    env = environment("c")
    return {
        f"{interface.module}{suffix}": env.get_template(f"module/{template}").render(variables)
        for suffix, template in files.items()
    }


def _local(step: ModeStep) -> set[str]:
    """Return the names of the kernels that depend on the position x or on the wave number."""
    kernels = {
        "symbol": (step.symbol, step.wave),
        "initial": (step.initial, step.space),
        "formulas": (step.nonlinearity.formulas, step.space),
    }
    return {name for name, (kernel, symbol) in kernels.items() if symbol in kernel.scalars}


def _terms(write: ModeFormulas, terms: tuple[Term, ...]) -> list[tuple[str, int | None]]:
    return [(write.spectrum(term), term.table) for term in terms]


def _usage(interface: Interface, recipe: Recipe) -> list[str]:
    """Return the lines of an example program that starts from the initial state of the scene."""
    prefix = interface.prefix

    def number(x: float) -> str:
        return literal(DOUBLE, DOUBLE.round(float(x)))

    # A parameter without a default value is zero in the example.
    given = [number(recipe.defaults.get(p, 0.0)) for p in interface.parameters]
    time = [number(0.0)] if interface.time else []
    run = ["N", "u", *time, str(recipe.steps), *given, "tables", "&transform", "work", "&completed"]
    return [
        f'#include "{interface.module}.h"',
        "#include <stdio.h>",
        "#include <stdlib.h>",
        "",
        f"enum {{ N = {POINTS} }};",
        "",
        "int main(void)",
        "{",
        "    double u[N];",
        # The array sizes are results of functions at run time, so ``malloc`` allocates the arrays.
        f"    double *tables = malloc({prefix}tables(N) * sizeof *tables);",
        f"    double *work = malloc({prefix}workspace(N) * sizeof *work);",
        f"    double *memory = malloc({prefix}fft_memory(N) * sizeof *memory);",
        "    size_t completed = 0;",
        f"    if (!tables || !work || !memory || {prefix}fft_prepare(N, memory)) {{",
        "        return 1;",
        "    }",
        f"    const {prefix}transform transform = {prefix}fft(memory);",
        f"    {prefix}initial({', '.join(['N', 'u', *given])});",
        f"    int status = {prefix}prepare({', '.join(['N', number(recipe.h), *given, 'tables'])});",
        "    if (!status) {",
        f"        status = {prefix}run({', '.join(run)});",
        "    }",
        '    printf("status %d after %zu steps\\n%.17g\\n", status, completed, u[0]);',
        "    free(tables);",
        "    free(work);",
        "    free(memory);",
        "    return status;",
        "}",
    ]


def mode_prototypes(interface: Interface) -> str:
    """Return the declarations of the public functions, for cffi."""
    prefix = interface.prefix
    parameters = "".join(f"double p{i}, " for i in range(len(interface.parameters)))
    # In C a function without parameters is declared with ``void``.
    only = parameters.removesuffix(", ")
    time = "double t, " if interface.time else ""
    return f"""
typedef struct {{
    void (*forward)(size_t n, const double *values, double *spectrum, void *context);
    void (*backward)(size_t n, double *spectrum, double *values, void *context);
    void *context;
}} {prefix}transform;
double {prefix}period({only or "void"});
void {prefix}initial(size_t n, double *u{", " if only else ""}{only});
size_t {prefix}tables(size_t n);
int {prefix}prepare(size_t n, double h, {parameters}double *tables);
size_t {prefix}workspace(size_t n);
int {prefix}run(size_t n, double *u, {time}size_t steps, {parameters}const double *tables,
    const {prefix}transform *transform, double *work, size_t *completed);
size_t {prefix}fft_memory(size_t n);
int {prefix}fft_prepare(size_t n, double *memory);
{prefix}transform {prefix}fft(double *memory);
"""
