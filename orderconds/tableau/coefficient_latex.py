"""LaTeX formulas for the coefficients of tableau files."""

from __future__ import annotations

from fractions import Fraction

from orderconds.tableau.doubles import printed
from orderconds.tableau.grammar import Chain, Constant, Expression, Name, Power, parse


def to_latex(text: str) -> str:
    r"""Return a coefficient in LaTeX.

    >>> print(to_latex("1/4 - sqrt(3)/6"), to_latex("2^(1/3)"), to_latex("-1/2"), to_latex("0.5773~"))
    \frac{1}{4} - \frac{\sqrt{3}}{6} \sqrt[3]{2} -\frac{1}{2} 0.5773\ldots
    """
    return _latex(with_fractions(parse(text)), 0)


def _latex(x: Expression, tight: int) -> str:
    if isinstance(x, Constant):
        if x.is_double:
            return printed(x.value)
        if x.unit:
            return decimal(x.value, len(str(x.unit.denominator)) - 1) + r"\ldots"
        size = abs(x.value)
        text = str(size) if size.denominator == 1 else rf"\frac{{{size.numerator}}}{{{size.denominator}}}"
        return text if x.value >= 0 else rf"(-{text})" if tight else f"-{text}"
    if isinstance(x, Name):
        return x.name
    if isinstance(x, Power):
        base, n = _latex(x.base, 0), x.exponent.denominator
        if x.exponent.numerator == 1 and n > 1:
            return rf"\sqrt{{{base}}}" if n == 2 else rf"\sqrt[{n}]{{{base}}}"
        tall = base if isinstance(x.base, Constant) and x.base.value.denominator == 1 else rf"({base})"
        return rf"{tall}^{{{x.exponent}}}"
    if x.operators == ("-",) and x.operands[0] == Constant(Fraction(0)):
        text, level = f"-{_latex(x.operands[1], 1)}", 0
    elif x.operators[0] in "+-":
        level, text = 0, _latex(x.operands[0], 0)
        for operator, operand in zip(x.operators, x.operands[1:], strict=True):
            text += f" {operator} {_latex(operand, 1)}"
    else:
        sign, first = _split_sign(x.operands[0])
        level, text = 0 if sign else 1, _latex(first, 0 if x.operators[0] == "/" else 1)
        for operator, operand in zip(x.operators, x.operands[1:], strict=True):
            text = (
                rf"{text} \cdot {_latex(operand, 2 if _ends_in_a_factor(operand) else 1)}"
                if operator == "*"
                else rf"\frac{{{text}}}{{{_latex(operand, 0)}}}"
            )
        text = sign + text
    return f"({text})" if level < tight else text


def _split_sign(x: Expression) -> tuple[str, Expression]:
    """Return the leading sign of x ("-" or empty), and x without this sign."""
    if isinstance(x, Chain) and x.operators == ("-",) and x.operands[0] == Constant(Fraction(0)):
        return "-", x.operands[1]
    if isinstance(x, Constant) and not x.unit and x.value < 0:
        return "-", Constant(-x.value)
    return "", x


def _ends_in_a_factor(x: Expression) -> bool:
    """Return True if the last operation of x is a multiplication, as in ``a / b * c``."""
    return isinstance(x, Chain) and x.operators[-1] == "*"


def with_fractions(x: Expression) -> Expression:
    """Return an equal expression with fewer operations. A quotient of two exact constants at the beginning of
    a product becomes one constant.

    >>> with_fractions(parse("1/2"))
    Constant(value=Fraction(1, 2), unit=Fraction(0, 1))
    """
    if isinstance(x, Chain):
        operands = tuple(map(with_fractions, x.operands))
        first = operands[0]
        if x.operators == ("-",) and first == Constant(Fraction(0)):
            number = operands[1]
            return Constant(-number.value) if isinstance(number, Constant) and not number.unit else x
        if x.operators[0] == "/" and isinstance(first, Constant) and isinstance(operands[1], Constant):
            divisor = operands[1]
            if not first.unit and not divisor.unit and divisor.value:
                quotient = Constant(first.value / divisor.value)
                rest = Chain(x.operators[1:], (quotient, *operands[2:]))
                return rest if rest.operators else quotient
        return Chain(x.operators, operands)
    return Power(with_fractions(x.base), x.exponent) if isinstance(x, Power) else x


def decimal(x: Fraction, places: int) -> str:
    """Return x with ``places`` decimal places. Further digits are cut off, without rounding.

    >>> decimal(Fraction(1, 4), 2)
    '0.25'
    """
    figures = str(int(x * 10**places)).rjust(places + 1, "0")
    return f"{figures[:-places]}.{figures[-places:]}" if places else figures
