"""Prints one step as a C module. PREFIX.h declares types and functions. PREFIX.c defines the functions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from codegen.errors import SceneError
from codegen.ir.angle_depth import chain
from codegen.ir.kernel import NEWTON, SIMPLIFIED_NEWTON, Kernel
from codegen.ir.precision import DOUBLE
from codegen.ir.table import PiecewisePolynomial
from codegen.kernel.operations import costs
from codegen.printers.c.functions import FunctionPrinter
from codegen.printers.c.lattice import lattice_usage
from codegen.printers.c.modes import print_modes
from codegen.printers.c.terms import literal
from codegen.printers.c.text import comment
from codegen.printers.c.words import RESERVED
from codegen.printers.interface import Interface
from codegen.printers.needs import functions_of
from codegen.printers.recipe import IN_MANIFEST, Recipe, entries_set, header
from codegen.printers.state_fields import layout, times
from codegen.run.batch import BATCH, LANES, called_by, complete, near
from codegen.run.identifiers import identify
from codegen.run.language import LANGUAGE, Unit, terms
from codegen.run.numbers import numbers_held
from codegen.run.observation import PARTS
from codegen.run.plan import Plan
from codegen.run.status import statuses
from codegen.run.sweeps import WIDE
from codegen.run.terms import STATUSES
from codegen.run.trajectory import is_looped
from codegen.run.unit import unit_of
from codegen.snippets.graph import LIBRARY, needed, snippets
from codegen.templates import environment

# Without -ffp-contract=off, results would depend on whether the machine has fused multiply-adds.
FLAGS = ("-std=c11", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-ffp-contract=off")
"""Emitted C compiles without a warning under these flags."""

# On x86-64 without AVX-512, gcc 12 needs -fno-trapping-math to vectorise ``a ? b : c``.
VECTOR_FLAGS = ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math")
"""Flags for modules with loops over lattice sites, Fourier modes, or the systems of a batch.

These flags are added to :data:`FLAGS` and do not change the results.
"""

FRAMES = 640
"""The assumed stack memory of return addresses, saved registers and calls of helper functions, in bytes."""

EACH, EACH_SOLVING = 8, 10
"""The assumed stack memory of one number (a variable or an array entry), in bytes.

``EACH`` is for explicit steps, and ``EACH_SOLVING`` is for steps that solve equations. In measurements, steps
that solve equations needed at most 8.8 bytes per number in double precision, and at most 8.0 bytes in single
precision.

Single precision has the same constants, because a compiler may use 8 bytes for a float.
"""

LARGEST_STACK = 6 * 2**20
"""The largest permitted stack bound (:func:`stack`), in bytes. Most systems limit the stack to 8 MiB."""

MEASURED = "gcc 12 and clang 14 at -O0 to -O3 on x86-64"
"""The compilers and flags in the tests of the stack bound."""


def print_module(kernel: Kernel, interface: Interface, recipe: Recipe) -> dict[str, str]:
    """Return the texts of PREFIX.h and PREFIX.c for one step."""
    if kernel.modes is not None:
        return print_modes(kernel, interface, recipe)
    plan = Plan(kernel, interface.format)
    unit = unit_of(plan)
    identifiers = identify(unit, RESERVED | own_names(interface, unit))
    printer = FunctionPrinter(unit, identifiers, interface.format, interface.prefix)
    snippets = needed(
        "c",
        helpers(unit),
        interface.format,
        # Stumpff functions are inline in implicit steps, because solvers call them often.
        sweeps=bool(interface.blocks),
        wide=inverted(kernel),
        # ``widest`` is the size of the largest matrix that a step inverts.
        widest=max(inverted_sizes(kernel), default=0),
        chain=chain(kernel),
        prefix=interface.prefix,
        batch=interface.batch or bool(interface.dimension),
    )
    public = {f.name: f for f in unit.functions if f.public}
    # Lines of the header comment have at most 96 characters.
    comments = header(recipe, layout(kernel), costs(kernel), 96, stack(unit, plan, interface), times(kernel))
    variables: dict[str, object] = {
        # A title or a name from the user may contain ``*/``, which would end the C comment. Therefore the
        # function ``comment`` replaces ``*/`` by ``* /``.
        "recipe": [comment(line) for line in comments],
        "usage": example(interface, recipe),
        "module": interface.module,
        "prefix": interface.prefix,
        "upper": interface.prefix.upper(),
        "size": interface.size,
        "real": interface.format.c_type,
        "time": interface.time,
        "blocks": interface.blocks,
        "inputs": interface.inputs,
        "parameters": interface.parameters,
        "statuses": statuses(unit),
        "adaptive": interface.adaptive,
        "batch": interface.batch,
        # ``LANES`` is the name of the function that advances many systems in one vectorised loop. Some batch
        # modules do not contain this function.
        "vectorised": LANES in unit.parts or bool(interface.dimension),
        "optimised": " ".join(VECTOR_FLAGS) if interface.batch or interface.dimension else "-O2",
        "dimension": interface.dimension,
        "workspace": interface.workspace,
        "variations": interface.variations,
        "integrated": interface.integrated,
        "controlled": interface.controlled,
        "events": interface.events,
        "compared": PARTS,
        "dense": interface.dense,
        "variation": kernel.vary.state[-1].meaning if kernel.vary is not None else "",
        "statistics": ["", *printer.record("statistics")] if interface.blocks else [],
        # ``head`` prints the prototypes and the first lines of the definitions, so they agree.
        "heads": {name: printer.head(function, header=True) for name, function in public.items()},
        "parts": [*([text] for text in snippets.texts), *_definitions(unit, printer, interface)],
    }
    return _rendered(interface, variables)


def _rendered(interface: Interface, variables: Mapping[str, object]) -> dict[str, str]:
    """Return the texts of PREFIX.h and PREFIX.c."""
    env = environment("c")
    # The functions of a lattice module have special parameters, such as ``shape``.
    head = "lattice.h.j2" if interface.dimension else "module.h.j2"
    return {
        f"{interface.module}.{kind}": env.get_template(f"module/{template}").render(variables)
        for kind, template in (("h", head), ("c", "module.c.j2"))
    }


def _definitions(unit: Unit, printer: FunctionPrinter, interface: Interface) -> list[list[str]]:
    """Return the lines of the definitions of a module: records, tables, functions."""
    # Public records are in the header, because callers allocate them.
    definitions = [printer.record(record.name) for record in unit.records if not record.public]
    # In C a table must be defined before a function uses the table.
    definitions += [printer.table(table) for table in unit.tables]
    real, n = interface.format.c_type, len(interface.inputs)
    for function in unit.functions:
        # ``step`` passes the callback ``hold`` to other functions. ``hold`` supplies constant inputs.
        if function.name == "step" and n:
            definitions.append(
                [
                    "/* Copy 'context' to 'inputs'. The time t is not used. */",
                    f"static void {interface.prefix}hold({real} t, {real} inputs[{n}], void *context)",
                    "{",
                    "    (void)t;",
                    f"    memcpy(inputs, context, {n} * sizeof *inputs);",
                    "}",
                ]
            )
        definitions.append(printer.definition(function))
    return definitions


def helper_texts(functions: Sequence[str]) -> tuple[str, ...]:
    """Return the C definitions of ``functions`` and of the functions that they call.

    Functions of the mathematical library are omitted.
    """
    return needed("c", [name for name in functions if name not in LIBRARY]).texts


def helpers(unit: Unit) -> list[str]:
    """Return the sorted names of the helper functions and library functions that a module calls."""
    # Branches prevent vector instructions. Therefore loops over the systems of a batch or over the sites of a
    # lattice call helpers without branches, for example ``sin_near`` instead of ``sin``.
    vector = BATCH in unit.parts or any(f.near for f in unit.functions)
    names = _forms(unit) if vector else set(functions_of(unit))
    # A step tests whether its new state is finite, so ``isfinite`` is always needed.
    names |= {"isfinite"}
    for function in unit.functions:
        for term in terms(function.body):
            if term.op == "finite" and term.args[0].shape:
                names.add("all_finite")
            elif term.op == "call":
                names.add({"abs": "fabs", "greatest": "greater"}.get(term.text, term.text))
    # pow and copysign are in math.h and need no helper.
    return sorted(names - {"power", "copysign"})


def _forms(unit: Unit) -> set[str]:
    """Return the names of the helpers called by a batch module or a lattice module.

    A name may be the name of a variant, for example ``sin_near``.
    """
    # A table is a piecewise polynomial that the emitted code calls as a function. ``called_by`` returns only
    # the names of tables, but the C function of a table also needs the knots and coefficients. Therefore
    # ``tables`` contains the objects with the knots and coefficients, from ``functions_of``.
    tables = {name for name in functions_of(unit) if isinstance(name, PiecewisePolynomial)}
    names: set[str] = set(tables)
    for function in unit.functions:
        form = near if function.near else complete
        names |= {
            form(name)
            for name in called_by(function.body) - tables
            if name not in unit.parts and name not in LANGUAGE
        }
    return names


def inverted_sizes(kernel: Kernel) -> set[int]:
    """Return the sizes of the matrices that a step inverts by elimination."""
    blocks = () if kernel.sites is None else kernel.sites.blocks
    # A chain is a one-dimensional lattice. Newton's method inverts a small matrix for each site of a chain.
    chains = {block.newton.size for block in blocks if block.newton is not None}
    loops = [loop for loop in kernel.loops if loop.newton is not None and not loop.newton.inverted]
    return {len(loop.unknowns) for loop in loops} | chains


def inverted(kernel: Kernel) -> int:
    """Return the common size of all matrices that a step inverts by elimination.

    The result is 0 if there are no such matrices, if the sizes differ, or if one size exceeds
    :data:`~codegen.run.sweeps.WIDE`.
    """
    sizes = inverted_sizes(kernel)
    # ``sizes`` is a set. It has one element if all these matrices have the same size.
    return next(iter(sizes)) if len(sizes) == 1 and max(sizes) <= WIDE else 0


def stack(unit: Unit, plan: Plan, interface: Interface) -> str:
    """Return a text with the stack bound: an upper bound on the stack memory of an emitted function.

    :class:`SceneError` is raised if the bound exceeds :data:`LARGEST_STACK`.
    """
    inverting = NEWTON in interface.solvers or SIMPLIFIED_NEWTON in interface.solvers
    # Without Newton's method, the function calls in a step need at most FRAMES bytes of the stack. The call
    # of the kernel needs about half of these bytes. If the kernel is inlined in the loop over the steps
    # (``is_looped``), this half is not needed. With Newton's method, the call of ``invert`` needs about
    # FRAMES // 2 additional bytes.
    frames = FRAMES + FRAMES // 2 * (inverting - is_looped(plan))
    size, each = (
        {"double": 8, "float": 4}[interface.format.c_type],
        EACH_SOLVING if interface.blocks else EACH,
    )
    numbers = numbers_held(unit)
    # The bound is rounded up to a multiple of 64 bytes, because compilers align vectors on the stack.
    bound = -(-(each * numbers + frames) // 64) * 64
    if bound > LARGEST_STACK:
        raise SceneError(
            f"a step needs {bound / 2**20:.1f} MiB of the stack",
            where=interface.module,
            expected=f"at most {LARGEST_STACK // 2**20} MiB, because larger arrays may overflow the stack",
            hint="use a scene with a smaller state, a method with fewer stages, or the target python",
        )
    # Without optimisation, a call needs about ``size * numbers + frames`` bytes.
    margin = f"; {bound - size * numbers - frames} of these bytes are a safety margin" if each > size else ""
    return f"at most {bound} bytes with {MEASURED}{margin}; math library functions need extra bytes"


def own_names(interface: Interface, unit: Unit) -> frozenset[str]:
    """Return the names that variables of emitted functions must not have."""
    prefix, upper = interface.prefix, interface.prefix.upper()
    names = {"step", "run", "run_adaptive", "jacobian", "run_batch", "statistics", "input", "hold"}
    names |= {"integrate", "event"} if interface.integrated else set()
    names |= {f.name for f in unit.functions} | {r.name for r in unit.records}
    names |= {t.name.text for t in unit.tables}
    # The names of all helper functions are reserved, because the module may call each of them.
    names |= {snippet.name for snippet in snippets(interface.format)}
    # The parameters ``event`` and ``data`` have no prefix, so local variables must not have these names.
    local = {"event", "data"} if interface.events else set[str]()
    # PREFIX_H is the include guard of the emitted header.
    constants = {f"{upper}{name}" for name in (*STATUSES, "H", "INDEPENDENT")}
    return frozenset({f"{prefix}{name}" for name in names} | constants | local)


def prototypes(interface: Interface) -> str:
    """Return declarations of a module's functions in the form that cffi reads."""
    prefix, blocks = interface.prefix, len(interface.blocks)
    real = interface.format.c_type
    # The declarations must agree with the emitted header, argument by argument.
    time = f"{real} t, " if interface.time else ""
    # Names of parameters may be keywords of C, so the declarations contain p0, p1, ... instead.
    parameters = "".join(f"{real} p{i}, " for i in range(len(interface.parameters)))
    statistics = f"{prefix}statistics *statistics, " if blocks else ""
    # With Newton's method, the emitted record ``statistics`` also has the field ``matrices``.
    matrices = "size_t matrices; " if interface.newton else ""
    fields = f"size_t sweeps[{blocks}]; size_t most; size_t failed; {matrices}"
    record = f"typedef struct {{ {fields}}} {prefix}statistics;\n"
    callback = f"typedef void (*{prefix}input)({real} t, {real} *inputs, void *context);\n"
    sampled = f"{prefix}input input, void *context, " if interface.inputs else ""
    chosen = f"{real} *t, {real} end, {real} *h, {real} rtol, {real} atol, size_t limit, "
    adaptive = (
        f"int {prefix}run_adaptive({real} *state, {chosen}{parameters}{sampled}{statistics}"
        "size_t *accepted, size_t *rejected);\n"
    )
    run = (
        f"int {prefix}run({real} *state, {time}{real} h, size_t steps, {parameters}{sampled}"
        f"{real} *trajectory, size_t stride, {statistics}size_t *completed);\n"
    )
    # The function ``run`` receives a callback that computes the inputs at a time t. The function ``jacobian``
    # computes the Jacobian of a single step. The inputs are constant during this step, so ``jacobian``
    # receives an array of inputs.
    held = f"const {real} *inputs, " if interface.inputs else ""
    derived = (
        f"int {prefix}jacobian(const {real} *state, {time}{real} h, {parameters}{held}{real} *jacobian);\n"
    )
    run += derived if interface.variations else ""
    # The function ``run_batch`` integrates several systems. The arrays ``parameters`` and ``inputs`` contain
    # the values for all these systems.
    rows = f"const {real} *parameters, " if interface.parameters else ""
    rows += f"const {real} *inputs, " if interface.inputs else ""
    run += (
        f"int {prefix}run_batch(size_t lanes, size_t stride, {real} *state, {time}{real} h, size_t steps, "
        f"{rows}int *statuses, size_t *completed);\n"
        if interface.batch
        else ""
    )
    # cffi reads declarations in order, so types come before the functions that use them.
    known = ((record, bool(blocks)), (callback, bool(interface.inputs)), (adaptive, interface.adaptive))
    passed = f"{parameters}{sampled}"
    return "".join(text for text, there in known if there) + run + _integrate(interface, passed, statistics)


def _integrate(interface: Interface, passed: str, statistics: str) -> str:
    """Return the declaration of the function ``integrate``, or an empty text if the module does not have it.

    ``passed`` declares the parameters and inputs. ``statistics`` declares the solver statistics.
    """
    if not interface.integrated:
        return ""
    prefix, real = interface.prefix, interface.format.c_type
    event = f"typedef void (*{prefix}event)({real} t, const {real} *state, {real} *values, void *data);\n"
    buffers = (
        f"{prefix}event event, void *data, const size_t *stops, size_t room, {real} *event_times, "
        f"{real} *event_rows, size_t *event_numbers, size_t *event_count, "
    )
    # With step control, ``*h`` is set to the size of the next step, so ``h`` is passed by a pointer.
    tolerances = f"{real} rtol, {real} atol, {real} least, {real} greatest, "
    chosen = f"{real} *t, {real} end, " + (
        f"{real} *h, {tolerances}" if interface.controlled else f"{real} h, "
    )
    outputs = f"const {real} *times, size_t count, {real} *rows, size_t *written, "
    # Without step control no step is rejected, so one argument for the number of steps is enough.
    last = "size_t *accepted, size_t *rejected" if interface.controlled else "size_t *completed"
    return (event if interface.events else "") + (
        f"int {prefix}integrate({real} *state, {chosen}size_t limit, {passed}{outputs}"
        f"{buffers if interface.events else ''}{statistics}{last});\n"
    )


def example_input(interface: Interface) -> list[str]:
    """Return a C function for the usage example, as lines. The function sets all run-time inputs to zero."""
    real, several = interface.format, len(interface.inputs)
    return [
        f"static void constant({real.c_type} t, {real.c_type} inputs[{several}], void *context)",
        "{",
        "    (void)t;",
        # The casts to void avoid warnings about unused parameters.
        "    (void)context;",
        *(f"    inputs[{k}] = {literal(real, 0.0)}; // {n}" for k, n in enumerate(interface.inputs)),
        "}",
        "",
    ]


def example(interface: Interface, recipe: Recipe) -> list[str]:
    """Return the lines of an example program that uses the module."""
    return lattice_usage(interface, recipe) if interface.dimension else usage(interface, recipe)


def usage(interface: Interface, recipe: Recipe) -> list[str]:
    """Return the lines of an example program. The program starts from the initial state of the scene."""
    real = interface.format
    # printf would convert float to double implicitly, and -Wdouble-promotion would warn.
    wide = "" if real is DOUBLE else "(double)"

    def number(x: float) -> str:
        return literal(real, real.round(float(x)))

    initial, entries = ", ".join(map(number, recipe.initial)), entries_set(recipe.initial)
    declared = [f"    {real.c_type} state[{interface.size}] = {{{initial}}};"]
    if entries is not None:
        declared = [
            # A static array starts with zeros and needs no space on the stack.
            f"    static {real.c_type} state[{interface.size}];",
            *(f"    state[{place}] = {number(x)};" for place, x in entries),
            # The example is part of a C block comment, so it contains only line comments.
            *(() if entries else (f"    // {IN_MANIFEST}",)),
        ]
    # The example starts at t = 0.
    arguments = ["state", *([number(0.0)] if interface.time else []), number(recipe.h), str(recipe.steps)]
    arguments += [number(recipe.defaults.get(p, 0.0)) for p in interface.parameters]
    arguments += ["constant", "NULL"] if interface.inputs else []
    arguments += ["NULL", "0", *(["NULL"] if interface.blocks else []), "&completed"]
    return [
        f'#include "{interface.module}.h"',
        "#include <stdio.h>",
        "",
        *(example_input(interface) if interface.inputs else ()),
        "int main(void)",
        "{",
        *declared,
        "    size_t completed;",
        f"    const int status = {interface.prefix}run({', '.join(arguments)});",
        '    printf("status %d after %zu steps\\n", status, completed);',
        f"    for (int i = 0; i < {interface.size}; i++) {{",
        f'        printf("%.{real.digits}g\\n", {wide}state[i]);',
        "    }",
        "    return status;",
        "}",
    ]
