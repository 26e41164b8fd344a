"""Coefficients of tableau files in two other notations: Python with SymPy's names, and LaTeX."""

from __future__ import annotations

import re
from fractions import Fraction

from orderconds.errors import TableauError
from orderconds.tableau.doubles import printed
from orderconds.tableau.grammar import Chain, Constant, Expression, Name, Power, parse


def to_python(text: str) -> str:
    """Return a coefficient as SymPy source, exact.

    >>> to_python("1/4 - sqrt(3)/6"), to_python("2^(1/3)"), to_python("-0.5")
    ('Rational(1, 4) - sqrt(3)/6', 'Integer(2)**Rational(1, 3)', 'Rational(-1, 2)')
    """
    return _python(_rational(parse(text)), 0)


def _rational(x: Expression) -> Expression:
    """Join quotients of integers into one constant, so that they print as one number."""
    if isinstance(x, Chain):
        operands = tuple(map(_rational, x.operands))
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
    return Power(_rational(x.base), x.exponent) if isinstance(x, Power) else x


def _number(x: Fraction) -> str:
    return str(x.numerator) if x.denominator == 1 else f"Rational({x.numerator}, {x.denominator})"


def _python(x: Expression, tight: int) -> str:
    """Return x as Python source; ``tight`` is 1 inside a product, 2 in a divisor or a base."""
    if isinstance(x, Constant):
        if x.is_double:
            return printed(x.value)
        if x.unit:
            places = len(str(x.unit.denominator)) - 1
            return f"Float('{_decimal(x.value, places)}')"
        return f"({_number(x.value)})" if x.value < 0 and tight else _number(x.value)
    if isinstance(x, Name):
        return x.name
    if isinstance(x, Power):
        if x.exponent == Fraction(1, 2):
            return f"sqrt({_python(x.base, 0)})"
        base = f"Integer({x.base.value})" if isinstance(x.base, Constant) else f"({_python(x.base, 0)})"
        return f"{base}**{_number(x.exponent) if x.exponent > 0 else f'({_number(x.exponent)})'}"
    if x.operators == ("-",) and x.operands[0] == Constant(Fraction(0)):
        text, level = f"-{_python(x.operands[1], 1)}", 0
    else:
        additive = x.operators[0] in "+-"
        level = 0 if additive else 1
        text = _python(x.operands[0], 0 if additive else 1)
        for operator, operand in zip(x.operators, x.operands[1:], strict=True):
            after = _python(operand, 2 if not additive else 1 if operator == "-" else 0)
            text += f" {operator} {after}" if additive else f"{operator}{after}"
        if not additive and re.fullmatch(r"-?\d+", text.split("/")[0]) and x.operators[0] == "/":
            text = f"Integer({text.split('/')[0]})" + text[len(text.split("/")[0]) :]
    return f"({text})" if level < tight else text


def _decimal(x: Fraction, places: int) -> str:
    figures = str(int(x * 10**places)).rjust(places + 1, "0")
    return f"{figures[:-places]}.{figures[-places:]}" if places else figures


def from_python(text: str) -> str:
    """Translate SymPy source, or the text that SymPy prints, into a coefficient; nothing is executed.

    >>> from_python("Rational(1, 4) - sqrt(3)/6"), from_python("2**(2/3)/3"), from_python("Float('0.57735')")
    ('(1/4) - sqrt(3)/6', '2^(2/3)/3', '0.57735~')
    """
    text = re.sub(r"Rational\(\s*(-?\d+)\s*,\s*(\d+)\s*\)", r"(\1/\2)", text)
    text = re.sub(r"(?:Integer|S)\(\s*(-?\d+)\s*\)", r"(\1)", text)
    text = re.sub(r"Float\(\s*'([\d.]+)'(?:\s*,\s*(?:precision=)?\d+)?\s*\)", r"\1~", text)
    text = text.replace("**", "^")
    return re.sub(r"\^\(\((-?\d+(?:/\d+)?)\)\)", r"^(\1)", text)


def to_latex(text: str) -> str:
    r"""Return a coefficient in LaTeX.

    >>> print(to_latex("1/4 - sqrt(3)/6"), to_latex("2^(1/3)"), to_latex("-1/2"), to_latex("0.5773~"))
    \frac{1}{4} - \frac{\sqrt{3}}{6} \sqrt[3]{2} -\frac{1}{2} 0.5773\ldots
    """
    return _latex(_rational(parse(text)), 0)


def _latex(x: Expression, tight: int) -> str:
    if isinstance(x, Constant):
        if x.is_double:
            return printed(x.value)
        if x.unit:
            return _decimal(x.value, len(str(x.unit.denominator)) - 1) + r"\ldots"
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
        level, text = 1, _latex(x.operands[0], 1)
        for operator, operand in zip(x.operators, x.operands[1:], strict=True):
            text = (
                rf"{text} \cdot {_latex(operand, 2 if _ends_in_a_factor(operand) else 1)}"
                if operator == "*"
                else rf"\frac{{{text}}}{{{_latex(operand, 0)}}}"
            )
    return f"({text})" if level < tight else text


def _ends_in_a_factor(x: Expression) -> bool:
    """Whether x is printed as a product and not as one fraction. The factors are not regrouped into one
    fraction, because this would change the value if it is a ball."""
    return isinstance(x, Chain) and x.operators[-1] == "*"


def from_latex(text: str, where: str = "") -> str:
    r"""Return a number in LaTeX as a coefficient.

    >>> from_latex(r"\frac{1}{4} - \tfrac{\sqrt{3}}{6}"), from_latex(r"-\sqrt[3]{2}")
    ('((1)/(4)) - ((sqrt(3))/(6))', '-(2)^(1/3)')
    >>> from_latex(r"0.57\ldots")
    '0.57~'
    """
    text = re.sub(r"\\(?:displaystyle|left|right|,|;|!)", "", text.strip().strip("$"))
    text = re.sub(r"\\[td]frac", r"\\frac", text)
    text = re.sub(r"\s*\\(?:ldots|dots)", "~", text)
    text = re.sub(r"\s*\\(?:cdot|times)\s*", "*", text)
    text = re.sub(r"\^\{(-?\d+)\}", r"^\1", text)
    text = re.sub(r"\^\{(-?\d+)/(\d+)\}", r"^(\1/\2)", text)
    simple = r"\{([^{}]*)\}"
    for _ in range(60):
        new = re.sub(rf"\\sqrt\[(\d+)\]{simple}", r"(\2)^(1/\1)", text)
        new = re.sub(rf"\\sqrt{simple}", r"sqrt(\1)", new)
        new = re.sub(rf"\\frac\s*{simple}\s*{simple}", r"((\1)/(\2))", new)
        new = re.sub(r"\\frac(\d)(\d)", r"(\1/\2)", new)
        if new == text:
            break
        text = new
    if "\\" in text or "{" in text:
        raise TableauError(f"{text[:60]!r}", where=where, expected=r"numbers, \frac, \sqrt, \cdot, \ldots")
    return text
