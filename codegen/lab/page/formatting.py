"""The formats of numbers, times and pictures on a page."""

from __future__ import annotations

import math
from dataclasses import dataclass

from markupsafe import Markup

from codegen.lab.page.figures import superscript


@dataclass(frozen=True)
class Picture:
    """An SVG picture with its caption and the command that reproduces the picture."""

    svg: Markup
    caption: str
    command: str


def scientific(x: float, digits: int = 2) -> str:
    """Return a number in mathematical notation, with ``digits`` significant digits.

    >>> scientific(8.86e-35), scientific(0.0), scientific(-0.12345, 4), scientific(float("inf"))
    ('8.9 · 10⁻³⁵', '0', '−0.1235', '∞')
    """
    if not math.isfinite(x):
        return "–" if math.isnan(x) else "∞" if x > 0 else "−∞"
    if x == 0 or 1e-3 <= abs(x) < 1e4:
        return f"{x:.{digits}g}".replace("-", "−")
    mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
    return f"{mantissa.replace('-', '−')} · 10{superscript(int(exponent))}"


def duration(seconds: float | None) -> str:
    """Return a time with three digits and a unit; a dash for None.

    >>> duration(1.234e-5), duration(2.0), duration(None)
    ('12.3 µs', '2 s', '–')
    """
    if seconds is None:
        return "–"
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= 0.9995 * size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def decade(k: int) -> str:
    """Return 10^-k.

    >>> decade(6)
    '10⁻⁶'
    """
    return f"10{superscript(-k)}"
