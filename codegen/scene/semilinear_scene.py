"""Semilinear scenes: u_t = L u + N(u) on a periodic interval. The linear operator L is given by its Fourier
symbol, the factor by which L multiplies exp(i k x).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING

from codegen.errors import SceneError
from codegen.groups.actions import AffineAction
from codegen.groups.matrix import MatrixGroup
from codegen.ir.decimals import exact
from codegen.ir.domain import FloatDomain
from codegen.ir.expr import Expr, evaluate, walk
from codegen.ir.number import Number
from codegen.ir.selection import ABSOLUTE, selects
from codegen.ir.values import Kind
from codegen.scene.arguments import read_span
from codegen.scene.derivative import Dx
from codegen.scene.formulas import Reader
from codegen.scene.orbit import variants
from codegen.scene.problem import TIME, Problem, StateField
from codegen.scene.semilinear import EIGENVALUE, ExactExponential, Semilinear

if TYPE_CHECKING:
    import sympy

TWO_THIRDS = Fraction(2, 3)
"""``dealias=True`` keeps this fraction of the Fourier modes of the nonlinear term N. A product of two kept
modes has no alias among the kept modes.
"""

SAMPLES = (0.0, 0.5, 1.0, 2.75, 17.0)
"""Wave numbers k at which the Fourier symbol of the linear operator is tested. The values of the Fourier
symbol at k and -k must be conjugate.
"""

DIGITS_OF_PI = 60
"""The number of digits of the rational constant that replaces pi in formulas."""


def SemilinearScene(
    *,
    u: sympy.Symbol,
    k: sympy.Symbol,
    x: sympy.Symbol,
    L: sympy.Expr,
    N: sympy.Expr,
    length: sympy.Expr,
    u0: sympy.Expr,
    span: tuple[sympy.Expr, sympy.Expr],
    dealias: bool | Fraction = False,
    name: str = "scene",
    title: str = "",
) -> Problem:
    """Return the scene u_t = L u + N(u) for a function u of x and t that is periodic in x.

    - ``L``: the Fourier symbol of the linear operator, a formula in the wave number ``k`` and parameters. The
      symbol of d/dx is I*k.
    - ``N``: a formula g0 plus terms c Dx(g, m), where Dx(g, m) is the m-th derivative of g with respect to x.
      The formulas g0 and g may contain ``x``, t, parameters, ``u``, Dx(u), Dx(u, 2), .... The factor c
      depends on neither u nor x.
    - ``length``, ``u0``: the period, and the initial state as a formula in ``x``.
    - ``dealias``: the fraction of the Fourier modes of N that is kept. True means 2/3, False means 1.

    Emitted code computes with the values of u at n equally spaced points, where n is a run-time argument.
    Explicit methods of the families rkmk, cf and cg are possible.

    :class:`SceneError` is raised if L does not map real functions to real functions, or if g contains
    derivatives other than Dx(u), Dx(u, 2) and so on. Other reasons for SceneError are unknown symbols, and
    functions such as Piecewise and Max.
    """
    parser = _Parser(name, u, k, x)
    reader, symbol = parser.reader, parser.symbol(L)
    period, start = parser.constant(length, "length"), parser.start(u0)
    inner, terms = parser.nonlinear(N)
    if reader.signals:
        raise SceneError("a signal in the formulas", where=name, expected="formulas in t and parameters")
    parameters = reader.parameters()
    formulas = tuple(terms.values())
    timed = any(n.op == "sym" and n.payload == TIME for n in walk(formulas))
    semilinear = Semilinear(
        *(parser.k, parser.x, symbol, period, start),
        *(inner, tuple(terms), formulas, _kept(name, dealias), timed),
    )
    _check(name, semilinear, parameters)
    shown = reader.space.const(Number.rational(0))
    zero, one = Fraction(0), Fraction(1)
    generators = [[[EIGENVALUE, zero], [zero, zero]], [[zero, one], [zero, zero]]]
    group = MatrixGroup("affine maps exp(t L) u + c", generators)
    return Problem(
        *(name, title or name, group, AffineAction()),
        state=(StateField("y", Kind.POINT, (parser.u,), (shown,)),),
        roots=(),
        hamiltonian=None,
        invariants={},
        span=read_span(name, span),
        parameters=parameters,
        coordinates=ExactExponential(),
        semilinear=semilinear,
    )


class _Parser:
    """Reads the formulas of a semilinear scene."""

    def __init__(self, name: str, u: sympy.Symbol, k: sympy.Symbol, x: sympy.Symbol) -> None:
        # The constructor of Reader checks the names of u, k and x.
        self.reader = Reader(name, [u, k, x])
        self.name = name
        self.given = (u, k, x)
        self.u, self.k, self.x = self.reader.coordinates
        self.reader.coordinates = []

    def symbol(self, L: sympy.Expr) -> tuple[Expr, ...]:
        """Return the Fourier symbol of L as the pair (real part, imaginary part).

        If the imaginary part is zero, the result contains only the real part.
        """
        import sympy

        real = sympy.Symbol(self.k, real=True)
        formula = self._sympified(L, "L").subs(self.given[1], real)
        own = {s: sympy.Symbol(s.name, real=True) for s in formula.free_symbols if s.name == self.k}
        parts = [sympy.simplify(part) for part in formula.subs(own).as_real_imag()]
        parts = [part.subs(real, sympy.Symbol(self.k, real=True)) for part in parts]
        read = [self.pointwise(part, "L", (self.k,)) for part in parts[: 1 if parts[1] == 0 else 2]]
        if any(n.op == "sym" and n.payload == TIME for n in walk(read)):
            raise SceneError(
                "L depends on the time",
                where=self.name,
                expected="constant coefficients",
                hint="move the terms that depend on t from L to N",
            )
        return tuple(read)

    def nonlinear(self, N: sympy.Expr) -> tuple[tuple[tuple[int, str], ...], dict[int, Expr]]:
        """Write N as the sum of (d/dx)^m g_m over m, where symbols replace the derivatives of u in g_m.

        The first result has a pair (order, symbol) for each derivative of u in the formulas g_m; u itself has
        the order 0. The second result maps m to g_m.
        """
        import sympy

        formula = self._sympified(N, "N")
        u = self.given[0]
        symbols: dict[int, sympy.Symbol] = {0: u}
        for atom in sorted(formula.atoms(Dx), key=sympy.default_sort_key):
            if atom.args[0] == u:
                symbols[atom.order] = sympy.Symbol(f"{self.u}_{'x' * atom.order}", real=True)
                formula = formula.subs(atom, symbols[atom.order])
        dummies: dict[sympy.Symbol, Dx] = {}
        for atom in sorted(formula.atoms(Dx), key=sympy.default_sort_key):
            if atom.args[0].has(Dx):
                raise SceneError(
                    f"the nested derivative {atom}",
                    where=self.name,
                    expected="Dx(g, m), where g contains only the derivatives Dx(u), Dx(u, 2) and so on",
                )
            dummies[sympy.Dummy()] = atom
        linear = formula.subs({atom: dummy for dummy, atom in dummies.items()})
        parts: dict[int, sympy.Expr] = {0: linear.subs(dict.fromkeys(dummies, 0))}
        for dummy, atom in dummies.items():
            factor = sympy.simplify(sympy.diff(linear, dummy))
            local = {str(s) for s in factor.free_symbols} & {self.x, *map(str, symbols.values())}
            if local or factor.free_symbols & set(dummies):
                raise SceneError(
                    f"the derivative {atom} in a product or in a function",
                    where=self.name,
                    expected="a linear combination of derivatives with constant coefficients",
                    hint="write the term with Dx(u), Dx(u, 2) and so on",
                )
            parts[atom.order] = parts.get(atom.order, 0) + factor * atom.args[0]
        names = {str(s): order for order, s in symbols.items()}
        terms = {
            order: self.pointwise(part, "N", (self.x, *names))
            for order, part in sorted(parts.items())
            if part != 0
        }
        if not terms:
            terms = {0: self.reader.space.zero}
        read = {n.payload for n in walk(terms.values()) if n.op == "sym"}
        inner = tuple((order, s) for s, order in sorted(names.items(), key=lambda item: item[1]) if s in read)
        return inner, terms

    def pointwise(self, formula: sympy.Expr, what: str, more: Iterable[str]) -> Expr:
        """Convert a sympy formula to an expression.

        The formula may contain t, parameters, and the symbols with the names ``more``. SceneError is raised
        if the formula contains a derivative, or a choice such as Piecewise or Max.
        """
        import sympy

        if isinstance(formula, sympy.Expr) and formula.has(Dx):
            raise SceneError(f"a derivative in {what}", where=self.name, expected="a formula without Dx")
        root = self.reader.scalar(_with_digits(formula), what, more=tuple(more))
        for node in walk([root]):
            if node.op == "call" and node.payload != ABSOLUTE and selects(node.payload):
                raise SceneError(
                    f"{what} contains a choice between formulas, such as Piecewise or Max",
                    where=self.name,
                    expected="a single formula",
                )
        return root

    def start(self, u0: sympy.Expr) -> Expr:
        """Return the formula of the initial state. The formula may contain only x and parameters."""
        root = self.pointwise(u0, "u0", (self.x,))
        if any(n.op == "sym" and n.payload == TIME for n in walk([root])):
            raise SceneError("u0 contains t", where=self.name, expected="a formula in x and parameters")
        return root

    def constant(self, formula: sympy.Expr, what: str) -> Expr:
        """Convert a sympy formula to an expression. The formula may contain only parameters."""
        return self.reader.scalar(_with_digits(self._sympified(formula, what)), what, constant=True)

    def _sympified(self, formula: object, what: str) -> sympy.Expr:
        import sympy

        try:
            result = sympy.sympify(formula, strict=True)
        except sympy.SympifyError:
            result = None
        if not isinstance(result, sympy.Expr):
            raise SceneError(f"{what} is {formula!r}", where=self.name, expected="a formula of sympy")
        return result


def _with_digits(formula: sympy.Expr) -> sympy.Expr:
    """Return the formula with a rational approximation of pi, because the converter does not accept pi."""
    import sympy

    if not isinstance(formula, sympy.Basic) or not formula.has(sympy.pi):
        return formula
    return formula.subs(sympy.pi, sympy.Rational(str(sympy.N(sympy.pi, DIGITS_OF_PI))))


def _kept(name: str, dealias: object) -> Fraction:
    """Return the fraction of Fourier modes to keep.

    ``dealias`` is this fraction, or True for 2/3, or False for 1.
    """
    if isinstance(dealias, bool):
        return TWO_THIRDS if dealias else Fraction(1)
    kept = exact(dealias)
    if kept is None or not 0 < kept <= 1:
        raise SceneError(
            f"dealias = {dealias!r}",
            where=name,
            expected="True, False, or the fraction of the Fourier modes to keep, above 0 and at most 1",
        )
    return kept


def _check(name: str, semilinear: Semilinear, parameters: Mapping[str, Number]) -> None:
    """Raise :class:`SceneError` unless the period is positive and L maps real functions to real functions."""
    values = {key: float(number) for key, number in parameters.items()}
    (size,) = evaluate([semilinear.length], FloatDomain(0.0), values)
    if not (math.isfinite(size) and size > 0):
        raise SceneError(f"length = {size:g}", where=name, expected="a positive number")
    for k in SAMPLES:
        pair = _symbols(semilinear, values, k)
        if pair is None:
            raise SceneError(
                f"L is not finite at k = {k:g}",
                where=name,
                expected="a formula L that is finite for all wave numbers k",
            )
        _require_real(name, pair, f"k = {k:g}")


def check_operator(problem: Problem, semilinear: Semilinear) -> None:
    """Raise :class:`SceneError` as :func:`SemilinearScene` does, for the current values of the parameters and
    for further values of the run-time parameters (:func:`codegen.scene.orbit.variants`)."""
    _check(problem.name, semilinear, problem.parameters)
    for other in variants(problem):
        values = {key: float(number) for key, number in other.parameters.items()}
        shown = "".join(f", {key} = {values[key]:g}" for key in problem.runtime)
        for k in SAMPLES:
            # An infinite or undefined L is no error here, because the user did not choose these parameters.
            if (pair := _symbols(semilinear, values, k)) is not None:
                _require_real(problem.name, pair, f"k = {k:g}{shown}")


def _symbols(
    semilinear: Semilinear, values: Mapping[str, float], k: float
) -> tuple[list[float], list[float]] | None:
    """Return the complex conjugate of the Fourier symbol at k, and the symbol at -k, or None if they are not
    finite."""
    domain = FloatDomain(0.0)
    try:
        plus, minus = (
            evaluate(list(semilinear.symbol), domain, {**values, semilinear.wave: x}) for x in (k, -k)
        )
    except (ArithmeticError, ValueError):
        return None
    finite = all(map(math.isfinite, (*plus, *minus)))
    return ([plus[0], *(-y for y in plus[1:])], minus) if finite else None


def _require_real(name: str, pair: tuple[list[float], list[float]], place: str) -> None:
    if any(abs(a - b) > 1e-9 * (1 + abs(a)) for a, b in zip(*pair, strict=True)):
        raise SceneError(
            f"L does not map real functions with the wave number {place} to real functions",
            where=name,
            expected="a formula L whose value at -k is the complex conjugate of its value at k",
            hint="write I*k for d/dx and abs(k) for sqrt(-d^2/dx^2)",
        )
