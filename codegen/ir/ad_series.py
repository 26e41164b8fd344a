"""Products of functions of one operator ad_x. Examples are the functions exp(ad_x), dexp_x and dexp_x^{-1}.

A product of these functions is called a word. The variable t denotes ad_x, or ad*_x on the dual of the Lie
algebra. The factors of a word commute.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


# The option ``order=True`` makes factors sortable.
@dataclass(frozen=True, order=True)
class Factor:
    """The function phi(s t)^p of the variable t. ``function`` is the name of phi, ``scale`` is s, and
    ``power`` is p.

    The function phi(t) is exp(t), dexp(t) = (e^t - 1)/t, or dexpinv(t). The function dexpinv(t) is the series
    of 1/dexp(t), truncated after the power t^``order``.
    """

    function: str
    scale: Fraction
    order: int = 0
    power: int = 1

    def text(self) -> str:
        """Return the factor as text, for example ``exp(-t)`` or ``1/dexpinv2(t)``."""
        scale = {"1": "", "-1": "-"}.get(str(self.scale), str(self.scale))
        order = str(self.order) if self.function == "dexpinv" else ""
        return f"{'1/' if self.power < 0 else ''}{self.function}{order}({scale}t)"

    def scaled(self, by: Fraction) -> Factor:
        """Return this factor with the variable t replaced by ``by`` times t."""
        # The substitution t -> c t does not change the truncation order of a power series.
        return Factor(self.function, self.scale * by, self.order, self.power)

    def inverse(self) -> Factor:
        """Return the reciprocal of this factor."""
        return Factor(self.function, self.scale, self.order, -self.power)


Word = tuple[Factor, ...]

UNIT = Fraction(1)


def simplified(word: Word) -> Word:
    """Simplify a product of functions of t.

    For example, exp(-s t) dexp(s t) is replaced by dexp(-s t).

    >>> simplified((Factor("dexp", Fraction(1)), Factor("exp", Fraction(-1))))[0].text()
    'dexp(-t)'
    """
    # Each key of ``powers`` describes a factor dexp or dexpinv, and the value is its total power. The product
    # of all factors exp(s t) in ``word`` is exp(``rate`` t).
    powers: dict[tuple[str, Fraction, int], int] = {}
    rate = Fraction(0)
    for f in word:
        # For dexp and dexpinv there is no rule such as e^{at} e^{bt} = e^{(a+b)t}.
        if f.function == "exp":
            rate += f.scale * f.power
        else:
            key = (f.function, f.scale, f.order)
            powers[key] = powers.get(key, 0) + f.power
    # The loop runs over a copy of the entries, because its body adds keys to ``powers``.
    for (function, scale, order), n in list(powers.items()):
        # The rule is exp(-s t) dexp(s t) = (1 - e^{-s t})/(s t) = dexp(-s t) with s = ``scale``.
        if function == "dexp" and n > 0 and rate == -scale:
            powers[function, scale, order] -= 1
            powers[function, -scale, order] = powers.get((function, -scale, order), 0) + 1
            # The product exp(``rate`` t) dexp(s t) has become dexp(-s t), so no factor exp remains.
            rate = Fraction(0)
    # Sorting makes the result independent of the order of the factors in ``word``.
    factors = [Factor("exp", rate)] if rate else []
    for (function, scale, order), n in sorted(powers.items()):
        # A power n with |n| > 1 becomes |n| equal factors, because only factors with the powers 1 and -1 can
        # be evaluated.
        factors += [Factor(function, scale, order, 1 if n > 0 else -1)] * abs(n)
    return tuple(factors)
