"""Statements of a step in C: single assignments are ``const``, a fixed point is a counting ``for``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from codegen.ir.expr import Expr
from codegen.kernel.schedule import Arrangement, Assignment, Beginning, Invocation, Iteration, Simple
from codegen.printers.c import loops
from codegen.printers.c.text import fill
from codegen.printers.expression import Style, spell
from codegen.printers.identifiers import Place
from codegen.printers.names import Names
from codegen.printers.precision import DOUBLE, Precision
from codegen.snippets.graph import LIBRARY
from codegen.snippets.stumpff import SETS

_WORDS = """
    auto break case char const continue default do double else enum extern float for goto if inline int long
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile
    while _Bool _Complex _Imaginary
    alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual
    and and_eq asm bitand bitor catch char8_t char16_t char32_t class co_await co_return co_yield compl
    concept consteval constinit const_cast decltype delete dynamic_cast explicit export friend mutable
    namespace new noexcept not not_eq operator or or_eq private protected public reinterpret_cast
    requires static_cast template this throw try typeid typename using virtual wchar_t xor xor_eq
    complex imaginary I EOF errno assert far linux near unix
    HUGE_VAL HUGE_VALF HUGE_VALL FP_FAST_FMA FP_ILOGB0 FP_ILOGBNAN FP_INFINITE FP_NAN FP_NORMAL FP_SUBNORMAL
    FP_ZERO MATH_ERREXCEPT MATH_ERRNO math_errhandling
    M_E M_LOG2E M_LOG10E M_LN2 M_LN10 M_PI M_PI_2 M_PI_4 M_1_PI M_2_PI M_2_SQRTPI M_SQRT2 M_SQRT1_2
    main NULL INFINITY NAN size_t memcpy fmax
    sqrt sin cos exp log sinh cosh fabs isfinite greater largest quotient signed_stumpff0 signed_stumpff1
    sqrtf sinf cosf expf logf sinhf coshf fabsf
    state statistics steps step stride trajectory completed status advance row sweep change scale still close
    count_sweeps count_matrix contracts input inputs context held hold memory moved size_of solution invert
    slope2 slope3
    weighted between error rtol atol limit accepted rejected end now size left last taken then trial norm wish
    factor trend shrunk refused made before next total ratio vector vary jacobian column
    substep fraction offset number point result i j sum moving momentum inward outward enter leave
    solved part tries guess failure
"""
RESERVED = frozenset(_WORDS.split()) | {f"stumpff_{''.join(map(str, orders))}" for orders in SETS}
"""Words that no variable may take.

Keywords of C and, since headers are read by both, of C++; macros of headers that the module or its caller is
likely to include; what the helpers and templates call their own.
"""


class Statements:
    """Prints the statements of one arrangement.

    ``prefix`` starts status codes; lines carry no indentation of their own beyond nested blocks. ``blocks``
    say where those of the state lie.
    """

    def __init__(
        self,
        arrangement: Arrangement,
        names: Names,
        prefix: str,
        precision: Precision = DOUBLE,
        blocks: Sequence[Place] = (),
    ) -> None:
        self.arrangement, self.names, self.prefix, self.precision = arrangement, names, prefix, precision
        self.blocks = tuple(blocks)
        self.real = precision.c_type
        self.style = style(precision)

    def lines(self, after_loops: Sequence[str] = ()) -> Iterator[str]:
        """Yield the lines of every statement, in order, and those that follow the last loop."""
        last = max(
            (k for k, s in enumerate(self.arrangement.statements) if isinstance(s, Iteration)), default=-1
        )
        for place, statement in enumerate(self.arrangement.statements):
            if isinstance(statement, Iteration):
                yield from loops.iteration(self, statement)
                yield from after_loops if place == last else ()
            elif isinstance(statement, Beginning):
                yield from loops.beginning(self, statement)
            else:
                yield from self.simple(statement)

    def outputs(self, symbols: tuple[str, ...]) -> tuple[list[str], tuple[str, ...]]:
        """Return the lines that name the new state, and its identifiers in state order."""
        lines: list[str] = []
        found: list[str] = []
        for symbol, value in zip(symbols, self.arrangement.outputs, strict=True):
            if value.op == "sym" and value.payload not in symbols:
                found.append(self.names.spelled[value.payload])
                continue
            found.append(self.names.fresh(f"new_{symbol}"))
            lines += self.declare(found[-1], value)
        return lines, tuple(found)

    def errors(self) -> list[str]:
        """Return the lines that write the estimate of the error, component by component."""
        lines: list[str] = []
        for k, value in enumerate(self.arrangement.errors):
            lines += fill(f"    error[{k}] =", spell(value, self.names.spelled, self.style), ";")
        return ["if (error != NULL) {", *lines, "}"] if lines else []

    def declare(self, name: str, value: Expr, kind: str | None = None) -> list[str]:
        """Return the lines of name = value, declared ``const`` unless another kind is given."""
        kind = f"const {self.real} " if kind is None else kind
        return fill(f"{kind}{name} =", spell(value, self.names.spelled, self.style), ";")

    def literal(self, x: float) -> str:
        """Spell a number of this precision."""
        return literal(self.precision, x)

    def simple(self, statement: Simple, kept: Iterable[str] = ()) -> Iterator[str]:
        """Yield the lines of an assignment or joint call; those of ``kept`` names are declared elsewhere."""
        if isinstance(statement, Assignment):
            name = self.names.spelled[statement.name]
            kind = "" if statement.name in kept else None
            yield from self.declare(name, statement.value, kind)
            return
        if isinstance(statement, Invocation):
            yield from self._invoked(statement)
            return
        argument = " ".join(spell(statement.argument, self.names.spelled, self.style))
        names = [self.names.spelled[n] for n in statement.names]
        if len(names) == 1:
            yield f"const {self.real} {names[0]} = {statement.function}({argument});"
            return
        yield f"{self.real} {', '.join(names)};"
        yield f"{statement.function}({argument}, {', '.join(f'&{n}' for n in names)});"

    def _invoked(self, call: Invocation) -> Iterator[str]:
        """Yield the lines that call a function."""
        name = self.names.spelled[call.name]
        given = [" ".join(spell(x, self.names.spelled, self.style)) for x in call.arguments]
        start = f"{call.function}("
        if call.results == 1:
            start = f"const {self.real} {name} = {start}"
        else:
            yield f"{self.real} {name}[{call.results}];"
            given.append(name)
        yield from fill(start, (*(f"{x}," for x in given[:-1]), given[-1]), ");", joint="")


def literal(precision: Precision, x: float) -> str:
    """Spell a number that needs no rounding, or that is rounded already."""
    return precision.text(x) + precision.suffix


def style(precision: Precision) -> Style:
    """Return how C spells constants and functions in a precision: ``0.5f`` and ``sqrtf``."""

    def called(name: str) -> str:
        return name + precision.suffix if name in LIBRARY and name != "isfinite" else name

    return Style(lambda value: literal(precision, precision.round(value)), called)
