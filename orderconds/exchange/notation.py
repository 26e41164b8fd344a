"""Convert coefficients of tableau files to SymPy source. Convert SymPy source and LaTeX to coefficients.

The conversion of a coefficient to LaTeX is in the module :mod:`orderconds.tableau.coefficient_latex`.
"""

from __future__ import annotations

import re
from fractions import Fraction

from orderconds.errors import TableauError
from orderconds.tableau.coefficient_latex import decimal, with_fractions
from orderconds.tableau.doubles import printed
from orderconds.tableau.grammar import Constant, Expression, Name, Power, parse


def to_python(text: str) -> str:
    """Convert a coefficient of a tableau file to SymPy source. An exact number remains exact.

    >>> to_python("1/4 - sqrt(3)/6"), to_python("2^(1/3)"), to_python("-0.5")
    ('Rational(1, 4) - sqrt(3)/6', 'Integer(2)**Rational(1, 3)', 'Rational(-1, 2)')
    """
    return _python(with_fractions(parse(text)), 0)


def _number(x: Fraction) -> str:
    return str(x.numerator) if x.denominator == 1 else f"Rational({x.numerator}, {x.denominator})"


def _python(x: Expression, tight: int) -> str:
    """Return x as Python source, in parentheses if the larger expression around x requires them.

    ``tight`` is 1 if a sum requires parentheses, 2 if a product also requires parentheses, and 0 otherwise.
    """
    if isinstance(x, Constant):
        if x.is_double:
            return printed(x.value)
        if x.unit:
            places = len(str(x.unit.denominator)) - 1
            return f"Float('{decimal(x.value, places)}')"
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


def from_python(text: str) -> str:
    """Convert SymPy source of a number to the notation of tableau files. The source is not executed.

    >>> from_python("Rational(1, 4) - sqrt(3)/6"), from_python("2**(2/3)/3"), from_python("Float('0.57735')")
    ('(1/4) - sqrt(3)/6', '2^(2/3)/3', '0.57735~')
    """
    text = re.sub(r"Rational\(\s*(-?\d+)\s*,\s*(\d+)\s*\)", r"(\1/\2)", text)
    text = re.sub(r"(?:Integer|S)\(\s*(-?\d+)\s*\)", r"(\1)", text)
    text = re.sub(r"Float\(\s*'([\d.]+)'(?:\s*,\s*(?:precision=)?\d+)?\s*\)", r"\1~", text)
    text = text.replace("**", "^")
    return re.sub(r"\^\(\((-?\d+(?:/\d+)?)\)\)", r"^(\1)", text)


def from_latex(text: str, where: str = "") -> str:
    r"""Convert a number in LaTeX to the notation of tableau files.

    Raises TableauError for LaTeX commands that are not supported.

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
        raise TableauError(
            f"{text[:60]!r}", where=where, expected=r"a number in LaTeX (\frac, \sqrt, \cdot, \ldots)"
        )
    return text
