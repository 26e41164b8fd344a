"""Drawings as SVG: layout, escaping, and the same bytes each time."""

from __future__ import annotations

from itertools import pairwise

import pytest

from orderconds.explain import kinds
from orderconds.explain.diagram import Vertex, plain
from orderconds.explain.svg import lay_out, sheet


def test_layouts_keep_neighbours_apart_and_parents_above_the_middle() -> None:
    def placed(layout: object, x: float, level: int) -> list[tuple[int, float]]:
        found = [(level, x)]
        for child in layout.below:  # type: ignore[attr-defined]
            found += placed(child, x + child.x, level + 1)
        if layout.below:  # type: ignore[attr-defined]
            ends = layout.below[0].x + layout.below[-1].x  # type: ignore[attr-defined]
            assert ends == pytest.approx(0, abs=1e-12)
        return found

    for tree in kinds.get("ordered").members(7):
        at = sorted(placed(lay_out(plain(tree)[0]), 0.0, 0))
        pairs = pairwise(at)
        assert all(x + 1 <= y + 1e-9 for (level, x), (other, y) in pairs if level == other)


def test_an_svg_sheet_is_the_same_text_each_time_and_escapes_captions() -> None:
    entries = [(plain(b"\0\1"), ["<f>"]), ((Vertex("dot"),), [])]
    assert sheet(entries) == sheet(entries)
    assert "&lt;f&gt;" in sheet(entries)
    assert "nan" not in sheet([])
