"""One step as a Python module: step and run, an exception that says why, the recipe as docstring."""

from __future__ import annotations

from collections.abc import Sequence

from codegen.ir.angle_depth import chain
from codegen.ir.kernel import ELAPSED, LEAD, LONGEST, Deferred, Kernel, Start
from codegen.kernel.operations import costs
from codegen.kernel.schedule import Arrangement, arrange
from codegen.printers.expression import spell
from codegen.printers.identifiers import blocks, inverts, layout, register, times
from codegen.printers.interface import Interface
from codegen.printers.names import Names
from codegen.printers.precision import DOUBLE
from codegen.printers.python.carried import turning
from codegen.printers.python.functions import outlined_function
from codegen.printers.python.statements import RESERVED, Statements
from codegen.printers.python.text import listed, quoted, unpacking
from codegen.printers.recipe import Recipe, header
from codegen.snippets.graph import needed
from codegen.templates import environment

LIMITS = ["rtol=1e-6", "atol=1e-9", "limit=100000"]
"""What a run that chooses its steps is told by default."""


def print_module(kernel: Kernel, interface: Interface, recipe: Recipe) -> dict[str, str]:
    """Return the text of PREFIX.py for one step."""
    arrangement = arrange(kernel)
    names = register(kernel, arrangement, Names(RESERVED))
    symbols = tuple(s for f in kernel.state for s in f.symbols)
    precision = interface.format
    single = precision is not DOUBLE
    statements = Statements(arrangement, names, precision, blocks=blocks(kernel))
    body = list(statements.lines())
    ends, new = statements.outputs(symbols)
    functions = {*arrangement.functions(), "isfinite"}
    if inverts(kernel):
        functions.add("invert")
    ending: dict[str, object] | None = None
    if kernel.deferred is not None:
        ending, more, constants = deferred(kernel.deferred, arrangement, names, interface)
        statements.constants |= constants
        functions |= more
    carried: dict[str, object] | None = None
    if kernel.carried is not None:
        carried, constants = turning(kernel.carried, interface)
        statements.constants |= constants
    derivative: dict[str, object] | None = None
    if kernel.vary is not None:
        derivative, more, constants = jacobian(kernel.vary, interface)
        statements.constants |= constants
        functions |= more
    outlined = []
    for function, arranged in arrangement.outlined:
        lines, constants = outlined_function(function, arranged, interface)
        statements.constants |= constants
        outlined.append(lines)
    found = needed("python", sorted(functions), precision, chain=chain(kernel))
    library = found.library
    imports = ["isfinite"] if single else library
    if kernel.estimate is not None:
        imports = sorted({*imports, "copysign", "inf", "sqrt"})
    if kernel.start is not None:
        imports = sorted({*imports, "comb"})
    arrays = ["errstate", "float32", *(n for n in library if n != "isfinite")] if single else []
    parameters = [names.spelled[p] for p in interface.parameters]
    arguments = parameters
    if all(p in recipe.defaults for p in interface.parameters):
        pairs = zip(interface.parameters, parameters, strict=True)
        arguments = [f"{name}={float(recipe.defaults[p])!r}" for p, name in pairs]
    time = ["t"] if interface.time else []
    statistics = ["statistics"] if interface.blocks else []
    inputs = ["inputs"] if interface.inputs else []
    held = ["lambda t: inputs"] if interface.inputs else []
    optional = [f"{s}=None" for s in statistics]
    start = kernel.start
    memory = ["memory"] if start or interface.newton else []
    adaptive: dict[str, object] | None = None
    if kernel.estimate is not None:
        order = kernel.estimate.order
        adaptive = {
            "run": ", ".join(
                [*("state", "t", "end"), *inputs, "h=0.0", *keywords(LIMITS), *arguments, *optional]
            ),
            "floats": ["rtol", "atol", *parameters],
            "passed": ", ".join([*parameters, *inputs, *(["_Memory()"] if memory else []), *statistics]),
            "present": repr(-0.7 / order),
            "past": repr(0.4 / order),
            "alone": repr(-1.0 / order),
        }
    parts = substeps(kernel, interface)
    moment = [*([str(parts["time"])] if interface.time and parts else []), "fraction * h"]
    body = [*samples(kernel, arrangement.symbols(), names, statements), *body]
    text = (
        environment("python")
        .get_template("module/module.py.j2")
        .render(
            recipe=[
                line.replace("\\", "\\\\").replace('"""', "'''")
                for line in header(recipe, layout(kernel), costs(kernel), 84, "", times(kernel))
            ],
            usage=usage(interface, recipe),
            imports=imports,
            arrays=arrays,
            constants=statements.constants,
            single=single,
            later="float32(float(t) + made * float(h))" if single else "t + made * h",
            snippets=found.texts,
            blocks=[quoted(label) for label in interface.blocks],
            size=interface.size,
            time=interface.time,
            floats=[*time, "h", *parameters],
            state=unpacking([names.spelled[s] for s in symbols]),
            newton=interface.newton,
            memory=bool(memory),
            depth=start.depth if start else 0,
            rough=start.ROUGH if start else 0.0,
            remembered=listed("found = ", [names.spelled[u] for u in start.unknowns], 1) if start else [],
            unread=[i for i, s in enumerate(symbols) if s not in arrangement.symbols()],
            inner=", ".join(["state", *time, "h", *parameters, *inputs, *memory, *statistics]),
            substeps=parts,
            passed_substep=", ".join([*parameters, *inputs, *(["memory[k]"] if memory else []), *statistics]),
            inputs=interface.inputs,
            step=", ".join(["state", *time, "h", *inputs, *arguments, *keywords(optional)]),
            run=", ".join(
                ["state", *time, "h", "steps", *inputs, *arguments, *keywords(["stride=0", *optional])]
            ),
            once=", ".join(["state", *time, "h", "1", *held, *parameters, *(f"{n}={n}" for n in statistics)]),
            passed=", ".join(["h", *parameters, *inputs, *memory, *statistics]),
            continued=", ".join(["state", *time, "part * h", *parameters, *inputs, *memory, *statistics]),
            tries=Start.TRIES,
            shortest=Start.SHORTEST,
            deferred=ending,
            carried=carried,
            outlined=outlined,
            again=", ".join(["state", *time, "h", "made", *parameters]),
            body=[*body, *ends],
            new=listed("return ", (*new, *statements.errors()), 1),
            adaptive=adaptive,
            jacobian=None
            if derivative is None
            else derivative
            | {
                "inner": ", ".join(["state", "vector", *time, "h", *parameters, *inputs]),
                "arguments": ", ".join(["state", *time, "h", *inputs, *arguments]),
                "passed": ", ".join(["state", "vector", *time, "h", *parameters, *held]),
                "substep": parts
                and {
                    "vary": ", ".join(["state", "vector", *moment, *parameters, *inputs]),
                    "state": ", ".join(
                        ["state", *moment, *parameters, *inputs]
                        + ["_Memory()" for _ in memory]
                        + ["None" for _ in statistics]
                    ),
                },
            },
        )
    )
    return {f"{interface.module}.py": text}


def jacobian(kernel: Kernel, interface: Interface) -> tuple[dict[str, object], set[str], dict[str, str]]:
    """Return what the template needs of the kernel of variations, and its functions and constants."""
    arrangement = arrange(kernel)
    names = register(kernel, arrangement, Names(RESERVED))
    symbols = tuple(s for f in kernel.state for s in f.symbols)
    statements = Statements(arrangement, names, interface.format, "D", blocks(kernel))
    body = list(statements.lines())
    ends, new = statements.outputs(symbols[interface.size :])
    asked = samples(kernel, arrangement.symbols(), names, statements)
    spelled = [names.spelled[s] for s in symbols]
    vector = unpacking(spelled[interface.size :])
    found: dict[str, object] = {
        "dim": interface.variations,
        "state": unpacking(spelled[: interface.size]),
        "vector": [*vector[:-1], vector[-1].replace(" = state", " = vector")],
        "body": [*asked, *body, *ends],
        "new": listed("return ", new, 1),
    }
    return found, set(arrangement.functions()), statements.constants


def deferred(
    what: Deferred, arrangement: Arrangement, names: Names, interface: Interface
) -> tuple[dict[str, object], set[str], dict[str, str]]:
    """Return what the template needs of what is put off, and its functions and constants."""
    precision = interface.format
    single = precision is not DOUBLE
    scalars = ("t", "h", *interface.parameters, LEAD, ELAPSED)
    elapsed = "float32(late * float(h))" if single else "late * h"
    time = "float32(float(t) + made * float(h))" if single else "t + made * h"
    functions: set[str] = set()
    constants: dict[str, str] = {}

    def passed(read: Sequence[str]) -> str:
        values = {"t": time, LEAD: "lead", ELAPSED: elapsed}
        return ", ".join(["moving", *(values.get(s, names.spelled.get(s, s)) for s in read)])

    def function(letter: str, kernel: Kernel) -> dict[str, object]:
        arranged = arrange(kernel)
        own = register(kernel, arranged, Names(RESERVED))
        symbols = tuple(s for f in kernel.state for s in f.symbols)
        statements = Statements(arranged, own, precision, letter)
        body = list(statements.lines())
        ends, new = statements.outputs(symbols)
        read = [s for s in scalars if s in arranged.symbols()]
        functions.update(arranged.functions())
        constants.update(statements.constants)
        return {
            "head": ", ".join(["state", *(own.spelled[s] for s in read)]),
            "each": passed(read),
            "state": unpacking([own.spelled[s] for s in symbols]),
            "body": [*body, *ends],
            "new": listed("return ", new, 1),
        }

    number = "float32({})" if single else "{}"
    read = [s for s in scalars if s in arrangement.symbols()]
    found: dict[str, object] = {
        "begin": None if what.begin is None else function("B", what.begin),
        "finish": None if what.finish is None else function("E", what.finish),
        "longest": LONGEST,
        "last": number.format(precision.text(precision.round(what.last))),
        "later": number.format(precision.text(precision.round(what.later))),
        "head": ", ".join(["state", *(names.spelled[s] for s in read)]),
        "each": passed(read),
    }
    return found, functions, constants


def substeps(kernel: Kernel, interface: Interface) -> dict[str, object] | None:
    """Return the table of the parts of a step and how their times are spelled, None where there are none."""
    if not kernel.substeps:
        return None
    precision = interface.format
    single = precision is not DOUBLE
    number = "float32({})" if single else "{}"
    rows = []
    for step in kernel.substeps:
        values = [step.fraction, *([step.offset] if interface.time else [])]
        spelled = [number.format(precision.text(precision.round(x))) for x in values]
        rows.append(f"({', '.join(spelled)})" if interface.time else spelled[0])
    return {
        "rows": rows,
        "time": "float32(float(t) + float(offset) * float(h))" if single else "t + offset * h",
    }


def samples(kernel: Kernel, read: frozenset[str], names: Names, statements: Statements) -> list[str]:
    """Return the lines that ask for the inputs at each time they are read, and name what is read."""
    lines = []
    for sample in kernel.samples:
        targets = [names.spelled[s] if s in read else "_" for s in sample.symbols]
        time = " ".join(spell(sample.time, names.spelled, statements.style))
        lines += listed("", targets, 1)
        lines[-1] += f" = _sampled(inputs, {time})"
    return lines


def keywords(arguments: list[str]) -> list[str]:
    """Return arguments as keyword-only ones."""
    return ["*", *arguments] if arguments else []


def usage(interface: Interface, recipe: Recipe) -> list[str]:
    """Return the lines of an example that runs the step from the scene's initial state."""
    precision = interface.format

    def number(x: float) -> str:
        return precision.text(precision.round(float(x)))

    initial = ", ".join(map(number, recipe.initial))
    time = ["0.0"] if interface.time else []
    known = all(p in recipe.defaults for p in interface.parameters)
    unset = [] if known else [number(recipe.defaults.get(p, 0.0)) for p in interface.parameters]
    zeros = ", ".join(["0.0"] * len(interface.inputs))
    inputs = [f"lambda t: [{zeros}]"] if interface.inputs else []
    arguments = ["state", *time, number(recipe.h), str(recipe.steps), *inputs, *unset]
    return [
        f"import {interface.module}",
        "",
        f"state = [{initial}]",
        f"print({interface.module}.run({', '.join(arguments)}))",
    ]
