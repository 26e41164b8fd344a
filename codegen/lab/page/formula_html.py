"""Converts order conditions to HTML, with sums, indices and powers in mathematical notation."""

from __future__ import annotations

import re
from html import escape

LETTERS = {"alpha": "α", "beta": "β", "gamma": "γ", "ahat": "â", "bhat": "b̂", "chat": "ĉ"}
"""The letters that replace the names of coefficients in formulas on the page."""

_TOKEN = re.compile(
    r"sum_(?:\{(?P<range>[^}]*)\}|(?P<index>\w+))"
    r"|(?P<name>[A-Za-z]+)_(?P<sub>[A-Za-z0-9]+)"
    r"|\^(?P<power>-?\d+)"
    r"|\^\((?P<root>-?\d+/\d+)\)"
    r"|(?P<number>\d+(?:/\d+)?)"
    r"|(?P<minus>-)"
    r"|(?P<times>\*)"
    r"|(?P<radical>sqrt)(?=\()"
    r"|(?P<space> )"
    r"|(?P<other>.)"
)


def formula_html(text: str) -> str:
    """Return a formula as HTML. ``text`` is the formula in the notation that the commands print.

    >>> formula_html("sum_{i,j} b_i a_ij c_j^2 = 1/12")
    '∑<sub>i,j</sub> <i>b</i><sub>i</sub> <i>a</i><sub>ij</sub> <i>c</i><sub>j</sub><sup>2</sup> = 1/12'
    >>> formula_html("sum_{i<j} b_i^-1 - 1/2")
    '∑<sub>i&lt;j</sub> <i>b</i><sub>i</sub><sup>−1</sup> − 1/2'
    >>> formula_html("-5*2^(1/3)/288 - sqrt(2)")
    '−5·2<sup>1/3</sup>/288 − √(2)'
    """
    return "".join(_token_html(match) for match in _TOKEN.finditer(text))


def _token_html(match: re.Match[str]) -> str:
    groups = match.groupdict()
    if groups["range"] or groups["index"]:
        return f"∑<sub>{_subscript(groups['range'] or groups['index'])}</sub>"
    if groups["name"]:
        letter = LETTERS.get(groups["name"], groups["name"])
        return f"<i>{letter}</i><sub>{_subscript(groups['sub'])}</sub>"
    if groups["power"]:
        return f"<sup>{groups['power'].replace('-', '−')}</sup>"
    if groups["root"]:
        return f"<sup>{groups['root'].replace('-', '−')}</sup>"
    if groups["minus"]:
        return "−"
    if groups["times"]:
        return "·"
    if groups["radical"]:
        return "√"
    return escape(match.group())


def _subscript(text: str) -> str:
    return escape(text.replace("<=", "≤").replace(">=", "≥"))
