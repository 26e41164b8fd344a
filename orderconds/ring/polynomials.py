"""Polynomials over Q in named variables, used to expand conditions for a fixed number of stages.

The elements have python-flint's type ``fmpq_mpoly``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from orderconds.ring.decimals import rational_decimal
from orderconds.ring.protocol import Key


class Polynomials:
    """The ring of polynomials over Q in the variables ``names``. The terms of a polynomial are sorted in
    degree-lexicographic order, the largest term first.

    >>> R = Polynomials(["b1", "b2"])
    >>> b1, b2 = R.generators
    >>> R.text((b1 + b2) * (b1 - b2) / 2)
    '1/2*b1^2 - 1/2*b2^2'
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)
        self.name = f"QQ[{', '.join(self.names)}]"
        self._context = fmpq_mpoly_ctx.get(list(self.names), "deglex")
        self.generators: tuple[fmpq_mpoly, ...] = tuple(self._context.gens())
        self.zero = self._context.constant(fmpq(0))
        self.one = self._context.constant(fmpq(1))

    def __repr__(self) -> str:
        return self.name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polynomials) and other.names == self.names

    def __hash__(self) -> int:
        return hash(self.names)

    def generator(self, name: str) -> fmpq_mpoly:
        """Return the variable with the name ``name``."""
        return self.generators[self.names.index(name)]

    def rational(self, p: int, q: int = 1) -> fmpq_mpoly:
        """Return the constant p/q."""
        return self._context.constant(fmpq(p, q))

    def is_zero(self, x: fmpq_mpoly) -> bool:
        """Return True if x = 0."""
        return bool(x.is_zero())

    def terms(self, x: fmpq_mpoly) -> tuple[tuple[tuple[int, ...], fmpq], ...]:
        """Return a pair (exponents, coefficient) for each term. The leading term is the first."""
        return tuple((tuple(int(e) for e in exponents), c) for exponents, c in x.terms())

    def text(self, x: fmpq_mpoly) -> str:
        """Return x as text: a sum of terms that begins with the leading term."""
        return self._render(x, str)

    def key(self, x: fmpq_mpoly) -> Key:
        """Return a triple (exponents, p, q) for each term. The coefficient of the term is p/q."""
        return tuple((exponents, int(c.p), int(c.q)) for exponents, c in self.terms(x))

    def approximate(self, x: fmpq_mpoly, digits: int = 20) -> str:
        """Return x as text. Each coefficient is a decimal with ``digits`` significant digits."""
        return self._render(x, lambda c: rational_decimal(c, digits))

    def _render(self, x: fmpq_mpoly, number: Callable[[fmpq], str]) -> str:
        terms = []
        for exponents, c in self.terms(x):
            powers = [n if e == 1 else f"{n}^{e}" for n, e in zip(self.names, exponents, strict=True) if e]
            factors = powers if abs(c) == 1 and powers else [number(abs(c)), *powers]
            terms.append(("- " if c < 0 else "+ ") + "*".join(factors))
        text = " ".join(terms).removeprefix("+ ")
        return "-" + text[2:] if text.startswith("- ") else text or "0"
