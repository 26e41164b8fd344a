"""Order conditions as HTML: sums, indices and powers in mathematical notation."""

from __future__ import annotations

import re
from html import escape

LETTERS = {"alpha": "α", "beta": "β", "gamma": "γ", "ahat": "â", "bhat": "b̂", "chat": "ĉ"}
"""Names of coefficients that are written as another letter."""

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
    """Return the HTML of a formula in text form.

    >>> formula_html("sum_{i,j} b_i a_ij c_j^2 = 1/12")
    '∑<sub>i,j</sub> <i>b</i><sub>i</sub> <i>a</i><sub>ij</sub> <i>c</i><sub>j</sub><sup>2</sup> = 1/12'
    >>> formula_html("sum_{i<j} b_i^-1 - 1/2")
    '∑<sub>i&lt;j</sub> <i>b</i><sub>i</sub><sup>−1</sup> − 1/2'
    >>> formula_html("-5*2^(1/3)/288 - sqrt(2)")
    '−5·2<sup>1/3</sup>/288 − √(2)'
    """
    return "".join(_token_html(match) for match in _TOKEN.finditer(text))


def _token_html(match: re.Match[str]) -> str:
    found = match.groupdict()
    if found["range"] or found["index"]:
        return f"∑<sub>{_subscript(found['range'] or found['index'])}</sub>"
    if found["name"]:
        letter = LETTERS.get(found["name"], found["name"])
        return f"<i>{letter}</i><sub>{_subscript(found['sub'])}</sub>"
    if found["power"]:
        return f"<sup>{found['power'].replace('-', '−')}</sup>"
    if found["root"]:
        return f"<sup>{found['root'].replace('-', '−')}</sup>"
    if found["minus"]:
        return "−"
    if found["times"]:
        return "·"
    if found["radical"]:
        return "√"
    return escape(match.group())


def _subscript(text: str) -> str:
    return escape(text.replace("<=", "≤").replace(">=", "≥"))
