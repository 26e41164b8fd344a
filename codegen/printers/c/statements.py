"""Statements of a step in C: single assignments are ``const``, a fixed point is a counting ``for``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from codegen.ir.expr import Expr
from codegen.printers.arrange import Arrangement, Assignment, Iteration, Joint
from codegen.printers.expression import Style, spell
from codegen.printers.names import Names
from codegen.printers.precision import DOUBLE, Precision
from codegen.snippets.graph import LIBRARY
from codegen.snippets.stumpff import SETS

WIDTH = 100

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
    sqrt sin cos exp log sinh cosh fabs isfinite greater quotient signed_stumpff0 signed_stumpff1
    sqrtf sinf cosf expf logf sinhf coshf fabsf
    state statistics steps step stride trajectory completed status advance row sweep change scale still close
    count_sweeps input inputs context held hold
    weighted between error rtol atol limit accepted rejected end now size left last taken then trial norm wish
    factor trend shrunk refused made before next total ratio
"""
RESERVED = frozenset(_WORDS.split()) | {f"stumpff_{''.join(map(str, orders))}" for orders in SETS}
"""Words that no variable may take.

Keywords of C and, since headers are read by both, of C++; macros of headers that the module or its caller is
likely to include; what the helpers and templates call their own.
"""


class Statements:
    """Prints the statements of one arrangement.

    ``prefix`` starts status codes; lines carry no indentation of their own beyond nested blocks.
    """

    def __init__(
        self, arrangement: Arrangement, names: Names, prefix: str, precision: Precision = DOUBLE
    ) -> None:
        self.arrangement, self.names, self.prefix, self.precision = arrangement, names, prefix, precision
        self.real = precision.c_type
        self.style = style(precision)

    def lines(self) -> Iterator[str]:
        """Yield the lines of every statement, in order."""
        for statement in self.arrangement.statements:
            if isinstance(statement, Iteration):
                yield from self._iteration(statement)
            else:
                yield from self._simple(statement)

    def outputs(self, symbols: tuple[str, ...]) -> tuple[list[str], tuple[str, ...]]:
        """Return the lines that name the new state, and its identifiers in state order."""
        lines: list[str] = []
        found: list[str] = []
        for symbol, value in zip(symbols, self.arrangement.outputs, strict=True):
            if value.op == "sym" and value.payload not in symbols:
                found.append(self.names.spelled[value.payload])
                continue
            found.append(self.names.fresh(f"new_{symbol}"))
            lines += self._declare(found[-1], value)
        return lines, tuple(found)

    def errors(self) -> list[str]:
        """Return the lines that write the estimate of the error, component by component."""
        lines: list[str] = []
        for k, value in enumerate(self.arrangement.errors):
            lines += fill(f"    error[{k}] =", spell(value, self.names.spelled, self.style), ";")
        return ["if (error != NULL) {", *lines, "}"] if lines else []

    def _declare(self, name: str, value: Expr, kind: str | None = None) -> list[str]:
        kind = f"const {self.real} " if kind is None else kind
        return fill(f"{kind}{name} =", spell(value, self.names.spelled, self.style), ";")

    def _literal(self, x: float) -> str:
        return literal(self.precision, x)

    def _simple(self, statement: Assignment | Joint, kept: Iterable[str] = ()) -> Iterator[str]:
        if isinstance(statement, Assignment):
            name = self.names.spelled[statement.name]
            kind = "" if statement.name in kept else None
            yield from self._declare(name, statement.value, kind)
            return
        argument = " ".join(spell(statement.argument, self.names.spelled, self.style))
        names = [self.names.spelled[n] for n in statement.names]
        if len(names) == 1:
            yield f"const {self.real} {names[0]} = {statement.function}({argument});"
            return
        yield f"{self.real} {', '.join(names)};"
        yield f"{statement.function}({argument}, {', '.join(f'&{n}' for n in names)});"

    def _iteration(self, statement: Iteration) -> Iterator[str]:
        loop, number = statement.loop, statement.number
        now = [self.names.spelled[u] for u in loop.unknowns]
        plain = [x.op == "sym" and x.payload not in loop.unknowns for x in statement.images]
        new = [
            self.names.spelled[x.payload] if already else self.names.fresh(f"next_{u}")
            for u, x, already in zip(loop.unknowns, statement.images, plain, strict=True)
        ]
        previous = self.names.fresh(f"previous_{number}")
        yield f"/* {comment(loop.label)}: fixed point in {', '.join(now)} */"
        for name, start in zip(now, statement.starts, strict=True):
            yield from self._declare(name, start, f"{self.real} ")
        if statement.kept:
            kept = [self.names.spelled[n] for n in statement.kept]
            yield from fill(self.real, (*(f"{n}," for n in kept[:-1]), kept[-1]), ";")
        yield f"{self.real} {previous} = {self._literal(0.0)};"
        yield "for (size_t sweep = 1;; sweep++) {"
        for inner in statement.body:
            for line in self._simple(inner, statement.kept):
                yield f"    {line}"
        for name, image, already in zip(new, statement.images, plain, strict=True):
            for line in [] if already else self._declare(name, image):
                yield f"    {line}"
        differences = [self.names.fresh(f"change_{u}") for u in loop.unknowns]
        for difference, x, y in zip(differences, new, now, strict=True):
            yield f"    const {self.real} {difference} = {self.style.function('fabs')}({x} - {y});"
        for line in self._decision(statement, differences, now, new, previous):
            yield f"    {line}"
        yield "}"

    def _decision(
        self, statement: Iteration, differences: list[str], now: list[str], new: list[str], previous: str
    ) -> Iterator[str]:
        loop, block = statement.loop, statement.number - 1
        scaled = self.precision.scaled
        close, tolerance = (self._literal(scaled(x)) for x in (loop.close, loop.tolerance))
        unit = self._literal(self.precision.unit)
        yield from fill(f"const {self.real} change =", broken(greatest(differences)), ";")
        sizes = [self._literal(1.0), *(f"{self.style.function('fabs')}({x})" for x in now)]
        yield from fill(f"const {self.real} scale =", broken(greatest(sizes)), ";")
        total = (differences[0], *(f"+ {x}" for x in differences[1:]))
        yield from fill("if (!isfinite(", total, ")) {", joint="")
        yield f"    count_sweeps(statistics, {block}, sweep, 1);"
        yield f"    return {self.prefix.upper()}NOT_FINITE;"
        yield "}"
        yield f"const int still = {previous} > {self._literal(0.0)} && change >= {previous};"
        yield from fill(
            "const int close =",
            (f"change <= {close} * scale", f"&& change * change <= {unit} * scale * {previous}"),
            ";",
        )
        yield f"if (close || (still && change <= {tolerance} * scale)) {{"
        yield f"    count_sweeps(statistics, {block}, sweep, 0);"
        yield "    break;"
        yield "}"
        yield f"if (sweep == {loop.limit}) {{"
        yield f"    count_sweeps(statistics, {block}, sweep, 1);"
        yield f"    return {self.prefix.upper()}NOT_CONVERGED;"
        yield "}"
        yield f"{previous} = change;"
        for x, y in zip(now, new, strict=True):
            yield f"{x} = {y};"


def literal(precision: Precision, x: float) -> str:
    """Spell a number that needs no rounding, or that is rounded already."""
    return precision.text(x) + precision.suffix


def style(precision: Precision) -> Style:
    """Return how C spells constants and functions in a precision: ``0.5f`` and ``sqrtf``."""

    def called(name: str) -> str:
        return name + precision.suffix if name in LIBRARY and name != "isfinite" else name

    return Style(lambda value: literal(precision, precision.round(value)), called)


def greatest(terms: list[str]) -> str:
    """Spell the greatest of some terms as a balanced tree of two-argument calls."""
    if len(terms) == 1:
        return terms[0]
    middle = len(terms) // 2
    return f"greater({greatest(terms[:middle])}, {greatest(terms[middle:])})"


def comment(text: str) -> str:
    """Return text that cannot end the C comment it stands in."""
    return text.replace("*/", "* /").replace("/*", "/ *")


def broken(text: str) -> tuple[str, ...]:
    """Cut nested calls after their commas."""
    return tuple(text.replace(", ", ",|").split("|"))


def fill(start: str, pieces: tuple[str, ...], end: str, width: int = WIDTH, joint: str = " ") -> list[str]:
    """Join start, pieces and end with spaces, breaking lines before pieces that do not fit.

    ``joint`` stands between start and the first piece.

    >>> fill("x =", ("a", "+ b", "+ c"), ";", width=18)
    ['x = a + b', '    + c;']
    """
    lines = [start]
    for position, piece in enumerate(pieces):
        tail = end if position == len(pieces) - 1 else ""
        if position and len(lines[-1]) + 1 + len(piece) + len(tail) > width - 8:
            lines.append(f"    {piece}{tail}")
        else:
            lines[-1] += f"{' ' if position else joint}{piece}{tail}"
    return lines
