"""Prints the example program and the cffi declarations of a C module for a lattice."""

from __future__ import annotations

from codegen.ir.precision import DOUBLE
from codegen.printers.c.terms import literal
from codegen.printers.interface import Interface
from codegen.printers.recipe import Recipe

SIDES = {1: 1000, 2: 64, 3: 16}
"""In the usage example, a lattice of dimension n = 1, 2 or 3 has SIDES[n] sites along each axis."""


def lattice_usage(interface: Interface, recipe: Recipe) -> list[str]:
    """Return the lines of an example program. Initially, all sites have the same state."""
    real, prefix, n = interface.format, interface.prefix, interface.dimension
    # printf would convert float to double implicitly, and -Wdouble-promotion would warn.
    wide = "" if real is DOUBLE else "(double)"

    def number(x: float) -> str:
        return literal(real, real.round(float(x)))

    # The lattice has n dimensions and side^n sites.
    side = SIDES.get(n, 8)
    total = side**n
    arguments = ["shape", "state", *([number(0.0)] if interface.time else []), number(recipe.h)]
    arguments += [str(recipe.steps), *(number(recipe.defaults.get(p, 0.0)) for p in interface.parameters)]
    initial = ", ".join(map(number, recipe.initial))
    return [
        f'#include "{interface.module}.h"',
        "#include <stdio.h>",
        "",
        f"enum {{ SITES = {total} }};",
        # The arrays may be large, so they are static and not on the stack.
        f"static {real.c_type} state[{interface.size} * SITES], work[{interface.workspace_of(total)}];",
        "",
        "int main(void)",
        "{",
        f"    const size_t shape[{n}] = {{{', '.join([str(side)] * n)}}};",
        f"    const {real.c_type} first[{interface.size}] = {{{initial}}};",
        f"    for (size_t k = 0; k < {interface.size}; k++) {{",
        "        for (size_t i = 0; i < SITES; i++) {",
        # Row k of the state contains coordinate k of all sites.
        "            state[k * SITES + i] = first[k];",
        "        }",
        "    }",
        "    size_t completed;",
        f"    const int status = {prefix}run({', '.join(arguments)}, work, &completed);",
        '    printf("status %d after %zu steps\\n", status, completed);',
        f"    for (size_t k = 0; k < {interface.size}; k++) {{",
        f'        printf("%.{real.digits}g\\n", {wide}state[k * SITES]);',
        "    }",
        "    return status;",
        "}",
    ]


def lattice_prototypes(interface: Interface) -> str:
    """Return declarations of a lattice module's functions in the form that cffi reads."""
    prefix, real = interface.prefix, interface.format.c_type
    time = f"{real} t, " if interface.time else ""
    # Names of parameters may be keywords of C, so the declarations contain p0, p1, ... instead.
    parameters = "".join(f"{real} p{i}, " for i in range(len(interface.parameters)))
    return (
        f"size_t {prefix}workspace(const size_t *shape);\n"
        f"int {prefix}run(const size_t *shape, {real} *state, {time}{real} h, size_t steps, {parameters}"
        f"{real} *work, size_t *completed);\n"
    )
