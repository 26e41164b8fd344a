"""Prints one step of an integrator as a Python module.

The module has the functions ``step`` and ``run``, and an exception for failures. The docstring of the module
describes the method and the use of the module.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from codegen.ir.angle_depth import chain
from codegen.ir.expr import Expr
from codegen.ir.ieee import OVERFLOWING, UNDEFINED
from codegen.ir.kernel import Kernel
from codegen.ir.precision import DOUBLE
from codegen.ir.selection import CHOOSE
from codegen.kernel.operations import costs
from codegen.printers.expression import DIVIDED
from codegen.printers.interface import Interface
from codegen.printers.needs import functions_of
from codegen.printers.python.divisions import hidden_divisions
from codegen.printers.python.functions import FunctionPrinter, class_of
from codegen.printers.python.modes import print_modes
from codegen.printers.python.terms import Constants
from codegen.printers.python.text import quoted
from codegen.printers.python.words import INTEGRATION, PUBLIC, RESERVED
from codegen.printers.recipe import IN_MANIFEST, Recipe, entries_set, header
from codegen.printers.state_fields import layout, times
from codegen.run.identifiers import Identifiers, identify
from codegen.run.language import RAISES_STATUS, Unit, terms
from codegen.run.plan import Plan
from codegen.run.status import NOT_FINITE_BLOCK, statuses
from codegen.run.unit import unit_of
from codegen.snippets.graph import Needed, needed
from codegen.templates import environment

LIMITS = ["rtol=1e-6", "atol=1e-9", "limit=100000"]
"""The default options of a run with step-size control."""


def print_module(kernel: Kernel, interface: Interface, recipe: Recipe) -> dict[str, str]:
    """Return the emitted Python module, as a map from the name of its file to its text."""
    if kernel.modes is not None:
        return print_modes(kernel, interface, recipe)
    return {f"{interface.module}.py": _Module(kernel, interface, recipe).text()}


@dataclass(frozen=True)
class _Module:
    """Assembles the text of one emitted module."""

    kernel: Kernel
    interface: Interface
    recipe: Recipe

    @cached_property
    def unit(self) -> Unit:
        """The records, tables and private functions of the module."""
        unit = unit_of(Plan(self.kernel, self.interface.format))
        # The function ``step`` is omitted here, because the template contains a public function ``step`` that
        # calls ``run``.
        kept = tuple(f for f in unit.functions if f.name != "step")
        return Unit(unit.scalars, unit.records, unit.tables, kept)

    @cached_property
    def identifiers(self) -> dict[str, Identifiers]:
        """A map from the name of each function to the identifiers in this function."""
        # The printer puts an underscore before the name of each function. Variables must not have the names
        # in ``underscored``.
        underscored = {f"_{f.name}" for f in self.unit.functions}
        classes = {class_of(record) for record in self.unit.records}
        own = INTEGRATION if self.interface.integrated else frozenset[str]()
        return identify(self.unit, RESERVED | PUBLIC | own | underscored | classes)

    @cached_property
    def constants(self) -> Constants:
        """The floating-point constants of the module."""
        # A local variable with the name of a constant would hide the global constant.
        taken = {name for of in self.identifiers.values() for name in of.by_name.values()}
        names = self.replaced
        return Constants(
            self.interface.format, frozenset(taken), lambda name: names.get(name, name), self.divisions
        )

    @cached_property
    def printer(self) -> FunctionPrinter:
        """The printer of the functions of the module."""
        return FunctionPrinter(self.unit, self.identifiers, self.constants)

    @property
    def single(self) -> bool:
        """True if the module computes in single precision, with NumPy's float32."""
        return self.interface.format is not DOUBLE

    @cached_property
    def parameters(self) -> list[str]:
        """The identifiers of the run-time parameters."""
        # In the public functions, the parameters have the same identifiers as in the private function
        # ``run``.
        names = self.identifiers["run"].by_name
        return [names[p] for p in self.interface.parameters]

    @cached_property
    def called(self) -> set[str]:
        """The library functions that the module calls. The names are those of :mod:`codegen.run.terms`."""
        functions = [t for f in self.unit.functions for t in terms(f.body)]
        # The terms ``finite`` and ``infinity`` are not calls, but they are printed with the names
        # ``isfinite`` and ``inf``, which must be imported.
        names = {t.text for t in functions if t.op == "call"}
        names |= {t.op for t in functions if t.op in ("finite", "infinity")}
        # A guard that returns NaNs needs the name ``nan``.
        guards = {f.guard for f in self.unit.functions} - {"", RAISES_STATUS}
        return names | ({"nan"} if guards else set())

    @cached_property
    def replaced(self) -> dict[str, str]:
        """Maps the names of functions in formulas to helpers that return an infinity or a NaN as C does.

        The functions of ``math`` raise an exception instead, and the step would fail although the formula may
        have a finite value. Helpers are slower, so they are used only if a step can have a finite result
        although the function returns an infinity or a NaN. In single precision, the functions of NumPy raise
        no exceptions.
        """
        if self.single:
            return {}
        called = functions_of(self.unit)
        # Only ``choose`` and solvers of implicit equations can hide a NaN: ``choose`` may select a value that
        # is not NaN, and a solver may return a status code in place of NaNs.
        undefined = CHOOSE in called or bool(self.interface.blocks)
        hidden = {*OVERFLOWING, *(UNDEFINED if undefined else ())}
        return {name: f"_{name}" for name in called if name in hidden} | {DIVIDED: f"_{DIVIDED}"}

    @cached_property
    def divisions(self) -> frozenset[Expr]:
        """The divisions that the module computes with a helper function.

        In C, a division by zero gives an infinity or a NaN, and the results of the step can still be finite:
        for x = 0, the value of 1 / (1 + 1 / x) is 0. In Python, the operator ``/`` raises an exception for a
        zero divisor, so the helper function replaces ``/`` in such formulas. In single precision, the numbers
        of NumPy raise no exception, so the set is empty.
        """
        return frozenset() if self.single else hidden_divisions(self.unit)

    @cached_property
    def needed(self) -> Needed:
        """The library functions and the helper functions that the module needs."""
        wanted = {f"ieee{self.replaced[f]}" if f in self.replaced else f for f in functions_of(self.unit)}
        wanted |= {DIVIDED} if self.divisions else set()
        # ``functions_of`` does not find the calls of ``power`` and ``sqrt`` in the step control.
        wanted |= {"power"} & self.called | {"sqrt"} & self.called
        return needed("python", sorted(wanted), self.interface.format, chain=chain(self.kernel))

    def imports(self) -> tuple[list[str], list[str]]:
        """Return the names to import from ``math``, and the names to import from NumPy."""
        names = set(self.needed.library)
        # Linters report unused imports, so the module imports only the names that it uses.
        plain = {"isfinite"} if self.called & {"finite", "isfinite"} else set[str]()
        # The helper for powers needs ``inf``, because a negative power of zero is infinite.
        plain |= {"inf"} if self.called & {"infinity", "power"} else set()
        plain |= self.called & {"nan", "copysign"}
        if not self.single:
            return sorted(names | plain), []
        # Single precision needs NumPy's functions, because the functions of ``math`` return doubles.
        return sorted(plain), ["errstate", "float32", *sorted(names - {"isfinite"})]

    def parts(self) -> list[list[str]]:
        """Return the lines of the private definitions of the module."""
        # The template prints the public records.
        definitions = [self.printer.record(r) for r in self.unit.records if not r.public]
        # The text of the helper functions precedes the tables and the functions of the module.
        definitions += [[text] for text in self.needed.texts]
        definitions += [self.printer.table(table) for table in self.unit.tables]
        return [*definitions, *map(self.printer.definition, self.unit.functions)]

    def keyword_arguments(self) -> list[str]:
        """Return the run-time parameters for the argument list of a public function.

        If the recipe has default values for all parameters, the argument list contains these values.
        """
        known = self.recipe.defaults
        if not all(p in known for p in self.interface.parameters):
            return self.parameters
        pairs = zip(self.interface.parameters, self.parameters, strict=True)
        # Python's ``repr`` of a float reads back as exactly the same double.
        return [f"{name}={float(known[p])!r}" for p, name in pairs]

    def text(self) -> str:
        """Return the text of the module."""
        interface, kernel = self.interface, self.kernel
        time, inputs = ["t"] if interface.time else [], ["inputs"] if interface.inputs else []
        optional = ["statistics=None"] if interface.blocks else []
        counted, rows = ["counted"] if interface.blocks else [], ["rows", "stride"]
        # ``step`` receives the values of the inputs, but ``run`` needs a function of time.
        given, held = self.keyword_arguments(), ["lambda t: inputs"] if inputs else []
        passed = [f"{n}={n}" for n in (["statistics"] if interface.blocks else [])]
        comments = header(self.recipe, layout(kernel), costs(kernel), 84, "", times(kernel))
        public = [r for r in self.unit.records if r.public]
        # ``self.constants.digits`` is complete only after the call of ``parts``.
        parts = self.parts()
        imports, arrays = self.imports()
        variables: dict[str, object] = {
            # Triple quotes in the text would end the docstring. A backslash would start an escape sequence.
            "recipe": [line.replace("\\", "\\\\").replace('"""', "'''") for line in comments],
            "usage": usage(interface, self.recipe),
            "imports": imports,
            "arrays": arrays,
            "constants": self.constants.digits,
            "single": self.single,
            "number": "float32" if self.single else "float",
            "blocks": [quoted(label) for label in interface.blocks],
            "statuses": statuses(self.unit),
            "not_finite_block": NOT_FINITE_BLOCK,
            "statistics": [line for record in public for line in self.printer.record(record)],
            "parts": parts,
            "size": interface.size,
            "inputs": interface.inputs,
            "floats": [*time, "h", *self.parameters],
            "step": ", ".join(["state", *time, "h", *inputs, *given, *keywords(optional)]),
            # The function ``step`` calls ``run`` with these arguments.
            "once": ", ".join(["state", *time, "h", "1", *held, *self.parameters, *passed]),
            "run": ", ".join(
                ["state", *time, "h", "steps", *inputs, *given, *keywords(["stride=0", *optional])]
            ),
            "run_arguments": ", ".join(
                ["state", *time, "h", "steps", *self.parameters, *inputs, *rows, *counted, "completed"]
            ),
            "adaptive": self.adaptive(inputs, given, optional, counted),
            "jacobian": self.jacobian(time, inputs, given),
            "integrate": self.integrate(inputs, given, optional, counted),
            "events": interface.events,
        }
        return environment("python").get_template("module/module.py.j2").render(variables)

    def adaptive(
        self, inputs: list[str], given: list[str], optional: list[str], counted: list[str]
    ) -> dict[str, object] | None:
        """Return the template variables of ``run_adaptive``, or None if the module has no such function."""
        if not self.interface.adaptive:
            return None
        arguments = ["state", "now", "end", "size", "rtol", "atol", "limit", *self.parameters, *inputs]
        return {
            "run": ", ".join(
                ["state", "t", "end", *inputs, "h=0.0", *keywords([*LIMITS, *given, *optional])]
            ),
            "floats": ["end", "rtol", "atol", *self.parameters],
            "arguments": ", ".join([*arguments, *counted, "accepted", "rejected"]),
        }

    def integrate(
        self, inputs: list[str], given: list[str], optional: list[str], counted: list[str]
    ) -> dict[str, object] | None:
        """Return the template variables of ``integrate``, or None if the module has no such function."""
        interface = self.interface
        if not interface.integrated:
            return None
        controlled = interface.controlled
        tolerances = ["rtol", "atol", "least", "greatest"] if controlled else []
        # Tolerances and bounds for the step size are options of step control.
        options = ["rtol=1e-6", "atol=1e-9", "least=0.0", 'greatest=float("inf")'] if controlled else []
        events = ["event=None", "stops=()"] if interface.events else []
        # For h = 0, ``integrate`` chooses the first step size.
        first = ["state", "t", "end", *inputs, "h=0.0" if controlled else "h"]
        # The private function ``_integrate`` fills the lists that ``integrate`` creates for the events.
        buffers = ["event", "stops", "room", "event_times", "event_rows", "event_numbers", "event_count"]
        arguments = ["state", "now", "end", "size" if controlled else "h", *tolerances, "limit"]
        arguments += [*self.parameters, *inputs, "times", "len(times)", "rows", "written"]
        arguments += [*(buffers if interface.events else []), *counted]
        arguments += ["accepted", "rejected"] if controlled else ["accepted"]
        return {
            "run": ", ".join(
                [*first, *keywords([*options, "limit=100000", "times=()", *events, *given, *optional])]
            ),
            "floats": ["end", *tolerances, *([] if controlled else ["h"]), *self.parameters],
            "arguments": ", ".join(arguments),
            "controlled": controlled,
            "dense": interface.dense,
        }

    def jacobian(self, time: list[str], inputs: list[str], given: list[str]) -> dict[str, object] | None:
        """Return the template variables of ``jacobian``, or None if the module has no such function."""
        if not self.interface.variations:
            return None
        return {
            "dim": self.interface.variations,
            "arguments": ", ".join(["state", *time, "h", *inputs, *given]),
            "passed": ", ".join(["state", *time, "h", *self.parameters, *inputs, "matrix"]),
        }


def keywords(arguments: list[str]) -> list[str]:
    """Return ``arguments`` as keyword-only parameters, with ``*`` before the first one."""
    return ["*", *arguments] if arguments else []


def usage(interface: Interface, recipe: Recipe) -> list[str]:
    """Return the lines of an example that calls ``run`` with the initial state in ``recipe``."""
    precision = interface.format

    def number(x: float) -> str:
        return precision.text(precision.round(float(x)))

    initial, entries = ", ".join(map(number, recipe.initial)), entries_set(recipe.initial)
    declared = [f"state = [{initial}]"]
    if entries is not None:
        declared = [
            f"state = [0.0] * {interface.size}",
            *(f"state[{place}] = {number(x)}" for place, x in entries),
            *(() if entries else (f"# {IN_MANIFEST}",)),
        ]
    time = ["0.0"] if interface.time else []
    known = all(p in recipe.defaults for p in interface.parameters)
    # If a parameter has no default value, the example passes values for all parameters.
    unset = [] if known else [number(recipe.defaults.get(p, 0.0)) for p in interface.parameters]
    # The example uses inputs that are zero at all times.
    zeros = ", ".join(["0.0"] * len(interface.inputs))
    inputs = [f"lambda t: [{zeros}]"] if interface.inputs else []
    arguments = ["state", *time, number(recipe.h), str(recipe.steps), *inputs, *unset]
    return [
        f"import {interface.module}",
        "",
        *declared,
        f"print({interface.module}.run({', '.join(arguments)}))",
    ]
