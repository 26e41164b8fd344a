"""Advice on the page: for each need and accuracy the method to take, and what it costs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from codegen.lab.needs import DECADES, Advice
from codegen.lab.page.spelling import decade, duration


def section(found: Sequence[Advice]) -> dict[str, Any]:
    """Return a table: a row a need, a column an accuracy; needs that nothing meets are left out."""
    return {
        "errors": [decade(k) for k in DECADES],
        "rows": [
            {
                "need": a.need,
                "meaning": a.meaning,
                "best": [None if b is None else {"label": b[0], "time": duration(b[1])} for b in a.best],
            }
            for a in found
            if any(a.best)
        ],
        "unmet": [a.need for a in found if not any(a.best)],
    }
