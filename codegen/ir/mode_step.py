"""A step of a semilinear equation u' = L u + N(u), computed on Fourier modes.

The linear operator L multiplies each mode by its eigenvalue lambda, and N is the nonlinear part. A step of
size h evaluates N several times, each time at a linear combination of the old state and of earlier values of
N. The new state is a linear combination of the old state and of all values of N. The coefficients of these
linear combinations are functions of z = h lambda (:class:`Multiplier`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from codegen.ir.expr import Expr
from codegen.ir.number import Number

if TYPE_CHECKING:
    from codegen.ir.kernel import Kernel

EXP, PHI, BERNOULLI, POWER = "exp", "phi1", "bernoulli", "z"
"""The names of the functions in the coefficients of a step.

The values of these functions at w are:
- ``EXP``: exp(w)
- ``PHI``: (exp(w) - 1)/w
- ``BERNOULLI``: w/(exp(w) - 1)
- ``POWER``: w
"""

WIDTH = 100
"""The largest number of characters of a formula on one line."""

STATE = -1
"""The value of :attr:`Term.source` if the term is a multiple of the old state."""


@dataclass(frozen=True)
class Factor:
    """A function of z: the function named ``function``, applied to ``scale`` * z. Here z is h times an
    eigenvalue of L.
    """

    function: str
    scale: Number

    def text(self) -> str:
        """Return the text of the factor, for example ``phi1(1/2 z)``."""
        argument = "z" if self.scale.is_one else "-z" if self.scale.is_minus_one else f"{self.scale.text()} z"
        return argument if self.function == POWER else f"{self.function}({argument})"

    @property
    def order(self) -> tuple[str, float, str]:
        """The sort key of the factor: its function, then its scale."""
        # Two different scales may round to the same double, so the key also contains the exact scale as text.
        return self.function, float(self.scale), self.scale.text()


Monomial = tuple[tuple[Factor, int], ...]
"""A product of powers of factors, as sorted pairs (factor, positive exponent)."""

ONE = Number.rational(1)


@dataclass(frozen=True)
class Multiplier:
    """A polynomial in functions of z (:class:`Factor`), where z is h times an eigenvalue of L.

    ``terms`` maps each monomial to its exact numeric coefficient.
    """

    terms: Mapping[Monomial, Number] = field(default_factory=dict)

    @classmethod
    def constant(cls, value: Number) -> Multiplier:
        """Return the constant function with the value ``value``."""
        # The zero polynomial has no terms, and the empty monomial () is the constant 1.
        return cls({} if value.is_zero else {(): value})

    @classmethod
    def of(cls, function: str, scale: Number) -> Multiplier:
        """Return the multiplier f(``scale`` * z), where f is the function with the name ``function``."""
        if scale.is_zero:
            # At 0, POWER has the value 0, EXP has the value 1, and PHI and BERNOULLI have the limit 1.
            return cls.constant(Number.rational(0) if function == POWER else ONE)
        if function == POWER:
            # ``Factor(POWER, ONE)`` represents z, and ``scale`` is the coefficient of z.
            return cls({((Factor(POWER, ONE), 1),): scale})
        return cls({((Factor(function, scale), 1),): ONE})

    def __add__(self, other: Multiplier) -> Multiplier:
        total = dict(self.terms)
        for monomial, value in other.terms.items():
            total[monomial] = total[monomial] + value if monomial in total else value
        # Equal polynomials must have equal terms, so terms with the coefficient zero are removed.
        return Multiplier({m: x for m, x in total.items() if not x.is_zero})

    def __mul__(self, other: Multiplier) -> Multiplier:
        total = Multiplier()
        for a, x in self.terms.items():
            for b, y in other.terms.items():
                # If two products have the same monomial, the operator + adds the two coefficients.
                total = total + Multiplier({_product(a, b): x * y})
        return total

    def scaled(self, value: Number) -> Multiplier:
        """Return this multiplier times the number ``value``."""
        return self * Multiplier.constant(value)

    @property
    def is_one(self) -> bool:
        """True if this is provably the constant 1."""
        return list(self.terms) == [()] and self.terms[()].is_one

    @property
    def key(self) -> tuple[tuple[Monomial, Number], ...]:
        """The items of ``terms`` as a sorted tuple. Two equal polynomials have equal keys."""
        return tuple(sorted(self.terms.items(), key=lambda term: [(f.order, n) for f, n in term[0]]))

    @property
    def factors(self) -> tuple[Factor, ...]:
        """The factors of all terms, without repetitions, in the order of :attr:`key`."""
        # ``dict.fromkeys`` removes repetitions and keeps the order.
        return tuple(dict.fromkeys(f for monomial, _ in self.key for f, _ in monomial))

    def text(self) -> str:
        """Return the multiplier as text.

        >>> half = Number.rational(1, 2)
        >>> m = Multiplier.of(PHI, half) * (Multiplier.of(EXP, half) + Multiplier.constant(-ONE))
        >>> m.scaled(half).text()
        '1/2 exp(1/2 z) phi1(1/2 z) - 1/2 phi1(1/2 z)'
        """
        words: list[str] = []
        for monomial, value in self.key:
            factors = " ".join(f.text() if n == 1 else f"{f.text()}^{n}" for f, n in monomial)
            # The sign of a coefficient is printed as the plus or minus sign before the term.
            minus = value.text().startswith("-")
            size = -value if minus else value
            shown = factors if size.is_one and factors else f"{size.text()} {factors}".strip()
            words.append(
                (f"- {shown}" if words else f"-{shown}") if minus else f"+ {shown}" if words else shown
            )
        return " ".join(words) or "0"


def _product(a: Monomial, b: Monomial) -> Monomial:
    """Return the product of two monomials. Exponentials satisfy exp(a z) exp(b z) = exp((a + b) z)."""
    powers: dict[Factor, int] = {}
    # ``a`` and ``b`` are products of functions of z, where z is h times an eigenvalue of the linear operator.
    # The product of all exponentials in ``a`` and ``b`` is exp(``exponent`` z).
    exponent = Number.rational(0)
    for factor, n in (*a, *b):
        if factor.function == EXP:
            # With a = ``factor.scale``, exp(a z)^n = exp(n a z). The loop adds n a to ``exponent``.
            for _ in range(n):
                exponent = exponent + factor.scale
        else:
            powers[factor] = powers.get(factor, 0) + n
    # An exponential with the exponent 0 is the factor 1 and is omitted.
    if not exponent.is_zero:
        powers[Factor(EXP, exponent)] = 1
    # The factors are sorted, so equal products are equal tuples.
    return tuple(sorted(powers.items(), key=lambda item: item[0].order))


@dataclass(frozen=True)
class Table:
    """A coefficient of a step: the product of h^``power`` and ``multiplier``.

    The multiplier is a function of z, where z is h times an eigenvalue of L. The coefficient has one value
    for each Fourier mode. Emitted code computes these values once for each step size, and stores them.
    """

    multiplier: Multiplier
    power: int

    def text(self) -> str:
        """Return the coefficient as text, for example ``h phi1(1/2 z)``."""
        inner = self.multiplier.text()
        # For ``power`` = 0 the coefficient has no factor h.
        if not self.power:
            return inner
        factor = "h" if self.power == 1 else f"h^{self.power}"
        # A sum of several terms is enclosed in parentheses.
        several = len(self.multiplier.terms) > 1
        return f"{factor} ({inner})" if several else factor if inner == "1" else f"{factor} {inner}"


@dataclass(frozen=True)
class Term:
    """A coefficient times the old state, or a coefficient times a value of the nonlinear part N.

    ``source`` is :data:`STATE` for the old state, otherwise the index of an evaluation of N. ``table`` is the
    index of the coefficient in :attr:`ModeStep.tables`, or None for the coefficient 1.
    """

    source: int
    table: int | None


@dataclass(frozen=True)
class Evaluation:
    """An evaluation of the nonlinear part N in a step.

    The argument of N is the sum of the terms in ``point``. The time of the evaluation is t + ``time`` * h,
    where the step leads from t to t + h.
    """

    point: tuple[Term, ...]
    time: Number


@dataclass(frozen=True)
class Nonlinearity:
    """The nonlinear part N(u), a sum of x-derivatives of functions f_j.

    - ``inner`` contains a pair (order, name) for each x-derivative of u on which the functions f_j depend.
      Order 0 is u itself.
    - In term j of the sum, f_j is differentiated ``outer[j]`` times with respect to x.
    - ``formulas`` computes the values of all f_j at one point x. The kernel inputs are: the derivatives in
      ``inner``; x; t; the parameters.
    - ``kept`` is the fraction of the Fourier modes of N that the step uses. The modes with the highest wave
      numbers are set to zero to avoid aliasing.
    """

    inner: tuple[tuple[int, str], ...]
    outer: tuple[int, ...]
    formulas: Kernel
    kept: Fraction


@dataclass(frozen=True)
class ModeStep:
    """One step of u' = L u + N(u), computed on the Fourier modes of u. Here u is a periodic function of x.

    - ``tables`` contains the coefficients of the terms in ``evaluations`` and ``result``.
    - ``evaluations`` contains the evaluations of N, in the order of execution.
    - The new state is the sum of the terms in ``result``.
    - ``nonlinearity`` is N.
    - ``wave`` is the name of the wave number in the kernel ``symbol``.
    - ``space`` is the name of x in the kernels ``initial`` and ``nonlinearity.formulas``.
    - The kernel ``symbol`` computes the eigenvalue of L for a wave number. The outputs are the real part
      and, if L may have eigenvalues that are not real, the imaginary part.
    - The kernel ``length`` computes the length of the period of u.
    - The kernel ``initial`` computes the initial value of u at a point x.
    """

    tables: tuple[Table, ...]
    evaluations: tuple[Evaluation, ...]
    result: tuple[Term, ...]
    nonlinearity: Nonlinearity
    wave: str
    space: str
    symbol: Kernel
    length: Kernel
    initial: Kernel

    @property
    def complex(self) -> bool:
        """True if the linear operator L may have eigenvalues that are not real."""
        # If the imaginary part simplifies to 0, the kernel ``symbol`` has only one output.
        return len(self.symbol.outputs) > 1

    @property
    def transforms(self) -> int:
        """The number of Fourier transforms of one step."""
        # Each evaluation of N transforms every derivative of u from modes to points, and every term of N from
        # points to modes.
        return len(self.evaluations) * (len(self.nonlinearity.inner) + len(self.nonlinearity.outer))

    @property
    def factors(self) -> tuple[Factor, ...]:
        """The factors of all coefficients, without repetitions, sorted by :attr:`Factor.order`."""
        factors = dict.fromkeys(f for table in self.tables for f in table.multiplier.factors)
        # Sorting makes the result independent of the order of the coefficients in ``tables``.
        return tuple(sorted(factors, key=lambda f: f.order))

    @property
    def backwards(self) -> bool:
        """True if a coefficient of the step contains exp(c z) or phi_1(c z) with c < 0.

        Here z is h times an eigenvalue of the linear operator L.
        """
        # Both exp(c z) and phi_1(c z) with c < 0 grow exponentially as z -> -infinity.
        return any(f.function in (EXP, PHI) and float(f.scale) < 0 for f in self.factors)

    @property
    def growth(self) -> int:
        """A number p such that all multipliers (:attr:`Table.multiplier`) are at most C (1 + |z|)^p in
        absolute value. Here C is a constant, and z < 0 is h times an eigenvalue of L. If :attr:`backwards` is
        true, p has no meaning.
        """
        # For z -> -infinity, the function f grows at most like |z|^d with d = ``degrees[f]``.
        degrees = {PHI: -1, BERNOULLI: 1, POWER: 1, EXP: 0}
        # The degree of a product is the sum of the degrees of its factors.
        products = [m for table in self.tables for m in table.multiplier.terms]
        return max((sum(degrees[f.function] * n for f, n in m) for m in products), default=0)

    def kernels(self) -> tuple[Kernel, ...]:
        """Return four kernels: eigenvalues of L, interval length, nonlinear part N, and initial state."""
        return self.symbol, self.length, self.nonlinearity.formulas, self.initial

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression that emitted code evaluates during a run."""
        # The kernel ``initial`` is not evaluated during a run.
        for kernel in (self.symbol, self.length, self.nonlinearity.formulas):
            yield from kernel.expressions()

    def explanation(self) -> list[str]:
        """Return lines of text with the formulas of the stages U1, U2, ... and of the new state.

        In these formulas, N1 denotes N(U1), and z is h times an eigenvalue of L.
        """
        lines = []
        for number, evaluation in enumerate(self.evaluations, 1):
            # The text "at t + c h" is omitted for c = 0.
            time = "" if evaluation.time.is_zero else f", at t + {evaluation.time.text()} h"
            lines += self._sum(f"U{number}", evaluation.point, time)
        lines += self._sum("new u", self.result, "")
        lines.append("z is h times an eigenvalue of L; phi1(z) = (exp(z) - 1)/z")
        if any(f.function == BERNOULLI for f in self.factors):
            # The poles are imaginary numbers. They do not matter for real eigenvalues.
            poles = ", unbounded near the poles z = 2 pi i m for integers m != 0" if self.complex else ""
            lines.append(f"bernoulli(z) = z/(exp(z) - 1){poles}")
        lines.append(f"for z < 0, {self.bound()}")
        lines.append(
            f"a step: {len(self.evaluations)} evaluations of N, {self.transforms} Fourier transforms"
        )
        return lines

    def bound(self) -> str:
        """Return a text that describes how fast the coefficients of the step grow as z tends to -infinity."""
        if self.backwards:
            return (
                "some coefficients contain exp(c |z|) with c > 0 and grow exponentially; short steps are "
                "required"
            )
        if self.growth > 0:
            power = "|z|" if self.growth == 1 else f"|z|^{self.growth}"
            return f"some coefficients grow like {power}, which may limit the step size"
        return "all coefficients are bounded"

    def _sum(self, name: str, terms: tuple[Term, ...], remark: str) -> list[str]:
        """Return lines with the formula ``name`` = sum of ``terms``, followed by ``remark``."""
        words = []
        for term in terms:
            source = "u" if term.source == STATE else f"N{term.source + 1}"
            factor = "" if term.table is None else self.tables[term.table].text()
            several = term.table is not None and len(self.tables[term.table].multiplier.terms) > 1
            # ``h (a + b)`` is printed without further parentheses.
            shown = f"({factor})" if several and not factor.startswith("h (") else factor
            words.append(f"{shown} {source}".strip())
        line = f"{name} = {' + '.join(words) or '0'}{remark}"
        if len(line) <= WIDTH:
            return [line]
        # A long formula is printed with one term on each line.
        lines = [f"{name} = {words[0] if words else 0}", *(f"+ {word}" for word in words[1:])]
        return [*lines[:-1], lines[-1] + remark]
