"""One step as a C module: PREFIX.h with types and functions, PREFIX.c with the recipe and the step."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb

from codegen.ir.angle_depth import chain
from codegen.ir.kernel import CHORD, ELAPSED, LEAD, LONGEST, NEWTON, Deferred, Kernel, Start
from codegen.ir.number import Number
from codegen.kernel.operations import costs
from codegen.kernel.schedule import Arrangement, Beginning, Invocation, Iteration, arrange
from codegen.printers.c.carried import turning
from codegen.printers.c.functions import outlined_function
from codegen.printers.c.jacobian import varying
from codegen.printers.c.loops import compares
from codegen.printers.c.statements import RESERVED, Statements, literal
from codegen.printers.c.text import comment, fill, paired
from codegen.printers.expression import spell
from codegen.printers.identifiers import WIDE, blocks, inverts, layout, register, times
from codegen.printers.interface import Interface
from codegen.printers.names import Names
from codegen.printers.precision import DOUBLE
from codegen.printers.recipe import Recipe, header
from codegen.snippets.graph import needed
from codegen.templates import environment

TIME = "t"

FLAGS = ("-std=c11", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror", "-ffp-contract=off")
"""The flags that emitted C is promised to compile under, without a warning."""

STATUSES = ("OK", "NOT_CONVERGED", "NOT_FINITE", "BAD_STEP", "LIMIT")
"""The status codes, each after the prefix in capitals."""


def print_module(kernel: Kernel, interface: Interface, recipe: Recipe) -> dict[str, str]:
    """Return the texts of PREFIX.h and PREFIX.c for one step."""
    arrangement = arrange(kernel)
    names = register(kernel, arrangement, Names(RESERVED | own_names(interface)))
    looped = is_looped(kernel, interface)
    variables = declarations(kernel, interface, names)
    variables |= definition(kernel, arrangement, names, interface, looped=looped) | {"looped": looped}
    functions = {*arrangement.functions(), "isfinite"}
    if interface.blocks:
        functions |= {"fabs", "largest"}
    loops = (*kernel.loops, *(kernel.vary.loops if kernel.vary is not None else ()))
    if any(map(compares, loops)):
        functions |= {"greater"}
    if inverts(kernel):
        functions.add("invert")
    repeated = max(1, len(kernel.substeps))
    held = names.count + len(kernel.samples) * len(kernel.inputs) + remembered(kernel) * repeated
    held += interface.size * ((repeated > 1) + bool(interface.blocks))
    if kernel.estimate is not None:
        variables["order"] = kernel.estimate.order
        held += 2 * interface.size
    outlined, most = [], 0
    for function, arranged in arrangement.outlined:
        lines, own_numbers = outlined_function(function, arranged, interface, RESERVED | own_names(interface))
        outlined.append(lines)
        most = max(most, own_numbers)
    variables["outlined"] = outlined
    variables["carried"] = None
    if kernel.carried is not None:
        variables["carried"] = turning(kernel.carried, interface, RESERVED | own_names(interface))
        held += 4 * interface.size
    held += most + called(arrangement)
    variables["vary"] = None
    if kernel.vary is not None:
        own = Names(RESERVED | own_names(interface))
        variables["vary"], varied, spelled = varying(kernel.vary, interface, own)
        variables["vary_inputs"] = samples(kernel.vary, varied.symbols(), own, spelled)
        functions |= set(varied.functions())
        held = max(held, own.count) + 3 * interface.variations
        held += (names.count + remembered(kernel) * repeated + interface.size) * (repeated > 1)
    variables["deferred"] = None
    if kernel.deferred is not None:
        variables["deferred"], more, held = deferred(kernel.deferred, arrangement, names, interface)
        functions |= more
    found = needed(
        *("c", sorted(functions), interface.format),
        sweeps=bool(interface.blocks),
        wide=inverted(kernel),
        chain=chain(kernel),
    )
    variables |= {
        "recipe": [
            comment(line)
            for line in header(
                recipe, layout(kernel), costs(kernel), 96, stack(held, interface, looped), times(kernel)
            )
        ],
        "usage": usage(interface, recipe),
        "variation": kernel.vary.state[-1].meaning if kernel.vary is not None else "",
        "snippets": found.texts,
    }
    env = environment("c")
    return {
        f"{interface.module}.{kind}": env.get_template(f"module/module.{kind}.j2").render(variables)
        for kind in ("h", "c")
    }


REGISTERS = 6
"""How many numbers of a state stay in registers beside what a step computes with them."""


def is_looped(kernel: Kernel, interface: Interface) -> bool:
    """Whether the step stands in the loop of a run itself: the state then stays in registers.

    It does where nothing else calls it, without equations, time, step control, and what is put off, and where
    the state is small.
    """
    alone = kernel.deferred is None and not kernel.substeps and interface.size <= REGISTERS
    return alone and not (interface.blocks or interface.time or interface.adaptive)


def definition(
    kernel: Kernel, arrangement: Arrangement, names: Names, interface: Interface, *, looped: bool = False
) -> dict[str, object]:
    """Return what the body of a function that changes the state is spelled from.

    ``looped`` it reads and changes variables, which are loaded before a loop.
    """
    symbols = tuple(s for f in kernel.state for s in f.symbols)
    real = interface.format.c_type
    statements = Statements(arrangement, names, interface.prefix, interface.format, blocks(kernel))
    # The next guess waits for the solution alone: it is made before what else does.
    unknowns = [names.spelled[u] for u in kernel.start.unknowns] if kernel.start else []
    kept = [*solution(unknowns, real), "remember(memory, solution);"] if unknowns else []
    body = list(statements.lines(kept))
    ends, new = statements.outputs(symbols)
    read = arrangement.symbols()
    own = [names.spelled[s] if looped else f"state[{i}]" for i, s in enumerate(symbols)]
    loads = [
        f"{'' if looped else 'const '}{real} {names.spelled[s]} = state[{i}];"
        for i, s in enumerate(symbols)
        if looped or s in read
    ]
    # What is not read, as it follows from the rest of the state, must be a number all the same.
    numbers = [*new, *(name for name, s in zip(own, symbols, strict=True) if s not in read)]
    differences = paired([f"({n} - {n})" for n in numbers])
    return {
        "errors": statements.errors(),
        "body": [*samples(kernel, read, names, statements), *([] if looped else loads), *body, *ends],
        "loads": loads,
        "own": own,
        "new": new,
        "finite": [
            *fill("if (!isfinite(", paired(numbers), ")", joint=""),
            *fill("    && !(", (*differences, f"== {literal(interface.format, 0.0)}"), ")) {", 92, joint=""),
        ],
    }


def deferred(
    what: Deferred, arrangement: Arrangement, names: Names, interface: Interface
) -> tuple[dict[str, object], set[str], int]:
    """Return what the template needs of what is put off, the functions called, and how many numbers.

    The numbers are those that all functions and their caller hold, for :func:`stack`.
    """
    real, state = interface.format, f"{interface.format.c_type} state[static {interface.size}]"
    scalars = (TIME, "h", *interface.parameters, LEAD, ELAPSED)
    product = "(double)late * h"
    if real is not DOUBLE:
        product = f"({real.c_type})((double)late * (double)h)"

    def head(name: str, own: Names, read: Sequence[str]) -> list[str]:
        more = [f"{real.c_type} {own.spelled[s]}" for s in read]
        return signature(f"static inline void {name}", state, more, "")

    def passed(read: Sequence[str], t: str = "t", elapsed: str = "h") -> str:
        given = {TIME: t, LEAD: "lead", ELAPSED: elapsed}
        return ", ".join(given.get(s, names.spelled.get(s, s)) for s in read)

    def function(name: str, kernel: Kernel) -> dict[str, object]:
        arranged = arrange(kernel)
        own = register(kernel, arranged, Names(RESERVED | own_names(interface)))
        read = [s for s in scalars if s in arranged.symbols()]
        functions.update(arranged.functions())
        found = definition(kernel, arranged, own, interface)
        held.append(own.count)
        return found | {
            "source": head(name, own, read),
            "once": passed(read),
            "each": passed(read, later(interface), product),
        }

    read = [s for s in scalars if s in arrangement.symbols()]
    functions: set[str] = set()
    held = [names.count, 2 * interface.size]
    found: dict[str, object] = {
        "begin": None if what.begin is None else function("begin", what.begin),
        "finish": None if what.finish is None else function("finish", what.finish),
        "longest": LONGEST,
        "last": literal(real, real.round(what.last)),
        "later": literal(real, real.round(what.later)),
        "once": passed(read),
        "each": passed(read, later(interface)),
    }
    found["source"] = head("advance", names, read)
    return found, functions, sum(held)


def samples(kernel: Kernel, read: frozenset[str], names: Names, statements: Statements) -> list[str]:
    """Return the lines that call for the inputs at each time they are read, and name what is read."""
    lines: list[str] = []
    real = statements.real
    for number, sample in enumerate(kernel.samples, 1):
        name = names.fresh(f"inputs_{number}")
        time = " ".join(spell(sample.time, names.spelled, statements.style))
        lines += [f"{real} {name}[{len(kernel.inputs)}];", f"input({time}, {name}, context);"]
        pairs = [(k, symbol) for k, symbol in enumerate(sample.symbols) if symbol in read]
        lines += [f"const {real} {names.spelled[symbol]} = {name}[{k}];" for k, symbol in pairs]
    return lines


FRAMES = 640
"""Bytes for what calls leave on the stack besides numbers, and for the frames of helpers."""


def stack(numbers: int, interface: Interface, looped: bool) -> str:
    """Say how much of the stack a call takes at most: what holds every number of a step at once.

    That is what compilers take who keep all names apart (-O0); tests hold it against ``-fstack-usage``.
    """
    size = {"double": 8, "float": 4}[interface.format.c_type]
    rounded = -(-size * numbers // 64) * 64
    inverting = NEWTON in interface.solvers or CHORD in interface.solvers
    frames = FRAMES + FRAMES // 2 * (inverting - looped)
    return f"at most {rounded + frames} bytes, without what the mathematical library takes"


def own_names(interface: Interface) -> frozenset[str]:
    """Return what a module itself declares or defines, which no variable may hide."""
    prefix, upper = interface.prefix, interface.prefix.upper()
    functions = {
        f"{prefix}{name}" for name in ("step", "run", "run_adaptive", "jacobian", "statistics", "input")
    }
    return frozenset(functions | {f"{upper}{name}" for name in (*STATUSES, "H")})


def declarations(kernel: Kernel, interface: Interface, names: Names) -> dict[str, object]:
    """Return what the templates need to spell heads and calls of the functions."""
    real = interface.format.c_type
    time = [f"{real} t"] if interface.time else []
    parameters = [f"{real} {names.spelled[p]}" for p in interface.parameters]
    statistics = [f"{interface.prefix}statistics *statistics"] if interface.blocks else []
    state = f"{real} state[static {interface.size}]"
    several = len(interface.inputs)
    sampled = [f"{interface.prefix}input input", "void *context"] if several else []
    constant = [f"const {real} inputs[{several}]"] if several else []
    memory, start = memory_of(kernel), kernel.start
    remembering = ["struct memory *memory"] if memory else []
    parts = len(kernel.substeps)
    core = "substep" if parts else "advance"
    each = [f"struct memory memory[static {parts}]"] if memory else []
    step = [*time, f"{real} h", *parameters, *constant, *statistics]
    estimate = [f"{real} *error"] if interface.adaptive else []
    inner = [*time, f"{real} h", *parameters, *sampled, *remembering, *statistics, *estimate]
    whole = [*time, f"{real} h", *parameters, *sampled, *each, *statistics]
    continuing = [*time, f"{real} h", *parameters, *sampled, *remembering, *statistics]
    chosen = [f"{real} *t", f"{real} end", f"{real} *h", f"{real} rtol", f"{real} atol", "size_t limit"]
    chosen += [*parameters, *sampled, *statistics, "size_t *accepted", "size_t *rejected"]
    run = [*time, f"{real} h", "size_t steps", *parameters, *sampled, f"{real} *trajectory", "size_t stride"]
    run += [*statistics, "size_t *completed"]
    size = interface.variations
    point = f"const {real} state[static {interface.size}]"
    varied = [f"{real} vector[static {size}]", *time, f"{real} h", *parameters, *sampled]
    derived = [*time, f"{real} h", *parameters, *constant, f"{real} jacobian[{size * size}]"]
    passed = ["h", *(names.spelled[p] for p in interface.parameters)]
    counted = ["statistics"] if interface.blocks else []
    kept = "memory" if parts else "&memory"
    given = [*([kept] if memory else []), *counted]
    own = [*(["&memory[number]"] if memory else []), *counted]
    none = ["NULL"] if interface.adaptive else []
    called, still = (["input", "context"], ["hold", "held"]) if several else ([], [])
    return {
        "prefix": interface.prefix,
        "upper": interface.prefix.upper(),
        "module": interface.module,
        "size": interface.size,
        "real": real,
        "later": later(interface),
        "time": interface.time,
        "newton": interface.newton,
        "memory": memory,
        "zero": literal(interface.format, 0.0),
        "one": literal(interface.format, 1.0),
        "fabs": f"fabs{interface.format.suffix}",
        "depth": start.depth if start else 0,
        "differences": [
            ", ".join(str((-1) ** j * comb(order, j)) for j in range(order + 1))
            for order in range(start.depth + 1 if start else 0)
        ],
        "rough": literal(interface.format, Start.ROUGH),
        "blocks": [comment(label) for label in interface.blocks],
        "step_header": signature(f"int {interface.prefix}step", f"{real} state[{interface.size}]", step, ";"),
        "run_header": signature(f"int {interface.prefix}run", f"{real} state[{interface.size}]", run, ";"),
        "inputs": interface.inputs,
        "advance_source": signature(f"static inline int {core}", state, inner, ""),
        "substeps": substeps(kernel, interface),
        "composed_source": signature("static inline int advance", state, whole, ""),
        "passed_substep": ", ".join(["fraction[number] * h", *passed[1:], *called, *own]),
        "step_source": signature(f"int {interface.prefix}step", state, step, ""),
        "run_source": signature(f"int {interface.prefix}run", state, run, ""),
        "passed_looped": ", ".join(["state", "h", "1", *passed[1:], "NULL", "0", "NULL"]),
        "passed": ", ".join([*passed, *called, *given, *none]),
        "passed_once": ", ".join([*passed, *still, *given, *none]),
        "continuation_source": signature("static int continued", state, continuing, ""),
        "continued": ", ".join(["part * h", *passed[1:], *called, "memory", *counted, *none]),
        "continued_once": ", ".join([*passed, *still, *given]),
        "continued_run": ", ".join([*passed, *called, *given]),
        "core": core,
        "tries": Start.TRIES,
        "shortest": Start.SHORTEST,
        "variations": size,
        "vary_source": signature("static int vary", point, varied, ""),
        "jacobian_header": signature(
            f"int {interface.prefix}jacobian", f"const {real} state[{interface.size}]", derived, ";"
        ),
        "jacobian_source": signature(f"int {interface.prefix}jacobian", point, derived, ""),
        "passed_vary": ", ".join([*passed, *still]),
        "passed_vary_substep": ", ".join(["fraction[number] * h", *passed[1:], *still]),
        "passed_once_substep": ", ".join(["fraction[number] * h", *passed[1:], *still, *own]),
        "adaptive": interface.adaptive,
        "adaptive_header": signature(
            f"int {interface.prefix}run_adaptive", f"{real} state[{interface.size}]", chosen, ";"
        ),
        "adaptive_source": signature(f"int {interface.prefix}run_adaptive", state, chosen, ""),
        "passed_adaptive": ", ".join(["taken", *passed[1:], *called, *given, "error"]),
        "f": interface.format.suffix,
        "number": lambda x: literal(interface.format, interface.format.round(float(x))),
    }


def substeps(kernel: Kernel, interface: Interface) -> dict[str, object] | None:
    """Return the tables of the parts of a step, None where there are none."""
    real = interface.format
    if not kernel.substeps:
        return None

    def table(name: str, values: Sequence[Number]) -> list[str]:
        spelled = [f"{literal(real, real.round(x))}," for x in values]
        spelled[-1] = spelled[-1].removesuffix(",") + "}"
        start = f"static const {real.c_type} {name}[{len(values)}] ="
        return fill(start, ("{" + spelled[0], *spelled[1:]), ";")

    tables = table("fraction", [step.fraction for step in kernel.substeps])
    if interface.time:
        tables += table("offset", [step.offset for step in kernel.substeps])
    exact = "t + offset[number] * h"
    if real is not DOUBLE:
        exact = f"({real.c_type})((double)t + (double)offset[number] * (double)h)"
    return {"count": len(kernel.substeps), "tables": tables, "time": exact}


def called(arrangement: Arrangement) -> int:
    """Return how many numbers the results of calls of functions are."""
    total = 0
    for statement in arrangement.statements:
        inner = statement.body if isinstance(statement, Beginning | Iteration) else (statement,)
        more = statement.newton if isinstance(statement, Iteration) else ()
        total += sum(one.results for one in (*inner, *more) if isinstance(one, Invocation))
    return total


def memory_of(kernel: Kernel) -> dict[str, object]:
    """Return what a run remembers: ``past``, how many unknowns, and ``inverses``, loops and their sizes."""
    start, inverses = kernel.start, inverses_of(kernel)
    rates = list(range(1, len(kernel.loops) + 1)) if start else []
    past = len(start.unknowns) if start else 0
    loops = [(k, loop.newton) for k, loop in enumerate(kernel.loops, 1) if loop.newton is not None]
    periods = [(k, newton.period) for k, newton in loops if newton.period]
    memory = {"past": past, "inverses": inverses, "rates": rates, "periods": periods}
    return memory if start or inverses else {}


def solution(unknowns: list[str], real: str) -> list[str]:
    """Return the lines that put the solution of all loops into one array."""
    pieces = [f"{u}," for u in unknowns]
    pieces = ["{" + pieces[0], *pieces[1:]]
    pieces[-1] = pieces[-1].removesuffix(",") + "}"
    return fill(f"const {real} solution[{len(unknowns)}] =", tuple(pieces), ";")


def inverses_of(kernel: Kernel) -> list[tuple[int, int]]:
    """Return the loops that keep the inverse of a matrix, by number, with how many unknowns each has."""
    return [(k, len(loop.unknowns)) for k, loop in enumerate(kernel.loops, 1) if loop.solver == NEWTON]


def inverted(kernel: Kernel) -> int:
    """Return the size of all matrices that are inverted at run time, 0 where they are many or differ."""
    loops = [loop for loop in kernel.loops if loop.newton is not None and not loop.newton.inverted]
    sizes = {len(loop.unknowns) for loop in loops}
    return next(iter(sizes)) if len(sizes) == 1 and max(sizes) <= WIDE else 0


def remembered(kernel: Kernel) -> int:
    """Return how many numbers a run remembers, and what inverting a matrix takes besides."""
    matrices = [len(loop.unknowns) for loop in kernel.loops if loop.newton is not None]
    memory, start = [n * n + 3 * n + 1 for n in matrices], kernel.start
    return sum(memory) + ((2 * start.depth + 6) * len(start.unknowns) + 9 + len(kernel.loops) if start else 0)


def signature(start: str, state: str, arguments: list[str], end: str) -> list[str]:
    """Return the lines of a function's head."""
    pieces = [f"{argument}," for argument in arguments[:-1]] + [f"{arguments[-1]})"]
    return fill(f"{start}({state},", tuple(pieces), end)


def prototypes(interface: Interface) -> str:
    """Return declarations of a module's functions without preprocessor lines, as cffi reads them."""
    prefix, blocks = interface.prefix, len(interface.blocks)
    real = interface.format.c_type
    time = f"{real} t, " if interface.time else ""
    parameters = "".join(f"{real} p{i}, " for i in range(len(interface.parameters)))
    statistics = f"{prefix}statistics *statistics, " if blocks else ""
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
    held = f"const {real} *inputs, " if interface.inputs else ""
    derived = (
        f"int {prefix}jacobian(const {real} *state, {time}{real} h, {parameters}{held}{real} *jacobian);\n"
    )
    run += derived if interface.variations else ""
    known = ((record, bool(blocks)), (callback, bool(interface.inputs)), (adaptive, interface.adaptive))
    return "".join(text for text, there in known if there) + run


def example_input(interface: Interface) -> list[str]:
    """Return a function of time for the example: constant inputs, whatever the time."""
    real, several = interface.format, len(interface.inputs)
    return [
        f"static void constant({real.c_type} t, {real.c_type} inputs[{several}], void *context)",
        "{",
        "    (void)t;",
        "    (void)context;",
        *(f"    inputs[{k}] = {literal(real, 0.0)}; // {n}" for k, n in enumerate(interface.inputs)),
        "}",
        "",
    ]


def later(interface: Interface) -> str:
    """Spell the time after ``step`` steps; a float's is rounded once, so that steps do not vanish in it."""
    if interface.format is DOUBLE:
        return "t + (double)step * h"
    return f"({interface.format.c_type})((double)t + (double)step * (double)h)"


def usage(interface: Interface, recipe: Recipe) -> list[str]:
    """Return a program, line by line, that runs the step from the scene's initial state."""
    real = interface.format
    wide = "" if real is DOUBLE else "(double)"

    def number(x: float) -> str:
        return literal(real, real.round(float(x)))

    initial = ", ".join(map(number, recipe.initial))
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
        f"    {real.c_type} state[{interface.size}] = {{{initial}}};",
        "    size_t completed;",
        f"    const int status = {interface.prefix}run({', '.join(arguments)});",
        '    printf("status %d after %zu steps\\n", status, completed);',
        f"    for (int i = 0; i < {interface.size}; i++) {{",
        f'        printf("%.{real.digits}g\\n", {wide}state[i]);',
        "    }",
        "    return status;",
        "}",
    ]
