"""Formats numbers and times for the report. The class ``Picture`` contains a picture and its caption."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup


@dataclass(frozen=True)
class Picture:
    """An SVG picture with its caption and the command that reproduces the picture.

    If ``wide`` is True, the picture has the width of the page.
    """

    svg: Markup
    caption: str
    command: str
    wide: bool = False


def superscript(n: int) -> str:
    """Return an integer as text in superscript digits.

    >>> superscript(-12)
    '⁻¹²'
    """
    return str(n).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def power_of_ten(x: float) -> str:
    """Return a power of ten as text in mathematical notation.

    >>> power_of_ten(1e-08), power_of_ten(1.0)
    ('10⁻⁸', '1')
    """
    exponent = round(math.log10(x))
    return "1" if exponent == 0 else f"10{superscript(exponent)}"


def scientific(x: float, digits: int = 2) -> str:
    """Return a number as text in mathematical notation, with at most ``digits`` significant digits.

    >>> scientific(8.86e-35), scientific(0.0), scientific(-0.12345, 4), scientific(float("inf"))
    ('8.9 · 10⁻³⁵', '0', '−0.1235', '∞')
    >>> scientific(150.0), scientific(9999.0), scientific(-0.000996, 2)
    ('150', '1.0 · 10⁴', '−0.001')
    """
    if not math.isfinite(x):
        return "–" if math.isnan(x) else "∞" if x > 0 else "−∞"
    mantissa, exponent = f"{x:.{digits - 1}e}".replace("-", "−", 1 if x < 0 else 0).split("e")
    power = int(exponent)
    if x and not -3 <= power < 4:
        return f"{mantissa} · 10{superscript(power)}"
    # The number is rounded first, because rounding may change the power of ten.
    rounded = float(mantissa.replace("−", "-")) * 10.0**power
    text = f"{rounded:.{max(0, digits - 1 - power)}f}".replace("-", "−")
    return text.rstrip("0").rstrip(".") if "." in text else text


def seconds(x: float) -> str:
    """Return the time ``x`` in seconds as text with a unit and at most three significant digits.

    >>> seconds(1e-5), seconds(0.1), seconds(1.234e-9), seconds(2.0)
    ('10 µs', '100 ms', '1.23 ns', '2 s')
    """
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if x >= 0.9995 * size:
            return f"{x / size:.3g} {unit}"
    return f"{x / 1e-9:.3g} ns"


def duration(time: float | None) -> str:
    """Return a time in seconds as text with a unit and at most three significant digits.

    If ``time`` is None, return a dash.

    >>> duration(1.234e-5), duration(None)
    ('12.3 µs', '–')
    """
    return "–" if time is None else seconds(time)


def decade(k: int) -> str:
    """Return the number 10^-k as text.

    >>> decade(6)
    '10⁻⁶'
    """
    return f"10{superscript(-k)}"


def enumeration(words: Sequence[str]) -> str:
    """Return the words joined by commas, and by ``and`` before the last word.

    >>> enumeration(["a"]), enumeration(["a", "b"]), enumeration(["a", "b", "c"])
    ('a', 'a and b', 'a, b and c')
    """
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
