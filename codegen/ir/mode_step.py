"""Steps of semilinear equations u' = L u + N(u) on Fourier modes.

The linear operator L multiplies each mode by a number lambda, and N is the nonlinear part. A step of size h
evaluates N several times, each time at a linear combination of the old state and of earlier values of N. The
new state is a linear combination of the old state and of all values of N. The coefficients of these linear
combinations are functions of z = h lambda (:class:`Multiplier`). Emitted code computes these coefficients
once for each step size.
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
"""The functions in the coefficients of a step: exp(w), phi_1(w) = (exp(w) - 1)/w, w/(exp(w) - 1), and w."""

WIDTH = 100
"""A formula with more characters than this number is printed with one line for each term."""

STATE = -1
"""The ``source`` of a term that contains the old state (:class:`Term`)."""


@dataclass(frozen=True)
class Factor:
    """The value of ``function`` at ``scale`` z, where z is the step size h times an eigenvalue of L."""

    function: str
    scale: Number

    def text(self) -> str:
        """Return the text of the factor, for example ``phi1(1/2 z)``."""
        argument = "z" if self.scale.is_one else "-z" if self.scale.is_minus_one else f"{self.scale.text()} z"
        return argument if self.function == POWER else f"{self.function}({argument})"

    @property
    def order(self) -> tuple[str, float, str]:
        """The sort key of the factor: its function, then its scale."""
        # Two scales may round to the same double. Their texts then decide.
        return self.function, float(self.scale), self.scale.text()


Monomial = tuple[tuple[Factor, int], ...]
"""A product of powers: sorted pairs of a factor and a positive exponent."""

ONE = Number.rational(1)


@dataclass(frozen=True)
class Multiplier:
    """A coefficient of a step as a function of z: a polynomial in factors (:class:`Factor`) with exact
    numbers.
    """

    terms: Mapping[Monomial, Number] = field(default_factory=dict)

    @classmethod
    def constant(cls, value: Number) -> Multiplier:
        """Return the number ``value`` as a multiplier."""
        return cls({} if value.is_zero else {(): value})

    @classmethod
    def of(cls, function: str, scale: Number) -> Multiplier:
        """Return function(scale z). If the scale is 0, the result is a constant."""
        if scale.is_zero:
            # At w = 0 the function w is zero, and all other functions have the value or the limit 1.
            return cls.constant(Number.rational(0) if function == POWER else ONE)
        if function == POWER:
            # The scale of w = scale z is a numeric factor, so all multiples of z contain the same factor z.
            return cls({((Factor(POWER, ONE), 1),): scale})
        return cls({((Factor(function, scale), 1),): ONE})

    def __add__(self, other: Multiplier) -> Multiplier:
        total = dict(self.terms)
        for monomial, value in other.terms.items():
            total[monomial] = total[monomial] + value if monomial in total else value
        # Without zero terms, equal polynomials have equal terms.
        return Multiplier({m: x for m, x in total.items() if not x.is_zero})

    def __mul__(self, other: Multiplier) -> Multiplier:
        total = Multiplier()
        for a, x in self.terms.items():
            for b, y in other.terms.items():
                # The addition joins equal monomials.
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
        """The terms in a fixed order. Equal multipliers have equal keys."""
        return tuple(sorted(self.terms.items(), key=lambda term: [(f.order, n) for f, n in term[0]]))

    @property
    def factors(self) -> tuple[Factor, ...]:
        """The factors of all terms, each once."""
        # The dictionary removes repeated factors and keeps their order.
        return tuple(dict.fromkeys(f for monomial, _ in self.key for f, _ in monomial))

    def text(self) -> str:
        """Return the text of the polynomial.

        >>> half = Number.rational(1, 2)
        >>> m = Multiplier.of(PHI, half) * (Multiplier.of(EXP, half) + Multiplier.constant(-ONE))
        >>> m.scaled(half).text()
        '1/2 exp(1/2 z) phi1(1/2 z) - 1/2 phi1(1/2 z)'
        """
        words: list[str] = []
        for monomial, value in self.key:
            factors = " ".join(f.text() if n == 1 else f"{f.text()}^{n}" for f, n in monomial)
            # The sign of a coefficient becomes the sign between two terms.
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
    # All exponentials become one, so ``exponent`` is the sum of their scales.
    exponent = Number.rational(0)
    for factor, n in (*a, *b):
        if factor.function == EXP:
            # exp(a z)^n = exp(n a z), so the scale is added n times.
            for _ in range(n):
                exponent = exponent + factor.scale
        else:
            powers[factor] = powers.get(factor, 0) + n
    # exp(0) = 1 is omitted.
    if not exponent.is_zero:
        powers[Factor(EXP, exponent)] = 1
    # The fixed order makes equal products equal tuples.
    return tuple(sorted(powers.items(), key=lambda item: item[0].order))


@dataclass(frozen=True)
class Table:
    """A coefficient of a step: the function h^``power`` times a multiplier.

    Emitted code computes and stores its values at all modes once for each step size.
    """

    multiplier: Multiplier
    power: int

    def text(self) -> str:
        """Return the function as text, for example ``h phi1(1/2 z)``."""
        inner = self.multiplier.text()
        # If the power is 0, the table has no factor h.
        if not self.power:
            return inner
        factor = "h" if self.power == 1 else f"h^{self.power}"
        # A sum needs parentheses, and a single term needs none.
        several = len(self.multiplier.terms) > 1
        return f"{factor} ({inner})" if several else factor if inner == "1" else f"{factor} {inner}"


@dataclass(frozen=True)
class Term:
    """One term of a linear combination: a factor times the old state, or times a value of N.

    If ``source`` is :data:`STATE`, the term contains the old state. Otherwise ``source`` is the index of the
    value of N. The factor is the table with the index ``table``, or 1 if ``table`` is None.
    """

    source: int
    table: int | None


@dataclass(frozen=True)
class Evaluation:
    """An evaluation of N at the time t + ``time`` h.

    The argument of N is the sum of the terms ``point``.
    """

    point: tuple[Term, ...]
    time: Number


@dataclass(frozen=True)
class Nonlinearity:
    """The nonlinear part N(u), as a sum of derivatives of pointwise formulas.

    - ``inner`` contains the order and the symbol of each derivative of u that the formulas contain.
    - ``formulas`` has one output for each term of N, a function of these derivatives, x, t and the
      parameters. Term j of N is output j, differentiated ``outer[j]`` times with respect to x.
    - ``kept`` is the fraction of the modes that N uses. All other modes are set to zero to avoid aliasing.
    """

    inner: tuple[tuple[int, str], ...]
    outer: tuple[int, ...]
    formulas: Kernel
    kept: Fraction


@dataclass(frozen=True)
class ModeStep:
    """One step: tables, evaluations of N, and the new state.

    - ``symbol`` is the kernel that computes the eigenvalue lambda of L from the wave number. Its first output
      is the real part of lambda. If some eigenvalues are not real, the second output is the imaginary part.
    - ``length`` computes the period of the domain, and ``initial`` computes the initial state at the point x.
    - ``wave`` is the name of the wave number in expressions, and ``space`` is the name of x.
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
        """True if L has eigenvalues that are not real."""
        # The second output is the imaginary part of the eigenvalue.
        return len(self.symbol.outputs) > 1

    @property
    def transforms(self) -> int:
        """The number of Fourier transforms of one step."""
        # An evaluation transforms each derivative of u to points, and each term of N back to modes.
        return len(self.evaluations) * (len(self.nonlinearity.inner) + len(self.nonlinearity.outer))

    @property
    def factors(self) -> tuple[Factor, ...]:
        """The functions of z that the tables contain, each once, sorted."""
        factors = dict.fromkeys(f for table in self.tables for f in table.multiplier.factors)
        # The order does not depend on the order of the tables.
        return tuple(sorted(factors, key=lambda f: f.order))

    @property
    def backwards(self) -> bool:
        """True if a table contains exp(c z) or phi_1(c z) with c < 0.

        These functions grow exponentially with h if L is dissipative.
        """
        # A dissipative L has negative eigenvalues, so c z is positive for c < 0.
        return any(f.function in (EXP, PHI) and float(f.scale) < 0 for f in self.factors)

    @property
    def growth(self) -> int:
        """A number p such that all tables are at most a constant times (1 + |z|)^p for z < 0.

        The bound does not hold if :attr:`backwards` is true, because the tables then grow exponentially.
        """
        # For z -> -infinity, phi_1(z) behaves like -1/z and z/(exp(z) - 1) like -z. The bound of exp(z) is 1.
        degrees = {PHI: -1, BERNOULLI: 1, POWER: 1, EXP: 0}
        # The degree of a product is the sum of the degrees of its factors. The largest degree of all terms is
        # the bound.
        products = [m for table in self.tables for m in table.multiplier.terms]
        return max((sum(degrees[f.function] * n for f, n in m) for m in products), default=0)

    def kernels(self) -> tuple[Kernel, ...]:
        """Return the kernels of all formulas."""
        return self.symbol, self.length, self.nonlinearity.formulas, self.initial

    def expressions(self) -> Iterator[Expr]:
        """Yield every expression that emitted code evaluates during a run."""
        # The initial state is computed before a run, so its kernel is missing here.
        for kernel in (self.symbol, self.length, self.nonlinearity.formulas):
            yield from kernel.expressions()

    def explanation(self) -> list[str]:
        """Return lines that describe the stages and the new state by formulas in z. In these lines N_i is
        N(U_i).
        """
        lines = []
        for number, evaluation in enumerate(self.evaluations, 1):
            # An evaluation at the beginning of the step needs no remark about its time.
            time = "" if evaluation.time.is_zero else f", at t + {evaluation.time.text()} h"
            lines += self._sum(f"U{number}", evaluation.point, time)
        lines += self._sum("new u", self.result, "")
        lines.append("z is h times the eigenvalue of L; phi1(z) = (exp(z) - 1)/z")
        if any(f.function == BERNOULLI for f in self.factors):
            # Real eigenvalues never reach the poles, which are purely imaginary.
            poles = ", unbounded near the poles z = 2 pi i m, m = 1, -1, 2, ..." if self.complex else ""
            lines.append(f"bernoulli(z) = z/(exp(z) - 1){poles}")
        lines.append(f"tables for z < 0: {self.bound()}")
        lines.append(
            f"a step: {len(self.evaluations)} evaluations of N, {self.transforms} Fourier transforms"
        )
        return lines

    def bound(self) -> str:
        """Describe how fast the tables grow for large negative z."""
        if self.backwards:
            return "some contain exp(-c z) with c > 0 and grow exponentially, so short steps are required"
        if self.growth > 0:
            power = "|z|" if self.growth == 1 else f"|z|^{self.growth}"
            return f"some grow like {power}, which may require short steps"
        return "all are bounded"

    def _sum(self, name: str, terms: tuple[Term, ...], remark: str) -> list[str]:
        """Return the lines of the formula ``name`` = sum of ``terms``, followed by ``remark``."""
        words = []
        for term in terms:
            source = "u" if term.source == STATE else f"N{term.source + 1}"
            factor = "" if term.table is None else self.tables[term.table].text()
            several = term.table is not None and len(self.tables[term.table].multiplier.terms) > 1
            # A factor such as h (a + b) already has its parentheses.
            shown = f"({factor})" if several and not factor.startswith("h (") else factor
            words.append(f"{shown} {source}".strip())
        line = f"{name} = {' + '.join(words) or '0'}{remark}"
        if len(line) <= WIDTH:
            return [line]
        # A long formula has one term on each line. The remark follows the last term.
        first, *rest = words
        return [f"{name} = {first}", *(f"+ {word}" for word in rest[:-1]), f"+ {rest[-1]}{remark}"]
